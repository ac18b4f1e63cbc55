/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* normalised.c: N and q of a particle's normalised kernel (normalised.h), from one sum over its neighbours, itself
   included: S, D, X = sum V_j W x_ji, Y = sum V_j x_ji (x) grad W; M = (Y S - X (x) D)/S^2 (in 1.19 places may be
   counted from the home's, because sum V_j grad W~ = 0). Where the neighbours do not span space (sph_invert_sum) the
   kernel is normalised only.

   Array: normal, SPH_DIM^2 + SPH_DIM reals. Cost: a sweep before the forces and before rates. */
#include "normalised.h"
#include "arithmetic.h"

SPH_OBJECT(normalised)

#if SPH_HAS_NORMALISED
enum { SUM_S, SUM_D, SUM_X = SUM_D + SPH_DIM, SUM_Y = SUM_X + SPH_DIM, SUM_OF_NORMALS = SUM_Y + SPH_NT };
_Static_assert(SUM_OF_NORMALS <= SPH_SUMS, "SPH_SUMS is too small");

SPH_INLINE void normal_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    const vreal q = v_sqrt(sph_dot(dx, dx)) * g->inv_h, v = v_load(g->tile->m + j) * v_load(g->tile->inv_rho + j);
    const vreal slope = k_slope(g->kernel, q) * v, value = k_value(g->kernel, q) * v;
    s[SUM_S] = s[SUM_S] + value;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        s[SUM_D + k] = s[SUM_D + k] + slope * dx[k];
        s[SUM_X + k] = s[SUM_X + k] - value * dx[k];
        SPH_UNROLL
        for (int l = k; l < SPH_DIM; l++)
            s[SUM_Y + sph_sym[k][l]] = s[SUM_Y + sph_sym[k][l]] - slope * dx[k] * dx[l];
    }
}
static void normal_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    sph_gather_tile(sim, t, sph_tile_of(t, role), homes, SPH_SUM_MASK(SUM_S, SUM_OF_NORMALS), normal_pair, NULL);
}

static void normal_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h];
    const sph_real value = sim->fac.value, slope = sim->fac.slope, u = 1 / (v_fold(t->sum[SUM_S][h]) * value);
    sph_real d[SPH_DIM], m[SPH_DIM][SPH_DIM], inv[SPH_DIM][SPH_DIM];
    for (uint32_t k = 0; k < SPH_DIM; k++)
        d[k] = v_fold(t->sum[SUM_D + k][h]) * slope * (u * u);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t l = 0; l < SPH_DIM; l++)
            m[k][l] = v_fold(t->sum[SUM_Y + sph_sym[k][l]][h]) * slope * u -
                      v_fold(t->sum[SUM_X + k][h]) * value * d[l];
    const bool corrects = sim->cfg.solid == SPH_NORMALISED_CORRECTED;
    const bool fine = corrects && sph_invert_sum((const sph_real(*)[SPH_DIM])m, inv, 1);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        sph_real q = 0;
        for (uint32_t l = 0; l < SPH_DIM; l++) {
            const sph_real p = fine ? inv[l][k] : k == l ? 1 : 0;
            sim->normal[k * SPH_DIM + l][i] = p * u;
            q += p * d[l];
        }
        sim->normal[SPH_NL + k][i] = q;
    }
}
static bool normal_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_solid(s);
}
static void normal_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {normal_home, SPH_MATTER | 1u << SPH_ROLE_GHOST, SPH_SUM_MASK(SUM_S, SUM_OF_NORMALS), true, 0,
                         normal_tile, normal_finish, 0, 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool normalises(const sph_sim *sim) { return sph_normalises(&sim->cfg); }
const sph_pass sph_pass_normal = {"normal", sph_sweep_chunks, normal_chunk, NULL, normalises};
#endif
