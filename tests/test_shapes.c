/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* test_shapes.c: sph_add_shape: counts against exact volumes and the order at which the error falls, symmetry, the
   distances on the shifted lattices of Gray 2001 section 5.6.5 with and without a seam, cuts and cylinders, and every
   bad argument. */
#include "testing.h"

#define DX 0.1
#define EACH_LATTICE(l) for (uint32_t l = 0; l <= (SPH_DIM > 1 ? SPH_DIM : 0); l++)
static const double origin[3] = {0.31, -0.17, 0.23}; /* no multiple of the spacing */

/* an empty simulation with one set and place for so many particles, in a box of half this width about `origin` */
static sph_sim *room_for(uint32_t particles, double half)
{
    sph_config c = open_config(1, DX);
    uint32_t set;
    c.max_particles = particles;
    for (int k = 0; k < SPH_DIM; k++) {
        c.lo[k] = origin[k] - half;
        c.hi[k] = origin[k] + half;
    }
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    return sim;
}

static sph_sim *room(double half) { return room_for(20000, half); }

/* a box about `origin` with these half widths, all of them times w */
static sph_shape box_of(double w, double x, double y, double z)
{
    const double half[3] = {x * w, y * w, z * w};
    sph_shape s = {.holes = 0};
    for (int k = 0; k < SPH_DIM; k++) {
        s.lo[k] = origin[k] - half[k];
        s.hi[k] = origin[k] + half[k];
    }
    return s;
}
static sph_ellipse ellipse_of(double r, double x, double y, double z)
{
    const double radius[3] = {x * r, y * r, z * r};
    sph_ellipse e;
    for (int k = 0; k < SPH_DIM; k++) {
        e.centre[k] = origin[k];
        e.radius[k] = radius[k];
    }
    return e;
}

/* how many particles a shape adds */
static uint32_t added(sph_sim *sim, const sph_shape *s)
{
    const uint32_t before = sph_count(sim);
    must(sim, sph_add_shape(sim, 0, s));
    return sph_count(sim) - before;
}

static sph_particle at_index(const sph_sim *sim, uint32_t i)
{
    sph_particle p;
    assert_int_equal(sph_get(sim, i, &p), SPH_OK);
    return p;
}

/* ---- counts ---- */

static void same_particles(const sph_sim *a, const sph_sim *b)
{
    assert_int_equal(sph_count(a), sph_count(b));
    for (uint32_t i = 0; i < sph_count(a); i++) {
        const sph_particle p = at_index(a, i), q = at_index(b, i);
        assert_memory_equal(p.x, q.x, sizeof p.x);
        assert_memory_equal(p.v, q.v, sizeof p.v);
    }
    assert_true(sph_hash(a) == sph_hash(b));
}

static void a_square_shape_is_the_box_and_the_ring_of_old(void **state)
{
    (void)state;
    for (double w = 0.75; w < 6; w += 0.61) {
        sph_sim *a = room(1), *b = room(1);
        sph_shape s = box_of(w * DX, 1, 0.8, 1.1);
        double centre[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++) {
            s.velocity[k] = 0.5 - k;
            centre[k] = origin[k] + 0.02;
        }
        must(a, sph_add_box(a, 0, s.lo, s.hi, s.velocity));
        must(b, sph_add_shape(b, 0, &s));
        same_particles(a, b);
        sph_ellipse outer = ellipse_of(w * DX, 1, 1, 1), inner = ellipse_of(0.6 * w * DX, 1, 1, 1);
        memcpy(outer.centre, centre, sizeof centre);
        memcpy(inner.centre, centre, sizeof centre);
        const sph_shape ring = {.outline = &outer, .hole = &inner, .holes = 1};
        const uint32_t before = sph_count(a);
        const sph_status st = sph_add_ring(a, 0, centre, 0.6 * w * DX, w * DX, NULL);
        assert_int_equal(sph_add_shape(b, 0, &ring), st);
        assert_int_equal(st, sph_count(a) > before ? SPH_OK : SPH_BAD_ARGUMENT); /* a thin one may hold none */
        same_particles(a, b);
        free_sims(NULL);
    }
}

/* whole boxes hold exactly their volume on every lattice, all of it inside, with the velocity that was asked for */
static void a_whole_box_holds_its_volume(void **state)
{
    (void)state;
    EACH_LATTICE(l)
        for (uint32_t n = 1; n <= 6; n++) {
            sph_sim *sim = room(1);
            sph_shape s = box_of(n * DX / 2, 1, 3, 2);
            s.lattice = l;
            s.velocity[SPH_DIM - 1] = 0.25;
            assert_int_equal(added(sim, &s), SPH_DIM == 1 ? n : SPH_DIM == 2 ? 3 * n * n : 6 * n * n * n);
            for (uint32_t i = 0; i < sph_count(sim); i++) {
                const sph_particle p = at_index(sim, i);
                for (int k = 0; k < SPH_DIM; k++)
                    assert_true(p.x[k] > s.lo[k] + 0.2 * DX && p.x[k] < s.hi[k] - 0.2 * DX);
                assert_true(p.v[SPH_DIM - 1] == 0.25 && p.set == 0 && p.rho == 1000);
            }
            free_sims(NULL);
        }
}

/* a box that is no whole number of spacings: counted by hand, row by row */
static void a_broken_box_holds_the_centres_inside(void **state)
{
    (void)state;
    EACH_LATTICE(l)
        for (double w = 1.03; w < 5; w += 0.37) {
            sph_sim *sim = room(1);
            const double edge[3] = {w, 1.3 * w, 0.9 * w};
            sph_shape s = box_of(w * DX / 2, 1, 1.3, 0.9);
            s.lattice = l;
            uint32_t n[3] = {1, 1, 1}, want = 0;
            for (int k = 0; k < SPH_DIM; k++)
                n[k] = (uint32_t)(edge[k] + 0.5);
            if (l)
                n[l - 1] = 1;
            for (uint32_t a = 0; a < n[0]; a++)
                for (uint32_t b = 0; b < n[1]; b++)
                    for (uint32_t c = 0; c < n[2]; c++)
                        want += l ? (uint32_t)(edge[l - 1] + ((a + b + c) % 2 ? 0.25 : 0.75)) : 1;
            assert_int_equal(added(sim, &s), want);
            free_sims(NULL);
        }
}

/* centres on the low and the high face of a box belong to it, those on the rim of an outline or a hole to neither */
static void faces_belong_to_a_box_and_rims_to_nothing(void **state)
{
    (void)state;
    for (int j = 0; j < 20; j++) {
        sph_sim *sim = room(1);
        const uint32_t rows = SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? 4 : 16;
        sph_shape s = box_of(2 * DX, 1, 1, 1);
        s.lo[0] += 0.013 * j;
        s.hi[0] = s.lo[0] + (j % 5 + 1.5) * DX;
        assert_int_equal(added(sim, &s), (uint32_t)(j % 5 + 2) * rows);
        sph_ellipse e = ellipse_of(INFINITY, 1, 1, 1);
        e.centre[0] += 0.013 * j;
        e.radius[0] = 2.5 * DX; /* the third centres from the middle */
        s.outline = &e;
        s.lo[0] = s.hi[0] = 0;
        assert_int_equal(added(sim, &s), 4 * rows);
        s.outline = NULL;
        s.hole = &e;
        s.holes = 1;
        s.lo[0] = e.centre[0] - 4 * DX;
        s.hi[0] = e.centre[0] + 4 * DX;
        assert_int_equal(added(sim, &s), 4 * rows);
        free_sims(NULL);
    }
}

/* what is cut out of a shape and what is put in its place are together the shape, whatever lies on the rim */
static void a_hole_and_its_disc_are_the_whole(void **state)
{
    (void)state;
    EACH_LATTICE(l)
        for (double r = 1; r < 5; r += 0.25) {
            sph_sim *sim = room(1);
            const sph_ellipse whole = ellipse_of(6 * DX, 1, 1, 1), part = ellipse_of(r * DX, 1, 1, 1);
            const sph_shape all = {.outline = &whole, .lattice = l}, disc = {.outline = &part, .lattice = l},
                            ring = {.outline = &whole, .hole = &part, .holes = 1, .lattice = l};
            const uint32_t n = added(sim, &ring) + added(sim, &disc);
            assert_int_equal(n, added(sim, &all));
            free_sims(NULL);
        }
}

/* Errors of the volumes of ellipsoids, of rings, and of plates with a hole, relative to the volume of the ellipsoid,
   root mean square over many radii. The number of lattice points in a round body of radius R errs by the square root of
   that of the cells on its rim, (R/dx)^((DIM-1)/2): relative to its volume, at order (DIM + 1)/2 in dx/R. */
enum { DISC, RING, PLATE, SUBJECTS };
static const char *const subject_names[] = {"disc", "ring", "plate with a hole"};
enum { RADII = 128 };
static double volume_error(uint32_t subject, uint32_t lattice, double cells)
{
    const double unit = SPH_DIM == 1 ? 2 : SPH_DIM == 2 ? 0.7 * 3.14159265358979 : 0.7 * 0.8 * 4.18879020478639;
    double sum = 0;
    for (int j = 1; j <= RADII; j++) {
        const double r = cells * DX * (1 + 0.6180339887 * j - floor(0.6180339887 * j)), edge = (ceil(r / DX) + 1) * DX;
        const double volume = unit * pow(r, SPH_DIM);
        const sph_ellipse whole = ellipse_of(r, 1, 0.7, 0.8), half = ellipse_of(r / 2, 1, 0.7, 0.8);
        sph_shape s = box_of(edge, 1, 1, 1);
        double want = pow(2 * edge, SPH_DIM) - volume;
        if (subject == PLATE) {
            s.hole = &whole;
        } else {
            s.outline = &whole;
            s.hole = &half;
            want = subject == DISC ? volume : volume * (1 - pow(0.5, SPH_DIM));
        }
        s.holes = subject != DISC;
        s.lattice = lattice;
        sph_sim *sim = room_for((uint32_t)pow(2 * edge / DX + 1, SPH_DIM), 5);
        const double e = (added(sim, &s) * pow(DX, SPH_DIM) - want) / volume;
        sum += e * e / RADII;
        free_sims(NULL);
    }
    return sqrt(sum);
}
static void the_error_of_a_volume_falls_at_the_right_order(void **state)
{
    const double steps = SPH_DIM == 3 ? 1 : 2;
    (void)state;
    EACH_LATTICE(l)
        for (uint32_t subject = 0; subject < SUBJECTS; subject++) {
            const double e = volume_error(subject, l, 6), f = volume_error(subject, l, 6 * pow(2, steps));
            const double order = log2(e / f) / steps;
            print_message("shapes: lattice %u, %s: error %.2e, %.2e, order %.2f\n", l, subject_names[subject], e, f,
                          order);
            close_to(order, (SPH_DIM + 1) / 2.0, 0.35);
        }
}

/* ---- symmetry ---- */

/* the number of particles whose mirror image (in the axes of the mask, about `origin`) is there too */
static uint32_t mirrored(const sph_sim *sim, uint32_t mask)
{
    const uint32_t n = sph_count(sim);
    uint32_t found = 0;
    for (uint32_t i = 0; i < n; i++) {
        const sph_particle p = at_index(sim, i);
        for (uint32_t j = 0; j < n; j++) {
            const sph_particle q = at_index(sim, j);
            double far = 0;
            for (int k = 0; k < SPH_DIM; k++)
                far = fmax(far, fabs((mask >> k & 1 ? 2 * origin[k] - p.x[k] : p.x[k]) - q.x[k]));
            if (far < 1e-7) {
                found++;
                break;
            }
        }
    }
    return found;
}

static void a_ring_mirrors_in_every_axis(void **state)
{
    (void)state;
    EACH_LATTICE(l)
        for (double r = 1.75; r < (SPH_DIM == 3 ? 3.3 : 6.3); r += 0.25) /* quarters: many points exactly on the rims */
            for (int round = 0; round < 2; round++) {
                sph_sim *sim = room(1);
                const double y = round ? 1 : 0.75;
                const sph_ellipse outer = ellipse_of(r * DX, 1, y, 1), inner = ellipse_of(0.5 * r * DX, 1, y, 1);
                const sph_shape s = {.outline = &outer, .hole = &inner, .holes = 1, .lattice = l};
                const uint32_t n = added(sim, &s);
                for (uint32_t mask = 1; mask < 1u << SPH_DIM; mask++)
                    assert_int_equal(mirrored(sim, mask), n);
                free_sims(NULL);
            }
}

/* on a square lattice a plate with a hole in its middle mirrors in every axis; on a shifted one in those two, turned
   about the middle, where it has an even number of rows */
static void a_plate_with_a_hole_is_symmetric(void **state)
{
    (void)state;
    EACH_LATTICE(l)
        for (double r = 1; r < 2.4; r += 0.25) {
            sph_sim *sim = room(1);
            const sph_ellipse hole = ellipse_of(r * DX, 1, 0.75, 1);
            sph_shape s = box_of(3 * DX, 1, 1, 1);
            s.hole = &hole;
            s.holes = 1;
            s.lattice = l;
            const uint32_t n = added(sim, &s);
            for (uint32_t mask = 1; mask < 1u << SPH_DIM; mask++) {
                uint32_t across = 0; /* mirrors that turn the order of the rows */
                for (int k = 0; k < SPH_DIM; k++)
                    across += (mask >> k & 1) && k != (int)l - 1;
                if (l == 0 || (mask >> (l - 1) & 1) == across % 2)
                    assert_int_equal(mirrored(sim, mask), n);
            }
            free_sims(NULL);
        }
}

/* ---- the shifted lattices ---- */

/* a periodic box full of a lattice: n spacings along every axis but the last */
static sph_sim *periodic_lattice(uint32_t lattice, uint32_t n, uint32_t last)
{
    sph_config c = periodic_config(n * DX, DX);
    sph_shape s = {.lattice = lattice};
    uint32_t set;
    c.eos = SPH_ISOTHERMAL; /* pressure at rest density */
    c.hi[SPH_DIM - 1] = last * DX;
    for (int k = 0; k < SPH_DIM; k++)
        s.hi[k] = c.hi[k];
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    must(sim, sph_add_shape(sim, set, &s));
    return sim;
}

/* so far do the forces on a particle, of size c0^2/dx each, cancel (m/s^2) */
#define STILL (200 * EPS * 20 * 20 / DX)

/* neighbours of particle i at a distance (spacings), the nearest images taken */
static uint32_t neighbours_at(const sph_sim *sim, const double *length, uint32_t i, double distance)
{
    const sph_particle p = at_index(sim, i);
    uint32_t found = 0;
    for (uint32_t j = 0; j < sph_count(sim); j++) {
        const sph_particle q = at_index(sim, j);
        double r2 = 0;
        for (int k = 0; k < SPH_DIM; k++) {
            const double d = p.x[k] - q.x[k];
            r2 += pow((d - length[k] * round(d / length[k])) / DX, 2);
        }
        found += fabs(sqrt(r2) - distance) < 1e-5;
    }
    return found;
}

/* the shells of a lattice of edges 1 along the rows and, with 1/2 for every step across, 1 across them */
static uint32_t shell(uint32_t lattice, double distance)
{
    uint32_t found = 0;
    for (int a = -3; a <= 3; a++)
        for (int b = SPH_DIM > 1 ? -3 : 0; b <= (SPH_DIM > 1 ? 3 : 0); b++)
            for (int d = SPH_DIM > 2 ? -3 : 0; d <= (SPH_DIM > 2 ? 3 : 0); d++) {
                const double x = a + (lattice && (b + d) % 2 ? 0.5 : 0);
                found += fabs(sqrt(x * x + b * b + d * d) - distance) < 1e-9;
            }
    return found;
}

static void a_shifted_lattice_is_face_centred_without_a_seam(void **state)
{
    const uint32_t n = 8;
    double length[SPH_DIM];
    (void)state;
    for (int k = 0; k < SPH_DIM; k++)
        length[k] = n * DX;
    EACH_LATTICE(l) {
        sph_sim *sim = periodic_lattice(l, n, n);
        assert_int_equal(sph_count(sim), pow(n, SPH_DIM));
        const double distance[] = {0.5, 1, sqrt(1.25), sqrt(2), sqrt(2.25), 2, sqrt(3.25)};
        for (uint32_t i = 0; i < sph_count(sim); i++)
            for (size_t d = 0; d < sizeof distance / sizeof *distance; d++)
                assert_int_equal(neighbours_at(sim, length, i, distance[d]), shell(l, distance[d]));
        if (l) { /* as the manual says */
            assert_int_equal(neighbours_at(sim, length, 0, 1), 2);
            assert_int_equal(neighbours_at(sim, length, 0, sqrt(1.25)), SPH_DIM == 2 ? 4 : 8);
        }
        must(sim, sph_ready(sim)); /* and nothing pushes anything */
        for (uint32_t i = 0; i < sph_count(sim); i++)
            for (int k = 0; k < SPH_DIM; k++)
                close_to(at_index(sim, i).a[k], 0, STILL);
        free_sims(NULL);
    }
}

/* an odd number of rows across a periodic axis leaves a seam: why the manual asks for an even one */
static void an_odd_number_of_rows_leaves_a_seam(void **state)
{
    (void)state;
#if SPH_DIM > 1
    double length[SPH_DIM], most = 0;
    for (int k = 0; k < SPH_DIM; k++)
        length[k] = (k == SPH_DIM - 1 ? 9 : 8) * DX;
    sph_sim *sim = periodic_lattice(SPH_LATTICE_SHIFTED_X, 8, 9);
    assert_true(neighbours_at(sim, length, 0, 1) > 2);
    must(sim, sph_ready(sim));
    for (uint32_t i = 0; i < sph_count(sim); i++)
        most = fmax(most, fabs(at_index(sim, i).a[SPH_DIM - 1]));
    assert_true(most > 10 * STILL);
#endif
}

/* rows of a shifted box: a quarter and three quarters of a spacing inside lo, by turns; in 3-D every second layer
   begins with the other one */
static void rows_stand_where_the_manual_says(void **state)
{
    (void)state;
    for (uint32_t l = 1; l <= (SPH_DIM > 1 ? SPH_DIM : 0); l++) {
        sph_sim *sim = room(1);
        sph_shape s = box_of(2 * DX, 1, 1, 1);
        s.lattice = l;
        added(sim, &s);
        for (uint32_t i = 0; i < sph_count(sim); i++) {
            const sph_particle p = at_index(sim, i);
            uint32_t row = 0;
            for (int k = 0; k < SPH_DIM; k++)
                row += k == (int)l - 1 ? 0 : (uint32_t)((p.x[k] - s.lo[k]) / DX);
            const double along = (p.x[l - 1] - s.lo[l - 1]) / DX;
            close_to(along - floor(along), row % 2 ? 0.75 : 0.25, 1e-5);
        }
        free_sims(NULL);
    }
}

/* ---- cuts and cylinders ---- */

static void lo_and_hi_cut_an_outline(void **state)
{
    sph_sim *sim = room(1);
    const sph_ellipse disc = ellipse_of(4.6 * DX, 1, 1, 1);
    sph_shape s = {.outline = &disc};
    (void)state;
    const uint32_t whole = added(sim, &s);
    s.lo[SPH_DIM - 1] = origin[SPH_DIM - 1];
    s.hi[SPH_DIM - 1] = origin[SPH_DIM - 1] + 9;
    assert_int_equal(2 * added(sim, &s), whole);
    s.hi[SPH_DIM - 1] = origin[SPH_DIM - 1] + DX;
    const uint32_t slice = added(sim, &s);
    s.lattice = SPH_DIM > 1;
    if (SPH_DIM > 1) { /* the row through the centre stands in both halves */
        s.lo[SPH_DIM - 1] = origin[SPH_DIM - 1];
        s.hi[SPH_DIM - 1] = origin[SPH_DIM - 1] + 9;
        const uint32_t upper = added(sim, &s);
        s.lo[SPH_DIM - 1] = origin[SPH_DIM - 1] - 9;
        s.hi[SPH_DIM - 1] = origin[SPH_DIM - 1];
        const uint32_t lower = added(sim, &s);
        s.lo[SPH_DIM - 1] = s.hi[SPH_DIM - 1] = 0;
        assert_true(upper == lower);
        /* a^2 + b^2 < 4.6^2, a + 1/2 by turns */
        assert_int_equal(upper + lower - added(sim, &s), SPH_DIM == 2 ? 10 : 66);
    }
    assert_int_equal(slice, SPH_DIM == 1 ? 1 : SPH_DIM == 2 ? 10 : 68); /* (a + 1/2)^2 + (b + 1/2)^2 < 4.6^2 - 1/4 */
}

/* points of a layer of a cylinder's lattice in a ring, by hand: rows across the axis are shifted by turns, and all of
   them go through the centre where the rows of a shifted lattice are along the axis or pass it */
enum { SQUARE, ALONG, ACROSS };
static uint32_t ring_points(int how, int layer, double inner, double outer)
{
    uint32_t n = 0;
    for (int a = -6; a <= 6; a++)
        for (int b = -6; b <= 6; b++) {
            const double x = a + (how == SQUARE || (how == ACROSS && (b + layer) % 2 == 0) ? 0.5 : 0);
            const double y = b + (how == SQUARE ? 0.5 : 0), r2 = x * x + y * y;
            n += r2 < outer * outer && r2 >= inner * inner;
        }
    return n;
}

/* a disc of a thickness, with a hole right through, in 3-D: as many layers as are asked for, each a ring */
static void a_cylinder_is_a_stack_of_rings(void **state)
{
    (void)state;
    for (int axis = 0; axis < SPH_DIM && SPH_DIM == 3; axis++)
        for (int layers = 1; layers < 5; layers++)
            EACH_LATTICE(l) {
                sph_sim *sim = room(1);
                sph_ellipse outer = ellipse_of(4.3 * DX, 1, 1, 1), inner = ellipse_of(2.1 * DX, 1, 1, 1);
                sph_shape s = {.outline = &outer, .hole = &inner, .holes = 1, .lattice = l};
                uint32_t want = 0;
                outer.radius[axis] = inner.radius[axis] = INFINITY;
                s.lo[axis] = origin[axis];
                s.hi[axis] = origin[axis] + layers * DX;
                for (int i = 0; i < layers; i++)
                    want += ring_points(l == 0 ? SQUARE : (int)l - 1 == axis ? ALONG : ACROSS, i, 2.1, 4.3);
                assert_int_equal(added(sim, &s), want);
                free_sims(NULL);
            }
}

static void several_holes_are_all_cut(void **state)
{
    sph_sim *sim = room(2);
    sph_ellipse hole[5];
    sph_shape s = box_of(10 * DX, 1, 1, 1);
    (void)state;
    const uint32_t whole = added(sim, &s);
    for (int i = 0; i < 5; i++) {
        hole[i] = ellipse_of(1.5 * DX, 1, 1, 1);
        hole[i].centre[0] += (i - 2) * 4 * DX; /* on a corner of four cells: (3/2)^2 > 1/2, and for 3-D 3/4, < 5/2 */
    }
    s.hole = hole;
    s.holes = 5;
    assert_int_equal(whole - added(sim, &s), 5 * (SPH_DIM == 1 ? 2 : SPH_DIM == 2 ? 4 : 8));
}

/* ---- refusals ---- */

#define shape_refused(sim, set, shape, name)                                                                \
    do {                                                                                                    \
        const uint64_t hash_ = sph_hash(sim);                                                               \
        assert_int_equal(sph_add_shape(sim, set, shape), SPH_BAD_ARGUMENT);                                 \
        assert_string_equal(sph_last(sim)->what, name);                                                     \
        assert_true(strlen(sph_last(sim)->allowed) > 3 && sph_hash(sim) == hash_);                          \
    } while (0)

static void every_bad_shape_is_refused_by_name(void **state)
{
    sph_sim *sim = room(1);
    const int k = SPH_DIM - 1;
    sph_ellipse rim = ellipse_of(3 * DX, 1, 1, 1), hole = ellipse_of(DX, 1, 1, 1);
    const sph_shape box = box_of(4 * DX, 1, 1, 1);
    const double odd[] = {NAN, INFINITY, -INFINITY, 1e15, -1e15};
    sph_shape s;
    (void)state;
    assert_int_equal(sph_add_shape(NULL, 0, &box), SPH_BAD_ARGUMENT);
    shape_refused(sim, 0, NULL, "shape");
    shape_refused(sim, 1, &box, "set");
    for (int i = 0; i < 5; i++) {
        s = box, s.lo[k] = odd[i];
        shape_refused(sim, 0, &s, "lo");
        s = box, s.hi[k] = odd[i];
        shape_refused(sim, 0, &s, "hi");
        s = box, s.velocity[k] = odd[i];
        shape_refused(sim, 0, &s, "velocity");
        s = box, s.outline = &rim, rim.centre[k] = odd[i];
        shape_refused(sim, 0, &s, "centre");
        rim.centre[k] = origin[k];
        s = box, s.hole = &hole, s.holes = 1, hole.centre[k] = odd[i];
        shape_refused(sim, 0, &s, "centre");
        hole.centre[k] = origin[k];
    }
    for (int i = 0; i < 4; i++) {
        rim.radius[k] = hole.radius[k] = (double[]){0, -1, NAN, -INFINITY}[i];
        s = box, s.outline = &rim;
        shape_refused(sim, 0, &s, "radius");
        s = box, s.hole = &hole, s.holes = 1;
        shape_refused(sim, 0, &s, "radius");
    }
    rim.radius[k] = 3 * DX, hole.radius[k] = DX;
    s = box, s.lattice = SPH_DIM == 1 ? 1 : SPH_DIM + 1;
    shape_refused(sim, 0, &s, "lattice");
    s.lattice = 0xffffffffu;
    shape_refused(sim, 0, &s, "lattice");
    s = box, s.holes = 1;
    shape_refused(sim, 0, &s, "holes");
    s.hole = &hole, s.holes = 4097;
    shape_refused(sim, 0, &s, "holes");
    s = box, s.hi[k] = s.lo[k]; /* allowed only where the outline ends */
    shape_refused(sim, 0, &s, "hi");
    s.outline = &rim, rim.radius[k] = INFINITY;
    shape_refused(sim, 0, &s, "hi");
    s = box, s.hi[k] = s.lo[k] - DX, s.outline = &rim, rim.radius[k] = 3 * DX;
    shape_refused(sim, 0, &s, "hi");
    rim.radius[k] = 1e14; /* farther than a domain's length */
    shape_refused(sim, 0, &(sph_shape){.outline = &rim}, "hi");
    s = box, s.hi[k] = 1e14;
    shape_refused(sim, 0, &s, "hi");
    s = box, s.lo[k] -= 1.5; /* its lowest points outside the domain */
    shape_refused(sim, 0, &s, "position");
    rim = ellipse_of(0.3 * DX, 1, 1, 1); /* no lattice point inside */
    shape_refused(sim, 0, &(sph_shape){.outline = &rim}, "shape");
    hole = ellipse_of(9, 1, 1, 1);
    s = box, s.hole = &hole, s.holes = 1;
    shape_refused(sim, 0, &s, "shape");
    assert_int_equal(sph_count(sim), 0);
}

static void a_shape_is_added_whole_or_not_at_all(void **state)
{
    sph_config c = open_config(1, DX);
    uint32_t set;
    (void)state;
    c.max_particles = SPH_DIM == 1 ? 7 : SPH_DIM == 2 ? 63 : 511;
    sph_sim *sim = new_sim(&c);
    must(sim, sph_add_fluid(sim, NULL, &set));
    const sph_shape s = box_of(4 * DX, 1, 1, 1), small = box_of(DX, 1, 1, 1);
    const uint64_t hash = sph_hash(sim);
    assert_int_equal(sph_add_shape(sim, set, &s), SPH_TOO_MANY_PARTICLES);
    assert_true(sph_count(sim) == 0 && sph_hash(sim) == hash);
    assert_int_equal(added(sim, &small), 1 << SPH_DIM);
    must(sim, sph_step(sim));
    assert_int_equal(sph_add_shape(sim, set, &small), SPH_BAD_STATE);
}

int main(void)
{
    const struct CMUnitTest list[] = {
        subject(a_square_shape_is_the_box_and_the_ring_of_old),
        subject(a_whole_box_holds_its_volume),
        subject(a_broken_box_holds_the_centres_inside),
        subject(faces_belong_to_a_box_and_rims_to_nothing),
        subject(a_hole_and_its_disc_are_the_whole),
        subject(the_error_of_a_volume_falls_at_the_right_order),
        subject(a_ring_mirrors_in_every_axis),
        subject(a_plate_with_a_hole_is_symmetric),
        subject(a_shifted_lattice_is_face_centred_without_a_seam),
        subject(an_odd_number_of_rows_leaves_a_seam),
        subject(rows_stand_where_the_manual_says),
        subject(lo_and_hi_cut_an_outline),
        subject(a_cylinder_is_a_stack_of_rings),
        subject(several_holes_are_all_cut),
        subject(every_bad_shape_is_refused_by_name),
        subject(a_shape_is_added_whole_or_not_at_all),
    };
    return run_subjects("shapes", list);
}
