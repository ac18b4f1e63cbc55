/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* taylor_green.c: four vortices in a doubly periodic square that viscosity brings to rest (Taylor & Green 1937): u = U
   exp(-8 pi^2 t U/(Re L)) (sin X cos Y, -cos X sin Y), X = 2 pi x/L. Starts from a lattice with small random
   displacements, because an undisturbed one shears along the vortices' streamlines and breaks up all at once. */
#include "scene.h"
#if SPH_DIM == 2

enum { SIDE = SCENE_COMMON, SPEED, RE, N, JITTER, SEED, SOUND, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2.5, SPH_TAIT, SPH_MORRIS, 0, SPH_MOLTENI, SCENE_ADAMI,
                    1, 0, 0, SPH_KICK_DRIFT_KICK, 0.5, 0),
    {"side", "m", "side of the square", 1, 1e-4, 1e4, SCENE_NUMBER},
    {"speed", "m/s", "largest speed at the start", 1, 1e-6, 1e4, SCENE_NUMBER},
    {"re", "-", "Reynolds number speed side/nu, unless nu is given", 100, 1e-3, 1e9, SCENE_NUMBER},
    {"n", "-", "particles along a side", 50, 16, 4000, SCENE_WHOLE},
    {"jitter", "dx", "largest random displacement from the lattice, on each axis", 0.2, 0, 0.5, SCENE_NUMBER},
    {"seed", "-", "of the displacements", 1, 0, 4294967295.0, SCENE_WHOLE},
    {"sound", "speed", "sound speed", 10, 1, 1000, SCENE_NUMBER},
    {"duration", "side/speed", "length of the run", 1, 0, 1e6, SCENE_NUMBER},
};

static double spacing(const double *p) { return p[SIDE] / p[N]; }
static double viscosity(const double *p) { return p[SCENE_NU] > 0 ? p[SCENE_NU] : p[SPEED] * p[SIDE] / p[RE]; }
static double decay(const double *p, double t)
{
    return sph_exp(-8 * SCENE_PI * SCENE_PI * viscosity(p) * t / (p[SIDE] * p[SIDE]));
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), lo[2] = {0, 0}, hi[2] = {p[SIDE], p[SIDE]};
    *c = scene_config(p, dx, 1000, p[SOUND] * p[SPEED]);
    c->nu = viscosity(p);
    for (int k = 0; k < 2; k++) {
        c->hi[k] = p[SIDE];
        c->face[k][0] = c->face[k][1] = SPH_PERIODIC;
    }
    c->max_particles = scene_capacity(scene_box_count(lo, hi, dx));
}

/* exact velocity, as much of it as `factor` */
static void velocity(const double *p, double factor, const double *x, double *v)
{
    const double k = 2 * SCENE_PI / p[SIDE];
    v[0] = factor * p[SPEED] * sph_sin(k * x[0]) * sph_cos(k * x[1]);
    v[1] = -factor * p[SPEED] * sph_cos(k * x[0]) * sph_sin(k * x[1]);
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double dx = spacing(p), k = 2 * SCENE_PI / p[SIDE], c = p[SOUND] * p[SPEED];
    const uint32_t n = (uint32_t)p[N];
    sph_rng rng;
    uint32_t water;
    sph_rng_seed(&rng, (uint64_t)p[SEED], 0);
    sph_status st = sph_add_fluid(sim, NULL, &water);
    for (uint32_t j = 0; !st && j < n; j++)
        for (uint32_t i = 0; !st && i < n; i++) {
            double x[2] = {(i + 0.5) * dx, (j + 0.5) * dx}, v[2];
            for (int a = 0; a < 2; a++)
                x[a] += p[JITTER] * dx * (2 * sph_rng_uniform(&rng) - 1);
            for (int a = 0; a < 2; a++) /* half a spacing off the edge and at most half out of place */
                x[a] = x[a] < 0 ? 0 : x[a] < p[SIDE] ? x[a] : x[a] - p[SIDE];
            velocity(p, 1, x, v);
            double pressure = 250 * p[SPEED] * p[SPEED] * (sph_cos(2 * k * x[0]) + sph_cos(2 * k * x[1]));
            st = sph_add_particle(sim, water, x, v, scene_density(p, pressure, 1000, c), NULL);
        }
    return st;
}

static double end(const double *p) { return p[DURATION] * p[SIDE] / p[SPEED]; }

static const char *const column[] = {"time_s", "kinetic_J/m", "kinetic_exact_J/m", "max_speed_m/s",
                                     "max_speed_exact_m/s", "velocity_error_L2_-"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim), d = decay(p, t);
    double error = 0;
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK) {
            double v[2];
            velocity(p, d, q.x, v);
            error += q.mass * ((q.v[0] - v[0]) * (q.v[0] - v[0]) + (q.v[1] - v[1]) * (q.v[1] - v[1]));
        }
    row[0] = t;
    row[1] = o.kinetic;
    row[2] = 0.25 * o.mass * p[SPEED] * p[SPEED] * d * d;
    row[3] = o.max_speed;
    row[4] = p[SPEED] * d;
    row[5] = o.mass > 0 ? __builtin_sqrt(error / o.mass) / (p[SPEED] * __builtin_sqrt(0.5)) : 0; /* of the first rms */
}

#define scene_taylor_green SPH_NAME(scene_taylor_green)
extern const scene scene_taylor_green;
const scene scene_taylor_green = {"taylor_green", "decaying vortices in a periodic square (Taylor & Green 1937)", param,
                                  PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                                  history, scene_si};
#endif
