/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_api.c: every entry point with null, zero, huge and not-a-number arguments and at the wrong moment; every field
   of the configuration out of range names itself; arenas; two simulations side by side; no allocation. */
#include "testing.h"

#define DX 0.1

/* ---- no allocation: the allocators of this program count what the library asks for ---- */

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1 /* as gcc says it */
#endif
#endif
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define COUNT_ALLOCATIONS 1
static long allocations;
void *__libc_malloc(size_t n);
void *__libc_calloc(size_t n, size_t m);
void *__libc_realloc(void *p, size_t n);
void *malloc(size_t n) { allocations++; return __libc_malloc(n); }
void *calloc(size_t n, size_t m) { allocations++; return __libc_calloc(n, m); }
void *realloc(void *p, size_t n) { allocations++; return __libc_realloc(p, n); }
#endif

static sph_config base(void)
{
    sph_config c = open_config(2, DX);
    c.max_particles = SPH_DIM == 3 ? 20000 : 4000;
    return c;
}

static sph_sim *pool(const sph_config *c)
{
    sph_sim *sim = new_sim(c);
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0.5, hi[k] = 1;
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    return sim;
}

/* ---- configuration ---- */

static void refused(const sph_config *c, const char *what, double value)
{
    sph_report r;
    memset(&r, 0, sizeof r);
    assert_int_equal(sph_config_check(c, &r), SPH_BAD_CONFIG);
    if (strcmp(r.what, what) != 0)
        fail_msg("wanted the field %s to be named, got %s", what, r.what);
    assert_true(r.allowed && strlen(r.allowed) > 2);
    assert_true(r.value == value || (value != value && r.value != r.value));
    assert_int_equal(r.status, SPH_BAD_CONFIG);
    assert_int_equal(sph_config_check(c, NULL), SPH_BAD_CONFIG);
    assert_true(sph_arena_bytes(c) == 0);
}

#define BAD(field, bad)                                                                                     \
    do {                                                                                                    \
        sph_config c_ = base();                                                                             \
        c_.field = (bad);                                                                                   \
        refused(&c_, #field, (double)c_.field);                                                             \
    } while (0)

static void every_number_out_of_range_names_its_field(void **state)
{
    static const double wrong[] = {-1, NAN, INFINITY, -INFINITY, 1e300};
    (void)state;
    for (int i = 0; i < 5; i++) {
        BAD(spacing, wrong[i]);
        BAD(smoothing_length, wrong[i]);
        BAD(rho0, wrong[i]);
        BAD(sound_speed, wrong[i]);
        BAD(alpha, wrong[i]);
        BAD(beta, wrong[i]);
        BAD(nu, wrong[i]);
        BAD(delta, wrong[i]);
        BAD(xsph, wrong[i]);
        BAD(damping, wrong[i]);
        BAD(dt, wrong[i]);
        BAD(cfl, wrong[i]);
        BAD(viscous_factor, wrong[i]);
        BAD(force_factor, wrong[i]);
        BAD(gravity_factor, wrong[i]);
        BAD(dt_max, wrong[i]);
        BAD(dt_min, wrong[i]);
        BAD(stress_epsilon, wrong[i]);
        BAD(max_stretch, wrong[i]);
    }
    BAD(stress_epsilon, 10.1);
    BAD(stress_exponent, 0);
    BAD(stress_exponent, 9);
    BAD(max_stretch, 0.9);
    BAD(max_stretch, 8.1);
    BAD(spacing, 0);
    BAD(smoothing_length, 0.4 * DX);
    BAD(smoothing_length, 11 * DX);
    BAD(rho0, 0);
    BAD(sound_speed, 0);
    BAD(xsph, 1.01);
    BAD(damping, 0);
    BAD(damping, 1.01);
    BAD(cfl, 0);
    BAD(viscous_factor, 0);
    BAD(force_factor, 0);
    BAD(gravity_factor, 0);
    BAD(max_particles, 0);
    BAD(max_particles, (1u << 30) + 1);
    BAD(max_threads, 0);
    BAD(max_threads, 257);
}

/* what a choice adds to the arena of base(), whole arrays of sz elements of `bytes`, rounded up as the layout does */
static size_t array_bytes(size_t bytes) { return ((base().max_particles + 48u) * bytes + 63) / 64 * 64; }

#define ADDS(field, value, bytes)                                                                           \
    do {                                                                                                    \
        sph_config c_ = base();                                                                             \
        const size_t before_ = sph_arena_bytes(&c_);                                                        \
        c_.field = (value);                                                                                 \
        assert_true(before_ > 0);                                                                           \
        assert_int_equal(sph_arena_bytes(&c_) - before_, (bytes));                                          \
    } while (0)

static void a_module_that_is_not_chosen_adds_nothing_to_the_arena(void **state)
{
    const size_t real = array_bytes(sizeof(sph_real)), sums = (base().max_particles / 256 + 1) * 13 * sizeof(double);
    const size_t one_state = 2 * SPH_DIM * real + 2 * real + SPH_DIM * real + array_bytes(4) + array_bytes(1);
    (void)state;
    /* choices that are arithmetic only */
    ADDS(kernel, SPH_CUBIC, 0); /* the same support, so the same cells */
    ADDS(kernel, SPH_WENDLAND_C4, 0);
    for (uint32_t k = 0; k < SPH_SCHEMES; k++)
        ADDS(scheme, k, 0);
    for (uint32_t k = 0; k < SPH_IDEAL_GAS; k++)
        ADDS(eos, k, 0);
    for (uint32_t k = 0; k < SPH_ANTUONO; k++)
        ADDS(diffusion, k, 0);
    ADDS(viscosity, SPH_INVISCID, 0);
    ADDS(viscosity, SPH_ARTIFICIAL_APPROACHING, 0);
    ADDS(pressure_floor, true, 0);
    /* the predictor-corrector keeps how the rate of density rises */
    ADDS(integrator, SPH_KICK_DRIFT_KICK, (size_t)0 - 2 * real);
    ADDS(integrator, SPH_LEAP_FROG, (size_t)0 - 2 * real);
    ADDS(damping, 0.9, 0);
    /* choices that keep something: exactly that */
    ADDS(face[0][0], SPH_SYMMETRY, array_bytes(1)); /* which of their axes was turned */
    ADDS(face[0][1], SPH_MIRROR_NO_SLIP, array_bytes(1));
    ADDS(xsph, 0.5, 2 * SPH_DIM * real);
    ADDS(shepard_every, 10, real);
    ADDS(density, SPH_SUMMATION, real);
    ADDS(integrator, SPH_RUNGE_KUTTA, one_state - 2 * real);
    ADDS(integrator, SPH_RUNGE_KUTTA_MOMENTUM, one_state - 2 * real);
    ADDS(books, true, 7 * real + (sums + 63) / 64 * 64);
}

static void every_choice_out_of_range_names_its_field(void **state)
{
    (void)state;
    BAD(kernel, SPH_KERNELS);
    BAD(scheme, SPH_SCHEMES);
    BAD(density, SPH_DENSITIES);
    BAD(eos, SPH_EOSES);
    BAD(viscosity, SPH_VISCOSITIES);
    BAD(diffusion, SPH_DIFFUSIONS);
    BAD(integrator, SPH_INTEGRATORS);
    BAD(solid, SPH_SOLIDS);
    BAD(yield, SPH_YIELDS);
    BAD(damage, SPH_DAMAGES);
    BAD(artificial_stress, SPH_ARTIFICIAL_STRESSES);
    BAD(on_leave, SPH_PUT_BACK);
    BAD(on_cross, SPH_POLICIES);
    BAD(kernel, 0xffffffffu);
    BAD(cookie, 0);
    sph_config c = base();
    c.viscosity = SPH_MORRIS;
    c.nu = 0;
    refused(&c, "nu", 0);
    c = base();
    c.density = SPH_SUMMATION;
    c.shepard_every = 10;
    refused(&c, "density", SPH_SUMMATION);
    assert_int_equal(sph_config_check(NULL, NULL), SPH_BAD_CONFIG);
    assert_true(sph_arena_bytes(NULL) == 0);
}

/* choices of solids that do not go with others */
static void choices_of_solids_ask_for_each_other(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) { /* without a solid form */
        sph_config c = base();
        c.yield = k == 0;
        c.damage = k == 1 && SPH_DIM > 1;
        c.artificial_stress = k == 2;
        c.xsph_strain = k == 3;
        c.xsph = k == 3 ? 0.5 : 0;
        if (SPH_DIM > 1 || k != 1)
            refused(&c, "solid", SPH_NO_SOLID);
    }
    sph_config good = base();
    good.solid = SPH_UPDATED;
    assert_int_equal(sph_config_check(&good, NULL), SPH_OK);
    for (uint32_t s = 0; s < SPH_SCHEMES; s++) {
        sph_config c = good;
        c.scheme = s;
        if (s != SPH_STANDARD && s != SPH_WEAK)
            refused(&c, "scheme", s);
        else
            assert_int_equal(sph_config_check(&c, NULL), SPH_OK);
    }
    sph_config c = good;
    c.density = SPH_SUMMATION;
    refused(&c, "density", SPH_SUMMATION);
    c = good;
    c.shepard_every = 5;
    refused(&c, "density", SPH_CONTINUITY);
    c = good;
    c.xsph_strain = true;
    refused(&c, "xsph", 0);
    c = good;
    c.solid = SPH_TOTAL;
    c.artificial_stress = SPH_PRINCIPAL;
    refused(&c, "artificial_stress", SPH_PRINCIPAL);
#if SPH_DIM == 1
    c = good;
    c.damage = SPH_BENZ_ASPHAUG;
    refused(&c, "damage", SPH_BENZ_ASPHAUG);
#else
    static const uint32_t flaws[] = {0, (1u << 30) + 1};
    for (int k = 0; k < 2; k++) {
        c = good;
        c.damage = SPH_BENZ_ASPHAUG;
        c.max_flaws = flaws[k];
        refused(&c, "max_flaws", flaws[k]);
    }
#endif
}

/* none of them may change while a simulation lives */
static void choices_of_solids_stay(void **state)
{
    sph_config good = base();
    (void)state;
    good.solid = SPH_CORRECTED;
    good.yield = SPH_VON_MISES;
    good.damage = SPH_DIM > 1 ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
    good.max_flaws = 100;
    good.xsph = 0.5;
    sph_sim *sim = new_sim(&good);
    for (int k = 0; k < 9; k++) {
        sph_config c = good;
        c.solid = k == 0 ? SPH_UPDATED : good.solid;
        c.yield = k == 1 ? SPH_VON_MISES_GRAY : good.yield;
        c.damage = k == 2 ? SPH_DIM > 1 ? SPH_BENZ_ASPHAUG_GRAY : SPH_BENZ_ASPHAUG : good.damage;
        c.max_flaws = k == 3 ? 101 : good.max_flaws;
        c.artificial_stress = k == 4 ? SPH_COMPONENTS : good.artificial_stress;
        c.stress_exponent = k == 5 ? 3 : good.stress_exponent;
        c.stress_epsilon = k == 6 ? 0.2 : good.stress_epsilon;
        c.xsph_strain = k == 7;
        c.max_stretch = k == 8 ? 2 : good.max_stretch;
        if (sph_reconfigure(sim, &c) != SPH_BAD_CONFIG)
            fail_msg("change %d was taken", k);
    }
    must(sim, sph_reconfigure(sim, &good));
}

static void the_domain_is_checked(void **state)
{
    static const double wrong[] = {NAN, INFINITY, -INFINITY, 1e300};
    (void)state;
    for (int k = 0; k < SPH_DIM; k++) {
        for (int i = 0; i < 4; i++) {
            sph_config c = base();
            c.lo[k] = wrong[i];
            refused(&c, i == 3 || i == 1 ? "lo" : "lo", wrong[i]);
            c = base();
            c.hi[k] = wrong[i];
            refused(&c, "hi", wrong[i]);
            c = base();
            c.gravity[k] = wrong[i];
            refused(&c, "gravity", wrong[i]);
        }
        sph_config c = base();
        c.hi[k] = c.lo[k];
        refused(&c, "hi", c.lo[k]);
        for (int s = 0; s < 2; s++) {
            c = base();
            c.face[k][s] = SPH_FACES;
            refused(&c, "face", SPH_FACES);
            c = base();
            c.face[k][s] = SPH_PERIODIC; /* on one side only */
            assert_int_equal(sph_config_check(&c, NULL), SPH_BAD_CONFIG);
        }
    }
    /* found when the grid is made: a periodic axis needs three cells, and cells must be countable */
    sph_config c = base();
    sph_report r;
    sph_sim *sim = NULL;
    c.face[0][0] = c.face[0][1] = SPH_PERIODIC;
    c.hi[0] = c.lo[0] + 5 * DX;
    assert_int_equal(sph_init(&sim, &c, NULL, 0, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "hi");
    c = base();
    c.hi[SPH_DIM - 1] = 1e7;
    assert_int_equal(sph_init(&sim, &c, NULL, 0, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "hi");
    assert_null(sim);
}

/* ---- arena ---- */

static void a_small_or_crooked_arena_is_refused_untouched(void **state)
{
    sph_config c = base();
    sph_report r;
    sph_sim *sim = NULL;
    const size_t need = sph_arena_bytes(&c);
    unsigned char *a = aligned_alloc(64, (need + 191) / 64 * 64);
    (void)state;
    memset(a, GUARD_BYTE, need + 64);
    assert_true(need > 1000);
    assert_int_equal(sph_init(&sim, &c, a, need - 1, &r), SPH_ARENA_TOO_SMALL);
    assert_true(r.value == (double)need);
    assert_string_equal(r.what, "arena");
    assert_int_equal(sph_init(&sim, &c, a, 0, &r), SPH_ARENA_TOO_SMALL);
    assert_int_equal(sph_init(&sim, &c, NULL, need, &r), SPH_ARENA_TOO_SMALL);
    assert_int_equal(sph_init(&sim, &c, a + 8, need + 8, &r), SPH_ARENA_UNALIGNED);
    assert_int_equal(sph_init(&sim, &c, a + 8, need + 8, NULL), SPH_ARENA_UNALIGNED);
    assert_int_equal(sph_init(NULL, &c, a, need, &r), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_init(&sim, NULL, a, need, &r), SPH_BAD_CONFIG);
    assert_null(sim);
    assert_true(guard_intact(a, need + 64));
    assert_int_equal(sph_init(&sim, &c, a, need, &r), SPH_OK);
    assert_non_null(sim);
    free(a);
}

static void add_piece(void *ctx, const char *name, size_t bytes)
{
    assert_true(strlen(name) > 1);
    *(size_t *)ctx += bytes;
}

/* whether SPH_USE_ flags can stand together: the filter and shifting not with solids, what solids have not without; a
   total form is a corrected one, and weights beside faces go with these */
static bool usable(uint32_t use)
{
    const bool solid = use & SPH_USE_SOLID;
    const uint32_t of_solids = SPH_USE_CORRECTED | SPH_USE_TOTAL | SPH_USE_YIELD | SPH_USE_DAMAGE;
    if (use & (solid ? SPH_USE_FILTER | SPH_USE_SHIFTING | SPH_USE_SHEAR | SPH_USE_DAMPER | SPH_USE_ENERGY : of_solids))
        return false;
    if (use & SPH_USE_DAMPER && use & SPH_USE_RUNGE_KUTTA)
        return false;
    if (!(use & SPH_USE_CORRECTED) && use & (SPH_USE_TOTAL | SPH_USE_QUADRATURE))
        return false;
    return SPH_DIM > 1 || !(use & (SPH_USE_DAMAGE | SPH_USE_QUADRATURE));
}

/* the constant expression against the function, over a spread of configurations */
static void the_constant_bound_holds_and_is_close(void **state)
{
    static const uint32_t particles[] = {1, 100, 5000, 200000};
    (void)state;
    for (uint32_t n = 0; n < 4; n++)
        for (uint32_t set = 0; set < 16384; set++)
            for (uint32_t threads = 1; threads <= 8 && usable(set); threads *= 8) {
                const bool alone = !(set & (SPH_USE_SOLID | SPH_USE_DAMPER));
                const uint32_t bits = set | (set % 3 == 0 && alone ? SPH_USE_ENERGY : 0);
                const uint32_t flaws = bits & SPH_USE_DAMAGE ? 7 * particles[n] : 0;
                sph_config c = base();
                double cells = 1;
                c.max_particles = particles[n];
                c.max_threads = threads;
                c.integrator = bits & SPH_USE_RUNGE_KUTTA ? SPH_RUNGE_KUTTA : SPH_PREDICTOR_CORRECTOR;
                c.xsph = bits & SPH_USE_XSPH ? 0.5 : 0;
                c.books = (bits & SPH_USE_BOOKS) != 0;
                c.shepard_every = bits & SPH_USE_FILTER ? 20 : 0;
                c.damper = bits & SPH_USE_DAMPER ? 0.2 : 0;
                c.shifting = bits & SPH_USE_SHIFTING ? 0.5 : 0;
                c.face_quadrature = (bits & SPH_USE_QUADRATURE) != 0;
                c.face[0][0] = bits & SPH_USE_MIRRORS ? SPH_SYMMETRY : SPH_OPEN;
                c.solid = bits & SPH_USE_TOTAL ? SPH_TOTAL : bits & SPH_USE_CORRECTED ? SPH_CORRECTED :
                    bits & SPH_USE_SOLID ? SPH_UPDATED : 0;
                c.yield = bits & SPH_USE_YIELD ? SPH_VON_MISES : SPH_NO_YIELD;
                c.damage = bits & SPH_USE_DAMAGE ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
                c.max_flaws = flaws;
                c.shear = bits & SPH_USE_SHEAR ? SPH_SMAGORINSKY : SPH_NO_SHEAR;
                c.energy = (bits & SPH_USE_ENERGY) != 0;
                c.max_stretch = 1;
                const uint32_t flow = bits % 5 == 3 && !c.energy ? SPH_USE_FLOW : 0;
                c.max_flows = flow ? SPH_MAX_FLOWS : 0;
                for (int k = 0; k < SPH_DIM; k++) {
                    c.hi[k] = c.lo[k] + DX * (10 + 3 * k + 20 * (int)n);
                    double m = floor((c.hi[k] - c.lo[k]) / (2 * c.smoothing_length));
                    cells *= m < 1 ? 1 : m;
                }
                const size_t need = sph_arena_bytes(&c), bound = SPH_ARENA_BYTES(c.max_particles, cells, threads,
                    bits | flow) + 4 * flaws;
                assert_true(need > 0);
                if (bound < need || (double)bound > 1.25 * (double)need + 65536)
                    fail_msg("%u particles, %g cells, %u threads, use %u: bound %zu, need %zu", c.max_particles, cells,
                             threads, bits, bound, need);
            }
}

static void the_arena_report_adds_up(void **state)
{
    sph_config c = base();
    size_t sum = 0;
    sph_usage u;
    (void)state;
    c.books = true;
    c.shepard_every = 5;
    sph_sim *sim = pool(&c);
    sph_arena_report(sim, add_piece, &sum);
    assert_true(sum == sph_arena_bytes(&c));
    must(sim, sph_step(sim));
    sph_get_usage(sim, &u);
    assert_true(u.arena_bytes == sum && u.arena_used == sum);
    assert_true(u.particles == sph_count(sim) && u.max_particles == c.max_particles);
    assert_true(u.cell_particles >= 1 && u.cell_particles <= u.particles);
    assert_true(u.step_work > u.particles && u.sets == 1 && u.groups == 0 && u.cells > 1);
    /* the bound that sph_step_slice states, for two sweeps (forces, filter) */
    const uint64_t around = SPH_DIM == 1 ? 3 : SPH_DIM == 2 ? 9 : 27;
    assert_true(u.step_work <= 2 * (around * u.cell_particles * u.particles + u.cells + 32) + 16u *
                (uint64_t)u.particles);
}

/* what a particle costs: all arrays, by the names of the report, over the room for particles */
static void add_arrays(void *ctx, const char *name, size_t bytes)
{
    static const char *const fixed_size[] = {"header", "sets", "wall groups", "thread scratch",
        "thread scratch of columns", "materials", "cell starts", "slab starts", "flaws",
                                             "partial sums for the books"};
    for (size_t k = 0; k < sizeof fixed_size / sizeof *fixed_size; k++)
        if (strcmp(name, fixed_size[k]) == 0)
            return;
    *(size_t *)ctx += bytes;
}
static double particle_bytes(uint32_t solid, uint32_t yield, uint32_t damage)
{
    sph_config c = base();
    size_t sum = 0;
    c.max_particles = 20000;
    c.solid = solid;
    c.yield = yield;
    c.damage = damage;
    c.max_flaws = 100;
    sph_arena_report(new_sim(&c), add_arrays, &sum);
    assert_int_equal(free_sims(NULL), 0);
    return (double)sum / c.max_particles;
}
static void solids_cost_so_many_bytes_a_particle(void **state)
{
    static const char *const names[] = {"fluid", "updated", "corrected", "total"};
    (void)state;
    for (uint32_t form = 0; form <= SPH_TOTAL; form++) {
        const double elastic = particle_bytes(form, 0, 0), all = form ? particle_bytes(form, SPH_VON_MISES,
            SPH_DIM > 1) : elastic;
        print_message("%s: %.1f bytes a particle, yield and damage %.1f more\n", names[form], elastic, all - elastic);
        if (SPH_DIM == 2 && !SPH_DOUBLE && form) { /* the displacement since the start makes it two more than 152 */
            assert_true(elastic <= (form == SPH_TOTAL ? 154 : 152) + 0.5); /* + 0.5: padding behind 20000 */
            assert_true(all - elastic <= 24);
        }
    }
    /* a flaw is 4 bytes */
    if (SPH_DIM > 1) {
        sph_config c = base();
        c.solid = SPH_UPDATED;
        c.damage = SPH_BENZ_ASPHAUG;
        c.max_flaws = 16;
        const size_t few = sph_arena_bytes(&c);
        c.max_flaws = 160016;
        assert_int_equal(sph_arena_bytes(&c) - few, 640000);
    }
}

/* a static arena by the constant expression, as a bare machine has it */
static SPH_ARENA(fixed, SPH_ARENA_BYTES(300, SPH_DIM == 3 ? 25 * 25 * 25 : 25 * 25, 1, 0));
static void a_static_arena_works(void **state)
{
    sph_config c = base();
    sph_sim *sim;
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM];
    (void)state;
    c.max_particles = 300;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0.5, hi[k] = 1;
    assert_int_equal(sph_init(&sim, &c, fixed, sizeof fixed, NULL), SPH_OK);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, sph_step(sim));
}

#if COUNT_ALLOCATIONS
static void nothing_is_allocated(void **state)
{
    sph_config c = base();
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM], at[SPH_DIM], h;
    sph_probe_value v;
    sph_totals t;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0.5, hi[k] = 1, at[k] = 0.7;
    c.integrator = SPH_RUNGE_KUTTA;
    c.books = true;
    c.on_cross = SPH_PUT_BACK;
    long before = allocations;
    sph_sim *sim = new_sim(&c); /* takes one block by aligned_alloc, which is not counted */
    sph_wall w = sph_wall_default();
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    for (int k = 0; k < 3; k++)
        must(sim, sph_step(sim));
    sph_get_totals(sim, &t);
    must(sim, sph_probe(sim, at, &v));
    must(sim, sph_gauge(sim, at, 0, &h));
    assert_true(sph_hash(sim) != 0);
    assert_int_equal(allocations - before, 0);
    void *volatile one = malloc(1); /* the counter counts: volatile, or the compiler leaves it out */
    free(one);
    assert_int_equal(allocations - before, 1);
}
#endif

/* ---- arguments ---- */

#define arg_refused(sim, call, name)                                                                        \
    do {                                                                                                    \
        assert_int_equal(call, SPH_BAD_ARGUMENT);                                                           \
        if (strcmp(sph_last(sim)->what, name) != 0)                                                         \
            fail_msg("%s: named %s", #call, sph_last(sim)->what);                                           \
    } while (0)

static void particles_and_lattices_check_their_arguments(void **state)
{
    sph_config c = base();
    sph_sim *sim = pool(&c);
    double x[SPH_DIM], bad[SPH_DIM], lo[SPH_DIM], hi[SPH_DIM];
    const uint64_t before = sph_hash(sim);
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = bad[k] = 0.3, lo[k] = 0, hi[k] = 0.4;
    arg_refused(sim, sph_add_fluid(sim, NULL, NULL), "set");
    uint32_t set;
    arg_refused(sim, sph_add_fluid(sim, &(sph_fluid){.mass = -1}, &set), "fluid.mass");
    arg_refused(sim, sph_add_fluid(sim, &(sph_fluid){.rho0 = NAN}, &set), "fluid.rho0");
    arg_refused(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = INFINITY}, &set), "fluid.sound_speed");
    arg_refused(sim, sph_add_fluid(sim, &(sph_fluid){.own_eos = true, .eos = SPH_EOSES}, &set), "eos");
    arg_refused(sim, sph_add_particle(sim, 7, x, NULL, 0, NULL), "set");
    arg_refused(sim, sph_add_particle(sim, 0, NULL, NULL, 0, NULL), "x");
    arg_refused(sim, sph_add_particle(sim, 0, x, NULL, -1, NULL), "rho");
    arg_refused(sim, sph_add_particle(sim, 0, x, NULL, 1e9, NULL), "rho");
    arg_refused(sim, sph_add_particle(sim, 0, x, NULL, NAN, NULL), "rho");
    for (int i = 0; i < 4; i++) {
        bad[SPH_DIM - 1] = (double[]){NAN, INFINITY, 1e300, -1e300}[i];
        arg_refused(sim, sph_add_particle(sim, 0, bad, NULL, 0, NULL), "position");
        arg_refused(sim, sph_add_particle(sim, 0, x, bad, 0, NULL), "velocity");
        assert_int_equal(sph_add_box(sim, 0, lo, bad, NULL), SPH_BAD_ARGUMENT);
        assert_int_equal(sph_add_box(sim, 0, bad, hi, NULL), SPH_BAD_ARGUMENT);
        assert_int_equal(sph_add_box(sim, 0, lo, hi, bad), SPH_BAD_ARGUMENT);
        assert_int_equal(sph_add_ring(sim, 0, bad, 0, 0.1, NULL), SPH_BAD_ARGUMENT);
    }
    bad[SPH_DIM - 1] = 2 * 2.0; /* the domain's high face */
    arg_refused(sim, sph_add_particle(sim, 0, bad, NULL, 0, NULL), "position");
    arg_refused(sim, sph_add_box(sim, 0, NULL, hi, NULL), "lo, hi");
    arg_refused(sim, sph_add_box(sim, 0, hi, lo, NULL), "hi");
    arg_refused(sim, sph_add_box(sim, 3, lo, hi, NULL), "set");
    arg_refused(sim, sph_add_ring(sim, 0, NULL, 0, 1, NULL), "centre");
    arg_refused(sim, sph_add_ring(sim, 0, x, 0.2, 0.2, NULL), "outer");
    arg_refused(sim, sph_add_ring(sim, 0, x, -0.2, 0.2, NULL), "outer");
    arg_refused(sim, sph_add_ring(sim, 0, x, 0, NAN, NULL), "outer");
#if SPH_DIM == 2
    const double tri[3][2] = {{0, 0}, {0.4, 0}, {0, NAN}};
    arg_refused(sim, sph_add_polygon(sim, 0, NULL, 3, NULL), "corner");
    arg_refused(sim, sph_add_polygon(sim, 0, tri, 2, NULL), "corner");
    arg_refused(sim, sph_add_polygon(sim, 0, tri, 3, NULL), "corner");
#endif
    arg_refused(sim, sph_apply_field(sim, 0, NULL, NULL), "fn");
    assert_int_equal(sph_apply_hydrostatic(sim, 0, 1), SPH_BAD_ARGUMENT); /* no gravity */
    arg_refused(sim, sph_apply_hydrostatic(sim, 9, 1), "set");
    assert_true(sph_hash(sim) == before);
}

static void walls_check_their_arguments(void **state)
{
    sph_config c = base();
    sph_sim *sim = pool(&c);
    double lo[SPH_DIM], hi[SPH_DIM];
    const uint64_t before = sph_hash(sim);
    const uint32_t count = sph_count(sim);
    sph_wall w = sph_wall_default(), bad;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0, hi[k] = 1;
    arg_refused(sim, sph_add_wall_box(sim, NULL, lo, hi, SPH_LOW(0), true, NULL), "wall");
    arg_refused(sim, sph_add_wall_box(sim, &w, NULL, hi, SPH_LOW(0), true, NULL), "lo, hi");
    arg_refused(sim, sph_add_wall_box(sim, &w, lo, hi, 0, true, NULL), "faces");
    arg_refused(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_HIGH(SPH_DIM), true, NULL), "faces");
    arg_refused(sim, sph_add_wall_box(sim, &w, hi, lo, SPH_LOW(0), true, NULL), "hi");
    bad = w;
    bad.kind = SPH_WALLS;
    arg_refused(sim, sph_add_wall_box(sim, &bad, lo, hi, SPH_LOW(0), true, NULL), "wall.kind");
    bad = w;
    bad.strength = NAN;
    arg_refused(sim, sph_add_wall_box(sim, &bad, lo, hi, SPH_LOW(0), true, NULL), "wall.strength");
    bad = w;
    bad.layers = 65;
    arg_refused(sim, sph_add_wall_box(sim, &bad, lo, hi, SPH_LOW(0), true, NULL), "wall.layers");
    arg_refused(sim, sph_remove_wall(sim, 0), "group");
#if SPH_DIM == 2
    const double a[2] = {0, 0}, b[2] = {0.01, 0}, n[2] = {NAN, 0};
    arg_refused(sim, sph_add_wall_segment(sim, &w, NULL, b, NULL), "a, b");
    arg_refused(sim, sph_add_wall_segment(sim, &w, a, n, NULL), "b");
    arg_refused(sim, sph_add_wall_segment(sim, &w, a, b, NULL), "b");
#elif SPH_DIM == 3
    const double o[3] = {0, 0, 0}, e1[3] = {1, 0, 0}, e2[3] = {1, 1, 0}, z[3] = {0, 0, 0};
    arg_refused(sim, sph_add_wall_plane(sim, &w, NULL, e1, e2, NULL), "origin, e1, e2");
    arg_refused(sim, sph_add_wall_plane(sim, &w, o, e1, e2, NULL), "e2");
    arg_refused(sim, sph_add_wall_plane(sim, &w, o, z, e2, NULL), "e1, e2");
#endif
    hi[0] = 10; /* a high wall beyond the domain: refused whole */
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_HIGH(0), true, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_count(sim), count);
    assert_true(sph_hash(sim) == before);
    hi[0] = 1;
    uint32_t group;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, &group));
    arg_refused(sim, sph_remove_wall_at(sim, group, NAN), "t");
    for (int g = 1; g < (int)SPH_MAX_GROUPS; g++)
        must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, &group));
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, &group), SPH_TOO_MANY_SETS);
}

static void readers_check_their_arguments(void **state)
{
    sph_config c = base();
    sph_sim *sim = pool(&c);
    double x[SPH_DIM], bad[SPH_DIM], h, low = 5, high = 6;
    sph_probe_value v[3];
    sph_particle p;
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = bad[k] = 0.7;
    bad[0] = NAN;
    must(sim, sph_ready(sim));
    assert_int_equal(sph_get(sim, sph_count(sim), &p), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_get(sim, 0, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_probe(sim, NULL, v), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_probe(sim, x, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_probe(sim, bad, v), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_probe_line(sim, x, bad, 3, v), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_probe_line(sim, x, x, 1, v), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_probe_line(sim, x, NULL, 3, v), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_gauge(sim, x, SPH_DIM, &h), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_gauge(sim, bad, 0, &h), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_gauge(sim, x, 0, NULL), SPH_BAD_ARGUMENT);
    sph_extent(sim, SPH_DIM, &low, &high);
    assert_true(low == 0 && high == 0);
    sph_extent(sim, 0, &low, &high);
    close_to(low, 0.55, 1e-6);
    close_to(high, 0.95, 1e-6);
    /* probes see the water where it is */
    must(sim, sph_probe(sim, x, v));
    close_to(v[0].cover, 1, 0.03);
    close_to(v[0].rho, 1000, 0.01);
    x[0] = 1.5;
    must(sim, sph_probe(sim, x, v));
    assert_true(v[0].cover == 0 && v[0].rho == 0);
    must(sim, sph_gauge(sim, x, 0, &h)); /* x[0] is ignored */
    close_to(h, 1, 0.6 * DX);
    x[0] = 0.6;
    bad[0] = 0.8;
    for (int k = 1; k < SPH_DIM; k++)
        bad[k] = x[k];
    must(sim, sph_probe_line(sim, x, bad, 3, v));
    close_to(v[1].cover, 1, 0.03);
    if (SPH_DIM > 1) { /* a line that misses the water */
        x[1] = 1.9;
        must(sim, sph_gauge(sim, x, 0, &h));
        close_to(h, c.lo[0], 1e-12);
    }
}

static void calls_at_the_wrong_moment_are_refused(void **state)
{
    sph_config c = base();
    sph_sim *sim = new_sim(&c);
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t set;
    sph_wall w = sph_wall_default();
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0, hi[k] = 0.4;
    assert_int_equal(sph_step(sim), SPH_BAD_STATE); /* nothing was added */
    assert_int_equal(sph_step_slice(sim, 5), SPH_BAD_STATE);
    sim = pool(&c);
    assert_int_equal(sph_step_slice(sim, 0), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_step_to(sim, 0), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_step_to(sim, NAN), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_step_slice(sim, 1), SPH_NOT_DONE);
    assert_int_equal(sph_step(sim), SPH_BAD_STATE);
    assert_int_equal(sph_ready(sim), SPH_BAD_STATE);
    assert_int_equal(sph_add_fluid(sim, NULL, &set), SPH_BAD_STATE);
    assert_int_equal(sph_add_box(sim, 0, lo, hi, NULL), SPH_BAD_STATE);
    assert_int_equal(sph_add_particle(sim, 0, lo, NULL, 0, NULL), SPH_BAD_STATE);
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL), SPH_BAD_STATE);
    assert_int_equal(sph_apply_hydrostatic(sim, 0, 1), SPH_BAD_STATE);
    assert_int_equal(sph_remove_wall(sim, 0), SPH_BAD_STATE);
    assert_int_equal(sph_reconfigure(sim, &c), SPH_BAD_STATE);
    sph_step_cancel(sim);
    must(sim, sph_step(sim));
    assert_int_equal(sph_add_box(sim, 0, lo, hi, NULL), SPH_BAD_STATE);
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL), SPH_BAD_STATE);
    assert_true(strlen(sph_last(sim)->allowed) > 2);
}

/* the first forces are a part of the first step: whatever slice ends them, nothing may be changed before its end */
static void first_forces_in_slices_leave_a_step_begun(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = base();
        c.integrator = i;
        sph_sim *sim = pool(&c);
        uint32_t slices = 0;
        sph_status st;
        while ((st = sph_step_slice(sim, 10)) == SPH_NOT_DONE) {
            slices++;
            assert_int_equal(sph_reconfigure(sim, &c), SPH_BAD_STATE);
            assert_int_equal(sph_remove_wall_at(sim, 0, 1), SPH_BAD_STATE);
        }
        assert_int_equal(st, SPH_OK);
        assert_true(slices > 10);
        must(sim, sph_reconfigure(sim, &c));
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void step_to_ends_exactly_where_told(void **state)
{
    sph_config c = base();
    sph_sim *sim = pool(&c);
    sph_step_info info;
    (void)state;
    c.dt = 1e-3;
    must(sim, sph_reconfigure(sim, &c));
    int n = 0;
    while (sph_time(sim) < 0.0123) {
        must(sim, sph_step_to(sim, 0.0123));
        n++;
    }
    sph_get_step(sim, &info);
    assert_true(sph_time(sim) == 0.0123);
    assert_int_equal(n, 13);
    assert_int_equal(info.limit, SPH_LIMIT_TARGET);
    close_to(info.dt, 0.0003, 1e-12);
    assert_int_equal(info.step, 13);
    assert_true(info.limit_dt[SPH_LIMIT_FIXED] == 1e-3);
}

static void only_some_fields_may_change_later(void **state)
{
    sph_config c = base(), d;
    sph_sim *sim = pool(&c);
    sph_particle before, after;
    (void)state;
    must(sim, sph_ready(sim));
    before = by_id(sim, 0);
    d = c;
    d.gravity[0] = -3;
    must(sim, sph_reconfigure(sim, &d));
    must(sim, sph_ready(sim)); /* the forces are made anew */
    after = by_id(sim, 0);
    close_to(after.a[0] - before.a[0], -3, 100 * EPS * (fabs(before.a[0]) + 3));
#define CHANGED(field, value)                                                                               \
    d = c;                                                                                                  \
    d.field = value;                                                                                        \
    assert_int_equal(sph_reconfigure(sim, &d), SPH_BAD_CONFIG)
    CHANGED(kernel, SPH_CUBIC);
    CHANGED(alpha, 0.7);
    CHANGED(sound_speed, 30);
    CHANGED(max_particles, 10);
    CHANGED(hi[0], 3);
    CHANGED(face[0][0], SPH_SYMMETRY);
    CHANGED(max_threads, 2);
    CHANGED(books, true);
    CHANGED(damping, 3);
    must(sim, sph_step(sim));
}

static void texts_are_there(void **state)
{
    (void)state;
    for (int s = 0; s < SPH_STATUS_COUNT; s++) {
        assert_true(strlen(sph_status_text((sph_status)s)) >= 2);
        for (int o = 0; o < s; o++)
            assert_string_not_equal(sph_status_text((sph_status)s), sph_status_text((sph_status)o));
    }
    assert_string_equal(sph_status_text(SPH_OK), "ok");
    assert_string_equal(sph_status_text(SPH_STATUS_COUNT), "unknown status");
    for (uint32_t l = 0; l < SPH_LIMITS; l++)
        assert_true(strlen(sph_limit_text(l)) > 2);
    assert_string_equal(sph_limit_text(SPH_LIMITS), "unknown");
}

static void two_simulations_do_not_see_each_other(void **state)
{
    sph_config c = base(), d = base();
    d.integrator = SPH_RUNGE_KUTTA;
    d.gravity[0] = 2;
    (void)state;
    sph_sim *a = pool(&c), *b = pool(&d);
    for (int k = 0; k < 10; k++)
        must(a, sph_step(a));
    for (int k = 0; k < 10; k++)
        must(b, sph_step(b));
    sph_sim *a2 = pool(&c), *b2 = pool(&d);
    for (int k = 0; k < 10; k++) {
        must(a2, sph_step(a2));
        must(b2, sph_step(b2));
    }
    assert_true(sph_hash(a) == sph_hash(a2));
    assert_true(sph_hash(b) == sph_hash(b2));
    assert_true(sph_hash(a) != sph_hash(b));
}

static void lattices_stand_where_the_manual_says(void **state)
{
    sph_config c = base();
    sph_sim *sim = new_sim(&c);
    uint32_t set, inside = 0;
    double lo[SPH_DIM], hi[SPH_DIM], centre[SPH_DIM];
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0.5, hi[k] = 0.8, centre[k] = 1.2;
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    assert_int_equal(sph_count(sim), SPH_DIM == 1 ? 3 : SPH_DIM == 2 ? 9 : 27);
    sph_particle p = by_id(sim, 1);
    close_to(p.x[0], 0.65, 1e-6);
    close_to(p.mass, 1000 * pow(DX, SPH_DIM), 1e-9);
    assert_true(p.rho == 1000 && p.role == SPH_ROLE_FLUID && p.set == set);
    const uint32_t before = sph_count(sim);
    must(sim, sph_add_ring(sim, set, centre, 0.1, 0.3, NULL));
    for (uint32_t i = before; i < sph_count(sim); i++) {
        double r2 = 0;
        p = by_id(sim, i);
        for (int k = 0; k < SPH_DIM; k++)
            r2 += (p.x[k] - 1.2) * (p.x[k] - 1.2);
        assert_true(r2 >= 0.01 && r2 < 0.09);
    }
    for (int a = -3; a < 3; a++) /* the same ring counted by hand */
        for (int b = SPH_DIM > 1 ? -3 : 0; b < (SPH_DIM > 1 ? 3 : 1); b++)
            for (int d = SPH_DIM > 2 ? -3 : 0; d < (SPH_DIM > 2 ? 3 : 1); d++) {
                double r2 = (a + 0.5) * (a + 0.5) + (SPH_DIM > 1 ? (b + 0.5) * (b + 0.5) : 0) +
                            (SPH_DIM > 2 ? (d + 0.5) * (d + 0.5) : 0);
                inside += r2 >= 1 && r2 < 9;
            }
    assert_int_equal(sph_count(sim) - before, inside);
#if SPH_DIM == 2
    const double tri[3][2] = {{2, 2}, {2.5, 2}, {2, 2.5}};
    const uint32_t n = sph_count(sim);
    must(sim, sph_add_polygon(sim, set, tri, 3, NULL));
    assert_int_equal(sph_count(sim) - n, 4 + 3 + 2 + 1); /* centres below the diagonal; those on it are outside */
#endif
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(every_number_out_of_range_names_its_field),
        subject(every_choice_out_of_range_names_its_field),
        subject(choices_of_solids_ask_for_each_other),
        subject(choices_of_solids_stay),
        subject(a_module_that_is_not_chosen_adds_nothing_to_the_arena),
        subject(the_domain_is_checked),
        subject(a_small_or_crooked_arena_is_refused_untouched),
        subject(the_constant_bound_holds_and_is_close),
        subject(the_arena_report_adds_up),
        subject(solids_cost_so_many_bytes_a_particle),
        subject(a_static_arena_works),
#if COUNT_ALLOCATIONS
        subject(nothing_is_allocated),
#endif
        subject(particles_and_lattices_check_their_arguments),
        subject(walls_check_their_arguments),
        subject(readers_check_their_arguments),
        subject(calls_at_the_wrong_moment_are_refused),
        subject(first_forces_in_slices_leave_a_step_begun),
        subject(step_to_ends_exactly_where_told),
        subject(only_some_fields_may_change_later),
        subject(texts_are_there),
        subject(two_simulations_do_not_see_each_other),
        subject(lattices_stand_where_the_manual_says),
    };
    return run_subjects("api", list);
}
