/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* caldera_wave.c: water in a tank stands before plates around an empty cavity; the plates' upper parts go, water falls
   into the cavity, and what splashes up there becomes waves (Gray 2001 sections 4.1-4.3). The plates' lower parts, of
   height d2, stay, and have water on both sides: walls that act on their own side only, as thick as the kernel's
   support. The gates vanish at once, or are lifted.
     caldera_wave  the whole tank, or a half with a wall in the cavity's middle; run-up R on the far wall, from the
                   floor, and where and when the jets land and meet
     wave_train    a half with a beach at its far end; the surface at five places */
#include "scene.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, N, D2, W, LENGTH, WHOLE, LIFT, BEACH, SOUND, DURATION, PARAMS };

#define PARAMS_OF(n_, d2_, w_, length_, whole_, beach_, duration_)                                                    \
    {                                                                                                                 \
        SCENE_PARAMS_OF(SPH_WENDLAND_C2, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI, 1, 0, 1,  \
                        SPH_KICK_DRIFT_KICK, 1.2, 1),                                                                 \
        {"depth", "m", "depth D of the water", 0.3, 1e-3, 1e4, SCENE_NUMBER},                                         \
        {"n", "-", "particles from floor to surface", n_, 6, 1000, SCENE_WHOLE},                                      \
        {"d2", "m", "height of the plates that stay; 0: none", d2_, 0, 1e4, SCENE_NUMBER},                            \
        {"width", "m", "of the cavity; of a half: from the wall in its middle to the plate", w_, 1e-3, 1e4,           \
         SCENE_NUMBER},                                                                                               \
        {"length", "m", "of the tank; with a beach: of its floor", length_, 1e-2, 1e5, SCENE_NUMBER},                 \
        {"whole", "-", "the whole tank: no yes", whole_, 0, 1, SCENE_CHOICE},                                         \
        {"lift", "m/s", "speed at which the gates are lifted; 0: they vanish at once", 0, 0, 1e3, SCENE_NUMBER},      \
        {"beach", "degrees", "slope at the far end; 0: a wall", beach_, 0, 45, SCENE_NUMBER},                         \
        {"sound", "sqrt(2 g D)", "sound speed", 10, 2, 1000, SCENE_NUMBER},                                           \
        {"duration", "s", "length of the run", duration_, 0, 1e4, SCENE_NUMBER},                                      \
    }
static const scene_param caldera_param[PARAMS] = PARAMS_OF(30, 0.125, 0.15, 2, 0, 0, 4);
static const scene_param train_param[PARAMS] = PARAMS_OF(30, 0.05, 0.4, 3.8, 0, 10, 4.5);

static const double G = 9.81;

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double sound(const double *p) { return p[SOUND] * __builtin_sqrt(2 * G * p[DEPTH]); }
static double end(const double *p) { return p[DURATION]; }
static double thickness(const double *p) { return scene_margin(p, spacing(p)) - spacing(p); } /* of plates: a support */
static double slope(const double *p) { return sph_sin(p[BEACH] * SCENE_PI / 180) / sph_cos(p[BEACH] * SCENE_PI / 180); }
/* where the far wall, or the beach, begins; and how far the beach goes: two depths up */
static double far_end(const double *p) { return spacing(p) * (double)(uint32_t)(p[LENGTH] / spacing(p) + 0.5); }
static double shore(const double *p) { return p[BEACH] > 0 ? far_end(p) + 2 * p[DEPTH] / slope(p) : far_end(p); }
static double height(const double *p) { return 3 * p[DEPTH]; }

/* sides of the cavity, low and high; of a half the low one is the wall */
static void cavity(const double *p, double *x)
{
    const double dx = spacing(p), w = dx * (double)(uint32_t)(p[W] / dx + 0.5);
    const double from = p[WHOLE] > 0 ? dx * (double)(uint32_t)(0.5 * (far_end(p) - w) / dx + 0.5) : 0;
    x[0] = from;
    x[1] = from + w;
}

static uint32_t tank_faces(const double *p) { return SPH_LOW(0) | SPH_LOW(1) | (p[BEACH] > 0 ? 0 : SPH_HIGH(0)); }

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[2] = {0, 0}, hi[2] = {far_end(p), height(p)};
    const double water[2] = {shore(p), p[DEPTH]}, plate[2] = {thickness(p), height(p)};
    *c = scene_config(p, dx, 1000, sound(p));
    c->gravity[1] = -G;
    c->lo[0] = c->lo[1] = -m;
    c->hi[0] = shore(p) + m;
    c->hi[1] = height(p) + m + (p[LIFT] > 0 ? p[DEPTH] : 0);
    c->max_particles =
        scene_capacity(scene_box_count(lo, water, dx) + scene_wall_count(p, lo, hi, dx, tank_faces(p)) +
                       12 * scene_box_count(lo, plate, dx) + 3 * m / dx * (shore(p) - far_end(p)) / dx);
}

/* lifted from time 0 on, until it is out of the water */
static void lift(void *ctx, double t, double *x, double *v)
{
    const double *p = ctx;
    const double way = p[LIFT] * t, most = p[DEPTH] + thickness(p);
    x[0] = v[0] = 0;
    x[1] = way < most ? way : most;
    v[1] = way < most ? p[LIFT] : 0;
}

/* a plate with faces to both sides and at one end; of one group each, which move together */
static sph_status add_plate(sph_sim *sim, const double *p, double x, double bottom, double top, bool gate)
{
    const double lo[2] = {x, bottom}, hi[2] = {x + thickness(p), top};
    sph_wall w = scene_wall(p);
    const bool layers = p[SCENE_WALL] >= SCENE_GHOST && !w.compressible;
    w.side = layers ? SPH_FRONT : SPH_BOTH_SIDES;
    w.motion = gate ? lift : NULL;
    w.motion_ctx = gate ? (void *)p : NULL; // NOLINT: read only
    sph_status st = sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), false, NULL);
    st = st ? st : sph_add_wall_box(sim, &w, lo, hi, SPH_HIGH(0), false, NULL);
    w.side = layers ? SPH_FACE : SPH_BOTH_SIDES;
    return st ? st : sph_add_wall_box(sim, &w, lo, hi, gate ? SPH_LOW(1) : SPH_HIGH(1), false, NULL);
}

/* what stands at low corner x of a plate */
static sph_status add_plates(sph_sim *sim, const double *p, double x)
{
    sph_status st = p[D2] > 0 ? add_plate(sim, p, x, 0, p[D2], false) : SPH_OK;
    return !st && p[LIFT] > 0 ? add_plate(sim, p, x, p[D2], p[D2] + p[DEPTH], true) : st;
}

static sph_status add_water(sph_sim *sim, const double *p, uint32_t water)
{
    double side[2];
    cavity(p, side);
    const double from = side[1] + thickness(p), left[2] = {0, 0}, to[2] = {side[0] - thickness(p), p[DEPTH]};
    const double lo[2] = {from, 0}, hi[2] = {far_end(p), p[DEPTH]};
    if (p[BEACH] > 0) {
        const double corner[4][2] = {{from, 0}, {far_end(p), 0}, {far_end(p) + p[DEPTH] / slope(p), p[DEPTH]},
                                     {from, p[DEPTH]}};
        return sph_add_polygon(sim, water, corner, 4, NULL);
    }
    const sph_status st = sph_add_box(sim, water, lo, hi, NULL);
    return !st && p[WHOLE] > 0 ? sph_add_box(sim, water, left, to, NULL) : st;
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[2] = {0, 0}, hi[2] = {far_end(p), height(p)};
    const double foot[2] = {far_end(p), 0}, top[2] = {shore(p), 2 * p[DEPTH]};
    const sph_wall wall = scene_wall(p);
    double side[2];
    uint32_t water;
    cavity(p, side);
    sph_status st = sph_add_fluid(sim, NULL, &water);
    st = st ? st : add_water(sim, p, water);
    st = st ? st : sph_apply_hydrostatic(sim, water, p[DEPTH]);
    st = st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), tank_faces(p));
    if (!st && p[BEACH] > 0)
        st = sph_add_wall_segment(sim, &wall, foot, top, NULL);
    st = st ? st : add_plates(sim, p, side[1]);
    return !st && p[WHOLE] > 0 ? add_plates(sim, p, side[0] - thickness(p)) : st;
}

/* ---- history ---- */

static const char *const caldera_column[] = {"time_s", "R/D_-", "R/D_highest_-", "tip_m", "tip_height_m", "lowest_m",
                                             "asymmetry_m", "kinetic_J/m", "potential_J/m", "wall_work_J/m",
                                             "dissipated_J/m", "balance_J/m"};

/* Of the water between the cavity's sides: how far its foremost particle is from the middle, that one's height, and the
   lowest one's; all less half a spacing, which a particle reaches further. tip: from either side the nearest. */
typedef struct jets {
    double tip[2], height[2], lowest;
} jets;

static jets find_jets(const sph_sim *sim, const double *p)
{
    double side[2];
    cavity(p, side);
    const bool whole = p[WHOLE] > 0;
    const double middle = whole ? 0.5 * (side[0] + side[1]) : 0, half = 0.5 * spacing(p);
    jets j = {{side[1] - middle, side[1] - middle}, {p[D2], p[D2]}, p[D2]};
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID || q.x[0] > side[1] || q.x[0] < side[0])
            continue;
        const uint32_t which = q.x[0] < middle;
        const double off = SCENE_ABS(q.x[0] - middle) - half, y = q.x[1] - half;
        if (off < j.tip[which]) {
            j.tip[which] = off;
            j.height[which] = y;
        }
        j.lowest = y < j.lowest ? y : j.lowest;
    }
    return j;
}

/* the highest water within two spacings of the far wall, which may be a drop */
static double highest(const sph_sim *sim, const double *p)
{
    double most = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.role == SPH_ROLE_FLUID && q.x[0] > far_end(p) - 2 * spacing(p))
            most = q.x[1] > most ? q.x[1] : most;
    return most + 0.5 * spacing(p);
}

static void caldera_history(const sph_sim *sim, const double *p, double *row)
{
    const double off = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p);
    const double bed[2] = {far_end(p) - off, 0};
    const jets j = find_jets(sim, p);
    double surface = 0;
    sph_totals o;
    sph_get_totals(sim, &o);
    sph_surface(sim, bed, 1, &surface);
    const double values[] = {sph_time(sim), surface / p[DEPTH], highest(sim, p) / p[DEPTH], j.tip[0], j.height[0],
                             j.lowest, p[WHOLE] > 0 ? j.tip[0] - j.tip[1] : 0, o.kinetic, o.potential, o.wall_work,
                             o.dissipated, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

static const char *const train_column[] = {"time_s", "surface_1_m", "surface_2_m", "surface_3_m", "surface_4_m",
                                           "surface_5_m", "kinetic_J/m", "potential_J/m", "balance_J/m"};

/* the surface over the floor at 1/2, 5/8, 3/4, 7/8 and all of the flat floor's length */
static void train_history(const sph_sim *sim, const double *p, double *row)
{
    sph_totals o;
    sph_get_totals(sim, &o);
    row[0] = sph_time(sim);
    for (int i = 0; i < 5; i++) {
        const double bed[2] = {far_end(p) * (0.5 + 0.125 * i) - (i == 4 ? 0.1 * p[DEPTH] : 0), 0};
        row[1 + i] = 0;
        sph_surface(sim, bed, 1, &row[1 + i]);
    }
    row[6] = o.kinetic;
    row[7] = o.potential;
    row[8] = o.balance;
}

#define scene_caldera_wave SPH_NAME(scene_caldera_wave)
extern const scene scene_caldera_wave;
const scene scene_caldera_wave = {"caldera_wave", "water falls into a cavity and makes waves (Gray 2001 section 4.1)",
                                  caldera_param, PARAMS, configure, build, end,
                                  sizeof caldera_column / sizeof *caldera_column, caldera_column, caldera_history,
                                  scene_si};
#define scene_wave_train SPH_NAME(scene_wave_train)
extern const scene scene_wave_train;
const scene scene_wave_train = {"wave_train", "waves from a cavity run up a beach (Gray 2001 section 4.3)",
                                train_param, PARAMS, configure, build, end,
                                sizeof train_column / sizeof *train_column, train_column, train_history, scene_si};
#endif
