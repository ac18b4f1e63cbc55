/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shear.c: the gradient of the velocity of fluids, and the viscous stress made of it (shear.h).

     L_i = -(1/rho_i) sum m_j v_ij (x) x_ij g  (weak scheme: sum (m_j/rho_j))      (Wickramarachchi 2009 eq 5.5; his
           5.13 prints v_ij without the minus sign and leaves out the volume), times B with corrected gradients: exact
           where the velocity is linear
     S = (L + L^T)/2,  |S| = sqrt(2 S:S),  tau = 2 rho (nu + nu_t) (S - tr S/3) - q I
     nested       nu_t = 0, q = 0: a Newtonian fluid (eqs 5.4-5.12 in the form that keeps momentum and energy)
     Smagorinsky  nu_t = (C_s dx)^2 |S| (eq 5.19),  q = 2/3 C_I rho dx^2 |S|^2 (eq 5.32: a third of the trace of the
                  residual stress). Signs: that of 5.33; 5.17 and 5.20 print the other one, which would give energy
     as printed   nu_t = C_s dx^2 |S|^2, as the line after 5.32 has it: no viscosity by its units

   What tau takes, tau : L, is never negative: the first part by its form, and where the fluid expands q is at most what
   the first part takes, so that eddies give back no more than they get. Beside walls without slip L sees their velocity
   (mirror.h). Of the eddy viscosity the time step sees the largest: as the |mu| with which the Courant limit is
   viscous_factor h^2/(nu + nu_t).

   Array: T and that |mu|, SPH_DIM^2 + 1 reals. Cost: a sweep before the forces; the force loop sums a tensor more. */
#include "shear.h"
#include "arithmetic.h"

SPH_OBJECT(shear)

#if SPH_WITH_SHEAR
void sph_load_shear(const sph_candidates *r, sph_real *to, uint32_t row)
{
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        SPH_UNROLL_MANY
        for (uint32_t n = 0; n < SPH_NL; n++)
            v_store(to + n * row + j,
                    sph_seen_mixed(r, n / SPH_DIM, n % SPH_DIM, v_load(r->sim->shear[n] + r->first + j)));
        v_store(to + SPH_NL * row + j, v_load(r->sim->shear[SPH_NL] + r->first + j));
    }
}

typedef struct shear_scene {
    bool weak, wall;
    const sph_mirror_tile *mirror;
} shear_scene;

/* the tile's part of sum m_j v_ij (x) x_ij g */
SPH_INLINE void shear_pair(const void *what, uint32_t j, vreal *s)
{
    const sph_gather *g = what;
    const shear_scene *const own = g->own;
    sph_home home;
    sph_near p;
    p.j = j;
    sph_gather_distance(g, j, p.dx);
    vreal mg = sph_gather_slope(g, p.dx) * v_load(g->tile->m + j);
    if (own->weak)
        mg = mg * v_load(g->tile->inv_rho + j);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        home.v[k] = v_set(g->t->home.v[k][g->h]);
        p.dw[k] = home.v[k] - v_load(g->tile->v[k] + j);
    }
    if (SPH_HAS_LAYERED_WALLS && own->wall)
        sph_mirror_velocity(&home, own->mirror, &p);
    SPH_UNROLL_MANY
    for (int n = 0; n < SPH_NL; n++)
        s[n] = s[n] + mg * p.dw[n / SPH_DIM] * p.dx[n % SPH_DIM];
}
static void shear_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    const bool wall = SPH_HAS_LAYERED_WALLS && role == SPH_ROLE_GHOST;
    const shear_scene own = {sph_weak_scheme(sim->cfg.scheme), wall, wall ? sph_mirror_of(sim, t) : NULL};
    const shear_scene usual = {false, false, NULL};
    const sph_tile *const tile = sph_tile_of(t, role);
    if (SPH_WITH_FAST_PATHS && SPH_IS(sim->cfg.kernel, WENDLAND_C2) && !own.weak && !wall)
        sph_gather_by(SPH_WENDLAND_C2, sim, t, tile, homes, SPH_SUM_MASK(0, SPH_NL), shear_pair, &usual);
    else
        sph_gather_by(sim->cfg.kernel, sim, t, tile, homes, SPH_SUM_MASK(0, SPH_NL), shear_pair, &own);
}

/* what makes the gradient of a home out of its sums: B/rho, in the weak scheme B */
static void gradient_factor(const sph_sim *sim, const sph_thread *t, uint32_t h, sph_real (*b)[SPH_DIM])
{
    const sph_config *c = &sim->cfg;
    const bool weak = sph_weak_scheme(c->scheme), has_rho = weak || SPH_IS(c->gradient, BONET_LOK);
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++) {
            const sph_real plain = k == l ? 1 : 0;
            const bool own = sph_corrects_fluids(c);
            const sph_real n = own ? sim->gradient[sph_sym[k][l]][t->home_at[h]] : plain;
            b[k][l] = weak || (own && has_rho) ? n : n / t->home.rho[h];
        }
}

/* L of a home (1/s) */
static void fluid_velocity_gradient(const sph_sim *sim, const sph_thread *t, uint32_t h, const sph_real (*b)[SPH_DIM],
                              sph_real (*out)[SPH_DIM])
{
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++) {
            sph_real sum = 0;
            for (int m = 0; m < SPH_DIM; m++)
                sum += v_fold(t->sum[k * SPH_DIM + m][h]) * b[m][l];
            out[k][l] = -(sum * sim->fac.slope);
        }
}

/* turns L into tau/rho; returns nu + nu_t (m^2/s) */
static sph_real make_stress(const sph_config *c, sph_real (*l)[SPH_DIM])
{
    const sph_real dx2 = (sph_real)(c->spacing * c->spacing);
    sph_real trace = 0, square = 0, nu = (sph_real)c->nu, q = 0;
    for (int k = 0; k < SPH_DIM; k++) {
        trace += l[k][k];
        for (int m = 0; m <= k; m++) {
            l[k][m] = l[m][k] = (l[k][m] + l[m][k]) * (sph_real)0.5;
            square += (m < k ? 2 : 1) * l[k][m] * l[k][m];
        }
    }
    if (SPH_IS(c->shear, SMAGORINSKY))
        nu += (sph_real)(c->smagorinsky * c->smagorinsky) * dx2 * SPH_SQRT(2 * square);
    if (SPH_IS(c->shear, SMAGORINSKY_WICK))
        nu += (sph_real)c->smagorinsky * dx2 * (2 * square);
    if (c->shear > SPH_NESTED)
        q = (sph_real)(4.0 / 3 * c->subgrid) * dx2 * square;
    const sph_real heat = 2 * nu * (square - trace * trace * (sph_real)(1.0 / 3));
    if (trace * q > heat)
        q = heat > 0 ? heat / trace : 0;
    for (int k = 0; k < SPH_DIM; k++)
        for (int m = 0; m < SPH_DIM; m++)
            l[k][m] = 2 * nu * (l[k][m] - (k == m ? trace * (sph_real)(1.0 / 3) : 0)) - (k == m ? q : 0);
    return nu;
}

/* the |mu| with which the Courant limit is the viscous one */
static sph_real mu_of(const sph_sim *sim, const sph_set *set, sph_real nu)
{
    const sph_config *c = &sim->cfg;
    const double h = c->smoothing_length, sound = set->c0 < c->sound_speed ? set->c0 : c->sound_speed;
    const double mu = sim->courant * (double)nu / (c->viscous_factor * h * h) - sound / h;
    return c->shear > SPH_NESTED && mu > 0 ? (sph_real)mu : 0;
}

static void shear_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const uint32_t i = t->home_at[h];
    const sph_real scale = sph_weak_scheme(sim->cfg.scheme) ? t->home.rho[h] : 1; /* T = tau/rho B/rho, weak: tau B */
    sph_real b[SPH_DIM][SPH_DIM], l[SPH_DIM][SPH_DIM];
    gradient_factor(sim, t, h, b);
    fluid_velocity_gradient(sim, t, h, (const sph_real(*)[SPH_DIM])b, l);
    const sph_real nu = make_stress(&sim->cfg, l);
    for (int k = 0; k < SPH_DIM; k++)
        for (int m = 0; m < SPH_DIM; m++) {
            sph_real sum = 0;
            for (int n = 0; n < SPH_DIM; n++)
                sum += l[k][n] * b[n][m];
            sim->shear[k * SPH_DIM + m][i] = sum * scale;
        }
    sim->shear[SPH_NL][i] = mu_of(sim, &sim->set[t->home_set[h]], nu);
}

static void shear_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const uint32_t columns = SPH_HAS_LAYERED_WALLS ? 1u << SPH_COLUMN_mirror : 0;
    const sph_sweep w = {sph_matter_home, SPH_MATTER | 1u << SPH_ROLE_GHOST, SPH_SUM_MASK(0, SPH_NL),
                         sph_weak_scheme(sim->cfg.scheme), columns, shear_tile, shear_finish, 0, 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}
static bool shears(const sph_sim *sim) { return sph_shears(&sim->cfg) && sph_sums_forces(sim); }
const sph_pass sph_pass_shear = {"shear", sph_sweep_chunks, shear_chunk, NULL, shears};
#endif
