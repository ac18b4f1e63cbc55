/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* totals.c: mass, momentum and energies of fluid and solid, and the books that the steps keep. */
#include "reading.h"
#include "arithmetic.h"

SPH_OBJECT(totals)

#if SPH_WITH_TOTALS
/* what solids have besides: (1 - D) S:S/(4 mu), and the work of yielding */
static void add_solid_totals(const sph_sim *sim, const sph_buffer *b, uint32_t i, sph_totals *o)
{
    const sph_set *s = &sim->set[b->set[0][i]];
    const sph_material *rock = sph_material_of(sim, s);
    const double m = s->mass, ep = sph_plastic_at(b, i);
    double sigma[6], w = 0;
    const double whole = 1 - sph_stress_of(sim, b, i, sigma), p = (sigma[0] + sigma[1] + sigma[2]) / 3;
    for (int k = 0; k < 6; k++)
        w += (k < 3 ? (sigma[k] - p) * (sigma[k] - p) : 2 * sigma[k] * sigma[k]);
    if (rock->shear > 0 && whole > 0)
        o->elastic += m / s->rho0 * w / (4 * rock->shear * whole);
    o->plastic_work += m / s->rho0 * ep * (rock->yield + 0.5 * rock->hardening * ep);
    o->solid++;
}

static void add_particle_totals(const sph_sim *sim, const sph_buffer *b, uint32_t i, sph_totals *o)
{
    const sph_set *s = &sim->set[b->set[0][i]];
    double x[3] = {0, 0, 0}, v[3] = {0, 0, 0}, v2 = 0, m = s->mass, rho = s->rho0 * (1 + (double)b->rho[0][i]);
    sph_position(sim, b, i, x);
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = (double)b->vel[k][i];
        v2 += v[k] * v[k];
        o->momentum[k] += m * v[k];
        o->potential -= m * sim->cfg.gravity[k] * x[k];
    }
    o->angular[0] += m * (x[1] * v[2] - x[2] * v[1]);
    o->angular[1] += m * (x[2] * v[0] - x[0] * v[2]);
    o->angular[2] += m * (x[0] * v[1] - x[1] * v[0]);
    o->mass += m;
    o->kinetic += 0.5 * m * v2;
    o->internal += m * sph_eos_energy(s->eos, (double)s->b_r, s->rho0, (double)b->rho[0][i]);
    if (SPH_WITH_SOLID && sph_is_solid(s))
        add_solid_totals(sim, b, i, o);
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
    out->dissipated = sim->now.work[0];
    out->wall_work = sim->now.work[1];
    out->diffused = sim->now.work[2];
    out->body_work = sim->now.work[3];
#define BOOK_TOTAL(name, unit, when, what) out->name = sim->now.name;
    SPH_BOOKS(BOOK_TOTAL)
}
#endif
