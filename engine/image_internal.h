#ifndef PLR_ENGINE_IMAGE_INTERNAL_H
#define PLR_ENGINE_IMAGE_INTERNAL_H

#include "engine/image.h"

#define PLR_IMAGE_MAX_SIDE 32768u
#define PLR_IMAGE_MAX_BYTES ((size_t)1 << 30)

/* Decodes by stb_image, top row first. NULL, or why not (a static string). */
const char *plr_image_decode_stb(const char *data, size_t length, plr_image *image);

#endif
