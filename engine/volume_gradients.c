/* Textures made of voxels. Gradients at the centres of voxels: one look where six samples would be
 * needed. Floats of 16 bits have 11 digits: a gradient of them is off by 1 in 2000 of its length at
 * most.
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "engine/image_internal.h"
#include "engine/volume_pass.h"

enum {
    MOST_VOXELS = 1 << 24 /* 256 MiB of gradients */
};

bool plr_volume_can_derive(const plr_volume_state *state) {
    const uint32_t *size = state->grid->size;
    return state->grid->voxels->components == 1 && !state->grid->brick_sides[0] &&
           (uint64_t)size[0] * size[1] * size[2] <= MOST_VOXELS;
}

/* Differences along one axis, whose voxels lie `stride` apart, half of those of the two neighbours;
 * beyond the ends lies what is at the ends. */
static void fill_axis(const float *values, const uint32_t size[3], int axis, float *out) {
    static const size_t components = 4;
    size_t stride = axis == 0 ? 1 : axis == 1 ? size[0] : (size_t)size[0] * size[1];
    size_t count = (size_t)size[0] * size[1] * size[2];
    for (size_t i = 0; i < count; i++) {
        size_t place = i / stride % size[axis];
        float high = values[place + 1 < size[axis] ? i + stride : i];
        float low = values[place > 0 ? i - stride : i];
        out[components * i + (size_t)axis] = 0.5f * (high - low);
    }
}

/* The texture's image. False: no memory. */
static bool fill(const plr_image *voxels, plr_image *out) {
    const uint32_t size[3] = {voxels->width, voxels->height, voxels->depth};
    size_t count = (size_t)size[0] * size[1] * size[2];
    float *values = malloc(count * sizeof *values), *numbers = calloc(count, 4 * sizeof *numbers);
    *out = (plr_image){.width = size[0],
                       .height = size[1],
                       .depth = size[2],
                       .components = 4,
                       .type = PLR_FLOAT32,
                       .samples = numbers};
    if (!values || !numbers) {
        free(values);
        plr_image_free(out);
        return false;
    }
    plr_image_convert(voxels, 1, PLR_FLOAT32, values);
    for (int axis = 0; axis < 3; axis++)
        fill_axis(values, size, axis, numbers);
    free(values);
    return true;
}

/* Textures that are made of voxels where a program reads them. */
static const struct {
    const char *name;
    bool (*fill)(const plr_image *voxels, plr_image *out);
    size_t kept, state; /* where the texture is in plr_kept_volume and plr_volume_state */
    bool numbers;
} derived[] = {{"voxelGradients", fill, offsetof(plr_kept_volume, gradients),
                offsetof(plr_volume_state, gradients), false},
               {"voxelQuads", plr_volume_fill_quads, offsetof(plr_kept_volume, quads),
                offsetof(plr_volume_state, quads), true}};

static plr_texture **texture_in(void *record, size_t offset) {
    return (plr_texture **)(void *)((char *)record + offset);
}

static void derive(plr_view *view, plr_volume_state *state, size_t which) {
    plr_kept_volume *kept = plr_volume_kept(view, state->node);
    plr_texture **texture = kept ? texture_in(kept, derived[which].kept) : NULL;
    if (texture && !*texture) {
        plr_image again, image;
        const plr_image *voxels = plr_volume_voxels(view, state->grid, &again);
        bool made = voxels && derived[which].fill(voxels, &image);
        plr_image_free(&again);
        if (!made)
            longjmp(*view->arena.out_of_memory, 1);
        *texture = plr_textures_make(&view->textures, &image, PLR_TEXTURE_3D, true);
        (*texture)->numbers = derived[which].numbers;
        (*texture)->kept = true;
    }
    *texture_in(state, derived[which].state) = texture ? *texture : NULL;
}

void plr_cast_derive(plr_view *view, plr_cast *cast) {
    const plr_program *program =
        view->engine ? cast->pass.program : NULL; /* else nothing is drawn */
    for (size_t i = 0; program && i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        if (symbol->effect == PLR_NO_EFFECT ||
            !cast->pass.recipe.effects.items[symbol->effect].builtin)
            continue;
        size_t volume = cast->pass.recipe.bindings.items[symbol->effect].volume;
        for (size_t which = 0; which < sizeof derived / sizeof *derived; which++)
            if (strcmp(symbol->name, derived[which].name) == 0)
                derive(view, &view->volumes.volumes[volume], which);
    }
}
