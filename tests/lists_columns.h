/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* lists_columns.h: a column set more, for test_lists.c: given by -include, this line is all that a new column needs
   beside its loader (sph_load_spare). */
#ifndef SPH_TEST_LISTS_COLUMNS_H
#define SPH_TEST_LISTS_COLUMNS_H

#define SPH_EXTRA_COLUMNS(X) X(spare, 0, 2, 1, true)

#endif
