/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_quadrature.c: weights beside flat faces of solids: on lattices against their derivation, the energy of a bent
   strip, clamps, what is conserved, that a weight is kept, refusals, and that slices, threads and restarts change no
   bit. */
#include "any_way.h"
#include "bodies.h"

#define DX 0.1
#define MU 2e5

static sph_config config_of(uint32_t form, double h, double edge)
{
    sph_config c = open_config(edge, DX);
    c.solid = form;
    c.smoothing_length = h * DX;
    c.viscosity = SPH_INVISCID;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.face_quadrature = true;
    c.books = true;
    c.max_threads = 3;
    return c;
}

#if SPH_DIM > 1
/* a lattice of `columns` along the first axis (and the second in 3-D), n rows along the last, from the corner 0 on */
static void add_lattice(sph_sim *sim, uint32_t set, uint32_t first, uint32_t columns, uint32_t n)
{
    for (uint32_t i = 0; i < (SPH_DIM == 3 ? columns * columns : columns) * n; i++) {
        const uint32_t j = i / n;
        double x[SPH_DIM];
        for (uint32_t k = 0; k < SPH_DIM - 1; k++)
            x[k] = ((k ? j / columns : first + j % columns) + 0.5) * DX;
        x[SPH_DIM - 1] = (i % n + 0.5) * DX;
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
    }
}

static sph_sim *strip(const sph_config *c, uint32_t columns, uint32_t n, double held_columns)
{
    uint32_t set;
    sph_solid m = {.shear = MU, .flat_faces = c->face_quadrature};
    sph_sim *sim = new_sim(c);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    add_lattice(sim, set, (uint32_t)held_columns, columns, n);
    if (held_columns > 0) {
        m.held = (1u << SPH_DIM) - 1;
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        add_lattice(sim, set, 0, (uint32_t)held_columns, n);
    }
    return sim;
}

static double weight_at(const sph_sim *sim, uint32_t id)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->id[0][i] == id)
            return (double)b->quadrature[0][i];
    return 0;
}

/* Where the kernel reaches neighbours and diagonals only: 1 + c, 1 - c, 1 ..., c = (1/24 + delta)/(1 - delta), delta
   2 g(sqrt 2)/(2 g(1) + 2 g(sqrt 2)) in 2-D; in 3-D, where a row has diagonals of its own, 2 g(sqrt 2)/(2 g(1) + 6
   g(sqrt 2)). */
static void rows_beside_a_face_have_the_weights_of_the_derivation(void **state)
{
    (void)state;
    for (uint32_t form = SPH_CORRECTED; form <= SPH_TOTAL; form++) {
        sph_config c = config_of(form, 0.8, 3);
        double w, near, far;
        sph_kernel_value(c.kernel, DX, c.smoothing_length, &w, &near);
        sph_kernel_value(c.kernel, sqrt(2) * DX, c.smoothing_length, &w, &far);
        far /= sqrt(2);
        const double delta = 2 * far / (2 * near + (SPH_DIM == 3 ? 6 : 2) * far), by = (1.0 / 24 + delta) / (1 - delta);
        const uint32_t n = 8, columns = 9, middle = SPH_DIM == 3 ? 4 * 9 + 4 : 4;
        for (int k = 0; k < SPH_DIM - 1; k++) {
            c.lo[k] = 0;
            c.hi[k] = columns * DX;
            c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
        }
        sph_sim *sim = strip(&c, columns, n, 0);
        must(sim, sph_ready(sim));
        for (uint32_t r = 0; r < n; r++) {
            const uint32_t depth = r < n - 1 - r ? r : n - 1 - r;
            close_to(weight_at(sim, middle * n + r), depth == 0 ? 1 + by : depth == 1 ? 1 - by : 1, 300 * EPS);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* v = (z x, 0 ...), z from the mid-line: e_xx = z. What the middle column's energy is off H^3/12 by. Weights leave
   what goes as the cube of the spacing: w changes between two rows as in their middle, a spacing below the face */
static void bend(void *ctx, const double *x, double *v, double *rho)
{
    const double *middle = ctx;
    (void)rho;
    memset(v, 0, SPH_DIM * sizeof *v);
    v[0] = (x[SPH_DIM - 1] - middle[1]) * (x[0] - middle[0]);
}
static double bent_energy_off(uint32_t form, uint32_t kernel, double h, uint32_t n, bool weighs)
{
    const uint32_t columns = 13;
    double middle[2] = {0.5 * columns * DX, 0.5 * n * DX}, sum = 0, share = 0;
    sph_config c = config_of(form, h, n * DX);
    c.kernel = kernel;
    c.face_quadrature = weighs;
    for (int k = 0; k < SPH_DIM - 1; k++) {
        c.lo[k] = -DX;
        c.hi[k] = (columns + 1) * DX;
        if (k == 1) {
            c.lo[k] = 0;
            c.hi[k] = columns * DX;
            c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
        }
    }
    c.max_particles = 20000;
    sph_sim *sim = strip(&c, columns, n, 0);
    must(sim, sph_apply_field(sim, 0, bend, middle));
    must(sim, sph_ready(sim));
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = 0; i < sim->now.count; i++) {
        sph_particle q;
        must(sim, sph_get(sim, i, &q));
        if (fabs(q.x[0] - middle[0]) > 0.1 * DX || (SPH_DIM == 3 && fabs(q.x[1] - middle[0]) > 0.1 * DX))
            continue;
        const double e = (double)b->dstress[0][i] / (2 * MU) - (double)b->drho[0][i] / 3;
        const double phi = weighs ? (double)b->quadrature[0][i] : 1;
        sum += phi * e * e * DX;
        share += (phi - 1) * DX;
    }
    assert_int_equal(free_sims(NULL), 0);
    close_to(share, 0, 1e3 * EPS);
    return fabs(sum * 12 / (n * DX * n * DX * n * DX) - 1);
}
static void the_energy_of_a_bent_strip_is_nearly_exact(void **state)
{
    static const struct {
        uint32_t kernel;
        double h;
    } of[] = {{SPH_WENDLAND_C2, 0.8}, {SPH_CUBIC, 1.2}, {SPH_QUINTIC, 0.7}, {SPH_WENDLAND_C2, 1.2}};
    (void)state;
    for (uint32_t form = SPH_CORRECTED; form <= SPH_TOTAL; form++)
        for (size_t k = 0; k < (SPH_DIM == 3 ? 1 : 4); k++) {
            const double plain = bent_energy_off(form, of[k].kernel, of[k].h, 10, false);
            const double a = bent_energy_off(form, of[k].kernel, of[k].h, 10, true);
            const double b = bent_energy_off(form, of[k].kernel, of[k].h, 20, true);
            print_message("kernel %u h %g: energy of bending off by %.2e, with weights %.2e, at twice the rows %.2e\n",
                          of[k].kernel, of[k].h, plain, a, b);
            assert_true(plain > 0.009 && a < 0.35 * plain && b < a / 6);
        }
}

/* no face where a clamp holds: in the column beside it rows away from its ends have weight 1, and the outermost one
   lacks but the diagonal to the clamp */
static void a_clamp_is_no_face(void **state)
{
    sph_config c = config_of(SPH_TOTAL, 0.8, 3);
    (void)state;
    if (SPH_DIM == 3)
        return;
    sph_sim *sim = strip(&c, 9, 8, 1);
    must(sim, sph_ready(sim));
    double w, near, far;
    sph_kernel_value(c.kernel, DX, c.smoothing_length, &w, &near);
    sph_kernel_value(c.kernel, sqrt(2) * DX, c.smoothing_length, &w, &far);
    far /= sqrt(2);
    const double usual = weight_at(sim, 4 * 8) - 1;
    close_to(weight_at(sim, 0), 1 + usual * (near + 2 * far) / (near + 4 * far), 1e3 * EPS);
    for (uint32_t r = 2; r < 6; r++)
        close_to(weight_at(sim, r), 1, 1e3 * EPS);
    assert_int_equal(free_sims(NULL), 0);
}

/* A held column on the face whose moduli are halved bears a uniform stress: no free particle is accelerated. With the
   moduli of the body, or half a spacing further out, those beside it are. */
static double push_at_a_clamp(double share, double out)
{
    const uint32_t columns = 8, n = SPH_DIM == 3 ? 64 : 8;
    sph_config c = config_of(SPH_TOTAL, 0.8, 2);
    sph_solid m = {.shear = MU};
    uint32_t body, clamp;
    double most = 0;
    c.face_quadrature = false;
    for (int k = 1; k < SPH_DIM; k++) {
        c.lo[k] = 0;
        c.hi[k] = 8 * DX;
        c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
    }
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &body, NULL));
    m.shear *= share;
    m.sound_speed = c.sound_speed * sqrt(share);
    m.held = (1u << SPH_DIM) - 1;
    must(sim, sph_add_solid(sim, &m, &clamp, NULL));
    for (uint32_t i = 0; i < (columns + 1) * n; i++) {
        const double x[3] = {i < n ? -out * DX : i / n * DX, (i % 8 + 0.5) * DX, (i / 8 % 8 + 0.5) * DX};
        must(sim, sph_add_particle(sim, i < n ? clamp : body, x, NULL, 1.001 * c.rho0, NULL));
    }
    must(sim, sph_ready(sim));
    for (uint32_t i = n; i < 5 * n; i++)
        most = fmax(most, fabs(by_id(sim, i).a[0]));
    most /= 1e-3 * c.sound_speed * c.sound_speed / DX;
    assert_int_equal(free_sims(NULL), 0);
    return most;
}
static void a_clamp_on_the_face_bears_a_uniform_stress(void **state)
{
    (void)state;
    assert_true(push_at_a_clamp(0.5, 0) < (SPH_DOUBLE ? 1e-10 : 2e-2));
    assert_true(push_at_a_clamp(1, 0) > 0.1);
    assert_true(push_at_a_clamp(0.5, 0.5) > 0.1);
}

/* ---- steps ---- */

static void shear(void *ctx, const double *x, double *v, double *rho)
{
    const double *speed = ctx;
    (void)rho;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = *speed * (x[SPH_DIM - 1 - k] + 0.3 * x[0]);
}
static sph_sim *moving(const sph_config *c, double speed)
{
    sph_sim *sim = strip(c, SPH_DIM == 3 ? 5 : 10, 6, 0);
    must(sim, sph_apply_field(sim, 0, shear, &speed));
    return sim;
}

/* the books close over steps, and momentum stays */
static void energy_and_momentum_stay(void **state)
{
    (void)state;
    for (uint32_t form = SPH_CORRECTED; form <= SPH_TOTAL; form++) {
        sph_config c = config_of(form, 0.8, 1);
        sph_totals a, b;
        c.dt = 1e-4;
        sph_sim *sim = moving(&c, 0.1);
        must(sim, sph_ready(sim));
        sph_get_totals(sim, &a);
        for (int k = 0; k < 200; k++)
            must(sim, sph_step(sim));
        sph_get_totals(sim, &b);
        assert_true(b.elastic > 0.02 * a.kinetic);
        close_to(b.balance, a.balance, (SPH_DOUBLE ? 1e-4 : 1e-3) * a.kinetic);
        for (int k = 0; k < SPH_DIM; k++)
            close_to(b.momentum[k], a.momentum[k], 1e4 * EPS * a.mass * 0.1);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* forces are made anew after a field was applied, the weights of bent bodies are not */
static void a_weight_is_kept(void **state)
{
    sph_config c = config_of(SPH_CORRECTED, 0.8, 1);
    double speed = 0, was[400];
    (void)state;
    c.max_particles = 400;
    sph_sim *sim = moving(&c, 2);
    must(sim, sph_ready(sim));
    for (uint32_t i = 0; i < sph_count(sim); i++)
        was[i] = weight_at(sim, i);
    for (int k = 0; k < 30; k++)
        must(sim, sph_step(sim));
    must(sim, sph_apply_field(sim, 0, shear, &speed));
    must(sim, sph_step(sim));
    for (uint32_t i = 0; i < sph_count(sim); i++)
        assert_true(!(was[i] < weight_at(sim, i)) && !(was[i] > weight_at(sim, i)));
    assert_int_equal(free_sims(NULL), 0);
}

static sph_sim *moving_body(const sph_config *c) { return moving(c, 1); }
static void slices_threads_and_restarts_change_no_bit(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < SPH_INTEGRATORS; i++) {
        sph_config c = config_of(i % 2 ? SPH_CORRECTED : SPH_TOTAL, 0.8, 1);
        c.integrator = i;
        same_bits_any_way(c, moving_body, 6);
        assert_int_equal(free_sims(NULL), 0);
    }
}
#endif

static void what_cannot_be_weighed_is_refused(void **state)
{
    sph_config c = config_of(SPH_UPDATED, 1.2, 1);
    sph_report r;
    uint32_t set;
    (void)state;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    assert_string_equal(r.what, "face_quadrature");
    c.solid = SPH_NO_SOLID;
    assert_int_equal(sph_config_check(&c, &r), SPH_BAD_CONFIG);
    c = config_of(SPH_TOTAL, 1.2, 1);
    assert_int_equal(sph_config_check(&c, &r), SPH_DIM == 1 ? SPH_BAD_CONFIG : SPH_OK);
    c.face_quadrature = false;
    sph_sim *sim = new_sim(&c);
    const sph_solid flat = {.shear = MU, .flat_faces = true};
    assert_int_equal(sph_add_solid(sim, &flat, &set, NULL), SPH_BAD_ARGUMENT);
    assert_string_equal(sph_last(sim)->what, "flat_faces");
    assert_int_equal(free_sims(NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
#if SPH_DIM > 1
        subject(rows_beside_a_face_have_the_weights_of_the_derivation),
        subject(the_energy_of_a_bent_strip_is_nearly_exact),
        subject(a_clamp_is_no_face),
        subject(a_clamp_on_the_face_bears_a_uniform_stress),
        subject(energy_and_momentum_stay),
        subject(a_weight_is_kept),
        subject(slices_threads_and_restarts_change_no_bit),
#endif
        subject(what_cannot_be_weighed_is_refused),
    };
    return run_subjects("quadrature", tests);
}
