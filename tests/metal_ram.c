/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* metal_ram.c: a 2-D dam break of 2,002 particles (1,444 of water, 558 of Adami walls) in RAM of 192 KiB, all told: the
   linker gets no more (tests/baremetal.sh), so that arena, .data, .bss and stack fit or the program does not link.
   Prints what each takes, the steps, and the hash, which must be that of the same scene on the host. */
#include <inttypes.h>
#include <stdio.h>

#include "port/cortexm.h"
#include "sph/sph.h"

#define DX 0.01
#define WATER 38 /* particles along an edge of the column */
#define LONG 80  /* the tank, in spacings */
#define HIGH 50
#define LAYERS 3 /* of wall: the support is 2.4 spacings */
#define PARTICLES (WATER * WATER + LAYERS * (LONG + 2 * LAYERS) + 2 * LAYERS * HIGH)
#ifndef STEPS
#define STEPS 20u
#endif
#ifndef ARENA
#define ARENA SPH_ARENA_BYTES(PARTICLES, 900, 1, 0) /* the script gives the exact number that this one prints */
#endif
static SPH_ARENA(arena, ARENA);

static sph_status make(sph_sim **sim, sph_report *why)
{
    const double corner[2] = {0, 0}, water[2] = {WATER * DX, WATER * DX}, tank[2] = {LONG * DX, HIGH * DX};
    const sph_wall wall = sph_wall_default();
    sph_config cfg = sph_config_default();
    uint32_t set;
    cfg.spacing = DX;
    cfg.smoothing_length = 1.2 * DX;
    cfg.sound_speed = 28;
    cfg.gravity[1] = -9.81;
    cfg.max_particles = PARTICLES;
    cfg.integrator = SPH_KICK_DRIFT_KICK; /* the predictor-corrector keeps 8 bytes a particle more */
    cfg.max_sets = 6;                     /* water, three walls, two corners */
    cfg.on_leave = SPH_REMOVE;
    cfg.on_cross = SPH_PUT_BACK;
    for (int k = 0; k < 2; k++) {
        cfg.lo[k] = -(LAYERS + 1) * DX;
        cfg.hi[k] = tank[k] + (LAYERS + 1) * DX;
    }
    sph_status st = sph_init(sim, &cfg, arena, sizeof arena, why);
    if (!st && !(st = sph_add_fluid(*sim, NULL, &set)) && !(st = sph_add_box(*sim, set, corner, water, NULL)))
        st = sph_add_wall_box(*sim, &wall, corner, tank, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1), true, NULL);
    return st;
}

static void show(void *ctx, const char *name, size_t bytes)
{
    (void)ctx;
    printf("  %-28s %8u bytes\n", name, (unsigned)bytes);
}

int main(void)
{
    sph_sim *sim;
    sph_totals o;
    sph_usage u;
    sph_report why = {SPH_OK, "", "", "", 0, SPH_NO_PARTICLE, 0, 0};
    sph_status st = make(&sim, &why);
    if (!st && sph_count(sim) != PARTICLES)
        st = SPH_BAD_STATE;
    for (uint32_t k = 0; !st && k < STEPS; k++)
        st = sph_step(sim);
    const size_t stack = cortexm_stack_used(); /* before printf takes its own */
    if (st) {
        printf("metal_ram: %s: %s %" PRIu32 "\n", sph_status_text(st), why.what, (uint32_t)why.value);
        return 1;
    }
    sph_get_totals(sim, &o);
    sph_get_usage(sim, &u);
    const uint64_t hash = sph_hash(sim);
    sph_arena_report(sim, show, NULL);
    printf("water %" PRIu32 "\nwalls %" PRIu32 "\nsteps %u\narena %u\n", o.fluid, o.wall, STEPS,
           (unsigned)u.arena_used);
    printf("static %u\nstack %u\nstack_room %u\n", (unsigned)cortexm_static_bytes(), (unsigned)stack,
           (unsigned)cortexm_stack_bytes());
    printf("hash %08" PRIx32 "%08" PRIx32 "\n", (uint32_t)(hash >> 32), (uint32_t)hash);
    return 0;
}
