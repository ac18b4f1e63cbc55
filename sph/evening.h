/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* evening.h: what XSPH in the velocity itself (evening.c) brings to the lists. */
#ifndef SPH_EVENING_H
#define SPH_EVENING_H

/* the option; how a line is made: options.h */
#define SPH_EVENING_OPTIONS(O, P, A)                                                                                  \
    P(A, xsph_velocity, BOOL, false, 0, 1, SPH_HAS_XSPH_VELOCITY, "false, or true with xsph, without xsph_strain",    \
      FIXED, "-", "XSPH smooths the velocity itself: no yes", "xsph_velocity", "-", 0, 1, USUAL)

#ifdef SPH_H
struct sph_config;
struct sph_pass;
#define sph_check_evening SPH_NAME(check_evening_)
sph_status sph_check_evening(const struct sph_config *c, sph_report *r);
#define sph_pass_evening SPH_NAME(pass_evening_)
extern const struct sph_pass sph_pass_evening;
#endif

#endif
