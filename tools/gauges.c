/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* gauges.c: gauges and probes of a run (see gauges.h). */
#include "gauges.h"

#include <string.h>

#include "host.h"

static void name_column(gauges *g, const build_scene *scene, const char *what, const double *x, uint32_t n,
                        const char *si)
{
    char at[48] = "";
    for (uint32_t k = 0; k < n; k++)
        snprintf(at + strlen(at), sizeof at - strlen(at), "%s%.10g", k ? ";" : "", x[k]);
    snprintf(g->name[g->columns++], sizeof *g->name, "%s_at_%.40s_%.8s", what, at, build_unit(scene, si));
}

/* one place out of a text, up to the next slash; null after a message, else what is left */
static const char *take_place(const char *option, const char *text, uint32_t n, double *x)
{
    char piece[128];
    const size_t size = strcspn(text, "/");
    if (size >= sizeof piece) {
        host_usage("%s=%s: a place is %u number%s", option, text, n, n > 1 ? "s separated by commas" : "");
        return NULL;
    }
    memcpy(piece, text, size);
    piece[size] = '\0';
    if (!host_numbers(option, piece, n, x))
        return NULL;
    return text + size;
}

bool gauges_take(gauges *g, const build *b, const build_scene *scene, const char *option, const char *text)
{
    static const char *const speeds[] = {"vx", "vy", "vz"};
    const bool probe = !strcmp(option, "probe");
    const uint32_t n = probe ? b->dimension : b->dimension - 1;
    const char *rest = text;
    if (n == 0)
        return host_usage("gauge=%s: a scene in one dimension has no place to stand on", text) == HOST_FINE;
    for (;;) {
        uint32_t *const count = probe ? &g->probe_count : &g->gauge_count;
        if (*count == MOST_GAUGES)
            return host_usage("%s=%s: at most %d places", option, text, MOST_GAUGES) == HOST_FINE;
        if (scene->columns + g->columns + (probe ? n + 2 : GAUGE_COLUMNS) > MOST_COLUMNS)
            return host_usage("%s=%s: a history has at most %d columns, %u are the scene's", option, text, MOST_COLUMNS,
                              scene->columns) == HOST_FINE;
        double *const x = probe ? g->probe[(*count)++] : g->gauge[(*count)++];
        if (!(rest = take_place(option, rest, n, x)))
            return false;
        if (probe) {
            name_column(g, scene, "pressure", x, n, "Pa");
            for (uint32_t k = 0; k < n && k < 3; k++)
                name_column(g, scene, speeds[k], x, n, "m/s");
            name_column(g, scene, "cover", x, n, "-");
        } else {
            name_column(g, scene, "surface", x, n, "m");
            name_column(g, scene, "top", x, n, "m");
            name_column(g, scene, "depth", x, n, "m");
        }
        if (!*rest++)
            return true;
    }
}

static bool is_inside(const char *option, const double *x, uint32_t n, const build *b, const build_sim *sim)
{
    for (uint32_t k = 0; k < n; k++) {
        double lo, hi;
        b->domain(sim, k, &lo, &hi);
        if (!(x[k] >= lo && x[k] <= hi))
            return host_no("%s: %c = %g is out of the domain, %g to %g", option, "xyz"[k], x[k], lo, hi) == HOST_FINE;
    }
    return true;
}

bool gauges_fit(const gauges *g, const build *b, const build_sim *sim)
{
    for (uint32_t i = 0; i < g->gauge_count; i++)
        if (!is_inside("gauge", g->gauge[i], b->dimension - 1, b, sim))
            return false;
    for (uint32_t i = 0; i < g->probe_count; i++)
        if (!is_inside("probe", g->probe[i], b->dimension, b, sim))
            return false;
    return true;
}

void gauges_row(const gauges *g, const build *b, const build_sim *sim, double *row)
{
    for (uint32_t i = 0; i < g->gauge_count; i++, row += GAUGE_COLUMNS)
        b->gauge(sim, g->gauge[i], row);
    for (uint32_t i = 0; i < g->probe_count; i++, row += b->dimension + 2)
        b->probe(sim, g->probe[i], row);
}
