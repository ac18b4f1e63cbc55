/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shear.c: the gradient of the velocity of fluids and the viscous stress made of it (Wickramarachchi 2009 eqs 5.4, 5.5,
   5.11, 5.18, 5.19, 5.32, 5.33), with the signs that take energy:
     L_i = sum (m_j/rho) (v_j - v_i) (x) grad W  (rho_i; weak schemes rho_j), times B with corrected gradients
     S = (L + L^T)/2, |S| = sqrt(2 S:S), tau = 2 rho (nu + nu_t)(S - tr S/3) - q
     nested 0; smagorinsky nu_t = (C_s dx)^2 |S|; as printed C_s dx^2 |S|^2; q = 2/3 C_I rho dx^2 |S|^2, but where tr S
     > 0 at most what makes tau : S vanish
     dv_i = sum m_j (T_i + T_j) grad W, T = tau B/rho^2 (weak: tau B, over rho_i rho_j); a wall without slip has T_i
   It takes the work on the relative velocity; beside walls half of the work on the velocity that viscosity sees. The
   Courant limit takes max(|mu|, courant (nu + nu_t)/(viscous_factor h^2) - c/h). */
#include "oracle.h"

static double cell_of(const o_scene *s, const o_particle *i, int k, int l)
{
    return s->cfg.gradient == SPH_PLAIN ? k == l : i->inverse[k][l];
}

/* L (1/s); returns the scale of its errors */
static double gradient_of(o_scene *s, const o_particle *i, double (*out)[3])
{
    const bool has_rho = s->cfg.gradient == SPH_BONET_LOK && !o_is_weak(s); /* the inverse is of M, not of M/rho */
    double sum[3][3] = {{0}}, scale = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        const o_particle *j = &s->all[b];
        o_pair p;
        double v[3];
        if (!(o_is_body(s, j) || o_is_ghost(s, j)) || !o_pair_of(s, i, j, &p) || !o_sheared_velocity(s, i, j, &p, v))
            continue;
        const double c = o_is_weak(s) ? p.volume : has_rho ? s->set[j->set].mass : s->set[j->set].mass / i->rho;
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++)
                sum[k][l] -= c * v[k] * p.x[l] * p.g;
        scale += c * sqrt(o_dot(v, v)) * p.slope;
    }
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++) {
            out[k][l] = 0;
            for (int m = 0; m < SPH_DIM; m++)
                out[k][l] += sum[k][m] * cell_of(s, i, m, l);
        }
    return scale * (s->cfg.gradient == SPH_PLAIN ? 1 : i->inverse_scale);
}

static void make(o_scene *s, o_particle *i)
{
    const sph_config *c = &s->cfg;
    const double dx2 = c->spacing * c->spacing, courant = o_courant_number(c), h = c->smoothing_length;
    double l[3][3] = {{0}}, trace = 0, square = 0, nu = c->nu, q = 0, rough = c->nu, tau[3][3] = {{0}};
    const double scale = gradient_of(s, i, l);
    for (int k = 0; k < SPH_DIM; k++) {
        trace += l[k][k];
        for (int m = 0; m < SPH_DIM; m++)
            square += 0.25 * (l[k][m] + l[m][k]) * (l[k][m] + l[m][k]);
    }
    const double size = sqrt(2 * square), most = 2 * scale;
    if (c->shear == SPH_SMAGORINSKY) {
        nu += c->smagorinsky * c->smagorinsky * dx2 * size;
        rough += c->smagorinsky * c->smagorinsky * dx2 * most;
    } else if (c->shear == SPH_SMAGORINSKY_WICK) {
        nu += c->smagorinsky * dx2 * size * size;
        rough += c->smagorinsky * dx2 * most * most;
    }
    if (c->shear != SPH_NESTED)
        q = 2.0 / 3 * c->subgrid * dx2 * size * size;
    double loose = q > 0 ? 2.0 / 3 * c->subgrid * dx2 * most * most : 0;
    const double heat = 2 * nu * (square - trace * trace / 3);
    if (trace > 0 && trace * q > heat) {
        q = o_max(heat, 0) / trace;
        loose += 2 * rough * most * most / trace;
    }
    for (int k = 0; k < SPH_DIM; k++)
        for (int m = 0; m < SPH_DIM; m++)
            tau[k][m] = nu * (l[k][m] + l[m][k]) - (k == m ? 2 * nu * trace / 3 + q : 0);
    const bool has_rho = c->gradient == SPH_BONET_LOK && !o_is_weak(s);
    const double per = o_is_weak(s) ? i->rho : has_rho ? 1 : 1 / i->rho; /* the stress is rho times tau */
    for (int k = 0; k < SPH_DIM; k++)
        for (int m = 0; m < SPH_DIM; m++) {
            i->shear[k][m] = 0;
            for (int n = 0; n < SPH_DIM; n++)
                i->shear[k][m] += per * tau[k][n] * cell_of(s, i, n, m);
        }
    i->shear_scale = per * (4 * rough * most + loose) * (c->gradient == SPH_PLAIN ? 1 : i->inverse_scale);
    i->eddy = c->shear == SPH_NESTED ? 0 : courant * nu / (c->viscous_factor * h * h) -
                                               o_min(s->set[i->set].c0, c->sound_speed) / h;
    i->eddy_scale = nu > 0 ? 1 + rough / nu * (1 + most / o_max(size, 1e-30)) : 1;
}

void o_make_shear(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++)
        if (o_is_body(s, &s->own[i]))
            make(s, &s->own[i]);
}

void o_shear_force(o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    const bool wall = o_is_ghost(s, j);
    const double m = s->set[j->set].mass, c = o_is_weak(s) ? m / (i->rho * j->rho) : m;
    double a[3] = {0}, seen[3], at[3];
    if (s->cfg.shear == SPH_NO_SHEAR || !o_sheared_velocity(s, i, j, p, seen))
        return;
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            a[k] += c * (i->shear[k][l] + (wall ? i->shear[k][l] : j->shear[k][l])) * p->x[l] * p->g;
    const double scale = c * (i->shear_scale + (wall ? i->shear_scale : j->shear_scale)) * p->slope;
    o_push(s, i, j, a, scale);
    if (s->cfg.energy && !wall) { /* tau : L of each */
        double own[3] = {0};
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++)
                own[k] += c * i->shear[k][l] * p->x[l] * p->g;
        o_add(&i->viscous, -o_dot(own, p->v), c * i->shear_scale * p->slope * sqrt(o_dot(p->v, p->v)));
        return;
    }
    for (int k = 0; k < 3; k++)
        at[k] = wall ? 0.5 * seen[k] : o_loses(s) ? i->v[k] : 0.5 * p->v[k];
    o_add(&i->viscous, -o_dot(a, at), scale * sqrt(o_dot(at, at)));
}
