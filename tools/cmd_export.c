/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_export.c: sph export. Dumps as VTK files for ParaView (vtu.c; and a .pvd that collects several), or as CSV. */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"
#include "output.h"
#include "vtu.h"

#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph export DUMP... out=NAME.vtu|NAME.pvd|NAME.csv [encoding=binary|ascii] [walls=yes|no]\n"
    "  out=NAME.vtu   one dump as a VTK unstructured grid (a vertex for each particle); opens in ParaView, coloured\n"
    "  out=NAME.pvd   several dumps as NAME_0000.vtu, NAME_0001.vtu, ..., and NAME.pvd, which knows their times\n"
    "  out=NAME.csv   one dump as a table, a row for each particle in order of the arrays\n"
    "  encoding=      of .vtu: binary (appended; packed where the program was built with zlib; default) or ascii\n"
    "  walls=         no leaves wall particles out (default yes)\n"
    "Numbers of runs in float are Float32. Arrays carry their units in their names: velocity_m_per_s, pressure_Pa ...\n"
    "Fields that a reduced dump does not carry are left out. Names of sets and of roles are in the field data.\n";

/* ---- CSV ---- */

static void write_csv(const cloud_table *t, FILE *f)
{
    const char *const metre = dump_unit(t->d, "m");
    char name[96];
    fputs("# ", f);
    host_put_name(f, t->d->name);
    fprintf(f, ", t = %.17g %s, step %llu\n", t->d->time, dump_unit(t->d, "s"), (unsigned long long)t->d->step);
    for (uint32_t k = 0; k < t->d->dim; k++) {
        const char axis[] = {(char)('x' + k), '\0'};
        cloud_name(axis, metre, name, sizeof name);
        fprintf(f, "%s%s", k ? "," : "", name);
    }
    for (uint32_t c = 0; c < t->fields; c++)
        for (uint32_t k = 0; k < t->field[c].comps; k++)
            if (t->field[c].column[k]) {
                cloud_name(t->field[c].part[k], dump_unit(t->d, t->field[c].unit), name, sizeof name);
                fprintf(f, ",%s", name);
            }
    fputc('\n', f);
    for (uint32_t i = 0; i < t->n; i++) {
        for (uint32_t k = 0; k < t->d->dim; k++)
            fprintf(f, "%s%.17g", k ? "," : "", dump_x(t->d, t->at[i], k));
        for (uint32_t c = 0; c < t->fields; c++)
            for (uint32_t k = 0; k < t->field[c].comps; k++)
                if (t->field[c].column[k])
                    fprintf(f, ",%.17g", t->field[c].column[k][t->at[i]]);
        fputc('\n', f);
    }
}

/* ---- the command ---- */

typedef enum format { VTU, PVD, CSV, NO_FORMAT } format;

static format find_format(const char *out)
{
    static const char *const ends[] = {".vtu", ".pvd", ".csv"};
    size_t n = strlen(out);
    for (int k = 0; k < 3; k++)
        if (n > 4 && !strcmp(out + n - 4, ends[k]))
            return (format)k;
    return NO_FORMAT;
}

/* one dump into an open output */
static bool export_one(const char *dump, output *o, format form, bool ascii, bool walls, double *time)
{
    dump_file d;
    cloud_table t;
    if (!dump_open(&d, dump))
        return false;
    *time = d.time;
    bool fine = cloud_make(&t, &d, walls);
    if (fine && form == CSV)
        write_csv(&t, o->f);
    else if (fine)
        fine = vtu_write(&t, o->f, ascii);
    cloud_free(&t);
    dump_close(&d);
    return fine;
}

/* a file of the collection: its name beside the .pvd */
static void member_name(char *name, size_t size, const char *out, int k)
{
    snprintf(name, size, "%.*s_%04d.vtu", (int)(strlen(out) - 4), out, k);
}

static void write_pvd(FILE *f, const char *out, const double *time, int n)
{
    const size_t room = strlen(out) + 32;
    char *name = host_alloc(room);
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
          "<Collection>\n",
          f);
    for (int k = 0; k < n; k++) {
        member_name(name, room, out, k);
        const char *base = strrchr(name, '/');
        fprintf(f, "<DataSet timestep=\"%.17g\" part=\"0\" file=\"", time[k]);
        vtu_put_text(f, base ? base + 1 : name);
        fputs("\"/>\n", f);
    }
    fputs("</Collection>\n</VTKFile>\n", f);
    free(name);
}

/* n members and the collection: all of them or none */
static int export_pvd(char **dumps, int n, const char *out, bool ascii, bool walls)
{
    const size_t room = strlen(out) + 32, count = (size_t)n + 1;
    char *name = host_alloc(count * room);
    double *time = host_alloc(count * sizeof *time);
    output *o = host_alloc(count * sizeof *o);
    memset(o, 0, count * sizeof *o);
    bool fine = output_open(&o[n], "out", out); /* the collection is the last to get its name */
    for (int k = 0; fine && k < n; k++) {
        member_name(name + (size_t)k * room, room, out, k);
        fine = output_open(&o[k], "out", name + (size_t)k * room) &&
               export_one(dumps[k], &o[k], VTU, ascii, walls, &time[k]) && output_ready(&o[k]);
    }
    if (fine)
        write_pvd(o[n].f, out, time, n);
    fine = output_close_all(o, count, fine) && fine;
    free(name);
    free(time);
    free(o);
    return fine ? HOST_FINE : HOST_NO;
}

int cmd_export(int argc, char **argv)
{
    static const char *const known[] = {"out", "encoding", "walls", NULL};
    static const char *const encodings[] = {"binary", "ascii", NULL}, *const yes_no[] = {"no", "yes", NULL};
    host_command("export");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    int files = host_known_options(argc, argv, known);
    if (files < 0)
        return HOST_USAGE;
    const char *out = host_option(argc, argv, "out"), *text;
    int ascii = (text = host_option(argc, argv, "encoding")) ? host_choice("encoding", text, encodings) : 0;
    int walls = (text = host_option(argc, argv, "walls")) ? host_choice("walls", text, yes_no) : 1;
    if (ascii < 0 || walls < 0)
        return HOST_USAGE;
    if (files == 0 || !out)
        return host_usage("give at least one dump, and out=NAME");
    format form = find_format(out);
    if (form == NO_FORMAT)
        return host_usage("out=%s: must end in .vtu, .pvd or .csv", out);
    if (form == PVD && !vtu_text_fits(out))
        return host_usage("out=%s: a collection names its files, and XML cannot hold this name; allowed: UTF-8 without "
                          "control characters but tab and line feed", out);
    if (form == PVD)
        return export_pvd(argv + 1, files, out, ascii == 1, walls == 1);
    if (files > 1)
        return host_usage("%d dumps into one file: use out=NAME.pvd", files);
    double time;
    output o;
    bool fine = output_open(&o, "out", out);
    fine = fine && export_one(argv[1], &o, form, ascii == 1, walls == 1, &time);
    return output_close(&o, fine) && fine ? HOST_FINE : HOST_NO;
}
