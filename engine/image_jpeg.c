/* JPEG pictures by libjpeg. */
#include "engine/image_internal.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

/* Decoding time grows with pixels times scans: more scans than any program writes are refused. */
enum {
    MAX_SCANS = 200
};

typedef struct decoder {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    jmp_buf failed;
    unsigned char *volatile samples;
} decoder;

static void fail(j_common_ptr jpeg) {
    decoder *d = jpeg->client_data;
    longjmp(d->failed, 1);
}

static void stay_silent(j_common_ptr jpeg) {
    (void)jpeg;
}

static void count_scans(j_common_ptr jpeg) {
    decoder *d = jpeg->client_data;
    if (d->jpeg.input_scan_number > MAX_SCANS)
        fail(jpeg);
}

static void decode_rows(decoder *d, size_t row) {
    while (d->jpeg.output_scanline < d->jpeg.output_height) {
        JSAMPROW at = d->samples + d->jpeg.output_scanline * row;
        jpeg_read_scanlines(&d->jpeg, &at, 1);
    }
}

/* Everything that libjpeg may jump out of. */
static const char *decode(decoder *d, const char *data, size_t length) {
    union {
        const char *given;
        unsigned char *wanted; /* libjpeg does not write there */
    } input = {.given = data};
    if (setjmp(d->failed))
        return "it is a damaged JPEG file";
    jpeg_create_decompress(&d->jpeg);
    d->jpeg.progress = &d->progress;
    jpeg_mem_src(&d->jpeg, input.wanted, (unsigned long)length);
    jpeg_read_header(&d->jpeg, TRUE);
    if (d->jpeg.image_width > PLR_IMAGE_MAX_SIDE || d->jpeg.image_height > PLR_IMAGE_MAX_SIDE ||
        (size_t)d->jpeg.image_width * d->jpeg.image_height > PLR_IMAGE_MAX_BYTES / 4)
        return "it is too large";
    /* every block of 8 x 8 takes a bit at least, in the coarsest component one of 32 x 32 pixels */
    if ((size_t)d->jpeg.image_width * d->jpeg.image_height > length * 8192)
        return "it is cut off";
    if (d->jpeg.num_components != 1 && d->jpeg.num_components != 3)
        return "its colours are neither grey nor RGB";
    d->jpeg.out_color_space = d->jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    d->jpeg.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&d->jpeg);
    size_t row = (size_t)d->jpeg.output_width * (size_t)d->jpeg.output_components;
    d->samples = malloc(row * d->jpeg.output_height);
    if (!d->samples)
        return "there is not enough memory";
    decode_rows(d, row);
    jpeg_finish_decompress(&d->jpeg);
    return NULL;
}

bool plr_image_is_jpeg(const char *data, size_t length) {
    return length > 3 && memcmp(data, "\xff\xd8\xff", 3) == 0;
}

const char *plr_image_decode_jpeg(const char *data, size_t length, plr_image *image) {
    decoder *d = calloc(1, sizeof *d);
    if (!d)
        return "there is not enough memory";
    d->jpeg.err = jpeg_std_error(&d->errors);
    d->jpeg.client_data = d;
    d->errors.error_exit = fail;
    d->errors.output_message = stay_silent;
    d->progress.progress_monitor = count_scans;
    const char *fault = decode(d, data, length);
    if (fault)
        free(d->samples);
    else
        *image = (plr_image){.width = d->jpeg.output_width,
                             .height = d->jpeg.output_height,
                             .depth = 1,
                             .components = (uint32_t)d->jpeg.output_components,
                             .type = PLR_UNORM8,
                             .samples = d->samples};
    jpeg_destroy_decompress(&d->jpeg);
    free(d);
    return fault;
}
