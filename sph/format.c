/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* format.c: what is in a dump: the members of its records, and its arrays (dump.h). */
#include "dump.h"
#include "arithmetic.h"

SPH_OBJECT(format)

#if SPH_WITH_DUMP || SPH_WITH_RESTORE

/* ---- records: which members go into them ---- */

#define COUNT_OF(a) (uint32_t)(sizeof(a) / sizeof *(a))
#define AT(s, m) (uint16_t)offsetof(s, m)
_Static_assert(sizeof(sph_sim) < 65536, "offsets of fields have 16 bits");
static const sph_member scene_fields[] = {
    {"setup", "1", M_U64, 1, AT(sph_sim, setup_hash)},
    {"max_particles", "1", M_U32, 1, AT(sph_sim, cfg.max_particles)},
    {"lo", "m", M_DOUBLE, SPH_DIM, AT(sph_sim, cfg.lo)},
    {"hi", "m", M_DOUBLE, SPH_DIM, AT(sph_sim, cfg.hi)},
    {"face", "1", M_U32, 2 * SPH_DIM, AT(sph_sim, cfg.face)},
    {"quantum", "m", M_DOUBLE, 1, AT(sph_sim, grid.quantum)},
    {"spacing", "m", M_DOUBLE, 1, AT(sph_sim, cfg.spacing)},
    {"smoothing", "m", M_DOUBLE, 1, AT(sph_sim, cfg.smoothing_length)},
    {"support", "m", M_DOUBLE, 1, AT(sph_sim, grid.support)},
    {"kernel", "1", M_U32, 1, AT(sph_sim, cfg.kernel)},
    {"scheme", "1", M_U32, 1, AT(sph_sim, cfg.scheme)},
    {"density", "1", M_U32, 1, AT(sph_sim, cfg.density)},
    {"integrator", "1", M_U32, 1, AT(sph_sim, cfg.integrator)},
    {"eos", "1", M_U32, 1, AT(sph_sim, cfg.eos)},
    {"pressure_floor", "1", M_BOOL, 1, AT(sph_sim, cfg.pressure_floor)},
    {"solid", "1", M_U32, 1, AT(sph_sim, cfg.solid)},
    {"rho0", "kg/m^3", M_DOUBLE, 1, AT(sph_sim, cfg.rho0)},
    {"sound_speed", "m/s", M_DOUBLE, 1, AT(sph_sim, cfg.sound_speed)},
};
static const sph_member set_fields[] = {
    {"role", "1", M_U32, 1, AT(sph_set, role)},
    {"kind", "1", M_U32, 1, AT(sph_set, kind)},
    {"group", "1", M_U32, 1, AT(sph_set, group)},
    {"eos", "1", M_U8, 1, AT(sph_set, eos)},
    {"compressible", "1", M_BOOL, 1, AT(sph_set, compressible)},
    {"no_slip", "1", M_BOOL, 1, AT(sph_set, no_slip)},
    {"corner", "1", M_BOOL, 1, AT(sph_set, corner)},
    {"side", "1", M_U8, 1, AT(sph_set, side)},
    {"mass", "kg", M_DOUBLE, 1, AT(sph_set, mass)},
    {"rho0", "kg/m^3", M_DOUBLE, 1, AT(sph_set, rho0)},
    {"sound_speed", "m/s", M_DOUBLE, 1, AT(sph_set, c0)},
    {"pressure_scale", "Pa", M_REAL, 1, AT(sph_set, b_r)},
    {"strength", "1", M_DOUBLE, 1, AT(sph_set, strength)},
    {"origin", "m", M_DOUBLE, SPH_DIM, AT(sph_set, origin)}, /* from lo */
    {"normal", "1", M_DOUBLE, SPH_DIM, AT(sph_set, normal)},
    {"tangent", "1", M_DOUBLE, SPH_DIM, AT(sph_set, tangent)},
    {"half", "m", M_DOUBLE, 2, AT(sph_set, half)},
    {"thick", "m", M_DOUBLE, 1, AT(sph_set, thick)},
};
static const sph_member material_fields[] = {
    {"shear", "Pa", M_DOUBLE, 1, AT(sph_material, shear)},
    {"yield", "Pa", M_DOUBLE, 1, AT(sph_material, yield)},
    {"hardening", "Pa", M_DOUBLE, 1, AT(sph_material, hardening)},
    {"crack_rate", "1/s", M_DOUBLE, 1, AT(sph_material, crack_rate)},
    {"body", "1", M_U32, 1, AT(sph_material, body)},
    {"held", "1", M_U32, 1, AT(sph_material, held)},
    {"flat", "1", M_BOOL, 1, AT(sph_material, flat)},
};
static const sph_member group_fields[] = {
    {"moved", "quantum", M_POS, SPH_DIM, AT(sph_group_state, moved)},
    {"velocity", "m/s", M_DOUBLE, SPH_DIM, AT(sph_group_state, vel)},
    {"lag", "m/s", M_DOUBLE, 2 * SPH_DIM, AT(sph_group_state, lag)},
    {"remove_at", "s", M_TIME, 1, AT(sph_group_state, remove_at)},
    {"removed", "1", M_U32, 1, AT(sph_group_state, removed)},
};
/* the options that may change, under their names; dt has had another since the first version */
#define RUN_NAME(name) (AT(sph_run, name) == AT(sph_run, dt) ? "dt_fixed" : #name)
#define RUN_FIELD(A, name, kind, start, low, high, in, allowed, change, unit, ...)                                    \
    RUN_FIELD_##change(name, kind, unit)
#define RUN_FIELD_FREE(name, kind, unit) {RUN_NAME(name), unit, MEMBER_##kind, COMPS_##kind, AT(sph_run, name)},
#define RUN_FIELD_FIXED(name, kind, unit)
#define RUN_FIELD_ROOM(name, kind, unit)
#define MEMBER_WHOLE M_U32
#define MEMBER_CHOICE M_U32
#define MEMBER_BOOL M_BOOL
#define MEMBER_REAL M_DOUBLE
#define MEMBER_POSITIVE M_DOUBLE
#define MEMBER_VECTOR M_DOUBLE
#define COMPS_WHOLE 1
#define COMPS_CHOICE 1
#define COMPS_BOOL 1
#define COMPS_REAL 1
#define COMPS_POSITIVE 1
#define COMPS_VECTOR SPH_DIM
static const sph_member run_fields[] = {
    SPH_OPTIONS(RUN_FIELD, RUN_FIELD, )
    {"step_work", "1", M_U64, 1, AT(sph_run, work)},
    {"step_pairs", "1", M_U64, 1, AT(sph_run, pairs)},
    {"step_passes", "1", M_U32, 1, AT(sph_run, passes)},
    {"step_limit", "1", M_U32, 1, AT(sph_run, limit)},
};
static const sph_member state_fields[] = {
    {"time", "s", M_DOUBLE, 1, AT(sph_scalars, time)},
    {"dt", "s", M_DOUBLE, 1, AT(sph_scalars, dt_last)},
    {"step", "1", M_U64, 1, AT(sph_scalars, step)},
    {"particles", "1", M_U32, 1, AT(sph_scalars, count)},
    {"left", "1", M_U32, 1, AT(sph_scalars, left)},
    {"crossed", "1", M_U32, 1, AT(sph_scalars, crossed)},
    {"put_back", "1", M_U32, 1, AT(sph_scalars, put_back)},
    {"reflected", "1", M_U32, 1, AT(sph_scalars, reflected)},
    {"next_id", "1", M_U32, 1, AT(sph_scalars, next_id)},
    {"primed", "1", M_BOOL, 1, AT(sph_scalars, primed)},
    {"started", "1", M_BOOL, 1, AT(sph_scalars, started)},
    {"peak_mu", "1/s", M_REAL, 1, AT(sph_scalars, peaks.mu)},
    {"peak_acc", "m/s^2", M_REAL, 1, AT(sph_scalars, peaks.acc)},
    {"peak_speed", "m/s", M_REAL, 1, AT(sph_scalars, peaks.speed)},
    {"work", "J", M_DOUBLE, SPH_POWERS, AT(sph_scalars, work)}, /* POWER_... of internal.h */
    {"power", "W", M_DOUBLE, SPH_POWERS, AT(sph_scalars, power)},
#define BOOK_FIELD(name, unit, when, what) {#name, unit, M_DOUBLE, 1, AT(sph_scalars, name)},
    SPH_BOOKS(BOOK_FIELD)
};
#define BOOK_COUNT(name, unit, when, what) +1
/* a member of sph_scalars that no table names would be lost: adding one must change this number and a table */
_Static_assert(sizeof(sph_scalars) == 8 * (3 SPH_BOOKS(BOOK_COUNT) + 2 * SPH_POWERS) + 4 * 6 + 4 +
                                          3 * sizeof(sph_real) + (SPH_DOUBLE ? 4u : 0u) +
                                          SPH_MAX_GROUPS * sizeof(sph_group_state) ||
                   sizeof(void *) < 8,
               "sph_scalars has changed: name the new member in state_fields");

static const sph_record scene_record = {"scene", scene_fields, COUNT_OF(scene_fields), sizeof(sph_sim), true};
static const sph_record set_record = {"sets", set_fields, COUNT_OF(set_fields), sizeof(sph_set), true};
static const sph_record material_record = {"materials", material_fields, COUNT_OF(material_fields),
                                           sizeof(sph_material), true};
static const sph_record group_record = {"groups", group_fields, COUNT_OF(group_fields), sizeof(sph_group_state), false};
static const sph_record run_record = {"run", run_fields, COUNT_OF(run_fields), sizeof(sph_run), false};
static const sph_record state_record = {"state", state_fields, COUNT_OF(state_fields), sizeof(sph_scalars), false};

/* of a scene with solids the materials too */
static bool move_materials(sph_stream *s, const sph_sim *sim)
{
    return !SPH_WITH_SOLID || !sph_has_solids(&sim->cfg) ||
           sph_move_record(s, &material_record, sim->sets, sim->material, NULL);
}

bool sph_move_setup(sph_stream *s, const sph_sim *sim)
{
    return sph_move_record(s, &scene_record, 1, sim, NULL) &&
           sph_move_record(s, &set_record, sim->sets, sim->set, NULL) && move_materials(s, sim);
}

bool sph_move_scalars(sph_stream *s, const sph_sim *sim, const sph_scalars *from, sph_scalars *to, const sph_run *run,
                      sph_run *run_to)
{
    return sph_move_record(s, &group_record, sim->groups, from ? from->group : NULL, to ? to->group : NULL) &&
           sph_move_record(s, &run_record, 1, run, run_to) && sph_move_record(s, &state_record, 1, from, to);
}

/* ---- arrays ---- */

/* how a dump tells the type of an element */
#define CODE_sph_pos (SPH_DOUBLE ? SPH_I64 : SPH_I32)
#define CODE_sph_real (SPH_DOUBLE ? SPH_F64 : SPH_F32)
#define CODE_uint32_t SPH_U32
#define CODE_uint8_t SPH_U8

/* n elements of `size` bytes between an array and the piece */
static void encode(unsigned char *piece, const void *array, uint32_t first, uint32_t n, uint32_t size)
{
    const unsigned char *a = (const unsigned char *)array + (size_t)first * size;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t w;
        uint64_t u;
        if (size == 8) {
            memcpy(&u, a + (size_t)i * 8, 8);
            sph_put_number(piece + i * 8, u, 8);
        } else if (size == 4) {
            memcpy(&w, a + (size_t)i * 4, 4);
            sph_put_number(piece + i * 4, w, 4);
        } else {
            piece[i] = a[i];
        }
    }
}
static void decode(const unsigned char *piece, void *array, uint32_t first, uint32_t n, uint32_t size)
{
    unsigned char *a = (unsigned char *)array + (size_t)first * size;
    for (uint32_t i = 0; i < n; i++) {
        const uint64_t u = sph_get_number(piece + i * size, size);
        const uint32_t w = (uint32_t)u;
        if (size == 8)
            memcpy(a + (size_t)i * 8, &u, 8);
        else if (size == 4)
            memcpy(a + (size_t)i * 4, &w, 4);
        else
            a[i] = (unsigned char)u;
    }
}

/* pressures of n particles from `first` on */
static void encode_pressure(unsigned char *piece, const sph_sim *sim, uint32_t first, uint32_t n)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = 0; i < n; i++) {
        const uint8_t set = b->set[0][first + i];
        const sph_real p =
            set == SPH_DEAD ? 0 : (sph_real)sph_pressure(sim, &sim->set[set], (double)b->rho[0][first + i]);
        encode(piece + i * sizeof p, &p, 0, 1, sizeof p);
    }
}

typedef struct column {
    const char *name, *unit;
    uint32_t code, comps;
    const sph_buffer *b; /* null: the pressure, which is not stored */
    uint32_t at;         /* its first array */
} column;

static uint32_t code_bytes(uint32_t code)
{
    return code == SPH_U8 ? 1 : code == SPH_U32 || code == SPH_I32 || code == SPH_F32 ? 4 : 8;
}

static bool move_array(sph_stream *s, const sph_sim *sim, const column *c, uint32_t n)
{
    const uint32_t size = code_bytes(c->code), most = SPH_PIECE / size;
    const uint64_t bytes = (uint64_t)n * size * c->comps;
    if (!sph_move_header(s, c->name, c->unit, c->code, c->comps, n, bytes))
        return false;
    if (!s->sink && !s->source) {
        s->bytes += bytes;
        return sph_move_crc(s, c->name);
    }
    for (uint32_t k = 0; k < c->comps; k++)
        for (uint32_t i = 0; i < n; i += most) {
            const uint32_t m = n - i < most ? n - i : most;
            if (s->sink && c->b)
                encode(s->piece, sph_array(c->b, c->at + k), i, m, size);
            else if (s->sink)
                encode_pressure(s->piece, sim, i, m);
            if (!sph_move_payload(s, m * size))
                return false;
            if (s->source && c->b)
                decode(s->piece, sph_array(c->b, c->at + k), i, m, size);
        }
    return sph_move_crc(s, c->name);
}

/* what a dump for pictures holds: a field always, or where it is asked for; the others are in full dumps only */
#define ALWAYS 0xffffffffu
static const uint32_t picture[SPH_FIELD_COUNT] = {
    [SPH_FIELD_NUMBER_pos] = ALWAYS,
    [SPH_FIELD_NUMBER_id] = ALWAYS,
    [SPH_FIELD_NUMBER_set] = ALWAYS,
    [SPH_FIELD_NUMBER_vel] = SPH_DUMP_VELOCITY,
    [SPH_FIELD_NUMBER_rho] = SPH_DUMP_DENSITY,
    [SPH_FIELD_NUMBER_acc] = SPH_DUMP_ACCELERATION,
    [SPH_FIELD_NUMBER_stress] = SPH_DUMP_STRESS,
    [SPH_FIELD_NUMBER_plastic] = SPH_DUMP_DAMAGE,
    [SPH_FIELD_NUMBER_damage] = SPH_DUMP_DAMAGE,
};

bool sph_move_arrays(sph_stream *s, const sph_sim *sim, const sph_buffer *b, uint32_t fields, uint32_t n)
{
    static const struct {
        const char *unit;
        uint32_t code;
    } columns[SPH_FIELD_COUNT] = {
#define COLUMN(name, type, comps, unit, when, way) {unit, CODE_##type},
        SPH_STATE_FIELDS(COLUMN)
#undef COLUMN
    };
    for (uint32_t f = 0; f < SPH_FIELD_COUNT; f++) {
        const sph_field *e = &sph_fields[f];
        const bool asked = (fields & SPH_DUMP_FULL) || picture[f] == ALWAYS || (picture[f] & fields);
        const column c = {sph_field_name(e), columns[f].unit, columns[f].code, e->comps, b, e->at};
        if (asked && sph_array(b, e->at) && !move_array(s, sim, &c, n))
            return false;
    }
    const column pressure = {"p", "Pa", CODE_sph_real, 1, NULL, 0};
    return (fields & SPH_DUMP_FULL) || !(fields & SPH_DUMP_PRESSURE) || move_array(s, sim, &pressure, n);
}
#endif
