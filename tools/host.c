/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* host.c: messages, arguments and files that are read (see host.h). */
#include "host.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const char *command = "";

void host_command(const char *name) { command = name; }

static void say(const char *format, va_list args)
{
    fflush(stdout);
    fprintf(stderr, "sph%s%s: ", *command ? " " : "", command);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
}

int host_no(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(format, args);
    va_end(args);
    return HOST_NO;
}

int host_usage(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(format, args);
    va_end(args);
    fprintf(stderr, "try: sph %s%s--help\n", command, *command ? " " : "");
    return HOST_USAGE;
}

int host_end(int code)
{
    errno = 0;
    if (!fflush(stdout) && !ferror(stdout))
        return code;
    /* a buffer that failed before keeps its error, not the reason */
    return host_no("cannot write standard output: %s", errno ? strerror(errno) : "an earlier piece of it failed");
}

bool host_help(int argc, char **argv, const char *text)
{
    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--help") || !strcmp(argv[i], "-h")) {
            fputs(text, stdout);
            return true;
        }
    return false;
}

/* ---- numbers ---- */

static bool parse_double(const char *text, const char *end, double *out)
{
    char *stop;
    if (*text == '\0' || *text == ' ')
        return false;
    *out = strtod(text, &stop);
    return stop == end && isfinite(*out);
}

bool host_number(const char *name, const char *text, double min, double max, double *out)
{
    double v;
    if (!parse_double(text, text + strlen(text), &v)) {
        host_usage("%s=%s: must be a number", name, text);
        return false;
    }
    if (v < min || v > max) {
        host_usage("%s=%s: must be %g .. %g", name, text, min, max);
        return false;
    }
    *out = v;
    return true;
}

bool host_count(const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *out)
{
    char *stop;
    errno = 0;
    unsigned long long v = strtoull(text, &stop, 10);
    if (*text < '0' || *text > '9' || *stop || errno || v < min || v > max) {
        host_usage("%s=%s: must be a whole number %llu .. %llu", name, text, (unsigned long long)min,
                   (unsigned long long)max);
        return false;
    }
    *out = v;
    return true;
}

bool host_numbers(const char *name, const char *text, uint32_t n, double *out)
{
    const char *at = text;
    for (uint32_t i = 0; i < n; i++) {
        const char *end = strchr(at, ',');
        if ((end == NULL) != (i + 1 == n) || !parse_double(at, end ? end : at + strlen(at), &out[i])) {
            host_usage("%s=%s: must be %u number%s", name, text, n, n > 1 ? "s separated by commas" : "");
            return false;
        }
        at = end ? end + 1 : at;
    }
    return true;
}

/* ---- arguments ---- */

bool host_split(const char *arg, char *name, size_t size, const char **value)
{
    const char *eq = strchr(arg, '=');
    size_t n = eq ? (size_t)(eq - arg) : 0;
    if (!eq || n == 0 || n >= size || memchr(arg, '/', n) || memchr(arg, '.', n))
        return false;
    memcpy(name, arg, n);
    name[n] = '\0';
    *value = eq + 1;
    return true;
}

static void list_names(const char *const *names)
{
    fputs("allowed:", stderr);
    for (; *names; names++)
        fprintf(stderr, " %s", *names);
    fputc('\n', stderr);
}

bool host_given_before(char **argv, int i, const char *name)
{
    char own[64];
    const char *value;
    for (int k = 1; k < i; k++)
        if (host_split(argv[k], own, sizeof own, &value) && !strcmp(own, name)) {
            host_usage("%s is given twice: %s and %s", name, argv[k], argv[i]);
            return true;
        }
    return false;
}

int host_known_options(int argc, char **argv, const char *const *known)
{
    int files = 0;
    for (int i = 1; i < argc; i++) {
        char name[64];
        const char *value;
        if (host_split(argv[i], name, sizeof name, &value)) {
            const char *const *k = known;
            while (*k && strcmp(*k, name))
                k++;
            if (*k && !host_given_before(argv, i, name))
                continue;
            if (!*k) {
                host_usage("unknown option %s", name);
                list_names(known);
            }
            return -1;
        }
        if (argv[i][0] == '-' && argv[i][1]) {
            host_usage("unknown option %s (options are written NAME=VALUE)", argv[i]);
            return -1;
        }
        /* files move to the front, in order */
        char *file = argv[i];
        files++;
        for (int j = i; j > files; j--)
            argv[j] = argv[j - 1];
        argv[files] = file;
    }
    return files;
}

const char *host_option(int argc, char **argv, const char *name)
{
    const char *found = NULL, *value;
    char own[64];
    for (int i = 1; i < argc; i++)
        if (host_split(argv[i], own, sizeof own, &value) && !strcmp(own, name))
            found = value;
    return found;
}

int host_choice(const char *name, const char *text, const char *const *choices)
{
    for (int i = 0; choices[i]; i++)
        if (!strcmp(choices[i], text))
            return i;
    host_usage("%s=%s: not a choice", name, text);
    list_names(choices);
    return -1;
}

/* ---- files ---- */

void *host_alloc(size_t bytes) { return host_realloc(NULL, bytes); }

void *host_realloc(void *p, size_t bytes)
{
    void *q = realloc(p, bytes ? bytes : 1);
    if (!q) {
        host_no("out of memory (%zu bytes)", bytes);
        exit(HOST_NO);
    }
    return q;
}

void host_put_name(FILE *f, const char *name)
{
    for (; *name; name++)
        fputc((unsigned char)*name < ' ' || *name == 0x7f ? '?' : *name, f);
}

unsigned char *host_read(const char *name, size_t *size)
{
    bool in = !strcmp(name, "-");
    FILE *f = in ? stdin : fopen(name, "rb");
    unsigned char *p = NULL;
    size_t n = 0, room = 0;
    if (!f) {
        host_no("cannot read %s: %s", name, strerror(errno));
        return NULL;
    }
    do {
        if (n + 1 >= room)
            p = host_realloc(p, room = room ? room * 2 : 65536);
        n += fread(p + n, 1, room - n - 1, f);
    } while (!feof(f) && !ferror(f));
    bool bad = ferror(f) != 0;
    if (!in)
        fclose(f);
    if (bad) {
        host_no("cannot read %s: %s", name, strerror(errno));
        free(p);
        return NULL;
    }
    p[n] = '\0';
    *size = n;
    return p;
}
