/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dam_break_3d.c: a block of water in the corner of a tank collapses, in three dimensions. The side walls are symmetry
   faces of the domain, which cost no memory; the floor and the ends are walls of particles. */
#include "scene.h"
#if SPH_DIM == 3

enum { A = SCENE_COMMON, N2, N, DEEP, LENGTH, WIDTH, HEIGHT, GRAVITY, SOUND, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 1),
    {"a", "m", "length of the block (x)", 0.0572, 1e-4, 1e4, SCENE_NUMBER},
    {"n2", "-", "height of the block in a", 1, 0.1, 10, SCENE_NUMBER},
    {"n", "-", "particles along a", 20, 4, 500, SCENE_WHOLE},
    {"deep", "a", "depth of the block (y)", 1, 0.1, 10, SCENE_NUMBER},
    {"length", "a", "length of the tank (x)", 3, 1, 100, SCENE_NUMBER},
    {"width", "a", "width of the tank (y)", 1.5, 0.1, 100, SCENE_NUMBER},
    {"height", "a", "height of the tank; 0: the block's and half as much again", 0, 0, 100, SCENE_NUMBER},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the block's height", 14.142135623730951, 2, 1000, SCENE_NUMBER},
};

#define FACES (SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(2))

static double spacing(const double *p) { return p[A] / p[N]; }
static double rate(const double *p) { return __builtin_sqrt(p[N2] * p[GRAVITY] / p[A]); }

static void sizes(const double *p, double *block, double *tank)
{
    double height = p[HEIGHT] > 0 ? p[HEIGHT] : 1.5 * p[N2];
    double width = p[WIDTH] > p[DEEP] ? p[WIDTH] : p[DEEP];
    block[0] = p[A];
    block[1] = p[DEEP] * p[A];
    block[2] = p[N2] * p[A];
    tank[0] = p[LENGTH] * p[A];
    tank[1] = width * p[A];
    tank[2] = (height > p[N2] ? height : p[N2]) * p[A];
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[3] = {0, 0, 0};
    double block[3], tank[3];
    sizes(p, block, tank);
    *c = scene_config(p, dx, 1000, p[SOUND] * __builtin_sqrt(p[GRAVITY] * block[2]));
    c->gravity[2] = -p[GRAVITY];
    c->lo[0] = c->lo[2] = -m;
    c->lo[1] = 0;
    c->hi[0] = tank[0] + m;
    c->hi[1] = tank[1];
    c->hi[2] = tank[2] + m;
    c->face[1][0] = c->face[1][1] = SPH_SYMMETRY;
    c->max_particles = scene_capacity(scene_box_count(lo, block, dx) + scene_wall_count(p, lo, tank, dx, FACES));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[3] = {0, 0, 0};
    double block[3], tank[3];
    sizes(p, block, tank);
    const sph_status st = scene_add_water(sim, SCENE_HYDROSTATIC, lo, block, NULL, NULL);
    return st ? st : scene_add_tank(sim, p, lo, tank, spacing(p), FACES);
}

static double end(const double *p) { return 3 / rate(p); }

static const char *const column[] = {"time_s",      "T_-",          "Z_-",           "closed_end_height_-",
                                     "kinetic_J",   "potential_J",  "internal_J",    "wall_work_J",
                                     "dissipated_J", "diffused_J",  "mass_kg",       "particles_-",
                                     "in_walls_J",   "balance_J"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    sph_totals o;
    const double support = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p);
    const double at[3] = {support, support, 0}; /* a support off the walls */
    double back, front, height = 0;
    sph_get_totals(sim, &o);
    sph_extent(sim, 0, &back, &front);
    sph_gauge(sim, at, 2, &height);
    const double values[] = {sph_time(sim), sph_time(sim) * rate(p), (front + 0.5 * spacing(p)) / p[A],
                             height / (p[N2] * p[A]), o.kinetic, o.potential, o.internal, o.wall_work, o.dissipated,
                             o.diffused, o.mass, o.fluid, o.in_walls, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_dam_break_3d SPH_NAME(scene_dam_break_3d)
extern const scene scene_dam_break_3d;
const scene scene_dam_break_3d = {"dam_break_3d", "a block of water collapses in a tank, in 3-D", param, PARAMS,
                                  configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
