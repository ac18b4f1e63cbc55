/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* records.h: records of a dump: structs whose members are told by a table, written or read (layout: dump.h). */
#ifndef SPH_RECORDS_H
#define SPH_RECORDS_H

#include "fields.h"
#include "stream.h"

enum { M_DOUBLE, M_TIME, M_REAL, M_POS, M_U64, M_U32, M_U8, M_BOOL }; /* a time may be infinite */

typedef struct sph_member {
    const char *name, *unit;
    uint8_t member, comps;
    uint16_t offset;
} sph_member;

typedef struct sph_record {
    const char *name;
    const sph_member *fields;
    uint32_t count;
    size_t stride;
    bool same; /* a restore asks for equal values instead of taking them */
} sph_record;

/* rows from, or where the record may be taken, into a struct of the table */
#define sph_move_record SPH_NAME(move_record_)
bool sph_move_record(sph_stream *s, const sph_record *r, uint32_t rows, const void *from, void *to);

#endif
