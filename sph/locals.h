/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* locals.h: what is done to each particle apart from sums over neighbours, by subject. Particles first .. last of
   buffer dst, which other chunks do not touch. integrators.c says when. */
#ifndef SPH_LOCALS_H
#define SPH_LOCALS_H

#include "sweep.h"

/* yield.c: returns stresses to the yield surface; after every advance of the stress */
#define sph_yield SPH_NAME(yield_)
void sph_yield(const sph_sim *sim, sph_span s);

/* damage.c: grows damage over dt; ids are the particles' own */
#define sph_grow_damage SPH_NAME(grow_damage_)
void sph_grow_damage(const sph_sim *sim, sph_span s);

/* crossing.c: the policy for particles that are found inside a wall, after they moved */
#define sph_cross_walls SPH_NAME(cross_walls_)
void sph_cross_walls(sph_sim *sim, sph_span s, sph_thread *t);
/* the set of walls that a particle is least deep inside of (*depth, m), or SPH_MAX_SETS */
#define sph_inside_wall SPH_NAME(inside_wall_)
uint32_t sph_inside_wall(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *depth);

/* groups.c: displaces the groups that move to where they are at time t, and removes those whose time has come */
#define sph_move_groups SPH_NAME(move_groups_)
sph_status sph_move_groups(sph_sim *sim, double t);

/* powers.c: sums of a chunk; then the books of a step, and of the first forces */
#define sph_sum_powers SPH_NAME(sum_powers_)
void sph_sum_powers(const sph_sim *sim, uint32_t chunk, sph_span s);
#define sph_add_powers SPH_NAME(add_powers_)
sph_status sph_add_powers(sph_sim *sim);
#define sph_first_powers SPH_NAME(first_powers_)
sph_status sph_first_powers(sph_sim *sim);

#endif
