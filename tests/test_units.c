/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_units.c: no equation has a number with a hidden unit. Each golden case is built a second time in other units of
   length, time and density, powers of two, so that nothing is rounded; after some steps every particle, the time and
   the totals are those of the first to the last bit, times their units. What a scene gives in units is scaled on its
   way in here, so that the cases need not know. */
#include "testing.h"

#include "sph/options.h"

typedef struct units {
    double length, time, density;
} units;
static const units unit_sets[] = {{8, 65536, 32}, {0.0078125, 0.0009765625, 0.03125}};
static units as = {1, 1, 1};

/* of a word such as kg/m^3: a product of powers of m, s, kg before and behind one stroke; of any other word 1 */
static double unit_of(const char *word)
{
    double value = 1;
    bool under = false;
    if (word[strspn(word, "kgms/^ 0123456789")])
        return 1;
    for (const char *w = word; *w;) {
        const bool mass = strncmp(w, "kg", 2) == 0;
        const double kg = as.density * as.length * as.length * as.length;
        const double one = mass ? kg : *w == 'm' ? as.length : *w == 's' ? as.time : 1;
        w += mass ? 2 : 1;
        int power = 1;
        if (*w == '^') {
            power = w[1] - '0';
            w += 2;
        }
        for (int k = 0; k < power; k++)
            value = under ? value / one : value * one;
        under |= *w == '/';
        w += *w == '/' || *w == ' ';
    }
    return value;
}

/* ---- what a scene says, on its way in ---- */

static sph_motion motion_of; /* of all that moves in a case */
static void scaled_motion(void *ctx, double t, double *x, double *v)
{
    motion_of(ctx, t / as.time, x, v);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        x[k] *= as.length;
        v[k] *= as.length / as.time;
    }
}
static sph_motion scaled(sph_motion m)
{
    if (m)
        motion_of = m;
    return m ? scaled_motion : NULL;
}
static void (*force_of)(void *ctx, double t, const double *x, const double *v, double *a);
static void scaled_force(void *ctx, double t, const double *x, const double *v, double *a)
{
    double y[SPH_DIM], u[SPH_DIM], b[SPH_DIM] = {0};
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        y[k] = x[k] / as.length;
        u[k] = v[k] / (as.length / as.time);
    }
    force_of(ctx, t / as.time, y, u, b);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        a[k] += b[k] * (as.length / as.time / as.time);
}
static void scale(double *to, const double *from, double unit)
{
    for (uint32_t k = 0; k < SPH_DIM; k++)
        to[k] = from[k] * unit;
}

static sph_status units_add_particle(sph_sim *sim, uint32_t set, const double *x, const double *v, double rho,
                                     uint32_t *id)
{
    double y[SPH_DIM], u[SPH_DIM];
    scale(y, x, as.length);
    scale(u, v, as.length / as.time);
    return sph_add_particle(sim, set, y, u, rho * as.density, id);
}
static sph_status units_add_fluid(sph_sim *sim, const sph_fluid *fluid, uint32_t *set)
{
    if (!fluid)
        return sph_add_fluid(sim, NULL, set);
    sph_fluid f = *fluid;
    f.rho0 *= as.density;
    f.sound_speed *= as.length / as.time;
    return sph_add_fluid(sim, &f, set);
}
static UNUSED sph_wall scaled_wall(const sph_wall *wall)
{
    sph_wall w = *wall;
    w.motion = scaled(w.motion);
    if (w.kind == SPH_WALL_LENNARD_JONES)
        w.strength *= unit_of("m^2/s^2");
    else
        assert_true(w.strength == 0);
    return w;
}
#if SPH_WITH_SOLID
static sph_status units_add_solid(sph_sim *sim, const sph_solid *solid, uint32_t *set, uint32_t *group)
{
    sph_solid s = *solid;
    const double pascal = as.density * unit_of("m^2/s^2");
    s.shear *= pascal;
    s.yield *= pascal;
    s.hardening *= pascal;
    s.motion = scaled(s.motion);
    return sph_add_solid(sim, &s, set, group);
}
#endif
#if SPH_DIM > 1
static sph_status units_add_flaws(sph_sim *sim, uint32_t set, const sph_flaws *flaws)
{
    sph_flaws f = *flaws;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        f.k /= as.length;
    return sph_add_flaws(sim, set, &f);
}
#endif
static UNUSED sph_flow scaled_flow(const sph_flow *flow)
{
    sph_flow f = *flow;
    scale(f.lo, flow->lo, as.length);
    scale(f.hi, flow->hi, as.length);
    f.speed *= as.length / as.time;
    return f;
}
static UNUSED sph_status units_add_inflow(sph_sim *sim, uint32_t fluid, const sph_flow *flow, uint32_t *set)
{
    const sph_flow f = scaled_flow(flow);
    return sph_add_inflow(sim, fluid, &f, set);
}
static UNUSED sph_status units_add_outflow(sph_sim *sim, uint32_t fluid, const sph_flow *flow, uint32_t *set)
{
    const sph_flow f = scaled_flow(flow);
    return sph_add_outflow(sim, fluid, &f, set);
}
static UNUSED sph_status units_find_edges(sph_sim *sim, const sph_edges *edges)
{
    sph_edges e = *edges;
    scale(e.velocity, edges->velocity, as.length / as.time);
    scale(e.source, edges->source, as.length);
    return sph_find_edges(sim, &e);
}
static sph_status units_add_wall_box(sph_sim *sim, const sph_wall *wall, const double *lo, const double *hi,
                                     uint32_t faces, bool inside, uint32_t *group)
{
    const sph_wall w = scaled_wall(wall);
    double a[SPH_DIM], b[SPH_DIM];
    scale(a, lo, as.length);
    scale(b, hi, as.length);
    return sph_add_wall_box(sim, &w, a, b, faces, inside, group);
}
#if SPH_DIM == 2
static UNUSED sph_status units_add_wall_polyline(sph_sim *sim, const sph_wall *wall, const double (*points)[SPH_DIM],
                                                 uint32_t n, uint32_t *group)
{
    const sph_wall w = scaled_wall(wall);
    double at[8][SPH_DIM];
    for (uint32_t k = 0; k < n; k++)
        scale(at[k], points[k], as.length);
    return sph_add_wall_polyline(sim, &w, (const double(*)[SPH_DIM])at, n, group);
}
#endif
static UNUSED sph_status units_remove_wall_at(sph_sim *sim, uint32_t group, double t)
{
    return sph_remove_wall_at(sim, group, t * as.time);
}

#undef sph_add_particle
#undef sph_add_fluid
#undef sph_add_solid
#undef sph_add_flaws
#undef sph_add_inflow
#undef sph_add_outflow
#undef sph_find_edges
#undef sph_add_wall_box
#undef sph_add_wall_polyline
#undef sph_remove_wall_at
#define sph_add_particle units_add_particle
#define sph_add_fluid units_add_fluid
#define sph_add_solid units_add_solid
#define sph_add_flaws units_add_flaws
#define sph_add_inflow units_add_inflow
#define sph_add_outflow units_add_outflow
#define sph_find_edges units_find_edges
#define sph_add_wall_box units_add_wall_box
#define sph_add_wall_polyline units_add_wall_polyline
#define sph_remove_wall_at units_remove_wall_at
#include "cases.h"

/* every option by the unit of its line in options.h */
static void scale_config(sph_config *c)
{
#define SCALE_WHOLE(name, unit)
#define SCALE_CHOICE(name, unit)
#define SCALE_BOOL(name, unit)
#define SCALE_FACES(name, unit)
#define SCALE_REAL(name, unit) c->name *= unit_of(unit);
#define SCALE_POSITIVE(name, unit) c->name *= unit_of(unit);
#define SCALE_VECTOR(name, unit) scale(c->name, c->name, unit_of(unit));
#define SCALE_O(A, name, kind, start, low, high, in, allowed, change, unit, ...) SCALE_##kind(name, unit)
    SPH_OPTIONS(SCALE_O, SCALE_O, 0)
    if (c->shear == SPH_SMAGORINSKY_WICK)
        c->smagorinsky *= as.time; /* as printed that constant is a time */
    force_of = c->body_force;
    if (force_of)
        c->body_force = scaled_force;
}

/* ---- what comes out ---- */

static uint32_t wrong; /* cases; the first difference of each is told */
static const bits_case *told;
static void same(double one, double other, double unit, const bits_case *b, const char *what, uint32_t i)
{
    if (other == one * unit || (one != one && other != other) || told == b)
        return;
    print_error("%s: %s of %u: %.17g in other units, not %.17g\n", b->name, what, i, other / unit, one);
    told = b;
    wrong++;
}

static void same_particles(const sph_sim *one, const sph_sim *other, const bits_case *b)
{
    const double v = as.length / as.time, pascal = as.density * v * v;
    double kg = as.density;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        kg *= as.length;
    assert_int_equal(sph_count(one), sph_count(other));
    for (uint32_t i = 0; i < sph_count(one); i++) {
        sph_particle p, q;
        assert_int_equal(sph_get(one, i, &p), SPH_OK);
        assert_int_equal(sph_get(other, i, &q), SPH_OK);
        assert_int_equal(p.id, q.id);
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            same(p.x[k], q.x[k], as.length, b, "place", p.id);
            same(p.v[k], q.v[k], v, b, "velocity", p.id);
            same(p.a[k], q.a[k], v / as.time, b, "acceleration", p.id);
        }
        same(p.rho, q.rho, as.density, b, "density", p.id);
        same(p.p, q.p, pascal, b, "pressure", p.id);
        same(p.mass, q.mass, kg, b, "mass", p.id);
        for (uint32_t k = 0; k < 6; k++)
            same(p.stress[k], q.stress[k], pascal, b, "stress", p.id);
        same(p.plastic, q.plastic, 1, b, "plastic strain", p.id);
        same(p.damage, q.damage, 1, b, "damage", p.id);
        same(p.energy, q.energy, v * v, b, "energy", p.id);
    }
    sph_totals t, u;
    sph_get_totals(one, &t);
    sph_get_totals(other, &u);
#define SAME_BOOK(name, unit, when, what) same(t.name, u.name, unit[0] == 'J' ? kg * v * v : kg, b, what, 0);
    SPH_BOOKS(SAME_BOOK)
    same(t.kinetic, u.kinetic, kg * v * v, b, "kinetic energy", 0);
    same(t.internal, u.internal, kg * v * v, b, "internal energy", 0);
    same(t.dissipated, u.dissipated, kg * v * v, b, "dissipated energy", 0);
    same(t.wall_work, u.wall_work, kg * v * v, b, "work of walls", 0);
    same(sph_time(one), sph_time(other), as.time, b, "time", 0);
}

static sph_sim *made(const bits_case *b, const units *u)
{
    as = (units){1, 1, 1};
    sph_config c = case_config(b);
    as = *u;
    scale_config(&c);
    sph_sim *sim = new_sim(&c);
    must(sim, case_build(sim, b));
    must(sim, sph_ready(sim));
    return sim;
}

static void other_units_change_no_bit(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < BITS_CASES; k++) {
        const bits_case *b = &bits_cases[k];
        const units *u = &unit_sets[k % 2], usual = {1, 1, 1};
        sph_sim *one = made(b, &usual);
        for (uint32_t s = 0; s < 4; s++)
            must(one, sph_step(one));
        sph_sim *other = made(b, u);
        for (uint32_t s = 0; s < 4; s++)
            must(other, sph_step(other));
        same_particles(one, other, b);
        assert_int_equal(free_sims(NULL), 0);
    }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(other_units_change_no_bit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
