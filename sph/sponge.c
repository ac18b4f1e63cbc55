/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sponge.c: layers along faces of the domain in which velocities of fluid and solid die away, so that waves leave and
   do not come back (Powell 2012 section 2.1; the ramp is quadratic, because a linear one reflects more):

     dv/dt = -r S (v - v_ref),  S = sum over faces of s^2,  s = (w - distance to the face)/w inside a layer, else 0
     v' = v_ref + (v - v_ref) exp(-r S dt)   exact where S stays; any dt

   When: once, at the step's end, over the whole of dt, at the places there. With the step A and the damping D this is
   the symmetric splitting but for half a step of damping at the beginning and at the end of a run:
   (D A)^n = D^1/2 (D^1/2 A D^1/2)^n D^-1/2. So what begins outside the layers moves to second order; inside, velocities
   stand half a step of damping ahead, as those of the leap-frog stand half a step. The predictor-corrector takes the
   rates of density from velocities before the damping, which is of first order inside the layers. Walls, and axes along
   which a set is held, are not damped.

   Array: sponge (a double for each chunk of a local pass). Cost: a local pass; exp of particles in a layer. */
#include "dmath.h"
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(sponge)

#if SPH_WITH_SPONGE
/* ---- the configuration ---- */

static sph_status check_width(const sph_config *c, uint32_t k, uint32_t side, double width, sph_report *r)
{
    const char *what = side ? "sponge_high" : "sponge_low";
    if (!(width > 0))
        return SPH_OK;
    if (!(width <= c->hi[k] - c->lo[k]))
        return sph_refuse(r, what, "at most the domain's length", width);
    if (SPH_IS(c->face[k][side], PERIODIC))
        return sph_refuse(r, what, "0 on periodic faces", width);
    return c->sponge_rate > 0 ? SPH_OK : sph_refuse(r, "sponge_rate", "> 0 where a layer has a width", c->sponge_rate);
}

sph_status sph_check_sponge(const sph_config *c, sph_report *r)
{
    sph_status st = SPH_OK;
    for (uint32_t k = 0; !st && k < SPH_DIM; k++) {
        st = check_width(c, k, 0, c->sponge_low[k], r);
        st = st ? st : check_width(c, k, 1, c->sponge_high[k], r);
    }
    return st;
}

/* ---- the layers ---- */

/* along one axis, quanta: particles below `low` or above `high` are in a layer, low or length - high wide */
typedef struct layers {
    double low, high, length;
} layers;

static layers layers_of(const sph_sim *sim, uint32_t k)
{
    const double length = (double)sim->grid.extent[k], quantum = sim->grid.quantum;
    return (layers){sim->cfg.sponge_low[k] / quantum, length - sim->cfg.sponge_high[k] / quantum, length};
}

static double square(double x) { return x * x; }

/* S of a particle */
static double sponge_at(const layers *l, const sph_buffer *b, uint32_t i)
{
    double s = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const double x = (double)b->pos[k][i];
        if (x < l[k].low)
            s += square((l[k].low - x) / l[k].low);
        if (x > l[k].high)
            s += square((x - l[k].high) / (l[k].length - l[k].high));
    }
    return s;
}

/* damps a particle's velocity along the axes that are not held; returns the energy that it loses, J/kg */
static double damp(const sph_sim *sim, const sph_buffer *b, uint32_t i, uint32_t held, double factor)
{
    double lost = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (held >> k & 1)
            continue;
        const double v = (double)b->vel[k][i], ref = sim->cfg.sponge_velocity[k];
        const sph_real to = (sph_real)(ref + (v - ref) * factor);
        lost += 0.5 * (v * v - (double)to * (double)to);
        b->vel[k][i] = to;
    }
    return lost;
}

/* ---- the pass ---- */

static void sponge_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    layers l[SPH_DIM];
    double sum = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        l[k] = layers_of(sim, k);
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = b->set[0][i];
        if (set == SPH_DEAD || !sph_is_matter(&sim->set[set]) || sph_flow_of(sim, &sim->set[set]))
            continue;
        const double s = sponge_at(l, b, i);
        if (s > 0)
            sum += sim->set[set].mass * damp(sim, b, i, sph_held(sim, &sim->set[set]),
                                             sph_exp(-sim->cfg.sponge_rate * s * sim->dt));
    }
    sim->sponge[chunk] = sum;
    t->work += span.last - span.first;
}

/* the book: chunks in their order */
static sph_status sponge_end(sph_sim *sim)
{
    double sum = 0;
    for (uint32_t chunk = 0; chunk < sph_local_chunks(sim); chunk++)
        sum += sim->sponge[chunk];
    sim->next.absorbed += sum;
    return SPH_OK;
}

static bool sponge_wanted(const sph_sim *sim) { return sim->cfg.sponge_rate > 0; }

const sph_pass sph_pass_sponge = {"sponge", sph_local_chunks, sponge_chunk, sponge_end, sponge_wanted};
#endif
