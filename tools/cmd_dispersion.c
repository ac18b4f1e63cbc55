/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_dispersion.c: sph dispersion. Gray's coefficients of plane waves on lattices of particles as his tables B.3 to
   B.5, and omega(k) of the discrete elastic solid against the exact one. */
#include "commands.h"
#include "dispersion.h"
#include "host.h"
#include "table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph dispersion [tables] [lattice=NAME] [kernel=cubic] [n=4] [k=1,0] [h=1,2,0.1] [printed=DIR]\n"
    "       sph dispersion curve [OPTIONS] [out=NAME.csv] [plot=NAME.png]\n"
    "Plane waves on particles of an elastic solid at rest, plane strain (Gray 2001, section 5.6, appendix B).\n\n"
    "tables: the sums beta (for xi = 1), A, B and F over all neighbours, spacing 1, laid out as tables B.3 to B.5\n"
    "  lattice=       square, shifted_x, shifted_y (default: all three)\n"
    "  kernel=        cubic quartic quintic gaussian wendland_c2 wendland_c4 hat\n"
    "  n=4            power of the artificial stress\n"
    "  k=1,0          wave vector in pi/spacing\n"
    "  h=1,2,0.1      smoothing lengths in spacings: from, to, step\n"
    "  printed=DIR    compares with the printed tables in DIR (tests/refdata)\n\n"
    "curve: omega of the longitudinal and the transverse mode against k\n"
    "  lattice=square kernel=cubic h=1.5 n=4     h in spacings\n"
    "  angle=0 kmax=1 points=100                 direction of k in degrees, largest k in pi/spacing\n"
    "  spacing=1 rho=1 c=1 mu=0.22               spacing, density, bulk wave speed, shear modulus, any one system of "
    "units\n"
    "  pressure=0 sxx=0 syy=0                    the stress at rest; sxx, syy deviatoric, positive in tension\n"
    "  epsilon=0.3                               of the artificial stress\n"
    "  artificial=changing|frozen                it changes with the wave (default), or is constant as in Gray 5.65\n"
    "  xsph=0 xsph_in=all|positions              factor of the smoothed velocity, and what it enters (Gray: all)\n"
    "  out=NAME.csv                              else to standard output; plot= needs gnuplot\n"
    "  growth is the rate at which a wave grows; where it is above 0 the lattice is unstable\n";

static const double pi = 3.14159265358979323846;

/* ---- tables ---- */

#define COLUMNS 9
static const char *const column_names[COLUMNS] = {"beta", "Ax", "Ay", "Bxx", "Byy", "Bxy", "Fxx", "Fyy", "Fxy"};

static void sums_row(const lattice_sums *s, double row[COLUMNS])
{
    const double all[COLUMNS] = {s->beta, s->a[0], s->a[1], s->b[0], s->b[1], s->b[2], s->f[0], s->f[1], s->f[2]};
    memcpy(row, all, sizeof all);
}

static void print_row(const char *what, const double row[COLUMNS])
{
    printf("%-11s", what);
    for (int k = 0; k < COLUMNS; k++)
        if (fabs(row[k]) < 1e-12)
            printf(" %9s", "0.0");
        else
            printf(" %9.4f", row[k]);
    putchar('\n');
}

/* the printed table of a lattice; its columns by name, those of F with "_printed" behind it */
static bool open_printed(table *t, const char *dir, int lattice, char *name, size_t size)
{
    static const char *const files[LATTICES] = {"gray_table_B3_square.csv", "gray_table_B4_shifted_x.csv",
                                                "gray_table_B5_shifted_y.csv"};
    snprintf(name, size, "%s/%s", dir, files[lattice]);
    return table_open(t, name);
}

/* row of the printed table for h; false if it has none. A column that is not there is 0. */
static bool printed_row(const table *t, double h, double row[COLUMNS])
{
    const int key = table_column(t, "h_over_dp", 9);
    for (uint32_t r = 0; key >= 0 && r < t->rows; r++) {
        if (fabs(table_at(t, r, (uint32_t)key) - h) > 1e-9)
            continue;
        for (int k = 0; k < COLUMNS; k++) {
            char name[32];
            int c = table_column(t, column_names[k], strlen(column_names[k]));
            snprintf(name, sizeof name, "%s_printed", column_names[k]);
            c = c < 0 ? table_column(t, name, strlen(name)) : c;
            row[k] = c < 0 ? 0 : table_at(t, r, (uint32_t)c);
        }
        return true;
    }
    return false;
}

typedef struct table_options {
    int lattice, kernel; /* lattice -1: all */
    double n, k[2], h[3];
    const char *printed;
} table_options;

static void compare(const double *row, const table *printed, double h, double worst[2])
{
    double theirs[COLUMNS], off[COLUMNS];
    if (!printed_row(printed, h, theirs))
        return;
    for (int k = 0; k < COLUMNS; k++) {
        off[k] = row[k] - theirs[k];
        worst[k >= 6] = fmax(worst[k >= 6], fabs(off[k]));
    }
    print_row("  printed", theirs);
    print_row("  difference", off);
}

static bool one_table(const table_options *o, int lattice)
{
    static const char *const title[LATTICES] = {"B.3 Square cells", "B.4 Face centred cells - x direction shift",
                                                "B.5 Face centred cells - y direction shift"};
    char name[1024], h_text[16];
    table printed;
    double worst[2] = {0, 0}, row[COLUMNS];
    const double k[2] = {o->k[0] * pi, o->k[1] * pi};
    if (o->printed && !open_printed(&printed, o->printed, lattice, name, sizeof name))
        return false;
    printf("%s (%s, n = %g, k = %g, %g pi/dp)\n%-11s", title[lattice], dispersion_kernels[o->kernel], o->n, o->k[0],
           o->k[1], "h/dp");
    for (int c = 0; c < COLUMNS; c++)
        printf(" %9s", column_names[c]);
    putchar('\n');
    for (int i = 0; o->h[0] + i * o->h[2] <= o->h[1] + 1e-9; i++) {
        lattice_sums s;
        const double h = o->h[0] + i * o->h[2];
        lattice_sum((uint32_t)o->kernel, (uint32_t)lattice, h, o->n, k, &s);
        sums_row(&s, row);
        snprintf(h_text, sizeof h_text, "%.4g", h);
        print_row(h_text, row);
        if (o->printed)
            compare(row, &printed, h, worst);
    }
    if (o->printed) {
        printf("largest difference: %.1e of beta, A and B; %.1e of F\n", worst[0], worst[1]);
        table_close(&printed);
    }
    putchar('\n');
    return true;
}

static int choice_option(int argc, char **argv, const char *name, const char *const *choices, int otherwise)
{
    const char *text = host_option(argc, argv, name);
    return text ? host_choice(name, text, choices) : otherwise;
}

static int tables(int argc, char **argv)
{
    const char *text;
    table_options o = {-1, 0, 4, {1, 0}, {1, 2, 0.1}, host_option(argc, argv, "printed")};
    if ((o.lattice = choice_option(argc, argv, "lattice", lattice_names, LATTICES)) < 0 ||
        (o.kernel = choice_option(argc, argv, "kernel", dispersion_kernels, 0)) < 0 ||
        ((text = host_option(argc, argv, "n")) && !host_number("n", text, 0, 20, &o.n)) ||
        ((text = host_option(argc, argv, "k")) && !host_numbers("k", text, 2, o.k)) ||
        ((text = host_option(argc, argv, "h")) && !host_numbers("h", text, 3, o.h)))
        return HOST_USAGE;
    if (!(o.h[0] >= 0.6 && o.h[1] <= 20 && o.h[1] >= o.h[0] && o.h[2] >= 1e-4))
        return host_usage("h=%s: must be FROM,TO,STEP with 0.6 <= FROM <= TO <= 20 and STEP >= 0.0001", text);
    if (!(fabs(o.k[0]) <= 100 && fabs(o.k[1]) <= 100))
        return host_usage("k=%g,%g: both must be -100 .. 100 (in pi/spacing)", o.k[0], o.k[1]);
    if (o.printed && (o.kernel || o.n != 4 || o.k[0] != 1 || o.k[1] != 0))
        return host_usage("printed= is for the settings of the printed tables: kernel=cubic n=4 k=1,0");
    for (int l = 0; l < LATTICES; l++)
        if ((o.lattice == LATTICES || o.lattice == l) && !one_table(&o, l))
            return HOST_NO;
    return HOST_FINE;
}

/* ---- curves ---- */

typedef struct curve_options {
    int lattice, kernel;
    double h, angle, kmax, spacing;
    uint64_t points;
    elastic_state e;
    const char *out, *plot;
} curve_options;

typedef struct curve_row {
    double k_dp, k, omega2[2], imag, omega[2], growth[2], exact[2];
} curve_row;

/* square root of a + i b as real and imaginary part, both at least 0 */
static void root(double a, double b, double *re, double *im)
{
    const double size = sqrt(a * a + b * b);
    *re = sqrt(fmax(0, 0.5 * (size + a)));
    *im = sqrt(fmax(0, 0.5 * (size - a)));
}

static void curve_point(const curve_options *o, double k_dp, curve_row *r)
{
    const double c = cos(o->angle * pi / 180), s = sin(o->angle * pi / 180);
    const double k[2] = {k_dp * c, k_dp * s}, k_real[2] = {k[0] / o->spacing, k[1] / o->spacing};
    wave_modes m, x;
    double im, unused;
    lattice_waves(&o->e, (uint32_t)o->kernel, (uint32_t)o->lattice, o->h, o->spacing, k, &m);
    exact_waves(&o->e, k_real, &x);
    *r = (curve_row){.k_dp = k_dp / pi, .k = k_dp / o->spacing, .imag = m.imag};
    for (int i = 0; i < 2; i++) {
        r->omega2[i] = m.omega2[i];
        root(m.omega2[i], m.imag, &r->omega[i], &im);
        /* what rounding leaves of a frequency that is 0 is no growth */
        const double scale = o->e.c / o->spacing;
        r->growth[i] = im > 1e-7 * scale ? im : 0;
        root(x.omega2[i], x.imag, &r->exact[i], &unused);
    }
}

static double ratio(const curve_row *r, int i) { return r->exact[i] > 0 ? r->omega[i] / r->exact[i] : 0; }

static void put_curve(FILE *f, const curve_options *o)
{
    const elastic_state *e = &o->e;
    fprintf(f,
            "# dispersion: lattice %s, kernel %s, h/dp %g, angle %g, rho %g, c %g, mu %g, pressure %g, sxx %g, syy %g, "
            "epsilon %g, n %g, xsph %g\n"
            "k_dp_over_pi,k,omega2_long,omega2_trans,omega2_imag,omega_long,omega_trans,growth_long,growth_trans,"
            "exact_long,"
            "exact_trans,long_over_exact,trans_over_exact\n",
            lattice_names[o->lattice], dispersion_kernels[o->kernel], o->h, o->angle, e->rho, e->c, e->mu, e->pressure,
            e->s[0], e->s[1], e->epsilon, e->n, e->xsph);
    for (uint64_t i = 1; i <= o->points; i++) {
        curve_row r;
        curve_point(o, o->kmax * pi * (double)i / (double)o->points, &r);
        const double value[] = {r.k_dp,     r.k,         r.omega2[0], r.omega2[1], r.imag,     r.omega[0],
                                r.omega[1], r.growth[0], r.growth[1], r.exact[0],  r.exact[1], ratio(&r, 0)};
        for (size_t c = 0; c < sizeof value / sizeof *value; c++)
            fprintf(f, "%.10g,", value[c]);
        fprintf(f, "%.10g\n", ratio(&r, 1));
    }
}

/* what a reader wants first: speeds at two wavelengths, and where it is unstable */
static void print_summary(const curve_options *o)
{
    static const double wavelengths[] = {100, 20, 10, 5};
    curve_row r;
    printf("wavelength/dp  longitudinal/exact  transverse/exact\n");
    for (size_t i = 0; i < sizeof wavelengths / sizeof *wavelengths; i++) {
        curve_point(o, 2 * pi / wavelengths[i], &r);
        printf("%13g  %18.6f  %16.6f\n", wavelengths[i], ratio(&r, 0), ratio(&r, 1));
    }
    for (int mode = 0; mode < 2; mode++) {
        double first = 0, last = 0, most = 0;
        for (uint64_t i = 1; i <= o->points; i++) {
            curve_point(o, o->kmax * pi * (double)i / (double)o->points, &r);
            if (r.growth[mode] > 0) {
                first = first > 0 ? first : r.k_dp;
                last = r.k_dp;
                most = fmax(most, r.growth[mode]);
            }
        }
        printf("%-13s ", mode ? "transverse:" : "longitudinal:");
        if (most > 0)
            printf("unstable between k = %g and %g pi/dp, largest growth rate %g\n", first, last, most);
        else
            printf("stable up to k = %g pi/dp\n", o->kmax);
    }
}

static bool draw_curve(const curve_options *o, output *picture)
{
    static const char *const titles[] = {"longitudinal", "transverse", "exact longitudinal", "exact transverse",
                                         "growth, longitudinal", "growth, transverse"};
    static const char *const styles[] = {"lines lw 2 lc 1", "lines lw 2 lc 2", "lines dt 2 lc 1", "lines dt 2 lc 2",
                                         "lines lw 2 dt 3 lc 1", "lines lw 2 dt 3 lc 2"};
    plot p;
    if (!plot_open(&p, 960, 640))
        return false;
    fputs("$data << END_OF_DATA\n", p.g);
    for (uint64_t i = 1; i <= o->points; i++) {
        curve_row r;
        curve_point(o, o->kmax * pi * (double)i / (double)o->points, &r);
        fprintf(p.g, "%.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", r.k_dp, r.omega[0], r.omega[1], r.exact[0], r.exact[1],
                r.growth[0], r.growth[1]);
    }
    fputs("END_OF_DATA\nset grid\nset key left top\nset xlabel 'k dp / pi'\nset ylabel 'omega'\n", p.g);
    for (int k = 0; k < 6; k++)
        fprintf(p.g, "%s $data using 1:%d with %s title '%s'", k ? "," : "plot", k + 2, styles[k], titles[k]);
    fputc('\n', p.g);
    return plot_close(&p, picture);
}

static bool parse_numbers(int argc, char **argv, curve_options *o)
{
    elastic_state *e = &o->e;
    const struct {
        const char *name;
        double low, high, *value;
    } list[] = {{"h", 0.6, 20, &o->h},          {"angle", -360, 360, &o->angle},     {"kmax", 1e-6, 10, &o->kmax},
                {"n", 0, 20, &e->n},            {"spacing", 1e-9, 1e9, &o->spacing}, {"rho", 1e-9, 1e12, &e->rho},
                {"c", 1e-9, 1e9, &e->c},        {"mu", 0, 1e15, &e->mu},             {"pressure", -1e15, 1e15,
                    &e->pressure},
                {"sxx", -1e15, 1e15, &e->s[0]}, {"syy", -1e15, 1e15, &e->s[1]},      {"epsilon", 0, 10, &e->epsilon},
                {"xsph", 0, 1, &e->xsph}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const char *text = host_option(argc, argv, list[i].name);
        if (text && !host_number(list[i].name, text, list[i].low, list[i].high, list[i].value))
            return false;
    }
    const char *text = host_option(argc, argv, "points");
    return !text || host_count("points", text, 2, 100000, &o->points);
}

static int curve(int argc, char **argv)
{
    static const char *const enters[] = {"all", "positions", NULL}, *const changes[] = {"changing", "frozen", NULL};
    curve_options o = {.h = 1.5, .kmax = 1, .spacing = 1, .points = 100};
    o.e = (elastic_state){.rho = 1, .c = 1, .mu = 0.22, .epsilon = 0.3, .n = 4};
    const int in = choice_option(argc, argv, "xsph_in", enters, 0);
    const int stress = choice_option(argc, argv, "artificial", changes, 0);
    if (in < 0 || stress < 0 || !parse_numbers(argc, argv, &o) ||
        (o.lattice = choice_option(argc, argv, "lattice", lattice_names, LATTICE_SQUARE)) < 0 ||
        (o.kernel = choice_option(argc, argv, "kernel", dispersion_kernels, 0)) < 0)
        return HOST_USAGE;
    o.e.xsph_rates = in == 0;
    o.e.frozen = stress == 1;
    o.out = host_option(argc, argv, "out");
    o.plot = host_option(argc, argv, "plot");
    if (o.plot && !plot_name("plot", o.plot))
        return HOST_USAGE;
    if (!o.out && !o.plot) {
        put_curve(stdout, &o);
        return HOST_FINE;
    }
    output file[2] = {{0}};
    bool fine = (!o.out || output_open(&file[0], "out", o.out)) && (!o.plot || output_open(&file[1], "plot", o.plot));
    if (fine && o.out)
        put_curve(file[0].f, &o);
    if (fine)
        print_summary(&o);
    fine = fine && (!o.plot || draw_curve(&o, &file[1]));
    return output_close_all(file, 2, fine) && fine ? HOST_FINE : HOST_NO;
}

int cmd_dispersion(int argc, char **argv)
{
    static const char *const of_tables[] = {"lattice", "kernel", "n", "k", "h", "printed", NULL};
    static const char *const of_curve[] = {"lattice", "kernel", "h",  "n",   "angle", "kmax",     "points",  "spacing",
                                           "rho",     "c",      "mu", "sxx", "syy",   "pressure", "epsilon",
                                           "artificial",
                                           "xsph",    "xsph_in", "out", "plot", NULL};
    host_command("dispersion");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    bool curves = false;
    for (int i = 1; i < argc; i++)
        curves |= !strcmp(argv[i], "curve");
    const int words = host_known_options(argc, argv, curves ? of_curve : of_tables);
    if (words < 0)
        return HOST_USAGE;
    if (words > 1 || (words == 1 && !curves && strcmp(argv[1], "tables") != 0))
        return host_usage("%s: must be tables or curve, then options NAME=VALUE", argv[words]);
    return curves ? curve(argc, argv) : tables(argc, argv);
}
