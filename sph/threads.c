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

void sph_clear_threads(sph_sim *sim)
{
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        sph_thread *s = &sim->thread[t];
        s->work = s->pairs = 0;
        s->peaks = (sph_peaks){0, 0, 0};
        s->fail = (sph_fail){SPH_OK, SPH_NO_PARTICLE, 0};
        s->crossed = s->put_back = s->reflected = s->left = s->removed = s->widest = 0;
    }
}

sph_fail sph_gather_threads(sph_sim *sim)
{
    sph_fail fail = {SPH_OK, SPH_NO_PARTICLE, 0};
    sph_peaks most = {0, 0, 0};
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        const sph_thread *s = &sim->thread[t];
        sim->work += s->work;
        sim->pairs += s->pairs;
        most.mu = s->peaks.mu > most.mu ? s->peaks.mu : most.mu;
        most.acc = s->peaks.acc > most.acc ? s->peaks.acc : most.acc;
        most.speed = s->peaks.speed > most.speed ? s->peaks.speed : most.speed;
        if (s->fail.status && (!fail.status || s->fail.particle < fail.particle))
            fail = s->fail;
        sim->next.crossed += s->crossed;
        sim->next.put_back += s->put_back;
        sim->next.reflected += s->reflected;
        sim->next.left += s->left + s->removed;
        sim->mark_cell = s->widest > sim->mark_cell ? s->widest : sim->mark_cell;
    }
    sim->peaks = most;
    sph_clear_threads(sim);
    return fail;
}
