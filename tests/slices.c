/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* slices.c: a whole small dam break in slices, for some budgets: units and instructions of every slice (on bare metal
   under
   `-icount shift=0`, where the clock counts instructions; on the host units only). Prints totals, worst cases and
   histograms, which tests/slices.sh judges. Reads the kernel's own count of work, which is not public within a step. */
#include <inttypes.h>
#include <stdio.h>

#include "port/cortexm.h"
#include "sph/internal.h"
#include "sph/sweep.h"

#define N 10    /* particles across the column, which is as high as it is wide */
#define LONG 25 /* the tank, in spacings */
#define HIGH 15
#define LAYERS 3
#define DX 0.005
#define SWEEPS 2 /* of a step: walls, forces */
#define PARTICLES (N * N + LAYERS * (LONG + 2 * LAYERS) + 2 * LAYERS * HIGH)
#define MOST_STEPS 5000u
static SPH_ARENA(arena, SPH_ARENA_BYTES(PARTICLES, 200, 1, 0));

/* a unit takes about so many instructions on an M4F: only the width of a bin */
#define UNIT 400u
#define BINS 32u
/* units that a slice of no units may be taken for: beginning and ending of passes */
#define FREE 100u

typedef struct tally {
    uint64_t width;                    /* of a bin, units */
    uint64_t slices, worst, worst_ns, units, ns;
    uint64_t ns_units;                 /* units of the slice that took longest */
    uint64_t dearest;                  /* most ns/(units + FREE) of a slice */
    uint32_t slab;                     /* most particles in a slab */
    uint32_t bin[BINS], bin_ns[BINS];
} tally;

static sph_status make(sph_sim **sim)
{
    const double corner[2] = {0, 0}, water[2] = {N * DX, N * DX}, tank[2] = {LONG * DX, HIGH * DX};
    const sph_wall wall = sph_wall_default();
    sph_config cfg = sph_config_default();
    uint32_t set;
    cfg.spacing = DX;
    cfg.smoothing_length = 1.2 * DX;
    cfg.sound_speed = 10;
    cfg.gravity[1] = -9.81;
    cfg.diffusion = SPH_HYDROSTATIC;
    cfg.max_particles = PARTICLES;
    cfg.on_leave = SPH_REMOVE;
    cfg.on_cross = SPH_PUT_BACK;
    for (int k = 0; k < 2; k++) {
        cfg.lo[k] = -(LAYERS + 1) * DX;
        cfg.hi[k] = tank[k] + (LAYERS + 1) * DX;
    }
    sph_status st = sph_init(sim, &cfg, arena, sizeof arena, NULL);
    if (!st && !(st = sph_add_fluid(*sim, NULL, &set)) && !(st = sph_add_box(*sim, set, corner, water, NULL)))
        st = sph_add_wall_box(*sim, &wall, corner, tank, SPH_LOW(0) | SPH_HIGH(0) | SPH_LOW(1), true, NULL);
    return st;
}

static void count(tally *t, uint64_t units, uint64_t ns)
{
    const uint64_t a = units / t->width, b = ns / (t->width * UNIT);
    t->slices++;
    t->units += units;
    t->ns += ns;
    t->bin[a < BINS ? a : BINS - 1]++;
    t->bin_ns[b < BINS ? b : BINS - 1]++;
    t->worst = units > t->worst ? units : t->worst;
    t->dearest = ns / (units + FREE) > t->dearest ? ns / (units + FREE) : t->dearest;
    if (ns > t->worst_ns) {
        t->worst_ns = ns;
        t->ns_units = units;
    }
}

/* most particles in a layer of cells along the last axis */
static uint32_t widest_slab(const sph_sim *sim)
{
    uint32_t most = 0;
    for (uint32_t k = 0; k < sim->grid.slabs; k++) {
        const uint32_t *cell = sim->cell + (size_t)k * sim->grid.slab_cells;
        const uint32_t n = cell[sim->grid.slab_cells] - cell[0];
        most = n > most ? n : most;
    }
    return most;
}

static bool arrived(const sph_sim *sim)
{
    double back, front;
    sph_extent(sim, 0, &back, &front);
    return front > (LONG - 1) * DX; /* a spacing from the far wall */
}

static sph_status run(sph_sim *sim, uint64_t budget, tally *t)
{
    uint64_t before = 0;
    sph_status st = sph_ready(sim); /* the first sort of all cannot be sliced */
    for (uint32_t steps = 0; !st && steps < MOST_STEPS;) {
        if (!sim->begun) {
            const uint32_t s = widest_slab(sim);
            t->slab = s > t->slab ? s : t->slab;
        }
        const uint64_t began = cortexm_clock(NULL);
        st = sph_step_slice(sim, budget);
        const uint64_t took = cortexm_clock(NULL) - began, work = sim->work + sim->thread[0].work;
        if (st && st != SPH_NOT_DONE)
            return st;
        count(t, work - before, took);
        before = sim->begun ? work : 0;
        steps += st == SPH_OK;
        if (st == SPH_OK && arrived(sim))
            return SPH_OK;
        st = SPH_OK;
    }
    return st ? st : SPH_STEP_COLLAPSED; /* the water did not arrive */
}

static void show(const sph_sim *sim, uint64_t budget, const tally *t)
{
    sph_usage u;
    sph_step_info info;
    sph_get_usage(sim, &u);
    sph_get_step(sim, &info);
    const uint64_t hash = sph_hash(sim);
    const struct {
        const char *name;
        uint64_t value;
    } row[] = {
        {"slices", t->slices}, {"steps", info.step}, {"particles", u.particles}, {"cell_particles", u.cell_particles},
        {"units", t->units}, {"worst_units", t->worst}, {"kernel_worst_units", u.slice_work},
        {"extra", SPH_SLICE_EXTRA(1, sim->grid.slabs, t->slab, sim->grid.slab_cells, u.cell_particles)},
        {"worst_step_units", u.step_work}, {"step_bound",
                                            SPH_STEP_WORK(SWEEPS, u.particles, u.cell_particles, u.cells)},
        {"kinstructions", t->ns / 1000}, {"worst_instructions", t->worst_ns}, {"worst_instructions_units", t->ns_units},
        {"dearest_unit", t->dearest},
    };
    for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
        printf("%" PRIu32 " %s %" PRIu32 "\n", (uint32_t)budget, row[i].name, (uint32_t)row[i].value);
    for (uint32_t i = 0; i < BINS; i++)
        if (t->bin[i] || t->bin_ns[i])
            printf("%" PRIu32 " bin %" PRIu32 " %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", (uint32_t)budget,
                   (uint32_t)(i * t->width), t->bin[i], (uint32_t)(i * t->width * UNIT), t->bin_ns[i]);
    printf("%" PRIu32 " hash %08" PRIx32 "%08" PRIx32 "\n", (uint32_t)budget, (uint32_t)(hash >> 32), (uint32_t)hash);
}

int main(void)
{
    static const uint32_t budgets[] = {500, 2000, 8000};
    cortexm_start(1u << 24);
    for (unsigned i = 0; i < sizeof budgets / sizeof *budgets; i++) {
        static tally t;
        sph_sim *sim;
        t = (tally){.width = budgets[i] / 4};
        sph_status st = make(&sim);
        if (!st)
            st = run(sim, budgets[i], &t);
        if (st) {
            printf("slices: %s\n", sph_status_text(st));
            return 1;
        }
        show(sim, budgets[i], &t);
    }
    return 0;
}
