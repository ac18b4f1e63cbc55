/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* arithmetic.c: finds contraction, excess precision and flush to zero at run time. */
#include "arithmetic.h"
#include "lanes.h" /* refuses -ffast-math and excess precision where the compiler says so */
#include "sph.h"

#ifndef SPH_NO_PROBE /* only to show with tests/firstdiff.sh what a broken build does */
#define SPH_NO_PROBE 0
#endif

const char *sph_broken_arithmetic(void)
{
    /* the operands come from volatile memory, so that no compiler can do the sums itself */
    volatile sph_real v_one = 1, v_half = (sph_real)0.5;
    volatile sph_real v_eps = SPH_DOUBLE ? (sph_real)2.220446049250313e-16 : (sph_real)1.1920929e-7;
    volatile sph_real v_least = SPH_DOUBLE ? (sph_real)2.2250738585072014e-308 : (sph_real)1.17549435e-38f;
    const sph_real one = v_one, e = v_eps, up = one + e, down = one - e, half = e * v_half;
    if (SPH_NO_PROBE)
        return NULL;
    /* (1 + e/2) + e/2 is 1 twice rounded, 1 + e in excess precision */
    if (one + half + half != 1)
        return "excess precision (use SSE2 arithmetic on 32-bit x86)";
    /* (1+e)(1-e) = 1 - e^2 rounds to 1; contracted (or in excess precision, so that comes first), the sum with -1 keeps
       -e^2 */
    if (up * down + -one != 0)
        return "contraction of a*b+c (build with -ffp-contract=off)";
    if (v_least * v_half == 0)
        return "flush to zero of subnormal numbers";
    return NULL;
}
