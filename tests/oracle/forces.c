/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* forces.c: accelerations and rates of a scene whose d, v, stresses stand: for every particle, over every other one and
   every image. Fluids alone: fluid.c; as soon as a scene has solids, all is stress (stress.c). Then gravity, the body
   force, and axes on which a set is held: there it feels no force, and what holds it does the work. */
#include "oracle.h"

void o_push(const o_scene *s, o_particle *i, const o_particle *j, const double *part, double scale)
{
    const bool wall = !o_is_body(s, j);
    for (int k = 0; k < SPH_DIM; k++) {
        o_add(&i->a[k], part[k], scale);
        if (wall)
            o_add(&i->worked, part[k] * j->wall[k], scale * fabs(j->wall[k]));
    }
}

static void begin(const o_scene *s, o_particle *i)
{
    const o_sum none = {0, 0};
    i->rate = i->warmed = i->viscous = i->worked = i->diffused = i->pushed = none;
    i->mu = i->mu_at_edge = 0;
    for (int k = 0; k < 3; k++) {
        i->a[k] = none;
        if (!s->cfg.xsph_strain || !o_has_solids(s))
            i->drift[k] = none;
        for (int l = 0; l < 3; l++)
            i->gradient[k][l] = i->stress_rate[k][l] = none;
    }
}

/* a body, over bodies and ghosts */
static void body_pair(o_scene *s, o_particle *i, const o_particle *j)
{
    const bool solids = o_has_solids(s);
    o_pair p;
    if (s->set[j->set].role == SPH_ROLE_FORCE_WALL) {
        o_boundary(s, i, j);
        return;
    }
    if (!o_pair_of(s, i, j, &p))
        return;
    if (solids) {
        o_stress_force(s, i, j, &p);
        o_contact(s, i, j, &p);
        o_hourglass(s, i, j, &p);
    } else {
        o_continuity(s, i, j, &p);
        o_pressure_force(s, i, j, &p);
    }
    o_viscosity(s, i, j, &p);
    o_shear_force(s, i, j, &p);
    o_diffusion(s, i, j, &p);
    if (!solids || !s->cfg.xsph_strain)
        o_drift(s, i, j, &p);
}

/* a ghost whose density goes by continuity, over bodies and other ghosts, which move by it where a wall moves */
static void ghost_pair(o_scene *s, o_particle *i, const o_particle *j)
{
    o_pair p;
    if (!(o_is_body(s, j) || o_is_ghost(s, j)) || !o_pair_of(s, i, j, &p))
        return;
    if (o_has_solids(s))
        o_stress_force(s, i, j, &p);
    else
        o_continuity(s, i, j, &p);
}

/* the body force, and how large what it was added up from is: by what a thousandth of the velocity changes in it */
static void find_push(const o_scene *s, const o_particle *i, double *own, double *size)
{
    double faster[3], other[SPH_DIM] = {0};
    if (!s->cfg.body_force)
        return;
    for (int k = 0; k < 3; k++)
        faster[k] = 1.001 * i->v[k];
    s->cfg.body_force(s->cfg.body_ctx, s->time, i->x, i->v, own);
    s->cfg.body_force(s->cfg.body_ctx, s->time, i->x, faster, other);
    for (int k = 0; k < SPH_DIM; k++)
        size[k] = fabs(own[k]) + 1000 * fabs(other[k] - own[k]);
}

static void end(const o_scene *s, o_particle *i)
{
    const o_set *set = &s->set[i->set];
    double own[SPH_DIM] = {0}, size[SPH_DIM] = {0};
    if (o_has_solids(s))
        o_strain_rates(s, i);
    o_warm(s, i);
    if (s->cfg.density == SPH_SUMMATION)
        i->rate = (o_sum){0, 0};
    o_add(&i->rate, i->diffused.v, i->diffused.s);
    if (!o_is_body(s, i))
        return;
    find_push(s, i, own, size);
    for (int k = 0; k < SPH_DIM; k++) {
        o_plus(&i->a[k], s->cfg.gravity[k]);
        o_add(&i->a[k], own[k], size[k]);
        o_add(&i->pushed, own[k] * i->v[k], size[k] * fabs(i->v[k]));
    }
    o_edges(s, i);
    for (int k = 0; k < SPH_DIM; k++) {
        if (set->role != SPH_ROLE_SOLID || !(set->held >> k & 1))
            continue;
        o_add(&i->worked, -i->a[k].v * set->velocity[k], i->a[k].s * fabs(set->velocity[k]));
        i->a[k] = (o_sum){0, 0};
    }
    if (o_is_carried(s, i))
        o_carry_along(i, s->rates_of_middle ? i->middle_rate : i->rate);
}

void o_forces(o_scene *s)
{
    o_refresh(s);
    o_adami(s);
    o_find_slopes(s);
    o_correct(s);
    o_weigh(s);
    if (o_has_solids(s))
        o_stresses(s);
    for (uint32_t a = 0; a < s->n; a++)
        for (int k = 0; k < 3; k++)
            s->own[a].drift[k] = (o_sum){0, 0};
    if (o_has_solids(s) && s->cfg.xsph_strain) {
        o_smooth(s);
        o_stresses(s);
    }
    if (o_make_forms(s))
        o_stresses(s);
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        const o_set *set = &s->set[i->set];
        const bool moves = set->role == SPH_ROLE_GHOST && set->compressible;
        begin(s, i);
        for (uint32_t b = 0; b < s->m; b++)
            if (o_is_body(s, i))
                body_pair(s, i, &s->all[b]);
            else if (moves)
                ghost_pair(s, i, &s->all[b]);
        if (o_is_body(s, i) || moves)
            end(s, i);
    }
    if (s->cfg.shifting > 0)
        o_find_disorder(s);
    if (s->cfg.density == SPH_SUMMATION)
        o_sum_rates(s);
}
