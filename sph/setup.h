/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* setup.h: what the files of set-up share (setup.c): adding sets, groups and particles to a simulation that is not in
   the middle of a step. */
#ifndef SPH_SETUP_H
#define SPH_SETUP_H

#include "internal.h"

/* reports BAD_ARGUMENT */
#define sph_setup_bad SPH_NAME(setup_bad_)
sph_status sph_setup_bad(sph_sim *sim, const char *what, const char *allowed, double value);
/* OK unless a step is under way, or sim is null */
#define sph_setup_idle SPH_NAME(setup_idle_)
sph_status sph_setup_idle(sph_sim *sim, const char *call);
/* OK if particles may still be added */
#define sph_setup_begin_adding SPH_NAME(setup_begin_adding_)
sph_status sph_setup_begin_adding(sph_sim *sim, const char *call);
/* ends an addition; unless st is OK there are `before` particles again */
#define sph_setup_end_adding SPH_NAME(setup_end_adding_)
sph_status sph_setup_end_adding(sph_sim *sim, uint32_t before, sph_status st);
/* one particle; x from the domain's low corner (m), d the relative density excess */
#define sph_setup_append SPH_NAME(setup_append_)
sph_status sph_setup_append(sph_sim *sim, uint32_t set, const double *x, const double *v, double d);
/* every component finite */
#define sph_setup_check_vector SPH_NAME(setup_check_vector_)
sph_status sph_setup_check_vector(sph_sim *sim, const char *what, const double *v);
/* lo .. hi within a domain's length of the domain along axis k */
#define sph_setup_near_domain SPH_NAME(setup_near_domain_)
bool sph_setup_near_domain(const sph_sim *sim, int k, double lo, double hi);
/* what the sweep reads of a set, from its constants; adds the set to the digest of the set-up */
#define sph_setup_finish_set SPH_NAME(setup_finish_set_)
void sph_setup_finish_set(sph_sim *sim, sph_set *s);
/* a group of sets that move by `motion` or not at all (null), until removed; the caller has seen that there is room */
#define sph_setup_add_group SPH_NAME(setup_add_group_)
uint32_t sph_setup_add_group(sph_sim *sim, sph_motion motion, void *ctx);
/* OK if the set is made of what moves by forces */
#define sph_setup_check_body SPH_NAME(setup_check_body_)
sph_status sph_setup_check_body(sph_sim *sim, uint32_t set);
/* spacing^DIM */
#define sph_setup_cell_volume SPH_NAME(setup_cell_volume_)
double sph_setup_cell_volume(const sph_sim *sim);
/* x (m, from the domain's low corner) in quanta; the caller has checked the range */
#define sph_setup_to_quanta SPH_NAME(setup_to_quanta_)
sph_pos sph_setup_to_quanta(const sph_sim *sim, double x);
/* lattice intervals in a length, at least one; 0 if there are absurdly many */
#define sph_setup_intervals SPH_NAME(setup_intervals_)
uint32_t sph_setup_intervals(double length, double dx);
/* rows along an axis, at these offsets (spacings) from the low corner: even, odd sums of the other axes' numbers */
typedef struct sph_rows {
    uint32_t axis;
    double offset[2];
} sph_rows;
typedef bool (*sph_inside)(const void *shape, const double *x);
/* appends the lattice points of a box for which inside(shape, x) holds; rows, v and inside may be null; all or
   nothing */
#define sph_setup_fill SPH_NAME(setup_fill_)
sph_status sph_setup_fill(sph_sim *sim, const char *call, uint32_t set, const double *lo, const double *hi,
                          const sph_rows *rows, const double *v, sph_inside inside, const void *shape);
#define sph_setup_round_up SPH_NAME(setup_round_up_)
uint32_t sph_setup_round_up(double x);

#endif
