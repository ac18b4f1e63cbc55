/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_lists.c: a state field is a line of a list. The kernel is compiled once more with the fields of extra_fields.h
   and the column set of lists_columns.h, and they do what the list says of them, in every integrator: nothing else in
   the kernel names them. */
#include "testing.h"

#include "sph/pair.h"
#include "state.h"

#define N (SPH_DIM == 3 ? 8 : 10)
#define DX 0.1
enum { MOST = 4000 };

/* ---- a block that drifts through periodic faces between cells, its rates given after every force sweep ---- */

static struct {
    sph_sim *sim;
    double decay; /* 1/s; 0: constant rates */
    bool poisoned;
} given;

static sph_real number_of(uint32_t id, uint32_t k) { return (sph_real)(1 + id % 7 + 0.25 * k); }

/* rate of a value of particle id: constant, or -decay value: fields stand where the rates are asked for, in the step's
   middle too */
static sph_real rate_of(sph_real value, uint32_t id, uint32_t k)
{
    return given.decay > 0 ? -(sph_real)given.decay * value : number_of(id, k);
}

static void give_rates(void *ctx, uint64_t step, const char *pass, uint64_t hash)
{
    const sph_sim *sim = given.sim;
    const sph_buffer *b = &sim->buf[sim->dst];
    (void)ctx, (void)step, (void)hash;
    for (uint32_t i = 0; strcmp(pass, "carry") == 0 && i < sim->next.count; i++) {
        close_to((double)b->rate[0][i], 0, 0); /* zero after every sort, whatever was written before */
        close_to((double)b->rates[SPH_DIM - 1][i], 0, 0);
    }
    for (uint32_t i = 0; strcmp(pass, "force") == 0 && i < sim->next.count; i++) {
        const uint32_t id = sph_source_id(sim, i);
        b->rate[0][i] = b->rates[SPH_DIM - 1][i] = 7;
        b->dheat[0][i] = rate_of(b->heat[0][i], id, 0);
        for (uint32_t k = 0; k < SPH_DIM; k++)
            b->dcolours[k][i] = rate_of(b->colours[k][i], id, k);
    }
}

static void shake(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)v, (void)t;
    a[0] += given.poisoned ? NAN : sph_cos(20 * x[0]);
}

/* what the fields begin with */
static void fill(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = 0; i < sim->now.count; i++) {
        const uint32_t id = b->id[0][i];
        b->tag[0][i] = number_of(id, 9);
        b->label[0][i] = 3000000000u + id;
        b->letter[0][i] = (uint8_t)('A' + id % 26);
        b->share[0][i] = (sph_real)(id % 2);
        b->heat[0][i] = given.decay > 0 ? 1 : 0;
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            b->tags[k][i] = number_of(id, k);
            b->colours[k][i] = given.decay > 0 ? number_of(id, k) : 0;
        }
    }
}

static sph_config config_of(uint32_t integrator, double dt)
{
    sph_config c = periodic_config(N * DX, DX);
    c.max_particles = MOST;
    c.integrator = integrator;
    c.dt = dt;
    c.body_force = shake;
    c.stage_log = give_rates;
    return c;
}

static const double speed[3] = {2, -1.5, 1};

static sph_sim *new_block(const sph_config *c)
{
    sph_sim *sim = new_sim(c);
    const sph_fluid water = {0};
    uint32_t set;
    const double lo[3] = {0, 0, 0}, hi[3] = {N * DX, N * DX, N * DX};
    must(sim, sph_add_fluid(sim, &water, &set));
    must(sim, sph_add_box(sim, set, lo, hi, speed));
    given.sim = sim;
    fill(sim);
    return sim;
}

static sph_sim *run_block(uint32_t integrator, double dt, uint32_t steps)
{
    const sph_config c = config_of(integrator, dt);
    sph_sim *sim = new_block(&c);
    for (uint32_t k = 0; k < steps; k++)
        must(sim, sph_step(sim));
    return sim;
}

/* ---- the tests ---- */

static void carried_fields_go_with_their_particle(void **state)
{
    (void)state;
    for (uint32_t g = 0; g < SPH_INTEGRATORS; g++) {
        const sph_sim *sim = run_block(g, 1e-3, 60);
        const sph_buffer *b = &sim->buf[sim->cur];
        uint32_t moved = 0;
        for (uint32_t i = 0; i < sim->now.count; i++) {
            const uint32_t id = b->id[0][i];
            moved += id != i;
            close_to((double)b->tag[0][i], (double)number_of(id, 9), 0);
            assert_int_equal(b->label[0][i], 3000000000u + id);
            assert_int_equal(b->letter[0][i], 'A' + id % 26);
            for (uint32_t k = 0; k < SPH_DIM; k++)
                close_to((double)b->tags[k][i], (double)number_of(id, k), 0);
            assert_null(b->absent[0]);
        }
        assert_true(moved > sim->now.count / 4); /* the order did change */
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void displaced_fields_gain_the_way_through_periodic_faces(void **state)
{
    (void)state;
    for (uint32_t g = 0; g < SPH_INTEGRATORS; g++) {
        const sph_config c = config_of(g, 1e-3);
        sph_sim *sim = new_block(&c);
        static sph_pos start[MOST][SPH_DIM];
        for (uint32_t i = 0; i < sim->now.count; i++)
            for (uint32_t k = 0; k < SPH_DIM; k++)
                start[sim->buf[sim->cur].id[0][i]][k] = sim->buf[sim->cur].pos[k][i];
        for (uint32_t k = 0; k < 100; k++)
            must(sim, sph_step(sim));
        const sph_buffer *b = &sim->buf[sim->cur];
        uint32_t round = 0;
        for (uint32_t i = 0; i < sim->now.count; i++) {
            assert_true(b->way_x[0][i] == b->way[0][i]);
            for (uint32_t k = 0; k < SPH_DIM; k++) {
                const sph_pos whole = sim->grid.extent[k], end = start[b->id[0][i]][k] + b->way[k][i];
                round += end >= whole || end < 0;
                close_to((double)b->way[k][i] * sim->grid.quantum, speed[k] * sim->now.time, 0.25 * N * DX);
                assert_true(b->pos[k][i] == (end >= whole ? end - whole : end < 0 ? end + whole : end));
            }
        }
        assert_true(round > 0);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void a_constant_rate_gives_rate_times_time(void **state)
{
    (void)state;
    given.decay = 0;
    for (uint32_t g = 0; g < SPH_INTEGRATORS; g++) {
        const sph_sim *sim = run_block(g, 1e-3, 50);
        const sph_buffer *b = &sim->buf[sim->cur];
        for (uint32_t i = 0; i < sim->now.count; i++) {
            const uint32_t id = b->id[0][i];
            close_to((double)b->heat[0][i], sim->now.time * (double)number_of(id, 0), 50 * EPS);
            for (uint32_t k = 0; k < SPH_DIM; k++)
                close_to((double)b->colours[k][i], sim->now.time * (double)number_of(id, k), 50 * EPS);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* relative error of a decay over a tenth of a second */
static double decay_error(uint32_t integrator, uint32_t steps)
{
    const sph_sim *sim = run_block(integrator, 0.1 / steps, steps);
    const sph_buffer *b = &sim->buf[sim->cur];
    const double want = sph_exp(-given.decay * sim->now.time);
    double worst = 0;
    for (uint32_t i = 0; i < sim->now.count; i++)
        for (uint32_t k = 0; k < SPH_DIM; k++) {
            const double e = fabs((double)b->colours[k][i] / (double)number_of(b->id[0][i], k) / want - 1);
            worst = e > worst ? e : worst;
        }
    assert_int_equal(free_sims(NULL), 0);
    return worst;
}

static void a_decay_is_followed_to_second_order(void **state)
{
    (void)state;
    given.decay = 20;
    for (uint32_t g = 0; g < SPH_INTEGRATORS; g++) {
        const double coarse = decay_error(g, 50), fine = decay_error(g, 100);
        if (!(coarse / fine > 3.5 && coarse / fine < 5 && fine < 2e-3))
            fail_msg("integrator %u: errors %g and %g", g, coarse, fine);
    }
    given.decay = 0;
}

static void walls_have_no_rates(void **state)
{
    (void)state;
    sph_config c = config_of(SPH_PREDICTOR_CORRECTOR, 1e-4);
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = -1;
        c.hi[k] = 2;
        c.face[k][0] = c.face[k][1] = SPH_OPEN;
    }
    c.stage_log = NULL;
    sph_sim *sim = new_block(&c);
    sph_wall wall = sph_wall_default();
    const double lo[3] = {0, 0, 0}, hi[3] = {N * DX, N * DX, N * DX};
    wall.kind = SPH_WALL_ADAMI;
    must(sim, sph_add_wall_box(sim, &wall, lo, hi, (1u << 2 * SPH_DIM) - 1, true, NULL));
    const sph_buffer *b = &sim->buf[sim->cur];
    for (uint32_t i = 0; i < sim->now.count; i++)
        b->sum[0][i] = b->dheat[0][i] = 5;
    for (int k = 0; k < 3; k++)
        must(sim, sph_step(sim));
    b = &sim->buf[sim->cur];
    for (uint32_t i = 0; i < sim->now.count; i++)
        if (!sph_is_matter(&sim->set[b->set[0][i]])) {
            close_to((double)b->sum[0][i], 0, 0);
            close_to((double)b->dheat[0][i], 0, 0);
            assert_true(b->heat[0][i] < (sph_real)1e-2);
        }
}

static void every_field_is_part_of_the_hash(void **state)
{
    (void)state;
    const sph_sim *sim = run_block(SPH_LEAP_FROG, 1e-3, 3);
    const uint64_t before = sph_hash(sim);
    for (uint32_t f = 0; f < SPH_FIELD_COUNT; f++)
        for (uint32_t k = 0; k < sph_fields[f].comps; k++) {
            unsigned char *p = sph_array(&sim->buf[sim->cur], sph_fields[f].at + k);
            if (!p)
                continue;
            p[0] ^= 1;
            assert_true(sph_hash(sim) != before);
            p[0] ^= 1;
        }
    assert_true(sph_hash(sim) == before);
}

typedef struct bytes {
    unsigned char *at;
    size_t n, read, room;
} bytes;
static bool keep(void *ctx, const void *p, size_t n)
{
    bytes *s = ctx;
    if (n > s->room - s->n)
        return false;
    memcpy(s->at + s->n, p, n);
    s->n += n;
    return true;
}
static bool play(void *ctx, void *p, size_t n)
{
    bytes *s = ctx;
    if (n > s->n - s->read)
        return false;
    memcpy(p, s->at + s->read, n);
    s->read += n;
    return true;
}

static void a_dump_holds_every_field_and_goes_on_with_the_same_bits(void **state)
{
    (void)state;
    for (uint32_t g = 0; g < SPH_INTEGRATORS; g++) {
        sph_sim *sim = run_block(g, 1e-3, 10);
        bytes dump = {malloc(1 << 22), 0, 0, 1 << 22};
        assert_non_null(dump.at);
        assert_int_equal(sph_dump(sim, SPH_DUMP_FULL, keep, &dump), SPH_OK);
        for (int k = 0; k < 5; k++)
            must(sim, sph_step(sim));
        const uint64_t want = sph_hash(sim);
        const sph_config c = config_of(g, 1e-3);
        sph_sim *other = new_block(&c);
        must(other, sph_restore(other, play, &dump));
        for (int k = 0; k < 5; k++)
            must(other, sph_step(other));
        assert_true(sph_hash(other) == want);
        free(dump.at);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void a_failed_step_leaves_every_field_as_it_was(void **state)
{
    (void)state;
    for (uint32_t g = 0; g < SPH_INTEGRATORS; g++) {
        sph_sim *sim = run_block(g, 1e-3, 5);
        snapshot before;
        keep_state(sim, &before);
        given.poisoned = true;
        assert_int_equal(sph_step(sim), SPH_NOT_FINITE);
        given.poisoned = false;
        assert_true(state_kept(sim, &before));
        must(sim, sph_step(sim));
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void a_value_out_of_its_range_fails_the_step_and_names_the_particle(void **state)
{
    (void)state;
    for (uint32_t turn = 0; turn < 4; turn++) {
        sph_sim *sim = run_block(SPH_PREDICTOR_CORRECTOR, 1e-3, 5);
        const sph_buffer *b = &sim->buf[sim->cur];
        sph_real *const place[] = {&b->heat[0][9], &b->tags[SPH_DIM - 1][9], &b->share[0][9], &b->share[0][9]};
        *place[turn] = turn < 2 ? (sph_real)INFINITY : turn == 2 ? (sph_real)1.5 : (sph_real)-0.5;
        const uint32_t id = b->id[0][9];
        assert_int_equal(sph_step(sim), SPH_NOT_FINITE);
        assert_int_equal(sph_last(sim)->particle, id);
        assert_string_equal(sph_last(sim)->pass, "correct");
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void the_arena_names_every_field(void **state)
{
    (void)state;
    const sph_config c = config_of(SPH_PREDICTOR_CORRECTOR, 1e-3);
    const sph_sim *sim = new_block(&c);
    for (uint32_t f = 0; f < SPH_FIELD_COUNT; f++)
        assert_true(strlen(sph_field_name(&sph_fields[f])) > 1);
    assert_true(strcmp(sph_field_name(&sph_fields[SPH_FIELD_NUMBER_dheat]), "dheat") == 0);
    assert_true(sph_arena_bytes(&c) <= sim->arena_bytes);
}

/* ---- a column: place and velocity along x once more, through the list of column sets ---- */

void SPH_NAME(load_spare_)(const sph_candidates *r, sph_real *to, uint32_t row);
void SPH_NAME(load_spare_)(const sph_candidates *r, sph_real *to, uint32_t row)
{
    for (uint32_t j = 0; j < r->n; j += SPH_W) {
        v_store(to + j, sph_seen_place(r, 0, v_load_int(r->b->pos[0] + r->first + j)));
        v_store(to + row + j, sph_seen_vector(r, 0, v_load(r->b->vel[0] + r->first + j)));
    }
}

static struct {
    uint32_t candidates, homes, neighbours;
} seen;

static bool any_home(const sph_sim *sim, const sph_set *set)
{
    (void)sim, (void)set;
    return true;
}
#if SPH_SIFTS
/* the neighbours of a home are those candidates within the kernel's reach, in their order, and their columns come with
   them; `own`: the column that says x of all candidates */
static void look_at_neighbours(const sph_sim *sim, sph_thread *t, uint32_t h, const sph_real *own)
{
    const sph_near_tile *const near = sph_near_of(t, &t->matter);
    const sph_real *const with = sph_near_columns_of(sim, t, SPH_COLUMN_spare);
    const uint32_t found = sph_find_neighbours(sim, t, &t->matter, h);
    uint32_t within = 0, j = 0;
    for (uint32_t from = 0; from < found; from += SPH_NEAR_ROOM) {
        const uint32_t n = sph_take_neighbours(sim, t, &t->matter, from, found);
        assert_int_equal(n % SPH_LANES, 0);
        for (uint32_t i = 0; i < n; i++) {
            sph_real d[SPH_DIM], r2 = 0;
            for (int k = 0; k < SPH_DIM; k++) {
                d[k] = t->home.x[k][h] - near->x[k][i];
                r2 += d[k] * d[k];
            }
            if (near->m[i] == 0) { /* fills up lanes */
                assert_true(r2 > sim->fac.reach2);
                continue;
            }
            within++;
            assert_true(r2 < sim->fac.reach2);
            close_to((double)with[i], (double)near->x[0][i], 0);
            close_to((double)with[SPH_NEAR_ROOM + i], (double)near->v[0][i], 0);
            while (j < t->matter.n && own[j] != near->x[0][i]) /* they come in order */
                j++;
            assert_true(j < t->matter.n);
        }
    }
    assert_true(found - within < SPH_LANES);
    seen.neighbours += within;
}
#endif
static void look_at_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    const sph_real *own = sph_columns_of(sim, t, SPH_COLUMN_spare);
    const sph_real *home = sph_home_columns_of(sim, t, SPH_COLUMN_spare);
    assert_int_equal(role, SPH_ROLE_FLUID);
    for (uint32_t j = 0; j < t->matter.n + SPH_LANES; j++) {
        const bool is = j < t->matter.n; /* behind the last there is nothing, and that is finite */
        if (!SPH_SIFTS)
            close_to((double)own[j], is ? (double)t->matter.x[0][j] : 0, 0);
        close_to((double)own[SPH_TILE_ROOM + j], is ? (double)t->matter.v[0][j] : 0, 0);
    }
    for (uint32_t h = 0; h < homes; h++) {
        close_to((double)home[h], (double)t->home.x[0][h], 0);
        close_to((double)home[SPH_HOME_ROOM + h], (double)t->home.v[0][h], 0);
    }
#if SPH_SIFTS
    for (uint32_t h = 0; h < homes; h++)
        look_at_neighbours(sim, t, h, own);
#endif
    seen.candidates += t->matter.n;
}
static void count_home(sph_sim *sim, sph_thread *t, uint32_t h)
{
    (void)sim, (void)t, (void)h;
    seen.homes++;
}

/* of all particles with all, and with themselves */
static uint32_t pairs_within_reach(const sph_sim *sim)
{
    const sph_buffer *b = &sim->buf[sim->cur];
    uint32_t pairs = 0;
    for (uint32_t i = 0; i < sim->now.count; i++)
        for (uint32_t j = 0; j < sim->now.count; j++) {
            double r2 = 0;
            for (int k = 0; k < SPH_DIM; k++) {
                double d = (double)(b->pos[k][i] - b->pos[k][j]) * sim->grid.quantum;
                if (sim->cfg.face[k][0] == SPH_PERIODIC)
                    d -= sim->grid.length[k] * floor(d / sim->grid.length[k] + 0.5);
                r2 += d * d;
            }
            pairs += r2 < (double)sim->fac.reach2;
        }
    return pairs;
}

static void a_column_set_is_a_line_and_its_loader(void **state)
{
    (void)state;
    sph_sim *sim = run_block(SPH_PREDICTOR_CORRECTOR, 1e-3, 20);
    const sph_sweep w = {any_home, SPH_MATTER, 1, false, 1u << SPH_COLUMN_spare, look_at_tile, count_home, 0, 0};
    memset(&seen, 0, sizeof seen);
    for (uint32_t chunk = 0; chunk < sph_sweep_chunks(sim); chunk++)
        sph_sweep_chunk(sim, &w, chunk, sim->thread);
    assert_int_equal(seen.homes, sim->now.count);
    assert_true(seen.candidates > sim->now.count);
    if (SPH_SIFTS)
        assert_int_equal(seen.neighbours, pairs_within_reach(sim));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        subject(carried_fields_go_with_their_particle),
        subject(displaced_fields_gain_the_way_through_periodic_faces),
        subject(a_constant_rate_gives_rate_times_time),
        subject(a_decay_is_followed_to_second_order),
        subject(walls_have_no_rates),
        subject(every_field_is_part_of_the_hash),
        subject(a_dump_holds_every_field_and_goes_on_with_the_same_bits),
        subject(a_failed_step_leaves_every_field_as_it_was),
        subject(a_value_out_of_its_range_fails_the_step_and_names_the_particle),
        subject(the_arena_names_every_field),
        subject(a_column_set_is_a_line_and_its_loader),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
