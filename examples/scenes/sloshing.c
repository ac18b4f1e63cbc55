/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sloshing.c: water sloshes in a tank, half a wavelength long, from a flat surface with the velocities of linear
   theory: eta = A sin(w t) cos(k x), k = pi/length, w^2 = g k tanh(k d). A guard: over many periods the mean level must
   stay (the volume), the energy must never rise, and the period is known. */
#include "scene.h"
#if SPH_DIM == 2

enum { LENGTH = SCENE_COMMON, DEPTH, AMPLITUDE, N, GRAVITY, SOUND, PERIODS, PARAMS };
enum { LINES = 12 }; /* gauges whose mean is the mean level */

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_SHIFTED(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.005, SPH_HYDROSTATIC, SCENE_ADAMI, 1, 0, 1,
                         SPH_KICK_DRIFT_KICK, 0.9, 1, 0.2, 0.5),
    {"length", "m", "length of the tank (rounded to whole spacings)", 1, 1e-3, 1e3, SCENE_NUMBER},
    {"depth", "length", "depth of the water", 0.3, 0.01, 10, SCENE_NUMBER},
    {"amplitude", "depth", "amplitude of the surface at the walls", 0.1, 0, 0.5, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 20, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 14.142135623730951, 2, 1000, SCENE_NUMBER},
    {"periods", "-", "length of the run in periods", 20, 0, 1e6, SCENE_NUMBER},
};

static double depth(const double *p) { return p[DEPTH] * p[LENGTH]; }
static double spacing(const double *p) { return depth(p) / p[N]; }
static double length(const double *p)
{
    const uint32_t across = (uint32_t)(p[LENGTH] / spacing(p) + 0.5);
    return (across > 1 ? across : 1) * spacing(p);
}
static double wave_number(const double *p) { return SCENE_PI / length(p); }
static double omega(const double *p)
{
    return __builtin_sqrt(p[GRAVITY] * wave_number(p) * sph_tanh(wave_number(p) * depth(p)));
}
#define FACES (SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1))

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[2] = {0, 0}, water[2] = {length(p), depth(p)};
    const double hi[2] = {length(p), (1.2 + 2 * p[AMPLITUDE]) * depth(p)};
    *c = scene_config(p, dx, 1000, p[SOUND] * __builtin_sqrt(p[GRAVITY] * depth(p)));
    c->gravity[1] = -p[GRAVITY];
    for (int k = 0; k < 2; k++) {
        c->lo[k] = -m;
        c->hi[k] = hi[k] + m;
    }
    c->max_particles = scene_capacity(scene_box_count(lo, water, dx) + scene_wall_count(p, lo, hi, dx, FACES));
}

static void start(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx, k = wave_number(p), up = sph_exp(k * x[1]), down = 1 / up, deep = sph_exp(k * depth(p));
    const double a = p[AMPLITUDE] * depth(p) * omega(p) / (deep - 1 / deep);
    (void)rho;
    v[0] = -a * (up + down) * sph_sin(k * x[0]);
    v[1] = a * (up - down) * sph_cos(k * x[0]);
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[2] = {0, 0}, water[2] = {length(p), depth(p)};
    const double hi[2] = {length(p), (1.2 + 2 * p[AMPLITUDE]) * depth(p)};
    double q[PARAMS];
    uint32_t set;
    sph_status st;
    for (int i = 0; i < PARAMS; i++)
        q[i] = p[i]; /* the field's context is not const */
    if ((st = sph_add_fluid(sim, NULL, &set)) != SPH_OK || (st = sph_add_box(sim, set, lo, water, NULL)) != SPH_OK ||
        (st = sph_apply_hydrostatic(sim, set, depth(p))) != SPH_OK ||
        (st = sph_apply_field(sim, set, start, q)) != SPH_OK)
        return st;
    return scene_add_tank(sim, p, lo, hi, spacing(p), FACES);
}

static double end(const double *p) { return p[PERIODS] * 2 * SCENE_PI / omega(p); }

static const char *const column[] = {"time_s",        "t_periods",    "level_m",        "mode_m",       "mode_linear_m",
                                     "energy_J/m",    "kinetic_J/m",  "potential_J/m",  "internal_J/m",
                                     "dissipated_J/m", "diffused_J/m",  "shifted_J/m",  "max_speed_m/s"};

/* the mean level, by gauges a support and more off the walls, as many left as right of the middle */
static double mean_level(const sph_sim *sim, const double *p)
{
    const double off = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p);
    const double l = length(p) - 2 * off;
    double sum = 0;
    for (int i = 0; i < LINES; i++) {
        const double x[2] = {off + (i + 0.5) / LINES * l, 0};
        double level = 0;
        sph_gauge(sim, x, 1, &level);
        sum += level;
    }
    return sum / LINES;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim), k = wave_number(p), d = depth(p);
    double moment = 0;
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++) /* as in standing_wave.c */
        if (sph_get(sim, i, &q) == SPH_OK && q.role == SPH_ROLE_FLUID)
            moment += q.mass * sph_cos(k * q.x[0]);
    const double values[] = {t, t * omega(p) / (2 * SCENE_PI), mean_level(sim, p),
                             o.mass > 0 ? 2 * d * moment / o.mass : 0, p[AMPLITUDE] * d * sph_sin(omega(p) * t),
                             o.kinetic + o.potential + o.internal, o.kinetic,
                             o.potential, o.internal, o.dissipated, o.diffused, o.shifted, o.max_speed};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_sloshing SPH_NAME(scene_sloshing)
extern const scene scene_sloshing;
const scene scene_sloshing = {"sloshing", "water sloshes in a tank for many periods: level, energy, period", param,
                              PARAMS, configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
