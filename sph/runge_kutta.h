/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* runge_kutta.h: the second halves of the Runge-Kutta forms, of one particle (Wickramarachchi 2009). Buffer src is
   the middle of the step; positions and velocities are taken from it again. */
#ifndef SPH_RUNGE_KUTTA_H
#define SPH_RUNGE_KUTTA_H

#include "motion.h"

/* x moves by d (m); the faces' rules apply as in the sort */
SPH_INLINE void sph_place(const sph_sim *sim, uint32_t i, const double *d, const sph_pos *from, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    sph_pos q[SPH_DIM];
    sph_real v[SPH_DIM];
    bool short_way = true;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        double s = d[k] / sim->grid.quantum;
        short_way &= sph_abs(d[k]) < sim->grid.length[k] / sim->grid.ncell[k];
        q[k] = from[k] + (sph_pos)(short_way ? s < 0 ? s - 0.5 : s + 0.5 : 0);
        v[k] = b->vel[k][i];
    }
    if (!short_way)
        sph_fail_note(t, d[0] - d[0] == 0 ? SPH_MOVED_TOO_FAR : SPH_NOT_FINITE,
                      sph_source_id(sim, i), d[0]);
    int r = sph_enforce_faces(sim, q, v);
    if (r == 2) {
        t->left++;
        if (sim->cfg.on_leave == SPH_FAIL)
            sph_fail_note(t, SPH_OUT_OF_DOMAIN, sph_source_id(sim, i), (double)q[0] * sim->grid.quantum);
        else {
            if (SPH_WITH_BOOKS)
                sph_carry_off(sim, b, i, t);
            b->set[0][i] = SPH_DEAD;
        }
        return;
    }
    t->reflected += r == 1;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        b->pos[k][i] = q[k];
        b->vel[k][i] = v[k];
    }
}

/* the second halves of the Runge-Kutta forms, as printed: 3.86-3.87, and 3.92 */
SPH_INLINE void sph_runge_kutta(const sph_sim *sim, uint32_t i, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const bool momentum = SPH_IS(sim->cfg.integrator, RUNGE_KUTTA_MOMENTUM);
    const sph_real dt = (sph_real)sim->dt, half = dt * (sph_real)0.5;
    const uint32_t p = b->id[0][i];
    const sph_set *set = &sim->set[b->set[0][i]];
    if (sph_is_body(set) || set->compressible) {
        const sph_real r = o->rho[0][p], d = b->drho[0][i];
        const sph_real mid = r + half * d;
        b->rho[0][i] = momentum ? r + dt * d : 2 * mid - r;
    }
    if (!sph_is_body(set))
        return;
    double move[SPH_DIM];
    sph_pos from[SPH_DIM];
    const uint32_t held = sph_held(sim, set);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (held >> k & 1) { /* where the sort put it */
            move[k] = 0;
            from[k] = b->pos[k][i];
            continue;
        }
        const sph_real *beside = sph_drift(b, k);
        const sph_real v = o->vel[k][p], half_v = v + half * o->acc[k][p];
        /* a mirror face that turned the velocity at half time turned the frame of the forces there: turn it back */
        const sph_real turn = b->vel[k][i] == half_v ? 1 : -1;
        const sph_real a = turn * b->acc[k][i], x = beside ? turn * beside[i] : 0;
        const sph_real mid = v + half * a;
        const sph_real u = momentum ? (sph_real)0.5 * ((v + dt * o->acc[k][p]) + v) : half_v;
        move[k] = (double)dt * (double)(u + x);
        from[k] = o->pos[k][p];
        b->vel[k][i] = (sph_real)sim->cfg.damping * (momentum ? v + dt * a : 2 * mid - v);
    }
    sph_place(sim, i, move, from, t);
}

#endif
