/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* walls.c: boundary forces, and Adami's extrapolation into wall particles. No array: wall particles use the state's own.

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
