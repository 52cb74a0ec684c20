/* Bounds for the midpoint rule along rays through trilinear values and a transfer function that is
 * linear from texel to texel.
 *
 * In a step of length h around the place of a sample m the value s differs from s(m) by at most S
 * |x|, S the greatest slope. A function f of the value with the slope f' is f(m) + f'(m) (s - m) +
 * r, where r is at most the integral, from s(m) to s, of how much f' varies on the way: R(|s -
 * s(m)|). Hence
 *
 *   |integral of f - h f(m)| <= L |integral of s - s(m)| + (2 / S) integral of R from 0 to S h / 2,
 *
 * L the greatest |f'|. The integral of s - s(m) is at most h^3/24 times the second derivative
 * within cells, and h^2/8 times the jump of the slope at each face of a cell (Peano's kernel of the
 * midpoint rule). That holds for extinction, of which an error accumulates along the ray as far as
 * anything shines through, and for colours. Colours are weighted by what is seen of each place:
 * where that changes within a step, as extinction does and as the step hides itself, its odd part
 * counts, too. */
#include "engine/volume_certain.h"

#include <math.h>
#include <string.h>

enum {
    SCALES = 8,      /* into so many parts the way from m is cut */
    MOST_BINS = 4096 /* of values */
};

/* A function of the value: extinction, or a channel of colour. */
typedef struct curve {
    double steepest;       /* L */
    double low, high;      /* of its values */
    double part;           /* values, the length of a part */
    double varies[SCALES]; /* how much its slope varies at most over so many parts */
} curve;

/* Which function of a volume's values. */
typedef struct place {
    const plr_certain *v;
    int channel; /* 3: extinction */
} place;

static double texel(const plr_certain *v, uint32_t i, int channel) {
    return (double)v->texels[4 * i + (uint32_t)channel];
}

static double channel_in(const plr_certain *v, uint32_t i, double value, int channel) {
    double f = value * (v->texel_count - 1) - i;
    f = fmin(fmax(f, 0), 1);
    return (1 - f) * texel(v, i, channel) + f * texel(v, i + 1, channel);
}

/* The function and its slope, on the span behind texel i. Opacities are below 1. */
static double value_in(place p, uint32_t i, double value, double *slope) {
    double x = channel_in(p.v, i, value, p.channel);
    double rise =
        (texel(p.v, i + 1, p.channel) - texel(p.v, i, p.channel)) * (p.v->texel_count - 1);
    if (p.channel < 3) {
        *slope = rise;
        return x;
    }
    *slope = rise / (1 - x) / p.v->reference;
    return -log1p(-x) / p.v->reference;
}

static uint32_t span_of(const plr_certain *v, double value) {
    double last = v->texel_count - 2.0;
    return (uint32_t)fmin(fmax(floor(value * (v->texel_count - 1)), 0), last);
}

static void note(curve *c, double value, double slope) {
    c->low = fmin(c->low, value);
    c->high = fmax(c->high, value);
    c->steepest = fmax(c->steepest, fabs(slope));
}

/* How much the slope varies in each bin of values; that at a texel counts in the bin in which it
 * lies. The slope is monotonous from texel to texel. */
static void fill_bins(place p, curve *c, double *bins, size_t count) {
    double low = p.v->bends->low, width = (p.v->bends->high - low) / (double)count, slope,
           before = 0;
    for (uint32_t i = span_of(p.v, low); i <= span_of(p.v, p.v->bends->high); i++) {
        double from = fmax(low, (double)i / (p.v->texel_count - 1));
        double to = fmin(p.v->bends->high, (i + 1.0) / (p.v->texel_count - 1));
        note(c, value_in(p, i, from, &slope), slope);
        size_t bin = (size_t)fmin(fmax(floor((from - low) / width), 0), (double)count - 1);
        if (from > low)
            bins[bin] += fabs(slope - before);
        before = slope;
        while (from < to) {
            double end = bin + 1 < count ? fmin(to, low + width * (double)(bin + 1)) : to;
            note(c, value_in(p, i, end, &slope), slope);
            bins[bin] += fabs(slope - before);
            before = slope;
            bin += end < to;
            from = fmax(end, nextafter(from, 2));
        }
    }
}

/* Values between the least and the greatest; a sample's differ by at most `reach` within its step.
 */
static curve look(place p, double reach, double *bins) {
    double low = p.v->bends->low, high = p.v->bends->high, slope;
    curve c = {.low = INFINITY, .high = -INFINITY};
    note(&c, value_in(p, span_of(p.v, low), low, &slope), 0);
    if (!(high > low))
        return c;
    c.part = fmax(reach / SCALES, (high - low) / MOST_BINS);
    size_t count = (size_t)ceil((high - low) / c.part);
    memset(bins, 0, count * sizeof *bins);
    fill_bins(p, &c, bins, count);
    for (size_t n = 0; n < SCALES; n++) {
        /* so many parts reach into one bin more */
        double sum = 0;
        for (size_t i = 0; i < count; i++) {
            sum += bins[i];
            sum -= i >= n + 2 ? bins[i - n - 2] : 0;
            c.varies[n] = fmax(c.varies[n], sum);
        }
    }
    return c;
}

/* 2 / S times the integral of R from 0 to S h / 2; values differ by no more than `reach`. */
static double bend_of(const curve *c, double slope, double step, double reach) {
    double x = 0, r = 0, sum = 0;
    for (int n = 0; n < SCALES && x < reach; n++) {
        double way = fmin(c->part, reach - x);
        sum += way * (r + way * c->varies[n] / 2);
        r += way * c->varies[n];
        x += way;
    }
    sum += fmax(slope * step / 2 - x, 0) * r;
    return slope > 0 ? 2 * sum / slope : 0;
}

/* ---- Along rays ---- */

/* How fast the value changes along any ray, per unit of length. */
typedef struct speed {
    double slope;  /* S */
    double second; /* derivative, within cells */
    double jumps;  /* of the slope, of all faces that a ray crosses */
} speed;

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static speed speed_of(const plr_certain *v) {
    double slope[3], jump[3], twist[3];
    for (int i = 0; i < 3; i++) {
        slope[i] = v->bends->slope[i] / v->voxel[i];
        jump[i] = v->bends->jump[i] / v->voxel[i];
        twist[i] = v->bends->twist[i] / (v->voxel[(i + 1) % 3] * v->voxel[(i + 2) % 3]);
    }
    /* the norm of a symmetric matrix without a diagonal bounds what it makes of a direction */
    return (speed){length_of(slope), sqrt(2) * length_of(twist), length_of(jump)};
}

/* What is known of a volume for steps of some length. */
typedef struct account {
    double optical;   /* errors of optical depth, as far as they are seen */
    double hidden;    /* the same where they change how much of what lies behind is seen */
    double color;     /* of colours */
    double most;      /* extinction */
    double colors[2]; /* least and greatest */
    double odd; /* of extinction: what a step's own change of transparency makes of its slope */
    double seen_length;
} account;

/* So far drivers round values. */
#define ROUNDED 1e-5
/* What differs from the middle of a step by at most A |x| and a, and by at most B |x| and b: the
 * mean of the product is at most that of straight lines so many times a and b high at a step's
 * ends, or lower ones. */
#define CAPPED 3.5

static void add_optical(account *a, const curve *tau, const speed *s, double step, double reach,
                        double longest) {
    double seen = fmin(longest, 1 / fmax(tau->low, 1e-30));
    double shadow = fmin(longest, 1 / (2.718281828 * fmax(tau->low, 1e-30)));
    double rate = tau->steepest * (s->second * step * step / 24 + ROUNDED) +
                  bend_of(tau, s->slope, step, reach) / step;
    double jumps = tau->steepest * step * step / 8 * s->jumps, whole = tau->high - tau->low;
    /* or else it is as wrong as it can be */
    bool vague = rate * seen + jumps > whole * seen;
    a->optical = vague ? whole * seen : rate * seen + jumps;
    a->hidden = vague ? whole * shadow : rate * shadow + jumps;
    a->seen_length = seen;
    a->most = tau->high;
    a->odd = fmin(tau->steepest * s->slope, CAPPED * whole / step);
}

/* `most`: extinction of all that may be in one place. */
static void add_color(account *a, const curve *c, const speed *s, double step, double reach,
                      double longest, double most) {
    double whole = c->high - c->low, rise = fmin(c->steepest * s->slope, CAPPED * whole / step),
           up = a->most;
    double through = a->seen_length + step, depth = up * fmin(longest, through);
    double even = (c->steepest * (s->second * step * step / 24 + ROUNDED) +
                   bend_of(c, s->slope, step, reach) / step) *
                  fmin(1, depth);
    double jumps = c->steepest * step * step / 8 * s->jumps * up;
    double odd =
        rise * step * step / 12 * (a->odd * through + most * fmin(1 + most * step, up * through));
    double blunt = fmin(c->steepest * reach, whole) * fmin(1, up * longest);
    a->color = fmax(a->color, fmin(even + jumps + odd, blunt));
    a->colors[0] = fmin(a->colors[0], c->low);
    a->colors[1] = fmax(a->colors[1], c->high);
}

/* Whether any value, or each, is opaque. */
static bool is_opaque(const plr_certain *v, bool each) {
    bool any = false, all = true;
    uint32_t last = span_of(v, v->bends->high);
    for (uint32_t i = span_of(v, v->bends->low); i <= last + 1; i++) {
        any = any || texel(v, i, 3) >= 1;
        all = all && texel(v, i, 3) >= 1;
    }
    return each ? all : any;
}

static bool find_account(const plr_certain *v, double step, double most, double *bins, account *a) {
    speed s = speed_of(v);
    double reach = fmin(s.slope * step / 2, v->bends->high - v->bends->low);
    *a = (account){.colors = {INFINITY, -INFINITY}};
    bool wall = is_opaque(v, true);
    if (!wall) {
        if (is_opaque(v, false))
            return false;
        curve tau = look((place){v, 3}, reach, bins);
        add_optical(a, &tau, &s, step, reach, v->longest);
    }
    for (int channel = 0; channel < 3; channel++) {
        curve c = look((place){v, channel}, reach, bins);
        if (!wall) {
            add_color(a, &c, &s, step, reach, v->longest, most);
            continue;
        }
        /* the first sample is all that is seen */
        a->color = fmax(a->color, fmin(c.steepest * reach, c.high - c.low));
        a->colors[0] = fmin(a->colors[0], c.low);
        a->colors[1] = fmax(a->colors[1], c.high);
    }
    return true;
}

/* The greatest extinction of a volume, if it is not opaque. */
static double densest(const plr_certain *v) {
    double most = 0;
    uint32_t last = span_of(v, v->bends->high);
    for (uint32_t i = span_of(v, v->bends->low); i <= last + 1; i++)
        if (texel(v, i, 3) < 1)
            most = fmax(most, -log1p(-texel(v, i, 3)) / v->reference);
    return most;
}

double plr_certain_error(const plr_certain *volumes, size_t count, const double *steps) {
    double bins[MOST_BINS + 1];
    double most = 0, optical = 0, hidden = 0, color = 0, mixing = 0,
           colors[2] = {INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        most += densest(&volumes[i]);
    for (size_t i = 0; i < count; i++) {
        const plr_certain *v = &volumes[i];
        account a;
        /* beyond, values are cut off, which bends them */
        if (!(v->bends->low >= 0 && v->bends->high <= 1) ||
            !find_account(v, steps[i], most, bins, &a))
            return INFINITY;
        optical += a.optical;
        hidden += a.hidden;
        color += a.color;
        /* of several in one place each is seen through all */
        mixing +=
            count > 1 ? a.odd * most * steps[i] * steps[i] / 12 * (a.seen_length + steps[i]) : 0;
        colors[0] = fmin(colors[0], a.colors[0]);
        colors[1] = fmax(colors[1], a.colors[1]);
    }
    double seen = (colors[0] + colors[1]) / 2 * hidden +
                  (colors[1] - colors[0]) * (optical + mixing / 2) + color;
    double error = fmax(hidden, seen);
    /* terms of the second order of these */
    return error < 0.1 ? error * exp(2 * (optical + mixing)) : INFINITY;
}
