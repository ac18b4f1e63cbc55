/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* forces.h: see forces.c. */
#ifndef SPH_FORCES_H
#define SPH_FORCES_H

#include "term.h"

#define sph_pass_force SPH_NAME(pass_force_)
extern const sph_pass sph_pass_force;

#endif
