/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_shear.c: the gradient of the velocity of fluids is exact where it is linear, with corrected gradients; the
   viscous stress keeps momentum, never gives energy, makes the force of a Newtonian fluid, and limits the step. */
#include "testing.h"

#include "sph/internal.h"

#define DX 0.1
#define CELLS (SPH_DIM == 1 ? 40u : SPH_DIM == 2 ? 12u : 9u)
#define ROUNDING (SPH_DOUBLE ? 1e-12 : 2e-4) /* of sums of terms of both signs over up to 900 particles */

static const uint32_t schemes[] = {SPH_STANDARD, SPH_WEAK};

/* fluid without pressure, weight and other viscosity: all that accelerates it is the stress */
static sph_config bare_config(uint32_t shear, uint32_t scheme, uint32_t gradient)
{
    sph_config c = open_config(CELLS * DX, DX);
    c.viscosity = SPH_INVISCID;
    c.shear = shear;
    c.scheme = scheme;
    c.gradient = gradient;
    c.smoothing_length = 1.4 * DX;
    c.nu = 0.3;
    c.books = true;
    return c;
}

/* a jittered block with velocities A x */
static sph_sim *block(const sph_config *c, double jitter, double a[3][3])
{
    uint32_t set;
    sph_sim *sim = new_sim(c);
    sph_rng rng;
    sph_rng_seed(&rng, 5, 5);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (uint32_t i = 0, at; i < CELLS * (SPH_DIM > 1 ? CELLS : 1) * (SPH_DIM > 2 ? CELLS : 1); i++) {
        double x[3] = {0}, v[3] = {0};
        at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= CELLS)
            x[k] = (at % CELLS + 0.5 + jitter * (2 * sph_rng_uniform(&rng) - 1)) * DX;
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++)
                v[k] += a[k][l] * x[l];
        must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
    }
    must(sim, sph_ready(sim));
    return sim;
}

/* sum m a . v (W), its scale, and the sum of m a */
static double power_of(const sph_sim *sim, double *scale, double *force)
{
    double power = 0;
    *scale = 0;
    for (int k = 0; k < SPH_DIM; k++)
        force[k] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        for (int k = 0; k < SPH_DIM; k++) {
            power += p.mass * p.a[k] * p.v[k];
            *scale += p.mass * fabs(p.a[k] * p.v[k]);
            force[k] += p.mass * p.a[k];
        }
    }
    return power;
}

/* tau : A of the equations, per volume (W/m^DIM) */
static double heat_of(const sph_config *c, double a[3][3])
{
    double square = 0, trace = 0, nu = c->nu, q = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        trace += a[k][k];
        for (int l = 0; l < SPH_DIM; l++)
            square += 0.25 * (a[k][l] + a[l][k]) * (a[k][l] + a[l][k]);
    }
    const double size = sqrt(2 * square);
    if (c->shear == SPH_SMAGORINSKY)
        nu += c->smagorinsky * c->smagorinsky * DX * DX * size;
    if (c->shear == SPH_SMAGORINSKY_WICK)
        nu += c->smagorinsky * DX * DX * size * size;
    if (c->shear != SPH_NESTED)
        q = 2.0 / 3 * c->subgrid * DX * DX * size * size;
    const double heat = 2 * nu * (square - trace * trace / 3);
    return c->rho0 * fmax(heat - q * trace, 0);
}

/* What the forces take is sum V tau : L, for every stress, so L is A for every particle, at the free surface too. */
static void corrected_gradients_of_linear_velocities_are_exact(void **state)
{
    sph_rng rng;
    (void)state;
    sph_rng_seed(&rng, 6, 6);
    for (int trial = 0; trial < 36; trial++) {
        const uint32_t shear = SPH_NESTED + (uint32_t)trial % 3;
        const uint32_t gradient = trial / 3 % 2 ? SPH_RENORMALISED : SPH_BONET_LOK;
        sph_config c = bare_config(shear, schemes[trial / 6 % 2], gradient);
        double a[3][3] = {{0}}, scale, force[3];
        c.smagorinsky = 1.5;
        c.subgrid = trial < 18 ? 0.3 : 0;
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++)
                a[k][l] = 2 * sph_rng_uniform(&rng) - 1;
        sph_sim *sim = block(&c, 0.2, a);
        const double power = power_of(sim, &scale, force), volume = sph_count(sim) * pow(DX, SPH_DIM);
        close_to(power, -volume * heat_of(&c, a), ROUNDING * scale);
        close_to(sim->now.power[POWER_DISSIPATED], -power, ROUNDING * scale);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void a_body_that_turns_feels_nothing(void **state)
{
    (void)state;
    for (uint32_t gradient = SPH_BONET_LOK; SPH_DIM > 1 && gradient <= SPH_RENORMALISED; gradient++) {
        sph_config c = bare_config(SPH_SMAGORINSKY, SPH_STANDARD, gradient);
        double turn[3][3] = {{0, -1, 0.5}, {1, 0, 0.3}, {-0.5, -0.3, 0}}, strain[3][3] = {{0, 1, 0}, {1, 0, 0}}, scale,
               force[3], whole;
        sph_sim *sim = block(&c, 0.2, strain);
        power_of(sim, &whole, force);
        sim = block(&c, 0.2, turn);
        power_of(sim, &scale, force);
        assert_true(whole > 0 && scale < ROUNDING * whole);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* whatever the velocities are, and behind faces too */
static void the_stress_takes_energy_and_keeps_momentum(void **state)
{
    (void)state;
    for (uint32_t trial = 0; trial < 3 * 3 * 2 * 3 * 2; trial++) {
        uint32_t q = trial, set;
        const uint32_t shear = SPH_NESTED + q % 3, gradient = (q /= 3) % 3, face = (q /= 3) % 3;
        sph_config c = bare_config(shear, schemes[trial % 2], gradient);
        double scale, force[3];
        c.subgrid = trial & 1 ? 5 : 0;
        if (shear != SPH_NESTED)
            c.nu = trial & 2 ? 0.01 : 0;
        for (int k = 0; k < SPH_DIM && face; k++) {
            c.lo[k] = 0;
            c.hi[k] = CELLS * DX;
            c.face[k][0] = c.face[k][1] = face == 1 ? SPH_PERIODIC : SPH_SYMMETRY;
        }
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        random_cloud(sim, set, CELLS, DX, 0.3, 1, 0);
        must(sim, sph_ready(sim));
        const double power = power_of(sim, &scale, force);
        assert_true(scale > 0 && power < 0);
        close_to(sim->now.power[POWER_DISSIPATED], -power, ROUNDING * scale);
        for (int k = 0; k < SPH_DIM && face < 2; k++)
            close_to(force[k], 0, ROUNDING * scale);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* everything flies apart: the eddies' pressure alone would give energy */
static void eddies_give_back_no_more_than_they_get(void **state)
{
    double a[3][3] = {{1, 0.1, 0}, {0, 1, 0}, {0, 0, 1}}, scale, force[3], taken[2];
    (void)state;
    for (int k = 0; k < 2; k++) {
        sph_config c = bare_config(SPH_SMAGORINSKY, SPH_STANDARD, SPH_BONET_LOK);
        c.nu = 0;
        c.subgrid = k ? 10 : 0;
        taken[k] = -power_of(block(&c, 0.2, a), &scale, force);
        assert_int_equal(free_sims(NULL), 0);
    }
    assert_true(taken[0] > 0);
    close_to(taken[1], 0, ROUNDING * taken[0]);
}

#if SPH_DIM > 1
/* u = y^2: nu u'' = 2 nu, away from the surface */
static void a_parabola_feels_the_force_of_a_newtonian_fluid(void **state)
{
    (void)state;
    for (int s = 0; s < 2; s++) {
        sph_config c = bare_config(SPH_NESTED, schemes[s], SPH_BONET_LOK);
        const double lo[3] = {0}, hi[3] = {14 * DX, 14 * DX, 14 * DX};
        uint32_t set, inside = 0;
        c.smoothing_length = 1.2 * DX;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_box(sim, set, lo, hi, NULL));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_buffer *b = &sim->buf[sim->cur];
            const double y = c.lo[1] + (double)b->pos[1][i] * sim->grid.quantum;
            b->vel[0][i] = (sph_real)(y * y);
        }
        must(sim, sph_ready(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle p;
            bool in = true;
            assert_int_equal(sph_get(sim, i, &p), SPH_OK);
            for (int k = 0; k < SPH_DIM; k++)
                in &= p.x[k] > 5.2 * DX && p.x[k] < hi[k] - 5.2 * DX;
            if (!in)
                continue;
            inside++;
            close_to(p.a[0], 2 * c.nu, SPH_DOUBLE ? 1e-9 : 2e-4);
            close_to(p.a[1], 0, SPH_DOUBLE ? 1e-9 : 2e-4);
        }
        assert_true(inside > 0);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void the_largest_eddy_viscosity_limits_the_step(void **state)
{
    double a[3][3] = {{0, 6, 0}};
    (void)state;
    for (uint32_t shear = SPH_SMAGORINSKY; shear <= SPH_SMAGORINSKY_WICK; shear++) {
        sph_config c = bare_config(shear, SPH_STANDARD, SPH_BONET_LOK);
        sph_step_info info;
        c.smagorinsky = 10;
        c.integrator = SPH_KICK_DRIFT_KICK;
        sph_sim *sim = block(&c, 0.2, a);
        const double eddy = shear == SPH_SMAGORINSKY ? 100 * DX * DX * 6 : 10 * DX * DX * 36, h = c.smoothing_length;
        sph_get_step(sim, &info);
        const double least = c.viscous_factor * h * h / (c.nu + eddy);
        close_to(info.limit_dt[SPH_LIMIT_COURANT] / least, 1, SPH_DOUBLE ? 1e-9 : 1e-4);
        close_to(info.limit_dt[SPH_LIMIT_VISCOUS], c.viscous_factor * h * h / c.nu, 1e-12);
        must(sim, sph_step(sim));
        sph_get_step(sim, &info);
        close_to(info.dt / least, 1, SPH_DOUBLE ? 1e-9 : 1e-4);
        assert_int_equal(free_sims(NULL), 0);
    }
}
#endif

static void what_does_not_go_together_is_refused(void **state)
{
    sph_report r;
    (void)state;
    sph_config c = bare_config(SPH_NESTED, SPH_STANDARD, SPH_PLAIN);
    assert_int_equal(sph_config_check(&c, &r), SPH_OK);
    c.nu = 0;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "nu");
    c.nu = 1;
    c.viscosity = SPH_MORRIS;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "shear");
    c = bare_config(SPH_SMAGORINSKY, SPH_STANDARD, SPH_PLAIN);
    c.nu = 0;
    assert_int_equal(sph_config_check(&c, &r), SPH_OK);
    c.solid = SPH_UPDATED;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "shear");
    c.solid = SPH_NO_SOLID;
    c.shear = SPH_SHEARS;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(corrected_gradients_of_linear_velocities_are_exact),
        subject(a_body_that_turns_feels_nothing),
        subject(the_stress_takes_energy_and_keeps_momentum),
        subject(eddies_give_back_no_more_than_they_get),
#if SPH_DIM > 1
        subject(a_parabola_feels_the_force_of_a_newtonian_fluid),
        subject(the_largest_eddy_viscosity_limits_the_step),
#endif
        subject(what_does_not_go_together_is_refused),
    };
    return run_subjects("shear", list);
}
