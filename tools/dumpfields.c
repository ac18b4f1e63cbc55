/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* dumpfields.c: fields of the particles of a dump by name (see dumpfile.h). */
#include "dumpfile.h"

#include <math.h>
#include <string.h>

#include "host.h"

/* constants of the sets, looked up once for a whole field */
typedef struct set_constants {
    uint32_t role, group, eos;
    double rho0, scale;
} set_constants;

static uint32_t index_of(const dump_file *d, const char *field, uint32_t set)
{
    const double v = dump_number(d, "sets", field, set, 0);
    return v >= 0 && v < 1e9 ? (uint32_t)v : 0;
}

static void get_sets(const dump_file *d, set_constants *c)
{
    dump_member m;
    /* before there were solids: that of the scene */
    const bool own = dump_find_member(dump_find(d, "sets"), "eos", &m);
    for (uint32_t s = 0; s < d->sets && s < 256; s++)
        c[s] = (set_constants){index_of(d, "role", s), index_of(d, "group", s), own ? index_of(d, "eos", s) : d->eos,
                               dump_number(d, "sets", "rho0", s, 0), dump_number(d, "sets", "pressure_scale", s, 0)};
}

/* ---- names ---- */

enum {
    F_NONE, F_X, F_VELOCITY, F_SPEED, F_DENSITY, F_PRESSURE, F_ACCELERATION, F_SET, F_ID,
    F_STRESS, F_MEAN, F_SUM, F_MISES, F_PLASTIC, F_DAMAGE, F_ENERGY, F_KINDS
};
static const struct {
    const char *unit, *array; /* array: what must be there besides those of dump_field */
    bool is_signed;
} kinds[F_KINDS] = {
    [F_NONE] = {"", NULL, false},          [F_X] = {"m", "pos", false},
    [F_VELOCITY] = {"m/s", "vel", true},   [F_SPEED] = {"m/s", "vel", false},
    [F_DENSITY] = {"kg/m^3", "rho", false}, [F_PRESSURE] = {"Pa", "rho", false},
    [F_ACCELERATION] = {"m/s^2", "acc", true}, [F_SET] = {"", "set", false},
    [F_ID] = {"", "id", false},            [F_STRESS] = {"Pa", "stress", true},
    [F_MEAN] = {"Pa", "stress", true},     [F_SUM] = {"Pa", "stress", true},
    [F_MISES] = {"Pa", "stress", false},   [F_PLASTIC] = {"", "plastic", false},
    [F_DAMAGE] = {"", "damage", false},    [F_ENERGY] = {"J/kg", "energy", false}};

/* components of a symmetric tensor: those stored, in their order, then zz */
enum { XX, YY, XY, XZ, YZ, ZZ };

/* axis: of a vector 0..2, of a stress XX.. */
static int parse_field(const dump_file *d, const char *field, uint32_t *axis)
{
    static const struct {
        const char *name;
        int kind;
    } whole[] = {{"speed", F_SPEED}, {"density", F_DENSITY}, {"pressure", F_PRESSURE}, {"set", F_SET}, {"id", F_ID},
                 {"mean_stress", F_MEAN}, {"stress_sum", F_SUM}, {"von_mises", F_MISES}, {"plastic", F_PLASTIC},
                 {"damage", F_DAMAGE}, {"energy", F_ENERGY}},
      parts[] = {{"velocity_", F_VELOCITY}, {"acceleration_", F_ACCELERATION}, {"", F_X}};
    static const char *const pairs[] = {"xx", "yy", "xy", "xz", "yz", "zz"};
    static const bool there[3][6] = {{true}, {true, true, true, false, false, true},
                                     {true, true, true, true, true, true}};
    for (size_t k = 0; k < sizeof whole / sizeof *whole; k++)
        if (!strcmp(field, whole[k].name))
            return whole[k].kind;
    for (uint32_t k = 0; k < 6; k++)
        if (!strncmp(field, "stress_", 7) && !strcmp(field + 7, pairs[k])) {
            *axis = k;
            return there[d->dim - 1][k] ? F_STRESS : F_NONE;
        }
    for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
        size_t n = strlen(parts[k].name);
        if (!strncmp(field, parts[k].name, n) && field[n] >= 'x' && field[n] <= 'z' && !field[n + 1]) {
            *axis = (uint32_t)(field[n] - 'x');
            return *axis < d->dim ? parts[k].kind : F_NONE;
        }
    }
    return F_NONE;
}

/* the arrays that a field is made of; those that need a pressure take the density, else the pressure itself */
typedef struct arrays {
    const dump_section *main, *pressure, *damage, *energy;
} arrays;

/* null, or the name of an array that is missing */
static const char *find_arrays(const dump_file *d, int kind, arrays *a)
{
    const bool stress = kind == F_STRESS || kind == F_MEAN || kind == F_SUM;
    a->pressure = dump_find(d, "rho") ? dump_find(d, "rho") : dump_find(d, "p");
    a->damage = dump_find(d, "damage");
    a->energy = dump_find(d, "energy");
    a->main = kind == F_PRESSURE ? a->pressure : dump_find(d, kinds[kind].array);
    return !a->main ? kinds[kind].array : stress && !a->pressure ? "rho" : NULL;
}

bool dump_has_field(const dump_file *d, const char *field)
{
    uint32_t axis = 0;
    arrays a;
    const int kind = parse_field(d, field, &axis);
    return kind != F_NONE && !find_arrays(d, kind, &a);
}

bool dump_field_signed(const dump_file *d, const char *field)
{
    uint32_t axis;
    return kinds[parse_field(d, field, &axis)].is_signed;
}

double dump_field_mirrored(const dump_file *d, const char *field, uint32_t axis, bool no_slip)
{
    static const uint8_t pairs[][2] = {{0, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}, {2, 2}}; /* of XX.. */
    uint32_t own = 0;
    switch (parse_field(d, field, &own)) {
    case F_VELOCITY: return no_slip || own == axis ? -1 : 1;
    case F_ACCELERATION: return own == axis ? -1 : 1;
    case F_STRESS: return (pairs[own][0] == axis) != (pairs[own][1] == axis) ? -1 : 1;
    default: return 1;
    }
}

/* ---- values ---- */

/* by the set's equation of state, numbered as in sph.h: 2 linear, 3 isothermal, 4 ideal gas, else Tait's; solids bear
   tension */
static double pressure(const dump_file *d, const arrays *a, const set_constants *c, uint32_t i)
{
    const double s = dump_value(a->pressure, 0, i);
    if (strcmp(a->pressure->name, "rho") != 0)
        return s;
    if (c->eos == 4)
        return a->energy ? c->scale * (1 + s) * dump_value(a->energy, 0, i) : 0;
    double p = c->eos == 2   ? c->scale * s
               : c->eos == 3 ? c->scale * (1 + s)
                             : c->scale * (s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s)))))));
    return d->pressure_floor && p < 0 && c->role != DUMP_SOLID ? 0 : p;
}

/* a velocity component; a wall has that of its group */
static double velocity(const dump_file *d, const dump_section *a, const set_constants *c, uint32_t i, uint32_t axis)
{
    if (c && dump_is_wall(c->role))
        return dump_number(d, "groups", "velocity", c->group, axis);
    return dump_value(a, axis, i);
}

static double damage(const dump_file *d, const arrays *a, const set_constants *c, uint32_t i)
{
    return a->damage && c->role == DUMP_SOLID ? pow(dump_value(a->damage, 0, i), d->dim) : 0;
}

/* the deviator that a particle bears; along a bar the other two directions share what makes the trace 0 */
static void deviator(const dump_file *d, const arrays *a, const set_constants *c, uint32_t i, double s[6])
{
    const double left = 1 - damage(d, a, c, i);
    memset(s, 0, 6 * sizeof *s);
    if (c->role != DUMP_SOLID)
        return;
    for (uint32_t k = 0; k < a->main->comps; k++)
        s[k] = left * dump_value(a->main, k, i);
    if (d->dim == 1)
        s[YY] = -0.5 * s[XX];
    s[ZZ] = -s[XX] - s[YY];
}

static double stress_value(const dump_file *d, int kind, const arrays *a, const set_constants *c, uint32_t i,
                           uint32_t pair)
{
    double s[6];
    deviator(d, a, c, i, s);
    if (kind == F_MISES)
        return sqrt(1.5 * (s[XX] * s[XX] + s[YY] * s[YY] + s[ZZ] * s[ZZ]) +
                    3 * (s[XY] * s[XY] + s[XZ] * s[XZ] + s[YZ] * s[YZ]));
    double p = pressure(d, a, c, i);
    p *= p < 0 ? 1 - damage(d, a, c, i) : 1;
    switch (kind) {
    case F_MEAN: return -p;
    case F_SUM: return s[XX] + (d->dim > 1 ? s[YY] : 0) + (d->dim > 2 ? s[ZZ] : 0) - d->dim * p;
    default: return s[pair] - (pair == XX || pair == YY || pair == ZZ ? p : 0);
    }
}

static double one_value(const dump_file *d, int kind, const arrays *a, const set_constants *c, uint32_t i,
                        uint32_t axis)
{
    double v2 = 0;
    switch (kind) {
    case F_X: return dump_x(d, i, axis);
    case F_VELOCITY: return velocity(d, a->main, c, i, axis);
    case F_SPEED:
        for (uint32_t k = 0; k < d->dim; k++)
            v2 += velocity(d, a->main, c, i, k) * velocity(d, a->main, c, i, k);
        return sqrt(v2);
    case F_DENSITY: return c ? c->rho0 * (1 + dump_value(a->main, 0, i)) : 0;
    case F_PRESSURE: return c ? pressure(d, a, c, i) : 0;
    case F_DAMAGE: return c ? damage(d, a, c, i) : 0;
    case F_ENERGY: return dump_value(a->main, 0, i);
    case F_PLASTIC: return c && c->role == DUMP_SOLID ? dump_value(a->main, 0, i) : 0;
    case F_STRESS:
    case F_MEAN:
    case F_SUM:
    case F_MISES: return c ? stress_value(d, kind, a, c, i, axis) : 0;
    default: return dump_value(a->main, axis, i);
    }
}

bool dump_field(const dump_file *d, const char *field, double *out, const char **unit)
{
    uint32_t axis = 0;
    arrays a;
    const int kind = parse_field(d, field, &axis);
    if (kind == F_NONE) {
        host_usage("field %s: not a field of a %u-D dump; fields: " DUMP_FIELDS, field, d->dim);
        return false;
    }
    const char *missing = find_arrays(d, kind, &a);
    if (missing) {
        host_no("%s: carries no array %s, which the field %s needs", d->name, missing, field);
        return false;
    }
    set_constants sets[256] = {{0}};
    get_sets(d, sets);
    *unit = dump_unit(d, kinds[kind].unit);
    for (uint32_t i = 0; i < d->n; i++) {
        uint32_t set = dump_set(d, i);
        out[i] = one_value(d, kind, &a, set == DUMP_DEAD ? NULL : &sets[set], i, axis);
    }
    return true;
}
