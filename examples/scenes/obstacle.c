/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* obstacle.c: a dam break in three dimensions against a box on the floor: SPHERIC's validation test 2 (Kleefsman,
   Fekken, Veldman, Iwanowski & Buchner 2005, J. Comput. Phys. 206, 363). Tank 3.22 x 1 x 1 m; water in x 1.992 .. 3.22,
   0.55 m deep; box in x 0.6635 .. 0.8245, 0.403 m wide in the middle, 0.161 m high. Pressures P1 .. P4 on the face that
   the water meets, 0.021, 0.061, 0.101, 0.141 m above the floor, P5 .. P8 on the top, as far behind that edge, all
   0.029 m off the middle; levels H1 .. H4 at x 0.496, 0.992, 1.488, 2.638.

   Half of the tank is run: its middle and its side wall are symmetry faces, which cost no memory. Levels are taken a
   support off the middle, where a gauge has water on both sides. */
#include "scene.h"
#if SPH_DIM == 3

enum { N = SCENE_COMMON, GRAVITY, SOUND, DURATION, PARAMS };
enum { PRESSURES = 8, LEVELS = 4 };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_SHIFTED(SPH_WENDLAND_C2, 2, SPH_TAIT, SPH_ARTIFICIAL, 0.01, SPH_HYDROSTATIC, SCENE_ADAMI, 1, 0, 0,
                         SPH_KICK_DRIFT_KICK, 0.5, 1, 0.2, 0.5),
    {"n", "-", "particles in the water's depth", 11, 5, 500, SCENE_WHOLE},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, 1e-6, 1e4, SCENE_NUMBER},
    {"sound", "sqrt(g H)", "sound speed, H the water's depth", 10, 2, 1000, SCENE_NUMBER},
    {"duration", "s", "length of the run", 2, 0, 1e9, SCENE_NUMBER},
};

#define HALF 0.5 /* of the tank's width */
static const double tank[3] = {3.22, HALF, 1}, water_lo[3] = {1.992, 0, 0}, water_hi[3] = {3.22, HALF, 0.55};
static const double box_lo[3] = {0.6635, HALF - 0.2015, 0}, box_hi[3] = {0.8245, HALF, 0.161};
static const double pressure_at[4] = {0.021, 0.061, 0.101, 0.141};
static const double level_at[LEVELS] = {0.496, 0.992, 1.488, 2.638};
#define OFF_MIDDLE 0.029
#define FACES (SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(2))
#define BOX_FACES (SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1) | SPH_HIGH(2))

static double spacing(const double *p) { return water_hi[2] / p[N]; }

static void configure(const double *p, sph_config *c)
{
    const double dx = spacing(p), m = scene_margin(p, dx), lo[3] = {0, 0, 0};
    *c = scene_config(p, dx, 1000, p[SOUND] * __builtin_sqrt(p[GRAVITY] * water_hi[2]));
    c->gravity[2] = -p[GRAVITY];
    c->lo[0] = c->lo[2] = -m;
    c->lo[1] = 0;
    c->hi[0] = tank[0] + m;
    c->hi[1] = tank[1];
    c->hi[2] = tank[2] + m;
    c->face[1][0] = c->face[1][1] = SPH_SYMMETRY;
    c->max_particles = scene_capacity(scene_box_count(water_lo, water_hi, dx) + scene_box_count(box_lo, box_hi, dx) +
                                      scene_wall_count(p, lo, tank, dx, FACES));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double lo[3] = {0, 0, 0};
    const sph_wall wall = scene_wall(p);
    sph_status st;
    if ((st = scene_add_water(sim, SCENE_HYDROSTATIC, water_lo, water_hi, NULL, NULL)) != SPH_OK ||
        (st = sph_add_wall_box(sim, &wall, box_lo, box_hi, BOX_FACES, false, NULL)) != SPH_OK)
        return st;
    return scene_add_tank(sim, p, lo, tank, spacing(p), FACES);
}

static double end(const double *p) { return p[DURATION]; }

static const char *const column[] = {"time_s", "P1_Pa",     "P2_Pa",       "P3_Pa",      "P4_Pa",     "P5_Pa",
                                     "P6_Pa",  "P7_Pa",     "P8_Pa",       "H1_m",       "H2_m",      "H3_m",
                                     "H4_m",   "kinetic_J", "potential_J", "internal_J", "shifted_J", "mass_kg"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double off = sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * spacing(p);
    double x[PRESSURES][3];
    sph_totals o;
    sph_config c;
    configure(p, &c);
    sph_get_totals(sim, &o);
    for (int i = 0; i < PRESSURES; i++) {
        const double along = pressure_at[i % 4];
        x[i][0] = i < 4 ? box_hi[0] : box_hi[0] - along;
        x[i][1] = HALF - OFF_MIDDLE;
        x[i][2] = i < 4 ? along : box_hi[2];
    }
    row[0] = sph_time(sim);
    scene_wall_pressure(sim, &c, (const double(*)[3])x, PRESSURES, row + 1);
    for (int i = 0; i < LEVELS; i++) {
        const double at[3] = {level_at[i], HALF - (off < HALF ? off : 0.5 * HALF), 0};
        double level = 0;
        sph_gauge(sim, at, 2, &level);
        row[1 + PRESSURES + i] = level > 0 ? level : 0;
    }
    const double rest[] = {o.kinetic, o.potential, o.internal, o.shifted, o.mass};
    for (unsigned i = 0; i < sizeof rest / sizeof *rest; i++)
        row[1 + PRESSURES + LEVELS + i] = rest[i];
}

#define scene_obstacle SPH_NAME(scene_obstacle)
extern const scene scene_obstacle;
const scene scene_obstacle = {"obstacle", "a dam break against a box, in 3-D (SPHERIC test 2, Kleefsman et al. 2005)",
                              param, PARAMS, configure, build, end, sizeof column / sizeof *column, column, history,
                              scene_si};
#endif
