/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* mls.c: density made anew by moving least squares of order 1 (Wickramarachchi 2009 eqs A.4.1-A.4.7; Colagrossi and
   Landrini 2003): with V = m/rho, d = rho - rho0 and p = (1, x_ij/h) over what is of the same material

     d_i = (A^-1 b)_0,  A = sum V W p (x) p,  b = sum V W d_j p

   which is exact for densities that are linear in place, also at a surface; d instead of rho, so that rounding is of
   the difference (constants are reproduced, so it is the same). With A = (a, m; m, M): d_i = (b_0 - c.b')/(a - c.m),
   c = M^-1 m. Where the neighbours do not span space the mean of order 0 is taken, b_0/a: that of the Shepard filter.
   Array: that of the Shepard filter. Cost: a sweep. */
#include "pair.h"
#include "arithmetic.h"

SPH_OBJECT(mls)

#if SPH_WITH_MLS
enum { SUM_A, SUM_B, SUM_MOMENT, SUM_F = SUM_MOMENT + SPH_DIM, SUM_T = SUM_F + SPH_DIM, MLS_SUMS = SUM_T + SPH_NT };
_Static_assert(MLS_SUMS <= SPH_SUMS, "SPH_SUMS is too small");

SPH_INLINE void mls_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const sph_real *const rho0 = g->own;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    const vreal w = sph_gather_value(g, dx) * (v_load(g->tile->m + j) * v_load(g->tile->inv_rho + j));
    const vreal wd = w * (v_load(g->tile->rho + j) - *rho0);
    s[SUM_A] = s[SUM_A] + w;
    s[SUM_B] = s[SUM_B] + wd;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        const vreal x = dx[k] * g->inv_h;
        s[SUM_MOMENT + k] = s[SUM_MOMENT + k] + w * x;
        s[SUM_F + k] = s[SUM_F + k] + wd * x;
        SPH_UNROLL
        for (int l = k; l < SPH_DIM; l++)
            s[SUM_T + sph_sym[k][l]] = s[SUM_T + sph_sym[k][l]] + w * x * (dx[l] * g->inv_h);
    }
}
static void mls_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    for (uint32_t h = 0; h < homes; h++) {
        const sph_set *set = &sim->set[t->home_set[h]];
        const sph_gather g = {t, sph_near_of(t, &t->matter), h, sim->cfg.kernel, v_set(sim->fac.inv_h), &set->rho0_r};
        if (!SPH_WITH_SEVERAL_FLUIDS || !sim->mixed || t->of->kin == set->kin)
            sph_sum_home(sim, t, &t->matter, h, SPH_SUM_MASK(0, MLS_SUMS), mls_pair, &g);
    }
}

static void mls_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_real rho0 = sim->set[t->home_set[h]].rho0_r, a = v_fold(t->sum[SUM_A][h]), b = v_fold(t->sum[SUM_B][h]);
    const sph_real size = a * (sph_real)0.01;
    sph_real m[SPH_DIM][SPH_DIM], inv[SPH_DIM][SPH_DIM], up = b, down = a;
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            m[k][l] = v_fold(t->sum[SUM_T + sph_sym[k][l]][h]);
    const sph_real least = SPH_DIM == 1 ? size : SPH_DIM == 2 ? size * size : size * size * size;
    const bool spans = sph_invert((const sph_real(*)[SPH_DIM])m, inv, least);
    for (int k = 0; k < SPH_DIM && spans; k++) {
        sph_real c = 0;
        for (int l = 0; l < SPH_DIM; l++)
            c += inv[k][l] * v_fold(t->sum[SUM_MOMENT + l][h]);
        up -= c * v_fold(t->sum[SUM_F + k][h]);
        down -= c * v_fold(t->sum[SUM_MOMENT + k][h]);
    }
    const bool fine = down > (sph_real)0.05 * a;
    sim->tmp[t->home_at[h]] = (fine ? up / down : b / a) / rho0;
}
static void mls_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {sph_matter_home, SPH_MATTER, SPH_SUM_MASK(0, MLS_SUMS), true, 0, mls_tile, mls_finish,
                         SPH_WITH_SEVERAL_FLUIDS && sim->mixed ? SPH_APART_KIN : 0, 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool mls_now(const sph_sim *sim) { return SPH_IS(sim->cfg.filter, MLS) && sph_filters_now(sim); }
const sph_pass sph_pass_mls = {"mls", sph_sweep_chunks, mls_chunk, NULL, mls_now};
#endif
