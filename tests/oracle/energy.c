/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* energy.c: the energy equation. Of an ideal gas p = (gamma - 1) rho u, c = sqrt(gamma (gamma - 1) u),
     du_i = p_i/rho_i^2 drho_i + q_i
   with the rate of density by motion alone, without diffusion, of the scheme: so it is, in the schemes' order, eqs
   3.42, that of 3.80, 3.23, 3.52, 3.81 of Wickramarachchi 2009. Of other fluids du_i = q_i. q_i is what viscosity
   makes: half of its work on the relative velocity that it sees, and tau_i : L_i/rho_i of a viscous stress
   (viscosity.c, shear.c: `viscous`). The Courant limit takes max(|mu|, |mu| + (c - c0)/h), or with courant alpha/(2
   (DIM + 2) viscous_factor) c for c, whichever asks for more; with h of its own of each particle (width.c) (|mu| + c/h)
   less the c0/h of its set and the configuration. */
#include "oracle.h"

bool o_is_gas(const o_scene *s, const o_particle *p) { return s->set[p->set].eos == SPH_IDEAL_GAS; }

void o_gas_state(const o_scene *s, o_particle *p)
{
    const double gamma = s->cfg.gamma;
    p->p = (gamma - 1) * p->rho * p->u;
    p->c = sqrt(gamma * (gamma - 1) * o_max(p->u, 0));
}

void o_warm(const o_scene *s, o_particle *i)
{
    if (!s->cfg.energy || !o_is_body(s, i))
        return;
    i->warmed = i->viscous;
    if (!o_is_gas(s, i))
        return;
    const double per = i->p / (i->rho * i->rho);
    o_add(&i->warmed, per * i->rate.v, fabs(per) * (i->rate.s + i->diffused.s));
}

double o_sound_as_mu(const o_scene *s, const o_particle *p)
{
    const sph_config *c = &s->cfg;
    const bool artificial = c->viscosity == SPH_ARTIFICIAL || c->viscosity == SPH_ARTIFICIAL_APPROACHING;
    const double k = artificial ? o_courant_number(c) * c->alpha / (2 * (SPH_DIM + 2) * c->viscous_factor) : 0;
    return p->c * o_max(k, 1) / o_own_h(s, p) - s->set[p->set].c0 / c->smoothing_length;
}
