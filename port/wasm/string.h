/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* string.h: the three functions that the kernel asks of a machine; clang brings no such header for wasm. */
#ifndef PORT_WASM_STRING_H
#define PORT_WASM_STRING_H

#include <stddef.h>

void *memcpy(void *to, const void *from, size_t n);
void *memmove(void *to, const void *from, size_t n);
void *memset(void *to, int byte, size_t n);

#endif
