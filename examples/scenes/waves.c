/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* waves.c: water whose columns follow a surface and a bed (see waves.h). */
#include "waves.h"
#if SPH_DIM == 2

#define DRY 0.5 /* spacings: water less deep has no column */

double wave_pressed(double sound, double eta) { return 1 + eta / (2 * sound * sound); }
double wave_long(double gravity, double depth) { return __builtin_sqrt(gravity * depth); }

static double bed_at(const wave_water *w, double x) { return w->bed ? w->bed(w->of, x) : 0; }
static double column_mass(const wave_water *w, double x)
{
    const double eta = w->surface(w->of, x);
    return (1 + eta - bed_at(w, x)) * wave_pressed(w->sound, eta);
}

/* where the next column of a mass stands: dx/dX = 1/column_mass (Runge-Kutta 4) */
static double further(const wave_water *w, double x, double mass)
{
    const double a = mass / column_mass(w, x), b = mass / column_mass(w, x + 0.5 * a),
                 c = mass / column_mass(w, x + 0.5 * b), d = mass / column_mass(w, x + c);
    return x + (a + 2 * (b + c) + d) / 6;
}

/* mass of the water over that of D^2 (Simpson) */
static double whole_mass(const wave_water *w)
{
    enum { PIECES = 4000 };
    const double piece = (w->to - w->from) / PIECES;
    double sum = 0;
    for (int i = 0; i <= PIECES; i++)
        sum += column_mass(w, w->from + i * piece) * piece / 3 * (i == 0 || i == PIECES ? 1 : i & 1 ? 4 : 2);
    return sum;
}
static double columns(const wave_water *w) { return (double)(uint32_t)(whole_mass(w) * w->n + 0.5); }

double wave_count(const wave_water *w)
{
    const double most = (w->to - w->from) * w->n + 2;
    return (w->bed || w->even ? most : columns(w)) * (w->n + 2.0) + whole_mass(w) * w->n * w->n;
}

static sph_status add(sph_sim *sim, const double *p, uint32_t set, const wave_water *w, double x, double y)
{
    const double at[2] = {x * w->depth, y * w->depth}, speed = wave_long(w->gravity, w->depth);
    double v[2] = {0, 0}, pressure = 1 + w->surface(w->of, x) - y;
    if (w->flow)
        w->flow(w->of, x, y, v, &pressure);
    v[0] *= speed;
    v[1] *= speed;
    pressure = pressure < 0 ? 0 : 1000 * speed * speed * pressure;
    return sph_add_particle(sim, set, at, v, scene_density(p, pressure, 1000, w->sound * speed), NULL);
}

/* particles of a column */
static uint32_t rows_at(const wave_water *w, double x)
{
    const double high = w->even ? w->surface(w->of, x) : 0, rows = (1 + high - bed_at(w, x)) * w->n + 0.5;
    return rows < 1 ? 1 : (uint32_t)rows;
}

static bool is_wet(const wave_water *w, double x)
{
    return x < w->to && (1 + w->surface(w->of, x) - bed_at(w, x)) * w->n > DRY;
}

static sph_status add_columns(sph_sim *sim, const double *p, uint32_t set, const wave_water *w, double mass)
{
    sph_status st = SPH_OK;
    double x = w->from;
    while (!st && is_wet(w, x + 0.5 / w->n)) {
        const uint32_t rows = rows_at(w, x);
        const double middle = further(w, x, 0.5 * mass * rows), low = bed_at(w, middle);
        const double high = 1 + w->surface(w->of, middle);
        for (uint32_t j = 0; !st && middle < w->to && j < rows; j++)
            st = add(sim, p, set, w, middle, low + (j + 0.5) / rows * (high - low));
        x = further(w, middle, 0.5 * mass * rows);
    }
    return st;
}

/* mass of a particle (over that of D^2); rows that change from column to column fit in after a few turns */
static double particle_mass(const wave_water *w)
{
    double mass = 1.0 / ((double)w->n * w->n);
    if (w->bed)
        return mass;
    if (!w->even)
        return whole_mass(w) / (columns(w) * w->n);
    for (int turn = 0; turn < 5; turn++) {
        double x = w->from, sum = 0;
        while (x + 0.5 / w->n < w->to) {
            sum += rows_at(w, x);
            x = further(w, x, mass * rows_at(w, x));
        }
        mass = whole_mass(w) / sum;
    }
    return mass;
}

sph_status wave_add(sph_sim *sim, const double *p, const wave_water *w)
{
    const double mass = particle_mass(w);
    const sph_fluid f = {.mass = 1000 * w->depth * w->depth * mass};
    uint32_t set;
    const sph_status st = sph_add_fluid(sim, &f, &set);
    return st ? st : add_columns(sim, p, set, w, mass);
}

/* ---- lattices that are moved ---- */

/* dX/dx = 1/(1 + eta(X)/D) (Runge-Kutta 4) */
static double stretched(const wave_surface *s, double x, double by)
{
    const double a = by / (1 + s->eta(s->of, x) / s->depth), b = by / (1 + s->eta(s->of, x + 0.5 * a) / s->depth),
                 c = by / (1 + s->eta(s->of, x + 0.5 * b) / s->depth), d = by / (1 + s->eta(s->of, x + c) / s->depth);
    return x + (a + 2 * (b + c) + d) / 6;
}
static void follow(void *ctx, const double *x, double *to)
{
    const wave_surface *s = ctx;
    double left = x[0] - s->low;
    to[0] = s->low;
    for (; left > s->step; left -= s->step)
        to[0] = stretched(s, to[0], s->step);
    to[0] = stretched(s, to[0], left);
    to[1] = x[1] * (1 + s->eta(s->of, to[0]) / s->depth);
}
sph_status wave_follow(sph_sim *sim, uint32_t set, const wave_surface *s)
{
    return sph_apply_positions(sim, set, follow, (void *)(uintptr_t)s);
}

typedef struct pushing {
    double k, by;
} pushing;
static void push(void *ctx, const double *x, double *to)
{
    const pushing *p = ctx;
    to[0] = x[0] + p->by * sph_sin(p->k * x[1]);
    to[1] = x[1] + p->by * sph_sin(p->k * x[0]);
}
sph_status wave_push(sph_sim *sim, uint32_t set, double spacing, double by)
{
    pushing p = {2 * SCENE_PI / (8 * spacing), by};
    return by > 0 ? sph_apply_positions(sim, set, push, &p) : SPH_OK;
}

/* ---- a tank with a driven end ---- */

static double tank_spacing(const wave_water *w) { return w->depth / w->n; }
#define BED_FACES (SPH_LOW(1) | SPH_HIGH(0))
/* The bed's wall reaches behind the driven end, whose layers end on it: no corner is open, no particle doubled. */
static void bed_box(const double *p, const wave_water *w, const wave_tank *tank, double *lo, double *hi)
{
    lo[0] = tank_spacing(w) - scene_margin(p, tank_spacing(w));
    lo[1] = 0;
    hi[0] = tank->length;
    hi[1] = tank->height;
}

sph_config wave_tank_configure(const double *p, const wave_water *w, const wave_tank *tank)
{
    const double dx = tank_spacing(w), m = scene_margin(p, dx), lo[2] = {0, 0}, hi[2] = {tank->length, tank->height};
    double low[2], high[2];
    sph_config c = scene_config(p, dx, 1000, w->sound * wave_long(w->gravity, w->depth));
    bed_box(p, w, tank, low, high);
    c.gravity[1] = -w->gravity;
    c.lo[0] = -m;
    c.hi[0] = hi[0] + (tank->walls ? m : 0);
    c.lo[1] = tank->walls ? -m : 0;
    c.hi[1] = hi[1] + m;
    if (!tank->walls)
        c.face[0][1] = c.face[1][0] = SPH_SYMMETRY;
    c.max_particles = scene_capacity(wave_count(w) + scene_wall_count(p, lo, hi, dx, SPH_LOW(0)) +
                                     (tank->walls ? scene_wall_count(p, low, high, dx, BED_FACES) : 0));
    return c;
}

sph_status wave_tank_build(sph_sim *sim, const double *p, const wave_water *w, const wave_tank *tank)
{
    const double dx = tank_spacing(w), top[2] = {tank->length, tank->height};
    const double end[2] = {p[SCENE_WALL] == SCENE_LENNARD_JONES ? -0.5 * dx : 0, 0};
    double lo[2], hi[2];
    sph_wall wall = scene_wall(p);
    sph_status st = wave_add(sim, p, w);
    bed_box(p, w, tank, lo, hi);
    if (!st && tank->walls)
        st = scene_add_tank(sim, p, lo, hi, dx, BED_FACES);
    wall.motion = tank->drive;
    wall.motion_ctx = (void *)(uintptr_t)p;
    return st ? st : sph_add_wall_box(sim, &wall, end, top, SPH_LOW(0), true, NULL);
}

#endif
