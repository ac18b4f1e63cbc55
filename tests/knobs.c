/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* knobs.c: what a build with knobs off is asked to run (knobs.sh): a free block of inviscid water, which every build
   has, as the line `least`; then the golden cases. Exits with 0 if nothing was refused. */
#include <stdio.h>

#include "sph/sph.h"

int SPH_NAME(golden)(void);

static SPH_ARENA(arena, 1u << 20);

/* 6 particles along each axis, drawing together */
static sph_status least(uint64_t *hash)
{
    sph_config c = sph_config_default();
    sph_sim *sim;
    uint32_t set, all = 1;
    double x[SPH_DIM], v[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = -4;
        c.hi[k] = 8;
        all *= 6;
    }
    c.spacing = 0.25;
    c.smoothing_length = 0.3;
    c.sound_speed = 30;
    c.gravity[0] = 3;
    c.viscosity = SPH_INVISCID;
    c.max_particles = all;
    sph_status st = sph_init(&sim, &c, arena, sizeof arena, NULL);
    if (!st)
        st = sph_add_fluid(sim, NULL, &set);
    for (uint32_t i = 0; !st && i < all; i++) {
        for (uint32_t k = 0, rest = i; k < SPH_DIM; k++, rest /= 6) {
            x[k] = 0.25 * (rest % 6);
            v[k] = -x[k];
        }
        st = sph_add_particle(sim, set, x, v, 0, NULL);
    }
    if (!st)
        st = sph_ready(sim);
    for (int k = 0; !st && k < 8; k++)
        st = sph_step(sim);
    *hash = st ? 0 : sph_hash(sim);
    return st;
}

int main(void)
{
    uint64_t hash;
    const sph_status st = least(&hash);
    printf("%d%c,least,", SPH_DIM, SPH_DOUBLE ? 'd' : 'f');
    if (st)
        printf("failed: %s\n", sph_status_text(st));
    else
        printf("%08lx%08lx\n", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffffu));
    return SPH_NAME(golden)() || st ? 1 : 0;
}
