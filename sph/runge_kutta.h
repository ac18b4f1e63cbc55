/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* runge_kutta.h: the second halves of the Runge-Kutta forms, of one particle (Wickramarachchi 2009). Buffer src is
   the middle of the step; positions and velocities are taken from it again. */
#ifndef SPH_RUNGE_KUTTA_H
#define SPH_RUNGE_KUTTA_H

#include "kick.h"

/* a wall goes on from the middle of the step to its end */
SPH_INLINE void sph_advance_wall(const sph_sim *sim, const sph_set *set, uint32_t i, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const double none[SPH_DIM] = {0};
    sph_pos to[SPH_DIM];
    if (sph_wall_removed(sim, set))
        b->set[0][i] = SPH_DEAD;
    if (!SPH_WITH_MOVING_WALLS || sph_wall_removed(sim, set))
        return;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        to[k] = (sph_pos)(sim->buf[sim->src].pos[k][b->id[0][i]] + sph_wall_step(sim, set, k));
    sph_place(sim, i, none, to, t);
}

/* the second halves of the Runge-Kutta forms, as printed: 3.86-3.87, and 3.92 */
SPH_INLINE void sph_runge_kutta(const sph_sim *sim, uint32_t i, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const bool momentum = SPH_IS(sim->cfg.integrator, RUNGE_KUTTA_MOMENTUM);
    const sph_real dt = (sph_real)sim->dt, half = dt * (sph_real)0.5;
    if (SPH_HAS_MIRRORS && sim->turned) /* what was turned at half time goes back into the frame of src */
        sph_turn_fields(sim, i, sim->turned[b->id[0][i]]);
    const uint32_t p = b->id[0][i];
    const sph_set *set = &sim->set[b->set[0][i]];
    if (sph_is_matter(set) || sph_is_compressible(set)) {
        const sph_real r = o->rho[0][p], d = b->drho[0][i];
        const sph_real mid = r + half * d;
        b->rho[0][i] = momentum ? r + dt * d : 2 * mid - r;
    }
    if (!sph_is_matter(set)) {
        sph_advance_wall(sim, set, i, t);
        return;
    }
    double move[SPH_DIM];
    sph_pos from[SPH_DIM];
    const uint32_t held = sph_held(sim, set);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (held >> k & 1) { /* where its group is by now */
            move[k] = 0;
            from[k] = (sph_pos)(o->pos[k][p] + sph_wall_step(sim, set, k));
            b->vel[k][i] = (sph_real)sph_wall_velocity(sim, set, k);
            continue;
        }
        const sph_real *beside = sph_drift(sim, b, k);
        const sph_real v = o->vel[k][p], half_v = v + half * o->acc[k][p];
        const sph_real a = b->acc[k][i], x = beside ? beside[i] : 0;
        const sph_real mid = v + half * a;
        const sph_real u = momentum ? (sph_real)0.5 * ((v + dt * o->acc[k][p]) + v) : half_v;
        move[k] = (double)dt * (double)(u + x);
        from[k] = o->pos[k][p];
        b->vel[k][i] = (sph_real)sim->cfg.damping * (momentum ? v + dt * a : 2 * mid - v);
    }
    sph_place(sim, i, move, from, t);
}

#endif
