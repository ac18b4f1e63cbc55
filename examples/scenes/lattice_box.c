/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* lattice_box.c: a periodic square of elastic solid under a uniform pressure, on a lattice of particles (Gray 2001,
   sections 5.6.5, 5.6.6; after Swegle, Hicks & Attaway 1995). With random velocities: does the lattice stay, settle to
   another, or clump? With a plane wave: its amplitude by projection on the wave, from which a frequency or a rate of
   growth follows (`sph dispersion` has the theory).

   Pressure: p = c0^2 (lambda rho - rho0) (his eq 5.78; lambda < 1: tension) with the start at `rho` times rho0. As
   lambda rho
   - rho0 = lambda (rho - rho0/lambda), the material is one of rest density rho0/lambda and sound speed sqrt(lambda) c0,
   whose bulk modulus is the same. rho = lambda with lambda = 1 would give the same pressures, and every frequency
   1/sqrt(lambda) times larger, as the same stresses move less mass.

   The history looks at every pair, a block of places at a time: it costs n^4 and is meant for n below 100. */
#include "solid.h"
#if SPH_DIM == 2

enum { SIDE = SOLID_COMMON, N, LATTICE, RHO, LAMBDA, NOISE, SEED, WAVE, WAVES_X, WAVES_Y, DIRECTION, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_CUBIC, 1, 0.5, 0, SPH_KICK_DRIFT_KICK, 0.25, SPH_UPDATED, SPH_NO_ARTIFICIAL_STRESS, 0.22, 0),
    {"side", "cm", "side of the square", 1, 1e-4, 1e4, SCENE_NUMBER},
    {"n", "-", "particles along a side; an odd one counts as the next lower", 40, 8, 400, SCENE_WHOLE},
    {"lattice", "-", "lattice at the start: square shifted_x shifted_y", SPH_LATTICE_SQUARE, 0, 2, SCENE_CHOICE},
    {"rho", "rho0", "density at the start", 1, 0.5, 2, SCENE_NUMBER},
    {"lambda", "-", "factor on the density in the equation of state; below 1: tension", 1, 0.5, 2, SCENE_NUMBER},
    {"noise", "c0", "largest random velocity on each axis", 1e-3, 0, 0.1, SCENE_NUMBER},
    {"seed", "-", "of the random velocities", 1, 0, 4294967295.0, SCENE_WHOLE},
    {"wave", "c0", "amplitude of a plane wave's velocity", 0, 0, 0.1, SCENE_NUMBER},
    {"waves_x", "-", "waves in the square along x", 1, 0, 400, SCENE_WHOLE},
    {"waves_y", "-", "waves in the square along y", 0, 0, 400, SCENE_WHOLE},
    {"direction", "-", "velocity of the wave: longitudinal transverse", 0, 0, 1, SCENE_CHOICE},
    {"duration", "side/c0", "length of the run", 100, 0, 1e6, SCENE_NUMBER},
};

static uint32_t across(const double *p) { return (uint32_t)p[N] / 2 * 2; }
static double spacing(const double *p) { return p[SIDE] / across(p); }

static void configure(const double *p, sph_config *c)
{
    *c = solid_config(p, spacing(p));
    for (int k = 0; k < 2; k++) {
        c->hi[k] = p[SIDE];
        c->face[k][0] = c->face[k][1] = SPH_PERIODIC;
    }
    c->max_particles = across(p) * across(p);
}

/* ---- the wave: velocity along e times cos(k (x - first)), `first` being the lattice's first particle ---- */

typedef struct wave {
    double k[2], first[2], along[2]; /* along: unit vector of k */
} wave;
static wave wave_of(const double *p)
{
    const double dx = spacing(p), m[2] = {p[WAVES_X], p[WAVES_Y]}, size = __builtin_sqrt(m[0] * m[0] + m[1] * m[1]);
    const bool shifted[2] = {p[LATTICE] == SPH_LATTICE_SHIFTED_X, p[LATTICE] == SPH_LATTICE_SHIFTED_Y};
    wave w;
    for (int k = 0; k < 2; k++) {
        w.k[k] = 2 * SCENE_PI * m[k] / p[SIDE];
        w.first[k] = shifted[k] ? 0.25 * dx : 0.5 * dx;
        w.along[k] = size > 0 ? m[k] / size : k == 0;
    }
    return w;
}
static double phase_at(const wave *w, const double *x)
{
    return sph_cos(w->k[0] * (x[0] - w->first[0]) + w->k[1] * (x[1] - w->first[1]));
}

typedef struct start {
    const double *p;
    wave w;
    sph_rng rng;
} start;

static void field(void *ctx, const double *x, double *v, double *rho)
{
    start *s = ctx;
    const double *p = s->p, a = p[WAVE] * phase_at(&s->w, x), *e = s->w.along;
    for (int k = 0; k < 2; k++)
        v[k] = p[NOISE] * (2 * sph_rng_uniform(&s->rng) - 1);
    v[0] += a * (p[DIRECTION] != 0 ? -e[1] : e[0]);
    v[1] += a * (p[DIRECTION] != 0 ? e[0] : e[1]);
    *rho = p[RHO];
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double dx = spacing(p);
    sph_solid m = solid_material(p);
    sph_shape s = {.hi = {p[SIDE], p[SIDE]}, .lattice = (uint32_t)p[LATTICE]};
    start how = {.p = p, .w = wave_of(p)};
    uint32_t set;
    sph_status st;
    m.mass = p[RHO] * dx * dx;
    m.rho0 = 1 / p[LAMBDA];
    m.sound_speed = __builtin_sqrt(p[LAMBDA]);
    sph_rng_seed(&how.rng, (uint64_t)p[SEED], 0);
    if ((st = sph_add_solid(sim, &m, &set, NULL)) != SPH_OK || (st = sph_add_shape(sim, set, &s)) != SPH_OK)
        return st;
    return sph_apply_field(sim, set, field, &how);
}

static double end(const double *p) { return p[DURATION] * p[SIDE]; }

/* ---- history: who is near whom ---- */

/* Neighbours of BLOCK places. NEAR, in spacings, lies between the distances of the second neighbours of the
   face-centred and the square lattice (1.118, 1.414): the one has six so near, the other four. */
#define BLOCK 256
#define NEAR 1.27
typedef struct around {
    double x[BLOCK][2], least2[BLOCK]; /* least2: to the nearest */
    uint16_t near[BLOCK];
} around;

/* others: the places are particles, which are not their own neighbours */
static void look(const sph_sim *sim, const double *p, around *a, uint32_t n, bool others)
{
    const double side = p[SIDE], dx = spacing(p), here = others ? 1e-12 * dx * dx : 0;
    sph_particle q;
    for (uint32_t i = 0; i < n; i++) {
        a->least2[i] = side * side;
        a->near[i] = 0;
    }
    for (uint32_t j = 0; j < sph_count(sim); j++) {
        if (sph_get(sim, j, &q) != SPH_OK)
            continue;
        for (uint32_t i = 0; i < n; i++) {
            double r2 = 0;
            for (int k = 0; k < 2; k++) {
                double d = SCENE_ABS(q.x[k] - a->x[i][k]);
                d = d > 0.5 * side ? side - d : d;
                r2 += d * d;
            }
            if (r2 < here)
                continue;
            a->least2[i] = r2 < a->least2[i] ? r2 : a->least2[i];
            a->near[i] = (uint16_t)(a->near[i] + (r2 < NEAR * NEAR * dx * dx));
        }
    }
}

typedef struct order {
    double nearest_min, nearest_mean;
    double face_centred; /* share of the particles */
    double hole;         /* largest distance of a place from the nearest particle */
} order;

static void order_of_particles(const sph_sim *sim, const double *p, order *o)
{
    const uint32_t count = sph_count(sim);
    double least = 1e300;
    around a;
    sph_particle q;
    for (uint32_t first = 0; first < count; first += BLOCK) {
        const uint32_t n = count - first < BLOCK ? count - first : BLOCK;
        for (uint32_t i = 0; i < n; i++)
            for (int k = 0; k < 2; k++)
                a.x[i][k] = sph_get(sim, first + i, &q) == SPH_OK ? q.x[k] : 0;
        look(sim, p, &a, n, true);
        for (uint32_t i = 0; i < n; i++) {
            least = a.least2[i] < least ? a.least2[i] : least;
            o->nearest_mean += __builtin_sqrt(a.least2[i]) / count;
            o->face_centred += a.near[i] == 6 ? 1.0 / count : 0;
        }
    }
    o->nearest_min = __builtin_sqrt(least);
}

/* on places half a spacing apart, corners of the first cells among them */
static void order_of_holes(const sph_sim *sim, const double *p, order *o)
{
    const uint32_t m = 2 * across(p);
    double most = 0;
    around a;
    for (uint32_t first = 0; first < m * m; first += BLOCK) {
        const uint32_t n = m * m - first < BLOCK ? m * m - first : BLOCK;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t column = (first + i) % m, line = (first + i) / m;
            a.x[i][0] = 0.5 * column * spacing(p);
            a.x[i][1] = 0.5 * line * spacing(p);
        }
        look(sim, p, &a, n, false);
        for (uint32_t i = 0; i < n; i++)
            most = a.least2[i] > most ? a.least2[i] : most;
    }
    o->hole = __builtin_sqrt(most);
}

static const char *const column[] = {"time_cm/c0",    "nearest_min_dx", "nearest_mean_dx", "face_centred_-", "hole_dx",
                                     "kinetic_K.cm2", "stress_mean_K",  "stress_rms_K",    "along_c0",
                                     "across_c0"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const wave w = wave_of(p);
    const double dx = spacing(p), count = sph_count(sim);
    double mean = 0, square = 0, along = 0, over = 0, norm = 0;
    order o = {0};
    sph_totals t;
    sph_particle q;
    sph_get_totals(sim, &t);
    order_of_particles(sim, p, &o);
    order_of_holes(sim, p, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK) {
            const double s = 0.5 * (q.stress[0] + q.stress[1]), c = phase_at(&w, q.x);
            mean += s / count;
            square += s * s / count;
            along += c * (q.v[0] * w.along[0] + q.v[1] * w.along[1]);
            over += c * (q.v[1] * w.along[0] - q.v[0] * w.along[1]);
            norm += c * c;
        }
    row[0] = sph_time(sim);
    row[1] = o.nearest_min / dx;
    row[2] = o.nearest_mean / dx;
    row[3] = o.face_centred;
    row[4] = o.hole / dx;
    row[5] = t.kinetic;
    row[6] = mean;
    row[7] = __builtin_sqrt(square > mean * mean ? square - mean * mean : 0);
    row[8] = norm > 0 ? along / norm : 0;
    row[9] = norm > 0 ? over / norm : 0;
}

#define scene_lattice_box SPH_NAME(scene_lattice_box)
extern const scene scene_lattice_box;
const scene scene_lattice_box = {"lattice_box",
                                 "a periodic box of solid in tension or compression: clumping, plane waves",
                                 param, PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                 history, scene_gray};
#endif
