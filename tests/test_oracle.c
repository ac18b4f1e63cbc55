/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_oracle.c: some random small scenes against the oracle (tests/oracle); `make oracle` runs more of them. A scene
   that differs is made as small as it goes and printed. */
#include "oracle/plan.h"
#include "testing.h"

enum { SCENES = 170 };

static plan p;
static uint32_t undecided, refused;

static void show(uint64_t seed, difference d)
{
    plan_draw(&p, seed);
    plan_shrink(&p, &d);
    print_message("seed %llu: %s of particle %d, component %u: kernel %.17g, oracle %.17g\n", (unsigned long long)seed,
                  d.name, (int)d.particle, d.component, d.kernel, d.oracle);
    plan_print(&p);
}

static void random_scenes_agree_with_the_oracle(void **state)
{
    uint32_t differ = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        difference d[PLAN_QUANTITIES];
        uint32_t n = 0;
        plan_draw(&p, seed);
        const verdict v = plan_compare(&p, NULL, d, &n, NULL);
        undecided += v == PLAN_UNDECIDED;
        refused += v == PLAN_REFUSED;
        if (v == PLAN_DIFFERS && ++differ <= 5)
            show(seed, d[0]);
    }
    assert_int_equal(differ, 0);
}

/* a generator that draws what is refused, or what rounding decides, would prove nothing */
static void nearly_all_scenes_are_looked_at(void **state)
{
    (void)state;
    assert_true(refused < SCENES / 5);
    assert_true(undecided < SCENES / 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_agree_with_the_oracle),
        cmocka_unit_test(nearly_all_scenes_are_looked_at),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
