/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* theory.c: see theory.h. Sums over a lattice of vectors r from a particle to its neighbours, W(r), wave vector k,
   spacing 1:
     a_l = sum sin(k.r) d_l W     b_nl = sum (1 - cos(k.r)) d_n d_l W     c_mnl = sum sin(k.r) r_m d_n d_l W
     m0 = -sum r_x d_x W          d_nl = sum (1 - cos(k.r)) |g| r_n r_l/(r^2 + 0.01 h^2),  g = (dW/dr)/r

   Growth. Positions move by U e^(i k.r + s t). Gradient of the displacement -i U_m a'_n, where a' = a (updated) or a/m0
   (corrected, total), so d rho = i rho U.a', and dS is Hooke's and Jaumann's of that gradient. The force is sum m (Q_i
   + Q_j)
   grad W with Q = sigma/rho^2 (updated) or sigma M^-T/rho, M = -sum m x_ij (x) K g = rho m0 at rest:
     s^2 U = -i rho dQ.a + 2 rho Q.b.U                 (total: without b, as K does not change)
     dQ    = d sigma/rho^2 - 2 sigma d rho/rho^3                                            (updated)
     dQ    = d sigma/(rho^2 m0) - sigma d rho/(rho^3 m0) - (sigma/rho) dM^T/(rho m0)^2      (corrected, total)
     dM_mn = -i rho (U_m a_n + c_mnl U_l)              (total: without c)
   which for the updated form is the matrix of tools/dispersion.c; artificial stress and other lattices are taken from
   there.

   Steps. Sums count with the mass of a particle. At no stress positions do not matter. A wave is q = (rho, S;
   or, with summed density, x) and v:
     q' = A v,   v' = B q - D v,   D = alpha h c0 d
   and a step, as kick.h and move.c do it, is
     kick-drift-kick, leap-frog   w = v + dt/2 a_o, q += dt A w, a = B q - D (w + dt/2 a_o), v = w + dt/2 a;
                                  both are the same
     predictor-corrector          q_p = q + dt q'_o, v_p = v + dt a_o, rates (q', a) of these, q = q + dt/2 (q' + q'_o),
                                  v alike;
                                  the rates are kept: one evaluation a step. Water: q_p = q + dt (q'_o + e_o), e = (q' -
                                  q'_o)/2, which is kept too. Summed: x = x + dt v + dt^2/2 a_o is not corrected
     Runge-Kutta, both forms      1 + z + z^2/2, the midpoint rule
   The matrix of a step is squared 22 times: the 2^22nd root of its norm is its largest eigenvalue to 1e-5. */
#define SPH_DIM 2
#define SPH_DOUBLE 1
#include "theory.h"

#include <math.h>
#include <string.h>

#include "sph/sph.h"
#include "tools/dispersion.h"

#define PI 3.14159265358979323846

typedef struct sums {
    double a[2], b[3], c[2][3], d[3], m0; /* symmetric pairs xx, yy, xy */
} sums;

static void add(uint32_t kernel, double h, const double k[2], const double r[2], sums *s)
{
    const double len = sqrt(r[0] * r[0] + r[1] * r[1]), e[2] = {r[0] / len, r[1] / len};
    double w, dw;
    if (len >= h * sph_kernel_support(kernel) || sph_kernel_value(kernel, len, h, &w, &dw) != SPH_OK)
        return;
    const double d2 = kernel_second(kernel, len / h) / (h * h * h * h), g = dw / len;
    const double phase = k[0] * r[0] + k[1] * r[1], odd = sin(phase), half = sin(0.5 * phase), even = 2 * half * half;
    for (int i = 0; i < 3; i++) {
        const double ee = i < 2 ? e[i] * e[i] : e[0] * e[1], across = i < 2 ? 1 - ee : -ee,
            second = d2 * ee + g * across;
        s->b[i] += even * second;
        for (int m = 0; m < 2; m++)
            s->c[m][i] += odd * r[m] * second;
        s->d[i] += even * fabs(g) * ee * len * len / (len * len + 0.01 * h * h);
    }
    for (int i = 0; i < 2; i++)
        s->a[i] += odd * dw * e[i];
    s->m0 -= r[0] * dw * e[0];
}

static sums square_sums(uint32_t kernel, double h, const double k[2])
{
    const int reach = (int)ceil(h * sph_kernel_support(kernel));
    sums s = {0};
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++) {
            const double r[2] = {i, j};
            if (i || j)
                add(kernel, h, k, r, &s);
        }
    return s;
}

/* ---- growth ---- */

static int pair_of(int m, int n) { return m == n ? m : 2; }

/* column l of the matrix of s^2: every quantity below is i times a real one, which stands here */
static void growth_column(const theory_box *b, const sums *s, int l, double out[2])
{
    const bool plain = b->form == SPH_UPDATED, total = b->form == SPH_TOTAL;
    const double sigma = b->volume - 1, m0 = plain ? 1 : s->m0, u[2] = {l == 0, l == 1};
    double grad[2][2], dq[2][2];
    for (int m = 0; m < 2; m++)
        for (int n = 0; n < 2; n++)
            grad[m][n] = -u[m] * s->a[n] / m0;
    const double trace = grad[0][0] + grad[1][1], d_rho = -trace;
    for (int m = 0; m < 2; m++)
        for (int n = 0; n < 2; n++) {
            const double strain = 0.5 * (grad[m][n] + grad[n][m]) - (m == n ? trace / 3 : 0);
            const double ds = 2 * b->mu * strain - (m == n ? d_rho : 0);
            const double dm = -(u[n] * s->a[m] + (total ? 0 : s->c[n][pair_of(m, l)])); /* of M_nm: transposed */
            dq[m][n] = plain ? ds - (m == n ? 2 * sigma * d_rho : 0)
                             : ds / m0 - (m == n ? sigma * d_rho / m0 : 0) - sigma * dm / (m0 * m0);
        }
    for (int m = 0; m < 2; m++) {
        out[m] = dq[m][0] * s->a[0] + dq[m][1] * s->a[1];
        if (!total)
            out[m] += 2 * sigma / m0 * s->b[pair_of(m, l)];
    }
}

void theory_modes(const theory_box *b, const double k[2], double value[2], bool *complex_pair)
{
    if (b->form == SPH_UPDATED && (b->epsilon > 0 || b->lattice != LATTICE_SQUARE)) {
        const elastic_state e = {.rho = 1, .c = 1, .mu = b->mu, .pressure = 1 - b->volume, .epsilon = b->epsilon,
                                 .n = b->exponent};
        wave_modes w;
        lattice_waves(&e, b->kernel, b->lattice, b->h, 1, k, &w);
        value[0] = -w.omega2[0];
        value[1] = w.imag != 0 ? w.imag : -w.omega2[1];
        *complex_pair = w.imag != 0;
        return;
    }
    const sums s = square_sums(b->kernel, b->h, k);
    double x[2], y[2];
    growth_column(b, &s, 0, x);
    growth_column(b, &s, 1, y);
    const double mean = 0.5 * (x[0] + y[1]), diff = 0.5 * (x[0] - y[1]), disc = diff * diff + y[0] * x[1];
    const double scale = fabs(x[0]) + fabs(y[1]) + fabs(x[1]) + fabs(y[0]);
    *complex_pair = disc < -1e-20 * scale * scale;
    value[0] = *complex_pair ? mean : mean + sqrt(disc > 0 ? disc : 0);
    value[1] = *complex_pair ? sqrt(-disc) : mean - sqrt(disc > 0 ? disc : 0);
}

double theory_growth(const theory_box *b)
{
    double most = 0;
    for (uint32_t i = 0; i < b->n; i++)
        for (uint32_t j = 0; j <= b->n / 2; j++) {
            const double k[2] = {2 * PI * i / b->n, 2 * PI * j / b->n};
            double v[2];
            bool both;
            if (i == 0 && j == 0)
                continue;
            theory_modes(b, k, v, &both);
            const double root = both ? sqrt(0.5 * (sqrt(v[0] * v[0] + v[1] * v[1]) + v[0])) : sqrt(fmax(0, fmax(v[0],
                v[1])));
            most = root > most ? root : most;
        }
    return most;
}

/* ---- steps ---- */

enum { Q = 4, V = 2, ONE = Q + V, SIZE = 2 * ONE + 1 };
typedef double matrix[SIZE][SIZE];

/* y' = f y for y = (q, v) */
static void rates(const theory_step *t, const sums *s, double f[ONE][ONE])
{
    const double m0 = t->medium == THEORY_CORRECTED ? s->m0 : 1 / t->mass, a[2] = {s->a[0] / m0, s->a[1] / m0};
    memset(f, 0, sizeof(double) * ONE * ONE);
    for (int l = 0; l < 2; l++) {
        if (t->medium == THEORY_SUMMED) { /* q: x */
            f[l][Q + l] = 1;
            for (int m = 0; m < 2; m++)
                f[Q + m][l] = -a[m] * a[l];
        } else { /* q: rho, and Sxx, Syy, Sxy */
            f[0][Q + l] = a[l];
            f[Q + l][0] = -a[l];
        }
        if (t->medium >= THEORY_UPDATED) {
            f[1][Q + l] = -2 * t->mu * ((l == 0) * a[0] - a[l] / 3);
            f[2][Q + l] = -2 * t->mu * ((l == 1) * a[1] - a[l] / 3);
            f[3][Q + l] = -t->mu * a[1 - l];
            f[Q + l][1 + l] = a[l];
            f[Q + l][3] = a[1 - l];
        }
        for (int m = 0; m < 2; m++)
            f[Q + m][Q + l] = -t->alpha * t->h * t->mass * s->d[pair_of(m, l)];
    }
}

/* state (y, y'): of y' only the acceleration is kept */
static void leap(double f[ONE][ONE], double dt, matrix g)
{
    for (int i = 0; i < SIZE; i++) {
        double y[ONE], w[V], *v = y + Q;
        for (int k = 0; k < ONE; k++)
            y[k] = i == k;
        for (int k = 0; k < V; k++)
            w[k] = v[k] + (i == ONE + Q + k ? 0.5 * dt : 0);
        for (int q = 0; q < Q; q++)
            for (int k = 0; k < V; k++)
                y[q] += dt * f[q][Q + k] * w[k];
        for (int k = 0; k < V; k++) { /* for viscosity, the velocity of the end */
            double a = 0;
            for (int m = 0; m < Q; m++)
                a += f[Q + k][m] * y[m];
            for (int m = 0; m < V; m++)
                a += f[Q + k][Q + m] * (w[m] + (i == ONE + Q + m ? 0.5 * dt : 0));
            g[ONE + Q + k][i] = a;
            g[Q + k][i] = w[k] + 0.5 * dt * a;
        }
        for (int q = 0; q < Q; q++) {
            g[q][i] = y[q];
            g[ONE + q][i] = 0;
        }
        g[SIZE - 1][i] = 0;
    }
}

static void midpoint(double f[ONE][ONE], double dt, matrix g)
{
    for (int i = 0; i < ONE; i++)
        for (int j = 0; j < ONE; j++) {
            double two = 0;
            for (int m = 0; m < ONE; m++)
                two += f[i][m] * f[m][j];
            g[i][j] = (i == j) + dt * f[i][j] + 0.5 * dt * dt * two;
        }
}

/* state (y, y', e); `foresees`: e is kept */
static void predict_correct(double f[ONE][ONE], double dt, bool summed, bool foresees, matrix g)
{
    for (int i = 0; i < SIZE; i++) {
        double y[ONE], old[ONE], p[ONE];
        for (int k = 0; k < ONE; k++) {
            y[k] = i == k;
            old[k] = i == ONE + k;
            p[k] = y[k] + dt * old[k] + (k == 0 && foresees && i == SIZE - 1 ? dt : 0);
        }
        for (int k = 0; k < 2 && summed; k++) /* positions follow the velocity itself */
            p[k] = y[k] + dt * y[Q + k] + 0.5 * dt * dt * old[Q + k];
        for (int k = 0; k < ONE; k++) {
            double now = 0;
            for (int m = 0; m < ONE; m++)
                now += f[k][m] * p[m];
            g[ONE + k][i] = now;
            g[k][i] = summed && k < 2 ? p[k] : y[k] + 0.5 * dt * (now + old[k]);
            if (k == 0)
                g[SIZE - 1][i] = foresees ? 0.5 * (now - old[k]) : 0;
        }
    }
}

/* largest eigenvalue by squaring */
static double radius(matrix g, int size)
{
    double log_norm = 0;
    for (int turn = 0;; turn++) {
        double norm = 0;
        matrix two;
        for (int i = 0; i < size; i++)
            for (int j = 0; j < size; j++)
                norm = fabs(g[i][j]) > norm ? fabs(g[i][j]) : norm;
        if (!(norm > 0))
            return 0;
        log_norm += log(norm) / ldexp(1, turn);
        if (turn == 22)
            return exp(log_norm);
        for (int i = 0; i < size; i++)
            for (int j = 0; j < size; j++)
                g[i][j] /= norm;
        for (int i = 0; i < size; i++)
            for (int j = 0; j < size; j++) {
                two[i][j] = 0;
                for (int m = 0; m < size; m++)
                    two[i][j] += g[i][m] * g[m][j];
            }
        memcpy(g, two, sizeof two);
    }
}

double theory_factor(const theory_step *t, double dt)
{
    double most = 0;
    for (uint32_t i = 1; i <= t->n / 2; i++)
        for (uint32_t j = 0; j <= i; j++) { /* the others are mirrored */
            const double k[2] = {2 * PI * i / t->n, 2 * PI * j / t->n};
            const sums s = square_sums(t->kernel, t->h, k);
            double f[ONE][ONE];
            matrix g;
            rates(t, &s, f);
            const bool leaps = t->integrator == SPH_KICK_DRIFT_KICK || t->integrator == SPH_LEAP_FROG;
            const bool keeps = leaps || t->integrator == SPH_PREDICTOR_CORRECTOR;
            if (!leaps && keeps)
                predict_correct(f, dt, t->medium == THEORY_SUMMED, t->medium == THEORY_WATER, g);
            else if (leaps)
                leap(f, dt, g);
            else
                midpoint(f, dt, g);
            const double r = radius(g, keeps ? SIZE : ONE);
            most = r > most ? r : most;
        }
    return most;
}

double theory_limit(const theory_step *t)
{
    double low = 1e-3, high = 10;
    while (high / low > 1.0001) {
        const double dt = sqrt(low * high);
        if (theory_factor(t, dt) > 1.00005)
            high = dt;
        else
            low = dt;
    }
    return low;
}
