/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* sample.c: values at any place (see sample.h). With q = r/reach and weights w = V (1 - q)^4 (1 + 4 q):
     order 0  sum w f / sum w                                            (Shepard 1968): exact for constants
     order 1  the value at 0 of the polynomial a + b.d that makes sum w (a + b.d - f)^2 least (Lancaster and Salkauskas
              1981): exact for linear fields, also beside a free surface, where order 0 is one-sided. */
#include "sample.h"

#include <math.h>
#include <string.h>

typedef struct sums {
    const sampler *s;
    uint32_t n, terms;                     /* terms of the polynomial */
    double m[4][4], rhs[SAMPLE_FIELDS][4]; /* in d/reach */
} sums;

static void add(void *ctx, uint32_t j, const double d[3], double r)
{
    sums *t = ctx;
    const double reach = t->s->g->reach, q = r / reach, u = 1 - q, w = t->s->volume[j] * u * u * u * u * (1 + 4 * q);
    const double basis[4] = {1, d[0] / reach, d[1] / reach, d[2] / reach};
    if (!(w > 0))
        return;
    t->n++;
    for (uint32_t a = 0; a < t->terms; a++) {
        for (uint32_t b = 0; b < t->terms; b++)
            t->m[a][b] += w * basis[a] * basis[b];
        for (uint32_t f = 0; f < t->s->fields; f++)
            t->rhs[f][a] += w * basis[a] * t->s->field[f][j];
    }
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
        for (uint32_t f = 0; f < t->s->fields; f++) {
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
            for (uint32_t f = 0; f < t->s->fields; f++)
                t->rhs[f][r] -= by * t->rhs[f][c];
        }
    }
    for (uint32_t f = 0; f < t->s->fields; f++)
        value[f] = t->rhs[f][0] / t->m[0][0];
    return true;
}

uint32_t sample_at(const sampler *s, const double x[3], double value[SAMPLE_FIELDS], uint32_t *order)
{
    sums t;
    memset(&t, 0, sizeof t);
    t.s = s;
    t.terms = s->order ? s->g->dim + 1 : 1;
    near_each(s->g, x, add, &t);
    memset(value, 0, SAMPLE_FIELDS * sizeof *value);
    *order = 0;
    if (!t.n)
        return 0;
    double mean[SAMPLE_FIELDS];
    for (uint32_t f = 0; f < s->fields; f++)
        mean[f] = t.rhs[f][0] / t.m[0][0];
    if (s->order && t.n > s->g->dim && solve(&t, value))
        *order = 1;
    else
        memcpy(value, mean, s->fields * sizeof *value);
    return t.n;
}
