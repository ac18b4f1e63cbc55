/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* totals.c: mass, momentum and energies of fluid and solid, and the books that the steps keep. */
#include "reading.h"
#include "arithmetic.h"

SPH_OBJECT(totals)

#if SPH_WITH_TOTALS
static void add_particle_totals(const sph_sim *sim, const sph_buffer *b, uint32_t i, sph_totals *o)
{
    const sph_set *s = &sim->set[b->set[0][i]];
    double x[3] = {0, 0, 0}, v[3] = {0, 0, 0}, v2 = 0, m = s->mass, rho = s->rho0 * (1 + (double)b->rho[0][i]);
    sph_position(sim, b, i, x);
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = (double)b->vel[k][i];
        v2 += v[k] * v[k];
        o->momentum[k] += m * v[k];
    }
    o->angular[0] += m * (x[1] * v[2] - x[2] * v[1]);
    o->angular[1] += m * (x[2] * v[0] - x[0] * v[2]);
    o->angular[2] += m * (x[0] * v[1] - x[1] * v[0]);
    o->mass += m;
    const sph_energy e = sph_energy_of(sim, b, i);
    o->kinetic += e.kinetic;
    o->potential += e.potential;
    o->internal += e.internal;
    o->elastic += e.elastic;
    o->plastic_work += e.plastic;
    o->solid += s->role == SPH_ROLE_SOLID;
    o->max_speed = v2 > o->max_speed ? v2 : o->max_speed;
    o->min_density = rho < o->min_density || o->mass <= m ? rho : o->min_density; /* the first so far has mass m */
    o->max_density = rho > o->max_density ? rho : o->max_density;
    o->fluid += s->role == SPH_ROLE_FLUID;
}

void sph_get_totals(const sph_sim *sim, sph_totals *out)
{
    if (!sim || !out)
        return;
    const sph_buffer *b = &sim->buf[sim->cur];
    memset(out, 0, sizeof *out);
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (sph_body_at(sim, b, i))
            add_particle_totals(sim, b, i, out);
        else
            out->wall += b->set[0][i] != SPH_DEAD;
    out->max_speed = __builtin_sqrt(out->max_speed);
    out->dissipated = sim->now.work[POWER_DISSIPATED];
    out->wall_work = sim->now.work[POWER_WALL];
    out->diffused = sim->now.work[POWER_DIFFUSED];
    out->body_work = sim->now.work[POWER_BODY_FORCE];
    out->in_walls = sim->now.work[POWER_IN_WALLS];
    out->in_bonds = sim->now.work[POWER_IN_BONDS];
    out->unbalanced = sim->now.work[POWER_UNBALANCED];
#define BOOK_TOTAL(name, unit, when, what) out->name = sim->now.name;
    SPH_BOOKS(BOOK_TOTAL)
    out->balance = out->kinetic + out->potential + out->internal + out->elastic + out->plastic_work - out->wall_work -
        out->body_work + out->dissipated + out->diffused + out->in_walls + out->in_bonds + out->unbalanced +
        out->absorbed + out->shifted + out->quieted + out->slowed + out->evened + out->carried_off + out->released +
        out->put_back_loss + out->filtered + out->damped - out->fed;
}
#endif
