/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* solid.c: stress. Rates of the deviatoric stress, corrected gradients, smoothed velocities for the strain rates. The pair formulas are in solid.h and fluid.c; flaws and damage in damage.c.

     rates      dS/dt = 2 mu (e - tr e/3) + W S - S W,  e = (L + L^T)/2, W = (L - L^T)/2   (Jaumann; Gray 2001 eqs 5.7-5.9)
     correction M = -sum m_j x_ij (x) K g, kept as M^-1; not over pairs of two bodies         (Bonet & Lok 1999)
     smoothing  xsph, for strain rates from v + xsph                                         (Gray 2001 eqs 2.22, 5.10)

   Arrays: stress and dstress (1, 3 or 5 reals each, in every state buffer), plastic, shift where chosen; M^-1 (DIM^2 reals, once).
   Cost: the sums of the force sweep, the way of the fields (carry.c), and a sweep each for correction and smoothing. */
#include "solid.h"

#if SPH_WITH_SOLID
#include "fluid.h"
#include "kernels.h"

/* ---- rates ---- */

/* row and column of the components that are kept */
static const uint8_t kept_at[SPH_NS][2] =
#if SPH_DIM == 1
    {{0, 0}};
#elif SPH_DIM == 2
    {{0, 0}, {1, 1}, {0, 1}};
#else
    {{0, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};
#endif

/* the deviatoric stress of one particle as a full tensor; in 2-D and 1-D of the plane or line only */
static void tensor_of(const sph_buffer *b, uint32_t i, sph_real (*s)[SPH_DIM])
{
    sph_real kept[SPH_NS], full[6] = {0};
    for (uint32_t k = 0; k < SPH_NS; k++)
        kept[k] = b->stress[k][i];
#if SPH_DIM < 3
    memcpy(full, kept, sizeof kept);
#else
    const sph_real all[6] = {kept[0], kept[1], -(kept[0] + kept[1]), kept[2], kept[3], kept[4]};
    memcpy(full, all, sizeof full);
#endif
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t l = 0; l < SPH_DIM; l++)
            s[k][l] = full[sph_sym[k][l]];
}

/* dS/dt of a stress in a velocity gradient */
static void jaumann(const sph_real (*l)[SPH_DIM], const sph_real (*s)[SPH_DIM], sph_real mu, sph_real (*rate)[SPH_DIM])
{
    sph_real trace = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        trace += l[k][k];
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t c = k; c < SPH_DIM; c++) {
            sph_real turn = 0; /* (W S - S W)_kc; S is symmetric, W antisymmetric */
            for (uint32_t m = 0; m < SPH_DIM; m++)
                turn += (sph_real)0.5 * ((l[k][m] - l[m][k]) * s[m][c] + (l[c][m] - l[m][c]) * s[m][k]);
            const sph_real e = (sph_real)0.5 * (l[k][c] + l[c][k]) - (k == c ? trace / 3 : 0);
            rate[k][c] = rate[c][k] = 2 * mu * e + turn;
        }
}

#if SPH_HAS_RATES_FIRST
/* Kick-drift-kick and leap-frog take rates once in a step dt, from the velocity of its middle at the places of its end. What
   stands here turns them into those of the middle to second order, so that finite strains and turns are followed to dt^2:
   L = G + dt/2 G G of the gradient G found, and S half a step on where S turns. */
static void to_the_middle(sph_real dt, sph_real mu, sph_real (*l)[SPH_DIM], sph_real (*s)[SPH_DIM])
{
    sph_real g[SPH_DIM][SPH_DIM], rate[SPH_DIM][SPH_DIM];
    memcpy(g, l, sizeof g);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t c = 0; c < SPH_DIM; c++) {
            sph_real sum = 0;
            for (uint32_t m = 0; m < SPH_DIM; m++)
                sum += g[k][m] * g[m][c];
            l[k][c] += (sph_real)0.5 * dt * sum;
        }
    jaumann((const sph_real(*)[SPH_DIM])l, (const sph_real(*)[SPH_DIM])s, mu, rate);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t c = 0; c < SPH_DIM; c++)
            s[k][c] += (sph_real)0.5 * dt * rate[k][c];
}
#endif

sph_real sph_stress_rates(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real *raw, sph_real rho)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    const bool weak = sph_weak_scheme(sim->cfg.scheme), solid = set->role == SPH_ROLE_SOLID, corrects = sph_corrects(&sim->cfg) && solid;
    const bool middle = SPH_HAS_RATES_FIRST && solid && sim->stage->middle;
    sph_real l[SPH_DIM][SPH_DIM], s[SPH_DIM][SPH_DIM], rate[SPH_DIM][SPH_DIM], trace = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t c = 0; c < SPH_DIM; c++) {
            sph_real sum = weak ? raw[k * SPH_DIM + c] : raw[k * SPH_DIM + c] / rho;
            if (corrects) {
                sum = 0;
                for (uint32_t m = 0; m < SPH_DIM; m++)
                    sum += raw[k * SPH_DIM + m] * sim->corr[m * SPH_DIM + c][i];
            }
            l[k][c] = -sum;
        }
    if (solid) {
        const sph_real mu = sph_material_of(sim, set)->shear_r;
        tensor_of(b, i, s);
#if SPH_HAS_RATES_FIRST
        if (middle)
            to_the_middle((sph_real)sim->dt, mu, l, s);
#endif
        jaumann((const sph_real(*)[SPH_DIM])l, (const sph_real(*)[SPH_DIM])s, mu, rate);
        for (uint32_t k = 0; k < SPH_NS; k++)
            b->dstress[k][i] = rate[kept_at[k][0]][kept_at[k][1]];
    }
    for (uint32_t k = 0; k < SPH_DIM; k++)
        trace += l[k][k];
    return middle ? (sph_real)0.5 * (sph_real)sim->dt * trace * trace - trace : -trace; /* the density half a step on, too */
}

/* ---- for those who look at it ---- */

/* the stress after damage, for those who look at it between steps */
double sph_stress_of(const sph_sim *sim, const sph_buffer *b, uint32_t i, double *stress)
{
    const sph_set *set = &sim->set[b->set[0][i]];
    double p = sph_pressure(sim, set, (double)b->rho[0][i]), damage = 0, d[5] = {0};
    if (SPH_HAS_DAMAGE && b->damage[0]) {
        const double root = (double)b->damage[0][i];
        damage = SPH_DIM == 3 ? root * root * root : root * root;
    }
    for (uint32_t k = 0; k < SPH_NS; k++)
        d[k] = (double)b->stress[k][i] * (1 - damage);
    p = p < 0 ? p * (1 - damage) : p;
#if SPH_DIM == 1
    const double s[6] = {d[0], -0.5 * d[0], -0.5 * d[0], 0, 0, 0};
#elif SPH_DIM == 2
    const double s[6] = {d[0], d[1], -(d[0] + d[1]), d[2], 0, 0};
#else
    const double s[6] = {d[0], d[1], -(d[0] + d[1]), d[2], d[3], d[4]};
#endif
    for (int k = 0; k < 6; k++)
        stress[k] = s[k] - (k < 3 ? p : 0);
    return damage;
}

/* ---- corrected gradients ---- */

#if SPH_HAS_CORRECTION
static bool solid_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return s->role == SPH_ROLE_SOLID;
}

enum { SUM_FAR = SPH_NL };

/* adds the tile's part of M to a home's sums, and the longest bond (m^2) of reference neighbours */
SPH_INLINE void correction_home(const sph_sim *sim, sph_thread *t, uint32_t h, uint32_t kernel, bool weak, bool total, bool wall)
{
    const sph_tile *c = wall ? &t->ghost : &t->fluid;
    const sph_solid_scratch *solid = sph_solid_scratch_of(sim, t);
    const vreal inv_h = v_set(sim->fac.inv_h);
    vreal s[SPH_NL + 1][SPH_NV], x[SPH_DIM], k[SPH_DIM];
    const vreal body = v_set(total ? solid->home.body[h] : 0);
    const int used = total ? SPH_NL + 1 : SPH_NL;
    SPH_UNROLL
    for (int a = 0; a < SPH_DIM; a++) {
        x[a] = v_set(t->home.x[a][h]);
        k[a] = v_set(total ? solid->home.k[a][h] : 0);
    }
    for (int a = 0; a < used; a++)
        SPH_UNROLL
        for (int v = 0; v < SPH_NV; v++)
            s[a][v] = v_load(t->sum[a][h] + v * SPH_W);
    for (uint32_t from = 0; from < c->n; from += SPH_LANES)
        SPH_UNROLL
        for (uint32_t v = 0; v < SPH_NV; v++) {
            const uint32_t j = from + v * SPH_W;
            vreal dx[SPH_DIM], kx[SPH_DIM], k2 = v_set(0), x2 = v_set(0);
            vint same = v_set_int(0), apart = same;
            if (total && !wall) {
                const vreal other = v_load(solid->tile.body + j), half = v_set((sph_real)0.5);
                same = v_less(half, body) & v_equal(body, other);
                apart = v_less(half, body) & v_less(half, other) & ~same; /* two bodies know nothing of each other's strain */
            }
            SPH_UNROLL
            for (int a = 0; a < SPH_DIM; a++) {
                kx[a] = dx[a] = x[a] - v_load(c->x[a] + j);
                if (total && !wall)
                    kx[a] = v_select(same, k[a] - v_load(solid->tile.k[a] + j), v_where(~apart, dx[a]));
                k2 = k2 + kx[a] * kx[a];
                x2 = x2 + dx[a] * dx[a];
            }
            const vreal q = v_sqrt(k2) * inv_h;
            vreal mg = k_slope(kernel, q) * v_load(c->m + j);
            if (weak)
                mg = mg * v_load(c->iv + j);
            SPH_UNROLL
            for (int a = 0; a < SPH_DIM; a++)
                SPH_UNROLL
                for (int b = 0; b < SPH_DIM; b++)
                    s[a * SPH_DIM + b][v] = s[a * SPH_DIM + b][v] + mg * dx[a] * kx[b];
            if (total && !wall)
                s[SUM_FAR][v] = v_max(s[SUM_FAR][v], v_where(same & v_less(q, v_set(sim->fac.reach)), x2));
        }
    for (int a = 0; a < used; a++)
        SPH_UNROLL
        for (int v = 0; v < SPH_NV; v++)
            v_store(t->sum[a][h] + v * SPH_W, s[a][v]);
}

static __attribute__((noinline)) void correction_any(const sph_sim *sim, sph_thread *t, uint32_t homes, bool wall)
{
    const sph_config *c = &sim->cfg;
    for (uint32_t h = 0; h < homes; h++)
        correction_home(sim, t, h, c->kernel, sph_weak_scheme(c->scheme), sph_is_total(c), SPH_HAS_LAYERED_WALLS && wall);
}

#if SPH_WITH_FAST_PATHS
/* the same text compiled with the choices as constants, as in fluid.c */
#define SPH_FAST_LIST(X)                                                                                    \
    X(cubic, SPH_CUBIC, false)                                                                              \
    X(cubic_t, SPH_CUBIC, SPH_HAS_TOTAL)                                                                    \
    X(w2, SPH_WENDLAND_C2, false)                                                                           \
    X(w2_t, SPH_WENDLAND_C2, SPH_HAS_TOTAL)
#define SPH_FAST_FN(name, kernel_, total_)                                                                  \
    static __attribute__((noinline)) void correction_##name(const sph_sim *sim, sph_thread *t, uint32_t homes)  \
    {                                                                                                       \
        for (uint32_t h = 0; h < homes; h++)                                                                \
            correction_home(sim, t, h, kernel_, false, total_, false);                                      \
    }
SPH_FAST_LIST(SPH_FAST_FN)
#undef SPH_FAST_FN
#endif

static void correction_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
#if SPH_WITH_FAST_PATHS
    const sph_config *c = &sim->cfg;
#define SPH_FAST_TRY(name, k, whole)                                                                        \
    if (role == SPH_ROLE_FLUID && c->kernel == (k) && SPH_IS(c->scheme, STANDARD) && sph_is_total(c) == (whole)) {  \
        correction_##name(sim, t, homes);                                                                   \
        return;                                                                                             \
    }
    SPH_FAST_LIST(SPH_FAST_TRY)
#undef SPH_FAST_TRY
#undef SPH_FAST_LIST
#endif
    correction_any(sim, t, homes, role == SPH_ROLE_GHOST);
}

/* inverse of m, or false where it is nearly singular: a determinant below a thousandth of a ball's with the same norm (not the
   trace: where the body has turned since the reference position, M has turned on one side) */
static bool invert(const sph_real (*m)[SPH_DIM], sph_real (*inv)[SPH_DIM])
{
    sph_real det, mean = 0;
    for (int k = 0; k < SPH_NL; k++)
        mean += m[k / SPH_DIM][k % SPH_DIM] * m[k / SPH_DIM][k % SPH_DIM];
    mean = SPH_SQRT(mean / SPH_DIM);
#if SPH_DIM == 1
    det = m[0][0];
    const bool fine = det > 0;
    (void)mean;
    inv[0][0] = 1 / (fine ? det : 1);
    return fine;
#elif SPH_DIM == 2
    det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    if (!(det > (sph_real)1e-3 * (mean * mean)))
        return false;
    inv[0][0] = m[1][1] / det;
    inv[1][1] = m[0][0] / det;
    inv[0][1] = -m[0][1] / det;
    inv[1][0] = -m[1][0] / det;
    return true;
#else
    sph_real co[3][3];
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3, c = (l + 1) % 3, d = (l + 2) % 3;
            co[k][l] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    det = m[0][0] * co[0][0] + m[0][1] * co[0][1] + m[0][2] * co[0][2];
    if (!(det > (sph_real)1e-3 * (mean * mean * mean)))
        return false;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            inv[k][l] = co[l][k] / det;
    return true;
#endif
}

static void correction_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h];
    const bool weak = sph_weak_scheme(sim->cfg.scheme);
    const sph_real plain = weak ? 1 : 1 / t->home.rho[h];
    sph_real m[SPH_DIM][SPH_DIM], inv[SPH_DIM][SPH_DIM];
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            m[k][l] = -v_fold(t->sum[k * SPH_DIM + l][h]) * sim->fac.slope;
    const bool fine = invert((const sph_real(*)[SPH_DIM])m, inv);
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++)
            sim->corr[k * SPH_DIM + l][i] = fine ? inv[k][l] : k == l ? plain : 0;
#if SPH_HAS_TOTAL
    if (!sph_is_total(&sim->cfg))
        return;
    for (uint32_t k = 0; k < SPH_DIM; k++) { /* integers of reference positions must not overflow */
        const sph_pos s = sim->buf[sim->dst].shift[k][i], half = sim->grid.extent[k] / 2;
        if (s > half || s < -half)
            sph_fail_note(t, SPH_MOVED_TOO_FAR, sph_source_id(sim, i), (double)s * sim->grid.quantum);
    }
    const sph_real far = v_fold_max(t->sum[SUM_FAR][h]), most = (sph_real)(sim->grid.support * sim->cfg.max_stretch);
    if (!(far < most * most))
        sph_fail_note(t, SPH_BOND_TOO_LONG, sph_source_id(sim, i), __builtin_sqrt((double)far));
#endif
}

static void correction_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const bool total = sph_is_total(&sim->cfg);
    const sph_sweep w = {solid_home,
                         SPH_BODIES | 1u << SPH_ROLE_GHOST,
                         total ? SPH_NL + 1 : SPH_NL,
                         sph_weak_scheme(sim->cfg.scheme),
                         total ? SPH_COL_REFERENCE : 0,
                         correction_tile,
                         correction_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool corrects(const sph_sim *sim) { return sph_corrects(&sim->cfg); }
const sph_pass sph_pass_correction = {"correction", sph_sweep_chunks, correction_chunk, NULL, corrects};
#endif

/* ---- smoothed velocities for the strain rates ---- */

#if SPH_HAS_HAT
static bool body_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_body(s);
}

static void smooth_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    const sph_tile *c = &t->fluid;
    (void)role;
    for (uint32_t h = 0; h < homes; h++)
        for (uint32_t j = 0; j < c->n; j += SPH_W) {
            const uint32_t lane = j % SPH_LANES;
            vreal r2 = v_set(0);
            for (int k = 0; k < SPH_DIM; k++) {
                const vreal d = v_set(t->home.x[k][h]) - v_load(c->x[k] + j);
                r2 = r2 + d * d;
            }
            const vreal w = k_value(sim->cfg.kernel, v_sqrt(r2) * sim->fac.inv_h) * v_load(c->m + j) / (t->home.rho[h] + v_load(c->rho + j));
            for (int k = 0; k < SPH_DIM; k++) {
                sph_real *sum = t->sum[k][h] + lane;
                v_store(sum, v_load(sum) + w * (v_load(c->v[k] + j) - t->home.v[k][h]));
            }
        }
}

static void smooth_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h], held = sph_held(sim, &sim->set[t->home_set[h]]);
    const sph_real scale = sim->fac.value * (sph_real)(2 * sim->cfg.xsph);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        sim->buf[sim->dst].xsph[k][i] = held >> k & 1 ? 0 : v_fold(t->sum[k][h]) * scale;
}

static void smooth_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    static const sph_sweep w = {body_home, SPH_BODIES, SPH_DIM, false, 0, smooth_tile, smooth_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool smooths(const sph_sim *sim) { return sph_smooths_strain(&sim->cfg); }
const sph_pass sph_pass_smooth = {"smoothing", sph_sweep_chunks, smooth_chunk, NULL, smooths};
#endif
#endif
