/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_water.c: water under negative pressure. A periodic square of it, p = c0^2 (rho - rho0) below 0, with the means
   that are said to help: p >= 0, density diffusion, Shepard's filter, XSPH, other schemes.

   growth   rate of a push of 1e-10 c0 without viscosity, as in atlas_swegle.c; theory: that of the plain form with mu =
            0, which
            is the linear theory of all schemes with the sum of pressures (standard, weak), whose tensile part -2 p b
            does not
            know the density. Nothing done to the density can change that part, and it alone makes neighbours pair.
   nearest  mean over the particles of the distance to the nearest, dx, 600 dx/c0 after noise of 1e-2 c0 with alpha 0.1;
   hole     largest distance of a place from the nearest particle, dx (0.71 on the square lattice) */
#include "atlas.h"

#include <math.h>
#include <stdlib.h>

#include "box.h"
#include "theory.h"

static const char *const names[WATER_CHOICES] = {"plain", "floor", "molteni", "shepard", "xsph", "weak", "direct"};

static sph_sim *make(const water_case *w, double alpha, uint32_t *set, void **arena)
{
    const uint32_t n = box_side(w->kernel, w->h, 1, 12);
    sph_config c = box_config(n, w->kernel, w->h, 0.2);
    const sph_fluid water = {.mass = 1, .rho0 = 1 / w->density};
    const sph_shape s = {.hi = {n, n}};
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.pressure_floor = w->choice == WATER_FLOOR;
    c.diffusion = w->choice == WATER_MOLTENI ? SPH_MOLTENI : SPH_NO_DIFFUSION;
    c.shepard_every = w->choice == WATER_SHEPARD ? 20 : 0;
    c.xsph = w->choice == WATER_XSPH ? 0.5 : 0;
    c.scheme = w->choice == WATER_WEAK ? SPH_WEAK : w->choice == WATER_DIRECT ? SPH_DIRECT : SPH_STANDARD;
    if (alpha > 0) {
        c.viscosity = SPH_ARTIFICIAL;
        c.alpha = alpha;
    }
    sph_sim *sim = box_new(&c, arena);
    box_must(sim, sph_add_fluid(sim, &water, set), "water");
    box_must(sim, sph_add_shape(sim, *set, &s), "lattice");
    return sim;
}

double water_growth(const water_case *w, double end)
{
    void *arena;
    uint32_t set;
    sph_sim *sim = make(w, 0, &set, &arena);
    box_push(sim, set, box_side(w->kernel, w->h, 1, 12), 1e-10, 1);
    const double rate = box_growth(sim, 0.2, end, 0.01);
    free(arena);
    return rate;
}

double water_theory(const water_case *w)
{
    const theory_box t = {.form = SPH_UPDATED, .kernel = w->kernel, .n = box_side(w->kernel, w->h, 1, 12), .h = w->h,
                          .volume = 1 / w->density};
    const double rate = theory_growth(&t);
    return rate < 0.01 ? 0 : rate;
}

/* places half a spacing apart */
static double hole_of(const sph_sim *sim, uint32_t n)
{
    double most = 0;
    sph_particle q;
    for (uint32_t at = 0; at < 4 * n * n; at++) {
        const double x[2] = {0.5 * (at % (2 * n)), 0.5 * (double)(at / (2 * n))};
        double least = 1e300;
        for (uint32_t j = 0; j < sph_count(sim); j++) {
            double r2 = 0;
            box_must(sim, sph_get(sim, j, &q), "hole");
            for (int k = 0; k < 2; k++) {
                double d = fabs(q.x[k] - x[k]);
                d = d > 0.5 * n ? n - d : d;
                r2 += d * d;
            }
            least = r2 < least ? r2 : least;
        }
        most = least > most ? least : most;
    }
    return sqrt(most);
}

double water_nearest(const water_case *w, double end, double *hole)
{
    const uint32_t n = box_side(w->kernel, w->h, 1, 12);
    void *arena;
    uint32_t set;
    double mean;
    sph_sim *sim = make(w, 0.1, &set, &arena);
    box_noise(sim, set, 1e-2, 1, 11);
    for (double t = 0; t < end && sph_step(sim) == SPH_OK; t += 0.2)
        ;
    (void)box_nearest(sim, n, &mean);
    *hole = hole_of(sim, n);
    free(arena);
    return mean;
}

void atlas_water(FILE *f)
{
    static const double density[] = {0.99, 0.95};
    static const uint32_t kernel[] = {SPH_WENDLAND_C2, SPH_CUBIC};
    atlas_head(f, "water", "water under negative pressure: growth of pushes, and where particles end",
               "periodic square, h = 1.2 dx, p = c0^2 (rho - rho0); x: density over rho0; floor: p >= 0; molteni: "
               "delta 0.1\n"
               "shepard: every 20 steps; xsph: 0.5; growth: without viscosity; nearest (mean over particles), hole: "
               "600 dx/c0 after\n"
               "noise of 1e-2 c0, alpha 0.1\n"
               "theory: of the plain form",
               "case,choice,x,figure,value,unit");
    for (size_t k = 0; k < sizeof kernel / sizeof *kernel; k++)
        for (size_t d = 0; d < sizeof density / sizeof *density; d++) {
            water_case w = {.kernel = kernel[k], .h = 1.2, .density = density[d]};
            fprintf(f, "tension_%s,plain,%.3g,theory,%.3f,c0/dx\n", atlas_kernels[w.kernel], w.density,
                    water_theory(&w));
            for (w.choice = 0; w.choice < WATER_CHOICES; w.choice++) {
                double hole;
                const double nearest = water_nearest(&w, 600, &hole);
                const char *const kn = atlas_kernels[w.kernel], *const cn = names[w.choice];
                fprintf(f, "tension_%s,%s,%.3g,growth,%.3f,c0/dx\n", kn, cn, w.density, water_growth(&w, 400));
                fprintf(f, "tension_%s,%s,%.3g,nearest,%.2f,dx\n", kn, cn, w.density, nearest);
                fprintf(f, "tension_%s,%s,%.3g,hole,%.2f,dx\n", kn, cn, w.density, hole);
                fflush(f);
            }
        }
}
