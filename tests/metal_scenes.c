/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* metal_scenes.c: what the scenes of this build cost that have at most MOST particles, with their defaults (3-D: a
   third of the particles along an edge, or the fewest that are allowed):
   passes, candidate pairs and work of a step, state hash; on bare metal under `-icount shift=0` also instructions, and
   the depth of the painted stack below sph_init and sph_step. One line a scene of words and values; tests/size.sh makes
   rows of them. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "examples/scenes/scene.h"
#include "port/cortexm.h"

#define STEPS 2u
#define MOST_PARAMS 96
#define MOST 5100u
#ifndef ARENA
#define ARENA (13u << 20)
#endif
static SPH_ARENA(arena, ARENA);

/* the kernel's stack below the function that calls */
#define BELOW(call) (cortexm_stack_paint(), (call), cortexm_stack_used() - cortexm_stack_here())

static size_t deep_init, deep_step;
static void keep(size_t *deepest, size_t bytes) { *deepest = bytes > *deepest ? bytes : *deepest; }

static sph_status make(const scene *s, const double *p, sph_sim **sim)
{
    static sph_config c;
    sph_status st;
    s->configure(p, &c);
    keep(&deep_init, BELOW(st = sph_init(sim, &c, arena, sizeof arena, NULL)));
    return st ? st : s->build(*sim, p);
}

/* instructions of some steps; the stack is looked at in one more, while SysTick does not interrupt */
static sph_status run(sph_sim *sim, uint64_t *ns)
{
    sph_status st = sph_ready(sim);
    cortexm_start(1u << 24);
    const uint64_t began = cortexm_clock(NULL);
    for (uint32_t k = 0; !st && k < STEPS; k++)
        st = sph_step(sim);
    *ns = cortexm_clock(NULL) - began;
    cortexm_stop();
    if (!st)
        keep(&deep_step, BELOW(st = sph_step(sim)));
    return st;
}

static sph_status cost(const scene *s)
{
    static double p[MOST_PARAMS];
    sph_sim *sim;
    sph_step_info info;
    uint64_t ns = 0;
    if (s->params > MOST_PARAMS)
        return SPH_BAD_ARGUMENT;
    if (strcmp(s->name, "solitary") == 0 || strcmp(s->name, "collision") == 0 || strcmp(s->name, "shoaling") == 0 ||
        strcmp(s->name, "breaking") == 0) /* waves are found in double, on a host's stack */
        return SPH_OK;
    for (uint32_t k = 0; k < s->params; k++) {
        p[k] = s->param[k].value;
        if (SPH_DIM == 3 && s->param[k].name[0] == 'n' && s->param[k].name[1] == 0)
            p[k] = p[k] / 3 < s->param[k].min ? s->param[k].min : (double)(uint32_t)(p[k] / 3);
    }
    deep_init = deep_step = 0;
    sph_status st = make(s, p, &sim);
    if (!st && sph_count(sim) > MOST) /* too long for an emulator */
        return SPH_OK;
    if (!st)
        st = run(sim, &ns);
    if (st)
        return st;
    sph_get_step(sim, &info);
    const uint64_t hash = sph_hash(sim);
    printf("%s particles %" PRIu32 " instructions %" PRIu32 " passes %" PRIu32 " pairs %" PRIu32 " work %" PRIu32
           " init %u step %u hash %08" PRIx32 "%08" PRIx32 "\n", s->name, sph_count(sim),
           (uint32_t)(ns / STEPS / sph_count(sim)), info.passes, (uint32_t)info.pairs, (uint32_t)info.work,
           (unsigned)deep_init, (unsigned)deep_step, (uint32_t)(hash >> 32), (uint32_t)hash);
    return SPH_OK;
}

int main(void)
{
    int failed = 0;
    for (uint32_t i = 0; scene_table[i]; i++) {
        const sph_status st = cost(scene_table[i]);
        if (st)
            printf("%s failed: %s\n", scene_table[i]->name, sph_status_text(st));
        failed += st != SPH_OK;
    }
    return failed ? 1 : 0;
}
