/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* plate.c: a plate clamped at one end that swings in its lowest mode (Gray 2001 sections 6.2 and 6.3), elastic or
   plastic. It reaches from x = 0 to its length. The clamp is the face x = 0 (ideal), the region x < 0 held as a whole
   (region), or 8 cm of plate between rows of held particles on both surfaces (surfaces: Gray's clamp).
     A clamp in the region x < 0 lets a displacement vanish where its first centres are, half a spacing and more behind
     the face, which costs the first order of the spacing. The ideal clamp is one row of held particles whose centres
     stand on the face (solid_clamp in solid.h). The free rows begin a spacing from the face and end half a spacing from
     the end, length = (columns + 1/2) dx: their spacing along x is a little off that across.
     Gray's clamp mended in the same way (on_surfaces): held rows stand on both surfaces, and the rows of the plate
     between them are a spacing H/(n + 1) apart, a little less than in front of the clamp.
   Starts from rest in shape with the velocity of the mode
     V(x) = V_f [A (cosh bx - cos bx) + B (sinh bx - sin bx)]/(the same at L), cos bL cosh bL = -1, b L = 1.8751
   of a thin plate, whose period is 2 pi/sqrt(mu H^2 b^4/(6 rho (1 - nu))) (eq 6.3); tests/refdata/fe_plate_periods.csv
   has those of plane-strain finite elements. */
#include "solid.h"
#if SPH_DIM == 2

enum { THICK = SOLID_COMMON, LENGTH, SPEED, ACROSS, CLAMP, FACES, STRETCH, CYCLES, PARAMS };
enum { IDEAL, SURFACES, REGION, ON_SURFACES };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_WENDLAND_C2, 0.8, 0, 0, SPH_KICK_DRIFT_KICK, 0.7, SPH_TOTAL, SPH_PRINCIPAL, 0.22, 0),
    {"thick", "cm", "thickness H", 2, 0.01, 100, SCENE_NUMBER},
    {"length", "cm", "free length", 20, 0.1, 1000, SCENE_NUMBER},
    {"speed", "c0", "velocity of the free end at the start, V_f", 0.01, -1, 1, SCENE_NUMBER},
    {"n", "-", "particles across the thickness", 20, 4, 400, SCENE_WHOLE},
    {"clamp", "-", "clamp: ideal surfaces region on_surfaces", IDEAL, 0, 3, SCENE_CHOICE},
    {"faces", "-", "weights of particles beside free faces: equal quadrature", 0, 0, 1, SCENE_CHOICE},
    {"stretch", "-", "form total: how far a bond may be drawn", 1.3, 1, 8, SCENE_NUMBER},
    {"cycles", "-", "length of the run in periods of a thin plate", 1.3, 0, 1000, SCENE_NUMBER},
};

#define BETA_L 1.87510406871196
#define CLAMP_LENGTH 8.0 /* cm, of Gray's clamp */

static double spacing(const double *p) { return p[THICK] / p[ACROSS]; }
/* rows and columns that a clamp needs: what the support reaches */
static double clamp_rows(const double *p)
{
    return (double)(uint32_t)(solid_support(p) + 0.999999);
}
/* free columns along x, and their spacing */
static double columns(const double *p)
{
    return (double)(uint32_t)(p[LENGTH] / spacing(p) + (p[CLAMP] == IDEAL ? 0 : 0.5));
}
static double along(const double *p) { return p[CLAMP] == IDEAL ? p[LENGTH] / (columns(p) + 0.5) : spacing(p); }
/* where column k, 0 next to the clamp, stands */
static double column_at(const double *p, double k) { return (k + (p[CLAMP] == IDEAL ? 1 : 0.5)) * along(p); }
/* whole spacings that reach at least so far */
static double whole(const double *p, double x) { return (double)(uint32_t)(x / spacing(p) + 0.999) * spacing(p); }

static double period(const double *p)
{
    const double mu = p[SOLID_MU], b = BETA_L / p[LENGTH], nu = (3 - 2 * mu) / (6 + 2 * mu);
    const double w2 = mu * p[THICK] * p[THICK] * b * b * b * b / (6 * (1 - nu));
    return 2 * SCENE_PI / __builtin_sqrt(w2);
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), room = 0.75 * p[LENGTH] + 4 * p[THICK];
    const bool long_clamp = p[CLAMP] == SURFACES || p[CLAMP] == ON_SURFACES;
    const double behind = long_clamp ? whole(p, CLAMP_LENGTH) : clamp_rows(p) * dx;
    *c = solid_config(p, dx);
    c->max_stretch = p[STRETCH];
    c->face_quadrature = p[FACES] != 0;
    c->lo[0] = -behind - 4 * dx;
    c->hi[0] = 1.2 * p[LENGTH] + 4 * dx;
    c->lo[1] = -room;
    c->hi[1] = room;
    const double rows = p[ACROSS] + (p[CLAMP] == SURFACES ? 2 * clamp_rows(p) : long_clamp ? 2 : 0);
    c->max_particles = scene_capacity((p[ACROSS] * (p[LENGTH] + 2 * dx) + rows * (behind + 2 * dx)) / dx);
}

static double mode(const double *p, double x)
{
    const double a = sph_cos(BETA_L) + 0.5 * (sph_exp(BETA_L) + sph_exp(-BETA_L));
    const double b = sph_sin(BETA_L) - 0.5 * (sph_exp(BETA_L) - sph_exp(-BETA_L));
    const double z = BETA_L * x / p[LENGTH], e = sph_exp(z), i = 1 / e;
    return a * (0.5 * (e + i) - sph_cos(z)) + b * (0.5 * (e - i) - sph_sin(z));
}

static void swing(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    (void)rho;
    v[0] = 0;
    v[1] = x[0] > 0 ? p[SPEED] * mode(p, x[0]) / mode(p, p[LENGTH]) : 0;
}

static sph_status add_box(sph_sim *sim, uint32_t set, double x0, double x1, double y0, double y1)
{
    const double lo[2] = {x0, y0}, hi[2] = {x1, y1};
    return sph_add_box(sim, set, lo, hi, NULL);
}

/* rows of particles from low y, each of so many columns from column_at(first) on */
static sph_status add_rows(sph_sim *sim, uint32_t set, const double *p, double first, double count)
{
    sph_status st = SPH_OK;
    for (double j = 0; j < p[ACROSS] && !st; j++)
        for (double k = first; k < first + count && !st; k++) {
            const double x[2] = {column_at(p, k), (j + 0.5) * spacing(p) - 0.5 * p[THICK]};
            st = sph_add_particle(sim, set, x, NULL, 0, NULL);
        }
    return st;
}

/* the clamp and what it holds, clamp first; m: the plate's material */
static sph_status build_ideal(sph_sim *sim, const double *p, sph_solid m)
{
    uint32_t plate, clamp;
    double values[PARAMS];
    for (int k = 0; k < PARAMS; k++)
        values[k] = p[k];
    m.mass = along(p) * spacing(p);
    m.flat_faces = p[FACES] != 0;
    sph_status st = sph_add_solid(sim, &m, &plate, NULL);
    m = solid_clamp(&m, 1);
    m.held = 3;
    if (st || (st = sph_add_solid(sim, &m, &clamp, NULL)) || (st = add_rows(sim, clamp, p, -1, 1)) ||
        (st = add_rows(sim, plate, p, 0, columns(p))))
        return st;
    return sph_apply_field(sim, plate, swing, values);
}

/* Gray's clamp with held rows on the surfaces: the free part, the part between the held rows, the held rows */
static sph_status build_on_surfaces(sph_sim *sim, const double *p, sph_solid m)
{
    const double n = p[ACROSS], dx = spacing(p), dy = p[THICK] / (n + 1), behind = whole(p, CLAMP_LENGTH);
    double values[PARAMS];
    uint32_t plate, part, clamp;
    for (int k = 0; k < PARAMS; k++)
        values[k] = p[k];
    sph_status st = sph_add_solid(sim, &m, &plate, NULL);
    m.mass = dx * dy;
    if (st || (st = sph_add_solid(sim, &m, &part, NULL)))
        return st;
    m = solid_clamp(&m, 1);
    m.held = 3;
    if ((st = sph_add_solid(sim, &m, &clamp, NULL)) ||
        (st = add_box(sim, plate, 0, columns(p) * dx, -0.5 * p[THICK], 0.5 * p[THICK])))
        return st;
    for (int held = 0; held < 2; held++)
        for (double j = held ? 0 : 1; j < (held ? n + 2 : n + 0.5) && !st; j += held ? n + 1 : 1)
            for (double x = 0.5 * dx - behind; x < 0 && !st; x += dx) {
                const double at[2] = {x, j * dy - 0.5 * p[THICK]};
                st = sph_add_particle(sim, held ? clamp : part, at, NULL, 0, NULL);
            }
    return st ? st : sph_apply_field(sim, plate, swing, values);
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double rows = clamp_rows(p) * spacing(p), half = 0.5 * p[THICK], gray = whole(p, CLAMP_LENGTH);
    double values[PARAMS];
    sph_solid m = solid_material(p);
    m.flat_faces = p[FACES] != 0;
    uint32_t plate = 0, clamp = 0;
    if (p[CLAMP] == IDEAL)
        return build_ideal(sim, p, m);
    if (p[CLAMP] == ON_SURFACES)
        return build_on_surfaces(sim, p, m);
    for (int k = 0; k < PARAMS; k++)
        values[k] = p[k];
    sph_status st = sph_add_solid(sim, &m, &plate, NULL);
    m.held = 3;
    if (!st)
        st = sph_add_solid(sim, &m, &clamp, NULL);
    const bool region = p[CLAMP] == REGION;
    const double length = columns(p) * spacing(p);
    if (!st && region)
        st = add_box(sim, clamp, -rows, 0, -half, half);
    if (!st)
        st = add_box(sim, plate, region ? 0 : -gray, length, -half, half);
    for (int side = -1; side < 2 && !region && !st; side += 2)
        st = add_box(sim, clamp, -gray, 0, side < 0 ? -half - rows : half, side < 0 ? -half : half + rows);
    return st ? st : sph_apply_field(sim, plate, swing, values);
}

static double end(const double *p) { return p[CYCLES] * period(p); }

static const char *const column[] = {"time_cm/c0", "tip_cm",       "kinetic_K.cm2", "elastic_K.cm2",
                                     "compression_K.cm2",
                                     "energy_-",   "plastic_K.cm2", "dissipated_K.cm2", "closest_dx"};

/* the middle of the free end: the last column's two particles next to the mid-line */
static double tip(const sph_sim *sim, const double *p)
{
    /* the plate is added before Gray's clamp and after any other, rows from low y, in a row from low x */
    const uint32_t n = (uint32_t)p[ACROSS], held = p[CLAMP] == IDEAL ? 1 : (uint32_t)clamp_rows(p);
    const uint32_t first = p[CLAMP] == SURFACES || p[CLAMP] == ON_SURFACES ? 0 : held * n;
    const uint32_t behind = p[CLAMP] == SURFACES ? (uint32_t)(whole(p, CLAMP_LENGTH) / spacing(p) + 0.5) : 0;
    const uint32_t row = (uint32_t)columns(p) + behind;
    const uint32_t low = first + row * ((n - 1) / 2) + row - 1, high = first + row * (n / 2) + row - 1;
    double y = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK)
            y += (q.id == low ? 0.5 * q.x[1] : 0) + (q.id == high ? 0.5 * q.x[1] : 0);
    return y;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    sph_totals o;
    double start = 0; /* energy at the start: of the mode */
    sph_get_totals(sim, &o);
    for (double k = 0; k < columns(p); k++) {
        const double v = p[SPEED] * mode(p, column_at(p, k)) / mode(p, p[LENGTH]);
        start += 0.5 * along(p) * p[THICK] * v * v;
    }
    row[0] = sph_time(sim);
    row[1] = tip(sim, p);
    row[2] = o.kinetic;
    row[3] = o.elastic;
    row[4] = o.internal;
    row[5] = start > 0 ? (o.kinetic + o.elastic + o.internal + o.plastic_work) / start : 0;
    row[6] = o.plastic_work;
    row[7] = o.dissipated;
    sph_config c;
    configure(p, &c);
    row[8] = solid_closest(sim, &c);
}

#define scene_plate SPH_NAME(scene_plate)
extern const scene scene_plate;
const scene scene_plate = {"plate", "clamped plate that swings, elastic or plastic (Gray 2001 6.2, 6.3)", param,
                           PARAMS, configure, build, end, sizeof column / sizeof *column, column, history, scene_gray};
#endif
