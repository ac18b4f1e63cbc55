/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damping.c: damping of velocities by a rate in time, dv/dt = -r v (Gray 2001 eq 2.29 damps by a factor a step, so that
   the result depends on the step): v' = v exp(-r dt), exact, the same in every integrator.

   When: half of it before all else of the step, with which velocities go into the sort (move.c), half when all else is
   done: exp(-r dt/2) A exp(-r dt/2), of second order, any dt. The leap-frog's velocities are of middles, so there half
   of it lies before the kick and half behind, v' = e (e v + dt a) with e = exp(-r dt/2), and before the sort what
   brings them from half of the last step ahead to half of this. Axes along which a set is held, flows and walls are not
   damped.

   Array: slowing (a double for each chunk of a local pass). Cost: two local passes; a product a component in sorts. */
#include "dmath.h"
#include "motion.h"
#include "arithmetic.h"

SPH_OBJECT(damping)

#if SPH_WITH_DAMPING_RATE
/* m v^2/2 of a particle along the axes that are free */
static double free_energy(const sph_sim *sim, const sph_buffer *b, uint32_t i, const sph_set *set)
{
    const uint32_t held = sph_held(sim, set);
    double v2 = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        v2 += held >> k & 1 ? 0 : (double)b->vel[k][i] * (double)b->vel[k][i];
    return 0.5 * set->mass * v2;
}

/* whether a set's velocities are its own */
static bool is_free(const sph_sim *sim, uint8_t set)
{
    return set != SPH_DEAD && sph_is_matter(&sim->set[set]) && !sph_flow_of(sim, &sim->set[set]);
}

/* what the factor before the sort took: of who was free in it and still is (flow.c has come between) */
static void damping_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const double factor = (double)sph_slowed_by(sim);
    double sum = 0;
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = b->set[0][i];
        const uint32_t p = b->id[0][i];
        if (is_free(sim, set) && is_free(sim, o->set[0][p]))
            sum += free_energy(sim, o, p, &sim->set[set]);
    }
    sim->slowing[chunk] = sum * (1 - factor * factor);
    t->work += span.last - span.first;
}
static sph_status add_losses(sph_sim *sim)
{
    double sum = 0;
    for (uint32_t chunk = 0; chunk < sph_local_chunks(sim); chunk++)
        sum += sim->slowing[chunk];
    sim->next.slowed += sum;
    return SPH_OK;
}
static bool damps_first(const sph_sim *sim) { return sph_slows(&sim->cfg) && sph_begins_step(sim); }
const sph_pass sph_pass_damping = {"damping", sph_local_chunks, damping_chunk, add_losses, damps_first};

/* v' = factor v + rest a; returns what the particle loses, J */
static double slow(const sph_sim *sim, const sph_set *set, uint32_t i, sph_real factor, sph_real rest)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t held = sph_held(sim, set);
    const double before = free_energy(sim, b, i, set);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (!(held >> k & 1))
            b->vel[k][i] = b->vel[k][i] * factor + rest * b->acc[k][i];
    return before - free_energy(sim, b, i, set);
}
static void damping_end_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const uint8_t *sets = sim->buf[sim->dst].set[0];
    const double half = sph_exp(-0.5 * sim->cfg.damping_rate * sim->dt);
    const bool leaps = SPH_IS(sim->cfg.integrator, LEAP_FROG);
    const sph_real factor = (sph_real)(leaps ? half * half : half);
    const sph_real rest = (sph_real)(leaps ? (half - half * half) * sim->dt : 0);
    double sum = 0;
    for (uint32_t i = span.first; i < span.last; i++)
        if (is_free(sim, sets[i]))
            sum += slow(sim, &sim->set[sets[i]], i, factor, rest);
    sim->slowing[chunk] = sum;
    t->work += span.last - span.first;
}
static bool damps_by_rate(const sph_sim *sim) { return sph_slows(&sim->cfg); }
const sph_pass sph_pass_damping_end = {"damping's end", sph_local_chunks, damping_end_chunk, add_losses, damps_by_rate};
#endif
