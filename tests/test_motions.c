/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_motions.c: walls that move as they are told: what is asked of a motion, and any distance round a periodic
   axis. */
#include "testing.h"

#include "sph/internal.h"

#define DX 0.0625
#define L 2.0 /* a power of two, as are the places of particles: a shift by half of it rounds nothing */
#define UP (SPH_DIM > 1 ? 1 : 0)
enum { MOST = 6000, ROW = 11 }; /* particles of a row of the stream */

/* ---- what is asked ---- */

typedef struct asked {
    double least, most; /* times since the last look */
    uint32_t times;
    double speed;       /* what the host wants now, and knows for no later time */
    double place, since;
} asked;

static void steered(void *ctx, double t, double *x, double *v)
{
    asked *a = ctx;
    a->least = t < a->least ? t : a->least;
    a->most = t > a->most ? t : a->most;
    a->times++;
    x[0] = a->place + a->speed * (t - a->since);
    v[0] = a->speed;
}
static void steer(asked *a, double now, double speed)
{
    a->place += a->speed * (now - a->since);
    a->since = now;
    a->speed = speed;
    a->least = 1e300;
    a->most = -1;
}

static sph_sim *piston(uint32_t integrator, uint32_t kind, asked *a)
{
    sph_config c = open_config(1, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM], hi[SPH_DIM];
    sph_sim *sim;
    uint32_t set;
    c.integrator = integrator;
    c.dt = 1e-3;
    c.max_particles = MOST;
    w.kind = kind;
    w.motion = steered;
    w.motion_ctx = a;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0, hi[k] = 4 * DX;
    sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    return sim;
}

static void a_motion_is_asked_for_the_step_under_way_only(void **state)
{
    static const uint32_t kinds[] = {SPH_WALL_ADAMI, SPH_WALL_GHOST};
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++)
        for (int kind = 0; kind < 2; kind++) {
            asked a = {1e300, -1, 0, 0, 0, 0};
            sph_sim *sim = piston(i, kinds[kind], &a);
            must(sim, sph_ready(sim));
            assert_true(a.times > 0 && a.least >= 0 && a.most <= 0);
            for (uint32_t k = 0; k < 6; k++) {
                const double before = sph_time(sim);
                sph_status st = SPH_NOT_DONE;
                steer(&a, before, 0.3 * (k % 3));
                while (k % 2 && st == SPH_NOT_DONE)
                    st = sph_step_slice(sim, 100);
                if (k % 2 == 0)
                    st = sph_step(sim);
                must(sim, st);
                assert_true(a.least >= before && a.most <= sph_time(sim));
            }
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* ---- round a periodic axis ---- */

typedef struct told {
    double rounds; /* displacement at time 0, in domains */
} told;
static void round_and_round(void *ctx, double t, double *x, double *v)
{
    x[0] = ((const told *)ctx)->rounds * L + 1.5 * t;
    v[0] = 1.5;
}

/* an obstacle in a cloud of water that streams past it, and drops inside it that are put back; all of it stands
   `shift` further along the periodic axis, the obstacle because it was moved there */
static sph_sim *stream(uint32_t kind, bool no_slip, double shift, double dt, const told *to)
{
    sph_config c = open_config(L / 2, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM], hi[SPH_DIM];
    sph_sim *sim;
    uint32_t set;
    sph_rng rng;
    c.face[0][0] = c.face[0][1] = SPH_PERIODIC;
    c.lo[0] = 0, c.hi[0] = L;
    c.smoothing_length = 1.25 * DX;
    c.viscosity = SPH_MORRIS;
    c.nu = 0.02;
    c.on_leave = SPH_REMOVE;
    /* a tenth of a spacing off a wall of forces a drop would be shot away */
    c.on_cross = kind >= SPH_WALL_GHOST ? SPH_PUT_BACK : SPH_REMOVE;
    c.dt = dt; /* 0: as the limits say */
    c.max_particles = MOST;
    w.kind = kind;
    w.no_slip = no_slip;
    w.motion = round_and_round;
    w.motion_ctx = (void *)(uintptr_t)to;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = k ? 0.25 : 0.75, hi[k] = lo[k] + 7 * DX;
    sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    sph_rng_seed(&rng, 5, 1);
    uint32_t total = 1;
    for (int k = 0; k < SPH_DIM; k++)
        total *= ROW;
    for (uint32_t i = 0; i < total; i++) {
        double x[SPH_DIM], v[SPH_DIM];
        uint32_t at = i, inside = 0, deep = 0;
        for (int k = 0; k < SPH_DIM; k++, at /= ROW) {
            const double q = lo[k] + ((int)(at % ROW) - 1.5 + 0.4 * sph_rng_uniform(&rng)) * DX;
            x[k] = ldexp(floor(ldexp(q, 12)), -12);
            v[k] = 1.5 * (k == 0) + 2 * sph_rng_uniform(&rng) - 1;
            inside += x[k] > lo[k] - 0.8 * DX && x[k] < hi[k] + 0.8 * DX;
            deep += x[k] > lo[k] + 1.4 * DX && x[k] < hi[k] - 1.4 * DX;
        }
        if (inside == SPH_DIM && (deep < SPH_DIM || i % 3))
            continue;
        x[0] += shift;
        x[0] -= x[0] >= L ? L : 0;
        must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
    }
    must(sim, sph_add_wall_box(sim, &w, lo, hi, (1u << 2 * SPH_DIM) - 1, false, NULL));
    return sim;
}

/* largest difference of places, velocities and accelerations of the same particles */
static double apart(const sph_sim *a, const sph_sim *b, double shift)
{
    double worst = 0;
    sph_particle p, q;
    for (uint32_t i = 0; i < sph_count(a); i++) {
        assert_int_equal(sph_get(a, i, &p), SPH_OK);
        q = by_id(b, p.id);
        for (int k = 0; k < SPH_DIM; k++) {
            double d = fabs(q.x[k] - p.x[k] - (k == 0 ? shift : 0));
            d = fmin(d, fabs(d - L));
            worst = fmax(worst, d / DX + fabs(p.v[k] - q.v[k]) + fabs(p.a[k] - q.a[k]) / 1e4);
        }
    }
    return worst;
}

static void a_wall_goes_any_distance_round_a_periodic_axis(void **state)
{
    static const double rounds[] = {1, 0.5, 5.5, -1000.5};
    static const told still = {0};
    static told to;
    (void)state;
    for (uint32_t kind = 0; kind < SPH_WALLS; kind++)
        for (int slip = 0; slip < 2; slip++)
            for (size_t r = 0; r < sizeof rounds / sizeof *rounds; r++) {
                const double shift = L * (rounds[r] - floor(rounds[r]));
                sph_step_info a, b;
                to.rounds = rounds[r];
                sph_sim *one = stream(kind, slip, 0, 5e-5, &still), *other = stream(kind, slip, shift, 5e-5, &to);
                for (int k = 0; k < 6; k++) {
                    must(one, sph_step(one));
                    must(other, sph_step(other));
                }
                sph_get_step(one, &a);
                sph_get_step(other, &b);
                assert_int_equal(a.put_back, b.put_back);
                assert_int_equal(a.crossed, b.crossed);
                assert_true(a.crossed >= 1);
                const double d = apart(one, other, shift);
                if (!(d < (SPH_DOUBLE ? 1e-9 : 0.02)))
                    fail_msg("wall %u%s, %g rounds: %g apart", kind, slip ? " no slip" : "", rounds[r], d);
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* through several domains in one run: where it is, and no water left behind or caught */
static void a_paddle_goes_round_and_round(void **state)
{
    static const told still = {0};
    (void)state;
    sph_sim *sim = stream(SPH_WALL_ADAMI, false, 0, 0, &still);
    uint32_t first = 0;
    while (by_id(sim, first).role == SPH_ROLE_FLUID)
        first++;
    sph_particle p = by_id(sim, first); /* of the wall */
    const double x0 = p.x[0];
    sph_totals sum;
    while (sph_time(sim) < 3)
        must(sim, sph_step_to(sim, 3));
    p = by_id(sim, first);
    double way = p.x[0] - x0 - 4.5;
    way -= L * floor(way / L + 0.5);
    close_to(way, 0, 1e-6);
    close_to(p.v[0], 1.5, 1e-6);
    sph_get_totals(sim, &sum);
    assert_true(sum.max_speed < 20);
}

#if SPH_DIM == 2 && SPH_WITH_WALL_GHOST
/* Piston and water go at one velocity over a bed of ghosts whose density goes by continuity: there it stays, also under
   the piston's foot. What it would be without the piston in its sum is a part of V/h. */
static void a_bed_of_ghosts_does_not_thin_out_under_a_piston(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        static const sph_steady push = {.v = {1, 0}};
        const double lo[2] = {0, 0}, hi[2] = {16 * DX, 8 * DX}, bed[2] = {-4 * DX, 0};
        sph_config c = open_config(1, DX);
        sph_wall w = sph_wall_default();
        uint32_t set, under = 0;
        c.scheme = i & 1 ? SPH_WEAK : SPH_STANDARD;
        c.gradient = i & 2 ? SPH_BONET_LOK : SPH_PLAIN; /* averages of B are nowhere exact */
        c.smoothing_length = 1.25 * DX; /* what it reaches is no whole number of spacings */
        c.lo[1] = -1;
        w.kind = SPH_WALL_GHOST;
        w.compressible = true;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        must(sim, sph_add_box(sim, set, lo, hi, NULL));
        must(sim, sph_add_wall_box(sim, &w, bed, hi, SPH_LOW(1), true, NULL));
        w.motion = sph_motion_steady;
        w.motion_ctx = (void *)(uintptr_t)&push;
        must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
        for (uint32_t k = 0; k < sim->now.count; k++) {
            sph_buffer *b = &sim->buf[sim->cur];
            if (sim->set[b->set[0][k]].role == SPH_ROLE_FLUID)
                b->vel[0][k] = 1;
        }
        must(sim, sph_ready(sim));
        for (uint32_t k = 0; k < sph_count(sim); k++) {
            const double rate = (double)sim->buf[sim->cur].drho[0][k];
            sph_particle p;
            assert_int_equal(sph_get(sim, k, &p), SPH_OK);
            /* behind the foot, with the whole of the piston's layers above */
            const bool foot = p.x[1] < 0 && p.x[0] > -0.6 * DX && p.x[0] < 4 * DX;
            if (p.role != SPH_ROLE_GHOST || !foot)
                continue;
            under++;
            close_to(rate, 0, (SPH_DOUBLE ? 1e-12 : 1e-5) / DX);
        }
        assert_true(under > 8);
        assert_int_equal(free_sims(NULL), 0);
    }
}
#endif

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_motion_is_asked_for_the_step_under_way_only),
        subject(a_wall_goes_any_distance_round_a_periodic_axis),
        subject(a_paddle_goes_round_and_round),
#if SPH_DIM == 2 && SPH_WITH_WALL_GHOST
        subject(a_bed_of_ghosts_does_not_thin_out_under_a_piston),
#endif
    };
    return run_subjects("motions", list);
}
