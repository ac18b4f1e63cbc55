/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damper.c: the acoustic damper, damping by a rate, XSPH in the velocity (sph.h; Powell 2012 eq 2.71).
     damper        p + theta h c D for p, D = d(rho)/dt at the time of the forces, at least 0 with the floor. D is
                   r + (r - r_o) dt/(dt + dt_o) from the rates of this step's middle and the one's before, of the
                   beginning r + 2 e min(dt/dt_o, 2) where e is half of what r rose by in the last step. The first
                   forces know of none. Taken in a step: dt m q D/rho^2 of its middle.
     damping_rate  v exp(-r dt/2) at the beginning of a step and at its end; leap-frog, whose velocities are ahead by
                   half a step: v exp(-r (dt - dt_o)/2), and at the end e (e v + dt a), e = exp(-r dt/2), for v + dt a
     xsph_velocity v + u at the end of a step
   Their books are what the kinetic energy loses there. */
#include "oracle.h"

void o_quiet(const o_scene *s, o_particle *i, double rate)
{
    const o_set *set = &s->set[i->set];
    const bool acts = o_is_body(s, i) && !o_is_carried(s, i);
    i->quiet = acts ? s->cfg.damper * s->cfg.smoothing_length * set->c0 * set->rho0 * rate : 0;
}

void o_book_quiet(o_scene *s, const o_particle *i, double middle, double dt)
{
    const o_set *set = &s->set[i->set];
    const double p = o_pressure(set->eos, set->rho0, set->c0, i->d);
    double q = s->cfg.damper * s->cfg.smoothing_length * set->c0 * set->rho0 * middle;
    if (!o_is_body(s, i) || o_is_carried(s, i))
        return;
    if (s->cfg.pressure_floor)
        q = o_max(q, -o_max(p, 0));
    const double taken = dt * set->mass * q * set->rho0 * middle / pow(set->rho0 * (1 + i->d), 2);
    o_add(&s->quieted, taken, fabs(taken) + set->mass * pow(set->c0 * middle * dt, 2));
}

static double kinetic(const o_scene *s, const o_particle *i)
{
    return 0.5 * s->set[i->set].mass * o_dot(i->v, i->v);
}

/* damping by the rate over a time, and then `rest` of the acceleration; returns what a particle loses, J */
static double slow(const o_scene *s, o_particle *i, double time, double rest)
{
    const double before = kinetic(s, i);
    for (int k = 0; k < SPH_DIM && o_is_body(s, i) && !o_is_carried(s, i); k++)
        if (!(o_is_solid(s, i) && s->set[i->set].held >> k & 1))
            i->v[k] = i->v[k] * exp(-s->cfg.damping_rate * time) + rest * i->a[k].v;
    return before - kinetic(s, i);
}
void o_slow_first(o_scene *s, double dt, double last)
{
    const double time = s->cfg.integrator == SPH_LEAP_FROG ? 0.5 * (dt - last) : 0.5 * dt;
    for (uint32_t a = 0; a < s->n; a++) {
        o_particle *i = &s->own[a];
        i->lost = s->cfg.damping_rate > 0 ? slow(s, i, time, 0) : 0;
        i->lost = s->set[i->becomes].flow ? 0 : i->lost; /* it will have its velocity again */
        if (s->cfg.integrator < SPH_RUNGE_KUTTA)
            continue;
        o_plus(&s->slowed, i->lost); /* nobody leaves in its first sort */
        i->lost = 0;
    }
}
void o_slow_last(o_scene *s, double dt)
{
    const double half = exp(-0.5 * s->cfg.damping_rate * dt);
    const bool leaps = s->cfg.integrator == SPH_LEAP_FROG;
    for (uint32_t a = 0; a < s->n && s->cfg.damping_rate > 0; a++) {
        const double taken = slow(s, &s->own[a], leaps ? dt : 0.5 * dt, leaps ? (half - half * half) * dt : 0);
        o_add(&s->slowed, taken, fabs(taken) + kinetic(s, &s->own[a]));
    }
}

bool o_drifts(const o_scene *s) { return s->cfg.xsph > 0 && !s->cfg.xsph_velocity; }

void o_even(o_scene *s)
{
    for (uint32_t a = 0; a < s->n && s->cfg.xsph_velocity; a++) {
        o_particle *i = &s->own[a];
        if (!o_is_body(s, i) || o_is_carried(s, i))
            continue;
        const double before = kinetic(s, i);
        for (int k = 0; k < SPH_DIM; k++)
            i->v[k] += i->drift[k].v;
        o_add(&s->evened, before - kinetic(s, i), before + kinetic(s, i));
    }
}
