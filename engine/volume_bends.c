#include "engine/volume_bends.h"

#include <math.h>
#include <stdlib.h>

#include "engine/image_internal.h"

/* Voxels, x runs fastest. */
typedef struct grid {
    const float *values;
    size_t size[3], stride[3];
} grid;

/* The differences, along an axis, of a layer's voxels from the next one's, and how they change
 * there. At the ends of the grid there is none beyond. */
static void add_layer(const grid *g, int axis, size_t layer, double *slope, double *jump) {
    int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    size_t next = layer + 1 < g->size[axis] ? g->stride[axis] : 0;
    size_t before = layer > 0 ? g->stride[axis] : 0;
    float most = 0, change = 0;
    for (size_t j = 0; j < g->size[v]; j++) {
        const float *row = g->values + layer * g->stride[axis] + j * g->stride[v];
        for (size_t i = 0; i < g->size[u]; i++, row += g->stride[u]) {
            float ahead = row[next] - *row, behind = *row - *(row - before);
            float step = fabsf(ahead), turn = fabsf(ahead - behind);
            most = step > most ? step : most;
            change = turn > change ? turn : change;
        }
    }
    *slope = fmax(*slope, (double)most);
    *jump += (double)change;
}

static double find_twist(const grid *g, int axis) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (u > v) {
        int kept = u;
        u = v;
        v = kept;
    }
    float most = 0;
    for (size_t k = 0; k < g->size[axis]; k++)
        for (size_t j = 0; j + 1 < g->size[v]; j++) {
            const float *row = g->values + k * g->stride[axis] + j * g->stride[v];
            const float *other = row + g->stride[v];
            for (size_t i = 0; i + 1 < g->size[u];
                 i++, row += g->stride[u], other += g->stride[u]) {
                float twist = fabsf((other[g->stride[u]] - *other) - (row[g->stride[u]] - *row));
                most = twist > most ? twist : most;
            }
        }
    return (double)most;
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

plr_bends *plr_bends_make(plr_arena *arena, const plr_image *image) {
    size_t count = plr_image_level_samples(image, 0);
    plr_bends *bends = PLR_NEW(arena, plr_bends);
    float *values = malloc(count * sizeof *values);
    if (!values)
        longjmp(*arena->out_of_memory, 1);
    plr_image_convert(image, 1, PLR_FLOAT32, values);
    grid g = {values, {image->width, image->height, image->depth}, {1, 0, 0}};
    g.stride[1] = g.size[0];
    g.stride[2] = g.size[0] * g.size[1];
    find_range(bends, values, count);
    for (int axis = 0; axis < 3; axis++) {
        for (size_t layer = 0; layer < g.size[axis]; layer++)
            add_layer(&g, axis, layer, &bends->slope[axis], &bends->jump[axis]);
        bends->twist[axis] = find_twist(&g, axis);
    }
    free(values);
    return bends;
}
