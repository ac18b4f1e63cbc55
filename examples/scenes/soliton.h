/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* soliton.h: the exact solitary wave of incompressible, irrotational water on a flat bed, to be started from: surface,
   velocities and pressure anywhere in it. Lengths in depths D of the water at rest, y from the bed, times in sqrt(D/g);
   the wave goes to +x over water at rest and has its crest at x = 0. */
#ifndef EXAMPLES_SOLITON_H
#define EXAMPLES_SOLITON_H

#include "scene.h"

#define SOLITON_MODES 256
#define SOLITON_LEAST 0.01 /* heights that soliton_make takes, in D; the highest wave has 0.833 */
#define SOLITON_MOST 0.6

typedef struct soliton {
    double height, speed;          /* of the crest above still water (D), of the wave (sqrt(gD)) */
    double wave;                   /* wave number of the first mode (1/D): the series repeats after 2 pi/wave */
    double mode[SOLITON_MODES + 1]; /* amplitudes of the modes of the conformal map, [0]: its stretching */
} soliton;

/* false: the height is not between SOLITON_LEAST and SOLITON_MOST */
#define soliton_make SPH_NAME(soliton_make)
bool soliton_make(soliton *s, double height);

/* Surface above still water (D) at x (D). */
#define soliton_surface SPH_NAME(soliton_surface)
double soliton_surface(const soliton *s, double x);

/* Velocity (sqrt(gD)) and pressure (rho g D) at x, y (D), inside the water. */
#define soliton_flow SPH_NAME(soliton_flow)
void soliton_flow(const soliton *s, double x, double y, double *v, double *pressure);

#endif
