/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* testing.h: what the tests share: cmocka, simulations in guarded arenas, and a port that works chunks off in a
   shuffled order under changing thread numbers. */
#ifndef SPH_TESTING_H
#define SPH_TESTING_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sph/dmath.h"
#include "sph/sph.h"

#define UNUSED __attribute__((unused))

/* as doubles: the macros of math.h are floats, and -Wdouble-promotion minds */
#undef NAN
#undef INFINITY
#define NAN __builtin_nan("")
#define INFINITY __builtin_inf()
#define EPS (SPH_DOUBLE ? 2.220446049250313e-16 : 1.1920929e-7) /* of sph_real */

#define GUARD 256u
#define GUARD_BYTE 0xa5
enum { MAX_SIMS = 16 };
static struct {
    unsigned char *block, *arena;
    size_t bytes;
} sims[MAX_SIMS];
static int sim_count;

/* an arena of exactly the bytes needed, between two guards */
static UNUSED sph_sim *new_sim(const sph_config *c)
{
    sph_report r;
    sph_sim *sim = NULL;
    size_t bytes = sph_arena_bytes(c);
    if (bytes == 0) {
        sph_config_check(c, &r);
        fail_msg("configuration: %s = %g, allowed: %s", r.what, r.value, r.allowed);
    }
    assert_true(sim_count < MAX_SIMS);
    size_t whole = (bytes + 2 * GUARD + 63) / 64 * 64;
    unsigned char *block = aligned_alloc(SPH_ALIGN, whole);
    assert_non_null(block);
    memset(block, GUARD_BYTE, whole);
    sims[sim_count].block = block;
    sims[sim_count].arena = block + GUARD;
    sims[sim_count].bytes = bytes;
    sim_count++;
    if (sph_init(&sim, c, block + GUARD, bytes, &r) != SPH_OK)
        fail_msg("init: %s: %s", sph_status_text(r.status), r.what);
    return sim;
}

static bool guard_intact(const unsigned char *g, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (g[i] != GUARD_BYTE)
            return false;
    return true;
}

/* the teardown of every test: frees the arenas, having looked at the bytes around them */
static UNUSED int free_sims(void **state)
{
    (void)state;
    int bad = 0;
    for (int i = 0; i < sim_count; i++) {
        bad |= !guard_intact(sims[i].block, GUARD);
        bad |= !guard_intact(sims[i].arena + sims[i].bytes, GUARD);
        free(sims[i].block);
    }
    sim_count = 0;
    if (bad)
        print_error("bytes beside an arena were written\n");
    return bad;
}

/* the call must succeed; tells what the library said if not */
#define must(sim, call)                                                                                     \
    do {                                                                                                    \
        sph_status must_ = (call);                                                                          \
        if (must_ != SPH_OK)                                                                                \
            fail_msg("%s: %s: %s = %g (%s), particle %u, pass %s", #call, sph_status_text(must_),           \
                     sph_last(sim)->what, sph_last(sim)->value, sph_last(sim)->allowed, sph_last(sim)->particle, \
                     sph_last(sim)->pass);                                                                  \
    } while (0)

/* |a - b| <= tol, with the numbers in the message */
#define close_to(a, b, tol)                                                                                 \
    do {                                                                                                    \
        double ca_ = (a), cb_ = (b), ct_ = (tol);                                                           \
        if (!(fabs(ca_ - cb_) <= ct_))                                                                      \
            fail_msg("%s = %.17g, wanted %s = %.17g within %g, off by %g", #a, ca_, #b, cb_, ct_, ca_ - cb_); \
    } while (0)

/* the particle with this id */
static UNUSED sph_particle by_id(const sph_sim *sim, uint32_t id)
{
    sph_particle p;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &p) == SPH_OK && p.id == id)
            return p;
    fail_msg("no particle %u", id);
    return p;
}

/* a configuration without walls or gravity: an open box around [0, edge]^DIM */
static UNUSED sph_config open_config(double edge, double dx)
{
    sph_config c = sph_config_default();
    c.spacing = dx;
    c.smoothing_length = 1.2 * dx;
    c.sound_speed = 20;
    c.on_leave = SPH_FAIL;
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = -edge;
        c.hi[k] = 2 * edge;
    }
    c.max_particles = 20000;
    return c;
}

/* the same, periodic on every axis */
static UNUSED sph_config periodic_config(double edge, double dx)
{
    sph_config c = open_config(edge, dx);
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = 0;
        c.hi[k] = edge;
        c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
    }
    return c;
}

/* n^DIM particles of a jittered lattice in [0, n dx]^DIM with random speeds and densities */
static UNUSED void random_cloud(sph_sim *sim, uint32_t set, uint32_t n, double dx, double jitter, double speed,
                                double drho)
{
    sph_rng rng;
    sph_rng_seed(&rng, 99, n);
    uint32_t total = 1;
    for (int k = 0; k < SPH_DIM; k++)
        total *= n;
    for (uint32_t i = 0; i < total; i++) {
        double x[SPH_DIM], v[SPH_DIM];
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= n) {
            x[k] = (at % n + 0.5 + jitter * (2 * sph_rng_uniform(&rng) - 1)) * dx;
            v[k] = speed * (2 * sph_rng_uniform(&rng) - 1);
        }
        must(sim, sph_add_particle(sim, set, x, v, 1000 + drho * (2 * sph_rng_uniform(&rng) - 1), NULL));
    }
}

/* ---- a port that runs chunks in a shuffled order, each under a thread number of its own choosing ---- */

typedef struct shuffle {
    uint32_t threads, calls;
} shuffle;

static UNUSED void shuffled(void *ctx, void (*fn)(void *arg, uint32_t chunk, uint32_t thread), void *arg,
                            uint32_t chunks)
{
    shuffle *s = ctx;
    s->calls++;
    /* i -> (a i + b) mod chunks with a prime to chunks visits each once; backwards every other time */
    uint32_t a = 1 + s->calls * 7919u % (chunks ? chunks : 1), b = s->calls * 104729u;
    for (;; a++) {
        uint32_t x = a, y = chunks;
        while (y) {
            uint32_t r = x % y;
            x = y;
            y = r;
        }
        if (x == 1)
            break;
    }
    for (uint32_t i = 0; i < chunks; i++) {
        uint32_t at = s->calls % 2 ? chunks - 1 - i : i;
        fn(arg, (uint32_t)(((uint64_t)a * at + b) % chunks), (at * 31u + s->calls) % s->threads);
    }
}

static UNUSED sph_port shuffle_port(shuffle *s, uint32_t threads)
{
    *s = (shuffle){threads, 0};
    return (sph_port){s, threads, shuffled, NULL, NULL};
}

#define subject(fn) cmocka_unit_test_teardown(fn, free_sims)
#define run_subjects(name, list) cmocka_run_group_tests_name(name, list, NULL, NULL)

#endif
