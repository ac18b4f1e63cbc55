/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stream.c: the bytes of a dump, in either direction (stream.h). CRC-32 is that of IEEE 802.3 (zlib). */
#include "fields.h"
#include "stream.h"
#include "arithmetic.h"

SPH_OBJECT(stream)

#if SPH_WITH_DUMP || SPH_WITH_RESTORE
static const unsigned char magic[8] = {0x89, 'S', 'P', 'H', 0x0d, 0x0a, 0x1a, 0x0a};

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

void sph_put_number(unsigned char *p, uint64_t v, uint32_t bytes)
{
    for (uint32_t i = 0; i < bytes; i++)
        p[i] = (unsigned char)(v >> 8 * i);
}
uint64_t sph_get_number(const unsigned char *p, uint32_t bytes)
{
    uint64_t v = 0;
    for (uint32_t i = 0; i < bytes; i++)
        v |= (uint64_t)p[i] << 8 * i;
    return v;
}
void sph_put_text(unsigned char *p, const char *s, uint32_t room)
{
    for (uint32_t i = 0; i < room; i++)
        p[i] = *s ? (unsigned char)*s++ : 0;
}

/* memcmp is not among the functions that the kernel asks of a machine */
bool sph_same_bytes(const unsigned char *a, const unsigned char *b, uint32_t n)
{
    uint32_t i = 0;
    while (i < n && a[i] == b[i])
        i++;
    return i == n;
}

bool sph_stream_refuse(sph_stream *s, sph_status st, const char *what, const char *allowed, double value)
{
    if (!s->fail.status)
        s->fail = (sph_refusal){st, what, allowed, value, SPH_NO_PARTICLE};
    return false;
}
void sph_stream_refuse_later(sph_stream *s, sph_status st, const char *what, const char *allowed, double value)
{
    if (!s->later.status)
        s->later = (sph_refusal){st, what, allowed, value, SPH_NO_PARTICLE};
}

/* n bytes of the piece to the sink, or from the source */
static bool move_piece(sph_stream *s, uint32_t n)
{
    SPH_ASSERT(n <= SPH_PIECE);
    if (s->fail.status)
        return false;
    s->bytes += n;
    if (s->sink && !s->sink(s->ctx, s->piece, n))
        return sph_stream_refuse(s, SPH_SINK_FAILED, "sink", "", (double)s->bytes);
    if (s->source && !s->source(s->ctx, s->piece, n))
        return sph_stream_refuse(s, SPH_DUMP_TRUNCATED, "bytes", "as many as the dump's preamble says",
                                 (double)s->bytes);
    return true;
}

static void chain(sph_stream *s, uint32_t crc)
{
    unsigned char b[4];
    sph_put_number(b, crc, 4);
    s->chain = crc32(s->chain, b, 4);
}

bool sph_move_payload(sph_stream *s, uint32_t n)
{
    bool fine = move_piece(s, n);
    if (s->sink || s->source)
        s->crc = crc32(s->crc, s->piece, n);
    return fine;
}

/* the header of a section: written, or read and compared with what it must be */
bool sph_move_header(sph_stream *s, const char *name, const char *unit, uint32_t code, uint32_t comps, uint64_t count,
                        uint64_t bytes)
{
    unsigned char h[SPH_DUMP_HEADER];
    sph_put_text(h, name, 16);
    sph_put_text(h + 16, unit, 16);
    sph_put_number(h + 32, code, 4);
    sph_put_number(h + 36, comps, 4);
    sph_put_number(h + 40, count, 8);
    sph_put_number(h + 48, bytes, 8);
    sph_put_number(h + 56, s->sections, 4);
    sph_put_number(h + 60, crc32(0, h, 60), 4);
    if (!s->source)
        memcpy(s->piece, h, SPH_DUMP_HEADER);
    if (!move_piece(s, SPH_DUMP_HEADER))
        return false;
    if (s->source && crc32(0, s->piece, 60) != sph_get_number(s->piece + 60, 4))
        return sph_stream_refuse(s, SPH_DUMP_CORRUPT, name, "a header with the right checksum", s->sections);
    if (s->source && !sph_same_bytes(s->piece, h, SPH_DUMP_HEADER))
        return sph_stream_refuse(s, SPH_DUMP_CORRUPT, name, "this section, of this size, in this place", s->sections);
    chain(s, (uint32_t)sph_get_number(h + 60, 4));
    s->crc = 0;
    s->sections++;
    return true;
}

/* the checksum behind a payload */
bool sph_move_crc(sph_stream *s, const char *name)
{
    const uint32_t crc = s->crc;
    if (!s->source)
        sph_put_number(s->piece, crc, 4);
    if (!move_piece(s, 4))
        return false;
    if (s->source && sph_get_number(s->piece, 4) != crc)
        return sph_stream_refuse(s, SPH_DUMP_CORRUPT, name, "a payload with the right checksum", s->sections - 1);
    chain(s, crc);
    if (s->later.status)
        s->fail = s->later;
    return !s->fail.status;
}

/* ---- preamble and end ---- */

#if SPH_WITH_DUMP
bool sph_write_preamble(sph_stream *s, bool full, uint64_t bytes, uint32_t sections)
{
    unsigned char *p = s->piece;
    memcpy(p, magic, sizeof magic);
    sph_put_number(p + 8, SPH_VERSION, 4);
    p[12] = SPH_DIM;
    p[13] = sizeof(sph_real);
    p[14] = sizeof(sph_pos);
    p[15] = full;
    sph_put_number(p + 16, bytes, 8);
    sph_put_number(p + 24, sections, 4);
    sph_put_number(p + 28, crc32(0, p, 28), 4);
    chain(s, (uint32_t)sph_get_number(p + 28, 4));
    return move_piece(s, SPH_DUMP_PREAMBLE);
}
#endif

#if SPH_WITH_RESTORE
bool sph_read_preamble(sph_stream *s, uint64_t *bytes, uint64_t *sections)
{
    const unsigned char *p = s->piece;
    if (!move_piece(s, SPH_DUMP_PREAMBLE))
        return false;
    const uint32_t crc = (uint32_t)sph_get_number(p + 28, 4), version = (uint32_t)sph_get_number(p + 8, 4);
    if (!sph_same_bytes(p, magic, sizeof magic))
        return sph_stream_refuse(s, SPH_DUMP_FOREIGN, "magic", "the first eight bytes of a dump", p[0]);
    if (crc32(0, p, 28) != crc)
        return sph_stream_refuse(s, SPH_DUMP_CORRUPT, "preamble", "the right checksum", 0);
    if (version > SPH_VERSION)
        return sph_stream_refuse(s, SPH_DUMP_NEWER, "version", "at most SPH_VERSION", version);
    if (version < SPH_VERSION)
        return sph_stream_refuse(s, SPH_DUMP_FOREIGN, "version", "SPH_VERSION", version);
    if (p[12] != SPH_DIM)
        return sph_stream_refuse(s, SPH_DUMP_FOREIGN, "dimension", "that of this build", p[12]);
    if (p[13] != sizeof(sph_real) || p[14] != sizeof(sph_pos))
        return sph_stream_refuse(s, SPH_DUMP_FOREIGN, "bytes of a real", "those of this build", p[13]);
    if (p[15] != 1)
        return sph_stream_refuse(s, SPH_DUMP_MISMATCH, "kind", "a full dump (SPH_DUMP_FULL)", p[15]);
    *bytes = sph_get_number(p + 16, 8);
    *sections = sph_get_number(p + 24, 4);
    chain(s, crc);
    return true;
}
#endif

bool sph_move_end(sph_stream *s)
{
    const uint32_t whole = s->chain;
    if (!sph_move_header(s, "end", "1", SPH_U32, 1, 1, 4))
        return false;
    sph_put_number(s->piece, whole, 4);
    if (!sph_move_payload(s, 4))
        return false;
    if (s->source && sph_get_number(s->piece, 4) != whole)
        sph_stream_refuse_later(s, SPH_DUMP_CORRUPT, "end", "the checksum of all sections", 0);
    return sph_move_crc(s, "end");
}
#endif
