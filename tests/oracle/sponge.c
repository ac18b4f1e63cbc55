/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sponge.c: S of the sponge layers, dv/dt = -rate S (v - v_ref): the sum over faces of s^2, s = (width - distance to
   the face)/width in a layer (Powell 2012 section 2.1; sph.h). Over a step v' = v_ref + (v - v_ref) exp(-rate S dt).
   */
#include "oracle.h"

double o_sponge(const o_scene *s, const o_particle *i)
{
    double sum = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        const double low = s->cfg.sponge_low[k], high = s->cfg.sponge_high[k];
        const double from_low = i->x[k] - s->cfg.lo[k], from_high = s->cfg.hi[k] - i->x[k];
        if (low > 0 && from_low < low)
            sum += (low - from_low) * (low - from_low) / (low * low);
        if (high > 0 && from_high < high)
            sum += (high - from_high) * (high - from_high) / (high * high);
    }
    return sum;
}
