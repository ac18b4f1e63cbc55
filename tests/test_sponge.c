/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_sponge.c: sponge layers: a lone particle against the integral of its equation, the order in time, what must not
   be touched, the book, refusals, and that restarts, slices, threads and failures change nothing. That they take in
   waves is tested by tests/test_atlas.c. */
#include "any_way.h"
#include "testing.h"

#define DX 0.1
#define EDGE 1.0

enum { Y = SPH_DIM > 1 }; /* an axis along the face, where there is one */

/* nothing but what the layers do: the domain is [-1, 2] along every axis */
static sph_config quiet(double dt)
{
    sph_config c = open_config(EDGE, DX);
    c.viscosity = SPH_INVISCID;
    c.dt = dt;
    return c;
}

static sph_sim *lone(const sph_config *c, double x0, const double *v)
{
    uint32_t set;
    sph_sim *sim = new_sim(c);
    double x[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = k ? 0.5 * EDGE : x0;
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
    return sim;
}

/* depth in the layer at the low face of the first axis over its width */
static UNUSED double depth(const sph_config *c, const sph_particle *p)
{
    const double s = 1 - (p->x[0] - c->lo[0]) / c->sponge_low[0];
    return s > 0 ? s : 0;
}

/* ---- the equation ---- */

#if SPH_DIM > 1
/* along the face s stays, and v = v0 exp(-r s^2 t) at any step, cut or not */
static void along_the_face_velocity_dies_as_the_exponential(void **state)
{
    static const double cut[] = {0.013, 0.0131, 0.05, 0.11, 0.1234, 0.2};
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++)
        for (double dt = 0.4e-3; dt < 0.06; dt *= 10) {
            sph_config c = quiet(dt);
            const double v0 = 2, v[SPH_DIM] = {0, v0};
            c.integrator = i;
            c.sponge_low[0] = 1.5;
            c.sponge_rate = 40;
            sph_sim *sim = lone(&c, -0.6, v);
            uint32_t steps = 0;
            for (size_t k = 0; k < sizeof cut / sizeof *cut; k++)
                for (; sph_time(sim) < cut[k]; steps++)
                    must(sim, sph_step_to(sim, cut[k]));
            const sph_particle p = by_id(sim, 0);
            const double s = depth(&c, &p), want = v0 * sph_exp(-40 * s * s * sph_time(sim));
            assert_true(s > 0.7 && s < 0.75 && want < 0.1);
            close_to(p.v[1], want, steps * EPS * want);
            assert_true(p.v[0] == 0);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* where layers meet their rates add up */
static void in_a_corner_rates_add_up(void **state)
{
    const double v[SPH_DIM] = {0.5, -0.25};
    (void)state;
    sph_config c = quiet(1e-4);
    c.sponge_low[0] = 2;
    c.sponge_high[1] = 3; /* at 0.5: half its width */
    c.sponge_rate = 30;
    sph_sim *sim = lone(&c, 0, v);
    must(sim, sph_step(sim));
    const sph_particle p = by_id(sim, 0);
    const double s[2] = {(1 - p.x[0]) / 2, (p.x[1] + 1) / 3};
    for (int k = 0; k < 2; k++)
        close_to(p.v[k], v[k] * sph_exp(-30 * (s[0] * s[0] + s[1] * s[1]) * 1e-4), EPS);
}
#endif

#if SPH_DOUBLE
/* into the layer: dv/ds = -r w s^2, so v = v0 - r w s^3/3; from outside the place is of second order, the velocity
   stands half a step of damping ahead */
static void into_the_layer_the_order_is_as_told(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        double x[3], ahead[3], centred[3];
        for (int k = 0; k < 3; k++) {
            const double dt = 0.01 / (1 << k), v[SPH_DIM] = {-1};
            sph_config c = quiet(dt);
            c.integrator = i;
            c.sponge_low[0] = 1.2;
            c.sponge_rate = 3;
            sph_sim *sim = lone(&c, 0.3, v);
            for (int n = 0; n < 90 << k; n++)
                must(sim, sph_step(sim));
            const sph_particle p = by_id(sim, 0);
            const double s = depth(&c, &p), want = -1 + 3 * 1.2 * s * s * s / 3;
            x[k] = p.x[0];
            ahead[k] = p.v[0] - want;
            centred[k] = p.v[0] * sph_exp(0.5 * 3 * s * s * dt) - want;
            assert_true(s > 0.5 && s < 0.8);
            assert_int_equal(free_sims(NULL), 0);
        }
        const double order = log2((x[0] - x[1]) / (x[1] - x[2]));
        const double first = log2(ahead[0] / ahead[1]), second = log2(centred[0] / centred[1]);
        print_message("sponge, integrator %u: order of places %.2f, of velocities inside %.2f, less half a step %.2f\n",
                      i, order, first, second);
        assert_true(order > 1.9 && order < 2.2);
        assert_true(first > 0.9 && first < 1.1);
        assert_true(second > 1.9 && second < 2.2);
    }
}
#endif

/* any rate is stable: what it is asked to take in a step may be all */
static void the_strongest_layer_stops_what_it_holds(void **state)
{
    const double v[SPH_DIM] = {-1};
    (void)state;
    sph_config c = quiet(0.01);
    c.sponge_low[0] = 1.5;
    c.sponge_rate = 9e14;
    sph_sim *sim = lone(&c, -0.5, v);
    must(sim, sph_step(sim));
    must(sim, sph_step(sim));
    assert_true(by_id(sim, 0).v[0] == 0);
}

/* ---- what must not be touched ---- */

static void cloud(sph_sim *sim)
{
    uint32_t set;
    must(sim, sph_add_fluid(sim, NULL, &set));
    random_cloud(sim, set, SPH_DIM == 1 ? 300 : SPH_DIM == 2 ? 20 : 8, SPH_DIM == 1 ? 0.003 : 0.05, 0.1, 1, 5);
}
static sph_config cloud_config(double width)
{
    sph_config c = open_config(EDGE, SPH_DIM == 1 ? 0.003 : 0.05);
    for (int k = 0; k < SPH_DIM; k++)
        c.sponge_low[k] = c.sponge_high[k] = width;
    c.sponge_rate = 200;
    return c;
}

static void same_particles(const sph_sim *a, const sph_sim *b)
{
    assert_int_equal(sph_count(a), sph_count(b));
    for (uint32_t i = 0; i < sph_count(a); i++) {
        sph_particle p, q;
        assert_int_equal(sph_get(a, i, &p), SPH_OK);
        assert_int_equal(sph_get(b, i, &q), SPH_OK);
        assert_int_equal(p.id, q.id);
        assert_memory_equal(p.x, q.x, sizeof p.x);
        assert_memory_equal(p.v, q.v, sizeof p.v);
    }
}

static void outside_not_a_bit_changes(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = cloud_config(0.5), none = cloud_config(0);
        c.integrator = none.integrator = i;
        none.sponge_rate = 0;
        sph_sim *with = new_sim(&c), *without = new_sim(&none);
        cloud(with);
        cloud(without);
        for (int k = 0; k < 10; k++) {
            must(with, sph_step(with));
            must(without, sph_step(without));
        }
        same_particles(with, without);
        sph_totals t;
        sph_get_totals(with, &t);
        assert_true(t.absorbed == 0);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void drift(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)x;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = 0.5 - k;
    *rho = 1000;
}

/* a stream with the layers' own velocity goes through */
static void the_stream_it_is_told_of_passes(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = cloud_config(3), none = cloud_config(0);
        c.integrator = none.integrator = i;
        for (int k = 0; k < SPH_DIM; k++)
            c.sponge_velocity[k] = 0.5 - k;
        sph_sim *with = new_sim(&c), *without = new_sim(&none);
        cloud(with);
        cloud(without);
        must(with, sph_apply_field(with, 0, drift, NULL));
        must(without, sph_apply_field(without, 0, drift, NULL));
        for (int k = 0; k < 10; k++) {
            must(with, sph_step(with));
            must(without, sph_step(without));
        }
        same_particles(with, without);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void moving(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.25 * t;
    v[0] = 0.25;
}

/* a held axis moves as it is told, a free one is damped */
static void held_sets_are_not_damped(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = quiet(1e-3);
        sph_solid rock = {.shear = 1e5, .held = 1, .motion = moving};
        const double x[SPH_DIM] = {0}, v[SPH_DIM] = {[Y] = 2};
        uint32_t set;
        c.integrator = i;
        c.solid = SPH_UPDATED;
        c.sponge_low[0] = 2;
        c.sponge_rate = 100;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &rock, &set, NULL));
        must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
        for (int k = 0; k < 10; k++)
            must(sim, sph_step(sim));
        const sph_particle p = by_id(sim, 0);
        assert_true(p.v[0] == 0.25);
        assert_true(SPH_DIM == 1 || (p.v[Y] > 0 && p.v[Y] < 1.6));
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a layer that holds nothing but a wall changes nothing: walls keep the velocity that viscosity sees */
static void walls_are_not_damped(void **state)
{
    double seen = 0;
    (void)state;
    for (int turn = 0; turn < 2; turn++) {
        sph_config c = quiet(1e-4);
        sph_wall w = sph_wall_default();
        double lo[SPH_DIM], hi[SPH_DIM], x[SPH_DIM], sum = 0;
        const double v[SPH_DIM] = {0.3};
        uint32_t set, group, walls = 0;
        for (int k = 0; k < SPH_DIM; k++) {
            lo[k] = 0;
            hi[k] = EDGE;
            x[k] = k ? 0.5 * EDGE : 0.08;
        }
        c.sponge_low[0] = turn ? 1 : 0;
        c.sponge_rate = 1000;
        c.viscosity = SPH_ARTIFICIAL;
        w.kind = SPH_WALL_ADAMI;
        w.no_slip = true;
        w.motion = moving;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
        must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0) | SPH_HIGH(0), true, &group));
        for (int k = 0; k < 5; k++)
            must(sim, sph_step(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle p;
            assert_int_equal(sph_get(sim, i, &p), SPH_OK);
            if (p.role == SPH_ROLE_FLUID)
                continue;
            walls++;
            sum += fabs(p.v[0]) * (1 + walls);
        }
        sph_totals t;
        sph_get_totals(sim, &t);
        assert_true(t.absorbed == 0 && sum > 0);
        assert_true(turn == 0 || sum == seen);
        seen = sum;
        assert_true(walls > 2);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- the book ---- */

static double energy(const sph_sim *sim)
{
    sph_totals t;
    sph_get_totals(sim, &t);
    return t.kinetic + t.absorbed;
}

/* particles that see no other: what they lose is in the book, to the rounding of sums in double */
static void what_it_takes_is_in_the_book(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++)
        for (uint32_t books = 0; books < 2; books++) {
            sph_config c = open_config(EDGE, 0.001);
            uint32_t set;
            c.integrator = i;
            c.books = books;
            c.dt = 1e-3;
            c.sponge_low[0] = 3;
            c.sponge_rate = 50;
            c.max_particles = 600;
            for (int k = 1; k < SPH_DIM; k++) /* no more cells than they need */
                c.lo[k] = -0.05, c.hi[k] = 0.05;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set));
            for (uint32_t n = 0; n < 600; n++) {
                const double x[SPH_DIM] = {0.004 * n - 0.8}, v[SPH_DIM] = {[Y] = 0.001 * (n + 1)};
                must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
            }
            must(sim, sph_ready(sim));
            const double before = energy(sim);
            for (int k = 0; k < 20; k++)
                must(sim, sph_step(sim));
            sph_totals t;
            sph_get_totals(sim, &t);
            assert_true(t.absorbed > 0.1 * before);
            close_to(energy(sim) / before, 1, 1e-14);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* ---- refusals ---- */

static void refused(sph_config c, const char *what, double value)
{
    sph_report r;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, what);
    assert_true(isnan(value) ? isnan(r.value) : r.value == value);
    assert_true(r.allowed[0] != 0);
}

static void what_makes_no_layer_is_refused(void **state)
{
    sph_report r;
    (void)state;
    const sph_config good = cloud_config(0.5);
    assert_int_equal(sph_config_check(&good, &r), SPH_OK);
    for (int k = 0; k < SPH_DIM; k++) {
        sph_config c = good;
        c.sponge_low[k] = -0.1;
        refused(c, "sponge_low", -0.1);
        c.sponge_low[k] = 3.01;
        refused(c, "sponge_low", 3.01);
        c = good;
        c.sponge_high[k] = NAN;
        refused(c, "sponge_high", NAN);
        c.sponge_high[k] = 3.01;
        refused(c, "sponge_high", 3.01);
        c.sponge_high[k] = 3;
        assert_int_equal(sph_config_check(&c, &r), SPH_OK);
        c.sponge_low[k] = 0;
        c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
        refused(c, "sponge_high", 3);
        c = good;
        c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
        refused(c, "sponge_low", 0.5);
        c = good;
        c.sponge_velocity[k] = INFINITY;
        refused(c, "sponge_velocity", INFINITY);
    }
    sph_config c = good;
    c.sponge_rate = 0;
    refused(c, "sponge_rate", 0);
    c.sponge_rate = -1;
    refused(c, "sponge_rate", -1);
}

/* ---- the machine that runs steps ---- */

static sph_sim *begin(const sph_config *c)
{
    sph_sim *sim = new_sim(c);
    cloud(sim);
    return sim;
}

static void slices_threads_and_restarts_change_no_bit(void **state)
{
    sph_totals t;
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = cloud_config(2.5);
        c.integrator = i;
        sph_get_totals(same_bits_any_way(c, begin, 8), &t);
        assert_true(t.absorbed > 0);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* what a scene with layers has taken is part of its digest */
static void the_book_is_hashed(void **state)
{
    const double v[SPH_DIM] = {1e-6}, w[SPH_DIM] = {2e-6};
    (void)state;
    sph_config c = quiet(1e-10); /* moves by less than half a quantum */
    c.sponge_low[0] = 2;
    c.sponge_rate = 9e14; /* all is taken: the same state but for the book */
    sph_sim *a = lone(&c, -0.5, v), *b = lone(&c, -0.5, w);
    must(a, sph_step(a));
    must(b, sph_step(b));
    assert_true(by_id(a, 0).v[0] == 0 && by_id(b, 0).v[0] == 0 && by_id(a, 0).x[0] == by_id(b, 0).x[0]);
    assert_true(energy(b) > 3 * energy(a));
    assert_true(sph_hash(a) != sph_hash(b));
}

static void a_failed_step_takes_nothing(void **state)
{
    const double v[SPH_DIM] = {-1};
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = quiet(0.05);
        c.integrator = i;
        c.sponge_low[0] = 1;
        c.sponge_rate = 0.5;
        sph_sim *sim = lone(&c, -0.7, v);
        sph_status st = SPH_OK;
        uint64_t hash = 0;
        double took = 0;
        while (!st) {
            hash = sph_hash(sim);
            took = energy(sim);
            st = sph_step(sim);
        }
        assert_int_equal(st, SPH_OUT_OF_DOMAIN);
        assert_true(sph_hash(sim) == hash && energy(sim) == took);
        assert_int_equal(free_sims(NULL), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#if SPH_DIM > 1
        subject(along_the_face_velocity_dies_as_the_exponential),
        subject(in_a_corner_rates_add_up),
#endif
#if SPH_DOUBLE
        subject(into_the_layer_the_order_is_as_told),
#endif
        subject(the_strongest_layer_stops_what_it_holds),
        subject(outside_not_a_bit_changes),
        subject(the_stream_it_is_told_of_passes),
        subject(held_sets_are_not_damped),
        subject(walls_are_not_damped),
        subject(what_it_takes_is_in_the_book),
        subject(what_makes_no_layer_is_refused),
        subject(slices_threads_and_restarts_change_no_bit),
        subject(the_book_is_hashed),
        subject(a_failed_step_takes_nothing),
    };
    return run_subjects("sponge", tests);
}
