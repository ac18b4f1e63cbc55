/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* normalised.h: solids by normalised kernels, in the force loop. The kernel's gradient as a particle sees it is

     NORMALISED            grad W~_ij = (g x_ij S_i - W_ij D_i)/S_i^2                       (Powell 2012 eq 1.14)
     NORMALISED_CORRECTED  grad W^_ij = M_i^-T grad W~_ij,  M_i = sum V_j x_ji (x) grad W~_ij        (his 1.19)

   S_i = sum V_j W_ij, D_i = sum V_j grad_i W_ij, V = m/rho (1.14 prints no V): the first is exact for constants, the
   second for linear fields. Both are N_i x_ij g - W_ij q_i with a matrix and a vector of the home. Then

     L_i = -sum V_j v_ij (x) grad W^_ij,  a_i -= sum m_j (T_i + T_j) grad W^_ij

   as he has it: a pair's two forces differ, so momentum and energy are lost (`unbalanced` in the books). */
#ifndef SPH_NORMALISED_H
#define SPH_NORMALISED_H

#include "term.h"

typedef struct sph_normalised_home {
    vreal n[SPH_NL], q[SPH_DIM];
} sph_normalised_home;

/* of solids; others see the plain gradient */
SPH_INLINE sph_normalised_home sph_spread_normalised(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const bool solid = sph_is_solid(&sim->set[t->home_set[h]]);
    const uint32_t i = t->home_at[h];
    sph_normalised_home o;
    SPH_UNROLL_MANY
    for (uint32_t k = 0; k < SPH_NL; k++)
        o.n[k] = v_set(solid ? sim->normal[k][i] : k % (SPH_DIM + 1) == 0 ? 1 : 0);
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++)
        o.q[k] = v_set(solid ? sim->normal[SPH_NL + k][i] : 0);
    return o;
}

/* m_j grad W^_ij, without the scale of k_slope, for K */
SPH_INLINE void sph_normalised_vector(const sph_choice *c, const sph_factors *f, const sph_normalised_home *o,
                                      sph_near *p)
{
    const vreal mw = k_value(c->kernel, p->q) * v_load(p->tile->m + p->j) * f->value_slope;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        vreal a = o->n[k * SPH_DIM] * p->dx[0];
        SPH_UNROLL
        for (int l = 1; l < SPH_DIM; l++)
            a = a + o->n[k * SPH_DIM + l] * p->dx[l];
        p->kx[k] = a * p->mg - o->q[k] * mw;
    }
}

#endif
