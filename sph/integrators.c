/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* integrators.c: the integrators as lists of passes, and the local passes: what is done to each particle before and
   after the sums. run.c runs the lists. To add an integrator: its list, its stages, and a row in the table at the
   end.

   A step goes from buffer cur into another; nothing that the next step would read changes before run.c commits. */
#include "integrators.h"

#include "kick.h"
#include "locals.h"
#include "motion.h"
#include "passes.h"
#include "runge_kutta.h"
#include "arithmetic.h"

SPH_OBJECT(integrators)

/* ---- what stages do at their sorts ---- */

/* What the sorts do: drift, bend, kick, rate; at; damps, reflects, resumes, middle, keeps. Kick-drift-kick and
   leap-frog take fields to the middle of the step by the rates of the last middle: to second order there, enough for
   rates that depend on them. Leap-frog's kick and bend follow from the last step (move.c); before first forces it falls
   back. */
static const sph_stage stays = {0, 0, 0, 0, 0, false, true, false, false, false};
static const sph_stage begins = {0, 0, 0, 0, 1, false, true, false, false, false};
static const sph_stage falls_back = {0, 0, 0, 0, 1, false, true, true, false, false};
/* Gray 2001 eqs 2.26, 2.27, 2.29 */
static const sph_stage predicts = {1, 0.5, 1, 1, 1, true, true, false, false, false};
static const sph_stage kicks_and_drifts = {1, 0.5, 0.5, 0.5, 1, true, true, false, true, false};
static const sph_stage leaps = {1, 0, 0, 0.5, 1, false, true, true, true, false};
static const sph_stage looks = {0, 0, 0, 0, 0, false, true, false, false, true};
/* Wickramarachchi 3.85, mean of 3.91 */
static const sph_stage half_way = {0.5, 0, 0.5, 0.5, 0.5, false, false, false, false, false};

/* ---- stages: passes that only say where the next sort goes ---- */

static uint32_t spare(const sph_sim *sim, uint32_t a, uint32_t b)
{
    for (uint32_t k = 0; k < sim->buffers; k++)
        if (k != a && k != b)
            return k;
    return 0;
}

/* groups go to where they are when a share of the step has gone; at its beginning they are there */
static sph_status go_to(sph_sim *sim, sph_real share)
{
    if (!SPH_HAS_GROUPS && !SPH_WITH_BODY_FORCE)
        return SPH_OK;
    sim->moment = share < 1 ? sim->now.time + (double)share * sim->dt : sim->next.time;
    return SPH_HAS_GROUPS ? sph_move_groups(sim, sim->moment, share > 0) : SPH_OK;
}
/* only their accelerations are those of that time */
static sph_status look_at(sph_sim *sim, double t) { return SPH_HAS_GROUPS ? sph_move_groups(sim, t, false) : SPH_OK; }

/* before a step */
sph_status sph_prepare(sph_sim *sim, const sph_integrator *g)
{
    if (SPH_WITH_FLOW)
        sim->newcomers = 0;
    const sph_status st = go_to(sim, g->first->at);
    return st || !SPH_HAS_RATES_FIRST || !g->first->middle ? st : look_at(sim, sim->now.time + 0.5 * sim->dt);
}

static sph_status begin(sph_sim *sim)
{
    const sph_stage *first = sim->integrator->first;
    if (first == &begins && SPH_IS(sim->cfg.integrator, LEAP_FROG))
        first = &falls_back;
    sph_begin_sort(sim, sim->cur, spare(sim, sim->cur, sim->cur), sim->now.count + sph_newcomers(sim), sim->table_valid,
                   first);
    return SPH_OK;
}
static const sph_pass pass_begin = {"begin", NULL, NULL, begin, NULL};

static sph_status begin_second(sph_sim *sim)
{
    sph_begin_sort(sim, sim->dst, spare(sim, sim->cur, sim->dst), sim->next.count, true, sim->integrator->second);
    return go_to(sim, sim->stage->at);
}
static const sph_pass pass_begin_second = {"begin second stage", NULL, NULL, begin_second, NULL};

/* Runge-Kutta: walls go on to the step's end */
static sph_status end_second(sph_sim *sim) { return go_to(sim, 1); }
static const sph_pass pass_end_second = {"end second stage", NULL, NULL, end_second, NULL};

/* Runge-Kutta: where particles are at the end, for the density there */
static sph_status begin_look(sph_sim *sim)
{
    sph_begin_sort(sim, sim->dst, spare(sim, sim->cur, sim->dst), sim->next.count, true, &looks);
    return SPH_OK;
}
static const sph_pass pass_begin_look = {"begin look", NULL, NULL, begin_look, NULL};

/* ---- what modules do to particles, where nothing is summed ---- */

/* wherever fields have advanced: back to where laws keep them */
static void restrain(const sph_sim *sim, sph_span s, bool whole)
{
    if (SPH_HAS_YIELD)
        sph_yield(sim, s, whole);
}
/* wherever fields were taken from src, to be those of so much later: what laws make grow */
static void grow(const sph_sim *sim, sph_span s, sph_real share)
{
    restrain(sim, s, true);
    if (SPH_HAS_DAMAGE)
        sph_grow_damage(sim, s, share * (sph_real)sim->dt);
}

/* when all of a particle has advanced, at a step's end */
static void finish(sph_sim *sim, uint32_t chunk, sph_span s, sph_thread *t)
{
    double *const books = SPH_WITH_BOOKS ? sph_open_books(sim, chunk) : NULL;
    (void)chunk;
    if (SPH_HAS_DAMAGE)
        sph_book_damage(sim, s, books);
    if (SPH_WITH_FLOW)
        sph_hold_flows(sim, s);
    sph_settle(sim, s);
    if (SPH_HAS_WALLS)
        sph_cross_walls(sim, s, t, books);
    sph_check(sim, s, t);
    if (SPH_WITH_FLOW)
        sph_let_out(sim, s, t);
    if (SPH_WITH_BOOKS)
        sph_sum_powers(sim, s, books);
    t->work += s.last - s.first;
}
static sph_status finished(sph_sim *sim) { return SPH_WITH_BOOKS ? sph_add_powers(sim) : SPH_OK; }

/* ---- local passes ---- */

/* after every sort: all fields that the sort did not move */
static void carry_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    sph_carry_fields(sim, s);
    if (!sph_keeps_fields(sim))
        grow(sim, s, sim->stage->rate);
    t->work += s.last - s.first;
}
static bool carries(const sph_sim *sim)
{
    return sph_keeps_fields(sim) || sph_has_ways(&sim->cfg, SPH_CARRIED_WAYS) ||
           (sph_in_middle(sim) && sph_drifts(&sim->cfg));
}
static const sph_pass pass_carry = {"carry", sph_local_chunks, carry_chunk, NULL, carries};

/* predictor-corrector */
static void correct_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    sph_correct_fields(sim, s);
    restrain(sim, s, false);
    sph_correct(sim, s);
    sph_mend_drift(sim, s, t);
    finish(sim, chunk, s, t);
}
static const sph_pass pass_correct = {"correct", sph_local_chunks, correct_chunk, finished, NULL};

/* kick-drift-kick and leap-frog: what evolves goes a whole step, before the forces */
static void density_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    sph_to_the_end(sim, s);
    if (SPH_WITH_FLOW)
        sph_hold_flows(sim, s);
    sph_retake_fields(sim, s);
    grow(sim, s, 1);
    t->work += s.last - s.first;
}
static sph_status at_the_end(sph_sim *sim)
{
    sim->middle = false;
    return look_at(sim, sim->moment);
}
static const sph_pass pass_density = {"density", sph_local_chunks, density_chunk, at_the_end, NULL};

/* kick-drift-kick: the second kick */
static void kick_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    sph_kick(sim, s, 1);
    sph_mend_drift(sim, s, t);
    finish(sim, chunk, s, t);
}
static const sph_pass pass_kick = {"kick", sph_local_chunks, kick_chunk, finished, NULL};

/* leap-frog */
static void velocity_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    sph_kick(sim, s, 2);
    sph_mend_drift(sim, s, t);
    finish(sim, chunk, s, t);
}
static const sph_pass pass_velocity = {"velocity", sph_local_chunks, velocity_chunk, finished, NULL};

/* Runge-Kutta: the end of the first stage, and of the second */
static void settle_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    sph_settle(sim, s);
    t->work += s.last - s.first;
}
static const sph_pass pass_settle = {"settle", sph_local_chunks, settle_chunk, NULL, NULL};

static void advance_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_span s = sph_chunk_span(sim, chunk);
    sph_retake_fields(sim, s);
    for (uint32_t i = s.first; i < s.last; i++)
        sph_runge_kutta(sim, i, t);
    sph_displace_again(sim, s);
    grow(sim, s, 1);
    finish(sim, chunk, s, t);
}
static const sph_pass pass_advance = {"advance", sph_local_chunks, advance_chunk, finished, NULL};

/* the end of a look */
static void look_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    settle_chunk(sim, chunk, t);
    sph_check(sim, sph_chunk_span(sim, chunk), t);
}
static const sph_pass pass_look = {"settle", sph_local_chunks, look_chunk, NULL, NULL};

/* the end of the first forces */
static void prime_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    settle_chunk(sim, chunk, t);
    if (SPH_WITH_BOOKS)
        sph_sum_powers(sim, sph_chunk_span(sim, chunk), sph_open_books(sim, chunk));
}
static sph_status primed(sph_sim *sim)
{
    if (sph_foresees(&sim->cfg)) /* nothing is known of how rates change */
        memset(sim->buf[sim->dst].rise[0], 0, sim->next.count * sizeof(sph_real));
    return SPH_WITH_BOOKS ? sph_first_powers(sim) : SPH_OK;
}
static const sph_pass pass_prime = {"settle", sph_local_chunks, prime_chunk, primed, NULL};

/* ---- the lists: what each integrator does, in order ---- */

/* a pass of a module, or null where that was left out */
#define MODULE(knob, pass) ((knob) ? &(pass) : NULL)

#define SORT                                                                                                       \
    &sph_pass_count, &sph_pass_scatter, &pass_carry, MODULE(SPH_WITH_FLOW, sph_pass_flow),                         \
        MODULE(SPH_WITH_DAMPING_RATE, sph_pass_damping)
/* what a step begins with */
#define BEGIN MODULE(SPH_WITH_FLOW, sph_pass_births), MODULE(SPH_WITH_FLOW, sph_pass_newcomers), &pass_begin
#define QUIET MODULE(SPH_WITH_DAMPER, sph_pass_damper)
#define DENSITIES                                                                                                  \
    MODULE(SPH_WITH_SHEPARD, sph_pass_shepard), MODULE(SPH_WITH_MLS, sph_pass_mls),                                \
        MODULE(SPH_WITH_SUMMATION, sph_pass_summation),                                                            \
        MODULE(SPH_HAS_FILTERS, sph_pass_copy_density)
#define FORCES                                                                                                     \
    MODULE(SPH_WITH_WALL_ADAMI, sph_pass_adami), MODULE(SPH_WITH_WALL_ADAMI, sph_pass_adami_copy),                 \
        MODULE(SPH_HAS_CORRECTION, sph_pass_correction), MODULE(SPH_HAS_FLUID_GRADIENT, sph_pass_gradient),        \
        MODULE(SPH_HAS_STABILISED, sph_pass_rows), MODULE(SPH_HAS_STABILISED, sph_pass_means),                     \
        MODULE(SPH_HAS_NORMALISED, sph_pass_normal), MODULE(SPH_HAS_HOURGLASS, sph_pass_bonds),                    \
        MODULE(SPH_WITH_ANTUONO, sph_pass_density_gradient),                                                       \
        MODULE(SPH_WITH_SHEAR, sph_pass_shear), MODULE(SPH_HAS_HAT, sph_pass_smooth),                              \
        MODULE(SPH_WITH_VARIABLE_H, sph_pass_smoothing_length), &sph_pass_force

/* A density that is summed is of where particles are: Runge-Kutta, which moves them last, sums it once more. */
#define SUMMED(pass) (SPH_WITH_SUMMATION ? (pass) : NULL)
#define SUM_AGAIN                                                                                                  \
    SUMMED(&pass_begin_look), SUMMED(&sph_pass_count), SUMMED(&sph_pass_scatter), SUMMED(&pass_carry), DENSITIES,  \
        SUMMED(&pass_look)

/* what a step ends with */
#define END(pass)                                                                                                  \
    &(pass), MODULE(SPH_WITH_DAMPER, sph_pass_damper_book), MODULE(SPH_HAS_XSPH_VELOCITY, sph_pass_evening),      \
        MODULE(SPH_WITH_DAMPING_RATE, sph_pass_damping_end), MODULE(SPH_WITH_SPONGE, sph_pass_sponge),             \
        MODULE(SPH_WITH_SHIFTING, sph_pass_shifting)

/* edges that let waves out: the stress of a matched layer before the forces; after a step, its damping and the lines
   that end there */
#define LAYER MODULE(SPH_HAS_EDGES, sph_pass_layer_stress)
#define EDGES                                                                                                      \
    MODULE(SPH_HAS_EDGES, sph_pass_layer), MODULE(SPH_HAS_EDGES, sph_pass_lines_x),                                \
        MODULE(SPH_HAS_EDGES && SPH_DIM > 1, sph_pass_lines_y),                                                    \
        MODULE(SPH_HAS_EDGES && SPH_DIM > 2, sph_pass_lines_z)

typedef const sph_pass *const list[];
#define WEIGHTS                                                                                                    \
    MODULE(SPH_HAS_QUADRATURE, sph_pass_cover), MODULE(SPH_HAS_QUADRATURE, sph_pass_quadrature),                   \
        MODULE(SPH_HAS_STABILISED, sph_pass_edge)
static list first_forces = {&pass_begin, SORT, WEIGHTS, QUIET, DENSITIES, LAYER, FORCES, &pass_prime};
static list predictor_corrector = {BEGIN, SORT, QUIET, DENSITIES, FORCES, END(pass_correct)};
static list kick_drift_kick = {BEGIN,     SORT,  FORCES, &pass_density,  QUIET,
                               DENSITIES, LAYER, FORCES, END(pass_kick), EDGES};
static list leap_frog = {BEGIN, SORT, FORCES, &pass_density, QUIET, DENSITIES, FORCES, END(pass_velocity)};
static list runge_kutta = {BEGIN,              SORT, DENSITIES, FORCES, &pass_settle,
                           &pass_begin_second, SORT, DENSITIES, FORCES, &pass_end_second, END(pass_advance),
                           SUM_AGAIN};
/* what was left out is an empty place of the list */
enum { ALL_IN = SPH_WITH_FLOW && SPH_WITH_DAMPER && SPH_WITH_DAMPING_RATE && SPH_HAS_XSPH_VELOCITY };
_Static_assert(!ALL_IN || !SPH_HAS_RUNGE_KUTTA || sizeof runge_kutta / sizeof *runge_kutta <= SPH_MAX_PROGRAM,
               "SPH_MAX_PROGRAM: too small");
enum { SUMMING = sizeof((const sph_pass *const[]){SUM_AGAIN}) / sizeof(const sph_pass *) };
#define ROOM_FOR(list, knob) _Static_assert(!(knob) || sizeof(list) / sizeof *(list) <= SPH_MAX_PROGRAM, #list)
ROOM_FOR(predictor_corrector, SPH_WITH_PREDICTOR_CORRECTOR);
ROOM_FOR(kick_drift_kick, SPH_HAS_RATES_FIRST);
ROOM_FOR(leap_frog, SPH_HAS_RATES_FIRST);
ROOM_FOR(runge_kutta, SPH_HAS_RUNGE_KUTTA);

/* ---- the table ---- */

/* left out: an empty list */
#define ROW(knob, passes, last, first, second)                                                                     \
    {MODULE(knob, (passes)[0]), (knob) ? sizeof(passes) / sizeof *(passes) : 0, last, MODULE(knob, first),         \
     MODULE(knob, second)}
static const sph_integrator integrators[SPH_NO_INTEGRATOR + 1] = {
    [SPH_PREDICTOR_CORRECTOR] = ROW(SPH_WITH_PREDICTOR_CORRECTOR, predictor_corrector, 0, predicts, stays),
    [SPH_KICK_DRIFT_KICK] = ROW(SPH_WITH_KICK_DRIFT_KICK, kick_drift_kick, 0, kicks_and_drifts, stays),
    [SPH_LEAP_FROG] = ROW(SPH_WITH_LEAP_FROG, leap_frog, 0, leaps, stays),
    [SPH_RUNGE_KUTTA] = ROW(SPH_WITH_RUNGE_KUTTA, runge_kutta, SUMMING, stays, half_way),
    [SPH_RUNGE_KUTTA_MOMENTUM] = ROW(SPH_WITH_RUNGE_KUTTA_MOMENTUM, runge_kutta, SUMMING, stays, half_way),
    [SPH_NO_INTEGRATOR] = ROW(true, first_forces, 0, begins, stays),
};

#undef ROW
const sph_integrator *sph_integrator_of(uint32_t integrator) { return &integrators[integrator]; }
