/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* finish.h: see finish.c. */
#ifndef SPH_FINISH_H
#define SPH_FINISH_H

#include "scratch.h"

/* home number h of a thread's tile, when the force sweep has summed all of its pairs: acceleration, rate of density and
   what else the scene asks for, into buffer dst */
#define sph_finish_home SPH_NAME(finish_home_)
void sph_finish_home(sph_sim *sim, sph_thread *t, uint32_t h);

#endif
