/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* world.c: configurations, steps and readings of a world that bytes drive (see world.h). */
#include "world.h"

enum { MOST_CALLS = 40, MOST_STEPS = 12, MOST_CELLS = 20000 };

static void body(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)v;
    for (int k = 0; k < SPH_DIM; k++)
        a[k] += *(const double *)ctx * (x[k] - t);
}

/* a configuration that is mostly allowed: choices from the bytes, a tank about the unit box */
static sph_config take_config(world *w)
{
    input *in = &w->in;
    sph_config c = sph_config_default();
    const uint32_t flags = (uint32_t)take(in, 1), faces = (uint32_t)take(in, 1);
    c.kernel = pick(in, SPH_KERNELS);
    c.scheme = pick(in, SPH_SCHEMES);
    c.eos = pick(in, SPH_EOSES);
    c.viscosity = pick(in, SPH_VISCOSITIES);
    c.diffusion = pick(in, SPH_DIFFUSIONS);
    c.integrator = pick(in, SPH_INTEGRATORS);
    c.on_leave = flags & 1 ? SPH_FAIL : SPH_REMOVE;
    c.on_cross = flags >> 1 & 3;
    c.xsph = flags & 8 ? 0.5 : 0;
    c.books = flags >> 4 & 1;
    c.pressure_floor = flags >> 5 & 1;
    c.shepard_every = flags & 64 ? 2 : 0;
    if (flags & 128 && !c.diffusion && !c.shepard_every)
        c.density = SPH_SUMMATION;
    c.nu = 0.01;
    c.spacing = 1.0 / (SPH_DIM == 3 ? 4 + pick(in, 3) : 4 + pick(in, 12));
    c.smoothing_length = c.spacing * (1 + 0.1 * pick(in, 10));
    c.sound_speed = 1 + take_near(in, 40);
    c.dt = faces & 128 ? take_near(in, 0.01) : 0;
    c.damping = faces & 64 ? 0.9 : 1;
    c.max_particles = SPH_DIM == 1 ? 120 : SPH_DIM == 2 ? 500 : 1200;
    c.max_threads = 2;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const uint32_t f = faces >> 2 * k & 3;
        c.lo[k] = f ? 0 : -0.4;
        c.hi[k] = f ? 1 : 1.4;
        c.face[k][0] = c.face[k][1] = f;
        c.gravity[k] = k + 1 == SPH_DIM ? -take_near(in, 20) : 0;
    }
    const uint32_t solid = pick(in, 8);
    c.shifting = solid == 7 ? 1 : 0;
    if (solid > 0 && solid < SPH_SOLIDS) {
        c.solid = solid;
        c.scheme = c.scheme % 2 ? SPH_WEAK : SPH_STANDARD;
        c.density = SPH_CONTINUITY;
        c.shepard_every = 0;
        c.yield = pick(in, SPH_YIELDS);
        c.damage = SPH_DIM > 1 ? pick(in, SPH_DAMAGES) : 0;
        c.max_flaws = pick(in, 2) ? 20000 : 40;
        c.artificial_stress = solid >= SPH_TOTAL ? 0 : pick(in, SPH_ARTIFICIAL_STRESSES);
        c.stress_exponent = 1 + pick(in, 8);
        c.xsph_strain = c.xsph > 0 && pick(in, 2);
        c.max_stretch = 1 + take_near(in, 1);
    }
    if (pick(in, 16) == 0) /* a domain of another shape */
        c.hi[pick(in, SPH_DIM)] = take_any(in);
    if (pick(in, 4) == 0) {
        w->field[0] = take_near(in, 20);
        c.body_force = body;
        c.body_ctx = &w->field[0];
    }
    return c;
}

/* chunks backwards, on two threads by turns: the order must not matter */
static void backwards(void *ctx, void (*fn)(void *arg, uint32_t chunk, uint32_t thread), void *arg, uint32_t chunks)
{
    (void)ctx;
    while (chunks-- > 0)
        fn(arg, chunks, chunks & 1);
}

/* mass, removed or not, stays what it was */
static void check_step(const world *w, double mass_before, uint32_t particles_before)
{
    sph_totals t;
    sph_step_info info;
    check_books(w->sim);
    sph_get_totals(w->sim, &t);
    sph_get_step(w->sim, &info);
    hold(sph_abs(t.mass + t.removed_mass - mass_before) <= 1e-9 * mass_before);
    hold(info.work <= most_work(w->sim, particles_before));
    hold(sph_finite(info.time) && info.dt > 0 && info.limit < SPH_LIMITS);
}

/* a step, whole or in slices, and what must hold after it */
static void step(world *w, uint64_t budget)
{
    sph_totals t;
    snapshot s;
    sph_status st = SPH_OK;
    if (w->steps++ >= MOST_STEPS)
        return;
    attempt(w, st = sph_ready(w->sim));
    if (st)
        return;
    keep_state(w->sim, &s);
    sph_get_totals(w->sim, &t);
    const uint32_t n = sph_count(w->sim);
    const bool sorted = w->sim->table_valid;
    w->sim->mark_slice = 0;
    if (budget == 0)
        st = sph_step(w->sim);
    for (uint32_t k = 0; budget > 0; k++) {
        st = sph_step_slice(w->sim, budget);
        if (st != SPH_NOT_DONE)
            break;
        hold(k < most_work(w->sim, n) && sph_hash(w->sim) == s.hash); /* every slice does a unit at least */
    }
    hold((unsigned)st < SPH_STATUS_COUNT && st != SPH_NOT_DONE);
    if (st == SPH_OK) {
        free(s.arrays);
        hold(budget == 0 || w->sim->mark_slice <= most_slice(w->sim, n, budget, sorted));
        check_step(w, t.mass + t.removed_mass, n);
    } else {
        hold(state_kept(w->sim, &s) && sph_last(w->sim)->status == st && sph_time(w->sim) == s.now.time);
    }
}

/* a step begun, touched by calls that must be refused, and given up */
static void interrupt(world *w)
{
    snapshot s;
    double x[SPH_DIM] = {0};
    uint32_t set;
    if (sph_ready(w->sim) != SPH_OK)
        return;
    keep_state(w->sim, &s);
    for (uint32_t k = pick(&w->in, 30); k > 0 && sph_step_slice(w->sim, 1) == SPH_NOT_DONE; k--)
        ;
    if (w->sim->begun) {
        hold(sph_add_particle(w->sim, 0, x, NULL, 0, NULL) == SPH_BAD_STATE);
        hold(sph_add_fluid(w->sim, NULL, &set) == SPH_BAD_STATE);
        hold(sph_remove_wall(w->sim, 0) == SPH_BAD_STATE && sph_step(w->sim) == SPH_BAD_STATE);
        hold(sph_reconfigure(w->sim, &w->cfg) == SPH_BAD_STATE);
        sph_step_cancel(w->sim);
        hold(state_kept(w->sim, &s));
    }
    free(s.arrays);
}

static void read_all(world *w)
{
    sph_particle p;
    sph_probe_value v[4];
    double x[SPH_DIM], y[SPH_DIM], low, high;
    sph_usage u;
    const uint64_t before = sph_hash(w->sim);
    for (uint32_t i = 0; i < sph_count(w->sim); i++) {
        hold(sph_get(w->sim, i, &p) == SPH_OK && p.id < w->cfg.max_particles);
        for (int k = 0; k < SPH_DIM; k++)
            hold(sph_finite(p.x[k]) && sph_finite(p.v[k]) && sph_finite(p.a[k]));
        hold(sph_finite(p.rho) && sph_finite(p.mass));
    }
    hold(sph_get(w->sim, sph_count(w->sim), &p) == SPH_BAD_ARGUMENT);
    take_point(&w->in, x, 1);
    take_point(&w->in, y, 1);
    hold((unsigned)sph_probe(w->sim, x, v) < SPH_STATUS_COUNT);
    hold((unsigned)sph_probe_line(w->sim, x, y, 4, v) < SPH_STATUS_COUNT);
    hold((unsigned)sph_gauge(w->sim, x, pick(&w->in, SPH_DIM + 1), &low) < SPH_STATUS_COUNT);
    sph_extent(w->sim, pick(&w->in, SPH_DIM + 1), &low, &high);
    sph_get_usage(w->sim, &u);
    hold(u.particles <= u.max_particles && u.sets <= SPH_MAX_SETS && u.groups <= SPH_MAX_GROUPS);
    hold(sph_hash(w->sim) == before);
}

static void change_settings(world *w)
{
    sph_config c = w->cfg;
    sph_status st = SPH_OK;
    c.dt = take_near(&w->in, 0.01);
    c.gravity[0] = take_near(&w->in, 10);
    if (pick(&w->in, 4) == 0)
        c.spacing = take_any(&w->in);
    if (pick(&w->in, 2)) {
        c.port.threads = 2;
        c.port.parallel = backwards;
    }
    attempt(w, st = sph_reconfigure(w->sim, &c));
    w->cfg = st ? w->cfg : c;
}

static void act(world *w, bool walls)
{
    const uint32_t what = pick(&w->in, 16);
    if (what < 3 || (what < 6 && !walls))
        world_add_fluid(w);
    else if (what < 6)
        world_add_wall(w);
    else if (what < 9)
        step(w, 0);
    else if (what == 9)
        step(w, 1 + take(&w->in, 2));
    else if (what == 10)
        attempt(w, sph_remove_wall(w->sim, pick(&w->in, 3)));
    else if (what == 11)
        attempt(w, sph_remove_wall_at(w->sim, pick(&w->in, 3), take_near(&w->in, 0.01)));
    else if (what == 12)
        interrupt(w);
    else if (what == 13)
        read_all(w);
    else if (what == 14)
        change_settings(w);
    else if (sph_ready(w->sim) == SPH_OK)
        attempt(w, sph_step_to(w->sim, take_near(&w->in, 0.01)));
}

void world_run(const unsigned char *data, size_t n, bool walls)
{
    static world w;
    uint32_t set;
    memset(&w, 0, sizeof w);
    w.in = (input){data, n};
    w.cfg = take_config(&w);
    w.sim = fuzz_init(&w.cfg, &w.block);
    if (w.sim && w.sim->grid.cells <= MOST_CELLS) { /* long empty domains take too many slices to wait for */
        hold(sph_add_fluid(w.sim, NULL, &set) == SPH_OK && set == 0);
        for (int k = 0; k < MOST_CALLS && w.in.n > 0; k++)
            act(&w, walls);
        read_all(&w);
        step(&w, 0);
    }
    free(w.block);
}

void SPH_NAME(fuzz_particles)(const unsigned char *data, size_t n);
void SPH_NAME(fuzz_particles)(const unsigned char *data, size_t n) { world_run(data, n, false); }
void SPH_NAME(fuzz_walls)(const unsigned char *data, size_t n);
void SPH_NAME(fuzz_walls)(const unsigned char *data, size_t n) { world_run(data, n, true); }
