/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* run_files.c: the files that `sph run` writes: history, dumps with their notes, stage log (see run.h).

   A run that goes on under the same out= goes on with the history: rows are added behind those that are there, and
   dumps get numbers above those that are there. */
#define _POSIX_C_SOURCE 200809L
#include <ctype.h>
#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "dumpfile.h"
#include "host.h"
#include "run.h"
#include "table.h"

uint64_t run_frame_of(const run *r, double time) { return (uint64_t)floor(time / r->every * (1 + 1e-12)); }

/* ---- notes of dumps ---- */

static void put_notes(const run *r, FILE *f)
{
    char text[64];
    fprintf(f, "scene=%s\n", r->scene.name);
    for (const scene_unit *u = r->scene.units; u->si; u++)
        fprintf(f, "unit %s=%s\n", u->si, u->own);
    for (uint32_t i = 0; i < r->scene.params; i++) {
        build_param_text(&r->scene.param[i], r->p[i], true, text, sizeof text);
        fprintf(f, "param %s=%s\n", r->scene.param[i].name, text);
    }
}

enum { SECTIONS_AT = 24, SECTIONS_END = 28 }; /* of a dump's preamble (sph/dump.h) */
typedef struct dump_sink {
    output *o;
    unsigned char head[SECTIONS_END];
    size_t seen;
} dump_sink;

static bool take_bytes(void *ctx, const void *bytes, size_t n)
{
    dump_sink *s = ctx;
    for (size_t i = 0; i < n && s->seen < SECTIONS_END; i++)
        s->head[s->seen++] = ((const unsigned char *)bytes)[i];
    return output_sink(s->o, bytes, n);
}

static bool write_notes(const run *r, const dump_sink *s)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    uint32_t sections = 0;
    for (uint32_t i = SECTIONS_END; i-- > SECTIONS_AT;)
        sections = sections << 8 | s->head[i];
    if (f)
        put_notes(r, f);
    const bool whole = f && !fclose(f);
    if (!whole)
        host_no("%s: no memory for its notes", s->o->name);
    const bool fine = whole && dump_put_notes(text, size, sections, output_sink, s->o);
    free(text);
    return fine;
}

static bool write_dump(run *r, const char *name, uint32_t fields)
{
    output o;
    dump_sink s = {.o = &o};
    if (!output_open(&o, r->out ? "out" : "", name))
        return false;
    const sph_status st = r->b->dump(r->sim, fields, take_bytes, &s);
    if (st && st != SPH_SINK_FAILED) /* of that the output has said why */
        host_no("%s: %s", name, sph_status_text(st));
    const bool fine = !st && write_notes(r, &s);
    return output_close(&o, fine) && fine;
}

bool run_write_state(run *r, const char *what)
{
    size_t size = strlen(r->prefix) + strlen(what) + 8;
    char *name = host_alloc(size);
    snprintf(name, size, "%s_%s.sph", r->prefix, what);
    bool fine = write_dump(r, name, SPH_DUMP_FULL);
    if (fine)
        fprintf(stderr, "the state is in %s; go on with restore=%s\n", name, name);
    free(name);
    return fine;
}

/* ---- rows and dumps ---- */

static bool write_row(run *r)
{
    double row[MOST_COLUMNS];
    if (!r->history.f)
        return true;
    r->b->history(r->sim, row);
    for (uint32_t i = 0; i < r->columns; i++)
        fprintf(r->history.f, "%s%.10g", i ? "," : "", row[r->column[i]]);
    double added[MOST_COLUMNS];
    gauges_row(&r->extra, r->b, r->sim, added);
    for (uint32_t i = 0; i < r->extra.columns; i++)
        fprintf(r->history.f, ",%.10g", added[i]);
    fputc('\n', r->history.f);
    return output_flush(&r->history);
}

/* the dump first: where it does not fit, the history does not say that there is one */
bool run_write_frame(run *r)
{
    bool fine = true;
    if (r->out && r->dump != DUMP_KIND_NONE) {
        size_t size = strlen(r->out) + 32;
        char *name = host_alloc(size);
        const uint64_t number = r->frame > r->number ? r->frame : r->number;
        snprintf(name, size, "%s_%04llu.sph", r->out, (unsigned long long)number);
        fine = write_dump(r, name, r->dump == DUMP_KIND_FULL ? SPH_DUMP_FULL : SPH_DUMP_PICTURE);
        r->number = number + 1;
        free(name);
    }
    return fine && write_row(r);
}

void run_log_stage(void *ctx, uint64_t step, const char *pass, uint64_t hash)
{
    const output *o = ctx;
    fprintf(o->f, "%llu %016llx %s\n", (unsigned long long)step, (unsigned long long)hash, pass);
}

/* ---- the history that goes on ---- */

static void put_title(const run *r, FILE *f)
{
    fprintf(f, "scene %s, %u-D, %s", r->scene.name, r->b->dimension, r->is_double ? "double" : "float");
    for (uint32_t i = 0; i < r->scene.params; i++)
        if (r->p[i] != r->scene.param[i].value) {
            char text[64];
            build_param_text(&r->scene.param[i], r->p[i], false, text, sizeof text);
            fprintf(f, ", %s=%s", r->scene.param[i].name, text);
        }
    fputc('\n', f);
}

static const char *column_name(const run *r, uint32_t i)
{
    return i < r->columns ? r->scene.column[r->column[i]] : r->extra.name[i - r->columns];
}

/* are the columns of a history those of this run? else a message */
static bool same_columns(const run *r, const table *t)
{
    char head[128];
    const int n = snprintf(head, sizeof head, "scene %s, %u-D, %s", r->scene.name, r->b->dimension,
                           r->is_double ? "double" : "float");
    bool same = !strncmp(t->title, head, (size_t)n) && (!t->title[n] || t->title[n] == ',');
    if (!same) {
        host_no("out=%s: %s is the history of \"%s\", this run is \"%s\"; give another out=", r->out, t->file, t->title,
                head);
        return false;
    }
    same = t->columns == r->columns + r->extra.columns;
    for (uint32_t i = 0; same && i < t->columns; i++)
        same = !strcmp(t->name[i], column_name(r, i));
    if (!same)
        host_no("out=%s: %s has other columns than this run (%u, %u); give another out=", r->out, t->file, t->columns,
                r->columns + r->extra.columns);
    return same;
}

/* the history that is there, into r->before */
static bool read_before(run *r)
{
    table t;
    size_t size;
    if (!r->restore || !r->out || !output_is_file(&r->history) || access(r->history_name, F_OK))
        return true;
    if (!table_open(&t, r->history_name))
        return false;
    bool fine = same_columns(r, &t);
    r->before_time = table_at(&t, t.rows - 1, 0);
    table_close(&t);
    r->before = fine ? (char *)host_read(r->history_name, &size) : NULL;
    return r->before != NULL;
}

/* the highest number of a dump that is there, and one more; 0: there is none */
static uint64_t next_number(const char *prefix)
{
    const char *slash = strrchr(prefix, '/'), *base = slash ? slash + 1 : prefix;
    const size_t n = strlen(base), length = slash ? (size_t)(slash - prefix) : 0;
    char *folder = host_alloc(length + 2);
    memcpy(folder, slash ? prefix : ".", length ? length : 1);
    folder[length ? length : 1] = '\0'; /* of a slash in the first place the slash itself */
    DIR *dir = opendir(folder);
    uint64_t next = 0;
    for (struct dirent *e; dir && (e = readdir(dir));) {
        char *end;
        if (strncmp(e->d_name, base, n) != 0 || e->d_name[n] != '_' || !isdigit((unsigned char)e->d_name[n + 1]))
            continue;
        const unsigned long long k = strtoull(e->d_name + n + 1, &end, 10);
        if (!strcmp(end, ".sph") && k + 1 > next)
            next = k + 1;
    }
    if (dir)
        closedir(dir);
    free(folder);
    return next;
}

/* ---- all of them ---- */

static void choose_columns(run *r)
{
    int books = -1;
    for (uint32_t i = 0; i < r->scene.params; i++)
        books = !strcmp(r->scene.param[i].name, "books") ? (int)i : books;
    for (uint32_t i = 0; i < r->scene.columns; i++)
        if (books < 0 || r->p[books] != 0 || !build_of_books(r->scene.column[i]))
            r->column[r->columns++] = i;
}

bool run_open_files(run *r)
{
    choose_columns(r);
    if (r->out) {
        size_t size = strlen(r->out) + 8;
        r->history_name = host_alloc(size);
        snprintf(r->history_name, size, "%s.csv", r->out);
        if (!output_open(&r->history, "out", r->history_name) || !read_before(r))
            return false;
    } else if (!r->hash)
        output_standard(&r->history);
    return (!r->stage_name || output_open(&r->stage, "stage_log", r->stage_name)) &&
           (!r->cost || output_open(&r->costs, "cost", r->cost));
}

static bool put_before(run *r)
{
    if (r->before_time > r->first_time * (1 + 1e-9)) {
        host_no("out=%s: its history goes to t = %.10g, the dump is of t = %.10g: rows would stand twice; give another "
                "out=, or restore= of the last state", r->out, r->before_time, r->first_time);
        return false;
    }
    /* a last line without its end is half a row */
    const char *end = strrchr(r->before, '\n'), *first = strchr(r->before, '\n');
    fwrite(r->before, 1, end ? (size_t)(end - r->before) + 1 : 0, r->history.f);
    char *title = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&title, &size);
    if (f) {
        fputs("# ", f);
        put_title(r, f);
        fclose(f);
    }
    /* of options that were changed */
    if (title && first && (size != (size_t)(first - r->before) + 1 || memcmp(title, r->before, size) != 0))
        fprintf(r->history.f, "# from t = %.10g on: %s", r->first_time, title + 2);
    free(title);
    return true;
}

bool run_begin_files(run *r, bool *skip)
{
    *skip = false;
    r->frame = run_frame_of(r, r->first_time);
    r->number = r->restore && r->out ? next_number(r->out) : 0;
    if (r->history.f && r->before) {
        if (!put_before(r))
            return false;
        *skip = run_frame_of(r, r->before_time) >= r->frame;
    } else if (r->history.f) {
        fputs("# ", r->history.f);
        put_title(r, r->history.f);
        for (uint32_t i = 0; i < r->columns + r->extra.columns; i++)
            fprintf(r->history.f, "%s%s", i ? "," : "", column_name(r, i));
        fputc('\n', r->history.f);
    }
    return (!r->history.f || output_begin(&r->history)) && (!r->stage.f || output_begin(&r->stage));
}

bool run_close_files(run *r, bool keep)
{
    bool fine = output_close(&r->history, keep);
    fine = output_close(&r->stage, keep) && fine;
    fine = output_close(&r->costs, keep) && fine;
    free(r->history_name);
    free(r->before);
    return fine;
}
