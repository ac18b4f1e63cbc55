/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* travel.c: half a golden case on one machine, the other half on another (travel.sh).
     travel write  CASE FILE   runs half of the case's steps and dumps into FILE
     travel resume CASE FILE   restores FILE into a simulation set up afresh, runs the rest, prints the hash */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "cases.h"

static SPH_ARENA(arena, CASE_ARENA_BYTES);

static bool sink(void *file, const void *bytes, size_t n) { return fwrite(bytes, 1, n, file) == n; }
static bool source(void *file, void *bytes, size_t n) { return fread(bytes, 1, n, file) == n; }

static sph_status prepare(sph_sim **sim, const char *name)
{
    for (uint32_t k = 0; k < BITS_CASES; k++)
        if (strcmp(bits_cases[k].name, name) == 0) {
            const sph_config c = case_config(&bits_cases[k]);
            const sph_status st = sph_init(sim, &c, arena, sizeof arena, NULL);
            return st ? st : case_build(*sim, &bits_cases[k]);
        }
    fprintf(stderr, "travel: no case %s; allowed: the names in tests/cases.h\n", name);
    return SPH_BAD_ARGUMENT;
}

static sph_status run(sph_sim *sim, uint32_t steps)
{
    sph_status st = SPH_OK;
    for (uint32_t k = 0; !st && k < steps; k++)
        st = sph_step(sim);
    return st;
}

static sph_status write_half(sph_sim *sim, FILE *f)
{
    const sph_status st = run(sim, CASE_STEPS / 2);
    return st ? st : sph_dump(sim, SPH_DUMP_FULL, sink, f);
}

static sph_status resume(sph_sim *sim, FILE *f)
{
    const sph_status st = sph_restore(sim, source, f);
    return st ? st : run(sim, CASE_STEPS - CASE_STEPS / 2);
}

int main(int argc, char **argv)
{
    const bool writes = argc == 4 && strcmp(argv[1], "write") == 0;
    if (!writes && !(argc == 4 && strcmp(argv[1], "resume") == 0)) {
        fprintf(stderr, "usage: travel write CASE FILE | resume CASE FILE\n");
        return 2;
    }
    FILE *f = fopen(argv[3], writes ? "wb" : "rb");
    if (!f) {
        fprintf(stderr, "travel: cannot open %s\n", argv[3]);
        return 2;
    }
    sph_sim *sim = NULL;
    sph_status st = prepare(&sim, argv[2]);
    if (!st)
        st = writes ? write_half(sim, f) : resume(sim, f);
    if (fclose(f) != 0 && !st)
        st = SPH_SINK_FAILED;
    if (st) {
        fprintf(stderr, "travel: %s (%s)\n", sph_status_text(st), sim ? sph_last(sim)->what : "");
        return 1;
    }
    if (!writes)
        printf("%016" PRIx64 "\n", sph_hash(sim));
    return 0;
}
