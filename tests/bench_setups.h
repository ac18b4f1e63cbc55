/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bench_setups.h: the set-ups of bench.c and count.c: a dam break with Adami walls, Wendland C2 at h/dx 1.2,
   predictor-corrector, nothing else; and a free block, of water and of a solid. */
#ifndef BENCH_SETUPS_H
#define BENCH_SETUPS_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "port/posix.h"
#include "sph/sph.h"

typedef struct tank {
    sph_sim *sim;
    void *arena;
    size_t bytes;
    uint32_t particles;
} tank;

static void check(sph_sim *sim, sph_status st, const char *what)
{
    if (st == SPH_OK)
        return;
    fprintf(stderr, "%s: %s (%s)\n", what, sph_status_text(st), sim ? sph_last(sim)->what : "");
    exit(1);
}

/* the configuration of a tank for a block of fluid n particles wide; lo, hi: fluid; top: the tank's upper corner */
static sph_config tank_config(uint32_t n, double *hi, double *top)
{
    const double a = 1, dx = a / n, margin = 4 * dx;
    const int up = SPH_DIM - 1;
    sph_config c = sph_config_default();
    for (int k = 0; k < SPH_DIM; k++) {
        hi[k] = a;
        top[k] = k == 0 ? 1.5 * a : k == up ? 1.2 * a : a;
        c.lo[k] = k == 0 || k == up ? -margin : 0;
        c.hi[k] = top[k] + (k == 0 ? margin : 0);
        /* in three dimensions the tank's sides are symmetry faces */
        if (k != 0 && k != up)
            c.face[k][0] = c.face[k][1] = SPH_SYMMETRY;
    }
    c.spacing = dx;
    c.smoothing_length = 1.2 * dx;
    c.gravity[up] = -9.81;
    c.sound_speed = 45;
    c.on_leave = SPH_REMOVE;
    c.on_cross = SPH_PUT_BACK;
    /* fluid, three layers on floor and two walls: what the scene has, and no more */
    c.max_particles = n * n + 3 * (uint32_t)(top[0] / dx + 1) + 6 * (uint32_t)(top[up] / dx + 4) + 64;
    if (SPH_DIM == 3)
        c.max_particles *= n;
    return c;
}

/* change: what is to be another than usual; null: nothing */
static tank fill_as(uint32_t n, port_posix *pool, sph_stage_log log, void *log_ctx, void (*change)(sph_config *c))
{
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], top[SPH_DIM];
    sph_config c = tank_config(n, hi, top);
    tank t;
    uint32_t set;
    if (pool) {
        c.max_threads = pool->threads;
        c.port = (sph_port)PORT_POSIX(pool);
    }
    c.stage_log = log;
    c.stage_ctx = log_ctx;
    if (change)
        change(&c);
    t.bytes = sph_arena_bytes(&c);
    t.arena = aligned_alloc(SPH_ALIGN, (t.bytes + 63) / 64 * 64);
    check(NULL, t.arena ? sph_init(&t.sim, &c, t.arena, t.bytes, NULL) : SPH_ARENA_TOO_SMALL, "init");
    sph_wall w = sph_wall_default();
    check(t.sim, sph_add_fluid(t.sim, NULL, &set), "fluid");
    check(t.sim, sph_add_box(t.sim, set, lo, hi, NULL), "box");
    check(t.sim, sph_add_wall_box(t.sim, &w, lo, top, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(SPH_DIM - 1), true, NULL),
          "walls");
    check(t.sim, sph_apply_hydrostatic(t.sim, set, hi[SPH_DIM - 1]), "hydrostatic");
    check(t.sim, sph_ready(t.sim), "ready");
    t.particles = sph_count(t.sim);
    return t;
}

static inline tank fill(uint32_t n, port_posix *pool, sph_stage_log log, void *log_ctx)
{
    return fill_as(n, pool, log, log_ctx, NULL);
}

/* a free block, slightly jittered and moving: water (form SPH_NO_SOLID) or a solid in tension here and there; room: of
   the domain, on each side, in spacings */
static inline tank block_as(double room, uint32_t n, uint32_t form, uint32_t repulsion, bool brittle,
                            void (*change)(sph_config *))
{
    sph_config c = sph_config_default();
    tank t;
    uint32_t set, jitter = 1;
    sph_solid m;
    memset(&m, 0, sizeof m);
    c.spacing = 1;
    c.smoothing_length = 1.2;
    c.rho0 = c.sound_speed = 1;
    c.alpha = 0.5;
    for (int k = 0; k < 2; k++) {
        c.lo[k] = -room;
        c.hi[k] = n + room;
    }
    c.max_particles = n * n;
    c.solid = form;
    c.artificial_stress = repulsion;
    c.yield = brittle ? SPH_VON_MISES : SPH_NO_YIELD;
    c.damage = brittle ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
    c.max_flaws = 1;
    m.shear = 0.22;
    if (change)
        change(&c);
    t.bytes = sph_arena_bytes(&c);
    t.arena = aligned_alloc(SPH_ALIGN, (t.bytes + 63) / 64 * 64);
    check(NULL, t.arena ? sph_init(&t.sim, &c, t.arena, t.bytes, NULL) : SPH_ARENA_TOO_SMALL, "init");
    check(t.sim, form ? sph_add_solid(t.sim, &m, &set, NULL) : sph_add_fluid(t.sim, NULL, &set), "set");
    for (uint32_t i = 0; i < n * n; i++) {
        double x[2], v[2];
        for (int k = 0; k < 2; k++) {
            jitter = jitter * 1664525u + 1013904223u;
            x[k] = (k ? i / n : i % n) + 0.45 + 0.1 * (jitter >> 8) / 16777216.0;
            v[k] = 1e-3 * ((jitter >> 8) / 16777216.0 - 0.5);
        }
        check(t.sim, sph_add_particle(t.sim, set, x, v, 0, NULL), "particle");
    }
    check(t.sim, sph_ready(t.sim), "ready");
    t.particles = n * n;
    return t;
}

static inline tank block_in(double room, uint32_t n, uint32_t form, uint32_t repulsion, bool brittle)
{
    return block_as(room, n, form, repulsion, brittle, NULL);
}

static inline tank block(uint32_t n, uint32_t form, uint32_t repulsion, bool brittle)
{
    return block_in(5, n, form, repulsion, brittle);
}

#endif
