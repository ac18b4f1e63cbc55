/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fluid.h: what fluid.c and walls.c give to the list of passes and to each other. */
#ifndef SPH_FLUID_H
#define SPH_FLUID_H

#include "factors.h"
#include "forces.h"
#include "passes.h"
#include "solid.h"

/* policy for particles found inside a wall; called for the particles of one chunk after they moved */
#define sph_cross_walls SPH_NAME(cross_walls_)
void sph_cross_walls(sph_sim *sim, uint32_t first, uint32_t last, sph_thread *t);
/* displaces the groups that move to where they are at time t, and removes those whose time has come */
#define sph_move_groups SPH_NAME(move_groups_)
sph_status sph_move_groups(sph_sim *sim, double t);

/* sort.c: faces of the domain for one particle (0 inside, 1 reflected, 2 left), and the start of a stage */
#define sph_enforce_faces SPH_NAME(enforce_faces_)
int sph_enforce_faces(const sph_sim *sim, sph_pos *q, sph_real *v);
#define sph_begin_sort SPH_NAME(begin_sort_)
void sph_begin_sort(sph_sim *sim, uint32_t src, uint32_t dst, uint32_t count, bool table, uint32_t mode);

/* step.c: the list of passes of an integrator, and that of the first forces; null at the end */
#define sph_program_of SPH_NAME(program_of_)
const sph_pass *const *sph_program_of(uint32_t integrator);
#define sph_prime_program SPH_NAME(prime_program_)
const sph_pass *const *sph_prime_program(void);

#endif
