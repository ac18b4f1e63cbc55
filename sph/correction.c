/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* correction.c: corrected gradients, M = -sum m_j x_ij (x) K g, kept as M^-1 (Bonet & Lok 1999); in the weak scheme
   with m_j/rho_j. L = (-sum m_j v_ij (x) K g) M^-1 is then exact for linear fields. Not over pairs of two bodies,
   which know nothing of each other's strain. Where the neighbours do not span space (sph_invert_sum) the plain form is
   taken. In the total-Lagrangian form the longest bond of each home is looked at
   too.

   Array: M^-1 (DIM^2 reals, once). Cost: a sweep before the forces. */
#include "reference.h"
#include "arithmetic.h"

SPH_OBJECT(correction)

#if SPH_HAS_CORRECTION
enum { SUM_M, SUM_FAR = SPH_NL };

/* what a pair needs of its scene: constants in the fast paths */
typedef struct correction {
    bool weak, total, wall;
    sph_reference_home home;
    const sph_reference_tile *tile;
    vreal reach;
} correction;

/* the tile's part of M, and the longest bond (m^2) of reference neighbours */
SPH_INLINE void correction_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const correction *c = g->own;
    const bool total = c->total && !c->wall;
    vreal dx[SPH_DIM], kx[SPH_DIM];
    vint same = v_set_int(0), apart = same;
    sph_gather_distance(g, j, dx);
    memcpy(kx, dx, sizeof kx);
    if (total) {
        sph_reference_distance(&c->home, c->tile, j, dx, kx, &same, &apart);
        SPH_UNROLL
        for (int a = 0; a < SPH_DIM; a++)
            kx[a] = v_where(~apart, kx[a]);
    }
    const vreal q = v_sqrt(sph_dot(kx, kx)) * g->inv_h;
    vreal mg = k_slope(g->kernel, q) * v_load(g->tile->m + j);
    if (c->weak)
        mg = mg * v_load(g->tile->inv_rho + j);
    SPH_UNROLL
    for (int a = 0; a < SPH_DIM; a++)
        SPH_UNROLL
        for (int b = 0; b < SPH_DIM; b++)
            s[a * SPH_DIM + b] = s[a * SPH_DIM + b] + mg * dx[a] * kx[b];
    if (total)
        s[SUM_FAR] = v_max(s[SUM_FAR], v_where(same & v_less(q, c->reach), sph_dot(dx, dx)));
}

SPH_INLINE void correction_homes(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t kernel, bool weak,
                                 bool total, bool wall)
{
    const uint32_t sums = SPH_SUM_MASK(SUM_M, SPH_NL) | (total ? 1u << SUM_FAR : 0);
    const sph_tile *const tile = wall ? &t->ghosts : &t->matter;
    for (uint32_t h = 0; h < homes; h++) {
        correction own = {weak, total, wall, {{v_set(0)}, v_set(0)}, NULL, v_set(sim->fac.reach)};
        if (total) {
            own.home = sph_spread_reference(sph_reference_homes_of(sim, t), h);
            own.tile = sph_reference_of(sim, t);
        }
        const sph_gather g = {t, sph_near_of(t, tile), h, kernel, v_set(sim->fac.inv_h), &own};
        sph_sum_home(sim, t, tile, h, sums, correction_pair, &g);
    }
}

static __attribute__((noinline)) void correction_any(const sph_sim *sim, sph_thread *t, uint32_t homes, bool wall)
{
    const sph_config *c = &sim->cfg;
    correction_homes(sim, t, homes, c->kernel, sph_weak_scheme(c->scheme), sph_is_total(c),
                     SPH_HAS_LAYERED_WALLS && wall);
}

/* the same text with the choices as constants: kernel, whether total-Lagrangian; matter, standard scheme */
#define SPH_FAST_LIST(X)                                                                                           \
    X(cubic, SPH_CUBIC, false)                                                                                     \
    X(cubic_t, SPH_CUBIC, SPH_HAS_TOTAL)                                                                           \
    X(w2, SPH_WENDLAND_C2, false)                                                                                  \
    X(w2_t, SPH_WENDLAND_C2, SPH_HAS_TOTAL)
#define SPH_FAST_FN(name, kernel_, total_)                                                                         \
    static __attribute__((noinline, unused)) void correction_##name(const sph_sim *sim, sph_thread *t, uint32_t n) \
    {                                                                                                              \
        correction_homes(sim, t, n, kernel_, false, total_, false);                                                \
    }
SPH_FAST_LIST(SPH_FAST_FN)
#undef SPH_FAST_FN

static void correction_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    const sph_config *c = &sim->cfg;
    const bool usual = SPH_WITH_FAST_PATHS && role == SPH_ROLE_FLUID && SPH_IS(c->scheme, STANDARD);
#define SPH_FAST_TRY(name, k, whole)                                                                               \
    if (usual && c->kernel == (k) && sph_is_total(c) == (whole)) {                                                 \
        correction_##name(sim, t, homes);                                                                          \
        return;                                                                                                    \
    }
    SPH_FAST_LIST(SPH_FAST_TRY)
#undef SPH_FAST_TRY
    correction_any(sim, t, homes, role == SPH_ROLE_GHOST);
}

/* integers of reference positions must not overflow, nor bonds be drawn too long */
static void check_bonds(sph_sim *sim, sph_thread *t, uint32_t h, uint32_t i)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t id = sim->buf[sim->src].id[0][b->id[0][i]];
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const sph_pos s = b->shift[k][i], half = sim->grid.extent[k] / 2;
        if (s > half || s < -half)
            sph_fail_note(t, SPH_MOVED_TOO_FAR, id, (double)s / (double)sim->grid.cell_size[k]);
    }
    const sph_real far = v_fold_max(t->sum[SUM_FAR][h]), most = (sph_real)(sim->grid.support * sim->cfg.max_stretch);
    if (!(far < most * most))
        sph_fail_note(t, SPH_BOND_TOO_LONG, id, __builtin_sqrt((double)far));
}

static void correction_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h];
    const sph_real plain = sph_weak_scheme(sim->cfg.scheme) ? 1 : 1 / t->home.rho[h];
    sph_real m[SPH_DIM][SPH_DIM], inv[SPH_DIM][SPH_DIM];
    for (int k = 0; k < SPH_NL; k++)
        m[k / SPH_DIM][k % SPH_DIM] = -v_fold(t->sum[SUM_M + k][h]) * sim->fac.slope;
    const bool fine = sph_invert_sum((const sph_real(*)[SPH_DIM])m, inv, 1 / plain);
    for (int k = 0; k < SPH_NL; k++)
        sim->corr[k][i] = fine ? inv[k / SPH_DIM][k % SPH_DIM] : k % (SPH_DIM + 1) == 0 ? plain : 0;
    if (SPH_HAS_TOTAL && sph_is_total(&sim->cfg))
        check_bonds(sim, t, h, i);
}

static bool solid_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_solid(s);
}
static void correction_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const bool total = sph_is_total(&sim->cfg);
    const sph_sweep w = {solid_home,
                         SPH_MATTER | 1u << SPH_ROLE_GHOST,
                         SPH_SUM_MASK(SUM_M, SPH_NL) | (total ? 1u << SUM_FAR : 0),
                         sph_weak_scheme(sim->cfg.scheme),
                         total ? 1u << SPH_COLUMN_reference : 0,
                         correction_tile,
                         correction_finish,
                         0,
                         total ? 1 + SPH_COLUMN_reference : 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool corrects(const sph_sim *sim) { return sph_corrects(&sim->cfg); }
const sph_pass sph_pass_correction = {"correction", sph_sweep_chunks, correction_chunk, NULL, corrects};
#endif
