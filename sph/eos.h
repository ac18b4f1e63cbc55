/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* eos.h: the equations of state in double, of the relative density excess d = (rho - rho0)/rho0 (see SPH_TAIT in
   sph.h). `scale` is rho0 c0^2 (Pa), of TAIT a seventh of it. Sweeps have their own on lanes. */
#ifndef SPH_EOS_H
#define SPH_EOS_H

#include "sph.h"

/* pressure (Pa); floor: at least 0 */
#define sph_eos_pressure SPH_NAME(eos_pressure_)
double sph_eos_pressure(uint32_t eos, double scale, double d, bool floor);
/* the excess at a pressure */
#define sph_eos_excess SPH_NAME(eos_excess_)
double sph_eos_excess(uint32_t eos, double scale, double p);
/* energy of compression from rho0 (J/kg): the integral of p/rho^2 d rho of that pressure */
#define sph_eos_energy SPH_NAME(eos_energy_)
double sph_eos_energy(uint32_t eos, double scale, double rho0, double d, bool floor);

#endif
