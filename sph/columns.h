/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* columns.h: the list of column sets: what modules' candidates bring into a tile beside the columns of every tile (x,
   v, m, rho, press, 1/rho; sweep.h). Scratch holds only the sets that the scene wants.
     name, 1 if of ghosts (else of matter and homes), rows, knob, condition on the configuration `c`
   The loader is sph_load_<name>; columns.c makes the table. */
#ifndef SPH_COLUMNS_H
#define SPH_COLUMNS_H

#ifndef SPH_EXTRA_COLUMNS /* tests/extra_columns.h adds one */
#define SPH_EXTRA_COLUMNS(X)
#endif
#define SPH_COLUMN_SETS(X)                                                                                         \
    X(mirror, 1, 2 * SPH_DIM + 2, SPH_HAS_LAYERED_WALLS, true)                                                     \
    X(stress, 0, SPH_NL + SPH_NT, SPH_WITH_SOLID, sph_has_solids(c))                                               \
    X(reference, 0, SPH_DIM + 1, SPH_HAS_TOTAL, sph_is_total(c))                                                   \
    X(quadrature, 0, 2, SPH_HAS_QUADRATURE, sph_weighs_faces(c))                                                   \
    X(cover, 0, 1, SPH_HAS_QUADRATURE, sph_weighs_faces(c))                                                        \
    X(diagonal, 0, SPH_DIM, SPH_HAS_STABILISED, sph_stabilises(c))                                                 \
    X(edge, 0, SPH_DIM + 2, SPH_HAS_STABILISED, sph_stabilises(c))                                                 \
    X(drawn, 0, SPH_DIM + 1, SPH_HAS_STABILISED, sph_stabilises(c))                                                \
    X(means, 0, 2 * SPH_DIM, SPH_HAS_STABILISED, sph_stabilises(c))                                                \
    X(deform, 0, SPH_NL + 1, SPH_HAS_HOURGLASS, sph_resists_hourglass(c))                                          \
    X(smoothed, 0, SPH_DIM, SPH_HAS_HAT, sph_smooths_strain(c))                                                    \
    X(gradient, 0, SPH_NT, SPH_HAS_FLUID_GRADIENT, sph_corrects_fluids(c))                                         \
    X(density_gradient, 0, SPH_DIM, SPH_WITH_ANTUONO, sph_takes_density_gradient(c))                               \
    X(shear, 0, SPH_NL + 1, SPH_WITH_SHEAR, sph_shears(c))                                                          \
    X(energy, 0, 1, SPH_WITH_ENERGY, sph_has_energy(c))                                                            \
    X(wide, 0, 1, SPH_WITH_VARIABLE_H, sph_varies_h(c))                                                            \
    SPH_EXTRA_COLUMNS(X)

enum {
#define SPH_COLUMN_ENUM(name, ghosts, rows, knob, when) SPH_COLUMN_##name,
    SPH_COLUMN_SETS(SPH_COLUMN_ENUM)
#undef SPH_COLUMN_ENUM
        SPH_COLUMN_COUNT
};

#endif
