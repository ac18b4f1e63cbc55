/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* hash.c: 64-bit digests of the state and of the configuration. Values are hashed, never struct bytes, so padding and byte
   order do not show. The mixer is a multiply-xorshift step (constants: the golden ratio and Steele, Lea & Flood 2014). */
#include "internal.h"

SPH_INLINE uint64_t mix(uint64_t h, uint64_t v)
{
    h = (h ^ v) * 0x9e3779b97f4a7c15u;
    h ^= h >> 32;
    h *= 0xbf58476d1ce4e5b9u;
    return h ^ (h >> 29);
}

/* not inlined: 64-bit products are long where registers have 32 bits */
__attribute__((noinline)) uint64_t sph_mix(uint64_t h, uint64_t v) { return mix(h, v); }

__attribute__((noinline)) uint64_t sph_mix_double(uint64_t h, double v)
{
    uint64_t u;
    memcpy(&u, &v, sizeof u);
    return sph_mix(h, u);
}

/* n elements of 1, 4 or 8 bytes, as numbers */
static uint64_t mix_array(uint64_t h, const void *p, size_t size, uint32_t n)
{
    const unsigned char *b = p;
    for (uint32_t i = 0; i < n; i++) {
        uint64_t v;
        if (size == 8) {
            memcpy(&v, b + 8 * (size_t)i, 8);
        } else if (size == 4) {
            uint32_t u;
            memcpy(&u, b + 4 * (size_t)i, 4);
            v = u;
        } else {
            v = b[i];
        }
        h = mix(h, v);
    }
    return h;
}

uint64_t sph_hash_buffer(const sph_sim *sim, const sph_buffer *b, uint32_t n)
{
    uint64_t h = 0x5350482d68617368u;
    (void)sim;
#define SPH_FIELD_HASH(name, type, comps, unit, when, way)                                                       \
    for (uint32_t k = 0; k < (comps); k++)                                                                  \
        if (b->name[k])                                                                                     \
            h = mix_array(h, b->name[k], sizeof(type), n);
    SPH_STATE_FIELDS(SPH_FIELD_HASH)
#undef SPH_FIELD_HASH
    return h;
}

uint64_t sph_hash(const sph_sim *sim)
{
    if (!sim)
        return 0;
    const sph_scalars *s = &sim->now;
    uint64_t h = sph_hash_buffer(sim, &sim->buf[sim->cur], s->count);
    h = sph_mix_double(sph_mix_double(h, s->time), s->dt_last);
    h = sph_mix(sph_mix(h, s->step), s->count);
    h = sph_mix(h, (uint64_t)s->primed | (uint64_t)s->started << 1);
    h = sph_mix_double(h, (double)s->peaks.mu);
    h = sph_mix_double(h, (double)s->peaks.acc);
    for (uint32_t g = 0; g < sim->groups; g++) {
        h = sph_mix(h, s->group[g].removed);
        for (int k = 0; k < SPH_DIM; k++)
            h = sph_mix_double(sph_mix(h, (uint64_t)s->group[g].moved[k]), s->group[g].vel[k]);
    }
    for (uint32_t k = 0; k < SPH_POWERS; k++)
        h = sph_mix_double(sph_mix_double(h, s->work[k]), s->power[k]);
    return h;
}

/* The fields that a running simulation may not change; gravity, damping, dt, limits on dt and hooks are left out. The order
   is part of every dump's digest. */
#define AT(member) (uint16_t) offsetof(sph_config, member)
static const uint16_t whole_fields[] = {AT(max_particles), AT(on_leave),  AT(on_cross),  AT(kernel),        AT(scheme), AT(density),
                                        AT(eos),           AT(viscosity), AT(diffusion), AT(shepard_every), AT(integrator),
                                        AT(solid),         AT(yield),     AT(damage),    AT(max_flaws),     AT(artificial_stress),
                                        AT(stress_exponent)};
static const uint16_t real_fields[] = {AT(spacing), AT(smoothing_length), AT(rho0), AT(sound_speed), AT(alpha),
                                       AT(beta),    AT(nu),               AT(delta), AT(xsph),       AT(cfl),
                                       AT(viscous_factor), AT(force_factor), AT(gravity_factor), AT(dt_max), AT(dt_min),
                                       AT(stress_epsilon), AT(max_stretch)};
#undef AT

uint64_t sph_hash_config(const sph_config *c)
{
    const unsigned char *p = (const unsigned char *)c;
    uint64_t h = SPH_VERSION * 16u + SPH_DIM * 2u + SPH_DOUBLE;
    for (size_t i = 0; i < sizeof whole_fields / sizeof *whole_fields; i++) {
        uint32_t u;
        memcpy(&u, p + whole_fields[i], sizeof u);
        h = sph_mix(h, u);
    }
    h = sph_mix(sph_mix(sph_mix(h, c->pressure_floor), c->books), c->xsph_strain);
    for (size_t i = 0; i < sizeof real_fields / sizeof *real_fields; i++) {
        double d;
        memcpy(&d, p + real_fields[i], sizeof d);
        h = sph_mix_double(h, d);
    }
    for (int k = 0; k < SPH_DIM; k++) {
        h = sph_mix_double(sph_mix_double(h, c->lo[k]), c->hi[k]);
        h = sph_mix(h, c->face[k][0] | (uint64_t)c->face[k][1] << 8);
    }
    return h;
}
