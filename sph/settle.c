/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* settle.c: the end of a stage: indices become ids, walls get zeros; and of a step: what must not go on is noted. */
#include "motion.h"
#include "arithmetic.h"

SPH_OBJECT(settle)

/* components of all fields that the force sweep writes */
enum {
#define SPH_SUMMED_COMPS(name, type, comps, unit, when, way) +(((way) & SPH_WAYS) == SPH_SUMMED ? (comps) : 0)
    SUMMED = 0 SPH_STATE_FIELDS(SPH_SUMMED_COMPS)
#undef SPH_SUMMED_COMPS
};

/* those that the scene has; returns how many */
static uint32_t find_summed(const sph_buffer *b, sph_real **array)
{
    uint32_t n = 0;
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < f->comps && f->way == SPH_SUMMED && sph_array(b, f->at); k++)
            array[n++] = sph_array(b, f->at + k);
    return n;
}

void sph_settle(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    uint32_t *id = b->id[0], n = 0;
    const uint32_t *of = sim->buf[sim->src].id[0];
    sph_real *summed[SUMMED];
    for (uint32_t i = s.first; i < s.last; i++) {
        SPH_ASSERT(id[i] < sim->src_count);
        id[i] = of[id[i]];
    }
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        const uint8_t set = b->set[0][i];
        const bool gone = set == SPH_DEAD; /* among them walls, that were in no sums */
        if (!gone && sph_is_matter(&sim->set[set]))
            continue;
        n = n ? n : find_summed(b, summed);
        for (uint32_t k = 0; k < n; k++) /* walls that are compressible have a rate of density, and its rise */
            if (gone || !sph_is_compressible(&sim->set[set]) || (summed[k] != b->drho[0] && summed[k] != b->rise[0]))
                memset(summed[k] + i, 0, (e - i) * sizeof(sph_real));
    }
}

/* velocities and densities that must not go on: too large, or a density that no equation of state has */
static void check_motion(const sph_sim *sim, sph_span s, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    vint wrong = v_set_int(SPH_SCALAR); /* without vectors the second loop does it all */
    for (uint32_t i = s.first; !SPH_SCALAR && i < s.last; i += SPH_W) {
        const vreal d = v_load(b->rho[0] + i);
        vreal v2 = v_set(0);
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const vreal v = v_load(b->vel[k] + i);
            v2 = v2 + v * v;
        }
        wrong |= ~(v_less(v2, v_set(SPH_LIMIT_SQUARE)) & v_less(v_set((sph_real)-0.9), d) & v_less(d, v_set(99)));
    }
    sph_int lanes[SPH_W], fine = 1;
    v_store_int(lanes, wrong);
    for (int l = 0; l < SPH_W; l++)
        fine &= lanes[l] == 0; /* lanes beyond the last particle may cry wolf: the loop below looks again */
    for (uint32_t i = s.first; !fine && i < s.last; i++) {
        sph_real v2 = 0, d = b->rho[0][i];
        for (uint32_t k = 0; k < SPH_DIM; k++)
            v2 += b->vel[k][i] * b->vel[k][i];
        if (!(v2 < SPH_LIMIT_SQUARE) || d - d != 0)
            sph_fail_note(t, SPH_NOT_FINITE, b->id[0][i], (double)v2);
        else if (!(d > (sph_real)-0.9 && d < 99))
            sph_fail_note(t, SPH_DENSITY_LOST, b->id[0][i], (double)d);
    }
}

/* reals that are carried or evolve: finite, and in the range that the list of fields says */
static void check_fields(const sph_sim *sim, sph_span s, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const sph_real most = SPH_DOUBLE ? (sph_real)DBL_MAX : (sph_real)FLT_MAX;
    for (const sph_field *f = sph_fields; f < sph_fields + SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < f->comps && f->real && (f->way == SPH_CARRIED || f->way == SPH_EVOLVING); k++) {
            const sph_real *x = sph_array(b, f->at + k);
            const sph_real low = f->range ? 0 : -most, high = f->range == SPH_SHARE ? 1 : most;
            for (uint32_t i = s.first; x && i < s.last; i++)
                if (!(x[i] >= low && x[i] <= high))
                    sph_fail_note(t, SPH_NOT_FINITE, b->id[0][i], (double)x[i]);
        }
}

void sph_check(const sph_sim *sim, sph_span s, sph_thread *t)
{
    check_motion(sim, s, t);
    if (sph_has_ways(&sim->cfg, 1u << SPH_CARRIED | 1u << SPH_EVOLVING))
        check_fields(sim, s, t);
}
