/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* outline.c: where the edges are that waves leave through: layers of boundary particles and their normals (Powell 2012
   eqs 2.50-2.53, algorithms 2.1, 2.2), lines of particles that go in from the edge, their weights, depths in a matched
   layer. What becomes of them: edges.c.

   Layers: e_i = sum V_j grad W_ij over solids of one body that are in no layer yet, images behind the domain's faces
   included. Round by round those with |e| > C max |e| of the first round are the next layer, n = -e/|e|. (2.51 prints
   no V; the exclusion 2.53 keeps in truth what it says it excludes.) At most floor(support/dx) + 1 rounds, or
   edge_layers.
   C = 0.75: an edge of a half-space is shown with 1, a corner of a square with 0.8 to 0.9, the second layer with 0.5 or
   less; 3-D: 0.6, because a corner of a cube is shown with about 0.65.

   Work: particles x neighbours x rounds, at once. The list of a cell's particles: in `cell` and `edge_place`. */
#include "dmath.h"
#include "kernels.h"
#include "marks.h"
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(outline)

#if SPH_HAS_EDGES
#define NOBODY 0xffffffffu
#define LEAST (SPH_DIM == 3 ? 0.6 : 0.75)

/* ---- neighbours ---- */

static bool is_solid(const sph_sim *sim, uint32_t i) { return sph_is_solid(&sim->set[sim->buf[sim->cur].set[0][i]]); }
static double place(const sph_sim *sim, uint32_t i, uint32_t k) /* m, from the domain's low corner */
{
    return (double)sim->buf[sim->cur].pos[k][i] * sim->grid.quantum;
}

static void list_cells(sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t c = 0; c < sim->grid.cells; c++)
        sim->cell[c] = NOBODY;
    for (uint32_t i = sim->now.count; i-- > 0;) {
        sph_pos q[SPH_DIM];
        for (uint32_t k = 0; k < SPH_DIM; k++)
            q[k] = b->pos[k][i];
        const uint32_t c = sph_cell_of(sim, q);
        sim->edge_place[i] = sim->cell[c];
        sim->cell[c] = i;
    }
    sim->table_valid = false;
}

/* calls fn for every solid particle in the cells around a place; d: from the particle to the place, the shorter way
   round a periodic domain */
typedef void visit(const sph_sim *sim, void *ctx, uint32_t j, const double *d);
static void around(const sph_sim *sim, const double *x, visit *fn, void *ctx)
{
    int64_t at[SPH_DIM];
    uint32_t all = 1;
    for (uint32_t k = 0; k < SPH_DIM; k++, all *= 3) {
        const double most = (double)(sim->grid.extent[k] - 1), q = x[k] / sim->grid.quantum;
        at[k] = sph_cell_axis(sim, k, (sph_pos)(q < 0 ? 0 : q > most ? most : q));
    }
    for (uint32_t n = 0; n < all; n++) {
        uint32_t c = 0, step = 1, rest = n;
        bool outside = false;
        for (uint32_t k = 0; k < SPH_DIM; k++, rest /= 3) {
            int64_t to = at[k] + (int64_t)(rest % 3) - 1;
            const int64_t cells = sim->grid.ncell[k];
            if (SPH_IS(sim->cfg.face[k][0], PERIODIC))
                to = (to + cells) % cells;
            outside |= to < 0 || to >= cells;
            c += step * (uint32_t)to;
            step *= sim->grid.ncell[k];
        }
        for (uint32_t j = outside ? NOBODY : sim->cell[c]; j != NOBODY; j = sim->edge_place[j]) {
            double d[SPH_DIM];
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                const double whole = sim->grid.length[k];
                d[k] = x[k] - place(sim, j, k);
                if (SPH_IS(sim->cfg.face[k][0], PERIODIC))
                    d[k] = d[k] > whole / 2 ? d[k] - whole : d[k] < -whole / 2 ? d[k] + whole : d[k];
            }
            if (is_solid(sim, j))
                fn(sim, ctx, j, d);
        }
    }
}
static double length_of(const double *d)
{
    double sum = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        sum += d[k] * d[k];
    return __builtin_sqrt(sum);
}

/* ---- layers ---- */

typedef struct slope_sum {
    uint32_t body;
    double e[SPH_DIM];
} slope_sum;
static void add_slope(const sph_sim *sim, void *ctx, uint32_t j, const double *d)
{
    slope_sum *s = ctx;
    const sph_set *set = &sim->set[sim->buf[sim->cur].set[0][j]];
    const double r = length_of(d);
    double w, dw;
    if (sim->edge_mark[j].level || sph_material_of(sim, set)->body != s->body || !(r > 0) ||
        !(r < sim->grid.support) || sph_kernel_value(sim->cfg.kernel, r, sim->cfg.smoothing_length, &w, &dw))
        return;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        s->e[k] += set->mass / set->rho0 * dw * d[k] / r;
}

static bool is_mirror(uint32_t face) { return SPH_IS(face, SYMMETRY) || SPH_IS(face, MIRROR_NO_SLIP); }

/* e of a particle: with it stand its neighbours' images, each of which shows it the neighbours from its own image */
static void slope_at(const sph_sim *sim, uint32_t i, double *e)
{
    const sph_set *set = &sim->set[sim->buf[sim->cur].set[0][i]];
    uint32_t all = 1;
    for (uint32_t k = 0; k < SPH_DIM; k++, all *= 3)
        e[k] = 0;
    for (uint32_t n = 0; n < all; n++) {
        double x[SPH_DIM], sign[SPH_DIM];
        uint32_t rest = n;
        bool there = true;
        for (uint32_t k = 0; k < SPH_DIM; k++, rest /= 3) {
            const uint32_t side = rest % 3;
            const double from = place(sim, i, k), whole = sim->grid.length[k];
            sign[k] = side ? -1 : 1;
            x[k] = side == 0 ? from : side == 1 ? -from : 2 * whole - from;
            there &= side == 0 || (is_mirror(sim->cfg.face[k][side - 1]) &&
                                   (side == 1 ? from : whole - from) < sim->grid.support);
        }
        slope_sum s = {sph_material_of(sim, set)->body, {0}};
        if (there)
            around(sim, x, add_slope, &s);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            e[k] += sign[k] * s.e[k];
    }
}

static uint32_t layers_wanted(const sph_sim *sim)
{
    const uint32_t full = (uint32_t)(sim->grid.support / sim->cfg.spacing * 1.000001) + 1;
    return sim->cfg.edge_layers ? sim->cfg.edge_layers : full < 64 ? full : 64;
}

/* Rounds of algorithm 2.2: e is kept as the normal till its particle is found. Round `round` gives `round` as level. */
static void peel(sph_sim *sim)
{
    double most = 0;
    for (uint32_t round = 1; round <= layers_wanted(sim); round++) {
        double e[SPH_DIM];
        for (uint32_t i = 0; i < sim->now.count; i++) {
            sph_edge_mark *m = &sim->edge_mark[i];
            if (!is_solid(sim, i) || m->level)
                continue;
            slope_at(sim, i, e);
            const double size = length_of(e);
            most = round == 1 && size > most ? size : most;
            m->cosine = (sph_real)(size * sim->cfg.spacing);
            for (uint32_t k = 0; k < SPH_DIM; k++)
                m->normal[k] = (sph_real)(size > 0 ? -e[k] / size : 0);
        }
        const sph_real least = (sph_real)(LEAST * most * sim->cfg.spacing);
        for (uint32_t i = 0; i < sim->now.count; i++)
            if (is_solid(sim, i) && !sim->edge_mark[i].level && most > 0 && sim->edge_mark[i].cosine > least)
                sim->edge_mark[i].level = (uint8_t)round;
    }
}

/* ---- edges along axes ---- */

/* the box around all solids (m, from the domain's low corner), half a spacing outside the outermost */
static void domain_of(const sph_sim *sim, double (*box)[2])
{
    const double half = 0.5 * sim->cfg.spacing;
    bool any = false;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (!is_solid(sim, i))
            continue;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const double x = place(sim, i, k);
            box[k][0] = !any || x - half < box[k][0] ? x - half : box[k][0];
            box[k][1] = !any || x + half > box[k][1] ? x + half : box[k][1];
        }
        any = true;
    }
}
static double depth(const sph_sim *sim, double (*box)[2], uint32_t i, uint32_t k, uint32_t side)
{
    const double x = place(sim, i, k);
    return side ? box[k][1] - x : x - box[k][0];
}

/* level, normal and damping of a particle by its depths below the edges */
static void mark_by_depth(sph_sim *sim, double (*box)[2], uint32_t faces, uint32_t i)
{
    sph_edge_mark *m = &sim->edge_mark[i];
    const double dx = sim->cfg.spacing, width = sim->cfg.edge_width, layers = layers_wanted(sim);
    double cp, cs, n[SPH_DIM], nearest = layers;
    sph_edge_speeds(sim, &sim->set[sim->buf[sim->cur].set[0][i]], &cp, &cs);
    const double most = width > 0 ? -1.5 * cp * sph_log(sim->cfg.edge_reflection) / width : 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        n[k] = 0;
        for (uint32_t side = 0; side < 2; side++) {
            if (!(faces & (side ? SPH_HIGH(k) : SPH_LOW(k))))
                continue;
            const double d = depth(sim, box, i, k, side), layer = d / dx, xi = width > 0 ? 1 - d / width : 0;
            if (layer < layers)
                n[k] = side ? 1 : -1;
            nearest = layer < nearest ? layer : nearest;
            if (xi > 0)
                m->damp[k] = (sph_real)(most * xi * xi);
        }
    }
    const double size = length_of(n);
    m->level = nearest < layers ? (uint8_t)(nearest + 1) : 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        m->normal[k] = (sph_real)(size > 0 ? n[k] / size : 0);
}

/* ---- weights of a line ---- */

/* sum of V (dW/dr)/r x over a plane of a lattice at distance x, spacing 1 */
static double plane_sum(const sph_sim *sim, double x)
{
    const double h = sim->cfg.smoothing_length / sim->cfg.spacing;
    const int reach = (int)(sph_kernel_support(sim->cfg.kernel) * h) + 1, side = 2 * reach + 1;
    const int all = SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? side : side * side;
    double sum = 0, w, dw;
    for (int n = 0; n < all; n++) {
        const double y = SPH_DIM > 1 ? n % side - reach : 0, z = SPH_DIM > 2 ? n / side - reach : 0;
        const double r = __builtin_sqrt(x * x + y * y + z * z);
        if (r > 0 && sph_kernel_value(sim->cfg.kernel, r, h, &w, &dw) == SPH_OK)
            sum += dw * x / r;
    }
    return sum;
}

/* A_k of edges.c, of a half-space of lattice: how a uniform stress pushes its planes */
static void weigh_lines(sph_sim *sim)
{
    enum { PLANES = 40 };
    double inverse[PLANES], push[SPH_EDGE_LINE];
    for (int n = 0; n < PLANES; n++) {
        double moment = 0;
        for (int m = 0; m < PLANES; m++)
            moment -= plane_sum(sim, n - m) * (n - m);
        inverse[n] = sph_corrects(&sim->cfg) && moment > 0 ? 1 / moment : 1;
    }
    for (uint32_t n = 0; n < SPH_EDGE_LINE; n++) {
        push[n] = 0;
        for (int m = 0; m < PLANES - 10; m++)
            push[n] -= (inverse[n] + inverse[m]) * plane_sum(sim, (int)n - m);
    }
    for (uint32_t count = 1; count <= SPH_EDGE_LINE; count++) {
        double sum = 0;
        for (uint32_t n = 0; n < count; n++)
            sum += push[n];
        for (uint32_t n = 0; n < count; n++)
            sim->edge_weight[count - 1][n] = push[n] / sum;
    }
}

/* ---- lines ---- */

typedef struct nearest_one {
    double r;
    uint32_t j, axis;
} nearest_one;
static void look_nearer(const sph_sim *sim, void *ctx, uint32_t j, const double *d)
{
    nearest_one *n = ctx;
    const double r = length_of(d);
    if (r < n->r && sim->edge_mark[j].claimed != n->axis + 1) {
        n->r = r;
        n->j = j;
    }
}

/* a line from particle i inward against n; false where there is no room for it */
static bool add_line(sph_sim *sim, uint32_t axis, uint32_t i, const double *n)
{
    if (sim->edge_mark[i].claimed == axis + 1) /* it is of another line */
        return true;
    if (sim->edge_from[axis + 1] >= sim->cfg.max_particles)
        return false;
    sph_edge_line *l = &sim->edge_line[sim->edge_from[axis + 1]++];
    l->count = 0;
    for (uint32_t j = i; j != NOBODY && l->count < SPH_EDGE_LINE;) {
        double x[SPH_DIM];
        nearest_one next = {0.55 * sim->cfg.spacing, NOBODY, axis};
        sim->edge_mark[j].claimed = (uint8_t)(axis + 1);
        l->id[l->count++] = j;
        for (uint32_t k = 0; k < SPH_DIM; k++)
            x[k] = place(sim, i, k) - (double)l->count * sim->cfg.spacing * n[k];
        around(sim, x, look_nearer, &next);
        j = next.j;
    }
    for (uint32_t k = 0; k < SPH_DIM; k++)
        l->normal[k] = (sph_real)n[k];
    return true;
}

/* lines along one axis: from the edges along it, or from where the normal is nearest to it */
static bool add_lines(sph_sim *sim, const sph_edges *e, double (*box)[2], uint32_t axis)
{
    bool room = true;
    sim->edge_from[axis + 1] = sim->edge_from[axis];
    for (uint32_t i = 0; i < sim->now.count && room; i++) {
        const sph_edge_mark *m = &sim->edge_mark[i];
        double n[SPH_DIM] = {0};
        uint32_t main = 0;
        if (!is_solid(sim, i) || m->level != 1)
            continue;
        for (uint32_t side = 0; side < 2 && e->faces && !e->given; side++)
            if (e->faces & (side ? SPH_HIGH(axis) : SPH_LOW(axis)) &&
                depth(sim, box, i, axis, side) < sim->cfg.spacing) {
                n[axis] = side ? 1 : -1;
                room &= add_line(sim, axis, i, n);
            }
        if (e->faces && !e->given)
            continue;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            n[k] = (double)m->normal[k];
            main = sph_abs(n[k]) > sph_abs(n[main]) * 1.000001 ? k : main;
        }
        if (main == axis)
            room &= add_line(sim, axis, i, n);
    }
    return room;
}

/* the stress that stands, and what holds it at the end of a line */
static void keep_stress(sph_sim *sim)
{
    static const uint8_t at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    double stress[6];
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (!is_solid(sim, i))
            continue;
        sph_stress_of(sim, &sim->buf[sim->cur], i, stress);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            for (uint32_t l = k; l < SPH_DIM; l++)
                sim->edge_mark[i].stress[sph_sym[k][l]] = (sph_real)stress[at[k][l]];
    }
    for (uint32_t n = 0; n < sim->edge_from[SPH_DIM]; n++) {
        const sph_edge_line *l = &sim->edge_line[n];
        const sph_set *set = &sim->set[sim->buf[sim->cur].set[0][l->id[0]]];
        const double *weight = sim->edge_weight[l->count - 1];
        const double rho = set->rho0 * (1 + (double)sim->buf[sim->cur].rho[0][l->id[0]]);
        sph_stress_of(sim, &sim->buf[sim->cur], l->id[0], stress);
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            double push = 0;
            for (uint32_t c = 0; c < SPH_DIM; c++)
                push += stress[at[k][c]] * (double)l->normal[c] / (rho * sim->cfg.spacing);
            for (uint32_t m = 0; m < l->count; m++)
                sim->edge_mark[l->id[m]].push[k] += (sph_real)(weight[m] * push);
        }
    }
}

/* H: cosine of the angle between the normal and the line from the source, not below 0.1 */
static void face_source(sph_sim *sim, const sph_edges *e)
{
    for (uint32_t i = 0; i < sim->now.count; i++) {
        double d[SPH_DIM], along = 0;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            d[k] = place(sim, i, k) + sim->cfg.lo[k] - e->source[k];
            along += d[k] * (double)sim->edge_mark[i].normal[k];
        }
        const double r = length_of(d), cosine = r > 0 ? along / r : 1;
        sim->edge_mark[i].cosine = (sph_real)(cosine > 0.1 ? cosine : 0.1);
    }
}

/* ---- entries ---- */

static sph_status check_find(sph_sim *sim, const sph_edges *e)
{
    if (!sph_has_edges(&sim->cfg))
        return sph_setup_bad(sim, "edge", "a configuration with edges", sim->cfg.edge);
    if (e->faces >> 2 * SPH_DIM)
        return sph_setup_bad(sim, "faces", "an or of SPH_LOW(axis), SPH_HIGH(axis)", e->faces);
    if (!e->faces && sph_is_matched(&sim->cfg))
        return sph_setup_bad(sim, "faces", "not 0 with edge_width > 0", e->faces);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (e->faces & (SPH_LOW(k) | SPH_HIGH(k)) && SPH_IS(sim->cfg.face[k][0], PERIODIC))
            return sph_setup_bad(sim, "faces", "none along a periodic axis", e->faces);
    sph_status st = sph_setup_check_vector(sim, "velocity", e->velocity);
    return st ? st : sph_setup_check_vector(sim, "source", e->source);
}

sph_status sph_find_edges(sph_sim *sim, const sph_edges *edges)
{
    const sph_edges none = {0}, *e = edges ? edges : &none;
    double box[SPH_DIM][2] = {{0}};
    bool room = true;
    sph_status st = sph_setup_begin_adding(sim, "sph_find_edges");
    if (st || (st = check_find(sim, e)) != SPH_OK)
        return st;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        sph_edge_mark *m = &sim->edge_mark[i], was = *m;
        *m = (sph_edge_mark){.level = e->given ? was.level : 0};
        memcpy(m->normal, was.normal, sizeof m->normal);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            m->velocity[k] = e->as_now ? sim->buf[sim->cur].vel[k][i] : (sph_real)e->velocity[k];
    }
    list_cells(sim);
    domain_of(sim, box);
    for (uint32_t i = 0; i < sim->now.count && e->faces && !e->given; i++)
        if (is_solid(sim, i))
            mark_by_depth(sim, box, e->faces, i);
    if (!e->faces && !e->given)
        peel(sim);
    face_source(sim, e);
    weigh_lines(sim);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        room &= add_lines(sim, e, box, k);
    if (!room)
        return sph_setup_bad(sim, "max_particles", "room for the lines of edges", sim->cfg.max_particles);
    keep_stress(sim);
    /* what P, M, H leave free is held, too; the viscous traction is on the outermost alone */
    for (uint32_t n = 0; n < sim->edge_from[SPH_DIM] && sim->cfg.edge == SPH_EDGE_VISCOUS; n++)
        sim->edge_line[n].count = 1;
    for (uint32_t k = 0; k < SPH_DIM && sph_replaces(&sim->cfg); k++)
        sim->edge_from[k + 1] = 0;
    uint64_t h = sph_mix(sim->setup_hash, (uint64_t)e->faces | (uint64_t)e->given << 8 | (uint64_t)e->as_now << 9);
    h = sph_mix(h, sim->edge_from[SPH_DIM]);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        h = sph_mix_double(sph_mix_double(h, e->velocity[k]), e->source[k]);
    sim->setup_hash = h;
    return SPH_OK;
}

sph_status sph_set_edge(sph_sim *sim, uint32_t id, uint32_t level, const double *normal)
{
    sph_status st = sph_setup_begin_adding(sim, "sph_set_edge");
    if (st)
        return st;
    if (!sph_has_edges(&sim->cfg))
        return sph_setup_bad(sim, "edge", "a configuration with edges", sim->cfg.edge);
    if (id >= sim->now.count || !is_solid(sim, id))
        return sph_setup_bad(sim, "id", "of a particle of solid", id);
    if (level > 64)
        return sph_setup_bad(sim, "level", "0 .. 64", level);
    if (!normal)
        return sph_setup_bad(sim, "normal", "a vector", 0);
    if ((st = sph_setup_check_vector(sim, "normal", normal)) != SPH_OK)
        return st;
    const double size = length_of(normal);
    if (level && !(size > 0))
        return sph_setup_bad(sim, "normal", "longer than 0", size);
    sph_edge_mark *m = &sim->edge_mark[id];
    m->level = (uint8_t)level;
    sim->setup_hash = sph_mix(sim->setup_hash, (uint64_t)id | (uint64_t)level << 32);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        m->normal[k] = (sph_real)(size > 0 ? normal[k] / size : 0);
        sim->setup_hash = sph_mix_double(sim->setup_hash, normal[k]);
    }
    return SPH_OK;
}

sph_status sph_get_edge(const sph_sim *sim, uint32_t id, uint32_t *level, double *normal)
{
    if (!sim || !level || !sph_has_edges(&sim->cfg) || id >= sim->cfg.max_particles)
        return SPH_BAD_ARGUMENT;
    *level = sim->edge_mark[id].level;
    for (uint32_t k = 0; normal && k < SPH_DIM; k++)
        normal[k] = (double)sim->edge_mark[id].normal[k];
    return SPH_OK;
}
#endif
