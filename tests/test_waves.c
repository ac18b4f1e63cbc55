/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_waves.c: the exact solitary wave that scenes start from is that of the reference tables and satisfies its
   equations; the tracking of crests finds a wave that is known, to a small part of a spacing. */
#include "testing.h"

#include "examples/scenes/soliton.h"
#include "examples/scenes/track.h"
#include "examples/scenes/waves.h"
#include "tools/table.h"

static double cell(const table *t, uint32_t row, const char *name)
{
    const int c = table_column(t, name, strlen(name));
    if (c < 0)
        fail_msg("%s: no column %s", t->file, name);
    return table_at(t, row, (uint32_t)c);
}

/* integral over the depth at x of f: 0: u, 1: half the speed squared, by Gauss with 5 points */
static double over_depth(const soliton *s, double x, int f)
{
    static const double at[5] = {0.04691007703067, 0.23076534494716, 0.5, 0.76923465505284, 0.95308992296933};
    static const double weight[5] = {0.11846344252809, 0.23931433524968, 0.28444444444444, 0.23931433524968,
                                     0.11846344252809};
    const double h = 1 + soliton_surface(s, x);
    double sum = 0, v[2], p;
    for (int k = 0; k < 5; k++) {
        soliton_flow(s, x, at[k] * h, v, &p);
        sum += weight[k] * h * (f ? 0.5 * (v[0] * v[0] + v[1] * v[1]) : v[0]);
    }
    return sum;
}

static void the_exact_wave_has_speed_mass_momentum_and_energy_of_the_tables(void **state)
{
    table t;
    (void)state;
    assert_true(table_open(&t, "tests/refdata/wave_soliton_integrals.csv"));
    for (uint32_t row = 0; row < t.rows; row++) {
        const double e = cell(&t, row, "e"), loose = e > 0.55 ? 1e-4 : 1e-6, dx = 0.02;
        double mass = 0, momentum = 0, kinetic = 0, potential = 0, v[2], p;
        soliton s;
        assert_true(soliton_make(&s, e));
        close_to(s.height, e, 1e-9);
        close_to(s.speed, cell(&t, row, "F_exact"), loose);
        for (double x = -24; x < 24; x += dx) {
            const double eta = soliton_surface(&s, x + 0.5 * dx);
            mass += dx * eta;
            potential += dx * 0.5 * eta * eta;
            momentum += dx * over_depth(&s, x + 0.5 * dx, 0);
            kinetic += dx * over_depth(&s, x + 0.5 * dx, 1);
        }
        /* what is left out beyond 24 depths */
        const double tail = 16 * e * exp(-24 * sqrt(2.4 * e)) + loose;
        close_to(mass, cell(&t, row, "mass"), tail);
        close_to(potential, cell(&t, row, "E_pot"), tail);
        close_to(momentum, cell(&t, row, "momentum"), tail);
        close_to(kinetic, cell(&t, row, "E_kin"), tail);
        soliton_flow(&s, 0, 1 + e, v, &p);
        /* the table's figure at the crest is a difference of potentials over a hundredth of a depth */
        close_to(v[0], cell(&t, row, "u_crest"), 1e-3);
    }
    table_close(&t);
}

static void its_surface_and_potential_are_those_of_the_profiles(void **state)
{
    static const double height[] = {0.3, 0.5};
    static const char *const file[] = {"tests/refdata/wave_soliton_profile_e0.3.csv",
                                       "tests/refdata/wave_soliton_profile_e0.5.csv"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        table t;
        soliton s;
        double potential = 0, before = 0;
        assert_true(table_open(&t, file[k]));
        assert_true(soliton_make(&s, height[k]));
        for (uint32_t row = 0; row < t.rows; row++) {
            const double x = cell(&t, row, "x");
            close_to(soliton_surface(&s, x), cell(&t, row, "eta"), 1e-7);
            close_to(soliton_surface(&s, -x), cell(&t, row, "eta"), 1e-7);
            /* along the surface dphi = u dx + v d eta, midpoints of 20 pieces */
            for (int i = 0; row && i < 20; i++) {
                const double a = before + (x - before) * i / 20, b = before + (x - before) * (i + 1) / 20;
                double v[2], p, m = 0.5 * (a + b);
                soliton_flow(&s, m, 1 + soliton_surface(&s, m), v, &p);
                potential += v[0] * (b - a) + v[1] * (soliton_surface(&s, b) - soliton_surface(&s, a));
            }
            before = x;
            close_to(potential, cell(&t, row, "phi"), 2e-6);
        }
        table_close(&t);
    }
}

/* in the frame of the wave: no rotation, no sources, no flow through bed and surface, Bernoulli, Euler's equations */
static void its_flow_is_free_of_sources_and_rotation_and_has_no_pressure_on_the_surface(void **state)
{
    soliton s;
    const double d = 1e-4;
    (void)state;
    assert_true(soliton_make(&s, 0.45));
    for (double x = -4; x < 4.1; x += 0.37) {
        const double eta = soliton_surface(&s, x);
        double v[2], p, vx[2][2], vy[2][2], px[2], py[2];
        soliton_flow(&s, x, 0, v, &p);
        close_to(v[1], 0, 1e-12);
        soliton_flow(&s, x, 1 + eta, v, &p);
        close_to(p, 0, 1e-8);
        const double slope = (soliton_surface(&s, x + d) - soliton_surface(&s, x - d)) / (2 * d);
        close_to(v[1], (v[0] - s.speed) * slope, 1e-7);
        for (double y = 0.1; y < 1 + eta - 2 * d; y += 0.3) {
            soliton_flow(&s, x, y, v, &p);
            for (int k = 0; k < 2; k++) {
                soliton_flow(&s, x + (k ? d : -d), y, vx[k], &px[k]);
                soliton_flow(&s, x, y + (k ? d : -d), vy[k], &py[k]);
            }
            const double ux = (vx[1][0] - vx[0][0]) / (2 * d), uy = (vy[1][0] - vy[0][0]) / (2 * d);
            close_to(ux + (vy[1][1] - vy[0][1]) / (2 * d), 0, 1e-6);
            close_to((vx[1][1] - vx[0][1]) / (2 * d) - uy, 0, 1e-6);
            close_to((v[0] - s.speed) * ux + v[1] * uy + (px[1] - px[0]) / (2 * d), 0, 1e-6);
            close_to((v[0] - s.speed) * (vx[1][1] - vx[0][1]) / (2 * d) - v[1] * ux + (py[1] - py[0]) / (2 * d) + 1, 0,
                     1e-6);
        }
    }
}

static void heights_that_no_wave_has_are_refused(void **state)
{
    static const double bad[] = {0, 0.009, 0.61, -0.3, 1};
    soliton s;
    (void)state;
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++)
        assert_false(soliton_make(&s, bad[k]));
    assert_false(soliton_make(&s, NAN));
}

/* a wave h = 1 + 0.3/cosh^2((x - at)/2) of speed 1.3, as columns of equal mass with the flux that it has: u h = c eta;
   the mass up to x is x + 0.6 tanh((x - at)/2), but for a constant */
static void columns_of_wave(sph_sim *sim, uint32_t set, double at, double length, double dx)
{
    for (int i = 0;; i++) {
        const double mass = (i + 0.5) * dx - 0.6 * tanh(at / 2);
        double low = 0, high = length;
        for (int k = 0; k < 60; k++) {
            const double x = 0.5 * (low + high);
            *(x + 0.6 * tanh((x - at) / 2) < mass ? &low : &high) = x;
        }
        if (low > length - 1e-9)
            return;
        const double c = cosh((low - at) / 2), h = 1 + 0.3 / (c * c);
        for (int j = 0; j < 1 / dx - 0.5; j++) {
            const double place[2] = {low, (j + 0.5) * dx * h}, v[2] = {1.3 * (h - 1) / h, 0};
            must(sim, sph_add_particle(sim, set, place, v, 0, NULL));
        }
    }
}

static void the_crest_of_a_known_wave_is_found_with_its_place_height_and_speed(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        const double dx = 1.0 / 12, at = 6 + 0.37 * k * dx, length = k % 2 ? 12 : 18;
        sph_config c = open_config(20, dx);
        const sph_fluid f = {.mass = 1000 * dx * dx};
        const track_tank tank = {0, length, 1, dx, k > 3, NULL, NULL};
        uint32_t set;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, &f, &set));
        columns_of_wave(sim, set, at, length, dx);
        const track_crest found = track_highest(sim, &tank);
        close_to(found.x, at, 0.02 * dx);
        close_to(found.height, 1.3, 0.01 * dx);
        close_to(found.speed, 1.3, 2e-3);
    }
}

static void water_at_rest_is_level_up_to_both_ends(void **state)
{
    const double dx = 0.1;
    sph_config c = open_config(4, dx);
    uint32_t set;
    const double lo[2] = {0, 0}, hi[2] = {4, 1};
    (void)state;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    for (int periodic = 0; periodic < 2; periodic++) {
        const track_tank tank = {0, 4, 1, dx, periodic == 1, NULL, NULL};
        const track_crest found = track_highest(sim, &tank);
        close_to(found.height, 1, 1e-4);
        close_to(found.speed, 0, 1e-12);
    }
}

static double ramp(const void *of, double x) { return *(const double *)of * x; }

/* water from the bed to y = 1, and on it a block up to 2 whose right face goes by `lean` a unit of height */
static sph_sim *block(double lean, double bed)
{
    const double dx = 1.0 / 16;
    sph_config c = open_config(12, dx);
    uint32_t set;
    c.max_particles = 6000;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (int i = 0; i < 160; i++)
        for (int j = 0; j < 32; j++) {
            const double x[2] = {(i + 0.5) * dx, (j + 0.5) * dx}, face = 5 + lean * (x[1] - 1);
            if (x[1] > bed * x[0] && (x[1] < 1 || (x[0] > 3 && x[0] < face)))
                must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
        }
    return sim;
}

static void the_face_of_a_wave_is_seen_to_lean_as_it_does(void **state)
{
    const track_tank tank = {0, 10, 1, 1.0 / 16, false, NULL, NULL};
    (void)state;
    for (double lean = -1; lean < 1.1; lean += 0.5) {
        const track_face f = track_steepest(block(lean, 0), &tank, (track_crest){4, 2, 0}, false);
        close_to(f.lean, lean, 0.13);
        assert_true(f.y > 1.1 && f.y < 2);
        close_to(f.x, 5 + lean * (f.y - 1), 0.75 / 16); /* the lattice's own steps are half a spacing off */
        const track_face none = track_steepest(block(lean, 0), &tank, (track_crest){4, 1, 0}, false);
        close_to(none.lean, 0, 0);
        const track_face left = track_steepest(block(lean, 0), &tank, (track_crest){4, 2, 0}, true);
        close_to(left.x, 3, 0.5 / 16); /* the other face is upright */
        close_to(left.lean, 0, 0.06);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void heights_and_fronts_stand_where_the_water_does(void **state)
{
    static const double slope = 0.05, at[3] = {2, 4, 8};
    const track_tank flat = {0, 10, 1, 1.0 / 16, false, NULL, NULL}, sloped = {0, 10, 1, 1.0 / 16, false, ramp, &slope};
    double h[3];
    (void)state;
    track_heights(block(0, 0), &flat, at, 3, h);
    close_to(h[0], 1, 1e-3);
    close_to(h[1], 2, 1e-3);
    close_to(h[2], 1, 1e-3);
    track_heights(block(0, slope), &sloped, at, 3, h);
    close_to(h[0], 1, 0.04); /* the lattice is cut at the bed */
    close_to(h[1], 2, 0.04);
    close_to(h[2], 1, 0.04);
    close_to(track_front(block(0, 0), &flat, 4, 1, 1.5), 5, 0.02);
    close_to(track_front(block(0, 0), &flat, 4, -1, 1.5), 3, 0.02);
    close_to(track_front(block(0, 0), &flat, 4, 1, 0.1), 10, 1e-9);
    close_to(track_between(block(0, 0), &flat, 6, 9).height, 1, 1e-2);
    close_to(track_highest(block(0, 0), &flat).height, 2, 0.1);
    close_to(track_at_wall(block(0, 0), 10, -1, 0.2), 1, 0.05);
}

/* a lattice of a tank 4 m long and 1 m deep that follows a surface of amplitude 0.2 m */
static double ripple(const void *of, double x)
{
    (void)of;
    return 0.2 * cos(3.14159265358979 * x);
}
static void a_lattice_follows_a_surface_and_keeps_its_volumes(void **state)
{
    const double lo[2] = {0, 0}, hi[2] = {4, 1}, dx = 0.05;
    const wave_surface w = {0, 1, dx, ripple, NULL};
    sph_config c = open_config(4, dx);
    double before = 0, moment = 0;
    uint32_t set;
    (void)state;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, wave_follow(sim, set, &w));
    for (uint32_t i = 0; i < 20 * 80; i++) {
        const sph_particle p = by_id(sim, i);
        const double above = p.x[1] / (1 + ripple(NULL, p.x[0])) / dx - 0.5;
        close_to(above, floor(above + 0.5), 1e-4); /* of rows 0 .. 19, each by as much of the depth */
        const double x = p.x[0] + 0.2 / 3.14159265358979 * sin(3.14159265358979 * p.x[0]); /* where it was */
        close_to(x / dx - 0.5, floor(x / dx), 1e-4);
        before += x;
        moment += cos(3.14159265358979 * p.x[0]);
    }
    close_to(before / (20 * 80), 2, 1e-5);
    close_to(2 * moment / (20 * 80), 0.2, 1e-3); /* the amplitude that the masses have */
    must(sim, wave_push(sim, set, dx, 0.1 * dx));
    double most = 0;
    for (uint32_t i = 0; i < 20 * 80; i++) {
        const sph_particle p = by_id(sim, i);
        const double above = p.x[1] / (1 + ripple(NULL, p.x[0])) / dx - 0.5;
        most = fmax(most, fabs(above - floor(above + 0.5)));
    }
    assert_true(most > 0.05 && most < 0.2);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(the_exact_wave_has_speed_mass_momentum_and_energy_of_the_tables),
        subject(its_surface_and_potential_are_those_of_the_profiles),
        subject(its_flow_is_free_of_sources_and_rotation_and_has_no_pressure_on_the_surface),
        subject(heights_that_no_wave_has_are_refused),
        subject(the_crest_of_a_known_wave_is_found_with_its_place_height_and_speed),
        subject(water_at_rest_is_level_up_to_both_ends),
        subject(the_face_of_a_wave_is_seen_to_lean_as_it_does),
        subject(heights_and_fronts_stand_where_the_water_does),
        subject(a_lattice_follows_a_surface_and_keeps_its_volumes),
    };
    return run_subjects("waves", list);
}
