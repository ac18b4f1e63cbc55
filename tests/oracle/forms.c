/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* forms.c: forms of solids beside those of sph.h's first three, V = m/rho:
     stabilised   C_ij = V_j a_ij - w_ij (row_i - mean_i + col_j), a_ij the gradient of the kernel over its first sums
                  (Powell 2012 4.9, 4.18), row, col, mean, w, levels and the switch as sph/stabilised.h has them; each
                  pair g x_ij and half of what C_ij/V_j - C_ji/V_i has beside a_ij - a_ji
     normalised   grad W~, and grad W^ = M^-T grad W~ (his 1.14, 1.19): L by volumes, the force with the own gradient
     hourglass    F = M A^-1 of the bonds, a_i += sum m_j g (k_i (x_ij - F_i K) + k_j (x_ij - F_j K)), k = hourglass
                  E/rho0^2 (1 - D)
   Sums take the particle itself in. */
#include "oracle.h"

static bool stabilises(const o_scene *s) { return s->cfg.solid == SPH_STABILISED; }
bool o_normalises(const o_scene *s) { return s->cfg.solid >= SPH_NORMALISED; }

/* S of a particle r rows below a flat face of a lattice */
static double row_sum(const o_scene *s, int r)
{
    const double dx = s->cfg.spacing, h = s->cfg.smoothing_length;
    const int n = (int)(s->support / dx) + 1, second = SPH_DIM > 1 ? n : 0, third = SPH_DIM > 2 ? n : 0;
    double sum = 0;
    for (int m = r < n ? -r : -n; m <= n; m++)
        for (int a = -second; a <= second; a++)
            for (int b = -third; b <= third; b++)
                sum += o_weight(s->cfg.kernel, sqrt(m * m + a * a + b * b) * dx, h) * pow(dx, SPH_DIM);
    return sum;
}
static int level_of(o_scene *s, const o_particle *p)
{
    const double full = row_sum(s, 1000);
    int level = 0;
    for (int r = 0; r < 3; r++) {
        const double own = row_sum(s, r);
        const double edge = full - own > 0.02 * full ? 0.5 * (own + row_sum(s, r + 1)) : 0;
        if (o_is_solid(s, p))
            o_close(s, "a particle between two levels", p->fill, edge, full);
        level += !o_is_solid(s, p) || p->fill > edge;
    }
    return level;
}

/* w_ij */
static double count_of(const o_scene *s, const o_particle *i, const o_particle *j, const o_pair *p)
{
    const double within = o_min(1, 10 * (s->support - p->q) / s->cfg.smoothing_length);
    return j->level > i->level ? 2 * within : j->level < i->level ? 0 : within;
}

/* grad_i of the kernel that first sums normalise, axis k; its magnitude */
static double gradient_at(const o_particle *i, const o_pair *p, int k, double sign)
{
    return (sign * p->g * p->x[k] * i->fill - p->w * i->slant[k]) / (i->fill * i->fill);
}
static double magnitude_at(const o_particle *i, const o_pair *p)
{
    const double slant = sqrt(o_dot(i->slant, i->slant));
    return (p->slope * i->fill + p->value * slant) / (i->fill * i->fill);
}

static void first_sums(o_scene *s)
{
    o_copies(s);
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        double fill = 0, slant[3] = {0};
        for (uint32_t b = 0; b < s->m; b++) {
            o_pair p;
            if (!o_is_body(s, &s->all[b]) || !o_pair_of(s, i, &s->all[b], &p))
                continue;
            fill += p.volume * p.w;
            for (int k = 0; k < SPH_DIM; k++)
                slant[k] += p.volume * p.g * p.x[k];
        }
        if (!o_is_solid(s, i) || i->fill > 0) {
            i->fill = o_is_solid(s, i) ? i->fill : 1;
            continue;
        }
        i->fill = fill;
        for (int k = 0; k < SPH_DIM; k++)
            i->slant[k] = slant[k];
    }
    for (uint32_t a = 0; a < s->n; a++)
        s->own[a].level = level_of(s, &s->own[a]);
    o_copies(s);
}

/* row, col/V and the switch */
static void rows_of(o_scene *s, o_particle *i)
{
    double n = 0, sigma[3] = {0}, size[3] = {0};
    i->row_scale = i->drawn_scale = 0;
    for (int k = 0; k < 3; k++)
        i->row[k] = i->drawn[k] = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        const o_particle *j = &s->all[b];
        o_pair p;
        if (!o_is_body(s, j) || !o_pair_of(s, i, j, &p))
            continue;
        const double count = count_of(s, i, j, &p), back = count_of(s, j, i, &p);
        n += count;
        i->row_scale += p.volume * magnitude_at(i, &p);
        i->drawn_scale += magnitude_at(j, &p);
        for (int k = 0; k < SPH_DIM; k++) {
            i->row[k] += p.volume * gradient_at(i, &p, k, 1);
            i->drawn[k] += gradient_at(j, &p, k, -1);
            sigma[k] += 0.5 * (count + back) * j->sigma[k][k];
            size[k] += 0.5 * (count + back) * (fabs(j->sigma[k][k]) + fabs(j->p));
        }
    }
    i->row_scale /= n;
    i->drawn_scale /= n;
    for (int k = 0; k < SPH_DIM; k++) {
        i->row[k] /= n;
        i->drawn[k] /= n;
        if (size[k] > 0)
            o_close(s, "an axis in tension", sigma[k], 0, size[k]);
        i->on[k] = i->level > 0 && sigma[k] > 0;
    }
}
static void mean_of(o_scene *s, o_particle *i)
{
    double n = 0, sum[3] = {0}, size = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        const o_particle *j = &s->all[b];
        o_pair p;
        if (!o_is_body(s, j) || !o_pair_of(s, i, j, &p))
            continue;
        const double count = count_of(s, i, j, &p);
        n += count;
        size += count * p.volume * j->drawn_scale;
        for (int k = 0; k < SPH_DIM; k++)
            sum[k] += count * p.volume * j->drawn[k];
    }
    for (int k = 0; k < SPH_DIM; k++)
        i->row[k] -= sum[k] / n;
    i->row_scale += size / n;
}

static void stabilise(o_scene *s)
{
    first_sums(s);
    for (uint32_t a = 0; a < s->n; a++)
        if (o_is_solid(s, &s->own[a]))
            rows_of(s, &s->own[a]);
    o_copies(s);
    for (uint32_t a = 0; a < s->n; a++)
        if (o_is_solid(s, &s->own[a]))
            mean_of(s, &s->own[a]);
}

static void normalise(o_scene *s, o_particle *i)
{
    double sum = 0, d[3] = {0}, x[3] = {0}, y[3][3] = {{0}}, m[3][3] = {{0}}, inv[3][3], terms = 0, slope = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        o_pair p;
        if (s->all[b].set >= s->sets || s->set[s->all[b].set].role == SPH_ROLE_FORCE_WALL ||
            !o_pair_of(s, i, &s->all[b], &p))
            continue;
        sum += p.volume * p.w;
        slope += p.volume * p.slope;
        terms += p.volume * p.slope * p.r;
        for (int k = 0; k < SPH_DIM; k++) {
            d[k] += p.volume * p.g * p.x[k];
            x[k] -= p.volume * p.w * p.x[k];
            for (int l = 0; l < SPH_DIM; l++)
                y[k][l] -= p.volume * p.x[k] * p.g * p.x[l];
        }
    }
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            m[k][l] = (y[k][l] * sum - x[k] * d[l]) / (sum * sum);
    terms = terms / sum + slope * sqrt(o_dot(x, x)) / (sum * sum);
    i->inverse_scale = 1;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            inv[k][l] = k == l;
    if (s->cfg.solid == SPH_NORMALISED_CORRECTED)
        i->inverse_scale = o_inverse(s, (const double(*)[3])m, terms, inv);
    for (int k = 0; k < 3; k++) {
        i->slant[k] = 0;
        for (int l = 0; l < 3; l++) {
            i->mapped[k][l] = inv[l][k] / sum;
            i->slant[k] += inv[l][k] * d[l] / (sum * sum);
        }
    }
    i->fill = sum;
    i->row_scale = slope / (sum * sum);
}

/* F of a particle's bonds */
static void deform(o_scene *s, o_particle *i)
{
    double bent[3][3] = {{0}}, straight[3][3] = {{0}}, inv[3][3], terms = 0, drawn = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        o_pair p;
        if (!o_is_solid(s, &s->all[b]) || !o_pair_of(s, i, &s->all[b], &p) || !p.bond)
            continue;
        const double m = s->set[s->all[b].set].mass / i->rho;
        terms += m * p.slope * p.q;
        drawn += m * p.slope * p.r;
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++) {
                bent[k][l] -= m * p.g * p.x[k] * p.k[l];
                straight[k][l] -= m * p.g * p.k[k] * p.k[l];
            }
    }
    i->deform_scale = o_inverse(s, (const double(*)[3])straight, terms, inv) * (1 + drawn);
    const o_set *set = &s->set[i->set];
    const double sound = o_sound(set->eos, set->c0), bulk = set->rho0 * sound * sound, mu = set->shear;
    i->stiff = o_is_singular((const double(*)[3])straight) ? 0
        : s->cfg.hourglass * 9 * bulk * mu / (3 * bulk + mu) / (set->rho0 * set->rho0) * (1 - pow(i->root, SPH_DIM));
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            i->deform[k][l] = 0;
            for (int m = 0; m < SPH_DIM; m++)
                i->deform[k][l] += bent[k][m] * inv[m][l];
        }
}

bool o_make_forms(o_scene *s)
{
    const bool holds = s->cfg.hourglass > 0;
    if (!stabilises(s) && !o_normalises(s) && !holds)
        return false;
    if (stabilises(s))
        stabilise(s);
    o_copies(s);
    for (uint32_t a = 0; a < s->n; a++) {
        if (o_normalises(s) && o_is_solid(s, &s->own[a]))
            normalise(s, &s->own[a]);
        if (holds && o_is_solid(s, &s->own[a]))
            deform(s, &s->own[a]);
    }
    return true;
}

/* grad W as a solid of a normalised form sees it; its magnitude */
double o_normalised_gradient(const o_scene *s, const o_particle *i, const o_pair *p, double *grad)
{
    for (int k = 0; k < SPH_DIM; k++) {
        grad[k] = o_is_solid(s, i) ? -p->w * i->slant[k] : p->g * p->x[k];
        for (int l = 0; l < SPH_DIM && o_is_solid(s, i); l++)
            grad[k] += i->mapped[k][l] * p->g * p->x[l];
    }
    return o_is_solid(s, i) ? i->inverse_scale * (p->slope / i->fill + p->value * i->row_scale) : p->slope;
}

/* the force of a pair of bodies in the stabilised form, without T: rows of it for each component */
double o_stabilised_gradient(const o_scene *s, const o_particle *i, const o_particle *j, const o_pair *p,
                             double (*grad)[3])
{
    const double vi = s->set[i->set].mass / i->rho, vj = p->volume;
    const double count = count_of(s, i, j, p), back = count_of(s, j, i, p);
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++) {
            grad[k][l] = 0;
            grad[k][l] -= i->on[k] ? count * (i->row[l] / vj + j->drawn[l]) : 0;
            grad[k][l] += j->on[k] ? back * (j->row[l] / vi + i->drawn[l]) : 0;
            grad[k][l] = grad[k][l] / 2 + p->g * p->x[l];
        }
    return p->slope + 2 * (i->row_scale / vj + j->row_scale / vi + i->drawn_scale + j->drawn_scale);
}

void o_hourglass(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    double a[3] = {0}, scale = 0;
    if (!(s->cfg.hourglass > 0) || !p->bond)
        return;
    const double m = s->set[j->set].mass;
    for (int k = 0; k < SPH_DIM; k++) {
        double own = p->x[k], theirs = p->x[k];
        for (int l = 0; l < SPH_DIM; l++) {
            own -= i->deform[k][l] * p->k[l];
            theirs -= j->deform[k][l] * p->k[l];
        }
        a[k] = m * p->g * (i->stiff * own + j->stiff * theirs);
    }
    scale = m * p->slope * (i->stiff * (1 + i->deform_scale) + j->stiff * (1 + j->deform_scale)) * (1 + p->r / p->q);
    if (p->q > 0)
        o_push(s, i, j, a, scale);
}
