/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* digest.c: the mixer of all digests, a multiply-xorshift step (constants: the golden ratio and Steele, Lea & Flood
   2014). */
#include "digest.h"

#include <string.h>
#include "arithmetic.h"

SPH_OBJECT(digest)

static inline uint64_t mix(uint64_t h, uint64_t v)
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

uint64_t sph_mix_array(uint64_t h, const void *p, size_t size, uint32_t n)
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
