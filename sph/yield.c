/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* yield.c: von Mises' yield: wherever the deviatoric stress S has advanced it returns to the yield surface.

     P(S) = S f, f = Y/sqrt(3 J2) where that is below 1, J2 = S:S/2 with the zz part (Gray 2001 eqs 5.13-5.15 mended)

   P alone is of first order in time: with a stress on the surface, radius R, at an angle a to the strain rate e, the
   flow is da/dt = -(2 mu |e|/R) sin a, and P of S + 2 mu e dt is backward Euler of it: with z = 2 mu |e| dt/R it leaves
   a - z sin a + z^2 sin a cos a, where the flow has half of the last term. Two halves of the step leave 3/4 of it, so
   twice those less the whole is right to second order; then P once more. It begins with the stress of src. Gray's
   printed form, which returns to inside of the surface, stays as it is.

   Array: plastic (one real in every state buffer). Cost: a loop over solids after every advance; no sweep. */
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(yield)

#if SPH_HAS_YIELD

/* places of the stress's components; those that the dimension has not are never asked for */
enum { YY = SPH_DIM > 1 ? 1 : 0, XY = SPH_DIM > 1 ? 2 : 0, XZ = SPH_DIM > 2 ? 3 : 0, YZ = SPH_DIM > 2 ? 4 : 0 };

typedef struct sph_yielding {
    sph_real s[SPH_NS], plastic;
} sph_yielding;

/* S:S; the out-of-plane parts included unless `plane` */
static sph_real invariant(const sph_real *s, bool plane)
{
    const sph_real x = s[0];
    if (SPH_DIM == 1) /* yy = zz = -xx/2 */
        return x * x * (plane ? 1 : (sph_real)1.5);
    const sph_real y = s[YY], xy = s[XY], z = plane && SPH_DIM == 2 ? 0 : x + y;
    if (SPH_DIM == 2)
        return x * x + y * y + z * z + 2 * (xy * xy);
    const sph_real xz = s[XZ], yz = s[YZ];
    return x * x + y * y + z * z + 2 * (xy * xy + xz * xz + yz * yz);
}

/* P: back to the yield surface; false: it is inside */
static bool return_to_surface(const sph_material *rock, bool printed, sph_yielding *p)
{
    const sph_real y0 = (sph_real)rock->yield, hard = (sph_real)rock->hardening, mu3 = 3 * rock->shear_r;
    const sph_real y = y0 + hard * p->plastic, s3 = (sph_real)1.5 * invariant(p->s, printed); /* 3 J2 */
    if (!(s3 > y * y))
        return false;
    const sph_real q = SPH_SQRT(s3);
    sph_real strain, f;
    if (printed) {
        f = y * y / s3;
        strain = (q - q * f) / mu3;
    } else {
        strain = (q - y) / (mu3 + hard);
        f = (y + hard * strain) / q;
    }
    p->plastic += strain;
    for (uint32_t k = 0; k < SPH_NS; k++)
        p->s[k] *= f;
    return true;
}

/* the stress that particle i had in src, turned as it has been since */
static void stress_before(const sph_sim *sim, uint32_t i, sph_real *s)
{
    static const uint8_t planes[] = {3, 5, 6}; /* xy, xz, yz */
    const uint32_t p = sph_source_index(sim)[i], diagonal = SPH_DIM == 1 ? 1 : 2;
    for (uint32_t k = 0; k < SPH_NS; k++) {
        const uint32_t mask = k < diagonal ? 0 : SPH_TURNS_TENSORS * planes[(k - diagonal) % 3];
        const bool turns = SPH_HAS_MIRRORS && sim->turned && mask;
        s[k] = (turns ? sph_turn_of(sim, p, mask) : 1) * sim->buf[sim->src].stress[k][p];
    }
}

/* of a whole way from src: two halves of it, twice, less the whole (see above) */
static void return_twice(const sph_sim *sim, const sph_material *rock, uint32_t i, const sph_yielding *trial,
                         sph_yielding *one)
{
    sph_yielding two = *trial;
    sph_real before[SPH_NS], half[SPH_NS];
    stress_before(sim, i, before);
    for (uint32_t k = 0; k < SPH_NS; k++) {
        half[k] = (trial->s[k] - before[k]) * (sph_real)0.5;
        two.s[k] = before[k] + half[k];
    }
    return_to_surface(rock, false, &two);
    for (uint32_t k = 0; k < SPH_NS; k++)
        two.s[k] += half[k];
    return_to_surface(rock, false, &two);
    const sph_real plastic = 2 * two.plastic - one->plastic;
    one->plastic = plastic < trial->plastic ? trial->plastic : plastic;
    for (uint32_t k = 0; k < SPH_NS; k++)
        one->s[k] = 2 * two.s[k] - one->s[k];
    return_to_surface(rock, false, one);
}

/* returns the stresses of a run of one set to the yield surface */
static void yield_run(const sph_sim *sim, const sph_material *rock, uint32_t first, uint32_t last, bool whole)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const bool printed = sim->cfg.yield == SPH_VON_MISES_GRAY;
    for (uint32_t i = first; i < last; i++) {
        sph_yielding trial, p;
        for (uint32_t k = 0; k < SPH_NS; k++)
            trial.s[k] = b->stress[k][i];
        trial.plastic = b->plastic[0][i];
        p = trial;
        if (!return_to_surface(rock, printed, &p))
            continue;
        if (whole && !printed)
            return_twice(sim, rock, i, &trial, &p);
        b->plastic[0][i] = p.plastic;
        for (uint32_t k = 0; k < SPH_NS; k++)
            b->stress[k][i] = p.s[k];
    }
}

void sph_yield(const sph_sim *sim, sph_span s, bool whole)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    if (!sph_yields(&sim->cfg))
        return;
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        if (b->set[0][i] != SPH_DEAD && sim->material[b->set[0][i]].yield > 0)
            yield_run(sim, &sim->material[b->set[0][i]], i, e, whole);
    }
}
#endif
