/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* density_gradient.c: the renormalised gradient of density (Antuono, Colagrossi, Marrone & Molteni 2010):
     G_i = E_i^-1 sum V_j (rho_j - rho_i) grad W,  E_i = sum V_j (x_j - x_i) (x) grad W
   over bodies of one material, V_j = m_j/rho_j with rho_j not below rho0/2; 0 where E is singular (gradient.c). Not
   over images in a face across which gravity pulls: there the water stands upside down. */
#include "oracle.h"

bool o_diffuses_into(const o_scene *s, const o_particle *i, const o_particle *j)
{
    return o_is_body(s, i) && o_is_body(s, j) && o_same_material(s, i, j) &&
           !(s->cfg.diffusion == SPH_ANTUONO && j->upside_down);
}

static void find_slope(o_scene *s, o_particle *i)
{
    double e[3][3] = {{0}}, d[3] = {0}, inv[3][3], terms = 0, scale = 0;
    for (uint32_t b = 0; b < s->m; b++) {
        const o_particle *j = &s->all[b];
        o_pair p;
        if (!o_diffuses_into(s, i, j) || !o_pair_of(s, i, j, &p))
            continue;
        const o_set *set = &s->set[j->set];
        const double volume = set->mass / o_max(j->rho, 0.95 * set->rho0);
        for (int k = 0; k < SPH_DIM; k++) {
            d[k] += volume * (j->rho - i->rho) * p.g * p.x[k];
            for (int l = 0; l < SPH_DIM; l++)
                e[k][l] -= volume * p.g * p.x[k] * p.x[l];
        }
        terms += volume * p.slope * (p.r + 0.1 * s->cfg.smoothing_length);
        scale += volume * p.slope * (j->rho + i->rho);
    }
    const double size = o_inverse(s, (const double(*)[3])e, terms, inv);
    const bool spans = !o_is_singular((const double(*)[3])e);
    i->steep_scale = spans ? size * scale : 0;
    for (int k = 0; k < SPH_DIM; k++) {
        i->steep[k] = 0;
        for (int l = 0; spans && l < SPH_DIM; l++)
            i->steep[k] += inv[k][l] * d[l];
    }
}

void o_find_slopes(o_scene *s)
{
    if (s->cfg.diffusion != SPH_ANTUONO)
        return;
    for (uint32_t i = 0; i < s->n; i++)
        if (o_is_body(s, &s->own[i]))
            find_slope(s, &s->own[i]);
    o_copies(s);
}
