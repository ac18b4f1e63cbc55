/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* limits.c: what each limit of the time step allows (Gray 2001 eq 2.30; Wickramarachchi 2009 eqs 3.88-3.90):
     courant    cfl h/(c + h max|mu|)       c: the fastest sound of any set; of solids with 4 mu/3 rho0 (Gray 5.52)
     viscous    viscous_factor h^2/nu       nu of Morris, or alpha c0 h/(2 (DIM + 2)) of the artificial viscosity, and
                nu of a viscous stress (its large eddies: shear.c)
     force      force_factor sqrt(h/max|a|) gravity  gravity_factor h/(c + sqrt(g h))
     diffusion  f h/(delta c0)              c0: the fastest of the bodies' sets, as both are made with it; f: 7/8 of
                what the integrator stands (sph/factors.c): 1/8 (Wendland C4: 0.095), twice that in Runge-Kutta, half of
                it in the predictor-corrector of fluids
   In the total form the configuration's sound speed counts too: contact pushes with it.
   The predictor-corrector stands less (sph/factors.c says why): in fluids 0.5, with corrected gradients 0.25
   (kick-drift-kick and leap-frog stand 0.9 with these); beside
   solids 0.22 times the cube root of (delta + nu/(h c) or alpha/8)/(0.01/8), times 0.75 (updated) or 0.42, but 0.05 at
   least. With the damper 1.5/(1 + 2 theta) at most, in the predictor-corrector 1/(1 + 4 theta) of what it stands.
   Runge-Kutta, which multiplies an oscillation by 1 + (w dt)^4/8 where the predictor-corrector has a fourth:
   beside solids the cube root of 2 times that. */
#include "oracle.h"

double o_courant_number(const sph_config *c)
{
    double d = c->diffusion ? c->delta : 0;
    const bool rk = (c->integrator == SPH_RUNGE_KUTTA || c->integrator == SPH_RUNGE_KUTTA_MOMENTUM) && c->solid;
    const bool kicks = c->gradient && (c->integrator == SPH_KICK_DRIFT_KICK || c->integrator == SPH_LEAP_FROG);
    if (c->integrator != SPH_PREDICTOR_CORRECTOR && !rk)
        return o_min(o_min(c->cfl, c->damper > 0 ? 1.5 / (1 + 2 * c->damper) : c->cfl), kicks ? 0.9 : c->cfl);
    if (c->viscosity == SPH_MORRIS)
        d += c->nu / (c->smoothing_length * c->sound_speed);
    else if (c->viscosity)
        d += c->alpha / 8;
    if (!c->solid)
        return o_min(c->cfl, (c->gradient ? 0.25 : 0.5) / (1 + 4 * c->damper));
    const double x = d / (0.01 / 8), stands = x < 1e-3 ? 0 : 0.22 * cbrt(o_min(x, 1e6));
    const bool plain = c->solid <= SPH_UPDATED || c->solid == SPH_STABILISED;
    const double own = o_max(stands * (plain ? 0.75 : 0.42), 0.05);
    return o_min(c->cfl, own * (rk ? cbrt(2) : 1));
}

static double diffusion_number(const sph_config *c)
{
    const double f = 7.0 / 8 / (c->kernel == SPH_WENDLAND_C4 ? 9.2 : 7);
    if (c->integrator == SPH_RUNGE_KUTTA || c->integrator == SPH_RUNGE_KUTTA_MOMENTUM)
        return 2 * f;
    return c->integrator == SPH_PREDICTOR_CORRECTOR && !c->solid ? f / 2 : f;
}

o_limits o_find_limits(const o_scene *s)
{
    const sph_config *c = &s->cfg;
    const double h = c->smoothing_length;
    o_limits l = {0};
    l.courant_scale = 1;
    double sound = c->solid == SPH_TOTAL ? c->sound_speed : 0, nominal = sound, mu = 0, edge = 0, a = 0, g2 = 0;
    for (uint32_t k = 0; k < s->sets; k++) {
        const o_set *set = &s->set[k];
        const double own = o_sound(set->eos, set->c0);
        if (set->role == SPH_ROLE_FLUID || set->role == SPH_ROLE_SOLID)
            nominal = o_max(nominal, set->c0);
        sound = o_max(sound, set->role == SPH_ROLE_SOLID ? sqrt(own * own + 4 * set->shear / (3 * set->rho0)) : own);
    }
    for (uint32_t k = 0; k < s->n; k++) {
        const o_particle *p = &s->own[k];
        if (!o_is_body(s, p))
            continue;
        mu = o_max(mu, p->mu);
        edge = o_max(edge, p->mu_at_edge);
        if (o_is_gas(s, p) || c->variable_h) {
            const double told = o_max(p->mu, c->shear != SPH_NO_SHEAR ? p->eddy : 0) + o_sound_as_mu(s, p);
            mu = o_max(mu, told);
            l.courant_scale = 1 + 4 * p->c / (sound + c->smoothing_length * mu);
        }
        if (c->shear != SPH_NO_SHEAR && p->eddy > mu) {
            mu = p->eddy;
            l.courant_scale = p->eddy_scale;
        }
        a = o_max(a, sqrt(p->a[0].v * p->a[0].v + p->a[1].v * p->a[1].v + p->a[2].v * p->a[2].v) * h / o_own_h(s, p));
    }
    for (int k = 0; k < SPH_DIM; k++)
        g2 += c->gravity[k] * c->gravity[k];
    if (c->dt > 0)
        return l;
    const double nu = c->viscosity == SPH_MORRIS ? c->nu
                    : (c->viscosity ? c->alpha * nominal * h / (2 * (SPH_DIM + 2)) : 0) +
                      (c->shear ? c->nu : 0);
    l.courant_undecided = h * edge > h * mu + (SPH_DOUBLE ? 1e-13 : 1e-7) * sound;
    mu = o_max(mu, edge);
    l.courant = o_courant_number(c) * h / (sound + h * mu);
    const double least = o_least_h(s), thin = c->viscosity == SPH_MORRIS ? least : h; /* artificial: by particle */
    l.viscous = nu > 0 ? c->viscous_factor * thin * thin / nu : 0;
    l.force = a > 0 ? c->force_factor * sqrt(h / a) : 0;
    l.gravity = g2 > 0 ? c->gravity_factor * least / (sound + sqrt(sqrt(g2) * least)) : 0;
    l.diffusion = c->diffusion && c->delta > 0 ? diffusion_number(c) * h / (c->delta * nominal) : 0;
    return l;
}
