/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_render.c: sph render. Dumps as pictures: particles coloured by a field in 2-D, a slice or a projection of 3-D, a
   plot of the field against x in 1-D. Every picture carries its time, axes with units and a colour bar. */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"
#include "image.h"
#include "output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph render DUMP... out=NAME.png [options]\n"
    "  out=NAME.png   the picture; of several dumps NAME_0000.png, NAME_0001.png, ..., all with one range of colours\n"
    "  field=speed    what colours mean: " DUMP_FIELDS "\n"
    "  min=, max=     fixed range of the field (default: that of the particles drawn; of stresses and of components "
    "of\n"
    "                 vectors as far below 0 as above)\n"
    "  palette=       even (violet to yellow) or signed (blue below 0, grey, red above; the default for the latter)\n"
    "  size=WxH       in pixels, default 960x640\n"
    "  view=A,B,C,D   the part shown, in the dump's lengths: from A to B across and from C to D up (default: all\n"
    "                 particles)\n"
    "  walls=yes|no   wall particles in grey (default yes)\n"
    "  3-D:  slice=AXIS,POSITION,THICKNESS   shows the particles of a slice, e.g. slice=y,0.5,0.1\n"
    "        azimuth=30 elevation=20         directions (degrees) of the projection that is drawn without a slice\n"
    "  1-D:  the field against x; min and max are the range of the vertical axis\n";

typedef struct options {
    const char *field, *out;
    int width, height;
    bool walls, has_min, has_max, has_view, has_slice;
    int palette; /* EVEN, SIGNED; BY_FIELD until the field is known */
    double min, max, view[4], slice, thick, azimuth, elevation;
    uint32_t slice_axis;
} options;

/* a particle as it is drawn: across, up, away from the eye (m) */
typedef struct dot {
    double x, y, z, value;
    bool wall;
} dot;

typedef struct scene {
    dot *dot;
    uint32_t n;
    double x0, x1, y0, y1; /* part shown, m */
    const char *unit;
    char across[48], up[48];
} scene;

enum { EVEN, SIGNED, BY_FIELD };
#define FARTHEST 1e30   /* places and values */
#define NARROWEST 1e-9  /* width of a view or a range, of its largest number: ticks must tell numbers apart */

static const colour white = {255, 255, 255}, black = {20, 20, 20}, grey = {170, 170, 170};

/* ---- which particles, where ---- */

static void project(const options *o, const double *x, uint32_t dim, dot *t)
{
    if (dim < 3) {
        t->x = x[0];
        t->y = dim == 2 ? x[1] : t->value;
        t->z = 0;
    } else if (o->has_slice) {
        t->x = x[o->slice_axis == 0 ? 1 : 0];
        t->y = x[o->slice_axis == 2 ? 1 : 2];
        t->z = 0;
    } else {
        const double rad = 3.14159265358979323846 / 180, ca = cos(o->azimuth * rad), sa = sin(o->azimuth * rad);
        const double ce = cos(o->elevation * rad), se = sin(o->elevation * rad);
        const double away = sa * x[0] + ca * x[1];
        t->x = ca * x[0] - sa * x[1];
        t->y = ce * x[2] + se * away;
        t->z = ce * away - se * x[2];
    }
}

static bool in_slice(const options *o, const double *x)
{
    return !o->has_slice || fabs(x[o->slice_axis] - o->slice) <= 0.5 * o->thick;
}

static int far_first(const void *a, const void *b)
{
    const dot *p = a, *q = b;
    if (p->wall != q->wall)
        return p->wall ? -1 : 1;
    return (p->z < q->z) - (p->z > q->z);
}

static void name_axes(scene *s, const options *o, const dump_file *d)
{
    const char *const metre = dump_unit(d, "m");
    const uint32_t across = d->dim == 3 && o->slice_axis == 0 ? 1 : 0, up = d->dim == 3 && o->slice_axis != 2 ? 2 : 1;
    snprintf(s->across, sizeof s->across, "%c (%s)", (int)('x' + across), metre);
    snprintf(s->up, sizeof s->up, "%c (%s)", (int)('x' + up), metre);
    if (d->dim == 1)
        *s->up = '\0';
    if (d->dim == 3 && !o->has_slice) {
        snprintf(s->across, sizeof s->across, "across (%s)", metre);
        snprintf(s->up, sizeof s->up, "up (%s)", metre);
    }
}

static bool all_finite(const options *o, const dump_file *d, const double *value)
{
    for (uint32_t i = 0; i < d->n; i++)
        if (!(fabs(value[i]) <= FARTHEST)) {
            host_no("%s: %s of particle %u is %g, allowed: -%g .. %g", d->name, o->field, dump_id(d, i), value[i],
                    FARTHEST, FARTHEST);
            return false;
        }
    return true;
}

static bool make_scene(scene *s, const options *o, const dump_file *d)
{
    double *value = host_alloc(d->n * sizeof *value), x[3] = {0, 0, 0};
    memset(s, 0, sizeof *s);
    if (!dump_field(d, o->field, value, &s->unit) || !all_finite(o, d, value)) {
        free(value);
        return false;
    }
    s->dot = host_alloc(d->n * sizeof *s->dot);
    for (uint32_t i = 0; i < d->n; i++) {
        const uint32_t role = dump_role(d, i);
        if (role == DUMP_GONE || (dump_is_wall(role) && !o->walls))
            continue;
        for (uint32_t k = 0; k < d->dim; k++)
            x[k] = dump_x(d, i, k);
        if (d->dim == 3 && !in_slice(o, x))
            continue;
        dot *t = &s->dot[s->n++];
        *t = (dot){0, 0, 0, value[i], dump_is_wall(role)};
        project(o, x, d->dim, t);
    }
    free(value);
    name_axes(s, o, d);
    if (s->n)
        qsort(s->dot, s->n, sizeof *s->dot, far_first);
    return true;
}

static void value_range(const scene *s, double *low, double *high)
{
    for (uint32_t i = 0; i < s->n; i++)
        if (!s->dot[i].wall) {
            *low = fmin(*low, s->dot[i].value);
            *high = fmax(*high, s->dot[i].value);
        }
}

/* the part shown: all particles and half a spacing around */
static void choose_view(scene *s, const options *o, const dump_file *d, double low, double high)
{
    double half = 0.5 * d->spacing;
    s->x0 = s->y0 = HUGE_VAL;
    s->x1 = s->y1 = -HUGE_VAL;
    for (uint32_t i = 0; i < s->n; i++) {
        s->x0 = fmin(s->x0, s->dot[i].x - half);
        s->x1 = fmax(s->x1, s->dot[i].x + half);
        s->y0 = fmin(s->y0, s->dot[i].y - half);
        s->y1 = fmax(s->y1, s->dot[i].y + half);
    }
    if (s->n == 0) {
        s->x0 = d->lo[0];
        s->x1 = d->hi[0];
        s->y0 = d->lo[d->dim - 1];
        s->y1 = d->hi[d->dim - 1];
    }
    if (d->dim == 1) {
        s->y0 = low;
        s->y1 = high;
    }
    if (o->has_view) {
        s->x0 = o->view[0];
        s->x1 = o->view[1];
        s->y0 = o->view[2];
        s->y1 = o->view[3];
    }
}

/* ---- drawing ---- */

/* the frame in pixels and the scales into it */
typedef struct frame {
    int left, top, width, height, scale;
    double sx, sy; /* pixels a unit */
} frame;

static frame make_frame(const scene *s, const options *o, bool same_scale)
{
    frame f;
    f.scale = o->width >= 640 && o->height >= 400 ? 2 : 1;
    f.left = 52 * f.scale;
    f.top = 24 * f.scale;
    f.width = o->width - f.left - 84 * f.scale;
    f.height = o->height - f.top - 30 * f.scale;
    f.sx = f.width / (s->x1 - s->x0);
    f.sy = f.height / (s->y1 - s->y0);
    if (same_scale) {
        f.sx = f.sy = fmin(f.sx, f.sy);
        const int w = (int)ceil(f.sx * (s->x1 - s->x0)), h = (int)ceil(f.sy * (s->y1 - s->y0));
        f.top += (f.height - h) / 2;
        f.width = w;
        f.height = h;
    }
    return f;
}

/* a step of 1, 2 or 5 times a power of ten that gives at most n ticks */
static double tick_step(double range, int n)
{
    double step = pow(10, floor(log10(range / n)));
    static const double by[] = {1, 2, 5, 10};
    for (int k = 0; k < 4; k++)
        if (range / (by[k] * step) <= n)
            return by[k] * step;
    return 10 * step;
}

static void tick_text(char *text, size_t size, double v, double step)
{
    snprintf(text, size, "%.5g", fabs(v) < 1e-9 * step ? 0.0 : v);
}

/* ticks of a range at multiples of a step: number k of count is at (first + k) step */
typedef struct ticks {
    double step, first;
    int count;
} ticks;
static ticks make_ticks(double low, double high, int n)
{
    ticks t = {tick_step(high - low, n), 0, 0};
    t.first = ceil(low / t.step - 1e-9);
    const double count = floor(high / t.step + 1e-9) - t.first + 1;
    t.count = count > 0 ? count < 2 * n + 2 ? (int)count : 2 * n + 2 : 0;
    return t;
}

static void draw_axes(image *m, const frame *f, const scene *s)
{
    char text[32];
    const int g = f->scale, bottom = f->top + f->height, h = image_text_height(g);
    image_rect(m, f->left - 1, f->top - 1, f->width + 2, 1, grey);
    image_rect(m, f->left - 1, bottom, f->width + 2, 1, grey);
    image_rect(m, f->left - 1, f->top - 1, 1, f->height + 2, grey);
    image_rect(m, f->left + f->width, f->top - 1, 1, f->height + 2, grey);
    ticks t = make_ticks(s->x0, s->x1, f->width / (44 * g) + 1);
    for (int k = 0; k < t.count; k++) {
        const double v = (t.first + k) * t.step;
        const int x = f->left + (int)lround((v - s->x0) * f->sx);
        tick_text(text, sizeof text, v, t.step);
        image_rect(m, x, bottom, 1, 3 * g, black);
        image_text(m, x - image_text_width(text, g) / 2, bottom + 5 * g, g, text, black);
    }
    t = make_ticks(s->y0, s->y1, f->height / (24 * g) + 1);
    for (int k = 0; k < t.count; k++) {
        const double v = (t.first + k) * t.step;
        const int y = bottom - (int)lround((v - s->y0) * f->sy);
        tick_text(text, sizeof text, v, t.step);
        image_rect(m, f->left - 1 - 3 * g, y, 3 * g, 1, black);
        image_text(m, f->left - 5 * g - image_text_width(text, g), y - 4 * g, g, text, black);
    }
    image_text(m, f->left + f->width / 2 - image_text_width(s->across, g) / 2, bottom + 8 * g + h, g, s->across, black);
    image_text(m, 2 * g, f->top - h - 2 * g, g, s->up, black);
}

/* signed: grey is 0 wherever the range ends */
static colour colour_of(const options *o, double v, double low, double high)
{
    return o->palette == SIGNED ? image_map_signed(0.5 + 0.5 * v / fmax(fabs(low), fabs(high)))
                                : image_map((v - low) / (high - low));
}

static void draw_bar(image *m, const frame *f, const options *o, const char *unit, double low, double high)
{
    char text[64];
    const int g = f->scale, x = m->width - 78 * g, top = 40 * g, width = 14 * g, height = m->height - top - 40 * g;
    for (int k = 0; k < height; k++)
        image_rect(m, x, top + height - 1 - k, width, 1,
                   colour_of(o, low + (high - low) * (k + 0.5) / height, low, high));
    const ticks t = make_ticks(low, high, 6);
    for (int k = 0; k < t.count; k++) {
        const double v = (t.first + k) * t.step;
        const int y = top + height - (int)lround((v - low) / (high - low) * height);
        tick_text(text, sizeof text, v, t.step);
        image_rect(m, x + width, y, 3 * g, 1, black);
        image_text(m, x + width + 5 * g, y - 4 * g, g, text, black);
    }
    snprintf(text, sizeof text, "%s", o->field);
    image_text(m, m->width - 82 * g, 6 * g, g, text, black);
    if (*unit) {
        snprintf(text, sizeof text, "(%s)", unit);
        image_text(m, m->width - 82 * g, 18 * g, g, text, black);
    }
}

/* a particle: a square of its spacing when that is small, else a disc; nothing outside the frame */
static void draw_dot(image *m, const frame *f, const scene *s, const dot *t, double size, colour c)
{
    const double x = f->left + (t->x - s->x0) * f->sx, y = f->top + f->height - (t->y - s->y0) * f->sy;
    if (!(x >= f->left && x <= f->left + f->width && y >= f->top && y <= f->top + f->height))
        return;
    if (size < 4) {
        const int n = size > 1 ? (int)ceil(size) : 1;
        image_rect(m, (int)floor(x - 0.5 * size), (int)floor(y - 0.5 * size), n, n, c);
    } else
        image_disc(m, x, y, 0.5 * size, c);
}

static void draw_dots(image *m, const frame *f, const scene *s, const dump_file *d, const options *o, double low,
                      double high)
{
    const bool solid = d->dim == 3 && !o->has_slice;
    const double size = d->dim == 1 ? 3.0 * f->scale : 1.1 * d->spacing * f->sx;
    for (uint32_t i = 0; i < s->n; i++) {
        const dot *t = &s->dot[i];
        if (t->wall) { /* of a projection a wall shows its points only, to let the water be seen */
            draw_dot(m, f, s, t, solid ? fmin(size, f->scale) : size, grey);
            continue;
        }
        const colour c = colour_of(o, t->value, low, high);
        if (solid && size >= 4) {
            const colour rim = {(uint8_t)(c.r * 0.7), (uint8_t)(c.g * 0.7), (uint8_t)(c.b * 0.7)};
            draw_dot(m, f, s, t, size * 1.15, rim);
        }
        draw_dot(m, f, s, t, size, c);
    }
}

/* is a range one that numbers can tell apart? else a message */
static bool check_range(const char *what, const dump_file *d, double low, double high)
{
    const double most = fmax(fabs(low), fabs(high));
    if (most <= FARTHEST && high - low >= NARROWEST * most && high > low)
        return true;
    host_no("%s: %s is %.17g .. %.17g, allowed: within -%g .. %g, and %g of its largest number wide", d->name, what,
            low, high, FARTHEST, FARTHEST, NARROWEST);
    return false;
}

static bool draw(scene *s, const dump_file *d, const options *o, double low, double high, output *out)
{
    char title[128];
    choose_view(s, o, d, low, high);
    if (!check_range("the view across", d, s->x0, s->x1) || !check_range("the view up", d, s->y0, s->y1))
        return false;
    image m = image_new(o->width, o->height, white);
    const frame f = make_frame(s, o, d->dim > 1);
    draw_dots(&m, &f, s, d, o, low, high);
    draw_axes(&m, &f, s);
    draw_bar(&m, &f, o, s->unit, low, high);
    snprintf(title, sizeof title, "t = %.5g %s, step %llu", d->time, dump_unit(d, "s"), (unsigned long long)d->step);
    image_text(&m, f.left, 5 * f.scale, f.scale, title, black);
    const bool fine = image_write_png(&m, out->f);
    if (!fine)
        host_no("%s: the picture could not be packed", out->name);
    image_free(&m);
    return fine;
}

/* ---- the command ---- */

/* the palette of the field, and the range of colours: what was asked for, else that of all the dumps */
static bool find_range(char **dumps, int n, options *o, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (int k = 0; k < n && !(o->has_min && o->has_max && o->palette != BY_FIELD); k++) {
        dump_file d;
        scene s;
        if (!dump_open(&d, dumps[k]))
            return false;
        bool fine = make_scene(&s, o, &d);
        if (fine)
            value_range(&s, low, high);
        if (fine && o->palette == BY_FIELD)
            o->palette = dump_field_signed(&d, o->field) ? SIGNED : EVEN;
        if (fine)
            free(s.dot);
        dump_close(&d);
        if (!fine)
            return false;
    }
    if (*low > *high)
        *low = *high = 0;
    if (o->palette == SIGNED) { /* a range that was not asked for reaches as far below 0 as above */
        const double most = o->has_min ? -o->min : o->has_max ? o->max : fmax(fabs(*low), fabs(*high));
        *low = most > 0 ? -most : *low;
        *high = most > 0 ? most : *high;
    }
    *low = o->has_min ? o->min : *low;
    *high = o->has_max ? o->max : *high;
    if (!(*high - *low > NARROWEST * fmax(fabs(*low), fabs(*high)))) { /* one value only: a bar around it */
        const double by = *low != 0 ? 0.01 * fabs(*low) : 1;
        *low = o->has_min ? *low : *low - by;
        *high = o->has_max ? *high : (o->has_min ? *low : *high) + by;
    }
    return true;
}

static bool render_one(const char *dump, const options *o, double low, double high, output *out)
{
    dump_file d;
    scene s;
    bool fine = false;
    if (!dump_open(&d, dump))
        return false;
    if (o->has_slice && d.dim != 3)
        host_usage("slice: %s is %u-D, a slice is of a 3-D dump", dump, d.dim);
    else if (check_range(o->field, &d, low, high) && make_scene(&s, o, &d)) {
        fine = draw(&s, &d, o, low, high, out);
        free(s.dot);
    }
    dump_close(&d);
    return fine;
}

/* all pictures, or none */
static int render(char **dumps, int n, options *o)
{
    double low, high;
    const size_t room = strlen(o->out) + 32, count = (size_t)n;
    char *name = host_alloc(count * room);
    output *out = host_alloc(count * sizeof *out);
    memset(out, 0, count * sizeof *out);
    bool fine = find_range(dumps, n, o, &low, &high);
    for (int k = 0; fine && k < n; k++) {
        char *own = name + (size_t)k * room;
        snprintf(own, room, n > 1 ? "%.*s_%04d.png" : "%.*s.png", (int)(strlen(o->out) - 4), o->out, k);
        fine = output_open(&out[k], "out", own) && render_one(dumps[k], o, low, high, &out[k]) && output_ready(&out[k]);
    }
    fine = output_close_all(out, count, fine) && fine;
    free(name);
    free(out);
    return fine ? HOST_FINE : HOST_NO;
}

static bool parse_slice(const char *text, options *o)
{
    double v[2];
    if (text[0] < 'x' || text[0] > 'z' || text[1] != ',') {
        host_usage("slice=%s: must be AXIS,POSITION,THICKNESS with AXIS x, y or z", text);
        return false;
    }
    if (!host_numbers("slice", text + 2, 2, v))
        return false;
    if (!(v[1] > 0)) {
        host_usage("slice=%s: the thickness must be > 0", text);
        return false;
    }
    o->has_slice = true;
    o->slice_axis = (uint32_t)(text[0] - 'x');
    o->slice = v[0];
    o->thick = v[1];
    return true;
}

static bool parse_size(const char *text, options *o)
{
    char end;
    if (sscanf(text, "%dx%d%c", &o->width, &o->height, &end) == 2 && o->width >= 300 && o->width <= 16000 &&
        o->height >= 200 && o->height <= 16000)
        return true;
    host_usage("size=%s: must be WIDTHxHEIGHT, from 300x200 to 16000x16000", text);
    return false;
}

static bool parse_options(int argc, char **argv, options *o)
{
    static const char *const yes_no[] = {"no", "yes", NULL}, *const palettes[] = {"even", "signed", NULL};
    const char *t;
    *o = (options){.field = "speed", .palette = BY_FIELD, .width = 960, .height = 640,
                   .walls = true, .azimuth = 30, .elevation = 20};
    if ((t = host_option(argc, argv, "field")))
        o->field = t;
    if ((t = host_option(argc, argv, "walls"))) {
        const int c = host_choice("walls", t, yes_no);
        if (c < 0)
            return false;
        o->walls = c == 1;
    }
    if ((t = host_option(argc, argv, "palette")) && (o->palette = host_choice("palette", t, palettes)) < 0)
        return false;
    o->out = host_option(argc, argv, "out");
    o->has_min = (t = host_option(argc, argv, "min")) != NULL;
    if (t && !host_number("min", t, -FARTHEST, FARTHEST, &o->min))
        return false;
    o->has_max = (t = host_option(argc, argv, "max")) != NULL;
    if (t && !host_number("max", t, -FARTHEST, FARTHEST, &o->max))
        return false;
    if (o->has_min && o->has_max && !(o->max > o->min)) {
        host_usage("max=%g: must be above min=%g", o->max, o->min);
        return false;
    }
    if (o->has_min && o->has_max && !(o->max - o->min >= NARROWEST * fmax(fabs(o->max), fabs(o->min)))) {
        host_usage("max=%.17g: must be above min=%.17g by %g of either", o->max, o->min, NARROWEST);
        return false;
    }
    o->has_view = (t = host_option(argc, argv, "view")) != NULL;
    if (t && !host_numbers("view", t, 4, o->view))
        return false;
    if (t && !(o->view[1] > o->view[0] && o->view[3] > o->view[2])) {
        host_usage("view=%s: the second number must be above the first, the fourth above the third", t);
        return false;
    }
    for (int k = 0; t && k < 4; k += 2) {
        const double low = o->view[k], high = o->view[k + 1], most = fmax(fabs(low), fabs(high));
        if (!(most <= FARTHEST && high - low >= NARROWEST * most)) {
            host_usage("view=%s: %.17g .. %.17g must be within -%g .. %g, and %g of its largest number wide", t, low,
                       high, FARTHEST, FARTHEST, NARROWEST);
            return false;
        }
    }
    return (!(t = host_option(argc, argv, "size")) || parse_size(t, o)) &&
           (!(t = host_option(argc, argv, "slice")) || parse_slice(t, o)) &&
           (!(t = host_option(argc, argv, "azimuth")) || host_number("azimuth", t, -360, 360, &o->azimuth)) &&
           (!(t = host_option(argc, argv, "elevation")) || host_number("elevation", t, -90, 90, &o->elevation));
}

int cmd_render(int argc, char **argv)
{
    static const char *const known[] = {"out",   "field", "min",     "max",       "size",    "view",
                                        "walls", "slice", "azimuth", "elevation", "palette", NULL};
    options o;
    host_command("render");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    int files = host_known_options(argc, argv, known);
    if (files < 0 || !parse_options(argc, argv, &o))
        return HOST_USAGE;
    if (files == 0 || !o.out)
        return host_usage("give at least one dump, and out=NAME.png");
    if (strlen(o.out) <= 4 || strcmp(o.out + strlen(o.out) - 4, ".png") != 0)
        return host_usage("out=%s: must end in .png", o.out);
    return render(argv + 1, files, &o);
}
