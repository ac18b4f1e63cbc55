/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* pressure.h: the force of the pressure, of fluids (of solids: stress.h; after Bonet & Lok: gradient.h).

     standard    a_i -= m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W    (Gray 2001 eq 2.17)
     weak        a_i -= m_j (p_i + p_j)/(rho_i rho_j) grad W      (Wickramarachchi 2009 eq 3.80)
     direct      a_i -= m_j (p_j - p_i)/(rho_i rho_j) grad W     (his eq 3.21: conserves neither momentum nor energy) */
#ifndef SPH_PRESSURE_H
#define SPH_PRESSURE_H

#include "continuity.h"

/* What the home's own energy gains where the density goes as continuity.h says: p/rho^2 of its rate. Where it is
   summed, what this home's motion makes both of a pair gain: images then move as their places do, not as their
   velocities say. */
SPH_INLINE vreal sph_pressure_gain(const sph_choice *c, const sph_factors *f, const sph_home *h, const sph_near *p)
{
    const bool weak = sph_weak_scheme(c->scheme);
    const vreal own = weak ? h->press * (h->inv_rho * h->inv_rho) : h->press;
    const vreal other = weak ? p->press * (p->inv_rho * p->inv_rho) : p->press;
    if (c->summed && !(SPH_WITH_ENERGY && c->energy))
        return p->wall ? own * p->mg * p->vr : (own + other) * p->mg * sph_dot(h->v, p->dx);
    const vreal gain = (weak ? h->press * h->inv_rho * p->inv_rho : h->press) * p->mg * p->vc;
    if (!SPH_IS(c->scheme, STANDARD_WICK) && !SPH_IS(c->scheme, WEAK_WICK))
        return gain;
    return gain * sph_printed_weight(c->scheme, f, h->press, p->press, h->rho);
}

SPH_INLINE void sph_pressure_force(const sph_choice *c, const sph_factors *f, const sph_home *h, sph_near *p)
{
    if (c->solid || SPH_IS(c->gradient, BONET_LOK))
        return;
    if (!sph_weak_scheme(c->scheme))
        p->force = (h->press + p->press) * p->mg;
    else if (SPH_IS(c->scheme, DIRECT))
        p->force = (p->press - h->press) * h->inv_rho * p->inv_rho * p->mg;
    else
        p->force = (p->press + h->press) * h->inv_rho * p->inv_rho * p->mg;
    if (!SPH_WITH_BOOKS || !c->books || !c->loses)
        return;
    p->gain = sph_pressure_gain(c, f, h, p);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        p->push[k] = p->force * p->ex[k];
}

#endif
