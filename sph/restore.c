/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* restore.c: sph_restore, which reads what sph_dump wrote (dump.h) into the spare buffer, looks at every value, and
   only then makes it current. */
#include "dump.h"
#include "factors.h"
#include "scratch.h"
#include "arithmetic.h"

SPH_OBJECT(restore)

#if SPH_WITH_RESTORE

/* ---- what may be in a dump with the right checksums ---- */

/* components of an option that may change */
static bool fits(sph_stream *s, uint32_t number, const char *name, const double *v, uint32_t components)
{
    for (uint32_t k = 0; k < components; k++) {
        const char *allowed = sph_option_refusal(number, v[k]);
        if (allowed)
            return sph_stream_refuse(s, SPH_DUMP_CORRUPT, name, allowed, v[k]);
    }
    return true;
}

#define FITS(A, name, kind, start, low, high, in, allowed, change, ...) FITS_##change(name, kind)
#define FITS_FIXED(name, kind)
#define FITS_ROOM(name, kind)
#define FITS_FREE(name, kind) &&fits(s, SPH_NUMBER_OF_##name, #name, DOUBLES_##kind(r->name))
#define DOUBLES_REAL(value) &(value), 1
#define DOUBLES_POSITIVE(value) &(value), 1
#define DOUBLES_VECTOR(value) (value), SPH_DIM
#define DOUBLES_WHOLE(value) &(double){value}, 1
#define DOUBLES_CHOICE(value) &(double){value}, 1
#define DOUBLES_BOOL(value) &(double){value}, 1
static bool check_free(sph_stream *s, const sph_run *r) { return true SPH_OPTIONS(FITS, FITS, ); }

static void take_free(sph_sim *sim, const sph_run *r)
{
#define TAKE(A, name, kind, start, low, high, in, allowed, change, ...) TAKE_##change(name)
#define TAKE_FREE(name) memcpy(&sim->cfg.name, &r->name, sizeof r->name);
#define TAKE_FIXED(name)
#define TAKE_ROOM(name)
    SPH_OPTIONS(TAKE, TAKE, )
#undef TAKE
}

static bool check_scalars(sph_stream *s, const sph_sim *sim, const sph_run *r)
{
    const sph_scalars *n = &sim->next;
    if (n->count > sim->cfg.max_particles)
        return sph_stream_refuse(s, SPH_DUMP_MISMATCH, "particles", "at most max_particles", n->count);
    if (n->next_id > sim->cfg.max_particles)
        return sph_stream_refuse(s, SPH_DUMP_CORRUPT, "next_id", "at most max_particles", n->next_id);
    if (!check_free(s, r))
        return false;
    if (r->limit >= SPH_LIMITS)
        return sph_stream_refuse(s, SPH_DUMP_CORRUPT, "step_limit", "one of SPH_LIMIT_...", r->limit);
    for (uint32_t g = 0; g < sim->groups; g++)
        for (int k = 0; k < SPH_DIM; k++) {
            const int64_t moved = n->group[g].moved[k], most = 2 * (int64_t)sim->grid.extent[k];
            const double(*lag)[SPH_DIM] = n->group[g].lag;
            const bool fine = (sph_abs(lag[0][k]) < 1e15 && sph_abs(lag[1][k]) < 1e15) || lag[0][k] >= SPH_NO_LAG;
            if (moved < -most || moved > most || !(sph_abs(n->group[g].vel[k]) < 1e15) || !fine)
                return sph_stream_refuse(s, SPH_DUMP_CORRUPT, "group", "as a motion may be", (double)moved);
        }
    return true;
}

static bool refuse_particle(sph_stream *s, const char *what, const char *allowed, double value, uint32_t id)
{
    sph_stream_refuse(s, SPH_DUMP_CORRUPT, what, allowed, value);
    s->fail.particle = id;
    return false;
}

/* Every particle: a known set, an id that set-up can have given, a position that the faces' rules can bring back (a
   particle put back by a wall may wait outside for the next sort). */
static bool check_particles(sph_stream *s, const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t id = b->id[0][i];
        const uint8_t set = b->set[0][i];
        if (id >= sim->cfg.max_particles)
            return refuse_particle(s, "id", "below max_particles", id, id);
        if (set != SPH_DEAD && set >= sim->sets)
            return refuse_particle(s, "set", "a set of this simulation", set, id);
        for (int k = 0; k < SPH_DIM; k++) {
            const int64_t q = b->pos[k][i], e = sim->grid.extent[k];
            if (q < -e || q >= 2 * e - sim->grid.cell_size[k])
                return refuse_particle(s, "pos", "inside the domain, or less than its length outside", (double)q, id);
        }
    }
    return true;
}

/* No id twice: ids are marked in the scratch of the threads, as many at a time as it has bits. */
static bool check_ids(sph_stream *s, sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    unsigned char *seen = (unsigned char *)sim->thread;
    const size_t bytes = sizeof *sim->thread * sim->cfg.max_threads;
    const uint64_t window = (uint64_t)bytes * 8;
    bool fine = true;
    for (uint64_t first = 0; fine && first < sim->cfg.max_particles; first += window) {
        memset(seen, 0, bytes);
        for (uint32_t i = 0; fine && i < n; i++) {
            const uint64_t at = (uint64_t)b->id[0][i] - first; /* smaller ids wrap round to large numbers */
            if (at >= window)
                continue;
            if (seen[at / 8] >> at % 8 & 1)
                fine = refuse_particle(s, "id", "each only once", b->id[0][i], b->id[0][i]);
            seen[at / 8] = (unsigned char)(seen[at / 8] | 1u << at % 8);
        }
    }
    memset(seen, 0, bytes); /* as after sph_init */
    return fine;
}

/* a component of reals, within the range of its field */
static bool check_reals(sph_stream *s, const sph_field *f, const sph_real *v, const uint32_t *id, uint32_t n)
{
    int fine = 1;
    for (uint32_t i = 0; i < n; i++)
        fine &= (v[i] - v[i] == 0) & (f->range == 0 || v[i] >= 0) & (f->range != SPH_SHARE || v[i] <= 1);
    for (uint32_t i = 0; !fine && i < n; i++)
        if (!(v[i] - v[i] == 0) || (f->range && v[i] < 0) || (f->range == SPH_SHARE && v[i] > 1))
            return refuse_particle(s, sph_field_name(f),
                                   f->range == SPH_SHARE ? "0 .. 1" : f->range ? "finite and >= 0" : "finite",
                                   (double)v[i], id[i]);
    return true;
}

/* a displacement along axis k */
static bool check_shift(sph_stream *s, const sph_sim *sim, const sph_field *f, uint32_t k, const sph_pos *d,
                        const uint32_t *id, uint32_t n)
{
    const sph_pos half = sim->grid.extent[k] / 2;
    for (uint32_t i = 0; i < n; i++)
        if (d[i] > half || d[i] < -half)
            return refuse_particle(s, sph_field_name(f), "at most half the domain", (double)d[i], id[i]);
    return true;
}

static bool check_buffer(sph_stream *s, sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    bool fine = check_particles(s, sim, b, n) && check_ids(s, sim, b, n);
    for (uint32_t f = 0; f < SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; fine && k < sph_fields[f].comps; k++) {
            const void *array = sph_array(b, sph_fields[f].at + k);
            if (array && sph_fields[f].real)
                fine = check_reals(s, &sph_fields[f], array, b->id[0], n);
            else if (array && sph_fields[f].way == SPH_DISPLACED)
                fine = check_shift(s, sim, &sph_fields[f], k, array, b->id[0], n);
        }
    return fine;
}

/* ---- restore ---- */

static bool read_all(sph_stream *s, sph_sim *sim, uint32_t spare, sph_run *r)
{
    uint64_t bytes = 0, sections = 0;
    sim->next = sim->now;
    if (!sph_read_preamble(s, &bytes, &sections) || !sph_move_setup(s, sim) ||
        !sph_move_scalars(s, sim, NULL, &sim->next, NULL, r) || !check_scalars(s, sim, r) ||
        !sph_move_arrays(s, sim, &sim->buf[spare], SPH_DUMP_FULL, sim->next.count) || !sph_move_end(s))
        return false;
    if (s->bytes != bytes || s->sections != sections)
        return sph_stream_refuse(s, SPH_DUMP_CORRUPT, "bytes", "as many as the dump's preamble says",
                                 (double)s->bytes);
    return check_buffer(s, sim, &sim->buf[spare], sim->next.count);
}

/* what a refused dump left in the spare buffer: lanes behind a row's end may read it, so it must be finite */
static void wipe(const sph_sim *sim, const sph_buffer *b)
{
    const size_t n = sim->cfg.max_particles;
    for (uint32_t f = 0; f < SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < sph_fields[f].comps; k++) {
            void *array = sph_array(b, sph_fields[f].at + k);
            if (array)
                memset(array, 0, n * sph_fields[f].bytes);
        }
}

sph_status sph_restore(sph_sim *sim, sph_source source, void *ctx)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "sph_restore", "between steps", 0, SPH_NO_PARTICLE);
    if (!source)
        return sph_error(sim, SPH_BAD_ARGUMENT, "source", "a function", 0, SPH_NO_PARTICLE);
    const uint32_t spare = (sim->cur + 1) % sim->buffers;
    sph_stream s;
    sph_run r;
    memset(&s, 0, sizeof s);
    memset(&r, 0, sizeof r);
    s.source = source;
    s.ctx = ctx;
    if (!read_all(&s, sim, spare, &r)) {
        wipe(sim, &sim->buf[spare]);
        return sph_error(sim, s.fail.status, s.fail.what, s.fail.allowed, s.fail.value, s.fail.particle);
    }
    sim->cur = spare;
    sim->now = sim->next;
    sim->table_valid = false; /* the table of cells belongs to what was there before */
    take_free(sim, &r);
    sph_make_factors(sim);
    sim->last_work = r.work;
    sim->last_pairs = r.pairs;
    sim->last_passes = r.passes;
    sim->last_limit = r.limit;
    sim->last_dt = sim->now.dt_last;
    sim->mark_particles = sim->now.count > sim->mark_particles ? sim->now.count : sim->mark_particles;
    return SPH_OK;
}
#endif
