/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shrink.c: makes a plan on which kernel and oracle differ as small as it goes: particles, walls and choices are left
   out one after the other as long as the same quantity still differs. */
#include <string.h>

#include "plan.h"

static bool still(const plan *p, const char *name, difference *d)
{
    difference now[PLAN_QUANTITIES];
    uint32_t n;
    if (plan_compare(p, name, now, &n, NULL) != PLAN_DIFFERS)
        return false;
    *d = now[0];
    return true;
}

/* takes `next` for the plan if it still differs */
static bool take(plan *p, const plan *next, const char *name, difference *d)
{
    if (memcmp(p, next, sizeof *p) == 0 || !still(next, name, d))
        return false;
    *p = *next;
    return true;
}

static bool fewer_points(plan *p, const char *name, difference *d)
{
    bool any = false;
    for (uint32_t size = p->points / 2; size > 0; size /= 2)
        for (uint32_t i = 0; i + size <= p->points;) {
            plan next = *p;
            memmove(next.point + i, next.point + i + size, (p->points - i - size) * sizeof *next.point);
            next.points -= size;
            if (take(p, &next, name, d))
                any = true;
            else
                i += size;
        }
    return any;
}

/* simpler choices, one by one */
static bool fewer_choices(plan *p, const char *name, difference *d)
{
    bool any = false;
    plan next;
#define TRY(change)                                                                                                   \
    next = *p;                                                                                                        \
    change;                                                                                                           \
    any |= take(p, &next, name, d);
    TRY(next.walls = 0)
    TRY(next.walls = p->walls ? p->walls - 1 : 0)
    TRY(next.wall[0] = p->wall[1]; next.walls = p->walls ? 1 : 0)
    TRY(next.probes = 0)
    TRY(next.still_step = false)
    TRY(next.steps = 0)
    TRY(next.steps = p->steps ? 1 : 0)
    TRY(next.steps = p->steps > 1 ? 2 : p->steps)
    TRY(next.cfg.damping = 1)
    TRY(next.cfg.body_force = NULL)
    TRY(next.cfg.hourglass = 0)
    TRY(next.cfg.face_quadrature = false; for (int k = 0; k < PLAN_SETS; k++) next.solid[k].flat_faces = false)
    TRY(next.cfg.xsph_strain = false)
    TRY(next.cfg.xsph = 0; next.cfg.xsph_velocity = false)
    TRY(next.cfg.diffusion = SPH_NO_DIFFUSION)
    TRY(next.cfg.viscosity = SPH_INVISCID)
    TRY(next.cfg.shear = SPH_NO_SHEAR)
    TRY(next.cfg.subgrid = 0)
    TRY(next.cfg.beta = 0)
    TRY(next.cfg.books = false)
    TRY(next.cfg.pressure_floor = false)
    TRY(next.cfg.gradient_guard = false)
    TRY(next.cfg.gradient = SPH_PLAIN; next.cfg.gradient_guard = false)
    TRY(next.cfg.artificial_stress = SPH_NO_ARTIFICIAL_STRESS)
    TRY(next.cfg.yield = SPH_NO_YIELD; for (int k = 0; k < PLAN_SETS; k++) next.solid[k].yield = 0)
    TRY(next.cfg.damage = SPH_NO_DAMAGE)
    TRY(next.cfg.scheme = SPH_STANDARD)
    TRY(next.cfg.eos = SPH_LINEAR)
    TRY(next.cfg.kernel = SPH_WENDLAND_C2)
    TRY(next.cfg.shepard_every = 0)
    TRY(next.cfg.shift_pairs = false)
    TRY(next.cfg.shifting = 0; next.cfg.shift_pairs = false)
    TRY(next.cfg.damper = 0)
    TRY(next.cfg.damping_rate = 0)
    TRY(next.cfg.xsph_velocity = false)
    TRY(next.cfg.edge = SPH_NO_EDGE)
    TRY(next.cfg.variable_h = false)
    TRY(next.wall_d = 0)
    TRY(next.bed.points = 0)
    TRY(next.bed.points -= p->bed.points > 2)
    TRY(for (int k = 1; k < PLAN_BED; k++) memcpy(next.bed.p[k - 1], p->bed.p[k], sizeof p->bed.p[k]);
        next.bed.points -= p->bed.points > 2)
    TRY(memset(&next.bed.motion, 0, sizeof next.bed.motion))
    TRY(next.flows = 0)
    TRY(next.flows = p->flows ? p->flows - 1 : 0)
    TRY(next.flow[0] = p->flow[1]; next.flows = p->flows > 1 ? 1 : p->flows)
    TRY(next.flow[0].uneven = next.flow[1].uneven = 0)
    TRY(next.flow[0].thick = next.flow[1].thick = 0)
    TRY(next.cfg.max_particles = 4096)
    for (int k = 0; k < SPH_DIM; k++) {
        TRY(next.cfg.gravity[k] = 0)
        TRY(next.cfg.sponge_low[k] = 0)
        TRY(next.cfg.sponge_high[k] = 0)
        TRY(next.cfg.face[k][0] = next.cfg.face[k][1] = SPH_OPEN)
        TRY(next.cfg.face[k][0] = SPH_OPEN)
        TRY(next.cfg.face[k][1] = SPH_OPEN)
        TRY(for (uint32_t i = 0; i < p->points; i++) next.point[i].v[k] = 0)
        for (uint32_t w = 0; w < p->walls; w++) {
            TRY(next.wall[w].motion.v[k] = 0)
        }
    }
    for (int k = 0; k < PLAN_SETS; k++) {
        TRY(memset(&next.fluid[k], 0, sizeof next.fluid[k]))
        TRY(next.solid[k].held = 0)
        TRY(next.solid[k].hardening = 0)
        TRY(next.flaws[k].k = 0)
    }
    TRY(for (uint32_t i = 0; i < p->points; i++) next.point[i].d = 0)
    TRY(for (uint32_t i = 0; i < p->points; i++) memset(next.point[i].dev, 0, sizeof next.point[i].dev))
    TRY(for (uint32_t i = 0; i < p->points; i++) next.point[i].root = 0)
    TRY(for (uint32_t i = 0; i < p->points; i++) memset(next.point[i].moved, 0, sizeof next.point[i].moved))
#undef TRY
    return any;
}

void plan_shrink(plan *p, difference *d)
{
    const char *const name = d->name;
    for (int turn = 0; turn < 4; turn++) {
        bool any = fewer_points(p, name, d);
        any |= fewer_choices(p, name, d);
        if (!any)
            break;
    }
    still(p, name, d);
}
