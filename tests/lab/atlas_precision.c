/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* atlas_precision.c: float and double of the same scene side by side (precision_run.c): after how many steps do
   their particles part, and does anything that one would measure? Both begin from the same bits: positions are
   multiples of half a spacing. Differences are looked at every 10 steps. */
#include "atlas.h"

#include <math.h>
#include <stdlib.h>

#include "precision_run.h"

static const double apart[2] = {1e-3, 0.1}; /* dx */

static void compare(const precision_look *a, const precision_look *b, const double period[2], double diff[2])
{
    diff[0] = diff[1] = 0;
    for (uint32_t i = 0; i < a->bodies; i++) {
        double r2 = 0;
        for (int k = 0; k < 2; k++) {
            double d = fabs(a->x[i][k] - b->x[i][k]);
            d = period[k] > 0 && d > 0.5 * period[k] ? period[k] - d : d;
            r2 += d * d;
        }
        const double r = sqrt(r2);
        diff[0] = r > diff[0] ? r : diff[0];
        diff[1] += r / a->bodies;
    }
}

precision_pair precision_part(uint32_t scene, uint32_t steps)
{
    static precision_look a, b;
    precision_pair out = {0};
    double period[2], most = 0, diff[2];
    void *f = precision_build_2f.start(scene, period), *d = precision_build_2d.start(scene, period);
    if (!f || !d) {
        fputs("atlas: no memory\n", stderr);
        exit(1);
    }
    for (uint32_t s = 1; s <= steps && precision_build_2f.step(f) && precision_build_2d.step(d); s++) {
        out.steps = s;
        if (s % 10)
            continue;
        precision_build_2f.look(f, &a);
        precision_build_2d.look(d, &b);
        compare(&a, &b, period, diff);
        for (int k = 0; k < 2; k++)
            for (int m = 0; m < 2; m++)
                out.part[m][k] = out.part[m][k] == 0 && diff[m] > apart[k] ? s : out.part[m][k];
        out.moved[0] = diff[0];
        out.moved[1] = diff[1];
        most = fmax(most, b.kinetic);
        out.kinetic = fmax(out.kinetic, fabs(a.kinetic - b.kinetic));
        out.front = fmax(out.front, fabs(a.front - b.front));
    }
    out.kinetic = most > 0 ? out.kinetic / most : 0;
    precision_build_2f.end(f);
    precision_build_2d.end(d);
    return out;
}

void atlas_precision(FILE *f)
{
    static const struct {
        const char *name;
        uint32_t scene, steps;
    } list[] = {{"tank", PAIR_TANK, 20000}, {"dam", PAIR_DAM, 3500}, {"vortex", PAIR_VORTEX, 5000},
                {"block", PAIR_BLOCK, 10000},
                {"tension", PAIR_TENSION, 1000}};
    atlas_head(f, "precision", "float and double of the same scene: when particles part, and whether figures do",
               "2-D, fixed step 0.2 dx/c0; scenes: tests/lab/precision_run.c; x: what counts as apart, dx\n"
               "steps 0: never in the run; at_end: distance at the end of the run\n"
               "kinetic: largest difference over the largest energy; front: of the largest x (dam alone)",
               "case,choice,x,figure,value,unit");
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const precision_pair p = precision_part(list[i].scene, list[i].steps);
        for (int k = 0; k < 2; k++)
            fprintf(f, "%s,largest,%.3g,steps,%u,steps\n%s,mean,%.3g,steps,%u,steps\n", list[i].name, apart[k],
                    p.part[0][k],
                    list[i].name, apart[k], p.part[1][k]);
        fprintf(f, "%s,largest,,at_end,%.2e,dx\n%s,mean,,at_end,%.2e,dx\n", list[i].name, p.moved[0], list[i].name,
                p.moved[1]);
        fprintf(f, "%s,all,,run,%u,steps\n", list[i].name, p.steps);
        fprintf(f, "%s,all,,kinetic,%.2e,-\n", list[i].name, p.kinetic);
        if (list[i].scene == PAIR_DAM)
            fprintf(f, "%s,all,,front,%.2e,dx\n", list[i].name, p.front);
        fflush(f);
    }
}
