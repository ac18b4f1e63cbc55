/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stabilised.h: stabilised SPH, a form of solids that holds in tension (Powell 2012 section 4.2, eqs 4.9-4.18,
   algorithms 4.1, 4.2), in the force loop. With V = m/rho, T as in stress.h and W~ the kernel that the sums S, D of
   the first forces normalise (4.18):

     a_ij   = grad_i W~_ij = (g x_ij S_i - W_ij D_i)/S_i^2,  S_i = sum V_j W_ij,  D_i = sum V_j grad_i W_ij
     C_ij   = V_j a_ij - w_ij (row_i - mean_i) - w_ij col_j,  so that sum_j C_ij = 0
     row_i  = sum V_j a_ij/n_i,  col_i = V_i sum a_ji/n_i,  mean_i = sum w_ij col_j/n_i,  n_i = sum w_ij
     w_ij   = (1 + [level_j > level_i] - [level_j < level_i]) times 1 within the support, 0 beyond

   w counts neighbours deeper inside twice, those further out not at all (figure 4.3). At the support's end it falls
   over a tenth of h: counts that jump would hang on rounding. What C_ij has beside V_j a_ij is added to the force of
   the plain form (4.13-4.15), on components along axes in tension (`on`: sum of sigma_kk of the neighbours above 0),
   never of the outermost layer (4.17). Each pair's force is made antisymmetric (algorithm 4.2), with masses, so
   momentum stays (the printed form keeps it for equal masses only):

     a_i,k -= sum_j m_j sum_l (T_i + T_j)_kl (g x_ij + (on_i,k (C_ij/V_j - a_ij) - on_j,k (C_ji/V_i - a_ji))/2)_l

   Energy is not kept: `unbalanced` in the books. Of fluids S = 1, D = 0 and nothing is on. */
#ifndef SPH_STABILISED_H
#define SPH_STABILISED_H

#include "stress.h"

/* rows of column sets: what is fixed with the first forces; col and the level; row - mean, and what is on */
#define SPH_EDGE_ROWS(n)                                                                                           \
    sph_real u[n];          /* 1/S */                                                                              \
    sph_real d[SPH_DIM][n]; /* D/S^2 (1/m) */                                                                      \
    sph_real level[n]
#define SPH_DRAWN_ROWS(n)                                                                                          \
    sph_real col[SPH_DIM][n];                                                                                      \
    sph_real level[n]
#define SPH_MEAN_ROWS(n)                                                                                           \
    sph_real e[SPH_DIM][n];                                                                                        \
    sph_real on[SPH_DIM][n]
typedef struct sph_edge_tile {
    SPH_EDGE_ROWS(SPH_NEAR_ROOM);
} sph_edge_tile;
typedef struct sph_edge_homes {
    SPH_EDGE_ROWS(SPH_HOME_ROOM);
} sph_edge_homes;
typedef struct sph_drawn_tile {
    SPH_DRAWN_ROWS(SPH_NEAR_ROOM);
} sph_drawn_tile;
typedef struct sph_drawn_homes {
    SPH_DRAWN_ROWS(SPH_HOME_ROOM);
} sph_drawn_homes;
typedef struct sph_mean_tile {
    SPH_MEAN_ROWS(SPH_NEAR_ROOM);
} sph_mean_tile;
typedef struct sph_mean_homes {
    SPH_MEAN_ROWS(SPH_HOME_ROOM);
} sph_mean_homes;
#define sph_load_edge SPH_NAME(load_edge_)
void sph_load_edge(const sph_candidates *r, sph_real *to, uint32_t row);
#define sph_load_drawn SPH_NAME(load_drawn_)
void sph_load_drawn(const sph_candidates *r, sph_real *to, uint32_t row);
#define sph_load_means SPH_NAME(load_means_)
void sph_load_means(const sph_candidates *r, sph_real *to, uint32_t row);

/* what candidates and homes bring */
typedef struct sph_stabilised_near {
    const sph_drawn_tile *drawn;
    const sph_mean_tile *mean;
} sph_stabilised_near;
typedef struct sph_stabilised_home {
    vreal level, col[SPH_DIM], e[SPH_DIM], on[SPH_DIM];
    vreal each; /* 1/V_i (1/m^DIM) */
} sph_stabilised_home;

SPH_INLINE const sph_edge_tile *sph_edge_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_edge_tile *)(const void *)sph_near_columns_of(sim, t, SPH_COLUMN_edge);
}
SPH_INLINE const sph_edge_homes *sph_edge_homes_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_edge_homes *)(const void *)sph_home_columns_of(sim, t, SPH_COLUMN_edge);
}
SPH_INLINE const sph_drawn_tile *sph_drawn_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_drawn_tile *)(const void *)sph_near_columns_of(sim, t, SPH_COLUMN_drawn);
}
SPH_INLINE const sph_drawn_homes *sph_drawn_homes_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_drawn_homes *)(const void *)sph_home_columns_of(sim, t, SPH_COLUMN_drawn);
}
SPH_INLINE sph_stabilised_near sph_stabilised_of(const sph_sim *sim, const sph_thread *t)
{
    return (sph_stabilised_near){sph_drawn_of(sim, t),
                                 (const sph_mean_tile *)(const void *)sph_near_columns_of(sim, t, SPH_COLUMN_means)};
}
/* whether anybody in a tile, or a home, is on */
#define sph_is_drawn SPH_NAME(is_drawn_)
bool sph_is_drawn(const sph_sim *sim, const sph_thread *t, uint32_t homes);
SPH_INLINE sph_stabilised_home sph_spread_stabilised(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_drawn_homes *const drawn = sph_drawn_homes_of(sim, t);
    const sph_mean_homes *const mean = (const void *)sph_home_columns_of(sim, t, SPH_COLUMN_means);
    sph_stabilised_home o;
    o.level = v_set(drawn->level[h]);
    o.each = v_set(t->home.rho[h] / t->home.m[h]);
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        o.col[k] = v_set(drawn->col[k][h]);
        o.e[k] = v_set(mean->e[k][h]);
        o.on[k] = v_set(mean->on[k][h]);
    }
    return o;
}

/* w_ij; *back: w_ji */
SPH_INLINE vreal sph_stabilised_count(vreal reach, vreal q, vreal own, vreal other, vreal *back)
{
    const vreal one = v_set(1), within = one - v_pos(one - v_pos(reach - q) * 10);
    const vreal deeper = v_where(v_less(own, other), one) - v_where(v_less(other, own), one);
    *back = within * (one - deeper);
    return within * (one + deeper);
}

/* What a pair of bodies adds to sph_stress_push; w: 1, or 1/(rho_i rho_j) in the weak scheme. Gradients have the
   scale of k_slope: col and e were divided by the kernel's slope. */
SPH_INLINE void sph_stabilised_push(const sph_choice *c, const sph_factors *f, const sph_stress_home *st,
                                    const sph_stress_tile *t, const sph_stabilised_home *h,
                                    const sph_stabilised_near *n, sph_near *p, vreal w, vreal *s)
{
    const uint32_t j = p->j;
    const vreal m = v_load(p->tile->m + j), each = h->each * m;
    vreal back, half = v_set((sph_real)0.5) * w, own[SPH_DIM], other[SPH_DIM];
    const vreal count = sph_stabilised_count(v_set(f->reach), p->q, h->level, v_load(n->drawn->level + j), &back);
    const vreal by = count * p->rho, from = back * each;
    SPH_UNROLL
    for (uint32_t l = 0; l < SPH_DIM; l++) {
        own[l] = by * (h->e[l] + v_load(n->drawn->col[l] + j));
        other[l] = from * (v_load(n->mean->e[l] + j) + h->col[l]);
    }
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        const vreal on = h->on[k], theirs = v_load(n->mean->on[k] + j);
        vreal a = v_set(0);
        SPH_UNROLL
        for (int l = 0; l < SPH_DIM; l++)
            a = a + sph_stress_sum(c, st, t, p, k, l, v_set(0)) * (theirs * other[l] - on * own[l]);
        p->push[k] = p->push[k] + a * half;
        s[SUM_ACC + k] = s[SUM_ACC + k] + a * half;
    }
}

#endif
