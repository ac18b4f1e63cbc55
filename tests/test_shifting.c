/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_shifting.c: particle shifting against sums of its own over all pairs, walls and images, in double: where nobody
   is shifted, how far the others are, what must not be touched, the book, refusals, and that restarts, slices and
   threads change nothing. */
#include "examples/scenes/scene.h"
#include "sph/internal.h"
#include "any_way.h"
#include "testing.h"

enum { UP = SPH_DIM - 1, N = SPH_DIM == 1 ? 60 : SPH_DIM == 2 ? 16 : 8 };
#define DX 0.125
#define EDGE (N * DX)
#define DT 1e-3

enum { OPEN, PERIODIC, MIRRORS, TANK, GHOSTS, WORLDS };

/* jittered water in [0, EDGE]^DIM: free; round; between mirrors; in a tank whose walls are Adami's or ghosts */
static sph_config world(uint32_t w, double c_shift)
{
    sph_config c = w == PERIODIC ? periodic_config(EDGE, DX) : open_config(EDGE, DX);
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.gravity[UP] = -9.81;
    c.shifting = c_shift;
    c.dt = DT;
    for (int k = 0; k < SPH_DIM && w == MIRRORS; k++) {
        c.lo[k] = 0;
        c.hi[k] = EDGE;
        c.face[k][0] = c.face[k][1] = SPH_SYMMETRY;
    }
    return c;
}
static sph_sim *fill(const sph_config *c, uint32_t w)
{
    uint32_t set, faces = 0;
    const double lo[SPH_DIM] = {0};
    double hi[SPH_DIM];
    sph_wall wall = sph_wall_default();
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    random_cloud(sim, set, N, DX, 0.15, 1, 5);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        hi[k] = EDGE;
        faces |= SPH_LOW(k) | (k + 1 < SPH_DIM ? SPH_HIGH(k) : 0);
    }
    wall.kind = w == GHOSTS ? SPH_WALL_GHOST : SPH_WALL_ADAMI;
    wall.compressible = w == GHOSTS;
    if (w >= TANK)
        must(sim, sph_add_wall_box(sim, &wall, lo, hi, faces, true, NULL));
    return sim;
}

/* ---- the sums, once more ---- */

typedef struct sums {
    double slope[SPH_DIM], nearer[SPH_DIM], cover, spread[SPH_DIM][SPH_DIM];
} sums;

/* whether a place has an image number `image` (digits to the base 3) behind the faces, and where */
static bool image_of(const sph_config *c, const double *x, uint32_t image, double *to)
{
    for (uint32_t k = 0; k < SPH_DIM; k++, image /= 3) {
        const uint32_t turn = image % 3, face = turn ? c->face[k][turn - 1] : SPH_OPEN;
        const double l = c->hi[k] - c->lo[k];
        if (turn && face == SPH_OPEN)
            return false;
        if (turn && face == SPH_PERIODIC)
            to[k] = x[k] + (turn == 1 ? -l : l);
        else
            to[k] = turn ? 2 * (turn == 1 ? c->lo[k] : c->hi[k]) - x[k] : x[k];
    }
    return true;
}

/* a pair's (dW/dr)/r, and W */
static double slope_of(const sph_config *c, double r, double *w)
{
    double dw;
    assert_int_equal(sph_kernel_value(c->kernel, r, c->smoothing_length, w, &dw), SPH_OK);
    return r > 0 ? dw / r : 0;
}

static sums sums_at(const sph_sim *sim, const sph_config *c, const double *x)
{
    sums s;
    double w_dx, w_apart;
    const uint32_t images = SPH_DIM == 1 ? 3 : SPH_DIM == 2 ? 9 : 27;
    memset(&s, 0, sizeof s);
    slope_of(c, c->spacing, &w_dx);
    slope_of(c, 0.8 * c->spacing, &w_apart);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        for (uint32_t image = 0; image < images; image++) {
            double y[SPH_DIM], r2 = 0, w;
            if (!image_of(c, p.x, image, y))
                continue;
            for (int k = 0; k < SPH_DIM; k++)
                r2 += (x[k] - y[k]) * (x[k] - y[k]);
            if (r2 > 16 * c->smoothing_length * c->smoothing_length)
                continue;
            const double g = slope_of(c, sqrt(r2), &w), v = p.mass / p.rho, f = w / w_dx;
            s.cover += v * w;
            for (int k = 0; k < SPH_DIM; k++) {
                s.slope[k] += v * (1 + 0.2 * f * f * f * f) * g * (x[k] - y[k]);
                s.nearer[k] += v * 0.5 * fmax(0, pow(f, 4) - pow(w_apart / w_dx, 4)) * g * (x[k] - y[k]);
                for (int l = 0; l < SPH_DIM; l++)
                    s.spread[k][l] -= v * g * (x[k] - y[k]) * (x[l] - y[l]);
            }
        }
    }
    return s;
}

/* the smallest eigenvalue: 3 less the largest of 3 - M, by powers */
static double smallest(const sums *s)
{
    double e[3] = {1, 0.7, 0.4}, large = 0;
    for (int turn = 0; turn < 3000; turn++) {
        double to[3] = {0}, size = 0;
        for (int k = 0; k < SPH_DIM; k++) {
            for (int l = 0; l < SPH_DIM; l++)
                to[k] += ((k == l ? 3 : 0) - s->spread[k][l]) * e[l];
            size += to[k] * to[k];
        }
        large = sqrt(size);
        for (int k = 0; k < SPH_DIM; k++)
            e[k] = to[k] / large;
    }
    return 3 - large;
}

/* how far a particle at x is to be shifted (m), given the largest speed, and by what share its density rises; false:
   too close to a bound to say. why: 0 it is shifted, 1 too little cover, 2 an eigenvalue too small */
static bool wanted(const sph_sim *sim, const sph_config *c, const double *x, double speed, double *d, double *rise,
                   int *why)
{
    const sums s = sums_at(sim, c, x);
    const double least = smallest(&s), by = c->shifting * c->dt * speed * 4 * c->smoothing_length;
    double d2 = 0;
    *why = s.cover <= 0.9 ? 1 : least <= 0.75 ? 2 : 0;
    for (int k = 0; k < SPH_DIM; k++) {
        d[k] = !*why ? -by * s.slope[k] : c->shift_pairs ? -by * s.nearer[k] : 0;
        d2 += d[k] * d[k];
    }
    const double most = 0.05 * c->spacing;
    for (int k = 0; k < SPH_DIM && d2 > most * most; k++)
        d[k] *= most / sqrt(d2);
    *rise = *why || least <= 0.98 ? 0 : fmin(c->shifting * c->dt * speed / c->smoothing_length, 0.5) * (s.cover - 1);
    return fabs(s.cover - 0.9) > 1e-4 && fabs(least - 0.75) > 1e-3 && fabs(least - 0.98) > 1e-3;
}

/* the way from a to b, round the domain where that is shorter */
static double way(const sph_config *c, int k, double a, double b)
{
    const double l = c->hi[k] - c->lo[k], d = b - a;
    return c->face[k][0] != SPH_PERIODIC ? d : d > l / 2 ? d - l : d < -l / 2 ? d + l : d;
}

/* One step with shifting against the same without, and the sums at its places; adds up how many were shifted, and left
   alone for the two reasons, and whose density rose or fell. Returns the largest shift over a spacing. */
static double compare(const sph_config *c, uint32_t w, uint32_t *count)
{
    sph_config plain = *c;
    double largest = 0;
    plain.shifting = 0;
    plain.shift_pairs = false;
    sph_sim *with = fill(c, w), *without = fill(&plain, w);
    must(with, sph_step(with));
    must(without, sph_step(without));
    const double speed = (double)without->now.peaks.speed;
    const double by = c->shifting * DT * speed * 4 * c->smoothing_length;
    for (uint32_t i = 0; i < sph_count(without); i++) {
        sph_particle p, q;
        double d[SPH_DIM], rise;
        int why;
        assert_int_equal(sph_get(without, i, &p), SPH_OK);
        q = by_id(with, p.id);
        if (p.role != SPH_ROLE_FLUID) {
            assert_memory_equal(p.x, q.x, sizeof p.x);
            continue;
        }
        assert_memory_equal(p.v, q.v, sizeof p.v);
        if (!wanted(without, c, p.x, speed, d, &rise, &why))
            continue;
        close_to(q.rho / p.rho, 1 + rise, 20 * EPS);
        count[why]++;
        count[3] += fabs(rise) > 1e-6;
        for (int k = 0; k < SPH_DIM; k++) {
            close_to(way(c, k, p.x[k], q.x[k]), d[k], 60 * EPS * by / c->smoothing_length + with->grid.quantum);
            largest = fmax(largest, fabs(d[k]) / DX);
        }
    }
    assert_int_equal(free_sims(NULL), 0);
    return largest;
}

/* ---- how far ---- */

static void each_goes_as_its_sums_say(void **state)
{
    (void)state;
    for (uint32_t w = 0; w < WORLDS; w++) {
        const sph_config c = world(w, 1);
        uint32_t count[4] = {0};
        const double largest = compare(&c, w, count);
        print_message("shifting, world %u: %u shifted, to %.4f dx; %u left by cover, %u by spread; %u filled\n", w,
                      count[0], largest, count[1], count[2], count[3]);
        assert_true(count[3] > 0 && (w != OPEN || count[3] < count[0]));
        assert_true(count[0] > N / 2 && largest > 1e-3 && largest < 0.05);
        const bool closed = w == PERIODIC || w == MIRRORS; /* holes of the cloud only */
        assert_true(closed ? 20 * (count[1] + count[2]) < count[0] : count[1] > 0);
        assert_true(closed || SPH_DIM == 1 || count[2] > 0);
    }
}

/* two by two in the open, a pair of 0.5 dx and one of 0.9 dx: the first goes apart, to both sides alike */
static void near_a_surface_close_pairs_go_apart(void **state)
{
    (void)state;
    for (uint32_t w = 0; w < WORLDS; w++) {
        sph_config c = world(w, 1);
        uint32_t count[4] = {0};
        c.shift_pairs = true;
        (void)compare(&c, w, count);
        assert_true(count[0] > N / 2 && (w != OPEN || count[1] + count[2] > 0));
    }
    for (int pairs = 0; pairs < 2; pairs++) {
        sph_config c = world(OPEN, 1);
        uint32_t set;
        double gap[2];
        c.shift_pairs = pairs;
        c.gravity[UP] = 0;
        c.pressure_floor = true;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_fluid(sim, NULL, &set));
        for (uint32_t i = 0; i < 4; i++) {
            double x[3] = {0.2, 0.2, 0.2}, v[3] = {0.01, 0, 0};
            x[0] += (i / 2) * 8 * DX + (i % 2) * (i < 2 ? 0.5 : 0.9) * DX;
            must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
        }
        const double middle = by_id(sim, 0).x[0] + by_id(sim, 1).x[0];
        for (int k = 0; k < 50; k++)
            must(sim, sph_step(sim));
        for (uint32_t i = 0; i < 2; i++)
            gap[i] = (by_id(sim, 2 * i + 1).x[0] - by_id(sim, 2 * i).x[0]) / DX;
        assert_true(pairs ? gap[0] > 0.5 + 1e-4 : fabs(gap[0] - 0.5) < 1e-4);
        close_to(gap[1], 0.9, 1e-4);
        close_to(by_id(sim, 0).x[0] + by_id(sim, 1).x[0], middle + 0.02 * 50 * DT, 1e-5);
    }
}

static void whatever_the_kernel_the_density_and_the_step(void **state)
{
    static const uint32_t kernel[] = {SPH_CUBIC, SPH_QUINTIC, SPH_WENDLAND_C4};
    uint32_t count[4] = {0};
    (void)state;
    for (size_t k = 0; k < sizeof kernel / sizeof *kernel; k++) {
        sph_config c = world(OPEN, 2);
        c.kernel = kernel[k];
        c.scheme = k == 1 ? SPH_WEAK : SPH_STANDARD;
        c.smoothing_length = (SPH_DIM == 3 ? 1.1 : 1.6) * DX;
        c.integrator = k == 2 ? SPH_LEAP_FROG : SPH_KICK_DRIFT_KICK;
        c.diffusion = k == 2 ? SPH_HYDROSTATIC : SPH_NO_DIFFUSION;
        c.books = k == 0;
        compare(&c, OPEN, count);
    }
    assert_true(count[0] > 0 && count[1] > 0);
}

/* the fast paths */
static void with_diffusion_and_books_too(void **state)
{
    (void)state;
    for (uint32_t books = 0; books < 2; books++) {
        sph_config c = world(TANK, 1);
        uint32_t count[4] = {0};
        c.diffusion = SPH_HYDROSTATIC;
        c.books = books;
        c.pressure_floor = true;
        compare(&c, TANK, count);
        assert_true(count[0] > N / 2 && count[1] > 0);
    }
}

/* however strong: a twentieth of a spacing */
static void nobody_goes_further_than_the_cap(void **state)
{
    sph_config c = world(PERIODIC, 4);
    uint32_t count[3] = {0};
    (void)state;
    c.dt = 4e-3;
    sph_config plain = c;
    plain.shifting = 0;
    sph_sim *with = fill(&c, PERIODIC), *without = fill(&plain, PERIODIC);
    must(with, sph_step(with));
    must(without, sph_step(without));
    for (uint32_t i = 0; i < sph_count(without); i++) {
        sph_particle p, q;
        double d[SPH_DIM], d2 = 0, most2 = 0, rise;
        int why;
        assert_int_equal(sph_get(without, i, &p), SPH_OK);
        q = by_id(with, p.id);
        if (!wanted(without, &c, p.x, (double)without->now.peaks.speed, d, &rise, &why))
            continue;
        for (int k = 0; k < SPH_DIM; k++) {
            d2 += way(&c, k, p.x[k], q.x[k]) * way(&c, k, p.x[k], q.x[k]);
            most2 += d[k] * d[k];
        }
        close_to(sqrt(d2), sqrt(most2), 1e-4 * DX);
        count[sqrt(d2) > 0.0499 * DX]++;
    }
    assert_true(count[1] > 3);
}

/* a lattice all of whose particles but one are in place: those around that one feel a single pair, by hand */
static void around_one_that_is_displaced(void **state)
{
    sph_config c = periodic_config(EDGE, DX), plain;
    const double off = 0.25 * DX, v[SPH_DIM] = {0.5};
    double at[2][SPH_DIM];
    (void)state;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.viscosity = SPH_INVISCID;
    c.dt = 1e-9; /* nobody else moves; by shifting as far as with 1e-3 and 1e6 times the speed */
    c.shifting = 4;
    plain = c;
    plain.shifting = 0;
    sph_sim *sim[2] = {new_sim(&c), new_sim(&plain)};
    const uint32_t middle = SPH_DIM == 1 ? N / 2 : SPH_DIM == 2 ? N / 2 * (N + 1) : N / 2 * (N * N + N + 1);
    for (int s = 0; s < 2; s++) {
        uint32_t set, total = SPH_DIM == 1 ? N : SPH_DIM == 2 ? N * N : N * N * N;
        must(sim[s], sph_add_fluid(sim[s], NULL, &set));
        for (uint32_t i = 0; i < total; i++) {
            double x[SPH_DIM], fast[SPH_DIM];
            uint32_t n = i;
            for (int k = 0; k < SPH_DIM; k++, n /= N) {
                x[k] = (n % N + 0.5) * DX + (i == middle && k == 0 ? off : 0);
                fast[k] = 1e6 * v[k];
            }
            must(sim[s], sph_add_particle(sim[s], set, x, fast, 1000, NULL));
        }
        must(sim[s], sph_step(sim[s]));
        const sph_particle p = by_id(sim[s], middle + 1);
        memcpy(at[s], p.x, sizeof p.x);
    }
    double w_dx, w, w_off;
    const double g = slope_of(&c, DX, &w_dx), g_off = slope_of(&c, DX - off, &w_off);
    (void)slope_of(&c, DX, &w);
    const double f = w_off / w_dx, volume = 1000 * pow(DX, SPH_DIM) / 1000;
    /* the lattice's own pair, taken out, and the pair that is there; both along x, with the bracket 1.2 at DX */
    const double slope = volume * ((1 + 0.2 * f * f * f * f) * g_off * (DX - off) - 1.2 * g * DX);
    const double by = 4 * 1e-9 * 0.5e6 * 4 * c.smoothing_length, want = -by * slope;
    assert_true(want > 1e-3 * DX && want < 0.05 * DX);
    close_to(at[0][0] - at[1][0], want, 1e-4 * want);
    for (int k = 1; k < SPH_DIM; k++)
        close_to(at[0][k] - at[1][k], 0, 1e-4 * want);
}

/* ---- who is left alone ---- */

/* in a lattice nothing pulls: what is left is the rounding of sums of up to 60 terms */
static void a_lattice_stays_a_lattice(void **state)
{
    (void)state;
    sph_config c = periodic_config(EDGE, DX), plain;
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], v[SPH_DIM];
    uint32_t set;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.shifting = 1;
    c.dt = DT;
    for (int k = 0; k < SPH_DIM; k++) {
        hi[k] = EDGE;
        v[k] = 1 + k;
    }
    plain = c;
    plain.shifting = 0;
    sph_sim *with = new_sim(&c), *without = new_sim(&plain);
    must(with, sph_add_fluid(with, NULL, &set));
    must(with, sph_add_box(with, set, lo, hi, v));
    must(without, sph_add_fluid(without, NULL, &set));
    must(without, sph_add_box(without, set, lo, hi, v));
    must(with, sph_step(with));
    must(without, sph_step(without));
    for (uint32_t i = 0; i < sph_count(with); i++) {
        sph_particle p, q;
        assert_int_equal(sph_get(without, i, &p), SPH_OK);
        q = by_id(with, p.id);
        for (int k = 0; k < SPH_DIM; k++)
            close_to(way(&c, k, p.x[k], q.x[k]), 0, 60 * EPS * 4 * DT * 4 + with->grid.quantum);
    }
}

/* off, or where nothing moves, it is as if it were not there */
static void off_not_a_bit_changes(void **state)
{
    (void)state;
    sph_config c = periodic_config(EDGE, DX);
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = EDGE;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        double x[2] = {0};
        for (int on = 0; on < 2; on++) {
            uint32_t set;
            c.integrator = i;
            c.shifting = on ? 1 : 0;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set));
            must(sim, sph_add_box(sim, set, lo, hi, NULL));
            for (int k = 0; k < 3; k++)
                must(sim, sph_step(sim));
            for (uint32_t p = 0; p < sph_count(sim); p++)
                x[on] += by_id(sim, p).x[0] * (p + 1);
        }
        assert_true(x[0] == x[1]);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- what stays, and the book ---- */

static void the_book_has_what_the_energy_lost(void **state)
{
    (void)state;
    for (uint32_t w = 0; w < WORLDS; w++)
        for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
            sph_config c = world(w, 1), plain = c;
            if (w == PERIODIC) /* its potential jumps where a particle goes round */
                continue;
            c.integrator = plain.integrator = i;
            c.books = plain.books = c.pressure_floor = plain.pressure_floor = i % 2;
            plain.shifting = 0;
            sph_sim *with = fill(&c, w), *without = fill(&plain, w);
            must(with, sph_step(with));
            must(without, sph_step(without));
            sph_totals a, b;
            sph_get_totals(with, &a);
            sph_get_totals(without, &b);
            assert_true(b.shifted == 0 && fabs(a.shifted) > 1e-9 * fabs(b.potential));
            close_to(a.potential + a.internal + a.shifted, b.potential + b.internal, 1e-12 * fabs(b.potential));
            close_to(a.balance, b.balance, 1e-12 * fabs(b.potential));
            assert_memory_equal(a.momentum, b.momentum, sizeof a.momentum);
            assert_true(a.kinetic == b.kinetic && a.mass == b.mass);
            assert_int_equal(free_sims(NULL), 0);
        }
}

#if SPH_DIM == 2
/* the scene, coarse: three periods; without the filling of space it swells by 1 %, and the energy rises to twice */
static void a_sloshing_tank_does_not_swell(void **state)
{
    const scene *s = NULL;
    double p[64], row[64], level = 0, first = 0, low = 1e30, rise = 0, kinetic = 0;
    sph_config c;
    (void)state;
    for (const scene *const *k = scene_table; *k; k++)
        s = strcmp((*k)->name, "sloshing") == 0 ? *k : s;
    assert_non_null(s);
    for (uint32_t k = 0; k < s->params; k++) {
        const char *name = s->param[k].name;
        p[k] = strcmp(name, "n") == 0 ? 16 : strcmp(name, "periods") == 0 ? 3 : s->param[k].value;
    }
    s->configure(p, &c);
    sph_sim *sim = new_sim(&c);
    must(sim, s->build(sim, p));
    must(sim, sph_ready(sim));
    for (int i = 0; i <= 120; i++) {
        const double t = s->end(p) * i / 120;
        while (sph_time(sim) < t)
            must(sim, sph_step_to(sim, t));
        s->history(sim, p, row);
        first = i ? first : row[2];
        level += i <= 80 ? 0 : row[2] / 40; /* of the last period */
        low = fmin(low, row[5]);
        rise = fmax(rise, row[5] - low);
        kinetic = fmax(kinetic, row[6]);
    }
    print_message("sloshing: level %.4f of the first; energy rose by %.4f of the largest kinetic\n", level / first,
                  rise / kinetic);
    close_to(level / first, 1, 0.006);
    assert_true(rise < 0.05 * kinetic);
}
#endif

/* disorder dies away */
static void the_cloud_becomes_even(void **state)
{
    (void)state;
    double most[2];
    for (int on = 0; on < 2; on++) {
        sph_config c = world(PERIODIC, on ? 0.5 : 0);
        c.gravity[UP] = 0;
        c.smoothing_length = (SPH_DIM == 3 ? 1.2 : 2) * DX;
        sph_sim *sim = fill(&c, PERIODIC);
        for (int k = 0; k < 60; k++)
            must(sim, sph_step(sim));
        most[on] = 0;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle p;
            assert_int_equal(sph_get(sim, i, &p), SPH_OK);
            const sums s = sums_at(sim, &c, p.x);
            for (int k = 0; k < SPH_DIM; k++)
                most[on] += s.slope[k] * s.slope[k];
        }
    }
    print_message("shifting: slope of disorder, squared, %.3g of that without\n", most[1] / most[0]);
    assert_true(most[1] < (SPH_DIM == 1 ? 0.6 : 0.4) * most[0]);
}

/* ---- refusals ---- */

static void what_makes_no_sense_is_refused(void **state)
{
    sph_report r;
    (void)state;
    static const double bad[] = {-0.1, 4.1, NAN, INFINITY};
    sph_config c = world(OPEN, 4);
    assert_int_equal(sph_config_check(&c, &r), SPH_OK);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        c.shifting = bad[k];
        assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
        assert_string_equal(r.what, "shifting");
    }
    c.shifting = 0.5;
    c.solid = SPH_UPDATED;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "shifting");
    assert_true(r.value == 0.5);
    c.shifting = 0;
    assert_int_equal(sph_config_check(&c, &r), SPH_OK);
    c.solid = SPH_NO_SOLID;
    c.shift_pairs = true;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "shift_pairs");
}

/* ---- the machine that runs steps ---- */

static sph_sim *fill_tank(const sph_config *c) { return fill(c, TANK); }
static sph_sim *fill_periodic(const sph_config *c) { return fill(c, PERIODIC); }
static void slices_threads_and_restarts_change_no_bit(void **state)
{
    sph_totals t;
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = world(i % 2 ? TANK : PERIODIC, 1);
        c.integrator = i;
        c.shift_pairs = i % 2;
        c.on_cross = SPH_PUT_BACK;
        sph_get_totals(same_bits_any_way(c, i % 2 ? fill_tank : fill_periodic, 8), &t);
        assert_true(t.shifted > 0 || t.shifted < 0);
        assert_int_equal(free_sims(NULL), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        subject(each_goes_as_its_sums_say),
        subject(near_a_surface_close_pairs_go_apart),
        subject(whatever_the_kernel_the_density_and_the_step),
        subject(with_diffusion_and_books_too),
        subject(nobody_goes_further_than_the_cap),
        subject(around_one_that_is_displaced),
        subject(a_lattice_stays_a_lattice),
        subject(off_not_a_bit_changes),
        subject(the_book_has_what_the_energy_lost),
#if SPH_DIM == 2
        subject(a_sloshing_tank_does_not_swell),
#endif
        subject(the_cloud_becomes_even),
        subject(what_makes_no_sense_is_refused),
        subject(slices_threads_and_restarts_change_no_bit),
    };
    return run_subjects("shifting", tests);
}
