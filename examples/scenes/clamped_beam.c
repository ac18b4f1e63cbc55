/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* clamped_beam.c: the middle of a beam that is held at both ends is struck (Powell 2012 section 4.4.3): 0.4 cm of it
   begin at 0.3 cm/us downwards. Material and units: two_blocks.c. His size is lost: 4.0 x 0.4 cm, held for 0.1 cm at
   each end, that of the finite elements (tests/refdata/powell_clamped_beam.csv). */
#include "solid.h"
#if SPH_DIM == 2

#define C0 0.473670 /* cm/us */
enum { N = SOLID_COMMON, SPEED, END, PARAMS };
#define LENGTH 4.0
#define HEIGHT 0.4
#define HELD 0.1
#define STRUCK 0.2 /* cm, half */

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_CUBIC, 1.3, 0.5, 0, SPH_KICK_DRIFT_KICK, 0.3, SPH_STABILISED, SPH_NO_ARTIFICIAL_STRESS, 0.4615385,
                 0),
    {"n", "-", "particles across the beam, a multiple of 4", 20, 4, 400, SCENE_WHOLE},
    {"speed", "c0", "of the middle", 0.3 / C0, 0, 10, SCENE_NUMBER},
    {"us", "us", "how long", 15, 0, 1e4, SCENE_NUMBER},
};

static double spacing(const double *p) { return HEIGHT / p[N]; }
/* Columns stand at multiples of the spacing, one of them in the middle, and as nodes do one on each clamp's face and on
   each end of what is struck, with half its velocity: held centres that stand half a spacing behind the face let the
   displacement vanish further behind it yet (solid.h), and the beam would be longer than the finite elements'. */
static uint32_t half_columns(const double *p) { return (uint32_t)(0.5 * LENGTH / spacing(p) + 0.5); }
static uint32_t columns_of(const double *p) { return 2 * half_columns(p) + 1; }
static double struck_share(double x, double dx)
{
    const double inside = (STRUCK - SCENE_ABS(x)) / dx + 0.5;
    return inside < 0.25 ? 0 : inside < 0.75 ? 0.5 : 1;
}

static void configure(const double *p, sph_config *c)
{
    *c = solid_config(p, spacing(p));
    c->lo[0] = -2.5;
    c->hi[0] = 2.5;
    c->lo[1] = -2.5;
    c->hi[1] = 1.5;
    c->max_particles = scene_capacity((double)columns_of(p) * p[N]);
    c->max_stretch = 4;
}

/* first the free particles, column by column, then those that are held */
static sph_status build(sph_sim *sim, const double *p)
{
    sph_solid m = solid_material(p);
    sph_status st = SPH_OK;
    for (int held = 0; held < 2 && !st; held++) {
        uint32_t set;
        m.held = held ? 3 : 0;
        st = sph_add_solid(sim, &m, &set, NULL);
        for (uint32_t i = 0; !st && i < columns_of(p) * (uint32_t)p[N]; i++) {
            const uint32_t column = i / (uint32_t)p[N];
            const double x[2] = {((double)column - half_columns(p)) * spacing(p),
                                 (i % (uint32_t)p[N] + 0.5) * spacing(p)};
            const double v[2] = {0, -p[SPEED] * struck_share(x[0], spacing(p))};
            if ((SCENE_ABS(x[0]) > 0.5 * LENGTH - HELD - 0.25 * spacing(p)) == (held != 0))
                st = sph_add_particle(sim, set, x, held ? NULL : v, 0, NULL);
        }
    }
    return st;
}

static double end(const double *p) { return p[END] * C0; }

/* uy_bottom, uy_top: displacement of the middle's outermost particles below and above (cm) */
static const char *const column[] = {"time", "us", "uy_bottom", "uy_top", "kinetic", "energy", "closest_dp"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const uint32_t n = (uint32_t)p[N], held = (uint32_t)(HELD / spacing(p) + 1.5);
    double bottom = 0, top = 0;
    sph_config c;
    sph_totals o;
    sph_particle q;
    configure(p, &c);
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.set != 0)
            continue;
        if (q.id / n + held != half_columns(p))
            continue;
        if (q.id % n == 0)
            bottom = q.x[1] - 0.5 * spacing(p);
        if (q.id % n == n - 1)
            top = q.x[1] - HEIGHT + 0.5 * spacing(p);
    }
    row[0] = sph_time(sim);
    row[1] = row[0] / C0;
    row[2] = bottom;
    row[3] = top;
    row[4] = o.kinetic;
    row[5] = o.kinetic + o.elastic + o.internal;
    row[6] = solid_closest(sim, &c);
}

#define scene_clamped_beam SPH_NAME(scene_clamped_beam)
extern const scene scene_clamped_beam;
const scene scene_clamped_beam = {"clamped_beam",
    "the middle of a beam that is held at both ends is struck (Powell 2012, 4.4.3)", param,
                                  PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                  history, scene_gray};
#endif
