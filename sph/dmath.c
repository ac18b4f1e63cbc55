/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/*
 * deterministic elementary functions; see dmath.h for what is promised.
 *
 * each function reduces its argument to a small interval, keeps the part that decides the
 * rounding as an unevaluated sum of two doubles, and fits only the small rest by a polynomial,
 * so that the last addition is nearly the only rounding that counts. the polynomials
 * interpolate at chebyshev nodes (80-digit arithmetic, coefficients then rounded to double);
 * split constants are the leading bits of the true value followed by the rounded rest.
 */
#include "dmath.h"

#include <float.h>
#include <stddef.h>
#include <string.h>
#include "arithmetic.h"

SPH_OBJECT(dmath)

#if defined(__FAST_MATH__)
#error "sph needs strict floating point: build without -ffast-math"
#endif
#if FLT_EVAL_METHOD < 0 || FLT_EVAL_METHOD == 2
#error "sph needs plain double arithmetic: on 32-bit x86 use -msse2 -mfpmath=sse"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

#define SIGN_BIT UINT64_C(0x8000000000000000)
#define ABS_MASK UINT64_C(0x7fffffffffffffff)
#define INF_BITS UINT64_C(0x7ff0000000000000)
#define NAN_BITS UINT64_C(0x7ff8000000000000)
#define MANT_MASK UINT64_C(0x000fffffffffffff)
#define HIDDEN_BIT UINT64_C(0x0010000000000000)
#define EXP_BIAS 1023

#define TWO_M27 0x1p-27 /* below it x^3/6 and x^3/3 stay under 1/20 ulp of x */

/* an unevaluated sum: |lo| is at most about half an ulp of hi. */
struct dd {
    double hi;
    double lo;
};

static uint64_t to_bits(double x)
{
    uint64_t b;

    memcpy(&b, &x, sizeof b);
    return b;
}

static double from_bits(uint64_t b)
{
    double x;

    memcpy(&x, &b, sizeof x);
    return x;
}

/* |x| with the subnormal range flushed to zero. */
static double magnitude(double x)
{
    uint64_t b = to_bits(x) & ABS_MASK;

    return b < HIDDEN_BIT ? 0.0 : from_bits(b);
}

/* gives magnitude m the sign of s; m may carry a sign of its own, which is then flipped. */
static double with_sign(double m, double s)
{
    return from_bits(to_bits(m) ^ (to_bits(s) & SIGN_BIT));
}

static int is_nan(double x)
{
    return (to_bits(x) & ABS_MASK) > INF_BITS;
}

static int is_finite(double x)
{
    return (to_bits(x) & ABS_MASK) < INF_BITS;
}

/* nearest integer; the caller keeps |v| below 2^30. ties may go either way, which the
 * reductions do not mind. */
static int32_t nearest(double v)
{
    return (int32_t)(v < 0.0 ? v - 0.5 : v + 0.5);
}

/* a + b exactly, for any order of magnitudes (knuth). */
static struct dd two_sum(double a, double b)
{
    struct dd r;
    double bb;

    r.hi = a + b;
    bb = r.hi - a;
    r.lo = (a - (r.hi - bb)) + (b - bb);
    return r;
}

/* a + b exactly when |a| >= |b| or a is zero (dekker). */
static struct dd quick_sum(double a, double b)
{
    struct dd r;

    r.hi = a + b;
    r.lo = b - (r.hi - a);
    return r;
}

/* the upper 26 bits of a; needs |a| < 2^996. */
static double upper_half(double a)
{
    const double splitter = 0x1p27 + 1.0;
    double t = splitter * a;

    return t - (t - a);
}

/* a * b exactly, without a fused multiply-add (dekker). */
static struct dd two_prod(double a, double b)
{
    double ah = upper_half(a), al = a - ah;
    double bh = upper_half(b), bl = b - bh;
    struct dd r;

    r.hi = a * b;
    r.lo = ((ah * bh - r.hi) + ah * bl + al * bh) + al * bl;
    return r;
}

/* product of two sums, to about 2^-103 of its size. */
static struct dd dd_mul(struct dd a, struct dd b)
{
    struct dd p = two_prod(a.hi, b.hi);

    return quick_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* quotient of two sums, to about 2^-104 of its size: the rounded quotient and its remainder. */
static struct dd dd_div(struct dd a, struct dd b)
{
    struct dd p, q;

    q.hi = a.hi / b.hi;
    p = two_prod(q.hi, b.hi);
    q.lo = (((a.hi - p.hi) - p.lo) + (a.lo - q.hi * b.lo)) / b.hi;
    return q;
}

/* c[0] + c[1] x + ... + c[n-1] x^(n-1) */
static double poly(const double *c, size_t n, double x)
{
    double p = c[n - 1];

    for (size_t i = n - 1; i > 0; i--) {
        p = p * x + c[i - 1];
    }
    return p;
}

#define POLY(c, x) poly((c), sizeof(c) / sizeof((c)[0]), (x))

/* ---- sine and cosine ---- */

/* (sin r - r) / r^3 in r^2 for |r| <= pi/4; fit error 2^-55.6 of sin r */
static const double SIN_C[6] = {
    -0x1.5555555555555p-3, 0x1.1111111110bb2p-7,  -0x1.a01a019e83896p-13,
    0x1.71de37965ea23p-19, -0x1.ae600ad575103p-26, 0x1.5e0b09ab9455dp-33,
};
/* (cos r - 1 + r^2/2) / r^4 in r^2 for |r| <= pi/4; fit error 2^-60 */
static const double COS_C[6] = {
    0x1.5555555555555p-5,  -0x1.6c16c16c16967p-10, 0x1.a01a019f4e9f4p-16,
    -0x1.27e4fa17c44ddp-22, 0x1.1eeb68d295694p-29, -0x1.907d931693df4p-37,
};
static const double TWO_OVER_PI = 0x1.45f306dc9c883p-1;
static const struct dd PI_HALF = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/* the bits of 2/pi after the binary point, behind 64 zero bits that let the window below start
 * ahead of the point. */
static const uint32_t TWO_OVER_PI_BITS[39] = {
    0,           0,           0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u, 0xdb629599u,
    0x3c439041u, 0xfe5163abu, 0xdebbc561u, 0xb7246e3au, 0x424dd2e0u, 0x06492eeau, 0x09d1921cu,
    0xfe1deb1cu, 0xb129a73eu, 0xe88235f5u, 0x2ebb4484u, 0xe99c7026u, 0xb45f7e41u, 0x3991d639u,
    0x835339f4u, 0x9c845f8bu, 0xbdf9283bu, 0x1ff897ffu, 0xde05980fu, 0xef2f118bu, 0x5a0a6d1fu,
    0x6d367ecfu, 0x27cb09b7u, 0x4f463f66u, 0x9e5fea2du, 0x7527bac7u, 0xebe5f17bu, 0x3d0739f7u,
    0x8a5292eau, 0x6bfb5fb1u, 0x1f8d5d08u, 0x56033046u,
};

#define WINDOW_WORDS 6 /* 192 bits: 2 of quadrant, 53 spoilt, 62 of cancellation, 75 left */

/* signed fraction of a quarter turn from two's complement words, most significant first. */
static struct dd fraction_value(uint32_t *f)
{
    int negative = (f[0] >> 31) != 0;
    uint64_t carry = negative ? 1 : 0;
    double weight = 0x1p-32;
    struct dd v = {0.0, 0.0};

    for (int i = WINDOW_WORDS - 1; i >= 0; i--) {
        uint64_t t = (uint64_t)(negative ? ~f[i] : f[i]) + carry;

        f[i] = (uint32_t)t;
        carry = t >> 32;
    }
    for (int i = 0; i < WINDOW_WORDS; i++) {
        struct dd s = two_sum(v.hi, (double)f[i] * weight);

        v.hi = s.hi;
        v.lo += s.lo;
        weight *= 0x1p-32;
    }
    v = quick_sum(v.hi, v.lo);
    if (negative) {
        v.hi = -v.hi;
        v.lo = -v.lo;
    }
    return v;
}

/*
 * reduces x >= 2^20 modulo pi/2 after payne and hanek (1983): of the product x * 2/pi only the
 * bits below the weight 4 matter, so a window of 2/pi chosen by the exponent of x times the
 * 53-bit integer significand of x gives quadrant and fraction in integers.
 */
static uint32_t reduce_large(double x, struct dd *r)
{
    uint64_t b = to_bits(x);
    uint32_t start = (uint32_t)(b >> 52) - (EXP_BIAS + 52) - 2 + 64;
    uint64_t m = (b & MANT_MASK) | HIDDEN_BIT;
    uint32_t w[WINDOW_WORDS], f[WINDOW_WORDS];
    uint64_t carry = 0;
    uint32_t quadrant;

    for (uint32_t i = 0; i < WINDOW_WORDS; i++) {
        const uint32_t *t = &TWO_OVER_PI_BITS[(start >> 5) + i];

        w[i] = (uint32_t)((((uint64_t)t[0] << 32) | t[1]) >> (32 - (start & 31)));
    }
    for (int i = WINDOW_WORDS - 1; i >= 0; i--) {
        uint64_t t = w[i] * (m & 0xffffffffu) + carry;

        f[i] = (uint32_t)t;
        carry = t >> 32;
    }
    carry = 0;
    for (int i = WINDOW_WORDS - 2; i >= 0; i--) {
        uint64_t t = w[i + 1] * (m >> 32) + f[i] + carry;

        f[i] = (uint32_t)t;
        carry = t >> 32;
    }
    /* the fraction is read as signed, so one half and above belongs to the next quadrant */
    quadrant = (f[0] >> 30) + ((f[0] >> 29) & 1u);
    for (int i = 0; i < WINDOW_WORDS; i++) {
        f[i] = (f[i] << 2) | (i + 1 < WINDOW_WORDS ? f[i + 1] >> 30 : 0u);
    }
    *r = dd_mul(fraction_value(f), PI_HALF);
    return quadrant & 3u;
}

/*
 * reduces finite x >= 0 to x = n pi/2 + r with |r| <= pi/4 (a hair more by rounding) and
 * returns n modulo 4. the first three parts of pi/2 are multiples of 2^-32, 2^-65 and 2^-98 of
 * at most 33 bits: their products with n < 2^20 are exact (cody and waite).
 */
static uint32_t reduce(double x, struct dd *r)
{
    static const double part[4] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e0p-69,
                                   0x1.b839a252049c1p-104};
    int32_t n;
    struct dd a, b;

    if (x >= 0x1p20) {
        return reduce_large(x, r);
    }
    n = nearest(x * TWO_OVER_PI);
    a = two_sum(x - (double)n * part[0], -((double)n * part[1]));
    b = two_sum(a.hi, -((double)n * part[2]));
    *r = two_sum(b.hi, (a.lo + b.lo) - (double)n * part[3]);
    return (uint32_t)n & 3u;
}

/* sine (odd = 0) or cosine (odd = 1) of n quarter turns plus r. */
static double quarter_wave(uint32_t n, struct dd r)
{
    double z = r.hi * r.hi;
    double half = 0.5 * z, v;

    if ((n & 1u) == 0u) {
        v = r.hi + (r.hi * z * POLY(SIN_C, z) + r.lo * (1.0 - half));
    } else {
        double w = 1.0 - half;

        v = w + (((1.0 - w) - half) + (z * z * POLY(COS_C, z) - r.hi * r.lo));
    }
    return (n & 2u) == 0u ? v : -v;
}

double SPH_NAME(sin)(double x)
{
    double ax = magnitude(x);
    struct dd r;
    uint32_t n;

    if (!is_finite(x)) {
        return from_bits(NAN_BITS);
    }
    if (ax < TWO_M27) {
        return with_sign(ax, x);
    }
    n = reduce(ax, &r);
    return with_sign(quarter_wave(n, r), x);
}

double SPH_NAME(cos)(double x)
{
    double ax = magnitude(x);
    struct dd r;
    uint32_t n;

    if (!is_finite(x)) {
        return from_bits(NAN_BITS);
    }
    if (ax < TWO_M27) {
        return 1.0;
    }
    n = reduce(ax, &r);
    return quarter_wave(n + 1u, r);
}

/* ---- exponential ---- */

/* (exp r - 1 - r) / r^2 for |r| <= ln2/2; fit error 2^-61.6 */
static const double EXP_C[11] = {
    0x1.0000000000000p-1,  0x1.5555555555557p-3,  0x1.5555555555556p-5,  0x1.11111111100dbp-7,
    0x1.6c16c16c162adp-10, 0x1.a01a01abe85a3p-13, 0x1.a01a01a6e8d86p-16, 0x1.71de023071ed7p-19,
    0x1.27e4db38b0364p-22, 0x1.af4debdc8ac0fp-26, 0x1.1f735452d6fe2p-29,
};
static const double INV_LN2 = 0x1.71547652b82fep+0;
/* 40 bits, so that a multiple up to 2^13 is exact, and the rest */
static const struct dd LN2 = {0x1.62e42fefa2p-1, 0x1.9ef35793c7673p-41};

/* beyond these exp is surely infinite or flushed; they also keep the integer k in range */
static const double EXP_MAX = 710.0;
static const double EXP_MIN = -709.0;

/* exp = 2^k (1 + r + tail), |r| <= ln2/2, tail of the size of r^2/2 */
struct exp_parts {
    int32_t k;
    double r;
    double tail;
};

/* splits exp(x + lo) for EXP_MIN <= x <= EXP_MAX and lo below an ulp of x. */
static struct exp_parts exp_split(double x, double lo)
{
    struct exp_parts e;
    struct dd r;

    e.k = nearest(x * INV_LN2);
    r = two_sum(x - (double)e.k * LN2.hi, lo - (double)e.k * LN2.lo);
    e.r = r.hi;
    e.tail = (r.lo + r.lo * r.hi) + r.hi * r.hi * POLY(EXP_C, r.hi);
    return e;
}

/* exp(x + lo); the power of two goes in through the exponent field, so that the flush to zero
 * and the overflow are integer decisions. */
static double exp_join(double x, double lo)
{
    struct exp_parts e;
    struct dd s;
    uint64_t b;
    int32_t field;

    if (x > EXP_MAX) {
        return from_bits(INF_BITS);
    }
    if (x < EXP_MIN) {
        return 0.0;
    }
    e = exp_split(x, lo);
    s = quick_sum(1.0, e.r);
    b = to_bits(s.hi + (s.lo + e.tail));
    field = (int32_t)(b >> 52) + e.k;
    if (field <= 0) {
        return 0.0;
    }
    if (field >= 2 * EXP_BIAS + 1) {
        return from_bits(INF_BITS);
    }
    return from_bits((b & MANT_MASK) | ((uint64_t)field << 52));
}

double SPH_NAME(exp)(double x)
{
    if (is_nan(x)) {
        return from_bits(NAN_BITS);
    }
    return exp_join(x, 0.0);
}

double SPH_NAME(tanh)(double x)
{
    double ax = magnitude(x);
    double p;
    struct exp_parts e;
    struct dd less, more, num, den, q;

    if (is_nan(x)) {
        return from_bits(NAN_BITS);
    }
    if (ax < TWO_M27) {
        return with_sign(ax, x);
    }
    if (ax >= 20.0) {
        return with_sign(1.0, x);
    }
    /* (e^2x - 1) / (e^2x + 1) with e^2x still split, so that the -1 cancels nothing */
    e = exp_split(2.0 * ax, 0.0);
    p = from_bits((uint64_t)(e.k + EXP_BIAS) << 52);
    less = two_sum(p, -1.0);
    more = two_sum(p, 1.0);
    num = two_sum(less.hi, p * e.r);
    den = two_sum(more.hi, p * e.r);
    num.lo += less.lo + p * e.tail;
    den.lo += more.lo + p * e.tail;
    q = dd_div(quick_sum(num.hi, num.lo), quick_sum(den.hi, den.lo));
    return with_sign(q.hi + q.lo, x);
}

/* ---- logarithm and power ---- */

/* (atanh(s)/s - 1 - s^2/3) / s^4 in s^2 for |s| <= 0.1716; fit error 2^-66.4 */
static const double LOG_C[8] = {
    0x1.999999999999ap-3, 0x1.2492492492521p-3, 0x1.c71c71c6eaa18p-4, 0x1.745d177a95918p-4,
    0x1.3b1395d249840p-4, 0x1.1118c7da60720p-4, 0x1.df7ccb0ee6412p-5, 0x1.e02e5964c1526p-5,
};
static const struct dd THIRD = {0x1.5555555555555p-2, 0x1.5555555555555p-56};
static const double SQRT2 = 0x1.6a09e667f3bcdp+0;

/* x = 2^k m with m in [sqrt(1/2), sqrt(2)]; gives k and s = (m - 1) / (m + 1) to about 2^-105,
 * so that log m = 2 atanh s. x must be normal, positive and finite. */
static struct dd log_reduce(double x, int32_t *k)
{
    uint64_t b = to_bits(x);
    double m = from_bits((b & MANT_MASK) | ((uint64_t)EXP_BIAS << 52));
    struct dd num = {0.0, 0.0};

    *k = (int32_t)(b >> 52) - EXP_BIAS;
    if (m > SQRT2) {
        m *= 0.5;
        *k += 1;
    }
    num.hi = m - 1.0;
    return dd_div(num, two_sum(m, 1.0));
}

/* k ln2 + 2 (head + rest) */
static struct dd log_assemble(int32_t k, double head, double rest)
{
    struct dd t = two_sum((double)k * LN2.hi, 2.0 * head);

    return quick_sum(t.hi, t.lo + ((double)k * LN2.lo + 2.0 * rest));
}

/* log x to about 2^-65 of its size; x as for log_reduce. */
static struct dd log_wide(double x)
{
    int32_t k;
    struct dd s = log_reduce(x, &k);
    struct dd z = dd_mul(s, s);
    struct dd cubic = dd_mul(s, dd_mul(z, THIRD));
    struct dd head = quick_sum(s.hi, cubic.hi);
    double rest = s.hi * (z.hi * z.hi) * POLY(LOG_C, z.hi);

    return log_assemble(k, head.hi, head.lo + (s.lo + (cubic.lo + rest)));
}

double SPH_NAME(log)(double x)
{
    int32_t k;
    struct dd s;
    double z;

    if (is_nan(x)) {
        return from_bits(NAN_BITS);
    }
    if (x < DBL_MIN) {
        return -DBL_MAX;
    }
    if (!is_finite(x)) {
        return x;
    }
    s = log_reduce(x, &k);
    z = s.hi * s.hi;
    return log_assemble(k, s.hi, s.lo + s.hi * z * (THIRD.hi + z * POLY(LOG_C, z))).hi;
}

double SPH_NAME(pow)(double x, double y)
{
    double ay = magnitude(y);
    struct dd l, p;

    if (is_nan(x) || is_nan(y)) {
        return from_bits(NAN_BITS);
    }
    /* |log x| < 745, so a smaller y leaves the result within 2^-54 of 1 */
    if (x == 1.0 || ay < 0x1p-64) {
        return 1.0;
    }
    if (x <= -DBL_MIN) {
        return 0.0;
    }
    if (x < DBL_MIN || !is_finite(x)) {
        return (x < DBL_MIN) == (y < 0.0) ? from_bits(INF_BITS) : 0.0;
    }
    /* |log x| > 2^-54 here, so a larger y is past every limit, and the products below are safe */
    if (ay > 0x1p70) {
        return (x > 1.0) == (y > 0.0) ? from_bits(INF_BITS) : 0.0;
    }
    l = log_wide(x);
    p = two_prod(y, l.hi);
    p = quick_sum(p.hi, p.lo + y * l.lo);
    return exp_join(p.hi, p.lo);
}

/* ---- arc tangent ---- */

/* (atan u - u) / u^3 in u^2 for |u| <= 1/4; fit error 2^-55.7 of atan u */
static const double ATAN_C[8] = {
    -0x1.5555555555550p-2, 0x1.999999999432bp-3, -0x1.2492491d772abp-3, 0x1.c71c6aa40984bp-4,
    -0x1.745b535df8b1ap-4, 0x1.3ad6b41152d7bp-4, -0x1.0c76e1eb32e93p-4, 0x1.832cd1a9f7186p-5,
};
/* atan of 0, 1/2 and 1 */
static const struct dd ATAN_AT[3] = {
    {0.0, 0.0},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

/*
 * base + side * atan(small/big), 0 < small <= big. with c the nearest of 0, 1/2 and 1,
 * atan(small/big) = atan c + atan u and u = (small - c big) / (big + c small); the numerator
 * is exact since small and c big are within a factor of two of each other.
 */
static double atan_from(struct dd base, double side, double small, double big)
{
    int i = small > 0.75 * big ? 2 : (small > 0.25 * big ? 1 : 0);
    double c = 0.5 * (double)i;
    struct dd num = {side * (small - c * big), 0.0};
    struct dd u = dd_div(num, two_sum(big, c * small));
    double z = u.hi * u.hi;
    struct dd k = two_sum(base.hi, side * ATAN_AT[i].hi);
    struct dd t = two_sum(k.hi, u.hi);

    k.lo += base.lo + side * ATAN_AT[i].lo;
    return t.hi + (t.lo + (k.lo + (u.lo + u.hi * z * POLY(ATAN_C, z))));
}

double SPH_NAME(atan2)(double y, double x)
{
    double ay = magnitude(y), ax = magnitude(x);
    int steep = ay > ax;
    int left = (to_bits(x) & SIGN_BIT) != 0;
    double big = steep ? ay : ax, small = steep ? ax : ay;
    double scale;
    struct dd base = {0.0, 0.0};

    if (!is_finite(x) || !is_finite(y)) {
        return from_bits(NAN_BITS);
    }
    if (steep || left) {
        /* pi/2 or pi, exact multiples of one constant */
        base.hi = steep ? PI_HALF.hi : 2.0 * PI_HALF.hi;
        base.lo = steep ? PI_HALF.lo : 2.0 * PI_HALF.lo;
    }
    if (small == 0.0) {
        return with_sign(base.hi, y);
    }
    /* leaves big below 2^996, where splitting it for products overflows, and small above
     * 2^-900, where their low parts underflow, unless the quotient itself is flushed */
    scale = big > 0x1p500 ? 0x1p-300 : 0x1p400;
    big *= scale;
    small *= scale;
    return with_sign(magnitude(atan_from(base, steep == left ? 1.0 : -1.0, small, big)), y);
}

/* ---- generator ---- */

/* multiplier of the underlying congruential generator (knuth's mmix, as o'neill uses it) */
#define PCG_MULTIPLIER UINT64_C(6364136223846793005)

void SPH_NAME(rng_seed)(sph_rng *rng, uint64_t seed, uint64_t stream)
{
    rng->s[0] = 0;
    rng->s[1] = (stream << 1) | 1u;
    (void)SPH_NAME(rng_u32)(rng);
    rng->s[0] += seed;
    (void)SPH_NAME(rng_u32)(rng);
}

uint32_t SPH_NAME(rng_u32)(sph_rng *rng)
{
    uint64_t old = rng->s[0];
    uint32_t folded = (uint32_t)(((old >> 18) ^ old) >> 27);
    uint32_t turn = (uint32_t)(old >> 59);

    rng->s[0] = old * PCG_MULTIPLIER + rng->s[1];
    return (folded >> turn) | (folded << ((32u - turn) & 31u));
}

double SPH_NAME(rng_uniform)(sph_rng *rng)
{
    /* two statements: the order of the steps must not be left to the compiler */
    uint32_t upper = SPH_NAME(rng_u32)(rng) >> 5;
    uint32_t lower = SPH_NAME(rng_u32)(rng) >> 6;

    return ((double)upper * 0x1p26 + (double)lower) * 0x1p-53;
}

double SPH_NAME(rng_normal)(sph_rng *rng)
{
    const double two_pi = 4.0 * PI_HALF.hi;
    double u = 1.0 - SPH_NAME(rng_uniform)(rng); /* in (0, 1], so that the logarithm exists */
    double v = SPH_NAME(rng_uniform)(rng);

    return __builtin_sqrt(-2.0 * SPH_NAME(log)(u)) * SPH_NAME(cos)(two_pi * v);
}
