/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* state.c: what every file above may ask of a simulation: a failure reported with the pass it happened in, and the
   digest of a state buffer. */
#include "internal.h"

sph_status sph_error(sph_sim *sim, sph_status s, const char *what, const char *allowed, double value, uint32_t particle)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    const char *pass = sim->begun && sim->pc < sim->passes ? sim->program[sim->pc]->name : "";
    return sph_raise(&sim->report, &sim->cfg.port, &(sph_report){s, what, allowed, pass, value, particle});
}

uint64_t sph_hash_buffer(const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    uint64_t h = 0x5350482d68617368u;
    (void)sim;
#define MIX(name, type, comps, unit, when, way)                                                                       \
    for (uint32_t k = 0; k < (comps); k++)                                                                            \
        if (b->name[k])                                                                                               \
            h = sph_mix_array(h, b->name[k], sizeof(type), n);
    SPH_STATE_FIELDS(MIX)
#undef MIX
    return h;
}
