/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* arithmetic.h: whether compiler and machine do the arithmetic that the rule of same bits needs. What a compiler says
   of itself is an error when an object is compiled (here and in lanes.h); what it does not say, each object shows when
   a simulation is made: SPH_OBJECT leaves a record in it with its knobs and a function that computes a few sums.
   Without knob OBJECT_PROBES (off by default where code is to be small: -Os) only arithmetic.c looks. */
#ifndef SPH_ARITHMETIC_H
#define SPH_ARITHMETIC_H

#include "sph.h"

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "sph must not be built with -ffinite-math-only: it changes bits"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "sph must not be built with -fassociative-math, -freciprocal-math, -fno-signed-zeros: they change bits"
#endif
_Static_assert(sizeof 1.0 == sizeof(double), "sph must not be built with -fsingle-precision-constant");

/* every object of the kernel: sph/NAME.c */
#define SPH_OBJECTS(X)                                                                                             \
    X(adami) X(arithmetic) X(bodies) X(boundary) X(carry) X(columns) X(config) X(correction) X(crossing)           \
    X(damage) X(damper) X(damping) X(density) X(density_gradient) X(digest) X(dmath) X(dump) X(edges) X(energy)   \
    X(eos) X(evening)                                                                                              \
    X(faces) X(factors) X(fields) X(finish) X(flaws) X(flow) X(forces) X(format) X(gradient) X(grid) X(groups)     \
    X(hash) X(hourglass) X(init) X(initial) X(inspect) X(integrators) X(kernels) X(layers) X(layout) X(mirror)     \
    X(mls) X(motions) X(move) X(neighbours) X(normalised) X(openings) X(options) X(outline) X(polyline)            \
    X(powers) X(probes) X(quadrature) X(reading) X(records) X(reference) X(report) X(restore) X(run) X(settle)     \
    X(setup) X(shapes) X(shear) X(shifting) X(smoothing) X(sort) X(sponge) X(stabilised) X(state) X(stream)        \
    X(smoothing_length)                                                                                            \
    X(stress) X(sweep) X(threads) X(tiles) X(timestep) X(totals) X(validate) X(yield)

/* what a probe computes with; volatile, so that no compiler can do it itself */
typedef struct sph_operands {
    sph_real one, e, small, zero, third; /* 1, the least e with 1 + e > 1, e/4, -0, 41 */
    double d_one, d_e, d_small, d_zero, d_third; /* the same in double; 49 */
} sph_operands;

/* what may be wrong, as bits; their texts: arithmetic.c */
enum { SPH_CONTRACTS = 1, SPH_REORDERS = 2, SPH_TAKES_RECIPROCALS = 4, SPH_DROPS_SIGNS = 8 };

/* (1 + e)(1 - e) = 1 - e^2 rounds to 1; contracted, the sum with -1 keeps -e^2. (1 + e/4) - 1 is 0 unless the sums are
   taken in another order. C (1/C) is not 1 for 41 in float and 49 in double. -0 + 0 is 0. */
#define SPH_PROBE_SUMS(real, one, e, small, zero, third, C)                                                           \
    const real a = (one), up = a + (e), down = a - (e), s = (small), z = (zero), t = (third);                         \
    wrong |= up * down + -a != 0 ? SPH_CONTRACTS : 0;                                                                 \
    wrong |= (a + s) - a != 0 ? SPH_REORDERS : 0;                                                                     \
    wrong |= t / (real)(C) != 1 ? SPH_TAKES_RECIPROCALS : 0;                                                          \
    wrong |= a / (z + (real)0) < 0 ? SPH_DROPS_SIGNS : 0;

static inline __attribute__((unused)) uint32_t sph_probe_real(const volatile sph_operands *v)
{
    uint32_t wrong = 0;
    SPH_PROBE_SUMS(sph_real, v->one, v->e, v->small, v->zero, v->third, 41)
    return wrong;
}
static inline __attribute__((unused)) uint32_t sph_probe_double(const volatile sph_operands *v)
{
    uint32_t wrong = 0;
    SPH_PROBE_SUMS(double, v->d_one, v->d_e, v->d_small, v->d_zero, v->d_third, 49)
    return wrong;
}
static __attribute__((noinline, unused)) uint32_t sph_probe_here(const volatile sph_operands *v)
{
    return (SPH_DOUBLE ? 0 : sph_probe_real(v)) | sph_probe_double(v);
}

/* knobs in the order of their list, and how each is set where this is compiled */
enum {
#define SPH_KNOB_PLACE(name, needs) SPH_PLACE_OF_##name,
    SPH_KNOBS(SPH_KNOB_PLACE)
#undef SPH_KNOB_PLACE
    SPH_KNOB_COUNT
};
#define SPH_KNOB_SET(name, needs) (SPH_WITH_##name) != 0,
#define SPH_KNOBS_HERE {SPH_KNOBS(SPH_KNOB_SET)}

typedef struct sph_object {
    const char *allowed; /* the words of a refusal, with the object's name */
    uint8_t knobs[SPH_KNOB_COUNT];
    uint32_t (*probe)(const volatile sph_operands *v);
} sph_object;

#ifdef __APPLE__
#define SPH_MAY_LACK __attribute__((weak_import))
#else
#define SPH_MAY_LACK __attribute__((weak)) /* an object that is not linked is not asked */
#endif
#if SPH_WITH_OBJECT_PROBES
#define SPH_OBJECT_DECLARED(name) extern const sph_object SPH_NAME(object_##name##_) SPH_MAY_LACK;
SPH_OBJECTS(SPH_OBJECT_DECLARED)
#undef SPH_OBJECT_DECLARED
#define SPH_OBJECT(name)                                                                                              \
    const sph_object SPH_NAME(object_##name##_) = {"IEEE 754 as written and the knobs of all others, in " #name ".c", \
                                                   SPH_KNOBS_HERE, sph_probe_here};
#else
#define SPH_OBJECT(name)
#endif

/* the name of what is wrong, or null; *allowed: what would be right, and in which object */
#define sph_broken_arithmetic SPH_NAME(broken_arithmetic_)
const char *sph_broken_arithmetic(const char **allowed);

#endif
