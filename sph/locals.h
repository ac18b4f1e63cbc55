/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* locals.h: what is done to each particle apart from sums over neighbours, by subject. Particles first .. last of
   buffer dst, which other chunks do not touch. integrators.c says when. */
#ifndef SPH_LOCALS_H
#define SPH_LOCALS_H

#include "sweep.h"

/* yield.c: returns stresses to the yield surface; after every advance of the stress. whole: they went all
   the way from src, else only a correction of second order, and it has not settled yet */
#define sph_yield SPH_NAME(yield_)
void sph_yield(const sph_sim *sim, sph_span s, bool whole);

/* damage.c, before a stage settles: damage of src grows over dt into dst; what that let go of, a step from src to dst,
   into a chunk's row of the books, or null */
#define sph_grow_damage SPH_NAME(grow_damage_)
void sph_grow_damage(const sph_sim *sim, sph_span s, sph_real dt);
#define sph_book_damage SPH_NAME(book_damage_)
void sph_book_damage(const sph_sim *sim, sph_span s, double *books);

/* crossing.c: the policy for particles that are found inside a wall, after they moved */
#define sph_cross_walls SPH_NAME(cross_walls_)
void sph_cross_walls(sph_sim *sim, sph_span s, sph_thread *t, double *books);
/* the set of walls that a particle is least deep inside of (*depth, m), or SPH_MAX_SETS */
#define sph_inside_wall SPH_NAME(inside_wall_)
uint32_t sph_inside_wall(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *depth);

/* flow.c: velocities and densities of inflows and outflows are those of src; until the stage settles */
#define sph_hold_flows SPH_NAME(hold_flows_)
void sph_hold_flows(const sph_sim *sim, sph_span s);
/* what has gone through an outflow is removed, when the stage has settled */
#define sph_let_out SPH_NAME(let_out_)
void sph_let_out(const sph_sim *sim, sph_span s, sph_thread *t);

/* groups.c: displaces the groups that move to where they are at time t, and removes those whose time has come, unless
   they stand there already (not `moves`) */
#define sph_move_groups SPH_NAME(move_groups_)
sph_status sph_move_groups(sph_sim *sim, double t, bool moves);

/* a chunk's row of the books, and the sum of a column over all rows */
SPH_INLINE double *sph_book_row(const sph_sim *sim, uint32_t chunk)
{
    return sim->partial + (size_t)chunk * SPH_PARTIALS;
}
SPH_INLINE double sph_sum_rows(const sph_sim *sim, uint32_t column)
{
    double sum = 0;
    for (uint32_t c = 0; c < sph_local_chunks(sim); c++)
        sum += sph_book_row(sim, c)[column];
    return sum;
}

/* powers.c: a chunk's row of the books (powers, then JUMP_... of internal.h), all zeros; null in scenes without books.
   Its sums of powers; then the books of a step, and of the first forces */
#define sph_open_books SPH_NAME(open_books_)
double *sph_open_books(const sph_sim *sim, uint32_t chunk);
#define sph_sum_powers SPH_NAME(sum_powers_)
void sph_sum_powers(const sph_sim *sim, sph_span s, double *books);
#define sph_add_powers SPH_NAME(add_powers_)
sph_status sph_add_powers(sph_sim *sim);
#define sph_first_powers SPH_NAME(first_powers_)
sph_status sph_first_powers(sph_sim *sim);

#endif
