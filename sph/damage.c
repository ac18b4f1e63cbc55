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

/* energy that damage has a share in */
static double held_in(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const sph_energy e = sph_energy_of(sim, b, i);
    return e.elastic + e.internal;
}

void sph_grow_damage(const sph_sim *sim, sph_span s, double *books)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t *id = b->id[0]; /* the particle's own by now */
    if (!sph_damages(&sim->cfg))
        return;
    for (uint32_t i = s.first; i < s.last; i++) {
        if (b->set[0][i] == SPH_DEAD || !sph_is_solid(&sim->set[b->set[0][i]]) || !(b->damage[0][i] < 1))
            continue;
        const sph_set *set = &sim->set[b->set[0][i]];
        const uint32_t from = sim->flaw_start[id[i]], flaws = sim->flaw_start[id[i] + 1] - from;
        if (flaws == 0)
            continue;
        const sph_real root = b->damage[0][i], damage = SPH_DIM == 3 ? root * root * root : root * root;
        const sph_real strain = flaw_strain(sim, set, b, i, 1 - damage);
        uint32_t active = 0;
        while (active < flaws && (sph_real)sim->flaw[from + active] < strain)
            active++;
        const sph_real most = active == flaws ? 1 : root_of((sph_real)active / (sph_real)flaws);
        if (root >= most) /* also without any active flaw */
            continue;
        const sph_real grown = root + (sph_real)(sim->dt * sph_material_of(sim, set)->crack_rate) * (sph_real)active;
        const double held = SPH_WITH_BOOKS && books ? held_in(sim, b, i) : 0;
        b->damage[0][i] = grown < most ? grown : most;
        if (SPH_WITH_BOOKS && books)
            books[JUMP_RELEASED] += held - held_in(sim, b, i);
    }
}
#endif
