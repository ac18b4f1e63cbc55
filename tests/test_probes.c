/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_probes.c: probes and gauges see images behind faces as if they were real copies; drops in the air change neither
   the surface of the water below them nor, beyond their own volume, its depth. */
#include "testing.h"

#define DX 0.1
#define UP (SPH_DIM - 1)
#define CELLS (SPH_DIM == 3 ? 8u : 12u)
#define EDGE (CELLS * DX)

/* fills lo .. hi (in spacings) with a jittered lattice */
static void fill(sph_sim *sim, uint32_t set, const int *lo, const int *hi, double jitter, double speed)
{
    sph_rng rng;
    int i[3], from[3] = {0}, to[3] = {1, 1, 1};
    sph_rng_seed(&rng, 8, 8);
    for (int k = 0; k < SPH_DIM; k++)
        from[k] = lo[k], to[k] = hi[k];
    for (i[2] = from[2]; i[2] < to[2]; i[2]++)
        for (i[1] = from[1]; i[1] < to[1]; i[1]++)
            for (i[0] = from[0]; i[0] < to[0]; i[0]++) {
                double x[SPH_DIM], v[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    x[k] = (i[k] + 0.5 + jitter * (2 * sph_rng_uniform(&rng) - 1)) * DX;
                    v[k] = speed * (2 * sph_rng_uniform(&rng) - 1);
                }
                must(sim, sph_add_particle(sim, set, x, v, 995 + 10 * sph_rng_uniform(&rng), NULL));
            }
}

/* the image of a particle: digit k of n: itself, behind the low, behind the high face of axis k */
static void image_of(sph_particle *p, uint32_t n, const uint32_t *face)
{
    for (uint32_t k = 0; k < SPH_DIM; k++, n /= 3) {
        if (n % 3 == 0)
            continue;
        if (face[k] == SPH_PERIODIC) {
            p->x[k] += n % 3 == 2 ? EDGE : -EDGE;
            continue;
        }
        p->x[k] = (n % 3 == 2 ? 2 * EDGE : 0) - p->x[k];
        for (uint32_t a = 0; a < SPH_DIM; a++)
            if (a == k || face[k] == SPH_MIRROR_NO_SLIP)
                p->v[a] = -p->v[a];
    }
}

static void a_probe_sees_images_like_real_copies(void **state)
{
    const int lo[3] = {0}, hi[3] = {CELLS, CELLS, CELLS};
    const uint32_t views = SPH_DIM == 1 ? 3 : SPH_DIM == 2 ? 9 : 27;
    sph_rng rng;
    (void)state;
    sph_rng_seed(&rng, 8, 9);
    for (uint32_t trial = 0; trial < 27; trial++) {
        const uint32_t face[3] = {1 + trial % 3, 1 + trial / 3 % 3, 1 + trial / 9};
        sph_config c = periodic_config(EDGE, DX), d = open_config(2 * EDGE, DX);
        uint32_t set;
        d.max_particles = 8000;
        for (int k = 0; k < SPH_DIM; k++) {
            c.face[k][0] = c.face[k][1] = face[k];
            c.smoothing_length = d.smoothing_length = 1.2 * DX;
        }
        sph_sim *a = new_sim(&c), *b = new_sim(&d);
        must(a, sph_add_fluid(a, NULL, &set));
        must(b, sph_add_fluid(b, NULL, &set));
        fill(a, set, lo, hi, 0.2, 1);
        for (uint32_t n = 0; n < views; n++)
            for (uint32_t i = 0; i < sph_count(a); i++) {
                sph_particle p;
                assert_int_equal(sph_get(a, i, &p), SPH_OK);
                image_of(&p, n, face);
                bool near = true;
                for (int k = 0; k < SPH_DIM; k++)
                    near &= p.x[k] > -2.6 * DX && p.x[k] < EDGE + 2.6 * DX;
                if (near)
                    must(b, sph_add_particle(b, set, p.x, p.v, p.rho, NULL));
            }
        for (int look = 0; look < 30; look++) {
            double x[SPH_DIM];
            sph_probe_value u, v;
            for (int k = 0; k < SPH_DIM; k++) {
                const double along = sph_rng_uniform(&rng);
                x[k] = look % 3 == 0 ? EDGE * along : along < 0.5 ? 0.2 * DX * along : EDGE - 0.2 * DX * (along - 0.5);
                if (look % 3 == 1)
                    x[k] = along < 0.5 ? 0 : EDGE;
            }
            must(a, sph_probe(a, x, &u));
            must(b, sph_probe(b, x, &v));
            /* positions differ by a quantum, velocities and densities by a rounding */
            close_to(u.cover, v.cover, 100 * EPS);
            close_to(u.rho, v.rho, 1e5 * EPS);
            close_to(u.p, v.p, 400 * 1e5 * EPS);
            for (int k = 0; k < SPH_DIM; k++)
                close_to(u.v[k], v.v[k], 100 * EPS);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* water on a lattice in a box of mirrors, periodic across or open above */
static sph_sim *tank(uint32_t across, uint32_t set_height, uint32_t *set)
{
    sph_config c = open_config(EDGE, DX);
    int lo[3] = {0}, hi[3] = {CELLS, CELLS, CELLS};
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = 0;
        c.hi[k] = k == UP ? 3 * EDGE : EDGE;
        if (k == UP)
            c.face[k][0] = SPH_SYMMETRY;
        else
            c.face[k][0] = c.face[k][1] = across;
    }
    c.smoothing_length = 1.2 * DX;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, set));
    hi[UP] = (int)set_height;
    fill(sim, *set, lo, hi, 0, 0);
    return sim;
}

static void gauges_stand_on_faces(void **state)
{
    (void)state;
    for (uint32_t across = SPH_PERIODIC; across <= SPH_MIRROR_NO_SLIP; across++)
        for (int side = 0; side < 3; side++) {
            uint32_t set;
            double x[SPH_DIM] = {0}, h, middle[SPH_DIM] = {0};
            sph_probe_value v;
            sph_sim *sim = tank(across, CELLS, &set);
            for (int k = 0; k < SPH_DIM; k++) {
                middle[k] = 0.5 * EDGE;
                x[k] = k == UP ? 0 : side * 0.5 * EDGE;
            }
            must(sim, sph_probe(sim, x, &v));
            close_to(v.cover, 1, 0.04); /* sums over a lattice */
            must(sim, sph_gauge(sim, x, UP, &h));
            close_to(h, EDGE, 0.3 * DX);
            must(sim, sph_surface(sim, x, UP, &h));
            close_to(h, EDGE, 0.3 * DX);
            must(sim, sph_depth(sim, x, UP, &h));
            close_to(h, EDGE, 0.01 * EDGE);
            must(sim, sph_depth(sim, middle, UP, &h));
            close_to(h, EDGE, 0.01 * EDGE);
            assert_int_equal(free_sims(NULL), 0);
        }
}

static void drops_in_the_air_are_not_the_surface(void **state)
{
    (void)state;
    uint32_t set;
    double x[SPH_DIM], bed[SPH_DIM], h, calm, depth, wet;
    sph_sim *sim = tank(SPH_PERIODIC, CELLS, &set);
    for (int k = 0; k < SPH_DIM; k++) {
        x[k] = k == UP ? 2.2 * EDGE : 0.5 * EDGE;
        bed[k] = k == UP ? 0 : 0.5 * EDGE;
    }
    must(sim, sph_surface(sim, bed, UP, &calm));
    must(sim, sph_depth(sim, bed, UP, &depth));
    int lo[3], hi[3];
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = (int)(x[k] / DX) - 1;
        hi[k] = lo[k] + 2;
    }
    fill(sim, set, lo, hi, 0, 0); /* a drop two spacings wide */
    must(sim, sph_gauge(sim, bed, UP, &h));
    assert_true(h > 2 * EDGE);
    must(sim, sph_surface(sim, bed, UP, &h));
    assert_true(h >= calm && h <= calm);
    must(sim, sph_depth(sim, bed, UP, &wet));
    assert_true(wet > depth + DX && wet < depth + 2.5 * DX);
    x[UP] = 1.8 * EDGE; /* a bed in the air is dry, whatever is above or below it */
    must(sim, sph_surface(sim, x, UP, &h));
    assert_true(h >= x[UP] && h <= x[UP]);
    x[UP] = -1e12;
    must(sim, sph_surface(sim, x, UP, &h));
    assert_true(h <= -1e12);
}

/* ---- one particle: what its kernel says ---- */

/* a fluid at rest density 1000 with one particle at x, of density rho and velocity v */
static sph_sim *lone(const double *x, const double *v, double rho)
{
    sph_config c = open_config(1, DX);
    uint32_t set;
    c.eos = SPH_LINEAR;
    c.max_particles = 8;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_particle(sim, set, x, v, rho, NULL));
    return sim;
}
static double cell(void) { return SPH_DIM == 1 ? DX : SPH_DIM == 2 ? DX * DX : DX * DX * DX; }
static double w_of(double r)
{
    double w, dw;
    assert_int_equal(sph_kernel_value(sph_config_default().kernel, r, 1.2 * DX, &w, &dw), SPH_OK);
    return w;
}

static void a_lone_particle_is_seen_as_its_kernel(void **state)
{
    const double rho = 1012, v[3] = {0.5, -0.25, 2};
    const double support = 1.2 * DX * sph_kernel_support(sph_config_default().kernel);
    double at[SPH_DIM];
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        at[k] = 0.3 + 0.1 * k;
    sph_sim *sim = lone(at, v, rho);
    for (int axis = 0; axis < SPH_DIM; axis++)
        for (int i = -12; i <= 12; i++) {
            double x[SPH_DIM];
            sph_probe_value o;
            const double r = fabs(i * 0.1 * support);
            memcpy(x, at, sizeof x);
            x[axis] += i * 0.1 * support;
            must(sim, sph_probe(sim, x, &o));
            const double cover = 1000 * cell() / rho * w_of(r);
            if (cover < 1e-6) {
                assert_true(o.cover == 0 && o.rho == 0 && o.p == 0 && o.v[0] == 0);
                continue;
            }
            close_to(o.cover, cover, 100 * EPS + 1e-7 * cover);
            close_to(o.rho, rho, 10 * EPS * rho);
            close_to(o.p, 400 * (rho - 1000), 400 * 10 * EPS * rho);
            for (int k = 0; k < SPH_DIM; k++)
                close_to(o.v[k], v[k], 4 * EPS);
        }
}

/* through the column at distance d across the axis: volume times the integral of W along the line */
static void the_depth_of_a_lone_particle_is_the_integral_of_its_kernel(void **state)
{
    const double support = 1.2 * DX * sph_kernel_support(sph_config_default().kernel);
    double at[SPH_DIM];
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        at[k] = 0.3 + 0.1 * k;
    sph_sim *sim = lone(at, NULL, 1000);
    for (uint32_t axis = 0; axis < SPH_DIM; axis++)
        for (int i = 0; i <= 11; i++) {
            const double d = SPH_DIM == 1 ? 0 : i * 0.1 * support;
            const double half = d < support ? sqrt(support * support - d * d) : 0;
            enum { N = 2000 };
            double x[SPH_DIM], depth, sum = 0;
            memcpy(x, at, sizeof x);
            x[axis] = -0.9; /* does not matter */
            if (SPH_DIM > 1)
                x[(axis + 1) % SPH_DIM] += d;
            for (int s = 0; s < N; s++) {
                const double y = half * (s + 0.5) / N;
                sum += 2 * w_of(sqrt(d * d + y * y)) * half / N;
            }
            must(sim, sph_depth(sim, x, axis, &depth));
            close_to(depth, cell() * sum, 2e-3 * cell() * w_of(0) * support * 0.1 + 1e-6 * DX);
            if (d > support)
                assert_true(depth == 0);
        }
}

static void a_line_is_points_evenly_from_end_to_end(void **state)
{
    uint32_t set;
    double a[SPH_DIM], b[SPH_DIM];
    sph_probe_value line[7], one;
    (void)state;
    sph_sim *sim = tank(SPH_PERIODIC, CELLS, &set);
    for (int k = 0; k < SPH_DIM; k++) {
        a[k] = 0.1 * EDGE;
        b[k] = (0.6 + 0.1 * k) * EDGE;
    }
    b[UP] = 1.1 * EDGE;
    for (uint32_t n = 2; n <= 7; n++) {
        must(sim, sph_probe_line(sim, a, b, n, line));
        for (uint32_t i = 0; i < n; i++) {
            double x[SPH_DIM];
            for (int k = 0; k < SPH_DIM; k++)
                x[k] = a[k] + (b[k] - a[k]) * i / (n - 1);
            must(sim, sph_probe(sim, x, &one));
            close_to(line[i].cover, one.cover, 1e-6);
            close_to(line[i].rho, one.rho, 1e-3);
        }
    }
    assert_int_equal(sph_probe_line(sim, a, b, 1, line), SPH_BAD_ARGUMENT);
}

static void the_extent_is_that_of_the_centres(void **state)
{
    sph_config c = open_config(1, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], low, high;
    uint32_t set;
    (void)state;
    c.max_particles = 3000;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 1;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0) | SPH_HIGH(0), true, NULL));
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        sph_extent(sim, k, &low, &high); /* walls do not count: there is nothing yet */
        assert_true(low == 0 && high == 0);
    }
    const double at[4] = {0.5, 0.125, 0.75, 0.625};
    for (int i = 0; i < 4; i++) {
        double x[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = at[(i + k) % 4];
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
    }
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        sph_extent(sim, k, &low, &high);
        close_to(low, 0.125, 1e-8);
        close_to(high, 0.75, 1e-8);
    }
}

/* cover on the line through x along an axis, at y */
static double cover_at(const sph_sim *sim, const double *x, uint32_t axis, double y)
{
    double at[SPH_DIM];
    sph_probe_value o;
    memcpy(at, x, sizeof at);
    at[axis] = y;
    must(sim, sph_probe(sim, at, &o));
    return o.cover;
}
/* Cover is 1/2 there, but for a straight line between two points a quarter spacing apart; nowhere above it is more, and
   between the bed and the surface nowhere less. */
static void gauges_stand_where_cover_is_one_half(void **state)
{
    const int lo[3] = {0}, hi[3] = {CELLS, CELLS, CELLS};
    const double step = 0.05 * DX;
    (void)state;
    for (uint32_t axis = 0; axis < SPH_DIM; axis++)
        for (int look = 0; look < 5; look++) {
            sph_config c = open_config(EDGE, DX);
            double x[SPH_DIM], h, s;
            uint32_t set;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_fluid(sim, NULL, &set));
            fill(sim, set, lo, hi, 0.2, 0);
            for (int k = 0; k < SPH_DIM; k++)
                x[k] = (0.3 + 0.09 * look) * EDGE;
            x[axis] = 0.5 * EDGE;
            must(sim, sph_gauge(sim, x, axis, &h));
            must(sim, sph_surface(sim, x, axis, &s));
            close_to(h, EDGE, 0.4 * DX);
            close_to(s, h, 0.02 * DX);
            close_to(cover_at(sim, x, axis, h), 0.5, 0.01);
            for (double y = h + step; y < h + 4 * DX; y += step)
                assert_true(cover_at(sim, x, axis, y) < 0.5);
            for (double y = x[axis] + 0.5 * DX; y < s - step; y += step)
                assert_true(cover_at(sim, x, axis, y) > 0.5);
            x[axis] = -0.5 * EDGE; /* a bed below all water is dry; the gauge does not mind */
            must(sim, sph_surface(sim, x, axis, &s));
            close_to(s, x[axis], 1e-12);
            must(sim, sph_gauge(sim, x, axis, &s));
            close_to(s, h, 1e-9);
            for (int k = 0; k < SPH_DIM && SPH_DIM > 1; k++)
                if (k != (int)axis)
                    x[k] = 1.8 * EDGE; /* beside all water */
            must(sim, sph_gauge(sim, x, axis, &s));
            if (SPH_DIM > 1)
                close_to(s, c.lo[axis], 1e-12);
            assert_int_equal(free_sims(NULL), 0);
        }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_lone_particle_is_seen_as_its_kernel),
        subject(the_depth_of_a_lone_particle_is_the_integral_of_its_kernel),
        subject(a_line_is_points_evenly_from_end_to_end),
        subject(the_extent_is_that_of_the_centres),
        subject(gauges_stand_where_cover_is_one_half),
        subject(a_probe_sees_images_like_real_copies),
        subject(gauges_stand_on_faces),
        subject(drops_in_the_air_are_not_the_surface),
    };
    return run_subjects("probes", list);
}
