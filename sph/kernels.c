/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* kernels.c: normalisation of the smoothing kernels, and their scalar form for hosts. No arrays.

   Each constant is 1 / integral of value(q) over the support, derived for the shapes of kernels.h:
   B-splines from Schoenberg's truncated powers, Wendland's functions from beta integrals, the truncated Gaussian from
   the error function of 3, so that all seven integrate to 1 (tests/test_kernels.c checks by quadrature). */
#include "internal.h"
#include "kernels.h"
#include "arithmetic.h"

SPH_OBJECT(kernels)

#define SPH_PI 3.14159265358979323846
#define SPH_ERF3 0.99997790950300141456  /* erf(3) */
#define SPH_EXP9 1.2340980408667954950e-4 /* exp(-9) */

typedef struct shape {
    double support;
    double norm[3];  /* 1 / integral of value in 1, 2, 3 dimensions, h = 1 */
    double slope[3]; /* (dW/dr)/r = norm * slope * slope(q), h = 1 */
} shape;

static const shape shapes[SPH_KERNELS] = {
    [SPH_CUBIC] = {2, {1.0 / 6, 5 / (14 * SPH_PI), 1 / (4 * SPH_PI)}, {-3, -3, -3}},
    [SPH_QUARTIC] = {2.5, {1.0 / 24, 96 / (1199 * SPH_PI), 1 / (20 * SPH_PI)}, {-4, -4, -4}},
    [SPH_QUINTIC] = {3, {1.0 / 120, 7 / (478 * SPH_PI), 1 / (120 * SPH_PI)}, {-5, -5, -5}},
    /* sqrt(pi) erf 3; pi (1 - e^-9); pi^1.5 erf 3 - 6 pi e^-9 */
    [SPH_GAUSSIAN] = {3,
                      {0.56418958354775628695 / SPH_ERF3, 1 / (SPH_PI * (1 - SPH_EXP9)),
                       1 / (5.5683279968317078453 * SPH_ERF3 - 6 * SPH_PI * SPH_EXP9)},
                      {-2, -2, -2}},
    [SPH_WENDLAND_C2] = {2, {5.0 / 8, 7 / (4 * SPH_PI), 21 / (16 * SPH_PI)}, {-3, -5, -5}},
    [SPH_WENDLAND_C4] = {2, {3.0 / 4, 3 / (4 * SPH_PI), 165 / (256 * SPH_PI)}, {-3.5, -14, -14}},
    [SPH_HAT] = {2, {1.0 / 2, 3 / (4 * SPH_PI), 3 / (8 * SPH_PI)}, {-0.5, -0.5, -0.5}},
};

double sph_kernel_support(uint32_t kernel) { return kernel < SPH_KERNELS ? shapes[kernel].support : 0; }

void sph_kernel_scales(uint32_t kernel, double h, double *value_scale, double *slope_scale)
{
    const shape *s = &shapes[kernel];
    double a = s->norm[SPH_DIM - 1];
    for (int k = 0; k < SPH_DIM; k++)
        a /= h;
    *value_scale = a;
    *slope_scale = a * s->slope[SPH_DIM - 1] / (h * h);
}

sph_status sph_kernel_value(uint32_t kernel, double r, double h, double *w, double *dw)
{
    double value_scale, slope_scale;
    if (!sph_in(SPH_KERNELS_IN, kernel) || !(h > 0) || !(r >= 0) || !w || !dw || h - h != 0 || r - r != 0)
        return SPH_BAD_ARGUMENT;
    sph_kernel_scales(kernel, h, &value_scale, &slope_scale);
    double q = r / h;
    if (q >= shapes[kernel].support) {
        *w = *dw = 0;
        return SPH_OK;
    }
    /* one lane of the vector form, so hosts see what the sweep computes */
    sph_real lanes[SPH_LANES];
    v_store(lanes, k_value(kernel, v_set((sph_real)q)));
    *w = value_scale * (double)lanes[0];
    v_store(lanes, k_slope(kernel, v_set((sph_real)q)));
    *dw = slope_scale * (double)lanes[0] * r;
    return SPH_OK;
}
