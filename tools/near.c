/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* near.c: points in cells (see near.h). */
#include "near.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

static uint32_t cell_on(const near *g, double x, uint32_t k)
{
    double at = floor((x - g->lo[k]) / g->cell[k]);
    if (g->period[k] > 0)
        at -= g->cells[k] * floor(at / g->cells[k]);
    return at > 0 ? at < g->cells[k] ? (uint32_t)at : g->cells[k] - 1 : 0;
}
static uint32_t cell_of(const near *g, const double x[3])
{
    uint32_t c = 0;
    for (uint32_t k = g->dim; k-- > 0;)
        c = c * g->cells[k] + cell_on(g, x[k], k);
    return c;
}

/* as many cells as points at most, none narrower than reach */
static void choose_cells(near *g)
{
    const double most = floor(pow(g->n + 1.0, 1.0 / g->dim));
    for (uint32_t k = 0; k < 3; k++) {
        double low = g->lo[k], size = g->period[k];
        g->cells[k] = 1;
        g->cell[k] = 1;
        if (k >= g->dim)
            continue;
        if (!(size > 0)) {
            double high = g->n ? g->x[0][k] : 0;
            low = high;
            for (uint32_t i = 1; i < g->n; i++) {
                low = fmin(low, g->x[i][k]);
                high = fmax(high, g->x[i][k]);
            }
            size = high - low;
        }
        g->lo[k] = low;
        const double fit = floor(size / g->reach);
        g->cells[k] = (uint32_t)fmax(1, fmin(fit, most));
        g->cell[k] = size > 0 ? size / g->cells[k] : 1;
    }
}

bool near_open(near *g, uint32_t dim, uint32_t n, const double (*x)[3], double reach, const double lo[3],
               const double period[3])
{
    memset(g, 0, sizeof *g);
    g->dim = dim;
    g->n = n;
    g->x = x;
    g->reach = reach;
    for (uint32_t k = 0; k < dim; k++) {
        g->lo[k] = lo[k];
        g->period[k] = period[k];
        if (period[k] > 0 && reach > 0.5 * period[k]) {
            host_no("a reach of %g m is over half the period, %g m", reach, period[k]);
            return false;
        }
    }
    choose_cells(g);
    const uint32_t cells = g->cells[0] * g->cells[1] * g->cells[2];
    g->start = host_alloc((cells + 1) * sizeof *g->start);
    g->item = host_alloc(n * sizeof *g->item);
    memset(g->start, 0, (cells + 1) * sizeof *g->start);
    for (uint32_t i = 0; i < n; i++)
        g->start[cell_of(g, x[i]) + 1]++;
    for (uint32_t c = 0; c < cells; c++)
        g->start[c + 1] += g->start[c];
    for (uint32_t i = n; i-- > 0;) /* from the end, so that items of a cell stand in order and start is right again */
        g->item[--g->start[cell_of(g, x[i]) + 1]] = i;
    memmove(g->start, g->start + 1, cells * sizeof *g->start);
    g->start[cells] = n;
    return true;
}

void near_close(near *g)
{
    free(g->start);
    free(g->item);
    g->start = g->item = NULL;
}

static void look_at(const near *g, uint32_t j, const double x[3],
                    void (*fn)(void *ctx, uint32_t j, const double d[3], double r), void *ctx)
{
    double d[3] = {0, 0, 0}, r2 = 0;
    for (uint32_t k = 0; k < g->dim; k++) {
        d[k] = g->x[j][k] - x[k];
        if (g->period[k] > 0)
            d[k] -= g->period[k] * floor(d[k] / g->period[k] + 0.5);
        r2 += d[k] * d[k];
    }
    if (r2 <= g->reach * g->reach)
        fn(ctx, j, d, sqrt(r2));
}

/* cells of one axis to look at: own and its neighbours, each once */
static uint32_t around(const near *g, double x, uint32_t k, uint32_t list[3])
{
    const uint32_t n = g->cells[k];
    uint32_t count = 0;
    if (k >= g->dim || n <= 3) {
        for (uint32_t c = 0; c < n; c++)
            list[count++] = c;
        return count;
    }
    const double at = floor((x - g->lo[k]) / g->cell[k]); /* may lie outside */
    for (int s = -1; s <= 1; s++) {
        double c = at + s;
        if (g->period[k] > 0)
            c -= n * floor(c / n);
        if (c >= 0 && c < n)
            list[count++] = (uint32_t)c;
    }
    return count;
}

void near_each(const near *g, const double x[3], void (*fn)(void *ctx, uint32_t j, const double d[3], double r),
               void *ctx)
{
    uint32_t list[3][3], count[3];
    for (uint32_t k = 0; k < 3; k++)
        count[k] = around(g, x[k], k, list[k]);
    for (uint32_t c = 0; c < count[2]; c++)
        for (uint32_t b = 0; b < count[1]; b++)
            for (uint32_t a = 0; a < count[0]; a++) {
                const uint32_t cell = (list[2][c] * g->cells[1] + list[1][b]) * g->cells[0] + list[0][a];
                for (uint32_t i = g->start[cell]; i < g->start[cell + 1]; i++)
                    look_at(g, g->item[i], x, fn, ctx);
            }
}
