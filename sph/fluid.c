/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* fluid.c: water. The pair formulas of density, momentum, viscosity, diffusion and XSPH, written once on lanes, and the
   passes made of them. With g = (dW/dr)/r, grad W = g r_ij, and vr = v_ij . r_ij:

     standard    drho_i += m_j vr g                         a_i -= m_j (p_i/rho_i^2 + p_j/rho_j^2 + Pi) g r_ij
     weak        drho_i += rho_i (m_j/rho_j) vr g           a_i -= m_j (p_i + p_j)/(rho_i rho_j) g r_ij - m_j Pi g r_ij
     direct      drho_i as weak                             a_i -= m_j (p_j - p_i)/(rho_i rho_j) g r_ij - m_j Pi g r_ij
     artificial  Pi = -(h/rho_mean)(alpha c0 + beta h |mu|) mu,  mu = vr/(r^2 + 0.01 h^2)        (Gray 2001 eq 2.18)
     Morris      a_i += m_j 4 nu/(rho_i + rho_j) (g r^2)/(r^2 + 0.01 h^2) v_ij                     (Morris et al. 1997)
     diffusion   drho_i += 2 delta h c0 (m_j/rho_j) (rho_j - rho_i - rho_H) (r_ji . grad W)/(r^2 + 0.01 h^2)
     XSPH        u_i += xsph (m_j/rho_mean) (v_j - v_i) W   (Gray 2001 eq 2.22; not with walls, as he says)

   Scenes with solids take the same pair formulas, with a stress tensor in place of the pressure and the velocity gradient in
   place of continuity: see SPH_UPDATED in sph.h, and solid.h.

   Arrays: none but the state's acc, drho (and xsph, tmp, power when chosen). Cost: one sweep a force evaluation. */
#include "fluid.h"
#include "kernels.h"

/* the choices that a pair formula depends on; constants in the fast paths */
typedef struct choice {
    uint32_t kernel, scheme, viscosity, diffusion;
    bool beta, xsph, books;
    bool solid, total, hat; /* a stress tensor; reference positions; strain rates from smoothed velocities */
    uint32_t repulsion;     /* exponent of the artificial stress, 0: none */
} choice;

typedef sph_factors factors;

/* The predictor-corrector evaluates forces once, at the predicted state, and keeps them: on an oscillation w it multiplies
   the amplitude by 1 + (w dt)^4/4 a step (from mu^2 - (1 + 3z/2) mu + z/2 = 0, z = i w dt). Sound of the shortest waves
   grows unless dissipation, whose effect a step goes as dt, is stronger: so the largest Courant number goes as its cube
   root. 0.22 is what a still tank of 30 particles stands with alpha = 0.01 alone (tests/validate_water.py, G2). */
#define PC_COURANT 0.22
#define PC_DISSIPATION (0.01 / 8) /* nu/(h c) of artificial viscosity with alpha 0.01 in 2-D */
#define PC_COURANT_LEAST 0.05
/* Solids stand less: with alpha 0.02, 0.1, 0.5 a free block of them kept quiet up to 0.29, 0.43, 0.65 (updated), 0.18, 0.24, 0.37
   (corrected), where the rule for water says 0.28, 0.47, 0.81; corrected gradients raise the shortest waves' frequency. */
#define PC_UPDATED 0.75
#define PC_CORRECTED 0.42
/* cube root of 1e-3 .. 1e6: Newton's rule from 1. At worst (1e6) one turn overshoots, about 20 take a third off each, 6 converge */
static double cube_root(double x)
{
    double r = 1;
    for (int i = 0; i < 40; i++)
        r -= (r - x / (r * r)) / 3;
    return r;
}

static double courant_factor(const sph_config *c)
{
    if (!SPH_IS(c->integrator, PREDICTOR_CORRECTOR))
        return c->cfl;
    double d = sph_diffusive(c->diffusion) ? c->delta : 0;
    d += SPH_IS(c->viscosity, MORRIS) ? c->nu / (c->smoothing_length * c->sound_speed) : sph_viscous(c->viscosity) ? c->alpha / 8 : 0;
    const double x = d / PC_DISSIPATION;
    double stands = x < 1e-3 ? 0 : x > 1e6 ? PC_COURANT * 100 : PC_COURANT * cube_root(x);
    if (sph_has_solids(c))
        stands *= sph_corrects(c) ? PC_CORRECTED : PC_UPDATED;
    stands = stands < PC_COURANT_LEAST ? PC_COURANT_LEAST : stands;
    return c->cfl < stands ? c->cfl : stands;
}

/* constants of the pair formulas; made at init and when the configuration changes */
void sph_make_factors(sph_sim *sim)
{
    const sph_config *c = &sim->cfg;
    sph_factors *f = &sim->fac;
    double h = c->smoothing_length, value, slope, support = sph_kernel_support(c->kernel);
    sph_kernel_scales(c->kernel, h, &value, &slope);
    f->inv_h = (sph_real)(1 / h);
    f->eta = (sph_real)(0.01 * h * h);
    f->reach = (sph_real)support;
    f->reach2 = (sph_real)(support * support * h * h * 1.0001); /* the scalar form skips beyond: all terms are 0 there */
    f->slope = (sph_real)slope;
    f->value = (sph_real)value;
    if (sph_repels(c) || sph_is_total(c)) {
        double at, dw;
        sph_kernel_value(c->kernel, c->spacing, h, &at, &dw);
        f->inv_wdx = at > 0 ? (sph_real)(value / at) : 0;
        f->repulsion = (sph_real)c->stress_epsilon;
        f->contact = (sph_real)(2 * c->sound_speed * c->sound_speed * (sph_weak_scheme(c->scheme) ? c->rho0 : 1 / c->rho0));
    }
    /* the formulas use mu' = mu/(rho_i + rho_j): 1/rho_mean = 2/(rho_i + rho_j), and |mu| = (rho_i + rho_j) |mu'| */
    f->av_alpha = (sph_real)(2 * h * c->alpha * c->sound_speed);
    f->av_beta = (sph_real)(2 * h * h * c->beta);
    f->morris = SPH_WITH_MORRIS ? (sph_real)(4 * c->nu) : 0;
    f->diff = SPH_HAS_DIFFUSION ? (sph_real)(2 * c->delta * h * c->sound_speed) : 0;
    const double c2 = c->sound_speed * c->sound_speed * (SPH_IS(c->eos, TAIT_GRAY) ? 7 : 1);
    for (int k = 0; k < SPH_DIM; k++) {
        f->gravity[k] = (sph_real)c->gravity[k];
        /* density difference that gravity makes over a distance r at rest: rho0 g . r / c^2 */
        f->hydro[k] = SPH_IS(c->diffusion, HYDROSTATIC) ? (sph_real)(c->rho0 * c->gravity[k] / c2) : 0;
    }
    sim->courant = courant_factor(c);
    f->rate_by_density = sph_weak_scheme(c->scheme);
    f->continuity = !sph_sums_density(c);
    f->extras = SPH_HAS_EXTRAS && (sph_uses_xsph(c) || (SPH_WITH_BODY_FORCE && c->body_force) || sph_keeps_books(c));
    if (SPH_WITH_STANDARD_WICK || SPH_WITH_WEAK_WICK)
        f->small_p = (sph_real)(1e-6 * c->rho0 * c->sound_speed * c->sound_speed);
}

/* Vectors whose sums a home holds at a time: all that make up the eight lanes; where a register holds one real, lane after
   lane, so that the sums of one stay in registers. The order within a lane is the same. */
#define AT_ONCE (SPH_SCALAR ? 1 : SPH_NV)

/* what a home particle brings to each pair, spread over the lanes once */
typedef struct home {
    vreal x[SPH_DIM], v[SPH_DIM], rho, a, iv;
#if SPH_WITH_SOLID
    vreal t[SPH_NL], r[SPH_NT], k[SPH_DIM], u[SPH_DIM], body;
    const sph_solid_tile *tile; /* of its candidates */
#endif
} home;

SPH_INLINE home spread_home(const sph_tile *t, uint32_t h)
{
    home o;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        o.x[k] = v_set(t->x[k][h]);
        o.v[k] = v_set(t->v[k][h]);
    }
    o.rho = v_set(t->rho[h]);
    o.a = v_set(t->a[h]);
    o.iv = v_set(t->iv[h]);
#if SPH_WITH_SOLID
    o.body = v_set(0); /* see spread_solid */
    o.tile = NULL;
#endif
    return o;
}

#if SPH_WITH_SOLID
SPH_INLINE void spread_solid(const sph_solid_scratch *solid, uint32_t h, const choice *c, home *o)
{
    const sph_solid_homes *t = &solid->home;
    o->tile = &solid->tile;
    SPH_UNROLL
    for (int k = 0; k < SPH_NL; k++)
        o->t[k] = v_set(t->t[k][h]);
    SPH_UNROLL
    for (int k = 0; k < SPH_NT; k++)
        o->r[k] = v_set(c->repulsion ? t->r[k][h] : 0);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        o->k[k] = v_set(c->total ? t->k[k][h] : 0);
        o->u[k] = v_set(c->hat ? t->u[k][h] : 0);
    }
    o->body = v_set(c->total ? t->body[h] : 0);
}
#endif

SPH_INLINE vreal dot(const vreal *a, const vreal *b)
{
    vreal s = a[0] * b[0];
    SPH_UNROLL
    for (int k = 1; k < SPH_DIM; k++)
        s = s + a[k] * b[k];
    return s;
}

/* the continuity weight that Wickramarachchi's 3.50 and 3.79 print: pressures of the pair over the home's pressure */
SPH_INLINE vreal printed_weight(uint32_t scheme, const factors *f, vreal ai, vreal aj, vreal rho)
{
    const vreal p = SPH_IS(scheme, STANDARD_WICK) ? ai * rho * rho : ai;
    const vint usable = v_less(v_set(f->small_p), v_abs(p));
    const vreal safe = v_select(usable, ai, v_set(1));
    const vreal w = SPH_IS(scheme, STANDARD_WICK) ? (ai + aj) / (2 * safe) : aj / safe;
    return v_select(usable, w, v_set(1));
}

#if SPH_WITH_SOLID
/* a small power by squaring; n is a constant in the fast paths */
SPH_INLINE vreal power_of(vreal f, uint32_t n)
{
    vreal p = n & 1 ? f : v_set(1);
    const vreal f2 = f * f, f4 = f2 * f2;
    if (n & 2)
        p = p * f2;
    if (n & 4)
        p = p * f4;
    return n & 8 ? p * (f4 * f4) : p;
}

/* what a stress tensor gives: acceleration (T_i + T_j + (R_i + R_j) f^n) . K, and m v_ij (x) K for the velocity gradient */
SPH_INLINE void solid_pair(const choice *c, const factors *f, const home *h, const sph_tile *t, uint32_t j, uint32_t nv, bool wall, vreal q, vreal mg, vreal iv, const vreal *kx, const vreal *dv, vreal (*s)[AT_ONCE])
{
    const sph_solid_tile *st = h->tile;
    const bool weak = sph_weak_scheme(c->scheme);
    const vreal wl = weak ? mg * iv : mg, w = weak ? wl * h->iv : mg;
    vreal fn = v_set(0);
    if (c->repulsion && !wall)
        fn = power_of(k_value(c->kernel, q) * f->inv_wdx, c->repulsion);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        vreal a = v_set(0);
        SPH_UNROLL
        for (int l = 0; l < SPH_DIM; l++) {
            vreal sum = h->t[k * SPH_DIM + l];
            if (!wall)
                sum = sum + v_load(st->t[k * SPH_DIM + l] + j);
            else if (k == l)
                sum = sum + v_load(t->a + j);
            if (c->repulsion && !wall)
                sum = sum + (h->r[sph_sym[k][l]] + v_load(st->r[sph_sym[k][l]] + j)) * fn;
            a = l ? a + sum * kx[l] : sum * kx[l];
        }
        s[SUM_ACC + k][nv] = s[SUM_ACC + k][nv] + a * w;
        vreal d = dv[k];
        if (c->hat)
            d = h->u[k] - (wall ? v_load(t->v[k] + j) : v_load(st->u[k] + j));
        d = d * wl;
        SPH_UNROLL
        for (int l = 0; l < SPH_DIM; l++)
            s[SUM_L + k * SPH_DIM + l][nv] = s[SUM_L + k * SPH_DIM + l][nv] + d * kx[l];
    }
}
#endif

/* one group of lanes: everything a pair gives to the home particle. wall: the candidates are ghosts */
SPH_INLINE void pair(const choice *c, const factors *f, const home *h, const sph_thread *th, const sph_tile *t,
                     uint32_t j, uint32_t nv, bool wall, vreal (*s)[AT_ONCE])
{
    vreal dx[SPH_DIM], dv[SPH_DIM], dw[SPH_DIM], kx[SPH_DIM]; /* kx: K, the vector that the kernel sees */
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        kx[k] = dx[k] = h->x[k] - v_load(t->x[k] + j);
    const vreal r2 = dot(dx, dx);
    vreal k2 = r2;
    (void)kx; /* read by solids only */
#if SPH_HAS_TOTAL
    vint apart = v_set_int(0); /* of two bodies: no stress between them */
    if (c->solid && c->total && !wall) {
        const vreal other = v_load(h->tile->body + j), half = v_set((sph_real)0.5);
        const vint same = v_less(half, h->body) & v_equal(h->body, other);
        apart = v_less(half, h->body) & v_less(half, other) & ~same;
        vreal to[SPH_DIM];
        SPH_UNROLL
        for (int k = 0; k < SPH_DIM; k++) {
            to[k] = v_select(same, h->k[k] - v_load(h->tile->k[k] + j), dx[k]);
            kx[k] = v_where(~apart, to[k]);
        }
        k2 = dot(to, to);
    }
#endif
#if SPH_SCALAR
    if (k2 > f->reach2)
        return;
#endif
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        dv[k] = dw[k] = h->v[k] - v_load(t->v[k] + j);
    const bool weak = sph_weak_scheme(c->scheme), viscous = sph_viscous(c->viscosity), diffusive = sph_diffusive(c->diffusion);
    const bool needs_iv = weak || diffusive;
    const int o = c->solid ? SPH_NL : 0; /* where the sums behind the velocity gradient stand */
    const vreal q = v_sqrt(k2) * f->inv_h;
    const vreal mg = k_slope(c->kernel, q) * v_load(t->m + j);
    const vreal rho = v_load(t->rho + j), aj = v_load(t->a + j);
    const vreal iv = needs_iv ? v_load(t->iv + j) : rho;
    const vreal vr = dot(dv, dx);

    /* continuity */
    if (!c->solid) {
        vreal con = mg * vr;
        if (weak)
            con = con * iv;
        if (SPH_IS(c->scheme, STANDARD_WICK) || SPH_IS(c->scheme, WEAK_WICK))
            con = con * printed_weight(c->scheme, f, h->a, aj, h->rho);
        s[SUM_DRHO][nv] = s[SUM_DRHO][nv] + con;
    }

    /* pressure, or stress */
    vreal force = v_set(0);
#if SPH_WITH_SOLID
    if (c->solid)
        solid_pair(c, f, h, t, j, nv, wall, q, mg, iv, kx, dv, s);
    else
#endif
    if (!weak)
        force = (h->a + aj) * mg;
    else if (SPH_IS(c->scheme, DIRECT))
        force = (aj - h->a) * h->iv * iv * mg;
    else
        force = (aj + h->a) * h->iv * iv * mg;
#if SPH_HAS_TOTAL
    if (c->solid && c->total && !wall) { /* contact of two bodies: see SPH_TOTAL in sph.h */
        const vreal push = v_where(apart, v_pos(k_value(c->kernel, q) * f->inv_wdx - 1)) * f->contact;
        force = weak ? push * h->iv * iv * mg : push * mg;
    }
#endif

    /* viscosity; with a ghost wall the mirror velocity multiplies v_ij by beta = 1 + min(depth/distance, 1/2) */
    const vreal inv = viscous || diffusive ? 1 / ((r2 + f->eta) * (h->rho + rho)) : r2;
    vreal visc = v_set(0), mu = v_set(0), fm = v_set(0);
    if (viscous) {
        vreal vv = vr;
        if (wall) {
            vreal n[SPH_DIM];
            SPH_UNROLL
            for (int k = 0; k < SPH_DIM; k++)
                n[k] = v_load(th->more.n[k] + j);
            const vreal depth = v_load(th->more.depth + j);
            const vreal dist = v_max(dot(dx, n) - depth, depth + (sph_real)1e-30); /* depth/dist <= 1 */
            const vreal extra = depth / dist;
            const vreal beta = v_select(v_less(extra, v_set((sph_real)0.5)), extra, v_set((sph_real)0.5)) + 1;
            const vreal vis = SPH_WITH_WALL_GHOST ? v_load(th->more.vis + j) * beta : v_load(th->more.vis + j);
            SPH_UNROLL
            for (int k = 0; k < SPH_DIM; k++)
                dw[k] = (h->v[k] - v_load(th->more.u[k] + j)) * vis;
            vv = dot(dw, dx);
        }
        if (SPH_IS(c->viscosity, ARTIFICIAL_APPROACHING))
            vv = v_where(v_less(vv, v_set(0)), vv);
        mu = vv * inv; /* mu of Gray 2.18 over (rho_i + rho_j) */
        if (SPH_IS(c->viscosity, MORRIS)) {
            fm = mg * r2 * inv * f->morris;
        } else {
            vreal strength = v_set(f->av_alpha);
            if (c->beta)
                strength = strength + f->av_beta * ((h->rho + rho) * v_abs(mu));
            visc = mu * strength * mg;
            force = force - visc;
        }
        mu = v_where(v_less(q, v_set(f->reach)), v_abs(mu));
    }
    s[SUM_MU][nv] = v_max(s[SUM_MU][nv], mu);
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        s[SUM_ACC + k][nv] = s[SUM_ACC + k][nv] + force * dx[k];
        if (SPH_IS(c->viscosity, MORRIS))
            s[SUM_ACC + k][nv] = s[SUM_ACC + k][nv] - fm * dw[k];
    }

    vreal diff = v_set(0);
    if (diffusive && !wall) {
        vreal dr = h->rho - rho;
        if (SPH_IS(c->diffusion, HYDROSTATIC)) {
            SPH_UNROLL
            for (int k = 0; k < SPH_DIM; k++)
                dr = dr - dx[k] * f->hydro[k];
        }
        /* (rho_j - rho_i) r_ji . grad W = (rho_i - rho_j) r^2 g; the sum rho_i + rho_j in inv is taken out again */
        diff = dr * (r2 * inv * (h->rho + rho)) * mg * iv * f->diff;
        s[SUM_DRHO][nv] = s[SUM_DRHO][nv] + (weak ? diff * h->iv : diff);
    }
    if (SPH_WITH_XSPH && c->xsph && !wall) {
        const vreal w = k_value(c->kernel, q) * v_load(t->m + j) / (h->rho + rho);
        SPH_UNROLL
        for (int k = 0; k < SPH_DIM; k++)
            s[SUM_XSPH + o + k][nv] = s[SUM_XSPH + o + k][nv] - w * dv[k];
    }
    if (SPH_WITH_BOOKS && c->books) {
        /* work of the pair's viscous force on the home particle relative to the partner: pairs of fluid count twice */
        vreal d = SPH_IS(c->viscosity, MORRIS) ? -(fm * dot(dw, dv)) : -(visc * vr);
        s[SUM_VISC + o][nv] = s[SUM_VISC + o][nv] + (wall ? d : d * (sph_real)0.5);
        s[SUM_DIFF + o][nv] = s[SUM_DIFF + o][nv] + diff;
        if (wall) { /* force of the wall on the fluid times the wall's velocity */
            SPH_UNROLL
            for (int k = 0; k < SPH_DIM; k++)
                s[SUM_WALL + o][nv] = s[SUM_WALL + o][nv] + (force * dx[k] - fm * dw[k]) * v_load(t->v[k] + j);
        }
    }
}

SPH_INLINE void force_home(const choice *c, const factors *f, sph_thread *th, const sph_solid_scratch *solid, uint32_t h, bool wall)
{
    const sph_tile *t = wall ? &th->ghost : &th->fluid;
    home o = spread_home(&th->home, h);
#if SPH_WITH_SOLID
    if (c->solid)
        spread_solid(solid, h, c, &o);
#else
    (void)solid;
#endif
    const uint32_t n = t->n;
    vreal s[SPH_SUMS][AT_ONCE];
    const int used = (SPH_WITH_BOOKS && c->books ? (int)SUM_FORCE : SPH_WITH_XSPH && c->xsph ? (int)SUM_VISC : (int)SUM_XSPH) +
                     (c->solid ? SPH_NL : 0);
    for (int a = used; a < SPH_SUMS; a++) /* never read; where the choices are constants this vanishes */
        for (int k = 0; k < AT_ONCE; k++)
            s[a][k] = v_set(0);
    for (uint32_t from = 0; from < SPH_LANES; from += AT_ONCE * SPH_W) {
        SPH_UNROLL
        for (int a = 0; a < used; a++)
            SPH_UNROLL
            for (uint32_t k = 0; k < AT_ONCE; k++)
                s[a][k] = v_load(th->sum[a][h] + from + k * SPH_W);
        for (uint32_t j = from; j < n; j += SPH_LANES) {
            SPH_UNROLL
            for (uint32_t k = 0; k < AT_ONCE; k++)
                pair(c, f, &o, th, t, j + k * SPH_W, k, wall, s);
        }
        SPH_UNROLL
        for (int a = 0; a < used; a++)
            SPH_UNROLL
            for (uint32_t k = 0; k < AT_ONCE; k++)
                v_store(th->sum[a][h] + from + k * SPH_W, s[a][k]);
    }
}

/* every choice read at run time: the form that covers all */
static __attribute__((noinline)) void force_any(const choice *c, const factors *f, sph_thread *t, uint32_t h, bool wall)
{
    choice own = *c;
    own.solid = false;
    if (SPH_SMALL)
        force_home(&own, f, t, NULL, h, SPH_HAS_LAYERED_WALLS && wall);
    else if (SPH_HAS_LAYERED_WALLS && wall)
        force_home(&own, f, t, NULL, h, true);
    else
        force_home(&own, f, t, NULL, h, false);
}

#if SPH_WITH_SOLID
static __attribute__((noinline)) void force_solid(const choice *c, const factors *f, sph_thread *t, const sph_solid_scratch *solid, uint32_t h, bool wall)
{
    choice own = *c;
    own.solid = true;
    own.total = SPH_HAS_TOTAL && own.total;
    own.hat = SPH_HAS_HAT && own.hat;
    own.repulsion = SPH_HAS_REPULSION ? own.repulsion : 0;
    if (SPH_SMALL)
        force_home(&own, f, t, solid, h, SPH_HAS_LAYERED_WALLS && wall);
    else if (SPH_HAS_LAYERED_WALLS && wall)
        force_home(&own, f, t, solid, h, true);
    else
        force_home(&own, f, t, solid, h, false);
}
#endif

#if SPH_WITH_FAST_PATHS
/* the same text compiled with the choices as constants; one line adds a path */
#define SPH_FAST_LIST(X)                                                                                    \
    X(w2_av, SPH_WENDLAND_C2, SPH_ARTIFICIAL, SPH_NO_DIFFUSION)                                             \
    X(w2_av_h, SPH_WENDLAND_C2, SPH_ARTIFICIAL, SPH_HYDROSTATIC)                                            \
    X(cubic_av, SPH_CUBIC, SPH_ARTIFICIAL, SPH_NO_DIFFUSION)
#define SPH_FAST_FN(name, kernel_, visc, diff)                                                               \
    static __attribute__((noinline)) void force_##name(const factors *f, sph_thread *t, uint32_t homes)    \
    {                                                                                                       \
        static const choice c = {.kernel = kernel_, .viscosity = visc, .diffusion = diff}; /* standard scheme */     \
        const factors own = *f;                                                                             \
        for (uint32_t h = 0; h < homes; h++)                                                                \
            force_home(&c, &own, t, NULL, h, false);                                                              \
    }
SPH_FAST_LIST(SPH_FAST_FN)
#undef SPH_FAST_FN

#if SPH_WITH_SOLID
/* solids with artificial viscosity, standard scheme: kernel, whether tension repels with the fourth power, reference positions */
#define SPH_FAST_SOLIDS(X)                                                                                  \
    X(cubic, SPH_CUBIC, 0, false)                                                                           \
    X(cubic_r, SPH_CUBIC, 4, false)                                                                         \
    X(w2, SPH_WENDLAND_C2, 0, false)                                                                        \
    X(w2_r, SPH_WENDLAND_C2, 4, false)                                                                      \
    X(w2_t, SPH_WENDLAND_C2, 0, SPH_HAS_TOTAL)
#define SPH_FAST_FN(name, kernel_, power, total_)                                                           \
    static __attribute__((noinline)) void solid_##name(const factors *f, sph_thread *t, const sph_solid_scratch *solid, uint32_t homes) \
    {                                                                                                       \
        static const choice c = {.kernel = kernel_, .viscosity = SPH_ARTIFICIAL, .solid = true, .total = total_, \
                                 .repulsion = power};                                                       \
        const factors own = *f;                                                                             \
        for (uint32_t h = 0; h < homes; h++)                                                                \
            force_home(&c, &own, t, solid, h, false);                                                       \
    }
SPH_FAST_SOLIDS(SPH_FAST_FN)
#undef SPH_FAST_FN
#endif
#endif

/* Adds a tile to the homes' sums. A ghost whose density goes by continuity sums over the fluid only; its acceleration is
   not used. */
static void force_tile(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    const sph_config *c = &sim->cfg;
    const bool solid = sph_has_solids(c), hat = sph_smooths_strain(c);
    const uint32_t power = sph_repels(c) ? c->stress_exponent : 0;
#if SPH_WITH_FAST_PATHS
#if SPH_WITH_SOLID
    const bool usual = SPH_IS(c->viscosity, ARTIFICIAL) && c->diffusion == SPH_NO_DIFFUSION && c->beta == 0 && c->xsph == 0 && !c->books;
    if (solid && usual && role == SPH_ROLE_FLUID && SPH_IS(c->scheme, STANDARD)) {
#define SPH_FAST_TRY(name, k, n, whole)                                                                     \
    if (c->kernel == (k) && power == (n) && sph_is_total(c) == (whole)) {                                   \
        solid_##name(&sim->fac, t, sph_solid_scratch_of(sim, t), homes);                                    \
        return;                                                                                             \
    }
        SPH_FAST_SOLIDS(SPH_FAST_TRY)
#undef SPH_FAST_TRY
    }
#endif
    if (!solid && role == SPH_ROLE_FLUID && SPH_IS(c->scheme, STANDARD) && c->beta == 0 && c->xsph == 0 && !c->books) {
#define SPH_FAST_TRY(name, k, visc, diff)                                                                   \
    if (c->kernel == (k) && c->viscosity == (visc) && c->diffusion == (diff)) {                             \
        force_##name(&sim->fac, t, homes);                                                                  \
        return;                                                                                             \
    }
        SPH_FAST_LIST(SPH_FAST_TRY)
#undef SPH_FAST_TRY
    }
#endif
    const choice ch = {c->kernel, c->scheme, c->viscosity, c->diffusion, c->beta != 0, sph_uses_xsph(c) && !hat,
                       sph_keeps_books(c), solid, sph_is_total(c), hat, power};
    for (uint32_t h = 0; h < homes; h++) {
        if (role != SPH_ROLE_FLUID && !sph_is_body(&sim->set[t->home_set[h]]))
            continue;
#if SPH_HAS_FORCE_WALLS
        if (role == SPH_ROLE_FORCE_WALL) {
            sph_force_walls(sim, t, h);
            continue;
        }
#endif
#if SPH_WITH_SOLID
        if (solid) {
            force_solid(&ch, &sim->fac, t, sph_solid_scratch_of(sim, t), h, role == SPH_ROLE_GHOST);
            continue;
        }
#endif
        force_any(&ch, &sim->fac, t, h, role == SPH_ROLE_GHOST);
    }
}

static bool is_force_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_body(s) || (s->role == SPH_ROLE_GHOST && s->compressible && s->kind == SPH_WALL_GHOST);
}

SPH_INLINE sph_real larger(sph_real a, sph_real b) { return a < b ? b : a; }

/* what the scene asked for besides forces: XSPH velocity, boundary forces, the body force, powers for the books */
static void finish_extras(sph_sim *sim, sph_thread *t, uint32_t h, sph_real *acc)
{
    const factors *f = &sim->fac;
    const sph_config *c = &sim->cfg;
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h], o = sph_sum_shift(c);
    sph_real body = 0;
    if (sph_uses_xsph(c) && !sph_smooths_strain(c))
        for (uint32_t k = 0; k < SPH_DIM; k++)
            b->xsph[k][i] = v_fold(t->sum[SUM_XSPH + o + k][h]) * (f->value * (sph_real)(2 * c->xsph));
    if (SPH_HAS_FORCE_WALLS && sim->has_force_wall)
        for (uint32_t k = 0; k < SPH_DIM; k++)
            acc[k] += t->sum[SUM_FORCE + o][h][k];
    if (SPH_WITH_BODY_FORCE && c->body_force) {
        double x[SPH_DIM], v[SPH_DIM], add[SPH_DIM];
        for (int k = 0; k < SPH_DIM; k++) {
            x[k] = c->lo[k] + (double)b->pos[k][i] * sim->grid.quantum;
            v[k] = (double)t->home.v[k][h];
            add[k] = 0;
        }
        c->body_force(c->body_ctx, sim->next.time, x, v, add);
        for (int k = 0; k < SPH_DIM; k++) {
            acc[k] += (sph_real)add[k];
            body += (sph_real)add[k] * t->home.v[k][h];
        }
    }
    if (sph_keeps_books(c)) { /* powers per unit mass of this particle */
        sim->power[0][i] = v_fold(t->sum[SUM_VISC + o][h]) * f->slope;
        sim->power[1][i] = t->sum[SUM_FORCE + o][h][SPH_DIM] - v_fold(t->sum[SUM_WALL + o][h]) * f->slope;
        sim->power[2][i] = v_fold(t->sum[SUM_DIFF + o][h]) * f->slope;
        sim->power[3][i] = body;
    }
}

#if SPH_HAS_HELD
/* along the axes on which a set is held it feels no force; what moves it does work against it (and on its inertia: step.c) */
static void hold(sph_sim *sim, const sph_set *set, uint32_t i, sph_real *acc)
{
    const uint32_t held = sph_held(sim, set);
    for (uint32_t k = 0; k < SPH_DIM; k++) {
        if (!(held >> k & 1))
            continue;
        if (sph_keeps_books(&sim->cfg))
            sim->power[1][i] -= acc[k] * (sph_real)sph_wall_velocity(sim, set, k);
        acc[k] = 0;
        if (sph_uses_xsph(&sim->cfg))
            sim->buf[sim->dst].xsph[k][i] = 0;
    }
}
#endif

/* forces and rates of one particle from its sums */
static void force_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const factors *f = &sim->fac;
    const sph_buffer *b = &sim->buf[sim->dst];
    const uint32_t i = t->home_at[h];
    const sph_set *set = &sim->set[t->home_set[h]];
    sph_real acc[SPH_DIM], a2 = 0, v2 = 0;
    sph_real d = v_fold(t->sum[SUM_DRHO][h]) * f->slope * set->inv_rho0_r;
    if (f->rate_by_density)
        d *= t->home.rho[h];
#if SPH_WITH_SOLID
    if (sph_has_solids(&sim->cfg)) {
        sph_real raw[SPH_NL];
        for (uint32_t k = 0; k < SPH_NL; k++)
            raw[k] = v_fold(t->sum[SUM_L + k][h]) * f->slope;
        d += sph_stress_rates(sim, set, i, raw, t->home.rho[h]) * t->home.rho[h] * set->inv_rho0_r;
    }
#endif
    b->drho[0][i] = d = f->continuity ? d : 0;
    if (!sph_is_body(set))
        return;
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++)
        acc[k] = f->gravity[k] - v_fold(t->sum[SUM_ACC + k][h]) * f->slope;
    if ((SPH_HAS_EXTRAS && f->extras) || (SPH_HAS_FORCE_WALLS && sim->has_force_wall))
        finish_extras(sim, t, h, acc);
#if SPH_HAS_HELD
    if (sph_held(sim, set))
        hold(sim, set, i, acc);
#endif
    SPH_UNROLL
    for (int k = 0; k < SPH_DIM; k++) {
        b->acc[k][i] = acc[k];
        a2 += acc[k] * acc[k];
        v2 += t->home.v[k][h] * t->home.v[k][h];
    }
    t->peaks.mu = larger(t->peaks.mu, v_fold_max(t->sum[SUM_MU][h]) * (2 * t->home.rho[h]));
    t->peaks.acc = larger(t->peaks.acc, a2);
    t->peaks.speed = larger(t->peaks.speed, v2);
    if (!(a2 + d * d < SPH_LIMIT_SQUARE)) /* also catches not-a-number */
        sph_fail_note(t, SPH_NOT_FINITE, sim->buf[sim->src].id[0][b->id[0][i]], (double)a2);
}

static void force_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_config *c = &sim->cfg;
    const sph_sweep w = {is_force_home,
                         SPH_BODIES | 1u << SPH_ROLE_GHOST | 1u << SPH_ROLE_FORCE_WALL,
                         sph_sum_shift(c) + (sph_keeps_books(c) || sim->has_force_wall ? SUM_FORCE + 1 : sph_uses_xsph(c) ? SUM_VISC : SUM_XSPH),
                         sph_diffusive(c->diffusion) || sph_weak_scheme(c->scheme),
                         sph_has_solids(c) ? SPH_COL_STRESS | (sph_is_total(c) ? SPH_COL_REFERENCE : 0u) |
                                                 (sph_smooths_strain(c) ? SPH_COL_SMOOTHED : 0u) : 0,
                         force_tile,
                         force_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}

static sph_status force_end(sph_sim *sim)
{
    sim->next.peaks = (sph_peaks){sim->peaks.mu, SPH_SQRT(sim->peaks.acc), SPH_SQRT(sim->peaks.speed)};
    return SPH_OK;
}
const sph_pass sph_pass_force = {"force", sph_sweep_chunks, force_chunk, force_end, NULL};

/* ---- density by summation (Gray 2001 eq 2.19) and the Shepard filter (Wickramarachchi 2009 eq 6.3) ---- */

#if SPH_HAS_FILTERS

enum { SUM_MW, SUM_VW };

static bool fluid_home(const sph_sim *sim, const sph_set *s)
{
    (void)sim;
    return sph_is_body(s);
}

SPH_INLINE void density_tile(uint32_t kernel, const factors *f, sph_thread *th, uint32_t h, const sph_tile *t)
{
    const home o = spread_home(&th->home, h);
    vreal mw[SPH_NV], vw[SPH_NV];
    for (int k = 0; k < SPH_NV; k++) {
        mw[k] = v_load(th->sum[SUM_MW][h] + k * SPH_W);
        vw[k] = v_load(th->sum[SUM_VW][h] + k * SPH_W);
    }
    for (uint32_t j = 0; j < t->n; j += SPH_LANES)
        for (uint32_t k = 0; k < SPH_NV; k++) {
            vreal dx[SPH_DIM];
            SPH_UNROLL
            for (int a = 0; a < SPH_DIM; a++)
                dx[a] = o.x[a] - v_load(t->x[a] + j + k * SPH_W);
            const vreal w = k_value(kernel, v_sqrt(dot(dx, dx)) * f->inv_h) * v_load(t->m + j + k * SPH_W);
            mw[k] = mw[k] + w;
            vw[k] = vw[k] + w * v_load(t->iv + j + k * SPH_W);
        }
    for (int k = 0; k < SPH_NV; k++) {
        v_store(th->sum[SUM_MW][h] + k * SPH_W, mw[k]);
        v_store(th->sum[SUM_VW][h] + k * SPH_W, vw[k]);
    }
}

static void density_add(const sph_sim *sim, sph_thread *t, uint32_t homes, uint32_t role)
{
    for (uint32_t h = 0; h < homes; h++)
        density_tile(sim->cfg.kernel, &sim->fac, t, h, role == SPH_ROLE_GHOST ? &t->ghost : &t->fluid);
}

#if SPH_WITH_SUMMATION
static void summation_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_real rho0 = sim->set[t->home_set[h]].rho0_r;
    sim->tmp[t->home_at[h]] = (v_fold(t->sum[SUM_MW][h]) * sim->fac.value - rho0) / rho0;
}
static void summation_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    static const sph_sweep w = {fluid_home, SPH_BODIES | 1u << SPH_ROLE_GHOST, 2, true, 0, density_add, summation_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}

static bool sums_density(const sph_sim *sim) { return sph_sums_density(&sim->cfg); }
const sph_pass sph_pass_summation = {"summation", sph_sweep_chunks, summation_chunk, NULL, sums_density};
#endif

#if SPH_WITH_SHEPARD
static void shepard_finish(sph_sim *sim, sph_thread *t, uint32_t h)
{
    const sph_real rho0 = sim->set[t->home_set[h]].rho0_r;
    /* the particle itself is in both sums, so the lower one is never 0 */
    sim->tmp[t->home_at[h]] = (v_fold(t->sum[SUM_MW][h]) / v_fold(t->sum[SUM_VW][h]) - rho0) / rho0;
}
static void shepard_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    static const sph_sweep w = {fluid_home, SPH_BODIES, 2, true, 0, density_add, shepard_finish};
    sph_sweep_chunk(sim, &w, chunk, t);
}

static bool filters_now(const sph_sim *sim)
{
    return sim->cfg.shepard_every && sim->next.step && sim->next.step % sim->cfg.shepard_every == 0;
}
const sph_pass sph_pass_shepard = {"shepard", sph_sweep_chunks, shepard_chunk, NULL, filters_now};
#endif

/* the filtered density becomes the density; in its own pass, because neighbours read the old one */
static void copy_density_chunk(sph_sim *sim, uint32_t chunk, sph_thread *t)
{
    const sph_buffer *b = &sim->buf[sim->dst];
    uint32_t last = (chunk + 1) * SPH_LOCAL_CHUNK < sim->next.count ? (chunk + 1) * SPH_LOCAL_CHUNK : sim->next.count;
    for (uint32_t i = chunk * SPH_LOCAL_CHUNK; i < last; i++)
        if (b->set[0][i] != SPH_DEAD && sph_is_body(&sim->set[b->set[0][i]]))
            b->rho[0][i] = sim->tmp[i];
    t->work += last - chunk * SPH_LOCAL_CHUNK;
}

static bool copies_density(const sph_sim *sim)
{
#if SPH_WITH_SHEPARD
    if (filters_now(sim))
        return true;
#endif
    return sph_sums_density(&sim->cfg);
}
const sph_pass sph_pass_copy_density = {"copy density", sph_local_chunks, copy_density_chunk, NULL, copies_density};
#endif
