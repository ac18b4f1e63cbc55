/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* smoothing.c: smoothed velocities for the strain rates of solids, u_i = xsph sum (m_j/rho_mean) (v_j - v_i) W (Gray
   2001 eqs 2.22, 5.10); W as the kernel sees the pair, as in xsph.h: of one body's bonds at |K|. Array: xsph (state).
   Cost: a sweep before the forces. */
#include "reference.h"
#include "smoothed.h"
#include "arithmetic.h"

SPH_OBJECT(smoothing)

#if SPH_HAS_HAT
/* where they are: in the middle of a step, where xsph still says how particles went, in acc, which is free until
   forces */
SPH_INLINE sph_real *smoothed(const sph_sim *sim, const sph_buffer *b, uint32_t k)
{
    return sph_in_middle(sim) ? b->acc[k] : b->xsph[k];
}

/* walls are smoothed by nobody: theirs is the velocity that every pair sees */
void sph_load_smoothed(const sph_candidates *r, sph_real *to, uint32_t row)
{
    for (uint32_t k = 0; k < SPH_DIM && !sph_is_matter(r->set); k++)
        memcpy(to + k * row, r->tile->v[k] + r->at, r->n * sizeof(sph_real));
    if (!sph_is_matter(r->set))
        return;
    for (uint32_t j = 0; j < r->n; j += SPH_W)
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const uint32_t i = r->first + j;
            const vreal u = v_load(r->b->vel[k] + i) + v_load(smoothed(r->sim, r->b, k) + i);
            v_store(to + k * row + j, sph_seen_vector(r, k, u));
        }
}

/* reference positions, in the total-Lagrangian form; else null */
typedef struct smoothing {
    const sph_reference_homes *homes;
    const sph_reference_tile *tile;
} smoothing;

SPH_INLINE void smooth_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const sph_home_tile *home = &g->t->home;
    const sph_near_tile *c = g->tile;
    const smoothing *const own = g->own;
    vreal dx[SPH_DIM], kx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    memcpy(kx, dx, sizeof kx);
    if (SPH_HAS_TOTAL && own->tile) {
        const sph_reference_home was = sph_spread_reference(own->homes, g->h);
        vint same, apart;
        sph_reference_distance(&was, own->tile, j, dx, kx, &same, &apart);
    }
    const vreal w = sph_gather_value(g, kx) * v_load(c->m + j) / (home->rho[g->h] + v_load(c->rho + j));
    for (int k = 0; k < SPH_DIM; k++)
        s[k] = s[k] + w * (v_load(c->v[k] + j) - home->v[k][g->h]);
}
static void smooth_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    smoothing own = {NULL, NULL};
    (void)role;
    if (SPH_HAS_TOTAL && sph_is_total(&sim->cfg))
        own = (smoothing){sph_reference_homes_of(sim, t), sph_reference_of(sim, t)};
    sph_gather_tile(sim, t, &t->matter, homes, SPH_SUM_MASK(0, SPH_DIM), smooth_pair, &own);
}

static void smooth_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h], still = sph_undrifting(sim, &sim->set[t->home_set[h]]);
    const sph_real scale = sim->fac.value * (sph_real)(2 * sim->cfg.xsph);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        smoothed(sim, &sim->buf[sim->dst], k)[i] = still >> k & 1 ? 0 : v_fold(t->sum[k][h]) * scale;
}

static void smooth_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const bool total = sph_is_total(&sim->cfg);
    const sph_sweep w = {sph_matter_home, SPH_MATTER, SPH_SUM_MASK(0, SPH_DIM), false,
                         total ? 1u << SPH_COLUMN_reference : 0, smooth_tile, smooth_finish, 0,
                         total ? 1 + SPH_COLUMN_reference : 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool smooths(const sph_sim *sim) { return sph_smooths_strain(&sim->cfg); }
const sph_pass sph_pass_smooth = {"smoothing", sph_sweep_chunks, smooth_chunk, NULL, smooths};
#endif
