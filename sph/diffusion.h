/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* diffusion.h: density diffusion (Molteni & Colagrossi 2009; Fourtakas et al. 2019; Antuono et al. 2010), in matter
   only:
     drho_i += 2 delta h c0 (m_j/rho_j) (rho_j - rho_i - rho_H) (x_ji . grad W)/(r^2 + eta)
   with eta 0.01 h^2 and rho_H the difference that gravity makes between the two places (HYDROSTATIC), or x_ji .
   (G_i + G_j)/2 of the renormalised gradients of density (ANTUONO: density_gradient.c; their psi_ij is twice what
   stands before grad W here), or 0. An image
   has the density of its original: rho_H is that of the original's place (factors.c, sph_pair_factors). Only within one
   material. rho_j of the volume m_j/rho_j is at least 0.95 rho0: among spray, thinner without bound, volumes would sum
   to more than the step stands (factors.c), and densities go below 0. Standard schemes have that in the candidates'
   columns (tiles.c), weak ones, whose other terms want 1/rho_j, here. */
#ifndef SPH_DIFFUSION_H
#define SPH_DIFFUSION_H

#include "term.h"

/* ANTUONO: slope, the home's G; row: the candidates' */
SPH_INLINE void sph_diffusion(const sph_choice *c, const sph_factors *f, const sph_home *h, const vreal *slope,
                              const sph_real *row, sph_near *p, vreal *s)
{
    p->diff = v_set(0);
    if (!sph_diffusive(c->diffusion) || p->wall)
        return;
    vreal dr = h->rho - p->rho;
    if (SPH_IS(c->diffusion, HYDROSTATIC)) {
        SPH_UNROLL
        for (int k = 0; k < SPH_DIM; k++)
            dr = dr - p->dx[k] * f->hydro[k];
        if (SPH_HAS_APART && c->apart)
            dr = dr - f->hydro_offset;
    }
    if (SPH_IS(c->diffusion, ANTUONO)) {
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            dr = dr - (slope[k] + v_load(row + k * SPH_NEAR_ROOM + p->j)) * (p->dx[k] * (sph_real)0.5);
    }
    const vreal least = v_set(f->least_rho), own = p->inv_rho; /* of densities below 0 too */
    const bool bounds = sph_weak_scheme(c->scheme) || sph_normalised(c);
    const vreal inv_rho = bounds ? v_select(v_less(p->rho, least), 1 / least, own) : own;
    /* (rho_j - rho_i) x_ji . grad W = (rho_i - rho_j) r^2 g; the sum rho_i + rho_j in inv is taken out again */
    p->diff = dr * (p->r2 * p->inv * (h->rho + p->rho)) * p->mg * inv_rho * f->diff;
    s[SUM_DRHO] = s[SUM_DRHO] + (sph_rate_by_density(c->scheme, c->gradient) ? p->diff * h->inv_rho : p->diff);
}

#endif
