/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* drop.c: a round drop of water falls into a tank and hits the surface (Wickramarachchi 2009, section 6.4.3: fallen
   0.5, 3 m/s at impact, 8,000 particles in all; he prints no sizes). Begins a moment before impact with the speed of
   the fall. How many particles are detached: dumps and `sph fragments of=fluid`, and in the history those that have
   less than three neighbours within 1.5 spacings. */
#include "scene.h"
#if SPH_DIM == 2

enum { RADIUS = SCENE_COMMON, N, WIDTH, DEPTH, FALL, GRAVITY, SOUND, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI, 1, 0, 1,
                    SPH_KICK_DRIFT_KICK, 1, 1),
    {"radius", "m", "radius of the drop", 0.1, 1e-4, 1e4, SCENE_NUMBER},
    {"n", "-", "particles in the radius", 12, 3, 2000, SCENE_WHOLE},
    {"width", "radius", "width of the tank", 15, 4, 1000, SCENE_NUMBER},
    {"depth", "radius", "depth of the water", 3.5, 1, 1000, SCENE_NUMBER},
    {"fall", "m", "how far it has fallen", 0.5, 0, 1e4, SCENE_NUMBER},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "speed", "sound speed, in speeds of impact", 10, 2, 1000, SCENE_NUMBER},
    {"duration", "s", "length of the run", 0.75, 0, 100, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[RADIUS] / p[N]; }
static double speed(const double *p) { return __builtin_sqrt(2 * p[GRAVITY] * p[FALL]); }
/* waves of the tank are slower than the drop, but for drops that hardly fall */
static double sound(const double *p)
{
    const double still = __builtin_sqrt(2 * p[GRAVITY] * p[DEPTH] * p[RADIUS]), v = speed(p);
    return p[SOUND] * (v > still ? v : still);
}

static void tank(const double *p, double *lo, double *top, double *hi)
{
    lo[0] = lo[1] = 0;
    hi[0] = top[0] = (double)(int64_t)(p[WIDTH] * p[N] + 0.5) * spacing(p);
    top[1] = (double)(int64_t)(p[DEPTH] * p[N] + 0.5) * spacing(p);
    hi[1] = top[1] + 8 * p[RADIUS] + p[FALL];
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), r = p[RADIUS];
    double lo[2], top[2], hi[2];
    tank(p, lo, top, hi);
    *c = scene_config(p, dx, 1000, sound(p));
    c->gravity[1] = -p[GRAVITY];
    for (int k = 0; k < 2; k++) {
        c->lo[k] = lo[k] - m;
        c->hi[k] = hi[k] + m;
    }
    c->max_particles = scene_capacity(scene_box_count(lo, top, dx) + (2 * r / dx + 2) * (2 * r / dx + 2) +
                                      scene_wall_count(p, lo, hi, dx, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1)));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double r = p[RADIUS], v[2] = {0, -speed(p)};
    double lo[2], top[2], hi[2];
    uint32_t water, drop;
    sph_status st;
    tank(p, lo, top, hi);
    const double centre[2] = {0.5 * hi[0], top[1] + r + spacing(p)};
    if ((st = sph_add_fluid(sim, NULL, &water)) != SPH_OK || (st = sph_add_box(sim, water, lo, top, NULL)) != SPH_OK ||
        (st = sph_apply_hydrostatic(sim, water, top[1])) != SPH_OK ||
        (st = sph_add_fluid(sim, NULL, &drop)) != SPH_OK || (st = sph_add_ring(sim, drop, centre, 0, r, v)) != SPH_OK)
        return st;
    return scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1));
}

static double end(const double *p) { return p[DURATION]; }

/* How many of the fluid stand within `reach` of particle i on one side of it in the arrays, at most 3; these are in
   order of slabs of cells along y, so that beyond `far` none is to come. */
static uint32_t neighbours(const sph_sim *sim, const sph_particle *a, uint32_t i, int way, double reach, double far)
{
    uint32_t near = 0;
    sph_particle b;
    for (uint32_t j = i + (uint32_t)way; near < 3 && sph_get(sim, j, &b) == SPH_OK; j += (uint32_t)way) {
        const double x = a->x[0] - b.x[0], y = a->x[1] - b.x[1];
        if (SCENE_ABS(y) > far)
            break;
        near += b.role == SPH_ROLE_FLUID && x * x + y * y < reach * reach;
    }
    return near;
}

/* fluid particles with fewer than three others within 1.5 spacings */
static uint32_t detached(const sph_sim *sim, const double *p)
{
    const double support = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p);
    const double reach = 1.5 * spacing(p), far = 3 * support;
    uint32_t n = 0;
    sph_particle a;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &a) == SPH_OK && a.role == SPH_ROLE_FLUID)
            n += neighbours(sim, &a, i, 1, reach, far) + neighbours(sim, &a, i, -1, reach, far) < 3;
    return n;
}

static const char *const column[] = {"time_s", "detached_-", "highest_m", "surface_middle_m", "kinetic_J",
                                     "potential_J", "dissipated_J", "thinnest_-", "balance_J"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    double lo[2], top[2], hi[2], low = 0, high = 0, level = 0;
    sph_totals o;
    tank(p, lo, top, hi);
    const double bed[2] = {0.5 * hi[0], 0};
    sph_get_totals(sim, &o);
    sph_extent(sim, 1, &low, &high);
    sph_surface(sim, bed, 1, &level);
    row[0] = sph_time(sim);
    row[1] = detached(sim, p);
    row[2] = high - top[1];
    row[3] = level - top[1];
    row[4] = o.kinetic;
    row[5] = o.potential;
    row[6] = o.dissipated;
    row[7] = o.min_density / 1000;
    row[8] = o.balance;
}

#define scene_drop SPH_NAME(scene_drop)
extern const scene scene_drop;
const scene scene_drop = {"drop", "a drop of water falls into a tank (Wickramarachchi 2009, 6.4.3)", param, PARAMS,
                          configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
