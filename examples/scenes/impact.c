/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* impact.c: a column of water collapses and runs against the wall at the end of the tank, on which sensors sit: the
   dam break of Lobovsky, Botia-Vera, Castellana, Mas-Soler & Souto-Iglesias (2014), J. Fluids Struct. 48, 407: column
   0.6 m wide and H = 0.3 m high, tank 1.61 m long, pressures 3, 15, 30 and 80 mm above the floor, levels at 0.3, 0.865,
   1.114 and 1.3625 m from the reservoir's wall. The gate is gone at once. History in their terms: t sqrt(g/H), pressure
   over rho g H at the sensor's middle and as the mean over its width, level over H (a gauge needs water on both sides
   of its line, so none stands at the wall). */
#include "scene.h"
#if SPH_DIM == 2

enum { HIGH = SCENE_COMMON, WIDE, LENGTH, HEIGHT, N, GRAVITY, SOUND, START, WIDTH, PARAMS };
enum { POINTS = 5, SENSORS = 4 }; /* places of a sensor whose mean is taken; sensors, and gauges */

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_SHIFTED(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.005, SPH_HYDROSTATIC, SCENE_ADAMI, 1, 0, 1,
                         SPH_KICK_DRIFT_KICK, 0.5, 1, 0.2, 0.5),
    {"high", "m", "height of the column, H", 0.3, 1e-3, 1e3, SCENE_NUMBER},
    {"wide", "H", "width of the column", 2, 0.1, 100, SCENE_NUMBER},
    {"length", "H", "length of the tank", 5.366666666666667, 0.2, 1000, SCENE_NUMBER},
    {"height", "H", "height of the tank", 2, 1, 100, SCENE_NUMBER},
    {"n", "-", "particles in H", 40, 4, 4000, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed", 10, 2, 1000, SCENE_NUMBER},
    {"start", "-", "pressure at the start: uniform hydrostatic released", SCENE_RELEASED, 0, 2, SCENE_CHOICE},
    {"width", "H", "width of a sensor", 0.014, 0, 1, SCENE_NUMBER},
};

/* heights of sensors and places of gauges, in H */
static const double sensor[SENSORS] = {0.01, 0.05, 0.1, 0.26666666666666666};
static const double gauge[SENSORS] = {1, 2.8833333333333333, 3.7133333333333334, 4.541666666666667};

static double spacing(const double *p) { return p[HIGH] / p[N]; }
static double sound(const double *p) { return p[SOUND] * __builtin_sqrt(p[GRAVITY] * p[HIGH]); }
static double rate(const double *p) { return __builtin_sqrt(p[GRAVITY] / p[HIGH]); }
#define FACES (SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1))

static void tank(const double *p, double *column, double *hi)
{
    column[0] = p[WIDE] * p[HIGH];
    column[1] = p[HIGH];
    hi[0] = (p[LENGTH] < p[WIDE] ? p[WIDE] : p[LENGTH]) * p[HIGH];
    hi[1] = p[HEIGHT] * p[HIGH];
}

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[2] = {0, 0};
    double column[2], hi[2];
    tank(p, column, hi);
    *c = scene_config(p, dx, 1000, sound(p));
    c->gravity[1] = -p[GRAVITY];
    for (int k = 0; k < 2; k++) {
        c->lo[k] = -m;
        c->hi[k] = hi[k] + m;
    }
    c->max_particles = scene_capacity(scene_box_count(lo, column, dx) + scene_wall_count(p, lo, hi, dx, FACES));
}

static void released(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    (void)v;
    const double pressure = 1000 * p[GRAVITY] * scene_released(p[WIDE] * p[HIGH], p[HIGH], x);
    *rho = scene_density(p, pressure > 0 ? pressure : 0, 1000, sound(p));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[2] = {0, 0};
    double column[2], hi[2], q[PARAMS];
    tank(p, column, hi);
    for (int i = 0; i < PARAMS; i++)
        q[i] = p[i]; /* the field's context is not const */
    const sph_status st = scene_add_water(sim, p[START], lo, column, released, q);
    return st ? st : scene_add_tank(sim, p, lo, hi, spacing(p), FACES);
}

static double end(const double *p) { return 5.7 / rate(p); }

static const char *const column[] = {
    "time_s",      "t_-",           "front_H",      "P1_rhogH",      "P2_rhogH",       "P3_rhogH",      "P4_rhogH",
    "mean_P1_rhogH", "mean_P2_rhogH", "mean_P3_rhogH", "mean_P4_rhogH", "H1_H",         "H2_H",          "H3_H",
    "H4_H",        "kinetic_J/m",   "potential_J/m", "internal_J/m", "dissipated_J/m", "diffused_J/m", "shifted_J/m"};

/* pressures over rho g H, in the middles of the sensors and over their widths */
static void pressures(const sph_sim *sim, const double *p, double *middle, double *mean)
{
    double x[SENSORS * POINTS][2], pressure[SENSORS * POINTS], top[2], hi[2];
    sph_config c;
    configure(p, &c);
    tank(p, top, hi);
    for (int i = 0; i < SENSORS * POINTS; i++) {
        x[i][0] = hi[0];
        x[i][1] = (sensor[i / POINTS] + p[WIDTH] * ((i % POINTS) - 0.5 * (POINTS - 1)) / (POINTS - 1)) * p[HIGH];
    }
    scene_wall_pressure(sim, &c, (const double(*)[2])x, SENSORS * POINTS, pressure);
    for (int s = 0; s < SENSORS; s++) {
        double sum = 0;
        for (int i = 0; i < POINTS; i++)
            sum += pressure[s * POINTS + i];
        middle[s] = pressure[s * POINTS + POINTS / 2] / (1000 * p[GRAVITY] * p[HIGH]);
        mean[s] = sum / (POINTS * 1000 * p[GRAVITY] * p[HIGH]);
    }
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    sph_totals o;
    double back, front, *at = row;
    sph_get_totals(sim, &o);
    sph_extent(sim, 0, &back, &front);
    *at++ = sph_time(sim);
    *at++ = sph_time(sim) * rate(p);
    *at++ = (front + 0.5 * spacing(p)) / p[HIGH];
    pressures(sim, p, at, at + SENSORS);
    at += 2 * SENSORS;
    for (int i = 0; i < SENSORS; i++) {
        const double x[2] = {gauge[i] * p[HIGH], 0};
        double level = 0;
        sph_gauge(sim, x, 1, &level);
        *at++ = (level > 0 ? level : 0) / p[HIGH];
    }
    const double energies[] = {o.kinetic, o.potential, o.internal, o.dissipated, o.diffused, o.shifted};
    for (unsigned i = 0; i < sizeof energies / sizeof *energies; i++)
        *at++ = energies[i];
}

#define scene_impact SPH_NAME(scene_impact)
extern const scene scene_impact;
const scene scene_impact = {"impact", "a dam break against a wall with pressure sensors (Lobovsky et al. 2014)", param,
                            PARAMS, configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
