/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* solitary.c: a solitary wave in a long tank: it goes along, runs up the wall at the end (Gray 2001 section 3.1) or
   comes in again at the other end (Wickramarachchi 2009 section 6.4). Starts:
     exact   the exact wave of incompressible water (soliton.h), with its velocities and its pressure
     kdv     eta = H/cosh^2(sqrt(3 H/(4 D^3)) (x - x0)) (Gray 3.2), u = eta sqrt(g/D) at every depth, pressure
             hydrostatic
     gray    the same on a square lattice of which what stands above the surface is left out, with constant density
     mound   water at rest under y = D + b exp(-k x) (Wickramarachchi 6.21), hydrostatic pressure
   But for `gray` the lattice follows the surface: columns of n particles, so wide that every particle has the same mass
   and the room that its mass needs under the pressure that it will have; as columns of water at rest become when the
   wave comes. lattice=cut: a square lattice, of which what stands above the surface is left out, as of `gray`. */
#include "soliton.h"
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, HEIGHT, LENGTH, AT, N, START, SIDES, MOUND_B, MOUND_K, GRAVITY, SOUND, TRAVEL,
       LATTICE, PUSH, PARAMS };
enum { EXACT, KDV, GRAY, MOUND };
enum { CLOSED, SYMMETRY, PERIODIC };
enum { COLUMNS, CUT };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.001, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 0),
    {"depth", "m", "depth of the water at rest", 0.2, 1e-4, 1e4, SCENE_NUMBER},
    {"height", "depth", "height of the crest above still water", 0.3, SOLITON_LEAST, SOLITON_MOST, SCENE_NUMBER},
    {"length", "depth", "length of the tank", 36, 4, 1000, SCENE_NUMBER},
    {"at", "depth", "place of the crest at the start", 8, 0, 1000, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 16, 4, 4000, SCENE_WHOLE},
    {"start", "-", "what is started from: exact kdv gray mound", EXACT, 0, 3, SCENE_CHOICE},
    {"sides", "-", "ends of the tank: closed symmetry periodic", CLOSED, 0, 2, SCENE_CHOICE},
    {"mound_b", "depth", "height of the mound at the left end", 0.4666666667, 0, 3, SCENE_NUMBER},
    {"mound_k", "1/depth", "how fast the mound falls", 0.375, 1e-3, 100, SCENE_NUMBER},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 10, 2, 1000, SCENE_NUMBER},
    {"travel", "depth", "how far the wave goes at the speed of the exact one (a mound: of sqrt(g H))", 20, 0, 1e6,
     SCENE_NUMBER},
    {"lattice", "-", "places at the start (not of gray): columns cut", COLUMNS, 0, 1, SCENE_CHOICE},
    {"push", "dx", "a sinusoidal push of the places at the start", 0, 0, 0.4, SCENE_NUMBER},
};

/* the water at the start; lengths in depths, as long as p is there */
typedef struct water {
    const double *p;
    soliton wave;
    double area, columns;
} water;

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double long_wave(const double *p) { return __builtin_sqrt(p[GRAVITY] * p[DEPTH]); }

static double surface(const water *w, double x)
{
    const double *p = w->p, e = p[HEIGHT];
    if (p[START] == EXACT)
        return soliton_surface(&w->wave, x - p[AT]);
    if (p[START] == MOUND)
        return p[MOUND_B] * sph_exp(-p[MOUND_K] * x);
    const double up = sph_exp(__builtin_sqrt(0.75 * e) * SCENE_ABS(x - p[AT]));
    return 4 * e / ((up + 1 / up) * (up + 1 / up));
}

/* Mass of a column over that of the depth at rest. Under eta the mean pressure of the column rises by about rho g
   eta/2, and there is so much more in the same room. */
static double pressed(const double *p, double eta) { return 1 + eta / (2 * p[SOUND] * p[SOUND]); }
static double column_mass(const water *w, double x)
{
    const double eta = surface(w, x);
    return (1 + eta) * pressed(w->p, eta);
}

/* where the next column of a mass stands: dx/dX = 1/column_mass (Runge-Kutta 4) */
static double further(const water *w, double x, double mass)
{
    const double a = mass / column_mass(w, x), b = mass / column_mass(w, x + 0.5 * a),
                 c = mass / column_mass(w, x + 0.5 * b), d = mass / column_mass(w, x + c);
    return x + (a + 2 * (b + c) + d) / 6;
}

static void prepare(water *w, const double *p)
{
    enum { PIECES = 4000 };
    const double piece = p[LENGTH] / PIECES;
    w->p = p;
    soliton_make(&w->wave, p[HEIGHT]);
    w->area = 0; /* Simpson */
    for (int i = 0; i <= PIECES; i++)
        w->area += column_mass(w, i * piece) * piece / 3 * (i == 0 || i == PIECES ? 1 : i & 1 ? 4 : 2);
    w->columns = (double)(uint32_t)(w->area * p[N] + 0.5);
}

static bool is_cut(const double *p) { return p[START] == GRAY || p[LATTICE] == CUT; }
static uint32_t walls(const double *p)
{
    return SPH_LOW(1) | (p[SIDES] == CLOSED ? SPH_LOW(0) | SPH_HIGH(0) : 0);
}
static void tank(const double *p, double *lo, double *hi)
{
    const double high = p[START] == MOUND ? p[MOUND_B] : p[HEIGHT];
    lo[0] = lo[1] = 0;
    hi[0] = p[LENGTH] * p[DEPTH];
    hi[1] = (1.5 + 3 * high) * p[DEPTH];
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx);
    double lo[2], hi[2];
    water w;
    tank(p, lo, hi);
    prepare(&w, p);
    *c = scene_config(p, dx, 1000, p[SOUND] * long_wave(p));
    c->gravity[1] = -p[GRAVITY];
    c->lo[0] = p[SIDES] == CLOSED ? -m : 0;
    c->hi[0] = hi[0] + (p[SIDES] == CLOSED ? m : 0);
    c->lo[1] = -m;
    c->hi[1] = hi[1] + m;
    if (p[SIDES] != CLOSED)
        c->face[0][0] = c->face[0][1] = p[SIDES] == PERIODIC ? SPH_PERIODIC : SPH_SYMMETRY;
    /* on a lattice a column may hold one particle more than its height says */
    c->max_particles = scene_capacity((w.columns + 2) * p[N] + (p[LENGTH] * p[N] + 2) +
                                      scene_wall_count(p, lo, hi, dx, walls(p)));
}

/* one particle at x, y (depths) */
static sph_status add(sph_sim *sim, uint32_t set, const water *w, double x, double y)
{
    const double *p = w->p, at[2] = {x * p[DEPTH], y * p[DEPTH]}, eta = surface(w, x), speed = long_wave(p);
    double v[2] = {0, 0}, pressure = 1 + eta - y;
    if (p[START] == EXACT)
        soliton_flow(&w->wave, x - p[AT], y, v, &pressure);
    else if (p[START] != MOUND) {
        const double step = 1e-4;
        v[0] = eta;
        v[1] = -y * (surface(w, x + step) - surface(w, x - step)) / (2 * step);
    }
    v[0] *= speed;
    v[1] *= speed;
    pressure = p[START] == GRAY || pressure < 0 ? 0 : 1000 * speed * speed * pressure;
    return sph_add_particle(sim, set, at, v, scene_density(p, pressure, 1000, p[SOUND] * speed), NULL);
}

static sph_status add_columns(sph_sim *sim, uint32_t set, const water *w)
{
    const double mass = w->area / w->columns;
    double x = further(w, 0, 0.5 * mass);
    for (uint32_t i = 0; i < w->columns; i++, x = further(w, x, mass))
        for (uint32_t j = 0; j < w->p[N]; j++) {
            sph_status st = add(sim, set, w, x, (j + 0.5) / w->p[N] * (1 + surface(w, x)));
            if (st)
                return st;
        }
    return SPH_OK;
}

static sph_status add_lattice(sph_sim *sim, uint32_t set, const water *w)
{
    const double dx = 1 / w->p[N];
    for (uint32_t i = 0; (i + 0.5) * dx < w->p[LENGTH]; i++)
        for (uint32_t j = 0; (j + 0.5) * dx < 1 + surface(w, (i + 0.5) * dx); j++) {
            sph_status st = add(sim, set, w, (i + 0.5) * dx, (j + 0.5) * dx);
            if (st)
                return st;
        }
    return SPH_OK;
}

static sph_status build(sph_sim *sim, const double *p)
{
    double lo[2], hi[2];
    uint32_t set;
    water w;
    sph_status st;
    sph_fluid f = {0};
    tank(p, lo, hi);
    prepare(&w, p);
    if (!is_cut(p))
        f.mass = 1000 * p[DEPTH] * p[DEPTH] * w.area / (w.columns * p[N]);
    if ((st = sph_add_fluid(sim, &f, &set)) != SPH_OK ||
        (st = is_cut(p) ? add_lattice(sim, set, &w) : add_columns(sim, set, &w)) != SPH_OK ||
        (st = wave_push(sim, set, spacing(p), p[PUSH] * spacing(p))) != SPH_OK)
        return st;
    return scene_add_tank(sim, p, lo, hi, spacing(p), walls(p));
}

static double wave_speed(const double *p)
{
    soliton s;
    return p[START] != MOUND && soliton_make(&s, p[HEIGHT]) ? s.speed * long_wave(p) : long_wave(p);
}
static double end(const double *p) { return p[TRAVEL] * p[DEPTH] / wave_speed(p); }

static const char *const column[] = {
    "time_s",          "crest_x_m",   "crest_x_exact_m", "crest_m",     "crest_surface_m", "speed_m/s",
    "speed_exact_m/s", "left_wall_m", "right_wall_m",    "kinetic_J/m", "potential_J/m",   "internal_J/m",
    "dissipated_J/m",  "diffused_J/m", "balance_J/m"};

/* a column's height from its mass, over the bed (m) */
static double risen(const double *p, double mass) { return mass / pressed(p, mass / p[DEPTH] - 1); }

static double wall_surface(const sph_sim *sim, const double *p, double wall, double inward)
{
    const double support = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p);
    return track_at_wall(sim, wall, inward, support) - p[DEPTH];
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    double lo[2], hi[2], high = 0;
    sph_totals o;
    tank(p, lo, hi);
    const track_tank t = {lo[0], hi[0], p[DEPTH], spacing(p), p[SIDES] == PERIODIC, NULL, NULL};
    const track_crest c = track_highest(sim, &t);
    const double bed[2] = {c.x, 0}, speed = wave_speed(p);
    sph_get_totals(sim, &o);
    sph_surface(sim, bed, 1, &high);
    const double values[] = {sph_time(sim), c.x, p[AT] * p[DEPTH] + speed * sph_time(sim),
                             risen(p, c.height) - p[DEPTH], high - p[DEPTH], c.speed, speed,
                             wall_surface(sim, p, lo[0], 1), wall_surface(sim, p, hi[0], -1),
                             o.kinetic, o.potential, o.internal, o.dissipated, o.diffused, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_solitary SPH_NAME(scene_solitary)
extern const scene scene_solitary;
const scene scene_solitary = {"solitary", "a solitary wave in a long tank (Gray 2001, 3.1; Wickramarachchi 2009, 6.4)",
                              param, PARAMS, configure, build, end, sizeof column / sizeof *column, column, history,
                              scene_si};
#endif
