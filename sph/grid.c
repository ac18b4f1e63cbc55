/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* grid.c: the domain in quanta and in cells: quantum, extents, cells at least one support wide. */
#include "internal.h"
#include "kernels.h"
#include "report.h"

/* the power of two of which the longest axis has 2^(SPH_POS_BITS - 1) or more, but less than twice as many */
static double choose_quantum(double longest)
{
    const double most = longest * 1.000001 / (double)((sph_pos)1 << (SPH_POS_BITS - 1));
    double quantum = 1;
    while (quantum * 2 <= most)
        quantum *= 2;
    while (quantum > most)
        quantum /= 2;
    return quantum;
}

/* cells of an axis; false if a periodic one has less than three */
static bool divide_axis(const sph_config *c, sph_grid *s, uint32_t k, double cell)
{
    s->extent[k] = (sph_pos)(s->length[k] / s->quantum + 0.5);
    double n = s->length[k] / (cell * 1.000001);
    s->ncell[k] = n < 1 ? 1 : (uint32_t)n;
    /* mul is rounded down so that a position at the domain's end still falls into the last cell */
    uint64_t ext = (uint64_t)(s->extent[k] >> s->pos_shift) + 1;
    s->cell_mul[k] = (uint32_t)(((uint64_t)s->ncell[k] << 32) / ext);
    s->cell_size[k] = s->extent[k] / (sph_pos)s->ncell[k];
    return !SPH_IS(c->face[k][0], PERIODIC) || s->ncell[k] >= 3;
}

sph_status sph_make_grid(const sph_config *c, sph_grid *s, sph_report *r)
{
    s->support = sph_kernel_support(c->kernel) * c->smoothing_length;
    const double cell = sph_is_total(c) ? s->support * c->max_stretch : s->support; /* at least so wide */
    double longest = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        s->length[k] = c->hi[k] - c->lo[k];
        longest = s->length[k] > longest ? s->length[k] : longest;
    }
    if (!(longest < 1e6 * s->support))
        return sph_refuse(r, "hi", "at most 1e6 supports of the kernel from lo", longest);
    s->quantum = choose_quantum(longest);
    s->pos_shift = SPH_POS_BITS - 30;
    double cells = 1;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (!divide_axis(c, s, k, cell))
            return sph_refuse(r, "hi", "more than three supports from lo along a periodic axis", s->length[k]);
        cells *= s->ncell[k];
    }
    if (!(cells < 2147483648.0))
        return sph_refuse(r, "hi", "a domain of less than 2^31 cells of one support", cells);
    s->cells = (uint32_t)cells;
    s->slabs = s->ncell[SPH_DIM - 1];
    s->slab_cells = s->cells / s->slabs;
    return SPH_OK;
}
