/* Light on volumes: what it makes of a colour, and where that is not smooth. */
#include "walk.h"

#include <math.h>
#include <string.h>

static double power(double x, double exponent) {
    int whole = (int)fmin(fabs(exponent), 1000);
    if (whole != exponent)
        return pow(x, exponent);
    double result = 1;
    for (; whole; whole /= 2, x *= x)
        result *= whole % 2 ? x : 1;
    return result;
}

/* ambient c + diffuse |n.l| c + specular |n.h|^power; light and viewer are in one place, h = l. */
void ref_light(const ref_walk *walk, double t, double color[3]) {
    const ref_shading *shading = &walk->volume->shading;
    double length = 0, facing = 0;
    for (int k = 0; k < 3; k++) {
        double n = ref_cubic_at(walk->gradient[k], t - walk->base);
        length += n * n;
        facing += n * walk->to_light[k];
    }
    facing = length > 0 ? fmin(fabs(facing) / sqrt(length), 1) : 0;
    double shine = facing > 0 ? shading->specular * power(facing, shading->power) : 0;
    for (int k = 0; k < 3; k++)
        color[k] = (shading->ambient + shading->diffuse * facing) * color[k] + shine;
}

/* Where light passes from one side of the surface to the other. */
static void add_terminator(ref_sum *sum, const ref_walk *walk, double from, double to) {
    double facing[4], ends[4] = {from}, turns[2] = {0};
    for (int i = 0; i < 4; i++)
        facing[i] = walk->gradient[0][i] * walk->to_light[0] +
                    walk->gradient[1][i] * walk->to_light[1] +
                    walk->gradient[2][i] * walk->to_light[2];
    int count = ref_cubic_turns(facing, from, to, turns);
    memcpy(ends + 1, turns, sizeof turns);
    ends[count + 1] = to;
    for (int i = 0; i <= count; i++) {
        double a = ref_cubic_at(facing, ends[i]), b = ref_cubic_at(facing, ends[i + 1]);
        if ((a < 0) != (b < 0))
            ref_sum_cut(sum, ref_cubic_root(facing, 0, ends[i], ends[i + 1]) + walk->base, NULL,
                        NULL);
    }
}

/* The square of the gradient at u, and half its growth, and the square of how fast the gradient
 * itself changes. */
static void gradient_at(const ref_walk *walk, double u, double found[3]) {
    memset(found, 0, 3 * sizeof *found);
    for (int k = 0; k < 3; k++) {
        const double *c = walk->gradient[k];
        double g = ref_cubic_at(c, u), change = c[1] + u * (2 * c[2] + u * 3 * c[3]);
        found[0] += g * g;
        found[1] += g * change;
        found[2] += change * change;
    }
}

/* Where the gradient is small, normals turn fast: within a length of |g| / |g'|. Around such a
 * place pieces grow from that length on. */
static void add_turn(ref_sum *sum, const ref_walk *walk, double from, double to, double at) {
    double found[3];
    gradient_at(walk, at, found);
    if (!(found[2] > 0))
        return;
    double length = sqrt(found[0] / found[2]);
    if (length > 0.5 * (to - from))
        return;
    if (at > from && at < to)
        ref_sum_cut(sum, at + walk->base, NULL, NULL);
    for (length = fmax(length, 1e-12 * (to - from)); length < to - from; length *= 6) {
        if (at - length > from)
            ref_sum_cut(sum, at - length + walk->base, NULL, NULL);
        if (at + length < to)
            ref_sum_cut(sum, at + length + walk->base, NULL, NULL);
    }
}

static void add_turns(ref_sum *sum, const ref_walk *walk, double from, double to) {
    enum {
        PARTS = 8
    };
    double before[3], here[3];
    gradient_at(walk, from, before);
    if (before[1] >= 0)
        add_turn(sum, walk, from, to, from);
    for (int i = 0; i < PARTS; i++) {
        double low = from + (to - from) * i / PARTS, high = from + (to - from) * (i + 1) / PARTS;
        gradient_at(walk, high, here);
        bool turns = before[1] < 0 && here[1] >= 0;
        memcpy(before, here, sizeof before);
        for (int k = 0; turns && k < 60; k++) {
            double middle = 0.5 * (low + high);
            gradient_at(walk, middle, here);
            *(here[1] < 0 ? &low : &high) = middle;
        }
        if (turns)
            add_turn(sum, walk, from, to, high);
    }
    if (before[1] < 0)
        add_turn(sum, walk, from, to, to);
}

void ref_light_cuts(ref_sum *sum, const ref_walk *walk, double from, double to) {
    add_terminator(sum, walk, from - walk->base, to - walk->base);
    add_turns(sum, walk, from - walk->base, to - walk->base);
}

/* How far a channel is above 1. */
static double above(const ref_walk *walk, double t, int channel) {
    double color[3];
    ref_interval_color(walk->interval, ref_walk_value(walk, t), color);
    ref_light(walk, t, color);
    return color[channel] - 1;
}

int ref_light_limits(const ref_walk *walk, double from, double to, double *cuts, int most) {
    enum {
        PARTS = 8
    };
    const ref_shading *shading = &walk->volume->shading;
    int count = 0;
    if (!shading->used || shading->unclamped || walk->interval->is_clear)
        return 0;
    for (int channel = 0; channel < 3; channel++) {
        double before = above(walk, from, channel);
        for (int i = 0; i < PARTS && count < most; i++) {
            double low = from + (to - from) * i / PARTS;
            double high = from + (to - from) * (i + 1) / PARTS;
            double here = above(walk, high, channel);
            bool crossed = (before > 0) != (here > 0), was_above = before > 0;
            before = here;
            for (int k = 0; crossed && k < 50; k++) {
                double middle = 0.5 * (low + high);
                *((above(walk, middle, channel) > 0) == was_above ? &low : &high) = middle;
            }
            if (crossed)
                cuts[count++] = high;
        }
    }
    return count;
}
