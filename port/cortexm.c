/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cortexm.c: starts a bare Cortex-M3, M4, M7, M33 or M55 and gives it text, an exit code and a clock (see cortexm.h).
   Everything is there that a program needs beside a C library's own functions; with picolibc, printf works. */
#include "cortexm.h"

#include <stdio.h>
#include <string.h>

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))
#define CPACR REGISTER(0xe000ed88u) /* who may use coprocessors: 10 and 11 are the FPU */
#define SYST_CSR REGISTER(0xe000e010u)
#define SYST_RVR REGISTER(0xe000e014u)
#define SYST_CVR REGISTER(0xe000e018u)
#define ICSR REGISTER(0xe000ed04u)
#define ICSR_PENDSTSET (1u << 26) /* SysTick has come round and its interrupt was not taken yet */

#define PAINT 0x5f5f5f5fu

/* from cortexm.ld; only their addresses mean something */
extern uint32_t cortexm_stack_low[], cortexm_stack_high[];
extern uint32_t cortexm_data[], cortexm_data_end[], cortexm_bss[], cortexm_bss_end[];
extern const uint32_t cortexm_data_image[];

int main(void);
_Noreturn void cortexm_reset(void);
_Noreturn void cortexm_fault(void);
void cortexm_systick(void);

/* ---- semihosting ---- */

enum { SYS_WRITE0 = 4, SYS_EXIT_EXTENDED = 0x20 };
#define ADP_STOPPED_APPLICATION_EXIT 0x20026u

static int semihost(int operation, const void *argument)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

_Noreturn void cortexm_exit(int code)
{
    const uint32_t why[2] = {ADP_STOPPED_APPLICATION_EXIT, (uint32_t)code};
    fflush(stdout);
    semihost(SYS_EXIT_EXTENDED, why);
    for (;;)
        ;
}

/* Text is handed over by the line: a call for every letter would cost more than many a test. */
static char line[128];
static uint32_t line_length;

static int flush_line(FILE *file)
{
    (void)file;
    line[line_length] = 0;
    if (line_length)
        semihost(SYS_WRITE0, line);
    line_length = 0;
    return 0;
}

static int put_letter(char c, FILE *file)
{
    line[line_length++] = c;
    if (c == '\n' || line_length == sizeof line - 1)
        flush_line(file);
    return 0;
}

/* picolibc finds the streams by these names */
static FILE text = FDEV_SETUP_STREAM(put_letter, NULL, flush_line, _FDEV_SETUP_WRITE);
extern FILE *const stdout, *const stderr;
FILE *const stdout = &text;
FILE *const stderr = &text;

/* ---- clock ---- */

static volatile uint32_t ticks;

void cortexm_systick(void) { ticks = ticks + 1; }

void cortexm_start(uint32_t period)
{
    SYST_CSR = 0;
    ticks = 0;
    SYST_RVR = period - 1;
    SYST_CVR = 0;
    SYST_CSR = 7; /* processor clock, interrupt, on */
}

void cortexm_stop(void) { SYST_CSR = 0; }

uint32_t cortexm_ticks(void) { return ticks; }

uint64_t cortexm_clocks(void)
{
    const uint32_t period = SYST_RVR + 1;
    uint32_t whole, left;
    do { /* again if a period ended in between */
        whole = ticks;
        left = SYST_CVR;
    } while (whole != ticks || (ICSR & ICSR_PENDSTSET) != 0);
    /* the register holds 0 for the first clock of a period, then period - 1 and down */
    return (uint64_t)whole * period + (left ? period - left : 0);
}

uint64_t cortexm_clock(void *ctx)
{
    (void)ctx;
    return cortexm_clocks() * (1000000000u / CORTEXM_HZ);
}

void cortexm_wait(void) { __asm__ volatile("wfi" ::: "memory"); }

/* ---- memory ---- */

static uint32_t *stack_pointer(void)
{
    uint32_t *sp;
    __asm__ volatile("mov %0, sp" : "=r"(sp));
    return sp;
}

void cortexm_stack_paint(void)
{
    const volatile uint32_t *top = stack_pointer();
    for (volatile uint32_t *p = cortexm_stack_low; p < top; p++)
        *p = PAINT;
}

/* must have no frame of its own */
size_t cortexm_stack_here(void) { return (uintptr_t)cortexm_stack_high - (uintptr_t)stack_pointer(); }

size_t cortexm_stack_used(void)
{
    const size_t words = cortexm_stack_bytes() / sizeof(uint32_t);
    size_t clean = 0;
    while (clean < words && cortexm_stack_low[clean] == PAINT)
        clean++;
    return (words - clean) * sizeof(uint32_t);
}

size_t cortexm_stack_bytes(void) { return (uintptr_t)cortexm_stack_high - (uintptr_t)cortexm_stack_low; }

size_t cortexm_static_bytes(void)
{
    return ((uintptr_t)cortexm_data_end - (uintptr_t)cortexm_data) + ((uintptr_t)cortexm_bss_end -
        (uintptr_t)cortexm_bss);
}

/* ---- start ---- */

_Noreturn void cortexm_reset(void)
{
#ifdef __ARM_FP
    CPACR |= 0xfu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
    memcpy(cortexm_data, cortexm_data_image, (uintptr_t)cortexm_data_end - (uintptr_t)cortexm_data);
    memset(cortexm_bss, 0, (uintptr_t)cortexm_bss_end - (uintptr_t)cortexm_bss);
    cortexm_stack_paint();
    cortexm_exit(main());
}

_Noreturn void cortexm_fault(void)
{
    uint32_t exception;
    __asm__ volatile("mrs %0, ipsr" : "=r"(exception));
    semihost(SYS_WRITE0, exception == 3 ? "\ncortexm: hard fault (outside memory, or the stack is too small)\n"
                                        : "\ncortexm: an exception that nobody asked for\n");
    cortexm_exit(99);
}

/* first in memory: where the stack begins, then who handles reset, the exceptions 2 to 14, and SysTick */
typedef struct vector_table {
    const void *stack;
    void (*reset)(void);
    void (*fault[13])(void);
    void (*systick)(void);
} vector_table;

#define FAULT cortexm_fault
__attribute__((section(".vectors"), used)) static const vector_table vectors = {
    cortexm_stack_high,
    cortexm_reset,
    {FAULT, FAULT, FAULT, FAULT, FAULT, FAULT, FAULT, FAULT, FAULT, FAULT, FAULT, FAULT, FAULT},
    cortexm_systick,
};
