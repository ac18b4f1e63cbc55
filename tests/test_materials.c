/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_materials.c: fluids of different rest density, sound speed and equation of state in one scene: filters and
   diffusion keep to one material, each has its own sound in step limits, viscosity and diffusion; and the hydrostatic
   diffusion over mirror faces. */
#include "testing.h"

#include "sph/internal.h"

#define N (SPH_DIM == 1 ? 40u : SPH_DIM == 2 ? 12u : 8u)
#define DX 0.1
#define LAST (SPH_DIM - 1)

/* density of a particle over the rest density of its set, less 1 */
static double excess(const sph_sim *sim, uint32_t i) { return (double)sim->buf[sim->cur].rho[0][i]; }
static double rate(const sph_sim *sim, uint32_t i) { return (double)sim->buf[sim->cur].drho[0][i]; }

/* two sets that share a block, the first below the middle of axis 0 */
static sph_sim *halves(const sph_config *c, const sph_fluid *one, const sph_fluid *other, uint32_t *set)
{
    sph_sim *sim = new_sim(c);
    double lo[SPH_DIM], hi[SPH_DIM];
    must(sim, sph_add_fluid(sim, one, &set[0]));
    must(sim, sph_add_fluid(sim, other, &set[1]));
    for (int s = 0; s < 2; s++) {
        for (int k = 0; k < SPH_DIM; k++) {
            lo[k] = k == 0 && s ? 0.5 * N * DX : 0;
            hi[k] = k == 0 && !s ? 0.5 * N * DX : N * DX;
        }
        must(sim, sph_add_box(sim, set[s], lo, hi, NULL));
    }
    return sim;
}

/* water and a light fluid at rest stay at rest, whatever smooths densities */
static void nothing_is_smoothed_between_two_fluids(void **state)
{
    (void)state;
    for (uint32_t way = 0; way < 3; way++)
        for (uint32_t scheme = SPH_STANDARD; scheme <= SPH_WEAK; scheme++) {
            sph_config c = open_config(N * DX, DX);
            const sph_fluid light = {.rho0 = 500};
            uint32_t set[2];
            c.scheme = scheme;
            c.shepard_every = way == 0;
            c.diffusion = way;
            sph_sim *sim = halves(&c, NULL, &light, set);
            for (int k = 0; k < 4; k++)
                must(sim, sph_step(sim));
            for (uint32_t i = 0; i < sph_count(sim); i++)
                close_to(excess(sim, i), 0, EPS);
            assert_int_equal(free_sims(NULL), 0);
        }
}

static void slope(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)v;
    *rho = 1000 + 3 * x[0];
}
/* a fluid that was added as two sets is one fluid: diffusion and filter do not see where they meet */
static void two_sets_of_one_material_are_one_fluid(void **state)
{
    (void)state;
    for (uint32_t way = 0; way < 3; way++) {
        static double found[2][20000];
        for (int parts = 1; parts < 3; parts++) {
            sph_config c = open_config(N * DX, DX);
            uint32_t set[2];
            c.diffusion = way;
            c.shepard_every = way == 0;
            c.dt = 1e-6;
            sph_sim *sim = halves(&c, NULL, NULL, set);
            must(sim, sph_apply_field(sim, set[0], slope, NULL));
            must(sim, sph_apply_field(sim, set[1], slope, NULL));
            sim->mixed = parts > 1; /* asked of pairs, or not */
            must(sim, sph_step(sim));
            must(sim, sph_step(sim));
            for (uint32_t i = 0; i < sph_count(sim); i++)
                found[parts - 1][i] = excess(sim, i);
            if (parts == 2)
                for (uint32_t i = 0; i < sph_count(sim); i++)
                    close_to(found[1][i], found[0][i], 4 * EPS * 0.01);
            assert_int_equal(free_sims(NULL), 0);
        }
    }
}

/* ---- each set has its own sound ---- */

static void steps_are_limited_by_each_sets_own_sound(void **state)
{
    const sph_fluid gray = {.sound_speed = 30, .own_eos = true, .eos = SPH_TAIT_GRAY}, slow = {.sound_speed = 10};
    (void)state;
    for (int which = 0; which < 3; which++) {
        sph_config c = open_config(N * DX, DX);
        sph_step_info info;
        uint32_t set[2];
        c.cfl = 0.2;
        c.integrator = SPH_KICK_DRIFT_KICK;
        c.eos = which == 2 ? SPH_TAIT_GRAY : SPH_TAIT;
        c.diffusion = SPH_MOLTENI;
        c.delta = 1.5;
        sph_sim *sim = which ? halves(&c, which == 1 ? &gray : &slow, &slow, set) : halves(&c, NULL, &slow, set);
        must(sim, sph_ready(sim));
        sph_get_step(sim, &info);
        const double h = c.smoothing_length, sound = which == 0 ? 20 : which == 1 ? 30 * sqrt(7) : 10 * sqrt(7);
        const double nominal = which == 0 ? 20 : which == 1 ? 30 : 10;
        close_to(info.limit_dt[SPH_LIMIT_COURANT], 0.2 * h / sound, 1e-12);
        close_to(info.limit_dt[SPH_LIMIT_DIFFUSIVE], 0.125 * h / (1.5 * nominal), 1e-12);
        assert_string_equal(sph_limit_text(SPH_LIMIT_DIFFUSIVE), "diffusion");
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* (dW/dr)/r */
static double grad(const sph_config *c, double r)
{
    double w, dw;
    assert_int_equal(sph_kernel_value(c->kernel, r, c->smoothing_length, &w, &dw), SPH_OK);
    return dw / r;
}

/* two particles without pressure that approach each other: Pi with the mean of both sound speeds */
static void viscosity_takes_the_mean_of_both_sounds(void **state)
{
    static const double sound[][2] = {{20, 20}, {40, 40}, {20, 50}, {10, 40}};
    (void)state;
    for (uint32_t q = 0; q < sizeof sound / sizeof *sound; q++) {
        sph_config c = open_config(N * DX, DX);
        double x[SPH_DIM] = {0}, v[SPH_DIM] = {0};
        c.alpha = 0.5;
        sph_sim *sim = new_sim(&c);
        for (int s = 0; s < 2; s++) {
            const sph_fluid f = {.sound_speed = sound[q][s]};
            uint32_t set;
            must(sim, sph_add_fluid(sim, &f, &set));
            x[0] = s * 0.11;
            v[0] = s ? -0.3 : 0.2;
            must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        }
        must(sim, sph_ready(sim));
        const double h = c.smoothing_length, mu = h * (-0.11 * 0.5) * -1 / (0.11 * 0.11 + 0.01 * h * h);
        const double pi = c.alpha * 0.5 * (sound[q][0] + sound[q][1]) * mu / 1000, m = 1000 * pow(DX, SPH_DIM);
        /* they are pushed apart */
        const double a = m * pi * grad(&c, 0.11) * 0.11;
        close_to(by_id(sim, 0).a[0], a, 64 * EPS * fabs(a));
        close_to(by_id(sim, 1).a[0], -a, 64 * EPS * fabs(a));
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void diffusion_goes_with_a_sets_own_sound(void **state)
{
    double sum[2] = {0, 0};
    (void)state;
    for (int s = 0; s < 2; s++) {
        sph_config c = open_config(N * DX, DX);
        const sph_fluid f = {.sound_speed = s ? 50 : 0}; /* 20 of the configuration */
        uint32_t set[2];
        c.diffusion = SPH_MOLTENI;
        sph_sim *sim = halves(&c, &f, &f, set);
        must(sim, sph_apply_field(sim, set[0], slope, NULL));
        must(sim, sph_ready(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++)
            sum[s] += fabs(rate(sim, i));
        assert_int_equal(free_sims(NULL), 0);
    }
    close_to(sum[1], 2.5 * sum[0], 64 * EPS * sum[1]);
}

/* ---- still water over a mirror ---- */

#define GRAVITY 9.81
typedef struct water {
    double rho0, sound;
} water;
/* with LINEAR the density of still water that the linearised difference belongs to: along axis 0 nothing, along the
   last rho0 g/c^2 a metre */
static void still(void *ctx, const double *x, double *v, double *rho)
{
    const water *w = ctx;
    (void)v;
    *rho = w->rho0 * (1 + GRAVITY * (N * DX - x[LAST]) / (w->sound * w->sound));
}
static void still_water_stays_still_over_a_mirror(void **state)
{
    (void)state;
    for (uint32_t face = SPH_SYMMETRY; face <= SPH_MIRROR_NO_SLIP; face++)
        for (int side = 0; side < 2; side++)
            for (int own = 0; own < 2; own++)
                for (uint32_t d = SPH_MOLTENI; d <= SPH_HYDROSTATIC; d++) {
                    sph_config c = open_config(N * DX, DX);
                    water w = {own ? 600 : 1000, own ? 35 : 20};
                    const sph_fluid f = {.rho0 = w.rho0, .sound_speed = w.sound};
                    uint32_t set;
                    double lo[SPH_DIM], hi[SPH_DIM], most = 0;
                    c.diffusion = d;
                    c.eos = SPH_LINEAR;
                    c.gravity[LAST] = -GRAVITY;
                    c.face[LAST][side] = face;
                    for (int k = 0; k < SPH_DIM; k++) {
                        lo[k] = 0;
                        hi[k] = N * DX;
                    }
                    c.lo[LAST] = side ? c.lo[LAST] : 0;
                    c.hi[LAST] = side ? N * DX : c.hi[LAST];
                    sph_sim *sim = new_sim(&c);
                    must(sim, sph_add_fluid(sim, &f, &set));
                    must(sim, sph_add_box(sim, set, lo, hi, NULL));
                    must(sim, sph_apply_field(sim, set, still, &w));
                    must(sim, sph_ready(sim));
                    for (uint32_t i = 0; i < sph_count(sim); i++)
                        most = fmax(most, fabs(rate(sim, i)));
                    /* a density rounds to eps; rates of differences go as 2 delta c/h */
                    const double round_off = 16 * EPS * 2 * c.delta * w.sound / c.smoothing_length;
                    if (d == SPH_MOLTENI)
                        assert_true(most > 100 * round_off || !SPH_DOUBLE);
                    else
                        close_to(most, 0, round_off);
                    assert_int_equal(free_sims(NULL), 0);
                }
}

/* ---- the step that diffusion stands ---- */

typedef struct roughness {
    sph_rng rng;
    double about; /* kg/m^3 */
} roughness;
static void rough(void *ctx, const double *x, double *v, double *rho)
{
    roughness *r = ctx;
    (void)x, (void)v;
    *rho = r->about * (1 + 1e-3 * (2 * sph_rng_uniform(&r->rng) - 1));
}
/* rough densities are smoothed by every integrator with whatever strength is allowed; of water that has lost half its
   density too, as spray does */
static void strong_diffusion_is_stable(void **state)
{
    static const double delta[] = {0.1, 1, 2, 10};
    (void)state;
    for (uint32_t run = 0; run < 2 * SPH_INTEGRATORS; run++)
        for (uint32_t q = 0; q < sizeof delta / sizeof *delta; q++) {
            sph_config c = periodic_config(N * DX, DX);
            roughness r;
            uint32_t set;
            double most = 0;
            r.about = run < SPH_INTEGRATORS ? 1000 : 500;
            c.integrator = run % SPH_INTEGRATORS;
            c.diffusion = SPH_MOLTENI;
            c.delta = delta[q];
            c.pressure_floor = true;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set));
            must(sim, sph_add_box(sim, set, c.lo, c.hi, NULL));
            sph_rng_seed(&r.rng, 3, 4);
            must(sim, sph_apply_field(sim, set, rough, &r));
            for (int k = 0; k < 200; k++)
                must(sim, sph_step(sim));
            for (uint32_t i = 0; i < sph_count(sim); i++)
                most = fmax(most, fabs((excess(sim, i) + 1) * 1000 / r.about - 1));
            print_message("integrator %u, delta %g, about %g: %.3g of 1e-3 left\n", c.integrator, delta[q], r.about,
                          most / 1e-3);
            assert_true(most < 1e-3);
            assert_int_equal(free_sims(NULL), 0);
        }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(nothing_is_smoothed_between_two_fluids),
        subject(two_sets_of_one_material_are_one_fluid),
        subject(steps_are_limited_by_each_sets_own_sound),
        subject(viscosity_takes_the_mean_of_both_sounds),
        subject(diffusion_goes_with_a_sets_own_sound),
        subject(still_water_stays_still_over_a_mirror),
        subject(strong_diffusion_is_stable),
    };
    return run_subjects("materials", list);
}
