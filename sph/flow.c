/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* flow.c: inflows and outflows (Gray 2001 eqs 2.34, 2.35, section 3.5).

   An inflow is a box of layers, a set of its own that goes through one face of the box with the velocities and
   densities that it was given; forces do not act on it. At the beginning of a step each of its particles that has
   passed the face becomes one of the water, and a copy of it is born exactly one length of the box behind it: in whole
   quanta, so that layers keep their distances for ever. An outflow is a box too: what comes in through its face goes on
   as it came, with its density, and is removed behind the opposite face.

   How newcomers get into a step: they stand in buffer cur behind its last particle, which is no part of the state, and
   the sort takes them along (sim->newcomers). So a step that fails has forgotten them. Ids: a newcomer takes the next
   free one round the ring 0 .. max_particles - 1, from the last that was given on (scalar next_id), in order of the
   places of those that it follows.

   The hold: velocity and density are taken from buffer src again, after the sort, before forces and at the step's end,
   whatever filters, damping or sums made of them. What that takes or gives is wall_work: on a particle that force a and
   rate drho would move, -(a.v + p/rho^2 drho) per unit mass. Where rates have a sweep of their own, in the middle of a
   step, that rate is taken for the one at its end.

   Arrays: taken (a byte an id), births (a number for each chunk). Cost: a look at the sets; with births, a byte for
   each id, looked at eight at a time. */
#include "locals.h"
#include "arithmetic.h"

SPH_OBJECT(flow)

#if SPH_WITH_FLOW

sph_status sph_check_flows(const sph_config *c, sph_report *r)
{
    if (c->max_flows && c->density != SPH_CONTINUITY)
        return sph_refuse(r, "density", "SPH_CONTINUITY with inflows or outflows", c->density);
    return SPH_OK;
}

/* ---- where a particle is ---- */

static bool has_passed(const sph_flow_state *f, sph_pos q, sph_pos plane)
{
    return f->up ? q >= plane : q < plane;
}

/* in an outflow's box, and on its way through it */
static bool is_going_out(const sph_flow_state *f, const sph_buffer *b, uint32_t i)
{
    const sph_pos q = b->pos[f->axis][i];
    const sph_real v = b->vel[f->axis][i];
    bool in = has_passed(f, q, f->face) && !has_passed(f, q, f->end) && (f->up ? v > 0 : v < 0);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        in &= k == f->axis || (b->pos[k][i] >= f->lo[k] && b->pos[k][i] < f->hi[k]);
    return in;
}

/* the inflow that a set is, or null */
static const sph_flow_state *inflow_of(const sph_sim *sim, uint8_t set)
{
    const sph_flow_state *f = set == SPH_DEAD ? NULL : sph_flow_of(sim, &sim->set[set]);
    return f && !f->out ? f : NULL;
}

/* whether particle i of buffer cur, of set `set`, is to be followed by a newcomer in this step; f: its inflow */
static bool is_followed(const sph_sim *sim, const sph_flow_state *f, uint32_t i)
{
    return has_passed(f, sim->buf[sim->cur].pos[f->axis][i], f->face);
}

/* ---- births: before the sort ---- */

static uint32_t births_in(const sph_sim *sim, sph_span s)
{
    const uint8_t *set = sim->buf[sim->cur].set[0];
    uint32_t n = 0;
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(set, i, s.last);
        const sph_flow_state *f = inflow_of(sim, set[i]);
        for (uint32_t j = i; f && j < e; j++)
            n += is_followed(sim, f, j);
    }
    return n;
}

/* a chunk of particles is counted, and as many ids are marked as free */
static void births_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const uint32_t first = chunk * SPH_LOCAL_CHUNK, most = sim->cfg.max_particles - first;
    memset(sim->taken + first, 0, most < SPH_LOCAL_CHUNK ? most : SPH_LOCAL_CHUNK);
    sim->births[chunk] = 0;
    if (chunk < sph_local_chunks(sim))
        sim->births[chunk] = births_in(sim, sph_chunk_span(sim, chunk));
    t->work += SPH_LOCAL_CHUNK;
}

static uint32_t id_chunks(const sph_sim *sim)
{
    return (sim->cfg.max_particles + SPH_LOCAL_CHUNK - 1) / SPH_LOCAL_CHUNK;
}

static sph_status births_end(sph_sim *sim)
{
    uint32_t n = 0;
    for (uint32_t c = 0; c < sph_local_chunks(sim); c++)
        n += sim->births[c];
    if (n > sim->cfg.max_particles - sim->now.count)
        return sph_error(sim, SPH_TOO_MANY_PARTICLES, "max_particles", "at least as many as the value says",
                         (double)sim->now.count + n, SPH_NO_PARTICLE);
    sim->newcomers = n;
    return SPH_OK;
}
static bool has_flows(const sph_sim *sim) { return sim->flows > 0; }
const sph_pass sph_pass_births = {"births", id_chunks, births_chunk, births_end, has_flows};

static void newcomers_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    const uint32_t *id = sim->buf[sim->cur].id[0];
    for (uint32_t i = s.first; i < s.last; i++)
        sim->taken[id[i]] = 1;
    t->work += s.last - s.first;
}

/* the first free id from `at` on, round the ring; there is one. Adds to *looked */
static uint32_t free_id(const sph_sim *sim, uint32_t at, uint64_t *looked)
{
    const uint64_t all = 0x0101010101010101u;
    const uint32_t n = sim->cfg.max_particles;
    for (;; ++*looked) {
        uint64_t eight = 0;
        at = at < n ? at : 0;
        if (at + 8 <= n)
            memcpy(&eight, sim->taken + at, sizeof eight);
        if (eight == all)
            at += 8;
        else if (!sim->taken[at])
            return at;
        else
            at++;
    }
}

/* a copy of particle i of buffer b, number `to`, one length of its inflow's box behind it */
static void give_birth(const sph_sim *sim, const sph_flow_state *f, uint32_t i, uint32_t to)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (const sph_field *e = sph_fields; e < sph_fields + SPH_FIELD_COUNT; e++)
        for (uint32_t k = 0; k < e->comps; k++) {
            unsigned char *const x = sph_array(b, e->at + k);
            if (x && e->way == SPH_DISPLACED)
                memset(x + (size_t)to * e->bytes, 0, e->bytes);
            else if (x)
                memcpy(x + (size_t)to * e->bytes, x + (size_t)i * e->bytes, e->bytes);
        }
    b->pos[f->axis][to] += f->end - f->face;
}

/* the newcomers that follow particles of a chunk: state, id, books */
static void bring_in(sph_sim *sim, sph_span s, uint32_t *to, uint64_t *looked)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = s.first; i < s.last; i++) {
        const uint8_t set = b->set[0][i];
        const sph_flow_state *f = inflow_of(sim, set);
        if (!f || !is_followed(sim, f, i))
            continue;
        const uint32_t id = free_id(sim, sim->next.next_id, looked);
        give_birth(sim, f, i, *to);
        b->id[0][*to] = id;
        sim->taken[id] = 1;
        sim->next.next_id = id + 1;
        sim->next.added_mass += sim->set[set].mass;
        sim->next.fed += sph_keeps_books(&sim->cfg) ? sph_energy_sum(sim, b, *to) : 0;
        ++*to;
    }
}

static sph_status newcomers_end(sph_sim *sim)
{
    uint32_t to = sim->now.count;
    uint64_t looked = 0;
    for (uint32_t c = 0; c < sph_local_chunks(sim); c++)
        if (sim->births[c])
            bring_in(sim, sph_chunk_span(sim, c), &to, &looked);
    sim->work += looked + sim->newcomers;
    sim->mark_particles = to > sim->mark_particles ? to : sim->mark_particles;
    return SPH_OK;
}
static bool has_newcomers(const sph_sim *sim) { return sim->newcomers > 0; }
const sph_pass sph_pass_newcomers = {"newcomers", sph_local_chunks, newcomers_chunk, newcomers_end, has_newcomers};

/* ---- the hold ---- */

void sph_hold_flows(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    for (uint32_t i = s.first, e; i < s.last && sim->flows; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        const sph_flow_state *f = b->set[0][i] == SPH_DEAD ? NULL : sph_flow_of(sim, &sim->set[b->set[0][i]]);
        for (uint32_t j = i; f && j < e; j++) {
            const uint32_t p = b->id[0][j];
            b->rho[0][j] = o->rho[0][p];
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                const sph_real turn = SPH_HAS_MIRRORS && sim->turned ? sph_turn_of(sim, p, SPH_TURNS_VECTORS << k) : 1;
                b->vel[k][j] = f->out || k == f->axis ? turn * o->vel[k][p] : 0;
            }
        }
    }
}

/* what an outflow is through with */
void sph_let_out(const sph_sim *sim, sph_span s, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    for (uint32_t i = s.first, e; i < s.last && sim->flows; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        const sph_flow_state *f = b->set[0][i] == SPH_DEAD ? NULL : sph_flow_of(sim, &sim->set[b->set[0][i]]);
        for (uint32_t j = i; f && f->out && j < e; j++)
            if (has_passed(f, b->pos[f->axis][j], f->end)) {
                if (SPH_WITH_BOOKS)
                    sph_carry_off(sim, b, j, t);
                b->set[0][j] = SPH_DEAD;
                t->left++;
            }
    }
}

/* ---- who belongs where: after the sort ---- */

/* particles that passed an inflow's face by the step's beginning become water; water that stood in an outflow, its */
static void change_sets(const sph_sim *sim, const sph_flow_state *f, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const uint8_t from = f->out ? f->fluid : f->set, to = f->out ? f->set : f->fluid;
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        const bool asked = b->set[0][i] == from;
        for (uint32_t j = i; asked && j < e; j++) {
            const uint32_t p = b->id[0][j];
            if (f->out ? is_going_out(f, o, p) : p < sim->now.count && has_passed(f, o->pos[f->axis][p], f->face))
                b->set[0][j] = to;
        }
    }
}

static void flow_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    const bool begins = sim->src == sim->cur && sim->next.step != sim->now.step;
    for (uint32_t f = 0; begins && f < sim->flows; f++)
        change_sets(sim, &sim->flow[f], s);
    sph_hold_flows(sim, s);
    t->work += s.last - s.first;
}
const sph_pass sph_pass_flow = {"flow", sph_local_chunks, flow_chunk, NULL, has_flows};
#endif
