/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* tank.c: a closed tank of water that can be tilted, as functions for a page (app.js) to call. Tilting turns gravity,
   not the walls: seen from the tank it is the same. The 2-D float build; everything lies in static memory. Angles are
   whole degrees and their sines the kernel's own, so that a browser and a native program go through the same bits. */
#include "tank.h"

#include "../../sph/dmath.h"
#include "../../sph/sph.h"

#define DX 0.08
#define WIDTH 6.0
#define HEIGHT 3.6
#define COLUMN 2.4 /* the water's width at the start */
#define LEVEL 2.8  /* and height */
#define GRAVITY 9.81
#define DEGREE 0.017453292519943295
#define CAPACITY 2200u

static SPH_ARENA(arena, SPH_ARENA_BYTES(CAPACITY, 1000, 1, 0));
static float picture[CAPACITY * TANK_NUMBERS];
static sph_sim *sim;
static sph_config cfg;

static sph_status build(void)
{
    const double corner[2] = {0, 0}, column[2] = {COLUMN, LEVEL}, tank[2] = {WIDTH, HEIGHT};
    const sph_wall wall = sph_wall_default();
    uint32_t water;
    sph_status st = sph_init(&sim, &cfg, arena, sizeof arena, NULL);
    if (!st)
        st = sph_add_fluid(sim, NULL, &water);
    if (!st)
        st = sph_add_box(sim, water, corner, column, NULL);
    if (!st)
        st = sph_add_wall_box(sim, &wall, corner, tank, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1) | SPH_HIGH(1), true,
                              NULL);
    return st ? st : sph_ready(sim);
}

int tank_start(void)
{
    cfg = sph_config_default();
    cfg.spacing = DX;
    cfg.smoothing_length = 1.2 * DX;
    cfg.sound_speed = 50; /* seven times the fastest water: stiff enough to look at, and quick */
    cfg.alpha = 0.05;
    cfg.diffusion = SPH_HYDROSTATIC;
    cfg.gravity[1] = -GRAVITY;
    cfg.max_particles = CAPACITY;
    cfg.on_leave = SPH_REMOVE;
    cfg.on_cross = SPH_PUT_BACK;
    for (int k = 0; k < 2; k++) {
        cfg.lo[k] = -4 * DX;
        cfg.hi[k] = (k ? HEIGHT : WIDTH) + 4 * DX;
    }
    return (int)build();
}

int tank_tilt(int degrees)
{
    cfg.gravity[0] = GRAVITY * sph_sin(degrees * DEGREE);
    cfg.gravity[1] = -GRAVITY * sph_cos(degrees * DEGREE);
    return (int)sph_reconfigure(sim, &cfg);
}

int tank_step(void) { return (int)sph_step(sim); }
const char *tank_text(int status) { return sph_status_text((sph_status)status); }
double tank_time(void) { return sph_time(sim); }
double tank_width(void) { return WIDTH; }
double tank_height(void) { return HEIGHT; }
double tank_spacing(void) { return DX; }
unsigned tank_particles(void) { return sph_count(sim); }
unsigned tank_hash(int high) { return (unsigned)(sph_hash(sim) >> (high ? 32 : 0)); }
const float *tank_picture(void) { return picture; }

unsigned tank_draw(void)
{
    unsigned n = 0;
    sph_particle p;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &p) == SPH_OK && p.role == SPH_ROLE_FLUID) {
            float *row = picture + (size_t)TANK_NUMBERS * n++;
            row[0] = (float)p.x[0];
            row[1] = (float)p.x[1];
            row[2] = (float)__builtin_sqrt(p.v[0] * p.v[0] + p.v[1] * p.v[1]);
        }
    return n;
}
