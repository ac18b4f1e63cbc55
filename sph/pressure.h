/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* pressure.h: the force of the pressure, of fluids (of solids: stress.h; after Bonet & Lok: gradient.h).

     standard    a_i -= m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W    (Gray 2001 eq 2.17)
     weak        a_i -= m_j (p_i + p_j)/(rho_i rho_j) grad W      (Wickramarachchi 2009 eq 3.80)
     direct      a_i -= m_j (p_j - p_i)/(rho_i rho_j) grad W     (his eq 3.21: conserves neither momentum nor energy) */
#ifndef SPH_PRESSURE_H
#define SPH_PRESSURE_H

#include "term.h"

SPH_INLINE void sph_pressure_force(const sph_choice *c, const sph_home *h, sph_near *p)
{
    if (c->solid || SPH_IS(c->gradient, BONET_LOK))
        return;
    if (!sph_weak_scheme(c->scheme))
        p->force = (h->press + p->press) * p->mg;
    else if (SPH_IS(c->scheme, DIRECT))
        p->force = (p->press - h->press) * h->inv_rho * p->inv_rho * p->mg;
    else
        p->force = (p->press + h->press) * h->inv_rho * p->inv_rho * p->mg;
}

#endif
