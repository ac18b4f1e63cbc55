/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* varying.h: h of a particle where it varies (smoothing_length.c), and what the force loop makes of it: grad W_ij with
   h_ij is (h/h_ij)^(DIM + 2) times what the kernel gives for r/h_ij with the scale of h, the configuration's. */
#ifndef SPH_VARYING_H
#define SPH_VARYING_H

#include "term.h"

SPH_INLINE bool sph_varies(const sph_choice *c) { return SPH_WITH_VARIABLE_H && c->varies; }

/* h_i/h of a home */
SPH_INLINE sph_real sph_home_wide(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    return sph_varies_h(&sim->cfg) ? sph_home_columns_of(sim, t, SPH_COLUMN_wide)[h] : 1;
}

/* h_ij/h and h/h_ij of a pair; row: the candidates' */
SPH_INLINE void sph_pair_width(const sph_choice *c, vreal home, const sph_real *row, sph_near *p)
{
    if (!sph_varies(c))
        return;
    p->wide = (home + v_load(row + p->j)) * (sph_real)0.5;
    p->narrow = 1 / p->wide;
    p->q = p->q * p->narrow;
}

/* (h/h_ij)^(DIM + 2) on what goes with grad W */
SPH_INLINE vreal sph_narrowed(const sph_choice *c, const sph_near *p, vreal slope)
{
    if (!sph_varies(c))
        return slope;
    const vreal n2 = p->narrow * p->narrow;
    return slope * (SPH_DIM == 1 ? n2 * p->narrow : SPH_DIM == 2 ? n2 * n2 : n2 * n2 * p->narrow);
}

/* h alpha (c_i + c_j) + 2 h^2 beta |mu| with h_ij; sound: the first with h */
SPH_INLINE vreal sph_varied_strength(const sph_choice *c, const sph_factors *f, vreal sound, vreal mu,
                                     const sph_near *p)
{
    return p->wide * (c->beta ? sound + f->av_beta * (mu * p->wide) : sound);
}

/* the square of an |a| whose force limit with h is that of a home with h_i */
SPH_INLINE sph_real sph_told_acc(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real a2)
{
    const sph_real wide = sph_home_wide(sim, t, h);
    return sph_varies_h(&sim->cfg) ? a2 / (wide * wide) : a2;
}

#define sph_load_wide SPH_NAME(load_wide_)
void sph_load_wide(const sph_candidates *r, sph_real *to, uint32_t row);

#endif
