/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* collapsing.h: what collapsing_square and disc share: a square of 1 cm, in an infinite medium as far as its edges
   tell, whose particles run towards its middle with v0, all of them or those within a radius; turned by pi/8 if skewed
   (Powell 2012 sections 3.2.1, 3.2.2, eqs 2.73, 2.74, 2.76). A margin beyond the square moves as the rest. */
#ifndef EXAMPLES_COLLAPSING_H
#define EXAMPLES_COLLAPSING_H

#include "edged.h"
#if SPH_DIM == 2

enum { N = SOLID_COMMON, SPEED, RADIUS, SKEW, MARGIN, EDGED, DURATION = EDGED + EDGED_PARAMS, PARAMS };

#define COLLAPSING_PARAMS(radius_, edge_, layer_, margin_, duration_)                                                 \
    SOLID_PARAMS(SPH_CUBIC, 1.3, 0, 0, SPH_KICK_DRIFT_KICK, 0.3, SPH_TOTAL, SPH_NO_ARTIFICIAL_STRESS, EDGED_MU, 0),    \
        {"n", "-", "particles along the square", 50, 10, 1000, SCENE_WHOLE},                                          \
        {"speed", "cm/us", "v0", 0.01, 1e-9, 0.1, SCENE_NUMBER},                                                      \
        {"radius", "cm", "of what moves; 0: all", radius_, 0, 0.5, SCENE_NUMBER},                                     \
        {"skew", "degree", "angle by which velocities are turned; 22.5 is Powell's", 0, 0, 90, SCENE_NUMBER},         \
        {"margin", "dx", "of the same beyond the square on every side", margin_, 0, 1000, SCENE_WHOLE},               \
        EDGED_PARAM_ROWS(edge_, layer_, 3e-3),                                                                        \
        {"duration", "us", "length of the run", duration_, 0, 1000, SCENE_NUMBER}

static double collapsing_dx(const double *p) { return 1 / p[N]; }

static void configure(const double *p, sph_config *c)
{
    const double dx = collapsing_dx(p), m = p[MARGIN] * dx;
    *c = solid_config(p, dx);
    c->max_particles = scene_capacity((p[N] + 2 * p[MARGIN]) * (p[N] + 2 * p[MARGIN]));
    for (int k = 0; k < 2; k++) {
        c->lo[k] = -m - 0.5;
        c->hi[k] = 1 + m + 0.5;
    }
    edged_configure(p, EDGED, dx, c);
}

static void field(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    const double d[2] = {0.5 - x[0], 0.5 - x[1]}, r = __builtin_sqrt(d[0] * d[0] + d[1] * d[1]);
    const double a = p[SKEW] * SCENE_PI / 180, s = sph_sin(a), c = sph_cos(a);
    const bool moves = r > 0 && (!(p[RADIUS] > 0) || r < p[RADIUS]);
    (void)rho;
    v[0] = moves ? p[SPEED] / EDGED_C0 * (c * d[0] - s * d[1]) / r : 0;
    v[1] = moves ? p[SPEED] / EDGED_C0 * (s * d[0] + c * d[1]) / r : 0;
}

static sph_status build(sph_sim *sim, const double *p)
{
    const sph_solid m = solid_material(p);
    const double out = p[MARGIN] * collapsing_dx(p), lo[2] = {-out, -out}, hi[2] = {1 + out, 1 + out};
    const sph_edges e = {.faces = SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1) | SPH_HIGH(1), .as_now = true,
                         .source = {0.5, 0.5}};
    double values[PARAMS];
    uint32_t set;
    sph_status st;
    for (int k = 0; k < PARAMS; k++)
        values[k] = p[k];
    if ((st = sph_add_solid(sim, &m, &set, NULL)) != SPH_OK || (st = sph_add_box(sim, set, lo, hi, NULL)) != SPH_OK ||
        (st = sph_apply_field(sim, set, field, values)) != SPH_OK)
        return st;
    return p[EDGED + EDGED_EDGE] > 0 ? sph_find_edges(sim, &e) : SPH_OK;
}

static double end(const double *p) { return p[DURATION] * EDGED_C0; }

static const char *const column[] = {"time_cm/c0", "time_us", "kinetic_share", "v_A_v0", "p_A_K", "v_B_v0", "p_B_K",
                                     "absorbed_K.cm2"};

/* rest place of a particle, from the square's middle (cm) */
static void rest_of(const double *p, uint32_t id, double *x)
{
    const uint32_t row = (uint32_t)(p[N] + 2 * p[MARGIN]);
    x[0] = (id % row + 0.5 - p[MARGIN]) * collapsing_dx(p) - 0.5;
    x[1] = (id / row % row + 0.5 - p[MARGIN]) * collapsing_dx(p) - 0.5;
}

/* shares of the square's kinetic energy at the start; A: 0.25 cm right of the middle, B: 0.4 right and up */
static void history(const sph_sim *sim, const double *p, double *row)
{
    static const double at[2][2] = {{0.25, 0}, {0.4, 0.4}};
    const double v0 = p[SPEED] / EDGED_C0, near = 0.72 * collapsing_dx(p);
    double n[2] = {0, 0}, kinetic = 0, whole = 0, x[2], y[2], v[2];
    sph_particle q;
    sph_totals o;
    sph_get_totals(sim, &o);
    for (int k = 2; k < 8; k++)
        row[k] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK)
            continue;
        rest_of(p, q.id, x);
        if (SCENE_ABS(x[0]) > 0.5 || SCENE_ABS(x[1]) > 0.5)
            continue;
        const double speed = q.v[0] * q.v[0] + q.v[1] * q.v[1];
        y[0] = x[0] + 0.5;
        y[1] = x[1] + 0.5;
        field((void *)(uintptr_t)p, y, v, NULL);
        kinetic += q.mass * speed;
        whole += q.mass * (v[0] * v[0] + v[1] * v[1]);
        for (int k = 0; k < 2; k++)
            if (SCENE_ABS(x[0] - at[k][0]) < near && SCENE_ABS(x[1] - at[k][1]) < near) {
                n[k]++;
                row[3 + 2 * k] += __builtin_sqrt(speed) / v0;
                row[4 + 2 * k] -= (q.stress[0] + q.stress[1] + q.stress[2]) / 3;
            }
    }
    for (int k = 0; k < 4; k++)
        row[3 + k] /= n[k / 2] > 0 ? n[k / 2] : 1;
    row[0] = sph_time(sim);
    row[1] = row[0] / EDGED_C0;
    row[2] = whole > 0 ? kinetic / whole : 0;
    row[7] = o.absorbed;
}
#endif
#endif
