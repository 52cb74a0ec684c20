/* The one place where stb_image is compiled: only the formats that are used, nothing but memory.
 * Its readers of JPEG and HDR are left out: damaged files make them write out of bounds or never
 * end. */
#include "engine/image_internal.h"

#include <limits.h>
#include <stdlib.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_GIF
#define STBI_NO_LINEAR
#define STBI_MAX_DIMENSIONS 32768
#define STBI_ASSERT(condition) ((void)(condition))
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wcast-qual"
#endif
/* An empty chunk makes it copy no bytes to NULL, and NULL + 0: harmless, but the sanitizer of
 * undefined behaviour stops there. */
#if defined(__clang__)
#pragma clang attribute push(                                                                      \
    __attribute__((no_sanitize("pointer-overflow", "nonnull-attribute"))), apply_to = function)
#endif
#include <stb/stb_image.h>
#if defined(__clang__)
#pragma clang attribute pop
#endif

/* No file says more pixels than this with so few bytes (PNG: one bit a pixel, 1032:1); memory is
 * not taken for pixels that cannot be there. */
#define PIXELS_PER_BYTE 8256

static const char *check_size(uint64_t pixels, uint64_t bytes_per_pixel, size_t length) {
    if (pixels * bytes_per_pixel > PLR_IMAGE_MAX_BYTES)
        return "it is too large";
    return pixels > (uint64_t)length * PIXELS_PER_BYTE ? "it is cut off" : NULL;
}

const char *plr_image_decode_stb(const char *data, size_t length, plr_image *image) {
    const unsigned char *bytes = (const unsigned char *)data;
    int width, height, components, size = (int)length;
    if (length > INT_MAX)
        return "the file is too large";
    if (!stbi_info_from_memory(bytes, size, &width, &height, &components) || width < 1 ||
        height < 1)
        return "it is of no format that is read, or damaged";
    bool deep = stbi_is_16_bit_from_memory(bytes, size);
    const char *fault = check_size((uint64_t)width * (uint64_t)height,
                                   (uint64_t)components * (deep ? 2 : 1), length);
    if (fault)
        return fault;
    void *samples =
        deep ? (void *)stbi_load_16_from_memory(bytes, size, &width, &height, &components, 0)
             : (void *)stbi_load_from_memory(bytes, size, &width, &height, &components, 0);
    if (!samples) /* the library's own reasons are one word each, and there may be none */
        return "it is damaged";
    *image = (plr_image){.width = (uint32_t)width,
                         .height = (uint32_t)height,
                         .depth = 1,
                         .components = (uint32_t)components,
                         .type = deep ? PLR_UNORM16 : PLR_UNORM8,
                         .samples = samples};
    return NULL;
}
