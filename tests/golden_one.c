/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* golden_one.c: the golden runs of one build, as a program for machines that hold one build at a time (targets.sh, knobs.sh). */
#include "sph/name.h"

int SPH_NAME(golden)(void);

int main(void) { return SPH_NAME(golden)() ? 1 : 0; }
