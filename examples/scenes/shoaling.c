/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shoaling.c: an exact solitary wave goes up a plane slope and breaks, or surges up to the shore (Wickramarachchi 2009
   section 6.4.2, slopes 1:8, 1:15, 1:35). Beside the first vertical tangent in potential flow
   (tests/refdata/wave_shoaling_breaking.csv): its time from when an undisturbed crest is over the toe, place, height
   and height over the depth under the crest. */
#include "soliton.h"
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, HEIGHT, SLOPE, TOE, AT, TOP, N, GRAVITY, SOUND, TRAVEL, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.001, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 0),
    {"depth", "m", "depth of the water at rest before the slope", 0.2, 1e-4, 1e4, SCENE_NUMBER},
    {"height", "depth", "height of the crest above still water", 0.4, SOLITON_LEAST, SOLITON_MOST, SCENE_NUMBER},
    {"slope", "-", "how far the slope goes for a rise of 1", 35, 1, 1000, SCENE_NUMBER},
    {"toe", "depth", "place of the slope's foot", 14, 1, 1000, SCENE_NUMBER},
    {"at", "depth", "place of the crest at the start", 8, 0, 1000, SCENE_NUMBER},
    {"top", "depth", "height of the slope's end above its foot", 0.85, 0.1, 10, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 16, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 10, 2, 1000, SCENE_NUMBER},
    {"travel", "sqrt(D/g)", "length of the run", 24, 0, 1e6, SCENE_NUMBER},
};

/* potential flow: slope, height; time of the vertical tangent (sqrt(D/g)), place of the crest from the toe, its height
   (D), that over the depth there. On 1:8 there is none before the shore. */
typedef struct known_breaking {
    double slope, height, time, x, crest, index;
} known_breaking;
static const known_breaking known[] = {
    {35, 0.2, 25.95, 26.105, 0.3721, 1.464},
    {35, 0.4, 17.048, 19.93, 0.5926, 1.376},
};

typedef struct shore {
    const double *p;
    soliton wave;
} shore;

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double unit_time(const double *p) { return __builtin_sqrt(p[DEPTH] / p[GRAVITY]); }
static double length(const double *p) { return p[TOE] + p[SLOPE] * p[TOP]; }
static double end(const double *p) { return p[TRAVEL] * unit_time(p); }

/* depths */
static double surface(const void *of, double x)
{
    const shore *s = of;
    return soliton_surface(&s->wave, x - s->p[AT]);
}
static double bed(const void *of, double x)
{
    const double *p = ((const shore *)of)->p;
    return x < p[TOE] ? 0 : (x - p[TOE]) / p[SLOPE];
}
/* m */
static double bed_height(const void *of, double x)
{
    const double d = ((const shore *)of)->p[DEPTH];
    return d * bed(of, x / d);
}
static void flow(const void *of, double x, double y, double *v, double *pressure)
{
    const shore *s = of;
    soliton_flow(&s->wave, x - s->p[AT], y, v, pressure);
}
static wave_water water(const double *p, shore *s)
{
    s->p = p;
    soliton_make(&s->wave, p[HEIGHT]);
    return (wave_water){.depth = p[DEPTH], .gravity = p[GRAVITY], .sound = p[SOUND], .to = length(p),
                        .n = (uint32_t)p[N], .surface = surface, .flow = flow, .bed = bed, .of = s};
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[2] = {0, 0}, hi[2] = {length(p) * p[DEPTH], p[DEPTH]};
    shore s;
    const wave_water w = water(p, &s);
    *c = scene_config(p, dx, 1000, p[SOUND] * wave_long(p[GRAVITY], p[DEPTH]));
    c->gravity[1] = -p[GRAVITY];
    c->lo[0] = 0;
    c->hi[0] = hi[0] + (p[TOP] < 1 ? m : 0);
    c->lo[1] = -m;
    c->hi[1] = (1.2 + 3 * p[HEIGHT] + (p[TOP] > 1 ? p[TOP] - 1 : 0)) * p[DEPTH] + m;
    c->face[0][0] = SPH_SYMMETRY;
    /* the slope is longer than its foot's length, by less than a half, and has a wall at its end */
    c->max_particles = scene_capacity(wave_count(&w) + 1.5 * scene_wall_count(p, lo, hi, dx, SPH_LOW(1)) +
                                      scene_wall_count(p, lo, hi, dx, SPH_HIGH(0)) * 4);
}

/* bed, slope, and where the slope ends under water a wall */
static sph_status build(sph_sim *sim, const double *p)
{
    const double d = p[DEPTH], end_x = length(p) * d, top = p[TOP] * d;
    const double points[4][2] = {{0, 0}, {p[TOE] * d, 0}, {end_x, top}, {end_x, (1.2 + 3 * p[HEIGHT]) * d}};
    const sph_wall wall = scene_wall(p);
    shore s;
    const wave_water w = water(p, &s);
    const sph_status st = wave_add(sim, p, &w);
    return st ? st : sph_add_wall_polyline(sim, &wall, points, p[TOP] < 1 ? 4 : 3, NULL);
}

static const char *const column[] = {
    "time_s",  "t_from_toe_sqrt(D/g)", "crest_x_D",   "crest_D",     "depth_there_D", "index_-", "crest_surface_D",
    "lean_-",  "lean_x_D",             "breaks_known_sqrt(D/g)", "x_known_D", "crest_known_D", "index_known_-",
    "kinetic_J/m", "potential_J/m",    "dissipated_J/m", "balance_J/m"};

static const known_breaking *potential_flow(const double *p)
{
    static const known_breaking none;
    for (unsigned i = 0; i < sizeof known / sizeof *known; i++)
        if (SCENE_ABS(known[i].slope - p[SLOPE]) + SCENE_ABS(known[i].height - p[HEIGHT]) < 1e-9)
            return &known[i];
    return &none;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double d = p[DEPTH];
    shore s;
    sph_totals o;
    double high = 0;
    (void)water(p, &s);
    const track_tank tank = {0, length(p) * d, d, spacing(p), false, bed_height, &s};
    const track_crest c = track_highest(sim, &tank);
    const track_face f = track_steepest(sim, &tank, c, false);
    const known_breaking *k = potential_flow(p);
    const double depth = 1 - bed(&s, c.x / d), eta = c.height / d - 1, foot[2] = {c.x, bed_height(&s, c.x)};
    sph_surface(sim, foot, 1, &high);
    sph_get_totals(sim, &o);
    const double values[] = {sph_time(sim), sph_time(sim) / unit_time(p) - (p[TOE] - p[AT]) / s.wave.speed,
                             c.x / d - p[TOE], eta, depth, depth > 0 ? eta / depth : 0, high / d - 1, f.lean,
                             f.x / d - p[TOE], k->time, k->x, k->crest, k->index, o.kinetic, o.potential, o.dissipated,
                             o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_shoaling SPH_NAME(scene_shoaling)
extern const scene scene_shoaling;
const scene scene_shoaling = {"shoaling", "a solitary wave breaks on a slope (Wickramarachchi 2009, 6.4.2)", param,
                              PARAMS, configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
