/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_drift.c: how far the balance of energy (sph_totals) is off at the end of a run: beside a piston of every kind of
   wall, and of solids that collide without viscosity. A table of both is printed. */
#include "testing.h"

enum { MOST = 4000 };
#define DX 0.01

/* ---- a piston ---- */

typedef struct wall_row {
    const char *name;
    uint32_t kind;
    bool compressible, no_slip;
} wall_row;

/* goes with 1 m/s in the end, having got there in 0.01 s */
static void start_smoothly(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    const double s = t < 0.01 ? t / 0.01 : 1, late = t < 0.01 ? 0 : t - 0.01;
    x[0] = 0.01 * s * s * s * (1 - 0.5 * s) + late;
    v[0] = s * s * (3 - 2 * s);
}

static sph_sim *piston(const wall_row *w, uint32_t integrator)
{
    sph_config c = open_config(1, DX);
    sph_wall wall = sph_wall_default();
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t set;
    for (int k = 0; k < SPH_DIM; k++)
        c.lo[k] = -0.2, c.hi[k] = 1, lo[k] = 0, hi[k] = k ? 12 * DX : 30 * DX;
    c.integrator = integrator;
    c.viscosity = SPH_MORRIS;
    c.nu = 1e-3;
    c.eos = SPH_LINEAR;
    c.smoothing_length = 1.5 * DX;
    c.books = true;
    c.on_cross = SPH_IGNORE;
    c.max_particles = MOST;
    wall.kind = w->kind;
    wall.compressible = w->compressible;
    wall.no_slip = w->no_slip;
    wall.motion = start_smoothly;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    lo[0] = w->kind < SPH_WALL_GHOST ? 0.5 * DX : 0; /* forces begin a spacing off their row */
    must(sim, sph_add_box(sim, set, lo, hi, NULL));
    lo[0] = 0;
    for (int k = 1; k < SPH_DIM; k++)
        lo[k] -= 4 * DX, hi[k] += 4 * DX;
    must(sim, sph_add_wall_box(sim, &wall, lo, hi, SPH_LOW(0), true, NULL));
    return sim;
}

/* drift over the work of the piston */
static double drift_of_piston(const wall_row *w, uint32_t integrator)
{
    sph_sim *sim = piston(w, integrator);
    sph_totals a, b;
    must(sim, sph_ready(sim));
    sph_get_totals(sim, &a);
    while (sph_time(sim) < 0.04)
        must(sim, sph_step_to(sim, 0.04));
    sph_get_totals(sim, &b);
    const double drift = (b.balance - a.balance) / fabs(b.wall_work);
    print_message("%-24s integrator %u: work %8.4g J, drift %9.2e of it\n", w->name, integrator, b.wall_work, drift);
    assert_true(fabs(b.wall_work) > 1);
    assert_int_equal(free_sims(NULL), 0);
    return fabs(drift);
}

static void the_books_of_a_piston_close(void **state)
{
    static const wall_row row[] = {
        {"Lennard-Jones", SPH_WALL_LENNARD_JONES, false, false},
        {"kernel force", SPH_WALL_KERNEL_FORCE, false, false},
        {"Monaghan-Kos", SPH_WALL_MONAGHAN_KOS, false, false},
        {"ghosts, held", SPH_WALL_GHOST, false, true},
        {"ghosts, compressible", SPH_WALL_GHOST, true, true},
        {"ghosts, free slip", SPH_WALL_GHOST, true, false},
        {"Adami", SPH_WALL_ADAMI, false, false},
        {"Adami, no slip", SPH_WALL_ADAMI, false, true},
    };
    uint32_t bad = 0;
    (void)state;
    for (size_t k = 0; k < sizeof row / sizeof *row; k++)
        for (uint32_t i = 0; i < SPH_RUNGE_KUTTA_MOMENTUM; i++)
            bad += drift_of_piston(&row[k], i) <= 0.01 ? 0 : 1;
    assert_int_equal(bad, 0);
}

/* ---- solids ---- */

#if SPH_DIM > 1
static double free_step; /* a fixed step instead of the controlled one, by h/c, c 23.7 m/s */
static double drift_of_collision(uint32_t form, uint32_t integrator, double share)
{
    sph_config c = open_config(1, DX);
    const sph_solid rubber = {.sound_speed = 20, .shear = 0.3 * 1000 * 400};
    const double fast[3] = {0.8, 0, 0}, slow[3] = {-0.8, 0, 0};
    sph_totals a, b;
    uint32_t set[2];
    c.lo[0] = c.lo[1] = -0.5;
    c.smoothing_length = 1.3 * DX;
    c.solid = form;
    c.integrator = integrator;
    c.viscosity = SPH_INVISCID;
    c.books = true;
    c.cfl *= share;
    c.dt = free_step * share * c.smoothing_length / 23.7;
    c.max_particles = MOST;
    c.max_stretch = form == SPH_TOTAL ? 1.5 : c.max_stretch;
    sph_sim *sim = new_sim(&c);
    for (int k = 0; k < 2; k++) {
        double lo[SPH_DIM], hi[SPH_DIM];
        for (int l = 0; l < SPH_DIM; l++)
            lo[l] = 0, hi[l] = 8 * DX;
        lo[0] += k ? 9.2 * DX : 0, hi[0] += k ? 9.2 * DX : 0;
        must(sim, sph_add_solid(sim, &rubber, &set[k], NULL));
        must(sim, sph_add_box(sim, set[k], lo, hi, k ? slow : fast));
    }
    must(sim, sph_ready(sim));
    sph_get_totals(sim, &a);
    while (sph_time(sim) < 0.03)
        must(sim, sph_step_to(sim, 0.03));
    sph_get_totals(sim, &b);
    const double drift = (b.balance - a.balance) / a.kinetic;
    print_message("form %u, integrator %u: kinetic %.4g to %.4g J, drift %9.2e\n", form, integrator, a.kinetic,
                  b.kinetic, drift);
    assert_int_equal(free_sims(NULL), 0);
    return fabs(drift);
}

static void solids_collide_and_keep_their_energy(void **state)
{
    uint32_t bad = 0;
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (uint32_t i = SPH_PREDICTOR_CORRECTOR; i < SPH_RUNGE_KUTTA_MOMENTUM; i++)
            bad += drift_of_collision(form, i, 1) <= 1e-3 ? 0 : 1;
    assert_int_equal(bad, 0);
}

/* Runge-Kutta's rule of the middle multiplies an oscillation w by 1 + (w dt)^4/8 a step, and nothing here takes that
   away: the drift of a run goes as the third power of the step. The step control keeps it small (sph/factors.c). */
static void without_viscosity_runge_kutta_gains_by_its_own_rule(void **state)
{
    (void)state;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++) {
        free_step = 0.25;
        const double whole = drift_of_collision(form, SPH_RUNGE_KUTTA, 1);
        assert_true(drift_of_collision(form, SPH_RUNGE_KUTTA, 0.5) < whole / 4);
        free_step = 0;
    }
}
#endif

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(the_books_of_a_piston_close),
#if SPH_DIM > 1
        subject(solids_collide_and_keep_their_energy),
        subject(without_viscosity_runge_kutta_gains_by_its_own_rule),
#endif
    };
    return run_subjects("drift", list);
}
