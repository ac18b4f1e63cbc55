/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_export.c: sph export. Dumps as VTK files for ParaView (.vtu, and a .pvd that collects several), or as CSV. */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"

#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: sph export DUMP... out=NAME.vtu|NAME.pvd|NAME.csv [encoding=binary|ascii] [walls=yes|no]\n"
    "  out=NAME.vtu   one dump as a VTK unstructured grid (a vertex for each particle); opens in ParaView\n"
    "  out=NAME.pvd   several dumps as NAME_0000.vtu, NAME_0001.vtu, ..., and NAME.pvd, which knows their times\n"
    "  out=NAME.csv   one dump as a table, a row for each particle in order of the arrays\n"
    "  encoding=      of .vtu: binary (raw appended, default) or ascii\n"
    "  walls=         no leaves wall particles out (default yes)\n"
    "Arrays carry their units in their names: velocity_m_per_s, density_kg_per_m3, pressure_Pa, ...\n"
    "Fields that a reduced dump does not carry are left out.\n";

typedef struct out_field {
    const char *name;     /* as written */
    const char *field[6]; /* components, by their names in dumpfile.h */
    const char *type;     /* of VTK */
    uint32_t comps;
} out_field;

static const out_field fields[] = {
    {"velocity_m_per_s", {"velocity_x", "velocity_y", "velocity_z"}, "Float64", 3},
    {"speed_m_per_s", {"speed"}, "Float64", 1},
    {"density_kg_per_m3", {"density"}, "Float64", 1},
    {"pressure_Pa", {"pressure"}, "Float64", 1},
    {"acceleration_m_per_s2", {"acceleration_x", "acceleration_y", "acceleration_z"}, "Float64", 3},
    /* in the order of VTK */
    {"stress_Pa", {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_xz"}, "Float64", 6},
    {"mean_stress_Pa", {"mean_stress"}, "Float64", 1},
    {"von_mises_Pa", {"von_mises"}, "Float64", 1},
    {"plastic", {"plastic"}, "Float64", 1},
    {"damage", {"damage"}, "Float64", 1},
    {"set", {"set"}, "UInt8", 1},
    {"id", {"id"}, "UInt32", 1},
};
#define FIELDS (sizeof fields / sizeof *fields)

/* chosen particles of a dump and the columns that it carries */
typedef struct table {
    const dump_file *d;
    uint32_t *at, n;
    double *column[FIELDS][6]; /* null: not carried */
} table;

static void free_table(table *t)
{
    free(t->at);
    for (size_t f = 0; f < FIELDS; f++)
        for (int k = 0; k < 6; k++)
            free(t->column[f][k]);
}

static bool make_table(table *t, const dump_file *d, bool walls)
{
    const char *unit;
    bool fine = true;
    memset(t, 0, sizeof *t);
    t->d = d;
    t->at = host_alloc(d->n * sizeof *t->at);
    for (uint32_t i = 0; i < d->n; i++) {
        uint32_t role = dump_role(d, i);
        if (role != DUMP_GONE && (walls || !dump_is_wall(role)))
            t->at[t->n++] = i;
    }
    for (size_t f = 0; f < FIELDS; f++)
        for (uint32_t k = 0; k < fields[f].comps; k++)
            if (dump_has_field(d, fields[f].field[k])) {
                t->column[f][k] = host_alloc(d->n * sizeof(double));
                fine &= dump_field(d, fields[f].field[k], t->column[f][k], &unit);
            }
    return fine;
}

/* ---- VTK ---- */

typedef struct vtu {
    FILE *f;
    bool ascii;
    uint64_t offset; /* of the next array in the appended block */
    bool appending;  /* second round: the arrays' bytes */
} vtu;

static uint32_t type_bytes(const char *type)
{
    return !strcmp(type, "UInt8") ? 1 : !strcmp(type, "UInt32") ? 4 : 8;
}

static void put_bytes(FILE *f, uint64_t v, uint32_t bytes)
{
    for (uint32_t i = 0; i < bytes; i++)
        fputc((int)(v >> 8 * i & 255), f);
}

static void put_value(const vtu *v, const char *type, double x)
{
    uint64_t u = 0;
    if (v->ascii) {
        fprintf(v->f, !strcmp(type, "Float64") ? "%.17g\n" : "%.0f\n", x);
        return;
    }
    if (!strcmp(type, "Float64"))
        memcpy(&u, &x, 8);
    else
        u = (uint64_t)x;
    put_bytes(v->f, u, type_bytes(type));
}

typedef double (*value_fn)(const table *t, size_t what, uint32_t i, uint32_t k);
static double point_value(const table *t, size_t what, uint32_t i, uint32_t k)
{
    (void)what;
    return k < t->d->dim ? dump_x(t->d, t->at[i], k) : 0;
}
static double field_value(const table *t, size_t what, uint32_t i, uint32_t k)
{
    return t->column[what][k] ? t->column[what][k][t->at[i]] : 0;
}
static double index_value(const table *t, size_t what, uint32_t i, uint32_t k)
{
    (void)t;
    (void)k;
    return what == 0 ? i : what == 1 ? i + 1.0 : 1; /* connectivity, offsets, VTK_VERTEX */
}

/* a DataArray element, or in the second round its bytes; both rounds call this in the same order */
static void put_array(vtu *v, const table *t, const char *name, const char *type, uint32_t comps, value_fn fn,
                      size_t what)
{
    const uint64_t bytes = (uint64_t)t->n * comps * type_bytes(type);
    if (!v->appending) {
        fprintf(v->f, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%u\" ", type, name, comps);
        if (!v->ascii)
            fprintf(v->f, "format=\"appended\" offset=\"%llu\"/>\n", (unsigned long long)v->offset);
        else
            fprintf(v->f, "format=\"ascii\">\n");
        v->offset += bytes + 8;
        if (!v->ascii)
            return;
    } else
        put_bytes(v->f, bytes, 8);
    for (uint32_t i = 0; i < t->n; i++)
        for (uint32_t k = 0; k < comps; k++)
            put_value(v, type, fn(t, what, i, k));
    if (v->ascii)
        fprintf(v->f, "</DataArray>\n");
}

static void put_tag(const vtu *v, const char *text)
{
    if (!v->appending)
        fputs(text, v->f);
}

static void put_piece(vtu *v, const table *t)
{
    put_tag(v, "<Points>\n");
    put_array(v, t, "position_m", "Float64", 3, point_value, 0);
    put_tag(v, "</Points>\n<Cells>\n");
    put_array(v, t, "connectivity", "Int64", 1, index_value, 0);
    put_array(v, t, "offsets", "Int64", 1, index_value, 1);
    put_array(v, t, "types", "UInt8", 1, index_value, 2);
    put_tag(v, "</Cells>\n<PointData>\n");
    for (size_t f = 0; f < FIELDS; f++)
        if (t->column[f][0])
            put_array(v, t, fields[f].name, fields[f].type, fields[f].comps, field_value, f);
    put_tag(v, "</PointData>\n");
}

static bool write_vtu(const table *t, const char *name, bool ascii)
{
    host_file h;
    if (!host_create(&h, name))
        return false;
    vtu v = {h.f, ascii, 0, false};
    fprintf(h.f,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
            "NumberOfTuples=\"1\" format=\"ascii\">%.17g</DataArray>\n</FieldData>\n"
            "<Piece NumberOfPoints=\"%u\" NumberOfCells=\"%u\">\n",
            t->d->time, t->n, t->n);
    put_piece(&v, t);
    fputs("</Piece>\n</UnstructuredGrid>\n", h.f);
    if (!ascii) {
        fputs("<AppendedData encoding=\"raw\">\n_", h.f);
        v.appending = true;
        put_piece(&v, t);
        fputs("\n</AppendedData>\n", h.f);
    }
    fputs("</VTKFile>\n", h.f);
    return host_finish(&h, true);
}

/* ---- CSV ---- */

static bool write_csv(const table *t, const char *name)
{
    host_file h;
    if (!host_create(&h, name))
        return false;
    fprintf(h.f, "# %s, t = %.17g s, step %llu\n", t->d->name, t->d->time, (unsigned long long)t->d->step);
    for (uint32_t k = 0; k < t->d->dim; k++)
        fprintf(h.f, "%s%c_m", k ? "," : "", (int)('x' + k));
    for (size_t f = 0; f < FIELDS; f++)
        for (uint32_t k = 0; k < fields[f].comps; k++)
            if (t->column[f][k] && fields[f].comps > 1) /* velocity_x_m_per_s */
                fprintf(h.f, ",%s%s", fields[f].field[k], strchr(fields[f].name, '_'));
            else if (t->column[f][k])
                fprintf(h.f, ",%s", fields[f].name);
    fputc('\n', h.f);
    for (uint32_t i = 0; i < t->n; i++) {
        for (uint32_t k = 0; k < t->d->dim; k++)
            fprintf(h.f, "%s%.17g", k ? "," : "", dump_x(t->d, t->at[i], k));
        for (size_t f = 0; f < FIELDS; f++)
            for (uint32_t k = 0; k < fields[f].comps; k++)
                if (t->column[f][k])
                    fprintf(h.f, ",%.17g", t->column[f][k][t->at[i]]);
        fputc('\n', h.f);
    }
    return host_finish(&h, true);
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

static bool export_one(const char *dump, const char *out, format form, bool ascii, bool walls, double *time)
{
    dump_file d;
    table t;
    if (!dump_open(&d, dump))
        return false;
    *time = d.time;
    bool fine = make_table(&t, &d, walls) && (form == CSV ? write_csv(&t, out) : write_vtu(&t, out, ascii));
    free_table(&t);
    dump_close(&d);
    return fine;
}

/* a file of the collection: its name beside the .pvd */
static void member_name(char *name, size_t size, const char *out, int k)
{
    snprintf(name, size, "%.*s_%04d.vtu", (int)(strlen(out) - 4), out, k);
}

static int export_pvd(char **dumps, int n, const char *out, bool ascii, bool walls)
{
    size_t room = strlen(out) + 32;
    char *name = host_alloc(room);
    double *time = host_alloc((size_t)n * sizeof *time);
    bool fine = true;
    host_file h;
    for (int k = 0; fine && k < n; k++) {
        member_name(name, room, out, k);
        fine = export_one(dumps[k], name, VTU, ascii, walls, &time[k]);
    }
    if (fine && (fine = host_create(&h, out))) {
        fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
              "<Collection>\n",
              h.f);
        for (int k = 0; k < n; k++) {
            member_name(name, room, out, k);
            const char *base = strrchr(name, '/');
            fprintf(h.f, "<DataSet timestep=\"%.17g\" part=\"0\" file=\"%s\"/>\n", time[k], base ? base + 1 : name);
        }
        fputs("</Collection>\n</VTKFile>\n", h.f);
        fine = host_finish(&h, true);
    }
    free(name);
    free(time);
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
    if (form == PVD)
        return export_pvd(argv + 1, files, out, ascii == 1, walls == 1);
    if (files > 1)
        return host_usage("%d dumps into one file: use out=NAME.pvd", files);
    double time;
    return export_one(argv[1], out, form, ascii == 1, walls == 1, &time) ? HOST_FINE : HOST_NO;
}
