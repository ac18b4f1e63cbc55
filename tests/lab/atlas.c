/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas.c: `atlas TABLE OUT` writes one table of the stability atlas to the file OUT, `atlas list` names the tables. No
   table holds a time of a clock: each comes out the same, byte for byte. */
#include "atlas.h"

#include <stdlib.h>
#include <string.h>

static const atlas_table tables[] = {
    {"courant", atlas_courant},     {"swegle", atlas_swegle}, {"tension", atlas_tension}, {"pairing", atlas_pairing},
    {"repulsion", atlas_repulsion}, {"water", atlas_water},   {"tank", atlas_tank},       {"leak", atlas_leak},
    {"precision", atlas_precision}, {"sponge", atlas_sponge}, {"forms", atlas_forms_of_solids},
};
enum { TABLES = sizeof tables / sizeof *tables };

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "list") == 0) {
        for (int i = 0; i < TABLES; i++)
            puts(tables[i].name);
        return 0;
    }
    for (int i = 0; i < TABLES && argc == 3; i++)
        if (strcmp(argv[1], tables[i].name) == 0) {
            char part[4096];
            if (snprintf(part, sizeof part, "%s.part", argv[2]) >= (int)sizeof part) {
                fprintf(stderr, "atlas: the name of the table's file is too long, at most %d characters\n",
                        (int)sizeof part - 6);
                return 2;
            }
            FILE *f = fopen(part, "w");
            if (!f) {
                perror(part);
                return 1;
            }
            tables[i].write(f);
            const int failed = ferror(f) | fclose(f);
            if (failed || rename(part, argv[2]) != 0) {
                perror(argv[2]);
                return 1;
            }
            return 0;
        }
    fprintf(stderr, "usage: atlas TABLE OUT | atlas list; TABLE is one of");
    for (int i = 0; i < TABLES; i++)
        fprintf(stderr, " %s", tables[i].name);
    fputc('\n', stderr);
    return 2;
}
