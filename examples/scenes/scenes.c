/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* scenes.c: the table of scenes of each dimension, and what their set-ups share. */
#include "scene.h"

/* the one table of scenes: a line here and a file of that name */
#if SPH_DIM == 1
#define SCENE_LIST(X) X(hydrostatic) X(sod) X(bar)
#elif SPH_DIM == 2
#define SCENE_LIST(X)                                                                                       \
    X(dam_break)                                                                                            \
    X(impact)                                                                                               \
    X(sloshing)                                                                                             \
    X(still_tank)                                                                                           \
    X(standing_wave)                                                                                        \
    X(shock_tube)                                                                                           \
    X(rotating_patch)                                                                                       \
    X(drop)                                                                                                 \
    X(dam_break_wick)                                                                                       \
    X(taylor_green)                                                                                         \
    X(channel)                                                                                              \
    X(elliptical_drop)                                                                                      \
    X(plate)                                                                                                \
    X(beam)                                                                                                 \
    X(csm3)                                                                                                 \
    X(pulse)                                                                                                \
    X(lattice_box)                                                                                          \
    X(rings)                                                                                                \
    X(tension)                                                                                              \
    X(brittle)                                                                                              \
    X(hole)                                                                                                 \
    X(chamber)                                                                                              \
    X(two_blocks)                                                                                           \
    X(clamped_beam)                                                                                         \
    X(block)                                                                                                \
    X(caldera)                                                                                              \
    X(solitary)                                                                                             \
    X(weir)                                                                                                 \
    X(caldera_wave)                                                                                         \
    X(wave_train)                                                                                           \
    X(still_water)                                                                                          \
    X(piston)                                                                                               \
    X(bore)                                                                                                 \
    X(collision)                                                                                            \
    X(breaking)                                                                                             \
    X(shoaling)                                                                                             \
    X(flap)\
    X(plane_wave)                                                                                           \
    X(collapsing_square)                                                                                    \
    X(disc)
#else
#define SCENE_LIST(X)                                                                                       \
    X(dam_break_3d)                                                                                         \
    X(obstacle)
#endif

#define SCENE_DECLARED(name) extern const scene SPH_NAME(scene_##name);
#define SCENE_ENTRY(name) &SPH_NAME(scene_##name),
SCENE_LIST(SCENE_DECLARED)
const scene *const scene_table[] = {SCENE_LIST(SCENE_ENTRY) NULL};

/* ---- units ---- */

#if SPH_DIM == 1
#define ACROSS "/m^2"
#elif SPH_DIM == 2
#define ACROSS "/m"
#else
#define ACROSS ""
#endif
const scene_unit scene_si[] = {{"kg", "kg" ACROSS}, {"J", "J" ACROSS}, {"W", "W" ACROSS}, {NULL, NULL}};
#define GRAY(cm)                                                                                            \
    {                                                                                                       \
        {"m", cm}, {"s", cm "/c0"}, {"m/s", "c0"}, {"m/s^2", "c0^2/" cm}, {"m^2/s", cm ".c0"},              \
        {"kg/m^3", "rho0"}, {"Pa", "K"}, {"1/s", "c0/" cm}, {"kg", "rho0." cm "^2"}, {"J", "K." cm "^2"},   \
        {"W", "K." cm ".c0"}, {NULL, NULL}                                                                  \
    }
const scene_unit scene_gray[] = GRAY("cm");
const scene_unit scene_gray_km[] = GRAY("km");

/* the options that are parameters */
static void take_options(const double *p, sph_config *c)
{
#define TAKE(A, name, kind, ...) c->name = TAKE_##kind(p[SCENE_OF_##name]);
#define TAKE_WHOLE(value) (uint32_t)(value)
#define TAKE_CHOICE(value) (uint32_t)(value)
#define TAKE_BOOL(value) (value) != 0
#define TAKE_REAL(value) value
#define TAKE_POSITIVE(value) value
    SPH_OPTIONS(SCENE_SKIP, TAKE, )
#undef TAKE
}

sph_config scene_config(const double *p, double dx, double rho0, double sound_speed)
{
    sph_config c = sph_config_default();
    take_options(p, &c);
    c.spacing = dx;
    c.smoothing_length = p[SCENE_H] * dx;
    c.rho0 = rho0;
    c.sound_speed = sound_speed;
    /* the limit with gravity (Gray 2.30) is a Courant number too, and shall not bind before the one that is asked for
       */
    c.gravity_factor = c.cfl > c.gravity_factor ? c.cfl : c.gravity_factor;
    c.on_leave = SPH_REMOVE;
    return c;
}

sph_wall scene_wall(const double *p)
{
    sph_wall w = sph_wall_default();
    const uint32_t choice = (uint32_t)p[SCENE_WALL];
    w.strength = p[SCENE_STRENGTH];
    switch (choice) {
    case SCENE_LENNARD_JONES: w.kind = SPH_WALL_LENNARD_JONES; break;
    case SCENE_KERNEL_FORCE: w.kind = SPH_WALL_KERNEL_FORCE; break;
    case SCENE_MONAGHAN_KOS: w.kind = SPH_WALL_MONAGHAN_KOS; break;
    case SCENE_GHOST:
    case SCENE_GHOST_COMPRESSIBLE: /* Gray's ghosts act in the viscosity, with mirror velocities */
        w.kind = SPH_WALL_GHOST;
        w.no_slip = true;
        w.compressible = choice == SCENE_GHOST_COMPRESSIBLE;
        break;
    default: w.no_slip = choice == SCENE_ADAMI_NO_SLIP; break;
    }
    return w;
}

static bool has_layers(const double *p) { return p[SCENE_WALL] >= SCENE_GHOST; }

/* layers that a wall of ghosts has, as many as the support needs */
static double wall_layers(const double *p)
{
    double support = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H];
    return has_layers(p) ? (double)(uint32_t)(support + 0.999999) : 0;
}

double scene_margin(const double *p, double dx) { return (wall_layers(p) + 1) * dx; }

static void move_walls(const double *p, const double *lo, const double *hi, double dx, uint32_t faces, double *wlo,
                       double *whi)
{
    double gap = p[SCENE_WALL] == SCENE_LENNARD_JONES ? 0.5 * dx : 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        wlo[k] = lo[k] - (faces & SPH_LOW(k) ? gap : 0);
        whi[k] = hi[k] + (faces & SPH_HIGH(k) ? gap : 0);
    }
}

sph_status scene_add_tank(sph_sim *sim, const double *p, const double *lo, const double *hi, double dx, uint32_t faces)
{
    const sph_wall wall = scene_wall(p);
    double wlo[SPH_DIM], whi[SPH_DIM];
    move_walls(p, lo, hi, dx, faces, wlo, whi);
    return sph_add_wall_box(sim, &wall, wlo, whi, faces, true, NULL);
}

sph_status scene_add_water(sph_sim *sim, double start, const double *lo, const double *hi, sph_field_fn released,
                           void *ctx)
{
    uint32_t water;
    sph_status st;
    if ((st = sph_add_fluid(sim, NULL, &water)) != SPH_OK || (st = sph_add_box(sim, water, lo, hi, NULL)) != SPH_OK)
        return st;
    if (start == SCENE_HYDROSTATIC)
        return sph_apply_hydrostatic(sim, water, hi[SPH_DIM - 1]);
    return start == SCENE_RELEASED ? sph_apply_field(sim, water, released, ctx) : SPH_OK;
}

static double intervals(double length, double dx)
{
    double n = length / dx + 0.5;
    return n < 1 ? 1 : n < 1e9 ? (double)(uint32_t)n : 1e9;
}

double scene_box_count(const double *lo, const double *hi, double dx)
{
    double n = 1;
    for (int k = 0; k < SPH_DIM; k++)
        n *= intervals(hi[k] - lo[k], dx);
    return n;
}

double scene_wall_count(const double *p, const double *lo, const double *hi, double dx, uint32_t faces)
{
    double outer = 1, inner = 1, wlo[SPH_DIM], whi[SPH_DIM];
    move_walls(p, lo, hi, dx, faces, wlo, whi);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        double n = intervals(whi[k] - wlo[k], dx), f = ((faces & SPH_LOW(k)) != 0) + ((faces & SPH_HIGH(k)) != 0);
        /* layers stand around the box; rows take the nodes of its surface */
        outer *= has_layers(p) ? n + f * wall_layers(p) : n + 1;
        inner *= has_layers(p) ? n : n + 1 - f;
    }
    return outer - inner;
}

uint32_t scene_capacity(double n) { return n < 1 ? 1 : n > 1073741824.0 ? 1073741824u : (uint32_t)n; }

double scene_density(const double *p, double pressure, double rho0, double sound_speed)
{
    double y = pressure / (rho0 * sound_speed * sound_speed);
    switch ((uint32_t)p[SCENE_EOS]) {
    case SPH_LINEAR: return rho0 * (1 + y);
    case SPH_ISOTHERMAL: return rho0 * (1 + y); /* pressure is meant above the one at rest */
    case SPH_TAIT_GRAY: return rho0 * sph_pow(1 + y, 1.0 / 7);
    default: return rho0 * sph_pow(1 + 7 * y, 1.0 / 7);
    }
}

/* h - y in quarter waves, each carried inward by cosh */
#define TERMS 100
double scene_released(double a, double h, const double *y)
{
    double sum = 0;
    for (int i = 0; i < TERMS; i++) {
        double k = (i + 0.5) * SCENE_PI / h;
        double inward = sph_exp(k * (y[0] - a)) * (1 + sph_exp(-2 * k * y[0])) / (1 + sph_exp(-2 * k * a));
        sum += 2 / (h * k * k) * sph_cos(k * y[1]) * inward;
    }
    return h - y[1] - sum;
}

void scene_wall_pressure(const sph_sim *sim, const sph_config *c, const double (*x)[SPH_DIM], uint32_t n,
                         double *pressure)
{
    const double reach = sph_kernel_support(c->kernel) * c->smoothing_length;
    double weight[SCENE_SENSORS] = {0};
    for (uint32_t s = 0; s < n; s++)
        pressure[s] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle q;
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID)
            continue;
        for (uint32_t s = 0; s < n; s++) {
            double r2 = 0, height = 0, w = 0, dw;
            for (int k = 0; k < SPH_DIM; k++) {
                r2 += (x[s][k] - q.x[k]) * (x[s][k] - q.x[k]);
                height += c->gravity[k] * (x[s][k] - q.x[k]);
            }
            if (!(r2 < reach * reach) || sph_kernel_value(c->kernel, __builtin_sqrt(r2), c->smoothing_length, &w, &dw))
                continue;
            weight[s] += w;
            pressure[s] += (q.p + q.rho * height) * w;
        }
    }
    for (uint32_t s = 0; s < n; s++)
        pressure[s] = weight[s] > 0 ? pressure[s] / weight[s] : 0;
}

sph_status scene_between(sph_sim *sim, const double *p, sph_config *cfg)
{
    sph_step_info info;
    if (cfg->damping == 1 || p[SCENE_DAMP_STEPS] == 0)
        return SPH_OK;
    sph_get_step(sim, &info);
    if ((double)info.step < p[SCENE_DAMP_STEPS])
        return SPH_OK;
    cfg->damping = 1;
    return sph_reconfigure(sim, cfg);
}
