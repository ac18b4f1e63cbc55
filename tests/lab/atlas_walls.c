/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_walls.c: what every kind of wall does to still water in many steps, and how much of a block of water that is
   thrown at it goes through. 2-D, float, the defaults of sph_config_default, dx = c0 = rho0 = 1.

   Tank: 12 by 8 particles at rest in hydrostatic balance, c0^2 = 200 g H. Nothing should ever move.
     speed      root of the mean square, sqrt(g H)
     moved      root of the mean square distance from the first place, dx
     nearest    smallest distance of two particles, dx
     pressure   root of the mean square of p - g (H - y), g H
     put_back   particles that were found inside a wall and put back, so far
   Leak: a block of 8 by 8 is thrown at a wall from 4 dx off, no gravity; crossed: share of its particles that were ever
   seen more than half a spacing behind the wall's face, with nobody who puts them back (IGNORE), and how often one is
   put back else. */
#include "atlas.h"

#include <math.h>
#include <stdlib.h>

#include "box.h"

const char *const wall_names[WALL_CHOICES] = {"lennard_jones", "kernel_force", "monaghan_kos", "ghost", "ghost_held",
                                              "adami",
                                              "mirror"};

static sph_wall wall_of(uint32_t choice)
{
    static const uint32_t kind[] = {SPH_WALL_LENNARD_JONES, SPH_WALL_KERNEL_FORCE, SPH_WALL_MONAGHAN_KOS,
                                    SPH_WALL_GHOST,
                                    SPH_WALL_GHOST, SPH_WALL_ADAMI, SPH_WALL_ADAMI};
    sph_wall w = sph_wall_default();
    w.kind = kind[choice];
    w.compressible = choice == WALL_GHOST_FREE;
    return w;
}

static sph_config config_of(uint32_t choice, double width, double height)
{
    sph_config c = sph_config_default();
    const double margin = choice == WALL_MIRROR ? 0 : 5;
    c.spacing = c.rho0 = c.sound_speed = 1;
    c.smoothing_length = 1.2;
    c.lo[0] = c.lo[1] = -margin;
    c.hi[0] = width + margin;
    c.hi[1] = height + margin;
    if (choice == WALL_MIRROR)
        c.face[0][0] = c.face[0][1] = c.face[1][0] = SPH_SYMMETRY;
    c.on_leave = SPH_REMOVE;
    c.max_particles = 2000;
    return c;
}

/* ---- tank ---- */

#define WIDE 12
#define DEEP 8

static void look(const sph_sim *sim, double g, const double (*first)[2], wall_tank *out)
{
    const uint32_t count = sph_count(sim);
    double v2 = 0, d2 = 0, e2 = 0, least = 1e300;
    uint32_t n = 0;
    sph_particle a, b;
    sph_step_info info;
    for (uint32_t i = 0; i < count; i++) {
        box_must(sim, sph_get(sim, i, &a), "tank");
        if (a.role != SPH_ROLE_FLUID)
            continue;
        const double dx = a.x[0] - first[a.id][0], dy = a.x[1] - first[a.id][1], e = a.p - g * (DEEP - a.x[1]);
        n++;
        v2 += a.v[0] * a.v[0] + a.v[1] * a.v[1];
        d2 += dx * dx + dy * dy;
        e2 += e * e;
        for (uint32_t j = i + 1; j < count; j++) {
            box_must(sim, sph_get(sim, j, &b), "tank");
            const double x = a.x[0] - b.x[0], y = a.x[1] - b.x[1];
            least = b.role == SPH_ROLE_FLUID && x * x + y * y < least ? x * x + y * y : least;
        }
    }
    sph_get_step(sim, &info);
    out->speed = sqrt(v2 / n / (g * DEEP));
    out->moved = sqrt(d2 / n);
    out->nearest = sqrt(least);
    out->pressure = sqrt(e2 / n) / (g * DEEP);
    out->put_back = info.put_back;
    out->left = WIDE * DEEP - n;
}

uint32_t wall_rest(const tank_case *k, const uint32_t *at, uint32_t marks, wall_tank *out, uint32_t *failed)
{
    const double g = 1.0 / (200 * DEEP), lo[2] = {0, 0}, top[2] = {WIDE, DEEP}, hi[2] = {WIDE, 1.5 * DEEP};
    const double gap = k->wall == WALL_LJ ? 0.5 : 0; /* its force begins a whole spacing off */
    const double wlo[2] = {-gap, -gap}, whi[2] = {WIDE + gap, hi[1]};
    const sph_wall wall = wall_of(k->wall);
    double first[WIDE * DEEP][2];
    sph_config c = config_of(k->wall, WIDE, hi[1]);
    void *arena;
    uint32_t set, mark = 0;
    c.gravity[1] = -g;
    c.on_cross = SPH_PUT_BACK;
    c.integrator = k->integrator;
    c.diffusion = k->diffusion;
    c.alpha = k->alpha;
    sph_sim *sim = box_new(&c, &arena);
    box_must(sim, sph_add_fluid(sim, NULL, &set), "water");
    box_must(sim, sph_add_box(sim, set, lo, top, NULL), "water");
    box_must(sim, sph_apply_hydrostatic(sim, set, DEEP), "balance");
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        sph_particle q;
        box_must(sim, sph_get(sim, i, &q), "tank");
        first[q.id][0] = q.x[0];
        first[q.id][1] = q.x[1];
    }
    if (k->wall != WALL_MIRROR)
        box_must(sim, sph_add_wall_box(sim, &wall, wlo, whi, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1), true, NULL),
                 "walls");
    sph_status st = SPH_OK;
    uint32_t step = 0;
    while (mark < marks && (st = sph_step(sim)) == SPH_OK)
        if (++step == at[mark])
            look(sim, g, (const double(*)[2])first, &out[mark++]);
    *failed = st ? step + 1 : 0;
    free(arena);
    return mark;
}

void atlas_tank(FILE *f)
{
    static const uint32_t at[] = {1000, 10000, 100000};
    enum { MARKS = sizeof at / sizeof *at };
    static const struct {
        const char *name;
        tank_case k;
    } list[] = {{"lennard_jones", {.wall = WALL_LJ, .alpha = 0.01}},
                {"kernel_force", {.wall = WALL_KERNEL, .alpha = 0.01}},
                {"monaghan_kos", {.wall = WALL_KOS, .alpha = 0.01}},
                {"ghost", {.wall = WALL_GHOST_FREE, .alpha = 0.01}},
                {"ghost_held", {.wall = WALL_GHOST_HELD, .alpha = 0.01}},
                {"adami", {.wall = WALL_EXTRAPOLATED, .alpha = 0.01}},
                {"mirror", {.wall = WALL_MIRROR, .alpha = 0.01}},
                {"adami_kick_drift_kick", {.wall = WALL_EXTRAPOLATED, .alpha = 0.01,
                                           .integrator = SPH_KICK_DRIFT_KICK}},
                {"adami_alpha_0.05", {.wall = WALL_EXTRAPOLATED, .alpha = 0.05}},
                {"adami_molteni", {.wall = WALL_EXTRAPOLATED, .alpha = 0.01, .diffusion = SPH_MOLTENI}},
                {"adami_hydrostatic", {.wall = WALL_EXTRAPOLATED, .alpha = 0.01, .diffusion = SPH_HYDROSTATIC}},
                {"mirror_kick_drift_kick", {.wall = WALL_MIRROR, .alpha = 0.01, .integrator = SPH_KICK_DRIFT_KICK}},
                {"mirror_alpha_0.05", {.wall = WALL_MIRROR, .alpha = 0.05}},
                {"mirror_hydrostatic", {.wall = WALL_MIRROR, .alpha = 0.01, .diffusion = SPH_HYDROSTATIC}}};
    atlas_head(f, "tank", "a still tank after many steps, for every kind of wall",
               "2-D, float, 12 by 8 particles in hydrostatic balance, c0^2 = 200 g H, defaults of sph_config_default "
               "but\n"
               "for what a choice names (molteni, hydrostatic: density diffusion 0.1); x: steps\n"
               "speed: rms, sqrt(g H); moved: rms way from the first place; nearest: of two particles; pressure: rms "
               "error, rho g H\n"
               "put_back: so far; left: particles that are gone; failed: the step that did",
               "case,choice,x,figure,value,unit");
    for (size_t w = 0; w < sizeof list / sizeof *list; w++) {
        wall_tank t[MARKS];
        uint32_t failed;
        const uint32_t n = wall_rest(&list[w].k, at, MARKS, t, &failed);
        for (uint32_t m = 0; m < n; m++) {
            fprintf(f, "still,%s,%u,speed,%.2e,sqrt(gH)\n", list[w].name, at[m], t[m].speed);
            fprintf(f, "still,%s,%u,moved,%.3g,dx\n", list[w].name, at[m], t[m].moved);
            fprintf(f, "still,%s,%u,nearest,%.3f,dx\n", list[w].name, at[m], t[m].nearest);
            fprintf(f, "still,%s,%u,pressure,%.3g,rho g H\n", list[w].name, at[m], t[m].pressure);
            fprintf(f, "still,%s,%u,put_back,%u,-\n", list[w].name, at[m], t[m].put_back);
            fprintf(f, "still,%s,%u,left,%u,-\n", list[w].name, at[m], t[m].left);
        }
        if (failed)
            fprintf(f, "still,%s,%u,failed,%u,step\n", list[w].name, at[MARKS - 1], failed);
        fflush(f);
    }
}

/* ---- leak ---- */

#define SIDE 8

static double usual_strength(uint32_t choice) { return choice == WALL_LJ ? 1.0 / 200 : 0.01; } /* c0 = dx = 1 */

wall_leak wall_throw(uint32_t choice, double strength, uint32_t layers, double speed, bool put_back)
{
    const double size = 40, lo[2] = {16, 4}, hi[2] = {16 + SIDE, 4 + SIDE}, v[2] = {0, -speed};
    const double wlo[2] = {0, 0}, whi[2] = {size, size};
    bool behind[SIDE * SIDE] = {false};
    wall_leak out = {0};
    sph_config c = config_of(choice, size, size);
    sph_wall wall = wall_of(choice);
    sph_step_info info;
    sph_status st = SPH_OK;
    void *arena;
    uint32_t set;
    c.on_cross = put_back ? SPH_PUT_BACK : SPH_IGNORE;
    c.lo[1] = choice == WALL_MIRROR ? 0 : -12;
    wall.layers = layers;
    wall.strength = strength * usual_strength(choice);
    sph_sim *sim = box_new(&c, &arena);
    box_must(sim, sph_add_fluid(sim, NULL, &set), "water");
    box_must(sim, sph_add_box(sim, set, lo, hi, v), "block");
    if (choice != WALL_MIRROR)
        box_must(sim, sph_add_wall_box(sim, &wall, wlo, whi, SPH_LOW(1), true, NULL), "wall");
    const double end = 2 * (4 + SIDE) / speed;
    for (uint32_t s = 0; s < 20000 && sph_time(sim) < end && (st = sph_step(sim)) == SPH_OK; s++)
        for (uint32_t i = 0; i < sph_count(sim) && s % 4 == 0; i++) {
            sph_particle q;
            box_must(sim, sph_get(sim, i, &q), "leak");
            if (q.role == SPH_ROLE_FLUID && q.x[1] < -0.5)
                behind[q.id] = true;
        }
    sph_get_step(sim, &info);
    for (int i = 0; i < SIDE * SIDE; i++)
        out.crossed += behind[i] ? 1.0 / (SIDE * SIDE) : 0;
    out.put_back = info.put_back;
    out.failed = st != SPH_OK;
    free(arena);
    return out;
}

void atlas_leak(FILE *f)
{
    static const double speed[] = {0.05, 0.1, 0.3, 1, 2}, strength[] = {0.1, 1, 10};
    atlas_head(f, "leak", "water thrown at a wall: what goes through",
               "2-D, float, a block of 8 by 8 particles, no gravity, defaults of sph_config_default; x: speed over c0\n"
               "strength: over the usual one; layers: of ghosts, 3 are usual; crossed: share that was seen more than "
               "dx/2 behind the\n"
               "wall (IGNORE)\n"
               "put_back: how often one is put back with PUT_BACK, and crossed_put_back: the share behind the wall in "
               "spite of it\n"
               "failed 1: a step failed before the end; no row: none did",
               "case,choice,x,figure,value,unit");
    for (uint32_t w = 0; w < WALL_CHOICES; w++)
        for (size_t k = 0; k < sizeof strength / sizeof *strength; k++) {
            const bool pushes = w <= WALL_KOS;
            const uint32_t layers = k == 0 ? 1 : 0;
            char choice[64];
            if (!pushes && (k == 2 || (w == WALL_MIRROR && k == 0)))
                continue;
            if (pushes)
                snprintf(choice, sizeof choice, "strength_%.3g", strength[k]);
            else
                snprintf(choice, sizeof choice, "%s", w == WALL_MIRROR ? "face" : layers ? "layers_1" : "layers_3");
            for (size_t v = 0; v < sizeof speed / sizeof *speed; v++) {
                const wall_leak a = wall_throw(w, pushes ? strength[k] : 0, pushes ? 0 : layers, speed[v], false);
                const wall_leak b = wall_throw(w, pushes ? strength[k] : 0, pushes ? 0 : layers, speed[v], true);
                fprintf(f, "%s,%s,%.3g,crossed,%.1f,%%\n", wall_names[w], choice, speed[v], 100 * a.crossed);
                fprintf(f, "%s,%s,%.3g,put_back,%u,-\n", wall_names[w], choice, speed[v], b.put_back);
                fprintf(f, "%s,%s,%.3g,crossed_put_back,%.1f,%%\n", wall_names[w], choice, speed[v], 100 * b.crossed);
                if (a.failed || b.failed)
                    fprintf(f, "%s,%s,%.3g,failed,1,-\n", wall_names[w], choice, speed[v]);
                fflush(f);
            }
        }
}
