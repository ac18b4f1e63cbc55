/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cases.h: small scenes that between them take every choice of the configuration, for the golden runs and the tests of
   same bits. A tank of jittered water with random velocities; each case changes one thing or a few. No libc, so that it
   also runs on bare metal. */
#ifndef SPH_TEST_CASES_H
#define SPH_TEST_CASES_H

#include "sph/dmath.h"
#include "sph/sph.h"

enum { CASE_NO_WALL = SPH_WALLS };
enum { CASE_SWINGS, CASE_PROGRAMME, CASE_SPLINE };
enum { SPONGE_NONE, SPONGE_LOW, SPONGE_HIGH, SPONGE_ALL }; /* layers at low faces, at high ones, at all */

/* 0 means the default of sph_config_default throughout */
typedef struct bits_case {
    const char *name;
    uint32_t kernel, scheme, density, eos, viscosity, diffusion, integrator, wall, face;
    bool xsph, shepard, books, moving, gate, body, floor, slip_less, compressible, damped, fixed_dt;
    uint32_t solid, yield, damage, repel; /* damage: none in 1-D */
    bool hat, held, beside;               /* strain rates smoothed; one end held and pulled; a gas beside the rock */
    uint32_t gradient;
    uint32_t sponge;                      /* SPONGE_... */
    bool shifting, apart;                 /* apart: close pairs near a surface, too */
    bool flat;                            /* weights beside flat faces: none in 1-D */
    uint32_t shear, filter;
    bool hourglass;
    bool flow;                            /* water comes in and goes out along the first axis */
    bool quiet, slowed, evened;           /* acoustic damper; damping by a rate; XSPH in the velocity */
    bool bed;                             /* walls by a polyline: a box in 1-D and 3-D */
    uint32_t motion;                      /* of a wall that moves: CASE_... */
    bool energy;
    bool guard;                           /* of corrected gradients */
    uint32_t edge, layer;                 /* SPH_EDGE_...; thickness of the matched layer, spacings */
    bool widths;                          /* a smoothing length of each particle */
} bits_case;

#define CASE_BASE .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_ADAMI
#define CASE_SOLID .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .wall = CASE_NO_WALL
static const bits_case bits_cases[] = {
    {"base", CASE_BASE},
    {"kernel_cubic", .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_ADAMI},
    {"kernel_quartic", .kernel = SPH_QUARTIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_ADAMI},
    {"kernel_quintic", .kernel = SPH_QUINTIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST, .xsph = true},
    {"kernel_gaussian", .kernel = SPH_GAUSSIAN, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST, .shepard = true},
    {"kernel_wendland_c4", .kernel = SPH_WENDLAND_C4, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_ADAMI,
     .xsph = true},
    {"kernel_hat", .kernel = SPH_HAT, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_ADAMI},
    {"scheme_weak", CASE_BASE, .scheme = SPH_WEAK},
    {"scheme_direct", CASE_BASE, .scheme = SPH_DIRECT},
    /* the printed continuity weights divide by p_i, so they need a pressure that stays away from 0 */
    {"scheme_standard_wick", CASE_BASE, .scheme = SPH_STANDARD_WICK, .eos = SPH_ISOTHERMAL},
    {"scheme_weak_wick", CASE_BASE, .scheme = SPH_WEAK_WICK, .eos = SPH_ISOTHERMAL},
    {"density_summation", CASE_BASE, .density = SPH_SUMMATION},
    {"eos_tait_gray", CASE_BASE, .eos = SPH_TAIT_GRAY},
    {"eos_linear", CASE_BASE, .eos = SPH_LINEAR},
    {"eos_isothermal", CASE_BASE, .eos = SPH_ISOTHERMAL},
    {"pressure_floor", CASE_BASE, .floor = true},
    {"inviscid", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_INVISCID, .wall = SPH_WALL_ADAMI},
    {"viscosity_approaching", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL_APPROACHING,
     .wall = SPH_WALL_ADAMI},
    {"viscosity_morris", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_MORRIS, .wall = SPH_WALL_ADAMI, .slip_less = true},
    {"morris_ghost", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_MORRIS, .wall = SPH_WALL_GHOST, .slip_less = true,
     .books = true},
    {"diffusion_molteni", CASE_BASE, .diffusion = SPH_MOLTENI},
    {"diffusion_hydrostatic", CASE_BASE, .diffusion = SPH_HYDROSTATIC},
    {"diffusion_weak", CASE_BASE, .diffusion = SPH_MOLTENI, .scheme = SPH_WEAK, .books = true},
    {"kick_drift_kick", CASE_BASE, .integrator = SPH_KICK_DRIFT_KICK},
    {"leap_frog", CASE_BASE, .integrator = SPH_LEAP_FROG},
    {"leap_frog_summation", CASE_BASE, .integrator = SPH_LEAP_FROG, .density = SPH_SUMMATION},
    {"runge_kutta", CASE_BASE, .integrator = SPH_RUNGE_KUTTA},
    {"runge_kutta_momentum", CASE_BASE, .integrator = SPH_RUNGE_KUTTA_MOMENTUM, .xsph = true, .books = true},
    {"wall_lennard_jones", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_LENNARD_JONES},
    {"wall_kernel_force", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_KERNEL_FORCE},
    {"wall_monaghan_kos", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_MONAGHAN_KOS,
     .books = true},
    {"wall_ghost", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST},
    {"wall_ghost_compressible", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST,
     .compressible = true, .slip_less = true},
    {"wall_adami_no_slip", CASE_BASE, .slip_less = true},
    {"no_wall", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = CASE_NO_WALL},
    {"face_periodic", CASE_BASE, .face = SPH_PERIODIC},
    {"face_symmetry", CASE_BASE, .face = SPH_SYMMETRY},
    {"face_mirror_no_slip", CASE_BASE, .face = SPH_MIRROR_NO_SLIP, .integrator = SPH_RUNGE_KUTTA},
    {"xsph", CASE_BASE, .xsph = true},
    {"shepard", CASE_BASE, .shepard = true},
    {"books", CASE_BASE, .books = true},
    {"moving_wall", CASE_BASE, .moving = true, .books = true},
    {"moving_ghost", .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST, .moving = true,
     .integrator = SPH_RUNGE_KUTTA},
    {"gate", CASE_BASE, .gate = true},
    {"body_force", CASE_BASE, .body = true, .books = true},
    {"damped", CASE_BASE, .damped = true},
    {"fixed_dt", CASE_BASE, .fixed_dt = true, .integrator = SPH_KICK_DRIFT_KICK},
    {"solid", CASE_SOLID, .solid = SPH_UPDATED},
    {"solid_principal", CASE_SOLID, .solid = SPH_UPDATED, .repel = SPH_PRINCIPAL},
    {"solid_components", CASE_SOLID, .solid = SPH_UPDATED, .repel = SPH_COMPONENTS, .xsph = true},
    {"solid_corrected", CASE_SOLID, .solid = SPH_CORRECTED},
    {"solid_total", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = CASE_NO_WALL, .solid = SPH_TOTAL},
    {"solid_total_damage", .kernel = SPH_QUINTIC, .viscosity = SPH_ARTIFICIAL, .wall = CASE_NO_WALL, .solid = SPH_TOTAL,
     .damage = SPH_BENZ_ASPHAUG, .face = SPH_SYMMETRY},
    {"solid_strong", CASE_SOLID, .solid = SPH_UPDATED, .yield = SPH_VON_MISES, .damage = SPH_BENZ_ASPHAUG,
     .repel = SPH_PRINCIPAL,
     .books = true},
    {"solid_gray", CASE_SOLID, .solid = SPH_UPDATED, .yield = SPH_VON_MISES_GRAY, .damage = SPH_BENZ_ASPHAUG_GRAY,
     .hat = true,
     .xsph = true},
    {"solid_weak", CASE_SOLID, .solid = SPH_CORRECTED, .scheme = SPH_WEAK, .yield = SPH_VON_MISES},
    {"solid_kick_drift_kick", CASE_SOLID, .solid = SPH_CORRECTED, .integrator = SPH_KICK_DRIFT_KICK,
     .yield = SPH_VON_MISES, .held = true},
    {"solid_leap_frog", CASE_SOLID, .solid = SPH_UPDATED, .integrator = SPH_LEAP_FROG, .repel = SPH_PRINCIPAL,
     .held = true},
    {"solid_runge_kutta", CASE_SOLID, .solid = SPH_TOTAL, .integrator = SPH_RUNGE_KUTTA, .yield = SPH_VON_MISES,
     .damage = SPH_BENZ_ASPHAUG, .held = true, .books = true},
    {"solid_periodic", CASE_SOLID, .solid = SPH_CORRECTED, .face = SPH_PERIODIC, .repel = SPH_PRINCIPAL},
    {"solid_symmetry", CASE_SOLID, .solid = SPH_UPDATED, .face = SPH_SYMMETRY, .repel = SPH_COMPONENTS},
    {"solid_beside_gas", CASE_SOLID, .solid = SPH_UPDATED, .beside = true, .repel = SPH_PRINCIPAL},
    {"solid_in_tank", CASE_BASE, .solid = SPH_CORRECTED, .beside = true},
    {"bonet_lok", CASE_BASE, .gradient = SPH_BONET_LOK},
    {"bonet_lok_weak", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST,
     .gradient = SPH_BONET_LOK, .scheme = SPH_WEAK, .compressible = true, .books = true, .moving = true},
    {"bonet_lok_kick_drift_kick", CASE_BASE, .gradient = SPH_BONET_LOK, .integrator = SPH_KICK_DRIFT_KICK,
     .diffusion = SPH_HYDROSTATIC, .floor = true, .books = true},
    {"bonet_lok_periodic", CASE_BASE, .gradient = SPH_BONET_LOK, .face = SPH_PERIODIC},
    {"bonet_lok_symmetry", CASE_BASE, .gradient = SPH_BONET_LOK, .face = SPH_SYMMETRY},
    {"renormalised", CASE_BASE, .gradient = SPH_RENORMALISED},
    {"renormalised_weak", .kernel = SPH_QUINTIC, .viscosity = SPH_MORRIS, .wall = SPH_WALL_ADAMI,
     .gradient = SPH_RENORMALISED, .scheme = SPH_WEAK, .slip_less = true},
    {"renormalised_symmetry", CASE_BASE, .gradient = SPH_RENORMALISED, .face = SPH_SYMMETRY,
     .integrator = SPH_RUNGE_KUTTA},
    {"sponge", CASE_BASE, .books = true, .sponge = SPONGE_ALL},
    {"sponge_kick_drift_kick", CASE_BASE, .integrator = SPH_KICK_DRIFT_KICK, .face = SPH_SYMMETRY,
     .sponge = SPONGE_LOW},
    {"sponge_solid", CASE_SOLID, .solid = SPH_UPDATED, .sponge = SPONGE_HIGH},
    {"shifting", CASE_BASE, .shifting = true},
    {"shifting_kick_drift_kick", CASE_BASE, .shifting = true, .integrator = SPH_KICK_DRIFT_KICK,
     .diffusion = SPH_HYDROSTATIC, .floor = true, .books = true},
    {"shifting_ghost", .kernel = SPH_QUINTIC, .viscosity = SPH_MORRIS, .wall = SPH_WALL_GHOST, .shifting = true,
     .integrator = SPH_RUNGE_KUTTA, .scheme = SPH_WEAK, .xsph = true, .slip_less = true},
    {"shifting_periodic", CASE_BASE, .shifting = true, .face = SPH_PERIODIC, .integrator = SPH_LEAP_FROG},
    {"shifting_symmetry", CASE_BASE, .shifting = true, .face = SPH_SYMMETRY, .integrator = SPH_KICK_DRIFT_KICK,
     .gradient = SPH_BONET_LOK},
    {"quadrature_total", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = CASE_NO_WALL,
     .solid = SPH_TOTAL, .integrator = SPH_KICK_DRIFT_KICK, .held = true, .books = true, .flat = true},
    {"quadrature_corrected", CASE_SOLID, .solid = SPH_CORRECTED, .face = SPH_SYMMETRY, .yield = SPH_VON_MISES,
     .flat = true},
    {"mls", CASE_BASE, .shepard = true, .filter = SPH_MLS, .books = true},
    {"mls_symmetry", CASE_BASE, .shepard = true, .filter = SPH_MLS, .face = SPH_SYMMETRY,
     .integrator = SPH_KICK_DRIFT_KICK},
    {"nested", .kernel = SPH_WENDLAND_C2, .wall = SPH_WALL_ADAMI, .slip_less = true, .shear = SPH_NESTED,
     .books = true},
    {"nested_weak", .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST, .scheme = SPH_WEAK,
     .shear = SPH_NESTED, .slip_less = true, .compressible = true, .gradient = SPH_RENORMALISED, .books = true},
    {"large_eddies", CASE_BASE, .shear = SPH_SMAGORINSKY, .integrator = SPH_KICK_DRIFT_KICK,
     .gradient = SPH_BONET_LOK, .diffusion = SPH_HYDROSTATIC, .books = true},
    {"large_eddies_symmetry", CASE_BASE, .shear = SPH_SMAGORINSKY, .face = SPH_SYMMETRY,
     .integrator = SPH_RUNGE_KUTTA},
    {"large_eddies_no_slip", CASE_BASE, .shear = SPH_SMAGORINSKY_WICK, .face = SPH_MIRROR_NO_SLIP, .books = true},
    {"large_eddies_periodic", CASE_BASE, .shear = SPH_SMAGORINSKY, .face = SPH_PERIODIC,
     .integrator = SPH_LEAP_FROG},
    /* forms of solids */
    {"stabilised", CASE_SOLID, .solid = SPH_STABILISED},
    {"stabilised_kick_drift_kick", CASE_SOLID, .solid = SPH_STABILISED, .integrator = SPH_KICK_DRIFT_KICK,
     .xsph = true, .hat = true, .yield = SPH_VON_MISES, .held = true, .books = true},
    {"stabilised_weak", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST,
     .solid = SPH_STABILISED, .scheme = SPH_WEAK, .integrator = SPH_RUNGE_KUTTA, .beside = true},
    {"stabilised_symmetry", CASE_SOLID, .solid = SPH_STABILISED, .face = SPH_SYMMETRY,
     .integrator = SPH_LEAP_FROG},
    {"normalised", CASE_SOLID, .solid = SPH_NORMALISED, .integrator = SPH_LEAP_FROG, .held = true, .books = true},
    {"normalised_corrected", CASE_BASE, .solid = SPH_NORMALISED_CORRECTED, .beside = true,
     .integrator = SPH_KICK_DRIFT_KICK},
    {"normalised_corrected_periodic", CASE_SOLID, .solid = SPH_NORMALISED_CORRECTED, .face = SPH_PERIODIC,
     .scheme = SPH_WEAK, .yield = SPH_VON_MISES},
    {"hourglass", CASE_SOLID, .solid = SPH_TOTAL, .integrator = SPH_KICK_DRIFT_KICK, .hourglass = true,
     .books = true, .held = true},
    {"hourglass_symmetry", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = CASE_NO_WALL,
     .solid = SPH_TOTAL, .damage = SPH_BENZ_ASPHAUG, .face = SPH_SYMMETRY, .hourglass = true},
    /* inflows and outflows */
    {"flow", CASE_BASE, .flow = true, .books = true},
    {"flow_kick_drift_kick", CASE_BASE, .flow = true, .integrator = SPH_KICK_DRIFT_KICK, .diffusion = SPH_MOLTENI,
     .shifting = true, .books = true},
    {"flow_runge_kutta", CASE_BASE, .flow = true, .integrator = SPH_RUNGE_KUTTA, .xsph = true, .shepard = true,
     .damped = true},
    /* damper, damping by a rate, XSPH in the velocity */
    {"damper", CASE_BASE, .quiet = true, .books = true},
    {"damper_kick_drift_kick", CASE_BASE, .quiet = true, .integrator = SPH_KICK_DRIFT_KICK,
     .diffusion = SPH_HYDROSTATIC, .floor = true, .books = true, .shifting = true},
    {"damper_symmetry", CASE_BASE, .quiet = true, .face = SPH_SYMMETRY, .integrator = SPH_LEAP_FROG,
     .gradient = SPH_BONET_LOK},
    {"damper_weak", .kernel = SPH_QUINTIC, .viscosity = SPH_MORRIS, .wall = SPH_WALL_GHOST, .quiet = true,
     .scheme = SPH_WEAK, .compressible = true, .slip_less = true, .books = true},
    {"damping_rate", CASE_BASE, .slowed = true},
    {"damping_rate_runge_kutta", CASE_BASE, .slowed = true, .integrator = SPH_RUNGE_KUTTA, .xsph = true,
     .face = SPH_SYMMETRY},
    {"damping_rate_solid", CASE_SOLID, .solid = SPH_UPDATED, .slowed = true, .held = true,
     .integrator = SPH_KICK_DRIFT_KICK, .books = true},
    {"damping_rate_leap_frog", CASE_BASE, .slowed = true, .integrator = SPH_LEAP_FROG, .moving = true},
    {"xsph_velocity", CASE_BASE, .xsph = true, .evened = true, .books = true},
    {"xsph_velocity_solid", CASE_SOLID, .solid = SPH_CORRECTED, .xsph = true, .evened = true, .held = true,
     .integrator = SPH_KICK_DRIFT_KICK},
    /* polylines, motions by programme and by spline */
    {"polyline", .kernel = SPH_WENDLAND_C4, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_ADAMI, .bed = true,
     .books = true},
    {"polyline_ghost", .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST, .bed = true,
     .compressible = true, .slip_less = true, .moving = true, .motion = CASE_PROGRAMME, .books = true},
    {"polyline_force", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_KERNEL_FORCE,
     .bed = true, .integrator = SPH_KICK_DRIFT_KICK},
    {"moving_by_spline", CASE_BASE, .moving = true, .motion = CASE_SPLINE, .integrator = SPH_KICK_DRIFT_KICK},
    /* energy equation */
#define CASE_GAS .wall = CASE_NO_WALL, .eos = SPH_IDEAL_GAS, .energy = true
    {"gas", CASE_GAS, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL_APPROACHING, .face = SPH_SYMMETRY,
     .books = true},
    {"gas_weak", CASE_GAS, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .scheme = SPH_WEAK, .face = SPH_PERIODIC,
     .integrator = SPH_KICK_DRIFT_KICK, .gradient = SPH_RENORMALISED},
    {"gas_direct", CASE_GAS, .kernel = SPH_QUINTIC, .viscosity = SPH_MORRIS, .scheme = SPH_DIRECT, .books = true,
     .face = SPH_MIRROR_NO_SLIP},
    {"gas_summation", CASE_GAS, .kernel = SPH_WENDLAND_C4, .viscosity = SPH_ARTIFICIAL, .density = SPH_SUMMATION,
     .face = SPH_SYMMETRY, .integrator = SPH_RUNGE_KUTTA},
    {"gas_wick", CASE_GAS, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .scheme = SPH_STANDARD_WICK,
     .integrator = SPH_LEAP_FROG, .face = SPH_PERIODIC, .books = true},
    {"gas_weak_wick", CASE_GAS, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .scheme = SPH_WEAK_WICK,
     .face = SPH_SYMMETRY},
    {"gas_in_water", CASE_BASE, .scheme = SPH_WEAK, .energy = true, .beside = true, .books = true,
     .diffusion = SPH_MOLTENI, .integrator = SPH_KICK_DRIFT_KICK},
    {"heat_of_eddies", CASE_BASE, .energy = true, .shear = SPH_SMAGORINSKY, .slip_less = true, .books = true,
     .integrator = SPH_KICK_DRIFT_KICK},
    {"heat_of_morris", .kernel = SPH_WENDLAND_C2, .viscosity = SPH_MORRIS, .wall = SPH_WALL_GHOST, .slip_less = true,
     .compressible = true, .energy = true, .gradient = SPH_BONET_LOK},
    /* density diffusion after Antuono */
    {"antuono", CASE_BASE, .diffusion = SPH_ANTUONO, .books = true},
    {"antuono_kick_drift_kick", CASE_BASE, .diffusion = SPH_ANTUONO, .integrator = SPH_KICK_DRIFT_KICK,
     .gradient = SPH_BONET_LOK, .floor = true, .books = true},
    {"antuono_weak_symmetry", .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST,
     .diffusion = SPH_ANTUONO, .scheme = SPH_WEAK, .face = SPH_SYMMETRY, .integrator = SPH_RUNGE_KUTTA},
    {"antuono_periodic", CASE_BASE, .diffusion = SPH_ANTUONO, .face = SPH_PERIODIC, .integrator = SPH_LEAP_FROG},
    {"antuono_no_slip", CASE_BASE, .diffusion = SPH_ANTUONO, .face = SPH_MIRROR_NO_SLIP},
    /* the guard of corrected gradients */
    {"guard_kick_drift_kick", CASE_BASE, .gradient = SPH_BONET_LOK, .guard = true, .integrator = SPH_KICK_DRIFT_KICK,
     .diffusion = SPH_HYDROSTATIC, .books = true},
    {"guard_weak_symmetry", .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .wall = SPH_WALL_GHOST, .guard = true,
     .gradient = SPH_BONET_LOK, .scheme = SPH_WEAK, .face = SPH_SYMMETRY, .floor = true},
    /* edges that let waves out */
#define CASE_EDGE .kernel = SPH_CUBIC, .wall = CASE_NO_WALL, .integrator = SPH_KICK_DRIFT_KICK
    {"edge_natural", CASE_EDGE, .solid = SPH_TOTAL, .edge = SPH_EDGE_NATURAL, .books = true},
    {"edge_viscous_symmetry", CASE_EDGE, .solid = SPH_CORRECTED, .edge = SPH_EDGE_VISCOUS, .face = SPH_SYMMETRY},
    {"edge_matched", CASE_EDGE, .solid = SPH_TOTAL, .edge = SPH_EDGE_NATURAL, .layer = 3, .books = true},
    {"edge_matched_corrected", CASE_EDGE, .solid = SPH_CORRECTED, .edge = SPH_EDGE_VISCOUS, .layer = 2,
     .viscosity = SPH_ARTIFICIAL},
    {"edge_p", CASE_EDGE, .solid = SPH_UPDATED, .edge = SPH_EDGE_P, .books = true},
    {"edge_m", CASE_EDGE, .solid = SPH_TOTAL, .edge = SPH_EDGE_M},
    {"edge_h", CASE_EDGE, .solid = SPH_CORRECTED, .edge = SPH_EDGE_H, .viscosity = SPH_ARTIFICIAL},
    /* shifting of close pairs near a surface */
    {"shift_pairs", CASE_BASE, .shifting = true, .apart = true, .books = true},
    {"shift_pairs_kick_drift_kick", CASE_BASE, .shifting = true, .apart = true, .integrator = SPH_KICK_DRIFT_KICK,
     .scheme = SPH_WEAK, .floor = true},
    /* variable smoothing length */
    {"variable_h", CASE_GAS, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL_APPROACHING, .face = SPH_SYMMETRY,
     .widths = true, .books = true},
    {"variable_h_periodic", CASE_GAS, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .scheme = SPH_WEAK,
     .face = SPH_PERIODIC, .widths = true, .integrator = SPH_KICK_DRIFT_KICK},
    {"variable_h_morris", CASE_GAS, .kernel = SPH_QUINTIC, .viscosity = SPH_MORRIS, .scheme = SPH_STANDARD_WICK,
     .face = SPH_MIRROR_NO_SLIP, .widths = true, .books = true, .integrator = SPH_RUNGE_KUTTA},
};
enum { BITS_CASES = sizeof bits_cases / sizeof bits_cases[0] };

#define CASE_N (SPH_DIM == 1 ? 400 : SPH_DIM == 2 ? 40 : 8) /* particles along an edge: enough for several chunks */
#define CASE_STEPS (SPH_DIM == 3 ? 6u : 12u)
#define CASE_DX 0.1
/* enough for any case: asserted by the runners through the status of sph_init */
#define CASE_ARENA_BYTES (SPH_DIM == 3 ? 7u << 19 : 7u << 18)

static __attribute__((unused)) void case_motion(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.02 * CASE_DX * sph_sin(80 * t);
    v[0] = 0.02 * CASE_DX * 80 * sph_cos(80 * t);
}

static __attribute__((unused)) void case_programme(void *ctx, double t, double *x, double *v)
{
    static const double times[] = {0, 2e-3, 5e-3, 8e-3}, speeds[] = {0, 0.5, 0.5, -0.25};
    sph_programme m = {4, 0, times, speeds};
    (void)ctx;
#if SPH_WITH_MOVING_WALLS
    sph_motion_programme(&m, t, x, v);
#else
    (void)m, (void)t, (void)x, (void)v;
#endif
}
static __attribute__((unused)) void case_spline(void *ctx, double t, double *x, double *v)
{
    static const double times[] = {0, 3e-3, 5e-3, 0.01, 0.02}, places[] = {0, 1e-3, 2e-3, 1e-3, 4e-3};
    double bend[10];
    sph_spline m = {5, 0, times, places, bend};
    (void)ctx;
#if SPH_WITH_MOVING_WALLS
    sph_spline_make(&m, bend);
    sph_motion_spline(&m, t, x, v);
#else
    (void)m, (void)t, (void)x, (void)v;
#endif
}

static __attribute__((unused)) void case_body(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx;
    for (int k = 0; k < SPH_DIM; k++)
        a[k] += sph_sin(x[k] + t) - 0.1 * v[k];
}

/* layers over a third of the water; the low ones leave a stream alone */
static void case_sponge(sph_config *c, uint32_t sponge)
{
    const double water = CASE_N * CASE_DX / 3;
    for (int k = 0; k < SPH_DIM && sponge; k++) {
        c->sponge_low[k] = sponge != SPONGE_HIGH ? water - c->lo[k] : 0;
        c->sponge_high[k] = sponge != SPONGE_LOW ? c->hi[k] - 2 * water : 0;
        c->sponge_velocity[k] = sponge == SPONGE_LOW ? 0.25 : 0;
    }
    c->sponge_rate = sponge ? 100 : 0;
}

static sph_config case_config(const bits_case *b)
{
    sph_config c = sph_config_default();
    const double edge = CASE_N * CASE_DX;
    c.spacing = CASE_DX;
    c.smoothing_length = 1.2 * CASE_DX;
    c.sound_speed = 20;
    c.kernel = b->kernel;
    c.scheme = b->scheme;
    c.density = b->density;
    c.eos = b->eos;
    c.viscosity = b->viscosity;
    c.nu = 0.01;
    c.alpha = 0.05;
    c.beta = 0.1;
    c.diffusion = b->diffusion;
    c.gradient = b->gradient;
    c.gradient_guard = b->guard;
    c.shear = b->shear;
    c.hourglass = b->hourglass ? 0.1 : 0;
    c.integrator = b->integrator;
    c.energy = b->energy;
    c.variable_h = b->widths;
    c.h_min = b->widths ? 0.9 : c.h_min;
    c.h_max = b->widths ? 1.05 : c.h_max; /* so that small boxes have three cells */
    c.xsph = b->xsph ? 0.5 : 0;
    c.shepard_every = b->shepard ? 3 : 0;
    c.filter = b->filter;
    c.books = b->books;
    c.pressure_floor = b->floor;
    c.damping = b->damped ? 0.99 : 1;
    c.dt = b->fixed_dt ? 0.5e-3 : 0;
    c.solid = b->solid;
    c.yield = b->yield;
    c.damage = SPH_DIM > 1 ? b->damage : SPH_NO_DAMAGE;
    c.max_flaws = 40000;
    c.artificial_stress = b->repel;
    c.xsph_strain = b->hat;
    c.face_quadrature = SPH_DIM > 1 && b->flat;
    c.on_leave = SPH_REMOVE;
    c.on_cross = SPH_PUT_BACK;
    if (b->body)
        c.body_force = case_body;
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = -6 * CASE_DX;
        c.hi[k] = edge + 9 * CASE_DX;
    }
    c.gravity[SPH_DIM - 1] = -9.81;
    if (b->face != SPH_OPEN) {
        c.lo[0] = 0;
        c.hi[0] = edge;
        c.face[0][0] = c.face[0][1] = b->face;
        if (SPH_DIM == 1)
            c.gravity[0] = 0;
    }
    case_sponge(&c, b->sponge);
    c.shifting = b->shifting ? 0.5 : 0;
    c.shift_pairs = b->apart;
    c.max_flows = b->flow ? 2 : 0;
    c.damper = b->quiet ? 0.2 : 0;
    c.damping_rate = b->slowed ? 30 : 0;
    c.xsph_velocity = b->evened;
    c.max_particles = SPH_DIM == 1 ? 420 : SPH_DIM == 2 ? 2400 : 3500;
    c.edge = b->edge;
    c.edge_width = b->layer * CASE_DX;
    if (b->edge) /* they have no walls, and marks, lines, memory instead */
        c.max_particles = SPH_DIM == 1 ? 420 : SPH_DIM == 2 ? 1600 : 520;
    return c;
}

/* the water: a lattice jittered by up to a tenth of a spacing, speeds up to half a metre a second; or the rock, and its
   lower part `other`: held at the low end, or a gas */
static sph_status case_water(sph_sim *sim, uint32_t set, uint32_t other, uint32_t part)
{
    sph_rng rng;
    sph_rng_seed(&rng, 2024, 7);
    uint32_t n[3] = {CASE_N, SPH_DIM > 1 ? CASE_N : 1, SPH_DIM > 2 ? CASE_N : 1}, i[3];
    for (i[2] = 0; i[2] < n[2]; i[2]++)
        for (i[1] = 0; i[1] < n[1]; i[1]++)
            for (i[0] = 0; i[0] < n[0]; i[0]++) {
                double x[SPH_DIM], v[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    x[k] = (i[k] + 0.4 + 0.2 * sph_rng_uniform(&rng)) * CASE_DX;
                    v[k] = sph_rng_uniform(&rng) - 0.5;
                }
                const bool low = i[SPH_DIM - 1] < part;
                if (low != (set == other)) /* a set's particles come one after the other: two calls */
                    continue;
                sph_status st = sph_add_particle(sim, set, x, v, 990 + 20 * sph_rng_uniform(&rng), NULL);
                if (st)
                    return st;
            }
    return SPH_OK;
}

/* an inflow in front of the water, through the low wall, and an outflow in its last spacings */
static sph_status case_flow(sph_sim *sim, uint32_t water)
{
#if SPH_WITH_FLOW
    sph_flow f = {.face = SPH_HIGH(0), .speed = 8};
    uint32_t set;
    for (int k = 0; k < SPH_DIM; k++)
        f.hi[k] = CASE_N * CASE_DX;
    f.lo[0] = -4 * CASE_DX;
    f.hi[0] = 0;
    sph_status st = sph_add_inflow(sim, water, &f, &set);
    f.face = SPH_LOW(0);
    f.hi[0] = CASE_N * CASE_DX;
    f.lo[0] = f.hi[0] - 3 * CASE_DX;
    return st ? st : sph_add_outflow(sim, water, &f, &set);
#else
    (void)sim, (void)water;
    return SPH_BAD_ARGUMENT;
#endif
}

/* a tank whose bed is lowest in its middle */
static __attribute__((unused)) sph_status case_bed(sph_sim *sim, const sph_wall *w)
{
#if SPH_WITH_POLYLINES && SPH_HAS_WALLS && SPH_DIM == 2
    const double e = CASE_N * CASE_DX, points[5][2] = {{0, e}, {0, 0}, {0.5 * e, -2.5 * CASE_DX}, {e, 0}, {e, e}};
    return sph_add_wall_polyline(sim, w, points, 5, NULL);
#else
    (void)sim, (void)w;
    return SPH_BAD_ARGUMENT;
#endif
}

static sph_status case_walls(sph_sim *sim, const bits_case *b)
{
#if SPH_HAS_WALLS
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t faces = 0, group;
    w.kind = b->wall;
    w.no_slip = b->slip_less;
    w.compressible = b->compressible;
    w.strength = b->wall == SPH_WALL_LENNARD_JONES ? 0.02 : 0;
    if (b->moving)
        w.motion = b->motion == CASE_SPLINE ? case_spline : b->motion == CASE_PROGRAMME ? case_programme : case_motion;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        lo[k] = 0;
        hi[k] = CASE_N * CASE_DX;
        if ((k > 0 || b->face == SPH_OPEN) && (k > 0 || !b->flow))
            faces |= SPH_LOW(k) | (k + 1 < SPH_DIM || SPH_DIM == 1 ? SPH_HIGH(k) : 0);
    }
    if (!faces)
        return SPH_OK;
    sph_status st = b->bed && SPH_DIM == 2 ? case_bed(sim, &w) : sph_add_wall_box(sim, &w, lo, hi, faces, true, &group);
#if SPH_WITH_MOVING_WALLS
    return st || !b->gate ? st : sph_remove_wall_at(sim, group, 3e-3);
#else
    return st || !b->gate ? st : SPH_BAD_ARGUMENT;
#endif
#else
    (void)sim, (void)b;
    return SPH_BAD_ARGUMENT;
#endif
}

#if SPH_WITH_SOLID
static sph_status case_solids(sph_sim *sim, const bits_case *b, uint32_t *set, uint32_t *other)
{
    sph_solid rock = {0};
    sph_fluid gas = {0};
    rock.shear = 1e5;
    rock.yield = b->yield ? 2e3 : 0;
    rock.hardening = 5e3;
    rock.flat_faces = SPH_DIM > 1 && b->flat;
    sph_status st = sph_add_solid(sim, &rock, set, NULL);
    rock.held = 1;
    rock.motion = case_motion;
    gas.own_eos = true;
    gas.eos = SPH_ISOTHERMAL;
    gas.sound_speed = 1;
    if (!st && b->held)
        st = sph_add_solid(sim, &rock, other, NULL);
    if (!st && b->beside)
        st = sph_add_fluid(sim, &gas, other);
    return st;
}
#endif

static sph_status case_build(sph_sim *sim, const bits_case *b)
{
    uint32_t set = 0, other = SPH_MAX_SETS;
    sph_status st = SPH_OK;
#if SPH_WITH_SOLID
    if (b->solid)
        st = case_solids(sim, b, &set, &other);
    else
#endif
        st = sph_add_fluid(sim, NULL, &set);
#if SPH_WITH_ENERGY && SPH_WITH_SEVERAL_FLUIDS
    const sph_fluid gas = {.rho0 = 500, .sound_speed = 2, .own_eos = true, .eos = SPH_IDEAL_GAS};
    if (!st && !b->solid && b->beside)
        st = sph_add_fluid(sim, &gas, &other);
#endif
    if (!st)
        st = case_water(sim, set, other, other < SPH_MAX_SETS ? 4 : 0);
    if (!st && other < SPH_MAX_SETS)
        st = case_water(sim, other, other, 4);
#if SPH_HAS_DAMAGE
    const sph_flaws flaws = {1e12, 8.5, 11};
    if (!st && SPH_DIM > 1 && b->damage)
        st = sph_add_flaws(sim, set, &flaws);
#endif
    if (!st && b->flow)
        st = case_flow(sim, set);
#if SPH_HAS_EDGES
    sph_edges edges = {.faces = b->layer ? SPH_LOW(0) | SPH_HIGH(SPH_DIM - 1) : 0, .velocity = {0.01}};
    edges.source[0] = -1;
    if (!st && b->edge)
        st = sph_find_edges(sim, &edges);
#endif
    if (!st && b->wall != CASE_NO_WALL)
        st = case_walls(sim, b);
    return st;
}

#endif
