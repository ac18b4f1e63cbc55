/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* main.c: oracle_BUILD [SEED [COUNT]] [--all]: scenes SEED, SEED + 1 ... of this build against the oracle. A scene that
   differs is made small and printed; with --all every scene that differs, else the first of each quantity. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "plan.h"

enum { NAMES = 64 };
static struct {
    const char *name;
    uint64_t seen, first;
} of[NAMES];
static uint32_t names;

/* counts a quantity that differs; returns how often it did so far */
static uint64_t count(const char *name, uint64_t seed)
{
    uint32_t k = 0;
    while (k < names && strcmp(of[k].name, name) != 0)
        k++;
    if (k == NAMES)
        return 2;
    if (k == names) {
        of[names++].name = name;
        of[k].first = seed;
    }
    return ++of[k].seen;
}

static void show(plan *p, difference d)
{
    printf("seed %llu: %s of particle %d, component %u: kernel %.17g, oracle %.17g (%.3g of scale %.3g)\n",
           (unsigned long long)p->seed, d.name, (int)d.particle, d.component, d.kernel, d.oracle,
           fabs(d.kernel - d.oracle) / d.scale, d.scale);
    plan_shrink(p, &d);
    printf("  smallest: particle %d, component %u: kernel %.17g, oracle %.17g (%.3g of scale %.3g)\n", (int)d.particle,
           d.component, d.kernel, d.oracle, fabs(d.kernel - d.oracle) / d.scale, d.scale);
    plan_print(p);
}

int main(int argc, char **argv)
{
    static plan p;
    const bool all = argc > 1 && strcmp(argv[argc - 1], "--all") == 0;
    const char *only = NULL;
    if (argc > 1 && strncmp(argv[argc - 1], "--only=", 7) == 0)
        only = argv[argc - 1] + 7;
    if (argc > 1 && strcmp(argv[1], "--help") == 0) {
        puts("oracle [SEED [COUNT]] [--all | --only=QUANTITY]: random small scenes, kernel against oracle");
        return 0;
    }
    const uint64_t seed = argc > 1 ? strtoull(argv[1], NULL, 0) : 1, n = argc > 2 ? strtoull(argv[2], NULL, 0) : 1;
    uint64_t result[4] = {0};
    const clock_t start = clock();
    for (uint64_t k = seed; k < seed + (n ? n : 1); k++) {
        difference d[PLAN_QUANTITIES];
        uint32_t n_found;
        const char *why = NULL;
        plan_draw(&p, k);
        const verdict v = plan_compare(&p, only, d, &n_found, &why);
        result[v]++;
        if (v == PLAN_REFUSED || v == PLAN_UNDECIDED)
            count(why ? why : "?", k);
        for (uint32_t f = 0; v == PLAN_DIFFERS && f < n_found; f++)
            if (count(d[f].name, k) == 1 || all) {
                show(&p, d[f]);
                plan_draw(&p, k);
            }
        fflush(stdout);
    }
    for (uint32_t k = 0; k < names; k++)
        printf("  %8llu  %s (first seed %llu)\n", (unsigned long long)of[k].seen, of[k].name,
               (unsigned long long)of[k].first);
    printf("%llu scenes: %llu the same, %llu differ, %llu undecided, %llu refused, %.1f s\n",
           (unsigned long long)(n ? n : 1), (unsigned long long)result[PLAN_SAME],
           (unsigned long long)result[PLAN_DIFFERS],
           (unsigned long long)result[PLAN_UNDECIDED], (unsigned long long)result[PLAN_REFUSED],
           (double)(clock() - start) / CLOCKS_PER_SEC);
    return result[PLAN_DIFFERS] > 0;
}
