/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* channel.c: a viscous fluid between two plates, started from rest (Morris, Fox & Zhu 1997, section 4): Poiseuille's
   flow under a body force along the channel, Couette's under a plate that slides, or both. With y in heights H from the
   lower plate, t in H^2/nu, speed U of the plate or at the middle of the steady flow:
     Poiseuille  u/U = 4 y (1 - y) - sum_{n odd} 32/(n pi)^3 sin(n pi y) exp(-(n pi)^2 t)
     Couette     u/U = y + sum_n 2 (-1)^n/(n pi) sin(n pi y) exp(-(n pi)^2 t)
   The channel is periodic along x. */
#include "scene.h"
#if SPH_DIM == 2

enum { HEIGHT = SCENE_COMMON, SPEED, RE, N, FLOW, SOUND, DURATION, PARAMS };
enum { POISEUILLE, COUETTE, TOGETHER, FLOWS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_LINEAR, SPH_MORRIS, 0, SPH_NO_DIFFUSION, SCENE_ADAMI_NO_SLIP,
                    1, 0, 0, SPH_KICK_DRIFT_KICK, 0.5, 0),
    {"height", "m", "distance of the plates", 1, 1e-6, 1e4, SCENE_NUMBER},
    {"speed", "m/s", "of the plate, and at the middle of Poiseuille's steady flow", 1, 1e-9, 1e4, SCENE_NUMBER},
    {"re", "-", "Reynolds number speed height/nu, unless nu is given", 1, 1e-6, 1e6, SCENE_NUMBER},
    {"n", "-", "particles across the channel", 20, 4, 4000, SCENE_WHOLE},
    {"flow", "-", "what drives it: poiseuille couette together", POISEUILLE, 0, FLOWS - 1, SCENE_CHOICE},
    {"sound", "speed", "sound speed", 10, 1, 1e6, SCENE_NUMBER},
    {"duration", "height^2/nu", "length of the run", 1, 0, 1e6, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[HEIGHT] / p[N]; }
static double viscosity(const double *p) { return p[SCENE_NU] > 0 ? p[SCENE_NU] : p[SPEED] * p[HEIGHT] / p[RE]; }
static bool flows(const double *p, uint32_t which) { return p[FLOW] == which || p[FLOW] == TOGETHER; }

static double end(const double *p) { return p[DURATION] * p[HEIGHT] * p[HEIGHT] / viscosity(p); }

/* particles along the channel: a periodic axis is longer than three supports */
static double columns(const double *p)
{
    return (double)(uint32_t)(3 * sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H]) + 2;
}

/* exact velocity in units of the speed at height y (0 to 1) and time t (1 height^2/nu); until the series has begun to
   converge, 0.0003 in the unit of time, rest */
static double velocity(const double *p, double y, double t)
{
    double u = (flows(p, POISEUILLE) ? 4 * y * (1 - y) : 0) + (flows(p, COUETTE) ? y : 0);
    if (t < 3e-4)
        return 0;
    for (int n = 1; n <= 64; n++) {
        const double a = n * SCENE_PI, mode = sph_sin(a * y) * sph_exp(-a * a * t);
        if (flows(p, POISEUILLE) && n % 2)
            u -= 32 / (a * a * a) * mode;
        if (flows(p, COUETTE))
            u += (n % 2 ? -2 : 2) / a * mode;
    }
    return u;
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), hi[2] = {columns(p) * dx, p[HEIGHT]}, lo[2] = {0, 0};
    *c = scene_config(p, dx, 1000, p[SOUND] * p[SPEED]);
    c->nu = viscosity(p);
    c->gravity[0] = flows(p, POISEUILLE) ? 8 * c->nu * p[SPEED] / (p[HEIGHT] * p[HEIGHT]) : 0;
    c->hi[0] = hi[0];
    c->face[0][0] = c->face[0][1] = SPH_PERIODIC;
    c->lo[1] = -m;
    c->hi[1] = p[HEIGHT] + m;
    c->max_particles =
        scene_capacity(scene_box_count(lo, hi, dx) + scene_wall_count(p, lo, hi, dx, SPH_LOW(1) | SPH_HIGH(1)));
}

/* the plate slides along itself at the speed that p gives from time 0 on */
static void slide(void *ctx, double t, double *displacement, double *v)
{
    const double *p = ctx;
    displacement[0] = p[SPEED] * t;
    displacement[1] = v[1] = 0;
    v[0] = p[SPEED];
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[2] = {0, 0}, hi[2] = {columns(p) * spacing(p), p[HEIGHT]};
    sph_wall plate = scene_wall(p);
    uint32_t fluid;
    sph_status st = sph_add_fluid(sim, NULL, &fluid);
    if (st || (st = sph_add_box(sim, fluid, lo, hi, NULL)) ||
        (st = sph_add_wall_box(sim, &plate, lo, hi, SPH_LOW(1), true, NULL)))
        return st;
    if (flows(p, COUETTE)) {
        plate.motion = slide;
        plate.motion_ctx = (void *)p; // NOLINT: read only
    }
    return sph_add_wall_box(sim, &plate, lo, hi, SPH_HIGH(1), true, NULL);
}

static const char *const column[] = {"time_s", "velocity_error_rms_-", "velocity_error_max_-", "max_speed_-",
                                     "max_speed_exact_-", "cross_speed_rms_-"};

/* errors in units of the speed: rms and largest, and what flows across the channel, where there is nothing exact */
static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim) * viscosity(p) / (p[HEIGHT] * p[HEIGHT]);
    double sum = 0, cross = 0, most = 0, fastest = 0, exact = 0, n = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.role != SPH_ROLE_FLUID)
            continue;
        const double u = velocity(p, q.x[1] / p[HEIGHT], t), e = q.v[0] / p[SPEED] - u;
        sum += e * e;
        cross += q.v[1] * q.v[1] / (p[SPEED] * p[SPEED]);
        most = SCENE_ABS(e) > most ? SCENE_ABS(e) : most;
        fastest = q.v[0] / p[SPEED] > fastest ? q.v[0] / p[SPEED] : fastest;
        exact = u > exact ? u : exact;
        n++;
    }
    row[0] = sph_time(sim);
    row[1] = n > 0 ? __builtin_sqrt(sum / n) : 0;
    row[2] = most;
    row[3] = fastest;
    row[4] = exact;
    row[5] = n > 0 ? __builtin_sqrt(cross / n) : 0;
}

#define scene_channel SPH_NAME(scene_channel)
extern const scene scene_channel;
const scene scene_channel = {"channel", "flow between two plates (Poiseuille, Couette; Morris, Fox & Zhu 1997)", param,
                             PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                             history, scene_si};
#endif
