/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* marks.h: what the search for edges (outline.c) leaves with particles, and what the sweep asks of it: the equations
   are at the head of edges.c. */
#ifndef SPH_MARKS_H
#define SPH_MARKS_H

#include "dmath.h"
#include "sweep.h"
#include "tensor.h"

/* speeds of P and S waves in a set of solid, m/s: c_p^2 = c^2 + 4 mu/(3 rho0), c_s^2 = mu/rho0; c: c0, of TAIT_GRAY
   sqrt 7 c0 */
SPH_INLINE void sph_edge_speeds(const sph_sim *sim, const sph_set *s, double *cp, double *cs)
{
    const double cs2 = sph_material_of(sim, s)->shear / s->rho0;
    *cs = __builtin_sqrt(cs2);
    *cp = __builtin_sqrt(s->c0 * s->c0 * (SPH_IS(s->eos, TAIT_GRAY) ? 7 : 1) + cs2 * 4 / 3);
}
/* alpha of the matched layer, 1/s */
SPH_INLINE double sph_layer_shift(const sph_sim *sim, const sph_set *s)
{
    double cp, cs;
    sph_edge_speeds(sim, s, &cp, &cs);
    return sim->cfg.edge_shift * cp / sim->cfg.spacing;
}
SPH_INLINE bool sph_in_layer(const sph_edge_mark *m)
{
    sph_real sum = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        sum += m->damp[k];
    return sum > 0;
}

/* The velocity gradient that strains see in a matched layer, L - psi: in the middle of a step with psi of the middle,
   and psi of its end is left in `layer` until the stress stands (sph_pass_layer_stress). What the layer takes of the
   elastic energy by it, W/kg, is left in `absorbing`. */
#define sph_match_gradient SPH_NAME(match_gradient_)
void sph_match_gradient(const sph_sim *sim, const sph_set *set, uint32_t i, sph_real (*l)[SPH_DIM]);

/* the acceleration of particle i, which stands in acc, as the edge has it; v, L: velocity and its gradient now (L: of
   P, M, H) */
#define sph_edge_force SPH_NAME(edge_force_)
void sph_edge_force(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real (*l)[SPH_DIM],
                    const sph_real *v, sph_real *acc);

#endif
