/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_validate.c: what SPH_VALIDATE asks (sph/validate.c) is true of a sorted stage and false as soon as one thing in
   it is wrong: a check that is always true would find nothing. */
#include "testing.h"

#include "sph/sweep.h"
#include "state.h"

#define DX 0.25

static sph_sim *looked_at;
static uint32_t looks;

/* false with a value replaced, true again with it put back */
#define wrong_with(place, value)                                                                            \
    do {                                                                                                    \
        const __typeof__(place) kept_ = (place);                                                            \
        (place) = (value);                                                                                  \
        if (sph_is_sorted(sim))                                                                             \
            fail_msg("%s = %s is not seen", #place, #value);                                                \
        (place) = kept_;                                                                                    \
        assert_true(sph_is_sorted(sim));                                                                    \
    } while (0)

static void look(void *ctx, uint64_t step, const char *stage, uint64_t hash)
{
    sph_sim *sim = looked_at;
    (void)ctx, (void)step, (void)hash;
    if (strcmp(stage, "scatter") != 0 || looks++ > 3)
        return;
    sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t n = sim->next.count, last = n - 1;
    assert_true(n > 8 && sph_is_sorted(sim));
    uint32_t *const from = b->id[0];
    for (uint32_t i = 0; i < n; i += 3) { /* twice there, and not there at all */
        const uint32_t other = from[(i + 1) % n], none = sim->src_count;
        wrong_with(from[i], other);
        wrong_with(from[i], none);
    }
    for (uint32_t k = 0; k < SPH_DIM; k++) { /* outside, and in another cell */
        const sph_pos out = sim->grid.extent[k];
        wrong_with(b->pos[k][0], -1);
        wrong_with(b->pos[k][last], out);
        wrong_with(b->pos[k][last], 0);
        wrong_with(b->pos[k][0], out - 1);
    }
    wrong_with(sim->cell[0], 1);
    wrong_with(sim->cell[sim->grid.cells], last);
    for (uint32_t i = 0; i < last; i++) { /* two of one cell the wrong way round */
        const uint32_t a = from[i], c = from[i + 1];
        sph_pos p[2][SPH_DIM];
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            p[0][k] = b->pos[k][i];
            p[1][k] = b->pos[k][i + 1];
        }
        if (sph_cell_of(sim, p[0]) != sph_cell_of(sim, p[1]))
            continue;
        from[i] = c;
        from[i + 1] = a;
        assert_false(sph_is_sorted(sim));
        from[i] = a;
        from[i + 1] = c;
    }
    assert_true(sph_is_sorted(sim));
}

/* many to a cell, with a velocity, so that later stages are sorted from another order */
static void one_wrong_thing_in_a_sorted_stage_is_seen(void **state)
{
    sph_config c = open_config(1, DX);
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], v[SPH_DIM] = {2};
    uint32_t set;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 1.5;
    c.max_particles = 400;
    c.stage_log = look;
    sph_sim *sim = looked_at = new_sim(&c);
    looks = 0;
    must(sim, sph_add_fluid(sim, NULL, &set));
    if (SPH_DIM == 1)
        for (int i = 0; i < 40; i++) {
            const double x[SPH_DIM] = {0.02 * i};
            must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        }
    else
        must(sim, sph_add_box(sim, set, lo, hi, v));
    for (int k = 0; k < 3; k++)
        must(sim, sph_step(sim));
    assert_true(looks > 2);
}

static void one_wrong_candidate_of_a_tile_is_seen(void **state)
{
    static sph_tile t;
    (void)state;
    for (uint32_t n = 0; n <= SPH_TILE; n += 8) {
        memset(&t, 0, sizeof t);
        t.n = n;
        for (uint32_t j = 0; j < SPH_TILE_ROOM; j++)
            t.m[j] = j < n ? 1 : (sph_real)NAN; /* behind the last one anything may stand */
        assert_true(sph_is_tile_sound(&t));
        for (uint32_t j = 0; j < n; j += n - 1) {
            t.m[j] = 0;
            assert_false(sph_is_tile_sound(&t));
            t.m[j] = -1;
            assert_false(sph_is_tile_sound(&t));
            t.m[j] = (sph_real)INFINITY;
            assert_false(sph_is_tile_sound(&t));
            t.m[j] = 1;
            for (int k = 0; k < SPH_DIM; k++) {
                t.x[k][j] = (sph_real)NAN;
                assert_false(sph_is_tile_sound(&t));
                t.x[k][j] = (sph_real)-INFINITY;
                assert_false(sph_is_tile_sound(&t));
                t.x[k][j] = -3;
            }
            assert_true(sph_is_tile_sound(&t));
        }
    }
    for (uint32_t j = 0; j < SPH_TILE_ROOM; j++)
        t.m[j] = 1;
    t.n = SPH_TILE + 1;
    assert_false(sph_is_tile_sound(&t));
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(one_wrong_thing_in_a_sorted_stage_is_seen),
        subject(one_wrong_candidate_of_a_tile_is_seen),
    };
    return run_subjects("validate", list);
}
