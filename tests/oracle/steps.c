/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* steps.c: whole steps dt from t, u: XSPH's velocity, index h: the middle of the step. Places that went with u of the
   beginning go dt/2 (u' - u) more at the end.
     predictor-corrector  x' = x + dt (v + u) + dt^2/2 a, v_p = v + dt a, rho_p = rho + dt r, forces there,
                          v' = v_p + dt/2 (a' - a), rho' = rho + dt/2 (r + r')                    (Gray 2001 2.26-2.28)
                          in fluids rho_p also has dt (dt/dt_o) e, e = half of what r rose by in the step before
     kick-drift-kick      v_h = v + dt/2 a, x' = x + dt (v_h + u), rho_h = rho + dt/2 r_o; rates r of x' - dt/2 v_h,
                          v_h, rho_h; rho' = rho + dt r; forces of x', rho', v_h + dt/2 a; v' = v_h + dt/2 a'
     leap-frog            the same with v_h = v + (dt - dt_o)/2 a for v, which is that of a middle, and v' = v_h + dt a'
                          (Powell 2012 eq 1.40)
     Runge-Kutta          forces at t; all of it half a step on; forces there; x' = x + dt (v_h + u_h), and v, rho by a
                          whole step with them                  (Wickramarachchi 2009 3.85-3.87, 3.91-3.92: one rule)
   Energies and stresses go as densities do; stresses return to the yield surface wherever they have gone. What moves as
   it is told is where its motion says at each of these times. Damage grows with them, by what the strain was at the
   step's beginning. At the end of a step XSPH in the velocity, damping by a rate, sponges, then shifting. Damper:
   damper.c. Faces: periodic ones let in on the other side; a plane of symmetry
   takes the mirrored particle instead, with all that it has: place, reference position, velocity, stress, and their
   rates. A no-slip mirror throws it back: what has a direction turns
   along its normal, but the shear stress on the plane, which goes on through it, stays. */
#include <stdlib.h>
#include <string.h>

#include "oracle.h"

/* what a step remembers of its beginning */
typedef struct beginning {
    double x[3], v[3], d, rest[3], dev[3][3], plastic;
    double a[3], u[3], rate, dev_rate[3][3]; /* rate: of the excess d, 1/s */
    double u_state, u_rate;
    double rise;
    double root[2]; /* damage half a step and a step later */
    bool turned[3], mirrored[3]; /* by a mirror since: vectors; tensors too */
    double energy; /* J */
} beginning;
static beginning *was;
static double last;

static double half(double dt) { return 0.5 * dt; }
static bool is_held(const o_scene *s, const o_particle *p, int k)
{
    return o_is_solid(s, p) && s->set[p->set].held >> k & 1;
}
static bool evolves(const o_scene *s, const o_particle *p)
{
    return (o_is_body(s, p) || s->set[p->set].compressible) && s->cfg.density == SPH_CONTINUITY;
}

/* the rates that stand become those of the beginning */
static void remember_rates(const o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        beginning *b = &was[i];
        b->rate = evolves(s, p) ? p->rate.v / s->set[p->set].rho0 : 0;
        b->u_rate = p->warmed.v;
        for (int k = 0; k < 3; k++) {
            b->a[k] = p->a[k].v;
            b->u[k] = o_drifts(s) ? p->drift[k].v : 0;
            for (int l = 0; l < 3; l++)
                b->dev_rate[k][l] = o_is_solid(s, p) ? p->stress_rate[k][l].v : 0;
        }
    }
}
static void remember_state(const o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) {
        const o_particle *p = &s->own[i];
        beginning *b = &was[i];
        memcpy(b->x, p->x, sizeof b->x);
        memcpy(b->v, p->v, sizeof b->v);
        memcpy(b->rest, p->rest, sizeof b->rest);
        memcpy(b->dev, p->dev, sizeof b->dev);
        memset(b->turned, 0, sizeof b->turned);
        memset(b->mirrored, 0, sizeof b->mirrored);
        b->d = p->d;
        b->u_state = p->u;
        b->plastic = p->plastic;
        b->energy = o_is_body(s, p) ? o_energy_of(s, p) : 0;
    }
}

/* power of walls and of what holds flows, W */
static o_sum walls_power(const o_scene *s)
{
    o_sum sum = {0, 0};
    for (uint32_t i = 0; i < s->n; i++) {
        const double m = s->set[s->own[i].set].mass;
        if (o_is_body(s, &s->own[i]))
            o_add(&sum, m * s->own[i].worked.v, m * s->own[i].worked.s);
    }
    return sum;
}

void o_begin_steps(o_scene *s, uint32_t room)
{
    room = s->cfg.max_flows ? s->cfg.max_particles : room;
    was = realloc(was, (room + 1) * sizeof *was);
    if (!was)
        abort();
    memset(was, 0, room * sizeof *was);
    last = 0;
    s->removed_mass = s->added_mass = s->fed = s->wall_work = (o_sum){0, 0};
    s->let_out = s->standing = s->needed = 0;
    s->next_id = s->cfg.max_particles; /* before 0 */
    s->wall_power = walls_power(s);
    s->shifted = s->carried_off = s->put_back_loss = (o_sum){0, 0};
    s->quieted = s->slowed = s->evened = (o_sum){0, 0};
    s->left = s->crossed = s->put_back = 0;
    remember_rates(s);
}

/* ---- what moves as it is told ---- */

void o_told(const o_set *set, double t, double *x, double *v)
{
    const sph_table *m = set->table;
    for (int a = 0; a < 3; a++) {
        x[a] = set->start[a] * t + 0.5 * set->accel[a] * t * t;
        v[a] = set->start[a] + set->accel[a] * t;
    }
    for (uint32_t r = 0; m && r + 1 < m->rows; r++) {
        const double speed = (m->x[r + 1] - m->x[r]) / (m->t[r + 1] - m->t[r]);
        const double gone = o_min(o_max(t, m->t[r]), m->t[r + 1]) - m->t[r];
        x[m->axis] += speed * gone;
        if (t >= m->t[r] && t < m->t[r + 1])
            v[m->axis] = speed;
    }
}

/* Accelerations of Adami's walls at time t of the step that began at t0, from what had been filtered till then, with
   velocities on a line between; by the classical Runge-Kutta rule in small steps. To keep: it is the step's end. */
static void filter(o_scene *s, double t0, double t, bool keep)
{
    enum { PARTS = 400 };
    const double tau = 0.5 * s->cfg.smoothing_length / s->cfg.sound_speed, d = (t - t0) / PARTS;
    for (uint32_t k = 0; k < s->sets; k++)
        for (int a = 0; a < SPH_DIM; a++) {
            o_set *set = &s->set[k];
            double x[3], v0[3], v1[3], u = set->once[a], w = set->twice[a];
            o_told(set, t0, x, v0);
            o_told(set, t, x, v1);
            for (int part = 0; part < PARTS; part++) {
                double du[5] = {0}, dw[5] = {0};
                for (int g = 1; g < 5; g++) {
                    const double share = g == 1 ? 0 : g == 4 ? 1 : 0.5;
                    const double v = v0[a] + (v1[a] - v0[a]) * (part + share) / PARTS;
                    const double uu = u + share * d * du[g - 1], ww = w + share * d * dw[g - 1];
                    du[g] = (v - uu) / tau;
                    dw[g] = (uu - ww) / tau;
                }
                u += d * (du[1] + 2 * du[2] + 2 * du[3] + du[4]) / 6;
                w += d * (dw[1] + 2 * dw[2] + 2 * dw[3] + dw[4]) / 6;
            }
            set->push[a] = (2 * v1[a] - 3 * u + w) / tau;
            if (keep)
                set->once[a] = u, set->twice[a] = w;
        }
}

/* places at time t; velocities as given: at t, or the mean of a step before t */
static void tell(o_scene *s, double t, double dt_of_mean)
{
    for (uint32_t k = 0; k < s->sets; k++) {
        o_set *set = &s->set[k];
        double to[3], v[3], from[3], before[3];
        o_told(set, t, to, v);
        o_told(set, t - dt_of_mean, from, before);
        for (int a = 0; a < SPH_DIM; a++) {
            set->origin[a] += to[a] - set->moved[a];
            set->moved[a] = to[a];
            set->velocity[a] = dt_of_mean > 0 ? (to[a] - from[a]) / dt_of_mean : v[a];
        }
    }
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        const o_set *set = &s->set[p->set];
        for (int k = 0; k < SPH_DIM; k++) {
            p->wall[k] = p->seen[k] = set->velocity[k];
            p->origin[k] = set->origin[k];
            if (o_is_body(s, p) && !is_held(s, p, k))
                continue;
            p->x[k] = p->home[k] + set->moved[k];
            p->v[k] = set->velocity[k];
        }
    }
}

/* ---- faces ---- */

/* a mirror of axis k takes a particle, and what it was accelerated by */
void o_turn_round(o_particle *p, int k, double plane, bool tensors)
{
    p->x[k] = 2 * plane - p->x[k];
    p->rest[k] = 2 * plane - p->rest[k];
    p->v[k] = -p->v[k];
    p->a[k].v = -p->a[k].v;
    p->drift[k].v = -p->drift[k].v;
    p->slant[k] = -p->slant[k];
    for (int l = 0; l < 3 && tensors; l++) {
        if (l == k)
            continue;
        p->dev[k][l] = p->dev[l][k] = -p->dev[k][l];
        p->stress_rate[k][l].v = p->stress_rate[l][k].v = -p->stress_rate[k][l].v;
    }
}

/* those who are gone are taken out of the list, and of what is remembered; at a step's end their ids stay taken */
static void forget_the_gone(o_scene *s, bool at_end)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < s->n; i++) {
        if (s->own[i].gone && at_end && s->standing < O_MAX_STANDING)
            s->stands[s->standing++] = s->own[i].id;
        if (s->own[i].gone)
            continue;
        s->own[n] = s->own[i];
        was[n++] = was[i];
    }
    s->n = n;
}

static void leave(o_scene *s, o_particle *p, const beginning *b)
{
    p->gone = true;
    s->left++;
    o_plus(&s->removed_mass, s->set[p->set].mass);
    o_plus(&s->carried_off, b->energy + p->lost);
}

static void pass_faces(o_scene *s, bool at_end)
{
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        beginning *b = &was[i];
        for (int k = 0; k < SPH_DIM && o_is_body(s, p) && !p->gone; k++) {
            const double lo = s->cfg.lo[k], hi = s->cfg.hi[k], length = hi - lo;
            o_close(s, "a particle on a face", p->x[k], lo, (SPH_DOUBLE ? 1 : 0.02) * s->cfg.spacing);
            o_close(s, "a particle on a face", p->x[k], hi, (SPH_DOUBLE ? 1 : 0.02) * s->cfg.spacing);
            const bool low = p->x[k] < lo;
            if (!low && p->x[k] < hi)
                continue;
            const uint32_t face = s->cfg.face[k][!low];
            if (is_held(s, p, k))
                s->undecided = "a held particle leaves";
            if (face == SPH_OPEN) {
                leave(s, p, b);
            } else if (face == SPH_PERIODIC) {
                const double way = low ? length : -length;
                p->x[k] += way;
                p->rest[k] += way;
            } else {
                o_turn_round(p, k, low ? lo : hi, face == SPH_SYMMETRY);
                b->turned[k] = !b->turned[k];
                b->mirrored[k] = b->mirrored[k] != (face == SPH_SYMMETRY);
            }
        }
    }
    forget_the_gone(s, at_end);
}
/* component k of a vector of the beginning, in the frame that mirrors have turned since */
static double turned(const beginning *b, int k, double v) { return b->turned[k] ? -v : v; }
/* component kl of a tensor, likewise */
static double mirrored(const beginning *b, int k, int l, double v)
{
    return k != l && b->mirrored[k] != b->mirrored[l] ? -v : v;
}

/* ---- pieces of steps ---- */

/* what inflows and outflows carry has its velocity and density again */
static void hold(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        if (!o_is_carried(s, p))
            continue;
        p->d = p->held_d;
        for (int k = 0; k < SPH_DIM; k++)
            p->v[k] = turned(&was[i], k, p->held_v[k]);
    }
}

static void foresee_damage(o_scene *s, double dt, uint32_t (*flaws_of)(uint32_t id, float *threshold))
{
    for (uint32_t i = 0; i < s->n; i++) {
        float flaw[O_MAX_FLAWS];
        const o_particle *p = &s->own[i];
        const bool grows = s->cfg.damage && o_is_solid(s, p);
        const uint32_t flaws = grows ? flaws_of(p->id, flaw) : 0;
        for (int k = 0; k < 2; k++)
            was[i].root[k] = grows ? o_grown_root(s, p, flaw, flaws, half((1 + k) * dt)) : p->root;
    }
}

static void restrain(o_scene *s)
{
    for (uint32_t i = 0; i < s->n; i++) { /* yielding starts from what had yielded at the beginning of a whole step */
        double from[3][3];
        for (int k = 0; k < 9; k++)
            from[k / 3][k % 3] = mirrored(&was[i], k / 3, k % 3, was[i].dev[k / 3][k % 3]);
        s->own[i].plastic = was[i].plastic;
        o_yield_from(s, &s->own[i], (const double(*)[3])from);
    }
    o_refresh(s);
}

/* places, velocities, densities and stresses by shares of the step from what was */
static void go(o_scene *s, double drift, double bend, double kick, double rate)
{
    const double damping = s->cfg.damping;
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        const beginning *b = &was[i];
        for (int k = 0; k < SPH_DIM && o_is_body(s, p); k++)
            if (!is_held(s, p, k)) {
                const double way = drift * (b->v[k] + b->u[k]) + bend * b->a[k];
                p->x[k] = b->x[k] + way;
                p->v[k] = b->v[k] + kick * b->a[k];
                if (s->cfg.integrator == SPH_PREDICTOR_CORRECTOR || s->cfg.integrator == SPH_KICK_DRIFT_KICK)
                    p->v[k] *= damping;
            }
        if (evolves(s, p))
            p->d = b->d + rate * b->rate;
        p->u = b->u_state + rate * b->u_rate;
        p->root = b->root[s->cfg.integrator == SPH_PREDICTOR_CORRECTOR];
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                p->dev[k][l] = b->dev[k][l] + rate * b->dev_rate[k][l];
    }
    pass_faces(s, false);
    o_change_sets(s);
    hold(s);
    restrain(s);
}

static void find_density(o_scene *s, uint32_t number)
{
    o_refresh(s);
    if (s->cfg.density == SPH_SUMMATION)
        o_sum_density(s);
    if (s->cfg.shepard_every && number % s->cfg.shepard_every == 0)
        o_filter_density(s);
    hold(s);
}

/* what evolves by a whole step of the rates that stand, from what was */
static void go_whole(o_scene *s, double dt)
{
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        p->root = was[i].root[1];
        p->u = was[i].u_state + dt * p->warmed.v;
        if (evolves(s, p))
            p->d = was[i].d + dt * p->rate.v / s->set[p->set].rho0;
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                p->dev[k][l] = mirrored(&was[i], k, l, was[i].dev[k][l]) +
                               (o_is_solid(s, p) ? dt * p->stress_rate[k][l].v : 0);
    }
    restrain(s);
}

/* places went with u of the beginning: dt/2 (u' - u) more */
static void mend_drift(o_scene *s, double dt)
{
    for (uint32_t i = 0; i < s->n && o_drifts(s); i++)
        for (int k = 0; k < SPH_DIM && o_is_body(s, &s->own[i]); k++)
            if (!is_held(s, &s->own[i], k))
                s->own[i].x[k] += half(dt) * (s->own[i].drift[k].v - turned(&was[i], k, was[i].u[k]));
    pass_faces(s, true);
}

/* ---- the integrators ---- */

static void predict_correct(o_scene *s, uint32_t number, double dt)
{
    const bool foresees = !o_has_solids(s);
    const double foresight = dt < 2 * last ? dt * (dt / last) : 2 * dt;
    tell(s, s->time + dt, 0);
    filter(s, s->time, s->time + dt, true);
    go(s, dt, half(dt * dt), dt, dt);
    for (uint32_t i = 0; i < s->n; i++)
        if (foresees && evolves(s, &s->own[i]))
            s->own[i].d += foresight * was[i].rise;
    hold(s);
    for (uint32_t i = 0; i < s->n; i++)
        o_quiet(s, &s->own[i], was[i].rate + 2 * was[i].rise * (dt < 2 * last ? dt / last : 2));
    s->time += dt;
    find_density(s, number);
    o_forces(s);
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        beginning *b = &was[i];
        for (int k = 0; k < SPH_DIM && o_is_body(s, p); k++)
            if (!is_held(s, p, k))
                p->v[k] = s->cfg.damping * (p->v[k] + half(dt) * (p->a[k].v - turned(b, k, b->a[k])));
        p->u += half(dt) * (p->warmed.v - b->u_rate);
        if (evolves(s, p)) {
            const double rise = p->rate.v / s->set[p->set].rho0 - b->rate;
            p->d += half(dt) * rise - (foresees ? foresight * b->rise : 0);
            b->rise = half(rise);
        }
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3 && o_is_solid(s, p); l++)
                p->dev[k][l] += half(dt) * (p->stress_rate[k][l].v - mirrored(b, k, l, b->dev_rate[k][l]));
    }
    o_yield(s);
    mend_drift(s, dt);
}

/* kick-drift-kick; and leap-frog, whose velocity is ahead */
static void kick_drift(o_scene *s, uint32_t number, double dt)
{
    const bool leaps = s->cfg.integrator == SPH_LEAP_FROG;
    const double kick = leaps ? half(dt - last) : half(dt);
    tell(s, s->time + dt, dt);
    filter(s, s->time, s->time + half(dt), false);
    go(s, dt, dt * kick, kick, half(dt));
    for (uint32_t i = 0; i < s->n; i++) /* the damper acts in sums of forces */
        s->own[i].quiet = 0;
    for (uint32_t i = 0; i < s->n; i++) /* rates: places of the middle */
        for (int k = 0; k < SPH_DIM; k++)
            s->own[i].x[k] -= half(dt) * (s->own[i].v[k] + turned(&was[i], k, was[i].u[k]));
    o_forces(s);
    for (uint32_t i = 0; i < s->n; i++)
        s->own[i].middle_rate = s->own[i].rate;
    for (uint32_t i = 0; i < s->n; i++)
        for (int k = 0; k < SPH_DIM; k++)
            s->own[i].x[k] += half(dt) * (s->own[i].v[k] + turned(&was[i], k, was[i].u[k]));
    go_whole(s, dt);
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        beginning *b = &was[i];
        b->u_rate = p->warmed.v;
        b->rise = evolves(s, p) ? p->rate.v / s->set[p->set].rho0 : 0; /* what the next step begins with */
        o_quiet(s, p, b->rise + (b->rise - b->rate) * dt / (dt + last));
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                b->dev_rate[k][l] = o_is_solid(s, p) ? p->stress_rate[k][l].v : 0;
        memset(b->mirrored, 0, sizeof b->mirrored); /* this rate is of the frame of the end so far */
        for (int k = 0; k < SPH_DIM && o_is_body(s, p); k++)
            if (!is_held(s, p, k))
                p->v[k] += half(dt) * turned(b, k, b->a[k]);
    }
    hold(s);
    filter(s, s->time, s->time + dt, true);
    s->time += dt;
    tell(s, s->time, 0);
    find_density(s, number);
    s->rates_of_middle = true;
    o_forces(s);
    s->rates_of_middle = false;
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        const beginning *b = &was[i];
        for (int k = 0; k < SPH_DIM && o_is_body(s, p); k++)
            if (!is_held(s, p, k))
                p->v[k] = s->cfg.damping *
                          (p->v[k] + half(dt) * ((leaps ? 2 : 1) * p->a[k].v - turned(b, k, b->a[k])));
    }
    mend_drift(s, dt);
    for (uint32_t i = 0; i < s->n; i++)
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                was[i].dev_rate[k][l] = mirrored(&was[i], k, l, was[i].dev_rate[k][l]);
}

static void runge_kutta(o_scene *s, uint32_t number, double dt)
{
    const double begun = s->time;
    if (number > 1) /* at first all are where the kernel has them, if only just; later, who was put back outside */
        pass_faces(s, false);
    o_change_sets(s);
    hold(s);
    tell(s, begun, 0); /* and what is held has its own velocity again, not that of the wall it was put back off */
    filter(s, begun, begun, false);
    find_density(s, number);
    o_forces(s);
    remember_rates(s);
    remember_state(s);
    o_note_held(s);
    s->time += half(dt);
    tell(s, s->time, 0);
    filter(s, begun, s->time, false);
    go(s, half(dt), 0, half(dt), half(dt));
    find_density(s, number);
    o_forces(s);
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        beginning *b = &was[i];
        for (int k = 0; k < SPH_DIM && o_is_body(s, p); k++) {
            const double u = o_drifts(s) ? p->drift[k].v : 0;
            p->x[k] = b->x[k] + dt * (b->v[k] + half(dt) * b->a[k] + turned(b, k, u));
            p->drift[k].v = turned(b, k, p->drift[k].v);
            p->v[k] = s->cfg.damping * (b->v[k] + dt * turned(b, k, p->a[k].v));
        }
        if (!evolves(s, p))
            p->d = o_is_body(s, p) ? b->d : p->d;
        memcpy(p->rest, b->rest, sizeof p->rest);
    }
    go_whole(s, dt);
    for (uint32_t i = 0; i < s->n; i++) { /* back into the frame of the beginning, and from there to the end */
        o_particle *p = &s->own[i];
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                p->dev[k][l] = mirrored(&was[i], k, l, p->dev[k][l]);
        memset(was[i].turned, 0, sizeof was[i].turned);
        memset(was[i].mirrored, 0, sizeof was[i].mirrored);
    }
    pass_faces(s, true);
    s->time += half(dt);
    tell(s, s->time, 0);
    filter(s, begun, s->time, true);
}

/* the work of walls: by the trapezoidal rule; Runge-Kutta's powers are of the step's middle */
static void book_walls(o_scene *s, double dt)
{
    const bool middle = s->cfg.integrator == SPH_RUNGE_KUTTA || s->cfg.integrator == SPH_RUNGE_KUTTA_MOMENTUM;
    const o_sum was_then = s->wall_power, now = walls_power(s);
    o_add(&s->wall_work, middle ? dt * now.v : half(dt) * (was_then.v + now.v), dt * (was_then.s + now.s));
    s->wall_power = now;
}

bool o_step(o_scene *s, uint32_t number, double dt, uint32_t (*flaws_of)(uint32_t id, float *threshold))
{
    const uint32_t by = s->cfg.integrator;
    const uint32_t n = s->n;
    if (!o_open_flows(s))
        return false;
    for (uint32_t i = n; i < s->n; i++)
        was[i] = was[s->own[i].parent];
    o_slow_first(s, dt, last);
    remember_state(s);
    foresee_damage(s, dt, flaws_of);
    if (by == SPH_PREDICTOR_CORRECTOR)
        predict_correct(s, number, dt);
    else if (by == SPH_KICK_DRIFT_KICK || by == SPH_LEAP_FROG)
        kick_drift(s, number, dt);
    else
        runge_kutta(s, number, dt);
    hold(s);
    o_cross(s);
    o_let_out(s);
    for (uint32_t i = 0; i < s->n; i++) /* of those who left in the first sort it took nothing */
        o_plus(&s->slowed, s->own[i].lost);
    forget_the_gone(s, true);
    book_walls(s, dt);
    for (uint32_t i = 0; i < s->n && s->cfg.damper > 0; i++) {
        const o_particle *p = &s->own[i];
        const double end = by == SPH_PREDICTOR_CORRECTOR ? p->rate.v / s->set[p->set].rho0 : 2 * was[i].rise;
        o_book_quiet(s, p, end - was[i].rise, dt);
    }
    o_even(s);
    o_slow_last(s, dt);
    o_refresh(s);
    for (uint32_t i = 0; i < s->n; i++) {
        o_particle *p = &s->own[i];
        const double f = exp(-s->cfg.sponge_rate * o_sponge(s, p) * dt);
        for (int k = 0; k < SPH_DIM && o_is_body(s, p) && !o_is_carried(s, p); k++)
            if (!is_held(s, p, k))
                p->v[k] = s->cfg.sponge_velocity[k] + (p->v[k] - s->cfg.sponge_velocity[k]) * f;
    }
    if (s->cfg.shifting > 0)
        o_shift(s, dt);
    last = dt;
    if (by == SPH_RUNGE_KUTTA || by == SPH_RUNGE_KUTTA_MOMENTUM) {
        if (s->cfg.density == SPH_SUMMATION) { /* of where they are */
            pass_faces(s, false);
            find_density(s, number);
        }
        return true;
    }
    if (by == SPH_PREDICTOR_CORRECTOR) {
        remember_rates(s);
        return true;
    }
    for (uint32_t i = 0; i < s->n; i++) { /* accelerations are of the end, rates of the middle */
        was[i].rate = was[i].rise;
        for (int k = 0; k < 3; k++) {
            was[i].a[k] = s->own[i].a[k].v;
            was[i].u[k] = o_drifts(s) ? s->own[i].drift[k].v : 0;
        }
    }
    return true;
}
