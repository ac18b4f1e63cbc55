/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* run.h: a run of `sph run`: its options, the simulation, the files that it writes (run_files.c), the dump it goes on
   from (run_restore.c). */
#ifndef RUN_H
#define RUN_H

#include <stdio.h>

#include "../port/posix.h"
#include "build.h"
#include "gauges.h"
#include "output.h"

enum { DUMP_KIND_FULL, DUMP_KIND_PICTURE, DUMP_KIND_NONE };
enum { MOST_PARAMS = 128, FRAMES = 20 };
#define MOST_FRAMES 1e9

typedef struct run {
    const build *b;
    build_scene scene;
    uint32_t index;
    double p[MOST_PARAMS];
    bool given[MOST_PARAMS]; /* on the command line */
    build_sim *sim;
    port_posix pool;
    bool has_pool;

    /* options; text is null where the option was not given */
    bool is_double, hash;
    uint64_t threads, steps, frames;
    double end, every;
    uint32_t dump;
    const char *prefix, *out, *restore, *stage_name, *cost;
    gauges extra;

    /* files */
    output history, stage, costs; /* history: of no output where nobody reads it */
    char *history_name;
    char *before; /* the history that goes on, null if there is none */
    double before_time; /* of its last row */
    uint32_t column[MOST_COLUMNS], columns; /* numbers of those that are written; behind them stand those of extra */
    uint64_t frame;   /* of the last row: its time in units of every */
    uint64_t number;  /* the least number that the next dump may have */

    uint64_t first_step, limit_steps[SPH_LIMITS], particle_steps, pairs;
    double first_time;
    double thinnest, densest, thin_time, dense_time; /* rho/rho0 of the fluid, least and most so far, and when */
    uint64_t began, stepping, last_line; /* ns */
} run;

/* Opens what the run shall write; touches nothing. False after a message. */
bool run_open_files(run *r);
/* The scene stands, r->first_time and r->every are known: from here on the files are written. *skip: the state at hand
   has its row already. False after a message. */
bool run_begin_files(run *r, bool *skip);
bool run_write_frame(run *r);
/* which row a time belongs to */
uint64_t run_frame_of(const run *r, double time);
/* PREFIX_what.sph, whole; prints its name */
bool run_write_state(run *r, const char *what);
void run_log_stage(void *ctx, uint64_t step, const char *pass, uint64_t hash);
/* The end of all of them; what was written so far stays, if the run began at all. */
bool run_close_files(run *r, bool keep);

/* Brings the simulation to the state of the dump r->restore, options that may change as they were given, else as the
   dump has them (and in r->p). False after a message that says what differs, by name and value. */
bool run_restore(run *r);

#endif
