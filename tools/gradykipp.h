/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* gradykipp.h: sizes of the pieces into which a brittle body breaks at a constant strain rate (Grady and Kipp 1980; in
   two dimensions Gray 2001, eqs 6.7-6.18). */
#ifndef GRADYKIPP_H
#define GRADYKIPP_H

#include <stdbool.h>
#include <stdint.h>

/* Weibull's flaws: k strain^m of them in a unit of length, area or volume (dim 1, 2, 3) are active below a strain;
   cracks grow at crack_speed; any one system of units. */
typedef struct gradykipp {
    uint32_t dim;
    double k, m, crack_speed, rate;
} gradykipp;

double gradykipp_ln_alpha(const gradykipp *g);      /* D(t) = alpha rate^m t^(m+dim) */
double gradykipp_time(const gradykipp *g);          /* t_f: D(t_f) = 1 */
double gradykipp_peak(const gradykipp *g);          /* size at which the density below is largest */
double gradykipp_peak_printed(const gradykipp *g);  /* the same by Gray 6.18, whose m should be m + dim - 1 */
double gradykipp_mean(const gradykipp *g);          /* mean size by volume */
double gradykipp_mean_number(const gradykipp *g);   /* mean size by number */
double gradykipp_largest(const gradykipp *g);       /* 2 c t_f */
/* F(L): share of the volume per length in pieces of size L; its integral is 1 */
double gradykipp_density(const gradykipp *g, double size);

/* from the arguments k=, m=, c=; false after a message */
bool gradykipp_parse(int argc, char **argv, gradykipp *g);

#endif
