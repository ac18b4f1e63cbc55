/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* still_water.c: water at rest in a tank for a long time, without damping (Wickramarachchi 2009, 6.5): does its level
   creep, does its density, how restless are both. Beside it stands the level at which it was filled in; under its own
   pressure it is denser and stands lower, by g H/(2 c^2). */
#include "scene.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, WIDTH, N, GRAVITY, SOUND, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI, 1, 0, 1,
                    SPH_KICK_DRIFT_KICK, 0.9, 1),
    {"depth", "m", "depth of the water", 0.15, 1e-4, 1e4, SCENE_NUMBER},
    {"width", "m", "width of the tank", 0.3, 1e-4, 1e4, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 20, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 14.142135623730951, 2, 1000, SCENE_NUMBER},
    {"duration", "s", "length of the run", 10, 0, 1e9, SCENE_NUMBER},
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
    const sph_status st = scene_add_water(sim, SCENE_HYDROSTATIC, lo, top, NULL, NULL);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1));
}

static double end(const double *p) { return p[DURATION]; }

static const char *const column[] = {"time_s",       "level_m",       "twice_centre_m", "density_mean_kg/m^3",
                                     "density_rms_kg/m^3", "density_min_kg/m^3", "density_max_kg/m^3",
                                     "pressure_rms_Pa",    "kinetic_J/m",        "max_speed_m/s"};

/* mean over nine places across the tank, a tenth of it apart */
static double level(const sph_sim *sim, const double *p)
{
    double sum = 0;
    for (int k = 1; k < 10; k++) {
        const double at[2] = {0.1 * k * p[WIDTH], 0};
        double high = 0;
        sph_gauge(sim, at, 1, &high);
        sum += high;
    }
    return sum / 9;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    double rho = 0, y = 0, off = 0, away = 0;
    const double sound = p[SOUND] * __builtin_sqrt(p[GRAVITY] * p[DEPTH]);
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    row[1] = level(sim, p);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID)
            continue;
        const double under = row[1] > q.x[1] ? 1000 * p[GRAVITY] * (row[1] - q.x[1]) : 0;
        const double e = q.p - under, d = q.rho - scene_density(p, under, 1000, sound);
        rho += q.rho;
        y += q.x[1];
        off += d * d;
        away += e * e;
    }
    const double n = o.fluid ? o.fluid : 1;
    const double rest[] = {2 * y / n, rho / n, __builtin_sqrt(off / n), o.min_density, o.max_density,
                           __builtin_sqrt(away / n), o.kinetic, o.max_speed};
    row[0] = sph_time(sim);
    for (unsigned k = 0; k < sizeof rest / sizeof *rest; k++)
        row[2 + k] = rest[k];
}

#define scene_still_water SPH_NAME(scene_still_water)
extern const scene scene_still_water;
const scene scene_still_water = {"still_water", "water at rest for long, without damping (Wickramarachchi 2009, 6.5)",
                                 param, PARAMS, configure, build, end, sizeof column / sizeof *column, column, history,
                                 scene_si};
#endif
