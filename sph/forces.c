/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* forces.c: the loop over pairs that makes accelerations and rates: geometry, kernel, then one plain call a term.
   Each term is in its own header, with its equations:

     continuity.h   rate of density             viscosity.h    artificial, Morris            diffusion.h    of density
     pressure.h     force of the pressure       stress.h       force of the stress, and the velocity gradient
     density_gradient.h  what diffusion after Antuono takes off
     gradient.h     corrected gradients         reference.h    reference positions, contact of bodies
     shear.h        viscous stress              xsph.h         drift beside the velocity   pair_power.h   the books
     shift_sums.h   disorder                    energy.h       heat, sound of each particle
     stabilised.h, normalised.h, hourglass.h    forms of solids

   Kick-drift-kick and leap-frog sum rates and forces in sweeps of their own (choice `part`): with the same bits as both
   at once, of which each would use a half.

   The same text is compiled with the choices as constants (a line of SPH_FAST_FORCES each) and with choices read at
   run time (two general forms: without solids and with them). What becomes of the sums is in finish.c. Cost: one sweep
   a force evaluation. */
#include "boundary.h"
#include "continuity.h"
#include "density_gradient.h"
#include "diffusion.h"
#include "energy.h"
#include "factors.h"
#include "finish.h"
#include "gradient.h"
#include "hourglass.h"
#include "normalised.h"
#include "pair_power.h"
#include "pressure.h"
#include "reference.h"
#include "shear.h"
#include "shift_sums.h"
#include "stabilised.h"
#include "stress.h"
#include "varying.h"
#include "viscosity.h"
#include "xsph.h"
#include "arithmetic.h"

SPH_OBJECT(forces)

/* ---- the loop ---- */

/* a home with all that the terms want to know of it and of the candidates; what is not chosen is not read */
typedef struct at_home {
    const sph_choice *c;
    const sph_factors *f;
    const sph_near_tile *tile;
    const sph_mirror_tile *mirror;
    const sph_stress_tile *stress;
    const sph_reference_tile *reference;
    const sph_real *smoothed, *corrected, *sheared, *sounds, *widths, *steepness;
    vreal wide;
    const sph_home *home;
    const sph_gradient_home *gradient;
    const vreal *slope; /* G of density_gradient.c */
    const sph_shear_home *shear;
    const sph_energy_home *energy;
    const sph_stress_home *solid;
    const sph_reference_home *was;
    const sph_stabilised_home *means;
    sph_stabilised_near stabilised;
    const sph_normalised_home *normal;
    const sph_deform_home *deform;
    const sph_deform_tile *deformed;
} at_home;

/* how vectors out of reach are left out (pair.h); a list does not know of reference positions */
SPH_INLINE bool skips(const sph_choice *c) { return SPH_SKIPS && c->part == SPH_PART_BOTH; }
SPH_INLINE bool lists(const sph_choice *c) { return SPH_LISTS && !skips(c) && !c->total; }

/* x_ij, K and |K|; returns false where the pairs may be skipped: all terms are 0 there */
SPH_INLINE bool geometry(const at_home *o, sph_near *p)
{
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        p->kx[k] = p->ex[k] = p->dx[k] = o->home->x[k] - v_load(o->tile->x[k] + p->j);
    p->r2 = sph_dot(p->dx, p->dx);
    vreal k2 = p->r2;
    if (SPH_HAS_TOTAL && o->c->solid && o->c->total && !p->wall) {
        vint same;
        vreal to[SPH_DIM];
        sph_reference_distance(o->was, o->reference, p->j, p->dx, to, &same, &p->apart);
        k2 = sph_dot(to, to);
        SPH_UNROLL
        for (int k = 0; k < SPH_DIM; k++)
            p->kx[k] = v_where(~p->apart, to[k]);
    }
    if (!sph_within(k2, o->f->reach2, skips(o->c)))
        return false;
    p->q = v_sqrt(k2) * o->f->inv_h;
    sph_pair_width(o->c, o->wide, o->widths, p);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        p->dv[k] = p->dw[k] = o->home->v[k] - v_load(o->tile->v[k] + p->j);
    p->vr = p->vc = p->ve = sph_dot(p->dv, p->dx);
    sph_corrected_distance(o->c, o->gradient, o->corrected, p);
    return true;
}

/* what the kernel and the candidates' own columns give to every term */
SPH_INLINE void kernel(const at_home *o, sph_near *p)
{
    p->mg = sph_narrowed(o->c, p, k_slope(o->c->kernel, p->q)) * v_load(o->tile->m + p->j);
    p->rho = v_load(o->tile->rho + p->j);
    p->press = v_load(o->tile->press + p->j);
    p->inv_rho = sph_needs_inv_rho(o->c) ? v_load(o->tile->inv_rho + p->j) : p->rho;
}

/* what pressure, contact and viscosity push, and Morris's drag */
SPH_INLINE void momentum(const sph_choice *c, const sph_near *p, vreal *s)
{
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        s[SUM_ACC + k] = s[SUM_ACC + k] + p->force * p->ex[k];
        if (SPH_IS(c->viscosity, MORRIS))
            s[SUM_ACC + k] = s[SUM_ACC + k] - p->fm * p->dw[k];
    }
}

/* what a pair of bodies has beside in the stabilised form */
SPH_INLINE void stabilise(const at_home *o, sph_near *p, vreal *s)
{
    if (!sph_stabilised(o->c) || p->wall || !sph_takes_forces(o->c))
        return;
    const vreal w = sph_weak_scheme(o->c->scheme) ? p->inv_rho * o->home->inv_rho : v_set(1);
    sph_stabilised_push(o->c, o->f, o->solid, o->stress, o->means, &o->stabilised, p, w, s);
}

/* one group of lanes: everything that candidates j ... give to the home; wall: they are ghosts */
SPH_INLINE void pair(const at_home *o, bool wall, uint32_t j, vreal *s)
{
    const sph_choice *const c = o->c;
    sph_near p;
    p.wall = wall;
    p.tile = o->tile;
    p.j = j;
    p.force = v_set(0);
    p.apart = v_set_int(0);
    p.gain = v_set(0);
    p.wide = p.narrow = v_set(1);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        p.push[k] = v_set(0);

    if (!geometry(o, &p))
        return;
    kernel(o, &p);
    if (sph_takes_rates(c))
        sph_continuity(c, o->f, o->home, &p, s);
    if (sph_normalised(c))
        sph_normalised_vector(c, o->f, o->normal, &p);
    sph_stress_force(c, o->f, o->home, o->solid, o->stress, o->smoothed, &p, s);
    stabilise(o, &p, s);
    if (sph_takes_forces(c)) {
        sph_pressure_force(c, o->f, o->home, &p);
        sph_corrected_pressure(c, o->home, o->gradient, o->corrected, &p, s);
        sph_contact(c, o->f, o->home, &p, s);
        sph_hourglass(c, o->home, o->was, o->reference, o->deform, o->deformed, &p, s);
    }
    sph_inverse_distance(c, o->f, o->home, &p);
    sph_viscosity(c, o->f, o->home, o->mirror, sph_pair_sound(c, o->energy, o->sounds, &p), &p, s);
    if (sph_takes_forces(c))
        momentum(c, &p, s);
    sph_shear_force(c, o->home, o->mirror, o->shear, o->sheared, &p, s);
    sph_diffusion(c, o->f, o->home, o->slope, o->steepness, &p, s);
    sph_heat(c, o->energy, &p, s);
    sph_xsph(c, o->home, &p, s);
    sph_pair_power(c, o->home, &p, s);
    sph_shift_sums(c, o->f, &p, s);
}

SPH_INLINE void pair_matter(const void *what, uint32_t j, vreal *s) { pair(what, false, j, s); }
SPH_INLINE void pair_ghosts(const void *what, uint32_t j, vreal *s) { pair(what, true, j, s); }
SPH_INLINE void pair_either(const void *what, uint32_t j, vreal *s)
{
    const at_home *const o = what;
    pair(o, SPH_HAS_LAYERED_WALLS && o->c->wall, j, s);
}

SPH_INLINE uint32_t book_sums(const sph_choice *c, bool wall)
{
    return SUM_MASK(VISCOUS) | SUM_MASK(DIFFUSED) | (wall ? SUM_MASK(WALL) | SUM_MASK(IN_WALLS) : 0) |
           (c->total || c->repulsion ? SUM_MASK(IN_BONDS) : 0) | (c->loses ? SUM_MASK(UNBALANCED) : 0);
}
/* the sums that these choices take */
SPH_INLINE uint32_t sums_of(const sph_choice *c, bool wall)
{
    const uint32_t gradient = SPH_WITH_SOLID && c->solid ? SPH_SUM_MASK(SUM_GRADIENT, SPH_NL) : 0;
    const uint32_t heat = SPH_WITH_ENERGY && c->energy ? SUM_MASK(HEAT) : 0;
    const uint32_t rates = SUM_MASK(DRHO) | gradient | heat;
    const uint32_t shifts = SPH_SHIFT_ROWS - (c->shifting > 1 ? 0u : SPH_DIM); /* without NEARER */
    const uint32_t forces = SUM_MASK(MU) | SUM_MASK(ACC) | (SPH_WITH_XSPH && c->xsph ? SUM_MASK(XSPH) : 0) |
                            (SPH_WITH_SHIFTING && c->shifting ? SPH_SUM_MASK(SUM_SHIFT, shifts) : 0) |
                            (SPH_WITH_BOOKS && c->books ? book_sums(c, wall) | gradient : 0) |
                            (c->edge ? gradient : 0);
    return (sph_takes_rates(c) ? rates : 0) | (sph_takes_forces(c) ? forces : 0);
}

/* what a form of solids, or diffusion after Antuono, wants to know of a home */
typedef struct form_home {
    vreal slope[SPH_DIM];
    sph_stabilised_home means;
    sph_normalised_home normal;
    sph_deform_home deform;
} form_home;
SPH_INLINE void spread_form(at_home *o, form_home *form, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    SPH_UNROLL
    for (uint32_t k = 0; k < SPH_DIM; k++)
        form->slope[k] = v_set(0);
    o->slope = form->slope;
    if (SPH_IS(o->c->diffusion, ANTUONO) && !o->c->wall)
        o->steepness = sph_spread_density_gradient(sim, t, h, form->slope);
    if (SPH_HAS_STABILISED) /* places, whether the scene has them or not */
        o->stabilised = sph_stabilised_of(sim, t);
    if (SPH_HAS_HOURGLASS)
        o->deformed = (const void *)sph_near_columns_of(sim, t, SPH_COLUMN_deform);
    if (sph_stabilised(o->c) && sph_takes_forces(o->c)) {
        form->means = sph_spread_stabilised(sim, t, h);
        o->means = &form->means;
    }
    if (sph_normalised(o->c)) {
        form->normal = sph_spread_normalised(sim, t, h);
        o->normal = &form->normal;
    }
    if (SPH_HAS_HOURGLASS && o->c->hourglass) {
        form->deform = sph_spread_deform(sim, t, h);
        o->deform = &form->deform;
    }
}

SPH_INLINE void force_home(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h,
                           bool wall)
{
    const sph_home home = sph_spread_home(&t->home, h);
    const sph_tile *const tile = wall ? &t->ghosts : &t->matter;
    at_home o = {.c = c, .f = f, .tile = sph_near_of(t, tile), .home = &home};
    if (SPH_HAS_LAYERED_WALLS && wall)
        o.mirror = sph_mirror_of(sim, t);
    sph_gradient_home gradient = {{v_set(0)}, {v_set(0)}, v_set(0)};
    o.gradient = &gradient;
    if (SPH_HAS_FLUID_GRADIENT && c->gradient) {
        o.corrected = sph_near_columns_of(sim, t, SPH_COLUMN_gradient);
        gradient = sph_spread_gradient(c, sim, t, h);
    }
    sph_shear_home shear;
    if (SPH_WITH_SHEAR && c->shear) {
        o.sheared = sph_near_columns_of(sim, t, SPH_COLUMN_shear);
        shear = sph_spread_shear(sim, t, h);
        o.shear = &shear;
    }
    sph_energy_home energy;
    if (SPH_WITH_ENERGY && c->energy) {
        o.sounds = sph_near_columns_of(sim, t, SPH_COLUMN_energy);
        energy = sph_spread_energy(sim, t, h);
        o.energy = &energy;
    }
    if (sph_varies(c)) {
        o.widths = sph_near_columns_of(sim, t, SPH_COLUMN_wide);
        o.wide = v_set(sph_home_wide(sim, t, h));
    }
    sph_stress_home solid;
    if (SPH_WITH_SOLID) /* a place, whether the scene has it or not */
        o.stress = sph_stress_tile_of(sim, t);
    if (SPH_WITH_SOLID && c->solid) {
        o.smoothed = c->hat ? sph_smoothed_of(sim, t) : NULL;
        solid = sph_spread_stress(c, sph_stress_homes_of(sim, t), c->hat ? sph_smoothed_homes_of(sim, t) : NULL, h);
        o.solid = &solid;
    }
    sph_reference_home was;
    if (SPH_HAS_TOTAL)
        o.reference = sph_reference_of(sim, t);
    if (SPH_HAS_TOTAL && c->solid && c->total) {
        was = sph_spread_reference(sph_reference_homes_of(sim, t), h);
        o.was = &was;
    }
    form_home form;
    spread_form(&o, &form, sim, t, h);
    const uint32_t sums = sums_of(c, wall);
    if (SPH_SMALL)
        sph_sum_home(sim, t, tile, h, sums, pair_either, &o);
    else if (lists(c) && wall)
        sph_sum_listed(sim, t, tile, h, sums, pair_ghosts, &o);
    else if (lists(c))
        sph_sum_listed(sim, t, tile, h, sums, pair_matter, &o);
    else if (wall)
        sph_sum_home(sim, t, tile, h, sums, pair_ghosts, &o);
    else
        sph_sum_home(sim, t, tile, h, sums, pair_matter, &o);
}

/* ---- general forms: every choice read at run time ---- */

/* in small builds one text for matter and ghosts, else one each */
SPH_INLINE void force_general(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    const bool wall = SPH_HAS_LAYERED_WALLS && c->wall;
    if (SPH_SMALL)
        force_home(c, f, sim, t, h, wall);
    else if (wall)
        force_home(c, f, sim, t, h, true);
    else
        force_home(c, f, sim, t, h, false);
}
/* whatever does not conserve energy, where that is on the books: in small builds with the others */
SPH_APART void force_losing(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_choice own = *c;
    own.loses = own.books = 1;
    own.solid = SPH_WITH_SOLID && own.solid;
    own.varies = 0;
    force_general(&own, f, sim, t, h);
}
/* the form that covers fluids (in small builds with corrected gradients); corrected gradients; scenes with solids */
SPH_APART void force_fluid(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_choice own = *c;
    own.solid = own.total = own.hat = own.repulsion = own.form = own.hourglass = 0;
    own.loses = SPH_SMALL && own.loses;
    own.gradient = SPH_SMALL ? own.gradient : 0;
    own.energy = SPH_SMALL && own.energy;
    own.varies = SPH_SMALL && own.varies;
    force_general(&own, f, sim, t, h);
}
/* whose energies go by their equation */
SPH_APART void force_energy(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_choice own = *c;
    own.solid = own.total = own.hat = own.repulsion = own.loses = own.form = own.hourglass = own.varies = 0;
    own.energy = 1;
    force_general(&own, f, sim, t, h);
}
/* and whose smoothing lengths go by their density */
SPH_APART void force_varying(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_choice own = *c;
    own.solid = own.total = own.hat = own.repulsion = own.form = own.hourglass = 0;
    own.gradient = own.diffusion = own.xsph = own.shear = own.shifting = own.summed = own.edge = 0;
    own.energy = own.varies = 1;
    force_general(&own, f, sim, t, h);
}
SPH_APART void force_corrected(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_choice own = *c;
    own.solid = own.total = own.hat = own.repulsion = own.loses = own.energy = own.form = own.hourglass = 0;
    own.varies = 0;
    force_general(&own, f, sim, t, h);
}
SPH_APART void force_solid(const sph_choice *c, const sph_factors *f, const sph_sim *sim, sph_thread *t, uint32_t h)
{
    sph_choice own = *c;
    own.solid = true;
    own.gradient = own.shear = own.shifting = own.energy = own.varies = 0; /* of fluids alone */
    own.loses = SPH_SMALL && own.loses;
    own.total = SPH_HAS_TOTAL && own.total;
    own.hat = SPH_HAS_HAT && own.hat;
    own.repulsion = SPH_HAS_REPULSION ? own.repulsion : 0;
    force_general(&own, f, sim, t, h);
}

/* ---- fast paths: the same text with the choices as constants; a line adds a path ---- */

/* name, and the choices that are not 0 (standard scheme, no diffusion, no beta, no XSPH ...) */
#define SPH_FAST_FORCES(X)                                                                                         \
    X(w2, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL)                                                  \
    X(w2_w, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = 1)                                     \
    X(w2_h, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC)                  \
    X(w2_hw, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .wall = 1)      \
    X(w2_hb, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1)     \
    X(w2_hbw, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1,    \
      .wall = 1)                                                                                                   \
    X(cubic, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL)
#define SPH_FAST_CORRECTED(X)                                                                                      \
    X(c, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK)                        \
    X(c_w, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK, .wall = 1)           \
    X(c_hb, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                     \
      .diffusion = SPH_HYDROSTATIC, .books = 1)                                                                    \
    X(c_hbw, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                    \
      .diffusion = SPH_HYDROSTATIC, .books = 1, .wall = 1)
#define SPH_FAST_SHEAR(X)                                                                                          \
    X(e, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .shear = 1)                                       \
    X(e_w, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .shear = 1, .wall = 1)
#define SPH_FAST_SOLIDS(X)                                                                                         \
    X(s_cubic, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .solid = 1)                                       \
    X(s_cubic_r, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .solid = 1, .repulsion = 4)                     \
    X(s_w2, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .solid = 1)                                    \
    X(s_w2_r, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .solid = 1, .repulsion = 4)                  \
    X(s_w2_t, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .solid = 1, .total = 1)

/* forces, and with them the sums of shifting; the books want diffusion */
#define SPH_FAST_SHIFTING(X)                                                                                       \
    X(f_w2_s, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .shifting = 1, .part = SPH_PART_FORCES)      \
    X(f_w2_ws, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = 1, .shifting = 1,                   \
      .part = SPH_PART_FORCES)                                                                                     \
    X(f_w2_hbs, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1,  \
      .shifting = 1, .part = SPH_PART_FORCES)                                                                      \
    X(f_w2_hbws, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1, \
      .wall = 1, .shifting = 1, .part = SPH_PART_FORCES)

/* rates and forces apart: kick-drift-kick and leap-frog */
#define SPH_FAST_PARTS(X)                                                                                          \
    X(r_w2, .kernel = SPH_WENDLAND_C2, .part = SPH_PART_RATES)                                                     \
    X(r_w2_w, .kernel = SPH_WENDLAND_C2, .wall = 1, .part = SPH_PART_RATES)                                        \
    X(r_w2_h, .kernel = SPH_WENDLAND_C2, .diffusion = SPH_HYDROSTATIC, .part = SPH_PART_RATES)                     \
    X(r_w2_hw, .kernel = SPH_WENDLAND_C2, .diffusion = SPH_HYDROSTATIC, .wall = 1, .part = SPH_PART_RATES)         \
    X(r_w2_d, .kernel = SPH_WENDLAND_C2, .diffusion = SPH_ANTUONO, .part = SPH_PART_RATES)                         \
    X(f_w2_db, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_ANTUONO, .books = 1,       \
      .part = SPH_PART_FORCES)                                                                                     \
    X(r_cubic, .kernel = SPH_CUBIC, .part = SPH_PART_RATES)                                                        \
    X(f_w2, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .part = SPH_PART_FORCES)                       \
    X(f_w2_w, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .wall = 1, .part = SPH_PART_FORCES)          \
    X(f_w2_hb, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1,   \
      .part = SPH_PART_FORCES)                                                                                     \
    X(f_w2_hbw, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1,  \
      .wall = 1, .part = SPH_PART_FORCES)                                                                          \
    X(f_cubic, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .part = SPH_PART_FORCES)
#define SPH_FAST_CORRECTED_PARTS(X)                                                                                \
    X(r_c, .kernel = SPH_WENDLAND_C2, .gradient = SPH_BONET_LOK, .part = SPH_PART_RATES)                           \
    X(r_c_w, .kernel = SPH_WENDLAND_C2, .gradient = SPH_BONET_LOK, .wall = 1, .part = SPH_PART_RATES)              \
    X(r_c_h, .kernel = SPH_WENDLAND_C2, .gradient = SPH_BONET_LOK, .diffusion = SPH_HYDROSTATIC,                   \
      .part = SPH_PART_RATES)                                                                                      \
    X(r_c_d, .kernel = SPH_WENDLAND_C2, .gradient = SPH_BONET_LOK, .diffusion = SPH_ANTUONO,                       \
      .part = SPH_PART_RATES)                                                                                      \
    X(f_c_db, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                   \
      .diffusion = SPH_ANTUONO, .books = 1, .part = SPH_PART_FORCES)                                               \
    X(r_c_hw, .kernel = SPH_WENDLAND_C2, .gradient = SPH_BONET_LOK, .diffusion = SPH_HYDROSTATIC, .wall = 1,       \
      .part = SPH_PART_RATES)                                                                                      \
    X(f_c, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                      \
      .part = SPH_PART_FORCES)                                                                                     \
    X(f_c_w, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK, .wall = 1,         \
      .part = SPH_PART_FORCES)                                                                                     \
    X(f_c_hb, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                   \
      .diffusion = SPH_HYDROSTATIC, .books = 1, .part = SPH_PART_FORCES)                                           \
    X(f_c_hbg, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                  \
      .diffusion = SPH_HYDROSTATIC, .books = 1, .loses = 1, .part = SPH_PART_FORCES)                               \
    X(f_c_hbwg, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                 \
      .diffusion = SPH_HYDROSTATIC, .books = 1, .loses = 1, .wall = 1, .part = SPH_PART_FORCES)                    \
    X(f_c_hbw, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                  \
      .diffusion = SPH_HYDROSTATIC, .books = 1, .wall = 1, .part = SPH_PART_FORCES)
#define SPH_FAST_SHEAR_PARTS(X)                                                                                    \
    X(f_e_hb, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1,    \
      .shear = 1, .part = SPH_PART_FORCES)                                                                         \
    X(f_e_hbw, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .diffusion = SPH_HYDROSTATIC, .books = 1,   \
      .shear = 1, .wall = 1, .part = SPH_PART_FORCES)
#define SPH_FAST_SHEAR_CORRECTED(X)                                                                                \
    X(f_ce_hb, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                  \
      .diffusion = SPH_HYDROSTATIC, .books = 1, .shear = 1, .part = SPH_PART_FORCES)                               \
    X(f_ce_hbw, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .gradient = SPH_BONET_LOK,                 \
      .diffusion = SPH_HYDROSTATIC, .books = 1, .shear = 1, .wall = 1, .part = SPH_PART_FORCES)
#define SPH_FAST_SOLID_PARTS(X)                                                                                    \
    X(r_s_cubic, .kernel = SPH_CUBIC, .solid = 1, .part = SPH_PART_RATES)                                          \
    X(r_s_w2, .kernel = SPH_WENDLAND_C2, .solid = 1, .part = SPH_PART_RATES)                                       \
    X(r_s_w2_t, .kernel = SPH_WENDLAND_C2, .solid = 1, .total = 1, .part = SPH_PART_RATES)                         \
    X(f_s_cubic, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .solid = 1, .part = SPH_PART_FORCES)            \
    X(f_s_cubic_r, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .solid = 1, .repulsion = 4,                   \
      .part = SPH_PART_FORCES)                                                                                     \
    X(f_s_w2, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .solid = 1, .part = SPH_PART_FORCES)         \
    X(f_s_w2_r, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .solid = 1, .repulsion = 4,                \
      .part = SPH_PART_FORCES)                                                                                     \
    X(f_s_w2_t, .kernel = SPH_WENDLAND_C2, .viscosity = SPH_ARTIFICIAL, .solid = 1, .total = 1,                    \
      .part = SPH_PART_FORCES)

#define SPH_FAST_STABILISED(X)                                                                                     \
    X(f_s_cubic_b, .kernel = SPH_CUBIC, .viscosity = SPH_ARTIFICIAL, .solid = 1, .form = SPH_STABILISED,           \
      .part = SPH_PART_FORCES)

#define SPH_FAST_FN(name, ...)                                                                                     \
    SPH_APART uint32_t force_##name(const sph_sim *sim, sph_thread *t, uint32_t homes)                             \
    {                                                                                                              \
        static const sph_choice c = {__VA_ARGS__};                                                                 \
        const sph_factors own = sim->fac;                                                                          \
        uint32_t done = 0;                                                                                         \
        for (uint32_t h = 0; h < homes; h++)                                                                       \
            if (sph_is_matter(&sim->set[t->home_set[h]]) || !(c.wall || sph_diffusive(c.diffusion))) {             \
                force_home(&c, &own, sim, t, h, c.wall);                                                           \
                done++;                                                                                            \
            }                                                                                                      \
        return done;                                                                                               \
    }
#define SPH_FAST_ROW(name, ...) {{__VA_ARGS__}, force_##name},
typedef uint32_t fast_path(const sph_sim *sim, sph_thread *t, uint32_t homes); /* returns how many homes it took */
#if SPH_WITH_FAST_PATHS
SPH_FAST_FORCES(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHIFTING
SPH_FAST_SHIFTING(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_BONET_LOK
SPH_FAST_CORRECTED(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHEAR
SPH_FAST_SHEAR(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHEAR && SPH_HAS_RATES_FIRST
SPH_FAST_SHEAR_PARTS(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHEAR && SPH_HAS_RATES_FIRST && SPH_WITH_BONET_LOK
SPH_FAST_SHEAR_CORRECTED(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SOLID
SPH_FAST_SOLIDS(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST
SPH_FAST_PARTS(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST && SPH_WITH_BONET_LOK
SPH_FAST_CORRECTED_PARTS(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST && SPH_WITH_SOLID
SPH_FAST_SOLID_PARTS(SPH_FAST_FN)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST && SPH_HAS_STABILISED
SPH_FAST_STABILISED(SPH_FAST_FN)
#endif
static const struct {
    sph_choice c;
    fast_path *run;
} fast_paths[] = {
#if SPH_WITH_FAST_PATHS && SPH_WITH_SOLID
    SPH_FAST_SOLIDS(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS
    SPH_FAST_FORCES(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHIFTING
    SPH_FAST_SHIFTING(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_BONET_LOK
    SPH_FAST_CORRECTED(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST
    SPH_FAST_PARTS(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST && SPH_WITH_BONET_LOK
    SPH_FAST_CORRECTED_PARTS(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST && SPH_WITH_SOLID
    SPH_FAST_SOLID_PARTS(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHEAR
    SPH_FAST_SHEAR(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHEAR && SPH_HAS_RATES_FIRST
    SPH_FAST_SHEAR_PARTS(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_WITH_SHEAR && SPH_HAS_RATES_FIRST && SPH_WITH_BONET_LOK
    SPH_FAST_SHEAR_CORRECTED(SPH_FAST_ROW)
#endif
#if SPH_WITH_FAST_PATHS && SPH_HAS_RATES_FIRST && SPH_HAS_STABILISED
    SPH_FAST_STABILISED(SPH_FAST_ROW)
#endif
    {{0}, NULL}};

#undef SPH_FAST_FN
#undef SPH_FAST_ROW

static bool same_choice(const sph_choice *a, const sph_choice *b)
{
    uint64_t x[3], y[3];
    memcpy(x, a, sizeof x);
    memcpy(y, b, sizeof y);
    return x[0] == y[0] && x[1] == y[1] && x[2] == y[2];
}

/* 1 + the number of the fast path of these choices, or 0 */
static uint8_t fast_path_of(const sph_choice *c)
{
    uint32_t k = 0;
    while (fast_paths[k].run && !same_choice(&fast_paths[k].c, c))
        k++;
    return (uint8_t)(fast_paths[k].run ? k + 1 : 0);
}

static uint32_t form_of(const sph_config *c, bool forces)
{
    return sph_normalises(c) ? SPH_NORMALISED : forces && sph_stabilises(c) ? SPH_STABILISED : 0;
}

/* The choices of a scene, of matter or of ghosts. Rates ask for no viscosity and keep no books; forces for nothing that
   makes rates, but for what is on the books. */
static sph_choice choice_of(const sph_sim *sim, bool wall)
{
    const sph_config *c = &sim->cfg;
    const bool rates = sph_sums_rates(sim), forces = sph_sums_forces(sim), books = forces && sph_keeps_books(c);
    const bool hat = sph_smooths_strain(c), repels = forces && sph_repels(c), xsph = sph_uses_xsph(c) && !hat;
    const bool viscous = forces || sph_has_energy(c); /* what it takes becomes heat */
    const uint32_t part = rates && forces ? SPH_PART_BOTH : rates ? SPH_PART_RATES : SPH_PART_FORCES;
    return (sph_choice){.kernel = (uint8_t)c->kernel,
                        .scheme = (uint8_t)c->scheme,
                        .viscosity = (uint8_t)(viscous ? c->viscosity : SPH_INVISCID),
                        .diffusion = (uint8_t)(rates || books ? c->diffusion : SPH_NO_DIFFUSION),
                        .gradient = (uint8_t)c->gradient,
                        .wall = wall,
                        .beta = viscous && c->beta != 0,
                        .xsph = forces && xsph,
                        .books = books,
                        .solid = sph_has_solids(c),
                        .total = sph_is_total(c),
                        .hat = (rates || (books && sim->fac.loses)) && hat,
                        .summed = sph_sums_density(c),
                        .loses = books && sim->fac.loses,
                        .repulsion = (uint8_t)(repels ? c->stress_exponent : 0),
                        .part = (uint8_t)part,
                        .form = (uint8_t)form_of(c, forces),
                        .hourglass = forces && sph_resists_hourglass(c),
                         .shifting = (uint8_t)(forces && sph_shifts(c) ? 1 + c->shift_pairs : 0),
                         .shear = viscous && sph_shears(c),
                         .edge = forces && sph_replaces(c),
                         .energy = sph_has_energy(c),
                         .varies = sph_varies_h(c)};
}

/* the fast paths of this pass, of tiles of matter (last without its form) and of ghosts, for all cells of a chunk */
static void find_fast_paths(const sph_sim *sim, sph_thread *t)
{
    for (uint32_t wall = 2; wall-- > 0;) {
        sph_choice c = choice_of(sim, wall);
        c.apart = SPH_HAS_APART && sph_asks_apart(sim);
        if (wall && SPH_IS(c.diffusion, ANTUONO) && SPH_WITH_HYDROSTATIC)
            c.diffusion = SPH_HYDROSTATIC; /* into walls there is none of either */
        t->fast_path[wall] = fast_path_of(&c);
        c.form = 0;
        t->fast_path[2] = SPH_HAS_STABILISED ? fast_path_of(&c) : 0;
    }
}

/* whether nobody in a tile feels what the stabilised form adds */
static bool is_slack(const sph_sim *sim, const sph_thread *t, const sph_choice *c, uint32_t homes)
{
    return SPH_HAS_STABILISED && sph_stabilised(c) && !c->wall && !sph_is_drawn(sim, t, homes);
}

/* whether some wall moves, and so may move by another */
static bool walls_move(const sph_sim *sim)
{
    bool moves = false;
    for (uint32_t g = 0; g < SPH_MAX_GROUPS && SPH_WITH_MOVING_WALLS; g++)
        moves |= sim->group[g].motion != NULL;
    return moves;
}

/* Adds a tile to the homes' sums, in a general form, where no fast path has. A ghost whose density goes by continuity
   sums over matter, and over the walls where one moves: a piston fills the room that the water before it leaves, or the
   ghosts of a bed beside its foot would thin out and pull. Its acceleration is not used. */
static void force_tile_any(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role, bool fast)
{
    sph_choice c = choice_of(sim, role == SPH_ROLE_GHOST);
    const uint8_t diffusion = c.diffusion;
    const bool meets = SPH_WITH_WALL_GHOST && walls_move(sim);
    const sph_factors *f = &sim->fac;
    c.apart = SPH_HAS_APART && sph_asks_apart(sim);
    c.form = is_slack(sim, t, &c, homes) ? 0 : c.form;
    for (uint32_t h = 0; h < homes; h++) {
        const bool matter = sph_is_matter(&sim->set[t->home_set[h]]);
        if (matter ? fast : role != SPH_ROLE_FLUID && !(role == SPH_ROLE_GHOST && meets))
            continue;
        if (SPH_WITH_WALL_GHOST)
            c.diffusion = matter ? diffusion : (uint8_t)SPH_NO_DIFFUSION; /* density does not diffuse into walls */
        if (c.apart && role != SPH_ROLE_FORCE_WALL)
            f = sph_pair_factors(sim, t, h, role == SPH_ROLE_GHOST);
        if (SPH_HAS_FORCE_WALLS && role == SPH_ROLE_FORCE_WALL)
            sph_boundary_force(sim, t, h);
        else if (SPH_WITH_VARIABLE_H && !SPH_SMALL && c.varies)
            force_varying(&c, f, sim, t, h);
        else if (SPH_WITH_BOOKS && !SPH_SMALL && c.loses)
            force_losing(&c, f, sim, t, h);
        else if (SPH_WITH_SOLID && c.solid)
            force_solid(&c, f, sim, t, h);
        else if (SPH_WITH_ENERGY && !SPH_SMALL && c.energy)
            force_energy(&c, f, sim, t, h);
        else if (SPH_HAS_FLUID_GRADIENT && !SPH_SMALL && c.gradient)
            force_corrected(&c, f, sim, t, h);
        else
            force_fluid(&c, f, sim, t, h);
    }
}
static void force_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    uint32_t path = SPH_WITH_FAST_PATHS && role != SPH_ROLE_FORCE_WALL ? t->fast_path[role == SPH_ROLE_GHOST] : 0;
    if (SPH_HAS_STABILISED && path && is_slack(sim, t, &fast_paths[path - 1].c, homes))
        path = t->fast_path[2];
    if (!path || fast_paths[path - 1].run(sim, t, homes) < homes)
        force_tile_any(sim, t, homes, role, path != 0);
}

/* ---- the pass ---- */

static bool is_force_home(const sph_sim *sim, const sph_set *s)
{
    const bool ghost = s->role == SPH_ROLE_GHOST && s->compressible && s->kind == SPH_WALL_GHOST;
    return sph_is_matter(s) || (ghost && sph_sums_rates(sim));
}

/* the column sets that these choices read */
static uint32_t columns_of(const sph_choice *c)
{
    const bool forces = sph_takes_forces(c), gradient = c->gradient && (forces || !SPH_IS(c->gradient, BONET_LOK));
    return (SPH_HAS_LAYERED_WALLS && (sph_viscous(c->viscosity) || c->shear) ? 1u << SPH_COLUMN_mirror : 0) |
           (SPH_IS(c->diffusion, ANTUONO) ? 1u << SPH_COLUMN_density_gradient : 0) |
           (c->shear ? 1u << SPH_COLUMN_shear : 0) | (SPH_WITH_ENERGY && c->energy ? 1u << SPH_COLUMN_energy : 0) |
           (sph_varies(c) ? 1u << SPH_COLUMN_wide : 0) | (c->hourglass ? 1u << SPH_COLUMN_deform : 0) |
           (sph_stabilised(c) ? 1u << SPH_COLUMN_drawn | 1u << SPH_COLUMN_means : 0) |
           (c->solid && forces ? 1u << SPH_COLUMN_stress : 0) | (c->total ? 1u << SPH_COLUMN_reference : 0) |
           (c->hat ? 1u << SPH_COLUMN_smoothed : 0) | (gradient ? 1u << SPH_COLUMN_gradient : 0);
}

static void force_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    if (!SPH_SMALL && sph_is_empty_chunk(sim, chunk, t))
        return;
    const sph_choice c = choice_of(sim, true);
    const bool points = sph_takes_forces(&c);
    if (SPH_WITH_FAST_PATHS)
        find_fast_paths(sim, t);
    const sph_sweep w = {is_force_home,
                         SPH_MATTER | 1u << SPH_ROLE_GHOST | (points ? 1u << SPH_ROLE_FORCE_WALL : 0),
                         sums_of(&c, true) | (points && (c.books || sim->has_force_wall) ? SUM_MASK(BOUNDARY) : 0),
                         (uint8_t)sph_needs_inv_rho(&c),
                         columns_of(&c),
                         force_tile,
                         sph_finish_home,
                         SPH_HAS_APART ? sph_asks_apart(sim) : 0,
                         SPH_SIFTS && SPH_HAS_TOTAL && c.total ? 1 + SPH_COLUMN_reference : 0};
    sph_sweep_chunk(sim, &w, chunk, t);
}

static sph_status force_end(sph_sim *sim)
{
    sim->next.peaks = (sph_peaks){sim->peaks.mu, SPH_SQRT(sim->peaks.acc), SPH_SQRT(sim->peaks.speed)};
    return SPH_OK;
}
const sph_pass sph_pass_force = {"force", sph_sweep_chunks, force_chunk, force_end, NULL};
