/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_lattice.c: lattices of particles under stress (scene lattice_box): single waves run at the frequencies and
   growth rates of Gray's dispersion relation (2001, eqs 5.70-5.75), tension clumps particles unless the artificial
   stress acts, and the scene's measures of order are right on lattices. */
#include "testing.h"

#include "examples/scenes/solid.h"

static const scene *box;
static double p[64], row[64];

static void set(const char *name, double value)
{
    for (uint32_t k = 0; k < box->params; k++)
        if (!strcmp(box->param[k].name, name)) {
            assert_true(value >= box->param[k].min && value <= box->param[k].max);
            p[k] = value;
            return;
        }
    fail_msg("no parameter %s", name);
}

static double column(const char *name)
{
    for (uint32_t k = 0; k < box->columns; k++)
        if (!strcmp(box->column[k], name))
            return row[k];
    fail_msg("no column %s", name);
    return 0;
}

/* a square of n by n particles, spacing 1 */
static void defaults(int n)
{
    for (uint32_t s = 0; scene_table[s]; s++)
        if (!strcmp(scene_table[s]->name, "lattice_box"))
            box = scene_table[s];
    assert_non_null(box);
    assert_true(box->params <= 64 && box->columns <= 64);
    for (uint32_t k = 0; k < box->params; k++)
        p[k] = box->param[k].value;
    set("n", n);
    set("side", n);
    set("repulsion", SPH_PRINCIPAL);
}

static sph_sim *build(void)
{
    sph_config c;
    box->configure(p, &c);
    sph_sim *sim = new_sim(&c);
    must(sim, box->build(sim, p));
    box->history(sim, p, row);
    return sim;
}

/* Fits omega^2 (negative: growth^2) of the run to v(t + d) + v(t - d) = 2 cos(omega d) v(t). The wave is the shortest
   along x: neighbours move against each other. */
static double shortest_wave(const char *amplitude)
{
    enum { ROWS = 64, SPAN = 8 };
    const double dt = 1.0 / 64;
    double v[ROWS + 1], vb = 0, vv = 0;
    set("noise", 0);
    set("epsilon", 0);
    set("waves_x", 5);
    set("wave", SPH_DOUBLE ? 1e-6 : 1e-4);
    set("viscosity", SPH_INVISCID);
    set("dt", dt);
    sph_sim *sim = build();
    v[0] = column(amplitude);
    for (int k = 1; k <= ROWS; k++) {
        for (int s = 0; s < 4; s++)
            must(sim, sph_step(sim));
        box->history(sim, p, row);
        v[k] = column(amplitude);
    }
    for (int k = SPAN; k <= ROWS - SPAN; k++) {
        vb += 0.5 * (v[k + SPAN] + v[k - SPAN]) * v[k];
        vv += v[k] * v[k];
    }
    const double c = vb / vv, d = 4 * SPAN * dt, w = fabs(c) <= 1 ? acos(c) / d : acosh(c) / d;
    return fabs(c) <= 1 ? w * w : -(w * w);
}

/* 5.72, h = dx = 1 */
#define SCALE (30 / (7 * SCENE_PI))
#define BXX (SCALE * (10 - 5 * sqrt(2)))
#define BYY (SCALE * (7 - 5 * sqrt(2)))
/* rho omega^2 = 2 B P; the growth rate itself within 0.5 % */
#define omega2_is(measured, theory) close_to(measured, theory, 0.01 * fabs(theory))

static void compressed_lattice_swings_along_and_slips_across(void **state)
{
    (void)state;
    defaults(10);
    set("rho", 1.1);
    omega2_is(shortest_wave("along_c0"), 2 * BXX * 0.1 / 1.1);
    defaults(10);
    set("rho", 1.1);
    set("direction", 1);
    omega2_is(shortest_wave("across_c0"), 2 * BYY * 0.1 / 1.1);
}

static void stretched_lattice_clumps_at_the_rate_of_theory(void **state)
{
    (void)state;
    defaults(10);
    set("lambda", 0.9);
    omega2_is(shortest_wave("along_c0"), -2 * BXX * 0.1);
    defaults(10);
    set("lambda", 0.9);
    set("direction", 1);
    omega2_is(shortest_wave("across_c0"), -2 * BYY * 0.1);
}

/* smallest distance of two particles after a time in which sound goes 120 spacings */
static double nearest_after_tension(double epsilon, double seed)
{
    defaults(16);
    set("lambda", 0.9);
    set("epsilon", epsilon);
    set("seed", seed);
    sph_sim *sim = build();
    while (sph_time(sim) < 120)
        must(sim, sph_step(sim));
    box->history(sim, p, row);
    return column("nearest_min_dx");
}

static void tension_clumps_without_artificial_stress(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 3; seed++) {
        const double clumped = nearest_after_tension(0, seed), kept = nearest_after_tension(0.3, seed);
        if (!(clumped < 0.7 && kept > 0.85))
            fail_msg("seed %d: nearest %g without, %g with artificial stress", seed, clumped, kept);
    }
}

static void order_of_lattices_is_measured(void **state)
{
    (void)state;
    for (int lattice = SPH_LATTICE_SQUARE; lattice <= SPH_LATTICE_SHIFTED_Y; lattice++) {
        defaults(12);
        set("lattice", lattice);
        set("lambda", 0.9);
        build();
        close_to(column("nearest_min_dx"), 1, 1e-5);
        close_to(column("nearest_mean_dx"), 1, 1e-5);
        close_to(column("face_centred_-"), lattice == SPH_LATTICE_SQUARE ? 0 : 1, 1e-9);
        close_to(column("hole_dx"), lattice == SPH_LATTICE_SQUARE ? sqrt(0.5) : sqrt(0.3125), 0.01);
        close_to(column("stress_mean_K"), 0.1, 1e-6);
        close_to(column("stress_rms_K"), 0, 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(compressed_lattice_swings_along_and_slips_across),
        subject(stretched_lattice_clumps_at_the_rate_of_theory),
        subject(tension_clumps_without_artificial_stress),
        subject(order_of_lattices_is_measured),
    };
    return run_subjects("lattice", list);
}
