/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* tank.c: water in a tank inside a control loop of fixed rate, on a bare Cortex-M (port/cortexm.c). SysTick calls a
   tick every 10 ms; each tick gives the water one slice of a step, and the rest of the tick belongs to the host's own
   duties.

   Reports the worst slice in work units and in time, the worst step, and the memory. Exits 0 only if every bound
   held: units of a slice and of a step (sph.h, sph_step_slice), no tick missed, stack within STACK_LIMIT.
   `make baremetal` runs it in an emulator and compares the hash with the same scene's on the host. */
#include <inttypes.h>
#include <stdio.h>

#include "../../port/cortexm.h"
#include "../../sph/sph.h"

#define DX 0.02
#define STEPS 30u
#define BUDGET 4000u          /* work units a tick */
#define TICK (CORTEXM_HZ / 100)
#define STACK_LIMIT 2560u     /* kernel and control loop together, bytes */
#define PARTICLES 900u
#define CELLS_X 19u /* of one support, 2.4 spacings, in the domain: 48 and 28 spacings */
#define CELLS_Y 11u
#define CELLS (CELLS_X * CELLS_Y)
static SPH_ARENA(arena, SPH_ARENA_BYTES(PARTICLES, CELLS, 1, 0));

typedef struct loop {
    uint64_t slices, worst_slice; /* ns */
    uint32_t missed;
} loop;

static sph_status make_tank(sph_sim **sim)
{
    const double corner[2] = {0, 0}, water[2] = {0.4, 0.3}, tank[2] = {0.8, 0.4};
    const sph_wall wall = sph_wall_default();
    sph_config cfg = sph_config_default();
    uint32_t set;
    cfg.spacing = DX;
    cfg.smoothing_length = 1.2 * DX;
    cfg.sound_speed = 20;
    cfg.gravity[1] = -9.81;
    cfg.max_particles = PARTICLES;
    cfg.max_sets = 8;
    cfg.on_leave = SPH_REMOVE;
    cfg.on_cross = SPH_PUT_BACK;
    cfg.diffusion = SPH_HYDROSTATIC;
    for (int k = 0; k < 2; k++) {
        cfg.lo[k] = corner[k] - 4 * DX;
        cfg.hi[k] = tank[k] + 4 * DX;
    }
    sph_status st = sph_init(sim, &cfg, arena, sizeof arena, NULL);
    if (!st && !(st = sph_add_fluid(*sim, NULL, &set)) && !(st = sph_add_box(*sim, set, corner, water, NULL)))
        st = sph_add_wall_box(*sim, &wall, corner, tank, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1), true, NULL);
    return st;
}

/* one tick: a slice of the step under way; SPH_OK when a step is complete */
static sph_status tick(loop *l, sph_sim *sim)
{
    const uint64_t began = cortexm_clock(NULL);
    const uint32_t number = cortexm_ticks();
    const sph_status st = sph_step_slice(sim, BUDGET);
    const uint64_t took = cortexm_clock(NULL) - began;
    l->worst_slice = took > l->worst_slice ? took : l->worst_slice;
    l->missed += cortexm_ticks() != number;
    l->slices++;
    return st;
}

static sph_status run(loop *l, sph_sim *sim)
{
    sph_status st = SPH_OK;
    uint32_t last = cortexm_ticks();
    for (uint32_t done = 0; done < STEPS;) {
        while (cortexm_ticks() == last)
            cortexm_wait(); /* a real loop would do its other duties here */
        last = cortexm_ticks();
        st = tick(l, sim);
        done += st == SPH_OK;
        if (st && st != SPH_NOT_DONE)
            return st;
    }
    return st;
}

static int bound(const char *what, uint64_t value, uint64_t limit)
{
    printf("%-26s %10" PRIu32 "  at most %10" PRIu32 "  %s\n", what, (uint32_t)value, (uint32_t)limit,
           value <= limit ? "held" : "BROKEN");
    return value > limit;
}

static int report(const loop *l, const sph_sim *sim, size_t stack)
{
    sph_usage u;
    sph_get_usage(sim, &u);
    const uint64_t hash = sph_hash(sim);
    int broken = 0;
    printf("%" PRIu32 " particles, %u steps in %" PRIu32 " ticks of %u us\n", u.particles, STEPS, (uint32_t)l->slices,
           (unsigned)(TICK / (CORTEXM_HZ / 1000000u)));
    const uint32_t row = CELLS_X * u.cell_particles, slab = row < u.particles ? row : u.particles;
    broken += bound("cells", u.cells, CELLS);
    broken += bound("worst slice (units)", u.slice_work,
                    BUDGET + SPH_SLICE_EXTRA(1, CELLS_Y, slab, CELLS_X, u.cell_particles));
    /* two sweeps: forces, and Adami's walls */
    broken += bound("worst step (units)", u.step_work, SPH_STEP_WORK(2, u.particles, u.cell_particles, u.cells));
    broken += bound("worst slice (ns)", l->worst_slice, TICK * (uint64_t)(1000000000u / CORTEXM_HZ));
    broken += bound("ticks missed", l->missed, 0);
    broken += bound("arena (bytes)", u.arena_used, sizeof arena);
    broken += bound("stack (bytes)", stack, STACK_LIMIT);
    printf("hash %08" PRIx32 "%08" PRIx32 "\n", (uint32_t)(hash >> 32), (uint32_t)hash);
    return broken;
}

int main(void)
{
    sph_sim *sim;
    loop l = {0, 0, 0};
    cortexm_stack_paint();
    sph_status st = make_tank(&sim);
    if (!st && !(st = sph_ready(sim))) { /* the first sort of all cannot be sliced */
        cortexm_start(TICK);
        st = run(&l, sim);
    }
    const size_t stack = cortexm_stack_used(); /* before printf takes its own */
    if (st) {
        printf("tank: %s\n", sph_status_text(st));
        return 2;
    }
    return report(&l, sim, stack) ? 1 : 0;
}
