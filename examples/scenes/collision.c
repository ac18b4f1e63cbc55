/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* collision.c: two exact solitary waves meet head on (Wickramarachchi 2009 section 6.4.2: crests 0.191 and 0.172 m
   above the bed in 0.15 m of water). Beside potential flow of these two (tests/refdata/wave_collision.csv): the peak is
   0.4440 D, more than the sum of the heights, and each wave goes on some way behind where it would be alone. */
#include "soliton.h"
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, HEIGHT, OTHER, APART, LENGTH, N, GRAVITY, SOUND, TRAVEL, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 0),
    {"depth", "m", "depth of the water at rest", 0.15, 1e-4, 1e4, SCENE_NUMBER},
    {"height", "depth", "height of the wave that goes to the right", 0.2733333333333333, SOLITON_LEAST, SOLITON_MOST,
     SCENE_NUMBER},
    {"other", "depth", "height of the wave that goes to the left", 0.1466666666666667, SOLITON_LEAST, SOLITON_MOST,
     SCENE_NUMBER},
    {"apart", "depth", "distance of the crests at the start", 20, 4, 1000, SCENE_NUMBER},
    {"length", "depth", "length of the tank, the waves about its middle", 60, 8, 1000, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 10, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 10, 2, 1000, SCENE_NUMBER},
    {"travel", "sqrt(D/g)", "length of the run", 25, 0, 1e6, SCENE_NUMBER},
};

/* the waves at the start, the second one mirrored; places in depths */
typedef struct pair {
    soliton wave[2];
    double at[2];
} pair;

static void prepare(pair *w, const double *p)
{
    for (int k = 0; k < 2; k++) {
        soliton_make(&w->wave[k], p[k ? OTHER : HEIGHT]);
        w->at[k] = 0.5 * p[LENGTH] + (k ? 0.5 : -0.5) * p[APART];
    }
}
static double side(int k) { return k ? -1 : 1; }

static double surface(const void *of, double x)
{
    const pair *w = of;
    return soliton_surface(&w->wave[0], x - w->at[0]) + soliton_surface(&w->wave[1], w->at[1] - x);
}
/* each as if it were alone: they are far apart; of the one that is far what it has at its own surface, at most */
static void flow(const void *of, double x, double y, double *v, double *pressure)
{
    const pair *w = of;
    v[0] = v[1] = 0;
    *pressure = 1 - y;
    for (int k = 0; k < 2; k++) {
        const double from = (x - w->at[k]) * side(k), top = 1 + soliton_surface(&w->wave[k], from);
        const double low = y < top ? y : top;
        double u[2], own;
        soliton_flow(&w->wave[k], from, low, u, &own);
        v[0] += side(k) * u[0];
        v[1] += u[1];
        *pressure += own - (1 - low);
    }
}
static wave_water water(const double *p, const pair *w)
{
    return (wave_water){.depth = p[DEPTH], .gravity = p[GRAVITY], .sound = p[SOUND], .to = p[LENGTH],
                        .n = (uint32_t)p[N], .surface = surface, .flow = flow, .of = w};
}

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static void tank(const double *p, double *lo, double *hi)
{
    lo[0] = lo[1] = 0;
    hi[0] = p[LENGTH] * p[DEPTH];
    hi[1] = (1.5 + 3 * (p[HEIGHT] + p[OTHER])) * p[DEPTH];
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx);
    double lo[2], hi[2];
    pair waves;
    tank(p, lo, hi);
    prepare(&waves, p);
    const wave_water w = water(p, &waves);
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
    double lo[2], hi[2];
    pair waves;
    tank(p, lo, hi);
    prepare(&waves, p);
    const wave_water w = water(p, &waves);
    const sph_status st = wave_add(sim, p, &w);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(1));
}

static double end(const double *p) { return p[TRAVEL] * __builtin_sqrt(p[DEPTH] / p[GRAVITY]); }

static const char *const column[] = {
    "time_s",      "t_sqrt(D/g)",     "right_x_D",   "right_height_D", "right_lag_D",   "left_x_D",
    "left_height_D", "left_lag_D",    "highest_D",   "peak_known_D",   "right_lag_known_D", "left_lag_known_D",
    "kinetic_J/m", "potential_J/m", "dissipated_J/m", "diffused_J/m", "balance_J/m"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    enum { NEAR = 3 }; /* depths about where the wave would be alone */
    const double d = p[DEPTH], t = sph_time(sim) / __builtin_sqrt(d / p[GRAVITY]);
    const track_tank tank = {0, p[LENGTH] * d, d, spacing(p), false, NULL, NULL};
    double alone[2];
    track_crest c[2];
    sph_totals o;
    pair w;
    prepare(&w, p);
    for (int k = 0; k < 2; k++) {
        alone[k] = w.at[k] + side(k) * w.wave[k].speed * t;
        c[k] = track_between(sim, &tank, (alone[k] - NEAR) * d, (alone[k] + NEAR) * d);
    }
    const bool printed = SCENE_ABS(p[HEIGHT] - 0.27333) < 1e-4 && SCENE_ABS(p[OTHER] - 0.14667) < 1e-4;
    sph_get_totals(sim, &o);
    const double values[] = {sph_time(sim), t, c[0].x / d, c[0].height / d - 1, alone[0] - c[0].x / d, c[1].x / d,
                             c[1].height / d - 1, c[1].x / d - alone[1], track_highest(sim, &tank).height / d - 1,
                             printed ? 0.444028 : 0, printed ? 0.2698514 : 0, printed ? 0.3746946 : 0, o.kinetic,
                             o.potential, o.dissipated, o.diffused, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_collision SPH_NAME(scene_collision)
extern const scene scene_collision;
const scene scene_collision = {"collision", "two solitary waves meet (Wickramarachchi 2009, 6.4.2)", param, PARAMS,
                               configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
