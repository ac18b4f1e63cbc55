/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* collapsing_square.c: all of a square runs towards its middle, and so does what lies beyond (Powell 2012 section
   3.2.1). Exact, small strains: v = -v0 sqrt(1 - (c t/r)^2) before the wave from the middle, rest behind it; the
   kinetic energy of the square is 0 from 1.175 us on (tests/refdata/powell_square.csv). */
#include "collapsing.h"
#if SPH_DIM == 2

static const scene_param param[PARAMS] = {COLLAPSING_PARAMS(0, SPH_EDGE_NATURAL, 0, 0, 4)};

#define scene_collapsing_square SPH_NAME(scene_collapsing_square)
extern const scene scene_collapsing_square;
const scene scene_collapsing_square = {"collapsing_square",
                                       "a square collapses in an infinite medium (Powell 2012, 3.2.1)",
                                       param, PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                       history, scene_gray};
#endif
