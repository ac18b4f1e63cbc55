/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* synthetic.h: dumps of solids written by hand in the layout of sph/dump.h, for the tests of commands. */
#ifndef SPH_SYNTHETIC_H
#define SPH_SYNTHETIC_H

#include <unistd.h>

#include "fuzz/crc.h"

/* a file of this process where such files belong */
static UNUSED void temp_name(char *out, size_t size, const char *end)
{
    const char *dir = getenv("TMPDIR");
    snprintf(out, size, "%s/sph_test_%ld%s", dir && *dir ? dir : "/tmp", (long)getpid(), end);
}

enum { SYNTH_MOST = 20000, SYNTH_SETS = 3 };

typedef struct synth {
    uint32_t dim, n;
    double lo[3], hi[3], spacing, time;
    uint32_t face[6]; /* SPH_PERIODIC ... */
    struct {
        uint32_t role, body;
        double rho0, c0, mass;
    } set[SYNTH_SETS];
    bool with_damage, with_stress, with_plastic, wrong_shape;
    struct {
        double x[3], v[3], rho, stress[5], plastic, damage; /* rho: relative excess; damage: D^(1/dim) */
        uint8_t set;
        uint32_t id;
    } part[SYNTH_MOST];
} synth;

static struct {
    unsigned char *byte;
    size_t n;
    uint32_t sections, sum;
} tape;

static void put(uint64_t v, uint32_t bytes)
{
    for (uint32_t i = 0; i < bytes; i++)
        tape.byte[tape.n++] = (unsigned char)(v >> 8 * i);
}
static void put_double(double v)
{
    uint64_t u;
    memcpy(&u, &v, 8);
    put(u, 8);
}
static void put_text(const char *text, size_t n)
{
    for (size_t i = 0, m = strlen(text); i < n; i++)
        tape.byte[tape.n++] = i < m ? (unsigned char)text[i] : 0;
}
static void chain_crc(uint32_t crc)
{
    unsigned char b[4];
    crc_put(b, crc);
    tape.sum = crc_of(tape.sum, b, 4);
}

static void begin(const char *name, uint32_t type, uint32_t comps, uint64_t count, uint64_t bytes)
{
    const size_t at = tape.n;
    put_text(name, 16);
    put_text("1", 16);
    put(type, 4);
    put(comps, 4);
    put(count, 8);
    put(bytes, 8);
    put(tape.sections++, 4);
    put(crc_of(0, tape.byte + at, 60), 4);
}
/* the payload is the last n bytes */
static void end(size_t n)
{
    const size_t at = tape.n - n;
    const uint32_t head = crc_get(tape.byte + at - 4), crc = crc_of(0, tape.byte + at, n);
    put(crc, 4);
    chain_crc(head);
    chain_crc(crc);
}

/* fields of a record: name and components; all their values are doubles here */
typedef struct synth_field {
    const char *name;
    uint32_t comps;
} synth_field;

static void put_record(const char *name, const synth_field *f, uint32_t fields, uint64_t rows, const double *value)
{
    uint64_t row = 0;
    for (uint32_t i = 0; i < fields; i++)
        row += f[i].comps;
    begin(name, 0, fields, rows, 32 * fields + 8 * row * rows);
    for (uint32_t i = 0; i < fields; i++) {
        put_text(f[i].name, 16);
        put_text("1", 12);
        put(6, 1);
        put(f[i].comps, 1);
        put(0, 2);
    }
    for (uint64_t i = 0; i < row * rows; i++)
        put_double(value[i]);
    end(32 * fields + 8 * row * rows);
}

static void put_records(const synth *s)
{
    const uint32_t d = s->dim;
    const synth_field scene[] = {{"max_particles", 1}, {"lo", d}, {"hi", d}, {"face", 2 * d}, {"quantum", 1},
                                 {"spacing", 1},       {"smoothing", 1}, {"eos", 1}, {"pressure_floor", 1}};
    const synth_field set[] = {{"role", 1},        {"group", 1},          {"mass", 1}, {"rho0", 1},
                               {"sound_speed", 1}, {"pressure_scale", 1}, {"eos", 1}};
    const synth_field material[] = {{"shear", 1}, {"body", 1}};
    const synth_field group[] = {{"velocity", d}}, state[] = {{"time", 1}, {"step", 1}, {"particles", 1}};
    double v[32], sets[SYNTH_SETS][7], materials[SYNTH_SETS][2];
    uint32_t n = 0;
    v[n++] = SYNTH_MOST;
    for (uint32_t k = 0; k < d; k++)
        v[n++] = s->lo[k];
    for (uint32_t k = 0; k < d; k++)
        v[n++] = s->hi[k];
    for (uint32_t k = 0; k < 2 * d; k++)
        v[n++] = s->face[k];
    v[n++] = 1.0 / (1 << 30);
    v[n++] = s->spacing;
    v[n++] = 1.5 * s->spacing;
    v[n++] = 0;
    v[n++] = 0;
    put_record("scene", scene, 9, 1, v);
    for (int i = 0; i < SYNTH_SETS; i++) {
        const double c2 = s->set[i].c0 * s->set[i].c0;
        const double row[] = {s->set[i].role, 0, s->set[i].mass, s->set[i].rho0, s->set[i].c0, s->set[i].rho0 * c2,
                              SPH_LINEAR};
        memcpy(sets[i], row, sizeof row);
        materials[i][0] = 0.3 * s->set[i].rho0 * c2;
        materials[i][1] = s->set[i].body;
    }
    put_record("sets", set, 7, SYNTH_SETS, sets[0]);
    put_record("materials", material, 2, SYNTH_SETS, materials[0]);
    v[0] = v[1] = v[2] = 0;
    put_record("groups", group, 1, 1, v);
    v[0] = s->time;
    v[1] = 5;
    v[2] = s->n;
    put_record("state", state, 3, 1, v);
}

/* a component of an array of doubles, from the offset of its member */
static void put_reals(const synth *s, const char *name, uint32_t comps, size_t offset)
{
    begin(name, 6, comps, s->n, 8ull * comps * s->n);
    for (uint32_t k = 0; k < comps; k++)
        for (uint32_t i = 0; i < s->n; i++) {
            double x;
            memcpy(&x, (const char *)&s->part[i] + offset + 8 * k, 8);
            put_double(x);
        }
    end(8ull * comps * s->n);
}
#define MEMBER(m) ((size_t)((const char *)&s->part[0].m - (const char *)&s->part[0]))

static void put_arrays(const synth *s)
{
    begin("pos", 4, s->dim, s->n, 8ull * s->dim * s->n);
    for (uint32_t k = 0; k < s->dim; k++)
        for (uint32_t i = 0; i < s->n; i++)
            put((uint64_t)(int64_t)floor((s->part[i].x[k] - s->lo[k]) * (1 << 30) + 0.5), 8);
    end(8ull * s->dim * s->n);
    begin("id", 2, 1, s->n, 4ull * s->n);
    for (uint32_t i = 0; i < s->n; i++)
        put(s->part[i].id, 4);
    end(4ull * s->n);
    begin("set", 1, 1, s->n, s->n);
    for (uint32_t i = 0; i < s->n; i++)
        put(s->part[i].set, 1);
    end(s->n);
    put_reals(s, "vel", s->dim, MEMBER(v));
    put_reals(s, "rho", 1, MEMBER(rho));
    if (s->with_stress)
        put_reals(s, "stress", s->wrong_shape ? 5 - s->dim : 2 * s->dim - 1, MEMBER(stress));
    if (s->with_plastic)
        put_reals(s, "plastic", 1, MEMBER(plastic));
    if (s->with_damage)
        put_reals(s, "damage", 1, MEMBER(damage));
}

static UNUSED void synth_write(const synth *s, const char *name)
{
    static const unsigned char magic[8] = {0x89, 'S', 'P', 'H', 0x0d, 0x0a, 0x1a, 0x0a};
    FILE *f = fopen(name, "wb");
    assert_non_null(f);
    tape.byte = malloc(200u * s->n + 10000);
    assert_non_null(tape.byte);
    memcpy(tape.byte, magic, 8);
    tape.n = 32;
    tape.sections = tape.sum = 0;
    unsigned char first[4];
    /* the preamble's checksum, needed for the chain, is known when the number of bytes is: write twice */
    size_t bytes = 0;
    for (int round = 0; round < 2; round++) {
        const uint32_t sections = tape.sections;
        tape.n = 8;
        put(SPH_VERSION, 4);
        put(s->dim, 1);
        put(8, 1);
        put(8, 1);
        put(1, 1);
        put(bytes, 8);
        put(sections, 4);
        put(crc_of(0, tape.byte, 28), 4);
        memcpy(first, tape.byte + 28, 4);
        tape.sections = 0;
        tape.sum = crc_of(0, first, 4);
        put_records(s);
        put_arrays(s);
        const uint32_t sum = tape.sum;
        begin("end", 2, 1, 1, 4);
        put(sum, 4);
        end(4);
        bytes = tape.n;
    }
    assert_int_equal(fwrite(tape.byte, 1, tape.n, f), tape.n);
    assert_int_equal(fclose(f), 0);
    free(tape.byte);
}

/* an empty scene of one solid, set 0, in a domain from 0 to the given edges; set 1 is another solid, set 2 a wall */
static UNUSED synth *synth_new(uint32_t dim, double spacing, double edge_x, double edge_y, double edge_z)
{
    static synth s;
    const double edge[3] = {edge_x, edge_y, edge_z};
    double volume = 1;
    memset(&s, 0, sizeof s);
    s.dim = dim;
    s.spacing = spacing;
    s.time = 0.5;
    for (uint32_t k = 0; k < dim; k++) {
        s.hi[k] = edge[k];
        volume *= spacing;
    }
    for (int i = 0; i < SYNTH_SETS; i++) {
        s.set[i].role = i < 2 ? 3 : 1;
        s.set[i].body = (uint32_t)i;
        s.set[i].rho0 = 1000;
        s.set[i].c0 = 10;
        s.set[i].mass = 1000 * volume;
    }
    s.with_damage = s.with_stress = s.with_plastic = true;
    return &s;
}
/* cells of the spacing whose centres lie in the box */
static UNUSED void synth_box(synth *s, uint8_t set, const double lo[3], const double hi[3])
{
    uint32_t n[3] = {1, 1, 1};
    for (uint32_t k = 0; k < s->dim; k++)
        n[k] = (uint32_t)floor((hi[k] - lo[k]) / s->spacing + 0.5);
    for (uint32_t at = 0; at < n[0] * n[1] * n[2]; at++) {
        const uint32_t cell[3] = {at % n[0], at / n[0] % n[1], at / n[0] / n[1]};
        assert_true(s->n < SYNTH_MOST);
        for (uint32_t k = 0; k < s->dim; k++)
            s->part[s->n].x[k] = lo[k] + (cell[k] + 0.5) * s->spacing;
        s->part[s->n].set = set;
        s->part[s->n].id = s->n;
        s->n++;
    }
}

#endif
