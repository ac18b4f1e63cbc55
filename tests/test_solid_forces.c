/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_solid_forces.c: forces of solids: momentum and angular momentum, energy and its books, artificial stress against
   closed forms, waves in a periodic bar. */
#include "bodies.h"

#define DX 0.1
#define MU 4e5 /* Pa */
#define PI 3.14159265358979323846
enum { CLOUD = SPH_DIM == 1 ? 40 : SPH_DIM == 2 ? 14 : 8 };

/* ---- momentum ---- */

typedef struct sums {
    double force[3], torque[3], size, ang_size; /* sizes: sums of magnitudes, what rounding is measured by */
} sums;

static sums force_sums(const sph_sim *sim)
{
    sums o;
    memset(&o, 0, sizeof o);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        double x[3] = {0, 0, 0}, a[3] = {0, 0, 0};
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        for (int k = 0; k < SPH_DIM; k++) {
            x[k] = p.x[k];
            a[k] = p.mass * p.a[k];
            o.force[k] += a[k];
            o.size += fabs(a[k]);
        }
        for (int k = 0; k < 3; k++)
            o.torque[k] += x[(k + 1) % 3] * a[(k + 2) % 3] - x[(k + 2) % 3] * a[(k + 1) % 3];
    }
    o.ang_size = o.size * CLOUD * DX;
    return o;
}

typedef struct scene {
    uint32_t form, scheme, viscosity, repel;
    bool two, fluid, periodic, mirror; /* a second material; a gas beside the rock; faces of the first axis */
} scene;

/* a jittered cloud with random densities, velocities and stresses */
static sph_sim *cloud(const scene *s)
{
    sph_config c = solid_config(s->form, SPH_KICK_DRIFT_KICK, CLOUD * DX, DX);
    sph_solid m = {.shear = MU}, soft = {.shear = 0.1 * MU, .rho0 = 700, .sound_speed = 9};
    sph_fluid gas = {.own_eos = true, .eos = SPH_ISOTHERMAL, .sound_speed = 3, .rho0 = 300};
    uint32_t set, other = 0;
    c.scheme = s->scheme;
    c.viscosity = s->viscosity;
    c.alpha = 0.3;
    c.beta = 0.5;
    c.nu = 0.02;
    c.artificial_stress = s->repel;
    c.max_particles = 600;
    c.max_stretch = 1;
    if (s->periodic || s->mirror) {
        c.lo[0] = -0.5 * CLOUD * DX;
        c.hi[0] = 0.5 * CLOUD * DX;
        c.face[0][0] = c.face[0][1] = s->periodic ? SPH_PERIODIC : SPH_SYMMETRY;
    }
    sph_sim *sim = new_sim(&c);
    sph_rng_seed(&dice, 12, 1);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    if (s->two)
        must(sim, sph_add_solid(sim, &soft, &other, NULL));
    else if (s->fluid)
        must(sim, sph_add_fluid(sim, &gas, &other));
    uint32_t total = 1;
    for (int k = 0; k < SPH_DIM; k++)
        total *= CLOUD;
    for (uint32_t i = 0; i < total; i++) {
        double x[SPH_DIM], v[SPH_DIM];
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= CLOUD) {
            x[k] = (at % CLOUD + 0.5 - 0.5 * CLOUD + 0.2 * toss()) * DX;
            v[k] = toss();
        }
        const bool second = other && x[0] > 0.1;
        must(sim, sph_add_particle(sim, second ? other : set, x, v,
                                   (second ? s->two ? 700 : 300 : RHO) * (1 + 0.03 * toss()), NULL));
    }
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sim->buf[sim->cur].set[0][i] == set || s->two)
            set_stress(sim, i, toss_deviator(0.3 * MU));
    must(sim, sph_ready(sim));
    return sim;
}

/* sums of m a cancel to rounding for all forms, whatever they meet; along mirror faces and round periodic ones too */
static void forces_cancel(void **state)
{
    uint32_t tried = 0;
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (uint32_t scheme = SPH_STANDARD; scheme <= SPH_WEAK; scheme++)
            for (uint32_t repel = 0; repel < (form == SPH_TOTAL ? 1 : SPH_ARTIFICIAL_STRESSES); repel++)
                for (uint32_t with = 0; with < 5; with++) {
                    const scene s = {form, scheme, with % SPH_VISCOSITIES, repel, with == 1, with == 2, with == 3,
                                     with == 4};
                    const sums m = force_sums(cloud(&s));
                    assert_true(m.size > 0);
                    for (int k = with == 4; k < SPH_DIM; k++)
                        close_to(m.force[k], 0, 64 * EPS * m.size);
                    tried++;
                    assert_int_equal(free_sims(NULL), 0);
                }
    assert_true(tried == 70);
}

#if SPH_DIM > 1
/* the forms with corrected gradients have no torque, beside another material or a gas too; Gray's has one */
static void torques_cancel_where_gradients_are_corrected(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (uint32_t scheme = SPH_STANDARD; scheme <= SPH_WEAK; scheme++)
            for (uint32_t with = 0; with < 3; with++) {
                const scene s = {form, scheme, SPH_ARTIFICIAL, 0, with == 1, with == 2, false, false};
                const sums m = force_sums(cloud(&s));
                double torque = 0;
                for (int k = 0; k < 3; k++)
                    torque = fmax(torque, fabs(m.torque[k]) / m.ang_size);
                if (form == SPH_UPDATED)
                    assert_true(torque > 1e-4);
                else
                    close_to(torque, 0, 64 * EPS);
                assert_int_equal(free_sims(NULL), 0);
            }
}
#endif

/* A body cut by a mirror plane has the accelerations and rates of the whole (not with artificial stress by components:
   of a shear stress and its mirror image only one is positive). Behind a no-slip face the other half stands as in a
   mirror, moves the other way and has the same stress: its shear goes on, and so does its traction along the face. */
static void the_other_half_of(uint32_t face)
{
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (uint32_t repel = 0; repel <= (form == SPH_TOTAL ? SPH_NO_ARTIFICIAL_STRESS : SPH_PRINCIPAL); repel++) {
            sph_sim *sim[2];
            for (int whole = 0; whole < 2; whole++) {
                sph_config c = solid_config(form, SPH_KICK_DRIFT_KICK, 8 * DX, DX);
                sph_solid m = {.shear = MU};
                uint32_t set, id;
                c.artificial_stress = repel;
                c.viscosity = SPH_ARTIFICIAL;
                c.alpha = 0.3;
                c.max_stretch = 1;
                if (!whole) {
                    c.lo[0] = 0;
                    c.face[0][0] = face;
                }
                sim[whole] = new_sim(&c);
                sph_rng_seed(&dice, 13, 1);
                must(sim[whole], sph_add_solid(sim[whole], &m, &set, NULL));
                for (int i = 0; i < (SPH_DIM == 1 ? 6 : SPH_DIM == 2 ? 36 : 100); i++) {
                    double x[SPH_DIM], v[SPH_DIM];
                    const double rho = RHO * (1 + 0.02 * toss());
                    for (int k = 0, at = i; k < SPH_DIM; k++, at /= SPH_DIM == 3 ? 5 : 6) {
                        x[k] = (at % (SPH_DIM == 3 ? 5 : 6) + 0.5 + 0.2 * toss()) * DX;
                        v[k] = toss();
                    }
                    tensor s = toss_deviator(0.3 * MU);
                    must(sim[whole], sph_add_particle(sim[whole], set, x, v, rho, &id));
                    set_stress(sim[whole], id, s);
                    if (!whole)
                        continue;
                    x[0] = -x[0];
                    for (int k = 0; k < (face == SPH_SYMMETRY ? 1 : SPH_DIM); k++)
                        v[k] = -v[k];
                    for (int k = 1; k < 3 && face == SPH_SYMMETRY; k++)
                        s.v[0][k] = s.v[k][0] = -s.v[0][k];
                    must(sim[1], sph_add_particle(sim[1], set, x, v, rho, &id));
                    set_stress(sim[1], id, s);
                }
                must(sim[whole], sph_ready(sim[whole]));
            }
            double size = 0, rates = 0, off = 0, out = 0;
            for (uint32_t i = 0; i < sph_count(sim[0]); i++) {
                sph_particle a, b;
                must(sim[0], sph_get(sim[0], i, &a));
                for (uint32_t j = 0; j < sph_count(sim[1]); j++) {
                    must(sim[1], sph_get(sim[1], j, &b));
                    if (b.id != 2 * a.id)
                        continue;
                    for (int k = 0; k < SPH_DIM; k++) {
                        size = fmax(size, fabs(b.a[k]));
                        off = fmax(off, fabs(a.a[k] - b.a[k]));
                    }
                    rates = fmax(rates, sqrt(square_of(kept_rate(sim[1], j))));
                    out = fmax(out, off_by(kept_rate(sim[0], i), kept_rate(sim[1], j)));
                }
            }
            assert_true(size > 0 && rates > 0);
            close_to(off, 0, 128 * EPS * size);
            close_to(out, 0, 128 * EPS * rates);
            assert_int_equal(free_sims(NULL), 0);
        }
}
static void a_mirror_face_is_the_other_half(void **state)
{
    (void)state;
    the_other_half_of(SPH_SYMMETRY);
}
static void a_no_slip_face_carries_shear(void **state)
{
    (void)state;
    the_other_half_of(SPH_MIRROR_NO_SLIP);
}

#if SPH_DIM > 1
/* a block with the same shear stress everywhere, hanging on a no-slip face: nothing pulls at the row on the face along
   it, while the rows at free ends are pulled with about stress/(rho dx) */
static void a_sheared_block_hangs_on_a_no_slip_face(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++) {
        sph_config c = solid_config(form, SPH_PREDICTOR_CORRECTOR, 12 * DX, DX);
        const sph_solid m = {.shear = MU};
        tensor s = {{{0}}};
        uint32_t set;
        double lo[SPH_DIM], hi[SPH_DIM], bottom = 0, top = 0;
        c.max_particles = SPH_DIM == 3 ? 2000 : 400;
        c.max_stretch = 1;
        c.lo[1] = 0;
        c.face[1][0] = SPH_MIRROR_NO_SLIP;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        for (int k = 0; k < SPH_DIM; k++) {
            lo[k] = 0;
            hi[k] = (k == 1 ? 8 : 12) * DX;
        }
        must(sim, sph_add_box(sim, set, lo, hi, NULL));
        s.v[0][1] = s.v[1][0] = 1e-3 * MU;
        set_all_stress(sim, s);
        must(sim, sph_ready(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle p;
            must(sim, sph_get(sim, i, &p));
            if (fabs(p.x[0] - 6.5 * DX) > 0.1 * DX || (SPH_DIM == 3 && fabs(p.x[SPH_DIM - 1] - 6.5 * DX) > 0.1 * DX))
                continue; /* the middle column */
            bottom = p.x[1] < DX ? p.a[0] : bottom;
            top = p.x[1] > 7 * DX ? p.a[0] : top;
        }
        print_message("%s: pulled along by %.3g on the face, %.3g at the free end (stress/rho dx is %.3g)\n",
                      form_names[form], bottom, top, 1e-3 * MU / RHO / DX);
        assert_true(fabs(top) > 0.3 * 1e-3 * MU / RHO / DX);
        close_to(bottom, 0, 128 * EPS * fabs(top));
        assert_int_equal(free_sims(NULL), 0);
    }
}
#endif

/* three particles of which each is almost, or just, out of the others' reach are pulled as without correction: M of
   them is tiny but of good shape */
static void too_few_neighbours_take_the_plain_gradient(void **state)
{
    static const double places[4][3] = {{0}, {1}, {0.5, 0.8660254}, {0.5, 0.2886751, 0.8164966}};
    (void)state;
    for (uint32_t form = SPH_CORRECTED; form <= SPH_TOTAL; form++)
        for (uint32_t scheme = SPH_STANDARD; scheme <= SPH_WEAK; scheme++)
            for (int out = 0; out < 2; out++) {
                double a[2][4][SPH_DIM], size = 0;
                for (int plain = 0; plain < 2; plain++) {
                    sph_config c = solid_config(plain ? SPH_UPDATED : form, SPH_PREDICTOR_CORRECTOR, 8 * DX, DX);
                    const sph_solid m = {.shear = MU};
                    uint32_t set;
                    c.scheme = scheme;
                    c.max_stretch = 1;
                    sph_sim *sim = new_sim(&c);
                    must(sim, sph_add_solid(sim, &m, &set, NULL));
                    for (uint32_t i = 0; i <= SPH_DIM; i++) {
                        double x[SPH_DIM];
                        for (int k = 0; k < SPH_DIM; k++)
                            x[k] = places[i][k] * (out ? 2.0001 : 1.9999) * c.smoothing_length;
                        must(sim, sph_add_particle(sim, set, x, NULL, 750, NULL)); /* p = -1e5 Pa */
                    }
                    must(sim, sph_ready(sim));
                    for (uint32_t i = 0; i <= SPH_DIM; i++)
                        for (int k = 0; k < SPH_DIM; k++) {
                            a[plain][i][k] = by_id(sim, i).a[k];
                            size = fmax(size, fabs(a[plain][i][k]));
                        }
                }
                assert_true(size < 1e-2 && (out || size > 0));
                for (uint32_t i = 0; i <= SPH_DIM; i++)
                    for (int k = 0; k < SPH_DIM; k++)
                        close_to(a[0][i][k], a[1][i][k], 1e-3 * size);
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* ---- energy ---- */

enum { PLATE = SPH_DIM == 1 ? 16 : SPH_DIM == 2 ? 7 : 4 };
/* in 3-D, where it takes long, not every form with every integrator */
static bool skipped(uint32_t form, uint32_t integrator)
{
    return SPH_DIM == 3 && form != SPH_CORRECTED &&
        integrator != (form == SPH_TOTAL ? SPH_RUNGE_KUTTA : SPH_PREDICTOR_CORRECTOR);
}

typedef struct balance {
    double now, kinetic, dissipated, plastic, wall;
} balance;

static balance balance_of(const sph_sim *sim)
{
    sph_totals t;
    balance b = {0};
    sph_get_totals(sim, &t);
    b.now = t.kinetic + t.elastic + t.internal;
    b.kinetic = t.kinetic;
    b.dissipated = t.dissipated;
    b.plastic = t.plastic_work;
    b.wall = t.wall_work;
    return b;
}

/* a block that was set moving by v = L x, L having no turn: it stretches and shears to and fro */
static sph_sim *plate(uint32_t form, uint32_t integrator, double dt, double speed, const sph_solid *m,
                      uint32_t viscosity)
{
    sph_config c = solid_config(form, integrator, 2 * PLATE * DX, DX);
    tensor l = {{{speed, 0.5 * speed, 0}, {0.5 * speed, -0.7 * speed, 0}, {0, 0, 0.2 * speed}}};
    uint32_t set;
    c.dt = dt;
    c.books = true;
    c.viscosity = viscosity;
    c.alpha = 0.5;
    c.yield = m->yield > 0 ? SPH_VON_MISES : SPH_NO_YIELD;
    l = in_space(l);
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, m, &set, NULL));
    add_block(sim, set, PLATE, DX, 0);
    must(sim, sph_apply_field(sim, set, linear_velocity, &l));
    must(sim, sph_ready(sim));
    return sim;
}

/* the largest change of kinetic + elastic + internal energy in ten periods of the longest longitudinal wave */
static double energy_drift(uint32_t form, double dt)
{
    const sph_solid m = {.shear = MU};
    const double c = sqrt(400 + 4 * MU / (3 * RHO)), end = 10 * 2 * PLATE * DX / c;
    sph_sim *sim = plate(form, SPH_KICK_DRIFT_KICK, dt, 1e-5 * c / (PLATE * DX), &m, SPH_INVISCID);
    const double start = balance_of(sim).now;
    double worst = 0;
    while (sph_time(sim) < end) {
        must(sim, sph_step(sim));
        worst = fmax(worst, fabs(balance_of(sim).now / start - 1));
    }
    assert_int_equal(free_sims(NULL), 0);
    return worst;
}
static void a_free_block_keeps_its_energy(void **state)
{
    const double dt = SPH_DIM == 1 ? 2e-4 : SPH_DIM == 2 ? 1e-4 : 7e-5;
    const uint32_t first = SPH_DIM == 3 ? SPH_CORRECTED : SPH_UPDATED, last = SPH_DIM == 3 ? SPH_CORRECTED : SPH_TOTAL;
    (void)state;
    for (uint32_t form = first; form <= last; form++) {
        const double a = energy_drift(form, dt), b = SPH_DOUBLE ? energy_drift(form, 0.5 * dt) : a;
        print_message("%s: energy off by %.2e at dt = %g, by %.2e at half of it\n", form_names[form], a, dt, b);
        assert_true(a < (SPH_DOUBLE ? 1e-4 : 1e-3));
        if (SPH_DOUBLE)
            assert_true(b < 0.3 * a);
    }
}

/* Leap-frog's velocities are half a step ahead: the energy read is off by up to half of what a step changes the kinetic
   one by. */
static double skew_of(uint32_t integrator, double before, double after)
{
    return integrator == SPH_LEAP_FROG ? 0.5 * fabs(after - before) : 0;
}

/* what viscosity and yielding take is on the books, to 1 % of it, by every integrator */
static void viscosity_and_yield_take_what_the_books_say(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++)
            for (int yields = 0; yields < 2 && !skipped(form, integrator); yields++) {
                const double c = sqrt(400 + 4 * MU / (3 * RHO)), speed = (yields ? 1e-2 : 1e-3) * c / (PLATE * DX);
                const sph_solid m = {.shear = MU, .yield = yields ? 2e-3 * MU : 0, .hardening = 0.1 * MU};
                sph_sim *sim = plate(form, integrator, 1e-4, speed, &m, yields ? SPH_INVISCID : SPH_ARTIFICIAL);
                const balance a = balance_of(sim);
                double skew = 0, kinetic = a.kinetic;
                for (int k = 0; k < 150; k++) {
                    must(sim, sph_step(sim));
                    skew = skew_of(integrator, kinetic, balance_of(sim).kinetic);
                    kinetic = balance_of(sim).kinetic;
                }
                const balance b = balance_of(sim);
                const double taken = yields ? b.plastic : b.dissipated, lost = a.now - b.now;
                print_message("%s, %s: %s %.4f of the energy, unexplained %.2e\n", form_names[form],
                              integrator_names[integrator],
                              yields ? "yielding takes" : "viscosity takes", taken / a.now, (lost - taken) / a.now);
                assert_true(taken > 0.05 * a.now);
                close_to(lost, taken, 0.01 * taken + 1.1 * skew);
                assert_int_equal(free_sims(NULL), 0);
            }
}

/* a bar whose end is pulled by a held set: the work on the books is what the bar has taken up */
static void sway(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 2e-4 * (1 - cos(200 * t));
    v[0] = 2e-4 * 200 * sin(200 * t);
}
static void held_sets_do_the_work_on_the_books(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++) {
            if (skipped(form, integrator))
                continue;
            sph_config c = solid_config(form, integrator, 2 * PLATE * DX, DX);
            sph_solid m = {.shear = MU};
            uint32_t set, held;
            double lo[SPH_DIM], hi[SPH_DIM];
            c.dt = 5e-5;
            c.books = true;
            for (int k = 0; k < SPH_DIM; k++)
                lo[k] = 0, hi[k] = PLATE * DX;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_solid(sim, &m, &set, NULL));
            m.held = (1u << SPH_DIM) - 1;
            m.motion = sway;
            must(sim, sph_add_solid(sim, &m, &held, NULL));
            must(sim, sph_add_box(sim, set, lo, hi, NULL));
            lo[0] = -0.3;
            hi[0] = 0;
            must(sim, sph_add_box(sim, held, lo, hi, NULL));
            double most = 0, skew = 0, kinetic = 0;
            for (int k = 0; k < 250; k++) {
                must(sim, sph_step(sim));
                most = fmax(most, fabs(balance_of(sim).now));
                skew = skew_of(integrator, kinetic, balance_of(sim).kinetic);
                kinetic = balance_of(sim).kinetic;
            }
            const balance b = balance_of(sim);
            print_message("%s, %s: energy %.4e, work %.4e, most %.4e\n", form_names[form], integrator_names[integrator],
                          b.now, b.wall, most);
            close_to(b.now, b.wall, 0.01 * most + 1.1 * skew);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* ---- artificial stress ---- */

#define TENSION 1e3 /* Pa */

/* accelerations that artificial stress adds to a body: that of a run with it less that of one without */
typedef struct pushes {
    double a[400][SPH_DIM], size;
} pushes;
static const pushes *pushed(const sph_config *config, const double (*x)[SPH_DIM], const tensor *sigma, uint32_t n,
                            pushes *o)
{
    memset(o, 0, sizeof *o);
    for (int with = 0; with < 2; with++) {
        sph_config c = *config;
        sph_solid m = {.shear = MU};
        uint32_t set;
        c.artificial_stress = with ? config->artificial_stress : SPH_NO_ARTIFICIAL_STRESS;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        for (uint32_t i = 0; i < n; i++) {
            double p = 0;
            tensor s = sigma[i];
            for (int k = 0; k < 3; k++)
                p -= s.v[k][k] / (SPH_DIM == 1 ? 3 : SPH_DIM); /* in 2-D sigma_zz is left to be mean of the others */
            for (int k = 0; k < 3; k++)
                s.v[k][k] += p;
            must(sim, sph_add_particle(sim, set, x[i], NULL, 0, NULL));
            set_stress(sim, i, s);
            sim->buf[sim->cur].rho[0][i] = (sph_real)(p / (RHO * c.sound_speed * c.sound_speed));
        }
        must(sim, sph_ready(sim));
        for (uint32_t i = 0; i < n; i++) {
            const sph_particle q = by_id(sim, i);
            for (int k = 0; k < SPH_DIM; k++) {
                o->a[i][k] += with ? q.a[k] : -q.a[k];
                o->size = fmax(o->size, fabs(q.a[k]));
            }
        }
        assert_int_equal(free_sims(NULL), 0);
    }
    return o;
}

/* the same by the formula, in double, of the tensile parts r (Pa) */
static void push_sums(const sph_config *c, const double (*x)[SPH_DIM], const tensor *sigma, const tensor *r, uint32_t n,
                      pushes *o)
{
    double at_dx, dw;
    memset(o, 0, sizeof *o);
    assert_int_equal(sph_kernel_value(c->kernel, c->spacing, c->smoothing_length, &at_dx, &dw), SPH_OK);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            double r2 = 0, w, rho[2];
            for (int k = 0; k < SPH_DIM; k++)
                r2 += (x[i][k] - x[j][k]) * (x[i][k] - x[j][k]);
            if (i == j)
                continue;
            assert_int_equal(sph_kernel_value(c->kernel, sqrt(r2), c->smoothing_length, &w, &dw), SPH_OK);
            for (int e = 0; e < 2; e++) {
                const double p = -trace_of(sigma[e ? j : i]) / (SPH_DIM == 1 ? 3 : SPH_DIM);
                rho[e] = RHO * (1 + p / (RHO * c->sound_speed * c->sound_speed));
            }
            const double f = pow(w / at_dx, c->stress_exponent) * c->stress_epsilon * dw / sqrt(r2) * RHO * pow(DX,
                SPH_DIM);
            const double wi = c->scheme == SPH_WEAK ? 1 / (rho[0] * rho[1]) : 1 / (rho[0] * rho[0]);
            const double wj = c->scheme == SPH_WEAK ? wi : 1 / (rho[1] * rho[1]);
            for (int k = 0; k < SPH_DIM; k++)
                for (int l = 0; l < SPH_DIM; l++)
                    o->a[i][k] -= f * (r[i].v[k][l] * wi + r[j].v[k][l] * wj) * (x[i][l] - x[j][l]);
        }
}

static sph_config push_config(uint32_t repel)
{
    sph_config c = solid_config(SPH_UPDATED, SPH_KICK_DRIFT_KICK, 2, DX);
    c.artificial_stress = repel;
    c.stress_epsilon = 0.3;
    c.stress_exponent = 4;
    return c;
}

static tensor toss_rotation(void)
{
    const tensor one = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (SPH_DIM == 1)
        return one;
    return SPH_DIM == 2 ? rotation(3 * toss(), 0, 0, 1) : rotation(3 * toss(), toss(), toss(), 1.1);
}

/* Per particle a stress of its own, made of principal stresses and a rotation; the first of the kinds are the same for
   all: hydrostatic tension, uniaxial tension, hydrostatic compression. */
enum { HYDROSTATIC, UNIAXIAL, COMPRESSION, ANY, KINDS };
static uint32_t stressed(uint32_t kind, uint32_t repel, double (*x)[SPH_DIM], tensor *sigma, tensor *r)
{
    const uint32_t edge = SPH_DIM == 1 ? 12 : SPH_DIM == 2 ? 6 : 4,
        n = SPH_DIM == 1 ? edge : SPH_DIM == 2 ? edge * edge : edge * edge * edge;
    sph_rng_seed(&dice, 20, kind);
    tensor turn = toss_rotation();
    for (uint32_t i = 0; i < n; i++) {
        tensor principal = {{{0}}}, tensile = {{{0}}};
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= edge) {
            x[i][k] = (at % edge + 0.2 * toss()) * DX;
            const double any = kind == ANY ? TENSION * toss() : 0;
            const double same = kind == COMPRESSION ? -TENSION : kind == HYDROSTATIC || k == 0 ? TENSION : 0;
            const double s = kind == ANY ? any : same;
            principal.v[k][k] = s;
            tensile.v[k][k] = s > 0 ? s : 0;
        }
        if (kind == ANY)
            turn = toss_rotation();
        const bool round = kind == HYDROSTATIC || kind == COMPRESSION; /* any axes are principal ones */
        sigma[i] = round ? principal : conjugate(turn, principal);
        r[i] = round ? tensile : conjugate(turn, tensile);
        for (int k = 0; k < 9 && repel == SPH_COMPONENTS; k++)
            r[i].v[k / 3][k % 3] = sigma[i].v[k / 3][k % 3] > 0 ? sigma[i].v[k / 3][k % 3] : 0;
    }
    return n;
}

/* positions are rounded to a part in 1e14 (float: 1e7) of a spacing, which the eighth power multiplies by some
   twenty */
static void artificial_stress_is_its_formula(void **state)
{
    static double x[400][SPH_DIM];
    static tensor sigma[400], r[400];
    static pushes got, want;
    (void)state;
    for (uint32_t repel = SPH_PRINCIPAL; repel <= SPH_COMPONENTS; repel++)
        for (uint32_t kind = 0; kind < KINDS; kind++)
            for (uint32_t exponent = 1; exponent <= 8; exponent += kind == ANY ? 1 : 3) {
                sph_config c = push_config(repel);
                c.stress_exponent = exponent;
                c.scheme = exponent & 1 ? SPH_WEAK : SPH_STANDARD;
                const uint32_t n = stressed(kind, repel, x, sigma, r);
                double most = 0;
                pushed(&c, (const double(*)[SPH_DIM])x, sigma, n, &got);
                push_sums(&c, (const double(*)[SPH_DIM])x, sigma, r, n, &want);
                for (uint32_t i = 0; i < n; i++)
                    for (int k = 0; k < SPH_DIM; k++) {
                        close_to(got.a[i][k], want.a[i][k], 4096 * EPS * got.size);
                        most = fmax(most, fabs(want.a[i][k]));
                        if (kind == COMPRESSION)
                            assert_true(got.a[i][k] == 0);
                    }
                assert_true((most > 0.01 * got.size) == (kind != COMPRESSION));
            }
}

#if SPH_DIM > 1
/* lattice and stress turned together: PRINCIPAL pushes turn with them, COMPONENTS do not */
static void principal_axes_do_not_depend_on_the_frame(void **state)
{
    static double x[400][SPH_DIM], y[400][SPH_DIM];
    static tensor sigma[400], turned_sigma[400], r[400];
    static pushes a, b;
    const tensor turn = SPH_DIM == 2 ? rotation(PI / 4, 0, 0, 1) : rotation(0.8, 1, -2, 3);
    const tensor s = {{{1.0 * TENSION, 0, 0}, {0, -0.4 * TENSION, 0}, {0, 0, SPH_DIM == 3 ? 0.3 * TENSION : 0}}};
    (void)state;
    for (uint32_t repel = SPH_PRINCIPAL; repel <= SPH_COMPONENTS; repel++) {
        const sph_config c = push_config(repel);
        const uint32_t n = stressed(ANY, repel, x, sigma, r);
        double off = 0, size = 0;
        for (uint32_t i = 0; i < n; i++) {
            sigma[i] = s;
            turned_sigma[i] = conjugate(turn, s);
            for (int k = 0; k < SPH_DIM; k++) {
                y[i][k] = 0;
                for (int l = 0; l < SPH_DIM; l++)
                    y[i][k] += turn.v[k][l] * x[i][l];
            }
        }
        pushed(&c, (const double(*)[SPH_DIM])x, sigma, n, &a);
        pushed(&c, (const double(*)[SPH_DIM])y, turned_sigma, n, &b);
        for (uint32_t i = 0; i < n; i++)
            for (int k = 0; k < SPH_DIM; k++) {
                double back = 0;
                for (int l = 0; l < SPH_DIM; l++)
                    back += turn.v[l][k] * b.a[i][l];
                off = fmax(off, fabs(back - a.a[i][k]));
                size = fmax(size, fabs(a.a[i][k]));
            }
        print_message("%s: turned pushes differ by %.2g of the largest\n",
                      repel == SPH_PRINCIPAL ? "principal" : "components", off / size);
        assert_true(repel == SPH_PRINCIPAL ? off < 1024 * EPS * a.size : off > 0.05 * size);
    }
}

/* near equal principal stresses and near no stress nothing jumps */
static void equal_and_vanishing_stresses_are_smooth(void **state)
{
    static double x[400][SPH_DIM];
    static tensor sigma[400], r[400];
    static pushes a, b;
    const sph_config c = push_config(SPH_PRINCIPAL);
    const uint32_t n = stressed(ANY, SPH_PRINCIPAL, x, sigma, r);
    (void)state;
    for (int zero = 0; zero < 2; zero++)
        for (int step = 0; step < 10; step++) {
            const double d = step == 0 ? 0 : TENSION * pow(10, 1 - 3 * step);
            const tensor turn = rotation(0.4, SPH_DIM == 2 ? 0 : 1, 0, 1);
            double off = 0;
            for (uint32_t i = 0; i < n; i++) {
                tensor s = {{{0}}};
                for (int k = 0; k < SPH_DIM; k++)
                    s.v[k][k] = (zero ? 0 : TENSION) + (k == 0 ? d : -0.5 * d);
                sigma[i] = conjugate(turn, s);
            }
            pushed(&c, (const double(*)[SPH_DIM])x, sigma, n, step ? &b : &a);
            for (uint32_t i = 0; i < n; i++)
                for (int k = 0; k < SPH_DIM && step; k++) {
                    assert_true(isfinite(b.a[i][k]));
                    off = fmax(off, fabs(b.a[i][k] - a.a[i][k]));
                }
            /* accelerations are stresses over RHO DX, times sums of order 1 */
            assert_true(off <= 10 * d / (RHO * DX) + 256 * EPS * a.size);
            if (zero && step == 0)
                assert_true(a.size == 0);
        }
}
#endif

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(forces_cancel),
#if SPH_DIM > 1
        subject(torques_cancel_where_gradients_are_corrected),
#endif
        subject(a_mirror_face_is_the_other_half),
        subject(a_no_slip_face_carries_shear),
#if SPH_DIM > 1
        subject(a_sheared_block_hangs_on_a_no_slip_face),
#endif
        subject(too_few_neighbours_take_the_plain_gradient),
        subject(a_free_block_keeps_its_energy),
        subject(viscosity_and_yield_take_what_the_books_say),
        subject(held_sets_do_the_work_on_the_books),
        subject(artificial_stress_is_its_formula),
#if SPH_DIM > 1
        subject(principal_axes_do_not_depend_on_the_frame),
        subject(equal_and_vanishing_stresses_are_smooth),
#endif
    };
    return run_subjects("solid_forces", list);
}
