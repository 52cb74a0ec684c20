#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

void plr_face_normal(const plr_polygons *polygons, const plr_face *face, double normal[3]) {
    normal[0] = normal[1] = normal[2] = 0;
    const plr_corner *corners = polygons->corners.items + face->first;
    /* relative to the first corner, so that far-away shapes keep their digits */
    const float *origin = polygons->points + (size_t)corners[0].coord * 3;
    for (uint32_t i = 1; i + 1 < face->count; i++) {
        const float *a = polygons->points + (size_t)corners[i].coord * 3;
        const float *b = polygons->points + (size_t)corners[i + 1].coord * 3;
        double u[3], v[3];
        for (int axis = 0; axis < 3; axis++) {
            u[axis] = (double)a[axis] - (double)origin[axis];
            v[axis] = (double)b[axis] - (double)origin[axis];
        }
        normal[0] += u[1] * v[2] - u[2] * v[1];
        normal[1] += u[2] * v[0] - u[0] * v[2];
        normal[2] += u[0] * v[1] - u[1] * v[0];
    }
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Sets of corners that share a normal: a forest with path halving. */
static uint32_t find_set(uint32_t *parents, uint32_t corner) {
    while (parents[corner] != corner) {
        parents[corner] = parents[parents[corner]];
        corner = parents[corner];
    }
    return corner;
}

static void join_sets(uint32_t *parents, uint32_t a, uint32_t b) {
    a = find_set(parents, a);
    b = find_set(parents, b);
    if (a < b)
        parents[b] = a;
    else
        parents[a] = b;
}

/* The last face that an edge was met in: corners at its lower and its higher coordinate. */
typedef struct edge {
    uint32_t low, high; /* coordinates */
    uint32_t low_corner, high_corner;
    uint32_t face; /* plus 1; 0: empty */
} edge;

static edge *find_edge(edge *edges, size_t mask, uint32_t low, uint32_t high) {
    uint64_t hash = ((uint64_t)low << 32 | high) * UINT64_C(0x9e3779b97f4a7c15);
    size_t slot = (size_t)(hash >> 20) & mask;
    while (edges[slot].face && (edges[slot].low != low || edges[slot].high != high))
        slot = (slot + 1) & mask;
    return &edges[slot];
}

/* Joins the corners of neighbours whose angle is below the crease angle. */
static void join_across_edges(const plr_polygons *polygons, double (*face_normals)[3],
                              double crease, uint32_t *parents) {
    size_t size = 16;
    while (size < polygons->corners.count * 2)
        size *= 2;
    edge *edges = PLR_NEW_ARRAY(polygons->arena, size, edge);
    double limit = cos(crease);
    for (uint32_t f = 0; f < polygons->faces.count; f++) {
        plr_face face = polygons->faces.items[f];
        for (uint32_t i = 0; i < face.count; i++) {
            uint32_t a = face.first + i, b = face.first + (i + 1) % face.count;
            if (polygons->corners.items[a].coord > polygons->corners.items[b].coord) {
                uint32_t swap = a;
                a = b;
                b = swap;
            }
            uint32_t low = polygons->corners.items[a].coord;
            uint32_t high = polygons->corners.items[b].coord;
            edge *met = find_edge(edges, size - 1, low, high);
            if (met->face && low != high) {
                const double *here = face_normals[f], *there = face_normals[met->face - 1];
                if (dot(here, there) > limit * sqrt(dot(here, here)) * sqrt(dot(there, there))) {
                    join_sets(parents, a, met->low_corner);
                    join_sets(parents, b, met->high_corner);
                }
            }
            *met = (edge){low, high, a, b, f + 1};
        }
    }
}

/* Which corners share a normal, as parents of a forest. */
static uint32_t *group_corners(const plr_polygons *polygons, double (*face_normals)[3],
                               double crease) {
    size_t count = polygons->corners.count;
    uint32_t *parents = PLR_NEW_ARRAY(polygons->arena, count, uint32_t);
    for (uint32_t i = 0; i < count; i++)
        parents[i] = i;
    if (crease >= acos(-1.0)) { /* every edge is smooth */
        uint32_t *first = PLR_NEW_ARRAY(polygons->arena, polygons->point_count, uint32_t);
        memset(first, 0xff, polygons->point_count * sizeof *first);
        for (uint32_t i = 0; i < count; i++) {
            uint32_t *of_coord = &first[polygons->corners.items[i].coord];
            if (*of_coord == PLR_MESH_NONE)
                *of_coord = i;
            parents[i] = *of_coord;
        }
    } else if (crease > 0) {
        join_across_edges(polygons, face_normals, crease, parents);
    } else {
        for (size_t f = 0; f < polygons->faces.count; f++)
            for (uint32_t i = 0; i < polygons->faces.items[f].count; i++)
                parents[polygons->faces.items[f].first + i] = polygons->faces.items[f].first;
    }
    return parents;
}

/* The sum at length 1; where it vanishes the face's own; a face without area looks along +Z. */
static void finish_normal(const double sum[3], const double *face, double sign, float normal[3]) {
    static const double along_z[3] = {0, 0, 1};
    const double *chosen = dot(sum, sum) > 0 ? sum : dot(face, face) > 0 ? face : along_z;
    double scale = sign / sqrt(dot(chosen, chosen));
    for (int axis = 0; axis < 3; axis++)
        normal[axis] = (float)(chosen[axis] * scale);
}

/* The angle of a polygon at a corner, at most pi. */
static double corner_angle(const plr_polygons *polygons, const plr_face *face, uint32_t corner) {
    const plr_corner *corners = polygons->corners.items + face->first;
    uint32_t before = corner ? corner - 1 : face->count - 1;
    uint32_t after = corner + 1 < face->count ? corner + 1 : 0;
    const float *at = polygons->points + (size_t)corners[corner].coord * 3;
    const float *a = polygons->points + (size_t)corners[before].coord * 3;
    const float *b = polygons->points + (size_t)corners[after].coord * 3;
    double u[3], v[3];
    for (int axis = 0; axis < 3; axis++) {
        u[axis] = (double)a[axis] - (double)at[axis];
        v[axis] = (double)b[axis] - (double)at[axis];
    }
    double cross[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
    return atan2(sqrt(dot(cross, cross)), dot(u, v));
}

/* Adds the normal of a face to those of its corners, by the angle that it has there: so the sum
 * does not depend on how a flat area is cut into faces. */
static void add_face_normal(plr_polygons *polygons, const plr_face *face, const double normal[3],
                            bool flat, uint32_t *parents, double (*sums)[3]) {
    double length = sqrt(dot(normal, normal));
    for (uint32_t i = 0; i < face->count; i++) {
        uint32_t root = find_set(parents, face->first + i);
        polygons->corners.items[face->first + i].normal = root;
        if (!(length > 0) || (flat && i))
            continue; /* a flat face counts once */
        double weight = flat ? 1 : corner_angle(polygons, face, i);
        for (int axis = 0; axis < 3; axis++)
            sums[root][axis] += normal[axis] / length * weight;
    }
}

void plr_polygons_make_normals(plr_polygons *polygons, double crease, bool clockwise) {
    size_t face_count = polygons->faces.count, corner_count = polygons->corners.count;
    double(*face_normals)[3] = plr_arena_array(polygons->arena, face_count, sizeof *face_normals);
    double(*sums)[3] = plr_arena_array(polygons->arena, corner_count, sizeof *sums);
    for (size_t f = 0; f < face_count; f++)
        plr_face_normal(polygons, &polygons->faces.items[f], face_normals[f]);
    uint32_t *parents = group_corners(polygons, face_normals, crease);

    float *normals = plr_arena_array(polygons->arena, corner_count, 3 * sizeof *normals);
    for (size_t f = 0; f < face_count; f++)
        add_face_normal(polygons, &polygons->faces.items[f], face_normals[f], !(crease > 0),
                        parents, sums);
    for (size_t f = 0; f < face_count; f++) {
        plr_face face = polygons->faces.items[f];
        for (uint32_t i = face.first; i < face.first + face.count; i++)
            if (polygons->corners.items[i].normal == i)
                finish_normal(sums[i], face_normals[f], clockwise ? -1 : 1,
                              normals + 3 * (size_t)i);
    }
    polygons->normals = normals;
}
