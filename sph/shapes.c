/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shapes.c: rings, polygons, and boxes or ellipses with elliptical holes, filled with particles on square lattices or
   on the face-centred ones of Gray 2001 section 5.6.5. Runs between steps only. Every point of the lattice that
   encloses a shape is looked at once: the cost is lattice points times holes, or times corners. */
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(shapes)

#if SPH_WITH_SHAPES

#define MAX_HOLES 4096u
/* so near to a rim (of its radius) or face (of a spacing) counts as on it, whatever way it was rounded */
#define RIM 1e-9

static bool in_ellipse(const sph_ellipse *e, const double *x)
{
    double q = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        double d = (x[k] - e->centre[k]) / e->radius[k];
        q += d * d;
    }
    return q < 1 - RIM;
}

typedef struct cut_shape {
    const sph_shape *s;
    double slack; /* m */
} cut_shape;
static bool in_shape(const void *shape, const double *x)
{
    const cut_shape *c = shape;
    const sph_shape *s = c->s;
    for (int k = 0; k < SPH_DIM; k++)
        if (s->hi[k] > s->lo[k] && (x[k] < s->lo[k] - c->slack || x[k] > s->hi[k] + c->slack))
            return false;
    if (s->outline && !in_ellipse(s->outline, x))
        return false;
    for (uint32_t i = 0; i < s->holes; i++)
        if (in_ellipse(&s->hole[i], x))
            return false;
    return true;
}

/* whether the lattice is centred along axis k */
static bool is_round(const sph_shape *s, int k) { return s->outline && sph_finite(s->outline->radius[k]); }

/* puts the lattice where the manual says and fills it */
static sph_status fill_shape(sph_sim *sim, const char *call, uint32_t set, const sph_shape *s)
{
    const double dx = sim->cfg.spacing;
    const bool shifted = s->lattice != SPH_LATTICE_SQUARE;
    const int along = shifted ? (int)s->lattice - 1 : -1;
    const cut_shape c = {s, RIM * dx};
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t middle = 0; /* sum of the numbers of the row through the centre */
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = s->lo[k];
        hi[k] = s->hi[k] > s->lo[k] ? s->hi[k] + c.slack : s->hi[k];
        if (!is_round(s, k))
            continue;
        const uint32_t n = sph_setup_round_up(s->outline->radius[k] / dx);
        double reach = n * dx;
        if (shifted && k != along) { /* an odd number of rows */
            reach = (n + 0.5) * dx;
            middle += n;
        }
        lo[k] = s->outline->centre[k] - reach;
        hi[k] = s->outline->centre[k] + reach;
    }
    sph_rows rows = {0, {0, 0}};
    if (shifted) {
        const bool centred = is_round(s, along);
        rows.axis = (uint32_t)along;
        rows.offset[middle & 1] = centred ? 0.5 : 0.25;
        rows.offset[~middle & 1] = centred ? 0 : 0.75;
    }
    return sph_setup_fill(sim, call, set, lo, hi, shifted ? &rows : NULL, s->velocity, in_shape, &c);
}

static sph_status check_ellipse(sph_sim *sim, const sph_ellipse *e)
{
    for (int k = 0; k < SPH_DIM; k++) {
        if (!(sph_abs(e->centre[k]) < 1e15))
            return sph_setup_bad(sim, "centre", "finite", e->centre[k]);
        if (!(e->radius[k] > 0))
            return sph_setup_bad(sim, "radius", "> 0; infinite for a cylinder", e->radius[k]);
    }
    return SPH_OK;
}

sph_status sph_add_shape(sph_sim *sim, uint32_t set, const sph_shape *shape)
{
    sph_status st = SPH_OK;
    if (!sim || !shape)
        return sph_setup_bad(sim, "shape", "a shape", 0);
    if (shape->lattice > (SPH_DIM > 1 ? SPH_DIM : 0))
        return sph_setup_bad(sim, "lattice", "SPH_LATTICE_SQUARE, or SHIFTED along an axis (2-D, 3-D)", shape->lattice);
    if (shape->holes > MAX_HOLES || (shape->holes > 0 && !shape->hole))
        return sph_setup_bad(sim, "holes", "at most 4096, with a place where they are", shape->holes);
    if (shape->outline)
        st = check_ellipse(sim, shape->outline);
    for (uint32_t i = 0; !st && i < shape->holes; i++)
        st = check_ellipse(sim, &shape->hole[i]);
    for (int k = 0; !st && k < SPH_DIM; k++) {
        if (!(sph_abs(shape->lo[k]) < 1e15))
            st = sph_setup_bad(sim, "lo", "finite", shape->lo[k]);
        else if (!(shape->hi[k] >= shape->lo[k] && shape->hi[k] < 1e15))
            st = sph_setup_bad(sim, "hi", "finite and >= lo", shape->hi[k]);
    }
    if (st)
        return st;
    const uint32_t before = sim->now.count;
    st = fill_shape(sim, "sph_add_shape", set, shape);
    if (!st && sim->now.count == before)
        return sph_setup_bad(sim, "shape", "one that holds a point of its lattice", 0);
    return st;
}

sph_status sph_add_ring(sph_sim *sim, uint32_t set, const double *centre, double inner, double outer, const double *v)
{
    if (!sim || !centre)
        return sph_setup_bad(sim, "centre", "a position", 0);
    if (!(inner >= 0) || !(outer > inner) || !(outer < 1e15))
        return sph_setup_bad(sim, "outer", "finite and > inner >= 0", outer);
    sph_ellipse rim, hole;
    sph_shape s = {.outline = &rim, .hole = &hole, .holes = inner > 0};
    for (int k = 0; k < SPH_DIM; k++) {
        rim.centre[k] = hole.centre[k] = centre[k];
        rim.radius[k] = outer;
        hole.radius[k] = inner;
        s.velocity[k] = v ? v[k] : 0;
    }
    return fill_shape(sim, "sph_add_ring", set, &s);
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
        return sph_setup_bad(sim, "corner", "at least three corners", n);
    double lo[2] = {corner[0][0], corner[0][1]}, hi[2] = {lo[0], lo[1]};
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) {
            if (!(sph_abs(corner[i][k]) < 1e15))
                return sph_setup_bad(sim, "corner", "finite", corner[i][k]);
            lo[k] = corner[i][k] < lo[k] ? corner[i][k] : lo[k];
            hi[k] = corner[i][k] > hi[k] ? corner[i][k] : hi[k];
        }
    polygon p = {corner, n};
    return sph_setup_fill(sim, "sph_add_polygon", set, lo, hi, NULL, v, in_polygon, &p);
}
#endif

#endif
