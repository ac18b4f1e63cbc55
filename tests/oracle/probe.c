/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* probe.c: values at a point: Shepard-normalised sums over fluid and solid and their images behind faces (an image is
   water as well as what it is the image of); cover = sum (m/rho) W; below 1e-6 all are 0 (sph.h, sph_probe). */
#include "oracle.h"

o_probe_value o_probe(o_scene *s, const double *x)
{
    o_probe_value o = {{0, 0}, {0, 0}, {0, 0}, {{0, 0}, {0, 0}, {0, 0}}};
    for (uint32_t b = 0; b < s->m; b++) {
        const o_particle *j = &s->all[b];
        const double h = o_own_h(s, j), support = o_weight_support(s->cfg.kernel) * h;
        double r2 = 0;
        if (!o_is_body(s, j))
            continue;
        for (int k = 0; k < SPH_DIM; k++)
            r2 += (j->x[k] - x[k]) * (j->x[k] - x[k]);
        const double r = sqrt(r2), volume = s->set[j->set].mass / j->rho;
        if (s->cfg.kernel == SPH_HAT || s->cfg.kernel == SPH_GAUSSIAN)
            o_close(s, "a probe at a kernel's edge", r, support, support);
        if (r >= support)
            continue;
        const double w = volume * o_weight(s->cfg.kernel, r, h);
        const double size = w + 0.05 * volume * o_weight(s->cfg.kernel, 0, h);
        o_add(&o.cover, w, size);
        o_add(&o.rho, w * j->rho, size * j->rho);
        o_add(&o.p, w * j->p, size * fabs(j->p));
        for (int k = 0; k < SPH_DIM; k++)
            o_add(&o.v[k], w * j->v[k], size * fabs(j->v[k]));
    }
    const double cover = o.cover.v;
    if (cover < 1e-6)
        return (o_probe_value){{0, o.cover.s}, {0, 0}, {0, 0}, {{0, 0}, {0, 0}, {0, 0}}};
    o_sum *const value[] = {&o.rho, &o.p, &o.v[0], &o.v[1], &o.v[2]};
    for (int k = 0; k < 5; k++) {
        value[k]->v /= cover;
        value[k]->s = value[k]->s / cover + fabs(value[k]->v) * o.cover.s / cover;
    }
    return o;
}
