/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* stress.c: the stress of solids: what a particle brings to a tile (T, and R on tension), and the rates of the
   deviatoric stress from the velocity gradient L. The pair formulas are in stress.h.

     rates      dS/dt = 2 mu (e - tr e/3) + W S - S W,  e = (L + L^T)/2, W = (L - L^T)/2 (Jaumann; Gray 2001 5.7-5.9)

   Arrays: stress and dstress (1, 3 or 5 reals each, in every state buffer). Cost: the sums of the force sweep. */
#include "stress.h"
#include "arithmetic.h"

SPH_OBJECT(stress)

#if SPH_WITH_SOLID
#include "eos_lanes.h"
#include "quadrature.h"

/* ---- columns ---- */

/* Artificial stress of a symmetric stress tensor, positive in tension: r = eps w (its tensile part), w being 1/rho^2
   or 1. By components: each component where it is positive (Monaghan 2000). On principal axes: sum over the principal
   stresses above 0 of eps w sigma n (x) n. In 2-D with m = (xx + yy)/2, a = (xx - yy)/2 and d = sqrt(a^2 + xy^2) they
   are m +- d, and n (x) n = (1 +- [a xy; xy -a]/d)/2; where d vanishes the axes are not defined, but the difference
   of the two tensile parts is at most 2 d, so a floor `small` under the divisor is all it takes (Gray 2001 section
   5.4 adds a stress difference). */
SPH_INLINE void tensile_part_2d(const vreal *sigma, vreal small, vreal *r)
{
    const vreal half = v_set((sph_real)0.5), xx = sigma[0], yy = sigma[SPH_DIM > 1], xy = sigma[SPH_NT - 1];
    const vreal m = (xx + yy) * half, a = (xx - yy) * half;
    const vreal d = v_sqrt(a * a + xy * xy), one = v_pos(m + d), two = v_pos(m - d);
    const vreal mean = (one + two) * half, diff = (one - two) * half / v_max(d, small);
    r[0] = mean + diff * a;
    r[SPH_DIM > 1] = mean - diff * a;
    r[SPH_NT - 1] = diff * xy;
}
SPH_INLINE void tensile_part_3d(const vreal *sigma, vreal *r)
{
    vreal a[3][3], e[3][3], pos[3];
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            a[k][l] = sigma[sph_sym[k][l]];
    sph_principal(a, e);
    for (int k = 0; k < 3; k++)
        pos[k] = v_pos(a[k][k]);
    for (int k = 0; k < 3; k++)
        for (int l = k; l < 3; l++)
            r[sph_sym[k][l]] = pos[0] * e[k][0] * e[l][0] + pos[1] * e[k][1] * e[l][1] + pos[2] * e[k][2] * e[l][2];
}
SPH_INLINE void tensile_part(const vreal *sigma, bool principal, vreal small, vreal *r)
{
    for (int k = 0; k < SPH_NT && (!principal || SPH_DIM == 1); k++)
        r[k] = v_pos(sigma[k]);
    if (principal && SPH_DIM == 2)
        tensile_part_2d(sigma, small, r);
    if (principal && SPH_DIM == 3)
        tensile_part_3d(sigma, r);
}

/* sigma of W particles from index i on: -p I and, of solids, the deviator, after damage (Gray 2001 eqs 5.33, 5.34) */
SPH_INLINE void stress_at(const sph_candidates *r, uint32_t i, vreal excess, vreal *s)
{
    const bool floor = r->sim->cfg.pressure_floor && !sph_is_solid(r->set);
    vreal p = sph_pressure_of(r->set->eos, floor, v_set(r->set->b_r), excess), kept[SPH_NS];
    SPH_UNROLL
    for (int k = 0; k < SPH_NS; k++)
        kept[k] = v_load(r->b->stress[k] + i);
    if (SPH_HAS_DAMAGE && r->b->damage[0]) {
        const vreal whole = 1 - sph_power_of_dim(v_load(r->b->damage[0] + i));
        p = v_select(v_less(p, v_set(0)), whole * p, p);
        SPH_UNROLL
        for (int k = 0; k < SPH_NS; k++)
            kept[k] = kept[k] * whole;
    }
    sph_deviator(kept, s);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        s[k] = s[k] - p;
}

/* sigma as a full tensor, with what a matched layer adds (edges.c) */
SPH_INLINE void full_stress(const sph_candidates *r, uint32_t i, const vreal *s, vreal *full)
{
    const bool matched = SPH_HAS_EDGES && r->sim->layer[0];
    SPH_UNROLL_MANY
    for (uint32_t k = 0; k < SPH_NL; k++)
        full[k] = s[sph_sym[k / SPH_DIM][k % SPH_DIM]];
    for (uint32_t k = 0; matched && k < SPH_NL; k++)
        full[k] = full[k] + v_load(r->sim->layer[k] + i);
}

/* T with corrected gradients: -sigma M^-T over rho (standard) or 1 (weak) */
SPH_INLINE void corrected_stress(const sph_candidates *r, uint32_t i, vreal rho, const vreal *s, vreal *t)
{
    const vreal scale = sph_weak_scheme(r->sim->cfg.scheme) ? v_set(-1) : -1 / rho;
    for (int k = 0; k < SPH_DIM; k++)
        for (int l = 0; l < SPH_DIM; l++) {
            vreal sum = v_set(0);
            for (int m = 0; m < SPH_DIM; m++) { /* the index that is summed turns as both: 1 but in no-slip images */
                const sph_real turn = r->im->flip[m] * (sph_real)r->im->sign[m];
                sum = sum + s[k * SPH_DIM + m] * (turn * v_load(r->sim->corr[l * SPH_DIM + m] + i));
            }
            t[k * SPH_DIM + l] = sum * scale;
        }
}

/* R of W particles, where the scene has it */
SPH_INLINE void load_repulsion(const sph_candidates *r, const vreal *s, vreal w, sph_real *to, uint32_t row)
{
    const sph_sim *sim = r->sim;
    vreal part[SPH_NT];
    tensile_part(s, sim->cfg.artificial_stress == SPH_PRINCIPAL, v_set(r->set->b_r * (sph_real)1e-9), part);
    const vreal scale = w * (sph_is_solid(r->set) ? sim->fac.repulsion : 0);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t l = k; l < SPH_DIM; l++) {
            const uint32_t n = sph_sym[k][l];
            v_store(to + (SPH_NL + n) * row, sph_seen_stress(r, k, l, part[n] * scale));
        }
}

SPH_INLINE void weigh(vreal phi, vreal *t)
{
    SPH_UNROLL_MANY
    for (uint32_t k = 0; k < SPH_NL; k++)
        t[k] = t[k] * phi;
}

#if SPH_HAS_STABILISED
/* the normal stresses along the axes, which look the same in every image */
void sph_load_diagonal(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const bool matched = SPH_HAS_EDGES && r->sim->layer[0];
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        vreal s[SPH_NT];
        stress_at(r, r->first + j, v_load(r->b->rho[0] + r->first + j), s);
        for (uint32_t k = 0; k < SPH_DIM && matched; k++)
            s[k] = s[k] + v_load(r->sim->layer[k * (SPH_DIM + 1)] + r->first + j);
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            v_store(to + k * row + j, s[k]);
    }
}
#endif

void sph_load_stress(const sph_candidates *r, sph_real *to, uint32_t row)
{
    const sph_config *c = &r->sim->cfg;
    const bool weak = sph_weak_scheme(c->scheme), corrects = sph_corrects(c) && sph_is_solid(r->set);
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        const uint32_t i = r->first + j;
        const vreal e = v_load(r->b->rho[0] + i), rho = (1 + e) * r->set->rho0_r;
        vreal s[SPH_NT], full[SPH_NL], t[SPH_NL];
        stress_at(r, i, e, s);
        full_stress(r, i, s, full);
        const vreal w = weak ? v_set(1) : 1 / (rho * rho);
        if (sph_repels(c))
            load_repulsion(r, s, w, to + j, row);
        SPH_UNROLL_MANY
        for (uint32_t k = 0; k < SPH_NL; k++)
            t[k] = -(full[k] * w);
        if (corrects)
            corrected_stress(r, i, rho, full, t);
        if (SPH_HAS_QUADRATURE && r->b->quadrature[0])
            weigh(sph_quadrature_at(r->b, i), t);
        if (!SPH_HAS_IMAGES || !r->im->is_image) {
            SPH_UNROLL_MANY
            for (uint32_t k = 0; k < SPH_NL; k++)
                v_store(to + k * row + j, t[k]);
            continue;
        }
        for (uint32_t k = 0; k < SPH_NL; k++) {
            const uint32_t a = k / SPH_DIM, b = k % SPH_DIM;
            v_store(to + k * row + j, corrects ? sph_seen_mixed(r, a, b, t[k]) : sph_seen_stress(r, a, b, t[k]));
        }
    }
}

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
    for (uint32_t k = 0; k < SPH_NS; k++)
        s[kept_at[k][0]][kept_at[k][1]] = s[kept_at[k][1]][kept_at[k][0]] = b->stress[k][i];
    if (SPH_DIM == 3)
        s[SPH_DIM - 1][SPH_DIM - 1] = -(b->stress[0][i] + b->stress[SPH_NS > 1][i]);
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

void sph_velocity_gradient(const sph_sim *sim, uint32_t i, const sph_real *raw, sph_real rho, bool corrects,
                           sph_real (*l)[SPH_DIM])
{
    const bool weak = sph_weak_scheme(sim->cfg.scheme) || sph_normalises(&sim->cfg); /* by volumes */
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
}

sph_real sph_stress_rates(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real (*l)[SPH_DIM])
{
    const sph_buffer *b = &sim->buf[sim->dst];
    sph_real s[SPH_DIM][SPH_DIM], rate[SPH_DIM][SPH_DIM], trace = 0;
    if (sph_is_solid(set)) {
        const sph_real mu = sph_material_of(sim, set)->shear_r;
        tensor_of(b, i, s);
        jaumann(l, (const sph_real(*)[SPH_DIM])s, mu, rate);
        for (uint32_t k = 0; k < SPH_NS; k++)
            b->dstress[k][i] = rate[kept_at[k][0]][kept_at[k][1]];
    }
    for (uint32_t k = 0; k < SPH_DIM; k++)
        trace += l[k][k];
    return -trace;
}

sph_real sph_stress_surplus(const sph_sim *sim, const sph_set *set, uint32_t i, const sph_real *raw, sph_real rho)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    sph_real l[SPH_DIM][SPH_DIM], s[SPH_DIM][SPH_DIM], power = 0; /* S has no trace: S:e = S:L */
    if (!(sph_material_of(sim, set)->shear_r > 0)) /* then there is no energy of S */
        return 0;
    sph_velocity_gradient(sim, i, raw, rho, sph_corrects(&sim->cfg), l);
    tensor_of(b, i, s);
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t c = 0; c < SPH_DIM; c++)
            power += s[k][c] * l[k][c];
    return power * sph_whole_of(b, i) * (set->inv_rho0_r - 1 / rho) * sph_quadrature_of(b, i);
}
#endif
