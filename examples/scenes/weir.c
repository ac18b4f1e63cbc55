/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* weir.c: a stream of depth H on a bed flows over a vertical plate of height w H without gravity, and leaves as a free
   jet (Gray 2001 section 3.5; Dias & Tuck 1991). On the free streamlines the speed is that of the stream, U. In the
   plane of the velocity, q = |u|/U, the flow is a source at 1 and a sink at exp(-i theta) in a quarter of a disc; the
   length of its straight side is the plate's:
     w(theta) = (4/pi) integral 0 .. 1 of [1/(1 + q^2) - (q^2 + c)/(q^4 + 2 c q^2 + 1)] dq,  c = cos 2 theta
   The stream is fed by an inflow; what leaves the domain is removed. The history has the jet's angle by a line
   through the places of its particles and by their mean velocity, from 2 to 4 depths off the plate's edge. */
#include "scene.h"
#if SPH_DIM == 2

enum { W = SCENE_COMMON, DEPTH, N, SPEED, LENGTH, SOUND, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 1.2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_MOLTENI, SCENE_ADAMI, 1, 0, 0,
                    SPH_KICK_DRIFT_KICK, 0.5, 1),
    {"w", "depth", "height of the plate", 1, 0.05, 10, SCENE_NUMBER},
    {"depth", "m", "depth of the stream", 0.3, 1e-6, 1e4, SCENE_NUMBER},
    {"n", "-", "particles across the stream", 20, 4, 1000, SCENE_WHOLE},
    {"speed", "m/s", "of the stream", 0.5, 1e-9, 1e4, SCENE_NUMBER},
    {"length", "depth", "of the stream before the plate", 5, 1, 100, SCENE_NUMBER},
    {"sound", "speed", "sound speed", 10, 2, 1000, SCENE_NUMBER},
    {"duration", "depth/speed", "length of the run; angles are of its last third", 15, 0.1, 1e4, SCENE_NUMBER},
};

enum { REACH = 5 }; /* depths of jet in the domain */

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double whole(const double *p, double depths) /* a whole number of spacings, m */
{
    return (double)(uint32_t)(depths * p[N] + 0.999999) * spacing(p);
}
/* length of the inflow's box: the kernel's support */
static double feed(const double *p)
{
    return whole(p, sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] / p[N]);
}
static double upstream(const double *p) { return whole(p, p[LENGTH]); }
static double end(const double *p) { return p[DURATION] * p[DEPTH] / p[SPEED]; }

/* height of the plate in depths for an angle (rad), by Simpson's rule */
static double height_of(double theta)
{
    enum { PARTS = 2000 };
    const double c = sph_cos(2 * theta);
    double sum = 0;
    for (int i = 0; i <= PARTS; i++) {
        const double q = (double)i / PARTS, q2 = q * q;
        const double f = 1 / (1 + q2) - (q2 + c) / (q2 * q2 + 2 * c * q2 + 1);
        sum += f * (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2);
    }
    return 4 / SCENE_PI * sum / (3 * PARTS);
}
static double angle_of(double w)
{
    double low = 0, high = 0.4999 * SCENE_PI;
    for (int i = 0; i < 50; i++) {
        const double mid = 0.5 * (low + high);
        if (height_of(mid) < w)
            low = mid;
        else
            high = mid;
    }
    return low;
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[2] = {-upstream(p) - feed(p), 0};
    const double jet[2] = {REACH * p[DEPTH], (p[W] + REACH) * p[DEPTH]};
    const double water[2] = {0, (1 + 0.5 * p[W]) * p[DEPTH]}, flight[2] = {jet[0] + jet[1], p[DEPTH]}, none[2] = {0, 0};
    const double plate[2] = {0, whole(p, p[W])};
    *c = scene_config(p, dx, 1000, p[SOUND] * p[SPEED]);
    c->on_leave = SPH_REMOVE;
    c->max_flows = 1;
    c->lo[0] = lo[0] - m;
    c->lo[1] = -m;
    c->hi[0] = jet[0];
    c->hi[1] = jet[1];
    c->max_particles = scene_capacity(scene_box_count(lo, water, dx) + scene_box_count(none, flight, dx) +
                                      scene_wall_count(p, lo, plate, dx, SPH_LOW(1) | SPH_HIGH(0)) +
                                      2 * m * m / (dx * dx));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double from = -upstream(p), lo[2] = {from - feed(p), 0}, plate[2] = {0, whole(p, p[W])};
    const double stream[2] = {from, 0}, front[2] = {-spacing(p), p[DEPTH]}, v[2] = {p[SPEED], 0};
    const sph_flow in = {.lo = {lo[0], 0}, .hi = {from, p[DEPTH]}, .face = SPH_HIGH(0), .speed = p[SPEED]};
    uint32_t water, fed;
    sph_status st = sph_add_fluid(sim, NULL, &water);
    st = st ? st : sph_add_inflow(sim, water, &in, &fed);
    st = st ? st : sph_add_box(sim, water, stream, front, v);
    const double bed[2] = {scene_margin(p, spacing(p)), 1}, foot[2] = {from, 0}, root[2] = {0, 0};
    sph_wall w = scene_wall(p);
    st = st ? st : scene_add_tank(sim, p, lo, bed, spacing(p), SPH_LOW(1));
    /* The plate has no thickness for the jet, which passes over its layers: it acts on what is before it, and between
       bed and edge only. With SPH_FRONT its layers push what passes above the edge, too, with the pressure below: then
       the edge is felt two spacings too high, at w 0.25 and n 20 by 6 degrees of the jet. */
    const bool layers = p[SCENE_WALL] >= SCENE_GHOST && !w.compressible;
    w.side = layers ? SPH_FACE : SPH_BOTH_SIDES;
    if (!st && layers)
        return sph_add_wall_segment(sim, &w, root, plate, NULL);
    return st ? st : sph_add_wall_box(sim, &w, foot, plate, SPH_HIGH(0), true, NULL);
}

static const char *const column[] = {"time_s", "angle_deg", "angle_of_velocity_deg", "angle_exact_deg",
                                     "jet_particles_-", "mass_kg/m", "added_kg/m", "removed_kg/m"};

/* the mean velocity of what is 2 to 4 depths off the plate's edge and goes away from it; returns how many */
static double find_jet(const sph_sim *sim, const double *p, double *v)
{
    const double edge = whole(p, p[W]);
    double n = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID)
            continue;
        const double x = q.x[0] / p[DEPTH], y = (q.x[1] - edge) / p[DEPTH], r2 = x * x + y * y;
        if (r2 < 4 || r2 > 16 || x < -1 || y < 0 || !(q.v[0] * x + q.v[1] * y > 0))
            continue;
        n++;
        v[0] += q.v[0];
        v[1] += q.v[1];
    }
    return n;
}

static double degrees(const double *v) { return sph_atan2(v[1], v[0]) * 180 / SCENE_PI; }

/* The jet's line by its places: of the slices s = 2 .. 3 and 3 .. 4 depths from the edge along its velocity, the one
   through their middles; then the same with slices along that line. Slices across the jet lie evenly about it, whatever
   its middle's distance from the edge. Returns false where a slice is empty. */
static bool fit_line(const sph_sim *sim, const double *p, double *along)
{
    const double edge = whole(p, p[W]), size = __builtin_sqrt(along[0] * along[0] + along[1] * along[1]);
    double n[2] = {0, 0}, x[2] = {0, 0}, y[2] = {0, 0};
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID)
            continue;
        const double dx = q.x[0] / p[DEPTH], dy = (q.x[1] - edge) / p[DEPTH];
        const double s = (dx * along[0] + dy * along[1]) / size, across = (dx * along[1] - dy * along[0]) / size;
        if (s < 2 || s > 4 || across < -2 || across > 2)
            continue;
        n[s > 3]++;
        x[s > 3] += dx;
        y[s > 3] += dy;
    }
    if (!(n[0] > 0 && n[1] > 0))
        return false;
    along[0] = x[1] / n[1] - x[0] / n[0];
    along[1] = y[1] / n[1] - y[0] / n[0];
    return true;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    double v[2] = {0, 0};
    sph_totals o;
    row[4] = find_jet(sim, p, v);
    double line[2] = {v[0], v[1]};
    const bool fits = row[4] > 0 && fit_line(sim, p, line) && fit_line(sim, p, line);
    sph_get_totals(sim, &o);
    row[0] = sph_time(sim);
    row[1] = fits ? degrees(line) : 0;
    row[2] = row[4] > 0 ? degrees(v) : 0;
    row[3] = angle_of(p[W]) * 180 / SCENE_PI;
    row[5] = o.mass;
    row[6] = o.added_mass;
    row[7] = o.removed_mass;
}

#define scene_weir SPH_NAME(scene_weir)
extern const scene scene_weir;
const scene scene_weir = {"weir", "a stream flows over a plate and leaves as a jet (Gray 2001 section 3.5)", param,
                          PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                          history, scene_si};
#endif
