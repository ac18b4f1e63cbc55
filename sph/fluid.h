/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fluid.h: what fluid.c and walls.c give to the list of passes and to each other. */
#ifndef SPH_FLUID_H
#define SPH_FLUID_H

#include "passes.h"
#include "solid.h"

/* where a particle's sums of the force pass stand; SUM_FORCE is not in lanes: components, then power */
enum {
    SUM_DRHO,
    SUM_MU,
    SUM_ACC,
    SUM_XSPH = SUM_ACC + SPH_DIM,
    SUM_VISC = SUM_XSPH + SPH_DIM,
    SUM_WALL,
    SUM_DIFF,
    SUM_FORCE
};
/* with solids the velocity gradient comes between acceleration and the rest */
#define SUM_L SUM_XSPH
SPH_INLINE uint32_t sph_sum_shift(const sph_config *c) { return sph_has_solids(c) ? SPH_NL : 0; }
_Static_assert(SUM_FORCE + (SPH_WITH_SOLID ? SPH_NL : 0) < SPH_SUMS, "SPH_SUMS is too small");

#define sph_make_factors SPH_NAME(make_factors_)
void sph_make_factors(sph_sim *sim);
/* adds the boundary-force tile's acceleration (and its power) to sum SUM_FORCE of the home particle */
#define sph_force_walls SPH_NAME(force_walls_)
void sph_force_walls(const sph_sim *sim, sph_thread *t, uint32_t home);

#endif
