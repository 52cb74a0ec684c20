/* The integral of emission and absorption: midpoint steps, extrapolated. */
#include "walk.h"

#include <math.h>
#include <string.h>

enum {
    LEVELS = 5,
    MOST_HALVINGS = 48,
    HALVED = 10
};

/* Extinction, and colour times extinction, of all volumes at t. */
static double source(const ref_sum *sum, double t, double colored[3]) {
    double total = 0;
    colored[0] = colored[1] = colored[2] = 0;
    for (int w = 0; w < sum->count; w++) {
        const ref_walk *walk = sum->walks[w];
        const ref_interval *i = walk->interval;
        if (i->is_clear)
            continue;
        double value = ref_walk_value(walk, t);
        double away = i->slope[3] * (value - i->anchor), alpha = i->base[3] + away;
        if (!(alpha > 0))
            continue;
        /* near alpha 1 from 1 - alpha, which keeps its digits there */
        double extinction = alpha < 0.5 ? -log1p(-alpha) : -log(fmax(i->clearness - away, 1e-300));
        extinction *= walk->speed;
        double color[3];
        ref_walk_color(walk, t, value, color);
        for (int k = 0; k < 3; k++)
            colored[k] += extinction * color[k];
        total += extinction;
    }
    return total;
}

/* One row: colour and optical depth by `count` steps, each with the extinction of its middle. */
static void midpoints(const ref_sum *sum, double from, double to, int count, double row[4]) {
    double length = (to - from) / count, through = 1;
    memset(row, 0, 4 * sizeof *row);
    for (int i = 0; i < count; i++) {
        double colored[3], extinction = source(sum, from + (i + 0.5) * length, colored);
        if (!(extinction > 0))
            continue;
        double opacity = -expm1(-extinction * length);
        for (int k = 0; k < 3; k++)
            row[k] += through * opacity * colored[k] / extinction;
        row[3] += extinction * length;
        through *= 1 - opacity;
    }
}

/* Richardson's extrapolation, level by level: the error of such steps has even powers of their
 * length alone. Returns how far the last two estimates are apart. */
static double extrapolated(double table[LEVELS][4], double before[LEVELS][4], int level) {
    double worst = 0, scale = 1;
    for (int j = 1; j <= level; j++) {
        scale *= 4;
        for (int k = 0; k < 4; k++)
            table[j][k] = table[j - 1][k] + (table[j - 1][k] - before[j - 1][k]) / (scale - 1);
    }
    for (int k = 0; k < 4; k++)
        worst = fmax(worst, fabs(table[level][k] - before[level - 1][k]));
    return worst;
}

static void gather(ref_sum *sum, const double found[4], double error) {
    double through = exp(-sum->depth);
    for (int k = 0; k < 3; k++)
        sum->color[k] += through * found[k];
    sum->depth += found[3];
    sum->error += through * error;
}

static void integrate(ref_sum *sum, double from, double to, int halvings) {
    double through = exp(-sum->depth);
    double tolerance = sum->scene->tolerance > 0 ? sum->scene->tolerance : 1e-10;
    double rows[2][LEVELS][4], error = INFINITY, middle = 0.5 * (from + to);
    if (through < 1e-17)
        return;
    int level = 0;
    for (; level < LEVELS; level++) {
        double(*now)[4] = rows[level % 2], (*before)[4] = rows[(level + 1) % 2];
        midpoints(sum, from, to, 1 << level, now[0]);
        error = level ? extrapolated(now, before, level) : INFINITY;
        if (level >= 2 && error * through <= tolerance)
            break;
        if (level == 0 && now[0][3] > 4 && halvings < MOST_HALVINGS)
            break; /* steep: halves first */
    }
    bool found = level > 0 && (level < LEVELS || halvings >= MOST_HALVINGS);
    if (level == LEVELS)
        level--;
    if (found || !(middle > from && middle < to)) {
        /* next to a singularity estimates agree sooner than they should */
        gather(sum, rows[level % 2][level], level ? error * (halvings ? HALVED : 1) : 0);
        return;
    }
    integrate(sum, from, middle, halvings + 1);
    integrate(sum, middle, to, halvings + 1);
}

void ref_sum_integrate(ref_sum *sum, double from, double to) {
    integrate(sum, from, to, 0);
}
