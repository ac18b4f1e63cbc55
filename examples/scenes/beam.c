/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* beam.c: an elastic beam clamped at both ends that swings in its lowest mode. It reaches from x = 0 to its length.
   Clamps: solid_clamp in solid.h (ideal; columns stand at x = 0, dx' ... length, dx' a little off the spacing across),
   or the regions beyond both faces held as a whole (region). Starts from rest in shape with the velocity of the mode
     V(x) = V_f f(x)/f(L/2), f = cosh bx - cos bx - s (sinh bx - sin bx), cos bL cosh bL = 1, b L = 4.7300,
     s = (cosh bL - cos bL)/(sinh bL - sin bL)
   of a thin beam, whose period is 2 pi/sqrt(mu H^2 b^4/(6 rho (1 - nu))). A beam of finite height swings slower;
   tests/refdata/fe_beam_periods.csv has the periods of plane-strain finite elements. What swings is read as its
   share of that mode, sum m f y/sum m f^2, in which higher modes hardly show. */
#include "solid.h"
#if SPH_DIM == 2

enum { THICK = SOLID_COMMON, LENGTH, SPEED, ACROSS, CLAMP, FACES, CYCLES, PARAMS };
enum { IDEAL, REGION };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_WENDLAND_C2, 0.8, 0, 0, SPH_KICK_DRIFT_KICK, 0.7, SPH_TOTAL, SPH_PRINCIPAL, 0.22, 0),
    {"thick", "cm", "height H", 2, 0.01, 100, SCENE_NUMBER},
    {"length", "cm", "length between the clamps", 20, 0.1, 1000, SCENE_NUMBER},
    {"speed", "c0", "velocity of the middle at the start, V_f", 0.001, -1, 1, SCENE_NUMBER},
    {"n", "-", "particles across the height", 10, 4, 400, SCENE_WHOLE},
    {"clamp", "-", "clamps: ideal region", IDEAL, 0, 1, SCENE_CHOICE},
    {"faces", "-", "weights of particles beside free faces: equal quadrature", 0, 0, 1, SCENE_CHOICE},
    {"cycles", "-", "length of the run in periods of a thin beam", 1.4, 0, 1000, SCENE_NUMBER},
};

#define BETA_L 4.73004074486270

static double spacing(const double *p) { return p[THICK] / p[ACROSS]; }
/* columns that a region needs: what the support reaches */
static double held(const double *p)
{
    return p[CLAMP] == IDEAL ? 1 : (double)(uint32_t)(solid_support(p) + 0.999999);
}
/* free columns, and their spacing */
static double columns(const double *p)
{
    return (double)(uint32_t)(p[LENGTH] / spacing(p) + 0.5) - (p[CLAMP] == IDEAL ? 1 : 0);
}
static double along(const double *p) { return p[LENGTH] / (columns(p) + (p[CLAMP] == IDEAL ? 1 : 0)); }

static double period(const double *p)
{
    const double mu = p[SOLID_MU], b = BETA_L / p[LENGTH], nu = (3 - 2 * mu) / (6 + 2 * mu);
    return 2 * SCENE_PI / __builtin_sqrt(mu * p[THICK] * p[THICK] * b * b * b * b / (6 * (1 - nu)));
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), swings = SCENE_ABS(p[SPEED]) * period(p) / 4;
    *c = solid_config(p, dx);
    c->face_quadrature = p[FACES] != 0;
    c->lo[0] = -(held(p) + 2) * dx;
    c->hi[0] = p[LENGTH] - c->lo[0];
    c->hi[1] = 0.5 * p[THICK] + swings + 4 * dx;
    c->lo[1] = -c->hi[1];
    c->max_particles = scene_capacity(p[ACROSS] * (columns(p) + 2 * held(p)));
}

static double mode(const double *p, double x)
{
    const double up = sph_exp(BETA_L);
    const double s = (0.5 * (up + 1 / up) - sph_cos(BETA_L)) / (0.5 * (up - 1 / up) - sph_sin(BETA_L));
    const double z = BETA_L * x / p[LENGTH], e = sph_exp(z);
    return 0.5 * (e + 1 / e) - sph_cos(z) - s * (0.5 * (e - 1 / e) - sph_sin(z));
}

static void swing(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    (void)rho;
    v[0] = 0;
    v[1] = p[SPEED] * mode(p, x[0]) / mode(p, 0.5 * p[LENGTH]);
}

/* columns first .. first + count - 1 of particles; 0 is the first free one */
static sph_status add_columns(sph_sim *sim, uint32_t set, const double *p, double first, double count)
{
    for (double k = first; k < first + count; k++)
        for (double j = 0; j < p[ACROSS]; j++) {
            const double x[2] = {(k + (p[CLAMP] == IDEAL ? 1 : 0.5)) * along(p),
                                 (j + 0.5) * spacing(p) - 0.5 * p[THICK]};
            const sph_status st = sph_add_particle(sim, set, x, NULL, 0, NULL);
            if (st)
                return st;
        }
    return SPH_OK;
}

static sph_status build(sph_sim *sim, const double *p)
{
    uint32_t beam, clamp;
    double values[PARAMS];
    sph_solid m = solid_material(p);
    for (int k = 0; k < PARAMS; k++)
        values[k] = p[k];
    m.mass = along(p) * spacing(p);
    m.flat_faces = p[FACES] != 0;
    sph_status st = sph_add_solid(sim, &m, &beam, NULL);
    if (p[CLAMP] == IDEAL)
        m = solid_clamp(&m, 1);
    m.held = 3;
    if (st || (st = sph_add_solid(sim, &m, &clamp, NULL)) || (st = add_columns(sim, beam, p, 0, columns(p))) ||
        (st = add_columns(sim, clamp, p, -held(p), held(p))) ||
        (st = add_columns(sim, clamp, p, columns(p), held(p))))
        return st;
    return sph_apply_field(sim, beam, swing, values);
}

static double end(const double *p) { return p[CYCLES] * period(p); }

static const char *const column[] = {"time_cm/c0",        "mode_cm",  "kinetic_K.cm2", "elastic_K.cm2",
                                     "compression_K.cm2", "energy_-", "dissipated_K.cm2"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    sph_totals o;
    sph_particle q;
    double share = 0, whole = 0, start = 0;
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.set == 0) {
            const double f = mode(p, q.x[0]);
            share += f * q.x[1];
            whole += f * f;
        }
    for (double k = 0; k < columns(p); k++) {
        const double f = mode(p, (k + (p[CLAMP] == IDEAL ? 1 : 0.5)) * along(p)) / mode(p, 0.5 * p[LENGTH]);
        start += 0.5 * along(p) * p[THICK] * p[SPEED] * p[SPEED] * f * f;
    }
    row[0] = sph_time(sim);
    row[1] = share / whole * mode(p, 0.5 * p[LENGTH]);
    row[2] = o.kinetic;
    row[3] = o.elastic;
    row[4] = o.internal;
    row[5] = start > 0 ? (o.kinetic + o.elastic + o.internal) / start : 0;
    row[6] = o.dissipated;
}

#define scene_beam SPH_NAME(scene_beam)
extern const scene scene_beam;
const scene scene_beam = {"beam", "elastic beam clamped at both ends that swings", param, PARAMS, configure, build, end,
                          sizeof column / sizeof *column, column, history, scene_gray};
#endif
