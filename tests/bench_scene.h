/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bench_scene.h: a scene of examples/scenes with the defaults of its table, but for n, for bench.c. */
#ifndef SPH_BENCH_SCENE_H
#define SPH_BENCH_SCENE_H

#include "bench_setups.h"
#include "examples/scenes/scene.h"

#define BENCH_PARAMS 64u

static tank scene_as_it_is(const char *name, uint32_t n)
{
    static double p[BENCH_PARAMS]; /* motions of a scene would read it */
    const scene *s = NULL;
    sph_config c;
    tank t;
    for (const scene *const *k = scene_table; *k; k++)
        s = strcmp((*k)->name, name) == 0 ? *k : s;
    check(NULL, s && s->params <= BENCH_PARAMS ? SPH_OK : SPH_BAD_ARGUMENT, name);
    for (uint32_t i = 0; i < s->params; i++)
        p[i] = strcmp(s->param[i].name, "n") == 0 ? n : s->param[i].value;
    s->configure(p, &c);
    t.bytes = sph_arena_bytes(&c);
    t.arena = aligned_alloc(SPH_ALIGN, (t.bytes + 63) / 64 * 64);
    check(NULL, t.arena ? sph_init(&t.sim, &c, t.arena, t.bytes, NULL) : SPH_ARENA_TOO_SMALL, "init");
    check(t.sim, s->build(t.sim, p), "build");
    check(t.sim, sph_ready(t.sim), "ready");
    t.particles = sph_count(t.sim);
    return t;
}

#endif
