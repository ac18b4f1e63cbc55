/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* pulse.c: a longitudinal elastic wave on a periodic sheet (Gray 2001, section 5.6.1). The velocity
   v_x = V exp(-((x - L/2)/w)^2) of an unstrained sheet parts into two pulses of V/2 that travel apart. (His exponent
   lacks the minus sign.)

   Small waves travel at c_l = sqrt(c0^2 + 4 mu/(3 rho)). His V is not small: the pulse to the right is a compression
   and the other one a rarefaction, and where they no longer overlap each is a simple wave, whose crest keeps v = V/2
   and travels at
     v + c_l(rho) to the right, v - c_l(rho) to the left, with +-v = integral of c_l drho/rho from rho0
   while its front steepens (or its back). Both are in the history as exact positions. From t = L/(4 c_l) on the pulses
   are nearer to each other across the seam; they meet there at L/(2 c_l) and pass each other. */
#include "solid.h"
#if SPH_DIM == 2

enum { LENGTH = SOLID_COMMON, HEIGHT, N, VELOCITY, WIDTH, LATTICE, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_CUBIC, 1.5, 0.02, 0, SPH_KICK_DRIFT_KICK, 0.25, SPH_UPDATED, SPH_NO_ARTIFICIAL_STRESS, 0.22, 0),
    {"length", "cm", "length of the sheet, along x", 200, 1e-4, 1e6, SCENE_NUMBER},
    {"height", "-", "particles across the sheet; an odd number counts as the next lower", 40, 8, 4000, SCENE_WHOLE},
    {"n", "-", "particles along the sheet; an odd number counts as the next lower", 400, 50, 100000, SCENE_WHOLE},
    {"velocity", "c0", "largest velocity at the start", 0.05, 1e-6, 0.2, SCENE_NUMBER},
    {"width", "length", "w of the pulse", 0.05, 0.005, 0.1, SCENE_NUMBER},
    {"lattice", "-", "lattice: square shifted_x shifted_y", SPH_LATTICE_SQUARE, 0, 2, SCENE_CHOICE},
    {"duration", "L/c_l", "length of the run; after 1 the pulses are back in the middle", 0.4, 0, 1000, SCENE_NUMBER},
};

static double even(double n)
{
    const uint32_t half = (uint32_t)n / 2;
    return 2.0 * half;
}
static double spacing(const double *p) { return p[LENGTH] / even(p[N]); }
static double width(const double *p) { return p[WIDTH] * p[LENGTH]; }
static double speed_at(const double *p, double rho) { return __builtin_sqrt(1 + 4 * p[SOLID_MU] / (3 * rho)); }

/* velocity at which the crest of the pulse travels that goes to the right (sign 1) or left (-1) */
static double crest_speed(const double *p, double sign)
{
    const int steps = 64;
    const double v = 0.5 * p[VELOCITY] / steps;
    double rho = 1;
    for (int i = 0; i < steps; i++) { /* midpoint rule for drho/dv = +-rho/c_l */
        const double middle = rho + 0.5 * sign * v * rho / speed_at(p, rho);
        rho += sign * v * middle / speed_at(p, middle);
    }
    return 0.5 * p[VELOCITY] + sign * speed_at(p, rho);
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), size[2] = {p[LENGTH], even(p[HEIGHT]) * dx};
    *c = solid_config(p, dx);
    for (int k = 0; k < 2; k++) {
        c->hi[k] = size[k];
        c->face[k][0] = c->face[k][1] = SPH_PERIODIC;
    }
    c->max_particles = scene_capacity(even(p[N]) * even(p[HEIGHT]));
}

static void field(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    const double s = (x[0] - 0.5 * p[LENGTH]) / width(p);
    (void)rho;
    v[0] = p[VELOCITY] * sph_exp(-(s * s));
    v[1] = 0;
}

static sph_status build(sph_sim *sim, const double *p)
{
    const sph_solid m = solid_material(p);
    const sph_shape s = {.hi = {p[LENGTH], even(p[HEIGHT]) * spacing(p)}, .lattice = (uint32_t)p[LATTICE]};
    double values[PARAMS];
    uint32_t set;
    sph_status st;
    for (int k = 0; k < PARAMS; k++)
        values[k] = p[k];
    if ((st = sph_add_solid(sim, &m, &set, NULL)) != SPH_OK || (st = sph_add_shape(sim, set, &s)) != SPH_OK)
        return st;
    return sph_apply_field(sim, set, field, values);
}

static double end(const double *p) { return p[DURATION] * p[LENGTH] / speed_at(p, 1); }

/* ---- history: a pulse's crest and its width at half its height ---- */

/* x less `from`, the nearest way round */
static double apart(const double *p, double x, double from)
{
    double d = x - from;
    d -= p[LENGTH] * (double)(int64_t)(d / p[LENGTH]);
    return d > 0.5 * p[LENGTH] ? d - p[LENGTH] : d < -0.5 * p[LENGTH] ? d + p[LENGTH] : d;
}

/* Least squares of v_x around `at` by a cubic in s = (x - at)/reach, |s| < 1, with weights that fall to 0 at the ends,
   so that it does not matter which particles are just inside: moves `at` to its maximum (at most half a reach) and
   gives the value there. */
static double fit_crest(const sph_sim *sim, const double *p, double reach, double *at)
{
    double a[4][5] = {{0}};
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK)
            continue;
        const double s = apart(p, q.x[0], *at) / reach, f[4] = {1, s, s * s, s * s * s};
        for (int k = 0; k < 4 && SCENE_ABS(s) < 1; k++) {
            const double weight = (1 - s * s) * (1 - s * s) * f[k];
            for (int l = 0; l < 4; l++)
                a[k][l] += weight * f[l];
            a[k][4] += weight * q.v[0];
        }
    }
    for (int k = 0; k < 4; k++) /* the matrix is positive definite */
        for (int r = 0; r < 4; r++) {
            const double factor = r == k || !(a[k][k] > 0) ? 0 : a[r][k] / a[k][k];
            for (int l = k; l < 5; l++)
                a[r][l] -= factor * a[k][l];
        }
    double c[4], s = 0;
    for (int k = 0; k < 4; k++)
        c[k] = a[k][k] > 0 ? a[k][4] / a[k][k] : 0;
    for (int turn = 0; turn < 20; turn++) { /* Newton's steps to where the slope is 0 */
        const double bend = 2 * c[2] + 6 * c[3] * s, step = bend < 0 ? -(c[1] + 2 * c[2] * s + 3 * c[3] * s *
            s) / bend : 0;
        s = s + step > 0.5 ? 0.5 : s + step < -0.5 ? -0.5 : s + step;
    }
    *at += s * reach;
    return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
}

/* place of the particle of largest v_x nearer to `at` than to `other`, where the other pulse is, or within half of w */
static double fastest(const sph_sim *sim, const double *p, double at, double other)
{
    const double half = 0.5 * SCENE_ABS(apart(p, at, other)), near = 0.5 * width(p), side = half > near ? half : near;
    double most = -1e300, x = at;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && SCENE_ABS(apart(p, q.x[0], at)) < side && q.v[0] > most) {
            most = q.v[0];
            x = at + apart(p, q.x[0], at);
        }
    return x;
}

/* width at half of `height` around `at`, straight between the means of bins a quarter of w wide; 0 if it ends
   nowhere */
#define BINS 33
static double half_width(const sph_sim *sim, const double *p, double at, double height)
{
    const double bin = 0.25 * width(p);
    double v[BINS] = {0}, n[BINS] = {0}, side[2] = {0, 0};
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK)
            continue;
        const double s = apart(p, q.x[0], at) / bin + 0.5 * BINS;
        if (s >= 0 && s < BINS) {
            v[(int)s] += q.v[0];
            n[(int)s]++;
        }
    }
    for (int k = 0; k < BINS; k++)
        v[k] = n[k] > 0 ? v[k] / n[k] : 0;
    for (int d = 0; d < 2; d++)
        for (int k = BINS / 2, next; k > 0 && k < BINS - 1 && !(side[d] > 0); k = next) {
            next = d ? k + 1 : k - 1;
            if (v[next] < 0.5 * height && v[k] >= 0.5 * height)
                side[d] = SCENE_ABS(k - BINS / 2) + (v[k] - 0.5 * height) / (v[k] - v[next]);
        }
    return side[0] > 0 && side[1] > 0 ? (side[0] + side[1]) * bin : 0;
}

static const char *const column[] = {"time_cm/c0",     "right_x_cm",    "left_x_cm",     "right_exact_cm",
                                     "left_exact_cm",
                                     "right_small_cm", "left_small_cm", "right_v_c0",    "left_v_c0",
                                     "right_width_cm",
                                     "left_width_cm",  "kinetic_K.cm2", "elastic_K.cm2", "compression_K.cm2",
                                     "dissipated_K.cm2"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim), middle = 0.5 * p[LENGTH], reach = 0.5 * width(p);
    sph_totals o;
    sph_get_totals(sim, &o);
    row[0] = t;
    for (int k = 0; k < 2; k++) { /* positions are not brought back into the sheet */
        const double sign = k ? -1 : 1, gone = sign * speed_at(p, 1) * t, small = middle + gone;
        double at = fastest(sim, p, small, middle - gone), v = 0;
        for (int turn = 0; turn < 3; turn++)
            v = fit_crest(sim, p, reach, &at);
        row[1 + k] = at;
        row[3 + k] = middle + crest_speed(p, sign) * t;
        row[5 + k] = small;
        row[7 + k] = v;
        row[9 + k] = half_width(sim, p, at, v);
    }
    row[11] = o.kinetic;
    row[12] = o.elastic;
    row[13] = o.internal;
    row[14] = o.dissipated;
}

#define scene_pulse SPH_NAME(scene_pulse)
extern const scene scene_pulse;
const scene scene_pulse = {"pulse", "a longitudinal elastic wave on a periodic sheet", param, PARAMS, configure, build,
                           end,
                           sizeof column / sizeof *column, column, history, scene_gray};
#endif
