/* Decoders of files in memory, one for each format or library. Each fills an image with the top row
 * first and returns NULL, or says why it cannot (a static string). */
#ifndef PLR_ENGINE_IMAGE_INTERNAL_H
#define PLR_ENGINE_IMAGE_INTERNAL_H

#include "engine/image.h"

#define PLR_IMAGE_MAX_SIDE 32768u
#define PLR_IMAGE_MAX_BYTES ((size_t)1 << 30)

/* PNG, BMP, TGA, GIF (its first picture). */
const char *plr_image_decode_stb(const char *data, size_t length, plr_image *image);
const char *plr_image_decode_jpeg(const char *data, size_t length, plr_image *image);
const char *plr_image_decode_hdr(const char *data, size_t length, plr_image *image);
const char *plr_image_decode_exr(const char *data, size_t length, plr_image *image);
/* Volumes, cube maps and mipmaps too; the faces of cubes have the place that GL gives them. */
const char *plr_image_decode_dds(const char *data, size_t length, plr_image *image);
bool plr_image_is_dds(const char *data, size_t length);
bool plr_image_is_exr(const char *data, size_t length);
bool plr_image_is_jpeg(const char *data, size_t length);
bool plr_image_is_hdr(const char *data, size_t length);

/* ---- Whole images ---- */

/* Writes the samples of the finest level with at least as many components and as wide a type: L
 * becomes RGB of equal values, a missing alpha 1. */
void plr_image_convert(const plr_image *image, uint32_t components, plr_sample_type type,
                       void *out);
/* Drops all but the first slice or face of the finest level; false if that was all. */
bool plr_image_flatten(plr_image *image);
/* Makes sides that exceed the limits (width, height, depth) fit by averaging whole texels; mipmaps
 * are dropped. False without memory. */
bool plr_image_shrink(plr_image *image, const uint32_t limits[3]);
/* A cube from six squares of one size as they look from inside the cube, bottom row first: right,
 * left, top, bottom, back, front (ISO/IEC 19775-1 V4 34.2.1). NULL, or says why not. */
const char *plr_image_cube(const plr_image *const faces[6], plr_image *cube);
/* A cube from one picture: six squares in a row or column, a cross of squares, or a panorama that
 * is twice as wide as high. The picture is replaced. NULL, or says why not. */
const char *plr_image_cube_from_picture(plr_image *image);

/* ---- Images of nodes ---- */

/* A field whose value was refused has no value but the value's place; that is reported already. */
bool plr_image_is_refused(const plr_node *texture, const plr_field *image);

#endif
