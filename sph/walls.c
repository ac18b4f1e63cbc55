/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* walls.c: boundary forces, Adami's extrapolation into wall particles, walls that move or vanish, and what happens to a
   particle that is found inside a wall. No array: wall particles use the state's own.

     Lennard-Jones   a = D ((r0/r)^12 - (r0/r)^6) r/r^2, r < r0               (Gray 2001 eq 2.38)
     kernel force    a = f(r_perp) P(r_par) n                                 (Gray 2001 eqs 2.39-2.41)
     Monaghan-Kos    a = (A/sqrt q)(1 - q) P(r_par) n, q = r_perp/(2 dx)      (Wickramarachchi 2009 eqs 6.10-6.12)
     Adami           p_w = (sum p_f W + (g - a_w) . sum rho_f r_wf W) / sum W,  v_w = 2 v_wall - sum v_f W / sum W
                                                                              (Adami, Hu & Adams 2012 eqs 22-27) */
#include "dmath.h"
#include "fluid.h"
#include "kernels.h"

#define SPH_PI 3.14159265358979323846

#if SPH_HAS_FORCE_WALLS
/* ---- boundary forces ---- */

/* the window along the wall, half a cosine wide dx on either side (Gray 2.41); in 3-D one for each direction */
static double window(const sph_set *s, const double *r, double perp, double dx)
{
    double along[2] = {0, 0}, par2 = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        double par = r[k] - perp * s->normal[k];
        par2 += par * par;
        along[0] += par * s->tangent[k]; /* stays 0 but in 3-D */
    }
    double rest2 = par2 - along[0] * along[0];
    along[1] = rest2 > 0 ? __builtin_sqrt(rest2) : 0;
    double p = 1;
    for (int k = 0; k < 2; k++) {
        if (sph_abs(along[k]) >= dx)
            return 0;
        p *= along[k] != 0 ? 0.5 * (1 + sph_cos(SPH_PI * along[k] / dx)) : 1;
    }
    return p;
}

/* size of the force along the normal at height r above a KERNEL_FORCE or MONAGHAN_KOS wall (m/s^2) */
static double normal_force(const sph_sim *sim, const sph_set *s, double r)
{
    double h = sim->cfg.smoothing_length, q = r / h;
    if (SPH_IS(s->kind, WALL_KERNEL_FORCE)) {
        double c = s->strength * s->c0 * s->c0;
        if (q >= 2)
            return 0;
        if (q >= 1)
            return c * 0.5 * (2 - q) * (2 - q) / h;
        return q > 2.0 / 3 ? c * q * (2 - 1.5 * q) / h : c * (2.0 / 3) / h;
    }
    q = r / (2 * sim->cfg.spacing);
    if (q >= 1)
        return 0;
    q = q > 1e-3 ? q : 1e-3;
    return s->strength * (1 - q) / __builtin_sqrt(q);
}

void sph_force_walls(const sph_sim *sim, sph_thread *t, uint32_t h)
{
    const double dx = sim->cfg.spacing;
    const uint32_t sum = SUM_FORCE + sph_sum_shift(&sim->cfg);
    double f[SPH_DIM] = {0}, power = 0;
    for (uint32_t j = 0; j < t->forces; j++) {
        const sph_set *s = &sim->set[t->fset[j]];
        double r[SPH_DIM], r2 = 0, perp = 0, a[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++) {
            r[k] = (double)t->home.x[k][h] - (double)t->fx[k][j];
            r2 += r[k] * r[k];
            perp += r[k] * s->normal[k];
        }
        if (SPH_IS(s->kind, WALL_LENNARD_JONES)) {
            if (!(r2 < dx * dx) || r2 < 1e-6 * dx * dx)
                continue;
            double q2 = dx * dx / r2, q6 = q2 * q2 * q2, c = s->strength * (q6 * q6 - q6) / r2;
            for (int k = 0; k < SPH_DIM; k++)
                a[k] = c * r[k];
        } else {
            if (perp < -dx || perp > sim->grid.support)
                continue;
            double c = normal_force(sim, s, perp) * window(s, r, perp, dx);
            for (int k = 0; k < SPH_DIM; k++)
                a[k] = c * s->normal[k];
        }
        for (int k = 0; k < SPH_DIM; k++) {
            f[k] += a[k];
            power += a[k] * sph_wall_velocity(sim, s, (uint32_t)k);
        }
    }
    for (int k = 0; k < SPH_DIM; k++)
        t->sum[sum][h][k] += (sph_real)f[k];
    t->sum[sum][h][SPH_DIM] += (sph_real)power;
}

#endif

#if SPH_WITH_WALL_ADAMI
/* ---- Adami's extrapolation: a sweep whose homes are wall particles ---- */

enum { SUM_W, SUM_PW, SUM_RW, SUM_UW = SUM_RW + SPH_DIM };

static bool adami_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return s->role == SPH_ROLE_GHOST && s->kind == SPH_WALL_ADAMI;
}

static void adami_home_tile(const sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_tile *f = &t->fluid;
    const bool ratio = !sph_weak_scheme(sim->cfg.scheme);
    const uint32_t kernel = sim->cfg.kernel;
    const vreal inv_h = v_set(sim->fac.inv_h);
    for (uint32_t j = 0; j < f->n; j += SPH_W) {
        const uint32_t l = j % SPH_LANES;
        vreal dx[SPH_DIM], r2 = v_set(0);
        for (int k = 0; k < SPH_DIM; k++) {
            dx[k] = v_set(t->home.x[k][h]) - v_load(f->x[k] + j);
            r2 = r2 + dx[k] * dx[k];
        }
        const vreal w = k_value(kernel, v_sqrt(r2) * inv_h), rho = v_load(f->rho + j);
        const vreal a = v_load(f->a + j), p = ratio ? a * rho * rho : a;
        v_store(t->sum[SUM_W][h] + l, v_load(t->sum[SUM_W][h] + l) + w);
        v_store(t->sum[SUM_PW][h] + l, v_load(t->sum[SUM_PW][h] + l) + p * w);
        for (int k = 0; k < SPH_DIM; k++) {
            sph_real *r = t->sum[SUM_RW + k][h] + l, *u = t->sum[SUM_UW + k][h] + l;
            v_store(r, v_load(r) + rho * dx[k] * w);
            v_store(u, v_load(u) + v_load(f->v[k] + j) * w);
        }
    }
}

static void adami_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    for (uint32_t h = 0; h < homes; h++)
        adami_home_tile(sim, t, h);
}

/* Results wait in drho and acc, which are free until the forces: other chunks may be reading the densities. */
static void adami_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h];
    const sph_set *set = &sim->set[t->home_set[h]];
    double w = (double)v_fold(t->sum[SUM_W][h]), p = (double)v_fold(t->sum[SUM_PW][h]);
    const bool wet = w * (double)sim->fac.value * set->mass > 1e-6 * set->rho0;
    for (int k = 0; k < SPH_DIM; k++) {
        /* acceleration of the wall, by difference over the step */
        const double v = sph_wall_velocity(sim, set, (uint32_t)k);
        const double a = SPH_WITH_MOVING_WALLS && sim->dt > 0 ? (v - sim->now.group[set->group].vel[k]) / sim->dt : 0;
        p += (sim->cfg.gravity[k] - a) * (double)v_fold(t->sum[SUM_RW + k][h]);
        b->acc[k][i] = (sph_real)(wet ? 2 * v - (double)v_fold(t->sum[SUM_UW + k][h]) / w : v);
    }
    p = wet ? p / w : 0;
    double d = wet ? sph_density_of(sim, set, sim->cfg.pressure_floor && p < 0 ? 0 : p) : 0;
    /* a wall that would be denser than any water can be: the fluid has collapsed onto it */
    b->drho[0][i] = (sph_real)(d > 1 ? 1 : d < -0.5 ? -0.5 : d);
}

static void adami_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    static const sph_sweep w = {adami_home, SPH_BODIES, SUM_UW + SPH_DIM, false, 0, adami_tile, adami_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static void adami_copy_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    uint32_t i = chunk * SPH_LOCAL_CHUNK, last = i + SPH_LOCAL_CHUNK < sim->next.count ? i + SPH_LOCAL_CHUNK : sim->next.count;
    t->work += last - i;
    for (uint32_t e; i < last; i = e) {
        e = sph_run_end(b->set[0], i, last);
        if (b->set[0][i] == SPH_DEAD || !adami_home(sim, &sim->set[b->set[0][i]]))
            continue;
        memcpy(b->rho[0] + i, b->drho[0] + i, (e - i) * sizeof(sph_real));
        for (uint32_t k = 0; k < SPH_DIM && sim->set[b->set[0][i]].no_slip; k++)
            memcpy(b->vel[k] + i, b->acc[k] + i, (e - i) * sizeof(sph_real));
    }
}
static bool has_adami(const sph_sim *sim) { return sim->has_adami; }
const sph_pass sph_pass_adami = {"adami walls", sph_sweep_chunks, adami_chunk, NULL, has_adami};
const sph_pass sph_pass_adami_copy = {"adami copy", sph_local_chunks, adami_copy_chunk, NULL, has_adami};

#endif

#if SPH_HAS_GROUPS
/* ---- walls and held sets that move, vanish, or are let go ---- */

sph_status sph_move_groups(sph_sim *sim, double t)
{
    for (uint32_t g = 0; g < sim->groups; g++) {
        sph_group_state *s = &sim->next.group[g];
        if (t >= s->remove_at)
            s->removed = 1;
        if (!sim->group[g].motion || s->removed)
            continue;
        double x[SPH_DIM] = {0}, v[SPH_DIM] = {0};
        sim->group[g].motion(sim->group[g].ctx, t, x, v);
        for (int k = 0; k < SPH_DIM; k++) {
            if (!(sph_abs(x[k]) < 2 * sim->grid.length[k]) || !(sph_abs(v[k]) < 1e15))
                return sph_error(sim, SPH_NOT_FINITE, "motion of a wall", "finite and inside the domain", x[k],
                                 SPH_NO_PARTICLE);
            double q = x[k] / sim->grid.quantum, leap = sph_abs(q - (double)s->moved[k]) * sim->grid.quantum;
            if (leap >= sim->grid.length[k])
                return sph_error(sim, SPH_MOVED_TOO_FAR, "motion of a wall", "less than the domain's length in a step", leap,
                                 SPH_NO_PARTICLE);
            s->moved[k] = (sph_pos)(q < 0 ? q - 0.5 : q + 0.5);
            s->vel[k] = v[k];
        }
    }
    return SPH_OK;
}

#endif

#if SPH_HAS_WALLS
/* ---- particles inside a wall ---- */

/* depth of a place inside the region behind a set's face, or a negative number if it is outside */
static double depth_inside(const sph_set *s, const double *x)
{
    double perp = 0, along[2] = {0, 0};
    for (int k = 0; k < SPH_DIM; k++)
        perp += (x[k] - s->origin[k]) * s->normal[k];
    if (!(perp < 0) || -perp > s->thick)
        return -1;
#if SPH_DIM == 2
    along[0] = -(x[0] - s->origin[0]) * s->normal[1] + (x[1] - s->origin[1]) * s->normal[0];
#elif SPH_DIM == 3
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        along[0] += (x[k] - s->origin[k]) * s->tangent[k];
        along[1] += (x[k] - s->origin[k]) * (s->normal[a] * s->tangent[b] - s->normal[b] * s->tangent[a]);
    }
#endif
    for (int k = 0; k < SPH_DIM - 1; k++)
        if (sph_abs(along[k]) > s->half[k])
            return -1;
    return -perp;
}

/* the wall a particle is least deep inside of, or SPH_MAX_SETS */
static uint32_t inside_wall(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *depth)
{
    uint32_t found = SPH_MAX_SETS;
    for (uint32_t w = 0; w < sim->sets; w++) {
        const sph_set *s = &sim->set[w];
        if (sph_is_body(s) || s->corner || sph_wall_removed(sim, s))
            continue;
        double x[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++)
            x[k] = ((double)b->pos[k][i] - (double)sph_wall_moved(sim, s, (uint32_t)k)) * sim->grid.quantum;
        double d = depth_inside(s, x);
        if (d > 0 && (found == SPH_MAX_SETS || d < *depth)) {
            found = w;
            *depth = d;
        }
    }
    return found;
}

/* a place of axis k from which a move of one cell still fits into an integer: at most about a domain's length outside */
static __attribute__((noinline)) sph_pos near_quanta(const sph_sim *sim, int k, int64_t q)
{
    const sph_pos low = -sim->grid.extent[k], high = 2 * sim->grid.extent[k] - sim->grid.cell_size[k] - 1;
    return q < low ? low : q > high ? high : (sph_pos)q;
}

#define SPH_PUT_BACK_SPACINGS 0.1 /* how far off the wall a particle is put back */

static void put_back(sph_sim *sim, const sph_buffer *b, uint32_t i, const sph_set *s, double depth)
{
    double vn = 0, off = depth + SPH_PUT_BACK_SPACINGS * sim->cfg.spacing;
    for (int k = 0; k < SPH_DIM; k++) {
        const double q = off * s->normal[k] / sim->grid.quantum; /* a wall is at most 64 spacings thick: fits */
        const sph_pos to = near_quanta(sim, k, b->pos[k][i] + (int64_t)(q < 0 ? q - 0.5 : q + 0.5));
        if (SPH_HAS_TOTAL && b->shift[k])
            b->shift[k][i] += to - b->pos[k][i];
        b->pos[k][i] = to;
        vn += ((double)b->vel[k][i] - sph_wall_velocity(sim, s, (uint32_t)k)) * s->normal[k];
    }
    if (vn < 0)
        for (int k = 0; k < SPH_DIM; k++)
            b->vel[k][i] -= (sph_real)(vn * s->normal[k]);
}

static __attribute__((noinline)) void cross_one(sph_sim *sim, uint32_t i, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    double depth = 0;
    uint32_t w = inside_wall(sim, b, i, &depth);
    if (w == SPH_MAX_SETS)
        return;
    t->crossed++;
    if (sim->cfg.on_cross == SPH_FAIL)
        sph_fail_note(t, SPH_WALL_CROSSED, b->id[0][i], depth);
    else if (sim->cfg.on_cross == SPH_REMOVE) {
        b->set[0][i] = SPH_DEAD;
        t->removed++;
    } else
        for (int turn = 0; turn < 3 && w != SPH_MAX_SETS; turn++) { /* a corner may need more than one */
            put_back(sim, b, i, &sim->set[w], depth);
            t->put_back += turn == 0;
            w = inside_wall(sim, b, i, &depth);
        }
}

void sph_cross_walls(sph_sim *sim, uint32_t first, uint32_t last, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    uint8_t *restrict const near = t->near; /* bytes may be anything: without restrict no compiler makes vectors here */
    if (sim->groups == 0 || sim->cfg.on_cross == SPH_IGNORE)
        return;
    memset(near, 0, last - first);
    for (uint32_t w = 0; w < sim->sets; w++) {
        const sph_set *s = &sim->set[w];
        if (sph_is_body(s) || s->corner || sph_wall_removed(sim, s))
            continue;
        /* one loop a wall over integers: compilers make vectors of it */
        sph_pos lo[SPH_DIM], hi[SPH_DIM];
        const sph_pos *pos[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++) {
            pos[k] = b->pos[k];
            lo[k] = SPH_WITH_MOVING_WALLS ? near_quanta(sim, k, (int64_t)s->low[k] + sph_wall_moved(sim, s, (uint32_t)k)) : s->low[k];
            hi[k] = SPH_WITH_MOVING_WALLS ? near_quanta(sim, k, (int64_t)s->high[k] + sph_wall_moved(sim, s, (uint32_t)k)) : s->high[k];
        }
        for (uint32_t i = first; i < last; i++) {
            int in = 1;
            SPH_UNROLL
            for (int k = 0; k < SPH_DIM; k++)
                in &= (pos[k][i] >= lo[k]) & (pos[k][i] <= hi[k]);
            near[i - first] |= (uint8_t)in;
        }
    }
    for (uint32_t i = first; i < last; i++)
        if (near[i - first] && b->set[0][i] != SPH_DEAD && sph_is_body(&sim->set[b->set[0][i]]))
            cross_one(sim, i, t);
}
#endif
