/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* vtu.c: particles as a VTK unstructured grid (see vtu.h). Arrays stand behind the XML part as they are in memory,
   little-endian, and packed by zlib in blocks where the program was built with it (-DHAVE_ZLIB): of an array then
   UInt64 blocks, bytes of a block, bytes of the last one if it is shorter (else 0), packed bytes of each; then the
   blocks. */
#include "vtu.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

#ifdef HAVE_ZLIB
#include <zlib.h>
#define PACKED " compressor=\"vtkZLibDataCompressor\""
#else
#define PACKED ""
#endif

/* ---- columns ---- */

static const struct {
    const char *name, *si;
    uint32_t comps;
    const char *part[CLOUD_COMPS]; /* fields by their names in dumpfile.h */
    const char *type;
} kinds[] = {
    {"velocity", "m/s", 3, {"velocity_x", "velocity_y", "velocity_z"}, "Real"},
    {"speed", "m/s", 1, {"speed"}, "Real"},
    {"density", "kg/m^3", 1, {"density"}, "Real"},
    {"pressure", "Pa", 1, {"pressure"}, "Real"},
    {"acceleration", "m/s^2", 3, {"acceleration_x", "acceleration_y", "acceleration_z"}, "Real"},
    /* in the order of VTK */
    {"stress", "Pa", 6, {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_xz"}, "Real"},
    {"mean_stress", "Pa", 1, {"mean_stress"}, "Real"},
    {"von_mises", "Pa", 1, {"von_mises"}, "Real"},
    {"plastic", "", 1, {"plastic"}, "Real"},
    {"damage", "", 1, {"damage"}, "Real"},
    {"set", "", 1, {"set"}, "UInt8"},
    {"id", "", 1, {"id"}, "UInt32"},
};

void cloud_name(const char *name, const char *unit, char *out, size_t size)
{
    size_t n = (size_t)snprintf(out, size, "%s%s", name, *unit ? "_" : "");
    for (; *unit && n + 8 < size; unit++)
        if (*unit == '/')
            n += (size_t)snprintf(out + n, size - n, "_per_");
        else if (*unit != '^')
            out[n++] = *unit == '.' ? '_' : *unit;
        else if (n && out[n - 1] >= '0' && out[n - 1] <= '9') /* c0^2 is no c02 */
            out[n++] = '_';
    out[n < size ? n : size - 1] = '\0';
}

static double *new_column(const dump_file *d) { return host_alloc(d->n * sizeof(double)); }

/* what follows from the set alone: role, mass, and the spacing at which particles of that mass stand */
static void add_of_sets(cloud_table *t, const dump_file *d)
{
    static const char *const name[] = {"role", "mass", "spacing"}, *const si[] = {"", "kg", "m"};
    double of[3][256] = {{0}};
    for (uint32_t s = 0; s < d->sets && s < 256; s++) {
        const double mass = dump_number(d, "sets", "mass", s, 0), rho0 = dump_number(d, "sets", "rho0", s, 0);
        of[0][s] = dump_number(d, "sets", "role", s, 0);
        of[1][s] = mass;
        of[2][s] = mass > 0 && rho0 > 0 ? pow(mass / rho0, 1.0 / d->dim) : d->spacing;
    }
    for (int k = 0; k < 3; k++) {
        cloud_field *f = &t->field[t->fields++];
        *f = (cloud_field){.name = name[k], .unit = si[k], .part = {name[k]}, .comps = 1,
                           .type = k ? "Real" : "UInt8"};
        f->column[0] = new_column(d);
        for (uint32_t i = 0; i < d->n; i++)
            f->column[0][i] = of[k][dump_set(d, i) & 255];
    }
}

bool cloud_make(cloud_table *t, const dump_file *d, bool walls)
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
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        if (!dump_has_field(d, kinds[k].part[0]))
            continue;
        cloud_field *f = &t->field[t->fields++];
        *f = (cloud_field){.name = kinds[k].name, .unit = kinds[k].si, .comps = kinds[k].comps, .type = kinds[k].type};
        memcpy(f->part, kinds[k].part, sizeof f->part);
        for (uint32_t c = 0; c < f->comps; c++)
            if (dump_has_field(d, f->part[c])) {
                f->column[c] = new_column(d);
                fine = dump_field(d, f->part[c], f->column[c], &unit) && fine;
            }
    }
    add_of_sets(t, d);
    return fine;
}

void cloud_free(cloud_table *t)
{
    free(t->at);
    for (uint32_t f = 0; f < t->fields; f++)
        for (uint32_t k = 0; k < CLOUD_COMPS; k++)
            free(t->field[f].column[k]);
}

/* ---- text ---- */

void vtu_put_text(FILE *f, const char *text)
{
    for (; *text; text++)
        switch (*text) {
        case '&': fputs("&amp;", f); break;
        case '<': fputs("&lt;", f); break;
        case '>': fputs("&gt;", f); break;
        case '"': fputs("&quot;", f); break;
        case '\t':
        case '\n':
        case '\r': fprintf(f, "&#%d;", *text); break;
        default: fputc(*text, f);
        }
}

/* bytes of the letter in UTF-8 at p, 0 if there is none */
static size_t letter(const unsigned char *p)
{
    static const struct {
        unsigned char low, high, bytes;
    } first[] = {{0x01, 0x7f, 1}, {0xc2, 0xdf, 2}, {0xe0, 0xef, 3}, {0xf0, 0xf4, 4}};
    size_t n = 0;
    for (size_t k = 0; k < sizeof first / sizeof *first; k++)
        if (*p >= first[k].low && *p <= first[k].high)
            n = first[k].bytes;
    for (size_t k = 1; k < n; k++)
        if ((p[k] & 0xc0) != 0x80)
            return 0;
    return n;
}

bool vtu_text_fits(const char *text)
{
    size_t n;
    for (const unsigned char *p = (const unsigned char *)text; *p; p += n)
        if ((*p < ' ' && !strchr("\t\n\r", *p)) || !(n = letter(p)))
            return false;
    return true;
}

/* strings as VTK writes them: codes of letters, each string ends with a 0 */
static void put_strings(FILE *f, const char *name, char (*text)[80], uint32_t n)
{
    fprintf(f, "<DataArray type=\"String\" Name=\"%s\" NumberOfTuples=\"%u\" format=\"ascii\">\n", name, n);
    for (uint32_t k = 0; k < n; k++) {
        for (const char *p = text[k]; *p; p++)
            fprintf(f, "%d ", *p);
        fputs("0\n", f);
    }
    fputs("</DataArray>\n", f);
}

/* ---- arrays ---- */

typedef struct vtu {
    FILE *xml, *appended; /* appended: null when all is text */
    const char *real;
    unsigned char *raw; /* of one array */
    uint64_t offset;    /* of the next array in the appended block */
} vtu;

static uint32_t type_bytes(const char *type)
{
    return !strcmp(type, "UInt8") ? 1 : !strcmp(type, "Float64") ? 8 : 4;
}

static void store(unsigned char *p, uint64_t v, uint32_t bytes)
{
    for (uint32_t i = 0; i < bytes; i++)
        p[i] = (unsigned char)(v >> 8 * i);
}

static void put_u64(vtu *v, uint64_t x)
{
    unsigned char b[8];
    store(b, x, 8);
    fwrite(b, 1, 8, v->appended);
    v->offset += 8;
}

#ifdef HAVE_ZLIB
enum { BLOCK = 1 << 16 };

static void append(vtu *v, size_t bytes)
{
    const size_t blocks = (bytes + BLOCK - 1) / BLOCK;
    uLongf *size = host_alloc(blocks * sizeof *size);
    unsigned char *packed = host_alloc(blocks * compressBound(BLOCK)), *p = packed;
    put_u64(v, blocks);
    put_u64(v, BLOCK);
    put_u64(v, bytes % BLOCK);
    for (size_t k = 0; k < blocks; k++) {
        const size_t from = k * BLOCK, n = bytes - from < BLOCK ? bytes - from : BLOCK;
        size[k] = compressBound(BLOCK);
        compress2(p, &size[k], v->raw + from, (uLong)n, 6); /* fits: the room is what compressBound says */
        put_u64(v, size[k]);
        p += size[k];
    }
    fwrite(packed, 1, (size_t)(p - packed), v->appended);
    v->offset += (uint64_t)(p - packed);
    free(size);
    free(packed);
}
#else
static void append(vtu *v, size_t bytes)
{
    put_u64(v, bytes);
    fwrite(v->raw, 1, bytes, v->appended);
    v->offset += bytes;
}
#endif

static void put_text_value(const vtu *v, const char *type, double x)
{
    const bool single = !strcmp(type, "Float32");
    fprintf(v->xml, single ? "%.9g\n" : !strcmp(type, "Float64") ? "%.17g\n" : "%.0f\n", single ? (double)(float)x : x);
}

static void store_value(unsigned char *p, const char *type, double x)
{
    uint64_t u;
    uint32_t w;
    const float single = (float)x;
    memcpy(&u, &x, 8);
    memcpy(&w, &single, 4);
    store(p, !strcmp(type, "Float64") ? u : !strcmp(type, "Float32") ? w : (uint64_t)x, type_bytes(type));
}

/* value of element i, component k */
typedef double (*value_fn)(const cloud_table *t, const void *what, uint32_t i, uint32_t k);

static void put_array(vtu *v, const cloud_table *t, const char *name, const char *type, uint32_t comps, value_fn fn,
                      const void *what)
{
    type = !strcmp(type, "Real") ? v->real : type;
    const uint32_t size = type_bytes(type);
    fprintf(v->xml, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%u\" ", type, name, comps);
    if (v->appended)
        fprintf(v->xml, "format=\"appended\" offset=\"%llu\"/>\n", (unsigned long long)v->offset);
    else
        fputs("format=\"ascii\">\n", v->xml);
    unsigned char *p = v->raw;
    for (uint32_t i = 0; i < t->n; i++)
        for (uint32_t k = 0; k < comps; k++, p += size) {
            const double x = fn(t, what, i, k);
            if (v->appended)
                store_value(p, type, x);
            else
                put_text_value(v, type, x);
        }
    if (v->appended)
        append(v, (size_t)t->n * comps * size);
    else
        fputs("</DataArray>\n", v->xml);
}

static double place_value(const cloud_table *t, const void *what, uint32_t i, uint32_t k)
{
    (void)what;
    return k < t->d->dim ? dump_x(t->d, t->at[i], k) : 0;
}
static double field_value(const cloud_table *t, const void *what, uint32_t i, uint32_t k)
{
    const cloud_field *f = what;
    return f->column[k] ? f->column[k][t->at[i]] : 0;
}
enum { CONNECTIVITY, OFFSETS, TYPES };
static double index_value(const cloud_table *t, const void *what, uint32_t i, uint32_t k)
{
    const int kind = *(const int *)what;
    (void)t;
    (void)k;
    return kind == CONNECTIVITY ? i : kind == OFFSETS ? i + 1.0 : 1; /* VTK_VERTEX is 1 */
}

/* ---- the file ---- */

/* what ParaView colours by when it opens the file: speed and velocity, or what there is */
static void put_active(const vtu *v, const cloud_table *t)
{
    const cloud_field *scalar = NULL, *vector = NULL;
    char name[96];
    for (uint32_t c = 0; c < t->fields; c++) {
        const cloud_field *f = &t->field[c];
        if (f->comps == 1 && (!scalar || !strcmp(f->name, "speed")))
            scalar = f;
        if (f->comps == 3 && !vector)
            vector = f;
    }
    fputs("<PointData", v->xml);
    if (scalar) {
        cloud_name(scalar->name, dump_unit(t->d, scalar->unit), name, sizeof name);
        fprintf(v->xml, " Scalars=\"%s\"", name);
    }
    if (vector) {
        cloud_name(vector->name, dump_unit(t->d, vector->unit), name, sizeof name);
        fprintf(v->xml, " Vectors=\"%s\"", name);
    }
    fputs(">\n", v->xml);
}

static void put_field_data(const vtu *v, const dump_file *d)
{
    static const char *const roles[] = {"fluid", "ghost wall", "force wall", "solid"};
    char role[DUMP_GONE][80], set[256][80];
    for (uint32_t k = 0; k < DUMP_GONE; k++)
        snprintf(role[k], sizeof role[k], "%s", roles[k]);
    for (uint32_t s = 0; s < d->sets && s < 256; s++)
        snprintf(set[s], sizeof set[s], "%u: %s, rest density %g %s", s,
                 roles[(int)dump_number(d, "sets", "role", s, 0)], dump_number(d, "sets", "rho0", s, 0),
                 dump_unit(d, "kg/m^3"));
    fprintf(v->xml,
            "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
            "%.17g</DataArray>\n", d->time);
    put_strings(v->xml, "role_names", role, DUMP_GONE);
    put_strings(v->xml, "set_names", set, d->sets);
    fputs("</FieldData>\n", v->xml);
}

static void put_grid(vtu *v, const cloud_table *t)
{
    static const int kind[] = {CONNECTIVITY, OFFSETS, TYPES};
    char name[96];
    fprintf(v->xml,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\"%s>\n<UnstructuredGrid>\n", v->appended ? PACKED : "");
    put_field_data(v, t->d);
    fprintf(v->xml, "<Piece NumberOfPoints=\"%u\" NumberOfCells=\"%u\">\n<Points>\n", t->n, t->n);
    cloud_name("position", dump_unit(t->d, "m"), name, sizeof name);
    put_array(v, t, name, "Real", 3, place_value, NULL);
    fputs("</Points>\n<Cells>\n", v->xml);
    put_array(v, t, "connectivity", "Int32", 1, index_value, &kind[0]);
    put_array(v, t, "offsets", "Int32", 1, index_value, &kind[1]);
    put_array(v, t, "types", "UInt8", 1, index_value, &kind[2]);
    fputs("</Cells>\n", v->xml);
    put_active(v, t);
    for (uint32_t c = 0; c < t->fields; c++) {
        cloud_name(t->field[c].name, dump_unit(t->d, t->field[c].unit), name, sizeof name);
        put_array(v, t, name, t->field[c].type, t->field[c].comps, field_value, &t->field[c]);
    }
    fputs("</PointData>\n</Piece>\n</UnstructuredGrid>\n", v->xml);
}

bool vtu_write(const cloud_table *t, FILE *f, bool ascii)
{
    char *text = NULL;
    size_t size = 0;
    vtu v = {f, ascii ? NULL : open_memstream(&text, &size), t->d->real_bytes == 8 ? "Float64" : "Float32", NULL, 0};
    if (!ascii && !v.appended) {
        host_no("%s: no memory for its arrays", t->d->name);
        return false;
    }
    v.raw = host_alloc((size_t)t->n * CLOUD_COMPS * 8);
    put_grid(&v, t);
    free(v.raw);
    bool fine = true;
    if (v.appended) {
        fine = !ferror(v.appended) && !fclose(v.appended);
        fputs("<AppendedData encoding=\"raw\">\n_", f);
        fwrite(text, 1, size, f);
        fputs("\n</AppendedData>\n", f);
        free(text);
    }
    fputs("</VTKFile>\n", f);
    if (!fine)
        host_no("%s: no memory for its arrays", t->d->name);
    return fine;
}
