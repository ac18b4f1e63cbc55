/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* image.c: a picture in memory (see image.h). */
#include "image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

#ifdef HAVE_LIBPNG
#include <png.h>
#endif

image image_new(int width, int height, colour fill)
{
    image m = {width, height, host_alloc((size_t)width * (size_t)height * 3)};
    image_rect(&m, 0, 0, width, height, fill);
    return m;
}
void image_free(image *m)
{
    free(m->rgb);
    m->rgb = NULL;
}

static void put(image *m, int x, int y, colour c)
{
    if (x < 0 || y < 0 || x >= m->width || y >= m->height)
        return;
    uint8_t *p = m->rgb + 3 * ((size_t)y * (size_t)m->width + (size_t)x);
    p[0] = c.r;
    p[1] = c.g;
    p[2] = c.b;
}

void image_rect(image *m, int x, int y, int width, int height, colour c)
{
    const long long right = (long long)x + width, low = (long long)y + height;
    const int x0 = x < 0 ? 0 : x, y0 = y < 0 ? 0 : y;
    const int x1 = right > m->width ? m->width : (int)right, y1 = low > m->height ? m->height : (int)low;
    for (int j = y0; j < y1; j++)
        for (int i = x0; i < x1; i++)
            put(m, i, j, c);
}

/* a whole number from low to high out of any double */
static int bounded(double v, int low, int high) { return v > low ? v < high ? (int)v : high : low; }

/* what is off the picture costs nothing: a disc may be far larger */
void image_disc(image *m, double x, double y, double radius, colour c)
{
    const int y0 = bounded(ceil(y - radius), 0, m->height), y1 = bounded(floor(y + radius), -1, m->height - 1);
    bool drawn = false;
    if (!(radius >= 0))
        return;
    for (int j = y0; j <= y1; j++) {
        const double half = sqrt(fmax(0, radius * radius - (j - y) * (j - y)));
        const int x0 = bounded(ceil(x - half), 0, m->width), x1 = bounded(floor(x + half), -1, m->width - 1);
        for (int i = x0; i <= x1; i++) {
            put(m, i, j, c);
            drawn = true;
        }
    }
    if (!drawn && radius < 1 && fabs(x) < 1e6 && fabs(y) < 1e6)
        put(m, (int)lround(x), (int)lround(y), c);
}

void image_line(image *m, double x0, double y0, double x1, double y1, colour c)
{
    const double n = fmax(fabs(x1 - x0), fabs(y1 - y0));
    if (!(fabs(x0) < 1e6 && fabs(y0) < 1e6 && fabs(x1) < 1e6 && fabs(y1) < 1e6))
        return;
    const int steps = (int)ceil(n);
    for (int k = 0; k <= steps; k++) {
        double s = steps ? (double)k / steps : 0;
        put(m, (int)lround(x0 + s * (x1 - x0)), (int)lround(y0 + s * (y1 - y0)), c);
    }
}

/* ---- text: nine rows of five bits, from the top; a row is one digit of base 32 (0-9, A-V); missing rows are empty
 * ---- */

static const struct {
    char c;
    const char *rows;
} font[] = {
    {'!', "4444404"},  {'%', "OP248J3"},  {'(', "2488842"},  {')', "8422248"},   {'*', "0LEVEL0"},  {'+', "044V440"},
    {',', "00000448"}, {'-', "000V000"},  {'.', "00000CC"},  {'/', "11248GG"},   {'0', "EHJLPHE"},  {'1', "4C4444E"},
    {'2', "EH1248V"},  {'3', "V2421HE"},  {'4', "26AIV22"},  {'5', "VGU11HE"},   {'6', "68GUHHE"},  {'7', "V124888"},
    {'8', "EHHEHHE"},  {'9', "EHHF12C"},  {':', "0CC0CC0"},  {'<', "248G842"},   {'=', "00V0V00"},  {'>', "8421248"},
    {'?', "EH12404"},  {'[', "E88888E"},  {']', "E22222E"},  {'^', "4AH0000"},   {'_', "0000000V"}, {'|', "4444444"},
    {'A', "EHHVHHH"},  {'B', "UHHUHHU"},  {'C', "EHGGGHE"},  {'D', "SIHHHIS"},   {'E', "VGGUGGV"},  {'F', "VGGUGGG"},
    {'G', "EHGNHHF"},  {'H', "HHHVHHH"},  {'I', "E44444E"},  {'J', "72222IC"},   {'K', "HIKOKIH"},  {'L', "GGGGGGV"},
    {'M', "HRLLHHH"},  {'N', "HHPLJHH"},  {'O', "EHHHHHE"},  {'P', "UHHUGGG"},   {'Q', "EHHHLID"},  {'R', "UHHUKIH"},
    {'S', "FGGE11U"},  {'T', "V444444"},  {'U', "HHHHHHE"},  {'V', "HHHHHA4"},   {'W', "HHHLLLA"},  {'X', "HHA4AHH"},
    {'Y', "HHHA444"},  {'Z', "V1248GV"},  {'a', "00E1FHF"},  {'b', "GGMPHHU"},   {'c', "00EGGHE"},  {'d', "11DJHHF"},
    {'e', "00EHVGE"},  {'f', "698S888"},  {'g', "00FHHF1E"}, {'h', "GGMPHHH"},   {'i', "40C444E"},  {'j', "2062222IC"},
    {'k', "GGIKOKI"},  {'l', "C44444E"},  {'m', "00QLLHH"},  {'n', "00MPHHH"},   {'o', "00EHHHE"},  {'p', "00UHHUGG"},
    {'q', "00FHHF11"}, {'r', "00MPGGG"},  {'s', "00FGE1U"},  {'t', "88S8896"},   {'u', "00HHHJD"},  {'v', "00HHHA4"},
    {'w', "00HHLLA"},  {'x', "00HA4AH"},  {'y', "00HHHF1E"}, {'z', "00V248V"},
};

int image_text_width(const char *text, int scale) { return (int)strlen(text) * 6 * scale; }
int image_text_height(int scale) { return 9 * scale; }

static void draw_glyph(image *m, int x, int y, int scale, const char *rows, colour c)
{
    for (int j = 0; rows[j]; j++) {
        int bits = rows[j] <= '9' ? rows[j] - '0' : rows[j] - 'A' + 10;
        for (int i = 0; i < 5; i++)
            if (bits >> (4 - i) & 1)
                image_rect(m, x + i * scale, y + j * scale, scale, scale, c);
    }
}

void image_text(image *m, int x, int y, int scale, const char *text, colour c)
{
    for (; *text; text++, x += 6 * scale)
        for (size_t k = 0; k < sizeof font / sizeof *font; k++)
            if (font[k].c == *text)
                draw_glyph(m, x, y, scale, font[k].rows, c);
}

/* ---- colour map ---- */

static uint8_t to_byte(double linear)
{
    double s = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055; /* sRGB */
    return (uint8_t)lround(255 * fmin(1, fmax(0, s)));
}

/* a colour of OKLab by lightness, chroma and hue (degrees) */
static colour from_oklab(double light, double chroma, double hue)
{
    const double rad = 3.14159265358979323846 / 180, a = chroma * cos(hue * rad), b = chroma * sin(hue * rad);
    const double l = light + 0.3963377774 * a + 0.2158037573 * b, m = light - 0.1055613458 * a - 0.0638541728 * b;
    const double n = light - 0.0894841775 * a - 1.2914855480 * b, l3 = l * l * l, m3 = m * m * m, n3 = n * n * n;
    return (colour){to_byte(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * n3),
                    to_byte(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * n3),
                    to_byte(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * n3)};
}

colour image_map(double s)
{
    s = s > 0 ? s < 1 ? s : 1 : 0;
    const double u = 2 * s - 1;
    /* violet (hue 300 degrees) through blue and green to yellow (hue 105); chroma stays inside what a screen can
       show */
    return from_oklab(0.25 + 0.67 * s, 0.085 + 0.045 * u * u, 300 - 195 * s);
}

colour image_map_signed(double s)
{
    s = s > 0 ? s < 1 ? s : 1 : 0;
    const double u = fabs(2 * s - 1);
    return from_oklab(0.88 - 0.45 * u, u * (0.2 - 0.06 * u), s < 0.5 ? 258 : 27);
}

/* ---- PNG ---- */

#ifdef HAVE_LIBPNG

bool image_write_png(const image *m, FILE *f)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_init_io(png, f);
    png_set_IHDR(png, info, (png_uint_32)m->width, (png_uint_32)m->height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < m->height; y++)
        png_write_row(png, m->rgb + 3 * (size_t)y * (size_t)m->width);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    return true;
}

#else

/* bytes of a chunk with its checksum under way */
typedef struct chunk {
    FILE *f;
    uint32_t crc, a, b; /* a, b: the two sums of Adler-32 over the unpacked bytes */
} chunk;

static void put_byte(chunk *c, uint32_t byte)
{
    c->crc ^= byte;
    for (int k = 0; k < 8; k++)
        c->crc = c->crc & 1 ? c->crc >> 1 ^ 0xedb88320u : c->crc >> 1;
    fputc((int)byte, c->f);
}
static void put_u32(chunk *c, uint32_t v)
{
    for (int k = 24; k >= 0; k -= 8)
        put_byte(c, v >> k & 255);
}
static void begin_chunk(chunk *c, uint32_t size, const char *name)
{
    put_u32(c, size);
    c->crc = 0xffffffffu;
    for (int k = 0; k < 4; k++)
        put_byte(c, (unsigned char)name[k]);
}
static void end_chunk(chunk *c) { put_u32(c, ~c->crc); }

static void put_raw(chunk *c, uint8_t byte)
{
    put_byte(c, byte);
    c->a = (c->a + byte) % 65521;
    c->b = (c->b + c->a) % 65521;
}

/* rows in stored (not packed) blocks of a zlib stream, one row a block; a row is at most 65535 bytes wide */
bool image_write_png(const image *m, FILE *f)
{
    static const unsigned char magic[8] = {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
    const uint32_t row = 3 * (uint32_t)m->width + 1, rows = (uint32_t)m->height;
    chunk c = {f, 0, 1, 0};
    if (row > 65535)
        return false;
    fwrite(magic, 1, sizeof magic, f);
    begin_chunk(&c, 13, "IHDR");
    put_u32(&c, (uint32_t)m->width);
    put_u32(&c, rows);
    put_byte(&c, 8); /* bits */
    put_byte(&c, 2); /* red, green, blue */
    for (int k = 0; k < 3; k++)
        put_byte(&c, 0);
    end_chunk(&c);
    begin_chunk(&c, 2 + rows * (5 + row) + 4, "IDAT");
    put_byte(&c, 0x78);
    put_byte(&c, 0x01);
    for (uint32_t y = 0; y < rows; y++) {
        put_byte(&c, y + 1 == rows);
        put_byte(&c, row & 255);
        put_byte(&c, row >> 8);
        put_byte(&c, ~row & 255);
        put_byte(&c, ~row >> 8 & 255);
        put_raw(&c, 0); /* no filter */
        for (uint32_t x = 0; x + 1 < row; x++)
            put_raw(&c, m->rgb[y * (row - 1) + x]);
    }
    put_u32(&c, c.b << 16 | c.a);
    end_chunk(&c);
    begin_chunk(&c, 0, "IEND");
    end_chunk(&c);
    return !ferror(f);
}

#endif
