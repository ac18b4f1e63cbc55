/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stdio.h: a printf that knows %s, %c, %d, %lx and %08lx, which is what the golden runner prints (print.c). */
#ifndef PORT_WASM_STDIO_H
#define PORT_WASM_STDIO_H

int printf(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
