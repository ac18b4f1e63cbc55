/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* integrators.h: an integrator is a list of passes, and what its stages do at their sorts (integrators.c). */
#ifndef SPH_INTEGRATORS_H
#define SPH_INTEGRATORS_H

#include "internal.h"

typedef struct sph_integrator {
    const sph_pass *const *passes; /* null: a pass whose module was left out */
    uint32_t count;
    uint32_t summing;              /* how many of them, the last, only summed density needs */
    const sph_stage *first;        /* of its first sort */
    const sph_stage *second;       /* of its second sort, if it has one */
} sph_integrator;

/* an integrator by its number in sph_config; SPH_NO_INTEGRATOR: the computation of the first forces */
#define SPH_NO_INTEGRATOR SPH_INTEGRATORS
#define sph_integrator_of SPH_NAME(integrator_of_)
const sph_integrator *sph_integrator_of(uint32_t integrator);

/* what is done before the passes of a step */
#define sph_prepare SPH_NAME(prepare_)
sph_status sph_prepare(sph_sim *sim, const sph_integrator *g);

#endif
