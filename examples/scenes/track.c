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
    for (int k = 0; tank->bed && k < c->n; k++)
        c->h[k] += tank->bed(tank->of, c->from + k * c->step);
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
    return track_between(sim, tank, tank->lo, tank->hi);
}

track_crest track_between(const sph_sim *sim, const track_tank *tank, double from, double to)
{
    double h[COARSE], q[FINE], squares = 0, product = 0;
    columns c = {tank->lo, (tank->hi - tank->lo) / (COARSE - 1), 3 * tank->dx, COARSE, h, NULL};
    int most = -1;
    c.knot = c.knot > c.step ? c.knot : c.step;
    gather(sim, tank, &c);
    for (int k = 0; k < COARSE; k++)
        if (c.from + k * c.step >= from && c.from + k * c.step <= to)
            most = most < 0 || h[k] > h[most] ? k : most;
    most = most < 0 ? 0 : most;
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

void track_heights(const sph_sim *sim, const track_tank *tank, const double *x, uint32_t n, double *height)
{
    for (uint32_t k = 0; k < n && k < TRACK_PLACES; k++) {
        double h[3];
        const columns c = {x[k] - 3 * tank->dx, 3 * tank->dx, 3 * tank->dx, 3, h, NULL};
        gather(sim, tank, &c);
        height[k] = sharpened(&c, 1);
    }
}

double track_at_wall(const sph_sim *sim, double wall, double inward, double support)
{
    double h[3] = {0};
    for (int k = 0; k < 3; k++) {
        const double bed[2] = {wall + (k + 1) * inward * support, 0};
        sph_surface(sim, bed, 1, &h[k]);
    }
    return (15 * h[0] - 6 * h[1] + h[2]) / 10;
}

double track_front(const sph_sim *sim, const track_tank *tank, double from, double step, double height)
{
    double h[COARSE];
    columns c = {tank->lo, (tank->hi - tank->lo) / (COARSE - 1), 3 * tank->dx, COARSE, h, NULL};
    c.knot = c.knot > c.step ? c.knot : c.step;
    gather(sim, tank, &c);
    const int way = step < 0 ? -1 : 1;
    int k = (int)((from - c.from) / c.step + 0.5);
    for (k = k < 0 ? 0 : k >= COARSE ? COARSE - 1 : k; k + way >= 0 && k + way < COARSE; k += way)
        if (h[k] >= height && h[k + way] < height)
            return c.from + (k + way * (h[k] - height) / (h[k] - h[k + way])) * c.step;
    return way < 0 ? tank->lo : tank->hi;
}

/* ---- the face of a wave ---- */

enum { ROWS = 64, PLACES = 192, LEAN_ROWS = 4 };
#define KNOT 1.5   /* spacings */
#define LOWEST 0.25 /* of the wave's height */

/* cover at heights low + r step, places at + ahead k step */
typedef struct face_grid {
    double at, ahead, low, step;
    int rows;
    double cover[ROWS][PLACES];
} face_grid;

static void cover_grid(const sph_sim *sim, const track_tank *tank, face_grid *g)
{
    const double knot = KNOT * tank->dx;
    const int reach = (int)(2 * knot / g->step) + 1;
    sph_particle p;
    for (int r = 0; r < ROWS; r++)
        for (int k = 0; k < PLACES; k++)
            g->cover[r][k] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &p) != SPH_OK || p.role != SPH_ROLE_FLUID)
            continue;
        const double column = (p.x[0] - g->at) * g->ahead / g->step, row = (p.x[1] - g->low) / g->step;
        if (!(column > -reach && column < PLACES + reach && row > -reach && row < g->rows + reach))
            continue;
        const int k0 = (int)column - reach, r0 = (int)row - reach;
        for (int r = r0 < 0 ? 0 : r0; r < g->rows && r <= r0 + 2 * reach + 1; r++)
            for (int k = k0 < 0 ? 0 : k0; k < PLACES && k <= k0 + 2 * reach + 1; k++)
                g->cover[r][k] += p.mass / 1000 / (knot * knot) * spline((r - row) * g->step / knot) *
                                  spline((k - column) * g->step / knot);
    }
}

/* how far ahead the water of a row goes that is connected with the crest; negative: it is dry there */
static double reach_of_row(const face_grid *g, int r)
{
    if (g->cover[r][0] < 0.5)
        return -1;
    for (int k = 0; k + 1 < PLACES; k++)
        if (g->cover[r][k + 1] < 0.5)
            return (k + (g->cover[r][k] - 0.5) / (g->cover[r][k] - g->cover[r][k + 1])) * g->step;
    return PLACES * g->step;
}

track_face track_steepest(const sph_sim *sim, const track_tank *tank, track_crest crest, bool to_the_left)
{
    const double high = crest.height - tank->depth, step = 0.5 * tank->dx;
    face_grid g;
    double far[ROWS];
    track_face face = {0, 0, 0};
    g.at = crest.x;
    g.ahead = to_the_left ? -1 : 1;
    g.low = tank->depth + LOWEST * high;
    g.step = step;
    const double rows = (1 - LOWEST) * high / step + 4;
    g.rows = rows < ROWS ? (int)rows : ROWS;
    if (!(high > 2 * tank->dx))
        return face;
    cover_grid(sim, tank, &g);
    for (int r = 0; r < g.rows; r++)
        far[r] = reach_of_row(&g, r);
    const int half = LEAN_ROWS / 2;
    for (int r = 0; r + LEAN_ROWS < g.rows && far[r + LEAN_ROWS] >= 0; r++) {
        const double lean = (far[r + LEAN_ROWS] - far[r]) / (LEAN_ROWS * step);
        if (far[r] >= 0 && (face.lean == 0 || lean > face.lean))
            face = (track_face){lean, g.at + g.ahead * far[r + half], g.low + (r + half) * step};
    }
    return face;
}
#endif
