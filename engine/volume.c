/* Volumes: which format, limits, ranges, single values. */
#include "engine/volume_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Unpacked by the reader itself; files that a scene loads are unpacked (and limited) before. */
#define MAX_UNPACKED ((size_t)1 << 30)

static bool is_nifti_size(const char *data, unsigned char high, unsigned char low) {
    const unsigned char *bytes = (const unsigned char *)data;
    return (bytes[0] == low && bytes[1] == high && bytes[2] == 0 && bytes[3] == 0) ||
           (bytes[0] == 0 && bytes[1] == 0 && bytes[2] == high && bytes[3] == low);
}

plr_volume_format plr_volume_sniff(const char *data, size_t length) {
    if (length >= 4 && memcmp(data, "NRRD", 4) == 0)
        return PLR_VOLUME_NRRD;
    if (length >= 540 && is_nifti_size(data, 540 >> 8, 540 & 255) &&
        (memcmp(data + 4, "n+2", 4) == 0 || memcmp(data + 4, "ni2", 4) == 0))
        return PLR_VOLUME_NIFTI;
    if (length >= 348 && is_nifti_size(data, 348 >> 8, 348 & 255)) {
        if (memcmp(data + 344, "n+1", 4) == 0 || memcmp(data + 344, "ni1", 4) == 0)
            return PLR_VOLUME_NIFTI;
        return PLR_VOLUME_ANALYZE;
    }
    return plr_dicom_sniff(data, length) ? PLR_VOLUME_DICOM : PLR_VOLUME_UNKNOWN;
}

static bool parse_format(const plr_volume_source *source, plr_volume *volume) {
    switch (plr_volume_sniff(source->data, source->length)) {
    case PLR_VOLUME_NRRD:
        return plr_volume_parse_nrrd(source, volume);
    case PLR_VOLUME_NIFTI:
        return plr_volume_parse_nifti(source, volume);
    case PLR_VOLUME_DICOM:
        return plr_volume_parse_dicom(source, volume);
    case PLR_VOLUME_ANALYZE:
        plr_diags_add(source->diags, PLR_CODE_BAD_VOLUME, source->place,
                      "%s is in ANALYZE 7.5 format, which is not read; convert it to NIfTI",
                      source->name);
        return false;
    case PLR_VOLUME_UNKNOWN:
        break;
    }
    plr_diags_add(source->diags, PLR_CODE_BAD_VOLUME, source->place, "%s is neither NRRD nor NIfTI",
                  source->name);
    return false;
}

static bool parse_packed(const plr_volume_source *source, plr_volume *volume) {
    plr_volume_source inner = *source;
    const char *fault;
    char *unpacked = plr_gunzip(source->data, source->length, MAX_UNPACKED, &inner.length, &fault);
    if (!unpacked) {
        plr_diags_add(source->diags, PLR_CODE_BAD_VOLUME, source->place,
                      "the data of %s cannot be unpacked: %s", source->name, fault);
        return false;
    }
    inner.data = unpacked;
    bool ok = parse_format(&inner, volume);
    free(unpacked);
    return ok;
}

plr_plain_numbers plr_plain_numbers_begin(void) {
    plr_plain_numbers numbers = {.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0)};
    if (numbers.plain)
        numbers.before = uselocale(numbers.plain);
    return numbers;
}

void plr_plain_numbers_end(plr_plain_numbers *numbers) {
    if (numbers->plain) {
        uselocale(numbers->before);
        freelocale(numbers->plain);
    }
}

bool plr_volume_parse(const plr_volume_source *source, plr_volume *volume) {
    memset(volume, 0, sizeof *volume);
    plr_plain_numbers plain = plr_plain_numbers_begin();
    bool ok = plr_is_gzip(source->data, source->length) ? parse_packed(source, volume)
                                                        : parse_format(source, volume);
    plr_plain_numbers_end(&plain);
    if (!ok)
        plr_volume_free(volume);
    return ok;
}

void plr_volume_free(plr_volume *volume) {
    if (!volume)
        return;
    free(volume->voxels);
    plr_labels_free(&volume->labels);
    memset(volume, 0, sizeof *volume);
}

size_t plr_volume_count(const plr_volume *volume) {
    return (size_t)volume->size[0] * volume->size[1] * volume->size[2] * volume->components;
}

bool plr_volume_check_size(const uint64_t size[3], uint64_t components, plr_voxel_type type,
                           plr_place place, plr_diags *diags) {
    for (int i = 0; i < 3; i++)
        if (size[i] == 0 || size[i] > PLR_VOLUME_MAX_SIDE) {
            plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place,
                          "a side of %llu voxels is outside 1..%u", (unsigned long long)size[i],
                          PLR_VOLUME_MAX_SIDE);
            return false;
        }
    /* at most 2^14 each: the product has no more than 2^42 voxels of at most 2^5 bytes */
    uint64_t bytes = size[0] * size[1] * size[2] * components * plr_voxel_size(type);
    if (bytes > PLR_VOLUME_MAX_BYTES || bytes > SIZE_MAX / 2) {
        plr_diags_add(diags, PLR_CODE_BAD_VOLUME, place,
                      "%llu x %llu x %llu voxels are more than %llu bytes",
                      (unsigned long long)size[0], (unsigned long long)size[1],
                      (unsigned long long)size[2], (unsigned long long)PLR_VOLUME_MAX_BYTES);
        return false;
    }
    return true;
}

uint64_t plr_volume_time_point(const plr_volume_source *source, uint64_t count) {
    if (!source->time_given || source->time_point < count)
        return source->time_given ? source->time_point : 0;
    plr_diags_add_as(
        source->diags, PLR_WARNING, PLR_CODE_BAD_VALUE, source->time_place,
        "there is no time point %u; %s has %llu, counted from 0, and the last is taken",
        source->time_point, source->name, (unsigned long long)count);
    return count - 1;
}

/* ---- ranges ---- */

/* Least and greatest stored value; false if none is finite. */
#define INTEGER_RANGE(name, ctype)                                                                 \
    static bool range_##name(const void *voxels, size_t count, double range[2]) {                  \
        const ctype *values = voxels;                                                              \
        ctype least = values[0], greatest = values[0];                                             \
        for (size_t i = 1; i < count; i++) {                                                       \
            least = values[i] < least ? values[i] : least;                                         \
            greatest = values[i] > greatest ? values[i] : greatest;                                \
        }                                                                                          \
        range[0] = (double)least;                                                                  \
        range[1] = (double)greatest;                                                               \
        return true;                                                                               \
    }
/* x - x is 0 for finite numbers alone */
#define FLOAT_RANGE(name, ctype)                                                                   \
    static bool range_##name(const void *voxels, size_t count, double range[2]) {                  \
        const ctype *values = voxels;                                                              \
        ctype least = (ctype)INFINITY, greatest = -(ctype)INFINITY;                                \
        for (size_t i = 0; i < count; i++) {                                                       \
            ctype value = values[i];                                                               \
            bool finite = value - value >= 0;                                                      \
            least = finite && value < least ? value : least;                                       \
            greatest = finite && value > greatest ? value : greatest;                              \
        }                                                                                          \
        range[0] = (double)least;                                                                  \
        range[1] = (double)greatest;                                                               \
        return least <= greatest;                                                                  \
    }
INTEGER_RANGE(u8, uint8_t)
INTEGER_RANGE(s8, int8_t)
INTEGER_RANGE(u16, uint16_t)
INTEGER_RANGE(s16, int16_t)
INTEGER_RANGE(u32, uint32_t)
INTEGER_RANGE(s32, int32_t)
INTEGER_RANGE(u64, uint64_t)
INTEGER_RANGE(s64, int64_t)
FLOAT_RANGE(f32, float)
FLOAT_RANGE(f64, double)

static bool (*const ranges[])(const void *voxels, size_t count, double range[2]) = {
    [PLR_VOXEL_U8] = range_u8,   [PLR_VOXEL_S8] = range_s8,   [PLR_VOXEL_U16] = range_u16,
    [PLR_VOXEL_S16] = range_s16, [PLR_VOXEL_U32] = range_u32, [PLR_VOXEL_S32] = range_s32,
    [PLR_VOXEL_U64] = range_u64, [PLR_VOXEL_S64] = range_s64, [PLR_VOXEL_F32] = range_f32,
    [PLR_VOXEL_F64] = range_f64,
};

void plr_volume_set_range(plr_volume *volume, double declared_minimum, double declared_maximum) {
    bool has_minimum = isfinite(declared_minimum), has_maximum = isfinite(declared_maximum);
    double range[2] = {0, 255};
    bool plain_bytes = volume->type == PLR_VOXEL_U8 && volume->slope == 1 && volume->intercept == 0;
    if (!plain_bytes && !(has_minimum && has_maximum)) {
        if (!ranges[volume->type](volume->voxels, plr_volume_count(volume), range))
            range[0] = range[1] = 0;
        for (int i = 0; i < 2; i++)
            range[i] = range[i] * volume->slope + volume->intercept;
        if (range[0] > range[1]) {
            double kept = range[0];
            range[0] = range[1];
            range[1] = kept;
        }
    }
    volume->minimum = has_minimum ? declared_minimum : range[0];
    volume->maximum = has_maximum ? declared_maximum : range[1];
    volume->range_declared = has_minimum || has_maximum;
}

void plr_volume_drop_last_component(plr_volume *volume) {
    size_t size = plr_voxel_size(volume->type), count = volume->components;
    size_t voxels = plr_volume_count(volume) / count;
    char *to = volume->voxels;
    for (size_t i = 0; i < voxels; i++, to += size * (count - 1))
        memmove(to, (const char *)volume->voxels + i * size * count, size * (count - 1));
    volume->components--;
    if (!volume->range_declared)
        plr_volume_set_range(volume, NAN, NAN);
}

double plr_volume_value(const plr_volume *volume, uint32_t x, uint32_t y, uint32_t z, uint32_t c) {
    size_t index = ((size_t)z * volume->size[1] + y) * volume->size[0] + x;
    index = index * volume->components + c;
    const void *voxels = volume->voxels;
    double stored = 0;
    switch (volume->type) {
    case PLR_VOXEL_U8:
        stored = ((const uint8_t *)voxels)[index];
        break;
    case PLR_VOXEL_S8:
        stored = ((const int8_t *)voxels)[index];
        break;
    case PLR_VOXEL_U16:
        stored = ((const uint16_t *)voxels)[index];
        break;
    case PLR_VOXEL_S16:
        stored = ((const int16_t *)voxels)[index];
        break;
    case PLR_VOXEL_U32:
        stored = ((const uint32_t *)voxels)[index];
        break;
    case PLR_VOXEL_S32:
        stored = ((const int32_t *)voxels)[index];
        break;
    case PLR_VOXEL_U64:
        stored = (double)((const uint64_t *)voxels)[index];
        break;
    case PLR_VOXEL_S64:
        stored = (double)((const int64_t *)voxels)[index];
        break;
    case PLR_VOXEL_F32:
        stored = (double)((const float *)voxels)[index];
        break;
    case PLR_VOXEL_F64:
        stored = ((const double *)voxels)[index];
        break;
    }
    return stored * volume->slope + volume->intercept;
}
