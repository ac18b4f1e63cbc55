/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* timestep.c: the time step: the smallest of what sound, viscosity, density diffusion, forces and gravity allow after
   the latest force sweep (Gray 2001 eq 2.30, Wickramarachchi 2009 eqs 3.88-3.90), unless it is fixed. */
#include "timestep.h"
#include "factors.h"
#include "arithmetic.h"

SPH_OBJECT(timestep)

/* sound of a set at rest (m/s) */
static double sound_of(const sph_sim *sim, const sph_set *set)
{
    const double c2 = set->c0 * set->c0 * (SPH_IS(set->eos, TAIT_GRAY) ? 7 : 1);
    if (!sph_is_solid(set))
        return __builtin_sqrt(c2);
    /* waves along the way of their motion (Gray 2001 eq 5.52) */
    return __builtin_sqrt(c2 + 4 * sph_material_of(sim, set)->shear / (3 * set->rho0));
}

/* the fastest sound of the scene's sets (m/s); nominal: the fastest c0 of its matter, with which viscosity and
   diffusion are made */
static double fastest_sound(const sph_sim *sim, bool nominal)
{
    if (!SPH_WITH_SEVERAL_FLUIDS && !SPH_WITH_SOLID && !SPH_WITH_TAIT_GRAY)
        return sim->cfg.sound_speed;
    /* before there are sets; and bodies in contact push each other by the configuration's */
    double c = !SPH_WITH_SEVERAL_FLUIDS || sim->sets == 0 || sph_is_total(&sim->cfg) ? sim->cfg.sound_speed : 0;
    if (!SPH_WITH_SEVERAL_FLUIDS && !SPH_WITH_SOLID && !SPH_WITH_TAIT_GRAY)
        return c;
    for (uint32_t s = 0; s < sim->sets; s++) {
        const sph_set *set = &sim->set[s];
        const double own = !nominal ? sound_of(sim, set) : sph_is_matter(set) ? set->c0 : 0;
        c = own > c ? own : c;
    }
    return c;
}

/* kinematic viscosity that the chosen form amounts to (m^2/s) */
static double viscosity_of(const sph_config *c, double sound)
{
    if (SPH_IS(c->viscosity, MORRIS))
        return c->nu;
    const double nu = sph_shears(c) ? c->nu : 0;
    return nu + (sph_viscous(c->viscosity) ? c->alpha * sound * c->smoothing_length / (2 * (SPH_DIM + 2)) : 0);
}

static double size_of_gravity(const sph_config *c)
{
    double g2 = 0;
    for (int k = 0; k < SPH_DIM; k++)
        g2 += c->gravity[k] * c->gravity[k];
    return __builtin_sqrt(g2);
}

void sph_find_limits(const sph_sim *sim, double *l)
{
    const sph_config *c = &sim->cfg;
    const double h = c->smoothing_length, c0 = fastest_sound(sim, false), a = (double)sim->now.peaks.acc;
    const double nominal = fastest_sound(sim, true), nu = viscosity_of(c, nominal), g = size_of_gravity(c);
    memset(l, 0, SPH_LIMITS * sizeof *l);
    l[SPH_LIMIT_FIXED] = c->dt;
    if (c->dt > 0)
        return;
    l[SPH_LIMIT_COURANT] = sim->courant * h / (c0 + h * (double)sim->now.peaks.mu);
    const double least = sph_varies_h(c) ? c->h_min * h : h;
    const double thin = SPH_IS(c->viscosity, MORRIS) ? least : h; /* artificial: told as an |mu| (energy.c) */
    if (nu > 0)
        l[SPH_LIMIT_VISCOUS] = c->viscous_factor * thin * thin / nu;
    if (a > 0)
        l[SPH_LIMIT_FORCE] = c->force_factor * __builtin_sqrt(h / a);
    if (sph_diffusive(c->diffusion) && c->delta > 0)
        l[SPH_LIMIT_DIFFUSIVE] = sph_diffusion_factor(c) * h / (c->delta * nominal);
    l[SPH_LIMIT_GRAVITY] = g > 0 ? c->gravity_factor * least / (c0 + __builtin_sqrt(g * least)) : 0;
    l[SPH_LIMIT_CEILING] = c->dt_max;
}

sph_status sph_choose_dt(sph_sim *sim, double t_end)
{
    double dt = 1e300;
    sph_find_limits(sim, sim->limit_dt);
    for (uint32_t k = 0; k < SPH_LIMITS; k++)
        if (sim->limit_dt[k] > 0 && sim->limit_dt[k] < dt) {
            dt = sim->limit_dt[k];
            sim->limit = k;
        }
    if (!(dt > 0) || dt < sim->cfg.dt_min || sim->now.time + dt == sim->now.time)
        return sph_error(sim, SPH_STEP_COLLAPSED, sph_limit_text(sim->limit), "a step above dt_min", dt,
                         SPH_NO_PARTICLE);
    if (t_end - sim->now.time <= dt * (1 + 1e-9)) {
        dt = t_end - sim->now.time;
        sim->limit = SPH_LIMIT_TARGET;
        sim->next.time = t_end;
    } else {
        sim->next.time = sim->now.time + dt;
    }
    sim->dt = dt;
    return SPH_OK;
}
