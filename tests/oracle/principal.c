/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* principal.c: principal values and axes of a symmetric tensor, by Jacobi's rotations until nothing is left beside the
   diagonal; the tensile part of a stress: sum over the principal stresses above 0 of sigma n (x) n, or each component
   above 0 (Monaghan 2000). In 1-D and 2-D the artificial stress takes what lies in the plane. */
#include <string.h>

#include "oracle.h"

static void principal(const double (*m)[3], double *value, double (*axis)[3]) /* axis[k]: of value k */
{
    double a[3][3];
    memcpy(a, m, sizeof a);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            axis[k][l] = k == l;
    for (int turn = 0; turn < 60; turn++)
        for (int p = 0; p < 3; p++)
            for (int q = p + 1; q < 3; q++) {
                if (!(fabs(a[p][q]) > 0))
                    continue;
                const double angle = 0.5 * atan2(2 * a[p][q], a[p][p] - a[q][q]), c = cos(angle), s = sin(angle);
                for (int k = 0; k < 3; k++) { /* rows, then columns, then axes */
                    const double x = a[p][k], y = a[q][k];
                    a[p][k] = c * x + s * y;
                    a[q][k] = c * y - s * x;
                }
                for (int k = 0; k < 3; k++) {
                    const double x = a[k][p], y = a[k][q], e = axis[p][k], f = axis[q][k];
                    a[k][p] = c * x + s * y;
                    a[k][q] = c * y - s * x;
                    axis[p][k] = c * e + s * f;
                    axis[q][k] = c * f - s * e;
                }
            }
    for (int k = 0; k < 3; k++)
        value[k] = a[k][k];
}

void o_tensile_part(o_scene *s, const double (*sigma)[3], bool by_axes, double (*r)[3])
{
    double flat[3][3] = {{0}}, value[3], axis[3][3];
    (void)s;
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            flat[k][l] = sigma[k][l];
    principal((const double(*)[3])flat, value, axis);
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            r[k][l] = by_axes ? 0 : o_max(flat[k][l], 0);
            for (int n = 0; by_axes && n < 3; n++)
                r[k][l] += o_max(value[n], 0) * axis[n][k] * axis[n][l];
        }
}

double o_largest_principal(const double (*sigma)[3], bool plane)
{
    double value[3], axis[3][3];
    (void)plane;
    principal(sigma, value, axis);
    return o_max(value[0], o_max(value[1], value[2]));
}
