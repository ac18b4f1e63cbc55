/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* reading.c: what a host reads of particles between steps. */
#include "reading.h"
#include "arithmetic.h"

SPH_OBJECT(reading)

uint32_t sph_count(const sph_sim *sim) { return sim ? sim->now.count : 0; }

sph_status sph_get(const sph_sim *sim, uint32_t i, sph_particle *out)
{
    if (!sim || i >= sim->now.count || !out)
        return SPH_BAD_ARGUMENT;
    const sph_buffer *b = &sim->buf[sim->cur];
    memset(out, 0, sizeof *out);
    out->id = b->id[0][i];
    out->set = b->set[0][i];
    sph_position(sim, b, i, out->x);
    for (int k = 0; k < SPH_DIM; k++) {
        out->v[k] = (double)b->vel[k][i];
        out->a[k] = (double)b->acc[k][i];
    }
    if (out->set == SPH_DEAD)
        return SPH_OK;
    const sph_set *s = &sim->set[out->set];
    out->role = s->role;
    out->mass = s->mass;
    out->rho = s->rho0 * (1 + (double)b->rho[0][i]);
    out->p = sph_pressure(sim, s, (double)b->rho[0][i]);
    if (sph_has_energy(&sim->cfg)) {
        out->p = sph_pressure_at(sim, b, i);
        out->energy = (double)b->energy[0][i];
    }
    if (SPH_WITH_VARIABLE_H)
        out->h = sim->cfg.smoothing_length;
    if (sph_varies_h(&sim->cfg) && sph_is_matter(s))
        out->h *= sph_relative_h(sim, s, (double)b->rho[0][i]);
    for (int k = 0; SPH_WITH_SOLID && k < 3; k++)
        out->stress[k] = -out->p;
    if (SPH_WITH_SOLID && sph_is_solid(s)) {
        out->damage = sph_stress_of(sim, b, i, out->stress);
        out->plastic = sph_plastic_at(b, i);
    }
    if (!sph_is_matter(s))
        for (int k = 0; k < SPH_DIM; k++)
            out->v[k] = sim->now.group[s->group].vel[k];
    return SPH_OK;
}
