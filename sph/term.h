/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* term.h: what the terms of the force loop share (forces.c): the choices of a scene, a home, a group of candidates
   near it, and the list of sums. A term is an always-inline function in its own header that begins with "not chosen:
   return"; choices are constants in the fast paths and read at run time in the general forms. The order of terms is
   part of the bits. */
#ifndef SPH_TERM_H
#define SPH_TERM_H

#include "pair.h"

/* the sums of a home, and how many rows each has; BOUNDARY is not in lanes: components of a, then power */
#define SPH_FORCE_SUMS(X)                                                                                          \
    X(DRHO, 1)                                                                                                     \
    X(MU, 1)                                                                                                       \
    X(ACC, SPH_DIM)                                                                                                \
    X(XSPH, SPH_DIM)                                                                                               \
    X(VISCOUS, 1)                                                                                                  \
    X(WALL, 1)                                                                                                     \
    X(DIFFUSED, 1)                                                                                                 \
    X(IN_WALLS, SPH_WITH_BOOKS && SPH_HAS_LAYERED_WALLS ? 1 : 0)                                                   \
    X(IN_BONDS, SPH_WITH_BOOKS && SPH_WITH_SOLID ? 1 : 0)                                                          \
    X(UNBALANCED, SPH_WITH_BOOKS ? 1 : 0)                                                                          \
    X(HEAT, SPH_WITH_ENERGY ? 1 : 0)                                                                               \
    X(BOUNDARY, 1)                                                                                                 \
    X(GRADIENT, SPH_MAX_(SPH_WITH_SOLID ? SPH_NL : 0, SPH_WITH_SHIFTING ? SPH_SHIFT_ROWS : 0))
/* without solids that room is for shifting (shift_sums.h) */
#define SPH_SHIFT_ROWS (SPH_DIM + 1 + SPH_NT + SPH_DIM) /* the last SPH_DIM: shift_pairs */
enum {
#define SPH_SUM_ENUM(name, rows) SUM_##name, SUM_##name##_LAST = SUM_##name + (rows) - 1,
    SPH_FORCE_SUMS(SPH_SUM_ENUM)
#undef SPH_SUM_ENUM
        SUM_ROWS,
    SUM_SHIFT = SUM_GRADIENT,
    SUM_COVER = SUM_SHIFT + SPH_DIM,
    SUM_SPREAD = SUM_COVER + 1,
    SUM_NEARER = SUM_SPREAD + SPH_NT
};
#define SUM_MASK(name) SPH_SUM_MASK(SUM_##name, SUM_##name##_LAST + 1 - SUM_##name)
_Static_assert(SUM_ROWS <= SPH_SUMS, "SPH_SUMS is too small");

/* what a sweep sums: rates and forces, or one of them, where an integrator takes them apart */
enum { SPH_PART_BOTH, SPH_PART_RATES, SPH_PART_FORCES };

/* What the pair formulas depend on: bytes, so that two of them can be compared as a whole. */
typedef struct sph_choice {
    uint8_t kernel, scheme, viscosity, diffusion, gradient;
    uint8_t wall;              /* of ghosts (terms read it of the pair) */
    uint8_t beta, xsph, books;
    uint8_t solid, total, hat; /* a stress tensor; reference positions; strain rates from smoothed velocities */
    uint8_t repulsion;         /* exponent of the artificial stress, 0: none */
    uint8_t loses;             /* with books: the form does not conserve energy, so what it loses is summed too */
    uint8_t summed;            /* density by summation */
    uint8_t part;              /* SPH_PART_... */
    uint8_t apart;             /* the factors are of one kind of pairs */
    uint8_t shifting;          /* the sums of shifting; 2: of close pairs, too */
    uint8_t shear;             /* a viscous stress */
    uint8_t energy;            /* the energy equation */
    uint8_t form;              /* solids: SPH_STABILISED, SPH_NORMALISED (or corrected), else 0 */
    uint8_t hourglass;         /* control of hourglass modes */
    uint8_t edge;              /* edges that want the velocity gradient with the forces */
    uint8_t varies;            /* a smoothing length of each particle */
} sph_choice;
_Static_assert(sizeof(sph_choice) == 24, "sph_choice is compared as three words (forces.c)");
SPH_INLINE bool sph_takes_rates(const sph_choice *c) { return !SPH_HAS_RATES_FIRST || c->part != SPH_PART_FORCES; }
SPH_INLINE bool sph_takes_forces(const sph_choice *c) { return !SPH_HAS_RATES_FIRST || c->part != SPH_PART_RATES; }
/* whether the rate of density is summed without rho_i, by which it is multiplied in the end */
SPH_INLINE bool sph_rate_by_density(uint32_t scheme, uint32_t gradient)
{
    return sph_weak_scheme(scheme) || SPH_IS(gradient, BONET_LOK);
}
SPH_INLINE bool sph_stabilised(const sph_choice *c) { return SPH_HAS_STABILISED && c->form == SPH_STABILISED; }
SPH_INLINE bool sph_normalised(const sph_choice *c) { return SPH_HAS_NORMALISED && c->form == SPH_NORMALISED; }
/* for sph_sweep.needs_inv_rho */
SPH_INLINE uint32_t sph_needs_inv_rho(const sph_choice *c)
{
    if (sph_weak_scheme(c->scheme) || sph_normalised(c))
        return true;
    return sph_diffusive(c->diffusion) || (SPH_WITH_SHIFTING && c->shifting) ? SPH_BOUNDED : false;
}

/* what a home particle brings to each pair, spread over the lanes once */
typedef struct sph_home {
    vreal x[SPH_DIM], v[SPH_DIM], rho, press, inv_rho;
} sph_home;

/* a group of candidates as the home sees them; x_ij, v_ij, and what the terms find */
typedef struct sph_near {
    const sph_near_tile *tile;
    uint32_t j;
    bool wall;                                   /* the candidates are ghosts */
    vreal dx[SPH_DIM], kx[SPH_DIM], dv[SPH_DIM]; /* x_ij, K, v_ij */
    vreal ex[SPH_DIM];                           /* along which `force` pushes */
    vint apart;                                  /* of two bodies: no stress between them */
    vreal r2, q, mg, vr;                         /* |x_ij|^2, |K|/h, m_j g, v_ij . x_ij */
    vreal vc, ve;                                /* v_ij . x_ij as continuity takes it; v_ij . ex */
    vreal rho, press, inv_rho;
    vreal wide, narrow;                          /* h_ij/h and h/h_ij, where h varies (varying.h) */
    vreal inv;                                   /* 1/((r^2 + eta)(rho_i + rho_j)) */
    vreal force;                                 /* a_i -= force ex */
    vreal dw[SPH_DIM], fm, visc;                 /* what viscosity sees as v_ij; Morris: a_i += fm dw; Pi m_j g */
    vreal diff;                                  /* density diffusion */
    vreal push[SPH_DIM], gain;                   /* books: what pressure or stress pushes with, as force ex does; what
                                                    the home's own energy gains by the velocity gradient */
} sph_near;

/* The velocity along `push` at which a pair in matter is asked what it does to the energy: relative, by half, because
   each of the two asks (`relative`: v_ij . push); where the partner does not push back alike, the home's own. Heat of
   the energy equation is always half of the relative: never negative. */
SPH_INLINE vreal sph_pair_share(const sph_choice *c, const sph_home *h, const sph_near *p, const vreal *push,
                                vreal relative)
{
    (void)p;
    return c->loses && !(SPH_WITH_ENERGY && c->energy) ? sph_dot(push, h->v) : relative * (sph_real)0.5;
}

/* With the energy equation, the heat that viscosity makes in the home (energy.h): half of what it takes on the relative
   velocity that it sees */
SPH_INLINE vreal sph_pair_heat(const sph_choice *c, const sph_near *p)
{
    const vreal taken = SPH_IS(c->viscosity, MORRIS) ? p->fm * sph_dot(p->dw, p->dw) : p->visc * sph_dot(p->ex, p->dw);
    return taken * (sph_real)-0.5;
}

SPH_INLINE sph_home sph_spread_home(const sph_home_tile *t, uint32_t h)
{
    sph_home o;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        o.x[k] = v_set(t->x[k][h]);
        o.v[k] = v_set(t->v[k][h]);
    }
    o.rho = v_set(t->rho[h]);
    o.press = v_set(t->press[h]);
    o.inv_rho = v_set(t->inv_rho[h]);
    return o;
}

#endif
