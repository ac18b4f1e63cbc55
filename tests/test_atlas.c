/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_atlas.c: single entries of the stability atlas (tests/lab): methods fail where theory says that they fail and
   hold where it says that they hold, and what fails grows as fast as theory says. Every subject has a case that
   fails. */
#include "testing.h"

#include "tests/lab/atlas.h"
#include "tests/lab/theory.h"
#include "tools/dispersion.h"
#include "tools/table.h"

/* ---- steps ---- */

static void steps_stand_as_long_as_theory_says(void **state)
{
    static const struct {
        courant_case c;
        uint32_t steps;
        double within;
    } list[] = {
        {{false, SPH_STANDARD, SPH_KICK_DRIFT_KICK, SPH_WENDLAND_C2, 1.2}, 300, 0.01},
        {{false, SPH_WEAK, SPH_LEAP_FROG, SPH_CUBIC, 1.2}, 300, 0.01},
        {{false, SPH_STANDARD, SPH_PREDICTOR_CORRECTOR, SPH_WENDLAND_C2, 1.2}, 400, 0.04},
        {{false, SPH_STANDARD, SPH_RUNGE_KUTTA, SPH_CUBIC, 1.2}, 400, 0.04},
        {{false, COURANT_SUMMED, SPH_PREDICTOR_CORRECTOR, SPH_CUBIC, 1.2}, 300, 0.01},
        {{true, SPH_UPDATED, SPH_KICK_DRIFT_KICK, SPH_CUBIC, 1.2}, 300, 0.01},
        {{true, SPH_CORRECTED, SPH_PREDICTOR_CORRECTOR, SPH_CUBIC, 1.2}, 400, 0.04},
        {{true, SPH_TOTAL, SPH_KICK_DRIFT_KICK, SPH_CUBIC, 1.2}, 300, 0.01},
    };
    (void)state;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const double m = courant_measured(&list[i].c, list[i].steps, 0.01), t = courant_theory(&list[i].c);
        print_message("atlas: %s, %s: Courant number %.3f, theory %.3f\n", atlas_integrators[list[i].c.integrator],
                      atlas_kernels[list[i].c.kernel], m, t);
        close_to(m / t, 1, list[i].within + 0.01); /* and what the bisection leaves */
    }
}

/* an oscillator of frequency w: without viscosity what keeps one evaluation damps it by 1 - (w dt)^4/8 where it
   foresees the rate of density, up to w dt = 0.754, and else amplifies it at any step by 1 + (w dt)^4/4; so does the
   midpoint rule by 1 + (w dt)^4/8; the others stand w dt = 2 */
static void factors_are_those_of_an_oscillator(void **state)
{
    theory_step t = {.medium = THEORY_WATER, .integrator = SPH_KICK_DRIFT_KICK, .kernel = SPH_CUBIC, .n = 12, .h = 1.2,
                     .mass = 1};
    const double limit = theory_limit(&t), w = 2 / limit, z = 0.15, dt = z / w, z4 = z * z * z * z;
    (void)state;
    close_to(theory_factor(&t, 0.9 * limit), 1, 1e-4);
    assert_true(theory_factor(&t, 1.1 * limit) > 1.5);
    t.integrator = SPH_PREDICTOR_CORRECTOR;
    close_to(theory_limit(&t) * w, 0.754, 0.002);
    t.medium = THEORY_UPDATED;
    close_to((theory_factor(&t, dt) - 1) / (z4 / 4), 1, 0.1);
    t.medium = THEORY_WATER;
    t.integrator = SPH_RUNGE_KUTTA;
    close_to((theory_factor(&t, dt) - 1) / (z4 / 8), 1, 0.05);
}

/* ---- growth ---- */

static growth_case square(uint32_t form, double h, double volume)
{
    const growth_case c = {.form = form, .kernel = SPH_CUBIC, .h = h, .mu = 0.22, .volume = volume, .exponent = 4};
    return growth_sided(c, 12);
}

static void theory_is_that_of_dispersion(void **state)
{
    static const double wave[][2] = {{0.3, 0.1}, {1, 2}, {3.1, 0}, {3.1, 3.1}, {2, 2.5}};
    (void)state;
    for (double volume = 0.9; volume < 1.11; volume += 0.05)
        for (size_t i = 0; i < sizeof wave / sizeof *wave; i++) {
            const theory_box b = {.form = SPH_UPDATED, .kernel = SPH_QUINTIC, .n = 12, .h = 1.3, .mu = 0.22,
                                  .volume = volume};
            const elastic_state e = {.rho = 1, .c = 1, .mu = 0.22, .pressure = 1 - volume};
            double v[2];
            bool both;
            wave_modes m;
            theory_modes(&b, wave[i], v, &both);
            lattice_waves(&e, SPH_QUINTIC, LATTICE_SQUARE, 1.3, 1, wave[i], &m);
            assert_false(both);
            close_to(v[0], -fmin(m.omega2[0], m.omega2[1]), 1e-12);
            close_to(v[1], -fmax(m.omega2[0], m.omega2[1]), 1e-12);
        }
}

/* with exact gradients long waves go as in a solid under pressure */
static void corrected_long_waves_are_exact(void **state)
{
    (void)state;
    for (uint32_t form = SPH_CORRECTED; form <= SPH_TOTAL; form++) {
        const theory_box b = {.form = form, .kernel = SPH_CUBIC, .n = 12, .h = 1.3, .mu = 0.22, .volume = 1};
        const double k[2] = {6e-4, 8e-4};
        double v[2];
        bool both;
        theory_modes(&b, k, v, &both);
        assert_false(both);
        close_to(v[1] / -1e-6, 1 + 4 * 0.22 / 3, 1e-5);
        close_to(v[0] / -1e-6, 0.22, 1e-5);
    }
}

static void tension_breaks_all_but_the_total_form(void **state)
{
    static const struct {
        uint32_t form;
        double h, volume;
        bool grows;
    } list[] = {{SPH_UPDATED, 1.2, 1.1, true},    {SPH_UPDATED, 1.2, 1.025, true}, {SPH_UPDATED, 1.2, 0.9, false},
                {SPH_UPDATED, 1, 0.9, true},      {SPH_UPDATED, 1.2, 1, false},    {SPH_CORRECTED, 1.2, 1.1, true},
                {SPH_CORRECTED, 1.2, 0.9, false}, {SPH_TOTAL, 1.2, 1.1, false},    {SPH_TOTAL, 1.2, 0.9, false}};
    (void)state;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const growth_case c = square(list[i].form, list[i].h, list[i].volume);
        const double t = growth_theory(&c), m = growth_measured(&c, 250);
        print_message("atlas: %s, h %.1f, V/V0 %.3f: grows by %.3f c0/dx, theory %.3f\n", atlas_forms[c.form], c.h,
                      c.volume,
                      m, t);
        assert_int_equal(m > 0, list[i].grows);
        assert_int_equal(t > 0, list[i].grows);
        close_to(m, t, 0.05 * t);
    }
}

static void repulsion_slows_or_stops_it(void **state)
{
    double last = 1;
    (void)state;
    for (double epsilon = 0; epsilon < 0.35; epsilon += 0.15) {
        growth_case c = square(SPH_UPDATED, 1, 1.05);
        c.epsilon = epsilon;
        const double t = growth_theory(&c), m = growth_measured(&c, 250);
        print_message("atlas: epsilon %.1f: grows by %.3f c0/dx, theory %.3f\n", epsilon, m, t);
        close_to(m, t, 0.05 * t);
        assert_true(m < 0.7 * last);
        last = m;
    }
}

/* many neighbours in compression: the cubic spline pairs, Wendland's function does not */
static void wide_splines_pair(void **state)
{
    double mean[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        growth_case c = {.form = SPH_UPDATED, .kernel = i ? SPH_WENDLAND_C2 : SPH_CUBIC, .h = 2, .volume = 1 / 1.1};
        c.lattice = SPH_LATTICE_SHIFTED_X;
        c = growth_sided(c, 12);
        const double t = growth_theory(&c), m = growth_measured(&c, 500), nearest = growth_nearest(&c, 600, &mean[i]);
        print_message("atlas: %s, h 2, compressed: grows by %.3f c0/dx, theory %.3f; nearest %.2f dx, mean %.2f\n",
                      atlas_kernels[c.kernel], m, t, nearest, mean[i]);
        close_to(m, t, 0.05 * t + 0.001);
        assert_true(i == 0 ? m > 0.04 : m < 0.02);
    }
    assert_true(mean[0] < 0.5);
    assert_true(mean[1] > 0.9);
}

/* ---- the chain ---- */

static void chains_buckle_at_powells_stretch(void **state)
{
    table t;
    (void)state;
    assert_true(table_open(&t, "tests/refdata/powell_critical_tension.csv"));
    for (uint32_t r = 0; r < t.rows; r++) {
        const double want = table_at(&t, r, 1);
        close_to(tension_powell(SPH_CUBIC, table_at(&t, r, 0), 30, 0.2), want, 2e-3 * want);
    }
    table_close(&t);
    static const uint32_t kernel[] = {SPH_CUBIC, SPH_WENDLAND_C2};
    for (int i = 0; i < 2; i++) {
        const double end = 2000, seen = tension_cholesky(kernel[i], 1.2, 30, 0.2, TENSION_SEEN / end);
        const double limit = tension_cholesky(kernel[i], 1.2, 30, 0.2, 0);
        const double ran = tension_running(kernel[i], 1.2, 30, 0.2, end, 0.01);
        print_message("atlas: chain, %s: buckles at a stretch of %.5f, theory %.5f\n", atlas_kernels[kernel[i]], ran,
                      limit);
        close_to(ran, seen, 0.02 * seen);
        close_to(seen, limit, 0.03 * limit);
    }
    assert_true(tension_running(SPH_HAT, 1.2, 30, 0.2, 500, 0.01) >= TENSION_NONE);
    assert_true(tension_cholesky(SPH_HAT, 1.2, 30, 0.2, 0) >= TENSION_NONE);
}

/* ---- water ---- */

/* under tension water pairs whatever is done to its density; without tension it stays */
static void water_in_tension_clumps(void **state)
{
    (void)state;
    for (uint32_t choice = 0; choice < WATER_CHOICES; choice++) {
        const water_case w = {.kernel = SPH_WENDLAND_C2, .h = 1.2, .density = 0.95, .choice = choice};
        const double m = water_growth(&w, 250), t = water_theory(&w);
        print_message("atlas: water in tension, choice %u: grows by %.3f c0/dx, theory of the plain form %.3f\n",
                      choice, m, t);
        if (choice == WATER_PLAIN || choice == WATER_WEAK)
            close_to(m, t, 0.05 * t);
        else if (choice == WATER_FLOOR || choice == WATER_DIRECT)
            assert_true(m < 0.1 * t);
        else
            assert_true(m > 0.5 * t);
    }
}

/* ---- walls ---- */

static void walls_keep_a_tank_still_or_not(void **state)
{
    static const uint32_t early[] = {1000}, late[] = {1000, 10000};
    const tank_case lj = {.wall = WALL_LJ, .alpha = 0.01}, mirror = {.wall = WALL_MIRROR, .alpha = 0.01};
    const tank_case adami = {.wall = WALL_EXTRAPOLATED, .alpha = 0.01};
    wall_tank t[2];
    uint32_t failed;
    (void)state;
    assert_int_equal(wall_rest(&lj, early, 1, t, &failed), 1);
    assert_true(t[0].speed > 0.03 && t[0].moved > 0.2);
    assert_int_equal(wall_rest(&mirror, early, 1, t, &failed), 1);
    assert_true(t[0].speed < 0.003 && t[0].moved < 0.01);
    assert_int_equal(wall_rest(&adami, late, 2, t, &failed), 2);
    print_message("atlas: tank, Adami walls: moved by %.3f dx in 1000 steps, by %.3f in 10000\n", t[0].moved,
                  t[1].moved);
    assert_true(t[0].moved < 0.03 && t[1].moved > 0.2);
}

static void walls_leak_where_they_are_weak(void **state)
{
    (void)state;
    assert_true(wall_throw(WALL_LJ, 1, 0, 0.3, false).crossed == 0);
    assert_true(wall_throw(WALL_LJ, 0.1, 0, 2, false).crossed > 0.9);
    assert_true(wall_throw(WALL_KERNEL, 1, 0, 0.3, false).crossed > 0.9);
    assert_true(wall_throw(WALL_KERNEL, 10, 0, 0.1, false).crossed == 0);
    const wall_leak back = wall_throw(WALL_KERNEL, 1, 0, 0.3, true), mirror = wall_throw(WALL_MIRROR, 0, 0, 2, false);
    assert_true(back.crossed == 0 && back.put_back > 60 && !back.failed);
    assert_true(mirror.crossed == 0);
}

/* ---- waves that leave ---- */

/* a layer of 20 spacings: of the right rate it takes a packet in, too weak or too thin it does not; without it all
   comes back */
static void sponges_take_packets_in_or_not(void **state)
{
    static const struct {
        sponge_case c;
        double least, most;
    } list[] = {{{SPONGE_WATER, 20, SPONGE_PACKET, 12}, 0, 5e-4}, {{SPONGE_BAR, 20, SPONGE_PACKET, 12}, 0, 1e-3},
                {{SPONGE_WATER, 20, SPONGE_SWING, 12}, 0, 0.01},  {{SPONGE_WATER, 20, SPONGE_PACKET, 1}, 0.3, 0.6},
                {{SPONGE_WATER, 5, SPONGE_PACKET, 20}, 0.05, 1},  {{SPONGE_WATER, 20, SPONGE_PULSE, 12}, 0.1, 1},
                {{SPONGE_WATER, 20, SPONGE_PACKET, 0}, 0.98, 1.01}};
    (void)state;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const double r = sponge_reflected(&list[i].c);
        print_message("atlas: sponge of %u spacings, rate %g, wave %u: %.2e of the energy comes back\n",
                      list[i].c.width, list[i].c.rate, list[i].c.wave, r);
        assert_true(r >= list[i].least && r <= list[i].most);
    }
}

/* ---- float and double ---- */

static void float_and_double_part_where_it_is_unstable(void **state)
{
    const precision_pair a = precision_part(PAIR_TENSION, 600), b = precision_part(PAIR_BLOCK, 1500);
    (void)state;
    print_message("atlas: float and double, 1e-3 dx apart: in tension after %u steps, a block that rings never in %u\n",
                  a.part[0][0], b.steps);
    assert_true(a.part[0][0] > 100 && a.part[0][0] < 600);
    assert_int_equal(b.steps, 1500);
    assert_int_equal(b.part[0][0], 0);
    assert_true(b.kinetic < 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        subject(steps_stand_as_long_as_theory_says),
        subject(factors_are_those_of_an_oscillator),
        subject(theory_is_that_of_dispersion),
        subject(corrected_long_waves_are_exact),
        subject(tension_breaks_all_but_the_total_form),
        subject(repulsion_slows_or_stops_it),
        subject(wide_splines_pair),
        subject(chains_buckle_at_powells_stretch),
        subject(water_in_tension_clumps),
        subject(walls_keep_a_tank_still_or_not),
        subject(walls_leak_where_they_are_weak),
        subject(sponges_take_packets_in_or_not),
        subject(float_and_double_part_where_it_is_unstable),
    };
    return run_subjects("atlas", tests);
}
