/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* internal.h: the simulation's own data, and which file does what.

   layout.c   configuration checks, the one layout function, init, usage
   setup.c    sets, particles, boxes, initial fields, equations of state; layers.c walls as rows or layers of particles
   shapes.c   rings, polygons, shapes with holes, on square and face-centred lattices
   fields.c   the list of state fields as a table; threads.c what threads see in a pass: failures, peaks, work
   sort.c     orders particles by (cell, id): the start of every stage; move.c where they go, faces.c the domain's faces
   carry.c    the other fields' way through a step; settle.c its end
   sweep.c    the one neighbour sweep: candidates of a cell go into tiles, sums come out
   fluid.c    pair formulas of water: density, momentum, viscosity, diffusion, XSPH, filters
   solid.c    stress: rates, corrected gradients; solid.h its pair formulas; yield.c; damage.c flaws and damage
   walls.c    boundary forces, Adami's extrapolation; groups.c walls that move; crossing.c particles inside walls
   kick.h, runge_kutta.h  velocities and densities in each integrator; powers.c work and dissipation
   integrators.c  lists of passes, local passes; run.c runs them: slices, threads, failure; limits.c the time step
   books.c    totals, probes, gauges; hash.c state hash; dump.c dump and restore
   kernels.c  smoothing kernels; dmath.c deterministic functions; lanes.h vectors

   Arrays: a state buffer holds what one moment of the scene is made of. A step reads buffer `cur`, writes another,
   and commits by changing `cur`: that is how a failed step leaves the state as it was. */
#ifndef SPH_INTERNAL_H
#define SPH_INTERNAL_H

#include "fields.h"
#include "lanes.h"
#include "sph.h"

#define SPH_PAD 48u       /* elements that may be read past an array's end by a vector */
#define SPH_POWERS 4u     /* kept in the books: viscous, wall, diffusion, body force */
#define SPH_PARTIALS (SPH_POWERS + 1u) /* sums of a chunk for the books: those, and energy given to held sets (J) */
#define SPH_DEAD 255u     /* set of a particle that is gone and will be dropped by the next sort */
/* a sum of squares above this counts as not finite: a float has room for a factor of 1e8 beyond */
#define SPH_LIMIT_SQUARE ((sph_real)1e30)
#define SPH_CANDIDATE_CELLS (SPH_DIM == 1 ? 3 : SPH_DIM == 2 ? 9 : 27)

/* one particle set: constants that its particles share */
typedef struct sph_set {
    uint32_t role, kind, group; /* group: SPH_MAX_GROUPS if it moves by forces alone */
    bool compressible, no_slip, corner;
    uint8_t eos;
    double mass, rho0, c0;
    double strength;
    double origin[SPH_DIM];     /* middle of the wall's face at displacement 0, from the domain's low corner (m) */
    double normal[SPH_DIM];     /* into the fluid */
    double tangent[SPH_DIM];    /* 3-D: one of the two in-plane directions */
    double half[2], thick;      /* wall region behind the face: half extents along tangents, depth (m) */
    sph_pos low[SPH_DIM], high[SPH_DIM]; /* box around that region, quanta, at displacement 0 */
    sph_real mass_r, rho0_r, inv_rho0_r, b_r; /* what the sweep reads; b: pressure scale of the equation of state */
} sph_set;

/* what a set of solid has besides */
typedef struct sph_material {
    double shear, yield, hardening, crack_rate; /* Pa; crack_rate: crack speed over flaw radius, 1/s */
    sph_real shear_r;
    uint32_t body, held; /* held: bits 1 << axis */
} sph_material;

/* wall sets that move or vanish together */
typedef struct sph_group {
    sph_motion motion;
    void *ctx;
} sph_group;
/* where a group is now */
typedef struct sph_group_state {
    double remove_at;           /* s; infinite: never */
    double vel[SPH_DIM];        /* m/s */
    sph_pos moved[SPH_DIM];     /* displacement, quanta */
    uint32_t removed;
} sph_group_state;

/* largest values of the latest force sweep: what the step limits are made of */
typedef struct sph_peaks {
    sph_real mu, acc, speed;
} sph_peaks;

/* constants of the pair formulas (fluid.c) */
typedef struct sph_factors {
    sph_real inv_h, eta, reach, reach2, slope, value;
    sph_real inv_wdx, repulsion; /* artificial stress: 1/(W(dx) without its scale), epsilon */
    sph_real contact;            /* of two bodies: T_i + T_j where W is twice W(dx) */
    sph_real av_alpha, av_beta, morris, diff, hydro[SPH_DIM], gravity[SPH_DIM], small_p;
    bool rate_by_density, continuity, extras;
} sph_factors;

/* everything of the state that is not an array; copied whole when a step commits */
typedef struct sph_scalars {
    double time, dt_last;
    uint64_t step;
    uint32_t count, left, crossed, put_back, reflected;
    bool primed, started; /* first forces known; first step done (leap-frog) */
    sph_peaks peaks;
    double work[SPH_POWERS]; /* J, their integrals */
    double removed_mass;     /* kg */
    double power[SPH_POWERS]; /* W, at the end of the latest step: viscous, wall, diffusion, body */
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
    uint32_t cell_mul[SPH_DIM];      /* cell index = (position * mul) >> 32 after a shift */
    uint32_t pos_shift;
} sph_grid;

struct sph_thread; /* per-thread scratch: sweep.h */

typedef struct sph_pass sph_pass;
/* What a stage of an integrator does to the particles at its sort, as shares of dt (bend: of dt^2):
   displacement = drift (v + drift velocity) + bend a, v' = v + kick a, what evolves + rate d/dt. */
typedef struct sph_stage {
    sph_real drift, bend, kick, rate;
    bool damps;    /* v' is multiplied by cfg.damping */
    bool reflects; /* particles that a mirror face turned are counted: not where the whole step will count them */
    bool middle;   /* its sums are of positions at the step's end and velocities of its middle */
} sph_stage;
struct sph_integrator; /* integrators.h */

#define SPH_MAX_RANGES 64u
#define SPH_MAX_PROGRAM 48u

struct sph_sim {
    uint64_t magic;
    sph_config cfg;
    sph_grid grid;
    double courant; /* cfl, or less where the integrator does not stand it */
    sph_factors fac;
    /* arrays */
    sph_buffer buf[3];
    uint32_t buffers, cur, src, dst; /* current state; source and target of the stage under way */
    uint32_t src_count;              /* particles in src */
    const sph_stage *stage;          /* the one under way */
    const struct sph_integrator *integrator; /* whose list of passes runs */
    bool src_table;                  /* cell[] belongs to src, so its slabs are known */
    uint32_t *cell;                  /* cells + 1 starts */
    uint32_t *slab;                  /* starts of the slabs in the source buffer */
    sph_real *tmp;                   /* filtered density */
    sph_real *corr[SPH_NL];          /* M^-1 of a particle of the destination buffer (solid.c) */
    uint32_t *flaw_start;            /* by id: its flaws are flaw[flaw_start[id] .. flaw_start[id + 1]) */
    float *flaw;                     /* thresholds */
    uint32_t flaws;
    sph_real *power[4];              /* viscous, wall, diffusion, body-force power of a particle (books) */
    double *partial;                 /* SPH_PARTIALS sums a chunk (books) */
    uint32_t partials;
    struct sph_thread *thread;
    size_t arena_bytes, arena_used;
    /* sets */
    sph_set *set;     /* SPH_MAX_SETS of them, in the arena like everything large */
    sph_material *material;                  /* as many, in scenes with solids */
    struct sph_solid_scratch *solid_scratch; /* of each thread, in scenes with solids */
    sph_group *group; /* SPH_MAX_GROUPS */
    uint32_t sets, groups;
    uint64_t setup_hash;
    bool has_adami, has_force_wall;
    /* state */
    sph_scalars now, next; /* next: being made by the step under way */
    bool table_valid;      /* cell[] belongs to buffer cur */
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
     SPH_WITH_ISOTHERMAL << SPH_ISOTHERMAL)
#define SPH_VISCOSITIES_IN                                                                                  \
    (1 << SPH_INVISCID | SPH_WITH_ARTIFICIAL << SPH_ARTIFICIAL |                                            \
     SPH_WITH_ARTIFICIAL_APPROACHING << SPH_ARTIFICIAL_APPROACHING | SPH_WITH_MORRIS << SPH_MORRIS)
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
     SPH_HAS_TOTAL << SPH_TOTAL)
#define SPH_YIELDS_IN (1 << SPH_NO_YIELD | SPH_HAS_YIELD << SPH_VON_MISES | SPH_HAS_YIELD << SPH_VON_MISES_GRAY)
#define SPH_DAMAGES_IN (1 << SPH_NO_DAMAGE | SPH_HAS_DAMAGE << SPH_BENZ_ASPHAUG | SPH_HAS_DAMAGE << SPH_BENZ_ASPHAUG_GRAY)
#define SPH_REPULSIONS_IN                                                                                   \
    (1 << SPH_NO_ARTIFICIAL_STRESS | SPH_HAS_REPULSION << SPH_PRINCIPAL | SPH_HAS_REPULSION << SPH_COMPONENTS)

SPH_INLINE bool sph_in(uint32_t mask, uint32_t choice) { return choice < 32 && mask >> choice & 1; }

/* questions about choices that fold to constants where a module is left out */
SPH_INLINE bool sph_weak_scheme(uint32_t s) { return SPH_IS(s, WEAK) || SPH_IS(s, DIRECT) || SPH_IS(s, WEAK_WICK); }
SPH_INLINE bool sph_viscous(uint32_t v)
{
    return SPH_IS(v, ARTIFICIAL) || SPH_IS(v, ARTIFICIAL_APPROACHING) || SPH_IS(v, MORRIS);
}
SPH_INLINE bool sph_diffusive(uint32_t d) { return SPH_IS(d, MOLTENI) || SPH_IS(d, HYDROSTATIC); }
SPH_INLINE bool sph_sums_density(const sph_config *c) { return SPH_IS(c->density, SUMMATION); }
SPH_INLINE bool sph_keeps_books(const sph_config *c) { return SPH_WITH_BOOKS && c->books; }
SPH_INLINE bool sph_uses_xsph(const sph_config *c) { return SPH_WITH_XSPH && c->xsph != 0; }
SPH_INLINE bool sph_filters(const sph_config *c) { return SPH_WITH_SHEPARD && c->shepard_every != 0; }

SPH_INLINE bool sph_has_solids(const sph_config *c) { return SPH_WITH_SOLID && c->solid != SPH_NO_SOLID; }
SPH_INLINE bool sph_is_total(const sph_config *c) { return SPH_HAS_TOTAL && c->solid == SPH_TOTAL; }
SPH_INLINE bool sph_corrects(const sph_config *c) { return SPH_HAS_CORRECTION && c->solid >= SPH_CORRECTED; }
SPH_INLINE bool sph_yields(const sph_config *c) { return SPH_HAS_YIELD && c->yield != SPH_NO_YIELD; }
SPH_INLINE bool sph_damages(const sph_config *c) { return SPH_HAS_DAMAGE && c->damage != SPH_NO_DAMAGE; }
SPH_INLINE bool sph_repels(const sph_config *c) { return SPH_HAS_REPULSION && c->artificial_stress != SPH_NO_ARTIFICIAL_STRESS; }
SPH_INLINE bool sph_smooths_strain(const sph_config *c) { return SPH_HAS_HAT && c->xsph_strain && sph_has_solids(c); }

/* whether a set is made of what moves by forces, not wall */
#define SPH_BODIES (1u << SPH_ROLE_FLUID | 1u << SPH_ROLE_SOLID)
SPH_INLINE bool sph_is_solid(const sph_set *s) { return SPH_WITH_SOLID && s->role == SPH_ROLE_SOLID; }
SPH_INLINE const sph_material *sph_material_of(const sph_sim *sim, const sph_set *s) { return sim->material + (s - sim->set); }
SPH_INLINE bool sph_is_body(const sph_set *s) { return s->role == SPH_ROLE_FLUID || sph_is_solid(s); }

/* ---- shared by files ---- */
#define sph_sim_magic 0x5350485f53494d31u

#define sph_error SPH_NAME(error_)
sph_status sph_error(sph_sim *sim, sph_status s, const char *what, const char *allowed, double value, uint32_t particle);
#define sph_mix SPH_NAME(mix_)
uint64_t sph_mix(uint64_t h, uint64_t v);
#define sph_mix_double SPH_NAME(mix_double_)
uint64_t sph_mix_double(uint64_t h, double v);
#define sph_hash_config SPH_NAME(hash_config_)
uint64_t sph_hash_config(const sph_config *c);
#define sph_hash_buffer SPH_NAME(hash_buffer_)
uint64_t sph_hash_buffer(const sph_sim *sim, const sph_buffer *b, uint32_t n);
#define sph_pressure SPH_NAME(pressure_)
double sph_pressure(const sph_sim *sim, const sph_set *s, double d);
#define sph_density_of SPH_NAME(density_of_)
double sph_density_of(const sph_sim *sim, const sph_set *s, double p);
#define sph_kernel_w SPH_NAME(kernel_w_)
double sph_kernel_w(const sph_sim *sim, double r);

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
SPH_INLINE uint32_t sph_source_id(const sph_sim *sim, uint32_t i) { return sim->buf[sim->src].id[0][sph_source_index(sim)[i]]; }

/* whether a wall group is gone, and how fast it moves along an axis (m/s), at the end of the step under way */
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
SPH_INLINE double sph_wall_velocity(const sph_sim *sim, const sph_set *s, uint32_t axis)
{
    return SPH_HAS_GROUPS ? sim->next.group[s->group].vel[axis] : 0;
}
/* its displacement, quanta */
SPH_INLINE sph_pos sph_wall_moved(const sph_sim *sim, const sph_set *s, uint32_t axis)
{
    return SPH_HAS_GROUPS ? sim->next.group[s->group].moved[axis] : 0;
}

/* cell of a position along axis k; the position must be inside the domain */
SPH_INLINE uint32_t sph_cell_axis(const sph_sim *sim, uint32_t k, sph_pos q)
{
    return (uint32_t)(((uint64_t)(uint32_t)(q >> sim->grid.pos_shift) * sim->grid.cell_mul[k]) >> 32);
}
SPH_INLINE uint32_t sph_cell_of(const sph_sim *sim, const sph_pos *q)
{
    uint32_t c = 0;
    for (uint32_t k = SPH_DIM; k-- > 0;)
        c = c * sim->grid.ncell[k] + sph_cell_axis(sim, k, q[k]);
    return c;
}

#endif
