/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sides.c: walls that act on one side only (sph.h, sph_wall.side): FRONT on what is before the plane of their face,
   FACE on what is besides between the face's edges. A particle that stands on such a border is undecided. */
#include "oracle.h"

bool o_acts_on(o_scene *s, const o_particle *wall, const o_particle *body)
{
    const o_set *set = &s->set[wall->set];
    double along[3][3] = {{0}};
    if (!o_is_ghost(s, wall) || set->side == SPH_BOTH_SIDES)
        return true;
    for (int k = 0; k < 3; k++) {
        along[0][k] = wall->normal[k];
        along[1][k] = SPH_DIM == 2 ? (k == 0 ? -wall->normal[1] : k == 1 ? wall->normal[0] : 0) : wall->tangent[k];
    }
    for (int k = 0; k < 3 && SPH_DIM == 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        along[2][k] = along[0][a] * along[1][b] - along[0][b] * along[1][a];
    }
    bool acts = true;
    for (int l = 0; l < (set->side == SPH_FACE ? SPH_DIM : 1); l++) {
        double d = 0;
        for (int k = 0; k < SPH_DIM; k++)
            d += along[l][k] * (body->x[k] - wall->origin[k]);
        const double border = l ? set->half[l - 1] : 0, x = l ? fabs(d) : d;
        o_close(s, "a particle on the border of a plate's side", x, border, (SPH_DOUBLE ? 1e7 : 100) * s->cfg.spacing);
        acts &= l ? x <= border : x > border;
    }
    return acts;
}
