/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* factors.h: see factors.c. */
#ifndef SPH_FACTORS_H
#define SPH_FACTORS_H

#include "scratch.h"

/* sim->fac and sim->courant from the configuration */
#define sph_make_factors SPH_NAME(make_factors_)
void sph_make_factors(sph_sim *sim);
/* density diffusion allows a step of so many h/(delta c0) */
#define sph_diffusion_factor SPH_NAME(diffusion_factor_)
double sph_diffusion_factor(const sph_config *c);
/* cfl, or less where the integrator does not stand it */
#define sph_courant_factor SPH_NAME(courant_factor_)
double sph_courant_factor(const sph_config *c);
/* what the tiles of matter must be of one kind for: an or of SPH_APART_... (sph_sweep.apart) */
#define sph_asks_apart SPH_NAME(asks_apart_)
uint8_t sph_asks_apart(const sph_sim *sim);
/* the constants between home h and a tile of one kind (ghosts, or those in the tile of matter) */
#define sph_pair_factors SPH_NAME(pair_factors_)
#if SPH_HAS_APART
const sph_factors *sph_pair_factors(const sph_sim *sim, sph_thread *t, uint32_t h, bool ghosts);
#else
SPH_INLINE const sph_factors *sph_pair_factors(const sph_sim *sim, sph_thread *t, uint32_t h, bool ghosts)
{
    (void)t, (void)h, (void)ghosts;
    return &sim->fac;
}
#endif

#endif
