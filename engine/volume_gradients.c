/* Gradients at the centres of voxels as a texture: one look where six samples would be needed.
 * Floats of 16 bits have 11 digits: a gradient of them is off by 1 in 2000 of its length at most.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/image_internal.h"
#include "engine/volume_pass.h"

enum {
    MOST_VOXELS = 1 << 24 /* 256 MiB of gradients */
};

bool plr_volume_can_hold_gradients(const plr_volume_state *state) {
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

static void make_gradients(plr_view *view, plr_volume_state *state) {
    plr_kept_volume *kept = plr_volume_kept(view, state->node);
    if (kept && !kept->gradients) {
        plr_image again, image;
        const plr_image *voxels = plr_volume_voxels(view, state->grid, &again);
        bool made = voxels && fill(voxels, &image);
        plr_image_free(&again);
        if (!made)
            longjmp(*view->arena.out_of_memory, 1);
        kept->gradients = plr_textures_make(&view->textures, &image, PLR_TEXTURE_3D, true);
        kept->gradients->kept = true;
    }
    state->gradients = kept ? kept->gradients : NULL;
}

void plr_cast_make_gradients(plr_view *view, plr_cast *cast) {
    const plr_program *program =
        view->engine ? cast->pass.program : NULL; /* else nothing is drawn */
    for (size_t i = 0; program && i < plr_program_symbol_count(program); i++) {
        const plr_symbol *symbol = plr_program_symbol(program, i);
        if (symbol->effect == PLR_NO_EFFECT || strcmp(symbol->name, "voxelGradients") != 0 ||
            !cast->pass.recipe.effects.items[symbol->effect].builtin)
            continue;
        size_t volume = cast->pass.recipe.bindings.items[symbol->effect].volume;
        make_gradients(view, &view->volumes.volumes[volume]);
    }
}
