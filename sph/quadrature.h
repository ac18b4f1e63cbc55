/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* quadrature.h: weights phi of particles beside flat faces of solids (face_quadrature in sph.h): the columns of the
   two sums that make them, and what the stress and the books ask. Equations: quadrature.c. */
#ifndef SPH_QUADRATURE_H
#define SPH_QUADRATURE_H

#include "reference.h"

/* rows of set `quadrature`: volume at rest (m^DIM; 0: no solid), whom it is weighed with (0: nobody); of set `cover`:
   Q */
#define SPH_VOLUME_ROW(columns, row) (columns)
#define SPH_KIND_ROW(columns, row) ((columns) + (row))
#define sph_load_quadrature SPH_NAME(load_quadrature_)
void sph_load_quadrature(const sph_candidates *r, sph_real *to, uint32_t row);
#define sph_load_cover SPH_NAME(load_cover_)
void sph_load_cover(const sph_candidates *r, sph_real *to, uint32_t row);

/* phi of W particles from index i on, where the scene has it; 0 is kept of those that nobody weighs */
SPH_INLINE vreal sph_quadrature_at(const sph_buffer *b, uint32_t i)
{
    const vreal phi = v_load(b->quadrature[0] + i);
    return v_select(v_less(v_set(0), phi), phi, v_set(1));
}

#endif
