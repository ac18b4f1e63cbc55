/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* hydrostatic.c: a column of water on a wall, in one dimension, settling under damping (Gray 2001 section 2.5.1). Shows
   what each kind of wall does to the pressure near it. */
#include "scene.h"
#if SPH_DIM == 1

enum { DEPTH = SCENE_COMMON, N, RHO, GRAVITY, SOUND, START, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_COMMON_PARAMS(SPH_CUBIC, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_NO_DIFFUSION, SCENE_ADAMI, 0.998, 0, 0),
    {"depth", "m", "depth of the water", 150, 1e-4, 1e6, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 50, 4, 100000, SCENE_WHOLE},
    {"rho", "kg/m^3", "rest density", 1, 1e-6, 1e6, SCENE_NUMBER},
    {"gravity", "m/s^2", "acceleration of gravity", 1, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 14.142135623730951, 2, 1000, SCENE_NUMBER},
    {"start", "-", "pressure at the start: uniform hydrostatic", SCENE_UNIFORM, 0, 1, SCENE_CHOICE},
    {"duration", "sqrt(H/g)", "length of the run", 6, 0, 1e9, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[DEPTH] / p[N]; }

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[1] = {0}, hi[1] = {p[DEPTH]};
    *c = scene_config(p, dx, p[RHO], p[SOUND] * __builtin_sqrt(p[GRAVITY] * p[DEPTH]));
    c->gravity[0] = -p[GRAVITY];
    c->lo[0] = -m;
    c->hi[0] = 1.5 * p[DEPTH];
    c->max_particles = scene_capacity(scene_box_count(lo, hi, dx) + scene_wall_count(p, lo, hi, dx, SPH_LOW(0)));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[1] = {0}, hi[1] = {p[DEPTH]};
    const sph_status st = scene_add_water(sim, p[START], lo, hi, NULL, NULL);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(0));
}

static double end(const double *p) { return p[DURATION] * __builtin_sqrt(p[DEPTH] / p[GRAVITY]); }

static const char *const column[] = {"time_s", "bottom_pressure_Pa", "bottom_pressure_exact_Pa", "pressure_error_max_-",
                                     "pressure_error_rms_-", "top_m", "kinetic_J/m^2"};

/* pressure at a particle: the weight of what lies above it and half its own */
static double weight_above(const sph_sim *sim, const double *p, const sph_particle *at, uint32_t *above)
{
    double mass = 0.5 * at->mass;
    sph_particle q;
    *above = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.role == SPH_ROLE_FLUID && q.x[0] > at->x[0]) {
            mass += q.mass;
            ++*above;
        }
    return mass * p[GRAVITY];
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double bottom = p[RHO] * p[GRAVITY] * p[DEPTH];
    double most = 0, sum = 0, low, high, lowest = 0, exact = 0;
    uint32_t above, counted = 0;
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    sph_extent(sim, 0, &low, &high);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID)
            continue;
        double w = weight_above(sim, p, &q, &above), e = (q.p - w) / bottom;
        if (q.x[0] == low) {
            lowest = q.p;
            exact = w;
        }
        if (above < 2) /* the surface is not what is looked at */
            continue;
        counted++;
        sum += e * e;
        most = SCENE_ABS(e) > most ? SCENE_ABS(e) : most;
    }
    const double values[] = {sph_time(sim), lowest, exact, most, counted ? __builtin_sqrt(sum / counted) : 0,
                             high + 0.5 * spacing(p), o.kinetic};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_hydrostatic SPH_NAME(scene_hydrostatic)
extern const scene scene_hydrostatic;
const scene scene_hydrostatic = {"hydrostatic", "a column of water on a wall in 1-D (Gray 2001, 2.5.1)", param, PARAMS,
                                 configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
