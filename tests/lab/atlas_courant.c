/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_courant.c: the largest Courant number c0 dt/h that an integrator stands, by bisection of runs and by linear
   theory.

   Runs: the periodic square lattice at no pressure with random velocities of 1e-8 c0, artificial viscosity alpha 0.1
   (beta 0) everywhere, elastic with mu = 0.22 K. A step is too long if the largest speed in the last quarter of the run
   is above that in the second (they cover whole periods), or if a step fails. Theory (theory.c): no wave of the box is
   multiplied by more than 1 a step. Both allow no growth at all.
   Without viscosity the predictor-corrector and the midpoint rule stand no step: they multiply an oscillation w by 1 +
   (w dt)^4/4 and 1 + (w dt)^4/8. The others stand w dt = 2 and, with viscosity, a little less. */
#include "atlas.h"

#include <math.h>
#include <stdlib.h>

#include "box.h"
#include "theory.h"

#define ALPHA 0.1
#define MU 0.22

static uint32_t side_of(const courant_case *k) { return box_side(k->kernel, k->h, k->elastic ? 1.2 : 1, 10); }

/* where the density is summed: the mass with which it is 1 on the lattice, so that there is no pressure */
static double mass_of(const courant_case *k)
{
    if (k->elastic || k->choice != COURANT_SUMMED)
        return 1;
    const int reach = (int)ceil(k->h * sph_kernel_support(k->kernel));
    double sum = 0, w, dw;
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            if (sph_kernel_value(k->kernel, sqrt(i * i + j * j), k->h, &w, &dw) == SPH_OK)
                sum += w;
    return 1 / sum;
}

static bool grows(const courant_case *k, double courant, uint32_t steps)
{
    const uint32_t n = side_of(k);
    sph_config c = box_config(n, k->kernel, k->h, courant * k->h);
    const sph_solid m = {.mass = 1, .rho0 = 1, .sound_speed = 1, .shear = MU};
    const sph_fluid water = {.mass = mass_of(k)};
    const sph_shape s = {.hi = {n, n}};
    void *arena;
    uint32_t set;
    c.viscosity = SPH_ARTIFICIAL;
    c.alpha = ALPHA;
    c.integrator = k->integrator;
    c.max_stretch = 1.2;
    if (k->elastic) {
        c.solid = k->choice;
    } else if (k->choice == COURANT_SUMMED) {
        c.density = SPH_SUMMATION;
    } else {
        c.scheme = k->choice;
    }
    sph_sim *sim = box_new(&c, &arena);
    if (k->elastic)
        box_must(sim, sph_add_solid(sim, &m, &set, NULL), "solid");
    else
        box_must(sim, sph_add_fluid(sim, &water, &set), "water");
    box_must(sim, sph_add_shape(sim, set, &s), "lattice");
    box_noise(sim, set, 1e-8, 1, 7);
    const bool out = box_ratio(sim, steps) > 1;
    free(arena);
    return out;
}

double courant_measured(const courant_case *c, uint32_t steps, double precision)
{
    double low = 0.1, high = 5;
    while (high / low > 1 + precision) {
        const double mid = sqrt(low * high);
        if (grows(c, mid, steps))
            high = mid;
        else
            low = mid;
    }
    return sqrt(low * high);
}

double courant_theory(const courant_case *c)
{
    const theory_step t = {.medium = !c->elastic ? c->choice == COURANT_SUMMED ? THEORY_SUMMED : THEORY_WATER
                                     : c->choice == SPH_UPDATED ? THEORY_UPDATED : THEORY_CORRECTED,
                           .integrator = c->integrator,
                           .kernel = c->kernel,
                           .n = side_of(c),
                           .h = c->h,
                           .mu = MU,
                           .alpha = ALPHA,
                           .mass = mass_of(c)};
    return theory_limit(&t) / c->h;
}

void atlas_courant(FILE *f)
{
    static const struct {
        bool elastic;
        uint32_t choice;
        const char *name;
    } scheme[] = {{false, SPH_STANDARD, "standard"}, {false, SPH_WEAK, "weak"},        {false, SPH_DIRECT, "direct"},
                  {false, COURANT_SUMMED, "summed"}, {true, SPH_UPDATED, "updated"},   {true, SPH_CORRECTED,
                      "corrected"},
                  {true, SPH_TOTAL, "total"}};
    atlas_head(f, "courant", "largest stable Courant number c0 dt/h",
               "square lattice at no pressure, periodic, alpha 0.1, beta 0; elastic with mu = 0.22 K; c0: of the bulk "
               "modulus\n"
               "measured: bisection of runs of 400 steps (kick-drift-kick, leap-frog; others 1200) to 0.5 %\n"
               "theory: largest eigenvalue of the step's matrix over all waves\n"
               "summed: density by summation; theory: tests/lab/theory.c",
               "medium,scheme,integrator,kernel,h,measured,theory,ratio");
    for (size_t s = 0; s < sizeof scheme / sizeof *scheme; s++)
        for (uint32_t i = 0; i < SPH_INTEGRATORS; i++)
            for (uint32_t k = 0; k < SPH_KERNELS; k++) {
                const courant_case c = {scheme[s].elastic, scheme[s].choice, i, k, 1.2};
                /* beyond their limit all grows fast */
                const bool sharp = i == SPH_KICK_DRIFT_KICK || i == SPH_LEAP_FROG;
                const double m = courant_measured(&c, sharp ? 400 : 1200, 0.005), t = courant_theory(&c);
                fprintf(f, "%s,%s,%s,%s,%.3g,%.3f,%.3f,%.3f\n", c.elastic ? "elastic" : "water", scheme[s].name,
                        atlas_integrators[i], atlas_kernels[k], c.h, m, t, m / t);
                fflush(f);
            }
}
