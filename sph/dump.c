/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dump.c: the state as a stream of bytes, and back. Little-endian on every machine; nothing but the tables below says
   what is in it, so writer and reader cannot disagree. No array is added: a restore reads into the spare buffer.

     preamble   32 bytes, the same in all versions
                 0  magic 89 'S' 'P' 'H' 0d 0a 1a 0a
                 8  u32 version
                12  u8 dimension, u8 bytes of a real, u8 bytes of a position, u8 kind (1 full, 0 reduced)
                16  u64 bytes of the whole dump
                24  u32 sections
                28  u32 CRC-32 of the 28 bytes before
     sections   header of 64 bytes, payload, u32 CRC-32 of the payload
                 0  name, 16 bytes, filled up with zeros
                16  unit, 16 bytes
                32  u32 type of an element: 0 record, 1 u8, 2 u32, 3 i32, 4 i64, 5 f32, 6 f64, 7 u64
                36  u32 components (of a record: fields)
                40  u64 count (of a record: rows)
                48  u64 bytes of the payload
                56  u32 number of the section, from 0
                60  u32 CRC-32 of the 60 bytes before
     array      all elements' first component, then all elements' second, ...
     record     for each field 32 bytes: name 16, unit 12, u8 type (4, 6 or 7), u8 components, u16 0;
                then the rows: 8 bytes for each component of each field
     order      scene, sets, materials (with solids), groups, run, state (records); arrays; "end": one u32, the CRC-32 of the CRCs of the
                preamble and of header and payload of every section before it, in order

   CRC-32 is that of IEEE 802.3 (zlib). Positions are integers, also in a reduced dump: x = lo + quantum * pos. `rho`
   is the relative density excess (density - rho0)/rho0 with the rho0 of the particle's set; set 255 is a particle that
   is gone. Pressure from it: scene.eos and sets.pressure_scale (see SPH_TAIT in sph.h). A wall particle moves with
   the velocity of its group: its `vel` is what viscosity sees. */
#include "fluid.h"

#include <float.h>

#if SPH_WITH_DUMP || SPH_WITH_RESTORE
#define DUMP_PREAMBLE 32u
#define DUMP_HEADER 64u
#define DUMP_FIELD 32u

static const unsigned char magic[8] = {0x89, 'S', 'P', 'H', 0x0d, 0x0a, 0x1a, 0x0a};

enum { RECORD, U8, U32, I32, I64, F32, F64, U64 };
#define CODE_sph_pos (SPH_DOUBLE ? I64 : I32)
#define CODE_sph_real (SPH_DOUBLE ? F64 : F32)
#define CODE_uint32_t U32
#define CODE_uint8_t U8

/* ---- records: which members go into them ---- */

enum { M_DOUBLE, M_TIME, M_REAL, M_POS, M_U64, M_U32, M_U8, M_BOOL }; /* a time may be infinite */

typedef struct field {
    const char *name, *unit;
    uint8_t member, comps;
    uint16_t offset;
} field;

typedef struct record {
    const char *name;
    const field *fields;
    uint32_t count;
    size_t stride;
    bool same; /* a restore asks for equal values instead of taking them */
} record;

/* what may change between steps by sph_reconfigure, and what sph_get_step tells of the latest step */
typedef struct run {
    double gravity[SPH_DIM], damping, dt;
    uint64_t work, pairs;
    uint32_t passes, limit;
} run;

#define COUNT_OF(a) (uint32_t)(sizeof(a) / sizeof *(a))
#define AT(s, m) (uint16_t)offsetof(s, m)
_Static_assert(sizeof(sph_sim) < 65536, "offsets of fields have 16 bits");
static const field scene_fields[] = {
    {"setup", "1", M_U64, 1, AT(sph_sim, setup_hash)},
    {"max_particles", "1", M_U32, 1, AT(sph_sim, cfg.max_particles)},
    {"lo", "m", M_DOUBLE, SPH_DIM, AT(sph_sim, cfg.lo)},
    {"hi", "m", M_DOUBLE, SPH_DIM, AT(sph_sim, cfg.hi)},
    {"face", "1", M_U32, 2 * SPH_DIM, AT(sph_sim, cfg.face)},
    {"quantum", "m", M_DOUBLE, 1, AT(sph_sim, grid.quantum)},
    {"spacing", "m", M_DOUBLE, 1, AT(sph_sim, cfg.spacing)},
    {"smoothing", "m", M_DOUBLE, 1, AT(sph_sim, cfg.smoothing_length)},
    {"support", "m", M_DOUBLE, 1, AT(sph_sim, grid.support)},
    {"kernel", "1", M_U32, 1, AT(sph_sim, cfg.kernel)},
    {"scheme", "1", M_U32, 1, AT(sph_sim, cfg.scheme)},
    {"density", "1", M_U32, 1, AT(sph_sim, cfg.density)},
    {"integrator", "1", M_U32, 1, AT(sph_sim, cfg.integrator)},
    {"eos", "1", M_U32, 1, AT(sph_sim, cfg.eos)},
    {"pressure_floor", "1", M_BOOL, 1, AT(sph_sim, cfg.pressure_floor)},
    {"solid", "1", M_U32, 1, AT(sph_sim, cfg.solid)},
    {"rho0", "kg/m^3", M_DOUBLE, 1, AT(sph_sim, cfg.rho0)},
    {"sound_speed", "m/s", M_DOUBLE, 1, AT(sph_sim, cfg.sound_speed)},
};
static const field set_fields[] = {
    {"role", "1", M_U32, 1, AT(sph_set, role)},
    {"kind", "1", M_U32, 1, AT(sph_set, kind)},
    {"group", "1", M_U32, 1, AT(sph_set, group)},
    {"eos", "1", M_U8, 1, AT(sph_set, eos)},
    {"compressible", "1", M_BOOL, 1, AT(sph_set, compressible)},
    {"no_slip", "1", M_BOOL, 1, AT(sph_set, no_slip)},
    {"corner", "1", M_BOOL, 1, AT(sph_set, corner)},
    {"mass", "kg", M_DOUBLE, 1, AT(sph_set, mass)},
    {"rho0", "kg/m^3", M_DOUBLE, 1, AT(sph_set, rho0)},
    {"sound_speed", "m/s", M_DOUBLE, 1, AT(sph_set, c0)},
    {"pressure_scale", "Pa", M_REAL, 1, AT(sph_set, b_r)},
    {"strength", "1", M_DOUBLE, 1, AT(sph_set, strength)},
    {"origin", "m", M_DOUBLE, SPH_DIM, AT(sph_set, origin)}, /* from lo */
    {"normal", "1", M_DOUBLE, SPH_DIM, AT(sph_set, normal)},
    {"tangent", "1", M_DOUBLE, SPH_DIM, AT(sph_set, tangent)},
    {"half", "m", M_DOUBLE, 2, AT(sph_set, half)},
    {"thick", "m", M_DOUBLE, 1, AT(sph_set, thick)},
};
#if SPH_WITH_SOLID
static const field material_fields[] = {
    {"shear", "Pa", M_DOUBLE, 1, AT(sph_material, shear)},
    {"yield", "Pa", M_DOUBLE, 1, AT(sph_material, yield)},
    {"hardening", "Pa", M_DOUBLE, 1, AT(sph_material, hardening)},
    {"crack_rate", "1/s", M_DOUBLE, 1, AT(sph_material, crack_rate)},
    {"body", "1", M_U32, 1, AT(sph_material, body)},
    {"held", "1", M_U32, 1, AT(sph_material, held)},
};
#endif
static const field group_fields[] = {
    {"moved", "quantum", M_POS, SPH_DIM, AT(sph_group_state, moved)},
    {"velocity", "m/s", M_DOUBLE, SPH_DIM, AT(sph_group_state, vel)},
    {"remove_at", "s", M_TIME, 1, AT(sph_group_state, remove_at)},
    {"removed", "1", M_U32, 1, AT(sph_group_state, removed)},
};
static const field run_fields[] = {
    {"gravity", "m/s^2", M_DOUBLE, SPH_DIM, AT(run, gravity)},
    {"damping", "1", M_DOUBLE, 1, AT(run, damping)},
    {"dt_fixed", "s", M_DOUBLE, 1, AT(run, dt)},
    {"step_work", "1", M_U64, 1, AT(run, work)},
    {"step_pairs", "1", M_U64, 1, AT(run, pairs)},
    {"step_passes", "1", M_U32, 1, AT(run, passes)},
    {"step_limit", "1", M_U32, 1, AT(run, limit)},
};
static const field state_fields[] = {
    {"time", "s", M_DOUBLE, 1, AT(sph_scalars, time)},
    {"dt", "s", M_DOUBLE, 1, AT(sph_scalars, dt_last)},
    {"step", "1", M_U64, 1, AT(sph_scalars, step)},
    {"particles", "1", M_U32, 1, AT(sph_scalars, count)},
    {"left", "1", M_U32, 1, AT(sph_scalars, left)},
    {"crossed", "1", M_U32, 1, AT(sph_scalars, crossed)},
    {"put_back", "1", M_U32, 1, AT(sph_scalars, put_back)},
    {"reflected", "1", M_U32, 1, AT(sph_scalars, reflected)},
    {"primed", "1", M_BOOL, 1, AT(sph_scalars, primed)},
    {"started", "1", M_BOOL, 1, AT(sph_scalars, started)},
    {"peak_mu", "1/s", M_REAL, 1, AT(sph_scalars, peaks.mu)},
    {"peak_acc", "m/s^2", M_REAL, 1, AT(sph_scalars, peaks.acc)},
    {"peak_speed", "m/s", M_REAL, 1, AT(sph_scalars, peaks.speed)},
    {"work", "J", M_DOUBLE, SPH_POWERS, AT(sph_scalars, work)}, /* viscous, wall, diffusion, body */
    {"power", "W", M_DOUBLE, SPH_POWERS, AT(sph_scalars, power)},
    {"removed_mass", "kg", M_DOUBLE, 1, AT(sph_scalars, removed_mass)},
};
/* a member of sph_scalars that no table names would be lost: adding one must change this number and a table */
_Static_assert(sizeof(sph_scalars) == 8 * (4 + 2 * SPH_POWERS) + 4 * 5 + 4 + 3 * sizeof(sph_real) +
                                          (SPH_DOUBLE ? 0u : 4u) + SPH_MAX_GROUPS * sizeof(sph_group_state) ||
                   sizeof(void *) < 8,
               "sph_scalars has changed: name the new member in state_fields");

static const record scene_record = {"scene", scene_fields, COUNT_OF(scene_fields), sizeof(sph_sim), true};
static const record set_record = {"sets", set_fields, COUNT_OF(set_fields), sizeof(sph_set), true};
#if SPH_WITH_SOLID
static const record material_record = {"materials", material_fields, COUNT_OF(material_fields), sizeof(sph_material), true};
#endif
static const record group_record = {"groups", group_fields, COUNT_OF(group_fields), sizeof(sph_group_state), false};
static const record run_record = {"run", run_fields, COUNT_OF(run_fields), sizeof(run), false};
static const record state_record = {"state", state_fields, COUNT_OF(state_fields), sizeof(sph_scalars), false};

/* ---- bytes ---- */

static uint32_t crc32(uint32_t crc, const unsigned char *p, size_t n)
{
    /* remainders of the sixteen half bytes: small enough for any machine */
    static const uint32_t half[16] = {0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu, 0x76dc4190u, 0x6b6b51f4u,
                                      0x4db26158u, 0x5005713cu, 0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu,
                                      0x9b64c2b0u, 0x86d3d2d4u, 0xa00ae278u, 0xbdbdf21cu};
    crc = ~crc;
    for (size_t i = 0; i < n; i++) {
        crc ^= p[i];
        crc = crc >> 4 ^ half[crc & 15];
        crc = crc >> 4 ^ half[crc & 15];
    }
    return ~crc;
}

static void put_number(unsigned char *p, uint64_t v, uint32_t bytes)
{
    for (uint32_t i = 0; i < bytes; i++)
        p[i] = (unsigned char)(v >> 8 * i);
}
static uint64_t get_number(const unsigned char *p, uint32_t bytes)
{
    uint64_t v = 0;
    for (uint32_t i = 0; i < bytes; i++)
        v |= (uint64_t)p[i] << 8 * i;
    return v;
}
static void put_text(unsigned char *p, const char *s, uint32_t room)
{
    for (uint32_t i = 0; i < room; i++)
        p[i] = *s ? (unsigned char)*s++ : 0;
}

/* memcmp is not among the functions that the kernel asks of a machine */
static bool same_bytes(const unsigned char *a, const unsigned char *b, uint32_t n)
{
    uint32_t i = 0;
    while (i < n && a[i] == b[i])
        i++;
    return i == n;
}

static uint32_t code_bytes(uint32_t code) { return code == U8 ? 1 : code == U32 || code == I32 || code == F32 ? 4 : 8; }

typedef struct refusal {
    sph_status status;
    const char *what, *allowed;
    double value;
    uint32_t particle;
} refusal;

/* The stream. Neither sink nor source: it only counts. The first failure stays. What is wrong with a value waits until
   the checksum of its section was seen: a flipped bit is corruption, whatever value it makes. */
typedef struct stream {
    sph_sink sink;
    sph_source source;
    void *ctx;
    uint64_t bytes;
    uint32_t sections, crc, chain; /* crc: of the payload under way; chain: of all CRCs */
    refusal fail, later;
    unsigned char piece[SPH_PIECE];
} stream;

static bool refuse(stream *s, sph_status st, const char *what, const char *allowed, double value)
{
    if (!s->fail.status)
        s->fail = (refusal){st, what, allowed, value, SPH_NO_PARTICLE};
    return false;
}
static void refuse_later(stream *s, sph_status st, const char *what, const char *allowed, double value)
{
    if (!s->later.status)
        s->later = (refusal){st, what, allowed, value, SPH_NO_PARTICLE};
}

/* n bytes of the piece to the sink, or from the source */
static bool move_piece(stream *s, uint32_t n)
{
    if (s->fail.status)
        return false;
    s->bytes += n;
    if (s->sink && !s->sink(s->ctx, s->piece, n))
        return refuse(s, SPH_SINK_FAILED, "sink", "", (double)s->bytes);
    if (s->source && !s->source(s->ctx, s->piece, n))
        return refuse(s, SPH_DUMP_TRUNCATED, "bytes", "as many as the dump's preamble says", (double)s->bytes);
    return true;
}

static void chain(stream *s, uint32_t crc)
{
    unsigned char b[4];
    put_number(b, crc, 4);
    s->chain = crc32(s->chain, b, 4);
}

static bool move_payload(stream *s, uint32_t n)
{
    bool fine = move_piece(s, n);
    if (s->sink || s->source)
        s->crc = crc32(s->crc, s->piece, n);
    return fine;
}

/* the header of a section: written, or read and compared with what it must be */
static bool move_header(stream *s, const char *name, const char *unit, uint32_t code, uint32_t comps, uint64_t count,
                        uint64_t bytes)
{
    unsigned char h[DUMP_HEADER];
    put_text(h, name, 16);
    put_text(h + 16, unit, 16);
    put_number(h + 32, code, 4);
    put_number(h + 36, comps, 4);
    put_number(h + 40, count, 8);
    put_number(h + 48, bytes, 8);
    put_number(h + 56, s->sections, 4);
    put_number(h + 60, crc32(0, h, 60), 4);
    if (!s->source)
        memcpy(s->piece, h, DUMP_HEADER);
    if (!move_piece(s, DUMP_HEADER))
        return false;
    if (s->source && crc32(0, s->piece, 60) != get_number(s->piece + 60, 4))
        return refuse(s, SPH_DUMP_CORRUPT, name, "a header with the right checksum", s->sections);
    if (s->source && !same_bytes(s->piece, h, DUMP_HEADER))
        return refuse(s, SPH_DUMP_CORRUPT, name, "this section, of this size, in this place", s->sections);
    chain(s, (uint32_t)get_number(h + 60, 4));
    s->crc = 0;
    s->sections++;
    return true;
}

/* the checksum behind a payload */
static bool move_crc(stream *s, const char *name)
{
    const uint32_t crc = s->crc;
    if (!s->source)
        put_number(s->piece, crc, 4);
    if (!move_piece(s, 4))
        return false;
    if (s->source && get_number(s->piece, 4) != crc)
        return refuse(s, SPH_DUMP_CORRUPT, name, "a payload with the right checksum", s->sections - 1);
    chain(s, crc);
    if (s->later.status)
        s->fail = s->later;
    return !s->fail.status;
}

/* ---- preamble and end ---- */

#if SPH_WITH_DUMP
static bool write_preamble(stream *s, bool full, uint64_t bytes, uint32_t sections)
{
    unsigned char *p = s->piece;
    memcpy(p, magic, sizeof magic);
    put_number(p + 8, SPH_VERSION, 4);
    p[12] = SPH_DIM;
    p[13] = sizeof(sph_real);
    p[14] = sizeof(sph_pos);
    p[15] = full;
    put_number(p + 16, bytes, 8);
    put_number(p + 24, sections, 4);
    put_number(p + 28, crc32(0, p, 28), 4);
    chain(s, (uint32_t)get_number(p + 28, 4));
    return move_piece(s, DUMP_PREAMBLE);
}
#endif

#if SPH_WITH_RESTORE
static bool read_preamble(stream *s, uint64_t *bytes, uint64_t *sections)
{
    const unsigned char *p = s->piece;
    if (!move_piece(s, DUMP_PREAMBLE))
        return false;
    const uint32_t crc = (uint32_t)get_number(p + 28, 4), version = (uint32_t)get_number(p + 8, 4);
    if (!same_bytes(p, magic, sizeof magic))
        return refuse(s, SPH_DUMP_FOREIGN, "magic", "the first eight bytes of a dump", p[0]);
    if (crc32(0, p, 28) != crc)
        return refuse(s, SPH_DUMP_CORRUPT, "preamble", "the right checksum", 0);
    if (version > SPH_VERSION)
        return refuse(s, SPH_DUMP_NEWER, "version", "at most SPH_VERSION", version);
    if (version < SPH_VERSION)
        return refuse(s, SPH_DUMP_FOREIGN, "version", "SPH_VERSION", version);
    if (p[12] != SPH_DIM)
        return refuse(s, SPH_DUMP_FOREIGN, "dimension", "that of this build", p[12]);
    if (p[13] != sizeof(sph_real) || p[14] != sizeof(sph_pos))
        return refuse(s, SPH_DUMP_FOREIGN, "bytes of a real", "those of this build", p[13]);
    if (p[15] != 1)
        return refuse(s, SPH_DUMP_MISMATCH, "kind", "a full dump (SPH_DUMP_FULL)", p[15]);
    *bytes = get_number(p + 16, 8);
    *sections = get_number(p + 24, 4);
    chain(s, crc);
    return true;
}
#endif

static bool move_end(stream *s)
{
    const uint32_t whole = s->chain;
    if (!move_header(s, "end", "1", U32, 1, 1, 4))
        return false;
    put_number(s->piece, whole, 4);
    if (!move_payload(s, 4))
        return false;
    if (s->source && get_number(s->piece, 4) != whole)
        refuse_later(s, SPH_DUMP_CORRUPT, "end", "the checksum of all sections", 0);
    return move_crc(s, "end");
}

/* ---- records ---- */

static uint32_t record_comps(const record *r)
{
    uint32_t n = 0;
    for (uint32_t f = 0; f < r->count; f++)
        n += r->fields[f].comps;
    return n;
}

static uint32_t member_code(uint32_t member) { return member <= M_REAL ? F64 : member == M_POS ? I64 : U64; }

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
    switch (member) {
    case M_REAL:
        if (!sph_finite(d) || sph_abs(d) > (SPH_DOUBLE ? DBL_MAX : (double)FLT_MAX))
            return false;
        const sph_real r = (sph_real)d;
        memcpy(p, &r, sizeof r);
        return (double)r == d;
    case M_POS: memcpy(p, &q, sizeof q); return (uint64_t)(int64_t)q == u;
    case M_U32: memcpy(p, &w, sizeof w); return w == u;
    case M_U8: *p = (unsigned char)u; return u < 256;
    case M_BOOL: memcpy(p, &b, sizeof b); return u <= 1;
    case M_TIME: memcpy(p, &u, 8); return d == d;
    case M_DOUBLE: memcpy(p, &u, 8); return sph_finite(d);
    default: memcpy(p, &u, 8); return true;
    }
}

/* names, units and types of a record's fields: written, or read and compared */
static bool move_fields(stream *s, const record *r)
{
    for (uint32_t f = 0; f < r->count; f++) {
        unsigned char d[DUMP_FIELD] = {0};
        put_text(d, r->fields[f].name, 16);
        put_text(d + 16, r->fields[f].unit, 12);
        d[28] = (unsigned char)member_code(r->fields[f].member);
        d[29] = r->fields[f].comps;
        memcpy(s->piece, d, DUMP_FIELD);
        if (!move_payload(s, DUMP_FIELD))
            return false;
        if (s->source && !same_bytes(s->piece, d, DUMP_FIELD))
            refuse_later(s, SPH_DUMP_CORRUPT, r->fields[f].name, "this field in this place of its record", f);
    }
    return true;
}

/* one row. base: where its members are; a reader takes them, or asks that they are the same */
static bool move_row(stream *s, const record *r, const unsigned char *from, unsigned char *to)
{
    for (uint32_t f = 0; f < r->count; f++) {
        const field *e = &r->fields[f];
        for (uint32_t k = 0; k < e->comps; k++) {
            const size_t at = e->offset + k * member_bytes(e->member);
            const uint64_t own = from ? load_member(e->member, from + at) : 0;
            put_number(s->piece, own, 8);
            if (!move_payload(s, 8))
                return false;
            if (!s->source)
                continue;
            const uint64_t u = get_number(s->piece, 8);
            if (r->same && u != own)
                refuse_later(s, SPH_DUMP_MISMATCH, e->name, "as in the configuration and set-up of this simulation", 0);
            if (!r->same && !store_member(e->member, u, to + at))
                refuse_later(s, SPH_DUMP_CORRUPT, e->name, "finite and within its type's range", 0);
        }
    }
    return true;
}

static bool move_record(stream *s, const record *r, uint32_t rows, const void *from, void *to)
{
    const uint64_t bytes = (uint64_t)r->count * DUMP_FIELD + (uint64_t)rows * record_comps(r) * 8;
    if (!move_header(s, r->name, "1", RECORD, r->count, rows, bytes) || !move_fields(s, r))
        return false;
    for (uint32_t i = 0; i < rows; i++)
        if (!move_row(s, r, from ? (const unsigned char *)from + i * r->stride : NULL,
                      to ? (unsigned char *)to + i * r->stride : NULL))
            return false;
    return move_crc(s, r->name);
}

/* the materials of a scene with solids: a restore asks for equal ones, as with sets */
static bool move_materials(stream *s, const sph_sim *sim)
{
#if SPH_WITH_SOLID
    if (sph_has_solids(&sim->cfg))
        return move_record(s, &material_record, sim->sets, sim->material, NULL);
#endif
    (void)s, (void)sim;
    return true;
}

/* ---- arrays ---- */

/* n elements of `size` bytes between an array and the piece */
static void encode(unsigned char *piece, const void *array, uint32_t first, uint32_t n, uint32_t size)
{
    const unsigned char *a = (const unsigned char *)array + (size_t)first * size;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t w;
        uint64_t u;
        if (size == 8) {
            memcpy(&u, a + (size_t)i * 8, 8);
            put_number(piece + i * 8, u, 8);
        } else if (size == 4) {
            memcpy(&w, a + (size_t)i * 4, 4);
            put_number(piece + i * 4, w, 4);
        } else {
            piece[i] = a[i];
        }
    }
}
static void decode(const unsigned char *piece, void *array, uint32_t first, uint32_t n, uint32_t size)
{
    unsigned char *a = (unsigned char *)array + (size_t)first * size;
    for (uint32_t i = 0; i < n; i++) {
        const uint64_t u = get_number(piece + i * size, size);
        const uint32_t w = (uint32_t)u;
        if (size == 8)
            memcpy(a + (size_t)i * 8, &u, 8);
        else if (size == 4)
            memcpy(a + (size_t)i * 4, &w, 4);
        else
            a[i] = (unsigned char)u;
    }
}

/* pressures of n particles from `first` on */
static void encode_pressure(unsigned char *piece, const sph_sim *sim, uint32_t first, uint32_t n)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = 0; i < n; i++) {
        const uint8_t set = b->set[0][first + i];
        const sph_real p =
            set == SPH_DEAD ? 0 : (sph_real)sph_pressure(sim, &sim->set[set], (double)b->rho[0][first + i]);
        encode(piece + i * sizeof p, &p, 0, 1, sizeof p);
    }
}

typedef struct column {
    const char *name, *unit;
    uint32_t code, comps;
    void *const *array; /* of each component; null: the pressure, which is not stored */
} column;

static bool move_array(stream *s, const sph_sim *sim, const column *c, uint32_t n)
{
    const uint32_t size = code_bytes(c->code), most = SPH_PIECE / size;
    const uint64_t bytes = (uint64_t)n * size * c->comps;
    if (!move_header(s, c->name, c->unit, c->code, c->comps, n, bytes))
        return false;
    if (!s->sink && !s->source) {
        s->bytes += bytes;
        return move_crc(s, c->name);
    }
    for (uint32_t k = 0; k < c->comps; k++)
        for (uint32_t i = 0; i < n; i += most) {
            const uint32_t m = n - i < most ? n - i : most;
            if (s->sink && c->array)
                encode(s->piece, c->array[k], i, m, size);
            else if (s->sink)
                encode_pressure(s->piece, sim, i, m);
            if (!move_payload(s, m * size))
                return false;
            if (s->source && c->array)
                decode(s->piece, c->array[k], i, m, size);
        }
    return move_crc(s, c->name);
}

/* ---- dump ---- */

/* whether a state field goes into a dump of these fields */
static bool chosen(uint32_t fields, const char *name)
{
    if (fields & SPH_DUMP_FULL)
        return true;
    switch (name[0] << 8 | name[1]) { /* names differ in their first two letters */
    case 'p' << 8 | 'o':
    case 'i' << 8 | 'd':
    case 's' << 8 | 'e': return true;
    case 'v' << 8 | 'e': return fields & SPH_DUMP_VELOCITY;
    case 'r' << 8 | 'h': return fields & SPH_DUMP_DENSITY;
    case 'a' << 8 | 'c': return fields & SPH_DUMP_ACCELERATION;
    case 's' << 8 | 't': return fields & SPH_DUMP_STRESS;
    case 'p' << 8 | 'l':
    case 'd' << 8 | 'a': return fields & SPH_DUMP_DAMAGE;
    default: return false;
    }
}

static bool move_arrays(stream *s, const sph_sim *sim, const sph_buffer *b, uint32_t fields, uint32_t n)
{
#define SPH_FIELD_MOVE(name, type, comps, unit, when, way)                                                       \
    if (b->name[0] && chosen(fields, #name)) {                                                              \
        void *array[comps];                                                                                 \
        for (uint32_t k = 0; k < (comps); k++)                                                              \
            array[k] = b->name[k];                                                                          \
        if (!move_array(s, sim, &(column){#name, unit, CODE_##type, comps, array}, n))                      \
            return false;                                                                                   \
    }
    SPH_STATE_FIELDS(SPH_FIELD_MOVE)
#undef SPH_FIELD_MOVE
    if (!(fields & SPH_DUMP_FULL) && (fields & SPH_DUMP_PRESSURE))
        return move_array(s, sim, &(column){"p", "Pa", CODE_sph_real, 1, NULL}, n);
    return true;
}

#if SPH_WITH_DUMP
static bool write_all(stream *s, const sph_sim *sim, uint32_t fields, uint64_t bytes, uint32_t sections)
{
    run r = {{0}, sim->cfg.damping, sim->cfg.dt, sim->last_work, sim->last_pairs, sim->last_passes, sim->last_limit};
    memcpy(r.gravity, sim->cfg.gravity, sizeof r.gravity);
    return write_preamble(s, (fields & SPH_DUMP_FULL) != 0, bytes, sections) &&
           move_record(s, &scene_record, 1, sim, NULL) && move_record(s, &set_record, sim->sets, sim->set, NULL) &&
           move_materials(s, sim) && move_record(s, &group_record, sim->groups, sim->now.group, NULL) &&
           move_record(s, &run_record, 1, &r, NULL) && move_record(s, &state_record, 1, &sim->now, NULL) &&
           move_arrays(s, sim, &sim->buf[sim->cur], fields, sim->now.count) && move_end(s);
}

sph_status sph_dump(const sph_sim *sim, uint32_t fields, sph_sink sink, void *ctx)
{
    const uint32_t known = SPH_DUMP_FULL | SPH_DUMP_PICTURE | SPH_DUMP_ACCELERATION;
    if (!sim || !sink || (fields & ~known))
        return SPH_BAD_ARGUMENT;
    stream s;
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

#if SPH_WITH_RESTORE
/* ---- restore ---- */

static bool check_scalars(stream *s, const sph_sim *sim, const run *r)
{
    const sph_scalars *n = &sim->next;
    if (n->count > sim->cfg.max_particles)
        return refuse(s, SPH_DUMP_MISMATCH, "particles", "at most max_particles", n->count);
    if (!(r->damping > 0 && r->damping <= 1))
        return refuse(s, SPH_DUMP_CORRUPT, "damping", "> 0 and <= 1", r->damping);
    if (!(r->dt >= 0 && r->dt <= 1e30))
        return refuse(s, SPH_DUMP_CORRUPT, "dt_fixed", ">= 0", r->dt);
    if (r->limit >= SPH_LIMITS)
        return refuse(s, SPH_DUMP_CORRUPT, "step_limit", "one of SPH_LIMIT_...", r->limit);
    for (int k = 0; k < SPH_DIM; k++)
        if (!(sph_abs(r->gravity[k]) <= 1e15))
            return refuse(s, SPH_DUMP_CORRUPT, "gravity", "finite", r->gravity[k]);
    for (uint32_t g = 0; g < sim->groups; g++)
        for (int k = 0; k < SPH_DIM; k++) {
            const int64_t moved = n->group[g].moved[k], most = 2 * (int64_t)sim->grid.extent[k];
            if (moved < -most || moved > most || !(sph_abs(n->group[g].vel[k]) < 1e15))
                return refuse(s, SPH_DUMP_CORRUPT, "group", "as a motion may be", (double)moved);
        }
    return true;
}

static bool refuse_particle(stream *s, const char *what, const char *allowed, double value, uint32_t id)
{
    refuse(s, SPH_DUMP_CORRUPT, what, allowed, value);
    s->fail.particle = id;
    return false;
}

/* Every particle: a known set, an id that set-up can have given, a position that the faces' rules can bring back (a
   particle put back by a wall may wait outside for the next sort). */
static bool check_particles(stream *s, const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t id = b->id[0][i];
        const uint8_t set = b->set[0][i];
        if (id >= sim->cfg.max_particles)
            return refuse_particle(s, "id", "below max_particles", id, id);
        if (set != SPH_DEAD && set >= sim->sets)
            return refuse_particle(s, "set", "a set of this simulation", set, id);
        for (int k = 0; k < SPH_DIM; k++) {
            const int64_t q = b->pos[k][i], e = sim->grid.extent[k];
            if (q < -e || q >= 2 * e - sim->grid.cell_size[k])
                return refuse_particle(s, "pos", "inside the domain, or less than its length outside", (double)q, id);
        }
    }
    return true;
}

static bool check_finite(stream *s, const sph_buffer *b, const char *name, sph_real *const *array, uint32_t comps,
                         uint32_t n)
{
    for (uint32_t k = 0; k < comps; k++) {
        if (!array[k])
            continue;
        int fine = 1;
        for (uint32_t i = 0; i < n; i++)
            fine &= array[k][i] - array[k][i] == 0;
        for (uint32_t i = 0; !fine && i < n; i++)
            if (array[k][i] - array[k][i] != 0)
                return refuse_particle(s, name, "finite", (double)array[k][i], b->id[0][i]);
    }
    return true;
}

/* No id twice: ids are marked in the scratch of the threads, as many at a time as it has bits. */
static bool check_ids(stream *s, sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    unsigned char *seen = (unsigned char *)sim->thread;
    const size_t bytes = sizeof *sim->thread * sim->cfg.max_threads;
    const uint64_t window = (uint64_t)bytes * 8;
    bool fine = true;
    for (uint64_t first = 0; fine && first < sim->cfg.max_particles; first += window) {
        memset(seen, 0, bytes);
        for (uint32_t i = 0; fine && i < n; i++) {
            const uint64_t at = (uint64_t)b->id[0][i] - first; /* smaller ids wrap round to large numbers */
            if (at >= window)
                continue;
            if (seen[at / 8] >> at % 8 & 1)
                fine = refuse_particle(s, "id", "each only once", b->id[0][i], b->id[0][i]);
            seen[at / 8] = (unsigned char)(seen[at / 8] | 1u << at % 8);
        }
    }
    memset(seen, 0, bytes); /* as after sph_init */
    return fine;
}

#if SPH_WITH_SOLID
/* what only solids have */
static bool check_solids(stream *s, const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    if (!check_finite(s, b, "stress", b->stress, SPH_NS, n) || !check_finite(s, b, "dstress", b->dstress, SPH_NS, n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        if (SPH_HAS_YIELD && b->plastic[0] && !(b->plastic[0][i] >= 0 && sph_finite((double)b->plastic[0][i])))
            return refuse_particle(s, "plastic", "finite and >= 0", (double)b->plastic[0][i], b->id[0][i]);
        if (SPH_HAS_DAMAGE && b->damage[0] && !(b->damage[0][i] >= 0 && b->damage[0][i] <= 1))
            return refuse_particle(s, "damage", "0 .. 1", (double)b->damage[0][i], b->id[0][i]);
        for (uint32_t k = 0; SPH_HAS_TOTAL && b->shift[0] && k < SPH_DIM; k++) {
            const sph_pos half = sim->grid.extent[k] / 2, d = b->shift[k][i];
            if (d > half || d < -half)
                return refuse_particle(s, "shift", "at most half the domain", (double)d, b->id[0][i]);
        }
    }
    return true;
}
#else
#define check_solids(s, sim, b, n) true
#endif

static bool check_buffer(stream *s, sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    return check_particles(s, sim, b, n) && check_ids(s, sim, b, n) && check_finite(s, b, "vel", b->vel, SPH_DIM, n) &&
           check_finite(s, b, "rho", b->rho, 1, n) && check_finite(s, b, "acc", b->acc, SPH_DIM, n) &&
           check_finite(s, b, "drho", b->drho, 1, n) && check_finite(s, b, "xsph", b->xsph, SPH_DIM, n) &&
           check_solids(s, sim, b, n);
}

static bool read_all(stream *s, sph_sim *sim, uint32_t spare, run *r)
{
    uint64_t bytes = 0, sections = 0;
    sim->next = sim->now;
    if (!read_preamble(s, &bytes, &sections) || !move_record(s, &scene_record, 1, sim, NULL) ||
        !move_record(s, &set_record, sim->sets, sim->set, NULL) || !move_materials(s, sim) ||
        !move_record(s, &group_record, sim->groups, NULL, sim->next.group) ||
        !move_record(s, &run_record, 1, NULL, r) || !move_record(s, &state_record, 1, NULL, &sim->next) ||
        !check_scalars(s, sim, r) || !move_arrays(s, sim, &sim->buf[spare], SPH_DUMP_FULL, sim->next.count) ||
        !move_end(s))
        return false;
    if (s->bytes != bytes || s->sections != sections)
        return refuse(s, SPH_DUMP_CORRUPT, "bytes", "as many as the dump's preamble says", (double)s->bytes);
    return check_buffer(s, sim, &sim->buf[spare], sim->next.count);
}

/* what a refused dump left in the spare buffer: lanes behind a row's end may read it, so it must be finite */
static void wipe(const sph_sim *sim, const sph_buffer *b)
{
    const size_t n = sim->cfg.max_particles;
#define SPH_FIELD_WIPE(name, type, comps, unit, when, way)                                                       \
    for (uint32_t k = 0; k < (comps); k++)                                                                  \
        if (b->name[k])                                                                                     \
            memset(b->name[k], 0, n * sizeof(type));
    SPH_STATE_FIELDS(SPH_FIELD_WIPE)
#undef SPH_FIELD_WIPE
}

sph_status sph_restore(sph_sim *sim, sph_source source, void *ctx)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "sph_restore", "between steps", 0, SPH_NO_PARTICLE);
    if (!source)
        return sph_error(sim, SPH_BAD_ARGUMENT, "source", "a function", 0, SPH_NO_PARTICLE);
    const uint32_t spare = (sim->cur + 1) % sim->buffers;
    stream s;
    run r;
    memset(&s, 0, sizeof s);
    memset(&r, 0, sizeof r);
    s.source = source;
    s.ctx = ctx;
    if (!read_all(&s, sim, spare, &r)) {
        wipe(sim, &sim->buf[spare]);
        return sph_error(sim, s.fail.status, s.fail.what, s.fail.allowed, s.fail.value, s.fail.particle);
    }
    sim->cur = spare;
    sim->now = sim->next;
    sim->table_valid = false; /* the table of cells belongs to what was there before */
    memcpy(sim->cfg.gravity, r.gravity, sizeof r.gravity);
    sim->cfg.damping = r.damping;
    sim->cfg.dt = r.dt;
    sph_make_factors(sim);
    sim->last_work = r.work;
    sim->last_pairs = r.pairs;
    sim->last_passes = r.passes;
    sim->last_limit = r.limit;
    sim->last_dt = sim->now.dt_last;
    sim->mark_particles = sim->now.count > sim->mark_particles ? sim->now.count : sim->mark_particles;
    return SPH_OK;
}
#endif
#endif
