/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shifting.c: particle shifting of fluids (Lind, Xu, Stansby & Rogers 2012; the bracket: Monaghan 2000; sph.h). Over
   bodies, ghosts and all their images, with V = m/rho (but in weak schemes at most 2 m/rho0), at the places and
   densities of the last forces:
     slope_i = sum V_j [1 + 0.2 (W/W(dx))^4] grad W, cover_i = sum V_j W, M_i = sum V_j (x_j - x_i) (x) grad W
   (the bracket is 1 where W(dx) is 0). At the end of a step
     dx_i = -C dt v_max 4h slope_i, cut to 0.05 dx, where cover > 0.9 and all eigenvalues of M are above 0.75
     rho_i += rho_i min(C dt v_max/h, 1/2) (cover - 1) where they are above 0.98, unless densities are summed; not
              where that would be all of rho or more
   with shift_pairs, where the first is not: dx_i with 0.5 sum V_j max(0, (W/W(dx))^4 - (W(0.8 dx)/W(dx))^4) grad W
   v_max: of the fluid, when the last forces were made. A periodic face lets round, a mirror takes the mirrored
   particle, and nobody goes through an open one. Velocities stay else. What potential and internal energy lose is the
   book `shifted`. */
#include "oracle.h"

/* of pairs closer than 0.8 dx */
static void sum_close(const o_scene *s, const o_pair *p, double w_dx, o_sum *nearer)
{
    const double at = o_weight(s->cfg.kernel, 0.8 * s->cfg.spacing, s->cfg.smoothing_length);
    if (!(w_dx > 0))
        return;
    const double bound = pow(at / w_dx, 4), more = 0.5 * o_max(0, pow(p->w / w_dx, 4) - bound);
    const double most = 0.5 * (pow(p->value / w_dx, 4) + bound);
    for (int k = 0; k < SPH_DIM; k++)
        o_add(&nearer[k], -p->volume * more * p->g * p->x[k], p->volume * most * p->slope);
}

static void sum_pair(const o_scene *s, o_particle *i, const o_pair *p, double w_dx, double *m, double (*spread)[3],
                     o_sum *cover)
{
    const double f = w_dx > 0 ? p->w / w_dx : 0, big = w_dx > 0 ? p->value / w_dx : 0;
    const double bracket = 1 + 0.2 * pow(f, 4), most = 1 + 0.2 * pow(big, 4);
    (void)s;
    o_add(cover, p->volume * p->w, p->volume * p->value);
    for (int k = 0; k < SPH_DIM; k++) {
        o_add(&i->disorder[k], -p->volume * bracket * p->g * p->x[k], p->volume * most * p->slope);
        for (int l = 0; l < SPH_DIM; l++)
            spread[k][l] -= p->volume * p->g * p->x[k] * p->x[l];
    }
    *m += p->volume * p->slope * p->r;
}

void o_find_disorder(o_scene *s)
{
    const double w_dx = o_weight(s->cfg.kernel, s->cfg.spacing, s->cfg.smoothing_length);
    s->fastest = 0;
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        o_sum cover = {0, 0}, nearer[3] = {{0, 0}, {0, 0}, {0, 0}};
        double spread[3][3] = {{0}}, size = 0;
        for (int k = 0; k < 3; k++)
            i->disorder[k] = (o_sum){0, 0};
        i->filling = (o_sum){0, 0};
        if (!o_is_body(s, i))
            continue;
        s->fastest = o_max(s->fastest, sqrt(o_dot(i->v, i->v)));
        for (uint32_t b = 0; b < s->m; b++) {
            const o_particle *j = &s->all[b];
            o_pair p;
            if (!(o_is_body(s, j) || o_is_ghost(s, j)) || !o_pair_of(s, i, j, &p))
                continue;
            if (!o_is_weak(s))
                p.volume = s->set[j->set].mass / o_max(j->rho, 0.95 * s->set[j->set].rho0);
            sum_pair(s, i, &p, w_dx, &size, spread, &cover);
            sum_close(s, &p, w_dx, nearer);
        }
        /* the smallest eigenvalue: that of the axes which the dimension has not is out of the way */
        for (int k = SPH_DIM; k < 3; k++)
            spread[k][k] = 1e3 + 1e3 * size;
        for (int k = 0; k < 9; k++)
            spread[k / 3][k % 3] = -spread[k / 3][k % 3];
        const double least = -o_largest_principal((const double(*)[3])spread, false);
        o_close(s, "a cover at its bound", cover.v, 0.9, 1 + cover.s);
        o_close(s, "a spread at its bound", least, 0.75, 1 + size);
        o_close(s, "a spread at its bound", least, 0.98, 1 + size);
        const bool inside = cover.v > 0.9 && least > 0.75;
        if (inside && least > 0.98 && s->cfg.density == SPH_CONTINUITY)
            i->filling = (o_sum){cover.v - 1, 1 + cover.s};
        for (int k = 0; k < 3 && !inside; k++)
            i->disorder[k] = s->cfg.shift_pairs ? nearer[k] : (o_sum){0, 0};
    }
}

/* along one axis, through its faces: the place where a way ends; through an open face nobody goes */
typedef struct passage {
    double to;
    bool left, turned;
    uint32_t face;
    double plane;
} passage;
static passage end_of(const o_scene *s, int k, double x, double way)
{
    const double lo = s->cfg.lo[k], hi = s->cfg.hi[k], to = x + way;
    const bool low = to < lo;
    const uint32_t face = low || to >= hi ? s->cfg.face[k][!low] : SPH_PERIODIC;
    passage e = {to, face == SPH_OPEN, face != SPH_OPEN && face != SPH_PERIODIC, face, low ? lo : hi};
    if (face == SPH_PERIODIC && (low || to >= hi))
        e.to += low ? hi - lo : lo - hi;
    return e;
}

static double stored(const o_scene *s, const o_particle *i)
{
    const o_set *set = &s->set[i->set];
    return o_energy(set->eos, set->rho0, set->c0, i->d, s->cfg.pressure_floor);
}

void o_shift(o_scene *s, double dt)
{
    const double h = s->cfg.smoothing_length, by = s->cfg.shifting * dt * s->fastest;
    const double near = (SPH_DOUBLE ? 1 : 0.02) * s->cfg.spacing;
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        double way[3] = {0}, taken = stored(s, i);
        passage end[3];
        bool left = false;
        if (!o_is_body(s, i) || o_is_carried(s, i))
            continue;
        const double more = o_min(by / h, 0.5) * i->filling.v;
        o_close(s, "a filling at its bound", fabs(more), 1, 1 + i->filling.s);
        i->d += fabs(more) < 1 ? (1 + i->d) * more : 0;
        taken -= stored(s, i);
        for (int k = 0; k < SPH_DIM; k++)
            way[k] = by * 4 * h * i->disorder[k].v;
        const double size = sqrt(o_dot(way, way)), most = 0.05 * s->cfg.spacing;
        for (int k = 0; k < SPH_DIM; k++) {
            way[k] *= size > most ? most / size : 1;
            end[k] = end_of(s, k, i->x[k], way[k]);
            left |= end[k].left;
            o_close(s, "a particle on a face", i->x[k] + way[k], s->cfg.lo[k], near);
            o_close(s, "a particle on a face", i->x[k] + way[k], s->cfg.hi[k], near);
        }
        for (int k = 0; k < SPH_DIM && !left; k++) {
            const double from = i->x[k];
            i->x[k] = end[k].to;
            if (end[k].turned) {
                o_turn_round(i, k, end[k].plane, end[k].face == SPH_SYMMETRY);
                way[k] = i->x[k] - from;
            }
            taken += s->cfg.gravity[k] * way[k];
        }
        o_add(&s->shifted, s->set[i->set].mass * taken, s->set[i->set].mass * (fabs(taken) + stored(s, i)));
    }
}
