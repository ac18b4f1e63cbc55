/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* crossing.c: who leaves through an open face, and who is found inside a wall at a step's end (sph.h, SPH_FAIL ...). A
   wall is what is behind its face, as thick as its layers and as wide as the face; round a periodic axis its nearest
   picture counts. Of walls the one in which a particle is least deep. REMOVE takes it away with all its energy;
   PUT_BACK sets it a tenth of a spacing off the face along the normal, without the velocity that leads into the wall,
   once more, and a third time, where it is then inside another one; forces are those of where it was. Its reference
   position stays. */
#include "oracle.h"

/* of a place behind the face of a set, m; negative: not in the wall */
static double depth_in(o_scene *s, const o_set *w, const double *x)
{
    const double near = (SPH_DOUBLE ? 1 : 0.02) * s->cfg.spacing;
    const double *n = w->normal, *t = w->tangent;
    const double side[2][3] = {{SPH_DIM == 3 ? t[0] : -n[1], SPH_DIM == 3 ? t[1] : n[0], SPH_DIM == 3 ? t[2] : 0},
                               {n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]}};
    double from[3] = {0};
    bool in = true, in_doubt = false, out_for_sure = false;
    for (int k = 0; k < SPH_DIM; k++) {
        const double length = s->cfg.hi[k] - s->cfg.lo[k];
        from[k] = x[k] - w->origin[k];
        if (s->cfg.face[k][0] == SPH_PERIODIC)
            from[k] -= length * floor(from[k] / length + 0.5);
    }
    const double depth = -o_dot(from, n);
    double beyond[4] = {-depth, depth - w->thick, -1, -1}; /* above 0: outside */
    for (int k = 0; k < SPH_DIM - 1; k++)
        beyond[2 + k] = fabs(o_dot(from, side[k])) - w->half[k];
    for (int k = 0; k < 2 + SPH_DIM - 1; k++) {
        const bool close = fabs(beyond[k]) <= (SPH_DOUBLE ? 1e-9 : 1e-4) * near;
        in &= beyond[k] < 0;
        in_doubt |= close;
        out_for_sure |= beyond[k] > 0 && !close;
    }
    if (in_doubt && !out_for_sure)
        s->undecided = "a particle on the side of a wall";
    return in ? depth : -1;
}

static const o_set *wall_around(o_scene *s, const o_particle *p, double *depth)
{
    const o_set *found = NULL;
    for (uint32_t k = 0; k < s->sets; k++) {
        const o_set *w = &s->set[k];
        const double d = w->region ? depth_in(s, w, p->x) : -1;
        if (d > 0 && found)
            o_close(s, "a particle as deep in two walls", d, *depth, s->cfg.spacing);
        if (d > 0 && (!found || d < *depth)) {
            found = w;
            *depth = d;
        }
    }
    return found;
}

static void put_back(const o_scene *s, o_particle *p, const o_set *w, double depth)
{
    double into = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        p->x[k] += (depth + 0.1 * s->cfg.spacing) * w->normal[k];
        p->home[k] += (depth + 0.1 * s->cfg.spacing) * w->normal[k]; /* what is held goes on from there */
        into -= (p->v[k] - w->velocity[k]) * w->normal[k];
    }
    for (int k = 0; k < SPH_DIM && into > 0; k++)
        p->v[k] += into * w->normal[k];
}

void o_cross(o_scene *s)
{
    for (uint32_t i = 0; i < s->n && s->cfg.on_cross != SPH_IGNORE; i++) {
        o_particle *p = &s->own[i];
        double depth = 0;
        const o_set *w = o_is_body(s, p) ? wall_around(s, p, &depth) : NULL;
        if (!w)
            continue;
        const double held = o_energy_of(s, p);
        s->crossed++;
        if (s->cfg.on_cross == SPH_REMOVE) {
            p->gone = true;
            s->left++;
            o_plus(&s->removed_mass, s->set[p->set].mass);
            o_plus(&s->carried_off, held);
            continue;
        }
        s->put_back++;
        for (int turn = 0; turn < 3 && w; turn++) {
            put_back(s, p, w, depth);
            w = wall_around(s, p, &depth);
        }
        o_add(&s->put_back_loss, held - o_energy_of(s, p), fabs(held));
    }
}
