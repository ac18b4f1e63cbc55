/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_kernels.c: every smoothing kernel in this dimension: its integral, its derivative, its support, its sign, and
   the arguments that sph_kernel_value refuses. */
#include "testing.h"

#define PI 3.14159265358979323846

/* h = 0.7 so that a missing power of h shows */
static const double H = 0.7;

static double value_at(uint32_t kernel, double r, double *slope)
{
    double w = -1, dw = -1;
    assert_int_equal(sph_kernel_value(kernel, r, H, &w, &dw), SPH_OK);
    if (slope)
        *slope = dw;
    return w;
}

/* area of the unit sphere's shell: 2, 2 pi r, 4 pi r^2 */
static double shell(double r) { return SPH_DIM == 1 ? 2 : SPH_DIM == 2 ? 2 * PI * r : 4 * PI * r * r; }

static double simpson(uint32_t kernel, bool slope)
{
    /* the break points of the splines (multiples of h/2) are nodes, so Simpson's rule sees smooth pieces */
    const double end = sph_kernel_support(kernel) * H;
    const int n = 6000;
    double sum = 0;
    for (int i = 0; i <= n; i++) {
        double r = end * i / n, dw, w = value_at(kernel, i == n ? end * (1 - 1e-7) : r, &dw);
        /* integral of r/DIM dW/dr over the volume is -1 by parts: what makes the gradient of a linear field exact */
        sum += (slope ? -dw * r / SPH_DIM : w) * shell(r) * (i == 0 || i == n ? 1 : i % 2 ? 4 : 2);
    }
    return sum * end / n / 3;
}

static void the_integral_is_one(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < SPH_KERNELS; k++)
        close_to(simpson(k, false), 1, SPH_DOUBLE ? 1e-10 : 2e-6);
}

static void the_first_moment_of_the_slope_is_one(void **state)
{
    (void)state;
    /* the truncated Gaussian jumps to 0 at 3h: by parts the jump's shell times W(3h) is missing, known exactly */
    for (uint32_t k = 0; k < SPH_KERNELS; k++) {
        const double end = sph_kernel_support(k) * H;
        double jump = k == SPH_GAUSSIAN ? value_at(k, end * (1 - 1e-7), NULL) * shell(end) * end / SPH_DIM : 0;
        /* float: q at the end differs from 3 by rounding, and the hat's slope at 0 is not sampled well */
        close_to(simpson(k, true), 1 - jump, SPH_DOUBLE ? 1e-6 : 2e-5);
    }
}

static void the_slope_is_the_derivative(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < SPH_KERNELS; k++) {
        const double end = sph_kernel_support(k) * H, top = value_at(k, 0, NULL) / H;
        const double step = SPH_DOUBLE ? 1e-5 * H : 4e-3 * H;
        for (int i = 1; i < 200; i++) {
            double r = end * (i + 0.3) / 201, dw;
            double diff = (value_at(k, r + step, NULL) - value_at(k, r - step, NULL)) / (2 * step);
            value_at(k, r, &dw);
            close_to(dw, diff, (SPH_DOUBLE ? 2e-8 : 1e-3) * top * 8);
        }
    }
}

static void the_kernel_is_positive_and_falls(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < SPH_KERNELS; k++) {
        const double end = sph_kernel_support(k) * H;
        double before = value_at(k, 0, NULL), dw;
        assert_true(before > 0);
        for (int i = 1; i <= 500; i++) {
            double w = value_at(k, end * i / 500 * 0.999, &dw);
            /* truncated powers cancel near the end of the support: a rounding of the value there may be negative */
            assert_true(w >= -8 * EPS * value_at(k, 0, NULL));
            assert_true(w <= before + 8 * EPS * value_at(k, 0, NULL));
            assert_true(dw <= 64 * EPS * value_at(k, 0, NULL) / H);
            before = w;
        }
    }
}

static void the_support_is_where_it_says(void **state)
{
    static const double support[SPH_KERNELS] = {2, 2.5, 3, 3, 2, 2, 2};
    (void)state;
    for (uint32_t k = 0; k < SPH_KERNELS; k++) {
        double dw, end = support[k] * H;
        assert_true(sph_kernel_support(k) == support[k]);
        assert_true(value_at(k, end * (1 + 1e-6), &dw) == 0 && dw == 0);
        assert_true(value_at(k, 100 * end, &dw) == 0 && dw == 0);
        assert_true(value_at(k, 0.9 * end, &dw) > 0 && dw < 0);
    }
    assert_true(sph_kernel_support(SPH_KERNELS) == 0);
}

static void published_central_values_hold(void **state)
{
    /* W(0) h^DIM: cubic 2/3, 10/(7 pi), 1/pi (Monaghan & Lattanzio 1985); Wendland C2 of the family for the
       dimension */
    static const double cubic[3] = {2.0 / 3, 10 / (7 * PI), 1 / PI};
    static const double c2[3] = {5.0 / 8, 7 / (4 * PI), 21 / (16 * PI)};
    static const double quintic[3] = {66.0 / 120, 7 * 66 / (478 * PI), 66 / (120 * PI)};
    const double hd = pow(H, SPH_DIM);
    (void)state;
    close_to(value_at(SPH_CUBIC, 0, NULL) * hd, cubic[SPH_DIM - 1], 4 * EPS);
    close_to(value_at(SPH_WENDLAND_C2, 0, NULL) * hd, c2[SPH_DIM - 1], 4 * EPS);
    close_to(value_at(SPH_QUINTIC, 0, NULL) * hd, quintic[SPH_DIM - 1], 4 * EPS);
}

static void the_mean_gradient_is_zero(void **state)
{
    /* over a symmetric lattice the gradients of all neighbours cancel, pair by pair: what sums see at rest */
    (void)state;
    for (uint32_t k = 0; k < SPH_KERNELS; k++) {
        double sum[3] = {0, 0, 0}, size = 0;
        const int reach = 5;
        for (int c = SPH_DIM > 2 ? -reach : 0; c <= (SPH_DIM > 2 ? reach : 0); c++)
            for (int b = SPH_DIM > 1 ? -reach : 0; b <= (SPH_DIM > 1 ? reach : 0); b++)
                for (int a = -reach; a <= reach; a++) {
                    double x[3] = {a * H / 1.3, b * H / 1.3, c * H / 1.3}, dw;
                    double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
                    value_at(k, r, &dw);
                    for (int d = 0; d < 3 && r > 0; d++)
                        sum[d] += dw * x[d] / r;
                    size += fabs(dw);
                }
        assert_true(size > 0);
        for (int d = 0; d < 3; d++)
            close_to(sum[d], 0, 1e-14 * size);
    }
}

static void bad_arguments_are_refused(void **state)
{
    double w, dw;
    (void)state;
    assert_int_equal(sph_kernel_value(SPH_KERNELS, 0.1, 1, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, -0.1, 1, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, 0.1, 0, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, 0.1, -1, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, NAN, 1, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, 0.1, NAN, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, INFINITY, 1, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, 0.1, INFINITY, &w, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, 0.1, 1, NULL, &dw), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_kernel_value(0, 0.1, 1, &w, NULL), SPH_BAD_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(the_integral_is_one),
        subject(the_first_moment_of_the_slope_is_one),
        subject(the_slope_is_the_derivative),
        subject(the_kernel_is_positive_and_falls),
        subject(the_support_is_where_it_says),
        subject(published_central_values_hold),
        subject(the_mean_gradient_is_zero),
        subject(bad_arguments_are_refused),
    };
    return run_subjects("kernels", list);
}
