/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* tension.c: an elastic-plastic plate 3 x 1 cm is pulled apart (Gray 2001, section 6.4.1). Its ends of 0.2 cm move
   outwards with an acceleration of 5e-6 c0^2/cm each; mu 0.3, yield stress 0.03. Gray, with the cubic spline, h = 1.5
   dx and the updated form, saw artificial cracks from t 110 on without artificial stress; with it the plate necked from
   t 295 on. */
#include "plate.h"
#if SPH_DIM == 2

enum { PARAMS = PLATE_COMMON };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_WENDLAND_C2, 1.5, 0.1, 0, SPH_KICK_DRIFT_KICK, 0.25, SPH_CORRECTED, SPH_PRINCIPAL, 0.3, 0.03),
    PLATE_PARAMS(60, 5e-6, 0, 400),
};

static void configure(const double *p, sph_config *c)
{
    *c = plate_config(p);
}

static sph_status build(sph_sim *sim, const double *p)
{
    const sph_solid m = solid_material(p);
    const double off = p[PLATE_CLAMP] != 0 ? 0.5 * plate_spacing(p) : 0, face = 0.5 * p[PLATE_LENGTH] - plate_end(p);
    const double inside = face - off, half = off > 0 ? face + off : 0.5 * p[PLATE_LENGTH];
    uint32_t set;
    sph_status st;
    if ((st = plate_add(sim, p, &m, -inside, inside, 0, &set)) != SPH_OK ||
        (st = plate_add(sim, p, &m, -half, -inside, -1, &set)) != SPH_OK)
        return st;
    return plate_add(sim, p, &m, inside, half, 1, &set);
}

static double end(const double *p) { return p[PLATE_DURATION]; }

/* strain: the plate's, both ends' way over its length; gap: the longest stretch of x without a particle, in spacings;
   neck, widest: smallest and largest height of the middle in slices across; pull: mean stress_xx of the middle */
static const char *const column[] = {"time_cm/c0", "strain", "pull", "neck_cm", "widest_cm", "neck_at_cm", "closest_dp",
                                     "gap_dp", "plastic_work", "largest_plastic", "kinetic", "elastic", "internal",
                                     "dissipated", "work", "error_of_energy"};
enum { SLICES = 24, FINE = 600 };

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim), dx = plate_spacing(p), inside = 0.5 * p[PLATE_LENGTH] - plate_end(p) +
        plate_drawn(p, t);
    double low[SLICES], high[SLICES], volume = 0, pull = 0, plastic = 0;
    uint8_t taken[FINE] = {0};
    sph_config c;
    sph_totals o;
    sph_particle q;
    configure(p, &c);
    sph_get_totals(sim, &o);
    for (int k = 0; k < SLICES; k++) {
        low[k] = 1e300;
        high[k] = -1e300;
    }
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.set != 0)
            continue;
        volume += q.mass / q.rho;
        pull += q.mass / q.rho * q.stress[0];
        plastic = q.plastic > plastic ? q.plastic : plastic;
        const double s = (q.x[0] + inside) / (2 * inside);
        if (!(s >= 0 && s < 1))
            continue;
        const int k = (int)(s * SLICES);
        low[k] = q.x[1] < low[k] ? q.x[1] : low[k];
        high[k] = q.x[1] > high[k] ? q.x[1] : high[k];
        taken[(int)(s * FINE)] = 1;
    }
    int neck = 0, widest = 0, run = 0, longest = 0;
    double height[SLICES];
    for (int k = 0; k < SLICES; k++) {
        height[k] = high[k] >= low[k] ? high[k] - low[k] + dx : 0;
        neck = height[k] < height[neck] ? k : neck;
        widest = height[k] > height[widest] ? k : widest;
    }
    for (int k = 0; k < FINE; k++) {
        run = taken[k] ? 0 : run + 1;
        longest = run > longest ? run : longest;
    }
    row[0] = t;
    row[1] = 2 * plate_drawn(p, t) / p[PLATE_LENGTH];
    row[2] = volume > 0 ? pull / volume : 0;
    row[3] = height[neck];
    row[4] = height[widest];
    row[5] = ((neck + 0.5) / SLICES * 2 - 1) * inside;
    row[6] = solid_closest(sim, &c);
    row[7] = (longest + 1) * 2 * inside / FINE / dx;
    row[8] = o.plastic_work;
    row[9] = plastic;
    row[10] = o.kinetic;
    row[11] = o.elastic;
    row[12] = o.internal;
    row[13] = o.dissipated;
    row[14] = o.wall_work;
    row[15] = o.balance;
}

#define scene_tension SPH_NAME(scene_tension)
extern const scene scene_tension;
const scene scene_tension = {"tension", "an elastic-plastic plate is pulled apart (Gray 2001, 6.4.1)", param,
                             PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                             history, scene_gray};
#endif
