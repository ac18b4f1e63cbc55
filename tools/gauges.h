/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* gauges.h: columns that a run adds to the history of any scene: gauge=X[/X...] looks at the water above places of the
   bed, probe=X,Y[/X,Y...] at values at places. */
#ifndef GAUGES_H
#define GAUGES_H

#include "build.h"

enum { MOST_GAUGES = 16, GAUGE_COLUMNS = 3, MOST_COLUMNS = 64 }; /* of a history at most so many columns */

typedef struct gauges {
    double gauge[MOST_GAUGES][3], probe[MOST_GAUGES][3];
    uint32_t gauge_count, probe_count, columns;
    char name[MOST_COLUMNS][64]; /* of the columns */
} gauges;

/* One of the two options, its text; false after a message. Lengths are the scene's. */
bool gauges_take(gauges *g, const build *b, const build_scene *scene, const char *option, const char *text);
/* Whether all places are in the domain; false after a message. */
bool gauges_fit(const gauges *g, const build *b, const build_sim *sim);
/* The values of all columns, in the order of their names. */
void gauges_row(const gauges *g, const build *b, const build_sim *sim, double *row);

#endif
