/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* layout.c: configuration checks and the arena. One function lays every array out; run with a null base it measures,
   run with the arena it assigns, so the two can never disagree.

     | sim header | scratch of thread 0.. | state buffers (2, or 3 for Runge-Kutta) | cells | slabs | what modules add |
*/
#include "internal.h"
#include "fluid.h"
#include "kernels.h"

#define SPH_COOKIE 0x53504801u

static const char *const status_texts[SPH_STATUS_COUNT] = {
#define SPH_STATUS_TEXT(name, text) text,
    SPH_STATUS_LIST(SPH_STATUS_TEXT)
#undef SPH_STATUS_TEXT
};
const char *sph_status_text(sph_status s)
{
    return (unsigned)s < SPH_STATUS_COUNT ? status_texts[s] : "unknown status";
}

static const char *const limit_texts[SPH_LIMITS] = {
#define SPH_LIMIT_TEXT(name, text) text,
    SPH_LIMIT_LIST(SPH_LIMIT_TEXT)
#undef SPH_LIMIT_TEXT
};
const char *sph_limit_text(uint32_t limit) { return limit < SPH_LIMITS ? limit_texts[limit] : "unknown"; }

sph_config sph_config_default(void)
{
    sph_config c;
    memset(&c, 0, sizeof c);
    c.cookie = SPH_COOKIE;
    c.max_threads = 1;
    c.on_leave = SPH_FAIL;
    c.on_cross = SPH_FAIL;
    c.kernel = SPH_WENDLAND_C2;
    c.scheme = SPH_STANDARD;
    c.density = SPH_CONTINUITY;
    c.eos = SPH_TAIT;
    c.rho0 = 1000;
    c.viscosity = SPH_ARTIFICIAL;
    c.alpha = 0.01;
    c.delta = 0.1;
    c.damping = 1;
    c.integrator = SPH_PREDICTOR_CORRECTOR;
    c.cfl = 0.25;
    c.viscous_factor = 0.125;
    c.force_factor = 0.25;
    c.gravity_factor = 0.5;
    return c;
}

static sph_status refuse(sph_report *r, const char *what, const char *allowed, double value)
{
    if (r)
        *r = (sph_report){SPH_BAD_CONFIG, what, allowed, "", value, SPH_NO_PARTICLE};
    return SPH_BAD_CONFIG;
}

#define SPH_HUGE 1e30 /* larger magnitudes are refused: squares of them must stay finite in a float's range */

typedef struct range_check {
    const char *what, *allowed;
    double value, low, high;
    bool low_open;
} range_check;

static sph_status check_choices(const sph_config *c, sph_report *r)
{
    const struct {
        const char *what, *allowed;
        uint32_t value, count;
    } list[] = {
        {"kernel", "one of SPH_CUBIC .. SPH_HAT", c->kernel, SPH_KERNELS},
        {"scheme", "one of SPH_STANDARD .. SPH_WEAK_WICK", c->scheme, SPH_SCHEMES},
        {"density", "SPH_CONTINUITY or SPH_SUMMATION", c->density, SPH_DENSITIES},
        {"eos", "one of SPH_TAIT .. SPH_ISOTHERMAL", c->eos, SPH_EOSES},
        {"viscosity", "one of SPH_INVISCID .. SPH_MORRIS", c->viscosity, SPH_VISCOSITIES},
        {"diffusion", "one of SPH_NO_DIFFUSION .. SPH_HYDROSTATIC", c->diffusion, SPH_DIFFUSIONS},
        {"integrator", "one of SPH_PREDICTOR_CORRECTOR .. SPH_RUNGE_KUTTA_MOMENTUM", c->integrator, SPH_INTEGRATORS},
        {"on_leave", "SPH_FAIL or SPH_REMOVE", c->on_leave, SPH_REMOVE + 1},
        {"on_cross", "one of SPH_FAIL .. SPH_IGNORE", c->on_cross, SPH_POLICIES},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        if (list[i].value >= list[i].count)
            return refuse(r, list[i].what, list[i].allowed, list[i].value);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        for (uint32_t s = 0; s < 2; s++)
            if (c->face[k][s] >= SPH_FACES)
                return refuse(r, "face", "one of SPH_OPEN .. SPH_MIRROR_NO_SLIP", c->face[k][s]);
        if ((c->face[k][0] == SPH_PERIODIC) != (c->face[k][1] == SPH_PERIODIC))
            return refuse(r, "face", "SPH_PERIODIC on both faces of an axis or on neither", c->face[k][1]);
    }
    if (c->density == SPH_SUMMATION && (c->diffusion || c->shepard_every))
        return refuse(r, "density", "SPH_CONTINUITY when diffusion or the Shepard filter is on", c->density);
    return SPH_OK;
}

sph_status sph_config_check(const sph_config *c, sph_report *r)
{
    if (!c)
        return refuse(r, "configuration", "a pointer to a configuration", 0);
    if (c->cookie != SPH_COOKIE)
        return refuse(r, "cookie", "a configuration made by sph_config_default of this version", c->cookie);
    const range_check list[] = {
        {"max_particles", "1 .. 2^30", c->max_particles, 1, 1073741824.0, false},
        {"max_threads", "1 .. 256", c->max_threads, 1, 256, false},
        {"spacing", "> 0", c->spacing, 0, SPH_HUGE, true},
        {"smoothing_length", "0.5 .. 10 spacings", c->smoothing_length, 0.5 * c->spacing, 10 * c->spacing, false},
        {"rho0", "> 0", c->rho0, 0, SPH_HUGE, true},
        {"sound_speed", "> 0", c->sound_speed, 0, 1e15, true},
        {"alpha", ">= 0", c->alpha, 0, 1e6, false},
        {"beta", ">= 0", c->beta, 0, 1e6, false},
        {"nu", ">= 0, and > 0 for SPH_MORRIS", c->nu, 0, SPH_HUGE, c->viscosity == SPH_MORRIS},
        {"delta", "0 .. 10", c->delta, 0, 10, false},
        {"xsph", "0 .. 1", c->xsph, 0, 1, false},
        {"damping", "> 0 and <= 1", c->damping, 0, 1, true},
        {"dt", ">= 0 (0: controlled)", c->dt, 0, SPH_HUGE, false},
        {"cfl", "> 0 and <= 10", c->cfl, 0, 10, true},
        {"viscous_factor", "> 0 and <= 10", c->viscous_factor, 0, 10, true},
        {"force_factor", "> 0 and <= 10", c->force_factor, 0, 10, true},
        {"gravity_factor", "> 0 and <= 10", c->gravity_factor, 0, 10, true},
        {"dt_max", ">= 0 (0: none)", c->dt_max, 0, SPH_HUGE, false},
        {"dt_min", ">= 0", c->dt_min, 0, SPH_HUGE, false},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const range_check *e = &list[i];
        if (!(e->value >= e->low && e->value <= e->high) || (e->low_open && e->value == e->low))
            return refuse(r, e->what, e->allowed, e->value);
    }
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (!(sph_abs(c->lo[k]) <= SPH_HUGE))
            return refuse(r, "lo", "finite", c->lo[k]);
        if (!(c->hi[k] > c->lo[k]) || !(c->hi[k] <= SPH_HUGE))
            return refuse(r, "hi", "> lo on every axis, and finite", c->hi[k]);
        if (!(sph_abs(c->gravity[k]) <= 1e15))
            return refuse(r, "gravity", "finite", c->gravity[k]);
    }
    return check_choices(c, r);
}

/* ---- grid ---- */

/* the grid: quantum, extents in quanta, cells at least one support wide */
static sph_status make_grid(sph_sim *s, sph_report *r)
{
    const sph_config *c = &s->cfg;
    s->support = sph_kernel_support(c->kernel) * c->smoothing_length;
    double longest = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        s->length[k] = c->hi[k] - c->lo[k];
        longest = s->length[k] > longest ? s->length[k] : longest;
    }
    if (!(longest < 1e6 * s->support))
        return refuse(r, "hi", "at most 1e6 supports of the kernel from lo", longest);
    double quantum = 1;
    while (quantum * (double)((sph_pos)1 << SPH_POS_BITS) <= longest * 1.000001)
        quantum *= 2;
    while (quantum * (double)((sph_pos)1 << (SPH_POS_BITS - 1)) > longest * 1.000001)
        quantum /= 2;
    s->quantum = quantum;
    s->pos_shift = SPH_POS_BITS - 30;
    double cells = 1;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        s->extent[k] = (sph_pos)(s->length[k] / quantum + 0.5);
        double n = s->length[k] / (s->support * 1.000001);
        s->ncell[k] = n < 1 ? 1 : (uint32_t)n;
        if (c->face[k][0] == SPH_PERIODIC && s->ncell[k] < 3)
            return refuse(r, "hi", "at least three supports from lo along a periodic axis", s->length[k]);
        /* mul is rounded down so that a position at the domain's end still falls into the last cell */
        uint64_t ext = (uint64_t)(s->extent[k] >> s->pos_shift) + 1;
        s->cell_mul[k] = (uint32_t)(((uint64_t)s->ncell[k] << 32) / ext);
        s->cell_size[k] = s->extent[k] / (sph_pos)s->ncell[k];
        cells *= s->ncell[k];
    }
    if (!(cells < 2147483648.0))
        return refuse(r, "hi", "a domain of less than 2^31 cells of one support", cells);
    s->cells = (uint32_t)cells;
    s->slabs = s->ncell[SPH_DIM - 1];
    s->slab_cells = s->cells / s->slabs;
    return SPH_OK;
}

/* ---- the layout function ---- */

typedef struct layout {
    unsigned char *base; /* null: measure only */
    size_t at;
    void (*fn)(void *ctx, const char *name, size_t bytes);
    void *ctx;
} layout;

static void *take(layout *l, const char *name, size_t count, size_t size)
{
    size_t bytes = (count * size + SPH_ALIGN - 1) / SPH_ALIGN * SPH_ALIGN;
    void *p = l->base ? l->base + l->at : NULL;
    l->at += bytes;
    if (l->fn && bytes)
        l->fn(l->ctx, name, bytes);
    return p;
}

static bool uses_rk(const sph_config *c) { return c->integrator >= SPH_RUNGE_KUTTA; }

static void lay_out(sph_sim *s, layout *l)
{
    const sph_config *c = &s->cfg;
    size_t n = (size_t)c->max_particles + SPH_PAD;
    s->set = take(l, "sets", SPH_MAX_SETS, sizeof *s->set);
    s->group = take(l, "wall groups", SPH_MAX_GROUPS, sizeof *s->group);
    s->thread = take(l, "thread scratch", c->max_threads, sizeof(struct sph_thread));
    s->buffers = uses_rk(c) ? 3 : 2;
    for (uint32_t b = 0; b < s->buffers; b++) {
#define SPH_FIELD_TAKE(name, type, comps, unit, when)                                                       \
    for (uint32_t k = 0; k < (comps); k++)                                                                  \
        s->buf[b].name[k] = (when) ? take(l, "state: " #name, n, sizeof(type)) : NULL;
        SPH_STATE_FIELDS(SPH_FIELD_TAKE)
#undef SPH_FIELD_TAKE
    }
    s->cell = take(l, "cell starts", (size_t)s->cells + 2, sizeof *s->cell);
    s->slab = take(l, "slab starts", (size_t)s->slabs + 1, sizeof *s->slab);
    bool filter = c->shepard_every || c->density == SPH_SUMMATION;
    s->tmp = filter ? take(l, "filtered density", n, sizeof *s->tmp) : NULL;
    for (uint32_t k = 0; k < SPH_POWERS; k++)
        s->power[k] = c->books ? take(l, "powers for the books", n, sizeof(sph_real)) : NULL;
    s->partials = c->books ? c->max_particles / SPH_LOCAL_CHUNK + 1 : 0;
    s->partial = c->books ? take(l, "partial sums for the books", s->partials, SPH_POWERS * sizeof(double)) : NULL;
}

/* a simulation that is only good for measuring */
static sph_status measure(sph_sim *s, const sph_config *c, size_t *bytes, sph_report *r)
{
    sph_status st = sph_config_check(c, r);
    if (st)
        return st;
    memset(s, 0, sizeof *s);
    s->cfg = *c;
    if ((st = make_grid(s, r)) != SPH_OK)
        return st;
    layout l = {NULL, 0, NULL, NULL};
    take(&l, "header", 1, sizeof *s);
    lay_out(s, &l);
    *bytes = l.at;
    return SPH_OK;
}

size_t sph_arena_bytes(const sph_config *cfg)
{
    sph_sim s;
    size_t bytes = 0;
    return measure(&s, cfg, &bytes, NULL) == SPH_OK ? bytes : 0;
}

/* ---- arithmetic probe: what the rule of same bits needs from compiler and machine ---- */

static __attribute__((noinline)) sph_real probe_mul(sph_real a, sph_real b) { return a * b; }
static __attribute__((noinline)) sph_real probe_mul_add(sph_real a, sph_real b, sph_real c) { return a * b + c; }
static __attribute__((noinline)) sph_real probe_add3(sph_real a, sph_real b, sph_real c) { return a + b + c; }

/* the name of what is wrong, or null */
static const char *probe_arithmetic(void)
{
    const sph_real eps = SPH_DOUBLE ? (sph_real)2.220446049250313e-16 : (sph_real)1.1920929e-7;
    sph_real e = eps, one = 1;
    /* (1+e)(1-e) = 1 - e^2 rounds to 1; contracted, the sum with -1 keeps -e^2 */
    if (probe_mul_add(one + e, one - e, -one) != 0)
        return "contraction of a*b+c (build with -ffp-contract=off)";
    /* (1 + e/2) + e/2 is 1 twice rounded, 1 + e in excess precision */
    if (probe_add3(one, e / 2, e / 2) != 1)
        return "excess precision (use SSE2 arithmetic on 32-bit x86)";
    sph_real small = SPH_DOUBLE ? (sph_real)2.2250738585072014e-308 : (sph_real)1.17549435e-38f;
    if (probe_mul(small, (sph_real)0.5) == 0)
        return "flush to zero of subnormal numbers";
    return NULL;
}

sph_status sph_init(sph_sim **out, const sph_config *cfg, void *arena, size_t bytes, sph_report *report)
{
    sph_report local = {SPH_OK, "", "", "", 0, SPH_NO_PARTICLE};
    sph_report *r = report ? report : &local;
    *r = (sph_report){SPH_OK, "", "", "", 0, SPH_NO_PARTICLE};
    if (!out) {
        *r = (sph_report){SPH_BAD_ARGUMENT, "sim", "a place for the pointer", "", 0, SPH_NO_PARTICLE};
        return r->status;
    }
    size_t need = 0;
    sph_sim s;
    sph_status st = measure(&s, cfg, &need, r);
    if (st)
        return st;
    const char *broken = probe_arithmetic();
    if (broken)
        *r = (sph_report){SPH_ARITHMETIC, broken, "IEEE 754 as written", "", 0, SPH_NO_PARTICLE};
    else if (!arena || bytes < need)
        *r = (sph_report){SPH_ARENA_TOO_SMALL, "arena", "at least so many bytes as the value says", "", (double)need,
                          SPH_NO_PARTICLE};
    else if ((uintptr_t)arena % SPH_ALIGN)
        *r = (sph_report){SPH_ARENA_UNALIGNED, "arena", "a multiple of SPH_ALIGN", "",
                          (double)((uintptr_t)arena % SPH_ALIGN), SPH_NO_PARTICLE};
    if (r->status)
        return r->status;
    memset(arena, 0, need);
    layout l = {arena, 0, NULL, NULL};
    sph_sim *sim = take(&l, "header", 1, sizeof *sim);
    *sim = s;
    lay_out(sim, &l);
    sim->magic = sph_sim_magic;
    sim->arena_bytes = bytes;
    sim->arena_used = need;
    sim->report = (sph_report){SPH_OK, "", "", "", 0, SPH_NO_PARTICLE};
    sph_make_factors(sim);
    sim->setup_hash = sph_hash_config(&sim->cfg);
    *out = sim;
    return SPH_OK;
}

void sph_arena_report(const sph_sim *sim, void (*fn)(void *ctx, const char *name, size_t bytes), void *ctx)
{
    sph_sim copy = *sim;
    layout l = {NULL, 0, fn, ctx};
    take(&l, "header", 1, sizeof copy);
    lay_out(&copy, &l);
}

void sph_get_usage(const sph_sim *sim, sph_usage *out)
{
    *out = (sph_usage){sim->arena_bytes, sim->arena_used,  sim->mark_particles, sim->cfg.max_particles, sim->cells,
                       sim->mark_cell,   sim->mark_work, sim->mark_slice,     sim->sets,
                       sim->groups};
}

const sph_report *sph_last(const sph_sim *sim) { return &sim->report; }

/* records a failure and tells the host's fault hook */
sph_status sph_error(sph_sim *sim, sph_status s, const char *what, const char *allowed, double value, uint32_t particle)
{
    const char *pass = sim->begun && sim->pc < sim->passes ? sim->program[sim->pc]->name : "";
    sim->report = (sph_report){s, what, allowed, pass, value, particle};
    if (sim->cfg.port.fault)
        sim->cfg.port.fault(sim->cfg.port.ctx, &sim->report);
    return s;
}

sph_status sph_reconfigure(sph_sim *sim, const sph_config *cfg)
{
    sph_report r;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "reconfigure", "between steps", 0, SPH_NO_PARTICLE);
    if (sph_config_check(cfg, &r) != SPH_OK)
        return sph_error(sim, SPH_BAD_CONFIG, r.what, r.allowed, r.value, SPH_NO_PARTICLE);
    /* the digest leaves out what may change */
    if (sph_hash_config(cfg) != sph_hash_config(&sim->cfg) || cfg->max_threads > sim->cfg.max_threads)
        return sph_error(sim, SPH_BAD_CONFIG, "configuration",
                         "unchanged but for gravity, damping, dt and hooks", 0, SPH_NO_PARTICLE);
    uint32_t threads = sim->cfg.max_threads;
    bool same_gravity = sim->cfg.body_force == cfg->body_force;
    for (int k = 0; k < SPH_DIM; k++)
        same_gravity &= !(sim->cfg.gravity[k] < cfg->gravity[k]) && !(sim->cfg.gravity[k] > cfg->gravity[k]);
    sim->cfg = *cfg;
    sim->cfg.max_threads = threads;
    sph_make_factors(sim);
    if (!same_gravity)
        sim->now.primed = false; /* the stored forces are of the old gravity */
    return SPH_OK;
}
