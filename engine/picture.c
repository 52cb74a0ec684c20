/* Pictures to files. Each format is encoded in memory, then the file is replaced as a whole. */
#include <plugray/engine.h>

#include <math.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <openexr.h>
#include <png.h>

#include "engine/file.h"

typedef bool (*encoder)(const plr_picture *picture, bool transparent, plr_buffer *out);

/* ---- PNG ---- */

/* 0..1 as a byte, rounded; beyond is clamped, NaN is 0. */
static png_byte to_byte(float value) {
    if (!(value > 0.0f))
        return 0;
    return value >= 1.0f ? 255 : (png_byte)(value * 255.0f + 0.5f);
}

/* A row of premultiplied floats as bytes: over black, or straight with its alpha. */
static void to_bytes(const float *pixel, int width, bool transparent, png_byte *row) {
    for (int x = 0; x < width; x++, pixel += 4) {
        float alpha = pixel[3] > 0.0f ? fminf(pixel[3], 1.0f) : 0.0f; /* NaN is 0 */
        bool divide = transparent && alpha > 0.0f;
        for (int c = 0; c < 3; c++)
            *row++ = transparent && !divide ? 0 : to_byte(divide ? pixel[c] / alpha : pixel[c]);
        if (transparent)
            *row++ = to_byte(alpha);
    }
}

static void png_append(png_structp png, png_bytep data, png_size_t length) {
    if (!plr_buffer_append(png_get_io_ptr(png), data, length))
        png_error(png, "no memory");
}

static void png_flush_nothing(png_structp png) {
    (void)png;
}

/* libpng's own handlers print; ours are silent and jump. */
static void png_fail(png_structp png, png_const_charp message) {
    (void)message;
    png_longjmp(png, 1);
}

static void png_ignore(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

/* The part that libpng may leave by a jump: what it frees is owned by the caller. */
static bool write_png(png_structp png, png_infop info, const plr_picture *picture, bool transparent,
                      png_byte *row, plr_buffer *out) {
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_write_fn(png, out, png_append, png_flush_nothing);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, info, (png_uint_32)picture->width, (png_uint_32)picture->height, 8,
                 transparent ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < picture->height; y++) {
        to_bytes(picture->pixels + (size_t)y * (size_t)picture->width * 4, picture->width,
                 transparent, row);
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    return true;
}

static bool encode_png(const plr_picture *picture, bool transparent, plr_buffer *out) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, png_fail, png_ignore);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    png_byte *row = malloc((size_t)picture->width * 4);
    bool written = info && row && write_png(png, info, picture, transparent, row, out);
    free(row);
    png_destroy_write_struct(&png, &info);
    return written;
}

/* ---- NPY ---- */

static bool is_little_endian(void) {
    const unsigned short one = 1;
    return *(const unsigned char *)&one == 1;
}

/* Version 1.0 of the format of numpy.lib.format: magic, length of the header, a Python dictionary
 * padded so that the data starts at a multiple of 64, the data. */
static bool encode_npy(const plr_picture *picture, bool transparent, plr_buffer *out) {
    enum {
        PREFIX = 10,
        ALIGNMENT = 64
    };
    char header[2 * ALIGNMENT + 1];
    (void)transparent;
    int length = snprintf(header, sizeof header,
                          "{'descr': '%cf4', 'fortran_order': False, 'shape': (%d, %d, 4), }",
                          is_little_endian() ? '<' : '>', picture->height, picture->width);
    size_t total = PREFIX + (size_t)length + 1;
    total = (total + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    size_t padded = total - PREFIX;
    memset(header + length, ' ', padded - (size_t)length);
    header[padded - 1] = '\n';
    const unsigned char prefix[PREFIX] = {0x93,
                                          'N',
                                          'U',
                                          'M',
                                          'P',
                                          'Y',
                                          1,
                                          0,
                                          (unsigned char)(padded & 255),
                                          (unsigned char)(padded >> 8)};
    size_t count = (size_t)picture->width * (size_t)picture->height * 4;
    return plr_buffer_append(out, prefix, PREFIX) && plr_buffer_append(out, header, padded) &&
           plr_buffer_append(out, picture->pixels, count * sizeof(float));
}

/* ---- EXR ---- */

static int64_t exr_append(exr_const_context_t context, void *buffer, const void *data,
                          uint64_t length, uint64_t offset, exr_stream_error_func_ptr_t error) {
    (void)context;
    (void)error;
    return plr_buffer_write_at(buffer, (size_t)offset, data, (size_t)length) ? (int64_t)length : -1;
}

/* OpenEXR's own handler prints. */
static void exr_ignore(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    (void)code;
    (void)message;
}

static bool is_fine(exr_result_t result) {
    return result == EXR_ERR_SUCCESS;
}

static bool exr_header(exr_context_t exr, const plr_picture *picture) {
    static const char *const channels[] = {"A", "B", "G", "R"}; /* the file's order is by name */
    int part = 0;
    if (!is_fine(exr_add_part(exr, NULL, EXR_STORAGE_SCANLINE, &part)) ||
        !is_fine(exr_initialize_required_attr_simple(exr, part, picture->width, picture->height,
                                                     EXR_COMPRESSION_ZIP)))
        return false;
    for (int i = 0; i < 4; i++)
        if (!is_fine(exr_add_channel(exr, part, channels[i], EXR_PIXEL_FLOAT,
                                     EXR_PERCEPTUALLY_LINEAR, 1, 1)))
            return false;
    return is_fine(exr_write_header(exr));
}

/* Tells the pipeline where the samples of the chunk that starts at row `y` stand. */
static void exr_point(exr_encode_pipeline_t *pipeline, const plr_picture *picture, int y) {
    const float *row = picture->pixels + (size_t)y * (size_t)picture->width * 4;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        channel->encode_from_ptr = (const uint8_t *)(row + 3 - i); /* A, B, G, R */
        channel->user_pixel_stride = 4 * (int)sizeof(float);
        channel->user_line_stride = 4 * (int)sizeof(float) * picture->width;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static bool exr_rows(exr_context_t exr, const plr_picture *picture) {
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t rows = 0;
    bool fine = is_fine(exr_get_scanlines_per_chunk(exr, 0, &rows)) && rows > 0;
    for (int y = 0; fine && y < picture->height; y += rows) {
        exr_chunk_info_t chunk = {0};
        fine = is_fine(exr_write_scanline_chunk_info(exr, 0, y, &chunk)) &&
               is_fine(y ? exr_encoding_update(exr, 0, &chunk, &pipeline)
                         : exr_encoding_initialize(exr, 0, &chunk, &pipeline));
        if (!fine)
            break;
        exr_point(&pipeline, picture, y);
        fine = (y || is_fine(exr_encoding_choose_default_routines(exr, 0, &pipeline))) &&
               is_fine(exr_encoding_run(exr, 0, &pipeline));
    }
    exr_encoding_destroy(exr, &pipeline);
    return fine;
}

static bool encode_exr(const plr_picture *picture, bool transparent, plr_buffer *out) {
    exr_context_t exr = NULL;
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    (void)transparent;
    options.error_handler_fn = exr_ignore;
    options.user_data = out;
    options.write_fn = exr_append;
    if (!is_fine(exr_start_write(&exr, "picture", EXR_WRITE_FILE_DIRECTLY, &options)))
        return false;
    bool written = exr_header(exr, picture) && exr_rows(exr, picture);
    return is_fine(exr_finish(&exr)) && written;
}

/* ---- All ---- */

static const struct {
    const char *ending;
    encoder encode;
} formats[] = {{".png", encode_png}, {".exr", encode_exr}, {".npy", encode_npy}};

static encoder find_encoder(const char *path) {
    const char *ending = strrchr(path, '.');
    for (size_t i = 0; ending && i < sizeof formats / sizeof formats[0]; i++)
        if (strcasecmp(ending, formats[i].ending) == 0)
            return formats[i].encode;
    return NULL;
}

bool plr_picture_write(const plr_picture *picture, const char *path, bool transparent,
                       plr_diags *diags) {
    const plr_place place = {.file = path};
    encoder encode = find_encoder(path);
    if (!encode) {
        plr_diags_add(diags, PLR_CODE_OUTPUT, place,
                      "the picture's name must end in .png, .exr or .npy");
        return false;
    }
    plr_buffer buffer = {0};
    bool encoded = encode(picture, transparent, &buffer);
    int error = encoded ? plr_file_write(path, buffer.data, buffer.length) : 0;
    plr_buffer_free(&buffer);
    if (!encoded)
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "the picture cannot be encoded");
    else if (error)
        plr_diags_add(diags, PLR_CODE_OUTPUT, place, "the picture cannot be written: %s",
                      strerror(error));
    return encoded && !error;
}

void plr_picture_free(plr_picture *picture) {
    free(picture->pixels);
    *picture = (plr_picture){0};
}
