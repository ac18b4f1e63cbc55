/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* adami.c: walls that take their pressure, and for no slip their velocity, from the bodies near them (Adami, Hu & Adams
   2012 eqs 22, 23, 27), W = W(x_w - x_f), sums over bodies f:
     p_w = (sum p_f W + (g - a_w) . sum rho_f (x_w - x_f) W)/sum W        v_w = 2 v_wall - sum v_f W/sum W
   with the acceleration a_w of sph.h (sph_motion), 0 at first; steps.c has it.
   The density of the wall is that which its equation of state has at p_w (with the floor, if there is one), kept
   between half and twice rho0; a wall that sees nobody is at rest density. */
#include "oracle.h"

static void extrapolate(o_scene *s, o_particle *w)
{
    const o_set *set = &s->set[w->set];
    double cover = 0, seen = 0, p_scale = 0, v_scale[3] = {0};
    double p = 0, v[3] = {0}, column[3] = {0}, column_scale = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        const o_particle *f = &s->all[b];
        o_pair pair;
        if (!o_is_body(s, f) || !o_pair_of(s, w, f, &pair))
            continue;
        cover += pair.w;
        seen += pair.value;
        p += f->p * pair.w;
        p_scale += fabs(f->p) * pair.value;
        for (int k = 0; k < SPH_DIM; k++) {
            column[k] += f->rho * pair.x[k] * pair.w;
            v[k] += f->v[k] * pair.w;
            v_scale[k] += fabs(f->v[k]) * pair.value;
        }
        column_scale += f->rho * s->support * pair.value;
    }
    const double covered = cover * set->mass;
    o_close(s, "a wall that is nearly dry", covered, 1e-6 * set->rho0, 1e-3 * set->rho0);
    const bool wet = covered > 1e-6 * set->rho0;
    for (int k = 0; k < SPH_DIM; k++) {
        p += (s->cfg.gravity[k] - set->push[k]) * column[k];
        p_scale += fabs(s->cfg.gravity[k] - set->push[k]) * column_scale;
        w->wall_v[k] = (o_sum){set->velocity[k], fabs(set->velocity[k])};
        if (wet) {
            const double mean = v[k] / cover;
            o_add(&w->wall_v[k], set->velocity[k] - mean,
                  fabs(set->velocity[k]) + v_scale[k] / cover + fabs(mean) * seen / cover);
        }
    }
    w->density = (o_sum){0, 0};
    if (!wet)
        return;
    p /= cover;
    p_scale = p_scale / cover + fabs(p) * seen / cover;
    if (s->cfg.pressure_floor)
        p = o_max(p, 0);
    const double d = o_excess_at(set->eos, set->rho0, set->c0, p);
    /* how an error of p becomes one of d: by d(rho)/dp = 1/c^2, steepest at low densities */
    const double low = o_excess_at(set->eos, set->rho0, set->c0, p - 1e-4 * p_scale);
    const double high = o_excess_at(set->eos, set->rho0, set->c0, p + 1e-4 * p_scale);
    w->density = (o_sum){o_max(o_min(d, 1), -0.5), fabs(high - low) / 2e-4 + fabs(d)};
}

void o_adami(o_scene *s)
{
    for (uint32_t a = 0; a < s->n; a++)
        if (o_is_ghost(s, &s->own[a]) && s->set[s->own[a].set].kind == SPH_WALL_ADAMI)
            extrapolate(s, &s->own[a]);
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *w = &s->own[a];
        if (!o_is_ghost(s, w) || s->set[w->set].kind != SPH_WALL_ADAMI)
            continue;
        w->d = w->density.v;
        for (int k = 0; k < SPH_DIM; k++)
            w->seen[k] = s->set[w->set].no_slip ? w->wall_v[k].v : w->wall[k];
    }
    o_refresh(s);
}
