/* Decoders of files in memory, one for each library. Each fills an image with the top row first and
 * returns NULL, or says why it cannot (a static string). */
#ifndef PLR_ENGINE_IMAGE_INTERNAL_H
#define PLR_ENGINE_IMAGE_INTERNAL_H

#include "engine/image.h"

#define PLR_IMAGE_MAX_SIDE 32768u
#define PLR_IMAGE_MAX_BYTES ((size_t)1 << 30)

/* PNG, BMP, TGA, GIF (its first picture). */
const char *plr_image_decode_stb(const char *data, size_t length, plr_image *image);
const char *plr_image_decode_jpeg(const char *data, size_t length, plr_image *image);
const char *plr_image_decode_hdr(const char *data, size_t length, plr_image *image);
bool plr_image_is_jpeg(const char *data, size_t length);
bool plr_image_is_hdr(const char *data, size_t length);

#endif
