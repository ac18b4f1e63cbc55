/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* gradient.c: the matrix of corrected gradients and its inverse, for bodies.
     solids   M = -sum m_j x_ij (x) K g (weak scheme: m_j/rho_j), over bodies but not across two bodies of the total
              form, and ghosts; L and T use M^-1 (sph.h, SPH_CORRECTED; Bonet & Lok 1999)
     fluids   the same with K = x_ij: E = M/rho (weak: M); Bonet & Lok N = M^-1; renormalised B = E^-1, and
              (B_i + B_j)/2 x_ij for x_ij (Wickramarachchi 2009 eqs 4.8-4.20)
   Where neighbours do not span space the plain gradient is taken: E = I. That is where det E is below a thousandth of
   that of a ball with the same norm, or of (0.6/2^DIM)^DIM, six tenths of a block's corner on every axis. */
#include "oracle.h"

static double determinant(const double (*m)[3])
{
    if (SPH_DIM == 1)
        return m[0][0];
    if (SPH_DIM == 2)
        return m[0][0] * m[1][1] - m[0][1] * m[1][0];
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Gauss-Jordan with pivots */
static void invert(const double (*m)[3], double (*inv)[3])
{
    double a[3][6] = {{0}};
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++) {
            a[k][l] = m[k][l];
            a[k][SPH_DIM + l] = k == l;
        }
    for (int k = 0; k < SPH_DIM; k++) {
        int best = k;
        for (int r = k + 1; r < SPH_DIM; r++)
            if (fabs(a[r][k]) > fabs(a[best][k]))
                best = r;
        for (int l = 0; l < 2 * SPH_DIM; l++) {
            const double keep = a[k][l];
            a[k][l] = a[best][l];
            a[best][l] = keep;
        }
        const double pivot = a[k][k];
        for (int l = 0; l < 2 * SPH_DIM; l++)
            a[k][l] /= pivot;
        for (int r = 0; r < SPH_DIM; r++)
            for (int l = 2 * SPH_DIM - 1; r != k && l >= k; l--)
                a[r][l] -= a[r][k] * a[k][l];
    }
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            inv[k][l] = a[k][SPH_DIM + l];
}

static double norm(const double (*m)[3])
{
    double sum = 0;
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            sum += m[k][l] * m[k][l];
    return sqrt(sum);
}

/* E of one particle, and the sum of its terms' magnitudes */
static double sum_of(o_scene *s, const o_particle *i, double (*e)[3])
{
    double scale = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        const o_particle *j = &s->all[b];
        o_pair p;
        if (!(o_is_body(s, j) || o_is_ghost(s, j)) || !o_pair_of(s, i, j, &p) || p.apart)
            continue;
        const double c = o_is_weak(s) ? p.volume : s->set[j->set].mass / i->rho;
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++)
                e[k][l] -= c * p.x[k] * p.k[l] * p.g;
        scale += c * p.slope * (p.r + 0.1 * s->cfg.smoothing_length);
    }
    return scale;
}

bool o_is_singular(const double (*e)[3])
{
    const double det = determinant(e), mean = norm(e) / sqrt(SPH_DIM);
    return !(det > 1e-3 * pow(mean, SPH_DIM)) || !(det > pow(0.6 * pow(2, -SPH_DIM), SPH_DIM));
}
double o_inverse(o_scene *s, const double (*e)[3], double terms, double (*inv)[3])
{
    const double det = determinant(e), mean = norm(e) / sqrt(SPH_DIM);
    const double least = o_max(1e-3 * pow(mean, SPH_DIM), pow(0.6 * pow(2, -SPH_DIM), SPH_DIM));
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            inv[k][l] = k == l;
    o_close(s, "a gradient's matrix that is nearly singular", det, least, 0.1 * terms * pow(mean, SPH_DIM - 1));
    if (o_is_singular(e))
        return 1;
    invert(e, inv);
    const double size = norm((const double(*)[3])inv);
    return size * (1 + size * terms);
}

static void correct(o_scene *s, o_particle *i)
{
    const bool solids = o_has_solids(s), wants = solids ? o_is_solid(s, i) : o_is_body(s, i);
    const bool n_form = solids || s->cfg.gradient == SPH_BONET_LOK;
    double e[3][3] = {{0}}, inv[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, scale = 1;
    if (wants) {
        const double terms = sum_of(s, i, e), det = determinant((const double(*)[3])e);
        const double mean = norm((const double(*)[3])e) / sqrt(SPH_DIM), ball = 1e-3 * pow(mean, SPH_DIM);
        const double least = pow(0.6 * pow(2, -SPH_DIM), SPH_DIM);
        o_close(s, "a gradient's matrix that is nearly singular", det, o_max(ball, least),
                0.1 * terms * pow(mean, SPH_DIM - 1));
        if (det > ball && det > least) {
            invert((const double(*)[3])e, inv);
            const double size = norm((const double(*)[3])inv);
            scale = size * (1 + size * terms);
        }
    }
    const double back = n_form && !o_is_weak(s) ? 1 / i->rho : 1;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            i->inverse[k][l] = inv[k][l] * back;
    i->inverse_scale = scale * back;
}

/* gradient_guard: of the correction that share, rising from det E 0.3 to 0.6; the scale of what rounding makes of it
   goes with det E, which is 1/det B */
static double guard_share(const o_scene *s, const double (*b)[3], double b_scale, double *rise)
{
    const double det = 1 / determinant(b), size = norm(b), share = (det - 0.3) / 0.3;
    const bool rises = s->cfg.gradient_guard && share > -0.01 && share < 1.01;
    *rise = rises ? 4 * det * det * SPH_DIM * b_scale * pow(size, SPH_DIM - 1) : 0;
    return !s->cfg.gradient_guard || share > 1 ? 1 : share < 0 ? 0 : share;
}

/* T of the fluids' Bonet & Lok form */
static void bonet_lok(const o_scene *s, o_particle *p)
{
    const double w = o_is_body(s, p) ? o_is_weak(s) ? p->p : p->p / p->rho
                                     : o_is_weak(s) ? p->p : p->p / (p->rho * p->rho);
    const double back = o_is_weak(s) ? 1 : 1 / p->rho;
    double b[3][3], rise = 0, share = 1;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            b[k][l] = p->inverse[k][l] / back;
    if (o_is_body(s, p))
        share = guard_share(s, (const double(*)[3])b, p->inverse_scale / back, &rise);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            p->t[k][l] = w * (!o_is_body(s, p) ? k == l : share * p->inverse[k][l] + (1 - share) * (k == l) * back);
    p->t_scale = fabs(w) * (o_is_body(s, p) ? p->inverse_scale + rise * (p->inverse_scale + back) : 1);
}

void o_correct(o_scene *s)
{
    const bool solids = s->cfg.solid == SPH_CORRECTED || s->cfg.solid == SPH_TOTAL;
    const bool plain = !solids && s->cfg.gradient == SPH_PLAIN;
    for (uint32_t i = 0; i < s->n && !plain; i++)
        correct(s, &s->own[i]);
    if (!plain || s->cfg.shear != SPH_NO_SHEAR)
        o_copies(s);
    if (s->cfg.shear != SPH_NO_SHEAR) {
        o_make_shear(s);
        o_copies(s);
    }
    if (plain)
        return;
    for (uint32_t i = 0; i < s->n && !solids; i++)
        bonet_lok(s, &s->own[i]);
    for (uint32_t i = 0; i < s->m && !solids; i++)
        bonet_lok(s, &s->all[i]);
}

void o_gradient_vector(const o_scene *s, const o_particle *i, const o_particle *j, const o_pair *p, double *k,
                       double *scale)
{
    *scale = 1;
    for (int a = 0; a < 3; a++)
        k[a] = p->x[a];
    if (s->cfg.gradient != SPH_RENORMALISED || o_has_solids(s))
        return;
    /* a wall has no B of its own: the pair takes the body's */
    const o_particle *one = o_is_body(s, i) ? i : j, *two = o_is_body(s, j) ? j : i;
    for (int a = 0; a < SPH_DIM; a++) {
        k[a] = 0;
        for (int b = 0; b < SPH_DIM; b++)
            k[a] += 0.5 * (one->inverse[a][b] + two->inverse[a][b]) * p->x[b];
    }
    *scale = 0.5 * (one->inverse_scale + two->inverse_scale);
}
