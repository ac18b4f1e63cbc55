/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* hourglass.c: F of each particle (hourglass.h), and what it brings of it to a tile.

   Array: deform, SPH_DIM^2 reals of F, and 1 where it is known (else 0: the bonds do not span space). Cost: a sweep
   before the forces. */
#include "hourglass.h"
#include "arithmetic.h"

SPH_OBJECT(hourglass)

#if SPH_HAS_HOURGLASS
enum { SUM_BENT, SUM_STRAIGHT = SPH_NL, SUM_OF_BONDS = SPH_NL + SPH_NT };
_Static_assert(SUM_OF_BONDS <= SPH_SUMS, "SPH_SUMS is too small");

/* hourglass E/rho0^2, E of the set's bulk and shear modulus */
static sph_real stiffness_of(const sph_sim *sim, const sph_set *set)
{
    const double bulk = set->rho0 * set->c0 * set->c0 * (SPH_IS(set->eos, TAIT_GRAY) ? 7 : 1);
    const double mu = (double)sph_material_of(sim, set)->shear_r;
    return (sph_real)(sim->cfg.hourglass * (9 * bulk * mu / (3 * bulk + mu)) / (set->rho0 * set->rho0));
}

void sph_load_deform(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const bool solid = sph_is_solid(r->set);
    const sph_real stiff = solid ? stiffness_of(r->sim, r->set) : 0;
    for (uint32_t j = 0; j < r->n; j++) {
        const uint32_t i = r->first + j;
        for (uint32_t k = 0; k < SPH_NL; k++) {
            const uint32_t row_axis = k / SPH_DIM, axis = k % SPH_DIM;
            const sph_real turn = (sph_real)(r->im->sign[row_axis] * r->im->sign[axis]);
            to[k * row + j] = solid ? r->sim->deform[k][i] * turn : 0;
        }
        to[SPH_NL * row + j] = solid ? r->sim->deform[SPH_NL][i] * stiff * sph_whole_of(r->b, i) : 0;
    }
}

typedef struct bonds {
    sph_reference_home home;
    const sph_reference_tile *tile;
} bonds;

SPH_INLINE void bond_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const bonds *const o = g->own;
    vreal dx[SPH_DIM], k[SPH_DIM];
    vint same, apart;
    sph_gather_distance(g, j, dx);
    sph_reference_distance(&o->home, o->tile, j, dx, k, &same, &apart);
    const vreal mg = v_where(same, sph_gather_slope(g, k) * v_load(g->tile->m + j));
    SPH_UNROLL
    for (int a = 0; a < SPH_DIM; a++)
        SPH_UNROLL
        for (int b = 0; b < SPH_DIM; b++) {
            s[SUM_BENT + a * SPH_DIM + b] = s[SUM_BENT + a * SPH_DIM + b] + mg * dx[a] * k[b];
            if (b >= a)
                s[SUM_STRAIGHT + sph_sym[a][b]] = s[SUM_STRAIGHT + sph_sym[a][b]] + mg * k[a] * k[b];
        }
}
static void bond_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    bonds own = {.tile = sph_reference_of(sim, t)};
    (void)role;
    for (uint32_t h = 0; h < homes; h++) {
        own.home = sph_spread_reference(sph_reference_homes_of(sim, t), h);
        const sph_gather g = {t, sph_near_of(t, &t->matter), h, sim->cfg.kernel, v_set(sim->fac.inv_h), &own};
        sph_sum_home(sim, t, &t->matter, h, SPH_SUM_MASK(SUM_BENT, SUM_OF_BONDS), bond_pair, &g);
    }
}
static void bond_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h];
    const sph_real scale = -sim->fac.slope / t->home.rho[h];
    sph_real a[SPH_DIM][SPH_DIM], inv[SPH_DIM][SPH_DIM];
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t l = 0; l < SPH_DIM; l++)
            a[k][l] = v_fold(t->sum[SUM_STRAIGHT + sph_sym[k][l]][h]) * scale;
    const bool fine = sph_invert_sum((const sph_real(*)[SPH_DIM])a, inv, 1);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t l = 0; l < SPH_DIM; l++) {
            sph_real f = 0;
            for (uint32_t m = 0; m < SPH_DIM && fine; m++)
                f += v_fold(t->sum[SUM_BENT + k * SPH_DIM + m][h]) * scale * inv[m][l];
            sim->deform[k * SPH_DIM + l][i] = f;
        }
    sim->deform[SPH_NL][i] = fine ? 1 : 0;
}
static bool bond_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_solid(s);
}
static void bond_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {bond_home, SPH_MATTER, SPH_SUM_MASK(SUM_BENT, SUM_OF_BONDS), false,
                         1u << SPH_COLUMN_reference, bond_tile, bond_finish, 0, 1 + SPH_COLUMN_reference};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool holds_bonds(const sph_sim *sim) { return sph_resists_hourglass(&sim->cfg) && sph_sums_forces(sim); }
const sph_pass sph_pass_bonds = {"bonds", sph_sweep_chunks, bond_chunk, NULL, holds_bonds};
#endif
