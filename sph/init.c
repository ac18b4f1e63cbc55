/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* init.c: the life of a simulation: how many bytes it needs, sph_init, what its arena holds, the latest failure. */
#include "arithmetic.h"
#include "config.h"
#include "factors.h"
#include "sweep.h"

SPH_OBJECT(init)

size_t sph_arena_bytes(const sph_config *cfg)
{
    sph_grid grid;
    size_t bytes = 0;
    return sph_check_config(cfg, &grid, &bytes, NULL) == SPH_OK ? bytes : 0;
}

/* what is wrong with an arena that must have `need` bytes, or with the machine */
static sph_status check_arena(const void *arena, size_t bytes, size_t need, sph_report *r)
{
    const char *allowed, *broken = sph_broken_arithmetic(&allowed);
    if (broken)
        return sph_tell(r, broken, allowed, 0, SPH_ARITHMETIC);
    if (!arena || bytes < need)
        return sph_tell(r, "arena", "at least so many bytes as the value says", (double)need, SPH_ARENA_TOO_SMALL);
    if ((uintptr_t)arena % SPH_ALIGN)
        return sph_tell(r, "arena", "a multiple of SPH_ALIGN", (uint32_t)((uintptr_t)arena % SPH_ALIGN),
                        SPH_ARENA_UNALIGNED);
    return sph_tell(r, "", "", 0, SPH_OK);
}

sph_status sph_init(sph_sim **out, const sph_config *cfg, void *arena, size_t bytes, sph_report *report)
{
    sph_grid grid;
    size_t need = 0;
    if (!out)
        return sph_tell(report, "sim", "a place for the pointer", 0, SPH_BAD_ARGUMENT);
    sph_status st = sph_check_config(cfg, &grid, &need, report);
    if (st || (st = check_arena(arena, bytes, need, report)) != SPH_OK)
        return st;
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
    static const sph_report none = {SPH_BAD_ARGUMENT, "sim", "a simulation made by sph_init", "", 0,
                                    SPH_NO_PARTICLE,  SPH_MAX_SETS, SPH_ROLES};
    return sim ? &sim->report : &none;
}
