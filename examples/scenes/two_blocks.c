/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* two_blocks.c: the halves of one block are driven together or apart (Powell 2012 section 4.4.1, his figure 4.5), or
   the end of a bar into the rest of it (4.4.2). rho 7.8 g/cm^3, Young's modulus 2.1 (g, cm, us), Poisson's ratio 0.3:
   K 1.75, mu 0.46154 K, c0 0.47367 cm/us; 0.06 cm/us is 0.12667 c0. The sizes of his block are lost: 1.0 x 0.4 cm, that
   of the finite elements (tests/refdata/powell_impact_*.csv); particle A stands 0.1 cm above the middle. The bar: 2.0 x
   0.2 cm, of which a quarter moves. */
#include "solid.h"
#if SPH_DIM == 2

#define C0 0.473670 /* cm/us */
enum { KIND = SOLID_COMMON, N, SPEED, END, PARAMS };
enum { TOGETHER, APART, BAR };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_CUBIC, 1.3, 0.5, 0, SPH_KICK_DRIFT_KICK, 0.4, SPH_STABILISED, SPH_NO_ARTIFICIAL_STRESS, 0.4615385,
                 0),
    {"kind", "-", "what is done: together apart bar", TOGETHER, 0, 2, SCENE_CHOICE},
    {"n", "-", "particles across the block, an even number", 40, 4, 1000, SCENE_WHOLE},
    {"speed", "c0", "of each half; of the bar's end twice that", 0.06 / C0, 0, 10, SCENE_NUMBER},
    {"us", "us", "how long", 10, 0, 1e4, SCENE_NUMBER},
};

static bool is_bar(const double *p) { return (uint32_t)p[KIND] == BAR; }
static double width(const double *p) { return is_bar(p) ? 2.0 : 1.0; }
static double height(const double *p) { return is_bar(p) ? 0.2 : 0.4; }
static double spacing(const double *p) { return height(p) / p[N]; }
static uint32_t columns_of(const double *p) { return (uint32_t)(width(p) / spacing(p) + 0.5); }

/* where particle `id` began */
static void place(const double *p, uint32_t id, double *x)
{
    const uint32_t n = columns_of(p);
    const uint32_t row = id / n;
    x[0] = (id % n + 0.5) * spacing(p) - 0.5 * width(p);
    x[1] = (row + 0.5) * spacing(p) - 0.5 * height(p);
}

static void configure(const double *p, sph_config *c)
{
    *c = solid_config(p, spacing(p));
    for (uint32_t k = 0; k < 2; k++) {
        c->lo[k] = k == 0 && is_bar(p) ? -4 : -2;
        c->hi[k] = -c->lo[k];
    }
    c->max_particles = scene_capacity((double)columns_of(p) * p[N]);
    c->max_stretch = 3;
}

static sph_status build(sph_sim *sim, const double *p)
{
    const sph_solid m = solid_material(p);
    const double sign = (uint32_t)p[KIND] == APART ? -1 : 1;
    uint32_t set;
    sph_status st = sph_add_solid(sim, &m, &set, NULL);
    for (uint32_t id = 0; !st && id < columns_of(p) * (uint32_t)p[N]; id++) {
        double x[2], v[2] = {0, 0};
        place(p, id, x);
        if (is_bar(p))
            v[0] = x[0] < -0.25 * width(p) ? 2 * p[SPEED] : 0;
        else
            v[1] = x[1] > 0 ? -sign * p[SPEED] : sign * p[SPEED];
        st = sph_add_particle(sim, set, x, v, 0, NULL);
    }
    return st;
}

static double end(const double *p) { return p[END] * C0; }

/* kinetic_share: of the energy at the start; p_A, speed_A, uy_A: pressure (K), speed (c0) and displacement (cm) of the
   four particles about A, mean; length: of the bar or block along x (cm); fragments: parts of it between gaps of more
   than three spacings, counted along the axis of motion */
static const char *const column[] = {"time", "us", "kinetic_share", "p_A", "speed_A", "uy_A", "length", "closest_dp",
                                     "gap_dp", "kinetic", "energy"};

static double longest_gap(const sph_sim *sim, const double *p, uint32_t axis, double *length)
{
    enum { FINE = 4000 };
    uint8_t taken[FINE] = {0};
    double low = 1e30, high = -1e30;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK) {
            low = q.x[0] < low ? q.x[0] : low;
            high = q.x[0] > high ? q.x[0] : high;
            const int at = (int)((q.x[axis] + 4) / 8 * FINE);
            if (at >= 0 && at < FINE)
                taken[at] = 1;
        }
    *length = high - low + spacing(p);
    int first = 0, last = FINE - 1, run = 0, longest = 0;
    while (first < FINE && !taken[first])
        first++;
    while (last > 0 && !taken[last])
        last--;
    for (int k = first; k < last; k++) {
        run = taken[k] ? 0 : run + 1;
        longest = run > longest ? run : longest;
    }
    return (longest + 1) * 8.0 / FINE / spacing(p);
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim), dx = spacing(p), at[2] = {0, is_bar(p) ? 0 : 0.1};
    double press = 0, v[2] = {0, 0}, uy = 0, n = 0, x[2];
    sph_config c;
    sph_totals o;
    sph_particle q;
    configure(p, &c);
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK)
            continue;
        place(p, q.id, x);
        if (SCENE_ABS(x[0] - at[0]) > 0.75 * dx || SCENE_ABS(x[1] - at[1]) > 0.75 * dx)
            continue;
        press += q.p;
        v[0] += q.v[0];
        v[1] += q.v[1];
        uy += q.x[1] - x[1];
        n++;
    }
    n = n > 0 ? n : 1;
    const double moving = is_bar(p) ? 0.25 * 4 : 1, start = 0.5 * o.mass * moving * p[SPEED] * p[SPEED];
    row[0] = t;
    row[1] = t / C0;
    row[2] = start > 0 ? o.kinetic / start : 0;
    row[3] = press / n;
    row[4] = __builtin_sqrt(v[0] * v[0] + v[1] * v[1]) / n;
    row[5] = uy / n;
    row[8] = longest_gap(sim, p, is_bar(p) ? 0 : 1, &row[6]);
    row[7] = solid_closest(sim, &c);
    row[9] = o.kinetic;
    row[10] = o.kinetic + o.elastic + o.internal;
}

#define scene_two_blocks SPH_NAME(scene_two_blocks)
extern const scene scene_two_blocks;
const scene scene_two_blocks = {"two_blocks",
    "the halves of a block are driven together or apart, or the end of a bar into it (Powell 2012, 4.4)",
                                param, PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                history, scene_gray};
#endif
