/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_hash.c: sph hash. For a full dump the number that sph_hash gave of that state (the mixing is that of
   sph/digest.c);
   for a reduced one a digest of its arrays. */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"

#include <string.h>

static const char help[] =
    "usage: sph hash DUMP...\n"
    "Prints a 64-bit digest of each dump's contents and its name. Of a full dump it is the state hash that the kernel\n"
    "itself gives (sph_hash); of a reduced dump, a digest of the arrays that are there and of the time.\n";

static uint64_t mix(uint64_t h, uint64_t v)
{
    h = (h ^ v) * 0x9e3779b97f4a7c15u;
    h ^= h >> 32;
    h *= 0xbf58476d1ce4e5b9u;
    return h ^ (h >> 29);
}

static uint64_t mix_array(uint64_t h, const dump_section *s)
{
    /* stored bits are hashed as they are: a negative 32-bit position without its sign extension */
    const uint64_t mask = dump_type_bytes(s->type) == 4 ? 0xffffffffu : 0xffffffffffffffffu;
    for (uint32_t k = 0; k < s->comps; k++)
        for (uint64_t i = 0; i < s->count; i++)
            h = mix(h, dump_bits(s, k, i) & mask);
    return h;
}

static uint64_t bits(const dump_file *d, const char *record, const char *field, uint64_t row, uint32_t comp)
{
    dump_member m;
    const dump_section *s = dump_find(d, record);
    return dump_find_member(s, field, &m) && row < s->count && comp < m.comps ? dump_member_bits(s, &m, row, comp) : 0;
}

static uint64_t hash_state(const dump_file *d, uint64_t h)
{
    h = mix(mix(h, bits(d, "state", "time", 0, 0)), bits(d, "state", "dt", 0, 0));
    h = mix(mix(h, d->step), d->n);
    h = mix(h, bits(d, "state", "primed", 0, 0) | bits(d, "state", "started", 0, 0) << 1);
    h = mix(mix(h, bits(d, "state", "peak_mu", 0, 0)), bits(d, "state", "peak_acc", 0, 0));
    const dump_section *groups = dump_find(d, "groups");
    for (uint64_t g = 0; g < groups->count; g++) {
        h = mix(h, bits(d, "groups", "removed", g, 0));
        for (uint32_t k = 0; k < d->dim; k++)
            h = mix(mix(h, bits(d, "groups", "moved", g, k)), bits(d, "groups", "velocity", g, k));
    }
    for (uint32_t k = 0; k < 4; k++)
        h = mix(mix(h, bits(d, "state", "work", 0, k)), bits(d, "state", "power", 0, k));
    return h;
}

static uint64_t hash_dump(const dump_file *d)
{
    uint64_t h = 0x5350482d68617368u;
    for (uint32_t k = 0; k < d->sections; k++)
        if (d->section[k].type != DUMP_RECORD && strcmp(d->section[k].name, "end") != 0)
            h = mix_array(h, &d->section[k]);
    return d->full ? hash_state(d, h) : mix(h, bits(d, "state", "time", 0, 0));
}

static bool hash_one(const dump_file *d, const char *name)
{
    printf("%016llx  %s\n", (unsigned long long)hash_dump(d), name);
    return true;
}

int cmd_hash(int argc, char **argv) { return dump_each(argc, argv, "hash", help, hash_one); }
