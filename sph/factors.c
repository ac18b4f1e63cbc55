/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* factors.c: constants of the pair formulas, made at init and when the configuration changes, or, where they are not
   the same for all pairs, of a home and a tile; and the Courant number that the integrator stands. */
#include "factors.h"
#include "density_gradient.h"
#include "kernels.h"
#include "sweep.h"
#include "arithmetic.h"

SPH_OBJECT(factors)

/* The predictor-corrector evaluates forces once a step, at the predicted state, and keeps them. In fluids it foresees
   the rise of the rate of density (kick.h), and stands an oscillation up to w dt = 0.75, where kick-drift-kick stands
   2; in disorder that is a Courant number of 0.5. Corrected gradients about double the frequency of the shortest waves
   at a surface: of kick-drift-kick and leap-frog, which keep standing waves quiet up to 1.2 and more without, it asks
   0.9 (with them standing waves of 10, 20, 40 particles in the depth lose a density at 1.1, 1.2, 1.0). */
#define KICK_CORRECTED 0.9
#define PC_FLUID 0.5
#define PC_FLUID_CORRECTED 0.25
/* Of solids nothing is foreseen: an oscillation is multiplied by 1 + (w dt)^4/4 a step (from mu^2 - (1 + 3z/2) mu +
   z/2 = 0, z = i w dt). Sound of the shortest waves grows unless dissipation, whose effect a step goes as dt, is
   stronger: so the largest Courant number goes as its cube root. 0.22 is what a still tank of 30 particles stood with
   alpha = 0.01 alone; with alpha 0.02, 0.1, 0.5 a free block of a solid kept quiet up to 0.29, 0.43, 0.65 (updated),
   0.18, 0.24, 0.37 (corrected).
   Runge-Kutta's rule of the middle multiplies it by 1 + (w dt)^4/8 (|1 + z + z^2/2|): half of that, which is as much as
   twice the dissipation: 2^(1/3) times the Courant number. */
#define PC_COURANT 0.22
#define PC_DISSIPATION (0.01 / 8) /* nu/(h c) of artificial viscosity with alpha 0.01 in 2-D */
#define PC_COURANT_LEAST 0.05
#define PC_UPDATED 0.75
#define PC_CORRECTED 0.42
#define RK_COURANT 1.2599210498948732 /* 2^(1/3) */
/* cube root of 1e-3 .. 1e6: Newton's rule from 1. At worst (1e6) one turn overshoots, about 20 take a third off each,
   6 converge */
static double cube_root(double x)
{
    double r = 1;
    for (int i = 0; i < 40; i++)
        r -= (r - x / (r * r)) / 3;
    return r;
}

/* what the predictor-corrector and Runge-Kutta stand in scenes with solids */
static double solids_stand(const sph_config *c)
{
    double d = sph_diffusive(c->diffusion) ? c->delta : 0;
    if (SPH_IS(c->viscosity, MORRIS))
        d += c->nu / (c->smoothing_length * c->sound_speed);
    else if (sph_viscous(c->viscosity))
        d += c->alpha / 8;
    const double x = d / PC_DISSIPATION;
    const double stands = x < 1e-3 ? 0 : x > 1e6 ? PC_COURANT * 100 : PC_COURANT * cube_root(x);
    const double own = stands * (sph_corrects(c) || sph_normalises(c) ? PC_CORRECTED : PC_UPDATED);
    const double most = own < PC_COURANT_LEAST ? PC_COURANT_LEAST : own;
    return c->integrator >= SPH_RUNGE_KUTTA ? RK_COURANT * most : most;
}

/* Diffusion takes density off the shortest waves at a rate s = 2 delta c/h K, K = -h^2 sum V g, which is h^2 2 pi W(0)
   in 2-D: 3.5 with Wendland's C2, in 3-D too, 4.5 and 4.6 with C4, less with the others. Runge-Kutta stands s dt = 2.
   The others see, when they make rates, a density that was taken on by the rates before: kick-drift-kick and leap-frog
   stand 1 (2 m^2 - (2 + 3 z) m + z = 0, z = -s dt, has the root m = -1 at z = -1), so does the predictor-corrector, and
   where it foresees the rise 1/2. The step is 7/8 of that: 0.125 h/(delta c) with C2 in kick-drift-kick. */
double sph_diffusion_factor(const sph_config *c)
{
    const double stands = c->integrator >= SPH_RUNGE_KUTTA ? 2 : sph_foresees(c) ? 0.5 : 1;
    return 0.875 * stands / (SPH_IS(c->kernel, WENDLAND_C4) ? 9.2 : 7.0);
}

/* The damper takes D of the forces' time from rates before it. With w dt = k C and damping theta k^2 C a step of the
   shortest waves (k 1.33: kick-drift-kick stands 1.5 without), its recursion stands C of 1.30, 1.14, 0.78, 0.50 at
   theta 0.1, 0.2, 0.5, 1: above 1.5/(1 + 2 theta). */
#define QUIET_COURANT 1.5
double sph_courant_factor(const sph_config *c)
{
    const bool rk = c->integrator >= SPH_RUNGE_KUTTA && sph_has_solids(c);
    const double theta = sph_quiets(c) ? c->damper : 0;
    if (!SPH_IS(c->integrator, PREDICTOR_CORRECTOR) && !rk) {
        const bool kicks = c->integrator < SPH_RUNGE_KUTTA && sph_corrects_fluids(c);
        const double most = QUIET_COURANT / (1 + 2 * theta);
        const double own = kicks && c->cfl > KICK_CORRECTED ? KICK_CORRECTED : c->cfl;
        return theta > 0 && own > most ? most : own;
    }
    const double fluid = sph_corrects_fluids(c) ? PC_FLUID_CORRECTED : PC_FLUID;
    const double stands = sph_has_solids(c) ? solids_stand(c) : fluid / (1 + 4 * theta);
    return c->cfl < stands ? c->cfl : stands;
}

/* whether the form of the equations does not conserve energy */
static bool loses_energy(const sph_config *c)
{
    bool loses = SPH_IS(c->scheme, DIRECT) || SPH_IS(c->scheme, STANDARD_WICK) || SPH_IS(c->scheme, WEAK_WICK) ||
        sph_smooths_strain(c) || sph_stabilises(c) || sph_normalises(c) ||
        (sph_sums_density(c) && sph_weak_scheme(c->scheme)) || sph_guards_gradient(c);
    for (uint32_t k = 0; k < SPH_DIM; k++) /* images that move along the face */
        loses |= SPH_IS(c->face[k][0], MIRROR_NO_SLIP) || SPH_IS(c->face[k][1], MIRROR_NO_SLIP);
    return loses;
}

/* Sums over the layers of a lattice at distances m dx from a home, m = 0 .. n - 1: of V K^2 g, and of V K_t^2 g, t an
   axis along the layer */
typedef struct lattice_layers {
    double all[32], along[32];
    uint32_t n;
} lattice_layers;
static lattice_layers sum_layers(const sph_config *c)
{
    const double dx = c->spacing, reach = sph_kernel_support(c->kernel) * c->smoothing_length / dx;
    lattice_layers l = {{0}, {0}, (uint32_t)reach + 1};
    const int32_t most = (int32_t)l.n, third = SPH_DIM == 3 ? most : 0;
    for (int32_t m = 0; m < most; m++)
        for (int32_t a = -most; a <= most; a++)
            for (int32_t b = -third; b <= third; b++) {
                const double k2 = m * m + a * a + b * b;
                double w, slope;
                if (!(k2 > 0) || !(k2 < reach * reach * (1 - 1e-9))) /* on the edge: beyond, whatever rounding says */
                    continue;
                sph_kernel_value(c->kernel, __builtin_sqrt(k2) * dx, c->smoothing_length, &w, &slope);
                l.all[m] += slope * __builtin_sqrt(k2); /* g K^2 = dW/dr r */
                l.along[m] += slope / __builtin_sqrt(k2) * a * a;
            }
    return l;
}

/* Q0 and beta of quadrature.c, from rows r of a half space, r dx deeper than the outermost: where the kernel reaches
   neighbours and diagonals only, beta = (1/24 + d)/(1 - d) (Q0/k)^2, k what the face cuts off, d = delta_0 */
static void make_weights(const sph_config *c, double slope, sph_factors *f)
{
    const lattice_layers l = sum_layers(c);
    double full = -l.all[0], deeper = 1.0 / 24, moment = 0;
    for (uint32_t m = 0; m < l.n; m++)
        full += 2 * l.all[m];
    for (uint32_t r = 0; r < 2 * l.n; r++) {
        double above = 0, along = l.along[0], weight = 0; /* what the face cuts off; what is left along it; phi - 1 */
        for (uint32_t m = 1; m < l.n; m++) {
            above += m > r ? l.along[m] * m : 0;
            along += l.along[m] * (m > r ? 1 : 2);
        }
        for (uint32_t m = 1; m < l.n; m++) {
            double up = 0, down = 0; /* by how much Q of row r - m, r + m is above that of row r */
            for (uint32_t k = 1; k < l.n; k++) {
                up -= k > r - m && k <= r ? l.all[k] : 0;
                down += k > r && k <= r + m ? l.all[k] : 0;
            }
            weight += l.all[m] * ((m <= r ? up : 0) + down);
        }
        deeper += above / along;
        moment -= weight / (full * full) * (r + above / along);
    }
    const double volume = SPH_DIM == 3 ? c->spacing * c->spacing * c->spacing : c->spacing * c->spacing;
    f->cover = full < 0 ? (sph_real)(slope / (full * volume * c->spacing)) : 0; /* else nobody has neighbours */
    f->weigh = full < 0 ? (sph_real)(deeper / moment) : 0;
}

/* sum of W V over row m of a lattice, to `most` spacings beside the middle */
static double layer_of(const sph_config *c, int32_t most, int32_t m)
{
    const double dx = c->spacing, volume = SPH_DIM == 1 ? dx : SPH_DIM == 2 ? dx * dx : dx * dx * dx;
    const int32_t second = SPH_DIM > 1 ? most : 0, third = SPH_DIM == 3 ? most : 0;
    double sum = 0;
    for (int32_t a = -second; a <= second; a++)
        for (int32_t b = -third; b <= third; b++) {
            double w, slope;
            sph_kernel_value(c->kernel, __builtin_sqrt(m * m + a * a + b * b) * dx, c->smoothing_length, &w, &slope);
            sum += w * volume;
        }
    return sum;
}

/* Between rows r and r + 1 below a flat face of a lattice, S (stabilised.h) lies below f->edge[r]; as far as it is
   told from the inside's: below 0.98 of it */
static void make_levels(const sph_config *c, sph_factors *f)
{
    const int32_t most = (int32_t)(sph_kernel_support(c->kernel) * c->smoothing_length / c->spacing) + 1;
    double full = layer_of(c, most, 0);
    for (int32_t m = 1; m <= most; m++)
        full += 2 * layer_of(c, most, m);
    for (int32_t r = 0; r < SPH_LEVELS; r++) {
        double lost = 0, next = 0;
        for (int32_t m = r + 1; m <= most; m++) {
            const double layer = layer_of(c, most, m);
            lost += layer;
            next += m > r + 1 ? layer : 0;
        }
        f->edge[r] = lost > 0.02 * full ? (sph_real)(full - 0.5 * (lost + next)) : 0;
    }
}

/* shifting: (W(0.8 dx)/W(dx))^4, at: W(dx); beyond all where the kernel does not reach a spacing */
static double pair_bound(const sph_config *c, double at)
{
    double w, dw;
    sph_kernel_value(c->kernel, SPH_SHIFT_APART * c->spacing, c->smoothing_length, &w, &dw);
    const double near2 = at > 0 ? w / at * (w / at) : 1e15;
    return near2 * near2;
}

/* constants of the pair formulas; made at init and when the configuration changes */
void sph_make_factors(sph_sim *sim)
{
    const sph_config *c = &sim->cfg;
    sph_factors *f = &sim->fac;
    const double most = sph_largest_h(c), support = sph_kernel_support(c->kernel);
    double h = c->smoothing_length, value, slope;
    sph_kernel_scales(c->kernel, h, &value, &slope);
    f->inv_h = (sph_real)(1 / h);
    f->eta = (sph_real)(0.01 * h * h); /* keeps pairs at one place finite */
    f->eta_morris = (sph_real)(1e-6 * h * h);
    f->reach = (sph_real)support;
    /* the scalar form skips pairs beyond: all terms are 0 there */
    f->reach2 = (sph_real)(support * support * most * most * 1.0001);
    f->slope = (sph_real)slope;
    f->value = (sph_real)value;
    if (sph_repels(c) || sph_is_total(c) || sph_shifts(c)) {
        double at, dw;
        sph_kernel_value(c->kernel, c->spacing, h, &at, &dw);
        f->inv_wdx = at > 0 ? (sph_real)(value / at) : 0;
        f->apart = sph_shifts(c) ? (sph_real)pair_bound(c, at) : 0;
        f->repulsion = (sph_real)c->stress_epsilon;
        const double density = sph_weak_scheme(c->scheme) ? c->rho0 : 1 / c->rho0;
        f->contact = (sph_real)(2 * c->sound_speed * c->sound_speed * density);
    }
    if (sph_stabilises(c) || sph_normalises(c))
        f->value_slope = (sph_real)(value / slope);
    if (sph_stabilises(c))
        make_levels(c, f);
    if (sph_weighs_faces(c))
        make_weights(c, slope, f);
    /* the formulas use mu' = mu/(rho_i + rho_j): 1/rho_mean = 2/(rho_i + rho_j), and |mu| = (rho_i + rho_j) |mu'| */
    f->av_alpha = (sph_real)(2 * h * c->alpha * c->sound_speed);
    f->av_beta = (sph_real)(2 * h * h * c->beta);
    f->morris = SPH_WITH_MORRIS ? (sph_real)(4 * c->nu) : 0;
    f->diff = SPH_HAS_DIFFUSION ? (sph_real)(2 * c->delta * h * c->sound_speed) : 0;
    f->least_rho = SPH_HAS_DIFFUSION ? (sph_real)(SPH_LEAST_DENSITY * c->rho0) : 0;
    const double c2 = c->sound_speed * c->sound_speed * (SPH_IS(c->eos, TAIT_GRAY) ? 7 : 1);
    for (int k = 0; k < SPH_DIM; k++) {
        f->gravity[k] = (sph_real)c->gravity[k];
        /* density difference that gravity makes over a distance r at rest: rho0 g . r / c^2 */
        f->hydro[k] = SPH_IS(c->diffusion, HYDROSTATIC) ? (sph_real)(c->rho0 * c->gravity[k] / c2) : 0;
    }
    sim->courant = sph_courant_factor(c);
    f->rate_by_density = sph_weak_scheme(c->scheme) || SPH_IS(c->gradient, BONET_LOK);
    f->continuity = !sph_sums_density(c);
    f->loses = sph_keeps_books(c) && loses_energy(c);
    f->bonds = sph_is_total(c) || sph_repels(c);
    f->extras = SPH_HAS_EXTRAS && (sph_uses_xsph(c) || (SPH_WITH_BODY_FORCE && c->body_force) || sph_keeps_books(c));
    if (SPH_WITH_STANDARD_WICK || SPH_WITH_WEAK_WICK)
        f->small_p = (sph_real)(1e-6 * c->rho0 * c->sound_speed * c->sound_speed);
}

/* ---- of pairs of one kind ---- */

/* what the tiles of matter must be of one kind for (sph_sweep.apart) */
uint8_t sph_asks_apart(const sph_sim *sim)
{
    const sph_config *c = &sim->cfg;
    const bool artificial = sph_viscous(c->viscosity) && !SPH_IS(c->viscosity, MORRIS);
    const bool sounds = artificial && sim->own_sound && !sph_has_energy(c);
    const bool asks = (sph_diffusive(c->diffusion) && sim->mixed) || sounds;
    uint8_t apart = SPH_WITH_SEVERAL_FLUIDS && asks ? SPH_APART_KIN : 0;
    for (uint32_t k = 0; k < SPH_DIM && SPH_HAS_MIRRORS && SPH_IS(c->diffusion, HYDROSTATIC); k++)
        for (uint32_t side = 0; side < 2; side++) {
            const uint32_t face = c->face[k][side];
            const bool mirror = SPH_IS(face, SYMMETRY) || SPH_IS(face, MIRROR_NO_SLIP);
            apart |= mirror && c->gravity[k] != 0 ? SPH_APART_MIRRORED : 0;
        }
    if (SPH_HAS_MIRRORS && sph_takes_density_gradient(c) && sph_turns_upside_down(c))
        apart |= SPH_APART_MIRRORED;
    return apart;
}

/* The constants of the pair formulas between a home and a tile of one kind: viscosity with the mean of both sound
   speeds (walls: the home's), diffusion with that of the one material that it acts in. Where an image shows what stands
   in truth at S - x' (home cell's coordinates), the difference that gravity makes is of x_i - (S - x') =
   -(x_i - x') + 2 x_i - S. */
#if SPH_HAS_APART
const sph_factors *sph_pair_factors(const sph_sim *sim, sph_thread *t, uint32_t h, bool ghosts)
{
    const sph_config *c = &sim->cfg;
    sph_factors *const f = &t->factors;
    const sph_set *i = &sim->set[t->home_set[h]], *j = ghosts ? i : t->of;
    const double c2 = i->c0 * i->c0 * (SPH_IS(i->eos, TAIT_GRAY) ? 7 : 1);
    *f = sim->fac;
    f->least_rho = (sph_real)(SPH_LEAST_DENSITY * i->rho0);
    f->av_alpha = (sph_real)(c->smoothing_length * c->alpha * (i->c0 + j->c0));
    if (SPH_HAS_DIFFUSION)
        f->diff = i->kin == j->kin ? (sph_real)(2 * c->delta * c->smoothing_length * i->c0) : 0;
    if (sph_takes_density_gradient(c) && !ghosts && sph_is_upside_down(sim, t))
        f->diff = 0;
    for (uint32_t k = 0; k < SPH_DIM && SPH_IS(c->diffusion, HYDROSTATIC); k++) {
        const double slope = i->rho0 * c->gravity[k] / c2;
        const bool turned = !ghosts && t->seen.sign[k] < 0;
        f->hydro[k] = (sph_real)(turned ? -slope : slope);
        if (turned)
            f->hydro_offset += (sph_real)(slope * (2 * (double)t->home.x[k][h] -
                                                   (double)(t->seen.shift[k] - 2 * t->origin[k]) * sim->grid.quantum));
    }
    return f;
}
#endif
