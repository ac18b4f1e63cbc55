/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* eos_lanes.h: the equations of state on lanes, as the sweep needs them; in double: eos.c. */
#ifndef SPH_EOS_LANES_H
#define SPH_EOS_LANES_H

#include "lanes.h"

/* Pressure (Pa) from the relative density excess d = (rho - rho0)/rho0 and the pressure scale b (Pa): Tait b (s^7 -
   1) in Horner form, exact for small d; linear b d; isothermal b (1 + d). floor: p >= 0. (Gray 2001 eqs 2.25, 5.11,
   7.1) */
SPH_INLINE vreal sph_pressure_of(uint32_t eos, bool floor, vreal b, vreal d)
{
    vreal p;
    if (SPH_IS(eos, LINEAR))
        p = b * d;
    else if (SPH_IS(eos, ISOTHERMAL))
        p = b * (1 + d);
    else
        p = b * (d * (7 + d * (21 + d * (35 + d * (35 + d * (21 + d * (7 + d)))))));
    return floor ? v_pos(p) : p;
}

#endif
