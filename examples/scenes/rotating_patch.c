/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* rotating_patch.c: a square of water that turns, without gravity and walls (Colagrossi 2005; Le Touze et al. 2013):
   its corners grow into arms, and inside pressure is negative. Starts with the pressure of incompressible water turning
   as a whole, laplace p = 2 rho w^2 and 0 on the rim. */
#include "scene.h"
#if SPH_DIM == 2

enum { SIDE = SCENE_COMMON, N, OMEGA, SOUND, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_SHIFTED(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.005, SPH_MOLTENI, SCENE_ADAMI, 1, 0, 1,
                         SPH_KICK_DRIFT_KICK, 1, 0, 0.1, 0.5),
    {"side", "m", "side of the square", 1, 1e-4, 1e4, SCENE_NUMBER},
    {"n", "-", "particles along a side", 60, 4, 2000, SCENE_WHOLE},
    {"omega", "1/s", "angular velocity w", 1, 1e-6, 1e6, SCENE_NUMBER},
    {"sound", "side*omega", "sound speed", 10, 2, 1000, SCENE_NUMBER},
    {"duration", "1/omega", "length of the run", 2, 0, 10, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[SIDE] / p[N]; }
static double sound(const double *p) { return p[SOUND] * p[OMEGA] * p[SIDE]; }

static void configure(const double *p, sph_config *c)
{
    *c = scene_config(p, spacing(p), 1000, sound(p));
    for (int k = 0; k < 2; k++) { /* a particle flies on at w side/sqrt 2 at most */
        c->hi[k] = p[SIDE] * (0.8 + 0.75 * p[DURATION]);
        c->lo[k] = -c->hi[k];
    }
    c->max_particles = scene_capacity(p[N] * p[N]);
}

/* pressure over rho w^2 side^2 at x, y from the middle, in sides */
static double pressure(double x, double y)
{
    double sum = 0;
    for (int m = 1; m < 60; m += 2)
        for (int n = 1; n < 60; n += 2)
            sum -= 32 / (m * n * SCENE_PI * SCENE_PI * SCENE_PI * SCENE_PI * (m * m + n * n)) *
                   sph_sin(m * SCENE_PI * (x + 0.5)) * sph_sin(n * SCENE_PI * (y + 0.5));
    return sum;
}

static void start(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx, w = p[OMEGA], l = p[SIDE];
    v[0] = w * x[1];
    v[1] = -w * x[0];
    *rho = scene_density(p, 1000 * w * w * l * l * pressure(x[0] / l, x[1] / l), 1000, sound(p));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[2] = {-0.5 * p[SIDE], -0.5 * p[SIDE]}, hi[2] = {0.5 * p[SIDE], 0.5 * p[SIDE]};
    double q[PARAMS];
    uint32_t water;
    sph_status st;
    for (int i = 0; i < PARAMS; i++)
        q[i] = p[i]; /* the field's context is not const */
    if ((st = sph_add_fluid(sim, NULL, &water)) != SPH_OK || (st = sph_add_box(sim, water, lo, hi, NULL)) != SPH_OK)
        return st;
    return sph_apply_field(sim, water, start, q);
}

static double end(const double *p) { return p[DURATION] / p[OMEGA]; }

/* least distance of two particles, in spacings; looked for along the order of the arrays, which is that of cells */
static double nearest(const sph_sim *sim, double dx)
{
    const uint32_t n = sph_count(sim);
    double least = 1e300;
    sph_particle a, b;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = i + 1; j < n && sph_get(sim, i, &a) == SPH_OK && sph_get(sim, j, &b) == SPH_OK; j++) {
            const double x = a.x[0] - b.x[0], y = a.x[1] - b.x[1], r2 = x * x + y * y;
            least = r2 < least ? r2 : least;
        }
    return __builtin_sqrt(least) / dx;
}

static const char *const column[] = {"time_s", "turned_rad", "nearest_dx", "arm_side", "pressure_middle_rho.w2.side2",
                                     "pressure_start_exact_rho.w2.side2", "pressure_least_rho.w2.side2",
                                     "angular_of_start_-", "kinetic_J", "internal_J", "dissipated_J", "balance_J"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double unit = 1000 * p[OMEGA] * p[OMEGA] * p[SIDE] * p[SIDE], middle[2] = {0, 0};
    /* what the lattice has at the start: m w sum r^2 */
    const double turn = -1000 * p[OMEGA] * p[SIDE] * p[SIDE] * p[SIDE] * p[SIDE] / 6 * (1 - 1 / (p[N] * p[N]));
    double arm = 0, least = 0;
    sph_probe_value v;
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK) {
            const double r2 = q.x[0] * q.x[0] + q.x[1] * q.x[1];
            arm = r2 > arm ? r2 : arm;
            least = q.p < least ? q.p : least;
        }
    row[0] = sph_time(sim);
    row[1] = sph_time(sim) * p[OMEGA];
    row[2] = nearest(sim, spacing(p));
    row[3] = __builtin_sqrt(arm) / p[SIDE];
    row[4] = sph_probe(sim, middle, &v) == SPH_OK ? v.p / unit : 0;
    row[5] = pressure(0, 0);
    row[6] = least / unit;
    row[7] = o.angular[2] / turn;
    row[8] = o.kinetic;
    row[9] = o.internal;
    row[10] = o.dissipated;
    row[11] = o.balance;
}

#define scene_rotating_patch SPH_NAME(scene_rotating_patch)
extern const scene scene_rotating_patch;
const scene scene_rotating_patch = {"rotating_patch", "a turning square of water (Colagrossi 2005)", param, PARAMS,
                                    configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
