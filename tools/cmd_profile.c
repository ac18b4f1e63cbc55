/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_profile.c: sph profile. Fields of a dump along a line or an ellipse, and the largest value near it: stress around
   a hole, the shape of a bent plate. */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"
#include "output.h"
#include "sample.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph profile DUMP... field=NAME[,NAME...] from=X,Y to=X,Y [n=101] [out=NAME.csv] [options]\n"
    "       sph profile DUMP... field=NAME[,NAME...] ellipse=X,Y,RX,RY [angles=0,360] [n=101] [out=NAME.csv] "
    "[options]\n"
    "Samples fields at n places along a line (1-D: from=X to=X; 3-D: from=X,Y,Z) or an ellipse of a 2-D dump (centre "
    "and\n"
    "radii in the dump's lengths, angles in degrees: x = X + RX cos a, y = Y + RY sin a).\n"
    "  field=         " DUMP_FIELDS "\n"
    "                 and displacement_x.. with reference=; up to 8\n"
    "  order=1        moving least squares, exact for linear fields up to a free surface; where no particle is within\n"
    "                 sqrt(dimension) spacings, and from too few particles, Shepard's mean (column order);\n"
    "                 0: that alone\n"
    "  reach=2.5      distance in spacings where a particle's weight ends\n"
    "  of=            solid, fluid or all: the particles that count (default: solids if there are any)\n"
    "  reference=DUMP an earlier dump of the same run: particles are taken where they were then (by id), so that a "
    "line\n"
    "                 of the body is followed; displacement is from there\n"
    "  within=1.5     distance in spacings from the curve, for the largest and smallest value of a particle near it\n"
    "  out=           else to standard output: time, place, fields, how many particles, order used. Places without\n"
    "                 a particle within reach are left out. With out= the extremes are printed\n";

typedef struct options {
    const char *field[SAMPLE_FIELDS], *out, *reference;
    char *fields_text;
    uint32_t fields;
    uint64_t n, order;
    double reach, within, from[3], to[3], ellipse[4], angles[2];
    const char *from_text, *to_text, *ellipse_text, *angles_text;
    int of; /* SOLID, FLUID, ALL, ANY: solids if there are any */
} options;
enum { OF_SOLID, OF_FLUID, OF_ALL, OF_ANY };

/* particles that count: where they are (or were), their fields */
typedef struct cloud {
    uint32_t n, own, room, dim; /* own: of the dump; behind them their images */
    double (*x)[3], *volume, *field[SAMPLE_FIELDS];
    double period[3], lo[3], spacing, time;
    char metre[32], second[32]; /* units */
} cloud;

static void free_cloud(cloud *c)
{
    free(c->x);
    free(c->volume);
    for (int f = 0; f < SAMPLE_FIELDS; f++)
        free(c->field[f]);
}

/* ---- particles ---- */

static bool counts(const dump_file *d, uint32_t i, int of)
{
    const uint32_t role = dump_role(d, i);
    return (role == DUMP_SOLID && of != OF_FLUID) || (role == DUMP_FLUID && of != OF_SOLID);
}

static double displacement(const dump_file *now, uint32_t i, const cloud *c, uint32_t j, uint32_t axis)
{
    double d = dump_x(now, i, axis) - c->x[j][axis];
    if (c->period[axis] > 0)
        d -= c->period[axis] * floor(d / c->period[axis] + 0.5);
    return d;
}

/* axis of the field displacement_x.., -1 if it is another one */
static int displacement_axis(const char *field, uint32_t dim)
{
    const char *axis = field + 13;
    if (strncmp(field, "displacement_", 13) != 0 || *axis < 'x' || *axis > 'z' || axis[1] ||
        (uint32_t)(*axis - 'x') >= dim)
        return -1;
    return *axis - 'x';
}

/* values of field f of the particles at[] */
static bool read_field(const dump_file *d, const options *o, cloud *c, const uint32_t *at, uint32_t f)
{
    const char *unit;
    const int axis = displacement_axis(o->field[f], d->dim);
    c->field[f] = host_alloc(c->room * sizeof(double));
    if (axis >= 0 && !o->reference) {
        host_usage("field=%s: needs reference=, the dump that it is from", o->field[f]);
        return false;
    }
    double *value = host_alloc(d->n * sizeof *value);
    const bool fine = axis >= 0 || dump_field(d, o->field[f], value, &unit);
    for (uint32_t j = 0; fine && j < c->n; j++)
        c->field[f][j] = axis >= 0 ? displacement(d, at[j], c, j, (uint32_t)axis) : value[at[j]];
    free(value);
    return fine;
}

static void gather(const dump_file *d, const dump_file *ref, const options *o, cloud *c, uint32_t *at)
{
    dump_id_at *then = ref ? dump_sort_ids(ref) : NULL;
    int of = o->of == OF_ANY ? OF_FLUID : o->of;
    for (uint32_t i = 0; o->of == OF_ANY && i < d->n; i++)
        of = dump_role(d, i) == DUMP_SOLID ? OF_SOLID : of;
    for (uint32_t i = 0; i < d->n; i++) {
        const uint32_t was = !ref ? i : dump_place(then, ref->n, dump_id(d, i)), set = dump_set(d, i);
        if (!counts(d, i, of) || was == UINT32_MAX || (ref && dump_set(ref, was) == DUMP_DEAD))
            continue;
        for (uint32_t k = 0; k < 3; k++)
            c->x[c->n][k] = k < d->dim ? dump_x(ref ? ref : d, was, k) : 0;
        const double mass = dump_number(d, "sets", "mass", set, 0), rho0 = dump_number(d, "sets", "rho0", set, 0);
        c->volume[c->n] = mass > 0 && rho0 > 0 ? mass / rho0 : pow(d->spacing, d->dim);
        at[c->n++] = i;
    }
    free(then);
}

/* ---- images behind mirror faces: the kernel's particles see them, and so does a sample there ---- */

/* what a mirror across an axis makes of a field */
static double mirrored(const dump_file *d, const char *field, uint32_t axis, bool no_slip)
{
    const int shift = displacement_axis(field, d->dim);
    return shift >= 0 ? (uint32_t)shift == axis ? -1 : 1 : dump_field_mirrored(d, field, axis, no_slip);
}

static void grow(cloud *c, uint32_t fields)
{
    if (c->n < c->room)
        return;
    c->room = c->n + c->n / 2 + 64;
    c->x = host_realloc(c->x, c->room * sizeof *c->x);
    c->volume = host_realloc(c->volume, c->room * sizeof *c->volume);
    for (uint32_t f = 0; f < fields; f++)
        c->field[f] = host_realloc(c->field[f], c->room * sizeof(double));
}

/* images of all that is within reach of one face; done axis by axis, images of images are those in corners */
static void add_images(const dump_file *d, const options *o, cloud *c, uint32_t axis, uint32_t side, bool no_slip)
{
    const double plane = side ? d->hi[axis] : d->lo[axis], reach = o->reach * c->spacing;
    const char letter[] = {(char)('x' + axis), '\0'};
    double sign[SAMPLE_FIELDS], shift[SAMPLE_FIELDS];
    for (uint32_t f = 0; f < o->fields; f++) {
        const bool place = !strcmp(o->field[f], letter); /* the coordinate itself */
        sign[f] = place ? -1 : mirrored(d, o->field[f], axis, no_slip);
        shift[f] = place ? 2 * plane : 0;
    }
    for (uint32_t j = 0, n = c->n; j < n; j++) {
        /* on the plane itself a particle is its own image */
        if (!(fabs(c->x[j][axis] - plane) < reach && fabs(c->x[j][axis] - plane) > 1e-9 * c->spacing))
            continue;
        grow(c, o->fields);
        memcpy(c->x[c->n], c->x[j], sizeof c->x[j]);
        c->x[c->n][axis] = 2 * plane - c->x[j][axis];
        c->volume[c->n] = c->volume[j];
        for (uint32_t f = 0; f < o->fields; f++)
            c->field[f][c->n] = shift[f] + sign[f] * c->field[f][j];
        c->n++;
    }
}

static void add_all_images(const dump_file *d, const options *o, cloud *c)
{
    bool no_slip;
    for (uint32_t axis = 0; axis < d->dim; axis++)
        for (uint32_t side = 0; side < 2; side++)
            if (dump_mirror(d, axis, side, &no_slip))
                add_images(d, o, c, axis, side, no_slip);
}

static bool read_cloud(const dump_file *d, const dump_file *ref, const options *o, cloud *c)
{
    memset(c, 0, sizeof *c);
    c->dim = d->dim;
    c->spacing = d->spacing;
    c->time = d->time;
    c->room = d->n;
    snprintf(c->metre, sizeof c->metre, "%s", dump_unit(d, "m"));
    snprintf(c->second, sizeof c->second, "%s", dump_unit(d, "s"));
    for (uint32_t k = 0; k < d->dim; k++) {
        c->lo[k] = d->lo[k];
        c->period[k] = dump_periodic(d, k) ? d->hi[k] - d->lo[k] : 0;
    }
    uint32_t *at = host_alloc(d->n * sizeof *at);
    c->x = host_alloc(d->n * sizeof *c->x);
    c->volume = host_alloc(d->n * sizeof *c->volume);
    gather(d, ref, o, c, at);
    bool fine = c->n > 0;
    if (!fine)
        host_no("%s: carries no particle that counts%s", d->name, ref ? " and is in the reference" : "");
    for (uint32_t f = 0; fine && f < o->fields; f++)
        fine = read_field(d, o, c, at, f);
    free(at);
    c->own = c->n;
    if (fine)
        add_all_images(d, o, c);
    else
        free_cloud(c);
    return fine;
}

/* ---- the curve ---- */

/* the place at s of the way, 0 to 1, and its angle (ellipse) */
static void place(const options *o, double s, double x[3], double *angle)
{
    x[0] = x[1] = x[2] = 0;
    *angle = o->angles[0] + s * (o->angles[1] - o->angles[0]);
    if (o->ellipse_text) {
        const double a = *angle * 3.14159265358979323846 / 180;
        x[0] = o->ellipse[0] + o->ellipse[2] * cos(a);
        x[1] = o->ellipse[1] + o->ellipse[3] * sin(a);
    } else
        for (int k = 0; k < 3; k++)
            x[k] = o->from[k] + s * (o->to[k] - o->from[k]);
}

/* distance of x from the piece of the curve between two places */
static double distance(const double x[3], const double a[3], const double b[3])
{
    double ab = 0, ax = 0, r2 = 0;
    for (int k = 0; k < 3; k++) {
        ab += (b[k] - a[k]) * (b[k] - a[k]);
        ax += (x[k] - a[k]) * (b[k] - a[k]);
    }
    const double s = ab > 0 ? fmin(1, fmax(0, ax / ab)) : 0;
    for (int k = 0; k < 3; k++)
        r2 += pow(x[k] - a[k] - s * (b[k] - a[k]), 2);
    return sqrt(r2);
}

static bool is_near(const options *o, const cloud *c, uint32_t j)
{
    const int chords = o->ellipse_text ? 720 : 1;
    double a[3], b[3], angle;
    place(o, 0, a, &angle);
    for (int i = 1; i <= chords; i++) {
        place(o, (double)i / chords, b, &angle);
        if (distance(c->x[j], a, b) <= o->within * c->spacing)
            return true;
        memcpy(a, b, sizeof a);
    }
    return false;
}

/* ---- what is written ---- */

static void print_place(const cloud *c, const double x[3])
{
    for (uint32_t k = 0; k < c->dim && k < 3; k++)
        printf("%s%.6g", k ? ", " : " at ", x[k]);
}

/* largest and smallest of the samples and of the particles near the curve */
static void print_extremes(const options *o, const cloud *c, const char *name, const double *value,
                           const double (*x)[3],
                           uint64_t samples)
{
    bool *close = host_alloc(c->own * sizeof *close);
    for (uint32_t j = 0; j < c->own; j++)
        close[j] = is_near(o, c, j);
    printf("%s: t = %.6g %s\n", name, c->time, c->second);
    for (uint32_t f = 0; f < o->fields; f++)
        for (int least = 0; least < 2; least++) {
            int64_t s = -1, p = -1;
            for (uint64_t i = 0; i < samples; i++) {
                const double v = value[i * o->fields + f], best = s < 0 ? 0 : value[(uint64_t)s * o->fields + f];
                s = s < 0 || (least ? v < best : v > best) ? (int64_t)i : s;
            }
            for (uint32_t j = 0; j < c->own; j++)
                if (close[j] && (p < 0 || (least ? c->field[f][j] < c->field[f][p] : c->field[f][j] > c->field[f][p])))
                    p = j;
            printf("  %s %s:", least ? "smallest" : "largest ", o->field[f]);
            if (s >= 0) {
                printf(" %.9g", value[(uint64_t)s * o->fields + f]);
                print_place(c, x[s]);
            } else
                printf(" no place has particles near");
            if (p >= 0) {
                printf("; of a particle near it %.9g", c->field[f][p]);
                print_place(c, c->x[p]);
            }
            putchar('\n');
        }
    free(close);
}

static void put_names(FILE *f, const options *o, const cloud *c)
{
    fprintf(f, "time_%s,s_%s", c->second, c->metre);
    if (o->ellipse_text)
        fputs(",angle_deg", f);
    for (uint32_t k = 0; k < c->dim; k++)
        fprintf(f, ",%c_%s", (int)('x' + k), c->metre);
    for (uint32_t k = 0; k < o->fields; k++)
        fprintf(f, ",%s", o->field[k]);
    fputs(",particles,order\n", f);
}

static bool put_profile(FILE *f, const options *o, const cloud *c, const char *name)
{
    near g;
    if (!near_open(&g, c->dim, c->n, (const double (*)[3])c->x, o->reach * c->spacing, c->lo, c->period))
        return false;
    sampler s = {&g, c->volume, {NULL}, o->fields, (uint32_t)o->order};
    for (uint32_t k = 0; k < o->fields; k++)
        s.field[k] = c->field[k];
    double *kept = host_alloc(o->n * o->fields * sizeof *kept), (*where)[3] = host_alloc(o->n * sizeof *where);
    double x[3], before[3] = {0, 0, 0}, angle, along = 0, value[SAMPLE_FIELDS];
    uint64_t samples = 0;
    for (uint64_t i = 0; i < o->n; i++) {
        uint32_t order;
        place(o, o->n > 1 ? (double)i / (double)(o->n - 1) : 0, x, &angle);
        along += i ? sqrt(pow(x[0] - before[0], 2) + pow(x[1] - before[1], 2) + pow(x[2] - before[2], 2)) : 0;
        memcpy(before, x, sizeof x);
        const uint32_t n = sample_at(&s, x, value, &order);
        if (!n)
            continue;
        fprintf(f, "%.12g,%.12g", c->time, along);
        if (o->ellipse_text)
            fprintf(f, ",%.12g", angle);
        for (uint32_t k = 0; k < c->dim && k < 3; k++)
            fprintf(f, ",%.12g", x[k]);
        for (uint32_t k = 0; k < o->fields; k++)
            fprintf(f, ",%.12g", value[k]);
        fprintf(f, ",%u,%u\n", n, order);
        memcpy(where[samples], x, sizeof x);
        memcpy(&kept[samples++ * o->fields], value, o->fields * sizeof *kept);
    }
    if (o->out)
        print_extremes(o, c, name, kept, (const double (*)[3])where, samples);
    if (o->out && samples < o->n)
        printf("  %llu of %llu places have no particle within reach and were left out\n",
               (unsigned long long)(o->n - samples), (unsigned long long)o->n);
    free(kept);
    free(where);
    near_close(&g);
    return true;
}

/* ---- the command ---- */

/* what depends on the dimension: the curve */
static bool parse_curve(options *o, uint32_t dim)
{
    if (o->ellipse_text) {
        if (dim != 2) {
            host_usage("ellipse: is of a 2-D dump, this one is %u-D", dim);
            return false;
        }
        if (!host_numbers("ellipse", o->ellipse_text, 4, o->ellipse))
            return false;
        if (!(o->ellipse[2] > 0 && o->ellipse[3] > 0)) {
            host_usage("ellipse=%s: both radii must be > 0", o->ellipse_text);
            return false;
        }
        return true;
    }
    return host_numbers("from", o->from_text, dim, o->from) && host_numbers("to", o->to_text, dim, o->to);
}

static int one_dump(FILE *f, const char *name, options *o, bool *headed, uint32_t *dim)
{
    dump_file d, ref;
    cloud c;
    if (!dump_open(&d, name))
        return HOST_NO;
    int result = HOST_NO;
    if (*headed && d.dim != *dim)
        host_usage("%s: is %u-D, the one before is %u-D", name, d.dim, *dim);
    else if (!parse_curve(o, d.dim))
        result = HOST_USAGE;
    else if (!o->reference || dump_open(&ref, o->reference)) {
        if (o->reference && ref.dim != d.dim)
            host_no("%s: is %u-D, %s is %u-D", o->reference, ref.dim, name, d.dim);
        else if (read_cloud(&d, o->reference ? &ref : NULL, o, &c)) {
            if (!*headed)
                put_names(f, o, &c);
            *headed = true;
            *dim = d.dim;
            result = put_profile(f, o, &c, name) ? HOST_FINE : HOST_NO;
            free_cloud(&c);
        }
        if (o->reference)
            dump_close(&ref);
    }
    dump_close(&d);
    return result;
}

static bool parse_fields(const char *text, options *o)
{
    o->fields_text = host_alloc(strlen(text) + 1);
    memcpy(o->fields_text, text, strlen(text) + 1);
    for (char *p = o->fields_text; p;) {
        char *comma = strchr(p, ',');
        if (o->fields == SAMPLE_FIELDS) {
            host_usage("field=%s: at most %d fields", text, SAMPLE_FIELDS);
            return false;
        }
        if (comma)
            *comma = '\0';
        o->field[o->fields++] = p;
        p = comma ? comma + 1 : NULL;
    }
    return true;
}

static bool parse_options(int argc, char **argv, options *o)
{
    static const char *const roles[] = {"solid", "fluid", "all", NULL};
    const char *text;
    *o = (options){.n = 101, .order = 1, .reach = 2.5, .within = 1.5, .angles = {0, 360}, .of = OF_ANY};
    o->out = host_option(argc, argv, "out");
    o->reference = host_option(argc, argv, "reference");
    o->from_text = host_option(argc, argv, "from");
    o->to_text = host_option(argc, argv, "to");
    o->ellipse_text = host_option(argc, argv, "ellipse");
    if (o->ellipse_text ? o->from_text || o->to_text : !o->from_text || !o->to_text) {
        host_usage("give from= and to=, or ellipse=");
        return false;
    }
    if ((text = host_option(argc, argv, "angles")) && !o->ellipse_text) {
        host_usage("angles= is for ellipse=");
        return false;
    }
    if ((text && !host_numbers("angles", text, 2, o->angles)) ||
        ((text = host_option(argc, argv, "n")) && !host_count("n", text, 1, 1000000, &o->n)) ||
        ((text = host_option(argc, argv, "order")) && !host_count("order", text, 0, 1, &o->order)) ||
        ((text = host_option(argc, argv, "reach")) && !host_number("reach", text, 0.5, 100, &o->reach)) ||
        ((text = host_option(argc, argv, "within")) && !host_number("within", text, 0, 1000, &o->within)) ||
        ((text = host_option(argc, argv, "of")) && (o->of = host_choice("of", text, roles)) < 0))
        return false;
    if (!(text = host_option(argc, argv, "field"))) {
        host_usage("give field=NAME");
        return false;
    }
    return parse_fields(text, o);
}

int cmd_profile(int argc, char **argv)
{
    static const char *const known[] = {"field", "from",  "to", "ellipse",   "angles", "n",
                                        "order", "reach", "of", "reference", "within", "out", NULL};
    options o;
    output file;
    host_command("profile");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    const int files = host_known_options(argc, argv, known);
    if (files < 0)
        return HOST_USAGE;
    if (files == 0)
        return host_usage("give at least one dump");
    int result = parse_options(argc, argv, &o) ? HOST_FINE : HOST_USAGE;
    bool headed = false, open = !result;
    uint32_t dim = 0;
    if (open && !o.out)
        output_standard(&file);
    else if (open && !(open = output_open(&file, "out", o.out)))
        result = HOST_NO;
    for (int i = 1; !result && i <= files; i++)
        result = one_dump(file.f, argv[i], &o, &headed, &dim);
    if (open && !output_close(&file, !result))
        result = HOST_NO;
    free(o.fields_text);
    return result;
}
