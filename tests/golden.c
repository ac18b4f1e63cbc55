/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* golden.c: runs every case of cases.h in this build and prints one line a case: build, name, state hash. No framework
   and nothing of libc but printf, so that the same text runs wherever the kernel does. golden_main.c calls the six. */
#include <stdio.h>

#include "cases.h"

/* Slow machines run a part: in 2-D and 3-D the first case and every GOLDEN_EVERYth from number GOLDEN_FIRST on. */
#ifndef GOLDEN_EVERY
#define GOLDEN_EVERY 1
#endif
#ifndef GOLDEN_FIRST
#define GOLDEN_FIRST 0
#endif
static bool wanted(uint32_t k) { return SPH_DIM == 1 || k == 0 || k % GOLDEN_EVERY == GOLDEN_FIRST; }

static SPH_ARENA(arena, CASE_ARENA_BYTES);

static sph_status run(const bits_case *b, uint64_t *hash)
{
    sph_sim *sim;
    const sph_config c = case_config(b);
    sph_status st = sph_init(&sim, &c, arena, sizeof arena, NULL);
    if (!st)
        st = case_build(sim, b);
    for (uint32_t k = 0; !st && k < CASE_STEPS; k++)
        st = sph_step(sim);
    if (!st)
        *hash = sph_hash(sim);
    return st;
}

int SPH_NAME(golden)(void);
int SPH_NAME(golden)(void)
{
    int failed = 0;
    for (uint32_t k = 0; k < BITS_CASES; k++) {
        if (!wanted(k))
            continue;
        uint64_t h = 0;
        const sph_status st = run(&bits_cases[k], &h);
        if (st)
            printf("%d%c,%s,failed: %s\n", SPH_DIM, SPH_DOUBLE ? 'd' : 'f', bits_cases[k].name, sph_status_text(st));
        else
            printf("%d%c,%s,%08lx%08lx\n", SPH_DIM, SPH_DOUBLE ? 'd' : 'f', bits_cases[k].name,
                   (unsigned long)(h >> 32), (unsigned long)(h & 0xffffffffu));
        failed += st != SPH_OK;
    }
    return failed;
}
