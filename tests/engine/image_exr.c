/* OpenEXR pictures of all layouts that are read, written with the format's own library. */
#include <openexr.h>

#include "engine/file.h"
#include "engine/image_internal.h"
#include "tests/tap.h"

enum {
    WIDTH = 5,
    HEIGHT = 3,
    TILE = 2
};

typedef struct layout {
    const char *what;
    const char *channels[5]; /* by name, as the format wants them */
    exr_pixel_type_t type;
    bool tiled;
    exr_compression_t compression;
    uint32_t components;  /* of the image */
    const char *order[4]; /* the channel of each; NULL: 0 */
    const char *fault;
} layout;

/* A value that half floats hold; no two are equal in one picture. */
static float value_of(int channel, int x, int y) {
    return (float)(channel * 32 + y * 8 + x) / 128.0f;
}

static int64_t append(exr_const_context_t exr, void *buffer, const void *data, uint64_t length,
                      uint64_t offset, exr_stream_error_func_ptr_t error) {
    (void)exr;
    (void)error;
    return plr_buffer_write_at(buffer, (size_t)offset, data, (size_t)length) ? (int64_t)length : -1;
}

static int count_of(const layout *l) {
    int count = 0;
    while (l->channels[count])
        count++;
    return count;
}

/* One chunk, whose corner is at (x, y): all samples of a channel as floats, row by row. */
static void write_chunk(exr_context_t exr, const layout *l, const exr_chunk_info_t *chunk, int x,
                        int y) {
    float samples[5][WIDTH * HEIGHT];
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    CHECK(exr_encoding_initialize(exr, 0, chunk, &pipeline) == EXR_ERR_SUCCESS);
    for (int c = 0; c < count_of(l); c++) {
        int width = pipeline.channels[c].width, height = pipeline.channels[c].height;
        for (int i = 0; i < width * height; i++)
            samples[c][i] = value_of(c, x + i % width, y + i / width);
        pipeline.channels[c].encode_from_ptr = (const uint8_t *)samples[c];
        pipeline.channels[c].user_pixel_stride = sizeof(float);
        pipeline.channels[c].user_line_stride = width * (int)sizeof(float);
        pipeline.channels[c].user_bytes_per_element = sizeof(float);
        pipeline.channels[c].user_data_type = EXR_PIXEL_FLOAT;
    }
    exr_encoding_choose_default_routines(exr, 0, &pipeline);
    CHECK(exr_encoding_run(exr, 0, &pipeline) == EXR_ERR_SUCCESS);
    exr_encoding_destroy(exr, &pipeline);
}

static void write_picture(const layout *l, plr_buffer *out) {
    exr_context_t exr = NULL;
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_chunk_info_t chunk = {0};
    int part = 0;
    options.user_data = out;
    options.write_fn = append;
    exr_start_write(&exr, "picture", EXR_WRITE_FILE_DIRECTLY, &options);
    exr_add_part(exr, NULL, l->tiled ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part);
    exr_initialize_required_attr_simple(exr, part, WIDTH, HEIGHT, l->compression);
    if (l->tiled)
        exr_set_tile_descriptor(exr, part, TILE, TILE, EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN);
    for (int c = 0; c < count_of(l); c++)
        exr_add_channel(exr, part, l->channels[c], l->type, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    CHECK(exr_write_header(exr) == EXR_ERR_SUCCESS);
    int32_t rows = 1;
    if (!l->tiled)
        exr_get_scanlines_per_chunk(exr, part, &rows);
    for (int y = 0; y < HEIGHT; y += l->tiled ? TILE : rows)
        for (int x = 0; x < WIDTH; x += l->tiled ? TILE : WIDTH) {
            if (l->tiled)
                exr_write_tile_chunk_info(exr, part, x / TILE, y / TILE, 0, 0, &chunk);
            else
                exr_write_scanline_chunk_info(exr, part, y, &chunk);
            write_chunk(exr, l, &chunk, x, y);
        }
    exr_finish(&exr);
}

/* What a component of a texel must be: the value of its channel, divided by that of A. */
static float expected(const layout *l, uint32_t component, int x, int y) {
    const char *name = l->order[component];
    float value = 0, alpha = 1;
    bool has_alpha = l->components == 2 || l->components == 4;
    for (int c = 0; c < count_of(l); c++) {
        if (name && strcmp(l->channels[c], name) == 0)
            value = value_of(c, x, y);
        if (has_alpha && strcmp(l->channels[c], "A") == 0)
            alpha = value_of(c, x, y);
    }
    return component + 1 < l->components && has_alpha && alpha > 0 ? value / alpha : value;
}

static void test_layout(const layout *l) {
    plr_buffer file = {0};
    plr_image image = {0};
    write_picture(l, &file);
    const char *fault = plr_image_decode_exr((const char *)file.data, file.length, &image);
    bool fine = l->fault ? fault && strcmp(fault, l->fault) == 0
                         : !fault && image.width == WIDTH && image.height == HEIGHT &&
                               image.components == l->components && image.type == PLR_FLOAT32;
    for (int i = 0; fine && !fault && i < WIDTH * HEIGHT; i++)
        for (uint32_t c = 0; c < l->components; c++)
            fine = fine && ((const float *)image.samples)[(uint32_t)i * l->components + c] ==
                               expected(l, c, i % WIDTH, i / WIDTH);
    TAP_RESULT(fine, "%s", l->what);
    plr_image_free(&image);
    /* cut off anywhere it is a fault, never a crash */
    int understood = 0;
    for (size_t length = 0; length < file.length; length++) {
        char *exact = malloc(length + 1);
        memcpy(exact, file.data, length);
        understood += !plr_image_decode_exr(exact, length, &image);
        plr_image_free(&image);
        free(exact);
    }
    CHECK_INT(understood, 0);
    plr_buffer_free(&file);
}

static const layout layouts[] = {
    {"RGBA, rows of floats",
     {"A", "B", "G", "R"},
     EXR_PIXEL_FLOAT,
     false,
     EXR_COMPRESSION_ZIP,
     4,
     {"R", "G", "B", "A"},
     NULL},
    {"RGB, rows of half floats",
     {"B", "G", "R"},
     EXR_PIXEL_HALF,
     false,
     EXR_COMPRESSION_NONE,
     3,
     {"R", "G", "B"},
     NULL},
    {"RGB, tiles of half floats",
     {"B", "G", "R"},
     EXR_PIXEL_HALF,
     true,
     EXR_COMPRESSION_NONE,
     3,
     {"R", "G", "B"},
     NULL},
    {"RGBA, tiles of floats",
     {"A", "B", "G", "R"},
     EXR_PIXEL_FLOAT,
     true,
     EXR_COMPRESSION_ZIPS,
     4,
     {"R", "G", "B", "A"},
     NULL},
    {"Y", {"Y"}, EXR_PIXEL_HALF, false, EXR_COMPRESSION_PIZ, 1, {"Y"}, NULL},
    {"Y and A", {"A", "Y"}, EXR_PIXEL_FLOAT, false, EXR_COMPRESSION_RLE, 2, {"Y", "A"}, NULL},
    {"a channel of any name", {"Z"}, EXR_PIXEL_FLOAT, false, EXR_COMPRESSION_ZIP, 1, {"Z"}, NULL},
    {"RG and another",
     {"G", "R", "depth"},
     EXR_PIXEL_FLOAT,
     false,
     EXR_COMPRESSION_ZIP,
     3,
     {"R", "G", NULL},
     NULL},
    {"two channels without colours",
     {"U", "V"},
     EXR_PIXEL_FLOAT,
     false,
     EXR_COMPRESSION_ZIP,
     0,
     {NULL},
     "its channels are neither RGB nor Y"},
};

int main(void) {
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++)
        test_layout(&layouts[i]);
    return tap_done();
}
