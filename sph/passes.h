/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* passes.h: every pass that stands in the lists of integrators.c, where its module was compiled in. */
#ifndef SPH_PASSES_H
#define SPH_PASSES_H

#include "internal.h"

/* sort.c */
#define sph_pass_count SPH_NAME(pass_count_)
#define sph_pass_scatter SPH_NAME(pass_scatter_)
/* forces.c */
#define sph_pass_force SPH_NAME(pass_force_)
/* density.c */
#define sph_pass_summation SPH_NAME(pass_summation_)
#define sph_pass_shepard SPH_NAME(pass_shepard_)
/* mls.c */
#define sph_pass_mls SPH_NAME(pass_mls_)
#define sph_pass_copy_density SPH_NAME(pass_copy_density_)
/* adami.c */
#define sph_pass_adami SPH_NAME(pass_adami_)
#define sph_pass_adami_copy SPH_NAME(pass_adami_copy_)
/* quadrature.c */
#define sph_pass_cover SPH_NAME(pass_cover_)
#define sph_pass_quadrature SPH_NAME(pass_quadrature_)
/* correction.c, smoothing.c, gradient.c, shear.c */
#define sph_pass_correction SPH_NAME(pass_correction_)
#define sph_pass_smooth SPH_NAME(pass_smooth_)
#define sph_pass_gradient SPH_NAME(pass_gradient_)
#define sph_pass_shear SPH_NAME(pass_shear_)
/* density_gradient.c */
#define sph_pass_density_gradient SPH_NAME(pass_density_gradient_)
extern const sph_pass sph_pass_density_gradient;
/* smoothing_length.c: smoothing_length.h */
/* stabilised.c, normalised.c, hourglass.c */
#define sph_pass_edge SPH_NAME(pass_edge_)
#define sph_pass_rows SPH_NAME(pass_rows_)
#define sph_pass_means SPH_NAME(pass_means_)
#define sph_pass_normal SPH_NAME(pass_normal_)
#define sph_pass_bonds SPH_NAME(pass_bonds_)
extern const sph_pass sph_pass_edge, sph_pass_rows, sph_pass_means, sph_pass_normal, sph_pass_bonds;
extern const sph_pass sph_pass_count, sph_pass_scatter, sph_pass_force, sph_pass_summation, sph_pass_shepard,
    sph_pass_copy_density, sph_pass_adami, sph_pass_adami_copy, sph_pass_correction, sph_pass_smooth, sph_pass_gradient,
    sph_pass_cover, sph_pass_quadrature, sph_pass_shear, sph_pass_mls;

#endif
