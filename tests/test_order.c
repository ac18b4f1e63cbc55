/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_order.c: the order in time of every integrator, in a shear flow: places, velocities, densities, stresses, by
   halving the step three times. With viscosities, schemes, forms of solids, corrected gradients, walls that move,
   forces that change with time, and steps of changing length. */
#include "testing.h"

#define PI 3.14159265358979323846
#define N 16u
#define DX (1.0 / N)
#define END 0.064 /* s */
#define STEPS 64u /* of the longest step, halved twice; the predictor-corrector, one sweep a step, does twice as many */
#define LEVELS 3
#define KEPT 900u
#define ALONG (SPH_DIM > 1 ? 1 : 0)
#define ORDER 1.9

enum { X, V, RHO, STRESS, PLASTIC, DAMAGE, FIELDS };
static const char *const field_names[FIELDS] = {"x", "v", "rho", "stress", "strain", "damage"};
static const char *const names[SPH_INTEGRATORS] = {"predictor-corrector", "kick-drift-kick", "leap-frog", "Runge-Kutta",
                                                   "Runge-Kutta momentum"};

/* a row of the table */
typedef struct scene {
    const char *name;
    uint32_t scheme, viscosity, diffusion, gradient, solid, eos, wall; /* wall: kind + 1, 0: none */
    bool uneven, pushed, compressible, no_slip, mirror, held, drift, smooth, damage;
    double hardening; /* Pa: yields from the beginning, and hardens; 0: does not */
} scene;

typedef struct result {
    uint32_t n;
    double f[FIELDS][KEPT][6];
} result;

static void vortices(void *ctx, const double *x, double *v, double *rho)
{
    const double y = x[ALONG], u = *(const double *)ctx;
    (void)rho;
    v[0] = u * (sin(2 * PI * x[0]) * cos(2 * PI * y) + 0.3 * sin(2 * PI * y));
    v[ALONG] = -u * cos(2 * PI * x[0]) * sin(2 * PI * y);
}

static void drawn(void *ctx, const double *x, double *v, double *rho)
{
    vortices(ctx, x, v, rho);
    *rho *= 0.85;
}

/* a push that grows and turns */
static void push(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)v;
    a[0] += 30 * sin(50 * t + 2 * PI * x[ALONG]);
    a[ALONG] += 20 * cos(40 * t);
}

/* a wall that shakes */
static void shake(void *ctx, double t, double *d, double *v)
{
    (void)ctx;
    d[0] = 0.02 * (1 - cos(30 * t));
    v[0] = 0.6 * sin(30 * t);
    d[ALONG] = 0.01 * (1 - cos(40 * t));
    v[ALONG] = 0.4 * sin(40 * t);
}

static sph_config config_of(const scene *s, uint32_t integrator)
{
    sph_config c = periodic_config(1, DX);
    c.smoothing_length = 2 * DX;
    c.sound_speed = 5;
    c.dt = 1;
    c.integrator = integrator;
    c.scheme = s->scheme;
    c.viscosity = s->viscosity;
    c.alpha = 0.1;
    c.nu = s->viscosity == SPH_MORRIS ? 0.01 : 0;
    c.diffusion = s->diffusion;
    c.gradient = s->gradient;
    c.solid = s->solid;
    c.eos = s->eos;
    c.xsph = s->drift || s->smooth ? 0.5 : 0;
    c.xsph_strain = s->smooth;
    c.damage = s->damage ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
    c.max_flaws = s->damage ? 40 * KEPT : 0;
    c.yield = s->hardening > 0 ? SPH_VON_MISES : SPH_NO_YIELD;
    c.body_force = s->pushed ? push : NULL;
    c.gravity[ALONG] = s->wall ? -10 : 0;
    c.max_particles = KEPT;
    c.on_cross = SPH_IGNORE;
    for (int k = 0; k < SPH_DIM && s->mirror; k++)
        c.face[k][0] = c.face[k][1] = SPH_SYMMETRY;
    if (s->wall) {
        c.lo[ALONG] = -0.5;
        c.hi[ALONG] = 1.5;
        c.face[ALONG][0] = c.face[ALONG][1] = SPH_OPEN;
    }
    return c;
}

static sph_sim *start(const scene *s, uint32_t integrator)
{
    const sph_config c = config_of(s, integrator);
    sph_sim *sim = new_sim(&c);
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = k < 2 ? 0 : c.lo[k], hi[k] = k < 2 ? 1 : c.hi[k];
    if (s->solid) {
        sph_solid m = {.shear = 0.3 * 1000 * 25, .crack_speed = 0.03, .yield = s->hardening > 0 ? 1e-3 : 0};
        m.hardening = s->hardening;
        must(sim, sph_add_solid(sim, &m, &set, NULL));
    } else {
        must(sim, sph_add_fluid(sim, NULL, &set));
    }
    if (s->held) {
        sph_solid m = {.shear = 0.3 * 1000 * 25, .held = 3, .motion = shake};
        double low[SPH_DIM], top[SPH_DIM];
        uint32_t other;
        memcpy(low, lo, sizeof lo), memcpy(top, hi, sizeof hi);
        lo[ALONG] = top[ALONG] = 4 * DX;
        must(sim, sph_add_solid(sim, &m, &other, NULL));
        must(sim, sph_add_box(sim, other, low, top, NULL));
    }
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    if (s->wall) {
        sph_wall w = sph_wall_default();
        double low[SPH_DIM], top[SPH_DIM];
        memcpy(low, c.lo, sizeof low), memcpy(top, c.hi, sizeof top);
        w.kind = s->wall - 1;
        w.compressible = s->compressible;
        w.no_slip = s->no_slip;
        w.motion = shake;
        low[ALONG] = 0, top[ALONG] = 1;
        must(sim, sph_add_wall_box(sim, &w, low, top, SPH_LOW(ALONG), true, NULL));
    }
    double speed = s->solid == SPH_TOTAL ? 0.4 : 1; /* bonds are not to be drawn too long */
#if SPH_DIM > 1
    if (s->damage) { /* in tension, all flaws at work from the beginning to the end */
        const sph_flaws flaws = {1e30, 1, 1};
        must(sim, sph_add_flaws(sim, set, &flaws));
    }
#endif
    must(sim, sph_apply_field(sim, set, s->damage ? drawn : vortices, &speed));
    return sim;
}

/* what particles have; leap-frog's velocities, which stand half a step ahead, are taken back */
static void keep(const sph_sim *sim, double ahead, bool compressible, result *r)
{
    sph_particle p;
    r->n = sph_count(sim);
    assert_true(r->n <= KEPT);
    for (uint32_t i = 0; i < r->n; i++) {
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        const bool body = p.role == SPH_ROLE_FLUID || p.role == SPH_ROLE_SOLID;
        for (int k = 0; k < 6; k++) {
            r->f[X][p.id][k] = k < SPH_DIM ? p.x[k] : 0;
            r->f[V][p.id][k] = k < SPH_DIM && body ? p.v[k] - ahead * p.a[k] : 0;
            r->f[STRESS][p.id][k] = body ? p.stress[k] : 0;
        }
        r->f[PLASTIC][p.id][0] = p.plastic;
        r->f[DAMAGE][p.id][0] = p.damage;
        r->f[RHO][p.id][0] = body || compressible ? p.rho : 0;
    }
}

static void run(const scene *s, uint32_t integrator, uint32_t steps, result *r)
{
    sph_sim *sim = start(s, integrator);
    sph_step_info info;
    for (uint32_t k = 1; k <= steps; k++) /* uneven: every second step is longer by 1.3/0.7 */
        must(sim, sph_step_to(sim, END * (k + (s->uneven && k % 2 ? 0.3 : 0)) / steps));
    sph_get_step(sim, &info);
    assert_int_equal(info.step, steps);
    keep(sim, integrator == SPH_LEAP_FROG ? info.dt / 2 : 0, s->compressible, r);
    assert_int_equal(free_sims(NULL), 0);
}

/* rms change of a field between two runs, round a periodic domain of length 1 */
static double change(const result *a, const result *b, int f)
{
    double sum = 0;
    assert_int_equal(a->n, b->n);
    for (uint32_t i = 0; i < a->n; i++)
        for (int k = 0; k < 6; k++) {
            double d = a->f[f][i][k] - b->f[f][i][k];
            if (f == X && fabs(d) > 0.5)
                d -= d > 0 ? 1 : -1;
            sum += d * d;
        }
    return sqrt(sum / a->n);
}

/* what a field is made of: changes below rounding of it say nothing */
static const double unit[FIELDS] = {1, 1, 1000, 1000 * 25, 1, 1};

/* the orders of a row; returns the worst */
static double orders(const scene *s, uint32_t integrator)
{
    static result r[LEVELS];
    /* what yields turns quickly: in the fewest steps Runge-Kutta's errors of third order show */
    const uint32_t finer = s->hardening > 0 ? 4 : integrator == SPH_PREDICTOR_CORRECTOR ? 2 : 1;
    double worst = 9;
    for (int k = 0; k < LEVELS; k++)
        run(s, integrator, finer * STEPS << k, &r[k]);
    print_message("%-40s %-20s", s->name, names[integrator]);
    for (int f = 0; f < FIELDS; f++) {
        if ((f == STRESS && !s->solid) || (f == PLASTIC && s->hardening <= 0) || (f == DAMAGE && !s->damage))
            continue;
        const double e1 = change(&r[LEVELS - 3], &r[LEVELS - 2], f), e2 = change(&r[LEVELS - 2], &r[LEVELS - 1], f);
        const double order = log2(e1 / e2);
        print_message(" %s %.2f (%.1e)", field_names[f], order, e2 / unit[f]);
        if (e2 > 3e-11 * unit[f] && order < worst)
            worst = order;
    }
    print_message("\n");
    return worst;
}

/* a third of the table, each row with one or two integrators; ORDER=n in the environment: every n-th; ORDER=all */
static void all_are_of_second_order(const scene *s, size_t n)
{
    static uint32_t row;
    const char *const said = getenv("ORDER");
    const uint32_t every = said && strcmp(said, "all") == 0 ? 1 : said && atoi(said) > 0 ? (uint32_t)atoi(said) : 3;
    uint32_t bad = 0;
    for (size_t k = 0; k < n; k++)
        for (uint32_t i = 0; i < SPH_INTEGRATORS; i++)
            if ((i != SPH_RUNGE_KUTTA_MOMENTUM || k == 0) /* the same but for rounding */
                && row++ % every == 0)
                bad += orders(&s[k], i) >= ORDER ? 0 : 1;
    assert_int_equal(bad, 0);
}
#define COUNT(a) (sizeof(a) / sizeof *(a))

static void fluids_in_every_scheme(void **state)
{
    static const scene s[] = {
        {"standard, inviscid", .viscosity = SPH_INVISCID},
        {"standard, artificial viscosity", .viscosity = SPH_ARTIFICIAL},
        {"standard, Morris", .viscosity = SPH_MORRIS},
        {"standard, diffusion", .diffusion = SPH_MOLTENI},
        {"weak, inviscid", .scheme = SPH_WEAK},
        {"weak, Morris, diffusion", .scheme = SPH_WEAK, .viscosity = SPH_MORRIS, .diffusion = SPH_MOLTENI},
        {"direct", .scheme = SPH_DIRECT},
        {"standard as printed", .scheme = SPH_STANDARD_WICK, .eos = SPH_ISOTHERMAL},
        {"weak as printed", .scheme = SPH_WEAK_WICK, .eos = SPH_ISOTHERMAL},
        {"Bonet & Lok", .gradient = SPH_BONET_LOK, .viscosity = SPH_ARTIFICIAL},
        {"Bonet & Lok, weak", .gradient = SPH_BONET_LOK, .scheme = SPH_WEAK},
        {"renormalised", .gradient = SPH_RENORMALISED},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

static void solids_in_every_form(void **state)
{
    static const scene s[] = {
        {"updated", .solid = SPH_UPDATED},
        {"updated, weak", .solid = SPH_UPDATED, .scheme = SPH_WEAK},
        {"updated, viscosity", .solid = SPH_UPDATED, .viscosity = SPH_ARTIFICIAL},
        {"corrected", .solid = SPH_CORRECTED},
        {"corrected, weak", .solid = SPH_CORRECTED, .scheme = SPH_WEAK},
        {"total", .solid = SPH_TOTAL},
        {"total, weak, Morris", .solid = SPH_TOTAL, .scheme = SPH_WEAK, .viscosity = SPH_MORRIS},
        {"corrected, held sets that shake", .solid = SPH_CORRECTED, .held = true},
        {"total, held sets that shake", .solid = SPH_TOTAL, .held = true},
        {"updated, damage", .solid = SPH_UPDATED, .damage = true},
        {"corrected, damage", .solid = SPH_CORRECTED, .damage = true},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

/* Radial return of a whole way is backward Euler where the strain rate turns against the stress; two halves of it,
   extrapolated, are of second order (sph/yield.c). */
static void yielding(void **state)
{
    static const scene s[] = {
        {"corrected, yield", .solid = SPH_CORRECTED, .hardening = 1e4},
        {"updated, yield", .solid = SPH_UPDATED, .hardening = 1e4},
        {"total, yield between mirrors", .solid = SPH_TOTAL, .hardening = 1e4, .mirror = true},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

static void steps_of_changing_length(void **state)
{
    static const scene s[] = {
        {"uneven steps, Morris", .viscosity = SPH_MORRIS, .uneven = true},
        {"uneven steps, weak", .scheme = SPH_WEAK, .uneven = true},
        {"uneven steps, corrected solid", .solid = SPH_CORRECTED, .uneven = true},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

static void forces_that_change_with_time(void **state)
{
    static const scene s[] = {
        {"pushed, Morris", .viscosity = SPH_MORRIS, .pushed = true},
        {"pushed, uneven steps", .pushed = true, .uneven = true},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

static void walls_that_move(void **state)
{
    static const scene s[] = {
        {"Adami, free slip", .wall = SPH_WALL_ADAMI + 1},
        {"Adami, no slip, Morris", .wall = SPH_WALL_ADAMI + 1, .no_slip = true, .viscosity = SPH_MORRIS},
        {"Adami, weak, uneven", .wall = SPH_WALL_ADAMI + 1, .scheme = SPH_WEAK, .uneven = true},
        {"Adami, as printed", .wall = SPH_WALL_ADAMI + 1, .scheme = SPH_WEAK_WICK, .eos = SPH_ISOTHERMAL},
        {"ghosts, held density", .wall = SPH_WALL_GHOST + 1, .no_slip = true, .viscosity = SPH_ARTIFICIAL},
        {"ghosts, compressible", .wall = SPH_WALL_GHOST + 1, .compressible = true},
        {"ghosts, compressible, weak", .wall = SPH_WALL_GHOST + 1, .compressible = true, .scheme = SPH_WEAK},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

static void velocities_that_are_smoothed(void **state)
{
    static const scene s[] = {
        {"XSPH", .viscosity = SPH_INVISCID, .drift = true},
        {"XSPH, uneven, Morris", .viscosity = SPH_MORRIS, .drift = true, .uneven = true},
        {"XSPH, total", .solid = SPH_TOTAL, .drift = true},
        {"smoothed strain rates, corrected", .solid = SPH_CORRECTED, .smooth = true},
        {"XSPH between mirrors", .mirror = true, .drift = true},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

static void mirrors(void **state)
{
    static const scene s[] = {
        {"mirrors, Morris", .mirror = true, .viscosity = SPH_MORRIS},
        {"mirrors, corrected solid", .mirror = true, .solid = SPH_CORRECTED},
    };
    (void)state;
    all_are_of_second_order(s, COUNT(s));
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(fluids_in_every_scheme), subject(solids_in_every_form),        subject(steps_of_changing_length),
        subject(walls_that_move),        subject(forces_that_change_with_time), subject(mirrors),
        subject(velocities_that_are_smoothed), subject(yielding),
    };
    return run_subjects("order", list);
}
