/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* block.c: a block with flaws is drawn apart until it breaks: whole, with a circular hole, or with gas in the hole
   (Gray 2001 section 7.2). 7 by 7 cm, a^2 = 0.3125 cm^2, particles 0.05 cm apart, gas p = rho c^2 with c = c0/80.
   Gray's text gives V_f = 1e-5, his figure 1e-4; with the latter the strain at his first fractures, T 250, 105, 80, is
   that of the flaws. He prints a yield stress of 0.01, which the stress reaches before the flaws: with yield=0.01 the
   block flows and hardly breaks. Gas beside rock shares its sums, so that the rock's outermost row feels only part of
   its own strain; `load` puts the same pressure on the rim instead. */
#include "stretch.h"
#if SPH_DIM == 2

enum { KIND = BREAK_COMMON, N, SIZE, SQUARE, GAS, PARAMS };
enum { WHOLE, WITH_HOLE, WITH_GAS, WITH_LOAD };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_WENDLAND_C2, 1.5, 0, 0, SPH_KICK_DRIFT_KICK, 0.8, SPH_TOTAL, SPH_NO_ARTIFICIAL_STRESS, 0.85, 0),
    STRETCH_PARAMS(1e-4, 10, 0),
    BREAK_PARAMS(SPH_BENZ_ASPHAUG, 1.4e19, 0),
    {"kind", "-", "whole, with a hole, with gas in that, or its pressure as a load: whole hole gas load", WITH_HOLE, 0,
     3, SCENE_CHOICE},
    {"n", "-", "particles across the block, an even number", 140, 20, 4000, SCENE_WHOLE},
    {"size", "cm", "edge of the block", 7, 0.1, 1e3, SCENE_NUMBER},
    {"square", "cm^2", "radius of the hole, squared", 0.3125, 1e-6, 1e5, SCENE_NUMBER},
    {"gas", "c0", "sound speed of the gas", 0.0125, 1e-6, 1, SCENE_NUMBER},
};

static stretch block(const double *p)
{
    const double a = __builtin_sqrt(p[SQUARE]), dx = p[SIZE] / p[N], half = p[SIZE] / 2;
    return (stretch){.lo = {-half, -half}, .hi = {half, half}, .dx = dx, .room = 0.1 * p[SIZE],
                     .has_hole = p[KIND] != WHOLE,
                     .has_gas = p[KIND] == WITH_GAS, .hole = {{0, 0}, {a, a}},
                     .gas = {.sound_speed = p[GAS], .own_eos = true, .eos = SPH_ISOTHERMAL}};
}

static void load(void *ctx, double t, const double *x, const double *v, double *a)
{
    const double *p = ctx;
    const stretch b = block(p);
    (void)t;
    (void)v;
    stretch_load(&b, p[GAS] * p[GAS], x, a);
}

static void configure(const double *p, sph_config *c)
{
    const stretch b = block(p);
    stretch_configure(p, &b, c);
    break_configure(p, c);
    if (p[KIND] == WITH_LOAD) {
        c->body_force = load;
        c->body_ctx = (void *)p; // NOLINT: read only
    }
    c->max_stretch = 1.2;
}

static sph_status build(sph_sim *sim, const double *p)
{
    const stretch b = block(p);
    const sph_flaws flaws = {p[BREAK_K], p[BREAK_M], (uint64_t)p[BREAK_SEED]};
    sph_solid rock = solid_material(p);
    rock.crack_speed = p[BREAK_CRACK];
    rock.flaw_radius = p[BREAK_RADIUS];
    return stretch_build(sim, p, &b, &rock, p[BREAK_DAMAGE] > 0 ? &flaws : NULL);
}

static double end(const double *p) { return 0.03 * p[STRETCH_SLOW] / p[STRETCH_SPEED]; } /* at a strain of 0.06/size */

static const char *const column[] = {"time",         "strain",          "p1_K",       "kinetic",     "elastic",
                                     "plastic_work", "peak_K",          "hoop_over_exact", "gas_mean_p", "damage_mean",
                                     "full_particles", "full_x",        "full_y",     "full_from_rim"};

/* what the hoop stress at top and bottom of the hole is, over 3.0546 p1 + p (tests/refdata/fe_hole.csv; p adds p) */
static double hoop(const sph_sim *sim, const stretch *b, double p1, double gas)
{
    double sum = 0, s[3];
    for (int k = 0; k < 2; k++) {
        const double at[2] = {0, k ? b->hole.radius[1] : -b->hole.radius[1]};
        stretch_sample(sim, b, at, 3 * b->dx, s);
        sum += s[0] / 2;
    }
    const double exact = 3.0546 * p1 + gas;
    return SCENE_ABS(exact) > 0 ? sum / exact : 0;
}

static double gas_pressure(const sph_sim *sim)
{
    double sum = 0, n = 0;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.set == STRETCH_GAS) {
            sum += q.p;
            n++;
        }
    return n > 0 ? sum / n : 0;
}

static void history(const sph_sim *sim, const double *p, double *row)
{
    const stretch b = block(p);
    const double p1 = stretch_end_stress(sim, 0.4 * p[SIZE]);
    const double gas = p[KIND] == WITH_LOAD ? p[GAS] * p[GAS] : gas_pressure(sim);
    stretch_broken d;
    sph_totals o;
    sph_get_totals(sim, &o);
    stretch_look(sim, &b, &d);
    const double t = sph_time(sim);
    const double values[] = {t, 2 * stretch_drawn(p, t) / p[SIZE], p1, o.kinetic, o.elastic + o.internal,
                             o.plastic_work,
                             stretch_peak(sim), b.has_hole ? hoop(sim, &b, p1,
                                 gas) : 0, gas, d.mean, d.full, d.x, d.y, d.near};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_block SPH_NAME(scene_block)
extern const scene scene_block;
const scene scene_block = {"block",
    "a block with flaws, with or without a hole, is drawn until it breaks (Gray 2001 section 7.2)",
                           param, PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                           history, scene_gray};
#endif
