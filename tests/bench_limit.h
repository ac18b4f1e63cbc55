/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bench_limit.h: what a force sweep is measured by: the pairs and formulas of the set-up of bench_setups.h (Wendland
   C2, standard pressure and continuity, artificial viscosity) with the neighbours of each fluid particle in lists made
   beforehand, and nothing else: no finding of neighbours, no velocities of walls, no limits of a step. Neighbours are
   taken eight at a time from records; a list ends with copies of a record that is far away. */
#ifndef SPH_BENCH_LIMIT_H
#define SPH_BENCH_LIMIT_H

#include <math.h>

#include "bench_setups.h"

#define LIMIT_LANES 8
#define LIMIT_ROOM 256u /* neighbours of a particle, at most */

typedef sph_real limit_record[2 * SPH_DIM + 3]; /* x, v, m, rho, p/rho^2 */
enum { LIMIT_M = 2 * SPH_DIM, LIMIT_RHO, LIMIT_PRESS };

typedef struct limit_loop {
    limit_record *of; /* `all` particles and one far away */
    uint32_t fluid, all;
    uint32_t *first, *list; /* neighbours of fluid particle i: list[first[i]] .. list[first[i + 1] - 1] */
    sph_real inv_h, eta, alpha, sum;
} limit_loop;

static void *limit_room(size_t n, size_t bytes)
{
    void *const p = calloc(n, bytes);
    check(NULL, p ? SPH_OK : SPH_ARENA_TOO_SMALL, "memory of the limit loop");
    return p;
}

/* records of a tank's particles, fluid first */
static void limit_records(limit_loop *l, const tank *t)
{
    uint32_t at = 0;
    for (int walls = 0; walls < 2; walls++) {
        for (uint32_t i = 0; i < l->all; i++) {
            sph_particle p;
            check(t->sim, sph_get(t->sim, i, &p), "get");
            if ((p.role != SPH_ROLE_FLUID) != walls)
                continue;
            for (int k = 0; k < SPH_DIM; k++) {
                l->of[at][k] = (sph_real)p.x[k];
                l->of[at][SPH_DIM + k] = (sph_real)p.v[k];
            }
            l->of[at][LIMIT_M] = (sph_real)p.mass;
            l->of[at][LIMIT_RHO] = (sph_real)p.rho;
            l->of[at++][LIMIT_PRESS] = (sph_real)(p.p / (p.rho * p.rho));
        }
        l->fluid = walls ? l->fluid : at;
    }
    for (int k = 0; k < SPH_DIM; k++)
        l->of[l->all][k] = (sph_real)1e6;
    l->of[l->all][LIMIT_RHO] = 1;
}

static uint32_t limit_cell(const limit_record r, double reach, uint32_t row, const int *off)
{
    uint32_t c = 0;
    for (int k = SPH_DIM - 1; k >= 0; k--)
        c = c * row + (uint32_t)(floor(((double)r[k] + 1) / reach) + off[k]);
    return c;
}

/* lists, through cells as wide as the kernel reaches (chains: head of a cell, next of a particle) */
static void limit_lists(limit_loop *l, double reach)
{
    const uint32_t row = (uint32_t)(4 / reach) + 4, cells = row * row * (SPH_DIM == 3 ? row : 1);
    uint32_t *const head = limit_room(cells, sizeof *head), *const next = limit_room(l->all + 1, sizeof *next), n = 0;
    for (uint32_t i = l->all; i-- > 0;) {
        const uint32_t c = limit_cell(l->of[i], reach, row, (const int[3]){0, 0, 0});
        next[i] = head[c];
        head[c] = i + 1;
    }
    for (uint32_t i = 0; i < l->fluid; i++) {
        l->first[i] = n;
        for (int q = 0; q < (SPH_DIM == 3 ? 27 : 9); q++) {
            const int off[3] = {q % 3 - 1, q / 3 % 3 - 1, SPH_DIM == 3 ? q / 9 - 1 : 0};
            for (uint32_t j = head[limit_cell(l->of[i], reach, row, off)]; j; j = next[j - 1]) {
                double r2 = 0;
                for (int k = 0; k < SPH_DIM; k++)
                    r2 += pow((double)(l->of[i][k] - l->of[j - 1][k]), 2);
                if (r2 < reach * reach)
                    l->list[n++] = j - 1;
            }
        }
        while ((n - l->first[i]) % LIMIT_LANES)
            l->list[n++] = l->all;
        check(NULL, n - l->first[i] <= LIMIT_ROOM ? SPH_OK : SPH_TOO_MANY_PARTICLES, "list of the limit loop");
    }
    l->first[l->fluid] = n;
    free(head);
    free(next);
}

/* of a tank whose block is n particles wide */
static limit_loop limit_of(const tank *t, uint32_t n)
{
    const double h = 1.2 / n;
    limit_loop l = {.all = sph_count(t->sim), .inv_h = (sph_real)(1 / h), .eta = (sph_real)(0.01 * h * h),
                    .alpha = (sph_real)(2 * h * 0.01 * 45)};
    l.of = limit_room(l.all + 1, sizeof *l.of);
    l.first = limit_room(l.all + 1, sizeof *l.first);
    l.list = limit_room((size_t)l.all * (SPH_DIM == 3 ? 96 : 32), sizeof *l.list);
    limit_records(&l, t);
    limit_lists(&l, 2 * h);
    return l;
}
static void limit_free(const limit_loop *l)
{
    free(l->of);
    free(l->first);
    free(l->list);
}

/* eight pairs of a home i: adds to a (acceleration, rate) what each gives */
static inline __attribute__((always_inline)) void limit_pairs(const limit_loop *l, const sph_real *i,
                                                              const uint32_t *list,
                                                              sph_real a[SPH_DIM + 1][LIMIT_LANES])
{
    sph_real near[2 * SPH_DIM + 3][LIMIT_LANES];
    for (int n = 0; n < LIMIT_LANES; n++)
        for (int k = 0; k < 2 * SPH_DIM + 3; k++)
            near[k][n] = l->of[list[n]][k];
    for (int n = 0; n < LIMIT_LANES; n++) {
        sph_real d[SPH_DIM], r2 = 0, vr = 0;
        for (int k = 0; k < SPH_DIM; k++) {
            d[k] = i[k] - near[k][n];
            r2 += d[k] * d[k];
            vr += d[k] * (i[SPH_DIM + k] - near[SPH_DIM + k][n]);
        }
        const sph_real q = (SPH_DOUBLE ? (sph_real)sqrt((double)r2) : (sph_real)sqrtf((float)r2)) * l->inv_h;
        const sph_real s = 1 - q * (sph_real)0.5, in = s < 0 ? 0 : s, mg = -5 * (in * in * in) * near[LIMIT_M][n];
        const sph_real mu = vr / ((r2 + l->eta) * (i[LIMIT_RHO] + near[LIMIT_RHO][n]));
        const sph_real f = (i[LIMIT_PRESS] + near[LIMIT_PRESS][n] - l->alpha * mu) * mg;
        for (int k = 0; k < SPH_DIM; k++)
            a[k][n] += f * d[k];
        a[SPH_DIM][n] += mg * vr;
    }
}

/* all fluid particles once; what is made is added up, so that nothing is left out */
static void limit_run(limit_loop *l)
{
    for (uint32_t i = 0; i < l->fluid; i++) {
        sph_real a[SPH_DIM + 1][LIMIT_LANES] = {{0}};
        for (uint32_t j = l->first[i]; j < l->first[i + 1]; j += LIMIT_LANES)
            limit_pairs(l, l->of[i], l->list + j, a);
        for (int k = 0; k <= SPH_DIM; k++)
            for (int n = 0; n < LIMIT_LANES; n++)
                l->sum += a[k][n];
    }
}

#endif
