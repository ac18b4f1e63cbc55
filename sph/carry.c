/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* carry.c: every field beside positions, velocities and densities goes with its particle (pass "carry", after the
   sort) and, where the list of fields says that it evolves, is advanced with its rate by whatever integrator runs.
   Scenes without such fields have none of it.

   Cost: for each component a loop that gathers from buffer src, and one or two that add the rate. */
#include "motion.h"
#include "arithmetic.h"

SPH_OBJECT(carry)

/* elements of any kind from where their particles were */
static void take(void *to, const void *from, const uint32_t *at, size_t bytes, sph_span s)
{
    unsigned char *t = to;
    const unsigned char *f = from;
    if (bytes == sizeof(sph_real))
        for (uint32_t i = s.first; i < s.last; i++)
            memcpy(t + i * sizeof(sph_real), f + at[i] * sizeof(sph_real), sizeof(sph_real));
    else
        for (uint32_t i = s.first; i < s.last; i++)
            memcpy(t + i * bytes, f + at[i] * bytes, bytes);
}

/* ---- turned by mirrors ---- */

/* which bits of `turned` change the sign of component k of a field (sph_turn_of); 0: none */
static uint32_t turns_of(const sph_field *f, uint32_t k)
{
    static const uint8_t planes[] = {3, 5, 6}; /* xy, xz, yz */
    const uint32_t diagonal = SPH_DIM == 1 ? 1 : 2;
    if (f->kind == SPH_VECTOR)
        return SPH_TURNS_VECTORS << k;
    return f->kind == SPH_DEVIATOR && k >= diagonal ? SPH_TURNS_TENSORS * planes[(k - diagonal) % 3] : 0;
}

/* a component that these bits turn, just taken from src into x */
static void turn(const sph_sim *sim, uint32_t mask, sph_real *x, sph_span s)
{
    for (uint32_t i = s.first; SPH_HAS_MIRRORS && sim->turned && mask && i < s.last; i++)
        x[i] = sph_turn_of(sim, sph_source_index(sim)[i], mask) * x[i];
}

void sph_turn_fields(const sph_sim *sim, uint32_t i, uint32_t turned)
{
    const uint32_t p = sph_source_index(sim)[i];
    const uint8_t before = sim->turned[p];
    sim->turned[p] = (uint8_t)turned;
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT && turned; f++)
        for (uint32_t k = 0; k < f->comps && f->real; k++) {
            sph_real *x = sph_array(&sim->buf[sim->dst], f->at + k);
            if (x && turns_of(f, k))
                x[i] = sph_turn_of(sim, p, turns_of(f, k)) * x[i];
        }
    sim->turned[p] = before ^ (uint8_t)turned;
}

/* ---- taken from src ---- */

/* displacements: what the particles moved in this stage, round a periodic domain if need be, is added along axis k */
static void displace(const sph_sim *sim, sph_pos *to, const sph_pos *from, uint32_t k, sph_span s)
{
    const sph_pos *pos = sim->buf[sim->dst].pos[k], *old = sim->buf[sim->src].pos[k];
    const sph_pos whole = sim->grid.extent[k], half = whole / 2;
    const bool round = SPH_IS(sim->cfg.face[k][0], PERIODIC), mirrors = sph_has_mirrors(&sim->cfg, k);
    const uint32_t *at = sph_source_index(sim);
    for (uint32_t i = s.first; i < s.last; i++) {
        if (mirrors && sph_turn(sim, k, i) < 0) { /* where it was is mirrored too, at 0 or 2 whole - 1 - x */
            const sph_pos sum = pos[i] + old[at[i]];
            to[i] = sum - (sum < whole ? 0 : 2 * whole - 1) - from[at[i]];
            continue;
        }
        sph_pos d = pos[i] - old[at[i]];
        if (round)
            d = d > half ? d - whole : d < -half ? d + whole : d;
        to[i] = from[at[i]] + d;
    }
}

/* carried and displaced fields from src */
static void take_fields(const sph_sim *sim, sph_span s)
{
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < f->comps && (f->way == SPH_CARRIED || f->way == SPH_DISPLACED); k++) {
            void *to = sph_array(&sim->buf[sim->dst], f->at + k);
            const void *from = sph_array(&sim->buf[sim->src], f->at + k);
            if (to && f->way == SPH_CARRIED) {
                take(to, from, sph_source_index(sim), f->bytes, s);
                turn(sim, turns_of(f, k), to, s);
            } else if (to)
                displace(sim, to, from, k, s);
        }
}

/* displacements once more, where positions have changed since */
void sph_displace_again(const sph_sim *sim, sph_span s)
{
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < f->comps && f->way == SPH_DISPLACED && sph_array(&sim->buf[sim->dst], f->at); k++)
            displace(sim, sph_array(&sim->buf[sim->dst], f->at + k), sph_array(&sim->buf[sim->src], f->at + k), k, s);
}

/* the velocity beside their own that particles have gone with in this step, for sums in its middle */
static void take_drift(const sph_sim *sim, sph_span s)
{
    for (uint32_t k = 0; k < SPH_DIM && sph_drift(sim, &sim->buf[sim->dst], k) && sph_in_middle(sim); k++) {
        take(sph_drift(sim, &sim->buf[sim->dst], k), sph_drift(sim, &sim->buf[sim->src], k), sph_source_index(sim),
             sizeof(sph_real), s);
        turn(sim, SPH_TURNS_VECTORS << k, sph_drift(sim, &sim->buf[sim->dst], k), s);
    }
}

/* one component of a field that evolves, and its rate, in buffers dst and src; to null: there are no more */
typedef struct evolving {
    uint32_t field, comp;
    sph_real *to;
    const sph_real *rate, *from, *old_rate;
} evolving;

static evolving evolving_from(const sph_sim *sim, uint32_t field, uint32_t comp)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    for (; field < SPH_FIELD_COUNT; field++, comp = 0) {
        const sph_field *f = &sph_fields[field];
        const uint32_t at = f->at + comp, rate = f->rate + comp;
        if (f->way == SPH_EVOLVING && comp < f->comps && sph_array(b, at))
            return (evolving){field, comp, sph_array(b, at), sph_array(b, rate), sph_array(o, at), sph_array(o, rate)};
    }
    return (evolving){0, 0, NULL, NULL, NULL, NULL};
}
static evolving first_evolving(const sph_sim *sim) { return evolving_from(sim, 0, 0); }
static evolving next_evolving(const sph_sim *sim, const evolving *e)
{
    return evolving_from(sim, e->field, e->comp + 1);
}

/* what the sweeps of an earlier stage gave: sums and rates */
static void take_given(const sph_sim *sim, sph_span s)
{
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < f->comps && (f->way == SPH_SUMMED || f->way == SPH_RATE); k++) {
            sph_real *const to = sph_array(&sim->buf[sim->dst], f->at + k);
            if (to)
                take(to, sph_array(&sim->buf[sim->src], f->at + k), sph_source_index(sim), f->bytes, s);
            if (to && f->real)
                turn(sim, turns_of(f, k), to, s);
        }
}

void sph_carry_fields(sph_sim *sim, sph_span s)
{
    take_drift(sim, s);
    if (sph_keeps_fields(sim))
        take_given(sim, s);
    if (!sph_has_ways(&sim->cfg, SPH_CARRIED_WAYS))
        return;
    const uint32_t *at = sph_source_index(sim);
    const sph_real step = sim->stage->rate * (sph_real)sim->dt;
    for (evolving e = first_evolving(sim); e.to; e = next_evolving(sim, &e)) {
        for (uint32_t i = s.first; i < s.last; i++)
            e.to[i] = e.from[at[i]] + step * e.old_rate[at[i]];
        turn(sim, turns_of(&sph_fields[e.field], e.comp), e.to, s);
    }
    take_fields(sim, s);
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < f->comps && f->way == SPH_RATE && !sph_keeps_fields(sim) &&
                             sph_array(&sim->buf[sim->dst], f->at); k++)
            memset((unsigned char *)sph_array(&sim->buf[sim->dst], f->at + k) + (size_t)s.first * f->bytes, 0,
                   (size_t)(s.last - s.first) * f->bytes);
}

void sph_correct_fields(sph_sim *sim, sph_span s)
{
    if (!sph_has_ways(&sim->cfg, 1u << SPH_EVOLVING))
        return;
    const uint32_t *at = sph_source_index(sim);
    const sph_real half = (sph_real)sim->dt * (sph_real)0.5;
    for (evolving e = first_evolving(sim); e.to; e = next_evolving(sim, &e)) {
        const uint32_t mask = turns_of(&sph_fields[e.field], e.comp);
        const bool turns = SPH_HAS_MIRRORS && sim->turned && mask;
        for (uint32_t i = s.first; i < s.last && !turns; i++)
            e.to[i] = e.to[i] + half * (e.rate[i] - e.old_rate[at[i]]);
        for (uint32_t i = s.first; i < s.last && turns; i++)
            e.to[i] = e.to[i] + half * (e.rate[i] - sph_turn_of(sim, at[i], mask) * e.old_rate[at[i]]);
    }
}

void sph_retake_fields(sph_sim *sim, sph_span s)
{
    if (!sph_has_ways(&sim->cfg, SPH_CARRIED_WAYS))
        return;
    const uint32_t *at = sph_source_index(sim);
    const sph_real dt = (sph_real)sim->dt;
    for (evolving e = first_evolving(sim); e.to; e = next_evolving(sim, &e)) {
        const uint32_t mask = turns_of(&sph_fields[e.field], e.comp);
        const bool turns = SPH_HAS_MIRRORS && sim->turned && mask;
        for (uint32_t i = s.first; i < s.last && !turns; i++)
            e.to[i] = e.from[at[i]] + dt * e.rate[i];
        for (uint32_t i = s.first; i < s.last && turns; i++)
            e.to[i] = sph_turn_of(sim, at[i], mask) * e.from[at[i]] + dt * e.rate[i];
    }
    take_fields(sim, s);
}

void sph_displace_fields(const sph_sim *sim, const sph_buffer *b, uint32_t i, uint32_t k, sph_pos d)
{
    if (!sph_has_ways(&sim->cfg, 1u << SPH_DISPLACED))
        return;
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++) {
        sph_pos *to = f->way == SPH_DISPLACED && k < f->comps ? sph_array(b, f->at + k) : NULL;
        if (to)
            to[i] += d;
    }
}
