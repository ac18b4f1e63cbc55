/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* plane_wave.c: how much of a plane elastic wave comes back from an edge, by the angle at which it meets it (Powell
   2012 section 1.1.4; his closed forms: eqs 2.46-2.49). A strip, periodic along y, one wavelength of the trace 2 pi/k_y
   high, with the edge at its high end in x and the same at its low end. At the start it has the velocities of a packet
   of waves of one kind (P or S), a Gaussian in k_x; half of it goes either way.
   What starts goes along (k_x, k_y) and against it; what came back from either edge has the other sign of k_x k_y. So
   the history gives the Fourier components of v with k_x < 0 at +k_y, P and S apart by their projection on the wave
   vector, as shares of the amplitude that was sent, the root mean square of both edges. Packets of a kind that travels
   at c cos(angle) along x are long in proportion: amplitude^2 is energy/(c cos). At angle 0, where there is no such
   sign, the strip is longer, so that only the right edge's wave is in the window. */
#include "edged.h"
#if SPH_DIM == 2

enum { ANGLE = SOLID_COMMON, LENGTH, WAVE, PACKET, EDGED, DURATION = EDGED + EDGED_PARAMS, PARAMS };

static const scene_param param[PARAMS] = {
    SOLID_PARAMS(SPH_CUBIC, 1.3, 0, 0, SPH_KICK_DRIFT_KICK, 0.4, SPH_TOTAL, SPH_NO_ARTIFICIAL_STRESS, EDGED_MU, 0),
    {"angle", "degree", "between the wave and the edge's normal", 30, 0, 80, SCENE_NUMBER},
    {"wavelength", "dx", "about; the height is a whole number of spacings, and the angle is kept", 16, 6, 100,
     SCENE_NUMBER},
    {"wave", "-", "wave: p s", 0, 0, 1, SCENE_CHOICE},
    {"packet", "wavelength", "standard deviation of the packet along x, in lengths of the wave along x", 1.2, 0.5, 10,
     SCENE_NUMBER},
    EDGED_PARAM_ROWS(SPH_EDGE_NATURAL, 10, 3e-3),
    {"duration", "-", "length of the run; at 1 what came back is whole", 1, 0, 10, SCENE_NUMBER},
};

/* lengths in spacings, which are 1 cm; along: unit of the wave's velocity */
typedef struct wave {
    double sine, cosine, kx, ky, sigma, speed, start, length, height, free; /* free: x up to which nothing is layer */
} wave;
static wave wave_of(const double *p)
{
    const double a = p[ANGLE] * SCENE_PI / 180;
    wave w = {sph_sin(a), sph_cos(a), 0, 0, 0, 0, 0, 0, 12, 0};
    double length = p[LENGTH];
    if (p[ANGLE] > 0) {
        w.height = (double)(uint32_t)(length / w.sine + 0.5);
        w.height = w.height < 12 ? 12 : w.height;
        length = w.height * w.sine;
        w.ky = 2 * SCENE_PI / w.height;
    }
    w.kx = 2 * SCENE_PI * w.cosine / length;
    w.sigma = p[PACKET] * length / w.cosine;
    w.speed = p[WAVE] != 0 ? edged_cs(p) : edged_cp(p);
    const double layer = p[EDGED + EDGED_EDGE] <= SPH_EDGE_VISCOUS ? p[EDGED + EDGED_LAYER] : 8;
    w.start = (p[ANGLE] > 0 ? 3.5 : 10) * w.sigma + layer;
    w.free = (double)(uint32_t)(w.start + 4 * w.sigma);
    w.length = w.free + (double)(uint32_t)layer;
    return w;
}

static void configure(const double *p, sph_config *c)
{
    const wave w = wave_of(p);
    *c = solid_config(p, 1);
    c->max_particles = scene_capacity(w.length * w.height);
    c->hi[0] = w.length + 2;
    c->lo[0] = -2;
    c->hi[1] = w.height;
    c->face[1][0] = c->face[1][1] = SPH_PERIODIC;
    c->max_stretch = 1.05;
    edged_configure(p, EDGED, 1, c);
}

static void field(void *ctx, const double *x, double *v, double *rho)
{
    const double *p = ctx;
    const wave w = wave_of(p);
    (void)rho;
    v[0] = v[1] = 0;
    for (int m = -20; m <= 20; m++) {
        const double off = 0.2 * m, kx = w.kx + off / w.sigma, k = __builtin_sqrt(kx * kx + w.ky * w.ky);
        const double a = 1e-5 * sph_exp(-0.5 * off * off) * sph_cos(kx * (x[0] - w.start) + w.ky * x[1]);
        v[0] += a * (p[WAVE] != 0 ? -w.ky : kx) / k;
        v[1] += a * (p[WAVE] != 0 ? kx : w.ky) / k;
    }
}

static sph_status build(sph_sim *sim, const double *p)
{
    const wave w = wave_of(p);
    const sph_solid m = solid_material(p);
    const double lo[2] = {0, 0}, hi[2] = {w.length, w.height};
    const sph_edges e = {.faces = SPH_LOW(0) | SPH_HIGH(0)};
    double values[PARAMS];
    uint32_t set;
    sph_status st;
    for (int k = 0; k < PARAMS; k++)
        values[k] = p[k];
    if ((st = sph_add_solid(sim, &m, &set, NULL)) != SPH_OK || (st = sph_add_box(sim, set, lo, hi, NULL)) != SPH_OK ||
        (p[EDGED + EDGED_EDGE] > 0 && (st = sph_find_edges(sim, &e)) != SPH_OK))
        return st;
    return sph_apply_field(sim, set, field, values);
}

/* until both kinds that come back stand 3 packets off the edge, at the same time: lengths go with c cos */
static double end(const double *p)
{
    const wave w = wave_of(p);
    return p[DURATION] * 7.2 * w.sigma / (w.speed * w.cosine);
}

/* ---- what goes which way ---- */

#define MOST 4096
typedef struct columns_of_strip {
    double v[MOST][4]; /* of a column: the Fourier components along y of v_x, v_y: cosine, sine each */
} columns_of_strip;

static void add_columns(const sph_sim *sim, const wave *w, columns_of_strip *s, uint32_t n)
{
    sph_particle q;
    for (uint32_t k = 0; k < n; k++)
        s->v[k][0] = s->v[k][1] = s->v[k][2] = s->v[k][3] = 0;
    for (uint32_t i = 0; i < sph_count(sim); i++) {
        if (sph_get(sim, i, &q) != SPH_OK || !(q.x[0] >= 0) || !(q.x[0] < n))
            continue;
        const uint32_t at = (uint32_t)q.x[0];
        const double c = sph_cos(w->ky * q.x[1]), d = sph_sin(w->ky * q.x[1]);
        for (int k = 0; k < 2; k++) {
            s->v[at][2 * k] += q.v[k] * c;
            s->v[at][2 * k + 1] -= q.v[k] * d;
        }
    }
}

/* sums over k_x of one sign of |component along k|^2 and across it, from column `first` on */
static void shares(const columns_of_strip *s, const wave *w, double sign, uint32_t first, uint32_t n, double *along,
                   double *across)
{
    const double step = SCENE_PI / (n - first), most = 4 * w->kx / w->cosine;
    *along = *across = 0;
    for (double k = step; k < most; k += step) {
        const double kx = sign * k, size = __builtin_sqrt(kx * kx + w->ky * w->ky);
        double f[4] = {0}; /* re, im of v_x; of v_y */
        for (uint32_t c = first; c < n; c++) {
            const double re = sph_cos(kx * (c + 0.5)), im = -sph_sin(kx * (c + 0.5));
            for (int a = 0; a < 2; a++) {
                f[2 * a] += s->v[c][2 * a] * re - s->v[c][2 * a + 1] * im;
                f[2 * a + 1] += s->v[c][2 * a] * im + s->v[c][2 * a + 1] * re;
            }
        }
        for (int a = 0; a < 2; a++) {
            const double p = (kx * f[a] + w->ky * f[2 + a]) / size, q = (kx * f[2 + a] - w->ky * f[a]) / size;
            *along += p * p;
            *across += q * q;
        }
    }
}

static const char *const column[] = {"time_cm/c0", "p_back", "s_back", "kinetic_K.cm2", "absorbed_K.cm2"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const wave w = wave_of(p);
    const uint32_t n = (uint32_t)(w.free < MOST ? w.free : MOST), first = p[ANGLE] > 0 ? 0 : (uint32_t)(7 * w.sigma);
    const double cp = edged_cp(p), cs = edged_cs(p), trace = w.sine / w.speed; /* sin/c is that of all waves */
    columns_of_strip s;
    double sent[2] = {0, 0}, back[2] = {0, 0};
    sph_totals o;
    add_columns(sim, &w, &s, n);
    shares(&s, &w, -1, first, n, &back[0], &back[1]);
    for (uint32_t k = 0; k < n; k++) { /* what was sent: half of the field at the start */
        double v[2], quarter[2];
        const double x[2] = {k + 0.5, 0}, y[2] = {k + 0.5, w.ky > 0 ? 0.25 * w.height : 0};
        field((void *)(uintptr_t)p, x, v, NULL);
        field((void *)(uintptr_t)p, y, quarter, NULL);
        for (int a = 0; a < 2; a++) { /* cos(phase + pi/2) = -sin(phase) */
            s.v[k][2 * a] = 0.5 * v[a] * w.height * (w.ky > 0 ? 0.5 : 1);
            s.v[k][2 * a + 1] = w.ky > 0 ? -0.25 * quarter[a] * w.height : 0;
        }
    }
    shares(&s, &w, 1, 0, n, &sent[0], &sent[1]);
    const double whole = p[WAVE] != 0 ? sent[1] : sent[0], own = w.speed * w.cosine;
    const double cos_p = 1 - trace * trace * cp * cp, cos_s = 1 - trace * trace * cs * cs;
    sph_get_totals(sim, &o);
    row[0] = sph_time(sim);
    /* Fourier sums are over steps of their own: n - first and n columns */
    const double scale = (double)(n) / (n - first) * (p[ANGLE] > 0 ? 2 : 1); /* two edges */
    row[1] = cos_p > 0 ? __builtin_sqrt(back[0] / (scale * whole) * own / (cp * __builtin_sqrt(cos_p))) : 0;
    row[2] = __builtin_sqrt(back[1] / (scale * whole) * own / (cs * __builtin_sqrt(cos_s > 0 ? cos_s : 1)));
    row[3] = o.kinetic;
    row[4] = o.absorbed;
}

#define scene_plane_wave SPH_NAME(scene_plane_wave)
extern const scene scene_plane_wave;
const scene scene_plane_wave = {"plane_wave", "a plane elastic wave meets an edge that lets waves out", param, PARAMS,
                                configure, build, end, sizeof column / sizeof *column, column, history, scene_gray};
#endif
