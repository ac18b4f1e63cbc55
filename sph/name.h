/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* name.h: the two build knobs that change types, and the prefix that keeps the six builds apart.
   Every external symbol is sphNP_name with N the dimension and P the precision (f or d), so
   1-D, 2-D and 3-D, float and double can stand in one program, and a program compiled for one
   build that is linked with another fails at the linker, not at run time. */
#ifndef SPH_NAME_H
#define SPH_NAME_H

#ifndef SPH_DIM
#define SPH_DIM 2 /* 1, 2 or 3 */
#endif
#ifndef SPH_DOUBLE
#define SPH_DOUBLE 0 /* 0: float, 1: double */
#endif

#if SPH_DIM < 1 || SPH_DIM > 3
#error "SPH_DIM must be 1, 2 or 3"
#endif
#if SPH_DOUBLE
#define SPH_PRECISION_LETTER d
#else
#define SPH_PRECISION_LETTER f
#endif

#define SPH_PASTE2(n, p, x) sph##n##p##_##x
#define SPH_PASTE1(n, p, x) SPH_PASTE2(n, p, x)
#define SPH_NAME(x) SPH_PASTE1(SPH_DIM, SPH_PRECISION_LETTER, x)

#endif
