/* Voxels as a texture of which a texel has four: two texels have what a filter reads eight for,
 * those of bytes in 16 bits each (see texture_upload.c). */
#include <stdlib.h>
#include <string.h>

#include "engine/image_internal.h"
#include "engine/volume_pass.h"

enum {
    MOST_BYTES = 1 << 26 /* of a texture */
};

/* 16-bit voxels hold bytes if they are v * 257. */
bool plr_volume_has_bytes(const plr_image *voxels) {
    const uint16_t *samples = (const uint16_t *)(const void *)voxels->samples;
    size_t count = plr_image_level_samples(voxels, 0);
    bool bytes = voxels->type == PLR_UNORM16;
    for (size_t i = 0; bytes && i < count; i++)
        bytes = samples[i] % 257 == 0;
    return bytes || voxels->type == PLR_UNORM8;
}

static size_t sample_size(plr_sample_type type) {
    return type == PLR_FLOAT32 ? sizeof(float) : type == PLR_UNORM16 ? sizeof(uint16_t) : 1;
}

bool plr_volume_has_quads(const plr_volume_state *state) {
    const plr_grid *grid = state->grid;
    plr_sample_type type = grid->bytes ? PLR_UNORM8 : grid->voxels->image.type;
    uint64_t count = (uint64_t)grid->size[0] * grid->size[1] * grid->size[2];
    return plr_volume_can_derive(state) && 4 * count * sample_size(type) <= MOST_BYTES;
}

/* Copies samples of `size` bytes each to the four places of texels. */
static void fill_texels(const plr_image *voxels, size_t size, char *texel) {
    size_t i = 0;
    for (size_t z = 0; z < voxels->depth; z++)
        for (size_t y = 0; y < voxels->height; y++)
            for (size_t x = 0; x < voxels->width; x++, i++) {
                /* beyond the ends lies what is at the ends */
                size_t right = x + 1 < voxels->width;
                size_t up = y + 1 < voxels->height ? voxels->width : 0;
                const size_t places[4] = {i, i + right, i + up, i + up + right};
                for (int k = 0; k < 4; k++, texel += size)
                    memcpy(texel, (const char *)voxels->samples + places[k] * size, size);
            }
}

static uint8_t *narrow(const plr_image *voxels, size_t count) {
    const uint16_t *samples = (const uint16_t *)(const void *)voxels->samples;
    uint8_t *bytes = malloc(count);
    for (size_t i = 0; bytes && i < count; i++)
        bytes[i] = (uint8_t)(samples[i] / 257);
    return bytes;
}

bool plr_volume_fill_quads(const plr_image *voxels, plr_image *out) {
    size_t count = plr_image_level_samples(voxels, 0);
    plr_image source = *voxels;
    uint8_t *narrowed = NULL;
    if (voxels->type == PLR_UNORM16 && plr_volume_has_bytes(voxels)) {
        if (!(narrowed = narrow(voxels, count)))
            return false;
        source.type = PLR_UNORM8;
        source.samples = (void *)narrowed;
    }
    size_t size = sample_size(source.type);
    *out = (plr_image){.width = voxels->width,
                       .height = voxels->height,
                       .depth = voxels->depth,
                       .components = 4,
                       .type = source.type,
                       .samples = malloc(4 * count * size)};
    if (out->samples)
        fill_texels(&source, size, (char *)out->samples);
    free(narrowed);
    return out->samples != NULL;
}
