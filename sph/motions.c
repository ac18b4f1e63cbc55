/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* motions.c: motions of walls and held sets that are given by few numbers: rows of velocities, and a cubic spline
   through rows of places.

   Between rows of a programme the velocity is linear, so with D = t1 - t0, s = (t - t0)/D

     v = v0 + s (v1 - v0),   x = x0 + D (s v0 + s^2 (v1 - v0)/2),   x0 the sum of the rows before, D (v0 + v1)/2 each

   The spline has x'' linear between rows, M0 to M1, and x' = 0 at both ends, so that it goes on into rest:

     x = x0 (1 - s) + x1 s - D^2/6 ((1 - s)(1 - (1 - s)^2) M0 + s (1 - s^2) M1)

   with M from x' continuous at the rows, a system of three diagonals. */
#include "internal.h"
#include "arithmetic.h"

SPH_OBJECT(motions)

#if SPH_HAS_GROUPS

void sph_motion_programme(void *ctx, double t, double *displacement, double *velocity)
{
    const sph_programme *m = ctx;
    double x = 0;
    for (int k = 0; k < SPH_DIM; k++)
        displacement[k] = velocity[k] = 0;
    if (!m || !m->rows || !m->t || !m->v || m->axis >= SPH_DIM || !(t > m->t[0]))
        return;
    uint32_t i = 0;
    for (; i + 1 < m->rows && m->t[i + 1] <= t; i++)
        x += 0.5 * (m->t[i + 1] - m->t[i]) * (m->v[i] + m->v[i + 1]);
    const double after = t - m->t[i];
    const bool last = i + 1 == m->rows; /* it goes on as it went */
    const double rise = last ? 0 : (m->v[i + 1] - m->v[i]) * (after / (m->t[i + 1] - m->t[i]));
    displacement[m->axis] = x + after * (m->v[i] + 0.5 * rise);
    velocity[m->axis] = m->v[i] + rise;
}

/* six times the difference of the chords' slopes at row i: what the diagonals give there */
static double bend_wanted(const sph_spline *m, uint32_t i)
{
    const double before = i ? (m->x[i] - m->x[i - 1]) / (m->t[i] - m->t[i - 1]) : 0;
    const double behind = i + 1 < m->rows ? (m->x[i + 1] - m->x[i]) / (m->t[i + 1] - m->t[i]) : 0;
    return 6 * (behind - before);
}

bool sph_spline_make(const sph_spline *m, double *bend)
{
    if (!m || !bend || !m->t || !m->x || m->rows < 2)
        return false;
    for (uint32_t i = 0; i < m->rows; i++)
        if (!(sph_abs(m->t[i]) < 1e15) || !(sph_abs(m->x[i]) < 1e15) || (i && !(m->t[i] > m->t[i - 1])))
            return false;
    double *const over = bend + m->rows; /* what is left of the upper diagonal */
    for (uint32_t i = 0; i < m->rows; i++) {
        const double low = i ? m->t[i] - m->t[i - 1] : 0, up = i + 1 < m->rows ? m->t[i + 1] - m->t[i] : 0;
        const double diagonal = 2 * (low + up) - (i ? low * over[i - 1] : 0);
        over[i] = up / diagonal;
        bend[i] = (bend_wanted(m, i) - (i ? low * bend[i - 1] : 0)) / diagonal;
    }
    for (uint32_t i = m->rows - 1; i-- > 0;)
        bend[i] -= over[i] * bend[i + 1];
    return true;
}

void sph_motion_spline(void *ctx, double t, double *displacement, double *velocity)
{
    const sph_spline *m = ctx;
    for (int k = 0; k < SPH_DIM; k++)
        displacement[k] = velocity[k] = 0;
    if (!m || m->rows < 2 || !m->t || !m->x || !m->bend || m->axis >= SPH_DIM || !(t > m->t[0]))
        return;
    const uint32_t last = m->rows - 1;
    uint32_t i = 0;
    if (t >= m->t[last]) {
        displacement[m->axis] = m->x[last] - m->x[0];
        return;
    }
    while (m->t[i + 1] <= t)
        i++;
    const double d = m->t[i + 1] - m->t[i], s = (t - m->t[i]) / d, r = 1 - s, a = m->bend[i], b = m->bend[i + 1];
    displacement[m->axis] = r * m->x[i] + s * m->x[i + 1] - m->x[0] -
                            d * d / 6 * (r * (1 - r * r) * a + s * (1 - s * s) * b);
    velocity[m->axis] = (m->x[i + 1] - m->x[i]) / d - d / 6 * ((3 * r * r - 1) * a - (3 * s * s - 1) * b);
}

#endif
