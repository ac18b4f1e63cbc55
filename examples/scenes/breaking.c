/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* breaking.c: a mound of water at the end of a tank is let go and makes a wave that breaks by itself (Wickramarachchi
   2009 section 6.4.2, table 6.12: k 2.5, B 0.35 m; he sees it break after 2.55 to 3.4 s). y = D + B exp(-k x), at rest,
   hydrostatic. It breaks where the connected surface first has a vertical tangent: after 1.863 s in potential flow
   (tests/refdata/wave_wick_mounds.csv). */
#include "waves.h"
#if SPH_DIM == 2

#define AHEAD 1.2 /* the leading crest is faster than this many sqrt(gD) */

enum { DEPTH = SCENE_COMMON, MOUND_B, MOUND_K, LENGTH, N, GRAVITY, SOUND, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.001, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 1),
    {"depth", "m", "depth of the water at rest", 0.15, 1e-4, 1e4, SCENE_NUMBER},
    {"mound_b", "m", "height of the mound at the left end", 0.35, 0, 1e4, SCENE_NUMBER},
    {"mound_k", "1/m", "how fast the mound falls", 2.5, 1e-6, 1e4, SCENE_NUMBER},
    {"length", "depth", "length of the tank", 32, 8, 1000, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 12, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 16, 2, 1000, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double surface(const void *of, double x)
{
    const double *p = of;
    return p[MOUND_B] / p[DEPTH] * sph_exp(-p[MOUND_K] * p[DEPTH] * x);
}
static wave_water water(const double *p)
{
    return (wave_water){.depth = p[DEPTH], .gravity = p[GRAVITY], .sound = p[SOUND], .to = p[LENGTH],
                        .n = (uint32_t)p[N], .surface = surface, .of = p};
}
static void tank(const double *p, double *lo, double *hi)
{
    lo[0] = lo[1] = 0;
    hi[0] = p[LENGTH] * p[DEPTH];
    hi[1] = 1.5 * p[DEPTH] + 1.5 * p[MOUND_B];
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx);
    const wave_water w = water(p);
    double lo[2], hi[2];
    tank(p, lo, hi);
    *c = scene_config(p, dx, 1000, p[SOUND] * wave_long(p[GRAVITY], p[DEPTH]));
    c->gravity[1] = -p[GRAVITY];
    c->lo[0] = 0;
    c->hi[0] = hi[0];
    c->lo[1] = -m;
    c->hi[1] = hi[1] + m;
    c->face[0][0] = c->face[0][1] = SPH_SYMMETRY;
    c->max_particles = scene_capacity(wave_count(&w) + scene_wall_count(p, lo, hi, dx, SPH_LOW(1)));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const wave_water w = water(p);
    double lo[2], hi[2];
    tank(p, lo, hi);
    const sph_status st = wave_add(sim, p, &w);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(1));
}

static double end(const double *p) { return 17 * __builtin_sqrt(p[DEPTH] / p[GRAVITY]); }

static const char *const column[] = {"time_s",      "crest_x_m",     "crest_m",        "speed_m/s",    "lean_-",
                                     "lean_x_m",    "lean_y_m",      "breaks_known_s", "kinetic_J/m",  "potential_J/m",
                                     "internal_J/m", "dissipated_J/m", "diffused_J/m", "balance_J/m"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double d = p[DEPTH];
    const track_tank tank = {0, p[LENGTH] * d, d, spacing(p), false, NULL, NULL};
    /* the leading crest: behind it, at the end, the water rises again */
    const double from = AHEAD * wave_long(p[GRAVITY], d) * sph_time(sim);
    const track_crest c = track_between(sim, &tank, from, tank.hi);
    const track_face f = track_steepest(sim, &tank, c, false);
    const bool printed = SCENE_ABS(d - 0.15) + SCENE_ABS(p[MOUND_B] - 0.35) + SCENE_ABS(p[MOUND_K] - 2.5) < 1e-6;
    sph_totals o;
    sph_get_totals(sim, &o);
    const double values[] = {sph_time(sim), c.x, c.height - d, c.speed, f.lean, f.x, f.y, printed ? 1.863 : 0,
                             o.kinetic, o.potential, o.internal, o.dissipated, o.diffused, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_breaking SPH_NAME(scene_breaking)
extern const scene scene_breaking;
const scene scene_breaking = {"breaking", "a released mound makes a wave that breaks (Wickramarachchi 2009, 6.4.2)",
                              param, PARAMS, configure, build, end, sizeof column / sizeof *column, column, history,
                              scene_si};
#endif
