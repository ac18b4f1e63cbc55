/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* reading.h: what reading.c, totals.c and probes.c share. They add no array; sums run in index order in double
   precision, so they are the same on every machine. */
#ifndef SPH_READING_H
#define SPH_READING_H

#include "internal.h"

/* where particle i of a buffer is (m) */
SPH_INLINE void sph_position(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *x)
{
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
}

/* whether it is fluid or solid, and there */
SPH_INLINE bool sph_body_at(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const uint8_t s = b->set[0][i];
    return s != SPH_DEAD && sph_is_matter(&sim->set[s]);
}

/* its equivalent plastic strain */
SPH_INLINE double sph_plastic_at(const sph_buffer *b, uint32_t i)
{
    return SPH_HAS_YIELD && b->plastic[0] ? (double)b->plastic[0][i] : 0;
}

#endif
