/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_names.c: names of choices, and the header of a table. */
#include "atlas.h"

#include <string.h>

const char *const atlas_kernels[] = {"cubic", "quartic", "quintic", "gaussian", "wendland_c2", "wendland_c4", "hat",
                                     NULL};
const char *const atlas_integrators[] = {"predictor_corrector", "kick_drift_kick", "leap_frog", "runge_kutta",
                                         "runge_kutta_momentum", NULL};
const char *const atlas_forms[] = {"none", "updated", "corrected", "total", NULL};

void atlas_head(FILE *f, const char *table, const char *title, const char *figures, const char *columns)
{
    fprintf(f, "# SPDX-License-Identifier: MIT. Copyright the sph authors.\n# atlas: %s\n# title: %s\n", table, title);
    for (const char *line = figures; *line;) { /* lines of the text become comments */
        const size_t n = strcspn(line, "\n");
        fprintf(f, "# %.*s\n", (int)n, line);
        line += n + (line[n] == '\n');
    }
    fprintf(f, "# command: make atlas ATLAS=%s\n%s\n", table, columns);
}
