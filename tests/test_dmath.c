/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/*
 * tests of the deterministic functions: errors against a table of correctly rounded results,
 * identities, edge values, and the generator against values worked out independently.
 */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "dmath.h"
#include "dmath_ref.h"

#define INF_BITS UINT64_C(0x7ff0000000000000)
#define NAN_BITS UINT64_C(0x7ff8000000000000)
#define SIGN_BIT UINT64_C(0x8000000000000000)
#define RESIDUAL_UNIT (1.0 / 4096.0)

static uint64_t bits(double x)
{
    uint64_t b;

    memcpy(&b, &x, sizeof b);
    return b;
}

static double value(uint64_t b)
{
    double x;

    memcpy(&x, &b, sizeof x);
    return x;
}

#define assert_same_bits(a, b) assert_true(bits(a) == bits(b))

/* places a double on a line of integers one ulp apart, so that differences count ulps */
static int64_t position(double x)
{
    int64_t m = (int64_t)(bits(x) & ~SIGN_BIT);

    return (bits(x) & SIGN_BIT) != 0 ? -m : m;
}

static double distance(double a, double b)
{
    double d = (double)(position(a) - position(b));

    return d < 0.0 ? -d : d;
}

/* ---- errors against the table ---- */

struct subject {
    const char *name;
    double limit; /* the figure dmath.h states, ulp */
};

static const struct subject SUBJECTS[REF_COUNT] = {
    [REF_SIN] = {"sin", 0.86},   [REF_COS] = {"cos", 0.86},   [REF_EXP] = {"exp", 0.62},
    [REF_LOG] = {"log", 0.54},   [REF_POW] = {"pow", 0.77},   [REF_TANH] = {"tanh", 0.77},
    [REF_ATAN2] = {"atan2", 0.75},
};

static double call(int fn, double x, double y)
{
    switch (fn) {
    case REF_SIN: return sph_sin(x);
    case REF_COS: return sph_cos(x);
    case REF_EXP: return sph_exp(x);
    case REF_LOG: return sph_log(x);
    case REF_POW: return sph_pow(x, y);
    case REF_TANH: return sph_tanh(x);
    default: return sph_atan2(x, y);
    }
}

static void check_errors(int fn)
{
    double worst = 0.0;
    int rows = 0;

    for (size_t i = 0; i < sizeof DMATH_REF / sizeof DMATH_REF[0]; i++) {
        const struct dmath_ref_row *r = &DMATH_REF[i];
        double got, err;

        if (r->fn != fn) {
            continue;
        }
        got = call(fn, value(r->x), value(r->y));
        err = (double)(position(got) - position(value(r->want))) - r->residual * RESIDUAL_UNIT;
        err = err < 0.0 ? -err : err;
        worst = err > worst ? err : worst;
        rows++;
    }
    print_message("%-5s %d rows, largest error %.3f ulp\n", SUBJECTS[fn].name, rows, worst);
    assert_true(rows >= 200);
    assert_true(worst <= SUBJECTS[fn].limit + RESIDUAL_UNIT);
}

static void test_errors(void **state)
{
    (void)state;
    for (int fn = 0; fn < REF_COUNT; fn++) {
        check_errors(fn);
    }
}

/* ---- identities ---- */

static double between(sph_rng *rng, double lo, double hi)
{
    return lo + (hi - lo) * sph_rng_uniform(rng);
}

static double any_finite(sph_rng *rng)
{
    uint64_t b;

    do {
        b = (uint64_t)sph_rng_u32(rng) << 32;
        b |= sph_rng_u32(rng);
    } while ((b & INF_BITS) == INF_BITS);
    return value(b);
}

static void test_pythagoras(void **state)
{
    sph_rng rng;

    (void)state;
    sph_rng_seed(&rng, 11, 0);
    for (int i = 0; i < 20000; i++) {
        double x = (i & 1) != 0 ? between(&rng, -1e5, 1e5) : any_finite(&rng);
        double s = sph_sin(x), c = sph_cos(x);
        double off = s * s + c * c - 1.0;

        assert_true(off <= 2.0 * DBL_EPSILON && off >= -2.0 * DBL_EPSILON);
        assert_true(s >= -1.0 && s <= 1.0 && c >= -1.0 && c <= 1.0);
    }
}

static void test_exp_undoes_log(void **state)
{
    sph_rng rng;

    (void)state;
    sph_rng_seed(&rng, 12, 0);
    for (int i = 0; i < 20000; i++) {
        double x = between(&rng, 0.5, 2.0);

        assert_true(distance(sph_exp(sph_log(x)), x) <= 2.0);
        assert_true(distance(sph_pow(x, 1.0), x) <= 1.0);
        assert_true(distance(sph_pow(x, 2.0), x * x) <= 1.0);
        assert_true(distance(sph_pow(x, 0.5) * sph_pow(x, 0.5), x) <= 3.0);
    }
}

static void test_atan2_undoes_turning(void **state)
{
    sph_rng rng;

    (void)state;
    sph_rng_seed(&rng, 13, 0);
    for (int i = 0; i < 20000; i++) {
        double a = between(&rng, -3.14159, 3.14159);
        double off = sph_atan2(sph_sin(a), sph_cos(a)) - a;

        assert_true(off <= 4.0 * DBL_EPSILON && off >= -4.0 * DBL_EPSILON);
    }
}

static void test_steps_near_zero(void **state)
{
    double before = 0.0;

    (void)state;
    for (int i = -4000; i <= 4000; i++) {
        double e = sph_exp((double)i * 0x1p-54);

        assert_true(e >= before);
        assert_true(i <= 0 ? e <= 1.0 : e >= 1.0);
        before = e;
    }
    before = -1.0;
    for (int i = -4000; i <= 4000; i++) {
        double t = sph_tanh((double)i * 0x1p-30);

        assert_true(t > before);
        before = t;
    }
}

static void test_symmetry(void **state)
{
    sph_rng rng;

    (void)state;
    sph_rng_seed(&rng, 14, 0);
    for (int i = 0; i < 20000; i++) {
        double x = (i & 1) != 0 ? between(&rng, -30.0, 30.0) : any_finite(&rng);
        double y = any_finite(&rng);

        assert_same_bits(sph_sin(-x), -sph_sin(x));
        assert_same_bits(sph_cos(-x), sph_cos(x));
        assert_same_bits(sph_tanh(-x), -sph_tanh(x));
        assert_same_bits(sph_atan2(-x, y), -sph_atan2(x, y));
    }
}

/* no NaN and nothing subnormal from any finite arguments */
static void test_results_are_clean(void **state)
{
    sph_rng rng;

    (void)state;
    sph_rng_seed(&rng, 15, 0);
    for (int i = 0; i < 30000; i++) {
        double x = any_finite(&rng), y = any_finite(&rng);

        if (i % 3 == 0) {
            /* also subnormal and barely normal arguments */
            x = value(bits(x) & ~(UINT64_C(0x7fe) << 52));
        }
        for (int fn = 0; fn < REF_COUNT; fn++) {
            uint64_t b = bits(call(fn, x, y)) & ~SIGN_BIT;

            assert_true(b <= INF_BITS);
            assert_true(b == 0 || b >= bits(DBL_MIN));
            assert_true(b < INF_BITS || fn == REF_EXP || fn == REF_POW);
        }
    }
}

/* ---- edge values ---- */

static void test_edges_of_sin_cos_tanh(void **state)
{
    const double inf = value(INF_BITS), nan = value(NAN_BITS | 1u);

    (void)state;
    assert_same_bits(sph_sin(0.0), 0.0);
    assert_same_bits(sph_sin(-0.0), -0.0);
    assert_same_bits(sph_cos(-0.0), 1.0);
    assert_same_bits(sph_sin(DBL_MIN), DBL_MIN);
    assert_same_bits(sph_sin(-DBL_MIN * 0.5), -0.0);
    assert_same_bits(sph_cos(DBL_MIN * 0.5), 1.0);
    assert_same_bits(sph_tanh(-0.0), -0.0);
    assert_same_bits(sph_tanh(DBL_MIN * 0.5), 0.0);
    assert_same_bits(sph_tanh(20.0), 1.0);
    assert_same_bits(sph_tanh(-DBL_MAX), -1.0);
    assert_same_bits(sph_tanh(-inf), -1.0);
    assert_true(bits(sph_sin(inf)) == NAN_BITS);
    assert_true(bits(sph_cos(-inf)) == NAN_BITS);
    assert_true(bits(sph_sin(nan)) == NAN_BITS);
    assert_true(bits(sph_cos(nan)) == NAN_BITS);
    assert_true(bits(sph_tanh(nan)) == NAN_BITS);
}

static void test_edges_of_exp_log(void **state)
{
    const double inf = value(INF_BITS), nan = value(NAN_BITS | 1u);

    (void)state;
    assert_same_bits(sph_exp(0.0), 1.0);
    assert_same_bits(sph_exp(-0.0), 1.0);
    assert_true(sph_exp(709.782712893384) <= DBL_MAX);
    assert_same_bits(sph_exp(709.7827128933841), inf);
    assert_same_bits(sph_exp(DBL_MAX), inf);
    assert_same_bits(sph_exp(inf), inf);
    assert_true(sph_exp(-708.3964185322641) >= DBL_MIN);
    assert_same_bits(sph_exp(-708.3964185322642), 0.0);
    assert_same_bits(sph_exp(-DBL_MAX), 0.0);
    assert_same_bits(sph_exp(-inf), 0.0);
    assert_true(bits(sph_exp(nan)) == NAN_BITS);
    assert_same_bits(sph_log(1.0), 0.0);
    assert_same_bits(sph_log(0.0), -DBL_MAX);
    assert_same_bits(sph_log(-0.0), -DBL_MAX);
    assert_same_bits(sph_log(-1.0), -DBL_MAX);
    assert_same_bits(sph_log(-inf), -DBL_MAX);
    assert_same_bits(sph_log(DBL_MIN * 0.5), -DBL_MAX);
    assert_same_bits(sph_log(inf), inf);
    assert_true(bits(sph_log(nan)) == NAN_BITS);
}

static void test_edges_of_pow(void **state)
{
    const double inf = value(INF_BITS), nan = value(NAN_BITS | 1u);

    (void)state;
    assert_same_bits(sph_pow(0.0, 2.5), 0.0);
    assert_same_bits(sph_pow(-0.0, 2.5), 0.0);
    assert_same_bits(sph_pow(0.0, 0.0), 1.0);
    assert_same_bits(sph_pow(0.0, -1.0), inf);
    assert_same_bits(sph_pow(-2.0, 2.0), 0.0);
    assert_same_bits(sph_pow(-2.0, 0.0), 1.0);
    assert_same_bits(sph_pow(1.0, DBL_MAX), 1.0);
    assert_same_bits(sph_pow(7.0, DBL_MIN), 1.0);
    assert_same_bits(sph_pow(2.0, 10.0), 1024.0);
    assert_same_bits(sph_pow(2.0, 1023.0), 0x1p1023);
    assert_same_bits(sph_pow(2.0, 1024.0), inf);
    assert_same_bits(sph_pow(2.0, -1022.0), DBL_MIN);
    assert_same_bits(sph_pow(2.0, -1023.0), 0.0);
    assert_same_bits(sph_pow(0.5, DBL_MAX), 0.0);
    assert_same_bits(sph_pow(0.5, -DBL_MAX), inf);
    assert_same_bits(sph_pow(1.5, -inf), 0.0);
    assert_same_bits(sph_pow(inf, 2.0), inf);
    assert_same_bits(sph_pow(inf, -2.0), 0.0);
    assert_true(bits(sph_pow(nan, 2.0)) == NAN_BITS);
    assert_true(bits(sph_pow(2.0, nan)) == NAN_BITS);
}

static void test_edges_of_atan2(void **state)
{
    const double pi = 0x1.921fb54442d18p+1;
    const double inf = value(INF_BITS), nan = value(NAN_BITS | 1u);

    (void)state;
    assert_same_bits(sph_atan2(0.0, 0.0), 0.0);
    assert_same_bits(sph_atan2(-0.0, 0.0), -0.0);
    assert_same_bits(sph_atan2(0.0, -0.0), pi);
    assert_same_bits(sph_atan2(-0.0, -3.0), -pi);
    assert_same_bits(sph_atan2(-0.0, 3.0), -0.0);
    assert_same_bits(sph_atan2(2.0, 0.0), 0.5 * pi);
    assert_same_bits(sph_atan2(-2.0, -0.0), -0.5 * pi);
    assert_same_bits(sph_atan2(2.0, 2.0), 0.25 * pi);
    assert_same_bits(sph_atan2(-DBL_MAX, DBL_MAX), -0.25 * pi);
    assert_same_bits(sph_atan2(DBL_MIN, DBL_MIN), 0.25 * pi);
    assert_same_bits(sph_atan2(DBL_MIN, 4.0), 0.0);
    assert_same_bits(sph_atan2(-DBL_MIN, DBL_MAX), -0.0);
    assert_same_bits(sph_atan2(DBL_MIN, -DBL_MAX), pi);
    assert_true(bits(sph_atan2(inf, 1.0)) == NAN_BITS);
    assert_true(bits(sph_atan2(1.0, -inf)) == NAN_BITS);
    assert_true(bits(sph_atan2(nan, 1.0)) == NAN_BITS);
}

/* ---- the generator ---- */

/* the first row is the published sample of the algorithm's author; all three, and the values
 * below, were also worked out with arbitrary-precision integers from the paper's formulas */
static void test_generator_words(void **state)
{
    static const struct {
        uint64_t seed, stream;
        uint32_t want[6];
    } rows[] = {
        {42, 54, {0xa15c02b7, 0x7b47f409, 0xba1d3330, 0x83d2f293, 0xbfa4784b, 0xcbed606e}},
        {1, 0, {0xe2393051, 0x01112f35, 0xd3509d35, 0x0b932f4a, 0x8aa46776, 0x8c532036}},
        {UINT64_C(0xfedcba9876543210), UINT64_C(0x8000000000000003),
         {0x438e4a02, 0x146b5aa5, 0x471e6f71, 0x9b283268, 0x88c8b9c4, 0xb3ca368a}},
    };
    sph_rng rng;

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        sph_rng_seed(&rng, rows[i].seed, rows[i].stream);
        for (int j = 0; j < 6; j++) {
            assert_int_equal(sph_rng_u32(&rng), rows[i].want[j]);
        }
    }
    for (int j = 6; j < 999; j++) {
        (void)sph_rng_u32(&rng);
    }
    assert_int_equal(sph_rng_u32(&rng), 0x3be1baef);
}

static void test_generator_uniform(void **state)
{
    static const double want[3] = {5677329731624912.0, 6548306420255690.0, 6742819669521793.0};
    double sum = 0.0, squares = 0.0;
    sph_rng rng;

    (void)state;
    sph_rng_seed(&rng, 42, 54);
    for (int i = 0; i < 3; i++) {
        assert_same_bits(sph_rng_uniform(&rng), want[i] * 0x1p-53);
    }
    for (int i = 0; i < 100000; i++) {
        double u = sph_rng_uniform(&rng);

        assert_true(u >= 0.0 && u < 1.0);
        sum += u;
        squares += u * u;
    }
    /* five standard errors of the mean and of the mean square */
    assert_true(sum > 49543.0 && sum < 50457.0);
    assert_true(squares > 32861.0 && squares < 33805.0);
}

static void test_generator_normal(void **state)
{
    static const double want[6] = {
        -0x1.9fee1723fac89p-3, -0x1.2b742460ff8f7p-7, 0x1.5b7b0dc6ab971p-1,
        0x1.193f16cdf13d2p+0,  0x1.026ade8949b45p-1,  -0x1.001ca8246e475p-2,
    };
    double sum = 0.0, squares = 0.0;
    sph_rng rng, copy;

    (void)state;
    sph_rng_seed(&rng, 42, 54);
    for (int i = 0; i < 6; i++) {
        double off = sph_rng_normal(&rng) - want[i];

        /* absolute: where the cosine is small the rounding of its argument weighs more */
        assert_true(off <= 8.0 * DBL_EPSILON && off >= -8.0 * DBL_EPSILON);
    }
    copy = rng;
    assert_same_bits(sph_rng_normal(&rng), sph_rng_normal(&copy));
    for (int i = 0; i < 100000; i++) {
        double g = sph_rng_normal(&rng);

        assert_true(g > -8.6 && g < 8.6);
        sum += g;
        squares += g * g;
    }
    assert_true(sum > -1582.0 && sum < 1582.0);
    assert_true(squares > 97763.0 && squares < 102237.0);
}

/* ---- the same bits everywhere ---- */

static uint64_t mix(uint64_t h, double x)
{
    /* fnv-1a over whole words, folded so that high bits count too */
    h = (h ^ bits(x)) * UINT64_C(1099511628211);
    return h ^ (h >> 29);
}

/* one checksum over all functions; a build whose bits differ anywhere fails here */
static void test_same_bits(void **state)
{
    uint64_t h = UINT64_C(14695981039346656037);
    sph_rng rng;

    (void)state;
    sph_rng_seed(&rng, 16, 0);
    for (int i = 0; i < 20000; i++) {
        double x = (i & 1) != 0 ? between(&rng, -600.0, 600.0) : any_finite(&rng);
        double y = (i & 2) != 0 ? between(&rng, -300.0, 300.0) : any_finite(&rng);
        double m = x < 0.0 ? -x : x;

        h = mix(h, sph_sin(x));
        h = mix(h, sph_cos(x));
        h = mix(h, sph_exp(x));
        h = mix(h, sph_log(m));
        h = mix(h, sph_pow((i & 1) != 0 ? m * 0x1p-9 : m, y * 0x1p-3));
        h = mix(h, sph_tanh((i & 1) != 0 ? x * 0x1p-6 : x));
        h = mix(h, sph_atan2(y, x));
        h = mix(h, sph_rng_normal(&rng));
    }
    print_message("checksum %08lx%08lx\n", (unsigned long)(h >> 32),
                  (unsigned long)(h & 0xffffffffu));
    assert_true(h == UINT64_C(0x327fab6d049fa77d));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_pythagoras),
        cmocka_unit_test(test_exp_undoes_log),
        cmocka_unit_test(test_atan2_undoes_turning),
        cmocka_unit_test(test_steps_near_zero),
        cmocka_unit_test(test_symmetry),
        cmocka_unit_test(test_results_are_clean),
        cmocka_unit_test(test_edges_of_sin_cos_tanh),
        cmocka_unit_test(test_edges_of_exp_log),
        cmocka_unit_test(test_edges_of_pow),
        cmocka_unit_test(test_edges_of_atan2),
        cmocka_unit_test(test_generator_words),
        cmocka_unit_test(test_generator_uniform),
        cmocka_unit_test(test_generator_normal),
        cmocka_unit_test(test_same_bits),
    };

    return cmocka_run_group_tests_name("dmath", tests, NULL, NULL);
}
