/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sort.c: the start of every stage. Moves the particles of buffer src into buffer dst, ordered by cell and inside a cell
   by id, and fills the table of cell starts: two passes of a counting sort.

   It runs in ranges of slabs (layers of cells along the last axis). A range looks only at particles that were in its
   slabs or next to them, because a particle moves less than a cell in a step, and writes only its own cells: so ranges run
   at once and in any order. (cell, id) is a total order, so neither ranges nor threads show in the result.

   dst.id holds each particle's index in src until the stage's last pass writes the id itself. Costs the table of cells
   (4 bytes each) and of slabs. */
#include "fluid.h"
#include "solid.h"

#define BLOCK SPH_BLOCK
typedef sph_block block;

/* the kick that a stage gives before the sweep: v' = damping (v + kick dt a), rho' = rho + rate dt drho */
typedef struct advance {
    sph_real drift, bend, kick, rate, damping; /* displacement = drift (v + xsph) + bend a */
} advance;

static advance stage_advance(const sph_sim *sim)
{
    const sph_real dt = (sph_real)sim->dt, half = dt * (sph_real)0.5, g = (sph_real)sim->cfg.damping;
    switch (sim->mode) {
    case SPH_ADV_PC: return (advance){dt, dt * half, dt, dt, g};     /* Gray 2.26, 2.27, 2.29 */
    case SPH_ADV_KDK: return (advance){dt, dt * half, half, 0, g};
    case SPH_ADV_LEAP: /* the first step turns v^0 into v^(1/2) */
        return sim->now.started ? (advance){dt, 0, 0, 0, 1} : (advance){dt, dt * half, half, 0, 1};
    case SPH_ADV_RK: return (advance){half, 0, half, half, 1};       /* Wickramarachchi 3.85, and the mean of 3.91 */
    default: return (advance){0, 0, 0, 0, 1};
    }
}

/* not rate/dt: a step of less than a float can tell from 0 is allowed */
sph_real sph_stage_rate(const sph_sim *sim) { return sim->mode == SPH_ADV_PC ? 1 : sim->mode == SPH_ADV_RK ? (sph_real)0.5 : 0; }

/* puts a coordinate that left the domain back by the face's rule: 0 fine, 1 reflected, 2 left */
static int enforce_face(const sph_sim *sim, uint32_t k, sph_pos *q)
{
    const bool high = *q >= sim->grid.extent[k];
    if (*q >= 0 && !high)
        return 0;
    const uint32_t face = sim->cfg.face[k][high];
    if (SPH_IS(face, PERIODIC))
        *q += high ? -sim->grid.extent[k] : sim->grid.extent[k];
    else if (SPH_IS(face, SYMMETRY) || SPH_IS(face, MIRROR_NO_SLIP))
        *q = high ? 2 * sim->grid.extent[k] - 1 - *q : -*q;
    else
        return 2;
    /* a move of a whole domain may end a quantum outside again */
    *q = *q < 0 ? 0 : *q < sim->grid.extent[k] ? *q : sim->grid.extent[k] - 1;
    return SPH_IS(face, PERIODIC) ? 0 : 1;
}

/* the same for a particle; reflections turn the velocity */
int sph_enforce_faces(const sph_sim *sim, sph_pos *q, sph_real *v)
{
    int worst = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        int r = enforce_face(sim, k, &q[k]);
        if (r == 1)
            v[k] = -v[k];
        worst = r > worst ? r : worst;
    }
    return worst;
}

/* displaces fluid particles i..i+n of src; returns false if one moves too far, not finitely, or out of the domain */
static bool move_fluid(const sph_sim *sim, const advance *a, uint32_t i, uint32_t n, block *o, uint32_t at, bool all)
{
    const sph_buffer *b = &sim->buf[sim->src];
    const vreal inv = v_set((sph_real)(1 / sim->grid.quantum)), half = v_set((sph_real)0.5);
    vint bad = v_set_int(0);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        /* no further than a cell, and never so far that the integer overflows */
        const vreal far = v_set((sph_real)sim->grid.cell_size[k]);
        const bool xsph = b->xsph[k] != NULL;
        for (uint32_t j = 0; j < n; j += SPH_W) {
            const vreal v = v_load(b->vel[k] + i + j), f = v_load(b->acc[k] + i + j);
            const vreal u = xsph ? v + v_load(b->xsph[k] + i + j) : v;
            const vreal d = (u * a->drift + f * a->bend) * inv;
            const vint ok = v_less(v_abs(d), far);
            const vreal safe = v_where(ok, d);
            const vint step = v_to_int(safe + v_select(v_less(safe, v_set(0)), -half, half));
            const vint q = v_load_int(b->pos[k] + i + j) + step;
            vint wrong = ~ok | v_less_int(q, v_set_int(0)) | ~v_less_int(q, v_set_int(sim->grid.extent[k]));
            if (j + SPH_W > n) /* lanes behind the run's end may hold anything */
                wrong &= v_less(v_load(sph_lane_numbers), v_set((sph_real)(n - j)));
            bad |= wrong;
            v_store_int(o->pos[k] + at + j, q);
            if (all)
                v_store(o->vel[k] + at + j, (v + f * a->kick) * a->damping);
        }
    }
    if (all)
        for (uint32_t j = 0; j < n; j += SPH_W)
            v_store(o->rho + at + j, v_load(b->rho[0] + i + j) + v_load(b->drho[0] + i + j) * a->rate);
    sph_int lanes[SPH_W], any = 0;
    v_store_int(lanes, bad);
    for (int l = 0; l < SPH_W; l++)
        any |= lanes[l];
    return any == 0;
}

/* how far a wall goes in this step, quanta */
static int64_t wall_step(const sph_sim *sim, const sph_set *s, uint32_t k)
{
    return (int64_t)sph_wall_moved(sim, s, k) - sim->now.group[s->group].moved[k];
}

/* wall particles go where their group goes; their density changes only by continuity */
static bool move_wall(const sph_sim *sim, const advance *a, const sph_set *s, uint32_t i, uint32_t n, block *o, uint32_t at)
{
    const bool removed = sph_wall_removed(sim, s);
    bool fine = !removed;
    const sph_buffer *b = &sim->buf[sim->src];
    /* a Runge-Kutta step has walls at the step's end in both stages: they move in the first, by the copy */
    const bool moves = SPH_WITH_MOVING_WALLS && sim->src == sim->cur;
    for (uint32_t j = 0; j < n; j++) {
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            /* less than a domain's length (sph_move_groups), though the difference alone may not fit into a position */
            o->pos[k][at + j] = (sph_pos)(b->pos[k][i + j] + (moves ? wall_step(sim, s, k) : 0));
            fine &= (o->pos[k][at + j] >= 0) & (o->pos[k][at + j] < sim->grid.extent[k]);
            o->vel[k][at + j] = b->vel[k][i + j];
        }
        o->rho[at + j] = s->compressible ? b->rho[0][i + j] + b->drho[0][i + j] * a->rate : b->rho[0][i + j];
        o->gone[at + j] = removed;
    }
    return fine;
}

#if SPH_HAS_HELD
/* along the axes on which a set is held its particles go where the set goes; returns false where one leaves the domain */
static bool hold(const sph_sim *sim, const sph_set *s, uint32_t i, uint32_t n, block *o, uint32_t at)
{
    const sph_buffer *b = &sim->buf[sim->src];
    const uint32_t held = sph_held(sim, s);
    const bool moves = sim->src == sim->cur; /* as in move_wall */
    bool fine = true;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t j = 0; j < n && held >> k & 1; j++) {
            o->pos[k][at + j] = (sph_pos)(b->pos[k][i + j] + (moves ? wall_step(sim, s, k) : 0));
            o->vel[k][at + j] = (sph_real)sph_wall_velocity(sim, s, k);
            fine &= (o->pos[k][at + j] >= 0) & (o->pos[k][at + j] < sim->grid.extent[k]);
        }
    return fine;
}
#endif

static sph_status face_failure(sph_status s, uint32_t id, sph_thread *t, double value)
{
    sph_fail_note(t, s, id, value);
    return s;
}

/* the slow half of advance_block: applies the rules of the domain's faces, one particle after the other */
static void mend_block(const sph_sim *sim, const advance *a, uint32_t i, uint32_t n, block *o, bool all, uint32_t own_from,
                       uint32_t own_to, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->src];
    for (uint32_t j = 0; j < n; j++) {
        const bool own = i + j >= own_from && i + j < own_to;
        sph_pos q[SPH_DIM];
        sph_real v[SPH_DIM];
        sph_real far = 0; /* the longest way, in cells */
        if (o->gone[j])
            continue;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            q[k] = o->pos[k][j]; // NOLINT(clang-analyzer-core.uninitialized.Assign): n > 0, filled by advance_block
            v[k] = all ? o->vel[k][j] : 0; /* the count does not ask for velocities */
            const sph_real u = b->vel[k][i + j] * a->drift / (sph_real)(sim->grid.length[k] / sim->grid.ncell[k]);
            const sph_real way = u < 0 ? -u : u;
            far = !(way <= far) ? way : far;
        }
        if (own && !(far < 1) && sph_is_body(&sim->set[b->set[0][i + j]]))
            face_failure(far - far == 0 ? SPH_MOVED_TOO_FAR : SPH_NOT_FINITE, b->id[0][i + j], t, (double)far);
        int r = sph_enforce_faces(sim, q, v);
        if (r == 2) {
            o->gone[j] = 2;
            if (own && (sim->cfg.on_leave == SPH_FAIL || !sph_is_body(&sim->set[b->set[0][i + j]])))
                face_failure(SPH_OUT_OF_DOMAIN, b->id[0][i + j], t, (double)q[0] * sim->grid.quantum);
            if (own && !all)
                t->left++;
            continue;
        }
        t->reflected += own && !all && r == 1 && sim->mode != SPH_ADV_RK; /* half time: the whole step counts */
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            o->pos[k][j] = q[k];
            if (all)
                o->vel[k][j] = v[k];
        }
    }
}

/* The block of src from i on: new positions inside the domain, and who is gone. Returns true if nobody is gone and nothing
   is wrong. Failures and losses are noted for the particles own_from..own_to: exactly one range owns a particle. */
static bool advance_block(const sph_sim *sim, const advance *a, uint32_t i, uint32_t n, block *o, bool all,
                          uint32_t own_from, uint32_t own_to, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->src];
    bool fine = true;
    for (uint32_t j = 0; j < n;) {
        const uint8_t set = b->set[0][i + j];
        const uint32_t e = sph_run_end(b->set[0], i + j, i + n) - i;
        memset(o->gone + j, set == SPH_DEAD, e - j);
        if (set == SPH_DEAD)
            fine = false;
        else if (sph_is_body(&sim->set[set])) {
            fine &= move_fluid(sim, a, i + j, e - j, o, j, all);
#if SPH_HAS_HELD
            if (sph_held(sim, &sim->set[set]))
                fine &= hold(sim, &sim->set[set], i + j, e - j, o, j);
#endif
        }
        else if (SPH_HAS_WALLS)
            fine &= move_wall(sim, a, &sim->set[set], i + j, e - j, o, j);
        j = e;
    }
    if (!fine)
        mend_block(sim, a, i, n, o, all, own_from, own_to, t);
    return fine;
}

/* ---- ranges ---- */

typedef struct range {
    uint32_t lo, hi;         /* slabs */
    uint32_t from[3], to[3]; /* pieces of src to look at, in order of index */
    uint32_t pieces;
    uint32_t own_from, own_to;
} range;

static range make_range(const sph_sim *sim, uint32_t r)
{
    range g;
    g.lo = (uint32_t)((uint64_t)sim->grid.slabs * r / sim->ranges);
    g.hi = (uint32_t)((uint64_t)sim->grid.slabs * (r + 1) / sim->ranges);
    g.pieces = 1;
    if (!sim->src_table) {
        g.from[0] = g.own_from = 0;
        g.to[0] = g.own_to = sim->src_count;
        return g;
    }
    g.own_from = sim->slab[g.lo];
    g.own_to = sim->slab[g.hi];
    g.from[0] = sim->slab[g.lo > 0 ? g.lo - 1 : 0];
    g.to[0] = sim->slab[g.hi < sim->grid.slabs ? g.hi + 1 : sim->grid.slabs];
    if (sim->ranges > 1 && SPH_IS(sim->cfg.face[SPH_DIM - 1][0], PERIODIC)) {
        if (g.lo == 0) { /* the last slab is a neighbour too */
            g.from[g.pieces] = sim->slab[sim->grid.slabs - 1];
            g.to[g.pieces++] = sim->slab[sim->grid.slabs];
        } else if (g.hi == sim->grid.slabs) {
            g.from[1] = g.from[0];
            g.to[1] = g.to[0];
            g.from[0] = 0;
            g.to[0] = sim->slab[1];
            g.pieces = 2;
        }
    }
    return g;
}

/* a particle may go to its own slab or one next to it */
static bool slab_too_far(const sph_sim *sim, uint32_t from, uint32_t to)
{
    uint32_t d = from > to ? from - to : to - from;
    return d > 1 && !(SPH_IS(sim->cfg.face[SPH_DIM - 1][0], PERIODIC) && d == sim->grid.slabs - 1);
}

/* where the count leaves each particle's cell for the scatter: in dst.acc, which is free until the forces */
SPH_INLINE void keep_cell(const sph_sim *sim, uint32_t i, uint32_t cell)
{
    memcpy((unsigned char *)sim->buf[sim->dst].acc[0] + 4 * (size_t)i, &cell, sizeof cell);
}
SPH_INLINE uint32_t kept_cell(const sph_sim *sim, uint32_t i)
{
    uint32_t cell;
    memcpy(&cell, (const unsigned char *)sim->buf[sim->dst].acc[0] + 4 * (size_t)i, sizeof cell);
    return cell;
}

#define NO_CELL 0xffffffffu

/* cells of a block; NO_CELL for who is gone. The range that owns a particle also checks its way and keeps its cell. */
static void block_cells(sph_sim *sim, const range *g, uint32_t i, uint32_t n, bool fine, uint32_t *slab, sph_thread *t)
{
    const block *o = &t->block;
    uint32_t *const cell = t->block.to;
    for (uint32_t j = 0; j < n; j++) {
        sph_pos q[SPH_DIM];
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            q[k] = o->pos[k][j];
        cell[j] = sph_cell_of(sim, q);
    }
    for (uint32_t j = 0; !fine && j < n; j++)
        if (o->gone[j])
            cell[j] = NO_CELL;
    const uint32_t from = i > g->own_from ? i : g->own_from, to = i + n < g->own_to ? i + n : g->own_to;
    for (uint32_t p = from; p < to; p++) {
        const uint32_t c = cell[p - i];
        keep_cell(sim, p, c);
        if (!sim->src_table || c == NO_CELL)
            continue;
        while (*slab + 1 < g->hi && sim->slab[*slab + 1] <= p)
            ++*slab;
        /* unsigned: cells of the slab itself and its two neighbours */
        const uint32_t low = *slab * sim->grid.slab_cells - sim->grid.slab_cells;
        if (c - low >= 3 * sim->grid.slab_cells && slab_too_far(sim, *slab, c / sim->grid.slab_cells))
            sph_fail_note(t, SPH_MOVED_TOO_FAR, sim->buf[sim->src].id[0][p], 2);
    }
}

static void count_range(sph_sim *sim, uint32_t r, sph_thread *t)
{
    const advance a = stage_advance(sim);
    const range g = make_range(sim, r);
    const uint32_t c0 = g.lo * sim->grid.slab_cells, c1 = g.hi * sim->grid.slab_cells;
    uint32_t total = 0, slab = g.lo;
    uint32_t *const count = sim->cell + 1, *const cell = t->block.to;
    memset(count + c0, 0, (size_t)(c1 - c0) * sizeof *count);
    for (uint32_t p = 0; p < g.pieces; p++)
        for (uint32_t i = g.from[p]; i < g.to[p]; i += BLOCK) {
            const uint32_t n = g.to[p] - i < BLOCK ? g.to[p] - i : BLOCK;
            const bool fine = advance_block(sim, &a, i, n, &t->block, false, g.own_from, g.own_to, t);
            block_cells(sim, &g, i, n, fine, &slab, t);
            for (uint32_t j = 0; j < n; j++)
                if (cell[j] - c0 < c1 - c0) {
                    count[cell[j]]++;
                    total++;
                }
            t->work += n;
        }
    t->work += c1 - c0;
    sim->range_count[r] = total;
}

static void swap_particles(const sph_buffer *b, uint32_t i, uint32_t j)
{
#define SPH_SWAP(type, array)                                                                               \
    {                                                                                                       \
        type keep = (array)[i];                                                                             \
        (array)[i] = (array)[j];                                                                            \
        (array)[j] = keep;                                                                                  \
    }
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        SPH_SWAP(sph_pos, b->pos[k])
        SPH_SWAP(sph_real, b->vel[k])
    }
    SPH_SWAP(sph_real, b->rho[0])
    SPH_SWAP(uint32_t, b->id[0])
    SPH_SWAP(uint8_t, b->set[0])
#undef SPH_SWAP
}

/* insertion sort by id of the particles of one cell; they are nearly in order already */
static void order_cell(const sph_sim *sim, uint32_t s, uint32_t e)
{
    const uint32_t *id = sim->buf[sim->src].id[0], *from = sim->buf[sim->dst].id[0];
    for (uint32_t i = s + 1; i < e; i++)
        for (uint32_t j = i; j > s && id[from[j]] < id[from[j - 1]]; j--)
            swap_particles(&sim->buf[sim->dst], j, j - 1);
}

/* n particles of a block, from number j on, to the places at, at + 1, ... of dst */
static void put_run(const sph_buffer *b, const block *o, const uint8_t *set, uint32_t i, uint32_t j, uint32_t n, uint32_t at)
{
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        memcpy(b->pos[k] + at, o->pos[k] + j, n * sizeof(sph_pos));
        memcpy(b->vel[k] + at, o->vel[k] + j, n * sizeof(sph_real));
    }
    memcpy(b->rho[0] + at, o->rho + j, n * sizeof(sph_real));
    memcpy(b->set[0] + at, set + j, n);
    for (uint32_t l = 0; l < n; l++)
        b->id[0][at + l] = i + j + l;
}

static void scatter_range(sph_sim *sim, uint32_t r, sph_thread *t)
{
    const advance a = stage_advance(sim);
    const range g = make_range(sim, r);
    const uint32_t c0 = g.lo * sim->grid.slab_cells, c1 = g.hi * sim->grid.slab_cells;
    const sph_buffer *b = &sim->buf[sim->dst];
    uint32_t *const cell = sim->cell, run = sim->range_count[r];
    const uint8_t *set = sim->buf[sim->src].set[0];
    uint32_t first = run, *const at = t->block.to;
    for (uint32_t c = c0; c < c1; c++) { /* counts become starts; filling turns them into the next cell's start */
        uint32_t n = cell[c + 1];
        cell[c + 1] = first;
        first += n;
    }
    for (uint32_t p = 0; p < g.pieces; p++)
        for (uint32_t i = g.from[p]; i < g.to[p]; i += BLOCK) {
            const uint32_t n = g.to[p] - i < BLOCK ? g.to[p] - i : BLOCK;
            uint32_t mine = 0;
            for (uint32_t j = 0; j < n; j++) {
                const uint32_t c = kept_cell(sim, i + j);
                at[j] = c - c0 < c1 - c0 ? cell[c + 1]++ : NO_CELL;
                mine += at[j] != NO_CELL;
            }
            t->work += n;
            if (mine == 0)
                continue;
            advance_block(sim, &a, i, n, &t->block, true, 0, 0, t);
            for (uint32_t j = 0; j < n;) { /* runs of particles that stay next to each other are copied as one */
                uint32_t e = j + 1;
                /* NO_CELL + 1 is 0, which is a place: who stays behind ends a run and begins none */
                while (e < n && at[j] != NO_CELL && at[e] == at[e - 1] + 1)
                    e++;
                if (at[j] != NO_CELL)
                    put_run(b, &t->block, set + i, i, j, e - j, at[j]);
                j = e;
            }
        }
    uint32_t start = run, widest = 0;
    for (uint32_t c = c0; c < c1; c++) {
        uint32_t end = cell[c + 1];
        widest = end - start > widest ? end - start : widest;
        order_cell(sim, start, end);
        start = end;
    }
    t->work += c1 - c0;
    t->widest = widest > t->widest ? widest : t->widest;
}

static uint32_t range_chunks(const sph_sim *sim) { return sim->ranges; }

/* range totals become range starts */
static sph_status count_end(sph_sim *sim)
{
    uint32_t sum = 0;
    for (uint32_t r = 0; r < sim->ranges; r++) {
        uint32_t n = sim->range_count[r];
        sim->range_count[r] = sum;
        sum += n;
    }
    sim->cell[0] = 0;
    sim->next.count = sum;
    return SPH_OK;
}

const sph_pass sph_pass_count = {"count", range_chunks, count_range, count_end, NULL};
const sph_pass sph_pass_scatter = {"scatter", range_chunks, scatter_range, NULL, NULL};

/* Prepares a stage that moves src to dst: saves the slabs of src and chooses the ranges. */
void sph_begin_sort(sph_sim *sim, uint32_t src, uint32_t dst, uint32_t count, bool table, uint32_t mode)
{
    sim->src = src;
    sim->dst = dst;
    sim->src_count = count;
    sim->src_table = table;
    sim->mode = mode;
    sim->ranges = 1;
    if (table) {
        for (uint32_t s = 0; s <= sim->grid.slabs; s++)
            sim->slab[s] = sim->cell[(size_t)s * sim->grid.slab_cells];
        uint32_t r = sim->grid.slabs / (sim->chunk_cells == SPH_SLICE_CHUNK ? 2 : 4);
        sim->ranges = r < 1 ? 1 : r > SPH_MAX_RANGES ? SPH_MAX_RANGES : r;
    }
    sim->table_valid = false; /* from here on cell[] is being rebuilt */
}
