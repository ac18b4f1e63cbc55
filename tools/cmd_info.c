/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_info.c: sph info. What is in a dump: scene, sets, state, arrays with their ranges. */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"

#include <string.h>

static const char help[] =
    "usage: sph info DUMP...\n"
    "Prints what a dump holds: the records (scene, sets, groups, run, state) field by field with units, then its\n"
    "arrays with type, unit, count and range; then the notes of the\n"
    "program that wrote it: scene, units, parameters. Units are the scene's where the notes name them.\n"
    "Every checksum is verified on the way.\n";

static void print_value(const dump_file *d, const dump_section *s, const dump_member *m, uint64_t row)
{
    for (uint32_t k = 0; k < m->comps; k++) {
        uint64_t bits = dump_member_bits(s, m, row, k);
        if (m->type == DUMP_F64)
            printf("%s%.12g", k ? ", " : "", dump_member_value(s, m, row, k));
        else if (m->type == DUMP_I64)
            printf("%s%.0f", k ? ", " : "", dump_member_value(s, m, row, k));
        else if (!strcmp(m->name, "setup"))
            printf("%016llx", (unsigned long long)bits);
        else
            printf("%s%llu", k ? ", " : "", (unsigned long long)bits);
    }
    printf("%s%s", strcmp(m->unit, "1") ? " " : "", strcmp(m->unit, "1") ? dump_unit(d, m->unit) : "");
}

/* work and power of a run without books are 0, and mean nothing; the notes say whether it had them */
static bool is_kept(const dump_file *d, const dump_section *s, const dump_member *m)
{
    char books[16];
    return strcmp(s->name, "state") != 0 || (strcmp(m->name, "work") != 0 && strcmp(m->name, "power") != 0) ||
           !dump_note(d, "param books", books, sizeof books) || strcmp(books, "no") != 0;
}

static void print_record(const dump_file *d, const dump_section *s)
{
    dump_member m;
    for (uint64_t row = 0; row < s->count; row++) {
        if (s->count > 1 || !strcmp(s->name, "sets") || !strcmp(s->name, "groups"))
            printf("%s %llu\n", s->name, (unsigned long long)row);
        else
            printf("%s\n", s->name);
        for (uint32_t f = 0; dump_get_member(s, f, &m); f++) {
            printf("  %-16s ", m.name);
            if (is_kept(d, s, &m))
                print_value(d, s, &m, row);
            else
                printf("not kept (books=no)");
            putchar('\n');
        }
    }
}

static void print_array(const dump_file *d, const dump_section *s)
{
    printf("  %-8s %-4s %u x %llu, %s:", s->name, dump_type_name(s->type), s->comps, (unsigned long long)s->count,
           strcmp(s->unit, "1") ? dump_unit(d, s->unit) : "no unit");
    for (uint32_t k = 0; k < s->comps && s->count; k++) {
        double low = dump_value(s, k, 0), high = low;
        for (uint64_t i = 1; i < s->count; i++) {
            double v = dump_value(s, k, i);
            low = v < low ? v : low;
            high = v > high ? v : high;
        }
        printf("%s %.9g .. %.9g", k ? "," : "", low, high);
    }
    putchar('\n');
}

static void print_dump(const dump_file *d)
{
    uint32_t by_role[DUMP_GONE + 1] = {0};
    for (uint32_t i = 0; i < d->n; i++) {
        uint32_t role = dump_role(d, i);
        by_role[role < DUMP_GONE ? role : DUMP_GONE]++;
    }
    printf("%s: %s dump, version %u, %u-D, %s, %zu bytes\n", d->name, d->full ? "full" : "reduced", d->version, d->dim,
           d->real_bytes == 8 ? "double" : "float", d->size);
    printf("%u particles: %u fluid, %u solid, %u ghost wall, %u force wall, %u gone\n", d->n, by_role[DUMP_FLUID],
           by_role[DUMP_SOLID], by_role[DUMP_GHOST], by_role[DUMP_FORCE_WALL], by_role[DUMP_GONE]);
    for (uint32_t k = 0; k < d->sections; k++)
        if (d->section[k].type == DUMP_RECORD)
            print_record(d, &d->section[k]);
    printf("arrays\n");
    for (uint32_t k = 0; k < d->sections; k++)
        if (d->section[k].type != DUMP_RECORD && strcmp(d->section[k].name, "end") != 0)
            print_array(d, &d->section[k]);
    printf(d->notes_bytes ? "notes\n  " : "");
    for (size_t i = 0; i < d->notes_bytes; i++)
        fputs(d->notes[i] != '\n' ? (char[]){d->notes[i], '\0'} : i + 1 < d->notes_bytes ? "\n  " : "\n", stdout);
}

static bool info_one(const dump_file *d, const char *name)
{
    (void)name; /* print_dump says it */
    print_dump(d);
    return true;
}

int cmd_info(int argc, char **argv) { return dump_each(argc, argv, "info", help, info_one); }
