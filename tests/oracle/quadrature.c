/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* quadrature.c: weights phi of particles beside flat faces of solids (option face_quadrature, sph_solid.flat_faces):
     Q_i = sum V_j K^2 g_ij/Q0    phi_i = 1 + beta sum V_j K^2 g_ij/Q0 (Q_j - Q_i), between 1/2 and 3/2
   V = m/rho0 at rest; Q over solids, not across two bodies of the total form; phi over those of flat sets that are both
   held or both free. Q0 is that of a full lattice of spacing dx. beta: on a half lattice, of rows r = 0, 1 ... below a
   face, sum (phi_r - 1) (r + delta_r) = -(1/24 + sum delta_r): what the midpoint rule and gradients that are one-sided
   miss (a gradient along the face, sum V K_t g u/sum V K_t^2 g, is of a place delta_r deeper where u goes as depth
   times K_t).
   A particle that has a weight keeps it. */
#include "oracle.h"

typedef struct lattice {
    double full, beta;
} lattice;

/* sums over the lattice around a place in row r; all rows are there from row 0 down (r 1e9: everywhere): of V K^2 g, of
   V K_t^2 g, and of the latter times how much deeper */
static void row_sums(const o_scene *s, int r, double *all, double *along, double *deep)
{
    const double dx = s->cfg.spacing, h = s->cfg.smoothing_length;
    const int n = (int)(s->support / dx) + 1, third = SPH_DIM == 3 ? n : 0;
    *all = *along = *deep = 0;
    for (int m = -n; m <= n; m++)
        for (int a = -n; a <= n; a++)
            for (int b = -third; b <= third; b++) {
                const double q = dx * sqrt(m * m + a * a + b * b);
                if (!(q > 0) || r + m < 0 || q > s->support * (1 - 1e-9)) /* an edge may be a step: beyond */
                    continue;
                const double g = o_weight_slope(s->cfg.kernel, q, h) / q * pow(dx, SPH_DIM);
                *all += q * q * g;
                *along += a * a * dx * dx * g;
                *deep += a * a * dx * dx * g * m;
            }
}

/* the layer m rows away: its part of V K^2 g */
static double layer(const o_scene *s, int m)
{
    double with, without, along, deep;
    row_sums(s, m, &with, &along, &deep); /* the row above has all but the layer m rows up */
    row_sums(s, m - 1, &without, &along, &deep);
    return with - without;
}

static lattice lattice_of(const o_scene *s)
{
    const int n = (int)(s->support / s->cfg.spacing) + 1;
    double along, deep, full, rows[3 * 32], delta[3 * 32], layers[32], missed = 1.0 / 24, moment = 0;
    row_sums(s, 1000000, &full, &along, &deep);
    for (int m = 1; m <= n; m++)
        layers[m] = layer(s, m);
    for (int r = 0; r <= 2 * n; r++) {
        row_sums(s, r, &rows[r], &along, &deep);
        delta[r] = deep / along;
        missed += delta[r];
    }
    for (int r = 0; r <= n; r++)
        for (int m = 1; m <= n; m++) { /* what a pair of rows gives the one it takes from the other */
            const double flow = layers[m] * (rows[r + m] - rows[r]) / (full * full);
            moment += flow * (r + delta[r]) - flow * (r + m + delta[r + m]);
        }
    return (lattice){full, -missed / moment};
}

static bool is_flat(const o_scene *s, const o_particle *p) { return o_is_solid(s, p) && s->set[p->set].flat; }

void o_weigh(o_scene *s)
{
    if (!s->cfg.face_quadrature)
        return;
    const lattice l = lattice_of(s);
    for (int turn = 0; turn < 2; turn++) {
        o_copies(s);
        for (uint32_t a = 0; a < s->n; a++) {
            o_particle *i = &s->own[a];
            o_sum sum = {0, 0};
            for (uint32_t b = 0; b < s->m; b++) {
                const o_particle *j = &s->all[b];
                o_pair p;
                if (!o_is_solid(s, i) || !o_is_solid(s, j) || !o_pair_of(s, i, j, &p) || p.apart)
                    continue;
                const double v = s->set[j->set].mass / s->set[j->set].rho0 / l.full, more = j->cover - i->cover;
                const bool pair = is_flat(s, j) && !s->set[i->set].held == !s->set[j->set].held;
                if (turn == 0)
                    o_plus(&sum, v * p.q * p.q * p.g);
                else if (pair)
                    o_add(&sum, v * p.q * p.q * p.g * more,
                          fabs(v) * p.q * p.slope * (fabs(j->cover) + fabs(i->cover)));
            }
            if (turn == 0)
                i->cover = sum.v;
            else if (is_flat(s, i) && !(i->phi.v > 0))
                i->phi = (o_sum){1 + o_max(-0.5, o_min(0.5, l.beta * sum.v)), 1 + fabs(l.beta) * sum.s};
        }
    }
    o_copies(s);
}
