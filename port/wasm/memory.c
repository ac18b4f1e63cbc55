/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* memory.c: memcpy, memmove and memset for wasm. no_builtin, or the compiler would turn the loops into calls of the
   functions that they are. */
#include "string.h"

#define PLAIN __attribute__((no_builtin))

PLAIN void *memcpy(void *to, const void *from, size_t n)
{
    unsigned char *d = to;
    const unsigned char *s = from;
    for (size_t i = 0; i < n; i++)
        d[i] = s[i];
    return to;
}

PLAIN void *memmove(void *to, const void *from, size_t n)
{
    unsigned char *d = to;
    const unsigned char *s = from;
    if ((size_t)d - (size_t)s >= n) /* also where d is below s: the difference wraps */
        return memcpy(to, from, n);
    for (size_t i = n; i-- > 0;)
        d[i] = s[i];
    return to;
}

PLAIN void *memset(void *to, int byte, size_t n)
{
    unsigned char *d = to;
    for (size_t i = 0; i < n; i++)
        d[i] = (unsigned char)byte;
    return to;
}
