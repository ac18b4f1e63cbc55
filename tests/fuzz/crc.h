/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* crc.h: the CRC-32 of dumps (IEEE 802.3), written apart from stream.c, to put the checksums of a changed
   dump right again. */
#ifndef SPH_TEST_CRC_H
#define SPH_TEST_CRC_H

#include <stddef.h>
#include <stdint.h>

static inline uint32_t crc_of(uint32_t crc, const unsigned char *p, size_t n)
{
    static uint32_t table[256];
    for (uint32_t i = 0; i < 256 && !table[255]; i++) {
        uint32_t r = i;
        for (int k = 0; k < 8; k++)
            r = r & 1 ? r >> 1 ^ 0xedb88320u : r >> 1;
        table[i] = r;
    }
    crc = ~crc;
    for (size_t i = 0; i < n; i++)
        crc = crc >> 8 ^ table[(crc ^ p[i]) & 255];
    return ~crc;
}
static inline void crc_put(unsigned char *p, uint32_t v)
{
    for (int i = 0; i < 4; i++)
        p[i] = (unsigned char)(v >> 8 * i);
}
static inline uint32_t crc_get(const unsigned char *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

#endif
