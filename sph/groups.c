/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* groups.c: walls that move or vanish, and held sets that move or are let go: where their group is at a time is what
   its host says. */
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(groups)

#if SPH_HAS_GROUPS

sph_status sph_move_groups(sph_sim *sim, double t)
{
    for (uint32_t g = 0; g < sim->groups; g++) {
        sph_group_state *s = &sim->next.group[g];
        if (t >= s->remove_at)
            s->removed = 1;
        if (!sim->group[g].motion || s->removed)
            continue;
        double x[SPH_DIM] = {0}, v[SPH_DIM] = {0};
        sim->group[g].motion(sim->group[g].ctx, t, x, v);
        for (int k = 0; k < SPH_DIM; k++) {
            if (!(sph_abs(x[k]) < 2 * sim->grid.length[k]) || !(sph_abs(v[k]) < 1e15))
                return sph_error(sim, SPH_NOT_FINITE, "motion of a wall", "finite and inside the domain", x[k],
                                 SPH_NO_PARTICLE);
            double q = x[k] / sim->grid.quantum, leap = sph_abs(q - (double)s->moved[k]) * sim->grid.quantum;
            if (leap >= sim->grid.length[k])
                return sph_error(sim, SPH_MOVED_TOO_FAR, "motion of a wall",
                                 "less than the domain's length in a step", leap, SPH_NO_PARTICLE);
            s->moved[k] = (sph_pos)(q < 0 ? q - 0.5 : q + 0.5);
            s->vel[k] = v[k];
        }
    }
    return SPH_OK;
}

#endif
