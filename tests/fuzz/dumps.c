/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dumps.c: any bytes, and true dumps with some bytes changed (with or without the checksums put right again), given to
   a simulation that has run. Refused: the simulation is as it was to the last bit and its next step too. Taken: it
   steps or says why not, and its own dump restores to the same hash. */
#include "fuzz.h"

#include "tests/fuzz/crc.h"

enum { SCENES = 4, MOST_DUMP = 1 << 17 };

typedef struct scene {
    sph_sim *sim;
    void *block;
    unsigned char *arena, dump[MOST_DUMP]; /* both as they were when the dump was taken */
    size_t bytes, dump_bytes;
    uint64_t after; /* hash one step later */
} scene;

typedef struct stream {
    unsigned char *p;
    size_t n, room;
} stream;
static bool put(void *ctx, const void *p, size_t n)
{
    stream *s = ctx;
    hold(n > 0 && n <= SPH_PIECE && s->n + n <= s->room);
    memcpy(s->p + s->n, p, n);
    s->n += n;
    return true;
}
static bool get(void *ctx, void *p, size_t n)
{
    input *s = ctx;
    hold(n > 0 && n <= SPH_PIECE);
    if (n > s->n)
        return false;
    memcpy(p, s->p, n);
    s->p += n;
    s->n -= n;
    return true;
}

/* ---- scenes that have run ---- */

static void sway(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.5 * t;
    v[0] = 0.5;
}

static sph_config scene_config(uint32_t k)
{
    sph_config c = sph_config_default();
    c.spacing = SPH_DIM == 3 ? 0.5 : 0.25; /* small: a dump is written and read for every input */
    c.smoothing_length = 1.2 * c.spacing;
    c.sound_speed = 20;
    c.max_particles = SPH_DIM == 1 ? 30 : SPH_DIM == 2 ? 150 : 300;
    c.gravity[SPH_DIM - 1] = -9.81;
    c.on_cross = k;
    c.on_leave = SPH_REMOVE;
    c.integrator = k == 1 ? SPH_RUNGE_KUTTA : k == 2 ? SPH_KICK_DRIFT_KICK : k == 3 ? SPH_LEAP_FROG : 0;
    c.books = k == 1;
    c.xsph = k == 1 ? 0.5 : 0;
    c.shepard_every = k == 3;
    for (int a = 0; a < SPH_DIM; a++) {
        c.lo[a] = -2;
        c.hi[a] = 3;
        if (k == 2 && a == 0)
            c.face[a][0] = c.face[a][1] = SPH_SYMMETRY;
    }
    return c;
}

static void build(scene *s, uint32_t k)
{
    const sph_config c = scene_config(k);
    sph_wall w = sph_wall_default();
    uint32_t set, group;
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    for (int a = 0; a < SPH_DIM; a++)
        hi[a] = 1;
    s->bytes = sph_arena_bytes(&c);
    s->sim = fuzz_init(&c, &s->block);
    s->arena = malloc(s->bytes);
    hold(s->sim && s->arena);
    hold(sph_add_fluid(s->sim, NULL, &set) == SPH_OK && sph_add_box(s->sim, set, lo, hi, NULL) == SPH_OK);
    w.kind = k == 1 ? SPH_WALL_GHOST : k == 3 ? SPH_WALL_MONAGHAN_KOS : SPH_WALL_ADAMI;
    w.compressible = true;
    w.motion = k == 1 ? sway : NULL;
    hold(sph_add_wall_box(s->sim, &w, lo, hi, SPH_LOW(0) | SPH_LOW(SPH_DIM - 1), true, &group) == SPH_OK);
    if (k == 0)
        hold(sph_remove_wall_at(s->sim, group, 100) == SPH_OK);
}

static scene *get_scene(uint32_t k)
{
    static scene scenes[SCENES];
    scene *s = &scenes[k];
    if (!s->sim) {
        build(s, k);
        for (int n = 0; n < 3; n++)
            hold(sph_step(s->sim) == SPH_OK);
        memcpy(s->arena, s->block, s->bytes);
        stream out = {s->dump, 0, MOST_DUMP};
        hold(sph_dump(s->sim, SPH_DUMP_FULL, put, &out) == SPH_OK);
        s->dump_bytes = out.n;
        hold(sph_step(s->sim) == SPH_OK);
        s->after = sph_hash(s->sim);
    }
    memcpy(s->block, s->arena, s->bytes);
    return s;
}

/* ---- changing a dump ---- */

/* the checksums of a dump whose sections lie where those of `plan` do */
static void repair(unsigned char *d, size_t n, const unsigned char *plan, size_t plan_n)
{
    uint32_t chain = 0;
    size_t at = 32;
    if (n < plan_n)
        return;
    crc_put(d + 28, crc_of(0, d, 28));
    chain = crc_of(chain, d + 28, 4);
    while (at + 68 <= plan_n) {
        const size_t payload = crc_get(plan + at + 48);
        const bool end = at + 64 + payload + 4 == plan_n;
        crc_put(d + at + 60, crc_of(0, d + at, 60));
        if (end)
            crc_put(d + at + 64, chain);
        crc_put(d + at + 64 + payload, crc_of(0, d + at + 64, payload));
        chain = crc_of(crc_of(chain, d + at + 60, 4), d + at + 64 + payload, 4);
        at += 64 + payload + 4;
    }
}

static size_t mutate(input *in, const scene *s, unsigned char *d)
{
    size_t n = s->dump_bytes;
    const bool mend = pick(in, 4) != 0;
    memcpy(d, s->dump, n);
    for (uint32_t k = 1 + pick(in, 6); k > 0; k--) {
        const uint32_t how = pick(in, 6);
        const size_t at = (size_t)take(in, 3) % (n - 8) & ~(size_t)(how > 2 ? 3 : 0);
        const double x = how == 3 ? take_any(in) : 0;
        const float f = how == 4 ? (float)take_any(in) : 0;
        if (how == 3)
            memcpy(d + at, &x, 8);
        else if (how == 4)
            memcpy(d + at, &f, 4);
        else if (how == 5)
            memmove(d + at, d + (size_t)take(in, 3) % (n - 8), 8);
        else
            d[at] = (unsigned char)(how == 0 ? d[at] ^ 1u << pick(in, 8) : how == 1 ? d[at] + take(in, 1) : take(in,
                1));
    }
    if (mend)
        repair(d, n, s->dump, n);
    return pick(in, 8) == 0 ? (size_t)take(in, 3) % (n + 1) : n;
}

/* a dump that was taken: it steps or fails cleanly, and can be dumped and restored again */
static void go_on(sph_sim *sim)
{
    static unsigned char again[MOST_DUMP];
    stream out = {again, 0, MOST_DUMP};
    const uint64_t before = sph_hash(sim);
    hold(sph_count(sim) <= sim->cfg.max_particles);
    hold(sph_dump(sim, SPH_DUMP_FULL, put, &out) == SPH_OK);
    input back = {again, out.n};
    hold(sph_restore(sim, get, &back) == SPH_OK && sph_hash(sim) == before);
    for (int k = 0; k < 3; k++) {
        snapshot s;
        sph_status st = sph_ready(sim);
        if (st)
            break;
        keep_state(sim, &s);
        st = sph_step(sim);
        hold((unsigned)st < SPH_STATUS_COUNT && st != SPH_NOT_DONE);
        if (st)
            hold(state_kept(sim, &s));
        else
            free(s.arrays);
    }
}

void SPH_NAME(fuzz_dumps)(const unsigned char *data, size_t n);
void SPH_NAME(fuzz_dumps)(const unsigned char *data, size_t n)
{
    static unsigned char changed[MOST_DUMP];
    input in = {data, n};
    snapshot kept;
    const uint32_t how = (uint32_t)take(&in, 1);
    scene *s = get_scene(how % SCENES);
    if (how >> 2 & 7)
        in = (input){changed, mutate(&in, s, changed)};
    const bool same = in.n == s->dump_bytes && memcmp(in.p, s->dump, in.n) == 0;
    keep_state(s->sim, &kept);
    const sph_status st = sph_restore(s->sim, get, &in);
    if (st == SPH_OK) {
        free(kept.arrays);
        hold(!same || sph_hash(s->sim) == kept.hash);
        go_on(s->sim);
        return;
    }
    hold(!same && (st == SPH_DUMP_TRUNCATED || st == SPH_DUMP_CORRUPT || st == SPH_DUMP_FOREIGN ||
                   st == SPH_DUMP_NEWER ||
                   st == SPH_DUMP_MISMATCH));
    hold(sph_last(s->sim)->status == st && sph_last(s->sim)->what[0]);
    hold(state_kept(s->sim, &kept));
    hold(sph_step(s->sim) == SPH_OK && sph_hash(s->sim) == s->after);
}
