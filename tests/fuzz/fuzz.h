/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fuzz.h: what the fuzz targets share: numbers out of a string of bytes, an arena that ends where the sanitizer looks,
   and a copy of the whole committed state to compare with after a call that failed. Compiled once for each build. */
#ifndef SPH_FUZZ_H
#define SPH_FUZZ_H

#include <stdio.h>
#include <stdlib.h>

#include "tests/state.h"

/* what must hold for any input; a fuzzer takes the abort for a finding */
#define hold(cond)                                                                                          \
    do {                                                                                                    \
        if (!(cond)) {                                                                                      \
            fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #cond);                       \
            abort();                                                                                        \
        }                                                                                                   \
    } while (0)

/* ---- bytes ---- */

typedef struct input {
    const unsigned char *p;
    size_t n;
} input;

/* n <= 8 bytes as a number; zeros behind the end */
static UNUSED uint64_t take(input *b, uint32_t n)
{
    uint64_t v = 0;
    for (uint32_t i = 0; i < n && b->n; i++, b->n--)
        v |= (uint64_t)*b->p++ << 8 * i;
    return v;
}
static UNUSED uint32_t pick(input *b, uint32_t count) { return (uint32_t)take(b, 1) % count; }

static UNUSED double as_double(uint64_t u)
{
    double d;
    memcpy(&d, &u, sizeof d);
    return d;
}

/* any double at all, the odd ones often */
static UNUSED double take_any(input *b)
{
    static const double odd[] = {0.0, -0.0, 1, -1, 0.5, 1e-3, 1e3, 1e15, -1e15, 1e30, -1e30, 1e38, 3.5e38, 1e300,
                                 -1e300,
                                 1.7976931348623157e308, 5e-324, 1e-310, 2.2250738585072014e-308, 1e-30,
                                     2.220446049250313e-16};
    const uint32_t how = pick(b, 32);
    if (how < sizeof odd / sizeof *odd)
        return odd[how];
    switch (how) {
    case 25: return __builtin_nan("");
    case 26: return __builtin_inf();
    case 27: return -__builtin_inf();
    default: return as_double(take(b, 8));
    }
}

/* a number about 0..scale, in 1/200 of it; seldom any double */
static UNUSED double take_near(input *b, double scale)
{
    const uint32_t u = (uint32_t)take(b, 1);
    return u == 255 ? take_any(b) : u == 254 ? (double)take(b, 2) / 65536 * scale : ((double)u - 27) / 200 * scale;
}
static UNUSED void take_point(input *b, double *x, double scale)
{
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = take_near(b, scale);
}

/* ---- the arena ---- */

#define FUZZ_ARENA (SPH_DIM == 3 ? 3u << 20 : 3u << 19) /* larger simulations are not made */

/* a simulation in a block of exactly the bytes that it asked for; null if it was refused or is too large */
static UNUSED sph_sim *fuzz_init(const sph_config *c, void **block)
{
    sph_sim *sim = NULL;
    sph_report r;
    const size_t bytes = sph_arena_bytes(c);
    *block = NULL;
    if (bytes == 0 || bytes > FUZZ_ARENA)
        return NULL;
    hold(bytes % SPH_ALIGN == 0);
    *block = aligned_alloc(SPH_ALIGN, bytes);
    if (!*block)
        return NULL;
    memset(*block, 0xa5, bytes);
    hold(sph_init(&sim, c, *block, bytes, &r) == SPH_OK && sim != NULL);
    return sim;
}

/* ---- what holds after any step ---- */

/* the bounds that sph.h states for the work of a step, and of a slice of one, with every particle in one slab; sorted:
   the table of cells was good when the step began */
static UNUSED uint64_t most_work(const sph_sim *sim, uint64_t n)
{
    const sph_config *c = &sim->cfg;
    const bool rk = c->integrator >= SPH_RUNGE_KUTTA;
    const uint64_t forces = c->integrator == SPH_PREDICTOR_CORRECTOR ? 1 : 2;
    const uint64_t sums = c->density == SPH_SUMMATION ? (rk ? 4u : 1u) : sph_filters(c) ? (rk ? 2u : 1u) : 0;
    const uint64_t forms = 2u * sph_stabilises(c) + sph_normalises(c) + sph_resists_hourglass(c);
    const uint64_t each = 1u + sim->has_adami + sph_corrects(c) + sph_corrects_fluids(c) + sph_smooths_strain(c) +
                          sph_shears(c) + sph_takes_density_gradient(c) + forms;
    return SPH_STEP_WORK(forces * each + sums, n, sim->mark_cell, sim->grid.cells);
}
static UNUSED uint64_t most_slice(const sph_sim *sim, uint64_t n, uint64_t budget, bool sorted)
{
    const uint64_t threads = sim->cfg.port.parallel ? 2 : 1, all = n + sim->grid.cells;
    const uint64_t extra = SPH_SLICE_EXTRA(threads, sim->grid.slabs, n, sim->grid.slab_cells, (uint64_t)sim->mark_cell);
    return budget + (sorted || extra > all ? extra : all);
}

static UNUSED void check_books(const sph_sim *sim)
{
    sph_totals t;
    sph_get_totals(sim, &t);
    hold(sph_finite(t.mass) && t.mass >= 0 && sph_finite(t.removed_mass) && t.removed_mass >= 0);
    hold(sph_finite(t.max_speed) && sph_finite(t.kinetic));
    for (int k = 0; k < SPH_DIM; k++)
        hold(sph_finite(t.momentum[k]));
    hold(t.fluid + t.wall <= sph_count(sim) && sph_count(sim) <= sim->cfg.max_particles);
}

#endif
