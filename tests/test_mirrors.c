/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_mirrors.c: what goes through a plane of symmetry. A scene before the plane is held against the whole one, with
   the mirrored twin of every particle and no plane: a particle that went through is its twin, with all that it has. */
#include "testing.h"

#define DX 0.1
#define N 4       /* particles of a row on one side of the plane */
#define STEPS 40u
enum { MOST = 4096 };

typedef struct choice {
    const char *name;
    uint32_t solid, integrator;
    double xsph, nu;
    bool damage, yield;
} choice;

static sph_config config_of(const choice *c, bool whole)
{
    sph_config o = open_config(2, DX);
    o.lo[0] = whole ? -2 : 0;
    o.hi[0] = 2;
    o.face[0][0] = whole ? SPH_OPEN : SPH_SYMMETRY;
    o.smoothing_length = 1.3 * DX;
    o.solid = c->solid;
    o.integrator = c->integrator;
    o.xsph = c->xsph;
    o.viscosity = c->nu > 0 ? SPH_MORRIS : SPH_ARTIFICIAL;
    o.nu = c->nu;
    o.alpha = 0.1;
    o.yield = c->yield ? SPH_VON_MISES : SPH_NO_YIELD;
    o.max_particles = MOST;
    o.max_stretch = c->solid == SPH_TOTAL ? 1.6 : o.max_stretch;
    o.dt = 2e-4;
    return o;
}

/* a block beside the plane, some of whose particles fly through it; two of them stand on it */
static sph_sim *build(const choice *c, bool whole)
{
    const sph_config cfg = config_of(c, whole);
    sph_sim *sim = new_sim(&cfg);
    const sph_solid rock = {.shear = 1e5, .yield = c->yield ? 3e3 : 0};
    uint32_t set, total = 1;
    sph_rng rng;
    if (c->solid)
        must(sim, sph_add_solid(sim, &rock, &set, NULL));
    else
        must(sim, sph_add_fluid(sim, NULL, &set));
    sph_rng_seed(&rng, 7, 1);
    for (int k = 0; k < SPH_DIM; k++)
        total *= N;
    for (uint32_t i = 0; i < total; i++) {
        double x[SPH_DIM], v[SPH_DIM];
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= N) {
            x[k] = (at % N + 0.5 + 0.2 * (2 * sph_rng_uniform(&rng) - 1)) * DX;
            v[k] = 2 * (2 * sph_rng_uniform(&rng) - 1);
        }
        if (i % N == 0) { /* next to the plane, in both scenes at a whole number of quanta */
            x[0] = i % (2 * N) == 0 ? ldexp(1, -9) : i == N ? 0 : 2 * DX;
            v[0] = -4;
        }
        if (i == N + 1 || i == 1) /* at rest: what it is turned by is not its velocity */
            memset(v, 0, sizeof v);
        must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
        x[0] = -x[0], v[0] = -v[0];
        if (whole)
            must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
    }
    return sim;
}

/* how far a particle is from another in all that the scene has; v, a and stress in units of the scene */
static double apart(const sph_particle *p, const sph_particle *q)
{
    double d = fabs(p->rho - q->rho) / 1000;
    for (int k = 0; k < SPH_DIM; k++)
        d += fabs(p->x[k] - q->x[k]) / DX + fabs(p->v[k] - q->v[k]) + fabs(p->a[k] - q->a[k]) / 1e4;
    for (int k = 0; k < 6; k++)
        d += fabs(p->stress[k] - q->stress[k]) / 1e4;
    return d + fabs(p->plastic - q->plastic);
}

/* particle i of the scene before the plane is 2i or 2i + 1 of the whole one: returns how far it is from the nearer */
static double compare(const sph_sim *half, const sph_sim *whole, uint32_t *through, double *shear)
{
    double worst = 0;
    for (uint32_t i = 0; i < sph_count(half); i++) {
        const sph_particle p = by_id(half, i), own = by_id(whole, 2 * i), twin = by_id(whole, 2 * i + 1);
        const bool went = own.x[0] < twin.x[0];
        const double d = apart(&p, went ? &twin : &own);
        worst = d > worst ? d : worst;
        *through += went;
        *shear = went && SPH_DIM > 1 ? fmax(*shear, fabs(p.stress[3])) : *shear;
    }
    return worst;
}

/* rounding; a wrong sign is of order 1 */
#define ROUNDING (SPH_DOUBLE ? 1e-11 : 2e-2)

static void same_as_whole(const choice *c)
{
    sph_sim *half = build(c, false), *whole = build(c, true);
    uint32_t through = 0;
    double shear = 0, worst = 0;
    for (uint32_t k = 0; k < STEPS; k++) {
        must(half, sph_step(half));
        must(whole, sph_step(whole));
        worst = fmax(worst, compare(half, whole, &through, &shear));
    }
    if (!(worst < ROUNDING))
        fail_msg("%s, integrator %u: %g apart", c->name, c->integrator, worst);
    assert_true(through > (SPH_DIM > 1 ? 20 : 0) || (SPH_DIM == 1 && c->xsph > 0)); /* XSPH stops a lone one */
    assert_true(!c->solid || SPH_DIM == 1 || shear > 100);
    assert_int_equal(free_sims(NULL), 0);
}

static void what_goes_through_a_plane_of_symmetry_is_its_mirrored_twin(void **state)
{
    static const choice list[] = {
        {"water", .nu = 0.01},
        {"water, XSPH", .xsph = 0.9},
        {"updated", .solid = SPH_UPDATED},
        {"updated, XSPH, yield", .solid = SPH_UPDATED, .xsph = 0.5, .yield = true},
        {"corrected", .solid = SPH_CORRECTED},
        {"total", .solid = SPH_TOTAL},
        {"total, XSPH", .solid = SPH_TOTAL, .xsph = 0.5},
    };
    (void)state;
    for (size_t k = 0; k < sizeof list / sizeof *list; k++)
        for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
            choice c = list[k];
            c.integrator = i;
            same_as_whole(&c);
        }
}

/* A particle on the plane that XSPH slows down goes back into the domain by v + u, and its rates are those of where it
   was half a step before: at x - dt/2 (v + u) with u turned, as its velocity was. */
static void rates_beside_a_plane_know_which_way_xsph_went(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        const choice c = {"one particle", .integrator = i, .xsph = 0.9};
        double rho[2];
        for (int w = 0; w < 2; w++) {
            const sph_config cfg = config_of(&c, w);
            const double x[3] = {0, DX, DX}, v[3] = {-3, 0, 0}, back[3] = {3, 0, 0};
            sph_sim *sim = new_sim(&cfg);
            uint32_t set;
            must(sim, sph_add_fluid(sim, NULL, &set));
            must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
            if (w)
                must(sim, sph_add_particle(sim, set, x, back, 1000, NULL));
            must(sim, sph_step(sim));
            rho[w] = by_id(sim, 0).rho;
        }
        close_to(rho[0], rho[1], 10 * 1000 * EPS);
        assert_true(fabs(rho[0] - 1000) > 1e-3 || i == SPH_PREDICTOR_CORRECTOR || i >= SPH_RUNGE_KUTTA);
        assert_int_equal(free_sims(NULL), 0);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(what_goes_through_a_plane_of_symmetry_is_its_mirrored_twin),
        subject(rates_beside_a_plane_know_which_way_xsph_went),
    };
    return run_subjects("mirrors", list);
}
