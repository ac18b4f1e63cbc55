/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* hole.c: a circular hole in a square block whose ends are drawn apart (Gray 2001 section 6.5): how much the hole
   raises the stress. 7 by 7 cm, a^2 = 0.3125 cm^2, 140 by 140 particles; a quarter of it is modelled, between two
   mirror planes. The ends are drawn and stopped, and damping brings all to rest. Stress is sxx + syy over p1, the mean
   sxx across the block: 1 - 2 cos 2 theta on the rim in an infinite plate, 3.0546 at the top in this block
   (tests/refdata/fe_hole.csv). */
#include "stretch.h"
#if SPH_DIM == 2

enum { N = STRETCH_COMMON, SIZE, SQUARE, SKIP, OUT, LATTICE, SETTLE, PARAMS };
#define STATIONS 19 /* on the quarter of the rim, every 5 degrees */

static const scene_param param[PARAMS] = {
    SOLID_PARAMS_DAMPED(SPH_WENDLAND_C2, 1.5, 0, 0, SPH_KICK_DRIFT_KICK, 0.4, SPH_CORRECTED, SPH_NO_ARTIFICIAL_STRESS,
                        0.5,
                        0, 0.99),
    STRETCH_PARAMS(5e-6, 7, 20),
    {"n", "-", "particles across the block, an even number", 140, 20, 4000, SCENE_WHOLE},
    {"size", "cm", "edge of the block", 7, 0.1, 1e3, SCENE_NUMBER},
    {"square", "cm^2", "radius of the hole, squared", 0.3125, 1e-6, 1e5, SCENE_NUMBER},
    {"skip", "dx", "the fit that takes the stress to the rim leaves out what is nearer", 1, 0, 10, SCENE_NUMBER},
    {"fit", "a", "radius to which that fit goes", 3, 1.5, 6, SCENE_NUMBER},
    {"lattice", "-", "square right up to the hole, which then has steps, or bent round it: square bent", 1, 0, 1,
     SCENE_CHOICE},
    {"settle", "cm/c0", "how long the block comes to rest after the pull", 30, 0, 1e6, SCENE_NUMBER},
};

static stretch block(const double *p)
{
    const double a = __builtin_sqrt(p[SQUARE]), dx = p[SIZE] / p[N];
    return (stretch){.lo = {0, 0}, .hi = {p[SIZE] / 2, p[SIZE] / 2}, .dx = dx, .room = 0.02 * p[SIZE] + 4 * dx,
                     .half = true,
                     .quarter = true, .has_hole = true, .hole = {{0, 0}, {a, a}}, .bent = p[LATTICE] != 0};
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

static const char *const column[] = {"time", "drawn_cm", "p1_K", "kinetic", "elastic", "peak_particle", "peak_rim",
                                     "at_deg",
                                     "rim_0", "rim_5", "rim_10", "rim_15", "rim_20", "rim_25", "rim_30", "rim_35",
                                     "rim_40", "rim_45",
                                     "rim_50", "rim_55", "rim_60", "rim_65", "rim_70", "rim_75", "rim_80", "rim_85",
                                     "rim_90"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const stretch b = block(p);
    const double a = b.hole.radius[0], p1 = stretch_end_stress(sim, 2 * a), unit = SCENE_ABS(p1) > 0 ? p1 : 1;
    sph_totals o;
    sph_get_totals(sim, &o);
    row[0] = sph_time(sim);
    row[1] = stretch_drawn(p, row[0]);
    row[2] = p1;
    row[3] = o.kinetic;
    row[4] = o.elastic + o.internal;
    row[5] = stretch_peak(sim) / unit;
    row[6] = row[7] = 0;
    stretch_rim(sim, &b, p[SKIP] * b.dx, p[OUT] * a, STATIONS, row + 8);
    for (int k = 0; k < STATIONS; k++) {
        row[8 + k] /= unit;
        if (row[8 + k] > row[6]) {
            row[6] = row[8 + k];
            row[7] = 5 * k;
        }
    }
}

#define scene_hole SPH_NAME(scene_hole)
extern const scene scene_hole;
const scene scene_hole = {"hole", "stress around a circular hole in a stretched block (Gray 2001 section 6.5)", param,
                          PARAMS, configure, build, end, sizeof column / sizeof *column, column, history, scene_gray};
#endif
