/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sort.c: the start of every stage. Moves the particles of buffer src into buffer dst, ordered by cell and inside a
   cell by id, and fills the table of cell starts: two passes of a counting sort.

   It runs in ranges of slabs (layers of cells along the last axis). A range looks only at particles that were in its
   slabs or next to them, because a particle moves less than a cell in a step, and writes only its own cells: so
   ranges run at once and in any order. (cell, id) is a total order, so neither ranges nor threads show in the result.

   Only those strips of the table are cleared and counted in that a particle is in, and those that an end of a range
   cuts, so that two ranges share it; and only those are filled from which a sweep reads: these and those beside them.
   In all others nothing is right but the starts of slabs, which the next sort reads. In a step that is done in slices
   every strip is counted in and filled: to choose them is one pass without chunks.

   dst.id holds each particle's index in src until the stage's last pass writes the id itself. Costs the table of
   cells (4 bytes each), of strips and of slabs. */
#include "motion.h"
#include "passes.h"
#include "arithmetic.h"

SPH_OBJECT(sort)

/* ---- ranges ---- */

typedef struct range {
    uint32_t lo, hi;         /* slabs */
    uint32_t from[SPH_WITH_FLOW ? 4 : 3], to[SPH_WITH_FLOW ? 4 : 3]; /* pieces of src to look at, in order of index */
    uint32_t pieces;
    uint32_t own_from, own_to, known; /* known: those before it are in the table */
} range;

SPH_INLINE uint32_t first_slab(const sph_sim *sim, uint32_t r)
{
    return (uint32_t)((uint64_t)sim->grid.slabs * r / sim->ranges);
}
static range make_range(const sph_sim *sim, uint32_t r)
{
    range g;
    g.lo = first_slab(sim, r);
    g.hi = first_slab(sim, r + 1);
    g.pieces = 1;
    if (SPH_WITH_FLOW)
        g.known = sim->src_count;
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
    if (SPH_WITH_FLOW)
        g.known = sim->slab[sim->grid.slabs];
    if (SPH_WITH_FLOW && g.known < sim->src_count) { /* newcomers may be anywhere: the last range owns them */
        g.from[g.pieces] = g.known;
        g.to[g.pieces++] = sim->src_count;
        g.own_to = r + 1 == sim->ranges ? sim->src_count : g.own_to;
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
SPH_INLINE void keep_cells(const sph_sim *sim, uint32_t i, const uint32_t *cell, uint32_t n)
{
    memcpy((unsigned char *)sim->buf[sim->dst].acc[0] + 4 * (size_t)i, cell, n * sizeof *cell);
}
SPH_INLINE uint32_t kept_cell(const sph_sim *sim, uint32_t i)
{
    uint32_t cell;
    memcpy(&cell, (const unsigned char *)sim->buf[sim->dst].acc[0] + 4 * (size_t)i, sizeof cell);
    return cell;
}

#define NO_CELL 0xffffffffu

/* notes which of the particles p .. e - 1, all of one slab, went further than to the next */
static void check_ways(const sph_sim *sim, uint32_t slab, uint32_t p, uint32_t e, const uint32_t *cell, sph_thread *t)
{
    const uint32_t cells = sim->grid.slab_cells, low = slab * cells - cells;
    for (uint32_t j = 0; j < e - p; j++) /* unsigned: cells of the slab itself and its two neighbours */
        if (cell[j] != NO_CELL && cell[j] - low >= 3 * cells && slab_too_far(sim, slab, cell[j] / cells))
            sph_fail_note(t, SPH_MOVED_TOO_FAR, sim->buf[sim->src].id[0][p + j], 2);
}

/* cells of a block; NO_CELL for who is gone. The range that owns a particle also checks its way and keeps its cell. */
static void block_cells(sph_sim *sim, const range *g, uint32_t i, uint32_t n, bool fine, uint32_t *slab, sph_thread *t)
{
    const sph_block *o = &t->block;
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
    for (uint32_t p = from, e; p < to; p = e) { /* particles of one slab at a time */
        e = SPH_SMALL ? p + 1 : to;
        if (sim->src_table && !(SPH_WITH_FLOW && p >= g->known)) {
            while (*slab + 1 < g->hi && sim->slab[*slab + 1] <= p)
                ++*slab;
            const uint32_t end = *slab + 1 < g->hi ? sim->slab[*slab + 1] : to;
            e = !SPH_SMALL && end < e ? end : e;
            e = SPH_WITH_FLOW && g->known < e ? g->known : e;
            check_ways(sim, *slab, p, e, cell + (p - i), t);
        }
        keep_cells(sim, p, cell + (p - i), e - p);
    }
}

/* ---- counting ---- */

/* whether strips are chosen, or all are filled */
SPH_INLINE bool chooses(const sph_sim *sim) { return SPH_STRIPS && sim->chunk_cells != SPH_SLICE_CHUNK; }

/* counts of the cells c0 .. c1 - 1 of a range at its beginning: of all, or of the strips that its ends cut */
SPH_INLINE void clear_counts(uint32_t *count, uint32_t c0, uint32_t c1, bool all)
{
    const uint32_t e = all ? c1 : sph_strip_end(c0, c1), s = c1 / SPH_STRIP * SPH_STRIP;
    memset(count + c0, 0, (size_t)(e - c0) * sizeof *count);
    if (!all && s > c0)
        memset(count + s, 0, (size_t)(c1 - s) * sizeof *count);
}

/* a particle is in a strip, perhaps the first; those that ends of ranges cut are open; c1: where the range ends */
static void open_strip(sph_sim *sim, uint32_t strip, uint32_t c1)
{
    const uint32_t c = strip * SPH_STRIP;
    if (sim->strip[strip])
        return;
    sim->strip[strip] = SPH_PEOPLED;
    memset(sim->cell + 1 + c, 0, (size_t)(sph_strip_end(c, c1) - c) * sizeof *sim->cell);
}

static void count_range(sph_sim *sim, uint32_t r, sph_thread *t)
{
    const sph_move a = sph_stage_move(sim);
    const range g = make_range(sim, r);
    const uint32_t c0 = g.lo * sim->grid.slab_cells, c1 = g.hi * sim->grid.slab_cells;
    uint32_t total = 0, slab = g.lo, strip = NO_CELL;
    uint32_t *const count = sim->cell + 1, *const cell = t->block.to;
    clear_counts(count, c0, c1, !chooses(sim));
    for (uint32_t p = 0; p < g.pieces; p++)
        for (uint32_t i = g.from[p]; i < g.to[p]; i += SPH_BLOCK) {
            const uint32_t n = g.to[p] - i < SPH_BLOCK ? g.to[p] - i : SPH_BLOCK;
            const bool fine = sph_move_block(sim, &a, i, n, false, g.own_from, g.own_to, t);
            block_cells(sim, &g, i, n, fine, &slab, t);
            for (uint32_t j = 0; j < n; j++)
                if (cell[j] - c0 < c1 - c0) {
                    if (SPH_STRIPS && cell[j] / SPH_STRIP != strip)
                        open_strip(sim, strip = cell[j] / SPH_STRIP, c1);
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
static void put_run(const sph_buffer *b, const sph_block *o, const uint8_t *set, uint32_t i, uint32_t j, uint32_t n,
                    uint32_t at)
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

/* room without particles: eight cells at a time */
SPH_INLINE bool are_eight_zero(const uint32_t *cell)
{
    uint64_t two[4];
    memcpy(two, cell, sizeof two);
    return ((two[0] | two[1]) | (two[2] | two[3])) == 0;
}
SPH_INLINE void set_eight(uint32_t *cell, uint32_t value)
{
    const uint64_t two = value * (uint64_t)0x100000001;
    SPH_UNROLL
    for (uint32_t k = 0; k < 8; k += 2)
        memcpy(cell + k, &two, sizeof two);
}

/* counts of n cells become starts, from `first` on; filling turns them into the next cell's start. Returns the last. */
SPH_INLINE uint32_t starts_of_counts(uint32_t *cell, uint32_t n, uint32_t first)
{
    for (uint32_t c = 0; c < n; c++) {
        for (; !SPH_SMALL && c + 8 < n && are_eight_zero(cell + c); c += 8)
            set_eight(cell + c, first);
        const uint32_t count = cell[c];
        cell[c] = first;
        first += count;
    }
    return first;
}

/* those of a range's cells c0 .. c1 - 1; in strips that are not stored only where slabs begin, and what lies behind */
static void starts_of_range(const sph_sim *sim, uint32_t c0, uint32_t c1, uint32_t first)
{
    uint32_t *const cell = sim->cell, slab = sim->grid.slab_cells, c = c0;
    do {
        const uint32_t s = sph_skip(sim, c, c1, SPH_STORED), e = sph_strip_end(s, c1);
        if (SPH_STRIPS && s > c) {
            for (uint32_t begin = (c / slab + 1) * slab; begin < s; begin += slab)
                cell[begin] = first;
            cell[s] = first;
        }
        if (!SPH_STRIPS || (s < c1 && sim->strip[s / SPH_STRIP] & SPH_PEOPLED))
            first = starts_of_counts(cell + 1 + s, e - s, first);
        for (uint32_t k = s; SPH_STRIPS && k < e && !(sim->strip[s / SPH_STRIP] & SPH_PEOPLED); k++)
            cell[k + 1] = first;
        c = e;
    } while (SPH_STRIPS && c < c1);
}

/* puts the particles of the cells c .. e - 1, whose first is `start`, in order; returns whose first the next is */
SPH_INLINE uint32_t order_cells(const sph_sim *sim, const uint32_t *cell, uint32_t c, uint32_t e, uint32_t start,
                                sph_thread *t)
{
    uint32_t widest = 0;
    for (; c < e; c++) {
        while (!SPH_SMALL && !SPH_STRIPS && c + 64 < e && cell[c + 64] == start)
            c += 64; /* starts never fall: so many empty cells */
        while (!SPH_SMALL && c + 8 < e && cell[c + 8] == start)
            c += 8;
        const uint32_t end = cell[c + 1];
        widest = end - start > widest ? end - start : widest;
        order_cell(sim, start, end);
        start = end;
    }
    t->widest = widest > t->widest ? widest : t->widest;
    return start;
}

static void scatter_range(sph_sim *sim, uint32_t r, sph_thread *t)
{
    const sph_move a = sph_stage_move(sim);
    const range g = make_range(sim, r);
    const uint32_t c0 = g.lo * sim->grid.slab_cells, c1 = g.hi * sim->grid.slab_cells;
    const sph_buffer *b = &sim->buf[sim->dst];
    uint32_t *const cell = sim->cell, run = sim->range_count[r];
    const uint8_t *set = sim->buf[sim->src].set[0];
    uint32_t *const at = t->block.to;
    starts_of_range(sim, c0, c1, run);
    for (uint32_t p = 0; p < g.pieces; p++)
        for (uint32_t i = g.from[p]; i < g.to[p]; i += SPH_BLOCK) {
            const uint32_t n = g.to[p] - i < SPH_BLOCK ? g.to[p] - i : SPH_BLOCK;
            uint32_t mine = 0;
            for (uint32_t j = 0; j < n; j++) {
                const uint32_t c = kept_cell(sim, i + j);
                at[j] = c - c0 < c1 - c0 ? cell[c + 1]++ : NO_CELL;
                mine += at[j] != NO_CELL;
            }
            t->work += n;
            if (mine == 0)
                continue;
            sph_move_block(sim, &a, i, n, true, 0, 0, t);
            for (uint32_t j = 0; j < n;) { /* runs of particles that stay next to each other are copied as one */
                uint32_t e = j + 1;
                /* NO_CELL + 1 is 0, which is a place: who stays behind ends a run and begins none */
                while (e < n && at[j] != NO_CELL && at[e] == at[e - 1] + 1)
                    e++;
                SPH_ASSERT(at[j] == NO_CELL || at[j] + (e - j) <= sim->next.count);
                if (at[j] != NO_CELL)
                    put_run(b, &t->block, set + i, i, j, e - j, at[j]);
                j = e;
            }
        }
    uint32_t c = c0;
    do {
        const uint32_t s = sph_skip(sim, c, c1, SPH_PEOPLED);
        c = sph_strip_end(s, c1);
        run = order_cells(sim, cell, s, c, run, t);
    } while (SPH_STRIPS && c < c1);
    t->work += c1 - c0;
}

/* ---- strips ---- */

/* strips that ends of ranges cut were counted in whether somebody is there or not */
static void close_empty_strips(sph_sim *sim)
{
    for (uint32_t r = 0; r < sim->ranges; r++) {
        const uint32_t s = first_slab(sim, r) * sim->grid.slab_cells / SPH_STRIP, c = s * SPH_STRIP;
        const uint32_t *const count = sim->cell + 1 + c, n = sph_strip_end(c, sim->grid.cells) - c;
        uint32_t any = 0;
        for (uint32_t k = 0; k < n; k++)
            any |= count[k];
        sim->strip[s] = any ? SPH_PEOPLED : 0;
    }
}

/* how far it is along axis k, in cells of the table, to what a cell has beside it, round the domain where that is
   periodic; along the first axis neighbours follow each other */
static uint32_t shifts_along(const sph_sim *sim, uint32_t k, int64_t *shift)
{
    int64_t stride = 1;
    uint32_t n = 1;
    for (uint32_t a = 0; a < k; a++)
        stride *= sim->grid.ncell[a];
    shift[0] = 0;
    for (int64_t way = -1; way <= 1; way += 2) {
        if (k > 0)
            shift[n++] = way * stride;
        if (SPH_IS(sim->cfg.face[k][0], PERIODIC))
            shift[n++] = way * stride * ((int64_t)sim->grid.ncell[k] - 1);
    }
    return n;
}

/* a sweep reads where the cells c - 1 .. e begin and end; those that do not exist do no harm */
static void store_strips(sph_sim *sim, int64_t c, int64_t e)
{
    const int64_t most = (int64_t)sim->grid.cells - 1;
    for (int64_t s = (c < 1 ? 0 : c - 1) / SPH_STRIP; s <= (e < most ? e : most) / SPH_STRIP; s++)
        sim->strip[s] |= SPH_STORED;
}

/* all that sweeps read, of strips with particles and beside them, is stored */
static void choose_strips(sph_sim *sim)
{
    const uint32_t cells = sim->grid.cells;
    int64_t shift[3][5] = {{0}};
    uint32_t n[3] = {1, 1, 1};
    for (uint32_t k = 0; k < SPH_DIM; k++)
        n[k] = shifts_along(sim, k, shift[k]);
    close_empty_strips(sim);
    for (uint32_t c = sph_skip(sim, 0, cells, SPH_PEOPLED); c < cells; c = sph_skip(sim, c, cells, SPH_PEOPLED)) {
        const uint32_t e = sph_strip_end(c, cells);
        for (uint32_t x = 0; x < n[0]; x++)
            for (uint32_t y = 0; y < n[1]; y++)
                for (uint32_t z = 0; z < n[2]; z++) {
                    const int64_t to = shift[0][x] + shift[1][y] + shift[2][z];
                    store_strips(sim, c + to, e + to);
                }
        c = e;
    }
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
    if (chooses(sim))
        choose_strips(sim);
    SPH_ASSERT(sum <= sim->cfg.max_particles);
    return SPH_OK;
}

const sph_pass sph_pass_count = {"count", range_chunks, count_range, count_end, NULL};
static sph_status scatter_end(sph_sim *sim)
{
    SPH_VALIDATE(sph_is_sorted(sim));
    (void)sim;
    return SPH_OK;
}

const sph_pass sph_pass_scatter = {"scatter", range_chunks, scatter_range, scatter_end, NULL};

/* saves the slabs of src and chooses the ranges */
void sph_begin_sort(sph_sim *sim, uint32_t src, uint32_t dst, uint32_t count, bool table, const sph_stage *stage)
{
    sim->src = src;
    sim->dst = dst;
    sim->src_count = count;
    sim->src_table = table;
    sim->stage = stage;
    sim->middle = stage->middle;
    sim->ranges = 1;
    if (table) {
        for (uint32_t s = 0; s <= sim->grid.slabs; s++)
            sim->slab[s] = sim->cell[(size_t)s * sim->grid.slab_cells];
        uint32_t r = sim->grid.slabs / (sim->chunk_cells == SPH_SLICE_CHUNK ? 2 : 4);
        sim->ranges = r < 1 ? 1 : r > SPH_MAX_RANGES ? SPH_MAX_RANGES : r;
    }
    sim->table_valid = false; /* from here on cell[] is being rebuilt */
    if (SPH_STRIPS)
        memset(sim->strip, chooses(sim) ? 0 : SPH_PEOPLED | SPH_STORED, sim->grid.cells / SPH_STRIP + 9);
    for (uint32_t r = 0; chooses(sim) && r < sim->ranges; r++)
        sim->strip[first_slab(sim, r) * sim->grid.slab_cells / SPH_STRIP] = SPH_PEOPLED;
    SPH_VALIDATE(sph_poison_stage(sim));
}
