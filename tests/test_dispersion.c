/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_dispersion.c: the sums and waves of tools/dispersion.c against Gray's printed tables, closed forms, differences
   of the kernels, the exact equations for long waves, and the forces on a moved lattice written down a second time. */
#include "testing.h"

#include "tools/commands.h"
#include "tools/dispersion.h"
#include "tools/table.h"

#define PI 3.14159265358979323846

static const double along_x[2] = {PI, 0};

static double cell(const table *t, uint32_t row, const char *name)
{
    int c = table_column(t, name, strlen(name));
    if (c < 0)
        fail_msg("%s: no column %s", t->file, name);
    return table_at(t, row, (uint32_t)c);
}

/* The thesis cut digits off instead of rounding in B.3 and B.5, so a figure may be 1e-4 off. Its F columns
   are right where every neighbour that matters is within h, and give those between h and 2h up to 40 % too little: F is
   held against the columns that were recomputed. */
static void the_tables_are_those_printed(void **state)
{
    static const char *const files[LATTICES] = {"tests/refdata/gray_table_B3_square.csv",
                                                "tests/refdata/gray_table_B4_shifted_x.csv",
                                                "tests/refdata/gray_table_B5_shifted_y.csv"};
    double worst = 0, cut = 0;
    (void)state;
    for (uint32_t l = 0; l < LATTICES; l++) {
        table t;
        assert_true(table_open(&t, files[l]));
        assert_int_equal(t.rows, 11);
        for (uint32_t r = 0; r < t.rows; r++) {
            lattice_sums s;
            lattice_sum(SPH_CUBIC, l, cell(&t, r, "h_over_dp"), 4, along_x, &s);
            const double mine[] = {s.beta, s.a[0], s.a[1], s.b[0], s.b[1], s.b[2], s.f[0], s.f[1]};
            static const char *const name[] = {"beta", "Ax", "Ay", "Bxx", "Byy", "Bxy", "Fxx_full", "Fyy_full"};
            for (int k = 0; k < 8; k++) {
                close_to(mine[k], cell(&t, r, name[k]), 1.0e-4);
                worst = fmax(worst, fabs(mine[k] - cell(&t, r, name[k])));
            }
            cut = fmax(cut, fabs(s.f[0] - cell(&t, r, "Fxx_printed")));
            cut = fmax(cut, fabs(s.f[1] - cell(&t, r, "Fyy_printed")));
            close_to(s.f[2], 0, 1e-12);
        }
        table_close(&t);
    }
    print_message("dispersion: tables B.3 to B.5 within %.1e; printed F, low for neighbours beyond h, within %.1e\n",
                  worst,
                  cut);
}

/* Gray 5.72; his F counts the nearest neighbours, the diagonal ones add what stands behind the plus */
static void at_h_one_the_sums_have_closed_forms(void **state)
{
    const double q = 30 / (7 * PI), s2 = sqrt(2.0);
    lattice_sums s;
    (void)state;
    lattice_sum(SPH_CUBIC, LATTICE_SQUARE, 1, 4, along_x, &s);
    close_to(s.b[0], q * (10 - 5 * s2), 1e-13);
    close_to(s.b[1], q * (7 - 5 * s2), 1e-13);
    close_to(s.beta, 10 / (7 * PI) * (1 + 2 * pow(2 - s2, 3)), 1e-13);
    const double w = pow(2 - s2, 3);
    const double diagonal = w * w * w * (9 * 4 * pow(2 - s2, 4) + w * (6 * (2 - s2) - 3 * pow(2 - s2, 2) / s2));
    close_to(s.f[0], q * 14 + 8 * 5 / (14 * PI) * diagonal / 2, 1e-12);
    close_to(s.f[1], -q + 8 * 5 / (14 * PI) * diagonal / 2, 1e-12);
}

static void second_derivatives_are_those_of_the_kernels(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < SPH_KERNELS; k++)
        for (double q = 0.13; q < sph_kernel_support(k); q += 0.1) {
            double w, d[5];
            const double step = 1e-3;
            for (int i = 0; i < 5; i++)
                assert_int_equal(sph_kernel_value(k, q + (i - 2) * step, 1, &w, &d[i]), SPH_OK);
            close_to(kernel_second(k, q), (8 * (d[3] - d[1]) - (d[4] - d[0])) / (12 * step), 1e-9);
        }
}

static void long_waves_are_exact(void **state)
{
    (void)state;
    for (uint32_t l = 0; l < LATTICES; l++)
        for (double angle = 0; angle < 1.6; angle += 0.3) {
            elastic_state e = {.rho = 2, .c = 3, .mu = 5, .pressure = -0.3, .s = {0.4, -0.1}, .n = 4};
            const double k[2] = {1e-4 * cos(angle), 1e-4 * sin(angle)}, dp = 0.1, real[2] = {k[0] / dp, k[1] / dp};
            wave_modes m, x;
            e.xsph = 0.5;
            e.xsph_rates = true;
            lattice_waves(&e, SPH_WENDLAND_C4, l, 8, dp, k, &m); /* the sums are integrals up to 1e-6 */
            exact_waves(&e, real, &x);
            const double k2 = real[0] * real[0] + real[1] * real[1], zeta = 0.5 * (e.s[0] - e.s[1]);
            close_to(x.omega2[0], k2 * (9 + 4 * 5 / 3.0 / 2), 1e-12 * x.omega2[0]);
            close_to(x.omega2[1], (5 * k2 + (real[0] * real[0] - real[1] * real[1]) * zeta) / 2, 1e-12 * x.omega2[0]);
            close_to(m.omega2[0], x.omega2[0], 1e-5 * x.omega2[0]);
            close_to(m.omega2[1], x.omega2[1], 1e-5 * x.omega2[0]);
        }
}

/* ---- the same forces on a periodic lattice whose particles are moved ---- */

enum { SIDE = 12 };
static struct {
    double x[2], moved[2], rho, s[3], r[3], acc[2];
} part[SIDE * SIDE];

static double wrap(double d) { return d - SIDE * floor(d / SIDE + 0.5); }

/* gradient of W at part i from part j, from positions at rest or moved; false beyond reach */
static bool pair(int i, int j, double h, bool moved, double grad[2], double *w)
{
    double d[2], dw;
    for (int k = 0; k < 2; k++)
        d[k] = wrap(part[i].x[k] - part[j].x[k]) + (moved ? part[i].moved[k] - part[j].moved[k] : 0);
    const double r = sqrt(d[0] * d[0] + d[1] * d[1]);
    if (i == j || r >= 2 * h || sph_kernel_value(SPH_CUBIC, r, h, w, &dw) != SPH_OK)
        return false;
    grad[0] = dw * d[0] / r;
    grad[1] = dw * d[1] / r;
    return true;
}

/* density and stress after the displacement, by the continuity equation and the Jaumann rate; artificial stress in
   principal axes */
static void strain(const elastic_state *e, int i, double h)
{
    double l[2][2] = {{0}}, grad[2], w;
    for (int j = 0; j < SIDE * SIDE; j++)
        if (pair(i, j, h, false, grad, &w))
            for (int a = 0; a < 2; a++)
                for (int b = 0; b < 2; b++)
                    l[a][b] += (part[j].moved[a] - part[i].moved[a]) * grad[b];
    const double trace = l[0][0] + l[1][1], shear = 0.5 * (l[0][1] + l[1][0]), spin = 0.5 * (l[0][1] - l[1][0]);
    part[i].rho = e->rho * (1 - trace);
    part[i].s[0] = e->s[0] + 2 * e->mu * (l[0][0] - trace / 3);
    part[i].s[1] = e->s[1] + 2 * e->mu * (l[1][1] - trace / 3);
    part[i].s[2] = 2 * e->mu * shear + spin * (e->s[1] - e->s[0]);
    const double p = e->pressure + e->c * e->c * (part[i].rho - e->rho);
    for (int k = 0; k < 2; k++)
        part[i].s[k] -= p;
    const double theta = 0.5 * atan2(2 * part[i].s[2], part[i].s[0] - part[i].s[1]), c = cos(theta), s = sin(theta);
    const double one = part[i].s[0] * c * c + 2 * part[i].s[2] * s * c + part[i].s[1] * s * s;
    const double two = part[i].s[0] * s * s - 2 * part[i].s[2] * s * c + part[i].s[1] * c * c;
    const double gain = -e->epsilon / (part[i].rho * part[i].rho);
    const double r1 = one > 0 ? gain * one : 0, r2 = two > 0 ? gain * two : 0;
    part[i].r[0] = r1 * c * c + r2 * s * s;
    part[i].r[1] = r1 * s * s + r2 * c * c;
    part[i].r[2] = (r1 - r2) * s * c;
}

static void accelerate(const elastic_state *e, int i, double h)
{
    double grad[2], w, w_dp, dw;
    sph_kernel_value(SPH_CUBIC, 1, h, &w_dp, &dw);
    part[i].acc[0] = part[i].acc[1] = 0;
    for (int j = 0; j < SIDE * SIDE; j++)
        if (pair(i, j, h, true, grad, &w)) {
            double t[3];
            for (int k = 0; k < 3; k++)
                t[k] = e->rho * (part[i].s[k] / (part[i].rho * part[i].rho) + part[j].s[k] / (part[j].rho *
                    part[j].rho) +
                                 (part[i].r[k] + part[j].r[k]) * pow(w / w_dp, e->n));
            part[i].acc[0] += t[0] * grad[0] + t[2] * grad[1];
            part[i].acc[1] += t[2] * grad[0] + t[1] * grad[1];
        }
}

/* column `axis` of the matrix of w^2, from small displacements along that axis to both sides */
static void column(const elastic_state *e, uint32_t lattice, double h, const double k[2], int axis, double out[2])
{
    const double small = 1e-5;
    out[0] = out[1] = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int a = i % SIDE, b = i / SIDE;
            part[i].x[0] = a + (lattice == LATTICE_SHIFTED_X && b % 2 ? 0.5 : 0);
            part[i].x[1] = b + (lattice == LATTICE_SHIFTED_Y && a % 2 ? 0.5 : 0);
            part[i].moved[0] = part[i].moved[1] = 0;
            part[i].moved[axis] = sign * small * cos(k[0] * part[i].x[0] + k[1] * part[i].x[1]);
        }
        for (int i = 0; i < SIDE * SIDE; i++)
            strain(e, i, h);
        for (int i = 0; i < SIDE * SIDE; i++) {
            accelerate(e, i, h);
            for (int l = 0; l < 2; l++)
                out[l] -= sign * part[i].acc[l] * cos(k[0] * part[i].x[0] + k[1] * part[i].x[1]) / (small * SIDE *
                    SIDE);
        }
    }
}

static void waves_follow_from_the_forces(void **state)
{
    static const elastic_state states[] = {
        /* tension both ways, in x only, nowhere, equal stresses */
        {.rho = 1.5, .c = 1, .mu = 0.22, .pressure = -0.05, .s = {0.02, -0.01}, .epsilon = 0.3, .n = 4},
        {.rho = 1.5, .c = 1, .mu = 0.22, .pressure = 0.02, .s = {0.07, -0.05}, .epsilon = 0.3, .n = 4},
        {.rho = 1.5, .c = 1, .mu = 0.22, .pressure = 0.1, .s = {0.03, -0.04}, .epsilon = 0.3, .n = 4},
        {.rho = 1, .c = 2, .mu = 3, .pressure = -0.2, .epsilon = 0.3, .n = 2},
    };
    static const int waves[][2] = {{1, 0}, {1, 2}, {3, 1}, {5, 4}, {0, 3}};
    double worst = 0;
    (void)state;
    for (uint32_t l = 0; l < LATTICES; l++)
        for (size_t s = 0; s < sizeof states / sizeof *states; s++)
            for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
                const double k[2] = {2 * PI * waves[i][0] / SIDE, 2 * PI * waves[i][1] / SIDE}, h = 1.3;
                double c[2][2];
                wave_modes m;
                for (int a = 0; a < 2; a++)
                    column(&states[s], l, h, k, a, c[a]);
                lattice_waves(&states[s], SPH_CUBIC, l, h, 1, k, &m);
                const double sum = c[0][0] + c[1][1], size = fabs(c[0][0]) + fabs(c[1][1]);
                const double product = c[0][0] * c[1][1] - c[0][1] * c[1][0];
                close_to(m.omega2[0] + m.omega2[1], sum, 2e-8 * size);
                close_to(m.omega2[0] * m.omega2[1] + m.imag * m.imag, product, 2e-8 * size * size);
                worst = fmax(worst, fabs(m.omega2[0] + m.omega2[1] - sum) / size);
            }
    print_message("dispersion: waves of %d lattices and states as from the forces, within %.1e\n", 3 * 4 * 5, worst);
}

static void smoothing_slows_waves_by_beta(void **state)
{
    const elastic_state plain = {.rho = 1, .c = 1, .mu = 0.22, .pressure = 0.1, .n = 4};
    elastic_state e = plain;
    const double k[2] = {0.7, 0.4};
    lattice_sums s;
    wave_modes a, b;
    (void)state;
    lattice_sum(SPH_CUBIC, LATTICE_SQUARE, 1.5, 4, k, &s);
    lattice_waves(&plain, SPH_CUBIC, LATTICE_SQUARE, 1.5, 1, k, &a);
    e.xsph = 0.5;
    e.xsph_rates = true;
    lattice_waves(&e, SPH_CUBIC, LATTICE_SQUARE, 1.5, 1, k, &b);
    for (int i = 0; i < 2; i++)
        close_to(b.omega2[i], a.omega2[i] * (1 - 0.5 * s.beta), 1e-12);
    e.xsph_rates = false; /* without background stress positions do not matter */
    e.pressure = 0;
    lattice_waves(&e, SPH_CUBIC, LATTICE_SQUARE, 1.5, 1, k, &b);
    e.xsph = 0;
    lattice_waves(&e, SPH_CUBIC, LATTICE_SQUARE, 1.5, 1, k, &a);
    for (int i = 0; i < 2; i++)
        close_to(b.omega2[i], a.omega2[i], 1e-12);
}

/* Gray 5.74: at h = dp in tension epsilon must be above 3/(3n + 2), here with the diagonal neighbours' part */
static void artificial_stress_stabilises_where_gray_says(void **state)
{
    elastic_state e = {.rho = 1, .c = 1, .mu = 0.22, .pressure = -0.05, .n = 4};
    lattice_sums s;
    wave_modes m;
    (void)state;
    lattice_sum(SPH_CUBIC, LATTICE_SQUARE, 1, 4, along_x, &s);
    const double limit = s.b[0] / s.f[0];
    close_to(limit, 3 * (10 - 5 * sqrt(2.0)) / 3 / 14, 0.01);
    e.epsilon = 0.99 * limit;
    lattice_waves(&e, SPH_CUBIC, LATTICE_SQUARE, 1, 1, along_x, &m);
    assert_true(m.omega2[0] < 0 || m.omega2[1] < 0);
    e.epsilon = 1.01 * limit;
    lattice_waves(&e, SPH_CUBIC, LATTICE_SQUARE, 1, 1, along_x, &m);
    const double longitudinal = 2 * (s.b[0] * -0.05 + 0.05 * e.epsilon * s.f[0]);
    assert_true(longitudinal > 0);
    assert_true(fabs(m.omega2[0] - longitudinal) < 1e-12 || fabs(m.omega2[1] - longitudinal) < 1e-12);
}

static int run(const char *a, const char *b, const char *c)
{
    char text[3][256], *argv[] = {"dispersion", text[0], text[1], text[2], NULL};
    snprintf(text[0], sizeof text[0], "%s", a);
    snprintf(text[1], sizeof text[1], "%s", b);
    snprintf(text[2], sizeof text[2], "%s", c);
    return cmd_dispersion(4, argv);
}

static void bad_input_is_refused(void **state)
{
    (void)state;
    assert_int_equal(run("curve", "h=0.1", "mu=1"), 2);
    assert_int_equal(run("curve", "h=nan", "mu=1"), 2);
    assert_int_equal(run("curve", "mu=-1", "h=1"), 2);
    assert_int_equal(run("curve", "kernel=square", "h=1"), 2);
    assert_int_equal(run("curve", "points=1", "h=1"), 2);
    assert_int_equal(run("curve", "plot=a.gif", "h=1"), 2);
    assert_int_equal(run("curve", "printed=tests/refdata", "h=1"), 2);
    assert_int_equal(run("tables", "lattice=hexagonal", "n=4"), 2);
    assert_int_equal(run("tables", "h=2,1,0.1", "n=4"), 2);
    assert_int_equal(run("tables", "h=1,2,0", "n=4"), 2);
    assert_int_equal(run("tables", "printed=tests/refdata", "n=3"), 2);
    assert_int_equal(run("tables", "printed=nowhere", "n=4"), 1);
    assert_int_equal(run("curve", "out=nowhere/at/all.csv", "h=1"), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        subject(the_tables_are_those_printed),
        subject(at_h_one_the_sums_have_closed_forms),
        subject(second_derivatives_are_those_of_the_kernels),
        subject(long_waves_are_exact),
        subject(waves_follow_from_the_forces),
        subject(smoothing_slows_waves_by_beta),
        subject(artificial_stress_stabilises_where_gray_says),
        subject(bad_input_is_refused),
    };
    return run_subjects("dispersion", tests);
}
