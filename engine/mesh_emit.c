#include "engine/mesh_internal.h"

#include <math.h>
#include <string.h>

/* Steps that all concave polygons of one node may take together: a second or two. */
#define CLIPPING_BUDGET (UINT64_C(1) << 28)

/* Vertices so far: equal corners become one. */
typedef struct vertices {
    plr_polygons *polygons;
    plr_corner *items;
    uint32_t count;
    uint32_t *table; /* vertex plus 1; 0: empty. NULL: all corners stay apart */
    size_t mask;
} vertices;

static bool same_corner(const plr_corner *a, const plr_corner *b) {
    return a->coord == b->coord && a->normal == b->normal && a->color == b->color &&
           a->tex == b->tex;
}

static uint64_t mix(uint64_t hash, uint64_t value) {
    hash = (hash ^ value) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ hash >> 29;
}

static uint32_t vertex_of(vertices *v, const plr_corner *corner) {
    if (!v->table) { /* each corner of a line has a place of its own along it */
        v->count = (uint32_t)v->polygons->corners.count;
        return (uint32_t)(corner - v->items);
    }
    uint64_t hash =
        mix(mix((uint64_t)corner->coord << 32 | corner->normal, corner->color), corner->tex);
    size_t slot = (size_t)(hash >> 8) & v->mask;
    for (; v->table[slot]; slot = (slot + 1) & v->mask)
        if (same_corner(&v->items[v->table[slot] - 1], corner))
            return v->table[slot] - 1;
    v->items[v->count] = *corner;
    v->table[slot] = ++v->count;
    return v->count - 1;
}

/* Indices that a face gives. */
static size_t index_count(const plr_polygons *polygons, const plr_face *face) {
    switch (polygons->kind) {
    case PLR_MESH_TRIANGLES:
        return ((size_t)face->count - 2) * 3;
    case PLR_MESH_LINES:
        return ((size_t)face->count - 1) * 2;
    case PLR_MESH_POINTS:
        break;
    }
    return face->count;
}

/* Corner numbers in the place of indices. */
static void cut_face(plr_polygons *polygons, plr_clipper *clipper, const plr_face *face,
                     uint32_t *indices) {
    uint32_t n = face->count;
    bool convex =
        !polygons->concave || (size_t)(face - polygons->faces.items) < polygons->convex_faces;
    if (polygons->kind == PLR_MESH_POINTS) {
        for (uint32_t i = 0; i < n; i++)
            indices[i] = i;
    } else if (polygons->kind == PLR_MESH_LINES) {
        for (uint32_t i = 0; i + 1 < n; i++) {
            indices[2 * (size_t)i] = i;
            indices[2 * (size_t)i + 1] = i + 1;
        }
    } else if (!convex && n > 3) {
        plr_triangulate(clipper, polygons, face, indices);
    } else {
        for (uint32_t i = 0; i + 2 < n; i++) {
            indices[3 * (size_t)i] = 0;
            indices[3 * (size_t)i + 1] = i + 1;
            indices[3 * (size_t)i + 2] = i + 2;
        }
    }
}

static void make_indices(vertices *v, plr_mesh *mesh) {
    plr_polygons *p = v->polygons;
    plr_clipper clipper = {.arena = p->arena, .budget = CLIPPING_BUDGET};
    uint32_t *indices = mesh->indices;
    for (size_t f = 0; f < p->faces.count; f++) {
        const plr_face *face = &p->faces.items[f];
        size_t count = index_count(p, face);
        cut_face(p, &clipper, face, indices);
        for (size_t i = 0; i < count; i++)
            indices[i] = vertex_of(v, &p->corners.items[face->first + indices[i]]);
        indices += count;
    }
}

static const float white[4] = {1, 1, 1, 1}, origin[4] = {0, 0, 0, 1};

/* One kind of value of all vertices; where a vertex has none, what stands in. */
static float *gather(plr_polygons *p, const vertices *v, const float *values, uint32_t count,
                     size_t size, size_t member, const float *stand_in) {
    if (!values)
        return NULL;
    float *gathered = plr_mesh_array(p->arena, v->count, size * sizeof *gathered);
    for (size_t i = 0; i < v->count; i++) {
        uint32_t index;
        memcpy(&index, (const char *)&v->items[i] + member, sizeof index);
        memcpy(gathered + i * size, index < count ? values + index * size : stand_in,
               size * sizeof *gathered);
    }
    return gathered;
}

/* Lighting needs length 1; what has no direction looks along +Z. */
static void normalize(float *normals, size_t count) {
    for (size_t i = 0; i < count; i++) {
        float *n = normals + 3 * i;
        double length = sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] +
                             (double)n[2] * (double)n[2]);
        bool sound = length > 0 && isfinite(length);
        for (int axis = 0; axis < 3; axis++)
            n[axis] = sound ? (float)((double)n[axis] / length) : (float)(axis == 2);
    }
}

/* A copy of the mapping by the bounding box. */
static float *default_tex_coords(plr_polygons *p, plr_mesh *mesh) {
    const float *mapping = plr_mesh_plane_coords(mesh);
    if (!mapping)
        longjmp(*p->arena->out_of_memory, 1);
    float *copy = plr_mesh_array(p->arena, mesh->vertex_count, 4 * sizeof *copy);
    memcpy(copy, mapping, mesh->vertex_count * 4 * sizeof *copy);
    return copy;
}

static void fill_tex_coords(plr_polygons *p, const vertices *v, plr_mesh *mesh) {
    mesh->tex_coords_given = p->tex_given;
    for (unsigned unit = 0; unit < PLR_MESH_TEX_UNITS; unit++)
        if (p->tex_coords[unit])
            mesh->tex_coords[unit] = gather(p, v, p->tex_coords[unit], p->tex_counts[unit], 4,
                                            offsetof(plr_corner, tex), origin);
        else if (unit < p->tex_units || unit == 0)
            mesh->tex_coords[unit] = default_tex_coords(p, mesh);
}

/* ISO/IEC 19775-1 24.4.4: one depth a point; where there are too few, the last one holds on. */
static void fill_fog_coords(plr_polygons *p, const vertices *v, plr_mesh *mesh) {
    static const float missing[1] = {0};
    uint32_t count;
    const float *depths =
        plr_mesh_values(p->arena, plr_node_child(p->node, "fogCoord"), "depth", 1, missing, &count);
    if (!count)
        return;
    mesh->fog_coords = plr_mesh_array(p->arena, v->count, sizeof *mesh->fog_coords);
    for (size_t i = 0; i < v->count; i++)
        mesh->fog_coords[i] = depths[v->items[i].coord < count ? v->items[i].coord : count - 1];
}

/* Lines have their corners as vertices, in order. */
static void fill_line_distances(plr_polygons *p, plr_mesh *mesh) {
    mesh->line_distances = plr_mesh_array(p->arena, mesh->vertex_count, sizeof(float));
    for (size_t f = 0; f < p->faces.count; f++) {
        const plr_face *face = &p->faces.items[f];
        double distance = 0;
        for (size_t i = face->first + 1; i < (size_t)face->first + face->count; i++) {
            const float *a = mesh->positions + 3 * i;
            double x = (double)a[0] - (double)a[-3], y = (double)a[1] - (double)a[-2],
                   z = (double)a[2] - (double)a[-1];
            distance += sqrt(x * x + y * y + z * z);
            mesh->line_distances[i] = (float)distance;
        }
    }
}

static void fill_mesh(plr_polygons *p, const vertices *v, plr_mesh *mesh) {
    mesh->vertex_count = v->count;
    mesh->positions =
        gather(p, v, p->points, p->point_count, 3, offsetof(plr_corner, coord), origin);
    mesh->normals = gather(p, v, p->normals, UINT32_MAX, 3, offsetof(plr_corner, normal), origin);
    if (mesh->normals)
        normalize(mesh->normals, v->count);
    mesh->colors = gather(p, v, p->colors, UINT32_MAX, 4, offsetof(plr_corner, color), white);
    plr_mesh_find_bounds(mesh);
    if (p->kind == PLR_MESH_TRIANGLES)
        fill_tex_coords(p, v, mesh);
    if (p->kind == PLR_MESH_LINES)
        fill_line_distances(p, mesh);
    fill_fog_coords(p, v, mesh);
    uint32_t *coords = PLR_NEW_ARRAY(p->arena, v->count, uint32_t);
    for (uint32_t i = 0; i < v->count; i++)
        coords[i] = v->items[i].coord;
    plr_mesh_attributes(p, mesh, coords);
}

bool plr_polygons_emit(plr_polygons *p, plr_mesh *mesh) {
    size_t indices = 0;
    for (size_t f = 0; f < p->faces.count; f++)
        indices += index_count(p, &p->faces.items[f]);
    if (!indices || indices > UINT32_MAX)
        return false;
    mesh->kind = p->kind;
    mesh->index_count = (uint32_t)indices;
    mesh->indices = plr_mesh_array(p->arena, indices, sizeof *mesh->indices);
    vertices v = {.polygons = p, .items = p->corners.items};
    if (p->kind != PLR_MESH_LINES) {
        size_t size = 16;
        while (size < p->corners.count * 2)
            size *= 2;
        v.items = PLR_NEW_ARRAY(p->arena, p->corners.count, plr_corner);
        v.table = PLR_NEW_ARRAY(p->arena, size, uint32_t);
        v.mask = size - 1;
    }
    make_indices(&v, mesh);
    fill_mesh(p, &v, mesh);
    return true;
}
