/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* states.c: equations of state, s = rho/rho0 = 1 + d (sph.h):
     Tait        p = (rho0 c0^2/7) (s^7 - 1)       Gray's print of it  p = rho0 c0^2 (s^7 - 1)    (Gray 2001 eq 2.25)
     linear      p = c0^2 (rho - rho0)  (Gray 5.11)    isothermal  p = c0^2 rho  (Gray 7.1)
   and the energy of compression, the integral of p/rho^2 d rho from rho0 on, of the pressure that acts: with a floor
   nothing is stored where p would be negative.
     Tait        (B/rho0) (s^6/6 + 1/s - 7/6)      linear  c0^2 (ln s + 1/s - 1)      isothermal  c0^2 ln s
   Stress: sigma = -p I + S; where it is damaged (1 - D) S, and (1 - D) p in tension (Gray 2001 eqs 5.33, 5.34). */
#include "oracle.h"

/* the pressure scale of s^7 - 1 */
static double tait_scale(uint32_t eos, double rho0, double c0)
{
    return eos == SPH_TAIT ? rho0 * c0 * c0 / 7 : rho0 * c0 * c0;
}

double o_pressure(uint32_t eos, double rho0, double c0, double d)
{
    if (eos == SPH_LINEAR)
        return c0 * c0 * rho0 * d;
    if (eos == SPH_ISOTHERMAL)
        return c0 * c0 * rho0 * (1 + d);
    return tait_scale(eos, rho0, c0) * expm1(7 * log1p(d));
}

double o_energy(uint32_t eos, double rho0, double c0, double d, bool floor)
{
    const double s = 1 + d;
    if (floor && d < 0 && eos != SPH_ISOTHERMAL)
        return 0;
    if (eos == SPH_LINEAR)
        return c0 * c0 * (log1p(d) - d / s);
    if (eos == SPH_ISOTHERMAL)
        return c0 * c0 * log1p(d);
    return tait_scale(eos, rho0, c0) / rho0 * (pow(s, 6) / 6 + 1 / s - 7.0 / 6);
}

double o_excess_at(uint32_t eos, double rho0, double c0, double p)
{
    if (eos == SPH_LINEAR)
        return p / (rho0 * c0 * c0);
    if (eos == SPH_ISOTHERMAL)
        return p / (rho0 * c0 * c0) - 1;
    /* no density has a pressure below -B; what is asked for near it is answered with that of -0.99 B */
    return expm1(log1p(o_max(p / tait_scale(eos, rho0, c0), -0.99)) / 7);
}

double o_sound(uint32_t eos, double c0) { return eos == SPH_TAIT_GRAY ? sqrt(7) * c0 : c0; }

static void refresh(const o_scene *s, o_particle *p)
{
    const o_set *set = &s->set[p->set];
    const bool solid = set->role == SPH_ROLE_SOLID;
    const double damage = pow(p->root, SPH_DIM);
    p->rho = set->rho0 * (1 + p->d);
    p->p = o_pressure(set->eos, set->rho0, set->c0, p->d);
    if (s->cfg.pressure_floor && !solid)
        p->p = o_max(p->p, 0);
    p->p += p->quiet;
    if (s->cfg.pressure_floor && !solid)
        p->p = o_max(p->p, 0);
    p->c = set->c0;
    const double acts = p->p < 0 ? (1 - damage) * p->p : p->p;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            p->sigma[k][l] = (solid ? (1 - damage) * p->dev[k][l] : 0) - (k == l ? acts : 0);
}

void o_refresh(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++)
        refresh(s, &s->own[i]);
    o_copies(s);
}
