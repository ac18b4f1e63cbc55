/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* options.c: what follows from the list of options (options.h): defaults, the check of each alone, the digest. */
#include "internal.h"
#include "arithmetic.h"

SPH_OBJECT(options)

/* what the checks and the digest ask of an option. A table of places, not of values: it stays in read-only memory.
   Bounds are floats, which hold all of them. */
typedef struct option {
    const char *name, *allowed;
    float low, high;
    uint16_t at; /* offset in sph_config */
    uint8_t kind, change;
    uint32_t in;
} option;

#define ROW(A, name, kind, start, low, high, in, allowed, change, ...)                                                \
    {#name, allowed, low, high, offsetof(sph_config, name), SPH_OPTION_##kind, SPH_OPTION_##change, in},
static const option options[] = {SPH_OPTIONS(ROW, ROW, )};
#undef ROW
_Static_assert(sizeof(sph_config) < 65536, "offsets of options have 16 bits");

/* ---- defaults ---- */

#define START_WHOLE(start) start
#define START_CHOICE(start) start
#define START_BOOL(start) start
#define START_REAL(start) start
#define START_POSITIVE(start) start
#if SPH_DIM == 1
#define START_VECTOR(start) {start}
#define START_FACES(start) {{start, start}}
#elif SPH_DIM == 2
#define START_VECTOR(start) {start, start}
#define START_FACES(start) {{start, start}, {start, start}}
#else
#define START_VECTOR(start) {start, start, start}
#define START_FACES(start) {{start, start}, {start, start}, {start, start}}
#endif

#define START(A, name, kind, start, ...) .name = START_##kind(start),
const sph_config sph_options_start = {.cookie = 0x53504801u, SPH_OPTIONS(START, START, )};
#undef START

/* ---- values ---- */

static bool is_choice(const option *o) { return o->kind == SPH_OPTION_CHOICE || o->kind == SPH_OPTION_FACES; }

static uint32_t components(const option *o)
{
    return o->kind == SPH_OPTION_VECTOR ? SPH_DIM : o->kind == SPH_OPTION_FACES ? 2 * SPH_DIM : 1;
}

/* component k of an option: a whole number, or the bits of a double */
static uint64_t bits_of(const sph_config *c, const option *o, uint32_t k)
{
    const unsigned char *p = (const unsigned char *)c + o->at;
    uint32_t u;
    uint64_t d;
    if (o->kind == SPH_OPTION_BOOL) /* a host may have put anything there */
        return *p != 0;
    if (o->kind == SPH_OPTION_WHOLE || is_choice(o)) {
        memcpy(&u, p + k * sizeof u, sizeof u);
        return u;
    }
    memcpy(&d, p + k * sizeof d, sizeof d);
    return d;
}

/* as a number */
static double value_of(const sph_config *c, const option *o, uint32_t k)
{
    const uint64_t u = bits_of(c, o, k);
    double d;
    if (o->kind == SPH_OPTION_BOOL || o->kind == SPH_OPTION_WHOLE || is_choice(o))
        return (uint32_t)u;
    memcpy(&d, &u, sizeof d);
    return d;
}

/* ---- checks ---- */

#define LEFT_OUT "a choice that was compiled in (modules.h)"

/* what would be allowed instead of a value, or null if the value is */
static const char *refusal(const option *o, double v)
{
    const double low = (double)o->low, high = (double)o->high;
    if (is_choice(o))
        return v >= high ? o->allowed : sph_in(o->in, (uint32_t)v) ? NULL : LEFT_OUT;
    if (!(v >= low && v <= high) || (o->kind == SPH_OPTION_POSITIVE && !(v > low)))
        return o->allowed;
    return o->in || !(v < 0 || v > 0) ? NULL : LEFT_OUT;
}

const char *sph_option_refusal(uint32_t number, double v) { return refusal(&options[number], v); }

sph_status sph_options_check(const sph_config *c, sph_report *r)
{
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        for (uint32_t k = 0; k < components(&options[i]); k++) {
            const double v = value_of(c, &options[i], k);
            const char *allowed = refusal(&options[i], v);
            if (allowed)
                return sph_refuse(r, options[i].name, allowed, v);
        }
    return SPH_OK;
}

/* ---- digest ---- */

/* the kinds that are mixed in together, as bits; axes come last, one after the other */
#define WORDS (1u << SPH_OPTION_WHOLE | 1u << SPH_OPTION_CHOICE)
#define BOOLS (1u << SPH_OPTION_BOOL)
#define REALS (1u << SPH_OPTION_REAL | 1u << SPH_OPTION_POSITIVE)
#define AXES (1u << SPH_OPTION_VECTOR | 1u << SPH_OPTION_FACES)

static uint64_t mix_kinds(uint64_t h, const sph_config *c, uint32_t kinds, uint32_t axis)
{
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        const option *o = &options[i];
        if (o->change != SPH_OPTION_FIXED || !(kinds >> o->kind & 1))
            continue;
        const bool faces = o->kind == SPH_OPTION_FACES;
        h = sph_mix(h, faces ? bits_of(c, o, 2 * axis) | bits_of(c, o, 2 * axis + 1) << 8 : bits_of(c, o, axis));
    }
    return h;
}

uint64_t sph_hash_config(const sph_config *c)
{
    uint64_t h = SPH_VERSION * 16u + SPH_DIM * 2u + SPH_DOUBLE;
    h = mix_kinds(h, c, WORDS, 0);
    h = mix_kinds(h, c, BOOLS, 0);
    h = mix_kinds(h, c, REALS, 0);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        h = mix_kinds(h, c, AXES, k);
    return h;
}

/* ---- changes between steps ---- */

void sph_options_take(sph_config *c, const sph_config *from)
{
    const sph_config old = *c;
    *c = *from;
#define KEEP(A, name, kind, start, low, high, in, allowed, change, ...) KEEP_##change(name)
#define KEEP_ROOM(name) c->name = old.name; /* the arena was made for it */
#define KEEP_FIXED(name)
#define KEEP_FREE(name)
    SPH_OPTIONS(KEEP, KEEP, )
#undef KEEP
#undef KEEP_ROOM
#undef KEEP_FIXED
#undef KEEP_FREE
}
