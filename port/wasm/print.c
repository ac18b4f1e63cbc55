/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* print.c: the small printf of stdio.h; the bytes go to the function `put` that the embedder gives (run.mjs). */
#include "stdio.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

__attribute__((import_module("env"), import_name("put"))) void put(const char *bytes, size_t n);

static int put_text(const char *s)
{
    size_t n = 0;
    while (s[n])
        n++;
    put(s, n);
    return (int)n;
}

/* at least `width` digits, filled up with zeros */
static int put_number(unsigned long v, unsigned base, int width)
{
    char digits[3 * sizeof v];
    int n = 0;
    do {
        digits[(int)sizeof digits - ++n] = "0123456789abcdef"[v % base];
        v /= base;
    } while (v || (n < width && n < (int)sizeof digits));
    put(digits + sizeof digits - n, (size_t)n);
    return n;
}

/* one conversion, from behind the % on; *f is moved behind it */
static int convert(const char **f, va_list *args)
{
    int width = 0;
    bool wide = false;
    for (; **f >= '0' && **f <= '9'; ++*f)
        width = 10 * width + (**f - '0');
    for (; **f == 'l'; ++*f)
        wide = true;
    const char kind = *(*f)++;
    if (kind == 's')
        return put_text(va_arg(*args, const char *));
    if (kind == 'x')
        return put_number(wide ? va_arg(*args, unsigned long) : va_arg(*args, unsigned), 16, width);
    const int v = va_arg(*args, int);
    if (kind == 'c') {
        const char c = (char)v;
        put(&c, 1);
        return 1;
    }
    if (v < 0)
        put("-", 1);
    return (v < 0) + put_number(v < 0 ? 0 - (unsigned long)v : (unsigned long)v, 10, width);
}

int printf(const char *format, ...)
{
    va_list args;
    int n = 0;
    va_start(args, format);
    for (const char *f = format; *f;) {
        if (*f == '%') {
            f++;
            n += convert(&f, &args);
            continue;
        }
        put(f++, 1);
        n++;
    }
    va_end(args);
    return n;
}
