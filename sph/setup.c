/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* setup.c: sets, particles, boxes of them, initial fields, the equations of state in double. Runs between steps only. */
#include "dmath.h"
#include "setup.h"

sph_status sph_setup_bad(sph_sim *sim, const char *what, const char *allowed, double value)
{
    return sph_error(sim, SPH_BAD_ARGUMENT, what, allowed, value, SPH_NO_PARTICLE);
}

/* everything of set-up needs a simulation that is not in the middle of a step */
sph_status sph_setup_idle(sph_sim *sim, const char *call)
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
    return sph_setup_bad(sim, what, most > 1e20f ? "0 or 1e-30 .. 1e30" : "0 or 1e-15 .. 1e15", v);
}

#if SPH_HAS_WALLS || SPH_WITH_SHAPES
uint32_t sph_setup_round_up(double x) { return x <= 0 ? 0 : x >= 4e9 ? 4000000000u : (uint32_t)(x + 0.999999); }
#endif

/* number of lattice intervals in a length, at least one; 0 if there are absurdly many */
uint32_t sph_setup_intervals(double length, double dx)
{
    double n = length / dx + 0.5;
    return n < 1 ? 1 : n < 1073741824.0 ? (uint32_t)n : 0;
}

/* ---- sets ---- */

void sph_setup_finish_set(sph_sim *sim, sph_set *s)
{
    double scale = s->c0 * s->c0 * s->rho0;
    if (SPH_IS(s->eos, TAIT))
        scale /= 7;
    s->mass_r = (sph_real)s->mass;
    s->rho0_r = (sph_real)s->rho0;
    s->inv_rho0_r = (sph_real)(1 / s->rho0);
    s->b_r = (sph_real)scale;
    uint64_t h = sim->setup_hash;
    h = sph_mix(h, (uint64_t)s->role | (uint64_t)s->kind << 8 | (uint64_t)s->group << 16 |
                       (uint64_t)s->eos << 24 | (uint64_t)s->compressible << 32 | (uint64_t)s->no_slip << 33 | (uint64_t)s->corner << 34);
    const double v[] = {s->mass, s->rho0, s->c0, s->strength, s->thick, s->half[0], s->half[1]};
    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        h = sph_mix_double(h, v[i]);
    for (int k = 0; k < SPH_DIM; k++)
        h = sph_mix_double(sph_mix_double(h, s->origin[k]), s->normal[k]);
    sim->setup_hash = h;
}

double sph_setup_cell_volume(const sph_sim *sim)
{
    double v = 1;
    for (int k = 0; k < SPH_DIM; k++)
        v *= sim->cfg.spacing;
    return v;
}

/* begins a set of fluid or solid: what both have; *out is the place for the rest, or stays null */
static sph_status begin_body(sph_sim *sim, bool solid, const sph_fluid *f, uint32_t *set, sph_set **out)
{
    const char *const call = solid ? "sph_add_solid" : "sph_add_fluid";
    sph_status st = sph_setup_idle(sim, call);
    if (st)
        return st;
    if (!set)
        return sph_setup_bad(sim, "set", "a place for the set's number", 0);
    if ((st = check_positive(sim, solid ? "solid.mass" : "fluid.mass", f->mass, 1e30f)) != SPH_OK ||
        (st = check_positive(sim, solid ? "solid.rho0" : "fluid.rho0", f->rho0, 1e30f)) != SPH_OK ||
        (st = check_positive(sim, solid ? "solid.sound_speed" : "fluid.sound_speed", f->sound_speed, 1e15f)) != SPH_OK)
        return st;
    if (f->own_eos && (!SPH_WITH_SOLID || !sph_in(SPH_EOSES_IN, f->eos)))
        return sph_setup_bad(sim, "eos", "one of SPH_TAIT .. SPH_ISOTHERMAL, compiled in (modules.h)", f->eos);
    if (sim->sets == sim->cfg.max_sets)
        return sph_error(sim, SPH_TOO_MANY_SETS, "sets", "at most max_sets", sim->sets, SPH_NO_PARTICLE);
    sph_set *s = &sim->set[sim->sets];
    memset(s, 0, sizeof *s);
    s->group = SPH_MAX_GROUPS;
    s->eos = (uint8_t)(SPH_WITH_SOLID && f->own_eos ? f->eos : sim->cfg.eos);
    s->rho0 = f->rho0 > 0 ? f->rho0 : sim->cfg.rho0;
    s->c0 = f->sound_speed > 0 ? f->sound_speed : sim->cfg.sound_speed;
    s->mass = f->mass > 0 ? f->mass : s->rho0 * sph_setup_cell_volume(sim);
    *out = s;
    return SPH_OK;
}

sph_status sph_add_fluid(sph_sim *sim, const sph_fluid *f, uint32_t *set)
{
    static const sph_fluid usual = {0, 0, 0, false, 0};
    sph_set *s = NULL;
    const sph_status st = begin_body(sim, false, f ? f : &usual, set, &s);
    if (!s)
        return st;
    s->role = SPH_ROLE_FLUID;
    sph_setup_finish_set(sim, s);
    *set = sim->sets++;
    return SPH_OK;
}

#if SPH_WITH_SOLID
/* what sph_add_solid asks of a material beyond a fluid's */
static sph_status check_solid(sph_sim *sim, const sph_solid *m)
{
    const struct {
        const char *what;
        double v;
    } real[] = {{"shear", m->shear},           {"yield", m->yield}, {"hardening", m->hardening}, {"crack_speed", m->crack_speed},
                {"flaw_radius", m->flaw_radius}};
    if (!sph_has_solids(&sim->cfg))
        return sph_setup_bad(sim, "solid", "a configuration with a solid form", sim->cfg.solid);
    for (size_t i = 0; i < sizeof real / sizeof *real; i++)
        if (!(real[i].v >= 0 && real[i].v < 1e30))
            return sph_setup_bad(sim, real[i].what, "0 .. 1e30", real[i].v);
    if (m->yield > 0 && (!sph_yields(&sim->cfg) || !(m->shear > 0)))
        return sph_setup_bad(sim, "yield", "0, or a configuration with yield and shear > 0", m->yield);
    if (sph_damages(&sim->cfg) && !(m->shear > 0))
        return sph_setup_bad(sim, "shear", "> 0 with damage", m->shear);
    if (m->body > 255)
        return sph_setup_bad(sim, "body", "0 .. 255", m->body);
    if (m->held >> SPH_DIM || (m->held && !SPH_HAS_HELD))
        return sph_setup_bad(sim, "held", SPH_HAS_HELD ? "bits of axes" : "0: held sets were left out (modules.h)", m->held);
    if (m->motion && !m->held)
        return sph_setup_bad(sim, "motion", "null, or held along an axis", 1);
    if (m->held && sim->groups == SPH_MAX_GROUPS)
        return sph_error(sim, SPH_TOO_MANY_SETS, "wall groups and held sets", "at most SPH_MAX_GROUPS", sim->groups, SPH_NO_PARTICLE);
    return SPH_OK;
}

sph_status sph_add_solid(sph_sim *sim, const sph_solid *m, uint32_t *set, uint32_t *group)
{
    sph_set *s = NULL;
    if (!sim || !m)
        return sph_setup_bad(sim, "solid", "a material", 0);
    const sph_fluid as_fluid = {m->mass, m->rho0, m->sound_speed, true, SPH_LINEAR};
    sph_status st = begin_body(sim, true, &as_fluid, set, &s);
    if (!s || (st = check_solid(sim, m)) != SPH_OK)
        return st;
    s->role = SPH_ROLE_SOLID;
    sph_material *rock = &sim->material[sim->sets];
    *rock = (sph_material){m->shear, m->yield, m->hardening, 0, (sph_real)m->shear, m->body, m->held};
    const double volume = s->mass / s->rho0;
    double radius = m->flaw_radius; /* of the disc or ball with the particle's volume */
    if (!(radius > 0))
        radius = SPH_DIM == 3 ? sph_pow(volume * 3 / (4 * 3.14159265358979323846), 1.0 / 3) : __builtin_sqrt(volume / 3.14159265358979323846);
    rock->crack_rate = (m->crack_speed > 0 ? m->crack_speed : 0.4 * s->c0) / radius;
    if (m->held) {
        s->group = sim->groups;
        sim->group[sim->groups] = (sph_group){m->motion, m->motion_ctx};
        memset(&sim->now.group[sim->groups], 0, sizeof sim->now.group[0]);
        sim->now.group[sim->groups].remove_at = 1e300;
        if (group)
            *group = sim->groups;
        sim->groups++;
    } else if (group)
        *group = SPH_MAX_GROUPS;
    sim->setup_hash = sph_mix(sim->setup_hash, (uint64_t)m->body | (uint64_t)m->held << 8);
    const double v[] = {rock->shear, rock->yield, rock->hardening, rock->crack_rate};
    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        sim->setup_hash = sph_mix_double(sim->setup_hash, v[i]);
    sph_setup_finish_set(sim, s);
    *set = sim->sets++;
    return SPH_OK;
}
#endif

/* ---- particles ---- */

/* x (m, from the domain's low corner) in quanta; the caller has checked the range */
sph_pos sph_setup_to_quanta(const sph_sim *sim, double x)
{
    double q = x / sim->grid.quantum;
    return (sph_pos)(q < 0 ? q - 0.5 : q + 0.5);
}

/* appends one particle; x from the domain's low corner */
sph_status sph_setup_append(sph_sim *sim, uint32_t set, const double *x, const double *v, double d)
{
    uint32_t n = sim->now.count;
    if (n == sim->cfg.max_particles)
        return sph_error(sim, SPH_TOO_MANY_PARTICLES, "max_particles", "more than were asked for", n, SPH_NO_PARTICLE);
    for (int k = 0; k < SPH_DIM; k++)
        if (!(x[k] >= 0 && x[k] < sim->grid.length[k]))
            return sph_setup_bad(sim, "position", "inside the domain, walls included", x[k] + sim->cfg.lo[k]);
    sph_buffer *b = &sim->buf[sim->cur];
    for (int k = 0; k < SPH_DIM; k++) {
        b->pos[k][n] = sph_setup_to_quanta(sim, x[k]);
        if (b->pos[k][n] >= sim->grid.extent[k])
            b->pos[k][n] = sim->grid.extent[k] - 1;
        b->vel[k][n] = (sph_real)(v ? v[k] : 0);
        b->acc[k][n] = 0;
        if (b->xsph[k])
            b->xsph[k][n] = 0;
        if (SPH_HAS_TOTAL && b->shift[k])
            b->shift[k][n] = 0;
    }
    for (int k = 0; k < SPH_NS && sph_has_solids(&sim->cfg); k++)
        b->stress[k][n] = b->dstress[k][n] = 0;
    if (SPH_HAS_YIELD && b->plastic[0])
        b->plastic[0][n] = 0;
    if (SPH_HAS_DAMAGE && b->damage[0])
        b->damage[0][n] = 0;
    b->rho[0][n] = (sph_real)d;
    b->drho[0][n] = 0;
    b->id[0][n] = n;
    b->set[0][n] = (uint8_t)set;
    sim->now.count = n + 1;
    return SPH_OK;
}

/* begins an addition: particles are appended in order of id, so removals must have been few or none */
sph_status sph_setup_begin_adding(sph_sim *sim, const char *call)
{
    sph_status st = sph_setup_idle(sim, call);
    if (st)
        return st;
    if (sim->now.step > 0 || sim->now.left > 0)
        return sph_error(sim, SPH_BAD_STATE, call, "before the first step", (double)sim->now.step, SPH_NO_PARTICLE);
    if (sim->now.primed) { /* the arrays were ordered by cell: put them back in order of id */
        return sph_error(sim, SPH_BAD_STATE, call, "before sph_ready", 0, SPH_NO_PARTICLE);
    }
    return SPH_OK;
}

sph_status sph_setup_end_adding(sph_sim *sim, uint32_t before, sph_status st)
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
    if (set >= sim->sets || !sph_is_body(&sim->set[set]))
        return sph_setup_bad(sim, "set", "a number given by sph_add_fluid or sph_add_solid", set);
    return SPH_OK;
}

sph_status sph_setup_check_vector(sph_sim *sim, const char *what, const double *v)
{
    for (int k = 0; k < SPH_DIM; k++)
        if (!(sph_abs(v[k]) < 1e15))
            return sph_setup_bad(sim, what, "finite", v[k]);
    return SPH_OK;
}

sph_status sph_add_particle(sph_sim *sim, uint32_t set, const double *x, const double *v, double rho, uint32_t *id)
{
    sph_status st = sph_setup_begin_adding(sim, "sph_add_particle");
    if (st || (st = check_set(sim, set)) != SPH_OK)
        return st;
    if (!x)
        return sph_setup_bad(sim, "x", "a position", 0);
    if (v && (st = sph_setup_check_vector(sim, "velocity", v)) != SPH_OK)
        return st;
    double rho0 = sim->set[set].rho0;
    if (!(rho >= 0 && rho < 100 * rho0))
        return sph_setup_bad(sim, "rho", "0 (rest) or between 0 and 100 rho0", rho);
    double rel[SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        rel[k] = x[k] - sim->cfg.lo[k];
    uint32_t before = sim->now.count;
    st = sph_setup_append(sim, set, rel, v, rho > 0 ? (rho - rho0) / rho0 : 0);
    if (!st && id)
        *id = before;
    return sph_setup_end_adding(sim, before, st);
}

/* a lattice must begin and end within a domain's length of the domain: its points are all looked at, one by one */
bool sph_setup_near_domain(const sph_sim *sim, int k, double lo, double hi)
{
    return lo >= sim->cfg.lo[k] - sim->grid.length[k] && hi <= sim->cfg.hi[k] + sim->grid.length[k];
}

/* appends the lattice points of a box for which inside() holds; rows null: none is shifted */
sph_status sph_setup_fill(sph_sim *sim, const char *call, uint32_t set, const double *lo, const double *hi,
                          const sph_rows *rows, const double *v, sph_inside inside, const void *shape)
{
    sph_status st = sph_setup_begin_adding(sim, call);
    if (st || (st = check_set(sim, set)) != SPH_OK)
        return st;
    if ((v && (st = sph_setup_check_vector(sim, "velocity", v)) != SPH_OK) || (st = sph_setup_check_vector(sim, "lo", lo)) != SPH_OK ||
        (st = sph_setup_check_vector(sim, "hi", hi)) != SPH_OK)
        return st;
    double dx = sim->cfg.spacing;
    uint32_t n[3] = {1, 1, 1};
    for (int k = 0; k < SPH_DIM; k++) {
        if (!(hi[k] > lo[k]))
            return sph_setup_bad(sim, "hi", "> lo on every axis", hi[k]);
        if (!sph_setup_near_domain(sim, k, lo[k], hi[k]))
            return sph_setup_bad(sim, "hi", "a shape within a domain's length of the domain", hi[k]);
        if ((n[k] = sph_setup_intervals(hi[k] - lo[k], dx)) == 0)
            return sph_setup_bad(sim, "hi", "at most 2^30 spacings from lo", hi[k]);
    }
    if (SPH_WITH_SHAPES && rows)
        n[rows->axis]++; /* a row that was shifted down may hold one more */
    uint32_t before = sim->now.count;
    for (uint32_t c = 0; !st && c < n[2]; c++)
        for (uint32_t b = 0; !st && b < n[1]; b++)
            for (uint32_t a = 0; !st && a < n[0]; a++) {
                const uint32_t i[3] = {a, b, c};
                double x[SPH_DIM], rel[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    double off = 0.5;
                    if (SPH_WITH_SHAPES && rows && (uint32_t)k == rows->axis)
                        off = rows->offset[(a + b + c - i[k]) & 1];
                    x[k] = lo[k] + (i[k] + off) * dx;
                    rel[k] = (lo[k] - sim->cfg.lo[k]) + (i[k] + off) * dx;
                }
                if (!SPH_WITH_SHAPES || !inside || inside(shape, x))
                    st = sph_setup_append(sim, set, rel, v, 0);
            }
    return sph_setup_end_adding(sim, before, st);
}

sph_status sph_add_box(sph_sim *sim, uint32_t set, const double *lo, const double *hi, const double *v)
{
    if (!lo || !hi)
        return sph_setup_bad(sim, "lo, hi", "the corners of a box", 0);
    return sph_setup_fill(sim, "sph_add_box", set, lo, hi, NULL, v, NULL, NULL);
}

#if SPH_WITH_FIELDS
sph_status sph_apply_field(sph_sim *sim, uint32_t set, sph_field_fn fn, void *ctx)
{
    sph_status st = sph_setup_idle(sim, "sph_apply_field");
    if (st || (st = check_set(sim, set)) != SPH_OK)
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
            v[k] = (double)b->vel[k][i];
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
    if (SPH_IS(s->eos, LINEAR))
        p = b * d;
    else if (SPH_IS(s->eos, ISOTHERMAL))
        p = b * (1 + d);
    else
        p = b * seventh(d);
    return sim->cfg.pressure_floor && p < 0 && !sph_is_solid(s) ? 0 : p;
}
double sph_density_of(const sph_sim *sim, const sph_set *s, double p)
{
    double y = p / (double)s->b_r;
    (void)sim;
    if (SPH_IS(s->eos, LINEAR))
        return y;
    if (SPH_IS(s->eos, ISOTHERMAL))
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
    sph_status st = sph_setup_idle(sim, "sph_apply_hydrostatic");
    if (st || (st = check_set(sim, set)) != SPH_OK)
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
    double g = sim->cfg.gravity[axis];
    const sph_buffer *b = &sim->buf[sim->cur], *wait = &sim->buf[(sim->cur + 1) % sim->buffers]; /* as sph_apply_field */
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

#endif
