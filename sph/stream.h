/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stream.h: the bytes of a dump, in either direction: pieces, checksums, headers of sections (layout: dump.h). Knows no
   simulation. */
#ifndef SPH_STREAM_H
#define SPH_STREAM_H

#include "sph.h"

#define SPH_DUMP_PREAMBLE 32u
#define SPH_DUMP_HEADER 64u

/* codes of an element's type */
enum { SPH_RECORD, SPH_U8, SPH_U32, SPH_I32, SPH_I64, SPH_F32, SPH_F64, SPH_U64 };

typedef struct sph_refusal {
    sph_status status;
    const char *what, *allowed;
    double value;
    uint32_t particle;
} sph_refusal;

/* The stream. Neither sink nor source: it only counts. The first failure stays. What is wrong with a value waits until
   the checksum of its section was seen: a flipped bit is corruption, whatever value it makes. */
typedef struct sph_stream {
    sph_sink sink;
    sph_source source;
    void *ctx;
    uint64_t bytes;
    uint32_t sections, crc, chain; /* crc: of the payload under way; chain: of all CRCs */
    sph_refusal fail, later;
    unsigned char piece[SPH_PIECE];
} sph_stream;

/* false, so that a caller returns it */
#define sph_stream_refuse SPH_NAME(stream_refuse_)
bool sph_stream_refuse(sph_stream *s, sph_status st, const char *what, const char *allowed, double value);
#define sph_stream_refuse_later SPH_NAME(stream_refuse_later_)
void sph_stream_refuse_later(sph_stream *s, sph_status st, const char *what, const char *allowed, double value);

/* numbers, little-endian; a text filled up with zeros; equality */
#define sph_put_number SPH_NAME(put_number_)
void sph_put_number(unsigned char *p, uint64_t v, uint32_t bytes);
#define sph_get_number SPH_NAME(get_number_)
uint64_t sph_get_number(const unsigned char *p, uint32_t bytes);
#define sph_put_text SPH_NAME(put_text_)
void sph_put_text(unsigned char *p, const char *s, uint32_t room);
#define sph_same_bytes SPH_NAME(same_bytes_)
bool sph_same_bytes(const unsigned char *a, const unsigned char *b, uint32_t n);

/* n bytes of the piece to the sink, or from the source; of a payload */
#define sph_move_payload SPH_NAME(move_payload_)
bool sph_move_payload(sph_stream *s, uint32_t n);
/* the header of a section: written, or read and compared with what it must be; the checksum behind its payload */
#define sph_move_header SPH_NAME(move_header_)
bool sph_move_header(sph_stream *s, const char *name, const char *unit, uint32_t code, uint32_t comps, uint64_t count,
                     uint64_t bytes);
#define sph_move_crc SPH_NAME(move_crc_)
bool sph_move_crc(sph_stream *s, const char *name);
/* the first and the last section; full, bytes, sections: what is written, or where to put what was read */
#define sph_write_preamble SPH_NAME(write_preamble_)
bool sph_write_preamble(sph_stream *s, bool full, uint64_t bytes, uint32_t sections);
#define sph_read_preamble SPH_NAME(read_preamble_)
bool sph_read_preamble(sph_stream *s, uint64_t *bytes, uint64_t *sections);
#define sph_move_end SPH_NAME(move_end_)
bool sph_move_end(sph_stream *s);

#endif
