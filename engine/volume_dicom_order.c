/* Puts the slices of a DICOM series in order: by where they lie, never by name or number. */
#include "engine/volume_dicom.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is written with six digits is equal where it differs less than this. */
#define COSINE_TOLERANCE 1e-3
#define SPACING_TOLERANCE 1e-3
/* Parts of the usual gap: within the first, two slices are at one place; within the second, slices
 * are evenly spaced, as far as rounded positions tell. */
#define SAME_PLACE 0.01
#define EVEN 0.02
/* Millimetres that nothing is resolved to. */
#define LEAST_GAP 1e-4
/* Resampling makes at most so many times the slices, or so many. */
#define MOST_TIMES 4
#define MOST_SLICES 256

#define FAIL(report, ...)                                                                          \
    (plr_diags_add((report)->diags, PLR_CODE_BAD_VOLUME, (report)->place, __VA_ARGS__), false)
#define WARN(report, ...)                                                                          \
    plr_diags_add_as((report)->diags, PLR_WARNING, PLR_CODE_BAD_VOLUME, (report)->place,           \
                     __VA_ARGS__)

static const char *name_of(const plr_dicom_report *report, const plr_dicom_slice *slice) {
    return report->file_name(report->user, slice->file);
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void find_normal(const plr_dicom_slice *slice, double normal[3]) {
    const double *x = slice->orientation[0], *y = slice->orientation[1];
    for (int i = 0; i < 3; i++)
        normal[i] = x[(i + 1) % 3] * y[(i + 2) % 3] - x[(i + 2) % 3] * y[(i + 1) % 3];
    double length = sqrt(dot(normal, normal));
    for (int i = 0; i < 3; i++)
        normal[i] /= length;
}

/* ---- What all slices share ---- */

static bool same_orientation(const plr_dicom_slice *a, const plr_dicom_slice *b) {
    for (int i = 0; i < 6; i++)
        if (fabs(a->orientation[i / 3][i % 3] - b->orientation[i / 3][i % 3]) > COSINE_TOLERANCE)
            return false;
    return true;
}

static bool same_spacing(const plr_dicom_slice *a, const plr_dicom_slice *b) {
    for (int i = 0; i < 2; i++)
        if (fabs(a->spacing[i] - b->spacing[i]) > SPACING_TOLERANCE * a->spacing[i])
            return false;
    return a->has_spacing == b->has_spacing;
}

static bool check_alike(const plr_dicom_slice *first, const plr_dicom_slice *slice,
                        const plr_dicom_report *report) {
    const plr_dicom_format *a = &first->format, *b = &slice->format;
    const char *name = name_of(report, slice), *other = name_of(report, first);
    if (a->columns != b->columns || a->rows != b->rows || a->samples != b->samples)
        return FAIL(report, "%s is %u x %u with %u samples a pixel, but %s is %u x %u with %u",
                    name, b->columns, b->rows, b->samples, other, a->columns, a->rows, a->samples);
    if (first->has_place != slice->has_place)
        return FAIL(report, "%s says where it lies, but %s does not",
                    first->has_place ? other : name, first->has_place ? name : other);
    if (first->has_place && !same_orientation(first, slice))
        return FAIL(report, "%s has another orientation than %s", name, other);
    if (!same_spacing(first, slice))
        return FAIL(report, "%s has pixels of another size than %s", name, other);
    return true;
}

/* ---- Order ---- */

static int compare(double a, double b) {
    return (a > b) - (a < b);
}

static int compare_slices(const void *a, const void *b) {
    const plr_dicom_slice *s = a, *t = b;
    int order = compare(s->along, t->along);
    if (!order)
        order = compare(s->instance, t->instance);
    if (!order)
        order = compare(s->file, t->file);
    return order ? order : compare(s->frame, t->frame);
}

static int compare_numbers(const void *a, const void *b) {
    return compare(*(const double *)a, *(const double *)b);
}

/* The median of the gaps between places; 0 where all slices are at one. NAN without memory. */
static double usual_gap(const plr_dicom_slices *slices) {
    double *gaps = malloc(slices->count * sizeof *gaps);
    size_t count = 0;
    if (!gaps)
        return (double)NAN;
    for (size_t i = 1; i < slices->count; i++) {
        double gap = slices->items[i].along - slices->items[i - 1].along;
        if (gap > LEAST_GAP)
            gaps[count++] = gap;
    }
    qsort(gaps, count, sizeof *gaps, compare_numbers);
    double gap = count ? gaps[(count - 1) / 2] : 0;
    free(gaps);
    return gap;
}

/* Slices whose places are told apart by rounding alone get one place, and are put in order of
 * their numbers. */
static void join_places(plr_dicom_slices *slices, double gap) {
    double slack = gap > 0 ? gap * SAME_PLACE : LEAST_GAP;
    for (size_t i = 1; i < slices->count; i++) {
        plr_dicom_slice *slice = &slices->items[i], *before = slice - 1;
        if (slice->along - before->along <= slack)
            slice->along = before->along;
    }
    qsort(slices->items, slices->count, sizeof *slices->items, compare_slices);
}

/* One slice a place: number `time_point`, or the last, of those that are there. */
static void drop_duplicates(plr_dicom_slices *slices, uint32_t time_point,
                            const plr_dicom_report *report) {
    size_t kept = 0, dropped = 0;
    const char *example = NULL;
    for (size_t i = 0; i < slices->count;) {
        size_t end = i + 1;
        while (end < slices->count && slices->items[end].along == slices->items[i].along)
            end++;
        size_t taken = end - i > time_point ? i + time_point : end - 1;
        if (end - i > 1 && !example)
            example = name_of(report, &slices->items[taken == i ? i + 1 : i]);
        dropped += end - i - 1;
        slices->items[kept++] = slices->items[taken];
        i = end;
    }
    slices->count = kept;
    if (dropped && !report->time_given)
        WARN(report,
             "%zu slices of %s lie where others lie, among them %s; the first at each place is "
             "used",
             dropped, report->name, example);
}

/* ---- Even spacing ---- */

static bool is_even(const plr_dicom_slices *slices, double first, double step) {
    for (size_t i = 0; i < slices->count; i++)
        if (fabs(slices->items[i].along - first - (double)i * step) > EVEN * step)
            return false;
    return true;
}

/* Whether all gaps are whole numbers of usual gaps: slices are missing. */
static bool has_holes(const plr_dicom_slices *slices, double gap) {
    for (size_t i = 1; i < slices->count; i++) {
        double gaps = (slices->items[i].along - slices->items[i - 1].along) / gap;
        if (gaps < 0.5 || fabs(gaps - round(gaps)) > EVEN * gaps)
            return false;
    }
    return true;
}

static double least_gap(const plr_dicom_slices *slices) {
    double least = INFINITY;
    for (size_t i = 1; i < slices->count; i++)
        least = fmin(least, slices->items[i].along - slices->items[i - 1].along);
    return least;
}

static void find_grid(const plr_dicom_slices *slices, double gap, const plr_dicom_report *report,
                      plr_dicom_grid *grid) {
    size_t count = slices->count;
    double first = slices->items[0].along, total = slices->items[count - 1].along - first;
    *grid = (plr_dicom_grid){count, first, count > 1 ? total / (double)(count - 1) : 0, false};
    if (count < 2 || is_even(slices, first, grid->step))
        return;
    bool holes = has_holes(slices, gap);
    double wanted = round(total / (holes ? gap : least_gap(slices))) + 1;
    double most = fmax((double)count * MOST_TIMES, MOST_SLICES);
    grid->count = (size_t)fmax(fmin(wanted, most), (double)count);
    grid->step = total / (double)(grid->count - 1);
    grid->resampled = true;
    if (holes)
        WARN(report, "%zu slices of %s are missing; what lies there is interpolated",
             grid->count - count, report->name);
    else
        WARN(report,
             "the slices of %s are not evenly spaced; %zu of them are resampled to %zu, %g "
             "mm apart",
             report->name, count, grid->count, grid->step);
}

/* ---- Geometry ---- */

/* The way from the first slice to the last for each millimetre along the normal: a tilted gantry
 * shears it. */
static void find_stacking(const plr_dicom_slices *slices, const double normal[3],
                          const plr_dicom_report *report, double way[3]) {
    const plr_dicom_slice *first = slices->items, *last = first + slices->count - 1;
    double total = last->along - first->along;
    for (int k = 0; k < 3; k++)
        way[k] = total > 0 ? (last->position[k] - first->position[k]) / total : normal[k];
    double most = 0;
    for (size_t i = 0; i < slices->count; i++) {
        double away[3];
        for (int k = 0; k < 3; k++)
            away[k] = slices->items[i].position[k] - first->position[k] -
                      way[k] * (slices->items[i].along - first->along);
        for (int k = 0; k < 2; k++)
            most = fmax(most, fabs(dot(away, first->orientation[k])) / first->spacing[k]);
    }
    if (first->has_spacing && most > 0.5)
        WARN(report, "the slices of %s do not lie on a line, but up to %.2g pixels beside it",
             report->name, most);
}

static void set_geometry(const plr_dicom_slices *slices, const plr_dicom_grid *grid,
                         const plr_dicom_report *report, plr_volume *volume) {
    const plr_dicom_slice *first = slices->items;
    double normal[3] = {0, 0, 1}, way[3] = {0, 0, 1};
    double step = grid->count > 1 && first->has_place ? grid->step : fabs(first->thickness);
    if (first->has_place) {
        find_normal(first, normal);
        find_stacking(slices, normal, report, way);
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 2; i++)
            volume->directions[i][k] =
                (first->has_place ? first->orientation[i][k] : (double)(i == k)) *
                first->spacing[i];
        volume->directions[2][k] = way[k] * (step > 0 ? step : 1);
        volume->origin[k] = first->has_place ? first->position[k] : 0;
    }
    volume->has_geometry = first->has_spacing;
    volume->unplaced = !first->has_place;
    volume->space = first->has_place ? PLR_SPACE_LPS : PLR_SPACE_UNKNOWN;
    volume->metres = 1e-3;
}

bool plr_dicom_order(plr_dicom_slices *slices, uint32_t time_point, const plr_dicom_report *report,
                     plr_dicom_grid *grid, plr_volume *volume) {
    plr_dicom_slice *first = slices->items;
    double normal[3];
    for (size_t i = 1; i < slices->count; i++)
        if (!check_alike(first, &first[i], report))
            return false;
    find_normal(first, normal);
    for (size_t i = 0; i < slices->count; i++)
        first[i].along = first->has_place ? dot(first[i].position, normal) : 0;
    qsort(first, slices->count, sizeof *first, compare_slices);
    if (!first->has_place) {
        if (first[0].file != first[slices->count - 1].file)
            WARN(report,
                 "the slices of %s do not say where they lie; they are in the order of "
                 "their numbers",
                 report->name);
        *grid = (plr_dicom_grid){.count = slices->count};
    } else {
        double gap = usual_gap(slices);
        if (isnan(gap)) {
            plr_diags_add(report->diags, PLR_CODE_NO_MEMORY, report->place,
                          "there is not enough memory");
            return false;
        }
        join_places(slices, gap);
        drop_duplicates(slices, time_point, report);
        find_grid(slices, gap, report, grid);
    }
    set_geometry(slices, grid, report, volume);
    return true;
}
