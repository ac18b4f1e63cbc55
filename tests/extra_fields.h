/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* extra_fields.h: state fields of every way that the list in sph/fields.h knows, with one component and with one an
   axis. The compiler includes it before every file of the kernel that test_lists.c is linked with; nothing else names
   them. */
#ifndef SPH_EXTRA_FIELDS_H
#define SPH_EXTRA_FIELDS_H

#define SPH_EXTRA_FIELDS(X)                                                                                        \
    X(tag, sph_real, 1, "1", true, SPH_CARRIED)                                                                    \
    X(tags, sph_real, SPH_DIM, "1", true, SPH_CARRIED)                                                             \
    X(label, uint32_t, 1, "1", true, SPH_CARRIED)                                                                  \
    X(letter, uint8_t, 1, "1", true, SPH_CARRIED)                                                                  \
    X(share, sph_real, 1, "1", true, SPH_CARRIED | SPH_SHARE)                                                      \
    X(way_x, sph_pos, 1, "quantum", true, SPH_DISPLACED)                                                           \
    X(way, sph_pos, SPH_DIM, "quantum", true, SPH_DISPLACED)                                                       \
    X(heat, sph_real, 1, "J/kg", true, SPH_EVOLVES(dheat))                                                         \
    X(dheat, sph_real, 1, "W/kg", true, SPH_RATE)                                                                  \
    X(colours, sph_real, SPH_DIM, "1", true, SPH_EVOLVES(dcolours))                                                \
    X(dcolours, sph_real, SPH_DIM, "1/s", true, SPH_RATE)                                                          \
    X(rate, sph_real, 1, "1/s", true, SPH_RATE)                                                                    \
    X(rates, sph_real, SPH_DIM, "1/s", true, SPH_RATE)                                                             \
    X(sum, sph_real, 1, "1", true, SPH_SUMMED)                                                                     \
    X(absent, sph_real, SPH_DIM, "1", false, SPH_CARRIED)

#endif
