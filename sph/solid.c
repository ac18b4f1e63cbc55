/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* solid.c: stress. Rates of the deviatoric stress, its way through a step, yield, corrected gradients, smoothed velocities
   for the strain rates. The pair formulas are in solid.h and fluid.c; flaws and damage in damage.c.

     rates      dS/dt = 2 mu (e - tr e/3) + W S - S W,  e = (L + L^T)/2, W = (L - L^T)/2   (Jaumann; Gray 2001 eqs 5.7-5.9)
     yield      S f, f = Y/sqrt(3 J2) where that is below 1, J2 = S:S/2 with the zz part      (von Mises; Gray 5.13-5.15 mended)
     correction M = -sum m_j x_ij (x) K g, kept as M^-1; not over pairs of two bodies         (Bonet & Lok 1999)
     smoothing  xsph, for strain rates from v + xsph                                         (Gray 2001 eqs 2.22, 5.10)

   Arrays: stress and dstress (1, 3 or 5 reals each, in every state buffer), plastic, shift where chosen; M^-1 (DIM^2 reals, once).
   Cost: the sums of the force sweep, a local pass after every sort, and a sweep each for correction and smoothing. */
#include "solid.h"

#if SPH_WITH_SOLID
#include "fluid.h"
#include "kernels.h"

/* ---- the stress's way through a step ---- */

#if SPH_HAS_YIELD
/* S:S of particle i; the out-of-plane parts included unless `plane` */
static sph_real square(const sph_buffer *b, uint32_t i, bool plane)
{
#if SPH_DIM == 1
    const sph_real x = b->stress[0][i]; /* yy = zz = -xx/2 */
    return x * x * (plane ? 1 : (sph_real)1.5);
#elif SPH_DIM == 2
    const sph_real x = b->stress[0][i], y = b->stress[1][i], xy = b->stress[2][i], z = plane ? 0 : x + y;
    return x * x + y * y + z * z + 2 * (xy * xy);
#else
    const sph_real x = b->stress[0][i], y = b->stress[1][i], xy = b->stress[2][i], xz = b->stress[3][i], yz = b->stress[4][i];
    (void)plane;
    return x * x + y * y + (x + y) * (x + y) + 2 * (xy * xy + xz * xz + yz * yz);
#endif
}

/* returns the stresses of a run of one set to the yield surface */
static void yield_run(const sph_sim *sim, const sph_material *rock, const sph_buffer *b, uint32_t first, uint32_t last)
{
    const bool printed = sim->cfg.yield == SPH_VON_MISES_GRAY;
    const sph_real y0 = (sph_real)rock->yield, hard = (sph_real)rock->hardening, mu3 = 3 * rock->shear_r;
    for (uint32_t i = first; i < last; i++) {
        const sph_real y = y0 + hard * b->plastic[0][i], s3 = (sph_real)1.5 * square(b, i, printed); /* 3 J2 */
        if (!(s3 > y * y))
            continue;
        const sph_real q = SPH_SQRT(s3);
        sph_real strain, f;
        if (printed) {
            f = y * y / s3;
            strain = (q - q * f) / mu3;
        } else {
            strain = (q - y) / (mu3 + hard);
            f = (y + hard * strain) / q;
        }
        b->plastic[0][i] += strain;
        for (uint32_t k = 0; k < SPH_NS; k++)
            b->stress[k][i] *= f;
    }
}
#endif

#if SPH_HAS_TOTAL
/* displacement since the start: what the particle moved in this stage, round a periodic domain if need be */
static void add_shift(const sph_sim *sim, uint32_t i, uint32_t p)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const sph_pos half = sim->grid.extent[k] / 2;
        sph_pos d = b->pos[k][i] - o->pos[k][p];
        if (SPH_IS(sim->cfg.face[k][0], PERIODIC))
            d = d > half ? d - sim->grid.extent[k] : d < -half ? d + sim->grid.extent[k] : d;
        b->shift[k][i] = o->shift[k][p] + d;
    }
}
#endif

/* new = old + dt rate, in one of the ways of an integrator; ids are still indices of the source buffer */
void sph_advance_stress(sph_sim *sim, uint32_t first, uint32_t last, uint32_t how)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint32_t *from = b->id[0];
    const sph_real dt = (sph_real)sim->dt, half = dt * (sph_real)0.5, rate = sph_stage_rate(sim) * dt;
    for (uint32_t k = 0; k < SPH_NS; k++) {
        sph_real *s = b->stress[k];
        const sph_real *d = b->dstress[k], *os = o->stress[k], *od = o->dstress[k];
        if (how == SPH_STRESS_CARRY)
            for (uint32_t i = first; i < last; i++)
                s[i] = os[from[i]] + rate * od[from[i]];
        else if (how == SPH_STRESS_CORRECT)
            for (uint32_t i = first; i < last; i++)
                s[i] = s[i] + half * (d[i] - od[from[i]]);
        else if (how == SPH_STRESS_WHOLE)
            for (uint32_t i = first; i < last; i++)
                s[i] = s[i] + dt * d[i];
        else
            for (uint32_t i = first; i < last; i++)
                s[i] = os[from[i]] + dt * d[i];
    }
    const bool carries = how == SPH_STRESS_CARRY || how == SPH_STRESS_RK;
    for (uint32_t i = first; i < last && carries && SPH_HAS_YIELD && b->plastic[0]; i++)
        b->plastic[0][i] = o->plastic[0][from[i]];
    for (uint32_t i = first; i < last && how == SPH_STRESS_CARRY && SPH_HAS_DAMAGE && b->damage[0]; i++)
        b->damage[0][i] = o->damage[0][from[i]];
#if SPH_HAS_TOTAL
    for (uint32_t i = first; i < last && carries && b->shift[0]; i++)
        add_shift(sim, i, from[i]);
#endif
#if SPH_HAS_YIELD
    for (uint32_t i = first, e; i < last && b->plastic[0]; i = e) {
        e = sph_run_end(b->set[0], i, last);
        if (b->set[0][i] != SPH_DEAD && sim->material[b->set[0][i]].yield > 0)
            yield_run(sim, &sim->material[b->set[0][i]], b, i, e);
    }
#endif
}

static bool has_solids(const sph_sim *sim) { return sph_has_solids(&sim->cfg); }

static void carry_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const uint32_t i = chunk * SPH_LOCAL_CHUNK, last = i + SPH_LOCAL_CHUNK < sim->next.count ? i + SPH_LOCAL_CHUNK : sim->next.count;
    sph_advance_stress(sim, i, last, SPH_STRESS_CARRY);
    for (uint32_t k = 0; k < SPH_NS; k++) /* walls get no rates */
        memset(sim->buf[sim->dst].dstress[k] + i, 0, (last - i) * sizeof(sph_real));
    t->work += last - i;
}
const sph_pass sph_pass_carry = {"stress", sph_local_chunks, carry_chunk, NULL, has_solids};

/* the stress after damage, for those who look at it between steps */
double sph_stress_of(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *stress)
{
    const sph_set *set = &sim->set[b->set[0][i]];
    double p = sph_pressure(sim, set, (double)b->rho[0][i]), damage = 0, d[5] = {0};
    if (SPH_HAS_DAMAGE && b->damage[0]) {
        const double root = (double)b->damage[0][i];
        damage = SPH_DIM == 3 ? root * root * root : root * root;
    }
    for (uint32_t k = 0; k < SPH_NS; k++)
        d[k] = (double)b->stress[k][i] * (1 - damage);
    p = p < 0 ? p * (1 - damage) : p;
#if SPH_DIM == 1
    const double s[6] = {d[0], -0.5 * d[0], -0.5 * d[0], 0, 0, 0};
#elif SPH_DIM == 2
    const double s[6] = {d[0], d[1], -(d[0] + d[1]), d[2], 0, 0};
#else
    const double s[6] = {d[0], d[1], -(d[0] + d[1]), d[2], d[3], d[4]};
#endif
    for (int k = 0; k < 6; k++)
        stress[k] = s[k] - (k < 3 ? p : 0);
    return damage;
}
#endif
