/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* books.c: what a host reads between steps: particles, totals, probes, wave gauges. Adds no array; sums run in index
   order in double precision, so they are the same on every machine. */
#include "internal.h"
#include "kernels.h"
#include "solid.h"

uint32_t sph_count(const sph_sim *sim) { return sim ? sim->now.count : 0; }

static void position(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *x)
{
    for (int k = 0; k < SPH_DIM; k++)
        x[k] = sim->cfg.lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
}

#if SPH_WITH_TOTALS || SPH_WITH_PROBES
static bool is_fluid(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    uint8_t s = b->set[0][i];
    return s != SPH_DEAD && sph_is_body(&sim->set[s]);
}
#endif

sph_status sph_get(const sph_sim *sim, uint32_t i, sph_particle *out)
{
    if (!sim || i >= sim->now.count || !out)
        return SPH_BAD_ARGUMENT;
    const sph_buffer *b = &sim->buf[sim->cur];
    memset(out, 0, sizeof *out);
    out->id = b->id[0][i];
    out->set = b->set[0][i];
    position(sim, b, i, out->x);
    for (int k = 0; k < SPH_DIM; k++) {
        out->v[k] = (double)b->vel[k][i];
        out->a[k] = (double)b->acc[k][i];
    }
    if (out->set == SPH_DEAD)
        return SPH_OK;
    const sph_set *s = &sim->set[out->set];
    out->role = s->role;
    out->mass = s->mass;
    out->rho = s->rho0 * (1 + (double)b->rho[0][i]);
    out->p = sph_pressure(sim, s, (double)b->rho[0][i]);
#if SPH_WITH_SOLID
    for (int k = 0; k < 3; k++)
        out->stress[k] = -out->p;
    if (sph_is_solid(s)) {
        out->damage = sph_stress_of(sim, b, i, out->stress);
        out->plastic = SPH_HAS_YIELD && b->plastic[0] ? (double)b->plastic[0][i] : 0;
    }
#endif
    if (!sph_is_body(s))
        for (int k = 0; k < SPH_DIM; k++)
            out->v[k] = sim->now.group[s->group].vel[k];
    return SPH_OK;
}

#if SPH_WITH_TOTALS
/* energy of compression from rho0, J/kg: integral of p/rho^2 d rho */
static double compression_energy(const sph_sim *sim, const sph_set *s, double d)
{
    double b = (double)s->b_r / s->rho0, r = 1 + d;
    (void)sim;
    switch (s->eos) {
    /* c^2 (ln s + 1/s - 1) and c^2 ln s; by series near rest, where they cancel */
    case SPH_LINEAR: return b * d * d * (0.5 - d * (2.0 / 3 - d * (0.75 - 0.8 * d)));
    case SPH_ISOTHERMAL: return b * d * (1 - d * (0.5 - d * (1.0 / 3 - 0.25 * d)));
    default: return b * (r * r * r * r * r * r / 6 + 1 / r - 7.0 / 6);
    }
}

static void add_particle_totals(const sph_sim *sim, const sph_buffer *b, uint32_t i, sph_totals *o)
{
    const sph_set *s = &sim->set[b->set[0][i]];
    double x[3] = {0, 0, 0}, v[3] = {0, 0, 0}, v2 = 0, m = s->mass, rho = s->rho0 * (1 + (double)b->rho[0][i]);
    position(sim, b, i, x);
    for (int k = 0; k < SPH_DIM; k++) {
        v[k] = (double)b->vel[k][i];
        v2 += v[k] * v[k];
        o->momentum[k] += m * v[k];
        o->potential -= m * sim->cfg.gravity[k] * x[k];
    }
    o->angular[0] += m * (x[1] * v[2] - x[2] * v[1]);
    o->angular[1] += m * (x[2] * v[0] - x[0] * v[2]);
    o->angular[2] += m * (x[0] * v[1] - x[1] * v[0]);
    o->mass += m;
    o->kinetic += 0.5 * m * v2;
    o->internal += m * compression_energy(sim, s, (double)b->rho[0][i]);
#if SPH_WITH_SOLID
    if (sph_is_solid(s)) {
        const sph_material *rock = sph_material_of(sim, s);
        double sigma[6], w = 0, p, ep = SPH_HAS_YIELD && b->plastic[0] ? (double)b->plastic[0][i] : 0;
        const double whole = 1 - sph_stress_of(sim, b, i, sigma);
        p = (sigma[0] + sigma[1] + sigma[2]) / 3;
        for (int k = 0; k < 6; k++)
            w += (k < 3 ? (sigma[k] - p) * (sigma[k] - p) : 2 * sigma[k] * sigma[k]);
        if (rock->shear > 0 && whole > 0)
            o->elastic += m / s->rho0 * w / (4 * rock->shear * whole); /* (1 - D) S:S/(4 mu) */
        o->plastic_work += m / s->rho0 * ep * (rock->yield + 0.5 * rock->hardening * ep);
        o->solid++;
    }
#endif
    o->max_speed = v2 > o->max_speed ? v2 : o->max_speed;
    o->min_density = rho < o->min_density || o->mass <= m ? rho : o->min_density; /* the first so far has mass m */
    o->max_density = rho > o->max_density ? rho : o->max_density;
    o->fluid += s->role == SPH_ROLE_FLUID;
}

void sph_get_totals(const sph_sim *sim, sph_totals *out)
{
    if (!sim || !out)
        return;
    const sph_buffer *b = &sim->buf[sim->cur];
    memset(out, 0, sizeof *out);
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (is_fluid(sim, b, i))
            add_particle_totals(sim, b, i, out);
        else
            out->wall += b->set[0][i] != SPH_DEAD;
    out->max_speed = __builtin_sqrt(out->max_speed);
    out->dissipated = sim->now.work[0];
    out->wall_work = sim->now.work[1];
    out->diffused = sim->now.work[2];
    out->body_work = sim->now.work[3];
    out->removed_mass = sim->now.removed_mass;
}

#endif

#if SPH_WITH_PROBES
/* ---- probes ---- */

/* W(r) in double for one particle */
double sph_kernel_w(const sph_sim *sim, double r)
{
    double w, dw;
    sph_kernel_value(sim->cfg.kernel, r, sim->cfg.smoothing_length, &w, &dw);
    return w;
}

static void probe_one(const sph_sim *sim, const double *x, sph_probe_value *o)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    const double reach2 = sim->grid.support * sim->grid.support;
    memset(o, 0, sizeof *o);
    for (uint32_t i = 0; i < sim->now.count; i++) {
        double d = ((double)b->pos[0][i] * sim->grid.quantum + sim->cfg.lo[0]) - x[0], r2 = d * d;
        for (int k = 1; k < SPH_DIM && r2 < reach2; k++) {
            d = ((double)b->pos[k][i] * sim->grid.quantum + sim->cfg.lo[k]) - x[k];
            r2 += d * d;
        }
        if (!(r2 < reach2) || !is_fluid(sim, b, i))
            continue;
        const sph_set *s = &sim->set[b->set[0][i]];
        double e = (double)b->rho[0][i], rho = s->rho0 * (1 + e);
        double w = s->mass / rho * sph_kernel_w(sim, __builtin_sqrt(r2));
        o->cover += w;
        o->rho += w * rho;
        o->p += w * sph_pressure(sim, s, e);
        for (int k = 0; k < SPH_DIM; k++)
            o->v[k] += w * (double)b->vel[k][i];
    }
    if (o->cover < 1e-6) {
        memset(o, 0, sizeof *o);
        return;
    }
    o->rho /= o->cover;
    o->p /= o->cover;
    for (int k = 0; k < SPH_DIM; k++)
        o->v[k] /= o->cover;
}

static bool finite_vector(const double *x)
{
    for (int k = 0; k < SPH_DIM; k++)
        if (!sph_finite(x[k]))
            return false;
    return true;
}

sph_status sph_probe(const sph_sim *sim, const double *x, sph_probe_value *out)
{
    if (!sim || !x || !out || !finite_vector(x))
        return SPH_BAD_ARGUMENT;
    probe_one(sim, x, out);
    return SPH_OK;
}

sph_status sph_probe_line(const sph_sim *sim, const double *a, const double *b, uint32_t n, sph_probe_value *out)
{
    if (!sim || !a || !b || !out || n < 2 || !finite_vector(a) || !finite_vector(b))
        return SPH_BAD_ARGUMENT;
    for (uint32_t i = 0; i < n; i++) {
        double x[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = a[k] + (b[k] - a[k]) * i / (n - 1);
        probe_one(sim, x, &out[i]);
    }
    return SPH_OK;
}

sph_status sph_gauge(const sph_sim *sim, const double *x, uint32_t axis, double *height)
{
    if (!sim || !x || !height || axis >= SPH_DIM || !finite_vector(x))
        return SPH_BAD_ARGUMENT;
    /* from above the highest fluid particle near the line down, a quarter spacing at a time */
    const sph_buffer *b = &sim->buf[sim->cur];
    const double dx = sim->cfg.spacing, reach2 = sim->grid.support * sim->grid.support;
    double at[SPH_DIM], top = sim->cfg.lo[axis], low = sim->cfg.lo[axis];
    bool any = false;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        double p[SPH_DIM], r2 = 0;
        if (!is_fluid(sim, b, i))
            continue;
        position(sim, b, i, p);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            r2 += k == axis ? 0 : (p[k] - x[k]) * (p[k] - x[k]);
        if (r2 < reach2 && (!any || p[axis] > top)) {
            top = p[axis];
            any = true;
        }
    }
    *height = low;
    if (!any)
        return SPH_OK;
    memcpy(at, x, sizeof at);
    double above = 0, step = 0.25 * dx;
    for (double y = top + 2 * dx; y > low - dx && y - step < y; y -= step) { /* far from 0 a step may be lost */
        sph_probe_value v;
        at[axis] = y;
        probe_one(sim, at, &v);
        if (v.cover >= 0.5) {
            double f = v.cover > above ? (0.5 - above) / (v.cover - above) : 1;
            *height = y + step * (1 - f);
            return SPH_OK;
        }
        above = v.cover;
    }
    return SPH_OK;
}

void sph_extent(const sph_sim *sim, uint32_t axis, double *low, double *high)
{
    if (!sim || !low || !high)
        return;
    const sph_buffer *b = &sim->buf[sim->cur];
    bool any = false;
    *low = *high = 0;
    if (axis >= SPH_DIM)
        return;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        if (!is_fluid(sim, b, i))
            continue;
        double x = sim->cfg.lo[axis] + (double)b->pos[axis][i] * sim->grid.quantum;
        *low = !any || x < *low ? x : *low;
        *high = !any || x > *high ? x : *high;
        any = true;
    }
}
#endif
