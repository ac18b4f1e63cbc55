/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* probes.c: values at a point or along a line, the height of the water, how far it reaches. */
#include "kernels.h"
#include "reading.h"

#if SPH_WITH_PROBES
/* W(r) in double for one particle */
static double kernel_w(const sph_sim *sim, double r)
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
        if (!(r2 < reach2) || !sph_body_at(sim, b, i))
            continue;
        const sph_set *s = &sim->set[b->set[0][i]];
        double e = (double)b->rho[0][i], rho = s->rho0 * (1 + e);
        double w = s->mass / rho * kernel_w(sim, __builtin_sqrt(r2));
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
        if (!sph_body_at(sim, b, i))
            continue;
        sph_position(sim, b, i, p);
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
        if (!sph_body_at(sim, b, i))
            continue;
        double x = sim->cfg.lo[axis] + (double)b->pos[axis][i] * sim->grid.quantum;
        *low = !any || x < *low ? x : *low;
        *high = !any || x > *high ? x : *high;
        any = true;
    }
}
#endif
