/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* books.c: totals of fluid and solid, and the powers that the books keep (sph.h, sph_totals):
     kinetic m v^2/2, potential -m g.x, internal: the integral of p/rho^2 d rho of the pressure that acts (states.c; of
     damaged tension (1 - D) of it), elastic (1 - D) S:S/(4 mu) a volume m/rho0, plastic work Y0 e + hardening e^2/2
     powers of viscosity, walls and held sets, of the body force; and what density diffusion takes: -p/rho^2 (drho)
   The first four rise by the powers of walls and body forces less all that the books say is taken, at every instant and
   to rounding (sph.h). Their rise follows from accelerations and rates alone: m a.v - m g.(v + xsph) + m p/rho^2 drho +
   (1 - D) (m/rho0) S:dS/(2 mu), where along held axes the motion is told. */
#include "oracle.h"

static void solid_totals(const o_scene *s, const o_particle *p, o_totals *o)
{
    const o_set *set = &s->set[p->set];
    const double volume = o_phi(p) * set->mass / set->rho0, damage = pow(p->root, SPH_DIM);
    double square = 0;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            square += p->dev[k][l] * p->dev[k][l];
    if (set->shear > 0)
        o_add(&o->elastic, volume * (1 - damage) * square / (4 * set->shear),
              volume * (square + 1e-15 * p->p * p->p) / (4 * set->shear));
    o_plus(&o->plastic, volume * p->plastic * (set->yield + 0.5 * set->hardening * p->plastic));
}

bool o_loses(const o_scene *s)
{
    const sph_config *c = &s->cfg;
    bool loses = c->scheme == SPH_DIRECT || c->scheme == SPH_STANDARD_WICK || c->scheme == SPH_WEAK_WICK;
    loses |= c->gradient_guard;
    loses |= c->solid == SPH_STABILISED || o_normalises(s);
    loses |= (c->xsph_strain && o_has_solids(s)) || (c->density == SPH_SUMMATION && o_is_weak(s));
    for (int k = 0; k < SPH_DIM; k++)
        loses |= c->face[k][0] == SPH_MIRROR_NO_SLIP || c->face[k][1] == SPH_MIRROR_NO_SLIP;
    return loses;
}

double o_diffused_per_rate(const o_scene *s, const o_particle *p)
{
    if (o_is_gas(s, p))
        return 0;
    const double acts = p->p < 0 ? (1 - pow(p->root, SPH_DIM)) * p->p : p->p;
    return -o_phi(p) * acts / (p->rho * p->rho);
}

/* how fast the energy of a particle rises */
static void rise_of(const o_scene *s, const o_particle *p, o_sum *o)
{
    const o_set *set = &s->set[p->set];
    const double m = set->mass, per = -o_diffused_per_rate(s, p), whole = o_phi(p) * (1 - pow(p->root, SPH_DIM));
    const bool carried = o_is_carried(s, p); /* only the potential energy changes */
    for (int k = 0; k < SPH_DIM; k++) {
        const double g = s->cfg.gravity[k], drift = o_drifts(s) ? p->drift[k].v : 0;
        o_add(o, m * p->a[k].v * p->v[k], m * p->a[k].s * fabs(p->v[k]));
        o_add(o, -m * g * (p->v[k] + drift), m * fabs(g) * (fabs(p->v[k]) + fabs(drift)));
    }
    if (carried)
        return;
    o_add(o, m * p->warmed.v, m * p->warmed.s);
    const o_sum rate = s->cfg.density == SPH_SUMMATION ? p->moved_rate : p->rate;
    o_add(o, m * per * rate.v, m * fabs(per) * rate.s);
    if (s->cfg.density == SPH_SUMMATION)
        o_add(o, -m * per * p->unseen_rate.v, m * fabs(per) * p->unseen_rate.s);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            if (o_is_solid(s, p) && set->shear > 0)
                o_add(o, whole * m / set->rho0 * p->dev[k][l] * p->stress_rate[k][l].v / (2 * set->shear),
                      whole * m / set->rho0 * fabs(p->dev[k][l]) * p->stress_rate[k][l].s / (2 * set->shear));
}

double o_energy_of(const o_scene *s, const o_particle *p)
{
    const o_set *set = &s->set[p->set];
    const bool solid = o_is_solid(s, p);
    const double m = set->mass, whole = p->d < 0 && solid ? 1 - pow(p->root, SPH_DIM) : 1;
    o_totals o = {0};
    double sum = 0.5 * m * o_dot(p->v, p->v) + m * p->u;
    for (int k = 0; k < SPH_DIM; k++)
        sum -= m * s->cfg.gravity[k] * p->x[k];
    sum += m * o_phi(p) * whole * o_energy(set->eos, set->rho0, set->c0, p->d, s->cfg.pressure_floor && !solid);
    if (solid)
        solid_totals(s, p, &o);
    return sum + o.elastic.v + o.plastic.v;
}

o_totals o_find_totals(const o_scene *s)
{
    o_totals o = {0};
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        const o_set *set = &s->set[p->set];
        const double m = set->mass;
        if (!o_is_body(s, p))
            continue;
        o_plus(&o.mass, m);
        o_plus(&o.kinetic, 0.5 * m * o_dot(p->v, p->v));
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, n = (k + 2) % 3;
            o_plus(&o.momentum[k], m * p->v[k]);
            o_add(&o.angular[k], m * (p->x[l] * p->v[n] - p->x[n] * p->v[l]),
                  m * (fabs(p->x[l] * p->v[n]) + fabs(p->x[n] * p->v[l])));
            if (k < SPH_DIM)
                o_plus(&o.potential, -m * s->cfg.gravity[k] * p->x[k]);
        }
        double stored = o_energy(set->eos, set->rho0, set->c0, p->d, s->cfg.pressure_floor && !o_is_solid(s, p));
        if (o_is_solid(s, p) && p->d < 0)
            stored *= 1 - pow(p->root, SPH_DIM);
        stored *= o_phi(p);
        o_add(&o.internal, m * stored, m * set->c0 * set->c0 * (fabs(p->d) + fabs(stored) / (set->c0 * set->c0)));
        o_plus(&o.internal, m * p->u);
        if (o_is_solid(s, p))
            solid_totals(s, p, &o);
        const double per = o_diffused_per_rate(s, p);
        rise_of(s, p, &o.rise);
        o_add(&o.dissipated, m * p->viscous.v, m * p->viscous.s);
        o_add(&o.worked, m * p->worked.v, m * p->worked.s);
        o_add(&o.diffused, m * per * p->diffused.v, m * fabs(per) * p->diffused.s);
        o_add(&o.pushed, m * p->pushed.v, m * p->pushed.s);
    }
    return o;
}
