/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* gradient.h: corrected gradients of fluids, in the force loop; gradient.c makes them. With M = -sum m_j x_ij (x)
   x_ij g and N = M^-1 (weak scheme: with m_j/rho_j for m_j, and without the rho of the next lines):

     Bonet & Lok 1999     drho_i = rho_i sum m_j v_ij . N_i x_ij g          exact where the velocity is linear
                          a_i -= m_j (T_i + T_j) x_ij g,  T = p N/rho     does the same work; keeps both momenta
     renormalised         K = (B_i + B_j)/2 x_ij for x_ij in continuity, pressure and artificial viscosity, B = rho N
                          (Wickramarachchi 2009 eqs 4.8-4.20, with the sign of his 3.77): keeps momentum and energy, but
                          not angular momentum, and is exact for linear fields only where B_i = B_j

   A ghost has T = p/rho^2 I; with it K = B_i x_ij of the matter. Where a ghost is the home (its density goes by
   continuity) it has the plain gradient after Bonet & Lok, and the matter's B renormalised, so that the pair's two
   works are of one K; with another ghost the plain one. Diffusion and Morris's viscosity keep the plain gradient. */
#ifndef SPH_GRADIENT_H
#define SPH_GRADIENT_H

#include "term.h"

/* what a home brings: N_i or B_i, and T_i; renormalised: the share of B_i + B_j that is taken, where a ghost has 0 */
typedef struct sph_gradient_home {
    vreal n[SPH_NT], t[SPH_NT], share;
} sph_gradient_home;

SPH_INLINE sph_gradient_home sph_spread_gradient(const sph_choice *what, const sph_sim *sim, const sph_thread *t,
                                                 uint32_t h)
{
    const sph_real *const own = sph_home_columns_of(sim, t, SPH_COLUMN_gradient);
    const sph_config *const c = &sim->cfg;
    sph_gradient_home o;
    const bool ghost = SPH_WITH_WALL_GHOST && !sph_is_matter(&sim->set[t->home_set[h]]); /* has no place in the array */
    const bool bonet = SPH_IS(c->gradient, BONET_LOK), whole = sph_weak_scheme(c->scheme) || !bonet;
    const sph_real plain = !bonet && !what->wall ? 0 : whole ? 1 : 1 / t->home.rho[h];
    o.share = v_set(ghost ? 1 : (sph_real)0.5);
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_NT; k++) {
        o.n[k] = v_set(!ghost ? sim->gradient[k][t->home_at[h]] : k < SPH_DIM ? plain : 0);
        o.t[k] = v_set(ghost || !sph_takes_forces(what) ? 0 : own[k * SPH_HOME_ROOM + h]);
    }
    return o;
}

/* a symmetric tensor times a vector */
SPH_INLINE void sph_symmetric_times(const vreal *t, const vreal *x, vreal *y)
{
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        y[k] = t[sph_sym[k][0]] * x[0];
        SPH_UNROLL
        for (int l = 1; l < SPH_DIM; l++)
            y[k] = y[k] + t[sph_sym[k][l]] * x[l];
    }
}

/* what continuity and forces take for x_ij; `row`: the candidates' T or B */
SPH_INLINE void sph_corrected_distance(const sph_choice *c, const sph_gradient_home *h, const sph_real *row,
                                       sph_near *p)
{
    vreal b[SPH_NT], nx[SPH_DIM];
    if (SPH_IS(c->gradient, BONET_LOK)) {
        sph_symmetric_times(h->n, p->dx, nx);
        p->vc = sph_dot(p->dv, nx);
    }
    if (!SPH_IS(c->gradient, RENORMALISED))
        return;
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_NT; k++)
        b[k] = p->wall ? h->n[k] : (h->n[k] + v_load(row + k * SPH_NEAR_ROOM + p->j)) * h->share;
    sph_symmetric_times(b, p->dx, p->ex);
    p->vc = p->ve = sph_dot(p->dv, p->ex);
}

/* the force of the pressure after Bonet & Lok */
SPH_INLINE void sph_corrected_pressure(const sph_choice *c, const sph_home *o, const sph_gradient_home *h,
                                       const sph_real *row, sph_near *p, vreal *s)
{
    if (!SPH_IS(c->gradient, BONET_LOK))
        return;
    const vreal w = sph_weak_scheme(c->scheme) ? p->mg * o->inv_rho * p->inv_rho : p->mg;
    vreal sum[SPH_NT], a[SPH_DIM];
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_NT; k++)
        sum[k] = h->t[k] + (p->wall ? k < SPH_DIM ? p->press : v_set(0) : v_load(row + k * SPH_NEAR_ROOM + p->j));
    sph_symmetric_times(sum, p->dx, a);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        p->push[k] = a[k] * w;
        s[SUM_ACC + k] = s[SUM_ACC + k] + p->push[k];
    }
    if (!SPH_WITH_BOOKS || !c->books || !c->loses)
        return;
    const vreal own = sph_weak_scheme(c->scheme) ? o->press : o->press * o->rho;
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_NT; k++)
        sum[k] = h->n[k] * own; /* T without the guard, as the rate of density has it */
    sph_symmetric_times(sum, p->dx, a);
    p->gain = sph_dot(p->dv, a) * w;
}

#define sph_load_gradient SPH_NAME(load_gradient_)
void sph_load_gradient(const sph_candidates *r, sph_real *to, uint32_t row);

#endif
