/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_dumps.c: a dump that is cut off anywhere, or in which any one byte is changed, is refused; the simulation that
   was to take it is as it was in every array and scalar, and steps to the same hash as if nothing had been offered. */
#include "testing.h"

#include "fuzz/crc.h"
#include "state.h"

#define DX 0.25

typedef struct tape {
    unsigned char *byte;
    size_t n, at;
} tape;
enum { ROOM = 1 << 16 };
static unsigned char true_bytes[ROOM], changed_bytes[ROOM];

static bool record(void *ctx, const void *p, size_t n)
{
    tape *t = ctx;
    assert_true(t->n + n <= ROOM);
    memcpy(t->byte + t->n, p, n);
    t->n += n;
    return true;
}
static bool play(void *ctx, void *p, size_t n)
{
    tape *t = ctx;
    if (t->at + n > t->n)
        return false;
    memcpy(p, t->byte + t->at, n);
    t->at += n;
    return true;
}

static struct {
    bool rock; /* a solid that yields and breaks, a part of it held, instead of water and a wall */
    sph_sim *sim;
    unsigned char *arena, *image;
    size_t bytes;
    uint64_t next;  /* hash after one more step */
    snapshot s;
    tape dump;      /* of three steps earlier: taking it would show */
    sph_report refusal; /* of what was offered last */
} bed;

static void sway(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.1 * t;
    v[0] = 0.1;
}

static void add_rock(double *lo, double *hi)
{
    sph_solid m = {.shear = 1e5, .yield = 20};
    uint32_t set, other;
    const double away[SPH_DIM] = {1};
    must(bed.sim, sph_add_solid(bed.sim, &m, &set, NULL));
    must(bed.sim, sph_add_box(bed.sim, set, lo, hi, away));
    m.held = 1;
    m.motion = sway;
    must(bed.sim, sph_add_solid(bed.sim, &m, &other, NULL));
    hi[0] = 0;
    lo[0] = -DX;
    must(bed.sim, sph_add_box(bed.sim, other, lo, hi, NULL));
#if SPH_DIM > 1
    const sph_flaws flaws = {1e25, 5, 3};
    must(bed.sim, sph_add_flaws(bed.sim, set, &flaws));
#endif
}

static void make_bed(void)
{
    sph_config c = open_config(SPH_DIM == 3 ? 0.5 : 1, DX);
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    uint32_t set;
    c.max_particles = 200;
    c.books = true;
    c.xsph = 0.5;
    c.gravity[0] = -9.81;
    if (bed.rock) {
        c.xsph = 0;
        c.solid = SPH_TOTAL;
        c.yield = SPH_VON_MISES;
        c.damage = SPH_DIM > 1 ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
        c.max_flaws = 400;
        c.max_stretch = 2;
    }
    bed.sim = new_sim(&c);
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = SPH_DIM == 3 ? 0.5 : 0.75;
    w.kind = SPH_WALL_GHOST;
    w.layers = 1;
    w.compressible = true;
    w.motion = sway;
    if (bed.rock)
        add_rock(lo, hi);
    else {
        must(bed.sim, sph_add_fluid(bed.sim, NULL, &set));
        must(bed.sim, sph_add_box(bed.sim, set, lo, hi, NULL));
        must(bed.sim, sph_add_wall_box(bed.sim, &w, lo, hi, SPH_LOW(0), true, NULL));
    }
    for (int k = 0; k < 3; k++)
        must(bed.sim, sph_step(bed.sim));
    bed.dump = (tape){true_bytes, 0, 0};
    must(bed.sim, sph_dump(bed.sim, SPH_DUMP_FULL, record, &bed.dump));
    for (int k = 0; k < 3; k++)
        must(bed.sim, sph_step(bed.sim));
    bed.arena = sims[sim_count - 1].arena;
    bed.bytes = sims[sim_count - 1].bytes;
    bed.image = malloc(bed.bytes);
    assert_non_null(bed.image);
    memcpy(bed.image, bed.arena, bed.bytes);
    must(bed.sim, sph_step(bed.sim));
    bed.next = sph_hash(bed.sim);
    memcpy(bed.arena, bed.image, bed.bytes);
    keep_state(bed.sim, &bed.s);
}
static void unmake_bed(void)
{
    free(bed.image);
    free(bed.s.arrays);
    assert_int_equal(free_sims(NULL), 0);
}

static bool is_dump_status(sph_status st)
{
    return st == SPH_DUMP_TRUNCATED || st == SPH_DUMP_CORRUPT || st == SPH_DUMP_FOREIGN || st == SPH_DUMP_NEWER ||
           st == SPH_DUMP_MISMATCH;
}

/* offers n bytes; they must be refused and leave no trace. step: also look at the step that follows. */
static sph_status offer(unsigned char *bytes, size_t n, const char *how, size_t at, bool step)
{
    tape t = {bytes, n, 0};
    const sph_status st = sph_restore(bed.sim, play, &t);
    bed.refusal = *sph_last(bed.sim);
    if (!is_dump_status(st) || bed.refusal.status != st)
        fail_msg("%s at byte %zu: %s", how, at, sph_status_text(st));
    if (!state_same(bed.sim, &bed.s))
        fail_msg("%s at byte %zu: refused, but the simulation has changed", how, at);
    if (step) {
        must(bed.sim, sph_step(bed.sim));
        if (sph_hash(bed.sim) != bed.next)
            fail_msg("%s at byte %zu: refused, but the next step is another one", how, at);
        memcpy(bed.arena, bed.image, bed.bytes);
    }
    return st;
}

static void the_true_dump_is_taken(void **state)
{
    (void)state;
    make_bed();
    must(bed.sim, sph_restore(bed.sim, play, &bed.dump));
    assert_int_equal(bed.dump.at, bed.dump.n);
    assert_true(sph_hash(bed.sim) != bed.s.hash);
    for (int k = 0; k < 4; k++)
        must(bed.sim, sph_step(bed.sim));
    assert_true(sph_hash(bed.sim) == bed.next);
    unmake_bed();
}

static void every_truncation_is_refused(void **state)
{
    (void)state;
    make_bed();
    for (size_t n = 0; n < bed.dump.n; n++)
        assert_int_equal(offer(true_bytes, n, "cut off", n, n % 16 == 0), SPH_DUMP_TRUNCATED);
    print_message("dumps: %zu truncation points refused\n", bed.dump.n);
    unmake_bed();
}

/* all eight flips of a single bit, and the byte set to 0x00 and to 0xff */
static void every_changed_byte_is_refused(void **state)
{
    size_t tried = 0;
    (void)state;
    make_bed();
    memcpy(changed_bytes, true_bytes, bed.dump.n);
    for (size_t at = 0; at < bed.dump.n; at++) {
        const unsigned char good = true_bytes[at];
        for (int k = 0; k < 10; k++) {
            changed_bytes[at] = (unsigned char)(k < 8 ? good ^ 1u << k : k == 8 ? 0 : 0xff);
            if (changed_bytes[at] == good)
                continue;
            offer(changed_bytes, bed.dump.n, "a changed bit", at, k == (int)(at % 10));
            tried++;
        }
        changed_bytes[at] = good;
    }
    print_message("dumps: %zu changes of a byte refused, %zu bytes\n", tried, bed.dump.n);
    assert_true(tried >= 9 * bed.dump.n);
    unmake_bed();
}

/* ---- values that no run can have, under true checksums ---- */

/* puts the checksums right behind a change of the payload of the section at `at` */
static void mend(size_t n)
{
    uint32_t chain = crc_of(0, changed_bytes + 28, 4);
    for (size_t at = 32; at < n;) {
        const size_t payload = crc_get(changed_bytes + at + 48), crc = at + 64 + payload;
        if (crc + 4 == n)
            crc_put(changed_bytes + at + 64, chain);
        crc_put(changed_bytes + crc, crc_of(0, changed_bytes + at + 64, payload));
        chain = crc_of(crc_of(chain, changed_bytes + at + 60, 4), changed_bytes + crc, 4);
        at = crc + 4;
    }
}
static size_t section(const char *name)
{
    for (size_t at = 32; at < bed.dump.n; at += 64 + crc_get(true_bytes + at + 48) + 4)
        if (strcmp((const char *)true_bytes + at, name) == 0)
            return at;
    fail_msg("no section %s", name);
    return 0;
}

static void put_real(unsigned char *p, double x)
{
    const sph_real r = (sph_real)x;
    uint64_t u = 0;
    uint32_t w;
    if (sizeof r == 8)
        memcpy(&u, &r, sizeof u);
    else {
        memcpy(&w, &r, sizeof w);
        u = w;
    }
    for (uint32_t i = 0; i < sizeof r; i++)
        p[i] = (unsigned char)(u >> 8 * i);
}

/* a refusal names the field, not its number, and whose it is: that of the first particle of the array */
static void is_named(const char *field)
{
    if (!bed.refusal.what || strcmp(bed.refusal.what, field) != 0)
        fail_msg("a wrong %s is refused as '%s'", field, bed.refusal.what ? bed.refusal.what : "nothing");
    assert_int_equal(bed.refusal.particle, crc_get(changed_bytes + section("id") + 64));
}

static void impossible_values_are_refused_though_checksums_are_right(void **state)
{
    static const char *const water[] = {"vel", "rho", "acc", "drho", "xsph"};
    static const char *const solid[] = {"vel", "stress", "dstress", "plastic", "damage"};
    const char *const *const reals = bed.rock ? solid : water;
    const size_t arrays = bed.rock && SPH_DIM == 1 ? 4 : 5;
    (void)state;
    make_bed();
    memcpy(changed_bytes, true_bytes, bed.dump.n);
    mend(bed.dump.n); /* nothing is changed yet: mending must give the same bytes */
    assert_memory_equal(changed_bytes, true_bytes, bed.dump.n);
    for (size_t k = 0; k < arrays; k++)
        for (int bad = 0; bad < (bed.rock && k >= 3 ? 5 : 3); bad++) {
            const size_t at = section(reals[k]) + 64;
            memcpy(changed_bytes, true_bytes, bed.dump.n);
            put_real(changed_bytes + at, bad == 0 ? NAN : bad == 1 ? INFINITY : bad == 2 ? -INFINITY : k == 4 &&
                     bad == 3 ? 1.01 : -0.01);
            mend(bed.dump.n);
            assert_int_equal(offer(changed_bytes, bed.dump.n, reals[k], at, true), SPH_DUMP_CORRUPT);
            is_named(reals[k]);
        }
    static const struct {
        const char *name;
        uint32_t byte, value;
    } odd[] = {{"set", 0, 63}, {"set", 0, 200}, {"id", 3, 1}, {"id", 0, 255}, {"pos", sizeof(sph_pos) - 1, 0x7f},
               {"pos", sizeof(sph_pos) - 1, 0x80}};
    for (size_t k = 0; k < sizeof odd / sizeof *odd; k++) {
        const size_t at = section(odd[k].name) + 64 + odd[k].byte;
        memcpy(changed_bytes, true_bytes, bed.dump.n);
        changed_bytes[at] = (unsigned char)odd[k].value;
        mend(bed.dump.n);
        assert_int_equal(offer(changed_bytes, bed.dump.n, odd[k].name, at, true), SPH_DUMP_CORRUPT);
        is_named(odd[k].name);
    }
    for (int high = 0; high < 2 && bed.rock; high++) { /* further from its beginning than half the domain */
        const size_t at = section("shift") + 64 + sizeof(sph_pos) - 1;
        memcpy(changed_bytes, true_bytes, bed.dump.n);
        changed_bytes[at] = high ? 0x7f : 0x80;
        mend(bed.dump.n);
        assert_int_equal(offer(changed_bytes, bed.dump.n, "shift", at, true), SPH_DUMP_CORRUPT);
        is_named("shift");
    }
    memcpy(changed_bytes, true_bytes, bed.dump.n); /* two particles of one id */
    memcpy(changed_bytes + section("id") + 64, changed_bytes + section("id") + 68, 4);
    mend(bed.dump.n);
    assert_int_equal(offer(changed_bytes, bed.dump.n, "id", 0, true), SPH_DUMP_CORRUPT);
    unmake_bed();
}

/* ---- the same of a solid ---- */

static void the_true_dump_of_a_solid_is_taken(void **state)
{
    bed.rock = true;
    the_true_dump_is_taken(state);
}

/* its stresses, yielding and damage are not all nothing, or the tests would show little; and a reduced dump has them */
static void the_solid_has_all_that_a_dump_holds(void **state)
{
    double stress = 0, plastic = 0, damage = 0;
    (void)state;
    make_bed();
    for (uint32_t i = 0; i < sph_count(bed.sim); i++) {
        sph_particle p;
        must(bed.sim, sph_get(bed.sim, i, &p));
        stress = fmax(stress, fabs(p.stress[0]));
        plastic = fmax(plastic, p.plastic);
        damage = fmax(damage, p.damage);
    }
    if (!(stress > 0 && plastic > 0 && (damage > 0 || SPH_DIM == 1)))
        fail_msg("stress %g, plastic strain %g, damage %g", stress, plastic, damage);
    tape t = {changed_bytes, 0, 0};
    const char *const want[] = {"stress", "damage"};
    must(bed.sim, sph_dump(bed.sim, SPH_DUMP_PICTURE, record, &t));
    for (int k = 0; k < (SPH_DIM == 1 ? 1 : 2); k++) {
        bool found = false;
        for (size_t at = 32; at < t.n; at += 64 + crc_get(changed_bytes + at + 48) + 4)
            found |= strcmp((const char *)changed_bytes + at, want[k]) == 0;
        if (!found)
            fail_msg("a picture without %s", want[k]);
    }
    unmake_bed();
}

/* flaws are of the set-up: a simulation with others does not take the dump */
static void a_dump_of_other_flaws_or_materials_is_refused(void **state)
{
    (void)state;
    make_bed();
    for (int other = 0; other < (SPH_DIM == 1 ? 1 : 2); other++) {
        sph_config c = bed.sim->cfg;
        sph_solid m = {.shear = other ? 1e5 : 1.1e5, .yield = 20};
        double lo[SPH_DIM] = {0}, hi[SPH_DIM];
        uint32_t set, held;
        for (int k = 0; k < SPH_DIM; k++)
            hi[k] = SPH_DIM == 3 ? 0.5 : 0.75;
        sph_sim *sim = new_sim(&c);
        must(sim, sph_add_solid(sim, &m, &set, NULL));
        must(sim, sph_add_box(sim, set, lo, hi, NULL));
        m.shear = 1e5;
        m.held = 1;
        m.motion = sway;
        must(sim, sph_add_solid(sim, &m, &held, NULL));
        hi[0] = 0;
        lo[0] = -DX;
        must(sim, sph_add_box(sim, held, lo, hi, NULL));
#if SPH_DIM > 1
        const sph_flaws flaws = {1e25, 5, other ? 4 : 3};
        must(sim, sph_add_flaws(sim, set, &flaws));
#endif
        const uint64_t before = sph_hash(sim);
        tape t = bed.dump;
        t.at = 0;
        assert_int_equal(sph_restore(sim, play, &t), SPH_DUMP_MISMATCH);
        assert_true(sph_hash(sim) == before);
    }
    unmake_bed();
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(the_true_dump_is_taken),
        subject(every_truncation_is_refused),
        subject(every_changed_byte_is_refused),
        subject(impossible_values_are_refused_though_checksums_are_right),
        subject(the_true_dump_of_a_solid_is_taken), /* and from here on of a solid */
        subject(the_solid_has_all_that_a_dump_holds),
        subject(a_dump_of_other_flaws_or_materials_is_refused),
        subject(every_truncation_is_refused),
        subject(every_changed_byte_is_refused),
        subject(impossible_values_are_refused_though_checksums_are_right),
    };
    return run_subjects("dumps", list);
}
