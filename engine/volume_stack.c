/* Volumes of slices that come one after the other. */
#include "engine/volume_node.h"

#include <stdlib.h>
#include <string.h>

/* The type that holds both without loss. */
static plr_sample_type wider(plr_sample_type a, plr_sample_type b) {
    return a > b ? a : b;
}

static size_t slice_bytes(const plr_image *stack) {
    return (size_t)stack->width * stack->height * stack->components *
           plr_image_sample_size(stack->type);
}

static bool no_memory(plr_place place, plr_diags *diags) {
    plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "there is not enough memory");
    return false;
}

/* What all will be, once the first is known. */
static bool begin(plr_image *stack, const plr_image *first, size_t count, plr_place place,
                  plr_diags *diags) {
    *stack = *first;
    stack->samples = NULL;
    stack->mipmaps = 0;
    stack->depth = (uint32_t)count;
    return plr_volume_check_image(stack, place, diags);
}

/* Memory is taken for twice the slices that were there: more may be missing. */
static bool make_room(plr_image *stack, size_t index, plr_place place, plr_diags *diags) {
    if (index & (index - 1))
        return true;
    size_t room = index ? 2 * index : 1;
    room = room < stack->depth ? room : stack->depth;
    void *more = realloc(stack->samples, slice_bytes(stack) * room);
    if (!more)
        return no_memory(place, diags);
    stack->samples = more;
    return true;
}

/* Brings what is there to a wider type, with room for as much again (as make_room has it). */
static bool widen(plr_image *stack, size_t done, plr_sample_type type, plr_place place,
                  plr_diags *diags) {
    plr_image whole = *stack, filled = *stack;
    whole.type = type;
    whole.samples = malloc(slice_bytes(&whole) * (2 * done < whole.depth ? 2 * done : whole.depth));
    if (!whole.samples)
        return no_memory(place, diags);
    filled.depth = (uint32_t)done;
    plr_image_convert(&filled, filled.components, type, whole.samples);
    free(stack->samples);
    *stack = whole;
    return true;
}

static bool put_slice(plr_image *stack, const plr_image *slice, size_t index, plr_place place,
                      plr_diags *diags) {
    if (slice->width != stack->width || slice->height != stack->height ||
        slice->components != stack->components) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place,
                      "slice %zu is %u x %u with %u components, but the first is %u x %u with %u",
                      index, slice->width, slice->height, slice->components, stack->width,
                      stack->height, stack->components);
        return false;
    }
    if (wider(stack->type, slice->type) != stack->type &&
        !widen(stack, index, slice->type, place, diags))
        return false;
    if (!make_room(stack, index, place, diags))
        return false;
    plr_image_convert(slice, stack->components, stack->type,
                      (char *)stack->samples + index * slice_bytes(stack));
    return true;
}

bool plr_volume_from_slices(plr_slice_loader load, void *user, size_t count, plr_place place,
                            plr_volume *volume, plr_diags *diags) {
    if (count == 0 || count > PLR_VOLUME_MAX_SIDE) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place, "%zu slices are outside 1..%u", count,
                      PLR_VOLUME_MAX_SIDE);
        return false;
    }
    plr_image stack = {0};
    bool fine = true;
    for (size_t i = 0; fine && i < count; i++) {
        plr_image slice = {0};
        plr_place at = place;
        fine = load(user, i, &slice, &at, diags) &&
               (i || begin(&stack, &slice, count, place, diags)) &&
               put_slice(&stack, &slice, i, at, diags);
        plr_image_free(&slice);
    }
    if (fine)
        plr_volume_from_image(&stack, volume);
    plr_image_free(&stack);
    return fine;
}
