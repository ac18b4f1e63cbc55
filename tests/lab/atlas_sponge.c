/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_sponge.c: how much of a wave comes back from a sponge layer (sph/sponge.c) at the end of a line of particles.
   Compiled for one dimension, double.

   A wave starts to the right, v = c (rho - rho0)/rho0 = u(x), in water between mirror faces or in a bar in the
   total-Lagrangian form with free ends. u is so small that all is linear: a packet, one swing without a mean (the slope
   of a Gaussian), or a pulse of one sign. The layer is `width` spacings at the high face. When what its end throws back
   is where it all began, the energy of waves to the left, sum of m ((v + sigma/(rho0 c))/2)^2, is taken outside the
   layer, over what it was of waves to the right. Theory: v_t = -p_x/rho - r s^2 v leaves exp(-2/3 rate width/c) of the
   energy on the way in and out where the layer is long against the wave. Waves that are long against it see a
   resistance of rho r w/3 before the end: all comes back from a fixed end, and from a free one nothing where that is
   rho c, at a rate of 3. A pulse of one sign is made of such waves. */
#include "atlas.h"
#include "box.h"

#include <math.h>
#include <stdlib.h>

enum { BEGIN = 130, FREE = 220 }; /* middle of the wave, and length before the layer, spacings */
#define DT 0.4
#define SMALL 1e-5

static void set_wave(void *ctx, const double *x, double *v, double *rho)
{
    const sponge_case *c = ctx;
    const double d = x[0] - BEGIN, width = c->wave == SPONGE_PACKET ? 12 : 3, g = exp(-d * d / (2 * width * width));
    v[0] = SMALL * g;
    if (c->wave == SPONGE_PACKET)
        v[0] *= cos(2 * 3.14159265358979323846 / 12 * d);
    if (c->wave == SPONGE_SWING)
        v[0] *= d / width;
    *rho = 1 + v[0];
}

/* energies of waves to the right and to the left, outside the layer */
static void add_up(const sph_sim *sim, double *right, double *left)
{
    sph_particle p;
    *right = *left = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        box_must(sim, sph_get(sim, i, &p), "energy");
        const double a = 0.5 * (p.v[0] - p.stress[0]), b = 0.5 * (p.v[0] + p.stress[0]);
        *right += p.x[0] < FREE ? p.mass * a * a : 0;
        *left += p.x[0] < FREE ? p.mass * b * b : 0;
    }
}

double sponge_reflected(const sponge_case *c)
{
    const uint32_t n = FREE + c->width, steps = (uint32_t)((2 * (FREE - BEGIN) + 2 * c->width) / DT + 0.5);
    sph_config g = box_config(n, SPH_WENDLAND_C2, 1.2, DT);
    g.integrator = SPH_KICK_DRIFT_KICK;
    g.face[0][0] = g.face[0][1] = c->medium == SPONGE_BAR ? SPH_OPEN : SPH_SYMMETRY;
    g.solid = c->medium == SPONGE_BAR ? SPH_TOTAL : SPH_NO_SOLID;
    g.sponge_high[0] = c->rate > 0 ? c->width : 0;
    g.sponge_rate = c->rate / c->width;
    void *arena;
    sph_sim *sim = box_new(&g, &arena);
    const sph_solid bar = {.mass = 1, .rho0 = 1, .sound_speed = 1};
    uint32_t set;
    sponge_case own = *c;
    double right, left, came, none;
    box_must(sim, g.solid ? sph_add_solid(sim, &bar, &set, NULL) : sph_add_fluid(sim, NULL, &set), "set");
    for (uint32_t i = 0; i < n; i++) {
        const double x = i + 0.5;
        box_must(sim, sph_add_particle(sim, set, &x, NULL, 1, NULL), "particle");
    }
    box_must(sim, sph_apply_field(sim, set, set_wave, &own), "wave");
    add_up(sim, &came, &none);
    for (uint32_t s = 0; s < steps; s++)
        box_must(sim, sph_step(sim), "step");
    add_up(sim, &right, &left);
    free(arena);
    return left / came;
}

double sponge_theory(const sponge_case *c) { return exp(-2 * c->rate / 3); }

void atlas_sponge(FILE *f)
{
    static const char *const media[] = {"water", "bar"}, *const waves[] = {"packet", "swing", "pulse"};
    static const uint32_t widths[] = {5, 10, 20, 40};
    static const double rates[] = {0, 1, 2, 3, 5, 8, 12, 20};
    atlas_head(f, "sponge", "energy that comes back from a sponge layer",
               "one dimension, Wendland C2, h 1.2, kick-drift-kick; packet: waves of 12 dx in a Gaussian of\n"
               "sigma 12 dx; swing: slope of a Gaussian, sigma 3 dx; pulse: that Gaussian; water ends at a mirror,\n"
               "the bar free; width in spacings; rate: sponge_rate width/c; reflected, through: shares of the energy,\n"
               "measured, and of what goes in, to the end and out again, exp(-2/3 rate)",
               "medium,wave,width,rate,reflected,through");
    for (uint32_t m = 0; m < 2; m++)
        for (uint32_t wave = 0; wave < SPONGE_WAVES; wave++)
            for (size_t w = 0; w < sizeof widths / sizeof *widths; w++)
                for (size_t r = 0; r < sizeof rates / sizeof *rates; r++) {
                    const sponge_case c = {m, widths[w], wave, rates[r]};
                    fprintf(f, "%s,%s,%u,%g,%.3g,%.3g\n", media[m], waves[wave], c.width, c.rate,
                            sponge_reflected(&c), sponge_theory(&c));
                    fflush(f);
                }
}
