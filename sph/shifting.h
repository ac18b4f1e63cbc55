/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shifting.h: what particle shifting (shifting.c) brings to the lists: its option (options.h), the check of a
   configuration, the pass that a step ends with. Its sums in the force loop: shift_sums.h. */
#ifndef SPH_SHIFTING_H
#define SPH_SHIFTING_H

/* the option; how a line is made: options.h */
#define SPH_SHIFTING_OPTIONS(O, P, A)                                                                                 \
    P(A, shifting, REAL, 0, 0, 4, SPH_WITH_SHIFTING, "0 .. 4, and 0 in scenes with solids", FIXED, "-",               \
      "strength of particle shifting; 0: off, 0.5: usual", "shifting", "-", 0, 4, OWN)                                \
    P(A, shift_pairs, BOOL, false, 0, 1, SPH_WITH_SHIFTING, "false or true, and false without shifting", FIXED, "-",  \
      "near a surface shift pairs closer than 0.8 spacings, too: no yes", "shift_pairs", "-", 0, 1, USUAL)

#define SPH_SHIFT_APART 0.8 /* spacings: near a surface closer pairs are moved apart (shift_pairs) */

#ifdef SPH_H /* the tool reads the list of options without the kernel */
struct sph_config;
struct sph_pass;

#define sph_check_shifting SPH_NAME(check_shifting_)
sph_status sph_check_shifting(const struct sph_config *c, sph_report *r);

#define sph_pass_shifting SPH_NAME(pass_shifting_)
extern const struct sph_pass sph_pass_shifting;
#endif

#endif
