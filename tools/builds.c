/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* builds.c: the six builds in one list; scenes and parameters by name (see build.h). */
#include "build.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

extern const build sph1f_build_table, sph1d_build_table, sph2f_build_table, sph2d_build_table, sph3f_build_table,
    sph3d_build_table;

const build *const builds[BUILDS] = {&sph1f_build_table, &sph1d_build_table, &sph2f_build_table,
                                     &sph2d_build_table, &sph3f_build_table, &sph3d_build_table};

#define LONGEST 63u /* letters of a name that count for the nearest one */

uint32_t build_distance(const char *a, const char *b)
{
    uint32_t row[LONGEST + 1], n = (uint32_t)strlen(a), m = (uint32_t)strlen(b);
    n = n < LONGEST ? n : LONGEST;
    m = m < LONGEST ? m : LONGEST;
    for (uint32_t j = 0; j <= m; j++)
        row[j] = j;
    for (uint32_t i = 1; i <= n; i++) {
        uint32_t diagonal = row[0];
        row[0] = i;
        for (uint32_t j = 1; j <= m; j++) {
            uint32_t replace = diagonal + (tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]));
            diagonal = row[j];
            uint32_t least = row[j] < row[j - 1] ? row[j] + 1 : row[j - 1] + 1;
            row[j] = replace < least ? replace : least;
        }
    }
    return row[m];
}

const build *build_find_scene(const char *name, bool is_double, uint32_t *index, build_scene *out)
{
    const char *nearest = "";
    uint32_t least = UINT32_MAX;
    for (uint32_t b = 0; b < BUILDS; b++) {
        if (builds[b]->is_double != is_double)
            continue;
        for (uint32_t i = 0; builds[b]->scene(i, out); i++) {
            uint32_t d = build_distance(name, out->name);
            if (!strcmp(name, out->name)) {
                *index = i;
                return builds[b];
            }
            if (d < least) {
                least = d;
                nearest = out->name;
            }
        }
    }
    host_usage("no scene %s; did you mean %s? (sph list shows them all)", name, nearest);
    return NULL;
}

int build_find_param(const build_scene *scene, const char *name)
{
    for (uint32_t i = 0; i < scene->params; i++)
        if (!strcmp(scene->param[i].name, name))
            return (int)i;
    return -1;
}

void build_choice(const scene_param *param, uint32_t i, char *out, size_t size)
{
    const char *at = strchr(param->what, ':');
    *out = '\0';
    for (uint32_t k = 0; at && k <= i; k++) {
        at += strspn(at, ": ");
        size_t n = strcspn(at, " ");
        if (n == 0)
            return;
        if (k == i && n < size) {
            memcpy(out, at, n);
            out[n] = '\0';
        }
        at += n;
    }
}

bool build_parse_param(const scene_param *param, const char *text, double *out)
{
    char word[64];
    if (param->kind == SCENE_CHOICE) {
        for (uint32_t i = 0; i <= (uint32_t)param->max; i++) {
            build_choice(param, i, word, sizeof word);
            if (!strcmp(word, text)) {
                *out = i;
                return true;
            }
        }
        host_usage("%s=%s: must be one of%s", param->name, text, strchr(param->what, ':') + 1);
        return false;
    }
    char *stop;
    double v = strtod(text, &stop);
    if (*text == '\0' || *stop || !(v >= param->min && v <= param->max) ||
        (param->kind == SCENE_WHOLE && v != (double)(int64_t)v)) {
        host_usage("%s=%s: must be a %snumber from %g to %g (%s)", param->name, text,
                   param->kind == SCENE_WHOLE ? "whole " : "", param->min, param->max, param->unit);
        return false;
    }
    *out = v;
    return true;
}

void build_param_text(const scene_param *param, double value, bool exact, char *out, size_t size)
{
    if (param->kind == SCENE_CHOICE)
        build_choice(param, (uint32_t)value, out, size);
    else
        snprintf(out, size, exact ? "%.17g" : "%.10g", value);
}

/* dt has had another name in dumps since the first version (sph/format.c) */
#define FREE_NAME(A, name, kind, start, low, high, in, allowed, change, ...) FREE_NAME_##change(name)
#define FREE_NAME_FREE(name) !strcmp(#name, "dt") ? "dt_fixed" : #name,
#define FREE_NAME_FIXED(name) NULL,
const char *build_free_name(uint32_t param)
{
    const char *const name[SCENE_COMMON_COUNT] = {SPH_OPTIONS(SCENE_SKIP, FREE_NAME, ) NULL};
    return param < SCENE_COMMON_COUNT ? name[param] : NULL;
}

const char *build_unit(const build_scene *scene, const char *si)
{
    for (const scene_unit *u = scene->units; u->si; u++)
        if (!strcmp(u->si, si))
            return u->own;
    return si;
}

bool build_of_books(const char *column)
{
    static const char *const list[] = {"dissipated", "diffused", "wall_work", "work", "energy", "error_of_energy"};
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        const size_t n = strlen(list[k]);
        const char *const unit = column + n;
        if (!strncmp(column, list[k], n) && (!*unit || !strncmp(unit, "_J", 2) || !strncmp(unit, "_K", 2)))
            return true;
    }
    return false;
}
