/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* csm3.c: CSM3 of Turek & Hron (2006): an elastic beam 35 x 2 cm behind a fixed cylinder of radius 5 cm falls from rest
   under gravity and swings. E 1.4e6, nu 0.4, rho 1000, g 2 in SI units: in those of solid.h, bulk modulus, rho0 and c0
   (48.305 m/s) being 1, mu is 0.21429, g 8.5714e-6 c0^2/cm, and a second is 4830.5 cm/c0. Point A, the middle of the
   free end, swings by 65.16 mm about -63.61 mm, at 1.0995 Hz (their level 4, dt 0.005).
   The clamp is ideal (solid_clamp): held particles stand on the cylinder, and each row of free ones has its own
   spacing, so that it begins a spacing from the cylinder and ends half a spacing from the end. Tensile strains reach
   4 %. Theirs is the material of St Venant and Kirchhoff, ours hypoelastic (Jaumann): the same but for squares of
   strains. */
#include "solid.h"
#if SPH_DIM == 2

enum { GRAVITY = SOLID_COMMON, ACROSS, FACES, SECONDS, PARAMS };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_WENDLAND_C2, 0.8, 0, 0, SPH_KICK_DRIFT_KICK, 0.9, SPH_TOTAL, SPH_PRINCIPAL, 3.0 / 14, 0),
    {"gravity", "c0^2/cm", "gravity", 6e-5 / 7, 0, 1, SCENE_NUMBER},
    {"n", "-", "particles across the beam", 10, 4, 400, SCENE_WHOLE},
    {"faces", "-", "weights of particles beside free faces: equal quadrature", 1, 0, 1, SCENE_CHOICE},
    {"seconds", "s", "length of the run", 2, 0, 1000, SCENE_NUMBER},
};

#define LENGTH 35.0
#define HEIGHT 2.0
#define RADIUS 5.0
#define SECOND 4830.458915396 /* cm/c0: sqrt(7e6/3 Pa/1000 kg/m^3) in cm/s */

static double spacing(const double *p) { return HEIGHT / p[ACROSS]; }
static double columns(const double *p) { return (double)(uint32_t)(LENGTH / spacing(p)); }
/* height of row j; where it begins, on the cylinder; its spacing */
static double row_at(const double *p, double j) { return (j + 0.5) * spacing(p) - 0.5 * HEIGHT; }
static double begins(const double *p, double j)
{
    return __builtin_sqrt(RADIUS * RADIUS - row_at(p, j) * row_at(p, j)) - RADIUS;
}
static double along(const double *p, double j) { return (LENGTH - begins(p, j)) / (columns(p) + 0.5); }

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), way = 13.5 * p[GRAVITY] / (6e-5 / 7), falls = way < LENGTH ? way : LENGTH;
    *c = solid_config(p, dx);
    c->gravity[1] = -p[GRAVITY];
    c->face_quadrature = p[FACES] != 0;
    c->lo[0] = -0.5 - 2 * dx;
    c->hi[0] = LENGTH + 2 * dx;
    c->lo[1] = -0.5 * HEIGHT - falls - 2 * dx;
    c->hi[1] = c->lo[1] + 2 * falls + 1; /* no displacement may exceed half a domain */
    c->hi[1] = c->hi[1] < 0.5 * HEIGHT + 2 * dx ? 0.5 * HEIGHT + 2 * dx : c->hi[1];
    c->max_particles = scene_capacity(p[ACROSS] * (columns(p) + 1));
}

/* columns first .. first + count - 1, 0 being the first free one, from low x; in a column from low y */
static sph_status add_columns(sph_sim *sim, uint32_t set, const double *p, double first, double count)
{
    for (double k = first; k < first + count; k++)
        for (double j = 0; j < p[ACROSS]; j++) {
            const double x[2] = {begins(p, j) + (k + 1) * along(p, j), row_at(p, j)};
            const sph_status st = sph_add_particle(sim, set, x, NULL, 0, NULL);
            if (st)
                return st;
        }
    return SPH_OK;
}

static sph_status build(sph_sim *sim, const double *p)
{
    uint32_t beam, clamp;
    sph_solid m = solid_material(p);
    for (double j = 0; j < p[ACROSS]; j++)
        m.mass += along(p, j) / p[ACROSS] * spacing(p);
    m.flat_faces = p[FACES] != 0;
    sph_status st = sph_add_solid(sim, &m, &beam, NULL);
    m = solid_clamp(&m, 1);
    m.held = 3;
    if (st || (st = sph_add_solid(sim, &m, &clamp, NULL)) || (st = add_columns(sim, beam, p, 0, columns(p))))
        return st;
    return add_columns(sim, clamp, p, -1, 1);
}

static double end(const double *p) { return p[SECONDS] * SECOND; }

static const char *const column[] = {"time_cm/c0",    "seconds_s",     "ux_cm",             "uy_cm",
                                     "kinetic_K.cm2", "elastic_K.cm2", "compression_K.cm2", "energy_cm"};

/* A: half a spacing beyond the last column, by the two last ones; mean of the two rows beside the mid-line */
static void tip(const sph_sim *sim, const double *p, double *at)
{
    const uint32_t n = (uint32_t)p[ACROSS], last = ((uint32_t)columns(p) - 1) * n;
    sph_particle q;
    at[0] = at[1] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.id < last - n || q.id >= last + n)
            continue;
        const uint32_t row = q.id % n;
        const double w = 0.5 * ((row == (n - 1) / 2) + (row == n / 2)) * (q.id < last ? -0.5 : 1.5);
        at[0] += w * q.x[0];
        at[1] += w * q.x[1];
    }
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    double at[2];
    sph_totals o;
    sph_get_totals(sim, &o);
    tip(sim, p, at);
    row[0] = sph_time(sim);
    row[1] = row[0] / SECOND;
    row[2] = at[0] - LENGTH;
    row[3] = at[1];
    row[4] = o.kinetic;
    row[5] = o.elastic;
    row[6] = o.internal;
    row[7] = (o.kinetic + o.elastic + o.internal + o.potential) / (p[GRAVITY] > 0 ? p[GRAVITY] * o.mass : 1);
}

#define scene_csm3 SPH_NAME(scene_csm3)
extern const scene scene_csm3;
const scene scene_csm3 = {"csm3", "elastic beam that swings under gravity (Turek & Hron 2006, CSM3)", param, PARAMS,
                          configure, build, end, sizeof column / sizeof *column, column, history, scene_gray};
#endif
