/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* continuity.h: the rate of density, of fluids (that of solids is the trace of the velocity gradient: stress.h).

     standard    drho_i += m_j v_ij . grad W                  (Gray 2001 eq 2.21)
     weak        drho_i += rho_i (m_j/rho_j) v_ij . grad W   (conserves energy with Wickramarachchi's 3.80)
     direct      as weak                                      (Wickramarachchi 2009 eq 3.22)
     printed     standard and weak times a weight of pressures over p_i (his 3.50, 3.79) */
#ifndef SPH_CONTINUITY_H
#define SPH_CONTINUITY_H

#include "term.h"

/* the weight that Wickramarachchi's 3.50 and 3.79 print; 1 where |p_i| is too small to divide by */
SPH_INLINE vreal sph_printed_weight(uint32_t scheme, const sph_factors *f, vreal pi, vreal pj, vreal rho)
{
    const vreal p = SPH_IS(scheme, STANDARD_WICK) ? pi * rho * rho : pi;
    const vint usable = v_less(v_set(f->small_p), v_abs(p));
    const vreal safe = v_select(usable, pi, v_set(1));
    const vreal w = SPH_IS(scheme, STANDARD_WICK) ? (pi + pj) / (2 * safe) : pj / safe;
    return v_select(usable, w, v_set(1));
}

SPH_INLINE void sph_continuity(const sph_choice *c, const sph_factors *f, const sph_home *h, const sph_near *p,
                               vreal *s)
{
    if (c->solid)
        return;
    vreal rate = p->mg * p->vc;
    if (sph_weak_scheme(c->scheme))
        rate = rate * p->inv_rho;
    if (SPH_IS(c->scheme, STANDARD_WICK) || SPH_IS(c->scheme, WEAK_WICK))
        rate = rate * sph_printed_weight(c->scheme, f, h->press, p->press, h->rho);
    s[SUM_DRHO] = s[SUM_DRHO] + rate;
}

#endif
