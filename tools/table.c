/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* table.c: a CSV file of numbers, and plots by gnuplot (see table.h). */
#define _POSIX_C_SOURCE 200809L
#include "table.h"

#include <stdlib.h>
#include <string.h>

#include "host.h"

double table_at(const table *t, uint32_t row, uint32_t column)
{
    return t->value[(size_t)row * t->columns + column];
}

int table_column(const table *t, const char *name, size_t n)
{
    for (uint32_t k = 0; k < t->columns; k++)
        if (strlen(t->name[k]) == n && !memcmp(t->name[k], name, n))
            return (int)k;
    return -1;
}

/* ---- reading ---- */

/* the next line of *p, without its end; null at the end */
static char *next_line(char **p)
{
    char *line = *p;
    if (!*line)
        return NULL;
    char *end = line + strcspn(line, "\n");
    *p = *end ? end + 1 : end;
    *end = '\0';
    if (end > line && end[-1] == '\r')
        end[-1] = '\0';
    return line;
}

static bool read_names(table *t, char *line)
{
    for (char *p = line; p; t->columns++) {
        if (t->columns == TABLE_COLUMNS) {
            host_no("%s: more than %d columns", t->file, TABLE_COLUMNS);
            return false;
        }
        char *comma = strchr(p, ',');
        if (comma)
            *comma = '\0';
        while (*p == ' ')
            p++;
        if (!*p) {
            host_no("%s: a column without a name", t->file);
            return false;
        }
        t->name[t->columns] = p;
        p = comma ? comma + 1 : NULL;
    }
    return true;
}

static bool read_row(table *t, char *line, unsigned long number, size_t *room)
{
    size_t n = (size_t)t->rows * t->columns;
    if (n + t->columns > *room) {
        *room = 2 * (n + t->columns);
        t->value = host_realloc(t->value, *room * sizeof *t->value);
    }
    for (uint32_t k = 0; k < t->columns; k++) {
        char *end;
        double v = strtod(line, &end);
        while (*end == ' ')
            end++;
        if (end == line || *end != (k + 1 < t->columns ? ',' : '\0')) {
            host_no("%s: line %lu: column %s is not a number, or there are not %u columns", t->file, number, t->name[k],
                    t->columns);
            return false;
        }
        t->value[n + k] = v;
        line = end + 1;
    }
    t->rows++;
    return true;
}

void table_close(table *t)
{
    free(t->text);
    free(t->value);
}

static bool read_lines(table *t, char *p)
{
    size_t room = 0;
    unsigned long number = 0;
    for (char *line; (line = next_line(&p));) {
        number++;
        if (*line == '#') {
            if (number == 1)
                t->title = line + 1 + strspn(line + 1, " ");
        } else if (*line && !t->columns) {
            if (!read_names(t, line))
                return false;
        } else if (*line && !read_row(t, line, number, &room))
            return false;
    }
    if (t->rows)
        return true;
    host_no("%s: no rows", t->file);
    return false;
}

bool table_open(table *t, const char *file)
{
    size_t size;
    memset(t, 0, sizeof *t);
    t->file = file;
    t->title = "";
    t->text = host_read(file, &size);
    if (!t->text)
        return false;
    if (read_lines(t, (char *)t->text))
        return true;
    table_close(t);
    return false;
}

/* ---- gnuplot ---- */

bool plot_name(const char *option, const char *out)
{
    size_t n = strlen(out);
    if (n > 4 && !strcmp(out + n - 4, ".png"))
        return true;
    host_usage("%s=%s: must end in .png", option, out);
    return false;
}

void plot_quote(FILE *g, const char *text)
{
    fputc('\'', g);
    for (; *text; text++)
        fprintf(g, *text == '\'' ? "''" : "%c", *text);
    fputc('\'', g);
}

bool plot_open(plot *p, const char *out, int width, int height)
{
    if (system("command -v gnuplot >/dev/null 2>&1") != 0) {
        host_no("plot= needs gnuplot, which is not installed (on Debian: the package gnuplot-nox); "
                "out=NAME.csv writes the columns without it");
        return false;
    }
    size_t room = strlen(out) + 8;
    p->out = out;
    p->tmp = host_alloc(room);
    snprintf(p->tmp, room, "%s.tmp", out);
    FILE *probe = fopen(p->tmp, "wb"); /* gnuplot would write to stdout instead */
    p->g = probe && fclose(probe) == 0 ? popen("gnuplot", "w") : NULL;
    if (!p->g) {
        host_no(probe ? "gnuplot could not be started" : "cannot write %s", p->tmp);
        free(p->tmp);
        return false;
    }
    fprintf(p->g, "set terminal pngcairo noenhanced size %d,%d\nset output ", width, height);
    plot_quote(p->g, p->tmp);
    fputc('\n', p->g);
    return true;
}

bool plot_close(plot *p)
{
    bool fine = pclose(p->g) == 0 && rename(p->tmp, p->out) == 0;
    if (!fine) {
        remove(p->tmp);
        host_no("gnuplot could not make %s", p->out);
    }
    free(p->tmp);
    return fine;
}
