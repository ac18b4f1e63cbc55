/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* records.c: records of a dump (records.h). */
#include "records.h"

#include <float.h>
#include "arithmetic.h"

SPH_OBJECT(records)

#if SPH_WITH_DUMP || SPH_WITH_RESTORE
#define DUMP_FIELD 32u

static bool finite_double(double x) { return x - x == 0; }

static uint32_t record_comps(const sph_record *r)
{
    uint32_t n = 0;
    for (uint32_t f = 0; f < r->count; f++)
        n += r->fields[f].comps;
    return n;
}

static uint32_t member_code(uint32_t member)
{
    return member <= M_REAL ? SPH_F64 : member == M_POS ? SPH_I64 : SPH_U64;
}

static size_t member_bytes(uint32_t member)
{
    static const uint8_t size[] = {8, 8, sizeof(sph_real), sizeof(sph_pos), 8, 4, 1, sizeof(bool)};
    return size[member];
}

/* a member as 64 bits */
static uint64_t load_member(uint32_t member, const unsigned char *p)
{
    uint64_t u = 0;
    sph_real r;
    sph_pos q;
    uint32_t w;
    bool b;
    double d;
    switch (member) {
    case M_REAL:
        memcpy(&r, p, sizeof r);
        d = (double)r;
        memcpy(&u, &d, 8);
        return u;
    case M_POS: memcpy(&q, p, sizeof q); return (uint64_t)(int64_t)q;
    case M_U32: memcpy(&w, p, sizeof w); return w;
    case M_U8: return *p;
    case M_BOOL: memcpy(&b, p, sizeof b); return b;
    default: memcpy(&u, p, 8); return u;
    }
}

/* 64 bits into a member; false if it cannot hold the value, or the value is not finite */
static bool store_member(uint32_t member, uint64_t u, unsigned char *p)
{
    const uint32_t w = (uint32_t)u;
    const bool b = u != 0;
    double d;
    memcpy(&d, &u, 8);
    const sph_pos q = (sph_pos)(u < 0x8000000000000000u ? (int64_t)u : -(int64_t)~u - 1);
    if (!p)
        return false;
    switch (member) {
    case M_REAL:
        if (!finite_double(d) || (d < 0 ? -d : d) > (SPH_DOUBLE ? DBL_MAX : (double)FLT_MAX))
            return false;
        const sph_real r = (sph_real)d;
        memcpy(p, &r, sizeof r);
        return (double)r == d;
    case M_POS: memcpy(p, &q, sizeof q); return (uint64_t)(int64_t)q == u;
    case M_U32: memcpy(p, &w, sizeof w); return w == u;
    case M_U8: *p = (unsigned char)u; return u < 256;
    case M_BOOL: memcpy(p, &b, sizeof b); return u <= 1;
    case M_TIME: memcpy(p, &u, 8); return d == d;
    case M_DOUBLE: memcpy(p, &u, 8); return finite_double(d);
    default: memcpy(p, &u, 8); return true;
    }
}

/* names, units and types of a record's fields: written, or read and compared */
static bool move_fields(sph_stream *s, const sph_record *r)
{
    for (uint32_t f = 0; f < r->count; f++) {
        unsigned char d[DUMP_FIELD] = {0};
        sph_put_text(d, r->fields[f].name, 16);
        sph_put_text(d + 16, r->fields[f].unit, 12);
        d[28] = (unsigned char)member_code(r->fields[f].member);
        d[29] = r->fields[f].comps;
        memcpy(s->piece, d, DUMP_FIELD);
        if (!sph_move_payload(s, DUMP_FIELD))
            return false;
        if (s->source && !sph_same_bytes(s->piece, d, DUMP_FIELD))
            sph_stream_refuse_later(s, SPH_DUMP_CORRUPT, r->fields[f].name, "this field in this place of its record",
                                    f);
    }
    return true;
}

/* one row. base: where its members are; a reader takes them, or asks that they are the same */
static bool move_row(sph_stream *s, const sph_record *r, const unsigned char *from, unsigned char *to)
{
    for (uint32_t f = 0; f < r->count; f++) {
        const sph_member *e = &r->fields[f];
        for (uint32_t k = 0; k < e->comps; k++) {
            const size_t at = e->offset + k * member_bytes(e->member);
            const uint64_t own = from ? load_member(e->member, from + at) : 0;
            sph_put_number(s->piece, own, 8);
            if (!sph_move_payload(s, 8))
                return false;
            if (!s->source)
                continue;
            const uint64_t u = sph_get_number(s->piece, 8);
            if (r->same && u != own)
                sph_stream_refuse_later(s, SPH_DUMP_MISMATCH, e->name,
                                        "as in the configuration and set-up of this simulation", 0);
            if (!r->same && !store_member(e->member, u, to + at))
                sph_stream_refuse_later(s, SPH_DUMP_CORRUPT, e->name, "finite and within its type's range", 0);
        }
    }
    return true;
}

bool sph_move_record(sph_stream *s, const sph_record *r, uint32_t rows, const void *from, void *to)
{
    const uint64_t bytes = (uint64_t)r->count * DUMP_FIELD + (uint64_t)rows * record_comps(r) * 8;
    if (!sph_move_header(s, r->name, "1", SPH_RECORD, r->count, rows, bytes) || !move_fields(s, r))
        return false;
    for (uint32_t i = 0; i < rows; i++)
        if (!move_row(s, r, from ? (const unsigned char *)from + i * r->stride : NULL,
                      to ? (unsigned char *)to + i * r->stride : NULL))
            return false;
    return sph_move_crc(s, r->name);
}
#endif
