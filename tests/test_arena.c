/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_arena.c: SPH_ARENA_BYTES and SPH_PARTICLE_BYTES, the constants of sph.h, against what the lists of arrays and
   fields lay out, for every combination of modules. */
#include "testing.h"

static const uint32_t use_of_solid[SPH_SOLIDS] = {
    0, SPH_USE_SOLID, SPH_USE_SOLID | SPH_USE_CORRECTED, SPH_USE_SOLID | SPH_USE_CORRECTED | SPH_USE_TOTAL,
    SPH_USE_SOLID | SPH_USE_FORMS, SPH_USE_SOLID | SPH_USE_FORMS, SPH_USE_SOLID | SPH_USE_FORMS};

typedef struct combination {
    sph_config c;
    uint32_t use, flaws;
} combination;

/* combination number i; false if its modules do not go with each other */
static bool combine(uint32_t i, combination *o)
{
    sph_config *c = &o->c;
    *c = sph_config_default();
    c->spacing = 0.1;
    c->smoothing_length = 0.12;
    c->sound_speed = 10;
    for (int k = 0; k < SPH_DIM; k++)
        c->hi[k] = 1;
    c->max_particles = 1000;
    c->integrator = i & 1 ? SPH_RUNGE_KUTTA : SPH_PREDICTOR_CORRECTOR;
    c->xsph = i & 2 ? 0.5 : 0;
    c->books = i & 4;
    c->shepard_every = i & 8 ? 10 : 0;
    c->density = i & 16 ? SPH_SUMMATION : SPH_CONTINUITY;
    c->yield = i & 32 ? SPH_VON_MISES : SPH_NO_YIELD;
    c->damage = i & 64 ? SPH_BENZ_ASPHAUG : SPH_NO_DAMAGE;
    o->flaws = c->max_flaws = i & 64 ? 50 : 0;
    c->solid = i >> 7 & 3;
    c->face_quadrature = i >> 9 & 1;
    if (i >> 10 & 3) /* a form for tension */
        c->solid = SPH_TOTAL + (i >> 10 & 3);
    if (i >> 12 & 1) { /* an edge; matched layers with books */
        c->integrator = SPH_KICK_DRIFT_KICK;
        c->edge = SPH_EDGE_NATURAL;
        c->edge_width = i & 4 ? 0.3 : 0;
    }
    c->hourglass = i >> 13 & 1 ? 0.5 : 0;
    c->face[0][1] = i % 3 == 1 ? SPH_SYMMETRY : i % 3 == 2 ? SPH_MIRROR_NO_SLIP : SPH_OPEN;
    o->use = (i & 1 ? SPH_USE_RUNGE_KUTTA : 0) | (i & 2 ? SPH_USE_XSPH : 0) | (i & 4 ? SPH_USE_BOOKS : 0) |
             (i & 24 ? SPH_USE_FILTER : 0) | (i & 32 ? SPH_USE_YIELD : 0) | (i & 64 ? SPH_USE_DAMAGE : 0) |
             (i % 3 ? SPH_USE_MIRRORS : 0) | (i >> 9 & 1 ? SPH_USE_QUADRATURE : 0) | use_of_solid[c->solid] |
             (i >> 12 & 1 ? SPH_USE_EDGES : 0) | (i >> 13 & 1 ? SPH_USE_FORMS : 0);
    return sph_config_check(c, NULL) == SPH_OK;
}
enum { COMBINATIONS = 1 << 14, EXACT = (SPH_TOTAL + 1) << 8 }; /* forms and edges have one flag for several arrays */

static void the_constant_is_never_too_small(void **state)
{
    static const uint32_t particles[] = {1, 2, 63, 64, 1000, 30011}, threads[] = {1, 2, 17};
    uint32_t tried = 0;
    (void)state;
    for (uint32_t i = 0; i < COMBINATIONS; i++) {
        combination o;
        if (!combine(i, &o))
            continue;
        for (uint32_t n = 0; n < 6; n++)
            for (uint32_t t = 0; t < 3; t++) {
                o.c.max_particles = particles[n];
                o.c.max_threads = threads[t];
                uint32_t cells = 1;
                for (int k = 0; k < SPH_DIM; k++)
                    cells *= (uint32_t)(1 / (2 * o.c.smoothing_length));
                const size_t need = sph_arena_bytes(&o.c);
                const size_t bound = SPH_ARENA_BYTES(particles[n], cells, threads[t], o.use) + 4 * o.flaws;
                if (need == 0 || need > bound)
                    fail_msg("combination %u, %u particles, %u threads: %zu bytes, bound %zu", i, particles[n],
                             threads[t], need, bound);
                tried++;
            }
    }
    assert_true(tried > 1000);
}

/* a particle costs what the constant says, to the byte, but for rounding and the books' sums of each chunk */
static void a_particle_costs_what_the_constant_says(void **state)
{
    const uint32_t few = 64 * 256, many = 11 * few; /* whole pages of 64 bytes and whole chunks */
    (void)state;
    for (uint32_t i = 0; i < EXACT; i++) {
        combination o;
        if (!combine(i, &o))
            continue;
        o.c.max_particles = few;
        const size_t before = sph_arena_bytes(&o.c);
        o.c.max_particles = many;
        const size_t books = o.c.books ? (many - few) / 256 * 13 * sizeof(double) : 0;
        const size_t a_particle = (sph_arena_bytes(&o.c) - before - books) / (many - few);
        if (a_particle != SPH_PARTICLE_BYTES(o.use))
            fail_msg("combination %u: %zu bytes a particle, SPH_PARTICLE_BYTES %u", i, a_particle,
                     SPH_PARTICLE_BYTES(o.use));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_constant_is_never_too_small),
        cmocka_unit_test(a_particle_costs_what_the_constant_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
