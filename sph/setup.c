/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* setup.c: what all of set-up shares: when it is allowed, sets and groups, particles, boxes of them. Runs between steps
   only. */
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(setup)

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
                       (uint64_t)s->eos << 24 | (uint64_t)s->compressible << 32 | (uint64_t)s->no_slip << 33 |
                       (uint64_t)s->corner << 34);
    const double v[] = {s->mass, s->rho0, s->c0, s->strength, s->thick, s->half[0], s->half[1]};
    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        h = sph_mix_double(h, v[i]);
    for (int k = 0; k < SPH_DIM; k++)
        h = sph_mix_double(sph_mix_double(h, s->origin[k]), s->normal[k]);
    sim->setup_hash = s->side ? sph_mix(h, s->side) : h;
}

uint32_t sph_setup_add_group(sph_sim *sim, sph_motion motion, void *ctx)
{
    sph_group_state *const s = &sim->now.group[sim->groups];
    sim->group[sim->groups] = (sph_group){motion, ctx};
    memset(s, 0, sizeof *s);
    s->remove_at = 1e300;
    for (int k = 0; k < SPH_DIM; k++)
        s->lag[0][k] = s->lag[1][k] = SPH_NO_LAG;
    return sim->groups++;
}

double sph_setup_cell_volume(const sph_sim *sim)
{
    double v = 1;
    for (int k = 0; k < SPH_DIM; k++)
        v *= sim->cfg.spacing;
    return v;
}

/* ---- particles ---- */

/* x (m, from the domain's low corner) in quanta; the caller has checked the range */
sph_pos sph_setup_to_quanta(const sph_sim *sim, double x)
{
    double q = x / sim->grid.quantum;
    return (sph_pos)(q < 0 ? q - 0.5 : q + 0.5);
}

#define MOST_UNPLACED 16777216u /* no more are counted */
static sph_status too_many(sph_sim *sim, uint32_t more)
{
    return sph_error(sim, SPH_TOO_MANY_PARTICLES, "max_particles", "at least as many as the value says",
                     sim->now.count + more, SPH_NO_PARTICLE);
}

/* appends one particle; x from the domain's low corner */
sph_status sph_setup_append(sph_sim *sim, uint32_t set, const double *x, const double *v, double d)
{
    uint32_t n = sim->now.count;
    for (int k = 0; k < SPH_DIM; k++)
        if (!(x[k] >= 0 && x[k] < sim->grid.length[k]))
            return sph_setup_bad(sim, "position", "inside the domain, walls included", x[k] + sim->cfg.lo[k]);
    if (!SPH_WITH_DETAILS && n == sim->cfg.max_particles)
        return too_many(sim, 1);
    if (n == sim->cfg.max_particles) /* the addition will be refused, with how many it needs */
        return ++sim->unplaced < MOST_UNPLACED ? SPH_OK : SPH_TOO_MANY_PARTICLES;
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
    if (b->rise[0])
        b->rise[0][n] = 0;
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
    if (sim->now.primed) /* the arrays are ordered by cell and no longer by id */
        return sph_error(sim, SPH_BAD_STATE, call, "before sph_ready", 0, SPH_NO_PARTICLE);
    return SPH_OK;
}

sph_status sph_setup_end_adding(sph_sim *sim, uint32_t before, sph_status st)
{
    if (SPH_WITH_DETAILS && sim->unplaced && (!st || st == SPH_TOO_MANY_PARTICLES))
        st = too_many(sim, sim->unplaced);
    if (SPH_WITH_DETAILS)
        sim->unplaced = 0;
    if (st)
        sim->now.count = before;
    sim->now.primed = false;
    sim->table_valid = false;
    if (sim->now.count > sim->mark_particles)
        sim->mark_particles = sim->now.count;
    return st;
}

sph_status sph_setup_check_body(sph_sim *sim, uint32_t set)
{
    if (set >= sim->sets || !sph_is_matter(&sim->set[set]))
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
    if (st || (st = sph_setup_check_body(sim, set)) != SPH_OK)
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
    st = sph_setup_end_adding(sim, before, st);
    if (!st && id)
        *id = before;
    return st;
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
    if (st || (st = sph_setup_check_body(sim, set)) != SPH_OK)
        return st;
    if ((v && (st = sph_setup_check_vector(sim, "velocity", v)) != SPH_OK) ||
        (st = sph_setup_check_vector(sim, "lo", lo)) != SPH_OK ||
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
    if (SPH_WITH_SHAPES && !st && inside && sim->now.count + (SPH_WITH_DETAILS ? sim->unplaced : 0) == before)
        st = sph_setup_bad(sim, "shape", "one that holds the centre of at least one particle", 0);
    return sph_setup_end_adding(sim, before, st);
}

sph_status sph_add_box(sph_sim *sim, uint32_t set, const double *lo, const double *hi, const double *v)
{
    if (!lo || !hi)
        return sph_setup_bad(sim, "lo, hi", "the corners of a box", 0);
    return sph_setup_fill(sim, "sph_add_box", set, lo, hi, NULL, v, NULL, NULL);
}
