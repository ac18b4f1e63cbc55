/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_options.c: an option that is a line in the list of options and nothing else (extra_options.h, which this program
   and its kernel were compiled with) has a default, is checked, is part of the digest or goes with a dump, and is a
   parameter of every scene. And the check of a configuration and sph_init agree on every domain. */
#include "testing.h"

#include "examples/scenes/scene.h"
#include "sph/internal.h"

static sph_config small(void)
{
    sph_config c = sph_config_default();
    c.max_particles = 10;
    c.spacing = 0.1;
    c.smoothing_length = 0.12;
    c.sound_speed = 10;
    for (int k = 0; k < SPH_DIM; k++)
        c.hi[k] = 1;
    return c;
}

static void refused(const sph_config *c, const char *what, const char *allowed, double value)
{
    sph_report r = {SPH_OK, "", "", "", 0, 0, 0, 0};
    assert_int_equal(sph_config_check(c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, what);
    assert_string_equal(r.allowed, allowed);
    assert_true(!(r.value < value || r.value > value));
}

static void an_extra_option_has_its_default(void **state)
{
    const sph_config c = small();
    (void)state;
    assert_true(c.extra_factor == 0.75 && !c.extra_switch && c.extra_choice == 1);
    for (int k = 0; k < SPH_DIM; k++)
        assert_true(c.extra_wind[k] == 2);
    assert_int_equal(sph_config_check(&c, NULL), SPH_OK);
}

static void an_extra_option_is_refused_by_name_and_bounds(void **state)
{
    static const char left_out[] = "a choice that was compiled in (modules.h)";
    static const double wrong[] = {0.49, 4.01, -1, 1e300};
    sph_config c = small();
    (void)state;
    for (int i = 0; i < 4; i++) {
        c.extra_factor = wrong[i];
        refused(&c, "extra_factor", "0.5 .. 4", wrong[i]);
    }
    c.extra_factor = NAN;
    assert_int_equal(sph_config_check(&c, NULL), SPH_BAD_CONFIG);
    c = small();
    c.extra_factor = 4;
    assert_int_equal(sph_config_check(&c, NULL), SPH_OK);
    c.extra_choice = 3;
    refused(&c, "extra_choice", "0 .. 2", 3);
    c.extra_choice = 0;
    refused(&c, "extra_choice", left_out, 0);
    c = small();
    c.extra_switch = true;
    refused(&c, "extra_switch", left_out, 1);
    c = small();
    c.extra_wind[SPH_DIM - 1] = -10;
    refused(&c, "extra_wind", "-9 .. 9", -10);
}

/* a dump in memory */
static unsigned char bytes[1 << 16];
static size_t written, at;
static bool sink(void *ctx, const void *b, size_t n)
{
    (void)ctx;
    if (written + n > sizeof bytes)
        return false;
    memcpy(bytes + written, b, n);
    written += n;
    return true;
}
static bool source(void *ctx, void *b, size_t n)
{
    (void)ctx;
    if (at + n > written)
        return false;
    memcpy(b, bytes + at, n);
    at += n;
    return true;
}
static sph_status go(const sph_config *to, sph_sim **sim)
{
    *sim = new_sim(to);
    at = 0;
    return sph_restore(*sim, source, NULL);
}

static void an_extra_option_is_part_of_the_digest(void **state)
{
    const sph_config good = small();
    sph_config c = good;
    sph_sim *sim = new_sim(&c), *other;
    (void)state;
    written = 0;
    assert_int_equal(sph_dump(sim, SPH_DUMP_FULL, sink, NULL), SPH_OK);
    assert_int_equal(go(&good, &other), SPH_OK);
    c.extra_factor = 0.76;
    assert_int_equal(go(&c, &other), SPH_DUMP_MISMATCH);
    assert_string_equal(sph_last(other)->what, "setup");
    assert_int_equal(sph_reconfigure(sim, &c), SPH_BAD_CONFIG);
    c = good;
    c.extra_choice = 2;
    assert_int_equal(go(&c, &other), SPH_DUMP_MISMATCH);
    assert_int_equal(sph_reconfigure(sim, &c), SPH_BAD_CONFIG);
    assert_int_equal(sph_reconfigure(sim, &good), SPH_OK);
}

static void an_extra_option_that_may_change_goes_with_a_dump(void **state)
{
    const sph_config good = small();
    sph_config c = good;
    sph_sim *sim = new_sim(&good), *other;
    (void)state;
    c.extra_wind[0] = -3.5;
    assert_int_equal(sph_reconfigure(sim, &c), SPH_OK);
    assert_true(sim->cfg.extra_wind[0] == -3.5);
    written = 0;
    assert_int_equal(sph_dump(sim, SPH_DUMP_FULL, sink, NULL), SPH_OK);
    assert_int_equal(go(&good, &other), SPH_OK);
    assert_true(other->cfg.extra_wind[0] == -3.5 && other->cfg.damping == 1);
    sim->cfg.extra_wind[0] = 100; /* as only a forged dump can have it */
    written = 0;
    assert_int_equal(sph_dump(sim, SPH_DUMP_FULL, sink, NULL), SPH_OK);
    assert_int_equal(go(&good, &other), SPH_DUMP_CORRUPT);
    assert_string_equal(sph_last(other)->what, "extra_wind");
    assert_string_equal(sph_last(other)->allowed, "-9 .. 9");
    assert_true(other->cfg.extra_wind[0] == 2);
}

static void an_extra_option_is_a_parameter_of_every_scene(void **state)
{
    (void)state;
    for (uint32_t i = 0; scene_table[i]; i++) {
        const scene *s = scene_table[i];
        double p[128];
        int factor = -1, colour = -1;
        sph_config c;
        for (uint32_t k = 0; k < s->params; k++) {
            p[k] = s->param[k].value;
            factor = strcmp(s->param[k].name, "extra") ? factor : (int)k;
            colour = strcmp(s->param[k].name, "colour") ? colour : (int)k;
        }
        assert_true(factor >= 0 && factor < SCENE_COMMON && colour >= 0 && colour < SCENE_COMMON);
        const scene_param *f = &s->param[factor], *o = &s->param[colour];
        assert_true(f->value == 0.75 && f->min == 0.5 && f->max == 2 && f->kind == SCENE_NUMBER);
        assert_string_equal(f->unit, "1/s");
        assert_string_equal(f->what, "a factor that nothing reads");
        assert_true(o->value == 1 && o->max == 2 && o->kind == SCENE_CHOICE);
        assert_string_equal(o->what, "one of three: red green blue");
        p[factor] = 1.5;
        p[colour] = 2;
        s->configure(p, &c);
        assert_true(c.extra_factor == 1.5 && c.extra_choice == 2);
        assert_int_equal(sph_config_check(&c, NULL), SPH_OK);
    }
}

/* what a scene's parameters are called and may be, of the options that are parameters: what the tool's users rely on */
static void parameters_of_choices_name_all_their_values(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < SCENE_COMMON; k++) {
        const scene_param *p = &scene_table[0]->param[k];
        const char *names = strchr(p->what, ':');
        assert_true(p->min <= p->value && p->value <= p->max);
        if (p->kind != SCENE_CHOICE)
            continue;
        assert_non_null(names);
        uint32_t words = 0;
        for (; *names; names++)
            words += *names == ' ';
        assert_true(words == (uint32_t)p->max + 1);
    }
}

/* whatever the check says, init says too, and in the same words (found from outside: a periodic axis of exactly three
   supports, and a domain of 1e6 m at a spacing of 0.01) */
static void the_check_and_init_agree(void **state)
{
    static const double length[] = {0.1, 0.2, 0.719, 0.72, 0.7200001, 0.73, 1, 1e3, 1e5, 1e6, 1e7, 1e12};
    (void)state;
    for (uint32_t i = 0; i < sizeof length / sizeof *length; i++)
        for (uint32_t face = SPH_OPEN; face <= SPH_SYMMETRY; face++) {
            sph_config c = small();
            sph_report said = {SPH_OK, "", "", "", 0, 0, 0, 0}, done = said;
            sph_sim *sim = NULL;
            c.hi[0] = length[i];
            c.face[0][0] = c.face[0][1] = face;
            const sph_status st = sph_config_check(&c, &said);
            assert_int_equal(sph_init(&sim, &c, NULL, 0, &done), st ? SPH_BAD_CONFIG : SPH_ARENA_TOO_SMALL);
            assert_int_equal(sph_arena_bytes(&c) == 0, st != SPH_OK);
            if (st) {
                assert_string_equal(said.what, done.what);
                assert_string_equal(said.allowed, done.allowed);
                assert_true(said.value == done.value);
            }
        }
    sph_config c = small();
    sph_report r;
    c.face[0][0] = c.face[0][1] = SPH_PERIODIC;
    c.hi[0] = 3 * 2 * c.smoothing_length;
    refused(&c, "hi", "more than three supports from lo along a periodic axis", c.hi[0]);
    c = small();
    c.spacing = 0.01;
    c.smoothing_length = 0.012;
    c.hi[0] = 1e6;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "hi");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(an_extra_option_has_its_default, free_sims),
        cmocka_unit_test_teardown(an_extra_option_is_refused_by_name_and_bounds, free_sims),
        cmocka_unit_test_teardown(an_extra_option_is_part_of_the_digest, free_sims),
        cmocka_unit_test_teardown(an_extra_option_that_may_change_goes_with_a_dump, free_sims),
        cmocka_unit_test_teardown(an_extra_option_is_a_parameter_of_every_scene, free_sims),
        cmocka_unit_test_teardown(parameters_of_choices_name_all_their_values, free_sims),
        cmocka_unit_test_teardown(the_check_and_init_agree, free_sims),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
