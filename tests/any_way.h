/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* any_way.h: one scene run whole, in slices, with threads in any order, and from a dump in its middle: the same bits.
   What every module's test asks for. */
#ifndef TESTS_ANY_WAY_H
#define TESTS_ANY_WAY_H

#include "testing.h"

/* a dump in memory; size: what was put, at: what was got of it */
typedef struct dump_bytes {
    unsigned char data[1 << 21];
    size_t size, at;
} dump_bytes;
static UNUSED bool put_bytes(void *ctx, const void *data, size_t n)
{
    dump_bytes *b = ctx;
    if (n > sizeof b->data - b->size)
        return false;
    memcpy(b->data + b->size, data, n);
    b->size += n;
    return true;
}
static UNUSED bool get_bytes(void *ctx, void *data, size_t n)
{
    dump_bytes *b = ctx;
    if (b->at + n > b->size)
        return false;
    memcpy(data, b->data + b->at, n);
    b->at += n;
    return true;
}
static UNUSED dump_bytes middle_dump; /* of the latest run */

static UNUSED void make_steps(sph_sim *sim, uint32_t steps)
{
    for (uint32_t k = 0; k < steps; k++)
        must(sim, sph_step(sim));
}

/* make: a new simulation of the scene, the same each time. Returns the one that was run whole. */
static UNUSED sph_sim *same_bits_any_way(sph_config c, sph_sim *(*make)(const sph_config *c), uint32_t steps)
{
    shuffle s;
    c.max_threads = 3;
    sph_sim *whole = make(&c), *other = make(&c), *late = make(&c);
    middle_dump.size = middle_dump.at = 0;
    make_steps(whole, steps / 2);
    must(whole, sph_dump(whole, SPH_DUMP_FULL, put_bytes, &middle_dump));
    make_steps(whole, steps - steps / 2);
    must(late, sph_restore(late, get_bytes, &middle_dump));
    make_steps(late, steps - steps / 2);
    assert_true(sph_hash(late) == sph_hash(whole));
    for (uint64_t budget = 1; budget <= 10000; budget *= 10) {
        sph_sim *sliced = make(&c);
        for (uint32_t k = 0; k < steps;) {
            const sph_status st = sph_step_slice(sliced, budget);
            assert_true(st == SPH_OK || st == SPH_NOT_DONE);
            k += st == SPH_OK;
        }
        assert_true(sph_hash(sliced) == sph_hash(whole));
    }
    c.port = shuffle_port(&s, 3);
    must(other, sph_reconfigure(other, &c));
    make_steps(other, steps);
    assert_true(s.calls > steps && sph_hash(other) == sph_hash(whole));
    return whole;
}

#endif
