/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_diff.c: sph diff. Where two dumps, or two stage logs, begin to differ. Particles are matched by id, so the order
   of the arrays does not matter; values are compared bit by bit. */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph diff A B\n"
    "Compares two dumps: records first, then arrays, particles matched by id. For each array that differs: the\n"
    "first particle and its values, how many elements differ, and the largest difference.\n"
    "Or two stage logs, text files with lines `step pass hash`: tells the first stage that differs.\n"
    "Exit code 0: the same, 1: different or unreadable, 2: wrong usage.\n";

/* ---- dumps ---- */

static int compare_record(const dump_section *a, const dump_section *b)
{
    int differ = 0;
    dump_member m, o;
    if (a->count != b->count) {
        printf("%s: %llu rows, %llu rows\n", a->name, (unsigned long long)a->count, (unsigned long long)b->count);
        return 1;
    }
    for (uint32_t f = 0; dump_get_member(a, f, &m); f++) {
        if (!dump_find_member(b, m.name, &o) || o.comps != m.comps) {
            printf("%s.%s: only in the first, or of another shape\n", a->name, m.name);
            differ = 1;
            continue;
        }
        for (uint64_t row = 0; row < a->count; row++)
            for (uint32_t k = 0; k < m.comps; k++)
                if (dump_member_bits(a, &m, row, k) != dump_member_bits(b, &o, row, k)) {
                    printf("%s.%s, row %llu, component %u: %.17g, %.17g\n", a->name, m.name, (unsigned long long)row, k,
                           dump_member_value(a, &m, row, k), dump_member_value(b, &o, row, k));
                    differ = 1;
                }
    }
    return differ;
}

/* keeps the pairs of both that have the same id; returns how many, and tells who is alone */
static uint32_t match(dump_id_at *a, uint32_t na, dump_id_at *b, uint32_t nb)
{
    uint32_t i = 0, j = 0, n = 0, alone[2] = {0, 0}, first[2] = {0, 0};
    while (i < na || j < nb) {
        if (i < na && j < nb && a[i].id == b[j].id) {
            a[n] = a[i++];
            b[n++] = b[j++];
            continue;
        }
        const int only = j == nb || (i < na && a[i].id < b[j].id) ? 0 : 1;
        const uint32_t id = only ? b[j++].id : a[i++].id;
        if (alone[only]++ == 0)
            first[only] = id;
    }
    for (int k = 0; k < 2; k++)
        if (alone[k])
            printf("particles only in the %s: %u, the first has id %u\n", k ? "second" : "first", alone[k], first[k]);
    return n;
}

static int compare_array(const dump_file *d, const dump_section *a, const dump_section *b, const dump_id_at *ia,
                         const dump_id_at *ib, uint32_t n)
{
    uint64_t differ = 0;
    uint32_t first = 0, comp = 0, worst_id = 0;
    double worst = -1;
    for (uint32_t k = 0; k < a->comps; k++)
        for (uint32_t i = 0; i < n; i++) {
            if (dump_bits(a, k, ia[i].at) == dump_bits(b, k, ib[i].at))
                continue;
            if (differ++ == 0) {
                first = i;
                comp = k;
            }
            double gap = fabs(dump_value(a, k, ia[i].at) - dump_value(b, k, ib[i].at));
            if (!(gap <= worst)) {
                worst = gap;
                worst_id = ia[i].id;
            }
        }
    if (!differ)
        return 0;
    printf("%s: first at component %u of particle %u: %.17g, %.17g; %llu of %llu values differ, at most by %g %s "
           "(particle %u)\n",
           a->name, comp, ia[first].id, dump_value(a, comp, ia[first].at), dump_value(b, comp, ib[first].at),
           (unsigned long long)differ, (unsigned long long)n * a->comps, worst,
           strcmp(a->unit, "1") ? dump_unit(d, a->unit) : "",
           worst_id);
    return 1;
}

static int compare_sections(const dump_file *a, const dump_file *b, const dump_id_at *ia, const dump_id_at *ib,
                            uint32_t n)
{
    int differ = 0;
    for (uint32_t k = 0; k < a->sections; k++) {
        const dump_section *s = &a->section[k], *o = dump_find(b, s->name);
        if (!strcmp(s->name, "end"))
            continue;
        if (!o || (o->type == DUMP_RECORD) != (s->type == DUMP_RECORD) ||
            (o->comps != s->comps && o->type != DUMP_RECORD)) {
            printf("%s: only in the first, or of another shape\n", s->name);
            differ = 1;
        } else if (s->type == DUMP_RECORD)
            differ |= compare_record(s, o);
        else if (s->type != o->type) {
            printf("%s: %s, %s\n", s->name, dump_type_name(s->type), dump_type_name(o->type));
            differ = 1;
        } else
            differ |= compare_array(a, s, o, ia, ib, n);
    }
    for (uint32_t k = 0; k < b->sections; k++)
        if (!dump_find(a, b->section[k].name)) {
            printf("%s: only in the second\n", b->section[k].name);
            differ = 1;
        }
    return differ;
}

static int diff_dumps(const char *name_a, const char *name_b)
{
    dump_file a, b;
    if (!dump_open(&a, name_a))
        return HOST_NO;
    if (!dump_open(&b, name_b)) {
        dump_close(&a);
        return HOST_NO;
    }
    int differ = 0;
    if (a.dim != b.dim || a.real_bytes != b.real_bytes) {
        printf("%u-D %s, %u-D %s\n", a.dim, a.real_bytes == 8 ? "double" : "float", b.dim,
               b.real_bytes == 8 ? "double" : "float");
        differ = 1;
    }
    dump_id_at *ia = dump_sort_ids(&a), *ib = dump_sort_ids(&b);
    uint32_t n = match(ia, a.n, ib, b.n);
    differ |= n != a.n || n != b.n;
    for (uint32_t i = 0, moved = 0; i < n && !moved; i++)
        if (ia[i].at != ib[i].at) {
            printf("order: particle %u is number %u, number %u\n", ia[i].id, ia[i].at, ib[i].at);
            moved = 1;
            differ = 1;
        }
    differ |= compare_sections(&a, &b, ia, ib, n);
    if (!differ)
        printf("the same: %u particles, step %llu, t = %.9g %s\n", a.n, (unsigned long long)a.step, a.time,
               dump_unit(&a, "s"));
    free(ia);
    free(ib);
    dump_close(&a);
    dump_close(&b);
    return differ ? HOST_NO : HOST_FINE;
}

/* ---- stage logs ---- */

typedef struct log_line {
    char *text;
    unsigned long long step;
    const char *pass, *hash;
} log_line;

/* cuts the next line of *at into step, pass (may have blanks) and hash: 1, 0 at the end, -1 if it is none */
static int next_line(char **at, log_line *l)
{
    while (**at == '\n' || **at == '\r')
        ++*at;
    if (!**at)
        return 0;
    char *end = *at + strcspn(*at, "\r\n"), *next = *end ? end + 1 : end, *p;
    *end = '\0';
    l->text = *at;
    *at = next;
    l->step = strtoull(l->text, &p, 10);
    char *last = strrchr(l->text, ' ');
    if (p == l->text || *p != ' ' || last <= p)
        return -1;
    *last = '\0';
    l->pass = p + 1;
    l->hash = last + 1;
    return 1;
}

static int diff_logs(char *a, char *b, const char *name_a, const char *name_b)
{
    unsigned long long lines = 0;
    for (;; lines++) {
        log_line x = {0}, y = {0};
        int ra = next_line(&a, &x), rb = next_line(&b, &y);
        if (ra < 0 || rb < 0)
            return host_no("%s: neither a dump nor a log of lines `step pass hash`", ra < 0 ? name_a : name_b);
        if (!ra && !rb)
            break;
        if (ra != rb) {
            printf("stage %llu: %s ends, %s goes on with step %llu, %s\n", lines + 1, ra ? name_b : name_a,
                   ra ? name_a : name_b, ra ? x.step : y.step, ra ? x.pass : y.pass);
            return HOST_NO;
        }
        if (x.step != y.step || strcmp(x.pass, y.pass) || strcmp(x.hash, y.hash)) {
            printf("stage %llu differs: step %llu, %s, %s; step %llu, %s, %s\n", lines + 1, x.step, x.pass, x.hash,
                   y.step, y.pass, y.hash);
            return HOST_NO;
        }
    }
    printf("the same: %llu stages\n", lines);
    return HOST_FINE;
}

int cmd_diff(int argc, char **argv)
{
    static const char *const known[] = {NULL};
    host_command("diff");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    int files = host_known_options(argc, argv, known);
    if (files < 0)
        return HOST_USAGE;
    if (files != 2)
        return host_usage("give two dumps or two stage logs");
    size_t na, nb;
    unsigned char *a = host_read(argv[1], &na), *b = a ? host_read(argv[2], &nb) : NULL;
    int result = HOST_NO;
    if (a && b && na && nb) {
        const bool cut_a = strlen((char *)a) != na, cut_b = strlen((char *)b) != nb;
        if (a[0] == 0x89 || b[0] == 0x89)
            result = diff_dumps(argv[1], argv[2]);
        else if (cut_a || cut_b) /* what stands behind a zero byte would not be compared */
            result = host_no("%s: neither a dump nor a log: it has a zero byte", cut_a ? argv[1] : argv[2]);
        else
            result = diff_logs((char *)a, (char *)b, argv[1], argv[2]);
    } else if (a && b)
        result = host_no("%s is empty", na ? argv[2] : argv[1]);
    free(a);
    free(b);
    return result;
}
