/* What the elements of a DICOM file say of its pictures (PS3.3, C.7.6). */
#include "engine/volume_dicom.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Slices of all files together. */
#define MAX_SLICES (1u << 18)
/* Pixels for each byte of packed data: nothing sound packs tighter. */
#define MAX_RATIO 65536u
/* How far cosines may be from what they should be: they are rounded, and written by people. */
#define COSINE_SLACK 0.01

#define IMAGER_SPACING 0x00181164u
#define INSTANCE_NUMBER 0x00200013u
#define SERIES_UID 0x0020000eu
#define NUMBER_OF_FRAMES 0x00280008u
#define MODALITY_LUT 0x00283000u
#define FRAME_GROUPS 0x52009230u
#define FRAME_OFFSETS 0x3004000cu
#define FLOAT_PIXELS 0x7fe00008u
#define DOUBLE_PIXELS 0x7fe00009u

/* An element of one frame: in which functional group, and its tag. */
typedef struct place_of_value {
    uint32_t group, tag;
} place_of_value;

static const place_of_value in_position = {0x00209113u, 0x00200032u},
                            in_orientation = {0x00209116u, 0x00200037u},
                            in_spacing = {0x00289110u, 0x00280030u},
                            in_thickness = {0x00289110u, 0x00180050u},
                            in_gap = {0x00289110u, 0x00180088u},
                            in_intercept = {0x00289145u, 0x00281052u},
                            in_slope = {0x00289145u, 0x00281053u},
                            in_center = {0x00289132u, 0x00281050u},
                            in_width = {0x00289132u, 0x00281051u};

static bool read_numbers(const plr_dicom *file, size_t frame, place_of_value at, double *numbers,
                         size_t count) {
    if (plr_dicom_numbers(file, frame, at.group, at.tag, numbers, count) < count)
        return false;
    for (size_t i = 0; i < count; i++)
        if (!(fabs(numbers[i]) <= 1e15))
            return false;
    return true;
}

/* A whole number of the data set, or `otherwise` where there is none. */
static uint32_t read_count(const plr_dicom *file, uint32_t tag, uint32_t otherwise) {
    double number;
    if (!read_numbers(file, 0, (place_of_value){0, tag}, &number, 1))
        return otherwise;
    return number >= 0 && number <= (double)UINT32_MAX ? (uint32_t)number : UINT32_MAX;
}

/* Says what is wrong with the file; false. */
static bool fail(char *fault, const char *format, ...) PLR_PRINTF(2, 3);

static bool fail(char *fault, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault, PLR_DICOM_FAULT, format, arguments);
    va_end(arguments);
    return false;
}

/* ---- Format ---- */

static const struct {
    const char *name;
    uint32_t samples;
    bool inverted;
    bool packed_alone; /* only where the library unpacks it to RGB */
} photometrics[] = {
    {"MONOCHROME1", 1, true, false}, {"MONOCHROME2", 1, false, false}, {"RGB", 3, false, false},
    {"YBR_FULL", 3, false, false},   {"YBR_FULL_422", 3, false, true}, {"YBR_RCT", 3, false, true},
    {"YBR_ICT", 3, false, true},
};

static bool read_photometric(const plr_dicom *file, const plr_dicom_set *set,
                             plr_dicom_format *format, char fault[PLR_DICOM_FAULT]) {
    char name[32];
    plr_dicom_text(file, 0x00280004u, name, sizeof name);
    for (size_t i = 0; i < sizeof photometrics / sizeof *photometrics; i++) {
        if (strcmp(photometrics[i].name, name) != 0 ||
            (photometrics[i].packed_alone && !set->fragments))
            continue;
        format->inverted = photometrics[i].inverted;
        format->is_ybr = name[0] == 'Y';
        return photometrics[i].samples == format->samples ||
               fail(fault, "%u samples a pixel do not go with %s", format->samples, name);
    }
    return fail(fault, "its photometric interpretation %s is not read", *name ? name : "(none)");
}

/* 8, 16 or 32 bits of which the used ones are anywhere. */
static bool check_bits(const plr_dicom_format *format, char fault[PLR_DICOM_FAULT]) {
    uint32_t allocated = format->allocated, stored = format->stored, high = format->high;
    if (allocated != 8 && allocated != 16 && allocated != 32) {
        return fail(fault, "its pixels of %u bits are not read", allocated);
    }
    if (stored == 0 || stored > allocated || high >= allocated || high + 1 < stored)
        return fail(fault, "its bits stored do not fit the bits allocated");
    return true;
}

static bool read_format(const plr_dicom *file, const plr_dicom_set *set, plr_dicom_format *format,
                        char fault[PLR_DICOM_FAULT]) {
    format->rows = read_count(file, 0x00280010u, 0);
    format->columns = read_count(file, 0x00280011u, 0);
    format->samples = read_count(file, 0x00280002u, 1);
    format->allocated = read_count(file, 0x00280100u, 0);
    format->stored = read_count(file, 0x00280101u, format->allocated);
    format->high = read_count(file, 0x00280102u, format->stored - 1);
    format->is_signed = read_count(file, 0x00280103u, 0) == 1;
    format->planar = format->samples > 1 && read_count(file, 0x00280006u, 0) == 1;
    format->pixels = set->pixel_tag == FLOAT_PIXELS    ? PLR_DICOM_FLOATS
                     : set->pixel_tag == DOUBLE_PIXELS ? PLR_DICOM_DOUBLES
                                                       : PLR_DICOM_INTEGERS;
    if (format->pixels != PLR_DICOM_INTEGERS) {
        format->allocated = format->pixels == PLR_DICOM_FLOATS ? 32 : 64;
        return (format->samples == 1 && !set->fragments) ||
               fail(fault, "its pixel data are damaged");
    }
    return read_photometric(file, set, format, fault) && check_bits(format, fault);
}

/* What the header says must be there. */
static bool check_amount(const plr_dicom_set *set, const plr_dicom_format *format, uint64_t frames,
                         char fault[PLR_DICOM_FAULT]) {
    if (format->columns == 0 || format->rows == 0 || format->columns > PLR_VOLUME_MAX_SIDE ||
        format->rows > PLR_VOLUME_MAX_SIDE || frames == 0 || frames > PLR_VOLUME_MAX_SIDE) {
        return fail(fault, "it says %u x %u x %llu pixels; 1..%u a side are possible",
                    format->columns, format->rows, (unsigned long long)frames, PLR_VOLUME_MAX_SIDE);
    }
    /* at most 2^14 each, 2^3 samples and 2^3 bytes */
    uint64_t bytes =
        frames * format->columns * format->rows * format->samples * (format->allocated / 8);
    uint64_t have = set->pixels;
    bool packed = set->fragments > 0;
    if (packed ? frames >= set->fragments || bytes / MAX_RATIO > have : bytes > have) {
        return fail(
            fault, "it holds %llu bytes of pixels, too few for the %u x %u x %llu of its header",
            (unsigned long long)have, format->columns, format->rows, (unsigned long long)frames);
    }
    return true;
}

/* ---- Place ---- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Makes both of unit length; false where they are no two perpendicular directions. */
static bool clean_orientation(double orientation[2][3]) {
    for (int i = 0; i < 2; i++) {
        double length = sqrt(dot(orientation[i], orientation[i]));
        if (!(fabs(length - 1) < COSINE_SLACK))
            return false;
        for (int k = 0; k < 3; k++)
            orientation[i][k] /= length;
    }
    return fabs(dot(orientation[0], orientation[1])) < COSINE_SLACK;
}

static bool read_place(const plr_dicom *file, size_t frame, plr_dicom_slice *slice,
                       char fault[PLR_DICOM_FAULT]) {
    double spacing[2] = {0, 0};
    slice->has_place = read_numbers(file, frame, in_position, slice->position, 3) &&
                       read_numbers(file, frame, in_orientation, slice->orientation[0], 6);
    if (slice->has_place && !clean_orientation(slice->orientation))
        return fail(fault, "its orientation is not two perpendicular directions");
    if (read_numbers(file, frame, in_spacing, spacing, 2) ||
        read_numbers(file, frame, (place_of_value){0, IMAGER_SPACING}, spacing, 2)) {
        slice->has_spacing = spacing[0] > 0 && spacing[1] > 0;
        slice->spacing[0] = spacing[1]; /* between rows comes first */
        slice->spacing[1] = spacing[0];
    }
    if (!read_numbers(file, frame, in_gap, &slice->thickness, 1) &&
        !read_numbers(file, frame, in_thickness, &slice->thickness, 1))
        slice->thickness = 0;
    return true;
}

/* ---- Values ---- */

/* PS3.3, C.11.2.1.2: the first of several windows. */
static void read_window(const plr_dicom *file, size_t frame, plr_dicom_slice *slice) {
    double center, width;
    char function[32];
    if (!read_numbers(file, frame, in_center, &center, 1) ||
        !read_numbers(file, frame, in_width, &width, 1) || slice->format.samples > 1)
        return;
    plr_dicom_text(file, 0x00281056u, function, sizeof function);
    bool exact = strcmp(function, "LINEAR_EXACT") == 0 || strcmp(function, "SIGMOID") == 0;
    double half = exact ? width / 2 : (width - 1) / 2;
    slice->window[0] = center - half - (exact ? 0 : 0.5);
    slice->window[1] = center + half - (exact ? 0 : 0.5);
    slice->has_window = half > 0;
}

/* PS3.3, C.7.5.1.1.2: one value, or all between two. They may come as unsigned. */
static void read_padding(const plr_dicom *file, plr_dicom_slice *slice) {
    static const place_of_value at[2] = {{0, 0x00280120u}, {0, 0x00280121u}};
    if (slice->format.pixels != PLR_DICOM_INTEGERS || slice->format.samples > 1 ||
        !read_numbers(file, 0, at[0], &slice->padding[0], 1))
        return;
    slice->has_padding = true;
    if (!read_numbers(file, 0, at[1], &slice->padding[1], 1))
        slice->padding[1] = slice->padding[0];
    for (int i = 0; i < 2 && slice->format.is_signed; i++)
        if (slice->padding[i] > ldexp(1, (int)slice->format.allocated - 1) - 1)
            slice->padding[i] -= ldexp(1, (int)slice->format.allocated);
    if (slice->padding[0] > slice->padding[1]) {
        double kept = slice->padding[0];
        slice->padding[0] = slice->padding[1];
        slice->padding[1] = kept;
    }
}

static void read_values(const plr_dicom *file, size_t frame, plr_dicom_slice *slice) {
    slice->slope = 1;
    slice->intercept = 0;
    if (slice->format.samples == 1) {
        double slope, intercept;
        if (read_numbers(file, frame, in_slope, &slope, 1) && slope != 0)
            slice->slope = slope;
        if (read_numbers(file, frame, in_intercept, &intercept, 1))
            slice->intercept = intercept;
    }
    read_window(file, frame, slice);
    read_padding(file, slice);
}

/* ---- Frames ---- */

static plr_dicom_slice *add_slice(plr_dicom_slices *slices) {
    if (slices->count == slices->capacity) {
        size_t capacity = slices->capacity * 2 + 64;
        plr_dicom_slice *items =
            capacity <= MAX_SLICES ? realloc(slices->items, capacity * sizeof *items) : NULL;
        if (!items)
            return NULL;
        slices->items = items;
        slices->capacity = capacity;
    }
    return memset(&slices->items[slices->count++], 0, sizeof *slices->items);
}

/* Frames that do not say where each lies are one behind the other (PS3.3, C.8.8.3.2 and
 * C.8.4.8). */
static void stack_frames(const plr_dicom *file, plr_dicom_slice *slices, size_t count) {
    double *offsets = calloc(count, sizeof *offsets);
    bool given =
        offsets && read_numbers(file, 0, (place_of_value){0, FRAME_OFFSETS}, offsets, count);
    double normal[3], step = slices->thickness != 0 ? slices->thickness : 1;
    const double *x = slices->orientation[0], *y = slices->orientation[1];
    for (int i = 0; i < 3; i++)
        normal[i] = x[(i + 1) % 3] * y[(i + 2) % 3] - x[(i + 2) % 3] * y[(i + 1) % 3];
    for (size_t i = 0; i < count; i++) {
        double offset = given ? offsets[i] - offsets[0] : (double)i * step;
        for (int k = 0; k < 3; k++)
            slices[i].position[k] += normal[k] * offset;
    }
    free(offsets);
}

static bool read_frames(const plr_dicom *file, const plr_dicom_format *format, size_t frames,
                        uint32_t number, plr_dicom_slices *slices, char fault[PLR_DICOM_FAULT]) {
    size_t first = slices->count;
    bool has_groups = plr_dicom_has(file, FRAME_GROUPS);
    double instance = read_count(file, INSTANCE_NUMBER, 0);
    for (size_t frame = 0; frame < frames; frame++) {
        plr_dicom_slice *slice = add_slice(slices);
        if (!slice)
            return fail(fault, "there is not enough memory for its slices");
        if (frame && !has_groups) { /* all are the same */
            *slice = slices->items[first];
            slice->frame = (uint32_t)frame;
            continue;
        }
        slice->file = number;
        slice->frame = (uint32_t)frame;
        slice->format = *format;
        slice->instance = instance;
        if (!read_place(file, frame, slice, fault))
            return false;
        read_values(file, frame, slice);
    }
    if (frames > 1 && !has_groups && slices->items[first].has_place)
        stack_frames(file, slices->items + first, frames);
    return true;
}

bool plr_dicom_read_slices(const plr_dicom_set *set, uint32_t file, plr_dicom_slices *slices,
                           char series[PLR_DICOM_UID], char fault[PLR_DICOM_FAULT]) {
    size_t before = slices->count;
    *series = '\0';
    if (!set->has_pixels)
        return true;
    plr_dicom *opened = plr_dicom_open(set->data, set->header, set->syntax, fault);
    if (!opened)
        return false;
    plr_dicom_format format = {0};
    uint32_t frames = read_count(opened, NUMBER_OF_FRAMES, 1);
    frames += frames == 0;
    plr_dicom_text(opened, SERIES_UID, series, PLR_DICOM_UID);
    bool ok = read_format(opened, set, &format, fault);
    if (ok && plr_dicom_has(opened, MODALITY_LUT))
        ok = fail(fault, "its modality lookup table is not read");
    ok = ok && check_amount(set, &format, frames, fault) &&
         read_frames(opened, &format, frames, file, slices, fault);
    plr_dicom_close(opened);
    if (!ok)
        slices->count = before;
    return ok;
}
