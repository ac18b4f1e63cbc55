/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* arithmetic.c: finds contraction, excess precision, flush to zero, other rounding modes and objects that were built
   unlike the others, at run time. */
#include "arithmetic.h"
#include "lanes.h" /* refuses -ffast-math and excess precision where the compiler says so */
#include "sph.h"

SPH_OBJECT(arithmetic)

#ifndef SPH_NO_PROBE /* only to show with tests/firstdiff.sh what a broken build does */
#define SPH_NO_PROBE 0
#endif

/* ---- the machine ---- */

/* operands come from volatile memory, so that no compiler can do the sums itself; here the sums go back to it, so that
   no register is wider */
static bool rounds_to_nearest(void)
{
    volatile sph_real one = 1, e = SPH_DOUBLE ? (sph_real)2.220446049250313e-16 : (sph_real)1.1920929e-7;
    volatile sph_real up = one + e, quarter = e * (sph_real)0.25, sum;
    sum = one + quarter; /* up: 1 + e; down: -1 - e for the negative one; towards zero: 1 where 1 + e is nearer */
    bool nearest = sum == one;
    sum = -one - quarter;
    nearest &= sum == -one;
    sum = one + quarter * 3;
    return nearest && sum == up;
}

static const char *broken_machine(void)
{
    volatile sph_real v_one = 1, v_half = (sph_real)0.5;
    volatile sph_real v_eps = SPH_DOUBLE ? (sph_real)2.220446049250313e-16 : (sph_real)1.1920929e-7;
    volatile sph_real v_least = SPH_DOUBLE ? (sph_real)2.2250738585072014e-308 : (sph_real)1.17549435e-38f;
    const sph_real one = v_one, e = v_eps, up = one + e, down = one - e, half = e * v_half;
    if (SPH_WITH_OBJECT_PROBES && !rounds_to_nearest())
        return "a rounding mode other than to nearest";
    /* (1 + e/2) + e/2 is 1 twice rounded, 1 + e in excess precision */
    if (one + half + half != 1)
        return "excess precision (use SSE2 arithmetic on 32-bit x86)";
    /* see SPH_PROBE_SUMS; in excess precision that would be wrong as well, so it comes first */
    if (up * down + -one != 0)
        return "contraction of a*b+c (build with -ffp-contract=off)";
    if (v_least * v_half == 0)
        return "flush to zero of subnormal numbers";
    return NULL;
}

/* ---- the objects ---- */

#if SPH_WITH_OBJECT_PROBES
static const char *const knob_names[] = {
#define NAME(name, needs) "SPH_WITH_" #name,
    SPH_KNOBS(NAME)
#undef NAME
};

static const char *broken_object(const sph_object *o)
{
    static const char *const texts[] = {"contraction of a*b+c (build with -ffp-contract=off)",
                                        "sums in another order than written (-fassociative-math, -ffast-math)",
                                        "reciprocals for divisions (-freciprocal-math, -ffast-math)",
                                        "zeros that lose their sign (-fno-signed-zeros, -ffast-math)"};
    const volatile sph_operands v = {1,
                                     SPH_DOUBLE ? (sph_real)2.220446049250313e-16 : (sph_real)1.1920929e-7,
                                     SPH_DOUBLE ? (sph_real)5.551115123125783e-17 : (sph_real)2.98023224e-8,
                                     -(sph_real)0, 41,
                                     1, 2.220446049250313e-16, 5.551115123125783e-17, -0.0, 49};
    const uint64_t own[2] = SPH_KNOBS_HERE;
    for (uint32_t k = 0; k < SPH_KNOB_COUNT; k++)
        if ((o->knobs[k / 64] ^ own[k / 64]) >> k % 64 & 1)
            return knob_names[k];
    const uint32_t wrong = o->probe(&v);
    for (uint32_t k = 0; k < sizeof texts / sizeof *texts; k++)
        if (wrong >> k & 1)
            return texts[k];
    return NULL;
}

static const sph_object *const objects[] = {
#define OBJECT(name) &SPH_NAME(object_##name##_),
    SPH_OBJECTS(OBJECT)
#undef OBJECT
};

static const char *broken_objects(const char **allowed)
{
    const char *wrong = NULL;
    for (uint32_t k = 0; !wrong && k < sizeof objects / sizeof *objects; k++)
        if (objects[k] && (wrong = broken_object(objects[k])) != NULL)
            *allowed = objects[k]->allowed;
    return wrong;
}
#else
static const char *broken_objects(const char **allowed)
{
    (void)allowed;
    return NULL;
}
#endif

const char *sph_broken_arithmetic(const char **allowed)
{
    const char *wrong = SPH_NO_PROBE ? NULL : broken_machine();
    *allowed = "IEEE 754 as written";
    return wrong || SPH_NO_PROBE ? wrong : broken_objects(allowed);
}
