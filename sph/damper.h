/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damper.h: what the acoustic damper (damper.c) brings to the lists: its option (options.h), the check of a
   configuration, its passes, and the pressure that tiles add (tiles.c). */
#ifndef SPH_DAMPER_H
#define SPH_DAMPER_H

/* the option; how a line is made: options.h */
#define SPH_DAMPER_OPTIONS(O, P, A)                                                                                   \
    P(A, damper, REAL, 0, 0, 4, SPH_WITH_DAMPER,                                                                      \
      "0 .. 4; 0 with solids, Runge-Kutta, summed density and printed continuity", FIXED, "-",                        \
      "acoustic damper theta; 0: off; 0.2 is usual", "damper", "-", 0, 4, USUAL)

#ifdef SPH_H /* the tool reads the list of options without the kernel */
struct sph_config;
struct sph_pass;

/* what its option asks of others */
#define sph_check_damper SPH_NAME(check_damper_)
sph_status sph_check_damper(const struct sph_config *c, sph_report *r);

/* before the sums of forces; at a step's end, its book */
#define sph_pass_damper SPH_NAME(pass_damper_)
#define sph_pass_damper_book SPH_NAME(pass_damper_book_)
extern const struct sph_pass sph_pass_damper, sph_pass_damper_book;
#endif

#endif
