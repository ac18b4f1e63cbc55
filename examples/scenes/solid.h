/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* solid.h: what scenes of solids share. Their units are Gray's (2001, section 5.4): lengths in cm, stresses in bulk
   moduli rho0 c0^2, speeds in c0, so rho0 = c0 = 1 and a time of 1 is what sound takes for 1 cm. */
#ifndef EXAMPLES_SOLID_H
#define EXAMPLES_SOLID_H

#include "scene.h"

/* parameters that every solid scene takes after the common ones */
enum {
    SOLID_FORM = SCENE_COMMON, SOLID_REPULSION, SOLID_EPSILON, SOLID_EXPONENT, SOLID_STRAIN, SOLID_MU, SOLID_YIELD,
    SOLID_HARDENING, SOLID_PRINTED, SOLID_HOURGLASS, SOLID_COMMON
};

/* kernel, h, alpha, books, integrator, cfl as in SCENE_PARAMS_OF; form_: SPH_UPDATED ...; yield_: 0: elastic */
#define SOLID_PARAMS(kernel_, h_, alpha_, books_, integrator_, cfl_, form_, repulsion_, mu_, yield_)                   \
    SOLID_PARAMS_DAMPED(kernel_, h_, alpha_, books_, integrator_, cfl_, form_, repulsion_, mu_, yield_, 1)
#define SOLID_PARAMS_DAMPED(kernel_, h_, alpha_, books_, integrator_, cfl_, form_, repulsion_, mu_, yield_, damping_)  \
    SCENE_PARAMS_OF(kernel_, h_, SPH_LINEAR, SPH_ARTIFICIAL, alpha_, SPH_NO_DIFFUSION, SCENE_ADAMI, damping_, 0,       \
                    books_, integrator_, cfl_, 0),                                                                     \
    {"form", "-", "solid form: updated corrected total stabilised normalised normalised_corrected", (form_) - 1, 0,    \
     SPH_SOLIDS - 2, SCENE_CHOICE},                                                                                    \
    {"repulsion", "-", "artificial stress: none principal components", repulsion_, 0, 2, SCENE_CHOICE},                \
    {"epsilon", "-", "factor of the artificial stress; 0: none", 0.3, 0, 10, SCENE_NUMBER},                            \
    {"exponent", "-", "exponent of the artificial stress", 4, 1, 8, SCENE_WHOLE},                                      \
    {"strain", "-", "strain rates from the velocity: plain smoothed", 0, 0, 1, SCENE_CHOICE},                          \
    {"mu", "K", "shear modulus", mu_, 0, 100, SCENE_NUMBER},                                                           \
    {"yield", "K", "yield stress in simple tension; 0: elastic", yield_, 0, 100, SCENE_NUMBER},                        \
    {"hardening", "K", "rise of the yield stress with plastic strain", 0, 0, 100, SCENE_NUMBER},                       \
    {"printed", "-", "yield and damage as Gray 2001 prints them: no yes", 0, 0, 1, SCENE_CHOICE},                      \
    {"hourglass", "-", "control of hourglass modes (form=total); 0: none", 0, 0, 100, SCENE_NUMBER}

/* scene_config with rho0 = c0 = 1 and the parameters above; damage is left to the scene */
static inline sph_config solid_config(const double *p, double dx)
{
    sph_config c = scene_config(p, dx, 1, 1);
    c.solid = (uint32_t)p[SOLID_FORM] + 1;
    const bool repels = p[SOLID_EPSILON] > 0 && c.solid < SPH_TOTAL;
    c.artificial_stress = repels ? (uint32_t)p[SOLID_REPULSION] : SPH_NO_ARTIFICIAL_STRESS;
    c.stress_epsilon = p[SOLID_EPSILON];
    c.stress_exponent = (uint32_t)p[SOLID_EXPONENT];
    c.xsph_strain = p[SOLID_STRAIN] != 0;
    c.yield = p[SOLID_YIELD] > 0 ? p[SOLID_PRINTED] != 0 ? SPH_VON_MISES_GRAY : SPH_VON_MISES : SPH_NO_YIELD;
    c.hourglass = p[SOLID_HOURGLASS];
    c.on_leave = SPH_FAIL;
    return c;
}

static inline sph_solid solid_material(const double *p)
{
    sph_solid m = {0};
    m.shear = p[SOLID_MU];
    m.yield = p[SOLID_YIELD];
    m.hardening = p[SOLID_HARDENING];
    return m;
}

/* What holds a body at a flat face. Held centres that stand half a spacing behind the face let a displacement vanish
   there and not on it, which costs the first order of the spacing. An ideal clamp is one row of held particles whose
   centres stand on the face: half of each lies in the body, so its stress counts by half (shear modulus, yield stress,
   hardening and c0^2 are halved), its mass and its weight in sums stay; damage, a share of the stress, needs nothing.
   Exact for uniform stress where the kernel reaches neighbours and diagonals only (h 0.8 with a support of 2: a block
   that is drawn has 0.013 % of its stress wrong at 20 columns, 9.9 % with columns held as a whole); with h 1.5 the
   body is 0.37 dx too long still (0.86 dx). c0: of the body. */
static inline sph_solid solid_clamp(const sph_solid *body, double c0)
{
    sph_solid m = *body;
    m.shear *= 0.5;
    m.yield *= 0.5;
    m.hardening *= 0.5;
    m.sound_speed = c0 * __builtin_sqrt(0.5);
    return m;
}
/* how far the kernel reaches, in spacings */
static inline double solid_support(const double *p)
{
    return sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H];
}

/* The smallest distance between two particles in spacings, 10 without pairs nearer than that: where it falls well below
   1, particles clump. Particles come in slabs along the last axis, no thicker than twice what c says of its cells, so
   that a particle further up than that ends the search. */
static inline double solid_closest(const sph_sim *sim, const sph_config *c)
{
    const uint32_t n = sph_count(sim), up = SPH_DIM - 1;
    const double reach = sph_kernel_support(c->kernel) * c->smoothing_length * (c->solid == SPH_TOTAL ? c->max_stretch :
        1);
    double least = 100 * c->spacing * c->spacing;
    sph_particle a, b;
    for (uint32_t i = 0; i < n; i++) {
        (void)sph_get(sim, i, &a);
        for (uint32_t j = i + 1; j < n; j++) {
            (void)sph_get(sim, j, &b);
            if (b.x[up] > a.x[up] + 2 * reach + 10 * c->spacing)
                break;
            double r2 = 0;
            for (uint32_t k = 0; k < SPH_DIM; k++)
                r2 += (a.x[k] - b.x[k]) * (a.x[k] - b.x[k]);
            least = r2 < least ? r2 : least;
        }
    }
    return __builtin_sqrt(least) / c->spacing;
}

/* microseconds of Gray's time unit in the rings of his section 6.1: 50 m/s are 0.0587 c0 (rings.c) */
#define SOLID_MICROSECONDS (0.0587 * 1e4 / 50)

#endif
