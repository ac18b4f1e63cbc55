/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* crossing.c: particles that are found inside a wall, behind the face of a set. What becomes of them is the host's
   choice: the step fails, or they are removed, put back, or left alone. Adds no array; cost: for each set of walls a
   comparison of integers a particle. */
#include "locals.h"
#include "motion.h"
#include "arithmetic.h"

SPH_OBJECT(crossing)

#if SPH_HAS_WALLS

enum { Y = SPH_DIM > 1 };

/* depth of a place inside the region behind a set's face, or a negative number if it is outside */
static double depth_inside(const sph_set *s, const double *x)
{
    double perp = 0, along[2] = {0, 0};
    for (int k = 0; k < SPH_DIM; k++)
        perp += (x[k] - s->origin[k]) * s->normal[k];
    if (!(perp < 0) || -perp > s->thick)
        return -1;
    if (SPH_DIM == 2)
        along[0] = -(x[0] - s->origin[0]) * s->normal[Y] + (x[Y] - s->origin[Y]) * s->normal[0];
    for (int k = 0; k < SPH_DIM && SPH_DIM == 3; k++) {
        const int a = (k + 1) % SPH_DIM, b = (k + 2) % SPH_DIM;
        along[0] += (x[k] - s->origin[k]) * s->tangent[k];
        along[1] += (x[k] - s->origin[k]) * (s->normal[a] * s->tangent[b] - s->normal[b] * s->tangent[a]);
    }
    for (int k = 0; k < SPH_DIM - 1; k++)
        if (sph_abs(along[k]) > s->half[k])
            return -1;
    return -perp;
}

/* whether particles are looked for behind a set's faces */
static bool is_region(const sph_sim *sim, const sph_set *s)
{
    return !sph_is_matter(s) && !s->corner && !sph_wall_removed(sim, s);
}

uint32_t sph_inside_wall(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *depth)
{
    uint32_t found = SPH_MAX_SETS;
    for (uint32_t w = 0; w < sim->sets; w++) {
        const sph_set *s = &sim->set[w];
        if (!is_region(sim, s))
            continue;
        double x[SPH_DIM];
        for (uint32_t k = 0; k < SPH_DIM; k++) { /* from the nearest of the wall's pictures round a periodic axis */
            const double origin = s->origin[k] / sim->grid.quantum;
            const int64_t q = (int64_t)b->pos[k][i] - sph_wall_moved(sim, s, k), face = (int64_t)origin;
            x[k] = (double)(face + sph_round_domain(sim, k, q - face)) * sim->grid.quantum;
        }
        double d = depth_inside(s, x);
        if (d > 0 && (found == SPH_MAX_SETS || d < *depth)) {
            found = w;
            *depth = d;
        }
    }
    return found;
}

/* a place of axis k from which a move of one cell still fits into an integer: at most a domain's length outside */
static __attribute__((noinline)) sph_pos near_quanta(const sph_sim *sim, uint32_t k, int64_t q)
{
    const sph_pos low = -sim->grid.extent[k], high = 2 * sim->grid.extent[k] - sim->grid.cell_size[k] - 1;
    return q < low ? low : q > high ? high : (sph_pos)q;
}

#define SPH_PUT_BACK_SPACINGS 0.1 /* how far off the wall a particle is put back */

static void put_back(sph_sim *sim, const sph_buffer *b, uint32_t i, const sph_set *s, double depth)
{
    double vn = 0, off = depth + SPH_PUT_BACK_SPACINGS * sim->cfg.spacing;
    for (int k = 0; k < SPH_DIM; k++) {
        const double q = off * s->normal[k] / sim->grid.quantum; /* a wall is at most 64 spacings thick: fits */
        const sph_pos to = near_quanta(sim, (uint32_t)k, b->pos[k][i] + (int64_t)(q < 0 ? q - 0.5 : q + 0.5));
        sph_displace_fields(sim, b, i, (uint32_t)k, to - b->pos[k][i]);
        b->pos[k][i] = to;
        vn += ((double)b->vel[k][i] - sph_wall_velocity(sim, s, (uint32_t)k)) * s->normal[k];
    }
    if (vn < 0)
        for (int k = 0; k < SPH_DIM; k++)
            b->vel[k][i] -= (sph_real)(vn * s->normal[k]);
}

static __attribute__((noinline)) void cross_one(sph_sim *sim, uint32_t i, sph_thread *t, double *books)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    double depth = 0;
    uint32_t w = sph_inside_wall(sim, b, i, &depth);
    if (w == SPH_MAX_SETS)
        return;
    const double held = SPH_WITH_BOOKS && books ? sph_energy_sum(sim, b, i) : 0;
    t->crossed++;
    if (sim->cfg.on_cross == SPH_FAIL)
        sph_fail_note(t, SPH_WALL_CROSSED, b->id[0][i], depth);
    else if (sim->cfg.on_cross == SPH_REMOVE) {
        b->set[0][i] = SPH_DEAD;
        t->removed++;
        if (SPH_WITH_BOOKS && books)
            books[JUMP_REMOVED] += held;
    } else {
        for (int turn = 0; turn < 3 && w != SPH_MAX_SETS; turn++) { /* a corner may need more than one */
            put_back(sim, b, i, &sim->set[w], depth);
            t->put_back += turn == 0;
            w = sph_inside_wall(sim, b, i, &depth);
        }
        if (SPH_WITH_BOOKS && books)
            books[JUMP_PUT_BACK] += held - sph_energy_sum(sim, b, i);
    }
}

#define QUICK (SPH_HAS_QUICK_BITS && !SPH_SCALAR)
/* marks the particles that are in the box around a wall's region */
static void mark_near(const sph_sim *sim, const sph_set *s, sph_span span, uint8_t *restrict marks)
{
    /* one loop over integers: compilers make vectors of it (bytes may be anything: without restrict they do not) */
    sph_pos lo[SPH_DIM], hi[SPH_DIM];
    const sph_pos *pos[SPH_DIM];
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const int64_t moved = sph_wall_moved(sim, s, k);
        pos[k] = sim->buf[sim->dst].pos[k];
        const bool round = SPH_WITH_MOVING_WALLS && moved != 0 && SPH_IS(sim->cfg.face[k][0], PERIODIC);
        lo[k] = SPH_WITH_MOVING_WALLS ? near_quanta(sim, k, s->low[k] + moved) : s->low[k];
        lo[k] = round ? 0 : lo[k];
        hi[k] = SPH_WITH_MOVING_WALLS ? near_quanta(sim, k, s->high[k] + moved) : s->high[k];
        hi[k] = round ? sim->grid.extent[k] : hi[k];
    }
    for (uint32_t i = span.first; QUICK && i < span.last; i += SPH_W) {
        vint out = v_set_int(0);
        SPH_UNROLL
        for (int k = 0; k < SPH_DIM; k++) {
            const vint q = v_load_int(pos[k] + i);
            out |= v_less_int(q, v_set_int(lo[k])) | v_less_int(v_set_int(hi[k]), q);
        }
        uint32_t in = v_bits(~out);
        in &= span.last - i < SPH_W ? (1u << (span.last - i)) - 1 : in;
        for (; in; in &= in - 1) /* few */
            marks[i - span.first + (uint32_t)__builtin_ctz(in)] = 1;
    }
    if (!QUICK)
        for (uint32_t i = span.first; i < span.last; i++) {
            int in = 1;
            SPH_UNROLL
            for (int k = 0; k < SPH_DIM; k++)
                in &= (pos[k][i] >= lo[k]) & (pos[k][i] <= hi[k]);
            marks[i - span.first] |= (uint8_t)in;
        }
}

void sph_cross_walls(sph_sim *sim, sph_span s, sph_thread *t, double *books)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    if (sim->groups == 0 || sim->cfg.on_cross == SPH_IGNORE)
        return;
    memset(t->near, 0, s.last - s.first);
    for (uint32_t w = 0; w < sim->sets; w++)
        if (is_region(sim, &sim->set[w]))
            mark_near(sim, &sim->set[w], s, t->near);
    for (uint32_t i = s.first; i < s.last; i++)
        if (t->near[i - s.first] && b->set[0][i] != SPH_DEAD && sph_is_matter(&sim->set[b->set[0][i]]))
            cross_one(sim, i, t, books);
}
#endif
