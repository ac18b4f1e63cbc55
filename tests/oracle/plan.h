/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* plan.h: a small scene as a list of choices, drawn from a seed (plan.c), that can be made smaller (shrink.c); and what
   the kernel says of it (look.c), to hold against the oracle (compare.c). */
#ifndef ORACLE_PLAN_H
#define ORACLE_PLAN_H

#include "oracle.h"

enum { PLAN_POINTS = 64, PLAN_SETS = 3, PLAN_WALLS = 2, PLAN_PROBES = 6, PLAN_ROWS = 4, PLAN_FLOWS = 2,
       PLAN_BED = 5 };

/* a step of nearly no time, in spacings over the sound speed */
#define PLAN_STILL 1e-10

typedef struct plan_point {
    uint32_t set; /* 0 .. fluids - 1, then the solids */
    double x[3], v[3], d;
    double warm;           /* of a gas: u as a share of that which its set begins with */
    double dev[5], plastic, root, moved[3]; /* of solids: stress, yield, damage, way from the reference position */
} plan_point;

typedef struct plan_wall {
    sph_wall wall;
    bool flat, inside;          /* a segment or plane, else a box */
    double lo[3], hi[3], across[3]; /* flat: origin, end of one edge, of the other */
    uint32_t faces;
    sph_steady motion;
    bool by_table;              /* or so: */
    uint32_t axis;
    double t[PLAN_ROWS], x[PLAN_ROWS];
} plan_wall;

typedef struct plan_flow {
    bool out;
    uint32_t axis, fluid;
    sph_flow is;
    double gap;             /* of an inflow: a layer begins at most so far from the next one's place, in spacings */
    double uneven, thick;   /* speeds vary by so much, with something sideways; densities too */
} plan_flow;

typedef struct plan_bed { /* a wall along a polyline, 2-D */
    sph_wall wall;
    sph_steady motion;
    uint32_t points; /* 0: none */
    double p[PLAN_BED][2];
} plan_bed;

typedef struct plan_flaws { /* as sph_flaws, which 1-D has not */
    double k, m;
    uint64_t seed;
} plan_flaws;

typedef struct plan {
    uint64_t seed;
    sph_config cfg;
    uint32_t fluids, solids, walls, points, probes;
    sph_fluid fluid[PLAN_SETS];
    sph_solid solid[PLAN_SETS];
    sph_steady held[PLAN_SETS];
    plan_flaws flaws[PLAN_SETS]; /* k 0: none */
    plan_wall wall[PLAN_WALLS];
    uint32_t flows;
    plan_flow flow[PLAN_FLOWS];
    plan_bed bed;
    double way;    /* spacings, of flows in a step, if that can be */
    double wall_d; /* densities of compressible ghosts vary by so much */
    plan_point point[PLAN_POINTS];
    double probe[PLAN_PROBES][3];
    double push[3], drag; /* of the body force, where there is one */
    bool still_step;      /* also a step of nearly no time: filters, damage, sponges */
    uint32_t steps;       /* then so many whole ones */
} plan;

void plan_draw(plan *p, uint64_t seed);
void plan_print(const plan *p);

/* ---- look.c: the kernel's side ---- */

/* one particle as the kernel has it, by id */
typedef struct seen {
    bool there;
    uint32_t set;
    double x[3], v[3], a[3], d, rate, drift[3];
    double dev[5], dev_rate[5], plastic, root, phi, u, warmed;
    double disorder[4]; /* of shifting: minus the slope, then what the cover is above 1 */
    double power[8]; /* W/kg, in the order of the books */
} seen;

sph_sim *look_build(const plan *p, sph_report *why); /* null: refused */
void look_scene(const sph_sim *sim, const plan *p, o_scene *s); /* the state as the oracle's input */
uint32_t look_results(const sph_sim *sim, seen *to, uint32_t room);
uint32_t look_flaws(const sph_sim *sim, uint32_t id, float *threshold);
double look_power(const sph_sim *sim, uint32_t k); /* of the books, W: taken by viscosity, given by walls,
   taken by diffusion, given by the body force; taken by walls, by bonds, unbalanced */
double look_limit(const sph_sim *sim, const char *part_of_name); /* -1: no such limit */

/* ---- compare.c ---- */

typedef struct difference {
    const char *name; /* of the quantity; null: none */
    uint32_t particle, component;
    double kernel, oracle, scale, ratio; /* |kernel - oracle|/(tolerance scale) */
} difference;

typedef enum { PLAN_SAME, PLAN_DIFFERS, PLAN_REFUSED, PLAN_UNDECIDED } verdict;

enum { PLAN_QUANTITIES = 56 };
/* Runs kernel and oracle on a plan; d[0 .. *n - 1]: the largest difference of each quantity that differs (of `only`, if
   that is not null); *why: what a plan was refused for, or what rounding decides. */
verdict plan_compare(const plan *p, const char *only, difference *d, uint32_t *n, const char **why);
void plan_shrink(plan *p, difference *d); /* as long as the same quantity differs */

#endif
