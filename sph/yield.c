/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* yield.c: von Mises' yield: wherever the deviatoric stress S has advanced it returns to the yield surface.

     S f, f = Y/sqrt(3 J2) where that is below 1, J2 = S:S/2 with the zz part      (Gray 2001 eqs 5.13-5.15 mended)

   Array: plastic (one real in every state buffer). Cost: a loop over solids after every advance; no sweep. */
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(yield)

#if SPH_HAS_YIELD

/* places of the stress's components; those that the dimension has not are never asked for */
enum { YY = SPH_DIM > 1 ? 1 : 0, XY = SPH_DIM > 1 ? 2 : 0, XZ = SPH_DIM > 2 ? 3 : 0, YZ = SPH_DIM > 2 ? 4 : 0 };

/* S:S of particle i; the out-of-plane parts included unless `plane` */
static sph_real invariant(const sph_buffer *b, uint32_t i, bool plane)
{
    const sph_real x = b->stress[0][i];
    if (SPH_DIM == 1) /* yy = zz = -xx/2 */
        return x * x * (plane ? 1 : (sph_real)1.5);
    const sph_real y = b->stress[YY][i], xy = b->stress[XY][i], z = plane && SPH_DIM == 2 ? 0 : x + y;
    if (SPH_DIM == 2)
        return x * x + y * y + z * z + 2 * (xy * xy);
    const sph_real xz = b->stress[XZ][i], yz = b->stress[YZ][i];
    return x * x + y * y + z * z + 2 * (xy * xy + xz * xz + yz * yz);
}

/* returns the stresses of a run of one set to the yield surface */
static void yield_run(const sph_sim *sim, const sph_material *rock, const sph_buffer *b, uint32_t first, uint32_t last)
{
    const bool printed = sim->cfg.yield == SPH_VON_MISES_GRAY;
    const sph_real y0 = (sph_real)rock->yield, hard = (sph_real)rock->hardening, mu3 = 3 * rock->shear_r;
    for (uint32_t i = first; i < last; i++) {
        const sph_real y = y0 + hard * b->plastic[0][i], s3 = (sph_real)1.5 * invariant(b, i, printed); /* 3 J2 */
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

void sph_yield(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    if (!sph_yields(&sim->cfg))
        return;
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        if (b->set[0][i] != SPH_DEAD && sim->material[b->set[0][i]].yield > 0)
            yield_run(sim, &sim->material[b->set[0][i]], b, i, e);
    }
}
#endif
