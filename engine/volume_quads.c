/* Voxels of bytes as a texture of which a texel has four: a value is mixed from two texels where a
 * filter reads eight, in 16 bits each (see texture_upload.c). */
#include <stdlib.h>

#include "engine/image_internal.h"
#include "engine/volume_pass.h"

/* 16-bit voxels hold bytes if they are v * 257. */
bool plr_volume_has_bytes(const plr_image *voxels) {
    const uint16_t *samples = (const uint16_t *)(const void *)voxels->samples;
    size_t count = plr_image_level_samples(voxels, 0);
    bool bytes = voxels->type == PLR_UNORM16;
    for (size_t i = 0; bytes && i < count; i++)
        bytes = samples[i] % 257 == 0;
    return bytes || voxels->type == PLR_UNORM8;
}

static uint8_t byte_at(const plr_image *voxels, size_t i) {
    return voxels->type == PLR_UNORM8
               ? ((const uint8_t *)voxels->samples)[i]
               : (uint8_t)(((const uint16_t *)(const void *)voxels->samples)[i] / 257);
}

bool plr_volume_fill_quads(const plr_image *voxels, plr_image *out) {
    size_t count = plr_image_level_samples(voxels, 0), i = 0;
    *out = (plr_image){.width = voxels->width,
                       .height = voxels->height,
                       .depth = voxels->depth,
                       .components = 4,
                       .type = PLR_UNORM8,
                       .samples = malloc(4 * count)};
    uint8_t *texel = (uint8_t *)out->samples;
    for (size_t z = 0; texel && z < voxels->depth; z++)
        for (size_t y = 0; y < voxels->height; y++)
            for (size_t x = 0; x < voxels->width; x++, i++) {
                /* beyond the ends lies what is at the ends */
                size_t right = x + 1 < voxels->width;
                size_t up = y + 1 < voxels->height ? voxels->width : 0;
                const size_t places[4] = {i, i + right, i + up, i + up + right};
                for (int k = 0; k < 4; k++)
                    *texel++ = byte_at(voxels, places[k]);
            }
    return out->samples != NULL;
}
