/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* energy.c: the energy equation (energy.h): sound speeds as a column, the rate of a particle from its sums, and what
   the step's limits are to know of sound.

   The limits are made of the sound of sets (timestep.c): that of a gas particle is told as an |mu|, by which the
   Courant limit cfl h/(c0 + h mu) is the one of c_i + h mu_i; and where viscosity would ask for less, viscous_factor
   h^2/nu with nu = alpha c_i h/(2 (DIM + 2)), that one. Where h varies (c_i + h_i mu_i)/h_i is what is told. Where a
   gas is colder than its set began the step is shorter than it need.

   Fields: u and its rate, 2 reals a particle in each buffer. Cost: a column and a sum in the force loop. */
#include "energy.h"
#include "varying.h"
#include "arithmetic.h"

SPH_OBJECT(energy)

#if SPH_WITH_ENERGY
void sph_load_energy(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const bool gas = sph_is_gas(r->set);
    const double gamma = r->sim->cfg.gamma;
    const vreal factor = v_set((sph_real)(gamma * (gamma - 1))), own = v_set((sph_real)r->set->c0);
    (void)row;
    for (uint32_t j = 0; j < r->n; j += SPH_W) /* below 0 it may be within a step, at whose end that is a failure */
        v_store(to + j, gas ? v_sqrt(factor * v_pos(v_load(r->b->energy[0] + r->first + j))) : own);
}

void sph_finish_energy(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real d)
{
    const sph_set *set = &sim->set[t->home_set[h]];
    sim->buf[sim->dst].denergy[0][t->home_at[h]] =
        sph_gas_ratio(sim, t, h) * (d * set->rho0_r) + v_fold(t->sum[SUM_HEAT][h]) * sim->fac.slope;
}

sph_real sph_energy_mu(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real mu)
{
    const sph_config *c = &sim->cfg;
    const sph_set *set = &sim->set[t->home_set[h]];
    const bool artificial = sph_viscous(c->viscosity) && !SPH_IS(c->viscosity, MORRIS);
    const double viscous = artificial ? sim->courant * c->alpha / (2 * (SPH_DIM + 2) * c->viscous_factor) : 0;
    const double sound = (double)sph_home_sound(sim, t, h) * (viscous > 1 ? viscous : 1);
    const double wide = (double)sph_home_wide(sim, t, h);
    const sph_real told = mu + (sph_real)((sound / wide - set->c0) / c->smoothing_length);
    return (sph_is_gas(set) || sph_varies_h(c)) && told > mu ? told : mu;
}
#endif
