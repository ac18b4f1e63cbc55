/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_fail.c: a step that fails says why and whose fault it was, leaves the state bit for bit as it was, and the run
   goes on once the cause is gone. */
#include "testing.h"

#define N (SPH_DIM == 1 ? 40u : SPH_DIM == 2 ? 12u : 6u)
#define DX 0.1

static double poison_at; /* particles with |v| below this and x[0] beyond `poison_x` get a NaN from time poison_t on */
static double poison_x, poison_t;

static void poison(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)v;
    if (poison_at > 0 && t >= poison_t && x[0] > poison_x)
        a[0] = NAN;
}

static sph_sim *block(sph_config c)
{
    sph_sim *sim = new_sim(&c);
    uint32_t set;
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = N * DX;
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    return sim;
}

static void nan_velocity(void *ctx, const double *x, double *v, double *rho)
{
    (void)rho;
    if (x[0] > *(double *)ctx)
        v[0] = NAN;
}
static void nan_density(void *ctx, const double *x, double *v, double *rho)
{
    (void)v;
    if (x[0] > *(double *)ctx)
        *rho = NAN;
}

static void a_field_with_nan_is_refused_and_changes_nothing(void **state)
{
    double from = 0.5 * N * DX;
    (void)state;
    sph_sim *sim = block(open_config(N * DX, DX));
    uint64_t before = sph_hash(sim);
    assert_int_equal(sph_apply_field(sim, 0, nan_velocity, &from), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "field velocity");
    assert_int_equal(sph_apply_field(sim, 0, nan_density, &from), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "field density");
    assert_true(sph_hash(sim) == before);
    must(sim, sph_step(sim));
}

static void a_nan_in_the_middle_of_a_run_is_caught_and_the_run_goes_on(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = open_config(N * DX, DX);
        uint64_t clean = 0;
        c.body_force = poison;
        c.integrator = i;
        for (int turn = 0; turn < 2; turn++) { /* once without poison: the run afterwards must have the same bits */
            poison_at = 0;
            poison_x = (N - 1) * DX;
            sph_sim *sim = block(c);
            for (int k = 0; k < 5; k++)
                must(sim, sph_step(sim));
            if (turn) {
                uint64_t before = sph_hash(sim);
                poison_at = 1;
                poison_t = 0;
                for (int k = 0; k < 2; k++) {
                    assert_int_equal(sph_step(sim), SPH_NOT_FINITE);
                    assert_true(sph_hash(sim) == before);
                }
                const sph_report *r = sph_last(sim);
                assert_int_equal(r->status, SPH_NOT_FINITE);
                assert_string_equal(r->pass, "force");
                /* the particle with the smallest id of those beyond: the last of the first row along x */
                assert_int_equal(r->particle, N - 1);
                poison_at = 0;
            }
            for (int k = 0; k < 5; k++)
                must(sim, sph_step(sim));
            if (turn)
                assert_true(sph_hash(sim) == clean);
            clean = sph_hash(sim);
            assert_int_equal(free_sims(NULL), 0);
        }
    }
}

static void the_named_particle_does_not_depend_on_threads(void **state)
{
    (void)state;
    for (uint32_t threads = 1; threads < 9; threads += 3) {
        shuffle s;
        sph_config c = open_config(N * DX, DX);
        c.max_threads = 8;
        c.port = shuffle_port(&s, threads);
        c.body_force = poison;
        poison_at = 1;
        poison_x = 0.5 * N * DX;
        poison_t = 1e-12;
        sph_sim *sim = block(c);
        must(sim, sph_ready(sim));
        assert_int_equal(sph_step(sim), SPH_NOT_FINITE);
        assert_int_equal(sph_last(sim)->particle, N / 2);
        poison_at = 0;
    }
}

/* what is left of a rate of density that grows beyond bounds while nothing else does */
static void a_rate_of_density_beyond_bounds_is_refused(void **state)
{
    (void)state;
    sph_config c = open_config(N * DX, DX);
    c.viscosity = SPH_INVISCID;
    for (uint32_t fast = 0; fast < 2; fast++) {
        sph_sim *sim = new_sim(&c);
        uint32_t set;
        must(sim, sph_add_fluid(sim, NULL, &set));
        for (uint32_t k = 0; k < 2; k++) {
            double x[SPH_DIM] = {k * DX}, v[SPH_DIM] = {0};
            v[0] = (fast ? 4e14 : 1e12) * (k ? -1 : 1);
            must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
        }
        assert_int_equal(sph_ready(sim), fast ? SPH_NOT_FINITE : SPH_OK);
    }
}

static sph_sim *leaver(uint32_t policy, double v0)
{
    sph_config c = open_config(N * DX, DX);
    c.on_leave = policy;
    c.hi[0] = N * DX;
    c.dt = 1e-3;
    sph_sim *sim = new_sim(&c);
    uint32_t set;
    double x[SPH_DIM], v[SPH_DIM] = {0};
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (int p = 0; p < 3; p++) { /* far apart: no forces */
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = DX;
        x[0] = N * DX - (p == 1 ? 0.005 : p == 0 ? 0.3 : 0.59);
        v[0] = p == 1 ? v0 : 0;
        must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
    }
    return sim;
}

/* the report names axis, face, set and role of who leaves: fluid, or a wall that is driven out */
static void drive_out(void *ctx, double t, double *x, double *v)
{
    const double *way = ctx;
    for (int k = 0; k < SPH_DIM; k++) {
        x[k] = way[k] * t;
        v[k] = way[k];
    }
}
static void who_leaves_is_named_with_its_face(void **state)
{
    static const char *const axes[] = {"x beyond the low", "x beyond the high", "y beyond the low", "y beyond the high",
                                       "z beyond the low", "z beyond the high"};
    (void)state;
    for (uint32_t which = 0; which < 4 * SPH_DIM; which++) {
        const uint32_t face = which / 2 % (2 * SPH_DIM), axis = face / 2, wall = which % 2;
        sph_config c = open_config(1, 0.1);
        double x[SPH_DIM], v[SPH_DIM] = {0}, lo[SPH_DIM], hi[SPH_DIM];
        uint32_t set, other, group;
        c.integrator = which / (4 * SPH_DIM) ? SPH_RUNGE_KUTTA : SPH_PREDICTOR_CORRECTOR;
        c.dt = 1e-3;
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = 0.5, lo[k] = 0.3, hi[k] = 0.7;
        sph_sim *sim = new_sim(&c);
        sph_wall w = sph_wall_default();
        must(sim, sph_add_fluid(sim, NULL, &other));
        must(sim, sph_add_particle(sim, other, x, NULL, 0, NULL));
        must(sim, sph_add_fluid(sim, NULL, &set));
        v[axis] = face % 2 ? 30 : -30;
        x[axis] = face % 2 ? c.hi[axis] - 0.05 : c.lo[axis] + 0.05;
        w.motion = drive_out;
        w.motion_ctx = v;
        if (wall)
            must(sim, sph_add_wall_box(sim, &w, lo, hi, 1u << face, true, &group));
        else
            must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        sph_status st = SPH_OK;
        for (int k = 0; k < 200 && st == SPH_OK; k++)
            st = sph_step(sim);
        const sph_report *r = sph_last(sim);
        assert_int_equal(st, SPH_OUT_OF_DOMAIN);
        if (strncmp(r->what, axes[face], strlen(axes[face])) != 0)
            fail_msg("face %u: %s", face, r->what);
        assert_int_equal(r->role, wall ? SPH_ROLE_GHOST : SPH_ROLE_FLUID);
        assert_int_equal(r->set, wall ? 2 : 1);
        assert_true(r->value >= 0 && r->value <= 0.03);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void leaving_the_domain_fails_or_removes(void **state)
{
    (void)state;
    sph_sim *sim = leaver(SPH_FAIL, 2);
    int k;
    uint64_t before = 0;
    sph_status st = SPH_OK;
    must(sim, sph_ready(sim));
    for (k = 0; k < 10 && st == SPH_OK; k++) {
        before = sph_hash(sim);
        st = sph_step(sim);
    }
    assert_int_equal(st, SPH_OUT_OF_DOMAIN);
    assert_int_equal(k, 3); /* 0.005 m at 2 m/s and 1 ms a step: gone in the third */
    assert_int_equal(sph_last(sim)->particle, 1);
    assert_true(sph_hash(sim) == before);
    assert_int_equal(sph_count(sim), 3);

    sim = leaver(SPH_REMOVE, 2);
    for (k = 0; k < 10; k++)
        must(sim, sph_step(sim));
    sph_step_info info;
    sph_totals t;
    sph_get_step(sim, &info);
    sph_get_totals(sim, &t);
    assert_int_equal(sph_count(sim), 2);
    assert_int_equal(t.fluid, 2);
    assert_int_equal(info.left, 1);
    close_to(t.removed_mass, 1000 * pow(DX, SPH_DIM), 1e-9);
    by_id(sim, 0);
    by_id(sim, 2);
}

static void the_mass_that_left_is_that_of_the_particles(void **state)
{
    sph_config c = open_config(N * DX, DX);
    (void)state;
    c.on_leave = SPH_REMOVE;
    c.hi[0] = N * DX;
    c.dt = 1e-3;
    sph_sim *sim = new_sim(&c);
    sph_fluid heavy = {.mass = 7};
    uint32_t first, second;
    double x[SPH_DIM], v[SPH_DIM] = {3};
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = DX;
    must(sim, sph_add_fluid(sim, NULL, &first));
    must(sim, sph_add_fluid(sim, &heavy, &second));
    must(sim, sph_add_particle(sim, first, x, NULL, 0, NULL));
    x[0] = N * DX - 0.001;
    must(sim, sph_add_particle(sim, second, x, v, 0, NULL));
    for (int k = 0; k < 3; k++)
        must(sim, sph_step(sim));
    sph_totals t;
    sph_get_totals(sim, &t);
    assert_int_equal(t.fluid, 1);
    close_to(t.removed_mass, 7, 1e-10);
}

static void too_large_a_step_is_refused(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = open_config(N * DX, DX);
        c.integrator = i;
        c.dt = 1;
        for (int k = 0; k < SPH_DIM; k++)
            c.lo[k] = -50, c.hi[k] = 50;
        sph_sim *sim = new_sim(&c);
        uint32_t set;
        must(sim, sph_add_fluid(sim, NULL, &set));
        random_cloud(sim, set, N, DX, 0.1, 5, 5);
        must(sim, sph_ready(sim));
        uint64_t before = sph_hash(sim);
        sph_status st = sph_step(sim);
        assert_true(st == SPH_MOVED_TOO_FAR || st == SPH_NOT_FINITE);
        assert_true(sph_last(sim)->particle < sph_count(sim));
        assert_true(sph_hash(sim) == before);
        c.dt = 1e-4; /* a smaller one goes on */
        must(sim, sph_reconfigure(sim, &c));
        must(sim, sph_step(sim));
    }
}

static void a_collapsed_step_is_refused(void **state)
{
    sph_config c = open_config(N * DX, DX);
    (void)state;
    c.dt_min = 1;
    sph_sim *sim = block(c);
    must(sim, sph_ready(sim));
    uint64_t before = sph_hash(sim);
    assert_int_equal(sph_step(sim), SPH_STEP_COLLAPSED);
    assert_string_equal(sph_last(sim)->what, "courant");
    assert_true(sph_last(sim)->value < 1 && sph_last(sim)->value > 0);
    assert_true(sph_hash(sim) == before);
    c.dt = 1.5e-3; /* a fixed step below the floor collapses as well */
    must(sim, sph_reconfigure(sim, &c));
    assert_int_equal(sph_step(sim), SPH_STEP_COLLAPSED);
    assert_string_equal(sph_last(sim)->what, "fixed");
}

static void lost_density_is_refused(void **state)
{
    sph_config c = open_config(N * DX, DX);
    (void)state;
    c.eos = SPH_LINEAR;
    c.viscosity = SPH_INVISCID;
    c.dt = 0.05;
    c.sound_speed = 1e-3;
    sph_sim *sim = new_sim(&c);
    uint32_t set;
    double x[SPH_DIM], v[SPH_DIM] = {0};
    must(sim, sph_add_fluid(sim, NULL, &set));
    /* two thin particles that fly apart at a low sound speed: drho = m v.grad W takes their density below 0.1 rho0 */
    for (int p = 0; p < 2; p++) {
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = DX;
        x[0] += p ? DX : 0;
        v[0] = p ? 2 : -2;
        must(sim, sph_add_particle(sim, set, x, v, 120, NULL));
    }
    must(sim, sph_ready(sim));
    uint64_t before = sph_hash(sim);
    assert_int_equal(sph_step(sim), SPH_DENSITY_LOST);
    assert_int_equal(sph_last(sim)->particle, 0);
    assert_true(sph_last(sim)->value <= -0.9);
    assert_true(sph_hash(sim) == before);
}

static void exhausted_capacities_are_refused_whole(void **state)
{
    sph_config c = open_config(N * DX, DX);
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], x[SPH_DIM] = {0};
    uint32_t set, group, total = 1;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++) {
        hi[k] = N * DX;
        total *= N;
    }
    c.max_particles = total - 1;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    uint64_t before = sph_hash(sim);
    assert_int_equal(sph_add_box(sim, set, lo, hi, NULL), SPH_TOO_MANY_PARTICLES);
    close_to(sph_last(sim)->value, total, 0); /* what is needed */
    assert_int_equal(sph_count(sim), 0);
    assert_true(sph_hash(sim) == before);
    hi[0] -= DX;
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    for (uint32_t k = sph_count(sim); k < total - 1; k++)
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
    assert_int_equal(sph_add_particle(sim, set, x, NULL, 0, NULL), SPH_TOO_MANY_PARTICLES);
    close_to(sph_last(sim)->value, total, 0);
    sph_wall w = sph_wall_default();
    hi[0] = N * DX;
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, &group), SPH_TOO_MANY_PARTICLES);
    close_to(sph_last(sim)->value, total - 1 + 3 * total / N, 0); /* three layers of one face */
    assert_int_equal(sph_count(sim), total - 1);
    while (set + 1 < SPH_MAX_SETS)
        must(sim, sph_add_fluid(sim, NULL, &set));
    assert_int_equal(sph_add_fluid(sim, NULL, &set), SPH_TOO_MANY_SETS);
}

/* a slice that ends with the first forces has begun the step: nothing may be changed until it is done or given up */
static void the_first_forces_in_slices_begin_the_step(void **state)
{
    (void)state;
    sph_sim *sim = leaver(SPH_REMOVE, 0.1), *whole = leaver(SPH_REMOVE, 0.1);
    sph_config c = sph_config_default();
    const uint64_t much = 1u << 30;
    assert_int_equal(sph_step_slice(sim, much), SPH_NOT_DONE);
    assert_int_equal(sph_reconfigure(sim, &c), SPH_BAD_STATE);
    assert_int_equal(sph_ready(sim), SPH_BAD_STATE);
    assert_int_equal(sph_step(sim), SPH_BAD_STATE);
    assert_int_equal(sph_step_slice(sim, much), SPH_OK);
    must(whole, sph_step(whole));
    assert_true(sph_hash(sim) == sph_hash(whole));
}

/* a particle thrown at a wall that does not hold it: boundary force of strength next to nothing */
static sph_sim *thrown(uint32_t policy)
{
    sph_config c = open_config(2, DX);
    c.on_cross = policy;
    c.dt = 1e-3;
    for (int k = 0; k < SPH_DIM; k++)
        c.lo[k] = -2, c.hi[k] = 4;
    sph_sim *sim = new_sim(&c);
    sph_wall w = sph_wall_default();
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM], x[SPH_DIM], v[SPH_DIM] = {0};
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = 0;
        hi[k] = 2;
        x[k] = 1.03;
    }
    w.kind = SPH_WALL_MONAGHAN_KOS;
    w.strength = 1e-12;
    x[0] = 0.0055;
    v[0] = -1;
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
    x[0] = 1;
    v[0] = 0;
    must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    must(sim, sph_ready(sim));
    return sim;
}

static void each_policy_for_crossing_a_wall_does_what_it_says(void **state)
{
    sph_step_info info;
    (void)state;
    for (uint32_t policy = 0; policy < SPH_POLICIES; policy++) {
        sph_sim *sim = thrown(policy);
        const uint32_t all = sph_count(sim);
        uint64_t before = 0;
        sph_status st = SPH_OK;
        int k = 0;
        for (; k < 8 && st == SPH_OK; k++) {
            before = sph_hash(sim);
            st = sph_step(sim);
        }
        sph_get_step(sim, &info);
        if (policy == SPH_FAIL) {
            assert_int_equal(st, SPH_WALL_CROSSED);
            assert_int_equal(k, 6);
            assert_int_equal(sph_last(sim)->particle, 0);
            close_to(sph_last(sim)->value, 0.0005, 1e-4);
            assert_true(sph_hash(sim) == before);
            assert_int_equal(info.crossed, 0);
            continue;
        }
        assert_int_equal(st, SPH_OK);
        if (policy == SPH_IGNORE) {
            assert_true(by_id(sim, 0).x[0] < -0.001);
            assert_int_equal(info.crossed, 0);
            continue;
        }
        assert_int_equal(info.crossed, 1);
        if (policy == SPH_REMOVE) {
            assert_int_equal(info.left, 1);
            must(sim, sph_step(sim));
            assert_int_equal(sph_count(sim), all - 1);
        } else {
            sph_particle p = by_id(sim, 0);
            assert_int_equal(info.put_back, 1);
            close_to(p.x[0], 0.1 * DX, 1e-5); /* and rests there: its speed into the wall was taken */
            close_to(p.v[0], 0, 1e-6);
        }
    }
}

static uint32_t faults;
static sph_report fault_seen;
static void on_fault(void *ctx, const sph_report *r)
{
    (void)ctx;
    faults++;
    fault_seen = *r;
}
static void the_fault_hook_is_told(void **state)
{
    sph_config c = open_config(N * DX, DX);
    (void)state;
    c.port.fault = on_fault;
    c.dt_min = 1;
    faults = 0;
    sph_sim *sim = block(c);
    assert_int_equal(faults, 0);
    assert_int_equal(sph_step(sim), SPH_STEP_COLLAPSED);
    assert_int_equal(faults, 1);
    assert_int_equal(fault_seen.status, SPH_STEP_COLLAPSED);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_field_with_nan_is_refused_and_changes_nothing),
        subject(a_nan_in_the_middle_of_a_run_is_caught_and_the_run_goes_on),
        subject(the_named_particle_does_not_depend_on_threads),
        subject(a_rate_of_density_beyond_bounds_is_refused),
        subject(leaving_the_domain_fails_or_removes),
        subject(who_leaves_is_named_with_its_face),
        subject(the_first_forces_in_slices_begin_the_step),
        subject(the_mass_that_left_is_that_of_the_particles),
        subject(too_large_a_step_is_refused),
        subject(a_collapsed_step_is_refused),
        subject(lost_density_is_refused),
        subject(exhausted_capacities_are_refused_whole),
        subject(each_policy_for_crossing_a_wall_does_what_it_says),
        subject(the_fault_hook_is_told),
    };
    return run_subjects("fail", list);
}
