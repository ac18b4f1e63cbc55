/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fe_beam.c: natural periods of a beam of length L and height H, linear plane strain, rho = K = 1, whose faces x = 0 and,
   with `both`, x = L are clamped (u = v = 0): how fe_beam_periods.csv was made. Finite elements of order 4 (nodes of
   Gauss and Lobatto, consistent mass), elements that halve towards the corners of the clamps, inverse iteration. Both
   ends: half the beam, u = 0 at its middle.
     cc -O2 fe_beam.c -o fe_beam -lm && ./fe_beam
   Prints a line for each beam: the period, and that of a mesh graded less by a factor of 8. Checked with T_A of
   fe_plate_periods.csv, which has another author's code behind it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { P = 4, NODES = P + 1, GAUSS = 6, MOST = 64 };
static const double node[NODES] = {-1, -0.65465367070797714, 0, 0.65465367070797714, 1};
static const double gauss_at[GAUSS] = {-0.93246951420315203, -0.66120938646626451, -0.23861918608319691,
                                       0.23861918608319691, 0.66120938646626451, 0.93246951420315203};
static const double gauss_w[GAUSS] = {0.17132449237917036, 0.36076157304813861, 0.46791393457269104,
                                      0.46791393457269104, 0.36076157304813861, 0.17132449237917036};

static double shape(int i, double x)
{
    double f = 1;
    for (int k = 0; k < NODES; k++)
        f *= k == i ? 1 : (x - node[k]) / (node[i] - node[k]);
    return f;
}
static double slope(int i, double x)
{
    double sum = 0;
    for (int m = 0; m < NODES; m++) {
        double f = m == i ? 0 : 1 / (node[i] - node[m]);
        for (int k = 0; k < NODES && m != i; k++)
            f *= k == i || k == m ? 1 : (x - node[k]) / (node[i] - node[k]);
        sum += f;
    }
    return sum;
}

/* edges of elements from 0 to `length`: they halve `halvings` times towards 0 from `size`; the same towards the other end
   with `both` */
static int edges(double length, double size, int halvings, int both, double *x)
{
    double e[MOST];
    int n = 0;
    const double end = both ? length / 2 : length;
    e[n++] = 0;
    for (int k = halvings; k >= 0; k--)
        e[n++] = size / (1 << k);
    const int more = (int)((end - size) / size + 0.999);
    for (int k = 1; k <= more; k++)
        e[n++] = size + (end - size) * k / more;
    memcpy(x, e, sizeof e);
    for (int k = 1; k < n && both; k++)
        x[n - 1 + k] = length - e[n - 1 - k];
    return both ? 2 * (n - 1) : n - 1;
}

static int band;
static double *stiff, *mass; /* rows of the lower triangle: column j of row i at i * (band + 1) + j - i + band */
static void add(double *m, int i, int j, double v)
{
    if (j <= i)
        m[(size_t)i * (size_t)(band + 1) + (size_t)(j - i + band)] += v;
}

/* an element of edges dx, dy; at: its degrees of freedom, u v of each node, -1: held */
static void add_element(double dx, double dy, double lambda, double mu, const int *at)
{
    for (int p = 0; p < GAUSS; p++)
        for (int q = 0; q < GAUSS; q++) {
            const double w = gauss_w[p] * gauss_w[q] * dx * dy / 4;
            double f[NODES * NODES], fx[NODES * NODES], fy[NODES * NODES];
            for (int i = 0; i < NODES; i++)
                for (int j = 0; j < NODES; j++) {
                    f[i * NODES + j] = shape(i, gauss_at[p]) * shape(j, gauss_at[q]);
                    fx[i * NODES + j] = slope(i, gauss_at[p]) * shape(j, gauss_at[q]) * 2 / dx;
                    fy[i * NODES + j] = shape(i, gauss_at[p]) * slope(j, gauss_at[q]) * 2 / dy;
                }
            for (int a = 0; a < NODES * NODES; a++)
                for (int b = 0; b < NODES * NODES; b++) {
                    const double xx = w * fx[a] * fx[b], yy = w * fy[a] * fy[b], m = w * f[a] * f[b];
                    const double xy = w * fx[a] * fy[b], yx = w * fy[a] * fx[b];
                    const double k[2][2] = {{(lambda + 2 * mu) * xx + mu * yy, lambda * xy + mu * yx},
                                            {lambda * yx + mu * xy, (lambda + 2 * mu) * yy + mu * xx}};
                    for (int c = 0; c < 4; c++)
                        if (at[2 * a + c / 2] >= 0 && at[2 * b + c % 2] >= 0) {
                            add(stiff, at[2 * a + c / 2], at[2 * b + c % 2], k[c / 2][c % 2]);
                            if (c / 2 == c % 2)
                                add(mass, at[2 * a + c / 2], at[2 * b + c % 2], m);
                        }
                }
        }
}

static void factor(int n)
{
    for (int i = 0; i < n; i++)
        for (int j = i > band ? i - band : 0; j <= i; j++) {
            double *const a = &stiff[(size_t)i * (size_t)(band + 1) + (size_t)(j - i + band)], sum = *a;
            const double *const r = &stiff[(size_t)i * (size_t)(band + 1) + (size_t)(band - i)];
            const double *const s = &stiff[(size_t)j * (size_t)(band + 1) + (size_t)(band - j)];
            for (int k = i > band ? i - band : 0; k < j; k++)
                sum -= k >= j - band ? r[k] * s[k] : 0;
            *a = i == j ? sqrt(sum) : sum / s[j];
        }
}
static void solve(int n, double *x)
{
    for (int i = 0; i < n; i++) {
        const double *const r = &stiff[(size_t)i * (size_t)(band + 1) + (size_t)(band - i)];
        for (int k = i > band ? i - band : 0; k < i; k++)
            x[i] -= r[k] * x[k];
        x[i] /= r[i];
    }
    for (int i = n - 1; i >= 0; i--) {
        const double *const r = &stiff[(size_t)i * (size_t)(band + 1) + (size_t)(band - i)];
        x[i] /= r[i];
        for (int k = i > band ? i - band : 0; k < i; k++)
            x[k] -= r[k] * x[i];
    }
}
static void times_mass(int n, const double *x, double *y)
{
    memset(y, 0, (size_t)n * sizeof *y);
    for (int i = 0; i < n; i++) {
        const double *const r = &mass[(size_t)i * (size_t)(band + 1) + (size_t)(band - i)];
        for (int k = i > band ? i - band : 0; k <= i; k++) {
            y[i] += r[k] * x[k];
            y[k] += k < i ? r[k] * x[i] : 0;
        }
    }
}

static double period(double length, double height, double mu, int both, int halvings)
{
    double x[2 * MOST], y[2 * MOST], omega2 = 0;
    const int nx = edges(both ? length / 2 : length, height / 2, halvings, 0, x);
    const int ny = edges(height, height / 4, halvings - 1, 1, y), rows = ny * P + 1, all = (nx * P + 1) * rows;
    int *const number = malloc((size_t)all * 2 * sizeof *number), n = 0;
    for (int k = 0; k < 2 * all; k++) {
        const int column = k / 2 / rows, held = column == 0 || (both && column == nx * P && k % 2 == 0);
        number[k] = held ? -1 : n++;
    }
    band = 2 * (P * rows + P) + 1;
    stiff = calloc((size_t)n * (size_t)(band + 1), sizeof *stiff);
    mass = calloc((size_t)n * (size_t)(band + 1), sizeof *mass);
    for (int i = 0; i < nx; i++)
        for (int j = 0; j < ny; j++) {
            int at[2 * NODES * NODES];
            for (int a = 0; a < NODES; a++)
                for (int b = 0; b < NODES; b++)
                    for (int c = 0; c < 2; c++)
                        at[2 * (a * NODES + b) + c] = number[2 * ((i * P + a) * rows + j * P + b) + c];
            add_element(x[i + 1] - x[i], y[j + 1] - y[j], 1 - 2 * mu / 3, mu, at);
        }
    factor(n);
    double *const v = malloc((size_t)n * sizeof *v), *const w = malloc((size_t)n * sizeof *w);
    for (int k = 0; k < n; k++)
        v[k] = 1 + k % 2;
    for (int turn = 0; turn < 60; turn++) {
        double with = 0, own = 0;
        times_mass(n, v, w);
        memcpy(v, w, (size_t)n * sizeof *v);
        solve(n, v);
        for (int k = 0; k < n; k++)
            with += v[k] * w[k];
        times_mass(n, v, w);
        for (int k = 0; k < n; k++)
            own += v[k] * w[k];
        omega2 = with / own;
        for (int k = 0; k < n; k++)
            v[k] /= sqrt(own);
    }
    free(number), free(stiff), free(mass), free(v), free(w);
    return 2 * 3.14159265358979323846 / sqrt(omega2);
}

int main(void)
{
    static const double mus[] = {0.22, 0.3, 0.6};
    printf("ends,mu,H,L,T,T_coarser\n");
    for (int both = 0; both < 2; both++)
        for (int k = 0; k < 3; k++)
            for (int h = 1; h <= 2; h++)
                printf("%s,%g,%d,20,%.6g,%.6g\n", both ? "both" : "one", mus[k], h, period(20, h, mus[k], both, 9),
                       period(20, h, mus[k], both, 6));
    return 0;
}
