/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* size_arena.c: arena bytes of every scene of this build, in all and for each particle. One row of size.csv each. */
#include <stdio.h>
#include <stdlib.h>

#include "examples/scenes/scene.h"

int SPH_NAME(size_arena)(void);
int SPH_NAME(size_arena)(void)
{
    int bad = 0;
    for (uint32_t i = 0; scene_table[i]; i++) {
        const scene *s = scene_table[i];
        double *p = malloc((s->params + 1) * sizeof *p);
        sph_config c;
        sph_sim *sim = NULL;
        sph_report r;
        for (uint32_t k = 0; k < s->params; k++)
            p[k] = s->param[k].value;
        s->configure(p, &c);
        const size_t n = sph_arena_bytes(&c);
        void *arena = aligned_alloc(SPH_ALIGN, (n + 63) / 64 * 64);
        if (!arena || sph_init(&sim, &c, arena, n, &r) != SPH_OK || s->build(sim, p) != SPH_OK) {
            fprintf(stderr, "size: %s does not build: %s\n", s->name, sim ? sph_last(sim)->what : r.what);
            bad = 1;
        } else {
            const char b = SPH_DOUBLE ? 'd' : 'f';
            printf("arena_%d%c_%s,%zu,bytes,,\n", SPH_DIM, b, s->name, n);
            printf("arena_%d%c_%s_particle,%.1f,bytes/particle,,\n", SPH_DIM, b, s->name, (double)n / sph_count(sim));
        }
        free(arena);
        free(p);
    }
    return bad;
}
