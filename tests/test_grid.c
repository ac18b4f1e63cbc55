/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_grid.c: places and cells: every pair within a support is seen, over every kind of seam and for any size of the
   domain; what moves less than half a quantum a step still moves. */
#include "testing.h"

#include "sph/config.h"
#include "sph/motion.h"

static sph_rng dice;
static double toss(double low, double high) { return low + (high - low) * sph_rng_uniform(&dice); }
static uint32_t draw(uint32_t n) { return (uint32_t)(sph_rng_uniform(&dice) * n); }

/* ---- cells ---- */

/* first place of a cell along axis k, in quanta */
static sph_pos cell_start(const sph_sim *sim, uint32_t k, uint32_t cell)
{
    sph_pos low = 0, high = sim->grid.extent[k];
    while (low < high) {
        const sph_pos mid = low + (high - low) / 2;
        if (sph_cell_axis(sim, k, mid) < cell)
            low = mid + 1;
        else
            high = mid;
    }
    return low;
}

/* two places with a whole cell between them are more than a support apart, and nothing lies beyond the last cell */
static void no_cell_is_narrower_than_a_support(void **state)
{
    static sph_sim sim; /* only its grid is used */
    (void)state;
    sph_rng_seed(&dice, 3, 1);
    for (int trial = 0; trial < 3000; trial++) {
        sph_config c = open_config(1, 0.1);
        sph_report r;
        size_t bytes;
        for (uint32_t k = 0; k < SPH_DIM; k++) { /* from a tenth of a support to 3e5 of them along one axis */
            const double supports = k == 0 ? sph_exp(toss(-2.3, 12.6)) : sph_exp(toss(-2.3, 3));
            c.lo[k] = toss(-1, 1);
            c.hi[k] = c.lo[k] + (supports < 0.5 ? 0.5 : trial % 5 ? supports : (double)(uint32_t)(supports + 1)) * 0.24;
        }
        if (sph_check_config(&c, &sim.grid, &bytes, &r) != SPH_OK)
            fail_msg("%s = %g: %s", r.what, r.value, r.allowed);
        const double support = sim.grid.support / sim.grid.quantum; /* quanta */
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const uint32_t n = sim.grid.ncell[k];
            assert_true(sph_cell_axis(&sim, k, sim.grid.extent[k] - 1) == n - 1 && sph_cell_axis(&sim, k, 0) == 0);
            for (uint32_t look = 0; n > 1 && look < 24; look++) {
                const bool last = look < 8 && look < n, first = look >= 8 && look < 12 && look - 8 < n;
                const uint32_t cell = last ? n - 1 - look : first ? look - 8 : draw(n);
                const sph_pos start = cell_start(&sim, k, cell);
                const sph_pos end = cell + 1 < n ? cell_start(&sim, k, cell + 1) : sim.grid.extent[k];
                if (!((double)(end - start) + 1 > support))
                    fail_msg("axis %u of %.17g m, cell %u of %u: %.0f quanta, support %.3f", k, sim.grid.length[k],
                             cell, n, (double)(end - start), support);
            }
        }
    }
}

/* ---- brute force ---- */

typedef struct place {
    double x[SPH_DIM];
} place;

/* W summed over i's images along the axes from k on; x is the place of an image so far */
static double sum_images(const sph_config *c, const place *home, place x, uint32_t k)
{
    double sum = 0;
    if (k == SPH_DIM) {
        double r2 = 0, w, dw;
        for (int a = 0; a < SPH_DIM; a++)
            r2 += (home->x[a] - x.x[a]) * (home->x[a] - x.x[a]);
        assert_int_equal(sph_kernel_value(c->kernel, sqrt(r2), c->smoothing_length, &w, &dw), SPH_OK);
        return w;
    }
    const double at = x.x[k], length = c->hi[k] - c->lo[k];
    sum = sum_images(c, home, x, k + 1);
    for (int side = 0; side < 2; side++) {
        const uint32_t face = c->face[k][side];
        if (face == SPH_OPEN)
            continue;
        if (face == SPH_PERIODIC)
            x.x[k] = side ? at + length : at - length;
        else
            x.x[k] = 2 * (side ? c->hi[k] : c->lo[k]) - at;
        sum += sum_images(c, home, x, k + 1);
    }
    return sum;
}

/* the summed density of every particle of a random cloud against all pairs with all images; in every fourth trial in
   much room, of which most strips of cells are not looked at (SPH_STRIP) */
static void every_pair_within_a_support_is_seen(void **state)
{
    enum { MANY = 60 };
    static const uint32_t kinds[][2] = {{SPH_PERIODIC, SPH_PERIODIC}, {SPH_SYMMETRY, SPH_SYMMETRY},
                                        {SPH_SYMMETRY, SPH_MIRROR_NO_SLIP}, {SPH_SYMMETRY, SPH_OPEN},
                                        {SPH_OPEN, SPH_SYMMETRY}, {SPH_OPEN, SPH_OPEN}};
    (void)state;
    sph_rng_seed(&dice, 3, 2);
    for (int trial = 0; trial < (SPH_DIM == 3 ? 60 : 200); trial++) {
        const double room = trial % 4 ? 1 : SPH_DIM == 3 ? 4 : 12;
        sph_config c = open_config(1, 0.1);
        place p[MANY];
        uint32_t set;
        c.kernel = SPH_HAT; /* the one with the heaviest tail */
        c.density = SPH_SUMMATION;
        c.eos = SPH_LINEAR;
        c.viscosity = SPH_INVISCID;
        c.smoothing_length = 0.12;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const uint32_t *kind = kinds[trial % 3 ? draw(6) : k == 0 ? draw(2) : 5]; // NOLINT
            c.face[k][0] = kind[0], c.face[k][1] = kind[1];
            c.lo[k] = toss(-1, 1);
            c.hi[k] = c.lo[k] + 0.24 * room * (kind[0] == SPH_PERIODIC ? toss(3.01, 12) : toss(1.01, 9));
        }
        c.max_particles = MANY;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, &(sph_fluid){.mass = 5}, &set));
        for (uint32_t i = 0; i < MANY; i++) {
            for (int k = 0; k < SPH_DIM; k++) { /* many at the faces */
                const double length = c.hi[k] - c.lo[k], near = length < 0.3 ? length : 0.3;
                const uint32_t where = draw(3);
                p[i].x[k] = where == 0 ? c.lo[k] + toss(0, near)
                            : where == 1 ? c.hi[k] - toss(1e-6, near) : toss(c.lo[k], c.hi[k] - 1e-6);
            }
            must(sim, sph_add_particle(sim, set, p[i].x, NULL, 0, NULL));
        }
        must(sim, sph_ready(sim));
        for (uint32_t i = 0; i < MANY; i++) {
            double sum = 0;
            for (uint32_t j = 0; j < MANY; j++)
                sum += 5 * sum_images(&c, &p[i], p[j], 0);
            /* a kernel's slope is 1 in W(0) a support; places are off by a quantum of 1e-8 supports in float, in so
               much more room by so much more */
            const double rho = by_id(sim, i).rho;
            if (!(fabs(rho - sum) <= 200 * EPS * room * sum + 1e-12))
                fail_msg("trial %d, particle %u: %.9g for %.9g", trial, i, rho, sum);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- much room ---- */

enum { CLOUDS = 7, OF_CLOUD = 12, ROOM_STEPS = 12 };

/* clouds of particles that fly apart, at faces, in corners, anywhere; the domain is periodic or open */
static sph_sim *flying_clouds(uint32_t trial, shuffle *s)
{
    sph_config c = open_config(1, 0.1);
    uint32_t set;
    sph_rng_seed(&dice, 3, 100 + trial);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        c.lo[k] = 0;
        c.hi[k] = 0.24 * (SPH_DIM == 3 ? toss(12, 40) : SPH_DIM == 2 ? toss(20, 150) : toss(60, 400));
        c.face[k][0] = c.face[k][1] = draw(2) ? SPH_PERIODIC : SPH_OPEN;
    }
    c.viscosity = SPH_INVISCID;
    c.integrator = trial % SPH_INTEGRATORS;
    c.dt = 1e-3;
    c.max_particles = CLOUDS * OF_CLOUD;
    c.on_leave = SPH_REMOVE;
    c.max_threads = 3;
    c.port = shuffle_port(s, 3);
    sph_sim *sim = new_sim(&c);
    /* so light that none is thrown about */
    must(sim, sph_add_fluid(sim, &(sph_fluid){.mass = SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? 0.1 : 0.01}, &set));
    for (uint32_t i = 0; i < CLOUDS; i++) {
        double mid[SPH_DIM], x[SPH_DIM], v[SPH_DIM];
        for (uint32_t k = 0; k < SPH_DIM; k++)
            mid[k] = draw(3) ? (c.hi[k] - 0.3) * draw(2) : toss(0, c.hi[k] - 0.3);
        for (uint32_t j = 0; j < OF_CLOUD; j++) {
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                x[k] = mid[k] + toss(0, 0.29);
                v[k] = toss(-60, 60);
            }
            must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        }
    }
    must(sim, sph_ready(sim));
    return sim;
}

/* whole steps by threads, steps in slices, and steps that know no cell of the step before give the same bits */
static void much_room_changes_no_bit(void **state)
{
    (void)state;
    for (uint32_t trial = 0; trial < (SPH_DIM == 3 ? 20 : 40); trial++) {
        shuffle order[3];
        sph_sim *whole = flying_clouds(trial, &order[0]), *anew = flying_clouds(trial, &order[1]),
                *slices = flying_clouds(trial, &order[2]);
        for (uint32_t step = 0; step < ROOM_STEPS; step++) {
            sph_status st;
            must(whole, sph_step(whole));
            anew->table_valid = false;
            must(anew, sph_step(anew));
            while ((st = sph_step_slice(slices, 2000)) == SPH_NOT_DONE)
                ;
            must(slices, st);
            const uint64_t hash = sph_hash(whole);
            if (sph_hash(anew) != hash || sph_hash(slices) != hash)
                fail_msg("trial %u, step %u: %s", trial, step, sph_hash(anew) != hash ? "sorted anew" : "in slices");
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* an axis between two mirrors shorter than a support would miss second images: one row of water at dx has 863 for 1000
   where it is one spacing long */
static void an_axis_between_mirrors_holds_a_support(void **state)
{
    (void)state;
    sph_config c = open_config(1, 0.1);
    sph_report r;
    c.lo[0] = 0;
    c.face[0][0] = SPH_SYMMETRY;
    c.face[0][1] = SPH_MIRROR_NO_SLIP;
    for (int k = 1; k < 25; k++) {
        c.hi[0] = 0.1 + 0.01 * k;
        const sph_status st = sph_config_check(&c, &r);
        assert_int_equal(st, c.hi[0] < 0.24 - 1e-9 ? SPH_BAD_CONFIG : SPH_OK);
        assert_int_equal(sph_arena_bytes(&c) > 0, st == SPH_OK);
        if (st)
            assert_true(strcmp(r.what, "hi") == 0 && strstr(r.allowed, "between two mirrors"));
    }
    c.hi[0] = 0.1; /* one mirror has no second images */
    c.face[0][1] = SPH_OPEN;
    assert_int_equal(sph_config_check(&c, &r), SPH_OK);
}

/* ---- places ---- */

/* steps of one particle along x in an otherwise empty domain; returns how far it went (m) */
static double travel(uint32_t integrator, double length, double v, double dt, uint32_t steps)
{
    sph_config c = open_config(1, 0.01);
    double at[SPH_DIM], speed[SPH_DIM] = {v};
    sph_particle p;
    uint32_t set;
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = 0;
        c.hi[k] = k == 0 ? length : 0.1;
        at[k] = 0.5 * c.hi[k];
    }
    c.sound_speed = 1;
    c.dt = dt;
    c.integrator = integrator;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_particle(sim, set, at, speed, 0, NULL));
    must(sim, sph_ready(sim));
    assert_int_equal(sph_get(sim, 0, &p), SPH_OK);
    const double from = p.x[0];
    for (uint32_t n = 0; n < steps; n++)
        must(sim, sph_step(sim));
    assert_int_equal(sph_get(sim, 0, &p), SPH_OK);
    close_to(p.v[0], v, EPS * fabs(v));
    for (int k = 1; k < SPH_DIM; k++)
        close_to(p.x[k], at[k], 1e-5);
    assert_int_equal(free_sims(NULL), 0);
    return p.x[0] - from;
}

/* v/c of 1e-6 at the usual step, 0.25 h/c: a hundredth of a quantum in a domain of 200 in float */
static void what_moves_less_than_a_quantum_a_step_moves_on(void **state)
{
    const double dt = 0.25 * 0.012;
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++) {
        const double v = integrator % 2 ? 1e-6 : -1e-6;
        close_to(travel(integrator, 50, v, dt, 8000), v * dt * 8000, 0.01 * fabs(v) * dt * 8000);
        close_to(travel(integrator, 0.5, 10 * v, dt, 500), 10 * v * dt * 500, 0.01 * 10 * fabs(v) * dt * 500);
    }
}

/* the sum over many steps of any displacement, in quanta, is off by less than 1.5 + 0.35 ln n of them */
static void displacements_add_up(void **state)
{
    static sph_sim sim; /* only its step is read */
    (void)state;
    sph_rng_seed(&dice, 3, 4);
    for (int trial = 0; trial < 200; trial++) {
        const double d = trial == 0 ? 0.00315 /* 1e-6 c in a domain of 1000 */ : sph_exp(toss(-12, 2));
        const uint32_t n = 100000, first = draw(1u << 30);
        double gone = 0;
        for (uint32_t i = 0; i < n; i++) {
            sim.next.step = first + i;
            const double u = (double)sph_rounding(&sim);
            assert_true(u >= 0 && u < 1);
            gone += floor(d + u);
        }
        close_to(gone, n * d, 1.5 + 0.35 * log(n));
        if (trial == 0)
            close_to(gone, n * d, 0.01 * n * d);
    }
    sim.next.step = 0;
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(no_cell_is_narrower_than_a_support),
        subject(every_pair_within_a_support_is_seen),
        subject(much_room_changes_no_bit),
        subject(an_axis_between_mirrors_holds_a_support),
        subject(what_moves_less_than_a_quantum_a_step_moves_on),
        subject(displacements_add_up),
    };
    return run_subjects("grid", list);
}
