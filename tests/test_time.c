/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_time.c: the speed of sound, the limits of the step, falling and bouncing bodies, steps that change, fields that
   are given in mid-run. The order of the integrators: test_order.c. */
#include "testing.h"

#define N 40u
#define DX 0.05
#define LENGTH (N * DX)
#define PI 3.14159265358979323846

static void wave(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)rho;
    v[0] = 0.02 * sin(2 * PI * x[0] / LENGTH);
}

static sph_sim *sound(uint32_t integrator, uint32_t eos, double dt)
{
    sph_config c = periodic_config(LENGTH, DX);
    uint32_t set;
    c.integrator = integrator;
    c.eos = eos;
    c.viscosity = SPH_INVISCID;
    c.sound_speed = 10;
    c.dt = dt;
    if (SPH_DIM > 1)
        c.hi[1] = 8 * DX;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, c.lo, c.hi, NULL));
    must(sim, sph_apply_field(sim, set, wave, NULL));
    return sim;
}

static double amplitude(const sph_sim *sim)
{
    double sum = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        sum += p.v[0] * sin(2 * PI * p.x[0] / LENGTH);
    }
    return sum;
}

/* On the lattice both equations multiply a first derivative by A(k) = sum V (-g) x sin(k x)/k, so a standing wave turns
   with the speed A c0: what is left of the test is the amplitude, U/c0 = 2e-3, and the step, (w dt)^2/24 = 4e-5. */
static double lattice_factor(void)
{
    const double k = 2 * PI / LENGTH, h = 1.2 * DX;
    double sum = 0;
    for (int a = -4; a <= 4; a++)
        for (int b = SPH_DIM > 1 ? -4 : 0; b <= (SPH_DIM > 1 ? 4 : 0); b++) {
            double r = DX * sqrt(a * a + b * b), w, dw;
            assert_int_equal(sph_kernel_value(SPH_WENDLAND_C2, r, h, &w, &dw), SPH_OK);
            if (r > 0)
                sum -= pow(DX, SPH_DIM) * dw / r * (a * DX) * sin(k * a * DX) / k;
        }
    return sum;
}

/* v = U sin(k x) cos(w t) turns at w t = pi/2, 3 pi/2: half a period lies between two turns */
static double measured_speed(uint32_t eos, double c_true)
{
    const double dt = 0.02 * LENGTH / c_true / 4;
    sph_sim *sim = sound(SPH_KICK_DRIFT_KICK, eos, dt);
    double before = amplitude(sim), turn[2] = {0, 0};
    int found = 0;
    for (int k = 0; k < 400 && found < 2; k++) {
        must(sim, sph_step(sim));
        double a = amplitude(sim);
        if (a * before < 0)
            turn[found++] = sph_time(sim) - dt * fabs(a) / (fabs(a) + fabs(before));
        before = a;
    }
    assert_int_equal(found, 2);
    return LENGTH / (2 * (turn[1] - turn[0]));
}

static void sound_travels_at_the_speed_of_the_equation_of_state(void **state)
{
    static const double factor[SPH_ISOTHERMAL] = {1, 2.6457513110645907, 1};
    (void)state;
    for (uint32_t eos = 0; eos < SPH_ISOTHERMAL; eos++) {
        double c = measured_speed(eos, 10 * factor[eos]);
        print_message("equation of state %u: sound at %.4f c0, lattice %.4f\n", eos, c / 10,
                      lattice_factor() * factor[eos]);
        close_to(c / (10 * factor[eos]), lattice_factor(), 0.004);
        close_to(lattice_factor(), 1, 0.05);
    }
}

static void the_limits_of_the_step_are_the_printed_ones(void **state)
{
    sph_config c = open_config(1, DX);
    uint32_t set;
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    sph_step_info info;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 0.5;
    c.gravity[0] = -9.81;
    c.alpha = 0.1;
    c.dt_max = 0.5;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, sph_ready(sim));
    sph_get_step(sim, &info);
    const double h = c.smoothing_length, nu = 0.1 * 20 * h / (2 * (SPH_DIM + 2));
    close_to(info.limit_dt[SPH_LIMIT_COURANT], 0.25 * h / 20, 1e-12);
    close_to(info.limit_dt[SPH_LIMIT_VISCOUS], 0.125 * h * h / nu, 1e-12);
    close_to(info.limit_dt[SPH_LIMIT_FORCE], 0.25 * sqrt(h / 9.81), 1e-6);
    close_to(info.limit_dt[SPH_LIMIT_GRAVITY], 0.5 * h / (20 + sqrt(9.81 * h)), 1e-12);
    assert_true(info.limit_dt[SPH_LIMIT_CEILING] == 0.5);
    must(sim, sph_step(sim));
    sph_get_step(sim, &info);
    assert_int_equal(info.limit, SPH_LIMIT_COURANT);
    close_to(info.dt, 0.25 * h / 20, 1e-12);
    close_to(sph_time(sim), info.dt, 1e-15);
}

#if SPH_DOUBLE
/* m/rho of a neighbour that has lost nearly all density is taken for that of 0.95 of the density at rest: else the
   bound of the step would be out by its thinness, and spray would take what it touches below 0 */
static void a_thin_neighbour_diffuses_no_faster(void **state)
{
    (void)state;
    for (uint32_t scheme = 0; scheme < 2; scheme++) {
        sph_config c = open_config(1, DX);
        uint32_t set;
        double x[SPH_DIM] = {0}, w, dw;
        c.viscosity = SPH_INVISCID;
        c.diffusion = SPH_MOLTENI;
        c.integrator = SPH_KICK_DRIFT_KICK;
        c.scheme = scheme ? SPH_WEAK : SPH_STANDARD;
        c.dt = 1e-8;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_particle(sim, set, x, NULL, 1000, NULL));
        x[0] = DX;
        must(sim, sph_add_particle(sim, set, x, NULL, 150, NULL));
        must(sim, sph_step(sim));
        assert_int_equal(sph_kernel_value(c.kernel, DX, c.smoothing_length, &w, &dw), SPH_OK);
        const double volume = pow(DX, SPH_DIM) / 0.95, h = c.smoothing_length;
        const double rate = 2 * c.delta * h * 20 * volume * 850 * DX * dw / (DX * DX + 0.01 * h * h);
        close_to((by_id(sim, 0).rho - 1000) / c.dt, rate, 1e-4 * fabs(rate));
        assert_int_equal(free_sims(NULL), 0);
    }
}
#endif

/* of fluid only, whatever walls have; before the first step too */
static void the_step_says_how_thin_and_how_dense_the_fluid_is(void **state)
{
    (void)state;
    sph_config c = open_config(1, DX);
    const sph_wall wall = sph_wall_default();
    const double low[SPH_DIM] = {0};
    double high[SPH_DIM], x[SPH_DIM];
    uint32_t set;
    sph_step_info info;
    sph_sim *sim = new_sim(&c);
    sph_get_step(sim, &info);
    assert_true(info.thinnest >= 0 && info.thinnest <= 0 && info.densest >= 0 && info.densest <= 0);
    must(sim, sph_add_fluid(sim, &(sph_fluid){.rho0 = 800}, &set));
    for (int i = 0; i < 3; i++) {
        static const double rho[] = {790, 340, 860};
        for (int k = 0; k < SPH_DIM; k++) {
            high[k] = 1;
            x[k] = 0.5 + (k == 0 ? 0.02 * i : 0);
        }
        must(sim, sph_add_particle(sim, set, x, NULL, rho[i], NULL));
    }
    must(sim, sph_add_wall_box(sim, &wall, low, high, SPH_LOW(0), true, NULL));
    sph_get_step(sim, &info);
    close_to(info.thinnest, 340.0 / 800, 4 * EPS);
    close_to(info.densest, 860.0 / 800, 4 * EPS);
}

static void a_falling_body_falls_exactly(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = open_config(1, DX);
        uint32_t set;
        double x[SPH_DIM] = {0}, v[SPH_DIM] = {0};
        c.gravity[0] = -9.81;
        c.integrator = i;
        c.dt = 1e-3;
        v[0] = 1;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        for (int k = 0; k < 50; k++)
            must(sim, sph_step(sim));
        const double t = sph_time(sim);
        close_to(t, 0.05, 1e-15);
        /* a constant acceleration is exact at second order; each step rounds position (to a quantum) and velocity.
           Leap-frog's velocity is half a step ahead of its position. */
        close_to(by_id(sim, 0).x[0], t - 0.5 * 9.81 * t * t, 50 * (8 * EPS * 0.05 + 4e-9 * (SPH_DOUBLE ? 1e-6 : 1)));
        close_to(by_id(sim, 0).v[0], 1 - 9.81 * (i == SPH_LEAP_FROG ? t + 0.5e-3 : t), 50 * 2 * EPS);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a single particle in gravity g; its image behind a mirror face pushes next to nothing */
static sph_config falling_config(uint32_t integrator, double dt, double g, uint32_t face)
{
    sph_config c = open_config(1, DX);
    c.lo[0] = 0;
    c.hi[0] = 8;
    c.face[0][0] = face;
    c.sound_speed = 1e-3;
    c.gravity[0] = -g;
    c.integrator = integrator;
    c.dt = dt;
    return c;
}

static sph_sim *falling(const sph_config *c, double x0, double v0)
{
    uint32_t set;
    double x[SPH_DIM] = {x0}, v[SPH_DIM] = {v0};
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
    return sim;
}

/* What is below a mirror face is the mirror image of what is above, gravity too: a bounce turns a velocity and changes
   it by no more than the pull of a step, up or down, and on the average not at all */
static void a_bounce_keeps_the_speed(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        const double dt = 1.37e-3, g = 9.81, top = 0.5;
        const sph_config c = falling_config(i, dt, g, SPH_SYMMETRY);
        sph_sim *sim = falling(&c, top, 0);
        sph_step_info info;
        double highest = 0;
        do {
            must(sim, sph_step(sim));
            sph_get_step(sim, &info);
            if (info.reflected == 20)
                highest = fmax(highest, by_id(sim, 0).x[0]);
        } while (info.reflected < 21);
        print_message("integrator %u: after 20 bounces %.4f of the height\n", i, highest / top);
        close_to(highest / top, 1, 0.02);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* mu of the Courant limit is v.x/(r^2 + 0.01 h^2), whatever the densities of the two are */
static void the_courant_limit_sees_mu_between_fluids_of_any_density(void **state)
{
    (void)state;
    for (int light = 0; light < 2; light++) {
        sph_config c = open_config(1, 0.1);
        const sph_fluid other = {.rho0 = light ? 1 : 900};
        const double h = c.smoothing_length, r = 0.1, v = 3;
        double x[SPH_DIM] = {0}, v0[SPH_DIM] = {0};
        uint32_t set, second;
        c.integrator = SPH_RUNGE_KUTTA;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_fluid(sim, &other, &second));
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
        x[0] = r;
        v0[0] = v;
        must(sim, sph_add_particle(sim, second, x, v0, 0, NULL));
        must(sim, sph_ready(sim));
        sph_step_info info;
        sph_get_step(sim, &info);
        const double want = c.cfl * h / (c.sound_speed + h * v * r / (r * r + 0.01 * h * h));
        close_to(info.limit_dt[SPH_LIMIT_COURANT] / want, 1, 1e-5);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* free fall, 0.5 s with steps of 0.01 s, then 0.5 s with steps of 1e-4 s: exact but for rounding */
static void steps_that_change_fall_exactly(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        const double g = 9.81, v0 = 5;
        sph_config c = falling_config(i, 0.01, g, SPH_OPEN);
        sph_sim *sim = falling(&c, 1, v0);
        for (int k = 0; k < 50; k++)
            must(sim, sph_step(sim));
        c.dt = 1e-4;
        must(sim, sph_reconfigure(sim, &c));
        for (int k = 0; k < 5000; k++)
            must(sim, sph_step(sim));
        const double t = sph_time(sim), rounding = SPH_DOUBLE ? 1e-10 : 5e-5;
        close_to(by_id(sim, 0).x[0], 1 + v0 * t - 0.5 * g * t * t, rounding);
        close_to(by_id(sim, 0).v[0], v0 - g * (t + (i == SPH_LEAP_FROG ? 0.5e-4 : 0)), 20 * rounding);
        assert_int_equal(free_sims(NULL), 0);
    }
}

#if SPH_DIM == 1
/* Ways much shorter than a quantum (here a hundredth) add up: v/c 1e-6 in a domain of 1000 goes as far as it should, to
   1 %, in every integrator, to both sides. */
static void slow_motion_in_a_large_domain_goes_as_far_as_it_should(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_RUNGE_KUTTA_MOMENTUM; i++) {
        const double dx = 0.1, speed = 1e-6, dt = 0.01, from[2] = {-400, 400};
        const uint32_t steps = 60000;
        sph_config c = open_config(1, dx);
        uint32_t set;
        c.lo[0] = -500, c.hi[0] = 500;
        c.smoothing_length = 10 * dx; /* few cells: they cost time, and forces are 0 */
        c.sound_speed = 1;
        c.integrator = i;
        c.dt = dt;
        c.max_particles = 8;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        for (int k = 0; k < 2; k++) {
            const double v = k ? speed : -speed;
            must(sim, sph_add_particle(sim, set, &from[k], &v, 0, NULL));
        }
        double x0[2];
        for (uint32_t k = 0; k < 2; k++)
            x0[k] = by_id(sim, k).x[0];
        for (uint32_t k = 0; k < steps; k++)
            must(sim, sph_step(sim));
        for (uint32_t k = 0; k < 2; k++)
            close_to((by_id(sim, k).x[0] - x0[k]) / ((k ? speed : -speed) * dt * steps), 1, 0.01);
        assert_int_equal(free_sims(NULL), 0);
    }
}
#endif

static void five(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)x, (void)rho;
    v[0] = 5;
}
static void same(void *ctx, const double *x, double *v, double *rho)
{
    (void)x, (void)rho;
    *(double *)ctx = v[0];
}

/* in mid-run, a field of velocities holds at that time, and a new gravity from then on; a field sees the velocities of
   that time */
static void what_is_given_in_mid_run_holds_from_then_on(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++)
        for (int how = 0; how < 2; how++) {
            const double dt = 0.01, g = 10, rounding = SPH_DOUBLE ? 1e-10 : 1e-5;
            sph_config c = falling_config(i, dt, g, SPH_OPEN);
            sph_sim *sim = falling(&c, 4, 0);
            double seen = 0;
            for (int k = 0; k < 10; k++)
                must(sim, sph_step(sim));
            const double x = by_id(sim, 0).x[0];
            close_to(x, 4 - 0.05, rounding);
            must(sim, sph_apply_field(sim, 0, same, &seen));
            close_to(seen, -1, rounding);
            if (how == 0)
                must(sim, sph_apply_field(sim, 0, five, NULL));
            c.gravity[0] = how == 0 ? -g : g;
            must(sim, sph_reconfigure(sim, &c));
            for (int k = 0; k < 10; k++)
                must(sim, sph_step(sim));
            close_to(by_id(sim, 0).x[0], how == 0 ? x + 0.5 - 0.05 : x - 0.1 + 0.05, rounding);
            assert_int_equal(free_sims(NULL), 0);
        }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(sound_travels_at_the_speed_of_the_equation_of_state),
        subject(the_limits_of_the_step_are_the_printed_ones),
        subject(the_courant_limit_sees_mu_between_fluids_of_any_density),
#if SPH_DOUBLE
        subject(a_thin_neighbour_diffuses_no_faster),
#endif
        subject(the_step_says_how_thin_and_how_dense_the_fluid_is),
        subject(a_falling_body_falls_exactly),
        subject(a_bounce_keeps_the_speed),
#if SPH_DIM == 1
        subject(slow_motion_in_a_large_domain_goes_as_far_as_it_should),
#endif
        subject(steps_that_change_fall_exactly),
        subject(what_is_given_in_mid_run_holds_from_then_on),
    };
    return run_subjects("time", list);
}
