/* OpenEXR pictures: the first part, its channels R, G, B and A or Y, or its only one, as floats. */
#include "engine/image_internal.h"

#include <stdlib.h>
#include <string.h>
#include <openexr.h>

typedef struct input {
    const char *data;
    size_t length;
} input;

typedef struct reader {
    exr_context_t exr;
    exr_attr_box2i_t window;
    uint32_t width, height, components;
    float *samples;
} reader;

static int64_t read_bytes(exr_const_context_t exr, void *user, void *buffer, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t error) {
    const input *in = user;
    (void)exr;
    (void)error;
    if (offset >= in->length)
        return -1;
    size_t left = in->length - (size_t)offset, count = size < left ? (size_t)size : left;
    memcpy(buffer, in->data + offset, count);
    return (int64_t)count;
}

static int64_t query_size(exr_const_context_t exr, void *user) {
    (void)exr;
    return (int64_t)((const input *)user)->length;
}

/* OpenEXR's own handler prints. */
static void stay_silent(exr_const_context_t exr, exr_result_t code, const char *message) {
    (void)exr;
    (void)code;
    (void)message;
}

static bool is_fine(exr_result_t result) {
    return result == EXR_ERR_SUCCESS;
}

/* Which component a channel is, -1: none. */
static int component_of(const reader *r, const char *name) {
    if (r->components < 3)
        return strcmp(name, "A") == 0 && r->components == 2 ? 1 : strcmp(name, "A") == 0 ? -1 : 0;
    static const char *const names[] = {"R", "G", "B", "A"};
    for (int i = 0; i < 4; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

static const exr_attr_chlist_entry_t *find_channel(const exr_attr_chlist_t *channels,
                                                   const char *name) {
    for (int i = 0; i < channels->num_channels; i++)
        if (strcmp(channels->entries[i].name.str, name) == 0)
            return &channels->entries[i];
    return NULL;
}

static const char *find_components(reader *r) {
    const exr_attr_chlist_t *channels;
    if (!is_fine(exr_get_channels(r->exr, 0, &channels)) || channels->num_channels < 1)
        return "it has no channels";
    bool coloured =
        find_channel(channels, "R") || find_channel(channels, "G") || find_channel(channels, "B");
    bool has_alpha = find_channel(channels, "A");
    if (!coloured && channels->num_channels > 1 + has_alpha)
        return "its channels are neither RGB nor Y";
    bool alpha_too = has_alpha && channels->num_channels > 1;
    r->components = (coloured ? 3u : 1u) + alpha_too;
    for (int i = 0; i < channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *c = &channels->entries[i];
        if (component_of(r, c->name.str) >= 0 && (c->x_sampling != 1 || c->y_sampling != 1))
            return "its channels are not of one size";
    }
    return NULL;
}

static const char *read_sizes(reader *r, size_t length) {
    exr_storage_t storage;
    if (!is_fine(exr_get_storage(r->exr, 0, &storage)) ||
        !is_fine(exr_get_data_window(r->exr, 0, &r->window)))
        return "it is damaged";
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return "it has deep pixels";
    int64_t width = (int64_t)r->window.max.x - r->window.min.x + 1;
    int64_t height = (int64_t)r->window.max.y - r->window.min.y + 1;
    if (width < 1 || height < 1)
        return "it is damaged";
    if (width > PLR_IMAGE_MAX_SIDE || height > PLR_IMAGE_MAX_SIDE ||
        (uint64_t)(width * height) * 16 > PLR_IMAGE_MAX_BYTES)
        return "it is too large";
    /* zlib packs 1032:1 at best, the lossy packings better; this is what no picture reaches */
    if ((uint64_t)(width * height) > (uint64_t)length << 14)
        return "it is cut off";
    r->width = (uint32_t)width;
    r->height = (uint32_t)height;
    return NULL;
}

/* Tells the pipeline where the samples of its chunk go, whose corner is at (x, y) of the window. */
static bool point(const reader *r, exr_decode_pipeline_t *pipeline, uint32_t x, uint32_t y) {
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        int component = component_of(r, channel->channel_name);
        channel->decode_to_ptr = NULL;
        if (component < 0)
            continue;
        if (channel->width < 0 || channel->height < 0 || (uint32_t)channel->width > r->width - x ||
            (uint32_t)channel->height > r->height - y)
            return false;
        size_t pixel = (size_t)y * r->width + x;
        channel->decode_to_ptr =
            (uint8_t *)(r->samples + pixel * r->components + (size_t)component);
        channel->user_pixel_stride = (int32_t)(r->components * sizeof(float));
        channel->user_line_stride = (int32_t)(r->width * r->components * sizeof(float));
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
    return true;
}

static bool run(const reader *r, exr_decode_pipeline_t *pipeline, const exr_chunk_info_t *chunk,
                bool *started, uint32_t x, uint32_t y) {
    bool fine = is_fine(*started ? exr_decoding_update(r->exr, 0, chunk, pipeline)
                                 : exr_decoding_initialize(r->exr, 0, chunk, pipeline));
    bool first = !*started;
    *started = true;
    return fine && point(r, pipeline, x, y) &&
           (!first || is_fine(exr_decoding_choose_default_routines(r->exr, 0, pipeline))) &&
           is_fine(exr_decoding_run(r->exr, 0, pipeline));
}

static bool read_rows(const reader *r) {
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    int32_t rows = 0;
    bool started = false;
    bool fine = is_fine(exr_get_scanlines_per_chunk(r->exr, 0, &rows)) && rows > 0;
    for (uint32_t y = 0; fine && y < r->height; y += (uint32_t)rows) {
        exr_chunk_info_t chunk = {0};
        fine = is_fine(exr_read_scanline_chunk_info(r->exr, 0, r->window.min.y + (int)y, &chunk)) &&
               run(r, &pipeline, &chunk, &started, 0, y);
    }
    exr_decoding_destroy(r->exr, &pipeline);
    return fine;
}

static bool read_tiles(const reader *r) {
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    int32_t width = 0, height = 0;
    bool started = false;
    bool fine =
        is_fine(exr_get_tile_sizes(r->exr, 0, 0, 0, &width, &height)) && width > 0 && height > 0;
    for (uint32_t y = 0, row = 0; fine && y < r->height; y += (uint32_t)height, row++)
        for (uint32_t x = 0, column = 0; fine && x < r->width; x += (uint32_t)width, column++) {
            exr_chunk_info_t chunk = {0};
            fine =
                is_fine(exr_read_tile_chunk_info(r->exr, 0, (int)column, (int)row, 0, 0, &chunk)) &&
                run(r, &pipeline, &chunk, &started, x, y);
        }
    exr_decoding_destroy(r->exr, &pipeline);
    return fine;
}

/* The colours of the format are multiplied by alpha; those of textures are not. */
static void divide_by_alpha(const reader *r) {
    if (r->components != 2 && r->components != 4)
        return;
    uint32_t colours = r->components - 1;
    float *pixel = r->samples, *end = pixel + (size_t)r->width * r->height * r->components;
    for (; pixel < end; pixel += r->components)
        for (uint32_t c = 0; pixel[colours] > 0 && c < colours; c++)
            pixel[c] /= pixel[colours];
}

static const char *read_picture(reader *r, size_t length) {
    const char *fault = read_sizes(r, length);
    if (!fault)
        fault = find_components(r);
    if (fault)
        return fault;
    r->samples = calloc((size_t)r->width * r->height, r->components * sizeof(float));
    if (!r->samples)
        return "there is not enough memory";
    exr_storage_t storage;
    exr_get_storage(r->exr, 0, &storage);
    if (!(storage == EXR_STORAGE_TILED ? read_tiles(r) : read_rows(r)))
        return "it is damaged or cut off";
    divide_by_alpha(r);
    return NULL;
}

bool plr_image_is_exr(const char *data, size_t length) {
    return length > 4 && memcmp(data, "v/1\x01", 4) == 0;
}

const char *plr_image_decode_exr(const char *data, size_t length, plr_image *image) {
    input in = {data, length};
    reader r = {0};
    exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
    options.error_handler_fn = stay_silent;
    options.user_data = &in;
    options.read_fn = read_bytes;
    options.size_fn = query_size;
    options.max_image_width = options.max_image_height = (int)PLR_IMAGE_MAX_SIDE;
    options.max_tile_width = options.max_tile_height = (int)PLR_IMAGE_MAX_SIDE;
    if (!is_fine(exr_start_read(&r.exr, "picture", &options)))
        return "it is a damaged OpenEXR file";
    const char *fault = read_picture(&r, length);
    exr_finish(&r.exr);
    if (fault) {
        free(r.samples);
        return fault;
    }
    *image = (plr_image){.width = r.width,
                         .height = r.height,
                         .depth = 1,
                         .components = r.components,
                         .type = PLR_FLOAT32,
                         .samples = r.samples};
    return NULL;
}
