/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shift_sums.h: the sums of particle shifting (shifting.c) in the force loop. With V = m/rho (but in weak schemes
   of a rho that is at least 0.95 rho0: tiles.c), over fluid, walls and images behind faces:

     SHIFT    sum V_j [1 + 0.2 (W/W(dx))^4] g x_ij    the slope of disorder; the bracket keeps pairs from clumping
     NEARER   sum V_j [(W/W(dx))^4 - (W(0.8 dx)/W(dx))^4] g x_ij, where that bracket is above 0 (shift_pairs)
     COVER    sum V_j W                                1 inside the fluid, less where a part of the support is empty
     SPREAD   sum V_j g x_ij (x) x_ij                  minus the unit tensor inside; at a surface one eigenvalue falls

   They stand where the velocity gradient of solids has its sums: a scene has one or the other. */
#ifndef SPH_SHIFT_SUMS_H
#define SPH_SHIFT_SUMS_H

#include "term.h"

#define SPH_SHIFT_CLUMPING ((sph_real)0.2)

SPH_INLINE void sph_shift_sums(const sph_choice *c, const sph_factors *f, const sph_near *p, vreal *s)
{
    if (!SPH_WITH_SHIFTING || !c->shifting)
        return;
    const vreal w = k_value(c->kernel, p->q), near = w * f->inv_wdx, near2 = near * near;
    const vreal more = 1 + SPH_SHIFT_CLUMPING * (near2 * near2), g = p->mg * p->inv_rho;
    s[SUM_COVER] = s[SUM_COVER] + v_load(p->tile->m + p->j) * p->inv_rho * w;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        const vreal slope = g * p->dx[k];
        s[SUM_SHIFT + k] = s[SUM_SHIFT + k] + slope * more;
        if (c->shifting > 1)
            s[SUM_NEARER + k] = s[SUM_NEARER + k] + slope * v_pos(near2 * near2 - f->apart);
        SPH_UNROLL
        for (int l = k; l < SPH_DIM; l++)
            s[SUM_SPREAD + sph_sym[k][l]] = s[SUM_SPREAD + sph_sym[k][l]] + slope * p->dx[l];
    }
}

/* shifting.c: what becomes of the sums of a home */
#define sph_finish_shift SPH_NAME(finish_shift_)
void sph_finish_shift(sph_sim *sim, const sph_thread *t, uint32_t h);

#endif
