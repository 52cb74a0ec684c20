#include "engine/transfer_atlas.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/image_internal.h"

enum {
    MARGIN = 1, /* around each function, repeating its edge: nothing of a neighbour leaks in */
    MOST_SIDE = 8192,
    MOST_TEXELS = 1 << 22,
    RAMP_TEXELS = 2
};

static bool is_picture(const plr_texture *function) {
    return !function->failed && !function->generated && function->kind == PLR_TEXTURE_2D;
}

const plr_atlas_place *plr_atlas_add(plr_textures *textures, plr_arena *arena, plr_atlas *atlas,
                                     plr_texture *function) {
    for (size_t i = 0; i < atlas->places.count; i++)
        if (atlas->places.items[i]->function == function)
            return atlas->places.items[i];
    if (function && !is_picture(function))
        return NULL;
    if (function && !function->image.samples && function->node)
        plr_textures_reload(textures, function); /* it was uploaded before */
    if (function && !function->image.samples)
        return NULL;
    uint32_t width = function ? function->image.width : RAMP_TEXELS;
    uint32_t height = function ? function->image.height : 1;
    if (width > MOST_SIDE - 2 * MARGIN || height > MOST_SIDE - 2 * MARGIN - atlas->height)
        return NULL;
    uint32_t wide = width + 2 * MARGIN > atlas->width ? width + 2 * MARGIN : atlas->width;
    uint32_t high = atlas->height + height + 2 * MARGIN;
    if (high > MOST_TEXELS / wide)
        return NULL;
    if (function)
        function->keeps_image = true;
    plr_atlas_place *place = PLR_NEW(arena, plr_atlas_place);
    *place = (plr_atlas_place){.rect = {MARGIN + 0.5f, (float)atlas->height + MARGIN + 0.5f,
                                        (float)(width - 1), (float)(height - 1)},
                               .function = function};
    atlas->width = wide;
    atlas->height = high;
    *PLR_PUSH(arena, &atlas->places) = place;
    return place;
}

/* 0 is black and transparent, 1 white and opaque; reversed: opaque at 0. */
static void fill_ramp(float *out, bool reversed) {
    for (int i = 0; i < 4 * RAMP_TEXELS; i++)
        out[i] = (i % 4 == 3 && reversed) ? (float)(i < 4) : (float)(i >= 4);
}

/* Copies texels of RGBA floats, and their edges into the margin. */
static void paste(const float *texels, uint32_t width, uint32_t height, uint32_t row,
                  uint32_t atlas_width, float *out) {
    for (uint32_t y = 0; y < height + 2 * MARGIN; y++) {
        uint32_t from_y = y < MARGIN ? 0 : y - MARGIN < height ? y - MARGIN : height - 1;
        const float *from = texels + (size_t)from_y * width * 4;
        float *to = out + (size_t)(row + y) * atlas_width * 4;
        memcpy(to, from, 4 * sizeof *to);
        memcpy(to + 4 * MARGIN, from, (size_t)width * 4 * sizeof *to);
        memcpy(to + 4 * ((size_t)width + MARGIN), from + 4 * ((size_t)width - 1), 4 * sizeof *to);
    }
}

/* Between which values a row is not clear; 0 and 1 are the centres of its outer texels. */
static void find_visible(const float *texels, uint32_t width, float visible[2]) {
    uint32_t first = 0, end = width;
    while (first < end && texels[4 * (size_t)first + 3] <= 0)
        first++;
    while (end > first && texels[4 * (size_t)end - 1] <= 0)
        end--;
    bool any = first < end;
    visible[0] = !any ? INFINITY : first == 0 ? -INFINITY : (float)(first - 1) / (float)(width - 1);
    visible[1] = !any || end == width ? INFINITY : (float)end / (float)(width - 1);
}

static void paste_place(const plr_atlas *atlas, plr_atlas_place *place, bool reversed, float *out) {
    float ramp[4 * RAMP_TEXELS];
    uint32_t row = (uint32_t)place->rect[1] - MARGIN;
    if (!place->function) {
        fill_ramp(ramp, reversed);
        find_visible(ramp, RAMP_TEXELS, place->visible);
        paste(ramp, RAMP_TEXELS, 1, row, atlas->width, out);
        return;
    }
    const plr_image *image = &place->function->image;
    float *texels = malloc((size_t)image->width * image->height * 4 * sizeof *texels);
    if (!texels)
        return; /* black and transparent */
    plr_image_convert(image, 4, PLR_FLOAT32, texels);
    find_visible(texels, image->width, place->visible);
    paste(texels, image->width, image->height, row, atlas->width, out);
    free(texels);
}

void plr_atlas_make(plr_textures *textures, plr_arena *arena, plr_atlas *atlas, bool reversed) {
    if (!atlas->places.count)
        return;
    plr_image image = {.width = atlas->width,
                       .height = atlas->height,
                       .depth = 1,
                       .components = 4,
                       .type = PLR_FLOAT32};
    image.samples = calloc((size_t)atlas->width * atlas->height, 4 * sizeof(float));
    if (!image.samples)
        longjmp(*arena->out_of_memory, 1);
    for (size_t i = 0; i < atlas->places.count; i++)
        paste_place(atlas, atlas->places.items[i], reversed, image.samples);
    atlas->texture = plr_textures_make(textures, &image, PLR_TEXTURE_2D, false);
}
