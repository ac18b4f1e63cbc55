/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_fields.c: fields of solids in dumps against values by hand, what a dump must carry for them, export and pictures
   of them, and the colours of signed fields. */
#include "testing.h"

#include "synthetic.h"
#include "tools/commands.h"
#include "tools/dumpfile.h"
#include "tools/image.h"
#include "tools/table.h"

static char dump[100], out[100], png[100];

static int make_names(void **state)
{
    (void)state;
    temp_name(dump, sizeof dump, ".sph");
    temp_name(out, sizeof out, ".csv");
    temp_name(png, sizeof png, ".png");
    return 0;
}
static int remove_files(void **state)
{
    (void)state;
    remove(dump);
    remove(out);
    remove(png);
    return 0;
}

/* one particle of each set: an intact solid, a damaged one, a wall */
static synth *three(uint32_t dim)
{
    synth *s = synth_new(dim, 0.1, 1, 1, 1);
    for (uint32_t i = 0; i < 3; i++) {
        for (uint32_t k = 0; k < dim; k++)
            s->part[i].x[k] = 0.1 + 0.3 * i;
        for (int k = 0; k < 5; k++)
            s->part[i].stress[k] = 100 + 50 * k;
        s->part[i].id = i;
        s->part[i].set = (uint8_t)i;
        s->part[i].rho = i == 1 ? -0.01 : 0.02; /* the damaged one in tension */
        s->part[i].damage = i == 1 ? 0.5 : 0;
        s->part[i].plastic = 0.25 * i;
    }
    s->n = 3;
    return s;
}

static void expect(const char *field, double a, double b)
{
    double v[3];
    const char *unit;
    dump_file d;
    assert_true(dump_open(&d, dump));
    assert_true(dump_has_field(&d, field));
    assert_true(dump_field(&d, field, v, &unit));
    close_to(v[0], a, 1e-9);
    close_to(v[1], b, 1e-9);
    dump_close(&d);
}

/* pressures of rho0 c0^2 = 1e5: 2000 and -1000; deviator 100, 150, 200 (xx, yy, xy): zz = -250 */
static void in_the_plane(void **state)
{
    (void)state;
    synth_write(three(2), dump);
    expect("pressure", 2000, -1000);
    expect("damage", 0, 0.25);
    expect("plastic", 0, 0.25);
    expect("stress_xx", 100 - 2000, 0.75 * (100 + 1000));
    expect("stress_yy", 150 - 2000, 0.75 * (150 + 1000));
    expect("stress_zz", -250 - 2000, 0.75 * (-250 + 1000));
    expect("stress_xy", 200, 0.75 * 200);
    expect("mean_stress", -2000, 750);
    expect("stress_sum", 250 - 4000, 0.75 * (250 + 2000));
    const double mises = sqrt(1.5 * (100 * 100 + 150 * 150 + 250 * 250) + 3 * 200 * 200);
    expect("von_mises", mises, 0.75 * mises);
}

static void along_a_bar_and_in_space(void **state)
{
    (void)state;
    synth_write(three(1), dump);
    expect("damage", 0, 0.5);
    expect("stress_xx", 100 - 2000, 0.5 * 1100);
    expect("von_mises", 150, 75); /* uniaxial strain: S_yy = S_zz = -50 */
    synth_write(three(3), dump);
    expect("damage", 0, 0.125);
    expect("stress_xz", 250, 0.875 * 250);
    expect("stress_yz", 300, 0.875 * 300);
    expect("stress_zz", -250 - 2000, 0.875 * (-250 + 1000));
    expect("stress_sum", -6000, 0.875 * 3000);
    const double off = 200 * 200 + 250 * 250 + 300 * 300;
    const double mises = sqrt(1.5 * (100 * 100 + 150 * 150 + 250 * 250) + 3 * off);
    expect("von_mises", mises, 0.875 * mises);
}

static int command(int (*fn)(int, char **), const char *a, const char *b, const char *c)
{
    char text[3][160], *argv[] = {"command", text[0], text[1], text[2], NULL};
    snprintf(text[0], sizeof text[0], "%s", a);
    snprintf(text[1], sizeof text[1], "%s", b);
    snprintf(text[2], sizeof text[2], "%s", c);
    return fn(4, argv);
}

static void a_dump_without_them_says_so(void **state)
{
    char to[120], from[120];
    synth *s = three(2);
    (void)state;
    snprintf(to, sizeof to, "out=%s", png);
    snprintf(from, sizeof from, "out=%s", out);
    synth_write(s, dump);
    assert_int_equal(command(cmd_render, dump, "field=von_mises", to), 0);
    assert_int_equal(command(cmd_render, dump, "field=stress_xz", to), 1);
    assert_int_equal(command(cmd_render, dump, "palette=rainbow", to), 2);
    assert_int_equal(remove(png), 0);
    s->with_stress = s->with_damage = s->with_plastic = false;
    synth_write(s, dump);
    static const char *const fields[] = {"field=von_mises", "field=mean_stress", "field=damage", "field=plastic"};
    for (int i = 0; i < 4; i++)
        assert_int_equal(command(cmd_render, dump, fields[i], to), 1);
    assert_int_not_equal(remove(png), 0); /* nothing was written */
    table t;
    assert_int_equal(command(cmd_export, dump, from, "walls=no"), 0);
    assert_true(table_open(&t, out));
    assert_int_equal(t.rows, 2);
    assert_true(table_column(&t, "damage", 6) < 0);
    table_close(&t);
}

static void export_carries_them(void **state)
{
    char to[120];
    table t;
    (void)state;
    snprintf(to, sizeof to, "out=%s", out);
    synth_write(three(2), dump);
    assert_int_equal(command(cmd_export, dump, to, "walls=yes"), 0);
    assert_true(table_open(&t, out));
    assert_int_equal(t.rows, 3);
    static const char *const names[] = {"stress_xx_Pa", "stress_zz_Pa", "stress_xy_Pa", "mean_stress_Pa",
                                        "von_mises_Pa",
                                        "plastic", "damage"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        assert_true(table_column(&t, names[i], strlen(names[i])) >= 0);
    close_to(table_at(&t, 1, (uint32_t)table_column(&t, "damage", 6)), 0.25, 1e-15);
    table_close(&t);
}

static void shapes_are_checked(void **state)
{
    dump_file d;
    (void)state;
    for (uint32_t dim = 1; dim <= 3; dim++) {
        synth *s = three(dim);
        synth_write(s, dump);
        assert_true(dump_open(&d, dump));
        dump_close(&d);
        s->wrong_shape = dim != 2;
        synth_write(s, dump);
        assert_int_equal(dump_open(&d, dump), dim == 2);
        if (dim == 2)
            dump_close(&d);
    }
}

static double light(colour c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

static void signed_colours_are_grey_at_nought(void **state)
{
    const colour mid = image_map_signed(0.5);
    (void)state;
    assert_true(abs(mid.r - mid.g) <= 1 && abs(mid.g - mid.b) <= 1);
    for (int i = 0; i < 50; i++) {
        assert_true(light(image_map_signed(0.01 * i)) < light(image_map_signed(0.01 * (i + 1))));
        assert_true(light(image_map_signed(1 - 0.01 * i)) < light(image_map_signed(1 - 0.01 * (i + 1))));
    }
    assert_true(image_map_signed(0).b > image_map_signed(0).r + 50);
    assert_true(image_map_signed(1).r > image_map_signed(1).b + 50);
}

#define test(fn) cmocka_unit_test_setup_teardown(fn, make_names, remove_files)
int main(void)
{
    const struct CMUnitTest tests[] = {
        test(in_the_plane),
        test(along_a_bar_and_in_space),
        test(a_dump_without_them_says_so),
        test(export_carries_them),
        test(shapes_are_checked),
        test(signed_colours_are_grey_at_nought),
    };
    return run_subjects("fields", tests);
}
