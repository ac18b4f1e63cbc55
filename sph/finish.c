/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* finish.c: what becomes of a home's sums in the force sweep (forces.c): its acceleration with gravity and the host's
   body force, its rate of density, XSPH's velocity, and its powers for the books. Arrays: the state's acc, drho, xsph
   and the powers. Cost: a few folds of eight lanes a particle, 8 % of a step's instructions. For all homes of a cell at
   once, in vectors of four, a default dam break has 1.9 % fewer, for a second text of all this: not done. */
#include "finish.h"

#include "boundary.h"
#include "energy.h"
#include "marks.h"
#include "quadrature.h"
#include "shift_sums.h"
#include "stress.h"
#include "term.h"
#include "varying.h"
#include "arithmetic.h"

SPH_OBJECT(finish)

SPH_INLINE sph_real larger(sph_real a, sph_real b) { return a < b ? b : a; }

/* the host's body force on a home; returns its power per unit mass */
static sph_real add_body_force(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real *acc)
{
    const sph_config *c = &sim->cfg;
    const sph_buffer *b = &sim->buf[sim->dst];
    double x[SPH_DIM], v[SPH_DIM], add[SPH_DIM];
    sph_real power = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        x[k] = c->lo[k] + (double)b->pos[k][t->home_at[h]] * sim->grid.quantum;
        v[k] = (double)t->home.v[k][h];
        add[k] = 0;
    }
    c->body_force(c->body_ctx, sim->moment, x, v, add);
    for (int k = 0; k < SPH_DIM; k++) {
        acc[k] += (sph_real)add[k];
        power += (sph_real)add[k] * t->home.v[k][h];
    }
    return power;
}

/* sum m_j v_ij (x) K g of a home */
SPH_INLINE void raw_gradient(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real *raw)
{
    for (uint32_t k = 0; k < SPH_NL; k++)
        raw[k] = v_fold(t->sum[SUM_GRADIENT + k][h]) * sim->fac.slope;
}

/* powers of a home for the books, per unit mass (POWER_... in internal.h) */
static void finish_powers(sph_sim *sim, const sph_thread *t, uint32_t h,
                          sph_real body_power)
{
    const sph_factors *f = &sim->fac;
    const uint32_t i = t->home_at[h];
    const sph_set *set = &sim->set[t->home_set[h]];
    const sph_real rho = t->home.rho[h], press = t->home.press[h], moved = t->sum[SUM_BOUNDARY][h][SPH_DIM];
    const sph_real squared = sph_weak_scheme(sim->cfg.scheme) ? press / (rho * rho) : press;
    const sph_real ratio = sph_is_gas(set) ? 0 : squared; /* the energy of a gas does not follow from its density */
    const sph_real whole = SPH_WITH_SOLID && press < 0 ? sph_whole_of(&sim->buf[sim->dst], i) : 1;
    const sph_real phi = sph_quadrature_of(&sim->buf[sim->dst], i);
    sph_real in = moved, lost = 0; /* springs of boundary forces; what XSPH's drift does in gravity */
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (SPH_HAS_FORCE_WALLS && sim->has_force_wall)
            in -= t->sum[SUM_BOUNDARY][h][k] * t->home.v[k][h];
        if (sph_drifts(&sim->cfg))
            lost += f->gravity[k] * sim->buf[sim->dst].xsph[k][i];
    }
    if (SPH_HAS_LAYERED_WALLS)
        in += v_fold(t->sum[SUM_IN_WALLS][h]) * f->slope;
    if (f->loses)
        lost += v_fold(t->sum[SUM_UNBALANCED][h]) * f->slope;
    if (SPH_WITH_SOLID && sph_is_solid(set)) {
        sph_real raw[SPH_NL];
        raw_gradient(sim, t, h, raw);
        lost -= sph_stress_surplus(sim, set, i, raw, rho);
    }
    sim->power[POWER_DISSIPATED][i] = v_fold(t->sum[SUM_VISCOUS][h]) * f->slope;
    sim->power[POWER_WALL][i] = moved - v_fold(t->sum[SUM_WALL][h]) * f->slope;
    sim->power[POWER_DIFFUSED][i] = -(v_fold(t->sum[SUM_DIFFUSED][h]) * f->slope * ratio * whole * phi);
    sim->power[POWER_BODY_FORCE][i] = body_power;
    sim->power[POWER_IN_WALLS][i] = in;
    sim->power[POWER_IN_BONDS][i] = SPH_WITH_SOLID && f->bonds ? v_fold(t->sum[SUM_IN_BONDS][h]) * f->slope : 0;
    sim->power[POWER_UNBALANCED][i] = lost;
}

/* what the scene asked for besides forces: XSPH velocity, boundary forces, the body force, powers for the books */
static void finish_extras(sph_sim *sim, sph_thread *t, uint32_t h, sph_real *acc)
{
    const sph_factors *f = &sim->fac;
    const sph_config *c = &sim->cfg;
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h], still = sph_undrifting(sim, &sim->set[t->home_set[h]]);
    sph_real body_power = 0;
    for (uint32_t k = 0; sph_uses_xsph(c) && !sph_smooths_strain(c) && k < SPH_DIM; k++)
        b->xsph[k][i] = still >> k & 1 ? 0 : v_fold(t->sum[SUM_XSPH + k][h]) * (f->value * (sph_real)(2 * c->xsph));
    for (uint32_t k = 0; SPH_HAS_FORCE_WALLS && sim->has_force_wall && k < SPH_DIM; k++)
        acc[k] += t->sum[SUM_BOUNDARY][h][k];
    if (SPH_WITH_BODY_FORCE && c->body_force)
        body_power = add_body_force(sim, t, h, acc);
    if (sph_keeps_books(c))
        finish_powers(sim, t, h, body_power);
}

/* edges that let waves out */
static void finish_edges(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real *acc)
{
    const sph_set *set = &sim->set[t->home_set[h]];
    sph_real raw[SPH_NL], l[SPH_DIM][SPH_DIM] = {{0}}, v[SPH_DIM];
    for (uint32_t k = 0; k < SPH_DIM; k++)
        v[k] = t->home.v[k][h];
    if (sph_replaces(&sim->cfg)) {
        raw_gradient(sim, t, h, raw);
        sph_velocity_gradient(sim, t->home_at[h], raw, t->home.rho[h], sph_corrects(&sim->cfg), l);
    }
    sph_edge_force(sim, set, t->home_at[h], (const sph_real(*)[SPH_DIM])l, v, acc);
}

/* along the axes on which a set is held it feels no force; what moves it does work against it (and on its inertia) */
static void apply_constraint(sph_sim *sim, const sph_set *set, uint32_t i, sph_real *acc)
{
    const uint32_t held = sph_held(sim, set);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (!(held >> k & 1))
            continue;
        if (sph_keeps_books(&sim->cfg))
            sim->power[POWER_WALL][i] -= acc[k] * (sph_real)sph_wall_velocity(sim, set, k);
        acc[k] = 0;
    }
}

/* what a flow carries feels no force; what holds it does work against that, and against its compression */
static void carry_along(sph_sim *sim, const sph_thread *t, uint32_t h, sph_real *acc)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h];
    const sph_set *set = &sim->set[t->home_set[h]];
    const sph_real rho = t->home.rho[h], press = t->home.press[h];
    sph_real power = (sph_weak_scheme(sim->cfg.scheme) ? press / (rho * rho) : press) * (b->drho[0][i] * set->rho0_r);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        power += acc[k] * t->home.v[k][h];
        acc[k] = 0;
    }
    if (sph_keeps_books(&sim->cfg))
        sim->power[POWER_WALL][i] -= power;
}

/* rate of a home's relative density from its sums; solids' stress rates come with it */
static sph_real finish_rates(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_factors *f = &sim->fac;
    const sph_set *set = &sim->set[t->home_set[h]];
    sph_real d = v_fold(t->sum[SUM_DRHO][h]) * f->slope * set->inv_rho0_r;
    if (f->rate_by_density)
        d *= t->home.rho[h];
    if (sph_has_solids(&sim->cfg)) {
        const uint32_t i = t->home_at[h];
        const bool solid = sph_is_solid(set);
        sph_real raw[SPH_NL], l[SPH_DIM][SPH_DIM];
        raw_gradient(sim, t, h, raw);
        sph_velocity_gradient(sim, i, raw, t->home.rho[h], sph_corrects(&sim->cfg) && solid, l);
        if (SPH_HAS_EDGES && solid && sph_is_matched(&sim->cfg))
            sph_match_gradient(sim, set, i, l);
        d += sph_stress_rates(sim, set, i, (const sph_real(*)[SPH_DIM])l) * t->home.rho[h] * set->inv_rho0_r;
    }
    if (sph_has_energy(&sim->cfg) && sph_is_matter(set))
        sph_finish_energy(sim, t, h, d);
    return f->continuity ? d : 0;
}

/* the acceleration of a home from its sums; returns its square */
SPH_INLINE sph_real finish_forces(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_factors *f = &sim->fac;
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h];
    const sph_set *set = &sim->set[t->home_set[h]];
    sph_real acc[SPH_DIM], a2 = 0, v2 = 0;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        acc[k] = f->gravity[k] - v_fold(t->sum[SUM_ACC + k][h]) * f->slope;
    if ((SPH_HAS_EXTRAS && f->extras) || (SPH_HAS_FORCE_WALLS && sim->has_force_wall))
        finish_extras(sim, t, h, acc);
    if (SPH_HAS_EDGES && sph_has_edges(&sim->cfg) && sph_is_solid(set))
        finish_edges(sim, t, h, acc);
    if (SPH_HAS_HELD && sph_held(sim, set))
        apply_constraint(sim, set, i, acc);
    if (sph_flow_of(sim, set))
        carry_along(sim, t, h, acc);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        b->acc[k][i] = acc[k];
        a2 += acc[k] * acc[k];
        v2 += t->home.v[k][h] * t->home.v[k][h];
    }
    if (sph_shifts(&sim->cfg))
        sph_finish_shift(sim, t, h);
    const sph_real mu = v_fold_max(t->sum[SUM_MU][h]);
    t->peaks.mu = larger(t->peaks.mu, sph_has_energy(&sim->cfg) ? sph_energy_mu(sim, t, h, mu) : mu);
    t->peaks.acc = larger(t->peaks.acc, sph_told_acc(sim, t, h, a2));
    t->peaks.speed = larger(t->peaks.speed, v2);
    return a2;
}

/* forces and rates of one particle from its sums */
void sph_finish_home(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h];
    const sph_set *set = &sim->set[t->home_set[h]];
    sph_real a2 = 0, d = 0;
    if (sph_sums_rates(sim))
        d = b->drho[0][i] = finish_rates(sim, t, h);
    if (!sph_is_matter(set))
        return;
    if (sph_sums_forces(sim))
        a2 = finish_forces(sim, t, h);
    if (!(a2 + d * d < SPH_LIMIT_SQUARE)) /* also catches not-a-number */
        sph_fail_note(t, SPH_NOT_FINITE, sim->buf[sim->src].id[0][b->id[0][i]], (double)a2);
}
