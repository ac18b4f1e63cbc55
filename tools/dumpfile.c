/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dumpfile.c: reads and checks dumps (see dumpfile.h; layout: sph/dump.h). */
#include "dumpfile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"
#include "sph/sph.h"

#define VERSION SPH_VERSION /* what is read here is the same in all: see sph.h */
#define PREAMBLE 32u
#define HEADER 64u
#define FIELD 32u
#define MOST_SECTIONS 1000u /* a record for each subject, an array for each field: some twenty */
#define PERIODIC 1u /* of scene.face: SPH_PERIODIC, SPH_SYMMETRY, SPH_MIRROR_NO_SLIP */
#define SYMMETRY 2u
#define MIRROR_NO_SLIP 3u
#define FARTHEST 1e30 /* m, s: what the kernel takes (sph/options.h) */

static uint64_t number(const unsigned char *p, uint32_t bytes)
{
    uint64_t v = 0;
    for (uint32_t i = bytes; i-- > 0;)
        v = v << 8 | p[i];
    return v;
}

static uint32_t crc32(uint32_t crc, const unsigned char *p, size_t n)
{
    static uint32_t table[256];
    if (!table[1])
        for (uint32_t i = 0; i < 256; i++) {
            uint32_t c = i;
            for (int k = 0; k < 8; k++)
                c = c & 1 ? c >> 1 ^ 0xedb88320u : c >> 1;
            table[i] = c;
        }
    crc = ~crc;
    while (n--)
        crc = crc >> 8 ^ table[(crc ^ *p++) & 255];
    return ~crc;
}

static uint32_t chain(uint32_t crc, const unsigned char *stored) { return crc32(crc, stored, 4); }

static bool refuse(const dump_file *d, const char *why, const char *where)
{
    host_no("%s: %s%s%s", d->name, why, *where ? ": " : "", where);
    return false;
}

uint32_t dump_type_bytes(uint32_t type)
{
    static const uint8_t bytes[] = {8, 1, 4, 4, 8, 4, 8, 8};
    return type < sizeof bytes ? bytes[type] : 0;
}
const char *dump_type_name(uint32_t type)
{
    static const char *const name[] = {"record", "u8", "u32", "i32", "i64", "f32", "f64", "u64"};
    return type < sizeof name / sizeof *name ? name[type] : "?";
}

/* ---- structure ---- */

static bool read_preamble(dump_file *d)
{
    static const unsigned char magic[8] = {0x89, 'S', 'P', 'H', 0x0d, 0x0a, 0x1a, 0x0a};
    const unsigned char *p = d->bytes;
    size_t head = d->size < sizeof magic ? d->size : sizeof magic;
    if (d->size == 0)
        return refuse(d, "the file is empty", "");
    if (memcmp(p, magic, head) != 0)
        return refuse(d, "not a dump", "");
    if (d->size < PREAMBLE)
        return refuse(d, "the dump ends too early", "in its preamble");
    if (crc32(0, p, 28) != number(p + 28, 4))
        return refuse(d, "the dump is corrupt", "checksum of the preamble");
    d->version = (uint32_t)number(p + 8, 4);
    d->dim = p[12];
    d->real_bytes = p[13];
    d->pos_bytes = p[14];
    d->full = p[15] == 1;
    d->sections = (uint32_t)number(p + 24, 4);
    if (d->version < 1 || d->version > VERSION) {
        host_no("%s: the dump has version %u, this program reads versions 1 to %u", d->name, d->version, VERSION);
        return false;
    }
    if (d->dim < 1 || d->dim > 3 || (d->real_bytes != 4 && d->real_bytes != 8) || d->pos_bytes != d->real_bytes ||
        p[15] > 1)
        return refuse(d, "the dump is corrupt", "impossible preamble");
    if (number(p + 16, 8) > d->size)
        return refuse(d, "the dump ends too early", "it is shorter than its preamble says");
    if (d->sections < 6 || d->sections > d->size / HEADER || d->sections > MOST_SECTIONS)
        return refuse(d, "the dump is corrupt", "number of sections");
    return true;
}

/* the section at *at; moves it on */
static bool read_section(dump_file *d, uint32_t k, size_t *at, uint32_t *sum)
{
    const unsigned char *h = d->bytes + *at;
    dump_section *s = &d->section[k];
    if (d->size - *at < HEADER + 4)
        return refuse(d, "the dump ends too early", "in a section's header");
    if (crc32(0, h, 60) != number(h + 60, 4))
        return refuse(d, "the dump is corrupt", "checksum of a section's header");
    memcpy(s->name, h, 16);
    memcpy(s->unit, h + 16, 16);
    s->type = (uint32_t)number(h + 32, 4);
    s->comps = (uint32_t)number(h + 36, 4);
    s->count = number(h + 40, 8);
    s->bytes = number(h + 48, 8);
    s->data = h + HEADER;
    if (number(h + 56, 4) != k || !s->name[0] || !dump_type_bytes(s->type) || s->comps == 0 || s->comps > 1000)
        return refuse(d, "the dump is corrupt", "a section's header is impossible");
    if (s->bytes > d->size - *at - HEADER - 4)
        return refuse(d, "the dump ends too early", s->name);
    if (s->type != DUMP_RECORD && (s->count > d->size || s->bytes != s->count * s->comps * dump_type_bytes(s->type)))
        return refuse(d, "the dump is corrupt: size of a section", s->name);
    if (crc32(0, s->data, s->bytes) != number(s->data + s->bytes, 4))
        return refuse(d, "the dump is corrupt: checksum of a section", s->name);
    for (uint32_t i = 0; i < k; i++)
        if (!strcmp(d->section[i].name, s->name))
            return refuse(d, "the dump is corrupt: a section is there twice", s->name);
    if (!strcmp(s->name, "end") && (s->bytes != 4 || number(s->data, 4) != *sum))
        return refuse(d, "the dump is corrupt", "checksum of all sections");
    *sum = chain(chain(*sum, h + 60), s->data + s->bytes);
    *at += HEADER + s->bytes + 4;
    return true;
}

static void read_units(dump_file *d);

/* what may stand behind the dump: notes, and nothing else */
static bool read_notes(dump_file *d, size_t at)
{
    uint32_t sum = 0;
    d->notes = "";
    if (at == d->size)
        return true;
    const uint32_t k = d->sections;
    if (!read_section(d, k, &at, &sum))
        return false;
    const dump_section *s = &d->section[k];
    if (strcmp(s->name, DUMP_NOTES) != 0 || s->type != DUMP_U8 || s->comps != 1 || at != d->size)
        return refuse(d, "the dump is corrupt", "bytes behind its end that are no notes");
    for (uint64_t i = 0; i < s->bytes; i++)
        if (s->data[i] != '\n' && (s->data[i] < ' ' || s->data[i] > '~'))
            return refuse(d, "the dump is corrupt", "its notes are no text");
    d->notes = (const char *)s->data;
    d->notes_bytes = (size_t)s->bytes;
    read_units(d);
    return true;
}

/* a record's fields must fill its payload */
static bool check_record(const dump_file *d, const dump_section *s)
{
    uint64_t row = 0;
    if (s->bytes < (uint64_t)s->comps * FIELD)
        return refuse(d, "the dump is corrupt: size of a record", s->name);
    for (uint32_t f = 0; f < s->comps; f++) {
        const unsigned char *p = s->data + f * FIELD;
        if (!p[0] || p[29] == 0 || (p[28] != DUMP_F64 && p[28] != DUMP_I64 && p[28] != DUMP_U64))
            return refuse(d, "the dump is corrupt: a field of a record", s->name);
        row += p[29];
    }
    if (s->count > d->size || s->bytes != (uint64_t)s->comps * FIELD + s->count * row * 8)
        return refuse(d, "the dump is corrupt: size of a record", s->name);
    return true;
}

/* a number from a record as a small index; nonsense becomes 0 */
static uint32_t small(double x) { return x >= 0 && x < 1e9 ? (uint32_t)x : 0; }

static bool needs(const dump_file *d, const char *record, const char *field, uint32_t comps)
{
    dump_member m;
    const dump_section *s = dump_find(d, record);
    if (!s || s->type != DUMP_RECORD || !dump_find_member(s, field, &m) || m.comps != comps)
        return refuse(d, "the dump is corrupt: it lacks", field);
    return true;
}

enum { SYMMETRIC = 99 };

/* known sets, places in the domain or less than its length outside (put back by a wall, a particle may wait there) */
static bool check_particles(const dump_file *d)
{
    for (uint32_t i = 0; i < d->n; i++) {
        if (dump_set(d, i) != DUMP_DEAD && dump_set(d, i) >= d->sets)
            return refuse(d, "the dump is corrupt", "a particle of an unknown set");
        for (uint32_t k = 0; k < d->dim; k++)
            if (!(fabs(dump_x(d, i, k) - 0.5 * (d->lo[k] + d->hi[k])) <= 1.5 * (d->hi[k] - d->lo[k]))) {
                host_no("%s: particle %u is at %g %s, far outside the domain, %g .. %g", d->name, dump_id(d, i),
                        dump_x(d, i, k), dump_unit(d, "m"), d->lo[k], d->hi[k]);
                return false;
            }
    }
    return true;
}

static bool check_arrays(dump_file *d)
{
    static const struct {
        const char *name;
        uint32_t type, comps; /* 0: that of reals, of positions (1); the dimension, SYMMETRIC: of a deviator */
    } list[] = {{"pos", 1, 0}, {"id", DUMP_U32, 1}, {"set", DUMP_U8, 1}, {"vel", 0, 0},
                {"rho", 0, 1}, {"p", 0, 1},         {"acc", 0, 0},       {"drho", 0, 1}, {"xsph", 0, 0},
                {"stress", 0, SYMMETRIC}, {"plastic", 0, 1}, {"damage", 0, 1}};
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        const dump_section *s = dump_find(d, list[k].name);
        uint32_t type = list[k].type > 1 || k == 2 ? list[k].type
                        : list[k].type             ? d->pos_bytes == 8 ? DUMP_I64 : DUMP_I32
                                                   : d->real_bytes == 8 ? DUMP_F64 : DUMP_F32;
        if (!s && k < 3)
            return refuse(d, "the dump is corrupt: it lacks", list[k].name);
        const uint32_t comps = list[k].comps == SYMMETRIC ? 2 * d->dim - 1 : list[k].comps ? list[k].comps : d->dim;
        if (s && (s->type != type || s->comps != comps || s->count != d->n))
            return refuse(d, "the dump is corrupt: shape of", list[k].name);
    }
    for (uint32_t k = 0; k + 1 < d->sections; k++) /* of arrays that are not known here too; the last is the end */
        if (d->section[k].type != DUMP_RECORD && d->section[k].count != d->n)
            return refuse(d, "the dump is corrupt: not a value for each particle in", d->section[k].name);
    d->pos = dump_find(d, "pos");
    d->id = dump_find(d, "id");
    d->set = dump_find(d, "set");
    return check_particles(d);
}

static bool within(const dump_file *d, const char *name, double v, double least, double most)
{
    if (v >= least && v <= most)
        return true;
    host_no("%s: the dump is corrupt: %s is %g, allowed: %g .. %g", d->name, name, v, least, most);
    return false;
}

/* numbers that others compute with */
static bool check_scalars(const dump_file *d)
{
    for (uint32_t k = 0; k < d->dim; k++)
        if (!within(d, "lo", d->lo[k], -FARTHEST, FARTHEST) || !within(d, "hi", d->hi[k], d->lo[k], FARTHEST))
            return false;
    for (uint32_t s = 0; s < d->sets; s++)
        if (!within(d, "role of a set", dump_number(d, "sets", "role", s, 0), 0, DUMP_GONE - 1))
            return false;
    return within(d, "quantum", d->quantum, 1e-300, FARTHEST) && within(d, "spacing", d->spacing, 1e-30, FARTHEST) &&
           within(d, "time", d->time, 0, FARTHEST);
}

static bool read_scalars(dump_file *d)
{
    if (!needs(d, "scene", "lo", d->dim) || !needs(d, "scene", "hi", d->dim) || !needs(d, "scene", "quantum", 1) ||
        !needs(d, "scene", "spacing", 1) || !needs(d, "scene", "eos", 1) || !needs(d, "scene", "pressure_floor", 1) ||
        !needs(d, "sets", "role", 1) || !needs(d, "sets", "rho0", 1) || !needs(d, "sets", "group", 1) ||
        !needs(d, "sets", "pressure_scale", 1) || !needs(d, "groups", "velocity", d->dim) ||
        !needs(d, "state", "time", 1) || !needs(d, "state", "step", 1) || !needs(d, "state", "particles", 1))
        return false;
    if (dump_find(d, "scene")->count != 1 || dump_find(d, "state")->count != 1)
        return refuse(d, "the dump is corrupt", "rows of its records");
    for (uint32_t k = 0; k < d->dim; k++) {
        d->lo[k] = dump_number(d, "scene", "lo", 0, k);
        d->hi[k] = dump_number(d, "scene", "hi", 0, k);
    }
    d->quantum = dump_number(d, "scene", "quantum", 0, 0);
    d->spacing = dump_number(d, "scene", "spacing", 0, 0);
    d->time = dump_number(d, "state", "time", 0, 0);
    dump_member m;
    dump_find_member(dump_find(d, "state"), "step", &m);
    const double steps = dump_number(d, "state", "step", 0, 0);
    d->step = m.type != DUMP_F64 ? dump_member_bits(dump_find(d, "state"), &m, 0, 0)
              : steps >= 0 && steps < 1e15 ? (uint64_t)steps : 0;
    double n = dump_number(d, "state", "particles", 0, 0);
    if (!(n >= 0 && n < 4294967295.0))
        return refuse(d, "the dump is corrupt", "number of particles");
    d->n = (uint32_t)n;
    d->sets = (uint32_t)dump_find(d, "sets")->count;
    if (d->sets > DUMP_DEAD)
        return refuse(d, "the dump is corrupt", "number of sets");
    d->eos = small(dump_number(d, "scene", "eos", 0, 0));
    d->pressure_floor = dump_number(d, "scene", "pressure_floor", 0, 0) != 0;
    return check_scalars(d) && check_arrays(d);
}

static bool read_all(dump_file *d)
{
    if (!read_preamble(d))
        return false;
    size_t at = PREAMBLE;
    uint32_t sum = chain(0, d->bytes + 28);
    d->section = host_alloc((d->sections + (size_t)1) * sizeof *d->section); /* and the notes */
    memset(d->section, 0, (d->sections + (size_t)1) * sizeof *d->section);
    for (uint32_t k = 0; k < d->sections; k++) {
        if (!read_section(d, k, &at, &sum))
            return false;
        if (d->section[k].type == DUMP_RECORD && !check_record(d, &d->section[k]))
            return false;
    }
    if (strcmp(d->section[d->sections - 1].name, "end") != 0 || at != number(d->bytes + 16, 8))
        return refuse(d, "the dump is corrupt", "its last section is not its end");
    return read_notes(d, at) && read_scalars(d);
}

bool dump_take(dump_file *d, const char *name, unsigned char *bytes, size_t size)
{
    memset(d, 0, sizeof *d);
    d->name = name;
    d->bytes = bytes;
    d->size = size;
    if (read_all(d))
        return true;
    dump_close(d);
    return false;
}

bool dump_open(dump_file *d, const char *name)
{
    size_t size;
    unsigned char *bytes = host_read(name, &size);
    memset(d, 0, sizeof *d);
    return bytes && dump_take(d, name, bytes, size);
}

void dump_close(dump_file *d)
{
    free(d->section);
    free(d->bytes);
    d->section = NULL;
    d->bytes = NULL;
}

/* ---- elements ---- */

const dump_section *dump_find(const dump_file *d, const char *name)
{
    for (uint32_t k = 0; k < d->sections; k++)
        if (!strcmp(d->section[k].name, name))
            return &d->section[k];
    return NULL;
}

uint64_t dump_bits(const dump_section *s, uint32_t comp, uint64_t i)
{
    uint32_t size = dump_type_bytes(s->type);
    uint64_t u = number(s->data + (comp * s->count + i) * size, size);
    return s->type == DUMP_I32 && u >> 31 ? u | 0xffffffff00000000u : u;
}

static double as_double(uint32_t type, uint64_t u)
{
    double d;
    float f;
    uint32_t w = (uint32_t)u;
    switch (type) {
    case DUMP_F32: memcpy(&f, &w, 4); return (double)f;
    case DUMP_F64: memcpy(&d, &u, 8); return d;
    case DUMP_I32:
    case DUMP_I64: return u >> 63 ? -(double)(~u + 1) : (double)u;
    default: return (double)u;
    }
}
double dump_value(const dump_section *s, uint32_t comp, uint64_t i)
{
    return as_double(s->type, dump_bits(s, comp, i));
}

bool dump_get_member(const dump_section *record, uint32_t f, dump_member *m)
{
    memset(m, 0, sizeof *m);
    if (f >= record->comps)
        return false;
    for (uint32_t k = 0; k < f; k++)
        m->at += record->data[k * FIELD + 29];
    const unsigned char *p = record->data + f * FIELD;
    memcpy(m->name, p, 16);
    memcpy(m->unit, p + 16, 12);
    m->type = p[28];
    m->comps = p[29];
    return true;
}
bool dump_find_member(const dump_section *record, const char *name, dump_member *m)
{
    for (uint32_t f = 0; record && dump_get_member(record, f, m); f++)
        if (!strcmp(m->name, name))
            return true;
    return false;
}

uint64_t dump_member_bits(const dump_section *record, const dump_member *m, uint64_t row, uint32_t comp)
{
    dump_member last;
    dump_get_member(record, record->comps - 1, &last);
    return number(record->data + record->comps * FIELD + (row * (last.at + last.comps) + m->at + comp) * 8, 8);
}
double dump_member_value(const dump_section *record, const dump_member *m, uint64_t row, uint32_t comp)
{
    return as_double(m->type, dump_member_bits(record, m, row, comp));
}
double dump_number(const dump_file *d, const char *record, const char *field, uint64_t row, uint32_t comp)
{
    dump_member m;
    const dump_section *s = dump_find(d, record);
    if (!s || s->type != DUMP_RECORD || !dump_find_member(s, field, &m) || row >= s->count || comp >= m.comps)
        return 0;
    return dump_member_value(s, &m, row, comp);
}

/* ---- particles ---- */

uint32_t dump_set(const dump_file *d, uint32_t i) { return (uint32_t)dump_bits(d->set, 0, i); }
uint32_t dump_id(const dump_file *d, uint32_t i) { return (uint32_t)dump_bits(d->id, 0, i); }
uint32_t dump_role(const dump_file *d, uint32_t i)
{
    uint32_t set = dump_set(d, i);
    return set == DUMP_DEAD ? DUMP_GONE : small(dump_number(d, "sets", "role", set, 0));
}
bool dump_is_wall(uint32_t role) { return role == DUMP_GHOST || role == DUMP_FORCE_WALL; }
bool dump_periodic(const dump_file *d, uint32_t axis)
{
    return dump_number(d, "scene", "face", 0, 2 * axis) == PERIODIC;
}
bool dump_mirror(const dump_file *d, uint32_t axis, uint32_t side, bool *no_slip)
{
    const double face = dump_number(d, "scene", "face", 0, 2 * axis + side);
    *no_slip = face == MIRROR_NO_SLIP;
    return *no_slip || face == SYMMETRY;
}
double dump_x(const dump_file *d, uint32_t i, uint32_t axis)
{
    return d->lo[axis] + d->quantum * dump_value(d->pos, axis, i);
}

/* ---- ids ---- */

static int by_id(const void *a, const void *b)
{
    const dump_id_at *x = a, *y = b;
    return x->id != y->id ? (x->id > y->id) - (x->id < y->id) : (x->at > y->at) - (x->at < y->at);
}

dump_id_at *dump_sort_ids(const dump_file *d)
{
    dump_id_at *p = host_alloc(d->n * sizeof *p);
    for (uint32_t i = 0; i < d->n; i++)
        p[i] = (dump_id_at){dump_id(d, i), i};
    if (d->n)
        qsort(p, d->n, sizeof *p, by_id);
    return p;
}

uint32_t dump_place(const dump_id_at *sorted, uint32_t n, uint32_t id)
{
    uint32_t low = 0, high = n;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (sorted[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < n && sorted[low].id == id ? sorted[low].at : UINT32_MAX;
}

/* ---- notes ---- */

bool dump_note(const dump_file *d, const char *key, char *out, size_t size)
{
    const size_t n = strlen(key);
    const char *end = d->notes + d->notes_bytes;
    *out = '\0';
    for (const char *line = d->notes, *next; line < end; line = next) {
        const char *stop = memchr(line, '\n', (size_t)(end - line));
        const size_t length = (size_t)((stop ? stop : end) - line);
        next = stop ? stop + 1 : end;
        if (length <= n || line[n] != '=' || memcmp(line, key, n) != 0)
            continue;
        snprintf(out, size, "%.*s", (int)(length - n - 1 < size ? length - n - 1 : size - 1), line + n + 1);
        return true;
    }
    return false;
}

const char *dump_unit(const dump_file *d, const char *unit)
{
    for (int k = 0; k < DUMP_UNITS && *d->unit[k].si; k++)
        if (!strcmp(d->unit[k].si, unit))
            return d->unit[k].own;
    return unit;
}

static void read_units(dump_file *d)
{
    static const char *const si[] = {"m", "s", "kg", "m/s", "m/s^2", "m^2/s", "kg/m^3", "Pa", "J", "W", "1/s"};
    char key[32], own[sizeof d->unit[0].own];
    int n = 0;
    for (size_t k = 0; k < sizeof si / sizeof *si; k++) {
        snprintf(key, sizeof key, "unit %s", si[k]);
        if (!dump_note(d, key, own, sizeof own) || !*own)
            continue;
        snprintf(d->unit[n].si, sizeof d->unit[n].si, "%s", si[k]);
        memcpy(d->unit[n++].own, own, sizeof own);
    }
}

static void store(unsigned char *p, uint64_t v, uint32_t bytes)
{
    for (uint32_t i = 0; i < bytes; i++)
        p[i] = (unsigned char)(v >> 8 * i);
}

/* the rest of the field stays zero */
static void store_text(unsigned char *p, const char *text)
{
    while (*text)
        *p++ = (unsigned char)*text++;
}

bool dump_put_notes(const char *text, size_t n, uint32_t index, bool (*sink)(void *ctx, const void *bytes, size_t n),
                    void *ctx)
{
    unsigned char h[HEADER] = {0}, crc[4];
    store_text(h, DUMP_NOTES);
    store_text(h + 16, "text");
    store(h + 32, DUMP_U8, 4);
    store(h + 36, 1, 4);
    store(h + 40, n, 8);
    store(h + 48, n, 8);
    store(h + 56, index, 4);
    store(h + 60, crc32(0, h, 60), 4);
    store(crc, crc32(0, (const unsigned char *)text, n), 4);
    return sink(ctx, h, HEADER) && sink(ctx, text, n) && sink(ctx, crc, 4);
}

/* ---- checks of values ---- */

bool dump_check(const dump_file *d)
{
    double most = dump_number(d, "scene", "max_particles", 0, 0);
    bool fine = true;
    if (!(most >= d->n && most < 4294967296.0)) {
        host_no("%s: %u particles, more than max_particles, %g", d->name, d->n, most);
        return false;
    }
    dump_id_at *id = dump_sort_ids(d);
    for (uint32_t i = 0; fine && i < d->n; i++)
        if (id[i].id >= most || (i && id[i].id == id[i - 1].id)) {
            host_no("%s: id %u is there twice or too large, allowed: each once, below %.0f", d->name, id[i].id, most);
            fine = false;
        }
    free(id);
    for (uint32_t k = 0; fine && k < d->sections; k++) {
        const dump_section *s = &d->section[k];
        for (uint64_t i = 0; fine && (s->type == DUMP_F32 || s->type == DUMP_F64) && i < s->count * s->comps; i++)
            if (!isfinite(dump_value(s, 0, i))) {
                host_no("%s: %s is not finite at element %llu", d->name, s->name, (unsigned long long)i);
                fine = false;
            }
    }
    return fine;
}

int dump_each(int argc, char **argv, const char *command, const char *help,
              bool (*each)(const dump_file *d, const char *name))
{
    static const char *const known[] = {NULL};
    int result = HOST_FINE;
    host_command(command);
    if (host_help(argc, argv, help))
        return HOST_FINE;
    int files = host_known_options(argc, argv, known);
    if (files < 0)
        return HOST_USAGE;
    if (files == 0)
        return host_usage("give at least one dump");
    for (int i = 1; i <= files; i++) {
        dump_file d;
        if (!dump_open(&d, argv[i])) {
            result = HOST_NO;
            continue;
        }
        if (!each(&d, argv[i]))
            result = HOST_NO;
        dump_close(&d);
    }
    return result;
}
