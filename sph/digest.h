/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* digest.h: 64-bit digests of numbers. Values are mixed, never struct bytes, so padding and byte order do not show. */
#ifndef SPH_DIGEST_H
#define SPH_DIGEST_H

#include <stddef.h>
#include <stdint.h>

#include "name.h"

/* h with one more number in it */
#define sph_mix SPH_NAME(mix_)
uint64_t sph_mix(uint64_t h, uint64_t v);
#define sph_mix_double SPH_NAME(mix_double_)
uint64_t sph_mix_double(uint64_t h, double v);
/* with n elements of 1, 4 or 8 bytes, as numbers */
#define sph_mix_array SPH_NAME(mix_array_)
uint64_t sph_mix_array(uint64_t h, const void *p, size_t size, uint32_t n);

#endif
