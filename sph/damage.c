/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damage.c: flaws and the damage that grows from them (Benz & Asphaug 1995; Gray 2001 section 5.5), in 2-D and 3-D.

     flaws    n(eps) = k eps^m of them a unit volume fail below the strain eps (Weibull); thresholds (p/(k V))^(1/m)
     growth   d(D^(1/DIM))/dt = active crack_speed/flaw_radius while D < active/flaws
     stress   -P* I + (1 - D) S, P* = P in compression and (1 - D) P in tension (taken where stresses are loaded)

   Arrays: damage (one real in every state buffer), flaw_start (4 bytes a particle), flaws (4 bytes each, in order of
   particle id, rising thresholds). Cost: a local pass; no sweep. */
#include "locals.h"
#include "tensor.h"
#include "arithmetic.h"

SPH_OBJECT(damage)

#if SPH_HAS_DAMAGE
#include "dmath.h"

/* ---- growth ---- */

/* the largest principal value of a symmetric tensor xx yy zz xy xz yz; in plane strain zz is principal too */
static sph_real largest_in_plane(const sph_real *s)
{
    const sph_real m = (s[0] + s[1]) * (sph_real)0.5, a = (s[0] - s[1]) * (sph_real)0.5;
    const sph_real one = m + SPH_SQRT(a * a + s[3] * s[3]);
    return one < s[2] ? s[2] : one;
}
static sph_real largest_in_space(const sph_real *s)
{
    static const uint8_t at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    vreal a[3][3], axes[3][3];
    sph_real most = 0;
    for (int k = 0; k < 9; k++)
        a[k / 3][k % 3] = v_set(s[at[k / 3][k % 3]]);
    sph_principal(a, axes);
    for (int k = 0; k < 3; k++) {
        sph_real lanes[SPH_W];
        v_store(lanes, a[k][k]);
        most = k == 0 || lanes[0] > most ? lanes[0] : most;
    }
    return most;
}
static sph_real largest_principal(const sph_real *s)
{
    return SPH_DIM == 2 ? largest_in_plane(s) : largest_in_space(s);
}

/* strain that flaws compare themselves with */
static sph_real flaw_strain(const sph_sim *sim, const sph_set *set, const sph_buffer *b, uint32_t i, sph_real whole)
{
    double at[6];
    sph_real s[6];
    (void)sph_stress_of(sim, b, i, at);
    for (int k = 0; k < 6; k++)
        s[k] = (sph_real)at[k];
    const sph_real most = largest_principal(s), mu = sph_material_of(sim, set)->shear_r;
    const sph_real bulk = (sph_real)(set->rho0 * set->c0 * set->c0), young = 9 * bulk * mu / (3 * bulk + mu);
    if (!(most > 0) || !(whole > 0))
        return 0;
    const sph_real d = 1 - whole;
    return sim->cfg.damage == SPH_BENZ_ASPHAUG_GRAY ? most / (2 * mu * (1 - d * d)) : most / (whole * young);
}

static sph_real root_of(sph_real x)
{
    if (SPH_DIM == 2)
        return SPH_SQRT(x);
    return x > 0 ? (sph_real)sph_pow((double)x, 1.0 / 3) : 0;
}

/* D^(1/DIM) of particle i of b, dt later */
static sph_real grown_root(const sph_sim *sim, const sph_buffer *b, uint32_t i, sph_real dt)
{
    const sph_set *set = &sim->set[b->set[0][i]];
    const uint32_t id = b->id[0][i], from = sim->flaw_start[id], flaws = sim->flaw_start[id + 1] - from;
    const sph_real root = b->damage[0][i];
    if (flaws == 0 || !(root < 1))
        return root;
    const sph_real strain = flaw_strain(sim, set, b, i, sph_whole_of(b, i));
    uint32_t active = 0;
    while (active < flaws && (sph_real)sim->flaw[from + active] < strain)
        active++;
    const sph_real most = active == flaws ? 1 : root_of((sph_real)active / (sph_real)flaws);
    if (root >= most) /* also without any active flaw */
        return root;
    const sph_real grown = root + dt * (sph_real)sph_material_of(sim, set)->crack_rate * (sph_real)active;
    return grown < most ? grown : most;
}

/* Of a step's end the forces are made with the damage of that end: so it grows before them, by what the strain was at
   the step's beginning. Grown behind them it would lag by a step, and all fields be of first order. */
void sph_grow_damage(const sph_sim *sim, sph_span s, sph_real dt)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint32_t *at = sph_source_index(sim);
    if (!sph_damages(&sim->cfg) || !(dt > 0))
        return;
    for (uint32_t i = s.first; i < s.last; i++)
        if (b->set[0][i] != SPH_DEAD && sph_is_solid(&sim->set[b->set[0][i]]))
            b->damage[0][i] = grown_root(sim, o, at[i], dt);
}

/* energy that damage has a share in, of which 1 - D is left, J */
static double shared_energy(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const sph_set *set = &sim->set[b->set[0][i]];
    const double mu = sph_material_of(sim, set)->shear, d = (double)b->rho[0][i];
    const double x = (double)b->stress[0][i], y = (double)b->stress[SPH_DIM > 1][i];
    double w = x * x + y * y + (x + y) * (x + y);
    for (int k = 2; k < SPH_NS; k++)
        w += 2 * (double)b->stress[k][i] * (double)b->stress[k][i];
    const double stored = sph_eos_energy(set->eos, (double)set->b_r, set->rho0, d, false);
    const double tension = sph_pressure(sim, set, d) < 0 ? stored : 0;
    return set->mass * (tension + (mu > 0 ? w / (4 * mu * set->rho0) : 0));
}

void sph_book_damage(const sph_sim *sim, sph_span s, double *books)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint32_t *at = sph_source_index(sim);
    if (!sph_damages(&sim->cfg) || !books)
        return;
    for (uint32_t i = s.first; i < s.last; i++)
        if (b->set[0][i] != SPH_DEAD && sph_is_solid(&sim->set[b->set[0][i]]) &&
            b->damage[0][i] > o->damage[0][at[i]]) /* the trapezoidal rule */
            books[JUMP_RELEASED] += 0.5 * (shared_energy(sim, o, at[i]) + shared_energy(sim, b, i)) *
                                    (double)(sph_whole_of(o, at[i]) - sph_whole_of(b, i));
}
#endif
