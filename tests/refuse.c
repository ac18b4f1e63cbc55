/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* refuse.c: prints what sph_init says of this build's arithmetic: "ok", or the name of what is wrong (refuse.sh). With
   -DREFUSE_FLUSH it first tells the processor to flush subnormal numbers to zero, with -DREFUSE_ROUND=... to round in
   another way. */
#include <stdio.h>

#include "cases.h"

#ifdef REFUSE_ROUND /* a value of x86's control register: 0x3f80 down, 0x5f80 up, 0x7f80 towards zero */
static void flush_subnormals(void) { __builtin_ia32_ldmxcsr(REFUSE_ROUND); }
#elif defined(REFUSE_FLUSH)
#if defined(__x86_64__) || defined(__i386__)
static void flush_subnormals(void) { __builtin_ia32_ldmxcsr(0x9fc0); } /* FTZ and DAZ, all exceptions masked */
#elif defined(__aarch64__)
static void flush_subnormals(void) { __asm__ volatile("msr fpcr, %0" ::"r"((uint64_t)1 << 24)); }
#else
#error "how is flush to zero turned on here?"
#endif
#else
static void flush_subnormals(void) {}
#endif

static SPH_ARENA(arena, CASE_ARENA_BYTES);

int main(void)
{
    sph_sim *sim;
    sph_report why;
    const sph_config c = case_config(&bits_cases[0]);
    flush_subnormals();
    sph_status st = sph_init(&sim, &c, arena, sizeof arena, &why);
    if (!st)
        st = case_build(sim, &bits_cases[0]);
    if (st == SPH_ARITHMETIC)
        printf("%s; wanted: %s\n", why.what, why.allowed);
    else
        printf("%s\n", st == SPH_OK ? "ok" : sph_status_text(st));
    return 0;
}
