/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* arithmetic.h: whether compiler and machine do the arithmetic that the rule of same bits needs. */
#ifndef SPH_ARITHMETIC_H
#define SPH_ARITHMETIC_H

#include "name.h"

/* the name of what is wrong, or null */
#define sph_broken_arithmetic SPH_NAME(broken_arithmetic_)
const char *sph_broken_arithmetic(void);

#endif
