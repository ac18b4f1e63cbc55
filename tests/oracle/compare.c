/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* compare.c: kernel and oracle side by side on one plan. The first forces give densities, rates, accelerations, stress
   rates, walls' values, powers, limits, totals and probes; a step of nearly no time gives what happens once a step
   whatever its size: the Shepard filter, growing damage, sponge layers. Tolerance: 1e-11 (double) or 1e-5 (float) of
   the natural scale, which is the sum of the magnitudes of what was added up. */
#include <stdio.h>
#include <string.h>

#include "plan.h"

#define TOLERANCE (SPH_DOUBLE ? 1e-11 : 1e-5)

/* ---- noting differences ---- */

/* the largest difference of each quantity so far, of those that are too large */
static difference found[PLAN_QUANTITIES];
static uint32_t founds;
static const char *wanted;

static void check(const char *name, uint32_t particle, uint32_t component, double kernel, o_sum oracle, double floor)
{
    uint32_t k = 0;
    if (wanted && strcmp(wanted, name) != 0)
        return;
    const double scale = o_max(oracle.s, fabs(oracle.v)) + floor;
    double ratio = fabs(kernel - oracle.v) / (TOLERANCE * scale + 1e-40);
    if (!(ratio == ratio))
        ratio = 1e300;
    if (!(ratio > 1))
        return;
    while (k < founds && strcmp(found[k].name, name) != 0)
        k++;
    if (k == PLAN_QUANTITIES || (k < founds && found[k].ratio >= ratio))
        return;
    founds = k < founds ? founds : k + 1;
    found[k] = (difference){name, particle, component, kernel, oracle.v, scale, ratio};
}
static o_sum exact(double v) { return (o_sum){v, fabs(v)}; }

/* ---- the first forces ---- */

static seen kernel[4096], before[4096];

static double kept(const double (*m)[3], int k)
{
    static const int at[2][5][2] = {{{0, 0}, {1, 1}, {0, 1}}, {{0, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}}};
    return m[at[SPH_DIM == 3][k][0]][at[SPH_DIM == 3][k][1]];
}
static o_sum kept_sum(const o_sum (*m)[3], int k)
{
    static const int at[2][5][2] = {{{0, 0}, {1, 1}, {0, 1}}, {{0, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}}};
    return m[at[SPH_DIM == 3][k][0]][at[SPH_DIM == 3][k][1]];
}
enum { KEPT = SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? 3 : 5 };

static void compare_solid(const o_scene *s, const o_particle *p, const seen *k)
{
    const o_set *set = &s->set[p->set];
    const double modulus = set->shear;
    for (int c = 0; c < KEPT; c++) {
        check("stress", p->id, (uint32_t)c, k->dev[c], exact(kept((const double(*)[3])p->dev, c)), 0);
        check("stress rate", p->id, (uint32_t)c, k->dev_rate[c], kept_sum((const o_sum(*)[3])p->stress_rate, c), 0);
    }
    if (s->cfg.face_quadrature)
        check("quadrature", p->id, 0, k->phi, p->phi, 0);
    check("plastic strain", p->id, 0, k->plastic, exact(p->plastic), modulus > 0 ? set->yield / modulus : 0);
}

static void compare_body(const o_scene *s, const o_particle *p, const seen *k)
{
    static const char *const power[] = {"viscous power", "wall power", "diffusion power", "body power"};
    const double per = o_diffused_per_rate(s, p);
    const o_sum sums[] = {p->viscous, p->worked, {per * p->diffused.v, fabs(per) * p->diffused.s}, p->pushed};
    for (uint32_t c = 0; c < SPH_DIM; c++) {
        check("acceleration", p->id, c, k->a[c], p->a[c], 0);
        if (s->cfg.xsph > 0)
            check("xsph", p->id, c, k->drift[c], p->drift[c], 0);
    }
    for (uint32_t c = 0; s->cfg.books && c < 4; c++)
        check(power[c], p->id, 0, k->power[c], sums[c], 0);
    if (s->cfg.energy)
        check("energy rate", p->id, 0, k->warmed, p->warmed, 0);
    if (s->cfg.density == SPH_SUMMATION)
        check("summed density", p->id, 0, k->d, p->density, 0);
    for (uint32_t c = 0; s->cfg.shifting > 0 && c < SPH_DIM; c++)
        check("disorder", p->id, c, k->disorder[c], p->disorder[c], 0);
    if (s->cfg.shifting > 0)
        check("filling", p->id, 0, k->disorder[SPH_DIM], p->filling, 0);
    if (o_is_solid(s, p))
        compare_solid(s, p, k);
}

static void compare_forces(const o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        const seen *k = &kernel[p->id];
        const o_set *set = &s->set[p->set];
        const double rho0 = set->rho0;
        if (o_is_body(s, p))
            compare_body(s, p, k);
        if (o_is_body(s, p) || set->compressible)
            check("density rate", p->id, 0, k->rate * rho0, p->rate, 0);
        if (set->role != SPH_ROLE_GHOST || set->kind != SPH_WALL_ADAMI)
            continue;
        check("wall density", p->id, 0, k->d, p->density, 0);
        for (uint32_t c = 0; set->no_slip && c < SPH_DIM; c++)
            check("wall velocity", p->id, c, k->v[c], p->wall_v[c], 0);
    }
}

/* Momentum where nothing outside takes any: the sum of m a is that of gravity and body force; angular momentum of
   fluids whose forces are along the lines between particles. */
static void compare_momentum(const o_scene *s)
{
    const sph_config *c = &s->cfg;
    bool alone = c->scheme != SPH_DIRECT && !o_normalises(s) && !c->max_flows && c->edge == SPH_NO_EDGE;
    o_sum force[3] = {{0, 0}}, turn[3] = {{0, 0}};
    for (int k = 0; k < SPH_DIM; k++)
        alone &= c->face[k][0] == SPH_OPEN && c->face[k][1] == SPH_OPEN;
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        double own[3] = {0}, a[3] = {0};
        alone &= o_is_body(s, p) && !s->set[p->set].held;
        if (c->body_force)
            c->body_force(c->body_ctx, s->time, p->x, p->v, own);
        for (int k = 0; k < SPH_DIM; k++) {
            a[k] = kernel[p->id].a[k] - c->gravity[k] - own[k];
            o_add(&force[k], s->set[p->set].mass * a[k], s->set[p->set].mass * p->a[k].s);
        }
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, n = (k + 2) % 3;
            const double m = s->set[p->set].mass;
            o_add(&turn[k], m * (p->x[l] * a[n] - p->x[n] * a[l]),
                  m * (fabs(p->x[l]) * p->a[n].s + fabs(p->x[n]) * p->a[l].s));
        }
    }
    const bool along = !o_has_solids(s) && c->viscosity != SPH_MORRIS && c->gradient != SPH_RENORMALISED;
    for (uint32_t k = 0; alone && k < 3; k++) {
        check("momentum from nowhere", SPH_NO_PARTICLE, k, force[k].v, (o_sum){0, force[k].s}, 0);
        /* after Bonet & Lok the force is T x_ij, which turns a pair; only all together do not turn, where all have N */
        if (along && c->gradient == SPH_PLAIN && c->shear == SPH_NO_SHEAR)
            check("turn from nowhere", SPH_NO_PARTICLE, k, turn[k].v, (o_sum){0, turn[k].s}, 0);
    }
}

/* The force limit as the acceleration that it stands for, which may be nearly all rounding error: how well the largest
   of the particles is known. */
static o_sum largest_acceleration(const o_scene *s)
{
    o_sum most = {0, 0};
    for (uint32_t turn = 0; turn < 2; turn++)
        for (uint32_t i = 0; i < s->n; i++) {
            const o_particle *p = &s->own[i];
            const double told = s->cfg.smoothing_length / o_own_h(s, p);
            const double a = sqrt(p->a[0].v * p->a[0].v + p->a[1].v * p->a[1].v + p->a[2].v * p->a[2].v) * told;
            const double scale = a + (p->a[0].s + p->a[1].s + p->a[2].s) * told;
            if (!o_is_body(s, p))
                continue;
            if (turn == 0)
                most.v = o_max(most.v, a);
            else if (a + TOLERANCE * scale >= most.v)
                most.s = o_max(most.s, scale);
        }
    return most;
}
/* m/s^2 of a force limit; 0: there is none */
static double acceleration_of(const o_scene *s, double limit)
{
    return limit > 0 ? s->cfg.smoothing_length * pow(s->cfg.force_factor / limit, 2) : 0;
}

static void compare_limits(const sph_sim *sim, const o_scene *s)
{
    const o_limits l = o_find_limits(s);
    const struct {
        const char *name, *part;
        double v, scale;
    } of[] = {{"courant limit", "courant", l.courant, l.courant_scale},   {"viscous limit", "viscous", l.viscous, 1},
              {"gravity limit", "gravity", l.gravity, 1},
              {"diffusion limit", "diffusi", l.diffusion, 1}};
    for (size_t k = l.courant_undecided; k < sizeof of / sizeof *of; k++)
        check(of[k].name, SPH_NO_PARTICLE, 0, look_limit(sim, of[k].part), (o_sum){of[k].v, of[k].v * of[k].scale}, 0);
    check("force limit", SPH_NO_PARTICLE, 0, acceleration_of(s, look_limit(sim, "force")),
          (o_sum){acceleration_of(s, l.force), largest_acceleration(s).s}, 0);
}

static void compare_totals(const sph_sim *sim, const o_scene *s)
{
    static const char *const power[] = {"book of viscosity", "book of walls", "book of diffusion",
                                        "book of body forces"};
    const o_totals o = o_find_totals(s);
    const o_sum book[] = {o.dissipated, o.worked, o.diffused, o.pushed};
    sph_totals t;
    sph_get_totals(sim, &t);
    check("mass", SPH_NO_PARTICLE, 0, t.mass, o.mass, 0);
    check("kinetic", SPH_NO_PARTICLE, 0, t.kinetic, o.kinetic, 0);
    check("potential", SPH_NO_PARTICLE, 0, t.potential, o.potential, 0);
    check("internal", SPH_NO_PARTICLE, 0, t.internal, o.internal, 0);
    check("elastic", SPH_NO_PARTICLE, 0, t.elastic, o.elastic, 0);
    check("plastic work", SPH_NO_PARTICLE, 0, t.plastic_work, o.plastic, 0);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        check("momentum", SPH_NO_PARTICLE, k, t.momentum[k], o.momentum[k], 0);
    for (uint32_t k = 0; k < 3; k++)
        if (SPH_DIM == 3 || (SPH_DIM == 2 && k == 2))
            check("angular momentum", SPH_NO_PARTICLE, k, t.angular[k], o.angular[k], 0);
    for (uint32_t k = 0; s->cfg.books && k < 4; k++)
        check(power[k], SPH_NO_PARTICLE, k, look_power(sim, k), book[k], 0);
    /* The instant balance: energies rise by what is given less what is taken. With summed density that is without the
       compression by which places move otherwise than pairs see (sph.h). */
    if (s->cfg.books) {
        static const int sign[] = {-1, 1, -1, 1, -1, -1, -1};
        /* of a body that all moves as it is told, inner forces cancel in the walls' power */
        double sum = 0, size = o.dissipated.s + o.worked.s + o.diffused.s + o.pushed.s;
        for (uint32_t k = s->cfg.energy ? 1 : 0; k < 7; k++) { /* heat stays */
            sum += sign[k] * look_power(sim, k);
            size += fabs(look_power(sim, k));
        }
        check("balance of powers", SPH_NO_PARTICLE, 0, sum, o.rise, size);
    }
}

static double cover_at(o_scene *s, const double *x, uint32_t axis, double y)
{
    double at[3] = {x[0], x[1], x[2]};
    at[axis] = y;
    const char *const undecided = s->undecided; /* a line passes many edges: those of its places do not matter */
    const double cover = o_probe(s, at).cover.v;
    s->undecided = undecided;
    return cover;
}

/* The gauge walks in quarters of a spacing: no place more than one above its height may be covered by half over a whole
   one, and at its height cover passes 1/2. The depth is the integral of cover over the whole line. */
static void compare_gauges(const sph_sim *sim, o_scene *s, const double *x, uint32_t axis)
{
    enum { PARTS = 16 };
    const double quarter = 0.25 * s->cfg.spacing, lo = s->cfg.lo[axis], hi = s->cfg.hi[axis];
    const bool open = s->cfg.face[axis][0] == SPH_OPEN && s->cfg.face[axis][1] == SPH_OPEN;
    double height = 0, run = 0;
    if (sph_gauge(sim, x, axis, &height) != SPH_OK || !open)
        return;
    for (double y = o_max(height, lo) + quarter; y < hi + s->support; y += quarter / PARTS) {
        run = cover_at(s, x, axis, y) >= 0.5 + 1e-5 ? run + quarter / PARTS : 0;
        check("gauge misses water above", 0, axis, run > quarter * 1.01, (o_sum){0, 1}, 0);
    }
    if (height > lo) {
        double most = 0, least = 1e300;
        for (int k = -PARTS; k <= PARTS; k++) {
            const double cover = cover_at(s, x, axis, height + quarter * k / PARTS);
            most = o_max(most, cover);
            least = o_min(least, cover);
        }
        check("gauge where nothing begins", 0, axis, most < 0.5 - 1e-5 || least > 0.5 + 1e-5, (o_sum){0, 1}, 0);
    }
#ifdef sph_depth
    double depth = 0, sum = 0, size = 0;
    if (sph_depth(sim, x, axis, &depth) != SPH_OK)
        return;
    const double far = s->support, step = (hi - lo + 2 * far) / 4000;
    for (double y = lo - far + 0.5 * step; y < hi + far; y += step) {
        sum += step * cover_at(s, x, axis, y);
        size += step * cover_at(s, x, axis, y);
    }
    check("depth", 0, axis, depth, (o_sum){sum, (size + far * 1e-2) * 2e-3 / TOLERANCE}, 0);
#endif
}

/* From half a spacing above the bed on no quarter of a spacing may be dry below the surface, and there cover passes
   1/2, unless it does so nowhere below a face with images; or that half spacing is dry, and it is the bed. */
static void compare_surface(const sph_sim *sim, o_scene *s, const double *bed, uint32_t axis)
{
    enum { PARTS = 8 };
    const double dx = s->cfg.spacing, quarter = 0.25 * dx, start = bed[axis] + 0.5 * dx;
    const double first = cover_at(s, bed, axis, start);
    double height = 0, run = 0, most = 0, least = 1e300;
    if (sph_surface(sim, bed, axis, &height) != SPH_OK || fabs(first - 0.5) < 1e-4 || start > s->cfg.hi[axis])
        return;
    if (first < 0.5) {
        check("surface of a dry bed", 1, axis, height, exact(bed[axis]), dx);
        return;
    }
    check("surface below the bed", 1, axis, height < start, (o_sum){0, 1}, 0);
    for (double y = start; y < height - quarter; y += quarter / PARTS) {
        run = cover_at(s, bed, axis, y) < 0.5 - 1e-5 ? run + quarter / PARTS : 0;
        check("surface above a gap", 1, axis, run > quarter * 1.01, (o_sum){0, 1}, 0);
    }
    for (int k = -PARTS; k <= PARTS; k++) {
        const double cover = cover_at(s, bed, axis, height + quarter * k / PARTS);
        most = o_max(most, cover);
        least = o_min(least, cover);
    }
    if (s->cfg.face[axis][1] == SPH_OPEN || height < s->cfg.hi[axis] - quarter)
        check("surface where nothing ends", 1, axis, most < 0.5 - 1e-5 || least > 0.5 + 1e-5, (o_sum){0, 1}, 0);
}

static void compare_probes(const sph_sim *sim, const plan *p, o_scene *s)
{
    for (uint32_t i = 0; i < p->probes; i++) {
        sph_probe_value v;
        const o_probe_value o = o_probe(s, p->probe[i]);
        if (sph_probe(sim, p->probe[i], &v) != SPH_OK)
            continue;
        o_close(s, "a probe that sees nearly nothing", o.cover.v, 1e-6, 1e-3);
        check("probe cover", i, 0, v.cover, o.cover, 0);
        check("probe rho", i, 0, v.rho, o.rho, 0);
        check("probe p", i, 0, v.p, o.p, 0);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            check("probe v", i, k, v.v[k], o.v[k], 0);
    }
    if (p->probes)
        compare_gauges(sim, s, p->probe[0], (uint32_t)(p->seed % SPH_DIM));
    if (p->probes > 1)
        compare_surface(sim, s, p->probe[1], (uint32_t)(p->seed % SPH_DIM));
}

/* ---- a step of nearly no time ---- */


/* where even so short a way may lead through a face or turn a velocity */
static bool on_a_face(const o_scene *s, const o_particle *p)
{
    bool on = false;
    for (int k = 0; k < SPH_DIM; k++)
        on |= p->x[k] - s->cfg.lo[k] < 1e-6 * s->cfg.spacing || s->cfg.hi[k] - p->x[k] < 1e-6 * s->cfg.spacing;
    return on;
}

static void compare_still(const sph_sim *sim, o_scene *s, double dt)
{
    const bool twice = s->cfg.integrator == SPH_PREDICTOR_CORRECTOR || s->cfg.integrator == SPH_KICK_DRIFT_KICK;
    const double damping = s->cfg.damping * (twice ? s->cfg.damping : 1);
    look_results(sim, kernel, 4096);
    for (uint32_t i = 0; i < s->n; i++)
        if (!kernel[s->own[i].id].there) { /* those who are left see one less */
            s->undecided = "a particle leaves";
            return;
        }
    double rate = 0; /* by which densities changed at most, before the filter mixed them */
    for (uint32_t i = 0; i < s->n; i++)
        rate = o_max(rate, o_max(fabs(kernel[s->own[i].id].rate), fabs(before[s->own[i].id].rate)));
    if (s->cfg.shepard_every)
        o_filter_density(s);
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        const o_set *set = &s->set[p->set];
        const seen *k = &kernel[p->id];
        if (!o_is_body(s, p) || on_a_face(s, p))
            continue;
        if (s->cfg.shepard_every)
            check("filtered density", p->id, 0, k->d, p->density, 100 * dt * rate / TOLERANCE);
        for (uint32_t c = 0; c < SPH_DIM; c++) {
            const bool held = set->held >> c & 1;
            const double ref = s->cfg.sponge_velocity[c], f = held ? 1 : exp(-s->cfg.sponge_rate * o_sponge(s, p) * dt);
            check("velocity after a sponge", p->id, c, k->v[c], exact(ref + (p->v[c] * (held ? 1 : damping) - ref) * f),
                  fabs(p->v[c]) + set->c0 +
                      10 * dt * (fabs(k->a[c]) + fabs(before[p->id].a[c])) / TOLERANCE);
        }
        if (!s->cfg.damage || !o_is_solid(s, p))
            continue;
        float flaw[O_MAX_FLAWS];
        const uint32_t flaws = look_flaws(sim, p->id, flaw);
        check("damage", p->id, 0, k->root, exact(o_grown_root(s, p, flaw, flaws, dt)), 0);
    }
}

/* ---- whole steps ---- */

/* how far trajectories may come apart: rounding errors that grow from step to step */
#define APART (SPH_DOUBLE ? 1e-8 : 1e-3)

static const sph_sim *looked_at;
static uint32_t flaws_of(uint32_t id, float *threshold) { return look_flaws(looked_at, id, threshold); }

/* errors of all steps, by that of one state */
#define ERRORS 10

static o_spread spread;  /* where the scene is badly conditioned (condition.c), else 0 */
static bool all_is_lost; /* and so badly that nothing can be said */

static o_sum near(double v, double scale, double grown)
{
    all_is_lost |= !(ERRORS * grown <= 0.03 * scale);
    return (o_sum){v, (scale * APART + ERRORS * grown) / TOLERANCE};
}

/* m g dx and m c^2 d, J: what errors of places and densities make of energies; at rest a gas has a pressure */
static double heat_of(const o_scene *s)
{
    double sum = 0;
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        const o_set *set = &s->set[p->set];
        for (int k = 0; k < SPH_DIM; k++)
            sum += o_is_body(s, p) ? set->mass * fabs(s->cfg.gravity[k]) * s->cfg.spacing : 0;
        const double slope = pow(o_sound(set->eos, set->c0), 2) * (set->eos == SPH_ISOTHERMAL ? 1 : fabs(p->d));
        sum += o_is_body(s, p) ? set->mass * slope : 0;
    }
    return sum;
}

/* Who is still there, who was put back, and what they took along. A particle that leaves at the end of a step has an
   energy between its beginning's and its end's: with XSPH and in Runge-Kutta. */
static void compare_the_gone(const sph_sim *sim, const o_scene *s)
{
    const bool rk = s->cfg.integrator == SPH_RUNGE_KUTTA || s->cfg.integrator == SPH_RUNGE_KUTTA_MOMENTUM;
    uint32_t there = 0, missed = 0;
    sph_step_info info;
    sph_totals t;
    sph_get_step(sim, &info);
    sph_get_totals(sim, &t);
    for (uint32_t id = 0; id < 4096; id++)
        there += kernel[id].there;
    for (uint32_t i = 0; i < s->n; i++)
        missed += !kernel[s->own[i].id].there;
    check("particles that are there", SPH_NO_PARTICLE, 0, there + missed, (o_sum){s->n, 0}, 0);
    check("particles that left", SPH_NO_PARTICLE, 0, info.left, (o_sum){s->left, 0}, 0);
    check("particles in walls", SPH_NO_PARTICLE, 0, info.crossed, (o_sum){s->crossed, 0}, 0);
    check("particles put back", SPH_NO_PARTICLE, 0, info.put_back, (o_sum){s->put_back, 0}, 0);
    const double one = (double)s->n * s->cfg.rho0 * pow(s->cfg.spacing, SPH_DIM);
    check("removed mass", SPH_NO_PARTICLE, 0, t.removed_mass, s->removed_mass, one);
    check("added mass", SPH_NO_PARTICLE, 0, t.added_mass, s->added_mass, 0);
    if (!s->cfg.books || missed)
        return;
    check("fed", SPH_NO_PARTICLE, 0, t.fed, near(s->fed.v, heat_of(s) + s->fed.s, 0), 0);
    const double heat = heat_of(s) + s->carried_off.s + s->put_back_loss.s;
    check("put back's book", SPH_NO_PARTICLE, 0, t.put_back_loss, near(s->put_back_loss.v, heat, 0), 0);
    if (s->left == s->let_out || !(rk || s->cfg.xsph > 0))
        check("carried off", SPH_NO_PARTICLE, 0, t.carried_off, near(s->carried_off.v, heat, 0), 0);
}

static void compare_trajectories(const sph_sim *sim, const o_scene *s)
{
    look_results(sim, kernel, 4096);
    compare_the_gone(sim, s);
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        const o_set *set = &s->set[p->set];
        const seen *k = &kernel[p->id];
        const bool body = o_is_body(s, p);
        check("set after steps", p->id, 0, k->set, (o_sum){p->set, 0}, 0);
        for (uint32_t c = 0; c < SPH_DIM; c++) {
            check("place after steps", p->id, c, k->x[c], near(p->x[c], s->cfg.spacing, spread.x), 0);
            if (body)
                check("velocity after steps", p->id, c, k->v[c], near(p->v[c], set->c0 + fabs(p->v[c]), spread.v), 0);
        }
        if (body && s->cfg.energy)
            check("energy after steps", p->id, 0, k->u,
                  near(p->u, set->c0 * set->c0 + fabs(p->u), set->c0 * spread.v + fabs(p->u) * spread.d), 0);
        if (body || set->compressible)
            check("density after steps", p->id, 0, k->d, near(p->d, 1, spread.d), 0);
        if (!o_is_solid(s, p))
            continue;
        for (int c = 0; c < KEPT; c++)
            check("stress after steps", p->id, (uint32_t)c, k->dev[c],
                  near(kept((const double(*)[3])p->dev, c), set->shear, spread.dev), 0);
        check("plastic strain after steps", p->id, 0, k->plastic, near(p->plastic, 1, spread.plastic), 0);
        check("damage after steps", p->id, 0, k->root, near(p->root, 1, spread.root), 0);
    }
    sph_totals t;
    sph_get_totals(sim, &t);
    if (s->cfg.damper > 0)
        check("book of the damper", SPH_NO_PARTICLE, 0, t.quieted,
              near(s->quieted.v, s->quieted.s + heat_of(s), spread.quieted), 0);
    if (s->cfg.damping_rate > 0)
        check("book of damping", SPH_NO_PARTICLE, 0, t.slowed,
              near(s->slowed.v, s->slowed.s + heat_of(s), spread.slowed), 0);
    if (s->cfg.xsph_velocity)
        check("book of evening", SPH_NO_PARTICLE, 0, t.evened,
              near(s->evened.v, s->evened.s + heat_of(s), spread.evened), 0);
    if (s->cfg.books)
        check("work of walls and flows", SPH_NO_PARTICLE, 0, t.wall_work,
              near(s->wall_work.v, s->wall_work.s + heat_of(s), spread.worked), 0);
    if (s->cfg.shifting > 0)
        check("book of shifting", SPH_NO_PARTICLE, 0, t.shifted,
              near(s->shifted.v, s->shifted.s + heat_of(s), spread.shifted), 0);
}

/* a tenth of the smallest limit */
static double small_step(const o_scene *s)
{
    const o_limits l = o_find_limits(s);
    const double of[] = {l.courant, l.viscous, l.force, l.gravity, l.diffusion};
    double dt = 1e300;
    for (size_t k = 0; k < sizeof of / sizeof *of; k++)
        if (of[k] > 0)
            dt = o_min(dt, of[k]);
    return 0.1 * dt;
}

/* Once more, where trajectories differ, within what rounding makes of them. */
static void compare_ends(const sph_sim *sim, const o_scene *start, o_scene *s, uint32_t steps, double dt)
{
    const uint32_t so_far = founds;
    spread = (o_spread){0};
    if (!SPH_DOUBLE && s->cfg.books && s->wall_work.s > 1e30)
        s->undecided = "powers beyond what a float holds";
    compare_trajectories(sim, s);
    if (founds == so_far)
        return;
    founds = so_far;
    spread = o_find_spread(start, s, steps, dt, flaws_of);
    all_is_lost = false;
    compare_trajectories(sim, s);
    if (all_is_lost)
        s->undecided = "rounding errors that grow without bound";
}

static double way_between(const double *a, const double *b)
{
    double sum = 0;
    for (int k = 0; k < SPH_DIM; k++)
        sum += pow(a[k] - b[k], 2);
    return sum;
}

/* Who was born in a step has one of its new ids, nobody says which: each of the oracle's takes that of the kernel's
   nearest, and gives its own to the one that had it. */
static void match_newcomers(const sph_sim *sim, o_scene *s)
{
    look_results(sim, kernel, 4096);
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *a = &s->own[i], *best = a;
        for (uint32_t j = i + 1; a->born && j < s->n; j++) {
            o_particle *b = &s->own[j];
            if (b->born && way_between(kernel[b->id].x, a->x) < way_between(kernel[best->id].x, a->x))
                best = b;
        }
        const uint32_t id = a->id;
        a->id = best->id;
        best->id = id;
    }
}

/* a step of a spacing's share where flows go, at the limits at most; else small */
static double step_of(const plan *p, const o_scene *s)
{
    const double most = 10 * small_step(s);
    return p->flows ? o_min(most, p->way * p->cfg.spacing / p->flow[0].is.speed) : most / 10;
}

static sph_status run_steps(sph_sim *sim, const plan *p, o_scene *s)
{
    static o_scene start;
    sph_status st = SPH_OK;
    look_scene(sim, p, s);
    o_forces(s);
    const double dt = step_of(p, s);
    bool goes = true;
    s->cfg.dt = dt;
    looked_at = sim;
    o_keep(&start, s);
    st = sph_reconfigure(sim, &s->cfg);
    o_begin_steps(s, s->n);
    for (uint32_t k = 1; !st && goes && k <= p->steps && !s->undecided; k++) {
        st = sph_step(sim);
        goes = o_step(s, k, dt, flaws_of);
        if (p->flows && goes && !st)
            match_newcomers(sim, s);
    }
    if (!s->undecided && goes == (st == SPH_TOO_MANY_PARTICLES))
        check("room", SPH_NO_PARTICLE, 0, st, (o_sum){goes ? SPH_OK : SPH_TOO_MANY_PARTICLES, 0}, 0);
    if (!goes) {
        check("particles needed", SPH_NO_PARTICLE, 0, sph_last(sim)->value, exact(s->needed), 0);
        return SPH_OK;
    }
    if (st == SPH_TOO_MANY_PARTICLES)
        return SPH_OK;
    if (!st && !s->undecided)
        compare_ends(sim, &start, s, p->steps, dt);
    return st;
}

/* ---- walls along polylines ---- */

/* the nearest of those that have no particle yet */
static o_bed_particle *place_of(o_bed_particle *bed, uint32_t n, const double *x)
{
    o_bed_particle *best = NULL;
    double near = 0;
    for (uint32_t i = 0; i < n; i++) {
        const double d = hypot(bed[i].x[0] - x[0], bed[i].x[1] - x[1]);
        if (!bed[i].found && (!best || d < near)) {
            near = d;
            best = &bed[i];
        }
    }
    return best;
}

/* The particles of the last sets, which are the bed's: each has a place of its own, and its set is as that asks for. */
static void compare_bed(o_scene *s, const plan *p)
{
    static o_bed_particle bed[4096];
    const double dx = s->cfg.spacing;
    const uint32_t points = p->bed.points, layers = p->bed.wall.layers;
    const uint32_t deep = layers ? layers : (uint32_t)ceil(s->support / dx * (1 - 1e-12));
    uint32_t there = 0;
    if (points == 0)
        return;
    const uint32_t n = o_lay_bed(s, p->bed.p, points, p->bed.wall.kind >= SPH_WALL_GHOST ? deep : 0, deep * dx, bed);
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *w = &s->own[i];
        const o_set *set = &s->set[w->set];
        if (w->set + 2 * points - 3 < s->sets)
            continue;
        o_bed_particle *o = place_of(bed, n, w->x);
        there++;
        check("mass of a bed", w->id, 0, set->mass, exact(s->cfg.rho0 * pow(dx, SPH_DIM)), 0);
        check("kind of a bed", w->id, 0, set->kind, exact(p->bed.wall.kind), 0);
        for (uint32_t k = 0; o && k < 2; k++) {
            check("place of a bed's", w->id, k, w->x[k], (o_sum){o->x[k], 1e-6 * dx / TOLERANCE}, 0);
            check("normal of a bed", w->id, k, set->normal[k], (o_sum){o->normal[k], 1}, 0);
            check("face of a bed", w->id, k, set->origin[k], (o_sum){o->origin[k], 100 * dx + fabs(o->origin[k])}, 0);
        }
        check("face of a bed", w->id, 2, o ? set->half[0] : 0, (o_sum){o ? o->half : 0, dx}, 0);
        check("face of a bed", w->id, 3, set->thick, exact(o && o->region ? deep * dx : 0), 0);
        if (o)
            o->found = true;
    }
    check("particles of a bed", SPH_NO_PARTICLE, 0, there, exact(n), 0);
}

/* ---- a plan ---- */

static o_scene scene;

static verdict compare(const plan *p, const char **why)
{
    sph_report report;
    sph_sim *sim = look_build(p, &report);
    if (!sim) {
        *why = report.what;
        return PLAN_REFUSED;
    }
    look_scene(sim, p, &scene);
    compare_bed(&scene, p);
    if (sph_ready(sim) != SPH_OK) {
        *why = sph_status_text(sph_last(sim)->status);
        return PLAN_REFUSED;
    }
    o_straighten(&scene);
    o_refresh(&scene);
    o_yield(&scene);
    if (scene.cfg.density == SPH_SUMMATION)
        o_sum_density(&scene);
    o_forces(&scene);
    look_results(sim, kernel, 4096);
    compare_forces(&scene);
    compare_momentum(&scene);
    compare_limits(sim, &scene);
    look_scene(sim, p, &scene); /* totals and probes of the state that the kernel has now */
    o_refresh(&scene);
    compare_probes(sim, p, &scene);
    if (!scene.undecided) {
        /* the books' powers need the sums once more */
        o_forces(&scene);
        compare_totals(sim, &scene);
    }
    *why = scene.undecided;
    if (p->steps && !scene.undecided && run_steps(sim, p, &scene) != SPH_OK) {
        *why = sph_status_text(sph_last(sim)->status);
        return PLAN_REFUSED;
    }
    *why = scene.undecided;
    if (!p->still_step || scene.undecided)
        return PLAN_SAME;
    look_scene(sim, p, &scene);
    o_refresh(&scene);
    look_results(sim, before, 4096);
    const double dt = PLAN_STILL * p->cfg.spacing / p->cfg.sound_speed;
    scene.cfg.dt = dt;
    if (sph_reconfigure(sim, &scene.cfg) != SPH_OK || sph_step(sim) != SPH_OK) {
        *why = sph_status_text(sph_last(sim)->status);
        return PLAN_REFUSED;
    }
    compare_still(sim, &scene, dt);
    *why = scene.undecided;
    return PLAN_SAME;
}

verdict plan_compare(const plan *p, const char *only, difference *d, uint32_t *n, const char **why)
{
    const char *said = NULL;
    founds = 0;
    wanted = only;
    const verdict v = compare(p, &said);
    if (why)
        *why = said;
    *n = founds;
    memcpy(d, found, founds * sizeof *d);
    if (v == PLAN_REFUSED)
        return v;
    if (scene.undecided)
        return PLAN_UNDECIDED;
    return founds ? PLAN_DIFFERS : PLAN_SAME;
}
