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
    return (w->bed ? most : columns(w)) * (w->n + 2.0) + whole_mass(w) * w->n;
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
    const double rows = (1 - bed_at(w, x)) * w->n + 0.5;
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

sph_status wave_add(sph_sim *sim, const double *p, const wave_water *w)
{
    const double mass = w->bed ? 1.0 / ((double)w->n * w->n) : whole_mass(w) / (columns(w) * w->n);
    const sph_fluid f = {.mass = 1000 * w->depth * w->depth * mass};
    uint32_t set;
    const sph_status st = sph_add_fluid(sim, &f, &set);
    return st ? st : add_columns(sim, p, set, w, mass);
}
#endif
