/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fluid.h: what fluid.c and walls.c give to the list of passes and to each other. */
#ifndef SPH_FLUID_H
#define SPH_FLUID_H

#include "solid.h"

/* a sum of squares above this counts as not finite: 1e36 leaves room to square no further */
#define SPH_LIMIT_SQUARE ((sph_real)1e30)

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

#define sph_pass_force SPH_NAME(pass_force_)
#define sph_pass_summation SPH_NAME(pass_summation_)
#define sph_pass_shepard SPH_NAME(pass_shepard_)
#define sph_pass_copy_density SPH_NAME(pass_copy_density_)
#define sph_pass_adami SPH_NAME(pass_adami_)
#define sph_pass_adami_copy SPH_NAME(pass_adami_copy_)
#define sph_pass_count SPH_NAME(pass_count_)
#define sph_pass_scatter SPH_NAME(pass_scatter_)
extern const sph_pass sph_pass_force, sph_pass_summation, sph_pass_shepard, sph_pass_copy_density, sph_pass_adami,
    sph_pass_adami_copy,    sph_pass_count, sph_pass_scatter;

#endif
