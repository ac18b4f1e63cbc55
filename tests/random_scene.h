/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* random_scene.h: small scenes that a number draws: every choice of the configuration, every kind of wall, fluids and
   solids, faces of every kind, motions, gates, flaws, sponges, shifting, inflows and outflows. Two calls with one
   number make the same scene. */
#ifndef SPH_RANDOM_SCENE_H
#define SPH_RANDOM_SCENE_H

#include "testing.h"

#define RANDOM_DX 0.1
#define RANDOM_CELLS (SPH_DIM == 1 ? 40u : SPH_DIM == 2 ? 10u : 5u) /* spacings along an edge */

static struct {
    sph_rng dice;
    double sway; /* m/s */
} scene;

static UNUSED double scene_toss(double low, double high) { return low + (high - low) * sph_rng_uniform(&scene.dice); }
static UNUSED uint32_t scene_draw(uint32_t n) { return (uint32_t)(sph_rng_uniform(&scene.dice) * n); }
static UNUSED bool scene_one_in(uint32_t n) { return scene_draw(n) == 0; }

static UNUSED void scene_motion(void *ctx, double t, double *x, double *v)
{
    (void)ctx;
    x[0] = 0.05 * RANDOM_DX * sph_sin(60 * t);
    v[0] = 0.05 * RANDOM_DX * 60 * sph_cos(60 * t);
}
static UNUSED void scene_body(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx;
    for (int k = 0; k < SPH_DIM; k++)
        a[k] += sph_sin(x[k] + t) - 0.1 * v[k];
}

/* what the choices of fluids ask of each other is kept */
static UNUSED void scene_fluids(sph_config *c)
{
    c->scheme = scene_draw(SPH_SCHEMES);
    c->eos = c->scheme > SPH_DIRECT ? SPH_ISOTHERMAL : scene_draw(SPH_IDEAL_GAS); /* a gas: random_build */
    c->density = scene_one_in(4) ? SPH_SUMMATION : SPH_CONTINUITY;
    c->shifting = scene_one_in(3) ? scene_toss(0.2, 2) : 0;
    c->shear = c->viscosity != SPH_MORRIS && scene_one_in(3) ? 1 + scene_draw(SPH_SHEARS - 1) : SPH_NO_SHEAR;
    if (c->density == SPH_CONTINUITY) {
        c->diffusion = scene_draw(SPH_DIFFUSIONS);
        c->shepard_every = scene_one_in(3) ? 2 : 0;
        c->filter = scene_draw(SPH_FILTERS);
        c->filter_period = scene_one_in(5) ? 1.5e-3 : 0;
        c->gradient = scene_one_in(3) && (c->scheme == SPH_STANDARD || c->scheme == SPH_WEAK) ? 1 + scene_draw(2) : 0;
        c->energy = SPH_WITH_ENERGY && c->gradient != SPH_RENORMALISED && scene_one_in(4);
    }
}

static UNUSED void scene_solids(sph_config *c)
{
    c->solid = SPH_UPDATED + scene_draw(3);
    c->scheme = scene_one_in(3) ? SPH_WEAK : SPH_STANDARD;
    c->eos = SPH_TAIT;
    c->diffusion = scene_draw(SPH_ANTUONO); /* which is of fluids alone */
    c->yield = scene_draw(SPH_YIELDS);
    c->damage = SPH_DIM > 1 ? scene_draw(SPH_DAMAGES) : 0;
    c->max_flaws = 20000;
    c->artificial_stress = c->solid == SPH_TOTAL ? 0 : scene_draw(SPH_ARTIFICIAL_STRESSES);
    c->xsph_strain = c->xsph > 0 && scene_one_in(2);
    c->max_stretch = 2;
}

static UNUSED void scene_box(sph_config *c)
{
    const double edge = RANDOM_CELLS * RANDOM_DX;
    const double cell = sph_kernel_support(c->kernel) * c->smoothing_length * (c->solid == SPH_TOTAL ? 2 : 1);
    for (int k = 0; k < SPH_DIM; k++) {
        const uint32_t face = scene_draw(SPH_FACES + 2);
        c->lo[k] = -7 * RANDOM_DX;
        c->hi[k] = edge + 7 * RANDOM_DX;
        if (face < SPH_FACES && face > SPH_OPEN && (face != SPH_PERIODIC || edge > 3.01 * cell)) {
            c->lo[k] = 0;
            c->hi[k] = edge;
            c->face[k][0] = c->face[k][1] = face;
        }
        if (c->face[k][0] != SPH_PERIODIC && scene_one_in(6)) {
            c->sponge_low[k] = 3 * RANDOM_DX;
            c->sponge_rate = 50;
        }
    }
    c->gravity[SPH_DIM - 1] = c->face[SPH_DIM - 1][0] == SPH_PERIODIC ? 0 : -9.81;
}

static UNUSED sph_config random_config(uint32_t number)
{
    sph_config c = sph_config_default();
    sph_rng_seed(&scene.dice, 77, number);
    c.kernel = scene_draw(SPH_KERNELS);
    c.viscosity = scene_draw(SPH_VISCOSITIES);
    c.integrator = scene_draw(SPH_INTEGRATORS);
    c.xsph = scene_one_in(2) ? 0.5 : 0;
    c.books = scene_one_in(2);
    c.pressure_floor = scene_one_in(2);
    c.damping = scene_one_in(4) ? 0.99 : 1;
    c.dt = scene_one_in(4) ? 1e-4 : 0;
    c.alpha = 0.05;
    c.beta = scene_one_in(2) ? 0.1 : 0;
    c.nu = 0.01;
    c.spacing = RANDOM_DX;
    c.smoothing_length = scene_toss(1, 1.3) * RANDOM_DX;
    c.sound_speed = 20;
    c.on_leave = SPH_REMOVE;
    c.on_cross = scene_one_in(4) ? SPH_REMOVE : scene_one_in(3) ? SPH_IGNORE : SPH_PUT_BACK;
    c.body_force = scene_one_in(4) ? scene_body : NULL;
    if (scene_one_in(2))
        scene_solids(&c);
    else
        scene_fluids(&c);
    scene_box(&c);
    if (c.solid == SPH_NO_SOLID && c.integrator < SPH_RUNGE_KUTTA && c.density == SPH_CONTINUITY &&
        c.scheme <= SPH_DIRECT && !c.energy)
        c.damper = number % 3 ? 0 : 0.2;
    c.damping_rate = number % 5 == 1 ? 20 : 0;
    c.xsph_velocity = c.xsph > 0 && !c.xsph_strain && number % 4 == 2;
    c.face_quadrature = SPH_DIM > 1 && c.solid >= SPH_CORRECTED && number % 2;
    if (number % 3 == 1 && c.density == SPH_CONTINUITY && c.face[0][0] == SPH_OPEN && !c.energy)
        c.max_flows = 2;
    c.max_particles = SPH_DIM == 1 ? 200 : SPH_DIM == 2 ? 900 : 3500;
    return c;
}

/* a set that fills the layer low .. high (in spacings along the last axis) with jittered particles that move */
static UNUSED void scene_fill(sph_sim *sim, uint32_t set, uint32_t low, uint32_t high)
{
    uint32_t n[3] = {RANDOM_CELLS, SPH_DIM > 1 ? RANDOM_CELLS : 1, SPH_DIM > 2 ? RANDOM_CELLS : 1}, i[3];
    for (i[2] = 0; i[2] < n[2]; i[2]++)
        for (i[1] = 0; i[1] < n[1]; i[1]++)
            for (i[0] = 0; i[0] < n[0]; i[0]++) {
                double x[SPH_DIM], v[SPH_DIM];
                for (int k = 0; k < SPH_DIM; k++) {
                    x[k] = (i[k] + scene_toss(0.4, 0.6)) * RANDOM_DX;
                    v[k] = scene_toss(-0.5, 0.5);
                }
                if (i[SPH_DIM - 1] >= low && i[SPH_DIM - 1] < high)
                    must(sim, sph_add_particle(sim, set, x, v, scene_toss(995, 1005), NULL));
            }
}

static UNUSED uint32_t scene_rock(sph_sim *sim, const sph_config *c, bool held)
{
    sph_solid rock = {.shear = 1e5, .yield = c->yield ? 2e3 : 0, .hardening = 5e3};
    uint32_t set;
    rock.flat_faces = c->face_quadrature;
    if (held) {
        rock.held = 1 + scene_draw((1u << SPH_DIM) - 1);
        rock.motion = scene_one_in(2) ? scene_motion : NULL;
    }
    rock.body = scene_draw(2);
    must(sim, sph_add_solid(sim, &rock, &set, NULL));
    return set;
}

static UNUSED void scene_walls(sph_sim *sim, const sph_config *c)
{
    sph_wall w = sph_wall_default();
    double lo[SPH_DIM], hi[SPH_DIM];
    uint32_t faces = 0, group;
    w.kind = scene_draw(SPH_WALLS + 1);
    w.no_slip = scene_one_in(2);
    w.compressible = scene_one_in(2) && c->density == SPH_CONTINUITY;
    w.motion = scene_one_in(2) ? scene_motion : NULL;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        lo[k] = 0;
        hi[k] = RANDOM_CELLS * RANDOM_DX;
        if (c->face[k][0] != SPH_OPEN && w.kind < SPH_WALL_GHOST) /* rows of these end on the faces */
            w.kind = SPH_WALL_GHOST;
        else if (c->face[k][0] == SPH_OPEN)
            faces |= SPH_LOW(k) | (scene_one_in(2) ? SPH_HIGH(k) : 0);
    }
    if (!faces || w.kind == SPH_WALLS)
        return;
    must(sim, sph_add_wall_box(sim, &w, lo, hi, faces, true, &group));
    if (scene_one_in(4))
        must(sim, sph_remove_wall_at(sim, group, scene_toss(0, 4e-3)));
}

/* water comes in before the low face of the first axis and goes out before the high one */
static UNUSED void scene_flows(sph_sim *sim, uint32_t water)
{
    sph_flow f = {.face = SPH_HIGH(0), .speed = scene_toss(0.5, 6)};
    uint32_t set;
    for (int k = 0; k < SPH_DIM; k++)
        f.hi[k] = RANDOM_CELLS * RANDOM_DX;
    f.lo[0] = -5 * RANDOM_DX;
    f.hi[0] = 0;
    must(sim, sph_add_inflow(sim, water, &f, &set));
    f.face = SPH_LOW(0);
    f.hi[0] = RANDOM_CELLS * RANDOM_DX;
    f.lo[0] = f.hi[0] - 5 * RANDOM_DX;
    must(sim, sph_add_outflow(sim, water, &f, &set));
}

/* sets, particles, walls of the scene of a configuration that was made by random_config just before */
static UNUSED void random_build(sph_sim *sim, const sph_config *c)
{
    const uint32_t half = RANDOM_CELLS / 2;
    uint32_t low, high;
    if (!c->solid || scene_one_in(4))
        must(sim, sph_add_fluid(sim, scene_one_in(3) ? &(sph_fluid){.rho0 = 1000, .sound_speed = 25} : NULL, &low));
    else
        low = scene_rock(sim, c, scene_one_in(2));
    high = low;
    if (c->solid)
        high = scene_rock(sim, c, false);
    else if (scene_one_in(3))
        must(sim, sph_add_fluid(sim, NULL, &high));
    else if (c->energy)
        must(sim, sph_add_fluid(sim, &(sph_fluid){.sound_speed = 2, .own_eos = true, .eos = SPH_IDEAL_GAS}, &high));
    scene_fill(sim, low, 0, half);
    scene_fill(sim, high, half, RANDOM_CELLS - scene_draw(3));
    if (c->max_flows && !c->solid)
        scene_flows(sim, low);
#if SPH_DIM > 1
    const sph_flaws flaws = {1e12, 8.5, 11};
    if (c->damage)
        must(sim, sph_add_flaws(sim, high, &flaws));
#endif
    scene_walls(sim, c);
}

#endif
