/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sph.h: smoothed particle hydrodynamics inside memory that you hand over, with the same bits everywhere.

   The whole manual is this file, in the order in which a host meets things:
     1 build knobs   2 status   3 configuration   4 arena and life   5 fluid and solid   6 walls   7 step
     8 reading the state   9 books, probes, gauges, inspection   10 hash   11 dump and restore

   A host fills a configuration, asks how many bytes it needs, hands over an arena, adds particles and
   walls, and steps. The library calls no allocator, opens no file, prints nothing and keeps no global
   state. Only sqrt, memcpy, memset and memmove are needed at link time. Units are SI (or any consistent
   set). Positions, times and everything of set-up are double in every build; `sph_real` is what particles
   are computed in. Arrays of SPH_DIM doubles hold x, then y, then z; the last axis is "up" only because
   gravity usually points down it.

   Bits: the order of every sum depends on positions and ids only. Any compiler that keeps IEEE 754
   (-ffp-contract=off, no -ffast-math), any number of threads, any slicing, and a run restored from a dump
   give the same state to the last bit; float and double builds differ from each other. */
#ifndef SPH_H
#define SPH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- 1 build knobs ---------------------------------------------------------------------------------
   SPH_DIM 1, 2, 3 and SPH_DOUBLE 0, 1 must be the same for the library and its users (see name.h: a
   mismatch does not link). The knobs SPH_WITH_... of modules.h leave code out; they change no type. */
#include "modules.h"
#include "name.h"

#ifdef __cplusplus
extern "C" {
#endif

#if SPH_DOUBLE
typedef double sph_real;
#else
typedef float sph_real;
#endif

/* 1: no solids; 2: no sponges; 3: before `rise`, with fewer books; 4: before `lag`; 5: before flows, energies */
#define SPH_VERSION 7u
#define SPH_MAX_SETS 64u   /* particle sets: a body of fluid, one side of a wall, one corner */
#define SPH_MAX_GROUPS 16u /* groups of wall sets that move or vanish together */

/* ---- 2 status --------------------------------------------------------------------------------------
   Every function that can fail returns one of these; sph_last() tells more about the latest failure. A call that fails
   changes nothing but that report (sph_step may have made the first forces, as sph_ready does), and writes to none of
   its results.
   Null pointers: a function that returns a status refuses them with SPH_BAD_ARGUMENT where the manual does not allow
   them, the simulation included (a null configuration is SPH_BAD_CONFIG, a null arena SPH_ARENA_TOO_SMALL); one that
   returns nothing does nothing; sph_arena_bytes, sph_count, sph_time and sph_hash give 0, sph_last a constant report.
   Pointers that are not null must be good, and a simulation must come from sph_init: it cannot be seen from inside. */
#define SPH_STATUS_LIST(X)                                                                             \
    X(OK, "ok")                                                                                        \
    X(NOT_DONE, "the slice's budget is spent; call sph_step_slice again to finish the step")           \
    X(BAD_CONFIG, "a field of the configuration is not allowed")                                       \
    X(BAD_ARGUMENT, "an argument is not allowed")                                                      \
    X(BAD_STATE, "the call is not allowed at this moment (a step is under way, or nothing was added)") \
    X(ARENA_TOO_SMALL, "the arena is too small; the bytes needed are in the report")                   \
    X(ARENA_UNALIGNED, "the arena is not aligned to SPH_ALIGN bytes")                                  \
    X(ARITHMETIC, "this build or machine does not do IEEE 754 arithmetic, or an object is unlike others") \
    X(TOO_MANY_PARTICLES, "the particle capacity is exhausted")                                        \
    X(TOO_MANY_SETS, "the capacity for particle sets or wall groups is exhausted")                     \
    X(TOO_MANY_FLAWS, "the capacity for flaws is exhausted")                                           \
    X(NOT_FINITE, "a particle's rate or state is not finite")                                          \
    X(DENSITY_LOST, "a particle's density left the range that its equation of state allows")           \
    X(OUT_OF_DOMAIN, "a particle left the domain through an open face")                                \
    X(MOVED_TOO_FAR, "a particle moved more than a cell in one step")                                  \
    X(WALL_CROSSED, "a particle crossed a wall")                                                       \
    X(BOND_TOO_LONG, "two neighbours of the total-Lagrangian form were drawn further apart than max_stretch") \
    X(ENERGY_LOST, SPH_WITH_ENERGY ? "a particle's energy fell below 0" : "")                          \
    X(STEP_COLLAPSED, "the time step fell below dt_min")                                               \
    X(SINK_FAILED, "the byte sink or source reported a failure")                                       \
    X(DUMP_TRUNCATED, "the dump ends too early")                                                       \
    X(DUMP_CORRUPT, "the dump's checksum or structure is wrong")                                       \
    X(DUMP_FOREIGN, "these bytes are not a dump of this library, dimension and precision")             \
    X(DUMP_NEWER, "the dump was written by a newer version")                                           \
    X(DUMP_MISMATCH, "the dump belongs to another configuration, set-up or capacity")

typedef enum sph_status {
#define SPH_STATUS_ENUM(name, text) SPH_##name,
    SPH_STATUS_LIST(SPH_STATUS_ENUM)
#undef SPH_STATUS_ENUM
        SPH_STATUS_COUNT
} sph_status;

/* The text of a status; never null. */
#define sph_status_text SPH_NAME(status_text)
const char *sph_status_text(sph_status s);

#define SPH_NO_PARTICLE 0xffffffffu

/* What the latest failure was about. Pointers are to constant strings. */
typedef struct sph_report {
    sph_status status;
    const char *what;    /* name of the field, argument or quantity; "" if none */
    const char *allowed; /* what would be allowed, in words; "" if none */
    const char *pass;    /* pass of the step in which it happened; "" outside a step */
    double value;        /* the offending value; what is needed: bytes for ARENA_TOO_SMALL, particles for
                            TOO_MANY_PARTICLES (of which 2^24 beyond the capacity are counted at most) */
    uint32_t particle;   /* id of the particle with the smallest id at fault, or SPH_NO_PARTICLE */
    uint32_t set, role;  /* of that particle: SPH_ROLE_...; SPH_MAX_SETS, SPH_ROLES: not known */
} sph_report;

/* ---- 3 configuration -------------------------------------------------------------------------------*/

/* Smoothing kernels (supports in units of the smoothing length h). Sources: cubic Monaghan & Lattanzio
   1985; quartic, quintic B-splines Schoenberg; Wendland 1995, the member of the family for each dimension;
   truncated Gaussian, support 3h, renormalised; hat: for the stability lab only. */
enum { SPH_CUBIC, SPH_QUARTIC, SPH_QUINTIC, SPH_GAUSSIAN, SPH_WENDLAND_C2, SPH_WENDLAND_C4, SPH_HAT, SPH_KERNELS };

/* Schemes: one momentum equation and the continuity equation that conserves energy with it.
   STANDARD  dv = -sum m_j (p_i/rho_i^2 + p_j/rho_j^2 + Pi) grad W,  drho = sum m_j v_ij.grad W
             (Gray 2001 eqs 2.17, 2.21)
   WEAK      dv = -sum m_j ((p_i + p_j)/(rho_i rho_j) + Pi) grad W,  drho = rho_i sum (m_j/rho_j) v_ij.grad W
             (Wickramarachchi 2009 eq 3.80; the continuity form follows from it by energy conservation)
   DIRECT    dv = -sum m_j ((p_j - p_i)/(rho_i rho_j) + Pi) grad W,  drho as WEAK
             (Wickramarachchi 2009 eqs 3.21, 3.22: conserves neither momentum nor energy; kept to show it)
   STANDARD_WICK, WEAK_WICK: the continuity forms printed as 3.50 and 3.79, which weight a pair by pressures
             divided by p_i; where |p_i| is below 1e-6 rho0 c0^2 the weight falls back to 1. */
enum { SPH_STANDARD, SPH_WEAK, SPH_DIRECT, SPH_STANDARD_WICK, SPH_WEAK_WICK, SPH_SCHEMES };

/* Density: evolved by the scheme's continuity equation, or summed, rho_i = sum m_j W_ij (Gray eq 2.19). */
enum { SPH_CONTINUITY, SPH_SUMMATION, SPH_DENSITIES };

/* Equations of state, s = rho/rho0. TAIT: p = rho0 c0^2/7 (s^7 - 1), with which c0 is the sound speed at
   rho0. TAIT_GRAY: p = rho0 c0^2 (s^7 - 1) as Gray 2001 prints it: its true sound speed is sqrt(7) c0.
   LINEAR: p = c0^2 (rho - rho0). ISOTHERMAL: p = c0^2 rho. IDEAL_GAS: p = (gamma - 1) rho u, with the energy equation;
   begins with the u (J/kg) whose sound speed is that of its set, c0^2/(gamma (gamma - 1)) (sph_apply_energy). */
enum { SPH_TAIT, SPH_TAIT_GRAY, SPH_LINEAR, SPH_ISOTHERMAL, SPH_IDEAL_GAS, SPH_EOSES };

/* The energy equation (option `energy`; not with solids, the damper, flows; SPH_USE_ENERGY): each particle has an
   energy u (J/kg). Of an ideal gas that is all of the internal energy, du = p/rho^2 drho by the scheme's own rate of
   density and the heat of viscosity (Wickramarachchi 2009 eqs 3.23, 3.42, 3.52, 3.81): total energy is kept at every
   instant in every scheme but DIRECT, entropy never falls (but with RENORMALISED gradients, which want a gas). Of
   other fluids u is the heat of viscosity, from 0 on, beside the energy of compression. Artificial viscosity has the
   mean sound of both particles, and steps go by the fastest. Energy below 0 is ENERGY_LOST. A gas stands beside
   mirror and periodic faces, walls of one row, and walls of another fluid: where the configuration's own eos is
   IDEAL_GAS there are no GHOST and ADAMI walls, whose pressure must follow from their density. Beside a fluid of
   another density take the WEAK scheme. A density that is summed: a gas alone, not in KICK_DRIFT_KICK, LEAP_FROG. */

/* A smoothing length of each particle (option `variable_h`; smoothing_length.c): h_i = eta (m_i/rho_i)^(1/DIM), eta =
   smoothing_length/spacing, between h_min and h_max times smoothing_length (Powell 2012 eq 1.21). A pair has the mean
   (h_i + h_j)/2 (Wickramarachchi 2009 eq 3.46): momentum, angular momentum and energy stay as with one h, entropy too.
   For a gas (eos IDEAL_GAS) whose density goes by plain continuity. Cells are of h_max; steps go by the smallest h/c.
   Probes see each particle with its own h. SPH_ARENA_BYTES: or in SPH_USE_VARIABLE_H, with cells of h_max. */

/* Forms of a solid's equations; NO_SOLID: the scene has fluids only. With T = -sigma/rho^2, K_ij the vector between two
   particles, g = (dW/dr)/r at |K|, and v_ij = v_i - v_j:
   UPDATED    dv = sum m_j (-T_i - T_j) . K g,  velocity gradient L = -(1/rho_i) sum m_j v_ij (x) K g, K = x_ij
              (Gray 2001 eqs 5.9, 5.21). Weak scheme: -sigma/(rho_i rho_j) and m_j/rho_j. Gray prints (5.6, 5.10) the
              weak rates beside the standard momentum; the pairs here conserve energy.
   CORRECTED  L = (-sum m_j v_ij (x) K g) M^-1, M = -sum m_j x_ij (x) K g: exact for linear fields, and the force that
              does the same work, T = -sigma M^-T/rho (Bonet & Lok 1999), so momentum and angular momentum stay. Costs
              a sweep. Where M is nearly singular or small (lone particles, lines of them, particles a
              support apart) the plain form is taken.
   TOTAL      the same with K the vector in the reference position, for pairs of one body of which neither is fully
              damaged; fixed neighbours, no tensile instability. A particle may go half a domain's length from where
              it began (else MOVED_TOO_FAR). Contact of two bodies: no stress is shared; they push each other along
              x_ij, nearer than dx, as by a pressure rho0 c0^2 (W/W(dx) - 1) of the configuration in both: no
              adhesion, no friction but that of uneven surfaces (and viscosity where that is asked for). Other pairs
              (rubble, fluid) take K = x_ij.
   With hourglass > 0 (TOTAL) what of its bonds a particle's deformation gradient F does not explain stores energy,
              (m_i/2) k sum m_j (-g) |x_ij - F_i K|^2, k = hourglass E/rho0^2 with Young's modulus E, and pushes back
              (after Ganzenmueller 2015; hourglass.h). Costs a sweep and SPH_DIM^2 + 1 reals a particle.
   STABILISED UPDATED with, along axes in tension, a kernel whose sums over neighbours vanish (Powell 2012 section 4.2;
              stabilised.h): no tensile instability, and bodies may flow and come apart. Momentum is kept, energy is
              not. Wants xsph_velocity with xsph 0.1, without which pushes grow still, at a fifth of their rate. Costs
              two sweeps and 5 SPH_DIM + 3 reals a particle.
   NORMALISED UPDATED with the gradient of the kernel over its sum, exact for constants (Powell 2012 eq 1.14), and
   NORMALISED_CORRECTED  of that, corrected to be exact for linear fields (his 1.19), in the velocity gradient and in
              each particle's own force. Keep neither momentum nor energy, and fail in tension: for comparison. Cost a
              sweep and SPH_DIM^2 + SPH_DIM reals.
   With face_quadrature (CORRECTED, TOTAL; 2-D, 3-D) sets with flat_faces count the energy of the particles beside their
   free faces, and so T, with weights phi that make bending of second order: 1 + c in the outermost row, 1 - c in the
   next, c = 0.07 where the kernel reaches neighbours and diagonals only (quadrature.c). Made with the first forces and
   kept, one real a particle. For faces along a lattice of the configured spacing; on rims with steps they do harm. */
enum {
    SPH_NO_SOLID,
    SPH_UPDATED,
    SPH_CORRECTED,
    SPH_TOTAL,
    SPH_STABILISED,
    SPH_NORMALISED,
    SPH_NORMALISED_CORRECTED,
    SPH_SOLIDS
};

/* Yield. VON_MISES: where sqrt(3 J2) exceeds Y = yield + hardening * plastic strain, S is returned along the radius.
   With hardening the plastic strain of a return is (sqrt(3 J2) - Y)/(3 mu + hardening). VON_MISES_GRAY: S times
   Y^2/(3 J2), with J2 without its zz part, as Gray 2001 eqs 5.14 and 5.15 print it; it lands inside the yield
   surface. */
enum { SPH_NO_YIELD, SPH_VON_MISES, SPH_VON_MISES_GRAY, SPH_YIELDS };

/* Damage (2-D, 3-D). BENZ_ASPHAUG: d(D^(1/DIM))/dt = active crack_speed/flaw_radius, D at most (active/flaws), where
   a flaw is active while the strain exceeds its threshold; the strain is the largest principal stress over (1 - D) E
   (Benz & Asphaug 1995; Gray 2001 eqs 5.33-5.42). BENZ_ASPHAUG_GRAY: over 2 mu (1 - D^2), as his eq 5.35 prints it. */
enum { SPH_NO_DAMAGE, SPH_BENZ_ASPHAUG, SPH_BENZ_ASPHAUG_GRAY, SPH_DAMAGES };

/* Artificial stress against clumping in tension: T_i + T_j gains (R_i + R_j) (W/W(dx))^n, R = epsilon sigma/rho^2 on
   tension: PRINCIPAL on each principal stress (Gray 2001 eqs 5.22-5.28), COMPONENTS on each component of the stress
   (Monaghan 2000). The sign is that of 5.26, which repels. */
enum { SPH_NO_ARTIFICIAL_STRESS, SPH_PRINCIPAL, SPH_COMPONENTS, SPH_ARTIFICIAL_STRESSES };

/* Viscosities. ARTIFICIAL: Pi = -(h/rho_mean)(alpha c0 + beta h |mu|) mu, mu = v.r/(r^2 + 0.01 h^2), on
   approaching and receding pairs (Gray 2.18). ARTIFICIAL_APPROACHING: on approaching pairs only
   (Wickramarachchi 3.18). MORRIS: sum m_j (4 nu/(rho_i + rho_j)) (r.grad W)/(r^2 + 1e-6 h^2) v_ij with the
   kinematic viscosity nu (Morris, Fox & Zhu 1997, with the mean of both densities). */
enum { SPH_INVISCID, SPH_ARTIFICIAL, SPH_ARTIFICIAL_APPROACHING, SPH_MORRIS, SPH_VISCOSITIES };

/* Density diffusion, drho_i += 2 delta h c0 sum (m_j/rho_j) psi_ij.grad W over what is of one material, with rho_j
   in m_j/rho_j not below 0.95 rho0 (spray loses density without bound, and the step's bound is for volumes at rest); it
   limits the step to h/(8 delta c0), in the predictor-corrector to half of that, in Runge-Kutta to twice. MOLTENI: psi
   = (rho_j - rho_i) r_ji/|r|^2 (Molteni & Colagrossi 2009). HYDROSTATIC: the density difference that gravity makes
   between the two positions (of an image: of its original's) is taken off first (Fourtakas et al. 2019, linearised), so
   still water stays still. ANTUONO: the mean of the two particles' renormalised gradients of density (kg/m^4) times
   r_ji is taken off, so that no linear field of density feels any, whatever made it (Antuono, Colagrossi, Marrone &
   Molteni 2010); images in faces across which gravity pulls have no part in it; SPH_DIM reals a particle
   (SPH_USE_ANTUONO) and a sweep; not with solids. Of sets with sound speeds of their own (sph_fluid) diffusion takes
   the set's, artificial viscosity the mean of both. */
enum { SPH_NO_DIFFUSION, SPH_MOLTENI, SPH_HYDROSTATIC, SPH_ANTUONO, SPH_DIFFUSIONS };

/* Gradients of fluids (scenes without solids). PLAIN: g x_ij. BONET_LOK: exact for linear velocities in the rate of
   density, and the pressure force that does the same work (Bonet & Lok 1999; schemes STANDARD and WEAK); momentum,
   angular momentum and energy stay. RENORMALISED: (B_i + B_j)/2 x_ij g in continuity, pressure and artificial
   viscosity (Wickramarachchi 2009 eqs 4.8-4.20); momentum and energy stay. Both cost a sweep and SPH_DIM (SPH_DIM +
   1)/2 reals a particle; where neighbours do not span space the plain gradient is taken. Still water without viscosity
   is stirred beside its surface (README, findings) but with gradient_guard (BONET_LOK): there the force of the pressure
   becomes the plain one where det E, E = M/rho, falls from 0.6 to 0.3, as in the outermost row; rates of density and
   what is exact of them stay, momentum too; the energy that is not kept is on the books (`unbalanced`). */
enum { SPH_PLAIN, SPH_BONET_LOK, SPH_RENORMALISED, SPH_GRADIENTS };

/* How the density is made anew every shepard_every steps, or each time that filter_period (s) has passed (not beside
   solids or summed density). SHEPARD: the mean of the neighbours' by W (Wickramarachchi 2009 eq 6.3). MLS: moving least
   squares of order 1, exact for densities that are linear in place (his A.4.1-A.4.7). */
enum { SPH_SHEPARD, SPH_MLS, SPH_FILTERS };

/* Viscous stress of fluids (scenes without solids), beside or instead of a viscosity above (not MORRIS, which takes the
   same nu). NESTED: tau = 2 rho nu (S - tr S/3) of the gradient of the velocity (Wickramarachchi 2009 eqs 5.4-5.12, in
   a form that keeps momentum and energy). SMAGORINSKY: large eddies, nu + (smagorinsky dx)^2 |S| for nu, and a pressure
   2/3 subgrid rho dx^2 |S|^2 (his eqs 5.18, 5.19, 5.32, 5.33). SMAGORINSKY_WICK: nu + smagorinsky dx^2 |S|^2, as the
   line after his 5.32 prints it (then the constant is a time, s). What they take is never negative but beside
   MIRROR_NO_SLIP. Costs a sweep and SPH_DIM^2 + 1 reals a particle (SPH_USE_SHEAR). With corrected gradients exact
   where the velocity is linear. */
enum { SPH_NO_SHEAR, SPH_NESTED, SPH_SMAGORINSKY, SPH_SMAGORINSKY_WICK, SPH_SHEARS };

/* Integrators. All are of second order in time in every field, with walls and forces that change with time and steps
   that change. PREDICTOR_CORRECTOR: Gray 2001 eqs 2.26-2.28, one force evaluation a
   step; in fluids the predicted density foresees how its rate rises (kick.h): it stands a Courant number of 0.5.
   KICK_DRIFT_KICK: velocity Verlet; density and stress go by the rates of the step's middle, so a step takes two sweeps
   (rates, forces). LEAP_FROG: Powell 2012 algorithm 1.1, the same with velocities that are kept half a step ahead;
   where steps change they are kicked by the mean of two. After a change of gravity, of the body force's function, of
   walls, or sph_apply_field it starts anew. RUNGE_KUTTA: Wickramarachchi 3.85-3.87; RUNGE_KUTTA_MOMENTUM: his 3.91-3.92
   (algebraically the same midpoint rule, rounded differently). In scenes with solids the predictor-corrector and
   Runge-Kutta make sound of the shortest waves grow unless viscosity outruns it: their steps are as short as that asks
   (factors.c). */
enum {
    SPH_PREDICTOR_CORRECTOR,
    SPH_KICK_DRIFT_KICK,
    SPH_LEAP_FROG,
    SPH_RUNGE_KUTTA,
    SPH_RUNGE_KUTTA_MOMENTUM,
    SPH_INTEGRATORS
};

/* What lies at a face of the domain box. OPEN: nothing (see on_leave). PERIODIC: both faces of the axis.
   SYMMETRY: mirrored ghosts, free slip (also a symmetry plane). MIRROR_NO_SLIP: mirrored ghosts with both
   velocities reversed (Wickramarachchi 6.1). Mirrored and periodic images cost no memory; corners are
   mirrored twice. A particle never passes a mirror face: it is reflected and counted. */
enum { SPH_OPEN, SPH_PERIODIC, SPH_SYMMETRY, SPH_MIRROR_NO_SLIP, SPH_FACES };

/* Sponge layers along faces that are not periodic, where waves die away: dv/dt = -sponge_rate S (v - sponge_velocity),
   S = sum over faces of s^2, s = (width - distance to the face)/width within a layer, else 0 (Powell 2012 section 2.1).
   Widths (m) are sponge_low and sponge_high of each axis, 0: none; the rate (1/s) is that at the face. Damps fluid and
   solid, not walls nor axes that are held, exactly and once a step, at its end: velocities inside a layer stand half a
   step of damping ahead. What it takes is `absorbed` in sph_totals, with or without books. SPH_ARENA_BYTES: or in
   SPH_USE_BOOKS. Waves want layers of a wavelength or more, and rate width/c about 10 (tests/lab/atlas_sponge.csv). */

/* Edges of solids that elastic waves leave through (with KICK_DRIFT_KICK; edges.c has the equations). sph_find_edges
   says where they are. NATURAL: a traction that answers the velocity of the edge, on lines of particles: it cannot add
   energy, needs no memory, and reflects 3 % of waves at right angles, more the flatter they come in. VISCOUS: the same
   on the outermost particles alone (Powell 2012 eq 2.75). edge_width > 0: a matched layer of that thickness before such
   an edge, along axes, which reflects below 1 % of P waves to 30 degrees at 10 spacings, 1.4 % at 60. P, M, H: Powell
   2012 eqs 2.42, 2.45, 2.33 instead of the momentum equation in edge_layers layers; as printed too; may grow without
   bound. What the edges take is `absorbed` in sph_totals, with or without books; by P, M, H and matched layers to the
   first order in dt. The stress that stands when the edges are found is held, so static loads do not creep.
   SPH_ARENA_BYTES: or in SPH_USE_EDGES. */
enum {
    SPH_NO_EDGE,
    SPH_EDGE_NATURAL,
    SPH_EDGE_VISCOUS,
    SPH_EDGE_P,
    SPH_EDGE_M,
    SPH_EDGE_M_PRINTED,
    SPH_EDGE_H,
    SPH_EDGE_H_PRINTED,
    SPH_EDGES
};

/* Particle shifting, `shifting` its strength C, 0: off: at a step's end each particle of fluid drifts from where
   others are dense to where they are sparse, -C dt v_max 4h sum V_j [1 + 0.2 (W/W(dx))^4] grad W, at most 0.05 dx; not
   near a surface (Lind, Xu, Stansby & Rogers 2012; shifting.c). V is m/rho, but in weak schemes at most 2 m/rho0. It
   keeps the particles even, and with that the pressure free of noise: wants h 2 dx, and with C 0.5 so little viscosity
   as alpha 0.005. Deep inside density goes slowly to where the particles' volumes fill space, so that a tank does not
   swell. Momentum stays, angular momentum does not; what is taken of potential and internal energy is `shifted` in
   sph_totals, with or without books (where density is summed, of the potential energy only). Not in scenes with
   solids. SPH_ARENA_BYTES: or in SPH_USE_SHIFTING. With shift_pairs particles near a surface, which are not shifted
   else, are moved off those that are closer than 0.8 dx: keeps rows apart that the flow squeezes there. */

/* Acoustic damper, `damper` its theta, 0: off: in the momentum equation and in what Adami's walls see the pressure is
   p + theta h c0 d(rho)/dt, at least 0 with the pressure floor: a bulk viscosity theta h c0, which sound feels and flow
   without divergence does not (damper.c). What it takes of the energy is `quieted` in sph_totals, with or without
   books. 0.2 is usual; it shortens the step (factors.c). Predictor-corrector, kick-drift-kick, leap-frog; not with
   solids, summed density or printed continuity. SPH_ARENA_BYTES: or in SPH_USE_DAMPER.

   Damping by a rate in time, `damping_rate` r (1/s): dv/dt = -r v, exact and of second order in every integrator, for
   whatever dt, unlike `damping`, which acts by steps; takes `slowed` (damping.c). SPH_ARENA_BYTES: or in SPH_USE_BOOKS.

   XSPH in the velocity itself, `xsph_velocity`: once a step v_i += xsph sum (m_j/rho_mean) (v_j - v_i) W instead of a
   drift of the positions (Powell 2012 eq 2.71); momentum stays; takes `evened` (evening.c). SPH_ARENA_BYTES: or in
   SPH_USE_BOOKS. */

/* What to do with a particle that leaves through an open face (FAIL or REMOVE) or is found inside a wall
   (any of the four; PUT_BACK sets it 0.1 spacings off the wall, without its velocity into the wall). */
enum { SPH_FAIL, SPH_REMOVE, SPH_PUT_BACK, SPH_IGNORE, SPH_POLICIES };

/* What set the time step; also named in sph_step_info. */
#define SPH_LIMIT_LIST(X)                                                                                   \
    X(FIXED, "fixed") X(COURANT, "courant") X(VISCOUS, "viscous") X(FORCE, "force") X(GRAVITY, "gravity")  \
    X(CEILING, "dt_max") X(TARGET, "end time") X(DIFFUSIVE, "diffusion")
enum {
#define SPH_LIMIT_ENUM(name, text) SPH_LIMIT_##name,
    SPH_LIMIT_LIST(SPH_LIMIT_ENUM)
#undef SPH_LIMIT_ENUM
        SPH_LIMITS
};

/* A body force beside gravity: add an acceleration (m/s^2) for a particle at x (m) with velocity v (m/s) at
   time t (s) into a. Called from several threads at once; must depend on its arguments only. */
typedef void (*sph_body_force)(void *ctx, double t, const double *x, const double *v, double *a);

/* Stage log: called after every pass of a step with a hash of what the pass may have changed. */
typedef void (*sph_stage_log)(void *ctx, uint64_t step, const char *pass, uint64_t hash);

/* What the machine provides; every member may be null. `parallel` must call fn(arg, chunk, thread) once for
   each chunk in 0..chunks-1, in any order, thread < threads being different for calls that run at once. */
typedef struct sph_port {
    void *ctx;
    uint32_t threads; /* how many `parallel` uses at most, not above max_threads; 0 or 1: serial */
    void (*parallel)(void *ctx, void (*fn)(void *arg, uint32_t chunk, uint32_t thread), void *arg, uint32_t chunks);
    uint64_t (*clock)(void *ctx);                         /* nanoseconds, monotonic; never used for physics */
    void (*fault)(void *ctx, const sph_report *report);   /* told of every failure, before it is returned */
} sph_port;

/* Its options, with what they mean, units, defaults and bounds, are the list in options.h: sph_config has a member of
   the name of each, uint32_t for whole numbers and choices, double (of SPH_DIM along the axes), bool, and
   uint32_t face[SPH_DIM][2]. */
#include "options.h"

typedef struct sph_config {
    uint32_t cookie; /* set by sph_config_default; a configuration not made by it is refused */
    SPH_OPTIONS(SPH_OPTION_MEMBER, SPH_OPTION_MEMBER, )
    sph_body_force body_force;
    void *body_ctx;
    sph_port port;
    sph_stage_log stage_log;
    void *stage_ctx;
} sph_config;

/* Water at rest density 1000 with safe choices: Wendland C2, h = 1.2 dx, standard scheme, continuity, Tait,
   artificial viscosity alpha 0.01 (all pairs), predictor-corrector, controlled step. Capacity, domain,
   spacing and sound speed are left at zero: the host must give them. */
#define sph_config_default SPH_NAME(config_default)
sph_config sph_config_default(void);

/* Checks a configuration; on BAD_CONFIG the report names the field, its value and what is allowed.
   report may be null. */
#define sph_config_check SPH_NAME(config_check)
sph_status sph_config_check(const sph_config *cfg, sph_report *report);

/* ---- 4 arena and life ------------------------------------------------------------------------------
   The arena is one block of memory, aligned to SPH_ALIGN, that the host owns and must not touch or move
   while the simulation lives. There is nothing to free. */
#define SPH_ALIGN 64u
typedef struct sph_sim sph_sim;

/* Bytes that sph_init needs for this configuration; 0 if the configuration is not allowed. */
#define sph_arena_bytes SPH_NAME(arena_bytes)
size_t sph_arena_bytes(const sph_config *cfg);

/* The same as a constant expression, an upper bound for a static array: particles, cells (the product of
   floor(extent/support) over the axes is never exceeded), threads, and an or of the SPH_USE_ flags. */
#define SPH_USE_RUNGE_KUTTA 1u
#define SPH_USE_XSPH 2u
#define SPH_USE_BOOKS 4u
#define SPH_USE_FILTER 8u /* Shepard filter or density by summation */
#define SPH_USE_SOLID 16u   /* any solid form */
#define SPH_USE_CORRECTED 32u /* SPH_CORRECTED or SPH_TOTAL */
#define SPH_USE_TOTAL 64u   /* SPH_TOTAL */
#define SPH_USE_YIELD 128u
#define SPH_USE_DAMAGE 256u /* flaws: 4 bytes each, to be added */
#define SPH_USE_MIRRORS 512u /* symmetry or no-slip mirror faces */
#define SPH_USE_SHIFTING 1024u
#define SPH_USE_QUADRATURE 2048u /* face_quadrature */
#define SPH_USE_SHEAR 4096u /* a viscous stress of fluids */
#define SPH_USE_DAMPER 8192u
#define SPH_USE_FLOW 16384u /* max_flows > 0 */
#define SPH_USE_ENERGY 32768u /* the energy equation */
#define SPH_USE_EDGES 65536u /* edges that let waves out, with a matched layer or without */
#define SPH_USE_FORMS 131072u /* SPH_STABILISED, SPH_NORMALISED, SPH_NORMALISED_CORRECTED, or hourglass */
#define SPH_USE_VARIABLE_H 1048576u /* a smoothing length of each particle */
#define SPH_USE_ANTUONO 8388608u /* density diffusion after Antuono */
#define SPH_REAL_ (SPH_DOUBLE ? 8u : 4u)
#define SPH_STRESSES (SPH_DIM == 1 ? 1u : SPH_DIM == 2 ? 3u : 5u) /* components kept of the deviatoric stress */
#define SPH_SOLID_BYTES_(use)                                                                               \
    ((((use)&SPH_USE_SOLID) ? 2u * SPH_STRESSES * SPH_REAL_ : 0u) +                                         \
     (((use)&SPH_USE_TOTAL) ? SPH_DIM * SPH_REAL_ : 0u) +                                                   \
     (((use)&SPH_USE_QUADRATURE) ? SPH_REAL_ : 0u) +                                                        \
     (((use)&SPH_USE_FORMS) ? (SPH_DIM + 1u) * SPH_REAL_ : 0u) +                                            \
     (((use)&SPH_USE_YIELD) ? SPH_REAL_ : 0u) + (((use)&SPH_USE_DAMAGE) ? SPH_REAL_ : 0u))
#define SPH_STATE_BYTES_ ((2u * SPH_DIM + SPH_DIM + 2u) * (SPH_DOUBLE ? 8u : 4u) + 4u + 1u)
#define SPH_PARTICLE_BYTES(use)                                                                             \
    (SPH_STATE_BYTES_ * (((use)&SPH_USE_RUNGE_KUTTA) ? 3u : 2u) + (((use)&SPH_USE_MIRRORS) ? 1u : 0u) +     \
     (((use) & (SPH_USE_RUNGE_KUTTA | SPH_USE_SOLID)) ? 0u : 2u * SPH_REAL_) + /* predictor-corrector */    \
     (((use)&SPH_USE_XSPH) ? SPH_DIM * (SPH_DOUBLE ? 8u : 4u) * (((use)&SPH_USE_RUNGE_KUTTA) ? 3u : 2u) : 0u) +  \
     (((use)&SPH_USE_BOOKS) ? 7u * (SPH_DOUBLE ? 8u : 4u) : 0u) +                                           \
     (((use)&SPH_USE_FILTER) ? (SPH_DOUBLE ? 8u : 4u) : 0u) +                                               \
     SPH_SOLID_BYTES_(use) * (((use)&SPH_USE_RUNGE_KUTTA) ? 3u : 2u) +                                      \
     (((use)&SPH_USE_SHEAR) ? (SPH_DIM * SPH_DIM + 1u) * SPH_REAL_ : 0u) +                                  \
     (((use)&SPH_USE_ANTUONO) ? SPH_DIM * SPH_REAL_ : 0u) +                                                 \
     (((use)&SPH_USE_ENERGY) ? 2u * SPH_REAL_ * (((use)&SPH_USE_RUNGE_KUTTA) ? 3u : 2u) : 0u) +             \
     (((use)&SPH_USE_FORMS) ? (SPH_DIM * SPH_DIM + SPH_DIM + 2u) * SPH_REAL_ : 0u) +                        \
     (((use)&SPH_USE_VARIABLE_H) ? SPH_REAL_ : 0u) +                                                        \
     (((use)&SPH_USE_CORRECTED) ? SPH_DIM * SPH_DIM * SPH_REAL_ : 0u) + (((use)&SPH_USE_DAMAGE) ? 4u : 0u) + \
     (((use)&SPH_USE_DAMPER) ? SPH_REAL_ : 0u) + (((use)&SPH_USE_FLOW) ? 2u : 0u) +                         \
     (((use)&SPH_USE_EDGES) ? SPH_EDGE_BYTES_ : 0u) +                                                       \
     (((use)&SPH_USE_SHIFTING) ? (SPH_DIM + 1u) * SPH_REAL_ : 0u))
#define SPH_EDGE_TENSOR_ (SPH_DIM * (SPH_DIM + 1u) / 2u)
#define SPH_EDGE_BYTES_ /* marks, lines, places; memory of the matched layer; its stress, what is absorbed */ \
    (((5u + 6u) * SPH_DIM + SPH_EDGE_TENSOR_ + 1u) * SPH_REAL_ + 48u +                                       \
     (5u * SPH_DIM * SPH_DIM + 4u * SPH_EDGE_TENSOR_ + 1u) * SPH_REAL_)
#define SPH_FIXED_BYTES 25088u /* simulation header, sets, groups, alignment of at most 48 arrays */
/* sums of a velocity gradient, or of shifting */
#define SPH_TENSOR_SUMS_                                                                                    \
    SPH_MAX_(SPH_WITH_SOLID ? SPH_DIM * SPH_DIM : 0u,                                                       \
             SPH_WITH_SHIFTING ? 2u * SPH_DIM + 1u + SPH_DIM * (SPH_DIM + 1u) / 2u : 0u)
#define SPH_SCRATCH_BYTES /* a thread */                                                                    \
    (((SPH_DIM == 1 ? 12288u : SPH_DIM == 2 ? 26624u : 86016u) +                                            \
      (SPH_TENSOR_SUMS_ + (SPH_WITH_ENERGY ? 1u : 0u)) * 512u) * (SPH_DOUBLE ? 2u : 1u))
#define SPH_SOLID_SCRATCH_BYTES /* with solids besides */                                                   \
    ((SPH_DIM == 1 ? 3072u : SPH_DIM == 2 ? 12288u : 49152u) * (SPH_DOUBLE ? 2u : 1u))
#define SPH_SHEAR_SCRATCH_BYTES /* with a viscous stress besides */                                          \
    ((SPH_DIM * SPH_DIM + 1u) * (SPH_DIM == 1 ? 112u : SPH_DIM == 2 ? 192u : 536u) * SPH_REAL_)
#define SPH_ANTUONO_SCRATCH_BYTES /* with that diffusion besides */                                          \
    (SPH_DIM * (SPH_DIM == 1 ? 112u : SPH_DIM == 2 ? 192u : 536u) * SPH_REAL_ + 64u)
#define SPH_ENERGY_SCRATCH_BYTES /* with the energy equation besides */                                     \
    ((SPH_DIM == 1 ? 112u : SPH_DIM == 2 ? 192u : 536u) * SPH_REAL_ + 64u)
#define SPH_FORMS_SCRATCH_BYTES /* with such a form besides */                                              \
    ((4u * SPH_DIM + 2u) * (SPH_DIM == 1 ? 112u : SPH_DIM == 2 ? 192u : 536u) * SPH_REAL_)
#define SPH_ARENA_BYTES(particles, cells, threads, use)                                                     \
    (SPH_FIXED_BYTES + (size_t)(threads) * (SPH_SCRATCH_BYTES + 128u) +                                     \
     (((use)&SPH_USE_SOLID) ? (size_t)(threads) * (SPH_SOLID_SCRATCH_BYTES + 64u) + 8192u : 0u) +           \
     (((use)&SPH_USE_SHEAR) ? (size_t)(threads) * SPH_SHEAR_SCRATCH_BYTES : 0u) +                            \
     (((use)&SPH_USE_ANTUONO) ? (size_t)(threads) * SPH_ANTUONO_SCRATCH_BYTES : 0u) +                        \
     (((use)&SPH_USE_ENERGY) ? (size_t)(threads) * SPH_ENERGY_SCRATCH_BYTES : 0u) +                          \
     (((use)&SPH_USE_VARIABLE_H) ? (size_t)(threads) * SPH_ENERGY_SCRATCH_BYTES : 0u) + /* as large */       \
     (((use)&SPH_USE_FORMS) ? (size_t)(threads) * SPH_FORMS_SCRATCH_BYTES : 0u) +                            \
     (((use)&SPH_USE_FLOW) ? 2048u : 0u) +                                                                  \
     ((size_t)(particles) + 48u) * SPH_PARTICLE_BYTES(use) + ((size_t)(cells) + 64u) * 4u +                 \
     (size_t)(cells) / 32u + 64u + /* strips */                                                             \
     ((size_t)(particles) / 64u + (size_t)(cells) / 8u + 64u) *                                             \
         (((use) & (SPH_USE_BOOKS | SPH_USE_SHIFTING | SPH_USE_DAMPER | SPH_USE_EDGES)) ? 64u : 0u) +       \
     (((use)&SPH_USE_EDGES) ? 8192u : 0u))
/* Declares an aligned static arena: `static SPH_ARENA(arena, 65536);` */
#ifdef __cplusplus
#define SPH_ARENA(name, bytes) unsigned char name alignas(SPH_ALIGN)[bytes]
#else
#define SPH_ARENA(name, bytes) _Alignas(SPH_ALIGN) unsigned char name[bytes]
#endif

/* Lays the arrays that the configuration chose into the arena, once, and gives an empty simulation.
   *sim is set only on SPH_OK. On failure *report (may be null) tells what and how many bytes are needed. */
#define sph_init SPH_NAME(init)
sph_status sph_init(sph_sim **sim, const sph_config *cfg, void *arena, size_t bytes, sph_report *report);

/* Which array took what: calls fn once for each piece of the arena, in order of address. */
#define sph_arena_report SPH_NAME(arena_report)
void sph_arena_report(const sph_sim *sim, void (*fn)(void *ctx, const char *name, size_t bytes), void *ctx);

/* High-water marks since init. */
typedef struct sph_usage {
    size_t arena_bytes, arena_used;
    uint32_t particles, max_particles; /* most particles at once, and the capacity */
    uint32_t cells;                    /* cells of the domain */
    uint32_t cell_particles;           /* most particles in one cell */
    uint64_t step_work;                /* most work units in one step */
    uint64_t slice_work;               /* most work units in one slice */
    uint32_t sets, groups;
} sph_usage;
#define sph_get_usage SPH_NAME(get_usage)
void sph_get_usage(const sph_sim *sim, sph_usage *out);

/* The latest failure (status SPH_OK if there was none). */
#define sph_last SPH_NAME(last)
const sph_report *sph_last(const sph_sim *sim);

/* Changes that are allowed between steps: gravity, damping, fixed dt, the hooks (port, stage log, body force).
   Other fields of cfg must equal those given to sph_init, else SPH_BAD_CONFIG and nothing changes. */
#define sph_reconfigure SPH_NAME(reconfigure)
sph_status sph_reconfigure(sph_sim *sim, const sph_config *cfg);

/* ---- 5 fluid and solid ---------------------------------------------------------------------------------------
   A set is a body of particles of one material; its particles have mass rho0 dx^DIM unless given. */
typedef struct sph_fluid {
    double mass;        /* of one particle, kg (per m of depth in 2-D, per m^2 in 1-D); 0: rho0 spacing^DIM */
    double rho0;        /* 0: that of the configuration */
    double sound_speed; /* 0: that of the configuration */
    bool own_eos;       /* take the next field instead of the configuration's eos: a gas beside rock or water
                           (SPH_WITH_SOLID, SPH_WITH_ENERGY) */
    uint32_t eos;
} sph_fluid;
#define sph_add_fluid SPH_NAME(add_fluid)
sph_status sph_add_fluid(sph_sim *sim, const sph_fluid *fluid, uint32_t *set); /* fluid null: all defaults */

/* Displacement (m) and velocity (m/s) at time t (s) of something that moves as it is told: a wall, a held set. Must
   depend on its arguments only. Asked for times of the step under way: its beginning, middle and end, never beyond.
   Finite, within two domain lengths, and less than one from step to step; otherwise the step fails (NOT_FINITE,
   MOVED_TOO_FAR). Along a periodic axis any distance will do: a wall comes in again on the other side, and where it
   stands goes there the shorter way round.
   The acceleration that Adami's walls push with follows from the velocities of the steps so far, over a time of
   tau = h/(2 c0), so that a velocity may jump: with the velocity filtered once and twice, tau du/dt = v - u,
   tau dw/dt = u - w, linear between what was told at a step's ends, it is (2 v - 3 u + w)/tau. */
typedef void (*sph_motion)(void *ctx, double t, double *displacement, double *velocity);

/* A motion given as a table, linear between rows; before the first and after the last row there is rest. Pass
   sph_motion_table as the motion and a pointer to this as its ctx. Times must increase. Without rows, or with an axis
   that there is not, there is rest. */
typedef struct sph_table {
    uint32_t rows, axis;
    const double *t, *x; /* s, m */
} sph_table;
#define sph_motion_table SPH_NAME(motion_table)
void sph_motion_table(void *ctx, double t, double *displacement, double *velocity);

/* A motion given by velocities, linear between rows, from rest before the first row (a jump to v[0] if that is not 0);
   after the last it goes on with the last one. The displacement is their integral, exactly. Pass sph_motion_programme
   and a pointer to this. Times must increase; without rows, or with an axis that there is not, there is rest. */
typedef struct sph_programme {
    uint32_t rows, axis;
    const double *t, *v; /* s, m/s */
} sph_programme;
#define sph_motion_programme SPH_NAME(motion_programme)
void sph_motion_programme(void *ctx, double t, double *displacement, double *velocity);

/* A motion given as a table through which goes a cubic spline, so that velocity and acceleration are continuous
   between its ends; rest before the first row and after the last, where the velocity is 0. Pass sph_motion_spline and a
   pointer to this. sph_spline_make fills `bend` (2 rows long: accelerations at the rows, and room to find them); false:
   fewer than two rows, times that do not increase, or what is not finite or beyond 1e15. */
typedef struct sph_spline {
    uint32_t rows, axis;
    const double *t, *x; /* s, m */
    const double *bend;  /* what sph_spline_make has found; null: rest */
} sph_spline;
#define sph_spline_make SPH_NAME(spline_make)
bool sph_spline_make(const sph_spline *spline, double *bend);
#define sph_motion_spline SPH_NAME(motion_spline)
void sph_motion_spline(void *ctx, double t, double *displacement, double *velocity);

/* A motion from rest at time 0: displacement v t + a t^2/2 on each axis. Pass sph_motion_steady and a pointer to
   this. */
typedef struct sph_steady {
    double v[SPH_DIM], a[SPH_DIM]; /* m/s, m/s^2 */
} sph_steady;
#define sph_motion_steady SPH_NAME(motion_steady)
void sph_motion_steady(void *ctx, double t, double *displacement, double *velocity);

/* A solid's material. p = c0^2 (rho - rho0) (Gray 2001 eq 5.11), so the bulk modulus is rho0 c0^2; the deviatoric
   stress follows dS/dt = 2 mu (e - tr e/3) + W S - S W with the strain rate e and spin W of L (Jaumann; Gray 5.7-5.9
   in plane strain, where S_zz = -S_xx - S_yy). In 1-D the strain is uniaxial; for a thin bar give sound_speed =
   sqrt(E/rho0) and shear 0. */
typedef struct sph_solid {
    double mass, rho0, sound_speed; /* as in sph_fluid */
    double shear;                   /* mu (Pa), >= 0 */
    double yield, hardening;        /* Y (Pa) in simple tension, 0: never yields; rise of Y with plastic strain (Pa) */
    double crack_speed;             /* m/s, 0: 0.4 sound_speed */
    double flaw_radius;             /* m, 0: that of the disc (ball) of a particle's volume */
    uint32_t body;                  /* SPH_TOTAL: sets of the same number are one body; 0 .. 255 */
    bool flat_faces;                /* with face_quadrature: particles beside its free faces have quadrature weights */
    uint32_t held;                  /* bits 1 << axis: along these the set moves as `motion` says, not by forces */
    sph_motion motion;              /* null: at rest */
    void *motion_ctx;
} sph_solid;
#define sph_add_solid SPH_NAME(add_solid)
sph_status sph_add_solid(sph_sim *sim, const sph_solid *solid, uint32_t *set, uint32_t *group); /* group: null, or for
   sph_remove_wall, which lets go of a held set */

/* Gives the particles of a solid set flaws: each of round(N ln N) draws, and more until every particle has one, puts
   a flaw of threshold (p/(k V))^(1/m), p evenly out of 1 .. N ln N, on an evenly chosen particle, N being the set's
   particles and V their volume (Gray 2001 eqs 5.40, 5.41); a particle with 20 flaws takes no more. Draws come from
   splitmix64 (Steele, Lea & Flood 2014) started at seed: first p, then the particle; the same on every machine. Call
   it once for a set, after its particles were added and before the first step. A set without flaws is never damaged. */
#define SPH_MAX_FLAWS 20u /* of one particle */
typedef struct sph_flaws {
    double k; /* 1/m^DIM */
    double m; /* 1 .. 50 */
    uint64_t seed;
} sph_flaws;
#if SPH_DIM > 1
#define sph_add_flaws SPH_NAME(add_flaws)
sph_status sph_add_flaws(sph_sim *sim, uint32_t set, const sph_flaws *flaws);
/* The flaws of a particle: how many, and their thresholds in rising order into threshold[0 .. 19] (may be null). */
#define sph_get_flaws SPH_NAME(get_flaws)
sph_status sph_get_flaws(const sph_sim *sim, uint32_t id, uint32_t *count, float *threshold);
#endif

/* Finds the edges that waves leave through (`edge` of the configuration), once all solids are there with their
   velocities and stresses, before the first step. Call it again to find them anew. `faces`, an or of SPH_LOW(axis),
   SPH_HIGH(axis): the edges are those planes of the box around all solids. 0: wherever the solids end: particles are
   found layer by layer by e = sum V grad W, which is 0 inside (Powell 2012 eqs 2.50-2.53, algorithms 2.1, 2.2, at most
   floor(support/spacing) + 1 rounds): the layer that |e| > 0.75 max |e| shows (3-D: 0.6), with normals -e/|e|, is taken
   away for the next. `given`: layers and normals are as sph_set_edge gave them, after an earlier call; lines of the
   natural edge start at layer 1. */
typedef struct sph_edges {
    uint32_t faces;
    bool given;
    double velocity[SPH_DIM]; /* m/s, NATURAL, VISCOUS, matched layers: of what lies beyond */
    bool as_now;              /* instead of it, the velocities of now */
    double source[SPH_DIM];   /* m, H: where waves come from */
} sph_edges;
#define sph_find_edges SPH_NAME(find_edges)
sph_status sph_find_edges(sph_sim *sim, const sph_edges *edges); /* null: wherever the solids end */
/* Layer of a particle, 1 the outermost, 0 none, and its outward normal (its length does not matter); to set: after
   sph_find_edges, before the first step. */
#define sph_set_edge SPH_NAME(set_edge)
sph_status sph_set_edge(sph_sim *sim, uint32_t id, uint32_t level, const double *normal);
#define sph_get_edge SPH_NAME(get_edge)
sph_status sph_get_edge(const sph_sim *sim, uint32_t id, uint32_t *level, double *normal);

/* One particle: position x (m), velocity v (m/s, null: 0), density rho (kg/m^3, 0: rho0). Ids count from 0 in the
   order of adding. id may be null. */
#define sph_add_particle SPH_NAME(add_particle)
sph_status sph_add_particle(sph_sim *sim, uint32_t set, const double *x, const double *v, double rho, uint32_t *id);

/* Lattices of the configured spacing: particle centres half a spacing inside the shape's low corner.
   A box; a ball (disc in 2-D); a ring (shell) between two radii; a polygon of n corners (2-D, even-odd rule). Refused
   where none would be added.
   v (null: at rest) is given to all. All or nothing: on failure no particle was added. A shape begins and ends within a
   domain's length of the domain: every point of its lattice is looked at. */
#define sph_add_box SPH_NAME(add_box)
sph_status sph_add_box(sph_sim *sim, uint32_t set, const double *lo, const double *hi, const double *v);
#define sph_add_ring SPH_NAME(add_ring)
sph_status sph_add_ring(sph_sim *sim, uint32_t set, const double *centre, double inner, double outer, const double *v);
#if SPH_DIM == 2
#define sph_add_polygon SPH_NAME(add_polygon)
sph_status sph_add_polygon(sph_sim *sim, uint32_t set, const double (*corner)[2], uint32_t n, const double *v);
#endif

/* Lattices, each of one particle to dx^DIM. SQUARE: one in the middle of every cell of edge dx. SHIFTED_X: rows along
   x, every second one shifted by dx/2 along x; SHIFTED_Y: columns along y, every second one shifted by dx/2 along y
   (face centred, Gray 2001 section 5.6.5). In 3-D the rows are numbered along both other axes and shifted where the
   two numbers add up to an odd one: every layer is as in 2-D, every second layer begins with the other row, and the
   cell of dx by 2 dx by 2 dx has a particle at its corners and in the middle of its faces. SHIFTED_Z: the same along
   z, 3-D only. Neighbours are then two at dx and four (3-D: eight) at 1.118 dx, on the square lattice four (six) at
   dx. In 1-D there is SQUARE only. */
enum { SPH_LATTICE_SQUARE, SPH_LATTICE_SHIFTED_X, SPH_LATTICE_SHIFTED_Y, SPH_LATTICE_SHIFTED_Z, SPH_LATTICES };

/* The points with sum over the axes of ((x - centre)/radius)^2 < 1: an ellipse, ellipsoid, in 1-D an interval. Radii
   are > 0; an infinite one makes a cylinder along that axis. */
typedef struct sph_ellipse {
    double centre[SPH_DIM], radius[SPH_DIM]; /* m */
} sph_ellipse;

/* A particle stands in a shape if its centre does: in the box lo .. hi, in the outline (not on its rim), and in none
   of the holes (on their rims it stands). To 1e-9 of a radius or spacing counts as on it, so that no rounding spoils
   a symmetry.
     ring     .outline = &outer, .hole = &inner, .holes = 1     disc     .outline = &rim
     plate    .lo, .hi                                          holes    .hole = ellipses, .holes = how many
     3-D      a cylinder or a hole right through has an infinite radius along its axis; lo, hi give its ends
   Where the lattice stands: along an axis where the outline has a finite radius, symmetric about the outline's centre;
   there lo, hi may be left equal, or else cut the outline. Along any other axis, half a spacing inside lo, as with
   sph_add_box. If shifted: in a box, rows begin a quarter and three quarters of a spacing inside lo, so that all hold
   equally many; an outline has a row through its centre, so that the shape mirrors in every axis (and has particles on
   those mirror planes: it cannot be cut there to be completed by SPH_SYMMETRY; on the square lattice it can).
   Periodic: a box from face to face has no seam if it is a whole number of spacings long on every axis and, when
   shifted, an even number on every periodic axis across the rows. */
typedef struct sph_shape {
    double lo[SPH_DIM], hi[SPH_DIM]; /* m */
    const sph_ellipse *outline;      /* null: the whole box */
    const sph_ellipse *hole;         /* so many: */
    uint32_t holes;                  /* 0 .. 4096 */
    uint32_t lattice;                /* SPH_LATTICE_... */
    double velocity[SPH_DIM];        /* m/s */
} sph_shape;
/* Fills a shape with particles of a set. All or nothing, near the domain as above; a shape that holds none is
   refused. */
#define sph_add_shape SPH_NAME(add_shape)
sph_status sph_add_shape(sph_sim *sim, uint32_t set, const sph_shape *shape);

/* Inflows and outflows of a set of fluid, at most max_flows of them (Gray 2001 eqs 2.34, 2.35). Each is a box inside
   the domain, of whole spacings along its axis, at least the kernel's support; `face` is the face of the box through
   which it is joined to the water. Each is a set of its own, of the same material, that takes part in every sum but
   feels no force: what holds it does wall_work.
   INFLOW: the box is filled with particles that go out through the face with `speed`. Behind each that has passed it,
   the same is born one length of the box further back, exactly, in the next step; who has passed belongs to the water.
   Profiles: sph_apply_field and sph_apply_hydrostatic on *set, before the first step, say with what velocity along the
   axis and what density each row comes for ever (other components: 0; against the way: nobody is born). If there is no
   room for newcomers the step fails with TOO_MANY_PARTICLES and the number of particles needed.
   OUTFLOW: water that comes in through the face keeps its velocity and density and is removed behind the opposite one,
   in number `left`. Sound is reflected where the flow is slower than sound: a sponge before it helps.
   Books: added_mass, fed; removed_mass, carried_off. Ids of newcomers: the next free one, counted round 0 ..
   max_particles - 1. Not where density is summed. A channel needs as many particles as its lattice has with both
   boxes, and two layers more: what a step feeds (at most one, speed dt < dx), and what stands beyond an outflow's end
   until the next sort. A step's work: (3 + 1 for each sort) max_particles + 512 + 130 for each particle that it feeds,
   more at most; a slice may pass its budget by so many units as a step feeds particles, times the threads, and by
   max_particles besides. */
typedef struct sph_flow {
    double lo[SPH_DIM], hi[SPH_DIM]; /* m */
    uint32_t face;                   /* SPH_LOW(k) or SPH_HIGH(k), section 6 */
    double speed;                    /* m/s, > 0; of inflows only */
} sph_flow;
#define sph_add_inflow SPH_NAME(add_inflow)
sph_status sph_add_inflow(sph_sim *sim, uint32_t fluid, const sph_flow *flow, uint32_t *set);
#define sph_add_outflow SPH_NAME(add_outflow)
sph_status sph_add_outflow(sph_sim *sim, uint32_t fluid, const sph_flow *flow, uint32_t *set);

/* Sets velocity and density of a particle between steps by a function of its position: an initial field. All or
   nothing. Velocities are those of the present time, also with the leap-frog. */
typedef void (*sph_field_fn)(void *ctx, const double *x, double *v, double *rho);
#define sph_apply_field SPH_NAME(apply_field)
sph_status sph_apply_field(sph_sim *sim, uint32_t set, sph_field_fn fn, void *ctx);

/* Moves the particles of a set before sph_ready, each by a function of its position: lattices that follow a surface, or
   a small push against rows that band together (Gray 2001, section 3.1). Masses, velocities, densities and ids stay: a
   map that keeps volumes keeps the room that masses need; fields that are to be of the new places are applied after it.
   Reference positions of solids are the new ones. All must end inside the domain. All or nothing. */
typedef void (*sph_place_fn)(void *ctx, const double *x, double *to); /* m; `to` is x when it is called */
#define sph_apply_positions SPH_NAME(apply_positions)
sph_status sph_apply_positions(sph_sim *sim, uint32_t set, sph_place_fn fn, void *ctx);

/* Sets the energy u (J/kg, >= 0) of a set's particles likewise (option `energy`). All or nothing. */
#if SPH_WITH_ENERGY
typedef void (*sph_energy_fn)(void *ctx, const double *x, double *u);
#define sph_apply_energy SPH_NAME(apply_energy)
sph_status sph_apply_energy(sph_sim *sim, uint32_t set, sph_energy_fn fn, void *ctx);
#endif

/* Gives every particle of the set the density that hydrostatic pressure asks for below `surface` (m, along the
   axis of gravity, which must be an axis), so that a tank starts in balance. Refused where a density would pass 100
   rho0. */
#define sph_apply_hydrostatic SPH_NAME(apply_hydrostatic)
sph_status sph_apply_hydrostatic(sph_sim *sim, uint32_t set, double surface);

/* ---- 6 walls ---------------------------------------------------------------------------------------
   LENNARD_JONES     one row on the wall, force D((r0/r)^12 - (r0/r)^6) r/r^2 for r < r0 = dx (Gray 2.38); strength
                     is D (m^2/s^2), usually g times the depth
   KERNEL_FORCE      one row with normals, f(r_perp) P(r_par) n (Gray 2.39-2.41 with (2/3)/h); strength is his nu
                     (-), usually 0.01
   MONAGHAN_KOS      one row with normals, (A/sqrt q)(1 - q) P(r_par) n for q = r_perp/2dx < 1 (Wickramarachchi
                     6.10-6.12); strength is A (m/s^2), usually 0.01 c0^2/dx; the kernel's support must be 2 dx or more
   GHOST             layers to the kernel's support that take part in every sum; mirror velocity in the viscosity,
                     beta_max 1.5 (Gray 2.42-2.43, after Morris, Fox & Zhu 1997); density evolved by
                     continuity ("compressible") or held at rho0 ("incompressible")
   ADAMI             the same layers with pressure extrapolated from the fluid, and for no slip the velocity too
                     (Adami, Hu & Adams 2012) */
enum {
    SPH_WALL_LENNARD_JONES,
    SPH_WALL_KERNEL_FORCE,
    SPH_WALL_MONAGHAN_KOS,
    SPH_WALL_GHOST,
    SPH_WALL_ADAMI,
    SPH_WALLS
};

/* On whom a wall of layers acts. FRONT: on what is in front of its face's plane; FACE: and between the face's edges.
   For plates between two waters: as thick as the kernel's support, with layers of one group each that face both ways in
   the same place, FRONT, and at its free end FACE, so that everybody feels the plate once. Faces keep their direction.
   */
enum { SPH_BOTH_SIDES, SPH_FRONT, SPH_FACE, SPH_SIDES };

typedef struct sph_wall {
    uint32_t kind;       /* SPH_WALL_... */
    bool compressible;   /* GHOST: density by continuity instead of held; refused where density is summed */
    bool no_slip;        /* GHOST, ADAMI: viscosity acts between fluid and wall */
    double strength;     /* see above; 0: the usual value (sound speed, spacing and gravity of the configuration) */
    uint32_t layers;     /* GHOST, ADAMI; 0: as many as the support needs */
    uint32_t side;       /* SPH_BOTH_SIDES ...; another than that: GHOST (not compressible), ADAMI */
    sph_motion motion;   /* null: fixed */
    void *motion_ctx;
} sph_wall;
#define sph_wall_default SPH_NAME(wall_default)
sph_wall sph_wall_default(void); /* ADAMI, free slip, fixed */

/* Faces of a box as bits: low face of axis k: SPH_LOW(k), high face: SPH_HIGH(k). */
#define SPH_LOW(k) (1u << (2u * (k)))
#define SPH_HIGH(k) (2u << (2u * (k)))

/* The chosen faces of a box as one wall group. inside: the fluid is inside (a tank; corners where two chosen faces
   meet get the diagonal normal of Gray figure 2.4); else outside (an obstacle: its interior is filled). Works in
   1-D, 2-D and 3-D. *group (may be null) names it for sph_remove_wall and sph_wall_motion. */
#define sph_add_wall_box SPH_NAME(add_wall_box)
sph_status sph_add_wall_box(sph_sim *sim, const sph_wall *wall, const double *lo, const double *hi, uint32_t faces,
                            bool inside, uint32_t *group);
#if SPH_DIM == 2
/* A straight wall from a to b; the fluid is on its left. */
#define sph_add_wall_segment SPH_NAME(add_wall_segment)
sph_status sph_add_wall_segment(sph_sim *sim, const sph_wall *wall, const double *a, const double *b, uint32_t *group);
/* A bed: straight walls through n points (m), one group; the fluid is on the left of the way along them. Layers run on
   round the corners, mitred there, with a particle on each mitre: none is doubled and none is left out, and a corner of
   a box has the particles of sph_add_wall_box. Uses 2 n - 3 sets. Refused: fewer than two points, turns of more than a
   right angle, and pieces so short that a layer would fold at their corners or an end be shorter than a spacing (each
   layer wants half a spacing and more between two corners). */
#define sph_add_wall_polyline SPH_NAME(add_wall_polyline)
sph_status sph_add_wall_polyline(sph_sim *sim, const sph_wall *wall, const double (*points)[SPH_DIM], uint32_t n,
                                 uint32_t *group);
#endif
#if SPH_DIM == 3
/* A flat wall: the parallelogram origin + s e1 + t e2; the fluid is on the side of e1 x e2. */
#define sph_add_wall_plane SPH_NAME(add_wall_plane)
sph_status sph_add_wall_plane(sph_sim *sim, const sph_wall *wall, const double *origin, const double *e1,
                              const double *e2, uint32_t *group);
#endif
/* Takes a wall group away (a gate), now or, with sph_remove_wall_at, when time reaches t. */
#define sph_remove_wall SPH_NAME(remove_wall)
sph_status sph_remove_wall(sph_sim *sim, uint32_t group);
#define sph_remove_wall_at SPH_NAME(remove_wall_at)
sph_status sph_remove_wall_at(sph_sim *sim, uint32_t group, double t);

/* ---- 7 step ----------------------------------------------------------------------------------------
   One step is a fixed list of passes. A step that fails returns a status, names cause and particle in sph_last, and
   leaves the state bit for bit as it was; the host may dump it, change something and go on. */

/* Orders the particles, extrapolates into walls and computes the first forces. Called by the first step if the
   host did not; call it to read forces or take a hash before the first step. */
#define sph_ready SPH_NAME(ready)
sph_status sph_ready(sph_sim *sim);

/* One whole step. sph_step_to shortens the step so that time ends at t_end exactly (and never overshoots). */
#define sph_step SPH_NAME(step)
sph_status sph_step(sph_sim *sim);
#define sph_step_to SPH_NAME(step_to)
sph_status sph_step_to(sph_sim *sim, double t_end);

/* Part of a step: does chunks until about `budget` work units are spent (one unit: one candidate pair, one particle
   in a local pass or looked at by a sort, one cell), then returns SPH_NOT_DONE; SPH_OK when the step is complete.
   Until then the state that can be read is that of the step's beginning. With n particles, at most c in a cell and at
   most s in a slab (a layer of cells along the last axis) of b cells:
     a slice    at most budget + threads * max(3^DIM c^2 + 1, (k + 2) s + k b, 256) units, k = max(3, slabs/64 rounded
                up): the last chunks, one a thread, may pass the budget, and a chunk is a cell of a sweep, k slabs of
                a sort, or 256 particles. The first sort of all has one chunk of n + cells units: sph_ready does it
                beforehand. So has the first after a step that failed or was given up, and after a restore.
     a step     at most E (3^DIM c n + cells + 32) + 28 n + 4 cells units. E counts its sweeps: 1 for the forces (2
                for all integrators but the predictor-corrector), as many again with Adami walls, with SPH_CORRECTED
                or SPH_TOTAL, with xsph_strain, with gradients of fluids, with a viscous stress, with SPH_ANTUONO,
                with normalised kernels and with hourglass, twice as many with SPH_STABILISED; 1 each for the
                density filter and summation (with Runge-Kutta 2 and 4: with the latter it sorts once more).
   Passes without chunks (starting a sort, walls that move) are not counted. sph_get_usage tells the largest so far. */
#define sph_step_slice SPH_NAME(step_slice)
sph_status sph_step_slice(sph_sim *sim, uint64_t budget);
/* Both bounds as numbers: what the last chunks may add to a budget, and a whole step of `sweeps` (E) sweeps. */
#define SPH_MAX_(a, b) ((a) > (b) ? (a) : (b))
#define SPH_AROUND_(c) ((SPH_DIM == 1 ? 3u : SPH_DIM == 2 ? 9u : 27u) * (uint64_t)(c))
#define SPH_RANGE_(slabs) (uint64_t) SPH_MAX_(3u, ((slabs) + 63u) / 64u)
#define SPH_SLICE_EXTRA(threads, slabs, s, b, c)                                                            \
    ((threads) * SPH_MAX_(SPH_MAX_(SPH_AROUND_(c) * (c) + 1u,                                               \
                                   (SPH_RANGE_(slabs) + 2u) * (s) + SPH_RANGE_(slabs) * (b)), 256u))
#define SPH_STEP_WORK(sweeps, n, c, cells)                                                                  \
    ((sweeps) * (SPH_AROUND_(c) * (n) + (cells) + 32u) + 28u * (uint64_t)(n) + 4u * (uint64_t)(cells))
/* Gives up a step that was begun in slices. */
#define sph_step_cancel SPH_NAME(step_cancel)
void sph_step_cancel(sph_sim *sim);

/* What the latest complete step did. */
typedef struct sph_step_info {
    uint64_t step;        /* steps done since init */
    double time, dt;      /* s, after the step; the step's size */
    uint32_t limit;       /* SPH_LIMIT_... that set dt */
    double limit_dt[SPH_LIMITS]; /* what each limit allows for the next step (s); 0 where it does not apply */
    uint64_t pairs;       /* candidate pairs looked at */
    uint64_t work;        /* work units */
    uint32_t passes;      /* passes run */
    uint32_t left, crossed, put_back, reflected; /* particles: since init */
    double thinnest, densest; /* rho/rho0 of the fluid now, looked up in all particles; 0: there is none, or knob
                                 DETAILS is off. Far below 1: spray, which loses density by continuity, or tension; far
                                 above: sound is too slow, or a wall squeezes */
} sph_step_info;
#define sph_get_step SPH_NAME(get_step)
void sph_get_step(const sph_sim *sim, sph_step_info *out);
#define sph_limit_text SPH_NAME(limit_text)
const char *sph_limit_text(uint32_t limit);
#define sph_time SPH_NAME(time)
double sph_time(const sph_sim *sim);

/* ---- 8 reading the state ---------------------------------------------------------------------------
   Of which instant the state is, between steps: places, densities, stresses, strain, damage and velocities of the
   step's end (leap-frog's velocities of half a step later). Accelerations, and what else the forces were made of
   (walls' densities and velocities by Adami), of the end, but with Runge-Kutta of the step's middle. Densities that
   are summed are of the places of the end; with XSPH, but for Runge-Kutta, of where they were before the last
   dt/2 (u' - u) of XSPH's velocity u; of a particle that was put back, of where it was found. */
enum { SPH_ROLE_FLUID, SPH_ROLE_GHOST, SPH_ROLE_FORCE_WALL, SPH_ROLE_SOLID, SPH_ROLES };
typedef struct sph_particle {
    uint32_t id, set, role;
    double x[SPH_DIM], v[SPH_DIM], a[SPH_DIM]; /* m, m/s, m/s^2 (0 before the first forces) */
    double rho, p, mass;                      /* kg/m^3, Pa, kg */
    double stress[6];                         /* Pa: xx, yy, zz, xy, xz, yz, tension positive, after damage; a fluid's
                                                 is -p I; 0 where SPH_WITH_SOLID is off */
    double plastic, damage;                   /* equivalent plastic strain; D, 0 .. 1 */
    double energy;                            /* u of the energy equation, J/kg; 0 where that is off */
    double h;                                 /* smoothing length, m; 0 where SPH_WITH_VARIABLE_H is off */
} sph_particle;
#define sph_count SPH_NAME(count)
uint32_t sph_count(const sph_sim *sim); /* particles in the simulation, walls included */
/* Particle number i in 0..count-1, in the order of the arrays (by cell, then id). */
#define sph_get SPH_NAME(get)
sph_status sph_get(const sph_sim *sim, uint32_t i, sph_particle *out);

/* ---- 9 books, probes, gauges, inspection -----------------------------------------------------------------------*/
/* Books of what happens at once, a line each: X(name, unit, scenes whose digest has it, what). Members of sph_totals,
   the state, its digest and dumps follow from the list. `c`: the configuration. The first six are kept in every
   scene, the others where the scene asks for books. */
#define SPH_BOOKS(X)                                                                                                  \
    X(absorbed, "J", (SPH_WITH_SPONGE && c->sponge_rate > 0) || (SPH_HAS_EDGES && c->edge != SPH_NO_EDGE),            \
      "energy that sponge layers and edges took")                                                                     \
    X(shifted, "J", SPH_WITH_SHIFTING && c->shifting > 0, "energy that shifting took; < 0: gave")                     \
    X(quieted, "J", SPH_WITH_DAMPER && c->damper > 0, "energy that the acoustic damper took")                         \
    X(slowed, "J", SPH_WITH_DAMPING_RATE && c->damping_rate > 0, "kinetic energy that damping_rate took")             \
    X(evened, "J", SPH_HAS_XSPH_VELOCITY && c->xsph_velocity, "kinetic energy that xsph_velocity took")               \
    X(removed_mass, "kg", false, "left the domain or was removed")                                                    \
    X(carried_off, "J", SPH_WITH_BOOKS && c->books, "energy that it had")                                             \
    X(released, "J", SPH_WITH_BOOKS && c->books, "elastic energy and that of tension that damage let go")             \
    X(added_mass, "kg", SPH_WITH_FLOW && c->max_flows > 0, "came in through inflows")                                 \
    X(fed, "J", SPH_WITH_FLOW && c->max_flows > 0, "energy that it brought")                                          \
    X(put_back_loss, "J", SPH_WITH_BOOKS && c->books, "lost by particles that were put back off a wall; < 0: gained") \
    X(filtered, "J", SPH_WITH_BOOKS && c->books, "taken from the internal energy by the Shepard filter")              \
    X(damped, "J", SPH_WITH_BOOKS && c->books, "kinetic energy that damping took, to first order in dt")

/* Energy is accounted for whole. At every instant
     d(kinetic + potential + internal + elastic)/dt = power of walls and body force - powers of all that takes,
   to rounding; the powers are integrated over time by the trapezoidal rule, and
     balance = kinetic + potential + internal + elastic + plastic_work - wall_work - body_work + dissipated + diffused
             + in_walls + in_bonds + unbalanced + absorbed + shifted + quieted + slowed + evened + carried_off
             + released + put_back_loss + filtered + damped - fed
   (with the energy equation without dissipated, which is in the internal energy)
   stays (plastic_work to first order in dt; gravity changed by sph_reconfigure shifts the potential). Without books it
   is what can be summed without them. `unbalanced` is 0 but for DIRECT, the printed continuity forms, WEAK schemes with
   summed density, MIRROR_NO_SLIP, xsph_strain, the drift of XSPH in gravity, and solids, whose Jaumann rate stores
   S:e/rho0 of the S:e/rho that forces give.
   One term is in no power. A summed density changes as places do, drho_i/dt = sum m_j (x'_i - x'_j) . grad W. With XSPH
   they go with u beside v; and images of moving walls behind MIRROR_NO_SLIP, seen with -v, go along the plane with +v.
   So the internal energy gains sum m_i (p_i/rho_i^2) sum m_j (u_i - u_j) . grad W besides, with 0 for u_j of walls and
   2 v_t, v along the plane, of such an image; tests/oracle balances with it. (u_i is known only when the sweep is over
   that would have to book it.) */
typedef struct sph_totals {
    uint32_t fluid, wall, solid; /* particles */
    double mass;                 /* kg, fluid and solid, as all that follows */
    double momentum[SPH_DIM];    /* kg m/s */
    double angular[3];           /* kg m^2/s about the origin; in 2-D only [2], in 1-D none */
    double kinetic;              /* J */
    double potential;            /* J, in gravity, from height 0 */
    double internal;             /* J, compression from rho0; with the energy equation heat too, of a gas all of u */
    double elastic;              /* J, S:S/(4 mu): distortion of solids */
    double plastic_work;         /* J, by yielding since init */
    double wall_work;            /* J, done by moving walls and held sets since init (books) */
    double body_work;            /* J, done by the body force beside gravity (books) */
    double dissipated;           /* J, by viscosity (books) */
    double diffused;             /* J, taken from the internal energy by density diffusion (books) */
    double in_walls;             /* J, taken up by walls: compression of ghosts, springs of boundary forces (books) */
    double in_bonds;             /* J, taken up by contact of bodies (SPH_TOTAL) and artificial stress (books) */
    double unbalanced;           /* J, lost in forms that do not conserve energy; see above (books) */
#define SPH_BOOK_MEMBER(name, unit, when, what) double name;
    SPH_BOOKS(SPH_BOOK_MEMBER)
    double balance;              /* J: constant but for the error of time steps (books); see above */
    double max_speed, min_density, max_density;
} sph_totals;
/* Sums over fluid and solid in double precision, in index order. */
#define sph_get_totals SPH_NAME(get_totals)
void sph_get_totals(const sph_sim *sim, sph_totals *out);

/* Values at a point x (m): Shepard-normalised sums over fluid and solid and their images behind the faces of the
   domain; walls are not in them. `cover` = sum (m/rho) W is about 1 inside and on faces that have images, 1/2 on a
   surface, on a wall or on an open face, and falls to 0 outside; where it is below 1e-6 the values are 0. */
typedef struct sph_probe_value {
    double cover, rho, p, v[SPH_DIM];
} sph_probe_value;
#define sph_probe SPH_NAME(probe)
sph_status sph_probe(const sph_sim *sim, const double *x, sph_probe_value *out);
/* n points evenly from a to b, both included. */
#define sph_probe_line SPH_NAME(probe_line)
sph_status sph_probe_line(const sph_sim *sim, const double *a, const double *b, uint32_t n, sph_probe_value *out);
/* Three gauges along `axis` through a point (m), which must be finite; each sees fluid and solid, and images.
   gauge    the highest place where cover passes 1/2, flying drops included; the domain's low end if there is none. x
            along the axis does not matter.
   surface  of the water that stands on `bed`: the first place, from half a spacing above it upwards, where cover falls
            below 1/2; the bed itself where that half spacing is dry. Drops above do not count, nor what is above a
            bubble.
   depth    integral of cover along the whole line: the volume in the column over its cross-section, smoothed over a
            support across the axis, drops included (beside a wall, where cover is less, it is less). x along the axis
            does not matter. */
#define sph_gauge SPH_NAME(gauge)
sph_status sph_gauge(const sph_sim *sim, const double *x, uint32_t axis, double *height);
#define sph_surface SPH_NAME(surface)
sph_status sph_surface(const sph_sim *sim, const double *bed, uint32_t axis, double *height);
#define sph_depth SPH_NAME(depth)
sph_status sph_depth(const sph_sim *sim, const double *x, uint32_t axis, double *depth);
/* Smallest and largest coordinate of fluid and solid along an axis, by particle centres. */
#define sph_extent SPH_NAME(extent)
void sph_extent(const sph_sim *sim, uint32_t axis, double *low, double *high);

/* Value and radial derivative of a smoothing kernel in this dimension: W (1/m^DIM) and dW/dr at distance r for
   smoothing length h; and its support in units of h. For tests, probes and tools. */
#define sph_kernel_value SPH_NAME(kernel_value)
sph_status sph_kernel_value(uint32_t kernel, double r, double h, double *w, double *dw);
#define sph_kernel_support SPH_NAME(kernel_support)
double sph_kernel_support(uint32_t kernel);

/* What looks wrong in a filled simulation, though it is allowed: X(name, text), and what count, value and limit are. */
#define SPH_FINDING_LIST(X)                                                                                           \
    X(COINCIDENT, "particles nearer to another than 0.3 spacings")    /* particles; least distance, 0.3 dx (m) */     \
    X(IN_WALL, "fluid or solid inside a wall")                        /* particles; largest depth, 0 (m) */           \
    X(SLOW_SOUND, "sound slower than 10 sqrt(g H), H the height that fluid may fall") /* sets; slowest, that (m/s) */ \
    X(FAST, "particles faster than a tenth of the sound speed of their set") /* particles; largest v/c, 0.1 */        \
    X(EMPTY_SET, "sets of fluid or solid without particles")          /* sets; 0, 1 */                                \
    X(SPARE, "the capacity is more than twice the particles")         /* max_particles; particles, half of it */
enum {
#define SPH_FINDING_ENUM(name, text) SPH_FINDING_##name,
    SPH_FINDING_LIST(SPH_FINDING_ENUM)
#undef SPH_FINDING_ENUM
        SPH_FINDINGS
};
typedef struct sph_finding {
    uint32_t kind; /* SPH_FINDING_... */
    const char *text;
    uint32_t count;
    double value, limit;
    uint32_t particle, other; /* the smallest id at fault, the one it coincides with; SPH_NO_PARTICLE: none */
    uint32_t set;             /* its set; of sets the first; or SPH_MAX_SETS */
} sph_finding;
/* Calls fn once for each kind that there is, in the order of the list; to be called when all was added, or between any
   steps. Changes nothing. Periodic faces are looked across. Returns BAD_STATE within a step. */
#define sph_inspect SPH_NAME(inspect)
sph_status sph_inspect(sph_sim *sim, void (*fn)(void *ctx, const sph_finding *finding), void *ctx);

/* ---- 10 hash ---------------------------------------------------------------------------------------
   64 bits over every array and scalar that the next step reads. Equal on every machine. */
#define sph_hash SPH_NAME(hash)
uint64_t sph_hash(const sph_sim *sim);

/* ---- 11 dump and restore ---------------------------------------------------------------------------
   Little-endian on every machine, versioned, self-describing, checksummed by section (layout: dump.h). The sink and
   source move pieces of at most SPH_PIECE bytes and return false to fail. A full dump (fields SPH_DUMP_FULL) restores a
   run that goes on with the same bits; a reduced one carries the chosen fields for pictures. Between the slices of a
   step a dump holds the state of the step's beginning. Each function uses less than 1 KiB of stack.
   Fails: SPH_BAD_ARGUMENT (no sink, unknown fields), SPH_SINK_FAILED. */
#define SPH_PIECE 256u
typedef bool (*sph_sink)(void *ctx, const void *bytes, size_t n);
typedef bool (*sph_source)(void *ctx, void *bytes, size_t n); /* must fill n bytes or return false */
#define SPH_DUMP_VELOCITY 1u
#define SPH_DUMP_DENSITY 2u
#define SPH_DUMP_PRESSURE 4u
#define SPH_DUMP_ACCELERATION 8u
#define SPH_DUMP_STRESS 16u /* deviatoric; this and the next where the scene has them */
#define SPH_DUMP_DAMAGE 32u /* plastic strain, D^(1/DIM) */
#define SPH_DUMP_ENERGY 64u /* u */
#define SPH_DUMP_PICTURE 119u /* position, set, id always */
#define SPH_DUMP_FULL 0x80000000u
#define sph_dump SPH_NAME(dump)
sph_status sph_dump(const sph_sim *sim, uint32_t fields, sph_sink sink, void *ctx);
/* Restores a full dump into a simulation that was initialised with the same configuration and then given the same
   sets and walls, in the same order; it may have run since. Gravity, damping and the fixed dt become those of the
   dump (sph_reconfigure may change them again); hooks and threads stay those of the simulation. Reads the stream once,
   into the spare half of the arena, and commits only when every checksum and value was seen to be right; on any
   failure the simulation is as it was. A source that returns false is taken as the stream's end. Not
   a byte behind the dump is read: what a host puts there (notes on its scene, as the tool does) is its own.
   Fails: SPH_BAD_STATE (a step is under way), SPH_DUMP_TRUNCATED, SPH_DUMP_CORRUPT, SPH_DUMP_FOREIGN, SPH_DUMP_NEWER,
   SPH_DUMP_MISMATCH (a reduced dump, or one of another configuration, set-up or capacity). */
#define sph_restore SPH_NAME(restore)
sph_status sph_restore(sph_sim *sim, sph_source source, void *ctx);

#ifdef __cplusplus
}
#endif

#endif
