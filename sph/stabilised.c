/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stabilised.c: the sums of stabilised SPH (stabilised.h) over neighbours, the particle itself included, and what
   particles bring of them to a tile.

   The level of a particle is how deep it lies inside its body when its first forces are made: the number of rows below
   a flat face of a lattice whose S lies below its own (factors.c: f->edge between rows, as far as S is under 0.98).
   Powell's search for layers (his algorithms 2.1, 2.2) asks for passes over all particles; this is local.

   Fields: filled S (0: not yet), slant D. Arrays: row (in the end row - mean), drawn col and level,
   tension (SPH_DIM reals each, and one). Cost: a sweep once, two before the forces. */
#include "stabilised.h"
#include "arithmetic.h"

SPH_OBJECT(stabilised)

#if SPH_HAS_STABILISED
enum { SUM_EDGE, SUM_SLANT, SUM_DRAWN = SUM_SLANT + SPH_DIM, SUM_SIGMA = SUM_DRAWN + SPH_DIM,
       SUM_COUNT = SUM_SIGMA + SPH_DIM, SUM_OF_MEANS };
_Static_assert(SUM_OF_MEANS <= SPH_SUMS, "SPH_SUMS is too small");

/* ---- columns ---- */

SPH_INLINE vreal levels_of(const sph_factors *f, vreal filled)
{
    vreal level = v_set(0);
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_LEVELS; k++)
        level = level + v_where(v_less(v_set(f->edge[k]), filled), v_set(1));
    return level;
}

/* rows of fluids: 1/S is 1, the level as deep as can be, all else 0 */
static void load_fluid(const sph_candidates *r, sph_real *to, uint32_t row, uint32_t rows, uint32_t level)
{
    for (uint32_t k = 0; k < rows; k++)
        for (uint32_t j = 0; j < r->n; j += SPH_W)
            v_store(to + k * row + j, v_set(k == level ? SPH_LEVELS : 0));
}
void sph_load_edge(const sph_candidates *r, sph_real *to, uint32_t row)
{
    if (!sph_is_solid(r->set)) {
        load_fluid(r, to, row, SPH_DIM + 2, SPH_DIM + 1);
        for (uint32_t j = 0; j < r->n; j += SPH_W)
            v_store(to + j, v_set(1));
        return;
    }
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        const vreal filled = v_load(r->b->filled[0] + r->first + j), u = 1 / filled;
        v_store(to + j, u);
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            v_store(to + (1 + k) * row + j,
                    v_load(r->b->slant[k] + r->first + j) * (u * u) * (sph_real)r->im->sign[k]);
        v_store(to + (1 + SPH_DIM) * row + j, levels_of(&r->sim->fac, filled));
    }
}
void sph_load_drawn(const sph_candidates *r, sph_real *to, uint32_t row)
{
    if (!sph_is_solid(r->set)) {
        load_fluid(r, to, row, SPH_DIM + 1, SPH_DIM);
        return;
    }
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            v_store(to + k * row + j, v_load(r->sim->drawn[k] + r->first + j) * (sph_real)r->im->sign[k]);
        v_store(to + SPH_DIM * row + j, v_load(r->sim->drawn[SPH_DIM] + r->first + j));
    }
}
void sph_load_means(const sph_candidates *r, sph_real *to, uint32_t row)
{
    if (!sph_is_solid(r->set)) {
        load_fluid(r, to, row, 2 * SPH_DIM, 2 * SPH_DIM);
        return;
    }
    for (uint32_t j = 0; j < r->n; j += SPH_W)
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            v_store(to + k * row + j, v_load(r->sim->row[k] + r->first + j) * (sph_real)r->im->sign[k]);
            v_store(to + (SPH_DIM + k) * row + j, v_load(r->sim->tension[k] + r->first + j));
        }
}
/* columns of a tile are 0 or 1, and 0 behind the last candidate */
bool sph_is_drawn(const sph_sim *sim, const sph_thread *t, uint32_t homes)
{
    const sph_mean_homes *const own = (const void *)sph_home_columns_of(sim, t, SPH_COLUMN_means);
    const sph_real *const on = sph_columns_of(sim, t, SPH_COLUMN_means) + SPH_DIM * SPH_TILE_ROOM;
    vreal most = v_set(0);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        for (uint32_t h = 0; h < homes; h++)
            most = v_max(most, v_set(own->on[k][h]));
        for (uint32_t j = 0; j < t->matter.n; j += SPH_W)
            most = v_max(most, v_load(on + k * SPH_TILE_ROOM + j));
    }
    return v_bits(v_less(v_set(0), most)) != 0;
}

/* ---- S and D of the first forces ---- */

SPH_INLINE void edge_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    const vreal q = v_sqrt(sph_dot(dx, dx)) * g->inv_h, v = v_load(g->tile->m + j) * v_load(g->tile->inv_rho + j);
    const vreal slope = k_slope(g->kernel, q) * v;
    s[SUM_EDGE] = s[SUM_EDGE] + k_value(g->kernel, q) * v;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        s[SUM_SLANT + k] = s[SUM_SLANT + k] + slope * dx[k];
}
static void edge_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    sph_gather_tile(sim, t, &t->matter, homes, SPH_SUM_MASK(SUM_EDGE, 1 + SPH_DIM), edge_pair, NULL);
}
static void edge_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h];
    if (b->filled[0][i] > 0) /* those that have them keep them */
        return;
    b->filled[0][i] = v_fold(t->sum[SUM_EDGE][h]) * sim->fac.value;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        b->slant[k][i] = v_fold(t->sum[SUM_SLANT + k][h]) * sim->fac.slope;
}
static bool stabilised_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_solid(s);
}
static void edge_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {stabilised_home, SPH_MATTER,  SPH_SUM_MASK(SUM_EDGE, 1 + SPH_DIM), true, 0,
                         edge_tile,       edge_finish, 0,                                   0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool stabilises(const sph_sim *sim) { return sph_stabilises(&sim->cfg); }
const sph_pass sph_pass_edge = {"edge", sph_sweep_chunks, edge_chunk, NULL, stabilises};

/* ---- row, col and tension; then mean ---- */

typedef struct averaging {
    const sph_edge_tile *edge;
    const sph_drawn_tile *drawn;
    const sph_real *sigma;
    vreal level, reach;
    sph_real value_slope;
} averaging;

SPH_INLINE void rows_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const averaging *const a = g->own;
    vreal dx[SPH_DIM], back;
    sph_gather_distance(g, j, dx);
    const vreal q = v_sqrt(sph_dot(dx, dx)) * g->inv_h, v = v_load(g->tile->m + j) * v_load(g->tile->inv_rho + j);
    const vreal slope = k_slope(g->kernel, q), value = k_value(g->kernel, q) * a->value_slope;
    const vreal u = slope * v_load(a->edge->u + j), sv = slope * v;
    const vreal count = sph_stabilised_count(a->reach, q, a->level, v_load(a->edge->level + j), &back);
    const vreal within = (count + back) * (sph_real)0.5;
    s[SUM_EDGE] = s[SUM_EDGE] + value * v;
    s[SUM_COUNT] = s[SUM_COUNT] + count;
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        s[SUM_SLANT + k] = s[SUM_SLANT + k] + sv * dx[k];
        s[SUM_DRAWN + k] = s[SUM_DRAWN + k] - (u * dx[k] + value * v_load(a->edge->d[k] + j));
        s[SUM_SIGMA + k] = s[SUM_SIGMA + k] + within * v_load(a->sigma + k * SPH_NEAR_ROOM + j);
    }
}
SPH_INLINE void mean_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const averaging *const a = g->own;
    vreal dx[SPH_DIM], back;
    sph_gather_distance(g, j, dx);
    const vreal q = v_sqrt(sph_dot(dx, dx)) * g->inv_h;
    const vreal count = sph_stabilised_count(a->reach, q, a->level, v_load(a->drawn->level + j), &back);
    s[SUM_COUNT] = s[SUM_COUNT] + count;
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++)
        s[SUM_DRAWN + k] = s[SUM_DRAWN + k] + count * v_load(a->drawn->col[k] + j);
}

#define ROWS SPH_SUM_MASK(SUM_EDGE, SUM_OF_MEANS)
#define MEANS (SPH_SUM_MASK(SUM_DRAWN, SPH_DIM) | 1u << SUM_COUNT)
SPH_INLINE void average(uint32_t kernel, const sph_sim *sim, sph_thread *t, uint32_t homes, bool means)
{
    averaging a = {.reach = v_set(sim->fac.reach), .value_slope = sim->fac.value_slope};
    const sph_real *const level = means ? sph_drawn_homes_of(sim, t)->level : sph_edge_homes_of(sim, t)->level;
    if (means) {
        a.drawn = sph_drawn_of(sim, t);
    } else {
        a.edge = sph_edge_of(sim, t);
        a.sigma = sph_near_columns_of(sim, t, SPH_COLUMN_diagonal);
    }
    for (uint32_t h = 0; h < homes; h++) {
        a.level = v_set(level[h]);
        const sph_gather g = {t, sph_near_of(t, &t->matter), h, kernel, v_set(sim->fac.inv_h), &a};
        if (SPH_LISTS && means)
            sph_sum_listed(sim, t, &t->matter, h, MEANS, mean_pair, &g);
        else if (SPH_LISTS)
            sph_sum_listed(sim, t, &t->matter, h, ROWS, rows_pair, &g);
        else if (means)
            sph_sum_home(sim, t, &t->matter, h, MEANS, mean_pair, &g);
        else
            sph_sum_home(sim, t, &t->matter, h, ROWS, rows_pair, &g);
    }
}
static void rows_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    if (SPH_WITH_FAST_PATHS && SPH_IS(sim->cfg.kernel, CUBIC))
        average(SPH_CUBIC, sim, t, homes, false);
    else
        average(sim->cfg.kernel, sim, t, homes, false);
}
static void mean_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role; /* asks for no kernel */
    average(SPH_CUBIC, sim, t, homes, true);
}

static void rows_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_edge_homes *const edge = sph_edge_homes_of(sim, t);
    const uint32_t i = t->home_at[h];
    const sph_real n = v_fold(t->sum[SUM_COUNT][h]), value = v_fold(t->sum[SUM_EDGE][h]);
    const sph_real volume = t->home.m[h] * t->home.inv_rho[h];
    sim->drawn[SPH_DIM][i] = edge->level[h];
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const sph_real slope = v_fold(t->sum[SUM_SLANT + k][h]);
        sim->row[k][i] = (slope * edge->u[h] - value * edge->d[k][h]) / n;
        sim->drawn[k][i] = volume * v_fold(t->sum[SUM_DRAWN + k][h]) / n;
        sim->tension[k][i] = edge->level[h] > 0 && v_fold(t->sum[SUM_SIGMA + k][h]) > 0;
    }
}
/* row becomes row - mean */
static void mean_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h];
    const sph_real n = v_fold(t->sum[SUM_COUNT][h]);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        sim->row[k][i] -= v_fold(t->sum[SUM_DRAWN + k][h]) / n;
}
static void rows_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {stabilised_home, SPH_MATTER,  ROWS, true, 1u << SPH_COLUMN_edge | 1u << SPH_COLUMN_diagonal,
                         rows_tile,       rows_finish, 0,    0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static void mean_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {stabilised_home, SPH_MATTER,  MEANS, false, 1u << SPH_COLUMN_drawn,
                         mean_tile,       mean_finish, 0,     0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool averages(const sph_sim *sim) { return sph_stabilises(&sim->cfg) && sph_sums_forces(sim); }
const sph_pass sph_pass_rows = {"rows", sph_sweep_chunks, rows_chunk, NULL, averages};
const sph_pass sph_pass_means = {"means", sph_sweep_chunks, mean_chunk, NULL, averages};
#endif
