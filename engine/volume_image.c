/* Volumes as texture samples, and the strength of their gradients. */
#include "engine/volume_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- to samples ---- */

/* sample = clamp((stored - low) * scale); what is not finite is 0 */
#define TO_FLOAT(name, ctype)                                                                      \
    static void name##_to_float(const void *voxels, float *out, size_t count, double low,          \
                                double scale) {                                                    \
        const ctype *values = voxels;                                                              \
        for (size_t i = 0; i < count; i++) {                                                       \
            double value = (double)values[i];                                                      \
            double sample = (value - low) * scale;                                                 \
            sample = sample > 0 ? sample : 0;                                                      \
            sample = sample < 1 ? sample : 1;                                                      \
            out[i] = value - value >= 0 ? (float)sample : 0.0f;                                    \
        }                                                                                          \
    }
TO_FLOAT(u8, uint8_t)
TO_FLOAT(s8, int8_t)
TO_FLOAT(u16, uint16_t)
TO_FLOAT(s16, int16_t)
TO_FLOAT(u32, uint32_t)
TO_FLOAT(s32, int32_t)
TO_FLOAT(u64, uint64_t)
TO_FLOAT(s64, int64_t)
TO_FLOAT(f32, float)
TO_FLOAT(f64, double)

static void (*const to_float[])(const void *, float *, size_t, double, double) = {
    [PLR_VOXEL_U8] = u8_to_float,   [PLR_VOXEL_S8] = s8_to_float,   [PLR_VOXEL_U16] = u16_to_float,
    [PLR_VOXEL_S16] = s16_to_float, [PLR_VOXEL_U32] = u32_to_float, [PLR_VOXEL_S32] = s32_to_float,
    [PLR_VOXEL_U64] = u64_to_float, [PLR_VOXEL_S64] = s64_to_float, [PLR_VOXEL_F32] = f32_to_float,
    [PLR_VOXEL_F64] = f64_to_float,
};

static void u8_to_unorm16(const uint8_t *values, uint16_t *out, size_t count) {
    for (size_t i = 0; i < count; i++)
        out[i] = (uint16_t)(values[i] * 257u);
}

bool plr_volume_to_image(const plr_volume *volume, const double range[2], plr_image *image) {
    memset(image, 0, sizeof *image);
    if (!volume || !volume->voxels)
        return false;
    double low = volume->minimum, high = volume->maximum;
    if (range && range[0] != range[1]) {
        low = range[0];
        high = range[1];
    }
    size_t count = plr_volume_count(volume);
    bool plain_bytes = volume->type == PLR_VOXEL_U8 && volume->slope == 1 &&
                       volume->intercept == 0 && low == 0 && high == 255;
    size_t size = plain_bytes ? sizeof(uint16_t) : sizeof(float);
    image->samples = count <= SIZE_MAX / size ? malloc(count * size) : NULL;
    if (!image->samples)
        return false;
    image->width = volume->size[0];
    image->height = volume->size[1];
    image->depth = volume->size[2];
    image->components = volume->components;
    image->type = plain_bytes ? PLR_UNORM16 : PLR_FLOAT32;
    if (plain_bytes) {
        u8_to_unorm16(volume->voxels, image->samples, count);
        return true;
    }
    /* back to stored values, so that both ends of the range are met exactly */
    low = (low - volume->intercept) / volume->slope;
    high = (high - volume->intercept) / volume->slope;
    double scale = high != low ? 1 / (high - low) : 0;
    to_float[volume->type](volume->voxels, image->samples, count, low, scale);
    return true;
}

/* ---- gradients ---- */

/* The scalar of gradients: L, or the mean of R, G and B. */
static double scalar(const plr_image *image, size_t voxel) {
    size_t colours = image->components < 3 ? 1 : 3, first = voxel * image->components;
    double sum = 0;
    for (size_t c = first; c < first + colours; c++)
        sum += image->type == PLR_FLOAT32   ? (double)((const float *)image->samples)[c]
               : image->type == PLR_UNORM16 ? ((const uint16_t *)image->samples)[c] / 65535.0
                                            : ((const uint8_t *)image->samples)[c] / 255.0;
    return sum / (double)colours;
}

/* Scalars of one row of voxels. */
static void read_row(const plr_image *image, uint32_t y, uint32_t z, float *row) {
    size_t first = ((size_t)z * image->height + y) * image->width, width = image->width;
    if (image->components == 1 && image->type == PLR_FLOAT32) {
        memcpy(row, (const float *)image->samples + first, width * sizeof *row);
    } else if (image->components == 1 && image->type == PLR_UNORM16) {
        const uint16_t *values = (const uint16_t *)image->samples + first;
        for (size_t x = 0; x < width; x++)
            row[x] = (float)values[x] * (1 / 65535.0f);
    } else {
        for (size_t x = 0; x < width; x++)
            row[x] = (float)scalar(image, first + x);
    }
}

typedef struct rows {
    float *centre, *y_low, *y_high, *z_low, *z_high, *magnitudes;
} rows;

/* Magnitudes of the gradients of one row; `per_step` is 1 / (2 * side of a voxel). */
static void row_magnitudes(const plr_image *image, uint32_t y, uint32_t z, const float per_step[3],
                           const rows *r) {
    uint32_t last[3] = {image->width - 1, image->height - 1, image->depth - 1};
    read_row(image, y, z, r->centre);
    read_row(image, y ? y - 1 : 0, z, r->y_low);
    read_row(image, y < last[1] ? y + 1 : y, z, r->y_high);
    read_row(image, y, z ? z - 1 : 0, r->z_low);
    read_row(image, y, z < last[2] ? z + 1 : z, r->z_high);
    for (uint32_t x = 0; x <= last[0]; x++) {
        uint32_t low = x ? x - 1 : 0, high = x < last[0] ? x + 1 : x;
        float dx = (r->centre[high] - r->centre[low]) * per_step[0];
        float dy = (r->y_high[x] - r->y_low[x]) * per_step[1];
        float dz = (r->z_high[x] - r->z_low[x]) * per_step[2];
        r->magnitudes[x] = sqrtf(dx * dx + dy * dy + dz * dz);
    }
}

enum {
    HALF = 1 << 16
};

/* Positive floats are ordered as their bits are: counts magnitudes by the upper half of their bits,
 * or (chosen >= 0) those with this upper half by the lower half. */
static void count_magnitudes(const plr_image *image, const float per_step[3], const rows *r,
                             int chosen, uint64_t *counts) {
    memset(counts, 0, HALF * sizeof *counts);
    for (uint32_t z = 0; z < image->depth; z++)
        for (uint32_t y = 0; y < image->height; y++) {
            row_magnitudes(image, y, z, per_step, r);
            for (uint32_t x = 0; x < image->width; x++) {
                uint32_t bits;
                memcpy(&bits, &r->magnitudes[x], sizeof bits);
                int upper = (int)(bits >> 16);
                if (chosen < 0 && bits)
                    counts[upper]++;
                else if (chosen >= 0 && upper == chosen)
                    counts[bits & 0xffff]++;
            }
        }
}

/* The bin in which the rank-th counts, from 1; `rank` becomes the rank within that bin. */
static int find_rank(const uint64_t *counts, uint64_t *rank) {
    int bin = 0;
    while (bin < HALF - 1 && *rank > counts[bin])
        *rank -= counts[bin++];
    return bin;
}

/* The least magnitude that 99 of 100 magnitudes above 0 do not exceed: exact, by two passes. */
static double percentile(const plr_image *image, const float per_step[3], const rows *r,
                         uint64_t *counts) {
    uint64_t total = 0, rank;
    count_magnitudes(image, per_step, r, -1, counts);
    for (int i = 0; i < HALF; i++)
        total += counts[i];
    if (total == 0)
        return 1;
    rank = total - total / 100;
    int upper = find_rank(counts, &rank);
    count_magnitudes(image, per_step, r, upper, counts);
    if (upper == 0)
        counts[0] = 0;
    uint32_t bits = (uint32_t)upper << 16 | (uint32_t)find_rank(counts, &rank);
    float magnitude;
    memcpy(&magnitude, &bits, sizeof magnitude);
    return (double)magnitude;
}

double plr_image_gradient_percentile(const plr_image *image, const double dimensions[3]) {
    if (!image || !image->samples || !image->width)
        return 1;
    const uint32_t size[3] = {image->width, image->height, image->depth};
    float per_step[3];
    for (int i = 0; i < 3; i++) {
        double step = dimensions[i] > 0 ? size[i] / (2 * dimensions[i]) : 0;
        per_step[i] = step < 1e30 ? (float)step : 0.0f;
    }
    uint64_t *counts = malloc(HALF * sizeof *counts);
    float *floats = malloc(6 * (size_t)image->width * sizeof *floats);
    double result = 1;
    if (counts && floats) {
        size_t w = image->width;
        rows r = {floats,         floats + w,     floats + 2 * w,
                  floats + 3 * w, floats + 4 * w, floats + 5 * w};
        result = percentile(image, per_step, &r, counts);
    }
    free(counts);
    free(floats);
    return result;
}
