/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* plate.h: what the plates in tension share (tension.c, brittle.c; Gray 2001, section 6.4). A plate L x H about the
   origin, drawn at both ends along x; set 0 is its middle. */
#ifndef EXAMPLES_PLATE_H
#define EXAMPLES_PLATE_H

#include "solid.h"
#if SPH_DIM == 2

enum { PLATE_LENGTH = SOLID_COMMON, PLATE_HEIGHT, PLATE_N, PLATE_END, PLATE_ACCELERATION, PLATE_SPEED, PLATE_GRIP,
       PLATE_CLAMP, PLATE_DURATION, PLATE_COMMON };

#define PLATE_PARAMS(n_, acceleration_, speed_, duration_)                                                             \
    {"length", "cm", "length of the plate", 3, 0.1, 1e4, SCENE_NUMBER},                                                \
    {"height", "cm", "its height", 1, 0.1, 1e4, SCENE_NUMBER},                                                         \
    {"n", "-", "particles across the height", n_, 4, 1000, SCENE_WHOLE},                                               \
    {"end", "cm", "length of either end", 0.2, 0, 1e3, SCENE_NUMBER},                                                  \
    {"acceleration", "c0^2/cm", "of either end, outwards", acceleration_, 0, 1, SCENE_NUMBER},                         \
    {"speed", "c0", "of either end, outwards", speed_, 0, 0.1, SCENE_NUMBER},                                          \
    {"grip", "-", "what is held along x only or fully: x both", 0, 0, 1, SCENE_CHOICE},                                \
    {"clamp", "-", "held are the ends, or one column on their face (solid_clamp): ends ideal", 0, 0, 1,               \
     SCENE_CHOICE},                                                                                                    \
    {"duration", "cm/c0", "length of the run", duration_, 0, 1e6, SCENE_NUMBER}

static inline double plate_spacing(const double *p) { return p[PLATE_HEIGHT] / p[PLATE_N]; }

/* how far an end has gone at time t */
static inline double plate_drawn(const double *p,
                                 double t) { return p[PLATE_SPEED] * t + 0.5 * p[PLATE_ACCELERATION] * t * t; }

/* motion of the right end; ctx: the scene's parameters */
static inline void plate_motion(void *ctx, double t, double *displacement, double *velocity)
{
    const double *p = ctx;
    displacement[0] = plate_drawn(p, t);
    velocity[0] = p[PLATE_SPEED] + p[PLATE_ACCELERATION] * t;
    displacement[1] = velocity[1] = 0;
}
static inline void plate_motion_left(void *ctx, double t, double *displacement, double *velocity)
{
    plate_motion(ctx, t, displacement, velocity);
    displacement[0] = -displacement[0];
    velocity[0] = -velocity[0];
}

/* length of an end in whole spacings, for the lattice's sake */
static inline double plate_end(const double *p)
{
    const double dx = plate_spacing(p), n = (double)(uint32_t)(p[PLATE_END] / dx + 0.5);
    return (n < 1 ? 1 : n) * dx;
}

static inline sph_config plate_config(const double *p)
{
    const double dx = plate_spacing(p), lo[2] = {-0.5 * p[PLATE_LENGTH], -0.5 * p[PLATE_HEIGHT]}, hi[2] = {-lo[0],
        -lo[1]};
    sph_config c = solid_config(p, dx);
    c.max_particles = scene_capacity(scene_box_count(lo, hi, dx) + 4 * p[PLATE_N]);
    c.max_sets = 5;
    c.hi[0] = hi[0] + plate_drawn(p, p[PLATE_DURATION]) + 0.2 * p[PLATE_LENGTH];
    c.hi[1] = hi[1] + 0.5 * p[PLATE_HEIGHT];
    for (int k = 0; k < 2; k++)
        c.lo[k] = -c.hi[k];
    return c;
}

/* A set of the plate's particles with x from a to b. side: 0: moved by forces; -1, 1: held as the left or right end
   is. */
static inline sph_status plate_add(sph_sim *sim, const double *p, const sph_solid *material, double a, double b,
                                   int side,
                                   uint32_t *set)
{
    sph_solid m = *material;
    const double lo[2] = {a, -0.5 * p[PLATE_HEIGHT]}, hi[2] = {b, 0.5 * p[PLATE_HEIGHT]};
    if (side) {
        m = p[PLATE_CLAMP] != 0 ? solid_clamp(&m, 1) : m;
        m.held = p[PLATE_GRIP] != 0 ? 3 : 1;
        m.motion = side < 0 ? plate_motion_left : plate_motion;
        m.motion_ctx = (void *)(uintptr_t)p;
    }
    const sph_status st = sph_add_solid(sim, &m, set, NULL);
    return st ? st : sph_add_box(sim, *set, lo, hi, NULL);
}

#endif
#endif
