/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_gradykipp.c: sph gradykipp. When a brittle body breaks at a constant strain rate, and into pieces of what
   size. */
#include "commands.h"
#include "gradykipp.h"
#include "host.h"
#include "table.h"

#include <math.h>
#include <string.h>

static const char help[] =
    "usage: sph gradykipp [k=1.4e19] [m=8.5] [c=0.4] [rate=3.33e-3,6.66e-4,3.33e-4] [dim=2] [points=200]\n"
    "                     [out=NAME.csv] [plot=NAME.png]\n"
    "Fragment statistics of Grady and Kipp (Gray 2001, eqs 6.7-6.18) for flaws k strain^m per unit of length, area or\n"
    "volume (dim 1, 2, 3), cracks of speed c, strain rates (1 to 8 of them); any one system of units. Prints for each "
    "rate\n"
    "  t_f       time of fragmentation, D(t_f) = 1\n"
    "  L_M       most likely size: where F(L) is largest, 2 dim c t_f/(m + dim - 1)\n"
    "  L_printed the same by Gray's eq 6.18, which has m for m + 1\n"
    "  mean      mean size by volume, and by number; the largest is 2 c t_f\n"
    "out= writes F(L), the share of the volume per length, for every rate; plot= draws it (needs gnuplot).\n"
    "The defaults are Gray's: lengths in cm, speeds in units of the sound speed.\n";

#define MOST 8

/* numbers separated by commas; how many, 0 after a message */
static uint32_t parse_rates(const char *text, double *rate)
{
    uint32_t n = 1;
    for (const char *p = text; *p; p++)
        n += *p == ',';
    if (n > MOST) {
        host_usage("rate=%s: must be 1 to %d numbers", text, MOST);
        return 0;
    }
    if (!host_numbers("rate", text, n, rate))
        return 0;
    for (uint32_t i = 0; i < n; i++)
        if (!(rate[i] >= 1e-30 && rate[i] <= 1e30)) {
            host_usage("rate=%s: every rate must be 1e-30 .. 1e+30", text);
            return 0;
        }
    return n;
}

static void put_curves(FILE *f, gradykipp g, const double *rate, uint32_t n, uint64_t points, char between)
{
    double longest = 0;
    for (uint32_t r = 0; r < n; r++) {
        g.rate = rate[r];
        longest = fmax(longest, gradykipp_largest(&g));
    }
    for (uint64_t i = 0; i <= points; i++) {
        const double size = longest * (double)i / (double)points;
        fprintf(f, "%.10g", size);
        for (uint32_t r = 0; r < n; r++) {
            g.rate = rate[r];
            fprintf(f, "%c%.10g", between, gradykipp_density(&g, size));
        }
        fputc('\n', f);
    }
}

static void write_curves(const gradykipp *g, const double *rate, uint32_t n, uint64_t points, FILE *f)
{
    fprintf(f, "# gradykipp: k %g, m %g, c %g, dim %u\nsize", g->k, g->m, g->crack_speed, g->dim);
    for (uint32_t r = 0; r < n; r++)
        fprintf(f, ",F_rate_%g", rate[r]);
    fputc('\n', f);
    put_curves(f, *g, rate, n, points, ',');
}

static bool draw_curves(const gradykipp *g, const double *rate, uint32_t n, uint64_t points, output *o)
{
    plot p;
    if (!plot_open(&p, 960, 640))
        return false;
    fputs("$data << END_OF_DATA\n", p.g);
    put_curves(p.g, *g, rate, n, points, ' ');
    fputs("END_OF_DATA\nset grid\nset xlabel 'size L'\nset ylabel 'F(L)'\n", p.g);
    for (uint32_t r = 0; r < n; r++)
        fprintf(p.g, "%s $data using 1:%u with lines lw 2 title 'strain rate %g'", r ? "," : "plot", r + 2, rate[r]);
    fputc('\n', p.g);
    return plot_close(&p, o);
}

static void print_sizes(gradykipp g, const double *rate, uint32_t rates)
{
    printf("k %g, m %g, c %g, dim %u, ln alpha %.9g\n", g.k, g.m, g.crack_speed, g.dim, gradykipp_ln_alpha(&g));
    printf("%12s %12s %12s %12s %12s %12s %12s\n", "rate", "t_f", "L_M", "L_printed", "mean", "mean_number", "largest");
    for (uint32_t r = 0; r < rates; r++) {
        g.rate = rate[r];
        printf("%12.6g %12.6g %12.6g %12.6g %12.6g %12.6g %12.6g\n", g.rate, gradykipp_time(&g), gradykipp_peak(&g),
               gradykipp_peak_printed(&g), gradykipp_mean(&g), gradykipp_mean_number(&g), gradykipp_largest(&g));
    }
}

/* the files that were asked for, both or none */
static int write_files(const gradykipp *g, const double *rate, uint32_t n, uint64_t points, const char *out,
                       const char *picture)
{
    output o[2] = {{0}};
    bool fine = (!out || output_open(&o[0], "out", out)) && (!picture || output_open(&o[1], "plot", picture));
    if (fine && out)
        write_curves(g, rate, n, points, o[0].f);
    fine = fine && (!picture || draw_curves(g, rate, n, points, &o[1]));
    return output_close_all(o, 2, fine) && fine ? HOST_FINE : HOST_NO;
}

int cmd_gradykipp(int argc, char **argv)
{
    static const char *const known[] = {"k", "m", "c", "rate", "dim", "points", "out", "plot", NULL};
    gradykipp g = {2, 1.4e19, 8.5, 0.4, 0};
    double rate[MOST] = {3.33e-3, 6.66e-4, 3.33e-4};
    uint32_t rates = 3;
    uint64_t points = 200, dim = 2;
    const char *text;
    host_command("gradykipp");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    const int words = host_known_options(argc, argv, known);
    if (words > 0)
        return host_usage("%s: options are written NAME=VALUE", argv[1]);
    if (words < 0 || !gradykipp_parse(argc, argv, &g) ||
        ((text = host_option(argc, argv, "rate")) && !(rates = parse_rates(text, rate))) ||
        ((text = host_option(argc, argv, "dim")) && !host_count("dim", text, 1, 3, &dim)) ||
        ((text = host_option(argc, argv, "points")) && !host_count("points", text, 2, 100000, &points)) ||
        ((text = host_option(argc, argv, "plot")) && !plot_name("plot", text)))
        return HOST_USAGE;
    g.dim = (uint32_t)dim;
    print_sizes(g, rate, rates);
    return write_files(&g, rate, rates, points, host_option(argc, argv, "out"), host_option(argc, argv, "plot"));
}
