/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* mirror.h: the columns of ghosts: what viscosity needs to mirror a velocity in a wall (Gray 2001 eqs 2.42, 2.43). */
#ifndef SPH_MIRROR_H
#define SPH_MIRROR_H

#include "term.h"

typedef struct sph_mirror_tile {
    sph_real n[SPH_DIM][SPH_NEAR_ROOM]; /* normal into the fluid */
    sph_real u[SPH_DIM][SPH_NEAR_ROOM]; /* velocity for the viscosity (Adami) */
    sph_real depth[SPH_NEAR_ROOM];      /* distance behind the wall, 0: no mirror velocity */
    sph_real vis[SPH_NEAR_ROOM];        /* 1: viscosity acts, 0: free slip */
} sph_mirror_tile;

SPH_INLINE const sph_mirror_tile *sph_mirror_of(const sph_sim *sim, const sph_thread *t)
{
    return (const sph_mirror_tile *)(const void *)sph_near_columns_of(sim, t, SPH_COLUMN_mirror);
}
#define sph_load_mirror SPH_NAME(load_mirror_)
void sph_load_mirror(const sph_candidates *r, sph_real *to, uint32_t row);

#endif
