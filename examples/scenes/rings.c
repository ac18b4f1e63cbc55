/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* rings.c: two elastic rings run into each other and rebound (Swegle 1992; Gray 2001, section 6.1). Radii 3 and 4 cm,
   plane strain, mu 0.22, 50 m/s each; they touch at t = 0. Gray, with the cubic spline, h = 1.5 dx, alpha 0.5 and the
   updated form, found them broken without artificial stress and rebounding with it.
   He prints 5.87e-3 c0 for 50 m/s. At that speed the rings would rebound before their width has changed by a tenth; his
   widths and heights come out at ten times it, 0.0587 c0. Then c0 is 851.8 m/s and 1 cm/c0 is 11.74 microseconds. */
#include "solid.h"
#if SPH_DIM == 2

enum { SPACING = SOLID_COMMON, INNER, OUTER, SPEED, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_WENDLAND_C2, 1.5, 0.1, 0, SPH_KICK_DRIFT_KICK, 0.25, SPH_TOTAL, SPH_NO_ARTIFICIAL_STRESS, 0.22, 0),
    {"dp", "cm", "spacing of the particles", 0.1, 0.005, 0.5, SCENE_NUMBER},
    {"inner", "cm", "inner radius", 3, 0, 1e3, SCENE_NUMBER},
    {"outer", "cm", "outer radius", 4, 0.5, 1e3, SCENE_NUMBER},
    {"speed", "c0", "speed of each", 0.0587, 0, 0.3, SCENE_NUMBER},
    {"duration", "cm/c0", "length of the run", 155, 0, 1e6, SCENE_NUMBER},
};

static void configure(const double *p, sph_config *c)
{
    *c = solid_config(p, p[SPACING]);
    const double lo[2] = {-p[OUTER] - p[SPACING], -p[OUTER] - p[SPACING]}, hi[2] = {-lo[0], -lo[1]};
    c->max_particles = scene_capacity(2 * scene_box_count(lo, hi, p[SPACING]));
    for (int k = 0; k < 2; k++) { /* rings that passed through each other unhindered would still be inside */
        c->hi[k] = (k == 0 ? 3 : 1.5) * p[OUTER] + p[SPEED] * p[DURATION];
        c->lo[k] = -c->hi[k];
    }
    c->max_sets = 2;
    c->max_stretch = 1.6; /* bonds at the inner rims are drawn to more than 1.5 times the support */
}

static sph_status build(sph_sim *sim, const double *p)
{
    for (int side = 0; side < 2; side++) {
        sph_solid m = solid_material(p);
        const double sign = side ? 1 : -1;
        const sph_ellipse rim = {{sign * p[OUTER], 0}, {p[OUTER], p[OUTER]}};
        const sph_ellipse hole = {{sign * p[OUTER], 0}, {p[INNER], p[INNER]}};
        const sph_shape ring = {.outline = &rim, .hole = &hole, .holes = p[INNER] > 0,
                                .velocity = {-sign * p[SPEED], 0}};
        uint32_t set;
        sph_status st;
        m.body = (uint32_t)side;
        if ((st = sph_add_solid(sim, &m, &set, NULL)) != SPH_OK || (st = sph_add_shape(sim, set, &ring)) != SPH_OK)
            return st;
    }
    return SPH_OK;
}

static double end(const double *p) { return p[DURATION]; }

static const char *const column[] = {"time_cm/c0", "time_us", "width_cm", "width_right_cm", "height_cm",
                                     "height_right_cm",
                                     "separation_cm", "momentum_left", "speed_left_c0", "kinetic", "internal",
                                     "elastic",
                                     "dissipated", "energy", "closest_dp"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double far = 1e300;
    double lo[2][2] = {{far, far}, {far, far}}, hi[2][2] = {{-far, -far}, {-far, -far}}, mass = 0, left = 0;
    sph_config c;
    sph_totals o;
    sph_particle q;
    configure(p, &c);
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.set < 2) {
            for (int k = 0; k < 2; k++) {
                lo[q.set][k] = q.x[k] < lo[q.set][k] ? q.x[k] : lo[q.set][k];
                hi[q.set][k] = q.x[k] > hi[q.set][k] ? q.x[k] : hi[q.set][k];
            }
            if (q.set == 0) {
                mass += q.mass;
                left += q.mass * q.v[0];
            }
        }
    row[0] = sph_time(sim);
    row[1] = row[0] * SOLID_MICROSECONDS;
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < 2; k++)
            row[2 + 2 * k + side] = hi[side][k] - lo[side][k] + p[SPACING];
    row[6] = lo[1][0] - hi[0][0] - p[SPACING];
    row[7] = left;
    row[8] = mass > 0 ? left / mass : 0;
    row[9] = o.kinetic;
    row[10] = o.internal;
    row[11] = o.elastic;
    row[12] = o.dissipated;
    row[13] = o.balance;
    row[14] = solid_closest(sim, &c);
}

#define scene_rings SPH_NAME(scene_rings)
extern const scene scene_rings;
const scene scene_rings = {"rings", "two elastic rings collide and rebound (Gray 2001, 6.1)", param,
                           PARAMS, configure, build, end, sizeof column / sizeof *column, column, history, scene_gray};
#endif
