/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* waves.h: what scenes of water waves share: water whose columns follow a surface and a bed, and the tank around it.
   Lengths in depths D of the water at rest, y from the flat bed, velocities in sqrt(gD), pressures in rho g D. */
#ifndef EXAMPLES_WAVES_H
#define EXAMPLES_WAVES_H

#include "scene.h"
#include "track.h"

typedef struct wave_water {
    double depth, gravity, sound; /* m, m/s^2; sound speed in sqrt(gD) */
    double from, to;              /* where the water begins and ends, D */
    uint32_t n;                   /* particles in the depth */
    bool even;                    /* rows by the height of the water, not of the still water: for high mounds */
    double (*surface)(const void *of, double x);                                   /* above still water */
    void (*flow)(const void *of, double x, double y, double *v, double *pressure); /* null: at rest, hydrostatic */
    double (*bed)(const void *of, double x);                                       /* null: flat, at 0 */
    const void *of;
} wave_water;

/* Mass of a column over that of one of depth D at rest. Under eta the mean pressure rises by about rho g eta/2, and
   there is so much more in the same room. */
#define wave_pressed SPH_NAME(wave_pressed)
double wave_pressed(double sound, double eta);

/* At most so many particles are added by wave_add. */
#define wave_count SPH_NAME(wave_count)
double wave_count(const wave_water *w);

/* Adds the water as one set: columns of particles of one mass, as many in each as its depth has spacings, so wide that
   a particle has the room that its mass needs. Over a flat bed the last column ends at `to` (with `even` nearly); else
   they go on to `to` or to where the water is half a spacing deep. p: the scene's parameters, for its equation of
   state. */
#define wave_add SPH_NAME(wave_add)
sph_status wave_add(sph_sim *sim, const double *p, const wave_water *w);

/* Moves water of a lattice so that it follows a surface (sph_apply_positions): a particle at x, y goes to X, y (1 +
   eta(X)/D), where the water from `low` to X over the bed is as much as it was from `low` to x: volumes and masses
   stay, the top row lies half a (stretched) spacing below the surface. All in m. */
typedef struct wave_surface {
    double low, depth, step; /* step: of the integration, a spacing */
    double (*eta)(const void *of, double x);
    const void *of;
} wave_surface;
#define wave_follow SPH_NAME(wave_follow)
sph_status wave_follow(sph_sim *sim, uint32_t set, const wave_surface *s);
/* A small sinusoidal push of places (Gray 2001, section 3.1), `by` m, eight spacings long, which keeps volumes: x by
   that of y, y by that of x. */
#define wave_push SPH_NAME(wave_push)
sph_status wave_push(sph_sim *sim, uint32_t set, double spacing, double by);

/* sqrt(g D), m/s: the speed of long waves */
#define wave_long SPH_NAME(wave_long)
double wave_long(double gravity, double depth);

/* A tank from x 0 whose low end is driven; bed and far end are of wall particles or planes of symmetry. */
typedef struct wave_tank {
    double length, height; /* m */
    bool walls;            /* bed and far end */
    sph_motion drive;      /* its context: the scene's parameters */
} wave_tank;
#define wave_tank_configure SPH_NAME(wave_tank_configure)
sph_config wave_tank_configure(const double *p, const wave_water *w, const wave_tank *tank);
#define wave_tank_build SPH_NAME(wave_tank_build)
sph_status wave_tank_build(sph_sim *sim, const double *p, const wave_water *w, const wave_tank *tank);

#endif
