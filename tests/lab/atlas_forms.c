/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_forms.c: the Swegle test (atlas_swegle.c) of every form of solids, at Powell's smoothing length of 1.3 spacings
   (2012, section 4.2.2), with and without XSPH that smooths the velocity itself by 0.1 (his eq 2.71).

   Theory of normalised kernels: none grows. With D f = sum V_j f_j grad W~, which is 0 of a constant wherever particles
   are, and T = sigma/rho^2, the acceleration sum m_j (T_i + T_j) grad W~ is D(rho T) + T D(rho); of a wave on a uniform
   stress that is D(d sigma)/rho to first order, whatever the stress, and D of the velocity makes d sigma, so w^2 is a
   modulus over rho times |D|^2, never below 0. The stabilised form's pairs are made antisymmetric, and XSPH takes a
   share of a velocity at each step: no theory is at hand for them. */
#include "atlas.h"

#include "sph/sph.h"

#define XSPH 0.1
#define END 400

void atlas_forms_of_solids(FILE *f)
{
    static const double volume[] = {0.9, 0.95, 0.975, 0.99, 1, 1.01, 1.025, 1.05, 1.1};
    static const struct {
        const char *name;
        uint32_t form;
        int theory; /* 1: linear, 0: nothing grows, -1: none */
    } form[] = {{"updated", SPH_UPDATED, 1},       {"corrected", SPH_CORRECTED, 1},
                {"normalised", SPH_NORMALISED, 0}, {"normalised_corrected", SPH_NORMALISED_CORRECTED, 0},
                {"stabilised", SPH_STABILISED, -1}, {"total", SPH_TOTAL, 1}};
    atlas_head(f, "forms", "Swegle test of the forms of solids: growth rate of a push of 1e-10 c0, c0/dx",
               "square lattice, periodic, cubic spline, h 1.3 dx, mu = 0.22 K, volume strain V/V0 (above 1: tension)\n"
               "xsph: factor by which velocities are smoothed at each step of 0.2 dx/c0; measured, theory: as table "
               "swegle;\n"
               "theory - where none is at hand (atlas_forms.c)",
               "form,xsph,volume,measured,theory");
    for (size_t i = 0; i < sizeof form / sizeof *form; i++)
        for (int smooth = 0; smooth < 2; smooth++)
            for (size_t v = 0; v < sizeof volume / sizeof *volume; v++) {
                growth_case c = {.form = form[i].form, .kernel = SPH_CUBIC, .h = 1.3, .mu = 0.22, .volume = volume[v],
                                 .xsph = smooth ? XSPH : 0};
                c = growth_sided(c, 12);
                fprintf(f, "%s,%.3g,%.4g,%.3f,", form[i].name, c.xsph, c.volume, growth_measured(&c, END));
                if (smooth || form[i].theory < 0)
                    fprintf(f, "-\n");
                else
                    fprintf(f, "%.3f\n", form[i].theory ? growth_theory(&c) : 0.0);
                fflush(f);
            }
}
