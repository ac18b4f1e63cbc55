/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fields.h: what the state of a particle is made of: the list of its fields, and the types that they have. */
#ifndef SPH_FIELDS_H
#define SPH_FIELDS_H

#include <stddef.h>

#include "lanes.h"
#include "sph.h"

/* Positions are integers, counted in quanta from the domain's low corner. One quantum is a power of two (m) such
   that the longest axis has less than 2^30 (float) or 2^52 (double) of them: equally fine everywhere, exact to
   subtract, and 2^6 times finer than a float at the far end of the domain. Less than a quantum a step adds up, too: see
   sph_rounding. */
typedef sph_int sph_pos;
#define SPH_POS_BITS (SPH_DOUBLE ? 52 : 30)
#define SPH_POS_SHIFT (SPH_POS_BITS - 30) /* what is left of a position to find its cell by has 30 bits */

/* A tensor of SPH_DIM^2 components, row by row; a symmetric one: the diagonal, then xy, xz, yz. The deviatoric stress
   lacks the last diagonal component in 3-D, which follows from the others (in 2-D and 1-D the missing ones are out of
   the plane): xx, or xx yy xy, or xx yy xy xz yz. */
#define SPH_NL (SPH_DIM * SPH_DIM)
#define SPH_NT (SPH_DIM * (SPH_DIM + 1) / 2)
#define SPH_NS (SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? 3 : 5)

/* The one list of state fields:
     name, element type, components, unit, condition on the configuration `c`, and how it goes through a step:
       SPH_PLACED     the sort itself moves and advances it (what a cell is found by, and what the sweep reads at once)
       SPH_SUMMED     the force sweep writes it for all matter; walls get zeros
       SPH_RATE       zero after the sort, then whatever the passes of the stage write
       SPH_CARRIED    goes with its particle unchanged, until a pass of its own changes it
       SPH_DISPLACED  carried, and gains what the particle moved (quanta; component k is along axis k)
       SPH_EVOLVES(r) carried, and advanced by every integrator with its rate, field r
     Reals that are carried or evolve must be finite at a step's end; | SPH_NOT_NEGATIVE or | SPH_SHARE (0 .. 1): more.
     A mirror that a particle goes through turns it with all that it has: | SPH_VECTOR (component k is along axis k) or
     | SPH_DEVIATOR (components as in SPH_NS); else a scalar. What is placed the sort turns itself.
   Sort, integrators, hash, dump, restore, wipe and arena sizes follow from it. */
#define SPH_STATE_FIELDS(X)                                                                                       \
    X(pos, sph_pos, SPH_DIM, "quantum", true, SPH_PLACED)                                                         \
    X(vel, sph_real, SPH_DIM, "m/s", true, SPH_PLACED | SPH_VECTOR)                                               \
    X(rho, sph_real, 1, "1", true, SPH_PLACED) /* (density - rho0)/rho0 */                                        \
    X(acc, sph_real, SPH_DIM, "m/s^2", true, SPH_SUMMED | SPH_VECTOR)                                             \
    X(drho, sph_real, 1, "1/s", true, SPH_SUMMED)                                                                 \
    X(rise, sph_real, 1, "1/s", sph_foresees(c), SPH_SUMMED) /* half of what drho rose by in the latest step */      \
    X(xsph, sph_real, SPH_DIM, "m/s", sph_uses_xsph(c), SPH_SUMMED | SPH_VECTOR)                                  \
    X(stress, sph_real, SPH_NS, "Pa", sph_has_solids(c), SPH_EVOLVES(dstress) | SPH_DEVIATOR) /* deviatoric */    \
    X(dstress, sph_real, SPH_NS, "Pa/s", sph_has_solids(c), SPH_RATE | SPH_DEVIATOR)                              \
    X(plastic, sph_real, 1, "1", sph_yields(c), SPH_CARRIED | SPH_NOT_NEGATIVE)                                   \
    X(damage, sph_real, 1, "1", sph_damages(c), SPH_CARRIED | SPH_SHARE) /* D^(1/SPH_DIM) */                      \
    X(shift, sph_pos, SPH_DIM, "quantum", sph_is_total(c), SPH_DISPLACED | SPH_VECTOR) /* since the start */      \
    X(quadrature, sph_real, 1, "1", sph_weighs_faces(c), SPH_CARRIED | SPH_NOT_NEGATIVE) /* phi; 0: 1 */       \
    X(id, uint32_t, 1, "1", true, SPH_PLACED) /* until a stage settles: an index into src */              \
    X(set, uint8_t, 1, "1", true, SPH_PLACED)                                                                     \
    SPH_EXTRA_FIELDS(X)

/* fields that a build brings with it: tests/extra_fields.h shows that nothing else has to be said */
#ifndef SPH_EXTRA_FIELDS
#define SPH_EXTRA_FIELDS(X)
#endif

typedef struct sph_buffer {
#define SPH_FIELD_MEMBER(name, type, comps, unit, when, way) type *name[comps];
    SPH_STATE_FIELDS(SPH_FIELD_MEMBER)
#undef SPH_FIELD_MEMBER
} sph_buffer;

/* ---- the list as a table ---- */

/* number of a field's first pointer in sph_buffer */
#define SPH_FIELD_AT(name) (offsetof(sph_buffer, name) / sizeof(void *))

/* what the last column may be */
enum {
    SPH_PLACED,
    SPH_SUMMED,
    SPH_RATE,
    SPH_CARRIED,
    SPH_DISPLACED,
    SPH_EVOLVING,
    SPH_WAYS = 7,         /* the bits of those above */
    SPH_NOT_NEGATIVE = 8,
    SPH_SHARE = 16,
    SPH_VECTOR = 32,
    SPH_DEVIATOR = 64
};
#define SPH_EVOLVES(rate) (SPH_EVOLVING | SPH_FIELD_AT(rate) << 8)

typedef struct sph_field {
    const char *label; /* "state: " and the name */
    uint8_t at;        /* SPH_FIELD_AT */
    uint8_t comps;
    uint8_t bytes;     /* of an element */
    bool real;         /* elements are reals */
    uint8_t way;       /* SPH_PLACED .. SPH_EVOLVING */
    uint8_t range;     /* SPH_NOT_NEGATIVE, SPH_SHARE, or 0 */
    uint8_t rate;      /* SPH_EVOLVING: SPH_FIELD_AT its rate */
    uint8_t kind;      /* SPH_VECTOR, SPH_DEVIATOR, or 0: a scalar */
} sph_field;

enum {
#define SPH_FIELD_NUMBER(name, type, comps, unit, when, way) SPH_FIELD_NUMBER_##name,
    SPH_STATE_FIELDS(SPH_FIELD_NUMBER)
#undef SPH_FIELD_NUMBER
        SPH_FIELD_COUNT
};

/* all fields, whether a scene has them or not, in the order of the list */
#define sph_fields SPH_NAME(fields_)
extern const sph_field sph_fields[SPH_FIELD_COUNT];

SPH_INLINE const char *sph_field_name(const sph_field *f) { return f->label + sizeof "state: " - 1; }

/* pointer number `at` of a buffer; null where the scene has no such field */
SPH_INLINE void *sph_array(const sph_buffer *b, uint32_t at)
{
    void *p;
    memcpy(&p, (const unsigned char *)b + at * sizeof p, sizeof p);
    return p;
}

#endif
