/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* hash.c: the digest of everything that the next step reads: the current state buffer, scalars, groups, books. */
#include "internal.h"
#include "arithmetic.h"

SPH_OBJECT(hash)

static uint64_t mix_books(uint64_t h, const sph_config *c, const sph_scalars *s)
{
    (void)c, (void)s;
#define MIX_BOOK(name, unit, when, what) h = (when) ? sph_mix_double(h, s->name) : h;
    SPH_BOOKS(MIX_BOOK)
    return h;
}

uint64_t sph_hash(const sph_sim *sim)
{
    if (!sim)
        return 0;
    const sph_scalars *s = &sim->now;
    uint64_t h = sph_hash_buffer(sim, &sim->buf[sim->cur], s->count);
    h = sph_mix_double(sph_mix_double(h, s->time), s->dt_last);
    h = sph_mix(sph_mix(h, s->step), s->count);
    h = sph_mix(h, (uint64_t)s->primed | (uint64_t)s->started << 1);
    h = sph_mix_double(h, (double)s->peaks.mu);
    h = sph_mix_double(h, (double)s->peaks.acc);
    for (uint32_t g = 0; g < sim->groups; g++) {
        h = sph_mix_double(sph_mix(h, s->group[g].removed), s->group[g].remove_at);
        for (int k = 0; k < SPH_DIM; k++)
            h = sph_mix_double(sph_mix(h, (uint64_t)s->group[g].moved[k]), s->group[g].vel[k]);
        for (int k = 0; k < 2 * SPH_DIM && sim->has_adami && sim->group[g].motion; k++)
            h = sph_mix_double(h, s->group[g].lag[k / SPH_DIM][k % SPH_DIM]);
    }
    if (SPH_WITH_FLOW && sim->cfg.max_flows)
        h = sph_mix(h, s->next_id);
    /* without books all are 0, and count as they did when there were four */
    const uint32_t powers = sph_keeps_books(&sim->cfg) ? SPH_POWERS : POWER_BODY_FORCE + 1;
    for (uint32_t k = 0; k < powers; k++)
        h = sph_mix_double(sph_mix_double(h, s->work[k]), s->power[k]);
    return mix_books(h, &sim->cfg, s);
}
