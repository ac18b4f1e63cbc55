/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* reference.c: the columns of reference positions (reference.h). Array: shift, the displacement since the start
   (state). */
#include "reference.h"
#include "arithmetic.h"

SPH_OBJECT(reference)

#if SPH_HAS_TOTAL
void sph_load_reference(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const sph_buffer *b = r->b;
    sph_real *const body = to + (size_t)SPH_DIM * row;
    for (uint32_t j = 0; j < r->n; j += SPH_W)
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const vint q = v_load_int(b->pos[k] + r->first + j) - v_load_int(b->shift[k] + r->first + j);
            v_store(to + k * row + j, sph_seen_place(r, k, q));
        }
    for (uint32_t j = 0; j < r->n; j++) {
        const bool broken = b->damage[0] && !(b->damage[0][r->first + j] < 1);
        body[j] = sph_is_solid(r->set) && !broken ? (sph_real)(sph_material_of(r->sim, r->set)->body + 1) : 0;
    }
}
#endif
