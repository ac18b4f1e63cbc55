/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* diffusion.c: density diffusion, between particles of one material (sph.h, SPH_MOLTENI ...):
     drho_i = 2 delta h c sum (m_j/rho_j) (rho_j - rho_i - rho_H) (x_ji . grad W)/(r^2 + eta)
   with eta 0.01 h^2, and rho_j of m_j/rho_j not below rho0/2.
   MOLTENI (Molteni & Colagrossi 2009): rho_H = 0. HYDROSTATIC (Fourtakas et al. 2019, linearised): the difference of
   density that gravity makes between the places of j and i, rho0 g . (x_j - x_i)/c^2 with
   the true sound speed c, so that still water feels none. ANTUONO (Antuono et al. 2010): rho_H = (G_i + G_j)/2 .
   (x_j - x_i) of the renormalised gradients (density_gradient.c).
   Behind a mirror plane the water stands upside down: there x_j is the place of which the image is seen. */
#include "oracle.h"

void o_diffusion(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p)
{
    const double h = s->cfg.smoothing_length;
    const o_set *set = &s->set[i->set];
    if (s->cfg.diffusion == SPH_NO_DIFFUSION || !o_diffuses_into(s, i, j))
        return;
    const double sound = o_sound(set->eos, set->c0);
    double drho = j->rho - i->rho, size = i->rho + j->rho;
    for (int k = 0; k < SPH_DIM && s->cfg.diffusion == SPH_HYDROSTATIC; k++) {
        /* of an image in a mirror the place that is seen in it: within a step it may be on either side of the plane */
        const double part = set->rho0 * s->cfg.gravity[k] * (j->stood[k] - i->x[k]) / (sound * sound);
        drho -= part;
        size += fabs(part);
    }
    for (int k = 0; k < SPH_DIM && s->cfg.diffusion == SPH_ANTUONO; k++) {
        drho -= 0.5 * (i->steep[k] + j->steep[k]) * (j->x[k] - i->x[k]);
        size += 0.5 * (i->steep_scale + j->steep_scale) * fabs(j->x[k] - i->x[k]);
    }
    const double volume = s->set[j->set].mass / o_max(j->rho, 0.95 * set->rho0);
    const double c = 2 * s->cfg.delta * h * set->c0 * volume;
    const double eta = 0.01 * h * h;
    const double f = -p->r * p->r * p->g / (p->r * p->r + eta);
    const double near = eta / (p->r * p->r + eta) * h / o_max(p->r, 1e-4 * h);
    o_add(&i->diffused, c * drho * f, c * size * p->slope / o_max(p->r, 0.01 * h) * (1 + near));
}
