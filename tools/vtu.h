/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* vtu.h: the particles of a dump as columns, and as a VTK unstructured grid (.vtu) that ParaView opens coloured. */
#ifndef VTU_H
#define VTU_H

#include <stdio.h>

#include "dumpfile.h"

enum { CLOUD_FIELDS = 16, CLOUD_COMPS = 6 };

typedef struct cloud_field {
    const char *name, *unit;         /* velocity, m/s; the unit as the manual calls it (dump_unit) */
    const char *part[CLOUD_COMPS];   /* names of the components: velocity_x, ... */
    double *column[CLOUD_COMPS];     /* by place in the dump; null: not carried */
    uint32_t comps;
    const char *type;                /* of VTK: Real, UInt8, UInt32; Real is Float32 of a run in float, else Float64 */
} cloud_field;

/* the particles that are there, walls or not, and what the dump carries of them */
typedef struct cloud_table {
    const dump_file *d;
    uint32_t *at, n; /* places in the dump */
    cloud_field field[CLOUD_FIELDS];
    uint32_t fields;
} cloud_table;

bool cloud_make(cloud_table *t, const dump_file *d, bool walls); /* false after a message; to be freed in any case */
void cloud_free(cloud_table *t);
/* velocity and m/s: velocity_m_per_s */
void cloud_name(const char *name, const char *unit, char *out, size_t size);

bool vtu_write(const cloud_table *t, FILE *f, bool ascii); /* false after a message */
/* text as the value of an attribute; can it be one? */
void vtu_put_text(FILE *f, const char *text);
bool vtu_text_fits(const char *text);

#endif
