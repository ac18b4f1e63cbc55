/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* edged.h: what scenes share whose solids end in edges that let waves out (edges.c). Powell's material (2012, section
   3.2): E 2.1, nu 0.3, so mu is 0.4615 K and c_p/c_s 1.871. */
#ifndef EXAMPLES_EDGED_H
#define EXAMPLES_EDGED_H

#include "solid.h"

#define EDGED_MU 0.46153846153846156
/* centimetres and microseconds: K 1.75, rho0 7.8 (g, cm, us) */
#define EDGED_C0 0.47366546658333 /* cm/us */

/* the parameters, and their places from `first` on */
enum { EDGED_EDGE, EDGED_LAYER, EDGED_LAYERS, EDGED_REFLECTION, EDGED_SHIFT, EDGED_PARAMS };
#define EDGED_PARAM_ROWS(edge_, layer_, reflection_)                                                                  \
    {"edge", "-", "edge: none natural viscous p m m_printed h h_printed", edge_, 0, SPH_EDGES - 1, SCENE_CHOICE},     \
    {"layer", "dx", "thickness of the matched layer beside natural and viscous edges; 0: none", layer_, 0, 200,        \
     SCENE_NUMBER},                                                                                                   \
    {"layers", "-", "layers of particles in which P, M, H hold; 0: as many as the kernel reaches, and one", 0, 0, 64,  \
     SCENE_WHOLE},                                                                                                    \
    {"reflection", "-", "what the matched layer is made for", reflection_, 1e-9, 0.5, SCENE_NUMBER},                  \
    {"shift", "c_p/dx", "alpha of the matched layer", 0.02, 1e-9, 1, SCENE_NUMBER}

static inline void edged_configure(const double *p, uint32_t first, double dx, sph_config *c)
{
    c->edge = (uint32_t)p[first + EDGED_EDGE];
    c->edge_width = c->edge == SPH_NO_EDGE || c->edge > SPH_EDGE_VISCOUS ? 0 : p[first + EDGED_LAYER] * dx;
    c->edge_layers = (uint32_t)p[first + EDGED_LAYERS];
    c->edge_reflection = p[first + EDGED_REFLECTION];
    c->edge_shift = p[first + EDGED_SHIFT];
}
static inline double edged_cp(const double *p) { return __builtin_sqrt(1 + p[SOLID_MU] * 4 / 3); }
static inline double edged_cs(const double *p) { return __builtin_sqrt(p[SOLID_MU]); }

#endif
