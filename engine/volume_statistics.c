#include "engine/volume_statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/volume_internal.h"

/* ---- Reading in blocks ---- */

enum {
    BLOCK = 4096
};

/* Values of one component, block after block. */
typedef struct walk {
    const plr_volume *volume;
    uint32_t component;
    size_t at, count; /* voxels */
    size_t length;    /* of the block */
    double values[BLOCK];
} walk;

#define TAKE(name, ctype)                                                                          \
    static void take_##name(const void *voxels, size_t stride, size_t count, double *out) {        \
        const ctype *values = voxels;                                                              \
        for (size_t i = 0; i < count; i++)                                                         \
            out[i] = (double)values[i * stride];                                                   \
    }
TAKE(u8, uint8_t)
TAKE(s8, int8_t)
TAKE(u16, uint16_t)
TAKE(s16, int16_t)
TAKE(u32, uint32_t)
TAKE(s32, int32_t)
TAKE(u64, uint64_t)
TAKE(s64, int64_t)
TAKE(f32, float)
TAKE(f64, double)

static void (*const takes[])(const void *voxels, size_t stride, size_t count, double *out) = {
    [PLR_VOXEL_U8] = take_u8,   [PLR_VOXEL_S8] = take_s8,   [PLR_VOXEL_U16] = take_u16,
    [PLR_VOXEL_S16] = take_s16, [PLR_VOXEL_U32] = take_u32, [PLR_VOXEL_S32] = take_s32,
    [PLR_VOXEL_U64] = take_u64, [PLR_VOXEL_S64] = take_s64, [PLR_VOXEL_F32] = take_f32,
    [PLR_VOXEL_F64] = take_f64,
};

static void begin(walk *w, const plr_volume *volume, uint32_t component) {
    w->volume = volume;
    w->component = component;
    w->at = w->length = 0;
    w->count = plr_volume_count(volume) / volume->components;
}

static bool next(walk *w) {
    const plr_volume *v = w->volume;
    w->at += w->length;
    if (w->at >= w->count)
        return false;
    w->length = w->count - w->at < BLOCK ? w->count - w->at : BLOCK;
    const char *voxels = v->voxels;
    size_t first = w->at * v->components + w->component;
    takes[v->type](voxels + first * plr_voxel_size(v->type), v->components, w->length, w->values);
    if (v->slope != 1 || v->intercept != 0)
        for (size_t i = 0; i < w->length; i++)
            w->values[i] = w->values[i] * v->slope + v->intercept;
    return true;
}

/* ---- Percentiles ---- */

enum {
    MOST = 16, /* percentiles at once */
    DIGIT_BITS = 16,
    DIGITS = 1 << DIGIT_BITS,
    PASSES = 64 / DIGIT_BITS
};

static uint64_t bits_of(double value) {
    uint64_t bits;
    value += 0.0; /* -0 is 0 */
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Unsigned numbers in the order of the doubles. */
static uint64_t key_of(uint64_t bits) {
    return bits >> 63 ? ~bits : bits | UINT64_C(1) << 63;
}

static double value_of(uint64_t key) {
    uint64_t bits = key >> 63 ? key & ~(UINT64_C(1) << 63) : ~key;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* A search by digits, the highest first: of each rank the digits that are known, and its rank among
 * the values that begin so. */
typedef struct selection {
    uint64_t prefixes[MOST], ranks[MOST];
    size_t count;
    uint64_t known[MOST]; /* distinct prefixes, ascending */
    size_t known_count;
    uint64_t *tables; /* DIGITS counts for each of them */
    uint64_t used;    /* bits that any value has set */
} selection;

static void find_known(selection *s) {
    s->known_count = 0;
    for (size_t i = 0; i < s->count; i++) {
        size_t k = 0;
        while (k < s->known_count && s->known[k] != s->prefixes[i])
            k++;
        if (k == s->known_count)
            s->known[s->known_count++] = s->prefixes[i];
    }
    memset(s->tables, 0, s->known_count * DIGITS * sizeof *s->tables);
}

static void count_digits(selection *s, walk *w, int shift) {
    while (next(w))
        for (size_t i = 0; i < w->length; i++) {
            if (!isfinite(w->values[i]))
                continue;
            uint64_t bits = bits_of(w->values[i]), key = key_of(bits);
            uint64_t prefix = shift + DIGIT_BITS < 64 ? key >> (shift + DIGIT_BITS) : 0;
            s->used |= bits;
            for (size_t k = 0; k < s->known_count; k++)
                if (s->known[k] == prefix)
                    s->tables[k * DIGITS + ((key >> shift) & (DIGITS - 1))]++;
        }
}

static void take_digit(selection *s, size_t index) {
    size_t k = 0, digit = 0;
    while (s->known[k] != s->prefixes[index])
        k++;
    const uint64_t *table = s->tables + k * DIGITS;
    while (digit < DIGITS - 1 && s->ranks[index] >= table[digit])
        s->ranks[index] -= table[digit++];
    s->prefixes[index] = s->prefixes[index] << DIGIT_BITS | digit;
}

static void select_values(selection *s, walk *w, const plr_volume *volume, uint32_t component,
                          double *values) {
    int shift = 64;
    for (int pass = 0; pass < PASSES; pass++) {
        shift -= DIGIT_BITS;
        find_known(s);
        begin(w, volume, component);
        count_digits(s, w, shift);
        for (size_t i = 0; i < s->count; i++)
            take_digit(s, i);
        if (!(s->used & ((UINT64_C(1) << shift) - 1)))
            break; /* no value has anything further down */
    }
    for (size_t i = 0; i < s->count; i++) {
        uint64_t key = s->prefixes[i] << shift;
        bool negative = !(key >> 63);
        values[i] = value_of(negative ? key | ((UINT64_C(1) << shift) - 1) : key) + 0.0;
    }
}

static uint64_t count_finite(walk *w, const plr_volume *volume, uint32_t component) {
    uint64_t finite = 0;
    begin(w, volume, component);
    while (next(w))
        for (size_t i = 0; i < w->length; i++)
            finite += isfinite(w->values[i]) != 0;
    return finite;
}

bool plr_volume_get_percentiles(const plr_volume *volume, uint32_t component,
                                const double *percents, size_t count, double *values) {
    if (component >= volume->components || count > MOST)
        return false;
    walk *w = malloc(sizeof *w);
    selection s = {.count = count, .tables = malloc((size_t)MOST * DIGITS * sizeof *s.tables)};
    bool fine = w && s.tables;
    uint64_t finite = fine ? count_finite(w, volume, component) : 0;
    memset(values, 0, count * sizeof *values);
    for (size_t i = 0; i < count; i++) {
        double rank = ceil(percents[i] / 100 * (double)finite) - 1;
        s.ranks[i] = rank > 0 ? (uint64_t)rank : 0;
        s.ranks[i] = s.ranks[i] < finite ? s.ranks[i] : finite - 1;
    }
    if (finite)
        select_values(&s, w, volume, component, values);
    free(s.tables);
    free(w);
    return fine;
}

/* ---- Bins ---- */

static void add_to_bins(walk *w, double first, double width, uint64_t *counts, size_t bins) {
    while (next(w))
        for (size_t i = 0; i < w->length; i++) {
            if (!isfinite(w->values[i]))
                continue;
            /* divided apart: the difference may be too large a number */
            double bin = width > 0 ? floor(w->values[i] / width - first / width) : 0;
            counts[bin > 0 ? bin < (double)bins ? (size_t)bin : bins - 1 : 0]++;
        }
}

void plr_volume_count_bins(const plr_volume *volume, uint32_t component, double first, double width,
                           uint64_t *counts, size_t bins) {
    walk *w = malloc(sizeof *w);
    memset(counts, 0, bins * sizeof *counts);
    if (w && component < volume->components) {
        begin(w, volume, component);
        add_to_bins(w, first, width, counts, bins);
    }
    free(w);
}

/* From one value to the next one of integers; 0 of floats. */
static double level_of(const plr_volume *volume) {
    return volume->type < PLR_VOXEL_F32 ? fabs(volume->slope) : 0;
}

/* Bins for integers hold whole numbers of levels, so that none gets more than its share. */
static void choose_bins(const plr_volume *volume, plr_volume_statistics *s) {
    double level = level_of(volume);
    s->first = s->minimum;
    if (level > 0) {
        double levels = round(s->maximum / level - s->minimum / level) + 1;
        double each = ceil(levels / PLR_HISTOGRAM_BINS);
        s->width = each * level;
        s->bins = (uint32_t)ceil(levels / each);
    } else {
        s->width = s->maximum / PLR_HISTOGRAM_BINS - s->minimum / PLR_HISTOGRAM_BINS;
        s->bins = s->width > 0 ? PLR_HISTOGRAM_BINS : 1;
    }
}

double plr_volume_threshold(const plr_volume *volume, uint32_t component, double first,
                            double last) {
    enum {
        BINS = 256
    };
    uint64_t counts[BINS];
    double width = last / BINS - first / BINS;
    if (!(width > 0))
        return first;
    plr_volume_count_bins(volume, component, first, width, counts, BINS);
    double all = 0, sum = 0, below = 0, sum_below = 0, best = -1, least = 0, greatest = 0;
    for (int i = 0; i < BINS; i++) {
        all += (double)counts[i];
        sum += (double)counts[i] * i;
    }
    for (int i = 0; i < BINS - 1; i++) {
        below += (double)counts[i];
        sum_below += (double)counts[i] * i;
        double above = all - below;
        if (below == 0 || above == 0)
            continue;
        double apart = sum_below / below - (sum - sum_below) / above;
        double between = below * above * apart * apart;
        if (between > best) {
            best = between;
            least = i + 1;
        }
        if (between == best) /* empty bins between the classes: their middle */
            greatest = i + 1;
    }
    return best < 0 ? first : first + width * (least + greatest) / 2;
}

/* ---- All of one component ---- */

static void find_range(walk *w, plr_volume_statistics *s) {
    double least = (double)INFINITY, greatest = -(double)INFINITY;
    while (next(w))
        for (size_t i = 0; i < w->length; i++) {
            double value = w->values[i];
            if (!isfinite(value)) {
                s->nan += isnan(value) != 0;
                s->infinite += isinf(value) != 0;
                continue;
            }
            s->finite++;
            least = value < least ? value : least;
            greatest = value > greatest ? value : greatest;
        }
    if (s->finite) {
        s->minimum = least + 0.0;
        s->maximum = greatest + 0.0;
    }
}

bool plr_volume_get_statistics(const plr_volume *volume, uint32_t component,
                               plr_volume_statistics *s) {
    static const double percents[PLR_PERCENTILE_COUNT] = {PLR_PERCENTILES};
    *s = (plr_volume_statistics){0};
    walk *w = malloc(sizeof *w);
    if (!w || component >= volume->components ||
        !plr_volume_get_percentiles(volume, component, percents, PLR_PERCENTILE_COUNT,
                                    s->percentiles)) {
        free(w);
        return false;
    }
    begin(w, volume, component);
    find_range(w, s);
    choose_bins(volume, s);
    begin(w, volume, component);
    /* the ends of bins between two levels, where no rounding reaches a value */
    add_to_bins(w, s->first - level_of(volume) / 2, s->width, s->counts, s->bins);
    free(w);
    return true;
}

bool plr_volume_read_statistics(plr_scene *scene, const plr_node *texture, uint32_t component,
                                plr_volume_statistics *statistics, plr_diags *diags) {
    plr_volume volume = {0};
    *statistics = (plr_volume_statistics){0};
    bool fine = plr_volume_from_node(scene, texture, &volume, diags) &&
                plr_volume_get_statistics(&volume, component, statistics);
    plr_volume_free(&volume);
    return fine;
}

/* ---- Labels ---- */

enum {
    SLOTS = 4 * PLR_MAX_LABEL_COUNTS
};

static uint32_t label_at(const plr_image *image, size_t index) {
    switch (image->type) {
    case PLR_UINT8:
        return ((const uint8_t *)image->samples)[index];
    case PLR_UINT16:
        return ((const uint16_t *)image->samples)[index];
    case PLR_UINT32:
        return ((const uint32_t *)image->samples)[index];
    default:
        return 0;
    }
}

static int ascending(const void *a, const void *b) {
    uint32_t x = ((const plr_label_count *)a)->value, y = ((const plr_label_count *)b)->value;
    return x < y ? -1 : x > y;
}

plr_label_count *plr_image_count_labels(const plr_image *image, size_t *count, bool *more) {
    plr_label_count *slots = calloc(SLOTS, sizeof *slots), *last = slots;
    size_t voxels = (size_t)image->width * image->height * image->depth;
    *count = 0;
    *more = false;
    for (size_t i = 0; slots && i < voxels; i++) {
        uint32_t value = label_at(image, i);
        if (last->value != value || !last->voxels) {
            size_t slot = value * UINT32_C(2654435761) % SLOTS;
            while (slots[slot].voxels && slots[slot].value != value)
                slot = (slot + 1) % SLOTS;
            if (!slots[slot].voxels && *count == PLR_MAX_LABEL_COUNTS) {
                *more = true;
                continue;
            }
            *count += !slots[slot].voxels;
            last = &slots[slot];
            last->value = value;
        }
        last->voxels++;
    }
    size_t kept = 0;
    for (size_t i = 0; slots && i < SLOTS; i++)
        if (slots[i].voxels)
            slots[kept++] = slots[i];
    if (slots)
        qsort(slots, kept, sizeof *slots, ascending);
    return slots;
}
