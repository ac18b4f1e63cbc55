/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* width.c: the smoothing length h of each particle: eta (m/rho)^(1/DIM) with eta = h/dx of the configuration, at least
   h_min and at most h_max times the configuration's (Powell 2012 eq 1.21); else that for all. Of a pair the mean
   (Wickramarachchi 2009 eq 3.46). Smallest h of the scene's choices: for limits that are not asked by particle. */
#include "oracle.h"

double o_own_h(const o_scene *s, const o_particle *p)
{
    const sph_config *c = &s->cfg;
    if (!c->variable_h || !o_is_body(s, p))
        return c->smoothing_length;
    const double eta = c->smoothing_length / c->spacing, most = c->h_max * c->smoothing_length;
    const double own = p->rho > 0 ? eta * pow(s->set[p->set].mass / p->rho, 1.0 / SPH_DIM) : most;
    return o_max(c->h_min * c->smoothing_length, o_min(own, most));
}

double o_pair_h(const o_scene *s, const o_particle *i, const o_particle *j)
{
    return 0.5 * (o_own_h(s, i) + o_own_h(s, j));
}

double o_least_h(const o_scene *s) { return (s->cfg.variable_h ? s->cfg.h_min : 1) * s->cfg.smoothing_length; }
