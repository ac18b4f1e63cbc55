/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* powers.c: the books. The force sweep leaves the powers of each particle (POWER_..., W/kg) in power[]; here they are
   summed and integrated over time by the trapezoidal rule. What happens at once (JUMP_..., J) is added as it happens:
   velocities of held sets that leap, particles put back or removed, damage, damping, the Shepard filter.

   Arrays: power (7 reals a particle), partial (13 doubles a chunk). Cost: a loop over particles in double at a step's
   end. */
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(powers)

#if SPH_WITH_BOOKS
double *sph_open_books(const sph_sim *sim, uint32_t chunk)
{
    if (!sim->cfg.books)
        return NULL;
    return memset(sph_book_row(sim, chunk), 0, SPH_PARTIALS * sizeof(double));
}

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

/* What damping has taken from a particle, J/kg: each time that v became g v it took (1/g^2 - 1)/2 v^2 of the new v; two
   times, (1/g^4 - 1)/2 v^2, but for the kick between them. */
static double damping_loss(const sph_sim *sim, const sph_set *set, const sph_buffer *b, uint32_t i)
{
    const double g2 = sim->cfg.damping * sim->cfg.damping, whole = sim->stage->damps ? g2 * g2 : g2;
    const uint32_t held = sph_held(sim, set);
    double v2 = 0;
    for (uint32_t k = 0; k < SPH_DIM && !sph_flow_of(sim, set); k++)
        v2 += held >> k & 1 ? 0 : (double)b->vel[k][i] * (double)b->vel[k][i];
    return 0.5 * (1 / whole - 1) * v2;
}

/* sums of powers for the books: one row a chunk, added up in order of chunks afterwards */
void sph_sum_powers(const sph_sim *sim, sph_span s, double *row)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const bool damps = sim->cfg.damping < 1 && sim->dt > 0;
    for (uint32_t i = s.first; row && i < s.last; i++) {
        const sph_set *set = &sim->set[b->set[0][i]]; /* of the dead: never read */
        if (b->set[0][i] == SPH_DEAD || !sph_is_matter(set)) /* walls were in no sums */
            continue;
        row[JUMP_HELD] += set->mass * held_gain(sim, set);
        if (damps)
            row[JUMP_DAMPED] += set->mass * damping_loss(sim, set, b, i);
        for (uint32_t k = 0; k < SPH_POWERS; k++)
            row[k] += set->mass * (double)sim->power[k][i];
    }
}

/* books: powers integrate by the trapezoidal rule */
sph_status sph_add_powers(sph_sim *sim)
{
    sph_scalars *const n = &sim->next;
    if (!sim->cfg.books)
        return SPH_OK;
    for (uint32_t k = 0; k < SPH_POWERS; k++) {
        n->power[k] = sph_sum_rows(sim, k);
        n->work[k] += sph_work_of(sim, sim->now.power[k], n->power[k]);
    }
    n->work[POWER_WALL] += sph_sum_rows(sim, JUMP_HELD);
    n->carried_off += sph_sum_rows(sim, JUMP_REMOVED);
    n->released += sph_sum_rows(sim, JUMP_RELEASED);
    n->put_back_loss += sph_sum_rows(sim, JUMP_PUT_BACK);
    n->damped += sph_sum_rows(sim, JUMP_DAMPED);
    return SPH_OK;
}
sph_status sph_first_powers(sph_sim *sim)
{
    for (uint32_t k = 0; k < SPH_POWERS && sim->cfg.books; k++)
        sim->next.power[k] = sph_sum_rows(sim, k);
    return SPH_OK;
}
#endif
