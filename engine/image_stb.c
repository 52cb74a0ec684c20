/* The one place where stb_image is compiled: only the formats that are used, nothing but memory. */
#include "engine/image_internal.h"

#include <limits.h>
#include <stdlib.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_GIF
#define STBI_ONLY_HDR
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
#include <stb/stb_image.h>

/* No format but JPEG says more pixels than this with so few bytes (PNG: one bit a pixel, 1032:1);
 * memory is not taken for pixels that cannot be there. */
static bool is_plausible(const unsigned char *bytes, size_t length, uint64_t pixels) {
    bool jpeg = length > 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
    return pixels <= length * (jpeg ? UINT64_C(1) << 20 : UINT64_C(8256)) + 65536;
}

const char *plr_image_decode_stb(const char *data, size_t length, plr_image *image) {
    const unsigned char *bytes = (const unsigned char *)data;
    int width, height, components, size = (int)length;
    if (length > INT_MAX)
        return "the file is too large";
    if (!stbi_info_from_memory(bytes, size, &width, &height, &components))
        return "it is no PNG, JPEG, BMP, TGA, GIF or HDR file, or damaged";
    bool hdr = stbi_is_hdr_from_memory(bytes, size), deep = stbi_is_16_bit_from_memory(bytes, size);
    plr_sample_type type = hdr ? PLR_FLOAT32 : deep ? PLR_UNORM16 : PLR_UNORM8;
    uint64_t pixels = (uint64_t)width * (uint64_t)height;
    if (width < 1 || height < 1 || (unsigned)width > PLR_IMAGE_MAX_SIDE ||
        (unsigned)height > PLR_IMAGE_MAX_SIDE || pixels * 16 > 16 * (uint64_t)PLR_IMAGE_MAX_BYTES ||
        pixels * (unsigned)components *
                (hdr    ? 4
                 : deep ? 2
                        : 1) >
            PLR_IMAGE_MAX_BYTES)
        return "it is too large";
    if (!is_plausible(bytes, length, pixels))
        return "it is cut off";
    image->samples =
        hdr    ? (void *)stbi_loadf_from_memory(bytes, size, &width, &height, &components, 0)
        : deep ? (void *)stbi_load_16_from_memory(bytes, size, &width, &height, &components, 0)
               : (void *)stbi_load_from_memory(bytes, size, &width, &height, &components, 0);
    if (!image->samples)
        return stbi_failure_reason();
    image->width = (uint32_t)width;
    image->height = (uint32_t)height;
    image->depth = 1;
    image->components = (uint32_t)components;
    image->type = type;
    return NULL;
}
