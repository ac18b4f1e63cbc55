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

/* ---- against a loop over all pairs, which knows no cells ---- */

static double gap(const sph_config *c, const sph_particle *p, const sph_particle *q)
{
    double r2 = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        double d = fabs(p->x[k] - q->x[k]);
        const double length = c->hi[k] - c->lo[k];
        if (c->face[k][0] == SPH_PERIODIC && d > 0.5 * length)
            d = length - d;
        r2 += d * d;
    }
    return sqrt(r2);
}

/* what must be found of particles nearer than 0.3 spacings */
static sph_finding by_all_pairs(const sph_sim *sim, const sph_config *c)
{
    sph_finding f = {.value = 1e30, .particle = SPH_NO_PARTICLE, .other = SPH_NO_PARTICLE, .set = SPH_MAX_SETS};
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p, q;
        double least = 0.3 * DX;
        uint32_t other = SPH_NO_PARTICLE;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        for (uint32_t j = 0; j < sph_count(sim); j++) {
            assert_int_equal(sph_get(sim, j, &q), SPH_OK);
            const bool walls = p.role == SPH_ROLE_GHOST && q.role == SPH_ROLE_GHOST;
            const double r = i == j || walls ? 1e30 : gap(c, &p, &q);
            if (r < least) {
                least = r;
                other = q.id;
            }
        }
        if (other == SPH_NO_PARTICLE)
            continue;
        f.count++;
        f.value = least < f.value ? least : f.value;
        if (p.id < f.particle) {
            f.particle = p.id;
            f.other = other;
            f.set = p.set;
        }
    }
    return f;
}

/* n particles anywhere in a domain of odd lengths, periodic along the axes of the bits of `round`, in two fluids */
static sph_sim *cloud(sph_config *c, uint64_t seed, uint32_t round, uint32_t n)
{
    sph_rng rng;
    uint32_t set[2];
    *c = open_config(1, DX);
    sph_rng_seed(&rng, seed, 3);
    for (int k = 0; k < SPH_DIM; k++) {
        c->lo[k] = -0.3;
        c->hi[k] = (SPH_DIM == 1 ? 3.03 : 0.51) + 0.07 * k;
        c->face[k][0] = c->face[k][1] = round >> k & 1 ? SPH_PERIODIC : SPH_OPEN;
    }
    c->max_particles = n;
    sph_sim *sim = new_sim(c);
    for (int s = 0; s < 2; s++)
        must(sim, sph_add_fluid(sim, NULL, &set[s]));
    for (uint32_t i = 0; i < n; i++) {
        double x[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = c->lo[k] + (c->hi[k] - c->lo[k]) * sph_rng_uniform(&rng);
        must(sim, sph_add_particle(sim, set[i * 2 / n], x, NULL, 0, NULL));
    }
    return sim;
}

static void coincidence_is_what_all_pairs_say(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        sph_config c;
        sph_sim *sim = cloud(&c, seed, (uint32_t)seed % (1u << SPH_DIM), SPH_DIM == 1 ? 40 : 150);
        const sph_finding want = by_all_pairs(sim, &c);
        inspect(sim);
        const sph_finding *f = &found[SPH_FINDING_COINCIDENT];
        only(SPH_FINDING_COINCIDENT, want.count);
        if (want.count) {
            close_to(f->value, want.value, 1e-7);
            close_to(f->limit, 0.3 * DX, 1e-12);
            assert_int_equal(f->particle, want.particle);
            assert_int_equal(f->other, want.other);
            assert_int_equal(f->set, want.set);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- each finding's numbers ---- */

/* two fluids with sound 10 and 100 and a block of the second one */
static sph_sim *two_fluids(sph_config *c, uint32_t *set, double top)
{
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = 100}, &set[0]));
    must(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = 10}, &set[1]));
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = k == SPH_DIM - 1 ? top : 0.3;
    must(sim, sph_add_box(sim, set[1], lo, hi, NULL));
    return sim;
}

static void the_fastest_is_told_against_its_own_sound(void **state)
{
    sph_config c = open_config(1, DX);
    uint32_t set[2], first, id;
    double x[SPH_DIM], v[SPH_DIM] = {0};
    (void)state;
    c.max_particles = 100;
    sph_sim *sim = two_fluids(&c, set, 0.3);
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = 0.5;
    v[SPH_DIM - 1] = -9; /* slow against 100 m/s */
    must(sim, sph_add_particle(sim, set[0], x, v, 0, NULL));
    x[0] = 0.7;
    v[SPH_DIM - 1] = 1.25;
    must(sim, sph_add_particle(sim, set[1], x, v, 0, &first));
    x[0] = 0.9;
    v[0] = 3, v[SPH_DIM - 1] = SPH_DIM == 1 ? 5 : 4;
    must(sim, sph_add_particle(sim, set[1], x, v, 0, &id));
    inspect(sim);
    const sph_finding *f = &found[SPH_FINDING_FAST];
    assert_int_equal(f->count, 2);
    assert_int_equal(f->particle, first);
    assert_int_equal(f->set, set[1]);
    assert_int_equal(f->other, SPH_NO_PARTICLE);
    close_to(f->value, 0.5, 1e-6);
    close_to(f->limit, 0.1, 1e-12);
}

/* particles of a fluid at height 0.05 .. 0.95 - dx/2 and a wall half a spacing below 0: H between centres, with g along
   any axis and way */
static void slow_sound_is_told_by_the_height_of_fall(void **state)
{
    (void)state;
    for (int axis = 0; axis < SPH_DIM; axis++)
        for (int way = -1; way <= 1; way += 2) {
            sph_config c = open_config(1, DX);
            double x[SPH_DIM] = {0};
            uint32_t set[2];
            c.max_particles = 10;
            c.gravity[axis] = 5 * way;
            sph_sim *sim = new_sim(&c);
            for (uint32_t s = 0; s < 2; s++)
                must(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = s ? 12 : 15}, &set[s]));
            for (int i = 0; i < 5; i++) {
                x[axis] = 0.2 + 0.25 * ((i * 3) % 5);
                must(sim, sph_add_particle(sim, set[i > 2], x, NULL, 0, NULL));
            }
            inspect(sim);
            const sph_finding *f = &found[SPH_FINDING_SLOW_SOUND];
            assert_int_equal(f->count, 2);
            assert_int_equal(f->set, set[0]);
            close_to(f->value, 12, 1e-12);
            close_to(f->limit, 10 * sqrt(5 * 1.0), 1e-6);
            assert_int_equal(free_sims(NULL), 0);
        }
}

static void empty_sets_and_spare_room_are_counted(void **state)
{
    sph_config c = open_config(1, DX);
    double x[SPH_DIM];
    uint32_t set[4];
    (void)state;
    for (uint32_t max = 6; max <= 9; max++) { /* three particles: 6 is twice as many, 7 is one more */
        c.max_particles = max;
        sph_sim *sim = new_sim(&c);
        for (int s = 0; s < 4; s++)
            must(sim, sph_add_fluid(sim, NULL, &set[s]));
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < SPH_DIM; k++)
                x[k] = 0.2 + 0.2 * i;
            must(sim, sph_add_particle(sim, set[i == 2 ? 2 : 0], x, NULL, 0, NULL));
        }
        inspect(sim);
        assert_int_equal(found[SPH_FINDING_EMPTY_SET].count, 2);
        assert_int_equal(found[SPH_FINDING_EMPTY_SET].set, set[1]);
        close_to(found[SPH_FINDING_EMPTY_SET].value, 0, 0);
        close_to(found[SPH_FINDING_EMPTY_SET].limit, 1, 0);
        assert_int_equal(found[SPH_FINDING_SPARE].count, max >= 8 ? max : 0);
        if (max >= 8) {
            close_to(found[SPH_FINDING_SPARE].value, 3, 0);
            close_to(found[SPH_FINDING_SPARE].limit, 0.5 * max, 0);
            assert_int_equal(found[SPH_FINDING_SPARE].particle, SPH_NO_PARTICLE);
        }
    }
}

static void the_deepest_in_a_wall_is_told(void **state)
{
    sph_config c = open_config(1, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], x[SPH_DIM];
    uint32_t set, ids[4];
    (void)state;
    c.max_particles = 3000;
    sph_sim *sim = new_sim(&c);
    for (int k = 0; k < SPH_DIM; k++) {
        hi[k] = 1;
        x[k] = 0.52;
    }
    must(sim, sph_add_fluid(sim, NULL, &set));
    w.layers = 3;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0) | SPH_HIGH(0), true, NULL));
    const double at[4] = {0.3, -0.11, 1.21, -0.31}; /* in the water, two in walls, one behind a wall of three layers */
    for (int i = 0; i < 4; i++) {
        x[0] = at[i];
        must(sim, sph_add_particle(sim, set, x, NULL, 0, &ids[i]));
    }
    inspect(sim);
    const sph_finding *f = &found[SPH_FINDING_IN_WALL];
    assert_int_equal(f->count, 2);
    assert_int_equal(f->particle, ids[1]);
    close_to(f->value, 0.21, 1e-6);
    close_to(f->limit, 0, 0);
    assert_int_equal(sph_inspect(sim, NULL, NULL), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "fn");
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(coincidence_is_what_all_pairs_say),
        subject(the_fastest_is_told_against_its_own_sound),
        subject(slow_sound_is_told_by_the_height_of_fall),
        subject(empty_sets_and_spare_room_are_counted),
        subject(the_deepest_in_a_wall_is_told),
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
