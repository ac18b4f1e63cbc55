/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* probes.c: values at a point or along a line, the height and the depth of the water, how far it reaches. Images behind
   the faces of the domain are seen as by the sweep. Cost: a loop over all particles a point. */
#include "kernels.h"
#include "reading.h"
#include "arithmetic.h"

SPH_OBJECT(probes)

#if SPH_WITH_PROBES
/* smoothing length of a body (m) */
static double own_h(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const double h = sim->cfg.smoothing_length;
    return sph_varies_h(&sim->cfg) ? h * sph_relative_h(sim, &sim->set[b->set[0][i]], (double)b->rho[0][i]) : h;
}
/* W(r) in double for one particle */
static double kernel_w(const sph_sim *sim, double h, double r)
{
    double w, dw;
    sph_kernel_value(sim->cfg.kernel, r, h, &w, &dw);
    return w;
}

/* ---- images ---- */

/* how particles are seen: x' = sign x + shift (m), v' = flip v */
typedef struct view {
    double sign[SPH_DIM], shift[SPH_DIM], flip[SPH_DIM];
} view;
#define VIEWS (SPH_DIM == 1 ? 3u : SPH_DIM == 2 ? 9u : 27u)
#define NO_AXIS SPH_DIM

/* View number n: along axis k the particles themselves, or their images behind the low or the high face, as digit k of
   n to the base of 3 says. False where there is no face with images within a support of x. Of a column along an axis
   all is seen anyway: it needs no images there. */
static bool make_view(const sph_sim *sim, const double *x, uint32_t n, uint32_t column, view *v)
{
    for (uint32_t k = 0; k < SPH_DIM; k++)
        v->sign[k] = v->flip[k] = 1;
    for (uint32_t k = 0; k < SPH_DIM; k++, n /= 3) {
        const uint32_t digit = n % 3, high = digit == 2;
        const double length = (double)sim->grid.extent[k] * sim->grid.quantum, edge = sim->cfg.lo[k] + high * length;
        const uint32_t face = sim->cfg.face[k][high];
        v->shift[k] = 0;
        if (digit == 0)
            continue;
        if (!SPH_HAS_IMAGES || face == SPH_OPEN || k == column ||
            !((high ? edge - x[k] : x[k] - edge) < sim->grid.support))
            return false;
        if (SPH_IS(face, PERIODIC)) {
            v->shift[k] = high ? length : -length;
            continue;
        }
        v->sign[k] = -1;
        v->shift[k] = 2 * edge;
        for (uint32_t a = 0; a < SPH_DIM; a++)
            if (a == k || SPH_IS(face, MIRROR_NO_SLIP))
                v->flip[a] = -v->flip[a];
    }
    return true;
}

static double seen_at(const sph_sim *sim, const sph_buffer *b, const view *v, uint32_t i, uint32_t k)
{
    return v->sign[k] * ((double)b->pos[k][i] * sim->grid.quantum + sim->cfg.lo[k]) + v->shift[k];
}

/* squared distance of a particle from x, or from the column along an axis through x; a support or more: any number that
   is as large */
static double apart2(const sph_sim *sim, const sph_buffer *b, const view *v, uint32_t i, const double *x,
                     uint32_t column)
{
    const double reach2 = sim->grid.support * sim->grid.support;
    double r2 = 0;
    for (uint32_t k = 0; k < SPH_DIM && r2 < reach2; k++) {
        const double d = k == column ? 0 : seen_at(sim, b, v, i, k) - x[k];
        r2 += d * d;
    }
    return r2;
}

/* ---- values at a point ---- */

static void probe_view(const sph_sim *sim, const double *x, const view *seen, sph_probe_value *o)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    const double reach2 = sim->grid.support * sim->grid.support;
    for (uint32_t i = 0; i < sim->now.count; i++) {
        const double r2 = apart2(sim, b, seen, i, x, NO_AXIS);
        if (!(r2 < reach2) || !sph_body_at(sim, b, i))
            continue;
        const sph_set *s = &sim->set[b->set[0][i]];
        double e = (double)b->rho[0][i], rho = s->rho0 * (1 + e);
        double w = s->mass / rho * kernel_w(sim, own_h(sim, b, i), __builtin_sqrt(r2));
        o->cover += w;
        o->rho += w * rho;
        o->p += w * sph_pressure_at(sim, b, i);
        for (int k = 0; k < SPH_DIM; k++)
            o->v[k] += w * seen->flip[k] * (double)b->vel[k][i];
    }
}

static void probe_one(const sph_sim *sim, const double *x, sph_probe_value *o)
{
    view v;
    memset(o, 0, sizeof *o);
    for (uint32_t n = 0; n < VIEWS; n++)
        if (make_view(sim, x, n, NO_AXIS, &v))
            probe_view(sim, x, &v, o);
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

/* ---- columns ---- */

/* lowest and highest body, images included, within a support of the column along an axis through x; false: there is
   none */
static bool column_ends(const sph_sim *sim, const double *x, uint32_t axis, double *low, double *high)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    const double reach2 = sim->grid.support * sim->grid.support;
    bool any = false;
    view v;
    for (uint32_t n = 0; n < VIEWS; n++)
        for (uint32_t i = 0; make_view(sim, x, n, axis, &v) && i < sim->now.count; i++) {
            if (!sph_body_at(sim, b, i) || !(apart2(sim, b, &v, i, x, axis) < reach2))
                continue;
            const double y = seen_at(sim, b, &v, i, axis);
            *low = !any || y < *low ? y : *low;
            *high = !any || y > *high ? y : *high;
            any = true;
        }
    if (any && SPH_IS(sim->cfg.face[axis][0], PERIODIC)) { /* images of either end are seen at the other */
        *low = sim->cfg.lo[axis];
        *high = sim->cfg.hi[axis];
    }
    return any;
}

/* what a gauge looks along: from `from`, in steps of a quarter spacing, up (1) or down (-1) to `to` at most */
typedef struct line {
    double at[SPH_DIM], from, to, way;
    uint32_t axis;
} line;

/* the place where cover first passes 1/2 in the wanted sense (rising or falling), between two points of the line in
   proportion; `none` if it does not */
static double crossing(const sph_sim *sim, line *l, bool rising, double none)
{
    const double step = 0.25 * sim->cfg.spacing;
    double before = 0;
    /* far from 0 a step may be lost */
    for (double y = l->from; l->way * (l->to - y) >= 0 && y - step < y; y += l->way * step) {
        sph_probe_value v;
        l->at[l->axis] = y;
        probe_one(sim, l->at, &v);
        if ((v.cover >= 0.5) == rising) {
            const double share = v.cover < before || v.cover > before ? (0.5 - before) / (v.cover - before) : 1;
            return y < l->from || y > l->from ? y - l->way * step * (1 - share) : y;
        }
        before = v.cover;
    }
    return none;
}

static bool imaged(const sph_sim *sim, uint32_t k, uint32_t side)
{
    return SPH_HAS_IMAGES && sim->cfg.face[k][side] != SPH_OPEN;
}

/* a column's line through x, upwards or downwards, that does not look behind faces with images */
static line column_line(const sph_sim *sim, const double *x, uint32_t axis, double low, double high, bool up)
{
    const double bottom = sim->cfg.lo[axis], top = sim->cfg.hi[axis];
    line l = {.axis = axis, .way = up ? 1 : -1};
    memcpy(l.at, x, sizeof l.at);
    low = imaged(sim, axis, 0) && low < bottom ? bottom : low;
    high = imaged(sim, axis, 1) && high > top ? top : high;
    l.from = up ? low : high;
    l.to = up ? high : low;
    return l;
}

sph_status sph_gauge(const sph_sim *sim, const double *x, uint32_t axis, double *height)
{
    double low = 0, high = 0;
    if (!sim || !x || !height || axis >= SPH_DIM || !finite_vector(x))
        return SPH_BAD_ARGUMENT;
    const double dx = sim->cfg.spacing, floor = sim->cfg.lo[axis];
    *height = floor;
    if (!column_ends(sim, x, axis, &low, &high))
        return SPH_OK;
    line l = column_line(sim, x, axis, floor - dx, high + 2 * dx, false);
    *height = crossing(sim, &l, true, floor);
    if (!(*height < l.from)) { /* wet where it began: once more from where nothing reaches */
        l = column_line(sim, x, axis, floor - dx, high + sim->grid.support, false);
        *height = crossing(sim, &l, true, floor);
    }
    return SPH_OK;
}

sph_status sph_surface(const sph_sim *sim, const double *bed, uint32_t axis, double *height)
{
    double low = 0, high = 0;
    if (!sim || !bed || !height || axis >= SPH_DIM || !finite_vector(bed))
        return SPH_BAD_ARGUMENT;
    const double dx = sim->cfg.spacing;
    *height = bed[axis];
    if (!column_ends(sim, bed, axis, &low, &high))
        return SPH_OK;
    if (bed[axis] + 0.5 * dx < low - sim->grid.support)
        return SPH_OK;
    line l = column_line(sim, bed, axis, bed[axis] + 0.5 * dx, high + sim->grid.support, true);
    *height = crossing(sim, &l, false, l.to);
    if (!(*height > l.from)) /* dry */
        *height = bed[axis];
    return SPH_OK;
}

/* Integral of W along a line that passes a particle at distance sqrt(r2) (1/m^(DIM-1)): by the trapezoidal rule, which
   is good for what is even at one end and flat at the other. */
static double chord(const sph_sim *sim, double h, double r2)
{
    enum { POINTS = 24 };
    const double reach = sph_kernel_support(sim->cfg.kernel) * h;
    if (!(r2 < reach * reach))
        return 0;
    const double half = __builtin_sqrt(reach * reach - r2), step = half / POINTS;
    double sum = 0.5 * kernel_w(sim, h, __builtin_sqrt(r2));
    for (int i = 1; i < POINTS; i++)
        sum += kernel_w(sim, h, __builtin_sqrt(r2 + step * i * (step * i)));
    return 2 * step * sum;
}

sph_status sph_depth(const sph_sim *sim, const double *x, uint32_t axis, double *depth)
{
    if (!sim || !x || !depth || axis >= SPH_DIM || !finite_vector(x))
        return SPH_BAD_ARGUMENT;
    const sph_buffer *b = &sim->buf[sim->cur];
    const double reach2 = sim->grid.support * sim->grid.support;
    double sum = 0;
    view v;
    for (uint32_t n = 0; n < VIEWS; n++)
        for (uint32_t i = 0; make_view(sim, x, n, axis, &v) && i < sim->now.count; i++) {
            const double r2 = apart2(sim, b, &v, i, x, axis);
            if (!(r2 < reach2) || !sph_body_at(sim, b, i))
                continue;
            const sph_set *s = &sim->set[b->set[0][i]];
            sum += s->mass / (s->rho0 * (1 + (double)b->rho[0][i])) * chord(sim, own_h(sim, b, i), r2);
        }
    *depth = sum;
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
