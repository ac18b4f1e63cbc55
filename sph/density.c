/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* density.c: density by summation, rho_i = sum m_j W (Gray 2001 eq 2.19), and the Shepard filter, rho_i = sum m_j
   W/sum (m_j/rho_j) W (Wickramarachchi 2009 eq 6.3), over what is of the same material, as
   rho_i - rho0 = sum (m_j/rho_j) W (rho_j - rho0)/sum (m_j/rho_j) W, so that rounding is of the difference.
   Array: tmp, the new density until all have read the old one. Cost: a sweep and a local pass. */
#include "locals.h"
#include "pair.h"
#include "arithmetic.h"

SPH_OBJECT(density)

#if SPH_HAS_FILTERS
enum { SUM_MW, SUM_VW };

#if SPH_WITH_SUMMATION
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

static void summation_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_real rho0 = sim->set[t->home_set[h]].rho0_r;
    sim->tmp[t->home_at[h]] = (v_fold(t->sum[SUM_MW][h]) * sim->fac.value - rho0) / rho0;
}
static void summation_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    static const sph_sweep w = {sph_matter_home, SPH_MATTER | 1u << SPH_ROLE_GHOST, SPH_SUM_MASK(SUM_MW, 2), true, 0,
                                density_tile, summation_finish, 0, 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool sums_density(const sph_sim *sim) { return sph_sums_density(&sim->cfg); }
const sph_pass sph_pass_summation = {"summation", sph_sweep_chunks, summation_chunk, NULL, sums_density};
#endif

#if SPH_WITH_SHEPARD
SPH_INLINE void shepard_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const sph_real *const rho0 = g->own;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    const vreal w = sph_gather_value(g, dx) * (v_load(g->tile->m + j) * v_load(g->tile->inv_rho + j));
    s[SUM_MW] = s[SUM_MW] + w * (v_load(g->tile->rho + j) - *rho0);
    s[SUM_VW] = s[SUM_VW] + w;
}
static void shepard_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    for (uint32_t h = 0; h < homes; h++) {
        const sph_set *set = &sim->set[t->home_set[h]];
        const sph_gather g = {t, sph_near_of(t, &t->matter), h, sim->cfg.kernel, v_set(sim->fac.inv_h), &set->rho0_r};
        if (!SPH_WITH_SEVERAL_FLUIDS || !sim->mixed || t->of->kin == set->kin)
            sph_sum_home(sim, t, &t->matter, h, SPH_SUM_MASK(SUM_MW, 2), shepard_pair, &g);
    }
}
static void shepard_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_real rho0 = sim->set[t->home_set[h]].rho0_r;
    /* the particle itself is in both sums, so the lower one is never 0 */
    sim->tmp[t->home_at[h]] = v_fold(t->sum[SUM_MW][h]) / v_fold(t->sum[SUM_VW][h]) / rho0;
}
static void shepard_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {sph_matter_home, SPH_MATTER, SPH_SUM_MASK(SUM_MW, 2), true, 0, shepard_tile, shepard_finish,
                         SPH_WITH_SEVERAL_FLUIDS && sim->mixed ? SPH_APART_KIN : 0, 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool shepard_now(const sph_sim *sim) { return !SPH_IS(sim->cfg.filter, MLS) && sph_filters_now(sim); }
const sph_pass sph_pass_shepard = {"shepard", sph_sweep_chunks, shepard_chunk, NULL, shepard_now};
#endif

/* whether what the filter takes is on the books: not where Runge-Kutta's second stage filters densities that it does
   not keep */
static bool books_filter(const sph_sim *sim)
{
    return sph_keeps_books(&sim->cfg) && sph_filters_now(sim) && sim->src == sim->cur;
}

/* the new density becomes the density; in its own pass, because neighbours read the old one */
static void copy_density_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const sph_span s = sph_chunk_span(sim, chunk);
    const bool books = books_filter(sim);
    double taken = 0;
    for (uint32_t i = s.first; i < s.last; i++)
        if (b->set[0][i] != SPH_DEAD && sph_is_matter(&sim->set[b->set[0][i]]) &&
            !sph_flow_of(sim, &sim->set[b->set[0][i]])) {
            taken += books ? sph_energy_of(sim, b, i).internal : 0;
            b->rho[0][i] = sim->tmp[i];
            taken -= books ? sph_energy_of(sim, b, i).internal : 0;
        }
    if (books)
        sph_book_row(sim, chunk)[JUMP_FILTERED] = taken;
    t->work += s.last - s.first;
}
static sph_status copy_density_end(sph_sim *sim)
{
    if (books_filter(sim))
        sim->next.filtered += sph_sum_rows(sim, JUMP_FILTERED);
    return SPH_OK;
}
static bool copies_density(const sph_sim *sim) { return sph_filters_now(sim) || sph_sums_density(&sim->cfg); }
const sph_pass sph_pass_copy_density = {"copy density", sph_local_chunks, copy_density_chunk, copy_density_end,
                                       copies_density};
#endif
