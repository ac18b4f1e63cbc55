/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_swegle.c: growth in periodic squares of a solid held under pressure or tension: the Swegle test (Powell 2012,
   section 4.2.2; after Swegle, Hicks & Attaway 1995), the repulsion by artificial stress, transverse waves and pairing.

   Swegle test: one particle of a lattice at rest is pushed at 1e-10 c0, nothing is viscous, kick-drift-kick with c0 dt
   = 0.2 dx. The rate is the slope of the logarithm of the speed over the last third of a run of 400 dx/c0, or of one
   that ends when it is 1e-3 c0; below 0.01 c0/dx it counts as none, as it does in theory: then the particle's push
   spreads, and moves nothing further. Powell holds the particles around still; here the box is periodic, which linear
   theory covers exactly.

   With artificial stress the push is 1e-7 c0: principal axes are not followed where the principal stresses differ by
   less than 1e-9 K (tensile_part in sph/sweep.c), and with pushes of 1e-10 c0 slow waves do not grow. At V/V0 = 1 it
   has no linear theory: it acts on the tension of a wave but not on its pressure. Runs show that at some h it feeds
   waves there (table swegle). */
#include "atlas.h"

#include <stdlib.h>

#include "box.h"
#include "theory.h"
#include "tools/dispersion.h"

#define LEAST 0.01
#define END 400
#define PUSH_REPULSION 1e-7

growth_case growth_sided(growth_case c, uint32_t least)
{
    c.n = box_side(c.kernel, c.h, c.form == SPH_TOTAL ? 1.2 : 1, least);
    return c;
}

static box_solid solid_of(const growth_case *c)
{
    const box_solid b = {.form = c->form, .kernel = c->kernel, .lattice = c->lattice, .n = c->n, .h = c->h, .mu = c->mu,
                         .volume = c->volume, .epsilon = c->epsilon, .exponent = c->exponent, .dt = 0.2,
                         .xsph = c->xsph};
    return b;
}

double growth_measured(const growth_case *c, double end)
{
    const box_solid b = solid_of(c);
    void *arena;
    uint32_t set;
    sph_sim *sim = box_make_solid(&b, &set, &arena);
    box_push(sim, set, b.n, c->epsilon > 0 ? PUSH_REPULSION : 1e-10, 1);
    const double rate = box_growth(sim, b.dt, end, LEAST);
    free(arena);
    return rate;
}

double growth_theory(const growth_case *c)
{
    const theory_box t = {.form = c->form, .kernel = c->kernel, .lattice = c->lattice, .n = c->n, .h = c->h,
                          .mu = c->mu,
                          .volume = c->volume, .epsilon = c->epsilon, .exponent = c->exponent};
    const double rate = theory_growth(&t);
    return rate < LEAST ? 0 : rate;
}

double growth_nearest(const growth_case *c, double end, double *mean)
{
    box_solid b = solid_of(c);
    void *arena;
    uint32_t set;
    b.alpha = 0.1;
    b.dt = 0.2;
    sph_sim *sim = box_make_solid(&b, &set, &arena);
    box_noise(sim, set, 1e-2, 1, 3);
    for (double t = 0; t < end && sph_step(sim) == SPH_OK; t += b.dt)
        ;
    const double nearest = box_nearest(sim, b.n, mean);
    free(arena);
    return nearest;
}

void atlas_swegle(FILE *f)
{
    static const double volume[] = {0.9, 0.925, 0.95, 0.975, 0.99, 1, 1.01, 1.025, 1.05, 1.075, 1.1};
    static const double h[] = {1, 1.2, 1.4, 1.6, 1.8, 2};
    static const struct {
        const char *name;
        uint32_t form;
        double epsilon;
    } form[] = {{"updated", SPH_UPDATED, 0}, {"repulsion", SPH_UPDATED, 0.3}, {"corrected", SPH_CORRECTED, 0},
                {"total", SPH_TOTAL, 0}};
    atlas_head(f, "swegle", "Swegle test: growth rate of a push of 1e-10 c0, c0/dx",
               "square lattice, periodic, cubic spline, mu = 0.22 K, volume strain V/V0 (above 1: tension)\n"
               "repulsion: updated with artificial stress 0.3, n = 4, pushed with 1e-7 c0; measured: fit over runs of "
               "400 dx/c0\n"
               "theory: the fastest wave of the box (theory.c), which artificial stress at V/V0 = 1 does not have; 0: "
               "below 0.01",
               "form,volume,h,measured,theory");
    for (size_t i = 0; i < sizeof form / sizeof *form; i++)
        for (size_t k = 0; k < sizeof h / sizeof *h; k++)
            for (size_t v = 0; v < sizeof volume / sizeof *volume; v++) {
                growth_case c = {.form = form[i].form, .kernel = SPH_CUBIC, .h = h[k], .mu = 0.22};
                c.volume = volume[v];
                c.epsilon = form[i].epsilon;
                c.exponent = 4;
                c = growth_sided(c, 12);
                fprintf(f, "%s,%.4g,%.3g,%.3f,%.3f\n", form[i].name, c.volume, c.h, growth_measured(&c, END),
                        growth_theory(&c));
                fflush(f);
            }
}

void atlas_repulsion(FILE *f)
{
    static const double epsilon[] = {0, 0.1, 0.2, 0.3, 0.4, 0.6, 1}, h[] = {1, 1.2, 1.5};
    static const uint32_t exponent[] = {2, 4, 6};
    static const double lambda[] = {0.9, 0.97};
    atlas_head(f, "repulsion", "tension with artificial stress: growth rate of a push of 1e-7 c0, c0/dx",
               "as table swegle, form updated; lambda: rest density 1/lambda times the density (Gray 2001 eq 5.78), so "
               "V/V0 is\n"
               "1/lambda; 0: below 0.01; epsilon 0: no artificial stress",
               "epsilon,exponent,h,lambda,measured,theory");
    for (size_t l = 0; l < sizeof lambda / sizeof *lambda; l++)
        for (size_t k = 0; k < sizeof h / sizeof *h; k++)
            for (size_t n = 0; n < sizeof exponent / sizeof *exponent; n++)
                for (size_t e = 0; e < sizeof epsilon / sizeof *epsilon; e++) {
                    growth_case c = {.form = SPH_UPDATED, .kernel = SPH_CUBIC, .h = h[k], .mu = 0.22,
                                     .volume = 1 / lambda[l]};
                    c.epsilon = epsilon[e];
                    c.exponent = exponent[n];
                    c = growth_sided(c, 12);
                    fprintf(f, "%.3g,%u,%.3g,%.3g,%.3f,%.3f\n", c.epsilon, c.exponent, c.h, lambda[l],
                            growth_measured(&c, END),
                            growth_theory(&c));
                    fflush(f);
                }
}

void atlas_pairing(FILE *f)
{
    static const uint32_t kernel[] = {SPH_CUBIC, SPH_QUINTIC, SPH_GAUSSIAN, SPH_WENDLAND_C2, SPH_WENDLAND_C4};
    static const double h[] = {1, 1.2, 1.4, 1.6, 1.8, 2, 2.5}, rho[] = {1.1};
    static const char *const lattice[] = {"square", "shifted_x"};
    atlas_head(f, "pairing", "compression: growth rate of a push of 1e-10 c0, c0/dx, and how near particles come",
               "periodic, form updated with mu = 0 (water of p = c0^2 (rho - rho0)), rho: density over that at rest\n"
               "neighbours: with itself; measured, theory: as table swegle (none where neighbours stand on a rim at "
               "which the kernel\n"
               "jumps: gaussian, h 1); nearest: smallest distance of two particles, dx, 600 dx/c0 after noise of 1e-2 "
               "c0 with\n"
               "alpha 0.1; nearest_mean: mean over the particles of the distance to the nearest (1 on the square "
               "lattice, 1.075 on a\n"
               "hexagonal one)",
               "kernel,h,neighbours,rho,measured,theory,nearest,nearest_mean,lattice");
    for (uint32_t l = 0; l < 2; l++)
        for (size_t k = 0; k < sizeof kernel / sizeof *kernel; k++)
            for (size_t j = 0; j < sizeof h / sizeof *h; j++)
                for (size_t r = 0; r < sizeof rho / sizeof *rho; r++) {
                    growth_case c = {.form = SPH_UPDATED, .kernel = kernel[k], .lattice = l, .h = h[j],
                                     .volume = 1 / rho[r]};
                    double mean;
                    c = growth_sided(c, 12);
                    const double nearest = growth_nearest(&c, 600, &mean);
                    fprintf(f, "%s,%.3g,%u,%.3g,%.3f,%.3f", atlas_kernels[c.kernel], c.h,
                            box_neighbours(c.kernel, l, c.h), rho[r],
                            growth_measured(&c, END), growth_theory(&c));
                    fprintf(f, ",%.2f,%.2f,%s\n", nearest, mean, lattice[l]);
                    fflush(f);
                }
}
