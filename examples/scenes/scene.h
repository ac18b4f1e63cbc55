/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* scene.h: what a scene is. A scene is written once, with kernel calls only, and runs from the command line, in the
   tests and on a bare machine alike. It is a pure function of its parameters: it keeps no state of its own.

   To run one: fill p with the parameters' values, configure, add what the host knows (port, threads), sph_init, build,
   then step; call scene_between after every step (it ends the damping when the scene asks for that). p must stay
   while the simulation lives: motions read it. */
#ifndef EXAMPLES_SCENE_H
#define EXAMPLES_SCENE_H

#include "../../sph/dmath.h"
#include "../../sph/sph.h"
#include "scene_param.h"

typedef struct scene {
    const char *name, *what; /* one line */
    const scene_param *param;
    uint32_t params; /* the common ones first, then the scene's own */
    void (*configure)(const double *p, sph_config *cfg);   /* fills cfg completely, capacities included */
    sph_status (*build)(sph_sim *sim, const double *p);    /* sets, particles, walls, fields */
    double (*end)(const double *p);                        /* s */
    uint32_t columns;                                      /* history */
    /* names with units. Those named dissipated, diffused, wall_work, work, energy or error_of_energy, with _J.. or _K..
       behind or nothing, are out of the books: without books=yes they are not to be shown. */
    const char *const *column;
    void (*history)(const sph_sim *sim, const double *p, double *row);
    const scene_unit *units;
} scene;

/* m, s, kg; in 2-D and 1-D masses, energies and powers are those of a metre of depth, or of a square metre across */
#define scene_si SPH_NAME(scene_si)
extern const scene_unit scene_si[];
/* Gray's (2001, section 5.4; solid.h): lengths in cm (caldera: km), speeds in c0, stresses in K = rho0 c0^2. 2-D */
#define scene_gray SPH_NAME(scene_gray)
extern const scene_unit scene_gray[];
#define scene_gray_km SPH_NAME(scene_gray_km)
extern const scene_unit scene_gray_km[];

#define scene_table SPH_NAME(scene_table)
extern const scene *const scene_table[]; /* the scenes of this dimension; null-terminated */

/* ---- parameters that every scene takes (scene_param.h), those that scenes read by name ----------------*/
enum {
    SCENE_KERNEL = SCENE_OF_kernel,
    SCENE_H = SCENE_OF_smoothing_length,
    SCENE_EOS = SCENE_OF_eos,
    SCENE_VISCOSITY = SCENE_OF_viscosity,
    SCENE_ALPHA = SCENE_OF_alpha,
    SCENE_NU = SCENE_OF_nu,
    SCENE_COMMON = SCENE_COMMON_COUNT
};

/* The first rows of a scene's parameter table: a row for each option that is a parameter, from the list of options, and
   the defaults in which scenes differ. SCENE_COMMON_PARAMS: as the theses step. The others step as the lab found best
   (README, findings). */
#define SCENE_COMMON_PARAMS(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_)  \
    SCENE_PARAMS_OF(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_,          \
                    SPH_PREDICTOR_CORRECTOR, 0.25, 0)
#define SCENE_PARAMS_OF(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_,      \
                        integrator_, cfl_, floor_)                                                                    \
    SCENE_PARAMS_SHIFTED(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_,     \
                         integrator_, cfl_, floor_, 0.1, 0)
/* besides, strengths of diffusion and shifting that are not the usual ones */
#define SCENE_PARAMS_SHIFTED(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_, \
                             integrator_, cfl_, floor_, delta_, shifting_)                                            \
    SPH_OPTIONS(SCENE_SKIP, SCENE_ROW, (kernel_, h_, eos_, viscosity_, alpha_, diffusion_, damping_, books_,          \
                                        integrator_, cfl_, floor_, delta_, shifting_))                                \
    {"wall", "-", "walls: lennard_jones kernel_force monaghan_kos ghost ghost_compressible adami adami_no_slip",      \
     wall_, 0, SCENE_WALLS - 1, SCENE_CHOICE},                                                                        \
    {"strength", "-", "of a boundary force, in the wall's own units (sph.h, section 6); 0: the usual", 0, 0, 1e12,    \
     SCENE_NUMBER},                                                                                                   \
    {"damp_steps", "steps", "how long damping acts; 0: to the end", damp_steps_, 0, 1e9, SCENE_WHOLE}

/* one row; a scene's own default comes out of the tuple that SCENE_PARAMS_OF hands through the list */
#define SCENE_ROW(own, name, kind, start, low, high, in, allowed, change, unit, what, word, word_unit, min, max,       \
                  whose)                                                                                              \
    {word, word_unit, what, SCENE_START_##whose(own, name, start), min, max, SCENE_KIND_##kind},
#define SCENE_START_USUAL(own, name, start) start
#define SCENE_START_OWN(own, name, start) SCENE_OWN_##name own
#define SCENE_OWN_kernel(kernel_, ...) kernel_
#define SCENE_OWN_smoothing_length(kernel_, h_, ...) h_
#define SCENE_OWN_eos(kernel_, h_, eos_, ...) eos_
#define SCENE_OWN_viscosity(k, h, e, viscosity_, ...) viscosity_
#define SCENE_OWN_alpha(k, h, e, v, alpha_, ...) alpha_
#define SCENE_OWN_diffusion(k, h, e, v, a, diffusion_, ...) diffusion_
#define SCENE_OWN_damping(k, h, e, v, a, d, damping_, ...) damping_
#define SCENE_OWN_books(k, h, e, v, a, d, damping_, books_, ...) books_
#define SCENE_OWN_integrator(k, h, e, v, a, d, damping_, books_, integrator_, ...) integrator_
#define SCENE_OWN_cfl(k, h, e, v, a, d, damping_, books_, integrator_, cfl_, ...) cfl_
#define SCENE_OWN_pressure_floor(k, h, e, v, a, d, damping_, books_, integrator_, cfl_, floor_, ...) floor_
#define SCENE_OWN_delta(k, h, e, v, a, d, damping_, books_, integrator_, cfl_, floor_, delta_, ...) delta_
#define SCENE_OWN_shifting(k, h, e, v, a, d, damping_, books_, integrator_, cfl_, floor_, delta_, shifting_) shifting_
#define SCENE_OWN_on_cross(...) SPH_PUT_BACK
#ifndef SCENE_SCHEME /* a scene may want another */
#define SCENE_SCHEME SPH_STANDARD
#endif
#define SCENE_OWN_scheme(...) SCENE_SCHEME
#define SCENE_KIND_WHOLE SCENE_WHOLE
#define SCENE_KIND_CHOICE SCENE_CHOICE
#define SCENE_KIND_BOOL SCENE_CHOICE
#define SCENE_KIND_REAL SCENE_NUMBER
#define SCENE_KIND_POSITIVE SCENE_NUMBER

/* choices of `wall`; ghosts are "incompressible" unless they say otherwise */
enum {
    SCENE_LENNARD_JONES, SCENE_KERNEL_FORCE, SCENE_MONAGHAN_KOS, SCENE_GHOST, SCENE_GHOST_COMPRESSIBLE, SCENE_ADAMI,
    SCENE_ADAMI_NO_SLIP, SCENE_WALLS
};
/* choices of `start` in scenes that have it */
enum { SCENE_UNIFORM, SCENE_HYDROSTATIC, SCENE_RELEASED };

/* ---- what scenes share ------------------------------------------------------------------------------*/

/* A configuration with the common parameters in it; spacing dx (m), rest density and sound speed as given. Leaves to
   the scene: domain, faces, gravity, max_particles. */
#define scene_config SPH_NAME(scene_config)
sph_config scene_config(const double *p, double dx, double rho0, double sound_speed);

/* The wall that the common parameters describe. */
#define scene_wall SPH_NAME(scene_wall)
sph_wall scene_wall(const double *p);

/* How far wall particles reach behind a wall (m), a spacing to spare. */
#define scene_margin SPH_NAME(scene_margin)
double scene_margin(const double *p, double dx);

/* Particles of the lattice in a box, and of the walls that scene_add_tank makes; for max_particles. */
#define scene_box_count SPH_NAME(scene_box_count)
double scene_box_count(const double *lo, const double *hi, double dx);
#define scene_wall_count SPH_NAME(scene_wall_count)
double scene_wall_count(const double *p, const double *lo, const double *hi, double dx, uint32_t faces);

/* Adds the chosen faces of a box as walls, the fluid's lattice reaching to them on the inside. Lennard-Jones walls
   stand half a spacing further out: their force begins a whole spacing from the wall and is huge at half of one. */
#define scene_add_tank SPH_NAME(scene_add_tank)
sph_status scene_add_tank(sph_sim *sim, const double *p, const double *lo, const double *hi, double dx,
                          uint32_t faces);

/* Water from a corner to another; its pressure at the start is 0, that of water at rest, or what `released` says of its
   density at a place, as `start` (SCENE_UNIFORM, ...) chooses. */
#define scene_add_water SPH_NAME(scene_add_water)
sph_status scene_add_water(sph_sim *sim, double start, const double *lo, const double *hi, sph_field_fn released,
                           void *ctx);

/* n as a capacity, at most what the kernel takes */
#define scene_capacity SPH_NAME(scene_capacity)
uint32_t scene_capacity(double n);

/* Density (kg/m^3) at which the equation of state that p chooses gives a pressure (Pa). */
#define scene_density SPH_NAME(scene_density)
double scene_density(const double *p, double pressure, double rho0, double sound_speed);

/* Pressure over rho g at a place (m from the low corner) of a column of water a wide and h high that stands against a
   wall at x = 0 on a floor, in 2-D, at the moment when it is let go on the other side: Laplace's equation with p = 0 at
   the top and at x = a, dp/dx = 0 at the wall and dp/dy = -rho g at the floor. */
#define scene_released SPH_NAME(scene_released)
double scene_released(double a, double h, const double *y);

/* Pressure (Pa) of fluid on walls at n places (m), at most SCENE_SENSORS: what Adami, Hu & Adams' equation 27 (2012)
   extrapolates there from all fluid within the kernel's support; 0 where there is none. */
enum { SCENE_SENSORS = 64 };
#define scene_wall_pressure SPH_NAME(scene_wall_pressure)
void scene_wall_pressure(const sph_sim *sim, const sph_config *c, const double (*x)[SPH_DIM], uint32_t n,
                         double *pressure);

/* To be called between steps: ends the damping after damp_steps. cfg is what the simulation was made with (port and
   hooks included) and is changed with it. */
#define scene_between SPH_NAME(scene_between)
sph_status scene_between(sph_sim *sim, const double *p, sph_config *cfg);

#define SCENE_PI 3.14159265358979323846
#define SCENE_ABS(x) ((x) < 0 ? -(x) : (x))

#endif
