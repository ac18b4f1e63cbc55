/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_scenes.c: every scene of this dimension builds and runs some steps with its default parameters, and its history
   is finite; every choice of a scene's parameters stays inside what it declares. */
#include "testing.h"

#include "examples/scenes/scene.h"

static void every_scene_runs(void **state)
{
    uint32_t n = 0;
    (void)state;
    for (; scene_table[n]; n++) {
        const scene *s = scene_table[n];
        double *p = calloc(s->params + 1, sizeof *p), row[64];
        sph_config c;
        for (uint32_t k = 0; k < s->params; k++) {
            p[k] = s->param[k].value;
            assert_true(p[k] >= s->param[k].min && p[k] <= s->param[k].max);
            assert_true(s->param[k].name[0] && s->param[k].what[0]);
        }
        assert_true(s->columns >= 1 && s->columns <= 64);
        s->configure(p, &c);
        sph_sim *sim = new_sim(&c);
        must(sim, s->build(sim, p));
        const uint32_t fluid = sph_count(sim);
        assert_true(fluid > 0 && fluid <= c.max_particles);
        for (int k = 0; k < 10; k++)
            must(sim, sph_step(sim));
        assert_true(s->end(p) > sph_time(sim));
        s->history(sim, p, row);
        for (uint32_t k = 0; k < s->columns; k++)
            if (!(row[k] - row[k] == 0))
                fail_msg("%s: column %s is not finite", s->name, s->column[k]);
        sph_totals t;
        sph_get_totals(sim, &t);
        assert_true(t.fluid + t.solid > 0 && t.max_speed < c.sound_speed);
        free(p);
        assert_int_equal(free_sims(NULL), 0);
    }
    assert_true(n >= 1);
}

int main(void)
{
    const struct CMUnitTest list[] = {subject(every_scene_runs)};
    return run_subjects("scenes", list);
}
