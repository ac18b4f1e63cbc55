/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* config.c: any bytes as a configuration. It is refused with a name, or it gives a simulation in exactly the bytes that
   sph_arena_bytes said, which takes particles and a step without breaking a promise. */
#include "fuzz.h"

/* one number of the configuration becomes another */
static void change_field(input *in, sph_config *c)
{
    double *const numbers[] = {&c->spacing, &c->smoothing_length, &c->rho0, &c->sound_speed, &c->alpha, &c->beta,
                               &c->nu,
                               &c->delta, &c->xsph, &c->damping, &c->dt, &c->cfl, &c->viscous_factor, &c->force_factor,
                               &c->gravity_factor, &c->dt_max, &c->dt_min, &c->stress_epsilon, &c->max_stretch,
                               &c->lo[0], &c->hi[0], &c->gravity[0],
                               &c->lo[SPH_DIM - 1], &c->hi[SPH_DIM - 1], &c->gravity[SPH_DIM - 1],
                               &c->shifting};
    uint32_t *const words[] = {&c->cookie, &c->max_particles, &c->max_threads, &c->face[0][0], &c->face[0][1],
                               &c->face[SPH_DIM - 1][0], &c->face[SPH_DIM - 1][1], &c->on_leave, &c->on_cross,
                               &c->kernel,
                               &c->scheme, &c->density, &c->eos, &c->viscosity, &c->diffusion, &c->shepard_every,
                               &c->integrator, &c->port.threads, &c->solid, &c->yield, &c->damage, &c->max_flaws,
                               &c->artificial_stress, &c->stress_exponent};
    enum { NUMBERS = sizeof numbers / sizeof *numbers, WORDS = sizeof words / sizeof *words };
    const uint32_t which = pick(in, NUMBERS + 2 * WORDS);
    if (which < NUMBERS)
        *numbers[which] = pick(in, 2) ? take_any(in) : take_near(in, 2);
    else if (which < NUMBERS + WORDS)
        *words[which - NUMBERS] = pick(in, 8);
    else
        *words[which - NUMBERS - WORDS] = (uint32_t)take(in, 4);
}

static sph_config make_config(input *in)
{
    sph_config c = sph_config_default();
    const uint32_t how = pick(in, 8);
    c.max_particles = 40;
    c.spacing = 0.1;
    c.smoothing_length = 0.12;
    c.sound_speed = 10;
    for (int k = 0; k < SPH_DIM; k++)
        c.hi[k] = 1;
    if (how == 0) { /* all bytes at once, but for what C itself forbids: truth values and pointers */
        const uint32_t cookie = c.cookie;
        const size_t n = in->n < sizeof c ? in->n : sizeof c;
        memcpy(&c, in->p, n);
        in->p += n;
        in->n -= n;
        c.cookie = cookie;
        memset(&c.port, 0, sizeof c.port);
    } else {
        for (uint32_t i = pick(in, 12); i > 0; i--)
            change_field(in, &c);
    }
    const bool floor = take(in, 1) & 1, books = take(in, 1) & 1, hat = take(in, 1) & 1;
    memcpy(&c.xsph_strain, &hat, sizeof hat);
    memcpy(&c.pressure_floor, &floor, sizeof floor);
    memcpy(&c.books, &books, sizeof books);
    c.body_force = NULL;
    c.stage_log = NULL;
    c.body_ctx = c.stage_ctx = NULL;
    return c;
}

static void count_bytes(void *ctx, const char *name, size_t bytes)
{
    hold(name && name[0]);
    *(size_t *)ctx += bytes;
}

/* too little room and a crooked address are refused before a byte is written */
static void refuse_arenas(const sph_config *c, size_t bytes)
{
    sph_report r;
    sph_sim *sim = NULL;
    unsigned char *block = aligned_alloc(SPH_ALIGN, bytes + SPH_ALIGN);
    hold(block != NULL);
    memset(block, 0x5a, bytes + SPH_ALIGN);
    hold(sph_init(&sim, c, block, bytes - 1, &r) == SPH_ARENA_TOO_SMALL && r.value == (double)bytes);
    hold(sph_init(&sim, c, NULL, bytes, &r) == SPH_ARENA_TOO_SMALL);
    hold(sph_init(&sim, c, block + 8, bytes, &r) == SPH_ARENA_UNALIGNED && sim == NULL);
    for (size_t i = 0; i < bytes + SPH_ALIGN; i++)
        hold(block[i] == 0x5a);
    free(block);
}

static void live(input *in, const sph_config *c, sph_sim *sim)
{
    uint32_t set, group;
    size_t sum = 0;
    sph_usage u;
    double x[SPH_DIM], lo[SPH_DIM], hi[SPH_DIM];
    const sph_wall w = sph_wall_default();
    sph_get_usage(sim, &u);
    sph_arena_report(sim, count_bytes, &sum);
    hold(sum == u.arena_used && u.arena_used == u.arena_bytes && u.max_particles == c->max_particles);
    hold(sph_reconfigure(sim, c) == SPH_OK);
    hold(sph_step(sim) == SPH_BAD_STATE && sph_count(sim) == 0);
    if (sph_add_fluid(sim, NULL, &set) != SPH_OK)
        return;
    for (int k = 0; k < SPH_DIM; k++) {
        x[k] = c->lo[k] + 0.5 * (c->hi[k] - c->lo[k]);
        lo[k] = x[k] - 2 * c->spacing;
        hi[k] = x[k] + 2 * c->spacing;
    }
    sph_add_particle(sim, set, x, NULL, 0, NULL);
    sph_add_box(sim, set, lo, hi, NULL);
    sph_add_wall_box(sim, &w, lo, hi, 1u + (uint32_t)take(in, 1) % ((1u << 2 * SPH_DIM) - 1), true, &group);
    for (int k = 0; k < 4; k++) {
        snapshot s;
        const sph_status ready = sph_ready(sim);
        keep_state(sim, &s);
        const sph_status st = ready ? ready : sph_step(sim);
        hold((unsigned)st < SPH_STATUS_COUNT && st != SPH_NOT_DONE);
        if (st)
            hold(state_kept(sim, &s) && sph_last(sim)->status == st);
        free(st ? NULL : s.arrays);
        check_books(sim);
    }
    sph_step_info info;
    sph_probe_value v;
    double height;
    sph_get_step(sim, &info);
    hold(info.work <= most_work(sim, sim->mark_particles));
    hold(sph_probe(sim, x, &v) == SPH_OK);
    hold(sph_gauge(sim, x, pick(in, SPH_DIM), &height) == SPH_OK);
}

void SPH_NAME(fuzz_config)(const unsigned char *data, size_t n);
void SPH_NAME(fuzz_config)(const unsigned char *data, size_t n)
{
    input in = {data, n};
    sph_report r = {SPH_OK, "", "", "", 0, 0, 0, 0};
    const sph_config c = make_config(&in);
    const sph_status st = sph_config_check(&c, &r);
    const size_t bytes = sph_arena_bytes(&c);
    void *block;
    hold(st == SPH_OK || (st == SPH_BAD_CONFIG && r.status == st && r.what[0] && r.allowed[0] && bytes == 0));
    if (bytes == 0) {
        sph_sim *none = NULL;
        hold(sph_init(&none, &c, NULL, 0, &r) == SPH_BAD_CONFIG && none == NULL && r.what[0]);
        return;
    }
    sph_sim *sim = fuzz_init(&c, &block);
    if (sim) {
        refuse_arenas(&c, bytes);
        live(&in, &c, sim);
    }
    free(block);
}
