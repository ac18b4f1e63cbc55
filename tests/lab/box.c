/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* box.c: see box.h. */
#include "box.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sph/dmath.h"

void box_must(const sph_sim *sim, sph_status s, const char *what)
{
    if (s == SPH_OK)
        return;
    fprintf(stderr, "atlas: %s: %s: %s = %g (%s)\n", what, sph_status_text(s), sph_last(sim)->what,
            sph_last(sim)->value,
            sph_last(sim)->allowed);
    exit(1);
}

sph_sim *box_new(const sph_config *c, void **arena)
{
    sph_report r;
    sph_sim *sim = NULL;
    const size_t bytes = sph_arena_bytes(c);
    *arena = NULL;
    if (bytes == 0)
        sph_config_check(c, &r);
    else
        *arena = aligned_alloc(SPH_ALIGN, (bytes + SPH_ALIGN - 1) / SPH_ALIGN * SPH_ALIGN);
    if (!*arena || sph_init(&sim, c, *arena, bytes, &r) != SPH_OK) {
        fprintf(stderr, "atlas: %s\n", bytes ? "no memory" : sph_status_text(r.status));
        if (!bytes)
            fprintf(stderr, "atlas: %s = %g, allowed: %s\n", r.what, r.value, r.allowed);
        exit(1);
    }
    return sim;
}

sph_config box_config(uint32_t n, uint32_t kernel, double h, double dt)
{
    sph_config c = sph_config_default();
    c.kernel = kernel;
    c.spacing = 1;
    c.smoothing_length = h;
    c.sound_speed = 1;
    c.rho0 = 1;
    c.eos = SPH_LINEAR;
    c.viscosity = SPH_INVISCID;
    c.alpha = c.beta = 0;
    c.on_leave = SPH_FAIL;
    c.dt = dt;
    c.max_particles = 1;
    for (int k = 0; k < SPH_DIM; k++) {
        c.hi[k] = n;
        c.face[k][0] = c.face[k][1] = SPH_PERIODIC;
        c.max_particles *= n;
    }
    return c;
}

uint32_t box_side(uint32_t kernel, double h, double stretch, uint32_t least)
{
    const uint32_t n = (uint32_t)ceil(3 * h * stretch * sph_kernel_support(kernel) + 1e-3); /* three cells */
    return (n > least ? n + 1 : least + 1) / 2 * 2;
}

typedef struct start {
    sph_rng rng;
    double speed, rho, mean[SPH_DIM], at;
    uint32_t seen;
} start;

/* the first round sums up what the second gives, less the mean */
static void draw(void *ctx, const double *x, double *v, double *rho)
{
    start *s = ctx;
    (void)x;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = s->speed * (2 * sph_rng_uniform(&s->rng) - 1) - s->mean[k];
    *rho = s->rho;
    s->seen++;
}

void box_noise(sph_sim *sim, uint32_t set, double speed, double rho, uint64_t seed)
{
    start s = {.speed = speed, .rho = rho};
    sph_totals t;
    for (int turn = 0; turn < 2; turn++) {
        sph_rng_seed(&s.rng, seed, 1);
        box_must(sim, sph_apply_field(sim, set, draw, &s), "noise");
        sph_get_totals(sim, &t);
        for (int k = 0; k < SPH_DIM && turn == 0; k++)
            s.mean[k] = t.mass > 0 ? t.momentum[k] / t.mass : 0;
    }
}

static void kick_one(void *ctx, const double *x, double *v, double *rho)
{
    const start *s = ctx;
    bool here = true;
    for (int k = 0; k < SPH_DIM; k++)
        here &= x[k] > s->at - 0.51 && x[k] < s->at + 0.49;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = here ? s->speed * (k ? 0.6 : 1) : 0;
    *rho = s->rho;
}

void box_push(sph_sim *sim, uint32_t set, double n, double speed, double rho)
{
    start s = {.speed = speed, .rho = rho, .at = 0.5 * n};
    box_must(sim, sph_apply_field(sim, set, kick_one, &s), "push");
}

double box_speed(const sph_sim *sim)
{
    sph_totals t;
    double mean2 = 0;
    sph_get_totals(sim, &t);
    for (int k = 0; k < SPH_DIM; k++)
        mean2 += t.momentum[k] * t.momentum[k] / (t.mass * t.mass);
    const double v2 = 2 * t.kinetic / t.mass - mean2;
    return v2 > 0 ? sqrt(v2) : 0;
}

double box_nearest(const sph_sim *sim, double n, double *mean)
{
    const uint32_t count = sph_count(sim);
    double least = 1e300, sum = 0;
    sph_particle a, b;
    for (uint32_t i = 0; i < count; i++) {
        double own = 1e300;
        box_must(sim, sph_get(sim, i, &a), "nearest");
        for (uint32_t j = 0; j < count; j++) {
            double r2 = 0;
            box_must(sim, sph_get(sim, j, &b), "nearest");
            for (int k = 0; k < SPH_DIM; k++) {
                double d = fabs(a.x[k] - b.x[k]);
                d = d > 0.5 * n ? n - d : d;
                r2 += d * d;
            }
            own = i != j && r2 < own ? r2 : own;
        }
        least = own < least ? own : least;
        sum += sqrt(own);
    }
    if (mean)
        *mean = sum / count;
    return sqrt(least);
}

uint32_t box_neighbours(uint32_t kernel, uint32_t lattice, double h)
{
    const double reach = h * sph_kernel_support(kernel);
    const int m = (int)ceil(reach) + 1;
    uint32_t count = 0;
    for (int i = -m; i <= m; i++)
        for (int j = SPH_DIM > 1 ? -m : 0; j <= (SPH_DIM > 1 ? m : 0); j++) {
            const double x = i + (lattice == SPH_LATTICE_SHIFTED_X && j % 2 ? 0.5 : 0), y = j;
            count += x * x + y * y < reach * reach;
        }
    return count;
}

/* least squares over samples that are kept, as the end is not known beforehand */
double box_growth(sph_sim *sim, double dt, double end, double least)
{
    enum { MOST = 4096 };
    double log_v[MOST];
    const uint32_t steps = (uint32_t)(end / dt + 0.5), every = (steps + MOST - 1) / MOST;
    uint32_t n = 0;
    for (uint32_t s = 0; s < steps; s++) {
        if (sph_step(sim) != SPH_OK)
            break;
        if ((s + 1) % every == 0 && n < MOST) {
            const double v = box_speed(sim);
            log_v[n++] = v > 0 ? log(v) : -700;
            if (v > 1e-3)
                break;
        }
    }
    if (n < 8)
        return 0;
    double st = 0, sl = 0, stt = 0, stl = 0, m = 0;
    for (uint32_t k = 2 * n / 3; k < n; k++) {
        const double t = dt * every * (k + 1);
        st += t;
        sl += log_v[k];
        stt += t * t;
        stl += t * log_v[k];
        m += 1;
    }
    const double rate = (m * stl - st * sl) / (m * stt - st * st);
    return rate < least || log_v[n - 1] - log_v[3 * n / 4] < 0.5 * least * dt * every * (n / 4) ? 0 : rate;
}

double box_ratio(sph_sim *sim, uint32_t steps)
{
    const double first = box_speed(sim);
    double second = 0, last = 0;
    for (uint32_t s = 1; s <= steps; s++) {
        if (sph_step(sim) != SPH_OK)
            return 1e300;
        if (s % 4)
            continue;
        const double v = box_speed(sim);
        if (!(v < 1e4 * first))
            return 1e300;
        second = s > steps / 4 && s <= steps / 2 && v > second ? v : second;
        last = s > 3 * steps / 4 && v > last ? v : last;
    }
    return second > 0 ? last / second : 0;
}

#if SPH_DIM == 2
sph_sim *box_make_solid(const box_solid *b, uint32_t *set, void **arena)
{
    sph_config c = box_config(b->n, b->kernel, b->h, b->dt);
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.solid = b->form;
    c.max_stretch = 1.2;
    if (b->alpha > 0) {
        c.viscosity = SPH_ARTIFICIAL;
        c.alpha = b->alpha;
    }
    c.xsph = b->xsph;
    c.xsph_velocity = b->xsph > 0;
    if (b->epsilon > 0) {
        c.artificial_stress = SPH_PRINCIPAL;
        c.stress_epsilon = b->epsilon;
        c.stress_exponent = b->exponent;
    }
    sph_sim *sim = box_new(&c, arena);
    const sph_solid m = {.mass = 1, .rho0 = b->volume, .sound_speed = 1, .shear = b->mu};
    const sph_shape s = {.hi = {b->n, b->n}, .lattice = b->lattice};
    box_must(sim, sph_add_solid(sim, &m, set, NULL), "solid");
    box_must(sim, sph_add_shape(sim, *set, &s), "lattice");
    return sim;
}
#endif
