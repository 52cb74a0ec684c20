/* Bounds of means in steps, for each block of cells with those around as far as a step reaches: a
 * place in a block is in a step that is within.
 *
 * In a step of length h around the place of its sample m the value s differs from s(m) by at most
 * S |x|, S the greatest slope. A function f of the value with the slope f' is f(m) + f'(m) (s -
 * s(m))
 * + r, where r is at most the integral, from s(m) to s, of how far f' is from f'(m): with V(u) how
 * far slopes at values within u of each other are apart,
 *
 *   |integral of f - h f(m)| <= L |integral of s - s(m)| + (2 / S) integral of (U - u) V(u) du,
 *
 * u from 0 to U = S h / 2, L the greatest |f'|; or else, with the middle of all slopes in the step
 * instead of f'(m), h^2/8 times S times how far they are apart. The integral of s - s(m) is at most
 * h^3/24 times the second derivative within cells, and (h/2 - |x|)^2/2 times the jump of the slope
 * at each face of a cell that is crossed at x (Peano's kernel of the midpoint rule). */
#include "engine/volume_rates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* So far drivers round values. */
#define ROUNDED 1e-5

double plr_rates_length(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* ---- Blocks ---- */

/* The greatest within `around` along an axis. */
static void spread(const uint32_t blocks[3], int axis, uint32_t around, const float *from,
                   float *to) {
    size_t stride = axis == 0 ? 1 : axis == 1 ? blocks[0] : (size_t)blocks[0] * blocks[1];
    size_t count = blocks[axis], all = (size_t)blocks[0] * blocks[1] * blocks[2];
    for (size_t i = 0; i < all; i += stride * count)
        for (size_t k = 0; k < count; k++) {
            size_t first = k > around ? k - around : 0;
            size_t last = k + around < count ? k + around : count - 1;
            float *out = to + i + k * stride;
            memcpy(out, from + i + first * stride, stride * sizeof *out);
            for (size_t n = first + 1; n <= last; n++) {
                const float *in = from + i + n * stride;
                for (size_t x = 0; x < stride; x++)
                    out[x] = in[x] > out[x] ? in[x] : out[x];
            }
        }
}

static void gather(plr_rates *r, float *spare) {
    const plr_bends *b = r->v->bends;
    for (int k = 0; k < PLR_BENDS; k++) {
        if (r->count == 1) {
            r->found[k][0] = b->found[k][0];
            for (size_t i = 1; i < plr_bends_count(b); i++)
                r->found[k][0] = fmaxf(r->found[k][0], b->found[k][i]);
            continue;
        }
        spread(b->blocks, 0, r->around[0], b->found[k], r->found[k]);
        spread(b->blocks, 1, r->around[1], r->found[k], spare);
        spread(b->blocks, 2, r->around[2], spare, r->found[k]);
    }
}

/* The greatest sum of (h/2 - |x|)^2/2 over places that are at least so far apart: the middle is one
 * of them, as between them the sum is convex; or else the integral and the greatest one. */
static double faces_in(double step, double apart) {
    double sum = step * step / 8;
    if (step > 32 * apart)
        return step * step * step / (24 * apart) + sum;
    for (double x = apart; x < step / 2; x += apart)
        sum += (step / 2 - x) * (step / 2 - x);
    return sum;
}

/* Whether steps that have to do with a block may reach the first or the last voxels of an axis. */
static bool is_at_end(const plr_rates *r, size_t i, int axis) {
    size_t across = axis == 0 ? 1 : axis == 1 ? r->blocks[0] : (size_t)r->blocks[0] * r->blocks[1];
    size_t at = i / across % r->blocks[axis];
    return at <= r->around[axis] || at + r->around[axis] + 1 >= r->blocks[axis];
}

/* As many faces as can be in a step. Beyond the outermost voxels values stay the same: there all of
 * the slope is a jump. */
static double jumps_of(const plr_rates *r, const double faces[3], size_t i, bool ends) {
    double each[3];
    for (int k = 0; k < 3; k++) {
        float jump = r->found[PLR_BEND_JUMP + k][i], slope = r->found[PLR_BEND_SLOPE + k][i];
        jump = ends && is_at_end(r, i, k) ? fmaxf(jump, slope) : jump;
        each[k] = (double)jump / r->v->voxel[k] * faces[k];
    }
    return plr_rates_length(each);
}

/* Of the values around only those count that a step from a place in the block can come to. */
static void narrow(const plr_rates *r, size_t i, double reach, double range[2]) {
    const float *const *found = r->v->bends->found;
    range[0] = -(double)r->found[PLR_BEND_DEPTH][i];
    range[1] = (double)r->found[PLR_BEND_HEIGHT][i];
    if (r->count == 1)
        return;
    range[0] = fmax(range[0], -(double)found[PLR_BEND_DEPTH][i] - reach);
    range[1] = fmin(range[1], (double)found[PLR_BEND_HEIGHT][i] + reach);
}

static plr_rates_block block_of(const plr_rates *r, const double faces[3], size_t i) {
    const double *voxel = r->v->voxel;
    double slope[3], twist[3];
    for (int k = 0; k < 3; k++) {
        slope[k] = (double)r->found[PLR_BEND_SLOPE + k][i] / voxel[k];
        twist[k] =
            (double)r->found[PLR_BEND_TWIST + k][i] / (voxel[(k + 1) % 3] * voxel[(k + 2) % 3]);
    }
    /* the second derivative is what a symmetric matrix without a diagonal makes of a direction: its
     * eigenvalues sum up to 0, their squares to the norm's, so none is above sqrt(2/3) of it */
    double second = sqrt(4.0 / 3) * plr_rates_length(twist);
    double rise = plr_rates_length(slope), range[2], near[2];
    narrow(r, i, rise * r->step, range);
    narrow(r, i, rise * r->step / 2, near);
    return (plr_rates_block){.low = range[0],
                             .high = range[1],
                             .near = {near[0], near[1]},
                             .slope = rise,
                             .even = second * r->step * r->step / 24,
                             .jumps = jumps_of(r, faces, i, false),
                             .ends = jumps_of(r, faces, i, true)};
}

static void know_blocks(plr_rates *r) {
    double faces[3];
    for (int k = 0; k < 3; k++)
        faces[k] = faces_in(r->step, r->v->voxel[k]) / r->step;
    for (size_t i = 0; i < r->count; i++)
        r->known[i] = block_of(r, faces, i);
}

/* ---- Functions ---- */

/* In a step that a block has to do with. */
typedef struct change {
    double low, high;
    double steepest; /* by values */
    double rise;     /* per unit of length */
    double mean[3];  /* of f - f(m), at most, without jumps, with them, and with all */
} change;

static change change_of(const plr_curve *c, const plr_rates_block *b, double step) {
    plr_curve_part part = plr_curve_between(c, b->low, b->high);
    double turns = part.turns * b->slope * step / 8, wide = part.high - part.low;
    if (b->slope > 0 && part.turns > 0) {
        double bend = plr_curve_bend(c, b->low, b->high, b->slope * step / 2);
        turns = fmin(turns, 2 * bend / (b->slope * step));
    }
    change found = {.low = part.low,
                    .high = part.high,
                    .steepest = part.steepest,
                    .rise = part.steepest * b->slope};
    const double jumps[] = {0, b->jumps, b->ends};
    for (int k = 0; k < 3; k++)
        found.mean[k] = fmin(part.steepest * (b->even + jumps[k] + ROUNDED) + turns, wide);
    return found;
}

static void put(plr_rate *rate, size_t i, const change *c, double more, double times) {
    rate->even[i] = (float)(times * (c->mean[0] + more));
    rate->whole[i] = (float)(times * (c->mean[1] + more));
    rate->full[i] = (float)(times * (c->mean[2] + more));
    rate->steep[i] = (float)(times * c->steepest);
}

/* What plr_certain_error calls I and II but for their mean parts. */
static double odd_of(const plr_rates_all *all, int channel, const change *tau, const change *c,
                     double h) {
    double wide = tau->high - tau->low, high = all->high[channel];
    double most = all->many ? all->most : tau->high;
    double own = high * fmin(tau->rise * tau->rise * h * h * h / 64, wide * wide * h / 4);
    double both =
        fmin(c->rise * tau->rise * h * h / 12, (c->high - c->low) * wide * (1 + most * h / 2));
    double others = high * all->strays + all->most * (high - all->low[channel]);
    return own + both + (all->many ? others * tau->rise * h * h / 12 : 0);
}

bool plr_rates_begin(plr_rates *r, const plr_certain *v, double step) {
    const plr_bends *b = v->bends;
    bool whole = true;
    *r = (plr_rates){.v = v, .step = step};
    for (int k = 0; k < 3; k++) {
        double around = ceil(step / (b->cells * v->voxel[k]));
        r->around[k] = around < b->blocks[k] ? (uint32_t)around : b->blocks[k];
        whole = whole && r->around[k] + 1 >= b->blocks[k];
    }
    for (int k = 0; k < 3; k++)
        r->blocks[k] = whole ? 1 : b->blocks[k];
    r->count = whole ? 1 : plr_bends_count(b);
    float **rows[PLR_BENDS + 7 + 5 * PLR_CHANNELS], *spare;
    size_t used = 0;
    for (int k = 0; k < PLR_BENDS; k++)
        rows[used++] = &r->found[k];
    rows[used++] = &spare;
    rows[used++] = &r->least;
    rows[used++] = &r->most;
    for (int k = 0; k <= PLR_CHANNELS; k++) {
        plr_rate *rate = k < PLR_CHANNELS ? &r->colors[k] : &r->optical;
        rows[used++] = &rate->even;
        rows[used++] = &rate->whole;
        rows[used++] = &rate->full;
        rows[used++] = &rate->steep;
        if (k < PLR_CHANNELS)
            rows[used++] = &r->odd[k];
    }
    r->known = malloc(r->count * sizeof *r->known);
    r->numbers = calloc(used * r->count, sizeof *r->numbers);
    if (!r->known || !r->numbers)
        return false;
    for (size_t k = 0; k < used; k++)
        *rows[k] = r->numbers + k * r->count;
    gather(r, spare);
    know_blocks(r);
    double slope = 0;
    for (size_t i = 0; i < r->count; i++)
        slope = fmax(slope, r->known[i].slope);
    for (int k = 0; k <= PLR_CHANNELS; k++) {
        plr_curve_desc desc = {v->texels, v->texel_count,  k, v->reference, b->low,
                               b->high,   slope * step / 2};
        r->curves[k] = plr_curve_make(&desc);
        if (!r->curves[k])
            return false;
    }
    for (size_t i = 0; i < r->count; i++) {
        const plr_rates_block *k = &r->known[i];
        plr_curve_part tau = plr_curve_between(r->curves[PLR_CHANNELS], k->low, k->high);
        r->strays = fmax(r->strays, fmin(tau.steepest * k->slope * step / 2, tau.high - tau.low));
    }
    return true;
}

void plr_rates_fill(plr_rates *r, const plr_rates_all *all) {
    double h = r->step;
    for (size_t i = 0; i < r->count; i++) {
        const plr_rates_block *b = &r->known[i];
        change tau = change_of(r->curves[PLR_CHANNELS], b, h);
        put(&r->optical, i, &tau, 0, 1);
        plr_curve_part near = plr_curve_between(r->curves[PLR_CHANNELS], b->near[0], b->near[1]);
        r->least[i] = (float)fmax(near.low, 0);
        r->most[i] = (float)tau.high;
        for (int k = 0; k < PLR_CHANNELS; k++) {
            change c = {.low = all->low[k], .high = all->low[k]};
            if (all->high[k] - all->low[k] > 1e-6)
                c = change_of(r->curves[k], b, h);
            double most = all->many ? all->most : tau.high;
            double odd = fmin(most * c.rise * h * h / 12, c.high - c.low);
            put(&r->colors[k], i, &c, odd, tau.high);
            r->odd[k][i] = (float)odd_of(all, k, &tau, &c, h);
        }
    }
}

void plr_rates_finish(plr_rates *r) {
    for (int k = 0; k <= PLR_CHANNELS; k++)
        plr_curve_free(r->curves[k]);
    free(r->numbers);
    free(r->known);
}
