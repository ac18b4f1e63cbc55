/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas.h: single entries of the stability atlas (`atlas TABLE` writes whole tables; test_atlas.c checks a few). */
#ifndef LAB_ATLAS_H
#define LAB_ATLAS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

extern const char *const atlas_kernels[], *const atlas_integrators[], *const atlas_forms[]; /* in the order of sph.h */

/* a table: its name, who writes it */
typedef struct atlas_table {
    const char *name;
    void (*write)(FILE *f);
} atlas_table;
void atlas_courant(FILE *f), atlas_swegle(FILE *f), atlas_tension(FILE *f), atlas_pairing(FILE *f),
    atlas_repulsion(FILE *f);
void atlas_water(FILE *f), atlas_tank(FILE *f), atlas_leak(FILE *f), atlas_precision(FILE *f);
void atlas_sponge(FILE *f);
void atlas_forms_of_solids(FILE *f);

/* the header every table has; "" lines are left out */
void atlas_head(FILE *f, const char *table, const char *title, const char *figures, const char *columns);

/* ---- courant: see atlas_courant.c ---- */
typedef struct courant_case {
    bool elastic;
    uint32_t choice;     /* water: scheme of sph.h, or COURANT_SUMMED; elastic: form */
    uint32_t integrator, kernel;
    double h;
} courant_case;
enum { COURANT_SUMMED = 100 };
double courant_measured(const courant_case *c, uint32_t steps, double precision); /* c0 dt/h */
double courant_theory(const courant_case *c);

/* ---- growth in squares: see atlas_swegle.c ---- */
typedef struct growth_case {
    uint32_t form, kernel, lattice, n, exponent;
    double h, mu, volume, epsilon, xsph; /* xsph: of the velocity itself; such cases have no theory */
} growth_case;
double growth_measured(const growth_case *c, double end);
double growth_theory(const growth_case *c);
/* the smallest distance of two particles, dx, once noise of 1e-2 c0 has grown and come to rest; *mean: of each one's
   nearest */
double growth_nearest(const growth_case *c, double end, double *mean);
/* the same and an even side of the box that holds three cells of this support */
growth_case growth_sided(growth_case c, uint32_t least);

/* ---- the chain: see atlas_tension.c ---- */
#define TENSION_SEEN 6.9078 /* ln 1000: growth rate times length of a run that shows it */
enum { TENSION_NONE = 2 }; /* a stretch beyond all that were tried */
double tension_cholesky(uint32_t kernel, double h, uint32_t count, double most, double rate);
double tension_powell(uint32_t kernel, double h, uint32_t count, double most);
double tension_running(uint32_t kernel, double h, uint32_t count, double most, double end, double precision);

/* ---- water under negative pressure: see atlas_water.c ---- */
enum { WATER_PLAIN, WATER_FLOOR, WATER_MOLTENI, WATER_SHEPARD, WATER_XSPH, WATER_WEAK, WATER_DIRECT, WATER_CHOICES };
typedef struct water_case {
    uint32_t kernel, choice;
    double h, density;
} water_case;
double water_growth(const water_case *w, double end);
double water_theory(const water_case *w);
double water_nearest(const water_case *w, double end, double *hole);

/* ---- walls: see atlas_walls.c ---- */
enum { WALL_LJ, WALL_KERNEL, WALL_KOS, WALL_GHOST_FREE, WALL_GHOST_HELD, WALL_EXTRAPOLATED, WALL_MIRROR, WALL_CHOICES };
extern const char *const wall_names[];
typedef struct tank_case {
    uint32_t wall, integrator, diffusion;
    double alpha;
} tank_case;
typedef struct wall_tank {
    double speed, moved, nearest, pressure;
    uint32_t put_back, left;
} wall_tank;
/* out[m]: the tank after at[m] steps, for so many as it got to; *failed: the step that failed, 0: none */
uint32_t wall_rest(const tank_case *k, const uint32_t *at, uint32_t marks, wall_tank *out, uint32_t *failed);
typedef struct wall_leak {
    double crossed; /* share */
    uint32_t put_back;
    bool failed;
} wall_leak;
wall_leak wall_throw(uint32_t choice, double strength, uint32_t layers, double speed, bool put_back);

/* ---- waves that leave: see atlas_sponge.c ---- */
enum { SPONGE_WATER, SPONGE_BAR };
enum { SPONGE_PACKET, SPONGE_SWING, SPONGE_PULSE, SPONGE_WAVES };
typedef struct sponge_case {
    uint32_t medium, width, wave; /* width: spacings */
    double rate;                  /* of the layer, times its width over c; 0: no layer */
} sponge_case;
double sponge_reflected(const sponge_case *c); /* energy that comes back over that which came */
double sponge_theory(const sponge_case *c);    /* what goes through the layer and back */

/* ---- float and double: see atlas_precision.c ---- */
enum { PAIR_TANK, PAIR_DAM, PAIR_VORTEX, PAIR_BLOCK, PAIR_TENSION, PAIR_SCENES };
typedef struct precision_pair {
    uint32_t steps;
    uint32_t part[2][2]; /* steps until the largest [0] and the mean [1] difference passed 1e-3 and 0.1 dx; 0: never */
    double moved[2];            /* at the end: largest and mean difference, dx */
    /* largest difference of the kinetic energies over its largest value; of the fronts, dx */
    double kinetic, front;
} precision_pair;
precision_pair precision_part(uint32_t scene, uint32_t steps);

#endif
