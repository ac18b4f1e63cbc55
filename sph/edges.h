/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* edges.h: what edges that let elastic waves out (edges.c, outline.c) bring to the lists: their options (options.h),
   the check of a configuration, the passes that a step of kick-drift-kick ends with. */
#ifndef SPH_EDGES_H
#define SPH_EDGES_H

/* the options; how a line is made: options.h */
#define SPH_EDGE_OPTIONS(O, P, A)                                                                                     \
    O(A, edge, CHOICE, SPH_NO_EDGE, 0, SPH_EDGES, SPH_EDGES_IN, "one of SPH_NO_EDGE .. SPH_EDGE_H_PRINTED", FIXED,    \
      "-", "edge that waves leave through: none natural viscous p m m_printed h h_printed")                           \
    O(A, edge_layers, WHOLE, 0, 0, 64, SPH_HAS_EDGES, "0 .. 64", FIXED, "-",                                          \
      "layers of particles in which P, M, H hold; 0: as many as the kernel reaches, + 1")                             \
    O(A, edge_width, REAL, 0, 0, SPH_HUGE, SPH_HAS_EDGES, ">= 0, with SPH_EDGE_NATURAL or SPH_EDGE_VISCOUS", FIXED,   \
      "m", "thickness of the matched layer before the edge; 0: none")                                                 \
    O(A, edge_reflection, POSITIVE, 3e-3, 0, 0.5, true, "> 0 and <= 0.5", FIXED, "-",                                 \
      "share of a P wave's amplitude that comes back through the matched layer, at right angles")                     \
    O(A, edge_shift, POSITIVE, 0.02, 0, 1, true, "> 0 and <= 1", FIXED, "c_p/spacing",                                \
      "rate below which the matched layer lets strains be")

#ifdef SPH_H /* the tool reads the list of options without the kernel */
struct sph_config;
struct sph_pass;

/* what its options ask of each other and of the scene */
#define sph_check_edges SPH_NAME(check_edges_)
sph_status sph_check_edges(const struct sph_config *c, sph_report *r);

/* before the forces of a step's end: the stress that the matched layer adds; after the step: its damping, where
   particles are, edges of lines along each axis */
#define sph_pass_layer_stress SPH_NAME(pass_layer_stress_)
#define sph_pass_layer SPH_NAME(pass_layer_)
#define sph_pass_lines_x SPH_NAME(pass_lines_x_)
#define sph_pass_lines_y SPH_NAME(pass_lines_y_)
#define sph_pass_lines_z SPH_NAME(pass_lines_z_)
extern const struct sph_pass sph_pass_layer_stress, sph_pass_layer, sph_pass_lines_x, sph_pass_lines_y,
    sph_pass_lines_z;
#endif

#endif
