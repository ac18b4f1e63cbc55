/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sweep.h: the one neighbour sweep. For each cell it copies the particles of the 3^DIM cells around it (images behind
   periodic and mirror faces included) into tiles: short arrays with positions relative to the cell and everything a
   pair formula reads. A pass gives the sweep three small functions: which particles are homes, what to add up over a
   tile, and what to do with the sums. No neighbour list is kept.

   There is a tile for each class of candidates: matter (fluid and solid: what moves by forces), ghosts, points
   (boundary-force particles). Candidate number k of a tile goes to lane k mod 8; in three dimensions (SPH_SIFTS)
   candidate number k of those within the kernel's reach of a home (neighbours.c). So sums depend on places and the
   order of candidates only. A full tile is worked off and refilled: the capacities are part of the definition of the
   bits. */
#ifndef SPH_SWEEP_H
#define SPH_SWEEP_H

#include "scratch.h"

/* n particles of one set from index `first` on, seen through an image from the cell whose low corner is `origin` */
typedef struct sph_candidates {
    const sph_sim *sim;
    const sph_buffer *b;
    const sph_image *im;
    const sph_set *set;
    const sph_pos *origin;
    uint32_t first, n;
    const sph_tile *tile; /* the tile they stand in already, from place `at` on */
    uint32_t at;
} sph_candidates;

/* place of W particles along axis k, whose coordinate is q (quanta), from the home cell's low corner (m) */
SPH_INLINE vreal sph_seen_place(const sph_candidates *r, uint32_t k, vint q)
{
    const vint seen = q * v_set_int(r->im->sign[k]) + v_set_int(r->im->shift[k] - r->origin[k]);
    return v_from_int(seen) * v_set((sph_real)r->sim->grid.quantum);
}
/* Component k of a vector, components k, l of a tensor as the image shows them: a tensor of geometry (sums of x (x) x)
   turns as places do; a stress as velocities do, so that behind a no-slip face the shear keeps its sign and what is
   sheared along the face hangs on to it; a product of the two (sigma M^-T) with its first index as velocities, with its
   second as places do. */
SPH_INLINE vreal sph_seen_vector(const sph_candidates *r, uint32_t k, vreal v) { return v * r->im->flip[k]; }
SPH_INLINE vreal sph_seen_tensor(const sph_candidates *r, uint32_t k, uint32_t l, vreal v)
{
    return r->im->is_image && k != l ? v * (sph_real)(r->im->sign[k] * r->im->sign[l]) : v;
}
SPH_INLINE vreal sph_seen_stress(const sph_candidates *r, uint32_t k, uint32_t l, vreal v)
{
    return r->im->is_image && k != l ? v * (r->im->flip[k] * r->im->flip[l]) : v;
}
SPH_INLINE vreal sph_seen_mixed(const sph_candidates *r, uint32_t k, uint32_t l, vreal v)
{
    return r->im->is_image ? v * (r->im->flip[k] * (sph_real)r->im->sign[l]) : v;
}

/* A column set: rows of reals that a module's candidates (and, of matter, homes) bring beside those of every tile.
   The loader writes row r of particle `first` + j to to[r * row + j], j = 0 .. n - 1, and may write SPH_W - 1
   elements more. Behind the last candidate all are 0. The module overlays a struct of its own on the rows in its
   header. */
struct sph_column_set {
    uint8_t ghosts; /* 1: of ghosts; 0: of matter, and of homes */
    uint8_t rows;
    void (*load)(const sph_candidates *r, sph_real *to, uint32_t row);
};
#define sph_column_table SPH_NAME(column_table_)
extern const struct sph_column_set sph_column_table[SPH_COLUMN_COUNT];
/* the rows of a column set in a thread's scratch: of candidates, of homes, of neighbours; SPH_COLUMN_... names the
   set */
SPH_INLINE sph_real *sph_columns_of(const sph_sim *sim, const sph_thread *t, uint32_t set)
{
    return sim->extra + (size_t)(t - sim->thread) * sim->extra_reals + sim->extra_at[set];
}
SPH_INLINE sph_real *sph_home_columns_of(const sph_sim *sim, const sph_thread *t, uint32_t set)
{
    return sph_columns_of(sim, t, set) + (size_t)sim->columns[set].rows * SPH_TILE_ROOM;
}
/* of the candidates that pairs are made with */
SPH_INLINE sph_real *sph_near_columns_of(const sph_sim *sim, const sph_thread *t, uint32_t set)
{
    const struct sph_column_set *const s = &sim->columns[set];
    const size_t before = SPH_SIFTS ? SPH_TILE_ROOM + (s->ghosts ? 0 : SPH_HOME_ROOM) : 0;
    return sph_columns_of(sim, t, set) + s->rows * before;
}

typedef struct sph_sweep {
    bool (*home)(const sph_sim *sim, const sph_set *set);
    uint32_t classes;     /* an or of 1 << SPH_ROLE_... that are candidates */
    uint32_t sums;        /* an or of 1 << row of sph_thread.sum */
    uint8_t needs_inv_rho; /* true: 1/rho; SPH_BOUNDED: of candidates 1/max(rho, 0.95 rho0) */
    uint32_t columns;     /* an or of 1 << SPH_COLUMN_... */
    void (*tile)(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role); /* add a tile to the homes' sums */
    void (*finish)(sph_sim *sim, sph_thread *t, uint32_t home);                     /* a home's sums are complete */
    uint8_t apart;        /* an or of SPH_APART_...: its tiles of matter are of one kind of candidates */
    uint8_t other_place;  /* 0, or 1 + a column set: the kernel may see matter where its first rows say instead */
} sph_sweep;
enum { SPH_APART_KIN = 1, SPH_APART_MIRRORED = 2 }; /* of one material; seen through the same mirrors */

#define sph_sweep_chunk SPH_NAME(sweep_chunk_)
void sph_sweep_chunk(sph_sim *sim, const sph_sweep *w, uint32_t chunk, sph_thread *t);
/* whether there is nobody in a chunk of cells; then its work is counted */
#define sph_is_empty_chunk SPH_NAME(is_empty_chunk_)
bool sph_is_empty_chunk(const sph_sim *sim, uint32_t chunk, sph_thread *t);
#define sph_sweep_chunks SPH_NAME(sweep_chunks_)
uint32_t sph_sweep_chunks(const sph_sim *sim);
#define sph_local_chunks SPH_NAME(local_chunks_)
uint32_t sph_local_chunks(const sph_sim *sim);

/* threads.c: a failure seen by a thread; the smallest particle id wins, so it does not depend on threads */
#define sph_fail_note SPH_NAME(fail_note_)
#define SPH_OUT_OF_FACE 64 /* as a status: out of the domain through face 2 axis + (0 low, 1 high) */
void sph_fail_note(sph_thread *t, sph_status s, uint32_t id, double value);
/* books: the energy that particle i of a buffer has is carried off with it */
#define sph_carry_off SPH_NAME(carry_off_)
void sph_carry_off(const sph_sim *sim, const sph_buffer *b, uint32_t i, sph_thread *t);
/* starts what threads see afresh; adds up what they saw in a pass, and returns the failure, if there was one */
#define sph_clear_threads SPH_NAME(clear_threads_)
void sph_clear_threads(sph_sim *sim);
#define sph_gather_threads SPH_NAME(gather_threads_)
sph_fail sph_gather_threads(sph_sim *sim);

/* validate.c: what SPH_VALIDATE asks: buffer dst in order of cells and ids, each particle of src at most once, all
   inside the domain; the columns of a tile finite, with mass */
#define sph_is_sorted SPH_NAME(is_sorted_)
bool sph_is_sorted(const sph_sim *sim);
#define sph_is_tile_sound SPH_NAME(is_tile_sound_)
bool sph_is_tile_sound(const sph_tile *t);
/* Where SPH_VALIDATE is on: what a stage may not read before it wrote it is filled with what no field may be, buffer
   dst, the cells and the scratch of a stage; a thread's scratch before every chunk. Both return true. */
#define sph_poison_stage SPH_NAME(poison_stage_)
bool sph_poison_stage(sph_sim *sim);
#define sph_poison_thread SPH_NAME(poison_thread_)
bool sph_poison_thread(const sph_sim *sim, sph_thread *t);

/* neighbours.c: keeps those candidates of a tile that any home can reach; of these, lists those within the kernel's
   reach of one home, filled up to whole lanes with one that is far away, and returns how many; copies those from `from`
   on, at most SPH_NEAR_ROOM, to where pairs are made with them, and returns how many */
#define sph_sift_tile SPH_NAME(sift_tile_)
void sph_sift_tile(const sph_sim *sim, sph_thread *t, sph_tile *tile, uint32_t homes);
#define sph_find_neighbours SPH_NAME(find_neighbours_)
uint32_t sph_find_neighbours(const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t home);
#define sph_take_neighbours SPH_NAME(take_neighbours_)
uint32_t sph_take_neighbours(const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t from, uint32_t found);

/* whether home h feels the walls in the tile of ghosts: it may stand on the other side of one-sided ones */
#define sph_is_acted_on SPH_NAME(is_acted_on_)
bool sph_is_acted_on(const sph_sim *sim, const sph_thread *t, uint32_t h);

/* tiles.c: the columns of every tile, for a run; `homes`: into the tile of homes */
#define sph_load_tile SPH_NAME(load_tile_)
enum { SPH_BOUNDED = 2 };
void sph_load_tile(const sph_candidates *r, sph_tile *t, uint32_t inv_rho, bool homes);
#define sph_load_points SPH_NAME(load_points_)
void sph_load_points(const sph_candidates *r, sph_points *t);
/* makes the columns behind the last candidate harmless: far away, without mass */
#define sph_close_tile SPH_NAME(close_tile_)
void sph_close_tile(const sph_sim *sim, sph_tile *t);

#endif
