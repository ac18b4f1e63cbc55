/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* layout.c: configuration checks and the arena. One function lays every array out; run with a null base it measures,
   run with the arena it assigns, so the two can never disagree.

     | sim header | scratch of thread 0.. | state buffers (2, or 3 for Runge-Kutta) | cells | slabs | what modules add |
*/
#include "internal.h"
#include "fluid.h"
#include "kernels.h"
#include "sweep.h"

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
    c.max_sets = SPH_MAX_SETS;
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
    c.stress_exponent = 4;
    c.stress_epsilon = 0.3;
    c.max_stretch = 1.25;
    return c;
}

static __attribute__((noinline)) sph_status refuse(sph_report *r, const char *what, const char *allowed, double value)
{
    if (r)
        *r = (sph_report){SPH_BAD_CONFIG, what, allowed, "", value, SPH_NO_PARTICLE};
    return SPH_BAD_CONFIG;
}

#define SPH_HUGE 1e30f /* larger magnitudes are refused: squares of them must stay finite in a float's range */

/* What each number may be. A table of places, not of values: it stays in read-only memory. Bounds are floats, which hold
   all of them. */
typedef struct range_check {
    const char *what, *allowed;
    uint16_t at;   /* offset in sph_config */
    uint8_t kind;  /* WHOLE: a uint32_t; else a double, or SPH_DIM of them */
    bool low_open; /* the low bound itself is not allowed */
    float low, high;
} range_check;

enum { WHOLE, REAL, VECTOR };
#define AT(member) offsetof(sph_config, member)
static const range_check ranges[] = {
    {"max_particles", "1 .. 2^30", AT(max_particles), WHOLE, false, 1, 1073741824.0f},
    {"max_threads", "1 .. 256", AT(max_threads), WHOLE, false, 1, 256},
    {"max_sets", "1 .. SPH_MAX_SETS", AT(max_sets), WHOLE, false, 1, SPH_MAX_SETS},
    {"spacing", "1e-30 .. 1e30", AT(spacing), REAL, false, 1 / SPH_HUGE, SPH_HUGE},
    {"smoothing_length", "0.5 .. 10 spacings", AT(smoothing_length), REAL, true, 0, SPH_HUGE},
    {"rho0", "1e-30 .. 1e30", AT(rho0), REAL, false, 1 / SPH_HUGE, SPH_HUGE},
    {"sound_speed", "1e-15 .. 1e15", AT(sound_speed), REAL, false, 1e-15f, 1e15f},
    {"alpha", ">= 0", AT(alpha), REAL, false, 0, 1e6f},
    {"beta", ">= 0", AT(beta), REAL, false, 0, 1e6f},
    {"nu", ">= 0, and > 0 for SPH_MORRIS", AT(nu), REAL, false, 0, SPH_HUGE},
    {"delta", "0 .. 10", AT(delta), REAL, false, 0, 10},
    {"xsph", "0 .. 1", AT(xsph), REAL, false, 0, 1},
    {"damping", "> 0 and <= 1", AT(damping), REAL, true, 0, 1},
    {"dt", ">= 0 (0: controlled)", AT(dt), REAL, false, 0, SPH_HUGE},
    {"cfl", "> 0 and <= 10", AT(cfl), REAL, true, 0, 10},
    {"viscous_factor", "> 0 and <= 10", AT(viscous_factor), REAL, true, 0, 10},
    {"force_factor", "> 0 and <= 10", AT(force_factor), REAL, true, 0, 10},
    {"gravity_factor", "> 0 and <= 10", AT(gravity_factor), REAL, true, 0, 10},
    {"dt_max", ">= 0 (0: none)", AT(dt_max), REAL, false, 0, SPH_HUGE},
    {"dt_min", ">= 0", AT(dt_min), REAL, false, 0, SPH_HUGE},
    {"stress_exponent", "1 .. 8", AT(stress_exponent), WHOLE, false, 1, 8},
    {"stress_epsilon", "0 .. 10", AT(stress_epsilon), REAL, false, 0, 10},
    {"max_stretch", "1 .. 8", AT(max_stretch), REAL, false, 1, 8},
    {"lo", "finite", AT(lo), VECTOR, false, -SPH_HUGE, SPH_HUGE},
    {"hi", "at least a spacing above lo on every axis, and finite", AT(hi), VECTOR, false, -SPH_HUGE, SPH_HUGE},
    {"gravity", "finite", AT(gravity), VECTOR, false, -1e15f, 1e15f},
};

static double number_at(const sph_config *c, const range_check *e, uint32_t k)
{
    const unsigned char *p = (const unsigned char *)c + e->at;
    uint32_t u;
    double d;
    if (e->kind == WHOLE) {
        memcpy(&u, p, sizeof u);
        return u;
    }
    memcpy(&d, p + k * sizeof d, sizeof d);
    return d;
}

static sph_status check_numbers(const sph_config *c, sph_report *r)
{
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        for (uint32_t k = 0; k < (ranges[i].kind == VECTOR ? SPH_DIM : 1); k++) {
            const range_check *e = &ranges[i];
            const double v = number_at(c, e, k), low = (double)e->low;
            if (!(v >= low && v <= (double)e->high) || (e->low_open && !(v > low)))
                return refuse(r, e->what, e->allowed, v);
        }
    if (c->port.parallel && c->port.threads > c->max_threads)
        return refuse(r, "port.threads", "at most max_threads", c->port.threads);
    if (!(c->smoothing_length >= 0.5 * c->spacing && c->smoothing_length <= 10 * c->spacing))
        return refuse(r, "smoothing_length", "0.5 .. 10 spacings", c->smoothing_length);
    if (SPH_IS(c->viscosity, MORRIS) && !(c->nu > 0))
        return refuse(r, "nu", ">= 0, and > 0 for SPH_MORRIS", c->nu);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (!(c->hi[k] - c->lo[k] >= c->spacing)) /* an axis of nearly no length would have no quanta */
            return refuse(r, "hi", "at least a spacing above lo on every axis, and finite", c->hi[k]);
    return SPH_OK;
}

#define SPH_LEFT_OUT "a choice that was compiled in (modules.h)"

/* modules that are asked for by more than the value of a choice */
static sph_status check_modules(const sph_config *c, sph_report *r)
{
    const char *what = NULL;
    if (!SPH_WITH_XSPH && c->xsph != 0)
        what = "xsph";
    if (!SPH_WITH_SHEPARD && c->shepard_every)
        what = "shepard_every";
    if (!SPH_WITH_BOOKS && c->books)
        what = "books";
    if (!SPH_WITH_BODY_FORCE && c->body_force)
        what = "body_force";
    if (!SPH_WITH_STAGE_LOG && c->stage_log)
        what = "stage_log";
    if (!SPH_HAS_HAT && c->xsph_strain)
        what = "xsph_strain";
    if (what)
        return refuse(r, what, SPH_LEFT_OUT, 1);
    if (SPH_IS(c->density, SUMMATION) && (c->diffusion || c->shepard_every))
        return refuse(r, "density", "SPH_CONTINUITY when diffusion or the Shepard filter is on", c->density);
    return SPH_OK;
}

/* what the choices of solids ask of each other */
static sph_status check_solids(const sph_config *c, sph_report *r)
{
    const bool solid = sph_has_solids(c);
    if (!SPH_WITH_SOLID) /* whatever they ask for was refused as left out */
        return SPH_OK;
    if (!solid && (c->yield || c->damage || c->artificial_stress || c->xsph_strain))
        return refuse(r, "solid", "a solid form, where yield, damage, artificial_stress or xsph_strain is on", c->solid);
    if (!solid)
        return SPH_OK;
    if (c->scheme != SPH_STANDARD && c->scheme != SPH_WEAK)
        return refuse(r, "scheme", "SPH_STANDARD or SPH_WEAK with solids", c->scheme);
    if (c->density != SPH_CONTINUITY || c->shepard_every)
        return refuse(r, "density", "SPH_CONTINUITY, without the Shepard filter, with solids", c->density);
    if (sph_is_total(c) && c->artificial_stress)
        return refuse(r, "artificial_stress", "none with SPH_TOTAL", c->artificial_stress);
    if (c->xsph_strain && !(c->xsph > 0))
        return refuse(r, "xsph", "> 0 where xsph_strain is on", c->xsph);
    if (sph_damages(c) && (c->max_flaws < 1 || c->max_flaws > 1u << 30))
        return refuse(r, "max_flaws", "1 .. 2^30 with damage", c->max_flaws);
    return SPH_OK;
}

static sph_status check_faces(const sph_config *c, sph_report *r)
{
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        for (uint32_t s = 0; s < 2; s++)
            if (!sph_in(SPH_FACES_IN, c->face[k][s]))
                return refuse(r, "face", c->face[k][s] >= SPH_FACES ? "one of SPH_OPEN .. SPH_MIRROR_NO_SLIP" : SPH_LEFT_OUT,
                              c->face[k][s]);
        if (SPH_WITH_PERIODIC && (c->face[k][0] == SPH_PERIODIC) != (c->face[k][1] == SPH_PERIODIC))
            return refuse(r, "face", "SPH_PERIODIC on both faces of an axis or on neither", c->face[k][1]);
    }
    return SPH_OK;
}

static const struct {
    const char *what, *allowed;
    uint16_t at;
    uint8_t count, in; /* how many there are, and which were compiled in, as bits */
} choices[] = {
    {"kernel", "one of SPH_CUBIC .. SPH_HAT", AT(kernel), SPH_KERNELS, SPH_KERNELS_IN},
    {"scheme", "one of SPH_STANDARD .. SPH_WEAK_WICK", AT(scheme), SPH_SCHEMES, SPH_SCHEMES_IN},
    {"density", "SPH_CONTINUITY or SPH_SUMMATION", AT(density), SPH_DENSITIES,
     1 << SPH_CONTINUITY | SPH_WITH_SUMMATION << SPH_SUMMATION},
    {"eos", "one of SPH_TAIT .. SPH_ISOTHERMAL", AT(eos), SPH_EOSES, SPH_EOSES_IN},
    {"viscosity", "one of SPH_INVISCID .. SPH_MORRIS", AT(viscosity), SPH_VISCOSITIES, SPH_VISCOSITIES_IN},
    {"diffusion", "one of SPH_NO_DIFFUSION .. SPH_HYDROSTATIC", AT(diffusion), SPH_DIFFUSIONS,
     1 << SPH_NO_DIFFUSION | SPH_WITH_MOLTENI << SPH_MOLTENI | SPH_WITH_HYDROSTATIC << SPH_HYDROSTATIC},
    {"integrator", "one of SPH_PREDICTOR_CORRECTOR .. SPH_RUNGE_KUTTA_MOMENTUM", AT(integrator), SPH_INTEGRATORS,
     SPH_INTEGRATORS_IN},
    {"solid", "one of SPH_NO_SOLID .. SPH_TOTAL", AT(solid), SPH_SOLIDS, SPH_SOLIDS_IN},
    {"yield", "one of SPH_NO_YIELD .. SPH_VON_MISES_GRAY", AT(yield), SPH_YIELDS, SPH_YIELDS_IN},
    {"damage", SPH_DIM == 1 ? "SPH_NO_DAMAGE in 1-D" : "one of SPH_NO_DAMAGE .. SPH_BENZ_ASPHAUG_GRAY", AT(damage),
     SPH_DIM == 1 ? 1 : SPH_DAMAGES, SPH_DAMAGES_IN},
    {"artificial_stress", "one of SPH_NO_ARTIFICIAL_STRESS .. SPH_COMPONENTS", AT(artificial_stress), SPH_ARTIFICIAL_STRESSES,
     SPH_REPULSIONS_IN},
    {"on_leave", "SPH_FAIL or SPH_REMOVE", AT(on_leave), SPH_REMOVE + 1, 1 << SPH_FAIL | 1 << SPH_REMOVE},
    {"on_cross", "one of SPH_FAIL .. SPH_IGNORE", AT(on_cross), SPH_POLICIES, (1 << SPH_POLICIES) - 1},
};

static sph_status check_choices(const sph_config *c, sph_report *r)
{
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++) {
        uint32_t v;
        memcpy(&v, (const unsigned char *)c + choices[i].at, sizeof v);
        if (!sph_in(choices[i].in, v))
            return refuse(r, choices[i].what, v >= choices[i].count ? choices[i].allowed : SPH_LEFT_OUT, v);
    }
    sph_status st = check_faces(c, r);
    if (!st)
        st = check_modules(c, r);
    return st ? st : check_solids(c, r);
}
#undef AT

sph_status sph_config_check(const sph_config *c, sph_report *r)
{
    if (!c)
        return refuse(r, "configuration", "a pointer to a configuration", 0);
    if (c->cookie != SPH_COOKIE)
        return refuse(r, "cookie", "a configuration made by sph_config_default of this version", c->cookie);
    sph_status st = check_numbers(c, r);
    return st ? st : check_choices(c, r);
}

/* ---- grid ---- */

/* the grid: quantum, extents in quanta, cells at least one support wide */
static sph_status make_grid(const sph_config *c, sph_grid *s, sph_report *r)
{
    s->support = sph_kernel_support(c->kernel) * c->smoothing_length;
    const double cell = sph_is_total(c) ? s->support * c->max_stretch : s->support; /* at least so wide */
    double longest = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        s->length[k] = c->hi[k] - c->lo[k];
        longest = s->length[k] > longest ? s->length[k] : longest;
    }
    if (!(longest < 1e6 * s->support))
        return refuse(r, "hi", "at most 1e6 supports of the kernel from lo", longest);
    /* the power of two of which the longest axis has 2^(SPH_POS_BITS - 1) or more, but less than twice as many */
    const double most = longest * 1.000001 / (double)((sph_pos)1 << (SPH_POS_BITS - 1));
    double quantum = 1;
    while (quantum * 2 <= most)
        quantum *= 2;
    while (quantum > most)
        quantum /= 2;
    s->quantum = quantum;
    s->pos_shift = SPH_POS_BITS - 30;
    double cells = 1;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        s->extent[k] = (sph_pos)(s->length[k] / quantum + 0.5);
        double n = s->length[k] / (cell * 1.000001);
        s->ncell[k] = n < 1 ? 1 : (uint32_t)n;
        if (SPH_IS(c->face[k][0], PERIODIC) && s->ncell[k] < 3)
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
    bool over; /* more than this machine can address */
} layout;

static void *take(layout *l, const char *name, size_t count, size_t size)
{
    if (count > (SIZE_MAX / 2 - l->at - SPH_ALIGN) / size) {
        l->over = true;
        return NULL;
    }
    size_t bytes = (count * size + SPH_ALIGN - 1) / SPH_ALIGN * SPH_ALIGN;
    void *p = l->base ? l->base + l->at : NULL;
    l->at += bytes;
    if (l->fn && bytes)
        l->fn(l->ctx, name, bytes);
    return p;
}

static bool uses_rk(const sph_config *c) { return SPH_HAS_RUNGE_KUTTA && c->integrator >= SPH_RUNGE_KUTTA; }

/* one array of the simulation; s null: measure only */
#define SPH_PLACE(member, name, count, size)                                                                \
    do {                                                                                                    \
        void *place = take(l, name, count, size);                                                           \
        if (s)                                                                                              \
            s->member = place;                                                                              \
    } while (0)

static const struct {
    const char *name;
    uint8_t at, comps, bytes; /* number of its first pointer in sph_buffer, components, bytes of an element */
} state_fields[] = {
#define SPH_FIELD_ROW(name, type, comps, unit, when, way)                                                        \
    {"state: " #name, offsetof(sph_buffer, name) / sizeof(void *), comps, sizeof(type)},
    SPH_STATE_FIELDS(SPH_FIELD_ROW)
#undef SPH_FIELD_ROW
};

static void lay_out_state(const sph_config *c, sph_sim *s, uint32_t b, layout *l)
{
    uint32_t wanted = 0, bit = 0; /* a bit for each field */
#define SPH_FIELD_WANTED(name, type, comps, unit, when, way) wanted |= (uint32_t)(when) << bit++;
    SPH_STATE_FIELDS(SPH_FIELD_WANTED)
#undef SPH_FIELD_WANTED
    for (uint32_t f = 0; f < bit; f++)
        for (uint32_t k = 0; wanted >> f & 1 && k < state_fields[f].comps; k++) {
            void *p = take(l, state_fields[f].name, (size_t)c->max_particles + SPH_PAD, state_fields[f].bytes);
            if (s)
                memcpy((unsigned char *)&s->buf[b] + (state_fields[f].at + k) * sizeof p, &p, sizeof p);
        }
}

/* where a thread keeps the column sets that the scene wants; returns their reals. s null: measure only */
static uint32_t place_columns(const sph_config *c, sph_sim *s)
{
    uint32_t at = 0;
    (void)c;
#define SPH_COLUMN_PLACE(name, ghosts, rows, knob, when)                                                           \
    if (s)                                                                                                         \
        s->extra_at[SPH_COLUMN_##name] = at;                                                                       \
    at += (knob) && (when) ? (rows) * (SPH_TILE_ROOM + ((ghosts) ? 0 : SPH_HOME_ROOM)) : 0;
    SPH_COLUMN_SETS(SPH_COLUMN_PLACE)
#undef SPH_COLUMN_PLACE
    if (s)
        s->extra_reals = at;
    return at;
}

/* everything but the header; s null: measure only */
static void lay_out(const sph_config *c, const sph_grid *g, sph_sim *s, layout *l)
{
    const size_t n = (size_t)c->max_particles + SPH_PAD;
    const uint32_t buffers = uses_rk(c) ? 3 : 2, partials = c->max_particles / SPH_LOCAL_CHUNK + 1;
    SPH_PLACE(set, "sets", c->max_sets, sizeof(sph_set));
    SPH_PLACE(group, "wall groups", SPH_MAX_GROUPS, sizeof(sph_group));
    SPH_PLACE(thread, "thread scratch", c->max_threads, sizeof(struct sph_thread));
    if (sph_has_solids(c)) {
        SPH_PLACE(material, "materials", c->max_sets, sizeof(sph_material));
    }
    SPH_PLACE(extra, "thread scratch of columns", (size_t)c->max_threads * place_columns(c, s), sizeof(sph_real));
    for (uint32_t b = 0; b < buffers; b++)
        lay_out_state(c, s, b, l);
    SPH_PLACE(cell, "cell starts", (size_t)g->cells + 2, sizeof(uint32_t));
    SPH_PLACE(slab, "slab starts", (size_t)g->slabs + 1, sizeof(uint32_t));
    if (sph_filters(c) || sph_sums_density(c))
        SPH_PLACE(tmp, "filtered density", n, sizeof(sph_real));
    for (uint32_t k = 0; k < SPH_NL && sph_corrects(c); k++)
        SPH_PLACE(corr[k], "gradient correction", n, sizeof(sph_real));
    if (sph_damages(c)) {
        SPH_PLACE(flaw_start, "flaws of a particle", (size_t)c->max_particles + 1, sizeof(uint32_t));
        SPH_PLACE(flaw, "flaws", c->max_flaws, sizeof(float));
    }
    if (sph_keeps_books(c)) {
        for (uint32_t k = 0; k < SPH_POWERS; k++)
            SPH_PLACE(power[k], "powers for the books", n, sizeof(sph_real));
        SPH_PLACE(partial, "partial sums for the books", partials, SPH_PARTIALS * sizeof(double));
    }
    if (s)
        s->buffers = buffers;
}

/* the grid and the bytes that a configuration needs */
static sph_status measure(const sph_config *c, sph_grid *g, size_t *bytes, sph_report *r)
{
    sph_status st = sph_config_check(c, r);
    if (!st)
        st = make_grid(c, g, r);
    if (st)
        return st;
    layout l = {NULL, 0, NULL, NULL, false};
    take(&l, "header", 1, sizeof(sph_sim));
    lay_out(c, g, NULL, &l);
    *bytes = l.at;
    return l.over ? refuse(r, "max_particles", "an arena that this machine can address", c->max_particles) : SPH_OK;
}

size_t sph_arena_bytes(const sph_config *cfg)
{
    sph_grid g;
    size_t bytes = 0;
    return measure(cfg, &g, &bytes, NULL) == SPH_OK ? bytes : 0;
}

/* ---- arithmetic probe: what the rule of same bits needs from compiler and machine ---- */

/* the name of what is wrong, or null */
static const char *probe_arithmetic(void)
{
#ifdef SPH_NO_PROBE /* only to show with tests/firstdiff.sh what a broken build does */
    return NULL;
#endif
    /* the operands come from volatile memory, so that no compiler can do the sums itself */
    volatile sph_real v_one = 1, v_half = (sph_real)0.5, v_eps = SPH_DOUBLE ? (sph_real)2.220446049250313e-16 : (sph_real)1.1920929e-7;
    volatile sph_real v_least = SPH_DOUBLE ? (sph_real)2.2250738585072014e-308 : (sph_real)1.17549435e-38f;
    const sph_real one = v_one, e = v_eps, up = one + e, down = one - e, half = e * v_half;
    /* (1 + e/2) + e/2 is 1 twice rounded, 1 + e in excess precision */
    if (one + half + half != 1)
        return "excess precision (use SSE2 arithmetic on 32-bit x86)";
    /* (1+e)(1-e) = 1 - e^2 rounds to 1; contracted (or in excess precision, so that comes first), the sum with -1 keeps -e^2 */
    if (up * down + -one != 0)
        return "contraction of a*b+c (build with -ffp-contract=off)";
    if (v_least * v_half == 0)
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
    sph_grid grid;
    sph_status st = measure(cfg, &grid, &need, r);
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
    layout l = {arena, 0, NULL, NULL, false};
    sph_sim *sim = take(&l, "header", 1, sizeof *sim);
    sim->cfg = *cfg;
    sim->grid = grid;
    lay_out(cfg, &grid, sim, &l);
    sim->magic = sph_sim_magic;
    sim->arena_bytes = bytes;
    sim->arena_used = need;
    sim->report = (sph_report){SPH_OK, "", "", "", 0, SPH_NO_PARTICLE};
    sim->columns = sph_column_table;
    sph_make_factors(sim);
    sim->setup_hash = sph_hash_config(&sim->cfg);
    *out = sim;
    return SPH_OK;
}

void sph_arena_report(const sph_sim *sim, void (*fn)(void *ctx, const char *name, size_t bytes), void *ctx)
{
    if (!sim || !fn)
        return;
    layout l = {NULL, 0, fn, ctx, false};
    take(&l, "header", 1, sizeof *sim);
    lay_out(&sim->cfg, &sim->grid, NULL, &l);
}

void sph_get_usage(const sph_sim *sim, sph_usage *out)
{
    if (!sim || !out)
        return;
    *out = (sph_usage){sim->arena_bytes, sim->arena_used,  sim->mark_particles, sim->cfg.max_particles, sim->grid.cells,
                       sim->mark_cell,   sim->mark_work,  sim->mark_slice,    sim->sets,              sim->groups};
}

const sph_report *sph_last(const sph_sim *sim)
{
    static const sph_report none = {SPH_BAD_ARGUMENT, "sim", "a simulation made by sph_init", "", 0, SPH_NO_PARTICLE};
    return sim ? &sim->report : &none;
}

/* records a failure and tells the host's fault hook */
sph_status sph_error(sph_sim *sim, sph_status s, const char *what, const char *allowed, double value, uint32_t particle)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    const char *pass = sim->begun && sim->pc < sim->passes ? sim->program[sim->pc]->name : "";
    sim->report = (sph_report){s, what, allowed, pass, value, particle};
    if (sim->cfg.port.fault)
        sim->cfg.port.fault(sim->cfg.port.ctx, &sim->report);
    return s;
}

sph_status sph_reconfigure(sph_sim *sim, const sph_config *cfg)
{
    sph_report r;
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "reconfigure", "between steps", 0, SPH_NO_PARTICLE);
    if (sph_config_check(cfg, &r) != SPH_OK)
        return sph_error(sim, SPH_BAD_CONFIG, r.what, r.allowed, r.value, SPH_NO_PARTICLE);
    /* the digest leaves out what may change */
    if (sph_hash_config(cfg) != sph_hash_config(&sim->cfg) || cfg->max_threads > sim->cfg.max_threads)
        return sph_error(sim, SPH_BAD_CONFIG, "configuration",
                         "unchanged but for gravity, damping, dt and hooks", 0, SPH_NO_PARTICLE);
    const uint32_t threads = sim->cfg.max_threads, sets = sim->cfg.max_sets;
    bool same_gravity = sim->cfg.body_force == cfg->body_force;
    for (int k = 0; k < SPH_DIM; k++)
        same_gravity &= !(sim->cfg.gravity[k] < cfg->gravity[k]) && !(sim->cfg.gravity[k] > cfg->gravity[k]);
    sim->cfg = *cfg;
    sim->cfg.max_threads = threads;
    sim->cfg.max_sets = sets;
    sph_make_factors(sim);
    if (!same_gravity)
        sim->now.primed = false; /* the stored forces are of the old gravity */
    return SPH_OK;
}
