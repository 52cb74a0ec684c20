/* From the stored pixels of DICOM frames to voxels (PS3.3, C.7.6.3 and C.11.1). */
#include "engine/volume_dicom.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t pixel_count(const plr_dicom_format *format) {
    return (size_t)format->columns * format->rows;
}

static size_t frame_size(const plr_dicom_format *format) {
    return pixel_count(format) * format->samples * (format->allocated / 8);
}

/* ---- Stored values ---- */

/* The range of the numbers that so many bits hold. */
static void stored_range(const plr_dicom_format *format, double range[2]) {
    double count = ldexp(1, (int)format->stored);
    range[0] = format->is_signed ? -count / 2 : 0;
    range[1] = range[0] + count - 1;
}

/* The used bits of a pixel as a number; MONOCHROME1 is mirrored within what its bits hold. */
static inline int64_t stored_value(const plr_dicom_format *format, uint32_t bits) {
    uint32_t stored = format->stored;
    bits >>= format->high + 1 - stored;
    bits &= UINT32_MAX >> (32 - stored);
    int64_t value = bits;
    if (format->is_signed && bits >> (stored - 1))
        value -= INT64_C(1) << stored;
    if (format->inverted)
        value = (format->is_signed ? -1 : (INT64_C(1) << stored) - 1) - value;
    return value;
}

static inline uint32_t raw_bits(const plr_dicom_format *format, const void *frame, size_t index) {
    if (format->allocated == 8)
        return ((const uint8_t *)frame)[index];
    if (format->allocated == 16)
        return ((const uint16_t *)frame)[index];
    return ((const uint32_t *)frame)[index];
}

static inline double float_value(const plr_dicom_format *format, const void *frame, size_t index) {
    double value = format->pixels == PLR_DICOM_FLOATS ? (double)((const float *)frame)[index]
                                                      : ((const double *)frame)[index];
    return format->inverted ? -value : value;
}

/* What a physical value becomes where pixels are mirrored. */
static double mirrored(const plr_dicom_slice *slice, double physical) {
    double range[2] = {0, 0};
    if (slice->format.pixels == PLR_DICOM_INTEGERS)
        stored_range(&slice->format, range);
    return slice->slope * (range[0] + range[1]) + 2 * slice->intercept - physical;
}

/* The padding as stored numbers after mirroring. */
static void padding_range(const plr_dicom_slice *slice, double padding[2]) {
    double range[2];
    memcpy(padding, slice->padding, 2 * sizeof *padding);
    if (slice->format.inverted) {
        stored_range(&slice->format, range);
        padding[0] = range[0] + range[1] - slice->padding[1];
        padding[1] = range[0] + range[1] - slice->padding[0];
    }
}

static bool is_padding(const plr_dicom_slice *slice, const double padding[2], double value) {
    return slice->has_padding && value >= padding[0] && value <= padding[1];
}

/* ---- Types ---- */

static bool same_numbers(const plr_dicom_slice *a, const plr_dicom_slice *b) {
    const plr_dicom_format *f = &a->format, *g = &b->format;
    return f->allocated == g->allocated && f->is_signed == g->is_signed && f->pixels == g->pixels &&
           a->slope == b->slope && a->intercept == b->intercept;
}

static plr_voxel_type integer_type(const plr_dicom_format *format) {
    if (format->allocated == 8)
        return format->is_signed ? PLR_VOXEL_S8 : PLR_VOXEL_U8;
    if (format->allocated == 16)
        return format->is_signed ? PLR_VOXEL_S16 : PLR_VOXEL_U16;
    return format->is_signed ? PLR_VOXEL_S32 : PLR_VOXEL_U32;
}

/* The type of the voxels. Where the slices differ in how they store numbers, or values between
 * slices are needed, floats. Integers and uniform floats keep what is stored, with slope and
 * intercept beside; where these differ, voxels are physical values. */
static void choose_type(const plr_dicom_slices *slices, const plr_dicom_grid *grid,
                        plr_volume *volume) {
    const plr_dicom_slice *first = slices->items;
    bool same = true, narrow = true, integers = true;
    for (size_t i = 0; i < slices->count; i++) {
        const plr_dicom_slice *slice = &slices->items[i];
        same = same && same_numbers(first, slice);
        narrow =
            narrow && (slice->format.allocated <= 16 || slice->format.pixels == PLR_DICOM_FLOATS);
        integers = integers && slice->format.pixels == PLR_DICOM_INTEGERS;
    }
    volume->slope = same ? first->slope : 1;
    volume->intercept = same ? first->intercept : 0;
    volume->type = same && integers && !grid->resampled ? integer_type(&first->format)
                   : narrow                             ? PLR_VOXEL_F32
                                                        : PLR_VOXEL_F64;
}

/* ---- Frames to voxels ---- */

typedef struct work {
    const plr_dicom_slices *slices;
    const plr_dicom_report *report;
    plr_volume *volume;
    double least; /* physical, padding left out */
} work;

static inline void store(const plr_volume *volume, size_t index, double value) {
    void *voxels = volume->voxels;
    switch (volume->type) {
    case PLR_VOXEL_U8:
        ((uint8_t *)voxels)[index] = (uint8_t)value;
        break;
    case PLR_VOXEL_S8:
        ((int8_t *)voxels)[index] = (int8_t)value;
        break;
    case PLR_VOXEL_U16:
        ((uint16_t *)voxels)[index] = (uint16_t)value;
        break;
    case PLR_VOXEL_S16:
        ((int16_t *)voxels)[index] = (int16_t)value;
        break;
    case PLR_VOXEL_U32:
        ((uint32_t *)voxels)[index] = (uint32_t)value;
        break;
    case PLR_VOXEL_S32:
        ((int32_t *)voxels)[index] = (int32_t)value;
        break;
    case PLR_VOXEL_F32:
        ((float *)voxels)[index] = (float)value;
        break;
    default:
        ((double *)voxels)[index] = value;
        break;
    }
}

static inline double load(const plr_volume *volume, size_t index) {
    const void *voxels = volume->voxels;
    switch (volume->type) {
    case PLR_VOXEL_U8:
        return ((const uint8_t *)voxels)[index];
    case PLR_VOXEL_S8:
        return ((const int8_t *)voxels)[index];
    case PLR_VOXEL_U16:
        return ((const uint16_t *)voxels)[index];
    case PLR_VOXEL_S16:
        return ((const int16_t *)voxels)[index];
    case PLR_VOXEL_U32:
        return ((const uint32_t *)voxels)[index];
    case PLR_VOXEL_S32:
        return ((const int32_t *)voxels)[index];
    case PLR_VOXEL_F32:
        return (double)((const float *)voxels)[index];
    default:
        return ((const double *)voxels)[index];
    }
}

static bool is_float(const plr_volume *volume) {
    return volume->type == PLR_VOXEL_F32 || volume->type == PLR_VOXEL_F64;
}

/* One sample a pixel: from what is stored to what the voxels hold. NAN marks padding where they are
 * floats; integers keep it, and are looked through again. */
static void convert_grey(work *w, const plr_dicom_slice *slice, const void *frame, size_t start) {
    const plr_dicom_format *format = &slice->format;
    const plr_volume *volume = w->volume;
    bool integers = format->pixels == PLR_DICOM_INTEGERS, floats = is_float(volume);
    /* the volume's slope is 1 where slices differ */
    bool scales = slice->slope != volume->slope || slice->intercept != volume->intercept;
    double padding[2], least = INFINITY, greatest = -INFINITY;
    padding_range(slice, padding);
    for (size_t i = 0; i < pixel_count(format); i++) {
        double value = integers ? (double)stored_value(format, raw_bits(format, frame, i))
                                : float_value(format, frame, i);
        bool pads = is_padding(slice, padding, value);
        if (!pads && value - value >= 0) { /* finite */
            least = value < least ? value : least;
            greatest = value > greatest ? value : greatest;
        }
        if (scales)
            value = value * slice->slope + slice->intercept;
        store(volume, start + i, pads && floats ? (double)NAN : value);
    }
    if (least <= greatest)
        w->least =
            fmin(w->least, (slice->slope > 0 ? least : greatest) * slice->slope + slice->intercept);
}

static uint8_t byte_of(double value) {
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value + 0.5);
}

/* ITU-R BT.601 with the full range of bytes, as PS3.3, C.7.6.3.1.2 has it. */
static void rgb_of_ybr(uint8_t pixel[3]) {
    double y = pixel[0], b = pixel[1] - 128.0, r = pixel[2] - 128.0;
    pixel[0] = byte_of(y + 1.402 * r);
    pixel[1] = byte_of(y - 0.344136286 * b - 0.714136286 * r);
    pixel[2] = byte_of(y + 1.772 * b);
}

static void convert_colour(work *w, const plr_dicom_slice *slice, const void *frame, size_t start,
                           bool is_ybr) {
    const plr_dicom_format *format = &slice->format;
    size_t count = pixel_count(format);
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++) {
            size_t from = format->planar ? c * count + i : 3 * i + c;
            store(w->volume, 3 * (start + i) + c,
                  (double)stored_value(format, raw_bits(format, frame, from)));
        }
    if (is_ybr && w->volume->type == PLR_VOXEL_U8)
        for (size_t i = 0; i < count; i++)
            rgb_of_ybr((uint8_t *)w->volume->voxels + 3 * (start + i));
}

static int compare_sources(const void *a, const void *b) {
    const plr_dicom_slice *s = *(const plr_dicom_slice *const *)a;
    const plr_dicom_slice *t = *(const plr_dicom_slice *const *)b;
    if (s->file != t->file)
        return s->file < t->file ? -1 : 1;
    return (s->frame > t->frame) - (s->frame < t->frame);
}

static bool no_memory(const plr_dicom_report *report) {
    plr_diags_add(report->diags, PLR_CODE_NO_MEMORY, report->place, "there is not enough memory");
    return false;
}

/* Packed frames are found one after the other: they are read in the order of the file. */
static bool read_frames(work *w, plr_dicom_frame_reader read, void *user) {
    const plr_dicom_slices *slices = w->slices;
    const plr_dicom_slice **sources = malloc(slices->count * sizeof *sources);
    size_t largest = 0;
    for (size_t i = 0; sources && i < slices->count; i++) {
        sources[i] = &slices->items[i];
        size_t size = frame_size(&sources[i]->format);
        largest = size > largest ? size : largest;
    }
    void *frame = malloc(largest + 1);
    bool ok = (sources && frame) || no_memory(w->report);
    if (ok)
        qsort(sources, slices->count, sizeof *sources, compare_sources);
    for (size_t i = 0; ok && i < slices->count; i++) {
        const plr_dicom_slice *slice = sources[i];
        bool is_ybr = false;
        size_t start = (size_t)(slice - slices->items) * pixel_count(&slice->format);
        ok = read(user, slice, frame, frame_size(&slice->format), &is_ybr);
        if (ok && slice->format.samples == 1)
            convert_grey(w, slice, frame, start);
        else if (ok)
            convert_colour(w, slice, frame, start, is_ybr);
    }
    free(frame);
    free(sources);
    return ok;
}

/* ---- Padding ---- */

/* What padding becomes: the least value that is shown, as far as the type can store it. */
static double filling(const work *w) {
    const plr_volume *volume = w->volume;
    double least = volume->range_declared ? fmin(w->least, volume->minimum) : w->least;
    double value = isfinite(least) ? (least - volume->intercept) / volume->slope : 0;
    if (is_float(volume))
        return value;
    size_t bits = 8 * plr_voxel_size(volume->type);
    double count = ldexp(1, (int)bits);
    double low = w->slices->items[0].format.is_signed ? -count / 2 : 0;
    return fmin(fmax(round(value), low), low + count - 1);
}

static void fill_padding(const work *w) {
    const plr_volume *volume = w->volume;
    double fill = filling(w), padding[2];
    for (size_t i = 0; i < w->slices->count; i++) {
        const plr_dicom_slice *slice = &w->slices->items[i];
        if (!slice->has_padding)
            continue;
        size_t count = pixel_count(&slice->format), start = i * count;
        padding_range(slice, padding);
        for (size_t k = start; k < start + count; k++) {
            double value = load(volume, k);
            if (is_float(volume) ? isnan(value) : is_padding(slice, padding, value))
                store(volume, k, fill);
        }
    }
}

/* ---- Resampling ---- */

/* Between slice `*below` and the next, `weight` of the way. */
static double find_between(const plr_dicom_slices *slices, double along, size_t *below) {
    while (*below + 2 < slices->count && slices->items[*below + 1].along <= along)
        ++*below;
    double from = slices->items[*below].along, to = slices->items[*below + 1].along;
    double weight = (along - from) / (to - from);
    double nearest = round(weight);
    /* what is rounding of positions leaves slices as they are */
    return fmin(fmax(fabs(weight - nearest) < 1e-3 ? nearest : weight, 0), 1);
}

static bool resample(work *w, const plr_dicom_grid *grid) {
    plr_volume *volume = w->volume, out = *volume;
    size_t count = (size_t)volume->size[0] * volume->size[1] * volume->components, below = 0;
    out.size[2] = (uint32_t)grid->count;
    out.voxels = malloc(plr_volume_count(&out) * plr_voxel_size(out.type));
    if (!out.voxels)
        return no_memory(w->report);
    for (size_t k = 0; k < grid->count; k++) {
        double weight = find_between(w->slices, grid->first + (double)k * grid->step, &below);
        for (size_t i = 0; i < count; i++) {
            double a = load(volume, below * count + i), b = load(volume, (below + 1) * count + i);
            store(&out, k * count + i, weight <= 0 ? a : weight >= 1 ? b : a + (b - a) * weight);
        }
    }
    free(volume->voxels);
    *volume = out;
    return true;
}

/* ---- The whole ---- */

/* From the least beginning to the greatest end of the windows of all slices. */
static void find_window(const plr_dicom_slices *slices, double window[2]) {
    window[0] = INFINITY;
    window[1] = -INFINITY;
    for (size_t i = 0; i < slices->count; i++) {
        const plr_dicom_slice *slice = &slices->items[i];
        if (!slice->has_window)
            continue;
        double a = slice->window[0], b = slice->window[1];
        if (slice->format.inverted) {
            double kept = a;
            a = mirrored(slice, b);
            b = mirrored(slice, kept);
        }
        window[0] = fmin(window[0], a);
        window[1] = fmax(window[1], b);
    }
}

static bool prepare(work *w, const plr_dicom_grid *grid) {
    plr_volume *volume = w->volume;
    const plr_dicom_format *format = &w->slices->items[0].format;
    choose_type(w->slices, grid, volume);
    volume->components = format->samples;
    const uint64_t size[3] = {format->columns, format->rows, grid->count};
    if (!plr_volume_check_size(size, format->samples, volume->type, w->report->place,
                               w->report->diags))
        return false;
    volume->size[0] = format->columns;
    volume->size[1] = format->rows;
    volume->size[2] = (uint32_t)w->slices->count;
    volume->voxels = malloc(plr_volume_count(volume) * plr_voxel_size(volume->type));
    return volume->voxels || no_memory(w->report);
}

bool plr_dicom_voxels(const plr_dicom_slices *slices, const plr_dicom_grid *grid,
                      plr_dicom_frame_reader read, void *user, const plr_dicom_report *report,
                      plr_volume *volume) {
    work w = {slices, report, volume, INFINITY};
    double window[2];
    find_window(slices, window);
    bool declared = window[0] < window[1];
    bool ok = prepare(&w, grid) && read_frames(&w, read, user);
    if (ok) {
        volume->range_declared = declared;
        volume->minimum = window[0];
        if (volume->components == 1)
            fill_padding(&w);
        ok = !grid->resampled || resample(&w, grid);
    }
    if (!ok) {
        free(volume->voxels);
        volume->voxels = NULL;
        return false;
    }
    plr_volume_set_range(volume, declared ? window[0] : (double)NAN,
                         declared ? window[1] : (double)NAN);
    return true;
}
