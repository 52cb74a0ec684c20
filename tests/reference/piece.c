/* Between two faces of cells: cut at the knots of transfer functions, ended where something is
 * opaque. */
#include "walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far rounding may keep a value from one that is opaque; and what is too near to be sure. */
static const double OPAQUE = 1e-13;
static const double UNCERTAIN = 1e-10;

void ref_sum_cut(ref_sum *sum, double t, const ref_walk *walk, const ref_interval *interval) {
    if (sum->cut_count == sum->cut_room) {
        size_t room = sum->cut_room ? 2 * sum->cut_room : 64;
        ref_cut *cuts = realloc(sum->cuts, room * sizeof *cuts);
        if (!cuts) {
            sum->is_out_of_memory = true;
            return;
        }
        sum->cuts = cuts;
        sum->cut_room = room;
    }
    sum->cuts[sum->cut_count++] = (ref_cut){t, walk, interval};
}

/* The knots that a volume's value passes, and where it turns. */
static void add_cuts(ref_sum *sum, const ref_walk *walk, double from, double to) {
    double ends[4] = {from - walk->base}, turns[2] = {0};
    int count = ref_cubic_turns(walk->value, from - walk->base, to - walk->base, turns);
    for (int i = 0; i < count; i++) {
        ends[i + 1] = turns[i];
        if (walk->transfer->may_be_opaque)
            ref_sum_cut(sum, turns[i] + walk->base, NULL, NULL);
    }
    ends[count + 1] = to - walk->base;
    for (int i = 0; i <= count; i++) {
        double a = ref_cubic_at(walk->value, ends[i]), b = ref_cubic_at(walk->value, ends[i + 1]);
        int first = ref_transfer_find(walk->transfer, fmin(a, b)) + 1;
        for (int k = first; k < walk->transfer->count; k++) {
            const ref_interval *interval = &walk->transfer->intervals[k];
            if (interval->from >= fmax(a, b))
                break;
            if (interval->from <= fmin(a, b))
                continue;
            double u = ref_cubic_root(walk->value, interval->from, ends[i], ends[i + 1]);
            ref_sum_cut(sum, u + walk->base, walk, interval);
        }
    }
}

static int earlier(const void *a, const void *b) {
    double x = ((const ref_cut *)a)->t, y = ((const ref_cut *)b)->t;
    return (x > y) - (x < y);
}

/* How far the value of a volume at t is from one that is opaque, in the interval that it lies in,
 * at a knot of its own in the less clear one of two. Sets that interval. */
static double away_from_opaque(ref_walk *walk, double t, const ref_cut *cut) {
    double value = ref_walk_value(walk, t);
    const ref_interval *interval =
        &walk->transfer->intervals[ref_transfer_find(walk->transfer, value)];
    if (cut && cut->walk == walk) {
        value = cut->interval->from;
        interval = cut->interval;
        if (interval > walk->transfer->intervals &&
            ref_interval_alpha(interval - 1, value) > ref_interval_alpha(interval, value))
            interval--;
    }
    walk->interval = interval;
    if (interval->is_opaque)
        return 0;
    return interval->clearness <= 1e-15 ? fabs(value - interval->anchor) : INFINITY;
}

/* Whether the ray ends at t, in a value that is opaque; not where it enters or leaves a volume,
 * which has no length. If rounding alone may have kept it from that, what the pixel would be is
 * noted, the first time: that is where most shines through. So it is where a label begins, or ends
 * (`last`: t is the end of the piece), in a value that is opaque in it. */
static bool ends_at(ref_sum *sum, double t, const ref_cut *cut, bool last) {
    double color[3] = {0}, least = INFINITY;
    int count = 0;
    for (int w = 0; w < sum->count; w++) {
        ref_walk *walk = sum->walks[w];
        if (last && !walk->volume->labels.data)
            continue;
        double away = ref_walk_inside(walk, t) ? away_from_opaque(walk, t, cut) : INFINITY;
        if (last || t <= walk->label_from)
            away = fmax(away, 2 * OPAQUE);
        least = fmin(least, away);
        if (away > UNCERTAIN)
            continue;
        double here[3];
        ref_walk_color(walk, t, ref_walk_value(walk, t), here);
        for (int k = 0; k < 3; k++)
            color[k] += here[k];
        count++;
    }
    if (!count)
        return false;
    double through = exp(-sum->depth);
    for (int k = 0; k < 3; k++)
        color[k] = sum->color[k] + through * color[k] / count;
    if (least <= OPAQUE) {
        memcpy(sum->color, color, sizeof sum->color);
        sum->depth = INFINITY;
        sum->is_ended = true;
    } else if (!sum->may_end) {
        memcpy(sum->may_color, color, sizeof color);
        sum->may_end = true;
    }
    return sum->is_ended;
}

/* Whether a whole piece is opaque, by its middle: also one of one value that is opaque alone. */
static bool is_opaque(const ref_walk *walk, double middle) {
    const ref_interval *i = walk->interval;
    return i->is_opaque ||
           (i->clearness <= 1e-15 && fabs(ref_walk_value(walk, middle) - i->anchor) <= OPAQUE);
}

/* Sets the intervals of all volumes for a piece. Returns whether something is seen, `opaque`: and
 * nothing behind. */
static bool choose(ref_sum *sum, double t, bool *opaque) {
    bool seen = false;
    *opaque = false;
    for (int w = 0; w < sum->count; w++) {
        ref_walk *walk = sum->walks[w];
        int k = ref_transfer_find(walk->transfer, ref_walk_value(walk, t));
        walk->interval = &walk->transfer->intervals[k];
        seen = seen || !walk->interval->is_clear;
        *opaque = *opaque || (is_opaque(walk, t) && ref_walk_inside(walk, t));
    }
    return seen;
}

/* The mean colour of what is opaque in a piece that begins at t. */
static void end(ref_sum *sum, double t, double middle) {
    double through = exp(-sum->depth);
    int count = 0;
    for (int w = 0; w < sum->count; w++)
        count += is_opaque(sum->walks[w], middle);
    for (int w = 0; w < sum->count; w++) {
        const ref_walk *walk = sum->walks[w];
        double color[3];
        if (!is_opaque(walk, middle))
            continue;
        ref_walk_color(walk, t, ref_walk_value(walk, t), color);
        for (int k = 0; k < 3; k++)
            sum->color[k] += through * color[k] / count;
    }
    sum->depth = INFINITY;
    sum->is_ended = true;
}

/* One piece, cut once more where light makes a colour as bright as can be. */
static void integrate(ref_sum *sum, double from, double to) {
    enum {
        MOST = 64
    };
    double cuts[MOST + 1];
    int count = 0;
    for (int w = 0; w < sum->count; w++)
        count += ref_light_limits(sum->walks[w], from, to, cuts + count, MOST - count);
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && cuts[j] < cuts[j - 1]; j--) {
            double larger = cuts[j - 1];
            cuts[j - 1] = cuts[j];
            cuts[j] = larger;
        }
    cuts[count] = to;
    for (int i = 0; i <= count; from = cuts[i++])
        if (cuts[i] > from)
            ref_sum_integrate(sum, from, cuts[i]);
}

void ref_sum_add(ref_sum *sum, double from, double to) {
    sum->cut_count = 0;
    for (int w = 0; w < sum->count; w++) {
        add_cuts(sum, sum->walks[w], from, to);
        if (sum->walks[w]->volume->shading.used)
            ref_light_cuts(sum, sum->walks[w], from, to);
    }
    if (sum->cut_count > 1)
        qsort(sum->cuts, sum->cut_count, sizeof *sum->cuts, earlier);
    double at = from;
    for (size_t i = 0; i <= sum->cut_count; i++) {
        const ref_cut *before = i ? &sum->cuts[i - 1] : NULL;
        if (!sum->scene->touches_pass && ends_at(sum, at, before, false))
            return;
        double next = i < sum->cut_count ? sum->cuts[i].t : to;
        bool opaque;
        if (!(next > at))
            continue;
        if (choose(sum, 0.5 * (at + next), &opaque)) {
            if (opaque) {
                end(sum, at, 0.5 * (at + next));
                return;
            }
            integrate(sum, at, next);
        }
        at = next;
    }
    if (!sum->scene->touches_pass)
        ends_at(sum, to, NULL, true);
}
