/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* shock_tube.c: a gas of two states in a closed tube 0 .. 1, let go at x = 1/2 (Sod 1978; Wickramarachchi 2009, section
   4.2: density 2, 4 or 8 to 1, e = 1 on both sides), beside the exact solution (riemann.c). In 2-D the tube is periodic
   across; particles are equally far apart, and their masses differ. History: errors L1 over the gas, each a mean over
   the particles' volumes; where shock and contact are; what is to be kept. */
#define SCENE_SCHEME SPH_WEAK /* where particles have other masses than their neighbours */
#include "riemann.h"
#include "scene.h"
#if SPH_DIM < 3

enum { N = SCENE_COMMON, ACROSS, RHO_LEFT, RHO_RIGHT, E_LEFT, E_RIGHT, DURATION, PARAMS };

static const scene_param param[PARAMS] = {
    SCENE_PARAMS_OF(SPH_WENDLAND_C2, 2, SPH_IDEAL_GAS, SPH_ARTIFICIAL_APPROACHING, 1.5, SPH_NO_DIFFUSION, SCENE_ADAMI,
                    1, 0, 1, SPH_KICK_DRIFT_KICK, 0.3, 0),
    {"n", "-", "particles along the tube", 200, 20, 100000, SCENE_WHOLE},
    {"across", "-", "rows of particles across (2-D); 0: as many as along", 24, 0, 100000, SCENE_WHOLE},
    {"rho_left", "kg/m^3", "density on the left", 1, 1e-6, 1e6, SCENE_NUMBER},
    {"rho_right", "kg/m^3", "density on the right", 0.125, 1e-6, 1e6, SCENE_NUMBER},
    {"e_left", "J/kg", "energy on the left", 2.5, 1e-6, 1e6, SCENE_NUMBER},
    {"e_right", "J/kg", "energy on the right", 2, 1e-6, 1e6, SCENE_NUMBER},
    {"duration", "s", "length of the run", 0.2, 0, 100, SCENE_NUMBER},
};

static double spacing(const double *p) { return 1 / p[N]; }
static double gamma_of(const double *p) { return p[SCENE_OF_gamma]; }
static double sound(const double *p, double e) { return __builtin_sqrt(gamma_of(p) * (gamma_of(p) - 1) * e); }

/* rows across, at least as many as a periodic axis takes */
static double across(const double *p)
{
    const double widest = p[SCENE_OF_variable_h] > 0 ? p[SCENE_OF_h_max] : 1;
    const double least = 3 * sph_kernel_support((uint32_t)p[SCENE_KERNEL]) * p[SCENE_H] * widest + 1;
    const double rows = p[ACROSS] > 0 ? p[ACROSS] : p[N];
    return SPH_DIM == 1 ? 1 : rows < least ? (double)(int64_t)(least + 1) : rows;
}

static void configure(const double *p, sph_config *c)
{
    *c = scene_config(p, spacing(p), p[RHO_LEFT], sound(p, p[E_LEFT]));
    c->energy = c->energy || c->eos == SPH_IDEAL_GAS; /* which cannot do without */
    for (int k = 0; k < SPH_DIM; k++) {
        c->lo[k] = 0;
        c->hi[k] = k ? across(p) * spacing(p) : 1;
        c->face[k][0] = c->face[k][1] = k ? SPH_PERIODIC : SPH_SYMMETRY;
    }
    c->max_particles = scene_capacity((p[N] + 1) * across(p));
}

static sph_status build(sph_sim *sim, const double *p)
{
    const double dx = spacing(p), half = (double)(int64_t)(0.5 * p[N]) * dx;
    double lo[SPH_DIM] = {0}, hi[SPH_DIM];
    sph_fluid right = {0};
    uint32_t set;
    sph_status st;
    for (int k = 0; k < SPH_DIM; k++)
        hi[k] = k ? across(p) * dx : half;
    if ((st = sph_add_fluid(sim, NULL, &set)) != SPH_OK || (st = sph_add_box(sim, set, lo, hi, NULL)) != SPH_OK)
        return st;
    right.rho0 = p[RHO_RIGHT];
    right.sound_speed = sound(p, p[E_RIGHT]);
    lo[0] = half;
    hi[0] = 1;
    return (st = sph_add_fluid(sim, &right, &set)) != SPH_OK ? st : sph_add_box(sim, set, lo, hi, NULL);
}

static double end(const double *p) { return p[DURATION]; }

static riemann exact(const double *p)
{
    const double g = gamma_of(p);
    return riemann_solve(g, (gas_state){p[RHO_LEFT], 0, (g - 1) * p[RHO_LEFT] * p[E_LEFT]},
                         (gas_state){p[RHO_RIGHT], 0, (g - 1) * p[RHO_RIGHT] * p[E_RIGHT]});
}

/* what a history row says of the particles */
typedef struct tube {
    double volume, l1[4];      /* of density, pressure, velocity, energy */
    double left, right, shock; /* the contact from both sides; the shock where half of the velocity is reached */
    double entropy, least;     /* sum m ln(p/rho^gamma) less that of the start; the least of a particle */
} tube;

static void add_particle(const double *p, const riemann *r, double t, const sph_particle *q, tube *o)
{
    const double s = t > 0 ? (q->x[0] - 0.5) / t : q->x[0] < 0.5 ? -1e300 : 1e300, g = gamma_of(p);
    const gas_state x = riemann_at(r, s);
    const double e = x.p / ((g - 1) * x.rho), v = q->mass / q->rho;
    const double off[4] = {q->rho - x.rho, q->p - x.p, q->v[0] - x.v, q->energy - e};
    const bool is_right = q->set != 0;
    const double rho0 = p[is_right ? RHO_RIGHT : RHO_LEFT], e0 = p[is_right ? E_RIGHT : E_LEFT];
    const double risen = sph_log(q->energy / e0) - (g - 1) * sph_log(q->rho / rho0);
    for (int k = 0; k < 4; k++)
        o->l1[k] += v * SCENE_ABS(off[k]);
    o->volume += v;
    o->entropy += q->mass * risen;
    o->least = risen < o->least ? risen : o->least;
    if (!is_right && q->x[0] > o->left)
        o->left = q->x[0];
    if (is_right && q->x[0] < o->right)
        o->right = q->x[0];
    if (q->x[0] > o->shock && q->v[0] > 0.5 * r->v)
        o->shock = q->x[0];
}

static const char *const column[] = {
    "time_s",        "L1_density_kg/m^3", "L1_pressure_Pa",  "L1_velocity_m/s", "L1_energy_J/kg",   "contact_m",
    "contact_exact_m", "shock_m",         "shock_exact_m",   "mass_kg",         "momentum_less_push_kg.m/s",
    "energy_of_gas_J", "entropy_rise_J/K", "entropy_least_-"};

static void history(const sph_sim *sim, const double *p, double *row)
{
    const double t = sph_time(sim), g = gamma_of(p);
    const riemann r = exact(p);
    tube o = {.right = 1, .shock = 0};
    sph_totals a;
    sph_particle q;
    sph_get_totals(sim, &a);
    for (uint32_t i = 0; i < sph_count(sim); i++)
        if (sph_get(sim, i, &q) == SPH_OK)
            add_particle(p, &r, t, &q, &o);
    /* until waves reach them the ends push with the pressures of the start */
    const double push = (g - 1) * (p[RHO_LEFT] * p[E_LEFT] - p[RHO_RIGHT] * p[E_RIGHT]) *
                        (SPH_DIM == 2 ? across(p) * spacing(p) : 1);
    row[0] = t;
    for (int k = 0; k < 4; k++)
        row[1 + k] = o.volume > 0 ? o.l1[k] / o.volume : 0;
    row[5] = 0.5 * (o.left + o.right);
    row[6] = 0.5 + r.v * t;
    row[7] = t > 0 ? o.shock : 0.5;
    row[8] = 0.5 + r.wave[1][0] * t;
    row[9] = a.mass;
    row[10] = a.momentum[0] - push * t;
    row[11] = a.kinetic + a.internal;
    row[12] = o.entropy;
    row[13] = o.least;
}

/* in 1-D `sod`, in 2-D `shock_tube` */
#if SPH_DIM == 1
#define TUBE "sod"
#define scene_tube SPH_NAME(scene_sod)
#else
#define TUBE "shock_tube"
#define scene_tube SPH_NAME(scene_shock_tube)
#endif
extern const scene scene_tube;
const scene scene_tube = {TUBE, "a gas of two states in a tube (Sod 1978; Wickramarachchi 2009, 4.2)", param, PARAMS,
                          configure, build, end, sizeof column / sizeof *column, column, history, scene_si};
#endif
