/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* studies.h: the tables of tests/lab in memory: runs of a scene with their errors and costs.

   A study is a CSV file with lines `# key: text` before its column names; those with `# study:` and `# scene:` are
   studies. A cell may stand in double quotes. Numbers may be missing: a run that blew up has no error. */
#ifndef STUDIES_H
#define STUDIES_H

#include <stdbool.h>
#include <stdint.h>

enum {
    STUDY_N,
    STUDY_X,
    STUDY_ERROR,
    STUDY_STEPS,
    STUDY_PARTICLE_STEPS,
    STUDY_PAIRS,
    STUDY_INSTRUCTIONS,
    STUDY_ENDED,
    STUDY_NUMBERS
};

typedef struct study_run {
    const char *sweep, *label, *cause, *options;
    double number[STUDY_NUMBERS]; /* negative: not given */
    bool is_double;
    unsigned long line; /* in the file */
    bool lucky;         /* the other sizes of its label do not bear its error out: see studies_lucky */
} study_run;

/* Is a's error by luck, by what the same method gave with other pairs? A finer run that is more than twice as wrong
   says so, and a coarser one from which the error would have had to fall by more than twice what the fourth order in
   2-D gives: pairs go as n^3 there, so the error as pairs^(-4/3). */
bool studies_lucky(const study_run *a, const study_run *b);

typedef struct study {
    char *file;
    unsigned char *text;
    const char *name, *title, *scene, *norm, *quantity, *reference, *unit; /* "" where the file does not say;
                                                                              quantity: words for norm= */
    study_run *run;
    uint32_t runs;
} study;

typedef struct studies {
    study *study;
    uint32_t count;
    char **scene; /* all scenes that the folder has studies of, in order of their names, each once */
    uint32_t scenes;
} studies;

/* the tables that were there when the program was built, line by line; the last has no name (tables.awk) */
typedef struct studies_file {
    const char *name;
    const char *const *line;
} studies_file;
extern const studies_file studies_built_in[];

/* The studies of `scene` in a folder, in order of their files' names; folder null: of those built in. False after a
   message: the folder or a file of this scene cannot be read or is malformed. None at all is no error. */
bool studies_open(studies *s, const char *folder, const char *scene);
void studies_close(studies *s);

#endif
