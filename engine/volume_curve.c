/* Values are cut into bins; what is greatest in a range of bins is the greater one of two
 * overlapping runs of bins whose length is a power of two. */
#include "engine/volume_curve.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum {
    MOST_BINS = 1024,
    LEVELS = 11,                /* of runs */
    ROWS = 4 + PLR_CURVE_SCALES /* see below */
};

/* The greatest of each bin, and of runs of bins. */
enum row {
    DEPTH, /* of the function, with the other sign */
    HEIGHT,
    FALL, /* of its slope, with the other sign */
    RISE,
    TURN /* and further ones: how far slopes are apart in one bin more than the number of the row */
};

struct plr_curve {
    double low, width; /* of bins */
    size_t count, levels;
    float *rows[ROWS][LEVELS];
    float numbers[];
};

static double texel(const plr_curve_desc *d, uint32_t i, int channel) {
    return (double)d->texels[4 * i + (uint32_t)channel];
}

/* The function and its slope, on the span behind texel i. */
static double value_in(const plr_curve_desc *d, uint32_t i, double value, double *slope) {
    double f = fmin(fmax(value * (d->count - 1) - i, 0), 1);
    double a = texel(d, i, d->channel), b = texel(d, i + 1, d->channel), x = (1 - f) * a + f * b;
    *slope = (b - a) * (d->count - 1);
    if (d->channel < 3)
        return x;
    *slope /= (1 - x) * d->reference;
    return -log1p(-x) / d->reference;
}

static uint32_t span_of(const plr_curve_desc *d, double value) {
    return (uint32_t)fmin(fmax(floor(value * (d->count - 1)), 0), d->count - 2.0);
}

/* Towards what is greater: numbers are kept in 32 bits. */
static float above(double x) {
    return nextafterf((float)x, INFINITY);
}

static void note(plr_curve *c, size_t bin, double value, double slope) {
    const double found[] = {-value, value, -slope, slope};
    for (size_t k = 0; k < TURN; k++)
        c->rows[k][0][bin] = fmaxf(c->rows[k][0][bin], above(found[k]));
}

/* Between two texels the function and its slope are monotonous. Ends of spans count in the bins on
 * both sides, lest rounding puts them in the wrong one. */
static void fill_span(plr_curve *c, const plr_curve_desc *d, uint32_t i, double from, double to) {
    double last = (double)(c->count - 1), slope, value;
    size_t first_bin = (size_t)fmin(fmax(floor((from - c->low) / c->width - 1e-6), 0), last);
    size_t last_bin = (size_t)fmin(fmax(floor((to - c->low) / c->width + 1e-6), 0), last);
    for (size_t bin = first_bin; bin <= last_bin; bin++) {
        double begin = fmax(from, c->low + c->width * (double)bin);
        double end = fmin(to, c->low + c->width * (double)(bin + 1));
        value = value_in(d, i, fmin(begin, to), &slope);
        note(c, bin, value, slope);
        value = value_in(d, i, fmax(end, from), &slope);
        note(c, bin, value, slope);
    }
}

static void fill_turns(plr_curve *c) {
    for (size_t bin = 0; bin < c->count; bin++) {
        float rise = c->rows[RISE][0][bin], fall = c->rows[FALL][0][bin];
        for (size_t k = 0; k < PLR_CURVE_SCALES; k++) {
            size_t other = bin + k + 1 < c->count ? bin + k + 1 : c->count - 1;
            rise = fmaxf(rise, c->rows[RISE][0][other]);
            fall = fmaxf(fall, c->rows[FALL][0][other]);
            c->rows[TURN + k][0][bin] = above((double)rise + (double)fall);
        }
    }
}

static void fill_levels(plr_curve *c) {
    for (size_t k = 0; k < ROWS; k++)
        for (size_t level = 1; level < c->levels; level++) {
            size_t run = (size_t)1 << (level - 1);
            for (size_t bin = 0; bin + 2 * run <= c->count; bin++) {
                float a = c->rows[k][level - 1][bin], b = c->rows[k][level - 1][bin + run];
                c->rows[k][level][bin] = a > b ? a : b;
            }
        }
}

plr_curve *plr_curve_make(const plr_curve_desc *d) {
    double all = d->high - d->low;
    double part = fmax(d->reach / PLR_CURVE_SCALES, all / MOST_BINS);
    size_t count = part > 0 ? (size_t)fmin(fmax(ceil(all / part), 1), MOST_BINS) : 1, levels = 1;
    while ((size_t)1 << levels <= count)
        levels++;
    plr_curve *c = malloc(sizeof *c + ROWS * levels * count * sizeof *c->numbers);
    if (!c)
        return NULL;
    c->low = d->low;
    c->width = all > 0 ? all / (double)count : 1;
    c->count = count;
    c->levels = levels;
    for (size_t k = 0; k < ROWS; k++)
        for (size_t level = 0; level < levels; level++)
            c->rows[k][level] = c->numbers + (k * levels + level) * count;
    for (size_t k = 0; k < TURN; k++)
        for (size_t bin = 0; bin < count; bin++)
            c->rows[k][0][bin] = -INFINITY;
    for (uint32_t i = span_of(d, d->low); i <= span_of(d, d->high); i++)
        fill_span(c, d, i, fmax(d->low, (double)i / (d->count - 1)),
                  fmin(d->high, (i + 1.0) / (d->count - 1)));
    fill_turns(c);
    fill_levels(c);
    return c;
}

void plr_curve_free(plr_curve *curve) {
    free(curve);
}

/* Bins, both included; values on the line between two are in both. */
typedef struct range {
    size_t first, last;
} range;

static range bins_of(const plr_curve *c, double low, double high) {
    double last = (double)(c->count - 1);
    return (range){(size_t)fmin(fmax(floor((low - c->low) / c->width - 1e-6), 0), last),
                   (size_t)fmin(fmax(floor((high - c->low) / c->width + 1e-6), 0), last)};
}

static double most_of(const plr_curve *c, size_t row, range r) {
    size_t count = r.last - r.first + 1, level = 0;
    while ((size_t)2 << level <= count)
        level++;
    float a = c->rows[row][level][r.first];
    float b = c->rows[row][level][r.last + 1 - ((size_t)1 << level)];
    return (double)(a > b ? a : b);
}

plr_curve_part plr_curve_between(const plr_curve *c, double low, double high) {
    range r = bins_of(c, low, high);
    double rise = most_of(c, RISE, r), fall = most_of(c, FALL, r);
    return (plr_curve_part){.low = -most_of(c, DEPTH, r),
                            .high = most_of(c, HEIGHT, r),
                            .steepest = fmax(rise, fall),
                            .turns = rise + fall};
}

double plr_curve_bend(const plr_curve *c, double low, double high, double reach) {
    range r = bins_of(c, low, high);
    double x = 0, end = fmin(reach, high - low), sum = 0;
    double all = most_of(c, RISE, r) + most_of(c, FALL, r);
    for (size_t k = 0; x < end; k++) {
        /* values up to k + 1 bins apart lie in k + 2 bins */
        bool narrow = k < PLR_CURVE_SCALES && r.last - r.first > k;
        double to = narrow ? fmin(end, (double)(k + 1) * c->width) : end;
        double turns = narrow ? most_of(c, TURN + k, (range){r.first, r.last - k - 1}) : all;
        sum += turns * ((reach - x) * (reach - x) - (reach - to) * (reach - to)) / 2;
        x = to;
    }
    return sum;
}
