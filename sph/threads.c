/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* threads.c: what the threads of a pass see: failures, peaks, work, counts. None of it depends on how many threads
   there are. */
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(threads)

void sph_fail_note(sph_thread *t, sph_status s, uint32_t id, double value)
{
    if (t->fail.status == SPH_OK || id < t->fail.particle)
        t->fail = (sph_fail){s, id, value};
}

/* 2^-40 of a particle's rho0 dx^SPH_DIM c0^2 */
static double energy_step(const sph_sim *sim)
{
    double volume = 1;
    for (int k = 0; k < SPH_DIM; k++)
        volume *= sim->cfg.spacing;
    return sim->cfg.rho0 * volume * sim->cfg.sound_speed * sim->cfg.sound_speed / 1099511627776.0;
}

void sph_carry_off(const sph_sim *sim, const sph_buffer *b, uint32_t i, sph_thread *t)
{
    if (!sph_keeps_books(&sim->cfg))
        return;
    const double most = 4e18, e = sph_energy_sum(sim, b, i) / energy_step(sim);
    t->carried_off += (uint64_t)(int64_t)(e > most ? most : e > -most ? e : -most); /* not a number: -most */
}

void sph_clear_threads(sph_sim *sim)
{
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        sph_thread *s = &sim->thread[t];
        s->work = s->pairs = 0;
        s->peaks = (sph_peaks){0, 0, 0};
        s->fail = (sph_fail){SPH_OK, SPH_NO_PARTICLE, 0};
        if (SPH_WITH_BOOKS)
            s->carried_off = 0;
        s->crossed = s->put_back = s->reflected = s->left = s->removed = s->widest = 0;
    }
}

sph_fail sph_gather_threads(sph_sim *sim)
{
    sph_fail fail = {SPH_OK, SPH_NO_PARTICLE, 0};
    sph_peaks most = {0, 0, 0};
    uint64_t carried_off = 0;
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        const sph_thread *s = &sim->thread[t];
        sim->work += s->work;
        sim->pairs += s->pairs;
        most.mu = s->peaks.mu > most.mu ? s->peaks.mu : most.mu;
        most.acc = s->peaks.acc > most.acc ? s->peaks.acc : most.acc;
        most.speed = s->peaks.speed > most.speed ? s->peaks.speed : most.speed;
        if (s->fail.status && (!fail.status || s->fail.particle < fail.particle))
            fail = s->fail;
        carried_off += SPH_WITH_BOOKS ? s->carried_off : 0;
        sim->next.crossed += s->crossed;
        sim->next.put_back += s->put_back;
        sim->next.reflected += s->reflected;
        sim->next.left += s->left + s->removed;
        sim->mark_cell = s->widest > sim->mark_cell ? s->widest : sim->mark_cell;
    }
    if (SPH_WITH_BOOKS && carried_off)
        sim->next.carried_off += (double)(int64_t)carried_off * energy_step(sim);
    sim->peaks = most;
    sph_clear_threads(sim);
    return fail;
}
