/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* density.c: density that is not evolved.
     summation   rho_i = sum m_j W_ij over bodies and ghosts, i among them                  (Gray 2001 eq 2.19)
     Shepard     rho_i = sum m_j W/sum (m_j/rho_j) W over the particles of one material     (Wickramarachchi 2009 6.3)
   The second is summed as the excess d = (rho - rho0)/rho0: d_i = sum V_j d_j W/sum V_j W, the same for one material,
   for which alone it makes sense (two fluids at rest must stay at rest). */
#include "oracle.h"

void o_sum_density(o_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        const double rho0 = s->set[i->set].rho0;
        i->density = (o_sum){-1, 1};
        for (uint32_t b = 0; b < s->m && o_is_body(s, i); b++) {
            const o_particle *j = &s->all[b];
            o_pair p;
            if ((o_is_body(s, j) || o_is_ghost(s, j)) && o_pair_of(s, i, j, &p))
                o_add(&i->density, s->set[j->set].mass * p.w / rho0, s->set[j->set].mass * p.value / rho0);
        }
    }
    for (uint32_t a = 0; a < s->n; a++)
        if (o_is_body(s, &s->own[a]))
            s->own[a].d = s->own[a].density.v;
    o_refresh(s);
}

/* how fast the sums change with the places of particles and images: sum m_j (x'_i - x'_j) . grad W; and what of it is
   not of the velocities that powers are of: XSPH's, and a wall's image's along a no-slip mirror */
void o_sum_rates(o_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++)
        for (int k = 0; k < 3; k++) {
            s->own[a].beside[k] = o_is_body(s, &s->own[a]) ? s->own[a].drift[k].v : 0;
            s->own[a].way[k] = o_is_body(s, &s->own[a]) ? s->own[a].v[k] + s->own[a].beside[k] : s->own[a].wall[k];
        }
    o_copies(s);
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        i->moved_rate = i->unseen_rate = (o_sum){0, 0};
        for (uint32_t b = 0; b < s->m && o_is_body(s, i); b++) {
            const o_particle *j = &s->all[b];
            o_pair p;
            if (!(o_is_body(s, j) || o_is_ghost(s, j)) || !o_pair_of(s, i, j, &p))
                continue;
            const double v[3] = {i->way[0] - j->way[0], i->way[1] - j->way[1], i->way[2] - j->way[2]};
            const double m = s->set[j->set].mass;
            double unseen[3];
            for (int k = 0; k < 3; k++)
                unseen[k] = i->beside[k] - (o_is_body(s, j) ? j->beside[k] : j->way[k] - j->v[k]);
            o_add(&i->moved_rate, m * p.g * o_dot(v, p.x), m * p.slope * sqrt(o_dot(v, v)));
            o_add(&i->unseen_rate, m * p.g * o_dot(unseen, p.x), m * p.slope * sqrt(o_dot(unseen, unseen)));
        }
    }
}

void o_filter_density(o_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        double cover = 0, sum = 0, scale = 0;
        for (uint32_t b = 0; b < s->m && o_is_body(s, i); b++) {
            const o_particle *j = &s->all[b];
            o_pair p;
            if (!o_is_body(s, j) || !o_same_material(s, i, j) || !o_pair_of(s, i, j, &p))
                continue;
            cover += p.volume * p.w;
            sum += p.volume * p.w * j->d;
            scale += p.volume * p.value;
        }
        /* errors of the weights move the mean by as much as the density varies; d itself is kept to rounding */
        i->density = cover > 0 ? (o_sum){sum / cover, scale / cover} : (o_sum){i->d, fabs(i->d)};
    }
    for (uint32_t a = 0; a < s->n; a++)
        if (o_is_body(s, &s->own[a]))
            s->own[a].d = s->own[a].density.v;
    o_refresh(s);
}
