/* Ear clipping: a corner is an ear where the polygon turns outward and no inward corner lies in its
 * triangle. Cutting an ear makes news of its two neighbours only, so a queue of corners to look at
 * serves each corner three times. Inward corners stand in a grid, so that small ears look at few.
 */
#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

typedef struct plr_ring {
    double x, y; /* in the plane of the polygon, counterclockwise */
    uint32_t previous, next;
    uint32_t next_in_cell;
    bool inward; /* the polygon turns inward here, or not at all */
    bool queued, cut;
} ring;

typedef struct clip {
    plr_clipper *clipper;
    ring *ring;
    uint32_t count;
    uint32_t *cells; /* grid * grid heads of lists; PLR_MESH_NONE: empty */
    uint32_t grid;
    double low[2], scale[2];
    uint32_t *queue; /* a circle of `count`; each corner stands there once at most */
    uint32_t head, waiting;
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

/* A point twice in a row, or a way there and back: cut at once, it covers nothing. */
static bool is_degenerate(const ring *a, const ring *b, const ring *d) {
    return same_place(a, b) || same_place(b, d) || same_place(a, d);
}

static bool is_ear(clip *c, uint32_t i) {
    ring *at = &c->ring[i];
    if (is_degenerate(&c->ring[at->previous], at, &c->ring[at->next]))
        return true;
    if (at->inward || !c->clipper->budget)
        return false;
    c->clipper->budget--;
    return !holds_corner(c, &c->ring[at->previous], at, &c->ring[at->next]);
}

static void enqueue(clip *c, uint32_t i) {
    if (c->ring[i].queued)
        return;
    c->ring[i].queued = true;
    uint32_t place =
        c->count - c->head > c->waiting ? c->head + c->waiting : c->waiting - (c->count - c->head);
    c->queue[place] = i;
    c->waiting++;
}

static uint32_t dequeue(clip *c) {
    uint32_t i = c->queue[c->head];
    c->head = c->head + 1 < c->count ? c->head + 1 : 0;
    c->waiting--;
    c->ring[i].queued = false;
    return i;
}

/* What has become of a neighbour of a corner just cut. */
static void look_again(clip *c, uint32_t i) {
    /* corners only turn outward: who stands in the grid was inward from the start */
    if (c->ring[i].inward)
        update_inward(c, i);
    enqueue(c, i);
}

static void cut(clip *c, uint32_t i, uint32_t *triangle) {
    ring *at = &c->ring[i];
    triangle[0] = at->previous;
    triangle[1] = i;
    triangle[2] = at->next;
    c->ring[at->previous].next = at->next;
    c->ring[at->next].previous = at->previous;
    at->inward = false;
    at->cut = true;
    look_again(c, at->previous);
    look_again(c, at->next);
}

static void start(clip *c, const plr_polygons *polygons, const plr_face *face) {
    plr_clipper *clipper = c->clipper;
    clipper->ring = plr_arena_grow(clipper->arena, clipper->ring, &clipper->ring_capacity,
                                   face->count, sizeof *clipper->ring);
    clipper->queue = plr_arena_grow(clipper->arena, clipper->queue, &clipper->queue_capacity,
                                    face->count, sizeof *clipper->queue);
    c->ring = clipper->ring;
    c->queue = clipper->queue;
    project(c, polygons, face);
    fill_grid(c);
    for (uint32_t i = 0; i < c->count; i++)
        enqueue(c, i);
}

void plr_triangulate(plr_clipper *clipper, const plr_polygons *polygons, const plr_face *face,
                     uint32_t *triangles) {
    clip c = {.clipper = clipper, .count = face->count};
    start(&c, polygons, face);
    uint32_t some = 0; /* a corner that is still there */
    for (uint32_t left = face->count; left >= 3; left--) {
        uint32_t ear = PLR_MESH_NONE;
        while (c.waiting && ear == PLR_MESH_NONE) {
            uint32_t i = dequeue(&c);
            if (!c.ring[i].cut && is_ear(&c, i))
                ear = i;
        }
        /* none all around: edges cross, nothing has area, or the budget is spent; any will do */
        if (ear == PLR_MESH_NONE)
            ear = some;
        cut(&c, ear, triangles);
        triangles += 3;
        some = c.ring[ear].next;
    }
}
