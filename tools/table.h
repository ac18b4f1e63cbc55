/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* table.h: a CSV file of numbers in memory, and plots by gnuplot. Shared by the commands that read histories or
   references and those that draw curves. */
#ifndef TABLE_H
#define TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "output.h"

#define TABLE_COLUMNS 64

typedef struct table {
    const char *file;
    unsigned char *text;
    const char *title; /* the comment in the first line, or "" */
    const char *name[TABLE_COLUMNS];
    uint32_t columns, rows;
    double *value; /* row by row */
} table;

/* Lines that begin with # are comments, the first other line names the columns; every further one is that many numbers.
   False after a message. */
bool table_open(table *t, const char *file);
void table_close(table *t);
double table_at(const table *t, uint32_t row, uint32_t column);
int table_column(const table *t, const char *name, size_t n); /* by the n letters of its name; -1: there is none */

/* gnuplot: what it shall do is gathered through p.g, then it runs. It reads a script and gives a picture; the name of
   the picture is no part of the script, and texts get into it by plot_quote alone. */
typedef struct plot {
    FILE *g; /* in memory */
    char *script;
    size_t size;
} plot;
bool plot_open(plot *p, int width, int height); /* false after a message */
bool plot_close(plot *p, output *o);            /* runs it, the picture goes to o; false after a message */
/* Text inside single quotes. What could end them, or is no letter, digit or plain sign, is written as ?: a text may
   come out of a file's name or its contents, and a script is a program. */
void plot_quote(FILE *g, const char *text);
bool plot_name(const char *option, const char *out); /* is it a name of a picture? else a message */

#endif
