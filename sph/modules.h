/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* modules.h: the one list of build knobs, one for each module. -DSPH_WITH_NAME=0 leaves its code out: a configuration
   that asks for it is refused with SPH_BAD_CONFIG or SPH_BAD_ARGUMENT, a function that belongs to it does not link.
   -DSPH_WITH_ALL=0 turns every knob off that is not named. Knobs change no type, no bit and no dump, so a small build
   may read what a full one wrote. Names are those of the choices in sph.h without SPH_.

   A line: X(name, what it needs to be of use). A new knob is a line here, and its default in knobs.h. */
#ifndef SPH_MODULES_H
#define SPH_MODULES_H

#include "name.h"

#define SPH_KNOBS(X)                                                                                       \
    X(FAST_PATHS, 1) /* inner loops compiled apart for common choices: same bits, more speed, more code */ \
    X(SKIP_EMPTY, SPH_DIM > 1) /* room without particles is passed over: 1 byte for 32 cells */            \
    X(CUBIC, 1) /* smoothing kernels */                                                                    \
    X(QUARTIC, 1)                                                                                          \
    X(QUINTIC, 1)                                                                                          \
    X(GAUSSIAN, 1)                                                                                         \
    X(WENDLAND_C2, 1)                                                                                      \
    X(WENDLAND_C4, 1)                                                                                      \
    X(HAT, 1)                                                                                              \
    X(STANDARD, 1) /* schemes */                                                                           \
    X(WEAK, 1)                                                                                             \
    X(DIRECT, 1)                                                                                           \
    X(STANDARD_WICK, 1)                                                                                    \
    X(WEAK_WICK, 1)                                                                                        \
    X(SUMMATION, 1) /* density by summation */                                                             \
    X(SHEPARD, 1) /* the Shepard filter */                                                                 \
    X(MLS, SPH_WITH_SHEPARD) /* density anew by moving least squares */                                    \
    X(XSPH, 1) /* velocities smoothed over neighbours */                                                   \
    X(TAIT, 1) /* equations of state */                                                                    \
    X(TAIT_GRAY, 1)                                                                                        \
    X(LINEAR, 1)                                                                                           \
    X(ISOTHERMAL, 1)                                                                                       \
    X(ARTIFICIAL, 1) /* viscosities */                                                                     \
    X(ARTIFICIAL_APPROACHING, 1)                                                                           \
    X(MORRIS, 1)                                                                                           \
    X(SEVERAL_FLUIDS, 1) /* sets of another rest density, sound, eos than the configuration's */           \
    X(MOLTENI, 1) /* density diffusion */                                                                  \
    X(HYDROSTATIC, 1)                                                                                      \
    X(ANTUONO, 1) /* with renormalised gradients of density */                                             \
    X(BONET_LOK, 1) /* corrected gradients of fluids */                                                    \
    X(RENORMALISED, 1)                                                                                     \
    X(SHEAR, 1) /* viscous stress of fluids: nested gradients, large eddies */                             \
    X(ENERGY, 1) /* energy equation, ideal gas */                                                          \
    X(VARIABLE_H, SPH_WITH_ENERGY) /* a smoothing length of each particle */                               \
    X(PREDICTOR_CORRECTOR, 1) /* integrators */                                                            \
    X(KICK_DRIFT_KICK, 1)                                                                                  \
    X(LEAP_FROG, 1)                                                                                        \
    X(RUNGE_KUTTA, 1)                                                                                      \
    X(RUNGE_KUTTA_MOMENTUM, 1)                                                                             \
    X(PERIODIC, 1) /* faces of the domain beside open ones */                                              \
    X(SYMMETRY, 1)                                                                                         \
    X(MIRROR_NO_SLIP, 1)                                                                                   \
    X(WALL_LENNARD_JONES, 1) /* walls */                                                                   \
    X(WALL_KERNEL_FORCE, 1)                                                                                \
    X(WALL_MONAGHAN_KOS, 1)                                                                                \
    X(WALL_GHOST, 1)                                                                                       \
    X(WALL_ADAMI, 1)                                                                                       \
    X(ONE_SIDED, SPH_WITH_WALL_GHOST || SPH_WITH_WALL_ADAMI) /* walls that act on one side only */           \
    X(MOVING_WALLS, 1) /* walls that move or vanish */                                                     \
    X(SOLID, 1) /* solids: hypoelastic stress */                                                           \
    X(CORRECTED, SPH_WITH_SOLID) /* corrected gradients */                                                 \
    X(TOTAL_LAGRANGIAN, SPH_WITH_SOLID) /* total-Lagrangian form */                                        \
    X(YIELD, SPH_WITH_SOLID)                                                                               \
    X(DAMAGE, SPH_WITH_SOLID && SPH_DIM > 1) /* flaws and damage */                                        \
    X(ARTIFICIAL_STRESS, SPH_WITH_SOLID)                                                                   \
    X(QUADRATURE, SPH_WITH_SOLID && (SPH_WITH_CORRECTED || SPH_WITH_TOTAL_LAGRANGIAN) && SPH_DIM > 1) \
    X(STABILISED, SPH_WITH_SOLID) /* stabilised form */                                                    \
    X(NORMALISED, SPH_WITH_SOLID) /* forms with normalised kernels */                                      \
    X(HOURGLASS, SPH_WITH_SOLID && SPH_WITH_TOTAL_LAGRANGIAN) /* control of hourglass modes */             \
    X(XSPH_STRAIN, SPH_WITH_SOLID && SPH_WITH_XSPH) /* strain rates from smoothed velocities */            \
    X(HELD, SPH_WITH_SOLID) /* sets that are held or pulled */                                             \
    X(SPONGE, 1) /* layers that take in waves */                                                           \
    X(FLOW, 1) /* inflows and outflows */                                                                  \
    X(DAMPER, 1) /* acoustic damper */                                                                     \
    X(DAMPING_RATE, 1) /* damping by a rate in time */                                                     \
    X(XSPH_VELOCITY, SPH_WITH_XSPH) /* XSPH in the velocity itself */                                      \
    X(SHIFTING, 1) /* particle shifting */                                                                 \
    X(EDGES, SPH_WITH_SOLID && SPH_WITH_KICK_DRIFT_KICK) /* edges that let elastic waves out */                      \
    X(BODY_FORCE, 1) /* a body force beside gravity */                                                     \
    X(BOOKS, 1) /* work and dissipation */                                                                 \
    X(OBJECT_PROBES, 1) /* every object shows that it was built soundly and like the others (arithmetic.h) */ \
    X(DETAILS, 1) /* failures: set and role of the particle, face, particles needed; densities of a step */ \
    X(STAGE_LOG, 1)                                                                                        \
    X(TOTALS, 1) /* sph_get_totals */                                                                      \
    X(PROBES, 1) /* sph_probe, sph_probe_line, gauges, sph_extent */                                       \
    X(INSPECT, 1) /* sph_inspect */                                                                        \
    X(POLYLINES, SPH_DIM == 2) /* sph_add_wall_polyline */ \
    X(SHAPES, 1) /* rings, polygons, shapes with holes */                                                  \
    X(FIELDS, 1) /* sph_apply_field, sph_apply_hydrostatic */                                              \
    X(DUMP, 1) /* sph_dump */                                                                              \
    X(RESTORE, 1) /* sph_restore (needs sph_dump's file, not the function) */

#include "knobs.h"

/* SPH_IN_name: the module is in, with all that it needs */
#define SPH_KNOB_IN(name, needs) SPH_IN_##name = SPH_WITH_##name && (needs),
enum { SPH_KNOBS(SPH_KNOB_IN) SPH_KNOBS_END };

/* modules that share code */
#define SPH_HAS_FORCE_WALLS (SPH_WITH_WALL_LENNARD_JONES || SPH_WITH_WALL_KERNEL_FORCE || SPH_WITH_WALL_MONAGHAN_KOS)
#define SPH_HAS_LAYERED_WALLS (SPH_WITH_WALL_GHOST || SPH_WITH_WALL_ADAMI)
#define SPH_HAS_WALLS (SPH_HAS_FORCE_WALLS || SPH_HAS_LAYERED_WALLS)
#define SPH_HAS_MIRRORS (SPH_WITH_SYMMETRY || SPH_WITH_MIRROR_NO_SLIP)
#define SPH_HAS_SIDES (SPH_WITH_ONE_SIDED && SPH_HAS_LAYERED_WALLS)
#define SPH_HAS_IMAGES (SPH_WITH_PERIODIC || SPH_HAS_MIRRORS)
#define SPH_HAS_FLUID_GRADIENT (SPH_WITH_BONET_LOK || SPH_WITH_RENORMALISED)
#define SPH_WITH_NESTED SPH_WITH_SHEAR
#define SPH_WITH_SMAGORINSKY SPH_WITH_SHEAR
#define SPH_WITH_SMAGORINSKY_WICK SPH_WITH_SHEAR
#define SPH_WITH_IDEAL_GAS SPH_WITH_ENERGY
#define SPH_HAS_DIFFUSION (SPH_WITH_MOLTENI || SPH_WITH_HYDROSTATIC || SPH_WITH_ANTUONO)
#define SPH_HAS_BOUNDED (SPH_HAS_DIFFUSION || SPH_WITH_SHIFTING) /* volumes with a bound (tiles.c) */
/* sums that depend on whom they meet: another material, or an image of what is heavier below */
#define SPH_HAS_APART (SPH_WITH_SEVERAL_FLUIDS || ((SPH_WITH_HYDROSTATIC || SPH_WITH_ANTUONO) && SPH_HAS_MIRRORS))
#define SPH_HAS_XSPH_VELOCITY (SPH_WITH_XSPH && SPH_WITH_XSPH_VELOCITY)
#define SPH_HAS_FILTERS (SPH_WITH_SHEPARD || SPH_WITH_SUMMATION)
#define SPH_HAS_EXTRAS (SPH_WITH_XSPH || SPH_WITH_BODY_FORCE || SPH_WITH_BOOKS) /* beside forces, in the same sweep */
#define SPH_HAS_RUNGE_KUTTA (SPH_WITH_RUNGE_KUTTA || SPH_WITH_RUNGE_KUTTA_MOMENTUM)
#define SPH_HAS_RATES_FIRST (SPH_WITH_KICK_DRIFT_KICK || SPH_WITH_LEAP_FROG) /* a sweep for the density of its own */
#define SPH_HAS_GROUPS (SPH_WITH_MOVING_WALLS || SPH_HAS_HELD)
#define SPH_HAS_CORRECTION (SPH_WITH_SOLID && (SPH_WITH_CORRECTED || SPH_WITH_TOTAL_LAGRANGIAN))
/* SPH_IN_... where the preprocessor asks */
#define SPH_HAS_HELD (SPH_WITH_SOLID && SPH_WITH_HELD)
#define SPH_HAS_TOTAL (SPH_WITH_SOLID && SPH_WITH_TOTAL_LAGRANGIAN)
#define SPH_HAS_YIELD (SPH_WITH_SOLID && SPH_WITH_YIELD)
#define SPH_HAS_DAMAGE (SPH_WITH_SOLID && SPH_WITH_DAMAGE && SPH_DIM > 1)
#define SPH_HAS_REPULSION (SPH_WITH_SOLID && SPH_WITH_ARTIFICIAL_STRESS)
#define SPH_HAS_QUADRATURE (SPH_HAS_CORRECTION && SPH_WITH_QUADRATURE && SPH_DIM > 1)
#define SPH_HAS_STABILISED (SPH_WITH_SOLID && SPH_WITH_STABILISED)
#define SPH_HAS_NORMALISED (SPH_WITH_SOLID && SPH_WITH_NORMALISED)
#define SPH_HAS_HOURGLASS (SPH_HAS_TOTAL && SPH_WITH_HOURGLASS)
#define SPH_HAS_EDGES (SPH_WITH_SOLID && SPH_WITH_KICK_DRIFT_KICK && SPH_WITH_EDGES)
#define SPH_HAS_HAT (SPH_WITH_SOLID && SPH_WITH_XSPH && SPH_WITH_XSPH_STRAIN)

/* true if `choice` is SPH_<name> and that was compiled in: how the kernel asks for a choice everywhere */
#define SPH_IS(choice, name) (SPH_WITH_##name && (choice) == SPH_##name)

#endif
