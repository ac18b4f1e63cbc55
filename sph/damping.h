/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damping.h: what damping by a rate in time (damping.c) brings to the lists. */
#ifndef SPH_DAMPING_H
#define SPH_DAMPING_H

/* the option; how a line is made: options.h */
#define SPH_DAMPING_OPTIONS(O, P, A)                                                                                  \
    P(A, damping_rate, REAL, 0, 0, 1e15f, SPH_WITH_DAMPING_RATE, "0 .. 1e15", FIXED, "1/s",                           \
      "rate at which velocities die away, in time; 0: none", "damping_rate", "1/s", 0, 1e15, USUAL)

#ifdef SPH_H
struct sph_pass;
/* after a step's first sort, what its first half takes; at the step's end, the second half */
#define sph_pass_damping SPH_NAME(pass_damping_)
#define sph_pass_damping_end SPH_NAME(pass_damping_end_)
extern const struct sph_pass sph_pass_damping, sph_pass_damping_end;
#endif

#endif
