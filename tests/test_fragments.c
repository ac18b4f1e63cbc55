/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_fragments.c: pieces of synthetic dumps: cracks, thresholds, periodic domains, several bodies, any order of the
   arrays; a random cloud against all pairs. */
#include "testing.h"

#include "synthetic.h"
#include "tools/commands.h"
#include "tools/table.h"

static char dump[100], out[100], bins[100];

static int make_names(void **state)
{
    (void)state;
    temp_name(dump, sizeof dump, ".sph");
    temp_name(out, sizeof out, ".csv");
    temp_name(bins, sizeof bins, "_bins.csv");
    return 0;
}
static int remove_files(void **state)
{
    (void)state;
    remove(dump);
    remove(out);
    remove(bins);
    return 0;
}

/* `sph fragments` with options up to the first null */
static int run(const char *file, const char *a, const char *b, const char *c)
{
    char text[5][128], *argv[7] = {"fragments", NULL};
    const char *list[] = {file, a, b, c};
    int n = 1;
    for (int i = 0; i < 4 && list[i]; i++, n++) {
        snprintf(text[i], sizeof text[i], "%s", list[i]);
        argv[n] = text[i];
    }
    return cmd_fragments(n, argv);
}
static const char *to(const char *name, const char *file)
{
    static char text[2][128];
    static int turn;
    turn = !turn;
    snprintf(text[turn], sizeof text[turn], "%s=%s", name, file);
    return text[turn];
}

/* pieces of the dump as a table, or null after none */
static uint32_t pieces(table *t, const char *a, const char *b)
{
    assert_int_equal(run(dump, to("out", out), a, b), 0);
    FILE *f = fopen(out, "r");
    int lines = 0;
    assert_non_null(f);
    for (int c; (c = fgetc(f)) != EOF;)
        lines += c == '\n';
    fclose(f);
    if (lines <= 2)
        return 0;
    assert_true(table_open(t, out));
    return t->rows;
}
static double cell(const table *t, uint32_t row, const char *name)
{
    const int c = table_column(t, name, strlen(name));
    assert_true(c >= 0);
    return table_at(t, row, (uint32_t)c);
}
static uint32_t count(const char *a, const char *b)
{
    table t;
    const uint32_t n = pieces(&t, a, b);
    if (n)
        table_close(&t);
    return n;
}

static const double zero[3] = {0, 0, 0};

/* Gray's plate, 3 x 1, in cells of 0.05 */
static synth *plate(void)
{
    const double hi[3] = {3, 1, 0};
    synth *s = synth_new(2, 0.05, 4, 2, 0);
    synth_box(s, 0, zero, hi);
    return s;
}
static void break_column(synth *s, double x, double damage)
{
    for (uint32_t i = 0; i < s->n; i++)
        if (fabs(s->part[i].x[0] - x) < 1e-6)
            s->part[i].damage = damage;
}

static void an_unbroken_plate_is_one_piece(void **state)
{
    table t;
    synth *s = plate();
    (void)state;
    synth_write(s, dump);
    assert_int_equal(pieces(&t, NULL, NULL), 1);
    close_to(cell(&t, 0, "particles"), 1200, 0);
    close_to(cell(&t, 0, "mass_kg"), 3000, 1e-8);
    close_to(cell(&t, 0, "share"), 1, 1e-12);
    close_to(cell(&t, 0, "length_m"), 3, 1e-8);
    close_to(cell(&t, 0, "edge_y_m"), 1, 1e-8);
    close_to(cell(&t, 0, "diameter_m"), sqrt(4 * 3 / 3.14159265358979323846), 1e-8);
    close_to(cell(&t, 0, "x_m"), 1.5, 1e-8);
    close_to(cell(&t, 0, "y_m"), 0.5, 1e-8);
    table_close(&t);
    s->with_damage = false;
    synth_write(s, dump);
    assert_int_equal(count(NULL, NULL), 1);
}

static void a_crack_makes_two(void **state)
{
    table t;
    synth *s = plate();
    (void)state;
    break_column(s, 1.025, 1);
    synth_write(s, dump);
    assert_int_equal(pieces(&t, NULL, NULL), 2);
    close_to(cell(&t, 0, "mass_kg"), 1950, 1e-8); /* the larger one first */
    close_to(cell(&t, 0, "length_m"), 1.95, 1e-8);
    close_to(cell(&t, 1, "mass_kg"), 1000, 1e-8);
    close_to(cell(&t, 1, "first_id"), 0, 0);
    table_close(&t);
    assert_int_equal(count("link=2.1", NULL), 1);
    assert_int_equal(count("least=500", NULL), 1);
    assert_int_equal(count("least=5000", NULL), 0);
}

/* what is stored is D^(1/2) in two dimensions */
static void water_and_its_drops_are_counted(void **state)
{
    table t;
    const double drop[2][2][3] = {{{2, 2, 0}, {2.1, 2.1, 0}}, {{2.3, 0.5, 0}, {2.35, 0.55, 0}}}, hi[3] = {1, 1, 0};
    synth *s = synth_new(2, 0.05, 4, 2, 0);
    (void)state;
    synth_box(s, 0, zero, hi);
    synth_box(s, 0, drop[0][0], drop[0][1]);
    synth_box(s, 0, drop[1][0], drop[1][1]);
    for (uint32_t i = 0; i < s->n; i++)
        s->part[i].damage = 1; /* fluids have none */
    s->set[0].role = 0;
    synth_write(s, dump);
    assert_int_equal(run(dump, NULL, NULL, NULL), 1); /* nothing solid */
    assert_int_equal(pieces(&t, "of=fluid", NULL), 3);
    close_to(cell(&t, 0, "particles"), 400, 0);
    close_to(cell(&t, 1, "particles"), 4, 0);
    close_to(cell(&t, 2, "particles"), 1, 0);
    table_close(&t);
    assert_int_equal(count("of=fluid", "least=2"), 2);
    assert_int_equal(run(dump, "of=water", NULL, NULL), 2);
    s->set[0].role = 3;
    synth_write(s, dump);
    assert_int_equal(run(dump, "of=fluid", NULL, NULL), 1);
}

static void the_threshold_is_of_damage_itself(void **state)
{
    synth *s = plate();
    (void)state;
    break_column(s, 1.025, sqrt(0.49));
    synth_write(s, dump);
    assert_int_equal(count(NULL, NULL), 1);
    assert_int_equal(count("damage=0.48", NULL), 2);
    break_column(s, 1.025, sqrt(0.51));
    synth_write(s, dump);
    assert_int_equal(count(NULL, NULL), 2);
    assert_int_equal(count("damage=0.52", NULL), 1);
}

static void diagonal_neighbours_are_linked(void **state)
{
    synth *s = plate();
    (void)state;
    for (uint32_t i = 0; i < s->n; i++) /* one particle wide, along the diagonal from x = 1 */
        if (fabs(s->part[i].x[0] - 1 - s->part[i].x[1]) < 1e-6)
            s->part[i].damage = 1;
    synth_write(s, dump);
    assert_int_equal(count(NULL, NULL), 1);
    assert_int_equal(count("link=1.2", NULL), 2);
}

static void the_order_of_the_arrays_does_not_matter(void **state)
{
    synth *s = plate();
    size_t n;
    (void)state;
    break_column(s, 1.025, 1);
    break_column(s, 2.025, 1);
    synth_write(s, dump);
    assert_int_equal(run(dump, to("out", out), NULL, NULL), 0);
    FILE *f = fopen(out, "rb");
    static char first[4000], second[4000];
    assert_non_null(f);
    n = fread(first, 1, sizeof first, f);
    fclose(f);
    sph_rng rng;
    sph_rng_seed(&rng, 7, 7);
    for (uint32_t i = s->n - 1; i > 0; i--) {
        const uint32_t j = (uint32_t)(sph_rng_uniform(&rng) * (i + 1));
        const __typeof__(s->part[0]) swap = s->part[i];
        s->part[i] = s->part[j];
        s->part[j] = swap;
    }
    synth_write(s, dump);
    assert_int_equal(run(dump, to("out", out), NULL, NULL), 0);
    f = fopen(out, "rb");
    assert_non_null(f);
    assert_int_equal(fread(second, 1, sizeof second, f), n);
    fclose(f);
    assert_memory_equal(first, second, n);
}

static void a_piece_goes_round_a_periodic_domain(void **state)
{
    const double lo[2][3] = {{0, 0, 0}, {3.2, 0, 0}}, hi[2][3] = {{0.5, 1, 0}, {4, 1, 0}};
    table t;
    synth *s = synth_new(2, 0.05, 4, 2, 0);
    (void)state;
    for (int i = 0; i < 2; i++)
        synth_box(s, 0, lo[i], hi[i]);
    synth_write(s, dump);
    assert_int_equal(count(NULL, NULL), 2);
    s->face[0] = s->face[1] = SPH_PERIODIC;
    synth_write(s, dump);
    assert_int_equal(pieces(&t, NULL, NULL), 1);
    close_to(cell(&t, 0, "length_m"), 1.3, 1e-8);
    close_to(cell(&t, 0, "mass_kg"), 1300, 1e-8);
    table_close(&t);
}

static void bodies_in_contact_stay_two(void **state)
{
    const double lo[3] = {1, 0, 0}, mid[3] = {1, 1, 0}, hi[3] = {2, 1, 0};
    synth *s = synth_new(2, 0.1, 4, 2, 0);
    (void)state;
    synth_box(s, 0, zero, mid);
    synth_box(s, 1, lo, hi);
    synth_box(s, 2, lo, hi); /* walls do not count */
    synth_write(s, dump);
    assert_int_equal(count(NULL, NULL), 2);
    assert_int_equal(count("across=yes", NULL), 1);
    s->set[1].body = 0; /* a held end of the same body */
    synth_write(s, dump);
    assert_int_equal(count(NULL, NULL), 1);
}

static void bars_and_blocks(void **state)
{
    const double bar[3] = {2, 0, 0}, block[3] = {1, 0.5, 0.5};
    table t;
    synth *s = synth_new(1, 0.01, 3, 0, 0);
    (void)state;
    synth_box(s, 0, zero, bar);
    s->part[50].damage = s->part[120].damage = 0.6; /* D itself in 1-D */
    synth_write(s, dump);
    assert_int_equal(pieces(&t, NULL, NULL), 3);
    close_to(cell(&t, 0, "length_m"), 0.79, 1e-8);
    close_to(cell(&t, 0, "diameter_m"), 0.79, 1e-8);
    table_close(&t);
    s = synth_new(3, 0.05, 3, 1, 1);
    synth_box(s, 0, zero, block);
    break_column(s, 0.325, 0.9);
    synth_write(s, dump);
    assert_int_equal(pieces(&t, NULL, NULL), 2);
    close_to(cell(&t, 0, "mass_kg"), 1000 * 0.65 * 0.25, 1e-8);
    close_to(cell(&t, 0, "diameter_m"), 2 * cbrt(0.65 * 0.25 * 0.75 / 3.14159265358979323846), 1e-8);
    close_to(cell(&t, 1, "edge_z_m"), 0.5, 1e-8);
    table_close(&t);
}

/* labels by all pairs until nothing changes */
static void a_random_cloud_as_by_all_pairs(void **state)
{
    static uint32_t label[SYNTH_MOST];
    sph_rng rng;
    (void)state;
    sph_rng_seed(&rng, 3, 3);
    for (uint32_t dim = 1; dim <= 3; dim++) {
        synth *s = synth_new(dim, dim == 1 ? 0.002 : dim == 2 ? 0.03 : 0.05, 1, 1, 1);
        s->n = 700;
        s->face[2] = s->face[3] = dim > 1 ? SPH_PERIODIC : SPH_OPEN;
        for (uint32_t i = 0; i < s->n; i++) {
            for (uint32_t k = 0; k < dim; k++)
                s->part[i].x[k] = sph_rng_uniform(&rng);
            s->part[i].damage = sph_rng_uniform(&rng);
            s->part[i].id = 10000 - i;
            label[i] = i;
        }
        synth_write(s, dump);
        bool again = true;
        while (again) {
            again = false;
            for (uint32_t i = 0; i < s->n; i++)
                for (uint32_t j = 0; j < s->n; j++) {
                    double r2 = 0;
                    for (uint32_t k = 0; k < dim; k++) {
                        double d = s->part[i].x[k] - s->part[j].x[k];
                        d -= k == 1 && dim > 1 ? floor(d + 0.5) : 0;
                        r2 += d * d;
                    }
                    if (label[j] < label[i] && r2 <= pow(1.5 * s->spacing, 2) && pow(s->part[i].damage, dim) < 0.5 &&
                        pow(s->part[j].damage, dim) < 0.5) {
                        label[i] = label[j];
                        again = true;
                    }
                }
        }
        uint32_t wanted = 0;
        for (uint32_t i = 0; i < s->n; i++)
            wanted += label[i] == i && pow(s->part[i].damage, dim) < 0.5;
        assert_true(wanted > 20);
        assert_int_equal(count(NULL, NULL), wanted);
        print_message("fragments: %u pieces of a random cloud in %u-D, as by all pairs\n", wanted, dim);
    }
}

static void the_histogram_holds_all_the_mass(void **state)
{
    table t;
    synth *s = plate();
    double mass = 0, expected = 0, number = 0, high = 0;
    (void)state;
    break_column(s, 1.025, 1);
    break_column(s, 2.025, 1);
    synth_write(s, dump);
    char *argv[] = {"fragments", dump, NULL, "bins=7", "k=1.4e19", "m=8.5", "c=0.4", "rate=6.66e-4", NULL};
    char text[128];
    snprintf(text, sizeof text, "histogram=%s", bins);
    argv[2] = text;
    assert_int_equal(cmd_fragments(8, argv), 0);
    assert_true(table_open(&t, bins));
    assert_int_equal(t.rows, 7);
    for (uint32_t i = 0; i < t.rows; i++) {
        const double width = cell(&t, i, "to_m") - cell(&t, i, "from_m");
        mass += cell(&t, i, "share_of_mass");
        close_to(cell(&t, i, "density_per_m") * width, cell(&t, i, "share_of_mass"), 1e-9);
        number += cell(&t, i, "pieces");
        expected += cell(&t, i, "gradykipp_per_m") * width;
        high = cell(&t, i, "to_m");
    }
    close_to(mass, 1, 1e-9);
    close_to(number, 3, 0);
    close_to(high, 1, 1e-6);
    assert_true(expected > 0.05 && expected < 0.5); /* pieces up to 1 m of a mean of 1.8 */
    table_close(&t);
}

static void bad_input_is_refused(void **state)
{
    const double hi[3] = {1, 1, 0};
    synth *s = plate();
    (void)state;
    synth_write(s, dump);
    static const char *const bad[] = {"damage=0", "damage=x", "link=0.1", "link=101", "across=maybe", "least=0",
                                      "bins=0",
                                      "by=mass",  "k=1e10",   "rate=1",   "crack=1"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(run(dump, bad[i], NULL, NULL), 2);
    assert_int_equal(run("damage=0.5", NULL, NULL, NULL), 2);
    assert_int_equal(run(dump, dump, "out=x.csv", NULL), 2);
    assert_int_equal(run("nowhere.sph", NULL, NULL, NULL), 1);
    assert_int_equal(run(dump, "out=nowhere/at/all.csv", NULL, NULL), 1);
    s->face[0] = s->face[1] = SPH_PERIODIC;
    synth_write(s, dump);
    assert_int_equal(run(dump, "link=60", NULL, NULL), 1); /* over half a period */
    s = synth_new(2, 0.1, 4, 2, 0);
    synth_box(s, 2, zero, hi);
    synth_write(s, dump);
    assert_int_equal(run(dump, NULL, NULL, NULL), 1); /* no solid */
}

#define test(fn) cmocka_unit_test_setup_teardown(fn, make_names, remove_files)
int main(void)
{
    const struct CMUnitTest tests[] = {
        test(an_unbroken_plate_is_one_piece),
        test(a_crack_makes_two),
        test(water_and_its_drops_are_counted),
        test(the_threshold_is_of_damage_itself),
        test(diagonal_neighbours_are_linked),
        test(the_order_of_the_arrays_does_not_matter),
        test(a_piece_goes_round_a_periodic_domain),
        test(bodies_in_contact_stay_two),
        test(bars_and_blocks),
        test(a_random_cloud_as_by_all_pairs),
        test(the_histogram_holds_all_the_mass),
        test(bad_input_is_refused),
    };
    return run_subjects("fragments", tests);
}
