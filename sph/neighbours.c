/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* neighbours.c: who is a neighbour, in three dimensions, where 84 % of a tile's candidates are beyond the kernel's
   reach of a home. A tile is sifted: candidates that no home can reach are dropped, and what the others bring is
   written side by side, as records. Then those within reach of a home are listed, and their records turned into short
   columns, so that pairs are made of whole lanes. The order of candidates stays. Costs a thread's scratch, no array. */
#include "sweep.h"
#include "tensor.h"
#include "arithmetic.h"

SPH_OBJECT(neighbours)

#if SPH_SIFTS
/* ---- lists ---- */

/* the places of the bits of 0 .. 15, and how many they are */
static const uint16_t places[16][4] = {{0}, {0},    {1},    {0, 1},    {2},    {0, 2},    {1, 2},    {0, 1, 2},
                                       {3}, {0, 3}, {1, 3}, {0, 1, 3}, {2, 3}, {0, 2, 3}, {1, 2, 3}, {0, 1, 2, 3}};
static const uint8_t how_many[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};

/* appends those of j .. j + 3 whose bit is set to a list of n numbers, in order; returns how many there are then. Four
   places are written, whatever is set. */
SPH_INLINE uint32_t append_four(uint16_t *list, uint32_t n, uint32_t j, uint32_t bits)
{
    uint64_t four;
    memcpy(&four, places[bits], sizeof four);
    four += j * (uint64_t)0x0001000100010001;
    memcpy(list + n, &four, sizeof four);
    return n + how_many[bits];
}
SPH_INLINE uint32_t append_eight(uint16_t *list, uint32_t n, uint32_t j, uint32_t bits)
{
    return append_four(list, append_four(list, n, j, bits & 15), j + 4, bits >> 4);
}

/* ---- what any home can reach ---- */

typedef struct box {
    vreal low[SPH_DIM], high[SPH_DIM];
} box;
SPH_INLINE box box_of(const sph_home_tile *t, uint32_t homes)
{
    box b;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        sph_real low = t->x[k][0], high = low;
        for (uint32_t h = 1; h < homes; h++) {
            const sph_real x = t->x[k][h];
            low = x < low ? x : low;
            high = high < x ? x : high;
        }
        b.low[k] = v_set(low);
        b.high[k] = v_set(high);
    }
    return b;
}

/* Those within reach of the box around the homes. A home inside it is not nearer than the box is, nor when both are
   rounded: no home loses a neighbour. */
static uint32_t keep(const sph_sim *sim, const sph_tile *tile, box b, uint16_t *at)
{
    const vreal reach2 = v_set(sim->fac.reach2);
    uint32_t kept = 0;
    for (uint32_t j = 0; j < tile->n; j += SPH_LANES) {
        uint32_t bits = 0;
        SPH_UNROLL
        for (uint32_t l = 0; l < SPH_LANES; l += SPH_W) {
            vreal out[SPH_DIM];
            SPH_UNROLL
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                const vreal x = v_load(tile->x[k] + j + l);
                out[k] = v_pos(v_max(b.low[k] - x, x - b.high[k]));
            }
            bits |= v_bits(v_less(sph_dot(out, out), reach2)) << l;
        }
        kept = append_eight(at, kept, j, bits);
    }
    return kept;
}
static uint32_t keep_all(const sph_tile *tile, uint16_t *at)
{
    for (uint32_t j = 0; j < tile->n; j++)
        at[j] = (uint16_t)j;
    return tile->n;
}

SPH_INLINE void write_record(const sph_tile *tile, uint32_t j, sph_real *r)
{
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        r[k] = tile->x[k][j];
        r[SPH_DIM + k] = tile->v[k][j];
    }
    sph_real *const more = r + 2 * SPH_DIM;
    more[0] = tile->m[j];
    more[1] = tile->rho[j];
    more[2] = tile->press[j];
    more[3] = tile->inv_rho[j];
}

/* columns with places move up to where records are */
void sph_sift_tile(const sph_sim *sim, sph_thread *t, sph_tile *tile, uint32_t homes)
{
    sph_sifted *const s = &t->sifted;
    const bool other = tile == &t->matter && t->sifted.sweep->other_place;
    s->kept = other ? keep_all(tile, s->at) : keep(sim, tile, box_of(&t->home, homes), s->at);
    write_record(tile, tile->n, s->record[s->kept]); /* as sph_close_tile made it */
    s->at[s->kept] = (uint16_t)tile->n;
    for (uint32_t i = 0; i < s->kept; i++) {
        write_record(tile, s->at[i], s->record[i]);
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            tile->x[k][i] = s->record[i][k];
    }
    for (uint32_t i = s->kept; i < s->kept + SPH_LANES; i++)
        for (uint32_t k = 0; k < SPH_DIM; k++)
            tile->x[k][i] = s->record[s->kept][k];
}

/* ---- what one home can reach ---- */

/* a home's place, and the columns that say where candidates are */
typedef struct place_view {
    vreal home[SPH_DIM];
    const sph_real *x[SPH_DIM];
} place_view;
SPH_INLINE vint is_within(const place_view *v, uint32_t j, vreal reach2)
{
    vreal dx[SPH_DIM];
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        dx[k] = v->home[k] - v_load(v->x[k] + j);
    return v_less(sph_dot(dx, dx), reach2);
}

/* those that are within reach, or (where that is not null) were */
SPH_INLINE uint32_t list_within(const sph_sim *sim, sph_sifted *s, const place_view *is, const place_view *was)
{
    const vreal reach2 = v_set(sim->fac.reach2);
    uint32_t found = 0;
    for (uint32_t j = 0; j < s->kept; j += SPH_LANES) {
        uint32_t bits = 0;
        SPH_UNROLL
        for (uint32_t l = 0; l < SPH_LANES; l += SPH_W) {
            const vint within = is_within(is, j + l, reach2);
            bits |= v_bits(was ? within | is_within(was, j + l, reach2) : within) << l;
        }
        if (was && s->kept - j < SPH_LANES) /* columns of sets end with zeros, which may be near */
            bits &= (1u << (s->kept - j)) - 1;
        found = append_eight(s->list, found, j, bits);
    }
    while (found % SPH_LANES)
        s->list[found++] = (uint16_t)s->kept;
    return found;
}

uint32_t sph_find_neighbours(const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t home)
{
    const uint32_t other = tile == &t->matter ? t->sifted.sweep->other_place : 0;
    place_view is, was;
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        is.home[k] = v_set(t->home.x[k][home]);
        is.x[k] = tile->x[k];
    }
    if (!other)
        return list_within(sim, &t->sifted, &is, NULL);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        was.home[k] = v_set(sph_home_columns_of(sim, t, other - 1)[k * SPH_HOME_ROOM + home]);
        was.x[k] = sph_columns_of(sim, t, other - 1) + k * SPH_TILE_ROOM;
    }
    return list_within(sim, &t->sifted, &is, &was);
}

/* ---- neighbours side by side ---- */

/* eight neighbours' places in all rows of a set */
SPH_INLINE void take_rows(const sph_real *from, const uint16_t *at, const uint16_t *list, uint32_t rows, sph_real *to)
{
    uint32_t place[SPH_LANES];
    SPH_UNROLL
    for (uint32_t l = 0; l < SPH_LANES; l++)
        place[l] = at[list[l]];
    for (uint32_t r = 0; r < rows; r++, from += SPH_TILE_ROOM, to += SPH_NEAR_ROOM)
        SPH_UNROLL
        for (uint32_t l = 0; l < SPH_LANES; l++)
            to[l] = from[place[l]];
}
/* the column sets of a class */
static __attribute__((noinline)) void take_sets(const sph_sim *sim, sph_thread *t, bool ghosts, const uint16_t *list,
                                                uint32_t n)
{
    for (uint32_t c = 0; c < SPH_COLUMN_COUNT; c++) {
        const bool asked = t->sifted.sweep->columns >> c & 1 && sim->columns[c].ghosts == ghosts;
        for (uint32_t i = 0; asked && i < n; i += SPH_LANES)
            take_rows(sph_columns_of(sim, t, c), t->sifted.at, list + i, sim->columns[c].rows,
                      sph_near_columns_of(sim, t, c) + i);
    }
}

uint32_t sph_take_neighbours(const sph_sim *sim, sph_thread *t, const sph_tile *tile, uint32_t from, uint32_t found)
{
    const uint32_t n = found - from < SPH_NEAR_ROOM ? found - from : SPH_NEAR_ROOM;
    sph_sifted *const s = &t->sifted;
    const uint16_t *const list = s->list + from;
    sph_near_tile *const to = &s->near;
    for (uint32_t i = 0; i < n; i += 4) {
        sph_four_records four = {s->record[list[i]], s->record[list[i + 1]], s->record[list[i + 2]],
                                 s->record[list[i + 3]]};
        sph_four_columns places_and_one = {to->x[0] + i, to->x[1] + i, to->x[2] + i, to->v[0] + i};
        sph_four_columns velocities = {to->v[1] + i, to->v[2] + i, NULL, NULL};
        sph_four_columns others = {to->m + i, to->rho + i, to->press + i, to->inv_rho + i};
        v_turn(four, 0, places_and_one, 4);
        v_turn(four, 4, velocities, 2);
        v_turn(four, 6, others, 4);
    }
    if (t->sifted.sweep->columns)
        take_sets(sim, t, tile == &t->ghosts, list, n);
    return n;
}
#endif
