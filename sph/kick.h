/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* kick.h: velocities and densities after the sums, in the integrators that have one sort a step. Bodies are kicked,
   but along the axes on which they are held; walls have a density of their own only where they are compressible. */
#ifndef SPH_KICK_H
#define SPH_KICK_H

#include "motion.h"

/* v = damping (v + step a) of a run of one set, along the axes on which it is free; a less what it was in src if
   `less_old` */
SPH_INLINE void sph_kick_run(const sph_sim *sim, const sph_set *set, uint32_t first, uint32_t last, sph_real step,
                             bool less_old)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint32_t held = sph_held(sim, set), *at = b->id[0];
    const sph_real g = (sph_real)sim->cfg.damping;
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        sph_real *v = b->vel[k];
        const sph_real *a = b->acc[k], *old = o->acc[k];
        for (uint32_t i = first; i < last && !(held >> k & 1); i++)
            v[i] = g * (v[i] + step * (less_old ? a[i] - old[at[i]] : a[i]));
    }
}

/* predictor-corrector: v = damping (v_p + dt/2 (a - a_o)), rho = rho_p + dt/2 (drho - drho_o)  (Gray 2001 eqs 2.28,
   2.29) */
SPH_INLINE void sph_correct(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const sph_real half = (sph_real)sim->dt * (sph_real)0.5, *rate = b->drho[0], *old = o->drho[0];
    const uint32_t *at = b->id[0];
    sph_real *rho = b->rho[0];
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        const sph_set *set = &sim->set[b->set[0][i]];
        const bool body = sph_is_body(set);
        for (uint32_t j = i; j < e && (body || set->compressible); j++)
            rho[j] = rho[j] + half * (rate[j] - old[at[j]]);
        if (body)
            sph_kick_run(sim, set, i, e, half, true);
    }
}

/* v = damping (v + step a): kick-drift-kick by half a step, leap-frog by a whole one, with the new acceleration */
SPH_INLINE void sph_kick(const sph_sim *sim, sph_span s, sph_real step)
{
    const uint8_t *sets = sim->buf[sim->dst].set[0];
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(sets, i, s.last);
        if (sph_is_body(&sim->set[sets[i]]))
            sph_kick_run(sim, &sim->set[sets[i]], i, e, step, false);
    }
}

/* Leap-frog (Powell 2012 algorithm 1.1) and kick-drift-kick: the density goes a whole step with the rates of the
   half-step velocity at the new positions, like a position; then come the forces. (Taking the rates of the velocity
   at the ends, with one sweep, makes sound waves grow.) */
SPH_INLINE void sph_density_whole(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    for (uint32_t i = s.first; i < s.last; i++) {
        const sph_set *set = &sim->set[b->set[0][i]];
        if (sph_is_body(set) || set->compressible)
            b->rho[0][i] += (sph_real)sim->dt * b->drho[0][i];
    }
}

#endif
