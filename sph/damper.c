/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damper.c: an acoustic damper: a pressure that resists the change of density, in the momentum equation and in what
   Adami's walls see, and nowhere else:

     q_i = theta h c0 D_i,   D = d(rho)/dt,   p_i + q_i for p_i; with the pressure floor at least 0 together

   A bulk viscosity theta h c0 between particles: sound of wave number k dies at the rate theta h c0 k^2/2, and flow
   without divergence feels nothing. It conserves what the pressure conserves. Its power is q D/rho^2 a unit of mass,
   never below 0 without the floor: kinetic energy gives (p + q)/rho^2 of continuity's part of D, density takes p/rho^2 of
   all of D, and diffusion books (p + q)/rho^2 of its own part.

   When: D of the forces' own time, to second order, from rates that stand already. Kick-drift-kick and leap-frog have D of
   this step's middle and of the last one's, the predictor-corrector of the step's beginning and what it rose by. The
   first forces of a scene know of no D: of second order from a start without any. What it takes in a step is of the
   middle. Runge-Kutta has no D behind it, a summed density none at all.

   Arrays: damper_press (a real a particle), damper_loss (a double for each chunk of a local pass). Cost: two local
   passes; the equation of state once more. It shortens what a step may be (factors.c). */
#include "eos.h"
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(damper)

#if SPH_WITH_DAMPER
sph_status sph_check_damper(const sph_config *c, sph_report *r)
{
    const bool printed = SPH_IS(c->scheme, STANDARD_WICK) || SPH_IS(c->scheme, WEAK_WICK);
    if (!sph_quiets(c))
        return SPH_OK;
    if (sph_has_solids(c))
        return sph_refuse(r, "damper", "0 in scenes with solids", c->damper);
    if (c->integrator >= SPH_RUNGE_KUTTA)
        return sph_refuse(r, "damper", "0 with Runge-Kutta", c->damper);
    if (sph_sums_density(c) || printed)
        return sph_refuse(r, "damper", "0 unless density goes by plain continuity", c->damper);
    return SPH_OK;
}

/* q/rho0 of a particle, m^2/s^2: drho in 1/s */
static double quiet_press(const sph_sim *sim, const sph_set *set, double excess, double drho)
{
    const double q = sim->cfg.damper * sim->cfg.smoothing_length * set->c0 * drho;
    if (!sph_has_floor(sim, set) || !(q < 0))
        return q;
    const double most = -sph_pressure(sim, set, excess) / set->rho0;
    return q < most ? most : q;
}

/* ---- the pass before the forces ---- */

/* what the rates say of the forces' time: that of a step's end */
static double rate_at_end(const sph_sim *sim, uint32_t i)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint32_t p = b->id[0][i];
    const double dt = sim->dt, last = sim->now.dt_last, before = (double)o->drho[0][p];
    if (!sim->now.primed)
        return 0;
    if (sph_foresees(&sim->cfg)) {
        const double ratio = dt < 2 * last ? dt / last : 2;
        return before + 2 * (double)o->rise[0][p] * ratio;
    }
    const double middle = (double)b->drho[0][i];
    return middle + (middle - before) * (dt / (dt + last));
}

static void damper_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = b->set[0][i];
        const bool body = set != SPH_DEAD && sph_is_matter(&sim->set[set]);
        const sph_set *s = &sim->set[body ? set : 0];
        const double q = body ? quiet_press(sim, s, (double)b->rho[0][i], rate_at_end(sim, i)) : 0;
        sim->damper_press[i] = (sph_real)(q * s->rho0);
    }
    t->work += span.last - span.first;
}
static bool damps_sound(const sph_sim *sim) { return sph_quiets(&sim->cfg); }
const sph_pass sph_pass_damper = {"damper", sph_local_chunks, damper_chunk, NULL, damps_sound};

/* ---- the book: what the step took ---- */

static void damper_book_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    double sum = 0;
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = b->set[0][i];
        if (set == SPH_DEAD || !sph_is_matter(&sim->set[set]))
            continue;
        const double d = (double)b->rho[0][i], rise = sph_foresees(&sim->cfg) ? (double)b->rise[0][i] : 0;
        const double drho = (double)b->drho[0][i] - rise; /* of the step's middle */
        sum += sim->set[set].mass * quiet_press(sim, &sim->set[set], d, drho) * drho / ((1 + d) * (1 + d));
    }
    sim->damper_loss[chunk] = sum;
    t->work += span.last - span.first;
}
static sph_status damper_book_end(sph_sim *sim)
{
    double sum = 0;
    for (uint32_t chunk = 0; chunk < sph_local_chunks(sim); chunk++)
        sum += sim->damper_loss[chunk];
    sim->next.quieted += sim->dt * sum;
    return SPH_OK;
}
const sph_pass sph_pass_damper_book = {"damper's book", sph_local_chunks, damper_book_chunk, damper_book_end,
                                       damps_sound};
#endif
