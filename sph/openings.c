/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* openings.c: adds inflows and outflows (flow.c). Runs between steps only, before the first. */
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(openings)

#if SPH_WITH_FLOW

/* the axis of a face, or SPH_DIM: not one face */
static uint32_t axis_of(uint32_t face)
{
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (face == SPH_LOW(k) || face == SPH_HIGH(k))
            return k;
    return SPH_DIM;
}

/* whether a length is a whole number of spacings, at least a support */
static bool is_length(const sph_sim *sim, double length)
{
    const double n = length / sim->cfg.spacing, off = n - (double)sph_setup_intervals(length, sim->cfg.spacing);
    return length >= sim->grid.support * (1 - 1e-9) && sph_abs(off) < 1e-6 * n;
}

static sph_status check_flow(sph_sim *sim, const char *call, uint32_t fluid, const sph_flow *f, const uint32_t *set)
{
    sph_status st = sph_setup_begin_adding(sim, call);
    if (st || (st = sph_setup_check_body(sim, fluid)) != SPH_OK)
        return st;
    if (!f || !set)
        return sph_setup_bad(sim, "flow, set", "a flow and a place for the set's number", 0);
    if (sim->flows == sim->cfg.max_flows)
        return sph_setup_bad(sim, "max_flows", "at least as many as the value says", sim->flows + 1);
    if (sim->set[fluid].role != SPH_ROLE_FLUID || sim->set[fluid].flow)
        return sph_setup_bad(sim, "fluid", "a set made by sph_add_fluid", fluid);
    if (sim->sets == sim->cfg.max_sets)
        return sph_error(sim, SPH_TOO_MANY_SETS, "sets", "at most max_sets", sim->sets, SPH_NO_PARTICLE);
    const uint32_t axis = axis_of(f->face);
    if (axis == SPH_DIM)
        return sph_setup_bad(sim, "face", "one of SPH_LOW(k), SPH_HIGH(k)", f->face);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (!(f->hi[k] > f->lo[k]) || !(f->lo[k] >= sim->cfg.lo[k] && f->hi[k] <= sim->cfg.hi[k]))
            return sph_setup_bad(sim, "hi", "> lo on every axis, and both inside the domain", f->hi[k]);
    if (!is_length(sim, f->hi[axis] - f->lo[axis]))
        return sph_setup_bad(sim, "hi", "so far from lo along the flow: whole spacings, at least the kernel's support",
                             f->hi[axis] - f->lo[axis]);
    return SPH_OK;
}

/* the set of a flow, and where its box is */
static void make_flow(sph_sim *sim, uint32_t fluid, const sph_flow *f, bool out)
{
    sph_set *const s = &sim->set[sim->sets];
    sph_flow_state *const o = &sim->flow[sim->flows];
    const uint32_t axis = axis_of(f->face);
    const bool high = f->face == SPH_HIGH(axis);
    *s = sim->set[fluid];
    s->flow = (uint8_t)(sim->flows + 1);
    *o = (sph_flow_state){.axis = (uint8_t)axis, .out = out, .up = high != out, .set = (uint8_t)sim->sets,
                          .fluid = (uint8_t)fluid};
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        o->lo[k] = sph_setup_to_quanta(sim, f->lo[k] - sim->cfg.lo[k]);
        o->hi[k] = sph_setup_to_quanta(sim, f->hi[k] - sim->cfg.lo[k]);
    }
    o->face = high ? o->hi[axis] : o->lo[axis];
    o->end = high ? o->lo[axis] : o->hi[axis];
    sph_setup_finish_set(sim, s);
    uint64_t h = sph_mix(sim->setup_hash, (uint64_t)f->face | (uint64_t)out << 8 | (uint64_t)fluid << 16);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        h = sph_mix(sph_mix(h, (uint64_t)o->lo[k]), (uint64_t)o->hi[k]);
    sim->setup_hash = h;
    sim->sets++;
    sim->flows++;
}

sph_status sph_add_inflow(sph_sim *sim, uint32_t fluid, const sph_flow *f, uint32_t *set)
{
    sph_status st = check_flow(sim, "sph_add_inflow", fluid, f, set);
    if (st)
        return st;
    if (!(f->speed > 0 && f->speed < 1e15))
        return sph_setup_bad(sim, "speed", "> 0 and finite", f->speed);
    const uint64_t hash = sim->setup_hash;
    double v[SPH_DIM] = {0};
    make_flow(sim, fluid, f, false);
    const sph_flow_state *const o = &sim->flow[sim->flows - 1];
    v[o->axis] = o->up ? f->speed : -f->speed;
    st = sph_setup_fill(sim, "sph_add_inflow", sim->sets - 1, f->lo, f->hi, NULL, v, NULL, NULL);
    if (st) {
        sim->sets--;
        sim->flows--;
        sim->setup_hash = hash;
        return st;
    }
    *set = sim->sets - 1;
    return SPH_OK;
}

sph_status sph_add_outflow(sph_sim *sim, uint32_t fluid, const sph_flow *f, uint32_t *set)
{
    const sph_status st = check_flow(sim, "sph_add_outflow", fluid, f, set);
    if (st)
        return st;
    make_flow(sim, fluid, f, true);
    *set = sim->sets - 1;
    return SPH_OK;
}
#endif
