/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* step.c: the integrators as lists of passes, the time step, slices, threads, and what happens when a step fails.

   A step copies the scalars `now` to `next`, runs its passes from buffer cur into another, and commits by making `next`
   and that buffer current. Until then nothing that the next step would read has changed; failing is forgetting. */
#include "fluid.h"

SPH_INLINE double least(double a, double b) { return b < a ? b : a; }

/* ---- failures seen by threads ---- */

void sph_fail_note(sph_thread *t, sph_status s, uint32_t id, double value)
{
    if (t->fail.status == SPH_OK || id < t->fail.particle)
        t->fail = (sph_fail){s, id, value};
}

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
#define FORCES ADAMI CORRECTION SMOOTH &sph_pass_force,

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

static const sph_pass *const *program_of(uint32_t integrator)
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

/* ---- time step ---- */

static double fastest_sound(const sph_sim *sim)
{
    double c = sim->cfg.sound_speed;
    for (uint32_t s = 0; s < sim->sets; s++) {
        const sph_set *set = &sim->set[s];
        double own = set->c0;
        if (sph_is_solid(set)) /* waves along the way of their motion (Gray 2001 eq 5.52) */
            own = __builtin_sqrt(own * own + 4 * set->shear / (3 * set->rho0));
        c = own > c ? own : c;
    }
    return SPH_IS(sim->cfg.eos, TAIT_GRAY) ? c * 2.6457513110645905905 : c; /* sqrt 7 */
}

/* what each limit allows after a force sweep (Gray 2001 eq 2.30, Wickramarachchi 2009 eqs 3.88-3.90) */
static void find_limits(const sph_sim *sim, double *l)
{
    const sph_config *c = &sim->cfg;
    const double h = c->smoothing_length, c0 = fastest_sound(sim), a = (double)sim->now.peaks.acc;
    double nu = SPH_IS(c->viscosity, MORRIS) ? c->nu : sph_viscous(c->viscosity) ? c->alpha * c0 * h / (2 * (SPH_DIM + 2)) : 0, g = 0;
    for (int k = 0; k < SPH_DIM; k++)
        g += c->gravity[k] * c->gravity[k];
    g = __builtin_sqrt(g);
    memset(l, 0, SPH_LIMITS * sizeof *l);
    l[SPH_LIMIT_FIXED] = c->dt;
    if (c->dt > 0)
        return;
    l[SPH_LIMIT_COURANT] = sim->courant * h / (c0 + h * (double)sim->now.peaks.mu);
    if (nu > 0)
        l[SPH_LIMIT_VISCOUS] = c->viscous_factor * h * h / nu;
    if (a > 0)
        l[SPH_LIMIT_FORCE] = c->force_factor * __builtin_sqrt(h / a);
    l[SPH_LIMIT_GRAVITY] = g > 0 ? c->gravity_factor * h / (c0 + __builtin_sqrt(g * h)) : 0;
    l[SPH_LIMIT_CEILING] = c->dt_max;
}

static sph_status choose_dt(sph_sim *sim, double t_end)
{
    double dt = 1e300;
    find_limits(sim, sim->limit_dt);
    for (uint32_t k = 0; k < SPH_LIMITS; k++)
        if (sim->limit_dt[k] > 0 && sim->limit_dt[k] < dt) {
            dt = sim->limit_dt[k];
            sim->limit = k;
        }
    if (!(dt > 0) || dt < sim->cfg.dt_min || sim->now.time + dt == sim->now.time)
        return sph_error(sim, SPH_STEP_COLLAPSED, sph_limit_text(sim->limit), "a step above dt_min", dt,
                         SPH_NO_PARTICLE);
    if (t_end - sim->now.time <= dt * (1 + 1e-9)) {
        dt = t_end - sim->now.time;
        sim->limit = SPH_LIMIT_TARGET;
        sim->next.time = t_end;
    } else {
        sim->next.time = sim->now.time + dt;
    }
    sim->dt = dt;
    return SPH_OK;
}

/* ---- running a program ---- */

static uint32_t thread_count(const sph_sim *sim)
{
    uint32_t t = sim->cfg.port.parallel ? sim->cfg.port.threads : 1;
    return t < 1 ? 1 : t > sim->cfg.max_threads ? sim->cfg.max_threads : t;
}

static void clear_threads(sph_sim *sim)
{
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        sph_thread *s = &sim->thread[t];
        s->work = s->pairs = 0;
        s->peaks = (sph_peaks){0, 0, 0};
        s->fail = (sph_fail){SPH_OK, SPH_NO_PARTICLE, 0};
        s->crossed = s->put_back = s->reflected = s->left = s->removed = s->widest = 0;
    }
}

static sph_status load_program(sph_sim *sim, const sph_pass *const *p)
{
    sim->passes = 0;
    for (; *p; p++)
        sim->program[sim->passes++] = *p;
    sim->pc = sim->chunk = sim->chunks = 0;
    sim->work = sim->pairs = 0;
    sim->begun = true;
    clear_threads(sim);
    return SPH_OK;
}

static sph_status move_groups(sph_sim *sim, double t)
{
#if SPH_HAS_GROUPS
    return sph_move_groups(sim, t);
#else
    (void)sim, (void)t;
    return SPH_OK;
#endif
}

/* begins the computation of the first forces; chunk_cells: how finely its sweeps and sorts can be sliced */
static sph_status begin_prime(sph_sim *sim, uint32_t chunk_cells)
{
    sim->chunk_cells = chunk_cells;
    if (sim->now.count == 0)
        return sph_error(sim, SPH_BAD_STATE, "step", "after particles were added", 0, SPH_NO_PARTICLE);
    sim->next = sim->now;
    sim->dt = 0;
    sph_status st = move_groups(sim, sim->now.time);
    return st ? st : load_program(sim, prime_program);
}

static sph_status begin_step(sph_sim *sim, uint32_t chunk_cells)
{
    sim->chunk_cells = chunk_cells;
    sim->next = sim->now;
    sph_status st = choose_dt(sim, sim->t_end);
    if (st)
        return st;
    sim->next.step++;
    sim->next.dt_last = sim->dt;
    if ((st = move_groups(sim, sim->next.time)) != SPH_OK)
        return st;
    return load_program(sim, program_of(sim->cfg.integrator));
}

typedef struct job {
    sph_sim *sim;
    uint32_t first;
} job;
static void run_job(void *arg, uint32_t chunk, uint32_t thread)
{
    const job *j = arg;
    j->sim->program[j->sim->pc]->run(j->sim, j->first + chunk, &j->sim->thread[thread]);
}

/* runs chunks [chunk, chunk + n) of the current pass */
static void run_chunks(sph_sim *sim, uint32_t n)
{
    job j = {sim, sim->chunk};
    if (n > 1 && thread_count(sim) > 1)
        sim->cfg.port.parallel(sim->cfg.port.ctx, run_job, &j, n);
    else
        for (uint32_t c = 0; c < n; c++)
            run_job(&j, c, 0);
    sim->chunk += n;
}

/* adds up what the threads saw in a pass and starts them afresh; none of it depends on order */
static sph_fail gather_threads(sph_sim *sim)
{
    sph_fail fail = {SPH_OK, SPH_NO_PARTICLE, 0};
    sph_peaks peaks = {0, 0, 0};
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++) {
        const sph_thread *s = &sim->thread[t];
        sim->work += s->work;
        sim->pairs += s->pairs;
        peaks.mu = s->peaks.mu > peaks.mu ? s->peaks.mu : peaks.mu;
        peaks.acc = s->peaks.acc > peaks.acc ? s->peaks.acc : peaks.acc;
        peaks.speed = s->peaks.speed > peaks.speed ? s->peaks.speed : peaks.speed;
        if (s->fail.status && (!fail.status || s->fail.particle < fail.particle))
            fail = s->fail;
        sim->next.crossed += s->crossed;
        sim->next.put_back += s->put_back;
        sim->next.reflected += s->reflected;
        sim->next.left += s->left + s->removed;
        sim->mark_cell = s->widest > sim->mark_cell ? s->widest : sim->mark_cell;
    }
    if (sim->program[sim->pc] == &sph_pass_force)
        sim->next.peaks = peaks;
    clear_threads(sim);
    return fail;
}

static const char *fail_quantity(sph_status s)
{
    switch (s) {
    case SPH_NOT_FINITE: return "a rate or a squared magnitude";
    case SPH_DENSITY_LOST: return "relative density excess";
    case SPH_OUT_OF_DOMAIN: return "x from the domain's low corner (m)";
    case SPH_MOVED_TOO_FAR: return "cells moved in one step";
    case SPH_WALL_CROSSED: return "depth inside the wall (m)";
    case SPH_BOND_TOO_LONG: return "length of a bond (m)";
    default: return "";
    }
}

static sph_status end_pass(sph_sim *sim)
{
    const sph_pass *p = sim->program[sim->pc];
    sph_fail fail = gather_threads(sim);
    if (fail.status)
        return sph_error(sim, fail.status, fail_quantity(fail.status), "", fail.value, fail.particle);
    sph_status st = p->end ? p->end(sim) : SPH_OK;
    if (st)
        return st;
#if SPH_WITH_STAGE_LOG
    if (sim->cfg.stage_log)
        sim->cfg.stage_log(sim->cfg.stage_ctx, sim->next.step, p->name,
                           sph_hash_buffer(sim, &sim->buf[sim->dst], sim->next.count));
#endif
    sim->pc++;
    sim->chunk = sim->chunks = 0;
    return SPH_OK;
}

/* mass of the fluid that buffer b has, set by set; the dead have none */
static double fluid_mass(const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    double mass = 0;
    for (uint32_t s = 0; s < sim->sets; s++) {
        uint32_t count = 0;
        if (!sph_is_body(&sim->set[s]))
            continue;
        for (uint32_t i = 0; i < n; i++)
            count += b->set[0][i] == s;
        mass += count * sim->set[s].mass;
    }
    return mass;
}

static void commit(sph_sim *sim)
{
    const bool prime = sim->next.step == sim->now.step;
    if (sim->next.left != sim->now.left)
        sim->next.removed_mass += fluid_mass(sim, &sim->buf[sim->cur], sim->now.count) -
                                  fluid_mass(sim, &sim->buf[sim->dst], sim->next.count);
    sim->next.primed = true;
    sim->next.started |= !prime;
    sim->now = sim->next;
    sim->cur = sim->dst;
    sim->table_valid = true;
    sim->begun = false;
    if (!prime) {
        sim->last_passes = sim->passes;
        sim->last_work = sim->work;
        sim->last_pairs = sim->pairs;
        sim->last_limit = sim->limit;
        sim->last_dt = sim->dt;
        sim->mark_work = sim->work > sim->mark_work ? sim->work : sim->mark_work;
    }
}

/* work units of the pass under way */
static uint64_t pass_work(const sph_sim *sim)
{
    uint64_t w = 0;
    for (uint32_t t = 0; t < sim->cfg.max_threads; t++)
        w += sim->thread[t].work;
    return w;
}

/* the chunks of the current pass that are left, or as many as the budget takes; adds to *spent */
static sph_status run_pass(sph_sim *sim, uint64_t budget, uint64_t *spent)
{
    const sph_pass *p = sim->program[sim->pc];
    if (p->wanted && !p->wanted(sim)) {
        sim->pc++;
        return SPH_OK;
    }
    if (sim->chunk == 0)
        sim->chunks = p->chunks ? p->chunks(sim) : 0;
    while (sim->chunk < sim->chunks) {
        uint32_t n = sim->chunks - sim->chunk;
        if (budget) {
            if (*spent >= budget)
                return SPH_NOT_DONE;
            n = n < thread_count(sim) ? n : thread_count(sim);
        }
        const uint64_t before = pass_work(sim);
        run_chunks(sim, n);
        *spent += pass_work(sim) - before;
    }
    sph_status st = end_pass(sim);
    if (st)
        sim->begun = false; /* a failed step is forgotten: cur, now and the buffer cur were never written */
    return st;
}

/* Runs the program until its end (budget 0) or until about `budget` units are spent. */
static sph_status run_program(sph_sim *sim, uint64_t budget)
{
    uint64_t spent = 0;
    sph_status st = SPH_OK;
    while (!st && sim->pc < sim->passes)
        st = run_pass(sim, budget, &spent);
    if (budget && spent > sim->mark_slice)
        sim->mark_slice = spent;
    if (!st)
        commit(sim);
    return st;
}

/* ---- entry points ---- */

sph_status sph_ready(sph_sim *sim)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "sph_ready", "between steps", 0, SPH_NO_PARTICLE);
    if (sim->now.primed)
        return SPH_OK;
    sph_status st = begin_prime(sim, SPH_SWEEP_CHUNK);
    return st ? st : run_program(sim, 0);
}

static sph_status advance(sph_sim *sim, double t_end, uint64_t budget)
{
    sph_status st = SPH_OK;
    if (!sim->begun) {
        const uint32_t cells = budget ? SPH_SLICE_CHUNK : SPH_SWEEP_CHUNK;
        sim->t_end = t_end;
        st = sim->now.primed ? begin_step(sim, cells) : begin_prime(sim, cells);
        if (st)
            return st;
    }
    return run_program(sim, budget);
}

sph_status sph_step_to(sph_sim *sim, double t_end)
{
    if (!sim)
        return SPH_BAD_ARGUMENT;
    if (sim->begun)
        return sph_error(sim, SPH_BAD_STATE, "sph_step", "after the step begun in slices", 0, SPH_NO_PARTICLE);
    if (!(t_end > sim->now.time))
        return sph_error(sim, SPH_BAD_ARGUMENT, "t_end", "after the present time", t_end, SPH_NO_PARTICLE);
    sph_status st = sph_ready(sim);
    return st ? st : advance(sim, t_end, 0);
}

sph_status sph_step(sph_sim *sim) { return sph_step_to(sim, 1e300); }

sph_status sph_step_slice(sph_sim *sim, uint64_t budget)
{
    if (!sim || budget == 0)
        return sph_error(sim, SPH_BAD_ARGUMENT, "budget", "> 0", 0, SPH_NO_PARTICLE);
    const uint64_t step = sim->now.step;
    sph_status st = advance(sim, 1e300, budget);
    /* preparing the first forces is not a step: there is one to come */
    return st == SPH_OK && sim->now.step == step ? SPH_NOT_DONE : st;
}

void sph_step_cancel(sph_sim *sim)
{
    if (sim)
        sim->begun = false;
}

double sph_time(const sph_sim *sim) { return sim ? sim->now.time : 0; }

void sph_get_step(const sph_sim *sim, sph_step_info *out)
{
    if (!sim || !out)
        return;
    memset(out, 0, sizeof *out);
    out->step = sim->now.step;
    out->time = sim->now.time;
    out->dt = sim->last_dt;
    out->limit = sim->last_limit;
    find_limits(sim, out->limit_dt);
    out->pairs = sim->last_pairs;
    out->work = sim->last_work;
    out->passes = sim->last_passes;
    out->left = sim->now.left;
    out->crossed = sim->now.crossed;
    out->put_back = sim->now.put_back;
    out->reflected = sim->now.reflected;
}
