/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_damage.c: flaws and the damage that grows from them, in 2-D and 3-D: growth in closed form, where it stops, what
   a broken particle carries, the statistics of flaws, and one pinned digest of a list of them for all builds and
   machines. */
#include "bodies.h"

#define DX 0.1
enum { EDGE = SPH_DIM == 2 ? 8 : 4, MANY = 1000 };
#define RATE 20.0 /* crack speed over flaw radius, 1/s */
#define DT 1e-3

static double youngs(double shear, double bulk) { return 9 * bulk * shear / (3 * bulk + shear); }
#define SOFT_BULK (RHO * SOFT_SPEED * SOFT_SPEED)

/* a soft block under a hydrostatic tension of `strain` times Young's modulus, at rest, with flaws */
static sph_sim *stretched(uint32_t damage, uint32_t integrator, double strain, const sph_flaws *flaws)
{
    sph_config c = solid_config(SPH_UPDATED, integrator, 2 * EDGE * DX, DX);
    sph_solid m = {.shear = SOFT_MU, .crack_speed = RATE * 0.05, .flaw_radius = 0.05};
    uint32_t set;
    c.sound_speed = SOFT_SPEED;
    c.dt = DT;
    c.damage = damage;
    c.max_flaws = 20 * MANY;
    sph_sim *sim = new_sim(&c);
    sph_rng_seed(&dice, 30, 1);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    add_block(sim, set, EDGE, DX, 0.1);
    must(sim, sph_add_flaws(sim, set, flaws));
    set_density(sim, -strain * youngs(SOFT_MU, SOFT_BULK) / SOFT_BULK);
    return sim;
}

/* how many flaws of a particle are active at a strain */
static uint32_t active_of(const sph_sim *sim, uint32_t id, double strain, uint32_t *flaws)
{
    float list[SPH_MAX_FLAWS];
    uint32_t active = 0;
    must(sim, sph_get_flaws(sim, id, flaws, list));
    for (uint32_t k = 0; k < *flaws; k++)
        active += (double)list[k] < strain;
    return active;
}
static double n_log_n(void) { return pow(EDGE, SPH_DIM) * log(pow(EDGE, SPH_DIM)); } /* of the block's particles */
static double root(double d) { return pow(d, 1.0 / SPH_DIM); }

/* all flaws active: D^(1/DIM) = flaws RATE t until the particle is broken, by every integrator */
static void damage_grows_as_active_flaws_do(void **state)
{
    const sph_flaws flaws = {1e30, 9, 7}; /* thresholds near (1/k)^(1/9) = 5e-4 */
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++) {
        sph_sim *sim = stretched(SPH_BENZ_ASPHAUG, integrator, 0.05, &flaws);
        bool broken = false;
        for (int step = 1; step <= 30; step++) {
            must(sim, sph_step(sim));
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                sph_particle p;
                uint32_t n;
                must(sim, sph_get(sim, i, &p));
                const uint32_t active = active_of(sim, p.id, 0.05, &n);
                assert_int_equal(active, n);
                const double want = fmin(1, n * RATE * DT * step);
                close_to(root(p.damage), want, 64 * EPS);
                if (n * RATE * DT * step > 1.01) { /* not by rounding */
                    assert_true(p.damage == 1);
                    broken = true;
                }
            }
        }
        assert_true(broken);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a strain between thresholds: only what is active grows, to (active/flaws)^(1/DIM) and no further; Gray's strain is
   another */
static void damage_stops_at_the_share_of_active_flaws(void **state)
{
    (void)state;
    for (uint32_t damage = SPH_BENZ_ASPHAUG; damage <= SPH_BENZ_ASPHAUG_GRAY; damage++) {
        const double volume = pow(EDGE * DX, SPH_DIM), e = youngs(SOFT_MU, SOFT_BULK), n_ln_n = n_log_n();
        const sph_flaws flaws = {n_ln_n / volume / pow(0.05, 3), 3, 21}; /* thresholds up to 0.05 */
        const double sigma = 0.03 * e, first = damage == SPH_BENZ_ASPHAUG ? 0.03 : sigma / (2 * SOFT_MU);
        sph_sim *sim = stretched(damage, SPH_KICK_DRIFT_KICK, 0.03, &flaws);
        uint32_t seen[SPH_MAX_FLAWS + 1] = {0}, stopped = 0;
        for (int step = 1; step <= 120; step++)
            must(sim, sph_step(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle p;
            uint32_t n, active;
            must(sim, sph_get(sim, i, &p));
            active = active_of(sim, p.id, first, &n);
            seen[active]++;
            if (damage == SPH_BENZ_ASPHAUG) {
                const double want = active == n ? 1 : pow(active / (double)n, 1.0 / SPH_DIM);
                close_to(root(p.damage), want, 8 * EPS);
                stopped += active > 0 && active < n;
            /* his strain changes with D: sigma (1 - D)/(2 mu (1 - D^2)) = sigma/(2 mu (1 + D)) falls as D grows */
            } else {
                const double strain = p.damage < 1 ? first / (1 + p.damage) : 0;
                const uint32_t now = active_of(sim, p.id, strain, &n);
                assert_true(root(p.damage) <= root(active / (double)n) * (1 + 8 * EPS));
                /* all that may has grown */
                assert_true(p.damage == 1 || root(p.damage) >= root(now / (double)n) * (1 - 8 * EPS));
                stopped += p.damage > 0 && p.damage < 1;
            }
        }
        assert_true(stopped > 3 && seen[0] > 0 && seen[1] > 0);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* the strain: the largest principal stress over Young's modulus, whatever the axes; a push grows nothing */
static void the_largest_principal_stress_counts(void **state)
{
    (void)state;
    for (int turn = 0; turn < 8; turn++) {
        const double e = youngs(SOFT_MU, SOFT_BULK), s = 0.02 * e;
        const double volume = pow(EDGE * DX, SPH_DIM), n_ln_n = n_log_n();
        const sph_flaws flaws = {n_ln_n / volume / pow(0.04, 2), 2, 3};
        sph_sim *sim = stretched(SPH_BENZ_ASPHAUG, SPH_KICK_DRIFT_KICK, 0, &flaws);
        /* principal stresses s, -2s/3 (and in 3-D -s/3): the sum makes the pressure */
        tensor p = {{{s, 0, 0}, {0, -2 * s / 3, 0}, {0, 0, -s / 3}}};
        const tensor r = SPH_DIM == 2 ? rotation(turn, 0, 0, 1) : rotation(turn, 1, turn, -2);
        set_all_stress(sim, conjugate(r, deviator(p)));
        const double none = turn == 7 ? 0.2 : 0; /* compressed so that nothing is in tension */
        set_density(sim, none * e / SOFT_BULK - trace_of(p) / 3 / SOFT_BULK);
        for (int k = 0; k < 100; k++)
            must(sim, sph_step(sim));
        uint32_t some = 0;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle q;
            uint32_t n, active;
            must(sim, sph_get(sim, i, &q));
            active = none > 0 ? 0 : active_of(sim, q.id, 0.02, &n);
            if (none > 0)
                assert_true(q.damage == 0);
            else
                close_to(root(q.damage), active == n ? 1 : root(active / (double)n), 8 * EPS);
            some += active > 0;
        }
        assert_true(some > 0 || none > 0);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a broken body: no tension and no shear, but pressure; half-broken: that share */
static void broken_particles_carry_pressure_only(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (int push = 0; push < 2; push++)
            for (int whole = 0; whole < 2; whole++) {
                sph_config c = solid_config(form, SPH_KICK_DRIFT_KICK, 2 * EDGE * DX, DX);
                sph_solid m = {.shear = 1e5};
                uint32_t set;
                c.damage = SPH_BENZ_ASPHAUG;
                c.max_flaws = 10;
                sph_sim *sim = new_sim(&c);
                sph_rng_seed(&dice, 31, 1);
                must(sim, sph_add_solid(sim, &m, &set, NULL));
                add_block(sim, set, EDGE, DX, 0.1);
                const tensor s = toss_deviator(1e4);
                set_all_stress(sim, s);
                set_density(sim, push ? 0.02 : -0.02);
                const sph_real kept = (sph_real)(whole ? 0.6 : 1);
                for (uint32_t i = 0; i < sph_count(sim); i++)
                    sim->buf[sim->cur].damage[0][i] = kept;
                must(sim, sph_ready(sim));
                double most = 0;
                const double left = whole ? 1 - pow((double)kept, SPH_DIM) : 0, p = (push ? 0.02 : -0.02) * RHO * 400;
                for (uint32_t i = 0; i < sph_count(sim); i++) {
                    sph_particle q;
                    must(sim, sph_get(sim, i, &q));
                    tensor want = {{{0}}};
                    want = plus(want, left, s);
                    for (int k = 0; k < 3; k++)
                        want.v[k][k] -= push ? p : left * p;
                    close_to(off_by(stress_of(&q), want), 0, 16 * EPS * 1e4);
                    for (int k = 0; k < SPH_DIM; k++)
                        most = fmax(most, fabs(q.a[k]));
                }
                assert_true(whole || push ? most > 1 : most == 0);
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* ---- flaws ---- */

/* MANY particles of volume 1 each, whatever the dimension, in `sets` sets, one after the other */
static sph_sim *with_sets(uint32_t sets, uint32_t max_flaws)
{
    sph_config c = solid_config(SPH_UPDATED, SPH_KICK_DRIFT_KICK, 200, 1);
    sph_solid m = {.shear = SOFT_MU};
    uint32_t set;
    c.max_particles = MANY * sets;
    c.damage = SPH_BENZ_ASPHAUG;
    c.max_flaws = max_flaws;
    sph_sim *sim = new_sim(&c);
    for (uint32_t s = 0; s < sets; s++) {
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        for (uint32_t i = 0; i < MANY; i++) {
            double x[SPH_DIM] = {0};
            x[0] = 2.0 * (i % 20);
            x[1] = 2.0 * (i / 20);
            must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
        }
    }
    return sim;
}
static uint64_t digest(const sph_sim *sim, uint32_t first, uint32_t n)
{
    uint64_t h = 1469598103934665603u; /* FNV-1a over counts and the bits of thresholds */
    for (uint32_t id = first; id < first + n; id++) {
        float list[SPH_MAX_FLAWS];
        uint32_t count, word;
        must(sim, sph_get_flaws(sim, id, &count, list));
        for (uint32_t k = 0; k <= count; k++) {
            if (k == 0)
                word = count;
            else
                memcpy(&word, &list[k - 1], 4);
            for (uint32_t b = 0; b < 4; b++)
                h = (h ^ (word >> 8 * b & 255)) * 1099511628211u;
        }
    }
    return h;
}

#define PINNED 0x967fd2f382c68ebeu
static const sph_flaws basalt = {1e-2, 8.5, 2024};
static void flaws_are_the_same_on_every_machine(void **state)
{
    (void)state;
    sph_sim *sim = with_sets(1, 20 * MANY);
    must(sim, sph_add_flaws(sim, 0, &basalt));
    const uint64_t h = digest(sim, 0, MANY);
    if (h != PINNED)
        fail_msg("digest %08lx%08lx", (unsigned long)(h >> 32), (unsigned long)(h & 0xffffffffu));
}

/* every particle at least one and at most 20, in rising order; of all draws, those below eps are k V eps^m to sampling
   error */
static void flaws_follow_weibull(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        const sph_flaws f = {basalt.k, basalt.m, seed};
        sph_sim *sim = with_sets(1, 20 * MANY);
        uint32_t total = 0, low[3] = {0};
        double eps[3];
        for (int e = 0; e < 3; e++)
            eps[e] = pow(log(MANY) * (e + 1) / 4 / f.k, 1 / f.m); /* the strain where a quarter, a half ... lie below */
        must(sim, sph_add_flaws(sim, 0, &f));
        for (uint32_t id = 0; id < MANY; id++) {
            float list[SPH_MAX_FLAWS];
            uint32_t n;
            must(sim, sph_get_flaws(sim, id, &n, list));
            assert_true(n >= 1 && n <= SPH_MAX_FLAWS);
            total += n;
            for (uint32_t k = 0; k < n; k++) {
                assert_true(list[k] > 0 && (k == 0 || list[k] >= list[k - 1]));
                for (int e = 0; e < 3; e++)
                    low[e] += (double)list[k] <= eps[e] * (1 + 1e-6);
            }
        }
        /* draws beyond N ln N, until nobody is without, raise all counts alike */
        const double draws = MANY * log(MANY), more = total / draws;
        print_message("seed %lu: %u flaws of %.0f; below quarters of them %u %u %u\n", (unsigned long)seed, total,
                      draws, low[0], low[1],
                      low[2]);
        assert_true(more > 0.99 && more < 1.8);
        for (int e = 0; e < 3; e++)
            close_to(low[e], more * f.k * MANY * pow(eps[e], f.m),
                     4 * sqrt(1.0 * total * (e + 1) / 4.0 * (3 - e) / 4.0));
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* two sets: each has the list that it would have alone, whichever comes first */
static void two_sets_have_flaws_of_their_own(void **state)
{
    const sph_flaws other = {3e-2, 6, 5};
    uint64_t want[2];
    (void)state;
    sph_sim *alone = with_sets(1, 20 * MANY);
    must(alone, sph_add_flaws(alone, 0, &basalt));
    want[0] = digest(alone, 0, MANY);
    alone = with_sets(1, 20 * MANY);
    must(alone, sph_add_flaws(alone, 0, &other));
    want[1] = digest(alone, 0, MANY);
    for (uint32_t first = 0; first < 2; first++) {
        sph_sim *sim = with_sets(3, 40 * MANY);
        must(sim, sph_add_flaws(sim, first, first ? &other : &basalt));
        must(sim, sph_add_flaws(sim, !first, first ? &basalt : &other));
        assert_true(digest(sim, 0, MANY) == want[0] && digest(sim, MANY, MANY) == want[1]);
        uint32_t n = 1;
        must(sim, sph_get_flaws(sim, 2 * MANY, &n, NULL)); /* the third set has none */
        assert_int_equal(n, 0);
    }
}

static void flaws_check_their_arguments(void **state)
{
    static const double k[] = {0, -1, NAN, INFINITY, 1e301}, m[] = {0, 0.9, 50.1, NAN, INFINITY, -INFINITY};
    (void)state;
    sph_sim *sim = with_sets(2, 20 * MANY);
    const uint64_t before = sph_hash(sim), setup = sim->setup_hash;
    sph_flaws f = basalt;
    for (size_t i = 0; i < sizeof k / sizeof *k; i++) {
        f.k = k[i];
        assert_int_equal(sph_add_flaws(sim, 0, &f), SPH_BAD_ARGUMENT);
        assert_string_equal(sph_last(sim)->what, "flaws.k");
    }
    f = basalt;
    for (size_t i = 0; i < sizeof m / sizeof *m; i++) {
        f.m = m[i];
        assert_int_equal(sph_add_flaws(sim, 0, &f), SPH_BAD_ARGUMENT);
        assert_string_equal(sph_last(sim)->what, "flaws.m");
    }
    assert_int_equal(sph_add_flaws(sim, 2, &basalt), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_add_flaws(sim, 0, NULL), SPH_BAD_ARGUMENT);
    assert_true(sph_hash(sim) == before && sim->setup_hash == setup);
    must(sim, sph_add_flaws(sim, 0, &basalt));
    assert_int_equal(sph_add_flaws(sim, 0, &basalt), SPH_BAD_ARGUMENT); /* only once */
    const uint64_t list = digest(sim, 0, 2 * MANY);
    /* room for the first set, not for both: the value tells how many */
    const uint32_t need = sim->flaws;
    sph_sim *small = with_sets(2, need);
    must(small, sph_add_flaws(small, 0, &basalt));
    const uint64_t setup_small = small->setup_hash;
    assert_int_equal(sph_add_flaws(small, 1, &basalt), SPH_TOO_MANY_FLAWS);
    assert_true(sph_last(small)->value == 2.0 * need && small->setup_hash == setup_small && small->flaws == need);
    assert_true(digest(small, 0, 2 * MANY) == list);
    sph_sim *none = with_sets(1, need - 1);
    assert_int_equal(sph_add_flaws(none, 0, &basalt), SPH_TOO_MANY_FLAWS);
    uint32_t n = 1;
    must(none, sph_get_flaws(none, 0, &n, NULL));
    assert_int_equal(n, 0);
    must(sim, sph_ready(sim));
    assert_int_equal(sph_add_flaws(sim, 1, &basalt), SPH_BAD_STATE);
}

/* a set whose particles were not added one after the other, an empty one, a fluid, a scene without damage */
static void only_whole_solid_sets_have_flaws(void **state)
{
    sph_config c = solid_config(SPH_UPDATED, SPH_KICK_DRIFT_KICK, 4, 1);
    sph_solid m = {.shear = 1};
    uint32_t a, b, w;
    double x[SPH_DIM] = {0};
    (void)state;
    c.damage = SPH_BENZ_ASPHAUG;
    c.max_flaws = 100;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &a, NULL));
    must(sim, sph_add_solid(sim, &m, &b, NULL));
    must(sim, sph_add_fluid(sim, NULL, &w));
    assert_int_equal(sph_add_flaws(sim, a, &basalt), SPH_BAD_ARGUMENT);
    must(sim, sph_add_particle(sim, a, x, NULL, 0, NULL));
    must(sim, sph_add_particle(sim, b, x, NULL, 0, NULL));
    must(sim, sph_add_particle(sim, a, x, NULL, 0, NULL));
    must(sim, sph_add_particle(sim, w, x, NULL, 0, NULL));
    assert_int_equal(sph_add_flaws(sim, a, &basalt), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_add_flaws(sim, w, &basalt), SPH_BAD_ARGUMENT);
    must(sim, sph_add_flaws(sim, b, &basalt));
    uint32_t n;
    must(sim, sph_get_flaws(sim, 1, &n, NULL));
    assert_int_equal(n, 1);
    c.damage = SPH_NO_DAMAGE;
    sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &a, NULL));
    must(sim, sph_add_particle(sim, a, x, NULL, 0, NULL));
    assert_int_equal(sph_add_flaws(sim, a, &basalt), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "damage");
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(damage_grows_as_active_flaws_do),
        subject(damage_stops_at_the_share_of_active_flaws),
        subject(the_largest_principal_stress_counts),
        subject(broken_particles_carry_pressure_only),
        subject(flaws_are_the_same_on_every_machine),
        subject(flaws_follow_weibull),
        subject(two_sets_have_flaws_of_their_own),
        subject(flaws_check_their_arguments),
        subject(only_whole_solid_sets_have_flaws),
    };
    return run_subjects("damage", list);
}
