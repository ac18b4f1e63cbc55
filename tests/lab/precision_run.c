/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* precision_run.c: see precision_run.h. All scenes have dx = c0 = rho0 = 1 and a fixed step, so that float and double
   take the same.
     tank     12 by 8 particles at rest between Adami walls, c0^2 = 200 g H
     dam      10 by 20 in a tank 40 wide, Adami walls, c0^2 = 200 g H
     vortex   Taylor and Green's in a periodic square of 16, c0 = 10 of its speeds, Morris viscosity, Reynolds number
              100
     block    12 by 12 of an elastic solid, free, that rings: updated form, artificial stress
     tension  a periodic square of 12 of the updated form under V/V0 = 1.05 with a push of 1e-10 c0: unstable */
#include "precision_run.h"

#include <stdlib.h>

#include "atlas.h"
#include "box.h"
#include "sph/dmath.h"

#define PI 3.14159265358979323846

typedef struct run {
    sph_sim *sim;
    void *arena;
} run;

static void swirl(void *ctx, const double *x, double *v, double *rho)
{
    const double k = 2 * PI / 16;
    (void)ctx;
    v[0] = -0.1 * sph_cos(k * x[0]) * sph_sin(k * x[1]);
    v[1] = 0.1 * sph_sin(k * x[0]) * sph_cos(k * x[1]);
    *rho = 1;
}

static void ring(void *ctx, const double *x, double *v, double *rho)
{
    (void)ctx;
    v[0] = 0.02 * (x[0] - 16) / 6;
    v[1] = -0.02 * (x[1] - 16) / 6;
    *rho = 1;
}

static void tank(sph_sim **sim, void **arena, double wide, double deep, double room, bool balance)
{
    const double lo[2] = {0, 0}, top[2] = {wide, deep}, hi[2] = {room, 1.5 * deep};
    sph_config c = box_config(1, SPH_WENDLAND_C2, 1.2, 0.2);
    const sph_wall wall = sph_wall_default();
    uint32_t set;
    for (int k = 0; k < 2; k++) {
        c.lo[k] = -5;
        c.hi[k] = hi[k] + 5;
        c.face[k][0] = c.face[k][1] = SPH_OPEN;
    }
    c.eos = SPH_TAIT;
    c.viscosity = SPH_ARTIFICIAL;
    c.alpha = 0.02;
    c.on_cross = SPH_PUT_BACK;
    c.gravity[1] = -1 / (200 * deep);
    c.max_particles = PRECISION_MOST;
    *sim = box_new(&c, arena);
    box_must(*sim, sph_add_fluid(*sim, NULL, &set), "water");
    box_must(*sim, sph_add_box(*sim, set, lo, top, NULL), "water");
    if (balance)
        box_must(*sim, sph_apply_hydrostatic(*sim, set, deep), "balance");
    box_must(*sim, sph_add_wall_box(*sim, &wall, lo, hi, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1), true, NULL), "walls");
}

static void vortex(sph_sim **sim, void **arena)
{
    sph_config c = box_config(16, SPH_WENDLAND_C2, 1.6, 0.2);
    const sph_shape s = {.hi = {16, 16}};
    uint32_t set;
    c.viscosity = SPH_MORRIS;
    c.nu = 0.1 * 16 / 100;
    c.integrator = SPH_KICK_DRIFT_KICK;
    *sim = box_new(&c, arena);
    box_must(*sim, sph_add_fluid(*sim, NULL, &set), "water");
    box_must(*sim, sph_add_shape(*sim, set, &s), "water");
    box_must(*sim, sph_apply_field(*sim, set, swirl, NULL), "vortex");
}

static void block(sph_sim **sim, void **arena)
{
    sph_config c = box_config(32, SPH_CUBIC, 1.3, 0.2);
    const sph_shape s = {.lo = {10, 10}, .hi = {22, 22}};
    const sph_solid m = {.mass = 1, .rho0 = 1, .sound_speed = 1, .shear = 0.22};
    uint32_t set;
    c.solid = SPH_UPDATED;
    c.artificial_stress = SPH_PRINCIPAL;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.viscosity = SPH_ARTIFICIAL;
    c.alpha = 0.1;
    *sim = box_new(&c, arena);
    box_must(*sim, sph_add_solid(*sim, &m, &set, NULL), "block");
    box_must(*sim, sph_add_shape(*sim, set, &s), "block");
    box_must(*sim, sph_apply_field(*sim, set, ring, NULL), "block");
}

static void tension(sph_sim **sim, void **arena)
{
    const box_solid b = {.form = SPH_UPDATED, .kernel = SPH_CUBIC, .n = 12, .h = 1.2, .mu = 0.22, .volume = 1.05,
                         .alpha = 0.1,
                         .dt = 0.2};
    uint32_t set;
    *sim = box_make_solid(&b, &set, arena);
    box_push(*sim, set, 12, 1e-10, 1);
}

static void *start(uint32_t scene, double period[2])
{
    run *r = malloc(sizeof *r);
    if (!r)
        return NULL;
    period[0] = period[1] = scene == PAIR_VORTEX ? 16 : scene == PAIR_TENSION ? 12 : scene == PAIR_BLOCK ? 32 : 0;
    if (scene == PAIR_TANK)
        tank(&r->sim, &r->arena, 12, 8, 12, true);
    else if (scene == PAIR_DAM)
        tank(&r->sim, &r->arena, 10, 20, 40, false);
    else if (scene == PAIR_VORTEX)
        vortex(&r->sim, &r->arena);
    else if (scene == PAIR_BLOCK)
        block(&r->sim, &r->arena);
    else
        tension(&r->sim, &r->arena);
    return r;
}

static bool step(void *at) { return sph_step(((run *)at)->sim) == SPH_OK; }

static void look(const void *at, precision_look *out)
{
    const sph_sim *sim = ((const run *)at)->sim;
    sph_totals t;
    sph_particle q;
    double low;
    sph_get_totals(sim, &t);
    out->bodies = t.fluid + t.solid;
    out->kinetic = t.kinetic;
    sph_extent(sim, 0, &low, &out->front);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && q.id < out->bodies) {
            out->x[q.id][0] = q.x[0];
            out->x[q.id][1] = q.x[1];
        }
}

static void end(void *at)
{
    free(((run *)at)->arena);
    free(at);
}

#if SPH_DOUBLE
const precision_build precision_build_2d = {start, step, look, end};
#else
const precision_build precision_build_2f = {start, step, look, end};
#endif
