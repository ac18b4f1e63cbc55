/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_threads.c: true threads. Steps by the POSIX pool give the hash of one thread, in whole steps and in slices; what
   a failing step tells is the same; and simulations stepped by several host threads at once do not meet. `make tsan`
   runs it under the thread sanitizer, which sees any two accesses that nothing orders. */
#include "testing.h"

#include "cases.h"
#include "port/posix.h"

enum { STEPS = 3, HOSTS = 3 };

static sph_sim *make(const bits_case *b, port_posix *pool)
{
    sph_config c = case_config(b);
    if (pool) {
        c.max_threads = pool->threads;
        c.port = (sph_port)PORT_POSIX(pool);
    }
    sph_sim *sim = new_sim(&c);
    must(sim, case_build(sim, b));
    must(sim, sph_ready(sim));
    return sim;
}

static uint64_t run(const bits_case *b, port_posix *pool, uint64_t budget)
{
    sph_sim *sim = make(b, pool);
    for (uint32_t k = 0; k < STEPS; k++) {
        sph_status st = budget ? SPH_NOT_DONE : sph_step(sim);
        while (st == SPH_NOT_DONE)
            st = sph_step_slice(sim, budget);
        must(sim, st);
    }
    const uint64_t h = sph_hash(sim);
    assert_int_equal(free_sims(NULL), 0);
    return h;
}

static void the_pool_changes_no_bit(void **state)
{
    static port_posix pool;
    (void)state;
    for (uint32_t threads = 2; threads <= 4; threads += 2) {
        assert_true(port_posix_open(&pool, threads));
        for (uint32_t k = 0; k < BITS_CASES; k += SPH_DIM == 3 ? 3 : 1) {
            const bits_case *b = &bits_cases[k];
            const uint64_t want = run(b, NULL, 0);
            if (run(b, &pool, 0) != want || (k % 6 == 0 && run(b, &pool, 5000) != want))
                fail_msg("%s with %u threads: another hash", b->name, threads);
        }
        port_posix_close(&pool);
    }
}

static void poison(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    a[0] += x[0] > 0.5 * CASE_N * CASE_DX ? NAN : 0;
}

/* what the pool says about a failing step of a case is what one thread says */
static void fail_with_the_pool(const bits_case *b, port_posix *at)
{
    sph_report alone = {SPH_OK, "", "", "", 0, 0, 0, 0};
    for (int turn = 0; turn < 2; turn++) {
        port_posix *const pool = turn ? at : NULL;
        sph_sim *sim = make(b, pool);
        sph_config c = case_config(b);
        c.max_threads = pool ? pool->threads : 1;
        if (pool)
            c.port = (sph_port)PORT_POSIX(pool);
        c.body_force = poison;
        must(sim, sph_reconfigure(sim, &c));
        const uint64_t before = sph_hash(sim);
        assert_int_equal(sph_step(sim), SPH_NOT_FINITE);
        assert_true(sph_hash(sim) == before);
        if (turn)
            assert_true(sph_last(sim)->particle == alone.particle && strcmp(sph_last(sim)->pass, alone.pass) == 0);
        alone = *sph_last(sim);
    }
    assert_int_equal(free_sims(NULL), 0);
}
static void a_failure_is_told_the_same_by_the_pool(void **state)
{
    static port_posix pool;
    (void)state;
    assert_true(port_posix_open(&pool, 4));
    for (uint32_t k = 0; k < BITS_CASES; k++)
        if (k == 0 || bits_cases[k].solid)
            fail_with_the_pool(&bits_cases[k], &pool);
    port_posix_close(&pool);
}

/* ---- several hosts ---- */

typedef struct host {
    sph_sim *sim;
    pthread_t id;
    sph_status st;
} host;
static void *drive(void *ctx)
{
    host *h = ctx;
    sph_totals t;
    for (uint32_t k = 0; k < STEPS && h->st == SPH_OK; k++) {
        h->st = sph_step(h->sim);
        sph_get_totals(h->sim, &t);
    }
    return NULL;
}
static void simulations_of_several_hosts_do_not_meet(void **state)
{
    host hosts[HOSTS];
    uint64_t want[HOSTS];
    (void)state;
    for (uint32_t k = 0; k < HOSTS; k++)
        want[k] = run(&bits_cases[11 * k], NULL, 0);
    for (uint32_t k = 0; k < HOSTS; k++)
        hosts[k] = (host){make(&bits_cases[11 * k], NULL), 0, SPH_OK};
    for (uint32_t k = 0; k < HOSTS; k++)
        assert_int_equal(pthread_create(&hosts[k].id, NULL, drive, &hosts[k]), 0);
    for (uint32_t k = 0; k < HOSTS; k++) {
        assert_int_equal(pthread_join(hosts[k].id, NULL), 0);
        assert_int_equal(hosts[k].st, SPH_OK);
        assert_true(sph_hash(hosts[k].sim) == want[k]);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(the_pool_changes_no_bit),
        subject(a_failure_is_told_the_same_by_the_pool),
        subject(simulations_of_several_hosts_do_not_meet),
    };
    return run_subjects("threads", list);
}
