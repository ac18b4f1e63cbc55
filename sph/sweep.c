/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sweep.c: fills tiles and hands them to a pass (see sweep.h). Costs no array beyond a thread's scratch.

   The candidates of a cell come in this order: rows of cells from low to high, in a row first an image at the low
   end, then the cells themselves from low to high, then an image at the high end, inside a cell by id. The particles
   of up to three neighbouring cells of a row are contiguous in memory, so a row is one copy. */
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(sweep)

typedef struct filling {
    sph_sim *sim;
    const sph_sweep *w;
    sph_thread *t;
    const sph_buffer *b;
    sph_pos origin[SPH_DIM];
    uint32_t homes;
} filling;

/* ---- column sets ---- */

/* of the column sets that are still asked for, bit by bit: the first, which is then taken off */
SPH_INLINE uint32_t take_set(uint32_t *asked)
{
    const uint32_t set = (uint32_t)__builtin_ctz(*asked);
    *asked &= *asked - 1;
    return set;
}

/* the column sets of a run, from place `at` on */
static __attribute__((noinline)) void load_sets(const filling *f, const sph_candidates *r, bool ghosts, bool homes)
{
    const uint32_t room = homes ? SPH_HOME_ROOM : SPH_TILE_ROOM;
    for (uint32_t asked = f->w->columns; asked;) {
        const uint32_t c = take_set(&asked);
        if (f->sim->columns[c].ghosts == ghosts)
            f->sim->columns[c].load(r, (homes ? sph_home_columns_of : sph_columns_of)(f->sim, f->t, c) + r->at, room);
    }
}

/* whatever stands behind the last candidate must stay finite when multiplied by no mass */
static __attribute__((noinline)) void close_sets(const filling *f, uint32_t n, bool ghosts)
{
    for (uint32_t asked = f->w->columns; asked;) {
        const uint32_t c = take_set(&asked);
        for (uint32_t k = 0; f->sim->columns[c].ghosts == ghosts && k < f->sim->columns[c].rows; k++)
            memset(sph_columns_of(f->sim, f->t, c) + (size_t)k * SPH_TILE_ROOM + n, 0, SPH_LANES * sizeof(sph_real));
    }
}

/* ---- tiles ---- */

/* how many candidates a class's tile has; all that moves by forces stands in one tile */
SPH_INLINE uint32_t *tile_count(sph_thread *t, uint32_t role)
{
    if (SPH_HAS_LAYERED_WALLS && role == SPH_ROLE_GHOST)
        return &t->ghosts.n;
    if (SPH_HAS_FORCE_WALLS && role == SPH_ROLE_FORCE_WALL)
        return &t->points.n;
    return &t->matter.n;
}

/* works a class's tile off for all homes and empties it */
static void flush(filling *f, uint32_t role)
{
    sph_thread *t = f->t;
    const bool ghosts = SPH_HAS_LAYERED_WALLS && role == SPH_ROLE_GHOST;
    uint32_t *n = tile_count(t, role);
    if (*n == 0)
        return;
    SPH_ASSERT(*n <= SPH_TILE);
    SPH_VALIDATE(role == SPH_ROLE_FORCE_WALL || sph_is_tile_sound(ghosts ? &t->ghosts : &t->matter));
    if (!SPH_HAS_FORCE_WALLS || role != SPH_ROLE_FORCE_WALL) {
        sph_close_tile(f->sim, ghosts ? &t->ghosts : &t->matter);
        if (f->w->columns)
            close_sets(f, *n, ghosts);
        if (SPH_SIFTS)
            sph_sift_tile(f->sim, t, ghosts ? &t->ghosts : &t->matter, f->homes);
    }
    f->w->tile(f->sim, t, f->homes, role);
    t->pairs += (uint64_t)*n * f->homes;
    *n = 0;
}

/* a run into its tile */
static void load_run(filling *f, const sph_candidates *r, uint32_t role)
{
    sph_thread *t = f->t;
    if (SPH_HAS_FORCE_WALLS && role == SPH_ROLE_FORCE_WALL) {
        sph_load_points(r, &t->points);
        return;
    }
    const bool ghosts = SPH_HAS_LAYERED_WALLS && role == SPH_ROLE_GHOST;
    sph_load_tile(r, ghosts ? &t->ghosts : &t->matter, f->w->needs_inv_rho, false);
    if (f->w->columns)
        load_sets(f, r, ghosts, false);
}

/* whether candidates of a set, seen through an image, may join those in the tile of matter; if the tile is empty, what
   they are is noted */
static bool joins(filling *f, const sph_set *set, const sph_image *im)
{
    sph_thread *const t = f->t;
    bool same = true;
    if (t->matter.n == 0) {
        t->of = set;
        t->seen = *im;
        memcpy(t->origin, f->origin, sizeof t->origin);
    }
    if (f->w->apart & SPH_APART_KIN)
        same &= t->of->kin == set->kin;
    for (uint32_t k = 0; k < SPH_DIM && f->w->apart & SPH_APART_MIRRORED; k++)
        same &= t->seen.sign[k] == im->sign[k] && (im->sign[k] > 0 || t->seen.shift[k] == im->shift[k]);
    return same;
}

#if SPH_HAS_SIDES
/* whether candidates of a set of walls, seen through an image, may join those in the tile of ghosts; if the tile is
   empty, what they are is noted */
static bool joins_wall(filling *f, const sph_set *set, const sph_image *im)
{
    sph_thread *const t = f->t;
    const sph_set *const own = set->side ? set : NULL;
    if (t->ghosts.n == 0) {
        t->wall = own;
        t->wall_seen = *im;
    }
    bool same = t->wall == own;
    for (uint32_t k = 0; k < SPH_DIM && own; k++)
        same &= t->wall_seen.sign[k] == im->sign[k] && t->wall_seen.shift[k] == im->shift[k];
    return same;
}

/* how far home h went in the last half of a step, in whose middle it is seen (tiles.c) */
static double way_since(const sph_sim *sim, const sph_thread *t, uint32_t h, uint32_t k)
{
    const sph_buffer *const b = &sim->buf[sim->dst];
    const sph_real *const beside = sph_drift(sim, b, k);
    const uint32_t i = t->home_at[h];
    return 0.5 * sim->dt * ((double)b->vel[k][i] + (beside ? (double)beside[i] : 0));
}

bool sph_is_acted_on(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_set *const s = t->wall;
    const double q = sim->grid.quantum;
    const bool middle = sph_in_middle(sim);
    double d[SPH_DIM], frame[SPH_DIM][SPH_DIM], x[SPH_DIM] = {0};
    if (!s)
        return true;
    sph_frame_of(s, frame);
    for (uint32_t k = 0; k < SPH_DIM; k++) { /* from the face, as the image shows it, turned back */
        const double at = ((double)sim->buf[sim->dst].pos[k][t->home_at[h]] - (double)t->wall_seen.shift[k]) * q;
        const double seen = middle ? at - way_since(sim, t, h, k) : at;
        d[k] = (double)t->wall_seen.sign[k] * seen - s->origin[k] - (double)sph_wall_moved(sim, s, k) * q;
        d[k] += middle ? 0.5 * sim->dt * sph_wall_velocity(sim, s, k) : 0;
    }
    for (uint32_t l = 0; l < SPH_DIM; l++)
        for (uint32_t k = 0; k < SPH_DIM; k++)
            x[l] += frame[l][k] * d[k];
    bool acts = x[0] > 0;
    for (uint32_t l = 1; l < SPH_DIM && s->side == SPH_FACE; l++)
        acts &= x[l] >= -s->half[l - 1] && x[l] <= s->half[l - 1];
    return acts;
}
#else
#define joins_wall(f, set, im) ((void)(f), (void)(set), (void)(im), true)
#endif

/* candidates s..e of one set into their tile */
static void add_run(filling *f, const sph_image *im, const sph_set *set, uint32_t s, uint32_t e)
{
    const uint32_t role = sph_is_matter(set) ? SPH_ROLE_FLUID : set->role;
    uint32_t *const n = tile_count(f->t, role);
    while (s < e) {
        if (*n == SPH_TILE)
            flush(f, role);
        if (SPH_HAS_APART && f->w->apart && role == SPH_ROLE_FLUID && !joins(f, set, im)) {
            flush(f, role);
            (void)joins(f, set, im);
        }
        if (SPH_HAS_SIDES && f->sim->sided && role == SPH_ROLE_GHOST && !joins_wall(f, set, im)) {
            flush(f, role);
            (void)joins_wall(f, set, im);
        }
        const uint32_t take = e - s < SPH_TILE - *n ? e - s : SPH_TILE - *n;
        const sph_tile *const tile = role == SPH_ROLE_GHOST ? &f->t->ghosts : &f->t->matter;
        const sph_candidates r = {f->sim, f->b, im, set, f->origin, s, take, tile, *n};
        load_run(f, &r, role);
        *n += take;
        s += take;
    }
}

/* candidates of the cells c0..c1 (contiguous in a row), seen through an image */
static void add_cells(filling *f, const sph_image *im, uint32_t c0, uint32_t c1)
{
    uint32_t s = f->sim->cell[c0], e = f->sim->cell[c1 + 1];
    while (s < e) {
        uint32_t r = sph_run_end(f->b->set[0], s, e);
        if (f->b->set[0][s] != SPH_DEAD) {
            const sph_set *set = &f->sim->set[f->b->set[0][s]];
            if (f->w->classes >> set->role & 1)
                add_run(f, im, set, s, r);
        }
        s = r;
    }
}

/* Cell c + o along axis k: its index if it exists, directly or as an image (then im is changed); false if nothing is
   there. */
static bool look(const sph_sim *sim, uint32_t k, uint32_t c, int o, uint32_t *cell, sph_image *im)
{
    const uint32_t n = sim->grid.ncell[k];
    const bool low = o < 0 && c == 0, high = o > 0 && c == n - 1;
    if (!low && !high) {
        *cell = c + (uint32_t)o;
        return true;
    }
    const uint32_t face = sim->cfg.face[k][high];
    if (!SPH_HAS_IMAGES || face == SPH_OPEN)
        return false;
    im->is_image = true;
    if (SPH_IS(face, PERIODIC)) {
        *cell = low ? n - 1 : 0;
        im->shift[k] = low ? -sim->grid.extent[k] : sim->grid.extent[k];
        return true;
    }
    *cell = c; /* a mirror: the cell's own picture behind the face */
    im->sign[k] = -1;
    im->shift[k] = low ? 0 : 2 * sim->grid.extent[k];
    for (uint32_t a = 0; a < SPH_DIM; a++)
        if (a == k || SPH_IS(face, MIRROR_NO_SLIP))
            im->flip[a] = -im->flip[a];
    return true;
}

static const sph_image no_image = {false,
#if SPH_DIM == 1
                               {1}, {0}, {1}
#elif SPH_DIM == 2
                               {1, 1}, {0, 0}, {1, 1}
#else
                               {1, 1, 1}, {0, 0, 0}, {1, 1, 1}
#endif
};

/* all candidates of one row of cells; `row` is the index of its first cell, im says how the row itself is seen */
static void add_row(filling *f, const sph_image *im, uint32_t row, uint32_t cx)
{
    const sph_sim *sim = f->sim;
    uint32_t x, lo = cx > 0 ? cx - 1 : 0, hi = cx + 1 < sim->grid.ncell[0] ? cx + 1 : cx;
    if (cx == 0) {
        sph_image e = *im;
        if (look(sim, 0, cx, -1, &x, &e))
            add_cells(f, &e, row + x, row + x);
    }
    add_cells(f, im, row + lo, row + hi);
    if (cx + 1 == sim->grid.ncell[0]) {
        sph_image e = *im;
        if (look(sim, 0, cx, 1, &x, &e))
            add_cells(f, &e, row + x, row + x);
    }
}

#define AXIS_Y (SPH_DIM > 1 ? 1 : 0)
#define AXIS_Z (SPH_DIM > 2 ? 2 : 0)

/* away from the domain's faces there are no images and every row has three cells */
static bool is_inner(const sph_sim *sim, const uint32_t *c)
{
    bool inner = true;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        inner &= c[k] > 0 && c[k] + 1 < sim->grid.ncell[k];
    return inner;
}
static void add_inner(filling *f, const uint32_t *c)
{
    const uint32_t nx = f->sim->grid.ncell[0], oz = SPH_DIM == 3, oy = SPH_DIM > 1;
    for (uint32_t z = c[2] - oz; z <= c[2] + oz; z++)
        for (uint32_t y = c[1] - oy; y <= c[1] + oy; y++) {
            const uint32_t row = (z * f->sim->grid.ncell[AXIS_Y] + y) * nx + c[0];
            add_cells(f, &no_image, row - 1, row + 1);
        }
}

static void add_all(filling *f, const uint32_t *c)
{
    const sph_sim *sim = f->sim;
    const int oz = SPH_DIM == 3, oy = SPH_DIM > 1;
    if (SPH_DIM > 1 && is_inner(sim, c)) {
        add_inner(f, c);
        return;
    }
    for (int p = -oz; p <= oz; p++) {
        sph_image plane = no_image;
        uint32_t z = 0;
        if (oz && !look(sim, AXIS_Z, c[2], p, &z, &plane))
            continue;
        for (int o = -oy; o <= oy; o++) {
            sph_image im = plane;
            uint32_t y = 0;
            if (!oy || look(sim, AXIS_Y, c[1], o, &y, &im))
                add_row(f, &im, (z * sim->grid.ncell[AXIS_Y] + y) * sim->grid.ncell[0], c[0]);
        }
    }
}

#if SPH_SIFTS
/* homes are loaded as candidates are, where no candidates stand yet */
static void note_sweep(sph_thread *t, const sph_sweep *w) { t->sifted.sweep = w; }
#define HOMES_LOADED(t) (&(t)->matter)
static void copy_homes(sph_thread *t)
{
    const sph_tile *const from = &t->matter;
    sph_home_tile *const to = &t->home;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        memcpy(to->x[k], from->x[k], sizeof to->x[k]);
        memcpy(to->v[k], from->v[k], sizeof to->v[k]);
    }
    memcpy(to->m, from->m, sizeof to->m);
    memcpy(to->rho, from->rho, sizeof to->rho);
    memcpy(to->press, from->press, sizeof to->press);
    memcpy(to->inv_rho, from->inv_rho, sizeof to->inv_rho);
}
#else
#define note_sweep(t, w) ((void)(t), (void)(w))
#define HOMES_LOADED(t) (&(t)->home)
#define copy_homes(t) ((void)(t))
#endif

/* loads wanted particles from *s on into the home tile, at most SPH_HOMES; advances *s */
static void load_homes(filling *f, uint32_t *s, uint32_t e)
{
    sph_thread *t = f->t;
    sph_tile *const tile = HOMES_LOADED(t);
    tile->n = 0;
    while (*s < e && tile->n < SPH_HOMES) {
        const uint32_t end = sph_run_end(f->b->set[0], *s, e), at = tile->n;
        const uint8_t set = f->b->set[0][*s];
        if (set == SPH_DEAD || !f->w->home(f->sim, &f->sim->set[set])) {
            *s = end;
            continue;
        }
        const uint32_t n = end - *s < SPH_HOMES - at ? end - *s : SPH_HOMES - at;
        const sph_candidates r = {f->sim, f->b, &no_image, &f->sim->set[set], f->origin, *s, n, tile, at};
        sph_load_tile(&r, tile, f->w->needs_inv_rho, true);
        if (f->w->columns)
            load_sets(f, &r, false, true);
        for (uint32_t j = 0; j < n; j++) {
            t->home_at[at + j] = *s + j;
            t->home_set[at + j] = set;
        }
        tile->n += n;
        *s += n;
    }
    f->homes = tile->n;
    copy_homes(t);
    SPH_ASSERT(f->homes <= SPH_HOMES);
}

/* sums of eight homes; a fixed number of vector stores costs less than finding out how many are needed */
SPH_INLINE void clear_eight(sph_real *sum)
{
    const vreal zero = v_set(0);
    SPH_UNROLL
    for (uint32_t k = 0; k < 8 * SPH_LANES; k += SPH_W)
        v_store(sum + k, zero);
}

static void sweep_cell(filling *f, uint32_t cell, const uint32_t *c)
{
    const sph_sim *sim = f->sim;
    uint32_t s = sim->cell[cell], e = sim->cell[cell + 1];
    SPH_ASSERT(s <= e && e <= sim->next.count);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        f->origin[k] = (sph_pos)c[k] * sim->grid.cell_size[k];
    while (s < e) {
        load_homes(f, &s, e);
        if (f->homes == 0)
            return;
        for (uint32_t a = 0; f->w->sums >> a; a++)
            for (uint32_t h = 0; f->w->sums >> a & 1 && h < f->homes; h += 8)
                clear_eight(f->t->sum[a][h]);
        f->t->matter.n = f->t->ghosts.n = f->t->points.n = 0;
        add_all(f, c);
        flush(f, SPH_ROLE_FLUID);
        if (SPH_HAS_LAYERED_WALLS)
            flush(f, SPH_ROLE_GHOST);
        if (SPH_HAS_FORCE_WALLS)
            flush(f, SPH_ROLE_FORCE_WALL);
        for (uint32_t h = 0; h < f->homes; h++)
            f->w->finish(f->sim, f->t, h);
    }
}

uint32_t sph_sweep_chunks(const sph_sim *sim)
{
    return (sim->grid.cells + sim->chunk_cells - 1) / sim->chunk_cells;
}
uint32_t sph_local_chunks(const sph_sim *sim)
{
    return (sim->next.count + SPH_LOCAL_CHUNK - 1) / SPH_LOCAL_CHUNK;
}

static uint32_t end_of_chunk(const sph_sim *sim, uint32_t cell)
{
    const uint32_t left = sim->grid.cells - cell;
    return cell + (left < sim->chunk_cells ? left : sim->chunk_cells);
}
bool sph_is_empty_chunk(const sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const uint32_t cell = chunk * sim->chunk_cells, end = end_of_chunk(sim, cell);
    const uint32_t from = sph_skip(sim, cell, end, SPH_PEOPLED);
    /* somebody is in every such strip, but not in every cell of a slice */
    if (from < end && (sph_strip_end(from, end) < end || sim->cell[from] != sim->cell[end]))
        return false;
    t->work += end - cell;
    return true;
}

#if SPH_STRIPS
#define SWEEP SPH_APART
#else
#define SWEEP static
#endif
/* the cells cell .. last - 1, where all starts are known */
SWEEP void sweep_cells(filling *f, uint32_t cell, uint32_t last)
{
    const sph_sim *const sim = f->sim;
    uint32_t c[3] = {0}, q = cell;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        c[k] = q % sim->grid.ncell[k];
        q /= sim->grid.ncell[k];
    }
    for (; cell < last; cell++) {
        while (cell + 8 < last && c[0] + 8 < sim->grid.ncell[0] && sim->cell[cell] == sim->cell[cell + 8]) {
            cell += 8; /* eight empty cells */
            c[0] += 8;
        }
        if (sim->cell[cell] != sim->cell[cell + 1])
            sweep_cell(f, cell, c);
        for (uint32_t k = 0; k < SPH_DIM && ++c[k] == sim->grid.ncell[k]; k++)
            c[k] = k + 1 < SPH_DIM ? 0 : c[k];
    }
}

void sph_sweep_chunk(sph_sim *sim, const sph_sweep *w, uint32_t chunk, sph_thread *t)
{
    filling f;
    if (!SPH_SMALL && sph_is_empty_chunk(sim, chunk, t))
        return;
    f.sim = sim;
    f.w = w;
    f.t = t;
    note_sweep(t, w);
    f.b = &sim->buf[sim->dst];
    f.homes = 0;
    SPH_ASSERT(w->sums >> SPH_SUMS == 0 && w->columns >> SPH_COLUMN_COUNT == 0);
    uint64_t before = t->pairs;
    const uint32_t first = chunk * sim->chunk_cells, last = end_of_chunk(sim, first);
    uint32_t cell = first;
    do {
        const uint32_t s = sph_skip(sim, cell, last, SPH_PEOPLED);
        cell = sph_strip_end(s, last);
        sweep_cells(&f, s, cell);
    } while (SPH_STRIPS && cell < last);
    t->work += t->pairs - before + (last - first);
}
