/* Transfer functions as intervals between knots, in which all channels are linear. */
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double OUTSIDE = 1; /* how far the first and the last colour reach beyond 0 and 1 */
static const double STRAIGHT = 1e-14;

static double clamped(double x) {
    return x > 0 ? x < 1 ? x : 1 : 0;
}

static ref_interval between(const double from[4], const double to[4], double value, double next) {
    ref_interval made = {.from = value, .to = next};
    bool falls = from[3] >= to[3];
    made.anchor = falls ? value : next;
    made.is_clear = from[3] <= 0 && to[3] <= 0;
    made.is_opaque = from[3] >= 1 && to[3] >= 1;
    for (int i = 0; i < 4; i++) {
        made.base[i] = made.is_clear ? 0 : falls ? from[i] : to[i];
        made.slope[i] = made.is_clear ? 0 : (to[i] - from[i]) / (next - value);
    }
    made.clearness = 1 - made.base[3];
    return made;
}

static double channel(const ref_interval *interval, int i, double value) {
    return interval->base[i] + interval->slope[i] * (value - interval->anchor);
}

double ref_interval_alpha(const ref_interval *interval, double value) {
    return channel(interval, 3, value);
}

/* Whether two neighbours are one straight line. */
static bool is_straight(const ref_interval *a, const ref_interval *b) {
    if (a->is_clear || b->is_clear)
        return a->is_clear && b->is_clear;
    for (int i = 0; i < 4; i++)
        if (fabs(channel(a, i, b->from) - channel(b, i, b->from)) > STRAIGHT ||
            fabs(channel(a, i, b->to) - channel(b, i, b->to)) > STRAIGHT)
            return false;
    return true;
}

static void add(ref_transfer *transfer, const double from[4], const double to[4], double value,
                double next) {
    if (!(next > value))
        return;
    ref_interval made = between(from, to, value, next);
    ref_interval *last = transfer->count ? &transfer->intervals[transfer->count - 1] : NULL;
    if (last && is_straight(last, &made)) {
        double first[4];
        for (int i = 0; i < 4; i++)
            first[i] = clamped(channel(last, i, last->from));
        *last = between(first, to, last->from, next);
        return;
    }
    transfer->intervals[transfer->count++] = made;
}

/* One straight part, cut where a channel leaves 0 to 1. */
static void add_clamped(ref_transfer *transfer, const double from[4], const double to[4],
                        double value, double next) {
    double cuts[10] = {0};
    int count = 1;
    for (int i = 0; i < 4; i++)
        for (int limit = 0; limit < 2; limit++)
            if ((from[i] < limit) != (to[i] < limit) && from[i] != limit && to[i] != limit)
                cuts[count++] = (limit - from[i]) / (to[i] - from[i]);
    cuts[count++] = 1;
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && cuts[j] < cuts[j - 1]; j--) {
            double larger = cuts[j - 1];
            cuts[j - 1] = cuts[j];
            cuts[j] = larger;
        }
    double ends[2][4];
    for (int i = 0; i < 4; i++)
        ends[0][i] = clamped(from[i]);
    double at = value;
    for (int k = 1; k < count; k++) {
        double stop = k == count - 1 ? next : value + cuts[k] * (next - value);
        for (int i = 0; i < 4; i++) {
            double here = k == count - 1 ? to[i] : from[i] + cuts[k] * (to[i] - from[i]);
            /* what was cut at 0 or 1 lies there exactly */
            if (fabs(here) < 1e-15)
                here = 0;
            if (fabs(here - 1) < 1e-15)
                here = 1;
            ends[1][i] = clamped(here);
        }
        add(transfer, ends[0], ends[1], at, stop);
        memcpy(ends[0], ends[1], sizeof ends[0]);
        at = stop > at ? stop : at;
    }
}

bool ref_transfer_make(ref_transfer *transfer, const ref_point *points, size_t count,
                       double opacity, const double tint[3]) {
    *transfer = (ref_transfer){0};
    if (!count || count > 10000000)
        return false;
    /* at most 9 parts of each, and what lies outside */
    transfer->intervals = calloc(9 * (count + 2), sizeof *transfer->intervals);
    double factor[4] = {tint[0], tint[1], tint[2], opacity};
    double last[4] = {0}, value = -OUTSIDE;
    if (!transfer->intervals)
        return false;
    for (size_t k = 0; k <= count; k++) {
        double here[4], next = k < count ? points[k].value : 1 + OUTSIDE;
        for (int i = 0; i < 4; i++)
            here[i] = k < count ? points[k].color[i] * factor[i] : last[i];
        if (next < value)
            return false;
        if (k == 0)
            memcpy(last, here, sizeof last);
        add_clamped(transfer, last, here, value, next);
        memcpy(last, here, sizeof last);
        value = next;
    }
    transfer->seen_before = calloc((size_t)transfer->count + 1, sizeof *transfer->seen_before);
    if (!transfer->seen_before)
        return false;
    for (int i = 0; i < transfer->count; i++) {
        transfer->may_be_opaque |= transfer->intervals[i].clearness <= 1e-15;
        transfer->seen_before[i + 1] = transfer->seen_before[i] + !transfer->intervals[i].is_clear;
    }
    return true;
}

bool ref_transfer_texels(ref_transfer *transfer, const double (*texels)[4], size_t count,
                         double opacity, const double tint[3]) {
    *transfer = (ref_transfer){0};
    ref_point *points = calloc(count + 1, sizeof *points);
    if (!points || !count) {
        free(points);
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        points[i].value = count > 1 ? (double)i / (double)(count - 1) : 0;
        memcpy(points[i].color, texels[i], sizeof points[i].color);
    }
    bool fine = ref_transfer_make(transfer, points, count, opacity, tint);
    free(points);
    return fine;
}

void ref_transfer_free(ref_transfer *transfer) {
    free(transfer->intervals);
    free(transfer->seen_before);
}

int ref_transfer_find(const ref_transfer *transfer, double value) {
    int from = 0, to = transfer->count - 1;
    while (from < to) {
        int middle = (from + to + 1) / 2;
        if (transfer->intervals[middle].from <= value)
            from = middle;
        else
            to = middle - 1;
    }
    return from;
}

bool ref_transfer_clear(const ref_transfer *transfer, double least, double greatest) {
    int from = ref_transfer_find(transfer, least), to = ref_transfer_find(transfer, greatest);
    return transfer->seen_before[to + 1] == transfer->seen_before[from];
}
