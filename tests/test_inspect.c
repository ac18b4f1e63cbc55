/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_inspect.c: what looks wrong in a filled simulation is found and named; a sound one has no findings, and looking
   changes nothing. What holds no particle, and what has no effect, is refused. */
#include "testing.h"

#define DX 0.1
#define N 6
#define EDGE (N * DX)

static sph_finding found[SPH_FINDINGS];
static void take(void *ctx, const sph_finding *f)
{
    (void)ctx;
    found[f->kind] = *f;
}
static void inspect(sph_sim *sim)
{
    memset(found, 0, sizeof found);
    const uint64_t before = sph_hash(sim);
    must(sim, sph_inspect(sim, take, NULL));
    assert_true(sph_hash(sim) == before);
}
static void only(uint32_t kind, uint32_t count)
{
    for (uint32_t k = 0; k < SPH_FINDINGS; k++)
        if (found[k].count != (k == kind ? count : 0))
            fail_msg("%u of kind %u, wanted %u: %s", found[k].count, k, k == kind ? count : 0,
                     found[k].count ? found[k].text : "");
}

/* water in a tank with walls on all sides but the top */
static sph_sim *tank(double sound, uint32_t max, uint32_t *set)
{
    sph_config c = open_config(EDGE, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t faces = 0;
    c.sound_speed = sound;
    c.max_particles = max;
    c.gravity[SPH_DIM - 1] = -9.81;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        lo[k] = 0;
        hi[k] = EDGE;
        faces |= SPH_LOW(k) | (k + 1 < SPH_DIM ? SPH_HIGH(k) : 0);
    }
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, set));
    must(sim, sph_add_box(sim, *set, lo, hi, NULL));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, faces, true, NULL));
    return sim;
}
static uint32_t most_of(void)
{
    uint32_t n = 1, all = 1;
    for (int k = 0; k < SPH_DIM; k++) {
        n *= N;
        all *= N + 6;
    }
    return n + all;
}

static void a_sound_scene_has_no_findings(void **state)
{
    uint32_t set;
    (void)state;
    sph_sim *sim = tank(40, most_of(), &set);
    inspect(sim);
    only(SPH_FINDINGS, 0);
    must(sim, sph_ready(sim));
    inspect(sim);
    only(SPH_FINDINGS, 0);
    sph_sim *other = tank(40, most_of(), &set);
    for (int k = 0; k < 3; k++) {
        must(sim, sph_step(sim));
        must(other, sph_step(other));
        inspect(sim);
        assert_true(sph_hash(sim) == sph_hash(other));
    }
}

static void the_same_box_twice_is_found(void **state)
{
    uint32_t set, n = 1;
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    (void)state;
    for (int k = 0; k < SPH_DIM; k++, n *= N)
        hi[k] = EDGE;
    sph_sim *sim = tank(40, most_of() + n, &set);
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    inspect(sim);
    only(SPH_FINDING_COINCIDENT, 2 * n);
    const sph_finding *f = &found[SPH_FINDING_COINCIDENT];
    assert_true(f->particle == 0 && f->other != 0 && f->other != SPH_NO_PARTICLE && f->set == set);
    close_to(f->value, 0, 1e-6);
    must(sim, sph_ready(sim)); /* the same in the order of cells */
    inspect(sim);
    assert_int_equal(found[SPH_FINDING_COINCIDENT].count, 2 * n);
}

/* across a seam, and at a whole support's distance along the other axes */
static void coincidence_is_seen_across_a_seam(void **state)
{
    (void)state;
    for (int k = 0; k < SPH_DIM; k++) {
        sph_config c = periodic_config(1, DX);
        double x[SPH_DIM], y[SPH_DIM];
        uint32_t set;
        c.max_particles = 3;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        for (int a = 0; a < SPH_DIM; a++)
            x[a] = y[a] = 0.47;
        x[k] = 0.01;
        y[k] = 0.995;
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
        must(sim, sph_add_particle(sim, set, y, NULL, 0, NULL));
        inspect(sim);
        only(SPH_FINDING_COINCIDENT, 2);
        close_to(found[0].value, 0.015, 1e-6);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void fluid_in_a_wall_is_found(void **state)
{
    uint32_t set, id;
    double x[SPH_DIM], v[SPH_DIM] = {5};
    (void)state;
    sph_sim *sim = tank(40, most_of(), &set);
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = 0.3 * DX;
    x[SPH_DIM - 1] = -DX; /* between two layers */
    must(sim, sph_add_particle(sim, set, x, NULL, 0, &id));
    inspect(sim);
    only(SPH_FINDING_IN_WALL, 1);
    assert_int_equal(found[SPH_FINDING_IN_WALL].particle, id);
    close_to(found[SPH_FINDING_IN_WALL].value, DX, 1e-6);
    x[SPH_DIM - 1] = 1.05 * EDGE;
    must(sim, sph_add_particle(sim, set, x, v, 0, &id));
    inspect(sim);
    assert_int_equal(found[SPH_FINDING_FAST].count, 1);
    assert_int_equal(found[SPH_FINDING_FAST].particle, id);
    close_to(found[SPH_FINDING_FAST].value, 5.0 / 40, 1e-6);
}

static void slow_sound_empty_sets_and_spare_room_are_found(void **state)
{
    uint32_t set, none;
    (void)state;
    sph_sim *sim = tank(20, most_of(), &set); /* 10 sqrt(g H) is 24 */
    inspect(sim);
    only(SPH_FINDING_SLOW_SOUND, 1);
    assert_true(found[SPH_FINDING_SLOW_SOUND].set == set && found[SPH_FINDING_SLOW_SOUND].limit > 24);
    sim = tank(40, most_of(), &set);
    must(sim, sph_add_fluid(sim, NULL, &none));
    inspect(sim);
    only(SPH_FINDING_EMPTY_SET, 1);
    assert_int_equal(found[SPH_FINDING_EMPTY_SET].set, none);
    sim = tank(40, 4 * most_of(), &set);
    inspect(sim);
    only(SPH_FINDING_SPARE, 4 * most_of());
}

static void what_holds_nothing_or_does_nothing_is_refused(void **state)
{
    uint32_t set;
    double x[SPH_DIM];
    (void)state;
    sph_sim *sim = tank(40, most_of(), &set);
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = 2.5 * DX;
    assert_int_equal(sph_add_ring(sim, set, x, 0.1 * DX, 0.2 * DX, NULL), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "shape");
    sph_config c = open_config(EDGE, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = EDGE;
    w.kind = SPH_WALL_GHOST;
    w.compressible = true;
    c.density = SPH_SUMMATION; /* a compressible wall would be held without a word */
    sim = new_sim(&c);
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "wall.compressible");
    w.compressible = false;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
}

/* when a group is to go is state: a run without it ends differently */
static void the_hash_sees_when_a_wall_goes(void **state)
{
    uint32_t set;
    (void)state;
    sph_sim *one = tank(40, most_of(), &set), *two = tank(40, most_of(), &set);
    assert_true(sph_hash(one) == sph_hash(two));
    must(one, sph_remove_wall_at(one, 0, 1));
    assert_true(sph_hash(one) != sph_hash(two));
    must(two, sph_remove_wall_at(two, 0, 2));
    assert_true(sph_hash(one) != sph_hash(two));
    must(two, sph_remove_wall_at(two, 0, 1));
    assert_true(sph_hash(one) == sph_hash(two));
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_sound_scene_has_no_findings),
        subject(the_same_box_twice_is_found),
        subject(coincidence_is_seen_across_a_seam),
        subject(fluid_in_a_wall_is_found),
        subject(slow_sound_empty_sets_and_spare_room_are_found),
        subject(what_holds_nothing_or_does_nothing_is_refused),
        subject(the_hash_sees_when_a_wall_goes),
    };
    return run_subjects("inspect", list);
}
