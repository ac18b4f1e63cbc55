/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* flap.c: regular waves made by a flap, and what a beach gives back of them. The flap turns about a hinge a below the
   bed (Wickramarachchi 2009, 6.9): its face goes by

     x(y, t) = (y + a)/(D + a) s(t)/2,   s = S sin(w t), from rest over the first two periods

   S the stroke at still water. The face is made of rows of particles that each keep their height, held together in
   slabs of whole spacings, at most SLABS; each slab moves as the face does at its middle, from where it rests, so that
   nothing adds up. Linear theory of wave makers: a face that goes by S/2 (alpha + (1 - alpha) y/D), alpha = a/(D + a),
   makes waves of height

     H = S [alpha 2 (cosh 2k - 1) + (1 - alpha) 4 (sinh k/k) (k sinh k - cosh k + 1)]/(sinh 2k + 2k),  w^2 = k tanh k

   k in 1/D, w in sqrt(g/D). Three gauges in mid-tank show what comes and what the beach gives back. */
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, STROKE, PERIOD, HINGE, FLAT, SLOPE, N, GRAVITY, SOUND, PERIODS, PARAMS };
enum { SLABS = 12 };
#define HIGH 1.5 /* top of the flap, depths */

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.001, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.9, 1),
    {"depth", "m", "depth of the water at rest", 0.3, 1e-4, 1e4, SCENE_NUMBER},
    {"stroke", "depth", "of the flap at still water, from end to end", 0.15, 0, 1, SCENE_NUMBER},
    {"period", "sqrt(D/g)", "of the flap", 7.2, 1, 1000, SCENE_NUMBER},
    {"hinge", "depth", "how far the hinge is below the bed; large: a piston", 0, 0, 1e6, SCENE_NUMBER},
    {"flat", "depth", "length of the flat bed", 19, 4, 1000, SCENE_NUMBER},
    {"slope", "-", "how far the beach goes for a rise of 1", 6, 1, 1000, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 12, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 10, 2, 1000, SCENE_NUMBER},
    {"periods", "-", "length of the run", 11, 0, 1e6, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double unit_time(const double *p) { return __builtin_sqrt(p[DEPTH] / p[GRAVITY]); }
static double end(const double *p) { return p[PERIODS] * p[PERIOD] * unit_time(p); }
static double omega(const double *p) { return 2 * SCENE_PI / p[PERIOD]; }
/* spacings in a slab */
static double rows(const double *p) { return (double)(uint32_t)(HIGH * p[N] / SLABS + 0.999999); }
static double slabs(const double *p) { return (double)(uint32_t)(HIGH * p[N] / rows(p) + 0.999999); }
/* height of slab k's middle, m */
static double middle(const double *p, uint32_t k) { return (k + 0.5) * rows(p) * spacing(p); }

static double wave_number(const double *p)
{
    const double w2 = omega(p) * omega(p);
    double low = 0, high = w2 + 1 / (w2 + 1e-9) + 1e3;
    for (int i = 0; i < 200; i++) {
        const double k = 0.5 * (low + high);
        *(k * sph_tanh(k) < w2 ? &low : &high) = k;
    }
    return low;
}
/* height of the waves by linear theory, D */
static double height(const double *p)
{
    const double k = wave_number(p), up = sph_exp(k), sinh = 0.5 * (up - 1 / up), cosh = 0.5 * (up + 1 / up);
    const double alpha = p[HINGE] / (1 + p[HINGE]), below = 2 * sinh * cosh + 2 * k;
    return p[STROKE] * (alpha * 4 * sinh * sinh + (1 - alpha) * 4 * sinh / k * (k * sinh - cosh + 1)) / below;
}

/* the face at height y; s sin(w t) with s rising as 3 r^2 - 2 r^3 over two periods */
static void drive_at(const double *p, double y, double t, double *x, double *v)
{
    const double size = 0.5 * p[STROKE] * p[DEPTH] * (y / p[DEPTH] + p[HINGE]) / (1 + p[HINGE]);
    const double w = omega(p) / unit_time(p), rise = 2 * p[PERIOD] * unit_time(p), r = t < rise ? t / rise : 1;
    const double s = r * r * (3 - 2 * r), ds = t < rise ? 6 * r * (1 - r) / rise : 0;
    x[0] = size * s * sph_sin(w * t);
    v[0] = size * (ds * sph_sin(w * t) + s * w * sph_cos(w * t));
    x[1] = v[1] = 0;
}
#define SLAB(k)                                                                                            \
    static void slab_##k(void *ctx, double t, double *x, double *v) { drive_at(ctx, middle(ctx, k), t, x, v); }
SLAB(0) SLAB(1) SLAB(2) SLAB(3) SLAB(4) SLAB(5) SLAB(6) SLAB(7) SLAB(8) SLAB(9) SLAB(10) SLAB(11)
static const sph_motion slab[SLABS] = {slab_0, slab_1, slab_2, slab_3, slab_4,  slab_5,
                                       slab_6, slab_7, slab_8, slab_9, slab_10, slab_11};

static double flat(const void *of, double x) { return (void)of, (void)x, 0; }
static double bed(const void *of, double x)
{
    const double *p = of;
    return x < p[FLAT] ? 0 : (x - p[FLAT]) / p[SLOPE];
}
static double bed_height(const void *of, double x)
{
    const double d = ((const double *)of)[DEPTH];
    return d * bed(of, x / d);
}
static double length(const double *p) { return p[FLAT] + HIGH * p[SLOPE]; }
static wave_water water(const double *p)
{
    return (wave_water){.depth = p[DEPTH], .gravity = p[GRAVITY], .sound = p[SOUND], .to = length(p),
                        .n = (uint32_t)p[N], .surface = flat, .bed = bed, .of = p};
}
/* how far behind the flap's place at rest its particles come, m */
static double behind(const double *p) { return scene_margin(p, spacing(p)) + HIGH * p[STROKE] * p[DEPTH]; }

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx);
    const double lo[2] = {-behind(p), 0}, hi[2] = {length(p) * p[DEPTH], slabs(p) * rows(p) * dx};
    const wave_water w = water(p);
    *c = scene_config(p, dx, 1000, p[SOUND] * wave_long(p[GRAVITY], p[DEPTH]));
    c->gravity[1] = -p[GRAVITY];
    c->lo[0] = lo[0];
    c->hi[0] = hi[0];
    c->lo[1] = -m;
    c->hi[1] = hi[1] + m;
    c->max_particles = scene_capacity(wave_count(&w) + 1.5 * scene_wall_count(p, lo, hi, dx, SPH_LOW(1)) +
                                      2 * scene_wall_count(p, lo, hi, dx, SPH_LOW(0)));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double d = p[DEPTH], dx = spacing(p), step = rows(p) * dx;
    const double points[3][2] = {{-behind(p) + dx, 0}, {p[FLAT] * d, 0}, {length(p) * d, HIGH * d}};
    const wave_water w = water(p);
    sph_wall wall = scene_wall(p);
    sph_status st = wave_add(sim, p, &w);
    st = st ? st : sph_add_wall_polyline(sim, &wall, points, 3, NULL);
    wall.motion_ctx = (void *)(uintptr_t)p;
    for (uint32_t k = 0; !st && k < (uint32_t)slabs(p); k++) {
        const double lo[2] = {0, k * step}, hi[2] = {d, (k + 1) * step};
        wall.motion = slab[k];
        st = sph_add_wall_box(sim, &wall, lo, hi, SPH_LOW(0), true, NULL);
    }
    return st;
}

enum { GAUGES = 3 };
static const char *const column[] = {
    "time_s",     "t_periods",      "flap_m",        "gauge1_x_D",  "gauge2_x_D",     "gauge3_x_D",    "gauge1_D",
    "gauge2_D",   "gauge3_D",       "height_linear_D", "wave_number_1/D", "kinetic_J/m", "potential_J/m",
    "wall_work_J/m", "in_walls_J/m", "dissipated_J/m", "diffused_J/m", "balance_J/m"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double d = p[DEPTH], t = sph_time(sim), k = wave_number(p), wave = 2 * SCENE_PI / k;
    double at[GAUGES], h[GAUGES], x[2], v[2];
    sph_totals o;
    drive_at(p, d, t, x, v);
    const track_tank tank = {x[0], length(p) * d, d, spacing(p), false, bed_height, p};
    for (int i = 0; i < GAUGES; i++) /* apart by a tenth and a quarter of a wavelength (Mansard & Funke 1980) */
        at[i] = (0.5 * p[FLAT] + (i == 1 ? 0.1 : i == 2 ? 0.25 : 0) * wave) * d;
    track_heights(sim, &tank, at, GAUGES, h);
    sph_get_totals(sim, &o);
    const double values[] = {t, t / (p[PERIOD] * unit_time(p)), x[0], at[0] / d, at[1] / d, at[2] / d, h[0] / d - 1,
                             h[1] / d - 1, h[2] / d - 1, height(p), k, o.kinetic, o.potential, o.wall_work, o.in_walls,
                             o.dissipated, o.diffused, o.balance};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_flap SPH_NAME(scene_flap)
extern const scene scene_flap;
const scene scene_flap = {"flap", "regular waves made by a flap, and a beach (Wickramarachchi 2009, 6.9)", param,
                          PARAMS, configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
