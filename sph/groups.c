/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* groups.c: walls that move or vanish, and held sets that move or are let go: where their group is at a time is what
   its host says.

   Adami's walls want their acceleration too. It is the mean of the time that sound takes through a support, from half
   of that before to half of it after: so a velocity that jumps (a table's does, at its rows) gives the same impulse
   however a step is cut, and a smooth one the same force, to second order in that time. */
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(groups)

#if SPH_HAS_GROUPS

/* velocity of a group at time t; nothing that is not finite */
static void velocity_at(const sph_sim *sim, uint32_t g, double t, double *v)
{
    double x[SPH_DIM] = {0};
    memset(v, 0, SPH_DIM * sizeof *v);
    sim->group[g].motion(sim->group[g].ctx, t, x, v);
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = sph_abs(v[k]) < 1e15 ? v[k] : 0;
}

static void find_acceleration(sph_sim *sim, uint32_t g, double t)
{
    const double half = sim->cfg.smoothing_length / sim->cfg.sound_speed;
    const double from = t > half ? t - half : 0, to = t + half; /* nothing moves before time 0 */
    double before[SPH_DIM], after[SPH_DIM];
    velocity_at(sim, g, from, before);
    velocity_at(sim, g, to, after);
    for (int k = 0; k < SPH_DIM; k++)
        sim->wall_acc[g][k] = (after[k] - before[k]) / (to - from);
}

/* where group g is at time t */
static sph_status move_group(sph_sim *sim, uint32_t g, double t)
{
    sph_group_state *s = &sim->next.group[g];
    double x[SPH_DIM] = {0}, v[SPH_DIM] = {0};
    sim->group[g].motion(sim->group[g].ctx, t, x, v);
    for (int k = 0; k < SPH_DIM; k++) {
        if (!(sph_abs(x[k]) < 2 * sim->grid.length[k]) || !(sph_abs(v[k]) < 1e15))
            return sph_error(sim, SPH_NOT_FINITE, "motion of a wall", "finite and inside the domain", x[k],
                             SPH_NO_PARTICLE);
        double q = x[k] / sim->grid.quantum, leap = sph_abs(q - (double)s->moved[k]) * sim->grid.quantum;
        if (leap >= sim->grid.length[k])
            return sph_error(sim, SPH_MOVED_TOO_FAR, "motion of a wall", "less than the domain's length in a step",
                             leap, SPH_NO_PARTICLE);
        s->moved[k] = (sph_pos)(q < 0 ? q - 0.5 : q + 0.5);
        s->vel[k] = v[k];
    }
    return SPH_OK;
}

sph_status sph_move_groups(sph_sim *sim, double t, bool moves)
{
    for (uint32_t g = 0; g < sim->groups; g++) {
        sph_group_state *s = &sim->next.group[g];
        if (moves && t >= s->remove_at)
            s->removed = 1;
        if (!sim->group[g].motion || s->removed)
            continue;
        if (SPH_WITH_MOVING_WALLS && sim->has_adami)
            find_acceleration(sim, g, t);
        const sph_status st = moves ? move_group(sim, g, t) : SPH_OK;
        if (st)
            return st;
    }
    return SPH_OK;
}

#endif
