/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* viscosity.h: artificial viscosity and Morris's. With mu = v_ij . x_ij/(r^2 + 0.01 h^2):

     artificial   a_i -= m_j Pi grad W,  Pi = -(h/rho_mean)(alpha c0 + beta h |mu|) mu    (Gray 2001 eq 2.18)
     approaching  the same, on approaching pairs only                                     (Wickramarachchi 2009 eq 3.18)
     Morris       a_i += m_j 4 nu/(rho_i + rho_j) (g r^2)/(r^2 + 1e-6 h^2) v_ij            (Morris, Fox & Zhu 1997;
                  his 0.01 h^2 would make it 1 to 5 % too weak, at every resolution alike)

   With a ghost wall the velocity is mirrored: v_ij is multiplied by beta = 1 + min(depth/distance, 1/2) (Gray 2.42,
   2.43). */
#ifndef SPH_VISCOSITY_H
#define SPH_VISCOSITY_H

#include "mirror.h"
#include "varying.h"

/* what viscosity sees as v_ij where the candidates are ghosts: p->dw */
SPH_INLINE void sph_mirror_velocity(const sph_home *h, const sph_mirror_tile *m, sph_near *p)
{
    vreal n[SPH_DIM];
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        n[k] = v_load(m->n[k] + p->j);
    const vreal depth = v_load(m->depth + p->j), half = v_set((sph_real)0.5);
    const vreal dist = v_max(sph_dot(p->dx, n) - depth, depth + (sph_real)1e-30); /* depth/dist <= 1 */
    const vreal extra = depth / dist;
    const vreal beta = v_select(v_less(extra, half), extra, half) + 1;
    const vreal vis = SPH_WITH_WALL_GHOST ? v_load(m->vis + p->j) * beta : v_load(m->vis + p->j);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        p->dw[k] = (h->v[k] - v_load(m->u[k] + p->j)) * vis;
}

/* 1/((r^2 + eta)(rho_i + rho_j)), for those who ask for it */
SPH_INLINE void sph_inverse_distance(const sph_choice *c, const sph_factors *f, const sph_home *h, sph_near *p)
{
    const bool asked = sph_viscous(c->viscosity) || sph_diffusive(c->diffusion);
    const vreal soft = sph_varies(c) ? p->r2 + p->wide * p->wide * f->eta : p->r2 + f->eta;
    p->inv = asked ? 1 / (soft * (h->rho + p->rho)) : p->r2;
}

/* sound: where energies go by their equation, h alpha (c_i + c_j) (energy.h) */
SPH_INLINE void sph_viscosity(const sph_choice *c, const sph_factors *f, const sph_home *h, const sph_mirror_tile *m,
                              vreal sound, sph_near *p, vreal *s)
{
    p->visc = p->fm = v_set(0);
    if (!sph_viscous(c->viscosity))
        return;
    vreal vv = p->vr;
    if (p->wall) {
        sph_mirror_velocity(h, m, p);
        vv = sph_dot(p->dw, p->dx);
    }
    if (SPH_IS(c->viscosity, ARTIFICIAL_APPROACHING))
        vv = v_where(v_less(vv, v_set(0)), vv);
    const vreal mu = vv * p->inv; /* mu of Gray 2.18 over (rho_i + rho_j) */
    if (SPH_IS(c->viscosity, MORRIS)) {
        const vreal soft = sph_varies(c) ? p->r2 + p->wide * p->wide * f->eta_morris : p->r2 + f->eta_morris;
        p->fm = p->mg * p->r2 * (f->morris / (soft * (h->rho + p->rho)));
    } else {
        vreal strength = SPH_WITH_ENERGY && c->energy ? sound : v_set(f->av_alpha);
        if (c->beta)
            strength = strength + f->av_beta * ((h->rho + p->rho) * v_abs(mu));
        if (sph_varies(c)) /* h alpha c, h^2 beta |mu| */
            strength = sph_varied_strength(c, f, sound, (h->rho + p->rho) * v_abs(mu), p);
        p->visc = mu * strength * p->mg;
        p->force = p->force - p->visc;
    }
    const vreal true_mu = v_abs(mu) * (h->rho + p->rho); /* for the step's limit */
    s[SUM_MU] = v_max(s[SUM_MU], v_where(v_less(p->q, v_set(f->reach)), true_mu));
}

#endif
