/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* precision_run.h: the scenes of the precision table (scenes of atlas.h), step by step, in one build. */
#ifndef LAB_PRECISION_RUN_H
#define LAB_PRECISION_RUN_H

#include <stdbool.h>
#include <stdint.h>

enum { PRECISION_MOST = 4000 };
typedef struct precision_look {
    uint32_t bodies;              /* particles that are not walls; ids 0 .. bodies-1 */
    double x[PRECISION_MOST][2];  /* by id, dx */
    double kinetic, front;        /* J; largest x, dx */
} precision_look;

/* A build's functions, so that two of them can be held side by side. start gives a scene, or null for no memory;
   period[k]: the length of a periodic axis, else 0. */
typedef struct precision_build {
    void *(*start)(uint32_t scene, double period[2]);
    bool (*step)(void *run); /* false: failed */
    void (*look)(const void *run, precision_look *out);
    void (*end)(void *run);
} precision_build;
extern const precision_build precision_build_2f, precision_build_2d;

#endif
