/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* energy.h: the energy equation, in the force loop (option `energy`). Each particle has an energy u (J/kg). Of an ideal
   gas it is all of the internal energy, p = (gamma - 1) rho u, and

     du_i = p_i/rho_i^2 drho_i + q_i,   drho_i the scheme's own rate by motion (continuity.h), which is, a scheme each,
       standard   sum m_j (p_i/rho_i^2) v_ij . grad W                      (Wickramarachchi 2009 eq 3.42)
       weak       sum m_j p_i/(rho_i rho_j) v_ij . grad W                  (of 3.80 and the weak rate of density)
       direct     as weak                                                  (his 3.23)
       printed    sum m_j (p_i/rho_i^2 + p_j/rho_j^2)/2 v_ij . grad W, sum m_j p_j/(rho_i rho_j) v_ij . grad W
                                                                           (his 3.52, 3.81)
     T dS_i/dt = q_i: half of what viscosity takes on the relative velocity that it sees (3.36-3.38):
       artificial    sum m_j Pi/2 v_ij . grad W, Morris sum m_j fm v_ij^2/2, a viscous stress tau_i : L_i/rho_i
     (beside walls the other half, or what else their motion takes, is not heat of the fluid)

   so total energy stays at every instant but for `direct`, and q is not negative: entropy never falls (but with
   renormalised gradients, where Pi acts along B_ij x_ij and may give energy). Density
   diffusion and filters change the density of a gas, not its energy. Of other fluids u is heat alone, du = q, beside
   the energy of compression that follows from their density (eos.h).

   Viscosity sees sound c = sqrt(gamma (gamma - 1) u) of each gas particle, the mean of both in a pair, and so do the
   limits of the step (energy.c). */
#ifndef SPH_ENERGY_H
#define SPH_ENERGY_H

#include "term.h"

/* what a home brings: its sound speed (m/s), alpha h (m), p/rho^2 of a gas, of others 0 */
typedef struct sph_energy_home {
    vreal sound, viscous, ratio;
} sph_energy_home;

/* p/rho^2 of a home that is a gas, else 0 */
SPH_INLINE sph_real sph_gas_ratio(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_real press = t->home.press[h], rho = t->home.rho[h];
    if (!sph_is_gas(&sim->set[t->home_set[h]]))
        return 0;
    return sph_weak_scheme(sim->cfg.scheme) ? press / (rho * rho) : press;
}

/* sound of a home (m/s); ghosts have no place in the columns */
SPH_INLINE sph_real sph_home_sound(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_set *set = &sim->set[t->home_set[h]];
    return sph_is_gas(set) ? sph_home_columns_of(sim, t, SPH_COLUMN_energy)[h] : (sph_real)set->c0;
}

SPH_INLINE sph_energy_home sph_spread_energy(const sph_sim *sim, const sph_thread *t, uint32_t h)
{
    sph_energy_home o;
    o.sound = v_set(sph_home_sound(sim, t, h));
    o.viscous = v_set((sph_real)(sim->cfg.smoothing_length * sim->cfg.alpha));
    o.ratio = v_set(sph_gas_ratio(sim, t, h));
    return o;
}

/* h alpha (c_i + c_j), of which viscosity is made; a wall has the home's sound. row: the candidates' */
SPH_INLINE vreal sph_pair_sound(const sph_choice *c, const sph_energy_home *o, const sph_real *row, const sph_near *p)
{
    if (!SPH_WITH_ENERGY || !c->energy)
        return v_set(0);
    return o->viscous * (o->sound + (p->wall ? o->sound : v_load(row + p->j)));
}

/* q of a pair, but for a viscous stress (shear.h), less what diffusion of density is not to give */
SPH_INLINE void sph_heat(const sph_choice *c, const sph_energy_home *o, const sph_near *p, vreal *s)
{
    if (!SPH_WITH_ENERGY || !c->energy || !sph_takes_rates(c))
        return;
    s[SUM_HEAT] = s[SUM_HEAT] + sph_pair_heat(c, p) - o->ratio * p->diff;
}

/* du_i of a home whose relative density rises by d (1/s), diffusion included */
#define sph_finish_energy SPH_NAME(finish_energy_)
void sph_finish_energy(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real d);
/* the |mu| of a home's pairs, or what its sound makes of it for the step's limits */
#define sph_energy_mu SPH_NAME(energy_mu_)
sph_real sph_energy_mu(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real mu);
#define sph_load_energy SPH_NAME(load_energy_)
void sph_load_energy(const sph_candidates *r, sph_real *to, uint32_t row);

#endif
