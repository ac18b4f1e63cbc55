/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* scene.h: what a scene is. A scene is written once, with kernel calls only, and runs from the command line, in the
   tests and on a bare machine alike. It is a pure function of its parameters: it keeps no state of its own.

   To run one: fill p with the parameters' values, configure, add what the host knows (port, threads), sph_init, build,
   then step; call scene_between after every step (it ends the damping when the scene asks for that). p must stay while the
   simulation lives: motions read it. */
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
    const char *const *column;                             /* names with units */
    void (*history)(const sph_sim *sim, const double *p, double *row);
} scene;

#define scene_table SPH_NAME(scene_table)
extern const scene *const scene_table[]; /* the scenes of this dimension; null-terminated */

/* ---- parameters that every scene takes: p[SCENE_KERNEL] and so on -----------------------------------*/
enum {
    SCENE_KERNEL, SCENE_H, SCENE_SCHEME, SCENE_DENSITY, SCENE_EOS, SCENE_VISCOSITY, SCENE_ALPHA, SCENE_BETA, SCENE_NU,
    SCENE_DIFFUSION, SCENE_DELTA, SCENE_XSPH, SCENE_SHEPARD, SCENE_INTEGRATOR, SCENE_WALL, SCENE_STRENGTH, SCENE_CROSS,
    SCENE_DAMPING, SCENE_DAMP_STEPS, SCENE_DT, SCENE_CFL, SCENE_BOOKS, SCENE_FLOOR,
    SCENE_COMMON
};
_Static_assert(SCENE_COMMON == SCENE_COMMON_COUNT, "scene_param.h must say how many common parameters there are");

/* The first rows of a scene's parameter table, with the defaults in which scenes differ. SCENE_COMMON_PARAMS: as the theses step. The
   others step as the lab found best (README, findings). */
#define SCENE_COMMON_PARAMS(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_)   \
    SCENE_PARAMS_OF(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_,           \
                    SPH_PREDICTOR_CORRECTOR, 0.25, 0)
#define SCENE_PARAMS_OF(kernel_, h_, eos_, viscosity_, alpha_, diffusion_, wall_, damping_, damp_steps_, books_,       \
                        integrator_, cfl_, floor_)                                                                     \
    {"kernel", "-", "smoothing kernel: cubic quartic quintic gaussian wendland_c2 wendland_c4 hat", kernel_, 0,        \
     SPH_KERNELS - 1, SCENE_CHOICE},                                                                                   \
    {"h", "dx", "smoothing length in spacings", h_, 0.5, 10, SCENE_NUMBER},                                            \
    {"scheme", "-", "momentum equation: standard weak direct standard_wick weak_wick", SPH_STANDARD, 0,                \
     SPH_SCHEMES - 1, SCENE_CHOICE},                                                                                   \
    {"density", "-", "density: continuity summation", SPH_CONTINUITY, 0, SPH_DENSITIES - 1, SCENE_CHOICE},             \
    {"eos", "-", "equation of state: tait tait_gray linear isothermal", eos_, 0, SPH_EOSES - 1, SCENE_CHOICE},         \
    {"viscosity", "-", "viscosity: inviscid artificial artificial_approaching morris", viscosity_, 0,                  \
     SPH_VISCOSITIES - 1, SCENE_CHOICE},                                                                               \
    {"alpha", "-", "artificial viscosity, linear part", alpha_, 0, 100, SCENE_NUMBER},                                 \
    {"beta", "-", "artificial viscosity, quadratic part", 0, 0, 100, SCENE_NUMBER},                                    \
    {"nu", "m^2/s", "kinematic viscosity; 0: what the scene's Reynolds number asks for", 0, 0, 1e6, SCENE_NUMBER},     \
    {"diffusion", "-", "density diffusion: none molteni hydrostatic", diffusion_, 0, SPH_DIFFUSIONS - 1,               \
     SCENE_CHOICE},                                                                                                    \
    {"delta", "-", "strength of the density diffusion", 0.1, 0, 10, SCENE_NUMBER},                                     \
    {"xsph", "-", "XSPH factor; 0: off", 0, 0, 1, SCENE_NUMBER},                                                       \
    {"shepard", "steps", "Shepard density filter every so many steps; 0: never", 0, 0, 1e9, SCENE_WHOLE},              \
    {"integrator", "-",                                                                                                \
     "integrator: predictor_corrector kick_drift_kick leap_frog runge_kutta runge_kutta_momentum",                     \
     integrator_, 0, SPH_INTEGRATORS - 1, SCENE_CHOICE},                                                   \
    {"wall", "-", "walls: lennard_jones kernel_force monaghan_kos ghost ghost_compressible adami adami_no_slip",       \
     wall_, 0, SCENE_WALLS - 1, SCENE_CHOICE},                                                                         \
    {"strength", "-", "of a boundary force, in the wall's own units (sph.h, section 6); 0: the usual", 0, 0, 1e12,     \
     SCENE_NUMBER},                                                                                                    \
    {"cross", "-", "what to do with a particle found inside a wall: fail remove put_back ignore", SPH_PUT_BACK, 0,     \
     SPH_POLICIES - 1, SCENE_CHOICE},                                                                                  \
    {"damping", "-", "factor on velocities in predictor and corrector; 1: none", damping_, 0.5, 1, SCENE_NUMBER},      \
    {"damp_steps", "steps", "how long damping acts; 0: to the end", damp_steps_, 0, 1e9, SCENE_WHOLE},                 \
    {"dt", "s", "fixed time step; 0: controlled", 0, 0, 1e9, SCENE_NUMBER},                                            \
    {"cfl", "-", "Courant factor", cfl_, 1e-3, 10, SCENE_NUMBER},                                                      \
    {"books", "-", "keep work and dissipation: no yes", books_, 0, 1, SCENE_CHOICE},                                    \
    {"floor", "-", "hold the pressure of fluids at 0 or above: no yes", floor_, 0, 1, SCENE_CHOICE}

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

/* n as a capacity, at most what the kernel takes */
#define scene_capacity SPH_NAME(scene_capacity)
uint32_t scene_capacity(double n);

/* Density (kg/m^3) at which the equation of state that p chooses gives a pressure (Pa). */
#define scene_density SPH_NAME(scene_density)
double scene_density(const double *p, double pressure, double rho0, double sound_speed);

/* To be called between steps: ends the damping after damp_steps. cfg is what the simulation was made with (port and
   hooks included) and is changed with it. */
#define scene_between SPH_NAME(scene_between)
sph_status scene_between(sph_sim *sim, const double *p, sph_config *cfg);

#define SCENE_PI 3.14159265358979323846
#define SCENE_ABS(x) ((x) < 0 ? -(x) : (x))

#endif
