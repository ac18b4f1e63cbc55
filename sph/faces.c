/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* faces.c: the rules of the domain's faces for one particle. Periodic: it comes in on the other side; mirrors: it is
   reflected, and turns with all that it has; open: it has left. */
#include "motion.h"
#include "arithmetic.h"

SPH_OBJECT(faces)

/* puts a coordinate that left the domain back by the face's rule; returns as below */
static uint32_t enforce_face(const sph_sim *sim, uint32_t k, sph_pos *q)
{
    const bool high = *q >= sim->grid.extent[k];
    if (*q >= 0 && !high)
        return 0;
    const uint32_t face = sim->cfg.face[k][high];
    if (SPH_IS(face, PERIODIC))
        *q += high ? -sim->grid.extent[k] : sim->grid.extent[k];
    else if (SPH_IS(face, SYMMETRY) || SPH_IS(face, MIRROR_NO_SLIP))
        *q = high ? 2 * sim->grid.extent[k] - 1 - *q : -*q;
    else
        return SPH_LEFT;
    /* a move of a whole domain may end a quantum outside again */
    *q = *q < 0 ? 0 : *q < sim->grid.extent[k] ? *q : sim->grid.extent[k] - 1;
    const uint32_t turned = SPH_IS(face, SYMMETRY) ? SPH_TURNS_VECTORS | SPH_TURNS_TENSORS : SPH_TURNS_VECTORS;
    return SPH_IS(face, PERIODIC) ? 0 : turned << k;
}

#if SPH_WITH_DETAILS
void sph_note_left(const sph_sim *sim, const sph_pos *q, uint32_t id, sph_thread *t)
{
    uint32_t k = 0; /* the first axis along which it is outside */
    while (k + 1 < SPH_DIM && q[k] >= 0 && q[k] < sim->grid.extent[k])
        k++;
    const uint32_t high = q[k] >= 0;
    const sph_pos beyond = high ? q[k] - sim->grid.extent[k] : -q[k];
    sph_fail_note(t, (sph_status)(SPH_OUT_OF_FACE + 2 * k + high), id, (double)beyond * sim->grid.quantum);
}
#endif

uint32_t sph_enforce_faces(const sph_sim *sim, sph_pos *q)
{
    uint32_t turned = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        turned |= enforce_face(sim, k, &q[k]);
    return turned;
}
