/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* smoothing_length.c: a smoothing length of each particle, by its volume (option `variable_h`):

     h_i = eta (m_i/rho_i)^(1/DIM),   eta = smoothing_length/spacing,   h_min .. h_max times smoothing_length

   (Powell 2012 eq 1.21, the integral of dh/dt = -h/(DIM rho) drho/dt of his 1.22 and Wickramarachchi 2009 eq 2.22).
   It follows from the density, and so is no part of the state. A pair has the mean of both (his 3.46):

     h_ij = (h_i + h_j)/2,   grad W_ij = grad W(x_ij, h_ij),   h_ij in viscosity

   so W_ij is one function for the two, and momentum and angular momentum stay. No terms of grad h: those belong to a
   density that is summed, rho_i = sum m_j W(x_ij, h_i), whose change has them. Here density goes by continuity, drho_i
   = sum m_j v_ij . grad W_ij in the standard scheme, and the force is the one that does its work: sum m_i p_i/rho_i^2
   drho_i is - sum m_i v_i . a_i with these grad W_ij, whatever h_ij is. So total energy stays at every instant, and
   entropy too without viscosity, in every scheme that keeps them with one h (energy.h).

   Steps: the smallest h_i/c_i (sph_energy_mu in energy.c), h_i in the force limit (finish.c), h_min in those of gravity
   and Morris's viscosity (timestep.c). The grid's cells are as wide as h_max asks.

   Array: `wide`, h_i/smoothing_length, a real a particle; a column. Cost: a local pass a force sweep, a division and
   some products a pair; more candidates, as cells grow with h_max. */
#include "dmath.h"
#include "sweep.h"
#include "varying.h"
#include "arithmetic.h"

SPH_OBJECT(smoothing_length)

#if SPH_WITH_VARIABLE_H
sph_status sph_check_smoothing_length(const sph_config *c, sph_report *r)
{
    if (!c->variable_h)
        return SPH_OK;
    if (c->eos != SPH_IDEAL_GAS)
        return sph_refuse(r, "variable_h", "false unless eos is SPH_IDEAL_GAS", 1);
    if (sph_sums_density(c) || sph_filters(c))
        return sph_refuse(r, "variable_h", "false where density is summed or filtered", 1);
    if (sph_corrects_fluids(c) || sph_shears(c))
        return sph_refuse(r, "variable_h", "false with corrected gradients or a viscous stress", 1);
    if (sph_diffusive(c->diffusion) || sph_uses_xsph(c) || sph_shifts(c))
        return sph_refuse(r, "variable_h", "false with diffusion, xsph or shifting", 1);
    return SPH_OK;
}

double sph_relative_h(const sph_sim *sim, const sph_set *set, double d)
{
    const sph_config *c = &sim->cfg;
    const double rho = set->rho0 * (1 + d), dx = c->spacing;
    const double volume = set->mass / (SPH_DIM == 1 ? dx : SPH_DIM == 2 ? dx * dx : dx * dx * dx) / rho;
    double wide = c->h_max; /* below no density within a step, at whose end that is a failure */
    if (rho > 0)
        wide = SPH_DIM == 1 ? volume : SPH_DIM == 2 ? __builtin_sqrt(volume) : sph_pow(volume, 1.0 / 3);
    return wide < c->h_min ? c->h_min : wide < c->h_max ? wide : c->h_max;
}

void sph_load_wide(const sph_candidates *r, sph_real *to, uint32_t row)
{
    (void)row;
    for (uint32_t j = 0; j < r->n; j += SPH_W)
        v_store(to + j, v_load(r->sim->wide + r->first + j));
}

static void smoothing_length_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = b->set[0][i];
        const bool body = set != SPH_DEAD && sph_is_matter(&sim->set[set]);
        sim->wide[i] = body ? (sph_real)sph_relative_h(sim, &sim->set[set], (double)b->rho[0][i]) : 1;
    }
    t->work += span.last - span.first;
}
static bool varies(const sph_sim *sim) { return sph_varies_h(&sim->cfg); }
const sph_pass sph_pass_smoothing_length = {"smoothing length", sph_local_chunks, smoothing_length_chunk, NULL, varies};
#endif
