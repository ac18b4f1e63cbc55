/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* extra_options.h: four options that the kernel does not have, for test_options.c, which has a kernel of its
   own that includes this. A line each, and nothing else. */
#ifndef EXTRA_OPTIONS_H
#define EXTRA_OPTIONS_H

#define SPH_EXTRA_OPTIONS(O, P, A)                                                                                    \
    P(A, extra_factor, REAL, 0.75, 0.5, 4, true, "0.5 .. 4", FIXED, "1/s", "a factor that nothing reads",             \
      "extra", "1/s", 0.5, 2, USUAL)                                                                                  \
    O(A, extra_switch, BOOL, false, 0, 1, EXTRA_MODULE_IN, "false or true", FIXED, "-", "a module that was left out")  \
    P(A, extra_choice, CHOICE, 1, 0, 3, 6, "0 .. 2", FIXED, "-", "one of three: red green blue",                      \
      "colour", "-", 0, 2, USUAL)                                                                                     \
    O(A, extra_wind, VECTOR, 2, -9, 9, true, "-9 .. 9", FREE, "m/s", "may change between steps")

#ifndef EXTRA_MODULE_IN
#define EXTRA_MODULE_IN 0
#endif

#endif
