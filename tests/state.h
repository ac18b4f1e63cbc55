/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* state.h: a copy of the whole committed state, every array of the current buffer and every scalar, to compare with bit
   for bit after a call that failed. */
#ifndef SPH_TEST_STATE_H
#define SPH_TEST_STATE_H

#include <stdlib.h>

#include "sph/internal.h"

#ifndef UNUSED
#define UNUSED __attribute__((unused))
#endif

typedef struct snapshot {
    uint64_t hash, setup;
    uint32_t cur, sets, groups;
    sph_scalars now;
    sph_config cfg;
    unsigned char *arrays;
    size_t bytes;
} snapshot;

/* copies the arrays of the current buffer to `to` and compares them with `with` (each may be null); returns their
   bytes, or 0 if they differ */
static UNUSED size_t state_arrays(const sph_sim *sim, unsigned char *to, const unsigned char *with)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    size_t at = 0;
#define STATE_FIELD(name, type, comps, unit, when, way)                                                          \
    for (uint32_t k = 0; k < (comps); k++)                                                                  \
        if (b->name[k]) {                                                                                   \
            const size_t bytes = sizeof(type) * sim->now.count;                                             \
            if (to)                                                                                         \
                memcpy(to + at, b->name[k], bytes);                                                         \
            if (with && memcmp(with + at, b->name[k], bytes) != 0)                                          \
                return 0;                                                                                   \
            at += bytes;                                                                                    \
        }
    SPH_STATE_FIELDS(STATE_FIELD)
#undef STATE_FIELD
    return at;
}

static UNUSED void keep_state(const sph_sim *sim, snapshot *s)
{
    s->hash = sph_hash(sim);
    s->setup = sim->setup_hash;
    s->cur = sim->cur;
    s->sets = sim->sets;
    s->groups = sim->groups;
    memcpy(&s->now, &sim->now, sizeof s->now);
    memcpy(&s->cfg, &sim->cfg, sizeof s->cfg);
    s->bytes = state_arrays(sim, NULL, NULL);
    s->arrays = malloc(s->bytes + 1);
    if (s->arrays)
        state_arrays(sim, s->arrays, NULL);
}

/* whether nothing of it has changed */
static UNUSED bool state_same(const sph_sim *sim, const snapshot *s)
{
    return s->arrays && sph_hash(sim) == s->hash && sim->setup_hash == s->setup && sim->cur == s->cur &&
           sim->sets == s->sets && sim->groups == s->groups && memcmp(&s->now, &sim->now, sizeof s->now) == 0 &&
           memcmp(&s->cfg, &sim->cfg, sizeof s->cfg) == 0 && state_arrays(sim, NULL, s->arrays) == s->bytes;
}

/* the same; frees the copy */
static UNUSED bool state_kept(const sph_sim *sim, snapshot *s)
{
    const bool same = state_same(sim, s);
    free(s->arrays);
    s->arrays = NULL;
    return same;
}

#endif
