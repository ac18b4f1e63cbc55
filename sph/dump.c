/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dump.c: sph_dump, which writes the state as a stream of bytes (dump.h). */
#include "dump.h"
#include "arithmetic.h"

SPH_OBJECT(dump)

#if SPH_WITH_DUMP
static bool write_all(sph_stream *s, const sph_sim *sim, uint32_t fields, uint64_t bytes, uint32_t sections)
{
    sph_run r;
    memset(&r, 0, sizeof r);
#define KEEP(A, name, kind, start, low, high, in, allowed, change, ...) KEEP_##change(name)
#define KEEP_FREE(name) memcpy(&r.name, &sim->cfg.name, sizeof r.name);
#define KEEP_FIXED(name)
#define KEEP_ROOM(name)
    SPH_OPTIONS(KEEP, KEEP, )
#undef KEEP
#undef KEEP_FREE
#undef KEEP_FIXED
#undef KEEP_ROOM
    r.work = sim->last_work;
    r.pairs = sim->last_pairs;
    r.passes = sim->last_passes;
    r.limit = sim->last_limit;
    return sph_write_preamble(s, (fields & SPH_DUMP_FULL) != 0, bytes, sections) && sph_move_setup(s, sim) &&
           sph_move_scalars(s, sim, &sim->now, NULL, &r, NULL) &&
           sph_move_arrays(s, sim, &sim->buf[sim->cur], fields, sim->now.count) && sph_move_end(s);
}

sph_status sph_dump(const sph_sim *sim, uint32_t fields, sph_sink sink, void *ctx)
{
    const uint32_t known = SPH_DUMP_FULL | SPH_DUMP_PICTURE | SPH_DUMP_ACCELERATION;
    if (!sim || !sink || (fields & ~known))
        return SPH_BAD_ARGUMENT;
    sph_stream s;
    memset(&s, 0, sizeof s);
    write_all(&s, sim, fields, 0, 0); /* to count */
    const uint64_t bytes = s.bytes;
    const uint32_t sections = s.sections;
    memset(&s, 0, sizeof s);
    s.sink = sink;
    s.ctx = ctx;
    write_all(&s, sim, fields, bytes, sections);
    return s.fail.status;
}
#endif
