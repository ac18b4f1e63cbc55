/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* studies.c: reads the tables of tests/lab (see studies.h). A table is taken whole, or refused with what is wrong. */
#define _POSIX_C_SOURCE 200809L
#include "studies.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

enum { SWEEP, LABEL, PRECISION, FIRST_NUMBER, CAUSE = FIRST_NUMBER + STUDY_NUMBERS, OPTIONS, COLUMNS, MOST_CELLS = 64 };
static const char *const column_name[COLUMNS] = {"sweep", "label", "precision", "n", "x", "error", "steps",
                                                 "particle_steps",
                                                 "pairs", "instructions", "ended", "cause", "options"};

/* the next line of *p, without its end; null at the end */
static char *next_line(char **p)
{
    char *line = *p, *end = line + strcspn(line, "\n");
    if (!*line)
        return NULL;
    *p = *end ? end + 1 : end;
    *end = '\0';
    if (end > line && end[-1] == '\r')
        end[-1] = '\0';
    return line;
}

/* splits a line of CSV in place; how many cells, 0 if a quote is not closed or there are too many */
static uint32_t split(char *p, char **cell)
{
    for (uint32_t n = 0; n < MOST_CELLS;) {
        char *to = p;
        cell[n++] = p;
        if (*p == '"') {
            for (p++; *p && (*p != '"' || p[1] == '"'); *to++ = *p++)
                p += *p == '"';
            if (*p++ != '"')
                return 0;
        } else
            while (*p && *p != ',')
                *to++ = *p++;
        const char end = *p++;
        *to = '\0';
        if (!end)
            return n;
        if (end != ',')
            return 0;
    }
    return 0;
}

/* the text behind `# key:`, null if the line is another */
static const char *header(const char *line, const char *key)
{
    line += strspn(line, "# ");
    const size_t n = strlen(key);
    return !strncmp(line, key, n) && line[n] == ':' ? line + n + 1 + strspn(line + n + 1, " ") : NULL;
}

static void read_header(study *s, const char *line)
{
    const char *const key[] = {"study", "title", "scene", "norm", "quantity", "reference", "unit"}, *text;
    const char **const to[] = {&s->name, &s->title, &s->scene, &s->norm, &s->quantity, &s->reference, &s->unit};
    for (int i = 0; i < 7; i++)
        if ((text = header(line, key[i])))
            *to[i] = text;
}

static bool wrong(const study *s, unsigned long line, const char *column, const char *value, const char *allowed)
{
    host_no("%s: line %lu: %s is \"%s\", allowed: %s", s->file, line, column, value, allowed);
    return false;
}

static bool read_columns(study *s, char *line, unsigned long number, uint32_t *place, uint32_t *cells)
{
    char *cell[MOST_CELLS];
    *cells = split(line, cell);
    for (uint32_t k = 0; k < COLUMNS; k++) {
        for (place[k] = 0; place[k] < *cells && strcmp(cell[place[k]], column_name[k]) != 0;)
            place[k]++;
        if (place[k] == *cells) {
            host_no("%s: line %lu: no column %s", s->file, number, column_name[k]);
            return false;
        }
    }
    return true;
}

/* words of letters, digits and what names and numbers are written with: they end up in a command line */
static bool plain(const char *text)
{
    for (; *text; text++)
        if (!strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_=.,+-/ ", *text))
            return false;
    return true;
}

static bool read_row(study *s, char *line, unsigned long number, const uint32_t *place, uint32_t cells)
{
    char *cell[MOST_CELLS], *end;
    const uint32_t found = split(line, cell);
    if (found != cells) {
        host_no("%s: line %lu: not %u cells", s->file, number, cells);
        return false;
    }
    study_run r = {cell[place[SWEEP]], cell[place[LABEL]], cell[place[CAUSE]], cell[place[OPTIONS]], {0}, false, number,
                   false};
    const char *const precision = cell[place[PRECISION]];
    r.is_double = !strcmp(precision, "double");
    if (!r.is_double && strcmp(precision, "float") != 0)
        return wrong(s, number, "precision", precision, "float, double");
    if (!plain(r.options))
        return wrong(s, number, "options", r.options, "letters, digits, spaces and any of _=.,+-/");
    for (uint32_t k = 0; k < STUDY_NUMBERS; k++) {
        const char *const text = cell[place[FIRST_NUMBER + k]];
        r.number[k] = *text ? strtod(text, &end) : -1;
        if (*text && (end == text || *end || !isfinite(r.number[k]) || r.number[k] < 0))
            return wrong(s, number, column_name[FIRST_NUMBER + k], text,
                         "nothing, or a finite number that is not negative");
    }
    s->run = host_realloc(s->run, (s->runs + 1) * sizeof *s->run);
    s->run[s->runs++] = r;
    return true;
}

static void free_study(study *s)
{
    free(s->file);
    free(s->text);
    free(s->run);
}

/* Reads the lines that begin with #; *p is then at the first other one. */
static unsigned long read_headers(study *s, char **p)
{
    unsigned long number = 0;
    while (**p == '#') {
        read_header(s, next_line(p));
        number++;
    }
    return number;
}

bool studies_lucky(const study_run *a, const study_run *b)
{
    const double *x = a->number, *y = b->number;
    const bool sizes = !strcmp(a->sweep, "method") || !strcmp(a->sweep, "precision");
    if (!sizes || strcmp(a->sweep, b->sweep) != 0 || strcmp(a->label, b->label) != 0 || a->is_double != b->is_double)
        return false;
    if (x[STUDY_ERROR] < 0 || y[STUDY_ERROR] < 0 || *b->cause || !(x[STUDY_PAIRS] > 0) || !(y[STUDY_PAIRS] > 0))
        return false;
    const double fall = y[STUDY_PAIRS] < x[STUDY_PAIRS] ? pow(y[STUDY_PAIRS] / x[STUDY_PAIRS], 4.0 / 3) : 1;
    return y[STUDY_ERROR] * fall > 2 * x[STUDY_ERROR];
}

static void mark_lucky(study *s)
{
    for (uint32_t i = 0; i < s->runs; i++)
        for (uint32_t k = 0; k < s->runs; k++)
            s->run[i].lucky = s->run[i].lucky || studies_lucky(&s->run[i], &s->run[k]);
}

static bool read_rows(study *s, char *p, unsigned long number)
{
    uint32_t place[COLUMNS], cells = 0;
    for (char *line; (line = next_line(&p));) {
        number++;
        if (*line == '#' || !*line)
            continue;
        if (!(cells ? read_row(s, line, number, place, cells) : read_columns(s, line, number, place, &cells)))
            return false;
    }
    mark_lucky(s);
    if (s->runs)
        return true;
    host_no("%s: no rows", s->file);
    return false;
}

static void note_scene(studies *all, const char *scene)
{
    uint32_t at = 0;
    while (at < all->scenes && strcmp(all->scene[at], scene) < 0)
        at++;
    if (at < all->scenes && !strcmp(all->scene[at], scene))
        return;
    all->scene = host_realloc(all->scene, (all->scenes + 1) * sizeof *all->scene);
    memmove(all->scene + at + 1, all->scene + at, (all->scenes - at) * sizeof *all->scene);
    all->scene[at] = host_alloc(strlen(scene) + 1);
    memcpy(all->scene[at], scene, strlen(scene) + 1);
    all->scenes++;
}

/* a table's text, from malloc, becomes the study's; so does its file's name */
static bool take_file(studies *all, char *file, unsigned char *text, size_t size, const char *scene)
{
    study s = {NULL, NULL, "", "", "", "", "", "", "", NULL, 0};
    s.file = file;
    s.text = text;
    bool fine = s.text != NULL, wanted = false;
    if (fine && (strlen((char *)s.text) != size || (size && s.text[size - 1] != '\n'))) {
        host_no("%s: the last line has no end, or there is a zero byte: the file is not whole", s.file);
        fine = false;
    }
    if (fine) {
        char *p = (char *)s.text;
        const unsigned long lines = read_headers(&s, &p);
        const bool is_study = *s.name && *s.scene;
        if (is_study)
            note_scene(all, s.scene);
        wanted = is_study && !strcmp(s.scene, scene);
        fine = !wanted || read_rows(&s, p, lines);
    }
    if (!fine || !wanted) {
        free_study(&s);
        return fine;
    }
    all->study = host_realloc(all->study, (all->count + 1) * sizeof *all->study);
    all->study[all->count++] = s;
    return true;
}

static bool read_file(studies *all, const char *folder, const char *name, const char *scene)
{
    const size_t room = strlen(folder) + strlen(name) + 2;
    size_t size = 0;
    char *file = host_alloc(room);
    snprintf(file, room, "%s/%s", folder, name);
    unsigned char *text = host_read(file, &size);
    return take_file(all, file, text, size, scene);
}

static bool open_built_in(studies *all, const char *scene)
{
    for (const studies_file *f = studies_built_in; f->name; f++) {
        const size_t room = strlen(f->name) + 1;
        size_t size = 0, at = 0;
        char *file = host_alloc(room);
        memcpy(file, f->name, room);
        for (const char *const *line = f->line; *line; line++)
            size += strlen(*line) + 1;
        char *text = host_alloc(size + 1);
        for (const char *const *line = f->line; *line; line++) {
            memcpy(text + at, *line, strlen(*line));
            at += strlen(*line);
            text[at++] = '\n';
        }
        text[at] = '\0';
        if (!take_file(all, file, (unsigned char *)text, size, scene))
            return false;
    }
    return true;
}

static int is_table(const struct dirent *e)
{
    const size_t n = strlen(e->d_name);
    return n > 4 && *e->d_name != '.' && !strcmp(e->d_name + n - 4, ".csv");
}
static int by_name(const struct dirent **a, const struct dirent **b) { return strcmp((*a)->d_name, (*b)->d_name); }

bool studies_open(studies *s, const char *folder, const char *scene)
{
    struct dirent **entry;
    bool fine = true;
    memset(s, 0, sizeof *s);
    if (!folder) {
        fine = open_built_in(s, scene);
        if (!fine)
            studies_close(s);
        return fine;
    }
    const int n = scandir(folder, &entry, is_table, by_name);
    if (n < 0) {
        host_no("cannot read the folder %s: %s", folder, strerror(errno));
        return false;
    }
    for (int i = 0; i < n; i++) {
        fine = fine && read_file(s, folder, entry[i]->d_name, scene);
        free(entry[i]);
    }
    free(entry);
    if (!fine)
        studies_close(s);
    return fine;
}

void studies_close(studies *s)
{
    for (uint32_t i = 0; i < s->count; i++)
        free_study(&s->study[i]);
    for (uint32_t i = 0; i < s->scenes; i++)
        free(s->scene[i]);
    free(s->study);
    free(s->scene);
    memset(s, 0, sizeof *s);
}
