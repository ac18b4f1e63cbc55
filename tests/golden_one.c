/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* golden_one.c: the golden runs of one build alone (tests/knobs.sh, tests/targets.sh). */
#include "sph/sph.h"

int SPH_NAME(golden)(void);
int main(void) { return SPH_NAME(golden)() ? 1 : 0; }
