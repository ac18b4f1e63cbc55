/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* flaws.c: the flaws that damage grows from: n(eps) = k eps^m of them a unit volume fail below the strain eps
   (Weibull), with thresholds (p/(k V))^(1/m) (Gray 2001 eqs 5.40, 5.41). Drawn between steps; how damage grows is in
   damage.c. */
#include "dmath.h"
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(flaws)

#if SPH_HAS_DAMAGE
/* splitmix64 (Steele, Lea & Flood 2014) */
static uint64_t draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}
/* evenly out of 0 .. n-1, n < 2^32: the high half of a product (its bias is below n/2^32) */
static uint32_t below(uint64_t *state, uint32_t n) { return (uint32_t)((draw(state) >> 32) * n >> 32); }

typedef struct drawing {
    uint64_t state;
    uint32_t first, n, most; /* ids first .. first + n - 1; p out of 1 .. most */
} drawing;

/* One draw: *p and the id of the particle. */
static uint32_t next_flaw(drawing *d, uint32_t *p)
{
    *p = 1 + below(&d->state, d->most);
    return d->first + below(&d->state, d->n);
}

/* Ids of a set are neighbours if its particles were added at once; else the flaws cannot be kept in order of id. */
static sph_status find_ids(sph_sim *sim, uint32_t set, drawing *d)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    uint32_t last = 0;
    d->first = 0xffffffffu;
    d->n = 0;
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (b->set[0][i] == set) {
            d->first = b->id[0][i] < d->first ? b->id[0][i] : d->first;
            last = b->id[0][i] > last ? b->id[0][i] : last;
            d->n++;
        }
    if (d->n == 0)
        return sph_setup_bad(sim, "set", "a set with particles", set);
    if (last - d->first + 1 != d->n)
        return sph_setup_bad(sim, "set",
                             "a set whose particles were added one after the other, without another set's between",
                             set);
    return SPH_OK;
}

/* whether a set may be given flaws like these */
static sph_status check_flaws(sph_sim *sim, uint32_t set, const sph_flaws *f)
{
    if (!sph_damages(&sim->cfg))
        return sph_setup_bad(sim, "damage", "a configuration with damage", sim->cfg.damage);
    if (set >= sim->sets || !sph_is_solid(&sim->set[set]))
        return sph_setup_bad(sim, "set", "a number given by sph_add_solid", set);
    if (!f)
        return sph_setup_bad(sim, "flaws", "a description of the flaws", 0);
    if (!(f->k > 0 && f->k < 1e300))
        return sph_setup_bad(sim, "flaws.k", "> 0 and finite", f->k);
    if (!(f->m >= 1 && f->m <= 50))
        return sph_setup_bad(sim, "flaws.m", "1 .. 50", f->m);
    return SPH_OK;
}

/* The first run of draws, `enough` or more: how many flaws each particle gets, into kept, and all together; *draws: how
   many it took, at most so many that no seed needs more. */
static uint32_t count_flaws(drawing d, uint64_t enough, uint32_t *kept, uint64_t *draws)
{
    const uint64_t limit = 64 * (enough + 64);
    uint32_t bare = d.n, total = 0, p;
    memset(kept + d.first, 0, (size_t)d.n * sizeof *kept);
    for (*draws = 0; (*draws < enough || bare > 0) && *draws < limit; ++*draws) {
        const uint32_t id = next_flaw(&d, &p);
        if (kept[id] == SPH_MAX_FLAWS)
            continue;
        bare -= kept[id] == 0;
        kept[id]++;
        total++;
    }
    return total;
}

/* room for the flaws of the set's particles: those of later ids move up; kept is 0 again */
static void make_room(sph_sim *sim, const drawing *d, uint32_t *kept, uint32_t total)
{
    uint32_t *start = sim->flaw_start, *const end = start + d->first + d->n;
    const uint32_t base = start[d->first];
    for (uint32_t k = sim->flaws; k > base; k--)
        sim->flaw[k - 1 + total] = sim->flaw[k - 1];
    for (uint32_t *s = end; s <= start + sim->cfg.max_particles; s++)
        *s += total;
    for (uint32_t id = d->first, at = base; id < d->first + d->n; id++) {
        start[id] = at;
        at += kept[id];
        kept[id] = 0;
    }
    sim->flaws += total;
}

/* the same draws again: thresholds in rising order */
static void place_flaws(sph_sim *sim, drawing d, const sph_flaws *f, double volume, uint32_t *kept, uint64_t draws)
{
    for (uint64_t i = 0; i < draws; i++) {
        uint32_t p;
        const uint32_t id = next_flaw(&d, &p);
        if (kept[id] == SPH_MAX_FLAWS)
            continue;
        const float eps = (float)sph_pow((double)p / (f->k * volume), 1 / f->m);
        float *list = sim->flaw + sim->flaw_start[id];
        uint32_t at = kept[id]++;
        for (; at > 0 && list[at - 1] > eps; at--)
            list[at] = list[at - 1];
        list[at] = eps;
    }
}

sph_status sph_add_flaws(sph_sim *sim, uint32_t set, const sph_flaws *f)
{
    sph_status st = sph_setup_begin_adding(sim, "sph_add_flaws");
    drawing d;
    if (st || (st = check_flaws(sim, set, f)) != SPH_OK || (st = find_ids(sim, set, &d)) != SPH_OK)
        return st;
    if (sim->flaw_start[d.first + d.n] != sim->flaw_start[d.first])
        return sph_setup_bad(sim, "set", "a set without flaws", set);
    const double n = d.n, wanted = n > 1 ? n * sph_log(n) : 1, volume = n * sim->set[set].mass / sim->set[set].rho0;
    const uint64_t enough = (uint64_t)(wanted + 0.5) > 1 ? (uint64_t)(wanted + 0.5) : 1;
    d.most = (uint32_t)enough;
    d.state = f->seed;
    uint32_t *const kept = sim->buf[(sim->cur + 1) % sim->buffers].id[0]; /* in the buffer that is not in use */
    uint64_t draws;
    const uint32_t total = count_flaws(d, enough, kept, &draws);
    if (total > sim->cfg.max_flaws - sim->flaws)
        return sph_error(sim, SPH_TOO_MANY_FLAWS, "max_flaws", "at least so many as the value says",
                         (double)sim->flaws + total, SPH_NO_PARTICLE);
    make_room(sim, &d, kept, total);
    place_flaws(sim, d, f, volume, kept, draws);
    uint64_t h = sph_mix(sim->setup_hash, (uint64_t)set | (uint64_t)total << 32);
    sim->setup_hash = sph_mix_double(sph_mix_double(sph_mix(h, f->seed), f->k), f->m);
    return SPH_OK;
}

sph_status sph_get_flaws(const sph_sim *sim, uint32_t id, uint32_t *count, float *threshold)
{
    if (!sim || !count || !sph_damages(&sim->cfg) || id >= sim->cfg.max_particles)
        return SPH_BAD_ARGUMENT;
    const uint32_t from = sim->flaw_start[id];
    *count = sim->flaw_start[id + 1] - from;
    for (uint32_t k = 0; threshold && k < *count; k++)
        threshold[k] = sim->flaw[from + k];
    return SPH_OK;
}
#endif
