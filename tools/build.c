/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* build.c: the table of one build (see build.h). Compiled six times; what differs between builds stays in here. */
#include "build.h"

#include <stdlib.h>
#include <string.h>

#include "../examples/scenes/scene.h"

struct build_sim {
    sph_sim *sim;
    void *arena;
    const scene *scene;
    sph_config cfg;
    double p[]; /* of the scene */
};

static bool get_scene(uint32_t i, build_scene *out)
{
    for (uint32_t k = 0; k <= i; k++)
        if (!scene_table[k])
            return false;
    const scene *s = scene_table[i];
    *out = (build_scene){s->name, s->what, s->param, s->params, s->columns, s->column, s->units};
    return true;
}

static void close_sim(build_sim *s)
{
    if (s)
        free(s->arena);
    free(s);
}

static build_sim *no_memory(build_sim *s, sph_report *report, double bytes)
{
    *report = (sph_report){SPH_ARENA_TOO_SMALL, "memory", "less: the machine does not give so many bytes", "", bytes,
                           SPH_NO_PARTICLE, SPH_MAX_SETS, SPH_ROLES};
    close_sim(s);
    return NULL;
}

static build_sim *open_scene(uint32_t index, const double *p, const build_host *host, sph_report *report)
{
    const scene *c = scene_table[index];
    build_sim *s = calloc(1, sizeof *s + c->params * sizeof *p);
    if (!s)
        return no_memory(s, report, (double)sizeof *s);
    s->scene = c;
    memcpy(s->p, p, c->params * sizeof *p);
    c->configure(s->p, &s->cfg);
    s->cfg.port = host->port;
    s->cfg.max_threads = host->port.threads > 1 ? host->port.threads : 1;
    s->cfg.stage_log = host->stage_log;
    s->cfg.stage_ctx = host->stage_ctx;
    if (sph_config_check(&s->cfg, report) != SPH_OK) {
        close_sim(s);
        return NULL;
    }
    size_t bytes = (sph_arena_bytes(&s->cfg) + SPH_ALIGN - 1) / SPH_ALIGN * SPH_ALIGN;
    if (bytes && !(s->arena = aligned_alloc(SPH_ALIGN, bytes)))
        return no_memory(s, report, (double)bytes);
    if (sph_init(&s->sim, &s->cfg, s->arena, bytes, report) == SPH_OK) {
        if (c->build(s->sim, s->p) == SPH_OK && sph_ready(s->sim) == SPH_OK)
            return s;
        *report = *sph_last(s->sim);
    }
    close_sim(s);
    return NULL;
}

static sph_status step(build_sim *s, double t_end)
{
    sph_status st = sph_step_to(s->sim, t_end);
    return st ? st : scene_between(s->sim, s->p, &s->cfg);
}

static double end(const build_sim *s) { return s->scene->end(s->p); }
static double time_of(const build_sim *s) { return sph_time(s->sim); }
static void history(const build_sim *s, double *row) { s->scene->history(s->sim, s->p, row); }

/* half a spacing below the lowest fluid within a spacing of the column above x; the domain's low end if there is none
   */
static double bed_below(const build_sim *s, const double *x)
{
    const uint32_t up = SPH_DIM - 1;
    double bed = s->cfg.lo[up];
    bool any = false;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(s->sim); i++) {
        if (sph_get(s->sim, i, &q) != SPH_OK || (q.role != SPH_ROLE_FLUID && q.role != SPH_ROLE_SOLID))
            continue;
        bool near = true;
        for (uint32_t k = 0; k < up; k++)
            near = near && SCENE_ABS(q.x[k] - x[k]) <= s->cfg.spacing;
        if (near && (!any || q.x[up] - 0.5 * s->cfg.spacing < bed)) {
            bed = q.x[up] - 0.5 * s->cfg.spacing;
            any = true;
        }
    }
    return bed;
}

static void domain(const build_sim *s, uint32_t axis, double *lo, double *hi)
{
    *lo = s->cfg.lo[axis];
    *hi = s->cfg.hi[axis];
}

static void gauge(const build_sim *s, const double *x, double *out)
{
    const uint32_t up = SPH_DIM - 1;
    double at[SPH_DIM];
    for (uint32_t k = 0; k < up; k++)
        at[k] = x[k];
    at[up] = bed_below(s, x);
    out[0] = out[1] = out[2] = 0;
    sph_surface(s->sim, at, up, &out[0]);
    sph_gauge(s->sim, at, up, &out[1]);
    sph_depth(s->sim, at, up, &out[2]);
}

static void probe(const build_sim *s, const double *x, double *out)
{
    sph_probe_value v = {0};
    sph_probe(s->sim, x, &v);
    out[0] = v.p;
    for (int k = 0; k < SPH_DIM; k++)
        out[1 + k] = v.v[k];
    out[1 + SPH_DIM] = v.cover;
}

static void info(const build_sim *s, sph_step_info *out) { sph_get_step(s->sim, out); }
static void usage(const build_sim *s, sph_usage *out) { sph_get_usage(s->sim, out); }
static uint32_t count(const build_sim *s) { return sph_count(s->sim); }
static uint64_t hash(const build_sim *s) { return sph_hash(s->sim); }
static const sph_report *last(const build_sim *s) { return sph_last(s->sim); }
static void arena(const build_sim *s, void (*fn)(void *ctx, const char *name, size_t bytes), void *ctx)
{
    sph_arena_report(s->sim, fn, ctx);
}

static void totals(const build_sim *s, build_totals *out)
{
    sph_totals o;
    sph_get_totals(s->sim, &o);
    *out = (build_totals){o.fluid,     o.wall,    o.solid,        s->cfg.books, o.mass,      {0, 0, 0},    o.kinetic,
                          o.potential, o.internal, o.elastic,     o.plastic_work, o.wall_work, o.dissipated,
                          o.diffused,  o.removed_mass, o.max_speed, o.min_density, o.max_density,
                          o.body_work, o.in_walls, o.in_bonds,    o.unbalanced,   0,           o.balance};
    out->at_once = o.absorbed + o.shifted + o.quieted + o.slowed + o.evened + o.carried_off + o.released + o.put_back_loss + o.filtered + o.damped;
    for (int k = 0; k < SPH_DIM; k++)
        out->momentum[k] = o.momentum[k];
}

static sph_status dump(const build_sim *s, uint32_t fields, sph_sink sink, void *ctx)
{
    return sph_dump(s->sim, fields, sink, ctx);
}

/* the options that may change and are parameters */
#define TAKE_FREE(name) s->cfg.name = p[SCENE_OF_##name];
#define TAKE_FIXED(name)
#define TAKE(A, name, kind, start, low, high, in, allowed, change, ...) TAKE_##change(name)
static sph_status restore(build_sim *s, const double *p, bool changed, sph_source source, void *ctx)
{
    sph_status st = sph_restore(s->sim, source, ctx);
    if (st)
        return st;
    SPH_OPTIONS(SCENE_SKIP, TAKE, )
    for (uint32_t i = 0; i < s->scene->params; i++)
        s->p[i] = p[i];
    st = changed ? sph_reconfigure(s->sim, &s->cfg) : SPH_OK;
    /* a run restored after the end of its damping goes on without it */
    return st ? st : scene_between(s->sim, s->p, &s->cfg);
}

static sph_status inspect(build_sim *s, void (*fn)(void *ctx, const sph_finding *finding), void *ctx)
{
    return sph_inspect(s->sim, fn, ctx);
}

#define build_table SPH_NAME(build_table)
extern const build build_table;
const build build_table = {SPH_DIM, SPH_DOUBLE, get_scene, open_scene, close_sim, step,  end,   time_of, history,
                           domain,  gauge,      probe,     totals,     info,      usage, count, hash,    last,
                           arena,   dump,       restore,   inspect};
