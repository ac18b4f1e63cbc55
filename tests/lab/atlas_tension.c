/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_tension.c: the smallest stretch T at which a chain of particles in one dimension buckles (Powell 2012, section
   3.4, figure 3.2). Spacing 1, unit masses, pressure -T c0^2 rho.

   Powell's matrix, his eq 3.40 with n = 4 (his energy-conserving form) for a chain with free ends, whose missing
   neighbours he leaves out of every sum:
     A_ik = sum_j W'_ij W'_kj - n T delta_ik sum_j W''_ij + n T W''_ik
   The matrix of the code (form updated, standard scheme; stress and density follow the displacement), for a chain
   between particles that are held, so that it is at rest:
     A_ik = (1 + 2 T) sum_j W'_ij W'_kj - 2 T delta_ik sum_j W''_ij + 2 T W''_ik
   where j runs over held particles too and (1 + 2T) comes from the density in sigma/rho^2. Both are tried for T = 0 ..
   most by bisection on a Cholesky factorisation, which fails where the matrix is not positive definite; their T differ
   by the factor 2 of n, and by the ends. With s^2 on the diagonal too, it fails where a mode grows faster than s.
   Running: the same chain, pushed at random with 1e-9 c0; unstable if it comes to move 100 times faster within the run,
   which modes that grow more slowly than ln(1000)/end do not show (a push has about a tenth of its speed in the mode
   that grows). W'' is found from W' by differences. One dimension, double precision. */
#include "atlas.h"

#include <math.h>
#include <stdlib.h>

#include "box.h"

enum { MOST = 128 };
#define END 2000

static double slope(uint32_t kernel, double h, double x)
{
    double w, dw;
    if (fabs(x) >= h * sph_kernel_support(kernel) || sph_kernel_value(kernel, fabs(x), h, &w, &dw) != SPH_OK)
        return 0;
    return x < 0 ? -dw : dw;
}
static double second(uint32_t kernel, double h, double x)
{
    const double e = 1e-5;
    return (slope(kernel, h, fabs(x) + e) - slope(kernel, h, fabs(x) - e)) / (2 * e);
}

/* Cholesky factorisation in place; false if the matrix is not positive definite */
static bool definite(double a[MOST][MOST], uint32_t n)
{
    for (uint32_t j = 0; j < n; j++) {
        for (uint32_t k = 0; k < j; k++)
            a[j][j] -= a[j][k] * a[j][k];
        if (!(a[j][j] > 0))
            return false;
        a[j][j] = sqrt(a[j][j]);
        for (uint32_t i = j + 1; i < n; i++) {
            for (uint32_t k = 0; k < j; k++)
                a[i][j] -= a[i][k] * a[j][k];
            a[i][j] /= a[j][j];
        }
    }
    return true;
}

typedef struct chain {
    uint32_t kernel, count;
    double h, factor, density; /* n, and 2 where the density enters */
    double rate;               /* growth that is let pass, c0/dx */
    int ends;                  /* particles beyond each end that are held; 0: none, free ends */
} chain;

static bool stands(const chain *c, double stretch)
{
    static double a[MOST][MOST];
    const int n = (int)c->count;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            double s = i == k ? c->rate * c->rate : 0;
            for (int j = -c->ends; j < n + c->ends; j++) {
                s += (1 + c->density * stretch) * slope(c->kernel, c->h, i - j) * slope(c->kernel, c->h, k - j);
                s -= i == k && j != i ? c->factor * stretch * second(c->kernel, c->h, i - j) : 0;
            }
            a[i][k] = s + (i == k ? 0 : c->factor * stretch * second(c->kernel, c->h, i - k));
        }
    return definite(a, c->count);
}

static double least(const chain *c, double most)
{
    double low = 0, high = most;
    if (stands(c, most))
        return TENSION_NONE;
    while (high - low > 1e-4 * high && high > 1e-9) {
        const double mid = 0.5 * (low + high);
        if (stands(c, mid))
            low = mid;
        else
            high = mid;
    }
    return high;
}

static int held_of(uint32_t kernel, double h) { return 2 * (int)ceil(h * sph_kernel_support(kernel)) + 1; }

double tension_powell(uint32_t kernel, double h, uint32_t count, double most)
{
    const chain c = {.kernel = kernel, .h = h, .count = count, .factor = 4};
    return least(&c, most);
}

double tension_cholesky(uint32_t kernel, double h, uint32_t count, double most, double rate)
{
    const chain c = {.kernel = kernel, .h = h, .count = count, .factor = 2, .density = 2, .rate = rate,
                     .ends = held_of(kernel, h)};
    return least(&c, most);
}

static bool buckles(uint32_t kernel, double h, uint32_t count, double stretch, double end)
{
    const double dt = 0.4;
    const uint32_t held = (uint32_t)held_of(kernel, h), n = count + 2 * held;
    sph_config c = box_config(n + 2, kernel, h, dt);
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.solid = SPH_UPDATED;
    c.face[0][0] = c.face[0][1] = SPH_OPEN;
    void *arena;
    sph_sim *sim = box_new(&c, &arena);
    sph_solid m = {.mass = 1, .rho0 = 1 + stretch, .sound_speed = 1};
    uint32_t loose, fixed;
    box_must(sim, sph_add_solid(sim, &m, &loose, NULL), "chain");
    m.held = 1;
    box_must(sim, sph_add_solid(sim, &m, &fixed, NULL), "ends");
    for (uint32_t i = 0; i < n; i++) {
        const double x = i + 1.5;
        const bool free_one = i >= held && i < held + count;
        box_must(sim, sph_add_particle(sim, free_one ? loose : fixed, &x, NULL, 1, NULL), "particle");
    }
    box_noise(sim, loose, 1e-9, 1, 5);
    const double first = box_speed(sim);
    bool out = false;
    for (uint32_t s = 0; s < (uint32_t)(end / dt) && !out; s++) {
        out = sph_step(sim) != SPH_OK;
        if (s % 64 == 0)
            out |= !(box_speed(sim) < 100 * first);
    }
    free(arena);
    return out;
}

double tension_running(uint32_t kernel, double h, uint32_t count, double most, double end, double precision)
{
    double low = 0, high = most;
    if (!buckles(kernel, h, count, most, end))
        return TENSION_NONE;
    while (high - low > precision * high && high > 1e-7) {
        const double mid = low > 0 ? sqrt(low * high) : high / 4;
        if (buckles(kernel, h, count, mid, end))
            high = mid;
        else
            low = mid;
    }
    return high;
}

static void figure(FILE *f, double t)
{
    if (t >= TENSION_NONE)
        fputs(",", f);
    else
        fprintf(f, ",%.3g", t);
}

void atlas_tension(FILE *f)
{
    static const double h[] = {1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.8, 2, 2.25, 2.5};
    atlas_head(f, "tension", "critical stretch of a chain of 30 particles in one dimension",
               "empty: stable up to a stretch of 0.2; cholesky, running: the chain of the code between held particles\n"
               "powell: his eq 3.40, n = 4, free ends (figure 3.2); his n is 2 in this code's form, so about half of "
               "the others\n"
               "where a neighbour stands on a rim at which W' jumps there is no linear theory: hat h 1, 1.5, 2, 2.5; "
               "gaussian h 1, 2\n"
               "seen: as cholesky, where the fastest mode grows by 0.00345 c0/dx, which is what runs of 2000 dx/c0 "
               "show",
               "kernel,h,cholesky,running,powell,seen");
    for (uint32_t k = 0; k < SPH_KERNELS; k++)
        for (size_t i = 0; i < sizeof h / sizeof *h; i++) {
            fprintf(f, "%s,%.3g", atlas_kernels[k], h[i]);
            figure(f, tension_cholesky(k, h[i], 30, 0.2, 0));
            figure(f, tension_running(k, h[i], 30, 0.2, END, 0.005));
            figure(f, tension_powell(k, h[i], 30, 0.2));
            figure(f, tension_cholesky(k, h[i], 30, 0.2, TENSION_SEEN / END));
            fputc('\n', f);
            fflush(f);
        }
}
