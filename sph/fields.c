/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fields.c: the list of state fields (fields.h) as a table. */
#include "fields.h"
#include "arithmetic.h"

SPH_OBJECT(fields)

#define SPH_FIELD_ROW(name, type, comps, unit, when, way)                                                    \
    {"state: " #name, SPH_FIELD_AT(name), comps, sizeof(type), (type)0.5 > 0, (way) & SPH_WAYS,                   \
     (way) & (SPH_NOT_NEGATIVE | SPH_SHARE), (way) >> 8, (way) & (SPH_VECTOR | SPH_DEVIATOR)},
const sph_field sph_fields[SPH_FIELD_COUNT] = {SPH_STATE_FIELDS(SPH_FIELD_ROW)};
