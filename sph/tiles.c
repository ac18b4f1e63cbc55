/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* tiles.c: the columns that every candidate brings into a tile (scratch.h): place, velocity, mass, density, pressure.
   The pressure comes from the relative density excess by the set's equation of state (Gray 2001 eq 2.25), in the form
   that the scheme sums. Costs no array. Choices are constants in the fast paths and read at run time in the general
   one. */
#include "eos_lanes.h"
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(tiles)

/* particles that are copied without asking how many there are: a row of cells has about SPH_STRIDE, and a loop of fixed
   length saves a branch that would be mispredicted; where a register holds one real, copying too many costs more */
#define COPIED (SPH_SCALAR ? 1u : SPH_STRIDE)
/* of homes, which are those of one cell */
#define COPIED_HOMES (SPH_SCALAR ? 1u : SPH_LANES)

/* what a tile's columns depend on */
typedef struct tile_choice {
    uint32_t eos;
    bool ratio, floor, inv_rho; /* p/rho^2 instead of p; p >= 0; whether 1/rho is asked for */
    bool press, middle;         /* whether pressures are; whether it is the middle of a step */
    bool wall, is_image;        /* velocities of a wall's group; seen through an image */
    bool damped;                /* the damper's pressure */
    bool drifts;                /* positions go with a velocity beside the own, too */
    bool gas;                   /* p = b (1 + d) u */
} tile_choice;

/* In the middle of a step, at whose end the particles stand, they are seen half a step's way back. A pair that is
   within a support there but not at the end may be missed, if it stands more than a cell apart: that is within dt
   |v_ij|/2 of the kernel's edge, where its slope is of second order or higher in that distance. An image goes the
   image's way.

   least: the least rho/rho0 whose inverse is taken. By continuity spray loses density without bound; the volumes of
   such particles, m/rho, would take diffusion beyond what the step is chosen for (factors.c), and densities below 0.

   Whole strides are written: what lies beyond the last is filled with whatever follows in memory, and overwritten by
   the next run or by sph_close_tile. */
SPH_INLINE void load_columns(const sph_candidates *r, sph_tile *t, sph_real least, uint32_t copied, tile_choice c)
{
    const sph_sim *sim = r->sim;
    const vreal m = v_set(r->set->mass_r), r0 = v_set(r->set->rho0_r), b = v_set(r->set->b_r);
    const vreal quantum = v_set((sph_real)sim->grid.quantum), lowest = v_set(least) * r0;
    const uint32_t at = t->n, s = r->first, n = r->n;
    const sph_real *const excess = r->b->rho[0] + s, *const energy = c.gas ? r->b->energy[0] + s : excess;
    const sph_pos *pos[SPH_DIM];
    const sph_real *vel[SPH_DIM];
    vint sign[SPH_DIM], shift[SPH_DIM];
    vreal flip[SPH_DIM], group[SPH_DIM], back[SPH_DIM];
    const sph_real half = (sph_real)(sim->dt * 0.5);
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        pos[k] = r->b->pos[k] + s;
        vel[k] = r->b->vel[k] + s;
        sign[k] = v_set_int(c.is_image ? r->im->sign[k] : 1);
        shift[k] = v_set_int(c.is_image ? r->im->shift[k] - r->origin[k] : r->origin[k]);
        flip[k] = v_set(c.is_image ? r->im->flip[k] : 1);
        back[k] = v_set(c.is_image ? half * (sph_real)r->im->sign[k] : half);
        group[k] = v_set(c.wall ? (sph_real)sph_wall_velocity(sim, r->set, k) : 0);
    }
    for (uint32_t from = 0; from < n; from += copied)
        SPH_UNROLL
        for (uint32_t l = 0; l < copied; l += SPH_W) {
            const uint32_t j = from + l;
            SPH_UNROLL
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                const vint q = v_load_int(pos[k] + j);
                const vreal v = c.wall ? group[k] : v_load(vel[k] + j);
                const vreal x = v_from_int(c.is_image ? q * sign[k] + shift[k] : q - shift[k]) * quantum;
                const vreal way = c.drifts ? v + v_load(sph_drift(sim, r->b, k) + s + j) : v;
                v_store(t->x[k] + at + j, c.middle ? x - back[k] * way : x);
                v_store(t->v[k] + at + j, c.is_image ? v * flip[k] : v);
            }
            const vreal e = v_load(excess + j);
            const vreal rho = (1 + e) * r0, law = c.press ? sph_pressure_of(c.eos, c.floor, b, e) : v_set(0);
            vreal p = c.gas ? b * ((1 + e) * v_load(energy + j)) : law;
            if (SPH_WITH_DAMPER && c.damped)
                p = p + v_load(sim->damper_press + s + j);
            if (SPH_WITH_DAMPER && c.damped && c.floor)
                p = v_max(p, v_set(0));
            v_store(t->m + at + j, m);
            v_store(t->rho + at + j, rho);
            v_store(t->press + at + j, c.ratio && c.press ? p / (rho * rho) : p);
            if (c.inv_rho)
                v_store(t->inv_rho + at + j, 1 / (SPH_HAS_BOUNDED ? v_max(rho, lowest) : rho));
        }
}

/* standard rates ask for no pressure; that of energy does, and normalised kernels do, for the densities of walls */
static bool needs_press(const sph_sim *sim)
{
    return sph_sums_forces(sim) || !SPH_IS(sim->cfg.scheme, STANDARD) || sph_has_energy(&sim->cfg) ||
           sph_normalises(&sim->cfg);
}

/* whether what is seen half a step back went with XSPH's velocity too (motion.h) */
SPH_INLINE bool drifts_beside(const sph_candidates *r, bool wall)
{
    return sph_in_middle(r->sim) && !wall && sph_drift(r->sim, r->b, 0) != NULL;
}

/* matter has the damper's pressure in sums of forces */
SPH_INLINE bool damped_here(const sph_candidates *r, bool wall)
{
    return sph_quiets(&r->sim->cfg) && sph_sums_forces(r->sim) && !wall;
}

SPH_APART void load_any(const sph_candidates *r, sph_tile *t, sph_real least, bool inv_rho)
{
    const sph_config *c = &r->sim->cfg;
    const bool floor = c->pressure_floor && !sph_is_solid(r->set), wall = r->set->role == SPH_ROLE_GHOST;
    const tile_choice own = {r->set->eos,
                             !sph_weak_scheme(c->scheme),
                             floor,
                             inv_rho,
                             needs_press(r->sim),
                             sph_in_middle(r->sim),
                             SPH_HAS_LAYERED_WALLS && wall,
                             SPH_HAS_IMAGES && r->im->is_image,
                             damped_here(r, wall),
                             drifts_beside(r, wall),
                             sph_is_gas(r->set)};
    load_columns(r, t, least, COPIED, own);
}

/* Tait's water in a standard scheme, solids with the linear equation of state, or rates in a standard scheme, in the
   middle of a step; no image: the same text with the choices as constants; a line adds a path */
#define SPH_FAST_LOADS(X)                                                                                          \
    X(plain, TAIT, false, false, true, false, false)                                                               \
    X(plain_homes, TAIT, false, false, true, false, true)                                                          \
    X(floor, TAIT, true, false, true, false, false)                                                                \
    X(floor_homes, TAIT, true, false, true, false, true)                                                           \
    X(diffusive, TAIT, true, true, true, false, false)                                                             \
    X(diffusive_homes, TAIT, true, true, true, false, true)                                                        \
    X(wall, TAIT, false, false, true, true, false)                                                                 \
    X(wall_homes, TAIT, false, false, true, true, true)                                                            \
    X(wall_floor, TAIT, true, false, true, true, false)                                                            \
    X(wall_floor_homes, TAIT, true, false, true, true, true)                                                       \
    X(wall_diffusive, TAIT, true, true, true, true, false)                                                         \
    X(linear, LINEAR, false, false, true, false, false)                                                            \
    X(linear_homes, LINEAR, false, false, true, false, true)                                                       \
    X(linear_volume, LINEAR, false, true, true, false, false)                                                      \
    X(linear_volume_homes, LINEAR, false, true, true, false, true)                                                 \
    X(rates, TAIT, false, false, false, false, false)                                                              \
    X(rates_homes, TAIT, false, false, false, false, true)                                                         \
    X(rates_diffusive, TAIT, false, true, false, false, false)                                                     \
    X(rates_diffusive_homes, TAIT, false, true, false, false, true)                                                \
    X(rates_wall, TAIT, false, false, false, true, false)                                                          \
    X(rates_wall_diffusive, TAIT, false, true, false, true, false)
#define SPH_FAST_FN(name, eos_, floor_, inv_rho_, press_, wall_, homes_)                                           \
    SPH_APART void load_##name(const sph_candidates *r, sph_tile *t, sph_real least)                               \
    {                                                                                                              \
        const tile_choice own = {SPH_##eos_, true,  floor_, inv_rho_, press_, !(press_),                           \
                                 wall_,      false, false,  false,    false};                                      \
        load_columns(r, t, least, (homes_) ? COPIED_HOMES : COPIED, own);                                          \
    }
SPH_FAST_LOADS(SPH_FAST_FN)
#undef SPH_FAST_FN

/* what tells the fast loads from each other, as one number */
#define LOAD_KEY(eos, floor, inv_rho, press, wall, homes)                                                          \
    ((uint32_t)(eos) << 5 | (uint32_t)(floor) << 4 | (uint32_t)(inv_rho) << 3 | (uint32_t)(press) << 2 |           \
     (uint32_t)(wall) << 1 | (uint32_t)(homes))
#define NO_KEY 0xffffffffu

void sph_load_tile(const sph_candidates *r, sph_tile *t, uint32_t asked, bool homes)
{
    const bool inv_rho = asked != 0;
    const bool bounded = SPH_HAS_BOUNDED && asked == SPH_BOUNDED && !homes;
    const sph_real least = bounded ? (sph_real)SPH_LEAST_DENSITY : (sph_real)-1e30; /* all of them */
    const sph_config *c = &r->sim->cfg;
    const bool wall = SPH_HAS_LAYERED_WALLS && r->set->role == SPH_ROLE_GHOST, press = needs_press(r->sim);
    const bool floor = press && c->pressure_floor && !sph_is_solid(r->set);
    /* of rates the equation of state does not matter */
    const uint32_t eos = press ? r->set->eos : SPH_TAIT;
    const bool usual = SPH_WITH_FAST_PATHS && (SPH_IS(c->scheme, STANDARD) || !press) && !r->im->is_image &&
                       !drifts_beside(r, wall) && !damped_here(r, wall) && !sph_has_energy(c) &&
                       (!sph_normalises(c) || sph_sums_forces(r->sim));
    const uint32_t key = LOAD_KEY(eos, floor, inv_rho, press, wall, homes);
    switch (usual ? key : NO_KEY) {
#define SPH_FAST_CASE(name, eos_, floor_, inv_rho_, press_, wall_, homes_)                                         \
    case LOAD_KEY(SPH_##eos_, floor_, inv_rho_, press_, wall_, homes_):                                            \
        load_##name(r, t, least);                                                                                  \
        return;
        SPH_FAST_LOADS(SPH_FAST_CASE)
#undef SPH_FAST_CASE
    default: load_any(r, t, least, inv_rho);
    }
}

void sph_load_points(const sph_candidates *r, sph_points *t)
{
    for (uint32_t k = 0; k < SPH_DIM; k++)
        for (uint32_t j = 0; j < r->n; j += SPH_W)
            v_store(t->x[k] + t->n + j, sph_seen_place(r, k, v_load_int(r->b->pos[k] + r->first + j)));
    uint32_t turned = 0;
    for (uint32_t k = 0; SPH_HAS_MIRRORS && k < SPH_DIM; k++)
        turned |= (r->im->sign[k] < 0 ? 1u << k : 0) | (r->im->flip[k] < 0 ? 8u << k : 0);
    memset(t->set + t->n, (int)(r->set - r->sim->set), r->n);
    memset(t->turned + t->n, (int)turned, r->n);
}

void sph_close_tile(const sph_sim *sim, sph_tile *t)
{
    const vreal far = v_set((sph_real)(64 * sim->grid.support)), none = v_set(0), one = v_set(1);
    for (uint32_t j = t->n; j < t->n + SPH_LANES; j += SPH_W) {
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            v_store(t->x[k] + j, far);
            v_store(t->v[k] + j, none);
        }
        v_store(t->m + j, none);
        v_store(t->press + j, none);
        v_store(t->rho + j, one);
        v_store(t->inv_rho + j, one);
    }
}
