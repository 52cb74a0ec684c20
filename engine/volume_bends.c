#include "engine/volume_bends.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/image_internal.h"

enum {
    MOST_BLOCKS = 2048, /* about: each is looked at for each length of steps that is tried */
    LEAST_CELLS = 1
};

/* Voxels, x runs fastest. */
typedef struct grid {
    const float *values;
    size_t size[3], stride[3];
} grid;

/* The neighbours of a row: itself beyond the ends of the grid. */
typedef struct rows {
    const float *here, *up[2], *down[2], *across; /* along y and z, and along both */
    bool ahead[2];                                /* whether the next one is of the block, too */
} rows;

static rows rows_at(const grid *g, size_t y, size_t z, const size_t last[3]) {
    const float *here = g->values + y * g->stride[1] + z * g->stride[2];
    size_t up_y = y + 1 < g->size[1] ? g->stride[1] : 0;
    size_t up_z = z + 1 < g->size[2] ? g->stride[2] : 0;
    return (rows){.here = here,
                  .up = {here + up_y, here + up_z},
                  .down = {here - (y > 0 ? g->stride[1] : 0), here - (z > 0 ? g->stride[2] : 0)},
                  .across = here + up_y + up_z,
                  .ahead = {y < last[1], z < last[2]}};
}

static float larger(float a, float b) {
    return a > b ? a : b;
}

/* What there is at each voxel of a row, and between it and the next one. */
static void add_range(const rows *r, size_t count, float *found[PLR_BENDS]) {
    float *depth = found[PLR_BEND_DEPTH], *height = found[PLR_BEND_HEIGHT];
    for (size_t x = 0; x < count; x++) {
        depth[x] = larger(depth[x], -r->here[x]);
        height[x] = larger(height[x], r->here[x]);
    }
}

static void add_along(const rows *r, size_t count, float *found[PLR_BENDS]) {
    float *slope = found[PLR_BEND_SLOPE], *jump = found[PLR_BEND_JUMP];
    const float *v = r->here;
    for (size_t x = 0; x + 1 < count; x++)
        slope[x] = larger(slope[x], fabsf(v[x + 1] - v[x]));
    for (size_t x = 1; x + 1 < count; x++)
        jump[x] = larger(jump[x], fabsf((v[x + 1] - v[x]) - (v[x] - v[x - 1])));
}

static void add_aside(const rows *r, size_t count, int axis, float *found[PLR_BENDS]) {
    float *slope = found[PLR_BEND_SLOPE + axis], *jump = found[PLR_BEND_JUMP + axis];
    float *twist = found[PLR_BEND_TWIST + 3 - axis];
    const float *v = r->here, *up = r->up[axis - 1], *down = r->down[axis - 1];
    for (size_t x = 0; up != v && down != v && x < count; x++)
        jump[x] = larger(jump[x], fabsf((up[x] - v[x]) - (v[x] - down[x])));
    if (!r->ahead[axis - 1])
        return;
    for (size_t x = 0; x < count; x++)
        slope[x] = larger(slope[x], fabsf(up[x] - v[x]));
    for (size_t x = 0; x + 1 < count; x++)
        twist[x] = larger(twist[x], fabsf((up[x + 1] - v[x + 1]) - (up[x] - v[x])));
}

static void add_across(const rows *r, size_t count, float *found[PLR_BENDS]) {
    float *twist = found[PLR_BEND_TWIST];
    const float *v = r->here, *y = r->up[0], *z = r->up[1], *both = r->across;
    for (size_t x = 0; r->ahead[0] && r->ahead[1] && x < count; x++)
        twist[x] = larger(twist[x], fabsf((both[x] - z[x]) - (y[x] - v[x])));
}

/* Blocks share the voxels at their sides, but not what is between those and the next ones. */
static bool is_between(int kind) {
    return kind == PLR_BEND_SLOPE || kind == PLR_BEND_TWIST + 1 || kind == PLR_BEND_TWIST + 2;
}

static void find_row_of_blocks(const grid *g, const plr_bends *bends, size_t by, size_t bz,
                               float *scratch, float *out[PLR_BENDS]) {
    float *found[PLR_BENDS];
    size_t count = g->size[0], n = bends->cells, first[3] = {0, by * n, bz * n}, last[3];
    for (int k = 0; k < PLR_BENDS; k++) {
        found[k] = scratch + (size_t)k * count;
        for (size_t x = 0; x < count; x++)
            found[k][x] = k < PLR_BEND_SLOPE ? -INFINITY : 0;
    }
    for (int i = 1; i < 3; i++)
        last[i] = first[i] + n < g->size[i] ? first[i] + n : g->size[i] - 1;
    for (size_t z = first[2]; z <= last[2]; z++)
        for (size_t y = first[1]; y <= last[1]; y++) {
            rows r = rows_at(g, y, z, last);
            add_range(&r, count, found);
            add_along(&r, count, found);
            add_aside(&r, count, 1, found);
            add_aside(&r, count, 2, found);
            add_across(&r, count, found);
        }
    for (int k = 0; k < PLR_BENDS; k++)
        for (size_t bx = 0; bx < bends->blocks[0]; bx++) {
            size_t end = bx * n + n < count ? bx * n + n : count - 1;
            float most = found[k][bx * n];
            for (size_t x = bx * n; x < end + (is_between(k) ? 0 : 1); x++)
                most = larger(most, found[k][x]);
            out[k][bx] = most;
        }
}

/* What is no number makes it infinite. */
static void find_range(plr_bends *bends, const float *values, size_t count) {
    float low = values[0], high = values[0];
    bool finite = true;
    for (size_t i = 0; i < count; i++) {
        low = values[i] < low ? values[i] : low;
        high = values[i] > high ? values[i] : high;
        finite = finite && values[i] - values[i] == 0;
    }
    bends->low = finite ? (double)low : -INFINITY;
    bends->high = finite ? (double)high : INFINITY;
}

static void choose_blocks(plr_bends *bends) {
    bends->cells = LEAST_CELLS;
    for (;; bends->cells++) {
        for (int i = 0; i < 3; i++) {
            uint32_t cells = bends->size[i] > 1 ? bends->size[i] - 1 : 1;
            bends->blocks[i] = (cells + bends->cells - 1) / bends->cells;
        }
        if (plr_bends_count(bends) <= MOST_BLOCKS)
            return;
    }
}

plr_bends *plr_bends_make(plr_arena *arena, const plr_image *image) {
    size_t count = plr_image_level_samples(image, 0);
    plr_bends *bends = PLR_NEW(arena, plr_bends);
    *bends = (plr_bends){.size = {image->width, image->height, image->depth}};
    choose_blocks(bends);
    size_t blocks = plr_bends_count(bends);
    float *kept = PLR_NEW_ARRAY(arena, PLR_BENDS * blocks, float);
    float *values = malloc(count * sizeof *values);
    float *scratch = malloc(PLR_BENDS * (size_t)image->width * sizeof *scratch);
    if (!values || !scratch) {
        free(values);
        free(scratch);
        longjmp(*arena->out_of_memory, 1);
    }
    plr_image_convert(image, 1, PLR_FLOAT32, values);
    grid g = {values, {image->width, image->height, image->depth}, {1, 0, 0}};
    g.stride[1] = g.size[0];
    g.stride[2] = g.size[0] * g.size[1];
    find_range(bends, values, count);
    for (size_t z = 0; z < bends->blocks[2]; z++)
        for (size_t y = 0; y < bends->blocks[1]; y++) {
            float *out[PLR_BENDS];
            for (size_t k = 0; k < PLR_BENDS; k++)
                out[k] = kept + k * blocks + (z * bends->blocks[1] + y) * bends->blocks[0];
            find_row_of_blocks(&g, bends, y, z, scratch, out);
        }
    for (size_t k = 0; k < PLR_BENDS; k++)
        bends->found[k] = kept + k * blocks;
    free(values);
    free(scratch);
    return bends;
}

size_t plr_bends_count(const plr_bends *bends) {
    return (size_t)bends->blocks[0] * bends->blocks[1] * bends->blocks[2];
}
