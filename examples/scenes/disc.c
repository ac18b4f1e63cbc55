/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* disc.c: what is within 0.25 cm of the middle runs towards it, in a medium at rest (Powell 2012 section 3.2.2).
   Reference: 1-D radial finite elements (tests/refdata/powell_disc_*.csv). A matched layer of 20 spacings around. */
#include "collapsing.h"
#if SPH_DIM == 2

static const scene_param param[PARAMS] = {COLLAPSING_PARAMS(0.25, SPH_EDGE_NATURAL, 20, 20, 4)};

#define scene_disc SPH_NAME(scene_disc)
extern const scene scene_disc;
const scene scene_disc = {"disc", "a disc collapses in an infinite medium (Powell 2012, 3.2.2)", param, PARAMS,
                          configure, build, end, sizeof column / sizeof *column, column, history, scene_gray};
#endif
