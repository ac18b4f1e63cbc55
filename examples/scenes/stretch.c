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

double stretch_drawn(const double *p, double t)
{
    const double ramp = p[STRETCH_RAMP], v = p[STRETCH_SPEED];
    const double rest = p[STRETCH_PULL] > 0 ? p[STRETCH_PULL] > 2 * ramp ? p[STRETCH_PULL] : 2 * ramp : 1e300;
    const double left = rest - t;
    if (left <= 0)
        return v * (rest - ramp);
    if (t < ramp)
        return v * t * t / (2 * ramp);
    if (left < ramp)
        return v * (rest - ramp - left * left / (2 * ramp));
    return v * (t - ramp / 2);
}

static double speed_at(const double *p, double t)
{
    const double ramp = p[STRETCH_RAMP], v = p[STRETCH_SPEED];
    const double rest = p[STRETCH_PULL] > 0 ? p[STRETCH_PULL] > 2 * ramp ? p[STRETCH_PULL] : 2 * ramp : 1e300;
    const double left = rest - t;
    return left <= 0 ? 0 : t < ramp ? v * t / ramp : left < ramp ? v * left / ramp : v;
}

static void to_right(void *ctx, double t, double *x, double *v)
{
    x[0] = stretch_drawn(ctx, t);
    v[0] = speed_at(ctx, t);
}
static void to_left(void *ctx, double t, double *x, double *v)
{
    x[0] = -stretch_drawn(ctx, t);
    v[0] = -speed_at(ctx, t);
}

/* rings of particles dx apart around the hole in the rock that is there */
static sph_status add_rings(sph_sim *sim, uint32_t set, const stretch *b)
{
    const double turn = b->half && b->quarter ? SCENE_PI / 2 : b->half ? SCENE_PI : 2 * SCENE_PI, from = b->quarter ? 0 : -SCENE_PI / 2;
    for (uint32_t k = 0; k < b->rings; k++) {
        const double r = b->hole.radius[0] + (k + 0.5) * b->dx;
        const uint32_t n = (uint32_t)(turn * r / b->dx + 0.5);
        for (uint32_t j = 0; j < n; j++) {
            const double angle = from + turn * (j + 0.5) / n;
            const double x[2] = {b->hole.centre[0] + r * sph_cos(angle), b->hole.centre[1] + r * sph_sin(angle)};
            const sph_status st = sph_add_particle(sim, set, x, NULL, 0, NULL);
            if (st)
                return st;
        }
    }
    return SPH_OK;
}

sph_status stretch_build(sph_sim *sim, const double *p, const stretch *b, const sph_solid *rock, const sph_flaws *flaws)
{
    const double grip = p[STRETCH_GRIP] * b->dx, right[2] = {b->hi[0] - grip, b->lo[1]}, left[2] = {b->lo[0] + grip, b->hi[1]};
    sph_ellipse hole = b->hole;
    sph_shape s = {.hole = &hole, .holes = b->has_hole};
    sph_solid end = *rock;
    uint32_t set;
    sph_status st;
    memcpy(s.lo, b->lo, sizeof s.lo);
    memcpy(s.hi, b->hi, sizeof s.hi);
    s.lo[0] = b->half ? b->lo[0] : left[0];
    s.hi[0] = right[0];
    end.held = 1;
    end.motion = to_right;
    end.motion_ctx = (void *)p; // NOLINT: read only
    for (int k = 0; k < 2; k++)
        hole.radius[k] += b->rings * b->dx;
    if ((st = sph_add_solid(sim, rock, &set, NULL)) != SPH_OK || (st = add_rings(sim, set, b)) != SPH_OK ||
        (st = sph_add_shape(sim, set, &s)) != SPH_OK ||
        (flaws && (st = sph_add_flaws(sim, set, flaws)) != SPH_OK) ||
        (st = sph_add_solid(sim, &end, &set, NULL)) != SPH_OK || (st = sph_add_box(sim, set, right, b->hi, NULL)) != SPH_OK)
        return st;
    end.motion = to_left;
    if (!b->half && ((st = sph_add_solid(sim, &end, &set, NULL)) != SPH_OK || (st = sph_add_box(sim, set, b->lo, left, NULL)) != SPH_OK))
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

double stretch_peak(const sph_sim *sim, const stretch *b, double near)
{
    double most = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.set == STRETCH_ROCK && (!(near > 0) || off_rim(&b->hole, q.x) < near))
            most = q.stress[0] + q.stress[1] > most ? q.stress[0] + q.stress[1] : most;
    return most;
}

enum { TERMS = 6 };

/* solves a f = b for 3 right-hand sides by elimination with pivots on the diagonal; false if it is nearly singular */
static bool solve(double (*a)[TERMS], double (*f)[3])
{
    const double least = 1e-9 * a[0][0];
    for (int k = 0; k < TERMS; k++) {
        if (!(a[k][k] > least))
            return false;
        for (int i = k + 1; i < TERMS; i++) {
            const double w = a[i][k] / a[k][k];
            for (int j = k; j < TERMS; j++)
                a[i][j] -= w * a[k][j];
            for (int c = 0; c < 3; c++)
                f[i][c] -= w * f[k][c];
        }
    }
    for (int k = TERMS - 1; k >= 0; k--)
        for (int c = 0; c < 3; c++) {
            for (int j = k + 1; j < TERMS; j++)
                f[k][c] -= a[k][j] * f[j][c];
            f[k][c] /= a[k][k];
        }
    return true;
}

void stretch_sample(const sph_sim *sim, const stretch *b, const double *at, double reach, double skip, double *stress)
{
    double a[TERMS][TERMS] = {{0}}, f[TERMS][3] = {{0}}, nearest = 1e300;
    sph_particle q;
    stress[0] = stress[1] = stress[2] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_SOLID || (b->has_hole && off_rim(&b->hole, q.x) < skip))
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
            for (int k = 0; k < TERMS; k++) {
                for (int l = 0; l < TERMS; l++)
                    a[k][l] += w * t[k] * t[l];
                for (int c = 0; c < 3; c++)
                    f[k][c] += w * t[k] * s[c];
            }
        }
    }
    if (solve(a, f))
        memcpy(stress, f[0], sizeof f[0]);
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
