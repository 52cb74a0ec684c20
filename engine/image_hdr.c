/* Radiance pictures (.hdr, .pic): RGBE pixels, plain or run-length encoded in either of the two
 * ways that "Real Pixels" (Ward, Graphics Gems II) and the Radiance file formats document describe.
 */
#include "engine/image_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    const unsigned char *at, *end;
} reader;

static bool starts_with(const reader *r, const char *text) {
    size_t length = strlen(text);
    return (size_t)(r->end - r->at) >= length && memcmp(r->at, text, length) == 0;
}

/* Goes on behind the next newline; false if there is none. */
static bool next_line(reader *r) {
    const unsigned char *newline = memchr(r->at, '\n', (size_t)(r->end - r->at));
    if (newline)
        r->at = newline + 1;
    return newline != NULL;
}

static bool read_side(reader *r, const char *axis, uint32_t *side) {
    *side = 0;
    if (!starts_with(r, axis))
        return false;
    r->at += strlen(axis);
    while (r->at < r->end && *r->at >= '0' && *r->at <= '9' && *side <= PLR_IMAGE_MAX_SIDE)
        *side = *side * 10 + (uint32_t)(*r->at++ - '0');
    return *side > 0;
}

/* The lines before the pixels. Only pictures whose rows run from left to right are read. */
static const char *read_header(reader *r, uint32_t *width, uint32_t *height, bool *bottom_first) {
    bool known = false, more = next_line(r);
    while (more && r->at < r->end && *r->at != '\n' && *r->at != '\r') {
        if (starts_with(r, "FORMAT="))
            known = starts_with(r, "FORMAT=32-bit_rle_rgbe");
        more = next_line(r);
    }
    if (!known || !next_line(r))
        return "it is no RGBE picture";
    *bottom_first = starts_with(r, "+Y ");
    if (!read_side(r, *bottom_first ? "+Y " : "-Y ", height) || !read_side(r, " +X ", width) ||
        !next_line(r))
        return "its sizes cannot be read";
    if (*width > PLR_IMAGE_MAX_SIDE || *height > PLR_IMAGE_MAX_SIDE ||
        (uint64_t)*width * *height * 12 > PLR_IMAGE_MAX_BYTES)
        return "it is too large";
    return NULL;
}

/* One row of a component each: runs (count > 128) and literal bytes. */
static bool read_components(reader *r, unsigned char *row, uint32_t width) {
    for (uint32_t c = 0; c < 4; c++)
        for (uint32_t x = 0; x < width;) {
            uint32_t count = r->at < r->end ? *r->at++ : 0;
            bool run = count > 128;
            if (run)
                count -= 128;
            if (count == 0 || count > width - x || r->end - r->at < (run ? 1 : (ptrdiff_t)count))
                return false;
            for (uint32_t i = 0; i < count; i++)
                row[4 * (x + i) + c] = run ? *r->at : r->at[i];
            r->at += run ? 1 : count;
            x += count;
        }
    return true;
}

/* One row of whole pixels, where 1 1 1 n repeats the pixel before n times, n << 8 in a second row.
 */
static bool read_pixels(reader *r, unsigned char *row, uint32_t width) {
    unsigned shift = 0;
    for (uint32_t x = 0; x < width;) {
        if (r->end - r->at < 4)
            return false;
        const unsigned char *pixel = r->at;
        r->at += 4;
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            memcpy(row + 4 * x++, pixel, 4);
            shift = 0;
            continue;
        }
        uint32_t count = shift < 24 ? (uint32_t)pixel[3] << shift : 0;
        if (x == 0 || count == 0 || count > width - x)
            return false;
        for (uint32_t i = 0; i < count; i++, x++)
            memcpy(row + 4 * x, row + 4 * (x - 1), 4);
        shift += 8;
    }
    return true;
}

static bool read_row(reader *r, unsigned char *row, uint32_t width) {
    bool by_components = width >= 8 && width < 32768 && r->end - r->at >= 4 && r->at[0] == 2 &&
                         r->at[1] == 2 && (uint32_t)r->at[2] << 8 == (width & 0xff00) &&
                         r->at[3] == (width & 0xff);
    if (!by_components)
        return read_pixels(r, row, width);
    r->at += 4;
    return read_components(r, row, width);
}

static void convert_row(const unsigned char *row, uint32_t width, float *out) {
    for (uint32_t x = 0; x < width; x++, row += 4, out += 3) {
        float scale = row[3] ? ldexpf(1, row[3] - 136) : 0;
        for (int c = 0; c < 3; c++)
            out[c] = (float)row[c] * scale;
    }
}

bool plr_image_is_hdr(const char *data, size_t length) {
    reader r = {(const unsigned char *)data, (const unsigned char *)data + length};
    return starts_with(&r, "#?RADIANCE") || starts_with(&r, "#?RGBE");
}

const char *plr_image_decode_hdr(const char *data, size_t length, plr_image *image) {
    reader r = {(const unsigned char *)data, (const unsigned char *)data + length};
    uint32_t width, height;
    bool bottom_first;
    const char *fault = read_header(&r, &width, &height, &bottom_first);
    if (fault)
        return fault;
    /* four bytes make at most 255 pixels, and as many more in a second run: less than 2^16 */
    if ((uint64_t)width * height > ((uint64_t)(r.end - r.at) << 14))
        return "it is cut off";
    unsigned char *row = malloc((size_t)width * 4);
    float *samples = malloc((size_t)width * height * 3 * sizeof *samples);
    if (!row || !samples)
        fault = "there is not enough memory";
    for (uint32_t y = 0; y < height && !fault; y++) {
        uint32_t from_top = bottom_first ? height - 1 - y : y;
        if (read_row(&r, row, width))
            convert_row(row, width, samples + (size_t)from_top * width * 3);
        else
            fault = "it is damaged or cut off";
    }
    free(row);
    if (fault) {
        free(samples);
        return fault;
    }
    *image = (plr_image){.width = width,
                         .height = height,
                         .depth = 1,
                         .components = 3,
                         .type = PLR_FLOAT32,
                         .samples = samples};
    return NULL;
}
