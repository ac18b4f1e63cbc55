/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* damage.c: flaws and the damage that grows from them (Benz & Asphaug 1995; Gray 2001 section 5.5), in 2-D and 3-D.

     flaws    n(eps) = k eps^m of them a unit volume fail below the strain eps (Weibull); thresholds (p/(k V))^(1/m)
     growth   d(D^(1/DIM))/dt = active crack_speed/flaw_radius while D < active/flaws
     stress   -P* I + (1 - D) S, P* = P in compression and (1 - D) P in tension (taken where stresses are loaded, sweep.c)

   Arrays: damage (one real in every state buffer), flaw_start (4 bytes a particle), flaws (4 bytes each, in order of particle id,
   rising thresholds). Cost: a local pass; no sweep. */
#include "locals.h"
#include "solid.h"

#if SPH_HAS_DAMAGE
#include "dmath.h"
#include "setup.h"

/* ---- growth ---- */

/* the largest principal value of a symmetric tensor xx yy zz xy xz yz */
static sph_real largest_principal(const sph_real *s)
{
#if SPH_DIM == 2
    const sph_real m = (s[0] + s[1]) * (sph_real)0.5, a = (s[0] - s[1]) * (sph_real)0.5;
    const sph_real one = m + SPH_SQRT(a * a + s[3] * s[3]);
    return one < s[2] ? s[2] : one; /* plane strain: zz is principal too */
#else
    /* Jacobi as in sweep.c, but for the values alone */
    sph_real a[3][3] = {{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}};
    static const uint8_t plane[3][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};
    for (int n = 0; n < 12; n++) {
        const int p = plane[n % 3][0], q = plane[n % 3][1], r = plane[n % 3][2];
        const sph_real apq = a[p][q];
        if (!(apq < 0 || apq > 0))
            continue;
        const sph_real big = SPH_DOUBLE ? (sph_real)1e100 : (sph_real)1e15, theta = (a[q][q] - a[p][p]) / (2 * apq);
        const sph_real size = theta < 0 ? -theta : theta, cut = size < big ? size : big;
        const sph_real root = 1 / (cut + SPH_SQRT(cut * cut + 1)), t = theta < 0 ? -root : root;
        const sph_real c = 1 / SPH_SQRT(t * t + 1), sn = t * c, arp = a[r][p], arq = a[r][q];
        a[p][p] -= t * apq;
        a[q][q] += t * apq;
        a[p][q] = a[q][p] = 0;
        a[r][p] = a[p][r] = c * arp - sn * arq;
        a[r][q] = a[q][r] = sn * arp + c * arq;
    }
    sph_real most = a[0][0];
    for (int k = 1; k < 3; k++)
        most = a[k][k] > most ? a[k][k] : most;
    return most;
#endif
}

/* strain that flaws compare themselves with */
static sph_real flaw_strain(const sph_sim *sim, const sph_set *set, const sph_buffer *b, uint32_t i, sph_real whole)
{
    double at[6];
    sph_real s[6];
    (void)sph_stress_of(sim, b, i, at);
    for (int k = 0; k < 6; k++)
        s[k] = (sph_real)at[k];
    const sph_real most = largest_principal(s), mu = sph_material_of(sim, set)->shear_r, bulk = (sph_real)(set->rho0 * set->c0 * set->c0);
    if (!(most > 0) || !(whole > 0))
        return 0;
    const sph_real d = 1 - whole;
    return sim->cfg.damage == SPH_BENZ_ASPHAUG_GRAY ? most / (2 * mu * (1 - d * d)) : most / (whole * (9 * bulk * mu / (3 * bulk + mu)));
}

static sph_real root_of(sph_real x)
{
#if SPH_DIM == 2
    return SPH_SQRT(x);
#else
    return x > 0 ? (sph_real)sph_pow((double)x, 1.0 / 3) : 0;
#endif
}

void sph_grow_damage(const sph_sim *sim, sph_span s)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t *id = b->id[0]; /* the particle's own by now */
    if (!sph_damages(&sim->cfg))
        return;
    for (uint32_t i = s.first; i < s.last; i++) {
        if (b->set[0][i] == SPH_DEAD || !sph_is_solid(&sim->set[b->set[0][i]]) || !(b->damage[0][i] < 1))
            continue;
        const sph_set *set = &sim->set[b->set[0][i]];
        const uint32_t from = sim->flaw_start[id[i]], flaws = sim->flaw_start[id[i] + 1] - from;
        if (flaws == 0)
            continue;
        const sph_real root = b->damage[0][i], damage = SPH_DIM == 3 ? root * root * root : root * root;
        const sph_real strain = flaw_strain(sim, set, b, i, 1 - damage);
        uint32_t active = 0;
        while (active < flaws && (sph_real)sim->flaw[from + active] < strain)
            active++;
        const sph_real most = active == flaws ? 1 : root_of((sph_real)active / (sph_real)flaws);
        if (root >= most) /* also without any active flaw */
            continue;
        const sph_real grown = root + (sph_real)(sim->dt * sph_material_of(sim, set)->crack_rate) * (sph_real)active;
        b->damage[0][i] = grown < most ? grown : most;
    }
}

/* ---- flaws ---- */

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
        return sph_setup_bad(sim, "set", "a set whose particles were added one after the other, without another set's between", set);
    return SPH_OK;
}

sph_status sph_add_flaws(sph_sim *sim, uint32_t set, const sph_flaws *f)
{
    sph_status st = sph_setup_begin_adding(sim, "sph_add_flaws");
    drawing d;
    if (st)
        return st;
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
    if ((st = find_ids(sim, set, &d)) != SPH_OK)
        return st;
    uint32_t *start = sim->flaw_start, *const end = start + d.first + d.n;
    if (start[d.first + d.n] != start[d.first])
        return sph_setup_bad(sim, "set", "a set without flaws", set);
    /* the first run of draws counts, the second places; at most so many draws, which is far beyond what any seed needs */
    const double n = d.n, wanted = n > 1 ? n * sph_log(n) : 1, volume = n * sim->set[set].mass / sim->set[set].rho0;
    const uint64_t enough = (uint64_t)(wanted + 0.5) > 1 ? (uint64_t)(wanted + 0.5) : 1, limit = 64 * (enough + 64);
    d.most = (uint32_t)enough;
    d.state = f->seed;
    const uint32_t before = sim->flaws, base = start[d.first];
    uint32_t bare = d.n, total = 0, p;
    uint64_t draws = 0;
    uint32_t *const kept = sim->buf[(sim->cur + 1) % sim->buffers].id[0]; /* counts, in the buffer that is not in use */
    memset(kept + d.first, 0, (size_t)d.n * sizeof *kept);
    for (; (draws < enough || bare > 0) && draws < limit; draws++) {
        const uint32_t id = next_flaw(&d, &p);
        if (kept[id] == SPH_MAX_FLAWS)
            continue;
        bare -= kept[id] == 0;
        kept[id]++;
        total++;
    }
    if (total > sim->cfg.max_flaws - before)
        return sph_error(sim, SPH_TOO_MANY_FLAWS, "max_flaws", "at least so many as the value says", (double)before + total, SPH_NO_PARTICLE);
    /* flaws of later ids move up to make room */
    const uint32_t ids = sim->cfg.max_particles;
    for (uint32_t k = before; k > base; k--)
        sim->flaw[k - 1 + total] = sim->flaw[k - 1];
    for (uint32_t *s = end; s <= start + ids; s++)
        *s += total;
    for (uint32_t id = d.first, at = base; id < d.first + d.n; id++) {
        start[id] = at;
        at += kept[id];
        kept[id] = 0;
    }
    d.state = f->seed;
    for (uint64_t i = 0; i < draws; i++) {
        const uint32_t id = next_flaw(&d, &p);
        if (kept[id] == SPH_MAX_FLAWS)
            continue;
        const float eps = (float)sph_pow((double)p / (f->k * volume), 1 / f->m);
        float *list = sim->flaw + start[id];
        uint32_t at = kept[id]++;
        for (; at > 0 && list[at - 1] > eps; at--)
            list[at] = list[at - 1];
        list[at] = eps;
    }
    sim->flaws = before + total;
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
