/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* piston.c: a wave made by a piston (Gray 2001 section 3.2): the left end of a tank gains speed evenly for t*
   sqrt(D/g), to V = g t/10, keeps it half as long and loses it again as long as it gained it; its way is 0.15 t*^2 D.
   Printed beside potential flow of the same programme (tests/refdata/wave_piston_summary.csv), and his tables 3.1 and
   3.2 with the work (his wall went 0.70 of the way that his text says). `motion=table` is the same way as a table of
   places, through which a cubic spline goes.

   Over a bed of wall particles the water is pushed forward by those of them, too, that stand behind the foot of the
   piston, and so it gets more than the piston's work: in_walls is below 0. work is what both give it. */
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, LENGTH, T_STAR, N, BED, MOTION, GRAVITY, SOUND, PARAMS };
enum { BED_SYMMETRY, BED_WALL };
enum { PROGRAMME, TABLE };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.001, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 0),
    {"depth", "m", "depth of the water at rest", 0.16, 1e-4, 1e4, SCENE_NUMBER},
    {"length", "m", "length of the tank", 1.8, 1e-3, 1e5, SCENE_NUMBER},
    {"t_star", "sqrt(D/g)", "how long the piston gains speed", 3, 0.1, 8, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 16, 4, 4000, SCENE_WHOLE},
    {"bed", "-", "bed and far end: symmetry wall", BED_WALL, 0, 1, SCENE_CHOICE},
    {"motion", "-", "how the piston's way is given: programme table", PROGRAMME, 0, 1, SCENE_CHOICE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 10, 2, 1000, SCENE_NUMBER},
};

/* potential flow (wave_piston_summary.csv): crest at mid-tank (D), speed there (sqrt(gD)), run-up (D; t* 5 breaks
   before), work and potential energy gained (rho g D^3); and Gray's work of tables 3.1 and 3.2 */
typedef struct known_wave {
    double t_star, crest, speed, runup, work, potential, work_gray;
} known_wave;
static const known_wave known[] = {
    {1, 0.05465611, 0.9554197, 0.09151029, 0.08363977, 0.07942275, 3.0},
    {3, 0.3875326, 1.105507, 0.8627951, 1.037439, 0.8456292, 36.7},
    {5, 0.8038719, 1.365352, 0, 3.826664, 2.750917, 134.7},
};

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double unit_time(const double *p) { return __builtin_sqrt(p[DEPTH] / p[GRAVITY]); }
static double rise_time(const double *p) { return p[T_STAR] * unit_time(p); }

static void drive(void *ctx, double t, double *x, double *v)
{
    const double *p = ctx, rise = rise_time(p), top = 0.1 * p[GRAVITY] * rise;
    const double times[4] = {0, rise, 1.5 * rise, 2.5 * rise}, speeds[4] = {0, top, top, 0};
    sph_programme m = {4, 0, times, speeds};
    sph_motion_programme(&m, t, x, v);
}
static void drive_by_table(void *ctx, double t, double *x, double *v)
{
    enum { ROWS = 41 };
    const double *p = ctx;
    double times[ROWS], places[ROWS], bend[2 * ROWS];
    for (int i = 0; i < ROWS; i++) {
        double at[2], speed[2];
        times[i] = 2.5 * rise_time(p) * i / (ROWS - 1);
        drive(ctx, times[i], at, speed);
        places[i] = at[0];
    }
    sph_spline m = {ROWS, 0, times, places, bend};
    x[0] = x[1] = v[0] = v[1] = 0;
    if (sph_spline_make(&m, bend))
        sph_motion_spline(&m, t, x, v);
}

static wave_tank tank(const double *p)
{
    return (wave_tank){p[LENGTH], (1.5 + 1.5 * p[T_STAR]) * p[DEPTH], p[BED] == BED_WALL,
                       p[MOTION] == TABLE ? drive_by_table : drive};
}
static double flat(const void *p, double x) { return (void)p, (void)x, 0; }
static wave_water water(const double *p)
{
    return (wave_water){.depth = p[DEPTH], .gravity = p[GRAVITY], .sound = p[SOUND], .to = p[LENGTH] / p[DEPTH],
                        .n = (uint32_t)p[N], .surface = flat, .of = p};
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

static double end(const double *p) { return 2.5 * rise_time(p) + p[LENGTH] / wave_long(p[GRAVITY], p[DEPTH]); }

static const known_wave *potential_flow(const double *p)
{
    for (unsigned i = 0; i < sizeof known / sizeof *known; i++)
        if (SCENE_ABS(known[i].t_star - p[T_STAR]) < 1e-9)
            return &known[i];
    return NULL;
}

static const char *const column[] = {
    "time_s",          "piston_m",       "crest_x_m",            "crest_m",       "crest_known_m", "speed_m/s",
    "speed_known_m/s", "runup_m",        "runup_known_m",        "wall_work_J/m", "work_J/m", "work_known_J/m",
    "work_of_Gray_J/m", "gain_potential_J/m", "potential_known_J/m", "kinetic_J/m",  "internal_J/m",
    "dissipated_J/m",  "diffused_J/m",   "in_walls_J/m",         "balance_J/m",   "force_N/m"};

/* on the piston (N/m), from the pressure of the water on it */
static double force(const sph_sim *sim, const double *p, double x)
{
    enum { SENSORS = 48 };
    sph_config c;
    double at[SENSORS][2], pressure[SENSORS], sum = 0;
    configure(p, &c);
    const double step = 2.0 * p[DEPTH] / SENSORS;
    for (int i = 0; i < SENSORS; i++)
        at[i][0] = x, at[i][1] = (i + 0.5) * step;
    scene_wall_pressure(sim, &c, (const double(*)[2])at, SENSORS, pressure);
    for (int i = 0; i < SENSORS; i++)
        sum += pressure[i] > 0 ? pressure[i] * step : 0;
    return sum;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim), d = p[DEPTH], speed = wave_long(p[GRAVITY], d);
    const double joule = 1000 * speed * speed * d * d;
    static const known_wave none;
    const known_wave *k = potential_flow(p);
    double x[2], v[2], support = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p);
    sph_totals o;
    k = k ? k : &none;
    drive((void *)(uintptr_t)p, t, x, v);
    const track_tank tank = {x[0], p[LENGTH], d, spacing(p), false, NULL, NULL};
    const track_crest c = track_highest(sim, &tank);
    sph_get_totals(sim, &o);
    const double values[] = {t, x[0], c.x, c.height - d, k->crest * d, c.speed, k->speed * speed,
                             track_at_wall(sim, p[LENGTH], -1, support) - d, k->runup * d, o.wall_work,
                             o.wall_work - o.in_walls, k->work * joule, k->work_gray,
                             o.potential - 0.5 * 1000 * p[GRAVITY] * d * d * p[LENGTH], k->potential * joule, o.kinetic,
                             o.internal, o.dissipated, o.diffused, o.in_walls, o.balance, force(sim, p, x[0])};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_piston SPH_NAME(scene_piston)
extern const scene scene_piston;
const scene scene_piston = {"piston", "a wave made by a piston (Gray 2001, 3.2)", param, PARAMS, configure, build, end,
                            sizeof column / sizeof *column, column, history, scene_si};
#endif
