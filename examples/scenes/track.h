/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* track.h: where the crest of a wave is, how high and how fast: from the mass of water above each place of the bed, so
   to a small part of a spacing. For two-dimensional tanks from x = lo to hi; a bed that is not flat is added to the
   columns. */
#ifndef EXAMPLES_TRACK_H
#define EXAMPLES_TRACK_H

#include "scene.h"

typedef struct track_tank {
    double lo, hi, depth, dx; /* m: ends; depth of the water at rest; spacing */
    bool periodic;            /* else the water is mirrored at both ends */
    double (*bed)(const void *of, double x); /* m, height of the bed; null: flat, at 0 */
    const void *of;
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
/* the same of the columns between two places (m) */
#define track_between SPH_NAME(track_between)
track_crest track_between(const sph_sim *sim, const track_tank *tank, double from, double to);

/* Column heights (m) at n places x (m), n <= TRACK_PLACES. */
enum { TRACK_PLACES = 128 };
#define track_heights SPH_NAME(track_heights)
void track_heights(const sph_sim *sim, const track_tank *tank, const double *x, uint32_t n, double *height);

/* Surface at a wall (m): it is even about the wall, so from those one, two and three supports off it (m), where
   sph_surface sees water on both sides, by the even polynomial of fourth order. The mass near a wall would not do:
   water may stand nearer to it than its spacing. inward: 1 from a low end, -1 from a high one. The bed is flat. */
#define track_at_wall SPH_NAME(track_at_wall)
double track_at_wall(const sph_sim *sim, double wall, double inward, double support);

/* Where water first stands less than `height` (m) high, from `from` (m) on in steps of `step` (m, < 0: to the left), to
   a part of a spacing; the tank's end if nowhere. */
#define track_front SPH_NAME(track_front)
double track_front(const sph_sim *sim, const track_tank *tank, double from, double step, double height);

/* The steepest place of a wave's face ahead of its crest, of the water that is connected with the crest's: at heights y
   from a quarter of the wave's height to the crest, X(y) is where cover (by B-splines of knots 1.5 dx) falls to 1/2
   going ahead from below the crest. dX/dy, over two spacings, is negative on a face that leans back and rises through 0
   at the first vertical tangent: the wave begins to break. */
typedef struct track_face {
    double lean, x, y; /* -: the largest dX/dy; m: where it is. All 0: there is no face */
} track_face;
#define track_steepest SPH_NAME(track_steepest)
track_face track_steepest(const sph_sim *sim, const track_tank *tank, track_crest crest, bool to_the_left);

#endif
