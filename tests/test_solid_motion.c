/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_solid_motion.c: solids that move: held sets against their motion, standing waves, the total-Lagrangian form
   turned, stretched, torn and in contact, and rock beside a gas. */
#include "bodies.h"

#define DX 0.1
#define MU 4e5 /* Pa */
#define PI 3.14159265358979323846

/* ---- held sets ---- */

static const double table_t[] = {0, 0.004, 0.01, 0.02}, table_x[] = {0, 0.03, -0.02, 0.05};
static const sph_steady steady[] = {{{0}, {0}},
#if SPH_DIM == 1
                                    {{2}, {0}}, {{-1}, {300}}
#elif SPH_DIM == 2
                                    {{2, -1}, {0, 0}}, {{-1, 0.5}, {300, 80}}
#else
                                    {{2, -1, 0.3}, {0, 0, 0}}, {{-1, 0.5, 0}, {300, 80, -50}}
#endif
};
static const sph_table table = {4, 0, table_t, table_x};
enum { REST, SPEED, SPEEDING_UP, TABLE, MOTIONS };

static void motion_of(uint32_t motion, double t, double *x, double *v)
{
    if (motion == TABLE)
        sph_motion_table((void *)(uintptr_t)&table, t, x, v);
    else
        sph_motion_steady((void *)(uintptr_t)&steady[motion], t, x, v);
}

/* a small block, stressless, in gravity */
static sph_sim *held_block(uint32_t form, uint32_t integrator, uint32_t motion, uint32_t axes, uint32_t *group)
{
    sph_config c = solid_config(form, integrator, 0.5, DX);
    sph_solid m = {.shear = MU, .held = axes};
    uint32_t set;
    c.dt = 1e-4;
    c.gravity[SPH_DIM - 1] = -10;
    m.motion = motion == REST ? NULL : motion == TABLE ? sph_motion_table : sph_motion_steady;
    m.motion_ctx = motion == REST ? NULL : motion == TABLE ? (void *)(uintptr_t)&table :
        (void *)(uintptr_t)&steady[motion];
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &set, group));
    add_block(sim, set, 3, DX, 0);
    return sim;
}

/* along the axes that are held: where the motion says, to one quantum, and with its velocity; along the others: free
   fall */
static void held_sets_go_where_they_are_told(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form += SPH_DIM == 3 ? 2 : 1)
        for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++)
            for (uint32_t motion = 0; motion < MOTIONS; motion++)
                for (int all = 0; all < (SPH_DIM > 1 ? 2 : 1); all++) {
                    const uint32_t axes = all || SPH_DIM == 1 ? (1u << SPH_DIM) - 1 : 1;
                    sph_sim *sim = held_block(form, integrator, motion, axes, NULL);
                    const sph_particle a = by_id(sim, 2);
                    for (int k = 0; k < 150; k++)
                        must(sim, sph_step(sim));
                    double t = sph_time(sim), x[SPH_DIM] = {0}, v[SPH_DIM] = {0};
                    const sph_particle b = by_id(sim, 2);
                    motion_of(motion, t, x, v);
                    for (int k = 0; k < SPH_DIM; k++) {
                        const bool free_fall = !(axes >> k & 1) && k == SPH_DIM - 1;
                        if (axes >> k & 1) {
                            close_to(b.x[k] - a.x[k], x[k], sim->grid.quantum);
                            close_to(b.v[k], v[k], EPS * fabs(v[k]));
                            assert_true(b.a[k] == 0);
                        } else if (motion == REST) { /* forces of a stressless body are gravity alone */
                            /* its velocity is that of half a step later */
                            const double ahead = integrator == SPH_LEAP_FROG ? 0.5e-4 : 0;
                            close_to(b.v[k], free_fall ? -10 * (t + ahead) : 0, 150 * EPS);
                            close_to(b.x[k] - a.x[k], free_fall ? -5 * t * t : 0,
                                     150 * (sim->grid.quantum + EPS * 2e-5));
                        }
                    }
                    assert_int_equal(free_sims(NULL), 0);
                }
}

/* let go, a body goes on as it went and falls; its group is gone */
static void a_held_set_can_be_let_go(void **state)
{
    (void)state;
    for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++)
        for (int at = 0; at < 2; at++) {
            uint32_t group = 99;
            sph_sim *sim = held_block(SPH_CORRECTED, integrator, SPEED, (1u << SPH_DIM) - 1, &group);
            assert_int_equal(group, 0);
            for (int k = 0; k < 50; k++)
                must(sim, sph_step(sim));
            must(sim, at ? sph_remove_wall_at(sim, group, 0.007 - 1e-9) : sph_remove_wall(sim, group));
            const double go = at ? 0.007 : sph_time(sim);
            for (int k = 0; k < 50; k++)
                must(sim, sph_step(sim));
            const sph_particle p = by_id(sim, 1);
            for (int k = 0; k < SPH_DIM; k++) {
                const double fall = k == SPH_DIM - 1 ? -10 * (sph_time(sim) - go) : 0;
                /* which of the steps about the time of going is the first that falls: an integrator's own affair */
                close_to(p.v[k], steady[SPEED].v[k] + fall, 10 * 1.01e-4 + 100 * EPS);
            }
            assert_int_equal(sph_remove_wall(sim, group + 1), SPH_BAD_ARGUMENT);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* ---- standing waves ---- */

/* speed of a standing wave of n spacings in a periodic box, from the time at which its velocity first vanishes, over
   what it should be */
typedef struct wave {
    double k, size;
    int axis;
} wave;
static void wave_field(void *ctx, const double *x, double *v, double *rho)
{
    const wave *w = ctx;
    (void)rho;
    v[w->axis] = w->size * sin(w->k * x[0]);
}
static double amplitude(const sph_sim *sim, const wave *w)
{
    double a = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        must(sim, sph_get(sim, i, &p));
        a += p.v[w->axis] * sin(w->k * p.x[0]);
    }
    return a / sph_count(sim);
}
static double wave_speed(uint32_t form, uint32_t n, bool shear)
{
    const double c = shear ? sqrt(MU / RHO) : sqrt(400 + 4 * MU / (3 * RHO)), length = n * DX;
    sph_config cfg = solid_config(form, SPH_KICK_DRIFT_KICK, 1, DX);
    sph_solid m = {.shear = MU};
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = cfg.lo[k] = 0;
        hi[k] = cfg.hi[k] = k == 0 ? length : 8 * DX;
        cfg.face[k][0] = cfg.face[k][1] = SPH_PERIODIC;
    }
    cfg.max_particles = n * 64;
    cfg.max_stretch = 1;
    cfg.dt = 0.25 * cfg.smoothing_length / sqrt(400 + 4 * MU / (3 * RHO));
    wave w = {2 * PI / length, 1e-4 * c, shear ? 1 : 0};
    sph_sim *sim = new_sim(&cfg);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    must(sim, sph_apply_field(sim, set, wave_field, &w));
    double before = amplitude(sim, &w), after = before;
    while (after > 0) {
        before = after;
        must(sim, sph_step(sim));
        after = amplitude(sim, &w);
    }
    const double quarter = sph_time(sim) - cfg.dt * after / (after - before);
    assert_int_equal(free_sims(NULL), 0);
    return length / (4 * quarter) / c;
}

/* Corrected forms: within 0.5 % at 64 spacings a wave (3-D: 48), and the error falls with resolution. The plain one on
   a lattice is off by the sum over its kernel (test_solid.c: up to 2 %), whatever the resolution; measured against that
   it does the same. */
static double lattice_sum(void)
{
    double s = 0;
    for (int i = -4; i <= 4; i++)
        for (int j = SPH_DIM > 1 ? -4 : 0; j <= (SPH_DIM > 1 ? 4 : 0); j++)
            for (int k = SPH_DIM > 2 ? -4 : 0; k <= (SPH_DIM > 2 ? 4 : 0); k++) {
                double w, dw, r = DX * sqrt((double)(i * i + j * j + k * k));
                assert_int_equal(sph_kernel_value(SPH_CUBIC, r, 1.2 * DX, &w, &dw), SPH_OK);
                s -= r > 0 ? i * i * DX * DX * dw / r : 0;
            }
    return s * pow(DX, SPH_DIM);
}
static void waves_have_their_speed(void **state)
{
    const uint32_t first = SPH_DIM == 3 ? SPH_CORRECTED : SPH_UPDATED, last = SPH_DIM == 3 ? SPH_CORRECTED : SPH_TOTAL;
    (void)state;
    for (uint32_t form = first; form <= last; form++)
        for (int shear = 0; shear < (SPH_DIM > 1 ? 2 : 1); shear++) {
            if (SPH_DIM == 3 && shear != SPH_DOUBLE) /* it takes long: one kind in each precision */
                continue;
            const double plain = form == SPH_UPDATED ? lattice_sum() : 1;
            const uint32_t n = SPH_DIM == 3 ? 24 : 32;
            const double coarse = wave_speed(form, n, shear) / plain - 1, fine = wave_speed(form, 2 * n,
                shear) / plain - 1;
            print_message("%s, %s wave: speed off by %.3f %% at %u spacings, by %.3f %% at twice as many\n",
                          form_names[form],
                          shear ? "shear" : "longitudinal", 100 * coarse, n, 100 * fine);
            assert_true(fabs(fine) < 0.005 && fabs(fine) < 0.35 * fabs(coarse));
        }
}

/* ---- the total-Lagrangian form ---- */

#if SPH_DIM > 1
/* a body turned by up to 170 degrees and stretched, as if it had come there: rates of a linear field are exact */
static void a_turned_body_has_exact_gradients(void **state)
{
    (void)state;
    for (int turn = 0; turn < 5; turn++) {
        sph_config c = solid_config(SPH_TOTAL, SPH_KICK_DRIFT_KICK, 2, DX);
        sph_solid m = {.shear = MU};
        uint32_t set;
        tensor stretch = {{{1.2, 0.1, 0}, {0, 0.9, 0}, {0, 0, 1.1}}};
        sph_rng_seed(&dice, 40, 1);
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        add_block(sim, set, SPH_DIM == 2 ? 8 : 5, DX, 0.2);
        const tensor f = times(rotation(turn * 17 * PI / 72, 0.3 * (SPH_DIM == 3), 0, 1),
                               stretch), spin = toss_tensor(2);
        tensor l = spin;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            const sph_particle p = by_id(sim, i);
            for (int k = 0; k < SPH_DIM; k++) {
                double x = 0;
                for (int n = 0; n < SPH_DIM; n++)
                    x += f.v[k][n] * p.x[n];
                const sph_pos go = (sph_pos)((x - p.x[k]) / sim->grid.quantum);
                sim->buf[sim->cur].pos[k][i] += go;
                sim->buf[sim->cur].shift[k][i] = go;
            }
            set_stress(sim, i, toss_deviator(0.1 * MU));
        }
        must(sim, sph_apply_field(sim, set, linear_velocity, &l));
        must(sim, sph_ready(sim));
        double worst = 0;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            worst = fmax(worst, off_by(kept_rate(sim, i), jaumann(l, kept_stress(sim, i),
                                                                  MU)) / (2 * MU * sqrt(square_of(l))));
            worst = fmax(worst, fabs((double)sim->buf[sim->cur].drho[0][i] + trace_of(l)) / sqrt(square_of(l)));
        }
        close_to(worst, 0, 256 * EPS);
        /* a turn without strain gives no rate of strain */
        l = plus(spin, -1, turned(spin));
        must(sim, sph_apply_field(sim, set, linear_velocity, &l));
        must(sim, sph_ready(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++)
            close_to((double)sim->buf[sim->cur].drho[0][i], 0, 256 * EPS * sqrt(square_of(l)));
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* Under tension in a periodic box a small random kick grows with Gray's form, and not with this one. The second number
   is how much the kinetic energy has grown at most. */
static double growth_under_tension(uint32_t form)
{
    sph_config c = solid_config(form, SPH_KICK_DRIFT_KICK, 1, DX);
    sph_solid m = {.shear = 0.2 * MU};
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM], first = 0, most = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = c.lo[k] = 0;
        hi[k] = c.hi[k] = (SPH_DIM == 2 ? 12 : 8) * DX;
        c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
    }
    c.dt = 5e-4;
    c.max_stretch = 1;
    sph_sim *sim = new_sim(&c);
    sph_rng_seed(&dice, 41, 1);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    set_density(sim, -0.1);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        for (int k = 0; k < SPH_DIM; k++)
            sim->buf[sim->cur].vel[k][i] = (sph_real)(1e-3 * toss());
    for (int k = 0; k < (SPH_DIM == 2 ? 300 : 150); k++) {
        sph_totals t;
        sph_get_totals(sim, &t);
        first = k ? first : t.kinetic;
        most = fmax(most, t.kinetic);
        must(sim, sph_step(sim));
    }
    assert_int_equal(free_sims(NULL), 0);
    return most / first;
}
static void tension_is_stable(void **state)
{
    const double gray = growth_under_tension(SPH_UPDATED), total = growth_under_tension(SPH_TOTAL);
    (void)state;
    print_message("kinetic energy under tension grows to %.2g times with the updated form, %.3g with the total\n", gray,
                  total);
    assert_true(total < 1.5 && gray > 100);
}
#endif

/* two bodies run into each other: they part again, momentum is kept, no particle comes through */
static void bodies_in_contact_push_each_other_apart(void **state)
{
    sph_config c = solid_config(SPH_TOTAL, SPH_KICK_DRIFT_KICK, 2, DX);
    sph_solid m = {.shear = MU, .body = 1};
    uint32_t set[2];
    double lo[SPH_DIM], hi[SPH_DIM], v[SPH_DIM] = {0}, closest = 1;
    (void)state;
    c.dt = 5e-4;
    c.viscosity = SPH_ARTIFICIAL;
    c.alpha = 0.2;
    sph_sim *sim = new_sim(&c);
    for (int b = 0; b < 2; b++) {
        for (int k = 0; k < SPH_DIM; k++)
            lo[k] = 0, hi[k] = 0.4;
        lo[0] = b ? 0.4 : -0.4;
        hi[0] = lo[0] + 0.4;
        v[0] = b ? -1 : 1;
        m.body = (uint32_t)b;
        must(sim, sph_add_solid(sim, &m, &set[b], NULL));
        must(sim, sph_add_box(sim, set[b], lo, hi, v));
    }
    for (int n = 0; n < 700; n++) {
        double low = 9, high = -9;
        must(sim, sph_step(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle p;
            must(sim, sph_get(sim, i, &p));
            if (p.set == set[0])
                high = fmax(high, p.x[0]);
            else
                low = fmin(low, p.x[0]);
        }
        closest = fmin(closest, low - high);
    }
    sph_totals t;
    sph_get_totals(sim, &t);
    double apart = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        must(sim, sph_get(sim, i, &p));
        apart += p.set == set[1] ? p.v[0] : -p.v[0];
    }
    apart /= sph_count(sim);
    print_message("contact: closest %.3f spacings, part at %.3f of the speed at which they met\n", closest / DX, apart);
    assert_true(closest > 0.3 * DX && apart > 0.2);
    close_to(t.momentum[0], 0, 700 * 16 * EPS * t.mass);
}

static void pulling(void *ctx, const double *x, double *v, double *rho)
{
    const double *s = ctx;
    (void)rho;
    v[0] = x[0] > 0 ? *s : -*s;
}
/* a body torn apart, and one that goes further than its reference allows: told, and nothing is lost */
static void what_the_form_does_not_cover_is_told(void **state)
{
    (void)state;
    for (int far = 0; far < 2; far++) {
        sph_config c = solid_config(SPH_TOTAL, SPH_KICK_DRIFT_KICK, 2, DX);
        sph_solid m = {.shear = 1};
        uint32_t set, steps = 0;
        double speed = 5;
        c.dt = 1e-3;
        c.max_stretch = 1.5;
        c.sound_speed = 1;
        if (far) {
            c.face[0][0] = c.face[0][1] = SPH_PERIODIC;
            c.lo[0] = -1;
            c.hi[0] = 1;
        }
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        add_block(sim, set, 4, DX, 0);
        if (!far)
            must(sim, sph_apply_field(sim, set, pulling, &speed));
        else
            for (uint32_t i = 0; i < sph_count(sim); i++)
                sim->buf[sim->cur].vel[0][i] = 5;
        sph_status st;
        uint64_t before;
        do {
            before = sph_hash(sim);
            st = sph_step(sim);
        } while (st == SPH_OK && ++steps < 1000);
        assert_int_equal(st, far ? SPH_MOVED_TOO_FAR : SPH_BOND_TOO_LONG);
        assert_true(steps > 10 && sph_hash(sim) == before && sph_last(sim)->particle < sph_count(sim));
        const double limit = far ? 1 : 1.5 * 2 * 1.2 * DX;
        const double unit = far ? sim->grid.length[0] / sim->grid.ncell[0] : 1; /* cells, or m */
        print_message("%s: told after %u steps, at %.4g m\n", far ? "moved too far" : "bond too long", steps,
                      sph_last(sim)->value * unit);
        close_to(fabs(sph_last(sim)->value) * unit, limit, 1.1 * 2 * speed * c.dt);
        assert_string_equal(sph_last(sim)->pass, "correction");
        /* turned round, it goes on */
        if (!far) {
            speed = -5;
            must(sim, sph_apply_field(sim, set, pulling, &speed));
            for (int k = 0; k < 10; k++)
                must(sim, sph_step(sim));
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

#if SPH_DIM > 1
static double half_speed(const sph_sim *sim)
{
    double v = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        must(sim, sph_get(sim, i, &p));
        v += p.x[0] > 0 ? p.v[0] : -p.v[0];
    }
    return v / sph_count(sim);
}
/* The middle of a bar is broken. Pulled apart, nothing holds the halves (a whole bar has swung back by then); pushed
   together they meet and slow down; pulled again there is no tension either: broken bonds stay broken. */
static double pull_bar(bool broken, double *pushed, double *again)
{
    sph_config c = solid_config(SPH_TOTAL, SPH_KICK_DRIFT_KICK, 2, DX);
    sph_solid m = {.shear = MU};
    uint32_t set;
    double lo[SPH_DIM], hi[SPH_DIM], speed = 2;
    for (int k = 0; k < SPH_DIM; k++)
        lo[k] = k ? 0 : -0.8, hi[k] = k ? 0.4 : 0.8;
    c.damage = SPH_BENZ_ASPHAUG;
    c.max_flaws = 1;
    c.dt = 5e-4;
    c.viscosity = SPH_ARTIFICIAL;
    c.alpha = 0.2;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &m, &set, NULL));
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    for (uint32_t i = 0; i < sph_count(sim) && broken; i++)
        if (fabs(by_id(sim, i).x[0]) < 0.29) /* more than a support */
            sim->buf[sim->cur].damage[0][i] = 1;
    must(sim, sph_apply_field(sim, set, pulling, &speed));
    for (int k = 0; k < 100; k++)
        must(sim, sph_step(sim));
    const double pulled = half_speed(sim);
    if (broken) {
        speed = -2;
        must(sim, sph_apply_field(sim, set, pulling, &speed));
        for (int k = 0; k < 130; k++)
            must(sim, sph_step(sim));
        *pushed = half_speed(sim);
        speed = 2;
        must(sim, sph_apply_field(sim, set, pulling, &speed));
        for (int k = 0; k < 100; k++)
            must(sim, sph_step(sim));
        *again = half_speed(sim);
    }
    assert_int_equal(free_sims(NULL), 0);
    return pulled;
}
static void a_broken_bond_stays_broken(void **state)
{
    double pushed, again;
    (void)state;
    const double whole = pull_bar(false, NULL, NULL), broken = pull_bar(true, &pushed, &again);
    print_message("of 2 m/s, halves of a whole bar part at %.3f, of a broken one at %.3f; pushed %.3f, pulled again "
                  "%.3f\n",
                  whole, broken, pushed, again);
    assert_true(whole < 0.5 && broken > 0.9 * 2 && pushed > -0.9 * 2 && again > 0.9 * 2);
}
#endif

/* a block goes through the periodic face of its domain without a trace of stress */
static void a_body_passes_a_periodic_face(void **state)
{
    (void)state;
    for (uint32_t form = SPH_CORRECTED; form <= SPH_TOTAL; form++)
        for (uint32_t integrator = 0; integrator < SPH_INTEGRATORS; integrator++) {
            sph_config c = solid_config(form, integrator, 1, DX);
            sph_solid m = {.shear = MU};
            uint32_t set;
            c.lo[0] = -1;
            c.hi[0] = 1;
            c.face[0][0] = c.face[0][1] = SPH_PERIODIC;
            c.dt = 1e-3;
            c.max_stretch = 1;
            sph_sim *sim = new_sim(&c);
            must(sim, sph_add_solid(sim, &m, &set, NULL));
            double lo[SPH_DIM], hi[SPH_DIM], v[SPH_DIM] = {0}, worst = 0;
            for (int k = 0; k < SPH_DIM; k++)
                lo[k] = k ? 0 : 0.6, hi[k] = lo[k] + 0.3;
            v[0] = 4;
            must(sim, sph_add_box(sim, set, lo, hi, v));
            for (int k = 0; k < 150; k++)
                must(sim, sph_step(sim));
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                sph_particle p;
                must(sim, sph_get(sim, i, &p));
                assert_true(p.x[0] < 0);
                worst = fmax(worst, mises(stress_of(&p)) + fabs(p.p));
            }
            /* rounding of positions between neighbours, as strains */
            close_to(worst, 0, MU * 150 * 64 * (EPS + sim->grid.quantum / DX));
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* ---- rock beside a gas ---- */

/* A layer of gas and one of rock under the same pressure fill a periodic box: nothing moves but for the kernel's sum,
   and after a while, damped, the rock's face still carries the pressure of the gas. */
static void a_gas_presses_on_rock(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++) {
        sph_config c = solid_config(form, SPH_KICK_DRIFT_KICK, 1, DX);
        const double gas_rho = 800, gas_c = 8, p = gas_rho * gas_c * gas_c, d = p / (RHO * 400);
        sph_solid m = {.shear = MU, .mass = RHO * (1 + d) * pow(DX, SPH_DIM)};
        sph_fluid g = {.own_eos = true, .eos = SPH_ISOTHERMAL, .sound_speed = gas_c, .rho0 = gas_rho};
        uint32_t rock, gas;
        double lo[SPH_DIM], hi[SPH_DIM], face = 0, in_gas = 0;
        uint32_t nf = 0, ng = 0;
        for (int k = 0; k < SPH_DIM; k++) {
            lo[k] = c.lo[k] = 0;
            hi[k] = c.hi[k] = k ? 8 * DX : 24 * DX;
            c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
        }
        c.scheme = SPH_WEAK;
        c.smoothing_length = (SPH_DIM == 3 ? 1.3 : 1.2) * DX; /* M of the lattice is within 1 % of 1 (1-D: 2 %) */
        c.viscosity = SPH_ARTIFICIAL;
        c.alpha = 0.2;
        c.max_particles = 2000;
        c.max_stretch = 1;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &m, &rock, NULL));
        must(sim, sph_add_fluid(sim, &g, &gas));
        hi[0] = 12 * DX;
        must(sim, sph_add_box(sim, rock, lo, hi, NULL));
        lo[0] = 12 * DX;
        hi[0] = 24 * DX;
        must(sim, sph_add_box(sim, gas, lo, hi, NULL));
        for (uint32_t i = 0; i < sph_count(sim); i++)
            sim->buf[sim->cur].rho[0][i] = sim->buf[sim->cur].set[0][i] == rock ? (sph_real)d : 0;
        must(sim, sph_ready(sim));
        double most = 0;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle q;
            must(sim, sph_get(sim, i, &q));
            for (int k = 0; k < SPH_DIM; k++)
                most = fmax(most, fabs(q.a[k]) * gas_rho * DX / p);
        }
        /* equal volumes and equal pressures: no force with the plain form; M of a lattice is not quite 1 */
        assert_true(most < (form == SPH_UPDATED ? 1024 * EPS : 0.03));
        for (int k = 0; k < (SPH_DIM == 3 ? 40 : 300); k++)
            must(sim, sph_step(sim));
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            sph_particle q;
            must(sim, sph_get(sim, i, &q));
            const double from = fmin(fabs(q.x[0]), fabs(q.x[0] - 12 * DX));
            if (q.set == rock && from < DX) {
                face -= q.stress[0];
                nf++;
            } else if (q.set == gas) {
                in_gas += q.p;
                ng++;
            }
        }
        print_message("%s: force at the start %.2g p/dx; later the gas has %.4f p, the rock's face %.4f p\n",
                      form_names[form], most,
                      in_gas / ng / p, face / nf / p);
        close_to(face / nf, in_gas / ng, 0.02 * p);
        close_to(in_gas / ng, p, 0.02 * p);
        assert_int_equal(free_sims(NULL), 0);
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(held_sets_go_where_they_are_told),
        subject(a_held_set_can_be_let_go),
        subject(waves_have_their_speed),
#if SPH_DIM > 1
        subject(a_turned_body_has_exact_gradients),
        subject(tension_is_stable),
        subject(a_broken_bond_stays_broken),
#endif
        subject(bodies_in_contact_push_each_other_apart),
        subject(what_the_form_does_not_cover_is_told),
        subject(a_body_passes_a_periodic_face),
        subject(a_gas_presses_on_rock),
    };
    return run_subjects("solid_motion", list);
}
