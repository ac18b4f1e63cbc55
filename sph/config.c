/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* config.c: whole configurations: defaults, what options ask of each other, what may change between steps. What each
   may be alone is in the list of options (options.h). */
#include "config.h"
#include "arithmetic.h"

SPH_OBJECT(config)

sph_config sph_config_default(void) { return sph_options_start; }

/* hooks of modules that were left out */
static sph_status check_hooks(const sph_config *c, sph_report *r)
{
    const char *left_out = NULL;
    if (!SPH_WITH_BODY_FORCE && c->body_force)
        left_out = "body_force";
    if (!SPH_WITH_STAGE_LOG && c->stage_log)
        left_out = "stage_log";
    if (left_out)
        return sph_refuse(r, left_out, "a choice that was compiled in (modules.h)", 1);
    if (c->port.parallel && c->port.threads > c->max_threads)
        return sph_refuse(r, "port.threads", "at most max_threads", c->port.threads);
    return SPH_OK;
}

static sph_status check_domain(const sph_config *c, sph_report *r)
{
    if (!(c->smoothing_length >= 0.5 * c->spacing && c->smoothing_length <= 10 * c->spacing))
        return sph_refuse(r, "smoothing_length", "0.5 .. 10 spacings", c->smoothing_length);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (!(c->hi[k] - c->lo[k] >= c->spacing)) /* an axis of nearly no length would have no quanta */
            return sph_refuse(r, "hi", "at least a spacing above lo on every axis, and finite", c->hi[k]);
        if (SPH_WITH_PERIODIC && (c->face[k][0] == SPH_PERIODIC) != (c->face[k][1] == SPH_PERIODIC))
            return sph_refuse(r, "face", "SPH_PERIODIC on both faces of an axis or on neither", c->face[k][1]);
    }
    return SPH_OK;
}

static sph_status check_fluids(const sph_config *c, sph_report *r)
{
    if (SPH_IS(c->viscosity, MORRIS) && !(c->nu > 0))
        return sph_refuse(r, "nu", ">= 0, and > 0 for SPH_MORRIS", c->nu);
    if (sph_shears(c) && (sph_has_solids(c) || SPH_IS(c->viscosity, MORRIS)))
        return sph_refuse(r, "shear", "SPH_NO_SHEAR with solids or SPH_MORRIS", c->shear);
    if (SPH_IS(c->shear, NESTED) && !(c->nu > 0))
        return sph_refuse(r, "nu", ">= 0, and > 0 for SPH_NESTED", c->nu);
    if (SPH_IS(c->density, SUMMATION) && (c->diffusion || sph_filters(c)))
        return sph_refuse(r, "density", "SPH_CONTINUITY when diffusion or the Shepard filter is on", c->density);
    if (sph_takes_density_gradient(c) && sph_has_solids(c))
        return sph_refuse(r, "diffusion", "SPH_NO_DIFFUSION .. SPH_HYDROSTATIC with solids", c->diffusion);
    if (SPH_WITH_BONET_LOK && c->gradient_guard && c->gradient != SPH_BONET_LOK)
        return sph_refuse(r, "gradient_guard", "false but with SPH_BONET_LOK", 1);
    if (!sph_corrects_fluids(c))
        return SPH_OK;
    if (c->density != SPH_CONTINUITY)
        return sph_refuse(r, "density", "SPH_CONTINUITY where gradients of fluids are corrected", c->density);
    if (sph_has_solids(c))
        return sph_refuse(r, "gradient", "SPH_PLAIN in scenes with solids", c->gradient);
    if (SPH_IS(c->gradient, BONET_LOK) && c->scheme != SPH_STANDARD && c->scheme != SPH_WEAK)
        return sph_refuse(r, "scheme", "SPH_STANDARD or SPH_WEAK with SPH_BONET_LOK", c->scheme);
    return SPH_OK;
}

static sph_status check_energy(const sph_config *c, sph_report *r)
{
    const bool kicks = SPH_IS(c->integrator, KICK_DRIFT_KICK) || SPH_IS(c->integrator, LEAP_FROG);
    if (SPH_IS(c->eos, IDEAL_GAS) && !c->energy)
        return sph_refuse(r, "energy", "true where eos is SPH_IDEAL_GAS", 0);
    if (c->energy && (sph_has_solids(c) || (SPH_WITH_DAMPER && c->damper > 0) || (SPH_WITH_FLOW && c->max_flows > 0)))
        return sph_refuse(r, "energy", "false in scenes with solids, the damper, inflows or outflows", 1);
    if (c->energy && sph_sums_density(c) && (kicks || c->eos != SPH_IDEAL_GAS))
        return sph_refuse(r, "density", "SPH_CONTINUITY with the energy equation, but for SPH_IDEAL_GAS in the "
                                      "predictor-corrector and Runge-Kutta", c->density);
    return SPH_OK;
}

/* what the choices of solids ask of each other */
static sph_status check_solids(const sph_config *c, sph_report *r)
{
    const bool solid = sph_has_solids(c);
    if (!SPH_WITH_SOLID) /* whatever they ask for was refused as left out */
        return SPH_OK;
    if (!solid && (c->yield || c->damage || c->artificial_stress || c->xsph_strain ||
                   c->face_quadrature || c->hourglass > 0))
        return sph_refuse(r, "solid", "a solid form, where yield, damage, artificial_stress, xsph_strain, "
                                    "face_quadrature or hourglass is on", c->solid);
    if (!solid)
        return SPH_OK;
    if (c->scheme != SPH_STANDARD && c->scheme != SPH_WEAK)
        return sph_refuse(r, "scheme", "SPH_STANDARD or SPH_WEAK with solids", c->scheme);
    if (c->density != SPH_CONTINUITY || sph_filters(c))
        return sph_refuse(r, "density", "SPH_CONTINUITY, without the Shepard filter, with solids", c->density);
    if (sph_is_total(c) && c->artificial_stress)
        return sph_refuse(r, "artificial_stress", "none with SPH_TOTAL", c->artificial_stress);
    if ((sph_stabilises(c) || sph_normalises(c)) && c->artificial_stress)
        return sph_refuse(r, "artificial_stress", "none with SPH_STABILISED, SPH_NORMALISED ...", c->artificial_stress);
    if (c->hourglass > 0 && !sph_is_total(c))
        return sph_refuse(r, "hourglass", "0 .. 100, and 0 but with SPH_TOTAL", c->hourglass);
    if (c->xsph_strain && !(c->xsph > 0))
        return sph_refuse(r, "xsph", "> 0 where xsph_strain is on", c->xsph);
    if (sph_weighs_faces(c) && !sph_corrects(c))
        return sph_refuse(r, "face_quadrature", "with SPH_CORRECTED or SPH_TOTAL", c->solid);
    if (sph_damages(c) && (c->max_flaws < 1 || c->max_flaws > 1u << 30))
        return sph_refuse(r, "max_flaws", "1 .. 2^30 with damage", c->max_flaws);
    return SPH_OK;
}

sph_status sph_check_config(const sph_config *c, sph_grid *grid, size_t *bytes, sph_report *r)
{
    sph_status st;
    if (!c)
        return sph_refuse(r, "configuration", "a pointer to a configuration", 0);
    if (c->cookie != sph_options_start.cookie)
        return sph_refuse(r, "cookie", "a configuration made by sph_config_default of this version", c->cookie);
    if ((st = sph_options_check(c, r)) != SPH_OK || (st = check_hooks(c, r)) != SPH_OK ||
        (st = check_domain(c, r)) != SPH_OK || (st = check_fluids(c, r)) != SPH_OK ||
        (SPH_WITH_ENERGY && (st = check_energy(c, r)) != SPH_OK) ||
        (SPH_WITH_VARIABLE_H && (st = sph_check_smoothing_length(c, r)) != SPH_OK) ||
        (SPH_WITH_SPONGE && (st = sph_check_sponge(c, r)) != SPH_OK) ||
        (SPH_WITH_FLOW && (st = sph_check_flows(c, r)) != SPH_OK) ||
        (SPH_WITH_DAMPER && (st = sph_check_damper(c, r)) != SPH_OK) ||
        (SPH_HAS_XSPH_VELOCITY && (st = sph_check_evening(c, r)) != SPH_OK) ||
        (SPH_WITH_SHIFTING && (st = sph_check_shifting(c, r)) != SPH_OK) ||
        (SPH_HAS_EDGES && (st = sph_check_edges(c, r)) != SPH_OK) ||
        (st = check_solids(c, r)) != SPH_OK || (st = sph_make_grid(c, grid, r)) != SPH_OK)
        return st;
    if (!sph_measure_arena(c, grid, bytes))
        return sph_refuse(r, "max_particles", "an arena that this machine can address", c->max_particles);
    return SPH_OK;
}

sph_status sph_config_check(const sph_config *c, sph_report *r)
{
    sph_grid grid;
    size_t bytes;
    return sph_check_config(c, &grid, &bytes, r);
}

sph_status sph_reconfigure(sph_sim *sim, const sph_config *cfg)
{
    sph_report r;
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "sph_reconfigure", "between steps", 0, SPH_NO_PARTICLE);
    if (sph_config_check(cfg, &r) != SPH_OK)
        return sph_error(sim, SPH_BAD_CONFIG, r.what, r.allowed, r.value, SPH_NO_PARTICLE);
    /* the digest leaves out what may change */
    if (sph_hash_config(cfg) != sph_hash_config(&sim->cfg) || cfg->max_threads > sim->cfg.max_threads)
        return sph_error(sim, SPH_BAD_CONFIG, "configuration", "unchanged but for gravity, damping, dt and hooks", 0,
                         SPH_NO_PARTICLE);
    bool same_field = sim->cfg.body_force == cfg->body_force;
    for (int k = 0; k < SPH_DIM; k++)
        same_field &= !(sim->cfg.gravity[k] < cfg->gravity[k]) && !(sim->cfg.gravity[k] > cfg->gravity[k]);
    sph_options_take(&sim->cfg, cfg);
    sph_make_factors(sim);
    if (!same_field)
        sim->now.primed = false; /* the stored forces are of the old field */
    return SPH_OK;
}
