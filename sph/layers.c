/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* layers.c: walls as rows or layers of particles; walls that are taken away, and motions given as a table. Runs
   between steps only; what walls do in a step is in adami.c, boundary.c, groups.c and crossing.c.

   Ghost layers stand on the continuation of the fluid's lattice: centres half a spacing behind the wall, then one
   spacing apart, as many as the kernel's support needs (Gray 2001 section 2.4). Where two chosen faces of a tank
   meet, the particles behind both get the diagonal normal (his figure 2.4). Boundary-force particles stand on the
   wall itself. */
#include "layers.h"
#include "arithmetic.h"

SPH_OBJECT(layers)

#if SPH_HAS_WALLS
sph_wall sph_wall_default(void)
{
    sph_wall w;
    memset(&w, 0, sizeof w);
    w.kind = SPH_WALL_ADAMI;
    return w;
}

bool sph_layers_wanted(const sph_wall *w)
{
    return !SPH_HAS_FORCE_WALLS || SPH_IS(w->kind, WALL_GHOST) || SPH_IS(w->kind, WALL_ADAMI);
}

static double default_strength(const sph_sim *sim, uint32_t kind)
{
    double c2 = sim->cfg.sound_speed * sim->cfg.sound_speed;
    if (SPH_IS(kind, WALL_LENNARD_JONES))
        return c2 / 200; /* g H with Gray's c^2 = 200 g H */
    if (SPH_IS(kind, WALL_KERNEL_FORCE))
        return 0.01;
    return SPH_IS(kind, WALL_MONAGHAN_KOS) ? 0.01 * c2 / sim->cfg.spacing : 0;
}

sph_status sph_layers_check(sph_sim *sim, const sph_wall *w, const char *call)
{
    sph_status st = sph_setup_begin_adding(sim, call);
    if (st)
        return st;
    if (!w)
        return sph_setup_bad(sim, "wall", "a description of the wall", 0);
    if (w->kind >= SPH_WALLS)
        return sph_setup_bad(sim, "wall.kind", "one of SPH_WALL_LENNARD_JONES .. SPH_WALL_ADAMI", w->kind);
    if (!sph_in(SPH_WALLS_IN, w->kind))
        return sph_setup_bad(sim, "wall.kind", "a kind that was compiled in (modules.h)", w->kind);
    if (SPH_IS(w->kind, WALL_MONAGHAN_KOS) && sim->grid.support < 2 * sim->cfg.spacing)
        return sph_setup_bad(sim, "wall.kind", "another than MONAGHAN_KOS, which reaches two spacings, where the "
                             "kernel's support is less", w->kind);
    if (SPH_IS(w->kind, WALL_GHOST) && w->compressible && sph_sums_density(&sim->cfg))
        return sph_setup_bad(sim, "wall.compressible", "false where density is summed: it has no rate", 1);
    if (!SPH_WITH_MOVING_WALLS && w->motion)
        return sph_setup_bad(sim, "wall.motion", "null: moving walls were left out (modules.h)", 1);
    if (!(w->strength >= 0 && w->strength < 1e30))
        return sph_setup_bad(sim, "wall.strength", ">= 0", w->strength);
    if (w->side >= SPH_SIDES || (w->side && (!SPH_HAS_SIDES || !sph_layers_wanted(w) || w->compressible)))
        return sph_setup_bad(sim, "wall.side", SPH_HAS_SIDES ? "SPH_BOTH_SIDES, or of GHOST (not compressible) and ADAMI "
                             "SPH_FRONT, SPH_FACE" : "SPH_BOTH_SIDES: others were left out (modules.h)", w->side);
    if (w->layers > 64)
        return sph_setup_bad(sim, "wall.layers", "0 .. 64", w->layers);
    if (sim->groups == SPH_MAX_GROUPS)
        return sph_error(sim, SPH_TOO_MANY_SETS, "wall groups", "at most SPH_MAX_GROUPS", sim->groups, SPH_NO_PARTICLE);
    return SPH_OK;
}

sph_layers_before sph_layers_mark(const sph_sim *sim)
{
    return (sph_layers_before){sim->sets, sim->now.count, sim->setup_hash};
}

sph_status sph_layers_finish(sph_sim *sim, const sph_wall *w, sph_layers_before m, sph_status st, uint32_t *group)
{
    if (!st && sim->now.count + (SPH_WITH_DETAILS ? sim->unplaced : 0) == m.count)
        st = sph_setup_bad(sim, "wall", "at least one particle on the chosen faces", 0);
    st = sph_setup_end_adding(sim, m.count, st);
    if (st) {
        sim->sets = m.sets;
        sim->setup_hash = m.hash;
        return st;
    }
    sim->has_adami |= w->kind == SPH_WALL_ADAMI;
    sim->sided |= w->side != SPH_BOTH_SIDES;
    sim->has_force_wall |= !sph_layers_wanted(w);
    const uint32_t made = sph_setup_add_group(sim, w->motion, w->motion_ctx);
    if (group)
        *group = made;
    return SPH_OK;
}

/* a new set for one face or corner; origin, normal, tangent, half are from the caller */
sph_set *sph_layers_new_set(sph_sim *sim, const sph_wall *w, uint32_t *index)
{
    if (sim->sets == sim->cfg.max_sets) {
        sph_error(sim, SPH_TOO_MANY_SETS, "sets", "at most max_sets", sim->sets, SPH_NO_PARTICLE);
        return NULL;
    }
    *index = sim->sets++;
    sph_set *s = &sim->set[*index];
    memset(s, 0, sizeof *s);
    s->role = sph_layers_wanted(w) ? SPH_ROLE_GHOST : SPH_ROLE_FORCE_WALL;
    s->kind = w->kind;
    s->group = sim->groups;
    s->compressible = w->compressible && SPH_IS(w->kind, WALL_GHOST); /* others have no rate to follow */
    s->no_slip = w->no_slip;
    s->side = (uint8_t)w->side;
    s->eos = (uint8_t)sim->cfg.eos;
    s->rho0 = sim->cfg.rho0;
    s->c0 = sim->cfg.sound_speed;
    s->mass = s->rho0 * sph_setup_cell_volume(sim);
    s->strength = w->strength > 0 ? w->strength : default_strength(sim, w->kind);
    return s;
}

/* no further than a domain's length outside: nothing is found there, and integers stay small */
static __attribute__((noinline)) sph_pos bounded_quanta(const sph_sim *sim, int k, double x)
{
    const double far = sim->grid.length[k];
    return sph_setup_to_quanta(sim, x > -far ? x < 2 * far ? x : 2 * far : -far);
}

/* the box in quanta around the region behind a face */
void sph_layers_bound(const sph_sim *sim, sph_set *s)
{
    for (int k = 0; k < SPH_DIM; k++) {
        double reach[3] = {s->thick * sph_abs(s->normal[k]), 0, 0};
        if (SPH_DIM == 2)
            reach[1] = s->half[0] * sph_abs(s->normal[1 - k]);
        if (SPH_DIM == 3) {
            int a = (k + 1) % SPH_DIM, b = (k + 2) % SPH_DIM;
            double t2 = s->normal[a] * s->tangent[b] - s->normal[b] * s->tangent[a];
            reach[1] = s->half[0] * sph_abs(s->tangent[k]);
            reach[2] = s->half[1] * sph_abs(t2);
        }
        double r = reach[0] + reach[1] + reach[2];
        s->low[k] = bounded_quanta(sim, k, s->origin[k] - r) - 1;
        s->high[k] = bounded_quanta(sim, k, s->origin[k] + r) + 1;
    }
}

uint32_t sph_layers_count(const sph_sim *sim, const sph_wall *w)
{
    return w->layers ? w->layers : sph_setup_round_up(sim->grid.support / sim->cfg.spacing);
}

/* lattice of a box and its surroundings along one axis */
typedef struct axis_lattice {
    double lo, hi, dx, step; /* from the domain's low corner; step: spacing that divides the box evenly */
    int32_t n;
} axis_lattice;

/* centre of layer-lattice index i: inside the box on its own step, outside one spacing apart */
static double lattice_centre(const axis_lattice *a, int32_t i)
{
    if (i < 0)
        return a->lo + (i + 0.5) * a->dx;
    if (i >= a->n)
        return a->hi + (i - a->n + 0.5) * a->dx;
    return a->lo + (i + 0.5) * a->step;
}

typedef struct box_wall {
    const sph_wall *wall;
    axis_lattice ax[SPH_DIM];
    uint32_t faces;
    bool inside;
    int32_t layers;
    uint32_t set_of[27]; /* by code of sides, SPH_MAX_SETS: none yet */
} box_wall;

/* the set for the sides (-1, 0, 1 an axis); made when first needed */
static sph_status side_set(sph_sim *sim, box_wall *b, const int *side, uint32_t *set)
{
    uint32_t code = 0;
    int many = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        code = code * 3 + (uint32_t)(side[k] + 1);
        many += side[k] != 0;
    }
    *set = b->set_of[code];
    if (*set < SPH_MAX_SETS)
        return SPH_OK;
    sph_set *s = sph_layers_new_set(sim, b->wall, set);
    if (!s)
        return SPH_TOO_MANY_SETS;
    b->set_of[code] = *set;
    double norm = 1 / __builtin_sqrt((double)many), shortest = 1e300;
    int t = 0;
    s->corner = many > 1;
    s->thick = b->layers * sim->cfg.spacing;
    for (int k = 0; k < SPH_DIM; k++) {
        const axis_lattice *a = &b->ax[k];
        s->origin[k] = side[k] < 0 ? a->lo : side[k] > 0 ? a->hi : 0.5 * (a->lo + a->hi);
        s->normal[k] = (b->inside ? -side[k] : side[k]) * norm;
        shortest = a->hi - a->lo < shortest ? a->hi - a->lo : shortest;
        /* a tank's face reaches behind its neighbours, so that corners are covered */
        if (!side[k] && t < 2)
            s->half[t++] = 0.5 * (a->hi - a->lo) + (b->inside ? s->thick : 0);
    }
    if (!b->inside && s->thick > 0.5 * shortest)
        s->thick = 0.5 * shortest;
    /* half[0] belongs to the first axis in the plane; an edge's tangent is the edge */
    for (int k = 0; SPH_DIM == 3 && k < SPH_DIM; k++)
        if (!side[k]) {
            s->tangent[k] = 1;
            break;
        }
    if (many == 3)
        s->tangent[0] = 1;
    sph_layers_bound(sim, s);
    sph_setup_finish_set(sim, s);
    return SPH_OK;
}

/* which sides of the box the layer point lies behind; false if it belongs to no chosen face */
static bool layer_sides(const box_wall *b, const int32_t *i, int *side)
{
    bool any = false;
    int32_t best = b->layers;
    int axis = -1, dir = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        bool low = b->faces & SPH_LOW((uint32_t)k), high = b->faces & SPH_HIGH((uint32_t)k);
        side[k] = 0;
        if (b->inside) {
            side[k] = i[k] < 0 ? -1 : i[k] >= b->ax[k].n ? 1 : 0;
            if ((side[k] < 0 && !low) || (side[k] > 0 && !high))
                return false;
            any |= side[k] != 0;
        } else { /* an obstacle's point belongs to its nearest chosen face */
            if (low && i[k] < best)
                best = i[k], axis = k, dir = -1;
            if (high && b->ax[k].n - 1 - i[k] < best)
                best = b->ax[k].n - 1 - i[k], axis = k, dir = 1;
        }
    }
    if (b->inside)
        return any;
    if (axis < 0)
        return false;
    side[axis] = dir;
    return true;
}

/* which chosen faces a node of the box's surface lies on */
static bool node_sides(const box_wall *b, const int32_t *i, int *side)
{
    bool any = false;
    for (int k = 0; k < SPH_DIM; k++) {
        side[k] = 0;
        if (i[k] == 0 && (b->faces & SPH_LOW((uint32_t)k)))
            side[k] = -1;
        else if (i[k] == b->ax[k].n && (b->faces & SPH_HIGH((uint32_t)k)))
            side[k] = 1;
        any |= side[k] != 0;
    }
    return any;
}

static sph_status box_point(sph_sim *sim, box_wall *b, const int32_t *i, bool layers)
{
    int side[SPH_DIM];
    double x[SPH_DIM];
    uint32_t set;
    if (!(layers ? layer_sides(b, i, side) : node_sides(b, i, side)))
        return SPH_OK;
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = layers ? lattice_centre(&b->ax[k], i[k]) : b->ax[k].lo + i[k] * b->ax[k].step;
    sph_status st = side_set(sim, b, side, &set);
    return st ? st : sph_setup_append(sim, set, x, NULL, 0);
}

sph_status sph_add_wall_box(sph_sim *sim, const sph_wall *wall, const double *lo, const double *hi, uint32_t faces,
                            bool inside, uint32_t *group)
{
    sph_status st = sph_layers_check(sim, wall, "sph_add_wall_box");
    if (st)
        return st;
    if (!lo || !hi)
        return sph_setup_bad(sim, "lo, hi", "the corners of a box", 0);
    if (faces == 0 || faces >> (2 * SPH_DIM))
        return sph_setup_bad(sim, "faces", "an or of SPH_LOW(k), SPH_HIGH(k)", faces);
    box_wall b;
    memset(&b, 0, sizeof b);
    b.wall = wall;
    b.faces = faces;
    b.inside = inside;
    b.layers = (int32_t)sph_layers_count(sim, wall);
    for (int k = 0; k < 27; k++)
        b.set_of[k] = SPH_MAX_SETS;
    int32_t from[3] = {0, 0, 0}, to[3] = {1, 1, 1}, i[3] = {0, 0, 0};
    bool layers = sph_layers_wanted(wall);
    for (int k = 0; k < SPH_DIM; k++) {
        if (!(hi[k] > lo[k]) || !(sph_abs(lo[k]) < 1e15) || !(sph_abs(hi[k]) < 1e15))
            return sph_setup_bad(sim, "hi", "finite and > lo on every axis", hi[k]);
        if (!sph_setup_near_domain(sim, k, lo[k], hi[k]))
            return sph_setup_bad(sim, "hi", "a box within a domain's length of the domain", hi[k]);
        axis_lattice *a = &b.ax[k];
        uint32_t n = sph_setup_intervals(hi[k] - lo[k], sim->cfg.spacing);
        if (n == 0 || n > 100000000u)
            return sph_setup_bad(sim, "hi", "at most 10^8 spacings from lo", hi[k]);
        *a = (axis_lattice){lo[k] - sim->cfg.lo[k], hi[k] - sim->cfg.lo[k], sim->cfg.spacing, (hi[k] - lo[k]) / n,
                            (int32_t)n};
        from[k] = layers && inside ? -b.layers : 0;
        to[k] = a->n + (layers ? inside ? b.layers : 0 : 1);
    }
    sph_layers_before m = sph_layers_mark(sim);
    for (i[2] = from[2]; !st && i[2] < to[2]; i[2]++)
        for (i[1] = from[1]; !st && i[1] < to[1]; i[1]++)
            for (i[0] = from[0]; !st && i[0] < to[0]; i[0]++)
                st = box_point(sim, &b, i, layers);
    return sph_layers_finish(sim, wall, m, st, group);
}

#if SPH_DIM >= 2
/* rows or layers along up to two directions: origin + (s t1 len1) + (t t2 len2), behind the normal */
static sph_status flat_wall(sph_sim *sim, const sph_wall *wall, const double *origin, const double *normal,
                            const double (*dir)[SPH_DIM], const double *len, uint32_t *group)
{
    double dx = sim->cfg.spacing;
    uint32_t n[2] = {1, 1}, layers = sph_layers_wanted(wall) ? sph_layers_count(sim, wall) : 1, set;
    double off = sph_layers_wanted(wall) ? 0.5 : 0;
    sph_layers_before m = sph_layers_mark(sim);
    sph_set *s = sph_layers_new_set(sim, wall, &set);
    if (!s)
        return sph_layers_finish(sim, wall, m, SPH_TOO_MANY_SETS, group);
    s->thick = sph_layers_count(sim, wall) * dx;
    for (int k = 0; k < SPH_DIM; k++) {
        s->normal[k] = normal[k];
        s->tangent[k] = SPH_DIM == 3 ? dir[0][k] : 0;
        s->origin[k] = origin[k] - sim->cfg.lo[k];
        for (int t = 0; t < SPH_DIM - 1; t++)
            s->origin[k] += 0.5 * len[t] * dir[t][k];
    }
    for (int t = 0; t < SPH_DIM - 1; t++) {
        s->half[t] = 0.5 * len[t];
        n[t] = sph_setup_intervals(len[t], dx) + (sph_layers_wanted(wall) ? 0 : 1);
        if (n[t] > 100000000u)
            return sph_layers_finish(sim, wall, m,
                                     sph_setup_bad(sim, "wall", "at most 10^8 spacings long", len[t]), group);
    }
    sph_layers_bound(sim, s);
    sph_setup_finish_set(sim, s);
    sph_status st = SPH_OK;
    for (uint32_t l = 0; !st && l < layers; l++)
        for (uint32_t b = 0; !st && b < n[1]; b++)
            for (uint32_t a = 0; !st && a < n[0]; a++) {
                const uint32_t i[2] = {a, b};
                double x[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    x[k] = origin[k] - sim->cfg.lo[k] - normal[k] * (l + off) * dx * (sph_layers_wanted(wall) ? 1 : 0);
                    for (int t = 0; t < SPH_DIM - 1; t++)
                        x[k] += dir[t][k] * (i[t] + off) * (len[t] / (sph_layers_wanted(wall) ? n[t] : n[t] - 1));
                }
                st = sph_setup_append(sim, set, x, NULL, 0);
            }
    return sph_layers_finish(sim, wall, m, st, group);
}
#endif

#if SPH_DIM == 2
sph_status sph_add_wall_segment(sph_sim *sim, const sph_wall *wall, const double *a, const double *b, uint32_t *group)
{
    sph_status st = sph_layers_check(sim, wall, "sph_add_wall_segment");
    if (st)
        return st;
    if (!a || !b)
        return sph_setup_bad(sim, "a, b", "two points", 0);
    if ((st = sph_setup_check_vector(sim, "a", a)) != SPH_OK || (st = sph_setup_check_vector(sim, "b", b)) != SPH_OK)
        return st;
    double d[1][2] = {{b[0] - a[0], b[1] - a[1]}};
    double len[1] = {__builtin_sqrt(d[0][0] * d[0][0] + d[0][1] * d[0][1])};
    if (!(len[0] > 0.5 * sim->cfg.spacing))
        return sph_setup_bad(sim, "b", "at least half a spacing from a", len[0]);
    d[0][0] /= len[0];
    d[0][1] /= len[0];
    const double normal[2] = {-d[0][1], d[0][0]};
    return flat_wall(sim, wall, a, normal, (const double(*)[2])d, len, group);
}
#endif

#if SPH_DIM == 3
sph_status sph_add_wall_plane(sph_sim *sim, const sph_wall *wall, const double *origin, const double *e1,
                              const double *e2, uint32_t *group)
{
    sph_status st = sph_layers_check(sim, wall, "sph_add_wall_plane");
    if (st)
        return st;
    if (!origin || !e1 || !e2)
        return sph_setup_bad(sim, "origin, e1, e2", "three vectors", 0);
    if ((st = sph_setup_check_vector(sim, "origin", origin)) != SPH_OK)
        return st;
    double d[2][3], len[2] = {0, 0}, normal[3], nn = 0;
    for (int k = 0; k < 3; k++) {
        len[0] += e1[k] * e1[k];
        len[1] += e2[k] * e2[k];
    }
    len[0] = __builtin_sqrt(len[0]);
    len[1] = __builtin_sqrt(len[1]);
    if (!(len[0] > 0.5 * sim->cfg.spacing && len[1] > 0.5 * sim->cfg.spacing && len[0] < 1e15 && len[1] < 1e15))
        return sph_setup_bad(sim, "e1, e2", "at least half a spacing long, and finite", len[0]);
    for (int k = 0; k < 3; k++) {
        d[0][k] = e1[k] / len[0];
        d[1][k] = e2[k] / len[1];
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        normal[k] = d[0][a] * d[1][b] - d[0][b] * d[1][a];
        nn += normal[k] * normal[k];
    }
    if (!(nn > 0.999))
        return sph_setup_bad(sim, "e2", "at right angles to e1", nn);
    return flat_wall(sim, wall, origin, normal, (const double(*)[3])d, len, group);
}
#endif

#endif

#if SPH_HAS_GROUPS
sph_status sph_remove_wall_at(sph_sim *sim, uint32_t group, double t)
{
    sph_status st = sim ? sph_setup_idle(sim, "sph_remove_wall") : SPH_BAD_ARGUMENT;
    if (st)
        return st;
    if (group >= sim->groups)
        return sph_setup_bad(sim, "group", "a number given by a wall function", group);
    if (!(t == t))
        return sph_setup_bad(sim, "t", "a time", t);
    sim->now.group[group].remove_at = t;
    if (t <= sim->now.time)
        sim->now.primed = false; /* forces must be made anew without the wall */
    return SPH_OK;
}
sph_status sph_remove_wall(sph_sim *sim, uint32_t group)
{
    return sph_remove_wall_at(sim, group, sim ? sim->now.time : 0);
}

void sph_motion_table(void *ctx, double t, double *displacement, double *velocity)
{
    const sph_table *m = ctx;
    uint32_t i = 0;
    double x, v = 0;
    for (int k = 0; k < SPH_DIM; k++)
        displacement[k] = velocity[k] = 0;
    if (!m || !m->rows || !m->t || !m->x || m->axis >= SPH_DIM)
        return;
    while (i + 1 < m->rows && m->t[i + 1] <= t)
        i++;
    if (t < m->t[0]) {
        x = m->x[0];
    } else if (i + 1 >= m->rows) {
        x = m->x[m->rows - 1];
    } else {
        v = (m->x[i + 1] - m->x[i]) / (m->t[i + 1] - m->t[i]);
        x = m->x[i] + v * (t - m->t[i]);
    }
    displacement[m->axis] = x - m->x[0];
    velocity[m->axis] = v;
}

void sph_motion_steady(void *ctx, double t, double *displacement, double *velocity)
{
    const sph_steady *m = ctx;
    for (int k = 0; k < SPH_DIM; k++) {
        displacement[k] = m ? t * (m->v[k] + 0.5 * m->a[k] * t) : 0;
        velocity[k] = m ? m->v[k] + m->a[k] * t : 0;
    }
}
#endif
