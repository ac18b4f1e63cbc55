/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* solid.h: the pair formulas of solids on lanes, used by the one sweep (sweep.c, fluid.c), and what solid.c and damage.c
   give to the list of passes. Signs: T is stored as pressure is, positive in compression, so that a pair adds to the sum of
   accelerations what pressure does: a_i -= m_j (T_i + T_j) K g. See SPH_UPDATED in sph.h for the equations. */
#ifndef SPH_SOLID_H
#define SPH_SOLID_H

#include "sweep.h"
#include "tensor.h"

#define sph_stage_rate SPH_NAME(stage_rate_)
sph_real sph_stage_rate(const sph_sim *sim); /* sort.c: share of dt by which the stage's sort advances rates */

/* solid.c: the stress of particles first .. last of the destination buffer */
enum { SPH_STRESS_CARRY, SPH_STRESS_CORRECT, SPH_STRESS_WHOLE, SPH_STRESS_RK };
#define sph_advance_stress SPH_NAME(advance_stress_)
void sph_advance_stress(sph_sim *sim, uint32_t first, uint32_t last, uint32_t how);
/* damage.c: grows the damage of particles first .. last over dt */
#define sph_grow_damage SPH_NAME(grow_damage_)
void sph_grow_damage(sph_sim *sim, uint32_t first, uint32_t last);
/* the stress after damage (xx, yy, zz, xy, xz, yz; Pa) and D, in double, of a particle of a buffer */
#define sph_stress_of SPH_NAME(stress_of_)
double sph_stress_of(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *stress);

#define sph_pass_carry SPH_NAME(pass_carry_)
extern const sph_pass sph_pass_carry;

#endif
