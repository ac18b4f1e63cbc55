/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* world_add.c: what the bytes add to a world: sets, particles, lattices, fields; walls of all kinds, fixed and
   moving. */
#include "world.h"

static void field(void *ctx, const double *x, double *v, double *rho)
{
    const double *f = ctx;
    for (int k = 0; k < SPH_DIM; k++)
        v[k] += f[k] * x[k];
    *rho += f[SPH_DIM] * x[0];
}

/* ---- motions ---- */

static void drive(void *ctx, double t, double *x, double *v)
{
    const motion *m = ctx;
    x[0] = m->start + m->speed * t + (t >= m->jump_at ? m->jump : 0);
    v[0] = m->speed;
}

/* ---- sets, particles, lattices, fields ---- */

static void add_solid(world *w, uint32_t how)
{
    sph_solid m = {0};
    uint32_t set, group;
    const uint32_t held = (uint32_t)take(&w->in, 1), g = w->sim->groups % SPH_MAX_GROUPS;
    m.shear = how & 1 ? take_any(&w->in) : take_near(&w->in, 1e5);
    m.yield = how & 2 ? take_near(&w->in, 1e4) : 0;
    m.hardening = take_near(&w->in, 1e4);
    m.crack_speed = take_near(&w->in, 10);
    m.body = held & 1;
    m.held = held & 2 ? held >> 2 & ((1u << SPH_DIM) - 1) : 0;
    if (held & 32) {
        w->motion[g] = (motion){take_near(&w->in, 0.1), take_near(&w->in, 1), take_near(&w->in, 0.01),
                                take_near(&w->in, 1)};
        m.motion = drive;
        m.motion_ctx = &w->motion[g];
    }
    attempt(w, sph_add_solid(w->sim, &m, &set, &group));
}

static void add_flaws(world *w)
{
#if SPH_DIM > 1
    const uint32_t how = pick(&w->in, 4), set = pick(&w->in, 4);
    const sph_flaws f = {how ? 1e9 * (1 + take_near(&w->in, 100)) : take_any(&w->in), how ? 8.5 : take_any(&w->in),
                         take(&w->in, 2)};
    attempt(w, sph_add_flaws(w->sim, set, &f));
#else
    (void)w;
#endif
}

static void add_set(world *w)
{
    sph_fluid f = {0};
    uint32_t set;
    const uint32_t how = pick(&w->in, 4);
    if (w->cfg.solid && take(&w->in, 1) & 1) {
        add_solid(w, how);
        return;
    }
    f.own_eos = w->cfg.solid && how == 1;
    f.eos = f.own_eos ? pick(&w->in, SPH_EOSES + 1) : 0;
    if (how == 1)
        f.rho0 = take_near(&w->in, 2000);
    else if (how == 2)
        f.sound_speed = take_near(&w->in, 40);
    else if (how == 3)
        f = (sph_fluid){take_any(&w->in), take_any(&w->in), take_any(&w->in), false, 0};
    attempt(w, sph_add_fluid(w->sim, how ? &f : NULL, &set));
}

/* a box or an ellipse with up to two holes on any lattice; now and then with a number of any kind */
static void add_with_holes(world *w, uint32_t set, const double *lo, const double *hi, const double *speed)
{
    sph_ellipse e[3];
    sph_shape s = {.hole = e + 1};
    const uint32_t how = (uint32_t)take(&w->in, 1);
    for (int i = 0; i < 3; i++) {
        take_point(&w->in, e[i].centre, 1);
        for (int k = 0; k < SPH_DIM; k++)
            e[i].radius[k] = how & 4 ? take_any(&w->in) : take_near(&w->in, 0.4);
    }
    for (int k = 0; k < SPH_DIM; k++) {
        s.lo[k] = how & 8 ? 0 : lo[k];
        s.hi[k] = how & 8 ? 0 : hi[k];
        s.velocity[k] = speed ? speed[k] : 0;
    }
    s.outline = how & 16 ? e : NULL;
    s.lattice = how >> 5 & 7;
    s.holes = how % 4 < 3 ? how % 4 : 0;
    attempt(w, sph_add_shape(w->sim, set, &s));
}

static void add_shape(world *w, uint32_t shape)
{
    double a[SPH_DIM], b[SPH_DIM], v[SPH_DIM];
    const uint32_t how = (uint32_t)take(&w->in, 1), set = how >> 6;
    take_point(&w->in, a, 1);
    take_point(&w->in, b, 1);
    for (int k = 0; k < SPH_DIM; k++)
        v[k] = how & 1 ? take_near(&w->in, 4) : 0;
    const double *const speed = how & 1 ? v : NULL;
    if (shape == 0)
        attempt(w, sph_add_particle(w->sim, set, a, speed, how & 2 ? take_near(&w->in, 2000) : 0, NULL));
    else if (shape == 1)
        attempt(w, sph_add_box(w->sim, set, a, b, speed));
    else
        attempt(w, sph_add_ring(w->sim, set, a, take_near(&w->in, 0.3), take_near(&w->in, 0.6), speed));
    if (how & 8)
        add_with_holes(w, set, a, b, speed);
#if SPH_DIM == 2
    if (how & 4) {
        double corner[5][2];
        for (int k = 0; k < 5; k++)
            take_point(&w->in, corner[k], 1);
        attempt(w, sph_add_polygon(w->sim, set, (const double(*)[2])corner, pick(&w->in, 6), speed));
    }
#endif
}

void world_add_fluid(world *w)
{
    const uint32_t what = pick(&w->in, w->cfg.damage ? 9 : 8);
    if (what == 8) {
        add_flaws(w);
    } else if (what < 5) {
        add_shape(w, what < 3 ? what : 1);
    } else if (what == 5) {
        add_set(w);
    } else if (what == 6) {
        for (int k = 0; k <= SPH_DIM; k++)
            w->field[k] = take_near(&w->in, k < SPH_DIM ? 4 : 50);
        attempt(w, sph_apply_field(w->sim, pick(&w->in, 3), field, w->field));
    } else {
        attempt(w, sph_apply_hydrostatic(w->sim, pick(&w->in, 3), take_near(&w->in, 1)));
    }
}

/* ---- walls ---- */

static void take_motion(world *w, sph_wall *wall)
{
    const uint32_t how = pick(&w->in, 6), g = w->sim->groups % SPH_MAX_GROUPS;
    if (how == 4) {
        for (int k = 0; k < 3; k++) {
            w->table_t[k] = (k ? w->table_t[k - 1] : 0) + take_near(&w->in, 0.01);
            w->table_x[k] = take_near(&w->in, 0.1);
        }
        w->table = (sph_table){pick(&w->in, 4), pick(&w->in, SPH_DIM + 1), w->table_t, w->table_x};
        wall->motion = sph_motion_table;
        wall->motion_ctx = &w->table;
    } else if (how == 5) {
        w->motion[g] = (motion){take_near(&w->in, 0.1), take_near(&w->in, 1), take_near(&w->in, 0.01),
                                take_near(&w->in, 1)};
        wall->motion = drive;
        wall->motion_ctx = &w->motion[g];
    }
}

void world_add_wall(world *w)
{
    sph_wall wall = sph_wall_default();
    double a[SPH_DIM], b[SPH_DIM];
    const uint32_t how = (uint32_t)take(&w->in, 1), faces = (uint32_t)take(&w->in, 1);
    uint32_t group = 0;
    wall.kind = how % 6;
    wall.compressible = how >> 3 & 1;
    wall.no_slip = how >> 4 & 1;
    wall.strength = how >> 5 & 1 ? take_near(&w->in, 2) : 0;
    wall.layers = how >> 6 & 1 ? pick(&w->in, 70) : 0;
    take_motion(w, &wall);
    take_point(&w->in, a, 1);
    take_point(&w->in, b, 1);
#if SPH_DIM == 2
    if (faces >> 6) {
        attempt(w, sph_add_wall_segment(w->sim, &wall, a, b, &group));
        return;
    }
#elif SPH_DIM == 3
    if (faces >> 6) {
        double e[3];
        take_point(&w->in, e, 1);
        for (int k = 0; k < 3 && faces & 1; k++) /* right angles are hard to hit */
            b[k] = k == 0 ? b[k] : 0, e[k] = k == 1 ? e[k] : 0;
        attempt(w, sph_add_wall_plane(w->sim, &wall, a, b, e, &group));
        return;
    }
#endif
    attempt(w, sph_add_wall_box(w->sim, &wall, a, b, faces & 63, how >> 7 & 1, &group));
    hold(group <= w->sim->groups);
}
