/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* density_gradient.h: what a particle brings of its renormalised gradient of density to the force loop, where density
   diffuses after Antuono, Colagrossi, Marrone & Molteni 2010 (diffusion.h); density_gradient.c makes it. */
#ifndef SPH_DENSITY_GRADIENT_H
#define SPH_DENSITY_GRADIENT_H

#include "sweep.h"

/* Whether the candidates in the tile of matter are images in a face across which gravity pulls: what stands there
   upside down has no part in this diffusion, as walls have none, so that water at rest over such a face feels none.
   Gathers and sums know that of a tile that was filled apart (SPH_APART_MIRRORED). */
SPH_INLINE bool sph_is_upside_down(const sph_sim *sim, const sph_thread *t)
{
    bool turned = false;
    for (uint32_t k = 0; k < SPH_DIM && SPH_HAS_MIRRORS; k++)
        turned |= t->seen.sign[k] < 0 && sim->cfg.gravity[k] != 0;
    return turned;
}

/* G of a home (kg/m^4); returns the rows of the candidates' */
SPH_INLINE const sph_real *sph_spread_density_gradient(const sph_sim *sim, const sph_thread *t, uint32_t h, vreal *g)
{
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++)
        g[k] = v_set(sim->density_gradient[k][t->home_at[h]]);
    return sph_near_columns_of(sim, t, SPH_COLUMN_density_gradient);
}

#define sph_load_density_gradient SPH_NAME(load_density_gradient_)
void sph_load_density_gradient(const sph_candidates *r, sph_real *to, uint32_t row);

#endif
