/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_contact.c: two bodies of the total-Lagrangian form. Blocks that touch and draw apart feel nothing; blocks that
   collide rebound with their momentum and nearly all their energy, and keep apart. */
#include "testing.h"

enum { ACROSS = 6 };
static const double dx = 0.1;

/* two blocks that touch at x = 0, each at `speed` towards the other */
static sph_sim *blocks(double speed, double duration)
{
    sph_config c = sph_config_default();
    c.spacing = dx;
    c.smoothing_length = 1.5 * dx;
    c.rho0 = c.sound_speed = 1;
    c.eos = SPH_LINEAR;
    c.solid = SPH_TOTAL;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.alpha = 0;
    c.cfl = 0.2;
    c.max_particles = 2 * (SPH_DIM == 1 ? ACROSS : SPH_DIM == 2 ? ACROSS * ACROSS : ACROSS * ACROSS * ACROSS);
    for (int k = 0; k < SPH_DIM; k++) {
        c.hi[k] = 2 * ACROSS * dx + (k == 0 ? fabs(speed) * duration : 0);
        c.lo[k] = -c.hi[k];
    }
    sph_sim *sim = new_sim(&c);
    for (int side = 0; side < 2; side++) {
        sph_solid m = {0};
        double lo[SPH_DIM], hi[SPH_DIM], v[SPH_DIM] = {0};
        uint32_t set;
        m.shear = 0.3;
        m.body = (uint32_t)side;
        for (int k = 0; k < SPH_DIM; k++) {
            lo[k] = -0.5 * ACROSS * dx;
            hi[k] = 0.5 * ACROSS * dx;
        }
        lo[0] = side ? 0 : -ACROSS * dx;
        hi[0] = lo[0] + ACROSS * dx;
        v[0] = side ? -speed : speed;
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        must(sim, sph_add_box(sim, set, lo, hi, v));
    }
    return sim;
}

static double energy(const sph_sim *sim)
{
    sph_totals o;
    sph_get_totals(sim, &o);
    return o.kinetic + o.internal + o.elastic;
}

/* mean speed of the left block, and the free space between the two in spacings */
static double left_block(const sph_sim *sim, double *gap)
{
    double sum = 0, left = -1e9, right = 1e9;
    uint32_t n = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        const sph_particle p = by_id(sim, i);
        if (p.set == 0) {
            sum += p.v[0];
            left = p.x[0] > left ? p.x[0] : left;
            n++;
        } else {
            right = p.x[0] < right ? p.x[0] : right;
        }
    }
    *gap = (right - left) / dx;
    return sum / n;
}

static void no_adhesion(void **state)
{
    (void)state;
    sph_sim *sim = blocks(-0.01, 10);
    for (int k = 0; k < 200; k++)
        must(sim, sph_step(sim));
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        const sph_particle p = by_id(sim, i);
        const double moved = p.v[0] - (p.set ? 0.01 : -0.01);
        assert_true(fabs(moved) < 20 * EPS && p.stress[0] < 20 * EPS);
    }
    assert_int_equal(free_sims(NULL), 0);
}

static void rebound(void **state)
{
    const double speed = 0.02;
    double gap, least = 1;
    (void)state;
    sph_sim *sim = blocks(speed, 20);
    const double before = energy(sim);
    while (sph_time(sim) < 20) {
        must(sim, sph_step(sim));
        (void)left_block(sim, &gap);
        least = gap < least ? gap : least;
    }
    sph_totals o;
    sph_get_totals(sim, &o);
    assert_true(fabs(o.momentum[0]) < 1e4 * EPS * speed);
    assert_true(least > 0.7 && left_block(sim, &gap) < -0.7 * speed && gap > 2);
    assert_true(fabs(energy(sim) / before - 1) < 0.01);
    assert_int_equal(free_sims(NULL), 0);
}

int main(void)
{
    const struct CMUnitTest list[] = {subject(no_adhesion), subject(rebound)};
    return run_subjects("contact", list);
}
