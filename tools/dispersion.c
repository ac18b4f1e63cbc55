/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dispersion.c: plane waves on a lattice of SPH particles (see dispersion.h; Gray 2001, section 5.6 and appendix B).

   Linearised: r_a = ra0 + X e^(i k.r - i w t), v = V e^..., D of density, T of deviatoric stress, u = smoothed velocity
   (1 - xsph beta) V, m = rho dp^2. Sums over an even lattice leave
     X = i u/w,   D = -(rho/w) a.u,   gradient L_ij = d_j v_i = -i a_j u_i
     T_xx = (2 mu/3 w)(2 u_x a_x - u_y a_y),  T_yy likewise,  T_xy = (1/w)[mu (a_y u_x + a_x u_y) + z (a_y u_x - a_x
     u_y)]
   with z = (S_yy - S_xx)/2 (Jaumann rate), and from the momentum equation w^2 V = K u with, of the term sigma/rho^2,
     K_il = -(2/rho) sigma_ij b_jl  +  [c^2 delta_ij + (2/rho) sigma_ij] a_j a_l  +  (w/rho) T_ij a_j / u_l
   and of the artificial stress
     K_il = -2 rho R_ij f_jl  +  w rho dR_ij g_j / u_l
   (sums over j). a -> -k, b_ij -> k_i k_j, beta -> 0 for long waves gives the exact equations.

   Where the printed equations differ from these:
     5.46, 5.47  the rest of the section follows with zeta = (S_xx - S_yy)/2: tension along a wave's path raises the
                 frequency of the transverse one (5.53 as printed lowers it). Here z = -zeta throughout.
     5.49, 5.50  Gamma is a product of two squares and must be positive
     5.61, B.59  signs of the mu terms (B.58 has them right)
     5.62, B.72  zeta as above
     5.66, 5.69  the artificial stress enters with a minus sign (5.71 has it), and (1 - beta) only once
     5.76, 5.77  the factor 2 belongs to the stress term alone, R carries rho^2, A_x^2 (mu + zeta) carries (1 -
     beta)/rho
     5.65        R is taken as constant; it changes with the wave (g, dR above) unless `frozen`. */
#define SPH_DIM 2
#define SPH_DOUBLE 1
#include "dispersion.h"

#include <math.h>
#include <string.h>

#include "../sph/sph.h"

const char *const lattice_names[LATTICES + 1] = {"square", "shifted_x", "shifted_y", NULL};
const char *const dispersion_kernels[] = {"cubic",       "quartic",     "quintic", "gaussian",
                                          "wendland_c2", "wendland_c4", "hat",     NULL};

/* ---- kernels ---- */

static double above(double edge, double q) { return q < edge ? edge - q : 0; }

/* second derivative in q of the shapes of sph/kernels.h, and their value at 0, which is how they are normalised here */
static double shape_second(uint32_t kernel, double q, double *at_zero)
{
    const double t = 0.5 * q, u = above(1, t);
    double a, b, c;
    switch (kernel) {
    case SPH_CUBIC:
        *at_zero = 4;
        return 6 * above(2, q) - 24 * above(1, q);
    case SPH_QUARTIC:
        *at_zero = 14.375;
        a = above(2.5, q), b = above(1.5, q), c = above(0.5, q);
        return 12 * a * a - 60 * b * b + 120 * c * c;
    case SPH_QUINTIC:
        *at_zero = 66;
        a = above(3, q), b = above(2, q), c = above(1, q);
        return 20 * a * a * a - 120 * b * b * b + 300 * c * c * c;
    case SPH_GAUSSIAN:
        *at_zero = 1;
        return q < 3 ? (4 * q * q - 2) * exp(-q * q) : 0;
    case SPH_WENDLAND_C2:
        *at_zero = 1;
        return -5 * u * u * (1 - 4 * t);
    case SPH_WENDLAND_C4:
        *at_zero = 3;
        return -14 * u * u * u * u * (1 + t * (4 - 35 * t));
    default: /* the hat: straight */
        *at_zero = 1;
        return 0;
    }
}

double kernel_second(uint32_t kernel, double q)
{
    double w, dw, at_zero;
    const double second = shape_second(kernel, q, &at_zero);
    return sph_kernel_value(kernel, 0, 1, &w, &dw) == SPH_OK ? second * w / at_zero : 0;
}

/* ---- sums ---- */

/* one neighbour at (x, y) */
static void add_pair(uint32_t kernel, double h, double n, double w_dp, const double k[2], double x, double y,
                     lattice_sums *s)
{
    const double r = sqrt(x * x + y * y), e[2] = {x / r, y / r};
    double w, dw;
    if (r >= h * sph_kernel_support(kernel) || sph_kernel_value(kernel, r, h, &w, &dw) != SPH_OK || !(w > 0))
        return;
    const double d2 = kernel_second(kernel, r / h) / (h * h * h * h), slope = dw / r;
    const double phase = k[0] * x + k[1] * y, odd = sin(phase), half = sin(0.5 * phase), even = 2 * half * half;
    const double f = pow(w / w_dp, n), along = d2 + n * dw * dw / w; /* d_j(f^n d_i W)/f^n along r; across it slope */
    s->beta += even * w;
    for (int i = 0; i < 3; i++) {
        const double ee = i < 2 ? e[i] * e[i] : e[0] * e[1], across = i < 2 ? 1 - ee : -ee;
        s->b[i] += even * (d2 * ee + slope * across);
        s->f[i] += even * f * (along * ee + slope * across);
    }
    for (int i = 0; i < 2; i++) {
        s->a[i] += odd * dw * e[i];
        s->g[i] += odd * f * dw * e[i];
    }
}

void lattice_sum(uint32_t kernel, uint32_t lattice, double h_dp, double n, const double k[2], lattice_sums *out)
{
    const int reach = (int)ceil(h_dp * sph_kernel_support(kernel)) + 1;
    double w_dp, dw;
    memset(out, 0, sizeof *out);
    if (sph_kernel_value(kernel, 1, h_dp, &w_dp, &dw) != SPH_OK)
        return;
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            if (i || j)
                add_pair(kernel, h_dp, n, w_dp, k, i + (lattice == LATTICE_SHIFTED_X && j % 2 ? 0.5 : 0),
                         j + (lattice == LATTICE_SHIFTED_Y && i % 2 ? 0.5 : 0), out);
}

/* ---- waves ---- */

/* w T/i of a unit velocity along axis l; pairs xx, yy, xy */
static void stress_of(const elastic_state *e, const double a[2], int l, double t[3])
{
    const double z = 0.5 * (e->s[1] - e->s[0]), m = 2 * e->mu / 3;
    t[0] = m * (l == 0 ? 2 * a[0] : -a[1]);
    t[1] = m * (l == 1 ? 2 * a[1] : -a[0]);
    t[2] = l == 0 ? (e->mu + z) * a[1] : (e->mu - z) * a[0];
}

/* artificial stress of the state, and how it changes with sigma/rho^2: dR_ii = gain[i] d_ii, dR_xy = gain[2] d_xy */
static void artificial(const elastic_state *e, const double sigma[2], double r[2], double gain[3])
{
    for (int i = 0; i < 2; i++) {
        gain[i] = sigma[i] > 0 ? -e->epsilon : 0;
        r[i] = gain[i] * sigma[i] / (e->rho * e->rho);
    }
    /* the principal axes turn by d_xy/(sigma_xx - sigma_yy) */
    gain[2] = sigma[0] != sigma[1] ? (r[0] - r[1]) * e->rho * e->rho / (sigma[0] - sigma[1]) : gain[0];
    if (e->frozen)
        gain[0] = gain[1] = gain[2] = 0;
}

/* m[i][l] of w^2 V_i = move_il (1 - beta) V_l + rate_il (1 - beta or 1) V_l; lengths in units of 1/|a| */
static void matrices(const elastic_state *e, const lattice_sums *s, double move[2][2], double rate[2][2])
{
    const double sigma[2] = {e->s[0] - e->pressure, e->s[1] - e->pressure}, rho = e->rho;
    double r[2], gain[3], t[3];
    artificial(e, sigma, r, gain);
    for (int i = 0; i < 2; i++)
        for (int l = 0; l < 2; l++) {
            const int il = i == l ? i : 2;
            stress_of(e, s->a, l, t);
            move[i][l] = -2 * sigma[i] * s->b[il] / rho - 2 * rho * r[i] * s->f[il];
            /* change of sigma_ij/rho^2 for j = i and j = the other one, times w and rho */
            const double own = t[i] / rho + (e->c * e->c + 2 * sigma[i] / rho) * s->a[l], off = t[2] / rho;
            rate[i][l] = own * (s->a[i] + gain[i] * s->g[i]) + off * (s->a[1 - i] + gain[2] * s->g[1 - i]);
        }
}

/* eigenvalues of m; first the one whose eigenvector is nearer to k */
static void solve(double m[2][2], const double k[2], wave_modes *out)
{
    const double mean = 0.5 * (m[0][0] + m[1][1]), diff = 0.5 * (m[0][0] - m[1][1]);
    const double disc = diff * diff + m[0][1] * m[1][0], root = sqrt(fabs(disc));
    const double scale = fabs(m[0][0]) + fabs(m[1][1]) + fabs(m[0][1]) + fabs(m[1][0]);
    out->imag = disc < -1e-20 * scale * scale ? root : 0;
    out->omega2[0] = out->omega2[1] = mean;
    if (disc <= 0)
        return;
    /* m applied to k is mostly along k's own mode: take the eigenvalue whose vector has the larger share in k */
    const double across[2] = {-k[1], k[0]}, k2 = k[0] * k[0] + k[1] * k[1];
    double kk = 0, tt = 0;
    for (int i = 0; i < 2; i++)
        for (int l = 0; l < 2; l++) {
            kk += k[i] * m[i][l] * k[l];
            tt += across[i] * m[i][l] * across[l];
        }
    const double sign = kk >= tt || k2 == 0 ? 1 : -1;
    out->omega2[0] = mean + sign * root;
    out->omega2[1] = mean - sign * root;
}

void lattice_waves(const elastic_state *e, uint32_t kernel, uint32_t lattice, double h_dp, double dp, const double k[2],
                   wave_modes *out)
{
    lattice_sums s;
    double move[2][2], rate[2][2], m[2][2];
    lattice_sum(kernel, lattice, h_dp, e->n, k, &s);
    matrices(e, &s, move, rate);
    const double smooth = 1 - e->xsph * s.beta;
    for (int i = 0; i < 2; i++)
        for (int l = 0; l < 2; l++)
            m[i][l] = (smooth * move[i][l] + (e->xsph_rates ? smooth : 1) * rate[i][l]) / (dp * dp);
    solve(m, k, out);
}

void exact_waves(const elastic_state *e, const double k[2], wave_modes *out)
{
    const lattice_sums s = {.a = {-k[0], -k[1]}, .b = {k[0] * k[0], k[1] * k[1], k[0] * k[1]}};
    elastic_state plain = *e;
    double move[2][2], rate[2][2], m[2][2];
    plain.epsilon = 0;
    matrices(&plain, &s, move, rate);
    for (int i = 0; i < 2; i++)
        for (int l = 0; l < 2; l++)
            m[i][l] = move[i][l] + rate[i][l];
    solve(m, k, out);
}
