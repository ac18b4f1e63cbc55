/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_profile.c: sampling of dumps along lines and ellipses: linear fields come out exactly by moving least squares,
   at surfaces too; constants by Shepard's mean; displacement from a reference; extremes; what is refused. */
#include "testing.h"

#include "synthetic.h"
#include "tools/commands.h"
#include "tools/table.h"

static char dump[100], before[100], out[100];

static int make_names(void **state)
{
    (void)state;
    temp_name(dump, sizeof dump, ".sph");
    temp_name(before, sizeof before, "_before.sph");
    temp_name(out, sizeof out, ".csv");
    return 0;
}
static int remove_files(void **state)
{
    (void)state;
    remove(dump);
    remove(before);
    remove(out);
    return 0;
}

/* `sph profile DUMP OPTIONS... out=`, options up to the first null */
static int run(const char *file, const char *const *options)
{
    char text[12][160], *argv[14] = {"profile", text[0], text[1]};
    int n = 3;
    snprintf(text[0], sizeof text[0], "%s", file);
    snprintf(text[1], sizeof text[1], "out=%s", out);
    for (; *options; options++, n++) {
        snprintf(text[n - 1], sizeof text[n - 1], "%s", *options);
        argv[n] = text[n - 1];
    }
    return cmd_profile(n, argv);
}
#define profile(...) run(dump, (const char *const[]){__VA_ARGS__, NULL})

static double cell(const table *t, uint32_t row, const char *name)
{
    const int c = table_column(t, name, strlen(name));
    if (c < 0)
        fail_msg("no column %s", name);
    return table_at(t, row, (uint32_t)c);
}

/* a block from 0.2 on of edges 2, 1, 0.5 in cells of dx, moved at random by up to a third; linear velocities, constant
   damage */
static synth *block(uint32_t dim, double dx)
{
    const double lo[3] = {0.2, 0.2, 0.2}, hi[3] = {2.2, dim > 1 ? 1.2 : 0, dim > 2 ? 0.7 : 0};
    sph_rng rng;
    synth *s = synth_new(dim, dx, 3, 2, 1);
    sph_rng_seed(&rng, 5, dim);
    synth_box(s, 0, lo, hi);
    for (uint32_t i = 0; i < s->n; i++) {
        for (uint32_t k = 0; k < dim; k++)
            s->part[i].x[k] += dx * (2 * sph_rng_uniform(&rng) - 1) / 3;
        const double *x = s->part[i].x;
        s->part[i].v[0] = 3 - 2 * x[0] + 5 * x[1] - x[2];
        s->part[i].v[1] = 7 * x[0];
        s->part[i].damage = 0.5;
    }
    return s;
}
static double linear(const table *t, uint32_t row, uint32_t dim)
{
    return 3 - 2 * cell(t, row, "x_m") + (dim > 1 ? 5 * cell(t, row, "y_m") : 0) - (dim > 2 ? cell(t, row, "z_m") : 0);
}

static void linear_fields_come_out_exactly(void **state)
{
    static const char *const from[] = {"from=0.2", "from=0.2,0.2", "from=0.2,0.2,0.2"};
    static const char *const to[] = {"to=2.2", "to=2.2,1.2", "to=2.2,1.2,0.7"}; /* corner to corner */
    static const double spacing[] = {0.01, 0.04, 0.08};
    (void)state;
    for (uint32_t dim = 1; dim <= 3; dim++) {
        table t;
        double worst = 0;
        synth_write(block(dim, spacing[dim - 1]), dump);
        assert_int_equal(profile("field=velocity_x,damage", from[dim - 1], to[dim - 1], "n=41"), 0);
        assert_true(table_open(&t, out));
        assert_int_equal(t.rows, 41);
        for (uint32_t r = 0; r < t.rows; r++) {
            worst = fmax(worst, fabs(cell(&t, r, "velocity_x") - linear(&t, r, dim)));
            close_to(cell(&t, r, "velocity_x"), linear(&t, r, dim), 1e-7);
            close_to(cell(&t, r, "damage"), pow(0.5, dim), 1e-9);
            close_to(cell(&t, r, "order"), 1, 0);
        }
        close_to(cell(&t, 40, "s_m"), sqrt(4 + (dim > 1) + (dim > 2) * 0.25), 1e-9);
        table_close(&t);
        print_message("profile: a linear field in %u-D from corner to corner within %.1e\n", dim, worst);
    }
}

/* the mean is one-sided at a surface: that is what order 1 is for */
static void the_mean_is_exact_for_constants_alone(void **state)
{
    table t;
    (void)state;
    synth_write(block(2, 0.04), dump);
    assert_int_equal(profile("field=velocity_x,damage", "from=0.2,0.7", "to=2.2,0.7", "order=0", "n=5"), 0);
    assert_true(table_open(&t, out));
    for (uint32_t r = 0; r < t.rows; r++) {
        close_to(cell(&t, r, "damage"), 0.25, 1e-9);
        close_to(cell(&t, r, "order"), 0, 0);
    }
    assert_true(fabs(cell(&t, 0, "velocity_x") - linear(&t, 0, 2)) > 0.01);
    table_close(&t);
}

static void places_without_particles_are_left_out(void **state)
{
    table t;
    (void)state;
    synth_write(block(2, 0.04), dump);
    assert_int_equal(profile("field=speed", "from=0,0.7", "to=3,0.7", "n=301"), 0);
    assert_true(table_open(&t, out));
    assert_true(t.rows < 230 && t.rows > 200);
    assert_true(cell(&t, 0, "x_m") > 0.05 && cell(&t, t.rows - 1, "x_m") < 2.35);
    table_close(&t);
}

/* a single row of particles does not span the plane */
static void a_row_of_particles_gets_the_mean(void **state)
{
    const double hi[3] = {2, 0.05, 0}, lo[3] = {0, 0, 0};
    table t;
    synth *s = synth_new(2, 0.05, 3, 2, 0);
    (void)state;
    synth_box(s, 0, lo, hi);
    synth_write(s, dump);
    assert_int_equal(profile("field=density", "from=0.5,0.03", "to=1.5,0.03", "n=3"), 0);
    assert_true(table_open(&t, out));
    for (uint32_t r = 0; r < 3; r++) {
        close_to(cell(&t, r, "order"), 0, 0);
        close_to(cell(&t, r, "density"), 1000, 1e-6);
    }
    table_close(&t);
}

/* a plate bent to a parabola; its middle line followed from where it was, whatever the order of the arrays */
static void displacement_is_from_the_reference(void **state)
{
    const double hi[3] = {2, 0.2, 0}, lo[3] = {0, 0, 0};
    char reference[120];
    table t;
    synth *s = synth_new(2, 0.02, 3, 2, 0);
    (void)state;
    synth_box(s, 0, lo, hi);
    synth_write(s, before);
    for (uint32_t i = 0; i < s->n; i++)
        s->part[i].x[1] += 0.1 * s->part[i].x[0] * s->part[i].x[0];
    for (uint32_t i = 0; i < s->n / 2; i++) {
        const __typeof__(s->part[0]) swap = s->part[i];
        s->part[i] = s->part[s->n - 1 - i];
        s->part[s->n - 1 - i] = swap;
    }
    synth_write(s, dump);
    snprintf(reference, sizeof reference, "reference=%s", before);
    assert_int_equal(profile("field=displacement_y,displacement_x", "from=0,0.1", "to=2,0.1", "n=21", reference), 0);
    assert_true(table_open(&t, out));
    assert_int_equal(t.rows, 21);
    for (uint32_t r = 0; r < t.rows; r++) {
        const double x = cell(&t, r, "x_m");
        close_to(cell(&t, r, "displacement_y"), 0.1 * x * x, 1e-4); /* the curvature over the reach */
        close_to(cell(&t, r, "displacement_x"), 0, 1e-8);
    }
    table_close(&t);
    assert_int_equal(profile("field=displacement_y", "from=0,0.1", "to=2,0.1"), 1);
    remove(before);
    assert_int_equal(profile("field=displacement_y", "from=0,0.1", "to=2,0.1", reference), 1);
}

static void an_ellipse_is_gone_round(void **state)
{
    table t;
    (void)state;
    synth_write(block(2, 0.04), dump);
    assert_int_equal(profile("field=velocity_x", "ellipse=1.2,0.7,0.4,0.2", "n=37"), 0);
    assert_true(table_open(&t, out));
    assert_int_equal(t.rows, 37);
    for (uint32_t r = 0; r < t.rows; r++) {
        const double a = cell(&t, r, "angle_deg") * 3.14159265358979323846 / 180;
        close_to(cell(&t, r, "angle_deg"), 10 * r, 1e-9);
        close_to(cell(&t, r, "x_m"), 1.2 + 0.4 * cos(a), 1e-9);
        close_to(cell(&t, r, "y_m"), 0.7 + 0.2 * sin(a), 1e-9);
        close_to(cell(&t, r, "velocity_x"), linear(&t, r, 2), 1e-7);
    }
    table_close(&t);
    assert_int_equal(profile("field=velocity_x", "ellipse=1.2,0.7,0.4,0.2", "angles=0,90", "n=2"), 0);
    assert_true(table_open(&t, out));
    close_to(cell(&t, 1, "y_m"), 0.9, 1e-9);
    table_close(&t);
}

/* A linear field goes on outside of the particles it was made from: a corner at (1, 1), and places that only its three
   last particles reach. There the mean holds, which stays in the range of the particles; the surface itself is still of
   order 1. */
static void nothing_is_extrapolated(void **state)
{
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 0};
    table t;
    synth *s = synth_new(2, 0.05, 3, 2, 0);
    (void)state;
    synth_box(s, 0, lo, hi);
    for (uint32_t i = 0; i < s->n; i++)
        s->part[i].v[0] = (s->part[i].x[0] + s->part[i].x[1] - 1.95) / 0.05 * 5; /* 0 at the last, -5 beside it */
    synth_write(s, dump);
    assert_int_equal(profile("field=velocity_x", "from=1,1", "to=1.08,1.08", "n=33"), 0);
    assert_true(table_open(&t, out));
    assert_true(t.rows > 10);
    close_to(cell(&t, 0, "order"), 1, 0);
    close_to(cell(&t, 0, "velocity_x"), 5, 1e-6); /* the surface, half a spacing out on both axes */
    for (uint32_t r = 0; r < t.rows; r++) {
        const double v = cell(&t, r, "velocity_x"), by = cell(&t, r, "x_m") - 1;
        if (cell(&t, r, "particles") <= 3 || by > 0.026) {
            close_to(cell(&t, r, "order"), 0, 0);
            assert_true(v <= 1e-6 && v > -11);
        }
    }
    table_close(&t);
    /* three particles alone, which a linear field fits whatever they say */
    s->n = 3;
    for (uint32_t i = 0; i < 3; i++) {
        s->part[i].x[0] = 0.5 + (i == 1 ? 0.05 : 0);
        s->part[i].x[1] = 0.5 + (i == 2 ? 0.05 : 0);
        s->part[i].v[0] = i == 0 ? 1 : -1;
    }
    synth_write(s, dump);
    assert_int_equal(profile("field=velocity_x", "from=0.45,0.45", "to=0.55,0.55", "n=9"), 0);
    assert_true(table_open(&t, out));
    for (uint32_t r = 0; r < t.rows; r++) {
        close_to(cell(&t, r, "order"), 0, 0);
        assert_true(fabs(cell(&t, r, "velocity_x")) <= 1);
    }
    table_close(&t);
}

/* A quarter of a body with mirror planes x = 0 and y = 0: profiles are those of the whole body, up to the planes and on
   them, in the corner too. */
static void mirror_planes_are_seen(void **state)
{
    static const char *const fields = "field=density,velocity_x,velocity_y,stress_xx,stress_xy,x,displacement_x";
    static const char *const names[] = {"density", "velocity_x", "velocity_y", "stress_xx", "stress_xy", "x",
                                        "displacement_x", "particles", "order"};
    static const char *const orders[] = {"order=0", "order=1"};
    char reference[120];
    double wanted[21][9];
    table t;
    (void)state;
    snprintf(reference, sizeof reference, "reference=%s", before);
    for (int o = 0; o < 2; o++)
        for (int whole = 1; whole >= 0; whole--) {
            const double lo[3] = {whole ? -1 : 0, whole ? -1 : 0, 0}, hi[3] = {1, 1, 0};
            synth *s = synth_new(2, 0.05, 3, 2, 0);
            s->with_stress = true;
            for (uint32_t k = 0; k < 2; k++)
                s->lo[k] = whole ? -3 : 0;
            s->face[0] = s->face[2] = whole ? SPH_OPEN : SPH_SYMMETRY;
            synth_box(s, 0, lo, hi);
            synth_write(s, before);
            for (uint32_t i = 0; i < s->n; i++) {
                const double x = s->part[i].x[0], y = s->part[i].x[1];
                s->part[i].rho = 0.1 * (1 + x * x - y * y);
                s->part[i].v[0] = x * (3 + y * y);
                s->part[i].v[1] = -y * (1 + x * x);
                s->part[i].stress[0] = 7 + x * x;
                s->part[i].stress[2] = x * y;
                s->part[i].x[0] += 0.01 * x;
            }
            synth_write(s, dump);
            assert_int_equal(profile(fields, reference, "from=0,0", "to=0.2,0.1", "n=21", orders[o]), 0);
            assert_true(table_open(&t, out));
            assert_int_equal(t.rows, 21);
            for (uint32_t r = 0; r < t.rows; r++)
                for (int c = 0; c < 9; c++) {
                    const double v = cell(&t, r, names[c]);
                    if (!whole)
                        close_to(v, wanted[r][c], 1e-6 * fmax(1, fabs(v)));
                    wanted[r][c] = v;
                }
            table_close(&t);
        }
}

/* solids count and a gas beside them does not, unless asked for */
static void the_body_is_not_mixed_with_what_is_beside_it(void **state)
{
    const double lo[3] = {0, 0, 0}, mid[3] = {1, 1, 0}, from[3] = {1, 0, 0}, hi[3] = {2, 1, 0};
    table t;
    synth *s = synth_new(2, 0.05, 3, 2, 0);
    (void)state;
    s->set[1].role = 0;
    synth_box(s, 0, lo, mid);
    synth_box(s, 1, from, hi);
    for (uint32_t i = 0; i < s->n; i++)
        s->part[i].v[0] = s->part[i].set ? 5 : 1;
    synth_write(s, dump);
    static const char *const of[] = {"of=solid", "of=fluid", "of=all"};
    static const double wanted[] = {1, 5, 3};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(profile("field=velocity_x", "from=1,0.5", "to=1,0.5", "n=1", of[i]), 0);
        assert_true(table_open(&t, out));
        close_to(cell(&t, 0, "velocity_x"), wanted[i], 1e-6);
        table_close(&t);
    }
}

static void bad_input_is_refused(void **state)
{
    (void)state;
    synth_write(block(2, 0.1), dump);
#define LINE "field=speed", "from=0,0", "to=1,1"
    assert_int_equal(profile("from=0,0", "to=1,1"), 2);
    assert_int_equal(profile("field=speed", "from=0,0"), 2);
    assert_int_equal(profile(LINE, "ellipse=1,1,1,1"), 2);
    assert_int_equal(profile(LINE, "angles=0,90"), 2);
    assert_int_equal(profile("field=speed", "ellipse=1,1,0,1"), 2);
    assert_int_equal(profile("field=speed", "ellipse=1,1,1"), 2);
    assert_int_equal(profile("field=speed", "from=0", "to=1"), 2);
    assert_int_equal(profile("field=speed", "from=0,0,0", "to=1,1,1"), 2);
    assert_int_equal(profile(LINE, "n=0"), 2);
    assert_int_equal(profile(LINE, "order=2"), 2);
    assert_int_equal(profile(LINE, "reach=0"), 2);
    assert_int_equal(profile(LINE, "of=gas"), 2);
    assert_int_equal(profile("field=x,x,x,x,x,x,x,x,x", "from=0,0", "to=1,1"), 2);
    assert_int_equal(profile("field=stress_xz", "from=0,0", "to=1,1"), 1);
    assert_int_equal(profile("field=", "from=0,0", "to=1,1"), 1);
    assert_int_equal(profile(LINE, "of=fluid"), 1);
    assert_int_equal(run("nowhere.sph", (const char *const[]){LINE, NULL}), 1);
    FILE *f = fopen(out, "r"); /* nothing half-written */
    assert_null(f);
}

#define test(fn) cmocka_unit_test_setup_teardown(fn, make_names, remove_files)
int main(void)
{
    const struct CMUnitTest tests[] = {
        test(linear_fields_come_out_exactly),
        test(the_mean_is_exact_for_constants_alone),
        test(places_without_particles_are_left_out),
        test(a_row_of_particles_gets_the_mean),
        test(displacement_is_from_the_reference),
        test(an_ellipse_is_gone_round),
        test(the_body_is_not_mixed_with_what_is_beside_it),
        test(nothing_is_extrapolated),
        test(mirror_planes_are_seen),
        test(bad_input_is_refused),
    };
    return run_subjects("profile", tests);
}
