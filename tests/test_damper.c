/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_damper.c: the acoustic damper against what a bulk viscosity does to a standing sound wave, and to a flow without
   divergence; damping by a rate against its exponential; XSPH in the velocity against the same step without it. Orders
   in time, books, refusals, and that slices and restarts change no bit. */
#include "testing.h"

#include "sph/internal.h"

#define DX 0.1
enum { N = SPH_DIM == 3 ? 16 : 32, Y = SPH_DIM > 1 };
#define EDGE (N * DX)
#define SOUND 20.0

static double wave_number(void) { return 2 * 3.14159265358979323846 / EDGE; }

/* a box that is periodic on every axis, thin but for the first; nothing that takes energy but what a test asks for */
static sph_config box(double theta, double dt)
{
    sph_config c = periodic_config(EDGE, DX);
    for (int k = 1; k < SPH_DIM; k++)
        c.hi[k] = SPH_DIM == 3 ? 8 * DX : EDGE;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.eos = SPH_LINEAR;
    c.viscosity = SPH_INVISCID;
    c.smoothing_length = 1.2 * DX;
    c.sound_speed = SOUND;
    c.damper = theta;
    c.dt = dt;
    return c;
}
static sph_sim *filled(const sph_config *c, sph_field_fn field)
{
    const double lo[SPH_DIM] = {0};
    uint32_t set;
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, c->hi, NULL));
    must(sim, sph_apply_field(sim, set, field, NULL));
    return sim;
}
static void sound_wave(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = 0;
    *rho = 1000 * (1 + 1e-4 * sph_cos(wave_number() * x[0]));
}
static UNUSED void shear_wave(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx;
    v[0] = 0;
    v[Y] = 0.01 * sph_cos(wave_number() * x[0]);
    *rho = 1000;
}
static double energy(const sph_sim *sim, double *taken)
{
    sph_totals t;
    sph_get_totals(sim, &t);
    *taken = t.quieted;
    return t.kinetic + t.internal;
}
static void run_to(sph_sim *sim, double t)
{
    while (sph_time(sim) < t)
        must(sim, sph_step_to(sim, t));
}

/* what the lattice's sums make of the wave number: a plane wave is their eigenvector, -sum V g x sin(k x) its value */
static double lattice_number(const sph_config *c)
{
    const int reach = 4, over = SPH_DIM > 1 ? reach : 0, third = SPH_DIM > 2 ? reach : 0;
    double sum = 0, volume = 1;
    for (int k = 0; k < SPH_DIM; k++)
        volume *= DX;
    for (int a = -reach; a <= reach; a++)
        for (int b = -over; b <= over; b++)
            for (int d = -third; d <= third; d++) {
                const double r = DX * sqrt(a * a + b * b + d * d);
                double w, dw;
                if (!(r > 0))
                    continue;
                assert_int_equal(sph_kernel_value(c->kernel, r, c->smoothing_length, &w, &dw), SPH_OK);
                sum -= volume * dw / r * a * DX * sph_sin(wave_number() * a * DX);
            }
    return sum;
}

/* ---- the damper ---- */

/* Amplitudes die as exp(-theta h c k^2 t/2): after six periods the energy is that squared. It swings by the damping
   over the frequency besides, 0.4 theta h k of what is left. */
static void sound_dies_as_a_bulk_viscosity_says(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 3; i++)
        for (int theta = 0; theta < 3; theta++) {
            sph_config c = box(0.2 * theta, 0.1 * DX / SOUND);
            const double k = lattice_number(&c), end = 12 * 3.14159265358979323846 / (k * SOUND);
            double taken;
            c.integrator = i;
            sph_sim *sim = filled(&c, sound_wave);
            const double begun = energy(sim, &taken);
            run_to(sim, end);
            const double left = energy(sim, &taken) / begun;
            const double want = sph_exp(-0.2 * theta * c.smoothing_length * SOUND * k * k * end);
            close_to(left, want, 0.1 * theta * c.smoothing_length * k * want + (SPH_DOUBLE ? 2e-3 : 2e-2));
            close_to(taken / begun, 1 - left, SPH_DOUBLE ? 2e-3 : 2e-2);
            assert_true(theta || !(taken > 0 || taken < 0));
            assert_int_equal(free_sims(NULL), 0);
        }
}

#if SPH_DIM > 1
static void flow_without_divergence_feels_nothing(void **state)
{
    (void)state;
    sph_config c = box(0.3, 0.1 * DX / SOUND);
    double taken;
    sph_sim *sim = filled(&c, shear_wave);
    const double begun = energy(sim, &taken);
    run_to(sim, EDGE / SOUND);
    const double left = energy(sim, &taken);
    assert_true(fabs(left / begun - 1) < 1e-4);
    assert_true(taken >= 0 && taken < 1e-4 * begun);
}
#endif

#if SPH_DOUBLE
/* places, and what the books are off by, against half the step */
static void it_is_of_second_order_in_time(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 3; i++) {
        double x[4], off[4], taken;
        for (int k = 0; k < 4; k++) {
            sph_config c = box(0.5, 0.2 * DX / SOUND / (1 << k));
            c.integrator = i;
            sph_sim *sim = filled(&c, sound_wave);
            const double begun = energy(sim, &taken);
            run_to(sim, 0.33 * EDGE / SOUND);
            x[k] = by_id(sim, N / 4).x[0];
            off[k] = (energy(sim, &taken) + taken) / begun - 1;
            assert_int_equal(free_sims(NULL), 0);
        }
        const double order = log2((x[1] - x[2]) / (x[2] - x[3])), books = log2((off[1] - off[2]) / (off[2] - off[3]));
        print_message("damper, integrator %u: order of places %.2f, of the books %.2f\n", i, order, books);
        assert_true(order > 1.8);
        assert_true(i == SPH_LEAP_FROG || books > 1.7); /* its velocities are of other times than its places */
    }
}
#endif

/* ---- damping by a rate ---- */

static sph_sim *lone(const sph_config *c, double speed)
{
    uint32_t set;
    const double x[SPH_DIM] = {0}, v[SPH_DIM] = {speed};
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
    return sim;
}

static void velocity_dies_as_the_exponential(void **state)
{
    static const double cut[] = {0.013, 0.0131, 0.05, 0.11, 0.1234, 0.2};
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++)
        for (double dt = 0.4e-3; dt < 0.06; dt *= 10) {
            sph_config c = open_config(1, DX);
            uint32_t steps = 1;
            sph_totals t;
            c.integrator = i;
            c.dt = dt;
            c.damping_rate = 20;
            sph_sim *sim = lone(&c, 2);
            sph_get_totals(sim, &t);
            const double begun = t.kinetic;
            for (size_t k = 0; k < sizeof cut / sizeof *cut; k++)
                for (; sph_time(sim) < cut[k]; steps++)
                    must(sim, sph_step_to(sim, cut[k]));
            const double ahead = i == SPH_LEAP_FROG ? 0.5 * sim->now.dt_last : 0;
            const double want = 2 * sph_exp(-20 * (sph_time(sim) + ahead));
            close_to(by_id(sim, 0).v[0], want, 3 * steps * EPS * want);
            sph_get_totals(sim, &t);
            close_to(t.slowed, begun - t.kinetic, 4 * steps * EPS * begun);
            assert_int_equal(free_sims(NULL), 0);
        }
}

#if SPH_DOUBLE
/* falling: v = g/r (1 - exp(-r t)), x = g/r t - v/r */
static void falling_against_it_is_of_second_order(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        double off[2], lag[2];
        for (int k = 0; k < 2; k++) {
            sph_config c = open_config(1, DX);
            const double r = 5, end = 0.4, v = 3 / r * (1 - sph_exp(-r * end));
            c.integrator = i;
            c.gravity[0] = 3;
            c.damping_rate = r;
            c.dt = 0.02 / (1 << k);
            sph_sim *sim = lone(&c, 0);
            run_to(sim, end);
            off[k] = by_id(sim, 0).x[0] - (3 / r * end - v / r);
            lag[k] = by_id(sim, 0).v[0] - v;
            assert_int_equal(free_sims(NULL), 0);
        }
        assert_true(log2(fabs(off[0] / off[1])) > 1.8);
        assert_true(i == SPH_LEAP_FROG || log2(fabs(lag[0] / lag[1])) > 1.8);
    }
}
#endif

/* ---- XSPH in the velocity ---- */

static sph_sim *cloud(const sph_config *c)
{
    uint32_t set;
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    random_cloud(sim, set, SPH_DIM == 1 ? 20 : SPH_DIM == 2 ? 12 : 6, DX, 0.2, 1, 7);
    return sim;
}

/* a step with it is the step without it, and then v + u */
static void a_step_ends_with_u_added(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = open_config(1, DX), none = c;
        sph_totals t, o;
        c.integrator = none.integrator = i;
        c.dt = none.dt = 1e-3;
        c.xsph = 0.4;
        c.xsph_velocity = true;
        sph_sim *with = cloud(&c), *without = cloud(&none);
        must(with, sph_step(with));
        must(without, sph_step(without));
        double u2 = 0;
        for (uint32_t n = 0; n < sph_count(with); n++) {
            sph_particle p, q;
            assert_int_equal(sph_get(with, n, &p), SPH_OK);
            assert_int_equal(sph_get(without, n, &q), SPH_OK);
            assert_memory_equal(p.x, q.x, sizeof p.x);
            for (int k = 0; k < SPH_DIM; k++) {
                const double u = (double)with->buf[with->cur].xsph[k][n];
                close_to(p.v[k], q.v[k] + u, 2 * EPS);
                u2 += u * u;
            }
        }
        assert_true(u2 > 0.1);
        sph_get_totals(with, &t);
        sph_get_totals(without, &o);
        for (int k = 0; k < SPH_DIM; k++)
            close_to(t.momentum[k], o.momentum[k], 4 * EPS * t.mass);
        close_to(t.evened, o.kinetic - t.kinetic, 16 * EPS * o.kinetic);
        assert_true(t.evened > 0.01 * o.kinetic);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- refusals, the machine that runs steps ---- */

static void refused(const sph_config *c, const char *what, double value)
{
    sph_report r;
    assert_int_equal(sph_config_check(c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, what);
    assert_true(r.value == value);
}
static void what_makes_no_sense_is_refused(void **state)
{
    (void)state;
    sph_config c = box(0.2, 0);
    c.integrator = SPH_RUNGE_KUTTA;
    refused(&c, "damper", 0.2);
    c = box(0.2, 0);
    c.density = SPH_SUMMATION;
    refused(&c, "damper", 0.2);
    c = box(0.2, 0);
    c.solid = SPH_UPDATED;
    refused(&c, "damper", 0.2);
    c = box(-1, 0);
    refused(&c, "damper", -1);
    c = box(0, 0);
    c.damping_rate = -1;
    refused(&c, "damping_rate", -1);
    c = box(0, 0);
    c.xsph_velocity = true;
    refused(&c, "xsph_velocity", 1);
    c.xsph = 0.3;
    c.xsph_strain = true;
    c.solid = SPH_UPDATED;
    refused(&c, "xsph_velocity", 1);
}

static void slices_and_reruns_change_no_bit(void **state)
{
    shuffle s;
    (void)state;
    for (uint32_t i = 0; i < 3; i++) {
        sph_config c = open_config(1, DX);
        c.integrator = i;
        c.damper = 0.3;
        c.damping_rate = 3;
        c.xsph = 0.3;
        c.xsph_velocity = true;
        c.max_threads = 3;
        sph_sim *whole = cloud(&c), *sliced = cloud(&c), *other = cloud(&c);
        for (int k = 0; k < 8; k++)
            must(whole, sph_step(whole));
        for (int k = 0; k < 8;) {
            const sph_status st = sph_step_slice(sliced, 10);
            assert_true(st == SPH_OK || st == SPH_NOT_DONE);
            k += st == SPH_OK;
        }
        assert_true(sph_hash(sliced) == sph_hash(whole));
        c.port = shuffle_port(&s, 3);
        must(other, sph_reconfigure(other, &c));
        for (int k = 0; k < 8; k++)
            must(other, sph_step(other));
        assert_true(s.calls > 8 && sph_hash(other) == sph_hash(whole));
        assert_int_equal(free_sims(NULL), 0);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(sound_dies_as_a_bulk_viscosity_says),
#if SPH_DIM > 1
        subject(flow_without_divergence_feels_nothing),
#endif
#if SPH_DOUBLE
        subject(it_is_of_second_order_in_time),
        subject(falling_against_it_is_of_second_order),
#endif
        subject(velocity_dies_as_the_exponential),
        subject(a_step_ends_with_u_added),
        subject(what_makes_no_sense_is_refused),
        subject(slices_and_reruns_change_no_bit),
    };
    return run_subjects("damper", list);
}
