/* Where, between two values of a transfer function, what can be seen lies in the mean. */
#include <math.h>
#include <stdlib.h>

#include "engine/volume_table.h"

plr_texture *plr_table_places(const plr_table *t, plr_textures *textures, plr_arena *arena) {
    uint32_t nodes = t->nodes;
    double *moment = PLR_NEW_ARRAY(arena, nodes, double);
    for (uint32_t i = 0; i + 1 < nodes; i++)
        moment[i + 1] = moment[i] + (t->depth[i + 1] - t->depth[i]) * (i + 0.5);
    plr_image image = {
        .width = nodes, .height = nodes, .depth = 1, .components = 1, .type = PLR_FLOAT32};
    float *out = calloc((size_t)nodes * nodes, sizeof *out);
    if (!out)
        longjmp(*arena->out_of_memory, 1);
    image.samples = out;
    for (uint32_t j = 0; j < nodes; j++)
        for (uint32_t i = 0; i <= j; i++) {
            double depth = t->depth[j] - t->depth[i], part = 0.5;
            if (depth > 1e-12 * t->depth[nodes - 1] && j > i)
                part = ((moment[j] - moment[i]) / depth - i) / (j - i);
            part = fmin(fmax(part, 0), 1);
            out[(size_t)j * nodes + i] = (float)part;
            out[(size_t)i * nodes + j] = (float)(1 - part);
        }
    return plr_textures_make(textures, &image, PLR_TEXTURE_2D, false);
}
