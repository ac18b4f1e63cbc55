/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* chamber.c: an empty elliptical chamber below a free surface in a stretched block (Gray 2001 section 7.3): stress
   along the surface. Lengths in a: semi-axes 1.3 along x and 1 up, the middle 1.9, 3.1 or 4.4 below the surface. Half
   of it is modelled. Stress is sxx + syy over p1, the mean sxx towards the end; in a half plane its maxima are 1.724,
   1.280, 1.142 at x 1.558, 2.425, 3.354 (tests/refdata/fe_ellipse_surface.csv). */
#include "stretch.h"
#if SPH_DIM == 2

enum { DEPTH = STRETCH_COMMON, N, WIDE, HIGH, REACH, SETTLE, PARAMS };
#define STATIONS 41 /* along the surface, every a/4 */

static const scene_param param[PARAMS] = {
    SOLID_PARAMS_DAMPED(SPH_WENDLAND_C2, 1.5, 0, 0, SPH_KICK_DRIFT_KICK, 0.4, SPH_CORRECTED, SPH_NO_ARTIFICIAL_STRESS,
                        0.5,
                        0, 0.99),
    STRETCH_PARAMS(1e-5, 15, 40),
    {"depth", "a", "of the chamber's middle below the surface", 1.9, 1.1, 100, SCENE_NUMBER},
    {"n", "-", "particles to a", 10, 2, 1000, SCENE_WHOLE},
    {"wide", "a", "half width of the block", 15, 2, 1e3, SCENE_NUMBER},
    {"high", "a", "height of the block", 20, 2, 1e3, SCENE_NUMBER},
    {"reach", "dx", "of the fit that takes the stress to the surface", 3, 2, 10, SCENE_NUMBER},
    {"settle", "a/c0", "how long the block comes to rest after the pull", 60, 0, 1e6, SCENE_NUMBER},
};

static stretch block(const double *p)
{
    const double dx = 1 / p[N];
    return (stretch){.lo = {0, -p[HIGH]}, .hi = {p[WIDE], 0}, .dx = dx, .room = 0.02 * p[WIDE] + 4 * dx, .half = true,
                     .has_hole = true, .hole = {{0, -p[DEPTH]}, {1.3, 1}}};
}

static void configure(const double *p, sph_config *c)
{
    const stretch b = block(p);
    stretch_configure(p, &b, c);
}

static sph_status build(sph_sim *sim, const double *p)
{
    const stretch b = block(p);
    const sph_solid rock = solid_material(p);
    return stretch_build(sim, p, &b, &rock, NULL);
}

static double end(const double *p) { return p[STRETCH_PULL] * p[STRETCH_SLOW] + p[SETTLE]; }

static const char *const column[] = {
    "time", "drawn_a", "p1_K", "kinetic", "elastic", "peak", "peak_x",
    "s_0", "s_0.25", "s_0.5", "s_0.75", "s_1", "s_1.25", "s_1.5", "s_1.75", "s_2", "s_2.25", "s_2.5", "s_2.75", "s_3",
    "s_3.25",
    "s_3.5", "s_3.75", "s_4", "s_4.25", "s_4.5", "s_4.75", "s_5", "s_5.25", "s_5.5", "s_5.75", "s_6", "s_6.25", "s_6.5",
    "s_6.75",
    "s_7", "s_7.25", "s_7.5", "s_7.75", "s_8", "s_8.25", "s_8.5", "s_8.75", "s_9", "s_9.25", "s_9.5", "s_9.75", "s_10"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const stretch b = block(p);
    const double p1 = stretch_end_stress(sim, 0.8 * p[WIDE]), unit = SCENE_ABS(p1) > 0 ? p1 : 1;
    double *s = row + 7;
    sph_totals o;
    sph_get_totals(sim, &o);
    row[0] = sph_time(sim);
    row[1] = stretch_drawn(p, row[0]);
    row[2] = p1;
    row[3] = o.kinetic;
    row[4] = o.elastic + o.internal;
    int most = 0;
    for (int k = 0; k < STATIONS; k++) {
        const double at[2] = {0.25 * k, 0};
        double t[3] = {0, 0, 0};
        if (at[0] < p[WIDE])
            stretch_sample(sim, &b, at, p[REACH] * b.dx, t);
        s[k] = (t[0] + t[1]) / unit;
        most = s[k] > s[most] ? k : most;
    }
    /* top of the parabola through three stations; the stress is even in x */
    const int last = STATIONS - 1, k = most < last ? most : last - 1;
    const double l = s[k > 0 ? k - 1 : 1], r = s[k + 1], bend = l - 2 * s[k] + r,
        off = bend < 0 ? 0.5 * (l - r) / bend : 0;
    row[5] = s[k] - 0.25 * (l - r) * off;
    row[6] = 0.25 * (k + off);
}

#define scene_chamber SPH_NAME(scene_chamber)
extern const scene scene_chamber;
const scene scene_chamber = {"chamber",
    "stress at the surface above an elliptical chamber in stretched rock (Gray 2001 section 7.3)",
                             param, PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                             history, scene_gray};
#endif
