/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* plan.c: draws a small scene from a seed: any choice of the configuration that its checks let through, few particles,
   mostly near faces, corners and walls. */
#include <stdio.h>
#include <string.h>

#include "plan.h"

/* ---- chance: splitmix64 (Steele, Lea & Flood 2014) ---- */

static uint64_t state;
static uint64_t next(void)
{
    uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}
static double range(double lo, double hi) { return lo + (hi - lo) * (double)(next() >> 11) / 9007199254740992.0; }
static uint32_t pick(uint32_t n) { return (uint32_t)(next() % n); }
static bool chance(double p) { return range(0, 1) < p; }

/* ---- configuration ---- */

static void draw_lengths(plan *p)
{
    static const double usual[] = {0.8, 1.0, 1.2, 1.5, 2, 3};
    sph_config *c = &p->cfg;
    c->spacing = pow(10, range(-2, 0.3));
    const double ratio = chance(0.3) ? usual[pick(6)] : range(0.8, chance(0.5) ? 3 : 1.6);
    c->smoothing_length = ratio * c->spacing;
}

static void draw_faces(plan *p)
{
    static const uint32_t single[] = {SPH_OPEN, SPH_SYMMETRY, SPH_MIRROR_NO_SLIP};
    for (int k = 0; k < SPH_DIM; k++) {
        const bool around = chance(0.33);
        p->cfg.face[k][0] = around ? SPH_PERIODIC : single[pick(3)];
        p->cfg.face[k][1] = around ? SPH_PERIODIC : single[pick(3)];
    }
}

static void draw_solids(plan *p)
{
    sph_config *c = &p->cfg;
    c->solid = SPH_UPDATED + pick(6);
    c->scheme = chance(0.6) ? SPH_STANDARD : SPH_WEAK;
    c->yield = pick(SPH_YIELDS);
    c->damage = SPH_DIM > 1 ? pick(SPH_DAMAGES) : 0;
    c->max_flaws = c->damage ? 4000 : 0;
    c->artificial_stress = c->solid >= SPH_TOTAL ? 0 : pick(SPH_ARTIFICIAL_STRESSES);
    c->stress_exponent = chance(0.5) ? 4 : 1 + pick(8);
    c->stress_epsilon = range(0, 0.6);
    c->xsph_strain = c->xsph > 0 && chance(0.5);
    c->max_stretch = range(1.1, 1.5);
}

/* what is chosen most; its loops are compiled apart */
static void draw_usual(plan *p)
{
    sph_config *c = &p->cfg;
    c->kernel = chance(0.7) ? SPH_WENDLAND_C2 : SPH_CUBIC;
    c->scheme = SPH_STANDARD;
    c->eos = SPH_TAIT;
    c->viscosity = SPH_ARTIFICIAL;
    c->beta = 0;
    c->xsph = 0;
    c->diffusion = c->solid == SPH_NO_SOLID && chance(0.5) ? SPH_HYDROSTATIC + pick(2) : SPH_NO_DIFFUSION;
    c->gradient = c->solid == SPH_NO_SOLID && chance(0.3) ? SPH_BONET_LOK : SPH_PLAIN;
    c->artificial_stress = c->solid == SPH_NO_SOLID || c->solid >= SPH_TOTAL ? 0 : pick(SPH_ARTIFICIAL_STRESSES);
    c->stress_exponent = 4;
    c->xsph_strain = false;
}

static void body_force(void *ctx, double t, const double *x, const double *v, double *a)
{
    const plan *p = ctx;
    for (int k = 0; k < SPH_DIM; k++)
        a[k] += p->push[k] * (sin(x[k] / p->cfg.spacing) + t) - p->drag * v[k];
}

static void draw_choices(plan *p)
{
    sph_config *c = &p->cfg;
    c->kernel = pick(SPH_KERNELS);
    c->rho0 = pow(10, range(0, 4));
    c->sound_speed = range(5, 100);
    c->scheme = pick(SPH_SCHEMES);
    c->eos = pick(SPH_IDEAL_GAS); /* a gas: draw_energy */
    c->pressure_floor = chance(0.4);
    c->viscosity = pick(SPH_VISCOSITIES);
    c->alpha = range(0, 0.5);
    c->beta = chance(0.5) ? range(0, 2) : 0;
    c->nu = range(0.001, 0.2) * c->sound_speed * c->smoothing_length;
    c->diffusion = pick(SPH_DIFFUSIONS);
    c->delta = range(0, 1);
    c->xsph = chance(0.4) ? range(0.1, 1) : 0;
    c->gradient = chance(0.5) ? SPH_PLAIN : 1 + pick(SPH_GRADIENTS - 1);
    if (c->gradient == SPH_BONET_LOK)
        c->scheme = chance(0.5) ? SPH_STANDARD : SPH_WEAK;
    if (chance(0.45)) {
        c->gradient = SPH_PLAIN;
        draw_solids(p);
    }
    if (c->solid != SPH_NO_SOLID && c->diffusion == SPH_ANTUONO)
        c->diffusion = SPH_MOLTENI;
    if (chance(0.35))
        draw_usual(p);
    c->gradient_guard = c->gradient == SPH_BONET_LOK && chance(0.4);
    if (c->solid == SPH_NO_SOLID && c->viscosity != SPH_MORRIS && chance(0.3)) {
        c->shear = 1 + pick(SPH_SHEARS - 1);
        c->smagorinsky = range(0, 2);
        c->subgrid = range(0, 1);
        if (c->shear != SPH_NESTED && chance(0.5))
            c->nu = 0;
    }
    if (c->diffusion == SPH_NO_DIFFUSION && c->gradient == SPH_PLAIN && c->solid == SPH_NO_SOLID && chance(0.25))
        c->density = SPH_SUMMATION;
    for (int k = 0; k < SPH_DIM; k++)
        c->gravity[k] = chance(0.6) ? range(-20, 20) : 0;
    c->books = chance(0.7);
    c->integrator = pick(SPH_INTEGRATORS);
    c->cfl = range(0.05, 1);
    c->damping = chance(0.2) ? range(0.9, 1) : 1;
    c->on_cross = SPH_IGNORE;
    c->on_leave = SPH_REMOVE;
    for (int k = 0; k < SPH_DIM; k++)
        p->push[k] = range(-10, 10);
    p->drag = range(0, 2);
    if (chance(0.3))
        c->body_force = body_force; /* its context: look.c */
}

/* ---- sets ---- */

static void draw_sets(plan *p)
{
    const sph_config *c = &p->cfg;
    const double cell = pow(c->spacing, SPH_DIM);
    const bool solids = c->solid != SPH_NO_SOLID;
    p->fluids = solids ? pick(3) : 1 + pick(chance(0.4) ? 3 : 1);
    p->solids = solids ? 1 + pick(2) : 0;
    for (uint32_t k = 0; k < p->fluids; k++) {
        sph_fluid *f = &p->fluid[k];
        if (k == 0 && chance(0.6))
            continue;
        f->rho0 = chance(0.7) ? c->rho0 * range(0.1, 3) : 0;
        f->sound_speed = chance(0.5) ? c->sound_speed * range(0.3, 2) : 0;
        f->mass = chance(0.3) ? c->rho0 * cell * range(0.2, 2) : 0;
        f->own_eos = chance(0.5);
        f->eos = pick(SPH_IDEAL_GAS);
    }
    for (uint32_t k = 0; k < p->solids; k++) {
        sph_solid *m = &p->solid[k];
        m->rho0 = chance(0.6) ? c->rho0 * range(0.5, 3) : 0;
        m->sound_speed = chance(0.5) ? c->sound_speed * range(0.3, 2) : 0;
        const double rho0 = m->rho0 > 0 ? m->rho0 : c->rho0;
        const double sound = m->sound_speed > 0 ? m->sound_speed : c->sound_speed;
        m->mass = rho0 * cell * (chance(0.3) ? range(0.5, 1.5) : 1);
        m->shear = chance(0.1) && !c->yield && !c->damage ? 0 : rho0 * sound * sound * range(0.1, 0.8);
        m->yield = c->yield && chance(0.8) ? m->shear * range(0.005, 0.1) : 0;
        m->hardening = chance(0.5) ? m->shear * range(0, 0.5) : 0;
        m->body = pick(2);
        if (chance(0.25)) {
            m->held = 1 + pick((1u << SPH_DIM) - 1);
            for (int a = 0; a < SPH_DIM; a++)
                p->held[k].v[a] = range(-0.1, 0.1) * c->sound_speed;
        }
        if (c->damage && p->still_step) /* so fast that a step of nearly no time shows it */
            m->crack_speed = range(0.001, 0.3) * sound / PLAN_STILL;
        if (c->damage && chance(0.8)) {
            p->flaws[k].m = range(1, 9);
            p->flaws[k].k = 1 / (cell * pow(range(0.002, 0.05), p->flaws[k].m));
            p->flaws[k].seed = next();
        }
    }
}

/* ---- walls ---- */

/* a wall around or beside the middle of the domain; the domain grows until it holds it */
static void draw_wall(plan *p, plan_wall *w, double *need)
{
    const double dx = p->cfg.spacing;
    w->wall = sph_wall_default();
    w->wall.kind = pick(SPH_WALLS);
    w->wall.compressible = chance(0.5);
    w->wall.no_slip = chance(0.6);
    if (w->wall.kind >= SPH_WALL_GHOST && !w->wall.compressible && chance(0.4))
        w->wall.side = SPH_FRONT + pick(2);
    w->wall.layers = SPH_DIM < 3 && chance(0.3) ? 0 : 1 + pick(SPH_DIM == 3 ? 2 : 3);
    w->wall.strength = chance(0.5) ? 0 : range(0.01, 5);
    w->inside = chance(0.6);
    w->flat = SPH_DIM > 1 && chance(0.3);
    w->faces = 1 + pick((1u << (2 * SPH_DIM)) - 1);
    const double layers = w->wall.layers ? w->wall.layers : ceil(o_weight_support(p->cfg.kernel) *
                                                                   p->cfg.smoothing_length / dx);
    for (int k = 0; k < SPH_DIM; k++) {
        const double size = dx * (SPH_DIM == 3 ? range(1.6, 4) : range(1.6, 6)), margin = layers * dx;
        const double from = margin + range(0, 1) * dx;
        w->lo[k] = from;
        w->hi[k] = from + size;
        need[k] = o_max(need[k], from + size + margin + range(0, 1) * dx);
        if (chance(0.4))
            w->motion.v[k] = range(-0.1, 0.1) * p->cfg.sound_speed;
        if (chance(0.2))
            w->motion.a[k] = range(-50, 50);
    }
}

/* a flat one: from the box's low corner towards a turned direction */
static void turn_flat(const plan *p, plan_wall *w)
{
    const double dx = p->cfg.spacing, angle = range(0, 2 * O_PI), len = range(1.6, 4) * dx, tilt = range(-0.5, 0.5);
    double mid[3] = {0};
    for (int k = 0; k < SPH_DIM; k++)
        mid[k] = 0.5 * (p->cfg.lo[k] + p->cfg.hi[k]);
    const double e[3] = {cos(angle), sin(angle), 0};
    const double f[3] = {-sin(angle) * cos(tilt), cos(angle) * cos(tilt), sin(tilt)};
    for (int k = 0; k < SPH_DIM; k++) {
        w->lo[k] = mid[k] - 0.5 * len * (e[k] + (SPH_DIM == 3 ? f[k] : 0));
        w->hi[k] = SPH_DIM == 3 ? len * e[k] : w->lo[k] + len * e[k];
        w->across[k] = len * f[k];
    }
}

/* ---- domain and particles ---- */

static void draw_domain(plan *p)
{
    sph_config *c = &p->cfg;
    const double support = o_weight_support(c->kernel) * c->smoothing_length;
    const double cell = support * (c->solid == SPH_TOTAL ? c->max_stretch : 1);
    double need[3] = {0};
    p->walls = chance(0.45) ? 1 + pick(2) : 0;
    for (uint32_t k = 0; k < p->walls; k++)
        draw_wall(p, &p->wall[k], need);
    for (int k = 0; k < SPH_DIM; k++) {
        const bool around = c->face[k][0] == SPH_PERIODIC;
        const bool between = c->face[k][0] != SPH_OPEN && c->face[k][1] != SPH_OPEN; /* two mirrors */
        const double least = around ? 3.0001 * cell : between ? 1.0001 * cell : o_max(c->spacing, 0.51 * support);
        double length = chance(0.3) ? least * range(1, 1.3) : range(least, o_max(least * 1.4, 4.5 * support));
        length = o_max(length, need[k]);
        c->lo[k] = range(-30, 30) * c->spacing;
        c->hi[k] = c->lo[k] + length;
        for (uint32_t w = 0; w < p->walls; w++) {
            p->wall[w].lo[k] += c->lo[k];
            p->wall[w].hi[k] += c->lo[k];
        }
        if (c->face[k][0] != SPH_PERIODIC) {
            c->sponge_low[k] = chance(0.2) ? range(0.1, 1) * length : 0;
            c->sponge_high[k] = chance(0.2) ? range(0.1, 1) * length : 0;
        }
    }
    for (uint32_t w = 0; w < p->walls; w++)
        if (p->wall[w].flat)
            turn_flat(p, &p->wall[w]);
}

/* along one axis: near the low face, the high face, or anywhere */
static double place(const plan *p, int k, uint32_t where, double spread)
{
    const double lo = p->cfg.lo[k], hi = p->cfg.hi[k], far = o_min(spread, hi - lo) * range(0, 1);
    return where == 0 ? lo + far : where == 1 ? hi - far : 0.5 * (lo + hi) + far - 0.5 * o_min(spread, hi - lo);
}

static void draw_state(plan *p, plan_point *q, double v, double d)
{
    const sph_config *c = &p->cfg;
    q->d = d * range(-1, 1);
    for (int k = 0; k < SPH_DIM; k++)
        q->v[k] = v * range(-1, 1);
    if (q->set < p->fluids)
        return;
    const sph_solid *m = &p->solid[q->set - p->fluids];
    const double size = chance(0.1) ? 0 : m->shear * 0.2; /* without shear modulus no stress comes to be */
    for (int k = 0; k < 5; k++)
        q->dev[k] = size * range(-1, 1);
    q->plastic = c->yield && chance(0.5) ? range(0, 0.5) : 0;
    if (c->damage)
        q->root = chance(0.5) ? 0 : chance(0.2) ? 1 : range(0, 1);
    for (int k = 0; k < SPH_DIM && c->solid == SPH_TOTAL; k++)
        q->moved[k] = range(-0.2, 0.2) * c->spacing;
}

/* how far particles that will move stay off a face that they must not go through: open ones */
static double shy_of(const plan *p, int k, int side)
{
    const uint32_t face = p->cfg.face[k][side];
    const bool moves = p->still_step || p->steps > 0;
    return moves && face == SPH_OPEN ? 0.1 * p->cfg.spacing : 0;
}

static void draw_points(plan *p)
{
    const sph_config *c = &p->cfg;
    const double support = o_weight_support(c->kernel) * c->smoothing_length, spread = support * range(0.8, 2);
    const double v = c->sound_speed * (chance(0.1) ? 0 : pow(10, range(-3, -0.5)));
    const double d = chance(0.1) ? 0 : pow(10, range(-4, -0.2));
    const double grain = chance(0.5) ? 0 : c->spacing, jitter = chance(0.3) ? 0 : range(0, 0.3) * c->spacing;
    uint32_t where[3];
    for (int k = 0; k < 3; k++)
        where[k] = pick(3);
    p->points = 2 + pick(SPH_DIM == 1 ? 24 : SPH_DIM == 2 ? 40 : 56);
    for (uint32_t i = 0; i < p->points; i++) {
        plan_point *q = &p->point[i];
        q->set = i * (p->fluids + p->solids) / p->points; /* a set's ids follow each other */
        draw_state(p, q, v, d);
        const uint32_t same = i ? pick(i) : 0;
        const double luck = range(0, 1), near = luck < 0.03 ? 0 : luck < 0.06 ? 1e-3 * c->spacing : -1;
        for (int k = 0; k < SPH_DIM; k++) {
            const double length = c->hi[k] - c->lo[k];
            double x = place(p, k, where[k], spread) - c->lo[k];
            if (grain > 0)
                x = (floor(x / grain) + 0.5) * grain + jitter * range(-1, 1);
            if (i && near >= 0)
                x = p->point[same].x[k] - c->lo[k] + near * range(-1, 1);
            if (chance(0.03))
                x = chance(0.5) ? 0 : length * (1 - 1e-15);
            const double low = shy_of(p, k, 0), high = o_min(length * (1 - 1e-15), length - shy_of(p, k, 1));
            q->x[k] = c->lo[k] + o_max(o_min(x, high), o_min(low, high));
        }
    }
    p->probes = PLAN_PROBES;
    for (uint32_t i = 0; i < p->probes; i++)
        for (int k = 0; k < SPH_DIM; k++) {
            p->probe[i][k] = place(p, k, where[k], spread) + (chance(0.2) ? range(-1, 1) * support : 0);
            p->probe[i][k] = o_max(c->lo[k], o_min(c->hi[k], p->probe[i][k]));
            if (chance(0.2))
                p->probe[i][k] = chance(0.5) ? c->lo[k] : c->hi[k];
        }
}

/* some walls move by tables instead, whose velocities jump within the steps to come */
static void draw_tables(plan *p)
{
    for (uint32_t k = 0; k < p->walls; k++) {
        plan_wall *w = &p->wall[k];
        const double time = p->cfg.spacing / p->cfg.sound_speed;
        w->by_table = chance(0.3);
        w->axis = pick(SPH_DIM);
        w->t[0] = chance(0.5) ? 0 : range(0, 0.1) * time;
        w->x[0] = range(-1, 1) * p->cfg.spacing; /* displacements count from here */
        for (int r = 1; r < PLAN_ROWS; r++) {
            w->t[r] = w->t[r - 1] + range(0.01, 0.4) * time;
            w->x[r] = w->x[r - 1] + range(-0.1, 0.1) * p->cfg.sound_speed * (w->t[r] - w->t[r - 1]);
        }
    }
}

/* In whole steps some fly out of the domain, and who is in a wall is removed or put back. */
static void draw_the_going(plan *p)
{
    sph_config *c = &p->cfg;
    if (p->steps == 0)
        return;
    c->on_cross = 1 + pick(SPH_POLICIES - 1);
    for (uint32_t n = chance(0.4) ? 1 + pick(3) : 0; n > 0; n--) {
        plan_point *q = &p->point[pick(p->points)];
        const uint32_t k = pick(SPH_DIM), side = pick(2);
        if (c->face[k][side] != SPH_OPEN || q->set >= p->fluids)
            continue;
        q->x[k] = side ? c->hi[k] - range(0.001, 0.05) * c->spacing : c->lo[k] + range(0.001, 0.05) * c->spacing;
        q->v[k] = (side ? 0.3 : -0.3) * c->sound_speed;
    }
}

/* damper, damping by a rate, XSPH in the velocity; last, so that they change nothing before */
static void draw_small(plan *p)
{
    sph_config *c = &p->cfg;
    const bool quiets = !p->still_step && c->solid == SPH_NO_SOLID && c->integrator < SPH_RUNGE_KUTTA &&
                        c->density == SPH_CONTINUITY && c->scheme != SPH_STANDARD_WICK && c->scheme != SPH_WEAK_WICK;
    c->damper = quiets && chance(0.3) ? range(0.05, 1) : 0;
    c->damping_rate = !p->still_step && chance(0.15) ? range(0.01, 2) * c->sound_speed / c->spacing : 0;
    c->xsph_velocity = c->xsph > 0 && !c->xsph_strain && !p->still_step && chance(0.4);
}

/* the energy equation, of gases and others */
static void draw_energy(plan *p)
{
    sph_config *c = &p->cfg;
    c->energy = c->solid == SPH_NO_SOLID && c->damper <= 0 && chance(0.35);
    c->gamma = range(1.1, 3);
    const bool alone = c->density == SPH_SUMMATION || c->gradient == SPH_RENORMALISED;
    if (!c->energy)
        return;
    if (alone || chance(0.6))
        c->eos = SPH_IDEAL_GAS;
    if (c->density == SPH_SUMMATION && (c->integrator == SPH_KICK_DRIFT_KICK || c->integrator == SPH_LEAP_FROG))
        c->integrator = chance(0.5) ? SPH_PREDICTOR_CORRECTOR : SPH_RUNGE_KUTTA;
    for (uint32_t k = 0; k < p->fluids; k++)
        if (alone || chance(0.3))
            p->fluid[k].eos = SPH_IDEAL_GAS;
    for (uint32_t k = 0; k < p->walls && c->eos == SPH_IDEAL_GAS; k++)
        p->wall[k].wall.kind = pick(SPH_WALL_GHOST);
    for (uint32_t i = 0; i < p->points; i++)
        p->point[i].warm = range(0.3, 2);
}

/* a smoothing length of each particle, of a gas alone */
static void draw_widths(plan *p)
{
    sph_config own = p->cfg;
    if (!own.energy || own.eos != SPH_IDEAL_GAS || own.density != SPH_CONTINUITY || !chance(0.6))
        return;
    own.variable_h = true;
    own.h_min = range(0.4, 1);
    own.h_max = range(1, 1.6);
    own.gradient = SPH_PLAIN;
    own.diffusion = SPH_NO_DIFFUSION;
    own.xsph = own.shifting = own.shepard_every = 0;
    own.xsph_velocity = own.shift_pairs = false;
    own.shear = SPH_NO_SHEAR;
    if (sph_config_check(&own, NULL) == SPH_OK) /* the domain may be too small for its cells */
        p->cfg = own;
}

/* how many particles an inflow begins with */
static uint32_t plan_inflow(const plan *p)
{
    double n = 0;
    for (uint32_t f = 0; f < p->flows; f++) {
        double own = !p->flow[f].out;
        for (int k = 0; k < SPH_DIM; k++)
            own *= o_max(floor((p->flow[f].is.hi[k] - p->flow[f].is.lo[k]) / p->cfg.spacing + 0.5), 1);
        n += own;
    }
    return (uint32_t)n;
}

/* a box along an axis, `at` m from the domain's low face and so long, across as wide as may be or narrower */
static void place_flow(plan *p, plan_flow *f, double at, double length)
{
    const sph_config *c = &p->cfg;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const double room = c->hi[k] - c->lo[k];
        const uint32_t most = SPH_DIM == 3 ? 3 : 6, fit = (uint32_t)o_min(floor(room / c->spacing * (1 + 1e-12)), most);
        const double wide = o_min(c->spacing * (1 + pick(fit > 0 ? fit : 1)), room);
        f->is.lo[k] = c->lo[k] + (k == f->axis ? at : range(0, 0.999) * (room - wide));
        f->is.hi[k] = k == f->axis ? f->is.lo[k] + length : o_min(f->is.lo[k] + wide, c->hi[k]);
        if (k != f->axis && (f->out ? chance(0.7) : room < most * c->spacing && chance(0.7))) {
            f->is.lo[k] = c->lo[k];
            f->is.hi[k] = c->hi[k];
        }
    }
}

/* some water stands before an outflow's face, some before its end, on its way */
static void draw_the_leaving(plan *p, const plan_flow *f, bool up)
{
    const sph_config *c = &p->cfg;
    for (uint32_t n = 2 + pick(6); n > 0; n--) {
        plan_point *q = &p->point[pick(p->points)];
        const double at = chance(0.5) == up ? f->is.lo[f->axis] : f->is.hi[f->axis];
        const double way = range(0.3, 1.5) * f->is.speed;
        if (q->set != f->fluid && chance(0.8))
            continue;
        for (uint32_t k = 0; k < SPH_DIM; k++)
            q->x[k] = range(f->is.lo[k], f->is.hi[k]);
        q->x[f->axis] = at + (up ? -1 : 1) * c->spacing * pow(10, range(-3, 0));
        q->v[f->axis] = (up ? way : -way) * (chance(0.1) ? -1 : 1);
    }
}

/* an inflow, an outflow, or both along one axis, a few steps; last, so that scenes without are as they were */
static void draw_flows(plan *p)
{
    sph_config *c = &p->cfg;
    if (c->solid != SPH_NO_SOLID || c->energy || c->density != SPH_CONTINUITY || !p->steps || !chance(0.6))
        return;
    const uint32_t axis = pick(SPH_DIM), kinds = 1 + pick(3);
    const bool up = chance(0.5);
    const double dx = c->spacing, support = o_weight_support(c->kernel) * c->smoothing_length;
    double at = range(1, 3) * dx, length[2];
    p->way = range(0.05, 0.6);
    p->steps = 1 + pick(8);
    for (int k = 0; k < 2; k++) { /* in order along the axis */
        plan_flow *f = &p->flow[p->flows];
        const bool out = (k == 1) == up;
        length[k] = dx * (floor(support / dx) + 1 + pick(2));
        if (!(kinds & (out ? 2 : 1)))
            continue;
        *f = (plan_flow){.out = out, .axis = axis, .fluid = pick(p->fluids), .gap = pow(10, range(-1.5, 0))};
        f->is.face = out == up ? SPH_LOW(axis) : SPH_HIGH(axis);
        f->is.speed = p->flows ? p->flow[0].is.speed : c->sound_speed * pow(10, range(-1, 0.5));
        f->uneven = !out && chance(0.5) ? range(0, 1.2) : 0;
        f->thick = !out && chance(0.5) ? range(0, 0.1) : 0;
        c->hi[axis] = o_max(c->hi[axis], c->lo[axis] + at + length[k] + range(1, 2) * dx);
        place_flow(p, f, at, length[k]);
        if (out)
            draw_the_leaving(p, f, up);
        at += length[k] + range(2, 5) * dx;
        p->flows++;
    }
    c->max_flows = p->flows;
    if (p->walls == 0 && chance(0.4)) /* scarce, so that ids come round */
        c->max_particles = p->points + pick(4) + plan_inflow(p);
}

/* turns of at most a right angle, and the pieces so long that the deepest layer has more than a spacing of each */
static void draw_way(plan_bed *b, double layers, double dx)
{
    double half[PLAN_BED + 1] = {0}, way = range(0, 2 * O_PI); /* tan(turn/2); none at the ends */
    double turn[PLAN_BED] = {0};
    for (uint32_t k = 1; k + 1 < b->points; k++) {
        turn[k] = chance(0.1) ? 0 : chance(0.2) ? 0.5 * O_PI : range(0.01, 1.5);
        turn[k] *= chance(0.5) ? 1 : -1;
        half[k] = tan(0.5 * turn[k]);
    }
    for (uint32_t k = 1; k < b->points; k++) {
        const double lost = o_max(-layers * (half[k - 1] + half[k]), 0), length = (range(1.02, 4) + lost) * dx;
        way += turn[k - 1];
        b->p[k][0] = b->p[k - 1][0] + length * cos(way);
        b->p[k][1] = b->p[k - 1][1] + length * sin(way);
    }
}

/* a wall along a polyline, one of whose points is near one of the particles; the domain grows until it holds it */
static void draw_bed(plan *p)
{
    sph_config *c = &p->cfg;
    const double dx = c->spacing, support = o_weight_support(c->kernel) * c->smoothing_length;
    plan_bed *b = &p->bed;
    if (SPH_DIM != 2 || c->max_particles < 4096 || p->points == 0 || !chance(0.2))
        return;
    b->wall = sph_wall_default();
    b->wall.kind = chance(0.65) && c->eos != SPH_IDEAL_GAS ? SPH_WALL_GHOST + pick(2) : pick(SPH_WALL_GHOST);
    b->wall.kind -= b->wall.kind == SPH_WALL_MONAGHAN_KOS && support < 2 * dx;
    b->wall.compressible = c->density == SPH_CONTINUITY && chance(0.5);
    b->wall.no_slip = chance(0.6);
    if (b->wall.kind >= SPH_WALL_GHOST && !b->wall.compressible && chance(0.2))
        b->wall.side = SPH_FRONT + pick(2);
    b->wall.layers = chance(0.1) ? 0 : 1 + pick(3);
    b->wall.strength = chance(0.5) ? 0 : range(0.01, 5);
    b->points = 2 + pick(PLAN_BED - 1);
    const double layers = b->wall.layers ? b->wall.layers : ceil(support / dx);
    const plan_point *q = &p->point[pick(p->points)];
    draw_way(b, layers, dx);
    const uint32_t middle = pick(b->points);
    const double at[2] = {b->p[middle][0], b->p[middle][1]};
    for (int k = 0; k < SPH_DIM; k++) {
        const double by = q->x[k] + range(-2, 2) * dx, room = (1.5 * layers + range(0, 1)) * dx;
        for (uint32_t i = 0; i < b->points; i++) {
            b->p[i][k] += by - at[k];
            c->lo[k] = o_min(c->lo[k], b->p[i][k] - room);
            c->hi[k] = o_max(c->hi[k], b->p[i][k] + room);
        }
        b->motion.v[k] = chance(0.4) ? range(-0.1, 0.1) * c->sound_speed : 0;
        b->motion.a[k] = chance(0.2) ? range(-50, 50) : 0;
    }
}

void plan_draw(plan *p, uint64_t seed)
{
    memset(p, 0, sizeof *p);
    p->seed = seed;
    state = seed * 0x2545f4914f6cdd1du + 0x9e3779b97f4a7c15u * (SPH_DIM * 2 + 1);
    next();
    p->cfg = sph_config_default();
    draw_lengths(p);
    draw_faces(p);
    p->still_step = chance(0.4);
    p->steps = !p->still_step && chance(0.5) ? 1 + pick(20) : 0;
    draw_choices(p);
    draw_sets(p);
    draw_domain(p);
    draw_points(p);
    p->wall_d = chance(0.5) ? 0 : range(0, 0.2);
    p->cfg.filter = chance(0.5) ? SPH_SHEPARD : SPH_MLS;
    p->cfg.shepard_every = p->cfg.solid == SPH_NO_SOLID && p->cfg.density == SPH_CONTINUITY && chance(0.5) ? 1 : 0;
    p->cfg.max_particles = 4096;
    for (int k = 0; k < SPH_DIM; k++)
        if (p->cfg.sponge_low[k] > 0 || p->cfg.sponge_high[k] > 0)
            p->cfg.sponge_rate = range(0.1, 3) * p->cfg.sound_speed / p->cfg.spacing / (p->still_step ? PLAN_STILL : 1);
    p->cfg.shifting = p->cfg.solid == SPH_NO_SOLID && !p->still_step && chance(0.4) ? range(0.1, 4) : 0;
    p->cfg.shift_pairs = p->cfg.shifting > 0 && chance(0.5);
    if (p->cfg.shifting > 0 && !SPH_DOUBLE) /* it pushes hard, and its bounds switch: rounding errors of floats grow */
        p->steps = (uint32_t)o_min(p->steps, 5);
    const bool corrects = p->cfg.solid == SPH_CORRECTED || p->cfg.solid == SPH_TOTAL;
    p->cfg.face_quadrature = SPH_DIM > 1 && corrects && chance(0.5);
    for (uint32_t k = 0; k < p->solids; k++)
        p->solid[k].flat_faces = p->cfg.face_quadrature && chance(0.8);
    draw_tables(p);
    draw_the_going(p);
    draw_small(p);
    draw_energy(p);
    draw_widths(p);
    if (p->cfg.solid >= SPH_NORMALISED) /* forces and rates of near-singular sums make rounding errors grow */
        p->steps = (uint32_t)o_min(p->steps, 4);
    p->cfg.hourglass = p->cfg.solid == SPH_TOTAL && chance(0.4) ? range(0.01, 1) : 0;
    /* what edges take is no power of the books */
    if (p->cfg.solid != SPH_NO_SOLID && p->cfg.solid <= SPH_TOTAL && chance(0.25)) {
        p->cfg.edge = SPH_EDGE_P + pick(SPH_EDGES - SPH_EDGE_P);
        p->cfg.edge = SPH_DIM != 2 && p->cfg.edge == SPH_EDGE_M_PRINTED ? SPH_EDGE_M : p->cfg.edge;
        p->cfg.integrator = SPH_KICK_DRIFT_KICK;
        p->cfg.books = false;
        p->cfg.hourglass = 0;
        p->steps = 0; /* layers made up at random amplify whatever they are given, rounding too */
    }
    draw_flows(p);
    draw_bed(p);
}

void plan_print(const plan *p)
{
    static const char *const word[][7] = {
        {"open", "periodic", "symmetry", "no-slip mirror"},
        {"cubic", "quartic", "quintic", "gaussian", "wendland c2", "wendland c4", "hat"},
        {"standard", "weak", "direct", "standard_wick", "weak_wick"},
        {"inviscid", "artificial", "approaching", "morris"},
        {"no diffusion", "molteni", "hydrostatic", "antuono"},
        {"plain", "bonet_lok", "renormalised"},
        {"no solid", "updated", "corrected", "total", "stabilised", "normalised", "normalised_corrected"},
        {"tait", "tait_gray", "linear", "isothermal", "ideal_gas"},
        {"lennard_jones", "kernel_force", "monaghan_kos", "ghost", "adami"},
        {"both sides", "front", "face"}};
    const sph_config *c = &p->cfg;
    printf("  seed %llu: %s, h %.6g dx %.6g, rho0 %g, c %g, %s%s, %s%s, alpha %g beta %g nu %g, %s delta %g, %s, "
           "xsph %g%s, shifting %g, damper %g, rate %g, integrator %u, steps %u\n",
           (unsigned long long)p->seed, word[1][c->kernel], c->smoothing_length, c->spacing, c->rho0, c->sound_speed,
           word[2][c->scheme], c->density ? " summation" : "", word[3][c->viscosity], c->pressure_floor ? " floor" : "",
           c->alpha, c->beta, c->nu, word[4][c->diffusion], c->delta, word[5][c->gradient], c->xsph,
           c->xsph_velocity ? " of velocity" : "", c->shifting, c->damper, c->damping_rate,
           c->integrator, p->steps);
    printf("  guard %d\n", c->gradient_guard);
    printf("  shear %u, cs %g, ci %g, filter %u, energy %d, gamma %g, hourglass %g, edge %u, damping %g, drag %g, "
           "h %g .. %g\n",
           c->shear, c->smagorinsky, c->subgrid, c->filter, c->energy, c->gamma, c->hourglass, c->edge, c->damping,
           p->drag, c->variable_h ? c->h_min : 1, c->variable_h ? c->h_max : 1);
    printf("  %s, eos %s, yield %u, damage %u, artificial stress %u (n %u, eps %g)%s, shepard %u, books %d, "
           "body force %d\n",
           word[6][c->solid], word[7][c->eos], c->yield, c->damage, c->artificial_stress, c->stress_exponent,
           c->stress_epsilon, c->xsph_strain ? " xsph_strain" : c->face_quadrature ? " face_quadrature" : "",
           c->shepard_every, c->books, c->body_force != NULL);
    for (int k = 0; k < SPH_DIM; k++)
        printf("  axis %d: %.17g .. %.17g, %s / %s, gravity %g\n", k, c->lo[k], c->hi[k], word[0][c->face[k][0]],
               word[0][c->face[k][1]], c->gravity[k]);
    for (uint32_t k = 0; k < p->fluids; k++)
        printf("  fluid %u: rho0 %g c %g mass %g own eos %d %s\n", k, p->fluid[k].rho0, p->fluid[k].sound_speed,
               p->fluid[k].mass, p->fluid[k].own_eos, word[7][p->fluid[k].eos]);
    for (uint32_t k = 0; k < p->solids; k++)
        printf("  solid %u: rho0 %g c %g mass %g shear %g yield %g hardening %g body %u held %u\n", k, p->solid[k].rho0,
               p->solid[k].sound_speed, p->solid[k].mass, p->solid[k].shear, p->solid[k].yield, p->solid[k].hardening,
               p->solid[k].body, p->solid[k].held);
    for (uint32_t k = 0; k < p->walls; k++)
        printf("  wall %u: %s%s%s %s %s layers %u strength %g faces %u, from %g to %g, velocity %g\n", k,
               word[8][p->wall[k].wall.kind], p->wall[k].wall.compressible ? " compressible" : "",
               p->wall[k].wall.no_slip ? " no slip" : "", word[9][p->wall[k].wall.side],
               p->wall[k].flat ? "flat" : p->wall[k].inside ? "tank" : "block",
               p->wall[k].wall.layers, p->wall[k].wall.strength, p->wall[k].faces, p->wall[k].lo[0], p->wall[k].hi[0],
               p->wall[k].motion.v[0]);
    for (uint32_t k = 0; k < p->walls; k++)
        for (int r = 0; p->wall[k].by_table && r < PLAN_ROWS; r++)
            printf("  wall %u: table of axis %u: t %.17g x %.9g\n", k, p->wall[k].axis, p->wall[k].t[r],
                   p->wall[k].x[r]);
    for (uint32_t k = 0; k < p->solids; k++)
        for (int a = 0; p->solid[k].held && a < SPH_DIM; a++)
            printf("  solid %u: held, axis %d: v %.9g a %.9g\n", k, a, p->held[k].v[a], p->held[k].a[a]);
    if (p->bed.points)
        printf("  bed: %s%s%s %s layers %u strength %g\n", word[8][p->bed.wall.kind],
               p->bed.wall.compressible ? " compressible" : "", p->bed.wall.no_slip ? " no slip" : "",
               word[9][p->bed.wall.side], p->bed.wall.layers, p->bed.wall.strength);
    for (uint32_t k = 0; k < p->bed.points; k++)
        printf("  bed: %.17g %.17g\n", p->bed.p[k][0], p->bed.p[k][1]);
    for (uint32_t k = 0; k < p->flows; k++) {
        const plan_flow *f = &p->flow[k];
        printf("  %s of fluid %u, axis %u, face %u, speed %g, gap %g, uneven %g, thick %g, way %g, room %u; box",
               f->out ? "outflow" : "inflow", f->fluid, f->axis, f->is.face, f->is.speed, f->gap, f->uneven, f->thick,
               p->way, c->max_particles);
        for (int a = 0; a < SPH_DIM; a++)
            printf(" %.17g .. %.17g", f->is.lo[a], f->is.hi[a]);
        printf("\n");
    }
    for (uint32_t i = 0; i < p->points && i < 12; i++) {
        printf("  point %u: set %u d %.9g x", i, p->point[i].set, p->point[i].d);
        for (int k = 0; k < SPH_DIM; k++)
            printf(" %.17g", p->point[i].x[k]);
        printf(" v");
        for (int k = 0; k < SPH_DIM; k++)
            printf(" %.9g", p->point[i].v[k]);
        printf(" root %g\n", p->point[i].root);
    }
}
