/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_density_gradient.c: density diffusion after Antuono leaves every linear density as it is, inside, at the free
   surface, beside walls, over mirrors and beside another fluid; moves mass from one to another and makes none; takes
   bumps down; and gives the same bits any way. */
#include "any_way.h"

#include "sph/internal.h"

#define DX 0.1
#define CELLS (SPH_DIM == 1 ? 60u : SPH_DIM == 2 ? 14u : 9u)
#define EDGE (CELLS * DX)
#define LAST (SPH_DIM - 1)
/* a density is known to a rounding; the rate is that over h/(2 delta c), times the inverse of E, of 30 neighbours */
#define ROUNDING (SPH_DOUBLE ? 1e-11 : 4e-3) /* of what Molteni's diffusion does */

static sph_config diffusing(uint32_t way)
{
    sph_config c = open_config(EDGE, DX);
    c.smoothing_length = 1.4 * DX;
    c.viscosity = SPH_INVISCID;
    c.diffusion = way;
    c.delta = 0.2;
    c.books = true;
    return c;
}

/* d of the density 1 + d, linear in the place */
typedef struct slope {
    double at[3];
} slope;
static double linear(const slope *s, const double *x)
{
    double d = 0;
    for (int k = 0; k < SPH_DIM; k++)
        d += s->at[k] * (x[k] / EDGE - 0.5);
    return d;
}

/* a jittered block at rest; columns from `other` on are of the second set and slope */
static void add_water(sph_sim *sim, const uint32_t *set, const slope *s, const double *rho0, uint32_t other)
{
    sph_rng rng;
    sph_rng_seed(&rng, 3, 7);
    for (uint32_t i = 0; i < (SPH_DIM == 1 ? CELLS : SPH_DIM == 2 ? CELLS * CELLS : CELLS * CELLS * CELLS); i++) {
        const double v[3] = {0};
        double x[3] = {0};
        const uint32_t of = i % CELLS >= other;
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= CELLS)
            x[k] = (at % CELLS + 0.5 + 0.2 * (2 * sph_rng_uniform(&rng) - 1)) * DX;
        must(sim, sph_add_particle(sim, set[of], x, v, rho0[of] * (1 + linear(&s[of], x)), NULL));
    }
}

/* the largest rate of a relative density (1/s), and the sum of volumes that the fluid gains (m^DIM/s) */
static double largest_rate(const sph_sim *sim, double *gain)
{
    double most = 0;
    *gain = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        if (p.role != SPH_ROLE_FLUID)
            continue;
        const double rate = (double)sim->buf[sim->cur].drho[0][i];
        most = fmax(most, fabs(rate));
        *gain += p.mass / p.rho * rate;
    }
    return most;
}

static slope some_slope(sph_rng *rng)
{
    slope s;
    for (int k = 0; k < 3; k++)
        s.at[k] = 0.1 * (2 * sph_rng_uniform(rng) - 1);
    return s;
}

static double rate_of_linear(uint32_t way, uint32_t trial, double *gain)
{
    static const uint32_t schemes[] = {SPH_STANDARD, SPH_WEAK}, kinds[] = {SPH_WALL_ADAMI, SPH_WALL_GHOST, SPH_WALLS};
    sph_config c = diffusing(way);
    const uint32_t kind = kinds[trial % 3];
    const double lo[3] = {0}, hi[3] = {EDGE, EDGE, EDGE}, rho0[2] = {1000, 1000};
    sph_wall wall = sph_wall_default();
    sph_rng rng;
    uint32_t set[2];
    sph_rng_seed(&rng, trial, 1);
    const slope s[2] = {some_slope(&rng), {{0}}};
    c.scheme = schemes[trial / 3 % 2];
    c.gradient = trial / 6 % 2 ? SPH_BONET_LOK : SPH_PLAIN;
    c.kernel = trial & 1 ? SPH_CUBIC : SPH_WENDLAND_C2;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set[0]));
    add_water(sim, set, s, rho0, CELLS);
    wall.kind = kind;
    if (kind < SPH_WALLS)
        must(sim, sph_add_wall_box(sim, &wall, lo, hi, SPH_LOW(0) | SPH_LOW(LAST), true, NULL));
    must(sim, sph_ready(sim));
    const double most = largest_rate(sim, gain);
    assert_int_equal(free_sims(NULL), 0);
    return most;
}
static void a_linear_density_stays_at_surfaces_and_beside_walls(void **state)
{
    (void)state;
    for (uint32_t trial = 0; trial < 12; trial++) {
        double gain;
        const double plain = rate_of_linear(SPH_MOLTENI, trial, &gain);
        close_to(rate_of_linear(SPH_ANTUONO, trial, &gain), 0, ROUNDING * plain);
    }
}

/* gravity pulls across one mirror and along others; the density goes with it */
static void water_at_rest_feels_nothing_over_a_mirror(void **state)
{
    const slope down = {{SPH_DIM == 1 ? -0.05 : 0, SPH_DIM == 2 ? -0.05 : 0, SPH_DIM == 3 ? -0.05 : 0}};
    (void)state;
    for (uint32_t face = SPH_SYMMETRY; face <= SPH_MIRROR_NO_SLIP; face++) {
        double most[2], gain;
        for (uint32_t k = 0; k < 2; k++) {
            sph_config c = diffusing(k ? SPH_ANTUONO : SPH_MOLTENI);
            const slope s[2] = {down, {{0}}};
            const double rho0[2] = {1000, 1000};
            uint32_t set[2];
            for (int a = 0; a < SPH_DIM; a++) {
                c.lo[a] = 0;
                c.face[a][0] = face;
            }
            c.gravity[LAST] = -9.81;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set[0]));
            add_water(sim, set, s, rho0, CELLS);
            must(sim, sph_ready(sim));
            most[k] = largest_rate(sim, &gain);
            assert_int_equal(free_sims(NULL), 0);
        }
        close_to(most[1], 0, ROUNDING * most[0]);
    }
}

#if SPH_WITH_SEVERAL_FLUIDS
static void each_of_two_fluids_keeps_its_own_slope(void **state)
{
    double most[2], gain;
    (void)state;
    for (uint32_t k = 0; k < 2; k++) {
        sph_config c = diffusing(k ? SPH_ANTUONO : SPH_MOLTENI);
        const sph_fluid oil = {.rho0 = 600, .sound_speed = 15};
        const double rho0[2] = {1000, 600};
        const slope s[2] = {{{0.05, -0.03, 0.02}}, {{-0.08, 0.01, 0.04}}};
        uint32_t set[2];
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set[0]));
        must(sim, sph_add_fluid(sim, &oil, &set[1]));
        add_water(sim, set, s, rho0, CELLS / 2);
        must(sim, sph_ready(sim));
        most[k] = largest_rate(sim, &gain);
        assert_int_equal(free_sims(NULL), 0);
    }
    close_to(most[1], 0, ROUNDING * most[0]);
}
#endif

/* whatever the densities are, through periodic faces and planes of symmetry too */
static void what_one_gains_another_loses(void **state)
{
    (void)state;
    for (uint32_t face = SPH_OPEN; face <= SPH_SYMMETRY; face++) {
        sph_config c = face ? periodic_config(EDGE, DX) : diffusing(SPH_ANTUONO);
        double gain;
        uint32_t set;
        c.diffusion = SPH_ANTUONO;
        c.viscosity = SPH_INVISCID;
        c.delta = 0.2;
        for (int k = 0; k < SPH_DIM; k++)
            c.face[k][0] = c.face[k][1] = face;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        random_cloud(sim, set, CELLS, DX, 0.3, 0, 20);
        must(sim, sph_ready(sim));
        const double most = largest_rate(sim, &gain);
        assert_true(most > 0);
        close_to(gain, 0, (SPH_DOUBLE ? 1e-14 : 1e-5) * most * pow(EDGE, SPH_DIM));
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a pair alone knows of no slope: it feels what it feels after Molteni */
static void a_pair_alone_diffuses_after_molteni(void **state)
{
    double rate[2], gain;
    (void)state;
    for (uint32_t k = 0; k < 2; k++) {
        sph_config c = diffusing(k ? SPH_ANTUONO : SPH_MOLTENI);
        const double v[3] = {0};
        uint32_t set;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        for (uint32_t i = 0; i < 2; i++) {
            const double x[3] = {0.5 + 2.5 * DX * i, 0.5, 0.5};
            must(sim, sph_add_particle(sim, set, x, v, 1000 + 10 * i, NULL));
        }
        must(sim, sph_ready(sim));
        rate[k] = largest_rate(sim, &gain);
        assert_int_equal(free_sims(NULL), 0);
    }
    assert_true(rate[0] > 0 && !(rate[0] < rate[1]) && !(rate[1] < rate[0]));
}

/* the shortest waves, at a surface and in disorder, for a thousand steps at the step that is allowed */
static void the_step_that_is_allowed_is_stable(void **state)
{
    (void)state;
    for (uint32_t integrator = 0; integrator <= SPH_KICK_DRIFT_KICK; integrator++) {
        sph_config c = diffusing(SPH_ANTUONO);
        sph_totals first, last;
        uint32_t set;
        c.delta = 2;
        c.cfl = 10;
        c.integrator = integrator;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        random_cloud(sim, set, CELLS, DX, 0.2, 0, 1);
        must(sim, sph_ready(sim));
        sph_get_totals(sim, &first);
        for (uint32_t k = 0; k < 200; k++)
            must(sim, sph_step(sim));
        sph_get_totals(sim, &last);
        assert_true(last.max_density - last.min_density < first.max_density - first.min_density);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static sph_sim *tank(const sph_config *c)
{
    const double lo[3] = {0}, hi[3] = {EDGE, EDGE, EDGE};
    const sph_wall wall = sph_wall_default();
    uint32_t set;
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    random_cloud(sim, set, CELLS, DX, 0.2, 0.5, 5);
    if (c->face[LAST][0] == SPH_OPEN)
        must(sim, sph_add_wall_box(sim, &wall, lo, hi, SPH_LOW(LAST), true, NULL));
    must(sim, sph_ready(sim));
    return sim;
}
static void the_same_bits_any_way(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        sph_config c = diffusing(SPH_ANTUONO);
        c.integrator = i & 1 ? SPH_KICK_DRIFT_KICK : SPH_PREDICTOR_CORRECTOR;
        c.gravity[LAST] = -9.81;
        c.gradient = i & 1 ? SPH_BONET_LOK : SPH_PLAIN;
        if (i & 2) {
            c.lo[LAST] = 0;
            c.face[LAST][0] = SPH_SYMMETRY;
        }
        same_bits_any_way(c, tank, 6);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void solids_do_not_have_it(void **state)
{
    sph_report r;
    sph_config c = diffusing(SPH_ANTUONO);
    (void)state;
    assert_int_equal(sph_config_check(&c, &r), SPH_OK);
    c.solid = SPH_UPDATED;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "diffusion");
    c.solid = SPH_NO_SOLID;
    c.diffusion = SPH_DIFFUSIONS;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
}

static void the_arena_has_room_by_the_constant(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < 2; k++) {
        sph_config c = diffusing(SPH_ANTUONO);
        uint32_t cells = 1;
        c.shear = k ? SPH_SMAGORINSKY : SPH_NO_SHEAR;
        c.max_threads = 7;
        for (int a = 0; a < SPH_DIM; a++)
            cells *= (uint32_t)((c.hi[a] - c.lo[a]) / (2 * c.smoothing_length));
        const uint32_t use = SPH_USE_ANTUONO | SPH_USE_BOOKS | (k ? SPH_USE_SHEAR : 0);
        assert_true(sph_arena_bytes(&c) <= SPH_ARENA_BYTES(c.max_particles, cells, c.max_threads, use));
        const size_t with = sph_arena_bytes(&c);
        c.diffusion = SPH_MOLTENI;
        const size_t least = SPH_DIM * (size_t)c.max_particles * sizeof(sph_real);
        assert_true(with >= sph_arena_bytes(&c) + least);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_linear_density_stays_at_surfaces_and_beside_walls),
        subject(water_at_rest_feels_nothing_over_a_mirror),
#if SPH_WITH_SEVERAL_FLUIDS
        subject(each_of_two_fluids_keeps_its_own_slope),
#endif
        subject(what_one_gains_another_loses),
        subject(a_pair_alone_diffuses_after_molteni),
        subject(the_step_that_is_allowed_is_stable),
        subject(the_same_bits_any_way),
        subject(solids_do_not_have_it),
        subject(the_arena_has_room_by_the_constant),
    };
    return run_subjects("density_gradient", list);
}
