/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* scene_param.h: how a scene describes one of its parameters. The same in all six builds. */
#ifndef SCENE_PARAM_H
#define SCENE_PARAM_H

#include <stdint.h>

#include "../../sph/options.h"

/* ---- parameters that every scene takes; they come first in its table: p[SCENE_OF_kernel], ... for the options of a
   configuration that are parameters (sph/options.h), then those below ---- */
#define SCENE_SKIP(A, name, ...)
#define SCENE_NUMBER_OF(A, name, ...) SCENE_OF_##name,
enum {
    SPH_OPTIONS(SCENE_SKIP, SCENE_NUMBER_OF, )
    SCENE_WALL,
    SCENE_STRENGTH,
    SCENE_DAMP_STEPS,
    SCENE_COMMON_COUNT
};

enum { SCENE_NUMBER, SCENE_WHOLE, SCENE_CHOICE };

/* Values are doubles, also of whole numbers and choices. A choice counts from 0 in the list of its names, which `what`
   gives after a colon, apart by spaces ("smoothing kernel: cubic quartic ..."). */
typedef struct scene_param {
    const char *name, *unit, *what;
    double value, min, max; /* default, and the range that is allowed, both ends included */
    uint32_t kind;
} scene_param;

/* The units of a scene. The kernel knows none: its manual says m, s and kg, and that any one system will do. A row
   gives the scene's unit for what the manual calls si; what has no row is called as in the manual. Ends with a row of
   nulls. */
typedef struct scene_unit {
    const char *si, *own;
} scene_unit;

#endif
