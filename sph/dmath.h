/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/*
 * Elementary functions and a random generator that return the same bits on every machine.
 *
 * The functions use only + - * / and the square root of IEEE 754 binary64 in
 * round-to-nearest-even, plus integer operations, so the result depends on neither the C
 * library, the compiler, the byte order nor the presence of a floating-point unit. Three
 * things are asked of the build: no -ffast-math, no fused multiply-add (-ffp-contract=off),
 * and no x87 arithmetic (-msse2 -mfpmath=sse on 32-bit x86).
 *
 * Rules common to all functions:
 *   - arguments and results are in radians where they are angles and unitless elsewhere;
 *   - an argument smaller in magnitude than DBL_MIN (2^-1022) counts as zero of its sign, and
 *     no result is ever subnormal: such a result becomes zero;
 *   - finite arguments never give a NaN; overflow of exp and pow gives infinity;
 *   - a NaN argument gives the quiet NaN with the bits 0x7ff8000000000000.
 *
 * Errors are the largest seen against correctly rounded references (MPFR) over two million
 * arguments for each range named, in units in the last place (ulp) of the result; a correctly
 * rounded function would show 0.5.
 */
#ifndef SPH_DMATH_H
#define SPH_DMATH_H

#include <stdint.h>

#include "name.h"

#define sph_sin SPH_NAME(sin)
#define sph_cos SPH_NAME(cos)
#define sph_exp SPH_NAME(exp)
#define sph_log SPH_NAME(log)
#define sph_pow SPH_NAME(pow)
#define sph_tanh SPH_NAME(tanh)
#define sph_atan2 SPH_NAME(atan2)
#define sph_rng_seed SPH_NAME(rng_seed)
#define sph_rng_u32 SPH_NAME(rng_u32)
#define sph_rng_uniform SPH_NAME(rng_uniform)
#define sph_rng_normal SPH_NAME(rng_normal)

/*
 * Returns the sine of x radians. The error bound holds for every finite x: below 2^20 the
 * reduction subtracts a multiple of pi/2 held in four parts, above it multiplies by as many
 * bits of 2/pi as the exponent needs (slower, equally accurate). Odd to the bit; sin(-0) is
 * -0. Infinite x gives the quiet NaN. Largest error seen: 0.86 ulp for |x| <= DBL_MAX.
 */
double SPH_NAME(sin)(double x);

/*
 * Returns the cosine of x radians. Even to the bit; reduction, range and infinite x as for
 * sin. Largest error seen: 0.86 ulp for |x| <= DBL_MAX.
 */
double SPH_NAME(cos)(double x);

/*
 * Returns e to the power x. Above about 709.7827 the result is infinity, below about
 * -708.3964, where it would be subnormal, it is 0; exp(0) is exactly 1. Largest error seen:
 * 0.62 ulp for -708.39 <= x <= 709.78.
 */
double SPH_NAME(exp)(double x);

/*
 * Returns the natural logarithm of x. For x <= 0, and for x below DBL_MIN, which counts as
 * zero, the result is -DBL_MAX, a finite stand-in far below every true logarithm; log(1) is
 * exactly +0; log of infinity is infinity. Largest error seen: 0.54 ulp for
 * DBL_MIN <= x <= DBL_MAX.
 */
double SPH_NAME(log)(double x);

/*
 * Returns x to the power y for x >= 0 and any y; the error bound holds for every result that
 * neither overflows to infinity nor underflows to 0. pow(x, 0) and pow(1, y) are exactly 1,
 * pow(0, y) is 0 for y > 0 and infinity for y < 0. Negative x is outside the domain and gives
 * 0, also for whole y. Largest error seen: 0.77 ulp for results from DBL_MIN to DBL_MAX, x and y
 * anywhere that allows them (0.62 for 0.8 <= x <= 1.2, y = 7).
 */
double SPH_NAME(pow)(double x, double y);

/*
 * Returns the hyperbolic tangent of x, never beyond -1 to 1. Odd to the bit; exactly +-1 from
 * |x| = 20 on and for infinite x. Largest error seen: 0.77 ulp for |x| <= 22.
 */
double SPH_NAME(tanh)(double x);

/*
 * Returns the angle in radians, from -pi to pi, of the point (x, y) seen from the origin.
 * Zeros follow the C standard: atan2(+-0, x) is +-0 for x > 0 or x = +0 and +-pi for x < 0 or
 * x = -0. Odd in y to the bit. An infinite argument gives the quiet NaN. Largest error seen:
 * 0.75 ulp for DBL_MIN <= |x|, |y| <= DBL_MAX.
 */
double SPH_NAME(atan2)(double y, double x);

/*
 * State of one random stream: s[0] is the 64-bit state of the congruential generator, s[1] its
 * odd increment, which selects the stream. Copying the two words as integers saves and
 * restores a stream exactly.
 *
 * The algorithm is PCG-XSH-RR 64/32: M. E. O'Neill, "PCG: A Family of Simple Fast
 * Space-Efficient Statistically Good Algorithms for Random Number Generation", Harvey Mudd
 * College report HMC-CS-2014-0905, 2014. The period is 2^64 for each stream. It is not fit for
 * cryptography.
 */
typedef struct {
    uint64_t s[2];
} sph_rng;

/*
 * Starts a generator. Any seed is good; stream picks one of 2^63 sequences (its top bit is
 * ignored).
 */
void SPH_NAME(rng_seed)(sph_rng *rng, uint64_t seed, uint64_t stream);

/* Returns 32 uniformly distributed bits and advances the generator by one step. */
uint32_t SPH_NAME(rng_u32)(sph_rng *rng);

/*
 * Returns a multiple of 2^-53, uniform in [0, 1): two steps, of which the first gives the upper
 * 27 bits and the second the lower 26.
 */
double SPH_NAME(rng_uniform)(sph_rng *rng);

/*
 * Returns a normally distributed number of mean 0 and variance 1, never beyond +-8.6. Always
 * takes four steps (Box-Muller, G. E. P. Box and M. E. Muller, 1958, cosine branch only), so
 * the state alone says where the stream is. Uses the compiler's square root, which some
 * targets take from their C library; IEEE 754 fixes its result to the bit.
 */
double SPH_NAME(rng_normal)(sph_rng *rng);

#endif
