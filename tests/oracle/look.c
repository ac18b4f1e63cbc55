/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* look.c: the only file of the oracle that sees the inside of the kernel. It builds a plan's simulation through the
   public functions, writes stresses, damage and reference positions into the state (no function sets them), and reads
   the state and the results of the sums. Positions are those that the kernel keeps, so that rounding them to quanta is
   no difference. */
#include <stdlib.h>
#include <string.h>

#include "plan.h"
#include "sph/internal.h"

static unsigned char *arena;
static size_t arena_room;

static sph_sim *init(const plan *p, sph_report *why)
{
    sph_sim *sim = NULL;
    sph_config c = p->cfg;
    c.body_ctx = (void *)(uintptr_t)p;
    if (sph_config_check(&c, why) != SPH_OK)
        return NULL;
    const size_t bytes = sph_arena_bytes(&c);
    if (bytes > arena_room) {
        free(arena);
        arena_room = (2 * bytes + 63) / 64 * 64;
        arena = aligned_alloc(SPH_ALIGN, arena_room);
    }
    return arena && sph_init(&sim, &c, arena, bytes, why) == SPH_OK ? sim : NULL;
}

static sph_status add_sets(sph_sim *sim, const plan *p, uint32_t *set)
{
    sph_status st = SPH_OK;
    for (uint32_t k = 0; !st && k < p->fluids; k++)
        st = sph_add_fluid(sim, &p->fluid[k], &set[k]);
    for (uint32_t k = 0; !st && k < p->solids; k++) {
        sph_solid m = p->solid[k];
        m.motion = m.held ? sph_motion_steady : NULL;
        m.motion_ctx = (void *)(uintptr_t)&p->held[k];
        st = sph_add_solid(sim, &m, &set[p->fluids + k], NULL);
    }
    return st;
}

static sph_table tables[PLAN_WALLS];

static sph_status add_wall(sph_sim *sim, const plan_wall *w, sph_table *table)
{
    sph_wall wall = w->wall;
    *table = (sph_table){PLAN_ROWS, w->axis, w->t, w->x};
    wall.motion = w->by_table ? sph_motion_table : sph_motion_steady;
    wall.motion_ctx = w->by_table ? (void *)table : (void *)(uintptr_t)&w->motion;
#if SPH_DIM == 2
    if (w->flat)
        return sph_add_wall_segment(sim, &wall, w->lo, w->hi, NULL);
#elif SPH_DIM == 3
    if (w->flat)
        return sph_add_wall_plane(sim, &wall, w->lo, w->hi, w->across, NULL);
#endif
    return sph_add_wall_box(sim, &wall, w->lo, w->hi, w->faces, w->inside, NULL);
}

static sph_status add_points(sph_sim *sim, const plan *p, const uint32_t *set)
{
    sph_status st = SPH_OK;
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = 0; !st && i < p->points; i++) {
        const plan_point *q = &p->point[i];
        const double rho0 = sim->set[set[q->set]].rho0;
        uint32_t id = 0;
        st = sph_add_particle(sim, set[q->set], q->x, q->v, rho0 * (1 + q->d), &id);
        if (!st && b->energy[0])
            b->energy[0][id] = (sph_real)(sim->set[set[q->set]].eos == SPH_IDEAL_GAS
                                              ? q->warm * (double)b->energy[0][id]
                                              : q->warm * 1e-3 * p->cfg.sound_speed * p->cfg.sound_speed);
        if (st || q->set < p->fluids)
            continue;
        for (int k = 0; k < SPH_NS; k++)
            b->stress[k][id] = (sph_real)q->dev[k];
        if (b->plastic[0])
            b->plastic[0][id] = (sph_real)q->plastic;
        if (b->damage[0])
            b->damage[0][id] = (sph_real)q->root;
        for (int k = 0; k < SPH_DIM && b->shift[0]; k++)
            b->shift[k][id] = (sph_pos)(q->moved[k] / sim->grid.quantum);
    }
    return st;
}

#if SPH_DIM == 2
static sph_status add_bed(sph_sim *sim, const plan_bed *b)
{
    sph_wall wall = b->wall;
    wall.motion = sph_motion_steady;
    wall.motion_ctx = (void *)(uintptr_t)&b->motion;
    return b->points ? sph_add_wall_polyline(sim, &wall, b->p, b->points, NULL) : SPH_OK;
}
#else
static sph_status add_bed(sph_sim *sim, const plan_bed *b)
{
    (void)sim, (void)b;
    return SPH_OK;
}
#endif

#if SPH_DIM > 1
static sph_status add_flaws(sph_sim *sim, const plan *p, const uint32_t *set)
{
    sph_status st = SPH_OK;
    for (uint32_t k = 0; k < p->solids; k++) {
        bool any = false; /* a set without particles can have none */
        for (uint32_t i = 0; i < p->points; i++)
            any |= p->point[i].set == p->fluids + k;
        const sph_flaws flaws = {p->flaws[k].k, p->flaws[k].m, p->flaws[k].seed};
        if (!st && any && p->flaws[k].k > 0 && p->cfg.damage)
            st = sph_add_flaws(sim, set[p->fluids + k], &flaws);
    }
    return st;
}
uint32_t look_flaws(const sph_sim *sim, uint32_t id, float *threshold)
{
    uint32_t n = 0;
    return sph_get_flaws(sim, id, &n, threshold) == SPH_OK ? n : 0;
}
#else /* flaws there are in 2-D and 3-D only */
static sph_status add_flaws(sph_sim *sim, const plan *p, const uint32_t *set)
{
    (void)sim, (void)p, (void)set;
    return SPH_OK;
}
uint32_t look_flaws(const sph_sim *sim, uint32_t id, float *threshold)
{
    (void)sim, (void)id, (void)threshold;
    return 0;
}
#endif

/* along the axis, and sideways, where nothing may come of it; and the density of a row */
static void uneven(void *ctx, const double *x, double *v, double *rho)
{
    const plan_flow *f = ctx;
    const double at = 3 * x[SPH_DIM - 1] / (f->is.hi[SPH_DIM - 1] - f->is.lo[SPH_DIM - 1]);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        v[k] = k == f->axis ? v[k] * (1 + f->uneven * sin(at)) : 0.1 * f->uneven * f->is.speed;
    *rho *= 1 + f->thick * sin(2 * at + 1);
}

/* inflows and outflows; layers of inflows have come nearer to where the next one was */
static sph_status add_flows(sph_sim *sim, const plan *p, const uint32_t *set)
{
    sph_status st = SPH_OK;
    for (uint32_t k = 0; !st && k < p->flows; k++) {
        const plan_flow *f = &p->flow[k];
        const uint32_t first = sim->now.count;
        uint32_t own;
        st = (f->out ? sph_add_outflow : sph_add_inflow)(sim, set[f->fluid], &f->is, &own);
        if (!st && !f->out)
            st = sph_apply_field(sim, own, uneven, (void *)(uintptr_t)f);
        for (uint32_t i = first; !st && i < sim->now.count; i++) {
            const double way = (0.5 - f->gap * ((i * 37 % 19) + 0.5) / 19) * p->cfg.spacing;
            sim->buf[sim->cur].pos[f->axis][i] +=
                (sph_pos)((f->is.face == SPH_HIGH(f->axis) ? way : -way) / sim->grid.quantum);
        }
    }
    return st;
}

/* layers before edges, as edges.c makes them up */
static sph_status add_edges(sph_sim *sim, const plan *p)
{
    const sph_edges edges = {.given = true};
    sph_status st = SPH_OK;
    for (uint32_t i = 0; !st && i < p->points && p->cfg.edge; i++) {
        double n[3];
        const uint32_t level = o_edge_mark(i, n);
        if (p->point[i].set >= p->fluids)
            st = sph_set_edge(sim, i, level, n);
    }
    return st || !p->cfg.edge ? st : sph_find_edges(sim, &edges);
}

sph_sim *look_build(const plan *p, sph_report *why)
{
    uint32_t set[2 * PLAN_SETS];
    sph_sim *sim = init(p, why);
    if (!sim)
        return NULL;
    sph_status st = add_sets(sim, p, set);
    st = st ? st : add_points(sim, p, set);
    st = st ? st : add_flows(sim, p, set);
    st = st ? st : add_flaws(sim, p, set);
    st = st ? st : add_edges(sim, p);
    for (uint32_t k = 0; !st && k < p->walls; k++)
        st = add_wall(sim, &p->wall[k], &tables[k]);
    st = st ? st : add_bed(sim, &p->bed);
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = p->points; !st && i < sim->now.count; i++) /* compressible walls are not at rest density */
        if (sim->set[b->set[0][i]].compressible)
            b->rho[0][i] = (sph_real)(p->wall_d * ((double)(i * 37 % 19) / 9 - 1));
    *why = *sph_last(sim);
    return st ? NULL : sim;
}

/* ---- the state ---- */

static void read_set(const sph_sim *sim, uint32_t k, o_set *o)
{
    const sph_set *s = &sim->set[k];
    *o = (o_set){.role = s->role, .kind = s->kind, .eos = s->eos, .compressible = s->compressible,
                 .no_slip = s->no_slip, .side = s->side, .half = {s->half[0], s->half[1]}, .mass = s->mass,
                 .rho0 = s->rho0, .c0 = s->c0, .strength = s->strength};
    if (s->group < SPH_MAX_GROUPS && sim->group[s->group].motion == sph_motion_table)
        o->table = sim->group[s->group].ctx;
    for (int a = 0; a < SPH_DIM; a++) {
        if (s->group < SPH_MAX_GROUPS && sim->group[s->group].motion == sph_motion_steady) {
            const sph_steady *m = sim->group[s->group].ctx;
            o->start[a] = m->v[a];
            o->accel[a] = m->a[a];
        }
    }
    o_told(o, sim->now.time, o->moved, o->velocity);
    for (int a = 0; a < SPH_DIM; a++) {
        o->once[a] = o->twice[a] = o->velocity[a];
        o->origin[a] = s->origin[a] + sim->cfg.lo[a] + o->moved[a];
        o->normal[a] = s->normal[a];
        o->tangent[a] = s->tangent[a];
    }
    o->region = s->role != SPH_ROLE_FLUID && s->role != SPH_ROLE_SOLID && !s->corner;
    o->thick = o->region ? s->thick : 0;
    if (s->role != SPH_ROLE_SOLID)
        return;
    const sph_material *m = &sim->material[k];
    o->shear = m->shear;
    o->yield = m->yield;
    o->hardening = m->hardening;
    o->crack = m->crack_rate;
    o->body = m->body;
    o->held = m->held;
    o->flat = m->flat;
}

/* an inflow or outflow is as it was asked for */
static void tell_flow(const plan_flow *f, o_set *o)
{
    const bool high = f->is.face == SPH_HIGH(f->axis);
    o->flow = f->out ? O_OUTFLOW : O_INFLOW;
    o->axis = f->axis;
    o->fluid = f->fluid;
    o->up = high != f->out;
    for (int k = 0; k < SPH_DIM; k++) {
        o->lo[k] = f->is.lo[k];
        o->hi[k] = f->is.hi[k];
    }
    o->face = high ? o->hi[f->axis] : o->lo[f->axis];
    o->end = high ? o->lo[f->axis] : o->hi[f->axis];
}

/* the kept components as a full deviator, whose trace is 0 */
static void read_deviator(const sph_buffer *b, uint32_t i, double (*dev)[3])
{
    if (!b->stress[0])
        return;
    double kept[5] = {0};
    for (int k = 0; k < SPH_NS; k++)
        kept[k] = (double)b->stress[k][i];
    dev[0][0] = kept[0];
    if (SPH_DIM == 1) {
        dev[1][1] = dev[2][2] = -0.5 * kept[0];
        return;
    }
    dev[1][1] = kept[1];
    dev[2][2] = -(kept[0] + kept[1]);
    dev[0][1] = dev[1][0] = kept[2];
    dev[0][2] = dev[2][0] = kept[3];
    dev[1][2] = dev[2][1] = kept[4];
}

void look_scene(const sph_sim *sim, const plan *p, o_scene *s)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    s->cfg = sim->cfg;
    s->support = o_weight_support(s->cfg.kernel) * s->cfg.smoothing_length * (s->cfg.variable_h ? s->cfg.h_max : 1);
    s->time = sim->now.time;
    s->undecided = NULL;
    s->shaken = false;
    s->sets = sim->sets;
    for (uint32_t k = 0; k < s->sets; k++)
        read_set(sim, k, &s->set[k]);
    for (uint32_t k = 0; k < p->flows; k++)
        tell_flow(&p->flow[k], &s->set[p->fluids + p->solids + k]);
    s->n = sim->now.count;
    s->own = realloc(s->own, (s->n + 1) * sizeof *s->own);
    if (!s->own)
        abort();
    memset(s->own, 0, s->n * sizeof *s->own);
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *o = &s->own[i];
        const o_set *set = &s->set[b->set[0][i]];
        const bool body = set->role == SPH_ROLE_FLUID || set->role == SPH_ROLE_SOLID;
        o->id = b->id[0][i];
        o->set = b->set[0][i];
        o->d = (double)b->rho[0][i];
        o->u = b->energy[0] ? (double)b->energy[0][i] : 0;
        o->plastic = b->plastic[0] ? (double)b->plastic[0][i] : 0;
        o->root = b->damage[0] && set->role == SPH_ROLE_SOLID ? (double)b->damage[0][i] : 0;
        o->phi.v = o->phi.s = b->quadrature[0] ? (double)b->quadrature[0][i] : 0;
        for (int k = 0; k < SPH_DIM; k++) {
            o->x[k] = s->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
            o->home[k] = o->x[k] - set->moved[k];
            o->rest[k] = o->x[k] - (b->shift[k] ? (double)b->shift[k][i] * sim->grid.quantum : 0);
            const bool held = set->role == SPH_ROLE_SOLID && set->held >> k & 1;
            o->wall[k] = o->seen[k] = set->velocity[k];
            o->v[k] = !body ? set->velocity[k] : (double)(held ? (sph_real)set->velocity[k] : b->vel[k][i]);
        }
        memcpy(o->normal, set->normal, sizeof o->normal);
        memcpy(o->origin, set->origin, sizeof o->origin);
        memcpy(o->tangent, set->tangent, sizeof o->tangent);
        if (set->role == SPH_ROLE_SOLID)
            read_deviator(b, i, o->dev);
    }
}

uint32_t look_results(const sph_sim *sim, seen *to, uint32_t room)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    memset(to, 0, room * sizeof *to);
    for (uint32_t i = 0; i < sim->now.count; i++) {
        const uint32_t id = b->id[0][i];
        if (id >= room || b->set[0][i] == SPH_DEAD)
            continue;
        seen *o = &to[id];
        o->there = true;
        o->set = b->set[0][i];
        o->d = (double)b->rho[0][i];
        o->rate = (double)b->drho[0][i];
        o->plastic = b->plastic[0] ? (double)b->plastic[0][i] : 0;
        o->root = b->damage[0] ? (double)b->damage[0][i] : 0;
        o->u = b->energy[0] ? (double)b->energy[0][i] : 0;
        o->warmed = b->denergy[0] ? (double)b->denergy[0][i] : 0;
        o->phi = b->quadrature[0] ? (double)b->quadrature[0][i] : 0;
        for (int k = 0; k < SPH_DIM; k++) {
            o->x[k] = sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
            o->v[k] = (double)b->vel[k][i];
            o->a[k] = (double)b->acc[k][i];
            o->drift[k] = b->xsph[k] ? (double)b->xsph[k][i] : 0;
        }
        for (int k = 0; k < SPH_NS && b->stress[0]; k++) {
            o->dev[k] = (double)b->stress[k][i];
            o->dev_rate[k] = (double)b->dstress[k][i];
        }
        for (uint32_t k = 0; k <= SPH_DIM && sim->disorder[0] && sph_is_matter(&sim->set[b->set[0][i]]); k++)
            o->disorder[k] = (double)sim->disorder[k][i];
        for (uint32_t k = 0; k < SPH_POWERS && sim->power[0]; k++)
            o->power[k] = (double)sim->power[k][i];
    }
    return sim->now.count;
}

double look_power(const sph_sim *sim, uint32_t k) { return k < SPH_POWERS ? sim->now.power[k] : 0; }

double look_limit(const sph_sim *sim, const char *part_of_name)
{
    sph_step_info info;
    sph_get_step(sim, &info);
    for (uint32_t k = 0; k < SPH_LIMITS; k++)
        if (strstr(sph_limit_text(k), part_of_name))
            return info.limit_dt[k];
    return -1;
}
