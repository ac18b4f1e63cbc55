/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* soliton.c: the exact solitary wave (see soliton.h), as Clamond and Dutykh make it (2013, Fast accurate computation of
   the fully nonlinear solitary surface gravity waves).

   In the frame of the wave the water streams with -c. The map of the strip t = a + i b, 0 <= b <= 1, onto the water,
     z(t) = x + i y = (1 + q_0) t + sum_k q_k sin(k t)/sinh(k),
   has the bed on b = 0 and the surface eta(a) = sum_k q_k cos(k a) on b = 1, and -c t is the complex potential. That
   the pressure is 0 on the surface is Babenko's equation for eta, with C of symbol k coth(k):
     c^2 C eta - eta = C(eta^2)/2 + eta C eta,
   solved by Petviashvili's iteration eta <- S^2 L^-1 N(eta), L and N being both sides, S = <eta, L eta>/<eta, N eta>;
   c by secants until the crest has the height asked for. Everywhere u - i v = c - c/z', and Bernoulli gives the
   pressure. */
#include "soliton.h"
#if SPH_DIM == 2

enum { M = SOLITON_MODES, ROUNDS = 400 };

/* a series of even functions: values at a = pi m/(M wave), or amplitudes of cos(k wave a) */
typedef struct series {
    double f[M + 1];
} series;

typedef struct maker {
    double cosine[2 * M]; /* of pi i/M */
    double coth[M + 1];   /* k coth(k) of each mode */
} maker;

static series to_values(const maker *m, const series *a)
{
    series v;
    for (int i = 0; i <= M; i++) {
        double sum = 0;
        for (int k = 0; k <= M; k++)
            sum += a->f[k] * m->cosine[i * k % (2 * M)];
        v.f[i] = sum;
    }
    return v;
}

static series to_modes(const maker *m, const series *v)
{
    series a;
    for (int k = 0; k <= M; k++) {
        double sum = 0.5 * (v->f[0] + (k & 1 ? -v->f[M] : v->f[M]));
        for (int i = 1; i < M; i++)
            sum += v->f[i] * m->cosine[i * k % (2 * M)];
        a.f[k] = sum * (k == 0 || k == M ? 1.0 : 2.0) / M;
    }
    return a;
}

/* modes of C(eta^2)/2 + eta C eta */
static series quadratic(const maker *m, const series *mode)
{
    series c = *mode, square = to_values(m, mode), product, q;
    for (int k = 0; k <= M; k++)
        c.f[k] *= m->coth[k];
    product = to_values(m, &c);
    for (int i = 0; i <= M; i++) {
        product.f[i] *= square.f[i];
        square.f[i] *= square.f[i];
    }
    product = to_modes(m, &product);
    q = to_modes(m, &square);
    for (int k = 0; k <= M; k++)
        q.f[k] = 0.5 * m->coth[k] * q.f[k] + product.f[k];
    return q;
}

/* integral of a product over the length, but for a factor */
static double inner(const series *a, const series *b)
{
    double sum = 2 * a->f[0] * b->f[0] + 2 * a->f[M] * b->f[M];
    for (int k = 1; k < M; k++)
        sum += a->f[k] * b->f[k];
    return sum;
}

/* the wave of a speed, from one near by; returns its height */
static double iterate(const maker *m, double c, series *mode)
{
    double change = 1, height = 0;
    for (int round = 0; round < ROUNDS && change > 1e-13; round++) {
        series l = *mode;
        const series n = quadratic(m, mode);
        for (int k = 0; k <= M; k++)
            l.f[k] *= c * c * m->coth[k] - 1;
        const double s = inner(mode, &l) / inner(mode, &n);
        change = height = 0;
        for (int k = 0; k <= M; k++) {
            const double now = s * s * n.f[k] / (c * c * m->coth[k] - 1);
            change += SCENE_ABS(now - mode->f[k]);
            height += now;
            mode->f[k] = now;
        }
    }
    return height;
}

static void prepare(maker *m, double wave)
{
    for (int i = 0; i < 2 * M; i++)
        m->cosine[i] = sph_cos(SCENE_PI * i / M);
    for (int k = 0; k <= M; k++)
        m->coth[k] = k ? k * wave / sph_tanh(k * wave) : 1;
}

bool soliton_make(soliton *s, double height)
{
    maker m;
    series mode;
    if (!(height >= SOLITON_LEAST && height <= SOLITON_MOST))
        return false;
    /* half a length of 22 decay lengths of the wave of first order, eta = e/cosh^2(sqrt(3 e)/2 x) */
    const double decay = __builtin_sqrt(3 * height), half = 22 / decay;
    s->wave = SCENE_PI / half;
    prepare(&m, s->wave);
    for (int i = 0; i <= M; i++) {
        const double up = sph_exp(0.5 * decay * half * i / M);
        mode.f[i] = 4 * height / ((up + 1 / up) * (up + 1 / up));
    }
    mode = to_modes(&m, &mode);
    /* speeds of third order (Grimshaw 1971) to begin with */
    double c[2], h[2];
    c[1] = __builtin_sqrt(1 + height - height * height / 20 - 3 * height * height * height / 70);
    c[0] = 1 + 0.99 * (c[1] - 1);
    h[0] = iterate(&m, c[0], &mode) - height;
    h[1] = iterate(&m, c[1], &mode) - height;
    for (int round = 0; round < 20 && SCENE_ABS(h[1]) > 1e-12 && h[1] - h[0] != 0; round++) {
        const double next = c[1] - h[1] * (c[1] - c[0]) / (h[1] - h[0]);
        c[0] = c[1];
        h[0] = h[1];
        c[1] = next;
        h[1] = iterate(&m, next, &mode) - height;
    }
    s->height = height + h[1];
    s->speed = c[1];
    for (int k = 0; k <= M; k++)
        s->mode[k] = mode.f[k];
    return true;
}

/* z(t) and z'(t) of t = a + i b; complex numbers as pairs */
static void map(const soliton *s, const double *t, double *z, double *slope)
{
    /* e = exp(i wave t) grows or falls by its own factor from mode to mode, and so does its inverse d */
    const double up = sph_exp(s->wave * t[1]), co = sph_cos(s->wave * t[0]), si = sph_sin(s->wave * t[0]);
    const double whole = sph_exp(s->wave);
    double e[2] = {1, 0}, d[2] = {1, 0}, high = 1, keep;
    z[0] = (1 + s->mode[0]) * t[0];
    z[1] = (1 + s->mode[0]) * t[1];
    slope[0] = 1 + s->mode[0];
    slope[1] = 0;
    for (int k = 1; k <= M; k++) {
        keep = (e[0] * co - e[1] * si) / up;
        e[1] = (e[0] * si + e[1] * co) / up;
        e[0] = keep;
        keep = (d[0] * co + d[1] * si) * up;
        d[1] = (d[1] * co - d[0] * si) * up;
        d[0] = keep;
        high *= whole;
        /* sin = (e - d)/2i, cos = (e + d)/2 */
        const double q = s->mode[k] / (high - 1 / high), g = q * k * s->wave; /* over 2 sinh(k) */
        z[0] += q * (e[1] - d[1]);
        z[1] -= q * (e[0] - d[0]);
        slope[0] += g * (e[0] + d[0]);
        slope[1] += g * (e[1] + d[1]);
    }
}

/* where the series begins anew there is no wave any more */
static bool beyond(const soliton *s, double x) { return SCENE_ABS(x) * s->wave >= SCENE_PI; }

double soliton_surface(const soliton *s, double x)
{
    double t[2] = {x, 1}, z[2], slope[2];
    if (beyond(s, x))
        return 0;
    for (int round = 0; round < 30; round++) {
        map(s, t, z, slope);
        const double step = (z[0] - x) / slope[0];
        t[0] -= step;
        if (SCENE_ABS(step) < 1e-13)
            break;
    }
    return z[1] - 1;
}

void soliton_flow(const soliton *s, double x, double y, double *v, double *pressure)
{
    double t[2] = {x, y / (1 + soliton_surface(s, x))}, z[2], slope[2] = {1, 0}, size2 = 1;
    for (int round = 0; round < 30 && !beyond(s, x); round++) {
        map(s, t, z, slope);
        const double off[2] = {z[0] - x, z[1] - y};
        size2 = slope[0] * slope[0] + slope[1] * slope[1];
        const double step[2] = {(off[0] * slope[0] + off[1] * slope[1]) / size2,
                                (off[1] * slope[0] - off[0] * slope[1]) / size2};
        t[0] -= step[0];
        t[1] -= step[1];
        if (SCENE_ABS(step[0]) + SCENE_ABS(step[1]) < 1e-12)
            break;
    }
    v[0] = s->speed * (1 - slope[0] / size2); /* u - i v = c - c/z' */
    v[1] = -s->speed * slope[1] / size2;
    *pressure = 0.5 * s->speed * s->speed * (1 - 1 / size2) + 1 - y;
}
#endif
