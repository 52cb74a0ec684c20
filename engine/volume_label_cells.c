#include "engine/volume_label_cells.h"

#include <stdlib.h>
#include <string.h>

static uint8_t low_label(const plr_image *labels, size_t i) {
    uint32_t label = labels->type == PLR_UINT8    ? ((const uint8_t *)labels->samples)[i]
                     : labels->type == PLR_UINT16 ? ((const uint16_t *)labels->samples)[i]
                                                  : ((const uint32_t *)labels->samples)[i];
    return (uint8_t)(label < PLR_LABELS_DIFFER ? label : PLR_LABELS_DIFFER);
}

/* A row of cells between voxels of one row. */
static void join_row(const plr_image *labels, size_t first, uint32_t cells, uint8_t *out) {
    uint8_t before = low_label(labels, first);
    for (uint32_t x = 0; x < cells; x++) {
        uint8_t next = x + 1 < labels->width ? low_label(labels, first + x + 1) : before;
        out[x] = next == before ? next : PLR_LABELS_DIFFER;
        before = next;
    }
}

/* Into what was found for the cells before: what these and others have in common. */
static void join(uint8_t *cells, const uint8_t *other, size_t count) {
    for (size_t i = 0; i < count; i++)
        cells[i] = cells[i] == other[i] ? cells[i] : PLR_LABELS_DIFFER;
}

static uint32_t between(uint32_t voxels) {
    return voxels > 1 ? voxels - 1 : 1;
}

plr_image plr_label_cells(plr_arena *arena, const plr_image *labels) {
    plr_image cells = {.width = between(labels->width),
                       .height = between(labels->height),
                       .depth = between(labels->depth),
                       .components = 1,
                       .type = PLR_UINT8};
    const size_t row = cells.width, slice = row * cells.height;
    uint8_t *out = malloc(slice * cells.depth), *last = malloc(row + slice);
    cells.samples = out;
    if (!out || !last) {
        free(out);
        free(last);
        longjmp(*arena->out_of_memory, 1);
    }
    uint8_t *now = last + row;
    for (uint32_t z = 0; z < labels->depth; z++) {
        for (uint32_t y = 0; y < labels->height; y++) {
            join_row(labels, labels->width * (y + (size_t)labels->height * z), cells.width, last);
            if (y < cells.height)
                memcpy(now + y * row, last, row);
            if (y > 0)
                join(now + (y - 1) * row, last, row);
        }
        if (z < cells.depth)
            memcpy(out + z * slice, now, slice);
        if (z > 0)
            join(out + (z - 1) * slice, now, slice);
    }
    free(last);
    return cells;
}
