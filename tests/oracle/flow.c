/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* flow.c: inflows and outflows (sph.h, sph_flow; Gray 2001 eqs 2.34, 2.35). Each is a box with a face and, a length L
   behind it, an end; who belongs to it is told by his set.
     birth    at a step's beginning: each of an inflow's that is at its face or beyond is followed by a copy, L behind
              it, and belongs to the water from now on. Ids: the next free ones, counted round 0 .. max_particles - 1
              from the last that was given, at first from 0. Who was taken away at the end of the last step still has
              his place and id. Too many: the step fails with what it needs
     going    water that stands in an outflow's box at a step's beginning, on its way from the face to the end, belongs
              to the outflow. The way of the step in which a set changes is still that of the one before
     hold     velocity and density of who belongs to a flow stay what they were (across an inflow's way: 0), and nothing
              but this velocity moves it: no acceleration, XSPH, damping, sponge, shifting, filter. Work of what holds
              it: -m (a.v + p/rho^2 d(rho)/dt) in a time, of what the sums would give
     leaving  at a step's end, at an outflow's end or beyond
   Books: m, and the energy, of who is born at his place of birth; of who leaves where he then is. Which of those that
   are born in one step has which id is nowhere said: compare.c looks at places. */
#include <stdlib.h>

#include "oracle.h"

bool o_is_carried(const o_scene *s, const o_particle *p) { return s->set[p->set].flow != O_NO_FLOW; }

/* at a plane across a flow's way, or beyond */
static bool has_passed(o_scene *s, const o_set *f, double x, double plane)
{
    o_close(s, "a particle on the face of a flow", x, plane, (SPH_DOUBLE ? 1 : 0.02) * s->cfg.spacing);
    return f->up ? x >= plane : x < plane;
}

static bool is_going_out(o_scene *s, const o_set *f, const o_particle *p)
{
    bool in = f->up ? p->v[f->axis] > 0 : p->v[f->axis] < 0;
    for (int k = 0; k < SPH_DIM; k++) {
        const double near = (SPH_DOUBLE ? 1 : 0.02) * s->cfg.spacing;
        if (k == (int)f->axis)
            continue;
        if (f->lo[k] > s->cfg.lo[k])
            o_close(s, "a particle on the side of a flow", p->x[k], f->lo[k], near);
        if (f->hi[k] < s->cfg.hi[k])
            o_close(s, "a particle on the side of a flow", p->x[k], f->hi[k], near);
        in &= p->x[k] >= f->lo[k] && p->x[k] < f->hi[k];
    }
    return in && has_passed(s, f, p->x[f->axis], f->face) && !has_passed(s, f, p->x[f->axis], f->end);
}

/* the set to which a particle belongs from a step's beginning on */
static uint32_t set_to_be(o_scene *s, const o_particle *p)
{
    const o_set *own = &s->set[p->set];
    if (own->flow == O_INFLOW)
        return has_passed(s, own, p->x[own->axis], own->face) ? own->fluid : p->set;
    for (uint32_t f = 0; f < s->sets; f++)
        if (s->set[f].flow == O_OUTFLOW && own->flow == O_NO_FLOW && s->set[f].fluid == p->set &&
            is_going_out(s, &s->set[f], p))
            return f;
    return p->set;
}

static bool is_taken(const o_scene *s, uint32_t id)
{
    bool taken = false;
    for (uint32_t i = 0; i < s->n; i++)
        taken |= s->own[i].id == id;
    for (uint32_t i = 0; i < s->standing; i++)
        taken |= s->stands[i] == id;
    return taken;
}
static uint32_t next_free(o_scene *s)
{
    do
        s->next_id = s->next_id + 1 < s->cfg.max_particles ? s->next_id + 1 : 0;
    while (is_taken(s, s->next_id));
    return s->next_id;
}

static void give_birth(o_scene *s, uint32_t parent)
{
    const o_set *f = &s->set[s->own[parent].set];
    o_particle *p = &s->own[s->n];
    *p = s->own[parent];
    p->id = next_free(s);
    p->parent = parent;
    p->born = true;
    p->becomes = p->set;
    p->x[f->axis] += f->end - f->face;
    p->home[f->axis] += f->end - f->face;
    p->rest[f->axis] += f->end - f->face;
    o_plus(&s->added_mass, f->mass);
    o_plus(&s->fed, o_energy_of(s, p));
    s->n++;
}

/* before the first forces: none goes across an inflow's way */
void o_straighten(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++)
        for (int k = 0; k < 3 && s->set[s->own[i].set].flow == O_INFLOW; k++)
            s->own[i].v[k] *= k == (int)s->set[s->own[i].set].axis;
}

void o_note_held(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        const o_set *set = &s->set[p->set];
        p->held_d = p->d;
        for (int k = 0; k < 3; k++)
            p->held_v[k] = set->flow == O_INFLOW && k != (int)set->axis ? 0 : p->v[k];
    }
}

bool o_open_flows(o_scene *s)
{
    const uint32_t n = s->n;
    uint32_t births = 0;
    for (uint32_t i = 0; i < n; i++) {
        o_particle *p = &s->own[i];
        p->becomes = set_to_be(s, p);
        p->born = false;
        births += s->set[p->set].flow == O_INFLOW && p->becomes != p->set;
    }
    if (births && n + s->standing + births > s->cfg.max_particles) {
        s->needed = n + s->standing + births;
        return false;
    }
    if (births && !(s->own = realloc(s->own, (n + births + 1) * sizeof *s->own)))
        abort();
    o_note_held(s);
    for (uint32_t i = 0; i < n; i++)
        if (s->set[s->own[i].set].flow == O_INFLOW && s->own[i].becomes != s->own[i].set)
            give_birth(s, i);
    s->standing = 0;
    return true;
}

void o_change_sets(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++)
        s->own[i].set = s->own[i].becomes;
}

/* what holds a particle, after its sums; `rate`: d(rho)/dt that it would have */
void o_carry_along(o_particle *i, o_sum rate)
{
    const double per = i->p / (i->rho * i->rho);
    o_add(&i->worked, -per * rate.v, fabs(per) * rate.s);
    for (int k = 0; k < 3; k++) {
        o_add(&i->worked, -i->a[k].v * i->v[k], i->a[k].s * fabs(i->v[k]));
        i->a[k] = i->drift[k] = (o_sum){0, 0};
    }
}

void o_let_out(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        const o_set *f = &s->set[p->set];
        if (p->gone || f->flow != O_OUTFLOW || !has_passed(s, f, p->x[f->axis], f->end))
            continue;
        p->gone = true;
        s->left++;
        s->let_out++;
        o_plus(&s->removed_mass, f->mass);
        o_plus(&s->carried_off, o_energy_of(s, p));
    }
}
