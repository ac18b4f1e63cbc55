/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* smoothing_length.h: what a smoothing length of each particle (smoothing_length.c) brings to the lists: its options
   (options.h), the check of a configuration, its pass, h of a particle; and to the force loop the scale of a pair. */
#ifndef SPH_SMOOTHING_LENGTH_H
#define SPH_SMOOTHING_LENGTH_H

/* the options; how a line is made: options.h */
#define SPH_VARIABLE_H_OPTIONS(O, P, A)                                                                               \
    P(A, variable_h, BOOL, false, 0, 1, SPH_WITH_VARIABLE_H,                                                          \
      "false or true; false but for SPH_IDEAL_GAS with plain gradients, without density by summation, filters, "      \
      "diffusion, XSPH, a viscous stress and shifting", FIXED, "-",                                                   \
      "smoothing length of each particle by its density: no yes", "variable_h", "-", 0, 1, USUAL)                     \
    P(A, h_min, REAL, 0.5, 0.1f, 1, true, "0.1 .. 1", FIXED, "1",                                                     \
      "variable_h: least smoothing length over smoothing_length", "h_min", "1", 0.11, 1, USUAL)                       \
    P(A, h_max, REAL, 2, 1, 10, true, "1 .. 10", FIXED, "1", /* cells grow with it */                                 \
      "variable_h: largest smoothing length over smoothing_length", "h_max", "1", 1, 10, USUAL)

#ifdef SPH_H /* the tool reads the list of options without the kernel */
struct sph_config;
struct sph_pass;

/* what its options ask of others */
#define sph_check_smoothing_length SPH_NAME(check_smoothing_length_)
sph_status sph_check_smoothing_length(const struct sph_config *c, sph_report *r);

/* before the forces */
#define sph_pass_smoothing_length SPH_NAME(pass_smoothing_length_)
extern const struct sph_pass sph_pass_smoothing_length;
#endif

#endif
