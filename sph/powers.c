/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* powers.c: work and dissipation for the books. The force sweep leaves the powers of each particle (viscosity, walls,
   diffusion, body force; W/kg) in power[]; here they are summed and integrated over time by the trapezoidal rule.

   Arrays: power (4 reals a particle), partial (5 doubles a chunk). Cost: a loop over particles in double at a step's
   end. */
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(powers)

#if SPH_WITH_BOOKS
/* what the motion of a held set has added to its kinetic energy in this step, J/kg: exact, so that velocities may
   jump */
static double held_gain(const sph_sim *sim, const sph_set *set)
{
    const uint32_t held = sph_held(sim, set);
    double gain = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (held >> k & 1) {
            const double v = sph_wall_velocity(sim, set, k), before = sim->now.group[set->group].vel[k];
            gain += 0.5 * (v * v - before * before);
        }
    return gain;
}

/* sums of powers for the books: one row a chunk, added up in order of chunks afterwards */
void sph_sum_powers(const sph_sim *sim, uint32_t chunk, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    double sum[SPH_PARTIALS] = {0};
    if (!sim->cfg.books)
        return;
    for (uint32_t i = s.first; i < s.last; i++) {
        if (b->set[0][i] == SPH_DEAD)
            continue;
        const sph_set *set = &sim->set[b->set[0][i]];
        sum[SPH_POWERS] += set->mass * held_gain(sim, set);
        double d = (double)b->rho[0][i], rho = set->rho0 * (1 + d);
        const bool body = sph_is_body(set); /* walls were in no sums */
        for (uint32_t k = 0; k < SPH_POWERS && body; k++) {
            double p = set->mass * (double)sim->power[k][i];
            sum[k] += k == 2 ? p * -sph_pressure(sim, set, d) / (rho * rho) : p; /* energy that diffusion takes */
        }
    }
    memcpy(sim->partial + (size_t)chunk * SPH_PARTIALS, sum, sizeof sum);
}

/* books: powers integrate by the trapezoidal rule */
sph_status sph_add_powers(sph_sim *sim)
{
    if (!sim->cfg.books)
        return SPH_OK;
    for (uint32_t k = 0; k < SPH_PARTIALS; k++) {
        double sum = 0;
        for (uint32_t c = 0; c < sph_local_chunks(sim); c++)
            sum += sim->partial[(size_t)c * SPH_PARTIALS + k];
        if (k == SPH_POWERS) {
            sim->next.work[1] += sum;
            break;
        }
        sim->next.work[k] += 0.5 * sim->dt * (sim->now.power[k] + sum);
        sim->next.power[k] = sum;
    }
    return SPH_OK;
}
sph_status sph_first_powers(sph_sim *sim)
{
    double keep[SPH_POWERS];
    memcpy(keep, sim->next.work, sizeof keep);
    sph_status st = sph_add_powers(sim);
    memcpy(sim->next.work, keep, sizeof keep);
    return st;
}
#endif
