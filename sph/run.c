/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* run.c: the time step, slices, threads, and what happens when a step fails.

   A step copies the scalars `now` to `next`, runs the passes of its list (step.c) from buffer cur into another, and commits by
   making `next` and that buffer current. Until then nothing that the next step would read has changed; failing is
   forgetting. */
#include "fluid.h"

/* ---- failures seen by threads ---- */

void sph_fail_note(sph_thread *t, sph_status s, uint32_t id, double value)
{
    if (t->fail.status == SPH_OK || id < t->fail.particle)
        t->fail = (sph_fail){s, id, value};
}

/* ---- time step ---- */

static double fastest_sound(const sph_sim *sim)
{
    double c = sim->cfg.sound_speed;
    for (uint32_t s = 0; s < sim->sets; s++) {
        const sph_set *set = &sim->set[s];
        double own = set->c0;
        if (sph_is_solid(set)) /* waves along the way of their motion (Gray 2001 eq 5.52) */
            own = __builtin_sqrt(own * own + 4 * sph_material_of(sim, set)->shear / (3 * set->rho0));
        c = own > c ? own : c;
    }
    return SPH_IS(sim->cfg.eos, TAIT_GRAY) ? c * 2.6457513110645905905 : c; /* sqrt 7 */
}

/* what each limit allows after a force sweep (Gray 2001 eq 2.30, Wickramarachchi 2009 eqs 3.88-3.90) */
static void find_limits(const sph_sim *sim, double *l)
{
    const sph_config *c = &sim->cfg;
    const double h = c->smoothing_length, c0 = fastest_sound(sim), a = (double)sim->now.peaks.acc;
    double nu = SPH_IS(c->viscosity, MORRIS) ? c->nu : sph_viscous(c->viscosity) ? c->alpha * c0 * h / (2 * (SPH_DIM + 2)) : 0, g = 0;
    for (int k = 0; k < SPH_DIM; k++)
        g += c->gravity[k] * c->gravity[k];
    g = __builtin_sqrt(g);
    memset(l, 0, SPH_LIMITS * sizeof *l);
    l[SPH_LIMIT_FIXED] = c->dt;
    if (c->dt > 0)
        return;
    l[SPH_LIMIT_COURANT] = sim->courant * h / (c0 + h * (double)sim->now.peaks.mu);
    if (nu > 0)
        l[SPH_LIMIT_VISCOUS] = c->viscous_factor * h * h / nu;
    if (a > 0)
        l[SPH_LIMIT_FORCE] = c->force_factor * __builtin_sqrt(h / a);
    l[SPH_LIMIT_GRAVITY] = g > 0 ? c->gravity_factor * h / (c0 + __builtin_sqrt(g * h)) : 0;
    l[SPH_LIMIT_CEILING] = c->dt_max;
}

static sph_status choose_dt(sph_sim *sim, double t_end)
{
    double dt = 1e300;
    find_limits(sim, sim->limit_dt);
    for (uint32_t k = 0; k < SPH_LIMITS; k++)
        if (sim->limit_dt[k] > 0 && sim->limit_dt[k] < dt) {
            dt = sim->limit_dt[k];
            sim->limit = k;
        }
    if (!(dt > 0) || dt < sim->cfg.dt_min || sim->now.time + dt == sim->now.time)
        return sph_error(sim, SPH_STEP_COLLAPSED, sph_limit_text(sim->limit), "a step above dt_min", dt,
                         SPH_NO_PARTICLE);
    if (t_end - sim->now.time <= dt * (1 + 1e-9)) {
        dt = t_end - sim->now.time;
        sim->limit = SPH_LIMIT_TARGET;
        sim->next.time = t_end;
    } else {
        sim->next.time = sim->now.time + dt;
    }
    sim->dt = dt;
    return SPH_OK;
}

/* ---- running a program ---- */

static uint32_t thread_count(const sph_sim *sim)
{
    uint32_t t = sim->cfg.port.parallel ? sim->cfg.port.threads : 1;
    return t < 1 ? 1 : t > sim->cfg.max_threads ? sim->cfg.max_threads : t;
}

static void clear_threads(sph_sim *sim)
{
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        sph_thread *s = &sim->thread[t];
        s->work = s->pairs = 0;
        s->peaks = (sph_peaks){0, 0, 0};
        s->fail = (sph_fail){SPH_OK, SPH_NO_PARTICLE, 0};
        s->crossed = s->put_back = s->reflected = s->left = s->removed = s->widest = 0;
    }
}

static sph_status load_program(sph_sim *sim, const sph_pass *const *p)
{
    sim->passes = 0;
    for (; *p; p++)
        sim->program[sim->passes++] = *p;
    sim->pc = sim->chunk = sim->chunks = 0;
    sim->work = sim->pairs = 0;
    sim->begun = true;
    clear_threads(sim);
    return SPH_OK;
}

static sph_status move_groups(sph_sim *sim, double t)
{
#if SPH_HAS_GROUPS
    return sph_move_groups(sim, t);
#else
    (void)sim, (void)t;
    return SPH_OK;
#endif
}

/* begins the computation of the first forces; chunk_cells: how finely its sweeps and sorts can be sliced */
static sph_status begin_prime(sph_sim *sim, uint32_t chunk_cells)
{
    sim->chunk_cells = chunk_cells;
    if (sim->now.count == 0)
        return sph_error(sim, SPH_BAD_STATE, "step", "after particles were added", 0, SPH_NO_PARTICLE);
    sim->next = sim->now;
    sim->dt = 0;
    sph_status st = move_groups(sim, sim->now.time);
    return st ? st : load_program(sim, sph_prime_program());
}

static sph_status begin_step(sph_sim *sim, uint32_t chunk_cells)
{
    sim->chunk_cells = chunk_cells;
    sim->next = sim->now;
    sph_status st = choose_dt(sim, sim->t_end);
    if (st)
        return st;
    sim->next.step++;
    sim->next.dt_last = sim->dt;
    if ((st = move_groups(sim, sim->next.time)) != SPH_OK)
        return st;
    return load_program(sim, sph_program_of(sim->cfg.integrator));
}

typedef struct job {
    sph_sim *sim;
    uint32_t first;
} job;
static void run_job(void *arg, uint32_t chunk, uint32_t thread)
{
    const job *j = arg;
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

/* adds up what the threads saw in a pass and starts them afresh; none of it depends on order */
static sph_fail gather_threads(sph_sim *sim)
{
    sph_fail fail = {SPH_OK, SPH_NO_PARTICLE, 0};
    sph_peaks peaks = {0, 0, 0};
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        const sph_thread *s = &sim->thread[t];
        sim->work += s->work;
        sim->pairs += s->pairs;
        peaks.mu = s->peaks.mu > peaks.mu ? s->peaks.mu : peaks.mu;
        peaks.acc = s->peaks.acc > peaks.acc ? s->peaks.acc : peaks.acc;
        peaks.speed = s->peaks.speed > peaks.speed ? s->peaks.speed : peaks.speed;
        if (s->fail.status && (!fail.status || s->fail.particle < fail.particle))
            fail = s->fail;
        sim->next.crossed += s->crossed;
        sim->next.put_back += s->put_back;
        sim->next.reflected += s->reflected;
        sim->next.left += s->left + s->removed;
        sim->mark_cell = s->widest > sim->mark_cell ? s->widest : sim->mark_cell;
    }
    if (sim->program[sim->pc] == &sph_pass_force)
        sim->next.peaks = peaks;
    clear_threads(sim);
    return fail;
}

static const char *fail_quantity(sph_status s)
{
    switch (s) {
    case SPH_NOT_FINITE: return "a rate or a squared magnitude";
    case SPH_DENSITY_LOST: return "relative density excess";
    case SPH_OUT_OF_DOMAIN: return "x from the domain's low corner (m)";
    case SPH_MOVED_TOO_FAR: return "cells moved in one step";
    case SPH_WALL_CROSSED: return "depth inside the wall (m)";
#if SPH_HAS_TOTAL
    case SPH_BOND_TOO_LONG: return "length of a bond (m)";
#endif
    default: return "";
    }
}

static sph_status end_pass(sph_sim *sim)
{
    const sph_pass *p = sim->program[sim->pc];
    sph_fail fail = gather_threads(sim);
    if (fail.status)
        return sph_error(sim, fail.status, fail_quantity(fail.status), "", fail.value, fail.particle);
    sph_status st = p->end ? p->end(sim) : SPH_OK;
    if (st)
        return st;
#if SPH_WITH_STAGE_LOG
    if (sim->cfg.stage_log)
        sim->cfg.stage_log(sim->cfg.stage_ctx, sim->next.step, p->name,
                           sph_hash_buffer(sim, &sim->buf[sim->dst], sim->next.count));
#endif
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
        if (!sph_is_body(&sim->set[s]))
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
        sim->next.removed_mass += fluid_mass(sim, &sim->buf[sim->cur], sim->now.count) -
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
    sph_status st = begin_prime(sim, SPH_SWEEP_CHUNK);
    return st ? st : run_program(sim, 0);
}

static sph_status advance(sph_sim *sim, double t_end, uint64_t budget)
{
    sph_status st = SPH_OK;
    if (!sim->begun) {
        const uint32_t cells = budget ? SPH_SLICE_CHUNK : SPH_SWEEP_CHUNK;
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
    /* preparing the first forces is not a step: there is one to come */
    return st == SPH_OK && sim->now.step == step ? SPH_NOT_DONE : st;
}

void sph_step_cancel(sph_sim *sim)
{
    if (sim)
        sim->begun = false;
}

double sph_time(const sph_sim *sim) { return sim ? sim->now.time : 0; }

void sph_get_step(const sph_sim *sim, sph_step_info *out)
{
    if (!sim || !out)
        return;
    memset(out, 0, sizeof *out);
    out->step = sim->now.step;
    out->time = sim->now.time;
    out->dt = sim->last_dt;
    out->limit = sim->last_limit;
    find_limits(sim, out->limit_dt);
    out->pairs = sim->last_pairs;
    out->work = sim->last_work;
    out->passes = sim->last_passes;
    out->left = sim->now.left;
    out->crossed = sim->now.crossed;
    out->put_back = sim->now.put_back;
    out->reflected = sim->now.reflected;
}
