/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dumpfile.h: a dump of any dimension and precision, read into memory and checked (layout: sph/dump.h). It shares no
   code with the kernel, so it is a second reading of the format. */
#ifndef DUMPFILE_H
#define DUMPFILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DUMP_RECORD, DUMP_U8, DUMP_U32, DUMP_I32, DUMP_I64, DUMP_F32, DUMP_F64, DUMP_U64 };
enum { DUMP_FLUID, DUMP_GHOST, DUMP_FORCE_WALL, DUMP_SOLID, DUMP_GONE }; /* roles */
enum { DUMP_UNITS = 24 };
#define DUMP_DEAD 255u /* set of a particle that is gone */

typedef struct dump_section {
    char name[17], unit[17];
    uint32_t type, comps; /* of a record: comps is the number of fields */
    uint64_t count, bytes;
    const unsigned char *data;
} dump_section;

typedef struct dump_file {
    const char *name;
    unsigned char *bytes;
    size_t size;
    uint32_t version, dim, real_bytes, pos_bytes, sections;
    bool full;
    dump_section *section;
    /* what everyone asks for */
    uint32_t n, sets;
    double time, lo[3], hi[3], quantum, spacing;
    uint64_t step;
    uint32_t eos;
    bool pressure_floor;
    const dump_section *pos, *id, *set;
    const char *notes; /* text of n lines KEY=VALUE that the program which wrote it put behind the dump; or "" */
    size_t notes_bytes;
    struct {
        char si[16], own[32];
    } unit[DUMP_UNITS]; /* of the notes; empty ones behind */
} dump_file;

/* Reads, checks every checksum and everything that later calls rely on. False after a message that says why. */
bool dump_open(dump_file *d, const char *name);
/* the same of bytes in memory from host_alloc, which become the dump's; name is for messages */
bool dump_take(dump_file *d, const char *name, unsigned char *bytes, size_t size);
void dump_close(dump_file *d);

/* Notes: a section like the others behind the last one, which the kernel neither writes nor reads: name "notes", type
   u8, its number the one after that of "end". `sph run` notes the scene (scene=), its parameters (param NAME=) and in
   which units its numbers are (unit m=cm: what the dump calls m is in cm). */
#define DUMP_NOTES "notes"
/* the value of a note into out, "" and false if it is not there */
bool dump_note(const dump_file *d, const char *key, char *out, size_t size);
/* what a unit of the dump's tables stands for: the unit of that scene (it lives as long as the dump), else the same
   text */
const char *dump_unit(const dump_file *d, const char *unit);
/* writes n bytes of notes as that section, number: sections of the dump before it; to sink */
bool dump_put_notes(const char *text, size_t n, uint32_t number, bool (*sink)(void *ctx, const void *bytes, size_t n),
                    void *ctx);
/* What info, verify and hash share: reads the dumps that a command was given and calls each(dump, name); the exit
   code. */
int dump_each(int argc, char **argv, const char *command, const char *help,
              bool (*each)(const dump_file *d, const char *name));
/* What a restore would ask besides: ids once each, finite values. False after a message. */
bool dump_check(const dump_file *d);

/* ids in order, each with its place in the arrays; from host_alloc. dump_place: the place of an id, UINT32_MAX if it is
   not there. */
typedef struct dump_id_at {
    uint32_t id, at;
} dump_id_at;
dump_id_at *dump_sort_ids(const dump_file *d);
uint32_t dump_place(const dump_id_at *sorted, uint32_t n, uint32_t id);

/* sections and their elements; a record's field f is found by name, its values by row and component */
const dump_section *dump_find(const dump_file *d, const char *name); /* null if it is not there */
uint64_t dump_bits(const dump_section *s, uint32_t comp, uint64_t i); /* the stored bits; signed types extended */
double dump_value(const dump_section *s, uint32_t comp, uint64_t i);
uint32_t dump_type_bytes(uint32_t type);
const char *dump_type_name(uint32_t type);

typedef struct dump_member {
    char name[17], unit[13];
    uint32_t type, comps, at; /* at: number of 8-byte values before it in a row */
} dump_member;
bool dump_get_member(const dump_section *record, uint32_t f, dump_member *m);
bool dump_find_member(const dump_section *record, const char *name, dump_member *m);
uint64_t dump_member_bits(const dump_section *record, const dump_member *m, uint64_t row, uint32_t comp);
double dump_member_value(const dump_section *record, const dump_member *m, uint64_t row, uint32_t comp);
/* the value of record.field[row][comp]; 0 if there is none */
double dump_number(const dump_file *d, const char *record, const char *field, uint64_t row, uint32_t comp);

/* particles */
uint32_t dump_set(const dump_file *d, uint32_t i);
uint32_t dump_id(const dump_file *d, uint32_t i);
uint32_t dump_role(const dump_file *d, uint32_t i);
bool dump_is_wall(uint32_t role);
double dump_x(const dump_file *d, uint32_t i, uint32_t axis); /* m */
bool dump_periodic(const dump_file *d, uint32_t axis);        /* does the domain repeat? */
/* is the low (0) or high (1) face of an axis a mirror? with *no_slip: one that turns velocities round */
bool dump_mirror(const dump_file *d, uint32_t axis, uint32_t side, bool *no_slip);

/* Fields by name (dumpfields.c). Fills out[0..n) and the unit; false after a message if the dump does not carry it.
   dump_has_field asks without a message; dump_field_signed: do its values spread around 0, as stresses do?
   Stress is what the particle bears (Gray 5.33, 5.34): (1 - D) S - P, and of P the factor in tension only; positive in
   tension. mean_stress is a third of its trace in space, stress_sum that in the plane, which Gray calls the mean
   stress.
   damage is D; the array of that name holds D^(1/dim). */
#define DUMP_FIELDS \
    "x y z velocity_x.. speed density pressure acceleration_x.. stress_xx stress_yy stress_xy.. mean_stress " \
    "stress_sum von_mises plastic damage energy set id"
bool dump_field(const dump_file *d, const char *field, double *out, const char **unit);
bool dump_has_field(const dump_file *d, const char *field);
bool dump_field_signed(const dump_file *d, const char *field);
/* What a mirror across an axis makes of a field: 1 or -1. */
double dump_field_mirrored(const dump_file *d, const char *field, uint32_t axis, bool no_slip);

#endif
