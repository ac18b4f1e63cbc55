/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dam_break.c: a column of water a wide and n^2 a high collapses in an open tank (Martin & Moyce 1952; Gray 2001
   section 3.3). The gate is gone at once: by default the run starts with the pressure that incompressible water has at
   that moment, zero at the top and at the freed face. History in their terms: T = n t sqrt(g/a), Z = front/a. */
#include "scene.h"
#if SPH_DIM == 2

enum { A = SCENE_COMMON, N2, N, LENGTH, HEIGHT, GRAVITY, SOUND, START, AWAY, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 1.2, 1),
    {"a", "m", "width of the column", 0.0572, 1e-4, 1e4, SCENE_NUMBER},
    {"n2", "-", "height of the column in widths", 1, 0.1, 10, SCENE_NUMBER},
    {"n", "-", "particles across the column", 30, 4, 4000, SCENE_WHOLE},
    {"length", "a", "length of the tank; 0: 6, or 14 for columns higher than wide", 0, 0, 100, SCENE_NUMBER},
    {"height", "a", "height of the tank; 0: the column's and half as much again", 0, 0, 100, SCENE_NUMBER},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the column's height", 14.142135623730951, 2, 1000, SCENE_NUMBER},
    {"start", "-", "pressure at the start: uniform hydrostatic released", SCENE_RELEASED, 0, 2, SCENE_CHOICE},
    {"away", "tank lengths", "distance of the tank's corner from the origin, along both axes", 0, -1e6, 1e6,
     SCENE_NUMBER},
};

static double spacing(const double *p) { return p[A] / p[N]; }
static double sound(const double *p) { return p[SOUND] * __builtin_sqrt(p[GRAVITY] * p[N2] * p[A]); }
/* sqrt(n2 g/a): what makes a time into T */
static double rate(const double *p) { return __builtin_sqrt(p[N2] * p[GRAVITY] / p[A]); }

static void tank(const double *p, double *lo, double *hi)
{
    double length = p[LENGTH] > 0 ? p[LENGTH] : p[N2] > 1 ? 14 : 6;
    double height = p[HEIGHT] > 0 ? p[HEIGHT] : 1.5 * p[N2];
    const double size[2] = {(length < 1 ? 1 : length) * p[A], (height < p[N2] ? p[N2] : height) * p[A]};
    for (int k = 0; k < 2; k++) {
        lo[k] = p[AWAY] * size[0];
        hi[k] = lo[k] + size[k];
    }
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx);
    double lo[2], hi[2];
    tank(p, lo, hi);
    const double column[2] = {lo[0] + p[A], lo[1] + p[N2] * p[A]};
    *c = scene_config(p, dx, 1000, sound(p));
    c->gravity[1] = -p[GRAVITY];
    c->lo[0] = lo[0] - m;
    c->lo[1] = lo[1] - m;
    c->hi[0] = hi[0] + m;
    c->hi[1] = hi[1] + m;
    c->max_particles = scene_capacity(scene_box_count(lo, column, dx) +
                                      scene_wall_count(p, lo, hi, dx, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1)));
}

/* pressure of the column at the moment of release */
static void released(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    double lo[2], hi[2];
    (void)v;
    tank(p, lo, hi);
    const double y[2] = {x[0] - lo[0], x[1] - lo[1]};
    double pressure = 1000 * p[GRAVITY] * scene_released(p[A], p[N2] * p[A], y);
    *rho = scene_density(p, pressure > 0 ? pressure : 0, 1000, sound(p));
}

static sph_status build(sph_sim *sim, const double *p)
{
    double lo[2], hi[2], q[PARAMS];
    tank(p, lo, hi);
    const double column[2] = {lo[0] + p[A], lo[1] + p[N2] * p[A]};
    for (int i = 0; i < PARAMS; i++)
        q[i] = p[i]; /* the field's context is not const */
    const sph_status st = scene_add_water(sim, p[START], lo, column, released, q);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1));
}

static double end(const double *p) { return (p[N2] > 1 ? 6 : 4) / rate(p); }

static const char *const column[] = {"time_s",     "T_-",        "Z_-",         "closed_end_height_-", "kinetic_J/m",
                                     "potential_J/m", "internal_J/m", "wall_work_J/m", "dissipated_J/m", "diffused_J/m",
                                     "mass_kg/m",  "particles_-", "in_walls_J/m", "balance_J/m"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    sph_totals o;
    /* a support off the closed end, where the gauge sees water on both sides of its line */
    double lo[2], hi[2], back, front, height = 0;
    tank(p, lo, hi);
    const double at[2] = {lo[0] + sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p), 0};
    sph_get_totals(sim, &o);
    sph_extent(sim, 0, &back, &front);
    sph_gauge(sim, at, 1, &height);
    const double values[] = {sph_time(sim), sph_time(sim) * rate(p), (front - lo[0] + 0.5 * spacing(p)) / p[A],
                             (height - lo[1]) / (p[N2] * p[A]), o.kinetic, o.potential, o.internal, o.wall_work,
                             o.dissipated,
                             o.diffused, o.mass, o.fluid, o.in_walls, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_dam_break SPH_NAME(scene_dam_break)
extern const scene scene_dam_break;
const scene scene_dam_break = {"dam_break", "a column of water collapses in a tank (Martin & Moyce 1952)", param,
                               PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                               history, scene_si};
#endif
