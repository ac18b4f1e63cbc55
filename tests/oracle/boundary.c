/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* boundary.c: forces of particles that stand on a wall, r = x_i - x_wall, r_perp = r . n, q = r_perp/h or r_perp/2dx:
     Lennard-Jones  a = D ((r0/r)^12 - (r0/r)^6) r/r^2 where r < r0 = dx; none below r0/1000       (Gray 2001 eq 2.38)
     kernel force   a = f(q) P n, f = nu c0^2/h times 2/3 (q < 2/3), 2q - 3q^2/2 (q < 1), (2 - q)^2/2 (q < 2)
                                                                              (Gray 2.39-2.41, with (2/3)/h)
     Monaghan-Kos   a = (A/sqrt q)(1 - q) P n where q < 1; q at least 1/1000        (Wickramarachchi 2009 eqs 6.10-6.12)
   P = (1 + cos(pi r_par/dx))/2 within dx along the wall, in 3-D one for each of two directions; also as far as dx
   behind the wall. */
#include "oracle.h"

static double window(const o_set *set, const o_particle *w, const double *along, double dx)
{
    double first = 0, second = 0;
    (void)set;
    if (SPH_DIM == 1)
        return 1;
    if (SPH_DIM == 2) {
        second = sqrt(o_dot(along, along));
    } else {
        first = o_dot(along, w->tangent);
        second = sqrt(o_max(o_dot(along, along) - first * first, 0));
    }
    if (fabs(first) >= dx || second >= dx)
        return 0;
    return 0.25 * (1 + cos(O_PI * first / dx)) * (1 + cos(O_PI * second / dx));
}

static double along_normal(const o_scene *s, const o_set *set, double perp)
{
    const double h = s->cfg.smoothing_length;
    if (set->kind == SPH_WALL_KERNEL_FORCE) {
        const double q = perp / h, c = set->strength * set->c0 * set->c0 / h;
        if (q >= 2)
            return 0;
        return c * (q < 2.0 / 3 ? 2.0 / 3 : q < 1 ? 2 * q - 1.5 * q * q : 0.5 * (2 - q) * (2 - q));
    }
    const double q = o_max(perp / (2 * s->cfg.spacing), 1e-3);
    return q >= 1 ? 0 : set->strength / sqrt(q) * (1 - q);
}

static void lennard_jones(o_scene *s, const o_set *set, const double *r, double *a, double *scale)
{
    const double dx = s->cfg.spacing, d = sqrt(o_dot(r, r)), t6 = pow(dx / d, 6);
    o_close(s, "at the least distance of a wall's particle", d, 1e-3 * dx, 1e-3 * dx);
    for (int k = 0; k < 3; k++)
        a[k] = d < dx && d > 1e-3 * dx ? set->strength * (t6 * t6 - t6) * r[k] / (d * d) : 0;
    *scale = d < dx && d > 1e-3 * dx ? set->strength * (t6 * t6 + t6) / d * (1 + s->support / d) : 0;
}

static double window_of(const o_scene *s, const o_set *set, const o_particle *w, const double *r, double perp)
{
    double along[3];
    for (int k = 0; k < 3; k++)
        along[k] = r[k] - perp * w->normal[k];
    return window(set, w, along, s->cfg.spacing);
}

void o_boundary(o_scene *s, o_particle *i, const o_particle *j)
{
    const o_set *set = &s->set[j->set];
    const double dx = s->cfg.spacing;
    double r[3], a[3], scale = 0;
    for (int k = 0; k < 3; k++)
        r[k] = i->x[k] - j->x[k];
    const double perp = o_dot(r, j->normal), straight = o_max(o_max(fabs(j->normal[0]), fabs(j->normal[1])),
                                                              fabs(j->normal[2]));
    /* the kernel looks into neighbouring cells, which hold all within the support and, of walls along the axes, all
       within reach; of slanted walls it may not see the faint ends */
    if (straight < 0.999 && set->kind != SPH_WALL_LENNARD_JONES && perp < 2 * o_max(dx, s->cfg.smoothing_length) &&
        perp > -dx && o_dot(r, r) > s->support * s->support && window_of(s, set, j, r, perp) > 0)
        s->undecided = "a slanted wall beyond the support";
    if (set->kind == SPH_WALL_LENNARD_JONES) {
        lennard_jones(s, set, r, a, &scale);
    } else {
        o_close(s, "a spacing behind a wall", perp, -dx, dx);
        const double f = perp < -dx ? 0 : along_normal(s, set, perp) * window_of(s, set, j, r, perp);
        const double h = s->cfg.smoothing_length;
        const double top = set->kind == SPH_WALL_KERNEL_FORCE ? set->strength * set->c0 * set->c0 / h : set->strength;
        for (int k = 0; k < 3; k++)
            a[k] = f * j->normal[k];
        /* an error of r moves the window by its slope */
        scale = perp < -dx || f == 0 ? 0 : 3 * fabs(f) * (1 + dx / o_max(perp, 1e-3 * dx)) + 0.1 * top;
    }
    o_push(s, i, j, a, scale);
}
