/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sponge.h: what the sponge layer (sponge.c) brings to the lists: its options (options.h), the check of a
   configuration, the pass that a step ends with. */
#ifndef SPH_SPONGE_H
#define SPH_SPONGE_H

/* the options; how a line is made: options.h */
#define SPH_SPONGE_OPTIONS(O, P, A)                                                                                   \
    O(A, sponge_low, VECTOR, 0, 0, SPH_HUGE, SPH_WITH_SPONGE,                                                         \
      ">= 0, at most the domain's length; 0 on periodic faces", FIXED, "m",                                           \
      "width of the sponge layer at the low face of each axis; 0: none")                                              \
    O(A, sponge_high, VECTOR, 0, 0, SPH_HUGE, SPH_WITH_SPONGE,                                                        \
      ">= 0, at most the domain's length; 0 on periodic faces", FIXED, "m", "at the high face")                       \
    O(A, sponge_rate, REAL, 0, 0, 1e15f, SPH_WITH_SPONGE, "0 .. 1e15, and > 0 where a layer has a width", FIXED,      \
      "1/s",                                                                                                          \
      "rate of the damping at the face itself; rate width/c of some 10 reflects least (atlas_sponge.csv)")            \
    O(A, sponge_velocity, VECTOR, 0, -1e14f, 1e14f, SPH_WITH_SPONGE, "-1e14 .. 1e14", FIXED, "m/s",                   \
      "velocity that the layers leave alone")

#ifdef SPH_H /* the tool reads the list of options without the kernel */
struct sph_config;
struct sph_pass;

/* what its options ask of each other and of the domain */
#define sph_check_sponge SPH_NAME(check_sponge_)
sph_status sph_check_sponge(const struct sph_config *c, sph_report *r);

#define sph_pass_sponge SPH_NAME(pass_sponge_)
extern const struct sph_pass sph_pass_sponge;
#endif

#endif
