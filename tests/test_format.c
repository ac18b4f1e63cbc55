/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_format.c: a dump is read by the page in sph/dump.h alone, byte for byte, with no part of the kernel's reader:
   names, units, types, components and values of records and arrays are what sph.h and its functions say. */
#include "testing.h"

#include "fuzz/crc.h"

#define DX 0.25

enum { ROOM = 1 << 18, RECORD = 0, U8 = 1, U32 = 2, I32 = 3, I64 = 4, F32 = 5, F64 = 6, U64 = 7 };
static unsigned char bytes[ROOM];
static size_t length;

static bool take(void *ctx, const void *p, size_t n)
{
    (void)ctx;
    assert_true(length + n <= ROOM && n <= SPH_PIECE);
    memcpy(bytes + length, p, n);
    length += n;
    return true;
}

static uint64_t number(const unsigned char *p, uint32_t n)
{
    uint64_t v = 0;
    while (n-- > 0)
        v = v << 8 | p[n];
    return v;
}
static double real(const unsigned char *p, uint32_t type)
{
    const uint64_t u = number(p, type == F32 ? 4 : 8);
    const uint32_t w = (uint32_t)u;
    double d;
    float f;
    memcpy(&d, &u, 8);
    memcpy(&f, &w, 4);
    return type == F32 ? (double)f : d;
}
/* a text in n bytes, the rest of them zeros */
static void text_is(const unsigned char *p, const char *want, size_t n)
{
    assert_true(strlen(want) < n);
    assert_memory_equal(p, want, strlen(want));
    for (size_t i = strlen(want); i < n; i++)
        assert_int_equal(p[i], 0);
}

/* the header of the section called `name`; its payload is 64 bytes further; null: there is none */
static const unsigned char *find(const char *name)
{
    size_t at = 32;
    for (uint32_t k = 0; k < number(bytes + 24, 4); k++, at += 64 + number(bytes + at + 48, 8) + 4) {
        assert_true(at + 68 <= length);
        assert_int_equal(number(bytes + at + 56, 4), k);
        if (strncmp((const char *)bytes + at, name, 16) == 0)
            return bytes + at;
    }
    return NULL;
}

/* component c of a field in row r of a record; its unit, type and number of components are the ones wanted */
static const unsigned char *field(const char *record, const char *name, const char *unit, uint32_t type, uint32_t comps,
                                  uint32_t r, uint32_t c)
{
    const unsigned char *s = find(record), *f;
    assert_non_null(s);
    assert_int_equal(number(s + 32, 4), RECORD);
    const uint32_t fields = (uint32_t)number(s + 36, 4);
    const uint64_t rows = number(s + 40, 8);
    uint64_t row = 0, at = 0;
    bool found = false;
    assert_true(r < rows && c < comps);
    f = s + 64;
    for (uint32_t k = 0; k < fields; k++, f += 32) {
        if (strncmp((const char *)f, name, 16) == 0) {
            found = true;
            at = row;
            text_is(f, name, 16);
            text_is(f + 16, unit, 12);
            assert_int_equal(f[28], type);
            if (f[29] != comps)
                fail_msg("%s.%s has %u components, wanted %u", record, name, f[29], comps);
            assert_int_equal(number(f + 30, 2), 0);
        }
        row += 8u * f[29];
    }
    if (!found)
        fail_msg("record %s has no %s", record, name);
    assert_int_equal(number(s + 48, 8), 32u * fields + row * rows);
    return s + 64 + 32u * fields + row * r + at + 8u * c;
}
#define real_is(record, name, unit, comps, r, c, want)                                                      \
    do {                                                                                                    \
        const double is_ = real(field(record, name, unit, F64, comps, r, c), F64), want_ = (want);          \
        if (!(is_ >= want_ && is_ <= want_))                                                                \
            fail_msg("%s.%s[%u] is %.17g, wanted %.17g", record, name, (unsigned)(c), is_, want_);          \
    } while (0)
#define whole_is(record, name, type, comps, r, c, want)                                                     \
    do {                                                                                                    \
        const uint64_t is_ = number(field(record, name, "1", type, comps, r, c), 8), want_ = (want);        \
        if (is_ != want_)                                                                                   \
            fail_msg("%s.%s[%u] is %llu, wanted %llu", record, name, (unsigned)(c), (unsigned long long)is_, \
                     (unsigned long long)want_);                                                            \
    } while (0)

static void sway(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.1 * t;
    v[0] = 0.1;
}

/* every number of the configuration is another one */
static sph_config odd_config(void)
{
    sph_config c = open_config(1, DX);
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = -1.25 - 0.125 * k;
        c.hi[k] = 2.5 + 0.25 * k;
        c.gravity[k] = -3 - k;
        c.face[k][0] = SPH_SYMMETRY;
    }
    c.max_particles = 300;
    c.smoothing_length = 0.375;
    c.rho0 = 1025;
    c.sound_speed = 21;
    c.kernel = SPH_QUINTIC;
    c.eos = SPH_LINEAR;
    c.integrator = SPH_LEAP_FROG;
    c.books = true;
    c.xsph = 0.25;
    c.damping = 0.9375;
    c.dt_max = 1e-3;
    c.pressure_floor = true;
    return c;
}
static sph_sim *water_and_wall(const sph_config *c, uint32_t *set)
{
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], v[SPH_DIM] = {0.5};
    sph_sim *sim = new_sim(c);
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 0.75;
    w.kind = SPH_WALL_GHOST;
    w.layers = 2;
    w.motion = sway;
    w.no_slip = true;
    must(sim, sph_add_fluid(sim, NULL, set));
    must(sim, sph_add_box(sim, *set, lo, hi, v));
    must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    for (int k = 0; k < 3; k++)
        must(sim, sph_step(sim));
    return sim;
}
static void dump(sph_sim *sim, uint32_t fields)
{
    length = 0;
    must(sim, sph_dump(sim, fields, take, NULL));
}

static void the_preamble_and_every_header_are_as_written_down(void **state)
{
    static const unsigned char magic[8] = {0x89, 'S', 'P', 'H', 0x0d, 0x0a, 0x1a, 0x0a};
    const sph_config c = odd_config();
    uint32_t set, k = 0, chain;
    unsigned char four[4];
    (void)state;
    dump(water_and_wall(&c, &set), SPH_DUMP_FULL);
    assert_memory_equal(bytes, magic, 8);
    assert_int_equal(number(bytes + 8, 4), SPH_VERSION);
    assert_int_equal(bytes[12], SPH_DIM);
    assert_int_equal(bytes[13], SPH_DOUBLE ? 8 : 4);
    assert_int_equal(bytes[14], SPH_DOUBLE ? 8 : 4);
    assert_int_equal(bytes[15], 1); /* full */
    assert_int_equal(number(bytes + 16, 8), length);
    assert_int_equal(number(bytes + 28, 4), crc_of(0, bytes, 28));
    chain = crc_of(0, bytes + 28, 4);
    const unsigned char *end = find("end");
    assert_non_null(end);
    for (const unsigned char *s = bytes + 32; s < end; k++) {
        const uint64_t n = number(s + 48, 8);
        assert_int_equal(number(s + 56, 4), k);
        assert_int_equal(number(s + 60, 4), crc_of(0, s, 60));
        crc_put(four, crc_of(0, s + 64, n));
        assert_memory_equal(s + 64 + n, four, 4);
        chain = crc_of(crc_of(chain, s + 60, 4), four, 4);
        s += 64 + n + 4;
    }
    assert_int_equal(number(bytes + 24, 4), k + 1);
    assert_int_equal(number(end + 32, 4), U32);
    assert_int_equal(number(end + 64, 4), chain);
    assert_ptr_equal(end + 64 + 4 + 4, bytes + length);
}

static void the_scene_is_the_configuration(void **state)
{
    const sph_config c = odd_config();
    uint32_t set;
    (void)state;
    dump(water_and_wall(&c, &set), SPH_DUMP_FULL);
    whole_is("scene", "max_particles", U64, 1, 0, 0, c.max_particles);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        real_is("scene", "lo", "m", SPH_DIM, 0, k, c.lo[k]);
        real_is("scene", "hi", "m", SPH_DIM, 0, k, c.hi[k]);
        whole_is("scene", "face", U64, 2 * SPH_DIM, 0, 2 * k, c.face[k][0]);
        whole_is("scene", "face", U64, 2 * SPH_DIM, 0, 2 * k + 1, c.face[k][1]);
        real_is("run", "gravity", "m/s^2", SPH_DIM, 0, k, c.gravity[k]);
    }
    real_is("scene", "spacing", "m", 1, 0, 0, c.spacing);
    real_is("scene", "smoothing", "m", 1, 0, 0, c.smoothing_length);
    real_is("scene", "support", "m", 1, 0, 0, 3 * c.smoothing_length);
    whole_is("scene", "kernel", U64, 1, 0, 0, c.kernel);
    whole_is("scene", "scheme", U64, 1, 0, 0, c.scheme);
    whole_is("scene", "density", U64, 1, 0, 0, c.density);
    whole_is("scene", "integrator", U64, 1, 0, 0, c.integrator);
    whole_is("scene", "eos", U64, 1, 0, 0, c.eos);
    whole_is("scene", "pressure_floor", U64, 1, 0, 0, 1);
    whole_is("scene", "solid", U64, 1, 0, 0, SPH_NO_SOLID);
    real_is("scene", "rho0", "kg/m^3", 1, 0, 0, c.rho0);
    real_is("scene", "sound_speed", "m/s", 1, 0, 0, c.sound_speed);
    real_is("run", "damping", "1", 1, 0, 0, c.damping);
    real_is("run", "dt_fixed", "s", 1, 0, 0, 0);
}

static void sets_and_groups_are_those_of_the_scene(void **state)
{
    const sph_config c = odd_config();
    uint32_t set;
    sph_particle p;
    (void)state;
    sph_sim *sim = water_and_wall(&c, &set);
    dump(sim, SPH_DUMP_FULL);
    assert_int_equal(number(find("sets") + 40, 8), 2);
    assert_int_equal(number(find("groups") + 40, 8), 1);
    assert_null(find("materials"));
    assert_int_equal(sph_get(sim, 0, &p), SPH_OK);
    for (uint32_t s = 0; s < 2; s++) {
        const bool wall = s != set;
        whole_is("sets", "role", U64, 1, s, 0, wall ? SPH_ROLE_GHOST : SPH_ROLE_FLUID);
        whole_is("sets", "no_slip", U64, 1, s, 0, wall);
        whole_is("sets", "compressible", U64, 1, s, 0, 0);
        whole_is("sets", "corner", U64, 1, s, 0, 0);
        whole_is("sets", "eos", U64, 1, s, 0, SPH_LINEAR);
        real_is("sets", "mass", "kg", 1, s, 0, p.mass);
        real_is("sets", "rho0", "kg/m^3", 1, s, 0, c.rho0);
        real_is("sets", "sound_speed", "m/s", 1, s, 0, c.sound_speed);
        real_is("sets", "pressure_scale", "Pa", 1, s, 0, c.rho0 * c.sound_speed * c.sound_speed);
    }
    whole_is("sets", "kind", U64, 1, 1, 0, SPH_WALL_GHOST);
    whole_is("sets", "group", U64, 1, 1, 0, 0);
    real_is("sets", "normal", "1", SPH_DIM, 1, 0, 1);
    real_is("sets", "origin", "m", SPH_DIM, 1, 0, -c.lo[0]);
    real_is("sets", "thick", "m", 1, 1, 0, 2 * DX);
    for (uint32_t k = 1; k < SPH_DIM; k++) { /* a tank's face reaches behind its neighbours by the layers */
        real_is("sets", "origin", "m", SPH_DIM, 1, k, 0.375 - c.lo[k]);
        real_is("sets", "half", "m", 2, 1, k - 1, 0.375 + 2 * DX);
        real_is("sets", "normal", "1", SPH_DIM, 1, k, 0);
    }
    real_is("groups", "velocity", "m/s", SPH_DIM, 0, 0, 0.1);
    assert_true(real(field("groups", "remove_at", "s", F64, 1, 0, 0), F64) >= 1e300); /* never */
    whole_is("groups", "removed", U64, 1, 0, 0, 0);
    const double quantum = real(field("scene", "quantum", "m", F64, 1, 0, 0), F64);
    const int64_t moved = (int64_t)number(field("groups", "moved", "quantum", I64, SPH_DIM, 0, 0), 8);
    close_to((double)moved * quantum, 0.1 * sph_time(sim), 2 * quantum);
}

static void the_state_is_what_the_readers_say(void **state)
{
    const sph_config c = odd_config();
    uint32_t set;
    sph_step_info i;
    sph_totals t;
    (void)state;
    sph_sim *sim = water_and_wall(&c, &set);
    dump(sim, SPH_DUMP_FULL);
    sph_get_step(sim, &i);
    sph_get_totals(sim, &t);
    real_is("state", "time", "s", 1, 0, 0, i.time);
    real_is("state", "dt", "s", 1, 0, 0, i.dt);
    whole_is("state", "step", U64, 1, 0, 0, 3);
    whole_is("state", "particles", U64, 1, 0, 0, sph_count(sim));
    whole_is("state", "left", U64, 1, 0, 0, i.left);
    whole_is("state", "crossed", U64, 1, 0, 0, i.crossed);
    whole_is("state", "put_back", U64, 1, 0, 0, i.put_back);
    whole_is("state", "reflected", U64, 1, 0, 0, i.reflected);
    whole_is("state", "primed", U64, 1, 0, 0, 1);
    whole_is("state", "started", U64, 1, 0, 0, 1);
    assert_true(real(field("state", "peak_speed", "m/s", F64, 1, 0, 0), F64) > 0);
    assert_true(real(field("state", "peak_acc", "m/s^2", F64, 1, 0, 0), F64) > 0);
    assert_true(real(field("state", "peak_mu", "1/s", F64, 1, 0, 0), F64) > 0);
    real_is("state", "damped", "J", 1, 0, 0, t.damped);
    real_is("state", "absorbed", "J", 1, 0, 0, t.absorbed);
    real_is("state", "removed_mass", "kg", 1, 0, 0, t.removed_mass);
    whole_is("run", "step_work", U64, 1, 0, 0, i.work);
    whole_is("run", "step_pairs", U64, 1, 0, 0, i.pairs);
    whole_is("run", "step_passes", U64, 1, 0, 0, i.passes);
    whole_is("run", "step_limit", U64, 1, 0, 0, i.limit);
}

/* element i of component k of an array of n */
static const unsigned char *element(const char *name, const char *unit, uint32_t type, uint32_t comps, uint32_t k,
                                    uint32_t i)
{
    const unsigned char *s = find(name);
    const uint32_t size = type == U8 ? 1 : type == U32 || type == I32 || type == F32 ? 4 : 8;
    if (!s)
        fail_msg("no array %s", name);
    const uint64_t n = number(s + 40, 8);
    text_is(s, name, 16);
    text_is(s + 16, unit, 16);
    assert_int_equal(number(s + 32, 4), type);
    assert_int_equal(number(s + 36, 4), comps);
    assert_int_equal(number(s + 48, 8), n * comps * size);
    assert_true(i < n);
    return s + 64 + (k * n + i) * size;
}
enum { REAL = SPH_DOUBLE ? F64 : F32, POS = SPH_DOUBLE ? I64 : I32 };

static void arrays_hold_what_sph_get_says(void **state)
{
    const sph_config c = odd_config();
    uint32_t set;
    (void)state;
    sph_sim *sim = water_and_wall(&c, &set);
    dump(sim, SPH_DUMP_FULL);
    const double quantum = real(field("scene", "quantum", "m", F64, 1, 0, 0), F64);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        assert_int_equal(number(element("id", "1", U32, 1, 0, i), 4), p.id);
        assert_int_equal(number(element("set", "1", U8, 1, 0, i), 1), p.set);
        const double rho = real(element("rho", "1", REAL, 1, 0, i), REAL);
        close_to(c.rho0 * (1 + rho), p.rho, 1e-12 * c.rho0);
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const uint64_t u = number(element("pos", "quantum", POS, SPH_DIM, k, i), SPH_DOUBLE ? 8 : 4);
            const int64_t pos = SPH_DOUBLE ? (int64_t)u : (int32_t)(uint32_t)u;
            close_to(c.lo[k] + (double)pos * quantum, p.x[k], 1e-12);
            const double v = real(element("vel", "m/s", REAL, SPH_DIM, k, i), REAL);
            const double a = real(element("acc", "m/s^2", REAL, SPH_DIM, k, i), REAL);
            assert_true(p.set != set || (v >= p.v[k] && v <= p.v[k]));
            assert_true(a >= p.a[k] && a <= p.a[k]);
        }
    }
}

/* what is asked for and nothing else; position, set and id always */
static void a_reduced_dump_holds_what_was_asked_for(void **state)
{
    static const struct {
        uint32_t bit;
        const char *name;
    } of[] = {{SPH_DUMP_VELOCITY, "vel"}, {SPH_DUMP_DENSITY, "rho"}, {SPH_DUMP_PRESSURE, "p"},
              {SPH_DUMP_ACCELERATION, "acc"}, {SPH_DUMP_STRESS, "stress"}, {SPH_DUMP_DAMAGE, "plastic"},
              {SPH_DUMP_DAMAGE, "damage"}};
    const sph_config c = odd_config();
    uint32_t set;
    (void)state;
    sph_sim *sim = water_and_wall(&c, &set);
    for (uint32_t fields = 0; fields < 128; fields++) {
        dump(sim, fields);
        assert_int_equal(bytes[15], 0);
        assert_true(find("pos") && find("id") && find("set") && !find("drho") && !find("xsph"));
        for (uint32_t k = 0; k < 4; k++)
            assert_int_equal(find(of[k].name) != NULL, (fields & of[k].bit) != 0);
        assert_true(!find("stress") && !find("plastic") && !find("damage") && !find("energy")); /* water has none */
        if (fields & SPH_DUMP_PRESSURE)
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                sph_particle p;
                assert_int_equal(sph_get(sim, i, &p), SPH_OK);
                const double is = real(element("p", "Pa", REAL, 1, 0, i), REAL);
                close_to(is, p.p, 2 * EPS * fabs(p.p));
            }
    }
    assert_int_equal(sph_dump(sim, 128, take, NULL), SPH_BAD_ARGUMENT);
    dump(sim, SPH_DUMP_FULL);
    assert_null(find("p"));
}

static void a_solids_materials_and_arrays_are_there(void **state)
{
    sph_config c = odd_config();
    const sph_solid rock = {.shear = 1e6, .yield = 20, .hardening = 30};
    double lo[SPH_DIM] = {0}, hi[SPH_DIM], v[SPH_DIM] = {0.5};
    uint32_t set;
    (void)state;
    c.xsph = 0;
    c.pressure_floor = false;
    c.solid = SPH_UPDATED;
    c.yield = SPH_VON_MISES;
    for (int k = 0; k < SPH_DIM; k++) {
        hi[k] = 0.75;
        c.face[k][0] = SPH_OPEN;
    }
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_solid(sim, &rock, &set, NULL));
    must(sim, sph_add_box(sim, set, lo, hi, v));
    must(sim, sph_step(sim));
    dump(sim, SPH_DUMP_STRESS);
    assert_true(find("stress") && !find("plastic") && !find("dstress"));
    dump(sim, SPH_DUMP_DAMAGE);
    assert_true(!find("stress") && find("plastic"));
    dump(sim, SPH_DUMP_FULL);
    whole_is("scene", "solid", U64, 1, 0, 0, SPH_UPDATED);
    whole_is("sets", "role", U64, 1, 0, 0, SPH_ROLE_SOLID);
    real_is("materials", "shear", "Pa", 1, 0, 0, rock.shear);
    real_is("materials", "yield", "Pa", 1, 0, 0, rock.yield);
    real_is("materials", "hardening", "Pa", 1, 0, 0, rock.hardening);
    assert_true(real(field("materials", "crack_rate", "1/s", F64, 1, 0, 0), F64) > 0);
    whole_is("materials", "held", U64, 1, 0, 0, 0);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle p;
        assert_int_equal(sph_get(sim, i, &p), SPH_OK);
        const double plastic = real(element("plastic", "1", REAL, 1, 0, i), REAL);
        const double sxx = real(element("stress", "Pa", REAL, SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? 3 : 5, 0, i), REAL);
        assert_true(plastic >= p.plastic && plastic <= p.plastic);
        close_to(sxx - p.p, p.stress[0], 8 * EPS * (fabs(p.p) + fabs(sxx)));
    }
}

/* ---- walls: what sph.h says of them ---- */

static sph_sim *empty_tank(uint32_t max)
{
    sph_config c = odd_config();
    c.max_particles = max;
    for (int k = 0; k < SPH_DIM; k++)
        c.face[k][0] = SPH_OPEN;
    return new_sim(&c);
}

/* the usual strengths where none is given (section 6 of sph.h), and the one given */
static void a_wall_without_a_strength_has_the_usual_one(void **state)
{
    const sph_config c = odd_config();
    const double c2 = c.sound_speed * c.sound_speed;
    /* g H with Gray's c^2 = 200 g H; 0.01; 0.01 c0^2/dx; layers have none */
    const double usual[SPH_WALLS] = {c2 / 200, 0.01, 0.01 * c2 / DX, 0, 0};
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = 0.75;
    for (uint32_t kind = 0; kind < SPH_WALLS; kind++)
        for (int given = 0; given < 2; given++) {
            sph_wall w = sph_wall_default();
            sph_sim *sim = empty_tank(3000);
            w.kind = kind;
            w.strength = given ? 0.625 : 0;
            must(sim, sph_add_wall_box(sim, &w, lo, hi, SPH_LOW(0), true, NULL));
            dump(sim, SPH_DUMP_FULL);
            const double is = real(field("sets", "strength", "1", F64, 1, 0, 0), F64);
            const double want = given ? 0.625 : usual[kind];
            close_to(is, want, 1e-12 * want);
            const bool layers = kind == SPH_WALL_GHOST || kind == SPH_WALL_ADAMI;
            whole_is("sets", "role", U64, 1, 0, 0, layers ? SPH_ROLE_GHOST : SPH_ROLE_FORCE_WALL);
            assert_int_equal(free_sims(NULL), 0);
        }
}

/* Sets of a box: side by side on each face and corner. Of the k-th set of the record: its normal must be the diagonal
   of the sides it lies on, its origin in the middle of the face, its half extents those of the face, deeper by the
   layers inside a tank; an obstacle's are no deeper than to its middle. */
static void a_boxs_faces_stand_where_they_should(void **state)
{
    double lo[SPH_DIM], hi[SPH_DIM];
    const double edge[3] = {0.75, 1, 1.25};
    (void)state;
    for (int k = 0; k < SPH_DIM; k++) {
        lo[k] = 0.25 * k;
        hi[k] = lo[k] + edge[k];
    }
    for (int inside = 0; inside < 2; inside++)
        for (uint32_t f = 0; f < 2 * SPH_DIM; f++) {
            const uint32_t axis = f / 2, high = f % 2;
            sph_wall w = sph_wall_default();
            const sph_config c = odd_config();
            sph_sim *sim = empty_tank(6000);
            w.layers = 2;
            must(sim, sph_add_wall_box(sim, &w, lo, hi, 1u << f, inside, NULL));
            dump(sim, SPH_DUMP_FULL);
            assert_int_equal(number(find("sets") + 40, 8), 1);
            /* 2 dx deep; an obstacle no deeper than to the middle of its shortest edge */
            const double thick = inside ? 2 * DX : 0.375;
            real_is("sets", "thick", "m", 1, 0, 0, thick);
            for (uint32_t k = 0, t = 0; k < SPH_DIM; k++) {
                const double out = high ? 1 : -1;
                real_is("sets", "normal", "1", SPH_DIM, 0, k, k != axis ? 0 : inside ? -out : out);
                close_to(real(field("sets", "origin", "m", F64, SPH_DIM, 0, k), F64),
                         (k != axis ? 0.5 * (lo[k] + hi[k]) : high ? hi[k] : lo[k]) - c.lo[k], 1e-12);
                if (k != axis)
                    close_to(real(field("sets", "half", "m", F64, 2, 0, t++), F64),
                             0.5 * edge[k] + (inside ? 2 * DX : 0), 1e-12);
            }
            assert_int_equal(free_sims(NULL), 0);
        }
}

#if SPH_DIM == 2
static void a_segment_looks_to_its_left(void **state)
{
    const double a[2] = {-0.3, 0.2}, b[2] = {0.6, 1.4}; /* 1.5 long, along (3, 4)/5 */
    const sph_config c = odd_config();
    (void)state;
    for (int rows = 0; rows < 2; rows++) {
        sph_wall w = sph_wall_default();
        sph_sim *sim = empty_tank(300);
        w.kind = rows ? SPH_WALL_KERNEL_FORCE : SPH_WALL_GHOST;
        w.layers = 3;
        must(sim, sph_add_wall_segment(sim, &w, a, b, NULL));
        dump(sim, SPH_DUMP_FULL);
        close_to(real(field("sets", "normal", "1", F64, 2, 0, 0), F64), -0.8, 1e-12);
        close_to(real(field("sets", "normal", "1", F64, 2, 0, 1), F64), 0.6, 1e-12);
        for (uint32_t k = 0; k < 2; k++)
            close_to(real(field("sets", "origin", "m", F64, 2, 0, k), F64), 0.5 * (a[k] + b[k]) - c.lo[k], 1e-12);
        close_to(real(field("sets", "half", "m", F64, 2, 0, 0), F64), 0.75, 1e-12);
        close_to(real(field("sets", "thick", "m", F64, 1, 0, 0), F64), 3 * DX, 1e-12);
        /* 6 spacings: so many in a layer, or one more on a row, end to end */
        const uint32_t n = sph_count(sim);
        assert_int_equal(n, rows ? 7 : 18);
        for (uint32_t i = 0; i < n; i++) {
            const sph_particle p = by_id(sim, i);
            const double x = p.x[0] - a[0], y = p.x[1] - a[1];
            close_to(0.6 * x + 0.8 * y, rows ? i * DX : (i % 6 + 0.5) * DX, 1e-6);
            close_to(-0.8 * x + 0.6 * y, rows ? 0 : -(i / 6 + 0.5) * DX, 1e-6);
        }
    }
}
#endif
#if SPH_DIM == 3
static void a_plane_looks_along_e1_x_e2(void **state)
{
    /* 1.5 along (3, 4, 0)/5, 1 along z: the normal is (4, -3, 0)/5 */
    const double o[3] = {-0.3, 0.2, 0.1}, e1[3] = {0.9, 1.2, 0}, e2[3] = {0, 0, 1}, n[3] = {0.8, -0.6, 0};
    const sph_config c = odd_config();
    (void)state;
    for (int rows = 0; rows < 2; rows++) {
        sph_wall w = sph_wall_default();
        sph_sim *sim = empty_tank(300);
        w.kind = rows ? SPH_WALL_KERNEL_FORCE : SPH_WALL_GHOST;
        w.layers = 3;
        must(sim, sph_add_wall_plane(sim, &w, o, e1, e2, NULL));
        dump(sim, SPH_DUMP_FULL);
        for (uint32_t k = 0; k < 3; k++) {
            close_to(real(field("sets", "normal", "1", F64, 3, 0, k), F64), n[k], 1e-12);
            close_to(real(field("sets", "tangent", "1", F64, 3, 0, k), F64), e1[k] / 1.5, 1e-12);
            close_to(real(field("sets", "origin", "m", F64, 3, 0, k), F64), o[k] + 0.5 * (e1[k] + e2[k]) - c.lo[k],
                     1e-12);
        }
        close_to(real(field("sets", "half", "m", F64, 2, 0, 0), F64), 0.75, 1e-12);
        close_to(real(field("sets", "half", "m", F64, 2, 0, 1), F64), 0.5, 1e-12);
        close_to(real(field("sets", "thick", "m", F64, 1, 0, 0), F64), 3 * DX, 1e-12);
        const uint32_t all = sph_count(sim), across = rows ? 7 : 6, plane = rows ? 35 : 24;
        assert_int_equal(all, rows ? 35 : 72);
        for (uint32_t i = 0; i < all; i++) {
            const sph_particle p = by_id(sim, i);
            const double x[3] = {p.x[0] - o[0], p.x[1] - o[1], p.x[2] - o[2]}, off = rows ? 0 : 0.5;
            close_to(0.6 * x[0] + 0.8 * x[1], (i % across + off) * DX, 1e-6);
            close_to(x[2], (i % plane / across + off) * DX, 1e-6);
            close_to(0.8 * x[0] - 0.6 * x[1], rows ? 0 : -(i / plane + 0.5) * DX, 1e-6);
        }
    }
}
#endif

/* ---- restoring ---- */

static size_t played;
static bool play(void *ctx, void *p, size_t n)
{
    (void)ctx;
    if (played + n > length)
        return false;
    memcpy(p, bytes + played, n);
    played += n;
    return true;
}
/* particles that leave at once, and some that stay */
static sph_sim *leaky(void)
{
    sph_config c = open_config(1, DX);
    double x[SPH_DIM], v[SPH_DIM];
    uint32_t set;
    c.on_leave = SPH_REMOVE;
    c.max_particles = 40;
    c.dt = 0x1p-10;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    for (int i = 0; i < 20; i++) {
        for (int k = 0; k < SPH_DIM; k++) {
            x[k] = i % 2 ? 1.9999 : 0.05 * i;
            v[k] = i % 2 ? 30 - i : 0;
        }
        must(sim, sph_add_particle(sim, set, x, v, 0, NULL));
    }
    return sim;
}
static void a_dump_of_fewer_particles_is_taken(void **state)
{
    (void)state;
    sph_sim *a = leaky(), *b = leaky();
    for (int k = 0; k < 3; k++)
        must(a, sph_step(a));
    assert_int_equal(sph_count(a), 10);
    dump(a, SPH_DUMP_FULL);
    must(b, sph_ready(b)); /* all ids are in its buffers */
    played = 0;
    must(b, sph_restore(b, play, NULL));
    assert_int_equal(played, length);
    assert_true(sph_hash(a) == sph_hash(b));
    for (int k = 0; k < 3; k++) {
        must(a, sph_step(a));
        must(b, sph_step(b));
        assert_true(sph_hash(a) == sph_hash(b));
    }
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_wall_without_a_strength_has_the_usual_one),
        subject(a_boxs_faces_stand_where_they_should),
        subject(a_dump_of_fewer_particles_is_taken),
#if SPH_DIM == 2
        subject(a_segment_looks_to_its_left),
#elif SPH_DIM == 3
        subject(a_plane_looks_along_e1_x_e2),
#endif
        subject(the_preamble_and_every_header_are_as_written_down),
        subject(the_scene_is_the_configuration),
        subject(sets_and_groups_are_those_of_the_scene),
        subject(the_state_is_what_the_readers_say),
        subject(arrays_hold_what_sph_get_says),
        subject(a_reduced_dump_holds_what_was_asked_for),
        subject(a_solids_materials_and_arrays_are_there),
    };
    return run_subjects("format", list);
}
