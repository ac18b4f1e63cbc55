/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* evening.c: XSPH in the velocity itself, not only in what moves the positions (Powell 2012 eq 2.71): once a step, at its
   end, v_i += u_i with the sums u of the step's last forces (xsph.h, whose weights they have). The weights m_j/rho_mean
   are those of pairs, so momentum stays to rounding; what it takes of the kinetic energy is the book `evened`.
   Positions then go with v alone. By steps, as printed: so what it takes in a time depends on the step. Not along axes on
   which a set is held.

   Array: evening (a double for each chunk of a local pass). Cost: that of XSPH, and a local pass. */
#include "motion.h"
#include "arithmetic.h"

SPH_OBJECT(evening)

#if SPH_HAS_XSPH_VELOCITY
sph_status sph_check_evening(const sph_config *c, sph_report *r)
{
    if (c->xsph_velocity && !sph_uses_xsph(c))
        return sph_refuse(r, "xsph_velocity", "false without xsph", 1);
    if (c->xsph_velocity && sph_smooths_strain(c))
        return sph_refuse(r, "xsph_velocity", "false with xsph_strain", 1);
    return SPH_OK;
}

static void evening_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    double sum = 0;
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = b->set[0][i];
        if (set == SPH_DEAD || !sph_is_matter(&sim->set[set]))
            continue;
        double lost = 0;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const double v = (double)b->vel[k][i];
            b->vel[k][i] += b->xsph[k][i]; /* 0 along held axes */
            lost += v * v - (double)b->vel[k][i] * (double)b->vel[k][i];
        }
        sum += 0.5 * sim->set[set].mass * lost;
    }
    sim->evening[chunk] = sum;
    t->work += span.last - span.first;
}
static sph_status evening_end(sph_sim *sim)
{
    double sum = 0;
    for (uint32_t chunk = 0; chunk < sph_local_chunks(sim); chunk++)
        sum += sim->evening[chunk];
    sim->next.evened += sum;
    return SPH_OK;
}
static bool evens(const sph_sim *sim) { return sph_evens(&sim->cfg); }
const sph_pass sph_pass_evening = {"evening", sph_local_chunks, evening_chunk, evening_end, evens};
#endif
