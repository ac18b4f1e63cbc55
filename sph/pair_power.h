/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* pair_power.h: what a pair does to the energy, for the books, per unit mass of the home and without the kernel's
   scale: the power of its viscous force relative to the partner (pairs of bodies are counted twice, so by half), the
   rate of density by diffusion, and of a wall the power of its force at the wall's own velocity. */
#ifndef SPH_PAIR_POWER_H
#define SPH_PAIR_POWER_H

#include "term.h"

SPH_INLINE void sph_pair_power(const sph_choice *c, const sph_near *p, vreal *s)
{
    if (!SPH_WITH_BOOKS || !c->books)
        return;
    const vreal viscous = SPH_IS(c->viscosity, MORRIS) ? -(p->fm * sph_dot(p->dw, p->dv)) : -(p->visc * p->ve);
    s[SUM_VISCOUS] = s[SUM_VISCOUS] + (p->wall ? viscous : viscous * (sph_real)0.5);
    s[SUM_DIFFUSED] = s[SUM_DIFFUSED] + p->diff;
    if (!p->wall)
        return;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        s[SUM_WALL] = s[SUM_WALL] + (p->force * p->ex[k] - p->fm * p->dw[k]) * v_load(p->tile->v[k] + p->j);
}

#endif
