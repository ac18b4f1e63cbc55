/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* bodies.c: sets of what moves by forces: fluids and solids, with their materials. Runs between steps only. */
#include "dmath.h"
#include "setup.h"
#include "arithmetic.h"

SPH_OBJECT(bodies)

/* 0, which asks for a default, or between 1/most and most, whose squares and quotients stay in a double's range */
static __attribute__((noinline)) sph_status check_positive(sph_sim *sim, const char *what, double v, float most)
{
    if (v == 0 || (v >= 1 / (double)most && v <= (double)most))
        return SPH_OK;
    return sph_setup_bad(sim, what, most > 1e20f ? "0 or 1e-30 .. 1e30" : "0 or 1e-15 .. 1e15", v);
}

static bool same(double a, double b) { return !(a < b) && !(b < a); }

/* whom a new set is of one material with, and whether the scene's sums must ask that of pairs */
static void find_kin(sph_sim *sim, sph_set *s)
{
    if (!SPH_WITH_SEVERAL_FLUIDS)
        return;
    const sph_config *c = &sim->cfg;
    s->kin = 0;
    while (&sim->set[s->kin] < s) {
        const sph_set *o = &sim->set[s->kin];
        if (sph_is_matter(o) && o->role == s->role && o->eos == s->eos && same(o->rho0, s->rho0) && same(o->c0, s->c0))
            break;
        s->kin++;
    }
    for (const sph_set *o = sim->set; o < s; o++)
        sim->mixed |= sph_is_matter(o) && o->kin != s->kin;
    sim->own_sound |= !same(s->c0, c->sound_speed);
    sim->mixed |= sim->own_sound || !same(s->rho0, c->rho0) || SPH_IS(s->eos, TAIT_GRAY) != SPH_IS(c->eos, TAIT_GRAY);
}

/* begins a set of fluid or solid: what both have; *out is the place for the rest, or stays null */
static sph_status begin_body(sph_sim *sim, bool solid, const sph_fluid *f, uint32_t *set, sph_set **out)
{
    const char *const call = solid ? "sph_add_solid" : "sph_add_fluid";
    sph_status st = sph_setup_idle(sim, call);
    if (st)
        return st;
    if (!set)
        return sph_setup_bad(sim, "set", "a place for the set's number", 0);
    if ((st = check_positive(sim, solid ? "solid.mass" : "fluid.mass", f->mass, 1e30f)) != SPH_OK ||
        (st = check_positive(sim, solid ? "solid.rho0" : "fluid.rho0", f->rho0, 1e30f)) != SPH_OK ||
        (st = check_positive(sim, solid ? "solid.sound_speed" : "fluid.sound_speed", f->sound_speed, 1e15f)) != SPH_OK)
        return st;
    if (!SPH_WITH_SEVERAL_FLUIDS && f->rho0 + f->sound_speed > 0)
        return sph_setup_bad(sim, "rho0, sound_speed", "0 (modules.h)", f->rho0);
    if (f->own_eos && (!SPH_WITH_SOLID || !sph_in(SPH_EOSES_IN, f->eos)))
        return sph_setup_bad(sim, "eos", "one of SPH_TAIT .. SPH_ISOTHERMAL, compiled in (modules.h)", f->eos);
    if (sim->sets == sim->cfg.max_sets)
        return sph_error(sim, SPH_TOO_MANY_SETS, "sets", "at most max_sets", sim->sets, SPH_NO_PARTICLE);
    sph_set *s = &sim->set[sim->sets];
    memset(s, 0, sizeof *s);
    s->group = SPH_MAX_GROUPS;
    s->eos = (uint8_t)(SPH_WITH_SOLID && f->own_eos ? f->eos : sim->cfg.eos);
    s->rho0 = f->rho0 > 0 ? f->rho0 : sim->cfg.rho0;
    s->c0 = f->sound_speed > 0 ? f->sound_speed : sim->cfg.sound_speed;
    s->mass = f->mass > 0 ? f->mass : s->rho0 * sph_setup_cell_volume(sim);
    *out = s;
    return SPH_OK;
}

sph_status sph_add_fluid(sph_sim *sim, const sph_fluid *f, uint32_t *set)
{
    static const sph_fluid usual = {0, 0, 0, false, 0};
    sph_set *s = NULL;
    const sph_status st = begin_body(sim, false, f ? f : &usual, set, &s);
    if (!s)
        return st;
    s->role = SPH_ROLE_FLUID;
    sph_setup_finish_set(sim, s);
    find_kin(sim, s);
    *set = sim->sets++;
    return SPH_OK;
}

#if SPH_WITH_SOLID
/* what sph_add_solid asks of a material beyond a fluid's */
static sph_status check_solid(sph_sim *sim, const sph_solid *m)
{
    const struct {
        const char *what;
        double v;
    } real[] = {{"shear", m->shear},
                {"yield", m->yield},
                {"hardening", m->hardening},
                {"crack_speed", m->crack_speed},
                {"flaw_radius", m->flaw_radius}};
    if (!sph_has_solids(&sim->cfg))
        return sph_setup_bad(sim, "solid", "a configuration with a solid form", sim->cfg.solid);
    for (size_t i = 0; i < sizeof real / sizeof *real; i++)
        if (!(real[i].v >= 0 && real[i].v < 1e30))
            return sph_setup_bad(sim, real[i].what, "0 .. 1e30", real[i].v);
    if (m->yield > 0 && (!sph_yields(&sim->cfg) || !(m->shear > 0)))
        return sph_setup_bad(sim, "yield", "0, or a configuration with yield and shear > 0", m->yield);
    if (sph_damages(&sim->cfg) && !(m->shear > 0))
        return sph_setup_bad(sim, "shear", "> 0 with damage", m->shear);
    if (m->flat_faces && !sph_weighs_faces(&sim->cfg))
        return sph_setup_bad(sim, "flat_faces", "false, or a configuration with face_quadrature", 1);
    if (m->body > 255)
        return sph_setup_bad(sim, "body", "0 .. 255", m->body);
    if (m->held >> SPH_DIM || (m->held && !SPH_HAS_HELD))
        return sph_setup_bad(sim, "held", SPH_HAS_HELD ? "bits of axes" : "0: held sets were left out (modules.h)",
                             m->held);
    if (m->motion && !m->held)
        return sph_setup_bad(sim, "motion", "null, or held along an axis", 1);
    if (m->held && sim->groups == SPH_MAX_GROUPS)
        return sph_error(sim, SPH_TOO_MANY_SETS, "wall groups and held sets", "at most SPH_MAX_GROUPS", sim->groups,
                         SPH_NO_PARTICLE);
    return SPH_OK;
}

/* of the disc or ball with a particle's volume */
static double radius_of(double volume)
{
    const double pi = 3.14159265358979323846;
    return SPH_DIM == 3 ? sph_pow(volume * 3 / (4 * pi), 1.0 / 3) : __builtin_sqrt(volume / pi);
}

sph_status sph_add_solid(sph_sim *sim, const sph_solid *m, uint32_t *set, uint32_t *group)
{
    sph_set *s = NULL;
    if (!sim || !m)
        return sph_setup_bad(sim, "solid", "a material", 0);
    const sph_fluid as_fluid = {m->mass, m->rho0, m->sound_speed, true, SPH_LINEAR};
    sph_status st = begin_body(sim, true, &as_fluid, set, &s);
    if (!s || (st = check_solid(sim, m)) != SPH_OK)
        return st;
    s->role = SPH_ROLE_SOLID;
    sph_material *rock = &sim->material[sim->sets];
    *rock = (sph_material){m->shear, m->yield, m->hardening, 0, (sph_real)m->shear, m->body, m->held,
                           m->flat_faces};
    const double radius = m->flaw_radius > 0 ? m->flaw_radius : radius_of(s->mass / s->rho0);
    rock->crack_rate = (m->crack_speed > 0 ? m->crack_speed : 0.4 * s->c0) / radius;
    if (m->held)
        s->group = sph_setup_add_group(sim, m->motion, m->motion_ctx);
    if (group)
        *group = s->group;
    sim->setup_hash = sph_mix(sim->setup_hash, (uint64_t)m->body | (uint64_t)m->held << 8 |
                                                    (uint64_t)m->flat_faces << 16);
    const double v[] = {rock->shear, rock->yield, rock->hardening, rock->crack_rate};
    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        sim->setup_hash = sph_mix_double(sim->setup_hash, v[i]);
    sph_setup_finish_set(sim, s);
    find_kin(sim, s);
    *set = sim->sets++;
    return SPH_OK;
}
#endif
