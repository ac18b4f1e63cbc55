/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sample.c: values at any place (see sample.h). With q = r/reach and weights w = V (1 - q)^4 (1 + 4 q):
     order 0  sum w f / sum w                                            (Shepard 1968): exact for constants
     order 1  the value at 0 of the polynomial a + b.d that makes sum w (a + b.d - f)^2 least (Lancaster and Salkauskas
              1981): exact for linear fields, also beside a free surface, where order 0 is one-sided.
   A linear function goes on outside of the particles it was made from, and there it is worth nothing. So order 1 is for
   places in the body: within sqrt(dim) spacings of a particle (the corner of a surface half a spacing outside of a
   lattice is half of that away; the other half is for disorder). It needs more than the dim + 1 particles which any
   linear field fits (in 1-D these, two), and sum phi f, by which it is a sum over the particles, must not blow errors
   up: S = sum |phi| is 1 among particles and grows by 2 e along each axis along which a place is e spacings outside of
   them; up to 1 + 6 dim. Elsewhere the mean of order 0 is taken, which never leaves the range of what is near. */
#include "sample.h"

#include <math.h>
#include <string.h>

#define MOST_SPREAD(dim) (1.0 + 6 * (dim))

typedef struct sums {
    const sampler *s;
    uint32_t n, terms;                         /* terms of the polynomial */
    double m[4][4], rhs[SAMPLE_FIELDS + 1][4]; /* in d/reach; the last right hand side is (1, 0 ..) and gives c */
    double row[4], spread, nearest;            /* c, so that phi = w (c . (1, d)); S; distance in spacings */
} sums;

static double weight(const sampler *s, uint32_t j, double r)
{
    const double q = r / s->g->reach, u = 1 - q;
    return s->volume[j] * u * u * u * u * (1 + 4 * q);
}

static void add(void *ctx, uint32_t j, const double d[3], double r)
{
    sums *t = ctx;
    const double reach = t->s->g->reach, w = weight(t->s, j, r);
    const double basis[4] = {1, d[0] / reach, d[1] / reach, d[2] / reach};
    if (!(w > 0))
        return;
    t->n++;
    t->nearest = fmin(t->nearest, r / pow(t->s->volume[j], 1.0 / t->s->g->dim));
    for (uint32_t a = 0; a < t->terms; a++) {
        for (uint32_t b = 0; b < t->terms; b++)
            t->m[a][b] += w * basis[a] * basis[b];
        for (uint32_t f = 0; f < t->s->fields; f++)
            t->rhs[f][a] += w * basis[a] * t->s->field[f][j];
    }
}

static void add_spread(void *ctx, uint32_t j, const double d[3], double r)
{
    sums *t = ctx;
    const double reach = t->s->g->reach, basis[4] = {1, d[0] / reach, d[1] / reach, d[2] / reach};
    double phi = 0;
    for (uint32_t a = 0; a < t->terms; a++)
        phi += t->row[a] * basis[a];
    t->spread += fabs(phi) * weight(t->s, j, r);
}

/* Gauss with the largest pivot of the column; the first unknown of every right hand side. False if it has no
   solution. */
static bool solve(sums *t, double value[SAMPLE_FIELDS])
{
    const uint32_t n = t->terms;
    const double whole = t->m[0][0];
    for (uint32_t c = 0; c < n; c++) {
        uint32_t p = c;
        for (uint32_t r = c + 1; r < n; r++)
            p = fabs(t->m[r][c]) > fabs(t->m[p][c]) ? r : p;
        if (!(fabs(t->m[p][c]) > 1e-6 * whole))
            return false;
        for (uint32_t k = 0; k < n; k++) {
            const double swap = t->m[c][k];
            t->m[c][k] = t->m[p][k];
            t->m[p][k] = swap;
        }
        for (uint32_t f = 0; f <= t->s->fields; f++) {
            const double swap = t->rhs[f][c];
            t->rhs[f][c] = t->rhs[f][p];
            t->rhs[f][p] = swap;
        }
        for (uint32_t r = 0; r < n; r++) { /* above too: what is left is diagonal */
            const double by = t->m[r][c] / t->m[c][c];
            if (r == c)
                continue;
            for (uint32_t k = c; k < n; k++)
                t->m[r][k] -= by * t->m[c][k];
            for (uint32_t f = 0; f <= t->s->fields; f++)
                t->rhs[f][r] -= by * t->rhs[f][c];
        }
    }
    for (uint32_t f = 0; f < t->s->fields; f++)
        value[f] = t->rhs[f][0] / t->m[0][0];
    for (uint32_t a = 0; a < n; a++) /* the matrix is symmetric: first column of the inverse */
        t->row[a] = t->rhs[t->s->fields][a] / t->m[a][a];
    return true;
}

uint32_t sample_at(const sampler *s, const double x[3], double value[SAMPLE_FIELDS], uint32_t *order)
{
    sums t;
    memset(&t, 0, sizeof t);
    t.s = s;
    t.nearest = HUGE_VAL;
    t.terms = s->order ? s->g->dim + 1 : 1;
    near_each(s->g, x, add, &t);
    memset(value, 0, SAMPLE_FIELDS * sizeof *value);
    *order = 0;
    if (!t.n)
        return 0;
    double mean[SAMPLE_FIELDS];
    for (uint32_t f = 0; f < s->fields; f++)
        mean[f] = t.rhs[f][0] / t.m[0][0];
    const uint32_t dim = s->g->dim;
    t.rhs[s->fields][0] = 1;
    if (s->order && t.n > dim + (dim > 1) && t.nearest <= sqrt(dim) && solve(&t, value))
        near_each(s->g, x, add_spread, &t);
    if (t.spread > 0 && t.spread <= MOST_SPREAD(dim))
        *order = 1;
    else
        memcpy(value, mean, s->fields * sizeof *value);
    return t.n;
}
