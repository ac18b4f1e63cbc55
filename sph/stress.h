/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stress.h: the stress of solids in the force loop (SPH_UPDATED ... in sph.h). T is stored as pressure is, positive
   in compression, so that a pair adds to the sum of accelerations what pressure does:

     force      a_i -= m_j (T_i + T_j + (R_i + R_j) (W/W(dx))^n) . K g    (Gray 2001 eqs 5.9, 5.21)
     gradient   sum m_j v_ij (x) K g, from which stress.c makes the rates

   T is -sigma/rho^2; with corrected gradients -sigma M^-T/rho; in the weak scheme the same without rho, and the pair
   divides by rho_i rho_j. R is the artificial stress, on tension. */
#ifndef SPH_STRESS_H
#define SPH_STRESS_H

#include "smoothed.h"

#define SPH_STRESS_ROWS(n)                                                                                         \
    sph_real t[SPH_NL][n]; /* T */                                                                                 \
    sph_real r[SPH_NT][n]  /* R */
typedef struct sph_stress_tile {
    SPH_STRESS_ROWS(SPH_NEAR_ROOM);
} sph_stress_tile;
typedef struct sph_stress_homes {
    SPH_STRESS_ROWS(SPH_HOME_ROOM);
} sph_stress_homes;

SPH_INLINE const sph_stress_tile *sph_stress_tile_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_stress_tile *)(const void *)sph_near_columns_of(sim, t, SPH_COLUMN_stress);
}
SPH_INLINE const sph_stress_homes *sph_stress_homes_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_stress_homes *)(const void *)sph_home_columns_of(sim, t, SPH_COLUMN_stress);
}
#define sph_load_stress SPH_NAME(load_stress_)
void sph_load_stress(const sph_candidates *r, sph_real *to, uint32_t row);
#define sph_load_diagonal SPH_NAME(load_diagonal_)
void sph_load_diagonal(const sph_candidates *r, sph_real *to, uint32_t row);
/* stress.c: L of a home from its sums, with corrected gradients or without; raw: sum m_j v_ij (x) K g without the
   kernel's scale */
#define sph_velocity_gradient SPH_NAME(velocity_gradient_)
void sph_velocity_gradient(const sph_sim *sim, uint32_t i, const sph_real *raw, sph_real rho, bool corrects,
                           sph_real (*l)[SPH_DIM]);

/* stress.c: dS/dt of home i in a velocity gradient L, and -tr L */
#define sph_stress_rates SPH_NAME(stress_rates_)
sph_real sph_stress_rates(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real (*l)[SPH_DIM]);

/* books: by how much more the elastic energy S:S/(4 mu) of a unit of rest volume rises than forces give, W/kg:
   S:e/rho0 - S:e/rho */
#define sph_stress_surplus SPH_NAME(stress_surplus_)
sph_real sph_stress_surplus(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real *raw, sph_real rho);

typedef struct sph_stress_home {
    vreal t[SPH_NL], r[SPH_NT], u[SPH_DIM]; /* u: velocity that strain rates see */
} sph_stress_home;
SPH_INLINE sph_stress_home sph_spread_stress(const sph_choice *c, const sph_stress_homes *st, const sph_real *u,
                                             uint32_t h)
{
    sph_stress_home o;
    SPH_UNROLL_MANY
    for (int k = 0; k < SPH_NL; k++)
        o.t[k] = v_set(sph_takes_forces(c) ? st->t[k][h] : 0);
    SPH_UNROLL
    for (int k = 0; k < SPH_NT; k++)
        o.r[k] = v_set(c->repulsion ? st->r[k][h] : 0);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        o.u[k] = v_set(c->hat ? u[(uint32_t)k * SPH_HOME_ROOM + h] : 0);
    return o;
}

/* a small power by squaring; n is a constant in the fast paths */
SPH_INLINE vreal sph_small_power(vreal f, uint32_t n)
{
    vreal p = n & 1 ? f : v_set(1);
    const vreal f2 = f * f, f4 = f2 * f2;
    if (n & 2)
        p = p * f2;
    if (n & 4)
        p = p * f4;
    return n & 8 ? p * (f4 * f4) : p;
}

/* T_i + T_j + (R_i + R_j) f^n, component k, l; a wall's is its pressure */
SPH_INLINE vreal sph_stress_sum(const sph_choice *c, const sph_stress_home *h, const sph_stress_tile *t,
                                const sph_near *p, int k, int l, vreal fn)
{
    vreal sum = h->t[k * SPH_DIM + l];
    if (!p->wall)
        sum = sum + v_load(t->t[k * SPH_DIM + l] + p->j);
    else if (k == l)
        sum = sum + p->press;
    if (c->repulsion && !p->wall)
        sum = sum + (h->r[sph_sym[k][l]] + v_load(t->r[sph_sym[k][l]] + p->j)) * fn;
    return sum;
}

/* books: component k of what the home's energy gains, T_i : (v_ij (x) K); d: w times the velocity that it sees */
SPH_INLINE void sph_stress_gain(const sph_choice *c, const sph_stress_home *h, sph_near *p, int k, vreal d)
{
    if (!SPH_WITH_BOOKS || !c->books || !c->loses)
        return;
    p->gain = k ? p->gain : v_set(0);
    SPH_UNROLL
    for (int l = 0; l < SPH_DIM; l++)
        p->gain = p->gain + h->t[k * SPH_DIM + l] * p->kx[l] * d;
}

/* books: the part of the artificial stress is taken out of `push`, and has a power of its own; fw: w f^n */
SPH_INLINE void sph_repulsion_power(const sph_choice *c, const sph_home *o, const sph_stress_home *h,
                                    const sph_stress_tile *t, sph_near *p, vreal fw, vreal *s)
{
    if (!SPH_WITH_BOOKS || !c->books || !c->repulsion || p->wall)
        return;
    vreal r[SPH_DIM];
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        r[k] = v_set(0);
        SPH_UNROLL
        for (int l = 0; l < SPH_DIM; l++) {
            const uint32_t n = sph_sym[k][l];
            r[k] = r[k] + (h->r[n] + v_load(t->r[n] + p->j)) * p->kx[l];
        }
        r[k] = r[k] * fw;
        p->push[k] = p->push[k] - r[k];
    }
    s[SUM_IN_BONDS] = s[SUM_IN_BONDS] + sph_pair_share(c, o, p, r, sph_dot(r, p->dv));
}

/* component k of the force of T_i + T_j, which w weighs */
SPH_INLINE void sph_stress_push(const sph_choice *c, const sph_stress_home *h, const sph_stress_tile *t,
                                sph_near *p, int k, vreal fn, vreal w, vreal *s)
{
    vreal a = v_set(0);
    SPH_UNROLL
    for (int l = 0; l < SPH_DIM; l++) {
        const vreal sum = sph_stress_sum(c, h, t, p, k, l, fn);
        a = l ? a + sum * p->kx[l] : sum * p->kx[l];
    }
    p->push[k] = a * w;
    s[SUM_ACC + k] = s[SUM_ACC + k] + p->push[k];
}

/* the weights of a pair: of its force, of the gradient's sum, of what the home gains; normalised: m_j g is in K */
typedef struct sph_stress_weights {
    vreal force, gradient, gain;
} sph_stress_weights;
SPH_INLINE sph_stress_weights sph_weigh_stress(const sph_choice *c, const sph_home *o, const sph_near *p)
{
    const bool weak = sph_weak_scheme(c->scheme);
    sph_stress_weights w;
    if (sph_normalised(c)) {
        w.gradient = p->inv_rho;
        w.force = weak ? p->inv_rho * o->inv_rho : v_set(1);
        w.gain = weak ? w.force : o->rho * p->inv_rho;
        return w;
    }
    w.gradient = weak ? p->mg * p->inv_rho : p->mg;
    w.force = w.gain = weak ? w.gradient * o->inv_rho : p->mg;
    return w;
}

SPH_INLINE void sph_stress_force(const sph_choice *c, const sph_factors *f, const sph_home *o, const sph_stress_home *h,
                                 const sph_stress_tile *t, const sph_real *u, sph_near *p, vreal *s)
{
    if (!SPH_WITH_SOLID || !c->solid)
        return;
    const sph_stress_weights by = sph_weigh_stress(c, o, p);
    const vreal wl = by.gradient, w = by.force;
    vreal fn = v_set(0);
    if (c->repulsion && !p->wall)
        fn = sph_small_power(k_value(c->kernel, p->q) * f->inv_wdx, c->repulsion);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        if (sph_takes_forces(c))
            sph_stress_push(c, h, t, p, k, fn, w, s);
        if (!sph_takes_rates(c) && !(SPH_WITH_BOOKS && c->books) && !c->edge) /* those ask for the gradient too */
            continue;
        vreal d = p->dv[k];
        if (c->hat)
            d = h->u[k] - (p->wall ? v_load(p->tile->v[k] + p->j) : v_load(u + (uint32_t)k * SPH_NEAR_ROOM + p->j));
        sph_stress_gain(c, h, p, k, d * by.gain);
        d = d * wl;
        SPH_UNROLL
        for (int l = 0; l < SPH_DIM; l++)
            s[SUM_GRADIENT + k * SPH_DIM + l] = s[SUM_GRADIENT + k * SPH_DIM + l] + d * p->kx[l];
    }
    sph_repulsion_power(c, o, h, t, p, fn * w, s);
}

#endif
