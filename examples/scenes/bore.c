/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bore.c: a bore, made by water that comes against a wall (the other end of the tank moves with it, so that nothing but
   the bore starts there) or by a wall that moves into water at rest (Gray 2001 section 3.4: 10 m of water at 8.5 m/s;
   undular at 5 m/s). Beside the exact jump, mass and momentum conserved:

     c^2 = g H (H + D)/(2 D),   c (H - D) = V H

   H the depth behind, c the bore's speed over the water that it runs into. Weaker bores, H/D up to 1.28, are trains of
   waves behind a front (tests/refdata/wave_bore_trains.csv). */
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, SPEED, LENGTH, N, MADE, RISE, BED, GRAVITY, SOUND, TRAVEL, PARAMS };
enum { BY_WATER, BY_WALL };
enum { BED_SYMMETRY, BED_WALL };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 1),
    {"depth", "m", "depth of the water at rest", 10, 1e-4, 1e4, SCENE_NUMBER},
    {"speed", "m/s", "of the water, or of the wall", 8.5, 1e-6, 1e3, SCENE_NUMBER},
    {"length", "depth", "length of the water", 30, 4, 1000, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 10, 4, 4000, SCENE_WHOLE},
    {"made", "-", "what moves: water wall", BY_WATER, 0, 1, SCENE_CHOICE},
    {"rise", "sqrt(D/g)", "how long the wall takes to its speed, evenly; 0: at once", 0, 0, 1000, SCENE_NUMBER},
    {"bed", "-", "bed and far end: symmetry wall", BED_WALL, 0, 1, SCENE_CHOICE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 14, 2, 1000, SCENE_NUMBER},
    {"travel", "sqrt(D/g)", "length of the run", 12, 0, 1e6, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double unit_time(const double *p) { return __builtin_sqrt(p[DEPTH] / p[GRAVITY]); }
static double end(const double *p) { return p[TRAVEL] * unit_time(p); }

/* H/D of the exact jump: with F^2 = V^2/(g D), (h - 1)^2 (h + 1) = 2 F^2 h, by halves */
static double jump(const double *p)
{
    const double f2 = p[SPEED] * p[SPEED] / (p[GRAVITY] * p[DEPTH]);
    double low = 1, high = 2 + 2 * f2;
    for (int i = 0; i < 100; i++) {
        const double h = 0.5 * (low + high);
        *((h - 1) * (h - 1) * (h + 1) < 2 * f2 * h ? &low : &high) = h;
    }
    return low;
}

/* The left end: with the water, or into it. */
static void drive(void *ctx, double t, double *x, double *v)
{
    const double *p = ctx, rise = p[MADE] == BY_WALL ? p[RISE] * unit_time(p) : 0;
    const double times[2] = {0, rise > 0 ? rise : 1}, speeds[2] = {rise > 0 ? 0 : p[SPEED], p[SPEED]};
    sph_programme m = {2, 0, times, speeds};
    sph_motion_programme(&m, t, x, v);
}

static wave_tank tank(const double *p)
{
    return (wave_tank){p[LENGTH] * p[DEPTH], (1 + 2 * (jump(p) - 1) + 1) * p[DEPTH], p[BED] == BED_WALL,
                       drive};
}
static double flat(const void *p, double x) { return (void)p, (void)x, 0; }
static void flow(const void *of, double x, double y, double *v, double *pressure)
{
    const double *p = of;
    (void)x;
    v[0] = p[MADE] == BY_WATER ? p[SPEED] / wave_long(p[GRAVITY], p[DEPTH]) : 0;
    v[1] = 0;
    *pressure = 1 - y;
}
static wave_water water(const double *p)
{
    return (wave_water){.depth = p[DEPTH], .gravity = p[GRAVITY], .sound = p[SOUND], .to = p[LENGTH],
                        .n = (uint32_t)p[N], .surface = flat, .flow = flow, .of = p};
}

static void configure(const double *p, sph_config *c)
{
    const wave_water w = water(p);
    const wave_tank k = tank(p);
    *c = wave_tank_configure(p, &w, &k);
}
static sph_status build(sph_sim *sim, const double *p)
{
    const wave_water w = water(p);
    const wave_tank k = tank(p);
    return wave_tank_build(sim, p, &w, &k);
}

static const char *const column[] = {
    "time_s",        "wall_m",        "front_m",       "speed_exact_m/s", "behind_m",     "behind_exact_m",
    "crest_m",       "crest_off_m",   "spacing_m",     "lean_-",          "kinetic_J/m",  "potential_J/m",
    "dissipated_J/m", "wall_work_J/m", "balance_J/m"};

/* mean column height behind the front, from two depths off the wall to three behind the front */
static double behind(const sph_sim *sim, const track_tank *t, double wall, double front)
{
    enum { PLACES = 32 };
    const double way = front < wall ? -1 : 1, from = wall + way * 2 * t->depth, to = front - way * 3 * t->depth;
    double x[PLACES], h[PLACES], sum = 0;
    if ((to - from) * way <= 0)
        return 0;
    for (int i = 0; i < PLACES; i++)
        x[i] = from + (to - from) * (i + 0.5) / PLACES;
    track_heights(sim, t, x, PLACES, h);
    for (int i = 0; i < PLACES; i++)
        sum += h[i] / PLACES;
    return sum;
}

/* the second crest's distance behind the first; 0: there is none */
static double spacing_of_crests(const sph_sim *sim, const track_tank *t, track_crest first, double way)
{
    enum { PLACES = TRACK_PLACES };
    const double reach = 12 * t->depth, end = way > 0 ? t->lo : t->hi;
    double x[PLACES], h[PLACES];
    int low = 0;
    for (int i = 0; i < PLACES; i++)
        x[i] = first.x - way * reach * i / (PLACES - 1);
    track_heights(sim, t, x, PLACES, h);
    while (low + 1 < PLACES && h[low + 1] <= h[low])
        low++;
    for (int i = low + 1; i + 1 < PLACES && (x[i + 1] - end) * way > 0; i++)
        if (h[i] >= h[i - 1] && h[i] > h[i + 1]) {
            const double bend = h[i - 1] - 2 * h[i] + h[i + 1];
            const double share = bend < 0 ? (h[i - 1] - h[i + 1]) / (2 * bend) : 0;
            return reach * (i + share) / (PLACES - 1);
        }
    return 0;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double d = p[DEPTH], t = sph_time(sim), high = jump(p) * d, far = p[LENGTH] * d;
    double x[2], v[2];
    sph_totals o;
    drive((void *)(uintptr_t)p, t, x, v);
    const track_tank tank = {x[0], far, d, spacing(p), false, NULL, NULL};
    const bool water = p[MADE] == BY_WATER;
    const double wall = water ? far : x[0], way = water ? -1 : 1;
    const double front = track_front(sim, &tank, wall, way * d, 0.5 * (high + d));
    const double from = way > 0 ? front - 4 * d : front, to = way > 0 ? front : front + 4 * d;
    const track_crest first = track_between(sim, &tank, from, to);
    const double c = p[SPEED] * jump(p) / (jump(p) - 1);
    sph_get_totals(sim, &o);
    const double values[] = {t, wall, front, way * (water ? c - p[SPEED] : c), behind(sim, &tank, wall, front), high,
                             first.height - d, (first.x - wall) * way, spacing_of_crests(sim, &tank, first, way),
                             track_steepest(sim, &tank, first, water).lean, o.kinetic, o.potential, o.dissipated,
                             o.wall_work, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_bore SPH_NAME(scene_bore)
extern const scene scene_bore;
const scene scene_bore = {"bore", "a bore runs over water, from a wall (Gray 2001, 3.4)", param, PARAMS, configure,
                          build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
