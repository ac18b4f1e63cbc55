/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* standing_wave.c: a standing gravity wave of small amplitude, one wavelength long. Starts flat, with the velocities of
   linear theory: eta = A sin(w t) cos(k (x - L/2)), w^2 = g k tanh(k d); or from rest, by a lattice that follows the
   raised surface, cos for sin (start=raised). Viscosity damps it as exp(-2 nu k^2 t) (Lamb,
   Hydrodynamics, section 348). The artificial viscosity is by default as strong as the Reynolds number asks for,
   nu = alpha h c/8 (Monaghan 2005, in 2-D): along a free surface it exerts the stresses of a Newtonian fluid. Morris's
   form is a Laplacian of the velocity, whose natural condition at a free surface is another: it damps half as fast. */
#include "waves.h"
#if SPH_DIM == 2

enum { DEPTH = SCENE_COMMON, WAVELENGTH, AMPLITUDE, N, RE, SIDES, GRAVITY, SOUND, PERIODS, START, PUSH, PARAMS };
enum { SIDES_PERIODIC, SIDES_SYMMETRY };
enum { FLAT, RAISED };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0, SPH_HYDROSTATIC, SCENE_ADAMI,
                    1, 0, 0, SPH_KICK_DRIFT_KICK, 1.2, 0),
    {"depth", "m", "depth of the water", 1, 1e-4, 1e4, SCENE_NUMBER},
    {"wavelength", "depth", "wavelength (rounded to whole spacings)", 2, 0.2, 100, SCENE_NUMBER},
    {"amplitude", "depth", "amplitude of the surface", 0.02, 0, 0.5, SCENE_NUMBER},
    {"n", "-", "particles in the depth", 40, 4, 4000, SCENE_WHOLE},
    {"re", "-", "Reynolds number depth sqrt(g depth)/nu, unless nu or alpha is given", 500, 1e-3, 1e9, SCENE_NUMBER},
    {"sides", "-", "ends of the tank: periodic symmetry", SIDES_PERIODIC, 0, 1, SCENE_CHOICE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the depth", 14.142135623730951, 2, 1000, SCENE_NUMBER},
    {"periods", "-", "length of the run in periods", 5, 0, 1e6, SCENE_NUMBER},
    {"start", "-", "what it is started from: flat raised", FLAT, 0, 1, SCENE_CHOICE},
    {"push", "dx", "a sinusoidal push of the places at the start", 0, 0, 0.4, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[DEPTH] / p[N]; }
static double sound(const double *p) { return p[SOUND] * __builtin_sqrt(p[GRAVITY] * p[DEPTH]); }
static bool is_artificial(const double *p)
{
    return p[SCENE_VISCOSITY] == SPH_ARTIFICIAL || p[SCENE_VISCOSITY] == SPH_ARTIFICIAL_APPROACHING;
}
/* kinematic viscosity of alpha = 1 */
static double viscosity_of_alpha(const double *p) { return p[SCENE_H] * spacing(p) * sound(p) / 8; }

/* the wave that p describes; m, s */
typedef struct wave {
    double length, depth, k, omega, amplitude, nu;
} wave;
static wave wave_of(const double *p)
{
    wave w;
    uint32_t across = (uint32_t)(p[WAVELENGTH] * p[N] + 0.5);
    w.depth = p[DEPTH];
    w.length = (across > 1 ? across : 1) * spacing(p);
    w.k = 2 * SCENE_PI / w.length;
    w.omega = __builtin_sqrt(p[GRAVITY] * w.k * sph_tanh(w.k * w.depth));
    w.amplitude = p[AMPLITUDE] * w.depth;
    w.nu = p[SCENE_NU] > 0 ? p[SCENE_NU] : w.depth * __builtin_sqrt(p[GRAVITY] * w.depth) / p[RE];
    if (is_artificial(p) && p[SCENE_ALPHA] > 0)
        w.nu = p[SCENE_ALPHA] * viscosity_of_alpha(p);
    else if (p[SCENE_VISCOSITY] == SPH_INVISCID)
        w.nu = 0;
    return w;
}

static void configure(const double *p, sph_config *c)
{
    const wave w = wave_of(p);
    const double dx = spacing(p), m = scene_margin(p, dx), lo[2] = {0, 0}, hi[2] = {w.length, w.depth};
    *c = scene_config(p, dx, 1000, sound(p));
    c->nu = w.nu;
    c->alpha = is_artificial(p) ? w.nu / viscosity_of_alpha(p) : 0;
    c->gravity[1] = -p[GRAVITY];
    c->lo[1] = -m;
    c->hi[0] = w.length;
    c->hi[1] = (1 + 2 * p[AMPLITUDE]) * w.depth + m;
    c->face[0][0] = c->face[0][1] = p[SIDES] == SIDES_PERIODIC ? SPH_PERIODIC : SPH_SYMMETRY;
    c->max_particles = scene_capacity(scene_box_count(lo, hi, dx) + scene_wall_count(p, lo, hi, dx, SPH_LOW(1)));
}

static void start(void *ctx, const double *x, double *v, double *rho)
{
    const wave *w = ctx;
    (void)rho;
    double up = sph_exp(w->k * x[1]), down = 1 / up, deep = sph_exp(w->k * w->depth);
    double c = w->amplitude * w->omega / (deep - 1 / deep), phase = w->k * (x[0] - 0.5 * w->length);
    v[0] = -c * (up + down) * sph_sin(phase);
    v[1] = c * (up - down) * sph_cos(phase);
}

static double raised(const void *of, double x)
{
    const wave *w = of;
    return w->amplitude * sph_cos(w->k * (x - 0.5 * w->length));
}
/* pressure of linear theory under the raised surface: rho g (d - y + eta cosh(k y)/cosh(k d)) */
typedef struct rest {
    const double *p;
    wave w;
} rest;
static void start_at_rest(void *ctx, const double *x, double *v, double *rho)
{
    const rest *r = ctx;
    const double up = sph_exp(r->w.k * x[1]), deep = sph_exp(r->w.k * r->w.depth);
    const double share = (up + 1 / up) / (deep + 1 / deep);
    const double pressure = 1000 * r->p[GRAVITY] * (r->w.depth - x[1] + raised(&r->w, x[0]) * share);
    (void)v;
    *rho = scene_density(r->p, pressure > 0 ? pressure : 0, 1000, sound(r->p));
}

static sph_status place(sph_sim *sim, const double *p, uint32_t water, const wave *w)
{
    const wave_surface surface = {0, w->depth, spacing(p), raised, w};
    const sph_status st = wave_push(sim, water, spacing(p), p[PUSH] * spacing(p));
    return st || p[START] == FLAT ? st : wave_follow(sim, water, &surface);
}

static sph_status build(sph_sim *sim, const double *p)
{
    wave w = wave_of(p);
    rest r = {p, w};
    const double lo[2] = {0, 0}, hi[2] = {w.length, w.depth};
    uint32_t water;
    sph_status st;
    if ((st = sph_add_fluid(sim, NULL, &water)) != SPH_OK || (st = sph_add_box(sim, water, lo, hi, NULL)) != SPH_OK ||
        (st = place(sim, p, water, &w)) != SPH_OK || (st = sph_apply_hydrostatic(sim, water, w.depth)) != SPH_OK ||
        (st = p[START] == FLAT ? sph_apply_field(sim, water, start, &w)
                               : sph_apply_field(sim, water, start_at_rest, &r)) != SPH_OK)
        return st;
    return scene_add_tank(sim, p, lo, hi, spacing(p), SPH_LOW(1));
}

static double end(const double *p) { return p[PERIODS] * 2 * SCENE_PI / wave_of(p).omega; }

static const char *const column[] = {"time_s", "antinode_m", "mode_m", "mode_linear_m", "kinetic_J/m", "potential_J/m",
                                     "dissipated_J/m"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const wave w = wave_of(p);
    const double middle[2] = {0.5 * w.length, 0}, t = sph_time(sim);
    double height = 0, moment = 0;
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    sph_gauge(sim, middle, 1, &height);
    /* sum m cos = rho times the integral of (d + eta) cos: the mode's amplitude, without looking for a surface */
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.role == SPH_ROLE_FLUID)
            moment += q.mass * sph_cos(w.k * (q.x[0] - 0.5 * w.length));
    row[0] = t;
    row[1] = height - w.depth;
    row[2] = o.mass > 0 ? 2 * w.depth * moment / o.mass : 0;
    const double phase = w.omega * t + (p[START] == FLAT ? 0 : SCENE_PI / 2);
    row[3] = w.amplitude * sph_sin(phase) * sph_exp(-2 * w.nu * w.k * w.k * t);
    row[4] = o.kinetic;
    row[5] = o.potential;
    row[6] = o.dissipated;
}

#define scene_standing_wave SPH_NAME(scene_standing_wave)
extern const scene scene_standing_wave;
const scene scene_standing_wave = {"standing_wave", "a standing gravity wave of small amplitude, one wavelength", param,
                                   PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                   history, scene_si};
#endif
