/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* groups.c: walls that move or vanish, and held sets that move or are let go: where their group is at a time is what
   its host says.

   Adami's walls want their acceleration too. It follows from the velocities that were told at the ends of the steps so
   far, v, linear between: with tau du/dt = v - u and tau dw/dt = u - w,

     a = 2 a1 - a2,  a1 = (v - u)/tau,  a2 = (u - w)/tau

   where a1 is dv/dt filtered, and a2 filtered once more. Filtered once is s/(1 + tau s), twice s/(1 + tau s)^2 of a
   velocity that goes as exp(s t): together s (1 + 2 tau s)/(1 + tau s)^2 = s (1 - tau^2 s^2 + ...), so that a smooth
   motion has its acceleration to second order in tau, and one that jumps by V gives the impulse V however a step is
   cut.
   Over a step D = z tau, with E = exp(-z), F = (1 - E)/z, and v going from v0 to v1, exactly

     u1 = v1 - (v1 - v0) F + (u0 - v0) E
     w1 = v1 - (v1 - v0)(2 F - E) + (w0 - v0) E + (u0 - v0) z E

   tau is half of what sound takes through h: the quarter of a support of the splines. */
#include "dmath.h"
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(groups)

#if SPH_HAS_GROUPS

/* velocity of a group at time t; nothing that is not finite */
static void velocity_at(const sph_sim *sim, uint32_t g, double t, double *v)
{
    double x[SPH_DIM] = {0};
    memset(v, 0, SPH_DIM * sizeof *v);
    sim->group[g].motion(sim->group[g].ctx, t, x, v);
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = sph_abs(v[k]) < 1e15 ? v[k] : 0;
}

/* at time t of the step under way, and what is to be known of it at the next */
static void find_acceleration(sph_sim *sim, uint32_t g, double t)
{
    const double tau = 0.5 * sim->cfg.smoothing_length / sim->cfg.sound_speed, z = (t - sim->now.time) / tau;
    const double e = sph_exp(-z), f = z > 1e-4 ? (1 - e) / z : 1 - z * (0.5 - z / 6);
    const sph_group_state *old = &sim->now.group[g];
    sph_group_state *s = &sim->next.group[g];
    double v[SPH_DIM];
    velocity_at(sim, g, t, v);
    for (int k = 0; k < SPH_DIM; k++) {
        const double v0 = old->vel[k], rise = z > 0 ? v[k] - v0 : 0;
        const bool known = old->lag[0][k] < SPH_NO_LAG;
        const double once = known ? old->lag[0][k] - v0 : 0, twice = known ? old->lag[1][k] - v0 : 0;
        const double from = z > 0 ? v[k] : known ? v0 : v[k]; /* in no time only the velocity may jump */
        s->lag[0][k] = from - rise * f + once * e;
        s->lag[1][k] = from - rise * (2 * f - e) + (twice + once * z) * e;
        /* exactly 0 where it goes steadily */
        sim->wall_acc[g][k] = (2 * (v[k] - s->lag[0][k]) - (s->lag[0][k] - s->lag[1][k])) / tau;
    }
}

/* a displacement less whole rounds of a periodic axis: at most half of one. Beyond 2^53 rounds: 1e300, refused */
static double within_a_round(const sph_sim *sim, uint32_t k, double x)
{
    const double whole = (double)sim->grid.extent[k] * sim->grid.quantum, rounds = x / whole;
    if (!(sph_abs(rounds) < 9e15))
        return 1e300;
    return x - (double)(int64_t)(rounds < 0 ? rounds - 0.5 : rounds + 0.5) * whole;
}

/* where group g is at time t */
static sph_status move_group(sph_sim *sim, uint32_t g, double t)
{
    sph_group_state *s = &sim->next.group[g];
    double x[SPH_DIM] = {0}, v[SPH_DIM] = {0};
    sim->group[g].motion(sim->group[g].ctx, t, x, v);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const bool round = SPH_IS(sim->cfg.face[k][0], PERIODIC);
        x[k] = round ? within_a_round(sim, k, x[k]) : x[k];
        if (!(sph_abs(x[k]) < 2 * sim->grid.length[k]) || !(sph_abs(v[k]) < 1e15))
            return sph_error(sim, SPH_NOT_FINITE, "motion of a wall", "finite and inside the domain", x[k],
                             SPH_NO_PARTICLE);
        double q = x[k] / sim->grid.quantum, leap = sph_abs(q - (double)s->moved[k]) * sim->grid.quantum;
        if (leap >= sim->grid.length[k] && !round)
            return sph_error(sim, SPH_MOVED_TOO_FAR, "motion of a wall", "less than the domain's length in a step",
                             leap, SPH_NO_PARTICLE);
        s->moved[k] = (sph_pos)(q < 0 ? q - 0.5 : q + 0.5);
        s->vel[k] = v[k];
    }
    return SPH_OK;
}

sph_status sph_move_groups(sph_sim *sim, double t, bool moves)
{
    for (uint32_t g = 0; g < sim->groups; g++) {
        sph_group_state *s = &sim->next.group[g];
        if (moves && t >= s->remove_at)
            s->removed = 1;
        if (!sim->group[g].motion || s->removed)
            continue;
        if (SPH_WITH_MOVING_WALLS && sim->has_adami)
            find_acceleration(sim, g, t);
        const sph_status st = moves ? move_group(sim, g, t) : SPH_OK;
        if (st)
            return st;
    }
    return SPH_OK;
}

#endif
