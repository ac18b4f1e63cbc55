/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* calibrate.h: a fixed piece of work of the same kind as the kernel's, to hold seconds against. */
#ifndef CALIBRATE_H
#define CALIBRATE_H

/* Seconds of 2^24 pair evaluations in float (distance, a polynomial of compact support, two sums) over 1,024 points in
   eight lanes: the shortest of five runs. Seconds over this number can be compared between machines. */
double calibrate(void);

#endif
