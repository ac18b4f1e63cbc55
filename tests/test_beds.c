/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_beds.c: walls along polylines (no gap, no doubled particle, a box's corners are those of boxes), water at rest
   over a bed of slopes, and motions by programme and by spline. */
#include "testing.h"

#include "examples/scenes/waves.h"

#define DX 0.0625 /* a power of two: places of corners are exact */
enum { MOST = 6000 };

static const struct {
    uint32_t kind;
    bool compressible;
} walls[] = {{SPH_WALL_LENNARD_JONES, false}, {SPH_WALL_KERNEL_FORCE, false}, {SPH_WALL_MONAGHAN_KOS, false},
             {SPH_WALL_GHOST, false},         {SPH_WALL_GHOST, true},         {SPH_WALL_ADAMI, false}};
enum { KINDS = sizeof walls / sizeof *walls };

static sph_wall wall_of(uint32_t k)
{
    sph_wall w = sph_wall_default();
    w.kind = walls[k].kind;
    w.compressible = walls[k].compressible;
    return w;
}

static sph_sim *wall_only(uint32_t kind, const double (*points)[2], uint32_t n)
{
    sph_config c = open_config(8, DX);
    const sph_wall w = wall_of(kind);
    c.max_particles = MOST;
    c.smoothing_length = 2 * DX;
    c.kernel = SPH_WENDLAND_C2;
    sph_sim *sim = new_sim(&c);
    if (n)
        must(sim, sph_add_wall_polyline(sim, &w, points, n, NULL));
    return sim;
}

/* whether particle p has one at the same place in the other simulation */
static bool is_in(const sph_sim *sim, const sph_particle *p)
{
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK && fabs(p->x[0] - q.x[0]) < 1e-6 && fabs(p->x[1] - q.x[1]) < 1e-6)
            return true;
    return false;
}
static void same_places(const sph_sim *a, const sph_sim *b)
{
    sph_particle p;
    assert_int_equal(sph_count(a), sph_count(b));
    for (uint32_t i = 0; i < sph_count(a); i++) {
        must(a, sph_get(a, i, &p));
        if (!is_in(b, &p))
            fail_msg("none at %g, %g", p.x[0], p.x[1]);
    }
}

static void a_polyline_round_a_tank_has_the_particles_of_a_box(void **state)
{
    const double lo[2] = {1, 1}, hi[2] = {3, 2};
    const double points[4][2] = {{1, 2}, {1, 1}, {3, 1}, {3, 2}};
    (void)state;
    for (uint32_t k = 0; k < KINDS; k++) {
        const sph_wall w = wall_of(k);
        sph_sim *a = wall_only(k, points, 4), *b = wall_only(k, NULL, 0);
        must(b, sph_add_wall_box(b, &w, lo, hi, SPH_LOW(0) | SPH_LOW(1) | SPH_HIGH(0), true, NULL));
        same_places(a, b);
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void a_polyline_of_one_piece_is_a_segment(void **state)
{
    const double points[2][2] = {{1, 1}, {2.6, 1.7}};
    (void)state;
    for (uint32_t k = 0; k < KINDS; k++) {
        const sph_wall w = wall_of(k);
        sph_sim *a = wall_only(k, points, 2), *b = wall_only(k, NULL, 0);
        must(b, sph_add_wall_segment(b, &w, points[0], points[1], NULL));
        same_places(a, b);
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* distance of a place from the nearest particle but number `not` */
static double nearest(const sph_sim *sim, const double *x, uint32_t not)
{
    double best = 1e300;
    sph_particle q;
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (i != not && sph_get(sim, i, &q) == SPH_OK) {
            const double d = hypot(x[0] - q.x[0], x[1] - q.x[1]);
            best = d < best ? d : best;
        }
    return best;
}
/* how far a place lies behind the nearest piece; < 0: in front */
static double depth_behind(const double (*p)[2], uint32_t n, const double *x)
{
    double best = 1e300, side = 1;
    for (uint32_t k = 0; k + 1 < n; k++) {
        const double d[2] = {p[k + 1][0] - p[k][0], p[k + 1][1] - p[k][1]}, l2 = d[0] * d[0] + d[1] * d[1];
        const double t = ((x[0] - p[k][0]) * d[0] + (x[1] - p[k][1]) * d[1]) / l2, s = t < 0 ? 0 : t > 1 ? 1 : t;
        const double off = hypot(x[0] - p[k][0] - s * d[0], x[1] - p[k][1] - s * d[1]);
        if (off < best) {
            best = off;
            side = d[0] * (x[1] - p[k][1]) - d[1] * (x[0] - p[k][0]) > 0 ? -1 : 1;
        }
    }
    return side * best;
}

/* beds with turns of up to a right angle both ways, pieces of 0.8 .. 1.6 m */
static void no_corner_of_a_bed_has_a_gap_or_a_doubled_particle(void **state)
{
    enum { POINTS = 5 };
    sph_rng rng;
    (void)state;
    sph_rng_seed(&rng, 11, 1);
    for (int turn = 0; turn < 40; turn++) {
        double points[POINTS][2] = {{0.7, 4}}, way = 0.5 * (sph_rng_uniform(&rng) - 0.5);
        for (int k = 1; k < POINTS; k++) {
            const double length = 0.8 + 0.8 * sph_rng_uniform(&rng);
            points[k][0] = points[k - 1][0] + length * cos(way);
            points[k][1] = points[k - 1][1] + length * sin(way);
            const double by = 1.5 * (sph_rng_uniform(&rng) - 0.5);
            way += way + by > 1.2 || way + by < -1.2 ? -by : by;
        }
        sph_sim *sim = wall_only(KINDS - 1, (const double(*)[2])points, POINTS);
        const double thick = 4 * DX;
        sph_particle p;
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            must(sim, sph_get(sim, i, &p));
            if (depth_behind((const double(*)[2])points, POINTS, p.x) < 0.49 * DX)
                fail_msg("turn %d: a particle at %g, %g, nearer to the water than half a dx", turn, p.x[0], p.x[1]);
            if (nearest(sim, p.x, i) < 0.65 * DX)
                fail_msg("turn %d: two particles %g dx apart", turn, nearest(sim, p.x, i) / DX);
        }
        for (int k = 0; k < 4000; k++) { /* every place behind the bed is near to a particle */
            const double x[2] = {points[0][0] + 0.3 + 5 * sph_rng_uniform(&rng), 1 + 6 * sph_rng_uniform(&rng)};
            const double deep = depth_behind((const double(*)[2])points, POINTS, x);
            if (x[0] < points[POINTS - 1][0] - 0.3 && deep > 0.3 * DX && deep < thick - 0.5 * DX &&
                nearest(sim, x, MOST) > 0.85 * DX)
                fail_msg("turn %d: none within %g dx of %g, %g", turn, nearest(sim, x, MOST) / DX, x[0], x[1]);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

static void beds_that_fold_or_turn_back_are_refused(void **state)
{
    static const struct {
        uint32_t n;
        double p[4][2];
    } bad[] = {{1, {{1, 1}}},
               {2, {{1, 1}, {1.05, 1}}},
               {2, {{1, 1}, {NAN, 1}}},
               {3, {{1, 1}, {3, 1}, {1.5, 1.5}}},
               {4, {{1, 1}, {2, 2}, {2.2, 2}, {3.2, 1}}}}; /* a ridge too narrow for its layers */
    const sph_wall w = wall_of(KINDS - 1);
    sph_sim *sim = wall_only(KINDS - 1, NULL, 0);
    (void)state;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        const uint64_t before = sph_hash(sim);
        assert_int_equal(sph_add_wall_polyline(sim, &w, bad[k].p, bad[k].n, NULL), SPH_BAD_ARGUMENT);
        assert_int_equal(sph_count(sim), 0);
        assert_true(sph_hash(sim) == before);
    }
    assert_int_equal(sph_add_wall_polyline(sim, &w, NULL, 3, NULL), SPH_BAD_ARGUMENT);
    assert_int_equal(sph_add_wall_polyline(sim, NULL, bad[3].p, 3, NULL), SPH_BAD_ARGUMENT);
}

/* ---- water at rest over a bed like a W ---- */

#define W_DEPTH 1.0
static const double w_bed[7][2] = {{0, 1.4}, {0, 0.5}, {0.75, 0}, {1.5, 0.5}, {2.25, 0}, {3, 0.5}, {3, 1.4}};

static double w_at(const void *of, double x)
{
    (void)of;
    for (int k = 1; k < 5; k++)
        if (x <= w_bed[k + 1][0])
            return w_bed[k][1] + (x - w_bed[k][0]) / (w_bed[k + 1][0] - w_bed[k][0]) * (w_bed[k + 1][1] - w_bed[k][1]);
    return 0.5;
}
static double level(const void *of, double x) { return (void)of, (void)x, 0; }

/* a tank of it; force walls begin to push a spacing off: half a spacing more room there */
static sph_sim *w_tank(uint32_t kind)
{
    const double dx = 1.0 / 12;
    sph_config c = open_config(4, dx);
    const wave_water water = {.depth = W_DEPTH, .gravity = 9.81, .sound = 10, .to = 3, .n = 12, .surface = level,
                              .bed = w_at};
    double p[SCENE_COMMON] = {0}, points[7][2];
    const double gap = walls[kind].kind == SPH_WALL_LENNARD_JONES ? 0.5 * dx : 0;
    const sph_wall w = wall_of(kind);
    c.lo[0] = c.lo[1] = -0.6, c.hi[0] = 3.6, c.hi[1] = 2;
    c.kernel = SPH_WENDLAND_C2;
    c.smoothing_length = 2 * dx;
    c.sound_speed = 10 * sqrt(9.81);
    c.gravity[1] = -9.81;
    c.alpha = 0.02;
    c.diffusion = SPH_HYDROSTATIC;
    c.integrator = SPH_KICK_DRIFT_KICK;
    c.cfl = c.gravity_factor = 0.9;
    c.max_particles = MOST;
    c.on_cross = SPH_PUT_BACK;
    c.on_leave = SPH_FAIL;
    p[SCENE_EOS] = SPH_TAIT;
    sph_sim *sim = new_sim(&c);
    must(sim, wave_add(sim, p, &water));
    for (int k = 0; k < 7; k++) {
        points[k][0] = w_bed[k][0] + (k < 2 ? -gap : k > 4 ? gap : 0);
        points[k][1] = w_bed[k][1] - gap;
    }
    must(sim, sph_add_wall_polyline(sim, &w, (const double(*)[2])points, 7, NULL));
    return sim;
}

static double w_level(const sph_sim *sim)
{
    double sum = 0;
    for (int i = 0; i < 8; i++) {
        const double x[2] = {0.5 + 2.0 * (i + 0.5) / 8, 0};
        double h = 0;
        must(sim, sph_gauge(sim, x, 1, &h));
        sum += h / 8;
    }
    return sum;
}

/* for WBED_SECONDS, or 2 */
static void water_over_a_bed_like_a_w_comes_to_rest_and_stays_in(void **state)
{
    const double end = getenv("WBED_SECONDS") ? atof(getenv("WBED_SECONDS")) : 2;
    (void)state;
    for (uint32_t k = 0; k < KINDS; k++) {
        sph_sim *sim = w_tank(k);
        sph_totals o;
        const double first = w_level(sim);
        const bool kept = walls[k].kind == SPH_WALL_ADAMI || walls[k].compressible; /* the others: README, G1 and G2 */
        double most = 0, late = 0;
        while (sph_time(sim) < end) {
            const sph_status st = sph_step_to(sim, end);
            if (st && !kept) {
                print_message("wall %u fails at %.3g s: %s\n", walls[k].kind, sph_time(sim), sph_status_text(st));
                break;
            }
            must(sim, st);
            sph_get_totals(sim, &o);
            if (sph_time(sim) < 0.25 * end)
                most = o.kinetic > most ? o.kinetic : most;
            if (sph_time(sim) > 0.75 * end)
                late = o.kinetic > late ? o.kinetic : late;
        }
        const double risen = w_level(sim) - first;
        sph_step_info info;
        sph_get_step(sim, &info);
        print_message("wall %u%s: level %+.2f %% of the depth, kinetic energy at most %.3g, later %.3g J, crossed %u\n",
                      walls[k].kind, walls[k].compressible ? " compressible" : "", 100 * risen / W_DEPTH, most, late,
                      info.crossed);
        if (kept) {
            assert_true(fabs(risen) < 0.005 * W_DEPTH);
            assert_true(late < 0.5 * most);
            assert_int_equal(info.crossed, 0);
        }
        assert_int_equal(free_sims(NULL), 0);
    }
}

/* ---- motions ---- */

static void a_programme_goes_the_way_that_its_velocities_make(void **state)
{
    const double t[] = {0.5, 1.25, 1.5, 3}, v[] = {0, 2, 2, -1};
    double x[2], u[2], sum = 0;
    (void)state;
    sph_programme m = {4, 1, t, v};
    for (int i = 0; i <= 4000; i++) { /* midpoints of pieces of a millisecond, on which rows stand */
        const double now = 0.001 * i;
        sph_motion_programme(&m, now, x, u);
        close_to(x[0], 0, 0);
        close_to(x[1], sum, 1e-12);
        sph_motion_programme(&m, now + 0.0005, x, u);
        sum += 0.001 * u[1];
    }
    /* Gray's piston: 0.15 t*^2 D */
    const double d = 0.16, rise = 3 * sqrt(d / 9.81), top = 0.981 * rise;
    const double gt[] = {0, rise, 1.5 * rise, 2.5 * rise}, gv[] = {0, top, top, 0};
    sph_programme gray = {4, 0, gt, gv};
    sph_motion_programme(&gray, 10, x, u);
    close_to(x[0], 0.15 * 9 * d, 1e-15);
    close_to(u[0], 0, 0);
    sph_motion_programme(&m, -1, x, u);
    close_to(x[1], 0, 0);
    sph_motion_programme(&m, 5, x, u); /* goes on */
    close_to(u[1], -1, 0);
}

static void a_spline_passes_its_rows_with_continuous_velocity_and_acceleration(void **state)
{
    const double t[] = {0, 0.5, 0.8, 1.5, 2}, x[] = {1, 1.2, 2, 1.7, 3}, e = 1e-6;
    double bend[10], a[2], b[2], u[2], w[2];
    (void)state;
    sph_spline m = {5, 0, t, x, bend};
    assert_true(sph_spline_make(&m, bend));
    for (int k = 0; k < 5; k++) {
        sph_motion_spline(&m, t[k], a, u);
        close_to(a[0], x[k] - x[0], 1e-14);
        sph_motion_spline(&m, t[k] - e, a, u);
        sph_motion_spline(&m, t[k] + e, b, w);
        close_to(w[0], u[0], 1e-4);
        if (k == 0 || k == 4)
            close_to(k ? u[0] : w[0], 0, 1e-4);
        else { /* second differences of the way from both sides */
            double before[2], after[2], v[2];
            sph_motion_spline(&m, t[k] - 2 * e, before, v);
            close_to((u[0] - v[0]) / e, bend[k], 1e-3);
            sph_motion_spline(&m, t[k] + 2 * e, after, v);
            close_to((v[0] - w[0]) / e, bend[k], 1e-3);
        }
    }
    /* 3 s^2 - 2 s^3 is its own spline */
    const double s[] = {0, 0.3, 0.7, 1}, way[] = {0, 0.216, 0.784, 1};
    sph_spline cubic = {4, 0, s, way, bend};
    assert_true(sph_spline_make(&cubic, bend));
    for (double now = 0.05; now < 1; now += 0.1) {
        sph_motion_spline(&cubic, now, a, u);
        close_to(a[0], now * now * (3 - 2 * now), 1e-14);
        close_to(u[0], 6 * now * (1 - now), 1e-13);
    }
    const double back[] = {0, 0.3, 0.2, 1};
    sph_spline wrong = {4, 0, back, way, bend};
    assert_false(sph_spline_make(&wrong, bend));
    assert_false(sph_spline_make(&cubic, NULL));
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_polyline_round_a_tank_has_the_particles_of_a_box),
        subject(a_polyline_of_one_piece_is_a_segment),
        subject(no_corner_of_a_bed_has_a_gap_or_a_doubled_particle),
        subject(beds_that_fold_or_turn_back_are_refused),
        subject(water_over_a_bed_like_a_w_comes_to_rest_and_stays_in),
        subject(a_programme_goes_the_way_that_its_velocities_make),
        subject(a_spline_passes_its_rows_with_continuous_velocity_and_acceleration),
    };
    return run_subjects("beds", list);
}
