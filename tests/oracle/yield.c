/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* yield.c: von Mises' yield, q = sqrt(3 J2), J2 = S:S/2, Y = yield + hardening * plastic strain (sph.h, SPH_VON_MISES):
     where q > Y   strain = (q - Y)/(3 mu + hardening), S' = S (Y + hardening strain)/q: on the risen yield surface
     printed       S' = S Y^2/(3 J2) with J2 without its zz part (Gray 2001 eqs 5.14, 5.15); the plastic strain is that
                   of the elastic strain which S loses, (q - q')/(3 mu) */
#include "oracle.h"

static void restrain(const o_scene *s, o_particle *p)
{
    const o_set *set = &s->set[p->set];
    const bool printed = s->cfg.yield == SPH_VON_MISES_GRAY;
    double square = 0;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            if (!printed || (k < (SPH_DIM == 3 ? 3 : SPH_DIM) && l < (SPH_DIM == 3 ? 3 : SPH_DIM)))
                square += p->dev[k][l] * p->dev[k][l];
    const double q = sqrt(1.5 * square), y = set->yield + set->hardening * p->plastic;
    if (q <= y)
        return;
    const double strain = printed ? (q - y * y / q) / (3 * set->shear) : (q - y) / (3 * set->shear + set->hardening);
    const double f = printed ? y * y / (q * q) : (y + set->hardening * strain) / q;
    p->plastic += strain;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            p->dev[k][l] *= f;
}

void o_yield_from(const o_scene *s, o_particle *p, const double (*from)[3])
{
    o_particle one = *p, two = *p;
    if (s->cfg.yield == SPH_NO_YIELD || !o_is_solid(s, p) || !(s->set[p->set].yield > 0))
        return;
    restrain(s, &one);
    for (int k = 0; k < 9; k++)
        two.dev[k / 3][k % 3] = 0.5 * (from[k / 3][k % 3] + p->dev[k / 3][k % 3]);
    restrain(s, &two);
    for (int k = 0; k < 9; k++)
        two.dev[k / 3][k % 3] += 0.5 * (p->dev[k / 3][k % 3] - from[k / 3][k % 3]);
    restrain(s, &two);
    const bool printed = s->cfg.yield == SPH_VON_MISES_GRAY;
    for (int k = 0; k < 9; k++)
        p->dev[k / 3][k % 3] = (printed ? 0 : 2 * two.dev[k / 3][k % 3]) + (printed ? 1 : -1) * one.dev[k / 3][k % 3];
    p->plastic = printed ? one.plastic : o_max(2 * two.plastic - one.plastic, p->plastic);
    if (!printed)
        restrain(s, p);
}

void o_yield(o_scene *s)
{
    for (uint32_t i = 0; i < s->n && s->cfg.yield != SPH_NO_YIELD; i++)
        if (o_is_solid(s, &s->own[i]) && s->set[s->own[i].set].yield > 0)
            restrain(s, &s->own[i]);
    o_refresh(s);
}
