/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_balance.c: energy at an instant. With the rates that the kernel gives,

     d(kinetic + potential + internal + elastic)/dt = power of walls and body force - powers of all that takes

   to rounding, in every form: schemes, viscosities, diffusion, gradients, walls, faces, solids, contact, artificial
   stress, damage, held sets. The left side is made here of velocities, accelerations and rates, and of the energies
   that are the kernel's definition (sph_totals); nothing depends on the integrator. Then what happens at once. */
#include "bodies.h"

#define N (SPH_DIM == 1 ? 30u : SPH_DIM == 2 ? 10u : 5u)
#define DX 0.1
#define EDGE (N * DX)
#define MU 2e5
/* a term of a sum rounds to a few eps of its size */
#define ROUNDING (64 * EPS)

/* what a scene is made of; 0: the plain thing */
typedef struct scene {
    uint32_t scheme, viscosity, diffusion, gradient, density, eos, shear, face; /* face: of the last axis */
    uint32_t wall;            /* SPH_WALL_... + 1, 0: none */
    bool compressible, no_slip, floor_, xsph, guard;
    uint32_t solid, repulsion; /* solid: a block beside another, or beside a fluid */
    bool damage, hat, held, fluid;
} scene;

/* a wall and a held set that move at this velocity, and have done so for `since` */
static double since;
static void steady(void *ctx, double t, double *x, double *v)
{
    static const double speed[3] = {0.7, -0.4, 0.3};
    (void)ctx;
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = speed[k];
        x[k] = speed[k] * (t + since);
    }
}
static void push(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t;
    a[0] += 3 + x[0] - 0.5 * v[SPH_DIM - 1];
    a[SPH_DIM - 1] += 2;
}

static sph_config config_of(const scene *s)
{
    sph_config c = open_config(EDGE, DX);
    const int last = SPH_DIM - 1;
    c.scheme = s->scheme;
    c.viscosity = s->viscosity;
    c.alpha = 0.3;
    c.beta = 0.5;
    c.nu = 0.05;
    c.diffusion = s->diffusion;
    c.gradient = s->gradient;
    c.gradient_guard = s->guard;
    c.shear = s->shear;
    c.smagorinsky = 1.5;
    c.subgrid = 0.5;
    c.density = s->density;
    c.eos = s->eos;
    c.pressure_floor = s->floor_;
    c.xsph = s->xsph || s->hat ? 0.5 : 0;
    c.solid = s->solid;
    c.artificial_stress = s->repulsion;
    c.damage = s->damage ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
    c.max_flaws = s->damage;
    c.xsph_strain = s->hat;
    c.books = true;
    c.body_force = push;
    for (int k = 0; k < SPH_DIM; k++)
        c.gravity[k] = 1.5 - k;
    c.lo[last] = s->face && SPH_DIM > 1 ? 0 : c.lo[last];
    c.hi[last] = s->face == SPH_PERIODIC || (s->face && SPH_DIM == 1) ? EDGE : c.hi[last];
    c.lo[last] = s->face == SPH_PERIODIC ? 0 : c.lo[last];
    c.face[last][0] = s->face == SPH_PERIODIC || SPH_DIM > 1 ? s->face : SPH_OPEN;
    c.face[last][1] = s->face == SPH_PERIODIC || SPH_DIM == 1 ? s->face : SPH_OPEN;
    return c;
}

static void add_wall(sph_sim *sim, const scene *s)
{
    double lo[SPH_DIM], hi[SPH_DIM];
    sph_wall w = sph_wall_default();
    w.kind = s->wall - 1;
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = 0;
        hi[k] = w.kind < SPH_WALL_GHOST ? EDGE - DX : EDGE; /* a row on the wall has a particle at both ends */
    }
    w.compressible = s->compressible;
    w.no_slip = s->no_slip;
    w.strength = w.kind == SPH_WALL_LENNARD_JONES ? 1 : 0;
    w.motion = steady;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
}

/* two sets of bodies that stand among each other; which: what the second is */
static void add_sets(sph_sim *sim, const scene *s, uint32_t *set)
{
    sph_solid m = {.shear = MU};
    if (!s->solid) {
        must(sim, sph_add_fluid(sim, NULL, &set[0]));
        set[1] = set[0];
        return;
    }
    must(sim, sph_add_solid(sim, &m, &set[0], NULL));
    m.body = 1;
    m.held = s->held ? 1 : 0;
    m.motion = s->held ? steady : NULL;
    if (s->fluid)
        must(sim, sph_add_fluid(sim, NULL, &set[1]));
    else
        must(sim, sph_add_solid(sim, &m, &set[1], NULL));
}

/* stresses, damages and displacements as they come; before the first forces */
static void scatter_fields(sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    sph_rng_seed(&dice, 5, 3);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (!sph_is_solid(&sim->set[b->set[0][i]]))
            continue;
        set_stress(sim, i, toss_deviator(0.1 * MU));
        if (b->damage[0])
            b->damage[0][i] = (sph_real)(i % 9 == 0 ? 1 : 0.5 + 0.5 * toss());
        for (int k = 0; b->shift[0] && k < SPH_DIM; k++)
            b->shift[k][i] = (sph_pos)(0.05 * DX * toss() / sim->grid.quantum);
    }
}

/* moved: everything is displaced by so long a time of its motion */
static sph_sim *make(const scene *s, double moved)
{
    sph_config c = config_of(s);
    sph_sim *sim = new_sim(&c);
    uint32_t set[2], total = 1;
    sph_rng rng;
    sph_rng_seed(&rng, 7, 1);
    since = moved;
    add_sets(sim, s, set);
    for (int k = 0; k < SPH_DIM; k++)
        total *= N;
    for (uint32_t i = 0; i < total; i++) {
        double x[SPH_DIM], v[SPH_DIM];
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= N) {
            v[k] = 2 * sph_rng_uniform(&rng) - 1 + 0.3;
            x[k] = (at % N + 0.5 + 0.2 * (2 * sph_rng_uniform(&rng) - 1)) * DX + moved * v[k];
        }
        /* bodies meet in the middle of the first axis */
        const double rho = 1000 * (1 + 0.05 * (2 * sph_rng_uniform(&rng) - 1));
        must(sim, sph_add_particle(sim, set[x[0] > 0.5 * EDGE], x, v, rho, NULL));
    }
    if (s->wall)
        add_wall(sim, s);
    if (s->solid)
        scatter_fields(sim);
    must(sim, sph_ready(sim));
    return sim;
}

/* rates of all energies of a body (W), and their sizes */
static double rate_of(const sph_sim *sim, uint32_t i, double *size)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    const sph_set *s = &sim->set[b->set[0][i]];
    const double rho = s->rho0 * (1 + (double)b->rho[0][i]), p = sph_pressure(sim, s, (double)b->rho[0][i]);
    const double root = b->damage[0] ? (double)b->damage[0][i] : 0;
    const double whole = 1 - (SPH_DIM == 3 ? root * root : root) * root;
    double sum = (p < 0 ? whole : 1) * p / (rho * rho) * s->rho0 * (double)b->drho[0][i];
    double big = s->c0 * s->c0 * 0.05 * fabs((double)b->drho[0][i]);
    for (int k = 0; k < SPH_DIM; k++) {
        const double v = (double)b->vel[k][i], a = (double)b->acc[k][i], g = sim->cfg.gravity[k];
        sum += v * (a - g) - (b->xsph[0] ? g * (double)b->xsph[k][i] : 0);
        big += fabs(v) * (fabs(a) + fabs(g) + 50);
    }
    if (sph_is_solid(s)) {
        const tensor t = kept_stress(sim, i), d = kept_rate(sim, i);
        for (int k = 0; k < 9; k++) {
            const double power = t.v[k / 3][k % 3] * d.v[k / 3][k % 3] / (2 * MU) / s->rho0;
            sum += whole * power;
            big += fabs(power);
        }
    }
    *size += s->mass * big;
    return s->mass * sum;
}

/* what all powers on the books make of the energy (W) */
static double booked(const sph_sim *sim)
{
    const double *p = sim->now.power;
    return p[POWER_WALL] + p[POWER_BODY_FORCE] - p[POWER_DISSIPATED] - p[POWER_DIFFUSED] - p[POWER_IN_WALLS] -
        p[POWER_IN_BONDS] - p[POWER_UNBALANCED];
}

/* energy of compression that scene s has after so long a time of its motion */
static double internal_after(const scene *s, double time)
{
    sph_totals t;
    sph_get_totals(make(s, time), &t);
    assert_int_equal(free_sims(NULL), 0);
    return t.internal;
}

/* the largest powers seen, as parts of what the scene's energies change by: names that nothing exercises show here */
static double seen[SPH_POWERS];
static double worst;

static void forget(void)
{
    worst = 0;
    memset(seen, 0, sizeof seen);
}

static void check(const scene *s)
{
    double rate = 0, size = 0, error;
    if (s->density == SPH_SUMMATION) /* the state has no rate of density */
        rate = (internal_after(s, 1e-6) - internal_after(s, -1e-6)) / 2e-6;
    const sph_sim *sim = make(s, 0);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_is_matter(&sim->set[sim->buf[sim->cur].set[0][i]]))
            rate += rate_of(sim, i, &size);
    error = fabs(rate - booked(sim)) / size;
    for (int k = 0; k < SPH_POWERS; k++)
        seen[k] = fmax(seen[k], fabs(sim->now.power[k]) / size);
    const double allowed = s->density == SPH_SUMMATION ? 1e-7 : ROUNDING;
    worst = fmax(worst, error / allowed);
    if (!(error <= allowed)) {
        const double *p = sim->now.power;
        fail_msg("scheme %u viscosity %u diffusion %u gradient %u density %u eos %u face %u wall %u%s%s%s%s solid %u "
                 "repulsion %u%s%s%s%s: rate %.10g, booked %.10g (size %.3g): viscous %g wall %g diffused %g body %g "
                 "in walls %g in bonds %g unbalanced %g",
                 s->scheme, s->viscosity, s->diffusion, s->gradient, s->density, s->eos, s->face, s->wall,
                 s->compressible ? " compressible" : "", s->no_slip ? " no slip" : "", s->floor_ ? " floor" : "",
                 s->xsph ? " xsph" : "", s->solid, s->repulsion, s->damage ? " damage" : "", s->hat ? " hat" : "",
                 s->held ? " held" : "", s->fluid ? " fluid" : "", rate, booked(sim), size, p[0], p[1], p[2], p[3],
                 p[4], p[5], p[6]);
    }
    /* forms that conserve energy are not charged with anything */
    const bool conserves = s->scheme <= SPH_WEAK && s->face != SPH_MIRROR_NO_SLIP && !s->xsph && !s->solid &&
        !s->guard && (s->density == SPH_CONTINUITY || s->scheme == SPH_STANDARD);
    assert_true(!conserves || (sim->now.power[POWER_UNBALANCED] >= 0 && sim->now.power[POWER_UNBALANCED] <= 0));
    assert_int_equal(free_sims(NULL), 0);
}

static void report_worst(const char *what)
{
    print_message("%s: balance holds to %.2g of what is allowed; powers seen: viscous %.1e wall %.1e diffused %.1e "
                  "body %.1e in walls %.1e in bonds %.1e unbalanced %.1e of the energies' rates\n",
                  what, worst, seen[0], seen[1], seen[2], seen[3], seen[4], seen[5], seen[6]);
}

/* walls: none, three boundary forces, ghosts held and compressible, Adami's without and with slip */
enum { WALLS = 8 };
static void choose_wall(scene *s, uint32_t w)
{
    static const uint32_t kind[WALLS] = {0, SPH_WALL_LENNARD_JONES + 1, SPH_WALL_KERNEL_FORCE + 1,
                                         SPH_WALL_MONAGHAN_KOS + 1, SPH_WALL_GHOST + 1, SPH_WALL_GHOST + 1,
                                         SPH_WALL_ADAMI + 1, SPH_WALL_ADAMI + 1};
    s->wall = kind[w];
    s->compressible = w == 5;
    s->no_slip = w == 5 || w == 7;
}

/* what a fluid may have besides */
enum { EXTRAS = 10 };
static bool choose_extra(scene *s, uint32_t e)
{
    s->diffusion = e == 1 ? SPH_MOLTENI : e == 2 ? SPH_HYDROSTATIC : e == 8 ? SPH_ANTUONO : SPH_NO_DIFFUSION;
    s->guard = e == 9;
    s->gradient = e == 3 || e == 9 ? SPH_BONET_LOK : e == 4 ? SPH_RENORMALISED : SPH_PLAIN;
    s->xsph = e == 5;
    s->eos = e == 6 ? SPH_ISOTHERMAL : e == 7 ? SPH_LINEAR : SPH_TAIT;
    s->floor_ = e == 7 || e == 1;
    s->shear = s->viscosity == SPH_MORRIS ? SPH_NO_SHEAR : e % SPH_SHEARS; /* each beside two of these */
    return s->gradient != SPH_BONET_LOK || s->scheme <= SPH_WEAK;
}

/* in 3-D, where it takes long, a part of them in no order */
static bool skipped(uint32_t which, const scene *s)
{
    if (s->face == SPH_PERIODIC && (SPH_DIM == 3 || (SPH_DIM == 1 && s->wall))) /* too short; both ends are taken */
        return true;
    return SPH_DIM == 3 && which * 2654435761u >> 29 != 0;
}

static void the_books_of_a_fluid_balance_at_every_instant(void **state)
{
    (void)state;
    forget();
    for (uint32_t which = 0; which < SPH_SCHEMES * SPH_VISCOSITIES * SPH_FACES * WALLS * EXTRAS; which++) {
        uint32_t q = which;
        scene s = {0};
        s.scheme = q % SPH_SCHEMES, q /= SPH_SCHEMES;
        s.viscosity = q % SPH_VISCOSITIES, q /= SPH_VISCOSITIES;
        s.face = q % SPH_FACES, q /= SPH_FACES;
        choose_wall(&s, q % WALLS), q /= WALLS;
        if (!choose_extra(&s, q) || skipped(which, &s))
            continue;
        check(&s);
    }
    report_worst("fluids");
    for (int k = 0; k < SPH_POWERS; k++)
        assert_true(k == POWER_IN_BONDS || seen[k] > 1e-4);
}

#if SPH_DOUBLE
/* the rate of the summed density is found by difference */
static void the_books_balance_where_density_is_summed(void **state)
{
    (void)state;
    forget();
    for (uint32_t which = 0; which < SPH_SCHEMES * SPH_VISCOSITIES * SPH_FACES * WALLS; which++) {
        uint32_t q = which;
        scene s = {.density = SPH_SUMMATION};
        s.scheme = q % SPH_SCHEMES, q /= SPH_SCHEMES;
        s.viscosity = q % SPH_VISCOSITIES, q /= SPH_VISCOSITIES;
        s.face = q % SPH_FACES, q /= SPH_FACES;
        choose_wall(&s, q);
        /* an image of a moving wall in a no-slip mirror moves otherwise than its velocity says: not on the books */
        if (s.compressible || (s.wall && s.face == SPH_MIRROR_NO_SLIP) || skipped(which, &s))
            continue;
        check(&s);
    }
    report_worst("summed density");
}
#endif

/* two bodies, or a body and a fluid, beside each other */
static void the_books_of_solids_balance_at_every_instant(void **state)
{
    enum { KINDS = 7 };
    (void)state;
    forget();
    for (uint32_t which = 0; which < 2 * SPH_VISCOSITIES * SPH_FACES * WALLS * KINDS * 3; which++) {
        uint32_t q = which;
        scene s = {0};
        s.scheme = q % 2, q /= 2;
        s.viscosity = q % SPH_VISCOSITIES, q /= SPH_VISCOSITIES;
        s.face = q % SPH_FACES, q /= SPH_FACES;
        choose_wall(&s, q % WALLS), q /= WALLS;
        s.solid = SPH_UPDATED + q % 3, q /= 3;
        s.repulsion = q == 1 ? SPH_PRINCIPAL : q == 2 ? SPH_COMPONENTS : SPH_NO_ARTIFICIAL_STRESS;
        s.damage = (q == 3 || q == 6) && SPH_DIM > 1;
        s.hat = q == 4;
        s.held = q == 5;
        s.fluid = q == 6;
        s.floor_ = q == 6;
        s.diffusion = q == 6 ? SPH_MOLTENI : SPH_NO_DIFFUSION;
        if ((s.repulsion && s.solid == SPH_TOTAL) || skipped(which, &s))
            continue;
        check(&s);
    }
    report_worst("solids");
    for (int k = 0; k < SPH_POWERS; k++)
        assert_true(seen[k] > 1e-4);
}

/* ---- what happens at once ---- */

/* steps a simulation and returns by how much the balance drifts */
static double drift_of(sph_sim *sim, int steps, sph_totals *t)
{
    must(sim, sph_ready(sim));
    sph_get_totals(sim, t);
    const double before = t->balance;
    for (int k = 0; k < steps; k++)
        must(sim, sph_step(sim));
    sph_get_totals(sim, t);
    return t->balance - before;
}

/* a block of water, thrown along axis 0 at this speed */
static sph_sim *thrown(const sph_config *c, double speed, double spread)
{
    sph_sim *sim = new_sim(c);
    uint32_t set;
    sph_rng rng;
    sph_rng_seed(&rng, 11, 2);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (uint32_t i = 0, total = SPH_DIM == 1 ? N : SPH_DIM == 2 ? N * N : N * N * N; i < total; i++) {
        double x[SPH_DIM], v[SPH_DIM] = {0};
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= N)
            x[k] = (at % N + 0.5) * DX;
        v[0] = speed;
        must(sim, sph_add_particle(sim, set, x, v, 1000 * (1 + spread * (2 * sph_rng_uniform(&rng) - 1)), NULL));
    }
    return sim;
}

static sph_config quiet_config(void)
{
    sph_config c = open_config(EDGE, DX);
    c.books = true;
    c.viscosity = SPH_INVISCID;
    c.dt = 1e-5;
    for (int k = 0; k < SPH_DIM; k++)
        c.gravity[k] = 1.5 - k;
    return c;
}

static void what_leaves_takes_its_energy_along(void **state)
{
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++) {
        sph_config c = quiet_config();
        sph_totals t;
        c.on_leave = SPH_REMOVE;
        c.hi[0] = EDGE;
        c.integrator = integrator;
        sph_sim *sim = thrown(&c, 40, 0.02);
        const double drift = drift_of(sim, 200, &t);
        print_message("integrator %u: carried off %.4g J, unexplained %.2g\n", integrator, t.carried_off, drift);
        assert_true(t.carried_off > 0.5 * t.removed_mass * 30 * 30 && t.removed_mass > 0);
        close_to(drift, 0, 2e-3 * t.carried_off);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void what_is_put_back_or_removed_at_a_wall_is_on_the_books(void **state)
{
    (void)state;
    for (int removes = 0; removes < 2; removes++) {
        sph_config c = quiet_config();
        sph_wall w = sph_wall_default();
        sph_totals t;
        double lo[SPH_DIM], hi[SPH_DIM];
        c.on_cross = removes ? SPH_REMOVE : SPH_PUT_BACK;
        w.kind = SPH_WALL_MONAGHAN_KOS;
        w.strength = 1e-3; /* as good as not there */
        for (int k = 0; k < SPH_DIM; k++) {
            lo[k] = -0.4 * EDGE;
            hi[k] = EDGE;
        }
        lo[0] = 0.5 * DX - 1e-3;
        c.on_leave = SPH_REMOVE;
        sph_sim *sim = thrown(&c, -40, 0.02);
        must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
        const double drift = drift_of(sim, 20, &t), taken = removes ? t.carried_off : t.put_back_loss;
        print_message("%s: %.4g J, unexplained %.2g\n", removes ? "removed" : "put back", taken, drift);
        assert_true(taken > 0.1 * t.kinetic / N);
        close_to(drift, 0, 5e-3 * taken);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void what_filter_and_damping_take_is_on_the_books(void **state)
{
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++)
        for (int damps = 0; damps < 2; damps++) {
            sph_config c = quiet_config();
            sph_totals t;
            c.integrator = integrator;
            c.shepard_every = damps ? 0 : 3;
            c.damping = damps ? 0.99 : 1;
            sph_sim *sim = thrown(&c, damps ? 3 : 0, damps ? 0 : 0.05);
            const double drift = drift_of(sim, 30, &t), taken = damps ? t.damped : t.filtered;
            print_message("integrator %u: %s %.4g J, unexplained %.2g\n", integrator, damps ? "damped" : "filtered",
                          taken, drift);
            assert_true(taken > 0.02 * (t.kinetic + t.internal));
            close_to(drift, 0, 0.01 * taken);
            assert_int_equal(free_sims(NULL), 0);
        }
}

#if SPH_DIM > 1
/* a block in tension that cracks; and what a cracked block holds is its share */
static void damage_lets_go_of_what_the_books_say(void **state)
{
    const sph_solid m = {.shear = MU, .crack_speed = 20};
    const sph_flaws f = {.k = 1e9, .m = 4, .seed = 1};
    sph_config c = solid_config(SPH_UPDATED, SPH_PREDICTOR_CORRECTOR, 2 * EDGE, DX);
    sph_totals t;
    uint32_t set;
    (void)state;
    c.max_particles = N * N * (SPH_DIM == 3 ? N : 1);
    c.damage = SPH_BENZ_ASPHAUG;
    c.max_flaws = 20 * c.max_particles;
    c.books = true;
    c.dt = 1e-5;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    add_block(sim, set, N, DX, 0);
    must(sim, sph_add_flaws(sim, set, &f));
    set_density(sim, -0.03);
    const double drift = drift_of(sim, 100, &t);
    print_message("released %.4g J of %.4g, unexplained %.2g\n", t.released, t.internal + t.elastic, drift);
    assert_true(t.released > (SPH_DIM == 2 ? 0.05 : 1e-4) * (t.internal + t.elastic)); /* D goes as t^SPH_DIM */
    close_to(drift, 0, 0.01 * t.released + 1e-4 * (t.internal + t.elastic));
    for (int cracked = 0; cracked < 2; cracked++) {
        const double held = t.internal;
        for (uint32_t i = 0; i < sph_count(sim); i++)
            sim->buf[sim->cur].damage[0][i] = (sph_real)(cracked ? SPH_DIM == 2 ? sqrt(0.75) : cbrt(0.75) : 0);
        set_density(sim, -0.03);
        sph_get_totals(sim, &t);
        if (cracked)
            close_to(t.internal, 0.25 * held, 1e-6 * held);
    }
}
#endif

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(the_books_of_a_fluid_balance_at_every_instant),
#if SPH_DOUBLE
        subject(the_books_balance_where_density_is_summed),
#endif
        subject(the_books_of_solids_balance_at_every_instant),
        subject(what_leaves_takes_its_energy_along),
        subject(what_is_put_back_or_removed_at_a_wall_is_on_the_books),
        subject(what_filter_and_damping_take_is_on_the_books),
#if SPH_DIM > 1
        subject(damage_lets_go_of_what_the_books_say),
#endif
    };
    return run_subjects("balance", list);
}
