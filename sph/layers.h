/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* layers.h: what functions that make walls share (layers.c). */
#ifndef SPH_LAYERS_H
#define SPH_LAYERS_H

#include "setup.h"

/* whether a wall has layers of particles; else it is one row on its face */
#define sph_layers_wanted SPH_NAME(layers_wanted_)
bool sph_layers_wanted(const sph_wall *w);
/* as many as it has */
#define sph_layers_count SPH_NAME(layers_count_)
uint32_t sph_layers_count(const sph_sim *sim, const sph_wall *w);
/* OK if a wall may be added, and is well described */
#define sph_layers_check SPH_NAME(layers_check_)
sph_status sph_layers_check(sph_sim *sim, const sph_wall *w, const char *call);

/* how many sets, particles and which digest there were before a wall, to take it back whole */
typedef struct sph_layers_before {
    uint32_t sets, count;
    uint64_t hash;
} sph_layers_before;
#define sph_layers_mark SPH_NAME(layers_mark_)
sph_layers_before sph_layers_mark(const sph_sim *sim);
/* the wall is complete, or, unless st is OK, gone */
#define sph_layers_finish SPH_NAME(layers_finish_)
sph_status sph_layers_finish(sph_sim *sim, const sph_wall *w, sph_layers_before m, sph_status st, uint32_t *group);

/* a new set for one face or corner; origin, normal, tangent, half are from the caller; null: there are too many */
#define sph_layers_new_set SPH_NAME(layers_new_set_)
sph_set *sph_layers_new_set(sph_sim *sim, const sph_wall *w, uint32_t *index);
/* the box in quanta around the region behind a face */
#define sph_layers_bound SPH_NAME(layers_bound_)
void sph_layers_bound(const sph_sim *sim, sph_set *s);

#endif
