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

static void cut(double at, double growth, double *enter, double *leave) {
    /* keeps where at + t growth >= 0 */
    if (growth > 0)
        *enter = fmax(*enter, -at / growth);
    else if (growth < 0)
        *leave = fmin(*leave, -at / growth);
    else if (at < 0)
        *leave = -INFINITY;
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
    for (int i = 0; i < 3; i++) {
        double at = place[i] / volume->dimensions[i] + 0.5;
        double growth = along[i] / volume->dimensions[i];
        cut(at - fmax(volume->crop_min[i], 0), growth, &walk->enter, &walk->leave);
        cut(fmin(volume->crop_max[i], 1) - at, -growth, &walk->enter, &walk->leave);
        walk->voxels.start[i] = at * volume->voxels.size[i] - 0.5;
        walk->voxels.way[i] = growth * volume->voxels.size[i];
        walk->labels.start[i] = at * volume->labels.size[i];
        walk->labels.way[i] = growth * volume->labels.size[i];
    }
    for (size_t k = 0; k < volume->plane_count; k++) {
        const double *p = volume->planes[k];
        cut(p[0] * origin[0] + p[1] * origin[1] + p[2] * origin[2] + p[3],
            p[0] * way[0] + p[1] * way[1] + p[2] * way[2], &walk->enter, &walk->leave);
    }
    if (!(walk->enter < walk->leave))
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

static const ref_transfer *transfer_here(const ref_walk *walk) {
    const ref_volume *volume = walk->volume;
    if (!volume->labels.data)
        return &volume->transfers[0];
    double label = ref_grid_at(&volume->labels, walk->labels.cell);
    double last = (double)(volume->transfer_count - 1);
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
    walk->transfer = transfer_here(walk);
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

/* ambient c + diffuse |n.l| c + specular |n.h|^power; light and viewer are in one place, h = l. */
static void shade(const ref_walk *walk, double t, double color[3]) {
    const ref_shading *shading = &walk->volume->shading;
    double n[3], length = 0, facing = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = ref_cubic_at(walk->gradient[k], t - walk->base);
        length += n[k] * n[k];
        facing += n[k] * walk->to_light[k];
    }
    facing = length > 0 ? fmin(fabs(facing) / sqrt(length), 1) : 0;
    double shine = facing > 0 ? shading->specular * pow(facing, shading->power) : 0;
    for (int k = 0; k < 3; k++) {
        color[k] = (shading->ambient + shading->diffuse * facing) * color[k] + shine;
        if (!shading->unclamped)
            color[k] = fmin(fmax(color[k], 0), 1);
    }
}

void ref_walk_color(const ref_walk *walk, double t, double value, double color[3]) {
    const ref_interval *i = walk->interval;
    for (int k = 0; k < 3; k++)
        color[k] = i->base[k] + i->slope[k] * (value - i->anchor);
    if (walk->volume->shading.used)
        shade(walk, t, color);
}
