/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cortexm.h: what a bare Cortex-M provides to the kernel: a clock, and to the programs around it text, an exit code and
   the depth of the stack. cortexm.c starts the machine and calls main; cortexm.ld says where things lie.

   Text and exit code go through semihosting, so a debugger or an emulator must be there to take them. */
#ifndef PORT_CORTEXM_H
#define PORT_CORTEXM_H

#include <stddef.h>
#include <stdint.h>

/* Clocks a second of the processor, which is what SysTick counts. All the boards of port/targets.txt have 25 MHz. */
#ifndef CORTEXM_HZ
#define CORTEXM_HZ 25000000u
#endif

/* Starts SysTick: an interrupt every `period` processor clocks, 2 .. 2^24. Counts from 0. */
void cortexm_start(uint32_t period);
void cortexm_stop(void);       /* no more interrupts; the clock stands still */
uint64_t cortexm_clocks(void); /* processor clocks since the start */
uint32_t cortexm_ticks(void);  /* periods since the start */
void cortexm_wait(void);       /* sleeps until the next interrupt */

/* member of sph_port: ns since the start. In qemu with `-icount shift=0` every instruction takes 1 ns, so there it
   counts instructions, 40 at a time. ctx is not used. */
uint64_t cortexm_clock(void *ctx);

/* The stack was painted before main. How much of it was ever used, and how much there is (bytes). */
size_t cortexm_stack_used(void);
size_t cortexm_stack_bytes(void);
size_t cortexm_stack_here(void); /* how much of it the caller and its callers hold */
void cortexm_stack_paint(void); /* paints afresh what is not in use now */

size_t cortexm_static_bytes(void); /* .data and .bss */

_Noreturn void cortexm_exit(int code);

#endif
