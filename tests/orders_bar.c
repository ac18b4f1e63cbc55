/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* orders_bar.c: the first longitudinal mode of a free bar in 1-D, in every form of the solid's equations: how far its
   frequency is off c/(2 L), by the number of particles. Rows for tests/orders.py: form, n, frequency/exact - 1. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "sph/sph.h"

#define PI 3.14159265358979323846
#define LENGTH 1.0 /* m */
#define SOUND 10.0 /* m/s */

static void mode(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx, (void)rho;
    v[0] = 1e-4 * SOUND * cos(PI * x[0] / LENGTH);
}

/* the part of the velocity that is the mode */
static double part(const sph_sim *sim)
{
    sph_particle p;
    double sum = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &p) == SPH_OK)
            sum += p.v[0] * cos(PI * (p.id + 0.5) / sph_count(sim));
    return sum;
}

/* from the first time that the mode's velocity is 0 to the fifth: two periods */
static double frequency(sph_sim *sim)
{
    double t0 = 0, p0 = part(sim), first = 0;
    for (int crossings = 0; crossings < 5;) {
        if (sph_step(sim) != SPH_OK)
            return NAN;
        const double t = sph_time(sim), p = part(sim);
        if ((p < 0) != (p0 < 0)) {
            const double at = t0 + (t - t0) * p0 / (p0 - p);
            if (crossings++ == 0)
                first = at;
            else if (crossings == 5)
                return 2 / (at - first);
        }
        t0 = t;
        p0 = p;
    }
    return NAN;
}

static int bar(uint32_t form, const char *name, uint32_t n)
{
    static _Alignas(SPH_ALIGN) unsigned char arena[1 << 22];
    const double lo = 0, hi = LENGTH;
    const sph_solid steel = {.sound_speed = SOUND};
    sph_config c = sph_config_default();
    sph_sim *sim;
    sph_report r;
    uint32_t set;
    c.spacing = LENGTH / n;
    c.smoothing_length = 1.3 * c.spacing;
    c.sound_speed = SOUND;
    c.lo[0] = -0.5;
    c.hi[0] = 1.5;
    c.solid = form;
    c.viscosity = SPH_INVISCID;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.cfl = 0.1;
    c.max_particles = n;
    if (sph_init(&sim, &c, arena, sizeof arena, &r) || sph_add_solid(sim, &steel, &set, NULL) ||
        sph_add_box(sim, set, &lo, &hi, NULL) || sph_apply_field(sim, set, mode, NULL)) {
        fprintf(stderr, "orders_bar: %s, n %u: %s\n", name, n, r.what);
        return 1;
    }
    printf("%s,%u,%.9g\n", name, n, frequency(sim) / (SOUND / (2 * LENGTH)) - 1);
    return 0;
}

int main(void)
{
    static const char *const names[] = {"", "updated", "corrected", "total"};
    int bad = 0;
    for (uint32_t form = SPH_UPDATED; form <= SPH_TOTAL; form++)
        for (uint32_t n = 10; n <= 160; n *= 2)
            bad |= bar(form, names[form], n);
    return bad;
}
