/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* eos.c: the equations of state in double (Gray 2001 eq 2.25): pressure, the density at a pressure, energy. */
#include "eos.h"
#include "arithmetic.h"

SPH_OBJECT(eos)

#include "dmath.h"

/* (1 + d)^7 - 1, exact for small d */
static __attribute__((noinline)) double seventh(double d)
{
    return d * (7 + d * (21 + d * (35 + d * (35 + d * (21 + d * (7 + d))))));
}

double sph_eos_pressure(uint32_t eos, double scale, double d, bool floor)
{
    double p;
    if (SPH_IS(eos, LINEAR))
        p = scale * d;
    else if (SPH_IS(eos, ISOTHERMAL))
        p = scale * (1 + d);
    else
        p = scale * seventh(d);
    return floor && p < 0 ? 0 : p;
}

double sph_eos_excess(uint32_t eos, double scale, double p)
{
    double y = p / scale;
    if (SPH_IS(eos, LINEAR))
        return y;
    if (SPH_IS(eos, ISOTHERMAL))
        return y - 1;
    if (y < -0.99)
        y = -0.99;
    /* (1 + y)^(1/7) - 1 by Newton; near the root each step squares the error, so the counts reach rounding from these
       guesses. Where y > 1 the guess is a power of two at most twice the root, and a step takes a seventh of it off. */
    double d = y * (1.0 / 7 - y * (3.0 / 49));
    int steps = (y < 0 ? -y : y) < 0.1 ? 2 : 7;
    if (y > 1) {
        d = 1;
        for (double t = 1 + y; t > 128 && d < 1e30; t /= 128)
            d = 2 * d + 1;
        steps = 12;
    }
    for (int i = steps; i > 0; i--) {
        const double f = seventh(d) - y;
        double s2 = (1 + d) * (1 + d), s6 = s2 * s2 * s2;
        d -= f / (7 * s6);
    }
    return d;
}

/* atanh(z) - z = z^3/3 + z^5/5 + ... for |z| <= 1/4, to rounding */
static double atanh_rest(double z)
{
    const double z2 = z * z;
    double sum = 0;
    for (int n = 27; n >= 3; n -= 2)
        sum = sum * z2 + 1.0 / n;
    return sum * z2 * z;
}

/* With z = d/(2 + d): ln s = 2 atanh z, and ln s + 1/s - 1 = 2 (atanh z - z + z^2/(1 + z)), whose parts do not cancel
   near rest. Tait: s^6/6 + 1/s - 7/6 = ((1 + d)^7 - 1 - 7 d)/(6 s). */
double sph_eos_energy(uint32_t eos, double scale, double rho0, double d, bool floor)
{
    const double b = scale / rho0, s = 1 + d, z = d / (2 + d);
    const bool near = (z < 0 ? -z : z) <= 0.25;
    if (SPH_IS(eos, ISOTHERMAL)) /* its pressure is never below 0 */
        return b * (near ? 2 * (z + atanh_rest(z)) : sph_log(s));
    if (floor && d < 0)
        return 0;
    if (SPH_IS(eos, LINEAR))
        return b * (near ? 2 * (atanh_rest(z) + z * z / (1 + z)) : sph_log(s) - d / s);
    return b * d * d * (21 + d * (35 + d * (35 + d * (21 + d * (7 + d))))) / (6 * s);
}
