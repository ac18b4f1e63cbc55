/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* pairs.c: two particles: their distance and relative velocity, and what the kernel sees of them. K is x_ij; in the
   total-Lagrangian form, of two particles of one body neither of which is fully damaged, the vector between their
   reference positions (sph.h, SPH_TOTAL). */
#include "oracle.h"

static bool is_whole(const o_scene *s, const o_particle *p) { return o_is_solid(s, p) && p->root < 1; }

bool o_pair_of(o_scene *s, const o_particle *i, const o_particle *j, o_pair *p)
{
    const double h = o_pair_h(s, i, j), support = o_weight_support(s->cfg.kernel) * h;
    const uint32_t kernel = s->cfg.kernel;
    const bool both = s->cfg.solid == SPH_TOTAL && is_whole(s, i) && is_whole(s, j);
    p->h = h;
    p->bond = both && s->set[i->set].body == s->set[j->set].body;
    p->apart = both && !p->bond;
    for (int k = 0; k < 3; k++) {
        p->x[k] = i->x[k] - j->x[k];
        p->k[k] = p->bond ? i->rest[k] - j->rest[k] : p->x[k];
        p->v[k] = i->v[k] - j->v[k];
    }
    const double q2 = o_dot(p->k, p->k);
    if (q2 > support * support * 1.001)
        return false;
    p->q = sqrt(q2);
    p->r = sqrt(o_dot(p->x, p->x));
    if (kernel == SPH_HAT || kernel == SPH_GAUSSIAN) /* they end with a step */
        o_close(s, "a pair at the kernel's edge", p->q, support, support);
    /* nearly at one place a cone has no slope to speak of; those of splines the kernel lets go to 0 below 1e-6 h */
    const double least = kernel == SPH_HAT ? 0 : (SPH_DOUBLE ? 1e-13 : 1e-7) * h;
    const double most = kernel == SPH_HAT ? 1e-5 * h : kernel <= SPH_QUINTIC ? 2e-6 * h : -1;
    if ((p->q > 0 || j->image) && p->q >= least && p->q < most)
        s->undecided = "a pair nearly at one place";
    if (p->bond) {
        o_close(s, "a bond at its longest", p->r, support * s->cfg.max_stretch, support);
        if (p->r > support * s->cfg.max_stretch && p->q < support)
            s->undecided = "a bond that is too long";
    }
    p->edge = fabs(p->q - support) <= (SPH_DOUBLE ? 1e-9 : 1e-4) * support;
    const bool beyond = p->q >= support; /* at the edge: a pair of which nothing is left but that it is one */
    if ((beyond && !p->edge) || !o_acts_on(s, i, j) || !o_acts_on(s, j, i))
        return false;
    const double slope = beyond ? 0 : o_weight_slope(kernel, p->q, h);
    p->g = p->q > 0 ? slope / p->q : 0;
    p->w = beyond ? 0 : o_weight(kernel, p->q, h);
    p->slope = fabs(slope) + 0.05 * fabs(o_weight_slope(kernel, h, h)) + fabs(p->g) * 0.1 * h;
    if (p->bond) /* what is multiplied by x_ij has the errors of a g at |K| */
        p->slope += fabs(p->g) * p->r * (1 + 0.1 * h / o_max(p->q, 1e-3 * h));
    p->value = p->w + 0.05 * o_weight(kernel, 0, h);
    p->volume = s->set[j->set].mass / j->rho;
    return true;
}
