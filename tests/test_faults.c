/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_faults.c: faults put into the middle of a run. Numbers that are none, or far too large, in every array of reals
   and positions of the buffer being written or read, in the scratch of the threads; particles thrown out; callbacks
   that go wrong; sinks that fail at any byte. A step that fails leaves every array and scalar as it was, and the run
   goes on to the same hash as one that was never disturbed. (Arrays of indices are not attacked: the kernel trusts its
   own.) */
#include "testing.h"

#include "sph/scratch.h"
#include "state.h"

#define N (SPH_DIM == 1 ? 40u : SPH_DIM == 2 ? 10u : 5u)
#define DX 0.1
#define SLICE (SPH_DIM == 1 ? 60 : SPH_DIM == 2 ? 400 : 1500) /* work units: some dozen places in a step for a fault */

/* what the callbacks do: nothing wrong until told */
static struct {
    double body, wall; /* added to the acceleration, or the displacement */
    double from_t;
} fault;

static void body(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)v;
    if (t >= fault.from_t && x[0] > 0.5 * N * DX)
        a[0] += fault.body;
}
static void motion(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.01 * t + (t >= fault.from_t ? fault.wall : 0);
    v[0] = 0.01;
}

typedef struct fault_case {
    const char *name;
    uint32_t integrator, wall, density, shepard;
    bool xsph, books, diffusion;
    uint32_t solid, yield, damage, repel; /* a solid instead of water */
    bool held;                            /* a part of it, by the motion; no wall then */
} fault_case;
static const fault_case cases[] = {
    {.name = "predictor-corrector, Adami", .wall = SPH_WALL_ADAMI, .shepard = 1, .xsph = true, .books = true},
    {.name = "predictor-corrector, ghosts, summation", .wall = SPH_WALL_GHOST, .density = SPH_SUMMATION},
    {.name = "kick-drift-kick", .integrator = SPH_KICK_DRIFT_KICK, .wall = SPH_WALL_ADAMI, .diffusion = true},
    {.name = "leap-frog", .integrator = SPH_LEAP_FROG, .wall = SPH_WALL_MONAGHAN_KOS, .books = true},
    {.name = "Runge-Kutta", .integrator = SPH_RUNGE_KUTTA, .wall = SPH_WALL_GHOST, .xsph = true},
    {.name = "Runge-Kutta, momentum", .integrator = SPH_RUNGE_KUTTA_MOMENTUM, .wall = SPH_WALL_LENNARD_JONES,
     .books = true},
    {.name = "solid, corrected, kick-drift-kick", .integrator = SPH_KICK_DRIFT_KICK, .solid = SPH_CORRECTED,
     .yield = SPH_VON_MISES,
     .damage = SPH_BENZ_ASPHAUG, .repel = SPH_PRINCIPAL, .books = true, .held = true},
    {.name = "solid, total, Runge-Kutta", .integrator = SPH_RUNGE_KUTTA, .solid = SPH_TOTAL, .yield = SPH_VON_MISES,
     .held = true},
    {.name = "solid, updated, predictor-corrector", .wall = SPH_WALL_ADAMI, .solid = SPH_UPDATED,
     .yield = SPH_VON_MISES_GRAY,
     .damage = SPH_BENZ_ASPHAUG_GRAY, .repel = SPH_COMPONENTS},
    {.name = "solid, total, leap-frog", .integrator = SPH_LEAP_FROG, .wall = SPH_WALL_MONAGHAN_KOS, .solid = SPH_TOTAL,
     .damage = SPH_BENZ_ASPHAUG},
};
enum { CASES = sizeof cases / sizeof *cases - (SPH_DIM == 3 ? 2 : 0) };

static sph_config case_config(const fault_case *f)
{
    sph_config c = open_config(N * DX, DX);
    c.max_particles = 700;
    c.max_threads = 3;
    c.integrator = f->integrator;
    c.density = f->density;
    c.shepard_every = f->shepard;
    c.xsph = f->xsph ? 0.5 : 0;
    c.books = f->books;
    c.diffusion = f->diffusion ? SPH_MOLTENI : SPH_NO_DIFFUSION;
    c.body_force = body;
    c.gravity[SPH_DIM - 1] = -9.81;
    c.on_cross = SPH_PUT_BACK;
    c.solid = f->solid;
    c.yield = f->yield;
    c.damage = SPH_DIM > 1 ? f->damage : SPH_NO_DAMAGE;
    c.max_flaws = 4000;
    c.artificial_stress = f->repel;
    return c;
}

/* a simulation that has run, its bytes, and the hashes of its next steps when nothing disturbs them */
static struct {
    sph_sim *sim;
    unsigned char *arena, *image;
    size_t bytes;
    uint64_t now, next, later;
} bed;

/* rock that yields and breaks in its first steps; its low end may be held by the motion */
static void add_rock(const fault_case *f)
{
    sph_solid m = {.shear = 2e5, .yield = f->yield ? 50 : 0, .hardening = 1e4};
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    uint32_t set, other;
    must(bed.sim, sph_add_solid(bed.sim, &m, &set, NULL));
    random_cloud(bed.sim, set, N, DX, 0.05, 0.2, 2);
    if (f->held) {
        for (int k = 0; k < SPH_DIM; k++)
            hi[k] = N * DX;
        lo[0] = -2 * DX;
        hi[0] = 0;
        m.held = 1;
        m.motion = motion;
        must(bed.sim, sph_add_solid(bed.sim, &m, &other, NULL));
        must(bed.sim, sph_add_box(bed.sim, other, lo, hi, NULL));
    }
#if SPH_HAS_DAMAGE
    const sph_flaws flaws = {1e12, 6, 5};
    if (f->damage)
        must(bed.sim, sph_add_flaws(bed.sim, set, &flaws));
#endif
}

static void make_bed(const fault_case *f, const sph_port *port)
{
    sph_config c = case_config(f);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    uint32_t set;
    memset(&fault, 0, sizeof fault);
    if (port)
        c.port = *port;
    bed.sim = new_sim(&c);
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = N * DX;
    w.kind = f->wall;
    w.compressible = c.density == SPH_CONTINUITY;
    w.strength = f->wall == SPH_WALL_LENNARD_JONES ? 0.02 : 0;
    w.motion = motion;
    if (f->solid)
        add_rock(f);
    else {
        must(bed.sim, sph_add_fluid(bed.sim, NULL, &set));
        random_cloud(bed.sim, set, N, DX, 0.05, 0.2, 2);
    }
    if (!f->held)
        must(bed.sim, sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0) | SPH_LOW(SPH_DIM - 1), true, NULL));
    for (int k = 0; k < 3; k++)
        must(bed.sim, sph_step(bed.sim));
    bed.arena = sims[sim_count - 1].arena;
    bed.bytes = sims[sim_count - 1].bytes;
    bed.image = malloc(bed.bytes);
    assert_non_null(bed.image);
    memcpy(bed.image, bed.arena, bed.bytes);
    bed.now = sph_hash(bed.sim);
    must(bed.sim, sph_step(bed.sim));
    bed.next = sph_hash(bed.sim);
    must(bed.sim, sph_step(bed.sim));
    bed.later = sph_hash(bed.sim);
    assert_true(bed.now != bed.next && bed.next != bed.later);
}
static void rewind_bed(void) { memcpy(bed.arena, bed.image, bed.bytes); }
static void unmake_bed(void)
{
    free(bed.image);
    assert_int_equal(free_sims(NULL), 0);
}

/* ---- where and what ---- */

static const double poisons[] = {0, 1, -1, 1e30, -1e30}; /* 0: not a number; 1, -1: infinite */
enum { POISONS = sizeof poisons / sizeof *poisons };
static sph_real poison_value(uint32_t k)
{
    const double p = poisons[k];
    return (sph_real)(p == 0 ? NAN : p == 1 ? INFINITY : p == -1 ? -INFINITY : p);
}

/* array number `a` of reals of a buffer, or what modules add; null behind the last */
static sph_real *real_array(sph_sim *sim, const sph_buffer *b, uint32_t a)
{
    sph_real *list[64];
    uint32_t n = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        list[n++] = b->vel[k];
        list[n++] = b->acc[k];
        if (b->xsph[k])
            list[n++] = b->xsph[k];
    }
    list[n++] = b->rho[0];
    list[n++] = b->drho[0];
    for (uint32_t k = 0; k < SPH_NS && b->stress[0]; k++) {
        list[n++] = b->stress[k];
        list[n++] = b->dstress[k];
    }
    if (b->plastic[0])
        list[n++] = b->plastic[0];
    if (b->damage[0])
        list[n++] = b->damage[0];
    for (uint32_t k = 0; k < SPH_NL && sim->corr[0]; k++)
        list[n++] = sim->corr[k];
    if (sim->tmp)
        list[n++] = sim->tmp;
    for (uint32_t k = 0; k < SPH_POWERS; k++)
        if (sim->power[k])
            list[n++] = sim->power[k];
    return a < n ? list[a] : NULL;
}

static bool state_finite(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    bool fine = true;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        fine &= sph_finite((double)b->rho[0][i]) && sph_finite((double)b->drho[0][i]);
        for (uint32_t k = 0; k < SPH_NS && b->stress[0]; k++)
            fine &= sph_finite((double)b->stress[k][i]) && sph_finite((double)b->dstress[k][i]);
        fine &= !b->plastic[0] || (b->plastic[0][i] >= 0 && sph_finite((double)b->plastic[0][i]));
        fine &= !b->damage[0] || (b->damage[0][i] >= 0 && b->damage[0][i] <= 1);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            fine &= sph_finite((double)b->vel[k][i]) && sph_finite((double)b->acc[k][i]) &&
                    (!b->xsph[k] || sph_finite((double)b->xsph[k][i]));
    }
    return fine;
}

static bool documented(sph_status st)
{
    return st == SPH_NOT_FINITE || st == SPH_DENSITY_LOST || st == SPH_OUT_OF_DOMAIN || st == SPH_MOVED_TOO_FAR ||
           st == SPH_WALL_CROSSED || st == SPH_STEP_COLLAPSED || st == SPH_BOND_TOO_LONG;
}

/* how often a fault was refused, overwritten by the step, or carried into the next one */
typedef struct tally {
    uint32_t refused, erased, carried;
} tally;

static sph_status finish_slices(sph_sim *sim)
{
    sph_status st = SPH_NOT_DONE;
    for (uint32_t k = 0; st == SPH_NOT_DONE; k++) {
        assert_true(k < 100000);
        st = sph_step_slice(sim, SLICE);
    }
    return st;
}

/* what must hold after a step with a fault in it; `s`: the state before, fault included if it was put there */
static void judge(const fault_case *f, const char *where, uint32_t at, sph_status st, snapshot *s, tally *t)
{
    if (st == SPH_OK) {
        free(s->arrays);
        if (sph_hash(bed.sim) == bed.next) {
            t->erased++;
            return;
        }
        t->carried++; /* the fault came after the last look: the next step must find it, or have no use for it */
        st = sph_step(bed.sim);
        if (st ? !documented(st) : !state_finite(bed.sim))
            fail_msg("%s: %s %u: not found in the next step either (%s)", f->name, where, at, sph_status_text(st));
        return;
    }
    if (!documented(st) || sph_last(bed.sim)->status != st)
        fail_msg("%s: %s %u: status %s", f->name, where, at, sph_status_text(st));
    if (!state_kept(bed.sim, s))
        fail_msg("%s: %s %u: %s, but the state has changed", f->name, where, at, sph_status_text(st));
    t->refused++;
}

/* the run goes on to the hashes of one that was never disturbed */
static void goes_on(const fault_case *f, const char *where, uint32_t at)
{
    must(bed.sim, sph_step(bed.sim));
    if (sph_hash(bed.sim) != bed.next)
        fail_msg("%s: %s %u: the run did not go on as if nothing had been", f->name, where, at);
    must(bed.sim, sph_step(bed.sim));
    assert_true(sph_hash(bed.sim) == bed.later);
}

/* ---- faults in the buffer being written ---- */

/* begins a step, does n slices; false if it was done before */
static bool slices(uint32_t n)
{
    for (uint32_t k = 0; k < n; k++)
        if (sph_step_slice(bed.sim, SLICE) != SPH_NOT_DONE)
            return false;
    return true;
}

static void poison_target(const fault_case *f, uint32_t after, uint32_t array, tally *t)
{
    for (uint32_t p = 0; p < POISONS; p++) {
        snapshot s;
        rewind_bed();
        keep_state(bed.sim, &s);
        assert_true(slices(after));
        sph_real *a = real_array(bed.sim, &bed.sim->buf[bed.sim->dst], array);
        a[bed.sim->now.count / 3] = poison_value(p);
        const uint32_t refused = t->refused;
        judge(f, "array of the target", array, finish_slices(bed.sim), &s, t);
        if (t->refused > refused)
            goes_on(f, "array of the target", array);
    }
}

static void a_poisoned_target_is_found_and_forgotten(void **state)
{
    tally t = {0, 0, 0};
    (void)state;
    for (const fault_case *f = cases; f < cases + CASES; f++) {
        make_bed(f, NULL);
        for (uint32_t after = 1;; after += f->solid ? SPH_DIM + 1u : 1u) {
            rewind_bed();
            if (!slices(after))
                break;
            for (uint32_t a = 0; real_array(bed.sim, &bed.sim->buf[0], a); a++)
                poison_target(f, after, a, &t);
        }
        unmake_bed();
    }
    print_message("target: %u refused, %u erased, %u carried to the next step\n", t.refused, t.erased, t.carried);
    assert_true(t.refused > 100 && t.erased > 100);
}

/* a position thrown anywhere: the sums may change, memory and the committed state may not */
static void a_thrown_position_breaks_nothing(void **state)
{
    tally t = {0, 0, 0};
    (void)state;
    for (const fault_case *f = cases; f < cases + CASES; f++) {
        make_bed(f, NULL);
        for (uint32_t after = 1;; after += f->solid ? SPH_DIM + 1u : 1u) {
            rewind_bed();
            if (!slices(after))
                break;
            for (uint32_t k = 0; k < 4 * SPH_DIM; k++) {
                const sph_pos e = bed.sim->grid.extent[k / 4], far[] = {-e, -1, e,
                    2 * e - 1 - bed.sim->grid.cell_size[k / 4]};
                snapshot s;
                rewind_bed();
                keep_state(bed.sim, &s);
                slices(after);
                bed.sim->buf[bed.sim->dst].pos[k / 4][bed.sim->now.count / 2] = far[k % 4];
                const sph_status st = finish_slices(bed.sim);
                if (st == SPH_OK) { /* it may have been overwritten, or be found outside by the next step */
                    t.carried++;
                    free(s.arrays);
                    const sph_status then = sph_step(bed.sim);
                    assert_true(then == SPH_OK || documented(then));
                    continue;
                }
                judge(f, "position", k, st, &s, &t);
                goes_on(f, "position", k);
            }
        }
        unmake_bed();
    }
    print_message("positions: %u refused, %u not seen in their step\n", t.refused, t.carried);
    assert_true(t.refused > 0 && t.carried > 0);
}

/* ---- faults in the buffer being read ---- */

static void poison_source(const fault_case *f, uint32_t array, uint32_t at, tally *t)
{
    for (uint32_t p = 0; p < POISONS; p++) {
        snapshot s;
        rewind_bed();
        sph_real *a = real_array(bed.sim, &bed.sim->buf[bed.sim->cur], array), good = a[at];
        a[at] = poison_value(p);
        keep_state(bed.sim, &s);
        const uint32_t refused = t->refused;
        judge(f, "array of the source", array, sph_step(bed.sim), &s, t);
        if (t->refused == refused)
            continue;
        a[at] = good; /* what a host that mends the cause would do */
        goes_on(f, "array of the source", array);
    }
}

static void a_poisoned_source_is_found_and_left_as_it_is(void **state)
{
    tally t = {0, 0, 0};
    (void)state;
    for (const fault_case *f = cases; f < cases + CASES; f++) {
        make_bed(f, NULL);
        for (uint32_t a = 0; real_array(bed.sim, &bed.sim->buf[0], a); a++)
            for (uint32_t at = 0; at < bed.sim->now.count; at += (SPH_DIM == 3 ? 31u : 7u) * (f->solid ? 3u : 1u))
                poison_source(f, a, at, &t);
        unmake_bed();
    }
    print_message("source: %u refused, %u erased, %u carried to the next step\n", t.refused, t.erased, t.carried);
    assert_true(t.refused > 500);
}

/* the same fault, found by threads in any order: same status, same particle */
static void a_fault_is_told_the_same_by_threads_in_any_order(void **state)
{
    shuffle order;
    const sph_port port = shuffle_port(&order, 3);
    (void)state;
    for (const fault_case *f = cases; f < cases + CASES; f++) {
        sph_report alone[64] = {{SPH_OK, "", "", "", 0, SPH_NO_PARTICLE, 0, 0}};
        for (int turn = 0; turn < 2; turn++) {
            uint32_t n = 0;
            make_bed(f, turn ? &port : NULL);
            for (uint32_t a = 0; n < 64 && real_array(bed.sim, &bed.sim->buf[0], a); a++) {
                rewind_bed();
                sph_real *array = real_array(bed.sim, &bed.sim->buf[bed.sim->cur], a);
                for (uint32_t i = a; i < bed.sim->now.count; i += 11)
                    array[i] = poison_value(a % POISONS);
                const sph_status st = sph_step(bed.sim);
                const sph_report *r = sph_last(bed.sim);
                if (turn)
                    assert_true(alone[n].status == st && (!st || (alone[n].particle == r->particle &&
                                                                  strcmp(alone[n].pass, r->pass) == 0)));
                alone[n] = *r;
                alone[n++].status = st;
            }
            unmake_bed();
        }
    }
    assert_true(order.calls > 0);
}

/* nothing of a thread's scratch lives from slice to slice: numbers that are none in all of it change no bit */
static void scratch_between_slices_does_not_matter(void **state)
{
    (void)state;
    for (const fault_case *f = cases; f < cases + CASES; f++) {
        make_bed(f, NULL);
        rewind_bed();
        for (sph_status st = SPH_NOT_DONE; st == SPH_NOT_DONE;) {
            st = sph_step_slice(bed.sim, SLICE);
            for (uint32_t t = 0; t < bed.sim->cfg.max_threads; t++) {
                memset(&bed.sim->thread[t], 0xff, offsetof(sph_thread, work)); /* all bits set is not a number */
                bed.sim->thread[t].points.n = bed.sim->thread[t].home.n = bed.sim->thread[t].matter.n = 0;
                bed.sim->thread[t].ghosts.n = 0;
            }
            memset(bed.sim->extra, 0xff, sizeof(sph_real) * bed.sim->extra_reals * bed.sim->cfg.max_threads);
            assert_true(st == SPH_OK || st == SPH_NOT_DONE);
        }
        if (sph_hash(bed.sim) != bed.next)
            fail_msg("%s: scratch shows in the state", f->name);
        unmake_bed();
    }
}

/* nor does what lies behind the last particle of any array */
static void bytes_behind_the_last_particle_do_not_matter(void **state)
{
    (void)state;
    for (const fault_case *f = cases; f < cases + CASES; f++) {
        make_bed(f, NULL);
        rewind_bed();
        for (uint32_t b = 0; b < bed.sim->buffers; b++)
            for (uint32_t a = 0; real_array(bed.sim, &bed.sim->buf[b], a); a++)
                for (uint32_t i = bed.sim->now.count; i < bed.sim->cfg.max_particles + SPH_PAD; i++)
                    real_array(bed.sim, &bed.sim->buf[b], a)[i] = poison_value(i % POISONS);
        goes_on(f, "behind the last particle", 0);
        unmake_bed();
    }
}

/* ---- callbacks that go wrong ---- */

static void fails_and_goes_on(const fault_case *f, const char *where, uint32_t k, bool at_once)
{
    snapshot s;
    tally t = {0, 0, 0};
    rewind_bed();
    keep_state(bed.sim, &s);
    sph_status st = at_once ? sph_step(bed.sim) : finish_slices(bed.sim);
    if (st == SPH_OK)
        fail_msg("%s: %s %u: was not refused", f->name, where, k);
    judge(f, where, k, st, &s, &t);
    memset(&fault, 0, sizeof fault);
    goes_on(f, where, k);
}

static void callbacks_that_go_wrong_fail_the_step(void **state)
{
    static const double wrong[] = {0, 1, -1, 1e300, -1e300, 1e20};
    (void)state;
    for (const fault_case *f = cases; f < cases + CASES; f++) {
        make_bed(f, NULL);
        for (uint32_t k = 0; k < 2 * sizeof wrong / sizeof *wrong; k++) {
            const double p = wrong[k / 2], value = p == 0 ? NAN : p == 1 ? INFINITY : p == -1 ? -INFINITY : p;
            fault.from_t = sph_time(bed.sim) * 1e-9;
            fault.body = value;
            fails_and_goes_on(f, "body force", k, k & 1);
            fault.wall = value;
            fails_and_goes_on(f, "motion", k, k & 1);
        }
        fault.wall = 1.5 * N * DX; /* finite, but out of the domain, or a leap; a held set stays inside */
        if (!f->held)
            fails_and_goes_on(f, "leap", 0, true);
        fault.wall = 4 * N * DX;
        fails_and_goes_on(f, "leap", 1, true);
        unmake_bed();
    }
}

/* ---- a wall that leaps by a domain: refused, but round a periodic one it is where it was ---- */

static void leap(bool round)
{
    sph_config c = round ? periodic_config(1, DX) : open_config(1, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t set;
    memset(&fault, 0, sizeof fault);
    fault.from_t = 1e-12;
    sph_sim *sim = new_sim(&c);
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = 0.4;
        hi[k] = 0.7;
    }
    w.motion = motion;
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    must(sim, sph_ready(sim));
    const uint64_t before = sph_hash(sim);
    fault.wall = round ? -2 : -4; /* the open domain is 3 long */
    if (!round) {
        assert_int_equal(sph_step(sim), SPH_MOVED_TOO_FAR);
        assert_string_equal(sph_last(sim)->what, "motion of a wall");
        assert_true(sph_hash(sim) == before);
        fault.wall = 0;
    }
    must(sim, sph_step(sim));
}
static void a_wall_may_not_leap_by_a_domain(void **state)
{
    (void)state;
    leap(false);
    leap(true);
}

/* ---- sinks ---- */

typedef struct meter {
    size_t room, n;
} meter;
static bool take_some(void *ctx, const void *bytes, size_t n)
{
    meter *m = ctx;
    (void)bytes;
    m->n += n;
    return m->n <= m->room;
}
static void a_sink_that_fails_at_any_byte_is_told(void **state)
{
    (void)state;
    make_bed(&cases[0], NULL);
    meter whole = {(size_t)-1, 0};
    snapshot s;
    must(bed.sim, sph_dump(bed.sim, SPH_DUMP_FULL, take_some, &whole));
    keep_state(bed.sim, &s);
    for (size_t room = 0; room < whole.n; room++) {
        meter m = {room, 0};
        assert_int_equal(sph_dump(bed.sim, SPH_DUMP_FULL, take_some, &m), SPH_SINK_FAILED);
        assert_true(m.n > room && m.n <= room + SPH_PIECE); /* it was not asked again */
    }
    assert_true(state_kept(bed.sim, &s));
    unmake_bed();
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_poisoned_target_is_found_and_forgotten),
        subject(a_thrown_position_breaks_nothing),
        subject(a_poisoned_source_is_found_and_left_as_it_is),
        subject(a_fault_is_told_the_same_by_threads_in_any_order),
        subject(scratch_between_slices_does_not_matter),
        subject(bytes_behind_the_last_particle_do_not_matter),
        subject(callbacks_that_go_wrong_fail_the_step),
        subject(a_wall_may_not_leap_by_a_domain),
        subject(a_sink_that_fails_at_any_byte_is_told),
    };
    return run_subjects("faults", list);
}
