/* Cube maps from pictures. */
#include "engine/image_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The faces as one sees them from inside (ISO/IEC 19775-1 V4 24.4.1, Background: the sides with +Y
 * up, the top with +Z up, the bottom with -Z up), in the order of GL's faces. */
static const struct {
    double forward[3], right[3], up[3];
    bool turned; /* row 0 from the left, as GL wants it, is the top row from the right */
} views[6] = {
    {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, true},    /* right */
    {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}, true},  /* left */
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, false},   /* top */
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}, false}, /* bottom */
    {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}, true},   /* back */
    {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, true},   /* front */
};

static const char no_memory[] = "there is not enough memory";

static bool allocate(plr_image *cube) {
    cube->depth = 6;
    cube->cube = true;
    cube->samples = malloc(plr_image_level_samples(cube, 0) * plr_image_sample_size(cube->type));
    return cube->samples != NULL;
}

/* Half a turn: the last pixel becomes the first. */
static void turn(char *face, size_t count, size_t pixel) {
    char kept[16];
    for (char *low = face, *high = face + (count - 1) * pixel; low < high;
         low += pixel, high -= pixel) {
        memcpy(kept, low, pixel);
        memcpy(low, high, pixel);
        memcpy(high, kept, pixel);
    }
}

const char *plr_image_cube(const plr_image *const faces[6], plr_image *cube) {
    plr_image made = {.width = faces[0]->width, .height = faces[0]->height};
    bool alpha = false, coloured = false;
    for (int i = 0; i < 6; i++) {
        if (faces[i]->width != made.width || faces[i]->height != made.width)
            return "the faces of a cube are not squares of one size";
        alpha = alpha || faces[i]->components == 2 || faces[i]->components == 4;
        coloured = coloured || faces[i]->components > 2;
        made.type = faces[i]->type > made.type ? faces[i]->type : made.type;
    }
    made.components = (coloured ? 3u : 1u) + alpha;
    made.depth = 6;
    if ((uint64_t)made.width * made.width * 6 * made.components * 4 > PLR_IMAGE_MAX_BYTES)
        return "it is too large";
    if (!allocate(&made))
        return no_memory;
    size_t count = (size_t)made.width * made.width;
    size_t pixel = made.components * plr_image_sample_size(made.type);
    for (int i = 0; i < 6; i++) {
        char *face = (char *)made.samples + count * pixel * (size_t)i;
        plr_image_convert(faces[i], made.components, made.type, face);
        if (views[i].turned)
            turn(face, count, pixel);
    }
    *cube = made;
    return NULL;
}

/* ---- One picture of squares ---- */

/* Where each face lies, in squares from the upper left; `turned`: upside down. */
static const struct layout {
    uint32_t columns, rows;
    struct {
        uint32_t column, row;
        bool turned;
    } faces[6];
} layouts[] = {
    {6, 1, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}}},
    {1, 6, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 4, 0}, {0, 5, 0}}},
    {4, 3, {{2, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 2, 0}, {3, 1, 0}, {1, 1, 0}}},
    {3, 4, {{2, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 2, 0}, {1, 3, 1}, {1, 1, 0}}},
};

static void cut_squares(const plr_image *image, const struct layout *layout, plr_image *cube) {
    size_t pixel = image->components * plr_image_sample_size(image->type);
    size_t side = cube->width, row = side * pixel;
    for (int i = 0; i < 6; i++) {
        char *face = (char *)cube->samples + side * row * (size_t)i;
        size_t x = layout->faces[i].column * side;
        size_t y = (layout->rows - 1 - layout->faces[i].row) * side; /* rows from the bottom */
        for (size_t j = 0; j < side; j++)
            memcpy(face + j * row,
                   (const char *)image->samples + ((y + j) * image->width + x) * pixel, row);
        if (views[i].turned != layout->faces[i].turned)
            turn(face, side * side, pixel);
    }
}

/* ---- Panoramas ---- */

/* Linear between texels; columns go round, rows end at the poles. */
static double panorama_at(const plr_image *image, double x, double y, uint32_t c) {
    double column = floor(x), row = floor(y);
    uint32_t w = image->width, last = image->height - 1;
    uint32_t x0 = (uint32_t)((int64_t)column + w) % w, x1 = (x0 + 1) % w;
    uint32_t y0 = row < 0 ? 0 : (uint32_t)row > last ? last : (uint32_t)row;
    uint32_t y1 = row < 0 ? 0 : y0 < last ? y0 + 1 : last;
    double s = x - column, t = y - row;
    return (1 - t) * ((1 - s) * plr_image_sample(image, x0, y0, 0, c) +
                      s * plr_image_sample(image, x1, y0, 0, c)) +
           t * ((1 - s) * plr_image_sample(image, x0, y1, 0, c) +
                s * plr_image_sample(image, x1, y1, 0, c));
}

/* The middle of the panorama lies at -Z, the right half at +X, the upper edge at +Y. */
static void cut_panorama(const plr_image *image, plr_image *cube) {
    const double pi = 3.14159265358979323846;
    uint32_t side = cube->width;
    float *out = cube->samples;
    for (int face = 0; face < 6; face++)
        for (uint32_t j = 0; j < side; j++)
            for (uint32_t i = 0; i < side; i++) {
                double sign = views[face].turned ? -1 : 1, d[3];
                double right = sign * (2 * (i + 0.5) / side - 1);
                double up = sign * (2 * (j + 0.5) / side - 1);
                for (int k = 0; k < 3; k++)
                    d[k] = views[face].forward[k] + right * views[face].right[k] +
                           up * views[face].up[k];
                double x = (0.5 + atan2(d[0], -d[2]) / (2 * pi)) * image->width - 0.5;
                double y = (0.5 + atan2(d[1], hypot(d[0], d[2])) / pi) * image->height - 0.5;
                for (uint32_t c = 0; c < image->components; c++)
                    *out++ = (float)panorama_at(image, x, y, c);
            }
}

const char *plr_image_cube_from_picture(plr_image *image) {
    plr_image cube = {.components = image->components, .type = image->type};
    const struct layout *layout = NULL;
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        uint32_t side = image->width / layouts[i].columns;
        if (side && side * layouts[i].columns == image->width &&
            side * layouts[i].rows == image->height)
            layout = &layouts[i];
    }
    bool panorama = image->height > 1 && image->width == 2 * image->height;
    if (!layout && !panorama)
        return "the picture is neither six squares, a cross of squares nor a panorama";
    cube.width = cube.height = layout ? image->width / layout->columns : image->height / 2;
    if (panorama)
        cube.type = PLR_FLOAT32;
    if ((uint64_t)cube.width * cube.width * 24 * cube.components > PLR_IMAGE_MAX_BYTES)
        return "it is too large";
    if (!allocate(&cube))
        return no_memory;
    if (layout)
        cut_squares(image, layout, &cube);
    else
        cut_panorama(image, &cube);
    plr_image_free(image);
    *image = cube;
    return NULL;
}
