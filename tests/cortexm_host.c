/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cortexm_host.c: answers port/cortexm.h on the machine that builds, so that a program for bare metal can be run there
   and its hashes compared. Nothing is measured: time stands still but for one tick at every wait, and no stack is
   used. */
#include "port/cortexm.h"

#include <stdlib.h>

static uint32_t ticks, clocks_a_tick = 1;

void cortexm_start(uint32_t period) { clocks_a_tick = period; }
void cortexm_stop(void) {}
uint64_t cortexm_clocks(void) { return (uint64_t)ticks * clocks_a_tick; }
uint32_t cortexm_ticks(void) { return ticks; }
void cortexm_wait(void) { ticks++; }
uint64_t cortexm_clock(void *ctx)
{
    (void)ctx;
    return cortexm_clocks() * (1000000000u / CORTEXM_HZ);
}
size_t cortexm_stack_used(void) { return 0; }
size_t cortexm_stack_bytes(void) { return 0; }
size_t cortexm_stack_here(void) { return 0; }
void cortexm_stack_paint(void) {}
size_t cortexm_static_bytes(void) { return 0; }
_Noreturn void cortexm_exit(int code) { exit(code); }
