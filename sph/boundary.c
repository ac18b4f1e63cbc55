/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* boundary.c: forces of wall particles that stand on the wall itself and take part in no other sum. No array.

     Lennard-Jones   a = D ((r0/r)^12 - (r0/r)^6) r/r^2, r < r0               (Gray 2001 eq 2.38)
     kernel force    a = f(r_perp) P(r_par) n                                 (Gray 2001 eqs 2.39-2.41)
     Monaghan-Kos    a = (A/sqrt q)(1 - q) P(r_par) n, q = r_perp/(2 dx)      (Wickramarachchi 2009 eqs 6.10-6.12) */
#include "boundary.h"
#include "dmath.h"
#include "arithmetic.h"

SPH_OBJECT(boundary)

#define SPH_PI 3.14159265358979323846

#if SPH_HAS_FORCE_WALLS
/* component k of a vector of a wall as its image shows it: `turned` has the bits of the axes that a mirror turns */
static double seen(double v, uint32_t turned, int k) { return turned >> k & 1 ? -v : v; }

/* the window along the wall, half a cosine wide dx on either side (Gray 2.41); in 3-D one for each direction */
static double window(const sph_set *s, uint32_t turned, const double *r, double perp, double dx)
{
    double along[2] = {0, 0}, par2 = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        double par = r[k] - perp * seen(s->normal[k], turned, k);
        par2 += par * par;
        along[0] += par * seen(s->tangent[k], turned, k); /* stays 0 but in 3-D */
    }
    double rest2 = par2 - along[0] * along[0];
    along[1] = rest2 > 0 ? __builtin_sqrt(rest2) : 0;
    double p = 1;
    for (int k = 0; k < 2; k++) {
        if (sph_abs(along[k]) >= dx)
            return 0;
        p *= along[k] != 0 ? 0.5 * (1 + sph_cos(SPH_PI * along[k] / dx)) : 1;
    }
    return p;
}

/* size of the force along the normal at height r above a KERNEL_FORCE or MONAGHAN_KOS wall (m/s^2) */
static double normal_force(const sph_sim *sim, const sph_set *s, double r)
{
    double h = sim->cfg.smoothing_length, q = r / h;
    if (SPH_IS(s->kind, WALL_KERNEL_FORCE)) {
        double c = s->strength * s->c0 * s->c0;
        if (q >= 2)
            return 0;
        if (q >= 1)
            return c * 0.5 * (2 - q) * (2 - q) / h;
        return q > 2.0 / 3 ? c * q * (2 - 1.5 * q) / h : c * (2.0 / 3) / h;
    }
    q = r / (2 * sim->cfg.spacing);
    if (q >= 1)
        return 0;
    q = q > 1e-3 ? q : 1e-3;
    return s->strength * (1 - q) / __builtin_sqrt(q);
}

void sph_boundary_force(const sph_sim *sim, sph_thread *t, uint32_t h)
{
    const double dx = sim->cfg.spacing;
    double f[SPH_DIM] = {0}, power = 0;
    for (uint32_t j = 0; j < t->points.n; j++) {
        const sph_set *s = &sim->set[t->points.set[j]];
        const uint32_t turned = t->points.turned[j];
        double r[SPH_DIM], r2 = 0, perp = 0, a[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++) {
            r[k] = (double)t->home.x[k][h] - (double)t->points.x[k][j];
            r2 += r[k] * r[k];
            perp += r[k] * seen(s->normal[k], turned, k);
        }
        if (SPH_IS(s->kind, WALL_LENNARD_JONES)) {
            if (!(r2 < dx * dx) || r2 < 1e-6 * dx * dx)
                continue;
            double q2 = dx * dx / r2, q6 = q2 * q2 * q2, c = s->strength * (q6 * q6 - q6) / r2;
            for (int k = 0; k < SPH_DIM; k++)
                a[k] = c * r[k];
        } else {
            if (perp < -dx || perp > sim->grid.support)
                continue;
            double c = normal_force(sim, s, perp) * window(s, turned, r, perp, dx);
            for (int k = 0; k < SPH_DIM; k++)
                a[k] = c * seen(s->normal[k], turned, k);
        }
        for (int k = 0; k < SPH_DIM; k++) {
            f[k] += a[k];
            power += a[k] * seen(sph_wall_velocity(sim, s, (uint32_t)k), turned >> 3, k);
        }
    }
    for (int k = 0; k < SPH_DIM; k++)
        t->sum[SUM_BOUNDARY][h][k] += (sph_real)f[k];
    t->sum[SUM_BOUNDARY][h][SPH_DIM] += (sph_real)power;
}

#endif

