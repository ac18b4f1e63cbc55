/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* modules.h: one build knob for each module. -DSPH_WITH_NAME=0 leaves its code out: a configuration that asks for it is
   refused with SPH_BAD_CONFIG or SPH_BAD_ARGUMENT, a function that belongs to it does not link. -DSPH_WITH_ALL=0 turns
   every knob off that is not named. Knobs change no type, no bit and no dump, so a small build may read what a full one
   wrote. Names are those of the choices in sph.h without SPH_. */
#ifndef SPH_MODULES_H
#define SPH_MODULES_H

#ifndef SPH_WITH_ALL
#define SPH_WITH_ALL 1
#endif

/* inner loops compiled apart for common choices: same bits, more speed, more code */
#ifndef SPH_WITH_FAST_PATHS
#define SPH_WITH_FAST_PATHS SPH_WITH_ALL
#endif

/* smoothing kernels */
#ifndef SPH_WITH_CUBIC
#define SPH_WITH_CUBIC SPH_WITH_ALL
#endif
#ifndef SPH_WITH_QUARTIC
#define SPH_WITH_QUARTIC SPH_WITH_ALL
#endif
#ifndef SPH_WITH_QUINTIC
#define SPH_WITH_QUINTIC SPH_WITH_ALL
#endif
#ifndef SPH_WITH_GAUSSIAN
#define SPH_WITH_GAUSSIAN SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WENDLAND_C2
#define SPH_WITH_WENDLAND_C2 SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WENDLAND_C4
#define SPH_WITH_WENDLAND_C4 SPH_WITH_ALL
#endif
#ifndef SPH_WITH_HAT
#define SPH_WITH_HAT SPH_WITH_ALL
#endif

/* schemes */
#ifndef SPH_WITH_STANDARD
#define SPH_WITH_STANDARD SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WEAK
#define SPH_WITH_WEAK SPH_WITH_ALL
#endif
#ifndef SPH_WITH_DIRECT
#define SPH_WITH_DIRECT SPH_WITH_ALL
#endif
#ifndef SPH_WITH_STANDARD_WICK
#define SPH_WITH_STANDARD_WICK SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WEAK_WICK
#define SPH_WITH_WEAK_WICK SPH_WITH_ALL
#endif

/* density by summation; the Shepard filter; XSPH */
#ifndef SPH_WITH_SUMMATION
#define SPH_WITH_SUMMATION SPH_WITH_ALL
#endif
#ifndef SPH_WITH_SHEPARD
#define SPH_WITH_SHEPARD SPH_WITH_ALL
#endif
#ifndef SPH_WITH_XSPH
#define SPH_WITH_XSPH SPH_WITH_ALL
#endif

/* equations of state */
#ifndef SPH_WITH_TAIT
#define SPH_WITH_TAIT SPH_WITH_ALL
#endif
#ifndef SPH_WITH_TAIT_GRAY
#define SPH_WITH_TAIT_GRAY SPH_WITH_ALL
#endif
#ifndef SPH_WITH_LINEAR
#define SPH_WITH_LINEAR SPH_WITH_ALL
#endif
#ifndef SPH_WITH_ISOTHERMAL
#define SPH_WITH_ISOTHERMAL SPH_WITH_ALL
#endif

/* viscosities and density diffusion */
#ifndef SPH_WITH_ARTIFICIAL
#define SPH_WITH_ARTIFICIAL SPH_WITH_ALL
#endif
#ifndef SPH_WITH_ARTIFICIAL_APPROACHING
#define SPH_WITH_ARTIFICIAL_APPROACHING SPH_WITH_ALL
#endif
#ifndef SPH_WITH_MORRIS
#define SPH_WITH_MORRIS SPH_WITH_ALL
#endif
#ifndef SPH_WITH_MOLTENI
#define SPH_WITH_MOLTENI SPH_WITH_ALL
#endif
#ifndef SPH_WITH_HYDROSTATIC
#define SPH_WITH_HYDROSTATIC SPH_WITH_ALL
#endif

/* integrators */
#ifndef SPH_WITH_PREDICTOR_CORRECTOR
#define SPH_WITH_PREDICTOR_CORRECTOR SPH_WITH_ALL
#endif
#ifndef SPH_WITH_KICK_DRIFT_KICK
#define SPH_WITH_KICK_DRIFT_KICK SPH_WITH_ALL
#endif
#ifndef SPH_WITH_LEAP_FROG
#define SPH_WITH_LEAP_FROG SPH_WITH_ALL
#endif
#ifndef SPH_WITH_RUNGE_KUTTA
#define SPH_WITH_RUNGE_KUTTA SPH_WITH_ALL
#endif
#ifndef SPH_WITH_RUNGE_KUTTA_MOMENTUM
#define SPH_WITH_RUNGE_KUTTA_MOMENTUM SPH_WITH_ALL
#endif

/* faces of the domain beside open ones */
#ifndef SPH_WITH_PERIODIC
#define SPH_WITH_PERIODIC SPH_WITH_ALL
#endif
#ifndef SPH_WITH_SYMMETRY
#define SPH_WITH_SYMMETRY SPH_WITH_ALL
#endif
#ifndef SPH_WITH_MIRROR_NO_SLIP
#define SPH_WITH_MIRROR_NO_SLIP SPH_WITH_ALL
#endif

/* walls; walls that move or vanish */
#ifndef SPH_WITH_WALL_LENNARD_JONES
#define SPH_WITH_WALL_LENNARD_JONES SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WALL_KERNEL_FORCE
#define SPH_WITH_WALL_KERNEL_FORCE SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WALL_MONAGHAN_KOS
#define SPH_WITH_WALL_MONAGHAN_KOS SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WALL_GHOST
#define SPH_WITH_WALL_GHOST SPH_WITH_ALL
#endif
#ifndef SPH_WITH_WALL_ADAMI
#define SPH_WITH_WALL_ADAMI SPH_WITH_ALL
#endif
#ifndef SPH_WITH_MOVING_WALLS
#define SPH_WITH_MOVING_WALLS SPH_WITH_ALL
#endif

/* solids: hypoelastic stress; corrected gradients; total-Lagrangian form; yield; damage; artificial stress; strain rates
   from smoothed velocities; sets that are held or pulled. All but the first need SOLID. */
#ifndef SPH_WITH_SOLID
#define SPH_WITH_SOLID SPH_WITH_ALL
#endif
#ifndef SPH_WITH_CORRECTED
#define SPH_WITH_CORRECTED SPH_WITH_ALL
#endif
#ifndef SPH_WITH_TOTAL_LAGRANGIAN
#define SPH_WITH_TOTAL_LAGRANGIAN SPH_WITH_ALL
#endif
#ifndef SPH_WITH_YIELD
#define SPH_WITH_YIELD SPH_WITH_ALL
#endif
#ifndef SPH_WITH_DAMAGE
#define SPH_WITH_DAMAGE SPH_WITH_ALL
#endif
#ifndef SPH_WITH_ARTIFICIAL_STRESS
#define SPH_WITH_ARTIFICIAL_STRESS SPH_WITH_ALL
#endif
#ifndef SPH_WITH_XSPH_STRAIN
#define SPH_WITH_XSPH_STRAIN SPH_WITH_ALL
#endif
#ifndef SPH_WITH_HELD
#define SPH_WITH_HELD SPH_WITH_ALL
#endif

/* a body force beside gravity; work and dissipation (books); the stage log */
#ifndef SPH_WITH_BODY_FORCE
#define SPH_WITH_BODY_FORCE SPH_WITH_ALL
#endif
#ifndef SPH_WITH_BOOKS
#define SPH_WITH_BOOKS SPH_WITH_ALL
#endif
#ifndef SPH_WITH_STAGE_LOG
#define SPH_WITH_STAGE_LOG SPH_WITH_ALL
#endif

/* sph_get_totals; sph_probe, sph_probe_line, sph_gauge, sph_extent */
#ifndef SPH_WITH_TOTALS
#define SPH_WITH_TOTALS SPH_WITH_ALL
#endif
#ifndef SPH_WITH_PROBES
#define SPH_WITH_PROBES SPH_WITH_ALL
#endif

/* rings, polygons, shapes with holes; sph_apply_field, sph_apply_hydrostatic */
#ifndef SPH_WITH_SHAPES
#define SPH_WITH_SHAPES SPH_WITH_ALL
#endif
#ifndef SPH_WITH_FIELDS
#define SPH_WITH_FIELDS SPH_WITH_ALL
#endif

/* sph_dump; sph_restore (needs sph_dump's file, not the function) */
#ifndef SPH_WITH_DUMP
#define SPH_WITH_DUMP SPH_WITH_ALL
#endif
#ifndef SPH_WITH_RESTORE
#define SPH_WITH_RESTORE SPH_WITH_ALL
#endif

/* modules that share code */
#define SPH_HAS_FORCE_WALLS (SPH_WITH_WALL_LENNARD_JONES || SPH_WITH_WALL_KERNEL_FORCE || SPH_WITH_WALL_MONAGHAN_KOS)
#define SPH_HAS_LAYERED_WALLS (SPH_WITH_WALL_GHOST || SPH_WITH_WALL_ADAMI)
#define SPH_HAS_WALLS (SPH_HAS_FORCE_WALLS || SPH_HAS_LAYERED_WALLS)
#define SPH_HAS_MIRRORS (SPH_WITH_SYMMETRY || SPH_WITH_MIRROR_NO_SLIP)
#define SPH_HAS_IMAGES (SPH_WITH_PERIODIC || SPH_HAS_MIRRORS)
#define SPH_HAS_DIFFUSION (SPH_WITH_MOLTENI || SPH_WITH_HYDROSTATIC)
#define SPH_HAS_FILTERS (SPH_WITH_SHEPARD || SPH_WITH_SUMMATION)
#define SPH_HAS_EXTRAS (SPH_WITH_XSPH || SPH_WITH_BODY_FORCE || SPH_WITH_BOOKS) /* beside forces, in the same sweep */
#define SPH_HAS_RUNGE_KUTTA (SPH_WITH_RUNGE_KUTTA || SPH_WITH_RUNGE_KUTTA_MOMENTUM)
#define SPH_HAS_RATES_FIRST (SPH_WITH_KICK_DRIFT_KICK || SPH_WITH_LEAP_FROG) /* a sweep for the density of its own */

#define SPH_HAS_HELD (SPH_WITH_SOLID && SPH_WITH_HELD)
#define SPH_HAS_GROUPS (SPH_WITH_MOVING_WALLS || SPH_HAS_HELD)
#define SPH_HAS_CORRECTION (SPH_WITH_SOLID && (SPH_WITH_CORRECTED || SPH_WITH_TOTAL_LAGRANGIAN))
#define SPH_HAS_TOTAL (SPH_WITH_SOLID && SPH_WITH_TOTAL_LAGRANGIAN)
#define SPH_HAS_YIELD (SPH_WITH_SOLID && SPH_WITH_YIELD)
#define SPH_HAS_DAMAGE (SPH_WITH_SOLID && SPH_WITH_DAMAGE && SPH_DIM > 1)
#define SPH_HAS_REPULSION (SPH_WITH_SOLID && SPH_WITH_ARTIFICIAL_STRESS)
#define SPH_HAS_HAT (SPH_WITH_SOLID && SPH_WITH_XSPH && SPH_WITH_XSPH_STRAIN)

/* true if `choice` is SPH_<name> and that was compiled in: how the kernel asks for a choice everywhere */
#define SPH_IS(choice, name) (SPH_WITH_##name && (choice) == SPH_##name)

#endif
