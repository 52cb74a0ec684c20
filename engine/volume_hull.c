/* Which pixels rays through volumes start from: the outline of their boxes in the picture. */
#include "engine/volume_hull.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CORNERS = 8,
    SPREAD = 4 /* points in the place of each corner, a pixel aside: none is missed by rounding */
};

typedef double point[2];

static int by_place(const void *a, const void *b) {
    const double *p = a, *q = b;
    if (p[0] != q[0])
        return p[0] < q[0] ? -1 : 1;
    return p[1] < q[1] ? -1 : p[1] > q[1];
}

static double turn(const point a, const point b, const point c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* One side of the hull of sorted points, appended to it (Andrew's monotone chain, 1979). */
static size_t add_side(const point *points, size_t count, bool back, point *hull, size_t size) {
    size_t from = size;
    for (size_t n = 0; n < count; n++) {
        const double *p = points[back ? count - 1 - n : n];
        while (size >= from + 2 && turn(hull[size - 2], hull[size - 1], p) <= 0)
            size--;
        hull[size][0] = p[0];
        hull[size++][1] = p[1];
    }
    return size - 1; /* the last point begins the other side */
}

static bool is_clear(const plr_volume_state *volume) {
    return !(volume->visible[0][0] < volume->visible[1][0]);
}

static bool add_box(const plr_volume_state *volume, const plr_frame *frame, point *points,
                    size_t *count) {
    float low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
    plr_node_numbers(volume->node, "cropMin", low, 3);
    plr_node_numbers(volume->node, "cropMax", high, 3);
    plr_matrix to_eye = plr_matrix_multiply(&frame->view, &volume->to_world);
    plr_matrix clip = plr_matrix_multiply(&frame->projection, &to_eye);
    const double *m = clip.m;
    for (int corner = 0; corner < CORNERS; corner++) {
        double p[3], q[4];
        for (int axis = 0; axis < 3; axis++) {
            double end = corner >> axis & 1 ? fmin((double)high[axis], volume->visible[1][axis])
                                            : fmax((double)low[axis], volume->visible[0][axis]);
            p[axis] = volume->dimensions[axis] * (end - 0.5);
        }
        for (int row = 0; row < 4; row++)
            q[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
        plr_matrix_point(&to_eye, p, p);
        /* what is behind the eye, or at it, may be seen anywhere */
        if (!(q[3] > 0) || (m[15] != 1 && !(p[2] < 0)) || !isfinite(q[0] / q[3] + q[1] / q[3]))
            return false;
        for (int k = 0; k < SPREAD; k++) {
            double *out = points[(*count)++];
            out[0] = q[0] / q[3] + (k & 1 ? 2 : -2) / frame->viewport[2];
            out[1] = q[1] / q[3] + (k & 2 ? 2 : -2) / frame->viewport[3];
        }
    }
    return true;
}

static void cover_all(plr_hull *hull) {
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    memcpy(hull->points, corners, sizeof corners);
    hull->count = 4;
}

void plr_volume_hull(const plr_volume_state *volumes, const size_t *members, size_t count,
                     const plr_frame *frame, plr_hull *hull) {
    point points[PLR_MOST_HULL + CORNERS * SPREAD];
    point chain[2 * (PLR_MOST_HULL + CORNERS * SPREAD) + 2];
    size_t size = 0;
    for (size_t i = 0; i < count; i++) {
        if (is_clear(&volumes[members[i]]))
            continue;
        if (!add_box(&volumes[members[i]], frame, points, &size)) {
            cover_all(hull);
            return;
        }
        qsort(points, size, sizeof *points, by_place);
        const point *sorted = (const point *)points;
        size_t found = add_side(sorted, size, false, chain, 0);
        found = add_side(sorted, size, true, chain, found);
        if (found > PLR_MOST_HULL) {
            cover_all(hull);
            return;
        }
        memcpy(points, chain, found * sizeof *chain);
        size = found;
    }
    if (!count) {
        cover_all(hull);
        return;
    }
    hull->count = (int)size;
    for (size_t i = 0; i < size; i++)
        for (int axis = 0; axis < 2; axis++)
            hull->points[i][axis] = (float)fmin(fmax(points[i][axis], -1e4), 1e4);
}
