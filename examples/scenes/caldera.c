/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* caldera.c: rock over a magma chamber is stretched, then the pressure in the chamber rises (Gray 2001 section 7.4). A
   section 7 km wide and 4.9 km high with an elliptical chamber, semi-axes 1.75 km by 0.8 or 1.12 km, its middle 1.4 km
   deep; particles 50 m apart, flaws of radius 75 m. Lengths here are in km: Gray's T = 1e7 (cm/c0), when the ends stop
   and the pressure goes from 5e-5 to 1e-4 rho c0^2, is 100 km/c0. The chamber's pressure is a load on its rim
   (stretch_load): Gray's gas, without what flows into cracks. The flaws: k = 1.4e19 a cm^2, as elsewhere in the thesis;
   the weakest then fails at a strain of 2.5e-4. He writes 6e-4 (k=0 takes that), which the pressure alone never
   reaches. `slow` makes everything slower: stretching and pressure are then the same, but further from sound. Where the
   roof is blown out, the pieces of rock that are not wholly broken are drawn apart until the run ends with
   BOND_TOO_LONG. With Gray's own form (form=updated kernel=cubic alpha=0.5 repulsion=principal damping=1 cfl=0.3
   printed=yes), which is softer at free faces, more breaks: his figures 7.6 and 7.7. */
#include "stretch.h"
#if SPH_DIM == 2

enum { HALF_HEIGHT = BREAK_COMMON, SPACING, BEFORE, AFTER, WEAKEST, AT, RISE, AFTERWARDS, PARAMS };
#define WIDE 7.0
#define HIGH 4.9
#define DEPTH 1.4

static const scene_param param[PARAMS] = {
    SOLID_PARAMS_DAMPED(SPH_WENDLAND_C2, 1.5, 0, 0, SPH_KICK_DRIFT_KICK, 0.8, SPH_TOTAL, SPH_NO_ARTIFICIAL_STRESS, 0.85,
                        0.01, 0.999),
    STRETCH_PARAMS(5e-6, 10, 100),
    BREAK_PARAMS(SPH_BENZ_ASPHAUG_GRAY, 1.4e29, 0.075),
    {"high", "km", "semi-axis of the chamber upwards", 0.8, 0.1, 1.3, SCENE_NUMBER},
    {"spacing", "km", "of the particles", 0.05, 0.001, 0.5, SCENE_NUMBER},
    {"before", "rho c0^2", "pressure in the chamber at first", 5e-5, 0, 1, SCENE_NUMBER},
    {"after", "rho c0^2", "and later", 1e-4, 0, 1, SCENE_NUMBER},
    {"weakest", "-", "strain at which the weakest flaw fails, if k is 0", 6e-4, 1e-9, 1, SCENE_NUMBER},
    {"at", "km/c0", "when the pressure begins to rise", 100, 0, 1e6, SCENE_NUMBER},
    {"rise", "km/c0", "how long each rise of the pressure takes", 0.5, 1e-3, 1e6, SCENE_NUMBER},
    {"afterwards", "km/c0", "how long the run goes on after that", 60, 0, 1e6, SCENE_NUMBER},
};

static stretch block(const double *p)
{
    return (stretch){.lo = {-WIDE / 2, -HIGH}, .hi = {WIDE / 2, 0}, .dx = p[SPACING], .room = 0.5, .has_hole = true,
                     .hole = {{0, -DEPTH}, {1.75, p[HALF_HEIGHT]}}};
}

static double pressure(const double *p, double t)
{
    const double s = t / p[STRETCH_SLOW], rise = p[RISE], first = s < rise ? s / rise : 1;
    const double then = s < p[AT] ? 0 : s < p[AT] + rise ? (s - p[AT]) / rise : 1;
    return p[BEFORE] * first + (p[AFTER] - p[BEFORE]) * then;
}

static void load(void *ctx, double t, const double *x, const double *v, double *a)
{
    const stretch b = block(ctx);
    (void)v;
    stretch_load(&b, pressure(ctx, t), x, a);
}

static void configure(const double *p, sph_config *c)
{
    const stretch b = block(p);
    stretch_configure(p, &b, c);
    break_configure(p, c);
    c->max_stretch = 1.5;
    c->body_force = load;
    c->body_ctx = (void *)p; // NOLINT: read only
}

static sph_status build(sph_sim *sim, const double *p)
{
    const stretch b = block(p);
    const double volume = WIDE * HIGH - SCENE_PI * b.hole.radius[0] * b.hole.radius[1];
    const double k = p[BREAK_K] > 0 ? p[BREAK_K] : sph_pow(p[WEAKEST], -p[BREAK_M]) / volume;
    const sph_flaws flaws = {k, p[BREAK_M], (uint64_t)p[BREAK_SEED]};
    sph_solid rock = solid_material(p);
    rock.crack_speed = p[BREAK_CRACK];
    rock.flaw_radius = p[BREAK_RADIUS];
    return stretch_build(sim, p, &b, &rock, p[BREAK_DAMAGE] > 0 ? &flaws : NULL);
}

static double end(const double *p) { return (p[AT] + p[AFTERWARDS]) * p[STRETCH_SLOW]; }

static const char *const column[] = {"time",   "strain",      "pressure",       "p1_K",   "kinetic",      "elastic",
                                     "plastic_work",
                                     "peak_K", "damage_mean", "full_particles", "full_x", "full_surface", "full_left",
                                     "full_right",
                                     "full_below", "dome_km"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const stretch b = block(p);
    const double t = sph_time(sim);
    double surface = 0, left = 0, right = 0, below = 0, dome = -HIGH;
    stretch_broken d;
    sph_totals o;
    sph_particle q;
    sph_get_totals(sim, &o);
    stretch_look(sim, &b, &d);
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || q.set != STRETCH_ROCK)
            continue;
        if (SCENE_ABS(q.x[0]) < 0.2 && q.x[1] > dome)
            dome = q.x[1];
        if (!(q.damage > 0.99))
            continue;
        if (q.x[1] > -0.5 * (DEPTH - p[HALF_HEIGHT]) && SCENE_ABS(q.x[0]) < 0.875)
            surface++; /* the upper half of the roof over the middle */
        else if (q.x[1] > -DEPTH)
            *(q.x[0] < 0 ? &left : &right) += 1;
        else
            below++;
    }
    const double strain = 2 * stretch_drawn(p, t) / WIDE, p1 = stretch_end_stress(sim, 0.45 * WIDE);
    const double values[] = {t, strain, pressure(p, t), p1, o.kinetic, o.elastic + o.internal, o.plastic_work,
                             stretch_peak(sim),
                             d.mean, d.full, d.x, surface, left, right, below, dome + 0.5 * b.dx};
    for (unsigned i = 0; i < sizeof values / sizeof *values; i++)
        row[i] = values[i];
}

#define scene_caldera SPH_NAME(scene_caldera)
extern const scene scene_caldera;
const scene scene_caldera = {"caldera", "faults over a magma chamber in stretched rock (Gray 2001 section 7.4)", param,
                             PARAMS, configure, build, end, sizeof column / sizeof *column, column,
                             history, scene_gray_km};
#endif
