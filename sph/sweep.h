/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sweep.h: the one neighbour sweep. For each cell it copies the particles of the 3^DIM cells around it (images behind
   periodic and mirror faces included) into tiles: short arrays with positions relative to the cell and everything a
   pair formula reads. A pass gives the sweep three small functions: which particles are homes, what to add up over a
   tile, and what to do with the sums. No neighbour list is kept.

   There is a tile for each class of candidates: fluid, ghost walls, boundary-force walls. Candidate number k of a class
   goes to lane k mod 8, so sums depend on the order of candidates only. A full tile is worked off and refilled; where
   both fluid and walls overflow, the capacities decide which comes first: they are part of the definition of the bits. */
#ifndef SPH_SWEEP_H
#define SPH_SWEEP_H

#include "internal.h"

#define SPH_TILE (SPH_DIM == 1 ? 64 : SPH_DIM == 2 ? 128 : 384)
#define SPH_STRIDE (SPH_DIM == 1 ? 8u : SPH_DIM == 2 ? 24u : 48u) /* room behind a tile, for copies of fixed length */
#define SPH_HOMES 16u /* a multiple of 8 */
#define SPH_SUMS ((SPH_DIM == 1 ? 8 : SPH_DIM == 2 ? 10 : 12) + (SPH_WITH_SOLID ? SPH_DIM * SPH_DIM : 0))
/* particles that load_columns copies without asking how many there are: a row has about SPH_STRIDE, and a loop of fixed length
   saves a branch that would be mispredicted; where a register holds one real, copying too many costs more */
#define SPH_COPIED (SPH_SCALAR ? 1u : SPH_STRIDE)
#define SPH_SWEEP_CHUNK 32u  /* cells */
#define SPH_SLICE_CHUNK 1u   /* cells, in a step that is done in slices */
#define SPH_LOCAL_CHUNK 256u /* particles */

typedef struct sph_tile {
    uint32_t n;
    sph_real x[SPH_DIM][SPH_TILE + SPH_STRIDE]; /* m, from the home cell's low corner */
    sph_real v[SPH_DIM][SPH_TILE + SPH_STRIDE]; /* m/s */
    sph_real m[SPH_TILE + SPH_STRIDE];          /* kg */
    sph_real rho[SPH_TILE + SPH_STRIDE];        /* kg/m^3 */
    sph_real a[SPH_TILE + SPH_STRIDE];          /* standard schemes: p/rho^2; others: p */
    sph_real iv[SPH_TILE + SPH_STRIDE];         /* 1/rho, where a formula needs it */
} sph_tile;

/* what ghost walls have besides */
typedef struct sph_ghost_tile {
    sph_real n[SPH_DIM][SPH_TILE + SPH_STRIDE]; /* normal into the fluid */
    sph_real u[SPH_DIM][SPH_TILE + SPH_STRIDE]; /* velocity for the viscosity (Adami) */
    sph_real depth[SPH_TILE + SPH_STRIDE];      /* distance behind the wall, 0: no mirror velocity */
    sph_real vis[SPH_TILE + SPH_STRIDE];        /* 1: viscosity acts, 0: free slip */
} sph_ghost_tile;

/* what scenes with solids have besides; n: room for so many particles */
#define SPH_SOLID_COLUMNS(n)                                                                                \
    sph_real t[SPH_NL][n];  /* T: -sigma/rho^2, -sigma M^-T/rho, or -sigma (weak) */                        \
    sph_real r[SPH_NT][n];  /* artificial stress R, like T */                                               \
    sph_real k[SPH_DIM][n]; /* TOTAL: reference position (m), from the home cell's low corner */            \
    sph_real u[SPH_DIM][n]; /* velocity that strain rates see */                                            \
    sph_real body[n]        /* TOTAL: the body's number + 1, 0: none */
typedef struct sph_solid_tile {
    SPH_SOLID_COLUMNS(SPH_TILE + SPH_STRIDE);
} sph_solid_tile;
typedef struct sph_solid_homes {
    SPH_SOLID_COLUMNS(SPH_HOMES + SPH_LANES);
} sph_solid_homes;
/* which of them a sweep asks for */
enum { SPH_COL_STRESS = 1, SPH_COL_REFERENCE = 2, SPH_COL_SMOOTHED = 4 };

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
            sph_tile home, fluid, ghost;
            sph_ghost_tile more;
            uint32_t forces; /* boundary-force particles: set and position only */
            sph_real fx[SPH_DIM][SPH_TILE + SPH_STRIDE];
            uint8_t fset[SPH_TILE + SPH_STRIDE];
            uint32_t home_at[SPH_HOMES]; /* index of the home particle */
            uint8_t home_set[SPH_HOMES];
            sph_real sum[SPH_SUMS][SPH_HOMES][SPH_LANES]; /* one row of lanes for each sum of each home */
        };
        sph_block block;                /* the sort */
        uint8_t near[SPH_LOCAL_CHUNK];  /* 1: particle of the chunk may be inside a wall */
    };
    /* what a pass gathers over its chunks: order does not matter for any of these */
    uint64_t work, pairs;
    sph_peaks peaks;
    sph_fail fail;
    uint32_t crossed, put_back, reflected, left, removed, widest;
} sph_thread;

/* the same of scenes with solids */
typedef struct sph_solid_scratch {
    sph_solid_homes home;
    sph_solid_tile tile;
} sph_solid_scratch;
SPH_INLINE sph_solid_scratch *sph_solid_scratch_of(const sph_sim *sim, const sph_thread *t) { return sim->solid_scratch + (t - sim->thread); }

typedef struct sph_sweep {
    bool (*home)(const sph_sim *sim, const sph_set *set);
    uint32_t classes;  /* an or of 1 << SPH_ROLE_... that are candidates */
    uint32_t sums;     /* how many of SPH_SUMS it uses */
    bool needs_iv;
    uint32_t columns;  /* of solids: an or of SPH_COL_... */
    void (*tile)(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role); /* add a tile to the homes' sums */
    void (*finish)(sph_sim *sim, sph_thread *t, uint32_t home);                     /* a home's sums are complete */
} sph_sweep;

#define sph_sweep_chunk SPH_NAME(sweep_chunk_)
void sph_sweep_chunk(sph_sim *sim, const sph_sweep *w, uint32_t chunk, sph_thread *t);
#define sph_sweep_chunks SPH_NAME(sweep_chunks_)
uint32_t sph_sweep_chunks(const sph_sim *sim);
#define sph_local_chunks SPH_NAME(local_chunks_)
uint32_t sph_local_chunks(const sph_sim *sim);

/* the particles of a chunk of a local pass */
typedef struct sph_span {
    uint32_t first, last;
} sph_span;
SPH_INLINE sph_span sph_chunk_span(const sph_sim *sim, uint32_t chunk)
{
    const uint32_t first = chunk * SPH_LOCAL_CHUNK, last = first + SPH_LOCAL_CHUNK;
    return (sph_span){first, last < sim->next.count ? last : sim->next.count};
}

/* threads.c: a failure seen by a thread; the smallest particle id wins, so it does not depend on threads */
#define sph_fail_note SPH_NAME(fail_note_)
void sph_fail_note(sph_thread *t, sph_status s, uint32_t id, double value);
/* starts what threads see afresh; adds up what they saw in a pass, and returns the failure, if there was one */
#define sph_clear_threads SPH_NAME(clear_threads_)
void sph_clear_threads(sph_sim *sim);
#define sph_gather_threads SPH_NAME(gather_threads_)
sph_fail sph_gather_threads(sph_sim *sim);

_Static_assert(sizeof(sph_thread) <= SPH_SCRATCH_BYTES, "SPH_SCRATCH_BYTES in sph.h is too small");
_Static_assert(sizeof(sph_solid_scratch) <= SPH_SOLID_SCRATCH_BYTES, "SPH_SOLID_SCRATCH_BYTES in sph.h is too small");

#endif
