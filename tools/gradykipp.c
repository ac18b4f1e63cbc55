/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* gradykipp.c: fragment statistics (see gradykipp.h; Gray 2001, section 6.4.2).

   A crack that starts at time s has relieved V (c (t - s))^d at t, V = 2, pi, 4 pi/3; in dt there start m k rate^m
   t^(m-1) of them. With 1 - D taken as 1 (first order)
     D(t) = V c^d m k rate^m B(m, d+1) t^(m+d) = alpha rate^m t^(m+d),
     alpha = V c^d k Gamma(m+1) d! / Gamma(m+d+1)           (d = 2: 2 pi c^2 k / ((m+1)(m+2)), Gray 6.15)
     t_f = alpha^(-1/(m+d)) rate^(-m/(m+d))                 (6.16)
   A piece of size L = 2 c (t_f - s): with x = L/(2 c t_f)
     F(L) = V (L/2)^d m k rate^m (t_f - L/2c)^(m-1) / 2c = x^d (1-x)^(m-1) / (B(m, d+1) 2 c t_f)   (6.17)
   largest at x = d/(m+d-1): L_M = 4 c t_f/(m+1) in two dimensions, 6 c t_f/(m+2) in three. Gray's 6.18 has 4 c t_f/m,
   and his figures 0.44, 1.63, 2.87 cm follow from that. */
#include "gradykipp.h"

#include <math.h>

#include "host.h"

double gradykipp_ln_alpha(const gradykipp *g)
{
    const double pi = 3.14159265358979323846, ball[] = {2, pi, 4 * pi / 3}, d = g->dim;
    return log(ball[g->dim - 1]) + d * log(g->crack_speed) + log(g->k) + lgamma(g->m + 1) + lgamma(d + 1) -
           lgamma(g->m + d + 1);
}

double gradykipp_time(const gradykipp *g)
{
    return exp(-(gradykipp_ln_alpha(g) + g->m * log(g->rate)) / (g->m + g->dim));
}

double gradykipp_largest(const gradykipp *g) { return 2 * g->crack_speed * gradykipp_time(g); }
double gradykipp_peak(const gradykipp *g) { return gradykipp_largest(g) * g->dim / (g->m + g->dim - 1); }
double gradykipp_peak_printed(const gradykipp *g) { return gradykipp_largest(g) * g->dim / g->m; }
double gradykipp_mean(const gradykipp *g) { return gradykipp_largest(g) * (g->dim + 1) / (g->m + g->dim + 1); }
double gradykipp_mean_number(const gradykipp *g) { return gradykipp_largest(g) / (g->m + 1); }

double gradykipp_density(const gradykipp *g, double size)
{
    const double whole = gradykipp_largest(g), x = size / whole, d = g->dim;
    if (!(x > 0 && x < 1))
        return 0;
    const double ln_beta = lgamma(g->m) + lgamma(d + 1) - lgamma(g->m + d + 1);
    return exp(d * log(x) + (g->m - 1) * log1p(-x) - ln_beta) / whole;
}

bool gradykipp_parse(int argc, char **argv, gradykipp *g)
{
    const char *text;
    return (!(text = host_option(argc, argv, "k")) || host_number("k", text, 1e-100, 1e200, &g->k)) &&
           (!(text = host_option(argc, argv, "m")) || host_number("m", text, 1, 100, &g->m)) &&
           (!(text = host_option(argc, argv, "c")) || host_number("c", text, 1e-12, 1e12, &g->crack_speed));
}
