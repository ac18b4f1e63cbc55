/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_crossing.c: who is behind the face of a wall, by plain geometry: a slanted wall is a box behind its face, as
   long and wide as the face and as thick as its layers. Who is in it is counted, named with its depth, removed, or put
   back a tenth of a spacing before the face, without the speed that leads into the wall. */
#include "testing.h"

#define DX 0.125
enum { MANY = 200, LAYERS = 3 };

/* the wall: a corner of its face, directions, lengths, normal, and its velocity along the normal */
static struct {
    double corner[3], dir[2][3], length[2], normal[3], speed;
} wall;

static void turn(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = wall.speed * wall.normal[k];
        x[k] = v[k] * t;
    }
}

static double toss(sph_rng *r, double a, double b) { return a + (b - a) * sph_rng_uniform(r); }

/* any direction; in 3-D two at right angles to each other */
static void draw_wall(sph_rng *r)
{
    memset(&wall, 0, sizeof wall);
    wall.length[0] = 0.875;
    wall.length[1] = 0.625;
    if (SPH_DIM == 1)
        wall.normal[0] = 1;
    if (SPH_DIM == 2) {
        const double angle = toss(r, 0, 6.283);
        wall.dir[0][0] = cos(angle);
        wall.dir[0][1] = sin(angle);
        wall.normal[0] = -wall.dir[0][1];
        wall.normal[1] = wall.dir[0][0];
    }
    for (int turns = 0; SPH_DIM == 3 && turns < 2; turns++) {
        double *d = wall.dir[turns], along = 0, size = 0;
        for (int k = 0; k < 3; k++)
            d[k] = toss(r, -1, 1);
        for (int k = 0; k < 3 && turns; k++)
            along += d[k] * wall.dir[0][k];
        for (int k = 0; k < 3; k++) {
            d[k] -= along * wall.dir[0][k];
            size += d[k] * d[k];
        }
        for (int k = 0; k < 3; k++)
            d[k] /= sqrt(size);
    }
    for (int k = 0; SPH_DIM == 3 && k < 3; k++)
        wall.normal[k] = wall.dir[0][(k + 1) % 3] * wall.dir[1][(k + 2) % 3] -
                         wall.dir[0][(k + 2) % 3] * wall.dir[1][(k + 1) % 3];
    for (int k = 0; k < SPH_DIM; k++) /* the middle of the face is at 0.5 */
        wall.corner[k] = 0.5 - 0.5 * (wall.length[0] * wall.dir[0][k] + wall.length[1] * wall.dir[1][k]);
}

static void add_wall(sph_sim *sim)
{
    sph_wall w = sph_wall_default();
    w.kind = SPH_WALL_KERNEL_FORCE;
    w.strength = 1e-20;
    w.layers = LAYERS;
    w.motion = turn;
#if SPH_DIM == 1
    const double hi[1] = {1.4};
    must(sim, sph_add_wall_box(sim, &w, wall.corner, hi, SPH_LOW(0), true, NULL));
#elif SPH_DIM == 2
    double end[2];
    for (int k = 0; k < 2; k++)
        end[k] = wall.corner[k] + wall.length[0] * wall.dir[0][k];
    must(sim, sph_add_wall_segment(sim, &w, wall.corner, end, NULL));
#else
    double e[2][3];
    for (int t = 0; t < 2; t++)
        for (int k = 0; k < 3; k++)
            e[t][k] = wall.length[t] * wall.dir[t][k];
    must(sim, sph_add_wall_plane(sim, &w, wall.corner, e[0], e[1], NULL));
#endif
}

/* depth behind the face, 0 outside of the wall; near: so near to one of its sides that rounding decides */
static double depth_of(const double *x, bool *near)
{
    double along[2] = {0, 0}, depth = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        depth -= (x[k] - wall.corner[k]) * wall.normal[k];
        for (int t = 0; t < 2; t++)
            along[t] += (x[k] - wall.corner[k]) * wall.dir[t][k];
    }
    *near = fabs(depth) < 1e-3 || fabs(depth - LAYERS * DX) < 1e-3;
    bool in = depth > 0 && depth < LAYERS * DX;
    for (int t = 0; t < SPH_DIM - 1; t++) {
        *near |= fabs(along[t]) < 1e-3 || fabs(along[t] - wall.length[t]) < 1e-3;
        in &= along[t] > 0 && along[t] < wall.length[t];
    }
    return in ? depth : 0;
}

/* particles of next to no mass anywhere about the wall, with any velocity; nobody gets far in a step */
static struct {
    double x[SPH_DIM], v[SPH_DIM], depth;
} part[MANY];
static uint32_t inside;
static double deepest;
static sph_sim *cloud(uint32_t seed, uint32_t integrator, uint32_t policy)
{
    sph_config c = open_config(1, DX);
    sph_rng r;
    uint32_t set;
    c.integrator = integrator;
    c.viscosity = SPH_INVISCID;
    c.dt = 1e-9;
    c.on_cross = policy;
    c.max_particles = MANY + 200;
    sph_rng_seed(&r, seed, 5);
    draw_wall(&r);
    wall.speed = 2;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, &(sph_fluid){.mass = 1e-20}, &set));
    inside = 0;
    deepest = 0;
    for (uint32_t i = 0; i < MANY;) {
        bool near;
        for (int k = 0; k < SPH_DIM; k++) {
            part[i].x[k] = toss(&r, -0.3, 1.3);
            part[i].v[k] = toss(&r, -9, 9);
        }
        part[i].depth = depth_of(part[i].x, &near);
        if (near)
            continue;
        inside += part[i].depth > 0;
        deepest = part[i].depth > deepest ? part[i].depth : deepest;
        must(sim, sph_add_particle(sim, set, part[i].x, part[i].v, 0, NULL));
        i++;
    }
    add_wall(sim);
    return sim;
}

static sph_finding found;
static void take(void *ctx, const sph_finding *f)
{
    (void)ctx;
    if (f->kind == SPH_FINDING_IN_WALL)
        found = *f;
}
static void inspection_finds_who_is_inside(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 20; seed++) {
        sph_sim *sim = cloud(seed, SPH_PREDICTOR_CORRECTOR, SPH_IGNORE);
        memset(&found, 0, sizeof found);
        must(sim, sph_inspect(sim, take, NULL));
        assert_int_equal(found.count, inside);
        close_to(found.value, deepest, 1e-6);
        uint32_t first = 0;
        while (inside && part[first].depth <= 0)
            first++;
        assert_true(!inside || found.particle == first);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void each_is_put_back_before_the_face(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 20; seed++) {
        sph_step_info info;
        sph_sim *sim = cloud(seed, seed % SPH_INTEGRATORS, SPH_PUT_BACK);
        must(sim, sph_step(sim));
        sph_get_step(sim, &info);
        assert_int_equal(info.crossed, inside);
        assert_int_equal(info.put_back, inside);
        assert_int_equal(info.left, 0);
        for (uint32_t i = 0; i < MANY; i++) {
            const sph_particle p = by_id(sim, i);
            double vn = 0;
            for (int k = 0; k < SPH_DIM; k++)
                vn += (part[i].v[k] - wall.speed * wall.normal[k]) * wall.normal[k];
            for (int k = 0; k < SPH_DIM; k++) {
                const double n = wall.normal[k], back = part[i].depth > 0 ? part[i].depth + 0.1 * DX : 0;
                const double lost = part[i].depth > 0 && vn < 0 ? vn : 0;
                close_to(p.x[k], part[i].x[k] + back * n, 1e-6);
                close_to(p.v[k], part[i].v[k] - lost * n, 1e-5);
            }
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void each_is_removed_or_the_first_named(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 20; seed++) {
        sph_step_info info;
        sph_particle p;
        uint32_t first = 0, here = 0;
        sph_sim *sim = cloud(seed, seed % SPH_INTEGRATORS, SPH_REMOVE);
        must(sim, sph_step(sim));
        sph_get_step(sim, &info);
        assert_true(info.crossed == inside && info.put_back == 0);
        must(sim, sph_step(sim)); /* the dead are dropped by the next sort */
        sph_get_step(sim, &info);
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            assert_int_equal(sph_get(sim, i, &p), SPH_OK);
            if (p.role != SPH_ROLE_FLUID)
                continue;
            here++;
            assert_true(part[p.id].depth <= 0);
        }
        assert_int_equal(here, MANY - inside);
        assert_int_equal(free_sims(NULL), 0);
        sim = cloud(seed, seed % SPH_INTEGRATORS, SPH_FAIL);
        while (inside && part[first].depth <= 0)
            first++;
        assert_int_equal(sph_step(sim), inside ? SPH_WALL_CROSSED : SPH_OK);
        if (inside) {
            assert_int_equal(sph_last(sim)->particle, first);
            close_to(sph_last(sim)->value, part[first].depth, 1e-6);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a gate's time may come in either half of a step: at the step's end none of it is left, one step earlier all */
static void a_wall_is_gone_at_the_end_of_the_step_that_passes_its_time(void **state)
{
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++)
        for (int quarter = 0; quarter < 4; quarter++)
            for (uint32_t kind = SPH_WALL_LENNARD_JONES; kind < SPH_WALLS; kind++) {
                sph_config c = open_config(1, DX);
                sph_wall w = sph_wall_default();
                double lo[SPH_DIM] = {0}, hi[SPH_DIM];
                uint32_t set, group;
                sph_totals t;
                c.integrator = integrator;
                c.dt = 0x1p-10;
                c.max_particles = 2000;
                sph_sim *sim = new_sim(&c);
                for (int k = 0; k < SPH_DIM; k++)
                    hi[k] = 0.375;
                w.kind = kind;
                w.motion = quarter % 2 ? turn : NULL;
                wall.speed = 0;
                must(sim, sph_add_fluid(sim, NULL, &set));
                must(sim, sph_add_box(sim, set, lo, hi, NULL));
                const uint32_t fluid = sph_count(sim);
                must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, &group));
                const uint32_t all = sph_count(sim);
                must(sim, sph_remove_wall_at(sim, group, (2 + 0.25 * (quarter + 0.5)) * c.dt));
                for (int step = 1; step <= 4; step++) {
                    must(sim, sph_step(sim));
                    sph_get_totals(sim, &t);
                    if (t.wall != (step <= 2 ? all - fluid : 0) || t.fluid != fluid)
                        fail_msg("integrator %u, wall %u, quarter %d: %u of the wall after step %d", integrator, kind,
                                 quarter, t.wall, step);
                }
                assert_int_equal(free_sims(NULL), 0);
            }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(inspection_finds_who_is_inside),
        subject(each_is_put_back_before_the_face),
        subject(each_is_removed_or_the_first_named),
        subject(a_wall_is_gone_at_the_end_of_the_step_that_passes_its_time),
    };
    return run_subjects("crossing", list);
}
