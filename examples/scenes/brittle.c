/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* brittle.c: a plate 3 x 1 cm with flaws is pulled apart and cracks (Gray 2001, section 6.4.2). The ends of 0.2 cm have
   no flaws, and only the outermost particles are moved, at a steady speed: 5e-4, 1e-3 and 5e-3 c0 give strain rates of
   3.33e-4, 6.67e-4 and 3.33e-3. Flaws k 1.4e19 /cm^2, m 8.5; cracks grow at 0.4 c0. */
#include "plate.h"
#if SPH_DIM == 2

enum { DAMAGE = PLATE_COMMON, WEIBULL_K, WEIBULL_M, SEED, CRACK_SPEED, PARAMS };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_WENDLAND_C2, 1.5, 0.5, 0, SPH_KICK_DRIFT_KICK, 0.25, SPH_CORRECTED, SPH_PRINCIPAL, 0.3, 0.03),
    PLATE_PARAMS(60, 0, 5e-4, 30),
    {"damage", "-", "cracks: no yes", 1, 0, 1, SCENE_CHOICE},
    {"k", "/cm^2", "flaws of a strain below 1 in a unit of area", 1.4e19, 1, 1e40, SCENE_NUMBER},
    {"m", "-", "Weibull's exponent", 8.5, 1, 50, SCENE_NUMBER},
    {"seed", "-", "of the flaws", 1, 0, 4294967295.0, SCENE_WHOLE},
    {"crack_speed", "c0", "speed at which cracks grow", 0.4, 1e-3, 10, SCENE_NUMBER},
};

static void configure(const double *p, sph_config *c)
{
    *c = plate_config(p);
    if (p[DAMAGE] != 0) {
        const double n = c->max_particles;
        c->damage = p[SOLID_PRINTED] != 0 ? SPH_BENZ_ASPHAUG_GRAY : SPH_BENZ_ASPHAUG;
        c->max_flaws = scene_capacity(2 * n * (sph_log(n) + 4)); /* twice what is usual */
    }
}

static sph_status build(sph_sim *sim, const double *p)
{
    sph_solid m = solid_material(p);
    const double dx = plate_spacing(p), off = p[PLATE_CLAMP] != 0 ? 0.5 * dx : 0; /* ideal: half a spacing outwards */
    const double half = 0.5 * p[PLATE_LENGTH] + off, inside = half - 2 * off - plate_end(p);
    uint32_t middle, set;
    sph_status st;
    m.crack_speed = p[CRACK_SPEED];
    if ((st = plate_add(sim, p, &m, -inside, inside, 0, &middle)) != SPH_OK)
        return st;
    for (int side = -1; side <= 1; side += 2) {
        const double edge = half - dx, a = side < 0 ? -half : edge, b = side < 0 ? -edge : half;
        if ((st = plate_add(sim, p, &m, a, b, side, &set)) != SPH_OK)
            return st;
        if (inside < edge - 0.5 * dx &&
            (st = plate_add(sim, p, &m, side < 0 ? -edge : inside, side < 0 ? -inside : edge, 0, &set)) != SPH_OK)
            return st;
    }
    if (p[DAMAGE] == 0)
        return SPH_OK;
    const sph_flaws flaws = {p[WEIBULL_K], p[WEIBULL_M], (uint64_t)p[SEED]};
    return sph_add_flaws(sim, middle, &flaws);
}

static double end(const double *p) { return p[PLATE_DURATION]; }

/* pull: mean stress_xx of the middle; broken: share of the middle with D > 0.99; crack_*: extent in x and y of those */
static const char *const column[] = {"time_cm/c0", "strain", "pull", "largest_stress", "damage_mean", "broken",
                                     "crack_left_cm",
                                     "crack_right_cm", "crack_low_cm", "crack_high_cm", "closest_dp", "kinetic",
                                     "elastic",
                                     "internal", "dissipated", "work"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim);
    double volume = 0, pull = 0, largest = 0, damage = 0, lo[2] = {0, 0}, hi[2] = {0, 0};
    uint32_t n = 0, broken = 0;
    sph_config c;
    sph_totals o;
    sph_particle q;
    configure(p, &c);
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.set != 0)
            continue;
        n++;
        volume += q.mass / q.rho;
        pull += q.mass / q.rho * q.stress[0];
        damage += q.damage;
        const double middle = 0.5 * (q.stress[0] + q.stress[1]), half = 0.5 * (q.stress[0] - q.stress[1]),
            xy = q.stress[3];
        const double most = middle + __builtin_sqrt(half * half + xy * xy);
        largest = most > largest ? most : largest;
        if (q.damage > 0.99) {
            for (int k = 0; k < 2; k++) {
                lo[k] = broken == 0 || q.x[k] < lo[k] ? q.x[k] : lo[k];
                hi[k] = broken == 0 || q.x[k] > hi[k] ? q.x[k] : hi[k];
            }
            broken++;
        }
    }
    row[0] = t;
    row[1] = 2 * plate_drawn(p, t) / p[PLATE_LENGTH];
    row[2] = volume > 0 ? pull / volume : 0;
    row[3] = largest;
    row[4] = n ? damage / n : 0;
    row[5] = n ? (double)broken / n : 0;
    for (int k = 0; k < 2; k++) {
        row[6 + 2 * k] = lo[k];
        row[7 + 2 * k] = hi[k];
    }
    row[10] = solid_closest(sim, &c);
    row[11] = o.kinetic;
    row[12] = o.elastic;
    row[13] = o.internal;
    row[14] = o.dissipated;
    row[15] = o.wall_work;
}

#define scene_brittle SPH_NAME(scene_brittle)
extern const scene scene_brittle;
const scene scene_brittle = {"brittle", "a brittle plate is pulled apart and cracks (Gray 2001, 6.4.2)", param,
                             PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                             history, scene_gray};
#endif
