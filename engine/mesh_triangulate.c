/* Ear clipping: a corner is an ear where the polygon turns outward and no inward corner lies in its
 * triangle. Inward corners stand in a grid, so that small ears look at few of them. */
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

typedef struct plr_ring {
    double x, y; /* in the plane of the polygon, counterclockwise */
    uint32_t previous, next;
    uint32_t next_in_cell;
    bool inward; /* the polygon turns inward here, or not at all */
} ring;

typedef struct clip {
    plr_clipper *clipper;
    ring *ring;
    uint32_t count;
    uint32_t *cells; /* grid * grid heads of lists; PLR_MESH_NONE: empty */
    uint32_t grid;
    double low[2], scale[2];
} clip;

static double turn(const ring *a, const ring *b, const ring *c) {
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* The coordinates that remain when the axis along which the normal is longest is dropped. */
static void project(clip *c, const plr_polygons *polygons, const plr_face *face) {
    double normal[3];
    plr_face_normal(polygons, face, normal);
    int drop = fabs(normal[0]) > fabs(normal[1]) ? 0 : 1;
    if (fabs(normal[2]) >= fabs(normal[drop]))
        drop = 2;
    int u = (drop + 1) % 3, v = (drop + 2) % 3;
    double mirror = normal[drop] < 0 ? -1 : 1;
    for (uint32_t i = 0; i < c->count; i++) {
        size_t coord = polygons->corners.items[face->first + i].coord;
        const float *point = polygons->points + coord * 3;
        c->ring[i] = (ring){.x = (double)point[u] * mirror,
                            .y = (double)point[v],
                            .previous = i ? i - 1 : c->count - 1,
                            .next = i + 1 < c->count ? i + 1 : 0,
                            .next_in_cell = PLR_MESH_NONE};
    }
}

static void update_inward(clip *c, uint32_t i) {
    ring *at = &c->ring[i];
    at->inward = !(turn(&c->ring[at->previous], at, &c->ring[at->next]) > 0);
}

static uint32_t cell_of(const clip *c, double value, int axis) {
    double cell = (value - c->low[axis]) * c->scale[axis];
    return cell <= 0 ? 0 : cell >= c->grid - 1 ? c->grid - 1 : (uint32_t)cell;
}

static void fill_grid(clip *c) {
    uint32_t inward = 0;
    double high[2] = {-INFINITY, -INFINITY};
    c->low[0] = c->low[1] = INFINITY;
    for (uint32_t i = 0; i < c->count; i++) {
        update_inward(c, i);
        inward += c->ring[i].inward;
        c->low[0] = fmin(c->low[0], c->ring[i].x);
        c->low[1] = fmin(c->low[1], c->ring[i].y);
        high[0] = fmax(high[0], c->ring[i].x);
        high[1] = fmax(high[1], c->ring[i].y);
    }
    c->grid = (uint32_t)fmin(ceil(sqrt((double)inward)) + 1, 2048);
    size_t cells = (size_t)c->grid * c->grid;
    plr_clipper *clipper = c->clipper;
    clipper->cells = plr_arena_grow(clipper->arena, clipper->cells, &clipper->cell_capacity, cells,
                                    sizeof *clipper->cells);
    c->cells = clipper->cells;
    memset(c->cells, 0xff, cells * sizeof *c->cells);
    for (int axis = 0; axis < 2; axis++)
        c->scale[axis] = high[axis] > c->low[axis] ? c->grid / (high[axis] - c->low[axis]) : 0;
    for (uint32_t i = 0; i < c->count; i++) {
        ring *at = &c->ring[i];
        if (!at->inward)
            continue;
        uint32_t *head = &c->cells[cell_of(c, at->y, 1) * (size_t)c->grid + cell_of(c, at->x, 0)];
        at->next_in_cell = *head;
        *head = i;
    }
}

static bool same_place(const ring *a, const ring *b) {
    return a->x == b->x && a->y == b->y;
}

/* Whether an inward corner that is still there lies in the triangle or on its border; one that
 * stands in the place of a corner of the triangle does not count. */
static bool holds_corner(clip *c, const ring *a, const ring *b, const ring *d) {
    uint32_t x0 = cell_of(c, fmin(a->x, fmin(b->x, d->x)), 0);
    uint32_t x1 = cell_of(c, fmax(a->x, fmax(b->x, d->x)), 0);
    uint32_t y0 = cell_of(c, fmin(a->y, fmin(b->y, d->y)), 1);
    uint32_t y1 = cell_of(c, fmax(a->y, fmax(b->y, d->y)), 1);
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t x = x0; x <= x1; x++) {
            c->clipper->budget -= c->clipper->budget > 0;
            uint32_t i = c->cells[y * (size_t)c->grid + x];
            for (; i != PLR_MESH_NONE; i = c->ring[i].next_in_cell) {
                const ring *p = &c->ring[i];
                c->clipper->budget -= c->clipper->budget > 0;
                if (p->inward && turn(a, b, p) >= 0 && turn(b, d, p) >= 0 && turn(d, a, p) >= 0 &&
                    !same_place(p, a) && !same_place(p, b) && !same_place(p, d))
                    return true;
            }
        }
    return false;
}

static bool is_ear(clip *c, uint32_t i) {
    ring *at = &c->ring[i];
    if (at->inward || !c->clipper->budget)
        return false;
    c->clipper->budget--;
    return !holds_corner(c, &c->ring[at->previous], at, &c->ring[at->next]);
}

static void cut(clip *c, uint32_t i, uint32_t *triangle) {
    ring *at = &c->ring[i];
    triangle[0] = at->previous;
    triangle[1] = i;
    triangle[2] = at->next;
    c->ring[at->previous].next = at->next;
    c->ring[at->next].previous = at->previous;
    at->inward = false;
    /* corners only turn outward: who stands in the grid was inward from the start */
    if (c->ring[at->previous].inward)
        update_inward(c, at->previous);
    if (c->ring[at->next].inward)
        update_inward(c, at->next);
}

void plr_triangulate(plr_clipper *clipper, const plr_polygons *polygons, const plr_face *face,
                     uint32_t *triangles) {
    clip c = {.clipper = clipper, .count = face->count};
    clipper->ring = plr_arena_grow(clipper->arena, clipper->ring, &clipper->ring_capacity,
                                   face->count, sizeof *clipper->ring);
    c.ring = clipper->ring;
    project(&c, polygons, face);
    fill_grid(&c);
    uint32_t at = 0, left = face->count, refused = 0;
    while (left > 3) {
        /* no ear all around (crossing edges, no area) or no patience left: any corner will do */
        if (is_ear(&c, at) || refused >= left || !clipper->budget) {
            uint32_t next = c.ring[at].next;
            cut(&c, at, triangles);
            triangles += 3;
            left--;
            refused = 0;
            at = c.ring[next].next; /* not the neighbour: fewer slivers */
        } else {
            refused++;
            at = c.ring[at].next;
        }
    }
    cut(&c, at, triangles);
}
