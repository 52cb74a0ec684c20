#include "engine/volume_table.h"

#include <math.h>
#include <stdlib.h>

enum {
    FEWEST_NODES = 385,
    MOST_NODES = 1025
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

/* What the texture holds: means between all pairs of nodes; colours times extinction, so that they
 * are weighted by it wherever they are interpolated. */
static void fill(const plr_table *t, const float *texels, uint32_t count, float *out) {
    for (uint32_t j = 0; j < t->nodes; j++)
        for (uint32_t i = 0; i <= j; i++) {
            double mean[4];
            if (i == j) {
                at_value(texels, count, (double)i / (t->nodes - 1), mean);
                mean[3] = extinction(mean[3]);
                for (int c = 0; c < 3; c++)
                    mean[c] *= mean[3];
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

static uint32_t choose_nodes(uint32_t count) {
    if (count > MOST_NODES)
        return MOST_NODES;
    uint32_t times = (FEWEST_NODES - 1 + count - 2) / (count - 1);
    return times * (count - 1) + 1;
}

plr_table *plr_table_make(plr_textures *textures, plr_arena *arena, const float *texels,
                          uint32_t count) {
    plr_table *t = PLR_NEW(arena, plr_table);
    t->nodes = choose_nodes(count);
    t->depth = PLR_NEW_ARRAY(arena, t->nodes, double);
    t->color = plr_arena_array(arena, t->nodes, sizeof *t->color);
    t->visible = PLR_NEW_ARRAY(arena, t->nodes, uint32_t);
    for (uint32_t i = 0; i < count; i++)
        t->opaque = t->opaque || texels[4 * i + 3] >= 1;
    integrate(t, texels, count);
    plr_image image = {
        .width = t->nodes, .height = t->nodes, .depth = 1, .components = 4, .type = PLR_FLOAT32};
    image.samples = malloc((size_t)t->nodes * t->nodes * 4 * sizeof(float));
    if (!image.samples)
        longjmp(*arena->out_of_memory, 1);
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
    seen[1] = !any ? -INFINITY
              : last == table->nodes - 1 ? INFINITY
                                         : (float)last / (float)(table->nodes - 1);
}
