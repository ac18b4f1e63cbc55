/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_history.c: sph history. Reads the CSV files of `sph run`: checks and summarises them, chooses and converts
   columns, overlays several runs and measured points in a plot (by gnuplot). */
#include "commands.h"
#include "host.h"
#include "table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph history FILE.csv... [columns=LIST] [out=NAME.csv] [plot=NAME.png] [reference=FILE.csv] [size=WxH]\n"
    "Without out= and plot=: checks each file (rows complete, numbers finite, first column increasing) and\n"
    "prints for each column its first, last, smallest and largest value.\n"
    "  columns=       chosen columns, separated by commas (default: all). NAME, or NAME*FACTOR, NAME+OFFSET,\n"
    "                 NAME*FACTOR+OFFSET, each may be followed by :NEWNAME, e.g. columns=time_s*13.1:T,front_m*17.5:Z\n"
    "  out=NAME.csv   the chosen columns of one file as CSV\n"
    "  plot=NAME.png  the chosen columns against the first of them, all files in one plot; needs gnuplot\n"
    "  reference=     a CSV whose second and further columns are drawn as points against its first\n"
    "  size=WxH       of the plot in pixels, default 960x640\n";

/* ---- choosing columns ---- */

typedef struct pick {
    uint32_t column;
    double factor, offset;
    char name[64];
} pick;

/* one item of columns=: NAME[*FACTOR][+OFFSET][:NEWNAME], up to `end` */
static bool parse_pick(const table *h, const char *item, const char *end, pick *p)
{
    const char *stop = item + strcspn(item, "*+:,");
    char *next = NULL;
    int k = table_column(h, item, (size_t)(stop - item));
    *p = (pick){0, 1, 0, ""};
    if (k < 0) {
        host_usage("columns: %s has no column %.*s", h->file, (int)(stop - item), item);
        fputs("columns there:", stderr);
        for (uint32_t c = 0; c < h->columns; c++)
            fprintf(stderr, " %s", h->name[c]);
        fputc('\n', stderr);
        return false;
    }
    p->column = (uint32_t)k;
    snprintf(p->name, sizeof p->name, "%s", h->name[k]);
    if (*stop == '*') {
        p->factor = strtod(stop + 1, &next);
        stop = next == stop + 1 ? "?" : next;
    }
    if (*stop == '+') {
        p->offset = strtod(stop + 1, &next);
        stop = next == stop + 1 ? "?" : next;
    }
    if (*stop == ':' && end > stop + 1) {
        snprintf(p->name, sizeof p->name, "%.*s", (int)(end - stop - 1), stop + 1);
        stop = end;
    }
    if (stop == end && isfinite(p->factor) && isfinite(p->offset))
        return true;
    host_usage("columns: %.*s: must be NAME, NAME*FACTOR, NAME+OFFSET or NAME*FACTOR+OFFSET, then perhaps :NEWNAME",
               (int)(end - item), item);
    return false;
}

/* how many columns were chosen, 0 after a message */
static uint32_t choose(const table *h, const char *list, pick *p)
{
    uint32_t n = 0;
    if (!list) {
        for (; n < h->columns; n++) {
            p[n] = (pick){n, 1, 0, ""};
            snprintf(p[n].name, sizeof p[n].name, "%s", h->name[n]);
        }
        return n;
    }
    for (const char *item = list; item; n++) {
        const char *end = item + strcspn(item, ",");
        if (n == TABLE_COLUMNS || !parse_pick(h, item, end, &p[n]))
            return 0;
        item = *end ? end + 1 : NULL;
    }
    return n;
}

static double picked(const table *h, uint32_t row, const pick *p)
{
    return table_at(h, row, p->column) * p->factor + p->offset;
}

/* ---- check and summary ---- */

static bool check(const table *h)
{
    for (uint32_t i = 0; i < h->rows; i++)
        for (uint32_t k = 0; k < h->columns; k++)
            if (!isfinite(table_at(h, i, k))) {
                host_no("%s: row %u: %s is not finite", h->file, i + 1, h->name[k]);
                return false;
            }
    for (uint32_t i = 1; i < h->rows; i++)
        if (!(table_at(h, i, 0) > table_at(h, i - 1, 0))) {
            host_no("%s: row %u: %s does not increase: %.9g after %.9g", h->file, i + 1, h->name[0], table_at(h, i, 0),
                    table_at(h, i - 1, 0));
            return false;
        }
    return true;
}

static bool summarise(const table *h, const char *list)
{
    pick p[TABLE_COLUMNS];
    uint32_t n = choose(h, list, p);
    if (!n)
        return false;
    printf("%s: %u rows%s%s\n", h->file, h->rows, *h->title ? ", " : "", h->title);
    printf("  %-28s %14s %14s %14s %14s\n", "column", "first", "last", "smallest", "largest");
    for (uint32_t k = 0; k < n; k++) {
        double low = picked(h, 0, &p[k]), high = low;
        for (uint32_t i = 1; i < h->rows; i++) {
            low = fmin(low, picked(h, i, &p[k]));
            high = fmax(high, picked(h, i, &p[k]));
        }
        printf("  %-28s %14.7g %14.7g %14.7g %14.7g\n", p[k].name, picked(h, 0, &p[k]), picked(h, h->rows - 1, &p[k]),
               low, high);
    }
    return true;
}

static bool write_columns(const table *h, const char *list, FILE *f)
{
    pick p[TABLE_COLUMNS];
    const uint32_t n = choose(h, list, p);
    if (*h->title)
        fprintf(f, "# %s\n", h->title);
    for (uint32_t k = 0; k < n; k++)
        fprintf(f, "%s%s", k ? "," : "", p[k].name);
    fputc('\n', f);
    for (uint32_t i = 0; i < h->rows && n; i++) {
        for (uint32_t k = 0; k < n; k++)
            fprintf(f, "%s%.17g", k ? "," : "", picked(h, i, &p[k]));
        fputc('\n', f);
    }
    return n > 0;
}

/* ---- plot ---- */

static void put_block(FILE *g, const char *name, uint32_t number, const table *h, const pick *p, uint32_t n)
{
    fprintf(g, "$%s%u << END_OF_DATA\n", name, number);
    for (uint32_t i = 0; i < h->rows; i++)
        for (uint32_t k = 0; k < n; k++)
            fprintf(g, "%.17g%c", picked(h, i, &p[k]), k + 1 < n ? ' ' : '\n');
    fputs("END_OF_DATA\n", g);
}

static void put_curves(FILE *g, const char *name, uint32_t number, const table *h, const pick *p, uint32_t n,
                       const char *with, bool *first)
{
    for (uint32_t k = 1; k < n; k++) {
        char title[256];
        snprintf(title, sizeof title, "%s: %s", h->file, p[k].name);
        fprintf(g, "%s $%s%u using 1:%u with %s title ", *first ? "plot" : ",", name, number, k + 1, with);
        plot_quote(g, title);
        *first = false;
    }
}

typedef struct plot_options {
    const char *list, *reference;
    int width, height;
} plot_options;

typedef struct curves {
    table h;
    pick p[TABLE_COLUMNS];
    uint32_t n;
} curves;

static bool read_curves(curves *c, const char *file, const char *list)
{
    if (!table_open(&c->h, file))
        return false;
    c->n = choose(&c->h, list, c->p);
    if (c->n > 1)
        return true;
    if (c->n == 1)
        host_usage("%s: a plot needs two columns", file);
    table_close(&c->h);
    return false;
}

static void put_script(FILE *g, const curves *c, uint32_t files, uint32_t refs)
{
    bool first = true;
    fputs("set grid\nset key outside bottom center\nset xlabel ", g);
    plot_quote(g, c[0].p[0].name);
    if (c[0].n == 2) {
        fputs("\nset ylabel ", g);
        plot_quote(g, c[0].p[1].name);
    }
    fputs("\n", g);
    for (uint32_t k = 0; k < files + refs; k++)
        put_block(g, "data", k, &c[k].h, c[k].p, c[k].n);
    for (uint32_t k = 0; k < files + refs; k++)
        put_curves(g, "data", k, &c[k].h, c[k].p, c[k].n, k < files ? "lines linewidth 2" : "points pointtype 7",
                   &first);
    fputs("\n", g);
}

static bool run_gnuplot(const curves *c, uint32_t files, uint32_t refs, const plot_options *o, output *picture)
{
    plot p;
    if (!plot_open(&p, o->width, o->height))
        return false;
    put_script(p.g, c, files, refs);
    return plot_close(&p, picture);
}

static bool plot_files(char **files, uint32_t n, const plot_options *o, output *picture)
{
    curves *c = host_alloc((n + 1) * sizeof *c);
    uint32_t read = 0;
    const uint32_t all = n + (o->reference != NULL);
    while (read < all && read_curves(&c[read], read < n ? files[read] : o->reference, read < n ? o->list : NULL))
        read++;
    const bool fine = read == all && run_gnuplot(c, n, all - n, o, picture);
    for (uint32_t k = 0; k < read; k++)
        table_close(&c[k].h);
    free(c);
    return fine;
}

/* ---- the command ---- */

static int summarise_all(char **files, int n, const char *list)
{
    int result = HOST_FINE;
    for (int k = 0; k < n; k++) {
        table h;
        if (!table_open(&h, files[k])) {
            result = HOST_NO;
            continue;
        }
        if (!check(&h) || !summarise(&h, list))
            result = HOST_NO;
        table_close(&h);
    }
    return result;
}

/* the columns and the picture that were asked for, both or none */
static int write_files(char **files, uint32_t n, const plot_options *o, const char *out, const char *image)
{
    output file[2] = {{0}};
    bool fine = (!out || output_open(&file[0], "out", out)) && (!image || output_open(&file[1], "plot", image));
    int code = HOST_NO;
    table h;
    if (fine && out && (fine = table_open(&h, files[0]))) {
        fine = write_columns(&h, o->list, file[0].f);
        code = fine ? HOST_NO : HOST_USAGE;
        table_close(&h);
    }
    fine = fine && (!image || plot_files(files, n, o, &file[1]));
    return output_close_all(file, 2, fine) && fine ? HOST_FINE : code;
}

int cmd_history(int argc, char **argv)
{
    static const char *const known[] = {"columns", "out", "plot", "reference", "size", NULL};
    int width = 960, height = 640;
    char rest;
    host_command("history");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    int files = host_known_options(argc, argv, known);
    if (files < 0)
        return HOST_USAGE;
    const char *list = host_option(argc, argv, "columns"), *out = host_option(argc, argv, "out");
    const char *image = host_option(argc, argv, "plot"), *reference = host_option(argc, argv, "reference");
    const char *size = host_option(argc, argv, "size");
    if (files == 0)
        return host_usage("give at least one history file");
    if (size && (sscanf(size, "%dx%d%c", &width, &height, &rest) != 2 || width < 200 || width > 16000 || height < 150 ||
                 height > 16000))
        return host_usage("size=%s: must be WIDTHxHEIGHT, from 200x150 to 16000x16000", size);
    if (image && !plot_name("plot", image))
        return HOST_USAGE;
    if (reference && !image)
        return host_usage("reference= is for plot=");
    if (out && files > 1)
        return host_usage("out= takes one history file, %d were given", files);
    const plot_options o = {list, reference, width, height};
    return out || image ? write_files(argv + 1, (uint32_t)files, &o, out, image) : summarise_all(argv + 1, files, list);
}
