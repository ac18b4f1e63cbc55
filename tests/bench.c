/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bench.c: speed and memory of one build: a dam break with Adami walls, fluid n x n (x n), Wendland C2 at h/dx 1.2,
   predictor-corrector; the scene dam_break or dam_break_3d as it is; in 2-D a free block of n x n particles, of water
   and of a solid, for what a solid costs, and of water in much empty room. Prints rows `name,value,unit,target,ok`;
   bench.sh compiles it several ways and gathers them.

     bench PREFIX TARGET_RATE [full]    TARGET_RATE: M particle-steps/s of whole steps; full: all rows, else the rate
                                        only */
#include <time.h>

#include "bench_limit.h"
#include "bench_scene.h"

#define PRECISION (SPH_DOUBLE ? "f64" : "f32")
#define WIDE (SPH_DIM == 3 ? 46u : 316u) /* about 100,000 particles */
#define SCENE_WIDE (SPH_DIM == 3 ? 24u : 120u)

/* the thread's own time, so that others on the machine count little; where two threads are measured, the clock's */
static clockid_t timing = CLOCK_THREAD_CPUTIME_ID;
static double now(void)
{
    struct timespec t;
    clock_gettime(timing, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Times between the calls of the stage log. Each holds the hash that is made for the log; the pass "begin" does nothing
   else, so its time is that of the hash. */
typedef struct stages {
    double last, force, hash;
} stages;

static void at_pass(void *ctx, uint64_t step, const char *pass, uint64_t hash)
{
    stages *s = ctx;
    const double t = now();
    (void)step, (void)hash;
    if (strcmp(pass, "force") == 0)
        s->force = t - s->last;
    if (strcmp(pass, "begin") == 0)
        s->hash = t - s->last;
    s->last = now();
}

/* seconds a step: the best of `repeats` groups of steps */
static double best(tank *t, uint32_t steps, uint32_t repeats)
{
    double least = 1e300;
    for (uint32_t k = 0; k < 3; k++)
        check(t->sim, sph_step(t->sim), "warm-up");
    for (uint32_t r = 0; r < repeats; r++) {
        double from = now();
        for (uint32_t k = 0; k < steps; k++)
            check(t->sim, sph_step(t->sim), "step");
        double per = (now() - from) / steps;
        least = per < least ? per : least;
    }
    return least;
}

static void row(const char *prefix, const char *name, double value, const char *unit, double target, bool at_least)
{
    const bool ok = at_least ? value >= target : value <= target;
    if (target > 0)
        printf("%s%s,%.4g,%s,%s%g,%s\n", prefix, name, value, unit, at_least ? ">=" : "<=", target, ok ? "yes" : "no");
    else
        printf("%s%s,%.4g,%s,,\n", prefix, name, value, unit);
    fflush(stdout);
}

/* a loop of multiply-adds of known length: what a figure from another machine can be scaled by; its seconds */
static double multiply_add(void)
{
    volatile double sink;
    double x[8] = {1, 2, 3, 4, 5, 6, 7, 8}, from = now();
    for (int i = 0; i < 20000000; i++)
        for (int l = 0; l < 8; l++)
            x[l] = x[l] * 0.999999 + 1e-6;
    sink = x[0] + x[1] + x[2] + x[3] + x[4] + x[5] + x[6] + x[7];
    (void)sink;
    return now() - from;
}
static void multiply_add_job(void *arg, uint32_t chunk, uint32_t thread)
{
    (void)arg, (void)chunk, (void)thread;
    multiply_add();
}

/* the loop on one processor; and on two at once: how much more they do together. About 2 where they are two cores,
   little more than 1 where they are two threads of one core, or where others take their time. */
static void processors(const char *prefix, port_posix *two)
{
    const sph_port port = PORT_POSIX(two);
    double one = 1e300, both = 1e300;
    for (int r = 0; r < 5; r++) {
        const double own = multiply_add(), from = now();
        port.parallel(port.ctx, multiply_add_job, NULL, 2);
        both = now() - from < both ? now() - from : both;
        one = own < one ? own : one;
    }
    row(prefix, "calibration", 160 / one, "M multiply-adds/s", 0, true);
    row(prefix, "calibration_on_two", 2 * one / both, "ratio", 0, true);
}

/* seconds of the limit loop (bench_limit.h) over the pairs of a tank */
static double limit_seconds(const tank *t)
{
    double least = 1e300;
    limit_loop l = limit_of(t, WIDE);
    for (int r = 0; r < 7; r++) {
        const double from = now();
        limit_run(&l);
        least = now() - from < least ? now() - from : least;
    }
    check(NULL, l.sum - l.sum == 0 ? SPH_OK : SPH_NOT_FINITE, "limit loop");
    limit_free(&l);
    return least;
}

/* Whole step over force pass, and that over the limit loop. Hashes for the stage log would lie between the passes, so
   whole steps are those of a tank without a log, stepped in turns with one that has it; the least of each is taken. */
static void step_over_force(const char *prefix)
{
    char name[64];
    double least_step = 1e300, least_force = 1e300, least_hash = 1e300;
    stages log = {0, 0, 0};
    tank plain = fill(WIDE, NULL, NULL, NULL), logged = fill(WIDE, NULL, at_pass, &log);
    best(&plain, 1, 1);
    best(&logged, 1, 1);
    for (int r = 0; r < 15; r++) {
        double from = now();
        check(plain.sim, sph_step(plain.sim), "step");
        double step = now() - from;
        log.last = now();
        check(logged.sim, sph_step(logged.sim), "step");
        least_step = step < least_step ? step : least_step;
        least_force = log.force < least_force ? log.force : least_force;
        least_hash = log.hash < least_hash ? log.hash : least_hash;
    }
    const double force = least_force - least_hash, limit = limit_seconds(&plain);
    snprintf(name, sizeof name, "step_over_force_%ud_%s", SPH_DIM, PRECISION);
    row(prefix, name, least_step / force, "ratio", SPH_DIM == 3 ? 1.15 : 1.25, false);
    snprintf(name, sizeof name, "force_over_limit_%ud_%s", SPH_DIM, PRECISION);
    row(prefix, name, force / limit, "ratio", SPH_DOUBLE ? 0 : SPH_DIM == 3 ? 1.6 : 1.3, false);
    free(plain.arena);
    free(logged.arena);
}

/* the scene as it is; two sweeps a step */
static void scene_row(const char *prefix)
{
    char name[64];
    tank t = scene_as_it_is(SPH_DIM == 3 ? "dam_break_3d" : "dam_break", SCENE_WIDE);
    const double step = best(&t, 3, 8);
    snprintf(name, sizeof name, "scene_dam_break_%ud_%s", SPH_DIM, PRECISION);
    row(prefix, name, t.particles / step * 1e-6, "M particle-steps/s", 0, true);
    free(t.arena);
}

/* few particles in much room: 484 with 240 cells each over the same in a domain that fits */
static void empty_room(const char *prefix)
{
    double least[2] = {1e300, 1e300};
    char name[64];
    tank t[2] = {block_in(5, 22, SPH_NO_SOLID, 0, false), block_in(398, 22, SPH_NO_SOLID, 0, false)};
    for (int r = 0; r < 60; r++)
        for (int k = 0; k < 2; k++) {
            const double from = now();
            check(t[k].sim, sph_step(t[k].sim), "step");
            least[k] = now() - from < least[k] ? now() - from : least[k];
        }
    snprintf(name, sizeof name, "empty_room_2d_%s", PRECISION);
    row(prefix, name, least[1] / least[0], "ratio", 1.3, false);
    free(t[0].arena);
    free(t[1].arena);
}

/* what a step of a solid costs in steps of water, stepped in turns so that a busy machine slows both */
static void solids(const char *prefix)
{
    static const struct {
        const char *name;
        uint32_t form, repulsion;
        double most;
    } kind[] = {{"elastic", SPH_UPDATED, SPH_NO_ARTIFICIAL_STRESS, 2.5},
                {"elastic_repelling", SPH_UPDATED, SPH_PRINCIPAL, 2.5},
                {"corrected", SPH_CORRECTED, SPH_NO_ARTIFICIAL_STRESS, 0}, {"total", SPH_TOTAL,
                    SPH_NO_ARTIFICIAL_STRESS, 0}};
    char name[64];
    size_t elastic = 0;
    for (size_t k = 0; k < sizeof kind / sizeof *kind; k++) {
        double water = 1e300, solid = 1e300;
        tank w = block(200, SPH_NO_SOLID, 0, false), s = block(200, kind[k].form, kind[k].repulsion, false);
        for (int r = 0; r < 25; r++) {
            double from = now();
            check(w.sim, sph_step(w.sim), "step");
            water = now() - from < water ? now() - from : water;
            from = now();
            check(s.sim, sph_step(s.sim), "step");
            solid = now() - from < solid ? now() - from : solid;
        }
        snprintf(name, sizeof name, "%s_over_water_2d_%s", kind[k].name, PRECISION);
        row(prefix, name, solid / water, "ratio", kind[k].most, false);
        snprintf(name, sizeof name, "%s_2d_%s_40k", kind[k].name, PRECISION);
        row(prefix, name, s.particles / solid * 1e-6, "M particle-steps/s", k == 0 && !SPH_DOUBLE ? 4 : 0, true);
        snprintf(name, sizeof name, "memory_%s_2d_%s", kind[k].name, PRECISION);
        row(prefix, name, (double)s.bytes / s.particles, "bytes/particle", k < 2 && !SPH_DOUBLE ? 152 : 0, false);
        elastic = k == 0 ? s.bytes : elastic;
        free(w.arena);
        free(s.arena);
    }
    tank b = block(200, SPH_UPDATED, 0, true);
    snprintf(name, sizeof name, "memory_plastic_brittle_2d_%s", PRECISION);
    row(prefix, name, (double)(b.bytes - elastic) / b.particles, "bytes/particle more", SPH_DOUBLE ? 0 : 24, false);
    free(b.arena);
}

/* how the time of a particle-step grows with their number */
static void growth(const char *prefix)
{
    char name[64];
    tank small = fill(100, NULL, NULL, NULL), large = fill(1000, NULL, NULL, NULL);
    const double s = best(&small, 20, 5) / small.particles, l = best(&large, 2, 3) / large.particles;
    snprintf(name, sizeof name, "growth_10k_to_1M_%s", PRECISION);
    row(prefix, name, l / s, "ratio", 1.3, false);
    free(small.arena);
    free(large.arena);
}

/* in turns, so that a busy machine slows both */
static void threads(const char *prefix)
{
    static port_posix pool;
    char name[64];
    timing = CLOCK_MONOTONIC;
    if (port_posix_open(&pool, 2)) {
        double least[2] = {1e300, 1e300};
        tank t[2] = {fill(WIDE, NULL, NULL, NULL), fill(WIDE, &pool, NULL, NULL)};
        for (int r = 0; r < 30; r++)
            for (int k = 0; k < 2; k++) {
                const double from = now();
                check(t[k].sim, sph_step(t[k].sim), "step");
                least[k] = now() - from < least[k] ? now() - from : least[k];
            }
        snprintf(name, sizeof name, "two_threads_%ud_%s", SPH_DIM, PRECISION);
        row(prefix, name, least[0] / least[1], "ratio", 1.9, true);
        free(t[0].arena);
        free(t[1].arena);
        processors(prefix, &pool);
    }
    port_posix_close(&pool);
    timing = CLOCK_THREAD_CPUTIME_ID;
}

int main(int argc, char **argv)
{
    char name[64];
    if (argc < 3) {
        fprintf(stderr, "usage: bench PREFIX TARGET_RATE [full]\n");
        return 2;
    }
    tank t = fill(WIDE, NULL, NULL, NULL);
    const double step = best(&t, 5, 8);
    snprintf(name, sizeof name, "step_%ud_%s_100k", SPH_DIM, PRECISION);
    row(argv[1], name, t.particles / step * 1e-6, "M particle-steps/s", strtod(argv[2], NULL), true);
    if (argc > 3) {
        snprintf(name, sizeof name, "memory_%ud_%s_100k", SPH_DIM, PRECISION);
        row(argv[1], name, (double)t.bytes / t.particles, "bytes/particle", SPH_DIM == 3 ? 0 : SPH_DOUBLE ? 144 : 80,
            false);
        free(t.arena);
        scene_row(argv[1]);
        step_over_force(argv[1]);
        if (SPH_DIM == 2) {
            empty_room(argv[1]);
            solids(argv[1]);
            growth(argv[1]);
        }
        threads(argv[1]);
    }
    return 0;
}
