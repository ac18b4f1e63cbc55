/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* grid.c: the domain in quanta and in cells: quantum, extents, cells at least one support wide. */
#include "internal.h"
#include "kernels.h"
#include "report.h"
#include "arithmetic.h"

SPH_OBJECT(grid)

/* the power of two of which the longest axis has 2^(SPH_POS_BITS - 1) or more, but less than twice as many */
static double choose_quantum(double longest)
{
    const double most = longest * 1.000001 / (double)((sph_pos)1 << (SPH_POS_BITS - 1));
    double quantum = 0x1p72; /* above the most of twice SPH_HUGE */
    while (quantum > most)
        quantum *= 0.5;
    return quantum;
}

/* Cells of an axis, each at least a support wide: no pair within a support has a whole cell between its two.

   A place counts in units of 2^SPH_POS_SHIFT quanta, u of 0 .. e - 1; its cell is floor(u mul/2^(32 + shift)) with
   mul = floor(n 2^(32 + shift)/e). The shift is the largest for which mul has 32 bits, so mul is at least 2^31 and its
   rounding moves the edge of the last cell by less than e/2^31 <= 1/2 unit; that edges are at whole units, and that the
   domain may end within one, costs less than 2 units more: `cell` (m) is by 3 units more than must be. */
static void divide_axis(sph_grid *s, uint32_t k, double cell)
{
    const double n = s->length[k] / cell;
    const uint32_t cells = n < 1 ? 1 : (uint32_t)n;
    s->extent[k] = (sph_pos)(s->length[k] / s->quantum + 0.5);
    const uint32_t e = (uint32_t)((s->extent[k] - 1) >> SPH_POS_SHIFT) + 1;
    uint32_t shift = 0;
    while (cells << shift < (e + 1) / 2)
        shift++;
    s->ncell[k] = cells;
    s->cell_shift[k] = shift;
    s->cell_mul[k] = (uint32_t)(((uint64_t)(cells << shift) << 32) / e);
    s->cell_size[k] = s->extent[k] / (sph_pos)cells;
}

/* Whether the images of an axis are all seen: a periodic one needs three cells. Between two mirrors only the first
   image in each is made; the second ones stand a whole length away or more. */
static sph_status check_images(const sph_config *c, const sph_grid *s, uint32_t k, sph_report *r)
{
    const uint32_t *face = c->face[k];
    if (SPH_IS(face[0], PERIODIC) && s->ncell[k] < 3)
        return sph_refuse(r, "hi", "more than three supports from lo along a periodic axis", s->length[k]);
    if (SPH_HAS_MIRRORS && face[0] >= SPH_SYMMETRY && face[1] >= SPH_SYMMETRY && s->length[k] < s->support)
        return sph_refuse(r, "hi", "at least a support of the kernel from lo along an axis between two mirrors",
                          s->length[k]);
    return SPH_OK;
}

sph_status sph_make_grid(const sph_config *c, sph_grid *s, sph_report *r)
{
    s->support = sph_kernel_support(c->kernel) * sph_largest_h(c);
    double cell = sph_is_total(c) ? s->support * c->max_stretch : s->support; /* at least so wide */
    double longest = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        s->length[k] = c->hi[k] - c->lo[k];
        longest = s->length[k] > longest ? s->length[k] : longest;
    }
    if (!(longest < 1e6 * s->support))
        return sph_refuse(r, "hi", "at most 1e6 supports of the kernel from lo", longest);
    s->quantum = choose_quantum(longest);
    cell = cell * 1.000001 + s->quantum * (double)((sph_pos)3 << SPH_POS_SHIFT);
    double cells = 1;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        divide_axis(s, k, cell);
        if (check_images(c, s, k, r) != SPH_OK)
            return SPH_BAD_CONFIG;
        cells *= s->ncell[k];
    }
    if (!(cells < 2147483648.0))
        return sph_refuse(r, "hi", "a domain of less than 2^31 cells of one support", cells);
    s->cells = (uint32_t)cells;
    s->slabs = s->ncell[SPH_DIM - 1];
    s->slab_cells = s->cells / s->slabs;
    return SPH_OK;
}
