/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_solid.c: what a solid's stress does where the answer is known: velocity gradients of linear fields, bodies
   driven with a uniform gradient against closed solutions of the Jaumann rate, with the order in dt, and the return to
   the yield surface. */
#include "bodies.h"

#define DX 0.1

/* ---- velocity gradients ---- */

enum { CLOUD = SPH_DIM == 1 ? 40 : SPH_DIM == 2 ? 12 : 7 };

typedef struct gradient {
    double worst, inner, rate; /* worst error of dS/dt anywhere, and away from surfaces; of d rho/dt: all relative */
} gradient;

/* dS/dt and d rho/dt of a body with v = L x and random stresses, against the formula with a share of L */
static gradient gradient_errors(uint32_t form, uint32_t scheme, uint32_t kernel, double jitter, bool loose,
                                double share)
{
    const double mu = 3e4, half = 0.5 * CLOUD * DX;
    gradient g = {0, 0, 0};
    sph_config c = solid_config(form, SPH_PREDICTOR_CORRECTOR, CLOUD * DX, DX);
    sph_solid m = {.shear = mu};
    uint32_t set;
    c.scheme = scheme;
    c.kernel = kernel;
    sph_rng_seed(&dice, 5, form);
    sph_sim *sim = new_sim(&c);
    tensor l = toss_tensor(3);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    add_block(sim, set, CLOUD, DX, jitter);
    must(sim, sph_apply_field(sim, set, linear_velocity, &l));
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        set_stress(sim, i, toss_deviator(mu));
        if (loose)
            sim->buf[sim->cur].rho[0][i] = (sph_real)(0.02 * toss());
    }
    must(sim, sph_ready(sim));
    l = plus(l, share - 1, l);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        bool inner = true;
        must(sim, sph_get(sim, i, &p));
        for (int k = 0; k < SPH_DIM; k++)
            inner &= fabs(p.x[k]) < half - sim->grid.support;
        const tensor want = jaumann(l, kept_stress(sim, i), mu);
        const double e = off_by(kept_rate(sim, i), want) / (2 * mu * sqrt(square_of(l)));
        const double rate = (double)sim->buf[sim->cur].drho[0][i] * RHO / p.rho;
        g.worst = fmax(g.worst, e);
        g.inner = inner ? fmax(g.inner, e) : g.inner;
        g.rate = fmax(g.rate, fabs(rate + trace_of(l)) / sqrt(square_of(l)));
    }
    assert_int_equal(free_sims(NULL), 0);
    return g;
}

/* velocities are rounded to EPS of themselves, up to CLOUD/2 times what two neighbours differ by, and at corners the
   inverse of M multiplies errors by up to about ten */
static void linear_fields_have_exact_gradients(void **state)
{
    static const uint32_t schemes[] = {SPH_STANDARD, SPH_WEAK};
    (void)state;
    for (uint32_t form = SPH_CORRECTED; form <= SPH_TOTAL; form++)
        for (int s = 0; s < 2; s++)
            for (uint32_t kernel = SPH_CUBIC; kernel <= SPH_WENDLAND_C2; kernel += SPH_WENDLAND_C2) {
                const gradient g = gradient_errors(form, schemes[s], kernel, 0.2, true, 1);
                print_message("%s, scheme %u, kernel %u: dS/dt off by %.2g, d rho/dt by %.2g (eps %.2g)\n",
                              form_names[form],
                              schemes[s], kernel, g.worst, g.rate, EPS);
                assert_true(g.worst < 16 * CLOUD * EPS && g.rate < 16 * CLOUD * EPS);
            }
}

/* The plain form on a lattice, away from its faces: c L with c = -dx^DIM sum x^2 g, which is not quite 1; at faces it
   is wrong by most of it. */
static double lattice_sum(uint32_t kernel, double h)
{
    double c = 0;
    const int n = 4;
    for (int i = -n; i <= n; i++)
        for (int j = SPH_DIM > 1 ? -n : 0; j <= (SPH_DIM > 1 ? n : 0); j++)
            for (int k = SPH_DIM > 2 ? -n : 0; k <= (SPH_DIM > 2 ? n : 0); k++) {
                double w, dw, r = DX * sqrt((double)(i * i + j * j + k * k));
                assert_int_equal(sph_kernel_value(kernel, r, h, &w, &dw), SPH_OK);
                c -= r > 0 ? i * i * DX * DX * dw / r : 0;
            }
    return c * pow(DX, SPH_DIM);
}
static void plain_gradients_are_right_inside_a_lattice(void **state)
{
    static const uint32_t schemes[] = {SPH_STANDARD, SPH_WEAK};
    const double c = lattice_sum(SPH_CUBIC, 1.2 * DX);
    (void)state;
    for (int s = 0; s < 2; s++) {
        const gradient g = gradient_errors(SPH_UPDATED, schemes[s], SPH_CUBIC, 0, false, c);
        const gradient whole = gradient_errors(SPH_UPDATED, schemes[s], SPH_CUBIC, 0, false, 1);
        print_message("updated, scheme %u: inside %.4f L to %.2g; with faces off by %.2g\n", schemes[s], c, g.inner,
                      g.worst);
        assert_true(g.inner < 16 * CLOUD * EPS && fabs(c - 1) < 0.03 && whole.inner < 1.5 * fabs(c - 1));
        assert_true(whole.worst > 0.2);
    }
}

/* ---- driven bodies ---- */

enum { BLOCK = SPH_DIM == 1 ? 10 : SPH_DIM == 2 ? 6 : 3 };

typedef struct drive {
    uint32_t form, integrator;
    tensor l, start; /* velocity gradient; stress at the start */
    double time;
} drive;

typedef struct outcome {
    double stress, density; /* largest errors over the particles, relative */
} outcome;

static sph_sim *drive_body(const drive *d, uint32_t steps, tensor *l)
{
    sph_config c = solid_config(d->form, d->integrator, 2 * BLOCK * DX, DX);
    sph_solid m = {.shear = SOFT_MU};
    uint32_t set;
    c.sound_speed = SOFT_SPEED;
    c.dt = d->time / steps;
    c.body_force = linear_drive;
    c.body_ctx = l;
    *l = d->l;
    sph_rng_seed(&dice, 6, 1);
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    add_block(sim, set, BLOCK, DX, 0.15);
    must(sim, sph_apply_field(sim, set, linear_velocity, l));
    set_all_stress(sim, d->start);
    for (uint32_t k = 0; k < steps; k++)
        must(sim, sph_step(sim));
    return sim;
}

/* S as kept, and density, against what they should be */
static outcome drive_errors(const drive *d, uint32_t steps, tensor want, double growth)
{
    tensor l;
    outcome o = {0, 0};
    sph_sim *sim = drive_body(d, steps, &l);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        must(sim, sph_get(sim, i, &p));
        tensor s = stress_of(&p);
        o.stress = fmax(o.stress, off_by(deviator(s), want) / sqrt(square_of(want)));
        o.density = fmax(o.density, fabs(p.rho / RHO - growth));
        if (SPH_DIM < 3) { /* plane or uniaxial strain: what is not kept follows from what is */
            s = deviator(s);
            close_to(trace_of(s), 0, 8 * EPS * sqrt(square_of(s)));
            close_to(s.v[2][2], want.v[2][2], 1.01 * o.stress * sqrt(square_of(want)));
        }
    }
    assert_int_equal(free_sims(NULL), 0);
    return o;
}

/* both errors, at dt and at half of it: second order, or nothing but rounding is left */
static void second_order(const char *what, const drive *d, tensor want, double growth, uint32_t steps, double most)
{
    const outcome b = drive_errors(d, 2 * steps, want, growth), a = SPH_DOUBLE ? drive_errors(d, steps, want,
        growth) : b;
    const double noise = (SPH_DOUBLE ? 64 : 8) * steps * EPS;
    for (int k = 0; k < 2; k++) {
        const double e = k ? a.density : a.stress, f = k ? b.density : b.stress;
        const double order = f > 0 ? log(e / f) / log(2) : 9;
        if (SPH_DOUBLE)
            print_message("%s, %s, %s: %s off by %.2e, then %.2e: order %.2f\n", what, form_names[d->form],
                          integrator_names[d->integrator], k ? "density" : "stress", e, f, order);
        if (f > most + noise)
            fail_msg("%s, %s: off by %g, more than %g", what, integrator_names[d->integrator], f, most);
        if (SPH_DOUBLE && f > noise && order < 1.8)
            fail_msg("%s, %s, %s: order %.2f in dt", what, integrator_names[d->integrator], k ? "density" : "stress",
                     order);
    }
}

#define EACH_DRIVE(d)                                                                                       \
    for ((d)->form = SPH_CORRECTED; (d)->form <= SPH_TOTAL; (d)->form++)                                    \
        for ((d)->integrator = 0; (d)->integrator < SPH_INTEGRATORS; (d)->integrator++)

/* L = diag: S = 2 mu (L - tr L/3) t, rho = exp(-tr L t); in 1-D S_xx = 4/3 mu e */
static void uniform_stretch(void **state)
{
    drive d = {.time = 0.5, .l = {{{0.6, 0, 0}, {0, -0.3, 0}, {0, 0, 0.2}}}};
    (void)state;
    d.l = in_space(d.l);
    tensor want = {{{0}}};
    want = plus(want, 2 * SOFT_MU * d.time, deviator(d.l));
    EACH_DRIVE(&d)
        second_order("stretch", &d, want, exp(-trace_of(d.l) * d.time), 40, 1e-3);
}

#if SPH_DIM > 1
/* S_xy = mu sin gamma, S_xx = -S_yy = mu (1 - cos gamma) */
static tensor sheared(double gamma)
{
    const double a = SOFT_MU * (1 - cos(gamma)), b = SOFT_MU * sin(gamma);
    const tensor s = {{{a, b, 0}, {b, -a, 0}, {0, 0, 0}}};
    return s;
}

static void simple_shear(void **state)
{
    const tensor l = {{{0, 1, 0}, {0, 0, 0}, {0, 0, 0}}};
    drive d = {.time = 1, .l = l};
    (void)state;
    EACH_DRIVE(&d)
        second_order("shear", &d, sheared(d.time), 1, 40, 1e-3);
#if SPH_DIM == 3
    /* the same shear along skew axes */
    const tensor r = rotation(0.9, 1, -2, 0.7);
    d.l = conjugate(r, l);
    EACH_DRIVE(&d)
        second_order("skew shear", &d, conjugate(r, sheared(d.time)), 1, 40, 1e-3);
#endif
}

/* a body with stresses in it turns round once: they turn with it. The distance between the first and the last state */
static void rigid_rotation_by_a_full_turn(void **state)
{
    drive d = {.time = 1};
    const double w = 2 * 3.14159265358979323846;
    double u[3] = {0, 0, 1};
    (void)state;
    sph_rng_seed(&dice, 8, 8);
    d.start = toss_deviator(SOFT_MU);
    if (SPH_DIM == 3)
        u[0] = 0.48, u[1] = -0.6, u[2] = 0.64;
    for (int k = 0; k < 3; k++) {
        d.l.v[(k + 1) % 3][k] = w * u[(k + 2) % 3];
        d.l.v[k][(k + 1) % 3] = -w * u[(k + 2) % 3];
    }
    EACH_DRIVE(&d)
        second_order("full turn", &d, d.start, 1, 600, 1e-3);
}
#endif

/* ---- yield ---- */

/* random trial stresses up to three times Y, at rest, so that one step does nothing but return them; all integrators */
static sph_sim *trial_body(uint32_t yield, uint32_t integrator, double y, double hardening, tensor *trial)
{
    sph_config c = solid_config(SPH_UPDATED, integrator, 2 * BLOCK * DX, DX);
    sph_solid m = {.shear = SOFT_MU, .yield = y, .hardening = hardening};
    uint32_t set;
    c.sound_speed = SOFT_SPEED;
    c.dt = 1e-6;
    c.yield = yield;
    sph_sim *sim = new_sim(&c);
    sph_rng_seed(&dice, 10, 3);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    add_block(sim, set, BLOCK, DX, 0.1);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        set_stress(sim, i, toss_deviator(y * (1 + toss())));
        trial[i] = kept_stress(sim, i);
    }
    must(sim, sph_step(sim));
    return sim;
}

/* VON_MISES lands on sqrt(3 J2) = Y + H ep along the radius, with ep what consistency asks for; S inside stays */
static void a_return_lands_on_the_yield_surface(void **state)
{
    const double y = 1e-2 * SOFT_MU;
    tensor trial[400];
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++)
        for (int h = 0; h < 2; h++) {
            const double hard = h ? 0.3 * SOFT_MU : 0;
            sph_sim *sim = trial_body(SPH_VON_MISES, integrator, y, hard, trial);
            uint32_t on = 0, in = 0;
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                sph_particle p;
                must(sim, sph_get(sim, i, &p));
                const double q = mises(trial[p.id]), got = mises(stress_of(&p)), want = y + hard * p.plastic;
                if (q < y) {
                    assert_true(p.plastic == 0);
                    close_to(off_by(deviator(stress_of(&p)), trial[p.id]), 0, 4 * EPS * q);
                    in++;
                    continue;
                }
                on++;
                close_to(got, want, 8 * EPS * q);
                close_to(p.plastic, (q - got) / (3 * SOFT_MU), 8 * EPS * q / SOFT_MU);
                close_to(off_by(deviator(stress_of(&p)), plus(trial[p.id], got / q - 1, trial[p.id])), 0, 8 * EPS * q);
            }
            assert_true(on > 3 && in > 0);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* as printed: times Y^2/(3 J2) with J2 of the components in the plane: inside by that factor */
static void the_printed_return_lands_inside(void **state)
{
    const double y = 1e-2 * SOFT_MU;
    tensor trial[400];
    uint32_t on = 0;
    (void)state;
    sph_sim *sim = trial_body(SPH_VON_MISES_GRAY, SPH_KICK_DRIFT_KICK, y, 0, trial);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        must(sim, sph_get(sim, i, &p));
        const double j3 = 1.5 * square_of(in_space(trial[p.id])), f = j3 > y * y ? y * y / j3 : 1;
        close_to(off_by(deviator(stress_of(&p)), plus(trial[p.id], f - 1, trial[p.id])), 0, 8 * EPS * sqrt(j3));
        close_to(p.plastic, sqrt(j3) * (1 - f) / (3 * SOFT_MU), 8 * EPS * sqrt(j3) / SOFT_MU);
        on += f < 1;
        if (f < 1 && SPH_DIM == 3)
            assert_true(mises(stress_of(&p)) < y);
    }
    assert_true(on > 3);
}

/* Stretched past yield and back by a uniform gradient that changes sign: elastic up to Y, then along Y + H ep, back
   down with slope 2 mu; plastic work is the integral of sqrt(3 J2) d ep, and ep what of the strain is not elastic. */
static void loading_and_unloading(void **state)
{
    const double y = 1e-2 * SOFT_MU, hard = 0.5 * SOFT_MU;
    tensor l = {{{0}}};
    sph_config c = solid_config(SPH_CORRECTED, SPH_KICK_DRIFT_KICK, 2 * BLOCK * DX, DX);
    sph_solid m = {.shear = SOFT_MU, .yield = y, .hardening = hard};
    uint32_t set;
    (void)state;
    l.v[0][0] = 1;
    c.sound_speed = SOFT_SPEED;
    c.dt = 1e-4;
    c.yield = SPH_VON_MISES;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    add_block(sim, set, BLOCK, DX, 0.1);
    double strain = 0, work = 0, before = 0, eplus = 0, top = 0;
    sph_particle p = {0};
    for (int k = 0; k < 200; k++) {
        const double sign = k < 150 ? 1 : -1;
        tensor now = {{{0}}};
        now = plus(now, sign, l);
        must(sim, sph_apply_field(sim, set, linear_velocity, &now));
        must(sim, sph_step(sim));
        strain += sign * c.dt; /* to first order: the closed values below hold to the strain's square */
        p = by_id(sim, 1);
        const double q = mises(stress_of(&p)), elastic = 3 * SOFT_MU * 2.0 / 3 * strain;
        work += (p.plastic - before) * (q + 0.5 * (y + hard * before - q) * (before > 0));
        before = p.plastic;
        if (k == 149) {
            eplus = p.plastic;
            top = q;
            /* q = Y + H ep = 3 mu (2/3 e - ep) */
            close_to(p.plastic, (elastic - y) / (3 * SOFT_MU + hard), 0.02 * p.plastic);
        }
        if (q < y && k < 150)
            close_to(q, elastic, 0.02 * y);
        if (k < 150 && p.plastic > 0)
            close_to(q, y + hard * p.plastic, 16 * EPS * y);
        if (k >= 150)
            close_to(p.plastic, eplus, 8 * EPS * eplus); /* what stood on the surface may be returned by a last digit */
    }
    close_to(mises(stress_of(&p)), top - 2 * SOFT_MU * 50 * c.dt, 0.02 * y);
    sph_totals t;
    sph_get_totals(sim, &t);
    const double volume = t.mass / RHO;
    print_message("plastic strain %.4g, plastic work %.6g of %.6g (integral)\n", eplus, t.plastic_work / volume, work);
    close_to(t.plastic_work, volume * eplus * (y + 0.5 * hard * eplus), 0.001 * t.plastic_work);
    close_to(t.plastic_work / volume, work, 0.005 * work);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(linear_fields_have_exact_gradients),
        subject(plain_gradients_are_right_inside_a_lattice),
        subject(uniform_stretch),
#if SPH_DIM > 1
        subject(simple_shear),
        subject(rigid_rotation_by_a_full_turn),
#endif
        subject(a_return_lands_on_the_yield_surface),
        subject(the_printed_return_lands_inside),
        subject(loading_and_unloading),
    };
    return run_subjects("solid", list);
}
