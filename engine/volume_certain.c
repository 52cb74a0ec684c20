/* Bounds for the midpoint rule along rays through trilinear values and a transfer function that is
 * linear from texel to texel.
 *
 * Let tau be extinction, c colour, B what is behind as seen from a place (premultiplied), T'
 * transparency up to there as steps have it, and tau', c' what they have of the others. The
 * derivative of T' B is T' (tau (B - c) - tau' B), and its integral minus the true colour; hence
 *
 *   the error of colour = integral of T' ((tau' - tau) (c - B) + tau' (c' - c)),
 *
 * which leaves nothing out. In a step of length h around the place of its sample m tau' and c' are
 * tau(m) and c(m), and
 *
 *   d/dx T' (c - B) = T' ((tau - tau') (c - B) + dc/dx).
 *
 *   I. T' (c - B) at m times the integral of tau' - tau is the error of optical depth; the rest is
 *      at most the integral of |tau' - tau| times that of the derivative, from m on;
 *   II. T' tau' at m times the integral of c' - c is the error of colour; T' changes from m on by
 *      T' tau' |x|, which makes no more of it than T' where the step begins times tau'^2 h^3/12
 *      times the slope of c.
 *
 * Where volumes overlap tau is the sum of theirs; each has these terms, and the derivative has
 * tau (mean c - c) more. Rates of these errors (engine/volume_rates.c) are summed over slabs of
 * blocks, whichever way a ray goes. Where one is at most a + b tau' its integral along a ray, as
 * seen, is at most that of a, and b: what is seen of all tau' is 1 at most. */
#include "engine/volume_certain.h"

#include <math.h>

#include "engine/volume_rates.h"

enum {
    MOST_VOLUMES = 8,
    SHARES = 7 /* tries of b */
};

#define EULER 2.718281828459045

/* ---- Along rays ---- */

/* Where a block lies. */
static size_t slab_of(const uint32_t blocks[3], int axis, size_t i) {
    size_t across = axis == 0 ? 1 : axis == 1 ? blocks[0] : (size_t)blocks[0] * blocks[1];
    return i / across % blocks[axis];
}

/* A ray with the direction d goes from side to side of a slab across axis k in |d_k|, and lies the
 * longest way across that axis for which |d_k| / side of the volume is greatest: no longer in each
 * slab than its part of the longest ray. */
static double part_of(const plr_rates *r, int axis, size_t slab) {
    const plr_bends *b = r->v->bends;
    size_t size = b->size[axis], first = slab * b->cells;
    bool ends[2] = {slab == 0, slab + 1 == b->blocks[axis]};
    double voxels = (double)(size - 1 - first < b->cells ? size - 1 - first : b->cells);
    voxels += 0.5 * ends[0] + 0.5 * ends[1];
    return r->v->longest * voxels / (double)size;
}

enum {
    MOST_SLABS = 2048 /* no axis has more blocks (engine/volume_bends.c) */
};

static void find_slabs(const plr_rates *r, const float *rate, const float *extinction, float share,
                       float *slabs[3]) {
    for (int axis = 0; axis < 3; axis++)
        for (size_t k = 0; k < r->blocks[axis]; k++)
            slabs[axis][k] = 0;
    size_t i = 0;
    for (size_t z = 0; z < r->blocks[2]; z++)
        for (size_t y = 0; y < r->blocks[1]; y++) {
            float most = 0;
            for (size_t x = 0; x < r->blocks[0]; x++, i++) {
                float left = rate[i] - share * extinction[i];
                slabs[0][x] = left > slabs[0][x] ? left : slabs[0][x];
                most = left > most ? left : most;
            }
            slabs[1][y] = most > slabs[1][y] ? most : slabs[1][y];
            slabs[2][z] = most > slabs[2][z] ? most : slabs[2][z];
        }
}

/* The integral of what is left of a rate without some share of extinction. */
static double along(const plr_rates *r, const float *rate, const float *extinction, double share) {
    if (r->count == 1)
        return fmax((double)rate[0] - share * (double)extinction[0], 0) * r->v->longest;
    float numbers[3][MOST_SLABS], *slabs[3] = {numbers[0], numbers[1], numbers[2]};
    find_slabs(r, rate, extinction, (float)share, slabs);
    double worst = 0;
    for (int axis = 0; axis < 3; axis++) {
        double sum = 0;
        for (size_t k = 0; k < r->blocks[axis]; k++)
            sum += (double)slabs[axis][k] * part_of(r, axis, k);
        worst = fmax(worst, sum);
    }
    return worst;
}

/* At most a, and b of what is seen of extinction. */
typedef struct integral {
    double a, b;
} integral;

/* The least a + weight b. */
static integral integrate(const plr_rates *r, const float *rate, const float *extinction,
                          double weight) {
    double share = 0;
    for (size_t i = 0; i < r->count; i++)
        if (extinction[i] > 0)
            share = fmax(share, (double)rate[i] / (double)extinction[i]);
    integral best = {along(r, rate, extinction, 0), 0};
    for (int k = 0; k < SHARES && best.a > 0 && share > 0; k++, share /= 2) {
        double a = along(r, rate, extinction, share);
        if (a + weight * share < best.a + weight * best.b)
            best = (integral){a, share};
    }
    return best;
}

/* ---- Faces of cells ---- */

/* By how much the slope along a ray jumps in all, at most: the outermost voxels, beyond which
 * values stay the same, and those within. A ray crosses each layer of voxels once at most, and the
 * slope jumps there by |d| times the jump across. */
typedef struct jumps {
    double rim, all;
} jumps;

static double across(const plr_rates *r, const float *steep, int axis, double *rim) {
    const plr_bends *b = r->v->bends;
    const float *slope = b->found[PLR_BEND_SLOPE + axis], *jump = b->found[PLR_BEND_JUMP + axis];
    float most[MOST_SLABS], ends[2] = {0, 0};
    size_t count = b->blocks[axis];
    for (size_t k = 0; k < count; k++)
        most[k] = 0;
    for (size_t i = 0; i < plr_bends_count(b); i++) {
        size_t k = slab_of(b->blocks, axis, i);
        float times = steep[r->count > 1 ? i : 0], turn = times * jump[i];
        most[k] = turn > most[k] ? turn : most[k];
        ends[0] = k == 0 ? fmaxf(ends[0], times * slope[i]) : ends[0];
        ends[1] = k + 1 == count ? fmaxf(ends[1], times * slope[i]) : ends[1];
    }
    double sum = 0;
    for (size_t k = 0; k < count; k++) {
        size_t first = k * b->cells, last = first + b->cells;
        last = last + 1 < b->size[axis] ? last : b->size[axis] > 2 ? b->size[axis] - 2 : first;
        sum += (double)most[k] * (double)(last > first ? last - first : 0);
    }
    *rim = ((double)ends[0] + (double)ends[1]) / r->v->voxel[axis];
    return sum / r->v->voxel[axis] + *rim;
}

static jumps jumps_of(const plr_rates *r, const float *steep) {
    double rim[3], all[3];
    for (int axis = 0; axis < 3; axis++)
        all[axis] = across(r, steep, axis, &rim[axis]);
    double most = r->step * r->step / 8;
    return (jumps){most * plr_rates_length(rim), most * plr_rates_length(all)};
}

/* Jumps count as many as can be in each step, or one by one. */
static integral integrate_all(const plr_rates *r, const plr_rate *rate, const float *extinction,
                              double weight) {
    jumps j = jumps_of(r, rate->steep);
    const struct {
        const float *rate;
        double more;
    } ways[] = {{rate->even, j.all}, {rate->whole, j.rim}, {rate->full, 0}};
    integral best = {INFINITY, 0};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        integral found = integrate(r, ways[i].rate, extinction, weight);
        found.a += ways[i].more;
        if (found.a + weight * found.b < best.a + weight * best.b)
            best = found;
    }
    return best;
}

/* ---- All ---- */

static double opacity_at(const plr_certain *v, double value) {
    double at = fmin(fmax(value, 0), 1) * (v->texel_count - 1);
    size_t i = (size_t)fmin(at, v->texel_count - 2.0);
    double a = (double)v->texels[4 * i + 3], b = (double)v->texels[4 * i + 7];
    return a + (at - (double)i) * (b - a);
}

/* The least and the greatest of all values. */
typedef struct opacities {
    double low, high;
} opacities;

static opacities opacities_of(const plr_certain *v) {
    double low = v->bends->low, high = v->bends->high;
    double first = opacity_at(v, low), last = opacity_at(v, high);
    opacities found = {fmin(first, last), fmax(first, last)};
    for (uint32_t i = 0; i < v->texel_count; i++) {
        double value = (double)i / (v->texel_count - 1);
        double opacity = (double)v->texels[4 * (size_t)i + 3];
        if (value <= low || value >= high)
            continue;
        found.low = fmin(found.low, opacity);
        found.high = fmax(found.high, opacity);
    }
    return found;
}

/* A cast, for steps of some length. */
typedef struct state {
    plr_rates rates[MOST_VOLUMES];
    bool walls[MOST_VOLUMES]; /* opaque for all values */
    size_t count;
    plr_rates_all all;
} state;

static bool add(state *s, const plr_certain *v, double step) {
    /* beyond, values are cut off, which bends them */
    if (!(v->bends->low >= 0 && v->bends->high <= 1))
        return false;
    opacities found = opacities_of(v);
    if (found.high <= 0)
        return true;
    bool wall = found.low >= 1;
    if (found.high >= 1 && !wall)
        return false;
    plr_rates *r = &s->rates[s->count];
    s->walls[s->count++] = wall;
    if (!plr_rates_begin(r, v, step))
        return false;
    for (int k = 0; k < PLR_CHANNELS; k++) {
        plr_curve_part c = plr_curve_between(r->curves[k], v->bends->low, v->bends->high);
        s->all.low[k] = fmin(s->all.low[k], c.low);
        s->all.high[k] = fmax(s->all.high[k], c.high);
    }
    if (wall)
        return true;
    const plr_curve *tau = r->curves[PLR_CHANNELS];
    s->all.most += plr_curve_between(tau, v->bends->low, v->bends->high).high;
    s->all.strays += r->strays;
    return true;
}

static bool begin(state *s, const plr_certain *volumes, size_t count, const double *steps) {
    bool known = true;
    for (int k = 0; k < PLR_CHANNELS; k++)
        s->all.low[k] = INFINITY;
    for (size_t i = 0; known && i < count; i++)
        known = add(s, &volumes[i], steps[i]);
    s->all.many = s->count > 1;
    return known;
}

/* Of a wall the first sample is all that is seen. */
static double wall_of(const plr_rates *r, int channel) {
    double worst = 0;
    for (size_t i = 0; i < r->count; i++) {
        const plr_rates_block *b = &r->known[i];
        plr_curve_part c = plr_curve_between(r->curves[channel], b->low, b->high);
        worst = fmax(worst, fmin(c.steepest * b->slope * r->step / 2, c.high - c.low));
    }
    return worst;
}

/* T' in the middle of a step, and where it begins, times tau' sums up to so many times 1. */
static double seen_from(const state *s, const plr_rates *r, bool middle) {
    double depth = s->all.most * r->step;
    if (s->all.many)
        return exp(middle ? depth / 2 : depth);
    return middle ? 1 : 1 + depth; /* x / (1 - exp(-x)) is below */
}

/* Optical depths differ by a + b m at most, m the least that there can be along the ray: what
 * shines through by exp(-m) times that. */
static double hidden_of(integral optical) {
    double a = optical.a, b = optical.b;
    return fmin(a < b ? b * exp(a / b - 1) : a, 1);
}

static double error_of(state *s) {
    integral seen = {0, 0}, through = {0, 0};
    double rest[PLR_CHANNELS] = {0, 0, 0}, worst;
    for (size_t i = 0; i < s->count; i++) {
        plr_rates *r = &s->rates[i];
        for (int k = 0; s->walls[i] && k < PLR_CHANNELS; k++)
            rest[k] += wall_of(r, k);
        if (s->walls[i])
            continue;
        plr_rates_fill(r, &s->all);
        double middle = seen_from(s, r, true), start = seen_from(s, r, false);
        integral o = integrate_all(r, &r->optical, r->least, middle);
        seen.a += o.a;
        seen.b += middle * o.b;
        o = integrate_all(r, &r->optical, r->least, 1 / EULER);
        through.a += o.a;
        through.b = fmax(through.b, o.b);
        for (int k = 0; k < PLR_CHANNELS; k++) {
            integral odd = integrate(r, r->odd[k], r->least, start);
            integral c = {0, 0};
            if (s->all.high[k] > s->all.low[k])
                c = integrate_all(r, &r->colors[k], r->most, start);
            rest[k] += odd.a + start * odd.b + c.a + start * c.b;
        }
    }
    double hidden = hidden_of(through), all = seen.a + seen.b;
    worst = hidden;
    /* |c - B| is at most `high`; or else, t what shines through all behind, at most half of the
     * range of colours times 2 - t, and their middle times t */
    for (int k = 0; s->count && k < PLR_CHANNELS; k++) {
        double middle = (s->all.low[k] + s->all.high[k]) / 2, wide = s->all.high[k] - s->all.low[k];
        double mixed = middle * hidden + wide * all;
        worst = fmax(worst, fmin(mixed, s->all.high[k] * all) + rest[k]);
    }
    return worst;
}

double plr_certain_error(const plr_certain *volumes, size_t count, const double *steps) {
    if (count > MOST_VOLUMES)
        return INFINITY;
    state s = {.count = 0};
    double error = begin(&s, volumes, count, steps) ? error_of(&s) : INFINITY;
    for (size_t i = 0; i < s.count; i++)
        plr_rates_finish(&s.rates[i]);
    return error;
}
