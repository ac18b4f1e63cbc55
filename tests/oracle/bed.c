/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bed.c: walls along a polyline (sph.h, sph_add_wall_polyline), in 2-D: through points P_0 .. P_n-1, the fluid on the
   left. A layer d behind it (d = (l + 1/2) dx, or 0: a row that stands on the wall) is the polyline whose pieces lie d
   behind those of the wall, each on its own line; they meet where these lines cross, and at the two free ends stop
   square. It has a particle in each crossing and evenly spaced ones between, as many as there is room for spacings,
   rounded; from a free end layers keep half a step, rows none.
     normal   of a piece's: to the left of the way; of a corner's: halfway between those of its two pieces
     mass     rho0 dx^2, each
     face     what a piece takes as crossed is so thick as its layers and so long as it is, and where the fluid has less
              than half a turn of room, as far as the crossing of the lines behind the last layer. Corners have none */
#include "oracle.h"

typedef struct line {
    double at[2], along[2], normal[2], length;
} line;

static line piece(const double (*p)[2], uint32_t k)
{
    const double d[2] = {p[k + 1][0] - p[k][0], p[k + 1][1] - p[k][1]}, length = hypot(d[0], d[1]);
    return (line){{p[k][0], p[k][1]}, {d[0] / length, d[1] / length}, {-d[1] / length, d[0] / length}, length};
}

static double cross(const double *a, const double *b) { return a[0] * b[1] - a[1] * b[0]; }

/* where the way d behind the wall passes point k */
static void vertex(const double (*p)[2], uint32_t n, uint32_t k, double d, double *v)
{
    const line a = piece(p, k ? k - 1 : 0), b = piece(p, k + 1 < n ? k : k - 1);
    const double turn = cross(a.along, b.along);
    double t = 0;
    if (fabs(turn) > 1e-9) { /* p - d n_a + t a = p - d n_b + u b; else one line */
        const double off[2] = {d * (a.normal[0] - b.normal[0]), d * (a.normal[1] - b.normal[1])};
        t = cross(off, b.along) / turn;
    }
    for (int i = 0; i < 2; i++)
        v[i] = p[k][i] - d * a.normal[i] + t * a.along[i];
}

/* how far the face of the piece with this direction goes on beyond point k */
static double beyond(const double (*p)[2], uint32_t n, uint32_t k, double thick, const double *along)
{
    double v[2];
    vertex(p, n, k, thick, v);
    return o_max(0, (v[0] - p[k][0]) * along[0] + (v[1] - p[k][1]) * along[1]);
}

static void of_piece(const double (*p)[2], uint32_t n, uint32_t k, double thick, o_bed_particle *o)
{
    const line l = piece(p, k);
    const double back[2] = {-l.along[0], -l.along[1]};
    const double before = beyond(p, n, k, thick, back), behind = beyond(p, n, k + 1, thick, l.along);
    *o = (o_bed_particle){.region = true, .half = 0.5 * (l.length + before + behind)};
    for (int i = 0; i < 2; i++) {
        o->normal[i] = l.normal[i];
        o->origin[i] = p[k][i] + 0.5 * (l.length + behind - before) * l.along[i];
    }
}

static void of_corner(const double (*p)[2], uint32_t k, o_bed_particle *o)
{
    const line a = piece(p, k - 1), b = piece(p, k);
    const double n[2] = {a.normal[0] + b.normal[0], a.normal[1] + b.normal[1]}, size = hypot(n[0], n[1]);
    *o = (o_bed_particle){.normal = {n[0] / size, n[1] / size}, .origin = {p[k][0], p[k][1]}};
}

/* from one place to another, with so much of a step free at each end: 0, 1/2, or 1 where a corner's stands; how many */
static uint32_t between(o_scene *s, const double *from, const double *to, double low, double high, o_bed_particle like,
                        o_bed_particle *out)
{
    const double length = hypot(to[0] - from[0], to[1] - from[1]), dx = s->cfg.spacing;
    const double halves = (low == 0.5 ? 0.5 : 0) + (high == 0.5 ? 0.5 : 0), whole = length / dx - halves;
    const double steps = floor(whole + 0.5) + halves;
    uint32_t n = 0;
    o_close(s, "a row with room for half a particle", whole - floor(whole), 0.5, 1);
    for (double at = low; at < steps - high + 0.25; at += 1, n++) {
        out[n] = like;
        for (int i = 0; i < 2; i++)
            out[n].x[i] = from[i] + at / steps * (to[i] - from[i]);
    }
    return n;
}

uint32_t o_lay_bed(o_scene *s, const double (*p)[2], uint32_t n, uint32_t layers, double thick, o_bed_particle *out)
{
    uint32_t m = 0;
    const double end = layers ? 0.5 : 0;
    for (uint32_t l = 0; l < (layers ? layers : 1); l++)
        for (uint32_t k = 0; k + 1 < n; k++) {
            const double d = (l + end) * s->cfg.spacing;
            double from[2], to[2];
            o_bed_particle like;
            vertex(p, n, k, d, from);
            vertex(p, n, k + 1, d, to);
            if (k > 0) {
                of_corner(p, k, &out[m]);
                out[m].x[0] = from[0];
                out[m++].x[1] = from[1];
            }
            of_piece(p, n, k, thick, &like);
            m += between(s, from, to, k ? 1 : end, k + 2 < n ? 1 : end, like, out + m);
        }
    return m;
}
