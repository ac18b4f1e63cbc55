/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_smoothing_length.c: a smoothing length of each particle: what it is, that a gas of one density feels nothing of
   it, that the same gas on another scale does the same, momentum and energy, limits of the step, what is refused; that
   slices, threads and restarts change no bit. */
#include "any_way.h"

#include "sph/internal.h"

#define DX 0.1
#define CELLS (SPH_DIM == 1 ? 40u : SPH_DIM == 2 ? 12u : 9u)
#define WIDEST (SPH_DIM == 3 ? 1.2 : 1.5)

static sph_config gas(double eta)
{
    sph_config c = periodic_config(CELLS * DX, DX);
    c.eos = SPH_IDEAL_GAS;
    c.energy = true;
    c.variable_h = true;
    c.h_max = WIDEST;
    c.smoothing_length = eta * DX;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.alpha = 0.5;
    c.beta = 1;
    return c;
}

static sph_sim *cloud(const sph_config *c, double speed, double drho)
{
    uint32_t set;
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    random_cloud(sim, set, (uint32_t)(c->hi[0] / DX + 0.5), DX, 0.1, speed, drho);
    must(sim, sph_ready(sim));
    return sim;
}

/* eta (m/rho)^(1/DIM) between its bounds, of sets of other masses too */
static void h_goes_by_the_volume_of_a_particle(void **state)
{
    sph_config c = open_config(1, DX);
    const double least = 0.7, rho[6] = {1000, 800, 1300, 400, 9000, 1001};
    uint32_t set;
    (void)state;
    c.eos = SPH_IDEAL_GAS;
    c.energy = c.variable_h = true;
    c.h_min = least;
    c.h_max = 1.25;
    sph_sim *sim = new_sim(&c);
    for (uint32_t k = 0; k < 6; k++) {
        const double mass = (k % 2 ? 1.5 : 1) * c.rho0 * pow(DX, SPH_DIM), x[3] = {0.15 * k + 0.1, 0.5, 0.5};
        const sph_fluid own = {.mass = mass};
        must(sim, sph_add_fluid(sim, &own, &set));
        must(sim, sph_add_particle(sim, set, x, NULL, rho[k], NULL));
        const double eta = c.smoothing_length / DX, h = eta * pow(mass / rho[k], 1.0 / SPH_DIM);
        const double bound = fmin(fmax(h, least * c.smoothing_length), 1.25 * c.smoothing_length);
        close_to(by_id(sim, k).h / bound, 1, 4 * EPS);
    }
    assert_true(by_id(sim, 4).h < 0.71 * c.smoothing_length);
    c.variable_h = false;
    sph_sim *one = new_sim(&c);
    must(one, sph_add_fluid(one, NULL, &set));
    must(one, sph_add_particle(one, set, (const double[3]){0.5, 0.5, 0.5}, NULL, 500, NULL));
    close_to(by_id(one, 0).h, c.smoothing_length, 0);
}

/* every particle has the volume of the configuration's: the same forces as with one h */
static void gas_of_one_density_feels_nothing_of_it(void **state)
{
    (void)state;
    for (uint32_t kernel = 0; kernel < SPH_KERNELS; kernel++) {
        sph_config c = gas(1.2);
        c.kernel = kernel;
        c.h_max = 1;
        c.dt = 1e-18;
        if (kernel == SPH_HAT || sph_config_check(&c, NULL) != SPH_OK)
            continue; /* a cone ends with a step; too wide for the box */
        double most = 0, fastest = 0;
        sph_sim *own = cloud(&c, 0, 0);
        c.variable_h = false;
        sph_sim *one = cloud(&c, 0, 0);
        must(own, sph_step(own));
        must(one, sph_step(one));
        for (uint32_t id = 0; id < sph_count(own); id++) {
            const sph_particle p = by_id(own, id), q = by_id(one, id);
            for (int k = 0; k < SPH_DIM; k++) {
                most = fmax(most, fabs(p.a[k] - q.a[k]));
                fastest = fmax(fastest, fabs(q.a[k]));
            }
        }
        assert_true(fastest > 1 && most < 100 * EPS * fastest);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a gas of random places, velocities and densities in the middle of a wide box, all lengths times `scale` */
static sph_sim *scaled(double scale, bool varies)
{
    enum { N = SPH_DIM == 1 ? 16 : SPH_DIM == 2 ? 8 : 5 };
    sph_config c = open_config(1, DX);
    uint32_t set;
    sph_rng rng;
    c.eos = SPH_IDEAL_GAS;
    c.energy = true;
    c.variable_h = varies;
    c.h_min = 0.2;
    c.h_max = 3;
    c.viscosity = SPH_ARTIFICIAL;
    c.alpha = 0.7;
    c.beta = 1.1;
    c.dt = 1e-18; /* forces of where they are */
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    sph_rng_seed(&rng, 5, 1);
    for (uint32_t i = 0, total = SPH_DIM == 1 ? N : SPH_DIM == 2 ? N * N : N * N * N; i < total; i++) {
        double x[SPH_DIM], v[SPH_DIM];
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= N) {
            x[k] = 0.1 + (at % N + 0.5 + 0.3 * sph_rng_uniform(&rng)) * DX * scale;
            v[k] = 30 * (sph_rng_uniform(&rng) - 0.5);
        }
        must(sim, sph_add_particle(sim, set, x, v, (700 + 600 * sph_rng_uniform(&rng)) / pow(scale, SPH_DIM), NULL));
    }
    must(sim, sph_step(sim));
    return sim;
}

/* The same velocities and energies on a scale s: K goes as s^-(DIM + 1) and density as s^-DIM, so accelerations and
   rates of energy go as 1/s, viscosity's too. With one h they do not. */
static void the_same_gas_on_another_scale_does_the_same(void **state)
{
    const double scale = 0.7;
    (void)state;
    for (int varies = 0; varies < 2; varies++) {
        sph_sim *a = scaled(1, varies), *b = scaled(scale, varies);
        double off = 0, size = 0;
        for (uint32_t id = 0; id < sph_count(a); id++) {
            const sph_particle p = by_id(a, id), q = by_id(b, id);
            for (int k = 0; k < SPH_DIM; k++) {
                off = fmax(off, fabs(q.a[k] * scale - p.a[k]));
                size = fmax(size, fabs(p.a[k]));
            }
        }
        if (varies) /* places are whole quanta */
            assert_true(off < (SPH_DOUBLE ? 1e-12 : 1e-4) * size);
        else
            assert_true(off > 0.1 * size);
    }
}

typedef struct outcome {
    double energy, entropy, least, momentum;
} outcome;
static double entropy_of(const sph_config *c, const sph_particle *p)
{
    return sph_log(p->energy) - (c->gamma - 1) * sph_log(p->rho / c->rho0);
}
static outcome run_cloud(sph_config c, uint32_t steps)
{
    static double before[4096];
    sph_totals a, b;
    c.dt = 0.1 * DX / c.sound_speed / steps;
    sph_sim *sim = cloud(&c, 2, 300);
    for (uint32_t id = 0; id < sph_count(sim); id++) {
        const sph_particle p = by_id(sim, id);
        before[id] = entropy_of(&c, &p);
    }
    sph_get_totals(sim, &a);
    make_steps(sim, 8 * steps);
    sph_get_totals(sim, &b);
    outcome o = {(b.kinetic + b.internal) / (a.kinetic + a.internal) - 1, 0, 1e300, 0};
    for (uint32_t id = 0; id < sph_count(sim); id++) {
        const sph_particle p = by_id(sim, id);
        const double risen = entropy_of(&c, &p) - before[id];
        o.entropy = fmax(o.entropy, fabs(risen));
        o.least = fmin(o.least, risen);
    }
    for (int k = 0; k < SPH_DIM; k++)
        o.momentum = fmax(o.momentum, fabs(b.momentum[k] - a.momentum[k]) / (b.mass * c.sound_speed));
    assert_int_equal(free_sims(NULL), 0);
    return o;
}

/* as with one h: without viscosity only the error of the steps is left, which falls with their square */
static void momentum_energy_and_entropy_stay(void **state)
{
    static const uint32_t schemes[] = {SPH_STANDARD, SPH_WEAK, SPH_STANDARD_WICK, SPH_WEAK_WICK};
    (void)state;
    for (uint32_t s = 0; s < 4; s++) {
        sph_config c = gas(1.2);
        c.scheme = schemes[s];
        c.viscosity = SPH_INVISCID;
        const outcome once = run_cloud(c, 1), twice = run_cloud(c, 2);
        assert_true(fabs(once.energy) < 2e-4 && once.momentum < 40 * EPS && twice.momentum < 40 * EPS);
        if (s < 2)
            assert_true(once.entropy < 1e-2);
        if (SPH_DOUBLE) {
            assert_true(fabs(once.energy) > 2.5 * fabs(twice.energy));
            assert_true(once.entropy > 2.5 * twice.entropy);
        }
    }
}

static void viscosity_never_lowers_entropy(void **state)
{
    (void)state;
    for (uint32_t v = SPH_ARTIFICIAL; v < SPH_VISCOSITIES; v++) {
        sph_config c = gas(1.2);
        c.scheme = SPH_WEAK;
        c.viscosity = v;
        c.nu = 0.3;
        const outcome o = run_cloud(c, 4);
        assert_true(o.entropy > 1e-4 && o.least > -2e-4 && fabs(o.energy) < 2e-4 && o.momentum < 100 * EPS);
    }
}

/* all of the gas is compressed to half of its lengths: h is half as large, and sound the same */
static void the_smallest_h_over_c_limits_the_step(void **state)
{
    double limit[2][3];
    (void)state;
    for (int dense = 0; dense < 2; dense++) {
        sph_config c = open_config(1, DX);
        sph_step_info info;
        uint32_t set;
        c.eos = SPH_IDEAL_GAS;
        c.energy = c.variable_h = true;
        c.viscosity = SPH_MORRIS;
        c.nu = 5;
        c.dt_max = 1e-9; /* they stay where they are */
        c.h_min = 0.5;
        c.gravity[0] = -1;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        for (uint32_t p = 0; p < 2; p++) {
            double x[3] = {0.5, 0.5, 0.5};
            x[0] += p * 0.5 * DX * (dense ? 0.5 : 1);
            must(sim, sph_add_particle(sim, set, x, NULL, dense ? c.rho0 * (1 << SPH_DIM) : c.rho0, NULL));
        }
        must(sim, sph_step(sim));
        sph_get_step(sim, &info);
        limit[dense][0] = info.limit_dt[SPH_LIMIT_COURANT];
        limit[dense][1] = info.limit_dt[SPH_LIMIT_FORCE];
        limit[dense][2] = info.limit_dt[SPH_LIMIT_VISCOUS];
        close_to(limit[dense][2] / (c.viscous_factor * 0.25 * c.smoothing_length * c.smoothing_length / c.nu), 1, 1e-6);
    }
    close_to(limit[0][0] / limit[1][0], 2, 0.3);
    close_to(limit[0][1] / limit[1][1], 2, 0.3); /* sqrt(h/a): half of h, twice of a */
}

static void refused(const sph_config *c, const char *what)
{
    sph_report r;
    assert_int_equal(sph_config_check(c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, what);
}

static void what_does_not_go_with_it_is_refused(void **state)
{
    sph_config c = gas(1.2);
    (void)state;
#define REFUSES(change, what)                                                                                      \
    c = gas(1.2);                                                                                                  \
    assert_int_equal(sph_config_check(&c, NULL), SPH_OK);                                                          \
    change;                                                                                                        \
    refused(&c, what);
    REFUSES(c.eos = SPH_TAIT, "variable_h")
    REFUSES(c.energy = false, "energy")
    REFUSES(c.density = SPH_SUMMATION; c.integrator = SPH_RUNGE_KUTTA, "variable_h")
    REFUSES(c.shepard_every = 5, "variable_h")
    REFUSES(c.gradient = SPH_BONET_LOK, "variable_h")
    REFUSES(c.shear = SPH_NESTED; c.nu = 1, "variable_h")
    REFUSES(c.diffusion = SPH_MOLTENI, "variable_h")
    REFUSES(c.xsph = 0.5, "variable_h")
    REFUSES(c.shifting = 0.5, "variable_h")
    REFUSES(c.h_min = 0.01, "h_min")
    REFUSES(c.h_max = 0.9, "h_max")
    REFUSES(c.h_max = 10, "hi") /* cells are of the widest */
#undef REFUSES
    c = gas(1.2);
    c.eos = SPH_TAIT;
    c.energy = false;
    refused(&c, "variable_h");
}

static sph_sim *stirred(const sph_config *c) { return cloud(c, 5, 300); }

static void slices_threads_and_restarts_change_nothing(void **state)
{
    static const uint32_t integrators[] = {SPH_PREDICTOR_CORRECTOR, SPH_KICK_DRIFT_KICK, SPH_LEAP_FROG,
                                           SPH_RUNGE_KUTTA};
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        sph_config c = gas(1.2);
        c.integrator = integrators[i];
        c.books = i % 2;
        for (int k = 0; k < SPH_DIM; k++) /* several chunks */
            c.hi[k] = (SPH_DIM == 1 ? 400 : SPH_DIM == 2 ? 36 : 11) * DX;
        c.face[0][0] = c.face[0][1] = i == 1 ? SPH_SYMMETRY : SPH_PERIODIC;
        same_bits_any_way(c, stirred, 6);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* the constant of sph.h is enough, and a particle costs no more than it says */
static void memory_is_what_the_constant_says(void **state)
{
    sph_config c = gas(1.2);
    double cells = 1;
    (void)state;
    c.integrator = SPH_KICK_DRIFT_KICK;
    for (uint32_t n = 1; n < 100000; n *= 10) {
        c.max_particles = n;
        for (int k = 0; k < SPH_DIM; k++)
            cells = k ? cells * floor(CELLS / (2.4 * WIDEST)) : floor(CELLS / (2.4 * WIDEST));
        const size_t need = sph_arena_bytes(&c);
        assert_true(need > 0 && need <= SPH_ARENA_BYTES(n, cells, 1, SPH_USE_ENERGY | SPH_USE_VARIABLE_H));
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(h_goes_by_the_volume_of_a_particle),
        subject(gas_of_one_density_feels_nothing_of_it),
        subject(the_same_gas_on_another_scale_does_the_same),
        subject(momentum_energy_and_entropy_stay),
        subject(viscosity_never_lowers_entropy),
        subject(the_smallest_h_over_c_limits_the_step),
        subject(what_does_not_go_with_it_is_refused),
        subject(slices_threads_and_restarts_change_nothing),
        subject(memory_is_what_the_constant_says),
    };
    return run_subjects("smoothing_length", list);
}
