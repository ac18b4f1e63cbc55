/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_usage.c: what a simulation says of its own work: high-water marks, what a step did, which limit set it; and what
   refusals between steps name. */
#include "testing.h"

#define DX 0.25

static sph_config config(void)
{
    sph_config c = open_config(1, DX);
    c.max_particles = 400;
    c.gravity[SPH_DIM - 1] = -9.81;
    return c;
}
static sph_sim *block(const sph_config *c)
{
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], v[SPH_DIM] = {0.5};
    uint32_t set;
    sph_sim *sim = new_sim(c);
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 1;
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, v));
    return sim;
}
static uint64_t work_of(const sph_sim *sim)
{
    sph_step_info i;
    sph_get_step(sim, &i);
    return i.work;
}
static sph_usage usage_of(const sph_sim *sim)
{
    sph_usage u;
    sph_get_usage(sim, &u);
    return u;
}

/* a whole step in one slice: its work is the slice's; smaller slices later leave the mark, a heavier step raises it */
static void the_heaviest_slice_and_step_are_kept(void **state)
{
    const sph_config c = config();
    sph_sim *sim = block(&c);
    (void)state;
    assert_true(usage_of(sim).slice_work == 0 && usage_of(sim).step_work == 0);
    must(sim, sph_step(sim));
    assert_true(usage_of(sim).slice_work == 0); /* not in slices */
    assert_true(usage_of(sim).step_work == work_of(sim) && work_of(sim) > 0);
    assert_int_equal(sph_step_slice(sim, UINT64_MAX), SPH_OK);
    const uint64_t whole = work_of(sim);
    assert_true(usage_of(sim).slice_work == whole);
    uint32_t slices = 1;
    for (sph_status st = SPH_NOT_DONE; st == SPH_NOT_DONE; slices++)
        assert_true((st = sph_step_slice(sim, 1)) == SPH_NOT_DONE || st == SPH_OK);
    assert_true(slices > 5);
    assert_true(usage_of(sim).slice_work == whole);
    uint64_t most = 0;
    sim = block(&c);
    for (int k = 0; k < 6; k++) {
        must(sim, sph_step(sim));
        most = work_of(sim) > most ? work_of(sim) : most;
        assert_true(usage_of(sim).step_work == most);
    }
    sim = block(&c); /* slices are small, and there is one */
    for (sph_status st = SPH_NOT_DONE; st == SPH_NOT_DONE;)
        assert_true((st = sph_step_slice(sim, 1)) == SPH_NOT_DONE || st == SPH_OK);
    assert_true(usage_of(sim).slice_work > 0 && usage_of(sim).slice_work < work_of(sim));
}

static void particles_and_cells_are_counted(void **state)
{
    sph_config c = config();
    double x[SPH_DIM];
    uint32_t set;
    (void)state;
    c.gravity[SPH_DIM - 1] = 0;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (int i = 0; i < 7; i++) { /* five side by side, two far away; nobody moves within a step */
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = i < 5 ? 0.51 + 1e-3 * i : 1.8;
        x[0] += i == 6 ? -0.05 : 0;
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
    }
    sph_usage u = usage_of(sim);
    assert_int_equal(u.particles, 7);
    assert_int_equal(u.max_particles, 400);
    assert_true(u.sets == 1 && u.groups == 0);
    assert_true(u.arena_used <= u.arena_bytes && u.arena_bytes == sph_arena_bytes(&c));
    must(sim, sph_ready(sim));
    assert_int_equal(usage_of(sim).cell_particles, 5);
    /* 3 long, cells as wide as a support (0.6) or more, but no wider than need be: 4 or 5 */
    const uint32_t most = SPH_DIM == 1 ? 5 : SPH_DIM == 2 ? 25 : 125, least = SPH_DIM == 1 ? 4 : SPH_DIM == 2 ? 16 : 64;
    assert_true(u.cells >= least && u.cells <= most);
}

/* the step is the smallest of what the limits allowed before it; limit_dt says what the next one may be */
static void the_smallest_limit_sets_the_step(void **state)
{
    static const struct {
        double gravity, nu, dt, dt_max;
        uint32_t viscosity;
    } of[] = {{9.81, 0, 0, 0, SPH_INVISCID}, {9.81, 0.5, 0, 0, SPH_MORRIS}, {1e7, 0, 0, 0, SPH_INVISCID},
              {9.81, 0, 1e-4, 0, SPH_INVISCID}, {9.81, 0, 0, 1e-4, SPH_INVISCID}};
    (void)state;
    for (uint32_t n = 0; n < sizeof of / sizeof *of; n++) {
        sph_config c = config();
        c.integrator = SPH_KICK_DRIFT_KICK;
        c.gravity[SPH_DIM - 1] = -of[n].gravity;
        c.viscosity = of[n].viscosity;
        c.nu = of[n].nu;
        c.dt = of[n].dt;
        c.dt_max = of[n].dt_max;
        sph_sim *sim = block(&c);
        sph_step_info before, after;
        must(sim, sph_ready(sim));
        for (int k = 0; k < 3 && n != 2; k++) {
            uint32_t least = SPH_LIMITS;
            sph_get_step(sim, &before);
            for (uint32_t l = 0; l < SPH_LIMITS; l++)
                if (before.limit_dt[l] > 0 && (least == SPH_LIMITS || before.limit_dt[l] < before.limit_dt[least]))
                    least = l;
            must(sim, sph_step(sim));
            sph_get_step(sim, &after);
            assert_int_equal(after.limit, least);
            close_to(after.dt, before.limit_dt[least], 0);
            close_to(after.time, before.time + after.dt, 0);
            close_to(after.time, sph_time(sim), 0);
            assert_true(after.step == before.step + 1 && after.passes > 3 && after.pairs > 0);
        }
        sph_get_step(sim, &before);
        const double h = c.smoothing_length;
        close_to(before.limit_dt[SPH_LIMIT_FIXED], c.dt, 0);
        if (c.dt > 0)
            continue;
        close_to(before.limit_dt[SPH_LIMIT_CEILING], c.dt_max, 0);
        close_to(before.limit_dt[SPH_LIMIT_GRAVITY], c.gravity_factor * h / (20 + sqrt(of[n].gravity * h)), 1e-12);
        const double viscous = c.nu > 0 ? c.viscous_factor * h * h / c.nu : 0;
        close_to(before.limit_dt[SPH_LIMIT_VISCOUS], viscous, 1e-12);
    }
}

static bool no_source(void *ctx, void *bytes, size_t n)
{
    (void)ctx, (void)bytes, (void)n;
    return false;
}
static void what_is_refused_between_steps_is_named(void **state)
{
    const sph_config c = config();
    sph_sim *sim = block(&c);
    sph_report r;
    (void)state;
#define named(st_want, call, name, number)                                                                  \
    do {                                                                                                    \
        assert_int_equal(call, st_want);                                                                    \
        assert_string_equal(sph_last(sim)->what, name);                                                     \
        close_to(sph_last(sim)->value, number, 0);                                                          \
    } while (0)
    named(SPH_BAD_ARGUMENT, sph_step_slice(sim, 0), "budget", 0);
    named(SPH_BAD_ARGUMENT, sph_step_to(sim, 0), "t_end", 0);
    named(SPH_BAD_ARGUMENT, sph_step_to(sim, -3), "t_end", -3);
    assert_int_equal(sph_step_slice(sim, 1), SPH_NOT_DONE);
    named(SPH_BAD_STATE, sph_step(sim), "sph_step", 0);
    named(SPH_BAD_STATE, sph_ready(sim), "sph_ready", 0);
    named(SPH_BAD_STATE, sph_inspect(sim, NULL, NULL), "sph_inspect", 0);
    named(SPH_BAD_STATE, sph_restore(sim, no_source, NULL), "sph_restore", 0);
    sph_step_cancel(sim);
    named(SPH_BAD_ARGUMENT, sph_restore(sim, NULL, NULL), "source", 0);
    named(SPH_DUMP_TRUNCATED, sph_restore(sim, no_source, NULL), sph_last(sim)->what, sph_last(sim)->value);
    must(sim, sph_step(sim));
    assert_int_equal(sph_config_check(NULL, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "configuration");
    close_to(r.value, 0, 0);
    sph_config other = c;
    other.cookie++;
    assert_int_equal(sph_config_check(&other, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "cookie");
    close_to(r.value, other.cookie, 0);
}

/* The mean motion of a table and a steady motion, at and between rows and beyond them. */
static void motions_are_where_the_manual_says(void **state)
{
    const double t[] = {0.5, 1, 3}, x[] = {2, 3, -1};
    double d[SPH_DIM], v[SPH_DIM];
    (void)state;
    for (uint32_t axis = 0; axis < SPH_DIM; axis++) {
        sph_table m = {3, axis, t, x};
        const double at[] = {-1, 0.4, 0.75, 1, 2, 3, 9}, want_d[] = {0, 0, 0.5, 1, -1, -3, -3};
        const double want_v[] = {0, 0, 2, -2, -2, 0, 0};
        for (int i = 0; i < 7; i++) {
            sph_motion_table(&m, at[i], d, v);
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                close_to(d[k], k == axis ? want_d[i] : 0, 1e-15);
                close_to(v[k], k == axis ? want_v[i] : 0, 1e-15);
            }
        }
        sph_steady s;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            s.v[k] = 1 + k;
            s.a[k] = 0.5 - k;
        }
        sph_motion_steady(&s, 2, d, v);
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            close_to(d[k], 2 * s.v[k] + 2 * s.a[k], 1e-15);
            close_to(v[k], s.v[k] + 2 * s.a[k], 1e-15);
        }
    }
    const sph_table bad[] = {{0, 0, t, x}, {3, SPH_DIM, t, x}, {3, 0, NULL, x}, {3, 0, t, NULL}};
    for (int i = 0; i < 4; i++) {
        sph_table m = bad[i];
        sph_motion_table(&m, 2, d, v);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            assert_true(d[k] == 0 && v[k] == 0);
    }
}

/* what a wall's host says of its motion: place (m) and velocity (m/s) from time 0 on, and from `later` on */
static struct {
    double x, v, later_x, later_v;
    uint32_t axis;
} told;
static void tell(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[told.axis] = t > 0 ? told.later_x : told.x;
    v[told.axis] = t > 0 ? told.later_v : told.v;
}
/* the domain is 3 long: a place within 6, less than 3 from one step to the next, a velocity below 1e15 */
static void a_motion_must_be_finite_near_and_no_leap(void **state)
{
    static const struct {
        double x, v;
        sph_status st;
        double value;
    } of[] = {{0, NAN, SPH_NOT_FINITE, 0},  {0, 1e15, SPH_NOT_FINITE, 0}, {0, 9e14, SPH_OK, 0},
              {NAN, 0, SPH_NOT_FINITE, NAN}, {6, 0, SPH_NOT_FINITE, 6},    {-6, 0, SPH_NOT_FINITE, -6},
              {3, 0, SPH_MOVED_TOO_FAR, 3},  {-3, 0, SPH_MOVED_TOO_FAR, 3}, {2.99, 0, SPH_OUT_OF_DOMAIN, 0},
              {-2.99, 0, SPH_OUT_OF_DOMAIN, 0}, {0.5, 3, SPH_OK, 0}};
    (void)state;
    for (uint32_t axis = 0; axis < SPH_DIM; axis++)
        for (uint32_t n = 0; n < sizeof of / sizeof *of; n++) {
            sph_config c = config();
            sph_wall w = sph_wall_default();
            double lo[SPH_DIM] = {0}, hi[SPH_DIM], at[SPH_DIM];
            uint32_t set;
            c.max_particles = 2000;
            c.on_cross = SPH_IGNORE;
            c.on_leave = SPH_REMOVE;
            sph_sim *sim = new_sim(&c);
            for (int k = 0; k < SPH_DIM; k++) {
                hi[k] = 1;
                at[k] = 1.7;
            }
            w.kind = SPH_WALL_LENNARD_JONES;
            w.motion = tell;
            memset(&told, 0, sizeof told);
            told.axis = axis;
            told.later_x = of[n].x;
            told.later_v = of[n].v;
            must(sim, sph_add_fluid(sim, NULL, &set));
            must(sim, sph_add_particle(sim, set, at, NULL, 0, NULL));
            must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
            const sph_status st = sph_step(sim);
            if (st != of[n].st)
                fail_msg("place %g, velocity %g: %s", of[n].x, of[n].v, sph_status_text(st));
            if (st && st != SPH_OUT_OF_DOMAIN) { /* the wall may go so far, but not out of the domain */
                assert_string_equal(sph_last(sim)->what, "motion of a wall");
                const double is = sph_last(sim)->value, value = of[n].value;
                assert_true(value - value != 0 ? is - is != 0 : fabs(is - value) < 1e-6);
            }
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* Particles far from each other, of fluids of other masses, and no forces: all that they lose damping takes. Exact: v
   becomes g v so often in a step as the integrator damps. */
static void damping_takes_what_is_lost(void **state)
{
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++) {
        sph_config c = open_config(1, DX);
        double x[SPH_DIM], v[SPH_DIM], kinetic = 0;
        uint32_t set;
        sph_totals t;
        c.integrator = integrator;
        c.viscosity = SPH_INVISCID;
        c.books = true;
        c.damping = 0.75;
        c.dt = 0x1p-10;
        c.max_particles = 10;
        sph_sim *sim = new_sim(&c);
        for (int i = 0; i < 3; i++) {
            must(sim, sph_add_fluid(sim, &(sph_fluid){.mass = 1 + 4 * i}, &set));
            for (int k = 0; k < SPH_DIM; k++) {
                x[k] = -0.5 + i;
                v[k] = 1 + 2 * i + k;
                kinetic += 0.5 * (1 + 4 * i) * v[k] * v[k];
            }
            must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        }
        for (int step = 1; step <= 4; step++) {
            must(sim, sph_step(sim));
            sph_get_totals(sim, &t);
            close_to(t.damped + t.kinetic, kinetic, 100 * EPS * kinetic);
            assert_true(t.kinetic < 0.6 * kinetic);
            close_to(t.balance, kinetic, 100 * EPS * kinetic);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a few particles of a solid, held along any axes and told to move: there where they are told, elsewhere at rest */
static void a_held_axis_goes_where_it_is_told(void **state)
{
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++)
        for (uint32_t held = 1; held < 1u << SPH_DIM; held++) {
            sph_config c = config();
            sph_steady m;
            double lo[SPH_DIM] = {0}, hi[SPH_DIM], x[SPH_DIM];
            uint32_t set;
            c.gravity[SPH_DIM - 1] = 0;
            c.integrator = integrator;
            c.solid = SPH_UPDATED;
            c.dt = 0x1p-10;
            sph_sim *sim = new_sim(&c);
            for (int k = 0; k < SPH_DIM; k++) {
                hi[k] = 0.5;
                m.v[k] = 1 + k;
                m.a[k] = 100;
            }
            const sph_solid rock = {.shear = 1e4, .held = held, .motion = sph_motion_steady, .motion_ctx = &m};
            must(sim, sph_add_solid(sim, &rock, &set, NULL));
            must(sim, sph_add_box(sim, set, lo, hi, NULL));
            for (int step = 0; step < 3; step++)
                must(sim, sph_step(sim));
            const double t = sph_time(sim);
            for (uint32_t i = 0; i < 1u << SPH_DIM; i++) {
                const sph_particle p = by_id(sim, i);
                for (uint32_t k = 0; k < SPH_DIM; k++) {
                    const double way = held >> k & 1 ? t * (m.v[k] + 50 * t) : 0;
                    x[k] = (0.5 + (i >> k & 1)) * DX + way;
                    close_to(p.x[k], x[k], 1e-7);
                    close_to(p.v[k], held >> k & 1 ? m.v[k] + 100 * t : 0, 1e-6);
                }
            }
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* particles of two fluids far from each other: every total by hand */
static void totals_are_sums_over_the_particles(void **state)
{
    const double mass[4] = {2, 3, 3, 2}, rho[4] = {1004, 990, 1012, 998};
    sph_config c = open_config(1, DX);
    double momentum[SPH_DIM] = {0}, kinetic = 0, potential = 0, internal = 0, fastest = 0, spin = 0;
    uint32_t set[2];
    sph_totals t;
    (void)state;
    c.eos = SPH_LINEAR;
    c.max_particles = 10;
    c.gravity[SPH_DIM - 1] = -9;
    sph_sim *sim = new_sim(&c);
    for (int s = 0; s < 2; s++)
        must(sim, sph_add_fluid(sim, &(sph_fluid){.mass = 2 + s}, &set[s]));
    for (int i = 0; i < 4; i++) {
        double x[SPH_DIM], v[SPH_DIM], v2 = 0;
        for (int k = 0; k < SPH_DIM; k++) {
            x[k] = -0.5 + 0.75 * i;
            v[k] = (k ? 0.5 : -1) * (i + 1) * (i % 2 ? 1 : -2);
            v2 += v[k] * v[k];
            momentum[k] += mass[i] * v[k];
        }
        spin += SPH_DIM > 1 ? mass[i] * (x[0] * v[SPH_DIM > 1] - x[SPH_DIM > 1] * v[0]) : 0;
        kinetic += 0.5 * mass[i] * v2;
        potential += mass[i] * 9 * x[SPH_DIM - 1];
        /* integral of p/rho^2 from rho0, p = c^2 (rho - rho0) */
        internal += mass[i] * 400 * (log(rho[i] / 1000) + 1000 / rho[i] - 1);
        fastest = v2 > fastest ? v2 : fastest;
        must(sim, sph_add_particle(sim, set[mass[i] > 2.5], x, v, rho[i], NULL));
    }
    sph_get_totals(sim, &t);
    assert_true(t.fluid == 4 && t.wall == 0 && t.solid == 0);
    close_to(t.mass, 10, 0);
    for (int k = 0; k < SPH_DIM; k++)
        close_to(t.momentum[k], momentum[k], 1e-12);
    close_to(t.angular[2], spin, 1e-6);
    close_to(t.kinetic, kinetic, 1e-12 * kinetic);
    close_to(t.potential, potential, 1e-6);
    close_to(t.internal, internal, 1e-4 * internal);
    close_to(t.max_speed, sqrt(fastest), 1e-12);
    close_to(t.min_density, 990, 1e-3);
    close_to(t.max_density, 1012, 1e-3);
    close_to(t.balance, kinetic + potential + internal, 1e-5 * kinetic);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(the_heaviest_slice_and_step_are_kept),
        subject(particles_and_cells_are_counted),
        subject(the_smallest_limit_sets_the_step),
        subject(what_is_refused_between_steps_is_named),
        subject(motions_are_where_the_manual_says),
        subject(damping_takes_what_is_lost),
        subject(totals_are_sums_over_the_particles),
        subject(a_held_axis_goes_where_it_is_told),
        subject(a_motion_must_be_finite_near_and_no_leap),
    };
    return run_subjects("usage", list);
}
