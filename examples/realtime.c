/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* realtime.c: a tank of water inside a loop of fixed rate. Every tick has a budget of work; the kernel does a step in
   slices, and what is not done goes on in the next tick. The same bits come out whatever the slicing.

   Prints the worst tick in work units and in milliseconds, how many ticks took longer than their period, and how many
   ended with the water behind the clock.   usage: realtime [seconds [ticks a second [work units a tick]]] */
#include <stdio.h>
#include <stdlib.h>

#include "../port/posix.h"
#include "../sph/sph.h"

#define DX 0.02
#define SLICES 16u /* a tick's budget is spent in so many slices, so that a step that ends early is noticed */
static SPH_ARENA(arena, SPH_ARENA_BYTES(1200, 2000, 1, 0));

typedef struct loop {
    sph_sim *sim;
    uint64_t budget, period;      /* work units a tick, ns a tick */
    uint64_t slices, work;        /* slices of the step under way, work of the steps that are complete */
    uint64_t worst_work, worst_ns, late, behind, ticks;
} loop;

static sph_status make_tank(sph_sim **sim)
{
    const double corner[2] = {0, 0}, water[2] = {0.4, 0.3}, tank[2] = {1, 0.5};
    const sph_wall wall = sph_wall_default();
    sph_config cfg = sph_config_default();
    uint32_t set;
    cfg.spacing = DX;
    cfg.smoothing_length = 1.2 * DX;
    cfg.sound_speed = 20;
    cfg.gravity[1] = -9.81;
    cfg.max_particles = 1200;
    cfg.on_leave = SPH_REMOVE;
    cfg.on_cross = SPH_PUT_BACK;
    cfg.diffusion = SPH_HYDROSTATIC;
    for (int k = 0; k < 2; k++) {
        cfg.lo[k] = corner[k] - 4 * DX;
        cfg.hi[k] = tank[k] + 4 * DX;
    }
    sph_status st = sph_init(sim, &cfg, arena, sizeof arena, NULL);
    if (!st && !(st = sph_add_fluid(*sim, NULL, &set)) && !(st = sph_add_box(*sim, set, corner, water, NULL)))
        st = sph_add_wall_box(*sim, &wall, corner, tank, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1), true, NULL);
    return st;
}

/* work done since the beginning: of whole steps as the kernel counts it, of the step under way by its slices */
static uint64_t work_done(const loop *l) { return l->work + l->slices * (l->budget / SLICES); }

/* one tick: on to time t_end, or as far as the budget goes */
static sph_status tick(loop *l, double t_end)
{
    const uint64_t from = work_done(l), began = port_posix_clock(NULL);
    while (sph_time(l->sim) < t_end && work_done(l) - from < l->budget) {
        sph_status st = sph_step_slice(l->sim, l->budget / SLICES);
        if (st == SPH_NOT_DONE) {
            l->slices++;
            continue;
        }
        if (st)
            return st;
        sph_step_info info;
        sph_get_step(l->sim, &info);
        l->work += info.work;
        l->slices = 0;
        if (work_done(l) < from) /* the estimate by slices was above what the step took */
            break;
    }
    const uint64_t work = work_done(l) > from ? work_done(l) - from : 0, ns = port_posix_clock(NULL) - began;
    l->worst_work = work > l->worst_work ? work : l->worst_work;
    l->worst_ns = ns > l->worst_ns ? ns : l->worst_ns;
    l->late += ns > l->period;
    l->behind += sph_time(l->sim) < t_end;
    l->ticks++;
    return SPH_OK;
}

int main(int argc, char **argv)
{
    const double length = argc > 1 ? atof(argv[1]) : 2, rate = argc > 2 ? atof(argv[2]) : 50;
    loop l = {NULL, argc > 3 ? strtoull(argv[3], NULL, 10) : 2000000, 0, 0, 0, 0, 0, 0, 0, 0};
    if (!(length > 0) || !(rate >= 1 && rate <= 1000) || l.budget < SLICES) {
        fprintf(stderr, "usage: realtime [seconds > 0 [ticks a second, 1 .. 1000 [work units a tick, 16 or more]]]\n");
        return 2;
    }
    l.period = (uint64_t)(1e9 / rate);
    sph_status st = make_tank(&l.sim);
    const uint64_t start = port_posix_clock(NULL);
    for (uint64_t k = 1; !st && (double)k <= length * rate; k++) {
        st = tick(&l, (double)k / rate);
        while (port_posix_clock(NULL) < start + k * l.period)
            ; /* a real loop would sleep, or do its other duties */
    }
    if (st) {
        const sph_report *why = l.sim ? sph_last(l.sim) : NULL;
        fprintf(stderr, "realtime: %s (%s, particle %u)\n", sph_status_text(st), why ? why->what : "",
                why ? why->particle : SPH_NO_PARTICLE);
        return 1;
    }
    printf("%llu ticks of %.3g ms, %u particles, %.4g s of water\n", (unsigned long long)l.ticks, 1000 / rate,
           sph_count(l.sim), sph_time(l.sim));
    printf("worst tick: %llu of %llu work units, %.3f ms\n", (unsigned long long)l.worst_work,
           (unsigned long long)l.budget, (double)l.worst_ns * 1e-6);
    printf("missed: %llu ticks over their period, %llu ticks with the water behind the clock\n",
           (unsigned long long)l.late, (unsigned long long)l.behind);
    return 0;
}
