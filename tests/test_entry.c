/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_entry.c: every function of sph.h, in every state of a simulation, with null, zero, huge, negative, subnormal,
   infinite and not-a-number arguments. A call that fails returns a status that the manual gives, leaves state, set-up
   and configuration bit for bit as they were, and writes to none of its results. One row a function: tests/entries.sh
   compares the table with the header. */
#include "testing.h"

#include "state.h"

static const double wild[] = {0.0, -0.0, -1, 5e-324, 1e-310, -1e-310, 1e15, 1e30, -1e30, 1e300, -1e300, 3.5e38,
                              1.7976931348623157e308};
enum { WILD = sizeof wild / sizeof *wild + 3 }; /* and the three that are no numbers */
static double wild_number(uint32_t k)
{
    return k + 3 < WILD ? wild[k] : k + 3 == WILD ? NAN : k + 2 == WILD ? INFINITY : -INFINITY;
}
static const uint32_t wild_words[] = {0, 1, 2, 3, 63, 64, 255, 256, 65536, 0x7fffffffu, 0x80000000u, 0xffffffffu};
#define EACH_WORD(w) for (uint32_t i_ = 0, w = 0; i_ < sizeof wild_words / 4 && (w = wild_words[i_], true); i_++)
#define EACH_NUMBER(x) for (uint32_t k_ = 0; k_ < WILD; k_++) for (double x = wild_number(k_), *o_ = &x; o_; o_ = NULL)

/* ---- the bed: a simulation in a given state, put back after every call ---- */

enum { EMPTY, FILLED, READY, STEPPED, SLICED, FAILED, STATES };
static const char *const state_names[] = {"empty", "filled", "ready", "stepped", "between slices", "after a failure"};

static struct {
    sph_sim *sim;
    sph_config cfg;
    unsigned char *image;
    size_t bytes;
    uint32_t state;
    bool rock; /* a damaged, yielding solid instead of water */
    const char *row;
    uint32_t refused, taken;
} bed;

static unsigned char out[4096]; /* results go here, so that a stray write is seen */
#define OUT(type) ((type *)(void *)out)

static bool poisoned;
static void poison(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)x, (void)v;
    a[0] = poisoned ? NAN : a[0];
}

static sph_config bed_config(void)
{
    sph_config c = open_config(1, 0.25);
    c.max_particles = SPH_DIM == 3 ? 500 : 120;
    c.gravity[SPH_DIM - 1] = -9.81;
    c.body_force = poison;
    c.on_leave = SPH_REMOVE;
    c.on_cross = SPH_PUT_BACK;
    if (bed.rock) {
        c.solid = SPH_CORRECTED;
        c.yield = SPH_VON_MISES;
        c.damage = SPH_DIM > 1 ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
        c.max_flaws = 4000;
    }
    return c;
}

static void fill_bed(void)
{
    sph_wall w = sph_wall_default();
    const sph_solid rock = {.shear = 1e5, .yield = 1e4};
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    uint32_t set;
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 1;
    if (bed.rock)
        must(bed.sim, sph_add_solid(bed.sim, &rock, &set, NULL));
    else
        must(bed.sim, sph_add_fluid(bed.sim, NULL, &set));
    must(bed.sim, sph_add_box(bed.sim, set, lo, hi, NULL));
    must(bed.sim, sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, NULL));
}

static void make_bed(uint32_t state)
{
    bed.cfg = bed_config();
    bed.sim = new_sim(&bed.cfg);
    bed.bytes = sims[sim_count - 1].bytes;
    bed.state = state;
    poisoned = false;
    if (state >= FILLED)
        fill_bed();
    if (state >= READY)
        must(bed.sim, sph_ready(bed.sim));
    if (state >= STEPPED)
        must(bed.sim, sph_step(bed.sim));
    for (int k = 0; state == SLICED && k < 5; k++)
        assert_int_equal(sph_step_slice(bed.sim, 1), SPH_NOT_DONE);
    if (state == FAILED) {
        poisoned = true;
        assert_int_equal(sph_step(bed.sim), SPH_NOT_FINITE);
        poisoned = false;
    }
    bed.image = malloc(bed.bytes);
    assert_non_null(bed.image);
    memcpy(bed.image, sims[sim_count - 1].arena, bed.bytes);
}

static void unmake_bed(void)
{
    free(bed.image);
    assert_int_equal(free_sims(NULL), 0);
}

/* what a call must not change; everything else is put back as it was for the next one */
static struct {
    snapshot s;
    bool begun;
    uint32_t pc, chunk;
} before;
static void begin_call(void)
{
    memset(out, 0xa5, sizeof out);
    keep_state(bed.sim, &before.s);
    before.begun = bed.sim->begun;
    before.pc = bed.sim->pc;
    before.chunk = bed.sim->chunk;
}
static void end_call(sph_status st, const char *text)
{
    if ((unsigned)st >= SPH_STATUS_COUNT)
        fail_msg("%s, %s: %s: status %u", bed.row, state_names[bed.state], text, (unsigned)st);
    const bool same = state_kept(bed.sim, &before.s) && bed.sim->begun == before.begun &&
                      (!before.begun || (bed.sim->pc == before.pc && bed.sim->chunk == before.chunk));
    bool clean = true;
    for (size_t i = 0; i < sizeof out; i++)
        clean &= out[i] == 0xa5;
    if (st != SPH_OK && st != SPH_NOT_DONE && !same)
        fail_msg("%s, %s: %s: refused (%s), but the simulation has changed", bed.row, state_names[bed.state], text,
                 sph_status_text(st));
    if (st != SPH_OK && !clean)
        fail_msg("%s, %s: %s: refused (%s), but a result was written", bed.row, state_names[bed.state], text,
                 sph_status_text(st));
    if (bed.state == SLICED && st == SPH_OK && !same)
        fail_msg("%s, %s: %s: changed the state under a step", bed.row, state_names[bed.state], text);
    bed.refused += st != SPH_OK;
    bed.taken += st == SPH_OK;
    memcpy(sims[sim_count - 1].arena, bed.image, bed.bytes);
}
/* any status; refused: not SPH_OK; with_status: this one */
#define attempt(call) (begin_call(), end_call(call, #call))
#define with_status(call, want)                                                                             \
    do {                                                                                                    \
        begin_call();                                                                                       \
        const sph_status st_ = (call);                                                                      \
        end_call(st_, #call);                                                                               \
        if (st_ != (want))                                                                                  \
            fail_msg("%s, %s: %s: %s", bed.row, state_names[bed.state], #call, sph_status_text(st_));       \
    } while (0)
#define refused(call)                                                                                       \
    do {                                                                                                    \
        begin_call();                                                                                       \
        const sph_status st_ = (call);                                                                      \
        end_call(st_, #call);                                                                               \
        if (st_ == SPH_OK || st_ == SPH_NOT_DONE)                                                           \
            fail_msg("%s, %s: %s was not refused", bed.row, state_names[bed.state], #call);                 \
    } while (0)
/* set-up and settings in the middle of a step; set-up after it */
#define no_sim(call) with_status(call, SPH_BAD_ARGUMENT)
/* a call that sets up must be refused in the states where nothing can be added */
#define if_adding(call, want) with_status(call, bed.state == EMPTY || bed.state == FILLED ? (want) : SPH_BAD_STATE)
#define if_idle(call, want) with_status(call, bed.state != SLICED ? (want) : SPH_BAD_STATE)
#define finite(x) ((x) - (x) == 0)

/* ---- configuration and life ---- */

static void row_status_text(void)
{
    EACH_WORD(w)
        assert_true(strlen(sph_status_text((sph_status)w)) > 1);
}
static void row_limit_text(void)
{
    EACH_WORD(w)
        assert_true(strlen(sph_limit_text(w)) > 1);
}
static void row_config_default(void)
{
    const sph_config c = sph_config_default();
    assert_int_equal(sph_config_check(&c, NULL), SPH_BAD_CONFIG); /* capacity and spacing must be given */
}

/* the numbers and words of a configuration */
enum { PLAIN = 19, CHOICES = 20, NUMBERS = PLAIN + 3 * SPH_DIM, WORDS = CHOICES + 2 * SPH_DIM };
static double *number_of(sph_config *c, uint32_t i)
{
    double *const list[] = {&c->spacing, &c->smoothing_length, &c->rho0, &c->sound_speed, &c->alpha, &c->beta, &c->nu,
                            &c->delta,
                            &c->xsph, &c->damping, &c->dt, &c->cfl, &c->viscous_factor, &c->force_factor,
                            &c->gravity_factor,
                            &c->dt_max, &c->dt_min, &c->stress_epsilon, &c->max_stretch};
    const uint32_t k = (i - PLAIN) / 3;
    return i < PLAIN ? list[i] : (i - PLAIN) % 3 == 0 ? &c->lo[k] : (i - PLAIN) % 3 == 1 ? &c->hi[k] : &c->gravity[k];
}
static uint32_t *word_of(sph_config *c, uint32_t i)
{
    uint32_t *const list[] = {&c->cookie, &c->max_particles, &c->max_threads, &c->on_leave, &c->on_cross, &c->kernel,
                              &c->scheme,
                              &c->density, &c->eos, &c->viscosity, &c->diffusion, &c->shepard_every, &c->integrator,
                              &c->port.threads, &c->solid, &c->yield, &c->damage, &c->max_flaws, &c->artificial_stress,
                              &c->stress_exponent};
    return i < CHOICES ? list[i] : &c->face[(i - CHOICES) / 2][(i - CHOICES) % 2];
}

/* what check, arena_bytes, init and reconfigure say about one configuration must agree */
static void agree(const sph_config *c)
{
    sph_report r;
    const size_t bytes = sph_arena_bytes(c);
    sph_status st = sph_config_check(c, &r);
    assert_true(st == SPH_OK || (st == SPH_BAD_CONFIG && bytes == 0 && strlen(r.what) > 1 && strlen(r.allowed) > 1));
    sph_sim *none = NULL;
    st = sph_init(&none, c, NULL, 0, &r);
    assert_true(none == NULL && st == r.status && st == (bytes ? SPH_ARENA_TOO_SMALL : SPH_BAD_CONFIG));
    attempt(sph_reconfigure(bed.sim, c));
}
static void row_config_check(void)
{
    sph_report r;
    shuffle order;
    sph_config many = bed.cfg;
    many.port = shuffle_port(&order, bed.cfg.max_threads + 1); /* more threads than scratch */
    assert_int_equal(sph_config_check(&many, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "port.threads");
    assert_int_equal(sph_config_check(NULL, &r), SPH_BAD_CONFIG);
    for (int k = 0; k < SPH_DIM; k++) { /* an axis that is finite and upright, but nearly no length */
        sph_config thin = bed.cfg;
        thin.hi[k] = thin.lo[k] + 0.9 * thin.spacing;
        assert_int_equal(sph_config_check(&thin, &r), SPH_BAD_CONFIG);
        assert_string_equal(r.what, "hi");
    }
    for (uint32_t i = 0; i < NUMBERS; i++)
        EACH_NUMBER(x) {
            sph_config c = bed.cfg;
            *number_of(&c, i) = x;
            agree(&c);
            if (!finite(x))
                assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
        }
    for (uint32_t i = 0; i < WORDS; i++)
        EACH_WORD(w) {
            sph_config c = bed.cfg;
            *word_of(&c, i) = w;
            agree(&c);
        }
}
static void row_arena_bytes(void) { assert_true(sph_arena_bytes(NULL) == 0 && sph_arena_bytes(&bed.cfg) == bed.bytes); }

static void row_init(void)
{
    sph_report r;
    sph_sim *sim = NULL;
    unsigned char *block = aligned_alloc(SPH_ALIGN, bed.bytes + 2 * SPH_ALIGN);
    memset(block, GUARD_BYTE, bed.bytes + 2 * SPH_ALIGN);
    assert_int_equal(sph_init(NULL, &bed.cfg, block, bed.bytes, &r), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_init(NULL, NULL, NULL, 0, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_init(&sim, NULL, block, bed.bytes, &r), SPH_BAD_CONFIG);
    assert_int_equal(sph_init(&sim, &bed.cfg, NULL, bed.bytes, &r), SPH_ARENA_TOO_SMALL);
    assert_int_equal(sph_init(&sim, &bed.cfg, block, 0, NULL), SPH_ARENA_TOO_SMALL);
    assert_int_equal(sph_init(&sim, &bed.cfg, block, bed.bytes - 1, &r), SPH_ARENA_TOO_SMALL);
    for (uint32_t off = 1; off < SPH_ALIGN; off++)
        assert_int_equal(sph_init(&sim, &bed.cfg, block + off, bed.bytes + SPH_ALIGN, &r), SPH_ARENA_UNALIGNED);
    assert_null(sim);
    assert_true(guard_intact(block, bed.bytes + 2 * SPH_ALIGN));
    assert_int_equal(sph_init(&sim, &bed.cfg, block, bed.bytes, NULL), SPH_OK);
    assert_true(guard_intact(block + bed.bytes, 2 * SPH_ALIGN));
    free(block);
}

static void add_bytes(void *ctx, const char *name, size_t bytes)
{
    (void)name;
    *(size_t *)ctx += bytes;
}
static void row_arena_report(void)
{
    size_t sum = 0;
    sph_arena_report(NULL, add_bytes, &sum);
    assert_true(sum == 0);
    sph_arena_report(bed.sim, NULL, NULL);
    sph_arena_report(bed.sim, add_bytes, &sum);
    assert_true(sum == bed.bytes);
}
static void row_get_usage(void)
{
    begin_call();
    sph_get_usage(NULL, OUT(sph_usage));
    sph_get_usage(bed.sim, NULL);
    end_call(SPH_BAD_ARGUMENT, "get_usage"); /* as refused: nothing may be written */
    sph_get_usage(bed.sim, OUT(sph_usage));
    assert_true(OUT(sph_usage)->arena_used == bed.bytes);
}
static void row_last(void)
{
    assert_int_equal(sph_last(NULL)->status, SPH_BAD_ARGUMENT);
    assert_int_equal(sph_last(bed.sim)->status, bed.state == FAILED ? SPH_NOT_FINITE : SPH_OK);
}
static void row_reconfigure(void)
{
    no_sim(sph_reconfigure(NULL, &bed.cfg));
    if_idle(sph_reconfigure(bed.sim, NULL), SPH_BAD_CONFIG);
    if_idle(sph_reconfigure(bed.sim, &bed.cfg), SPH_OK);
    EACH_WORD(w) {
        sph_config c = bed.cfg;
        c.max_particles = w;
        if_idle(sph_reconfigure(bed.sim, &c), SPH_BAD_CONFIG);
    }
}

/* ---- fluid ---- */

static void row_add_fluid(void)
{
    no_sim(sph_add_fluid(NULL, NULL, OUT(uint32_t)));
    if_idle(sph_add_fluid(bed.sim, NULL, NULL), SPH_BAD_ARGUMENT);
    if_idle(sph_add_fluid(bed.sim, NULL, OUT(uint32_t)), SPH_OK);
    EACH_NUMBER(x)
        for (int k = 0; k < 3; k++) {
            const sph_fluid f = {.mass = k == 0 ? x : 0, .rho0 = k == 1 ? x : 0, .sound_speed = k == 2 ? x : 0};
            attempt(sph_add_fluid(bed.sim, &f, OUT(uint32_t)));
            if (!finite(x) || x < 0 || x > 1e30 || (x > 0 && x < 1e-300))
                refused(sph_add_fluid(bed.sim, &f, OUT(uint32_t)));
        }
    EACH_WORD(w) {
        const sph_fluid f = {.own_eos = true, .eos = w};
        if_idle(sph_add_fluid(bed.sim, &f, OUT(uint32_t)), w < SPH_IDEAL_GAS ? SPH_OK : SPH_BAD_ARGUMENT);
    }
}

static void sway(void *ctx, double t, double *displacement, double *velocity)
{
    (void)ctx;
    displacement[0] = t;
    velocity[0] = 1;
}
static void row_add_solid(void)
{
    const sph_solid good = {.shear = 1e5};
    uint32_t *const group = OUT(uint32_t) + 1;
    no_sim(sph_add_solid(NULL, &good, OUT(uint32_t), group));
    refused(sph_add_solid(bed.sim, NULL, OUT(uint32_t), group));
    refused(sph_add_solid(bed.sim, &good, NULL, group));
    if_idle(sph_add_solid(bed.sim, &good, OUT(uint32_t), NULL), bed.rock ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x)
        for (int k = 0; k < 8; k++) {
            sph_solid m = good;
            double *const place[] = {&m.mass, &m.rho0, &m.sound_speed, &m.shear, &m.yield, &m.hardening, &m.crack_speed,
                                     &m.flaw_radius};
            *place[k] = x;
            attempt(sph_add_solid(bed.sim, &m, OUT(uint32_t), group));
            if (!finite(x) || x < 0 || x > 1e30 || (k < 3 && x > 0 && x < 1e-300))
                refused(sph_add_solid(bed.sim, &m, OUT(uint32_t), group));
        }
    EACH_WORD(w) {
        sph_solid m = good;
        m.body = w;
        if_idle(sph_add_solid(bed.sim, &m, OUT(uint32_t), group), bed.rock && w < 256 ? SPH_OK : SPH_BAD_ARGUMENT);
        m.body = 0;
        m.held = w;
        if_idle(sph_add_solid(bed.sim, &m, OUT(uint32_t), group),
                bed.rock && w < 1u << SPH_DIM ? SPH_OK : SPH_BAD_ARGUMENT);
        m.motion = sway;
        if_idle(sph_add_solid(bed.sim, &m, OUT(uint32_t), group),
                bed.rock && w && w < 1u << SPH_DIM ? SPH_OK : SPH_BAD_ARGUMENT);
    }
}

#if SPH_DIM > 1
#define OF_ROCK (bed.rock && bed.state != EMPTY) /* set 0 is one that can have flaws */
static void row_add_flaws(void)
{
    const sph_flaws good = {1e6, 8, 1};
    no_sim(sph_add_flaws(NULL, 0, &good));
    refused(sph_add_flaws(bed.sim, 0, NULL));
    EACH_WORD(w)
        if_adding(sph_add_flaws(bed.sim, w, &good), OF_ROCK && w == 0 ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x)
        for (int k = 0; k < 2; k++) {
            const sph_flaws f = {k ? 1e6 : x, k ? x : 8, 1};
            if (k ? x >= 1 && x <= 50 : x > 0 && x < 1e300)
                if_adding(sph_add_flaws(bed.sim, 0, &f), OF_ROCK ? SPH_OK : SPH_BAD_ARGUMENT);
            else
                refused(sph_add_flaws(bed.sim, 0, &f));
        }
    if (bed.state == FILLED && bed.rock) { /* twice */
        must(bed.sim, sph_add_flaws(bed.sim, 0, &good));
        assert_int_equal(sph_add_flaws(bed.sim, 0, &good), SPH_BAD_ARGUMENT);
        memcpy(sims[sim_count - 1].arena, bed.image, bed.bytes);
    }
}
static void row_get_flaws(void)
{
    float *const list = (float *)(void *)(out + 64);
    no_sim(sph_get_flaws(NULL, 0, OUT(uint32_t), list));
    no_sim(sph_get_flaws(bed.sim, 0, NULL, list));
    EACH_WORD(w) {
        const sph_status want = bed.rock && w < bed.cfg.max_particles ? SPH_OK : SPH_BAD_ARGUMENT;
        with_status(sph_get_flaws(bed.sim, w, OUT(uint32_t), list), want);
        with_status(sph_get_flaws(bed.sim, w, OUT(uint32_t), NULL), want);
    }
}
#endif

#define SETS (bed.state == EMPTY ? 0u : 2u)
#define VECTOR(name, value)                                                                                 \
    double name[SPH_DIM];                                                                                   \
    for (int a_ = 0; a_ < SPH_DIM; a_++)                                                                    \
        name[a_] = (value);

static void row_add_particle(void)
{
    VECTOR(at, 0.5) VECTOR(v, 0.0)
    no_sim(sph_add_particle(NULL, 0, at, NULL, 0, OUT(uint32_t)));
    if_adding(sph_add_particle(bed.sim, 0, NULL, NULL, 0, OUT(uint32_t)), SPH_BAD_ARGUMENT);
    if_adding(sph_add_particle(bed.sim, 0, at, v, 0, NULL), SETS ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_WORD(w)
        if_adding(sph_add_particle(bed.sim, w, at, v, 0, OUT(uint32_t)), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x)
        for (int k = 0; k < SPH_DIM; k++) {
            at[k] = x;
            attempt(sph_add_particle(bed.sim, 0, at, v, 0, OUT(uint32_t)));
            if (!(x >= -1 && x < 2))
                refused(sph_add_particle(bed.sim, 0, at, v, 0, OUT(uint32_t)));
            at[k] = 0.5;
            v[k] = x;
            attempt(sph_add_particle(bed.sim, 0, at, v, 0, OUT(uint32_t)));
            if (!(x > -1e15 && x < 1e15))
                refused(sph_add_particle(bed.sim, 0, at, v, 0, OUT(uint32_t)));
            v[k] = 0;
            attempt(sph_add_particle(bed.sim, 0, at, v, x, OUT(uint32_t)));
            if (!(x >= 0 && x < 100000))
                refused(sph_add_particle(bed.sim, 0, at, v, x, OUT(uint32_t)));
        }
}
static void row_add_box(void)
{
    VECTOR(lo, 0.0) VECTOR(hi, 0.5) VECTOR(v, 0.0)
    no_sim(sph_add_box(NULL, 0, lo, hi, v));
    refused(sph_add_box(bed.sim, 0, NULL, hi, v));
    refused(sph_add_box(bed.sim, 0, lo, NULL, v));
    if_adding(sph_add_box(bed.sim, 0, lo, hi, NULL), SETS ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_WORD(w)
        if_adding(sph_add_box(bed.sim, w, lo, hi, v), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x)
        for (int k = 0; k < SPH_DIM; k++) {
            double *const place[] = {lo, hi, v};
            for (int p = 0; p < 3; p++) {
                const double good = place[p][k];
                place[p][k] = x;
                attempt(sph_add_box(bed.sim, 0, lo, hi, v));
                if (!finite(x) || x > 1e14 || x < -1e14)
                    refused(sph_add_box(bed.sim, 0, lo, hi, v));
                place[p][k] = good;
            }
        }
}
static void row_add_ring(void)
{
    VECTOR(at, 0.5) VECTOR(v, 0.0)
    no_sim(sph_add_ring(NULL, 0, at, 0, 0.3, v));
    refused(sph_add_ring(bed.sim, 0, NULL, 0, 0.3, v));
    if_adding(sph_add_ring(bed.sim, 0, at, 0, 0.3, NULL), SETS ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_WORD(w)
        if_adding(sph_add_ring(bed.sim, w, at, 0, 0.3, v), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x) {
        attempt(sph_add_ring(bed.sim, 0, at, x, 0.3, v));
        attempt(sph_add_ring(bed.sim, 0, at, 0, x, v));
        if (!(x > 0 && x < 1e6))
            refused(sph_add_ring(bed.sim, 0, at, 0, x, v));
        for (int k = 0; k < SPH_DIM; k++) {
            at[k] = x;
            attempt(sph_add_ring(bed.sim, 0, at, 0, 0.3, v));
            at[k] = 0.5;
            v[k] = x;
            attempt(sph_add_ring(bed.sim, 0, at, 0, 0.3, v));
            v[k] = 0;
        }
    }
}
#if SPH_DIM == 2
static void row_add_polygon(void)
{
    double c[3][2] = {{0, 0}, {1, 0}, {0, 1}}, v[2] = {0, 0};
    const double(*corner)[2] = (const double(*)[2])c;
    no_sim(sph_add_polygon(NULL, 0, corner, 3, v));
    for (uint32_t n = 0; n < 3; n++)
        refused(sph_add_polygon(bed.sim, 0, corner, n, v));
    EACH_WORD(w)
        refused(sph_add_polygon(bed.sim, 0, NULL, w, v));
    if_adding(sph_add_polygon(bed.sim, 0, corner, 3, NULL), SETS ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_WORD(w)
        if_adding(sph_add_polygon(bed.sim, w, corner, 3, v), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x)
        for (int k = 0; k < 6; k++) {
            const double good = c[k / 2][k % 2];
            c[k / 2][k % 2] = x;
            attempt(sph_add_polygon(bed.sim, 0, corner, 3, v));
            if (!finite(x) || x > 1e6 || x < -1e6)
                refused(sph_add_polygon(bed.sim, 0, corner, 3, v));
            c[k / 2][k % 2] = good;
        }
}
#endif

static void row_add_shape(void)
{
    sph_ellipse rim, hole;
    for (int k = 0; k < SPH_DIM; k++)
        rim.centre[k] = hole.centre[k] = 0.5, rim.radius[k] = 0.4, hole.radius[k] = 0.1;
    const sph_shape ring = {.outline = &rim, .hole = &hole, .holes = 1};
    sph_shape box = {.hole = &hole, .holes = 1};
    box.hi[0] = 1;
    for (int k = 1; k < SPH_DIM; k++)
        box.hi[k] = 0.5;
    no_sim(sph_add_shape(NULL, 0, &box));
    refused(sph_add_shape(bed.sim, 0, NULL));
    EACH_WORD(w) {
        if_adding(sph_add_shape(bed.sim, w, &ring), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
        sph_shape s = box;
        s.lattice = w;
        if (w == 0 || (SPH_DIM > 1 && w <= SPH_DIM))
            if_adding(sph_add_shape(bed.sim, 0, &s), SETS ? SPH_OK : SPH_BAD_ARGUMENT);
        else
            refused(sph_add_shape(bed.sim, 0, &s));
        s = box;
        s.hole = NULL;
        s.holes = w;
        if (w)
            refused(sph_add_shape(bed.sim, 0, &s));
        else
            if_adding(sph_add_shape(bed.sim, 0, &s), SETS ? SPH_OK : SPH_BAD_ARGUMENT);
    }
    EACH_NUMBER(x)
        for (int k = 0; k < SPH_DIM; k++) {
            double *const place[] = {box.lo, box.hi, box.velocity, hole.centre, hole.radius, rim.centre, rim.radius};
            for (int p = 0; p < 7; p++) {
                const double good = place[p][k];
                const bool radius = place[p] == hole.radius || place[p] == rim.radius;
                const sph_shape *const s = p < 5 ? &box : &ring;
                place[p][k] = x;
                attempt(sph_add_shape(bed.sim, 0, s));
                if (radius ? !(x > 0) : !(x > -1e15 && x < 1e15))
                    refused(sph_add_shape(bed.sim, 0, s));
                place[p][k] = good;
            }
        }
}

/* spoils one number of the last particles that it is called for */
static struct {
    uint32_t calls, from, place;
    double value;
} spoil;
static void spoil_field(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)x;
    v[0] += 0.1;
    *rho += 1;
    if (spoil.calls++ >= spoil.from)
        *(spoil.place < SPH_DIM ? &v[spoil.place] : rho) = spoil.value;
}
/* Of modules that the bed does not have everything is refused; tests/test_flow.c, test_energy.c and test_edges.c drive
   them where they are. */
static void row_add_inflow(void)
{
    sph_flow f = {.face = SPH_HIGH(0), .speed = 1};
    no_sim(sph_add_inflow(NULL, 0, &f, OUT(uint32_t)));
    EACH_WORD(w) {
        f.face = w;
        refused(sph_add_inflow(bed.sim, w, &f, OUT(uint32_t)));
        refused(sph_add_inflow(bed.sim, w, NULL, OUT(uint32_t)));
    }
    EACH_NUMBER(x) {
        f.speed = f.lo[0] = x;
        f.hi[0] = -x;
        refused(sph_add_inflow(bed.sim, 0, &f, OUT(uint32_t)));
    }
}
static void row_add_outflow(void)
{
    sph_flow f = {.face = SPH_LOW(0)};
    no_sim(sph_add_outflow(NULL, 0, &f, OUT(uint32_t)));
    EACH_WORD(w) {
        f.face = w;
        refused(sph_add_outflow(bed.sim, w, &f, OUT(uint32_t)));
        refused(sph_add_outflow(bed.sim, w, NULL, OUT(uint32_t)));
    }
    EACH_NUMBER(x) {
        f.lo[0] = x;
        f.hi[0] = -x;
        refused(sph_add_outflow(bed.sim, 0, &f, OUT(uint32_t)));
    }
}
static void no_energy(void *ctx, const double *x, double *u)
{
    (void)ctx, (void)x;
    *u = 1;
}
static void row_apply_energy(void)
{
    no_sim(sph_apply_energy(NULL, 0, no_energy, NULL));
    EACH_WORD(w) {
        refused(sph_apply_energy(bed.sim, w, no_energy, NULL));
        refused(sph_apply_energy(bed.sim, w, NULL, NULL));
    }
}
static void no_place(void *ctx, const double *x, double *to)
{
    (void)x;
    to[0] = *(const double *)ctx;
}
static void row_apply_positions(void)
{
    double to = 1e30;
    no_sim(sph_apply_positions(NULL, 0, no_place, &to));
    EACH_WORD(w) {
        refused(sph_apply_positions(bed.sim, w, no_place, &to));
        refused(sph_apply_positions(bed.sim, w, NULL, NULL));
    }
    EACH_NUMBER(x) {
        to = x;
        if (!finite(x) || x > 1e6 || x < -1e6)
            refused(sph_apply_positions(bed.sim, 0, no_place, &to));
    }
}
static void row_find_edges(void)
{
    sph_edges e = {0};
    no_sim(sph_find_edges(NULL, NULL));
    refused(sph_find_edges(bed.sim, NULL));
    EACH_WORD(w) {
        e.faces = w;
        refused(sph_find_edges(bed.sim, &e));
    }
    EACH_NUMBER(x) {
        e.velocity[0] = e.source[0] = x;
        refused(sph_find_edges(bed.sim, &e));
    }
}
static void row_set_edge(void)
{
    double n[SPH_DIM] = {1};
    no_sim(sph_set_edge(NULL, 0, 1, n));
    EACH_WORD(w) {
        refused(sph_set_edge(bed.sim, w, 1, n));
        refused(sph_set_edge(bed.sim, 0, w, n));
        refused(sph_set_edge(bed.sim, w, w, NULL));
    }
    EACH_NUMBER(x) {
        n[0] = x;
        refused(sph_set_edge(bed.sim, 0, 1, n));
    }
}
static void row_get_edge(void)
{
    no_sim(sph_get_edge(NULL, 0, OUT(uint32_t), OUT(double)));
    EACH_WORD(w) {
        refused(sph_get_edge(bed.sim, w, OUT(uint32_t), (double *)(void *)(out + 64)));
        refused(sph_get_edge(bed.sim, w, NULL, NULL));
    }
}

static void row_apply_field(void)
{
    no_sim(sph_apply_field(NULL, 0, spoil_field, NULL));
    refused(sph_apply_field(bed.sim, 0, NULL, NULL));
    spoil.from = 0xffffffffu;
    EACH_WORD(w)
        if_idle(sph_apply_field(bed.sim, w, spoil_field, NULL), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x)
        for (spoil.place = 0; spoil.place <= SPH_DIM; spoil.place++)
            for (spoil.from = 0; spoil.from < 3; spoil.from += 2) { /* the first particle's, or a later one's */
                spoil.value = x;
                spoil.calls = 0;
                attempt(sph_apply_field(bed.sim, 0, spoil_field, NULL));
                spoil.calls = 0;
                if (!finite(x) || x > 1e15 || x < -1e15)
                    refused(sph_apply_field(bed.sim, 0, spoil_field, NULL));
            }
}
static void row_apply_hydrostatic(void)
{
    no_sim(sph_apply_hydrostatic(NULL, 0, 1));
    EACH_WORD(w)
        if_idle(sph_apply_hydrostatic(bed.sim, w, 1), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x) {
        attempt(sph_apply_hydrostatic(bed.sim, 0, x));
        if (!(x > -1e15 && x < 1e15))
            refused(sph_apply_hydrostatic(bed.sim, 0, x));
    }
    /* finite, but so deep that water would have 100 times its density */
    refused(sph_apply_hydrostatic(bed.sim, 0, 9.9e14));
}

/* ---- walls ---- */

static void row_wall_default(void)
{
    const sph_wall w = sph_wall_default();
    assert_true(w.kind < SPH_WALLS && !w.motion);
}
static void row_motion_table(void)
{
    const double t[] = {0, 1}, x[] = {0, 2};
    const sph_table bad[] = {{0, 0, t, x}, {2, SPH_DIM, t, x}, {2, 0xffffffffu, t, x}, {2, 0, NULL, x},
                             {2, 0, t, NULL}};
    double d[SPH_DIM], v[SPH_DIM];
    for (uint32_t k = 0; k <= 5; k++) { /* a table that is none, and no table: the wall rests */
        for (int a = 0; a < SPH_DIM; a++)
            d[a] = v[a] = 7;
        sph_motion_table(k < 5 ? (void *)&bad[k] : NULL, 0.5, d, v);
        for (int a = 0; a < SPH_DIM; a++)
            assert_true(d[a] == 0 && v[a] == 0);
    }
    EACH_NUMBER(now) {
        sph_table m = {2, 0, t, x};
        sph_motion_table(&m, now, d, v);
        if (finite(now))
            assert_true(d[0] >= 0 && d[0] <= 2);
    }
}
static void row_motion_steady(void)
{
    double d[SPH_DIM], v[SPH_DIM];
    sph_steady m;
    for (int a = 0; a < SPH_DIM; a++) {
        d[a] = v[a] = 7;
        m.v[a] = 2 + a;
        m.a[a] = 6;
    }
    sph_motion_steady(NULL, 0.5, d, v);
    for (int a = 0; a < SPH_DIM; a++)
        assert_true(d[a] == 0 && v[a] == 0);
    sph_motion_steady(&m, 0.5, d, v);
    for (int a = 0; a < SPH_DIM; a++)
        assert_true(d[a] == 0.5 * (2 + a) + 0.75 && v[a] == 5 + a);
    EACH_NUMBER(now)
        sph_motion_steady(&m, now, d, v); /* what is not finite fails the step: test_faults.c */
}
static void row_motion_programme(void)
{
    const double t[] = {0, 1}, u[] = {0, 2};
    const sph_programme bad[] = {{0, 0, t, u}, {2, SPH_DIM, t, u}, {2, 0xffffffffu, t, u}, {2, 0, NULL, u},
                                 {2, 0, t, NULL}};
    double d[SPH_DIM], v[SPH_DIM];
    for (uint32_t k = 0; k <= 5; k++) {
        for (int a = 0; a < SPH_DIM; a++)
            d[a] = v[a] = 7;
        sph_motion_programme(k < 5 ? (void *)(uintptr_t)&bad[k] : NULL, 0.5, d, v);
        for (int a = 0; a < SPH_DIM; a++)
            assert_true(d[a] == 0 && v[a] == 0);
    }
    EACH_NUMBER(now) {
        sph_programme m = {2, 0, t, u};
        sph_motion_programme(&m, now, d, v); /* what is not finite fails the step: test_faults.c */
        if (finite(now))
            assert_true(v[0] >= 0 && v[0] <= 2);
    }
}
static void row_spline_make(void)
{
    const double t[] = {0, 1, 3}, x[] = {0, 2, 1};
    double bend[6], bad_t[3] = {0, 1, 3};
    sph_spline m = {3, 0, t, x, bend};
    assert_true(sph_spline_make(&m, bend));
    assert_false(sph_spline_make(NULL, bend));
    assert_false(sph_spline_make(&m, NULL));
    m.rows = 1;
    assert_false(sph_spline_make(&m, bend));
    m = (sph_spline){3, 0, NULL, x, bend};
    assert_false(sph_spline_make(&m, bend));
    m = (sph_spline){3, 0, t, NULL, bend};
    assert_false(sph_spline_make(&m, bend));
    m = (sph_spline){3, 0, bad_t, x, bend};
    EACH_NUMBER(now) {
        bad_t[1] = now;
        assert_true(sph_spline_make(&m, bend) == (now > 0 && now < 3));
    }
}
static void row_motion_spline(void)
{
    const double t[] = {0, 1}, x[] = {0, 2}, bend[] = {12, -12};
    const sph_spline bad[] = {{0, 0, t, x, bend}, {1, 0, t, x, bend},    {2, SPH_DIM, t, x, bend},
                              {2, 0, NULL, x, bend}, {2, 0, t, NULL, bend}, {2, 0, t, x, NULL}};
    double d[SPH_DIM], v[SPH_DIM];
    for (uint32_t k = 0; k <= 6; k++) {
        for (int a = 0; a < SPH_DIM; a++)
            d[a] = v[a] = 7;
        sph_motion_spline(k < 6 ? (void *)(uintptr_t)&bad[k] : NULL, 0.5, d, v);
        for (int a = 0; a < SPH_DIM; a++)
            assert_true(d[a] == 0 && v[a] == 0);
    }
    EACH_NUMBER(now) {
        sph_spline m = {2, 0, t, x, bend};
        sph_motion_spline(&m, now, d, v);
        if (finite(now))
            assert_true(d[0] >= 0 && d[0] <= 2);
    }
}
static void row_add_wall_box(void)
{
    VECTOR(lo, 0.0) VECTOR(hi, 0.5)
    sph_wall w = sph_wall_default();
    no_sim(sph_add_wall_box(NULL, &w, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
    refused(sph_add_wall_box(bed.sim, NULL, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
    refused(sph_add_wall_box(bed.sim, &w, NULL, hi, SPH_LOW(0), true, OUT(uint32_t)));
    refused(sph_add_wall_box(bed.sim, &w, lo, NULL, SPH_LOW(0), true, OUT(uint32_t)));
    if_adding(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, NULL), SPH_OK);
    EACH_WORD(k) {
        attempt(sph_add_wall_box(bed.sim, &w, lo, hi, k, k & 1, OUT(uint32_t)));
        w.kind = k;
        attempt(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
        if (k >= SPH_WALLS)
            refused(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
        w = sph_wall_default();
        w.layers = k;
        attempt(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
        w.layers = 0;
    }
    EACH_NUMBER(x) {
        w.strength = x;
        attempt(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
        if (!(x >= 0 && x <= 1e30))
            refused(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
        w.strength = 0;
        for (int k = 0; k < SPH_DIM; k++)
            for (int high = 0; high < 2; high++) {
                double *const p = high ? &hi[k] : &lo[k], good = *p;
                *p = x;
                attempt(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0) | SPH_HIGH(SPH_DIM - 1), k & 1,
                                         OUT(uint32_t)));
                if (!finite(x) || x > 1e6 || x < -1e6)
                    refused(sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, OUT(uint32_t)));
                *p = good;
            }
    }
}
#if SPH_DIM == 2
static void row_add_wall_polyline(void)
{
    double p[3][2] = {{0, 0}, {0.5, 0}, {1, 0.2}};
    sph_wall w = sph_wall_default();
#define POINTS (const double(*)[2]) p
    no_sim(sph_add_wall_polyline(NULL, &w, POINTS, 3, OUT(uint32_t)));
    refused(sph_add_wall_polyline(bed.sim, NULL, POINTS, 3, OUT(uint32_t)));
    refused(sph_add_wall_polyline(bed.sim, &w, NULL, 3, OUT(uint32_t)));
    refused(sph_add_wall_polyline(bed.sim, &w, POINTS, 1, OUT(uint32_t)));
    refused(sph_add_wall_polyline(bed.sim, &w, POINTS, 0xffffffffu, OUT(uint32_t)));
    if_adding(sph_add_wall_polyline(bed.sim, &w, POINTS, 3, NULL), SPH_OK);
    EACH_NUMBER(x)
        for (uint32_t kind = 0; kind < SPH_WALLS; kind++)
            for (int k = 0; k < 6; k++) {
                double *const q = &p[k / 2][k % 2], good = *q;
                w.kind = kind;
                *q = x;
                attempt(sph_add_wall_polyline(bed.sim, &w, POINTS, 3, OUT(uint32_t)));
                if (!finite(x) || x > 1e6 || x < -1e6)
                    refused(sph_add_wall_polyline(bed.sim, &w, POINTS, 3, OUT(uint32_t)));
                *q = good;
            }
#undef POINTS
}
static void row_add_wall_segment(void)
{
    double a[2] = {0, 0}, b[2] = {1, 0};
    sph_wall w = sph_wall_default();
    no_sim(sph_add_wall_segment(NULL, &w, a, b, OUT(uint32_t)));
    refused(sph_add_wall_segment(bed.sim, NULL, a, b, OUT(uint32_t)));
    refused(sph_add_wall_segment(bed.sim, &w, NULL, b, OUT(uint32_t)));
    refused(sph_add_wall_segment(bed.sim, &w, a, NULL, OUT(uint32_t)));
    refused(sph_add_wall_segment(bed.sim, &w, a, a, OUT(uint32_t)));
    if_adding(sph_add_wall_segment(bed.sim, &w, a, b, NULL), SPH_OK);
    EACH_NUMBER(x)
        for (uint32_t kind = 0; kind < SPH_WALLS; kind++)
            for (int k = 0; k < 4; k++) {
                double *const p = k < 2 ? &a[k] : &b[k - 2], good = *p;
                w.kind = kind;
                *p = x;
                attempt(sph_add_wall_segment(bed.sim, &w, a, b, OUT(uint32_t)));
                if (!finite(x) || x > 1e6 || x < -1e6)
                    refused(sph_add_wall_segment(bed.sim, &w, a, b, OUT(uint32_t)));
                *p = good;
            }
}
#endif
#if SPH_DIM == 3
static void row_add_wall_plane(void)
{
    double at[3] = {0, 0, 0}, e[2][3] = {{1, 0, 0}, {0, 1, 0}};
    sph_wall w = sph_wall_default();
    no_sim(sph_add_wall_plane(NULL, &w, at, e[0], e[1], OUT(uint32_t)));
    refused(sph_add_wall_plane(bed.sim, NULL, at, e[0], e[1], OUT(uint32_t)));
    refused(sph_add_wall_plane(bed.sim, &w, NULL, e[0], e[1], OUT(uint32_t)));
    refused(sph_add_wall_plane(bed.sim, &w, at, NULL, e[1], OUT(uint32_t)));
    refused(sph_add_wall_plane(bed.sim, &w, at, e[0], NULL, OUT(uint32_t)));
    refused(sph_add_wall_plane(bed.sim, &w, at, e[0], e[0], OUT(uint32_t)));
    if_adding(sph_add_wall_plane(bed.sim, &w, at, e[0], e[1], NULL), SPH_OK);
    EACH_NUMBER(x)
        for (int k = 0; k < 9; k++) {
            double *const p = k < 3 ? &at[k] : &e[k / 3 - 1][k % 3], good = *p;
            *p = x;
            attempt(sph_add_wall_plane(bed.sim, &w, at, e[0], e[1], OUT(uint32_t)));
            if (!finite(x) || x > 1e6 || x < -1e6)
                refused(sph_add_wall_plane(bed.sim, &w, at, e[0], e[1], OUT(uint32_t)));
            *p = good;
        }
}
#endif
static void row_remove_wall(void)
{
    no_sim(sph_remove_wall(NULL, 0));
    EACH_WORD(w)
        if_idle(sph_remove_wall(bed.sim, w), SETS && !w ? SPH_OK : SPH_BAD_ARGUMENT);
}
static void row_remove_wall_at(void)
{
    no_sim(sph_remove_wall_at(NULL, 0, 0));
    EACH_WORD(w)
        EACH_NUMBER(x)
            if_idle(sph_remove_wall_at(bed.sim, w, x), SETS && !w && x == x ? SPH_OK : SPH_BAD_ARGUMENT);
}

/* ---- step ---- */

static void row_ready(void)
{
    no_sim(sph_ready(NULL));
    with_status(sph_ready(bed.sim), bed.state == EMPTY || bed.state == SLICED ? SPH_BAD_STATE : SPH_OK);
}
static void row_step(void)
{
    no_sim(sph_step(NULL));
    with_status(sph_step(bed.sim), bed.state == EMPTY || bed.state == SLICED ? SPH_BAD_STATE : SPH_OK);
}
static void row_step_to(void)
{
    no_sim(sph_step_to(NULL, 1));
    EACH_NUMBER(x) {
        const bool later = x > sph_time(bed.sim);
        if (bed.state == SLICED || (bed.state == EMPTY && later))
            with_status(sph_step_to(bed.sim, x), SPH_BAD_STATE);
        else if (!later)
            with_status(sph_step_to(bed.sim, x), SPH_BAD_ARGUMENT);
        else
            attempt(sph_step_to(bed.sim, x));
    }
}
static void row_step_slice(void)
{
    static const uint64_t budgets[] = {1, 0xffffffffu, 0x100000000u, 0xffffffffffffffffu};
    no_sim(sph_step_slice(NULL, 1));
    with_status(sph_step_slice(bed.sim, 0), SPH_BAD_ARGUMENT);
    for (int k = 0; k < 4; k++) {
        begin_call();
        const sph_status st = sph_step_slice(bed.sim, budgets[k]);
        if (bed.state == EMPTY)
            assert_int_equal(st, SPH_BAD_STATE);
        else
            assert_true(st == SPH_NOT_DONE || st == SPH_OK); /* a small scene's step may end with any slice */
        free(before.s.arrays);
        memcpy(sims[sim_count - 1].arena, bed.image, bed.bytes);
    }
}
static void row_step_cancel(void)
{
    const uint64_t h = sph_hash(bed.sim);
    sph_step_cancel(NULL);
    sph_step_cancel(bed.sim);
    assert_true(sph_hash(bed.sim) == h);
    if (bed.state != EMPTY)
        must(bed.sim, sph_step(bed.sim));
    memcpy(sims[sim_count - 1].arena, bed.image, bed.bytes);
}
static void row_get_step(void)
{
    begin_call();
    sph_get_step(NULL, OUT(sph_step_info));
    sph_get_step(bed.sim, NULL);
    end_call(SPH_BAD_ARGUMENT, "get_step");
    sph_get_step(bed.sim, OUT(sph_step_info));
    assert_true(OUT(sph_step_info)->step == (bed.state >= STEPPED));
}
static void row_time(void) { assert_true(sph_time(NULL) == 0 && (sph_time(bed.sim) > 0) == (bed.state >= STEPPED)); }

/* ---- reading ---- */

static void row_count(void) { assert_true(sph_count(NULL) == 0 && (sph_count(bed.sim) > 0) == (bed.state != EMPTY)); }
static void row_get(void)
{
    no_sim(sph_get(NULL, 0, OUT(sph_particle)));
    no_sim(sph_get(bed.sim, 0, NULL));
    EACH_WORD(w)
        with_status(sph_get(bed.sim, w, OUT(sph_particle)), w < sph_count(bed.sim) ? SPH_OK : SPH_BAD_ARGUMENT);
}
static void row_get_totals(void)
{
    begin_call();
    sph_get_totals(NULL, OUT(sph_totals));
    sph_get_totals(bed.sim, NULL);
    end_call(SPH_BAD_ARGUMENT, "get_totals");
    sph_get_totals(bed.sim, OUT(sph_totals));
    assert_true(OUT(sph_totals)->mass >= 0);
}
static void row_probe(void)
{
    VECTOR(at, 0.5)
    no_sim(sph_probe(NULL, at, OUT(sph_probe_value)));
    no_sim(sph_probe(bed.sim, NULL, OUT(sph_probe_value)));
    no_sim(sph_probe(bed.sim, at, NULL));
    EACH_NUMBER(x)
        for (int k = 0; k < SPH_DIM; k++) {
            at[k] = x;
            with_status(sph_probe(bed.sim, at, OUT(sph_probe_value)), finite(x) ? SPH_OK : SPH_BAD_ARGUMENT);
            at[k] = 0.5;
        }
}
static void row_probe_line(void)
{
    VECTOR(a, 0.0) VECTOR(b, 1.0)
    no_sim(sph_probe_line(NULL, a, b, 3, OUT(sph_probe_value)));
    no_sim(sph_probe_line(bed.sim, NULL, b, 3, OUT(sph_probe_value)));
    no_sim(sph_probe_line(bed.sim, a, NULL, 3, OUT(sph_probe_value)));
    EACH_WORD(w)
        no_sim(sph_probe_line(bed.sim, a, b, w, NULL));
    for (uint32_t n = 0; n < 4; n++)
        with_status(sph_probe_line(bed.sim, a, b, n, OUT(sph_probe_value)), n < 2 ? SPH_BAD_ARGUMENT : SPH_OK);
    EACH_NUMBER(x) {
        b[0] = x;
        with_status(sph_probe_line(bed.sim, a, b, 3, OUT(sph_probe_value)), finite(x) ? SPH_OK : SPH_BAD_ARGUMENT);
        b[0] = 1;
    }
}
typedef sph_status gauge(const sph_sim *sim, const double *x, uint32_t axis, double *height);
static void row_any_gauge(gauge *call)
{
    VECTOR(at, 0.5)
    no_sim(call(NULL, at, 0, OUT(double)));
    no_sim(call(bed.sim, NULL, 0, OUT(double)));
    no_sim(call(bed.sim, at, 0, NULL));
    EACH_WORD(w)
        with_status(call(bed.sim, at, w, OUT(double)), w < SPH_DIM ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x)
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            at[k] = x;
            with_status(call(bed.sim, at, SPH_DIM - 1, OUT(double)), finite(x) ? SPH_OK : SPH_BAD_ARGUMENT);
            at[k] = 0.5;
        }
}
static void row_gauge(void) { row_any_gauge(sph_gauge); }
static void row_surface(void) { row_any_gauge(sph_surface); }
static void row_depth(void) { row_any_gauge(sph_depth); }
/* where a quarter of a spacing is less than the last digit of a coordinate, the search for the surface still ends */
static void a_gauge_far_from_the_origin_ends(void **state)
{
    sph_config c = open_config(1, 0.25);
    uint32_t set;
    double h;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = 1e15;
        c.hi[k] = 1e15 + 8;
    }
    VECTOR(at, 1e15 + 4)
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_particle(sim, set, at, NULL, 0, NULL));
    must(sim, sph_gauge(sim, at, SPH_DIM - 1, &h));
    assert_true(h >= 1e15 && h <= 1e15 + 8);
}

static void no_finding(void *ctx, const sph_finding *f)
{
    (void)ctx;
    assert_true(f->kind < SPH_FINDINGS && f->count > 0 && f->text[0]);
}
static void row_inspect(void)
{
    no_sim(sph_inspect(NULL, no_finding, NULL));
    if_idle(sph_inspect(bed.sim, NULL, NULL), SPH_BAD_ARGUMENT);
    if_idle(sph_inspect(bed.sim, no_finding, NULL), SPH_OK);
}
static void row_extent(void)
{
    double low = 7, high = 7;
    sph_extent(NULL, 0, &low, &high);
    sph_extent(bed.sim, 0, NULL, &high);
    sph_extent(bed.sim, 0, &low, NULL);
    assert_true(low == 7 && high == 7);
    EACH_WORD(w) {
        sph_extent(bed.sim, w, &low, &high);
        assert_true(low <= high && (w < SPH_DIM || high == 0));
    }
}
static void row_kernel_value(void)
{
    double *const w = OUT(double), *const d = w + 1;
    no_sim(sph_kernel_value(0, 0.1, 1, NULL, d));
    no_sim(sph_kernel_value(0, 0.1, 1, w, NULL));
    EACH_WORD(k)
        with_status(sph_kernel_value(k, 0.1, 1, w, d), k < SPH_KERNELS ? SPH_OK : SPH_BAD_ARGUMENT);
    EACH_NUMBER(x) {
        with_status(sph_kernel_value(0, x, 1, w, d), finite(x) && x >= 0 ? SPH_OK : SPH_BAD_ARGUMENT);
        with_status(sph_kernel_value(0, 0.1, x, w, d), finite(x) && x > 0 ? SPH_OK : SPH_BAD_ARGUMENT);
    }
}
static void row_kernel_support(void)
{
    EACH_WORD(w)
        assert_true((sph_kernel_support(w) > 0) == (w < SPH_KERNELS));
}
static void row_hash(void) { assert_true(sph_hash(NULL) == 0 && sph_hash(bed.sim) != 0); }

/* ---- dumps ---- */

static struct {
    unsigned char byte[1 << 17];
    size_t n, at;
} tape;
static bool record(void *ctx, const void *p, size_t n)
{
    (void)ctx;
    assert_true(tape.n + n <= sizeof tape.byte);
    memcpy(tape.byte + tape.n, p, n);
    tape.n += n;
    return true;
}
static bool play(void *ctx, void *p, size_t n)
{
    (void)ctx;
    if (tape.at + n > tape.n)
        return false;
    memcpy(p, tape.byte + tape.at, n);
    tape.at += n;
    return true;
}
static bool deny_sink(void *ctx, const void *p, size_t n) { return (void)ctx, (void)p, (void)n, false; }
static bool deny_source(void *ctx, void *p, size_t n) { return (void)ctx, (void)p, (void)n, false; }
static void row_dump(void)
{
    no_sim(sph_dump(NULL, SPH_DUMP_FULL, record, NULL));
    no_sim(sph_dump(bed.sim, SPH_DUMP_FULL, NULL, NULL));
    with_status(sph_dump(bed.sim, SPH_DUMP_FULL, deny_sink, NULL), SPH_SINK_FAILED);
    EACH_WORD(w) {
        tape.n = 0;
        /* stress and damage are of a picture */
        const bool known = !(w & ~(SPH_DUMP_FULL | SPH_DUMP_PICTURE | SPH_DUMP_ACCELERATION));
        with_status(sph_dump(bed.sim, w, record, NULL), known ? SPH_OK : SPH_BAD_ARGUMENT);
    }
}
static void row_restore(void)
{
    no_sim(sph_restore(NULL, play, NULL));
    if_idle(sph_restore(bed.sim, NULL, NULL), SPH_BAD_ARGUMENT);
    if_idle(sph_restore(bed.sim, deny_source, NULL), SPH_DUMP_TRUNCATED);
    tape.n = tape.at = 0;
    must(bed.sim, sph_dump(bed.sim, SPH_DUMP_FULL, record, NULL));
    if_idle(sph_restore(bed.sim, play, NULL), SPH_OK);
    tape.n = tape.at = 0;
    must(bed.sim, sph_dump(bed.sim, SPH_DUMP_PICTURE, record, NULL));
    if_idle(sph_restore(bed.sim, play, NULL), SPH_DUMP_MISMATCH);
}

/* ---- the table ---- */

typedef struct row {
    const char *name;
    void (*run)(void);
} row;
#define ROW(name) {#name, row_##name}
static const row rows[] = {
    ROW(status_text), ROW(limit_text), ROW(config_default), ROW(config_check), ROW(arena_bytes), ROW(init),
    ROW(arena_report),
    ROW(get_usage), ROW(last), ROW(reconfigure), ROW(add_fluid), ROW(add_solid), ROW(add_particle), ROW(add_box),
    ROW(add_ring),
#if SPH_DIM == 2
    ROW(add_polygon), ROW(add_wall_segment), ROW(add_wall_polyline),
#endif
#if SPH_DIM == 3
    ROW(add_wall_plane),
#endif
#if SPH_DIM > 1
    ROW(add_flaws), ROW(get_flaws),
#endif
    ROW(add_inflow), ROW(add_outflow), ROW(apply_energy), ROW(find_edges), ROW(set_edge), ROW(get_edge),
    ROW(apply_positions),
    ROW(add_shape), ROW(apply_field), ROW(apply_hydrostatic), ROW(motion_table), ROW(motion_steady), ROW(wall_default),
    ROW(motion_programme), ROW(spline_make), ROW(motion_spline),
    ROW(add_wall_box),
    ROW(remove_wall), ROW(remove_wall_at), ROW(ready), ROW(step), ROW(step_to), ROW(step_slice), ROW(step_cancel),
    ROW(get_step), ROW(time), ROW(count), ROW(get), ROW(get_totals), ROW(probe), ROW(probe_line), ROW(gauge),
    ROW(surface), ROW(depth), ROW(inspect),
    ROW(extent), ROW(kernel_value),
    ROW(kernel_support), ROW(hash), ROW(dump), ROW(restore),
};

static void run_rows(uint32_t state)
{
    for (int rock = 0; rock < 2; rock++) {
        bed.rock = rock;
        make_bed(state);
        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
            bed.row = rows[k].name;
            rows[k].run();
            memcpy(sims[sim_count - 1].arena, bed.image, bed.bytes);
        }
        unmake_bed();
    }
}
static void every_entry_of_an_empty_simulation(void **state) { (void)state, run_rows(EMPTY); }
static void every_entry_of_a_filled_simulation(void **state) { (void)state, run_rows(FILLED); }
static void every_entry_after_ready(void **state) { (void)state, run_rows(READY); }
static void every_entry_after_a_step(void **state) { (void)state, run_rows(STEPPED); }
static void every_entry_between_slices(void **state) { (void)state, run_rows(SLICED); }
static void every_entry_after_a_failure(void **state)
{
    (void)state;
    run_rows(FAILED);
    print_message("entry: %u calls refused, %u taken\n", bed.refused, bed.taken);
    assert_true(bed.refused > 1000 && bed.taken > 500);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(every_entry_of_an_empty_simulation), subject(every_entry_of_a_filled_simulation),
        subject(every_entry_after_ready),            subject(every_entry_after_a_step),
        subject(every_entry_between_slices),         subject(every_entry_after_a_failure),
        subject(a_gauge_far_from_the_origin_ends),
    };
    return run_subjects("entry", list);
}
