/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bodies.h: what the tests of solids share: bodies of jittered or regular lattices, tensors of 3 by 3 in double,
   motions with a uniform velocity gradient, and a look at the arrays that sph.h does not show. */
#ifndef SPH_TEST_BODIES_H
#define SPH_TEST_BODIES_H

#include "testing.h"

#include "sph/internal.h"

typedef struct tensor {
    double v[3][3];
} tensor;

static UNUSED tensor times(tensor a, tensor b)
{
    tensor o;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            o.v[k][l] = 0;
            for (int m = 0; m < 3; m++)
                o.v[k][l] += a.v[k][m] * b.v[m][l];
        }
    return o;
}
static UNUSED tensor plus(tensor a, double f, tensor b) /* a + f b */
{
    for (int k = 0; k < 9; k++)
        a.v[k / 3][k % 3] += f * b.v[k / 3][k % 3];
    return a;
}
static UNUSED tensor turned(tensor a) /* transpose */
{
    tensor o;
    for (int k = 0; k < 9; k++)
        o.v[k % 3][k / 3] = a.v[k / 3][k % 3];
    return o;
}
static UNUSED double trace_of(tensor a) { return a.v[0][0] + a.v[1][1] + a.v[2][2]; }
static UNUSED double square_of(tensor a) /* a : a */
{
    double s = 0;
    for (int k = 0; k < 9; k++)
        s += a.v[k / 3][k % 3] * a.v[k / 3][k % 3];
    return s;
}
static UNUSED double off_by(tensor a, tensor b) { return sqrt(square_of(plus(a, -1, b))); }
/* what stays in the plane or on the line of this dimension */
static UNUSED tensor in_space(tensor a)
{
    for (int k = 0; k < 9; k++)
        if (k / 3 >= SPH_DIM || k % 3 >= SPH_DIM)
            a.v[k / 3][k % 3] = 0;
    return a;
}
static UNUSED tensor deviator(tensor a)
{
    const double m = trace_of(a) / 3;
    for (int k = 0; k < 3; k++)
        a.v[k][k] -= m;
    return a;
}
/* rotation by an angle about x, y, z: the axis is normalised */
static UNUSED tensor rotation(double angle, double x, double y, double z)
{
    const double n = sqrt(x * x + y * y + z * z), u[3] = {x / n, y / n, z / n}, c = cos(angle), s = sin(angle);
    tensor o;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            o.v[k][l] = (1 - c) * u[k] * u[l] + (k == l ? c : 0);
    for (int k = 0; k < 3; k++) {
        o.v[(k + 1) % 3][k] += s * u[(k + 2) % 3];
        o.v[k][(k + 1) % 3] -= s * u[(k + 2) % 3];
    }
    return o;
}
/* R a R^T */
static UNUSED tensor conjugate(tensor r, tensor a) { return times(times(r, a), turned(r)); }

/* dS/dt = 2 mu (e - tr e/3) + W S - S W */
static UNUSED tensor jaumann(tensor l, tensor s, double mu)
{
    tensor e = l, w = l;
    for (int k = 0; k < 9; k++) {
        const double a = l.v[k / 3][k % 3], b = l.v[k % 3][k / 3];
        e.v[k / 3][k % 3] = 0.5 * (a + b);
        w.v[k / 3][k % 3] = 0.5 * (a - b);
    }
    return plus(plus(times(w, s), -1, times(s, w)), 2 * mu, deviator(e));
}

/* numbers from -1 to 1, a tensor of them, and a deviator such as this dimension can have */
static sph_rng dice;
static UNUSED double toss(void) { return 2 * sph_rng_uniform(&dice) - 1; }
static UNUSED tensor toss_tensor(double size)
{
    tensor o;
    for (int k = 0; k < 9; k++)
        o.v[k / 3][k % 3] = size * toss();
    return in_space(o);
}
static UNUSED tensor toss_deviator(double size)
{
    tensor o = toss_tensor(size);
    o = plus(o, 1, turned(o));
    if (SPH_DIM == 1)
        o.v[1][1] = o.v[2][2] = -0.5 * o.v[0][0];
    else if (SPH_DIM == 2)
        o.v[2][2] = -(o.v[0][0] + o.v[1][1]);
    else
        o = deviator(o);
    return o;
}

/* ---- arrays ---- */

/* places of the kept components */
static const int kept_row[5] = {0, SPH_DIM > 1 ? 1 : 0, 0, 0, 1}, kept_col[5] = {0, 1, 1, 2, 2};
static UNUSED tensor whole_deviator(const sph_real *const *s, uint32_t i)
{
    tensor o = {{{0}}};
    for (int k = 0; k < SPH_NS; k++)
        o.v[kept_row[k]][kept_col[k]] = o.v[kept_col[k]][kept_row[k]] = (double)s[k][i];
    if (SPH_DIM == 1)
        o.v[1][1] = o.v[2][2] = -0.5 * o.v[0][0];
    else
        o.v[2][2] = -(o.v[0][0] + o.v[1][1]);
    return o;
}
static UNUSED tensor kept_stress(const sph_sim *sim, uint32_t i)
{
    return whole_deviator((const sph_real *const *)sim->buf[sim->cur].stress, i);
}
static UNUSED tensor kept_rate(const sph_sim *sim, uint32_t i)
{
    return whole_deviator((const sph_real *const *)sim->buf[sim->cur].dstress, i);
}
/* before the first forces only: they are made of it */
static UNUSED void set_stress(sph_sim *sim, uint32_t i, tensor s)
{
    for (int k = 0; k < SPH_NS; k++)
        sim->buf[sim->cur].stress[k][i] = (sph_real)s.v[kept_row[k]][kept_col[k]];
    sim->now.primed = false;
}
static UNUSED void set_all_stress(sph_sim *sim, tensor s)
{
    for (uint32_t i = 0; i < sim->now.count; i++)
        set_stress(sim, i, s);
}
static UNUSED void set_density(sph_sim *sim, double relative_excess)
{
    for (uint32_t i = 0; i < sim->now.count; i++)
        sim->buf[sim->cur].rho[0][i] = (sph_real)relative_excess;
    sim->now.primed = false;
}
static UNUSED tensor stress_of(const sph_particle *p)
{
    const double *s = p->stress;
    const tensor o = {{{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}}};
    return o;
}
/* sqrt(3 J2) */
static UNUSED double mises(tensor sigma) { return sqrt(1.5 * square_of(deviator(sigma))); }

/* ---- bodies ---- */

#define RHO 1000.0
/* materials so soft that what accelerates them is the driving alone */
#define SOFT_SPEED 1e-9
#define SOFT_MU 1e-15

static UNUSED sph_config solid_config(uint32_t form, uint32_t integrator, double edge, double dx)
{
    sph_config c = open_config(edge, dx);
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = -2 * edge;
        c.hi[k] = 2 * edge;
    }
    c.max_particles = SPH_DIM == 3 ? 1500 : 1200;
    c.kernel = SPH_CUBIC;
    c.viscosity = SPH_INVISCID;
    c.solid = form;
    c.max_stretch = 4;
    c.integrator = integrator;
    return c;
}

/* a body of n^DIM particles about the origin, jittered by a part of a spacing */
static UNUSED void add_block(sph_sim *sim, uint32_t set, uint32_t n, double dx, double jitter)
{
    uint32_t total = 1;
    for (int k = 0; k < SPH_DIM; k++)
        total *= n;
    for (uint32_t i = 0; i < total; i++) {
        double x[SPH_DIM];
        uint32_t at = i;
        for (int k = 0; k < SPH_DIM; k++, at /= n)
            x[k] = (at % n + 0.5 - 0.5 * n + jitter * toss()) * dx;
        must(sim, sph_add_particle(sim, set, x, NULL, 0, NULL));
    }
}

/* v = L x */
static UNUSED void linear_velocity(void *ctx, const double *x, double *v, double *rho)
{
    const tensor *l = ctx;
    (void)rho;
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = 0;
        for (int m = 0; m < SPH_DIM; m++)
            v[k] += l->v[k][m] * x[m];
    }
}
/* the acceleration that keeps dx/dt = L x with L at rest: L L x */
static UNUSED void linear_drive(void *ctx, double t, const double *x, const double *v, double *a)
{
    const tensor *l = ctx, l2 = times(*l, *l);
    (void)t, (void)v;
    for (int k = 0; k < SPH_DIM; k++)
        for (int m = 0; m < SPH_DIM; m++)
            a[k] += l2.v[k][m] * x[m];
}

static const char *const form_names[] = {"none", "updated", "corrected", "total"};
static const char *const integrator_names[] = {"predictor-corrector", "kick-drift-kick", "leap-frog", "Runge-Kutta",
                                               "Runge-Kutta (momentum)"};

#endif
