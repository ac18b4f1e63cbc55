/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* interpolation.c: what sums over particles make of simple fields, for every smoothing kernel (studies W1 and P1).
   Prints rows case,kernel,h,figure,value; h in spacings. Compiled for 1-D and 2-D, double.

   W1 (Wickramarachchi 2009, figure 2.4): unit spacing, far from any edge, the particle in the middle:
     one        | sum V W - 1 |                                     his 2.13
     grad_x     | sum V (x_j - x_i) dW/dx - 1 |                     his 2.15 to 2.17; what Bonet & Lok's correction
                makes 0
     ..._jitter the same as root mean squares over 400 particles moved by at most 0.2 of a spacing on each axis (2-D)
     grad_1_jitter         h times the rms of | sum V grad W |, which is 0 for an exact sum
     grad_square_corrected rms error of d(x^2)/dx over 2 h with corrected gradients, the first field that they do not
     get right
     neighbours the pairs that one sum looks at, which is its cost
   P1 (Powell 2012, figures 1.2 and 1.3): x^3 and its derivative from seven particles at 0 .. 6, h 2 unless h says
   otherwise: rms error over the particles as a share of the rms of the exact values:
     cube, cube_shepard                           sum V f W; divided by sum V W                        (his 1.14)
     slope, slope_zero, slope_corrected           sum V f dW; sum V (f_j - f_i) dW (1.15); divided by sum V (x_j - x_i)
                                                  dW
     slope_shepard                                gradient of the Shepard-normalised sum               (3.61)
     edge_...                                     the same at the particle on the edge alone */
#include <math.h>
#include <stdio.h>

#include "../../sph/dmath.h"
#include "../../sph/sph.h"

static const char *const names[] = {"cubic", "quartic", "quintic", "gaussian", "wendland_c2", "wendland_c4", "hat"};
#define KERNELS (sizeof names / sizeof *names)
#define SIDE 20 /* particles that are looked at; a lattice of 60 surrounds them */

static void row(const char *study, uint32_t kernel, double h, const char *figure, double value)
{
    printf("%s,%s,%.2f,%s,%.6g\n", study, names[kernel], h, figure, fabs(value) < 1e-14 ? 0 : value);
}

#if SPH_DIM == 1
static void edge(uint32_t kernel, double h, const char *study)
{
    enum { CUBE, SHEPARD, SLOPE, ZERO, CORRECTED, NORMALISED, FIGURES };
    static const char *const figure[FIGURES] = {"cube", "cube_shepard", "slope", "slope_zero", "slope_corrected",
                                                "slope_shepard"};
    double off[FIGURES] = {0}, size[FIGURES] = {0}, at_edge[FIGURES] = {0};
    for (int i = 0; i < 7; i++) {
        double s0 = 0, sf = 0, g0 = 0, gf = 0, gx = 0, x = i;
        for (int j = 0; j < 7; j++) {
            double w, dw, y = j;
            sph_kernel_value(kernel, fabs(x - y), h, &w, &dw);
            const double g = x > y ? dw : x < y ? -dw : 0; /* dW/dx_i */
            s0 += w;
            sf += w * y * y * y;
            g0 += g;
            gf += g * y * y * y;
            gx += g * (y - x);
        }
        const double f = x * x * x, df = 3 * x * x;
        const double value[FIGURES] = {sf, sf / s0, gf, gf - f * g0, gx != 0 ? (gf - f * g0) / gx : 0,
                                       (gf - sf / s0 * g0) / s0};
        for (int k = 0; k < FIGURES; k++) {
            const double exact = k < SLOPE ? f : df, e = value[k] - exact;
            off[k] += e * e;
            size[k] += exact * exact;
            at_edge[k] = i == 6 ? fabs(e) / exact : 0;
        }
    }
    for (int k = 0; k < FIGURES; k++) {
        char name[40];
        row(study, kernel, h, figure[k], sqrt(off[k] / size[k]));
        snprintf(name, sizeof name, "edge_%s", figure[k]);
        row(study, kernel, h, name, at_edge[k]);
    }
}
#endif

#if SPH_DIM == 2
/* sums around particle i, j of a square lattice that is moved by `jitter` of a spacing */
static void place(int i, int j, double jitter, double *x)
{
    sph_rng rng;
    sph_rng_seed(&rng, (uint64_t)((i + 100) * 1000 + j + 100), 7);
    x[0] = i + jitter * (2 * sph_rng_uniform(&rng) - 1);
    x[1] = j + jitter * (2 * sph_rng_uniform(&rng) - 1);
}

typedef struct sums {
    /* square: sum V ((x_j - x_i)^2 + 2 x_i (x_j - x_i)) grad W, the x^2 difference */
    double one, g[2], m[2][2], square[2];
    int neighbours;
} sums;

static sums around(uint32_t kernel, double h, int i, int j, double jitter)
{
    const int reach = (int)(sph_kernel_support(kernel) * h) + 2;
    double x[2], y[2], w, dw;
    sums s = {0};
    place(i, j, jitter, x);
    for (int a = i - reach; a <= i + reach; a++)
        for (int b = j - reach; b <= j + reach; b++) {
            place(a, b, jitter, y);
            const double d[2] = {y[0] - x[0], y[1] - x[1]}, r = sqrt(d[0] * d[0] + d[1] * d[1]);
            if (r >= sph_kernel_support(kernel) * h)
                continue;
            sph_kernel_value(kernel, r, h, &w, &dw);
            s.neighbours += r > 0;
            s.one += w;
            for (int k = 0; k < 2 && r > 0; k++) {
                const double g = -dw * d[k] / r; /* dW/dx_i, as W falls with distance */
                s.g[k] += g;
                s.square[k] += d[0] * d[0] * g;
                for (int l = 0; l < 2; l++)
                    s.m[k][l] += g * d[l];
            }
        }
    return s;
}

static void lattice(uint32_t kernel, double h)
{
    const sums s = around(kernel, h, 0, 0, 0);
    double one = 0, grad_x = 0, grad_1 = 0, square = 0;
    row("W1", kernel, h, "one", fabs(s.one - 1));
    row("W1", kernel, h, "grad_x", fabs(s.m[0][0] - 1));
    row("W1", kernel, h, "neighbours", s.neighbours);
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) {
            const sums t = around(kernel, h, i, j, 0.2);
            const double det = t.m[0][0] * t.m[1][1] - t.m[0][1] * t.m[1][0];
            /* what is left of d(x^2)/dx - 2 x_i */
            const double c = (t.m[1][1] * t.square[0] - t.m[0][1] * t.square[1]) / det;
            one += (t.one - 1) * (t.one - 1);
            grad_x += (t.m[0][0] - 1) * (t.m[0][0] - 1);
            grad_1 += h * h * (t.g[0] * t.g[0] + t.g[1] * t.g[1]);
            square += c * c / (4 * h * h);
        }
    const double n = SIDE * SIDE;
    row("W1", kernel, h, "one_jitter", sqrt(one / n));
    row("W1", kernel, h, "grad_x_jitter", sqrt(grad_x / n));
    row("W1", kernel, h, "grad_1_jitter", sqrt(grad_1 / n));
    row("W1", kernel, h, "grad_square_corrected", sqrt(square / n));
}
#endif

int main(void)
{
    for (uint32_t k = 0; k < KERNELS; k++) {
#if SPH_DIM == 1
        for (int i = 0; i <= 20; i++)
            edge(k, 1 + 0.1 * i, "P1");
#else
        for (int i = 0; i <= 44; i++)
            lattice(k, 0.8 + 0.05 * i);
#endif
    }
    return 0;
}
