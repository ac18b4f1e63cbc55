/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* track.c: the crest of a wave (see track.h). Cost: two loops over the particles. */
#include "track.h"
#if SPH_DIM == 2

enum { COARSE = 400, FINE = 81, MIDDLE = FINE / 2 };
#define REACH 2.5 /* depths on either side of the crest that the speed is taken from */

/* columns at from + k step, of B-splines with knots `knot` apart */
typedef struct columns {
    double from, step, knot;
    int n;
    double *h, *q; /* q may be null */
} columns;

static double spline(double r)
{
    const double a = r < 0 ? -r : r, b = 2 - a, c = 1 - a;
    return a >= 2 ? 0 : (b * b * b - (c > 0 ? 4 * c * c * c : 0)) / 6;
}

static void add(const columns *c, double x, double volume, double u)
{
    const double at = (x - c->from) / c->step, reach = 2 * c->knot / c->step;
    const double low = at - reach < 0 ? 0 : at - reach, high = at + reach > c->n - 1 ? c->n - 1 : at + reach;
    for (int k = (int)low; k <= high; k++) {
        const double w = volume * spline((k - at) * c->step / c->knot) / c->knot;
        c->h[k] += w;
        if (c->q)
            c->q[k] += w * u;
    }
}

static void gather(const sph_sim *sim, const track_tank *tank, const columns *c)
{
    const double length = tank->hi - tank->lo;
    sph_particle p;
    for (int k = 0; k < c->n; k++) {
        c->h[k] = 0;
        if (c->q)
            c->q[k] = 0;
    }
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &p) != SPH_OK || p.role != SPH_ROLE_FLUID)
            continue;
        const double volume = p.mass / 1000, x = p.x[0], u = p.v[0];
        add(c, x, volume, u);
        add(c, tank->periodic ? x + length : 2 * tank->hi - x, volume, tank->periodic ? u : -u);
        add(c, tank->periodic ? x - length : 2 * tank->lo - x, volume, tank->periodic ? u : -u);
    }
}

/* number of the point by which a parabola takes second differences: about a knot away */
static int apart(const columns *c)
{
    const int m = (int)(c->knot / c->step + 0.5);
    return m > 0 ? m : 1;
}

static double sharpened(const columns *c, int k)
{
    const int m = apart(c);
    const double step = m * c->step, bend = (c->h[k - m] - 2 * c->h[k] + c->h[k + m]) / (step * step);
    return c->h[k] - c->knot * c->knot / 6 * bend;
}

track_crest track_highest(const sph_sim *sim, const track_tank *tank)
{
    double h[COARSE], q[FINE], squares = 0, product = 0;
    columns c = {tank->lo, (tank->hi - tank->lo) / (COARSE - 1), 3 * tank->dx, COARSE, h, NULL};
    int most = 0;
    c.knot = c.knot > c.step ? c.knot : c.step;
    gather(sim, tank, &c);
    for (int k = 0; k < COARSE; k++)
        most = h[k] > h[most] ? k : most;
    const double near = c.from + most * c.step, wide = c.step + 2 * tank->dx;
    c = (columns){near - REACH * tank->depth, 2 * REACH * tank->depth / (FINE - 1), 3 * tank->dx, FINE, h, q};
    gather(sim, tank, &c);
    const int m = apart(&c), around = (int)(wide / c.step) + 1;
    int top = MIDDLE;
    for (int k = MIDDLE - around; k <= MIDDLE + around; k++)
        if (k - 2 * m >= 0 && k + 2 * m < FINE && h[k] > h[top])
            top = k;
    /* the parabola through three points */
    const double l = sharpened(&c, top - m), o = sharpened(&c, top), r = sharpened(&c, top + m);
    const double bend = l - 2 * o + r, share = bend < 0 ? 0.5 * (l - r) / bend : 0;
    for (int k = 1; k + 1 < FINE; k++) {
        const double slope = h[k + 1] - h[k - 1];
        squares += slope * slope;
        product += slope * (q[k + 1] - q[k - 1]);
    }
    return (track_crest){c.from + (top + share * m) * c.step, o - 0.25 * (l - r) * share,
                         squares > 0 ? product / squares : 0};
}
#endif
