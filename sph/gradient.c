/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* gradient.c: corrected gradients of fluids (gradient.h): the sum M, its inverse, and what a particle brings to a
   tile.

   Array: N (Bonet & Lok) or B (renormalised), symmetric, SPH_DIM (SPH_DIM + 1)/2 reals. Cost: a sweep before the
   forces. With gradient_guard T has less of the correction at a surface (guarded_share): there the whole one stirs
   water at rest, row against row. Where the neighbours do not span space (sph_invert_sum, of E = M/rho) the plain
   gradient is taken. */
#include "gradient.h"
#include "arithmetic.h"

SPH_OBJECT(gradient)

#if SPH_HAS_FLUID_GRADIENT
/* The guard: how much of the correction the force of the pressure has, by det E; of a lattice at h 1.2 .. 2.5 spacings
   0.37 .. 0.32 in the outermost row at a flat surface, 0.90 .. 0.54 in the next */
#define GUARD_NONE 0.3
#define GUARD_ALL 0.6

SPH_INLINE vreal determinant(const vreal *b)
{
    const vreal x = b[0];
    if (SPH_DIM == 1)
        return x;
    const vreal y = b[sph_sym[1][1]], xy = b[sph_sym[0][1]];
    if (SPH_DIM == 2)
        return x * y - xy * xy;
    const vreal z = b[sph_sym[2][2]], xz = b[sph_sym[0][2]], yz = b[sph_sym[1][2]];
    return x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz);
}
SPH_INLINE vreal guarded_share(const vreal *b) /* of B = E^-1 */
{
    const vreal share = (1 / determinant(b) - (sph_real)GUARD_NONE) * (sph_real)(1 / (GUARD_ALL - GUARD_NONE));
    const vreal least = v_max(share, v_set(0));
    return v_select(v_less(least, v_set(1)), least, v_set(1));
}

/* N with the guard, in place of N */
SPH_INLINE void guard_gradient(const sph_candidates *r, uint32_t j, bool weak, vreal *n)
{
    const vreal rho = weak ? v_set(1) : v_load(r->tile->rho + r->at + j), plain = 1 / rho;
    vreal b[SPH_NT];
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_NT; k++)
        b[k] = n[k] * rho;
    const vreal share = guarded_share(b);
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_NT; k++)
        n[k] = k < SPH_DIM ? plain + share * (n[k] - plain) : share * n[k];
}

void sph_load_gradient(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const sph_config *c = &r->sim->cfg;
    const bool weak = sph_weak_scheme(c->scheme), bonet = SPH_IS(c->gradient, BONET_LOK);
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        vreal w = v_load(r->tile->press + r->at + j); /* p, or p/rho^2 */
        if (!weak)
            w = w * v_load(r->tile->rho + r->at + j);
        vreal own[SPH_NT];
        SPH_UNROLL
        for (uint32_t n = 0; n < SPH_NT; n++)
            own[n] = v_load(r->sim->gradient[n] + r->first + j);
        if (sph_guards_gradient(c))
            guard_gradient(r, j, weak, own);
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            SPH_UNROLL
            for (uint32_t l = k; l < SPH_DIM; l++) {
                const uint32_t n = sph_sym[k][l];
                v_store(to + n * row + j, sph_seen_tensor(r, k, l, bonet ? own[n] * w : own[n]));
            }
    }
}

/* the tile's part of -M */
SPH_INLINE void gradient_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const bool weak = *(const bool *)g->own;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    vreal mg = sph_gather_slope(g, dx) * v_load(g->tile->m + j);
    if (weak)
        mg = mg * v_load(g->tile->inv_rho + j);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        SPH_UNROLL
        for (int l = k; l < SPH_DIM; l++)
            s[sph_sym[k][l]] = s[sph_sym[k][l]] + mg * dx[k] * dx[l];
}
static void gradient_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    static const bool standard = false;
    const bool weak = sph_weak_scheme(sim->cfg.scheme);
    const sph_tile *const tile = sph_tile_of(t, role);
    if (SPH_WITH_FAST_PATHS && SPH_IS(sim->cfg.kernel, WENDLAND_C2) && !weak)
        sph_gather_by(SPH_WENDLAND_C2, sim, t, tile, homes, SPH_SUM_MASK(0, SPH_NT), gradient_pair, &standard);
    else
        sph_gather_by(sim->cfg.kernel, sim, t, tile, homes, SPH_SUM_MASK(0, SPH_NT), gradient_pair, &weak);
}

static void gradient_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const bool weak = sph_weak_scheme(sim->cfg.scheme), bonet = SPH_IS(sim->cfg.gradient, BONET_LOK);
    const sph_real inv_rho = 1 / t->home.rho[h], scale = weak ? 1 : inv_rho, back = bonet ? scale : 1;
    sph_real e[SPH_DIM][SPH_DIM], inv[SPH_DIM][SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = k; l < SPH_DIM; l++)
            e[k][l] = e[l][k] = -v_fold(t->sum[sph_sym[k][l]][h]) * sim->fac.slope * scale;
    const bool fine = sph_invert_sum((const sph_real(*)[SPH_DIM])e, inv, 1);
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = k; l < SPH_DIM; l++)
            sim->gradient[sph_sym[k][l]][t->home_at[h]] = (fine ? inv[k][l] : k == l ? 1 : 0) * back;
}

static void gradient_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {sph_matter_home, SPH_MATTER | 1u << SPH_ROLE_GHOST, SPH_SUM_MASK(0, SPH_NT),
                         sph_weak_scheme(sim->cfg.scheme), 0, gradient_tile, gradient_finish, 0, 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool corrects_fluids(const sph_sim *sim) { return sph_corrects_fluids(&sim->cfg); }
const sph_pass sph_pass_gradient = {"gradient", sph_sweep_chunks, gradient_chunk, NULL, corrects_fluids};
#endif
