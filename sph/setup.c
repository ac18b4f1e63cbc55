/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* setup.c: sets, particles, lattices, and walls as rows or layers of particles. Runs between steps only.

   Ghost layers stand on the continuation of the fluid's lattice: centres half a spacing behind the wall, then one
   spacing apart, as many as the kernel's support needs (Gray 2001 section 2.4). Where two chosen faces of a tank meet, the
   particles behind both get the diagonal normal (his figure 2.4). Boundary-force particles stand on the wall itself. */
#include "internal.h"

static sph_status bad(sph_sim *sim, const char *what, const char *allowed, double value)
{
    return sph_error(sim, SPH_BAD_ARGUMENT, what, allowed, value, SPH_NO_PARTICLE);
}

/* everything of set-up needs a simulation that is not in the middle of a step */
static __attribute__((noinline)) sph_status idle(sph_sim *sim, const char *call)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    return sim->begun ? sph_error(sim, SPH_BAD_STATE, call, "between steps", 0, SPH_NO_PARTICLE) : SPH_OK;
}

/* 0, which asks for a default, or between 1/most and most, whose squares and quotients stay in a double's range */
static __attribute__((noinline)) sph_status check_positive(sph_sim *sim, const char *what, double v, float most)
{
    if (v == 0 || (v >= 1 / (double)most && v <= (double)most))
        return SPH_OK;
    return bad(sim, what, most > 1e20f ? "0 or 1e-30 .. 1e30" : "0 or 1e-15 .. 1e15", v);
}

#if SPH_HAS_WALLS || SPH_WITH_SHAPES
static __attribute__((noinline)) uint32_t round_up(double x) { return x <= 0 ? 0 : x >= 4e9 ? 4000000000u : (uint32_t)(x + 0.999999); }
#endif

/* number of lattice intervals in a length, at least one; 0 if there are absurdly many */
static __attribute__((noinline)) uint32_t intervals(double length, double dx)
{
    double n = length / dx + 0.5;
    return n < 1 ? 1 : n < 1073741824.0 ? (uint32_t)n : 0;
}

/* ---- sets ---- */

static void finish_set(sph_sim *sim, sph_set *s)
{
    double scale = s->c0 * s->c0 * s->rho0;
    if (SPH_IS(sim->cfg.eos, TAIT))
        scale /= 7;
    s->mass_r = (sph_real)s->mass;
    s->rho0_r = (sph_real)s->rho0;
    s->inv_rho0_r = (sph_real)(1 / s->rho0);
    s->b_r = (sph_real)scale;
    uint64_t h = sim->setup_hash;
    h = sph_mix(h, (uint64_t)s->role | (uint64_t)s->kind << 8 | (uint64_t)s->group << 16 |
                       (uint64_t)s->compressible << 32 | (uint64_t)s->no_slip << 33 | (uint64_t)s->corner << 34);
    const double v[] = {s->mass, s->rho0, s->c0, s->strength, s->thick, s->half[0], s->half[1]};
    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        h = sph_mix_double(h, v[i]);
    for (int k = 0; k < SPH_DIM; k++)
        h = sph_mix_double(sph_mix_double(h, s->origin[k]), s->normal[k]);
    sim->setup_hash = h;
}

static double cell_volume(const sph_sim *sim)
{
    double v = 1;
    for (int k = 0; k < SPH_DIM; k++)
        v *= sim->cfg.spacing;
    return v;
}

sph_status sph_add_fluid(sph_sim *sim, const sph_fluid *f, uint32_t *set)
{
    sph_status st = idle(sim, "sph_add_fluid");
    if (st)
        return st;
    if (!set)
        return bad(sim, "set", "a place for the set's number", 0);
    double mass = f ? f->mass : 0, rho0 = f ? f->rho0 : 0, c0 = f ? f->sound_speed : 0;
    if ((st = check_positive(sim, "fluid.mass", mass, 1e30f)) != SPH_OK ||
        (st = check_positive(sim, "fluid.rho0", rho0, 1e30f)) != SPH_OK ||
        (st = check_positive(sim, "fluid.sound_speed", c0, 1e15f)) != SPH_OK)
        return st;
    if (sim->sets == sim->cfg.max_sets)
        return sph_error(sim, SPH_TOO_MANY_SETS, "sets", "at most max_sets", sim->sets, SPH_NO_PARTICLE);
    sph_set *s = &sim->set[sim->sets];
    memset(s, 0, sizeof *s);
    s->role = SPH_ROLE_FLUID;
    s->group = SPH_MAX_GROUPS;
    s->rho0 = rho0 > 0 ? rho0 : sim->cfg.rho0;
    s->c0 = c0 > 0 ? c0 : sim->cfg.sound_speed;
    s->mass = mass > 0 ? mass : s->rho0 * cell_volume(sim);
    finish_set(sim, s);
    *set = sim->sets++;
    return SPH_OK;
}

/* ---- particles ---- */

/* x (m, from the domain's low corner) in quanta; the caller has checked the range */
static __attribute__((noinline)) sph_pos to_quanta(const sph_sim *sim, double x)
{
    double q = x / sim->grid.quantum;
    return (sph_pos)(q < 0 ? q - 0.5 : q + 0.5);
}

/* appends one particle; x from the domain's low corner */
static sph_status append(sph_sim *sim, uint32_t set, const double *x, const double *v, double d)
{
    uint32_t n = sim->now.count;
    if (n == sim->cfg.max_particles)
        return sph_error(sim, SPH_TOO_MANY_PARTICLES, "max_particles", "more than were asked for", n, SPH_NO_PARTICLE);
    for (int k = 0; k < SPH_DIM; k++)
        if (!(x[k] >= 0 && x[k] < sim->grid.length[k]))
            return bad(sim, "position", "inside the domain, walls included", x[k] + sim->cfg.lo[k]);
    sph_buffer *b = &sim->buf[sim->cur];
    for (int k = 0; k < SPH_DIM; k++) {
        b->pos[k][n] = to_quanta(sim, x[k]);
        if (b->pos[k][n] >= sim->grid.extent[k])
            b->pos[k][n] = sim->grid.extent[k] - 1;
        b->vel[k][n] = (sph_real)(v ? v[k] : 0);
        b->acc[k][n] = 0;
        if (b->xsph[k])
            b->xsph[k][n] = 0;
    }
    b->rho[0][n] = (sph_real)d;
    b->drho[0][n] = 0;
    b->id[0][n] = n;
    b->set[0][n] = (uint8_t)set;
    sim->now.count = n + 1;
    return SPH_OK;
}

/* begins an addition: particles are appended in order of id, so removals must have been few or none */
static sph_status begin_adding(sph_sim *sim, const char *call)
{
    sph_status st = idle(sim, call);
    if (st)
        return st;
    if (sim->now.step > 0 || sim->now.left > 0)
        return sph_error(sim, SPH_BAD_STATE, call, "before the first step", (double)sim->now.step, SPH_NO_PARTICLE);
    if (sim->now.primed) { /* the arrays were ordered by cell: put them back in order of id */
        return sph_error(sim, SPH_BAD_STATE, call, "before sph_ready", 0, SPH_NO_PARTICLE);
    }
    return SPH_OK;
}

static __attribute__((noinline)) sph_status end_adding(sph_sim *sim, uint32_t before, sph_status st)
{
    if (st)
        sim->now.count = before;
    sim->now.primed = false;
    sim->table_valid = false;
    if (sim->now.count > sim->mark_particles)
        sim->mark_particles = sim->now.count;
    return st;
}

static sph_status check_set(sph_sim *sim, uint32_t set)
{
    if (set >= sim->sets || sim->set[set].role != SPH_ROLE_FLUID)
        return bad(sim, "set", "a number given by sph_add_fluid", set);
    return SPH_OK;
}

static __attribute__((noinline)) sph_status check_vector(sph_sim *sim, const char *what, const double *v)
{
    for (int k = 0; k < SPH_DIM; k++)
        if (!(sph_abs(v[k]) < 1e15))
            return bad(sim, what, "finite", v[k]);
    return SPH_OK;
}

sph_status sph_add_particle(sph_sim *sim, uint32_t set, const double *x, const double *v, double rho, uint32_t *id)
{
    sph_status st = begin_adding(sim, "sph_add_particle");
    if (st || (st = check_set(sim, set)) != SPH_OK)
        return st;
    if (!x)
        return bad(sim, "x", "a position", 0);
    if (v && (st = check_vector(sim, "velocity", v)) != SPH_OK)
        return st;
    double rho0 = sim->set[set].rho0;
    if (!(rho >= 0 && rho < 100 * rho0))
        return bad(sim, "rho", "0 (rest) or between 0 and 100 rho0", rho);
    double rel[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        rel[k] = x[k] - sim->cfg.lo[k];
    uint32_t before = sim->now.count;
    st = append(sim, set, rel, v, rho > 0 ? (rho - rho0) / rho0 : 0);
    if (!st && id)
        *id = before;
    return end_adding(sim, before, st);
}

/* a lattice must begin and end within a domain's length of the domain: its points are all looked at, one by one */
static __attribute__((noinline)) bool near_domain(const sph_sim *sim, int k, double lo, double hi)
{
    return lo >= sim->cfg.lo[k] - sim->grid.length[k] && hi <= sim->cfg.hi[k] + sim->grid.length[k];
}

/* calls append for the lattice points of a box for which inside() holds */
typedef bool (*inside_fn)(const void *shape, const double *x);
static sph_status fill(sph_sim *sim, const char *call, uint32_t set, const double *lo, const double *hi, const double *v,
                       inside_fn inside, const void *shape)
{
    sph_status st = begin_adding(sim, call);
    if (st || (st = check_set(sim, set)) != SPH_OK)
        return st;
    if ((v && (st = check_vector(sim, "velocity", v)) != SPH_OK) || (st = check_vector(sim, "lo", lo)) != SPH_OK ||
        (st = check_vector(sim, "hi", hi)) != SPH_OK)
        return st;
    double dx = sim->cfg.spacing;
    uint32_t n[3] = {1, 1, 1};
    for (int k = 0; k < SPH_DIM; k++) {
        if (!(hi[k] > lo[k]))
            return bad(sim, "hi", "> lo on every axis", hi[k]);
        if (!near_domain(sim, k, lo[k], hi[k]))
            return bad(sim, "hi", "a shape within a domain's length of the domain", hi[k]);
        if ((n[k] = intervals(hi[k] - lo[k], dx)) == 0)
            return bad(sim, "hi", "at most 2^30 spacings from lo", hi[k]);
    }
    uint32_t before = sim->now.count;
    for (uint32_t c = 0; !st && c < n[2]; c++)
        for (uint32_t b = 0; !st && b < n[1]; b++)
            for (uint32_t a = 0; !st && a < n[0]; a++) {
                const uint32_t i[3] = {a, b, c};
                double x[SPH_DIM], rel[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    x[k] = lo[k] + (i[k] + 0.5) * dx;
                    rel[k] = (lo[k] - sim->cfg.lo[k]) + (i[k] + 0.5) * dx;
                }
                if (!inside || inside(shape, x))
                    st = append(sim, set, rel, v, 0);
            }
    return end_adding(sim, before, st);
}

sph_status sph_add_box(sph_sim *sim, uint32_t set, const double *lo, const double *hi, const double *v)
{
    if (!lo || !hi)
        return bad(sim, "lo, hi", "the corners of a box", 0);
    return fill(sim, "sph_add_box", set, lo, hi, v, NULL, NULL);
}

#if SPH_WITH_SHAPES
typedef struct ring {
    double centre[SPH_DIM], inner2, outer2;
} ring;
static bool in_ring(const void *shape, const double *x)
{
    const ring *r = shape;
    double d2 = 0;
    for (int k = 0; k < SPH_DIM; k++)
        d2 += (x[k] - r->centre[k]) * (x[k] - r->centre[k]);
    return d2 >= r->inner2 && d2 < r->outer2;
}
sph_status sph_add_ring(sph_sim *sim, uint32_t set, const double *centre, double inner, double outer, const double *v)
{
    if (!sim || !centre)
        return bad(sim, "centre", "a position", 0);
    if (!(inner >= 0) || !(outer > inner) || !(outer < 1e15))
        return bad(sim, "outer", "finite and > inner >= 0", outer);
    ring r;
    double lo[SPH_DIM], hi[SPH_DIM];
    r.inner2 = inner * inner;
    r.outer2 = outer * outer;
    /* the centre falls on a lattice point's corner, so that the shape keeps its symmetries */
    double reach = round_up(outer / sim->cfg.spacing) * sim->cfg.spacing;
    for (int k = 0; k < SPH_DIM; k++) {
        r.centre[k] = centre[k];
        lo[k] = centre[k] - reach;
        hi[k] = centre[k] + reach;
    }
    return fill(sim, "sph_add_ring", set, lo, hi, v, in_ring, &r);
}

#if SPH_DIM == 2
typedef struct polygon {
    const double (*corner)[2];
    uint32_t n;
} polygon;
static bool in_polygon(const void *shape, const double *x)
{
    const polygon *p = shape;
    bool in = false;
    for (uint32_t i = 0, j = p->n - 1; i < p->n; j = i++) {
        const double *a = p->corner[i], *b = p->corner[j];
        if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) + a[0])
            in = !in;
    }
    return in;
}
sph_status sph_add_polygon(sph_sim *sim, uint32_t set, const double (*corner)[2], uint32_t n, const double *v)
{
    if (!corner || n < 3)
        return bad(sim, "corner", "at least three corners", n);
    double lo[2] = {corner[0][0], corner[0][1]}, hi[2] = {lo[0], lo[1]};
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) {
            if (!(sph_abs(corner[i][k]) < 1e15))
                return bad(sim, "corner", "finite", corner[i][k]);
            lo[k] = corner[i][k] < lo[k] ? corner[i][k] : lo[k];
            hi[k] = corner[i][k] > hi[k] ? corner[i][k] : hi[k];
        }
    polygon p = {corner, n};
    return fill(sim, "sph_add_polygon", set, lo, hi, v, in_polygon, &p);
}
#endif

#endif

#if SPH_WITH_FIELDS
sph_status sph_apply_field(sph_sim *sim, uint32_t set, sph_field_fn fn, void *ctx)
{
    sph_status st = idle(sim, "sph_apply_field");
    if (st || (st = check_set(sim, set)) != SPH_OK)
        return st;
    if (!fn)
        return bad(sim, "fn", "a function", 0);
    /* values wait in the buffer that is not in use until all were seen to be right */
    const sph_buffer *b = &sim->buf[sim->cur], *wait = &sim->buf[(sim->cur + 1) % sim->buffers];
    double rho0 = sim->set[set].rho0;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (b->set[0][i] != set)
            continue;
        double x[SPH_DIM], v[SPH_DIM], rho = rho0 * (1 + (double)b->rho[0][i]);
        for (int k = 0; k < SPH_DIM; k++) {
            x[k] = sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
            v[k] = (double)b->vel[k][i];
        }
        fn(ctx, x, v, &rho);
        if ((st = check_vector(sim, "field velocity", v)) != SPH_OK)
            return st;
        if (!(rho > 0 && rho < 100 * rho0))
            return bad(sim, "field density", "between 0 and 100 rho0", rho);
        for (int k = 0; k < SPH_DIM; k++)
            wait->vel[k][i] = (sph_real)v[k];
        wait->rho[0][i] = (sph_real)((rho - rho0) / rho0);
    }
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (b->set[0][i] != set)
            continue;
        for (int k = 0; k < SPH_DIM; k++)
            b->vel[k][i] = wait->vel[k][i];
        b->rho[0][i] = wait->rho[0][i];
    }
    sim->now.primed = false;
    return SPH_OK;
}

#endif

/* (1 + d)^7 - 1, exact for small d */
static __attribute__((noinline)) double seventh(double d)
{
    return d * (7 + d * (21 + d * (35 + d * (35 + d * (21 + d * (7 + d))))));
}

/* pressure at relative density excess d, and the excess at a pressure: the equations of state (Gray 2001 eq 2.25) */
double sph_pressure(const sph_sim *sim, const sph_set *s, double d)
{
    double p, b = (double)s->b_r;
    if (SPH_IS(sim->cfg.eos, LINEAR))
        p = b * d;
    else if (SPH_IS(sim->cfg.eos, ISOTHERMAL))
        p = b * (1 + d);
    else
        p = b * seventh(d);
    return sim->cfg.pressure_floor && p < 0 ? 0 : p;
}
double sph_density_of(const sph_sim *sim, const sph_set *s, double p)
{
    double y = p / (double)s->b_r;
    if (SPH_IS(sim->cfg.eos, LINEAR))
        return y;
    if (SPH_IS(sim->cfg.eos, ISOTHERMAL))
        return y - 1;
    if (y < -0.99)
        y = -0.99;
    /* (1 + y)^(1/7) - 1 by Newton; near the root each step squares the error, so the counts reach rounding from these
       guesses. Where y > 1 the guess is a power of two at most twice the root, and a step takes a seventh of it off. */
    double d = y * (1.0 / 7 - y * (3.0 / 49));
    int steps = sph_abs(y) < 0.1 ? 2 : 7;
    if (y > 1) {
        d = 1;
        for (double t = 1 + y; t > 128 && d < 1e30; t /= 128)
            d = 2 * d + 1;
        steps = 12;
    }
    for (int i = steps; i > 0; i--) {
        const double f = seventh(d) - y;
        double s2 = (1 + d) * (1 + d), s6 = s2 * s2 * s2;
        d -= f / (7 * s6);
    }
    return d;
}

#if SPH_WITH_FIELDS
sph_status sph_apply_hydrostatic(sph_sim *sim, uint32_t set, double surface)
{
    sph_status st = idle(sim, "sph_apply_hydrostatic");
    if (st || (st = check_set(sim, set)) != SPH_OK)
        return st;
    int axis = -1;
    for (int k = 0; k < SPH_DIM; k++)
        if (sim->cfg.gravity[k] != 0) {
            if (axis >= 0)
                return bad(sim, "gravity", "along one axis", sim->cfg.gravity[k]);
            axis = k;
        }
    if (axis < 0 || !(sph_abs(surface) < 1e15))
        return bad(sim, "surface", "finite, with gravity along one axis", surface);
    const sph_set *s = &sim->set[set];
    double g = sim->cfg.gravity[axis];
    const sph_buffer *b = &sim->buf[sim->cur], *wait = &sim->buf[(sim->cur + 1) % sim->buffers]; /* as sph_apply_field */
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->set[0][i] == set) {
            double x = sim->cfg.lo[axis] + (double)b->pos[axis][i] * sim->grid.quantum;
            double p = s->rho0 * g * (x - surface); /* g < 0: below the surface p > 0 */
            double d = sph_density_of(sim, s, p > 0 ? p : 0);
            if (!(d >= -1 && d < 99))
                return bad(sim, "surface", "a depth at which density stays below 100 rho0", surface);
            wait->rho[0][i] = (sph_real)d;
        }
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->set[0][i] == set)
            b->rho[0][i] = wait->rho[0][i];
    sim->now.primed = false;
    return SPH_OK;
}

#endif

#if SPH_HAS_WALLS
/* ---- walls ---- */

sph_wall sph_wall_default(void)
{
    sph_wall w;
    memset(&w, 0, sizeof w);
    w.kind = SPH_WALL_ADAMI;
    return w;
}

static bool layered(const sph_wall *w)
{
    return !SPH_HAS_FORCE_WALLS || SPH_IS(w->kind, WALL_GHOST) || SPH_IS(w->kind, WALL_ADAMI);
}

static double default_strength(const sph_sim *sim, uint32_t kind)
{
    double c2 = sim->cfg.sound_speed * sim->cfg.sound_speed;
    if (SPH_IS(kind, WALL_LENNARD_JONES))
        return c2 / 200; /* g H with Gray's c^2 = 200 g H */
    if (SPH_IS(kind, WALL_KERNEL_FORCE))
        return 0.01;
    return SPH_IS(kind, WALL_MONAGHAN_KOS) ? 0.01 * c2 / sim->cfg.spacing : 0;
}

static sph_status check_wall(sph_sim *sim, const sph_wall *w, const char *call)
{
    sph_status st = begin_adding(sim, call);
    if (st)
        return st;
    if (!w)
        return bad(sim, "wall", "a description of the wall", 0);
    if (w->kind >= SPH_WALLS)
        return bad(sim, "wall.kind", "one of SPH_WALL_LENNARD_JONES .. SPH_WALL_ADAMI", w->kind);
    if (!sph_in(SPH_WALLS_IN, w->kind))
        return bad(sim, "wall.kind", "a kind that was compiled in (modules.h)", w->kind);
    if (!SPH_WITH_MOVING_WALLS && w->motion)
        return bad(sim, "wall.motion", "null: moving walls were left out (modules.h)", 1);
    if (!(w->strength >= 0 && w->strength < 1e30))
        return bad(sim, "wall.strength", ">= 0", w->strength);
    if (w->layers > 64)
        return bad(sim, "wall.layers", "0 .. 64", w->layers);
    if (sim->groups == SPH_MAX_GROUPS)
        return sph_error(sim, SPH_TOO_MANY_SETS, "wall groups", "at most SPH_MAX_GROUPS", sim->groups, SPH_NO_PARTICLE);
    return SPH_OK;
}

/* how many sets, particles and which digest there were before a wall, to take it back whole */
typedef struct wall_mark {
    uint32_t sets, count;
    uint64_t hash;
} wall_mark;
static wall_mark mark_wall(const sph_sim *sim) { return (wall_mark){sim->sets, sim->now.count, sim->setup_hash}; }

static sph_status finish_wall(sph_sim *sim, const sph_wall *w, wall_mark m, sph_status st, uint32_t *group)
{
    if (!st && sim->now.count == m.count)
        st = bad(sim, "wall", "at least one particle on the chosen faces", 0);
    if (st) {
        sim->sets = m.sets;
        sim->setup_hash = m.hash;
        return end_adding(sim, m.count, st);
    }
    sim->has_adami |= w->kind == SPH_WALL_ADAMI;
    sim->has_force_wall |= !layered(w);
    sim->group[sim->groups] = (sph_group){w->motion, w->motion_ctx};
    memset(&sim->now.group[sim->groups], 0, sizeof sim->now.group[0]);
    sim->now.group[sim->groups].remove_at = 1e300;
    if (group)
        *group = sim->groups;
    sim->groups++;
    return end_adding(sim, m.count, SPH_OK);
}

/* a new set for one face or corner; origin, normal, tangent, half are from the caller */
static sph_set *new_wall_set(sph_sim *sim, const sph_wall *w, uint32_t *index)
{
    if (sim->sets == sim->cfg.max_sets) {
        sph_error(sim, SPH_TOO_MANY_SETS, "sets", "at most max_sets", sim->sets, SPH_NO_PARTICLE);
        return NULL;
    }
    *index = sim->sets++;
    sph_set *s = &sim->set[*index];
    memset(s, 0, sizeof *s);
    s->role = layered(w) ? SPH_ROLE_GHOST : SPH_ROLE_FORCE_WALL;
    s->kind = w->kind;
    s->group = sim->groups;
    s->compressible = w->compressible;
    s->no_slip = w->no_slip;
    s->rho0 = sim->cfg.rho0;
    s->c0 = sim->cfg.sound_speed;
    s->mass = s->rho0 * cell_volume(sim);
    s->strength = w->strength > 0 ? w->strength : default_strength(sim, w->kind);
    return s;
}

/* no further than a domain's length outside: nothing is found there, and integers stay small */
static __attribute__((noinline)) sph_pos bounded_quanta(const sph_sim *sim, int k, double x)
{
    const double far = sim->grid.length[k];
    return to_quanta(sim, x < -far ? -far : x > 2 * far ? 2 * far : x);
}

/* the box in quanta around the region behind a face */
static void bound_region(sph_sim *sim, sph_set *s)
{
    for (int k = 0; k < SPH_DIM; k++) {
        double reach[3] = {s->thick * sph_abs(s->normal[k]), 0, 0};
#if SPH_DIM == 2
        reach[1] = s->half[0] * sph_abs(s->normal[1 - k]);
#elif SPH_DIM == 3
        int a = (k + 1) % 3, b = (k + 2) % 3;
        double t2 = s->normal[a] * s->tangent[b] - s->normal[b] * s->tangent[a];
        reach[1] = s->half[0] * sph_abs(s->tangent[k]);
        reach[2] = s->half[1] * sph_abs(t2);
#endif
        double r = reach[0] + reach[1] + reach[2];
        s->low[k] = bounded_quanta(sim, k, s->origin[k] - r) - 1;
        s->high[k] = bounded_quanta(sim, k, s->origin[k] + r) + 1;
    }
}

static uint32_t wall_layers(const sph_sim *sim, const sph_wall *w)
{
    return w->layers ? w->layers : round_up(sim->grid.support / sim->cfg.spacing);
}

/* lattice of a box and its surroundings along one axis */
typedef struct axis_lattice {
    double lo, hi, dx, step; /* from the domain's low corner; step: spacing that divides the box evenly */
    int32_t n;
} axis_lattice;

/* centre of layer-lattice index i: inside the box on its own step, outside one spacing apart */
static double lattice_centre(const axis_lattice *a, int32_t i)
{
    if (i < 0)
        return a->lo + (i + 0.5) * a->dx;
    if (i >= a->n)
        return a->hi + (i - a->n + 0.5) * a->dx;
    return a->lo + (i + 0.5) * a->step;
}

typedef struct box_wall {
    const sph_wall *wall;
    axis_lattice ax[SPH_DIM];
    uint32_t faces;
    bool inside;
    int32_t layers;
    uint32_t set_of[27]; /* by code of sides, SPH_MAX_SETS: none yet */
} box_wall;

/* the set for the sides (-1, 0, 1 an axis); made when first needed */
static sph_status side_set(sph_sim *sim, box_wall *b, const int *side, uint32_t *set)
{
    uint32_t code = 0;
    int many = 0, first = -1;
    for (int k = 0; k < SPH_DIM; k++) {
        code = code * 3 + (uint32_t)(side[k] + 1);
        many += side[k] != 0;
        if (side[k] && first < 0)
            first = k;
    }
    *set = b->set_of[code];
    if (*set < SPH_MAX_SETS)
        return SPH_OK;
    sph_set *s = new_wall_set(sim, b->wall, set);
    if (!s)
        return SPH_TOO_MANY_SETS;
    b->set_of[code] = *set;
    double norm = 1 / __builtin_sqrt((double)many), shortest = 1e300;
    int t = 0;
    s->corner = many > 1;
    s->thick = b->layers * sim->cfg.spacing;
    for (int k = 0; k < SPH_DIM; k++) {
        const axis_lattice *a = &b->ax[k];
        s->origin[k] = side[k] < 0 ? a->lo : side[k] > 0 ? a->hi : 0.5 * (a->lo + a->hi);
        s->normal[k] = (b->inside ? -side[k] : side[k]) * norm;
        shortest = a->hi - a->lo < shortest ? a->hi - a->lo : shortest;
        /* a tank's face reaches behind its neighbours, so that corners are covered */
        if (!side[k] && t < 2)
            s->half[t++] = 0.5 * (a->hi - a->lo) + (b->inside ? s->thick : 0);
    }
    if (!b->inside && s->thick > 0.5 * shortest)
        s->thick = 0.5 * shortest;
#if SPH_DIM == 3
    /* half[0] belongs to the first axis in the plane; an edge's tangent is the edge */
    for (int k = 0; k < 3; k++)
        if (!side[k]) {
            s->tangent[k] = 1;
            break;
        }
    if (many == 3)
        s->tangent[0] = 1;
#else
    (void)first;
#endif
    bound_region(sim, s);
    finish_set(sim, s);
    return SPH_OK;
}

/* which sides of the box the layer point lies behind; false if it belongs to no chosen face */
static bool layer_sides(const box_wall *b, const int32_t *i, int *side)
{
    bool any = false;
    int32_t best = b->layers;
    int axis = -1, dir = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        bool low = b->faces & SPH_LOW((uint32_t)k), high = b->faces & SPH_HIGH((uint32_t)k);
        side[k] = 0;
        if (b->inside) {
            side[k] = i[k] < 0 ? -1 : i[k] >= b->ax[k].n ? 1 : 0;
            if ((side[k] < 0 && !low) || (side[k] > 0 && !high))
                return false;
            any |= side[k] != 0;
        } else { /* an obstacle's point belongs to its nearest chosen face */
            if (low && i[k] < best)
                best = i[k], axis = k, dir = -1;
            if (high && b->ax[k].n - 1 - i[k] < best)
                best = b->ax[k].n - 1 - i[k], axis = k, dir = 1;
        }
    }
    if (b->inside)
        return any;
    if (axis < 0)
        return false;
    side[axis] = dir;
    return true;
}

/* which chosen faces a node of the box's surface lies on */
static bool node_sides(const box_wall *b, const int32_t *i, int *side)
{
    bool any = false;
    for (int k = 0; k < SPH_DIM; k++) {
        side[k] = 0;
        if (i[k] == 0 && (b->faces & SPH_LOW((uint32_t)k)))
            side[k] = -1;
        else if (i[k] == b->ax[k].n && (b->faces & SPH_HIGH((uint32_t)k)))
            side[k] = 1;
        any |= side[k] != 0;
    }
    return any;
}

static sph_status box_point(sph_sim *sim, box_wall *b, const int32_t *i, bool layers)
{
    int side[SPH_DIM];
    double x[SPH_DIM];
    uint32_t set;
    if (!(layers ? layer_sides(b, i, side) : node_sides(b, i, side)))
        return SPH_OK;
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = layers ? lattice_centre(&b->ax[k], i[k]) : b->ax[k].lo + i[k] * b->ax[k].step;
    sph_status st = side_set(sim, b, side, &set);
    return st ? st : append(sim, set, x, NULL, 0);
}

sph_status sph_add_wall_box(sph_sim *sim, const sph_wall *wall, const double *lo, const double *hi, uint32_t faces,
                            bool inside, uint32_t *group)
{
    sph_status st = check_wall(sim, wall, "sph_add_wall_box");
    if (st)
        return st;
    if (!lo || !hi)
        return bad(sim, "lo, hi", "the corners of a box", 0);
    if (faces == 0 || faces >> (2 * SPH_DIM))
        return bad(sim, "faces", "an or of SPH_LOW(k), SPH_HIGH(k)", faces);
    box_wall b;
    memset(&b, 0, sizeof b);
    b.wall = wall;
    b.faces = faces;
    b.inside = inside;
    b.layers = (int32_t)wall_layers(sim, wall);
    for (int k = 0; k < 27; k++)
        b.set_of[k] = SPH_MAX_SETS;
    int32_t from[3] = {0, 0, 0}, to[3] = {1, 1, 1}, i[3] = {0, 0, 0};
    bool layers = layered(wall);
    for (int k = 0; k < SPH_DIM; k++) {
        if (!(hi[k] > lo[k]) || !(sph_abs(lo[k]) < 1e15) || !(sph_abs(hi[k]) < 1e15))
            return bad(sim, "hi", "finite and > lo on every axis", hi[k]);
        if (!near_domain(sim, k, lo[k], hi[k]))
            return bad(sim, "hi", "a box within a domain's length of the domain", hi[k]);
        axis_lattice *a = &b.ax[k];
        uint32_t n = intervals(hi[k] - lo[k], sim->cfg.spacing);
        if (n == 0 || n > 100000000u)
            return bad(sim, "hi", "at most 10^8 spacings from lo", hi[k]);
        *a = (axis_lattice){lo[k] - sim->cfg.lo[k], hi[k] - sim->cfg.lo[k], sim->cfg.spacing, (hi[k] - lo[k]) / n, (int32_t)n};
        from[k] = layers && inside ? -b.layers : 0;
        to[k] = a->n + (layers ? inside ? b.layers : 0 : 1);
    }
    wall_mark m = mark_wall(sim);
    for (i[2] = from[2]; !st && i[2] < to[2]; i[2]++)
        for (i[1] = from[1]; !st && i[1] < to[1]; i[1]++)
            for (i[0] = from[0]; !st && i[0] < to[0]; i[0]++)
                st = box_point(sim, &b, i, layers);
    return finish_wall(sim, wall, m, st, group);
}

#if SPH_DIM >= 2
/* rows or layers along up to two directions: origin + (s t1 len1) + (t t2 len2), behind the normal */
static sph_status flat_wall(sph_sim *sim, const sph_wall *wall, const double *origin, const double *normal,
                            const double (*dir)[SPH_DIM], const double *len, uint32_t *group)
{
    double dx = sim->cfg.spacing;
    uint32_t n[2] = {1, 1}, layers = layered(wall) ? wall_layers(sim, wall) : 1, set;
    double off = layered(wall) ? 0.5 : 0;
    wall_mark m = mark_wall(sim);
    sph_set *s = new_wall_set(sim, wall, &set);
    if (!s)
        return finish_wall(sim, wall, m, SPH_TOO_MANY_SETS, group);
    s->thick = wall_layers(sim, wall) * dx;
    for (int k = 0; k < SPH_DIM; k++) {
        s->normal[k] = normal[k];
        s->tangent[k] = SPH_DIM == 3 ? dir[0][k] : 0;
        s->origin[k] = origin[k] - sim->cfg.lo[k];
        for (int t = 0; t < SPH_DIM - 1; t++)
            s->origin[k] += 0.5 * len[t] * dir[t][k];
    }
    for (int t = 0; t < SPH_DIM - 1; t++) {
        s->half[t] = 0.5 * len[t];
        n[t] = intervals(len[t], dx) + (layered(wall) ? 0 : 1);
        if (n[t] > 100000000u)
            return finish_wall(sim, wall, m, bad(sim, "wall", "at most 10^8 spacings long", len[t]), group);
    }
    bound_region(sim, s);
    finish_set(sim, s);
    sph_status st = SPH_OK;
    for (uint32_t l = 0; !st && l < layers; l++)
        for (uint32_t b = 0; !st && b < n[1]; b++)
            for (uint32_t a = 0; !st && a < n[0]; a++) {
                const uint32_t i[2] = {a, b};
                double x[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    x[k] = origin[k] - sim->cfg.lo[k] - normal[k] * (l + off) * dx * (layered(wall) ? 1 : 0);
                    for (int t = 0; t < SPH_DIM - 1; t++)
                        x[k] += dir[t][k] * (i[t] + off) * (len[t] / (layered(wall) ? n[t] : n[t] - 1));
                }
                st = append(sim, set, x, NULL, 0);
            }
    return finish_wall(sim, wall, m, st, group);
}
#endif

#if SPH_DIM == 2
sph_status sph_add_wall_segment(sph_sim *sim, const sph_wall *wall, const double *a, const double *b, uint32_t *group)
{
    sph_status st = check_wall(sim, wall, "sph_add_wall_segment");
    if (st)
        return st;
    if (!a || !b)
        return bad(sim, "a, b", "two points", 0);
    if ((st = check_vector(sim, "a", a)) != SPH_OK || (st = check_vector(sim, "b", b)) != SPH_OK)
        return st;
    double d[1][2] = {{b[0] - a[0], b[1] - a[1]}};
    double len[1] = {__builtin_sqrt(d[0][0] * d[0][0] + d[0][1] * d[0][1])};
    if (!(len[0] > 0.5 * sim->cfg.spacing))
        return bad(sim, "b", "at least half a spacing from a", len[0]);
    d[0][0] /= len[0];
    d[0][1] /= len[0];
    const double normal[2] = {-d[0][1], d[0][0]};
    return flat_wall(sim, wall, a, normal, (const double(*)[2])d, len, group);
}
#endif

#if SPH_DIM == 3
sph_status sph_add_wall_plane(sph_sim *sim, const sph_wall *wall, const double *origin, const double *e1,
                              const double *e2, uint32_t *group)
{
    sph_status st = check_wall(sim, wall, "sph_add_wall_plane");
    if (st)
        return st;
    if (!origin || !e1 || !e2)
        return bad(sim, "origin, e1, e2", "three vectors", 0);
    double d[2][3], len[2] = {0, 0}, normal[3], nn = 0;
    for (int k = 0; k < 3; k++) {
        len[0] += e1[k] * e1[k];
        len[1] += e2[k] * e2[k];
    }
    len[0] = __builtin_sqrt(len[0]);
    len[1] = __builtin_sqrt(len[1]);
    if (!(len[0] > 0.5 * sim->cfg.spacing && len[1] > 0.5 * sim->cfg.spacing && len[0] < 1e15 && len[1] < 1e15))
        return bad(sim, "e1, e2", "at least half a spacing long, and finite", len[0]);
    for (int k = 0; k < 3; k++) {
        d[0][k] = e1[k] / len[0];
        d[1][k] = e2[k] / len[1];
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        normal[k] = d[0][a] * d[1][b] - d[0][b] * d[1][a];
        nn += normal[k] * normal[k];
    }
    if (!(nn > 0.999))
        return bad(sim, "e2", "at right angles to e1", nn);
    return flat_wall(sim, wall, origin, normal, (const double(*)[3])d, len, group);
}
#endif

#endif

#if SPH_WITH_MOVING_WALLS
sph_status sph_remove_wall_at(sph_sim *sim, uint32_t group, double t)
{
    sph_status st = idle(sim, "sph_remove_wall");
    if (st)
        return st;
    if (group >= sim->groups)
        return bad(sim, "group", "a number given by a wall function", group);
    if (!(t == t))
        return bad(sim, "t", "a time", t);
    sim->now.group[group].remove_at = t;
    if (t <= sim->now.time)
        sim->now.primed = false; /* forces must be made anew without the wall */
    return SPH_OK;
}
sph_status sph_remove_wall(sph_sim *sim, uint32_t group)
{
    return sph_remove_wall_at(sim, group, sim ? sim->now.time : 0);
}

void sph_motion_table(void *ctx, double t, double *displacement, double *velocity)
{
    const sph_table *m = ctx;
    uint32_t i = 0;
    double x, v = 0;
    for (int k = 0; k < SPH_DIM; k++)
        displacement[k] = velocity[k] = 0;
    if (!m || !m->rows || !m->t || !m->x || m->axis >= SPH_DIM)
        return;
    while (i + 1 < m->rows && m->t[i + 1] <= t)
        i++;
    if (t < m->t[0]) {
        x = m->x[0];
    } else if (i + 1 >= m->rows) {
        x = m->x[m->rows - 1];
    } else {
        v = (m->x[i + 1] - m->x[i]) / (m->t[i + 1] - m->t[i]);
        x = m->x[i] + v * (t - m->t[i]);
    }
    displacement[m->axis] = x - m->x[0];
    velocity[m->axis] = v;
}
#endif
