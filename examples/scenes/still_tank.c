/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* still_tank.c: water at rest in an open tank, settling under damping (Gray 2001 section 2.5.2). What the walls do
   wrong shows in the level, in the pressure and in the kinetic energy. */
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, WIDTH, N, GRAVITY, SOUND, START, DURATION, PUSH, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_COMMON_PARAMS(SPH_CUBIC, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_NO_DIFFUSION, SCENE_ADAMI, 0.998, 10000, 0),
    {"depth", "m", "depth of the water", 0.15, 1e-4, 1e4, SCENE_NUMBER},
    {"width", "m", "width of the tank", 0.3, 1e-4, 1e4, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 30, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 14.142135623730951, 2, 1000, SCENE_NUMBER},
    {"start", "-", "pressure at the start: uniform hydrostatic", SCENE_UNIFORM, 0, 1, SCENE_CHOICE},
    {"duration", "s", "length of the run", 3, 0, 1e9, SCENE_NUMBER},
    {"push", "dx", "a sinusoidal push of the places at the start", 0, 0, 0.4, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[DEPTH] / p[N]; }

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[2] = {0, 0}, water[2] = {p[WIDTH], p[DEPTH]};
    const double hi[2] = {p[WIDTH], 1.5 * p[DEPTH]};
    *c = scene_config(p, dx, 1000, p[SOUND] * __builtin_sqrt(p[GRAVITY] * p[DEPTH]));
    c->gravity[1] = -p[GRAVITY];
    c->lo[0] = c->lo[1] = -m;
    c->hi[0] = hi[0] + m;
    c->hi[1] = hi[1] + m;
    c->max_particles = scene_capacity(scene_box_count(lo, water, dx) +
                                      scene_wall_count(p, lo, hi, dx, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1)));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[2] = {0, 0}, top[2] = {p[WIDTH], p[DEPTH]}, hi[2] = {p[WIDTH], 1.5 * p[DEPTH]};
    sph_status st = scene_add_water(sim, p[START], lo, top, NULL, NULL);
    if (!st && p[PUSH] > 0) /* of set 0; under pressures of the new places */
        st = wave_push(sim, 0, spacing(p), p[PUSH] * spacing(p));
    if (!st && p[PUSH] > 0 && p[START] == SCENE_HYDROSTATIC)
        st = sph_apply_hydrostatic(sim, 0, p[DEPTH]);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1));
}

static double end(const double *p) { return p[DURATION]; }

static const char *const column[] = {"time_s", "surface_m", "pressure_error_rms_-", "pressure_error_max_-",
                                     "kinetic_J/m", "max_speed_m/s", "dissipated_J/m"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double middle[2] = {0.5 * p[WIDTH], 0}, bottom = 1000 * p[GRAVITY] * p[DEPTH];
    double surface = 0, sum = 0, most = 0;
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    sph_gauge(sim, middle, 1, &surface);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID)
            continue;
        double e = (q.p - 1000 * p[GRAVITY] * (surface - q.x[1])) / bottom;
        sum += e * e;
        most = SCENE_ABS(e) > most ? SCENE_ABS(e) : most;
    }
    row[0] = sph_time(sim);
    row[1] = surface;
    row[2] = o.fluid ? __builtin_sqrt(sum / o.fluid) : 0;
    row[3] = most;
    row[4] = o.kinetic;
    row[5] = o.max_speed;
    row[6] = o.dissipated;
}

#define scene_still_tank SPH_NAME(scene_still_tank)
extern const scene scene_still_tank;
const scene scene_still_tank = {"still_tank", "water at rest in a tank, settling under damping (Gray 2001, 2.5.2)",
                                param, PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                history, scene_si};
#endif
