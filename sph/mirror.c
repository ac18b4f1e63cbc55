/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* mirror.c: the columns of ghosts (mirror.h): normals, velocities for the viscosity, depths. No array. */
#include "mirror.h"
#include "arithmetic.h"

SPH_OBJECT(mirror)

#if SPH_HAS_LAYERED_WALLS
/* normal . (wall face - home cell), with the wall where it is now, and its image (m) */
static double plane_of(const sph_candidates *r)
{
    const double q = r->sim->grid.quantum;
    double plane = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const double sign = (double)r->im->sign[k], moved = (double)sph_wall_moved(r->sim, r->set, k) * q;
        const double o = sign * (r->set->origin[k] + moved) + (double)(r->im->shift[k] - r->origin[k]) * q;
        plane += sign * r->set->normal[k] * o;
    }
    return plane;
}

/* how much further along the normal the face stands of which wall particle j is a part: a wall that has moved round a
   periodic axis has one on either side of the seam (m) */
static double round_of(const sph_candidates *r, uint32_t j)
{
    const sph_sim *sim = r->sim;
    double further = 0;
    for (uint32_t k = 0; k < SPH_DIM && SPH_WITH_MOVING_WALLS; k++) {
        const int64_t d = (int64_t)r->b->pos[k][r->first + j] - sph_wall_moved(sim, r->set, k) -
                          (int64_t)(r->set->origin[k] / sim->grid.quantum);
        if (r->set->normal[k] != 0)
            further += r->set->normal[k] * (double)(d - sph_round_domain(sim, k, d)) * sim->grid.quantum;
    }
    return further;
}

/* of walls that mirror nothing: no normal, no depth */
SPH_INLINE void load_plain_wall(const sph_candidates *r, sph_real *to, uint32_t row)
{
    sph_real *const u0 = to + (size_t)SPH_DIM * row, *const depth = u0 + (size_t)SPH_DIM * row;
    sph_real *const vis = depth + row;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t j = 0; j < r->n; j += SPH_W) {
            const vreal own = v_load(r->b->vel[k] + r->first + j) * r->im->flip[k]; /* that a pass has found for it */
            v_store(u0 + k * row + j, r->set->no_slip ? own : v_load(r->tile->v[k] + r->at + j));
            v_store(to + k * row + j, v_set(0));
        }
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        v_store(depth + j, v_set(0));
        v_store(vis + j, v_set(r->set->no_slip ? 1 : 0));
    }
}

void sph_load_mirror(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const bool mirror = SPH_IS(r->set->kind, WALL_GHOST);
    if (!SPH_SMALL && !mirror) {
        load_plain_wall(r, to, row);
        return;
    }
    const double plane = mirror ? plane_of(r) : 0;
    sph_real *const u0 = to + (size_t)SPH_DIM * row, *const depth = u0 + (size_t)SPH_DIM * row;
    sph_real *const vis = depth + row;
    for (uint32_t j = 0; j < r->n; j++) {
        double x = 0;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const double nk = mirror ? (double)r->im->sign[k] * r->set->normal[k] : 0;
            if (mirror)
                x += nk * (double)r->tile->x[k][r->at + j];
            to[k * row + j] = (sph_real)nk;
            const bool own = !mirror && r->set->no_slip; /* the velocity that a pass has found for it */
            u0[k * row + j] = own ? r->b->vel[k][r->first + j] * r->im->flip[k] : r->tile->v[k][r->at + j];
        }
        const double deep = mirror ? plane + round_of(r, j) - x : 0;
        depth[j] = (sph_real)(deep > 0 ? deep : 0);
        vis[j] = r->set->no_slip ? 1 : 0;
    }
}
#endif
