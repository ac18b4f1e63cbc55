/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* timestep.h: the time step (timestep.c). */
#ifndef SPH_TIMESTEP_H
#define SPH_TIMESTEP_H

#include "internal.h"

/* what each limit allows after a force sweep, s; 0: it does not say */
#define sph_find_limits SPH_NAME(find_limits_)
void sph_find_limits(const sph_sim *sim, double *limit);
/* the step from now on, and the time at its end; an error where it is too short */
#define sph_choose_dt SPH_NAME(choose_dt_)
sph_status sph_choose_dt(sph_sim *sim, double t_end);

#endif
