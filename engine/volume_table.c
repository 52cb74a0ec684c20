#include "engine/volume_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_CLIPPED = 16, /* part of all values that is clear */
    FEWEST_NODES = 385,
    MOST_NODES = 1025,
    FEWEST_SUMS = 2049,
    MOST_SUMS = 8192 /* a side that textures may have everywhere */
};

/* The function between two texels. */
typedef struct span {
    double from[4], to[4];
} span;

static void at_value(const float *texels, uint32_t count, double value, double color[4]) {
    double place = value * (count - 1), near = round(place);
    place = fabs(place - near) < 1e-9 * count ? near : place; /* texels are met */
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

/* Adds the integrals over a span of values along which opacity and colour are linear; clearness
 * runs from m (1 - r) to m (1 + r). The means of -ln(1 + r x), and of that times x, over -1 < x < 1
 * are closed forms, and for small r their series. */
static void add_span(const span *s, double width, double *depth, double color[3]) {
    double p = 1 - s->from[3], q = 1 - s->to[3], sum = p + q;
    if (sum <= 0) {
        *depth += width * PLR_MOST_DEPTH;
        for (int c = 0; c < 3; c++)
            color[c] += width * PLR_MOST_DEPTH * (s->from[c] + s->to[c]) / 2;
        return;
    }
    double r = (q - p) / sum, r2 = r * r, mean, tilt;
    if (fabs(r) < 0.05) {
        double alpha = (s->from[3] + s->to[3]) / 2;
        mean = -log1p(-alpha) + r2 * (1.0 / 6 + r2 * (1.0 / 20 + r2 * (1.0 / 42 + r2 / 72)));
        tilt = -r * (1.0 / 3 + r2 * (1.0 / 15 + r2 * (1.0 / 35 + r2 / 63)));
    } else {
        double lp = log(fmax(p, 1e-300)), lq = log(fmax(q, 1e-300)), t = (lq - lp) / 2;
        mean = 1 - (lp + lq) / 2 - t / r;
        tilt = -(t * (1 - 1 / r2) + 1 / r) / 2;
    }
    *depth += width * mean;
    for (int c = 0; c < 3; c++)
        color[c] +=
            width *
            fmax((s->from[c] + s->to[c]) / 2 * mean + (s->to[c] - s->from[c]) / 2 * tilt, 0);
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

/* The function at a node: between nodes colour and opacity are linear. An opacity may be above 1:
 * the function is opaque from where it is 1 on. */
static void at_node(const plr_table *t, const float *texels, uint32_t count, uint32_t i,
                    double color[4]) {
    if (t->nodes != count) {
        at_value(texels, count, (double)i / (t->nodes - 1), color);
        return;
    }
    for (uint32_t c = 0; c < 4; c++) {
        double most = c < 3 ? 1 : 1e6, x = (double)texels[4 * i + c];
        color[c] = x > 0 ? fmin(x, most) : 0;
    }
}

/* So near to an opaque value extinction is taken for the logarithm of the distance, a bin of
 * `ranges`, or as far as the texels are apart. */
#define BESIDE_WALL (1.0 / PLR_TABLE_RANGES)

/* For each span between two nodes the next opaque values, below and above those in it that are not;
 * and from where on values lie beside these. */
static void fill_walls(const plr_table *t, const float *texels, uint32_t count, float slack,
                       float *out) {
    double w = 1.0 / (t->nodes - 1), a[4], b[4];
    double least = -2, beside_least = -2, greatest = 2, beside_greatest = 2;
    for (uint32_t i = t->nodes - 1; i-- > 0;) {
        at_node(t, texels, count, i, a);
        at_node(t, texels, count, i + 1, b);
        if (b[3] >= 1) {
            greatest = a[3] >= 1 ? -2 : (i + (1 - a[3]) / (b[3] - a[3])) * w;
            beside_greatest = fmax(i * w, greatest - BESIDE_WALL);
        }
        out[4 * i + 1] = (float)greatest - slack;
        out[4 * i + 3] = (float)beside_greatest;
    }
    for (uint32_t i = 0; i + 1 < t->nodes; i++) {
        at_node(t, texels, count, i, a);
        at_node(t, texels, count, i + 1, b);
        if (a[3] >= 1) {
            least = b[3] >= 1 ? 2 : (i + (a[3] - 1) / (a[3] - b[3])) * w;
            beside_least = fmin((i + 1) * w, least + BESIDE_WALL);
        }
        out[4 * i] = (float)least + slack;
        out[4 * i + 2] = (float)beside_least;
    }
}

/* From row to row of the texture: colour times extinction and extinction, integrated from 0 to each
 * node; the function there, or, of a gentle one, colour times extinction and extinction; the opaque
 * values around the span behind it; what the first row lost by rounding. */
static void fill_sums(const plr_table *t, const float *texels, uint32_t count, float slack,
                      float *out) {
    size_t row = 4 * (size_t)t->nodes;
    for (uint32_t i = 0; i < t->nodes; i++) {
        double color[4];
        at_node(t, texels, count, i, color);
        if (t->gentle) {
            color[3] = extinction(color[3]);
            for (int c = 0; c < 3; c++)
                color[c] *= color[3];
        }
        for (int c = 0; c < 4; c++) {
            double sum = c < 3 ? t->color[i][c] : t->depth[i];
            size_t at = 4 * (size_t)i + (size_t)c;
            out[at] = (float)sum;
            out[row + at] = (float)color[c];
            out[2 * row + at] = 0;
            out[3 * row + at] = (float)(sum - (double)out[at]);
        }
    }
    fill_walls(t, texels, count, slack, out + 2 * row);
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

/* Beyond, 32-bit values are too coarse: a unit in their last place changes extinction by so much.
 */
#define MOST_SLOPE 1e5
/* What can be seen of the function is at most so dense: what is denser hides all the same. Towards
 * opaque values extinction grows without limit, but its mean does not. */
#define MOST_EXTINCTION 20.0
#define MOST_BESIDE_WALL 8.0

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
    uint32_t looks[2];   /* from the first of these to the last */
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

/* The functions at a value. */
static double sample_functions(const float *texels, uint32_t count, double value, double f[SLOPES],
                               double color[4]) {
    at_value(texels, count, fmin(fmax(value, 0), 1), color);
    double tau = fmin(extinction(color[3]), MOST_EXTINCTION);
    f[0] = tau;
    for (int k = 0; k < 3; k++) {
        f[1 + k] = color[k] * tau;
        f[4 + k] = (color[k] - 1) * tau;
    }
    return tau;
}

/* Between two texels of which one is opaque. */
typedef struct wall_span {
    double wall;          /* where it begins to be */
    double beside;        /* from where on values are beside that */
    const float *ends[2]; /* the texels: the clear one, the opaque one */
} wall_span;

static wall_span find_wall_span(const float *texels, uint32_t count, uint32_t texel) {
    const float *x = texels + (size_t)4 * texel, *y = x + 4;
    double w = 1.0 / (count - 1), p = (double)x[3], q = (double)y[3];
    double wall = (texel + (1 - p) / (q - p)) * w;
    wall_span s = {.wall = wall, .ends = {x, y}};
    if (p < 1) {
        s.beside = fmax(texel * w, wall - BESIDE_WALL);
        return s;
    }
    s.beside = fmin((texel + 1) * w, wall + BESIDE_WALL);
    s.ends[0] = y;
    s.ends[1] = x;
    return s;
}

/* There the slope of extinction is one over the distance to that value, which cells.glsl counts. It
 * begins with this one. */
static void add_beside(bin *b, const float *texels, uint32_t count, const wall_span *s) {
    double sign = s->beside < s->wall ? 1 : -1, c[4];
    at_value(texels, count, s->beside, c);
    double tau = fmin(extinction(c[3]), MOST_BESIDE_WALL);
    double rise = 1 / fmax(fabs(s->wall - s->beside), 1e-9);
    widen(b->slopes[0], sign * rise);
    for (int k = 0; k < 3; k++) {
        double change = ((double)s->ends[1][k] - (double)s->ends[0][k]) * (count - 1);
        for (int white = 0; white < 2; white++) {
            double *range = b->slopes[1 + k + 3 * white];
            widen(range, sign * ((c[k] - white) * rise + change * tau));
            widen(range, sign * ((c[k] - white) * rise + change * MOST_BESIDE_WALL));
        }
    }
    b->extinction = fmax(b->extinction, MOST_BESIDE_WALL);
}

/* What the function does between two places of `looks` evenly spaced ones. */
static void add_look(bin *b, const float *texels, uint32_t count, uint32_t looks, uint32_t i) {
    double w = 1.0 / (looks - 1), f[2][SLOPES], c[2][4], tau[2];
    uint32_t texel = (uint32_t)((i + 0.5) * w * (count - 1));
    bool walls[2] = {texels[4 * texel + 3] >= 1, texels[4 * texel + 7] >= 1};
    for (int k = 0; k < 2; k++)
        tau[k] = sample_functions(texels, count, ((double)i + k) * w, f[k], c[k]);
    for (int n = 0; n < 2 && fmax(tau[0], tau[1]) > 0; n++)
        for (int k = 0; k < 3; k++)
            widen(b->colors[k], c[n][k]);
    if (walls[0] && walls[1])
        return;
    if (walls[0] || walls[1]) {
        wall_span s = find_wall_span(texels, count, texel);
        double middle = (i + 0.5) * w;
        if (s.beside < s.wall ? middle > s.beside : middle < s.beside) {
            if (s.beside < s.wall ? middle < s.wall : middle > s.wall)
                add_beside(b, texels, count, &s);
            return;
        }
    }
    for (int s = 0; s < SLOPES; s++)
        widen(b->slopes[s], (f[1][s] - f[0][s]) / w);
    b->extinction = fmax(b->extinction, fmax(tau[0], tau[1]));
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
    a->looks[1] = b->looks[1];
    a->extinction = fmax(a->extinction, b->extinction);
}

/* From where to where, between two bins, something can be seen: in one number, the ends away from
 * each other, by which filters round. */
static float seen_within(const plr_table *t, int low, int high) {
    double last = t->nodes - 1, steps = PLR_TABLE_SEEN - 1;
    uint32_t from = (uint32_t)floor((double)low / PLR_TABLE_RANGES * last);
    uint32_t to = (uint32_t)ceil((high + 1.0) / PLR_TABLE_RANGES * last);
    while (from < to && t->visible[from + 1] == t->visible[from])
        from++;
    while (to > from && t->visible[to - 1] == t->visible[to])
        to--;
    return (float)(fmax(floor(from / last * steps - 0.1), 0) * PLR_TABLE_SEEN +
                   fmin(ceil(to / last * steps + 0.1), steps));
}

/* How much a channel of colour changes from the first look to each, forth and back, where it can be
 * seen. */
static void fill_turns(const float *texels, uint32_t count, uint32_t looks, double (*turns)[3]) {
    double last[3] = {0, 0, 0}, now[4], next[4], all[3] = {0, 0, 0};
    bool any = false;
    at_value(texels, count, 0, now);
    for (uint32_t i = 0; i < looks; i++) {
        memcpy(turns[i], all, sizeof all);
        if (i + 1 == looks)
            break;
        at_value(texels, count, (i + 1.0) / (looks - 1), next);
        for (int k = 0; k < 3 && fmax(now[3], next[3]) > 0; k++) {
            all[k] += (any ? fabs(now[k] - last[k]) : 0) + fabs(next[k] - now[k]);
            last[k] = next[k];
        }
        any = any || fmax(now[3], next[3]) > 0;
        memcpy(now, next, sizeof now);
    }
}

/* The greatest change of colour and, behind the point, its part of all changes: PLR_TABLE_COLORS.
 */
static float change_of(const bin *b, const double (*turns)[3]) {
    double change = 0, all = 0, parts = 4096;
    for (int k = 0; k < 3 && b->extinction > 0; k++) {
        change = fmax(change, b->colors[k][1] - b->colors[k][0]);
        all = fmax(all, turns[b->looks[1]][k] - turns[b->looks[0]][k]);
    }
    double steps = ceil(change * PLR_TABLE_COLORS - 1e-6);
    double part = all > 0 ? fmin(0.998 * steps / (PLR_TABLE_COLORS * all), 0.998) : 0.998;
    return (float)(steps + floor(part * parts) / parts);
}

/* For all pairs of bins what holds in them and between them. What lies at the sides of a bin counts
 * in both it and its neighbours. Returns the greatest change of slope. */
static double fill_ranges(const plr_table *t, plr_arena *arena, const float *texels, uint32_t count,
                          uint32_t looks, float *out) {
    bin bins[PLR_TABLE_RANGES];
    double most = 0, (*turns)[3] = plr_arena_array(arena, looks, sizeof *turns);
    fill_turns(texels, count, looks, turns);
    for (int i = 0; i < PLR_TABLE_RANGES; i++) {
        bins[i] = empty_bin();
        double from = floor((double)i / PLR_TABLE_RANGES * (looks - 1) - 1e-3) - 1;
        double to = ceil((i + 1.0) / PLR_TABLE_RANGES * (looks - 1) + 1e-3);
        bins[i].looks[0] = (uint32_t)fmax(from, 0);
        bins[i].looks[1] = (uint32_t)fmin(to, looks - 2) + 1;
        for (double n = fmax(from, 0); n <= fmin(to, looks - 2); n++)
            add_look(&bins[i], texels, count, looks, (uint32_t)n);
    }
    for (int i = 0; i < PLR_TABLE_RANGES; i++) {
        bin all = bins[i];
        for (int j = i; j < PLR_TABLE_RANGES; j++) {
            join(&all, &bins[j]);
            float *at = out + (ptrdiff_t)4 * (j * PLR_TABLE_RANGES + i);
            double slope = 0;
            for (int n = 0; n < SLOPES; n++)
                slope = fmax(slope, all.slopes[n][1] - all.slopes[n][0]);
            most = fmax(most, slope);
            at[0] = (float)slope;
            at[1] = (float)all.extinction;
            at[2] = change_of(&all, (const double(*)[3])turns);
            at[3] = seen_within(t, i, j);
        }
    }
    return most;
}

/* Whether the nodes have the function as it is: nothing lies between them, nothing is cut off. */
static bool is_whole(const float *texels, uint32_t count) {
    bool whole = count <= MOST_SUMS;
    for (size_t i = 0; i < (size_t)4 * count; i++)
        whole = whole && texels[i] >= 0 && (texels[i] <= 1 || i % 4 == 3);
    return whole;
}

plr_image plr_table_image(plr_arena *arena, uint32_t width, uint32_t height) {
    plr_image image = {
        .width = width, .height = height, .depth = 1, .components = 4, .type = PLR_FLOAT32};
    image.samples = calloc((size_t)width * height, 4 * sizeof(float));
    if (!image.samples)
        longjmp(*arena->out_of_memory, 1);
    return image;
}

plr_texture *plr_table_numbers(plr_textures *textures, plr_image *image) {
    plr_texture *texture = plr_textures_make(textures, image, PLR_TEXTURE_2D, false);
    texture->numbers = true;
    return texture;
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

/* Whether, from node to node, extinction and colour times extinction are as good as straight: they
 * differ from a line of the same mean by no more than a part of it, of which at most 1/e is seen.
 * Bent are the logarithm, and products. */
static bool is_gentle(const float *texels, uint32_t count, uint32_t nodes, double allowed) {
    double a[4], b[4];
    at_value(texels, count, 0, b);
    bool gentle = count <= nodes;
    for (uint32_t i = 0; gentle && i + 1 < nodes; i++) {
        memcpy(a, b, sizeof a);
        at_value(texels, count, (i + 1.0) / (nodes - 1), b);
        double least = 1 - fmax(a[3], b[3]), rise = b[3] - a[3];
        if (least <= 0)
            return false;
        double mean = (extinction(a[3]) + extinction(b[3])) / 2,
               bend = rise * rise / (least * least);
        for (int c = 0; c < 3; c++)
            bend = fmax(bend, 2 * fabs(b[c] - a[c]) * fabs(extinction(b[3]) - extinction(a[3])));
        gentle = bend <= 12 * allowed * mean;
    }
    return gentle;
}

static uint32_t choose_sums(const float *texels, uint32_t count, double error, bool *gentle) {
    *gentle = error > 0;
    for (uint32_t fewest = FEWEST_SUMS; *gentle && fewest < MOST_SUMS; fewest = 2 * fewest - 1) {
        uint32_t nodes = choose_nodes(count, fewest, MOST_SUMS);
        if (nodes <= MOST_SUMS && is_gentle(texels, count, nodes, 0.6 * error))
            return nodes;
    }
    *gentle = false;
    return count < MOST_SUMS ? count : MOST_SUMS;
}

static void make_textures(plr_table *t, plr_textures *textures, plr_arena *arena,
                          const float *texels, uint32_t count) {
    plr_image image = plr_table_image(arena, t->sum_nodes, 4);
    memcpy(image.samples, t->sum_rows, (size_t)16 * t->sum_nodes * sizeof(float));
    t->sums = plr_table_numbers(textures, &image);
    image = plr_table_image(arena, PLR_TABLE_RANGES, PLR_TABLE_RANGES);
    memcpy(image.samples, t->range_rows, PLR_RANGE_FLOATS * sizeof(float));
    t->ranges = plr_table_numbers(textures, &image);
    image = plr_table_image(arena, t->nodes, t->nodes);
    fill(t, texels, count, image.samples);
    t->texture = plr_textures_make(textures, &image, PLR_TEXTURE_2D, false);
}

plr_table *plr_table_make(plr_textures *textures, plr_arena *arena, const float *texels,
                          uint32_t count, const plr_table_wish *wish) {
    plr_table *t = PLR_NEW(arena, plr_table);
    float *kept = plr_arena_array(arena, count, 4 * sizeof *kept);
    memcpy(kept, texels, (size_t)count * 4 * sizeof *kept);
    t->texels = kept;
    t->texel_count = count;
    find_wall(t, texels, count);
    if (wish->bare) {
        set_nodes(t, arena, texels, count, choose_nodes(count, FEWEST_NODES, MOST_NODES));
        return t;
    }
    set_nodes(t, arena, texels, count, choose_sums(texels, count, wish->error, &t->gentle));
    t->sum_nodes = t->nodes;
    t->sum_rows = PLR_NEW_ARRAY(arena, (size_t)16 * t->nodes, float);
    fill_sums(t, texels, count, wish->slack, t->sum_rows);
    t->clips =
        !(wish->error > 0) || t->visible[t->nodes - 1] < t->nodes - 1 - t->nodes / LEAST_CLIPPED;
    t->range_rows = PLR_NEW_ARRAY(arena, PLR_RANGE_FLOATS, float);
    double slope = fill_ranges(t, arena, texels, count, choose_nodes(count, FEWEST_SUMS, MOST_SUMS),
                               t->range_rows);
    t->tame = slope <= MOST_SLOPE && is_whole(texels, count);
    set_nodes(t, arena, texels, count, choose_nodes(count, FEWEST_NODES, MOST_NODES));
    if (!wish->in_stack)
        make_textures(t, textures, arena, texels, count);
    return t;
}

static void find_reach(const plr_table *table, double length, double voxels,
                       float reach[PLR_TABLE_RANGES]) {
    enum {
        JOINED = 4 /* segments */
    };
    const double allowed = 0.02 * voxels * voxels;
    for (int i = 0; i < PLR_TABLE_RANGES; i++) {
        reach[i] = -1;
        for (int j = i; j < PLR_TABLE_RANGES; j++) {
            const float *at = table->range_rows + (ptrdiff_t)4 * (j * PLR_TABLE_RANGES + i);
            /* off the line by half of the range; what hides what by a twelfth of the square of the
             * depth, as far as colours differ (see cells.glsl) */
            double off = (j - i + 1.0) / PLR_TABLE_RANGES / 2;
            double depth = JOINED * length * (double)at[1];
            double change = floor((double)at[2]) / PLR_TABLE_COLORS;
            double error =
                0.13 * (double)at[0] * off * JOINED * length + depth * fmin(depth, 1) * change / 12;
            if (error > allowed)
                break;
            reach[i] = (float)(j + 1) / PLR_TABLE_RANGES;
        }
    }
}

bool plr_table_joins(const plr_table *table, double length, double voxels) {
    float reach[PLR_TABLE_RANGES];
    int far = 0, seen = 0;
    if (table->walls > 0)
        return false;
    find_reach(table, length, voxels, reach);
    for (int i = 0; i < PLR_TABLE_RANGES; i++)
        if (table->range_rows[(ptrdiff_t)4 * (i * PLR_TABLE_RANGES + i) + 1] > 0) {
            seen++;
            far += reach[i] * PLR_TABLE_RANGES >= (float)(i + 2);
        }
    return 2 * far > seen;
}

void plr_table_reach(const plr_table *table, double length, double voxels,
                     float reach[PLR_TABLE_RANGES]) {
    if (plr_table_joins(table, length, voxels))
        find_reach(table, length, voxels, reach);
    else
        for (int i = 0; i < PLR_TABLE_RANGES; i++)
            reach[i] = -1;
}

double plr_table_density(const plr_table *table) {
    return table->visible ? (double)table->visible[table->nodes - 1] / (table->nodes - 1) : 0;
}

/* Whatever filters do, 0 everywhere stays 0. */
static bool is_zero_clear(const plr_table *table) {
    return !(table->texels[3] > 0);
}

bool plr_table_sees(const plr_table *table, double low, double high) {
    double last = table->nodes - 1;
    if (high <= 0 && is_zero_clear(table))
        return false;
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
    float least = is_zero_clear(table) ? 0 : -INFINITY;
    seen[0] = !any ? INFINITY : first == 0 ? least : (float)first / (float)(table->nodes - 1);
    seen[1] = !any                       ? -INFINITY
              : last == table->nodes - 1 ? INFINITY
                                         : (float)last / (float)(table->nodes - 1);
}
