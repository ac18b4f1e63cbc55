/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_list.c: `sph list`, the scenes and their parameters with units, ranges and defaults. */
#include <stdio.h>
#include <string.h>

#include "build.h"
#include "commands.h"
#include "host.h"

static const char help[] =
    "sph list           the scenes\n"
    "sph list SCENE     its parameters: default, unit, range, what it is; and the columns of its history\n"
    "sph list csv       all parameters of all scenes: scene,dimension,parameter,unit,default,min,max,what\n";

static void each_scene(void (*fn)(const build *b, const build_scene *s))
{
    build_scene s;
    for (uint32_t b = 0; b < BUILDS; b++)
        for (uint32_t i = 0; !builds[b]->is_double && builds[b]->scene(i, &s); i++)
            fn(builds[b], &s);
}

static void print_line(const build *b, const build_scene *s)
{
    printf("%-16s %u-D  %s\n", s->name, b->dimension, s->what);
}

static void range_text(const scene_param *p, char *min, char *max, size_t size)
{
    snprintf(min, size, "%.10g", p->min);
    snprintf(max, size, "%.10g", p->max);
    if (p->kind == SCENE_CHOICE) {
        build_choice(p, (uint32_t)p->min, min, size);
        build_choice(p, (uint32_t)p->max, max, size);
    }
}

static void print_csv(const build *b, const build_scene *s)
{
    char value[64], min[64], max[64];
    for (uint32_t i = 0; i < s->params; i++) {
        const scene_param *p = &s->param[i];
        build_param_text(p, p->value, false, value, sizeof value);
        range_text(p, min, max, sizeof min);
        printf("%s,%u,%s,%s,%s,%s,%s,\"%s\"\n", s->name, b->dimension, p->name,
               build_unit(s, p->unit), value, min, max, p->what);
    }
}

static void print_scene(const build *b, const build_scene *s)
{
    char value[64], range[140], min[64], max[64];
    print_line(b, s);
    printf("\n%-12s %-19s %-10s %-20s %s\n", "parameter", "default", "unit", "range", "what");
    for (uint32_t i = 0; i < s->params; i++) {
        const scene_param *p = &s->param[(i + SCENE_COMMON_COUNT) % s->params]; /* the scene's own first */
        build_param_text(p, p->value, false, value, sizeof value);
        range_text(p, min, max, sizeof min);
        snprintf(range, sizeof range, "%s .. %s", min, max);
        printf("%-12s %-19s %-10s %-20s %s\n", p->name, value, build_unit(s, p->unit),
               p->kind == SCENE_CHOICE ? "a name" : range, p->what);
    }
    static const char *const si[] = {"m", "s", "m/s", "kg/m^3", "Pa", "kg", "J"};
    static const char *const of[] = {"lengths", "times", "speeds", "densities", "stresses", "masses", "energies"};
    printf("\nunits:");
    for (size_t k = 0; k < sizeof si / sizeof *si; k++)
        printf("%s %s %s", k ? "," : "", of[k], build_unit(s, si[k]));
    printf("\nhistory (* with books=yes only):");
    for (uint32_t i = 0; i < s->columns; i++)
        printf(" %s%s", s->column[i], build_of_books(s->column[i]) ? "*" : "");
    printf("\n");
}

int cmd_list(int argc, char **argv)
{
    if (host_help(argc, argv, help))
        return HOST_FINE;
    if (argc > 2)
        return host_usage("at most one scene, not %d", argc - 1);
    if (argc == 1) {
        each_scene(print_line);
        return HOST_FINE;
    }
    if (!strcmp(argv[1], "csv")) {
        printf("scene,dimension,parameter,unit,default,min,max,what\n");
        each_scene(print_csv);
        return HOST_FINE;
    }
    build_scene s;
    uint32_t index;
    const build *b = build_find_scene(argv[1], false, &index, &s);
    if (!b)
        return HOST_USAGE;
    print_scene(b, &s);
    return HOST_FINE;
}
