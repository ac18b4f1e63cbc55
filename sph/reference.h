/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* reference.h: reference positions, of the total-Lagrangian form (SPH_TOTAL in sph.h): the columns, the vector K that
   the kernel sees between two particles of one body, and the contact of two bodies. */
#ifndef SPH_REFERENCE_H
#define SPH_REFERENCE_H

#include "term.h"

#define SPH_REFERENCE_ROWS(n)                                                                                      \
    sph_real k[SPH_DIM][n]; /* reference position (m), from the home cell's low corner */                          \
    sph_real body[n]        /* the body's number + 1, 0: none */
typedef struct sph_reference_tile {
    SPH_REFERENCE_ROWS(SPH_NEAR_ROOM);
} sph_reference_tile;
typedef struct sph_reference_homes {
    SPH_REFERENCE_ROWS(SPH_HOME_ROOM);
} sph_reference_homes;

SPH_INLINE const sph_reference_tile *sph_reference_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_reference_tile *)(const void *)sph_near_columns_of(sim, t, SPH_COLUMN_reference);
}
SPH_INLINE const sph_reference_homes *sph_reference_homes_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_reference_homes *)(const void *)sph_home_columns_of(sim, t, SPH_COLUMN_reference);
}
#define sph_load_reference SPH_NAME(load_reference_)
void sph_load_reference(const sph_candidates *r, sph_real *to, uint32_t row);

/* where a home was, and of which body it is */
typedef struct sph_reference_home {
    vreal k[SPH_DIM], body;
} sph_reference_home;
SPH_INLINE sph_reference_home sph_spread_reference(const sph_reference_homes *r, uint32_t h)
{
    sph_reference_home o;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        o.k[k] = v_set(r->k[k][h]);
    o.body = v_set(r->body[h]);
    return o;
}

/* Between two particles of one body the kernel sees `to`, their distance in the reference position; between two
   bodies (apart) and all others, the distance dx that they have. */
SPH_INLINE void sph_reference_distance(const sph_reference_home *h, const sph_reference_tile *t, uint32_t j,
                                       const vreal *dx, vreal *to, vint *same, vint *apart)
{
    const vreal other = v_load(t->body + j), half = v_set((sph_real)0.5);
    *same = v_less(half, h->body) & v_equal(h->body, other);
    *apart = v_less(half, h->body) & v_less(half, other) & ~*same;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        to[k] = v_select(*same, h->k[k] - v_load(t->k[k] + j), dx[k]);
}

/* contact of two bodies: they push each other along x_ij, nearer than dx, as by a pressure rho0 c0^2 (W/W(dx) - 1) in
   both */
SPH_INLINE void sph_contact(const sph_choice *c, const sph_factors *f, const sph_home *h, sph_near *p, vreal *s)
{
    if (!SPH_HAS_TOTAL || !c->solid || !c->total || p->wall)
        return;
    const vreal push = v_where(p->apart, v_pos(k_value(c->kernel, p->q) * f->inv_wdx - 1)) * f->contact;
    p->force = sph_weak_scheme(c->scheme) ? push * h->inv_rho * p->inv_rho * p->mg : push * p->mg;
    if (SPH_WITH_BOOKS && c->books)
        s[SUM_IN_BONDS] = s[SUM_IN_BONDS] + p->force * sph_pair_share(c, h, p, p->ex, p->ve);
}

#endif
