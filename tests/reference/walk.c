/* One volume on one ray: entry and exit, cells, what is known in a cell. */
#include "walk.h"

#include <math.h>
#include <string.h>

static const double ROUNDING = 1e-12; /* of the way through a volume */

void ref_steps_begin(ref_steps *steps, double t) {
    for (int i = 0; i < 3; i++) {
        double way = steps->way[i], at = steps->start[i] + t * way;
        double face = way > 0 ? floor(at) - 1 : ceil(at) + 1;
        steps->next[i] = INFINITY;
        steps->cell[i] = (int)floor(at);
        if (way == 0)
            continue;
        /* the first face behind t, by the numbers that later faces have */
        double sign = way > 0 ? 1 : -1;
        while ((face - steps->start[i]) / way <= t)
            face += sign;
        steps->next[i] = (face - steps->start[i]) / way;
        steps->cell[i] = (int)face - (way > 0);
    }
}

double ref_steps_next(const ref_steps *steps) {
    return fmin(steps->next[0], fmin(steps->next[1], steps->next[2]));
}

bool ref_steps_pass(ref_steps *steps, double t) {
    bool passed = false;
    for (int i = 0; i < 3; i++)
        while (steps->next[i] <= t) {
            bool up = steps->way[i] > 0;
            steps->cell[i] += up ? 1 : -1;
            steps->next[i] = (steps->cell[i] + up - steps->start[i]) / steps->way[i];
            passed = true;
        }
    return passed;
}

/* Keeps where at + t growth >= 0. Returns whether rounding decides on all of the ray. */
static bool cut(double at, double growth, double *enter, double *leave) {
    if (growth > 0)
        *enter = fmax(*enter, -at / growth);
    else if (growth < 0)
        *leave = fmin(*leave, -at / growth);
    else if (at < 0)
        *leave = -INFINITY;
    return growth == 0 && fabs(at) < ROUNDING;
}

bool ref_walk_begin(ref_walk *walk, const ref_volume *volume, const double origin[3],
                    const double way[3], double start, double limit) {
    memset(walk, 0, sizeof *walk);
    walk->volume = volume;
    double place[3], along[3];
    ref_matrix_point(volume->to_own, origin, 1, place);
    ref_matrix_point(volume->to_own, way, 0, along);
    walk->speed = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]) /
                  volume->reference_length;
    walk->enter = start;
    walk->leave = limit;
    bool grazes = false;
    for (int i = 0; i < 3; i++) {
        double at = place[i] / volume->dimensions[i] + 0.5;
        double growth = along[i] / volume->dimensions[i];
        double low = fmax(volume->crop_min[i], 0), high = fmin(volume->crop_max[i], 1);
        grazes |= cut(at - low, growth, &walk->enter, &walk->leave);
        grazes |= cut(high - at, -growth, &walk->enter, &walk->leave);
        walk->voxels.start[i] = at * volume->voxels.size[i] - 0.5;
        walk->voxels.way[i] = growth * volume->voxels.size[i];
        walk->labels.start[i] = at * volume->labels.size[i];
        walk->labels.way[i] = growth * volume->labels.size[i];
    }
    for (size_t k = 0; k < volume->plane_count; k++) {
        const double *p = volume->planes[k];
        grazes |= cut(p[0] * origin[0] + p[1] * origin[1] + p[2] * origin[2] + p[3],
                      p[0] * way[0] + p[1] * way[1] + p[2] * way[2], &walk->enter, &walk->leave);
    }
    /* through an edge, or along a face */
    double chord = walk->leave - walk->enter;
    walk->is_uncertain = grazes || fabs(chord) < ROUNDING * (1 + fabs(walk->enter));
    if (!(chord > 0))
        return false;
    /* faces of cells that coincide with the entry, or the exit, are none */
    double first = walk->enter + ROUNDING * (walk->leave - walk->enter);
    ref_steps_begin(&walk->voxels, first);
    if (volume->labels.data)
        ref_steps_begin(&walk->labels, first);
    return true;
}

bool ref_walk_inside(const ref_walk *walk, double t) {
    double near = ROUNDING * (walk->leave - walk->enter);
    return t > walk->enter + near && t < walk->leave - near;
}

double ref_walk_value(const ref_walk *walk, double t) {
    return ref_cubic_at(walk->value, t - walk->base);
}

double ref_walk_next(const ref_walk *walk) {
    double next = ref_steps_next(&walk->voxels);
    if (walk->volume->labels.data)
        next = fmin(next, ref_steps_next(&walk->labels));
    return next < walk->leave - ROUNDING * (walk->leave - walk->enter) ? next : walk->leave;
}

static double mapped(const ref_volume *volume, double stored) {
    double low = volume->range[0], high = volume->range[1];
    if (!isfinite(stored) || !(high > low))
        return 0;
    return fmin(fmax((stored - low) / (high - low) + volume->change, 0), 1);
}

static const ref_transfer *transfer_here(ref_walk *walk) {
    const ref_volume *volume = walk->volume;
    if (!volume->labels.data)
        return &volume->transfers[0];
    double label = ref_grid_at(&volume->labels, walk->labels.cell);
    double last = (double)(volume->transfer_count - 1);
    for (int i = 0; i < 3; i++) {
        /* along the face between two labels */
        double at = walk->labels.start[i];
        int beside[3] = {walk->labels.cell[0], walk->labels.cell[1], walk->labels.cell[2]};
        if (walk->labels.way[i] != 0 || fabs(at - round(at)) > ROUNDING)
            continue;
        beside[i] += at < beside[i] + 0.5 ? -1 : 1;
        walk->is_uncertain |= ref_grid_at(&volume->labels, beside) != label;
    }
    return &volume->transfers[(size_t)fmin(fmax(label, 0), last)];
}

/* Central differences at the 8 corners of the cell, value per length of the world. */
static void read_gradient(ref_walk *walk, const double start[3]) {
    const ref_volume *volume = walk->volume;
    double slopes[3][8];
    for (int i = 0; i < 8; i++) {
        for (int axis = 0; axis < 3; axis++) {
            double ends[2];
            for (int side = 0; side < 2; side++) {
                /* beyond the outermost centres everything is as at these */
                int at[3];
                for (int k = 0; k < 3; k++) {
                    int size = volume->voxels.size[k], here = walk->voxels.cell[k] + (i >> k & 1);
                    at[k] = here < 0 ? 0 : here < size ? here : size - 1;
                }
                at[axis] += 2 * side - 1;
                ends[side] = mapped(volume, ref_grid_at(&volume->voxels, at));
            }
            slopes[axis][i] =
                (ends[1] - ends[0]) / 2 * volume->voxels.size[axis] / volume->dimensions[axis];
        }
        double own[3] = {slopes[0][i], slopes[1][i], slopes[2][i]};
        for (int k = 0; k < 3; k++) /* as a covector */
            slopes[k][i] = own[0] * volume->to_own[k] + own[1] * volume->to_own[4 + k] +
                           own[2] * volume->to_own[8 + k];
    }
    for (int k = 0; k < 3; k++)
        ref_cubic_of_cell(slopes[k], start, walk->voxels.way, walk->gradient[k]);
}

void ref_walk_read(ref_walk *walk, double t) {
    if (walk->is_read)
        return;
    walk->is_read = true;
    double corners[8], least = INFINITY, greatest = -INFINITY;
    ref_grid_corners(&walk->volume->voxels, walk->voxels.cell, corners);
    for (int i = 0; i < 8; i++) {
        corners[i] = mapped(walk->volume, corners[i]);
        least = fmin(least, corners[i]);
        greatest = fmax(greatest, corners[i]);
    }
    const ref_transfer *transfer = transfer_here(walk);
    if (transfer != walk->transfer)
        walk->label_from = t;
    walk->transfer = transfer;
    walk->is_clear = ref_transfer_clear(walk->transfer, least, greatest);
    if (walk->is_clear)
        return;
    walk->base = t;
    double start[3];
    for (int i = 0; i < 3; i++)
        start[i] = walk->voxels.start[i] + t * walk->voxels.way[i] - walk->voxels.cell[i];
    ref_cubic_of_cell(corners, start, walk->voxels.way, walk->value);
    if (walk->volume->shading.used)
        read_gradient(walk, start);
}

void ref_walk_pass(ref_walk *walk, double t) {
    if (ref_steps_pass(&walk->voxels, t))
        walk->is_read = false;
    if (walk->volume->labels.data && ref_steps_pass(&walk->labels, t))
        walk->is_read = false;
}

void ref_interval_color(const ref_interval *interval, double value, double color[3]) {
    for (int k = 0; k < 3; k++)
        color[k] = interval->base[k] + interval->slope[k] * (value - interval->anchor);
}

void ref_walk_color(const ref_walk *walk, double t, double value, double color[3]) {
    ref_interval_color(walk->interval, value, color);
    if (!walk->volume->shading.used)
        return;
    ref_light(walk, t, color);
    for (int k = 0; k < 3 && !walk->volume->shading.unclamped; k++)
        color[k] = fmin(color[k], 1);
}
