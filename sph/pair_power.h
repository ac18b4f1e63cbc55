/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* pair_power.h: what a pair does to the energy, for the books, per unit mass of the home and without the kernel's
   scale. With F the force on the home and A = p/rho^2 (or T) of each:

     viscous      power of the viscous force relative to the partner; pairs in matter are counted twice, so by half
     diffused     rate of density by diffusion
     wall         -F . v_w, what a wall does at its own velocity
     in walls     what else the pair takes from home and wall: -F . (v_i - v_w) less A_i K . v_iw of the home's rate of
                  density is A_w K . v_iw: it compresses the wall, whose density may or may not follow
     unbalanced   where a form does not conserve energy (choice `loses`): -F . v_i less what the home's energy gains,
                  which cancels over the two of a pair where a form does conserve it

   Contact and artificial stress have theirs where they are (reference.h, stress.h). */
#ifndef SPH_PAIR_POWER_H
#define SPH_PAIR_POWER_H

#include "term.h"

/* beside walls: their work, and what they take up */
SPH_INLINE void sph_wall_power(const sph_choice *c, const sph_home *h, const sph_near *p, vreal *s)
{
    const bool apart = c->solid || SPH_IS(c->gradient, BONET_LOK); /* push is not in `force` */
    const vreal w = sph_weak_scheme(c->scheme) ? h->inv_rho * p->inv_rho * p->mg : p->mg, in = p->press * p->ve * w;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        const vreal other = p->force * p->ex[k] - p->fm * p->dw[k];
        s[SUM_WALL] = s[SUM_WALL] + (apart ? p->push[k] + other : other) * v_load(p->tile->v[k] + p->j);
    }
    s[SUM_IN_WALLS] = s[SUM_IN_WALLS] + in;
    if (c->loses)
        s[SUM_UNBALANCED] = s[SUM_UNBALANCED] + (sph_dot(p->push, p->dv) - p->gain - in);
}

SPH_INLINE void sph_pair_power(const sph_choice *c, const sph_home *h, const sph_near *p, vreal *s)
{
    if (!SPH_WITH_BOOKS || !c->books)
        return;
    if (p->wall) {
        const vreal viscous = SPH_IS(c->viscosity, MORRIS) ? -(p->fm * sph_dot(p->dw, p->dv)) : -(p->visc * p->ve);
        s[SUM_VISCOUS] = s[SUM_VISCOUS] + viscous;
        sph_wall_power(c, h, p, s);
        return;
    }
    if (SPH_IS(c->viscosity, MORRIS))
        s[SUM_VISCOUS] = s[SUM_VISCOUS] - p->fm * sph_pair_share(c, h, p, p->dw, sph_dot(p->dw, p->dv));
    else
        s[SUM_VISCOUS] = s[SUM_VISCOUS] - p->visc * sph_pair_share(c, h, p, p->ex, p->ve);
    s[SUM_DIFFUSED] = s[SUM_DIFFUSED] + p->diff;
    if (c->loses)
        s[SUM_UNBALANCED] = s[SUM_UNBALANCED] + (sph_dot(p->push, h->v) - p->gain);
}

#endif
