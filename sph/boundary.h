/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* boundary.h: forces of boundary particles, in the force sweep (boundary.c). */
#ifndef SPH_BOUNDARY_H
#define SPH_BOUNDARY_H

#include "term.h"

/* adds the acceleration that the tile of points gives to a home, and its power, to the sum BOUNDARY (components, then
   power) */
#define sph_boundary_force SPH_NAME(boundary_force_)
void sph_boundary_force(const sph_sim *sim, sph_thread *t, uint32_t home);

#endif
