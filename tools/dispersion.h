/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dispersion.h: plane waves on a lattice of SPH particles in an elastic solid, plane strain (Gray 2001, section 5.6 and
   appendix B). Lengths are in units of the spacing where they are called _dp. */
#ifndef DISPERSION_H
#define DISPERSION_H

#include <stdbool.h>
#include <stdint.h>

/* square cells; every second row moved by half a spacing in x; every second column moved in y */
enum { LATTICE_SQUARE, LATTICE_SHIFTED_X, LATTICE_SHIFTED_Y, LATTICES };
extern const char *const lattice_names[LATTICES + 1];   /* null-terminated */
extern const char *const dispersion_kernels[];          /* in the order of sph.h, null-terminated */

/* Sums over all neighbours inside the support, spacing dp = 1, of a wave vector k (1/dp):
     a_i  = sum sin(k.r) d_i W                     b_ij = sum (1 - cos(k.r)) d_i d_j W
     beta = sum (1 - cos(k.r)) W                   f_ij = sum (1 - cos(k.r)) d_j(f^n d_i W),  f = W/W(dp)
     g_i  = sum sin(k.r) f^n d_i W
   Pairs xx, yy, xy. f_ij is Gray's 5.67. g he leaves out: it carries the change of the artificial stress. */
typedef struct lattice_sums {
    double beta, a[2], b[3], f[3], g[2];
} lattice_sums;
void lattice_sum(uint32_t kernel, uint32_t lattice, double h_dp, double n, const double k[2], lattice_sums *out);

/* d2W/dr2, h = 1 */
double kernel_second(uint32_t kernel, double q);

/* A material at rest under a uniform stress whose axes are x and y. Stress is positive in tension, s is deviatoric. */
typedef struct elastic_state {
    double rho, c, mu, pressure, s[2];
    double epsilon, n;     /* artificial stress: R = -epsilon sigma/rho^2 along each principal axis in tension */
    double xsph;           /* factor of the smoothed velocity */
    bool xsph_rates;       /* it enters density and strain rates too (Gray 5.10); else positions alone */
    bool frozen;           /* R does not change with the wave, as Gray 5.65 assumes */
} elastic_state;

/* omega^2 of the mode nearest to longitudinal [0] and of the other [1]; imag: of a complex pair +- imag, else 0 */
typedef struct wave_modes {
    double omega2[2], imag;
} wave_modes;
/* on the lattice, wave vector k in 1/dp, spacing dp (length) */
void lattice_waves(const elastic_state *e, uint32_t kernel, uint32_t lattice, double h_dp, double dp, const double k[2],
                   wave_modes *out);
/* of the exact equations, k in 1/length */
void exact_waves(const elastic_state *e, const double k[2], wave_modes *out);

#endif
