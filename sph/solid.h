/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* solid.h: the pair formulas of solids on lanes, used by the one sweep (sweep.c, fluid.c), and what solid.c and damage.c
   give to the list of passes. Signs: T is stored as pressure is, positive in compression, so that a pair adds to the sum of
   accelerations what pressure does: a_i -= m_j (T_i + T_j) K g. See SPH_UPDATED in sph.h for the equations. */
#ifndef SPH_SOLID_H
#define SPH_SOLID_H

#include "sweep.h"

/* places of the components of a symmetric tensor */
static const uint8_t sph_sym[3][3] __attribute__((unused)) =
#if SPH_DIM == 1
    {{0}};
#elif SPH_DIM == 2
    {{0, 2}, {2, 1}};
#else
    {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
#endif

/* the deviatoric stress as a symmetric tensor from what the state keeps */
SPH_INLINE void sph_deviator(const vreal *kept, vreal *s)
{
#if SPH_DIM < 3
    SPH_UNROLL
    for (int k = 0; k < SPH_NT; k++)
        s[k] = kept[k];
#else
    s[0] = kept[0];
    s[1] = kept[1];
    s[2] = -(kept[0] + kept[1]);
    s[3] = kept[2];
    s[4] = kept[3];
    s[5] = kept[4];
#endif
}

/* dS/dt and -tr L of a home from its sums; raw: sum m_j v_ij (x) K g without the kernel's scale */
#define sph_stress_rates SPH_NAME(stress_rates_)
sph_real sph_stress_rates(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real *raw, sph_real rho);
/* the stress after damage (xx, yy, zz, xy, xz, yz; Pa) and D, in double, of a particle of a buffer */
#define sph_stress_of SPH_NAME(stress_of_)
double sph_stress_of(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *stress);

#endif
