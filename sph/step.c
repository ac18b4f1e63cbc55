/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* step.c: the integrators as lists of passes, and the local passes: what is done to each particle before and after the sums.
   run.c runs the lists.

   A step goes from buffer cur into another; nothing that the next step would read changes before run.c commits. */
#include "fluid.h"

/* ---- stages: passes that only say where the next sort goes ---- */

static uint32_t spare(const sph_sim *sim, uint32_t a, uint32_t b)
{
    for (uint32_t k = 0; k < sim->buffers; k++)
        if (k != a && k != b)
            return k;
    return 0;
}

static sph_status first_stage(sph_sim *sim, uint32_t mode)
{
    sph_begin_sort(sim, sim->cur, spare(sim, sim->cur, sim->cur), sim->now.count, sim->table_valid, mode);
    return SPH_OK;
}
static sph_status begin_copy(sph_sim *sim) { return first_stage(sim, SPH_ADV_COPY); }
static const sph_pass pass_begin_copy = {"begin", NULL, NULL, begin_copy, NULL};
#if SPH_WITH_PREDICTOR_CORRECTOR
static sph_status begin_pc(sph_sim *sim) { return first_stage(sim, SPH_ADV_PC); }
static const sph_pass pass_begin_pc = {"begin", NULL, NULL, begin_pc, NULL};
#endif
#if SPH_WITH_KICK_DRIFT_KICK
static sph_status begin_kdk(sph_sim *sim) { return first_stage(sim, SPH_ADV_KDK); }
static const sph_pass pass_begin_kdk = {"begin", NULL, NULL, begin_kdk, NULL};
#endif
#if SPH_WITH_LEAP_FROG
static sph_status begin_leap(sph_sim *sim) { return first_stage(sim, SPH_ADV_LEAP); }
static const sph_pass pass_begin_leap = {"begin", NULL, NULL, begin_leap, NULL};
#endif
#if SPH_HAS_RUNGE_KUTTA
static sph_status begin_rk(sph_sim *sim)
{
    sph_begin_sort(sim, sim->dst, spare(sim, sim->cur, sim->dst), sim->next.count, true, SPH_ADV_RK);
    return SPH_OK;
}
static const sph_pass pass_begin_rk = {"begin second stage", NULL, NULL, begin_rk, NULL};
#endif

/* ---- local passes: what is done to each particle after the sums ---- */

typedef struct span {
    uint32_t first, last;
} span;
static span chunk_span(const sph_sim *sim, uint32_t chunk)
{
    span s = {chunk * SPH_LOCAL_CHUNK, (chunk + 1) * SPH_LOCAL_CHUNK};
    s.last = s.last < sim->next.count ? s.last : sim->next.count;
    return s;
}

/* indices become ids, and walls get the zeros that sums did not write */
static void settle(const sph_sim *sim, span s)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    uint32_t *id = b->id[0];
    const uint32_t *of = sim->buf[sim->src].id[0];
    for (uint32_t i = s.first; i < s.last; i++)
        id[i] = of[id[i]];
    for (uint32_t i = s.first, e; i < s.last; i = e) {
        e = sph_run_end(b->set[0], i, s.last);
        if (b->set[0][i] == SPH_DEAD || sph_is_body(&sim->set[b->set[0][i]]))
            continue;
        const size_t bytes = (e - i) * sizeof(sph_real);
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            memset(b->acc[k] + i, 0, bytes);
            if (SPH_WITH_XSPH && b->xsph[k])
                memset(b->xsph[k] + i, 0, bytes);
        }
        if (!sim->set[b->set[0][i]].compressible)
            memset(b->drho[0] + i, 0, bytes);
        for (uint32_t k = 0; sph_keeps_books(&sim->cfg) && k < SPH_POWERS; k++)
            memset(sim->power[k] + i, 0, bytes);
    }
}

static void settle_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const span s = chunk_span(sim, chunk);
    settle(sim, s);
    t->work += s.last - s.first;
}

/* velocities and densities that must not go on: too large, or a density that no equation of state has */
static void check_span(sph_sim *sim, span s, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    vint wrong = v_set_int(SPH_SCALAR); /* without vectors the second loop does it all */
    for (uint32_t i = s.first; !SPH_SCALAR && i < s.last; i += SPH_W) {
        const vreal d = v_load(b->rho[0] + i);
        vreal v2 = v_set(0);
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const vreal v = v_load(b->vel[k] + i);
            v2 = v2 + v * v;
        }
        wrong |= ~(v_less(v2, v_set(SPH_LIMIT_SQUARE)) & v_less(v_set((sph_real)-0.9), d) & v_less(d, v_set(99)));
    }
    sph_int lanes[SPH_W], fine = 1;
    v_store_int(lanes, wrong);
    for (int l = 0; l < SPH_W; l++)
        fine &= lanes[l] == 0; /* lanes beyond the last particle may cry wolf: the loop below looks again */
    for (uint32_t i = s.first; !fine && i < s.last; i++) {
        sph_real v2 = 0, d = b->rho[0][i];
        for (uint32_t k = 0; k < SPH_DIM; k++)
            v2 += b->vel[k][i] * b->vel[k][i];
        if (!(v2 < SPH_LIMIT_SQUARE) || d - d != 0)
            sph_fail_note(t, SPH_NOT_FINITE, b->id[0][i], (double)v2);
        else if (!(d > (sph_real)-0.9 && d < 99))
            sph_fail_note(t, SPH_DENSITY_LOST, b->id[0][i], (double)d);
    }
#if SPH_WITH_SOLID
    for (uint32_t k = 0; k < SPH_NS && b->stress[0]; k++)
        for (uint32_t i = s.first; i < s.last; i++)
            if (!(b->stress[k][i] - b->stress[k][i] == 0))
                sph_fail_note(t, SPH_NOT_FINITE, b->id[0][i], (double)b->stress[k][i]);
    for (uint32_t i = s.first; i < s.last && SPH_HAS_YIELD && b->plastic[0]; i++)
        if (!(b->plastic[0][i] >= 0 && b->plastic[0][i] - b->plastic[0][i] == 0))
            sph_fail_note(t, SPH_NOT_FINITE, b->id[0][i], (double)b->plastic[0][i]);
    for (uint32_t i = s.first; i < s.last && SPH_HAS_DAMAGE && b->damage[0]; i++)
        if (!(b->damage[0][i] >= 0 && b->damage[0][i] <= 1))
            sph_fail_note(t, SPH_NOT_FINITE, b->id[0][i], (double)b->damage[0][i]);
#endif
}

#if SPH_WITH_BOOKS
/* what the motion of a held set has added to its kinetic energy in this step, J/kg: exact, so that velocities may jump */
static double held_gain(const sph_sim *sim, const sph_set *set)
{
    const uint32_t held = sph_held(sim, set);
    double gain = 0;
    for (uint32_t k = 0; k < SPH_DIM; k++)
        if (held >> k & 1) {
            const double v = sph_wall_velocity(sim, set, k), before = sim->now.group[set->group].vel[k];
            gain += 0.5 * (v * v - before * before);
        }
    return gain;
}

/* sums of powers for the books: one row a chunk, added up in order of chunks afterwards */
static void sum_powers(sph_sim *sim, uint32_t chunk, span s)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    double sum[SPH_PARTIALS] = {0};
    for (uint32_t i = s.first; i < s.last; i++) {
        if (b->set[0][i] == SPH_DEAD)
            continue;
        const sph_set *set = &sim->set[b->set[0][i]];
        sum[SPH_POWERS] += set->mass * held_gain(sim, set);
        double d = (double)b->rho[0][i], rho = set->rho0 * (1 + d);
        for (uint32_t k = 0; k < SPH_POWERS; k++) {
            double p = set->mass * (double)sim->power[k][i];
            sum[k] += k == 2 ? p * -sph_pressure(sim, set, d) / (rho * rho) : p; /* energy that diffusion takes */
        }
    }
    memcpy(sim->partial + (size_t)chunk * SPH_PARTIALS, sum, sizeof sum);
}

/* books: powers integrate by the trapezoidal rule */
static sph_status add_books(sph_sim *sim)
{
    if (!sim->cfg.books)
        return SPH_OK;
    for (uint32_t k = 0; k < SPH_PARTIALS; k++) {
        double sum = 0;
        for (uint32_t c = 0; c < sph_local_chunks(sim); c++)
            sum += sim->partial[(size_t)c * SPH_PARTIALS + k];
        if (k == SPH_POWERS) {
            sim->next.work[1] += sum;
            break;
        }
        sim->next.work[k] += 0.5 * sim->dt * (sim->now.power[k] + sum);
        sim->next.power[k] = sum;
    }
    return SPH_OK;
}
static sph_status prime_books(sph_sim *sim)
{
    double keep[SPH_POWERS];
    memcpy(keep, sim->next.work, sizeof keep);
    sph_status st = add_books(sim);
    memcpy(sim->next.work, keep, sizeof keep);
    return st;
}
#else
#define add_books NULL
#define prime_books NULL
#endif

static void finish_span(sph_sim *sim, uint32_t chunk, span s, sph_thread *t)
{
    settle(sim, s);
#if SPH_HAS_DAMAGE
    if (sph_damages(&sim->cfg))
        sph_grow_damage(sim, s.first, s.last);
#endif
#if SPH_HAS_WALLS
    sph_cross_walls(sim, s.first, s.last, t);
#endif
    check_span(sim, s, t);
#if SPH_WITH_BOOKS
    if (sim->cfg.books)
        sum_powers(sim, chunk, s);
#endif
    (void)chunk;
    t->work += s.last - s.first;
}

#if SPH_WITH_PREDICTOR_CORRECTOR || SPH_WITH_KICK_DRIFT_KICK

/* v = damping (v_p + dt/2 (a - a_o)), rho = rho_p + dt/2 (drho - drho_o)  (Gray 2001 eqs 2.28, 2.29);
   kick-drift-kick: v = damping (v_h + dt/2 a), and the density has had its whole step already */
SPH_INLINE void correct(sph_sim *sim, uint32_t chunk, sph_thread *t, bool kdk)
{
    const span s = chunk_span(sim, chunk);
    const sph_buffer b = sim->buf[sim->dst], o = sim->buf[sim->src];
    const sph_real half = (sph_real)sim->dt * (sph_real)0.5, g = (sph_real)sim->cfg.damping;
#if SPH_WITH_SOLID
    if (!kdk && sph_has_solids(&sim->cfg))
        sph_advance_stress(sim, s.first, s.last, SPH_STRESS_CORRECT);
#endif
    for (uint32_t i = s.first; i < s.last;) {
        const uint32_t e = sph_run_end(b.set[0], i, s.last);
        const sph_set *set = &sim->set[b.set[0][i]];
        const bool fluid = sph_is_body(set);
        const uint32_t held = sph_held(sim, set);
        for (uint32_t j = i; j < e && !kdk && (fluid || set->compressible); j++)
            b.rho[0][j] = b.rho[0][j] + half * (b.drho[0][j] - o.drho[0][b.id[0][j]]);
        SPH_UNROLL
        for (uint32_t k = 0; k < SPH_DIM; k++)
            for (uint32_t j = i; j < e && fluid && !(held >> k & 1); j++) {
                const sph_real a = kdk ? b.acc[k][j] : b.acc[k][j] - o.acc[k][b.id[0][j]];
                b.vel[k][j] = g * (b.vel[k][j] + half * a);
            }
        i = e;
    }
    finish_span(sim, chunk, s, t);
}
#endif
#if SPH_WITH_PREDICTOR_CORRECTOR
static void correct_pc_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t) { correct(sim, chunk, t, false); }
static const sph_pass pass_correct_pc = {"correct", sph_local_chunks, correct_pc_chunk, add_books, NULL};
#endif
#if SPH_WITH_KICK_DRIFT_KICK
static void correct_kdk_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t) { correct(sim, chunk, t, true); }
static const sph_pass pass_correct_kdk = {"kick", sph_local_chunks, correct_kdk_chunk, add_books, NULL};
#endif

#if SPH_HAS_RATES_FIRST
/* Leap-frog (Powell 2012 algorithm 1.1) and kick-drift-kick: the density goes a whole step with the rates of the half-step
   velocity at the new positions, like a position; then come the forces. (Taking the rates of the velocity at the ends,
   with one sweep, makes sound waves grow.) */
static void leap_density_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const span s = chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    for (uint32_t i = s.first; i < s.last; i++) {
        const sph_set *set = &sim->set[b->set[0][i]];
        if (sph_is_body(set) || set->compressible)
            b->rho[0][i] += (sph_real)sim->dt * b->drho[0][i];
    }
#if SPH_WITH_SOLID
    if (sph_has_solids(&sim->cfg))
        sph_advance_stress(sim, s.first, s.last, SPH_STRESS_WHOLE);
#endif
    t->work += s.last - s.first;
}
static const sph_pass pass_leap_density = {"density", sph_local_chunks, leap_density_chunk, NULL, NULL};
#endif
#if SPH_WITH_LEAP_FROG
/* then the velocity a whole step with the new acceleration */
static void leap_velocity_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const span s = chunk_span(sim, chunk);
    const sph_buffer *b = &sim->buf[sim->dst];
    const sph_real dt = (sph_real)sim->dt, g = (sph_real)sim->cfg.damping;
    for (uint32_t i = s.first; i < s.last; i++) {
        const sph_set *set = &sim->set[b->set[0][i]];
        const uint32_t held = sph_held(sim, set);
        for (uint32_t k = 0; k < SPH_DIM && sph_is_body(set); k++)
            if (!(held >> k & 1))
                b->vel[k][i] = g * (b->vel[k][i] + dt * b->acc[k][i]);
    }
    finish_span(sim, chunk, s, t);
}

static const sph_pass pass_leap_velocity = {"velocity", sph_local_chunks, leap_velocity_chunk, add_books, NULL};
#endif

#if SPH_HAS_RUNGE_KUTTA
/* x moves by d (m); the faces' rules apply as in the sort */
static void place(sph_sim *sim, uint32_t i, const double *d, const sph_pos *from, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    sph_pos q[SPH_DIM];
    sph_real v[SPH_DIM];
    bool near = true;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        double s = d[k] / sim->grid.quantum;
        near &= sph_abs(d[k]) < sim->grid.length[k] / sim->grid.ncell[k];
        q[k] = from[k] + (sph_pos)(near ? s < 0 ? s - 0.5 : s + 0.5 : 0);
        v[k] = b->vel[k][i];
    }
    if (!near)
        sph_fail_note(t, d[0] - d[0] == 0 ? SPH_MOVED_TOO_FAR : SPH_NOT_FINITE,
                      sim->buf[sim->src].id[0][b->id[0][i]], d[0]);
    int r = sph_enforce_faces(sim, q, v);
    if (r == 2) {
        t->left++;
        if (sim->cfg.on_leave == SPH_FAIL)
            sph_fail_note(t, SPH_OUT_OF_DOMAIN, sim->buf[sim->src].id[0][b->id[0][i]], (double)q[0] * sim->grid.quantum);
        else
            b->set[0][i] = SPH_DEAD;
        return;
    }
    t->reflected += r == 1;
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        b->pos[k][i] = q[k];
        b->vel[k][i] = v[k];
    }
}

/* the second halves of the Runge-Kutta forms, as printed: 3.86-3.87, and 3.92 */
static void rk_particle(sph_sim *sim, uint32_t i, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst], *o = &sim->buf[sim->src];
    const bool momentum = SPH_IS(sim->cfg.integrator, RUNGE_KUTTA_MOMENTUM);
    const sph_real dt = (sph_real)sim->dt, half = dt * (sph_real)0.5;
    const uint32_t p = b->id[0][i];
    const sph_set *set = &sim->set[b->set[0][i]];
    if (sph_is_body(set) || set->compressible) {
        const sph_real r = o->rho[0][p], d = b->drho[0][i];
        const sph_real mid = r + half * d;
        b->rho[0][i] = momentum ? r + dt * d : 2 * mid - r;
    }
    if (!sph_is_body(set))
        return;
    double move[SPH_DIM];
    sph_pos from[SPH_DIM];
    const uint32_t held = sph_held(sim, set);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (held >> k & 1) { /* where the sort put it */
            move[k] = 0;
            from[k] = b->pos[k][i];
            continue;
        }
        const sph_real v = o->vel[k][p], half_v = v + half * o->acc[k][p];
        /* a mirror face that turned the velocity at half time turned the frame of the forces there: turn it back */
        const sph_real turn = b->vel[k][i] == half_v ? 1 : -1;
        const sph_real a = turn * b->acc[k][i], x = SPH_WITH_XSPH && b->xsph[k] ? turn * b->xsph[k][i] : 0;
        const sph_real mid = v + half * a;
        const sph_real u = momentum ? (sph_real)0.5 * ((v + dt * o->acc[k][p]) + v) : half_v;
        move[k] = (double)dt * (double)(u + x);
        from[k] = o->pos[k][p];
        b->vel[k][i] = (sph_real)sim->cfg.damping * (momentum ? v + dt * a : 2 * mid - v);
    }
    place(sim, i, move, from, t);
}
static void rk_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const span s = chunk_span(sim, chunk);
    for (uint32_t i = s.first; i < s.last; i++)
        rk_particle(sim, i, t);
#if SPH_WITH_SOLID
    if (sph_has_solids(&sim->cfg))
        sph_advance_stress(sim, s.first, s.last, SPH_STRESS_RK);
#endif
    finish_span(sim, chunk, s, t);
}

static const sph_pass pass_settle = {"settle", sph_local_chunks, settle_chunk, NULL, NULL};
static const sph_pass pass_rk = {"advance", sph_local_chunks, rk_chunk, add_books, NULL};
#endif

static void prime_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    settle_chunk(sim, chunk, t);
#if SPH_WITH_BOOKS
    if (sim->cfg.books)
        sum_powers(sim, chunk, chunk_span(sim, chunk));
#endif
}
static const sph_pass pass_prime = {"settle", sph_local_chunks, prime_chunk, prime_books, NULL};

/* ---- the one list of passes: what each integrator does, in order ---- */

#if SPH_WITH_SHEPARD
#define SHEPARD &sph_pass_shepard,
#else
#define SHEPARD
#endif
#if SPH_WITH_SUMMATION
#define SUMMATION &sph_pass_summation,
#else
#define SUMMATION
#endif
#if SPH_HAS_FILTERS
#define FILTER SHEPARD SUMMATION &sph_pass_copy_density,
#else
#define FILTER
#endif
#if SPH_WITH_WALL_ADAMI
#define ADAMI &sph_pass_adami, &sph_pass_adami_copy,
#else
#define ADAMI
#endif
#if SPH_WITH_SOLID
#define CARRY &sph_pass_carry,
#else
#define CARRY
#endif
#if SPH_HAS_CORRECTION
#define CORRECTION &sph_pass_correction,
#else
#define CORRECTION
#endif
#if SPH_HAS_HAT
#define SMOOTH &sph_pass_smooth,
#else
#define SMOOTH
#endif
#define SORT &sph_pass_count, &sph_pass_scatter, CARRY
#if SPH_HAS_FLUID_GRADIENT
#define GRADIENT &sph_pass_gradient,
#else
#define GRADIENT
#endif
#define FORCES ADAMI CORRECTION GRADIENT SMOOTH &sph_pass_force,

typedef const sph_pass *const program[];
static program prime_program = {&pass_begin_copy, SORT FILTER FORCES &pass_prime, NULL};
#if SPH_WITH_PREDICTOR_CORRECTOR
static program pc_program = {&pass_begin_pc, SORT FILTER FORCES &pass_correct_pc, NULL};
#endif
#if SPH_WITH_KICK_DRIFT_KICK
static program kdk_program = {&pass_begin_kdk, SORT FORCES &pass_leap_density, FILTER FORCES &pass_correct_kdk, NULL};
#endif
#if SPH_WITH_LEAP_FROG
static program leap_program = {&pass_begin_leap, SORT FORCES &pass_leap_density, FILTER FORCES &pass_leap_velocity, NULL};
#endif
#if SPH_HAS_RUNGE_KUTTA
static program rk_program = {&pass_begin_copy, SORT FILTER FORCES &pass_settle,
                             &pass_begin_rk,   SORT FILTER FORCES &pass_rk, NULL};
#endif

const sph_pass *const *sph_prime_program(void) { return prime_program; }

const sph_pass *const *sph_program_of(uint32_t integrator)
{
#if SPH_WITH_PREDICTOR_CORRECTOR
    if (integrator == SPH_PREDICTOR_CORRECTOR)
        return pc_program;
#endif
#if SPH_WITH_KICK_DRIFT_KICK
    if (integrator == SPH_KICK_DRIFT_KICK)
        return kdk_program;
#endif
#if SPH_WITH_LEAP_FROG
    if (integrator == SPH_LEAP_FROG)
        return leap_program;
#endif
#if SPH_HAS_RUNGE_KUTTA
    if (integrator == SPH_RUNGE_KUTTA || integrator == SPH_RUNGE_KUTTA_MOMENTUM)
        return rk_program;
#endif
    return prime_program; /* not reached: sph_config_check refuses integrators that are not in */
}
