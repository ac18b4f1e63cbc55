/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* contact.c: two bodies of the total-Lagrangian form share no stress; they push each other along x_ij, nearer than dx,
   as by a pressure rho0 c0^2 (W/W(dx) - 1) of the configuration in both (sph.h, SPH_TOTAL):
     dv_i = -sum m_j 2 p/rho0^2 grad W (standard scheme), -sum m_j 2 p/(rho_i rho_j) grad W (weak) */
#include "oracle.h"

void o_contact(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    if (!p->apart)
        return;
    const sph_config *c = &s->cfg;
    const double at = o_weight(c->kernel, c->spacing, c->smoothing_length), m = s->set[j->set].mass;
    const double stiff = c->rho0 * c->sound_speed * c->sound_speed * (o_is_weak(s) ? 1 / (i->rho * j->rho)
                                                                                  : 1 / (c->rho0 * c->rho0));
    const double push = 2 * stiff * o_max(p->w / at - 1, 0), size = 2 * stiff * (p->value / at + 1);
    double a[3];
    for (int k = 0; k < 3; k++)
        a[k] = -m * push * p->g * p->x[k];
    o_push(s, i, j, a, m * size * p->slope);
}
