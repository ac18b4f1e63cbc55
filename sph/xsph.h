/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* xsph.h: XSPH, the velocity with which positions drift beside their own: u_i += xsph (m_j/rho_mean) (v_j - v_i) W
   (Gray 2001 eq 2.22), in matter only (not with walls, as he says). */
#ifndef SPH_XSPH_H
#define SPH_XSPH_H

#include "term.h"

SPH_INLINE void sph_xsph(const sph_choice *c, const sph_home *h, const sph_near *p, vreal *s)
{
    if (!SPH_WITH_XSPH || !c->xsph || p->wall)
        return;
    const vreal w = k_value(c->kernel, p->q) * v_load(p->tile->m + p->j) / (h->rho + p->rho);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        s[SUM_XSPH + k] = s[SUM_XSPH + k] - w * p->dv[k];
}

#endif
