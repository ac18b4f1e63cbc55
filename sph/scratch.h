/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* scratch.h: the scratch of a thread: tiles of candidates and the sums of homes (sweep.h), blocks of particles
   (sort.c), and what a pass gathers. Its capacities are part of the definition of the bits. */
#ifndef SPH_SCRATCH_H
#define SPH_SCRATCH_H

#include "internal.h"

#define SPH_TILE (SPH_DIM == 1 ? 64 : SPH_DIM == 2 ? 128 : 384)
#define SPH_STRIDE (SPH_DIM == 1 ? 8u : SPH_DIM == 2 ? 24u : 48u) /* room behind a tile, for copies of fixed length */
#define SPH_TILE_ROOM (SPH_TILE + SPH_STRIDE)
#define SPH_HOMES 16u /* a multiple of 8 */
#define SPH_HOME_ROOM (SPH_HOMES + SPH_LANES)
#define SPH_SUMS                                                                                                   \
    ((SPH_DIM == 1 ? 8 : SPH_DIM == 2 ? 10 : SPH_WITH_MLS ? 14 : 12) + SPH_TENSOR_SUMS_ +                          \
     (SPH_WITH_BOOKS ? 1 + SPH_HAS_LAYERED_WALLS + SPH_WITH_SOLID : 0) + (SPH_WITH_ENERGY ? 1 : 0))
#define SPH_SWEEP_CHUNK 32u  /* cells */
#define SPH_SLICE_CHUNK 1u   /* cells, in a step that is done in slices */
#define SPH_LOCAL_CHUNK 256u /* particles */

/* how a run of particles is seen from the home cell: x' = sign x + shift, v' = flip v */
typedef struct sph_image {
    bool is_image;
    sph_pos sign[SPH_DIM], shift[SPH_DIM];
    sph_real flip[SPH_DIM];
} sph_image;

/* what every candidate brings */
#define SPH_TILE_ROWS(room)                                                                                        \
    sph_real x[SPH_DIM][room]; /* m, from the home cell's low corner */                                            \
    sph_real v[SPH_DIM][room]; /* m/s */                                                                           \
    sph_real m[room];          /* kg */                                                                            \
    sph_real rho[room];        /* kg/m^3 */                                                                        \
    sph_real press[room];      /* standard schemes: p/rho^2; others: p */                                          \
    sph_real inv_rho[room]     /* 1/rho, where a formula needs it (sph_sweep.needs_inv_rho) */
#define SPH_TILE_WIDTH (2 * SPH_DIM + 4) /* rows */
typedef struct sph_tile {
    uint32_t n;
    SPH_TILE_ROWS(SPH_TILE_ROOM);
} sph_tile;

/* What pairs are made with: the candidates of a tile; where these are sifted (neighbours.c), those within reach of a
   home, some at a time. */
#define SPH_SIFTS (SPH_DIM == 3)
#if SPH_SIFTS
#define SPH_NEAR_ROOM 64u /* a multiple of 8; no part of the definition of the bits */
typedef struct sph_near_tile {
    SPH_TILE_ROWS(SPH_NEAR_ROOM);
} sph_near_tile;
typedef struct sph_home_tile {
    uint32_t n;
    SPH_TILE_ROWS(SPH_HOME_ROOM);
} sph_home_tile;
typedef struct sph_sifted {
    const struct sph_sweep *sweep;
    sph_near_tile near;                             /* neighbours of a home */
    sph_real record[SPH_TILE + 1][SPH_TILE_WIDTH];  /* what candidates bring that any home can reach, and at the end one
                                                       far away, as in a tile, but side by side */
    uint32_t kept;                                  /* how many these are */
    uint16_t at[SPH_TILE + SPH_LANES];              /* their places in the tile */
    uint16_t list[SPH_TILE + 2 * SPH_LANES];        /* which of them are neighbours of a home */
} sph_sifted;
#else
#define SPH_NEAR_ROOM SPH_TILE_ROOM
typedef sph_tile sph_near_tile, sph_home_tile;
#endif

/* what a boundary-force particle brings */
typedef struct sph_points {
    uint32_t n;
    sph_real x[SPH_DIM][SPH_TILE_ROOM];
    uint8_t set[SPH_TILE_ROOM];
    uint8_t turned[SPH_TILE_ROOM]; /* as the image shows it: bits 1 << axis, normal and tangent; 8 << axis, velocity */
} sph_points;

/* what the sort works on: new positions (and where asked, velocities and densities) of a block of particles */
#define SPH_BLOCK 64u
typedef struct sph_block {
    sph_pos pos[SPH_DIM][SPH_BLOCK + 8];
    sph_real vel[SPH_DIM][SPH_BLOCK + 8];
    sph_real rho[SPH_BLOCK + 8];
    uint32_t to[SPH_BLOCK];  /* the count: its cell; the scatter: its place */
    uint8_t gone[SPH_BLOCK]; /* 1: dropped silently, 2: left the domain */
} sph_block;

/* scratch of a thread, so that no function needs a large stack */
typedef struct sph_thread {
    union {
        struct { /* sweeps */
            sph_home_tile home;
            sph_tile matter, ghosts;
#if SPH_SIFTS
            sph_sifted sifted;
#endif
            sph_points points;
#if SPH_HAS_SIDES
            const sph_set *wall; /* whose tile of ghosts it is, if that acts on one side only; through which image */
            sph_image wall_seen;
#endif
            uint32_t home_at[SPH_HOMES]; /* index of the home particle */
            uint8_t home_set[SPH_HOMES];
            uint8_t fast_path[3]; /* of tiles of matter, of ghosts, of matter without its form (forces.c) */
            /* where a pass asks for tiles of one kind: a set in `matter`, through which image, from which cell */
            const sph_set *of;
            sph_image seen;
            sph_pos origin[SPH_DIM];
            sph_real sum[SPH_SUMS][SPH_HOMES][SPH_LANES]; /* one row of lanes for each sum of each home */
#if SPH_HAS_APART
            sph_factors factors; /* of the pairs of a home and a tile of one kind (factors.c) */
#endif
        };
        sph_block block;                /* the sort */
        uint8_t near[SPH_LOCAL_CHUNK];  /* 1: particle of the chunk may be inside a wall */
    };
    /* what a pass gathers over its chunks: order does not matter for any of these */
    uint64_t work, pairs;
    sph_peaks peaks;
    sph_fail fail;
    uint32_t crossed, put_back, reflected, left, removed, widest;
    uint64_t carried_off; /* books: energy of those that left, in small steps (threads.c): whole, so that order does not
                             matter; modulo 2^64 */
} sph_thread;

/* the particles of a chunk of a local pass */
typedef struct sph_span {
    uint32_t first, last;
} sph_span;
SPH_INLINE sph_span sph_chunk_span(const sph_sim *sim, uint32_t chunk)
{
    const uint32_t first = chunk * SPH_LOCAL_CHUNK, last = first + SPH_LOCAL_CHUNK;
    return (sph_span){first, last < sim->next.count ? last : sim->next.count};
}

_Static_assert(sizeof(sph_thread) <= SPH_SCRATCH_BYTES, "SPH_SCRATCH_BYTES in sph.h is too small");

#endif
