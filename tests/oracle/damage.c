/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damage.c: growth of damage from flaws (Benz & Asphaug 1995; Gray 2001 eqs 5.33-5.42), r = D^(1/DIM):
     dr/dt = active crack_speed/flaw_radius, a flaw being active while the strain exceeds its threshold, r^DIM at most
     active/flaws; the strain is the largest principal stress over (1 - D) E, E = 9 K mu/(3 K + mu), K = rho0 c0^2, or
     as his eq 5.35 prints it over 2 mu (1 - D^2) */
#include "oracle.h"

double o_grown_root(o_scene *s, const o_particle *i, const float *flaw, uint32_t flaws, double dt)
{
    const o_set *set = &s->set[i->set];
    const double damage = pow(i->root, SPH_DIM), most = o_largest_principal((const double(*)[3])i->sigma, true);
    const double bulk = set->rho0 * set->c0 * set->c0, young = 9 * bulk * set->shear / (3 * bulk + set->shear);
    if (flaws == 0 || !(damage < 1) || !(most > 0))
        return i->root;
    const double strain = s->cfg.damage == SPH_BENZ_ASPHAUG ? most / ((1 - damage) * young)
                                                            : most / (2 * set->shear * (1 - damage * damage));
    uint32_t active = 0;
    for (uint32_t k = 0; k < flaws; k++) {
        o_close(s, "a flaw at its threshold", (double)flaw[k], strain, strain);
        active += (double)flaw[k] < strain;
    }
    const double limit = pow((double)active / flaws, 1.0 / SPH_DIM);
    return i->root >= limit ? i->root : o_min(limit, i->root + active * set->crack * dt);
}
