/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* smoothed.h: velocities that strain rates see, v + xsph (Gray 2001 eqs 2.22, 5.10): the column, and the pass that
   makes xsph before the forces (smoothing.c). */
#ifndef SPH_SMOOTHED_H
#define SPH_SMOOTHED_H

#include "term.h"

SPH_INLINE const sph_real *sph_smoothed_of(const sph_sim *sim, const sph_thread *t)
{
    return sph_near_columns_of(sim, t, SPH_COLUMN_smoothed);
}
SPH_INLINE const sph_real *sph_smoothed_homes_of(const sph_sim *sim, const sph_thread *t)
{
    return sph_home_columns_of(sim, t, SPH_COLUMN_smoothed);
}
#define sph_load_smoothed SPH_NAME(load_smoothed_)
void sph_load_smoothed(const sph_candidates *r, sph_real *to, uint32_t row);

#endif
