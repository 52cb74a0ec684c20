#include "engine/volume_blocks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FINE_CELLS = 2, /* rays come closer to what can be seen; 12 bytes a block, and they take time */
    COARSE_CELLS = 4,
    MOST_FINE = 1 << 21 /* voxels */
};

size_t plr_blocks_count(const plr_blocks *blocks) {
    return (size_t)blocks->size[0] * blocks->size[1] * blocks->size[2];
}

/* Puts the least and the greatest value of each run of voxels that a block reaches along one axis
 * in the place of the voxels: `count` values `stride` apart become `blocks` ones. */
static void reduce_line(const float *from, size_t stride, uint32_t count, uint32_t blocks,
                        uint32_t cells, bool greatest, float *out) {
    for (uint32_t b = 0; b < blocks; b++) {
        /* of 4: cells 4 b .. 4 b + 3 lie between voxels 4 b - 1 and 4 b + 3 */
        uint32_t first = b * cells, last = first + cells - 1;
        first = first > 0 ? first - 1 : 0;
        last = last < count ? last : count - 1;
        float found = from[first * stride];
        for (uint32_t i = first + 1; i <= last; i++) {
            float value = from[i * stride];
            if (greatest ? value > found : value < found)
                found = value;
        }
        out[b * stride] = found;
    }
}

/* One end of the ranges: axis after axis, in place of a copy of the voxels. */
static void reduce(const plr_image *image, const uint32_t size[3], uint32_t cells, bool greatest,
                   float *values) {
    const uint32_t count[3] = {image->width, image->height, image->depth};
    uint32_t now[3] = {count[0], count[1], count[2]};
    const size_t strides[3] = {1, count[0], (size_t)count[0] * count[1]};
    size_t longest = 0; /* a line, and its blocks behind it */
    for (int axis = 0; axis < 3; axis++)
        if ((size_t)count[axis] + size[axis] > longest)
            longest = (size_t)count[axis] + size[axis];
    float *line = malloc(sizeof *line * longest);
    for (int axis = 0; line && axis < 3; axis++) {
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (uint32_t j = 0; j < now[v]; j++)
            for (uint32_t i = 0; i < now[u]; i++) {
                float *start = values + i * strides[u] + j * strides[v];
                for (uint32_t k = 0; k < count[axis]; k++)
                    line[k] = start[k * strides[axis]];
                float *out = line + count[axis];
                reduce_line(line, 1, count[axis], size[axis], cells, greatest, out);
                for (uint32_t k = 0; k < size[axis] && k < count[axis]; k++)
                    start[k * strides[axis]] = out[k];
            }
        now[axis] = size[axis] < count[axis] ? size[axis] : count[axis];
    }
    free(line);
}

static void fill_voxels(const plr_image *image, float *values) {
    size_t count = plr_image_level_samples(image, 0);
    if (image->type == PLR_UNORM8)
        for (size_t i = 0; i < count; i++)
            values[i] = ((const uint8_t *)image->samples)[i] / 255.0f;
    else if (image->type == PLR_UNORM16)
        for (size_t i = 0; i < count; i++)
            values[i] = ((const uint16_t *)image->samples)[i] / 65535.0f;
    else
        memcpy(values, image->samples, count * sizeof *values);
}

plr_blocks *plr_blocks_make(plr_arena *arena, const plr_image *image) {
    const uint32_t count[3] = {image->width, image->height, image->depth};
    plr_blocks *blocks = PLR_NEW(arena, plr_blocks);
    blocks->cells = plr_image_level_samples(image, 0) <= MOST_FINE ? FINE_CELLS : COARSE_CELLS;
    for (int axis = 0; axis < 3; axis++) /* a side of one voxel has two cells, but one block */
        blocks->size[axis] = (count[axis] + blocks->cells) / blocks->cells;
    blocks->range = plr_arena_array(arena, plr_blocks_count(blocks), sizeof *blocks->range);
    /* sides of blocks may be one more than voxels, where there is one voxel: room for both */
    size_t room = plr_image_level_samples(image, 0);
    float *values = malloc(room * sizeof *values);
    if (!values)
        longjmp(*arena->out_of_memory, 1);
    for (int end = 0; end < 2; end++) {
        fill_voxels(image, values);
        reduce(image, blocks->size, blocks->cells, end == 1, values);
        size_t at = 0;
        for (uint32_t z = 0; z < blocks->size[2]; z++)
            for (uint32_t y = 0; y < blocks->size[1]; y++)
                for (uint32_t x = 0; x < blocks->size[0]; x++)
                    blocks->range[at++][end] =
                        values[x + (size_t)count[0] * (y + (size_t)count[1] * z)];
    }
    free(values);
    return blocks;
}

static uint32_t label_at(const plr_image *image, size_t i) {
    return image->type == PLR_UINT8    ? ((const uint8_t *)image->samples)[i]
           : image->type == PLR_UINT16 ? ((const uint16_t *)image->samples)[i]
                                       : ((const uint32_t *)image->samples)[i];
}

/* One row of voxels, into a row of blocks: of 4 cells, voxel i reaches i / 4 to (i + 1) / 4. */
static void add_row(const plr_image *image, size_t first, uint32_t cells, uint64_t *labels,
                    uint32_t *most) {
    for (uint32_t x = 0; x < image->width; x++) {
        uint32_t label = label_at(image, first + x);
        uint64_t bit = UINT64_C(1) << (label < PLR_BLOCK_LABELS ? label : PLR_BLOCK_LABELS);
        *most = label > *most ? label : *most;
        labels[x / cells] |= bit;
        labels[(x + 1) / cells] |= bit;
    }
}

void plr_blocks_add_labels(plr_arena *arena, plr_blocks *blocks, const plr_image *image) {
    const size_t width = blocks->size[0], height = blocks->size[1];
    const uint32_t cells = blocks->cells;
    blocks->labels = PLR_NEW_ARRAY(arena, plr_blocks_count(blocks), uint64_t);
    for (uint32_t z = 0; z < image->depth; z++)
        for (uint32_t y = 0; y < image->height; y++)
            for (size_t c = z / cells; c <= (z + 1) / cells; c++)
                for (size_t b = y / cells; b <= (y + 1) / cells; b++)
                    add_row(image, image->width * ((size_t)y + (size_t)image->height * z), cells,
                            blocks->labels + width * (b + height * c), &blocks->most_label);
    for (size_t i = 0; i < plr_blocks_count(blocks); i++)
        blocks->all_labels |= blocks->labels[i];
}

/* ---- Leaps ---- */

/* Into a row of cubes the least of the rows beside it that are farther along y, z, or both. */
static void spread_row(const uint8_t *cubes, const ptrdiff_t steps[2], const bool inside[2],
                       size_t width, uint8_t *least) {
    const ptrdiff_t others[3] = {steps[0], steps[1], steps[0] + steps[1]};
    const bool known[3] = {inside[0], inside[1], inside[0] && inside[1]};
    memset(least, UINT8_MAX, width);
    for (int k = 0; k < 3; k++)
        for (size_t x = 0; known[k] && x < width; x++) {
            uint8_t other = cubes[others[k] + (ptrdiff_t)x];
            least[x] = other < least[x] ? other : least[x];
        }
}

/* The side of the greatest clear cube that a block is the first corner of, for a row: one more than
 * the least of those of its seven neighbours that lie farther in the octant. */
static void grow_row(const bool *full, const uint8_t *least, bool upwards, size_t width,
                     uint8_t *cubes) {
    uint8_t behind = UINT8_MAX, corner = UINT8_MAX;
    for (size_t n = 0; n < width; n++) {
        size_t x = upwards ? width - 1 - n : n;
        uint8_t found = least[x] < corner ? least[x] : corner;
        found = behind < found ? behind : found;
        found = found < UINT8_MAX ? found + 1 : found;
        behind = cubes[x] = full[x] ? 0 : found;
        corner = least[x];
    }
}

static void find_cubes(const plr_blocks *blocks, const bool *full, int octant, uint8_t *least,
                       uint8_t *cubes) {
    const size_t width = blocks->size[0], height = blocks->size[1], depth = blocks->size[2];
    const bool upwards[3] = {!(octant & 1), !(octant & 2), !(octant & 4)};
    const ptrdiff_t layer = (ptrdiff_t)(width * height);
    const ptrdiff_t steps[2] = {upwards[1] ? (ptrdiff_t)width : -(ptrdiff_t)width,
                                upwards[2] ? layer : -layer};
    for (size_t k = 0; k < depth; k++)
        for (size_t j = 0; j < height; j++) {
            size_t y = upwards[1] ? height - 1 - j : j, z = upwards[2] ? depth - 1 - k : k;
            size_t first = width * (y + height * z);
            const bool inside[2] = {j > 0, k > 0};
            spread_row(cubes + first, steps, inside, width, least);
            grow_row(full + first, least, upwards[0], width, cubes + first);
        }
}

/* In 4 bits: numbers up to 10 as they are, then every eighth (leap_at in
 * effects/volume/leaps.glsl). */
enum {
    EXACT = 10,
    COARSE = 8,
    MOST_CODE = 15,
    CODE_BITS = 4
};

static uint32_t encode(uint8_t side) {
    uint32_t code = side;
    if (code > EXACT)
        code = EXACT + (code - EXACT) / COARSE;
    return code < MOST_CODE ? code : MOST_CODE;
}

uint32_t plr_blocks_side(uint32_t leaps, uint32_t octant) {
    uint32_t code = leaps >> CODE_BITS * octant & MOST_CODE;
    return code > EXACT ? EXACT + (code - EXACT) * COARSE : code;
}

bool plr_blocks_leaps(const plr_blocks *blocks, const bool *full, uint32_t *leaps) {
    enum {
        OCTANTS = 8
    };
    size_t count = plr_blocks_count(blocks);
    uint8_t *cubes = malloc(count + blocks->size[0]);
    if (!cubes)
        return false;
    memset(leaps, 0, count * sizeof *leaps);
    for (int octant = 0; octant < OCTANTS; octant++) {
        find_cubes(blocks, full, octant, cubes + count, cubes);
        for (size_t i = 0; i < count; i++)
            leaps[i] |= encode(cubes[i]) << (CODE_BITS * octant);
    }
    free(cubes);
    return true;
}
