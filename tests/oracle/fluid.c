/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fluid.c: continuity and momentum of fluids, a scheme each (sph.h, SPH_STANDARD ...), grad W = g x_ij:
     standard  drho_i = sum m_j v_ij . grad W                 dv_i = -sum m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W
                                                              (Gray 2001 eqs 2.21, 2.17)
     weak      drho_i = rho_i sum (m_j/rho_j) v_ij . grad W   dv_i = -sum m_j (p_i + p_j)/(rho_i rho_j) grad W
                                                              (Wickramarachchi 2009 eq 3.80 and what conserves with it)
     direct    as weak                                        dv_i = -sum m_j (p_j - p_i)/(rho_i rho_j) grad W
                                                              (his 3.21, 3.22)
     printed   standard, weak with the pair's rate times (p_i/rho_i^2 + p_j/rho_j^2)/(2 p_i/rho_i^2) (3.50), p_j/p_i
               (3.79), or 1 where |p_i| < 1e-6 rho0 c0^2
   Corrected gradients (gradient.c): Bonet & Lok 1999 rho_i sum m_j v_ij . N_i x_ij g and -sum m_j (T_i + T_j) x_ij g,
   T = p N/rho; renormalised: B_ij x_ij in place of x_ij. A wall's T is p/rho^2 (standard), p (weak). */
#include "oracle.h"

/* the printed forms' weight of a pair */
static double printed(const o_scene *s, const o_particle *i, const o_particle *j)
{
    const double least = 1e-6 * s->cfg.rho0 * s->cfg.sound_speed * s->cfg.sound_speed;
    /* p's own errors are relative to rho0 c0^2 */
    o_close((o_scene *)s, "a pressure nearly too small to divide by", fabs(i->p), least,
            o_max(1e3 * least, fabs(i->p)));
    if (fabs(i->p) <= least)
        return 1;
    if (s->cfg.scheme == SPH_WEAK_WICK)
        return j->p / i->p;
    const double own = i->p / (i->rho * i->rho);
    return (own + j->p / (j->rho * j->rho)) / (2 * own);
}

void o_continuity(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    const bool bonet = s->cfg.gradient == SPH_BONET_LOK;
    const o_set *set = &s->set[j->set];
    double k[3] = {p->x[0], p->x[1], p->x[2]}, stretch = 1, c = o_is_weak(s) ? i->rho * p->volume : set->mass;
    if (bonet) {
        for (int a = 0; a < SPH_DIM; a++)
            k[a] = i->inverse[a][0] * p->x[0] + i->inverse[a][1] * p->x[1] + i->inverse[a][2] * p->x[2];
        stretch = i->inverse_scale;
        c = o_is_weak(s) ? c : c * i->rho;
    } else {
        o_gradient_vector(s, i, j, p, k, &stretch);
    }
    if (s->cfg.scheme == SPH_STANDARD_WICK || s->cfg.scheme == SPH_WEAK_WICK)
        c *= printed(s, i, j);
    o_add(&i->rate, c * p->g * o_dot(p->v, k), fabs(c) * p->slope * sqrt(o_dot(p->v, p->v)) * stretch);
}

void o_pressure_force(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    const double m = s->set[j->set].mass, both = m / (i->rho * j->rho);
    double a[3], k[3], stretch = 1, c, size;
    if (s->cfg.gradient == SPH_BONET_LOK) {
        const double scale = o_is_weak(s) ? both : m;
        for (int b = 0; b < 3; b++)
            a[b] = 0;
        for (int b = 0; b < SPH_DIM; b++)
            for (int l = 0; l < SPH_DIM; l++)
                a[b] -= scale * (i->t[b][l] + j->t[b][l]) * p->x[l] * p->g;
        o_push(s, i, j, a, scale * (i->t_scale + j->t_scale) * p->slope);
        return;
    }
    o_gradient_vector(s, i, j, p, k, &stretch);
    if (!o_is_weak(s)) {
        const double own = i->p / (i->rho * i->rho), other = j->p / (j->rho * j->rho);
        c = m * (own + other);
        size = m * (fabs(own) + fabs(other));
    } else {
        c = both * (j->p + (s->cfg.scheme == SPH_DIRECT ? -i->p : i->p));
        size = both * (fabs(j->p) + fabs(i->p));
    }
    for (int b = 0; b < 3; b++)
        a[b] = -c * p->g * k[b];
    o_push(s, i, j, a, size * p->slope * stretch);
}
