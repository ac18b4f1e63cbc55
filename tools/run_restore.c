/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* run_restore.c: the dump that a run goes on from, held against the run that was asked for (see run.h).

   A dump goes on in the same scene with the same parameters. The kernel says no more than that a set-up is another one;
   here both are looked at: the notes of the dump (names and values of parameters), then its records beside those of a
   dump of the simulation as it was built, member by member. */
#include <stdlib.h>
#include <string.h>

#include "dumpfile.h"
#include "host.h"
#include "run.h"

enum { MOST_SAID = 12 };

static bool refuse(const run *r, const char *what)
{
    host_no("restore=%s: %s", r->restore, what);
    return false;
}

/* ---- bytes in memory ---- */

typedef struct bytes {
    unsigned char *p;
    size_t n, at, room;
} bytes;

static bool write_bytes(void *ctx, const void *p, size_t n)
{
    bytes *b = ctx;
    if (b->n + n > b->room)
        b->p = host_realloc(b->p, b->room = 2 * (b->n + n));
    memcpy(b->p + b->n, p, n);
    b->n += n;
    return true;
}

static bool read_bytes(void *ctx, void *p, size_t n)
{
    bytes *b = ctx;
    if (n > b->n - b->at)
        return false;
    memcpy(p, b->p + b->at, n);
    b->at += n;
    return true;
}

/* ---- what differs ---- */

static uint32_t said;
static char list[1024]; /* of what differs */

static void differ(const char *name, const char *there, const char *here)
{
    const size_t n = strlen(list);
    if (++said <= MOST_SAID)
        snprintf(list + n, sizeof list - n, "%s%s: %s in the dump, %s here", n ? "; " : "", name, there, here);
    else if (said == MOST_SAID + 1)
        snprintf(list + n, sizeof list - n, "; and more");
}

/* what the kernel and the host let change; all else is the run's own */
static bool may_change(const run *r, uint32_t param)
{
    return build_free_name(param) || !strcmp(r->scene.param[param].name, "damp_steps");
}

/* by the notes; a dump that has none says nothing */
static void compare_params(const run *r, const dump_file *d)
{
    char key[80], there[64], here[64];
    for (uint32_t i = 0; i < r->scene.params; i++) {
        const scene_param *param = &r->scene.param[i];
        snprintf(key, sizeof key, "param %s", param->name);
        if (may_change(r, i) || !dump_note(d, key, there, sizeof there))
            continue;
        build_param_text(param, r->p[i], true, here, sizeof here);
        if (strcmp(there, here) != 0) {
            build_param_text(param, r->p[i], false, here, sizeof here);
            differ(param->name, there, here);
        }
    }
}

static void member_text(const dump_section *s, const dump_member *m, uint64_t row, uint32_t k, char *out, size_t size)
{
    if (m->type == DUMP_F64)
        snprintf(out, size, "%.10g", dump_member_value(s, m, row, k));
    else
        snprintf(out, size, "%llu", (unsigned long long)dump_member_bits(s, m, row, k));
}

static void compare_row(const dump_section *a, const dump_section *b, uint64_t row)
{
    char name[64], there[32], here[32];
    dump_member m, o;
    for (uint32_t f = 0; dump_get_member(a, f, &m); f++) {
        if (!strcmp(m.name, "setup")) /* a digest: says that, not what */
            continue;
        if (!dump_find_member(b, m.name, &o) || o.comps != m.comps) {
            differ(m.name, "a value", "none");
            continue;
        }
        for (uint32_t k = 0; k < m.comps; k++)
            if (dump_member_bits(a, &m, row, k) != dump_member_bits(b, &o, row, k)) {
                if (a->count > 1)
                    snprintf(name, sizeof name, "%s of set %llu", m.name, (unsigned long long)row);
                else
                    snprintf(name, sizeof name, "%s", m.name);
                member_text(a, &m, row, k, there, sizeof there);
                member_text(b, &o, row, k, here, sizeof here);
                differ(name, there, here);
                break;
            }
    }
}

static void compare_records(const dump_file *d, const dump_file *own)
{
    static const char *const records[] = {"scene", "sets", "materials", "groups"};
    char there[32], here[32];
    for (size_t k = 0; k < sizeof records / sizeof *records; k++) {
        const dump_section *a = dump_find(d, records[k]), *b = dump_find(own, records[k]);
        snprintf(there, sizeof there, "%llu", a ? (unsigned long long)a->count : 0);
        snprintf(here, sizeof here, "%llu", b ? (unsigned long long)b->count : 0);
        if (strcmp(there, here) != 0)
            differ(records[k], there, here);
        else if (a && b && k < 3)
            for (uint64_t row = 0; row < a->count; row++)
                compare_row(a, b, row);
    }
}

/* gravity may change between steps, but no parameter of the tool changes it alone */
static void compare_gravity(const dump_file *d, const dump_file *own)
{
    char there[32], here[32];
    for (uint32_t k = 0; k < d->dim; k++) {
        const double a = dump_number(d, "run", "gravity", 0, k), b = dump_number(own, "run", "gravity", 0, k);
        snprintf(there, sizeof there, "%.10g", a);
        snprintf(here, sizeof here, "%.10g", b);
        if (a != b)
            differ("gravity", there, here);
    }
}

/* records of the simulation as it was built */
static bool own_dump(const run *r, dump_file *own)
{
    bytes b = {NULL, 0, 0, 0};
    const sph_status st = r->b->dump(r->sim, 0, write_bytes, &b);
    if (!st)
        return dump_take(own, r->scene.name, b.p, b.n);
    free(b.p);
    return refuse(r, sph_status_text(st));
}

static bool same_setup(const dump_file *d, const dump_file *own)
{
    dump_member m, o;
    const dump_section *a = dump_find(d, "scene"), *b = dump_find(own, "scene");
    return dump_find_member(a, "setup", &m) && dump_find_member(b, "setup", &o) &&
           dump_member_bits(a, &m, 0, 0) == dump_member_bits(b, &o, 0, 0);
}

static bool check_same(const run *r, const dump_file *d)
{
    dump_file own;
    said = 0;
    *list = '\0';
    if (!own_dump(r, &own))
        return false;
    compare_params(r, d);
    if (!said)
        compare_records(d, &own);
    if (!said)
        compare_gravity(d, &own);
    if (!said && !same_setup(d, &own))
        differ("set-up (shapes, walls, flaws, options that the records do not hold)", "another one", "its own digest");
    dump_close(&own);
    if (said)
        host_no("restore=%s: of another run than the one asked for: %s", r->restore, list);
    return !said;
}

/* ---- what can be seen before the scenes are compared ---- */

static bool check_kind(const run *r, const dump_file *d)
{
    char scene[64], text[160];
    const char *const precision = d->real_bytes == 8 ? "double" : "float";
    if (d->dim != r->b->dimension) {
        snprintf(text, sizeof text, "dimension: %u in the dump, %u of scene %s", d->dim, r->b->dimension,
                 r->scene.name);
        return refuse(r, text);
    }
    if (dump_note(d, "scene", scene, sizeof scene) && strcmp(scene, r->scene.name) != 0) {
        snprintf(text, sizeof text, "scene: %s in the dump, %s here", scene, r->scene.name);
        return refuse(r, text);
    }
    if ((d->real_bytes == 8) != r->is_double) {
        snprintf(text, sizeof text, "precision: %s in the dump, %s here; give precision=%s", precision,
                 r->is_double ? "double" : "float", precision);
        return refuse(r, text);
    }
    if (!d->full)
        return refuse(r, "a reduced dump (dump=picture); allowed: a full one (dump=full), or PREFIX_interrupted.sph, "
                         "PREFIX_failed.sph");
    if (d->version != SPH_VERSION) {
        snprintf(text, sizeof text, "version: %u in the dump, %u of this program", d->version, SPH_VERSION);
        return refuse(r, text);
    }
    return true;
}

/* a damping that is over before it begins would be taken and not act */
static bool check_damping(const run *r, const dump_file *d)
{
    const int damping = build_find_param(&r->scene, "damping"), until = build_find_param(&r->scene, "damp_steps");
    if (damping < 0 || until < 0 || !r->given[damping] || !(r->p[damping] < 1) || !(r->p[until] > 0) ||
        (double)d->step < r->p[until])
        return true;
    host_no("restore=%s: damping=%g: damp_steps=%g ends it before step %llu of the dump; allowed: damping=1, or "
            "damp_steps above that step, or 0 (to the end)",
            r->restore, r->p[damping], r->p[until], (unsigned long long)d->step);
    return false;
}

/* options that may change: as they were given, else as they are in the dump; true if one is not as in the dump */
static bool take_free(run *r, const dump_file *d)
{
    bool changed = false;
    for (uint32_t i = 0; i < r->scene.params; i++) {
        const char *name = build_free_name(i);
        const double there = name ? dump_number(d, "run", name, 0, 0) : 0;
        changed = changed || (name && r->given[i] && r->p[i] != there);
        if (name && !r->given[i])
            r->p[i] = there;
    }
    return changed;
}

bool run_restore(run *r)
{
    dump_file d;
    if (!dump_open(&d, r->restore))
        return false;
    bool fine = check_kind(r, &d) && check_same(r, &d) && check_damping(r, &d);
    if (fine) {
        const bool changed = take_free(r, &d);
        bytes b = {d.bytes, d.size, 0, d.size};
        const sph_status st = r->b->restore(r->sim, r->p, changed, read_bytes, &b);
        const sph_report *why = r->b->last(r->sim);
        fine = !st;
        if (st)
            host_no("restore=%s: %s: %s = %g, allowed: %s", r->restore, sph_status_text(st), why->what, why->value,
                    *why->allowed ? why->allowed : "-");
    }
    dump_close(&d);
    return fine;
}
