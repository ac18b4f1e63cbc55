/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_gradient.c: corrected gradients of fluids against sums over all pairs in double, and what they are for: exact
   rates of linear velocities, momentum, angular momentum and energy; and where neighbours do not span space, the plain
   gradient. */
#include "testing.h"

#include "examples/scenes/scene.h"
#include "sph/internal.h"

#define N (SPH_DIM == 1 ? 60u : SPH_DIM == 2 ? 16u : 11u)
#define DX 0.1
#define MOST 6000
/* a term of a sum rounds to a few eps of its size, the inverse of a tensor, whose condition is below 50, to more */
#define ROUNDING (64 * EPS)

static const uint32_t schemes[] = {SPH_STANDARD, SPH_WEAK};

/* ---- the sums over all pairs, in double ----

   E_i = -sum V_j x_ij (x) x_ij g, V_j = m_j/rho_i (standard) or m_j/rho_j (weak), B_i = E_i^-1, P = p/rho^2 or p:
     Bonet & Lok     drho_i = sum w_d v_ij . B_i x_ij g      a_i = -sum w_a (P_i B_i + P_j B_j) x_ij g
     renormalised    the same with (B_i + B_j)/2 for B_i and B_j; viscosity along it too
   with w_d = m_j or m_j rho_i/rho_j, w_a = m_j or m_j/(rho_i rho_j). A ghost has B = I, renormalised its partner's. */
typedef struct place {
    double x[3], v[3], m, rho, p, drho, a[3]; /* drho, a: what the kernel made of it */
    double b[3][3], rate, acc[3];             /* what it should make */
    double rate_size, acc_size;               /* sums of magnitudes */
    bool body, corrected;
} place;
static place at[MOST];
static uint32_t places, own; /* own: those that are no images */

static void read_places(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    places = own = sph_count(sim);
    assert_true(places > 0 && places <= MOST);
    memset(at, 0, sizeof at);
    for (uint32_t i = 0; i < places; i++) {
        sph_particle p;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        for (int k = 0; k < SPH_DIM; k++) {
            at[i].x[k] = p.x[k];
            at[i].v[k] = p.v[k];
            at[i].a[k] = p.a[k];
        }
        at[i].m = p.mass;
        at[i].rho = p.rho;
        at[i].p = p.p;
        at[i].drho = (double)b->drho[0][i] * sim->set[p.set].rho0;
        at[i].body = p.role == SPH_ROLE_FLUID;
    }
}

/* determinant and adjugate */
static double adjugate(double m[3][3], double adj[3][3])
{
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3, c = (l + 1) % 3, d = (l + 2) % 3;
            adj[l][k] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    return m[0][0] * adj[0][0] + m[0][1] * adj[1][0] + m[0][2] * adj[2][0];
}

/* x_ij, and g at its length; false beyond the support. steep: g at nine tenths of it, larger, what its rounding is
   measured by, because near the support's end g falls steeply to 0 */
static bool pair_of(const sph_config *c, uint32_t i, uint32_t j, double *x, double *g, double *steep)
{
    const double h = c->smoothing_length;
    double r = 0, w, dw;
    for (int k = 0; k < 3; k++) {
        x[k] = at[i].x[k] - at[j].x[k];
        r += x[k] * x[k];
    }
    r = sqrt(r);
    if (i == j || r >= h * 3)
        return false;
    assert_int_equal(sph_kernel_value(c->kernel, 0.9 * r, h, &w, &dw), SPH_OK);
    *steep = -dw / (0.9 * r);
    assert_int_equal(sph_kernel_value(c->kernel, r, h, &w, &dw), SPH_OK);
    *g = dw / r;
    return true;
}

static void find_correction(const sph_config *c, uint32_t i)
{
    double e[3][3] = {{0}}, adj[3][3], x[3], g, steep, size = 0;
    for (uint32_t j = 0; j < places; j++) {
        if (!pair_of(c, i, j, x, &g, &steep))
            continue;
        const double v = at[j].m / (c->scheme == SPH_WEAK ? at[j].rho : at[i].rho);
        for (int k = 0; k < 9; k++)
            e[k / 3][k % 3] -= v * g * x[k / 3] * x[k % 3];
    }
    for (int k = 0; k < 9; k++)
        size += e[k / 3][k % 3] * e[k / 3][k % 3];
    for (int k = SPH_DIM; k < 3; k++)
        e[k][k] = 1;
    const double det = adjugate(e, adj);
    at[i].corrected = at[i].body && c->gradient != SPH_PLAIN && det > pow(0.6 * pow(2, -SPH_DIM), SPH_DIM) &&
                      det > 1e-3 * pow(size / SPH_DIM, 0.5 * SPH_DIM);
    for (int k = 0; k < 9; k++)
        at[i].b[k / 3][k % 3] = at[i].corrected ? adj[k / 3][k % 3] / det : k % 4 == 0;
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static double length(const double *a) { return sqrt(dot(a, a)); }
static void times_vector(double b[3][3], const double *x, double *y)
{
    for (int k = 0; k < 3; k++)
        y[k] = dot(b[k], x);
}

/* the vectors of a pair: of the rate of i, of the force by the pressures of i and of j, of viscosity */
static void vectors_of(const sph_config *c, uint32_t i, uint32_t j, const double *x, double *rate, double *ti,
                       double *tj, double *ev)
{
    times_vector(at[i].b, x, ti);
    times_vector(at[j].b, x, tj);
    memcpy(ev, x, 3 * sizeof *x);
    if (c->gradient == SPH_RENORMALISED) {
        const double a = !at[i].body ? 0 : !at[j].body ? 1 : 0.5;
        for (int k = 0; k < 3; k++)
            ev[k] = ti[k] = tj[k] = a * ti[k] + (1 - a) * tj[k];
    }
    memcpy(rate, ti, 3 * sizeof *x);
}

/* what all others do to place i; walls without slip friction, one sound speed, beta 0 */
static void find_rates(const sph_config *c, uint32_t i)
{
    const bool weak = c->scheme == SPH_WEAK;
    const double h = c->smoothing_length;
    double x[3], rate[3], ti[3], tj[3], ev[3], v[3], g, steep;
    for (uint32_t j = 0; j < places; j++) {
        if (!(at[i].body || at[j].body) || !pair_of(c, i, j, x, &g, &steep))
            continue;
        vectors_of(c, i, j, x, rate, ti, tj, ev);
        const double m = at[j].m, ri = at[i].rho, rj = at[j].rho;
        const double wd = m * (weak ? ri / rj : 1), wa = m * (weak ? 1 / (ri * rj) : 1);
        const double pi = at[i].p / (weak ? 1 : ri * ri), pj = at[j].p / (weak ? 1 : rj * rj);
        for (int k = 0; k < 3; k++)
            v[k] = at[i].v[k] - at[j].v[k];
        const double mu = dot(v, x) * h / (dot(x, x) + 0.01 * h * h);
        const double visc = c->viscosity == SPH_ARTIFICIAL && at[i].body && at[j].body
                                ? -c->alpha * c->sound_speed * mu * 2 / (ri + rj) : 0;
        at[i].rate += wd * dot(v, rate) * g;
        at[i].rate_size += wd * steep * (length(at[i].v) + length(at[j].v)) * length(rate);
        for (int k = 0; k < 3; k++)
            at[i].acc[k] -= (wa * (pi * ti[k] + pj * tj[k]) + m * visc * ev[k]) * g;
        at[i].acc_size += steep * wa * (fabs(pi) * length(ti) + fabs(pj) * length(tj));
        at[i].acc_size += steep * fabs(visc) * m * length(ev);
    }
}

/* all places once more, behind a mirror at the low end of the first axis or a period further on */
static void add_images(bool mirror, double shift)
{
    assert_true(places + own <= MOST);
    for (uint32_t i = 0; i < own; i++, places++) {
        at[places] = at[i];
        at[places].x[0] = (mirror ? -1 : 1) * at[i].x[0] + shift;
        at[places].v[0] = (mirror ? -1 : 1) * at[i].v[0];
    }
}

static void find_all(const sph_sim *sim)
{
    const sph_config *const c = &sim->cfg;
    const bool periodic = c->face[0][0] == SPH_PERIODIC;
    read_places(sim);
    if (c->face[0][0] == SPH_SYMMETRY)
        add_images(true, 0);
    for (int k = -1; periodic && k < 2; k += 2)
        add_images(false, k * (c->hi[0] - c->lo[0]));
    for (uint32_t i = 0; i < (periodic ? own : places); i++)
        find_correction(c, i);
    for (uint32_t i = own; periodic && i < places; i++)
        memcpy(at[i].b, at[i % own].b, sizeof at[i].b);
    for (uint32_t i = 0; i < own; i++)
        find_rates(c, i);
    places = own;
}

/* ---- set-ups ---- */

static sph_config gradient_config(uint32_t form, uint32_t scheme)
{
    sph_config c = open_config(N * DX, DX);
    c.gradient = form;
    c.scheme = scheme;
    c.viscosity = SPH_INVISCID;
    c.books = true;
    return c;
}

typedef struct linear {
    double (*a)[3], stream;
} linear;
static void linear_velocity(void *ctx, const double *x, double *v, double *rho)
{
    const linear *l = ctx;
    double at_x[3] = {0}, w[3];
    (void)rho;
    memcpy(at_x, x, SPH_DIM * sizeof *x);
    times_vector(l->a, at_x, w);
    memcpy(v, w, SPH_DIM * sizeof *v);
    v[0] += l->stream;
}

/* a jittered cloud of random densities, with the velocity A x, across a seam with a stream besides */
static sph_sim *linear_cloud(const sph_config *c, uint32_t n, double a[3][3], double jitter, double drho)
{
    sph_sim *sim = new_sim(c);
    sph_rng rng;
    uint32_t set, total = 1;
    sph_rng_seed(&rng, 5, n);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (int k = 0; k < SPH_DIM; k++)
        total *= n;
    for (uint32_t i = 0; i < total; i++) {
        double x[SPH_DIM];
        uint32_t rest = i;
        for (int k = 0; k < SPH_DIM; k++, rest /= n)
            x[k] = (rest % n + 0.5 + jitter * (2 * sph_rng_uniform(&rng) - 1)) * DX;
        must(sim, sph_add_particle(sim, set, x, NULL, 1000 + drho * (2 * sph_rng_uniform(&rng) - 1), NULL));
    }
    linear l = {a, c->face[0][0] == SPH_PERIODIC ? 0.5 : 0};
    must(sim, sph_apply_field(sim, set, linear_velocity, &l));
    must(sim, sph_ready(sim));
    return sim;
}

static double trace(double a[3][3])
{
    double t = 0;
    for (int k = 0; k < SPH_DIM; k++)
        t += a[k][k];
    return t;
}

/* largest error of the rate of density of a linear velocity, in parts of its own size */
static double off_rate(const sph_sim *sim, double a[3][3])
{
    double worst = 0;
    find_all(sim);
    for (uint32_t i = 0; i < places; i++) {
        assert_true(at[i].rate_size > 0);
        worst = fmax(worst, fabs(at[i].drho + at[i].rho * trace(a)) / at[i].rate_size);
    }
    return worst;
}

/* ---- the equations ---- */

/* walls too: those whose density goes by continuity have a rate of their own, from bodies alone */
static void check_rates(const sph_sim *sim)
{
    uint32_t corrected = 0;
    find_all(sim);
    for (uint32_t i = 0; i < places; i++) {
        const bool continues = !at[i].body && at[i].drho != 0;
        corrected += at[i].corrected;
        if (at[i].body || continues)
            close_to(at[i].drho, at[i].rate, ROUNDING * at[i].rate_size);
        for (int k = 0; k < SPH_DIM && at[i].body; k++)
            close_to(at[i].a[k], at[i].acc[k], ROUNDING * at[i].acc_size);
    }
    assert_true(corrected > 10 || sim->cfg.gradient == SPH_PLAIN);
}

static void rates_are_those_of_the_sums_over_all_pairs(void **state)
{
    static const uint32_t kernels[] = {SPH_WENDLAND_C2, SPH_CUBIC, SPH_QUINTIC};
    (void)state;
    for (uint32_t form = 0; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++)
            for (int k = 0; k < 3; k++) {
                sph_config c = gradient_config(form, schemes[s]);
                uint32_t set;
                c.kernel = kernels[k];
                c.viscosity = k == 2 ? SPH_INVISCID : SPH_ARTIFICIAL;
                c.alpha = 0.3;
                c.books = k > 0;
                sph_sim *sim = new_sim(&c);
                must(sim, sph_add_fluid(sim, NULL, &set));
                random_cloud(sim, set, N - 3, DX, 0.15, 0.5, 20);
                must(sim, sph_ready(sim));
                check_rates(sim);
                assert_int_equal(free_sims(NULL), 0);
            }
}

static void rates_beside_seams_and_mirrors_are_those_of_the_sums(void **state)
{
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++)
            for (int mirror = 0; mirror < 2; mirror++) {
                sph_config c = gradient_config(form, schemes[s]);
                uint32_t set;
                c.lo[0] = 0;
                c.hi[0] = mirror ? c.hi[0] : N * DX;
                c.face[0][0] = mirror ? SPH_SYMMETRY : SPH_PERIODIC;
                c.face[0][1] = mirror ? SPH_OPEN : SPH_PERIODIC;
                sph_sim *sim = new_sim(&c);
                must(sim, sph_add_fluid(sim, NULL, &set));
                random_cloud(sim, set, N, DX, 0.15, 0.5, 20);
                must(sim, sph_ready(sim));
                check_rates(sim);
                assert_int_equal(free_sims(NULL), 0);
            }
}

static void steady(void *ctx, double t, double *x, double *v)
{
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = ((const double *)ctx)[k];
        x[k] = v[k] * t;
    }
}
static double wall_speed[] = {0.3, -0.2, 0.1};
#define TANK (SPH_DIM == 3 ? 6u : SPH_DIM == 2 ? 12u : 30u)

/* jittered water in a closed box that moves; ghosts begin with densities of their own */
static sph_sim *tank(sph_config c, uint32_t kind, bool compressible, bool no_slip)
{
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM];
    sph_wall w = sph_wall_default();
    sph_rng rng;
    w.kind = kind;
    w.compressible = compressible;
    w.no_slip = no_slip;
    w.motion = steady;
    w.motion_ctx = wall_speed;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0, hi[k] = TANK * DX;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    random_cloud(sim, set, TANK, DX, 0.15, 0.5, 20);
    must(sim, sph_add_wall_box(sim, &w, lo, hi, (1u << (2 * SPH_DIM)) - 1, true, NULL));
    sph_rng_seed(&rng, 3, 3);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sim->set[sim->buf[sim->cur].set[0][i]].role == SPH_ROLE_GHOST)
            sim->buf[sim->cur].rho[0][i] = (sph_real)(0.01 * sph_rng_uniform(&rng));
    must(sim, sph_ready(sim));
    return sim;
}

static void rates_beside_moving_walls_are_those_of_the_sums(void **state)
{
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++)
            for (int w = 0; w < 3; w++) {
                sph_config c = gradient_config(form, schemes[s]);
                c.viscosity = w == 1 ? SPH_ARTIFICIAL : SPH_INVISCID;
                check_rates(tank(c, w == 2 ? SPH_WALL_ADAMI : SPH_WALL_GHOST, w == 1, false));
                uint32_t rated = 0;
                for (uint32_t i = 0; i < places; i++)
                    rated += !at[i].body && at[i].drho != 0;
                assert_true(w == 1 ? rated > 3 : w == 2 || rated == 0); /* Adami's walls keep their density there */
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* ---- linear velocities ---- */

static double field[3][3] = {{0.7, -0.4, 0.2}, {0.5, 0.3, -0.6}, {-0.2, 0.9, 0.8}};

/* inside, at free surfaces and in corners */
static void the_rate_of_a_linear_velocity_is_exact(void **state)
{
    static const uint32_t kernels[] = {SPH_WENDLAND_C2, SPH_CUBIC, SPH_QUINTIC};
    (void)state;
    for (int s = 0; s < 2; s++)
        for (int k = 0; k < 6; k++) {
            sph_config c = gradient_config(SPH_BONET_LOK, schemes[s]);
            c.kernel = kernels[k / 2];
            c.gradient_guard = k & 1;
            const double off = off_rate(linear_cloud(&c, N, field, 0.15, 20), field);
            for (uint32_t i = 0; i < places; i++)
                assert_true(at[i].corrected);
            assert_true(off < ROUNDING);
            assert_int_equal(free_sims(NULL), 0);
        }
    sph_config c = gradient_config(SPH_PLAIN, SPH_STANDARD);
    assert_true(off_rate(linear_cloud(&c, N, field, 0.15, 20), field) > 1e-3); /* which the plain gradient is not */
}

/* velocities that do not change along the periodic axis; in 1-D a translation */
static void it_is_exact_across_a_seam(void **state)
{
    double a[3][3];
    (void)state;
    memcpy(a, field, sizeof a);
    for (int k = 0; k < 3; k++)
        a[k][0] = 0;
    for (int s = 0; s < 2; s++) {
        sph_config c = gradient_config(SPH_BONET_LOK, schemes[s]);
        c.lo[0] = 0;
        c.hi[0] = N * DX;
        c.face[0][0] = c.face[0][1] = SPH_PERIODIC;
        assert_true(off_rate(linear_cloud(&c, N, a, 0.15, 20), a) < ROUNDING);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* velocities that are their own picture in the mirror */
static void it_is_exact_beside_a_mirror(void **state)
{
    double a[3][3];
    (void)state;
    memcpy(a, field, sizeof a);
    for (int k = 1; k < 3; k++)
        a[k][0] = a[0][k] = 0;
    for (int s = 0; s < 2; s++) {
        sph_config c = gradient_config(SPH_BONET_LOK, schemes[s]);
        c.lo[0] = 0;
        c.face[0][0] = SPH_SYMMETRY;
        assert_true(off_rate(linear_cloud(&c, N, a, 0.15, 20), a) < ROUNDING);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* with B_i and B_j averaged it is exact only where they are equal: two supports from the surface of a lattice */
static void renormalised_rates_are_exact_only_where_neighbours_agree(void **state)
{
    (void)state;
    for (int s = 0; s < 2; s++) {
        sph_config c = gradient_config(SPH_RENORMALISED, schemes[s]);
        uint32_t inside = 0;
        assert_true(off_rate(linear_cloud(&c, N, field, 0, 0), field) > 1e-3);
        for (uint32_t i = 0; i < places; i++) {
            bool inner = true;
            for (int k = 0; k < SPH_DIM; k++)
                inner &= at[i].x[k] > 4 * DX && at[i].x[k] < (N - 4) * DX;
            inside += inner;
            if (inner)
                close_to(at[i].drho, -at[i].rho * trace(field), ROUNDING * at[i].rate_size);
        }
        assert_true(inside > 0);
        assert_int_equal(free_sims(NULL), 0);
        assert_true(off_rate(linear_cloud(&c, N, field, 0.15, 20), field) > 1e-3);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- what is kept ---- */

static sph_sim *free_block(uint32_t form, uint32_t scheme, bool viscous)
{
    sph_config c = gradient_config(form, scheme);
    uint32_t set;
    c.viscosity = viscous ? SPH_ARTIFICIAL : SPH_INVISCID;
    c.alpha = 0.3;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    random_cloud(sim, set, N, DX, 0.15, 0.5, 20);
    must(sim, sph_ready(sim));
    find_all(sim);
    return sim;
}

/* sums of m a and x cross m a, and of their sizes: of so many terms the roundings mostly cancel, 0.03 eps are left */
static void momenta(double *force, double *torque, double *size, double *torque_size)
{
    memset(force, 0, 3 * sizeof *force);
    memset(torque, 0, 3 * sizeof *torque);
    *size = *torque_size = 0;
    for (uint32_t i = 0; i < places; i++) {
        const place *p = &at[i];
        for (int k = 0; k < 3 && p->body; k++) {
            force[k] += p->m * p->a[k];
            torque[k] += p->m * (p->x[(k + 1) % 3] * p->a[(k + 2) % 3] - p->x[(k + 2) % 3] * p->a[(k + 1) % 3]);
        }
        *size += p->m * p->acc_size;
        *torque_size += p->m * p->acc_size * length(p->x);
    }
}

static void momentum_stays_and_after_bonet_and_lok_angular_momentum(void **state)
{
    double force[3], torque[3], size, torque_size;
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++)
            for (int viscous = 0; viscous < 2; viscous++) {
                free_block(form, schemes[s], viscous);
                momenta(force, torque, &size, &torque_size);
                assert_true(size > 0);
                for (int k = 0; k < 3; k++)
                    close_to(force[k], 0, EPS * size);
                for (int k = 0; k < 3 && form == SPH_BONET_LOK; k++)
                    close_to(torque[k], 0, EPS * torque_size);
                if (form == SPH_RENORMALISED && SPH_DIM > 1)
                    assert_true(length(torque) > 5e-6 * torque_size);
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* the power of all that is found, kinetic and of compression (ghosts have no kinetic energy), and its size */
static double gained(double *size)
{
    double sum = 0;
    *size = 0;
    for (uint32_t i = 0; i < places; i++) {
        const place *p = &at[i];
        const double compression = p->p / (p->rho * p->rho);
        sum += p->m * (compression * p->drho + (p->body ? dot(p->v, p->a) : 0));
        *size += p->m * (fabs(compression) * p->rate_size + (p->body ? length(p->v) * p->acc_size : 0));
    }
    return sum;
}

/* what viscosity takes is on the books */
static void energy_stays_at_every_instant(void **state)
{
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++)
            for (int viscous = 0; viscous < 2; viscous++) {
                double size;
                const sph_sim *sim = free_block(form, schemes[s], viscous);
                const double gain = gained(&size), taken = sim->now.power[0];
                assert_true(size > 0 && (viscous ? taken > 1e-3 * size : taken == 0));
                close_to(gain, -taken, ROUNDING * size);
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* power on the books: that of the force on all bodies (their own forces cancel) at the wall's velocity */
static void a_moving_wall_works_as_the_books_say(void **state)
{
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++)
            for (int w = 0; w < 5; w++) {
                sph_config c = gradient_config(form, schemes[s]);
                c.viscosity = w == 4 ? SPH_MORRIS : SPH_ARTIFICIAL;
                c.nu = 0.05;
                sph_sim *sim = tank(c, w < 2 ? SPH_WALL_GHOST : SPH_WALL_ADAMI, w == 1, w == 1 || w > 2);
                for (int k = 0; k < 3; k++) {
                    double power = 0, size = 0;
                    find_all(sim);
                    for (uint32_t i = 0; i < places; i++)
                        if (at[i].body) {
                            power += at[i].m * dot(at[i].a, wall_speed);
                            size += at[i].m * length(wall_speed) * (at[i].acc_size + length(at[i].a));
                        }
                    assert_true(fabs(power) > 10 * ROUNDING * size);
                    close_to(sim->now.power[1], power, ROUNDING * size);
                    must(sim, sph_step(sim));
                }
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* with walls whose density goes by continuity, and which take compression, nothing else is gained */
static void energy_stays_beside_walls_that_are_compressed(void **state)
{
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++) {
            double size;
            sph_sim *sim = tank(gradient_config(form, schemes[s]), SPH_WALL_GHOST, true, false);
            find_all(sim);
            const double gain = gained(&size);
            close_to(gain, sim->now.power[1], ROUNDING * size);
            assert_true(fabs(gain) > 10 * ROUNDING * size);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* ---- where neighbours do not span space ---- */

#define FAR 1.9999
/* in smoothing lengths: alone, a pair, a line, three and four as far apart as is seen, four in a plane */
static const struct {
    uint32_t n;
    double x[4][3];
    int least; /* dimension from which on it does not span space */
} few[] = {
    {1, {{0}}, 1},
    {2, {{0}, {FAR}}, 1},
    {2, {{0}, {0.8}}, 2},
    {3, {{0}, {0.8}, {1.7}}, 2},
    {3, {{0}, {0.6, 0.6}, {-0.7, -0.7}}, 2},
    {3, {{0}, {FAR}, {FAR / 2, FAR * 0.8660254}}, 2},
    {3, {{0}, {0.8}, {0.4, 0.7}}, 3},
    {4, {{0}, {0.8}, {0.1, 0.9}, {0.9, 0.8}}, 3},
    {4, {{0}, {FAR}, {FAR / 2, FAR * 0.8660254}, {FAR / 2, FAR * 0.2886751, FAR * 0.8164966}}, 3},
};

static sph_sim *few_of(uint32_t form, uint32_t scheme, uint32_t which)
{
    sph_config c = gradient_config(form, scheme);
    uint32_t set;
    c.eos = SPH_LINEAR;
    c.kernel = SPH_CUBIC;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (uint32_t i = 0; i < few[which].n; i++) {
        double x[3], v[3] = {0.3 * i, 0.1 - 0.2 * i, 0.2 * i * i};
        for (int k = 0; k < 3; k++)
            x[k] = few[which].x[i][k] * c.smoothing_length + 0.3;
        must(sim, sph_add_particle(sim, set, x, v, 750, NULL)); /* p = -1e5 Pa */
    }
    must(sim, sph_ready(sim));
    return sim;
}

static void without_neighbours_all_around_the_gradient_is_plain(void **state)
{
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (int s = 0; s < 2; s++)
            for (uint32_t w = 0; w < sizeof few / sizeof few[0]; w++) {
                if (SPH_DIM < few[w].least)
                    continue;
                sph_sim *sim = few_of(form, schemes[s], w), *plain = few_of(SPH_PLAIN, schemes[s], w);
                find_all(plain);
                for (uint32_t i = 0; i < few[w].n; i++) {
                    const sph_particle p = by_id(sim, i), q = by_id(plain, i);
                    for (int k = 0; k < SPH_DIM; k++)
                        close_to(p.a[k], q.a[k], ROUNDING * at[i].acc_size);
                    close_to((double)sim->buf[sim->cur].drho[0][i], (double)plain->buf[plain->cur].drho[0][i],
                             ROUNDING * at[i].rate_size / 1000);
                }
                for (int k = 0; k < 5; k++)
                    must(sim, sph_step(sim)); /* whatever is not finite fails */
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* ---- what is refused, and what a failed step leaves ---- */

static void refused(const sph_config *c, const char *what)
{
    sph_report r;
    assert_int_equal(sph_config_check(c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, what);
    assert_true(sph_arena_bytes(c) == 0);
}

static void what_does_not_go_together_is_refused_by_name(void **state)
{
    sph_report r;
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++) {
        sph_config c = gradient_config(form, SPH_STANDARD);
        assert_int_equal(sph_config_check(&c, &r), SPH_OK);
        c.solid = SPH_UPDATED;
        refused(&c, "gradient");
        c = gradient_config(form, SPH_STANDARD);
        c.density = SPH_SUMMATION;
        refused(&c, "density");
    }
    for (uint32_t scheme = 0; scheme < SPH_SCHEMES; scheme++) {
        sph_config c = gradient_config(SPH_RENORMALISED, scheme);
        assert_int_equal(sph_config_check(&c, &r), SPH_OK);
        c.gradient = SPH_BONET_LOK;
        if (scheme == SPH_STANDARD || scheme == SPH_WEAK)
            assert_int_equal(sph_config_check(&c, &r), SPH_OK);
        else
            refused(&c, "scheme");
    }
    sph_config c = gradient_config(SPH_GRADIENTS, SPH_STANDARD);
    refused(&c, "gradient");
    c = gradient_config(SPH_RENORMALISED, SPH_STANDARD);
    c.gradient_guard = true;
    refused(&c, "gradient_guard");
}

static bool poisoned;
static void poison(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    if (poisoned && x[0] > 0.5 * N * DX)
        a[0] = NAN;
}

static void a_failed_step_leaves_no_trace(void **state)
{
    (void)state;
    for (uint32_t form = SPH_BONET_LOK; form < SPH_GRADIENTS; form++)
        for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
            uint64_t hash[2];
            for (int fails = 0; fails < 2; fails++) {
                sph_config c = gradient_config(form, SPH_STANDARD);
                uint32_t set;
                c.integrator = i;
                c.body_force = poison;
                sph_sim *sim = new_sim(&c);
                must(sim, sph_add_fluid(sim, NULL, &set));
                random_cloud(sim, set, N / 2 + 2, DX, 0.15, 0.5, 20);
                for (int k = 0; k < 3; k++) {
                    must(sim, sph_step(sim));
                    hash[fails] = sph_hash(sim);
                    poisoned = fails;
                    if (fails)
                        assert_int_equal(sph_step(sim), SPH_NOT_FINITE);
                    poisoned = false;
                    assert_true(sph_hash(sim) == hash[fails]);
                }
                assert_int_equal(free_sims(NULL), 0);
            }
            assert_true(hash[0] == hash[1]);
        }
}

/* ---- the guard beside a surface ---- */

/* Two supports below a surface the force is the whole one; at a flat surface of a lattice, where det E is 0.37, it has
   no more than a fourth of the correction. The sum of all forces stays 0. */
static void the_guard_acts_at_surfaces_alone_and_keeps_momentum(void **state)
{
    (void)state;
    for (int s = 0; s < 2; s++) {
        sph_config c = gradient_config(SPH_BONET_LOK, schemes[s]);
        static sph_particle whole[MOST];
        double force[3] = {0}, size = 0;
        uint32_t same = 0, other = 0;
        for (int k = 0; k < 2; k++) {
            c.gradient_guard = k;
            sph_sim *sim = linear_cloud(&c, N, field, 0, 20);
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                sph_particle p;
                bool inner = true;
                double off = 0, a = 0;
                assert_int_equal(sph_get(sim, i, &p), SPH_OK);
                for (int b = 0; b < SPH_DIM; b++) {
                    inner &= p.x[b] > 5 * DX && p.x[b] < (N - 5) * DX;
                    off = fmax(off, fabs(p.a[b] - whole[i].a[b]));
                    force[b] += k ? p.mass * p.a[b] : 0;
                    a += p.mass * fabs(p.a[b]);
                }
                size += a;
                same += k && inner && !(off > 0);
                other += k && !inner && off > 0;
                assert_true(!k || !inner || !(off > 0));
                whole[i] = p;
            }
            assert_int_equal(free_sims(NULL), 0);
        }
        assert_true(same > 0 && other > 0);
        for (int b = 0; b < 3; b++)
            close_to(force[b], 0, EPS * size * 30);
    }
}

#if SPH_DIM == 2
/* The row below the surface leaves its place, particle by particle, where the force has the whole correction: the tank
   of scene still_water without viscosity and diffusion, 8 particles deep. */
static double restless(bool guard)
{
    const scene *s = NULL;
    double p[64];
    sph_config c;
    sph_totals t;
    for (const scene *const *k = scene_table; *k; k++)
        s = strcmp((*k)->name, "still_water") == 0 ? *k : s;
    assert_non_null(s);
    for (uint32_t i = 0; i < s->params; i++)
        p[i] = strcmp(s->param[i].name, "n") == 0 ? 8 : strcmp(s->param[i].name, "sound") == 0 ? 10 : s->param[i].value;
    p[SCENE_OF_books] = p[SCENE_OF_alpha] = p[SCENE_OF_diffusion] = 0;
    p[SCENE_OF_gradient] = SPH_BONET_LOK;
    p[SCENE_OF_gradient_guard] = guard;
    s->configure(p, &c);
    sph_sim *sim = new_sim(&c);
    must(sim, s->build(sim, p));
    while (sph_time(sim) < 4.5)
        must(sim, sph_step_to(sim, 4.5));
    sph_get_totals(sim, &t);
    assert_int_equal(free_sims(NULL), 0);
    return t.kinetic;
}
static void with_it_water_at_rest_stays_so(void **state)
{
    const double whole = restless(false), guarded = restless(true);
    (void)state;
    printf("kinetic energy after 4.5 s: %.2g J/m, with the guard %.2g\n", whole, guarded);
    assert_true(guarded < 0.2 * whole);
}
#endif

/* waves beside a surface are about twice as fast with corrected gradients */
static void they_bound_the_courant_number(void **state)
{
    static const double most[] = {0.25, 0.9, 0.9, 1.2, 1.2};
    (void)state;
    for (uint32_t k = 0; k < SPH_INTEGRATORS; k++)
        for (uint32_t g = SPH_PLAIN; g < SPH_GRADIENTS; g++) {
            sph_config c = periodic_config(1, 0.125);
            uint32_t set;
            sph_step_info info;
            c.integrator = k;
            c.gradient = g;
            c.viscosity = SPH_INVISCID;
            c.cfl = 1.2;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set));
            must(sim, sph_add_box(sim, set, c.lo, c.hi, NULL));
            must(sim, sph_step(sim));
            sph_get_step(sim, &info);
            const double want = g ? most[k] : k ? 1.2 : 0.5;
            assert_true(fabs(info.limit_dt[SPH_LIMIT_COURANT] / (want * c.smoothing_length / 20) - 1) < 1e-6);
            assert_int_equal(free_sims(NULL), 0);
        }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(they_bound_the_courant_number),
        subject(rates_are_those_of_the_sums_over_all_pairs),
        subject(rates_beside_seams_and_mirrors_are_those_of_the_sums),
        subject(rates_beside_moving_walls_are_those_of_the_sums),
        subject(the_rate_of_a_linear_velocity_is_exact),
        subject(it_is_exact_across_a_seam),
        subject(it_is_exact_beside_a_mirror),
        subject(renormalised_rates_are_exact_only_where_neighbours_agree),
        subject(momentum_stays_and_after_bonet_and_lok_angular_momentum),
        subject(energy_stays_at_every_instant),
        subject(a_moving_wall_works_as_the_books_say),
        subject(energy_stays_beside_walls_that_are_compressed),
        subject(without_neighbours_all_around_the_gradient_is_plain),
        subject(what_does_not_go_together_is_refused_by_name),
        subject(a_failed_step_leaves_no_trace),
        subject(the_guard_acts_at_surfaces_alone_and_keeps_momentum),
#if SPH_DIM == 2
        subject(with_it_water_at_rest_stays_so),
#endif
    };
    return run_subjects("gradient", list);
}
