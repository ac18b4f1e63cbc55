/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* adami.c: Adami's walls: pressure, and for no slip velocity, extrapolated from the matter into wall particles, with
   W = W(x_wf):

     p_w = (sum p_f W + (g - a_w) . sum rho_f x_wf W)/sum W,   v_w = 2 v_wall - sum v_f W/sum W
                                                                              (Adami, Hu & Adams 2012 eqs 22-27)

   No array: results wait in the wall's own rates, which are free until the forces, because other chunks may be
   reading the densities; a local pass then makes them the wall's density and velocity. Cost: a sweep whose homes are
   wall particles. */
#include "pair.h"
#include "arithmetic.h"

SPH_OBJECT(adami)

#if SPH_WITH_WALL_ADAMI
enum { SUM_W, SUM_PW, SUM_RW, SUM_UW = SUM_RW + SPH_DIM, SUMS = SUM_UW + SPH_DIM };

static bool adami_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return s->role == SPH_ROLE_GHOST && s->kind == SPH_WALL_ADAMI;
}

#if SPH_HAS_SIDES
/* a home of a one-sided wall: where it stands from the middle of its face, along the axes of that; half the face */
typedef struct sided {
    bool ratio, face;
    vreal frame[SPH_DIM][SPH_DIM], at[SPH_DIM], half[SPH_DIM];
} sided;

static sided side_of(const sph_sim *sim, const sph_thread *t, uint32_t h, bool ratio)
{
    const sph_set *const s = &sim->set[t->home_set[h]];
    double frame[SPH_DIM][SPH_DIM];
    sided o = {.ratio = ratio, .face = s->side == SPH_FACE};
    sph_frame_of(s, frame);
    for (uint32_t l = 0; l < SPH_DIM; l++) {
        double at = 0;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const double moved = (double)sim->buf[sim->dst].pos[k][t->home_at[h]] - (double)sph_wall_moved(sim, s, k);
            at += frame[l][k] * (moved * sim->grid.quantum - s->origin[k]);
            o.frame[l][k] = v_set((sph_real)frame[l][k]);
        }
        o.at[l] = v_set((sph_real)at);
        o.half[l] = v_set((sph_real)(l ? s->half[l - 1] : 0));
    }
    return o;
}

/* whether candidates are acted on, x_ij being the distances to them */
SPH_INLINE vint are_acted_on(const sided *o, const vreal *dx)
{
    vint acts = v_set_int(-1);
    for (uint32_t l = 0; l < SPH_DIM; l++) {
        vreal x = o->at[l];
        for (uint32_t k = 0; k < SPH_DIM; k++)
            x = x - o->frame[l][k] * dx[k];
        if (l == 0)
            acts &= v_less(v_set(0), x);
        else if (o->face)
            acts &= ~v_less(o->half[l], v_abs(x));
    }
    return acts;
}
#endif

SPH_INLINE void adami_sums(const sph_near_tile *f, uint32_t j, bool ratio, const vreal *dx, vreal w, vreal *s)
{
    const vreal rho = v_load(f->rho + j), a = v_load(f->press + j);
    const vreal p = ratio ? a * rho * rho : a;
    s[SUM_W] = s[SUM_W] + w;
    s[SUM_PW] = s[SUM_PW] + p * w;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        s[SUM_RW + k] = s[SUM_RW + k] + rho * dx[k] * w;
        s[SUM_UW + k] = s[SUM_UW + k] + v_load(f->v[k] + j) * w;
    }
}
SPH_INLINE void adami_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    adami_sums(g->tile, j, *(const bool *)g->own, dx, sph_gather_value(g, dx), s);
}
#if SPH_HAS_SIDES
SPH_INLINE void adami_sided_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const sided *const o = g->own;
    vreal dx[SPH_DIM];
    sph_gather_distance(g, j, dx);
    adami_sums(g->tile, j, o->ratio, dx, v_where(are_acted_on(o, dx), sph_gather_value(g, dx)), s);
}
/* scenes with one-sided walls: home by home */
static void adami_sided_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, bool ratio)
{
    for (uint32_t h = 0; h < homes; h++) {
        sph_gather g = {t, sph_near_of(t, &t->matter), h, sim->cfg.kernel, v_set(sim->fac.inv_h), &ratio};
        if (!sim->set[t->home_set[h]].side) {
            sph_sum_home(sim, t, &t->matter, h, SPH_SUM_MASK(0, SUMS), adami_pair, &g);
            continue;
        }
        const sided o = side_of(sim, t, h, ratio);
        g.own = &o;
        sph_sum_home(sim, t, &t->matter, h, SPH_SUM_MASK(0, SUMS), adami_sided_pair, &g);
    }
}
#else
static void adami_sided_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, bool ratio)
{
    (void)sim, (void)t, (void)homes, (void)ratio;
}
#endif
static void adami_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    static const bool standard = true;
    const bool ratio = !sph_weak_scheme(sim->cfg.scheme);
    (void)role;
    if (SPH_HAS_SIDES && sim->sided)
        adami_sided_tile(sim, t, homes, ratio);
    else if (SPH_WITH_FAST_PATHS && SPH_IS(sim->cfg.kernel, WENDLAND_C2) && ratio)
        sph_gather_by(SPH_WENDLAND_C2, sim, t, &t->matter, homes, SPH_SUM_MASK(0, SUMS), adami_pair, &standard);
    else
        sph_gather_tile(sim, t, &t->matter, homes, SPH_SUM_MASK(0, SUMS), adami_pair, &ratio);
}

static void adami_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h];
    const sph_set *set = &sim->set[t->home_set[h]];
    double w = (double)v_fold(t->sum[SUM_W][h]), p = (double)v_fold(t->sum[SUM_PW][h]);
    const bool wet = w * (double)sim->fac.value * set->mass > 1e-6 * set->rho0;
    for (int k = 0; k < SPH_DIM; k++) {
        const double v = sph_wall_velocity(sim, set, (uint32_t)k);
        const double a = SPH_WITH_MOVING_WALLS ? sim->wall_acc[set->group][k] : 0;
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
    static const sph_sweep w = {adami_home,   SPH_MATTER, SPH_SUM_MASK(0, SUMS), false, 0, adami_tile,
                                adami_finish, 0,          0};
    sph_sweep_chunk(sim, &w, chunk, t);
}

/* what was found becomes the wall's */
static void adami_copy_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const sph_span s = sph_chunk_span(sim, chunk);
    t->work += s.last - s.first;
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        if (b->set[0][i] == SPH_DEAD || !adami_home(sim, &sim->set[b->set[0][i]]))
            continue;
        memcpy(b->rho[0] + i, b->drho[0] + i, (e - i) * sizeof(sph_real));
        for (uint32_t k = 0; k < SPH_DIM && sim->set[b->set[0][i]].no_slip; k++)
            memcpy(b->vel[k] + i, b->acc[k] + i, (e - i) * sizeof(sph_real));
    }
}
/* rates ask for the densities of walls in some schemes only */
static bool has_adami(const sph_sim *sim)
{
    return sim->has_adami && (sph_sums_forces(sim) || !SPH_IS(sim->cfg.scheme, STANDARD));
}
const sph_pass sph_pass_adami = {"adami walls", sph_sweep_chunks, adami_chunk, NULL, has_adami};
const sph_pass sph_pass_adami_copy = {"adami copy", sph_local_chunks, adami_copy_chunk, NULL, has_adami};
#endif
