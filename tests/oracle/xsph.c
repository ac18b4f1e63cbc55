/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* xsph.c: the velocity with which positions drift beside their own, between bodies (Gray 2001 eq 2.22):
     u_i = xsph sum (m_j/rho_mean) (v_j - v_i) W,  rho_mean = (rho_i + rho_j)/2
   and, where strain rates take v + u instead of v (Gray 5.10), the same before the forces. Not along axes on which a
   set is held. */
#include "oracle.h"

void o_drift(o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    if (!(s->cfg.xsph > 0) || !o_is_body(s, i) || !o_is_body(s, j))
        return;
    const double c = s->cfg.xsph * s->set[j->set].mass / (0.5 * (i->rho + j->rho));
    for (int k = 0; k < SPH_DIM; k++)
        if (!(s->set[i->set].held >> k & 1))
            o_add(&i->drift[k], -c * p->v[k] * p->w, c * fabs(p->v[k]) * p->value);
}

void o_smooth(o_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        for (int k = 0; k < 3; k++)
            i->smooth[k] = 0;
        for (uint32_t b = 0; b < s->m && s->cfg.xsph_strain; b++) {
            o_pair p;
            if (o_pair_of(s, i, &s->all[b], &p))
                o_drift(s, i, &s->all[b], &p);
        }
    }
    for (uint32_t a = 0; a < s->n; a++)
        for (int k = 0; k < SPH_DIM && s->cfg.xsph_strain; k++)
            s->own[a].smooth[k] = s->own[a].drift[k].v;
    o_copies(s);
}
