/* Areas that contours bound: holes are joined to what they are in by a bridge, there and back,
 * which leaves one polygon that ears are clipped from. */
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

typedef struct contour {
    uint32_t first, count; /* points in the order of the outline */
    double area;           /* positive: counterclockwise */
    uint32_t parent;       /* of a hole: the contour that it is in */
} contour;

/* A polygon under construction: numbers of points. */
typedef struct path {
    uint32_t *items;
    size_t count, capacity;
} path;

typedef struct outline {
    plr_polygons *polygons;
    const double (*points)[2];
    contour *contours;
    size_t contour_count;
    path path;
} outline;

static double turn(const double a[2], const double b[2], const double c[2]) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double area_of(const outline *o, const contour *c) {
    double sum = 0;
    const double *origin = o->points[c->first];
    for (uint32_t i = 1; i + 1 < c->count; i++)
        sum += turn(origin, o->points[c->first + i], o->points[c->first + i + 1]);
    return sum / 2;
}

static bool holds(const outline *o, const contour *c, const double point[2]) {
    bool inside = false;
    for (uint32_t i = 0, j = c->count - 1; i < c->count; j = i++) {
        const double *a = o->points[c->first + i], *b = o->points[c->first + j];
        if ((a[1] > point[1]) != (b[1] > point[1]) &&
            point[0] < a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]))
            inside = !inside;
    }
    return inside;
}

/* The smallest outer contour around a hole; PLR_MESH_NONE: it is none. */
static uint32_t find_parent(const outline *o, const contour *hole) {
    uint32_t found = PLR_MESH_NONE;
    for (uint32_t i = 0; i < o->contour_count; i++) {
        const contour *c = &o->contours[i];
        if (c->area > 0 && holds(o, c, o->points[hole->first]) &&
            (found == PLR_MESH_NONE || c->area < o->contours[found].area))
            found = i;
    }
    return found;
}

/* Whether the way from the corner `at` of the path to `point` begins inside. */
static bool opens_to(const outline *o, size_t at, const double point[2]) {
    const path *p = &o->path;
    const double *here = o->points[p->items[at]];
    const double *before = o->points[p->items[at ? at - 1 : p->count - 1]];
    const double *after = o->points[p->items[at + 1 < p->count ? at + 1 : 0]];
    if (turn(before, here, after) > 0)
        return turn(before, here, point) >= 0 && turn(here, after, point) >= 0;
    return turn(before, here, point) >= 0 || turn(here, after, point) >= 0;
}

/* The edge of the path that a ray from `point` to +X meets first: the number of its first corner;
 * `x`: where. The path runs counterclockwise, so from inside edges to the right run upward. */
static size_t first_edge(const outline *o, const double point[2], double *x) {
    const path *p = &o->path;
    size_t found = SIZE_MAX;
    *x = INFINITY;
    for (size_t i = 0; i < p->count; i++) {
        const double *a = o->points[p->items[i]], *b = o->points[p->items[(i + 1) % p->count]];
        if (!(a[1] <= point[1] && point[1] < b[1]))
            continue;
        double at = a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]);
        if (at >= point[0] && at < *x) {
            *x = at;
            found = i;
        }
    }
    return found;
}

/* The corner of the path that is seen from `point`, which lies inside and left of some edge. Of the
 * edge that a ray meets first the right end is seen, unless corners stand before it, in the
 * triangle of point, meeting and end; of these the one nearest to the ray's direction is. */
static size_t find_visible(const outline *o, const double point[2]) {
    double x;
    size_t edge = first_edge(o, point, &x);
    if (edge == SIZE_MAX)
        return SIZE_MAX;
    const path *p = &o->path;
    size_t next = (edge + 1) % p->count;
    size_t best = o->points[p->items[edge]][0] > o->points[p->items[next]][0] ? edge : next;
    const double *end = o->points[p->items[best]], meeting[2] = {x, point[1]};
    bool above = end[1] > point[1];
    const double *low = above ? meeting : end, *high = above ? end : meeting;
    double slope = INFINITY, distance = INFINITY;
    for (size_t i = 0; i < p->count; i++) {
        const double *c = o->points[p->items[i]];
        double dx = c[0] - point[0], dy = fabs(c[1] - point[1]);
        if (!(dx >= 0) || turn(point, low, c) < 0 || turn(low, high, c) < 0 ||
            turn(high, point, c) < 0 || !opens_to(o, i, point))
            continue;
        double s = dx > 0 ? dy / dx : dy > 0 ? INFINITY : 0;
        if (s < slope || (s == slope && dx < distance)) {
            slope = s;
            distance = dx;
            best = i;
        }
    }
    return best;
}

static void append(outline *o, uint32_t point) {
    *PLR_PUSH(o->polygons->arena, &o->path) = point;
}

static void join_hole(outline *o, const contour *hole) {
    uint32_t rightmost = hole->first;
    for (uint32_t i = 1; i < hole->count; i++)
        if (o->points[hole->first + i][0] > o->points[rightmost][0])
            rightmost = hole->first + i;
    size_t at = find_visible(o, o->points[rightmost]);
    if (at == SIZE_MAX)
        return; /* not inside after all */
    /* path[0..at], the hole from its rightmost point around to it, path[at] again, and the rest */
    size_t before = o->path.count, extra = (size_t)hole->count + 2;
    for (size_t i = 0; i < extra; i++)
        append(o, 0);
    uint32_t *items = o->path.items;
    memmove(items + at + 1 + extra, items + at + 1, (before - at - 1) * sizeof *items);
    for (uint32_t i = 0; i <= hole->count; i++)
        items[at + 1 + i] = hole->first + (rightmost - hole->first + i) % hole->count;
    items[at + extra] = items[at];
}

/* The next hole to be joined to `parent`: the one that reaches farthest right of those left. */
static contour *next_hole(outline *o, uint32_t parent) {
    contour *found = NULL;
    double reach = -INFINITY;
    for (size_t i = 0; i < o->contour_count; i++) {
        contour *c = &o->contours[i];
        if (c->parent != parent || c->area > 0)
            continue;
        for (uint32_t k = 0; k < c->count; k++)
            if (o->points[c->first + k][0] > reach) {
                reach = o->points[c->first + k][0];
                found = c;
            }
    }
    if (found)
        found->parent = PLR_MESH_NONE; /* taken */
    return found;
}

static void add_area(outline *o, uint32_t number, uint32_t coord) {
    plr_polygons *p = o->polygons;
    const contour *c = &o->contours[number];
    o->path.count = 0;
    for (uint32_t i = 0; i < c->count; i++)
        append(o, c->first + i);
    for (contour *hole; (hole = next_hole(o, number));)
        join_hole(o, hole);
    plr_face face = {(uint32_t)p->corners.count, (uint32_t)o->path.count};
    for (size_t i = 0; i < o->path.count; i++) {
        uint32_t at = coord + o->path.items[i];
        *PLR_PUSH(p->arena, &p->corners) = (plr_corner){at, 0, PLR_MESH_NONE, at};
    }
    *PLR_PUSH(p->arena, &p->faces) = face;
}

static void reverse(contour *c, double (*points)[2]) {
    c->area = -c->area;
    for (uint32_t a = c->first, b = c->first + c->count - 1; a < b; a++, b--) {
        double kept[2];
        memcpy(kept, points[a], sizeof kept);
        memcpy(points[a], points[b], sizeof kept);
        memcpy(points[b], kept, sizeof kept);
    }
}

/* Outer contours counterclockwise, which most of the area is in; holes find what they are in. What
 * runs like a hole and is in nothing is an area of its own: fonts have such slips. */
static void orient(outline *o, double (*points)[2]) {
    double sum = 0;
    for (size_t i = 0; i < o->contour_count; i++)
        sum += o->contours[i].area = area_of(o, &o->contours[i]);
    for (size_t i = 0; sum < 0 && i < o->contour_count; i++)
        reverse(&o->contours[i], points);
    for (size_t i = 0; i < o->contour_count; i++) {
        contour *c = &o->contours[i];
        c->parent = c->area < 0 ? find_parent(o, c) : PLR_MESH_NONE;
    }
    for (size_t i = 0; i < o->contour_count; i++)
        if (o->contours[i].area < 0 && o->contours[i].parent == PLR_MESH_NONE)
            reverse(&o->contours[i], points);
}

void plr_polygons_add_outline(plr_polygons *polygons, double (*points)[2], const uint32_t *ends,
                              size_t contour_count, uint32_t coord) {
    outline o = {.polygons = polygons,
                 .points = (const double(*)[2])points,
                 .contours = PLR_NEW_ARRAY(polygons->arena, contour_count, contour),
                 .contour_count = contour_count};
    uint32_t first = 0;
    for (size_t i = 0; i < contour_count; first = ends[i++])
        o.contours[i] = (contour){.first = first, .count = ends[i] - first};
    orient(&o, points);
    for (uint32_t i = 0; i < contour_count; i++)
        if (o.contours[i].area > 0)
            add_area(&o, i, coord);
}
