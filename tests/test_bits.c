/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_bits.c: the state hash of every case of cases.h does not depend on the number of threads, the order of chunks,
   the slicing, or a dump and restore in between. (Compilers, levels and vector widths: tests/bits.sh.) */
#include "testing.h"

#include "cases.h"
#if HAVE_PORT_POSIX
#include "port/posix.h"
#endif

static uint64_t finish(sph_sim *sim, uint32_t steps)
{
    for (uint32_t k = 0; k < steps; k++)
        must(sim, sph_step(sim));
    return sph_hash(sim);
}

static sph_sim *make(const bits_case *b, const sph_port *port, uint32_t threads)
{
    sph_config c = case_config(b);
    c.max_threads = threads;
    if (port)
        c.port = *port;
    sph_sim *sim = new_sim(&c);
    must(sim, case_build(sim, b));
    return sim;
}

static uint64_t reference(const bits_case *b)
{
    uint64_t h = finish(make(b, NULL, 1), CASE_STEPS);
    assert_int_equal(free_sims(NULL), 0);
    return h;
}

#define same(h, want, b, how)                                                                               \
    do {                                                                                                    \
        if ((h) != (want))                                                                                  \
            fail_msg("%s with %s: another hash", (b)->name, how);                                           \
    } while (0)

/* the cases of a dimension differ from each other: a hash that ignored the state would pass everything else */
static void every_choice_gives_another_hash(void **state)
{
    uint64_t h[BITS_CASES];
    (void)state;
    for (uint32_t k = 0; k < BITS_CASES; k++) {
        h[k] = reference(&bits_cases[k]);
        for (uint32_t j = 0; j < k; j++)
            if (h[j] == h[k])
                fail_msg("%s and %s have one hash", bits_cases[j].name, bits_cases[k].name);
    }
}

/* In float every case goes with every setting, in double, which takes the same ways, with one of them, in turn: half
   the time. */
static bool tried(uint32_t k, uint32_t setting, uint32_t settings) { return !SPH_DOUBLE || k % settings == setting; }

static void threads_in_any_order_change_no_bit(void **state)
{
    static const uint32_t threads[] = {2, 3, 8};
    (void)state;
    for (uint32_t k = 0; k < BITS_CASES; k++) {
        const bits_case *b = &bits_cases[k];
        uint64_t want = reference(b);
        for (uint32_t t = 0; t < 3; t++) {
            if (!tried(k, t, 3))
                continue;
            shuffle s;
            sph_port port = shuffle_port(&s, threads[t]);
            same(finish(make(b, &port, 8), CASE_STEPS), want, b, "shuffled chunks");
            assert_true(s.calls > 0 || SPH_DIM == 1);
            assert_int_equal(free_sims(NULL), 0);
        }
    }
}

/* a run in slices of a budget, reading the state between slices; returns the hash after the steps */
static uint64_t sliced(sph_sim *sim, uint64_t budget)
{
    sph_step_info info;
    must(sim, sph_ready(sim));
    uint64_t before = sph_hash(sim), calls = 0;
    do {
        sph_status st = sph_step_slice(sim, budget);
        calls++;
        if (st == SPH_NOT_DONE) {
            if (calls % 16 == 1)
                assert_true(sph_hash(sim) == before); /* what can be read is the step's beginning */
        } else {
            must(sim, st);
            before = sph_hash(sim);
        }
        sph_get_step(sim, &info);
    } while (info.step < CASE_STEPS);
    if (budget == 1)
        assert_true(calls > CASE_STEPS * 8);
    return sph_hash(sim);
}

static void slices_change_no_bit(void **state)
{
    static const uint64_t budgets[] = {1, 7, 100, 10000};
    (void)state;
    for (uint32_t k = 0; k < BITS_CASES; k++) {
        const bits_case *b = &bits_cases[k];
        uint64_t want = reference(b);
        for (uint32_t s = 0; s < 4; s++) {
            if (!tried(k, s, 4))
                continue;
            same(sliced(make(b, NULL, 1), budgets[s]), want, b, "slices");
            assert_int_equal(free_sims(NULL), 0);
        }
    }
}

static void slices_and_threads_together_change_no_bit(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < BITS_CASES; k += 5) {
        shuffle s;
        sph_port port = shuffle_port(&s, 3);
        const bits_case *b = &bits_cases[k];
        uint64_t want = reference(b);
        same(sliced(make(b, &port, 3), 500), want, b, "slices and threads");
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a step begun and given up leaves no trace */
static void a_cancelled_step_changes_no_bit(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < BITS_CASES; k++) {
        const bits_case *b = &bits_cases[k];
        uint64_t want = reference(b);
        sph_sim *sim = make(b, NULL, 1);
        must(sim, sph_ready(sim));
        for (uint32_t n = 0; n < CASE_STEPS; n++) {
            uint64_t before = sph_hash(sim);
            for (uint32_t j = 0; j < 3 + 5 * n && sph_step_slice(sim, 1) == SPH_NOT_DONE; j++)
                ;
            sph_step_info info;
            sph_get_step(sim, &info);
            if (info.step == n) {
                sph_step_cancel(sim);
                assert_true(sph_hash(sim) == before);
                must(sim, sph_step(sim));
            }
        }
        same(sph_hash(sim), want, b, "cancelled steps");
        assert_int_equal(free_sims(NULL), 0);
    }
}

typedef struct log_sum {
    uint64_t h;
    uint32_t n;
} log_sum;
static void add_log(void *ctx, uint64_t step, const char *pass, uint64_t hash)
{
    log_sum *l = ctx;
    l->h = l->h * 31 + (hash ^ step ^ (uint64_t)strlen(pass));
    l->n++;
}
static void the_stage_log_is_the_same_in_slices(void **state)
{
    log_sum a = {0, 0}, b = {0, 0};
    (void)state;
    for (int turn = 0; turn < 2; turn++) {
        sph_config c = case_config(&bits_cases[0]);
        c.stage_log = add_log;
        c.stage_ctx = turn ? &b : &a;
        sph_sim *sim = new_sim(&c);
        must(sim, case_build(sim, &bits_cases[0]));
        if (turn)
            sliced(sim, 100);
        else
            finish(sim, CASE_STEPS);
    }
    assert_true(a.n > CASE_STEPS * 4);
    assert_int_equal(a.n, b.n);
    assert_true(a.h == b.h);
}

#if HAVE_DUMP
typedef struct stream {
    unsigned char *byte;
    size_t n, at, room;
} stream;
static bool put_bytes(void *ctx, const void *bytes, size_t n)
{
    stream *s = ctx;
    assert_true(n > 0 && n <= SPH_PIECE);
    if (s->n + n > s->room)
        return false;
    memcpy(s->byte + s->n, bytes, n);
    s->n += n;
    return true;
}
static bool get_bytes(void *ctx, void *bytes, size_t n)
{
    stream *s = ctx;
    if (s->at + n > s->n)
        return false;
    memcpy(bytes, s->byte + s->at, n);
    s->at += n;
    return true;
}

static void a_restore_at_any_step_changes_no_bit(void **state)
{
    stream s = {malloc(CASE_ARENA_BYTES), 0, 0, CASE_ARENA_BYTES};
    (void)state;
    for (uint32_t k = 0; k < BITS_CASES; k++) {
        const bits_case *b = &bits_cases[k];
        uint64_t want = reference(b);
        sph_sim *sim = make(b, NULL, 1);
        must(sim, sph_ready(sim));
        for (uint32_t n = 0; n <= CASE_STEPS; n += 3) {
            s.n = s.at = 0;
            must(sim, sph_dump(sim, SPH_DUMP_FULL, put_bytes, &s));
            sph_sim *other = make(b, NULL, 1);
            must(other, sph_restore(other, get_bytes, &s));
            assert_true(sph_hash(other) == sph_hash(sim));
            same(finish(other, CASE_STEPS - n), want, b, "restore");
            for (uint32_t j = 0; j < 3 && n + j < CASE_STEPS; j++)
                must(sim, sph_step(sim));
        }
        assert_int_equal(free_sims(NULL), 0);
    }
    free(s.byte);
}
#endif

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(every_choice_gives_another_hash),
        subject(threads_in_any_order_change_no_bit),
        subject(slices_change_no_bit),
        subject(slices_and_threads_together_change_no_bit),
        subject(a_cancelled_step_changes_no_bit),
        subject(the_stage_log_is_the_same_in_slices),
#if HAVE_DUMP
        subject(a_restore_at_any_step_changes_no_bit),
#endif
    };
    return run_subjects("bits", list);
}
