/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* riemann.c: see riemann.h. A wave into the state (rho, p, c) that leaves the pressure q behind it changes the velocity
   by f(q) (Toro 4.6, 4.7):
     shock, q > p     (q - p) sqrt(A/(q + B)), A = 2/((gamma + 1) rho), B = p (gamma - 1)/(gamma + 1)
     rarefaction      2c/(gamma - 1) ((q/p)^((gamma - 1)/(2 gamma)) - 1)
   f rises with q, and the pressure between the waves is the root of f_left + f_right + v_right - v_left (4.5). */
#include "riemann.h"

#include "../../sph/dmath.h"

static double sound(double gamma, const gas_state *s) { return __builtin_sqrt(gamma * s->p / s->rho); }

static double change(double g, const gas_state *s, double q)
{
    if (q > s->p)
        return (q - s->p) * __builtin_sqrt(2 / ((g + 1) * s->rho) / (q + s->p * (g - 1) / (g + 1)));
    return 2 * sound(g, s) / (g - 1) * (sph_pow(q / s->p, (g - 1) / (2 * g)) - 1);
}

/* density behind a wave, and the speeds of its edges; sign: -1 of a wave to the left */
static double behind(const riemann *r, const gas_state *s, double sign, double *edge)
{
    const double g = r->gamma, ratio = r->p / s->p, c = sound(g, s), k = (g - 1) / (g + 1);
    if (ratio > 1) {
        edge[0] = edge[1] = s->v + sign * c * __builtin_sqrt((g + 1) / (2 * g) * ratio + (g - 1) / (2 * g));
        return s->rho * (ratio + k) / (k * ratio + 1);
    }
    const double rho = s->rho * sph_pow(ratio, 1 / g);
    edge[0] = s->v + sign * c;
    edge[1] = r->v + sign * __builtin_sqrt(g * r->p / rho);
    return rho;
}

riemann riemann_solve(double gamma, gas_state left, gas_state right)
{
    riemann r = {.gamma = gamma, .side = {left, right}};
    double low = 0, high = left.p > right.p ? left.p : right.p;
    const double gap = right.v - left.v;
    while (change(gamma, &left, high) + change(gamma, &right, high) + gap < 0 && high < 1e30)
        high *= 2;
    for (int k = 0; k < 200; k++) {
        r.p = 0.5 * (low + high);
        if (change(gamma, &left, r.p) + change(gamma, &right, r.p) + gap < 0)
            low = r.p;
        else
            high = r.p;
    }
    r.v = 0.5 * (left.v + right.v + change(gamma, &right, r.p) - change(gamma, &left, r.p));
    r.rho[0] = behind(&r, &left, -1, r.wave[0]);
    r.rho[1] = behind(&r, &right, 1, r.wave[1]);
    return r;
}

gas_state riemann_at(const riemann *r, double s)
{
    const int k = s > r->v;
    const double sign = k ? 1 : -1, g = r->gamma, out = sign * (s - r->wave[k][0]), in = sign * (s - r->wave[k][1]);
    const gas_state *own = &r->side[k];
    if (out >= 0)
        return *own;
    if (in <= 0)
        return (gas_state){r->rho[k], r->v, r->p};
    /* within a rarefaction (4.56, 4.63) */
    const double c = sound(g, own), part = 2 / (g + 1) - sign * (g - 1) / ((g + 1) * c) * (own->v - s);
    const gas_state inside = {own->rho * sph_pow(part, 2 / (g - 1)),
                              2 / (g + 1) * (-sign * c + (g - 1) / 2 * own->v + s),
                              own->p * sph_pow(part, 2 * g / (g - 1))};
    return inside;
}
