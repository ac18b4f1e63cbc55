/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* quadrature.c: quadrature weights of particles beside flat faces (option face_quadrature, sph_solid.flat_faces).

   The energy of a solid is a sum over particles, sum V_i phi_i w(F_i), phi = 1: a midpoint rule, which along a normal
   through a face misses dx^2/24 dw/dn. Beside a face gradients are one-sided, too: along the face, that of row r is of
   a place deeper by delta_r (dx; the mean of what the kernel reaches, weighed with g K_t^2), which misses delta_r dx^2
   dw/dn. Both are mended to second order by weights that move energy between the rows beside a face:

     Q_i = sum V_j K^2 g_ij/Q0    phi_i = 1 + beta sum V_j K^2 g_ij/Q0 (Q_j - Q_i)    beta = (1/24 + sum delta_r)/S

   Q0 is a full lattice's sum, so Q = 1 away from faces; S is what the sum of (1 - phi_r)/beta times the depth
   r + delta_r comes to on a lattice with a face (Euler-Maclaurin; derived here; factors.c finds Q0 and beta). What is
   left of the energy of bending goes as dx^3. Forces follow from the energy: T_i = -phi_i sigma_i M_i^-T/rho,
   so momentum, angular momentum and, with energies that are weighed by phi, the books stay exact. The sum of phi - 1
   over a body is 0. Where particles stand in no order phi stays between 1/2 and 3/2. K and g are those of the form of
   solids; pairs of a held and a free set are left out of phi, for the face of a clamp is none.

   Field: quadrature (one real), made with the first forces of a particle and kept. Cost: two sweeps, once. */
#include "quadrature.h"
#include "arithmetic.h"

SPH_OBJECT(quadrature)

#if SPH_HAS_QUADRATURE
enum { SUM_Q };

/* 0: not weighed; else equal for those that are weighed with each other */
static sph_real kind_of(const sph_sim *sim, const sph_set *set)
{
    if (!sph_is_solid(set) || !sph_material_of(sim, set)->flat)
        return 0;
    return sph_held(sim, set) ? 2 : 1;
}

void sph_load_quadrature(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const sph_real volume = sph_is_solid(r->set) ? (sph_real)(r->set->mass / r->set->rho0) : 0;
    const sph_real kind = kind_of(r->sim, r->set);
    for (uint32_t j = 0; j < r->n; j++) {
        SPH_VOLUME_ROW(to, row)[j] = volume;
        SPH_KIND_ROW(to, row)[j] = kind;
    }
}

/* Q stands in acc, which is free until the forces, of solids */
void sph_load_cover(const sph_candidates *r, sph_real *to, uint32_t row)
{
    (void)row;
    for (uint32_t j = 0; j < r->n; j++)
        to[j] = sph_is_solid(r->set) ? r->b->acc[0][r->first + j] : 0;
}

/* what the pair functions know of the scene and of the home */
typedef struct weighing {
    const sph_reference_tile *was; /* null: not of the total-Lagrangian form */
    sph_reference_home home;
    const sph_real *volume, *kind, *cover;
    vreal scale, home_kind, home_cover;
} weighing;

/* V_j K^2 g_ij/Q0 of a group of candidates */
SPH_INLINE vreal share_of(const sph_gather *g, uint32_t j)
{
    const weighing *const w = g->own;
    vreal dx[SPH_DIM], k[SPH_DIM];
    vint same, apart = v_set_int(0);
    sph_gather_distance(g, j, dx);
    memcpy(k, dx, sizeof k);
    if (SPH_HAS_TOTAL && w->was)
        sph_reference_distance(&w->home, w->was, j, dx, k, &same, &apart);
    const vreal share = sph_gather_slope(g, k) * sph_dot(k, k) * v_load(w->volume + j) * w->scale;
    return v_where(~apart, share);
}
SPH_INLINE void cover_pair(const void *what, uint32_t j, vreal *s) { s[SUM_Q] = s[SUM_Q] + share_of(what, j); }
SPH_INLINE void weight_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const weighing *const w = g->own;
    const vreal more = share_of(g, j) * (v_load(w->cover + j) - w->home_cover);
    s[SUM_Q] = s[SUM_Q] + v_where(v_equal(v_load(w->kind + j), w->home_kind), more);
}

SPH_INLINE void weigh_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, bool second)
{
    const uint32_t row = SPH_NEAR_ROOM, own = SPH_HOME_ROOM;
    const sph_real *const columns = sph_near_columns_of(sim, t, SPH_COLUMN_quadrature);
    const sph_real *const home = sph_home_columns_of(sim, t, SPH_COLUMN_quadrature);
    weighing w = {.volume = SPH_VOLUME_ROW(columns, row), .kind = SPH_KIND_ROW(columns, row)};
    w.scale = v_set(sim->fac.cover);
    w.was = SPH_HAS_TOTAL && sph_is_total(&sim->cfg) ? sph_reference_of(sim, t) : NULL;
    w.cover = second ? sph_near_columns_of(sim, t, SPH_COLUMN_cover) : NULL;
    for (uint32_t h = 0; h < homes; h++) {
        if (SPH_HAS_TOTAL && w.was)
            w.home = sph_spread_reference(sph_reference_homes_of(sim, t), h);
        w.home_kind = v_set(SPH_KIND_ROW(home, own)[h]);
        w.home_cover = v_set(second ? sph_home_columns_of(sim, t, SPH_COLUMN_cover)[h] : 0);
        const sph_gather g = {t, sph_near_of(t, &t->matter), h, sim->cfg.kernel, v_set(sim->fac.inv_h), &w};
        sph_sum_home(sim, t, &t->matter, h, SPH_SUM_MASK(SUM_Q, 1), second ? weight_pair : cover_pair, &g);
    }
}
static void cover_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    weigh_tile(sim, t, homes, false);
}
static void weight_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    (void)role;
    weigh_tile(sim, t, homes, true);
}

static void cover_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    sim->buf[sim->dst].acc[0][t->home_at[h]] = v_fold(t->sum[SUM_Q][h]);
}
static void weight_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_real *const phi = &sim->buf[sim->dst].quadrature[0][t->home_at[h]];
    const sph_real more = sim->fac.weigh * v_fold(t->sum[SUM_Q][h]), most = (sph_real)0.5;
    if (!(*phi > 0)) /* those that have a weight keep it */
        *phi = 1 + (more < -most ? -most : more > most ? most : more);
}

static bool cover_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_solid(s);
}
static bool weighed_home(const sph_sim *sim, const sph_set *s) { return kind_of(sim, s) > 0; }

static uint32_t weighing_columns(const sph_sim *sim)
{
    return 1u << SPH_COLUMN_quadrature | (sph_is_total(&sim->cfg) ? 1u << SPH_COLUMN_reference : 0);
}
static uint8_t other_place(const sph_sim *sim) { return sph_is_total(&sim->cfg) ? 1 + SPH_COLUMN_reference : 0; }
static void cover_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_sweep w = {cover_home, SPH_MATTER,   SPH_SUM_MASK(SUM_Q, 1), false, weighing_columns(sim),
                         cover_tile, cover_finish, 0,                      other_place(sim)};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static void weight_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const uint32_t columns = weighing_columns(sim) | 1u << SPH_COLUMN_cover;
    const sph_sweep w = {weighed_home, SPH_MATTER,    SPH_SUM_MASK(SUM_Q, 1), false, columns,
                         weight_tile,  weight_finish, 0,                      other_place(sim)};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool weighs(const sph_sim *sim) { return sph_weighs_faces(&sim->cfg); }
const sph_pass sph_pass_cover = {"cover", sph_sweep_chunks, cover_chunk, NULL, weighs};
const sph_pass sph_pass_quadrature = {"quadrature", sph_sweep_chunks, weight_chunk, NULL, weighs};
#endif
