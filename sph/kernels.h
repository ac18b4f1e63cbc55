/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* kernels.h: smoothing kernels on lanes. With q = r/h:
     W(r)         = value_scale * value(q)
     (dW/dr) / r  = slope_scale * slope(q)
   slope is finite at q = 0 for the smooth kernels; for the splines it is 0/q there, made 0 by guarding q.
   Outside the support both are exactly 0. The scales carry h and the normalisation in SPH_DIM dimensions. */
#ifndef SPH_KERNELS_H
#define SPH_KERNELS_H

#include "lanes.h"

#define sph_kernel_scales SPH_NAME(kernel_scales_)
void sph_kernel_scales(uint32_t kernel, double h, double *value_scale, double *slope_scale);

#define SPH_TINY_Q ((sph_real)1e-6)

SPH_INLINE vreal k_sq(vreal a) { return a * a; }

/* e^-y for y in 0..9: y/16 by its Taylor series (remainder below 1e-17), then four squarings */
SPH_INLINE vreal k_exp_minus(vreal y)
{
    vreal z = y * (sph_real)-0.0625;
    vreal s = v_set(1);
    SPH_UNROLL
    for (int n = SPH_DOUBLE ? 14 : 7; n > 0; n--)
        s = s * z * (sph_real)(1.0 / n) + 1;
    s = s * s;
    s = s * s;
    s = s * s;
    return s * s;
}

/* slope(q); `kernel` is a constant in the fast paths, so the switch costs nothing there */
SPH_INLINE vreal k_slope(uint32_t kernel, vreal q)
{
    const vreal qs = v_max(q, v_set(SPH_TINY_Q));
    if (SPH_IS(kernel, WENDLAND_C2)) {
        const vreal u = v_pos(1 - q * (sph_real)0.5);
        return SPH_DIM == 1 ? u * u : u * u * u;
    }
    if (SPH_IS(kernel, WENDLAND_C4)) {
        const vreal t = q * (sph_real)0.5, u = v_pos(1 - t), u4 = k_sq(u * u);
        return SPH_DIM == 1 ? (1 + 4 * t) * u4 : (1 + 5 * t) * u4 * u;
    }
    if (SPH_IS(kernel, CUBIC)) {
        const vreal a = v_pos(2 - q), b = v_pos(1 - q);
        return (a * a - 4 * (b * b)) / qs;
    }
    if (SPH_IS(kernel, QUARTIC)) {
        const vreal a = v_pos((sph_real)2.5 - q), b = v_pos((sph_real)1.5 - q), c = v_pos((sph_real)0.5 - q);
        return (a * a * a - 5 * (b * b * b) + 10 * (c * c * c)) / qs;
    }
    if (SPH_IS(kernel, QUINTIC)) {
        const vreal a = v_pos(3 - q), b = v_pos(2 - q), c = v_pos(1 - q);
        return (k_sq(a * a) - 6 * k_sq(b * b) + 15 * k_sq(c * c)) / qs;
    }
    if (SPH_IS(kernel, GAUSSIAN))
        return v_where(v_less(q, v_set(3)), k_exp_minus(q * q));
    if (SPH_IS(kernel, HAT))
        return v_where(v_less(q, v_set(2)), v_where(v_less(v_set(0), q), 1 / qs));
    __builtin_unreachable(); /* sph_config_check lets nothing else in */
}

SPH_INLINE vreal k_value(uint32_t kernel, vreal q)
{
    if (SPH_IS(kernel, WENDLAND_C2)) {
        const vreal t = q * (sph_real)0.5, u = v_pos(1 - t), u2 = u * u;
        return SPH_DIM == 1 ? u2 * u * (1 + 3 * t) : u2 * u2 * (1 + 4 * t);
    }
    if (SPH_IS(kernel, WENDLAND_C4)) {
        const vreal t = q * (sph_real)0.5, u = v_pos(1 - t), u2 = u * u;
        return SPH_DIM == 1 ? u2 * u2 * u * (1 + t * (5 + 8 * t)) : u2 * u2 * u2 * (3 + t * (18 + 35 * t));
    }
    if (SPH_IS(kernel, CUBIC)) {
        const vreal a = v_pos(2 - q), b = v_pos(1 - q);
        return a * a * a - 4 * (b * b * b);
    }
    if (SPH_IS(kernel, QUARTIC)) {
        const vreal a = v_pos((sph_real)2.5 - q), b = v_pos((sph_real)1.5 - q), c = v_pos((sph_real)0.5 - q);
        return k_sq(a * a) - 5 * k_sq(b * b) + 10 * k_sq(c * c);
    }
    if (SPH_IS(kernel, QUINTIC)) {
        const vreal a = v_pos(3 - q), b = v_pos(2 - q), c = v_pos(1 - q);
        return k_sq(a * a) * a - 6 * (k_sq(b * b) * b) + 15 * (k_sq(c * c) * c);
    }
    if (SPH_IS(kernel, GAUSSIAN))
        return v_where(v_less(q, v_set(3)), k_exp_minus(q * q));
    if (SPH_IS(kernel, HAT))
        return v_pos(1 - q * (sph_real)0.5);
    __builtin_unreachable();
}

#endif
