/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* init.c: the life of a simulation: how many bytes it needs, sph_init, what its arena holds, the latest failure. */
#include "arithmetic.h"
#include "config.h"
#include "factors.h"
#include "sweep.h"

size_t sph_arena_bytes(const sph_config *cfg)
{
    sph_grid grid;
    size_t bytes = 0;
    return sph_check_config(cfg, &grid, &bytes, NULL) == SPH_OK ? bytes : 0;
}

/* what is wrong with an arena that must have `need` bytes, or with the machine */
static sph_status check_arena(const void *arena, size_t bytes, size_t need, sph_report *r)
{
    const char *broken = sph_broken_arithmetic();
    if (broken)
        *r = (sph_report){SPH_ARITHMETIC, broken, "IEEE 754 as written", "", 0, SPH_NO_PARTICLE};
    else if (!arena || bytes < need)
        *r = (sph_report){SPH_ARENA_TOO_SMALL, "arena", "at least so many bytes as the value says", "", (double)need,
                          SPH_NO_PARTICLE};
    else if ((uintptr_t)arena % SPH_ALIGN)
        *r = (sph_report){SPH_ARENA_UNALIGNED, "arena", "a multiple of SPH_ALIGN", "",
                          (double)((uintptr_t)arena % SPH_ALIGN), SPH_NO_PARTICLE};
    return r->status;
}

sph_status sph_init(sph_sim **out, const sph_config *cfg, void *arena, size_t bytes, sph_report *report)
{
    sph_report local = SPH_NO_REPORT, *r = report ? report : &local;
    sph_grid grid;
    size_t need = 0;
    *r = SPH_NO_REPORT;
    if (!out)
        *r = (sph_report){SPH_BAD_ARGUMENT, "sim", "a place for the pointer", "", 0, SPH_NO_PARTICLE};
    if (!out || sph_check_config(cfg, &grid, &need, r) != SPH_OK || check_arena(arena, bytes, need, r) != SPH_OK)
        return r->status;
    memset(arena, 0, need);
    sph_sim *sim = sph_lay_out_arena(cfg, &grid, arena);
    sim->cfg = *cfg;
    sim->grid = grid;
    sim->arena_bytes = bytes;
    sim->arena_used = need;
    sim->report = SPH_NO_REPORT;
    sim->columns = sph_column_table;
    sph_make_factors(sim);
    sim->setup_hash = sph_hash_config(&sim->cfg);
    *out = sim;
    return SPH_OK;
}

void sph_arena_report(const sph_sim *sim, void (*fn)(void *ctx, const char *name, size_t bytes), void *ctx)
{
    if (sim && fn)
        sph_list_arena(&sim->cfg, &sim->grid, fn, ctx);
}

void sph_get_usage(const sph_sim *sim, sph_usage *out)
{
    if (!sim || !out)
        return;
    *out = (sph_usage){sim->arena_bytes, sim->arena_used,  sim->mark_particles, sim->cfg.max_particles, sim->grid.cells,
                       sim->mark_cell,   sim->mark_work,  sim->mark_slice,    sim->sets,              sim->groups};
}

const sph_report *sph_last(const sph_sim *sim)
{
    static const sph_report none = {SPH_BAD_ARGUMENT, "sim", "a simulation made by sph_init", "", 0, SPH_NO_PARTICLE};
    return sim ? &sim->report : &none;
}
