/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stretch.c: a stretched block of rock; see stretch.h. */
#include <string.h>

#include "stretch.h"
#if SPH_DIM == 2

void stretch_configure(const double *p, const stretch *b, sph_config *c)
{
    *c = solid_config(p, b->dx);
    double lo[2], hi[2];
    for (int k = 0; k < 2; k++) {
        lo[k] = b->lo[k];
        hi[k] = b->hi[k];
        c->lo[k] = lo[k] - b->room;
        c->hi[k] = hi[k] + b->room;
    }
    if (b->half) {
        c->lo[0] = lo[0];
        c->face[0][0] = SPH_SYMMETRY;
    }
    if (b->quarter) {
        c->lo[1] = lo[1];
        c->face[1][0] = SPH_SYMMETRY;
    }
    c->max_particles = scene_capacity(scene_box_count(lo, hi, b->dx) * 1.01 + 100);
}

void break_configure(const double *p, sph_config *c)
{
    c->damage = (uint32_t)p[BREAK_DAMAGE];
    const double n = c->max_particles;
    c->max_flaws = scene_capacity(n * (sph_log(n + 1) * 1.5 + 4)); /* n ln n, and what the last bare particles cost */
}

/* where an end is at time t, and how fast it goes: up to speed evenly, on, and evenly to rest */
static double drawn(const double *p, double t, double *speed)
{
    const double slow = p[STRETCH_SLOW], v = p[STRETCH_SPEED] / slow, ramp = p[STRETCH_RAMP] * slow,
        pull = p[STRETCH_PULL] * slow;
    const double rest = pull > 0 ? pull > 2 * ramp ? pull : 2 * ramp : 1e300, left = rest - t;
    *speed = left <= 0 ? 0 : t < ramp ? v * t / ramp : left < ramp ? v * left / ramp : v;
    if (left <= 0)
        return v * (rest - ramp);
    if (t < ramp)
        return v * t * t / (2 * ramp);
    if (left < ramp)
        return v * (rest - ramp - left * left / (2 * ramp));
    return v * (t - ramp / 2);
}

double stretch_drawn(const double *p, double t)
{
    double speed;
    return drawn(p, t, &speed);
}

static void to_right(void *ctx, double t, double *x, double *v)
{
    x[0] = drawn(ctx, t, &v[0]);
}
static void to_left(void *ctx, double t, double *x, double *v)
{
    x[0] = -drawn(ctx, t, &v[0]);
    v[0] = -v[0];
}

/* ---- a lattice bent round a circular hole ---- */

/* The square lattice is made of square rings about the origin; here ring number k >= first lies between the curves k
   and k + 1. The first curve is the circle, the last the square, the others lie between. Each holds the area of its
   square (the difference of the first is shared out), and the particles of a ring have equal parts of its area: they
   stand almost as regularly as on the lattice, each on an area of dx^2, and the hole has no steps. */
typedef struct bent {
    uint32_t first, last; /* curves */
    double dx, a;
} bent;
enum { FINE = 256 }; /* steps of an octant */

static bent bend(const stretch *b)
{
    const double side = b->hole.radius[0] * 0.88622692545275801; /* sqrt(pi)/2: of the quarter's square */
    const uint32_t first = (uint32_t)(side / b->dx + 0.5);
    return (bent){first, 3 * first, b->dx, b->hole.radius[0]};
}

static double area(const bent *o, double k)
{
    const double a = SCENE_PI / 4 * o->a * o->a, l = o->last * o->dx, f = o->first * o->dx, x = k * o->dx;
    return a + (x * x - f * f) * (l * l - a) / (l * l - f * f);
}

/* radius of curve k at the angle x pi/4, but for its size */
static double curve(const bent *o, uint32_t k, double x)
{
    const double s = (double)(k - o->first) / (o->last - o->first), w = s * s * (3 - 2 * s);
    return 1 - w + w * 0.88622692545275801 / sph_cos(x * (SCENE_PI / 4));
}

static sph_status add_ring(sph_sim *sim, uint32_t set, const bent *o, uint32_t k)
{
    double size[2], sum[2] = {0, 0}, between[2] = {0, 0}, inner[FINE + 1], outer[FINE + 1], part[FINE + 1];
    for (int i = 0; i <= FINE; i++) {
        inner[i] = curve(o, k, (double)i / FINE);
        outer[i] = curve(o, k + 1, (double)i / FINE);
        const double w = (i == 0 || i == FINE ? 0.5 : 1) * (SCENE_PI / 4) / FINE;
        sum[0] += w * inner[i] * inner[i];
        sum[1] += w * outer[i] * outer[i];
    }
    for (uint32_t c = 0; c < 2; c++)
        size[c] = __builtin_sqrt(area(o, k + c) / sum[c]);
    part[0] = 0;
    for (int i = 0; i <= FINE; i++) {
        inner[i] *= size[0];
        outer[i] *= size[1];
        between[1] = outer[i] * outer[i] - inner[i] * inner[i];
        if (i > 0)
            part[i] = part[i - 1] + between[0] + between[1];
        between[0] = between[1];
    }
    for (uint32_t j = 0; j <= 2 * k; j++) { /* the one at 45 degrees is number k */
        const uint32_t m = j <= k ? j : 2 * k - j;
        const double want = part[FINE] * (m == k ? 1 : (m + 0.5) / (k + 0.5));
        int i = 1;
        while (i < FINE && part[i] < want)
            i++;
        const double f = (want - part[i - 1]) / (part[i] - part[i - 1]), angle = (i - 1 + f) * (SCENE_PI / 4) / FINE;
        const double r = 0.5 * ((1 - f) * (inner[i - 1] + outer[i - 1]) + f * (inner[i] + outer[i]));
        const double x = r * sph_cos(angle), y = r * sph_sin(angle), at[2] = {j <= k ? x : y, j <= k ? y : x};
        const sph_status st = sph_add_particle(sim, set, at, NULL, 0, NULL);
        if (st)
            return st;
    }
    return SPH_OK;
}

/* a quarter of the rock, from the mirror planes to the corner `to` */
static sph_status add_bent(sph_sim *sim, uint32_t set, const stretch *b, const double *to)
{
    const bent o = bend(b);
    const double side = o.last * o.dx, right[2] = {side, 0}, right_to[2] = {to[0], side}, top[2] = {0, side};
    for (uint32_t k = o.first; k < o.last; k++) {
        const sph_status st = add_ring(sim, set, &o, k);
        if (st)
            return st;
    }
    const sph_status st = sph_add_box(sim, set, right, right_to, NULL);
    return st ? st : sph_add_box(sim, set, top, to, NULL);
}

sph_status stretch_build(sph_sim *sim, const double *p, const stretch *b, const sph_solid *rock, const sph_flaws *flaws)
{
    const bool ideal = p[STRETCH_CLAMP] != 0;
    /* ideal: the middle of the held column is the end; of a half block half a spacing inside, for the lattice's sake */
    const double out = !ideal || b->half ? 0 : 0.5 * b->dx, grip = ideal ? b->dx : p[STRETCH_GRIP] * b->dx;
    const double right[2] = {b->hi[0] + out - grip, b->lo[1]}, left[2] = {b->lo[0] - out + grip, b->hi[1]};
    const double from[2] = {b->lo[0] - out, b->lo[1]}, to[2] = {b->hi[0] + out, b->hi[1]};
    sph_shape s = {.hole = &b->hole, .holes = b->has_hole};
    sph_solid end = ideal ? solid_clamp(rock, 1) : *rock;
    uint32_t set;
    sph_status st;
    memcpy(s.lo, b->lo, sizeof s.lo);
    memcpy(s.hi, b->hi, sizeof s.hi);
    s.lo[0] = b->half ? b->lo[0] : left[0];
    s.hi[0] = right[0];
    end.held = 1;
    end.motion = to_right;
    end.motion_ctx = (void *)p; // NOLINT: read only
    if ((st = sph_add_solid(sim, rock, &set, NULL)) != SPH_OK ||
        (st = b->bent ? add_bent(sim, set, b, s.hi) : sph_add_shape(sim, set, &s)) != SPH_OK ||
        (flaws && (st = sph_add_flaws(sim, set, flaws)) != SPH_OK) ||
        (st = sph_add_solid(sim, &end, &set, NULL)) != SPH_OK ||
        (st = sph_add_box(sim, set, right, to, NULL)) != SPH_OK)
        return st;
    end.motion = to_left;
    if (!b->half && ((st = sph_add_solid(sim, &end, &set, NULL)) != SPH_OK ||
                     (st = sph_add_box(sim, set, from, left, NULL)) != SPH_OK))
        return st;
    if (!b->has_gas)
        return SPH_OK;
    s.outline = &b->hole;
    s.holes = 0;
    if ((st = sph_add_fluid(sim, &b->gas, &set)) != SPH_OK)
        return st;
    return sph_add_shape(sim, set, &s);
}

/* ---- looking at the rock ---- */

double stretch_end_stress(const sph_sim *sim, double from)
{
    double sum = 0, n = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.set == STRETCH_ROCK && SCENE_ABS(q.x[0]) >= from) {
            sum += q.stress[0];
            n++;
        }
    return n > 0 ? sum / n : 0;
}

/* way from a hole's rim to x along the ray from its centre */
static double off_rim(const sph_ellipse *e, const double *x)
{
    const double d[2] = {x[0] - e->centre[0], x[1] - e->centre[1]}, u = d[0] / e->radius[0], v = d[1] / e->radius[1];
    const double q = __builtin_sqrt(u * u + v * v);
    return q > 0 ? __builtin_sqrt(d[0] * d[0] + d[1] * d[1]) * (1 - 1 / q) : -e->radius[0];
}

double stretch_peak(const sph_sim *sim)
{
    double most = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.set == STRETCH_ROCK)
            most = q.stress[0] + q.stress[1] > most ? q.stress[0] + q.stress[1] : most;
    return most;
}

enum { TERMS = 6, MOST = 9, RIGHT = 3 };

/* solves n normal equations for 3 right-hand sides by elimination with pivots on the diagonal; the solutions replace f.
   False if they are nearly singular */
static bool solve(int n, double (*a)[MOST], double (*f)[RIGHT])
{
    const double least = 1e-9 * a[0][0];
    for (int k = 0; k < n; k++) {
        if (!(a[k][k] > least))
            return false;
        for (int i = k + 1; i < n; i++) {
            const double w = a[i][k] / a[k][k];
            for (int j = k; j < n; j++)
                a[i][j] -= w * a[k][j];
            for (int c = 0; c < RIGHT; c++)
                f[i][c] -= w * f[k][c];
        }
    }
    for (int k = n - 1; k >= 0; k--)
        for (int c = 0; c < RIGHT; c++) {
            for (int j = k + 1; j < n; j++)
                f[k][c] -= a[k][j] * f[j][c];
            f[k][c] /= a[k][k];
        }
    return true;
}

/* adds an equation of weight w */
static void equation(int n, double (*a)[MOST], double (*f)[RIGHT], const double *term, const double *value, double w)
{
    for (int k = 0; k < n; k++) {
        for (int l = 0; l < n; l++)
            a[k][l] += w * term[k] * term[l];
        for (int c = 0; c < RIGHT; c++)
            f[k][c] += w * term[k] * value[c];
    }
}

void stretch_sample(const sph_sim *sim, const stretch *b, const double *at, double reach, double *stress)
{
    double a[MOST][MOST] = {{0}}, f[MOST][RIGHT] = {{0}}, nearest = 1e300;
    sph_particle q;
    stress[0] = stress[1] = stress[2] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_SOLID)
            continue;
        for (int image = 0; image < 4; image++) {
            if ((image & 1 && !b->half) || (image & 2 && !b->quarter))
                continue;
            const double u = ((image & 1 ? 2 * b->lo[0] - q.x[0] : q.x[0]) - at[0]) / reach;
            const double v = ((image & 2 ? 2 * b->lo[1] - q.x[1] : q.x[1]) - at[1]) / reach;
            const double far = u * u + v * v, w = (1 - far) * (1 - far) * (1 - far);
            if (!(far < 1))
                continue;
            const double s[3] = {q.stress[0], q.stress[1], image == 1 || image == 2 ? -q.stress[3] : q.stress[3]};
            const double t[TERMS] = {1, u, v, u * u, u * v, v * v};
            if (far < nearest) {
                nearest = far;
                memcpy(stress, s, sizeof s);
            }
            equation(TERMS, a, f, t, s, w);
        }
    }
    if (solve(TERMS, a, f))
        memcpy(stress, f[0], sizeof f[0]);
}

/* 1, then (a/r)^m cos m angle and (r/out)^m cos m angle for m = 2, 4, 6, 8 */
static void harmonics(const stretch *b, double out, const double *x, double *term)
{
    const double r2 = x[0] * x[0] + x[1] * x[1], a = b->hole.radius[0], c2 = (x[0] * x[0] - x[1] * x[1]) / r2;
    double in = 1, far = 1, before = c2, c = 1; /* cos of 2 angle less and now */
    term[0] = 1;
    for (int m = 1; m <= 4; m++) {
        const double next = 2 * c2 * c - before;
        before = c;
        c = next;
        in *= a * a / r2;
        far *= r2 / (out * out);
        term[m] = in * c;
        term[4 + m] = far * c;
    }
}

void stretch_rim(const sph_sim *sim, const stretch *b, double skip, double out, uint32_t n, double *sum)
{
    double a[MOST][MOST] = {{0}}, f[MOST][RIGHT] = {{0}}, term[MOST];
    const double rim = b->hole.radius[0];
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.set != STRETCH_ROCK)
            continue;
        const double r2 = q.x[0] * q.x[0] + q.x[1] * q.x[1], s[RIGHT] = {q.stress[0] + q.stress[1], 0, 0};
        if (r2 < (rim + skip) * (rim + skip) || r2 > out * out)
            continue;
        harmonics(b, out, q.x, term);
        equation(MOST, a, f, term, s, 1);
    }
    const bool fine = solve(MOST, a, f);
    for (uint32_t k = 0; k < n; k++) {
        const double angle = k * (SCENE_PI / 2) / (n - 1), at[2] = {rim * sph_cos(angle), rim * sph_sin(angle)};
        harmonics(b, out, at, term);
        sum[k] = 0;
        for (int j = 0; j < MOST && fine; j++)
            sum[k] += term[j] * f[j][0];
    }
}

void stretch_load(const stretch *b, double p, const double *x, double *a)
{
    const sph_ellipse *e = &b->hole;
    const double u = (x[0] - e->centre[0]) / e->radius[0], v = (x[1] - e->centre[1]) / e->radius[1];
    const double g[2] = {u / e->radius[0], v / e->radius[1]}, size = __builtin_sqrt(g[0] * g[0] + g[1] * g[1]);
    const double q = __builtin_sqrt(u * u + v * v), wide = 3 * b->dx;
    const double off = size > 0 ? (q - 1) * q / size : -1; /* (q - 1)/|grad q| */
    if (off < 0 || off >= wide)
        return;
    for (int k = 0; k < 2; k++)
        a[k] += p * (2 / wide) * (1 - off / wide) * g[k] / size;
}

void stretch_look(const sph_sim *sim, const stretch *b, stretch_broken *out)
{
    double sum = 0, n = 0, x[2] = {0, 0};
    sph_particle q;
    *out = (stretch_broken){.near = -1};
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.set != STRETCH_ROCK)
            continue;
        n++;
        sum += q.damage;
        if (!(q.damage > 0.99))
            continue;
        const double off = b->has_hole ? SCENE_ABS(off_rim(&b->hole, q.x)) : -1;
        out->near = out->full == 0 || off < out->near ? off : out->near;
        out->full++;
        x[0] += q.x[0];
        x[1] += q.x[1];
    }
    out->mean = n > 0 ? sum / n : 0;
    if (out->full > 0) {
        out->x = x[0] / out->full;
        out->y = x[1] / out->full;
    }
}
#endif
