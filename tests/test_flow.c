/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_flow.c: inflows and outflows: a uniform stream keeps its lattice to the last bit, books of mass and ids are
   exact over many particles, a full capacity is a status and leaves the state, restarts in mid-layer, slices and
   threads change nothing, energy is accounted for, and what is refused. */
#include "testing.h"

#define DX 0.125 /* powers of two: masses add up exactly */
#define LAYERS 4
#define REACH 16 /* spacings along the channel, with both boxes */
#define ACROSS 8

enum { ROWS = SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? ACROSS : ACROSS * ACROSS };

/* a channel along the first axis, periodic across; speed and time step: spacings a step */
static sph_config channel(double spacings, uint32_t room)
{
    sph_config c = open_config(1, DX);
    c.smoothing_length = 1.25 * DX;
    c.sound_speed = 2;
    c.max_flows = 2;
    c.max_particles = room;
    c.dt = spacings * DX / 1.0;
    c.cfl = 10;
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = k ? 0 : -DX;
        c.hi[k] = k ? ACROSS * DX : (REACH + 1) * DX;
        if (k)
            c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
    }
    return c;
}

/* inflow, water, outflow; in: lo .. hi of the inflow's box; *set: of the inflow */
static sph_sim *stream(const sph_config *c, double speed, uint32_t *inflow)
{
    uint32_t water, out;
    sph_flow f = {.face = SPH_HIGH(0), .speed = speed};
    double lo[SPH_DIM], hi[SPH_DIM], v[SPH_DIM] = {speed};
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &water));
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = f.lo[k] = 0;
        hi[k] = f.hi[k] = ACROSS * DX;
    }
    lo[0] = f.hi[0] = LAYERS * DX;
    hi[0] = (REACH - LAYERS) * DX;
    must(sim, sph_add_inflow(sim, water, &f, inflow));
    must(sim, sph_add_box(sim, water, lo, hi, v));
    f.face = SPH_LOW(0);
    f.lo[0] = hi[0];
    f.hi[0] = REACH * DX;
    must(sim, sph_add_outflow(sim, water, &f, &out));
    return sim;
}

/* makes it uneven: waves in density, rows of different speeds */
static void uneven(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx;
    v[0] *= 1 + (SPH_DIM > 1 ? 0.3 * sin(2 * 3.14159265358979 * x[SPH_DIM - 1] / (ACROSS * DX)) : 0);
    *rho = 1000 * (1 + 0.002 * sin(9 * x[0]));
}
static sph_sim *uneven_stream(const sph_config *c, double speed)
{
    uint32_t in;
    sph_sim *sim = stream(c, speed, &in);
    for (uint32_t set = 0; set < 2; set++)
        must(sim, sph_apply_field(sim, set, uneven, NULL));
    return sim;
}

static uint64_t whole(double x)
{
    close_to(x, floor(x + 0.5), 0);
    return (uint64_t)(x + 0.5);
}

/* ids below max_particles, each once; the books of mass are those of the particles; returns how many were born */
static uint64_t check_books(const sph_sim *sim, const sph_config *c, uint32_t first)
{
    static uint8_t seen[20000];
    const double m = 1000 * pow(DX, SPH_DIM);
    sph_particle p;
    sph_totals t;
    sph_step_info info;
    sph_get_totals(sim, &t);
    sph_get_step(sim, &info);
    memset(seen, 0, sizeof seen);
    uint32_t alive = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        assert_true(p.id < c->max_particles && !seen[p.id]);
        seen[p.id] = 1;
        alive += p.mass > 0;
    }
    const uint64_t born = whole(t.added_mass / m), gone = whole(t.removed_mass / m);
    assert_int_equal(first + born - gone, alive);
    assert_int_equal(gone, info.left);
    close_to(t.mass, alive * m, 0);
    return born;
}

/* ---- ---- */

/* a stream of one velocity and density 0 feels nothing: its lattice goes on for ever, row by row, to the quantum */
static void a_uniform_stream_keeps_its_lattice_to_the_last_bit(void **state)
{
    (void)state;
    for (uint32_t by = 0; by < SPH_INTEGRATORS; by++) {
        uint32_t in;
        sph_config c = channel(0.3, 20000);
        c.integrator = by;
        sph_sim *sim = stream(&c, 1, &in);
        for (uint32_t k = 0; k < (SPH_DIM == 3 ? 40 : 200); k++)
            must(sim, sph_step(sim));
        sph_particle p;
        double least = 1e300, at[REACH + 2] = {0};
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_get(sim, i, &p);
            close_to(p.v[0], 1, 0);
            close_to(p.rho, 1000, 0);
            least = p.x[0] < least ? p.x[0] : least;
        }
        for (uint32_t i = 0; i < sph_count(sim); i++) { /* all of a layer at one place, layers a spacing apart */
            sph_get(sim, i, &p);
            const uint32_t layer = (uint32_t)((p.x[0] - least) / DX + 0.5);
            at[layer] = at[layer] > 0 ? at[layer] : p.x[0];
            close_to(p.x[0], at[layer], 0);
            close_to(p.x[0], least + layer * DX, 0);
        }
        check_books(sim, &c, (REACH - LAYERS) * ROWS);
        free_sims(state);
    }
}

/* 10^5 particles in one dimension, 10^4 in two, 3,000 in three go through */
static void books_of_mass_and_ids_are_exact_over_many_particles(void **state)
{
    const uint64_t wanted = SPH_DIM == 1 ? 100000 : SPH_DIM == 2 ? 10000 : 3000;
    const uint32_t first = (REACH - LAYERS) * ROWS;
    uint64_t born = 0;
    uint32_t in, most = 0;
    (void)state;
    sph_config c = channel(0.9, (REACH + 2) * ROWS + 5);
    sph_sim *sim = stream(&c, 1, &in);
    for (uint32_t k = 0; born < wanted; k++) {
        must(sim, sph_step(sim));
        most = sph_count(sim) > most ? sph_count(sim) : most;
        if (k % 1000 == 0)
            born = check_books(sim, &c, first);
        else if (k % 100 == 0) {
            sph_totals t;
            sph_get_totals(sim, &t);
            born = whole(t.added_mass / (1000 * pow(DX, SPH_DIM)));
        }
    }
    assert_true(check_books(sim, &c, first) >= wanted);
    sph_usage u;
    sph_get_usage(sim, &u);
    const uint64_t more = 4 * c.max_particles + 512 + 130 * ROWS;
    assert_true(u.step_work <= SPH_STEP_WORK(1, u.particles, u.cell_particles, u.cells) + more);
    assert_true(most <= (REACH + 2) * ROWS);
}

/* what is in an inflow or outflow keeps velocity and density, whatever forces, filters, damping and shifting want */
static void what_flows_carry_keeps_velocity_and_density(void **state)
{
    static sph_particle was[20000];
    for (uint32_t by = 0; by < SPH_INTEGRATORS; by++) {
        sph_config c = channel(0.17, 20000);
        uint32_t kept = 0;
        c.integrator = by;
        c.xsph = by % 2 ? 0.5 : 0;
        c.shepard_every = 3;
        c.damping = 0.999;
        c.shifting = SPH_DIM > 1 ? 0.5 : 0;
        c.sponge_low[0] = 2 * DX;
        c.sponge_rate = 5;
        sph_sim *sim = uneven_stream(&c, 1);
        for (uint32_t k = 0; k < (SPH_DIM == 3 ? 8 : 40); k++) {
            memset(was, 0, sizeof was);
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                sph_particle p;
                sph_get(sim, i, &p);
                was[p.id] = p;
            }
            must(sim, sph_step(sim));
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                sph_particle p;
                sph_get(sim, i, &p);
                if (p.set == 0 || was[p.id].set != p.set || p.mass == 0)
                    continue;
                close_to(p.rho, was[p.id].rho, 0);
                for (int a = 0; a < SPH_DIM; a++)
                    close_to(p.v[a], was[p.id].v[a], 0);
                kept++;
            }
        }
        assert_true(kept > 100);
        free_sims(state);
    }
}

/* along the second axis too: what flows hold has the speed along their axis and nothing across it */
static void what_comes_in_goes_along_its_axis_only(void **state)
{
    for (uint32_t axis = 0; axis < SPH_DIM; axis++)
        for (uint32_t up = 0; up < 2; up++) {
            sph_config c = channel(0.3, 5000);
            sph_flow f = {.face = up ? SPH_HIGH(axis) : SPH_LOW(axis), .speed = 1.5};
            uint32_t water, set;
            sph_particle p;
            for (uint32_t k = 0; k < SPH_DIM; k++)
                f.hi[k] = k == axis ? LAYERS * DX : 3 * DX;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &water));
            must(sim, sph_add_inflow(sim, water, &f, &set));
            assert_true(sph_count(sim) > 0);
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                assert_int_equal(sph_get(sim, i, &p), SPH_OK);
                for (uint32_t k = 0; k < SPH_DIM; k++)
                    assert_true(p.v[k] == (k != axis ? 0 : up ? 1.5 : -1.5));
            }
            free_sims(state);
        }
}

static void a_full_capacity_is_a_status_that_says_the_need_and_leaves_the_state(void **state)
{
    const uint32_t first = (REACH - LAYERS) * ROWS;
    for (uint32_t room = first; room < first + 3 * ROWS + 2; room += SPH_DIM == 3 ? 23 : 1) {
        sph_status st = SPH_OK;
        uint32_t k = 0;
        sph_config c = channel(0.1, room);
        sph_sim *sim = uneven_stream(&c, 1);
        uint64_t before = 0;
        must(sim, sph_ready(sim));
        for (; k < 200 && st == SPH_OK; k++) {
            before = sph_hash(sim);
            st = sph_step(sim);
            assert_true(sph_count(sim) <= room);
        }
        assert_int_equal(st, SPH_TOO_MANY_PARTICLES);
        const sph_report *r = sph_last(sim);
        assert_string_equal(r->what, "max_particles");
        assert_string_equal(r->pass, "births");
        assert_true(r->value > room && r->value <= room + ROWS);
        assert_true(sph_hash(sim) == before);
        assert_true(sph_count(sim) <= room);
        const double need = r->value;
        assert_int_equal(sph_step(sim), SPH_TOO_MANY_PARTICLES); /* and again, with the same need */
        close_to(sph_last(sim)->value, need, 0);
        assert_true(sph_hash(sim) == before);
        /* as many as it says are enough for this step */
        sph_config more = c;
        more.max_particles = (uint32_t)need;
        sph_sim *other = uneven_stream(&more, 1);
        for (uint32_t j = 0; j < k; j++)
            must(other, sph_step(other));
        free_sims(state);
    }
}

typedef struct tape {
    size_t n, at;
} tape;
static unsigned char bytes[1 << 22];
static bool record(void *ctx, const void *p, size_t n)
{
    tape *t = ctx;
    assert_true(t->n + n <= sizeof bytes);
    memcpy(bytes + t->n, p, n);
    t->n += n;
    return true;
}
static bool play(void *ctx, void *p, size_t n)
{
    tape *t = ctx;
    if (t->at + n > t->n)
        return false;
    memcpy(p, bytes + t->at, n);
    t->at += n;
    return true;
}

/* one runs; two is restored from it before every step, that is in mid-layer; three works in slices, on threads */
static void restarts_slices_and_threads_change_nothing(void **state)
{
    for (uint32_t by = 0; by < SPH_INTEGRATORS; by++) {
        uint32_t in;
        sph_config c = channel(0.17, 20000);
        c.integrator = by;
        c.books = true;
        c.xsph = by % 2 ? 0.5 : 0;
        c.shepard_every = 3;
        c.damping = 0.999;
        c.shifting = SPH_DIM > 1 && by % 2 ? 0.5 : 0;
        sph_sim *one = uneven_stream(&c, 1), *two = stream(&c, 1, &in);
        shuffle mixed;
        c.max_threads = 3;
        c.port = shuffle_port(&mixed, 3);
        sph_sim *three = uneven_stream(&c, 1);
        for (uint32_t k = 0; k < (SPH_DIM == 3 ? 12 : 40); k++) {
            tape t = {0, 0};
            assert_int_equal(sph_dump(one, SPH_DUMP_FULL, record, &t), SPH_OK);
            must(two, sph_restore(two, play, &t));
            must(one, sph_step(one));
            must(two, sph_step(two));
            sph_status st = SPH_NOT_DONE;
            while (st == SPH_NOT_DONE)
                st = sph_step_slice(three, 40 + k);
            must(three, st);
            assert_true(sph_hash(one) == sph_hash(two));
            assert_true(sph_hash(one) == sph_hash(three));
        }
        free_sims(state);
    }
}

/* the balance of all books stays: what flows do to water is wall_work, what comes and goes is fed and carried off */
static void energy_is_accounted_for(void **state)
{
    for (uint32_t by = 0; by < SPH_INTEGRATORS; by++) {
        double off[2] = {0, 0}, scale = 0;
        for (uint32_t half = 0; half < 2; half++) {
            sph_config c = channel(half ? 0.01 : 0.02, 20000);
            sph_totals first, t;
            c.integrator = by;
            c.books = true;
            c.alpha = 0.1;
            sph_sim *sim = uneven_stream(&c, 1);
            must(sim, sph_ready(sim));
            sph_get_totals(sim, &first);
            while (sph_time(sim) < 2.2 * DX)
                must(sim, sph_step_to(sim, 2.2 * DX));
            sph_get_totals(sim, &t);
            assert_true(t.added_mass > 0 && t.fed > 0);
            off[half] = fabs(t.balance - first.balance);
            scale = fabs(t.fed);
            free_sims(state);
        }
        /* of first order where layers begin to feel forces; below 0.2 % of what came in, and less with shorter steps */
        if (!(off[1] < 2e-3 * scale))
            fail_msg("integrator %u: balance off by %g and %g of %g", by, off[0], off[1], scale);
    }
}

/* damping by a rate takes nothing of what a flow holds, also in the step in which it takes water over, and then from
   whom an inflow has let go; its book is what they lose. Nobody feels a force: the boxes are far apart */
static void damping_books_what_it_takes_of_who_is_free(void **state)
{
    for (uint32_t by = 0; by < SPH_INTEGRATORS; by++) {
        const double hi = REACH * DX, m = 1000 * pow(DX, SPH_DIM);
        double lost = 0, lo[SPH_DIM] = {hi - LAYERS * DX}, to[SPH_DIM] = {hi}, v[SPH_DIM] = {1};
        uint32_t water, set;
        sph_flow f = {.face = SPH_HIGH(0), .speed = 1};
        sph_config c = channel(0.3, 20000);
        sph_particle p;
        sph_totals t;
        c.integrator = by;
        c.damping_rate = 0.5 / c.dt;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &water));
        for (int k = 1; k < SPH_DIM; k++)
            to[k] = f.hi[k] = ACROSS * DX;
        f.hi[0] = LAYERS * DX;
        must(sim, sph_add_inflow(sim, water, &f, &set));
        must(sim, sph_add_box(sim, water, lo, to, v));
        f = (sph_flow){.face = SPH_LOW(0)};
        memcpy(f.lo, lo, sizeof lo);
        memcpy(f.hi, to, sizeof to);
        must(sim, sph_add_outflow(sim, water, &f, &set));
        must(sim, sph_ready(sim));
        must(sim, sph_step(sim)); /* all of the water is the outflow's now */
        sph_get_totals(sim, &t);
        close_to(t.slowed, 0, 0);
        must(sim, sph_step(sim));
        must(sim, sph_step(sim)); /* a layer of the inflow has become water */
        sph_get_totals(sim, &t);
        assert_true(t.added_mass > 0);
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            assert_int_equal(sph_get(sim, i, &p), SPH_OK);
            assert_true(p.v[0] == 1 || p.x[0] > LAYERS * DX);
            lost += p.mass * (1 - p.v[0] * p.v[0]) / 2;
        }
        assert_true(lost > 0.1 * m * ROWS);
        close_to(t.slowed, lost, (SPH_DOUBLE ? 1e-12 : 1e-5) * lost);
        free_sims(state);
    }
}

static void what_is_not_allowed_is_refused(void **state)
{
    uint32_t water, set;
    sph_report r;
    (void)state;
    sph_config c = channel(0.3, 5000);
    c.density = SPH_SUMMATION;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "density");
    c.density = SPH_CONTINUITY;
    c.max_flows = 17;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "max_flows");
    c.max_flows = 1;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &water));
    sph_flow good = {.face = SPH_HIGH(0), .speed = 1}, bad;
    for (int k = 0; k < SPH_DIM; k++)
        good.hi[k] = k ? ACROSS * DX : LAYERS * DX;
#define REFUSED(change, name)                                                                                         \
    do {                                                                                                              \
        bad = good;                                                                                                   \
        change;                                                                                                       \
        assert_int_equal(sph_add_inflow(sim, water, &bad, &set), SPH_BAD_ARGUMENT);                                   \
        assert_string_equal(sph_last(sim)->what, name);                                                               \
    } while (0)
    REFUSED(bad.face = 0, "face");
    REFUSED(bad.face = SPH_LOW(0) | SPH_HIGH(0), "face");
    REFUSED(bad.face = SPH_LOW(SPH_DIM), "face");
    REFUSED(bad.speed = 0, "speed");
    REFUSED(bad.speed = NAN, "speed");
    REFUSED(bad.hi[0] = 0, "hi");
    REFUSED(bad.hi[0] = 1.5 * DX, "hi");
    REFUSED(bad.hi[0] = 4.5 * DX, "hi");
    REFUSED(bad.lo[0] = NAN, "hi");
    assert_int_equal(sph_add_inflow(sim, 7, &good, &set), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_add_inflow(NULL, water, &good, &set), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_add_outflow(sim, water, NULL, &set), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_count(sim), 0);
    must(sim, sph_add_inflow(sim, water, &good, &set));
    assert_int_equal(sph_add_outflow(sim, water, &good, &set), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "max_flows");
    must(sim, sph_step(sim));
    assert_int_equal(sph_add_inflow(sim, water, &good, &set), SPH_BAD_STATE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        subject(a_uniform_stream_keeps_its_lattice_to_the_last_bit),
        subject(books_of_mass_and_ids_are_exact_over_many_particles),
        subject(what_flows_carry_keeps_velocity_and_density),
        subject(what_comes_in_goes_along_its_axis_only),
        subject(a_full_capacity_is_a_status_that_says_the_need_and_leaves_the_state),
        subject(restarts_slices_and_threads_change_nothing),
        subject(energy_is_accounted_for),
        subject(damping_books_what_it_takes_of_who_is_free),
        subject(what_is_not_allowed_is_refused),
    };
    return run_subjects("flow", tests);
}
