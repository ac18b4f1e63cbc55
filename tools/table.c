/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* table.c: a CSV file of numbers, and plots by gnuplot (see table.h). */
#define _POSIX_C_SOURCE 200809L
#include "table.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

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
    /* what stands behind a zero byte would be lost without a word */
    if (strlen((char *)t->text) != size)
        host_no("%s: byte %zu is zero: it is no text, or not whole", file, strlen((char *)t->text) + 1);
    else if (read_lines(t, (char *)t->text))
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

/* bytes above 127 are parts of letters in UTF-8 */
static bool plain(char c)
{
    const unsigned char u = (unsigned char)c;
    return u > 127 || isalnum(u) || (c && strchr(" _=.,:;+-*/()[]%^<>|~#", c));
}

void plot_quote(FILE *g, const char *text)
{
    fputc('\'', g);
    for (; *text; text++)
        fputc(plain(*text) ? *text : '?', g);
    fputc('\'', g);
}

bool plot_open(plot *p, int width, int height)
{
    p->script = NULL;
    p->g = open_memstream(&p->script, &p->size);
    if (!p->g) {
        host_no("plot=: %s", strerror(errno));
        return false;
    }
    fprintf(p->g, "set terminal pngcairo noenhanced size %d,%d\n", width, height);
    return true;
}

enum { NOT_FOUND = 127 };

/* gnuplot with its script as input, its picture into a pipe; the child, -1 and errno if there is none */
static pid_t start(FILE *script, int out[2])
{
    if (pipe(out))
        return -1;
    const pid_t child = fork();
    if (child == 0) {
        if (dup2(fileno(script), STDIN_FILENO) < 0 || dup2(out[1], STDOUT_FILENO) < 0)
            _exit(NOT_FOUND);
        close(out[0]);
        close(out[1]);
        execlp("gnuplot", "gnuplot", (char *)NULL);
        _exit(NOT_FOUND);
    }
    const int reason = errno;
    close(out[1]);
    if (child < 0)
        close(out[0]);
    errno = reason;
    return child;
}

/* what the child writes, into o, and how it ended; its exit code, -1 if a signal ended it */
static int take_picture(pid_t child, int from, output *o, size_t *bytes)
{
    char piece[4096];
    ssize_t n;
    int status = 0;
    while ((n = read(from, piece, sizeof piece)) > 0 || (n < 0 && errno == EINTR))
        if (n > 0)
            *bytes += fwrite(piece, 1, (size_t)n, o->f);
    close(from);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static bool draw(const plot *p, output *o)
{
    FILE *script = tmpfile();
    int out[2];
    size_t bytes = 0;
    const bool fine = script && fwrite(p->script, 1, p->size, script) == p->size && !fflush(script) &&
                      !fseek(script, 0, SEEK_SET);
    fflush(NULL); /* the child must not write what waits in this program's buffers */
    const pid_t child = fine ? start(script, out) : -1;
    const int reason = errno, code = child < 0 ? -1 : take_picture(child, out[0], o, &bytes);
    if (script)
        fclose(script);
    if (child < 0)
        host_no("%s: gnuplot could not be started: %s", o->name, strerror(reason));
    else if (code == NOT_FOUND)
        host_no("plot= needs gnuplot, which is not installed (on Debian: the package gnuplot-nox); "
                "out=NAME.csv writes the columns without it");
    else if (code || !bytes)
        host_no("gnuplot could not make %s (exit code %d, %zu bytes)", o->name, code, bytes);
    return child >= 0 && !code && bytes;
}

bool plot_close(plot *p, output *o)
{
    const bool whole = !ferror(p->g), closed = !fclose(p->g);
    const bool fine = whole && closed && draw(p, o);
    if (!whole || !closed)
        host_no("plot=: no memory for the script");
    free(p->script);
    p->script = NULL;
    return fine;
}
