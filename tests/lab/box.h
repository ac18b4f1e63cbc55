/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* box.h: what the programs of the stability atlas share: simulations on the heap, periodic squares of a solid or of
   water in units of the spacing, c0 and the density at rest, small pushes, and growth rates fitted to what becomes of
   them. */
#ifndef LAB_BOX_H
#define LAB_BOX_H

#include <stdbool.h>
#include <stdint.h>

#include "sph/sph.h"

/* a simulation and its arena; ends the program with a message if the configuration is refused */
#define box_new SPH_NAME(box_new)
sph_sim *box_new(const sph_config *c, void **arena);
/* ends the program with a message unless the status is SPH_OK */
#define box_must SPH_NAME(box_must)
void box_must(const sph_sim *sim, sph_status s, const char *what);

/* dx = c0 = rho0 = 1, nothing that dissipates, periodic, n along a side, fixed step dt */
#define box_config SPH_NAME(box_config)
sph_config box_config(uint32_t n, uint32_t kernel, double h, double dt);
/* fewest particles along a side that a periodic box of this support may have: even, at least `least` */
#define box_side SPH_NAME(box_side)
uint32_t box_side(uint32_t kernel, double h, double stretch, uint32_t least);

/* random velocities up to `speed` on every axis, without a mean; the density becomes rho */
#define box_noise SPH_NAME(box_noise)
void box_noise(sph_sim *sim, uint32_t set, double speed, double rho, uint64_t seed);
/* the particle nearest to the middle gets `speed` along x and 0.6 of that along the next axis */
#define box_push SPH_NAME(box_push)
void box_push(sph_sim *sim, uint32_t set, double n, double speed, double rho);
/* root of the mean square of velocities about their mean */
#define box_speed SPH_NAME(box_speed)
double box_speed(const sph_sim *sim);
/* smallest distance of two particles, and the mean of every particle's nearest, round periodic sides of length n */
#define box_nearest SPH_NAME(box_nearest)
double box_nearest(const sph_sim *sim, double n, double *mean);
/* particles within the support of one, itself included */
#define box_neighbours SPH_NAME(box_neighbours)
uint32_t box_neighbours(uint32_t kernel, uint32_t lattice, double h);

/* growth rate of the speed: slope of its logarithm over the last third of the run up to time `end` or until it is
   1e-3 c0; 0 if below `least` or if the last quarter brought none */
#define box_growth SPH_NAME(box_growth)
double box_growth(sph_sim *sim, double dt, double end, double least);
/* the largest speed in the last quarter of the steps over that in the second; infinite if a step fails or it grows
   1e4-fold */
#define box_ratio SPH_NAME(box_ratio)
double box_ratio(sph_sim *sim, uint32_t steps);

#if SPH_DIM == 2
/* the square of a solid under volume strain V/V0 at density 1 (see theory.h), at rest */
typedef struct box_solid {
    uint32_t form, kernel, lattice, n;
    double h, mu, volume, epsilon, alpha, dt, xsph; /* xsph: factor of XSPH that smooths the velocity itself */
    uint32_t exponent;
} box_solid;
#define box_make_solid SPH_NAME(box_make_solid)
sph_sim *box_make_solid(const box_solid *b, uint32_t *set, void **arena);
#endif

#endif
