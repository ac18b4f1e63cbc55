/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* columns.c: the table of column sets (columns.h), through which the sweep reaches their loaders. */
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(columns)

#define SPH_COLUMN_LOADER(name, ghosts, rows, knob, when)                                                          \
    void SPH_NAME(load_##name##_)(const sph_candidates *r, sph_real *to, uint32_t row);
SPH_COLUMN_SETS(SPH_COLUMN_LOADER)
#undef SPH_COLUMN_LOADER

const struct sph_column_set sph_column_table[SPH_COLUMN_COUNT] = {
#define SPH_COLUMN_ROW(name, ghosts, rows, knob, when) {ghosts, rows, (knob) ? SPH_NAME(load_##name##_) : NULL},
    SPH_COLUMN_SETS(SPH_COLUMN_ROW)
#undef SPH_COLUMN_ROW
};
