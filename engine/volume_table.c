#include "engine/volume_table.h"

#include <math.h>
#include <stdlib.h>

enum {
    FEWEST_NODES = 385,
    MOST_NODES = 1025,
    FEWEST_SUMS = 2049,
    MOST_SUMS = 8192
};

/* The function between two texels. */
typedef struct span {
    double from[4], to[4];
} span;

static void at_value(const float *texels, uint32_t count, double value, double color[4]) {
    double place = value * (count - 1);
    uint32_t i = place >= count - 1 ? count - 2 : (uint32_t)place;
    double f = place - i;
    for (int c = 0; c < 4; c++)
        color[c] = (1 - f) * (double)texels[4 * i + (uint32_t)c] +
                   f * (double)texels[4 * (i + 1) + (uint32_t)c];
    for (int c = 0; c < 4; c++)
        color[c] = color[c] > 0 ? fmin(color[c], 1) : 0;
}

static double extinction(double alpha) {
    return alpha < 1 ? fmin(-log1p(-alpha), PLR_MOST_DEPTH) : PLR_MOST_DEPTH;
}

/* Adds the integrals over a span of values along which opacity and colour are linear. Extinction
 * -ln(1 - a) has an integral in closed form; where that cancels, and for colours, five points of
 * Gauss and Legendre: Abramowitz and Stegun 25.4.29. */
static void add_span(const span *s, double width, double *depth, double color[3]) {
    static const double place[5] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                    0.953089922969332};
    static const double weight[5] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                     0.239314335249683, 0.118463442528095};
    double sum = 0, sums[3] = {0, 0, 0};
    for (int k = 0; k < 5; k++) {
        double f = place[k];
        double tau = weight[k] * extinction(s->from[3] + f * (s->to[3] - s->from[3]));
        sum += tau;
        for (int c = 0; c < 3; c++)
            sums[c] += tau * (s->from[c] + f * (s->to[c] - s->from[c]));
    }
    double p = 1 - s->from[3], q = 1 - s->to[3], exact = sum;
    if (fabs(p - q) > 1e-3) /* integral of -ln x over x from q to p, divided by p - q */
        exact = ((p - (p > 0 ? p * log(p) : 0)) - (q - (q > 0 ? q * log(q) : 0))) / (p - q);
    *depth += width * exact;
    for (int c = 0; c < 3; c++)
        color[c] += sum > 0 ? width * exact * sums[c] / sum : 0;
}

/* The integrals from node to node; texels are cut apart, where nodes do not lie on them. */
static void integrate(plr_table *t, const float *texels, uint32_t count) {
    for (uint32_t i = 0; i + 1 < t->nodes; i++) {
        double low = (double)i / (t->nodes - 1), high = (double)(i + 1) / (t->nodes - 1);
        double depth = 0, color[3] = {0, 0, 0}, from = low;
        uint32_t texel = (uint32_t)floor(low * (count - 1) + 1e-9);
        bool seen = false;
        while (from < high) {
            double to = fmin(high, (double)++texel / (count - 1));
            if (to - from > 1e-12) {
                span s;
                at_value(texels, count, from, s.from);
                at_value(texels, count, to, s.to);
                seen = seen || s.from[3] > 0 || s.to[3] > 0;
                add_span(&s, to - from, &depth, color);
            }
            from = to;
        }
        t->depth[i + 1] = t->depth[i] + depth;
        t->visible[i + 1] = t->visible[i] + seen;
        for (int c = 0; c < 3; c++)
            t->color[i + 1][c] = t->color[i][c] + color[c];
    }
}

/* Which values are opaque. */
static void find_wall(plr_table *t, const float *texels, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        bool opaque = texels[4 * i + 3] >= 1, before = i > 0 && texels[4 * i - 1] >= 1;
        if (!opaque)
            continue;
        t->walls += !before;
        int end = before ? 1 : 0;
        for (; end < 2; end++) {
            t->wall[end] = (float)i / (float)(count - 1);
            for (uint32_t c = 0; c < 4; c++)
                t->wall_colors[end][c] = fminf(fmaxf(texels[4 * i + c], 0), 1);
        }
    }
    if (!t->walls) /* no value reaches there */
        t->wall[0] = t->wall[1] = 2;
    /* filters round: what is opaque but for that is opaque */
    t->wall[0] -= 7.6e-6f;
    t->wall[1] += 7.6e-6f;
}

/* Integrals from 0 to each node, and between two nodes extinction as a straight line that has the
 * same integral: from row to row of the texture the integral up to a node, what is there, what is
 * added up to the next; what
 * the first lost by rounding. */
static void fill_sums(const plr_table *t, const float *texels, uint32_t count, float *out) {
    double w = 1.0 / (t->nodes - 1);
    for (uint32_t i = 0; i < t->nodes; i++) {
        double ends[2][4];
        uint32_t last = i + 1 < t->nodes ? i + 1 : i;
        for (int e = 0; e < 2; e++) {
            at_value(texels, count, (e ? last : i) * w, ends[e]);
            ends[e][3] = extinction(ends[e][3]);
            for (int c = 0; c < 3; c++)
                ends[e][c] *= ends[e][3];
        }
        for (int c = 0; c < 4; c++) {
            double sum = c < 3 ? t->color[i][c] : t->depth[i];
            double next = c < 3 ? t->color[last][c] : t->depth[last];
            double mean = last > i ? (next - sum) / w : ends[0][c];
            bool wall = (ends[0][3] >= PLR_MOST_DEPTH) != (ends[1][3] >= PLR_MOST_DEPTH);
            double rise = wall ? 0 : ends[1][c] - ends[0][c];
            size_t at = 4 * (size_t)i + (size_t)c, row = 4 * (size_t)t->nodes;
            out[at] = (float)sum;
            out[row + at] = (float)(mean - rise / 2);
            out[2 * row + at] = (float)rise;
            out[3 * row + at] = (float)(sum - (double)out[at]);
        }
    }
}

/* At an opaque value next to others extinction has no number; this one continues their mean. */
static double beside_wall(const plr_table *t, const float *texels, uint32_t count, uint32_t i) {
    double w = 1.0 / (t->nodes - 1), color[4], most = 0;
    for (int side = -1; side <= 1; side += 2) {
        if ((side < 0 && i == 0) || (side > 0 && i + 1 == t->nodes))
            continue;
        uint32_t other = (uint32_t)((int64_t)i + side);
        at_value(texels, count, other * w, color);
        if (color[3] < 1)
            most = fmax(most, 2 * fabs(t->depth[i] - t->depth[other]) / w - extinction(color[3]));
    }
    return most > 0 ? most : PLR_MOST_DEPTH;
}

/* The mean over the two spans at a node. */
static void mean_around(const plr_table *t, uint32_t i, double mean[4]) {
    double width = 2.0 / (t->nodes - 1);
    mean[3] = (t->depth[i + 1] - t->depth[i - 1]) / width;
    for (int c = 0; c < 3; c++)
        mean[c] = (t->color[i + 1][c] - t->color[i - 1][c]) / width;
}

/* What the texture holds: means between all pairs of nodes; colours times extinction, so that they
 * are weighted by it wherever they are interpolated. */
static void fill(const plr_table *t, const float *texels, uint32_t count, float *out) {
    for (uint32_t j = 0; j < t->nodes; j++)
        for (uint32_t i = 0; i <= j; i++) {
            double mean[4];
            if (i == j) {
                at_value(texels, count, (double)i / (t->nodes - 1), mean);
                mean[3] = mean[3] < 1 ? extinction(mean[3]) : beside_wall(t, texels, count, i);
                for (int c = 0; c < 3; c++)
                    mean[c] *= mean[3];
                if (count > t->nodes && i > 0 && i + 1 < t->nodes && mean[3] < PLR_MOST_DEPTH)
                    mean_around(t, i, mean); /* texels lie between nodes: none is to be missed */
            } else {
                double width = (double)(j - i) / (t->nodes - 1);
                mean[3] = (t->depth[j] - t->depth[i]) / width;
                for (int c = 0; c < 3; c++)
                    mean[c] = (t->color[j][c] - t->color[i][c]) / width;
            }
            for (int c = 0; c < 4; c++)
                out[4 * ((size_t)j * t->nodes + i) + (size_t)c] =
                    out[4 * ((size_t)i * t->nodes + j) + (size_t)c] = (float)mean[c];
        }
}

/* Beyond, 32-bit values and nodes were seen to be too coarse: extinction (an opacity of 0.99) and
 * the change of its slope. */
#define MOST_EXTINCTION 4.6
#define MOST_SLOPE 1e4

/* Functions of the value whose slopes count: extinction, and colours times extinction, seen against
 * black and against white. */
enum {
    SLOPES = 7
};

/* What the function does in one of the bins that `ranges` tells apart. */
typedef struct bin {
    double slopes[SLOPES][2]; /* least and greatest */
    double extinction;
    double colors[3][2]; /* that are seen */
} bin;

static void widen(double range[2], double value) {
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

static bin empty_bin(void) {
    bin b = {.extinction = 0};
    for (int i = 0; i < SLOPES; i++) {
        b.slopes[i][0] = INFINITY;
        b.slopes[i][1] = -INFINITY;
    }
    for (int k = 0; k < 3; k++) {
        b.colors[k][0] = INFINITY;
        b.colors[k][1] = -INFINITY;
    }
    return b;
}

/* The functions at a value. What is nearly opaque hides all the same. */
static double sample_functions(const float *texels, uint32_t count, double value, double f[SLOPES],
                               double color[4]) {
    at_value(texels, count, fmin(fmax(value, 0), 1), color);
    double tau = fmin(extinction(color[3]), 20);
    f[0] = tau;
    for (int k = 0; k < 3; k++) {
        f[1 + k] = color[k] * tau;
        f[4 + k] = (color[k] - 1) * tau;
    }
    return tau;
}

static void add_node(bin *b, const plr_table *t, const float *texels, uint32_t count, uint32_t i) {
    double w = 1.0 / (t->nodes - 1), f[3][SLOPES], c[3][4], tau[3];
    for (int k = 0; k < 3; k++)
        tau[k] = sample_functions(texels, count, ((double)i + k - 1) * w, f[k], c[k]);
    double most = fmax(tau[1], fmax(tau[0], tau[2]));
    for (int s = 0; s < SLOPES; s++) {
        widen(b->slopes[s], (f[1][s] - f[0][s]) / w);
        widen(b->slopes[s], (f[2][s] - f[1][s]) / w);
    }
    b->extinction = fmax(b->extinction, most);
    for (int n = 0; n < 3 && most > 0; n++)
        for (int k = 0; k < 3; k++)
            widen(b->colors[k], c[n][k]);
}

static void join_ranges(double a[][2], const double b[][2], int count) {
    for (int i = 0; i < count; i++) {
        a[i][0] = fmin(a[i][0], b[i][0]);
        a[i][1] = fmax(a[i][1], b[i][1]);
    }
}

static void join(bin *a, const bin *b) {
    join_ranges(a->slopes, (const double(*)[2])b->slopes, SLOPES);
    join_ranges(a->colors, (const double(*)[2])b->colors, 3);
    a->extinction = fmax(a->extinction, b->extinction);
}

/* For all pairs of bins what holds in them and between them. Nodes at the sides of a bin count in
 * both it and its neighbours. */
static void fill_ranges(const plr_table *t, const float *texels, uint32_t count, float *out,
                        bool *tame) {
    *tame = true;
    bin bins[PLR_TABLE_RANGES];
    for (int i = 0; i < PLR_TABLE_RANGES; i++) {
        bins[i] = empty_bin();
        double from = floor((double)i / PLR_TABLE_RANGES * (t->nodes - 1) - 1e-3);
        double to = ceil((i + 1.0) / PLR_TABLE_RANGES * (t->nodes - 1) + 1e-3);
        for (double n = fmax(from, 0); n <= fmin(to, t->nodes - 1); n++)
            add_node(&bins[i], t, texels, count, (uint32_t)n);
    }
    for (int i = 0; i < PLR_TABLE_RANGES; i++) {
        bin all = bins[i];
        for (int j = i; j < PLR_TABLE_RANGES; j++) {
            join(&all, &bins[j]);
            float *at = out + (ptrdiff_t)4 * (j * PLR_TABLE_RANGES + i);
            double change = 0, slope = 0;
            for (int k = 0; k < 3 && all.extinction > 0; k++)
                change = fmax(change, all.colors[k][1] - all.colors[k][0]);
            for (int n = 0; n < SLOPES; n++)
                slope = fmax(slope, all.slopes[n][1] - all.slopes[n][0]);
            if (slope > MOST_SLOPE || all.extinction > MOST_EXTINCTION)
                *tame = false;
            at[0] = (float)slope;
            at[1] = (float)all.extinction;
            at[2] = (float)change;
            at[3] = 0;
        }
    }
}

/* An image of RGBA. */
static plr_image make_image(plr_arena *arena, uint32_t width, uint32_t height) {
    plr_image image = {
        .width = width, .height = height, .depth = 1, .components = 4, .type = PLR_FLOAT32};
    image.samples = calloc((size_t)width * height, 4 * sizeof(float));
    if (!image.samples)
        longjmp(*arena->out_of_memory, 1);
    return image;
}

/* As many nodes between two texels that there are at least so many. */
static uint32_t choose_nodes(uint32_t count, uint32_t fewest, uint32_t most) {
    if (count > most)
        return most;
    uint32_t times = (fewest - 1 + count - 2) / (count - 1);
    return times * (count - 1) + 1;
}

static void set_nodes(plr_table *t, plr_arena *arena, const float *texels, uint32_t count,
                      uint32_t nodes) {
    t->nodes = nodes;
    t->depth = PLR_NEW_ARRAY(arena, nodes, double);
    t->color = plr_arena_array(arena, nodes, sizeof *t->color);
    t->visible = PLR_NEW_ARRAY(arena, nodes, uint32_t);
    integrate(t, texels, count);
}

plr_table *plr_table_make(plr_textures *textures, plr_arena *arena, const float *texels,
                          uint32_t count) {
    plr_table *t = PLR_NEW(arena, plr_table);
    find_wall(t, texels, count);
    set_nodes(t, arena, texels, count, choose_nodes(count, FEWEST_SUMS, MOST_SUMS));
    plr_image image = make_image(arena, t->nodes, 4);
    fill_sums(t, texels, count, image.samples);
    t->sums = plr_textures_make(textures, &image, PLR_TEXTURE_2D, false);
    image = make_image(arena, PLR_TABLE_RANGES, PLR_TABLE_RANGES);
    fill_ranges(t, texels, count, image.samples, &t->tame);
    t->ranges = plr_textures_make(textures, &image, PLR_TEXTURE_2D, false);
    set_nodes(t, arena, texels, count, choose_nodes(count, FEWEST_NODES, MOST_NODES));
    image = make_image(arena, t->nodes, t->nodes);
    fill(t, texels, count, image.samples);
    t->texture = plr_textures_make(textures, &image, PLR_TEXTURE_2D, false);
    return t;
}

bool plr_table_sees(const plr_table *table, double low, double high) {
    double last = table->nodes - 1;
    /* filters round: a little more than the range counts */
    double from = floor(fmin(fmax(low - 1e-5, 0), 1) * last);
    double to = ceil(fmin(fmax(high + 1e-5, 0), 1) * last);
    return table->visible[(uint32_t)to] > table->visible[(uint32_t)from] ||
           (from == to && table->visible[(uint32_t)from + (from < last)] >
                              table->visible[(uint32_t)from - (from > 0)]);
}

void plr_table_seen(const plr_table *table, float seen[2]) {
    uint32_t first = 0, last = table->nodes - 1;
    while (first < last && table->visible[first + 1] == 0)
        first++;
    while (last > 0 && table->visible[last - 1] == table->visible[table->nodes - 1])
        last--;
    bool any = first < last;
    seen[0] = !any ? INFINITY : first == 0 ? -INFINITY : (float)first / (float)(table->nodes - 1);
    seen[1] = !any                       ? -INFINITY
              : last == table->nodes - 1 ? INFINITY
                                         : (float)last / (float)(table->nodes - 1);
}
