/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* weights.c: the smoothing kernels, piece by piece as the books print them, q = r/h.
     cubic      Monaghan & Lattanzio 1985 (Gray 2001 eq 2.4), support 2
     quartic, quintic  B-splines of Schoenberg 1946 (Powell 2012 A.2, A.4), supports 2.5, 3
     gaussian   exp(-q^2) cut at 3 and normalised anew
     Wendland   1995: psi_2,1 and psi_3,2 in 1-D, psi_3,1 and psi_4,2 (of q/2) in 2-D and 3-D, support 2
     hat        1 - q/2, support 2 (Powell 3.60)
   The norms are integrals of these shapes, found here by Simpson's rule and not taken from a table. */
#include "oracle.h"

double o_weight_support(uint32_t kernel)
{
    switch (kernel) {
    case SPH_QUARTIC: return 2.5;
    case SPH_QUINTIC:
    case SPH_GAUSSIAN: return 3;
    default: return 2;
    }
}

static double power(double x, int n)
{
    double p = 1;
    while (n-- > 0)
        p *= x;
    return p;
}

static double wendland_c2(double u) /* u = q/2 < 1 */
{
    return SPH_DIM == 1 ? power(1 - u, 3) * (1 + 3 * u) : power(1 - u, 4) * (1 + 4 * u);
}
static double wendland_c4(double u)
{
    return SPH_DIM == 1 ? power(1 - u, 5) * (1 + 5 * u + 8 * u * u) : power(1 - u, 6) * (3 + 18 * u + 35 * u * u);
}
/* their derivatives: products of a power and a polynomial, differentiated by the rule */
static double wendland_c2_slope(double u)
{
    return SPH_DIM == 1 ? -3 * power(1 - u, 2) * (1 + 3 * u) + 3 * power(1 - u, 3)
                        : -4 * power(1 - u, 3) * (1 + 4 * u) + 4 * power(1 - u, 4);
}
static double wendland_c4_slope(double u)
{
    return SPH_DIM == 1 ? -5 * power(1 - u, 4) * (1 + 5 * u + 8 * u * u) + power(1 - u, 5) * (5 + 16 * u)
                        : -6 * power(1 - u, 5) * (3 + 18 * u + 35 * u * u) + power(1 - u, 6) * (18 + 70 * u);
}

static double cubic(double q)
{
    return q < 1 ? 1 - 1.5 * q * q + 0.75 * power(q, 3) : 0.25 * power(2 - q, 3);
}
static double cubic_slope(double q) { return q < 1 ? -3 * q + 2.25 * q * q : -0.75 * power(2 - q, 2); }

static double quartic(double q)
{
    if (q < 0.5)
        return power(2.5 - q, 4) - 5 * power(1.5 - q, 4) + 10 * power(0.5 - q, 4);
    return q < 1.5 ? power(2.5 - q, 4) - 5 * power(1.5 - q, 4) : power(2.5 - q, 4);
}
static double quartic_slope(double q) /* near 0 expanded: 24 q^3 - 60 q */
{
    if (q < 0.5)
        return 24 * power(q, 3) - 30 * q;
    return q < 1.5 ? -4 * power(2.5 - q, 3) + 20 * power(1.5 - q, 3) : -4 * power(2.5 - q, 3);
}

static double quintic(double q)
{
    if (q < 1)
        return power(3 - q, 5) - 6 * power(2 - q, 5) + 15 * power(1 - q, 5);
    return q < 2 ? power(3 - q, 5) - 6 * power(2 - q, 5) : power(3 - q, 5);
}
static double quintic_slope(double q) /* near 0 expanded */
{
    if (q < 1)
        return -120 * q + 120 * power(q, 3) - 50 * power(q, 4);
    return q < 2 ? -5 * power(3 - q, 4) + 30 * power(2 - q, 4) : -5 * power(3 - q, 4);
}

/* W without its norm */
static double shape(uint32_t kernel, double q)
{
    if (q >= o_weight_support(kernel))
        return 0;
    switch (kernel) {
    case SPH_CUBIC: return cubic(q);
    case SPH_QUARTIC: return quartic(q);
    case SPH_QUINTIC: return quintic(q);
    case SPH_GAUSSIAN: return exp(-q * q);
    case SPH_WENDLAND_C2: return wendland_c2(q / 2);
    case SPH_WENDLAND_C4: return wendland_c4(q / 2);
    default: return 1 - q / 2;
    }
}
static double shape_slope(uint32_t kernel, double q)
{
    if (q >= o_weight_support(kernel))
        return 0;
    switch (kernel) {
    case SPH_CUBIC: return cubic_slope(q);
    case SPH_QUARTIC: return quartic_slope(q);
    case SPH_QUINTIC: return quintic_slope(q);
    case SPH_GAUSSIAN: return -2 * q * exp(-q * q);
    case SPH_WENDLAND_C2: return wendland_c2_slope(q / 2) / 2;
    case SPH_WENDLAND_C4: return wendland_c4_slope(q / 2) / 2;
    default: return -0.5;
    }
}

/* the integral of a shape over all space, h = 1: Simpson's rule on each piece of half a unit, on which it is smooth */
static double integral(uint32_t kernel)
{
    const double support = o_weight_support(kernel);
    double sum = 0;
    for (double piece = 0; piece < support; piece += 0.5) {
        const int n = 2000;
        const double step = 0.5 / n;
        for (int k = 0; k <= n; k++) {
            const double q = piece + k * step, edge = q >= support ? support * (1 - 1e-16) : q;
            const double area = SPH_DIM == 1 ? 2 : SPH_DIM == 2 ? 2 * O_PI * q : 4 * O_PI * q * q;
            sum += area * shape(kernel, edge) * step / 3 * (k == 0 || k == n ? 1 : k % 2 ? 4 : 2);
        }
    }
    return sum;
}
static double norm(uint32_t kernel)
{
    static double known[SPH_KERNELS];
    if (!(known[kernel] > 0))
        known[kernel] = 1 / integral(kernel);
    return known[kernel];
}

double o_weight(uint32_t kernel, double r, double h) { return norm(kernel) * shape(kernel, r / h) / power(h, SPH_DIM); }
double o_weight_slope(uint32_t kernel, double r, double h)
{
    return norm(kernel) * shape_slope(kernel, r / h) / power(h, SPH_DIM + 1);
}
