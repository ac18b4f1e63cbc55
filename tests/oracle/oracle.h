/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* oracle.h: a second, naive way to all that the kernel computes, to compare the kernel with. Plain C, double precision,
   every pair looked at, images as explicit copies of particles. Written from the equations (sph.h and the sources named
   at the head of each file) and not from the kernel, of which nothing is included but the public header.

   A scene is a list of particles and the constants of their sets. Every quantity that is compared is an o_sum: its
   value, and the sum of the magnitudes of what it was added up from, which is the scale of its rounding errors. All
   vectors and tensors have three components; those that the dimension has not are 0, but for the stress out of the
   plane. */
#ifndef ORACLE_H
#define ORACLE_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "sph/sph.h"

#define O_PI 3.14159265358979323846
#define O_MAX_FLAWS 20 /* of a particle */
#define O_MAX_STANDING 512 /* particles taken away in one step */

/* ---- values with their scale ---- */

typedef struct o_sum {
    double v, s;
} o_sum;
static inline void o_add(o_sum *a, double term, double magnitude)
{
    a->v += term;
    a->s += magnitude;
}
static inline void o_plus(o_sum *a, double term) { o_add(a, term, fabs(term)); }

/* ---- a scene ---- */

enum { O_NO_FLOW, O_INFLOW, O_OUTFLOW };

typedef struct o_set {
    uint32_t role, kind, eos; /* SPH_ROLE_..., SPH_WALL_..., SPH_TAIT ... */
    bool compressible, no_slip;
    uint32_t side;                            /* SPH_BOTH_SIDES ... */
    double half[2];                           /* m: of walls, to both sides of the middle of the face, along tangents */
    double mass, rho0, c0, strength;          /* kg, kg/m^3, m/s; of walls as in sph_wall */
    double origin[3], normal[3], tangent[3];  /* of walls: a point of the face (m), into the fluid, along the face */
    double start[3], accel[3];                /* motion v t + a t^2/2 of what moves as it is told */
    const sph_table *table;                   /* or by this, linear between rows and at rest before and after them */
    double velocity[3], moved[3];             /* m/s, m: its velocity and displacement now */
    double once[3], twice[3], push[3];        /* m/s, its velocity filtered; m/s^2, the acceleration of Adami's walls */
    double shear, yield, hardening, crack;    /* Pa, Pa, Pa, 1/s */
    uint32_t body, held;
    bool flat;
    bool region;                              /* of walls: whether there is one behind the face, */
    double thick;                             /* so thick, m */
    uint32_t flow, axis, fluid;               /* O_INFLOW ...: of the water `fluid` along an axis, */
    bool up;                                  /* towards larger x, */
    double lo[3], hi[3], face, end;           /* m: its box, the face to the water, the opposite one */
} o_set;

typedef struct o_particle {
    uint32_t id, set;
    bool image;
    bool gone;                 /* left, or was removed: as if it had never been */
    /* state */
    double x[3], v[3], d;      /* m, m/s, (rho - rho0)/rho0 */
    double stood[3];           /* place without what mirrors make of it */
    double rest[3];            /* reference position (m) */
    double home[3];            /* of what moves as it is told: its place at displacement 0 */
    double dev[3][3];          /* deviatoric stress, Pa, without damage */
    double u;                  /* energy, J/kg */
    double plastic, root;      /* equivalent plastic strain, D^(1/SPH_DIM) */
    /* what follows from the state alone */
    double rho, p, c;          /* kg/m^3, Pa (after the floor), c0 of its set */
    double sigma[3][3];        /* stress after damage, Pa */
    double normal[3];          /* of a wall's face, as the image shows it */
    double origin[3], tangent[3];
    double wall[3];            /* velocity that a wall is told, m/s */
    double seen[3];            /* velocity that viscosity sees of a wall */
    /* what sums over neighbours give before the forces */
    double smooth[3];          /* xsph velocity that strain rates see, m/s */
    double inverse[3][3];      /* of the gradient's M (solids), N or B (fluids) */
    double inverse_scale;      /* magnitude that rounding errors of the inverse are relative to */
    double t[3][3];            /* T of a stress (solids) or p N/rho (Bonet & Lok) */
    double t_scale;
    double steep[3], steep_scale; /* renormalised gradient of density, kg/m^4 */
    bool upside_down;          /* an image in a face across which gravity pulls */
    double shear[3][3];        /* T of the viscous stress of fluids */
    double shear_scale, eddy, eddy_scale; /* of T; what the Courant limit sees as |mu|, and how well it is known */
    double pull[3][3];         /* artificial stress R */
    double cover;              /* Q of the quadrature weights */
    o_sum phi;                 /* the weight; 0: 1 */
    /* forms.c. Stabilised: S and D of the first forces, level, row - mean, col/V, axes in tension; normalised: N in
       mapped, q in slant; hourglass: F, k; the others are scales */
    double fill, slant[3], row[3], drawn[3], row_scale, drawn_scale, mapped[3][3], deform[3][3], stiff, deform_scale;
    int level;
    bool on[3];
    double lost;               /* J, what damping by a rate took before the sort */
    double quiet;              /* Pa, pressure of the damper */
    double way[3];             /* how its place moves: v + xsph, m/s */
    double beside[3];          /* xsph alone */
    /* flow.c: velocity and density that a flow holds; the set from the sort on; by whom it was born in this step */
    double held_v[3], held_d;
    uint32_t becomes, parent;
    bool born;
    o_sum middle_rate;         /* d(rho)/dt in the middle of the step */
    /* results */
    o_sum density;             /* relative excess: summed, filtered, or of a wall */
    o_sum wall_v[3];           /* of an Adami wall without slip */
    o_sum a[3], rate, stress_rate[3][3], drift[3];
    o_sum moved_rate;          /* of summed density: how fast the sum changes as places move */
    o_sum unseen_rate;         /* the part of it by which places move otherwise than pairs see: in no power (sph.h) */
    o_sum diffused;            /* d(rho)/dt by diffusion */
    o_sum warmed;              /* du/dt, W/kg */
    o_sum viscous, worked, pushed; /* powers for the books, W/kg */
    o_sum gradient[3][3];      /* sum m_j v_ij (x) K g (weak: m_j/rho_j), of which L is made */
    o_sum disorder[3], filling; /* shifting: minus the slope of disorder (1/m), cover less 1; 0 where it acts not */
    double mu, mu_at_edge;     /* largest |mu| of its pairs; of those that rounding may take for none */
} o_particle;

typedef struct o_scene {
    sph_config cfg;
    o_set set[SPH_MAX_SETS];
    uint32_t sets;
    double support, time;
    uint32_t n, m;             /* particles; with their images */
    o_particle *own;           /* n */
    o_particle *all;           /* m: the particles and then the images */
    uint32_t room;
    double fastest;            /* m/s: of the bodies, when the last forces were made */
    o_sum quieted, slowed, evened; /* J, what damper, damping by a rate and XSPH in the velocity took, likewise */
    o_sum shifted;             /* J, what shifting took since o_begin_steps */
    uint32_t left, crossed, put_back; /* particles since o_begin_steps, and their energies, J */
    o_sum carried_off, put_back_loss;
    /* likewise; let_out: of those who left, through outflows; power of walls when the last forces were made, W */
    o_sum removed_mass, added_mass, fed, wall_work, wall_power;
    uint32_t let_out, next_id; /* next_id: the last that was given */
    uint32_t needed;           /* particles, of a step that fails for want of room */
    uint32_t standing, stands[O_MAX_STANDING]; /* ids of those who were taken away at the end of the last step */
    bool rates_of_middle;      /* that flows are held against */
    bool shaken;               /* filters are off by a rounding of rho0, as the kernel's (condition.c) */
    const char *undecided;     /* a choice that rounding decides (a pair exactly at a kernel's edge ...), or null */
} o_scene;

static inline bool o_is_body(const o_scene *s, const o_particle *p)
{
    return s->set[p->set].role == SPH_ROLE_FLUID || s->set[p->set].role == SPH_ROLE_SOLID;
}
static inline bool o_is_solid(const o_scene *s, const o_particle *p) { return s->set[p->set].role == SPH_ROLE_SOLID; }
static inline bool o_is_ghost(const o_scene *s, const o_particle *p) { return s->set[p->set].role == SPH_ROLE_GHOST; }
/* fluid or solid both, with the same rest density, sound speed and equation of state */
static inline bool o_same_material(const o_scene *s, const o_particle *a, const o_particle *b)
{
    const o_set *x = &s->set[a->set], *y = &s->set[b->set];
    return x->role == y->role && x->eos == y->eos && !(x->rho0 < y->rho0) && !(y->rho0 < x->rho0) &&
           !(x->c0 < y->c0) && !(y->c0 < x->c0);
}
static inline bool o_is_weak(const o_scene *s)
{
    return s->cfg.scheme == SPH_WEAK || s->cfg.scheme == SPH_DIRECT || s->cfg.scheme == SPH_WEAK_WICK;
}
static inline bool o_has_solids(const o_scene *s) { return s->cfg.solid != SPH_NO_SOLID; }
static inline bool o_corrects(const o_scene *s) { return s->cfg.solid == SPH_CORRECTED || s->cfg.solid == SPH_TOTAL; }
static inline double o_phi(const o_particle *p) { return p->phi.v > 0 ? p->phi.v : 1; }
static inline double o_dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static inline double o_max(double a, double b) { return a > b ? a : b; }
static inline double o_min(double a, double b) { return a < b ? a : b; }
/* notes that rounding decides between two ways if x and y, of this scale, are as good as equal */
static inline void o_close(o_scene *s, const char *what, double x, double y, double scale)
{
    if (fabs(x - y) <= (SPH_DOUBLE ? 1e-9 : 1e-4) * scale)
        s->undecided = what;
}

/* ---- weights.c: smoothing kernels ---- */
double o_weight(uint32_t kernel, double r, double h);       /* W, 1/m^DIM */
double o_weight_slope(uint32_t kernel, double r, double h); /* dW/dr */
double o_weight_support(uint32_t kernel);                   /* in units of h */

/* ---- width.c: smoothing lengths, m ---- */
double o_own_h(const o_scene *s, const o_particle *p);
double o_pair_h(const o_scene *s, const o_particle *i, const o_particle *j);
double o_least_h(const o_scene *s); /* that a particle may have */

/* ---- states.c: equations of state ---- */
double o_pressure(uint32_t eos, double rho0, double c0, double d);         /* Pa, without floor */
double o_energy(uint32_t eos, double rho0, double c0, double d, bool floor); /* J/kg: integral of p/rho^2 d rho */
double o_excess_at(uint32_t eos, double rho0, double c0, double p);        /* the excess at a pressure */
double o_sound(uint32_t eos, double c0);                                   /* its true sound speed at rest */
void o_refresh(o_scene *s); /* rho, p, sigma of every particle from d, dev, damage */

/* ---- images.c: copies behind periodic and mirror faces ---- */
void o_copies(o_scene *s); /* makes s->all out of s->own */

/* ---- pairs.c: what two particles are to each other ---- */
typedef struct o_pair {
    double x[3], v[3], r;     /* x_ij, v_ij, |x_ij| */
    double k[3], q;           /* K, the vector that the kernel sees, and its length */
    double g, w;              /* (dW/dr)/|K|, W at |K|; g is 0 at |K| = 0 */
    double slope, value;      /* magnitudes of grad W and W for the scale of errors */
    bool apart, bond;         /* of two bodies; of one body, seen in the reference position */
    bool edge;                /* so near to the support's end, from within or without, that rounding decides */
    double volume;            /* m_j/rho_j */
    double h;                 /* m, smoothing length of the pair */
} o_pair;
bool o_pair_of(o_scene *s, const o_particle *i, const o_particle *j, o_pair *p); /* false: beyond the support */

bool o_acts_on(o_scene *s, const o_particle *wall, const o_particle *body); /* sides.c: true for other pairs */

/* ---- the modules, one file each; what each computes is at its head ---- */
void o_sum_density(o_scene *s);                /* density.c */
void o_sum_rates(o_scene *s);
void o_filter_density(o_scene *s);
void o_adami(o_scene *s);                      /* adami.c */
void o_smooth(o_scene *s);                     /* xsph.c */
void o_drift(o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);
void o_correct(o_scene *s);                    /* gradient.c: M, N, B and their inverses */
void o_gradient_vector(const o_scene *s, const o_particle *i, const o_particle *j, const o_pair *p, double *k,
                       double *scale);         /* RENORMALISED: B_ij x_ij, else x_ij */
void o_weigh(o_scene *s);                      /* quadrature.c: phi */
void o_continuity(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);  /* fluid.c */
void o_pressure_force(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);
void o_viscosity(o_scene *s, o_particle *i, const o_particle *j, const o_pair *p); /* viscosity.c */
/* the relative velocity that viscosity sees; false: none, a wall with free slip */
bool o_sheared_velocity(const o_scene *s, const o_particle *i, const o_particle *j, const o_pair *p, double *v);
void o_make_shear(o_scene *s);                                                            /* shear.c */
void o_shear_force(o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);
bool o_is_gas(const o_scene *s, const o_particle *p);                                      /* energy.c */
void o_gas_state(const o_scene *s, o_particle *p);
void o_warm(const o_scene *s, o_particle *i);
double o_sound_as_mu(const o_scene *s, const o_particle *p);
void o_diffusion(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);   /* diffusion.c */
/* density_gradient.c: before the forces; whether density diffuses between two */
void o_find_slopes(o_scene *s);
bool o_diffuses_into(const o_scene *s, const o_particle *i, const o_particle *j);
void o_boundary(o_scene *s, o_particle *i, const o_particle *j);                           /* boundary.c */
bool o_make_forms(o_scene *s);                                                             /* forms.c */
bool o_normalises(const o_scene *s);
double o_normalised_gradient(const o_scene *s, const o_particle *i, const o_pair *p, double *grad);
double o_stabilised_gradient(const o_scene *s, const o_particle *i, const o_particle *j, const o_pair *p,
                             double (*grad)[3]);
void o_hourglass(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);
/* gradient.c: the inverse of a sum of x (x) grad W, or 1 where it is singular; its scale */
bool o_is_singular(const double (*e)[3]);
double o_inverse(o_scene *s, const double (*e)[3], double terms, double (*inv)[3]);
void o_stresses(o_scene *s);                                                               /* stress.c */
void o_stress_force(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);
void o_strain_rates(const o_scene *s, o_particle *i);
double o_velocity_gradient(const o_scene *s, const o_particle *i, double (*l)[3]); /* L, and its scale */
uint32_t o_edge_mark(uint32_t id, double *normal);   /* edges.c: layer that a plan puts a solid particle into */
void o_edges(const o_scene *s, o_particle *i);       /* P, M, H */
void o_contact(const o_scene *s, o_particle *i, const o_particle *j, const o_pair *p);     /* contact.c */
void o_tensile_part(o_scene *s, const double (*sigma)[3], bool principal, double (*r)[3]); /* principal.c */
double o_largest_principal(const double (*sigma)[3], bool plane);
void o_yield(o_scene *s);                                                                  /* yield.c */
void o_yield_from(const o_scene *s, o_particle *p, const double (*from)[3]); /* that went from there to p->dev */
double o_grown_root(o_scene *s, const o_particle *i, const float *flaw, uint32_t flaws, double dt); /* damage.c */
double o_sponge(const o_scene *s, const o_particle *i);                                    /* sponge.c: S */
void o_quiet(const o_scene *s, o_particle *i, double rate); /* damper.c; rate: of the excess, 1/s */
void o_book_quiet(o_scene *s, const o_particle *i, double middle, double dt);
void o_slow_first(o_scene *s, double dt, double last);
void o_slow_last(o_scene *s, double dt);
void o_even(o_scene *s);
bool o_drifts(const o_scene *s);               /* whether positions go with XSPH's velocity */
void o_find_disorder(o_scene *s);              /* shifting.c */
void o_shift(o_scene *s, double dt);
void o_turn_round(o_particle *p, int k, double plane, bool tensors); /* steps.c: a mirror across axis k at `plane` */
bool o_is_carried(const o_scene *s, const o_particle *p); /* flow.c: by an inflow or outflow */
bool o_open_flows(o_scene *s);                 /* at a step's beginning; false: no room */
void o_straighten(o_scene *s);
void o_note_held(o_scene *s);
void o_change_sets(o_scene *s);
void o_carry_along(o_particle *i, o_sum rate);
void o_let_out(o_scene *s);
void o_forces(o_scene *s);                     /* forces.c: everything before and in the force evaluation */

/* a pair gives the home's acceleration `part` (m/s^2) with a scale; books.c keeps the powers of walls */
void o_push(const o_scene *s, o_particle *i, const o_particle *j, const double *part, double scale);

/* ---- steps.c: whole steps ---- */
void o_told(const o_set *set, double t, double *x, double *v); /* what moves as it is told: m, m/s at time t */
void o_begin_steps(o_scene *s, uint32_t room); /* forgets rates of steps before; of at most `room` particles */
bool o_step(o_scene *s, uint32_t number, double dt, uint32_t (*flaws_of)(uint32_t id, float *threshold));

/* ---- condition.c ---- */
typedef struct o_spread { /* what comes of an error at the beginning; infinite: anything */
    double x, v, d, dev, plastic, root, shifted, quieted, slowed, evened, worked;
} o_spread;
void o_keep(o_scene *kept, const o_scene *s); /* a copy without images, in memory of its own */
o_spread o_find_spread(const o_scene *start, const o_scene *end, uint32_t steps, double dt,
                       uint32_t (*flaws_of)(uint32_t id, float *threshold));
double o_shake(const o_scene *s); /* of a filtered density: what rounding may make of it; 0 if it is not shaken */

/* ---- bed.c: particles of a wall along a polyline, with what is told of their piece or corner ---- */
typedef struct o_bed_particle {
    double x[2], normal[2], origin[2], half; /* m, -, m, m: of the face: its middle and half its length */
    bool region, found;
} o_bed_particle;
/* layers 0: a row that stands on the wall; thick: of the faces, m; returns how many */
uint32_t o_lay_bed(o_scene *s, const double (*p)[2], uint32_t n, uint32_t layers, double thick, o_bed_particle *out);

/* ---- crossing.c ---- */
void o_cross(o_scene *s); /* who is in a wall: removed, or put back */

/* ---- limits.c ---- */
typedef struct o_limits {
    double courant, viscous, force, gravity, diffusion; /* s, 0: none */
    double courant_scale;
    bool courant_undecided; /* the largest |mu| is of a pair that rounding may take for none */
} o_limits;
o_limits o_find_limits(const o_scene *s);
double o_courant_number(const sph_config *c); /* cfl, or what the integrator stands */

/* ---- books.c ---- */
typedef struct o_totals {
    o_sum mass, momentum[3], angular[3], kinetic, potential, internal, elastic, plastic;
    o_sum dissipated, worked, diffused, pushed; /* W */
    o_sum rise; /* d(kinetic + potential + internal + elastic)/dt, W, from the accelerations and rates */
} o_totals;
o_totals o_find_totals(const o_scene *s);
double o_energy_of(const o_scene *s, const o_particle *p); /* all that a body has, J */
bool o_loses(const o_scene *s); /* whether a form of the equations does not conserve energy pair by pair */
double o_diffused_per_rate(const o_scene *s, const o_particle *p); /* -p/rho^2 of the pressure that acts */

/* ---- probe.c ---- */
typedef struct o_probe_value {
    o_sum cover, rho, p, v[3];
} o_probe_value;
o_probe_value o_probe(o_scene *s, const double *x);

#endif
