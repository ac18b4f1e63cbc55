/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* image.h: a picture in memory: rectangles, discs, lines, text, a colour map; written as PNG. */
#ifndef IMAGE_H
#define IMAGE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct colour {
    uint8_t r, g, b;
} colour;

typedef struct image {
    int width, height;
    uint8_t *rgb;
} image;

image image_new(int width, int height, colour fill);
void image_free(image *m);

/* whatever lies outside is cut off */
void image_rect(image *m, int x, int y, int width, int height, colour c);
void image_disc(image *m, double x, double y, double radius, colour c);
void image_line(image *m, double x0, double y0, double x1, double y1, colour c);

/* Text in the own 5 x 7 font, enlarged `scale` times; x, y: top left corner. ASCII; what the font lacks is left blank.
 */
void image_text(image *m, int x, int y, int scale, const char *text, colour c);
int image_text_width(const char *text, int scale);
int image_text_height(int scale);

/* Perceptually uniform: lightness rises evenly from dark violet to bright yellow (OKLab, Ottosson 2020); s in 0..1. */
colour image_map(double s);
/* For values of both signs: blue below, light grey at s = 0.5, red above, evenly darker to both ends. */
colour image_map_signed(double s);

/* with libpng where the program was built with -DHAVE_LIBPNG, else uncompressed by itself; false if writing failed */
bool image_write_png(const image *m, FILE *f);

#endif
