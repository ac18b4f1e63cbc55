/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* inspect.c: what looks wrong in a filled simulation, though nothing forbids it. No array: while it looks for
   neighbours the spare state buffer holds the particles' indices in order of cells. Cost: about that of a sort and a
   sweep. */
#include "locals.h"
#include "reading.h"
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(inspect)

#if SPH_WITH_INSPECT
static const char *const texts[SPH_FINDINGS] = {
#define TEXT(name, text) text,
    SPH_FINDING_LIST(TEXT)
#undef TEXT
};

static sph_finding nothing(uint32_t kind, double value, double limit)
{
    return (sph_finding){kind, texts[kind], 0, value, limit, SPH_NO_PARTICLE, SPH_NO_PARTICLE, SPH_MAX_SETS};
}

/* one particle more; the smallest id is named */
static void add_particle(sph_finding *f, const sph_buffer *b, uint32_t i, uint32_t other)
{
    f->count++;
    if (b->id[0][i] > f->particle)
        return;
    f->particle = b->id[0][i];
    f->set = b->set[0][i];
    f->other = other;
}

/* ---- neighbours ---- */

/* the particles of all cells, by index, in the spare buffer's ids; cell[] holds where each cell begins */
static const uint32_t *order_by_cell(sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    uint32_t *const at = sim->buf[(sim->cur + 1) % sim->buffers].id[0], *const start = sim->cell, sum = 0;
    sim->table_valid = false;
    memset(start, 0, ((size_t)sim->grid.cells + 1) * sizeof *start);
    for (int turn = 0; turn < 2; turn++) {
        for (uint32_t i = 0; i < sim->now.count; i++) {
            sph_pos q[SPH_DIM];
            for (uint32_t k = 0; k < SPH_DIM; k++) { /* who was put back by a wall may wait outside */
                q[k] = b->pos[k][i] < 0 ? 0 : b->pos[k][i];
                q[k] = q[k] < sim->grid.extent[k] ? q[k] : sim->grid.extent[k] - 1;
            }
            const uint32_t c = sph_cell_of(sim, q);
            if (turn == 0)
                start[c]++;
            else
                at[start[c]++] = i;
        }
        for (uint32_t c = 0; c <= sim->grid.cells && turn == 0; c++) {
            const uint32_t n = start[c];
            start[c] = sum;
            sum += n;
        }
    }
    memmove(start + 1, start, (size_t)sim->grid.cells * sizeof *start); /* ends are the next cells' starts */
    start[0] = 0;
    return at;
}

/* squared distance of two particles (m^2), the shorter way round a periodic domain */
static double shortest2(const sph_sim *sim, const sph_buffer *b, uint32_t i, uint32_t j)
{
    double r2 = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        double d = sph_abs((double)b->pos[k][i] - (double)b->pos[k][j]);
        if (SPH_IS(sim->cfg.face[k][0], PERIODIC) && 2 * d > (double)sim->grid.extent[k])
            d = (double)sim->grid.extent[k] - d;
        r2 += d * d * sim->grid.quantum * sim->grid.quantum;
    }
    return r2;
}

/* the nearest particle to i among those of a cell; not two walls */
static void look_at_cell(const sph_sim *sim, const uint32_t *at, uint32_t cell, uint32_t i, double *least, uint32_t *id)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t k = sim->cell[cell]; k < sim->cell[cell + 1]; k++) {
        const uint32_t j = at[k];
        if (j == i || b->set[0][j] == SPH_DEAD || !(sph_body_at(sim, b, i) || sph_body_at(sim, b, j)))
            continue;
        const double r2 = shortest2(sim, b, i, j);
        if (r2 < *least) {
            *least = r2;
            *id = b->id[0][j];
        }
    }
}

/* the cell at an offset of -1, 0, 1 along each axis (digits of n to the base of 3); false: there is none */
static bool cell_beside(const sph_sim *sim, uint32_t cell, uint32_t n, uint32_t *out)
{
    uint32_t stride = 1;
    *out = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++, n /= 3) {
        const uint32_t cells = sim->grid.ncell[k], c = cell % cells + n % 3; /* one more than it is */
        const bool round = SPH_IS(sim->cfg.face[k][0], PERIODIC);
        if ((c == 0 || c == cells + 1) && !round)
            return false;
        *out += (c == 0 ? cells - 1 : c == cells + 1 ? 0 : c - 1) * stride;
        cell /= cells;
        stride *= cells;
    }
    return true;
}

static sph_finding find_coincident(sph_sim *sim)
{
    const double limit = 0.3 * sim->cfg.spacing;
    const uint32_t *at = order_by_cell(sim);
    sph_finding f = nothing(SPH_FINDING_COINCIDENT, limit, limit);
    for (uint32_t cell = 0; cell < sim->grid.cells; cell++)
        for (uint32_t k = sim->cell[cell]; k < sim->cell[cell + 1]; k++) {
            uint32_t other = SPH_NO_PARTICLE, c;
            double least = limit * limit;
            if (sim->buf[sim->cur].set[0][at[k]] == SPH_DEAD)
                continue;
            for (uint32_t n = 0; n < SPH_CANDIDATE_CELLS; n++)
                if (cell_beside(sim, cell, n, &c))
                    look_at_cell(sim, at, c, at[k], &least, &other);
            if (other == SPH_NO_PARTICLE)
                continue;
            add_particle(&f, &sim->buf[sim->cur], at[k], other);
            f.value = least < f.value * f.value ? __builtin_sqrt(least) : f.value;
        }
    return f;
}

/* ---- walls, speeds, sets ---- */

static sph_finding find_in_walls(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    sph_finding f = nothing(SPH_FINDING_IN_WALL, 0, 0);
    for (uint32_t i = 0; SPH_HAS_WALLS && i < sim->now.count; i++) {
        double depth = 0;
        if (!sph_body_at(sim, b, i) || sph_inside_wall(sim, b, i, &depth) == SPH_MAX_SETS)
            continue;
        add_particle(&f, b, i, SPH_NO_PARTICLE);
        f.value = depth > f.value ? depth : f.value;
    }
    return f;
}

/* height along gravity from the lowest particle of all to the highest of a fluid, times gravity (m^2/s^2) */
static double fall(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    double low = 0, high = 0;
    bool any = false, fluid = false;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        double x[SPH_DIM], up = 0;
        if (b->set[0][i] == SPH_DEAD)
            continue;
        sph_position(sim, b, i, x);
        for (int k = 0; k < SPH_DIM; k++)
            up -= sim->cfg.gravity[k] * x[k];
        low = !any || up < low ? up : low;
        any = true;
        if (sim->set[b->set[0][i]].role != SPH_ROLE_FLUID)
            continue;
        high = !fluid || up > high ? up : high;
        fluid = true;
    }
    return fluid ? high - low : 0;
}

static sph_finding find_slow_sound(const sph_sim *sim)
{
    const double limit = 10 * __builtin_sqrt(fall(sim));
    sph_finding f = nothing(SPH_FINDING_SLOW_SOUND, limit, limit);
    for (uint32_t s = 0; s < sim->sets; s++)
        if (sim->set[s].role == SPH_ROLE_FLUID && sim->set[s].c0 < limit) {
            f.set = f.count++ ? f.set : s;
            f.value = sim->set[s].c0 < f.value ? sim->set[s].c0 : f.value;
        }
    return f;
}

static sph_finding find_fast(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    sph_finding f = nothing(SPH_FINDING_FAST, 0.1, 0.1);
    for (uint32_t i = 0; i < sim->now.count; i++) {
        double v2 = 0;
        if (!sph_body_at(sim, b, i))
            continue;
        for (int k = 0; k < SPH_DIM; k++)
            v2 += (double)b->vel[k][i] * (double)b->vel[k][i];
        const double mach = __builtin_sqrt(v2) / sim->set[b->set[0][i]].c0;
        if (!(mach > f.limit))
            continue;
        add_particle(&f, b, i, SPH_NO_PARTICLE);
        f.value = mach > f.value ? mach : f.value;
    }
    return f;
}

static sph_finding find_empty_sets(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    sph_finding f = nothing(SPH_FINDING_EMPTY_SET, 0, 1);
    for (uint32_t s = 0; s < sim->sets; s++) {
        uint32_t i = 0;
        while (i < sim->now.count && b->set[0][i] != s)
            i++;
        if (sph_is_matter(&sim->set[s]) && i == sim->now.count)
            f.set = f.count++ ? f.set : s;
    }
    return f;
}

static sph_finding find_spare(const sph_sim *sim)
{
    const uint32_t most = sim->cfg.max_particles;
    sph_finding f = nothing(SPH_FINDING_SPARE, sim->now.count, 0.5 * most);
    f.count = sim->now.count < most / 2 ? most : 0;
    return f;
}

sph_status sph_inspect(sph_sim *sim, void (*fn)(void *ctx, const sph_finding *finding), void *ctx)
{
    sph_status st = sph_setup_idle(sim, "sph_inspect");
    if (st)
        return st;
    if (!fn)
        return sph_setup_bad(sim, "fn", "a function", 0);
    sim->next = sim->now; /* where walls are */
    const sph_finding found[SPH_FINDINGS] = {find_coincident(sim), find_in_walls(sim), find_slow_sound(sim),
                                             find_fast(sim),       find_empty_sets(sim), find_spare(sim)};
    for (uint32_t k = 0; k < SPH_FINDINGS; k++)
        if (found[k].count)
            fn(ctx, &found[k]);
    return SPH_OK;
}
#endif
