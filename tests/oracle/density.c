/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* density.c: density that is not evolved.
     summation   rho_i = sum m_j W_ij over bodies and ghosts, i among them                  (Gray 2001 eq 2.19)
     Shepard     rho_i = sum m_j W/sum (m_j/rho_j) W over the particles of one material     (Wickramarachchi 2009 6.3)
     MLS         the value at i of the linear function q of x_j - x_i with the least sum V_j W (q - d_j)^2 (his A.4.1);
                 where neighbours do not span space, the mean
   The second is summed as the excess d = (rho - rho0)/rho0: d_i = sum V_j d_j W/sum V_j W, the same for one material,
   for which alone it makes sense (two fluids at rest must stay at rest). */
#include "oracle.h"

void o_sum_density(o_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        const double rho0 = s->set[i->set].rho0;
        i->density = (o_sum){-1, 1};
        for (uint32_t b = 0; b < s->m && o_is_body(s, i); b++) {
            const o_particle *j = &s->all[b];
            o_pair p;
            if ((o_is_body(s, j) || o_is_ghost(s, j)) && o_pair_of(s, i, j, &p))
                o_add(&i->density, s->set[j->set].mass * p.w / rho0, s->set[j->set].mass * p.value / rho0);
        }
    }
    for (uint32_t a = 0; a < s->n; a++)
        if (o_is_body(s, &s->own[a]))
            s->own[a].d = s->own[a].density.v;
    o_refresh(s);
}

/* how fast the sums change with the places of particles and images: sum m_j (x'_i - x'_j) . grad W; and what of it is
   not of the velocities that powers are of: XSPH's, and a wall's image's along a no-slip mirror */
void o_sum_rates(o_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++)
        for (int k = 0; k < 3; k++) {
            s->own[a].beside[k] = o_is_body(s, &s->own[a]) ? s->own[a].drift[k].v : 0;
            s->own[a].way[k] = o_is_body(s, &s->own[a]) ? s->own[a].v[k] + s->own[a].beside[k] : s->own[a].wall[k];
        }
    o_copies(s);
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        i->moved_rate = i->unseen_rate = (o_sum){0, 0};
        for (uint32_t b = 0; b < s->m && o_is_body(s, i); b++) {
            const o_particle *j = &s->all[b];
            o_pair p;
            if (!(o_is_body(s, j) || o_is_ghost(s, j)) || !o_pair_of(s, i, j, &p))
                continue;
            const double v[3] = {i->way[0] - j->way[0], i->way[1] - j->way[1], i->way[2] - j->way[2]};
            const double m = s->set[j->set].mass;
            double unseen[3];
            for (int k = 0; k < 3; k++)
                unseen[k] = i->beside[k] - (o_is_body(s, j) ? j->beside[k] : j->way[k] - j->v[k]);
            o_add(&i->moved_rate, m * p.g * o_dot(v, p.x), m * p.slope * sqrt(o_dot(v, v)));
            o_add(&i->unseen_rate, m * p.g * o_dot(unseen, p.x), m * p.slope * sqrt(o_dot(unseen, unseen)));
        }
    }
}

/* Gauss-Jordan: the first unknown of a x = b; false: det below what the kernel asks for */
static bool first_unknown(o_scene *s, double (*a)[4], double *b, double *x)
{
    const double cover = a[0][0], (*m)[4] = (const double(*)[4])a;
    double det, size = 0, spread = 1;
    if (SPH_DIM == 1)
        det = m[1][1];
    else if (SPH_DIM == 2)
        det = m[1][1] * m[2][2] - m[1][2] * m[2][1];
    else
        det = m[1][1] * (m[2][2] * m[3][3] - m[2][3] * m[3][2]) - m[1][2] * (m[2][1] * m[3][3] - m[2][3] * m[3][1]) +
              m[1][3] * (m[2][1] * m[3][2] - m[2][2] * m[3][1]);
    for (int k = 1; k <= SPH_DIM; k++)
        for (int l = 1; l <= SPH_DIM; l++)
            size += a[k][l] * a[k][l];
    const double ball = 1e-3 * pow(sqrt(size / SPH_DIM), SPH_DIM), least = pow(0.01 * cover, SPH_DIM);
    o_close(s, "moments that are nearly singular", det, o_max(ball, least), 100 * o_max(ball, least));
    if (!(det > ball && det > least))
        return false;
    for (int k = SPH_DIM; k > 0; k--) /* the first row last: what is left of it is down */
        for (int r = 0; r < k; r++) {
            const double f = a[r][k] / a[k][k];
            for (int l = 0; l <= k; l++)
                a[r][l] -= f * a[k][l];
            b[r] -= f * b[k];
        }
    spread = a[0][0] / cover;
    o_close(s, "a particle far outside of its neighbours", spread, 0.05, 1);
    *x = b[0] / a[0][0];
    return spread > 0.05;
}

static void least_squares(o_scene *s, o_particle *i)
{
    const double h = s->cfg.smoothing_length;
    double a[4][4] = {{0}}, b[4] = {0}, scale = 0, x;
    for (uint32_t c = 0; c < s->m; c++) {
        const o_particle *j = &s->all[c];
        o_pair p;
        if (!o_is_body(s, j) || !o_same_material(s, i, j) || !o_pair_of(s, i, j, &p))
            continue;
        const double q[4] = {1, p.x[0] / h, p.x[1] / h, p.x[2] / h};
        for (int k = 0; k <= SPH_DIM; k++) {
            for (int l = 0; l <= SPH_DIM; l++)
                a[k][l] += p.volume * p.w * q[k] * q[l];
            b[k] += p.volume * p.w * j->d * q[k];
        }
        scale += p.volume * p.value;
    }
    const double cover = a[0][0], mean = b[0] / cover;
    const bool fine = first_unknown(s, a, b, &x);
    /* errors of b are turned into ones of the value by 1/down, and by the moments' inverse, whose size is below 100 */
    i->density = fine ? (o_sum){x, 400 * scale / a[0][0]} : (o_sum){mean, scale / cover};
}

void o_filter_density(o_scene *s)
{
    for (uint32_t a = 0; a < s->n && s->cfg.filter == SPH_MLS; a++)
        if (o_is_body(s, &s->own[a]))
            least_squares(s, &s->own[a]);
    for (uint32_t a = 0; a < s->n && s->cfg.filter != SPH_MLS; a++) {
        o_particle *i = &s->own[a];
        double cover = 0, sum = 0, scale = 0;
        for (uint32_t b = 0; b < s->m && o_is_body(s, i); b++) {
            const o_particle *j = &s->all[b];
            o_pair p;
            if (!o_is_body(s, j) || !o_same_material(s, i, j) || !o_pair_of(s, i, j, &p))
                continue;
            cover += p.volume * p.w;
            sum += p.volume * p.w * j->d;
            scale += p.volume * p.value;
        }
        /* errors of the weights move the mean by as much as the density varies; d itself is kept to rounding */
        i->density = cover > 0 ? (o_sum){sum / cover, scale / cover} : (o_sum){i->d, fabs(i->d)};
    }
    for (uint32_t a = 0; a < s->n; a++)
        if (o_is_body(s, &s->own[a]))
            s->own[a].d = s->own[a].density.v + o_shake(s);
    o_refresh(s);
}
