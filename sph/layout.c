/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* layout.c: the arena. One function lays every array of two lists out (arrays.h, fields.h); run with a null base it
   measures, run with the arena it assigns, so the two can never disagree.

     | sim header | arrays of the scene | state buffers (2, or 3 for Runge-Kutta) |
*/
#include "scratch.h"
#include "arithmetic.h"

SPH_OBJECT(layout)

typedef struct layout {
    unsigned char *base; /* null: measure only */
    size_t at;
    sph_arena_fn *fn; /* null: nobody is told */
    void *ctx;
    bool over; /* more than this machine can address */
} layout;

static void *reserve(layout *l, const char *name, size_t count, size_t size)
{
    if (count > (SIZE_MAX / 2 - l->at - SPH_ALIGN) / size) {
        l->over = true;
        return NULL;
    }
    size_t bytes = (count * size + SPH_ALIGN - 1) / SPH_ALIGN * SPH_ALIGN;
    void *p = l->base ? l->base + l->at : NULL;
    l->at += bytes;
    if (l->fn && bytes)
        l->fn(l->ctx, name, bytes);
    return p;
}

/* a pointer at a place of the header */
static void put(layout *l, size_t at, void *p)
{
    if (l->base)
        memcpy(l->base + at, &p, sizeof p);
}

/* ---- arrays of the scene ---- */

/* the reals of a thread's column sets that the scene wants, and where each set begins (at null: not asked) */
static uint32_t extra_reals(const sph_config *c, uint32_t *at)
{
    uint32_t reals = 0, set = 0;
    const uint32_t near = SPH_SIFTS ? SPH_NEAR_ROOM : 0;
    (void)c;
#define PLACE(name, ghosts, rows, knob, when)                                                                      \
    if (at)                                                                                                        \
        at[set] = reals;                                                                                           \
    set++;                                                                                                         \
    reals += (knob) && (when) ? (rows) * (SPH_TILE_ROOM + ((ghosts) ? 0 : SPH_HOME_ROOM) + near) : 0;
    SPH_COLUMN_SETS(PLACE)
#undef PLACE
    return reals;
}

static const struct {
    const char *name;
    uint32_t size;         /* of an element */
    uint16_t at;           /* of its pointers in the header */
    uint16_t components;
} arrays[] = {
#define ONE(name, type, count, when, what) {what, sizeof(type), offsetof(sph_sim, name), 1},
#define MANY(name, type, components, count, when, what) {what, sizeof(type), offsetof(sph_sim, name), components},
    SPH_SCENE_ARRAYS(ONE, MANY)
#undef ONE
#undef MANY
};
#define ARRAYS (sizeof arrays / sizeof *arrays)
_Static_assert(sizeof(sph_sim) < 65536, "places in the header have 16 bits");

static void lay_out_arrays(const sph_config *c, const sph_grid *g, layout *l)
{
    const size_t count[ARRAYS] = {
#define ONE(name, type, count, when, what) (when) ? (count) : 0,
#define MANY(name, type, components, count, when, what) (when) ? (count) : 0,
        SPH_SCENE_ARRAYS(ONE, MANY)
#undef ONE
#undef MANY
    };
    for (size_t a = 0; a < ARRAYS; a++)
        for (uint32_t k = 0; count[a] && k < arrays[a].components; k++)
            put(l, arrays[a].at + k * sizeof(void *), reserve(l, arrays[a].name, count[a], arrays[a].size));
}

/* ---- state buffers ---- */

static void lay_out_state(const sph_config *c, uint32_t buffer, layout *l)
{
    const size_t first = offsetof(sph_sim, buf) + buffer * sizeof(sph_buffer);
    uint64_t wanted = 0; /* a bit for each field */
    uint32_t bit = 0;
#define WANTED(name, type, comps, unit, when, way) wanted |= (uint64_t)(when) << bit++;
    SPH_STATE_FIELDS(WANTED)
#undef WANTED
    for (uint32_t f = 0; f < bit; f++)
        for (uint32_t k = 0; wanted >> f & 1 && k < sph_fields[f].comps; k++)
            put(l, first + (sph_fields[f].at + k) * sizeof(void *),
                reserve(l, sph_fields[f].label, SPH_ROOM(c), sph_fields[f].bytes));
}

static uint32_t buffers_of(const sph_config *c)
{
    return SPH_HAS_RUNGE_KUTTA && c->integrator >= SPH_RUNGE_KUTTA ? 3 : 2;
}

/* ---- the whole ---- */

static void lay_out(const sph_config *c, const sph_grid *g, layout *l)
{
    reserve(l, "header", 1, sizeof(sph_sim));
    lay_out_arrays(c, g, l);
    for (uint32_t b = 0; b < buffers_of(c); b++)
        lay_out_state(c, b, l);
}

bool sph_measure_arena(const sph_config *c, const sph_grid *g, size_t *bytes)
{
    layout l = {NULL, 0, NULL, NULL, false};
    lay_out(c, g, &l);
    *bytes = l.at;
    return !l.over;
}

sph_sim *sph_lay_out_arena(const sph_config *c, const sph_grid *g, void *arena)
{
    layout l = {arena, 0, NULL, NULL, false};
    sph_sim *sim = arena;
    lay_out(c, g, &l);
    sim->buffers = buffers_of(c);
    sim->extra_reals = extra_reals(c, sim->extra_at);
    return sim;
}

void sph_list_arena(const sph_config *c, const sph_grid *g, sph_arena_fn *fn, void *ctx)
{
    layout l = {NULL, 0, fn, ctx, false};
    lay_out(c, g, &l);
}
