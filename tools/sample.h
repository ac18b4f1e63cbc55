/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sample.h: values at any place from those of particles around it. */
#ifndef SAMPLE_H
#define SAMPLE_H

#include "near.h"

#define SAMPLE_FIELDS 8

typedef struct sampler {
    const near *g;                     /* its reach is where weights end */
    const double *volume;              /* of each point */
    const double *field[SAMPLE_FIELDS];
    uint32_t fields, order;            /* order 0: Shepard; 1: moving least squares */
} sampler;

/* Values of the fields at x. Returns how many particles took part; 0: none is near, values are 0. *order is what was
   used: where the particles near do not span the space, or the place lies outside of them (sample.c), order 1 falls
   back to 0. */
uint32_t sample_at(const sampler *s, const double x[3], double value[SAMPLE_FIELDS], uint32_t *order);

#endif
