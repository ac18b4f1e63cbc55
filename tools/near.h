/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* near.h: points sorted into cells, to find those near a place. At most one cell more than there are points. */
#ifndef NEAR_H
#define NEAR_H

#include <stdbool.h>
#include <stdint.h>

typedef struct near {
    uint32_t dim, n, cells[3];
    const double (*x)[3];
    double lo[3], cell[3], period[3], reach; /* period: 0 on an axis that does not repeat */
    uint32_t *start, *item;                  /* items of cell c: item[start[c]] .. item[start[c+1] - 1] */
} near;

/* x stays the caller's. period[k] > 0: the axis repeats from lo[k] on. False after a message if reach is over half a
   period. */
bool near_open(near *g, uint32_t dim, uint32_t n, const double (*x)[3], double reach, const double lo[3],
               const double period[3]);
void near_close(near *g);

/* calls fn for every point no farther than reach from x: its index, its place relative to x (shortest way), distance */
void near_each(const near *g, const double x[3], void (*fn)(void *ctx, uint32_t j, const double d[3], double r),
               void *ctx);

#endif
