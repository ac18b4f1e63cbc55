/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* world.h: a simulation that a string of bytes drives through the whole interface, call after call. The targets
   `particles` and `walls` differ in the calls they make often. */
#ifndef SPH_FUZZ_WORLD_H
#define SPH_FUZZ_WORLD_H

#include "fuzz.h"

typedef struct motion {
    double start, speed, jump_at, jump; /* m, m/s, s, m: a wall that drives, and once leaps */
} motion;

typedef struct world {
    input in;
    sph_sim *sim;
    void *block;
    sph_config cfg;
    double field[SPH_DIM + 1]; /* what the field function adds: velocity, density */
    motion motion[SPH_MAX_GROUPS];
    double table_t[3], table_x[3];
    sph_table table;
    uint32_t steps; /* asked for so far */
} world;

#define world_run SPH_NAME(world_run_)
void world_run(const unsigned char *data, size_t n, bool walls);

/* a call that may be refused, but then must leave the state as it was */
#define attempt(w, call)                                                                                 \
    do {                                                                                                    \
        snapshot kept_;                                                                                     \
        keep_state((w)->sim, &kept_);                                                                       \
        const sph_status st_ = (call);                                                                      \
        hold((unsigned)st_ < SPH_STATUS_COUNT);                                                             \
        if (st_ != SPH_OK && st_ != SPH_NOT_DONE)                                                           \
            hold(state_kept((w)->sim, &kept_));                                                             \
        else                                                                                                \
            free(kept_.arrays);                                                                             \
    } while (0)

/* world_add.c: fluid and walls */
#define world_add_fluid SPH_NAME(world_add_fluid_)
void world_add_fluid(world *w);
#define world_add_wall SPH_NAME(world_add_wall_)
void world_add_wall(world *w);

#endif
