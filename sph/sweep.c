/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sweep.c: fills tiles and hands them to a pass (see sweep.h). Costs no array beyond a thread's scratch.

   The candidates of a cell come in this order: rows of cells from low to high, in a row first an image at the low end,
   then the cells themselves from low to high, then an image at the high end, inside a cell by id. The particles of up to
   three neighbouring cells of a row are contiguous in memory, so a row is one copy. */
#include "solid.h"

/* how a run of particles is carried into the tile: x' = sign x + shift, v' = flip v */
typedef struct image {
    bool is_image;
    sph_pos sign[SPH_DIM], shift[SPH_DIM];
    sph_real flip[SPH_DIM];
} image;

typedef struct filling {
    sph_sim *sim;
    const sph_sweep *w;
    sph_thread *t;
    const sph_buffer *b;
    sph_pos origin[SPH_DIM];
    uint32_t homes;
    bool usual; /* the scene takes the fast path of loading */
} filling;

/* p from the relative density excess (Gray 2001 eq 2.25; Horner form, exact for small d) */
SPH_INLINE vreal pressure(uint32_t eos, bool floor, vreal b, vreal d)
{
    vreal p;
    if (SPH_IS(eos, LINEAR))
        p = b * d;
    else if (SPH_IS(eos, ISOTHERMAL))
        p = b * (1 + d);
    else
        p = b * (d * (7 + d * (21 + d * (35 + d * (35 + d * (21 + d * (7 + d)))))));
    return floor ? v_pos(p) : p;
}

/* the choices of a scene that a tile's columns depend on; constants in the fast path */
typedef struct columns {
    uint32_t eos;
    bool ratio, floor, iv;
} columns;

/* Coordinate k of W particles from index s on, relative to the home cell. */
SPH_INLINE vreal load_axis(const filling *f, const image *im, uint32_t k, uint32_t s, bool is_image)
{
    const vreal quantum = v_set((sph_real)f->sim->grid.quantum);
    const vint q = v_load_int(f->b->pos[k] + s);
    if (!is_image)
        return v_from_int(q - v_set_int(f->origin[k])) * quantum;
    return v_from_int(q * v_set_int(im->sign[k]) + v_set_int(im->shift[k] - f->origin[k])) * quantum;
}

/* The columns of n particles of one set from index s on. Whole strides are written: what lies beyond the last is filled
   with whatever follows in memory, and overwritten by the next run or by close_tile. */
SPH_INLINE void load_columns(const filling *f, const image *im, const sph_set *set, uint32_t s, uint32_t n, sph_tile *t,
                             columns c, bool is_image, bool wall)
{
    const vreal m = v_set(set->mass_r), r0 = v_set(set->rho0_r), b = v_set(set->b_r);
    const uint32_t at = t->n;
    for (uint32_t from = 0; from < n; from += SPH_COPIED)
        SPH_UNROLL
        for (uint32_t l = 0; l < SPH_COPIED; l += SPH_W) {
            const uint32_t j = from + l;
            SPH_UNROLL
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                vreal v = wall ? v_set((sph_real)sph_wall_velocity(f->sim, set, k)) : v_load(f->b->vel[k] + s + j);
                v_store(t->x[k] + at + j, load_axis(f, im, k, s + j, is_image));
                v_store(t->v[k] + at + j, is_image ? v * im->flip[k] : v);
            }
            const vreal e = v_load(f->b->rho[0] + s + j);
            const vreal rho = (1 + e) * r0, p = pressure(c.eos, c.floor, b, e);
            v_store(t->m + at + j, m);
            v_store(t->rho + at + j, rho);
            v_store(t->a + at + j, c.ratio ? p / (rho * rho) : p);
            if (c.iv)
                v_store(t->iv + at + j, 1 / rho);
        }
}

static __attribute__((noinline)) void load_any(const filling *f, const image *im, const sph_set *set, uint32_t s, uint32_t n,
                                               sph_tile *t)
{
    const sph_config *c = &f->sim->cfg;
    const columns cols = {set->eos, !sph_weak_scheme(c->scheme), c->pressure_floor && !sph_is_solid(set), f->w->needs_iv};
    load_columns(f, im, set, s, n, t, cols, SPH_HAS_IMAGES && im->is_image, SPH_HAS_LAYERED_WALLS && set->role == SPH_ROLE_GHOST);
}

static void load(const filling *f, const image *im, const sph_set *set, uint32_t s, uint32_t n, sph_tile *t)
{
#if SPH_WITH_FAST_PATHS
    static const columns usual = {SPH_TAIT, true, false, false};
    if (f->usual && !im->is_image && set->role == SPH_ROLE_FLUID && SPH_IS(set->eos, TAIT)) {
        load_columns(f, im, set, s, n, t, usual, false, false);
        return;
    }
#endif
    load_any(f, im, set, s, n, t);
}

#if SPH_WITH_SOLID
/* Artificial stress of a symmetric stress tensor, positive in tension: r = eps w (its tensile part), w being 1/rho^2 or 1. By
   components: each component where it is positive (Monaghan 2000). On principal axes: sum over the principal stresses above 0
   of eps w sigma n (x) n. In 2-D with m = (xx + yy)/2, a = (xx - yy)/2 and d = sqrt(a^2 + xy^2) they are m +- d, and
   n (x) n = (1 +- [a xy; xy -a]/d)/2; where d vanishes the axes are not defined, but the difference of the two tensile parts
   is at most 2 d, so a floor under the divisor is all it takes (Gray 2001 section 5.4 adds a stress difference instead). */
#if SPH_DIM == 3
/* cyclic Jacobi, four sweeps: one rotation in the plane p, q of tensor a and axes e (columns) */
SPH_INLINE void rotate(vreal (*a)[3], vreal (*e)[3], int p, int q)
{
    const vreal none = v_set(0), one = v_set(1);
    const vint still = ~v_less(none, v_abs(a[p][q]));
    const vreal theta = (a[q][q] - a[p][p]) / (2 * v_select(still, one, a[p][q]));
    const vreal big = v_set(SPH_DOUBLE ? (sph_real)1e100 : (sph_real)1e15), size = v_select(v_less(v_abs(theta), big), v_abs(theta), big);
    const vreal root = 1 / (size + v_sqrt(size * size + 1));
    const vreal t = v_select(still, none, v_select(v_less(theta, none), -root, root));
    const vreal c = 1 / v_sqrt(t * t + 1), s = t * c;
    const int r = 3 - p - q;
    const vreal apq = a[p][q], arp = a[r][p], arq = a[r][q];
    a[p][p] = a[p][p] - t * apq;
    a[q][q] = a[q][q] + t * apq;
    a[p][q] = a[q][p] = v_select(still, apq, none);
    a[r][p] = a[p][r] = c * arp - s * arq;
    a[r][q] = a[q][r] = s * arp + c * arq;
    for (int k = 0; k < 3; k++) {
        const vreal x = e[k][p], y = e[k][q];
        e[k][p] = c * x - s * y;
        e[k][q] = s * x + c * y;
    }
}
#endif

SPH_INLINE void tensile_part(const vreal *sigma, bool principal, vreal small, vreal *r)
{
    (void)small;
    if (!principal || SPH_DIM == 1) {
        for (int k = 0; k < SPH_NT; k++)
            r[k] = v_pos(sigma[k]);
        return;
    }
#if SPH_DIM == 2
    const vreal half = v_set((sph_real)0.5);
    const vreal m = (sigma[0] + sigma[1]) * half, a = (sigma[0] - sigma[1]) * half;
    const vreal d = v_sqrt(a * a + sigma[2] * sigma[2]), one = v_pos(m + d), two = v_pos(m - d);
    const vreal mean = (one + two) * half, diff = (one - two) * half / v_max(d, small);
    r[0] = mean + diff * a;
    r[1] = mean - diff * a;
    r[2] = diff * sigma[2];
#elif SPH_DIM == 3
    vreal a[3][3], e[3][3], pos[3];
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            a[k][l] = sigma[sph_sym[k][l]];
            e[k][l] = v_set(k == l ? 1 : 0);
        }
    for (int turn = 0; turn < 4; turn++) {
        rotate(a, e, 0, 1);
        rotate(a, e, 0, 2);
        rotate(a, e, 1, 2);
    }
    for (int k = 0; k < 3; k++)
        pos[k] = v_pos(a[k][k]);
    for (int k = 0; k < 3; k++)
        for (int l = k; l < 3; l++)
            r[sph_sym[k][l]] = pos[0] * e[k][0] * e[l][0] + pos[1] * e[k][1] * e[l][1] + pos[2] * e[k][2] * e[l][2];
#endif
}

/* T, and R where the scene has it, of W particles from index i on */
SPH_INLINE void load_stress(const filling *f, const image *im, const sph_set *set, uint32_t i, sph_real *to, uint32_t row)
{
    const sph_config *c = &f->sim->cfg;
    const bool solid = set->role == SPH_ROLE_SOLID, weak = sph_weak_scheme(c->scheme);
    const vreal e = v_load(f->b->rho[0] + i), rho = (1 + e) * set->rho0_r;
    vreal p = pressure(set->eos, c->pressure_floor && !solid, v_set(set->b_r), e), kept[SPH_NS], s[SPH_NT], t[SPH_NL];
    SPH_UNROLL
    for (int k = 0; k < SPH_NS; k++)
        kept[k] = v_load(f->b->stress[k] + i);
    if (SPH_HAS_DAMAGE && f->b->damage[0]) { /* Gray 2001 eqs 5.33, 5.34 */
        const vreal root = v_load(f->b->damage[0] + i), whole = 1 - (SPH_DIM == 3 ? root * root * root : root * root);
        p = v_select(v_less(p, v_set(0)), whole * p, p);
        SPH_UNROLL
        for (int k = 0; k < SPH_NS; k++)
            kept[k] = kept[k] * whole;
    }
    sph_deviator(kept, s);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        s[k] = s[k] - p;
    const vreal w = weak ? v_set(1) : 1 / (rho * rho);
    if (sph_repels(c)) {
        vreal r[SPH_NT];
        tensile_part(s, c->artificial_stress == SPH_PRINCIPAL, v_set(set->b_r * (sph_real)1e-9), r);
        const vreal scale = w * (solid ? f->sim->fac.repulsion : 0);
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = k; l < SPH_DIM; l++) {
                const int n = sph_sym[k][l];
                const vreal v = r[n] * scale;
                v_store(to + (SPH_NL + (uint32_t)n) * row, im->is_image && k != l ? v * (sph_real)(im->sign[k] * im->sign[l]) : v);
            }
    }
    if (sph_corrects(c) && solid) { /* -sigma M^-T over rho (standard) or 1 (weak) */
        const vreal scale = weak ? v_set(-1) : -1 / rho;
        for (int k = 0; k < SPH_DIM; k++)
            for (int l = 0; l < SPH_DIM; l++) {
                vreal sum = v_set(0);
                for (int m = 0; m < SPH_DIM; m++)
                    sum = sum + s[sph_sym[k][m]] * v_load(f->sim->corr[l * SPH_DIM + m] + i);
                t[k * SPH_DIM + l] = sum * scale;
            }
    } else {
        SPH_UNROLL
        for (int k = 0; k < SPH_DIM; k++)
            SPH_UNROLL
            for (int l = 0; l < SPH_DIM; l++)
                t[k * SPH_DIM + l] = -(s[sph_sym[k][l]] * w);
    }
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        SPH_UNROLL
        for (int l = 0; l < SPH_DIM; l++) {
            const vreal v = t[k * SPH_DIM + l];
            v_store(to + (uint32_t)(k * SPH_DIM + l) * row, im->is_image && k != l ? v * (sph_real)(im->sign[k] * im->sign[l]) : v);
        }
}

/* The solid columns of n particles of one set from index s on, to `to`: rows of `row` elements, from element 0. */
static __attribute__((noinline)) void load_solid(const filling *f, const image *im, const sph_set *set, uint32_t s, uint32_t n,
                                                 sph_real *to, uint32_t row)
{
    const uint32_t asked = f->w->columns;
    const vreal quantum = v_set((sph_real)f->sim->grid.quantum);
    sph_real *const k0 = to + (size_t)(SPH_NL + SPH_NT) * row, *const u0 = k0 + (size_t)SPH_DIM * row;
    for (uint32_t j = 0; j < n; j += SPH_W) {
        const uint32_t i = s + j;
        if (asked & SPH_COL_STRESS)
            load_stress(f, im, set, i, to + j, row);
        for (uint32_t k = 0; k < SPH_DIM && SPH_HAS_TOTAL && asked & SPH_COL_REFERENCE; k++) {
            const vint q = v_load_int(f->b->pos[k] + i) - v_load_int(f->b->shift[k] + i);
            v_store(k0 + k * row + j, v_from_int(q * v_set_int(im->sign[k]) + v_set_int(im->shift[k] - f->origin[k])) * quantum);
        }
        for (uint32_t k = 0; k < SPH_DIM && SPH_HAS_HAT && asked & SPH_COL_SMOOTHED; k++)
            v_store(u0 + k * row + j, (v_load(f->b->vel[k] + i) + v_load(f->b->xsph[k] + i)) * im->flip[k]);
    }
    sph_real *const body = u0 + (size_t)SPH_DIM * row;
    for (uint32_t j = 0; j < n && SPH_HAS_TOTAL && asked & SPH_COL_REFERENCE; j++) {
        const bool broken = f->b->damage[0] && !(f->b->damage[0][s + j] < 1);
        body[j] = set->role == SPH_ROLE_SOLID && !broken ? (sph_real)(sph_material_of(f->sim, set)->body + 1) : 0;
    }
}
#endif

#if SPH_HAS_FORCE_WALLS
/* positions only, for boundary-force particles */
static void load_positions(const filling *f, const image *im, uint32_t s, uint32_t n, sph_real (*x)[SPH_TILE + SPH_STRIDE], uint32_t at)
{
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t j = 0; j < n; j += SPH_W)
            v_store(x[k] + at + j, load_axis(f, im, k, s + j, im->is_image));
}

#endif

#if SPH_HAS_LAYERED_WALLS
/* normals, depths and viscous velocities of a run of ghost particles already loaded at `at` */
static void load_ghost(const filling *f, const image *im, const sph_set *set, uint32_t s, uint32_t n, uint32_t at)
{
    sph_ghost_tile *g = &f->t->more;
    const bool mirror = SPH_IS(set->kind, WALL_GHOST);
    const double q = f->sim->grid.quantum;
    double plane = 0; /* normal . (wall face - home cell), with the wall where it is now, and its image */
    for (uint32_t k = 0; mirror && k < SPH_DIM; k++) {
        double moved = (double)sph_wall_moved(f->sim, set, k) * q;
        double o = (double)im->sign[k] * (set->origin[k] + moved) + (double)(im->shift[k] - f->origin[k]) * q;
        plane += (double)im->sign[k] * set->normal[k] * o;
    }
    for (uint32_t j = 0; j < n; j++) {
        double x = 0;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const double nk = mirror ? (double)im->sign[k] * set->normal[k] : 0;
            if (mirror)
                x += nk * (double)f->t->ghost.x[k][at + j];
            g->n[k][at + j] = (sph_real)nk;
            g->u[k][at + j] = mirror || !set->no_slip ? f->t->ghost.v[k][at + j] : f->b->vel[k][s + j] * im->flip[k];
        }
        g->depth[at + j] = mirror ? (sph_real)(plane - x > 0 ? plane - x : 0) : 0;
        g->vis[at + j] = set->no_slip ? 1 : 0;
    }
}

#endif

/* makes the columns behind the last candidate harmless: far away, without mass */
static void close_tile(const filling *f, sph_tile *t, bool ghost)
{
    const sph_real far = (sph_real)(64 * f->sim->grid.support);
    for (uint32_t j = t->n; j < t->n + SPH_LANES; j++) {
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            t->x[k][j] = far;
            t->v[k][j] = 0;
            if (ghost)
                f->t->more.n[k][j] = f->t->more.u[k][j] = 0;
        }
        t->m[j] = t->a[j] = 0;
        t->rho[j] = t->iv[j] = 1;
#if SPH_WITH_SOLID
        if (!ghost && f->w->columns) { /* whatever they hold must stay finite when multiplied by no mass */
            sph_solid_tile *const solid = &sph_solid_scratch_of(f->sim, f->t)->tile;
            sph_real *const c = solid->t[0] + j;
            for (uint32_t k = 0; k < sizeof *solid / sizeof solid->t[0]; k++)
                c[k * (SPH_TILE + SPH_STRIDE)] = 0;
            for (uint32_t k = 0; k < SPH_DIM; k++)
                solid->k[k][j] = far;
        }
#endif
        if (ghost)
            f->t->more.depth[j] = f->t->more.vis[j] = 0;
    }
}

/* how many candidates a class's tile has */
SPH_INLINE uint32_t *tile_count(sph_thread *t, uint32_t role)
{
    if (SPH_HAS_LAYERED_WALLS && role == SPH_ROLE_GHOST)
        return &t->ghost.n;
    if (SPH_HAS_FORCE_WALLS && role == SPH_ROLE_FORCE_WALL)
        return &t->forces;
    return &t->fluid.n;
}

/* works a class's tile off for all homes and empties it */
static void flush(filling *f, uint32_t role)
{
    sph_thread *t = f->t;
    uint32_t *n = tile_count(t, role);
    if (*n == 0)
        return;
    if (role == SPH_ROLE_FLUID)
        close_tile(f, &t->fluid, false);
    else if (SPH_HAS_LAYERED_WALLS && role == SPH_ROLE_GHOST)
        close_tile(f, &t->ghost, true);
    f->w->tile(f->sim, t, f->homes, role);
    t->pairs += (uint64_t)*n * f->homes;
    *n = 0;
}

/* candidates s..e of one set into their tile */
static void add_run(filling *f, const image *im, const sph_set *set, uint32_t s, uint32_t e)
{
    sph_thread *t = f->t;
    const uint32_t role = sph_is_body(set) ? SPH_ROLE_FLUID : set->role; /* solids stand in the fluid's tile */
    while (s < e) {
        uint32_t *n = tile_count(t, role);
        if (*n == SPH_TILE)
            flush(f, role);
        uint32_t take = e - s < SPH_TILE - *n ? e - s : SPH_TILE - *n;
        if (sph_is_body(set))
            load(f, im, set, s, take, &t->fluid);
#if SPH_WITH_SOLID
        if (f->w->columns && sph_is_body(set))
            load_solid(f, im, set, s, take, sph_solid_scratch_of(f->sim, t)->tile.t[0] + *n, SPH_TILE + SPH_STRIDE);
#endif
#if SPH_HAS_LAYERED_WALLS
        if (set->role == SPH_ROLE_GHOST) {
            load(f, im, set, s, take, &t->ghost);
            load_ghost(f, im, set, s, take, *n);
        }
#endif
#if SPH_HAS_FORCE_WALLS
        if (set->role == SPH_ROLE_FORCE_WALL) {
            load_positions(f, im, s, take, t->fx, *n);
            memset(t->fset + *n, f->b->set[0][s], take);
        }
#endif
        *n += take;
        s += take;
    }
}

/* candidates of the cells c0..c1 (contiguous in a row), seen through an image */
static void add_cells(filling *f, const image *im, uint32_t c0, uint32_t c1)
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

/* Cell c + o along axis k: its index if it exists, directly or as an image (then im is changed); false if nothing is there. */
static bool look(const sph_sim *sim, uint32_t k, uint32_t c, int o, uint32_t *cell, image *im)
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

static const image no_image = {false,
#if SPH_DIM == 1
                               {1}, {0}, {1}
#elif SPH_DIM == 2
                               {1, 1}, {0, 0}, {1, 1}
#else
                               {1, 1, 1}, {0, 0, 0}, {1, 1, 1}
#endif
};

/* all candidates of one row of cells; `row` is the index of its first cell, im says how the row itself is seen */
static void add_row(filling *f, const image *im, uint32_t row, uint32_t cx)
{
    const sph_sim *sim = f->sim;
    uint32_t x, lo = cx > 0 ? cx - 1 : 0, hi = cx + 1 < sim->grid.ncell[0] ? cx + 1 : cx;
    if (cx == 0) {
        image e = *im;
        if (look(sim, 0, cx, -1, &x, &e))
            add_cells(f, &e, row + x, row + x);
    }
    add_cells(f, im, row + lo, row + hi);
    if (cx + 1 == sim->grid.ncell[0]) {
        image e = *im;
        if (look(sim, 0, cx, 1, &x, &e))
            add_cells(f, &e, row + x, row + x);
    }
}

static void add_all(filling *f, const uint32_t *c)
{
#if SPH_DIM > 1
    /* away from the domain's faces there are no images and every row has three cells */
    bool inner = true;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        inner &= c[k] > 0 && c[k] + 1 < f->sim->grid.ncell[k];
    if (inner) {
        const uint32_t nx = f->sim->grid.ncell[0];
        for (uint32_t z = SPH_DIM == 3 ? c[2] - 1 : 0; z <= (SPH_DIM == 3 ? c[2] + 1 : 0); z++)
            for (uint32_t y = c[1] - 1; y <= c[1] + 1; y++) {
                uint32_t row = (z * f->sim->grid.ncell[1] + y) * nx + c[0];
                add_cells(f, &no_image, row - 1, row + 1);
            }
        return;
    }
#endif
#if SPH_DIM == 1
    add_row(f, &no_image, 0, c[0]);
#elif SPH_DIM == 2
    for (int o = -1; o <= 1; o++) {
        image im = no_image;
        uint32_t y;
        if (look(f->sim, 1, c[1], o, &y, &im))
            add_row(f, &im, y * f->sim->grid.ncell[0], c[0]);
    }
#else
    for (int p = -1; p <= 1; p++) {
        image imz = no_image;
        uint32_t y, z;
        if (!look(f->sim, 2, c[2], p, &z, &imz))
            continue;
        for (int o = -1; o <= 1; o++) {
            image im = imz;
            if (look(f->sim, 1, c[1], o, &y, &im))
                add_row(f, &im, (z * f->sim->grid.ncell[1] + y) * f->sim->grid.ncell[0], c[0]);
        }
    }
#endif
}

/* loads wanted particles from *s on into the home tile, at most SPH_HOMES; advances *s */
static void load_homes(filling *f, uint32_t *s, uint32_t e)
{
    sph_thread *t = f->t;
    t->home.n = 0;
    f->homes = 0;
    while (*s < e && f->homes < SPH_HOMES) {
        uint32_t r = sph_run_end(f->b->set[0], *s, e);
        uint8_t set = f->b->set[0][*s];
        if (set == SPH_DEAD || !f->w->home(f->sim, &f->sim->set[set])) {
            *s = r;
            continue;
        }
        uint32_t n = r - *s < SPH_HOMES - f->homes ? r - *s : SPH_HOMES - f->homes;
        load(f, &no_image, &f->sim->set[set], *s, n, &t->home);
#if SPH_WITH_SOLID
        if (f->w->columns)
            load_solid(f, &no_image, &f->sim->set[set], *s, n, sph_solid_scratch_of(f->sim, t)->home.t[0] + f->homes,
                       SPH_HOMES + SPH_LANES);
#endif
        for (uint32_t j = 0; j < n; j++) {
            t->home_at[f->homes + j] = *s + j;
            t->home_set[f->homes + j] = set;
        }
        t->home.n += n;
        f->homes += n;
        *s += n;
    }
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
    for (uint32_t k = 0; k < SPH_DIM; k++)
        f->origin[k] = (sph_pos)c[k] * sim->grid.cell_size[k];
    while (s < e) {
        load_homes(f, &s, e);
        if (f->homes == 0)
            return;
        for (uint32_t a = 0; a < f->w->sums; a++)
            for (uint32_t h = 0; h < f->homes; h += 8)
                clear_eight(f->t->sum[a][h]);
        f->t->fluid.n = f->t->ghost.n = f->t->forces = 0;
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

void sph_sweep_chunk(sph_sim *sim, const sph_sweep *w, uint32_t chunk, sph_thread *t)
{
    filling f;
    f.sim = sim;
    f.w = w;
    f.t = t;
    f.b = &sim->buf[sim->dst];
    f.homes = 0;
    const sph_config *cfg = &sim->cfg;
    const bool tait = SPH_IS(cfg->eos, TAIT), standard = SPH_IS(cfg->scheme, STANDARD);
    f.usual = tait && standard && !cfg->pressure_floor && !w->needs_iv;
    uint64_t before = t->pairs;
    uint32_t cell = chunk * sim->chunk_cells, c[3], q = cell;
    const uint32_t left = sim->grid.cells - cell, last = cell + (left < sim->chunk_cells ? left : sim->chunk_cells);
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
            sweep_cell(&f, cell, c);
        for (uint32_t k = 0; k < SPH_DIM && ++c[k] == sim->grid.ncell[k]; k++)
            c[k] = k + 1 < SPH_DIM ? 0 : c[k];
    }
    t->work += t->pairs - before + sim->chunk_cells;
}
