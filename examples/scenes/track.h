/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* track.h: where the crest of a wave is, how high and how fast: from the mass of water above each place of the bed, so
   to a small part of a spacing. For two-dimensional tanks from x = lo to hi whose bed is flat. */
#ifndef EXAMPLES_TRACK_H
#define EXAMPLES_TRACK_H

#include "scene.h"

typedef struct track_tank {
    double lo, hi, depth, dx; /* m: ends; depth of the water at rest; spacing */
    bool periodic;            /* else the water is mirrored at both ends */
} track_tank;

/* The column height is h(x) = sum_i (m_i/rho0) B(x - x_i), with the mass flux q(x) = sum_i (m_i/rho0) u_i B(x - x_i),
   B the cubic B-spline of knots 3 dx apart, sharpened by its second moment: h - (3 dx)^2/6 h''. */
typedef struct track_crest {
    double x, height; /* m: of the highest column */
    /* m/s: sum h_x q_x/sum h_x^2 around the crest. Mass is conserved column by column, h_t = -q_x, so this is the
       speed of a wave of any shape that does not change, at one instant. 0: there is no wave */
    double speed;
} track_crest;
#define track_highest SPH_NAME(track_highest)
track_crest track_highest(const sph_sim *sim, const track_tank *tank);

#endif
