/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_bounds.c: every bound on what a host gives stands where sph.h says: the last value inside is taken, the first
   one outside is refused, and the refusal tells name, value and what is allowed. */
#include "testing.h"

#define DX 0.25

static sph_config config(void)
{
    sph_config c = open_config(1, DX); /* -1 .. 2 */
    c.max_particles = 4000;
    return c;
}
static sph_sim *with_fluid(const sph_config *c, uint32_t *set)
{
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, set));
    return sim;
}

/* refused with this name and value; the text of what is allowed holds `allowed` */
static void told(const sph_sim *sim, sph_status st, const char *what, const char *allowed, double value)
{
    const sph_report *r = sph_last(sim);
    if (st != SPH_BAD_ARGUMENT || strcmp(r->what, what) != 0 || !strstr(r->allowed, allowed) ||
        !(value - value != 0 ? r->value - r->value != 0 : r->value >= value && r->value <= value))
        fail_msg("%s: %s = %.17g, allowed: %s; wanted %s = %.17g, %s", sph_status_text(st), r->what, r->value,
                 r->allowed, what, value, allowed);
}
#define next_up(x) nextafter(x, INFINITY)
#define next_down(x) nextafter(x, -INFINITY)

/* ---- fluid, solid ---- */

static void a_fluids_numbers(void **state)
{
    const sph_config c = config();
    uint32_t set;
    (void)state;
    const double in[] = {0, 1e-29, 1e29}, low = 1e-31, high = 1e31;
    for (int i = 0; i < 3; i++) {
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, &(sph_fluid){.mass = in[i]}, &set));
        must(sim, sph_add_fluid(sim, &(sph_fluid){.rho0 = in[i]}, &set));
    }
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = 1e-14}, &set));
    must(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = 9e14}, &set));
    must(sim, sph_add_fluid(sim, &(sph_fluid){.own_eos = true, .eos = SPH_IDEAL_GAS - 1}, &set));
    for (int i = 0; i < 2; i++) {
        const double v = i ? high : low;
        told(sim, sph_add_fluid(sim, &(sph_fluid){.mass = v}, &set), "fluid.mass", "1e-30 .. 1e30", v);
        told(sim, sph_add_fluid(sim, &(sph_fluid){.rho0 = v}, &set), "fluid.rho0", "1e-30 .. 1e30", v);
    }
    told(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = 1e-16}, &set), "fluid.sound_speed", "1e-15 .. 1e15",
         1e-16);
    told(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = 1e16}, &set), "fluid.sound_speed", "1e-15 .. 1e15", 1e16);
    const double just[] = {1.005e15, 0.995e-15};
    for (int i = 0; i < 2; i++) {
        const double v = just[i], w = v * v;
        told(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = v}, &set), "fluid.sound_speed", "1e-15 .. 1e15", v);
        told(sim, sph_add_fluid(sim, &(sph_fluid){.mass = w}, &set), "fluid.mass", "1e-30 .. 1e30", w);
        told(sim, sph_add_fluid(sim, &(sph_fluid){.rho0 = w}, &set), "fluid.rho0", "1e-30 .. 1e30", w);
    }
    told(sim, sph_add_fluid(sim, &(sph_fluid){.own_eos = true, .eos = SPH_EOSES}, &set), "eos", "SPH_TAIT", SPH_EOSES);
    told(sim, sph_add_fluid(sim, NULL, NULL), "set", "place", 0);
}

static void as_many_sets_as_there_is_room_for(void **state)
{
    sph_config c = config();
    uint32_t set;
    (void)state;
    c.max_sets = 3;
    sph_sim *sim = new_sim(&c);
    for (uint32_t s = 0; s < 3; s++) {
        must(sim, sph_add_fluid(sim, NULL, &set));
        assert_int_equal(set, s);
    }
    assert_int_equal(sph_add_fluid(sim, NULL, &set), SPH_TOO_MANY_SETS);
    assert_string_equal(sph_last(sim)->what, "sets");
    close_to(sph_last(sim)->value, 3, 0);
}

static sph_config rock_config(void)
{
    sph_config c = config();
    c.solid = SPH_UPDATED;
    c.yield = SPH_VON_MISES;
    c.damage = SPH_DIM > 1 ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
    c.max_flaws = 2000;
    return c;
}
static void a_solids_numbers(void **state)
{
    const sph_config c = rock_config();
    const sph_solid fine = {.shear = 1e5};
    sph_sim *sim = new_sim(&c);
    uint32_t set;
    (void)state;
    told(sim, sph_add_solid(sim, NULL, &set, NULL), "solid", "material", 0);
    must(sim, sph_add_solid(sim, &fine, &set, NULL));
#define ROCK(member, v) &(sph_solid){.shear = 1e5, .member = v}
    must(sim, sph_add_solid(sim, ROCK(body, 255), &set, NULL));
    told(sim, sph_add_solid(sim, ROCK(body, 256), &set, NULL), "body", "0 .. 255", 256);
    must(sim, sph_add_solid(sim, ROCK(held, 1u << (SPH_DIM - 1)), &set, NULL));
    told(sim, sph_add_solid(sim, ROCK(held, 1u << SPH_DIM), &set, NULL), "held", "bits of axes", 1u << SPH_DIM);
    told(sim, sph_add_solid(sim, ROCK(motion, sph_motion_steady), &set, NULL), "motion", "held along an axis", 1);
    told(sim, sph_add_solid(sim, ROCK(yield, -1e-9), &set, NULL), "yield", "0 .. 1e30", -1e-9);
    told(sim, sph_add_solid(sim, ROCK(hardening, -1e-9), &set, NULL), "hardening", "0 .. 1e30", -1e-9);
    told(sim, sph_add_solid(sim, ROCK(crack_speed, 1e30), &set, NULL), "crack_speed", "0 .. 1e30", 1e30);
    told(sim, sph_add_solid(sim, ROCK(flaw_radius, 2e30), &set, NULL), "flaw_radius", "0 .. 1e30", 2e30);
    told(sim, sph_add_solid(sim, &(sph_solid){.shear = -1}, &set, NULL), "shear", "0 .. 1e30", -1);
    told(sim, sph_add_solid(sim, &(sph_solid){.yield = 1}, &set, NULL), "yield", "shear > 0", 1);
    if (SPH_DIM > 1)
        told(sim, sph_add_solid(sim, &(sph_solid){.shear = 0}, &set, NULL), "shear", "> 0 with damage", 0);
    told(sim, sph_add_solid(sim, ROCK(mass, 1e31), &set, NULL), "solid.mass", "1e30", 1e31);
    told(sim, sph_add_solid(sim, ROCK(rho0, 1e31), &set, NULL), "solid.rho0", "1e30", 1e31);
    told(sim, sph_add_solid(sim, ROCK(sound_speed, 1e16), &set, NULL), "solid.sound_speed", "1e15", 1e16);
    told(sim, sph_add_solid(sim, &fine, NULL, NULL), "set", "place", 0);
    const sph_config plain = config();
    sph_sim *water = with_fluid(&plain, &set);
    told(water, sph_add_solid(water, &fine, &set, NULL), "solid", "solid form", SPH_NO_SOLID);
}

static void held_sets_and_walls_share_the_groups(void **state)
{
    sph_config c = rock_config();
    const sph_solid held = {.shear = 1e5, .held = 1};
    uint32_t set, group;
    (void)state;
    c.max_sets = SPH_MAX_SETS;
    sph_sim *sim = new_sim(&c);
    for (uint32_t g = 0; g < SPH_MAX_GROUPS; g++) {
        must(sim, sph_add_solid(sim, &held, &set, &group));
        assert_int_equal(group, g);
    }
    assert_int_equal(sph_add_solid(sim, &held, &set, &group), SPH_TOO_MANY_SETS);
    close_to(sph_last(sim)->value, SPH_MAX_GROUPS, 0);
    must(sim, sph_add_solid(sim, &(sph_solid){.shear = 1e5}, &set, &group)); /* one that is not held needs none */
}

#if SPH_DIM > 1
static void flaws_numbers(void **state)
{
    const sph_config c = rock_config();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    uint32_t set, n;
    float list[SPH_MAX_FLAWS];
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 0.75;
    for (int i = 0; i < 2; i++) {
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &(sph_solid){.shear = 1e5}, &set, NULL));
        told(sim, sph_add_flaws(sim, set, &(sph_flaws){1, 9, 1}), "set", "with particles", set);
        must(sim, sph_add_box(sim, set, lo, hi, NULL));
        told(sim, sph_add_flaws(sim, set, NULL), "flaws", "description", 0);
        told(sim, sph_add_flaws(sim, set + 1, &(sph_flaws){1, 9, 1}), "set", "sph_add_solid", set + 1);
        told(sim, sph_add_flaws(sim, set, &(sph_flaws){0, 9, 1}), "flaws.k", "> 0", 0);
        told(sim, sph_add_flaws(sim, set, &(sph_flaws){1e300, 9, 1}), "flaws.k", "> 0", 1e300);
        told(sim, sph_add_flaws(sim, set, &(sph_flaws){1, next_down(1), 1}), "flaws.m", "1 .. 50", next_down(1));
        told(sim, sph_add_flaws(sim, set, &(sph_flaws){1, next_up(50), 1}), "flaws.m", "1 .. 50", next_up(50));
        must(sim, sph_add_flaws(sim, set, &(sph_flaws){1, i ? 50 : 1, 1}));
        told(sim, sph_add_flaws(sim, set, &(sph_flaws){1, 9, 1}), "set", "without flaws", set);
        assert_int_equal(sph_get_flaws(sim, sph_count(sim) - 1, &n, list), SPH_OK);
        assert_true(n >= 1 && n <= SPH_MAX_FLAWS);
        assert_int_equal(sph_get_flaws(sim, c.max_particles - 1, &n, list), SPH_OK);
        assert_int_equal(n, 0);
        assert_int_equal(sph_get_flaws(sim, c.max_particles, &n, list), SPH_BAD_ARGUMENT);
    }
}

/* The draws by the text of sph.h: round(N ln N) of them and more until every particle has a flaw; p, then the particle;
   20 at most; thresholds (p/(k V))^(1/m) in rising order. */
static uint64_t drawn;
static uint32_t draw_below(uint32_t n)
{
    uint64_t z = drawn += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (uint32_t)(((z ^ z >> 31) >> 32) * n >> 32);
}
enum { PARTS = 300 };
static struct {
    uint32_t n;
    double eps[SPH_MAX_FLAWS];
} want[PARTS];
static void draw_all(uint32_t n, double volume, const sph_flaws *f)
{
    const uint32_t all = (uint32_t)floor(n * log(n) + 0.5);
    uint32_t bare = n;
    memset(want, 0, sizeof want);
    drawn = f->seed;
    for (uint32_t i = 0; i < all || bare > 0; i++) {
        const uint32_t p = 1 + draw_below(all), at = draw_below(n);
        if (want[at].n == SPH_MAX_FLAWS)
            continue;
        bare -= want[at].n == 0;
        uint32_t k = want[at].n++;
        const double eps = pow(p / (f->k * volume), 1 / f->m);
        for (; k > 0 && want[at].eps[k - 1] > eps; k--)
            want[at].eps[k] = want[at].eps[k - 1];
        want[at].eps[k] = eps;
    }
}
/* two sets, flaws given to the second one first: those of the first stand before them */
static void flaws_are_those_of_the_manual(void **state)
{
    const sph_config c = rock_config();
    double lo[2][SPH_DIM], hi[2][SPH_DIM];
    uint32_t set[2], first[2], count[2];
    (void)state;
    sph_sim *sim = new_sim(&c);
    for (int s = 0; s < 2; s++) {
        for (int k = 0; k < SPH_DIM; k++) {
            lo[s][k] = s && k == 0 ? 1 : 0;
            hi[s][k] = lo[s][k] + (k ? 1 : 0.75);
        }
        must(sim, sph_add_solid(sim, &(sph_solid){.shear = 1e5, .rho0 = 2000 + 100 * s}, &set[s], NULL));
        first[s] = sph_count(sim);
        must(sim, sph_add_box(sim, set[s], lo[s], hi[s], NULL));
        count[s] = sph_count(sim) - first[s];
    }
    for (int s = 1; s >= 0; s--)
        must(sim, sph_add_flaws(sim, set[s], &(sph_flaws){3e7 * (s + 1), 4 + s, 77 + (uint64_t)s}));
    for (int s = 0; s < 2; s++) {
        const double cell = SPH_DIM == 2 ? DX * DX : DX * DX * DX;
        draw_all(count[s], count[s] * cell, &(sph_flaws){3e7 * (s + 1), 4 + s, 77 + (uint64_t)s});
        for (uint32_t i = 0; i < count[s]; i++) {
            uint32_t n;
            float list[SPH_MAX_FLAWS];
            assert_int_equal(sph_get_flaws(sim, first[s] + i, &n, list), SPH_OK);
            assert_int_equal(n, want[i].n);
            for (uint32_t k = 0; k < n; k++)
                close_to((double)list[k], want[i].eps[k], 1e-6 * want[i].eps[k]);
        }
    }
}
#endif

/* ---- particles and shapes ---- */

static void a_particles_numbers(void **state)
{
    const sph_config c = config();
    double x[SPH_DIM], v[SPH_DIM] = {0};
    uint32_t set, id = 77;
    (void)state;
    sph_sim *sim = with_fluid(&c, &set);
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = 0.5;
    told(sim, sph_add_particle(sim, set, NULL, NULL, 0, NULL), "x", "position", 0);
    told(sim, sph_add_particle(sim, set + 1, x, NULL, 0, NULL), "set", "sph_add_fluid", set + 1);
    told(sim, sph_add_particle(sim, set, x, NULL, 100 * 1000, NULL), "rho", "100 rho0", 1e5);
    told(sim, sph_add_particle(sim, set, x, NULL, -1e-300, NULL), "rho", "100 rho0", -1e-300);
    must(sim, sph_add_particle(sim, set, x, NULL, next_down(1e5), NULL));
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = -1e15;
        told(sim, sph_add_particle(sim, set, x, v, 0, NULL), "velocity", "finite", -1e15);
        v[k] = 9e14;
        must(sim, sph_add_particle(sim, set, x, v, 0, &id));
        v[k] = 0;
        assert_int_equal(id, sph_count(sim) - 1);
        x[k] = 2; /* the high face is outside, the low one inside */
        told(sim, sph_add_particle(sim, set, x, NULL, 0, NULL), "position", "inside the domain", 2);
        x[k] = next_down(-1);
        told(sim, sph_add_particle(sim, set, x, NULL, 0, NULL), "position", "inside the domain", -1 + (x[k] + 1));
        x[k] = -1;
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
        sph_particle p = by_id(sim, sph_count(sim) - 1);
        close_to(p.x[k], -1, 0);
        x[k] = 2 - 1e-10;
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
        p = by_id(sim, sph_count(sim) - 1);
        assert_true(p.x[k] < 2 && p.x[k] > 1.9999);
        x[k] = 0.5;
    }
}

/* a box begins and ends within a domain's length (3) of the domain -1 .. 2; what is refused names the corner */
static void a_boxs_corners(void **state)
{
    const sph_config c = config();
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t set;
    (void)state;
    sph_sim *sim = with_fluid(&c, &set);
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = 0;
        hi[k] = 0.5;
    }
    told(sim, sph_add_box(sim, set, NULL, hi, NULL), "lo, hi", "corners", 0);
    told(sim, sph_add_box(sim, set, lo, NULL, NULL), "lo, hi", "corners", 0);
    for (int k = 0; k < SPH_DIM; k++) {
        hi[k] = 0;
        told(sim, sph_add_box(sim, set, lo, hi, NULL), "hi", "> lo", 0);
        hi[k] = 5; /* a length beyond: looked at, and its points are outside */
        told(sim, sph_add_box(sim, set, lo, hi, NULL), "position", "inside the domain", 2.125);
        hi[k] = 5.01;
        told(sim, sph_add_box(sim, set, lo, hi, NULL), "hi", "within a domain's length", 5.01);
        hi[k] = 0.5;
        lo[k] = -4.01;
        told(sim, sph_add_box(sim, set, lo, hi, NULL), "hi", "within a domain's length", 0.5);
        lo[k] = -4;
        told(sim, sph_add_box(sim, set, lo, hi, NULL), "position", "inside the domain", -3.875);
        lo[k] = 1e15;
        told(sim, sph_add_box(sim, set, lo, hi, NULL), "lo", "finite", 1e15);
        lo[k] = 0;
        hi[k] = 1e15;
        told(sim, sph_add_box(sim, set, lo, hi, NULL), "hi", "finite", 1e15);
        hi[k] = 0.5;
    }
    assert_int_equal(sph_count(sim), 0);
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    assert_int_equal(sph_count(sim), 1 << SPH_DIM);
}

static void a_shapes_numbers(void **state)
{
    static sph_ellipse many[4097];
    const sph_config c = config();
    sph_ellipse rim;
    sph_shape s = {.lattice = SPH_LATTICE_SQUARE};
    double at[SPH_DIM];
    uint32_t set;
    (void)state;
    sph_sim *sim = with_fluid(&c, &set);
    for (int k = 0; k < SPH_DIM; k++) {
        s.hi[k] = 0.5;
        at[k] = rim.centre[k] = 0.5;
        rim.radius[k] = 0.4;
        for (int i = 0; i < 4097; i++)
            many[i].centre[k] = -5, many[i].radius[k] = 1;
    }
    told(sim, sph_add_shape(sim, set, NULL), "shape", "shape", 0);
    s.hole = many;
    s.holes = 4097;
    told(sim, sph_add_shape(sim, set, &s), "holes", "4096", 4097);
    s.holes = 4096;
    must(sim, sph_add_shape(sim, set, &s));
    s.hole = NULL;
    s.holes = 1;
    told(sim, sph_add_shape(sim, set, &s), "holes", "place", 1);
    s.holes = 0;
    s.lattice = SPH_DIM == 1 ? 1 : SPH_DIM + 1;
    told(sim, sph_add_shape(sim, set, &s), "lattice", "SQUARE", s.lattice);
    s.lattice = SPH_LATTICE_SQUARE;
    s.outline = &rim;
    rim.radius[SPH_DIM - 1] = 0;
    told(sim, sph_add_shape(sim, set, &s), "radius", "> 0", 0);
    rim.radius[SPH_DIM - 1] = 0.4;
    rim.centre[SPH_DIM - 1] = -1e15;
    told(sim, sph_add_shape(sim, set, &s), "centre", "finite", -1e15);
    s.outline = NULL;
    s.lo[SPH_DIM - 1] = -1e15;
    told(sim, sph_add_shape(sim, set, &s), "lo", "finite", -1e15);
    s.lo[SPH_DIM - 1] = 0.6;
    told(sim, sph_add_shape(sim, set, &s), "hi", ">= lo", 0.5);
    told(sim, sph_add_ring(sim, set, NULL, 0, 1, NULL), "centre", "position", 0);
    told(sim, sph_add_ring(sim, set, at, 0.3, 0.3, NULL), "outer", "> inner", 0.3);
    told(sim, sph_add_ring(sim, set, at, -1e-9, 0.3, NULL), "outer", "inner >= 0", 0.3);
    told(sim, sph_add_ring(sim, set, at, 0, 1e15, NULL), "outer", "finite", 1e15);
}

/* ---- walls ---- */

static void a_walls_numbers(void **state)
{
    const sph_config c = config();
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t set, group;
    (void)state;
    sph_sim *sim = with_fluid(&c, &set);
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = 0;
        hi[k] = 1;
    }
    sph_wall w = sph_wall_default();
    told(sim, sph_add_wall_box(sim, NULL, lo, hi, 1, true, NULL), "wall", "description", 0);
    told(sim, sph_add_wall_box(sim, &w, lo, hi, 0, true, NULL), "faces", "SPH_LOW", 0);
    told(sim, sph_add_wall_box(sim, &w, lo, hi, 1u << 2 * SPH_DIM, true, NULL), "faces", "SPH_LOW", 1u << 2 * SPH_DIM);
    told(sim, sph_add_wall_box(sim, &w, lo, NULL, 1, true, NULL), "lo, hi", "corners", 0);
    for (int k = 0; k < SPH_DIM; k++) {
        hi[k] = lo[k];
        told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "hi", "> lo on every axis", 0);
        hi[k] = 5.01;
        told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "hi", "within a domain's length", 5.01);
        hi[k] = 1e15;
        told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "hi", "finite", 1e15);
        hi[k] = 1;
    }
    w.layers = 65;
    told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "wall.layers", "0 .. 64", 65);
    w.layers = 64; /* taken, but there is no room for them in the domain */
    told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "position", "inside the domain", 0 - 63.5 * DX);
    w.layers = 1;
    w.kind = SPH_WALLS;
    told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "wall.kind", "ADAMI", SPH_WALLS);
    w.kind = SPH_WALL_LENNARD_JONES;
    w.strength = -1e-300;
    told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "wall.strength", ">= 0", -1e-300);
    w.strength = 1e30;
    told(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, NULL), "wall.strength", ">= 0", 1e30);
    w.strength = 1;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, 1, true, &group));
    told(sim, sph_remove_wall_at(sim, group + 1, 1), "group", "wall function", group + 1);
    told(sim, sph_remove_wall_at(sim, group, NAN), "t", "time", NAN);
    must(sim, sph_remove_wall_at(sim, group, 1));
}

#if SPH_DIM > 1
static void a_flat_walls_length(void **state)
{
    const sph_config c = config();
    sph_wall w = sph_wall_default();
    uint32_t set;
    const double o[3] = {0, 0, 0}, least = 0.5 * DX, d[3] = {next_up(least), 0, 0}, e[3] = {least, 0, 0};
    (void)state;
    sph_sim *sim = with_fluid(&c, &set);
#if SPH_DIM == 2
    told(sim, sph_add_wall_segment(sim, &w, o, NULL, NULL), "a, b", "two points", 0);
    told(sim, sph_add_wall_segment(sim, &w, o, e, NULL), "b", "half a spacing", least);
    must(sim, sph_add_wall_segment(sim, &w, o, d, NULL));
#else
    const double up[3] = {0, 1, 0}, slant[3] = {0.05, 1, 0}, far[3] = {0, 1e15, 0}; /* 2.9 degrees off: sin^2 0.9975 */
    const double more[3] = {0.04, 1, 0}, nn = 1 / (1 + 0.04 * 0.04);
    told(sim, sph_add_wall_plane(sim, &w, o, e, up, NULL), "e1, e2", "half a spacing", least);
    told(sim, sph_add_wall_plane(sim, &w, o, up, e, NULL), "e1, e2", "half a spacing", 1);
    told(sim, sph_add_wall_plane(sim, &w, o, d, far, NULL), "e1, e2", "finite", d[0]);
    assert_int_equal(sph_add_wall_plane(sim, &w, o, d, slant, NULL), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "e2");
    close_to(sph_last(sim)->value, 1 / (1 + 0.05 * 0.05), 1e-9);
    assert_int_equal(sph_add_wall_plane(sim, &w, o, d, more, NULL), SPH_BAD_ARGUMENT);
    close_to(sph_last(sim)->value, nn, 1e-9);
    must(sim, sph_add_wall_plane(sim, &w, o, d, up, NULL));
#endif
}
#endif

/* ---- fields ---- */

/* all of a set or nobody is moved: what would end outside is named; others, their densities and velocities stay */
static void to_place(void *ctx, const double *x, double *to)
{
    const double *by = ctx;
    for (int k = 0; k < SPH_DIM; k++)
        to[k] = x[k] * by[0] + by[1];
}
static void particles_are_moved_all_or_none(void **state)
{
    sph_config c = config();
    uint32_t set, other;
    double x[SPH_DIM], y[SPH_DIM], half[2] = {0.5, 0.01}, out[2] = {1, 0};
    (void)state;
    sph_sim *sim = with_fluid(&c, &set);
    must(sim, sph_add_fluid(sim, NULL, &other));
    for (int k = 0; k < SPH_DIM; k++) {
        x[k] = c.lo[k] + 0.125 * (c.hi[k] - c.lo[k]);
        y[k] = c.lo[k] + 0.25 * (c.hi[k] - c.lo[k]);
    }
    must(sim, sph_add_particle(sim, set, x, y, 1010, NULL));
    must(sim, sph_add_particle(sim, other, y, NULL, 0, NULL));
    must(sim, sph_add_particle(sim, set, y, NULL, 0, NULL));
    out[1] = c.hi[0] - y[0];
    told(sim, sph_apply_positions(sim, set, to_place, out), "position", "inside the domain", c.hi[0]);
    close_to(by_id(sim, 0).x[0], x[0], 1e-5);
    told(sim, sph_apply_positions(sim, set, NULL, NULL), "fn", "function", 0);
    told(sim, sph_apply_positions(sim, 7, to_place, half), "set", "sph_add_fluid", 7);
    must(sim, sph_apply_positions(sim, set, to_place, half));
    for (int k = 0; k < SPH_DIM; k++) {
        close_to(by_id(sim, 0).x[k], 0.5 * x[k] + 0.01, 1e-5);
        close_to(by_id(sim, 1).x[k], y[k], 1e-5);
        close_to(by_id(sim, 0).v[k], y[k], 1e-5);
    }
    close_to(by_id(sim, 0).rho, 1010, 1e-3);
    must(sim, sph_ready(sim));
    assert_int_equal(sph_apply_positions(sim, set, to_place, half), SPH_BAD_STATE);
}

static double given_rho, given_v;
static void give(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)x;
    v[SPH_DIM - 1] = given_v;
    *rho = given_rho;
}
static void a_fields_numbers(void **state)
{
    sph_config c = config();
    double x[SPH_DIM];
    uint32_t set;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = 0.5;
    c.gravity[0] = -10;
    sph_sim *sim = with_fluid(&c, &set);
    must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
    told(sim, sph_apply_field(sim, set, NULL, NULL), "fn", "function", 0);
    given_v = 1;
    given_rho = 1e5;
    told(sim, sph_apply_field(sim, set, give, NULL), "field density", "100 rho0", 1e5);
    given_rho = 0;
    told(sim, sph_apply_field(sim, set, give, NULL), "field density", "100 rho0", 0);
    given_rho = next_down(1e5);
    must(sim, sph_apply_field(sim, set, give, NULL));
    given_rho = 1010;
    given_v = 1e15;
    told(sim, sph_apply_field(sim, set, give, NULL), "field velocity", "finite", 1e15);
    given_v = 3;
    must(sim, sph_apply_field(sim, set, give, NULL));
    close_to(by_id(sim, 0).rho, 1010, 1e-3);
    close_to(by_id(sim, 0).v[SPH_DIM - 1], 3, 1e-6);
    told(sim, sph_apply_hydrostatic(sim, set, 1e15), "surface", "finite", 1e15);
    /* Tait: p = rho0 g d = B ((rho/rho0)^7 - 1), B = rho0 c^2/7 */
    must(sim, sph_apply_hydrostatic(sim, set, 1.5));
    close_to(by_id(sim, 0).rho, 1000 * pow(1 + 7 * 10 * 1.0 / 400, 1.0 / 7), 2e-4);
    must(sim, sph_apply_hydrostatic(sim, set, 0.25)); /* above the surface: at rest */
    close_to(by_id(sim, 0).rho, 1000, 1e-9);
    if (SPH_DIM > 1) {
        c.gravity[1] = 1e-9;
        must(sim, sph_reconfigure(sim, &c));
        told(sim, sph_apply_hydrostatic(sim, set, 1), "gravity", "one axis", 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_fluids_numbers),
        subject(as_many_sets_as_there_is_room_for),
        subject(a_solids_numbers),
        subject(held_sets_and_walls_share_the_groups),
#if SPH_DIM > 1
        subject(flaws_numbers),
        subject(flaws_are_those_of_the_manual),
        subject(a_flat_walls_length),
#endif
        subject(a_particles_numbers),
        subject(a_boxs_corners),
        subject(a_shapes_numbers),
        subject(a_walls_numbers),
        subject(a_fields_numbers),
        subject(particles_are_moved_all_or_none),
    };
    return run_subjects("bounds", list);
}
