/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* internal.h: the simulation's own data. Which file does what: README.md in this folder.

   Arrays: a state buffer holds what one moment of the scene is made of. A step reads buffer `cur`, writes another,
   and commits by changing `cur`: that is how a failed step leaves the state as it was. */
#ifndef SPH_INTERNAL_H
#define SPH_INTERNAL_H

#include "arrays.h"
#include "columns.h"
#include "digest.h"
#include "eos.h"
#include "fields.h"
#include "lanes.h"
#include "report.h"
#include "sph.h"

#define SPH_PAD 48u       /* elements that may be read past an array's end by a vector */
/* powers on the books (W); what is given: walls, body force; what is taken: the others (see sph_totals) */
enum {
    POWER_DISSIPATED,
    POWER_WALL,
    POWER_DIFFUSED,
    POWER_BODY_FORCE,
    POWER_IN_WALLS,
    POWER_IN_BONDS,
    POWER_UNBALANCED,
    SPH_POWERS
};
/* sums of a chunk for the books: those, and what happens at once (J): given to held sets, then books of sph.h */
enum { JUMP_HELD = SPH_POWERS, JUMP_REMOVED, JUMP_RELEASED, JUMP_PUT_BACK, JUMP_DAMPED, JUMP_FILTERED, SPH_PARTIALS };
#define SPH_DEAD 255u     /* set of a particle that is gone and will be dropped by the next sort */
/* a sum of squares above this counts as not finite: a float has room for a factor of 1e8 beyond */
#define SPH_LIMIT_SQUARE ((sph_real)1e30)
/* where density diffuses or shifts: the density of which a neighbour's volume is at least, of that at rest */
#define SPH_LEAST_DENSITY 0.95
/* Strips of that many cells, one after the other: where no particle is in one or beside it, nothing is stored but where
   slabs begin (sort.c). What is true of a strip: */
#define SPH_STRIP 32u
enum { SPH_PEOPLED = 1, SPH_STORED = 2 };
#define SPH_STRIPS (SPH_WITH_SKIP_EMPTY && SPH_DIM > 1)
#define SPH_CANDIDATE_CELLS (SPH_DIM == 1 ? 3 : SPH_DIM == 2 ? 9 : 27)

/* one particle set: constants that its particles share */
typedef struct sph_set {
    uint32_t role, kind, group; /* group: SPH_MAX_GROUPS if it moves by forces alone */
    bool compressible, no_slip, corner;
    uint8_t eos;
    uint8_t kin; /* matter: the first set of the same material: role, rest density, sound speed, equation of state */
    uint8_t side; /* walls: SPH_BOTH_SIDES ... */
    uint8_t flow; /* 1 + the number of the inflow or outflow that it is; 0: none */
    double mass, rho0, c0;
    double strength;
    double origin[SPH_DIM];     /* middle of the wall's face at displacement 0, from the domain's low corner (m) */
    double normal[SPH_DIM];     /* into the fluid */
    double tangent[SPH_DIM];    /* 3-D: one of the two in-plane directions */
    double half[2], thick;      /* wall region behind the face: half extents along tangents, depth (m) */
    sph_pos low[SPH_DIM], high[SPH_DIM]; /* box around that region, quanta, at displacement 0 */
    sph_real mass_r, rho0_r, inv_rho0_r, b_r; /* what the sweep reads; b: pressure scale of the equation of state */
} sph_set;

/* an inflow or outflow (flow.c): its box, the way through it */
typedef struct sph_flow_state {
    sph_pos face, end;                   /* quanta along its axis: the face to the water, the opposite one */
    sph_pos lo[SPH_DIM], hi[SPH_DIM];    /* its box, quanta */
    uint8_t axis, set, fluid;            /* its own set; of the water */
    bool out, up;                        /* up: it goes along the axis, not against it */
} sph_flow_state;

/* what a set of solid has besides */
typedef struct sph_material {
    double shear, yield, hardening, crack_rate; /* Pa; crack_rate: crack speed over flaw radius, 1/s */
    sph_real shear_r;
    uint32_t body, held; /* held: bits 1 << axis */
    bool flat;
} sph_material;

/* what a particle is told of the edges that let waves out (outline.c, edges.c), by id */
typedef struct sph_edge_mark {
    sph_real normal[SPH_DIM]; /* outward */
    sph_real cosine;          /* H: of the angle between it and the line from the source */
    sph_real velocity[SPH_DIM]; /* m/s, of what lies beyond */
    sph_real damp[SPH_DIM];   /* d of the matched layer, 1/s */
    sph_real push[SPH_DIM];   /* m/s^2, of the stress that stood at the edge at the start */
    sph_real stress[SPH_NT];  /* Pa, that stress */
    uint8_t level;            /* 1: outermost layer ...; 0: inside */
    uint8_t claimed;          /* while lines are made: 1 + axis of the last that has it */
} sph_edge_mark;
#define SPH_EDGE_LINE 6u
/* a line of particles from an edge inward */
typedef struct sph_edge_line {
    uint32_t id[SPH_EDGE_LINE], count;
    sph_real normal[SPH_DIM];
} sph_edge_line;

/* wall sets that move or vanish together */
typedef struct sph_group {
    sph_motion motion;
    void *ctx;
} sph_group;
#define SPH_NO_LAG 1e300
/* where a group is now */
typedef struct sph_group_state {
    double remove_at;           /* s; 1e300: never */
    double vel[SPH_DIM];        /* m/s */
    sph_pos moved[SPH_DIM];     /* displacement, quanta; along a periodic axis within half a domain, round it */
    double lag[2][SPH_DIM];     /* m/s, its velocity filtered once and twice (groups.c); SPH_NO_LAG: not yet known */
    uint32_t removed;
} sph_group_state;

/* largest values of the latest force sweep: what the step limits are made of */
typedef struct sph_peaks {
    sph_real mu, acc, speed;
} sph_peaks;

/* constants of the pair formulas (factors.c) */
#define SPH_LEVELS 3 /* stabilised.h: layers below a face that are told apart */
typedef struct sph_factors {
    sph_real inv_h, eta, eta_morris, reach, reach2, slope, value;
    sph_real value_slope;        /* forms of solids: the scale of W over that of its slope */
    sph_real edge[SPH_LEVELS];   /* stabilised: what S has between rows below a face */
    sph_real inv_wdx, repulsion; /* 1/(W(dx) without its scale); artificial stress: epsilon */
    sph_real apart;              /* shift_pairs: (W/W(dx))^4 of pairs that are moved apart is above it */
    sph_real contact;            /* of two bodies: T_i + T_j where W is twice W(dx) */
    sph_real least_rho;          /* diffusion: of a neighbour, 0.95 rho0 (tiles.c) */
    sph_real av_alpha, av_beta, morris, diff, hydro[SPH_DIM], hydro_offset, gravity[SPH_DIM], small_p;
    sph_real cover, weigh;       /* quadrature: slope over Q0, beta */
    bool rate_by_density, continuity, extras;
    bool loses, bonds;           /* books: the form does not conserve energy; contact or artificial stress */
} sph_factors;

/* everything of the state that is not an array; copied whole when a step commits */
typedef struct sph_scalars {
    double time, dt_last;
    uint64_t step;
    uint32_t count, left, crossed, put_back, reflected, next_id; /* next_id: where free ids are looked for */
    bool primed, started; /* first forces known; first step done (leap-frog) */
    sph_peaks peaks;
    double work[SPH_POWERS]; /* J, their integrals */
    SPH_BOOKS(SPH_BOOK_MEMBER)
    double power[SPH_POWERS]; /* W, at the end of the latest step */
    sph_group_state group[SPH_MAX_GROUPS];
} sph_scalars;

/* a place in a step where a failure was seen; the smallest particle id wins, so it does not depend on threads */
typedef struct sph_fail {
    sph_status status;
    uint32_t particle;
    double value;
} sph_fail;

/* the domain in quanta and in cells of one support */
typedef struct sph_grid {
    double quantum, length[SPH_DIM]; /* m */
    double support;                  /* m */
    sph_pos extent[SPH_DIM];         /* domain size, quanta */
    sph_pos cell_size[SPH_DIM];      /* about; the cells' corners are where cell_mul puts them */
    uint32_t ncell[SPH_DIM], cells, slabs, slab_cells;
    uint32_t cell_mul[SPH_DIM], cell_shift[SPH_DIM]; /* cell = (units * mul) >> (32 + shift): see grid.c */
} sph_grid;

struct sph_thread; /* per-thread scratch: scratch.h */

typedef struct sph_pass sph_pass;
/* What a stage of an integrator does to the particles at its sort, as shares of dt (bend: of dt^2):
   displacement = drift (v + drift velocity) + bend a, v' = v + kick a, what evolves + rate d/dt. */
typedef struct sph_stage {
    sph_real drift, bend, kick, rate;
    sph_real at;   /* the moment of its forces, walls and body force: share of dt from the step's beginning */
    bool damps;    /* v' is multiplied by cfg.damping */
    bool reflects; /* particles that a mirror face turned are counted: not where the whole step will count them */
    bool resumes;  /* leap-frog: velocities are ahead by half of the last step, and are to be ahead by half of this */
    bool middle;   /* rates are summed first, in the middle of the step, then forces, at its end */
    bool keeps;    /* nothing is summed but density: all other fields go with their particle as they are */
} sph_stage;
struct sph_integrator; /* integrators.h */

#define SPH_MAX_RANGES 64u
/* room for the passes of the longest list that is in (integrators.c) */
#define SPH_MAX_PROGRAM (SPH_HAS_RUNGE_KUTTA ? 72u : 56u)

struct sph_sim {
    sph_config cfg;
    sph_grid grid;
    double courant; /* cfl, or less where the integrator does not stand it */
    sph_factors fac;
    /* arrays */
    sph_buffer buf[3];
    uint32_t buffers, cur, src, dst; /* current state; source and target of the stage under way */
    uint32_t src_count;              /* particles in src */
    bool middle;                     /* what is summed now is rates, in the middle of the step */
    double moment;                   /* s, time of the forces and walls of the stage */
    const sph_stage *stage;          /* the one under way */
    const struct sph_integrator *integrator; /* whose list of passes runs */
    bool src_table;                  /* cell[] belongs to src, so its slabs are known */
#define SPH_ONE_MEMBER(name, type, count, when, what) type *name;
#define SPH_MANY_MEMBER(name, type, components, count, when, what) type *name[components];
    SPH_SCENE_ARRAYS(SPH_ONE_MEMBER, SPH_MANY_MEMBER)
    uint32_t flaws;
    uint32_t edge_from[SPH_DIM + 1];                    /* lines along axis k: edge_from[k] .. edge_from[k + 1] */
    double edge_weight[SPH_EDGE_LINE][SPH_EDGE_LINE];   /* A of a line of n + 1 particles */
    size_t arena_bytes, arena_used;
    /* sets */
    const struct sph_column_set *columns;    /* the table of column sets (columns.c) */
    uint32_t extra_reals, extra_at[SPH_COLUMN_COUNT]; /* of a thread's column sets: reals, and where each begins */
    uint32_t sets, groups, unplaced; /* particles that an addition found no room for */
    uint64_t setup_hash;
    bool has_adami, has_force_wall;
    bool mixed, own_sound; /* matter is of several materials, or of one that is not the configuration's; so is its c0 */
    bool table_valid;      /* cell[] belongs to buffer cur */
    bool sided;            /* there are walls that act on one side only */
    /* step machine */
    const sph_pass *program[SPH_MAX_PROGRAM];
    uint32_t passes, pc, chunk, chunks, chunk_cells; /* chunk_cells: of the sweeps of the step under way */
    bool begun;
    double dt, t_end;
    uint32_t limit;
    double limit_dt[SPH_LIMITS];
    uint64_t work, pairs, budget;
    sph_peaks peaks; /* of the latest pass */
    uint32_t ranges, range_count[SPH_MAX_RANGES];
    sph_report report;
    /* marks */
    uint32_t mark_particles, mark_cell;
    uint64_t mark_work, mark_slice, last_work, last_pairs;
    uint32_t last_passes, last_limit;
    double last_dt;
    uint32_t flows, newcomers; /* newcomers: behind the last particle of buffer cur, in the step under way */
    /* state; the largest comes last: what is near the beginning takes shorter code */
    sph_scalars next, now; /* next: being made by the step under way */
    double wall_acc[SPH_MAX_GROUPS][SPH_DIM]; /* m/s^2, of groups that move, at `moment` (groups.c) */
};

/* A pass: some chunks that may run in any order and at once, then an end that runs alone. */
struct sph_pass {
    const char *name;
    uint32_t (*chunks)(const sph_sim *sim);                            /* null: none */
    void (*run)(sph_sim *sim, uint32_t chunk, struct sph_thread *t);   /* adds to t->work and the like */
    sph_status (*end)(sph_sim *sim);                                   /* null: nothing */
    bool (*wanted)(const sph_sim *sim);                                /* null: always */
};

/* ---- what was compiled in (modules.h), as bits 1 << choice ---- */

#define SPH_KERNELS_IN                                                                                      \
    (SPH_WITH_CUBIC << SPH_CUBIC | SPH_WITH_QUARTIC << SPH_QUARTIC | SPH_WITH_QUINTIC << SPH_QUINTIC |      \
     SPH_WITH_GAUSSIAN << SPH_GAUSSIAN | SPH_WITH_WENDLAND_C2 << SPH_WENDLAND_C2 |                          \
     SPH_WITH_WENDLAND_C4 << SPH_WENDLAND_C4 | SPH_WITH_HAT << SPH_HAT)
#define SPH_SCHEMES_IN                                                                                      \
    (SPH_WITH_STANDARD << SPH_STANDARD | SPH_WITH_WEAK << SPH_WEAK | SPH_WITH_DIRECT << SPH_DIRECT |        \
     SPH_WITH_STANDARD_WICK << SPH_STANDARD_WICK | SPH_WITH_WEAK_WICK << SPH_WEAK_WICK)
#define SPH_EOSES_IN                                                                                        \
    (SPH_WITH_TAIT << SPH_TAIT | SPH_WITH_TAIT_GRAY << SPH_TAIT_GRAY | SPH_WITH_LINEAR << SPH_LINEAR |      \
     SPH_WITH_ISOTHERMAL << SPH_ISOTHERMAL | SPH_WITH_IDEAL_GAS << SPH_IDEAL_GAS)
#define SPH_VISCOSITIES_IN                                                                                  \
    (1 << SPH_INVISCID | SPH_WITH_ARTIFICIAL << SPH_ARTIFICIAL |                                            \
     SPH_WITH_ARTIFICIAL_APPROACHING << SPH_ARTIFICIAL_APPROACHING | SPH_WITH_MORRIS << SPH_MORRIS)
#define SPH_DENSITIES_IN (1 << SPH_CONTINUITY | SPH_WITH_SUMMATION << SPH_SUMMATION)
#define SPH_DIFFUSIONS_IN                                                                                   \
    (1 << SPH_NO_DIFFUSION | SPH_WITH_MOLTENI << SPH_MOLTENI | SPH_WITH_HYDROSTATIC << SPH_HYDROSTATIC |    \
     SPH_WITH_ANTUONO << SPH_ANTUONO)
#define SPH_INTEGRATORS_IN                                                                                  \
    (SPH_WITH_PREDICTOR_CORRECTOR << SPH_PREDICTOR_CORRECTOR | SPH_WITH_KICK_DRIFT_KICK << SPH_KICK_DRIFT_KICK | \
     SPH_WITH_LEAP_FROG << SPH_LEAP_FROG | SPH_WITH_RUNGE_KUTTA << SPH_RUNGE_KUTTA |                        \
     SPH_WITH_RUNGE_KUTTA_MOMENTUM << SPH_RUNGE_KUTTA_MOMENTUM)
#define SPH_FACES_IN                                                                                        \
    (1 << SPH_OPEN | SPH_WITH_PERIODIC << SPH_PERIODIC | SPH_WITH_SYMMETRY << SPH_SYMMETRY |                \
     SPH_WITH_MIRROR_NO_SLIP << SPH_MIRROR_NO_SLIP)
#define SPH_WALLS_IN                                                                                        \
    (SPH_WITH_WALL_LENNARD_JONES << SPH_WALL_LENNARD_JONES | SPH_WITH_WALL_KERNEL_FORCE << SPH_WALL_KERNEL_FORCE | \
     SPH_WITH_WALL_MONAGHAN_KOS << SPH_WALL_MONAGHAN_KOS | SPH_WITH_WALL_GHOST << SPH_WALL_GHOST |          \
     SPH_WITH_WALL_ADAMI << SPH_WALL_ADAMI)

_Static_assert(SPH_KERNELS_IN != 0 && SPH_SCHEMES_IN != 0 && SPH_EOSES_IN != 0 && SPH_INTEGRATORS_IN != 0,
               "modules.h: at least one smoothing kernel, scheme, equation of state and integrator must be in");

#define SPH_SOLIDS_IN                                                                                       \
    (1 << SPH_NO_SOLID | SPH_WITH_SOLID << SPH_UPDATED | (SPH_WITH_SOLID && SPH_WITH_CORRECTED) << SPH_CORRECTED |   \
     SPH_HAS_TOTAL << SPH_TOTAL | SPH_HAS_STABILISED << SPH_STABILISED | SPH_HAS_NORMALISED << SPH_NORMALISED |      \
     SPH_HAS_NORMALISED << SPH_NORMALISED_CORRECTED)
#define SPH_YIELDS_IN (1 << SPH_NO_YIELD | SPH_HAS_YIELD << SPH_VON_MISES | SPH_HAS_YIELD << SPH_VON_MISES_GRAY)
#define SPH_DAMAGES_IN                                                                                      \
    (1 << SPH_NO_DAMAGE | SPH_HAS_DAMAGE << SPH_BENZ_ASPHAUG | SPH_HAS_DAMAGE << SPH_BENZ_ASPHAUG_GRAY)
#define SPH_FILTERS_IN (1 << SPH_SHEPARD | SPH_WITH_MLS << SPH_MLS)
#define SPH_SHEARS_IN                                                                                       \
    (1 << SPH_NO_SHEAR | SPH_WITH_NESTED << SPH_NESTED | SPH_WITH_SMAGORINSKY << SPH_SMAGORINSKY |          \
     SPH_WITH_SMAGORINSKY_WICK << SPH_SMAGORINSKY_WICK)
#define SPH_GRADIENTS_IN                                                                                    \
    (1 << SPH_PLAIN | SPH_WITH_BONET_LOK << SPH_BONET_LOK | SPH_WITH_RENORMALISED << SPH_RENORMALISED)
#define SPH_EDGES_IN (SPH_HAS_EDGES ? (1 << SPH_EDGES) - 1 : 1 << SPH_NO_EDGE)
#define SPH_REPULSIONS_IN                                                                                   \
    (1 << SPH_NO_ARTIFICIAL_STRESS | SPH_HAS_REPULSION << SPH_PRINCIPAL | SPH_HAS_REPULSION << SPH_COMPONENTS)

SPH_INLINE bool sph_in(uint32_t mask, uint32_t choice) { return choice < 32 && mask >> choice & 1; }

/* questions about choices that fold to constants where a module is left out */
SPH_INLINE bool sph_weak_scheme(uint32_t s) { return SPH_IS(s, WEAK) || SPH_IS(s, DIRECT) || SPH_IS(s, WEAK_WICK); }
SPH_INLINE bool sph_viscous(uint32_t v)
{
    return SPH_IS(v, ARTIFICIAL) || SPH_IS(v, ARTIFICIAL_APPROACHING) || SPH_IS(v, MORRIS);
}
SPH_INLINE bool sph_diffusive(uint32_t d)
{
    return SPH_IS(d, MOLTENI) || SPH_IS(d, HYDROSTATIC) || SPH_IS(d, ANTUONO);
}
SPH_INLINE bool sph_takes_density_gradient(const sph_config *c) { return SPH_IS(c->diffusion, ANTUONO); }
SPH_INLINE bool sph_sums_density(const sph_config *c) { return SPH_IS(c->density, SUMMATION); }
SPH_INLINE bool sph_keeps_books(const sph_config *c) { return SPH_WITH_BOOKS && c->books; }
SPH_INLINE bool sph_uses_xsph(const sph_config *c) { return SPH_WITH_XSPH && c->xsph != 0; }
SPH_INLINE bool sph_has_mirrors(const sph_config *c, uint32_t k) /* on axis k */
{
    return SPH_HAS_MIRRORS && (SPH_IS(c->face[k][0], SYMMETRY) || SPH_IS(c->face[k][0], MIRROR_NO_SLIP) ||
                               SPH_IS(c->face[k][1], SYMMETRY) || SPH_IS(c->face[k][1], MIRROR_NO_SLIP));
}
SPH_INLINE bool sph_has_any_mirrors(const sph_config *c)
{
    return sph_has_mirrors(c, 0) || (SPH_DIM > 1 && sph_has_mirrors(c, SPH_DIM > 1)) ||
           (SPH_DIM > 2 && sph_has_mirrors(c, SPH_DIM - 1));
}
/* faces in which what is heavier below is seen upside down */
SPH_INLINE bool sph_turns_upside_down(const sph_config *c)
{
    bool turns = false;
    for (uint32_t k = 0; k < SPH_DIM && SPH_HAS_MIRRORS; k++)
        turns |= sph_has_mirrors(c, k) && c->gravity[k] != 0;
    return turns;
}
SPH_INLINE bool sph_quiets(const sph_config *c) { return SPH_WITH_DAMPER && c->damper > 0; }
SPH_INLINE bool sph_slows(const sph_config *c) { return SPH_WITH_DAMPING_RATE && c->damping_rate > 0; }
SPH_INLINE bool sph_evens(const sph_config *c) { return SPH_HAS_XSPH_VELOCITY && c->xsph_velocity; }
/* whether positions go with the XSPH velocity, too */
SPH_INLINE bool sph_drifts(const sph_config *c) { return sph_uses_xsph(c) && !sph_evens(c); }
SPH_INLINE bool sph_has_flows(const sph_config *c) { return SPH_WITH_FLOW && c->max_flows > 0; }
SPH_INLINE bool sph_has_sponge(const sph_config *c) { return SPH_WITH_SPONGE && c->sponge_rate > 0; }
SPH_INLINE bool sph_shifts(const sph_config *c) { return SPH_WITH_SHIFTING && c->shifting > 0; }
SPH_INLINE bool sph_filters(const sph_config *c)
{
    return SPH_WITH_SHEPARD && (c->shepard_every != 0 || c->filter_period > 0);
}

SPH_INLINE bool sph_has_solids(const sph_config *c) { return SPH_WITH_SOLID && c->solid != SPH_NO_SOLID; }
/* predictor-corrector, fluids: the change of the rate of density is foreseen (kick.h) */
SPH_INLINE bool sph_foresees(const sph_config *c)
{
    const bool only = SPH_INTEGRATORS_IN == 1 << SPH_PREDICTOR_CORRECTOR;
    return (only || SPH_IS(c->integrator, PREDICTOR_CORRECTOR)) && !sph_has_solids(c);
}
SPH_INLINE bool sph_is_total(const sph_config *c) { return SPH_HAS_TOTAL && c->solid == SPH_TOTAL; }
SPH_INLINE bool sph_corrects(const sph_config *c)
{
    return SPH_HAS_CORRECTION && (c->solid == SPH_CORRECTED || c->solid == SPH_TOTAL);
}
SPH_INLINE bool sph_stabilises(const sph_config *c) { return SPH_HAS_STABILISED && c->solid == SPH_STABILISED; }
SPH_INLINE bool sph_normalises(const sph_config *c) { return SPH_HAS_NORMALISED && c->solid >= SPH_NORMALISED; }
SPH_INLINE bool sph_resists_hourglass(const sph_config *c) { return SPH_HAS_HOURGLASS && c->hourglass > 0; }
SPH_INLINE bool sph_weighs_faces(const sph_config *c) { return SPH_HAS_QUADRATURE && c->face_quadrature; }
SPH_INLINE bool sph_has_edges(const sph_config *c) { return SPH_HAS_EDGES && c->edge != SPH_NO_EDGE; }
SPH_INLINE bool sph_is_matched(const sph_config *c) { return sph_has_edges(c) && c->edge_width > 0; }
/* edges that replace the acceleration */
SPH_INLINE bool sph_replaces(const sph_config *c) { return SPH_HAS_EDGES && c->edge >= SPH_EDGE_P; }
SPH_INLINE bool sph_shears(const sph_config *c) { return SPH_WITH_SHEAR && c->shear != SPH_NO_SHEAR; }
SPH_INLINE bool sph_has_energy(const sph_config *c) { return SPH_WITH_ENERGY && c->energy; }
SPH_INLINE bool sph_varies_h(const sph_config *c) { return SPH_WITH_VARIABLE_H && sph_has_energy(c) && c->variable_h; }
/* the largest smoothing length that a particle may have (m) */
SPH_INLINE double sph_largest_h(const sph_config *c)
{
    return sph_varies_h(c) ? c->h_max * c->smoothing_length : c->smoothing_length;
}
SPH_INLINE bool sph_corrects_fluids(const sph_config *c) { return SPH_HAS_FLUID_GRADIENT && c->gradient != SPH_PLAIN; }
SPH_INLINE bool sph_guards_gradient(const sph_config *c) { return SPH_IS(c->gradient, BONET_LOK) && c->gradient_guard; }
SPH_INLINE bool sph_yields(const sph_config *c) { return SPH_HAS_YIELD && c->yield != SPH_NO_YIELD; }
SPH_INLINE bool sph_damages(const sph_config *c) { return SPH_HAS_DAMAGE && c->damage != SPH_NO_DAMAGE; }
SPH_INLINE bool sph_repels(const sph_config *c)
{
    return SPH_HAS_REPULSION && c->artificial_stress != SPH_NO_ARTIFICIAL_STRESS;
}
SPH_INLINE bool sph_smooths_strain(const sph_config *c) { return SPH_HAS_HAT && c->xsph_strain && sph_has_solids(c); }

/* whether a set is made of what moves by forces, not wall */
#define SPH_MATTER (1u << SPH_ROLE_FLUID | 1u << SPH_ROLE_SOLID)
SPH_INLINE bool sph_is_solid(const sph_set *s) { return SPH_WITH_SOLID && s->role == SPH_ROLE_SOLID; }
SPH_INLINE const sph_material *sph_material_of(const sph_sim *sim, const sph_set *s)
{
    return sim->material + (s - sim->set);
}
/* whether a set of ghosts has a density that goes by continuity */
SPH_INLINE bool sph_is_compressible(const sph_set *s) { return SPH_WITH_WALL_GHOST && s->compressible; }
/* the axes of a wall's face: its normal, then directions in its plane (sph_set.half) */
SPH_INLINE void sph_frame_of(const sph_set *s, double (*axis)[SPH_DIM])
{
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const uint32_t last = SPH_DIM - 1;
        axis[0][k] = s->normal[k];
        if (SPH_DIM == 2)
            axis[last][k] = k ? s->normal[0] : -s->normal[last];
        if (SPH_DIM == 3) {
            const uint32_t a = (k + 1) % SPH_DIM, b = (k + 2) % SPH_DIM;
            axis[SPH_DIM > 1][k] = s->tangent[k];
            axis[last][k] = s->normal[a] * s->tangent[b] - s->normal[b] * s->tangent[a];
        }
    }
}
/* the inflow or outflow that a set is, or null */
SPH_INLINE const sph_flow_state *sph_flow_of(const sph_sim *sim, const sph_set *s)
{
    return SPH_WITH_FLOW && s->flow ? &sim->flow[s->flow - 1] : NULL;
}
SPH_INLINE bool sph_is_matter(const sph_set *s) { return s->role == SPH_ROLE_FLUID || sph_is_solid(s); }

/* what positions drift with beside vel, along axis k; null in scenes where they do not */
SPH_INLINE sph_real *sph_drift(const sph_sim *sim, const sph_buffer *b, uint32_t k)
{
    return sph_drifts(&sim->cfg) ? b->xsph[k] : NULL;
}
/* whether the sort under way is a step's first, from the current state; first forces are no step */
SPH_INLINE bool sph_begins_step(const sph_sim *sim) { return sim->src == sim->cur && sim->now.primed; }
/* a set whose pressure is that of an ideal gas: it follows from density and energy */
SPH_INLINE bool sph_is_gas(const sph_set *s) { return SPH_IS(s->eos, IDEAL_GAS); }

/* ---- shared by files ---- */

/* state.c: records a failure with the pass under way and tells the host's fault hook; returns s */
#define sph_error SPH_NAME(error_)
sph_status sph_error(sph_sim *sim, sph_status s, const char *what, const char *allowed, double value,
                     uint32_t particle);
/* the stress after damage (xx, yy, zz, xy, xz, yz; Pa, tension positive) and D of a particle of a buffer, in double */
#define sph_stress_of SPH_NAME(stress_of_)
double sph_stress_of(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *stress);
/* 1 - D of a particle */
#define sph_whole_of SPH_NAME(whole_of_)
sph_real sph_whole_of(const sph_buffer *b, uint32_t i);
/* phi of a particle (quadrature.c) */
#define sph_quadrature_of SPH_NAME(quadrature_of_)
sph_real sph_quadrature_of(const sph_buffer *b, uint32_t i);
/* The energy that a particle of a buffer holds (J): of motion; in gravity, from height 0; of compression by the
   pressure that acts, and its heat (energy.h); of distortion, (1 - D) S:S/(4 mu) on its volume at rest; and what its
   yielding took. */
typedef struct sph_energy {
    double kinetic, potential, internal, elastic, plastic;
} sph_energy;
#define sph_energy_of SPH_NAME(energy_of_)
sph_energy sph_energy_of(const sph_sim *sim, const sph_buffer *b, uint32_t i);
SPH_INLINE double sph_energy_sum(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const sph_energy e = sph_energy_of(sim, b, i);
    return e.kinetic + e.potential + e.internal + e.elastic + e.plastic;
}
/* smoothing_length.c: h over the configuration's, of a particle of a set with a density excess d, where it varies */
#define sph_relative_h SPH_NAME(relative_h_)
double sph_relative_h(const sph_sim *sim, const sph_set *set, double d);
#define sph_hash_buffer SPH_NAME(hash_buffer_)
uint64_t sph_hash_buffer(const sph_sim *sim, const sph_buffer *b, uint32_t n);

/* options.c: see options.h */
enum {
    SPH_OPTION_WHOLE, SPH_OPTION_REAL, SPH_OPTION_POSITIVE, SPH_OPTION_VECTOR, SPH_OPTION_BOOL, SPH_OPTION_CHOICE,
    SPH_OPTION_FACES
};
enum { SPH_OPTION_FIXED, SPH_OPTION_FREE, SPH_OPTION_ROOM };
enum {
#define SPH_OPTION_NUMBER(A, name, ...) SPH_NUMBER_OF_##name,
    SPH_OPTIONS(SPH_OPTION_NUMBER, SPH_OPTION_NUMBER, )
    SPH_OPTION_COUNT
};
/* the defaults; a configuration that began with them has their cookie */
#define sph_options_start SPH_NAME(options_start_)
extern const sph_config sph_options_start;
/* each option alone; r may be null */
#define sph_options_check SPH_NAME(options_check_)
sph_status sph_options_check(const sph_config *c, sph_report *r);
/* what would be allowed instead of v for an option, SPH_NUMBER_OF_...; null: v is */
#define sph_option_refusal SPH_NAME(option_refusal_)
const char *sph_option_refusal(uint32_t number, double v);
/* takes everything from a configuration but the room that the arena was made for */
#define sph_options_take SPH_NAME(options_take_)
void sph_options_take(sph_config *c, const sph_config *from);
/* digest of the options that may not change */
#define sph_hash_config SPH_NAME(hash_config_)
uint64_t sph_hash_config(const sph_config *c);

/* grid.c: the grid of a configuration whose options were checked; r may be null */
#define sph_make_grid SPH_NAME(make_grid_)
sph_status sph_make_grid(const sph_config *c, sph_grid *s, sph_report *r);

/* layout.c: bytes of the arena, false if this machine cannot address them; lays it out; lists what is in it */
typedef void sph_arena_fn(void *ctx, const char *name, size_t bytes);
#define sph_measure_arena SPH_NAME(measure_arena_)
bool sph_measure_arena(const sph_config *c, const sph_grid *g, size_t *bytes);
#define sph_lay_out_arena SPH_NAME(lay_out_arena_)
sph_sim *sph_lay_out_arena(const sph_config *c, const sph_grid *g, void *arena);
#define sph_list_arena SPH_NAME(list_arena_)
void sph_list_arena(const sph_config *c, const sph_grid *g, sph_arena_fn *fn, void *ctx);

/* whether a set's pressure is held at 0 or above */
SPH_INLINE bool sph_has_floor(const sph_sim *sim, const sph_set *s)
{
    return sim->cfg.pressure_floor && !sph_is_solid(s);
}
/* pressure (Pa) of a set's particle at relative density excess d, and the excess at a pressure (eos.h) */
SPH_INLINE double sph_pressure(const sph_sim *sim, const sph_set *s, double d)
{
    return sph_eos_pressure(s->eos, (double)s->b_r, d, sph_has_floor(sim, s));
}
/* of particle i of a buffer */
SPH_INLINE double sph_pressure_at(const sph_sim *sim, const sph_buffer *b, uint32_t i)
{
    const sph_set *s = &sim->set[b->set[0][i]];
    const double d = (double)b->rho[0][i];
    return sph_is_gas(s) ? (double)s->b_r * (1 + d) * (double)b->energy[0][i] : sph_pressure(sim, s, d);
}
SPH_INLINE double sph_density_of(const sph_sim *sim, const sph_set *s, double p)
{
    (void)sim;
    return sph_eos_excess(s->eos, (double)s->b_r, p);
}

SPH_INLINE bool sph_finite(double x) { return x - x == 0; }
SPH_INLINE double sph_abs(double x) { return x < 0 ? -x : x; }

/* number of equal leading bytes, in order of address, of two words that differ by x != 0 */
SPH_INLINE uint32_t sph_equal_bytes(uint64_t x)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return (uint32_t)__builtin_clzll(x) / 8;
#else
    return (uint32_t)__builtin_ctzll(x) / 8;
#endif
}

/* first index in s..e whose set differs from that of s; arrays may be read a little beyond e */
SPH_INLINE uint32_t sph_run_end(const uint8_t *set, uint32_t s, uint32_t e)
{
    const uint64_t first = set[s] * (uint64_t)0x0101010101010101u;
    for (uint32_t i = s; i < e; i += 8) {
        uint64_t next;
        memcpy(&next, set + i, sizeof next);
        if (next != first) {
            i += sph_equal_bytes(next ^ first);
            return i < e ? i : e;
        }
    }
    return e;
}

/* Until a stage settles, array id of buffer dst holds each particle's index in src. */
SPH_INLINE const uint32_t *sph_source_index(const sph_sim *sim) { return sim->buf[sim->dst].id[0]; }
/* the id of particle i of dst, until the stage settles */
SPH_INLINE uint32_t sph_source_id(const sph_sim *sim, uint32_t i)
{
    return sim->buf[sim->src].id[0][sph_source_index(sim)[i]];
}

/* What mirrors have turned of a particle between buffer src, of which it is number p, and dst (array `turned`): bits
   1 << axis of vectors, 8 << axis of tensors too. A plane of symmetry puts the mirrored particle in its place, with all
   that it has. A no-slip mirror throws it back: its velocity turns, but the shear stress on the plane goes on through
   it, as in the image (tiles.c, stress.c). -1 where an odd number of the bits of `mask`, one or two, are set. */
#define SPH_TURNS_VECTORS 1u
#define SPH_TURNS_TENSORS 8u
SPH_INLINE sph_real sph_turn_of(const sph_sim *sim, uint32_t p, uint32_t mask)
{
    const uint32_t set = sim->turned[p] & mask;
    return set != 0 && (set & (set - 1)) == 0 ? -1 : 1;
}
/* of component k of a vector of particle i of dst, until the stage settles; the scene has mirrors */
SPH_INLINE sph_real sph_turn(const sph_sim *sim, uint32_t k, uint32_t i)
{
    return sph_turn_of(sim, sph_source_index(sim)[i], SPH_TURNS_VECTORS << k);
}

/* particles behind the last of buffer cur that this step brings in */
SPH_INLINE uint32_t sph_newcomers(const sph_sim *sim) { return SPH_WITH_FLOW ? sim->newcomers : 0; }
/* whether a wall group is gone, and how fast it moves along an axis (m/s), at the moment of the stage under way */
SPH_INLINE bool sph_wall_removed(const sph_sim *sim, const sph_set *s)
{
    return SPH_HAS_GROUPS && sim->next.group[s->group].removed;
}
/* the axes along which a set moves as it is told, as bits */
SPH_INLINE uint32_t sph_held(const sph_sim *sim, const sph_set *s)
{
    if (!SPH_HAS_HELD || !sph_is_solid(s) || s->group == SPH_MAX_GROUPS || sim->next.group[s->group].removed)
        return 0;
    return sph_material_of(sim, s)->held;
}
/* axes along which XSPH moves nothing of a set: those on which it is held; all of them where a flow carries it */
SPH_INLINE uint32_t sph_undrifting(const sph_sim *sim, const sph_set *s)
{
    return sph_flow_of(sim, s) ? (1u << SPH_DIM) - 1 : sph_held(sim, s);
}
/* whether sums are of rates in the middle of the step; whether they are of rates, of forces: of both, where an
   integrator has one sweep for them */
SPH_INLINE bool sph_in_middle(const sph_sim *sim) { return SPH_HAS_RATES_FIRST && sim->middle; }
SPH_INLINE bool sph_sums_rates(const sph_sim *sim)
{
    return !SPH_HAS_RATES_FIRST || sim->middle || !sim->stage->middle;
}
/* whether this stage sums nothing but density */
SPH_INLINE bool sph_keeps_fields(const sph_sim *sim)
{
    return SPH_WITH_SUMMATION && SPH_HAS_RUNGE_KUTTA && sim->stage->keeps;
}
SPH_INLINE bool sph_sums_forces(const sph_sim *sim) { return !sph_in_middle(sim); }

/* a step's work from the powers of the step before and of this: by the trapezoidal rule, where a step's are those of
   its end; Runge-Kutta's are those of its middle */
SPH_INLINE double sph_work_of(const sph_sim *sim, double before, double power)
{
    const bool middle = SPH_HAS_RUNGE_KUTTA && sim->stage->at < 1;
    return middle ? sim->dt * power : 0.5 * sim->dt * (before + power);
}

/* whether the density is made anew in the step under way: every so many steps, or when a period has passed */
SPH_INLINE bool sph_filters_now(const sph_sim *sim)
{
    const sph_config *const c = &sim->cfg;
    if (!sph_filters(c) || !sim->next.step)
        return false;
    const bool turn = c->shepard_every && sim->next.step % c->shepard_every == 0;
    return turn || (c->filter_period > 0 && (uint64_t)(sim->next.time / c->filter_period) >
                                                (uint64_t)(sim->now.time / c->filter_period));
}

/* displacement of a group, quanta; the shorter way round a periodic axis, of one that is less than 3/2 of it long; and
   how far a group goes in this step until the stage's moment */
SPH_INLINE sph_pos sph_wall_moved(const sph_sim *sim, const sph_set *s, uint32_t axis)
{
    return SPH_HAS_GROUPS ? sim->next.group[s->group].moved[axis] : 0;
}
SPH_INLINE int64_t sph_round_domain(const sph_sim *sim, uint32_t axis, int64_t d)
{
    const int64_t whole = sim->grid.extent[axis];
    if (!SPH_IS(sim->cfg.face[axis][0], PERIODIC))
        return d;
    return 2 * d > whole ? d - whole : 2 * d < -whole ? d + whole : d;
}
SPH_INLINE int64_t sph_wall_step(const sph_sim *sim, const sph_set *s, uint32_t axis)
{
    const int64_t to = sph_wall_moved(sim, s, axis);
    return SPH_HAS_GROUPS ? sph_round_domain(sim, axis, to - sim->now.group[s->group].moved[axis]) : 0;
}
/* its velocity: in the middle of a step that by which it goes from the step's beginning to its end */
SPH_INLINE double sph_wall_velocity(const sph_sim *sim, const sph_set *s, uint32_t axis)
{
    if (SPH_HAS_GROUPS && sph_in_middle(sim))
        return (double)sph_wall_step(sim, s, axis) * sim->grid.quantum / sim->dt;
    return SPH_HAS_GROUPS ? sim->next.group[s->group].vel[axis] : 0;
}

/* cell of a position along axis k; the position must be inside the domain */
SPH_INLINE uint32_t sph_cell_axis(const sph_sim *sim, uint32_t k, sph_pos q)
{
    const uint64_t units = (uint32_t)(q >> SPH_POS_SHIFT);
    return (uint32_t)(units * sim->grid.cell_mul[k] >> 32) >> sim->grid.cell_shift[k];
}
SPH_INLINE uint32_t sph_cell_of(const sph_sim *sim, const sph_pos *q)
{
    uint32_t c = 0;
    for (uint32_t k = SPH_DIM; k-- > 0;)
        c = c * sim->grid.ncell[k] + sph_cell_axis(sim, k, q[k]);
    return c;
}

/* the first of the cells c .. end - 1 that stands in a strip of which that much is true; end: none does */
SPH_INLINE uint32_t sph_skip(const sph_sim *sim, uint32_t c, uint32_t end, uint8_t what)
{
    if (!SPH_STRIPS || c >= end || sim->strip[c / SPH_STRIP] & what)
        return c;
    uint32_t s = c / SPH_STRIP;
    const uint32_t last = (end - 1) / SPH_STRIP;
    for (uint64_t eight; s <= last; s += 8) {
        memcpy(&eight, sim->strip + s, sizeof eight);
        if (eight & what * (uint64_t)0x0101010101010101)
            break;
    }
    while (s <= last && !(sim->strip[s] & what))
        s++;
    return s <= last ? s * SPH_STRIP : end;
}
/* the end of a cell's strip, or of the cells that are asked for */
SPH_INLINE uint32_t sph_strip_end(uint32_t c, uint32_t end)
{
    const uint32_t e = (c / SPH_STRIP + 1) * SPH_STRIP;
    return SPH_STRIPS && e < end ? e : end;
}

#endif
