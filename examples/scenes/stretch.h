/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stretch.h: what the scenes of a stretched block share (hole, chamber, block, caldera): a rectangle of rock, perhaps
   with an elliptical hole, perhaps with gas in it, whose ends are held along x and drawn apart; stresses sampled at
   places by moving least squares; how much is broken. 2-D. Units: solid.h. */
#ifndef EXAMPLES_STRETCH_H
#define EXAMPLES_STRETCH_H

#include "solid.h"
#if SPH_DIM == 2

/* parameters that these scenes take after those of all solids */
enum { STRETCH_SPEED = SOLID_COMMON, STRETCH_RAMP, STRETCH_PULL, STRETCH_GRIP, STRETCH_SLOW, STRETCH_CLAMP,
       STRETCH_COMMON };
#define STRETCH_PARAMS(speed_, ramp_, pull_)                                                                           \
    {"speed", "c0", "velocity of each end (Gray's V_f)", speed_, 0, 0.1, SCENE_NUMBER},                                \
    {"ramp", "cm/c0", "how long the ends take to come to speed, and to rest again", ramp_, 0, 1e6, SCENE_NUMBER},      \
    {"pull", "cm/c0", "when the ends are at rest again, at least twice the ramp; 0: never", pull_, 0, 1e6,             \
     SCENE_NUMBER},                                                                                                    \
    {"grip", "dx", "columns of particles held along x at each end", 2, 1, 20, SCENE_WHOLE},                            \
    {"slow", "-", "the ends go as far, but slower by this factor", 1, 0.01, 1000, SCENE_NUMBER},                       \
    {"clamp", "-", "held are the last columns, or one on the end's face (solid_clamp): columns ideal", 0, 0, 1,      \
     SCENE_CHOICE}

/* and those that break, after these */
enum { BREAK_DAMAGE = STRETCH_COMMON, BREAK_K, BREAK_M, BREAK_CRACK, BREAK_RADIUS, BREAK_SEED, BREAK_COMMON };
#define BREAK_PARAMS(damage_, k_, radius_)                                                                             \
    {"damage", "-", "damage: none benz_asphaug benz_asphaug_gray", damage_, 0, 2, SCENE_CHOICE},                       \
    {"k", "1/cm^2", "Weibull's k of the flaws", k_, 0, 1e300, SCENE_NUMBER},                                           \
    {"m", "-", "Weibull's m of the flaws", 8.5, 1, 50, SCENE_NUMBER},                                                  \
    {"crack", "c0", "speed of cracks", 0.4, 1e-6, 1, SCENE_NUMBER},                                                    \
    {"radius", "cm", "radius of flaws; 0: of the disc of a particle's area", radius_, 0, 1e3, SCENE_NUMBER},           \
    {"seed", "-", "of the flaws", 1, 0, 1e15, SCENE_WHOLE}

typedef struct stretch {
    double lo[2], hi[2], dx; /* the block, ends included */
    double room;             /* free space around it */
    bool half, quarter;      /* x = lo[0] is a mirror plane instead of an end; so is y = lo[1] */
    bool has_hole, has_gas;
    sph_ellipse hole;
    sph_fluid gas;
    bool bent; /* the lattice is bent round the hole, which is a circle; quarters only */
} stretch;

/* domain, faces and capacities of a scene of such a block */
#define stretch_configure SPH_NAME(stretch_configure)
void stretch_configure(const double *p, const stretch *b, sph_config *c);
/* the damage's part of a configuration whose max_particles is set */
#define break_configure SPH_NAME(break_configure)
void break_configure(const double *p, sph_config *c);

/* Rock, ends and gas. p must live as long as the simulation: the ends' motion reads it. Gas goes with whole blocks. */
enum { STRETCH_ROCK, STRETCH_RIGHT, STRETCH_LEFT, STRETCH_GAS };
#define stretch_build SPH_NAME(stretch_build)
sph_status stretch_build(sph_sim *sim, const double *p, const stretch *b, const sph_solid *rock,
                         const sph_flaws *flaws);

/* how far each end has gone at time t */
#define stretch_drawn SPH_NAME(stretch_drawn)
double stretch_drawn(const double *p, double t);

/* mean sxx of the rock with from <= |x| that is not held: the force on an end over its length, once all is at rest */
#define stretch_end_stress SPH_NAME(stretch_end_stress)
double stretch_end_stress(const sph_sim *sim, double from);
/* largest sxx + syy of a particle of rock */
#define stretch_peak SPH_NAME(stretch_peak)
double stretch_peak(const sph_sim *sim);

/* Stress xx, yy, xy at a place from the rock within `reach` of it, images in the mirror planes included, by a fit of
   a quadratic polynomial with weights (1 - q^2)^3. Where there are too few particles for that, the nearest one's. */
#define stretch_sample SPH_NAME(stretch_sample)
void stretch_sample(const sph_sim *sim, const stretch *b, const double *at, double reach, double *stress);

/* sxx + syy at n places of a quarter of the rim of a circular hole about the origin, from 0 to 90 degrees. The sum is
   harmonic in an elastic body: 1, r^-m cos m angle and r^m cos m angle, m up to 8, are fitted to the rock between
   `skip` off the rim and the radius `out`. (At the rim itself the gradients of particles are one-sided and lag behind
   by about a spacing.) */
#define stretch_rim SPH_NAME(stretch_rim)
void stretch_rim(const sph_sim *sim, const stretch *b, double skip, double out, uint32_t n, double *sum);

/* Pressure p in a hole as a load on its rim: acceleration outwards of the rock (rho 1) at x within 3 dx of the rim,
   whose sum is p on every length of the rim. For a body force. */
#define stretch_load SPH_NAME(stretch_load)
void stretch_load(const stretch *b, double p, const double *x, double *a);

/* how much of the rock is broken */
typedef struct stretch_broken {
    double mean;        /* of the damage */
    uint32_t full;      /* particles with damage above 0.99 */
    double x, y;        /* the middle of these; 0 if there are none */
    double near;        /* distance of the nearest of these from the hole's rim along the way to its centre; -1: none */
} stretch_broken;
#define stretch_look SPH_NAME(stretch_look)
void stretch_look(const sph_sim *sim, const stretch *b, stretch_broken *out);

#endif
#endif
