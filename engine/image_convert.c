/* Whole images in other forms. */
#include "engine/image_internal.h"

#include <stdlib.h>
#include <string.h>

static double sample_at(const plr_image *image, size_t index) {
    switch (image->type) {
    case PLR_UNORM8:
        return ((const uint8_t *)image->samples)[index] / 255.0;
    case PLR_UNORM16:
        return ((const uint16_t *)image->samples)[index] / 65535.0;
    case PLR_FLOAT32:
        return (double)((const float *)image->samples)[index];
    case PLR_UINT8:
        return ((const uint8_t *)image->samples)[index];
    case PLR_UINT16:
        return ((const uint16_t *)image->samples)[index];
    case PLR_UINT32:
        return ((const uint32_t *)image->samples)[index];
    }
    return 0;
}

static void put_sample(plr_sample_type type, void *out, size_t index, double value) {
    switch (type) {
    case PLR_UNORM8:
        ((uint8_t *)out)[index] = (uint8_t)(value * 255 + 0.5);
        break;
    case PLR_UNORM16:
        ((uint16_t *)out)[index] = (uint16_t)(value * 65535 + 0.5);
        break;
    case PLR_FLOAT32:
        ((float *)out)[index] = (float)value;
        break;
    case PLR_UINT8:
        ((uint8_t *)out)[index] = (uint8_t)(value + 0.5);
        break;
    case PLR_UINT16:
        ((uint16_t *)out)[index] = (uint16_t)(value + 0.5);
        break;
    case PLR_UINT32:
        ((uint32_t *)out)[index] = (uint32_t)(value + 0.5);
        break;
    }
}

void plr_image_convert(const plr_image *image, uint32_t components, plr_sample_type type,
                       void *out) {
    size_t count = plr_image_level_samples(image, 0) / image->components;
    uint32_t have = image->components;
    if (have == components && image->type == type) {
        memcpy(out, image->samples, count * components * plr_image_sample_size(type));
        return;
    }
    bool has_alpha = have == 2 || have == 4, alpha = components == 2 || components == 4;
    uint32_t colours = components - alpha;
    for (size_t i = 0; i < count; i++) {
        for (uint32_t c = 0; c < colours; c++)
            put_sample(type, out, i * components + c,
                       sample_at(image, i * have + (have < 3 ? 0 : c)));
        if (alpha)
            put_sample(type, out, i * components + colours,
                       has_alpha ? sample_at(image, i * have + have - 1) : 1);
    }
}

bool plr_image_flatten(plr_image *image) {
    bool more = image->depth > 1 || image->cube;
    if (more) { /* the rest stays behind, unused */
        image->depth = 1;
        image->mipmaps = 0;
        image->cube = false;
    }
    return more;
}

/* ---- Shrinking ---- */

typedef struct axis {
    uint32_t from, to;
} axis;

/* The texels of `from` that texel i of `to` covers. */
static void covered(const axis *a, uint32_t i, uint32_t range[2]) {
    range[0] = (uint32_t)((uint64_t)i * a->from / a->to);
    range[1] = (uint32_t)(((uint64_t)i + 1) * a->from / a->to);
}

static double mean(const plr_image *image, const uint32_t x[2], const uint32_t y[2],
                   const uint32_t z[2], uint32_t c) {
    double sum = 0;
    for (uint32_t k = z[0]; k < z[1]; k++)
        for (uint32_t j = y[0]; j < y[1]; j++)
            for (uint32_t i = x[0]; i < x[1]; i++)
                sum += plr_image_sample(image, i, j, k, c);
    return sum / ((double)(x[1] - x[0]) * (y[1] - y[0]) * (z[1] - z[0]));
}

bool plr_image_shrink(plr_image *image, const uint32_t limits[3]) {
    const uint32_t sides[3] = {image->width, image->height, image->depth};
    axis axes[3];
    for (int i = 0; i < 3; i++)
        axes[i] = (axis){sides[i], sides[i] < limits[i] ? sides[i] : limits[i]};
    plr_image small = *image;
    small.width = axes[0].to;
    small.height = axes[1].to;
    small.depth = axes[2].to;
    small.mipmaps = 0;
    small.samples = malloc(plr_image_level_samples(&small, 0) * plr_image_sample_size(small.type));
    if (!small.samples)
        return false;
    size_t at = 0;
    uint32_t x[2], y[2], z[2];
    for (uint32_t k = 0; k < small.depth; k++)
        for (uint32_t j = 0; j < small.height; j++)
            for (uint32_t i = 0; i < small.width; i++) {
                covered(&axes[0], i, x);
                covered(&axes[1], j, y);
                covered(&axes[2], k, z);
                for (uint32_t c = 0; c < small.components; c++)
                    put_sample(small.type, small.samples, at++, mean(image, x, y, z, c));
            }
    plr_image_free(image);
    *image = small;
    return true;
}
