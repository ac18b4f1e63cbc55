/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_fragments.c: sph fragments. The pieces into which solids have broken: particles that still bear tension, linked
   when near each other; their sizes, and Grady and Kipp's density beside them. Or the drops of a fluid. */
#include "commands.h"
#include "dumpfile.h"
#include "gradykipp.h"
#include "host.h"
#include "near.h"
#include "output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph fragments DUMP... [of=solid|fluid] [damage=0.5] [link=1.5] [across=no|yes] [least=1]\n"
    "                             [by=length|diameter] [bins=10] [k= m= c= rate=] [out=NAME.csv] [histogram=NAME.csv]\n"
    "Pieces of the solid sets: particles of damage D below a threshold, linked when closer than link spacings.\n"
    "  of=fluid       pieces of the fluid: the water, and the drops of its spray\n"
    "  damage=0.5     a particle above it bears less than half of its tension and counts as broken, part of no piece.\n"
    "                 The number of pieces at other thresholds is printed too; where it varies, look at a picture\n"
    "  link=1.5       in spacings; 1.5 links diagonal neighbours of a square lattice, which still pull at each other, "
    "and\n"
    "                 not across a row of broken particles. Material stretched by more than 6 % without damage needs "
    "more\n"
    "  across=no      particles of different bodies (materials.body of the dump) are not linked: in contact they are "
    "two\n"
    "  least=1        pieces of fewer particles count as broken\n"
    "  by=length      what the histogram is of: the longest edge of a piece's box, or the diameter of the disc or "
    "ball\n"
    "                 of its volume (mass over rho0)\n"
    "  k= m= c= rate= adds the density of Grady and Kipp to the histogram (sph gradykipp), in the units of the dump\n"
    "                 (sph info): k per length, area or volume\n"
    "  out=           pieces as CSV, largest first; histogram=: bins as CSV, of all the dumps together\n";

typedef struct options {
    double damage, link;
    bool fluid, across, by_length, has_theory;
    uint64_t least, bins;
    gradykipp theory;
    const char *out, *histogram;
} options;

typedef struct piece {
    uint32_t particles, first_id, set;
    double mass, volume, edge[3], length, diameter, centre[3];
} piece;

/* particles of solid sets, or of fluids, in the order of their ids, whatever the order of the arrays */
typedef struct body {
    uint32_t n;
    uint32_t *at;      /* place in the dump */
    double (*x)[3], *d; /* positions, damage */
    double mass;
} body;

typedef struct pieces {
    piece *list;
    uint32_t n, broken; /* particles in no piece */
    double broken_mass;
} pieces;

/* ---- the particles ---- */

static const dump_file *sorting; /* for qsort */
static int by_id(const void *a, const void *b)
{
    const uint32_t p = dump_id(sorting, *(const uint32_t *)a), q = dump_id(sorting, *(const uint32_t *)b);
    return (p > q) - (p < q);
}

static double mass_of(const dump_file *d, uint32_t i) { return dump_number(d, "sets", "mass", dump_set(d, i), 0); }

static void free_body(body *b)
{
    free(b->at);
    free(b->x);
    free(b->d);
}

static bool read_body(const dump_file *d, bool fluid, body *b)
{
    double *damage = host_alloc(d->n * sizeof *damage);
    const char *unit;
    memset(b, 0, sizeof *b);
    memset(damage, 0, d->n * sizeof *damage);
    if (!fluid && dump_has_field(d, "damage"))
        dump_field(d, "damage", damage, &unit);
    b->at = host_alloc(d->n * sizeof *b->at);
    b->x = host_alloc(d->n * sizeof *b->x);
    b->d = host_alloc(d->n * sizeof *b->d);
    for (uint32_t i = 0; i < d->n; i++)
        if (dump_role(d, i) == (fluid ? DUMP_FLUID : DUMP_SOLID))
            b->at[b->n++] = i;
    sorting = d;
    if (b->n)
        qsort(b->at, b->n, sizeof *b->at, by_id);
    for (uint32_t j = 0; j < b->n; j++) {
        b->d[j] = damage[b->at[j]];
        b->mass += mass_of(d, b->at[j]);
        for (uint32_t k = 0; k < 3; k++)
            b->x[j][k] = k < d->dim ? dump_x(d, b->at[j], k) : 0;
    }
    free(damage);
    if (b->n)
        return true;
    host_no(fluid ? "%s: carries no particle of a fluid" : "%s: carries no particle of a solid set", d->name);
    free_body(b);
    return false;
}

/* ---- pieces: flood from the particle of the smallest id that is in none yet ---- */

typedef struct flood {
    const dump_file *d;
    const body *b;
    const options *o;
    double threshold;
    bool *taken, has_body;
    uint32_t *queue, tail, head;
    double (*place)[3]; /* in the order of the queue, unwrapped where the domain repeats */
} flood;

static bool whole(const flood *f, uint32_t j) { return f->b->d[j] < f->threshold; }

/* the body of a set: a plate and its held ends are one; dumps from before there were solids do not say */
static double body_of(const flood *f, uint32_t j)
{
    const uint32_t set = dump_set(f->d, f->b->at[j]);
    return f->has_body ? dump_number(f->d, "materials", "body", set, 0) : set;
}

static void reach(void *ctx, uint32_t j, const double step[3], double r)
{
    flood *f = ctx;
    (void)r;
    if (f->taken[j] || !whole(f, j) || (!f->o->across && body_of(f, j) != body_of(f, f->queue[f->head])))
        return;
    f->taken[j] = true;
    for (uint32_t k = 0; k < 3; k++)
        f->place[f->tail][k] = f->place[f->head][k] + step[k];
    f->queue[f->tail++] = j;
}

/* the piece of particles queue[0..n) */
static void measure(const flood *f, uint32_t n, piece *p)
{
    const double pi = 3.14159265358979323846;
    double low[3], high[3];
    *p = (piece){.particles = n,
                 .first_id = dump_id(f->d, f->b->at[f->queue[0]]),
                 .set = dump_set(f->d, f->b->at[f->queue[0]])};
    memcpy(low, f->place[0], sizeof low);
    memcpy(high, f->place[0], sizeof high);
    for (uint32_t q = 0; q < n; q++) {
        const uint32_t i = f->b->at[f->queue[q]];
        const double mass = mass_of(f->d, i), rho0 = dump_number(f->d, "sets", "rho0", dump_set(f->d, i), 0);
        p->mass += mass;
        p->volume += rho0 > 0 ? mass / rho0 : 0;
        for (uint32_t k = 0; k < 3; k++) {
            p->centre[k] += mass * f->place[q][k];
            low[k] = fmin(low[k], f->place[q][k]);
            high[k] = fmax(high[k], f->place[q][k]);
        }
    }
    for (uint32_t k = 0; k < 3; k++) {
        p->centre[k] = p->mass > 0 ? p->centre[k] / p->mass : 0;
        p->edge[k] = k < f->d->dim ? high[k] - low[k] + f->d->spacing : 0;
        p->length = fmax(p->length, p->edge[k]);
    }
    p->diameter = f->d->dim == 1   ? p->volume
                  : f->d->dim == 2 ? 2 * sqrt(p->volume / pi)
                                   : 2 * cbrt(p->volume / (4 * pi / 3));
}

static int largest_first(const void *a, const void *b)
{
    const piece *p = a, *q = b;
    if (p->mass != q->mass)
        return p->mass < q->mass ? 1 : -1;
    return (p->first_id > q->first_id) - (p->first_id < q->first_id);
}

static bool find_pieces(const dump_file *d, const body *b, const options *o, double threshold, pieces *out)
{
    double period[3] = {0, 0, 0};
    dump_member m;
    flood f = {d, b, o, threshold, NULL, dump_find_member(dump_find(d, "materials"), "body", &m), NULL, 0, 0, NULL};
    near g;
    for (uint32_t k = 0; k < d->dim; k++)
        if (dump_periodic(d, k))
            period[k] = d->hi[k] - d->lo[k];
    memset(out, 0, sizeof *out);
    if (!near_open(&g, d->dim, b->n, (const double (*)[3])b->x, o->link * d->spacing, d->lo, period))
        return false;
    f.taken = host_alloc(b->n * sizeof *f.taken);
    f.queue = host_alloc(b->n * sizeof *f.queue);
    f.place = host_alloc(b->n * sizeof *f.place);
    memset(f.taken, 0, b->n * sizeof *f.taken);
    out->list = host_alloc(b->n * sizeof *out->list);
    for (uint32_t j = 0; j < b->n; j++) {
        if (!whole(&f, j) || f.taken[j]) {
            out->broken += !whole(&f, j);
            continue;
        }
        f.head = 0;
        f.tail = 1;
        f.taken[j] = true;
        f.queue[0] = j;
        memcpy(f.place[0], b->x[j], sizeof f.place[0]);
        for (; f.head < f.tail; f.head++) /* from its own place, which may be outside the domain: the cells repeat */
            near_each(&g, b->x[f.queue[f.head]], reach, &f);
        if (f.tail >= o->least)
            measure(&f, f.tail, &out->list[out->n++]);
        else
            out->broken += f.tail;
    }
    out->broken_mass = b->mass;
    for (uint32_t p = 0; p < out->n; p++)
        out->broken_mass -= out->list[p].mass;
    if (out->n)
        qsort(out->list, out->n, sizeof *out->list, largest_first);
    near_close(&g);
    free(f.taken);
    free(f.queue);
    free(f.place);
    return true;
}

/* ---- what is printed and written ---- */

static void print_head(const dump_file *d, const body *b, const options *o, const pieces *p)
{
    printf("%s: t = %.6g %s, ", d->name, d->time, dump_unit(d, "s"));
    if (o->fluid) {
        const double water = p->n ? p->list[0].mass : 0;
        const uint32_t most = p->n ? p->list[0].particles : 0;
        printf("fluid particles: %u, pieces: %u, outside the largest: %u (%.3f %% of the mass)\n", b->n, p->n,
               b->n - most, most < b->n ? 100 * (1 - water / b->mass) : 0);
        return;
    }
    printf("solid particles: %u, pieces: %u, broken particles: %u (%.2f %% of the mass)\n", b->n, p->n, p->broken,
           p->broken ? 100 * p->broken_mass / b->mass : 0);
    if (!dump_has_field(d, "damage"))
        printf("no array damage: nothing counts as broken\n");
}

/* how many pieces there would be at other thresholds */
static void print_thresholds(const dump_file *d, const body *b, const options *o)
{
    static const double others[] = {0.25, 0.5, 0.75, 0.95};
    printf("pieces by threshold of damage:");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        pieces q;
        if (!find_pieces(d, b, o, others[i], &q))
            break;
        printf("%s %u at %g", i ? "," : "", q.n, others[i]);
        free(q.list);
    }
    putchar('\n');
}

static void print_pieces(const dump_file *d, const body *b, const options *o, const pieces *p)
{
    const uint32_t shown = p->n < 20 ? p->n : 20;
    double length = 0, diameter = 0;
    print_head(d, b, o, p);
    if (p->n)
        printf("masses in %s, lengths in %s\n%5s %9s %8s %4s %12s %8s %11s %11s %11s %11s %11s\n", dump_unit(d, "kg"),
               dump_unit(d, "m"), "piece", "particles", "first id", "set", "mass", "share", "length", "diameter",
               "edge x", "edge y", "edge z");
    for (uint32_t i = 0; i < p->n; i++) {
        const piece *q = &p->list[i];
        length += q->length / p->n;
        diameter += q->diameter / p->n;
        if (i < shown)
            printf("%5u %9u %8u %4u %12.6g %7.3f%% %11.5g %11.5g %11.5g %11.5g %11.5g\n", i + 1, q->particles,
                   q->first_id,
                   q->set, q->mass, 100 * q->mass / b->mass, q->length, q->diameter, q->edge[0], q->edge[1],
                       q->edge[2]);
    }
    if (shown < p->n)
        printf("      ... and %u smaller ones\n", p->n - shown);
    if (p->n)
        printf("mean of the pieces: length %.5g, diameter %.5g %s\n", length, diameter, dump_unit(d, "m"));
    if (!o->fluid)
        print_thresholds(d, b, o);
}

static void write_pieces(const dump_file *d, const body *b, const pieces *p, FILE *f)
{
    const char *const m = dump_unit(d, "m");
    fputs("# fragments of ", f);
    host_put_name(f, d->name);
    fprintf(f,
            ", t = %.17g %s, %u particles broken\npiece,particles,first_id,set,mass_%s,share,"
            "length_%s,diameter_%s,edge_x_%s,edge_y_%s,edge_z_%s,x_%s,y_%s,z_%s\n",
            d->time, dump_unit(d, "s"), p->broken, dump_unit(d, "kg"), m, m, m, m, m, m, m, m);
    for (uint32_t i = 0; i < p->n; i++) {
        const piece *q = &p->list[i];
        fprintf(f, "%u,%u,%u,%u,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g\n", i + 1, q->particles,
                q->first_id, q->set, q->mass, q->mass / b->mass, q->length, q->diameter, q->edge[0], q->edge[1],
                q->edge[2],
                q->centre[0], q->centre[1], q->centre[2]);
    }
}

typedef struct sizes { /* of the pieces of all dumps */
    double *size, *mass, whole;
    uint32_t n;
    char metre[32]; /* unit of lengths of the first dump */
} sizes;

static void add_sizes(sizes *s, const pieces *p, bool by_length)
{
    s->size = host_realloc(s->size, (s->n + p->n) * sizeof *s->size);
    s->mass = host_realloc(s->mass, (s->n + p->n) * sizeof *s->mass);
    for (uint32_t i = 0; i < p->n; i++, s->n++) {
        s->size[s->n] = by_length ? p->list[i].length : p->list[i].diameter;
        s->mass[s->n] = p->list[i].mass;
        s->whole += p->list[i].mass;
    }
}

/* mean of Grady and Kipp's density over a bin */
static double theory(const gradykipp *g, double from, double to)
{
    const int n = 64;
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += gradykipp_density(g, from + (to - from) * (i + 0.5) / n);
    return sum / n;
}

/* pieces without a size are in the first one */
static uint64_t bin_of(double size, double width, uint64_t bins)
{
    const double at = width > 0 ? size / width : 0;
    return at > 0 ? at < (double)bins ? (uint64_t)at : bins - 1 : 0;
}

static void put_histogram(FILE *f, const sizes *s, const options *o, const char *format, const char *theory_format)
{
    double most = 0;
    for (uint32_t i = 0; i < s->n; i++)
        most = fmax(most, s->size[i]);
    const double width = most * (1 + 1e-12) / (double)o->bins;
    for (uint64_t k = 0; k < o->bins; k++) {
        uint32_t count = 0;
        double mass = 0;
        for (uint32_t i = 0; i < s->n; i++)
            if (bin_of(s->size[i], width, o->bins) == k) {
                count++;
                mass += s->mass[i];
            }
        fprintf(f, format, (double)k * width, (double)(k + 1) * width, count, mass / s->whole, mass / s->whole / width);
        if (o->has_theory)
            fprintf(f, theory_format, theory(&o->theory, (double)k * width, (double)(k + 1) * width));
        fputc('\n', f);
    }
}

static void show_histogram(const sizes *s, const options *o, FILE *f)
{
    if (!s->n)
        return;
    printf("\n%12s %12s %8s %10s %12s%s (lengths in %s)\n", "from", "to", "pieces", "of mass", "a length",
           o->has_theory ? "  Grady-Kipp" : "", s->metre);
    put_histogram(stdout, s, o, "%12.6g %12.6g %8u %10.5f %12.6g", " %11.6g");
    if (!f)
        return;
    fprintf(f, "# sizes by %s of %u pieces\nfrom_%s,to_%s,pieces,share_of_mass,density_per_%s",
            o->by_length ? "length" : "diameter", s->n, s->metre, s->metre, s->metre);
    if (o->has_theory)
        fprintf(f, ",gradykipp_per_%s", s->metre);
    fputc('\n', f);
    put_histogram(f, s, o, "%.12g,%.12g,%u,%.12g,%.12g", ",%.12g");
}

/* ---- the command ---- */

static bool one_dump(const char *name, options *o, sizes *s, FILE *out)
{
    dump_file d;
    body b;
    pieces p = {NULL, 0, 0, 0};
    if (!dump_open(&d, name))
        return false;
    bool fine = read_body(&d, o->fluid, &b);
    if (fine) {
        o->theory.dim = d.dim;
        fine = find_pieces(&d, &b, o, o->damage, &p);
        if (fine) {
            print_pieces(&d, &b, o, &p);
            if (!*s->metre)
                snprintf(s->metre, sizeof s->metre, "%s", dump_unit(&d, "m"));
            add_sizes(s, &p, o->by_length);
            if (out)
                write_pieces(&d, &b, &p, out);
        }
        free(p.list);
        free_body(&b);
    }
    dump_close(&d);
    return fine;
}

static bool parse_options(int argc, char **argv, options *o)
{
    static const char *const yes_no[] = {"no", "yes", NULL}, *const sizes_by[] = {"diameter", "length", NULL};
    const char *text;
    int given = 0, choice;
    *o = (options){.damage = 0.5, .link = 1.5, .by_length = true, .least = 1, .bins = 10};
    if (((text = host_option(argc, argv, "damage")) && !host_number("damage", text, 1e-9, 2, &o->damage)) ||
        ((text = host_option(argc, argv, "link")) && !host_number("link", text, 0.5, 100, &o->link)) ||
        ((text = host_option(argc, argv, "least")) && !host_count("least", text, 1, 1000000000, &o->least)) ||
        ((text = host_option(argc, argv, "bins")) && !host_count("bins", text, 1, 10000, &o->bins)))
        return false;
    static const char *const kinds[] = {"solid", "fluid", NULL};
    if ((text = host_option(argc, argv, "of"))) {
        if ((choice = host_choice("of", text, kinds)) < 0)
            return false;
        o->fluid = choice == 1;
    }
    if ((text = host_option(argc, argv, "across"))) {
        if ((choice = host_choice("across", text, yes_no)) < 0)
            return false;
        o->across = choice == 1;
    }
    if ((text = host_option(argc, argv, "by"))) {
        if ((choice = host_choice("by", text, sizes_by)) < 0)
            return false;
        o->by_length = choice == 1;
    }
    static const char *const of_theory[] = {"k", "m", "c", "rate"};
    for (int i = 0; i < 4; i++)
        given += host_option(argc, argv, of_theory[i]) != NULL;
    if (given && given < 4) {
        host_usage("k=, m=, c= and rate= belong together: give all four or none");
        return false;
    }
    o->has_theory = given == 4;
    o->out = host_option(argc, argv, "out");
    o->histogram = host_option(argc, argv, "histogram");
    return !given || (gradykipp_parse(argc, argv, &o->theory) &&
                      host_number("rate", host_option(argc, argv, "rate"), 1e-30, 1e30, &o->theory.rate));
}

int cmd_fragments(int argc, char **argv)
{
    static const char *const known[] = {"of", "damage", "link", "across", "least", "by", "bins", "k", "m", "c", "rate",
                                        "out", "histogram", NULL};
    options o;
    sizes s = {0};
    output file[2] = {{0}};
    host_command("fragments");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    const int files = host_known_options(argc, argv, known);
    if (files < 0 || !parse_options(argc, argv, &o))
        return HOST_USAGE;
    if (files == 0)
        return host_usage("give at least one dump");
    if (o.out && files > 1)
        return host_usage("out= takes the pieces of one dump, %d were given", files);
    bool fine = (!o.out || output_open(&file[0], "out", o.out)) &&
                (!o.histogram || output_open(&file[1], "histogram", o.histogram));
    for (int i = 1; fine && i <= files; i++)
        fine = one_dump(argv[i], &o, &s, file[0].f);
    if (fine)
        show_histogram(&s, &o, file[1].f);
    if (fine && file[1].f && !s.n) {
        output_close(&file[1], false);
        printf("no pieces: %s is not written\n", o.histogram);
    }
    fine = output_close_all(file, 2, fine) && fine;
    free(s.size);
    free(s.mass);
    return fine ? HOST_FINE : HOST_NO;
}
