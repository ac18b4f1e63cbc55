/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* move.c: where the sort takes the particles of a block, and the kick that a stage gives before the sums: matter by
   their velocity and acceleration, walls and held sets as their group is told; then the faces of the domain. */
#include "dmath.h"
#include "motion.h"
#include "arithmetic.h"

SPH_OBJECT(move)

/* What the predicted density takes of `rise`: dt (dt/last dt). Two dt at most: where a very short step comes before a
   long one, its rise is noise. */
static sph_real foresight(sph_real dt, sph_real last) { return dt < 2 * last ? dt * (dt / last) : 2 * dt; }

sph_real sph_slowed_by(const sph_sim *sim)
{
    if (!SPH_WITH_DAMPING_RATE || !(sim->cfg.damping_rate > 0) || !sph_begins_step(sim))
        return 1;
    return (sph_real)sph_exp(-0.5 * sim->cfg.damping_rate * sim->dt);
}

sph_move sph_stage_move(const sph_sim *sim)
{
    const sph_stage *g = sim->stage;
    const sph_real dt = (sph_real)sim->dt, damping = g->damps ? (sph_real)sim->cfg.damping : 1;
    sph_move m = {g->drift * dt, dt * (g->bend * dt), g->kick * dt, g->rate * dt, 0, damping, sph_rounding(sim), 1};
    if (SPH_WITH_DAMPING_RATE)
        m.slowed = sph_slowed_by(sim);
    if (sph_foresees(&sim->cfg))
        m.foresight = g->rate * foresight(dt, (sph_real)sim->now.dt_last);
    if (SPH_HAS_RATES_FIRST && g->resumes) {
        m.kick = (sph_real)((sim->dt - sim->now.dt_last) * 0.5);
        m.bend = dt * m.kick;
    }
    return m;
}

/* displaces particles that forces move, i..i+n of src; returns false if one moves too far, not finitely, or out of
   the domain */
SPH_INLINE bool move_matter(const sph_sim *sim, const sph_move *a, uint32_t i, uint32_t n, sph_block *o, uint32_t at,
                            bool all)
{
    const sph_buffer *b = &sim->buf[sim->src];
    const vreal inv = v_set((sph_real)(1 / sim->grid.quantum)), part = v_set(a->part);
    vint bad = v_set_int(0);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        /* no further than a cell, and never so far that the integer overflows */
        const vreal far = v_set((sph_real)sim->grid.cell_size[k]);
        const sph_real *beside = sph_drift(sim, b, k);
        for (uint32_t j = 0; j < n; j += SPH_W) {
            const vreal was = v_load(b->vel[k] + i + j), f = v_load(b->acc[k] + i + j);
            const vreal v = SPH_WITH_DAMPING_RATE ? was * a->slowed : was;
            const vreal u = beside ? v + v_load(beside + i + j) : v;
            const vreal d = (u * a->drift + f * a->bend) * inv;
            const vint ok = v_less(v_abs(d), far);
            const vreal safe = v_where(ok, d);
            const vint step = v_to_int(safe + v_select(v_less(safe, v_set(0)), -part, part));
            const vint q = v_load_int(b->pos[k] + i + j) + step;
            vint wrong = ~ok | v_less_int(q, v_set_int(0)) | ~v_less_int(q, v_set_int(sim->grid.extent[k]));
            if (j + SPH_W > n) /* lanes behind the run's end may hold anything */
                wrong &= v_less(v_load(sph_lane_numbers), v_set((sph_real)(n - j)));
            bad |= wrong;
            v_store_int(o->pos[k] + at + j, q);
            if (all)
                v_store(o->vel[k] + at + j, (v + f * a->kick) * a->damping);
        }
    }
    const sph_real *const rise = sph_foresees(&sim->cfg) ? b->rise[0] + i : NULL;
    for (uint32_t j = 0; all && j < n; j += SPH_W) {
        const vreal rho = v_load(b->rho[0] + i + j) + v_load(b->drho[0] + i + j) * a->rate;
        v_store(o->rho + at + j, rise ? rho + v_load(rise + j) * a->foresight : rho);
    }
    sph_int lanes[SPH_W], any = 0;
    v_store_int(lanes, bad);
    for (int l = 0; l < SPH_W; l++)
        any |= lanes[l];
    return any == 0;
}

/* wall particles go where their group goes; their density only as its rate says */
static bool move_walls(const sph_sim *sim, const sph_move *a, const sph_set *s, uint32_t i, uint32_t n, sph_block *o,
                       uint32_t at)
{
    const bool removed = sph_wall_removed(sim, s);
    bool fine = !removed;
    const sph_buffer *b = &sim->buf[sim->src];
    /* the first sort of two is at the step's beginning, where they are */
    const bool moves = SPH_WITH_MOVING_WALLS && sim->stage->at > 0;
    for (uint32_t j = 0; j < n; j++) {
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            /* less than a domain's length (sph_move_groups), though the difference alone may not fit into a position */
            o->pos[k][at + j] = (sph_pos)(b->pos[k][i + j] + (moves ? sph_wall_step(sim, s, k) : 0));
            fine &= (o->pos[k][at + j] >= 0) & (o->pos[k][at + j] < sim->grid.extent[k]);
            o->vel[k][at + j] = b->vel[k][i + j];
        }
        o->rho[at + j] = b->rho[0][i + j];
        if (sph_is_compressible(s))
            o->rho[at + j] += b->drho[0][i + j] * a->rate;
        if (sph_is_compressible(s) && sph_foresees(&sim->cfg))
            o->rho[at + j] += b->rise[0][i + j] * a->foresight;
        o->gone[at + j] = removed;
    }
    return fine;
}

/* along the axes on which a set is held its particles go where the set goes; returns false where one leaves the
   domain */
static bool prescribe_motion(const sph_sim *sim, const sph_set *s, uint32_t i, uint32_t n, sph_block *o, uint32_t at)
{
    const sph_buffer *b = &sim->buf[sim->src];
    const uint32_t held = sph_held(sim, s);
    const bool moves = sim->stage->at > 0; /* as in move_walls */
    bool fine = true;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t j = 0; j < n && held >> k & 1; j++) {
            o->pos[k][at + j] = (sph_pos)(b->pos[k][i + j] + (moves ? sph_wall_step(sim, s, k) : 0));
            o->vel[k][at + j] = (sph_real)sph_wall_velocity(sim, s, k);
            fine &= (o->pos[k][at + j] >= 0) & (o->pos[k][at + j] < sim->grid.extent[k]);
        }
    return fine;
}

/* the slow half for one particle that is not gone: whether its way is short enough, and the rules of the domain's
   faces */
static void mend_particle(const sph_sim *sim, const sph_move *a, uint32_t i, uint32_t j, sph_block *o, bool all,
                          bool own, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->src];
    const bool matter = sph_is_matter(&sim->set[b->set[0][i]]);
    sph_pos q[SPH_DIM];
    sph_real v[SPH_DIM];
    sph_real far = 0; /* the longest way, in cells */
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        q[k] = o->pos[k][j]; // NOLINT(clang-analyzer-core.uninitialized.Assign): filled by sph_move_block
        v[k] = all ? o->vel[k][j] : 0; /* the count does not ask for velocities */
        const sph_real u = b->vel[k][i] * a->drift / (sph_real)(sim->grid.length[k] / sim->grid.ncell[k]);
        const sph_real way = u < 0 ? -u : u;
        far = !(way <= far) ? way : far;
    }
    if (own && !(far < 1) && matter)
        sph_fail_note(t, far - far == 0 ? SPH_MOVED_TOO_FAR : SPH_NOT_FINITE, b->id[0][i], (double)far);
    const uint32_t turned = sph_enforce_faces(sim, q);
    if (turned & SPH_LEFT) {
        o->gone[j] = 2;
        if (own && (sim->cfg.on_leave == SPH_FAIL || !matter))
            sph_note_left(sim, q, b->id[0][i], t);
        t->left += own && !all;
        if (SPH_WITH_BOOKS && own && !all)
            sph_carry_off(sim, b, i, t);
        return;
    }
    if (SPH_HAS_MIRRORS && own && !all && turned) {
        t->reflected += sim->stage->reflects;
        sim->turned[i] = (uint8_t)turned;
    }
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        o->pos[k][j] = q[k];
        if (all)
            o->vel[k][j] = SPH_HAS_MIRRORS && turned & SPH_TURNS_VECTORS << k ? -v[k] : v[k];
    }
}

SPH_INLINE_BIG bool move_block(const sph_sim *sim, const sph_move *a, uint32_t i, uint32_t n, bool all,
                               uint32_t own_from, uint32_t own_to, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->src];
    sph_block *o = &t->block;
    bool fine = true;
    for (uint32_t j = i; SPH_HAS_MIRRORS && !all && sim->turned && j < i + n; j++)
        if (j >= own_from && j < own_to)
            sim->turned[j] = 0;
    for (uint32_t j = 0; j < n;) {
        const uint8_t set = b->set[0][i + j];
        const uint32_t e = sph_run_end(b->set[0], i + j, i + n) - i;
        memset(o->gone + j, set == SPH_DEAD, e - j);
        if (set == SPH_DEAD)
            fine = false;
        else if (sph_is_matter(&sim->set[set])) {
            fine &= move_matter(sim, a, i + j, e - j, o, j, all);
            if (SPH_HAS_HELD && sph_held(sim, &sim->set[set]))
                fine &= prescribe_motion(sim, &sim->set[set], i + j, e - j, o, j);
        } else if (SPH_HAS_WALLS)
            fine &= move_walls(sim, a, &sim->set[set], i + j, e - j, o, j);
        j = e;
    }
    for (uint32_t j = 0; !fine && j < n; j++)
        if (!o->gone[j])
            mend_particle(sim, a, i + j, j, o, all, i + j >= own_from && i + j < own_to, t);
    return fine;
}

bool sph_move_block(const sph_sim *sim, const sph_move *a, uint32_t i, uint32_t n, bool all, uint32_t own_from,
                    uint32_t own_to, sph_thread *t)
{
    if (!SPH_SMALL && !all) /* the same text twice: the count needs no velocities */
        return move_block(sim, a, i, n, false, own_from, own_to, t);
    return move_block(sim, a, i, n, SPH_SMALL ? all : true, own_from, own_to, t);
}
