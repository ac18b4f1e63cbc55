/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_edges.c: edges that let elastic waves out: layers and normals of blocks, discs, holes, disorder, corners,
   images; the traction of a line against its exact solution; P, M, H on linear velocities; that edges only take
   energy, hold what stood, and are of second order; the book; refusals; restarts, slices, threads, failures. What they
   reflect: tests/validate_edges.py. */
#include "any_way.h"
#include "testing.h"

#define DX 0.1
#define RHO 1000.0
#define C0 20.0
#define SHEAR 2e5 /* c_s^2 = 200 */

enum { N = SPH_DIM == 1 ? 40 : SPH_DIM == 2 ? 14 : 9, Y = SPH_DIM > 1 };
static double cp(void) { return sqrt(C0 * C0 + SHEAR * 4 / 3 / RHO); }
static double cs(void) { return sqrt(SHEAR / RHO); }

static sph_config edge_config(uint32_t edge, uint32_t form)
{
    sph_config c = open_config(N * DX, DX);
    c.smoothing_length = 1.3 * DX;
    c.kernel = SPH_CUBIC;
    c.sound_speed = C0;
    c.eos = SPH_LINEAR;
    c.viscosity = SPH_INVISCID;
    c.solid = form;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.edge = edge;
    c.max_particles = 3000;
    return c;
}
static uint32_t add_rock(sph_sim *sim)
{
    const sph_solid rock = {.shear = SHEAR};
    uint32_t set;
    must(sim, sph_add_solid(sim, &rock, &set, NULL));
    return set;
}
static uint32_t add_block(sph_sim *sim, uint32_t n)
{
    const uint32_t set = add_rock(sim);
    double lo[SPH_DIM], hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = 0, hi[k] = n * DX;
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    return set;
}
static uint32_t level_of(const sph_sim *sim, uint32_t id, double *n)
{
    uint32_t level = 99;
    assert_int_equal(sph_get_edge(sim, id, &level, n), SPH_OK);
    return level;
}

/* ---- layers ---- */

/* how many layers deep a particle of the block stands, 0 the outermost, and how many faces are as near */
static uint32_t depth_in(const sph_particle *p, uint32_t n, uint32_t *faces, double *normal)
{
    uint32_t least = 1000;
    *faces = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        const double low = p->x[k] / DX, high = n - p->x[k] / DX;
        const uint32_t d = (uint32_t)(low < high ? low : high);
        if (d < least) {
            least = d;
            *faces = 0;
            for (int l = 0; l < SPH_DIM; l++)
                normal[l] = 0;
        }
        if (d == least) {
            ++*faces;
            normal[k] = low < high ? -1 : 1;
        }
    }
    return least;
}

static void a_block_is_peeled_layer_by_layer(void **state)
{
    static const double h[] = {1.0, 1.3, 1.6, 2.0};
    (void)state;
    for (size_t q = 0; q < (SPH_DIM < 3 ? 4 : 2); q++) {
        sph_config c = edge_config(SPH_EDGE_P, SPH_TOTAL);
        c.smoothing_length = h[q] * DX;
        sph_sim *sim = new_sim(&c);
        add_block(sim, N);
        must(sim, sph_find_edges(sim, NULL));
        const uint32_t layers = (uint32_t)(2 * h[q] * 1.0001) + 1;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            const sph_particle p = by_id(sim, i);
            double want[SPH_DIM], n[SPH_DIM];
            uint32_t faces;
            const uint32_t d = depth_in(&p, N, &faces, want), level = level_of(sim, i, n);
            assert_int_equal(level, d < layers ? d + 1 : 0);
            for (int k = 0; k < SPH_DIM && level == 1 && faces == 1; k++)
                close_to(n[k], want[k], 0.35); /* near corners it leans to them */
            for (int k = 0; k < SPH_DIM && level == 1 && faces == SPH_DIM; k++)
                close_to(n[k], want[k] / sqrt(SPH_DIM), 1e-5);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* on a straight edge, away from corners, the normal is exact; behind images there is no edge */
static void normals_are_exact_and_images_are_no_edge(void **state)
{
    (void)state;
    for (uint32_t face = SPH_PERIODIC; face <= SPH_MIRROR_NO_SLIP; face++) {
        sph_config c = edge_config(SPH_EDGE_P, SPH_TOTAL);
        for (int k = 1; k < SPH_DIM; k++) {
            c.lo[k] = 0;
            c.hi[k] = 12 * DX;
            c.face[k][0] = c.face[k][1] = face;
        }
        sph_sim *sim = new_sim(&c);
        add_block(sim, 12);
        must(sim, sph_find_edges(sim, NULL));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            const sph_particle p = by_id(sim, i);
            double n[SPH_DIM];
            const uint32_t low = (uint32_t)(p.x[0] / DX), high = 11 - low, d = low < high ? low : high;
            assert_int_equal(level_of(sim, i, n), d < 3 ? d + 1 : 0);
            for (int k = 0; k < SPH_DIM && d < 3; k++)
                close_to(n[k], k ? 0 : low < high ? -1 : 1, 2e-6);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

#if SPH_DIM == 2
/* a disc with a hole: all that stand less than half a spacing off a rim are found, nobody 1.3 spacings off is of layer
   1; normals are radial */
static void rims_of_a_ring_are_found(void **state)
{
    const sph_ellipse rim = {{0.7, 0.7}, {1.4, 1.4}}, hole = {{0.7, 0.7}, {0.6, 0.6}};
    const sph_shape ring = {.outline = &rim, .hole = &hole, .holes = 1};
    sph_config c = edge_config(SPH_EDGE_P, SPH_TOTAL);
    c.lo[0] = c.lo[1] = -2;
    c.hi[0] = c.hi[1] = 4;
    sph_sim *sim = new_sim(&c);
    uint32_t found = 0;
    double worst = 0;
    (void)state;
    must(sim, sph_add_shape(sim, add_rock(sim), &ring));
    must(sim, sph_find_edges(sim, NULL));
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        const sph_particle p = by_id(sim, i);
        double n[2];
        const double x = p.x[0] - 0.7, y = p.x[1] - 0.7, r = sqrt(x * x + y * y);
        const double off = (1.4 - r < r - 0.6 ? 1.4 - r : r - 0.6) / DX, sign = 1.4 - r < r - 0.6 ? 1 : -1;
        const uint32_t level = level_of(sim, i, n);
        if (off < 0.5)
            assert_int_equal(level, 1);
        if (off > 1.3)
            assert_true(level != 1);
        if (off > 4.4)
            assert_int_equal(level, 0);
        if (level != 1)
            continue;
        found++;
        const double lean = acos(fmin(1, sign * (n[0] * x + n[1] * y) / r)) * 57.3;
        worst = lean > worst ? lean : worst;
    }
    print_message("ring: %u in the outer layers, normals within %.1f degrees\n", found, worst);
    assert_true(found > 70 && worst < 25);
}

/* a lattice jittered by a tenth of a spacing: the outer layer is found whole, and nobody else is taken for it */
static void disorder_hides_no_edge(void **state)
{
    sph_config c = edge_config(SPH_EDGE_P, SPH_TOTAL);
    sph_sim *sim = new_sim(&c);
    double worst = 1;
    (void)state;
    random_cloud(sim, add_rock(sim), 20, DX, 0.1, 0, 0);
    must(sim, sph_find_edges(sim, NULL));
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        const uint32_t x = i % 20, y = i / 20, a = x < 19 - x ? x : 19 - x, b = y < 19 - y ? y : 19 - y;
        double n[2], want[2] = {0, 0};
        const uint32_t level = level_of(sim, i, n);
        if ((a < b ? a : b) == 0)
            assert_int_equal(level, 1);
        if ((a < b ? a : b) > 1)
            assert_true(level != 1);
        if (a == b || (a < b ? a : b) > 0)
            continue;
        want[a < b ? 0 : 1] = a < b ? x == 0 ? -1 : 1 : y == 0 ? -1 : 1;
        const double along = n[0] * want[0] + n[1] * want[1];
        worst = along < worst ? along : worst;
    }
    print_message("jittered block: normals within %.1f degrees\n", acos(worst) * 57.3);
    assert_true(worst > 0.85);
}
#endif

/* what a host says of a particle is taken, and lines begin there */
static void a_host_may_set_normals(void **state)
{
    const double n[SPH_DIM] = {2};
    double got[SPH_DIM];
    const sph_edges given = {.given = true};
    (void)state;
    sph_config c = edge_config(SPH_EDGE_NATURAL, SPH_TOTAL);
    sph_sim *sim = new_sim(&c);
    add_block(sim, 6);
    must(sim, sph_set_edge(sim, 5, 1, n)); /* the first row's end */
    must(sim, sph_find_edges(sim, &given));
    for (uint32_t i = 0; i < sph_count(sim); i++)
        assert_int_equal(level_of(sim, i, got), i == 5);
    level_of(sim, 5, got);
    close_to(got[0], 1, 0);
    must(sim, sph_ready(sim));
    const double v[SPH_DIM] = {1};
    sph_sim *moving = new_sim(&c);
    const uint32_t set = add_rock(moving);
    for (int i = 0; i < 6; i++) {
        double x[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = k ? 0.5 * DX : (i + 0.5) * DX;
        must(moving, sph_add_particle(moving, set, x, v, 0, NULL));
    }
    must(moving, sph_set_edge(moving, 5, 1, n));
    must(moving, sph_find_edges(moving, &given));
    must(moving, sph_step(moving));
    assert_true(by_id(moving, 5).v[0] < 0.9 && by_id(moving, 0).v[0] > 0.9);
}

/* ---- the natural traction ---- */

/* sum of (dW/dr)/r x over a plane of the lattice, spacing 1, h 1.3 */
static double plane(int m)
{
    double sum = 0;
    for (int y = SPH_DIM > 1 ? -4 : 0; y <= (SPH_DIM > 1 ? 4 : 0); y++)
        for (int z = SPH_DIM > 2 ? -4 : 0; z <= (SPH_DIM > 2 ? 4 : 0); z++) {
            double w, dw;
            const double r = sqrt(m * m + y * y + z * z);
            assert_int_equal(sph_kernel_value(SPH_CUBIC, r, 1.3, &w, &dw), SPH_OK);
            sum += r > 0 ? dw * m / r : 0;
        }
    return sum;
}
static double inverse_moment(int n)
{
    double sum = 0;
    for (int m = -3; m <= 3; m++)
        sum -= n - m >= 0 ? plane(m) * m : 0;
    return 1 / sum;
}
/* A_n: the share of a uniform stress that the n-th plane from the edge feels */
static void weights(double *a)
{
    double sum = 0;
    for (int n = 0; n < 6; n++) {
        a[n] = 0;
        for (int m = -3; m <= 3; m++)
            a[n] -= n - m >= 0 ? plane(m) * (inverse_moment(n) + inverse_moment(n - m)) : 0;
        sum += a[n];
    }
    for (int n = 0; n < 6; n++)
        a[n] /= sum;
}

/* a block at rest but for one velocity, without stress: a step is the traction alone */
static void a_line_lets_out_what_it_should(void **state)
{
    double a[6], squares = 0;
    const double dt = 1e-4, v[3] = {0.7, -0.3, 0.4};
    const sph_edges e = {.faces = SPH_HIGH(0)};
    (void)state;
    weights(a);
    if (SPH_DIM == 2) { /* a trial beforehand, and by hand */
        close_to(a[0], 1.385, 6e-4);
        close_to(a[1], -0.276, 6e-4);
        close_to(a[2], -0.102, 6e-4);
        close_to(a[3], -0.007, 6e-4);
    }
    for (int n = 0; n < 6; n++)
        squares += a[n] * a[n];
    sph_config c = edge_config(SPH_EDGE_NATURAL, SPH_TOTAL);
    c.dt = dt;
    sph_sim *sim = new_sim(&c);
    const uint32_t set = add_rock(sim);
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = k ? 7 * DX : 10 * DX;
    must(sim, sph_add_box(sim, set, lo, hi, v));
    must(sim, sph_find_edges(sim, &e));
    must(sim, sph_step(sim));
    const double p = (1 - exp(-cp() * dt * squares / DX)) / squares, s = (1 - exp(-cs() * dt * squares / DX)) / squares;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        const sph_particle q = by_id(sim, i);
        const int n = 9 - (int)(q.x[0] / DX);
        for (int k = 0; k < SPH_DIM; k++)
            close_to(q.v[k], v[k] - (n < 6 ? a[n] * v[k] * (k ? s : p) : 0), 40 * EPS);
    }
}

/* ---- P, M, H ---- */

static const double grad[3][3] = {{0.3, -0.7, 0.2}, {1.1, 0.4, -0.5}, {-0.6, 0.8, 0.9}};
static void linear_flow(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)rho;
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = 0.2 - 0.1 * k;
        for (int l = 0; l < SPH_DIM; l++)
            v[k] += grad[k][l] * x[l];
    }
}

/* what an edge of normal +x does with L and v */
static void wanted(uint32_t edge, const double *v, double cosine, double *a)
{
    double p = cp(), s = cs(), lv;
    const double m = edge == SPH_EDGE_M || edge == SPH_EDGE_M_PRINTED ? p - s : 0;
    if (edge == SPH_EDGE_H)
        p = s = p / cosine;
    if (edge == SPH_EDGE_H_PRINTED)
        p *= cosine, s *= cosine;
    for (int k = 0; k < SPH_DIM; k++) {
        lv = 0;
        for (int l = 0; l < SPH_DIM; l++)
            lv += grad[k][l] * v[l];
        a[k] = lv - (k ? s : p) * grad[k][0];
        if (edge == SPH_EDGE_M) /* eq 2.45, and its third dimension */
            a[k] -= m * (k ? grad[0][k] : (SPH_DIM > 1 ? grad[1][1] : 0) + (SPH_DIM > 2 ? grad[2][2] : 0));
    }
    if (edge == SPH_EDGE_M_PRINTED) { /* t = (0, -1): Lt.n = -L_xy, Lt.t = L_yy */
        a[0] += m * -grad[0][1];
        a[1 % SPH_DIM] -= m * -grad[1][1];
    }
}

static void p_m_and_h_are_exact_for_linear_velocities(void **state)
{
    (void)state;
    for (uint32_t edge = SPH_EDGE_P; edge < SPH_EDGES; edge++) {
        if (edge == SPH_EDGE_M_PRINTED && SPH_DIM != 2)
            continue;
        sph_edges e = {.faces = SPH_HIGH(0), .source = {-3}};
        sph_sim *sim;
        e.source[Y] = SPH_DIM > 1 ? 1 : -3;
        sph_config c = edge_config(edge, SPH_TOTAL);
        c.edge_layers = 2;
        sim = new_sim(&c);
        const uint32_t set = add_block(sim, 7);
        must(sim, sph_find_edges(sim, &e));
        must(sim, sph_apply_field(sim, set, linear_flow, NULL));
        must(sim, sph_ready(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            const sph_particle q = by_id(sim, i);
            double a[SPH_DIM], r = 0;
            for (int k = 0; k < SPH_DIM; k++)
                r += (q.x[k] - e.source[k]) * (q.x[k] - e.source[k]);
            wanted(edge, q.v, (q.x[0] + 3) / sqrt(r), a);
            for (int k = 0; k < SPH_DIM; k++)
                close_to(q.a[k], q.x[0] > 5 * DX ? a[k] : 0, (SPH_DOUBLE ? 1e-10 : 1e-3) * 30);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- energy ---- */

static double sum_of_energy(const sph_sim *sim, double *absorbed)
{
    sph_totals t;
    sph_get_totals(sim, &t);
    *absorbed = t.absorbed;
    return t.kinetic + t.internal + t.elastic;
}

static void rattle(sph_sim *sim, const sph_config *c)
{
    uint32_t faces = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        faces |= SPH_LOW(k) | SPH_HIGH(k);
    const sph_edges e = {.faces = c->edge ? faces : 0};
    random_cloud(sim, add_rock(sim), N, DX, 0, 0.05, 0);
    if (c->edge)
        must(sim, sph_find_edges(sim, &e));
}

/* a rattling block between edges on all sides: energy goes, and never comes back; what is gone is in the book. (A
   little comes and goes with the error of the steps.) */
static void edges_only_take_energy(void **state)
{
    (void)state;
    for (uint32_t turn = 0; turn < 4; turn++) {
        sph_config c = edge_config(turn == 1 ? SPH_EDGE_VISCOUS : SPH_EDGE_NATURAL, SPH_TOTAL);
        c.edge_width = turn == 2 ? 4 * DX : 0;
        c.solid = turn == 3 ? SPH_CORRECTED : SPH_TOTAL;
        sph_sim *sim = new_sim(&c);
        double took, before, least = 1e300, most = 0;
        rattle(sim, &c);
        must(sim, sph_ready(sim));
        before = sum_of_energy(sim, &took);
        for (int k = 0; k < (SPH_DIM == 3 ? 60 : 600); k++) {
            must(sim, sph_step(sim));
            const double now = sum_of_energy(sim, &took);
            least = now < least ? now : least;
            most = fmax(most, fabs(now + took - before) / before);
            assert_true(now < (turn == 2 ? before : least * 1.02 + 1e-6 * before)); /* a layer lends it */
        }
        print_message("edges, turn %u: %.3g of the energy is left, the book is off by %.2g\n", turn, least / before,
                      most);
        assert_true(least < 0.5 * before && most < (turn == 2 ? 0.05 : 0.01));
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* a block that is under uniform pressure from the start stands, whatever its edge */
static void squeeze(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)x;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = 0;
    *rho = RHO * 1.001;
}
static void what_stands_under_pressure_stays(void **state)
{
    (void)state;
    for (uint32_t turn = 0; turn < 4; turn++) {
        static const uint32_t kind[] = {SPH_EDGE_NATURAL, SPH_EDGE_NATURAL, SPH_EDGE_M, SPH_EDGE_VISCOUS};
        const sph_edges e = {.faces = SPH_LOW(0) | SPH_HIGH(0)};
        sph_config c = edge_config(kind[turn], SPH_TOTAL);
        c.edge_width = turn == 1 ? 4 * DX : 0;
        for (int k = 1; k < SPH_DIM; k++) {
            c.lo[k] = 0;
            c.hi[k] = 12 * DX;
            c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
        }
        sph_sim *sim = new_sim(&c);
        const uint32_t set = add_block(sim, 12);
        must(sim, sph_apply_field(sim, set, squeeze, NULL));
        must(sim, sph_find_edges(sim, &e));
        double worst = 0;
        for (int k = 0; k < (SPH_DIM == 3 ? 50 : 400); k++)
            must(sim, sph_step(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++)
            worst = fmax(worst, fabs(by_id(sim, i).v[0]));
        print_message("edges under pressure, turn %u: %.2g\n", turn, worst / (0.001 * C0 * C0 / cp()));
        /* freed it would come out with p/(rho c) = 0.001 c0^2/c_p */
        assert_true(worst < (SPH_DOUBLE ? 1e-6 : 5e-3) * 0.001 * C0 * C0 / cp());
        assert_int_equal(free_sims(NULL), 0);
    }
}

#if SPH_DOUBLE && SPH_DIM < 3 /* what it costs */
/* ---- the order in time ---- */

static void hump(void *ctx, const double *x, double *v, double *rho)
{
    const double s = (x[0] - 0.7) / 0.2;
    (void)ctx, (void)rho;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = (k ? 0.5e-3 : 1e-3) * exp(-s * s);
}
/* a pulse into the edge and back, as places show it outside a layer: halving the step divides what it is off by four */
static void edges_are_of_second_order(void **state)
{
    (void)state;
    for (uint32_t turn = 0; turn < 4; turn++) {
        static const uint32_t kind[] = {SPH_EDGE_NATURAL, SPH_EDGE_NATURAL, SPH_EDGE_VISCOUS, SPH_EDGE_P};
        double x[3][15], first = 0, second = 0;
        for (int half = 0; half < 3; half++) {
            const sph_edges e = {.faces = SPH_HIGH(0)};
            sph_config c = edge_config(kind[turn], SPH_TOTAL);
            c.edge_width = turn == 1 ? 5 * DX : 0;
            c.dt = 1.2e-3 / (1 << half);
            c.hi[0] = 2.5;
            for (int k = 1; k < SPH_DIM; k++) {
                c.lo[k] = 0;
                c.hi[k] = 10 * DX;
                c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
            }
            sph_sim *sim = new_sim(&c);
            const uint32_t set = add_rock(sim);
            double lo[SPH_DIM] = {0}, hi[SPH_DIM];
            for (int k = 0; k < SPH_DIM; k++)
                hi[k] = k ? 10 * DX : 2;
            must(sim, sph_add_box(sim, set, lo, hi, NULL));
            must(sim, sph_find_edges(sim, &e));
            must(sim, sph_apply_field(sim, set, hump, NULL));
            for (int n = 0; n < 70 << half; n++)
                must(sim, sph_step(sim));
            for (uint32_t i = 0; i < 15; i++)
                x[half][i] = by_id(sim, i).x[0];
            assert_int_equal(free_sims(NULL), 0);
        }
        for (int i = 0; i < 15; i++) {
            first += (x[0][i] - x[1][i]) * (x[0][i] - x[1][i]);
            second += (x[1][i] - x[2][i]) * (x[1][i] - x[2][i]);
        }
        const double order = 0.5 * log2(first / second);
        print_message("edges, turn %u: order of places %.2f\n", turn, order);
        assert_true(order > 1.9 && order < 2.1);
    }
}
#endif

/* ---- refusals ---- */

static void what_makes_no_edge_is_refused(void **state)
{
    sph_report r;
    uint32_t level;
    const double n[SPH_DIM] = {1}, zero[SPH_DIM] = {0}, bad[SPH_DIM] = {NAN};
    (void)state;
    sph_config c = edge_config(SPH_EDGE_NATURAL, SPH_TOTAL);
    assert_int_equal(sph_config_check(&c, &r), SPH_OK);
#define REFUSED(change, name)                                                                                         \
    do {                                                                                                              \
        sph_config d = c;                                                                                             \
        change;                                                                                                       \
        assert_int_equal(sph_config_check(&d, &r), SPH_BAD_CONFIG);                                                   \
        assert_string_equal(r.what, name);                                                                            \
    } while (0)
    REFUSED(d.integrator = SPH_LEAP_FROG, "integrator");
    REFUSED(d.solid = SPH_NO_SOLID, "edge");
    REFUSED(d.edge = SPH_EDGES, "edge");
    REFUSED((d.edge = SPH_NO_EDGE, d.edge_width = 1), "edge");
    REFUSED((d.edge = SPH_EDGE_M, d.edge_width = 1), "edge_width");
    REFUSED(d.edge_width = -1, "edge_width");
    REFUSED(d.edge_reflection = 0, "edge_reflection");
    REFUSED(d.edge_reflection = 0.6, "edge_reflection");
    REFUSED(d.edge_shift = 0, "edge_shift");
    REFUSED(d.edge_layers = 65, "edge_layers");
    if (SPH_DIM != 2)
        REFUSED(d.edge = SPH_EDGE_M_PRINTED, "edge");
    sph_sim *sim = new_sim(&c);
    add_block(sim, 5);
    sph_edges e = {.faces = 1u << 2 * SPH_DIM};
    assert_int_equal(sph_find_edges(sim, &e), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "faces");
    e = (sph_edges){.velocity = {NAN}};
    assert_int_equal(sph_find_edges(sim, &e), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_set_edge(sim, 100000, 1, n), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_set_edge(sim, 0, 65, n), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_set_edge(sim, 0, 1, zero), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_set_edge(sim, 0, 1, bad), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_set_edge(sim, 0, 1, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_get_edge(sim, 0, NULL, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_get_edge(sim, c.max_particles, &level, NULL), SPH_BAD_ARGUMENT);
    must(sim, sph_step(sim));
    assert_int_equal(sph_find_edges(sim, NULL), SPH_BAD_STATE);
    assert_int_equal(sph_set_edge(sim, 0, 1, n), SPH_BAD_STATE);
    c.edge_width = 0.2;
    sph_sim *matched = new_sim(&c);
    add_block(matched, 5);
    assert_int_equal(sph_find_edges(matched, NULL), SPH_BAD_ARGUMENT); /* its axes are not known */
    c.edge = SPH_NO_EDGE;
    c.edge_width = 0;
    sph_sim *none = new_sim(&c);
    add_block(none, 5);
    assert_int_equal(sph_find_edges(none, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_get_edge(none, 0, &level, NULL), SPH_BAD_ARGUMENT);
}

/* ---- the machine that runs steps ---- */

static sph_sim *begin(const sph_config *c)
{
    sph_sim *sim = new_sim(c);
    rattle(sim, c);
    return sim;
}

static void slices_threads_and_restarts_change_no_bit(void **state)
{
    sph_totals t;
    (void)state;
    for (uint32_t turn = 0; turn < 3; turn++) {
        sph_config c = edge_config(turn == 2 ? SPH_EDGE_M : SPH_EDGE_NATURAL, turn ? SPH_TOTAL : SPH_CORRECTED);
        c.edge_width = turn == 1 ? 4 * DX : 0;
        c.max_particles = 1000;
        sph_get_totals(same_bits_any_way(c, begin, 8), &t);
        assert_true(t.absorbed != 0);
        /* a dump does not fit a scene with other edges */
        sph_sim *elsewhere = new_sim(&c);
        const sph_edges e = {.faces = SPH_LOW(0)};
        random_cloud(elsewhere, add_rock(elsewhere), N, DX, 0, 0.05, 0);
        must(elsewhere, sph_find_edges(elsewhere, &e));
        middle_dump.at = 0;
        assert_true(sph_restore(elsewhere, get_bytes, &middle_dump) != SPH_OK);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void a_failed_step_takes_nothing(void **state)
{
    (void)state;
    for (uint32_t turn = 0; turn < 2; turn++) {
        const double v[SPH_DIM] = {9};
        const sph_edges e = {.faces = SPH_LOW(0), .velocity = {9}};
        sph_config c = edge_config(SPH_EDGE_NATURAL, SPH_CORRECTED);
        c.edge_width = turn ? 3 * DX : 0;
        c.dt = 1e-3;
        sph_sim *sim = new_sim(&c);
        const uint32_t set = add_rock(sim);
        double lo[SPH_DIM] = {0}, hi[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++)
            hi[k] = 5 * DX;
        must(sim, sph_add_box(sim, set, lo, hi, v));
        must(sim, sph_find_edges(sim, &e));
        sph_status st = SPH_OK;
        uint64_t hash = 0;
        for (int k = 0; !st && k < 20000; k++) {
            hash = sph_hash(sim);
            st = sph_step(sim);
        }
        if (st != SPH_OUT_OF_DOMAIN)
            fail_msg("%s: %s", sph_status_text(st), sph_last(sim)->what);
        assert_true(sph_hash(sim) == hash);
        assert_int_equal(free_sims(NULL), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        subject(a_block_is_peeled_layer_by_layer),
        subject(normals_are_exact_and_images_are_no_edge),
#if SPH_DIM == 2
        subject(rims_of_a_ring_are_found),
        subject(disorder_hides_no_edge),
#endif
        subject(a_host_may_set_normals),
        subject(a_line_lets_out_what_it_should),
        subject(p_m_and_h_are_exact_for_linear_velocities),
        subject(edges_only_take_energy),
        subject(what_stands_under_pressure_stays),
#if SPH_DOUBLE && SPH_DIM < 3
        subject(edges_are_of_second_order),
#endif
        subject(what_makes_no_edge_is_refused),
        subject(slices_threads_and_restarts_change_no_bit),
        subject(a_failed_step_takes_nothing),
    };
    return run_subjects("edges", tests);
}
