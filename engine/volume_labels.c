/* Segment numbers of voxels as whole numbers. */
#include "engine/volume_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What was found that is no segment number. */
typedef struct oddities {
    uint64_t outside, fractions;
    uint32_t greatest;
} oddities;

#define MOST 4294967295.0

/* Numbers below 0 or beyond 32 bits are no segment: 0. */
#define FROM_INTEGERS(name, ctype)                                                                 \
    static void name##_labels(const void *voxels, size_t step, uint32_t *out, size_t count,        \
                              oddities *odd) {                                                     \
        const ctype *values = voxels;                                                              \
        for (size_t i = 0; i < count; i++) {                                                       \
            ctype value = values[i * step];                                                        \
            bool inside = (double)value >= 0 && (double)value <= MOST;                             \
            out[i] = inside ? (uint32_t)value : 0;                                                 \
            odd->outside += !inside;                                                               \
            odd->greatest = out[i] > odd->greatest ? out[i] : odd->greatest;                       \
        }                                                                                          \
    }
/* Fractions are rounded; NaN is no segment. */
#define FROM_FLOATS(name, ctype)                                                                   \
    static void name##_labels(const void *voxels, size_t step, uint32_t *out, size_t count,        \
                              oddities *odd) {                                                     \
        const ctype *values = voxels;                                                              \
        for (size_t i = 0; i < count; i++) {                                                       \
            double value = (double)values[i * step], whole = floor(value + 0.5);                   \
            bool inside = whole >= 0 && whole <= MOST;                                             \
            out[i] = inside ? (uint32_t)whole : 0;                                                 \
            odd->outside += !inside;                                                               \
            odd->fractions += inside && whole != value;                                            \
            odd->greatest = out[i] > odd->greatest ? out[i] : odd->greatest;                       \
        }                                                                                          \
    }
FROM_INTEGERS(u8, uint8_t)
FROM_INTEGERS(s8, int8_t)
FROM_INTEGERS(u16, uint16_t)
FROM_INTEGERS(s16, int16_t)
FROM_INTEGERS(u32, uint32_t)
FROM_INTEGERS(s32, int32_t)
FROM_INTEGERS(u64, uint64_t)
FROM_INTEGERS(s64, int64_t)
FROM_FLOATS(f32, float)
FROM_FLOATS(f64, double)

static void (*const to_labels[])(const void *, size_t, uint32_t *, size_t, oddities *) = {
    [PLR_VOXEL_U8] = u8_labels,   [PLR_VOXEL_S8] = s8_labels,   [PLR_VOXEL_U16] = u16_labels,
    [PLR_VOXEL_S16] = s16_labels, [PLR_VOXEL_U32] = u32_labels, [PLR_VOXEL_S32] = s32_labels,
    [PLR_VOXEL_U64] = u64_labels, [PLR_VOXEL_S64] = s64_labels, [PLR_VOXEL_F32] = f32_labels,
    [PLR_VOXEL_F64] = f64_labels,
};

static void report(const oddities *odd, plr_place place, plr_diags *diags) {
    if (odd->outside)
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, place,
                         "%llu segment numbers are below 0 or beyond 32 bits; 0 is taken for them",
                         (unsigned long long)odd->outside);
    if (odd->fractions)
        plr_diags_add_as(diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, place,
                         "%llu segment numbers are not whole; they are rounded",
                         (unsigned long long)odd->fractions);
}

/* Brings the numbers to the narrowest type that holds them all. */
static plr_sample_type narrow(uint32_t **labels, size_t count, uint32_t greatest) {
    plr_sample_type type = greatest <= 255     ? PLR_UINT8
                           : greatest <= 65535 ? PLR_UINT16
                                               : PLR_UINT32;
    size_t size = plr_image_sample_size(type);
    unsigned char *bytes = (unsigned char *)*labels;
    for (size_t i = 0; size < 4 && i < count; i++) {
        uint32_t label = (*labels)[i];
        uint16_t word = (uint16_t)label;
        uint8_t byte = (uint8_t)label;
        memcpy(bytes + i * size, size == 1 ? (const void *)&byte : (const void *)&word, size);
    }
    void *smaller = realloc(*labels, count * size);
    *labels = smaller ? smaller : *labels;
    return type;
}

bool plr_volume_to_labels(const plr_volume *volume, uint32_t component, plr_place place,
                          plr_image *image, plr_diags *diags) {
    memset(image, 0, sizeof *image);
    if (!volume || !volume->voxels || component >= volume->components)
        return false;
    size_t count = plr_volume_count(volume) / volume->components;
    uint32_t *labels = count <= SIZE_MAX / sizeof *labels ? malloc(count * sizeof *labels) : NULL;
    if (!labels) {
        plr_diags_add(diags, PLR_CODE_NO_MEMORY, place, "there is not enough memory");
        return false;
    }
    oddities odd = {0};
    const char *first = volume->voxels;
    to_labels[volume->type](first + component * plr_voxel_size(volume->type), volume->components,
                            labels, count, &odd);
    report(&odd, place, diags);
    image->type = narrow(&labels, count, odd.greatest);
    image->samples = labels;
    image->width = volume->size[0];
    image->height = volume->size[1];
    image->depth = volume->size[2];
    image->components = 1;
    return true;
}
