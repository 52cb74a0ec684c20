/* Volumes that no texture can hold, in bricks: each is uploaded, cast and forgotten, from the
 * farthest to the nearest. A brick has two voxels more on each side than are cast in it: filters
 * and gradients are the same at its faces as inside. */
#include "engine/volume_pass.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/texture_internal.h"

enum {
    APRON = 2,
    LEAST_SIDE = 8 /* of a brick, whatever the limits */
};

static size_t brick_bytes(const plr_image *image, const uint32_t sides[3]) {
    size_t bytes = plr_image_sample_size(image->type) * image->components;
    for (int i = 0; i < 3; i++)
        bytes *= sides[i] + 2 * APRON;
    return bytes;
}

void plr_bricks_plan(const plr_image *image, uint32_t most_side, size_t most_bytes,
                     uint32_t sides[3]) {
    const uint32_t full[3] = {image->width, image->height, image->depth};
    for (int i = 0; i < 3; i++) {
        sides[i] = full[i];
        while (most_side && sides[i] + 2 * APRON > most_side && sides[i] > LEAST_SIDE)
            sides[i] = (sides[i] + 1) / 2;
    }
    for (;;) {
        int longest = sides[0] >= sides[1] && sides[0] >= sides[2] ? 0
                      : sides[1] >= sides[2]                       ? 1
                                                                   : 2;
        if (brick_bytes(image, sides) <= most_bytes || sides[longest] <= LEAST_SIDE)
            return;
        sides[longest] = (sides[longest] + 1) / 2;
    }
}

/* One axis of a brick: the voxels that are cast, and those that are in its texture. */
typedef struct span {
    uint32_t first, count, start, size;
} span;

static span find_span(uint32_t index, uint32_t side, uint32_t full) {
    span s = {.first = index * side};
    s.count = full - s.first < side ? full - s.first : side;
    s.start = s.first > APRON ? s.first - APRON : 0;
    uint32_t end = s.first + s.count + APRON;
    s.size = (end < full ? end : full) - s.start;
    return s;
}

static bool copy_brick(const plr_image *whole, const span spans[3], plr_image *brick) {
    size_t voxel = plr_image_sample_size(whole->type) * whole->components;
    size_t row = spans[0].size * voxel;
    *brick = (plr_image){.width = spans[0].size,
                         .height = spans[1].size,
                         .depth = spans[2].size,
                         .components = whole->components,
                         .type = whole->type,
                         .samples = malloc(row * spans[1].size * spans[2].size)};
    char *to = brick->samples;
    for (uint32_t z = 0; to && z < spans[2].size; z++)
        for (uint32_t y = 0; y < spans[1].size; y++, to += row) {
            size_t at = (size_t)(spans[2].start + z) * whole->height + spans[1].start + y;
            memcpy(to, (char *)whole->samples + (at * whole->width + spans[0].start) * voxel, row);
        }
    return brick->samples != NULL;
}

/* Where the brick lies in the box of texture coordinates, and its texture in it. */
static void place_brick(plr_grid *grid, const span spans[3]) {
    for (int i = 0; i < 3; i++) {
        double full = grid->size[i];
        grid->brick_box[0][i] = spans[i].first / full;
        grid->brick_box[1][i] = (spans[i].first + spans[i].count) / full;
        grid->brick_scale[i] = full / spans[i].size;
        grid->brick_shift[i] = -(double)spans[i].start / spans[i].size;
    }
}

static void cast_brick(plr_view *view, plr_grid *grid, const uint32_t index[3],
                       void (*cast)(void *), void *user) {
    span spans[3];
    for (int i = 0; i < 3; i++)
        spans[i] = find_span(index[i], grid->brick_sides[i], grid->size[i]);
    plr_texture brick = {.kind = PLR_TEXTURE_3D,
                         .components = grid->voxels->components,
                         .voxels = true,
                         .width = spans[0].size,
                         .height = spans[1].size};
    if (!copy_brick(&grid->voxels->image, spans, &brick.image))
        longjmp(*view->arena.out_of_memory, 1);
    place_brick(grid, spans);
    if (plr_texture_upload(&view->textures, &brick)) {
        grid->brick = &brick;
        cast(user);
        grid->brick = NULL;
    }
    view->engine->gl.DeleteTextures(1, &brick.name);
}

/* The indices along an axis, the farthest from the eye first. With every axis so, no brick hides
 * one that comes later. */
static void order_axis(uint32_t count, double eye, uint32_t *order) {
    uint32_t low = 0, high = count;
    for (uint32_t i = 0; i < count; i++) {
        bool from_low = fabs(low + 0.5 - eye) > fabs(high - 0.5 - eye);
        order[i] = from_low ? low++ : --high;
    }
}

void plr_bricks_cast(plr_view *view, const plr_volume_state *state, const plr_frame *frame,
                     void (*cast)(void *), void *user) {
    plr_grid *grid = state->grid;
    plr_matrix to_eye = plr_matrix_multiply(&frame->view, &state->to_world), to_local;
    plr_matrix_invert(&to_eye, &to_local);
    bool parallel = frame->projection.m[15] != 0;
    double eye[3] = {0, 0, 0};
    plr_matrix_point(&to_local, eye, eye);
    uint32_t counts[3], *order[3];
    for (int i = 0; i < 3; i++) {
        double side = grid->brick_sides[i];
        counts[i] = (grid->size[i] + grid->brick_sides[i] - 1) / grid->brick_sides[i];
        double at = (eye[i] / state->dimensions[i] + 0.5) * grid->size[i] / side;
        if (parallel) /* infinitely far behind the viewer */
            at = to_local.m[8 + i] > 0 ? 1e9 : -1e9;
        order[i] = malloc(counts[i] * sizeof *order[i]);
        if (order[i])
            order_axis(counts[i], at, order[i]);
    }
    bool fine = order[0] && order[1] && order[2];
    for (uint32_t z = 0; fine && z < counts[2]; z++)
        for (uint32_t y = 0; y < counts[1]; y++)
            for (uint32_t x = 0; x < counts[0]; x++)
                cast_brick(view, grid, (uint32_t[]){order[0][x], order[1][y], order[2][z]}, cast,
                           user);
    for (int i = 0; i < 3; i++)
        free(order[i]);
}
