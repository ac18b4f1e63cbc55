/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* pair.h: what a pair of particles is to the formulas: a home, a group of SPH_W candidates, and the sums of the home.
   The loops that make pairs are here too: sph_sum_home, for the forces (forces.c) and for every neighbour sum that a
   module has for itself (a gather: adami.c, density.c, correction.c, smoothing.c).

   With x_ij = x_i - x_j, v_ij = v_i - v_j, g = (dW/dr)/r: grad W = g x_ij. K is the vector that the kernel sees:
   x_ij, or what a form of the equations puts in its place. */
#ifndef SPH_PAIR_H
#define SPH_PAIR_H

#include "kernels.h"
#include "passes.h"
#include "sweep.h"
#include "tensor.h"

/* Vectors whose sums a home holds at a time: all that make up the eight lanes; where a register holds one real, lane
   after lane, so that the sums of one stay in registers. The order within a lane is the same. */
#define SPH_AT_ONCE (SPH_SCALAR ? 1 : SPH_NV)

/* A pair function adds what candidates j .. j + SPH_W - 1 of a tile give to the sums s of a home. */
typedef void (*sph_pair_fn)(const void *what, uint32_t j, vreal *s);

/* One home over n candidates: the sums of the mask `sums` (bits 1 << row) go through registers. Candidate
   k adds to lane k mod 8, in order. Always inlined, like the function that it is given, so that no call is left. */
SPH_INLINE void sph_sum_lanes(sph_thread *t, uint32_t h, uint32_t n, uint32_t sums, sph_pair_fn pair, const void *what)
{
    vreal s[SPH_AT_ONCE][SPH_SUMS];
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_AT_ONCE; k++)
        SPH_UNROLL_MANY
        for (uint32_t a = 0; a < SPH_SUMS; a++) /* never read where not asked for; constants make this vanish */
            s[k][a] = v_set(0);
    for (uint32_t from = 0; from < SPH_LANES; from += SPH_AT_ONCE * SPH_W) {
        SPH_UNROLL_MANY
        for (uint32_t a = 0; a < SPH_SUMS; a++)
            SPH_UNROLL
            for (uint32_t k = 0; k < SPH_AT_ONCE; k++)
                if (sums >> a & 1)
                    s[k][a] = v_load(t->sum[a][h] + from + k * SPH_W);
        for (uint32_t j = from; j < n; j += SPH_LANES) {
            SPH_UNROLL
            for (uint32_t k = 0; k < SPH_AT_ONCE; k++)
                pair(what, j + k * SPH_W, s[k]);
        }
        SPH_UNROLL_MANY
        for (uint32_t a = 0; a < SPH_SUMS; a++)
            SPH_UNROLL
            for (uint32_t k = 0; k < SPH_AT_ONCE; k++)
                if (sums >> a & 1)
                    v_store(t->sum[a][h] + from + k * SPH_W, s[k][a]);
    }
}

/* Where candidates were not sifted, and a machine has the bits of a mask at once, vectors in which nobody is within the
   kernel's reach are left out; all their terms are 0. Either they are found before pairs are made (lists), or a pair
   function leaves when it sees that (skips). A skip is a branch that is often foretold wrong: it pays where a pair
   costs much, as rates and forces in one sweep do, and the more the wider a vector is. */
#define SPH_LISTS (SPH_HAS_QUICK_BITS && !SPH_SCALAR && !SPH_SIFTS && SPH_W <= 4)
#define SPH_SKIPS (SPH_HAS_QUICK_BITS && !SPH_SCALAR && !SPH_SIFTS && SPH_W >= 4)
_Static_assert(!SPH_LISTS || SPH_TILE <= 256, "places in a list are bytes");

/* lists the vectors of a tile, of lanes from .. from + SPH_W - 1, that have somebody within reach of a home; returns
   how many they are */
SPH_INLINE uint32_t sph_list_vectors(const sph_thread *t, const sph_tile *tile, uint32_t h, uint32_t from,
                                     vreal reach2, uint8_t *list)
{
    vreal x[SPH_DIM];
    uint32_t found = 0;
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++)
        x[k] = v_set(t->home.x[k][h]);
    for (uint32_t j = from; j < tile->n; j += SPH_LANES) {
        vreal dx[SPH_DIM];
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            dx[k] = x[k] - v_load(tile->x[k] + j);
        list[found] = (uint8_t)j;
        found += v_bits(v_less(reach2, sph_dot(dx, dx))) != (1u << SPH_W) - 1;
    }
    return found;
}
/* as sph_sum_lanes, of those vectors alone */
SPH_INLINE void sph_sum_listed(const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t h, uint32_t sums,
                               sph_pair_fn pair, const void *what)
{
    uint8_t list[SPH_TILE / SPH_LANES + 1];
    const vreal reach2 = v_set(sim->fac.reach2);
    if (SPH_HAS_SIDES && tile == &t->ghosts && sim->sided && !sph_is_acted_on(sim, t, h))
        return;
    for (uint32_t from = 0; from < SPH_LANES; from += SPH_W) {
        const uint32_t found = sph_list_vectors(t, tile, h, from, reach2, list);
        vreal s[SPH_SUMS];
        SPH_UNROLL_MANY
        for (uint32_t a = 0; a < SPH_SUMS; a++)
            s[a] = sums >> a & 1 ? v_load(t->sum[a][h] + from) : v_set(0);
        for (uint32_t i = 0; i < found; i++)
            pair(what, list[i], s);
        SPH_UNROLL_MANY
        for (uint32_t a = 0; a < SPH_SUMS; a++)
            if (sums >> a & 1)
                v_store(t->sum[a][h] + from, s[a]);
    }
}

/* what a pair function reads of a tile: its candidates, or those of them that are neighbours */
SPH_INLINE const sph_near_tile *sph_near_of(const sph_thread *t, const sph_tile *tile)
{
#if SPH_SIFTS
    (void)tile;
    return &t->sifted.near;
#else
    (void)t;
    return tile;
#endif
}
/* One home over one tile. `what` may point to sph_near_of the tile and to sph_near_columns_of it. */
SPH_INLINE void sph_sum_home(const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t h, uint32_t sums,
                             sph_pair_fn pair, const void *what)
{
    if (SPH_HAS_SIDES && tile == &t->ghosts && sim->sided && !sph_is_acted_on(sim, t, h))
        return;
    if (!SPH_SIFTS) {
        sph_sum_lanes(t, h, tile->n, sums, pair, what);
        return;
    }
    const uint32_t found = sph_find_neighbours(sim, t, tile, h);
    for (uint32_t from = 0; from < found; from += SPH_NEAR_ROOM)
        sph_sum_lanes(t, h, sph_take_neighbours(sim, t, tile, from, found), sums, pair, what);
}

/* ---- gathers: sums over neighbours beside the forces ---- */

/* what a gather's pair function gets: home h, the tile, and what the module wants to know of its scene */
typedef struct sph_gather {
    const sph_thread *t;
    const sph_near_tile *tile;
    uint32_t h, kernel;
    vreal inv_h;
    const void *own;
} sph_gather;

/* distances x_ij of a group of candidates */
SPH_INLINE void sph_gather_distance(const sph_gather *g, uint32_t j, vreal *dx)
{
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        dx[k] = v_set(g->t->home.x[k][g->h]) - v_load(g->tile->x[k] + j);
}
/* (dW/dr)/r without the scale of the kernel */
SPH_INLINE vreal sph_gather_slope(const sph_gather *g, const vreal *dx)
{
    return k_slope(g->kernel, v_sqrt(sph_dot(dx, dx)) * g->inv_h);
}
/* W_ij without the scale of the kernel */
SPH_INLINE vreal sph_gather_value(const sph_gather *g, const vreal *dx)
{
    return k_value(g->kernel, v_sqrt(sph_dot(dx, dx)) * g->inv_h);
}

/* all homes over one tile: the sums of the mask go up by what `pair` adds */
SPH_INLINE void sph_gather_by(uint32_t kernel, const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t homes,
                              uint32_t sums, sph_pair_fn pair, const void *own)
{
    for (uint32_t h = 0; h < homes; h++) {
        const sph_gather g = {t, sph_near_of(t, tile), h, kernel, v_set(sim->fac.inv_h), own};
        sph_sum_home(sim, t, tile, h, sums, pair, &g);
    }
}
SPH_INLINE void sph_gather_tile(const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t homes, uint32_t sums,
                                sph_pair_fn pair, const void *own)
{
    sph_gather_by(sim->cfg.kernel, sim, t, tile, homes, sums, pair, own);
}
SPH_INLINE const sph_tile *sph_tile_of(const sph_thread *t, uint32_t role)
{
    return SPH_HAS_LAYERED_WALLS && role == SPH_ROLE_GHOST ? &t->ghosts : &t->matter;
}
/* masks of n sums from row `first` on */
#define SPH_SUM_MASK(first, n) (((1u << (n)) - 1u) << (first))

/* homes of a gather */
SPH_INLINE bool sph_matter_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_matter(s);
}

#endif
