/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* images.c: what stands behind a face of the domain, as particles of their own (Wickramarachchi 2009 section 6.1):
     periodic         a copy one domain's length away
     symmetry         the mirror picture: x and v along the axis turn round; so do shear stresses on the plane
     mirror no slip   the mirror picture with the whole velocity turned round, so that the plane is at rest; the shear
                      stress on the plane stays, so that it holds what hangs on it
   In corners the picture of the picture, with each axis's rule in turn. Of all copies those are kept that are not
   further from the domain than a pair may be. */
#include <stdlib.h>

#include "oracle.h"

/* one axis's face: side -1, 0 (none), 1 */
static void behind(const o_scene *s, o_particle *p, int axis, int side)
{
    const double lo = s->cfg.lo[axis], hi = s->cfg.hi[axis], length = hi - lo;
    const uint32_t face = s->cfg.face[axis][side > 0];
    p->image = true;
    if (face == SPH_PERIODIC) {
        p->x[axis] += side * length;
        p->stood[axis] += side * length;
        p->rest[axis] += side * length;
        p->origin[axis] += side * length;
        return;
    }
    const double plane = side < 0 ? lo : hi;
    double *const place[] = {p->x, p->rest, p->origin};
    for (int k = 0; k < 3; k++)
        place[k][axis] = plane + (plane - place[k][axis]);
    p->normal[axis] = -p->normal[axis];
    p->tangent[axis] = -p->tangent[axis];
    p->way[axis] = -p->way[axis];
    p->beside[axis] = -p->beside[axis];
    p->steep[axis] = -p->steep[axis];
    p->upside_down |= s->cfg.gravity[axis] != 0;
    p->slant[axis] = -p->slant[axis];
    p->row[axis] = -p->row[axis];
    p->drawn[axis] = -p->drawn[axis];
    double *const velocity[] = {p->v, p->wall, p->seen, p->smooth};
    for (int k = 0; k < 4; k++)
        for (int l = 0; l < 3; l++)
            if (l == axis || face == SPH_MIRROR_NO_SLIP)
                velocity[k][l] = -velocity[k][l];
    /* T: its first index as velocities, its second as places */
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            if ((k == axis || face == SPH_MIRROR_NO_SLIP) != (l == axis))
                p->shear[k][l] = -p->shear[k][l];
    for (int l = 0; l < 3; l++) {
        if (l == axis)
            continue;
        if (face == SPH_SYMMETRY) {
            p->sigma[axis][l] = -p->sigma[axis][l];
            p->sigma[l][axis] = -p->sigma[l][axis];
            p->pull[axis][l] = -p->pull[axis][l];
            p->pull[l][axis] = -p->pull[l][axis];
        }
        p->deform[axis][l] = -p->deform[axis][l];
        p->deform[l][axis] = -p->deform[l][axis];
        p->inverse[axis][l] = -p->inverse[axis][l];
        p->inverse[l][axis] = -p->inverse[l][axis];
    }
}

static void keep(o_scene *s, const o_particle *p)
{
    const double far = s->support * (s->cfg.solid == SPH_TOTAL ? s->cfg.max_stretch : 1) * 1.001;
    for (int k = 0; k < SPH_DIM; k++)
        if (p->x[k] < s->cfg.lo[k] - far || p->x[k] > s->cfg.hi[k] + far)
            return;
    if (s->m == s->room) {
        s->room = s->room ? 2 * s->room : 1024;
        s->all = realloc(s->all, s->room * sizeof *s->all);
        if (!s->all)
            abort();
    }
    s->all[s->m++] = *p;
}

void o_copies(o_scene *s)
{
    s->m = 0;
    for (uint32_t i = 0; i < s->n; i++) {
        for (int k = 0; k < 3; k++)
            s->own[i].stood[k] = s->own[i].x[k];
        keep(s, &s->own[i]);
    }
    for (int code = 0; code < 27; code++) {
        const int side[3] = {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
        bool is_there = side[0] || side[1] || side[2];
        for (int k = 0; k < 3; k++)
            if (side[k] && (k >= SPH_DIM || s->cfg.face[k < SPH_DIM ? k : 0][side[k] > 0] == SPH_OPEN))
                is_there = false;
        for (uint32_t i = 0; is_there && i < s->n; i++) {
            o_particle p = s->own[i];
            for (int k = 0; k < SPH_DIM; k++)
                if (side[k])
                    behind(s, &p, k, side[k]);
            keep(s, &p);
        }
    }
}
