/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* hourglass.h: control of hourglass modes of the total-Lagrangian form, in the force loop (after Ganzenmueller 2015,
   Comput. Methods Appl. Mech. Engrg. 286). F_i maps the bonds of a particle to where they are, by least squares:
   F = M A^-1, M = -sum m_j x_ij (x) K g, A = -sum m_j K (x) K g. What of a bond F does not explain stores energy,

     E_i = (m_i/2) k_i sum m_j (-g) |x_ij - F_i K|^2,  k = hourglass E/rho0^2, E Young's modulus
     a_i += sum m_j g (k_i (x_ij - F_i K) + k_j (x_ij - F_j K))

   Ganzenmueller weighs a bond by W/K^2 and pushes along x_ij; with the weights of the least squares F does not enter
   the derivative of E, so these forces are exactly that of E: momentum, angular momentum and energy stay. What is
   stored is in `in_bonds` of the books. A body that is deformed uniformly, or turned, feels nothing. */
#ifndef SPH_HOURGLASS_H
#define SPH_HOURGLASS_H

#include "reference.h"

#define SPH_DEFORM_ROWS(n)                                                                                         \
    sph_real f[SPH_NL][n]; /* F */                                                                                 \
    sph_real k[n]          /* k (Pa m^6/kg^2); 0: F is not known */
typedef struct sph_deform_tile {
    SPH_DEFORM_ROWS(SPH_NEAR_ROOM);
} sph_deform_tile;
typedef struct sph_deform_homes {
    SPH_DEFORM_ROWS(SPH_HOME_ROOM);
} sph_deform_homes;
#define sph_load_deform SPH_NAME(load_deform_)
void sph_load_deform(const sph_candidates *r, sph_real *to, uint32_t row);

typedef struct sph_deform_home {
    vreal f[SPH_NL], k;
} sph_deform_home;
SPH_INLINE sph_deform_home sph_spread_deform(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_deform_homes *const own = (const void *)sph_home_columns_of(sim, t, SPH_COLUMN_deform);
    sph_deform_home o;
    SPH_UNROLL_MANY
    for (uint32_t k = 0; k < SPH_NL; k++)
        o.f[k] = v_set(own->f[k][h]);
    o.k = v_set(own->k[h]);
    return o;
}

SPH_INLINE void sph_hourglass(const sph_choice *c, const sph_home *o, const sph_reference_home *was,
                              const sph_reference_tile *other, const sph_deform_home *h, const sph_deform_tile *t,
                              const sph_near *p, vreal *s)
{
    if (!SPH_HAS_HOURGLASS || !c->hourglass || p->wall)
        return;
    const vint same = v_less(v_set((sph_real)0.5), was->body) & v_equal(was->body, v_load(other->body + p->j));
    const vreal kj = v_load(t->k + p->j);
    vreal push[SPH_DIM];
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        vreal own = p->dx[k], theirs = p->dx[k];
        SPH_UNROLL
        for (int l = 0; l < SPH_DIM; l++) {
            own = own - h->f[k * SPH_DIM + l] * p->kx[l];
            theirs = theirs - v_load(t->f[k * SPH_DIM + l] + p->j) * p->kx[l];
        }
        push[k] = v_where(same, -(p->mg * (h->k * own + kj * theirs)));
        s[SUM_ACC + k] = s[SUM_ACC + k] + push[k];
    }
    if (SPH_WITH_BOOKS && c->books)
        s[SUM_IN_BONDS] = s[SUM_IN_BONDS] + sph_pair_share(c, o, p, push, sph_dot(push, p->dv));
}

#endif
