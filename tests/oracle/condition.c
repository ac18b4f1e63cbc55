/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* condition.c: how well a scene is conditioned: its steps once more by the oracle alone, from a state in which every
   number is disturbed by as much as a sum of the kernel may be off, some times over. Filters forget by what densities
   were disturbed, and know what they make only to a rounding of rho0: they are disturbed by that. What comes of it at
   the end, the largest of all particles, is what rounding makes of each quantity: two trajectories agree no better than
   some times it. */
#include <stdlib.h>
#include <string.h>

#include "oracle.h"

enum { DRAWS = 4 };

static void copy(o_scene *to, const o_scene *from)
{
    o_scene kept = *to;
    *to = *from;
    to->own = realloc(kept.own, (from->n + 1) * sizeof *to->own);
    if (!to->own)
        abort();
    memcpy(to->own, from->own, from->n * sizeof *to->own);
    to->all = kept.all;
    to->room = kept.room;
    to->m = 0;
}

static int sign(void)
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u; /* Knuth & Lewis */
    return state >> 31 ? 1 : -1;
}
static double error(double size)
{
    return sign() * (SPH_DOUBLE ? 1e-11 : 1e-5) * fabs(size); /* compare.c, TOLERANCE */
}

double o_shake(const o_scene *s) { return s->shaken ? sign() * (SPH_DOUBLE ? 0x1p-52 : 0x1p-23) : 0; }

static void disturb(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        if (!o_is_body(s, p) && !s->set[p->set].compressible)
            continue;
        p->d += error(p->d);
        for (int k = 0; k < SPH_DIM && o_is_body(s, p); k++) {
            const double way = error(s->cfg.spacing);
            p->x[k] += way;
            p->rest[k] += way;
            p->v[k] += error(p->v[k]);
        }
        for (int k = 0; k < 3 && o_is_solid(s, p); k++)
            for (int l = 0; l <= k; l++)
                p->dev[k][l] = p->dev[l][k] = p->dev[k][l] + error(p->dev[k][l]);
    }
}

static void widen(double *spread, double a, double b)
{
    const double d = fabs(a - b);
    if (!(d <= *spread))
        *spread = d == d ? d : (double)INFINITY;
}

void o_keep(o_scene *kept, const o_scene *s) { copy(kept, s); }

o_spread o_find_spread(const o_scene *start, const o_scene *end, uint32_t steps, double dt,
                       uint32_t (*flaws_of)(uint32_t id, float *threshold))
{
    static o_scene s;
    o_spread o = {0};
    for (int draw = 0; draw < DRAWS; draw++) {
        copy(&s, start);
        s.shaken = true;
        disturb(&s);
        o_forces(&s);
        o_begin_steps(&s, s.n);
        bool goes = true;
        for (uint32_t k = 1; goes && k <= steps; k++)
            goes = o_step(&s, k, dt, flaws_of);
        if (!goes || s.n != end->n) { /* even who is still there */
            const double any = (double)INFINITY;
            return (o_spread){any, any, any, any, any, any, any, any, any, any, any};
        }
        widen(&o.shifted, s.shifted.v, end->shifted.v);
        widen(&o.quieted, s.quieted.v, end->quieted.v);
        widen(&o.slowed, s.slowed.v, end->slowed.v);
        widen(&o.evened, s.evened.v, end->evened.v);
        widen(&o.worked, s.wall_work.v, end->wall_work.v);
        for (uint32_t i = 0; i < s.n; i++) {
            const o_particle *p = &s.own[i], *q = &end->own[i];
            widen(&o.d, p->d, q->d);
            widen(&o.plastic, p->plastic, q->plastic);
            widen(&o.root, p->root, q->root);
            for (int k = 0; k < 3; k++) {
                widen(&o.x, p->x[k], q->x[k]);
                widen(&o.v, p->v[k], q->v[k]);
                for (int l = 0; l < 3; l++)
                    widen(&o.dev, p->dev[k][l], q->dev[k][l]);
            }
        }
    }
    return o;
}
