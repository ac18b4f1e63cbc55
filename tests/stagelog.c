/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stagelog.c: where do two machines part? Runs one case of cases.h and prints a hash of every field after every pass of
   every step; or one field's values, bit for bit, after one pass of one step. firstdiff.sh compares two such logs.
   No framework, and of libc only printf, so that it runs wherever the kernel does. What to print is given when this
   file is compiled:

     -DSTAGELOG_CASE='"base"'                          lines "step,pass,name,field,hash"; step 0, pass 0 is the set-up
     ... -DSTAGELOG_STEP=1 -DSTAGELOG_PASS=4 -DSTAGELOG_FIELD='"vel"'   lines "index,id,component,bits"

   Passes are counted from 1 within a step. Beside the state fields there are dt, peaks, the filtered density (tmp) and
   the powers of the books. Before the pass "scatter" a stage's fields are still those of an older one. */
#include <stdio.h>

#include "cases.h"
#include "sph/internal.h"

#ifndef STAGELOG_CASE
#define STAGELOG_CASE "base"
#endif
#ifndef STAGELOG_STEPS
#define STAGELOG_STEPS CASE_STEPS
#endif
#ifdef STAGELOG_FIELD
enum { VALUES = 1 };
#else
enum { VALUES = 0 };
#define STAGELOG_STEP 0
#define STAGELOG_PASS 0
#define STAGELOG_FIELD ""
#endif

static SPH_ARENA(arena, CASE_ARENA_BYTES);

typedef struct place {
    sph_sim *sim;
    const sph_buffer *b;
    uint32_t count, pass;
    uint64_t step;
    const char *name;
    bool indices; /* id[] holds indices into the source buffer, as within a stage */
} place;

static bool same_text(const char *a, const char *b)
{
    while (*a && *a == *b)
        a++, b++;
    return *a == *b;
}

static uint64_t element(const void *p, size_t size, uint32_t i)
{
    const unsigned char *b = (const unsigned char *)p + size * i;
    uint64_t v = *b;
    uint32_t u;
    if (size == 8) {
        memcpy(&v, b, 8);
    } else if (size == 4) {
        memcpy(&u, b, 4);
        v = u;
    }
    return v;
}

static uint32_t id_of(const place *at, uint32_t i)
{
    const uint32_t k = at->b->id[0][i];
    return !at->indices ? k : k < at->sim->src_count ? at->sim->buf[at->sim->src].id[0][k] : SPH_NO_PARTICLE;
}

/* one component of one field: n elements of `size` bytes; they are particles' if they are as many */
static void show(const place *at, const char *field, uint32_t comp, const void *p, size_t size, uint32_t n)
{
    if (!VALUES || at->step != STAGELOG_STEP || at->pass != STAGELOG_PASS || !same_text(field, STAGELOG_FIELD))
        return;
    for (uint32_t i = 0; i < n; i++) {
        const uint64_t v = element(p, size, i);
        printf("%d,%d,%d,%08lx%08lx\n", (int)i, n == at->count ? (int)id_of(at, i) : -1, (int)comp,
               (unsigned long)(v >> 32), (unsigned long)(v & 0xffffffffu));
    }
}

static uint64_t digest(uint64_t h, const void *p, size_t size, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        h = sph_mix(h, element(p, size, i));
    return h;
}

static void field(const place *at, const char *name, const void *const *part, uint32_t comps, size_t size, uint32_t n)
{
    uint64_t h = 0;
    for (uint32_t k = 0; k < comps; k++)
        if (part[k]) {
            show(at, name, k, part[k], size, n);
            h = digest(h, part[k], size, n);
        }
    if (!VALUES && part[0])
        printf("%d,%d,%s,%s,%08lx%08lx\n", (int)at->step, (int)at->pass, at->name, name, (unsigned long)(h >> 32),
               (unsigned long)(h & 0xffffffffu));
}

static void log_place(const place *at)
{
    const sph_sim *s = at->sim;
    const void *one[SPH_POWERS] = {&s->dt};
    field(at, "dt", one, 1, sizeof s->dt, 1);
    one[0] = &s->next.peaks;
    field(at, "peaks", one, 1, sizeof(sph_real), sizeof s->next.peaks / sizeof(sph_real));
#define LOG_FIELD(name, type, comps, unit, when, way)                                                            \
    {                                                                                                       \
        const void *part[comps];                                                                            \
        for (uint32_t k = 0; k < (comps); k++)                                                              \
            part[k] = at->b->name[k];                                                                       \
        field(at, #name, part, comps, sizeof(type), at->count);                                             \
    }
    SPH_STATE_FIELDS(LOG_FIELD)
#undef LOG_FIELD
    one[0] = s->tmp;
    field(at, "tmp", one, 1, sizeof(sph_real), at->count);
    for (uint32_t k = 0; k < SPH_POWERS; k++)
        one[k] = s->power[k];
    field(at, "power", one, SPH_POWERS, sizeof(sph_real), at->count);
}

static void after_pass(void *ctx, uint64_t step, const char *pass, uint64_t hash)
{
    place *at = ctx;
    (void)hash;
    if (at->sim->pc == 0 || step != at->step)
        at->pass = 0;
    at->step = step;
    at->pass++;
    at->name = pass;
    at->b = &at->sim->buf[at->sim->dst];
    at->count = at->sim->next.count;
    /* the last pass of a stage gives the particles their ids back */
    at->indices = at->sim->pc + 1 < at->sim->passes && !same_text(pass, "settle") && !same_text(pass, "kick") &&
                  !same_text(pass, "velocity") && !same_text(pass, "correct") && !same_text(pass, "advance");
    log_place(at);
}

static sph_status run(const bits_case *b)
{
    place at = {NULL, NULL, 0, 0, 0, "set-up", false};
    sph_config c = case_config(b);
    c.stage_log = after_pass;
    c.stage_ctx = &at;
    sph_status st = sph_init(&at.sim, &c, arena, sizeof arena, NULL);
    if (!st)
        st = case_build(at.sim, b);
    if (st)
        return st;
    at.b = &at.sim->buf[at.sim->cur];
    at.count = at.sim->now.count;
    log_place(&at);
    for (uint32_t k = 0; !st && k < STAGELOG_STEPS; k++)
        st = sph_step(at.sim);
    return st;
}

int main(void)
{
    for (uint32_t k = 0; k < BITS_CASES; k++)
        if (same_text(bits_cases[k].name, STAGELOG_CASE)) {
            const sph_status st = run(&bits_cases[k]);
            if (st)
                printf("failed: %s\n", sph_status_text(st));
            return st != SPH_OK;
        }
    printf("failed: no case %s in cases.h\n", STAGELOG_CASE);
    return 2;
}
