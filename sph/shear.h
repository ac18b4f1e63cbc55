/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shear.h: the viscous stress of fluids, in the force loop; shear.c makes it of the gradient of the velocity. With the
   stress tau of each particle (tension positive):

     a_i += m_j (T_i + T_j) x_ij g,  T = tau/rho^2 (weak scheme: tau, and the pair divides by rho_i rho_j)
                                     (Wickramarachchi 2009 eqs 5.11, 5.33; the first is the divergence of 5.4, 5.5)
     corrected gradients: T = tau B/rho^2, which does the same work on the corrected gradient of the velocity

   so what the forces of a pair in matter take is the sum of tau : grad v over both, and momenta stay. Against a wall
   without slip T_j = T_i: the stress goes on into it as it is. The wall's work is on the books as that of every force;
   what it takes beside tau : (the part of grad v that the wall gives) is in_walls. Free slip: nothing. */
#ifndef SPH_SHEAR_H
#define SPH_SHEAR_H

#include "viscosity.h"

/* what a home brings: T, and what the time step shall see of its eddy viscosity as |mu| (shear.c) */
typedef struct sph_shear_home {
    vreal t[SPH_NL], mu;
} sph_shear_home;

SPH_INLINE sph_shear_home sph_spread_shear(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_real *const own = sph_home_columns_of(sim, t, SPH_COLUMN_shear);
    const bool matter = sph_is_matter(&sim->set[t->home_set[h]]); /* ghosts have no place in the array */
    sph_shear_home o;
    SPH_UNROLL_MANY
    for (uint32_t k = 0; k < SPH_NL; k++)
        o.t[k] = v_set(matter ? own[k * SPH_HOME_ROOM + h] : 0);
    o.mu = v_set(matter ? own[SPH_NL * SPH_HOME_ROOM + h] : 0);
    return o;
}

/* the books; push: what the pair adds to the sum of accelerations (a = -slope times that sum) */
SPH_INLINE void sph_shear_power(const sph_choice *c, const sph_home *h, const sph_mirror_tile *m, sph_near *p,
                                const vreal *push, vreal *s)
{
    if (!SPH_WITH_BOOKS || !c->books)
        return;
    if (!p->wall) {
        s[SUM_VISCOUS] = s[SUM_VISCOUS] + sph_pair_share(c, h, p, push, sph_dot(push, p->dv));
        return;
    }
    vreal v[SPH_DIM];
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = v_load(p->tile->v[k] + p->j);
    sph_mirror_velocity(h, m, p);
    const vreal heat = sph_dot(push, p->dw) * (sph_real)0.5;
    s[SUM_VISCOUS] = s[SUM_VISCOUS] + heat;
    s[SUM_IN_WALLS] = s[SUM_IN_WALLS] + (sph_dot(push, p->dv) - heat);
    s[SUM_WALL] = s[SUM_WALL] + sph_dot(push, v);
}

/* row: the candidates' T */
SPH_INLINE void sph_shear_force(const sph_choice *c, const sph_home *h, const sph_mirror_tile *m,
                                const sph_shear_home *o, const sph_real *row, sph_near *p, vreal *s)
{
    if (!SPH_WITH_SHEAR || !c->shear)
        return;
    vreal push[SPH_DIM], w = sph_weak_scheme(c->scheme) ? p->mg * h->inv_rho * p->inv_rho : p->mg;
    if (p->wall)
        w = w * v_load(m->vis + p->j);
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        push[k] = v_set(0);
        SPH_UNROLL
        for (uint32_t l = 0; l < SPH_DIM; l++) {
            const uint32_t n = k * SPH_DIM + l;
            const vreal other = p->wall ? o->t[n] : v_load(row + n * SPH_NEAR_ROOM + p->j);
            push[k] = push[k] - (o->t[n] + other) * p->dx[l];
        }
        push[k] = push[k] * w;
        s[SUM_ACC + k] = s[SUM_ACC + k] + push[k];
    }
    s[SUM_MU] = v_max(s[SUM_MU], o->mu);
    sph_shear_power(c, h, m, p, push, s);
}

#define sph_load_shear SPH_NAME(load_shear_)
void sph_load_shear(const sph_candidates *r, sph_real *to, uint32_t row);

#endif
