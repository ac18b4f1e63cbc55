/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* initial.c: initial fields: places, velocity and density by a function of position, density by hydrostatic pressure.
   Runs between steps only; all or nothing: values wait in the buffer that is not in use until all were seen to be
   right. */
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(initial)

#if SPH_WITH_FIELDS
/* velocity of a particle now: leap-frog's are half a step ahead, and forces made anew begin where they are not */
static double velocity_now(const sph_sim *sim, const sph_buffer *b, uint32_t i, int k)
{
    const double v = (double)b->vel[k][i];
    return SPH_IS(sim->cfg.integrator, LEAP_FROG) ? v - 0.5 * sim->now.dt_last * (double)b->acc[k][i] : v;
}

sph_status sph_apply_field(sph_sim *sim, uint32_t set, sph_field_fn fn, void *ctx)
{
    sph_status st = sph_setup_idle(sim, "sph_apply_field");
    if (st || (st = sph_setup_check_body(sim, set)) != SPH_OK)
        return st;
    if (!fn)
        return sph_setup_bad(sim, "fn", "a function", 0);
    /* values wait in the buffer that is not in use until all were seen to be right */
    const sph_buffer *b = &sim->buf[sim->cur], *wait = &sim->buf[(sim->cur + 1) % sim->buffers];
    double rho0 = sim->set[set].rho0;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (b->set[0][i] != set)
            continue;
        double x[SPH_DIM], v[SPH_DIM], rho = rho0 * (1 + (double)b->rho[0][i]);
        for (int k = 0; k < SPH_DIM; k++) {
            x[k] = sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
            v[k] = velocity_now(sim, b, i, k);
        }
        fn(ctx, x, v, &rho);
        if ((st = sph_setup_check_vector(sim, "field velocity", v)) != SPH_OK)
            return st;
        if (!(rho > 0 && rho < 100 * rho0))
            return sph_setup_bad(sim, "field density", "between 0 and 100 rho0", rho);
        for (int k = 0; k < SPH_DIM; k++)
            wait->vel[k][i] = (sph_real)v[k];
        wait->rho[0][i] = (sph_real)((rho - rho0) / rho0);
    }
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (b->set[0][i] != set)
            continue;
        for (int k = 0; k < SPH_DIM; k++) {
            b->vel[k][i] = wait->vel[k][i];
            b->acc[k][i] = 0; /* as before the first forces */
        }
        b->rho[0][i] = wait->rho[0][i];
    }
    sim->now.primed = false;
    return SPH_OK;
}

/* Places wait in the other buffer, too; a place at the very end of the domain is the last inside it. */
static sph_status place_particle(sph_sim *sim, const sph_buffer *b, const sph_buffer *wait, uint32_t i,
                                 sph_place_fn fn, void *ctx)
{
    double x[SPH_DIM], to[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = to[k] = sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
    fn(ctx, x, to);
    for (int k = 0; k < SPH_DIM; k++) {
        const double way = to[k] - sim->cfg.lo[k];
        if (!(way >= 0 && way < sim->grid.length[k]))
            return sph_setup_bad(sim, "position", "inside the domain, walls included", to[k]);
        const sph_pos at = sph_setup_to_quanta(sim, way), last = sim->grid.extent[k] - 1;
        wait->pos[k][i] = at < last ? at : last;
    }
    return SPH_OK;
}

sph_status sph_apply_positions(sph_sim *sim, uint32_t set, sph_place_fn fn, void *ctx)
{
    sph_status st = sph_setup_begin_adding(sim, "sph_apply_positions");
    if (st || (st = sph_setup_check_body(sim, set)) != SPH_OK)
        return st;
    if (!fn)
        return sph_setup_bad(sim, "fn", "a function", 0);
    const sph_buffer *b = &sim->buf[sim->cur], *wait = &sim->buf[(sim->cur + 1) % sim->buffers];
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->set[0][i] == set && (st = place_particle(sim, b, wait, i, fn, ctx)) != SPH_OK)
            return st;
    for (uint32_t i = 0; i < sim->now.count; i++)
        for (int k = 0; k < SPH_DIM && b->set[0][i] == set; k++)
            b->pos[k][i] = wait->pos[k][i];
    sim->table_valid = false;
    return SPH_OK;
}

sph_status sph_apply_hydrostatic(sph_sim *sim, uint32_t set, double surface)
{
    sph_status st = sph_setup_idle(sim, "sph_apply_hydrostatic");
    if (st || (st = sph_setup_check_body(sim, set)) != SPH_OK)
        return st;
    int axis = -1;
    for (int k = 0; k < SPH_DIM; k++)
        if (sim->cfg.gravity[k] != 0) {
            if (axis >= 0)
                return sph_setup_bad(sim, "gravity", "along one axis", sim->cfg.gravity[k]);
            axis = k;
        }
    if (axis < 0 || !(sph_abs(surface) < 1e15))
        return sph_setup_bad(sim, "surface", "finite, with gravity along one axis", surface);
    const sph_set *s = &sim->set[set];
    if (sph_is_gas(s))
        return sph_setup_bad(sim, "set", "one whose pressure follows from its density alone", set);
    double g = sim->cfg.gravity[axis];
    const sph_buffer *b = &sim->buf[sim->cur], *wait = &sim->buf[(sim->cur + 1) % sim->buffers];
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->set[0][i] == set) {
            double x = sim->cfg.lo[axis] + (double)b->pos[axis][i] * sim->grid.quantum;
            double p = s->rho0 * g * (x - surface); /* g < 0: below the surface p > 0 */
            double d = sph_density_of(sim, s, p > 0 ? p : 0);
            if (!(d >= -1 && d < 99))
                return sph_setup_bad(sim, "surface", "a depth at which density stays below 100 rho0", surface);
            wait->rho[0][i] = (sph_real)d;
        }
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->set[0][i] == set)
            b->rho[0][i] = wait->rho[0][i];
    sim->now.primed = false;
    return SPH_OK;
}

#if SPH_WITH_ENERGY
sph_status sph_apply_energy(sph_sim *sim, uint32_t set, sph_energy_fn fn, void *ctx)
{
    sph_status st = sph_setup_idle(sim, "sph_apply_energy");
    if (st || (st = sph_setup_check_body(sim, set)) != SPH_OK)
        return st;
    if (!fn || !sim->cfg.energy)
        return sph_setup_bad(sim, fn ? "energy" : "fn", fn ? "on (an option)" : "a function", 0);
    const sph_buffer *b = &sim->buf[sim->cur], *wait = &sim->buf[(sim->cur + 1) % sim->buffers];
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (b->set[0][i] != set)
            continue;
        double x[SPH_DIM], u = (double)b->energy[0][i];
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
        fn(ctx, x, &u);
        if (!(u >= 0 && u < 1e30))
            return sph_setup_bad(sim, "field energy", "0 .. 1e30", u);
        wait->energy[0][i] = (sph_real)u;
    }
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->set[0][i] == set)
            b->energy[0][i] = wait->energy[0][i];
    sim->now.primed = false;
    return SPH_OK;
}
#endif
#endif
