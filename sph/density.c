/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* density.c: density by summation, rho_i = sum m_j W (Gray 2001 eq 2.19), and the Shepard filter, rho_i = sum m_j
   W/sum (m_j/rho_j) W (Wickramarachchi 2009 eq 6.3). Array: tmp, the new density until all have read the old one.
   Cost: a sweep and a local pass. */
#include "pair.h"
#include "arithmetic.h"

SPH_OBJECT(density)

#if SPH_HAS_FILTERS
enum { SUM_MW, SUM_VW };

SPH_INLINE void density_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    const vreal w = sph_gather_value(g, dx) * v_load(g->tile->m + j);
    s[SUM_MW] = s[SUM_MW] + w;
    s[SUM_VW] = s[SUM_VW] + w * v_load(g->tile->inv_rho + j);
}
static void density_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    sph_gather_tile(sim, t, sph_tile_of(t, role), homes, SPH_SUM_MASK(SUM_MW, 2), density_pair, NULL);
}

#if SPH_WITH_SUMMATION
static void summation_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_real rho0 = sim->set[t->home_set[h]].rho0_r;
    sim->tmp[t->home_at[h]] = (v_fold(t->sum[SUM_MW][h]) * sim->fac.value - rho0) / rho0;
}
static void summation_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    static const sph_sweep w = {sph_body_home, SPH_BODIES | 1u << SPH_ROLE_GHOST, SPH_SUM_MASK(SUM_MW, 2), true, 0,
                                density_tile, summation_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool sums_density(const sph_sim *sim) { return sph_sums_density(&sim->cfg); }
const sph_pass sph_pass_summation = {"summation", sph_sweep_chunks, summation_chunk, NULL, sums_density};
#endif

static bool filters_now(const sph_sim *sim)
{
    const uint32_t every = sim->cfg.shepard_every;
    return SPH_WITH_SHEPARD && every && sim->next.step && sim->next.step % every == 0;
}

#if SPH_WITH_SHEPARD
static void shepard_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_real rho0 = sim->set[t->home_set[h]].rho0_r;
    /* the particle itself is in both sums, so the lower one is never 0 */
    sim->tmp[t->home_at[h]] = (v_fold(t->sum[SUM_MW][h]) / v_fold(t->sum[SUM_VW][h]) - rho0) / rho0;
}
static void shepard_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    static const sph_sweep w = {sph_body_home, SPH_BODIES, SPH_SUM_MASK(SUM_MW, 2), true, 0, density_tile,
                                shepard_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}
const sph_pass sph_pass_shepard = {"shepard", sph_sweep_chunks, shepard_chunk, NULL, filters_now};
#endif

/* the new density becomes the density; in its own pass, because neighbours read the old one */
static void copy_density_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const sph_span s = sph_chunk_span(sim, chunk);
    for (uint32_t i = s.first; i < s.last; i++)
        if (b->set[0][i] != SPH_DEAD && sph_is_body(&sim->set[b->set[0][i]]))
            b->rho[0][i] = sim->tmp[i];
    t->work += s.last - s.first;
}
static bool copies_density(const sph_sim *sim) { return filters_now(sim) || sph_sums_density(&sim->cfg); }
const sph_pass sph_pass_copy_density = {"copy density", sph_local_chunks, copy_density_chunk, NULL, copies_density};
#endif
