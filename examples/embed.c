/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* embed.c: the smallest program around the kernel: a column of water in a tank, in memory that is declared here. */
#include "../sph/sph.h"

static SPH_ARENA(arena, SPH_ARENA_BYTES(1600, 1000, 1, 0)); /* particles, cells, threads, what is used */

int main(void)
{
    const double dx = 0.005, corner[2] = {0, 0}, column[2] = {0.1, 0.1}, tank[2] = {0.4, 0.2};
    sph_config cfg = sph_config_default();
    cfg.spacing = dx;
    cfg.smoothing_length = 1.2 * dx;
    cfg.sound_speed = 15; /* ten times the fastest water */
    cfg.gravity[1] = -9.81;
    cfg.max_particles = 1600;
    cfg.on_leave = SPH_REMOVE;
    cfg.on_cross = SPH_PUT_BACK;
    for (int k = 0; k < 2; k++) { /* the domain holds the walls too */
        cfg.lo[k] = corner[k] - 4 * dx;
        cfg.hi[k] = tank[k] + 4 * dx;
    }

    sph_sim *sim;
    uint32_t water;
    const sph_wall wall = sph_wall_default();
    if (sph_init(&sim, &cfg, arena, sizeof arena, NULL) || sph_add_fluid(sim, NULL, &water) ||
        sph_add_box(sim, water, corner, column, NULL) ||
        sph_add_wall_box(sim, &wall, corner, tank, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1), true, NULL))
        return 1;

    while (sph_time(sim) < 0.5) {
        sph_status st = sph_step_to(sim, 0.5);
        if (st) /* sph_last(sim) names particle and cause; the state is as it was before the step */
            return (int)st;
    }
    double back, front;
    sph_extent(sim, 0, &back, &front);
    return front > 0.3 ? 0 : 1; /* the water has reached the far wall's neighbourhood */
}
