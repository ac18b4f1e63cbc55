/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* factors.h: see factors.c. */
#ifndef SPH_FACTORS_H
#define SPH_FACTORS_H

#include "internal.h"

/* sim->fac and sim->courant from the configuration */
#define sph_make_factors SPH_NAME(make_factors_)
void sph_make_factors(sph_sim *sim);
/* density diffusion allows a step of so many h/(delta c0) */
#define sph_diffusion_factor SPH_NAME(diffusion_factor_)
double sph_diffusion_factor(const sph_config *c);
/* cfl, or less where the integrator does not stand it */
#define sph_courant_factor SPH_NAME(courant_factor_)
double sph_courant_factor(const sph_config *c);

#endif
