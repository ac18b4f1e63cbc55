/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* checks.h: what must hold inside the kernel, beside the checks of arguments, which are always on.

     SPH_ASSERT(x)    -DSPH_ASSERTS=1: tests and sanitizer builds. Cheap: a comparison a cell, a run or a chunk.
     SPH_VALIDATE(x)  -DSPH_VALIDATES=1: fuzzing, and its replay in CI. Heavy: order of cells, ids, places in tiles;
                      memory that may not be read yet is filled with poison (tests/test_restarts.c, make restarts).

   Where it does not hold the program stops (a trap): the kernel prints nothing. Off, x is compiled, not evaluated. */
#ifndef SPH_CHECKS_H
#define SPH_CHECKS_H

#ifndef SPH_VALIDATES
#define SPH_VALIDATES 0
#endif
#ifndef SPH_ASSERTS
#define SPH_ASSERTS SPH_VALIDATES
#endif

#define SPH_ASSERT(x) (SPH_ASSERTS && !(x) ? __builtin_trap() : (void)0)
#define SPH_VALIDATE(x) (SPH_VALIDATES && !(x) ? __builtin_trap() : (void)0)

#endif
