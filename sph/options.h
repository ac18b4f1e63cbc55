/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* options.h: the one list of what a configuration may say (sph.h, section 3). From it follow the members of
   sph_config, their defaults, checks, the digest, what a dump keeps of them, what sph_reconfigure lets through, and the
   parameters that every scene of the tool takes. A new option is a line here. What options ask of each other: config.c.

   A line: O(A, name, kind, start, low, high, in, allowed, change, unit, what), or
           P(the same, word, word_unit, min, max, whose); A is handed through.
     kind     WHOLE   uint32_t, low .. high     REAL    double, low .. high     POSITIVE  double, above low, .. high
              VECTOR  double for each axis, as REAL  BOOL                              CHOICE    uint32_t, 0 .. high - 1
              FACES   a CHOICE for the low and the high face of each axis
     start    what sph_config_default gives (that of all its components)
     in       what was compiled in: of a CHOICE its bits 1 << value (internal.h), else whether it may be other than 0
     allowed  the words of a refusal
     change   FIXED   as given to sph_init: part of the digest, so that a dump of another value is refused
              FREE    sph_reconfigure may change it: kept in dumps, and a restore takes it
              ROOM    scratch of the arena, which is no part of the scene: neither
   P: a scene's parameter, as the tool names and bounds it; of a choice `what` ends in the names of its values.
     whose    OWN: each scene says its default (SCENE_PARAMS_OF in examples/scenes/scene.h); USUAL: `start`
   The order is part of the digest: whole numbers and choices, bools, reals, axes, each in the order of the list. */
#ifndef SPH_OPTIONS_H
#define SPH_OPTIONS_H

#include "flow.h"
#include "damper.h"
#include "damping.h"
#include "evening.h"
#include "edges.h"
#include "shifting.h"
#include "smoothing_length.h"
#include "sponge.h"
/* larger magnitudes are refused: squares of them must stay finite in a float's range */
#define SPH_HUGE 1e30f

/* further lines, for tests */
#ifndef SPH_EXTRA_OPTIONS
#define SPH_EXTRA_OPTIONS(O, P, A)
#endif

#define SPH_OPTIONS(O, P, A)                                                                                          \
    /* capacity */                                                                                                    \
    O(A, max_particles, WHOLE, 0, 1, 1073741824.0f, true, "1 .. 2^30", FIXED, "-",                                    \
      "fluid and wall particles together")                                                                            \
    O(A, max_threads, WHOLE, 1, 1, 256, true, "1 .. 256", ROOM, "-", "scratch for so many threads")                   \
    O(A, max_sets, WHOLE, SPH_MAX_SETS, 1, SPH_MAX_SETS, true, "1 .. SPH_MAX_SETS", ROOM, "-", "particle sets")       \
                                                                                                                      \
    /* domain: a box that holds everything, walls included, at least one spacing along every axis */                  \
    O(A, lo, VECTOR, 0, -SPH_HUGE, SPH_HUGE, true, "finite", FIXED, "m", "low corner")                                \
    O(A, hi, VECTOR, 0, -SPH_HUGE, SPH_HUGE, true, "at least a spacing above lo on every axis, and finite", FIXED,    \
      "m", "high corner")                                                                                             \
    O(A, face, FACES, SPH_OPEN, 0, SPH_FACES, SPH_FACES_IN, "one of SPH_OPEN .. SPH_MIRROR_NO_SLIP", FIXED, "-",      \
      "what lies at the low and high face of each axis")                                                              \
    O(A, on_leave, CHOICE, SPH_FAIL, 0, SPH_REMOVE + 1, 1 << SPH_FAIL | 1 << SPH_REMOVE, "SPH_FAIL or SPH_REMOVE",    \
      FIXED, "-", "what to do with a particle that leaves through an open face: fail remove")                         \
    P(A, on_cross, CHOICE, SPH_FAIL, 0, SPH_POLICIES, (1 << SPH_POLICIES) - 1, "one of SPH_FAIL .. SPH_IGNORE",       \
      FIXED, "-", "what to do with a particle found inside a wall: fail remove put_back ignore",                      \
      "cross", "-", 0, SPH_POLICIES - 1, OWN)                                                                         \
                                                                                                                      \
    /* interpolation */                                                                                               \
    P(A, kernel, CHOICE, SPH_WENDLAND_C2, 0, SPH_KERNELS, SPH_KERNELS_IN, "one of SPH_CUBIC .. SPH_HAT", FIXED, "-",  \
      "smoothing kernel: cubic quartic quintic gaussian wendland_c2 wendland_c4 hat",                                 \
      "kernel", "-", 0, SPH_KERNELS - 1, OWN)                                                                         \
    O(A, spacing, REAL, 0, 1 / SPH_HUGE, SPH_HUGE, true, "1e-30 .. 1e30", FIXED, "m",                                 \
      "dx, initial particle spacing")                                                                                 \
    P(A, smoothing_length, POSITIVE, 0, 0, SPH_HUGE, true, "0.5 .. 10 spacings", FIXED, "m", /* 1.2 .. 2 is usual */  \
      "smoothing length in spacings", "h", "dx", 0.5, 10, OWN)                                                        \
                                                                                                                      \
    /* fluid */                                                                                                       \
    O(A, rho0, REAL, 1000, 1 / SPH_HUGE, SPH_HUGE, true, "1e-30 .. 1e30", FIXED, "kg/m^3", "rest density")            \
    O(A, sound_speed, REAL, 0, 1e-15f, 1e15f, true, "1e-15 .. 1e15", FIXED, "m/s",                                    \
      "c0; at least ten times the largest speed keeps density within 1 %")                                            \
    P(A, scheme, CHOICE, SPH_STANDARD, 0, SPH_SCHEMES, SPH_SCHEMES_IN, "one of SPH_STANDARD .. SPH_WEAK_WICK", FIXED, \
      "-", "momentum equation: standard weak direct standard_wick weak_wick",                                         \
      "scheme", "-", 0, SPH_SCHEMES - 1, OWN)                                                                       \
    P(A, density, CHOICE, SPH_CONTINUITY, 0, SPH_DENSITIES, SPH_DENSITIES_IN, "SPH_CONTINUITY or SPH_SUMMATION",      \
      FIXED, "-", "density: continuity summation", "density", "-", 0, SPH_DENSITIES - 1, USUAL)                       \
    P(A, eos, CHOICE, SPH_TAIT, 0, SPH_EOSES, SPH_EOSES_IN, "one of SPH_TAIT .. SPH_IDEAL_GAS", FIXED, "-",           \
      "equation of state: tait tait_gray linear isothermal ideal_gas", "eos", "-", 0, SPH_EOSES - 1, OWN)             \
    P(A, energy, BOOL, false, 0, 1, SPH_WITH_ENERGY, "false or true", FIXED, "-", /* 2 reals a particle */            \
      "energy equation of each particle: no yes", "energy", "-", 0, 1, USUAL)                                         \
    P(A, gamma, REAL, 1.4, 1.01f, 10, true, "1.01 .. 10", FIXED, "-",                                                 \
      "ratio of specific heats of SPH_IDEAL_GAS", "gamma", "-", 1.02, 10, USUAL)                                      \
    P(A, pressure_floor, BOOL, false, 0, 1, true, "false or true", FIXED, "-",                                        \
      "hold the pressure of fluids at 0 or above: no yes", "floor", "-", 0, 1, OWN)                                   \
    P(A, viscosity, CHOICE, SPH_ARTIFICIAL, 0, SPH_VISCOSITIES, SPH_VISCOSITIES_IN,                                   \
      "one of SPH_INVISCID .. SPH_MORRIS", FIXED, "-", "viscosity: inviscid artificial artificial_approaching morris", \
      "viscosity", "-", 0, SPH_VISCOSITIES - 1, OWN)                                                                  \
    P(A, alpha, REAL, 0.01, 0, 1e6f, true, ">= 0", FIXED, "-", "artificial viscosity, linear part",                   \
      "alpha", "-", 0, 100, OWN)                                                                                      \
    P(A, beta, REAL, 0, 0, 1e6f, true, ">= 0", FIXED, "-", /* Gray: 3 alpha */                                        \
      "artificial viscosity, quadratic part", "beta", "-", 0, 100, USUAL)                                             \
    P(A, nu, REAL, 0, 0, SPH_HUGE, true, ">= 0, and > 0 for SPH_MORRIS", FIXED, "m^2/s",                              \
      "kinematic viscosity; 0: what the scene's Reynolds number asks for", "nu", "m^2/s", 0, 1e6, USUAL)              \
    P(A, shear, CHOICE, SPH_NO_SHEAR, 0, SPH_SHEARS, SPH_SHEARS_IN, "one of SPH_NO_SHEAR .. SPH_SMAGORINSKY_WICK",    \
      FIXED, "-", "viscous stress: none nested smagorinsky smagorinsky_wick", "shear", "-", 0, SPH_SHEARS - 1, USUAL)  \
    P(A, smagorinsky, REAL, 0.12, 0, 10, true, "0 .. 10", FIXED, "-",                                                  \
      "C_s of the eddy viscosity", "cs", "-", 0, 10, USUAL)                                                           \
    P(A, subgrid, REAL, 0.0066, 0, 10, true, "0 .. 10", FIXED, "-",                                                    \
      "C_I of the eddies' pressure", "ci", "-", 0, 10, USUAL)                                                         \
    P(A, diffusion, CHOICE, SPH_NO_DIFFUSION, 0, SPH_DIFFUSIONS, SPH_DIFFUSIONS_IN,                                   \
      "one of SPH_NO_DIFFUSION .. SPH_ANTUONO", FIXED, "-", "density diffusion: none molteni hydrostatic antuono",    \
      "diffusion", "-", 0, SPH_DIFFUSIONS - 1, OWN)                                                                   \
    P(A, delta, REAL, 0.1, 0, 10, true, "0 .. 10", FIXED, "-", "strength of the density diffusion",                   \
      "delta", "-", 0, 10, OWN)                                                                                     \
    P(A, gradient, CHOICE, SPH_PLAIN, 0, SPH_GRADIENTS, SPH_GRADIENTS_IN, "one of SPH_PLAIN .. SPH_RENORMALISED",     \
      FIXED, "-", "gradients of fluids: plain bonet_lok renormalised", "gradient", "-", 0, SPH_GRADIENTS - 1, USUAL)  \
    P(A, gradient_guard, BOOL, false, 0, 1, SPH_WITH_BONET_LOK, "false or true", FIXED, "-",                          \
      "plain force of the pressure in the row at a surface: no yes", "guard", "-", 0, 1, USUAL)                       \
    P(A, xsph, REAL, 0, 0, 1, SPH_WITH_XSPH, "0 .. 1", FIXED, "-", "XSPH factor; 0: off", /* usual: 0.5; Gray 2.22 */ \
      "xsph", "-", 0, 1, USUAL)                                                                                       \
    P(A, shepard_every, WHOLE, 0, 0, 4294967296.0f, SPH_WITH_SHEPARD, "a whole number", FIXED, "steps",               \
      "Shepard density filter every so many steps; 0: never", /* Wickramarachchi 6.3 */                               \
      "shepard", "steps", 0, 1e9, USUAL)                                                                              \
    P(A, filter, CHOICE, SPH_SHEPARD, 0, SPH_FILTERS, SPH_FILTERS_IN, "SPH_SHEPARD or SPH_MLS", FIXED, "-",           \
      "how the density is made anew: shepard mls", "filter", "-", 0, SPH_FILTERS - 1, USUAL)                          \
    P(A, filter_period, REAL, 0, 0, SPH_HUGE, SPH_WITH_SHEPARD, ">= 0", FIXED, "s",                                   \
      "the density filter so often; 0: by steps", "filter_period", "s", 0, 1e9, USUAL)                                \
    O(A, gravity, VECTOR, 0, -1e15f, 1e15f, true, "finite", FREE, "m/s^2", "acceleration of gravity")                 \
                                                                                                                      \
    /* time */                                                                                                        \
    P(A, integrator, CHOICE, SPH_PREDICTOR_CORRECTOR, 0, SPH_INTEGRATORS, SPH_INTEGRATORS_IN,                         \
      "one of SPH_PREDICTOR_CORRECTOR .. SPH_RUNGE_KUTTA_MOMENTUM", FIXED, "-",                                       \
      "integrator: predictor_corrector kick_drift_kick leap_frog runge_kutta runge_kutta_momentum",                   \
      "integrator", "-", 0, SPH_INTEGRATORS - 1, OWN)                                                                 \
    /* in the predictor-corrector and kick-drift-kick on both halves of a step, else once a step (Gray 2.29) */       \
    P(A, damping, POSITIVE, 1, 0, 1, true, "> 0 and <= 1", FREE, "1",                                                 \
      "factor on velocities in predictor and corrector; 1: none", "damping", "-", 0.5, 1, OWN)                        \
    P(A, dt, REAL, 0, 0, SPH_HUGE, true, ">= 0 (0: controlled)", FREE, "s", "fixed time step; 0: controlled",         \
      "dt", "s", 0, 1e9, USUAL)                                                                                       \
    /* on h/(c0 + h max|mu|) (Wickramarachchi 3.88); the predictor-corrector takes 0.5 at most in fluids, with        \
       corrected gradients 0.25 (kick-drift-kick and leap-frog 0.9), and with solids less, down to 0.05, where        \
       viscosity and diffusion are too weak for it (factors.c) */                                                     \
    P(A, cfl, POSITIVE, 0.25, 0, 10, true, "> 0 and <= 10", FIXED, "-", "Courant factor", "cfl", "-", 1e-3, 10, OWN)  \
    O(A, viscous_factor, POSITIVE, 0.125, 0, 10, true, "> 0 and <= 10", FIXED, "-", "on h^2/nu_effective")            \
    O(A, force_factor, POSITIVE, 0.25, 0, 10, true, "> 0 and <= 10", FIXED, "-", "on sqrt(h/max|a|)") /* 3.89 */      \
    O(A, gravity_factor, POSITIVE, 0.5, 0, 10, true, "> 0 and <= 10", FIXED, "-", /* Gray 2.30 */                     \
      "on h/(c0 + sqrt(g h))")                                                                                        \
    O(A, dt_max, REAL, 0, 0, SPH_HUGE, true, ">= 0 (0: none)", FIXED, "s", "largest step; 0: none")                   \
    O(A, dt_min, REAL, 0, 0, SPH_HUGE, true, ">= 0", FIXED, "s", "a step below it counts as collapsed")               \
    P(A, books, BOOL, false, 0, 1, SPH_WITH_BOOKS, "false or true", FIXED, "-", /* 4 reals a particle */              \
      "keep work and dissipation: no yes", "books", "-", 0, 1, OWN)                                                   \
                                                                                                                      \
    /* solids; fluids may be beside them, and take part in the same sums */                                           \
    O(A, solid, CHOICE, SPH_NO_SOLID, 0, SPH_SOLIDS, SPH_SOLIDS_IN, "one of SPH_NO_SOLID .. SPH_NORMALISED_CORRECTED", \
      FIXED, "-", "solid form: none updated corrected total stabilised normalised normalised_corrected") \
    O(A, yield, CHOICE, SPH_NO_YIELD, 0, SPH_YIELDS, SPH_YIELDS_IN, "one of SPH_NO_YIELD .. SPH_VON_MISES_GRAY",      \
      FIXED, "-", "yield: none von_mises von_mises_gray")                                                             \
    O(A, damage, CHOICE, SPH_NO_DAMAGE, 0, SPH_DIM == 1 ? 1 : SPH_DAMAGES, SPH_DAMAGES_IN,                            \
      SPH_DIM == 1 ? "SPH_NO_DAMAGE in 1-D" : "one of SPH_NO_DAMAGE .. SPH_BENZ_ASPHAUG_GRAY", FIXED, "-",            \
      "damage: none benz_asphaug benz_asphaug_gray")                                                                  \
    O(A, max_flaws, WHOLE, 0, 0, 4294967296.0f, true, "1 .. 2^30 with damage", FIXED, "-",                            \
      "flaws, all sets together; with damage 1 .. 2^30")                                                              \
    O(A, artificial_stress, CHOICE, SPH_NO_ARTIFICIAL_STRESS, 0, SPH_ARTIFICIAL_STRESSES, SPH_REPULSIONS_IN,          \
      "one of SPH_NO_ARTIFICIAL_STRESS .. SPH_COMPONENTS", FIXED, "-",                                                \
      "artificial stress: none principal components") /* not with SPH_TOTAL, which needs none */                      \
    O(A, stress_exponent, WHOLE, 4, 1, 8, true, "1 .. 8", FIXED, "-", "n of the artificial stress; 4 is usual")       \
    O(A, stress_epsilon, REAL, 0.3, 0, 10, true, "0 .. 10", FIXED, "-",                                               \
      "epsilon of the artificial stress; 0.3 is usual")                                                               \
    O(A, xsph_strain, BOOL, false, 0, 1, SPH_HAS_HAT, "false or true", FIXED, "-",                                    \
      "strain rates from the smoothed velocity (Gray 2001 eq 5.10; needs xsph; costs a sweep)")                       \
    O(A, face_quadrature, BOOL, false, 0, 1, SPH_HAS_QUADRATURE, "false or true", FIXED, "-",                         \
      "quadrature weights beside the faces of sets with flat_faces (SPH_CORRECTED, SPH_TOTAL)")                        \
    O(A, hourglass, REAL, 0, 0, 100, SPH_HAS_HOURGLASS, "0 .. 100, and 0 but with SPH_TOTAL", FIXED, "-",             \
      "SPH_TOTAL: strength of the control of hourglass modes; 0: none")                                               \
    O(A, max_stretch, REAL, 1.25, 1, 8, true, "1 .. 8", FIXED, "-",                                                   \
      "SPH_TOTAL: how far a bond may be drawn, in supports; cells grow with it")                                      \
    SPH_EDGE_OPTIONS(O, P, A)                                                                                         \
    SPH_SHIFTING_OPTIONS(O, P, A)                                                                                     \
    SPH_FLOW_OPTIONS(O, P, A)                                                                                         \
    SPH_SPONGE_OPTIONS(O, P, A)                                                                                       \
    SPH_DAMPER_OPTIONS(O, P, A)                                                                                       \
    SPH_DAMPING_OPTIONS(O, P, A)                                                                                      \
    SPH_EVENING_OPTIONS(O, P, A)                                                                                      \
    SPH_VARIABLE_H_OPTIONS(O, P, A)                                                                                   \
    SPH_EXTRA_OPTIONS(O, P, A)

/* members of sph_config */
#define SPH_OPTION_MEMBER(A, name, kind, ...) SPH_MEMBER_##kind(name)
#define SPH_MEMBER_WHOLE(name) uint32_t name;
#define SPH_MEMBER_CHOICE(name) uint32_t name;
#define SPH_MEMBER_BOOL(name) bool name;
#define SPH_MEMBER_REAL(name) double name;
#define SPH_MEMBER_POSITIVE(name) double name;
#define SPH_MEMBER_VECTOR(name) double name[SPH_DIM];
#define SPH_MEMBER_FACES(name) uint32_t name[SPH_DIM][2];

#endif
