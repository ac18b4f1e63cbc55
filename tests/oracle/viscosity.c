/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* viscosity.c: with mu = v_ij . x_ij/(r^2 + 0.01 h^2), means of i and j for c (c0) and rho:
     artificial   dv_i = -sum m_j Pi grad W, Pi = -(h/rho)(alpha c + beta h |mu|) mu          (Gray 2001 eq 2.18)
     approaching  the same where mu < 0, else 0                                (Wickramarachchi 2009 eq 3.18)
     Morris       dv_i = sum m_j 4 nu/(rho_i + rho_j) (x_ij . grad W)/(r^2 + eta) v_ij        (Morris, Fox & Zhu 1997)
                  eta only keeps it finite: 1e-6 h^2 (with 0.01 h^2 it would be some per cent too weak)
   Walls: with free slip none. GHOST: v_ij times beta = min(1.5, 1 + depth/distance), depth and distance of ghost and
   body from the wall's face (Gray 2.42, 2.43). ADAMI: v_i - v_w with the extrapolated v_w.
   It takes energy by its work on the relative velocity; with the energy equation half of that on the velocity seen. */
#include "oracle.h"

#define MORRIS_SOFTENING 1e-6

bool o_sheared_velocity(const o_scene *s, const o_particle *i, const o_particle *j, const o_pair *p, double *v)
{
    const o_set *wall = &s->set[j->set];
    for (int k = 0; k < 3; k++)
        v[k] = p->v[k];
    if (!o_is_ghost(s, j))
        return true;
    if (!wall->no_slip)
        return false;
    if (wall->kind == SPH_WALL_ADAMI) {
        for (int k = 0; k < 3; k++)
            v[k] = i->v[k] - j->seen[k];
        return true;
    }
    double depth = 0, distance = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        depth -= (j->x[k] - j->origin[k]) * j->normal[k];
        distance += (i->x[k] - j->origin[k]) * j->normal[k];
    }
    depth = o_max(depth, 0);
    const double beta = depth > 0 && !(depth < 0.5 * distance) ? 1.5 : depth > 0 ? 1 + depth / distance : 1;
    for (int k = 0; k < 3; k++)
        v[k] *= beta;
    return true;
}

void o_viscosity(o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    const double h = p->h, m = s->set[j->set].mass, rho = 0.5 * (i->rho + j->rho);
    double v[3], a[3], k[3], stretch;
    if (s->cfg.viscosity == SPH_INVISCID || !o_sheared_velocity(s, i, j, p, v))
        return;
    const double vx = o_dot(v, p->x);
    double mu = vx / (p->r * p->r + 0.01 * h * h), scale;
    if (s->cfg.viscosity == SPH_ARTIFICIAL_APPROACHING && mu > 0)
        mu = 0;
    double *const most = p->edge ? &i->mu_at_edge : &i->mu;
    *most = o_max(*most, fabs(mu));
    o_gradient_vector(s, i, j, p, k, &stretch);
    if (s->cfg.viscosity == SPH_MORRIS) {
        const double c = m * 2 * s->cfg.nu / rho * p->g * p->r * p->r / (p->r * p->r + MORRIS_SOFTENING * h * h);
        for (int b = 0; b < 3; b++)
            a[b] = c * v[b];
        const double soft = MORRIS_SOFTENING * h * h, near = soft / (p->r * p->r + soft) * h / o_max(p->r, 1e-4 * h);
        scale = m * 2 * s->cfg.nu / rho * (p->slope / o_max(p->r, 0.01 * h)) * sqrt(o_dot(v, v)) * (1 + near);
    } else {
        const double c = o_is_ghost(s, j) ? i->c : 0.5 * (i->c + j->c); /* a wall has no sound of its own */
        const double strength = h / rho * (s->cfg.alpha * c + s->cfg.beta * h * fabs(mu));
        for (int b = 0; b < 3; b++)
            a[b] = m * strength * mu * p->g * k[b];
        /* mu's own errors are relative to |v| r/(r^2 + ...) */
        const double size = sqrt(o_dot(v, v)) * (p->r + 0.05 * h) / (p->r * p->r + 0.01 * h * h);
        scale = m * h / rho * (s->cfg.alpha * c + s->cfg.beta * h * 2 * size) * size * p->slope * stretch;
    }
    o_push(s, i, j, a, scale);
    /* of two bodies each is charged half of the work on their relative velocity, or its own where the other one is not
       pushed back alike */
    double at[3];
    for (int b = 0; b < 3; b++)
        at[b] = s->cfg.energy ? 0.5 * v[b] : o_is_ghost(s, j) ? p->v[b] : o_loses(s) ? i->v[b] : 0.5 * p->v[b];
    o_add(&i->viscous, -o_dot(a, at), scale * sqrt(o_dot(at, at)));
}
