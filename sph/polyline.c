/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* polyline.c: walls along a polyline: beds with slopes. A layer d behind the wall runs through the points

     P_k - d (n_a + n_b)/(1 + n_a . n_b),   n_a, n_b the normals of the pieces that meet in P_k

   which lie d behind both pieces (mitres). Its particles stand on these points and evenly between them, about a spacing
   apart; at the two ends half of that from the end, on the piece's own normal. So a layer goes on around a corner as a
   lattice does around that of a box. Rows of boundary force take the same points with d = 0, and both ends.

   The regions behind the pieces, in which particles have crossed, overlap where the fluid's angle is less than half a
   turn: there each goes on by thick tan(turn/2), to the end of its last mitre. Particles on mitres belong to sets of
   their own, whose normal is that of the corner, halfway between those of its pieces (Gray 2001, figure 2.4). */
#include "layers.h"
#include "arithmetic.h"

SPH_OBJECT(polyline)

#if SPH_WITH_POLYLINES && SPH_HAS_WALLS && SPH_DIM == 2

typedef struct polyline {
    const sph_wall *wall;
    const double (*p)[2];
    uint32_t n;
} polyline;

/* length of piece k, its direction */
static double piece(const polyline *b, uint32_t k, double *along)
{
    const double d[2] = {b->p[k + 1][0] - b->p[k][0], b->p[k + 1][1] - b->p[k][1]};
    const double length = __builtin_sqrt(d[0] * d[0] + d[1] * d[1]);
    along[0] = length > 0 ? d[0] / length : 0;
    along[1] = length > 0 ? d[1] / length : 0;
    return length;
}

/* tan(turn/2) at point k: > 0 where the way turns left, round less fluid than half a turn; 0 at the ends */
static double half_turn(const polyline *b, uint32_t k)
{
    double a[2], c[2];
    if (k == 0 || k + 1 == b->n)
        return 0;
    piece(b, k - 1, a);
    piece(b, k, c);
    return (a[0] * c[1] - a[1] * c[0]) / (1 + a[0] * c[0] + a[1] * c[1]);
}

/* the mean normal of corner k, (n_a + n_b)/(1 + n_a . n_b), or the normal of an end's piece */
static void mitre(const polyline *b, uint32_t k, double *out)
{
    double a[2], c[2];
    piece(b, k ? k - 1 : 0, a);
    piece(b, k + 1 < b->n ? k : k - 1, c);
    const double share = 1 / (1 + a[0] * c[0] + a[1] * c[1]);
    out[0] = -(a[1] + c[1]) * share;
    out[1] = (a[0] + c[0]) * share;
}

/* fills the set of piece k; a corner's, of point k */
static void describe_piece(const sph_sim *sim, const polyline *b, uint32_t k, sph_set *s)
{
    double along[2];
    const double length = piece(b, k, along);
    s->thick = sph_layers_count(sim, b->wall) * sim->cfg.spacing;
    const double t0 = half_turn(b, k), t1 = half_turn(b, k + 1);
    const double before = t0 > 0 ? t0 * s->thick : 0, behind = t1 > 0 ? t1 * s->thick : 0;
    s->half[0] = 0.5 * (length + before + behind);
    s->normal[0] = -along[1];
    s->normal[1] = along[0];
    for (int i = 0; i < 2; i++)
        s->origin[i] = b->p[k][i] - sim->cfg.lo[i] + along[i] * (s->half[0] - before);
}
static void describe_corner(const sph_sim *sim, const polyline *b, uint32_t k, sph_set *s)
{
    double n[2];
    mitre(b, k, n);
    const double size = __builtin_sqrt(n[0] * n[0] + n[1] * n[1]);
    s->corner = true;
    s->thick = sph_layers_count(sim, b->wall) * sim->cfg.spacing;
    for (int i = 0; i < 2; i++) {
        s->normal[i] = n[i] / size;
        s->origin[i] = b->p[k][i] - sim->cfg.lo[i];
    }
}

/* what is left of piece k in a layer d behind the wall */
static double piece_behind(const polyline *b, uint32_t k, double d)
{
    double along[2];
    return piece(b, k, along) + d * (half_turn(b, k) + half_turn(b, k + 1));
}

static sph_status add_point(sph_sim *sim, const polyline *b, uint32_t set, uint32_t k, double d, double along)
{
    double m[2], way[2], x[2];
    mitre(b, k, m);
    piece(b, k + 1 < b->n ? k : k - 1, way);
    for (int i = 0; i < 2; i++)
        x[i] = b->p[k][i] - sim->cfg.lo[i] - d * m[i] + along * way[i];
    return sph_setup_append(sim, set, x, NULL, 0);
}

/* the particles of piece k in a layer, without those on its mitres; rows of boundary force have some on free ends */
static sph_status add_between(sph_sim *sim, const polyline *b, uint32_t set, uint32_t k, double d)
{
    const double length = piece_behind(b, k, d), dx = sim->cfg.spacing;
    const double off = sph_layers_wanted(b->wall) ? 0.5 : 0;
    const double low = k == 0 ? off : 1, high = k + 2 == b->n ? off : 1;
    /* intervals from particle to particle, halves at free ends of layers among them */
    const double halves = (k == 0 ? off : 0) + (k + 2 == b->n ? off : 0), whole = length / dx - halves + 0.5;
    const double intervals = (double)(uint32_t)(whole < 0 ? 0 : whole) + halves;
    const double step = length / (intervals > 0 ? intervals : 1);
    sph_status st = SPH_OK;
    for (uint32_t i = 0; !st && (low + i) <= intervals - high + 1e-9; i++)
        st = add_point(sim, b, set, k, d, (low + i) * step);
    return st;
}

static sph_status add_set(sph_sim *sim, const polyline *b, uint32_t k, bool corner)
{
    const uint32_t layers = sph_layers_wanted(b->wall) ? sph_layers_count(sim, b->wall) : 1;
    const double first = sph_layers_wanted(b->wall) ? 0.5 : 0, dx = sim->cfg.spacing;
    uint32_t set;
    sph_set *const s = sph_layers_new_set(sim, b->wall, &set);
    if (!s)
        return SPH_TOO_MANY_SETS;
    if (corner)
        describe_corner(sim, b, k, s);
    else
        describe_piece(sim, b, k, s);
    sph_layers_bound(sim, s);
    sph_setup_finish_set(sim, s);
    sph_status st = SPH_OK;
    for (uint32_t l = 0; !st && l < layers; l++)
        st = corner ? add_point(sim, b, set, k, (l + first) * dx, 0) : add_between(sim, b, set, k, (l + first) * dx);
    return st;
}

static sph_status check_points(sph_sim *sim, const polyline *b)
{
    for (uint32_t k = 0; k < b->n; k++) {
        const sph_status st = sph_setup_check_vector(sim, "points", b->p[k]);
        if (st)
            return st;
    }
    for (uint32_t k = 1; k + 1 < b->n; k++) {
        double a[2], c[2];
        piece(b, k - 1, a);
        piece(b, k, c);
        if (!(a[0] * c[0] + a[1] * c[1] > -1e-9))
            return sph_setup_bad(sim, "points", "turns of at most a right angle", k);
    }
    const double deepest = sph_layers_wanted(b->wall) ? sph_layers_count(sim, b->wall) * sim->cfg.spacing : 0;
    for (uint32_t k = 0; k + 1 < b->n; k++) {
        double along[2];
        const double length = piece(b, k, along), behind = piece_behind(b, k, deepest);
        if (!(length < 1e8 * sim->cfg.spacing))
            return sph_setup_bad(sim, "points", "at most 10^8 spacings apart", length);
        if (!((length < behind ? length : behind) >= sim->cfg.spacing))
            return sph_setup_bad(sim, "points", "a spacing apart and more, also in the deepest layer",
                                 length < behind ? length : behind);
    }
    return SPH_OK;
}

sph_status sph_add_wall_polyline(sph_sim *sim, const sph_wall *wall, const double (*points)[SPH_DIM], uint32_t n,
                                 uint32_t *group)
{
    sph_status st = sph_layers_check(sim, wall, "sph_add_wall_polyline");
    if (st)
        return st;
    if (!points || n < 2 || n > SPH_MAX_SETS)
        return sph_setup_bad(sim, "points", "2 .. SPH_MAX_SETS points", points ? n : 0);
    const polyline b = {wall, points, n};
    if ((st = check_points(sim, &b)) != SPH_OK)
        return st;
    const sph_layers_before m = sph_layers_mark(sim);
    for (uint32_t k = 0; !st && k + 1 < n; k++) {
        if (k > 0)
            st = add_set(sim, &b, k, true);
        st = st ? st : add_set(sim, &b, k, false);
    }
    return sph_layers_finish(sim, wall, m, st, group);
}

#endif
