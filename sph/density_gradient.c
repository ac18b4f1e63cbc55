/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* density_gradient.c: the renormalised gradient of density that density diffusion takes off (Antuono, Colagrossi,
   Marrone & Molteni 2010; diffusion.h):

     G_i = E_i^-1 sum V_j (rho_j - rho_i) grad W,  E_i = sum V_j (x_j - x_i) (x) grad W     (kg/m^4)

   over matter of the home's material, which is what density diffuses in: so G is exact where the density is linear,
   beside walls and at the free surface too. V_j = m_j/rho_j with rho_j not below 0.95 rho0, as in diffusion. Walls and
   images in a face across which gravity pulls are left out of both sums; other images count. Where the neighbours do
   not span space (sph_invert_sum) G is 0.

   Where rates and forces are summed apart, G is made for rates; what the books say of diffusion, beside the forces of
   the same step, takes it as it is.

   Array: G, SPH_DIM reals. Cost: a sweep before the rates, SPH_NT + SPH_DIM sums. */
#include "density_gradient.h"
#include "pair.h"
#include "arithmetic.h"

SPH_OBJECT(density_gradient)

#if SPH_WITH_ANTUONO
enum { SUM_FRAME, SUM_SLOPE = SPH_NT, DENSITY_SUMS = SPH_NT + SPH_DIM };
_Static_assert(DENSITY_SUMS <= SPH_SUMS, "SPH_SUMS is too small");

/* a gradient turns with places, whatever a face does to velocities */
void sph_load_density_gradient(const sph_candidates *r, sph_real *to, uint32_t row)
{
    for (uint32_t j = 0; j < r->n; j += SPH_W)
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            v_store(to + k * row + j,
                    v_load(r->sim->density_gradient[k] + r->first + j) * (sph_real)r->im->sign[k]);
}

/* the tile's part of -E, and of minus the sum of differences */
SPH_INLINE void density_gradient_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    const vreal w = sph_gather_slope(g, dx) * v_load(g->tile->m + j) * v_load(g->tile->inv_rho + j);
    const vreal less = v_set(g->t->home.rho[g->h]) - v_load(g->tile->rho + j);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        const vreal wx = w * dx[k];
        s[SUM_SLOPE + k] = s[SUM_SLOPE + k] + less * wx;
        SPH_UNROLL
        for (int l = k; l < SPH_DIM; l++)
            s[SUM_FRAME + sph_sym[k][l]] = s[SUM_FRAME + sph_sym[k][l]] + wx * dx[l];
    }
}

SPH_INLINE void density_gradient_homes(uint32_t kernel, const sph_sim *sim, sph_thread *t, uint32_t homes)
{
    for (uint32_t h = 0; h < homes; h++) {
        const sph_gather g = {t, sph_near_of(t, &t->matter), h, kernel, v_set(sim->fac.inv_h), NULL};
        if (SPH_WITH_SEVERAL_FLUIDS && sim->mixed && t->of->kin != sim->set[t->home_set[h]].kin)
            continue;
        sph_sum_home(sim, t, &t->matter, h, SPH_SUM_MASK(0, DENSITY_SUMS), density_gradient_pair, &g);
    }
}
static uint8_t kept_apart(const sph_sim *sim)
{
    uint8_t apart = SPH_WITH_SEVERAL_FLUIDS && sim->mixed ? SPH_APART_KIN : 0;
    apart |= sph_turns_upside_down(&sim->cfg) ? SPH_APART_MIRRORED : 0;
    return apart;
}
static void density_gradient_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    if (SPH_HAS_APART && sph_turns_upside_down(&sim->cfg) && sph_is_upside_down(sim, t))
        return;
    if (SPH_WITH_FAST_PATHS && SPH_IS(sim->cfg.kernel, WENDLAND_C2))
        density_gradient_homes(SPH_WENDLAND_C2, sim, t, homes);
    else
        density_gradient_homes(sim->cfg.kernel, sim, t, homes);
}

static void density_gradient_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_real e[SPH_DIM][SPH_DIM], inv[SPH_DIM][SPH_DIM], d[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        d[k] = v_fold(t->sum[SUM_SLOPE + k][h]) * sim->fac.slope;
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = k; l < SPH_DIM; l++)
            e[k][l] = e[l][k] = -v_fold(t->sum[SUM_FRAME + sph_sym[k][l]][h]) * sim->fac.slope;
    const bool spans = sph_invert_sum((const sph_real(*)[SPH_DIM])e, inv, 1);
    for (int k = 0; k < SPH_DIM; k++) {
        sph_real sum = 0;
        for (int l = 0; spans && l < SPH_DIM; l++)
            sum += inv[k][l] * d[l];
        sim->density_gradient[k][t->home_at[h]] = -sum;
    }
}

static void density_gradient_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {sph_matter_home, SPH_MATTER, SPH_SUM_MASK(0, DENSITY_SUMS), SPH_BOUNDED, 0,
                         density_gradient_tile, density_gradient_finish, kept_apart(sim), 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool wants_density_gradient(const sph_sim *sim)
{
    return sph_takes_density_gradient(&sim->cfg) && sph_sums_rates(sim);
}
const sph_pass sph_pass_density_gradient = {"density_gradient", sph_sweep_chunks, density_gradient_chunk, NULL,
                                            wants_density_gradient};
#endif
