/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* riemann.h: the exact solution of a shock tube: an ideal gas with one state on the left and one on the right of x = 0,
   let go at t = 0 (Toro 2009, Riemann solvers and numerical methods for fluid dynamics, chapter 4). */
#ifndef EXAMPLES_RIEMANN_H
#define EXAMPLES_RIEMANN_H

#include "../../sph/sph.h"

typedef struct gas_state {
    double rho, v, p; /* kg/m^3, m/s, Pa */
} gas_state;

typedef struct riemann {
    double gamma;
    gas_state side[2];         /* left, right */
    double p, v, rho[2];       /* between the waves: pressure, velocity, density left and right of the contact */
    double wave[2][2];         /* m/s: of each side its wave's outer and inner edge; equal: a shock */
} riemann;

/* both states must be gas (density and pressure above 0) that leave no vacuum between them */
#define riemann_solve SPH_NAME(riemann_solve)
riemann riemann_solve(double gamma, gas_state left, gas_state right);
/* the state at x/t = s (m/s) */
#define riemann_at SPH_NAME(riemann_at)
gas_state riemann_at(const riemann *r, double s);

#endif
