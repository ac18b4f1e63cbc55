/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bar.c: a bar that waves leave through its right end (Powell 2012 section 3.1, eq 2.68). E 2.1, rho 7.8 (g, cm, us),
   so sound goes at 0.5189 cm/us; 1 cm in 100 particles, the left end free, the first 35 at +v, the others at -v, v 0.01
   cm/us. Exact (d'Alembert): at x = 0.795 cm v is -0.01 but for 0.858 < t < 2.207 us, where it is 0; the printed table
   2.1 is the mean of |v - exact|/|exact| there over 3 .. 20 us. */
#include "edged.h"
#if SPH_DIM == 1

enum { N = SOLID_COMMON, SPEED, EDGED, DURATION = EDGED + EDGED_PARAMS, PARAMS };
#define BAR_C 0.518874522 /* cm/us */

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_CUBIC, 1.3, 0, 0, SPH_KICK_DRIFT_KICK, 0.3, SPH_CORRECTED, SPH_NO_ARTIFICIAL_STRESS, 0, 0),
    {"n", "-", "particles of 0.01 cm; of a long bar the free right end is not seen", 100, 90, 100000, SCENE_WHOLE},
    {"speed", "cm/us", "of both parts", 0.01, 1e-9, 0.1, SCENE_NUMBER},
    EDGED_PARAM_ROWS(SPH_EDGE_NATURAL, 0, 3e-3),
    {"duration", "us", "length of the run", 20, 0, 1e6, SCENE_NUMBER},
};

static void configure(const double *p, sph_config *c)
{
    *c = solid_config(p, 0.01);
    c->max_particles = scene_capacity(p[N]);
    c->lo[0] = -2;
    c->hi[0] = 0.01 * p[N] + 2;
    edged_configure(p, EDGED, 0.01, c);
}

static void field(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    (void)rho;
    v[0] = (x[0] < 0.35 ? p[SPEED] : -p[SPEED]) / BAR_C;
}

static sph_status build(sph_sim *sim, const double *p)
{
    const sph_solid m = solid_material(p);
    const double lo[1] = {0}, hi[1] = {0.01 * p[N]};
    const sph_edges e = {.faces = SPH_HIGH(0), .velocity = {-p[SPEED] / BAR_C}};
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

static double end(const double *p) { return p[DURATION] * BAR_C; }

static const char *const column[] = {"time_cm/c0", "time_us", "v_cm/us", "exact_cm/us", "error_%", "absorbed_K.cm"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    sph_particle q;
    sph_totals o;
    sph_get_totals(sim, &o);
    row[0] = sph_time(sim);
    row[1] = row[0] / BAR_C;
    row[2] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.id == 79)
            row[2] = q.v[0] * BAR_C;
    row[3] = row[1] > 0.857625 && row[1] < 2.206699 ? 0 : -p[SPEED];
    row[4] = 100 * SCENE_ABS(row[2] - row[3]) / p[SPEED];
    row[5] = o.absorbed;
}

#define scene_bar SPH_NAME(scene_bar)
extern const scene scene_bar;
const scene scene_bar = {"bar", "a bar that waves leave through one end (Powell 2012, 3.1)", param, PARAMS, configure,
                         build, end, sizeof column / sizeof *column, column, history, scene_gray};
#endif
