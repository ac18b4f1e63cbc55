/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* state.c: what every file above may ask of a simulation: a failure reported with the pass it happened in, the stress
   of a particle, and the digest of a state buffer. */
#include "internal.h"
#include "arithmetic.h"

SPH_OBJECT(state)

/* each knob is 0 or 1, and what the preprocessor takes a module for agrees with what the list of knobs says it needs */
#define KNOB(name, needs) _Static_assert(SPH_WITH_##name == 0 || SPH_WITH_##name == 1, "a knob is 0 or 1: " #name);
SPH_KNOBS(KNOB)
#undef KNOB
_Static_assert(SPH_HAS_HELD == SPH_IN_HELD && SPH_HAS_TOTAL == SPH_IN_TOTAL_LAGRANGIAN &&
                   SPH_HAS_YIELD == SPH_IN_YIELD && SPH_HAS_DAMAGE == SPH_IN_DAMAGE &&
                   SPH_HAS_REPULSION == SPH_IN_ARTIFICIAL_STRESS &&
                   SPH_HAS_HAT == SPH_IN_XSPH_STRAIN,
               "modules.h: SPH_HAS_... and the needs of its list differ");

sph_status sph_error(sph_sim *sim, sph_status s, const char *what, const char *allowed, double value, uint32_t particle)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    const char *pass = sim->begun && sim->pc < sim->passes ? sim->program[sim->pc]->name : "";
    sph_report *const r = &sim->report;
    const sph_buffer *b = &sim->buf[sim->cur];
    sph_tell(r, what, allowed, value, s);
    r->pass = pass;
    r->particle = particle;
    for (uint32_t i = 0; SPH_WITH_DETAILS && i < sim->now.count; i++)
        if (b->id[0][i] == particle && b->set[0][i] < sim->sets) {
            r->set = b->set[0][i];
            r->role = sim->set[r->set].role;
        }
    if (sim->cfg.port.fault)
        sim->cfg.port.fault(sim->cfg.port.ctx, r);
    return s;
}

static double damage_of(const sph_buffer *b, uint32_t i)
{
    if (!SPH_HAS_DAMAGE || !b->damage[0])
        return 0;
    const double root = (double)b->damage[0][i];
    return SPH_DIM == 3 ? root * root * root : root * root;
}

sph_real sph_whole_of(const sph_buffer *b, uint32_t i) { return (sph_real)(1 - damage_of(b, i)); }

double sph_stress_of(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *stress)
{
    double p = sph_pressure(sim, &sim->set[b->set[0][i]], (double)b->rho[0][i]), d[6] = {0};
    const double damage = damage_of(b, i);
    /* the deviator: what the state keeps, and what follows from a trace of 0 */
    for (uint32_t k = 0; k < SPH_NS; k++)
        d[SPH_DIM > 1 && k > 1 ? k + 1 : k] = (double)b->stress[k][i] * (1 - damage);
    if (SPH_DIM == 1)
        d[1] = d[2] = -0.5 * d[0];
    else
        d[2] = -(d[0] + d[1]);
    p = p < 0 ? p * (1 - damage) : p;
    for (int k = 0; k < 6; k++)
        stress[k] = d[k] - (k < 3 ? p : 0);
    return damage;
}

/* J/kg: the integral of the pressure that acts over 1/rho, of which in tension damage takes its share, and heat; of a
   gas its energy */
static double internal_of(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const sph_set *s = &sim->set[b->set[0][i]];
    const double d = (double)b->rho[0][i];
    if (sph_is_gas(s))
        return (double)b->energy[0][i];
    const double e = sph_eos_energy(s->eos, (double)s->b_r, s->rho0, d, sph_has_floor(sim, s));
    if (sph_has_energy(&sim->cfg))
        return e + (double)b->energy[0][i];
    return sph_pressure(sim, s, d) < 0 ? e * (1 - damage_of(b, i)) : e;
}

/* (1 - D) S:S/(4 mu), J/m^3 */
static double distortion_of(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const double mu = sph_material_of(sim, &sim->set[b->set[0][i]])->shear;
    double s[6], w = 0;
    const double whole = 1 - sph_stress_of(sim, b, i, s), p = (s[0] + s[1] + s[2]) / 3;
    for (int k = 0; k < 6; k++)
        w += k < 3 ? (s[k] - p) * (s[k] - p) : 2 * s[k] * s[k];
    return mu > 0 && whole > 0 ? w / (4 * mu * whole) : 0;
}

sph_real sph_quadrature_of(const sph_buffer *b, uint32_t i)
{
    return SPH_HAS_QUADRATURE && b->quadrature[0] && b->quadrature[0][i] > 0 ? b->quadrature[0][i] : 1;
}

sph_energy sph_energy_of(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const sph_set *s = &sim->set[b->set[0][i]];
    double v2 = 0, fall = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        v2 += (double)b->vel[k][i] * (double)b->vel[k][i];
        fall -= s->mass * sim->cfg.gravity[k] * (sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum);
    }
    sph_energy e = {0.5 * s->mass * v2, fall, s->mass * internal_of(sim, b, i), 0, 0};
    if (SPH_WITH_SOLID && sph_is_solid(s)) {
        const sph_material *m = sph_material_of(sim, s);
        const double ep = SPH_HAS_YIELD && b->plastic[0] ? (double)b->plastic[0][i] : 0;
        const double phi = (double)sph_quadrature_of(b, i), volume = phi * s->mass / s->rho0;
        e.internal *= phi;
        e.elastic = volume * distortion_of(sim, b, i);
        e.plastic = volume * ep * (m->yield + 0.5 * m->hardening * ep);
    }
    return e;
}

uint64_t sph_hash_buffer(const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    uint64_t h = 0x5350482d68617368u;
    const sph_config *c = &sim->cfg;
    (void)c;
#define MIX(name, type, comps, unit, when, way)                                                                       \
    for (uint32_t k = 0; (when) && k < (comps); k++)                                                                  \
        if (b->name[k])                                                                                               \
            h = sph_mix_array(h, b->name[k], sizeof(type), n);
    SPH_STATE_FIELDS(MIX)
#undef MIX
    return h;
}
