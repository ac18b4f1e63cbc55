/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* count.c: runs one set-up for some steps under an instruction counter (count.sh) and prints the particle-steps it
   made: of every particle, walls too, after each step. Compiled for each build.

     count SETUP N STEPS    bench: the dam break of bench.c; corrected: the same with corrected gradients; elastic,
                            total: its block of a solid; plain, stabilised: that block with Powell's kernel (2012);
                            tight, empty: its block of water, in a domain that fits and in much room; default, no_books,
                            large_eddies, shifting, damper, antuono: the scene dam_break or dam_break_3d as it is,
                            without books, with large eddies, with its particles shifted, with the acoustic damper, with
                            density diffusion after Antuono */
#include "bench_setups.h"
#include "examples/scenes/scene.h"

/* kernels that count.sh compares with may not have them */
static void correct(sph_config *c)
{
#ifdef SPH_WITH_BONET_LOK
    c->gradient = SPH_BONET_LOK;
#else
    (void)c;
#endif
}

/* kernel and smoothing length of Powell 2012 section 4.4, integrator of the scenes */
static void as_powell(sph_config *c)
{
    c->kernel = SPH_CUBIC;
    c->smoothing_length = 1.3;
    c->integrator = SPH_KICK_DRIFT_KICK;
}

static void antuono(double *p)
{
#ifdef SPH_WITH_ANTUONO
    p[SCENE_OF_diffusion] = SPH_ANTUONO;
#else
    (void)p;
#endif
}

static void large_eddies(double *p)
{
#ifdef SPH_WITH_SHEAR
    p[SCENE_OF_shear] = SPH_SMAGORINSKY;
#else
    (void)p;
#endif
}

/* a scene with the defaults of its table, but for n and what it is asked to leave out or to do besides */
static tank scene_tank(const char *name, uint32_t n, const char *how)
{
    static double p[64]; /* motions of a scene would read it */
    const scene *s = NULL;
    sph_config c;
    tank t;
    for (const scene *const *k = scene_table; *k; k++)
        s = strcmp((*k)->name, name) == 0 ? *k : s;
    check(NULL, s && s->params <= 64 ? SPH_OK : SPH_BAD_ARGUMENT, name);
    for (uint32_t i = 0; i < s->params; i++)
        p[i] = strcmp(s->param[i].name, "n") == 0 ? n : s->param[i].value;
    p[SCENE_OF_books] = strcmp(how, "no_books") != 0;
#ifdef SPH_WITH_SHIFTING /* as above */
    p[SCENE_OF_shifting] = strcmp(how, "shifting") == 0 ? 0.5 : 0;
#endif
#ifdef SPH_WITH_DAMPER
    p[SCENE_OF_damper] = strcmp(how, "damper") == 0 ? 0.2 : 0;
#endif
    if (strcmp(how, "antuono") == 0)
        antuono(p);
    if (strcmp(how, "large_eddies") == 0)
        large_eddies(p);
    s->configure(p, &c);
    t.bytes = sph_arena_bytes(&c);
    t.arena = aligned_alloc(SPH_ALIGN, (t.bytes + 63) / 64 * 64);
    check(NULL, t.arena ? sph_init(&t.sim, &c, t.arena, t.bytes, NULL) : SPH_ARENA_TOO_SMALL, "init");
    check(t.sim, s->build(t.sim, p), "build");
    check(t.sim, sph_ready(t.sim), "ready");
    t.particles = sph_count(t.sim);
    return t;
}

int main(int argc, char **argv)
{
    const char *dam_break = SPH_DIM == 3 ? "dam_break_3d" : "dam_break";
    unsigned long long done = 0;
    tank t;
    if (argc != 4) {
        fprintf(stderr, "usage: count bench|corrected|elastic|total|plain|stabilised|tight|empty|default|no_books|"
                        "large_eddies|shifting|damper|antuono N STEPS\n");
        return 2;
    }
    const uint32_t n = (uint32_t)strtoul(argv[2], NULL, 10), steps = (uint32_t)strtoul(argv[3], NULL, 10);
    if (strcmp(argv[1], "bench") == 0)
        t = fill(n, NULL, NULL, NULL);
    else if (strcmp(argv[1], "corrected") == 0)
        t = fill_as(n, NULL, NULL, NULL, correct);
    else if (strcmp(argv[1], "elastic") == 0)
        t = block(n, SPH_UPDATED, SPH_NO_ARTIFICIAL_STRESS, false);
    else if (strcmp(argv[1], "total") == 0)
        t = block(n, SPH_TOTAL, SPH_NO_ARTIFICIAL_STRESS, false);
    else if (strcmp(argv[1], "plain") == 0)
        t = block_as(5, n, SPH_UPDATED, SPH_NO_ARTIFICIAL_STRESS, false, as_powell);
#ifdef SPH_HAS_STABILISED /* as above */
    else if (strcmp(argv[1], "stabilised") == 0)
        t = block_as(5, n, SPH_STABILISED, SPH_NO_ARTIFICIAL_STRESS, false, as_powell);
#endif
    else if (strcmp(argv[1], "tight") == 0)
        t = block_in(5, n, SPH_NO_SOLID, 0, false);
    else if (strcmp(argv[1], "empty") == 0)
        t = block_in(398, n, SPH_NO_SOLID, 0, false);
    else
        t = scene_tank(dam_break, n, argv[1]);
    for (uint32_t k = 0; k < steps; k++) {
        check(t.sim, sph_step(t.sim), "step");
        done += sph_count(t.sim);
    }
    printf("%llu\n", done);
    return 0;
}
