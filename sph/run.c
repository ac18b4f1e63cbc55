/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* run.c: slices, threads, and what happens when a step fails.

   A step copies the scalars `now` to `next`, runs the passes of its list (integrators.c) from buffer cur into
   another, and commits by making `next` and that buffer current. Until then nothing that the next step would read has
   changed; failing is forgetting. */
#include "integrators.h"
#include "timestep.h"
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(run)

/* ---- running a program ---- */

static uint32_t thread_count(const sph_sim *sim)
{
    uint32_t t = sim->cfg.port.parallel ? sim->cfg.port.threads : 1;
    return t < 1 ? 1 : t > sim->cfg.max_threads ? sim->cfg.max_threads : t;
}

/* takes the passes of an integrator that were compiled in */
static sph_status load_program(sph_sim *sim, const sph_integrator *g)
{
    sim->integrator = g;
    sim->passes = 0;
    for (uint32_t k = 0; k < g->count - (sph_sums_density(&sim->cfg) ? 0 : g->summing); k++)
        if (g->passes[k])
            sim->program[sim->passes++] = g->passes[k];
    SPH_ASSERT(sim->passes <= SPH_MAX_PROGRAM);
    sim->pc = sim->chunk = sim->chunks = 0;
    sim->work = sim->pairs = 0;
    sim->begun = true;
    sph_clear_threads(sim);
    return SPH_OK;
}

/* cells of a chunk of a sweep; where most cells must be empty, more of them */
static uint32_t sweep_cells_of(const sph_sim *sim)
{
    return SPH_STRIPS && sim->grid.cells > sim->cfg.max_particles ? 8 * SPH_SWEEP_CHUNK : SPH_SWEEP_CHUNK;
}

/* begins the computation of the first forces; chunk_cells: how finely its sweeps and sorts can be sliced */
static sph_status begin_prime(sph_sim *sim, uint32_t chunk_cells)
{
    sim->chunk_cells = chunk_cells;
    if (sim->now.count == 0)
        return sph_error(sim, SPH_BAD_STATE, "step", "after particles were added", 0, SPH_NO_PARTICLE);
    sim->next = sim->now;
    sim->next.dt_last = 0; /* whatever remembers the step before starts anew */
    sim->dt = 0;
    sph_status st = sph_prepare(sim, sph_integrator_of(SPH_NO_INTEGRATOR));
    return st ? st : load_program(sim, sph_integrator_of(SPH_NO_INTEGRATOR));
}

static sph_status begin_step(sph_sim *sim, uint32_t chunk_cells)
{
    sim->chunk_cells = chunk_cells;
    sim->next = sim->now;
    sph_status st = sph_choose_dt(sim, sim->t_end);
    if (st)
        return st;
    sim->next.step++;
    sim->next.dt_last = sim->dt;
    const sph_integrator *g = sph_integrator_of(sim->cfg.integrator);
    return (st = sph_prepare(sim, g)) != SPH_OK ? st : load_program(sim, g);
}

typedef struct job {
    sph_sim *sim;
    uint32_t first;
} job;
static void run_job(void *arg, uint32_t chunk, uint32_t thread)
{
    const job *j = arg;
    SPH_VALIDATE(sph_poison_thread(j->sim, &j->sim->thread[thread]));
    j->sim->program[j->sim->pc]->run(j->sim, j->first + chunk, &j->sim->thread[thread]);
}

/* runs chunks [chunk, chunk + n) of the current pass */
static void run_chunks(sph_sim *sim, uint32_t n)
{
    job j = {sim, sim->chunk};
    if (n > 1 && thread_count(sim) > 1)
        sim->cfg.port.parallel(sim->cfg.port.ctx, run_job, &j, n);
    else
        for (uint32_t c = 0; c < n; c++)
            run_job(&j, c, 0);
    sim->chunk += n;
}

/* what a pass may fail of, by status from SPH_NOT_FINITE on: the quantity; and of SPH_OUT_OF_DOMAIN by face */
static const char *const quantities[] = {"a rate or a squared magnitude", "relative density excess",
                                         "x from the domain's low corner (m)",
                                         "cells moved", "depth inside the wall (m)",
                                         SPH_HAS_TOTAL ? "length of a bond (m)" : "",
#if SPH_WITH_ENERGY
                                         "energy (J/kg)",
#endif
};
static const char *const faces[] = {"x beyond the low face (m)", "x beyond the high face (m)",
#if SPH_DIM > 1
                                    "y beyond the low face (m)", "y beyond the high face (m)",
#endif
#if SPH_DIM > 2
                                    "z beyond the low face (m)", "z beyond the high face (m)",
#endif
};
_Static_assert(SPH_BOND_TOO_LONG + SPH_WITH_ENERGY - SPH_NOT_FINITE + 1 == sizeof quantities / sizeof *quantities,
               "one a status");

static sph_status report_fail(sph_sim *sim, const sph_fail *f)
{
    const uint32_t out = (uint32_t)f->status - SPH_OUT_OF_FACE;
    if (SPH_WITH_DETAILS && out < 2 * SPH_DIM)
        return sph_error(sim, SPH_OUT_OF_DOMAIN, faces[out], "", f->value, f->particle);
    return sph_error(sim, f->status, quantities[f->status - SPH_NOT_FINITE], "", f->value, f->particle);
}

static sph_status end_pass(sph_sim *sim)
{
    const sph_pass *p = sim->program[sim->pc];
    sph_fail fail = sph_gather_threads(sim);
    if (fail.status)
        return report_fail(sim, &fail);
    sph_status st = p->end ? p->end(sim) : SPH_OK;
    if (st)
        return st;
    if (SPH_WITH_STAGE_LOG && sim->cfg.stage_log)
        sim->cfg.stage_log(sim->cfg.stage_ctx, sim->next.step, p->name,
                           sph_hash_buffer(sim, &sim->buf[sim->dst], sim->next.count));
    sim->pc++;
    sim->chunk = sim->chunks = 0;
    return SPH_OK;
}

/* mass of the fluid that buffer b has, set by set; the dead have none */
static double fluid_mass(const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    double mass = 0;
    for (uint32_t s = 0; s < sim->sets; s++) {
        uint32_t count = 0;
        if (!sph_is_matter(&sim->set[s]))
            continue;
        for (uint32_t i = 0; i < n; i++)
            count += b->set[0][i] == s;
        mass += count * sim->set[s].mass;
    }
    return mass;
}

static void commit(sph_sim *sim)
{
    const bool prime = sim->next.step == sim->now.step;
    if (sim->next.left != sim->now.left)
        sim->next.removed_mass += fluid_mass(sim, &sim->buf[sim->cur], sim->now.count + sph_newcomers(sim)) -
                                  fluid_mass(sim, &sim->buf[sim->dst], sim->next.count);
    sim->next.primed = true;
    sim->next.started |= !prime;
    sim->now = sim->next;
    sim->cur = sim->dst;
    sim->table_valid = true;
    sim->begun = false;
    if (!prime) {
        sim->last_passes = sim->passes;
        sim->last_work = sim->work;
        sim->last_pairs = sim->pairs;
        sim->last_limit = sim->limit;
        sim->last_dt = sim->dt;
        sim->mark_work = sim->work > sim->mark_work ? sim->work : sim->mark_work;
    }
}

/* work units of the pass under way */
static uint64_t pass_work(const sph_sim *sim)
{
    uint64_t w = 0;
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++)
        w += sim->thread[t].work;
    return w;
}

/* the chunks of the current pass that are left, or as many as the budget takes; adds to *spent */
static sph_status run_pass(sph_sim *sim, uint64_t budget, uint64_t *spent)
{
    const sph_pass *p = sim->program[sim->pc];
    if (p->wanted && !p->wanted(sim)) {
        sim->pc++;
        return SPH_OK;
    }
    if (sim->chunk == 0)
        sim->chunks = p->chunks ? p->chunks(sim) : 0;
    while (sim->chunk < sim->chunks) {
        uint32_t n = sim->chunks - sim->chunk;
        if (budget) {
            if (*spent >= budget)
                return SPH_NOT_DONE;
            n = n < thread_count(sim) ? n : thread_count(sim);
        }
        const uint64_t before = pass_work(sim);
        run_chunks(sim, n);
        *spent += pass_work(sim) - before;
    }
    sph_status st = end_pass(sim);
    if (st)
        sim->begun = false; /* a failed step is forgotten: cur, now and the buffer cur were never written */
    return st;
}

/* Runs the program until its end (budget 0) or until about `budget` units are spent. */
static sph_status run_program(sph_sim *sim, uint64_t budget)
{
    uint64_t spent = 0;
    sph_status st = SPH_OK;
    while (!st && sim->pc < sim->passes)
        st = run_pass(sim, budget, &spent);
    if (budget && spent > sim->mark_slice)
        sim->mark_slice = spent;
    if (!st)
        commit(sim);
    return st;
}

/* ---- entry points ---- */

sph_status sph_ready(sph_sim *sim)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "sph_ready", "between steps", 0, SPH_NO_PARTICLE);
    if (sim->now.primed)
        return SPH_OK;
    sph_status st = begin_prime(sim, sweep_cells_of(sim));
    return st ? st : run_program(sim, 0);
}

static sph_status advance(sph_sim *sim, double t_end, uint64_t budget)
{
    sph_status st = SPH_OK;
    if (!sim->begun) {
        const uint32_t cells = budget ? SPH_SLICE_CHUNK : sweep_cells_of(sim);
        sim->t_end = t_end;
        st = sim->now.primed ? begin_step(sim, cells) : begin_prime(sim, cells);
        if (st)
            return st;
    }
    return run_program(sim, budget);
}

sph_status sph_step_to(sph_sim *sim, double t_end)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "sph_step", "after the step begun in slices", 0, SPH_NO_PARTICLE);
    if (!(t_end > sim->now.time))
        return sph_error(sim, SPH_BAD_ARGUMENT, "t_end", "after the present time", t_end, SPH_NO_PARTICLE);
    sph_status st = sph_ready(sim);
    return st ? st : advance(sim, t_end, 0);
}

sph_status sph_step(sph_sim *sim) { return sph_step_to(sim, 1e300); }

sph_status sph_step_slice(sph_sim *sim, uint64_t budget)
{
    if (!sim || budget == 0)
        return sph_error(sim, SPH_BAD_ARGUMENT, "budget", "> 0", 0, SPH_NO_PARTICLE);
    const uint64_t step = sim->now.step;
    sph_status st = advance(sim, 1e300, budget);
    if (st || sim->now.step != step)
        return st;
    st = begin_step(sim, SPH_SLICE_CHUNK); /* these were the first forces: the step is to come */
    return st ? st : SPH_NOT_DONE;
}

void sph_step_cancel(sph_sim *sim)
{
    if (sim)
        sim->begun = false;
}

double sph_time(const sph_sim *sim) { return sim ? sim->now.time : 0; }

/* rho/rho0 of the fluid */
static void find_densities(const sph_sim *sim, sph_step_info *out)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    sph_real low = 99, high = -1;
    for (uint32_t i = 0, e; i < sim->now.count; i = e) {
        e = sph_run_end(b->set[0], i, sim->now.count);
        const bool fluid = b->set[0][i] != SPH_DEAD && sim->set[b->set[0][i]].role == SPH_ROLE_FLUID;
        for (uint32_t j = i; j < e && fluid; j++) {
            low = b->rho[0][j] < low ? b->rho[0][j] : low;
            high = b->rho[0][j] > high ? b->rho[0][j] : high;
        }
    }
    out->thinnest = high < low ? 0 : 1 + (double)low;
    out->densest = high < low ? 0 : 1 + (double)high;
}

void sph_get_step(const sph_sim *sim, sph_step_info *out)
{
    if (!sim || !out)
        return;
    memset(out, 0, sizeof *out);
    out->step = sim->now.step;
    out->time = sim->now.time;
    out->dt = sim->last_dt;
    out->limit = sim->last_limit;
    sph_find_limits(sim, out->limit_dt);
    out->pairs = sim->last_pairs;
    out->work = sim->last_work;
    out->passes = sim->last_passes;
    out->left = sim->now.left;
    out->crossed = sim->now.crossed;
    out->put_back = sim->now.put_back;
    out->reflected = sim->now.reflected;
    if (SPH_WITH_DETAILS)
        find_densities(sim, out);
}
