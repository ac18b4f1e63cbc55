/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shifting.c: particle shifting: at a step's end the fluid's particles drift a little from where they are dense to
   where they are sparse, so that the disorder that makes the noise of the pressure does not build up (Lind, Xu, Stansby
   & Rogers 2012; the bracket is Monaghan's 2000 term against clumping, with R = 0.2 and n = 4):

     dx_i = -C dt v_max 4h sum V_j [1 + 0.2 (W/W(dx))^4] grad W,   |dx_i| at most 0.05 spacings

   over fluid and walls, images included, with the largest speed v_max. Only inside: where sum V_j W > 0.9 and the
   smallest eigenvalue of sum V_j (x_j - x_i) (x) grad W is above 0.75; a surface would be blown apart. Boundary-force
   walls have no volume: beside them nothing is shifted.

   There, near a surface, rows that the flow squeezes end up one on the other: in a turning square of water pairs come
   to 0.1 spacings, none of them inside. With shift_pairs particles that are not inside are moved by what the bracket
   has of pairs closer than 0.8 spacings, which knows nothing of the empty half of the support:

     dx_i = -C dt v_max 4h 0.5 sum V_j max(0, (W/W(dx))^4 - (W(0.8 dx)/W(dx))^4) grad W

   What evens the particles out also wipes out the memory of the strain by which continuity, with plain gradients, was
   wrong: rho no longer goes with the number of particles, and a sloshing tank swells (5 % in 20 periods). So deep
   inside, where that eigenvalue is above 0.98, density goes slowly to where the volumes fill space:

     rho_i += rho_i r (sum V_j W - 1),   r = C dt v_max/h, at most 1/2

   Velocities stay, so momentum does, to the last bit; angular momentum and energy do not: what potential and internal
   energy lose is the book `shifted`.

   When: the sums are those of the step's last forces (shift_sums.h), at the places of its end (Runge-Kutta: of its
   middle); the drift comes last. The order in time is that of the integrator but for the drift, which goes as dt.

   Arrays: disorder (SPH_DIM + 1 reals a particle), shifted (a double for each chunk of a local pass). Cost: sums in the
   force sweep, a local pass. */
#include "eos.h"
#include "motion.h"
#include "shift_sums.h"
#include "arithmetic.h"

SPH_OBJECT(shifting)

#if SPH_WITH_SHIFTING
#define LEAST_COVER ((sph_real)0.9)
#define LEAST_SPREAD ((sph_real)0.75)
#define DEEP_SPREAD ((sph_real)0.98)
#define MOST_SPACINGS 0.05
#define PAIRS ((sph_real)0.5) /* with 0.2, as in the bracket, pairs of that square come to 0.55 dx, with 0.5 to 0.64 */

sph_status sph_check_shifting(const sph_config *c, sph_report *r)
{
    if (c->shift_pairs && !sph_shifts(c))
        return sph_refuse(r, "shift_pairs", "false unless shifting is above 0", 1);
    if (sph_shifts(c) && sph_has_solids(c))
        return sph_refuse(r, "shifting", "0 in scenes with solids", c->shifting);
    return SPH_OK;
}

/* ---- what becomes of the sums ---- */

/* whether all eigenvalues of a symmetric tensor are above a bound: its leading minors less the bound are above 0 */
static bool is_above(const sph_real *t, sph_real bound)
{
    sph_real a[SPH_NT];
    for (uint32_t k = 0; k < SPH_NT; k++)
        a[k] = t[k] - (k < SPH_DIM ? bound : 0);
    /* xx yy zz xy xz yz */
    enum { XX, YY = SPH_DIM > 1, ZZ = SPH_DIM > 2 ? 2 : 0, XY = SPH_DIM - 1 + YY };
    enum { XZ = SPH_DIM > 2 ? 4 : 0, YZ = SPH_DIM > 2 ? 5 : 0 };
    const sph_real minor = a[XX] * a[YY] - a[XY] * a[XY];
    bool fine = a[XX] > 0 && (SPH_DIM == 1 || minor > 0);
    if (SPH_DIM == 3)
        fine &= a[ZZ] * minor - (a[XX] * (a[YZ] * a[YZ]) + a[YY] * (a[XZ] * a[XZ]) - 2 * (a[XY] * a[YZ] * a[XZ])) > 0;
    return fine;
}

/* minus the slope of disorder, 1/m; then what the cover is above 1. Near a surface 0, or that of close pairs */
void sph_finish_shift(sph_sim *sim, const sph_thread *t, uint32_t h)
{
    const sph_factors *f = &sim->fac;
    sph_real spread[SPH_NT];
    for (uint32_t k = 0; k < SPH_NT; k++)
        spread[k] = -v_fold(t->sum[SUM_SPREAD + k][h]) * f->slope;
    const sph_real cover = v_fold(t->sum[SUM_COVER][h]) * f->value;
    const bool inside = cover > LEAST_COVER && is_above(spread, LEAST_SPREAD), pairs = sim->cfg.shift_pairs;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        sim->disorder[k][t->home_at[h]] =
            inside ? -v_fold(t->sum[SUM_SHIFT + k][h]) * f->slope
            : pairs ? -v_fold(t->sum[SUM_NEARER + k][h]) * (f->slope * PAIRS) : 0;
    const bool deep = inside && f->continuity && is_above(spread, DEEP_SPREAD);
    sim->disorder[SPH_DIM][t->home_at[h]] = deep ? cover - 1 : 0;
}

/* ---- the pass ---- */

/* moves a particle by d (m); across an open face nobody is shifted. Returns what that takes of its potential energy,
   J/kg: round a periodic domain it goes on at the height that it had */
static double shift(const sph_sim *sim, uint32_t i, const double *d)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    sph_pos q[SPH_DIM], step[SPH_DIM];
    double taken = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const double s = d[k] / sim->grid.quantum;
        step[k] = (sph_pos)(s < 0 ? s - 0.5 : s + 0.5);
        q[k] = b->pos[k][i] + step[k];
    }
    const uint32_t turned = sph_enforce_faces(sim, q);
    if (turned & SPH_LEFT)
        return 0;
    if (SPH_HAS_MIRRORS && turned)
        sph_turn_fields(sim, i, turned);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        const bool round = SPH_IS(sim->cfg.face[k][0], PERIODIC);
        const sph_pos way = round ? step[k] : q[k] - b->pos[k][i];
        taken += sim->cfg.gravity[k] * ((double)way * sim->grid.quantum);
        sph_displace_fields(sim, b, i, k, way);
        b->pos[k][i] = q[k];
    }
    return taken;
}

/* how far particle i is to go, given what its slope of disorder is multiplied by (m^2); false: nowhere, or beyond all
   bounds, and the next forces fail */
static bool drift_of(const sph_sim *sim, uint32_t i, double strength, double *d)
{
    const double most = MOST_SPACINGS * sim->cfg.spacing;
    double d2 = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        d[k] = strength * (double)sim->disorder[k][i];
        d2 += d[k] * d[k];
    }
    const double less = d2 > most * most ? most / __builtin_sqrt(d2) : 1;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        d[k] *= less;
    return d2 > 0 && d2 < 1e300;
}

static double energy(const sph_sim *sim, const sph_set *s, sph_real d)
{
    if (sph_is_gas(s)) /* goes with the particle */
        return 0;
    return sph_eos_energy(s->eos, (double)s->b_r, s->rho0, (double)d, sph_has_floor(sim, s));
}

/* fills space: the density of particle i by a share of what its cover is too much; returns what that takes of its
   internal energy, J/kg */
static double fill_space(const sph_sim *sim, const sph_set *s, uint32_t i, sph_real share)
{
    sph_real *d = &sim->buf[sim->dst].rho[0][i];
    const sph_real was = *d, more = share * sim->disorder[SPH_DIM][i];
    if (!(more < 1 && more > -1)) /* a failure, as above */
        return 0;
    *d = was + (1 + was) * more;
    return energy(sim, s, was) - energy(sim, s, *d);
}

static void shift_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span span = sph_chunk_span(sim, chunk);
    const double h = sim->cfg.smoothing_length, way = sim->cfg.shifting * sim->dt * (double)sim->next.peaks.speed;
    const sph_real share = (sph_real)(way < 0.5 * h ? way / h : 0.5);
    double d[SPH_DIM], sum = 0;
    for (uint32_t i = span.first; i < span.last; i++) {
        const uint8_t set = sim->buf[sim->dst].set[0][i];
        if (set == SPH_DEAD || !sph_is_matter(&sim->set[set]) || sph_flow_of(sim, &sim->set[set]))
            continue;
        double taken = fill_space(sim, &sim->set[set], i, share);
        if (drift_of(sim, i, way * (4 * h), d))
            taken += shift(sim, i, d);
        sum += sim->set[set].mass * taken;
    }
    sim->shifted[chunk] = sum;
    t->work += span.last - span.first;
}

/* the book: chunks in their order */
static sph_status shift_end(sph_sim *sim)
{
    double sum = 0;
    for (uint32_t chunk = 0; chunk < sph_local_chunks(sim); chunk++)
        sum += sim->shifted[chunk];
    sim->next.shifted += sum;
    return SPH_OK;
}

static bool shifts(const sph_sim *sim) { return sph_shifts(&sim->cfg); }

const sph_pass sph_pass_shifting = {"shifting", sph_local_chunks, shift_chunk, shift_end, shifts};
#endif
