/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dam_break_wick.c: Wickramarachchi's (2009, section 6.3) dam break: about 3,000 particles, walls with and without slip
   (wall=adami, adami_no_slip). He prints no size: a square of 25 m with g 9.81 has his times (Martin & Moyce's T 0.69
   and 1.38 are 1.1 and 2.2 s) and his lengths. In the history beside the front: where it is by volume of fluid for a
   gate that is gone at once (free slip, 40 cells across; tests/refdata/vof_dam_break_n2_1.csv), and the experiment's
   33.3 and 56.2 m at 1.1 and 2.2 s, whose gate took its time. */
#include "scene.h"
#if SPH_DIM == 2

enum { SIDE = SCENE_COMMON, N, LENGTH, GRAVITY, SOUND, START, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI, 1, 0, 1,
                    SPH_KICK_DRIFT_KICK, 1.2, 1),
    {"side", "m", "width and height of the column", 25, 1e-4, 1e4, SCENE_NUMBER},
    {"n", "-", "particles across the column", 55, 4, 4000, SCENE_WHOLE},
    {"length", "side", "length of the tank", 3, 1, 100, SCENE_NUMBER},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the column's height", 14.142135623730951, 2, 1000, SCENE_NUMBER},
    {"start", "-", "pressure at the start: uniform hydrostatic released", SCENE_RELEASED, 0, 2, SCENE_CHOICE},
    {"duration", "s", "length of the run", 2.2, 0, 1e4, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[SIDE] / p[N]; }
static double sound(const double *p) { return p[SOUND] * __builtin_sqrt(p[GRAVITY] * p[SIDE]); }

static void tank(const double *p, double *lo, double *hi)
{
    lo[0] = lo[1] = 0;
    hi[0] = (double)(int64_t)(p[LENGTH] * p[N] + 0.5) * spacing(p);
    hi[1] = 1.5 * p[SIDE];
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), column[2] = {p[SIDE], p[SIDE]};
    double lo[2], hi[2];
    tank(p, lo, hi);
    *c = scene_config(p, dx, 1000, sound(p));
    c->gravity[1] = -p[GRAVITY];
    for (int k = 0; k < 2; k++) {
        c->lo[k] = lo[k] - m;
        c->hi[k] = hi[k] + m;
    }
    c->max_particles = scene_capacity(scene_box_count(lo, column, dx) +
                                      scene_wall_count(p, lo, hi, dx, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1)));
}

/* pressure of the column at the moment of release */
static void released(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    const double head = scene_released(p[SIDE], p[SIDE], x);
    (void)v;
    *rho = scene_density(p, head > 0 ? 1000 * p[GRAVITY] * head : 0, 1000, sound(p));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double column[2] = {p[SIDE], p[SIDE]};
    double lo[2], hi[2], q[PARAMS];
    tank(p, lo, hi);
    for (int i = 0; i < PARAMS; i++)
        q[i] = p[i]; /* the field's context is not const */
    const sph_status st = scene_add_water(sim, p[START], lo, column, released, q);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1));
}

static double end(const double *p) { return p[DURATION]; }

/* front over side by volume of fluid, each 0.1 of T = t sqrt(g/side) (column Z_sl_40) */
static double front_of_reference(double t)
{
    static const double z[] = {1,     1.015, 1.055, 1.124, 1.205, 1.303, 1.409, 1.524, 1.647, 1.776, 1.912,
                               2.055, 2.205, 2.36,  2.516, 2.685, 2.851, 3.024, 3.201, 3.38,  3.563, 3.75};
    const double at = t * 10;
    const int k = at < 20 ? (int)at : 20;
    return z[k] + (z[k + 1] - z[k]) * (at - k);
}

static const char *const column[] = {"time_s",    "front_m",       "front_fluid_volume_m", "height_m",
                                     "kinetic_J", "potential_J", "dissipated_J",        "balance_J"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    /* a support off the closed end, where the gauge sees water on both sides of its line */
    const double at[2] = {sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p), 0};
    double back = 0, front = 0, height = 0;
    sph_totals o;
    sph_get_totals(sim, &o);
    sph_extent(sim, 0, &back, &front);
    sph_gauge(sim, at, 1, &height);
    row[0] = sph_time(sim);
    row[1] = front + 0.5 * spacing(p);
    row[2] = p[SIDE] * front_of_reference(sph_time(sim) * __builtin_sqrt(p[GRAVITY] / p[SIDE]));
    row[3] = height;
    row[4] = o.kinetic;
    row[5] = o.potential;
    row[6] = o.dissipated;
    row[7] = o.balance;
}

#define scene_dam_break_wick SPH_NAME(scene_dam_break_wick)
extern const scene scene_dam_break_wick;
const scene scene_dam_break_wick = {"dam_break_wick", "a square column collapses (Wickramarachchi 2009, 6.3)", param,
                                    PARAMS, configure, build, end, sizeof column / sizeof *column, column, history,
                                    scene_si};
#endif
