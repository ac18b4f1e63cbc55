/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* output.h: the one place where files are opened, written and what went wrong with them is said.

   A command opens all its outputs first: that touches nothing under their names. What it then has to say is gathered
   in memory through `f`; output_flush and output_close bring it to the disk, and say the reason when that fails.

   A file is written beside its name and put under it when it is complete (output_close), or, if it shall grow while the
   command runs, from output_begin on. A piece that does not fit is taken back whole, and what was flushed before it
   stays. Of links the file they point to is written; devices and pipes (and whatever is named below /dev) are written
   to as they are. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct output {
    FILE *f; /* in memory; null: not open */
    const char *name;
    /* the rest is output.c's */
    const char *option;
    char *path, *tmp, *text;
    size_t size;
    long long good; /* bytes on the disk that are whole */
    int fd;
    bool failed, grows, ready;
    struct output *next;
} output;

/* option: "out" of out=NAME, for messages. False after one: the file cannot be written, or another open output is the
   same file. name and option stay the caller's. */
bool output_open(output *o, const char *option, const char *name);
/* standard output as an output; nothing is refused */
void output_standard(output *o);
bool output_is_file(const output *o); /* not a device, a pipe or standard output */

/* From here on the file stands under its name and grows with every flush. */
bool output_begin(output *o);
/* What was gathered, to the disk; all of it or nothing. False after a message, once: later calls say nothing. */
bool output_flush(output *o);
/* a sink of bytes (sph_sink), ctx an output: gathers, and flushes now and then */
bool output_sink(void *ctx, const void *bytes, size_t n);

/* The end in two steps, for several files that belong together: everything is on the disk; it gets its name. */
bool output_ready(output *o);
bool output_put(output *o);
/* Both. keep false: what is not under its name yet is removed. True if it was kept, or was not to be. Of an output that
   is not open: nothing. */
bool output_close(output *o, bool keep);
/* n outputs: all get their names once all are ready, or none does */
bool output_close_all(output *o, size_t n, bool keep);

#endif
