/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* motion.h: how particles and their fields get from one state buffer into another (faces.c, move.c, carry.c, sort.c,
   settle.c).

   A stage sorts the particles of buffer src into buffer dst: the sort moves positions, velocities and densities, then
   every other field is carried to where its particle went. Until the stage settles, array id of dst holds each
   particle's index in src (sph_source_index); after that, ids. */
#ifndef SPH_MOTION_H
#define SPH_MOTION_H

#include "sweep.h"

/* ---- faces.c ---- */

/* Applies the rules of the domain's faces to a place. Returns what mirrors turned (sph_turn_of), and SPH_LEFT where it
   is outside an open face. */
#define SPH_LEFT 64u
#define sph_enforce_faces SPH_NAME(enforce_faces_)
uint32_t sph_enforce_faces(const sph_sim *sim, sph_pos *q);
/* notes that a particle which sph_enforce_faces left at q has left the domain, and through which face */
#define sph_note_left SPH_NAME(note_left_)
#if SPH_WITH_DETAILS
void sph_note_left(const sph_sim *sim, const sph_pos *q, uint32_t id, sph_thread *t);
#else
SPH_INLINE void sph_note_left(const sph_sim *sim, const sph_pos *q, uint32_t id, sph_thread *t)
{
    sph_fail_note(t, SPH_OUT_OF_DOMAIN, id, (double)q[0] * sim->grid.quantum);
}
#endif

/* ---- move.c: a block of particles of buffer src ---- */

/* A displacement of d quanta takes a particle floor(|d| + u) of them, with d's sign; u, in 0 .. 1, is the same for all
   and walks by the golden ratio from step to step. Its first n values fill the interval evenly to less than 1.5 +
   0.35 ln n of them (the logarithm: Niederreiter 1992, chapter 3; the constants: measured, n up to 1e6), so that is
   how many quanta the sum of n steps is off where d changes slowly, however small d is: no remainder has to be kept.
   What is at rest stays, and what is mirrored moves mirrored. */
SPH_INLINE sph_real sph_rounding(const sph_sim *sim)
{
    const uint32_t walk = (uint32_t)sim->next.step * 0x9e3779b9u; /* 2^32 (sqrt 5 - 1)/2 */
    return (sph_real)(walk >> 8) * (sph_real)5.9604644775390625e-8; /* 2^-24 */
}

/* displacement = drift (v + drift velocity) + bend a, v' = damping (v + kick a), rho' = rho + rate drho, and +
   foresight rise in the predictor-corrector; part: see sph_rounding */
typedef struct sph_move {
    sph_real drift, bend, kick, rate, foresight, damping, part, slowed;
} sph_move;
/* what damping by a rate multiplies velocities by before all else of a step; 1 in other sorts */
#define sph_slowed_by SPH_NAME(slowed_by_)
sph_real sph_slowed_by(const sph_sim *sim);
#define sph_stage_move SPH_NAME(stage_move_)
sph_move sph_stage_move(const sph_sim *sim);

/* Particles i .. i + n of src into the block: new positions inside the domain and who is gone; `all`: velocities and
   densities too. Returns true if nobody is gone and nothing is wrong. Failures and losses are noted for the particles
   own_from .. own_to. */
#define sph_move_block SPH_NAME(move_block_)
bool sph_move_block(const sph_sim *sim, const sph_move *a, uint32_t i, uint32_t n, bool all, uint32_t own_from,
                    uint32_t own_to, sph_thread *t);

/* ---- carry.c: fields that are carried or evolve, of particles first .. last of dst ---- */

#define sph_carry_fields SPH_NAME(carry_fields_)
void sph_carry_fields(sph_sim *sim, sph_span s);   /* after the sort: from src, evolved by the stage's share of dt */
#define sph_correct_fields SPH_NAME(correct_fields_)
void sph_correct_fields(sph_sim *sim, sph_span s); /* + dt/2 (new rate - rate in src) */
#define sph_retake_fields SPH_NAME(retake_fields_)
void sph_retake_fields(sph_sim *sim, sph_span s);  /* from src again, + dt new rate */
#define sph_displace_again SPH_NAME(displace_again_)
void sph_displace_again(const sph_sim *sim, sph_span s); /* displacements once more: positions have changed since */
/* mirrors turned particle i of dst: all that it has but displacements (see sph_turn_of) */
#define sph_turn_fields SPH_NAME(turn_fields_)
void sph_turn_fields(const sph_sim *sim, uint32_t i, uint32_t turned);
/* a particle of b is displaced by d quanta along axis k otherwise than by the sort */
#define sph_displace_fields SPH_NAME(displace_fields_)
void sph_displace_fields(const sph_sim *sim, const sph_buffer *b, uint32_t i, uint32_t k, sph_pos d);

/* whether the scene has fields of one of these ways (bits 1 << SPH_CARRIED ...): false where all of them were
   compiled out */
SPH_INLINE bool sph_has_ways(const sph_config *c, uint32_t ways)
{
    (void)c;
    return false
#define SPH_FIELD_ASKED(name, type, comps, unit, when, way) || ((ways >> ((way) & SPH_WAYS) & 1) && (when))
    SPH_STATE_FIELDS(SPH_FIELD_ASKED);
#undef SPH_FIELD_ASKED
}
#define SPH_CARRIED_WAYS (1u << SPH_RATE | 1u << SPH_CARRIED | 1u << SPH_DISPLACED | 1u << SPH_EVOLVING)

/* ---- sort.c ---- */

/* begins a stage that moves the `count` particles of src to dst; table: cell[] belongs to src */
#define sph_begin_sort SPH_NAME(begin_sort_)
void sph_begin_sort(sph_sim *sim, uint32_t src, uint32_t dst, uint32_t count, bool table, const sph_stage *stage);

/* ---- settle.c: the end of a stage ---- */

#define sph_settle SPH_NAME(settle_)
void sph_settle(const sph_sim *sim, sph_span s); /* indices become ids; walls get zeros that sums did not write */
#define sph_check SPH_NAME(check_)
void sph_check(const sph_sim *sim, sph_span s, sph_thread *t); /* notes who must not go on */

#endif
