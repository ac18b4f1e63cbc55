/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stress.c: solids, and fluids beside them (sph.h, SPH_UPDATED ...). With T = -sigma/rho^2 (corrected gradients: -sigma
   M^-T/rho; weak scheme: the same without rho, and the pair divides by rho_i rho_j), times phi (quadrature.c):
     force      dv_i = -sum m_j (T_i + T_j + (R_i + R_j) (W/W(dx))^n) K g                   (Gray 2001 eqs 5.9, 5.21)
     gradient   L = (-sum m_j v_ij (x) K g) M^-1, plain: 1/rho_i for M^-1
     rates      drho = -rho tr L,  dS = 2 mu (e - tr e/3) + W S - S W,  e, W: halves of L +- L^T     (Gray 5.7-5.9)
   A wall's T is its pressure's; fluids have no M and no S. Artificial stress: R = epsilon/rho^2 (weak: epsilon) times
   the tensile part of a solid's sigma (Gray 5.22-5.28, Monaghan 2000). Strain rates see v + u where xsph_strain
   asks. */
#include "oracle.h"

static double size_of(const double (*m)[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            sum += m[k][l] * m[k][l];
    return sqrt(sum);
}

static void make_t(o_scene *s, o_particle *p)
{
    const bool corrected = o_corrects(s) && o_is_solid(s, p);
    const double w = o_is_weak(s) ? 1 : 1 / (p->rho * p->rho), back = o_is_weak(s) ? 1 : 1 / p->rho;
    p->t_scale = size_of((const double(*)[3])p->sigma) * (corrected ? back * p->inverse_scale : w);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            p->t[k][l] = -p->sigma[k][l] * w;
            if (corrected) {
                p->t[k][l] = 0;
                for (int m = 0; m < SPH_DIM; m++)
                    p->t[k][l] -= p->sigma[k][m] * p->inverse[l][m] * back;
            }
            p->t[k][l] *= o_phi(p);
        }
    p->t_scale *= o_max(1, p->phi.s);
}

static void make_pull(o_scene *s, o_particle *p)
{
    const double w = o_is_weak(s) ? 1 : 1 / (p->rho * p->rho);
    if (s->cfg.artificial_stress == SPH_NO_ARTIFICIAL_STRESS || !o_is_solid(s, p))
        return;
    o_tensile_part(s, (const double(*)[3])p->sigma, s->cfg.artificial_stress == SPH_PRINCIPAL, p->pull);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            p->pull[k][l] *= s->cfg.stress_epsilon * w;
}

/* R by components is no tensor: so an image shows that of its particle, or a mirror plane would push along itself */
void o_stresses(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++)
        make_pull(s, &s->own[i]);
    o_copies(s);
    for (uint32_t i = 0; i < s->n; i++)
        make_t(s, &s->own[i]);
    for (uint32_t i = 0; i < s->m; i++)
        make_t(s, &s->all[i]);
}

/* forms whose gradient of the kernel is another (forms.c) */
static void form_force(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    const double m = s->set[j->set].mass, w = o_is_weak(s) ? m / (i->rho * j->rho) : m;
    const bool wall = o_is_ghost(s, j), own = o_normalises(s);
    double a[3] = {0}, grad[3][3] = {{0}}, plain[3] = {0}, scale, rate = p->slope;
    for (int k = 0; k < SPH_DIM; k++)
        plain[k] = p->g * p->x[k];
    if (own)
        rate = o_normalised_gradient(s, i, p, plain);
    if (own)
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++)
                grad[k][l] = plain[l];
    scale = own ? rate : o_stabilised_gradient(s, i, j, p, grad);
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            a[k] -= w * (i->t[k][l] + j->t[k][l]) * grad[k][l];
    if (o_is_body(s, i))
        o_push(s, i, j, a, w * scale * (i->t_scale + j->t_scale));
    const double c = own || o_is_weak(s) ? p->volume : m;
    for (int k = 0; k < SPH_DIM; k++) {
        const double v = i->v[k] + i->smooth[k] - j->v[k] - (wall ? 0 : j->smooth[k]);
        for (int l = 0; l < SPH_DIM; l++)
            o_add(&i->gradient[k][l], c * v * plain[l], c * fabs(v) * rate);
    }
}

void o_stress_force(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    const double m = s->set[j->set].mass, w = o_is_weak(s) ? m / (i->rho * j->rho) : m;
    const double c = o_is_weak(s) ? p->volume : m, dx = s->cfg.spacing;
    const bool wall = o_is_ghost(s, j);
    double a[3] = {0}, v[3], near = 0;
    if (p->apart)
        return;
    if (o_normalises(s) || (s->cfg.solid == SPH_STABILISED && !wall)) {
        form_force(s, i, j, p);
        return;
    }
    if (!wall && s->cfg.artificial_stress != SPH_NO_ARTIFICIAL_STRESS)
        near = pow(p->w / o_weight(s->cfg.kernel, dx, s->cfg.smoothing_length), s->cfg.stress_exponent);
    for (int k = 0; k < SPH_DIM; k++) {
        for (int l = 0; l < SPH_DIM; l++)
            a[k] -= w * (i->t[k][l] + j->t[k][l] + near * (i->pull[k][l] + j->pull[k][l])) * p->k[l] * p->g;
        v[k] = i->v[k] + i->smooth[k] - j->v[k] - (wall ? 0 : j->smooth[k]);
    }
    const double pull = near * (size_of((const double(*)[3])i->pull) + size_of((const double(*)[3])j->pull));
    if (o_is_body(s, i))
        o_push(s, i, j, a, w * p->slope * (i->t_scale + j->t_scale + 10 * pull));
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            o_add(&i->gradient[k][l], c * v[k] * p->k[l] * p->g, c * fabs(v[k]) * p->slope);
}

double o_velocity_gradient(const o_scene *s, const o_particle *i, double (*l)[3])
{
    const bool corrected = o_corrects(s) && o_is_solid(s, i);
    const double plain = o_is_weak(s) || o_normalises(s) ? 1 : 1 / i->rho;
    double scale = 0;
    for (int k = 0; k < SPH_DIM; k++)
        for (int c = 0; c < SPH_DIM; c++) {
            for (int m = 0; m < SPH_DIM; m++)
                l[k][c] -= i->gradient[k][m].v * (corrected ? i->inverse[m][c] : m == c ? plain : 0);
            scale += i->gradient[k][c].s * (corrected ? i->inverse_scale : plain);
        }
    return scale;
}

void o_strain_rates(const o_scene *s, o_particle *i)
{
    double l[3][3] = {{0}}, trace = 0;
    const double scale = o_velocity_gradient(s, i, l), mu = s->set[i->set].shear;
    for (int k = 0; k < SPH_DIM; k++)
        trace += l[k][k];
    o_add(&i->rate, -i->rho * trace, i->rho * scale);
    if (!o_is_solid(s, i))
        return;
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) {
            double turn = 0;
            for (int m = 0; m < 3; m++)
                turn += 0.5 * ((l[k][m] - l[m][k]) * i->dev[m][c] - i->dev[k][m] * (l[m][c] - l[c][m]));
            const double e = 0.5 * (l[k][c] + l[c][k]) - (k == c ? trace / 3 : 0);
            o_add(&i->stress_rate[k][c], 2 * mu * e + turn,
                  scale * (2 * mu + size_of((const double(*)[3])i->dev)));
        }
}
