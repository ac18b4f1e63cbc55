/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_walls.c: every kind of wall pushes the fluid off; walls stand where they should; images behind periodic and
   mirror faces act like real copies; a moving wall does the work that the fluid gains; gates open. */
#include "testing.h"

#define DX 0.1
#define EDGE (SPH_DIM == 3 ? 1.0 : 2.0)
#define N (SPH_DIM == 3 ? 10u : 20u)

static sph_config tank_config(void)
{
    sph_config c = open_config(EDGE, DX);
    for (int k = 0; k < SPH_DIM; k++)
        c.lo[k] = -0.5, c.hi[k] = EDGE + 0.5;
    c.on_cross = SPH_IGNORE;
    return c;
}

static void ends(double *lo, double *hi)
{
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0, hi[k] = EDGE;
}

static void every_kind_of_wall_repels_from_every_side(void **state)
{
    double lo[SPH_DIM], hi[SPH_DIM];
    (void)state;
    ends(lo, hi);
    for (uint32_t kind = 0; kind < SPH_WALLS; kind++)
        for (uint32_t face = 0; face < 2 * SPH_DIM; face++) {
            sph_config c = tank_config();
            sph_wall w = sph_wall_default();
            double x[SPH_DIM];
            uint32_t set, id;
            w.kind = kind;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set));
            for (int k = 0; k < SPH_DIM; k++) /* above a node of the wall's row */
                x[k] = 0.5 * EDGE + (kind < SPH_WALL_GHOST ? 0 : 0.5 * DX);
            x[face / 2] = face % 2 ? EDGE - 0.4 * DX : 0.4 * DX;
            must(sim, sph_add_particle(sim, set, x, NULL, 1005, &id));
            must(sim, sph_add_wall_box(sim, &w, lo, hi, 1u << face, true, NULL));
            must(sim, sph_ready(sim));
            sph_particle p = by_id(sim, id);
            const double a = p.a[face / 2] * (face % 2 ? -1 : 1);
            if (!(a > 0.01))
                fail_msg("wall kind %u, face %u: acceleration %g off the wall", kind, face, a);
            for (int k = 0; k < SPH_DIM; k++)
                if (k != (int)face / 2)
                    close_to(p.a[k], 0, 1e-4 * a);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* halfway between a row and its image in a mirror the two pushes cancel */
static void the_image_of_a_boundary_wall_pushes_the_other_way(void **state)
{
    (void)state;
    for (uint32_t kind = SPH_WALL_LENNARD_JONES; kind <= SPH_WALL_MONAGHAN_KOS; kind++) {
        sph_config c = tank_config();
        sph_wall w = sph_wall_default();
        double lo[SPH_DIM], hi[SPH_DIM], x[SPH_DIM];
        uint32_t set, id;
        ends(lo, hi);
        w.kind = kind;
        c.hi[0] = hi[0] = 0.9 * DX;
        c.face[0][1] = SPH_SYMMETRY;
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = 0.5 * EDGE;
        x[0] = hi[0] - 1e-6 * DX;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_particle(sim, set, x, NULL, 0, &id));
        must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
        must(sim, sph_ready(sim));
        close_to(by_id(sim, id).a[0], 0, 1e-4 * c.sound_speed * c.sound_speed / DX);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* it reaches two spacings, and the sweep no further than a support */
static void a_monaghan_kos_wall_asks_for_a_support_of_two_spacings(void **state)
{
    (void)state;
    for (int narrow = 0; narrow < 2; narrow++) {
        sph_config c = tank_config();
        sph_wall w = sph_wall_default();
        double lo[SPH_DIM], hi[SPH_DIM];
        ends(lo, hi);
        w.kind = SPH_WALL_MONAGHAN_KOS;
        c.smoothing_length = (narrow ? 0.99 : 1.01) * DX;
        sph_sim *sim = new_sim(&c);
        assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL), narrow ? SPH_BAD_ARGUMENT : SPH_OK);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static uint32_t count_walls(const sph_sim *sim)
{
    sph_totals t;
    sph_get_totals(sim, &t);
    return t.wall;
}

static void walls_stand_where_they_should(void **state)
{
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t all = 0, inner = 1, outer = 1;
    (void)state;
    ends(lo, hi);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        all |= SPH_LOW(k) | SPH_HIGH(k);
        inner *= N;
        outer *= N + 6; /* three layers on either side hold the support of 2.4 spacings */
    }
    sph_config c = tank_config();
    sph_wall w = sph_wall_default();
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_wall_box(sim, &w, lo, hi, all, true, NULL));
    assert_int_equal(count_walls(sim), outer - inner);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p = by_id(sim, i);
        bool out = false;
        for (int k = 0; k < SPH_DIM; k++) {
            double l = p.x[k] / DX - 0.5; /* on the fluid's lattice */
            close_to(l, floor(l + 0.5), 1e-5);
            out |= p.x[k] < 0 || p.x[k] > EDGE;
        }
        assert_true(out && p.role == SPH_ROLE_GHOST);
    }
    /* a row of force particles on the surface: what (N+1)^DIM nodes have more than (N-1)^DIM */
    w.kind = SPH_WALL_KERNEL_FORCE;
    sim = new_sim(&c);
    must(sim, sph_add_wall_box(sim, &w, lo, hi, all, true, NULL));
    assert_int_equal(count_walls(sim), (uint32_t)(pow(N + 1, SPH_DIM) - pow(N - 1, SPH_DIM) + 0.5));
    /* an obstacle is filled as deep as the support needs */
    w.kind = SPH_WALL_ADAMI;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0.2, hi[k] = 0.7;
    sim = new_sim(&c);
    must(sim, sph_add_wall_box(sim, &w, lo, hi, all, false, NULL));
    assert_int_equal(count_walls(sim), (uint32_t)(pow(5, SPH_DIM) + 0.5));
#if SPH_DIM == 2
    const double a[2] = {0, 0}, b[2] = {1, 0};
    sim = new_sim(&c);
    must(sim, sph_add_wall_segment(sim, &w, a, b, NULL)); /* fluid on the left of a -> b: above */
    assert_int_equal(count_walls(sim), 10 * 3);
    for (uint32_t i = 0; i < 30; i++)
        assert_true(by_id(sim, i).x[1] < -0.049 && by_id(sim, i).x[1] > -0.251);
#elif SPH_DIM == 3
    const double o[3] = {0, 0, 0}, e1[3] = {1, 0, 0}, e2[3] = {0, 0.5, 0};
    sim = new_sim(&c);
    must(sim, sph_add_wall_plane(sim, &w, o, e1, e2, NULL)); /* fluid on the side of e1 x e2: above */
    assert_int_equal(count_walls(sim), 10 * 5 * 3);
    for (uint32_t i = 0; i < 150; i++)
        assert_true(by_id(sim, i).x[2] < -0.049 && by_id(sim, i).x[2] > -0.251);
#endif
}

#if SPH_DIM > 1
static void a_corner_pushes_along_the_diagonal(void **state)
{
    double lo[SPH_DIM], hi[SPH_DIM], x[SPH_DIM];
    (void)state;
    ends(lo, hi);
    for (uint32_t kind = 0; kind < SPH_WALLS; kind++) {
        sph_config c = tank_config();
        sph_wall w = sph_wall_default();
        uint32_t set, id, faces = 0;
        w.kind = kind;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            x[k] = 0.4 * DX; /* nearer to the corner's node than to any other */
            faces |= SPH_LOW(k);
        }
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_particle(sim, set, x, NULL, 1005, &id));
        must(sim, sph_add_wall_box(sim, &w, lo, hi, faces, true, NULL));
        must(sim, sph_ready(sim));
        sph_particle p = by_id(sim, id);
        for (int k = 0; k < SPH_DIM; k++) {
            assert_true(p.a[k] > 0);
            close_to(p.a[k], p.a[0], 1e-4 * p.a[0]);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}
#endif

/* ---- images against real copies ---- */

typedef struct thing {
    double x[SPH_DIM], v[SPH_DIM], rho;
} thing;

/* the same random water in both scenes, kept off nothing: it fills [0, edge DX]^DIM. In each row the first particle
   stands at the low face and another one 3.45 DX (3-D: 2.5 DX) off the high one, so that pairs over a seam are nearly a
   support apart. */
static uint32_t water(thing *t, uint32_t edge)
{
    sph_rng rng;
    uint32_t n = 1;
    sph_rng_seed(&rng, 5, 5);
    for (int k = 0; k < SPH_DIM; k++)
        n *= edge;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= edge) {
            t[i].x[k] = (at % edge + 0.4 + 0.2 * sph_rng_uniform(&rng)) * DX;
            t[i].v[k] = sph_rng_uniform(&rng) - 0.5;
        }
        if (i % edge == 0)
            t[i].x[0] = 0.03 * DX;
        if (i % edge == edge - (SPH_DIM == 3 ? 3 : 4))
            t[i].x[0] = (edge - (SPH_DIM == 3 ? 2.5 : 3.45)) * DX;
        t[i].rho = 995 + 10 * sph_rng_uniform(&rng);
    }
    return n;
}

/* the image of a thing behind the low (side 0) or high face of axis 0, which is at `edge` (m) */
static thing image_of(thing t, uint32_t face, int side, double edge)
{
    if (face == SPH_PERIODIC) {
        t.x[0] += side ? edge : -edge;
        return t;
    }
    t.x[0] = side ? 2 * edge - t.x[0] : -t.x[0];
    for (int k = 0; k < SPH_DIM; k++)
        if (k == 0 || face == SPH_MIRROR_NO_SLIP)
            t.v[k] = -t.v[k];
    return t;
}

/* with 28 spacings (3-D: 8) to an edge and these h, cells rounded down left a last one 0.87 (0.92) supports wide */
static void images_act_like_real_copies(void **state)
{
    static thing t[1200];
    (void)state;
    for (uint32_t which = 0; which < 2 * SPH_MIRROR_NO_SLIP; which++) {
        const uint32_t face = SPH_PERIODIC + which / 2, cells = which % 2 ? SPH_DIM == 3 ? 8 : 28 : N;
        const double edge = cells * DX;
        const uint32_t n = water(t, cells);
        sph_config c = tank_config(), d = tank_config();
        uint32_t set, copies;
        for (int k = 0; k < SPH_DIM; k++)
            c.hi[k] = d.hi[k] = edge + 0.5;
        c.lo[0] = 0;
        c.hi[0] = edge;
        c.face[0][0] = c.face[0][1] = face;
        c.alpha = d.alpha = 0.3;
        if (which % 2) /* of all kernels this has the heaviest tail */
            c.kernel = d.kernel = SPH_HAT;
        c.smoothing_length = d.smoothing_length = (which % 2 == 0 ? 1.2 : SPH_DIM == 3 ? 1.3 : 1.95) * DX;
        sph_sim *a = new_sim(&c), *b = new_sim(&d);
        must(a, sph_add_fluid(a, NULL, &set));
        must(b, sph_add_fluid(b, NULL, &copies));
        for (uint32_t i = 0; i < n; i++) {
            must(a, sph_add_particle(a, set, t[i].x, t[i].v, t[i].rho, NULL));
            must(b, sph_add_particle(b, copies, t[i].x, t[i].v, t[i].rho, NULL));
        }
        for (uint32_t i = 0; i < n; i++)
            for (int side = 0; side < 2; side++) {
                thing u = image_of(t[i], face, side, edge);
                if (u.x[0] > -0.4 && u.x[0] < edge + 0.4)
                    must(b, sph_add_particle(b, copies, u.x, u.v, u.rho, NULL));
            }
        must(a, sph_ready(a));
        must(b, sph_ready(b));
        /* forces are sums of terms up to about 2 c0^2 drho/rho/h = 70 m/s^2; positions differ by a quantum, 1e-9 of a
           metre in float and nothing in double, against spacings of 0.1 */
        for (uint32_t i = 0; i < n; i++)
            for (int k = 0; k < SPH_DIM; k++)
                close_to(by_id(a, i).a[k], by_id(b, i).a[k], 70 * 100 * EPS);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- walls that move or vanish ---- */

static void piston(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.5 * t * t;
    v[0] = t;
}

/* solid: the scene's form of solids, though it has none: the books are the same */
static double a_moving_wall(uint32_t solid)
{
    double lo[SPH_DIM], hi[SPH_DIM], all = 0;
    ends(lo, hi);
    for (uint32_t kind = SPH_WALL_MONAGHAN_KOS; kind < SPH_WALLS; kind++) {
        sph_config c = tank_config();
        sph_wall w = sph_wall_default();
        sph_totals t;
        uint32_t set, rest = 0;
        c.books = true;
        c.viscosity = SPH_INVISCID;
        c.dt = 2e-4;
        c.solid = solid;
        for (uint32_t k = 0; k < SPH_DIM; k++)
            rest |= SPH_LOW(k) | SPH_HIGH(k);
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_box(sim, set, lo, hi, NULL));
        w.kind = kind;
        must(sim, sph_add_wall_box(sim, &w, lo, hi, rest & ~SPH_LOW(0), true, NULL));
        w.motion = piston;
        must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
        must(sim, sph_ready(sim));
        sph_get_totals(sim, &t);
        const double before = t.kinetic + t.internal, balance = t.balance;
        while (sph_time(sim) < 0.2)
            must(sim, sph_step(sim));
        sph_get_totals(sim, &t);
        const double gained = t.kinetic + t.internal - before;
        print_message("wall kind %u: work %.5g, energy gained %.5g, in walls %.5g, unexplained %.2g\n", kind,
                      t.wall_work, gained, t.in_walls, t.balance - balance);
        assert_true(t.wall_work > 0 && gained > 0);
        /* A held ghost has no pressure of its own. Force walls hold energy of their own, and the pressure that Adami's
           extrapolation gives a wall does work on the wall's density, which is not evolved: that is on the books. */
        const double in = fabs(t.in_walls);
        assert_true(kind == SPH_WALL_GHOST ? in <= 0 : in > 0.01 * t.wall_work);
        close_to(t.balance, balance, 2e-3 * t.wall_work);
        all += t.wall_work;
        sph_particle p;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            assert_int_equal(sph_get(sim, i, &p), SPH_OK);
            if (p.role != SPH_ROLE_FLUID && p.v[0] != 0)
                break;
        }
        close_to(p.v[0], sph_time(sim), 1e-9);
        assert_int_equal(free_sims(NULL), 0);
    }
    return all;
}
static void a_moving_wall_does_the_work_that_the_fluid_gains(void **state)
{
    (void)state;
    const double work = a_moving_wall(SPH_NO_SOLID);
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL && SPH_DIM < 3; form++) /* 3-D takes long: test_balance.c */
        close_to(a_moving_wall(form), work, 1e-3 * work);
}

static void a_gate_is_gone_when_its_time_has_come(void **state)
{
    sph_config c = tank_config();
    double lo[SPH_DIM], hi[SPH_DIM], half[SPH_DIM];
    uint32_t set, gate;
    sph_wall w = sph_wall_default();
    (void)state;
    ends(lo, hi);
    c.dt = 1e-3;
    c.gravity[0] = 1;
    for (int k = 0; k < SPH_DIM; k++)
        half[k] = k ? 0.5 : EDGE - 0.5;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, half, NULL));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    const uint32_t fixed = count_walls(sim);
    must(sim, sph_add_wall_box(sim, &w, lo, half, SPH_HIGH(0), true, &gate));
    const uint32_t both = count_walls(sim);
    must(sim, sph_remove_wall_at(sim, gate, 0.0055));
    for (int k = 0; k < 5; k++)
        must(sim, sph_step(sim));
    assert_int_equal(count_walls(sim), both);
    must(sim, sph_step(sim));
    assert_int_equal(count_walls(sim), fixed);
    must(sim, sph_remove_wall(sim, 0)); /* and now, at once */
    must(sim, sph_ready(sim));
    assert_int_equal(count_walls(sim), 0);
}

static void a_table_moves_a_wall_in_straight_pieces(void **state)
{
    static const double t[3] = {1, 2, 4}, x[3] = {5, 7, 3};
    sph_table m = {3, SPH_DIM - 1, t, x};
    double d[SPH_DIM], v[SPH_DIM];
    (void)state;
    sph_motion_table(&m, 0.5, d, v);
    assert_true(d[SPH_DIM - 1] == 0 && v[SPH_DIM - 1] == 0);
    sph_motion_table(&m, 1.5, d, v);
    close_to(d[SPH_DIM - 1], 1, 1e-15);
    close_to(v[SPH_DIM - 1], 2, 1e-15);
    sph_motion_table(&m, 3, d, v);
    close_to(d[SPH_DIM - 1], 0, 1e-15);
    close_to(v[SPH_DIM - 1], -2, 1e-15);
    sph_motion_table(&m, 9, d, v);
    close_to(d[SPH_DIM - 1], -2, 1e-15);
    assert_true(v[SPH_DIM - 1] == 0);
    for (int k = 0; k < SPH_DIM - 1; k++)
        assert_true(d[k] == 0 && v[k] == 0);
}

static void a_particle_bounces_off_a_mirror_and_is_counted(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = tank_config();
        double x[SPH_DIM], v[SPH_DIM] = {-1};
        uint32_t set;
        sph_step_info info;
        c.lo[0] = 0;
        c.face[0][0] = SPH_SYMMETRY;
        c.viscosity = SPH_INVISCID;
        c.eos = SPH_LINEAR;
        c.sound_speed = 1e-6; /* no pressure: only the face turns it */
        c.dt = 1e-3;
        c.integrator = i;
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = 0.5;
        x[0] = 0.0035;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        for (int k = 0; k < 7; k++)
            must(sim, sph_step(sim));
        sph_particle p = by_id(sim, 0);
        sph_get_step(sim, &info);
        close_to(p.x[0], 0.0035, 1e-5);
        close_to(p.v[0], 1, 1e-4);
        assert_int_equal(info.reflected, 1);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* momentum along x that a piston of Adami's wall has given to water at rest, at t = 0.02 s: it stands until a row of
   its table, then goes with 0.5 m/s; `cut`: a step of 1 us is put in behind that row */
static double pushed_by_a_table(uint32_t integrator, double cut, double *force)
{
    static const double t[3] = {0, 0.01, 0.11}, x[3] = {0, 0, 0.05};
    static sph_table m = {3, 0, t, x};
    sph_config c = tank_config();
    sph_wall w = sph_wall_default();
    sph_totals sum;
    sph_particle p;
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM];
    ends(lo, hi);
    hi[0] = 1;
    c.integrator = integrator;
    c.viscosity = SPH_INVISCID;
    c.dt = 2.5e-4;
    w.motion = sph_motion_table;
    w.motion_ctx = &m;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    while (sph_time(sim) < 0.01)
        must(sim, sph_step_to(sim, 0.01));
    if (cut > 0)
        must(sim, sph_step_to(sim, 0.01 + cut));
    if (integrator >= SPH_RUNGE_KUTTA) /* whose forces are of a step's middle: of the first that lies behind the jump */
        must(sim, sph_step_to(sim, 0.01 + c.dt));
    *force = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        *force += p.mass * p.a[0];
    }
    while (sph_time(sim) < 0.02)
        must(sim, sph_step_to(sim, 0.02));
    sph_get_totals(sim, &sum);
    assert_int_equal(free_sims(NULL), 0);
    return sum.momentum[0];
}

/* The velocity of a table jumps at its rows. The push on the water does not depend on how the step there is cut; its
   force neither, but for what half a step of the jump is in the predictor-corrector's trapezoidal rule. */
static void a_jump_of_a_wall_gives_the_same_push_however_a_step_is_cut(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        const double within = i == SPH_PREDICTOR_CORRECTOR ? 0.01 : 0.005;
        double whole, first, second;
        const double a = pushed_by_a_table(i, 0, &whole), b = pushed_by_a_table(i, 1e-6, &first),
                     d = pushed_by_a_table(i, 1e-8, &second);
        print_message("integrator %u: momentum %.4g, %.4g, %.4g; force %.4g, %.4g, %.4g\n", i, a, b, d, whole, first,
                      second);
        close_to(b / a, 1, 0.002);
        close_to(d / a, 1, 0.002);
        close_to(first / whole, 1, within);
        close_to(second / whole, 1, within);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(every_kind_of_wall_repels_from_every_side),
        subject(the_image_of_a_boundary_wall_pushes_the_other_way),
        subject(a_monaghan_kos_wall_asks_for_a_support_of_two_spacings),
        subject(walls_stand_where_they_should),
#if SPH_DIM > 1
        subject(a_corner_pushes_along_the_diagonal),
#endif
        subject(images_act_like_real_copies),
        subject(a_moving_wall_does_the_work_that_the_fluid_gains),
        subject(a_gate_is_gone_when_its_time_has_come),
        subject(a_table_moves_a_wall_in_straight_pieces),
        subject(a_jump_of_a_wall_gives_the_same_push_however_a_step_is_cut),
        subject(a_particle_bounces_off_a_mirror_and_is_counted),
    };
    return run_subjects("walls", list);
}
