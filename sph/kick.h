/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* kick.h: velocities, densities and places after the sums, in the integrators that have one sort a step. Bodies are
   kicked, but along the axes on which they are held; walls have a density of their own only where they are
   compressible. */
#ifndef SPH_KICK_H
#define SPH_KICK_H

#include "motion.h"

/* v = v + step a with the acceleration a of the step's beginning, along the axes on which a run of one set is free; on
   others it moves as it is told: velocities of a step's middle become those of its end, to second order */
SPH_INLINE void sph_foresee_run(const sph_sim *sim, const sph_set *set, uint32_t first, uint32_t last, sph_real step)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint32_t held = sph_held(sim, set), *at = b->id[0];
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        sph_real *v = b->vel[k];
        const sph_real *old = o->acc[k];
        const bool free = !(held >> k & 1), mirrors = free && sph_has_mirrors(&sim->cfg, k);
        for (uint32_t i = first; i < last && !free; i++)
            v[i] = (sph_real)sim->next.group[set->group].vel[k];
        for (uint32_t i = first; i < last && mirrors; i++)
            v[i] = v[i] + sph_turn(sim, k, i) * (step * old[at[i]]);
        for (uint32_t i = first; i < last && free && !mirrors; i++)
            v[i] = v[i] + step * old[at[i]];
    }
}

/* v = damping (v + step (times a - a_o)) of a run of one set, along the axes on which it is free, with the acceleration
   a_o of the step's beginning */
SPH_INLINE_BIG void sph_kick_run(const sph_sim *sim, const sph_set *set, uint32_t first, uint32_t last, sph_real step,
                                 sph_real times)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint32_t held = sph_held(sim, set), *at = b->id[0];
    const sph_real g = (sph_real)sim->cfg.damping;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        sph_real *v = b->vel[k];
        const sph_real *a = b->acc[k], *old = o->acc[k];
        const bool free = !(held >> k & 1), mirrors = free && sph_has_mirrors(&sim->cfg, k);
        for (uint32_t i = first; i < last && mirrors; i++)
            v[i] = g * (v[i] + step * (times * a[i] - sph_turn(sim, k, i) * old[at[i]]));
        for (uint32_t i = first; i < last && free && !mirrors; i++)
            v[i] = g * (v[i] + step * (times * a[i] - old[at[i]]));
    }
}

/* Predictor-corrector: rho = rho_o + dt/2 (drho_o + drho) and v = damping (v_p + dt/2 (a - a_o))  (Gray 2001 eqs 2.28,
   2.29). Where the rise e of the rate is foreseen, the predicted density was rho_o + dt drho_o + dt (dt/dt_o) e_o, of
   third order, and e = (drho - drho_o)/2. On an oscillation w that multiplies the amplitude by 1 - (w dt)^4/8 a step
   instead of 1 + (w dt)^4/4: sound of the shortest waves dies away instead of growing (factors.c). */
SPH_INLINE void sph_correct(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const sph_real half = (sph_real)sim->dt * (sph_real)0.5, *rate = b->drho[0], *old = o->drho[0];
    const bool foresees = !sph_has_solids(&sim->cfg);
    const sph_real foresight = foresees ? sph_stage_move(sim).foresight : 0;
    const uint32_t *at = b->id[0];
    sph_real *rho = b->rho[0];
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        const sph_set *set = &sim->set[b->set[0][i]];
        const bool matter = sph_is_matter(set), evolves = matter || sph_is_compressible(set);
        for (uint32_t j = i; j < e && evolves && !foresees; j++)
            rho[j] = rho[j] + half * (rate[j] - old[at[j]]);
        for (uint32_t j = i; j < e && evolves && foresees; j++) {
            const sph_real rise = rate[j] - old[at[j]];
            rho[j] = rho[j] + (half * rise - foresight * o->rise[0][at[j]]);
            b->rise[0][j] = rise * (sph_real)0.5;
        }
        if (matter)
            sph_kick_run(sim, set, i, e, half, 1);
    }
}

/* v = damping (v + step (times a - a_o)): kick-drift-kick by half a step, from the velocity that was foreseen;
   leap-frog by a whole one, from that of the middle */
SPH_INLINE void sph_kick(const sph_sim *sim, sph_span s, sph_real times)
{
    const sph_real half = (sph_real)sim->dt * (sph_real)0.5;
    const uint8_t *sets = sim->buf[sim->dst].set[0];
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(sets, i, s.last);
        if (sph_is_matter(&sim->set[sets[i]]))
            sph_kick_run(sim, &sim->set[sets[i]], i, e, half, times);
    }
}

/* Kick-drift-kick and leap-frog (Powell 2012 algorithm 1.1), between the rates of a step's middle and the forces at its
   end: density goes a whole step from the step's beginning, and velocities, those of the middle so far, foreseen. */
SPH_INLINE void sph_to_the_end(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const sph_real dt = (sph_real)sim->dt;
    const uint32_t *at = b->id[0];
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        const sph_set *set = &sim->set[b->set[0][i]];
        for (uint32_t j = i; j < e && (sph_is_matter(set) || sph_is_compressible(set)); j++)
            b->rho[0][j] = o->rho[0][at[j]] + dt * b->drho[0][j];
        if (sph_is_matter(set))
            sph_foresee_run(sim, set, i, e, dt * (sph_real)0.5);
    }
}

/* x moves by d (m) from a place in the frame in which the particle stands; the faces' rules apply as in the sort */
SPH_INLINE_BIG void sph_place(const sph_sim *sim, uint32_t i, const double *d, const sph_pos *from, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    sph_pos q[SPH_DIM];
    const double part = (double)sph_rounding(sim);
    bool short_way = true;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        double s = d[k] / sim->grid.quantum;
        short_way &= sph_abs(d[k]) < sim->grid.length[k] / sim->grid.ncell[k];
        q[k] = from[k] + (sph_pos)(short_way ? s < 0 ? s - part : s + part : 0);
    }
    if (!short_way)
        sph_fail_note(t, d[0] - d[0] == 0 ? SPH_MOVED_TOO_FAR : SPH_NOT_FINITE,
                      sph_source_id(sim, i), d[0]);
    const uint32_t turned = sph_enforce_faces(sim, q);
    if (turned & SPH_LEFT) {
        t->left++;
        if (sim->cfg.on_leave == SPH_FAIL || !sph_is_matter(&sim->set[b->set[0][i]]))
            sph_note_left(sim, q, sph_source_id(sim, i), t);
        else {
            if (SPH_WITH_BOOKS)
                sph_carry_off(sim, b, i, t);
            b->set[0][i] = SPH_DEAD;
        }
        return;
    }
    for (uint32_t k = 0; k < SPH_DIM; k++)
        b->pos[k][i] = q[k];
    if (!SPH_HAS_MIRRORS || !turned)
        return;
    t->reflected++;
    sph_turn_fields(sim, i, turned);
}

/* XSPH: places went with the drift velocity u_o that stood at the step's beginning. What they lack to second order is
   dt/2 (u - u_o). Runge-Kutta drifts with u of the middle. */
SPH_INLINE_BIG void sph_mend_drift(const sph_sim *sim, sph_span s, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const sph_real half = (sph_real)sim->dt * (sph_real)0.5;
    if (!sph_drift(sim, b, 0))
        return;
    for (uint32_t i = s.first; i < s.last; i++) {
        double d[SPH_DIM];
        sph_pos from[SPH_DIM];
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const sph_real turn = sph_has_mirrors(&sim->cfg, k) ? sph_turn(sim, k, i) : 1;
            d[k] = (double)(half * (sph_drift(sim, b, k)[i] - turn * sph_drift(sim, o, k)[b->id[0][i]]));
            from[k] = b->pos[k][i];
        }
        if (sph_is_matter(&sim->set[b->set[0][i]]))
            sph_place(sim, i, d, from, t);
    }
    sph_displace_again(sim, s);
}

#endif
