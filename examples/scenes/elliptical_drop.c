/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* elliptical_drop.c: a disc of water in the flow (-s x, s y) becomes an ellipse of the same area (Monaghan 1994). Exact
   for incompressible water: with semi-axes a along x and b along y, da/dt = -s a, db/dt = s b,
   ds/dt = s^2 (a^2 - b^2)/(a^2 + b^2), and pressure C rho (1 - x^2/a^2 - y^2/b^2), C = s^2 a^2 b^2/(a^2 + b^2). */
#include "scene.h"
#if SPH_DIM == 2

enum { RADIUS = SCENE_COMMON, N, STRAIN, SOUND, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_COMMON_PARAMS(SPH_QUINTIC, 1.5, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_NO_DIFFUSION, SCENE_ADAMI, 1, 0, 0),
    {"radius", "m", "radius of the disc", 1, 1e-4, 1e4, SCENE_NUMBER},
    {"n", "-", "particles in the radius", 40, 4, 4000, SCENE_WHOLE},
    {"strain", "1/s", "strain rate s at the start", 100, 1e-6, 1e6, SCENE_NUMBER},
    {"sound", "radius*strain", "sound speed", 14, 2, 1000, SCENE_NUMBER},
    {"duration", "1/strain", "length of the run", 0.76, 0, 2, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[RADIUS] / p[N]; }
static double sound(const double *p) { return p[SOUND] * p[STRAIN] * p[RADIUS]; }

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), lo[2] = {-p[RADIUS] - dx, -p[RADIUS] - dx}, hi[2] = {-lo[0], -lo[1]};
    *c = scene_config(p, dx, 1000, sound(p));
    for (int k = 0; k < 2; k++) { /* b grows at most as exp(s t) */
        c->hi[k] = k == 0 ? 1.5 * p[RADIUS] : 1.5 * p[RADIUS] * sph_exp(p[DURATION]);
        c->lo[k] = -c->hi[k];
    }
    c->max_particles = scene_capacity(scene_box_count(lo, hi, dx));
}

static void start(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx, s = p[STRAIN], r = p[RADIUS];
    double pressure = 500 * s * s * (r * r - x[0] * x[0] - x[1] * x[1]);
    v[0] = -s * x[0];
    v[1] = s * x[1];
    *rho = scene_density(p, pressure, 1000, sound(p));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double centre[2] = {0, 0};
    double q[PARAMS];
    uint32_t water;
    sph_status st;
    for (int i = 0; i < PARAMS; i++)
        q[i] = p[i]; /* the field's context is not const */
    if ((st = sph_add_fluid(sim, NULL, &water)) != SPH_OK ||
        (st = sph_add_ring(sim, water, centre, 0, p[RADIUS], NULL)) != SPH_OK)
        return st;
    return sph_apply_field(sim, water, start, q);
}

static double end(const double *p) { return p[DURATION] / p[STRAIN]; }

/* s, a, b and their rates */
static void rates(const double *y, double *dy)
{
    double a2 = y[1] * y[1], b2 = y[2] * y[2];
    dy[0] = y[0] * y[0] * (a2 - b2) / (a2 + b2);
    dy[1] = -y[0] * y[1];
    dy[2] = y[0] * y[2];
}

/* classical Runge-Kutta, 400 steps: exact to rounding over the times that the scene allows */
static void exact(const double *p, double t, double *a, double *b)
{
    enum { STEPS = 400 };
    double y[3] = {p[STRAIN], p[RADIUS], p[RADIUS]}, dt = t / STEPS, k[4][3], z[3];
    for (int i = 0; i < STEPS; i++) {
        rates(y, k[0]);
        for (int j = 1; j < 4; j++) {
            for (int c = 0; c < 3; c++)
                z[c] = y[c] + (j == 3 ? 1 : 0.5) * dt * k[j - 1][c];
            rates(z, k[j]);
        }
        for (int c = 0; c < 3; c++)
            y[c] += dt / 6 * (k[0][c] + 2 * k[1][c] + 2 * k[2][c] + k[3][c]);
    }
    *a = y[1];
    *b = y[2];
}

static const char *const column[] = {"time_s", "a_extent_m", "b_extent_m", "a_moment_m", "b_moment_m", "a_exact_m",
                                     "b_exact_m", "area_moment/pi_m^2", "kinetic_J/m", "internal_J/m",
                                     "angular_kgm^2/s/m"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    double mean[2] = {0, 0}, square[2] = {0, 0}, low, high, semi[2];
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK)
            for (int k = 0; k < 2; k++) {
                mean[k] += q.mass * q.x[k];
                square[k] += q.mass * q.x[k] * q.x[k];
            }
    row[0] = sph_time(sim);
    for (uint32_t k = 0; k < 2; k++) {
        sph_extent(sim, k, &low, &high);
        row[1 + k] = 0.5 * (high - low + spacing(p));
        double m = o.mass > 0 ? mean[k] / o.mass : 0, s = o.mass > 0 ? square[k] / o.mass - m * m : 0;
        semi[k] = s > 0 ? 2 * __builtin_sqrt(s) : 0; /* of a full ellipse: <x^2> = a^2/4 */
        row[3 + k] = semi[k];
    }
    exact(p, sph_time(sim), &row[5], &row[6]);
    row[7] = semi[0] * semi[1];
    row[8] = o.kinetic;
    row[9] = o.internal;
    row[10] = o.angular[2];
}

#define scene_elliptical_drop SPH_NAME(scene_elliptical_drop)
extern const scene scene_elliptical_drop;
const scene scene_elliptical_drop = {"elliptical_drop", "a disc of water drawn into an ellipse (Monaghan 1994)", param,
                                     PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                     history, scene_si};
#endif
