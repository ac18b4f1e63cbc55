/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* build.h: one of the six builds of the kernel (1-D, 2-D, 3-D; float, double) behind pointers that look the same for
   all, so that one program runs every scene in every precision. build.c is compiled six times, one table each. */
#ifndef BUILD_H
#define BUILD_H

/* of sph.h only what is the same in all builds is used here: statuses, reports, step info, usage, port */
#include "../examples/scenes/scene_param.h"
#include "../sph/sph.h"

typedef struct build_scene {
    const char *name, *what;
    const scene_param *param;
    uint32_t params, columns;
    const char *const *column;
    const scene_unit *units;
} build_scene;

/* what the host adds to a scene's configuration */
typedef struct build_host {
    sph_port port;
    sph_stage_log stage_log;
    void *stage_ctx;
} build_host;

typedef struct build_totals {
    uint32_t fluid, wall, solid;
    bool books; /* are wall_work, dissipated, diffused kept? else they are 0 and mean nothing */
    double mass, momentum[3], kinetic, potential, internal, elastic, plastic_work, wall_work, dissipated, diffused,
        removed_mass, max_speed, min_density, max_density, body_work, in_walls, in_bonds, unbalanced, at_once, balance;
} build_totals;

typedef struct build_sim build_sim; /* a simulation with its arena, scene and parameters */

typedef struct build {
    uint32_t dimension;
    bool is_double;
    bool (*scene)(uint32_t i, build_scene *out); /* false: there is no such scene */
    /* Configures, allocates the arena, builds the scene. Null and a report on failure. p is copied. */
    build_sim *(*open)(uint32_t scene, const double *p, const build_host *host, sph_report *report);
    void (*close)(build_sim *s);
    sph_status (*step)(build_sim *s, double t_end);
    double (*end)(const build_sim *s);
    double (*time)(const build_sim *s);
    void (*history)(const build_sim *s, double *row);
    void (*domain)(const build_sim *s, uint32_t axis, double *lo, double *hi); /* m */
    /* Of the column above x (m, an axis less than the scene has): the connected surface from the lowest water up, the
       highest water, the integral of cover (m). */
    void (*gauge)(const build_sim *s, const double *x, double *out);
    /* At x: pressure (Pa), velocity (m/s), cover. */
    void (*probe)(const build_sim *s, const double *x, double *out);
    void (*totals)(const build_sim *s, build_totals *out);
    void (*info)(const build_sim *s, sph_step_info *out);
    void (*usage)(const build_sim *s, sph_usage *out);
    uint32_t (*count)(const build_sim *s);
    uint64_t (*hash)(const build_sim *s);
    const sph_report *(*last)(const build_sim *s);
    void (*arena)(const build_sim *s, void (*fn)(void *ctx, const char *name, size_t bytes), void *ctx);
    sph_status (*dump)(const build_sim *s, uint32_t fields, sph_sink sink, void *ctx);
    /* Restores; p has the options that may change (build_free_name) as they shall be, changed: not all are as in the
       dump. */
    sph_status (*restore)(build_sim *s, const double *p, bool changed, sph_source source, void *ctx);
    sph_status (*inspect)(build_sim *s, void (*fn)(void *ctx, const sph_finding *finding), void *ctx);
} build;

#define BUILDS 6u
extern const build *const builds[BUILDS]; /* 1-D float, 1-D double, 2-D float, ... */

/* A scene by name in the given precision; null after a message that names the nearest scene. */
const build *build_find_scene(const char *name, bool is_double, uint32_t *index, build_scene *out);
/* Index of a parameter; -1 if there is none of that name. */
int build_find_param(const build_scene *scene, const char *name);
/* Value of a parameter from text: a number in range, or the name of a choice; false after a message. */
bool build_parse_param(const scene_param *param, const char *text, double *out);
/* Name of choice number i of a parameter into out, "" if there is none. */
void build_choice(const scene_param *param, uint32_t i, char *out, size_t size);
/* A parameter's value as text: number or choice; exact: a number with all its digits. */
void build_param_text(const scene_param *param, double value, bool exact, char *out, size_t size);
/* May a parameter change when a run goes on? Then the name that it has in the record "run" of a dump, else null. */
const char *build_free_name(uint32_t param);
/* the scene's unit for one of the kernel's manual (m, kg/m^3, J ...) */
const char *build_unit(const build_scene *scene, const char *si);
/* Is a column of a history out of the books (books=yes)? */
bool build_of_books(const char *column);

/* Number of edits (insert, delete, replace) between two words; for "did you mean". */
uint32_t build_distance(const char *a, const char *b);

#endif
