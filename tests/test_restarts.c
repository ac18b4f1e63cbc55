/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_restarts.c: no field of a particle and no scratch is read before it was written in the step under way: a run
   that is dumped and restored at any step goes on with the same bits, in random scenes of all modules. The kernel is
   one with SPH_VALIDATES on: before every stage all that nobody may read is filled with poison, of another kind in
   every other arena. SCENES (environment): how many scenes; FIRST: number of the first; `make restarts` asks for
   2,000. */
#include "random_scene.h"

#include "sph/internal.h"

enum { STEPS = 8, ROOM = 1 << 22 };

typedef struct tape {
    size_t n, at;
} tape;
static unsigned char bytes[ROOM];

static bool record(void *ctx, const void *p, size_t n)
{
    tape *t = ctx;
    assert_true(t->n + n <= ROOM);
    memcpy(bytes + t->n, p, n);
    t->n += n;
    return true;
}
static bool play(void *ctx, void *p, size_t n)
{
    tape *t = ctx;
    if (t->at + n > t->n)
        return false;
    memcpy(p, bytes + t->at, n);
    t->at += n;
    return true;
}

/* the scene of a number in an arena whose address is an odd or even multiple of SPH_ALIGN */
static sph_sim *make(uint32_t number, bool odd, void **block)
{
    const sph_config c = random_config(number);
    const size_t need = sph_arena_bytes(&c);
    sph_report r;
    sph_sim *sim = NULL;
    if (need == 0) {
        sph_config_check(&c, &r);
        fail_msg("scene %u: %s = %g, allowed: %s", number, r.what, r.value, r.allowed);
    }
    *block = aligned_alloc(2 * SPH_ALIGN, (need + 4 * SPH_ALIGN) / (2 * SPH_ALIGN) * (2 * SPH_ALIGN));
    assert_non_null(*block);
    assert_int_equal(sph_init(&sim, &c, (unsigned char *)*block + (odd ? SPH_ALIGN : 0), need, &r), SPH_OK);
    random_build(sim, &c);
    return sim;
}

/* sim from where the other is now */
static void take_over(sph_sim *sim, const sph_sim *from)
{
    tape t = {0, 0};
    assert_int_equal(sph_dump(from, SPH_DUMP_FULL, record, &t), SPH_OK);
    must(sim, sph_restore(sim, play, &t));
}

/* `one` runs; `two` is restored from it before every step, `three` once; all end with the same bits */
static uint32_t run_scene(uint32_t number)
{
    void *block[3];
    sph_sim *one = make(number, false, &block[0]), *two = make(number, true, &block[1]);
    sph_sim *three = make(number, true, &block[2]);
    const uint32_t restart = 1 + number % (STEPS - 1);
    uint32_t step = 0;
    for (sph_status st = SPH_OK; st == SPH_OK && step < STEPS; step += st == SPH_OK) {
        take_over(two, one);
        if (step == restart)
            take_over(three, one);
        st = sph_step(one);
        const sph_status again = sph_step(two), follows = step < restart ? st : sph_step(three);
        if (again != st || sph_hash(two) != sph_hash(one))
            fail_msg("scene %u: restored before step %u: %s, not %s", number, step, sph_status_text(again),
                     sph_status_text(st));
        if (follows != st || (step >= restart && sph_hash(three) != sph_hash(one)))
            fail_msg("scene %u: restored before step %u: %s at step %u", number, restart, sph_status_text(follows),
                     step);
    }
    for (int k = 0; k < 3; k++)
        free(block[k]);
    return step;
}

static uint32_t from_environment(const char *name, uint32_t usual)
{
    const char *text = getenv(name);
    return text ? (uint32_t)strtoul(text, NULL, 10) : usual;
}

static void a_restored_run_goes_on_with_the_same_bits(void **state)
{
    const uint32_t scenes = from_environment("SCENES", SPH_DIM == 3 ? 20 : 200), first = from_environment("FIRST", 0);
    uint32_t steps = 0, whole = 0;
    (void)state;
    for (uint32_t k = 0; k < scenes; k++) {
        const uint32_t n = run_scene(first + k);
        steps += n;
        whole += n == STEPS;
    }
    print_message("%u scenes, %u to their end, %u steps, each restored\n", scenes, whole, steps);
    assert_true(whole * 5 >= scenes * 4); /* scenes that fail early show less */
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_restored_run_goes_on_with_the_same_bits),
    };
    return run_subjects("restarts", list);
}
