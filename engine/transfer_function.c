#include "engine/transfer_function.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CHANNELS = 4
};

typedef struct knot_list {
    double *keys; /* 0 and 1 are the ends of the texture; never falling */
    float *colours;
    size_t count;
} knot_list;

bool plr_transfer_function_is_physical(const plr_node *node) {
    return plr_node_is(node, "TransferFunction") && plr_node_bool(node, "physical");
}

/* ---- Knots ---- */

static void check_counts(const plr_field *keys, const plr_field *values, plr_diags *diags) {
    if (keys->count != values->count)
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VALUE, values->place,
                         "TransferFunction has %zu keys and %zu values; what has no partner is "
                         "left out",
                         keys->count, values->count);
    else if (!keys->count)
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VALUE, keys->place,
                         "TransferFunction has no keys: it is transparent everywhere");
}

/* Voxels may count downwards: then the last knot comes first. A key below the one before it counts
 * as that one. */
static bool read_knots(const plr_node *node, const double range[2], knot_list *knots,
                       plr_diags *diags) {
    const plr_field *keys = plr_node_field(node, "key"), *values = plr_node_field(node, "keyValue");
    check_counts(keys, values, diags);
    bool physical = plr_transfer_function_is_physical(node), rises = true;
    double low = physical ? range[0] : 0, width = physical ? range[1] - range[0] : 1;
    size_t count = keys->count < values->count ? keys->count : values->count;
    *knots = (knot_list){malloc((count + 1) * sizeof *knots->keys),
                         malloc((count + 1) * CHANNELS * sizeof *knots->colours), count};
    for (size_t i = 0; knots->keys && knots->colours && i < count; i++) {
        size_t at = width < 0 ? count - 1 - i : i;
        double key = ((double)keys->value.floats[at] - low) / width;
        key = isfinite(key) ? key : 0;
        rises = rises && (!i || key >= knots->keys[i - 1]);
        knots->keys[i] = i && key < knots->keys[i - 1] ? knots->keys[i - 1] : key;
        memcpy(knots->colours + CHANNELS * i, values->value.floats + CHANNELS * at,
               CHANNELS * sizeof *knots->colours);
    }
    if (!rises)
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VALUE, keys->place,
                         "the keys of a TransferFunction must not fall");
    return knots->keys && knots->colours;
}

/* Piecewise linear; where two keys are equal, what the second one has holds from there on. `from`
 * is the last knot up to a place before this one. */
static void evaluate(const knot_list *knots, double at, size_t *from, float out[CHANNELS]) {
    if (!knots->count) {
        memset(out, 0, CHANNELS * sizeof *out);
        return;
    }
    while (*from + 1 < knots->count && knots->keys[*from + 1] <= at)
        ++*from;
    size_t next = *from + 1 < knots->count ? *from + 1 : *from;
    double a = knots->keys[*from], b = knots->keys[next];
    double weight = b > a && at > a ? (at - a) / (b - a) : 0;
    for (int i = 0; i < CHANNELS; i++) {
        double left = (double)knots->colours[*from * CHANNELS + (size_t)i];
        double right = (double)knots->colours[next * CHANNELS + (size_t)i];
        out[i] = (float)(left + (right - left) * weight);
    }
}

/* ---- How many texels ---- */

/* Keys are floats: more digits they do not have. */
static bool falls_on_texel(double key, double steps) {
    static const double nearly = 1e-6;
    return fabs(key * steps - round(key * steps)) <= nearly * steps;
}

static bool fall_on_texels(const double *keys, size_t count, double steps) {
    for (size_t i = 0; i < count; i++)
        if (!falls_on_texel(keys[i], steps))
            return false;
    return true;
}

/* The fewest that hold all keys, times what fits: hardware that interpolates in few bits then errs
 * less between the texels. */
static uint32_t choose_texels(const knot_list *knots) {
    enum {
        MOST = PLR_TRANSFER_MAX_TEXELS - 1
    };
    double inside[MOST]; /* different keys but 0 and 1 */
    size_t count = 0;
    for (size_t i = 0; i < knots->count; i++) {
        double key = knots->keys[i];
        if (!(key > 0 && key < 1) || (i && key == knots->keys[i - 1]))
            continue;
        if (count == MOST)
            return PLR_TRANSFER_MAX_TEXELS;
        inside[count++] = key;
    }
    for (uint32_t steps = 1; steps <= MOST; steps++)
        if (fall_on_texels(inside, count, steps))
            return MOST / steps * steps + 1;
    return PLR_TRANSFER_MAX_TEXELS;
}

/* ---- Baking ---- */

static float *bake(const knot_list *knots, uint32_t texels) {
    float *samples = malloc((size_t)texels * CHANNELS * sizeof *samples);
    double steps = texels - 1;
    size_t from = 0;
    for (size_t i = 0; i < knots->count; i++)
        if (falls_on_texel(knots->keys[i], steps))
            knots->keys[i] = round(knots->keys[i] * steps) / steps;
    for (uint32_t i = 0; samples && i < texels; i++)
        evaluate(knots, i / steps, &from, samples + (size_t)i * CHANNELS);
    return samples;
}

bool plr_transfer_function_bake(const plr_node *node, const double range[2], plr_image *image,
                                plr_diags *diags) {
    knot_list knots = {0};
    *image = (plr_image){0};
    if (read_knots(node, range, &knots, diags)) {
        uint32_t texels = choose_texels(&knots);
        *image = (plr_image){.width = texels,
                             .height = 1,
                             .depth = 1,
                             .components = CHANNELS,
                             .type = PLR_FLOAT32,
                             .samples = bake(&knots, texels)};
    }
    free(knots.keys);
    free(knots.colours);
    return image->samples != NULL;
}

plr_texture *plr_transfer_function_texture(plr_textures *textures, const plr_node *node,
                                           const double range[2]) {
    for (size_t i = 0; i < textures->list.count; i++) {
        plr_texture *texture = textures->list.items[i];
        if (texture->function == node && memcmp(texture->range, range, sizeof texture->range) == 0)
            return texture;
    }
    plr_image image = {0};
    if (!plr_transfer_function_bake(node, range, &image, NULL))
        return NULL;
    plr_texture *made = plr_textures_make(textures, &image, PLR_TEXTURE_2D, false);
    made->function = node;
    memcpy(made->range, range, sizeof made->range);
    return made;
}
