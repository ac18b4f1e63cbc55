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

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_probe_sees_images_like_real_copies),
        subject(gauges_stand_on_faces),
        subject(drops_in_the_air_are_not_the_surface),
    };
    return run_subjects("probes", list);
}
