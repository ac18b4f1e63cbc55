/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_plates.c: walls that act on one side only (sph_wall.side): of two waters on both sides of a plate neither feels
   what the plate is to the other, everybody feels it exactly once, and what a moving plate does is in the work. */
#include "testing.h"

#define DX 0.1
#define N (SPH_DIM == 3 ? 5 : 8) /* spacings of water along an edge */
#define LAYERS 3

enum { LAST = SPH_DIM - 1 };
enum { LEFT = 1, RIGHT = 2, AROUND = 4 };

static sph_config config(void)
{
    sph_config c = open_config(2.5 * N * DX, DX);
    c.max_particles = 6000;
    c.alpha = 0.1;
    c.books = true;
    return c;
}

/* a block of uneven water, moved by `from` spacings */
static void add_water(sph_sim *sim, uint32_t set, const double *from)
{
    sph_rng rng;
    sph_rng_seed(&rng, 7, 1);
    uint32_t n[3] = {N, SPH_DIM > 1 ? N : 1, SPH_DIM > 2 ? N : 1}, i[3];
    for (i[2] = 0; i[2] < n[2]; i[2]++)
        for (i[1] = 0; i[1] < n[1]; i[1]++)
            for (i[0] = 0; i[0] < n[0]; i[0]++) {
                double x[SPH_DIM], v[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    x[k] = (from[k] + i[k] + 0.4 + 0.2 * sph_rng_uniform(&rng)) * DX;
                    v[k] = sph_rng_uniform(&rng) - 0.5;
                }
                must(sim, sph_add_particle(sim, set, x, v, 995 + 10 * sph_rng_uniform(&rng), NULL));
            }
}

/* the plate: x 0 .. LAYERS dx, as high as the water and from `bottom` spacings on */
static void add_face(sph_sim *sim, uint32_t kind, uint32_t face, uint32_t side, double bottom, sph_motion motion)
{
    double lo[SPH_DIM], hi[SPH_DIM];
    sph_wall w = sph_wall_default();
    w.kind = kind;
    w.side = side;
    w.layers = LAYERS;
    w.motion = motion;
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = k ? -DX : 0;
        hi[k] = (k ? N + 1 : LAYERS) * DX;
    }
    if (SPH_DIM > 1)
        lo[LAST] = bottom * DX;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, face, false, NULL));
}

static sph_sim *two_waters(uint32_t kind, uint32_t side, uint32_t which)
{
    const sph_config c = config();
    const double left[3] = {-N, 0, 0}, right[3] = {LAYERS, 0, 0};
    uint32_t set;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    if (which & LEFT)
        add_water(sim, set, left);
    if (which & RIGHT)
        add_water(sim, set, right);
    add_face(sim, kind, SPH_LOW(0), side, -1, NULL);
    add_face(sim, kind, SPH_HIGH(0), side, -1, NULL);
    must(sim, sph_ready(sim));
    return sim;
}

/* largest difference of accelerations of particles first .. first + n of one, 0 .. n of the other, and their size */
static double difference(const sph_sim *one, uint32_t first, const sph_sim *other, uint32_t n, double *size)
{
    double most = 0;
    *size = 0;
    for (uint32_t i = 0; i < n; i++) {
        const sph_particle p = by_id(one, first + i), q = by_id(other, i);
        for (int k = 0; k < SPH_DIM; k++) {
            most = fmax(most, fabs(p.a[k] - q.a[k]));
            *size = fmax(*size, fabs(q.a[k]));
        }
    }
    return most;
}

static void neither_of_two_waters_feels_what_the_plate_is_to_the_other(void **state)
{
    const uint32_t n = SPH_DIM == 1 ? N : SPH_DIM == 2 ? N * N : N * N * N;
    for (uint32_t kind = SPH_WALL_GHOST; kind <= SPH_WALL_ADAMI; kind++)
        for (uint32_t side = SPH_BOTH_SIDES; side <= SPH_FACE; side++) {
            double size;
            sph_sim *both = two_waters(kind, side, LEFT | RIGHT), *left = two_waters(kind, side, LEFT);
            sph_sim *right = two_waters(kind, side, RIGHT);
            const double off = fmax(difference(both, 0, left, n, &size), difference(both, n, right, n, &size)) / size;
            if (side == SPH_BOTH_SIDES && kind == SPH_WALL_ADAMI)
                assert_true(off > 1e-3); /* such a plate hands the pressure of one water on to the other */
            else
                close_to(off, 0, 200 * EPS);
            free_sims(state);
        }
}

#if SPH_DIM > 1
/* a plate of faces FRONT, and FACE at its ends, is to everybody what one block of ghosts is */
static void everybody_feels_a_plate_exactly_once(void **state)
{
    (void)state;
    double size;
    const sph_config c = config();
    const double at[4][3] = {{-N, 0, 0}, {LAYERS, 0, 0}, {-2, -N + 2, 0}, {-2, 2 - N, 0}};
    sph_sim *sim[2];
    uint32_t n = 0;
    for (int way = 0; way < 2; way++) {
        uint32_t set;
        sim[way] = new_sim(&c);
        must(sim[way], sph_add_fluid(sim[way], NULL, &set));
        for (int k = 0; k < 3; k++) {
            double from[3] = {at[k][0], SPH_DIM == 2 ? at[k][1] : 0, at[k][1]};
            from[LAST] = k < 2 ? at[k][1] : -N; /* the third passes under the plate's end, which is at 1 */
            add_water(sim[way], set, from);
        }
        n = sph_count(sim[way]);
        if (!way) {
            add_face(sim[way], SPH_WALL_GHOST, SPH_LOW(0), SPH_BOTH_SIDES, 1, NULL);
            continue;
        }
        add_face(sim[way], SPH_WALL_GHOST, SPH_LOW(0), SPH_FRONT, 1, NULL);
        add_face(sim[way], SPH_WALL_GHOST, SPH_HIGH(0), SPH_FRONT, 1, NULL);
        add_face(sim[way], SPH_WALL_GHOST, SPH_LOW(LAST), SPH_FACE, 1, NULL);
    }
    must(sim[0], sph_ready(sim[0]));
    must(sim[1], sph_ready(sim[1]));
    const double off = difference(sim[1], 0, sim[0], n, &size);
    close_to(off / size, 0, 200 * EPS);
}
#endif

static void push(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.4 * t;
    v[0] = 0.4;
}
static void what_a_moving_plate_does_is_in_the_work(void **state)
{
    for (uint32_t kind = SPH_WALL_GHOST; kind <= SPH_WALL_ADAMI; kind++) {
        double off[2];
        for (int half = 0; half < 2; half++) {
            sph_config c = config();
            const double left[3] = {-N, 0, 0}, right[3] = {LAYERS, 0, 0};
            sph_totals first, t;
            uint32_t set;
            c.integrator = SPH_KICK_DRIFT_KICK;
            c.dt = half ? 1e-4 : 2e-4;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set));
            add_water(sim, set, left);
            add_water(sim, set, right);
            add_face(sim, kind, SPH_LOW(0), SPH_FRONT, -1, push);
            add_face(sim, kind, SPH_HIGH(0), SPH_FRONT, -1, push);
            must(sim, sph_ready(sim));
            sph_get_totals(sim, &first);
            while (sph_time(sim) < 0.02)
                must(sim, sph_step_to(sim, 0.02));
            sph_get_totals(sim, &t);
            assert_true(fabs(t.wall_work) > 0);
            off[half] = fabs(t.balance - first.balance) / fabs(t.wall_work);
        }
        if (!(off[1] < 2e-3 + (SPH_DOUBLE ? 0 : 2e-3)))
            fail_msg("kind %u: balance off by %g and %g of the work", kind, off[0], off[1]);
        free_sims(state);
    }
}

/* Rates of the middle of a step are of who is in front of the plate there: with the same step, one goes through the
   plane of the face before the middle and one behind it. */
static void in_the_middle_of_a_step_the_place_of_the_middle_counts(void **state)
{
    static const uint32_t first[] = {SPH_KICK_DRIFT_KICK, SPH_LEAP_FROG};
    static const double from[] = {-0.1, -0.3}; /* spacings; by 0.4 */
    for (uint32_t by = 0; by < 2; by++)
        for (uint32_t late = 0; late < 2; late++)
            for (uint32_t moves = 0; moves < 2; moves++) { /* or the plate does, the other way */
                static const sph_steady back = {.v = {-1}};
                double x[SPH_DIM], lo[SPH_DIM], hi[SPH_DIM], v[SPH_DIM] = {moves ? 0 : 1};
                uint32_t set;
                sph_config c = config();
                sph_wall w = sph_wall_default();
                c.integrator = first[by];
                c.cfl = 10;
                c.dt = 0.4 * DX;
                sph_sim *sim = new_sim(&c);
                w.kind = SPH_WALL_GHOST;
                w.side = SPH_FRONT;
                w.layers = LAYERS;
                w.motion = moves ? sph_motion_steady : NULL;
                w.motion_ctx = (void *)(uintptr_t)&back;
                for (int k = 0; k < SPH_DIM; k++) {
                    lo[k] = k ? -LAYERS * DX : -1.2 * LAYERS * DX;
                    hi[k] = k ? LAYERS * DX : 0;
                    x[k] = k ? 0.3 * DX : from[late] * DX;
                }
                must(sim, sph_add_fluid(sim, NULL, &set));
                must(sim, sph_add_particle(sim, set, x, v, 1000, NULL));
                must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_HIGH(0), false, NULL));
                must(sim, sph_ready(sim));
                must(sim, sph_step(sim));
                if (late)
                    close_to(by_id(sim, 0).rho, 1000, 0);
                else
                    assert_true(by_id(sim, 0).rho < 990);
                free_sims(state);
            }
}

static void what_is_not_allowed_is_refused(void **state)
{
    (void)state;
    const sph_config c = config();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    sph_wall w = sph_wall_default();
    sph_sim *sim = new_sim(&c);
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = N * DX;
    w.side = SPH_SIDES;
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "wall.side");
    w.side = SPH_FRONT;
    w.kind = SPH_WALL_KERNEL_FORCE;
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL), SPH_BAD_ARGUMENT);
    w.kind = SPH_WALL_GHOST;
    w.compressible = true;
    assert_int_equal(sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL), SPH_BAD_ARGUMENT);
    w.compressible = false;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        subject(neither_of_two_waters_feels_what_the_plate_is_to_the_other),
#if SPH_DIM > 1
        subject(everybody_feels_a_plate_exactly_once),
#endif
        subject(what_a_moving_plate_does_is_in_the_work),
        subject(in_the_middle_of_a_step_the_place_of_the_middle_counts),
        subject(what_is_not_allowed_is_refused),
    };
    return run_subjects("plates", tests);
}
