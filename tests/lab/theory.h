/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* theory.h: what linear theory says of a square of particles on a lattice with periodic sides: how fast the fastest of
   its waves grows, and the largest step that an integrator stands. Lengths in spacings, speeds in c0, density 1: times
   in dx/c0. */
#ifndef LAB_THEORY_H
#define LAB_THEORY_H

#include <stdbool.h>
#include <stdint.h>

/* ---- growth of waves in a solid under a uniform pressure ---- */

typedef struct theory_box {
    uint32_t form;            /* SPH_UPDATED, SPH_CORRECTED, SPH_TOTAL */
    uint32_t kernel, lattice; /* LATTICE_... of tools/dispersion.h; the square one for all but SPH_UPDATED */
    uint32_t n;               /* particles along a side */
    double h, mu;             /* dx, K */
    double volume;            /* V/V0; p = c0^2 (1 - V/V0) at density 1 */
    double epsilon, exponent; /* artificial stress, SPH_UPDATED only */
} theory_box;

/* largest growth rate of all waves of the box, c0/dx */
double theory_growth(const theory_box *b);
/* s^2 of the two modes of one wave, k in 1/dx: value[0] +- i value[1] or value[0], value[1] when *complex is not set */
void theory_modes(const theory_box *b, const double k[2], double value[2], bool *complex_pair);

/* ---- the largest stable step at no stress ---- */

/* density by continuity (all schemes are one at no pressure), by summation; elastic with plain and with corrected
   gradients */
enum { THEORY_WATER, THEORY_SUMMED, THEORY_UPDATED, THEORY_CORRECTED };

typedef struct theory_step {
    uint32_t medium, integrator, kernel, n;
    double h, mu, alpha; /* artificial viscosity of factor alpha, beta 0 */
    double mass;         /* of a particle; 1, or what makes a summed density 1 */
} theory_step;

/* largest factor by which a step multiplies any wave of the box; dt in dx/c0 */
double theory_factor(const theory_step *t, double dt);
/* the largest dt in dx/c0 up to which no wave grows, by bisection to 1e-4 */
double theory_limit(const theory_step *t);

#endif
